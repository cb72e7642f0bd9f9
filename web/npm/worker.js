// worker.js: the worker of a LambentWorker (client.js), in browsers and in node.
import { Lambent } from './drawing.js';

let lambent = null;

function answer({ method, args, files, watch }, post) {
  for (const [path, bytes] of files) bytes ? lambent.files.set(path, bytes) : lambent.files.delete(path);
  const more = watch ? { onProgress: (share) => post({ share }) } : {};
  if (method === 'draw') args[1] = { ...args[1], ...more };
  const found = lambent[method](...args), pixels = found.pixels ?? found;
  post({ answer: found }, ArrayBuffer.isView(pixels) ? [pixels.buffer] : []);
}

function take(data, post) {
  if (data.module) {
    lambent = new Lambent(data.module, undefined, data.decoders);
    return;
  }
  try {
    answer(data, post);
  } catch (error) {
    post({ error: { kind: error.name, message: error.message, code: error.code } });
  }
}

if (typeof self === 'object') self.onmessage = ({ data }) => take(data, (message, list = []) => self.postMessage(message, list));
else {
  const name = 'node:worker_threads';
  import(/* @vite-ignore */ /* webpackIgnore: true */ name).then(({ parentPort }) => parentPort.on('message', (data) => take(data, (message, list = []) => parentPort.postMessage(message, list))));
}
