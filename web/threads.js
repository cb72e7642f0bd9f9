// threads.js: runs Lambent with several threads. The module is build-web/threads/web/lambent.wasm. The memory is shared, so a page must be cross-origin
// isolated (docs/web.md). Each thread is a worker that runs thread.js.
//
//   const lambent = await openThreads(bytesOfLambentWasm, 4, () => new Worker(new URL('thread.js', import.meta.url), { type: 'module' }));
//   lambent.threads;          // number of drawing threads, including the caller; fewer if workers could not start
//   lambent.draw(['teapot']); // blocks until all threads are done, so a page's main thread must not call it
//   lambent.end();
import { Lambent } from './lambent.js';

const INITIAL = 256, LARGEST = 65536, SMALLEST = 4096; // pages of 64 KiB; the first two values must match the linker's (web/meson.build)
const ARRIVAL_MS = 10000;

// Returns memory for an instance and its threads. It reserves address space. If the system refuses this size, it tries smaller sizes. Throws if the system
// refuses the smallest size.
export function sharedMemory() {
  for (let maximum = LARGEST; ; maximum /= 2) {
    try {
      return new WebAssembly.Memory({ initial: INITIAL, maximum, shared: true });
    } catch (error) {
      if (maximum <= SMALLEST) throw error;
    }
  }
}

// Starts workers for an instance of the module in that memory. Returns the workers that have started.
export async function addThreads(instance, module, memory, count, startWorker) {
  const { web_thread_add, web_thread_ready } = instance.exports;
  const arrival = () =>
    new Promise((resolve) => {
      const thread = web_thread_add();
      if (!thread) return resolve(null);
      const worker = startWorker();
      const listen = (name, listener) => (worker.on ?? worker.addEventListener).call(worker, name, listener); // node's workers, or a browser's
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

// Opens a Lambent with threads. `count` is the wanted number of threads, including the caller. `progress` and `parts` are described at Lambent's constructor
// (lambent.js).
export async function openThreads(source, count, startWorker, files = undefined, progress = null, parts = []) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source), memory = sharedMemory();
  return new Threads(module, files, { memory, progress, parts }).start(module, memory, count - 1, startWorker);
}
