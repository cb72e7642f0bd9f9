// thumbnails.js: draws small pictures of choices. They are drawn by a second worker, so that the first worker keeps the page's model loaded. The second worker
// is started after the first picture, or after the message that there is no picture. It is ended when all small pictures are drawn.
import { on, view } from '../shared/app.js';
import { MODULE_BYTES } from '../base/memory.js';
import { openWorker } from '../worker/start.js';

const made = new Map(); // the ImageData of each picture, by its words
let waiting = [], isRunning = false;

// Draws the picture of the words on a canvas, immediately or later.
export function thumbnail(canvas, words) {
  waiting.push({ canvas, words });
  if (view.isIdle) work();
}
on('idle', work);

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
    waiting = []; // the choices without pictures still show their names
  }
  worker?.end();
  isRunning = false;
}
