// worker.js: draws in a thread of its own. Messages: {id, call, ...}; answers: {id, result}, {id, error}, or {id, missing}: the call needs the second
// part of the module, which the page fetches, and then asks again. Of drawings that wait, the page sends the newest alone.
import { Lambent, LambentError, PartMissing } from './lambent.js';

let lambent = null, first = null, broken = false, memory = 0;

function use(made) {
  lambent = made;
  lambent.limitMemory(memory);
}

const calls = {
  async start({ wasm, memory: bytes }) {
    memory = bytes;
    first = await WebAssembly.compile(wasm);
    use(new Lambent(first));
    return lambent.options();
  },
  // A Lambent that has asked for the second part is replaced, or gives way to one with threads; one that has not yet only gets it.
  async complete({ wasm, threads }) {
    if (threads) {
      const { openThreads } = await import('./threads.js');
      use(await openThreads(wasm, threads.count, () => new Worker(threads.script, { type: 'module' }), lambent.files));
      broken = false;
      return { threads: lambent.threads };
    }
    const second = await WebAssembly.compile(wasm);
    if (broken) use(new Lambent(first, lambent.files, { second }));
    else lambent.complete(second);
    broken = false;
    return { threads: 1 };
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
    if (broken && data.call !== 'complete') throw new PartMissing();
    const result = await calls[data.call](data);
    const moved = result?.pixels ? [result.pixels.buffer] : [];
    self.postMessage({ id: data.id, result }, moved);
  } catch (error) {
    if (error instanceof PartMissing) {
      broken = true;
      self.postMessage({ id: data.id, missing: true });
    } else self.postMessage({ id: data.id, error: error.message, refused: error instanceof LambentError });
  }
};
