// thumbnails.js: small pictures of choices, drawn by Lambent in a worker of their own, so that the page's model stays loaded in the other one. It starts
// when the first picture is there, and ends when no small picture is wanted.
import { on, view } from './app.js';
import { MODULE_BYTES } from './memory.js';
import { openWorker } from './start.js';

const made = new Map(); // by words: ImageData
let waiting = [], isRunning = false;

// Draws the picture of words on a canvas, now or later.
export function thumbnail(canvas, words) {
  waiting.push({ canvas, words });
  if (view.picture) work();
}
on('still', work);

function show(canvas, image) {
  Object.assign(canvas, { width: image.width, height: image.height });
  canvas.getContext('2d').putImageData(image, 0, 0);
}

async function work() {
  if (isRunning || !waiting.length) return;
  isRunning = true;
  let worker = null;
  try {
    while (waiting.length) {
      const { canvas, words } = waiting.shift(), key = words.join('\n');
      if (!made.has(key)) {
        if (!worker) await (worker = openWorker({ helps: true })).call('start', { memory: MODULE_BYTES });
        const { pixels, width, height } = await worker.call('draw', { words });
        made.set(key, new ImageData(pixels, width, height));
      }
      show(canvas, made.get(key));
    }
  } catch {
    waiting = []; // a choice without its picture still has its name
  }
  worker?.end();
  isRunning = false;
}
