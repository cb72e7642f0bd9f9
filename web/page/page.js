// page.js: the page: files come in, gestures and controls change the words of a command line (state.js), and a worker draws them.
import { around, cameraText, orbit, pan, zoom } from './camera.js';
import { droppedFiles } from './dropped.js';
import { State, command, fromFragment, toFragment } from './state.js';
import { explanation } from './explanation.js';
import { insideWords, takeInsideFiles } from './inside.js';
import { Panel } from './panel.js';
import { openWorker } from './start.js';

const $ = (id) => document.getElementById(id);
const canvas = $('canvas'), context = canvas.getContext('2d');
const START = ['teapot', '--size=960x720'];
const MODELS = /\.(obj|stl|ply|gltf|glb|json)$/i;
// What makes the view; a camera takes the place of all of them.
const VIEW = ['view', 'azimuth', 'elevation', 'zoom', 'projection'];

const state = new State(fromFragment(location.hash) ?? insideWords() ?? START);
let shapes = [], files = new Map(), camera = null, sphere = null, panel = null, moving = false;

// --- the worker: the newest drawing alone waits

const { call } = openWorker();
let busy = false, wanted = null, drawnWords = null;

async function draw(words, quick) {
  wanted = { words, quick };
  if (busy) return;
  busy = true;
  while (wanted) {
    const task = wanted;
    wanted = null;
    try {
      const fast = task.quick ? [...task.words.filter((word) => !word.startsWith('--samples')), '--samples=1'] : task.words;
      show(await call('draw', { words: fast }), task);
    } catch (error) {
      refuse(error.message);
    }
  }
  busy = false;
}

function show(picture, task) {
  canvas.width = picture.width;
  canvas.height = picture.height;
  context.putImageData(new ImageData(picture.pixels, picture.width, picture.height), 0, 0);
  if (!moving) ({ camera, sphere } = picture);
  drawnWords = task.quick ? null : task.words;
  document.body.dataset.drawn = drawnWords ? JSON.stringify(drawnWords) : '';
  $('message').hidden = true;
  $('status').textContent = `${picture.width}×${picture.height}, ${picture.triangles.toLocaleString('en')} triangles, ` +
    `${Math.round(picture.frame_ms)} ms${picture.warnings.length ? ' · ' + picture.warnings.join(' · ') : ''}`;
}

function refuse(sentence) {
  $('message').textContent = sentence;
  $('message').hidden = false;
}

// --- the state

function update() {
  $('command').textContent = command(state.words);
  $('undo').disabled = !state.canUndo;
  $('redo').disabled = !state.canRedo;
  if (!moving) history.replaceState(null, '', toFragment(state.words));
  showModels();
  if (!moving) panel?.show(state);
  draw(state.words, moving);
}
state.onchange = update;

function showModels() {
  const own = [...files.keys()].filter((path) => MODELS.test(path));
  const names = [...own, ...shapes];
  if (!names.includes(state.model)) names.unshift(state.model);
  const wantedNames = names.join('\n');
  if ($('model').dataset.names !== wantedNames) {
    $('model').replaceChildren(...names.map((name) => new Option(name.replace(/^\//, ''), name)));
    $('model').dataset.names = wantedNames;
  }
  $('model').value = state.model;
}

// Another model is seen whole: its own view.
function takeModel(name) {
  state.set([name, ...state.words.slice(1).filter((word) => !word.startsWith('--camera'))]);
}

function setCamera(next, gesture) {
  const text = cameraText(next);
  let words = state.words.filter((word, i) => i === 0 || !VIEW.some((name) => word === `--${name}` || word.startsWith(`--${name}=`)));
  const other = new State(words);
  words = other.withValues('camera', [text]);
  camera = { ...next, ...readCamera(text) };
  state.set(words, gesture);
}

// The numbers that a text says: the next step starts from them.
function readCamera(text) {
  const parts = Object.fromEntries(text.split(',').map((part) => part.split('=')));
  const triple = (v) => v.split('/').map(Number);
  return { eye: triple(parts.eye), target: triple(parts.target), up: triple(parts.up),
    ortho: parts.ortho ? Number(parts.ortho) : 0, fovy_deg: parts.fovy ? Number(parts.fovy) : 30 };
}

// --- gestures

let gesture = 0, still = 0;
const pointers = new Map();

function begin() {
  moving = true;
  clearTimeout(still);
}

function end() {
  clearTimeout(still);
  still = setTimeout(() => {
    moving = false;
    gesture++;
    state.endGesture();
    update();
  }, 120);
}

// The first turn of a view that the program has fitted begins with a fit for all angles.
function turn(right, up) {
  if (!state.values('camera').length) camera = around(camera, sphere, canvas.width / canvas.height);
  move(orbit(camera, right, up, camera.pole, sphere.centre));
}

function move(next) {
  begin();
  setCamera(next, `gesture ${gesture}`);
}

canvas.addEventListener('pointerdown', (event) => {
  if (!camera) return;
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, from: [event.clientX, event.clientY] });
});

canvas.addEventListener('pointermove', (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const x = event.clientX - before.x, y = event.clientY - before.y, size = canvas.clientHeight;
  if (Math.hypot(event.clientX - before.from[0], event.clientY - before.from[1]) < 4 && !before.moved) return;
  before.moved = true;
  if (pointers.size === 2) {
    const [a, b] = [...pointers.values()], other = a === before ? b : a;
    const apart = (p, q) => Math.max(10, Math.hypot(p.x - q.x, p.y - q.y));
    const factor = apart({ x: event.clientX, y: event.clientY }, other) / apart(before, other);
    move(zoom(pan(camera, x / 2 / size, -y / 2 / size), factor));
  } else if (event.shiftKey || event.buttons & 6) {
    move(pan(camera, x / size, -y / size));
  } else {
    turn((-x / size) * Math.PI, (y / size) * Math.PI);
  }
  before.x = event.clientX;
  before.y = event.clientY;
});

for (const name of ['pointerup', 'pointercancel'])
  canvas.addEventListener(name, (event) => {
    const pointer = pointers.get(event.pointerId);
    pointers.delete(event.pointerId);
    if (!pointer) return;
    if (pointer.moved) end();
    else if (name === 'pointerup') explainAt(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight);
  });
canvas.addEventListener('contextmenu', (event) => event.preventDefault());

canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  if (!camera) return;
  move(zoom(camera, Math.exp(-Math.max(-100, Math.min(100, event.deltaY)) * 0.0015)));
  end();
}, { passive: false });

canvas.addEventListener('keydown', (event) => {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const arrow = arrows[event.key], step = Math.PI / 24;
  if (!camera || event.ctrlKey || event.metaKey) return;
  if (arrow && event.shiftKey) move(pan(camera, arrow[0] * 0.05, arrow[1] * 0.05));
  else if (arrow) turn(arrow[0] * step, arrow[1] * step);
  else if (event.key === '+' || event.key === '=') move(zoom(camera, 1.15));
  else if (event.key === '-') move(zoom(camera, 1 / 1.15));
  else if (event.key === 'Home') state.set(state.withValues('camera', []));
  else if (event.key === 'Enter') explainAt(0.5, 0.5);
  else return;
  event.preventDefault();
  if (moving) end();
});

addEventListener('keydown', (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches('input')) return;
  if (event.key === 'z') (event.shiftKey ? state.redo() : state.undo(), event.preventDefault());
  if (event.key === 'y') (state.redo(), event.preventDefault());
});

// --- explaining a point

async function explainAt(across, down) {
  const x = Math.min(canvas.width - 1, Math.floor(across * canvas.width)), y = Math.min(canvas.height - 1, Math.floor(down * canvas.height));
  const words = state.words.filter((word) => !word.startsWith('--show'));
  try {
    $('explain').replaceChildren(explanation(await call('explain', { words, x, y })));
    $('explain').hidden = false;
  } catch (error) {
    refuse(error.message);
  }
}

// --- files

async function takeFiles(list) {
  const taken = new Map();
  for (const [path, file] of list) taken.set('/' + path, new Uint8Array(await file.arrayBuffer()));
  if (!taken.size) return;
  files = taken;
  await call('files', { files: [...files] });
  const models = [...files.keys()].filter((path) => MODELS.test(path)).sort((a, b) => a.split('/').length - b.split('/').length || (a < b ? -1 : 1));
  if (models.length) takeModel(models[0]);
  else refuse(`${[...files.keys()].map((path) => path.slice(1)).join(', ')}: no model among the files, expected .obj, .stl, .ply, .gltf, .glb or a scene file`);
  if (models[0] === state.model) update(); // new contents under an old name
}

$('open').onclick = () => $('files').click();
$('open-folder').onclick = () => $('folder').click();
for (const id of ['files', 'folder'])
  $(id).onchange = (event) => {
    takeFiles([...event.target.files].map((file) => [file.webkitRelativePath || file.name, file]));
    event.target.value = '';
  };

addEventListener('dragover', (event) => {
  event.preventDefault();
  $('drop').hidden = false;
});
addEventListener('dragleave', (event) => {
  if (!event.relatedTarget) $('drop').hidden = true;
});
addEventListener('drop', async (event) => {
  event.preventDefault();
  $('drop').hidden = true;
  takeFiles(await droppedFiles(event.dataTransfer));
});

// --- the bar

$('model').onchange = (event) => takeModel(event.target.value);
$('undo').onclick = () => state.undo();
$('redo').onclick = () => state.redo();

async function copy(text, button) {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    getSelection().selectAllChildren($('command'));
    button.textContent = 'Selected: press Ctrl-C';
  }
  setTimeout(() => (button.textContent = label), 1500);
}
$('copy-command').onclick = (event) => copy(command(state.words), event.target);
$('copy-link').onclick = (event) => copy(location.href.split('#')[0] + toFragment(state.words), event.target);

$('save').onclick = async () => {
  try {
    const bytes = await call('save', { words: state.words, ending: 'png' });
    const hash = [...new Uint8Array((await crypto.subtle?.digest('SHA-256', bytes)) ?? [])].map((b) => b.toString(16).padStart(2, '0')).join('');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([bytes], { type: 'image/png' }));
    link.download = state.model.replace(/^.*\//, '').replace(/\.\w+$/, '') + '.png';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    $('status').textContent = `saved ${link.download}${hash ? ', SHA-256 ' + hash : ''}`;
  } catch (error) {
    refuse(error.message);
  }
};

addEventListener('hashchange', () => {
  const words = fromFragment(location.hash);
  if (words) state.set(words);
});

// --- the start

try {
  const table = await call('start', {});
  shapes = table.shapes;
  files = await takeInsideFiles();
  if (files.size) await call('files', { files: [...files] });
  panel = new Panel($('options'), $('search'), table.options, (name, values) => {
    let words = state.withValues(name, values);
    const without = VIEW.includes(name) ? ['camera'] : name === 'camera' ? VIEW : [];
    for (const other of without) words = new State(words).withValues(other, []);
    state.set(words);
  });
  update();
} catch (error) {
  refuse(error.message);
}
