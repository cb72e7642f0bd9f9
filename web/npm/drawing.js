// drawing.js: a Lambent, which blocks while it draws. The worker (worker.js) uses this file, not index.js: bundlers refuse workers that start themselves.
import { Decoders } from './decoders.js';
import { Files, typeError } from './files.js';
import { Lambent as Module, LambentError } from './lambent.js';
import { checkCall, plainSentence, wordsOf } from './words.js';

export class Lambent {
  #compiled;
  #decoders;
  #module = null; // created on first use; an aborted drawing or a trap makes it unusable
  #disposed = false;
  #progress = null; // called with the progress of the running call

  // `decoders` is the compiled module of Draco and meshoptimizer; without it, files that need it are refused.
  constructor(module, files = new Files(), decoders = undefined) {
    if (!(module instanceof WebAssembly.Module)) throw typeError('Lambent', 'module', module, 'a WebAssembly.Module');
    if (!(files instanceof Files)) throw typeError('Lambent', 'files', files, 'Files');
    this.#compiled = module;
    this.#decoders = decoders;
    this.files = files;
  }

  #start() {
    const module = new Module(this.#compiled, this.files, { progress: (share) => this.#progress?.(share) });
    if (this.#decoders) module.decoders = new Decoders(this.#decoders);
    return module;
  }

  #run(call, what) {
    if (this.#disposed) throw new LambentError('this Lambent is disposed', 'DISPOSED');
    call.signal?.throwIfAborted();
    this.#module ??= this.#start();
    if (this.files.changed) this.#module.forget();
    this.#progress = (share) => {
      call.onProgress?.(share);
      call.signal?.throwIfAborted();
    };
    try {
      return what(this.#module);
    } catch (error) {
      if (error instanceof LambentError) throw new LambentError(plainSentence(error.message), error.code);
      this.#module = null;
      if (error instanceof WebAssembly.RuntimeError) throw new LambentError(`the module failed: ${error.message}`, 'FAILED');
      throw error;
    } finally {
      this.#progress = null;
      this.files.changed = false;
    }
  }

  // Returns the picture: its pixels, or the bytes of a file with { as: 'png' } and similar.
  draw(model, options = undefined, call = undefined) {
    const words = wordsOf('draw', model, options);
    const about = checkCall('draw', Array.isArray(model) ? (call ?? options) : call);
    return this.#run(about, (module) => {
      if (about.as !== 'pixels') return module.save(words, about.as);
      const picture = module.draw(words);
      picture.warnings = picture.warnings?.map(plainSentence);
      return picture;
    });
  }

  // Returns the explanation of one pixel, as `lambent explain --json` prints it.
  explain(model, x, y, options = undefined) {
    for (const [name, value] of [['x', x], ['y', y]]) if (!Number.isInteger(value)) throw typeError('explain', name, value, 'a whole number');
    const words = wordsOf('explain', model, options);
    return this.#run({}, (module) => module.explain(words, x, y));
  }

  // Returns the picture's lights, as `lambent lights` prints them.
  lights(model, options = undefined) {
    const words = wordsOf('lights', model, options);
    return this.#run({}, (module) => module.lights(words));
  }

  // Returns the options of `draw` as the program's help describes them, the names of the shapes, and the version.
  describe() {
    return this.#run({}, (module) => module.options());
  }

  // Frees the memory. Later calls throw a LambentError with the code DISPOSED.
  dispose() {
    this.#disposed = true;
    this.#module = this.#compiled = null;
  }
}
if (Symbol.dispose) Lambent.prototype[Symbol.dispose] = Lambent.prototype.dispose;
