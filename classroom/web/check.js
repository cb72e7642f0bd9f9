// check.js: checks shaders as `lambent check` does. A painter (painter.js) draws the pictures of the shaders.
import { Files, system } from '../../web/wasi.js';

// Thrown with the program's message if shaders cannot be checked.
export class CheckError extends Error {}

export class Check {
  #instance;
  #printed = '';

  // `painter` is an object with `imports` and attach(instance).
  constructor(module, painter) {
    const host = system(new Files(), [], (stream, text) => (this.#printed += text));
    this.#instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1, painter: painter.imports });
    host.attach(this.#instance);
    painter.attach(this.#instance);
    this.#instance.exports._initialize();
  }

  #call(name, ...numbers) {
    this.#printed = '';
    this.#instance.exports[name](...numbers);
    const answer = JSON.parse(this.#printed);
    if (answer.ok === false) throw new CheckError(answer.error);
    return answer;
  }

  #texts(texts) {
    const bytes = new TextEncoder().encode(texts.map((text) => text.replaceAll('\0', ' ') + '\0').join(''));
    const at = this.#instance.exports.web_texts(bytes.length);
    if (!at) throw new CheckError('out of memory');
    new Uint8Array(this.#instance.exports.memory.buffer, at, bytes.length).set(bytes);
  }

  // Returns the report of `lambent check --json`. If no vertex shader is given, the program generates one. If no contract is given, the program recognises it
  // from the shaders. `pictures` limits the number of pictures in the search for mistakes; 0 is the default limit. `highlight` is 'phong', or '' for the
  // contract's highlight.
  check({ fragment, vertex = '', contract = '', highlight = '', size = 0, pictures = 0 }) {
    this.#texts([fragment, vertex, contract, highlight]);
    return this.#call('web_check', size, pictures);
  }

  // Returns the RGBA pixels of a scene of the last report. `which` is 'theirs', 'reference' or 'difference'.
  picture(scene, which, size = 128) {
    const { memory, web_check_picture } = this.#instance.exports;
    const at = web_check_picture(scene, ['theirs', 'reference', 'difference'].indexOf(which));
    return at ? new Uint8ClampedArray(memory.buffer, at, 4 * size * size).slice() : null;
  }

  // Returns the contracts with their names, scenes, known mistakes and exercises {mistake, looks, wrong}.
  lists() {
    return this.#call('web_check_lists');
  }

  // Returns a program with a known mistake: {texts: {vertex, fragment}, correct, highlight}. Pass `highlight` to check().
  exercise(mistake) {
    this.#texts([mistake]);
    return this.#call('web_exercise');
  }
}
