// drawing.js: draws the command line in the worker: of waiting drawings the newest alone, with one sample and fewer pixels while something moves; and
// places the picture in the page, as large as there is room.
import { call, emit, on, refuse, say, state, view } from './app.js';
import { $ } from './dom.js';
import { text } from './strings.js';

const canvas = $('canvas'), context = canvas.getContext('2d'), QUICK = 5e5; // pixels
let busy = false, busyStill = false, wanted = null, model = null;

// A quick picture's words: one sample, and half of the width and height if it is large.
export function quickWords(words) {
  const [, width, height = width] = /^(\d+)(?:x(\d+))?$/.exec(state.values('size').at(-1) ?? '1024') ?? [], few = words.filter((word) => !word.startsWith('--samples'));
  const sized = width * height > QUICK ? [...few.filter((word) => !word.startsWith('--size')), `--size=${Math.round(width / 2)}x${Math.round(height / 2)}`] : few;
  return [...sized, '--samples=1'];
}

async function draw() {
  wanted = { words: state.words, quick: view.moving };
  if (busy) {
    if (busyStill) view.giveUpPicture?.();
    return;
  }
  busy = true;
  while (wanted) {
    const task = wanted;
    wanted = null;
    busyStill = !task.quick;
    try {
      const [name] = task.words;
      if (name !== model) $('status').textContent = text('loadingModel', { name: name.replace(/^\//, '') });
      canvas.setAttribute('aria-busy', String(name !== model));
      show(await call('draw', { words: task.quick ? quickWords(task.words) : task.words }), task);
      model = name;
    } catch (error) {
      $('status').textContent = '';
      if (!wanted) refuse(error.message);
    }
    canvas.setAttribute('aria-busy', 'false');
  }
  busy = false;
}

function show({ pixels, ...picture }, task) {
  canvas.width = picture.width;
  canvas.height = picture.height;
  context.putImageData(new ImageData(pixels, picture.width, picture.height), 0, 0);
  view.picture = picture;
  if (!task.quick || !view.size) view.size = { width: picture.width, height: picture.height };
  if (!view.moving) ({ camera: view.camera, sphere: view.sphere } = picture);
  document.body.dataset.drawn = task.quick ? '' : JSON.stringify(task.words);
  $('message').hidden = true;
  showStatus(picture);
  fit();
  emit('picture');
  if (!task.quick && !view.moving) emit('still');
}

function showStatus({ width, height, triangles, frame_ms, warnings }) {
  const line = text('status', { width, height, triangles: triangles.toLocaleString('en'), ms: Math.round(frame_ms) });
  $('status').textContent = line;
  $('warnings').textContent = warnings.join(' · ');
}

// As large as there is room for, in the middle; its pixels are seen as squares from three times their size.
export function fit() {
  const { width, height } = view.size ?? canvas, room = $('view'), k = Math.min(room.clientWidth / width, room.clientHeight / height);
  const box = { left: (room.clientWidth - k * width) / 2, top: (room.clientHeight - k * height) / 2, width: k * width, height: k * height };
  for (const one of [canvas, $('overlay')]) for (const [name, value] of Object.entries(box)) one.style[name] = `${value}px`;
  canvas.style.imageRendering = k * devicePixelRatio >= 3 ? 'pixelated' : 'auto';
  emit('fit');
}
new ResizeObserver(fit).observe($('view'));

on('words', draw);

// For those who hear the page: from where the model is seen, once a turn has come to an end.
let heard = null, last = '';
on('still', () => {
  clearTimeout(heard);
  const { camera, sphere } = view.picture, [x, y, z] = camera.eye.map((part, i) => part - camera.target[i]), [px, py, pz] = camera.pole;
  const far = Math.hypot(x, y, z), above = Math.round((Math.asin((x * px + y * py + z * pz) / far) * 180) / Math.PI);
  const around = Math.round((Math.atan2(x, py > 0.5 ? z : -y) * 180) / Math.PI), sentence = text('viewChanged', { around, above, far: (far / sphere.radius).toFixed(1) });
  if (last && sentence !== last) heard = setTimeout(() => say(sentence), 700);
  last = sentence;
});
