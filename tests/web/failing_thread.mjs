// failing_thread.mjs: replaces web/thread.js by a thread that fails as soon as it starts.
import { parentPort } from 'node:worker_threads';
import { Files, system } from '../../web/wasi.js';

parentPort.once('message', ({ module, memory }) => {
  const host = system(new Files(), [], () => {});
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1, env: new Proxy({ memory }, { get: (given, name) => given[name] ?? (() => 0) }) });
  parentPort.postMessage('ready');
  instance.exports.web_thread_failed();
});
