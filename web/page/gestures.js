// gestures.js: turns, pans and zooms the view by mouse, touch and keyboard. These gestures write the option --camera. Another gesture turns the environment.
import { beginGesture, endGesture, gestureKey, state, view } from './shared/app.js';
import { around, decimal, orbit, pan, zoom } from './words/camera.js';
import { $ } from './base/dom.js';
import { explainAt } from './later.js';
import { move } from './shared/move.js';

const canvas = $('canvas');
const pointers = new Map();

// If the program has fitted the view, the camera is first moved back until the model fits from all directions.
function turn(right, up) {
  if (!state.values('camera').length) view.camera = around(view.camera, view.sphere, canvas.width / canvas.height);
  move(orbit(view.camera, right, up, view.camera.pole, view.sphere.centre));
}

const hasEnvironment = () => ['environment', 'reflection-map'].some((name) => (state.values(name).at(-1) ?? view.settings.get(name) ?? 'none') !== 'none');

// Turns the environment about the up axis.
function turnSurroundings(degrees) {
  const name = 'environment-rotation', before = Number(state.values(name).at(-1) ?? view.settings.get(name) ?? 0);
  beginGesture();
  state.set(state.withValues(name, [decimal((before + degrees + 360) % 360, 2)]), gestureKey());
}

canvas.addEventListener('pointerdown', (event) => {
  if (!view.camera) return;
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
    move(zoom(pan(view.camera, x / 2 / size, -y / 2 / size), factor));
  } else if (event.shiftKey || event.buttons & 6) {
    move(pan(view.camera, x / size, -y / size));
  } else if (event.ctrlKey && hasEnvironment()) {
    turnSurroundings((x / size) * 180);
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
    if (pointer.moved) endGesture();
    else if (name === 'pointerup') explainAt(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight);
  });
canvas.addEventListener('contextmenu', (event) => event.preventDefault());

canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  if (!view.camera) return;
  move(zoom(view.camera, Math.exp(-Math.max(-100, Math.min(100, event.deltaY)) * 0.0015)));
  endGesture();
}, { passive: false });

canvas.addEventListener('keydown', (event) => {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const arrow = arrows[event.key], step = Math.PI / 24;
  if (!view.camera || event.ctrlKey || event.metaKey || event.altKey) return;
  if (arrow && event.shiftKey) move(pan(view.camera, arrow[0] * 0.05, arrow[1] * 0.05));
  else if (arrow) turn(arrow[0] * step, arrow[1] * step);
  else if (event.key === '+' || event.key === '=') move(zoom(view.camera, 1.15));
  else if (event.key === '-') move(zoom(view.camera, 1 / 1.15));
  else if (event.key === 'Home') state.set(state.withValues('camera', []));
  else if (event.key === 'Enter') explainAt(0.5, 0.5);
  else return;
  event.preventDefault();
  if (view.moving) endGesture();
});
