// run.mjs THREADS MODULE WORD...: runs a WebAssembly program without files, and passes on its output and its exit code. THREADS 0 means a
// module without threads.
import { readFileSync } from 'node:fs';
import { Worker } from 'node:worker_threads';
import { addThreads, sharedMemory } from '../../web/threads.js';
import { Exit, Files, run, system } from '../../web/wasi.js';

const [threads, file, ...words] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(file));
const print = (stream, text) => (stream === 1 ? process.stdout : process.stderr).write(text);

// The exit code of a program with threads, which are started in advance.
async function runThreads(count) {
  const host = system(new Files(), ['program', ...words], print), memory = sharedMemory();
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1, env: { memory } });
  host.attach(instance);
  const workers = await addThreads(instance, module, memory, count - 1, () => new Worker(new URL('../../web/thread.js', import.meta.url)));
  if (workers.length !== count - 1) throw new Error(`${workers.length} of ${count - 1} threads have started`);
  try {
    instance.exports._start();
    return 0;
  } catch (error) {
    if (error instanceof Exit) return error.code;
    throw error;
  } finally {
    for (const worker of workers) worker.terminate();
  }
}

process.exitCode = Number(threads) ? await runThreads(Number(threads)) : run(module, new Files(), ['program', ...words], print);
