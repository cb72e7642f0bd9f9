// lambent.js: Lambent as a module for node and browsers: draws pictures of models from command lines, with files in memory. It reads no files of the machine
// and sends nothing. A call blocks until the picture is drawn, so a page calls it in a worker. threads.js adds threads.
//
//   const lambent = await open(bytesOfLambentWasm);
//   lambent.files.set('/bunny.obj', bytes);
//   const picture = lambent.draw(['/bunny.obj', '--size', '512']);    // RGBA, as `lambent /bunny.obj --size 512` draws it
//   const png = lambent.save(['/bunny.obj', '--size', '512'], 'png'); // the bytes that the command writes
import { Files, system } from './wasi.js';

// Thrown if a command line cannot be drawn: the program's message, and a word for its exit code. `cancelled`: the caller asked the call to end.
export class LambentError extends Error {
  cancelled = false;

  constructor(sentence, code = 'FAILED') {
    super(sentence);
    this.name = 'LambentError';
    this.code = code;
  }
}
const CODES = ['OK', 'BAD_ARGUMENT', 'CANNOT_READ', 'UNSUPPORTED', 'LIMIT', 'CANNOT_WRITE'];

// Thrown if a divided module needs a part that is not loaded. This Lambent cannot be used afterwards.
export class PartMissing extends Error {
  constructor(part) {
    super(`the part '${part}' of the module is missing`);
    this.part = part; // 'rest' or 'more'; 'threads-more' for the module with threads
  }
}

// wasm-split's placeholders: a divided module calls them instead of functions of a missing part.
const placeholder = (part) => new Proxy({}, {
  get: () => () => {
    throw new PartMissing(part);
  },
});

const DECODING = ['web_draco_decode', 'web_draco_attribute', 'web_draco_triangles', 'web_draco_free', 'web_meshopt_decode', 'web_meshopt_filter'];

export class Lambent {
  instance; // the instance of the module
  decoders = null; // decoders of Draco and meshoptimizer (decoders.js); null: not loaded
  wantsDecoders = false; // a file needed them
  #printed = '';
  #decoding = null;

  // `parts`: the loaded parts of a divided module. Calls that need another part throw PartMissing until complete() adds it. `memory`: the memory of a
  // module with threads (threads.js). `progress`: called repeatedly while drawing, with the fraction that is done, 0 to 1.
  constructor(module, files = new Files(), { parts = [], memory = null, progress = null } = {}) {
    this.files = files;
    const host = system(files, [], (stream, text) => (this.#printed += text));
    const own = (at, size) => new Uint8Array(this.instance.exports.memory.buffer, at, size);
    const decoding = (name) => (...numbers) => (this.#decoding ??= this.decoders.imports(own))[name](...numbers);
    const decoders = Object.fromEntries(DECODING.map((name) => [name, decoding(name)]));
    const web_decoders = () => Number(Boolean(this.decoders) || !(this.wantsDecoders = true));
    this.instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1, rest: placeholder('rest'), more: placeholder('more'),
      'threads-more': placeholder('threads-more'), unused: placeholder('unused'), env: { memory, ...decoders, web_decoders, web_progress: (share) => progress?.(share) } });
    host.attach(this.instance);
    for (const part of parts) this.complete(part);
    this.instance.exports._initialize();
  }

  complete(part) {
    new WebAssembly.Instance(part, { primary: this.instance.exports });
  }

  // Limits the memory for reading a model and for drawing it, in bytes each, if the words contain no --memory-limit. 0 means no
  // limit.
  limitMemory(bytes) {
    this.instance.exports.web_limit_memory(bytes);
  }

  #words(words) {
    const bytes = new TextEncoder().encode(words.map((word) => word + '\0').join(''));
    const at = this.instance.exports.web_words(bytes.length);
    if (!at) throw new LambentError('out of memory', 'LIMIT');
    new Uint8Array(this.instance.exports.memory.buffer, at, bytes.length).set(bytes);
    return words.length;
  }

  #call(name, ...numbers) {
    this.#printed = '';
    const code = this.instance.exports[name](...numbers);
    const answer = JSON.parse(this.#printed);
    if (answer.ok === false) throw Object.assign(new LambentError(answer.error, CODES[code]), { cancelled: answer.cancelled });
    return answer;
  }

  // Returns the picture: width, height, `pixels` (RGBA), the camera, times, warnings.
  draw(words) {
    const picture = this.#call('web_draw', this.#words(words));
    const { memory, web_pixels } = this.instance.exports;
    picture.pixels = new Uint8ClampedArray(memory.buffer, web_pixels(), picture.width * picture.height * 4).slice();
    return picture;
  }

  // The file that `act` writes at a path. It is removed, and is not one of the files that a model misses.
  #written(path, act) {
    try {
      act();
      return this.files.get(path).slice();
    } finally {
      this.files.delete(path);
      this.files.absent.delete(path);
    }
  }

  // Returns the bytes of the picture's file, in the format of an extension: png, jpg, ppm, pfm.
  save(words, ending) {
    const path = `/picture-to-save.${ending}`;
    return this.#written(path, () => this.#call('web_save', this.#words([...words, '-o', path])));
  }

  // Returns the scene file that --save-scene writes, as bytes.
  scene(words) {
    const path = '/scene-to-save.json';
    return this.#written(path, () => this.save([...words, '--save-scene', path], 'png'));
  }

  // Explains one pixel, as `lambent explain --json` prints it.
  explain(words, x, y) {
    return this.#call('web_explain', this.#words(words), x, y);
  }

  // The curves of a light of the picture, 101 values each: attenuation up to a distance, cone, and highlight, by degrees up to 90. `light`: its index in the
  // explanation's list; `reflection`: the word of a reflection model.
  curves(words, { light, farthest, shininess, reflection }) {
    return this.#call('web_curves', this.#words([...words, reflection]), light, farthest, shininess);
  }

  // The picture's lights in the form of a scene file, as `lambent lights` prints them.
  lights(words) {
    return this.#call('web_lights', this.#words(words));
  }

  // Returns the model's size, objects, materials and animations.
  contents(words) {
    return this.#call('web_contents', this.#words(words));
  }

  // Returns the options of a picture, in the groups of the help, the names of shapes, and the
  // version.
  options() {
    return this.#call('web_options');
  }

  // The files have changed, so the model is read again.
  forget() {
    this.instance.exports.web_forget();
  }
}

// Opens the module from its bytes, or from a compiled WebAssembly.Module.
export async function open(source) {
  return new Lambent(source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source));
}

export { Files };
