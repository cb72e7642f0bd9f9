// drawing.js: draws the command line in the worker: of waiting drawings the newest alone, with one sample while something moves.
import { call, emit, on, refuse, state, view } from './app.js';
import { $ } from './dom.js';
import { text } from './strings.js';

const canvas = $('canvas'), context = canvas.getContext('2d');
let busy = false, wanted = null;

async function draw() {
  wanted = { words: state.words, quick: view.moving };
  if (busy) return;
  busy = true;
  while (wanted) {
    const task = wanted;
    wanted = null;
    try {
      const words = task.quick ? [...task.words.filter((word) => !word.startsWith('--samples')), '--samples=1'] : task.words;
      show(await call('draw', { words }), task);
    } catch (error) {
      refuse(error.message);
    }
  }
  busy = false;
}

function show({ pixels, ...picture }, task) {
  canvas.width = picture.width;
  canvas.height = picture.height;
  context.putImageData(new ImageData(pixels, picture.width, picture.height), 0, 0);
  view.picture = picture;
  if (!view.moving) ({ camera: view.camera, sphere: view.sphere } = picture);
  document.body.dataset.drawn = task.quick ? '' : JSON.stringify(task.words);
  $('message').hidden = true;
  showStatus(picture);
  emit('picture');
  if (!task.quick && !view.moving) emit('still');
}

function showStatus({ width, height, triangles, frame_ms, warnings }) {
  const line = text('status', { width, height, triangles: triangles.toLocaleString('en'), ms: Math.round(frame_ms) });
  $('status').textContent = line;
  $('warnings').textContent = warnings.join(' · ');
}

on('words', draw);
