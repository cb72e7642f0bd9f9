// start.js: starts the worker and calls it. ONE_FILE (web/bundle.py) is true in the one-file page. That page contains the modules that the served page fetches.
import { caller } from './caller.js';
import { insideScript, insideStream, insideText } from '../base/inside.js';
import { text } from '../base/strings.js';

// Fetches a module beside the page. `progress` is called with the number of received bytes and the total number. The total is 0 if it is unknown.
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

// Fetches a module as fetchModule() does, but each module only once.
const modules = new Map();
function moduleOnce(name, progress) {
  if (!modules.has(name)) modules.set(name, fetchModule(name, progress).catch((error) => (modules.delete(name), Promise.reject(error))));
  return modules.get(name);
}

// `helps` means that the worker is a second worker with one thread, for small pictures.
export function openWorker({ helps = false } = {}) {
  if (ONE_FILE) {
    const served = document.getElementById('served'), threads = served && JSON.parse(served.textContent).threads; // in the page of `lambent view`
    const script = insideScript(insideText('worker')), load = async () => (await import('./served.js')).fetchThreads();
    const decoders = [async () => ({ wasm: await insideStream('decoders').arrayBuffer() })];
    return caller(() => new Worker(script), insideStream('wasm').arrayBuffer(), { decoders, ...(threads && !helps ? { rest: withThreads(load, insideScript(insideText('thread'))) } : {}), helps });
  }
  const name = 'lambent.wasm', script = new URL('worker.js', import.meta.url);
  const wasm = moduleOnce(name, (size, whole) => {
    const amount = whole ? `${Math.min(100, Math.round((100 * size) / whole))} %` : `${Math.round(size / 1000)} kB`;
    document.getElementById('status').textContent = text('loading', { name, amount });
  });
  const part = (name) => async () => ({ wasm: await moduleOnce(`lambent-${name}.wasm`) });
  return caller(() => new Worker(script, { type: 'module' }), wasm, {
    rest: [...(helps ? [] : withThreads(() => fetchModule('lambent-threads.wasm'), new URL('thread.js', import.meta.url))), part('rest')],
    more: [part('more')],
    'threads-more': [part('threads-more')],
    decoders: [part('decoders')],
    helps,
  });
}

const THREADS_MAX = 16;

// Returns a list with a function that fetches the module with threads (web/threads.js). The list is empty if the page cannot share memory with its workers. The
// module with threads replaces the module that has drawn the first picture.
function withThreads(load, script) {
  const count = Math.min(navigator.hardwareConcurrency, THREADS_MAX);
  return crossOriginIsolated && count > 1 ? [async () => ({ wasm: await load(), threads: { count, script: String(script) } })] : [];
}
