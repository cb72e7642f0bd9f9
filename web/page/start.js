// start.js: the worker, and calls to it. (The one-file page has a part of its own in place of this one: web/build.py.)
import { text } from './strings.js';

export function openWorker() {
  const worker = new Worker(new URL('worker.js', import.meta.url), { type: 'module' });
  const wasm = fetch(new URL('lambent.wasm', import.meta.url)).then((answer) => answer.arrayBuffer());
  return caller(worker, wasm);
}

export function caller(worker, wasm) {
  const waiting = new Map();
  let next = 0;
  worker.onmessage = ({ data }) => {
    const { resolve, reject } = waiting.get(data.id);
    waiting.delete(data.id);
    if (data.error === undefined) resolve(data.result);
    else reject(new Error(data.error));
  };
  worker.onerror = (event) => {
    for (const { reject } of waiting.values()) reject(new Error(event.message || text('workerEnded')));
    waiting.clear();
  };
  return {
    async call(name, message) {
      const whole = { ...message, call: name, id: next++ };
      if (name === 'start') whole.wasm = await wasm;
      return new Promise((resolve, reject) => {
        waiting.set(whole.id, { resolve, reject });
        worker.postMessage(whole);
      });
    },
  };
}
