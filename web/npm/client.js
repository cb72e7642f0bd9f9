// client.js: runs a Lambent in a worker, one call at a time. If a call is aborted, its worker is ended, and the next call starts a new worker.
import { Files, typeError } from './files.js';
import { LambentError } from './lambent.js';
import { checkCall, wordsOf } from './words.js';

async function startWorker() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }); // as bundlers such as Vite look for it
  const name = 'node:worker_threads'; // not a literal, because bundlers for browsers would look for it
  return new (await import(/* @vite-ignore */ /* webpackIgnore: true */ name)).Worker(new URL('./worker.js', import.meta.url));
}

// Recreates an error of the worker.
function errorOf({ kind, message, code }) {
  return kind === 'LambentError' ? new LambentError(message, code) : Object.assign(new (kind === 'TypeError' ? TypeError : Error)(message), { code });
}

export class LambentWorker {
  files = new Files();
  #module;
  #decoders;
  #make;
  #worker = null;
  #changes = new Map(); // path → bytes, null: deleted; changes that the worker has not received
  #last = Promise.resolve();
  #disposed = false;
  #stop = null; // ends the running call

  constructor(module, make = startWorker, decoders = undefined) {
    this.#module = module;
    this.#decoders = decoders;
    this.#make = make;
    this.files.onChange = (path, bytes) => this.#changes.set(path, bytes);
  }

  #end() {
    this.#worker?.terminate();
    this.#worker = null;
    for (const path of this.files.list()) this.#changes.set(path, this.files.get(path));
  }

  #check() {
    if (!this.#disposed) return;
    this.#end();
    throw new LambentError('this Lambent is disposed', 'DISPOSED');
  }

  async #begin() {
    const worker = await this.#make();
    worker.postMessage({ module: this.#module, decoders: this.#decoders });
    return worker;
  }

  // Sends a request and waits for its answer.
  async #ask(method, args, { signal, onProgress }) {
    this.#check();
    signal?.throwIfAborted();
    const worker = (this.#worker ??= await this.#begin());
    this.#check();
    const files = [...this.#changes];
    this.#changes.clear();
    const { promise, resolve, reject } = withResolvers();
    const listen = (data) => (data.share !== undefined ? onProgress?.(data.share) : data.error ? reject(errorOf(data.error)) : resolve(data.answer));
    const fail = (reason) => {
      this.#end();
      reject(reason);
    };
    const abort = () => fail(signal.reason);
    worker.ref?.();
    this.#stop = fail;
    if (worker.on) worker.removeAllListeners().on('message', listen).on('error', (error) => fail(new LambentError(`the worker failed: ${error.message}`)));
    else {
      worker.onmessage = ({ data }) => listen(data);
      worker.onerror = (event) => fail(new LambentError(`the worker failed: ${event.message ?? 'it could not be started'}`));
    }
    signal?.addEventListener('abort', abort);
    worker.postMessage({ method, args, files, watch: Boolean(onProgress) });
    try {
      return await promise;
    } finally {
      this.#stop = null;
      signal?.removeEventListener('abort', abort);
      worker.unref?.(); // lets node exit although the worker waits
    }
  }

  // Runs the call after the previous calls have ended.
  #queue(method, args, call = {}) {
    const answer = this.#last.then(() => this.#ask(method, args, call));
    this.#last = answer.catch(() => {});
    return answer;
  }

  async draw(model, options = undefined, call = undefined) {
    const words = wordsOf('draw', model, options), about = checkCall('draw', Array.isArray(model) ? (call ?? options) : call);
    return this.#queue('draw', [words, { as: about.as }], about);
  }

  async explain(model, x, y, options = undefined) {
    for (const [name, value] of [['x', x], ['y', y]]) if (!Number.isInteger(value)) throw typeError('explain', name, value, 'a whole number');
    return this.#queue('explain', [wordsOf('explain', model, options), x, y]);
  }

  async lights(model, options = undefined) {
    return this.#queue('lights', [wordsOf('lights', model, options)]);
  }

  async describe() {
    return this.#queue('describe', []);
  }

  // Ends the worker, even while it draws. Waiting calls are rejected.
  dispose() {
    this.#disposed = true;
    this.#stop?.(new LambentError('this Lambent is disposed', 'DISPOSED'));
    this.#end();
  }
}
if (Symbol.dispose) LambentWorker.prototype[Symbol.dispose] = LambentWorker.prototype.dispose;

function withResolvers() {
  let resolve, reject;
  const promise = new Promise((yes, no) => ([resolve, reject] = [yes, no]));
  return { promise, resolve, reject };
}
