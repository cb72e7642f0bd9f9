// threads.js: Lambent with several threads, from build-web/threads/web/lambent.wasm. Their memory is shared, so a page must be cross-origin isolated
// (docs/web.md). Each is a worker that runs thread.js.
//
//   const lambent = await openThreads(bytesOfLambentWasm, 4, () => new Worker(new URL('thread.js', import.meta.url), { type: 'module' }));
//   lambent.threads;                   // that draw, the caller's among them; fewer where workers could not be started
//   const picture = lambent.draw(...); // waits for the others: the main thread of a page must not
//   lambent.end();
import { Lambent } from './lambent.js';

const INITIAL = 256, LARGEST = 65536, SMALLEST = 4096; // pages of 64 KiB; the first two are the linker's (web/meson.build)
const ARRIVAL_MS = 10000;

// Memory for an instance and its threads. Its address space is reserved: less of it where the system refuses more. Throws where it refuses all.
export function sharedMemory() {
  for (let maximum = LARGEST; ; maximum /= 2) {
    try {
      return new WebAssembly.Memory({ initial: INITIAL, maximum, shared: true });
    } catch (error) {
      if (maximum <= SMALLEST) throw error;
    }
  }
}

// Starts workers for an instance of the module in that memory. Their list, of those that have arrived.
export async function addThreads(instance, module, memory, count, startWorker) {
  const { web_thread_add, web_thread_ready } = instance.exports;
  const arrival = () =>
    new Promise((resolve) => {
      const thread = web_thread_add();
      if (!thread) return resolve(null);
      const worker = startWorker();
      const listen = (name, listener) => (worker.on ?? worker.addEventListener).call(worker, name, listener); // node's workers; a browser's
      listen('message', () => {
        web_thread_ready(thread);
        resolve(worker);
      });
      listen('error', () => resolve(null));
      worker.postMessage({ module, memory, thread });
      setTimeout(() => resolve(null), ARRIVAL_MS).unref?.();
    });
  return (await Promise.all(Array.from({ length: count }, arrival))).filter(Boolean);
}

class Threads extends Lambent {
  #workers = [];
  threads = 1;

  async start(module, memory, count, startWorker) {
    this.#workers = await addThreads(this.instance, module, memory, count, startWorker);
    this.threads += this.#workers.length;
    return this;
  }

  end() {
    for (const worker of this.#workers) worker.terminate();
  }
}

// `count`: threads that are wanted, the caller's among them. `progress` and `parts`: as Lambent's.
export async function openThreads(source, count, startWorker, files = undefined, progress = null, parts = []) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source), memory = sharedMemory();
  return new Threads(module, files, { memory, progress, parts }).start(module, memory, count - 1, startWorker);
}
