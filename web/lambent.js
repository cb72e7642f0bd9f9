// lambent.js: runs Lambent as a module in node and browsers. It draws pictures of models from command lines, with files in memory. It does not read the
// machine's files, and sends no data. A call blocks until the picture is drawn, so a page calls it in a worker. threads.js adds threads.
//
//   const lambent = await open(bytesOfLambentWasm);
//   lambent.files.set('/bunny.obj', bytes);
//   const picture = lambent.draw(['/bunny.obj', '--size', '512']);    // RGBA, as `lambent /bunny.obj --size 512` draws it
//   const png = lambent.save(['/bunny.obj', '--size', '512'], 'png'); // the bytes that the command writes
import { Files, system } from './wasi.js';

// Thrown if a command line cannot be drawn. It contains the program's message, and a word for the program's exit code. `cancelled` is true if the caller has
// asked the call to end.
export class LambentError extends Error {
  cancelled = false;

  constructor(sentence, code = 'FAILED') {
    super(sentence);
    this.name = 'LambentError';
    this.code = code;
  }
}
const CODES = ['OK', 'BAD_ARGUMENT', 'CANNOT_READ', 'UNSUPPORTED', 'LIMIT', 'CANNOT_WRITE'];

// Thrown if a divided module needs a part that is not loaded. The Lambent that throws it cannot be used afterwards.
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

  // `parts` are the loaded parts of a divided module. Calls that need another part throw PartMissing until complete() adds it. `memory` is the memory of a
  // module with threads (threads.js). `progress` is called repeatedly during drawing, with the finished fraction from 0 to 1.
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

  // Limits the memory for reading a model to this number of bytes, and the memory for drawing it to the same number, if the words contain no --memory-limit. 0
  // means no limit.
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

  // Returns the file that `act` writes at a path, and removes the file. The file does not count as a missing file of the model.
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

  // Returns the explanation of one pixel, as `lambent explain --json` prints it.
  explain(words, x, y) {
    return this.#call('web_explain', this.#words(words), x, y);
  }

  // Returns three curves of a light of the picture, with 101 values each: the attenuation at distances from 0 to `farthest`, and the cone and the highlight at
  // angles from 0 to 90 degrees. `light` is the light's index in the explanation's list. `reflection` is the word of a reflection model.
  curves(words, { light, farthest, shininess, reflection }) {
    return this.#call('web_curves', this.#words([...words, reflection]), light, farthest, shininess);
  }

  // Returns the picture's lights in the form of a scene file, as `lambent lights` prints them.
  lights(words) {
    return this.#call('web_lights', this.#words(words));
  }

  // Returns the model's size, objects, materials and animations.
  contents(words) {
    return this.#call('web_contents', this.#words(words));
  }

  // Returns the options of a picture in the groups of the help, the names of the shapes, and the version.
  options() {
    return this.#call('web_options');
  }

  // Forgets the model, so that the next call reads it again. Call it after files have changed.
  forget() {
    this.instance.exports.web_forget();
  }
}

// Opens the module from its bytes, or from a compiled WebAssembly.Module.
export async function open(source) {
  return new Lambent(source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source));
}

export { Files };
