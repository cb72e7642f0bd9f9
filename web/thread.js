// thread.js: a worker that runs a thread of a module (threads.js), with its own instance in the shared memory. The thread has no files, and its other imports
// do nothing. It loads only the first part of a divided module, because only the main thread runs code of the other parts.
import { Files, system } from './wasi.js';

const missing = new Proxy({}, {
  get: () => () => {
    throw new Error('a thread has no other parts of the module');
  },
});

function start(port, { module, memory, thread }) {
  const host = system(new Files(), [], (stream, text) => console.error(text));
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1, 'threads-more': missing, unused: missing, env: new Proxy({ memory }, { get: (given, name) => given[name] ?? (() => 0) }) });
  host.attach(instance);
  const { __stack_pointer, web_thread_run, web_thread_failed } = instance.exports;
  __stack_pointer.value = thread; // the thread's stack starts at this address and grows downwards
  port.postMessage('ready');
  try {
    web_thread_run(thread); // does not return
  } catch (error) {
    web_thread_failed();
    throw error;
  }
}

if (typeof self === 'object') self.onmessage = ({ data }) => start(self, data);
else import('node:worker_threads').then(({ parentPort }) => parentPort.once('message', (data) => start(parentPort, data)));
