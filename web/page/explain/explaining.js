// explaining.js: selects the explained point. This is the point under the pointer while the tab is open, or a point that the user has pinned by a click. A
// pinned point stays on the surface when the camera moves.
import { call, emit, on, refuse, say, state, view } from '../shared/app.js';
import { clearArrows, showArrows } from './arrows.js';
import { cameraAxes, length, project, sub } from '../words/camera.js';
import { $, button, element } from '../base/dom.js';
import { worldOf } from './equations.js';
import { Explanation } from './explanation.js';
import { sentenceOf } from './sentence.js';
import { text } from '../base/strings.js';
import { selectTab } from '../base/tabs.js';

const canvas = $('canvas'), place = $('panel-explain');
const hint = element('p', { className: 'hint', textContent: text('explainHint') });
const pinned = element('p', { id: 'pinned', hidden: true }), pinnedText = element('span');
const unpinButton = button('unpin', () => unpin());
const speakButton = button('speak', () => speak());
place.append(hint, pinned, $('explain'));
pinned.append(pinnedText, ' ', unpinButton, ' ', speakButton);
speakButton.hidden = !('speechSynthesis' in globalThis);

let pin = null; // { across, down, world }: fractions of the picture, and the point on the surface; null: the point under the pointer
let shown = null, busy = false, wanted = null;

const explanation = new Explanation($('explain'), (chosen) => showArrows(shown, chosen));

// If several requests wait, only the newest one is sent.
async function ask(at) {
  wanted = at;
  if (busy) return;
  busy = true;
  while (wanted) {
    const { across, down, aloud } = wanted, { width, height } = view.size ?? canvas;
    wanted = null;
    const x = Math.min(width - 1, Math.floor(across * width)), y = Math.min(height - 1, Math.floor(down * height));
    try {
      show(await call('explain', { words: state.words.filter((word) => !word.startsWith('--show')), x, y }), aloud);
    } catch (error) {
      if (pin) refuse(error.message);
    }
  }
  busy = false;
}

function show(pixel, aloud) {
  shown = pixel;
  const world = worldIn(pixel);
  if (pin && !pin.world) pin.world = world;
  const hidden = pin?.world && (!world || length(sub(world, pin.world)) > 0.02 * view.sphere.radius);
  pinned.hidden = !pin;
  pinnedText.textContent = text(hidden ? 'pinHidden' : 'pinned');
  hint.hidden = true;
  $('explain').hidden = false;
  explanation.show(pixel);
  showArrows(pixel, explanation.chosen);
  view.explained = pixel;
  emit('explained');
  if (aloud) say(sentenceOf(pixel));
}

// Returns the explained point in world space, or null for the background.
function worldIn(pixel) {
  const place = pixel.triangles[0]?.places?.[3];
  if (!place || !view.picture) return null;
  const { camera } = view.picture;
  return worldOf(cameraAxes(camera), camera.eye, place.eye);
}

export function pinAt(across, down) {
  pin = { across, down, world: null };
  if ($('panel-lights').hidden) selectTab('explain'); // the sliders of the lights tab change the numbers of a pinned point
  ask({ across, down, aloud: true });
}

function unpin() {
  pin = null;
  view.explained = null;
  pinned.hidden = true;
  clearArrows();
  say(text('unpinned'));
  canvas.focus();
}

function speak() {
  speechSynthesis.cancel();
  if (shown) speechSynthesis.speak(Object.assign(new SpeechSynthesisUtterance(sentenceOf(shown)), { lang: document.documentElement.lang }));
}

// After a new picture, the pinned point is explained at its new position.
on('picture', () => {
  if (!pin) return clearArrows();
  if (pin.world) {
    const at = project(view.picture.camera, pin.world, view.picture.width / view.picture.height);
    const outside = at.behind || at.x < 0 || at.y < 0 || at.x >= 1 || at.y >= 1;
    if (outside) {
      pinnedText.textContent = text('pinOutside');
      return clearArrows();
    }
    Object.assign(pin, { across: at.x, down: at.y });
  }
  ask(pin);
});

const isOpen = () => !place.hidden || !$('panel-lights').hidden;

canvas.addEventListener('pointermove', (event) => {
  if (pin || event.buttons || event.pointerType === 'touch' || view.moving || !isOpen()) return;
  ask({ across: event.offsetX / canvas.clientWidth, down: event.offsetY / canvas.clientHeight });
});
canvas.addEventListener('pointerleave', () => {
  if (!pin) clearArrows();
});

addEventListener('keydown', (event) => {
  if (event.key === 'Escape' && pin) unpin();
});
// Alt and an arrow key move the pinned point by 12 pixels. Alt, Shift and an arrow key move it by one pixel.
canvas.addEventListener('keydown', (event) => {
  const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (!arrow || !event.altKey) return;
  event.preventDefault();
  const step = event.shiftKey ? 1 : 12, { width, height } = view.size ?? canvas, from = pin ?? { across: 0.5, down: 0.5 };
  const within = (x) => Math.max(0, Math.min(0.9999, x));
  pinAt(within(from.across + (arrow[0] * step) / width), within(from.down + (arrow[1] * step) / height));
});
