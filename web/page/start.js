// start.js: the worker, and calls to it. (The one-file page has a part of its own in place of this one: web/build.py.)
import { text } from './strings.js';

// The bytes of a module beside the page. `progress`: called with the bytes that are there, and how many there will be (0: unknown).
export async function fetchModule(name, progress = () => {}) {
  const answer = await fetch(new URL(name, import.meta.url)).catch(() => {
    throw new Error(text('notReached', { name }));
  });
  if (!answer.ok) throw new Error(text('notLoaded', { name, code: answer.status }));
  const whole = answer.headers.get('content-encoding') ? 0 : Number(answer.headers.get('content-length')), parts = [], reader = answer.body.getReader();
  try {
    for (let size = 0, part; !(part = await reader.read()).done; ) {
      parts.push(part.value);
      progress((size += part.value.length), whole);
    }
  } catch {
    throw new Error(text('notReached', { name }));
  }
  return new Blob(parts).arrayBuffer();
}

export function openWorker() {
  const name = 'lambent.wasm', worker = new Worker(new URL('worker.js', import.meta.url), { type: 'module' });
  const wasm = fetchModule(name, (size, whole) => {
    const amount = whole ? `${Math.min(100, Math.round((100 * size) / whole))} %` : `${Math.round(size / 1000)} kB`;
    document.getElementById('status').textContent = text('loading', { name, amount });
  });
  const rest = async () => ({ wasm: await fetchModule('lambent-rest.wasm') });
  return caller(worker, wasm, [...withThreads(() => fetchModule('lambent-threads.wasm'), new URL('thread.js', import.meta.url)), rest]);
}

const THREADS_MAX = 16;

// Where the page may share memory with its workers, a way to the module with threads (web/threads.js), which takes the place of the one that has drawn
// the first picture.
export function withThreads(load, script) {
  const count = Math.min(navigator.hardwareConcurrency, THREADS_MAX);
  return crossOriginIsolated && count > 1 ? [async () => ({ wasm: await load(), threads: { count, script: String(script) } })] : [];
}

// `rest`: ways to what the module lacks, of which the first that succeeds is taken: the second part of one that is in two (web/build.py), or one with
// threads. None: it is whole.
export function caller(worker, wasm, rest = []) {
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
    (complete ??= rest.reduce((before, way) => before.catch(async () => send({ call: 'complete', ...(await way()) })), Promise.reject()).then(({ threads }) => {
      document.body.dataset.threads = threads;
    }, (error) => {
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
    fetchRest: () => (rest.length ? fetchRest() : Promise.resolve()),
  };
}
