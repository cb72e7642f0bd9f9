// check_start.js: starts the worker of checks and the text editor. The page fetches this file when the tab of shaders is opened.
import { caller } from '../worker/caller.js';
import { insideScript, insideStream, insideText } from '../base/inside.js';
import { fetchModule } from '../worker/start.js';

let wasm = null; // a promise, shared by all workers; reset if loading fails

export function openCheck() {
  wasm ??= (ONE_FILE ? insideStream('check-wasm').arrayBuffer() : fetchModule('check.wasm')).catch((error) => {
    wasm = null;
    throw error;
  });
  return caller(() => (ONE_FILE ? new Worker(insideScript(insideText('check-worker'))) : new Worker(new URL('check_worker.js', import.meta.url), { type: 'module' })), wasm);
}

export async function openCodeMirror() {
  return ONE_FILE ? import(insideScript(await insideStream('codemirror').text())) : import('./codemirror.js');
}
