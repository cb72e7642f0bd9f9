// check_start.js: the worker of checks and the text editor, fetched when the tab of shaders is opened. (The one-file page has parts of its own in
// place of these functions: web/build.py.)
import { caller } from './start.js';

export function openCheck() {
  const worker = new Worker(new URL('check_worker.js', import.meta.url), { type: 'module' });
  const wasm = fetch(new URL('check.wasm', import.meta.url)).then((answer) => answer.arrayBuffer());
  return { ...caller(worker, wasm), end: () => worker.terminate() };
}

export function openCodeMirror() {
  return import('./codemirror.js');
}
