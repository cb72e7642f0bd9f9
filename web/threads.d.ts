// threads.d.ts: the types of threads.js.
import type { Files, Lambent } from './lambent.js';

export interface ThreadedLambent extends Lambent {
  /** Threads that draw, the caller's among them. */
  readonly threads: number;
  /** Ends the other threads. It must not be called any more. */
  end(): void;
}

/**
 * Opens build-web/threads/web/lambent.wasm. A page must be cross-origin isolated, and call it in a worker, since a drawing waits.
 * @param count threads that are wanted, the caller's among them
 * @param startWorker starts a worker that runs thread.js, of the browser or of node:worker_threads
 * @param progress is called with the share of a drawing that is done, 0 to 1
 * @param parts of a module in parts, those besides the first
 */
export function openThreads(source: BufferSource | WebAssembly.Module, count: number, startWorker: () => unknown, files?: Files,
  progress?: ((share: number) => void) | null, parts?: WebAssembly.Module[]): Promise<ThreadedLambent>;
