// threads.d.ts: the types of threads.js.
import type { Files, Lambent } from './lambent.js';

export interface ThreadedLambent extends Lambent {
  /** The number of drawing threads, including the caller. */
  readonly threads: number;
  /** Ends the other threads. The object cannot be used afterwards. */
  end(): void;
}

/**
 * Opens the module with threads (build-web/threads/web/lambent.wasm). A page must be cross-origin isolated. It must call this function in a worker, because
 * drawing blocks the caller.
 * @param source the bytes of the module, or the compiled module
 * @param count the wanted number of threads, including the caller
 * @param startWorker starts a worker that runs thread.js and returns it: a Worker of the browser or of node:worker_threads
 * @param files files in memory; default: no files
 * @param progress called repeatedly during drawing, with the finished fraction from 0 to 1
 * @param parts the loaded parts of a divided module, besides the first part
 */
export function openThreads(source: BufferSource | WebAssembly.Module, count: number, startWorker: () => unknown, files?: Files,
  progress?: ((share: number) => void) | null, parts?: WebAssembly.Module[]): Promise<ThreadedLambent>;
