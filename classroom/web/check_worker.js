// check_worker.js: checks shaders in a separate thread, on an invisible canvas. Messages: {id, call, ...}. Answers: {id, result} or {id, error}.
import { Check } from './check.js';
import { Painter } from './painter.js';

let check = null;

const calls = {
  async start({ wasm }) {
    check = new Check(await WebAssembly.compile(wasm), new Painter(() => new OffscreenCanvas(1, 1)));
    return check.lists();
  },
  exercise: ({ mistake }) => check.exercise(mistake),
  // Returns the report with the pictures of each scene. A picture is the RGBA of size² pixels.
  check({ size, ...asked }) {
    const report = check.check({ ...asked, size });
    for (const [i, scene] of (report.scenes ?? []).entries())
      for (const which of ['theirs', 'reference', 'difference']) scene[which] = check.picture(i, which, size);
    return report;
  },
};

self.onmessage = async ({ data }) => {
  try {
    self.postMessage({ id: data.id, result: await calls[data.call](data) });
  } catch (error) {
    self.postMessage({ id: data.id, error: error.message });
  }
};
