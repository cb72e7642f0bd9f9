// check.js: `lambent check` as a module: verdicts about shaders, drawn by a painter (painter.js).
import { Files, system } from './wasi.js';

// Thrown if shaders cannot be checked, with the program's message.
export class CheckError extends Error {}

export class Check {
  #instance;
  #printed = '';

  // `painter`: `imports`, and attach(instance).
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

  // Returns the report of `lambent check --json`. Without a vertex shader, one is generated; without a contract, it is recognised. `pictures`: the limit of the
  // search for mistakes, 0: the default. `highlight`: 'phong', or '' for the contract's highlight.
  check({ fragment, vertex = '', contract = '', highlight = '', size = 0, pictures = 0 }) {
    this.#texts([fragment, vertex, contract, highlight]);
    return this.#call('web_check', size, pictures);
  }

  // The RGBA pixels of a scene of the last report: 'theirs', 'reference' or 'difference'.
  picture(scene, which, size = 128) {
    const { memory, web_check_picture } = this.#instance.exports;
    const at = web_check_picture(scene, ['theirs', 'reference', 'difference'].indexOf(which));
    return at ? new Uint8ClampedArray(memory.buffer, at, 4 * size * size).slice() : null;
  }

  // The contracts with their names, scenes, known mistakes and exercises {mistake, looks, wrong}.
  lists() {
    return this.#call('web_check_lists');
  }

  // A program with a known mistake: {texts: {vertex, fragment}, correct, highlight}. Pass `highlight` to check().
  exercise(mistake) {
    this.#texts([mistake]);
    return this.#call('web_exercise');
  }
}
