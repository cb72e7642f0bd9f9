// split.js: compares the picture with an earlier picture. The left side shows a kept command line with the current camera and size. The dividing line can be
// dragged or moved by keys.
import { call, on, refuse, state, view } from '../shared/app.js';
import { showCommand } from './bar.js';
import { $, button, element, ours } from '../base/dom.js';
import { fit, quickWords } from './drawing.js';
import { State, VIEW, appearance } from '../words/state.js';
import { text } from '../base/strings.js';

const kept = element('canvas', { id: 'before', attributes: { 'aria-hidden': 'true' } }), context = kept.getContext('2d');
const line = element('div', { id: 'divider', tabIndex: 0, attributes: { role: 'separator', 'aria-orientation': 'vertical', 'aria-label': text('divider'), 'aria-valuemin': 0, 'aria-valuemax': 100 } });
const title = element('span'), words = ours('code', '', { id: 'before-command' });
const bar = element('div', { id: 'split-bar' }, title, ' ', words, ' ',
  button('keepNow', () => keep('beforeKept')), button('swap', () => swap()), button('endSplit', () => toggle()));
let before = null, share = 50, busy = false, again = false, isNone = false; // isNone: there is no earlier state

// Returns the kept words with the current view and size.
function beforeWords() {
  let made = before;
  for (const name of [...VIEW, 'camera', 'size']) made = new State(made).withValues(name, state.values(name));
  return made;
}

async function draw() {
  again = true;
  if (busy) return;
  busy = true;
  while (again && before) {
    again = false;
    const now = beforeWords();
    showCommand(words, now);
    try {
      const { pixels, width, height } = await call('draw', { words: view.moving ? quickWords(now) : now });
      kept.width = width;
      kept.height = height;
      context.putImageData(new ImageData(pixels, width, height), 0, 0);
      kept.dataset.drawn = view.moving ? '' : JSON.stringify(now);
    } catch (error) {
      refuse(error.message);
    }
  }
  busy = false;
}

function place(next) {
  share = Math.max(0, Math.min(100, next));
  const canvas = $('canvas');
  for (const name of ['left', 'top', 'width', 'height', 'imageRendering']) kept.style[name] = canvas.style[name];
  kept.style.clipPath = `inset(0 ${100 - share}% 0 0)`;
  Object.assign(line.style, { left: `${canvas.offsetLeft + (share / 100) * canvas.clientWidth}px`, top: canvas.style.top, height: canvas.style.height });
  line.setAttribute('aria-valuenow', Math.round(share));
}

// `sentence` describes the left side.
function show(sentence) {
  isNone = sentence === 'beforeNone';
  title.textContent = text(sentence);
}

// Keeps the current picture, and compares later pictures with it.
function keep(sentence) {
  before = state.words;
  show(sentence);
  draw();
}

// Compares with the newest state of this model that looks different from the same camera.
function begin() {
  const last = state.past.findLast((one) => one[0] === state.model && appearance(one) !== appearance(state.words));
  if (!last) return keep('beforeNone');
  before = last;
  show('before');
  draw();
}

function swap() {
  const now = state.words;
  const next = beforeWords();
  before = now;
  show('beforeKept');
  state.set(next);
}

export function toggle() {
  const open = !before;
  $('compare').setAttribute('aria-pressed', String(open));
  if (open) {
    $('canvas').after(kept, line);
    $('stage').append(bar);
    fit();
    place(50);
    begin();
    line.focus();
  } else {
    const hasFocus = [line, bar].some((one) => one.contains(document.activeElement));
    before = null;
    for (const one of [kept, line, bar]) one.remove();
    fit();
    if (hasFocus) $('compare').focus();
  }
}

line.onpointerdown = (event) => {
  line.setPointerCapture(event.pointerId);
  line.focus();
  event.preventDefault();
};
line.onpointermove = (event) => {
  if (!line.hasPointerCapture(event.pointerId)) return;
  const box = $('canvas').getBoundingClientRect();
  place((100 * (event.clientX - box.left)) / box.width);
};
line.onkeydown = (event) => {
  const step = event.shiftKey ? 10 : 2, to = { ArrowLeft: share - step, ArrowRight: share + step, Home: 0, End: 100 }[event.key];
  if (to === undefined) return;
  place(to);
  event.preventDefault();
};

addEventListener('keydown', (event) => event.key === 'Escape' && before && $('working').hidden && !document.querySelector('dialog[open]') && toggle());
on('words', () => before && before[0] !== state.model && toggle()); // another model has no earlier state
on('picture', () => {
  if (!before) return;
  if (isNone && appearance(before) !== appearance(state.words)) show('before');
  draw();
});
on('fit', () => before && place(share));
