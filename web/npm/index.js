// index.js: the npm package (docs/npm.md). It draws pictures of 3D models in node and browsers, from files in memory.
//
//   const lambent = await open();
//   lambent.files.set('/bunny.stl', bytes);
//   const png = lambent.draw('/bunny.stl', { size: 512, view: 'front' }, { as: 'png' });
//
// A Lambent blocks while it draws. openWorker() offers the same calls as promises, in a worker.
import { LambentWorker } from './client.js';
import { Lambent } from './drawing.js';
import { Files, typeError } from './files.js';
import { LambentError } from './lambent.js';

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

// Compiles a module from a URL, a Response or bytes, or returns `source` if it is a compiled module.
async function compile(source, signal) {
  source = await source;
  if (source instanceof WebAssembly.Module) return source;
  if (isBytes(source)) return WebAssembly.compile(source);
  if (typeof Response === 'function' && source instanceof Response) return compileResponse(source);
  if (typeof source !== 'string' && !(source instanceof URL)) throw typeError('open', 'source', source, 'a URL, a Response, bytes or nothing');
  const url = new URL(source, globalThis.document?.baseURI ?? globalThis.location?.href);
  return url.protocol === 'file:' && !globalThis.document ? WebAssembly.compile(await readFile(url)) : compileResponse(await fetch(url, { signal }));
}

// The modules of a call to open: the default, and the value true for the decoders, are the package's own files.
function compileAll(source = new URL('./lambent.wasm', import.meta.url), { signal, decoders } = {}) {
  signal?.throwIfAborted();
  const more = decoders === true ? new URL('./decoders.wasm', import.meta.url) : decoders;
  return Promise.all([compile(source, signal), more && compile(more, signal)]);
}

export async function open(source = undefined, how = {}) {
  const [module, decoders] = await compileAll(source, how);
  return new Lambent(module, new Files(), decoders);
}

// `worker` is a function that creates the worker. It is for bundlers that do not find worker.js by its URL.
export async function openWorker(source = undefined, how = {}) {
  const { worker } = how;
  if (worker !== undefined && typeof worker !== 'function') throw typeError('openWorker', 'worker', worker, 'a function');
  const [module, decoders] = await compileAll(source, how);
  return new LambentWorker(module, worker, decoders);
}

export { Files, Lambent, LambentError, LambentWorker };
