// check_start.js: the worker of checks and the text editor, fetched when the tab of shaders is opened. (The one-file page has parts of its own in
// place of these functions: web/build.py.)
import { caller, fetchModule } from './start.js';

let wasm = null; // a promise, for all workers; an attempt that fails is forgotten

export function openCheck() {
  wasm ??= fetchModule('check.wasm').catch((error) => {
    wasm = null;
    throw error;
  });
  const worker = new Worker(new URL('check_worker.js', import.meta.url), { type: 'module' });
  return { ...caller(worker, wasm), end: () => worker.terminate() };
}

export async function openCodeMirror() {
  return import(new URL('codemirror.js', import.meta.url));
}
