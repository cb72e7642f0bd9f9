// worker.js: draws in a thread of its own. Messages: {id, call, ...}; answers: {id, result} or {id, error}. Of drawings that wait,
// the page sends the newest alone.
import { Lambent, LambentError } from './lambent.js';

let lambent = null;

const calls = {
  async start({ wasm }) {
    lambent = new Lambent(await WebAssembly.compile(wasm));
    return lambent.options();
  },
  files({ files }) {
    for (const path of lambent.files.list()) lambent.files.delete(path);
    for (const [path, bytes] of files) lambent.files.set(path, bytes);
    lambent.forget();
    return null;
  },
  draw: ({ words }) => lambent.draw(words),
  save: ({ words, ending }) => lambent.save(words, ending),
  explain: ({ words, x, y }) => lambent.explain(words, x, y),
  curves: ({ words, of }) => lambent.curves(words, of),
  lights: ({ words }) => lambent.lights(words),
  scene: ({ words }) => lambent.scene(words),
};

self.onmessage = async ({ data }) => {
  try {
    const result = await calls[data.call](data);
    const moved = result?.pixels ? [result.pixels.buffer] : [];
    self.postMessage({ id: data.id, result }, moved);
  } catch (error) {
    self.postMessage({ id: data.id, error: error.message, refused: error instanceof LambentError });
  }
};
