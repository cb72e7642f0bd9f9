// index.js: the npm package (docs/npm.md). It draws pictures of 3D models in node and browsers, from files in memory.
//
//   const lambent = await open();
//   lambent.files.set('/bunny.stl', bytes);
//   const png = lambent.draw('/bunny.stl', { size: 512, view: 'front' }, { as: 'png' });
//
// A Lambent blocks while it draws. openWorker() offers the same calls as promises, in a worker.
import { Files, typeError } from './files.js';
import { Lambent as Module, LambentError } from './lambent.js';
import { LambentWorker } from './client.js';
import { checkCall, plainSentence, wordsOf } from './words.js';

const isBytes = (value) => value instanceof ArrayBuffer || ArrayBuffer.isView(value);

async function readFile(url) {
  const name = 'node:fs/promises'; // not a literal, because bundlers for browsers would look for it
  return (await import(/* @vite-ignore */ /* webpackIgnore: true */ name)).readFile(url);
}

async function compileResponse(response) {
  if (!response.ok) throw new LambentError(`${response.url || 'the module'}: found the answer ${response.status}, expected lambent.wasm`, 'CANNOT_READ');
  const type = response.headers.get('content-type') ?? '';
  if (WebAssembly.compileStreaming && type.startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

// Compiles the module from a URL, a Response or bytes, or returns `source` if it is a compiled module. The default is the package's own file.
async function compile(source, signal) {
  source = await source;
  if (source === undefined) source = new URL('./lambent.wasm', import.meta.url);
  if (source instanceof WebAssembly.Module) return source;
  if (isBytes(source)) return WebAssembly.compile(source);
  if (typeof Response === 'function' && source instanceof Response) return compileResponse(source);
  if (typeof source !== 'string' && !(source instanceof URL)) throw typeError('open', 'source', source, 'a URL, a Response, bytes or nothing');
  const url = new URL(source, globalThis.document?.baseURI ?? globalThis.location?.href);
  return url.protocol === 'file:' && !globalThis.document ? WebAssembly.compile(await readFile(url)) : compileResponse(await fetch(url, { signal }));
}

export class Lambent {
  #compiled;
  #module = null; // created on first use; an aborted drawing or a trap makes it unusable
  #disposed = false;
  #progress = null; // called with the progress of the running call

  constructor(module, files = new Files()) {
    if (!(module instanceof WebAssembly.Module)) throw typeError('Lambent', 'module', module, 'a WebAssembly.Module');
    if (!(files instanceof Files)) throw typeError('Lambent', 'files', files, 'Files');
    this.#compiled = module;
    this.files = files;
  }

  #run(call, what) {
    if (this.#disposed) throw new LambentError('this Lambent is disposed', 'DISPOSED');
    call.signal?.throwIfAborted();
    this.#module ??= new Module(this.#compiled, this.files, { progress: (share) => this.#progress?.(share) });
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

export async function open(source = undefined, { signal } = {}) {
  signal?.throwIfAborted();
  return new Lambent(await compile(source, signal));
}

// `worker` is a function that creates the worker. It is for bundlers that do not find worker.js by its URL.
export async function openWorker(source = undefined, { signal, worker } = {}) {
  signal?.throwIfAborted();
  if (worker !== undefined && typeof worker !== 'function') throw typeError('openWorker', 'worker', worker, 'a function');
  return new LambentWorker(await compile(source, signal), worker);
}

export { Files, LambentError, LambentWorker };
