// start.js: the worker, and calls to it. (The one-file page has a part of its own in place of this one: web/build.py.)
import { text } from './strings.js';

export function openWorker() {
  const worker = new Worker(new URL('worker.js', import.meta.url), { type: 'module' });
  // Fetches the module, and says how much of it is there.
  const load = async (address) => {
    const answer = await fetch(address), whole = Number(answer.headers.get('content-length')), packed = answer.headers.get('content-encoding');
    if (!answer.ok) throw new Error(text('notLoaded', { name: 'lambent.wasm', code: answer.status }));
    const parts = [], reader = answer.body.getReader();
    for (let size = 0, part; !(part = await reader.read()).done; ) {
      parts.push(part.value);
      size += part.value.length;
      const amount = whole && !packed ? `${Math.min(100, Math.round((100 * size) / whole))} %` : `${Math.round(size / 1000)} kB`;
      document.getElementById('status').textContent = text('loading', { name: 'lambent.wasm', amount });
    }
    return new Blob(parts).arrayBuffer();
  };
  const rest = () => fetch(new URL('lambent-rest.wasm', import.meta.url)).then((answer) => {
    if (!answer.ok) throw new Error(text('notLoaded', { name: 'lambent-rest.wasm', code: answer.status }));
    return answer.arrayBuffer();
  });
  return caller(worker, load(new URL('lambent.wasm', import.meta.url)), rest);
}

// `rest`: fetches the second part of a module that is in two (web/build.py); null: it is whole.
export function caller(worker, wasm, rest = null) {
  const waiting = new Map();
  let next = 0, complete = null;
  const send = (message) =>
    new Promise((resolve, reject) => {
      message.id = next++;
      waiting.set(message.id, { message, resolve, reject });
      worker.postMessage(message);
    });
  // Once; and again after an attempt that has failed.
  const fetchRest = () =>
    (complete ??= rest().then((bytes) => send({ call: 'complete', wasm: bytes })).catch((error) => {
      complete = null;
      throw error;
    }));
  worker.onmessage = ({ data }) => {
    const { message, resolve, reject } = waiting.get(data.id);
    waiting.delete(data.id);
    if (data.missing) fetchRest().then(() => send(message)).then(resolve, reject);
    else if (data.error === undefined) resolve(data.result);
    else reject(new Error(data.error));
  };
  worker.onerror = (event) => {
    for (const { reject } of waiting.values()) reject(new Error(event.message || text('workerEnded')));
    waiting.clear();
  };
  return {
    async call(name, message) {
      const whole = { ...message, call: name };
      if (name === 'start') whole.wasm = await wasm;
      return send(whole);
    },
    // What the first pictures do not need, before it is needed.
    fetchRest: () => (rest ? fetchRest() : Promise.resolve()),
  };
}
