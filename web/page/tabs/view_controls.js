// view_controls.js: makes buttons for views from all sides, for the whole model and for full screen, and a slider that cuts the model open.
import { gestureKey, on, refuse, state, view } from '../shared/app.js';
import { $, button, element } from '../base/dom.js';
import { setOption } from '../controls/row.js';
import { showNumber, slider } from '../controls/slider.js';
import { VIEW, without } from '../words/state.js';
import { text } from '../base/strings.js';
import { followWindow, isFollowing } from '../shared/window_size.js';

const NAMES = { front: 'viewFront', back: 'viewBack', left: 'viewLeft', right: 'viewRight', top: 'viewTop', bottom: 'viewBottom', iso: 'viewIso' };

// Shows the whole model from the direction that the program chooses.
export const viewAll = () => state.set(without(state.words, ...VIEW.filter((name) => name !== 'projection'), 'camera'));

function toggleFullScreen() {
  const done = document.fullscreenElement ? document.exitFullscreen() : $('stage').requestFullscreen();
  done.catch((error) => refuse(error.message));
}

// A slider that cuts the model by a plane across an axis (--section); at its right end, the model is whole.
function cutControl() {
  const axes = element('select', { translate: false, attributes: { 'aria-label': text('viewCutAxis') } }, ...['x', 'y', 'z'].map((axis) => new Option(axis, axis)));
  const cut = (percent) => setOption('section', percent < 100 ? [`${axes.value}=${percent}%`] : [], gestureKey());
  const made = slider(element('span', { textContent: text('viewCut') }), text('viewCut'), [0, 100, 1], 100, (value) => cut(Number(value)));
  axes.onchange = () => cut(Number(made.querySelector('input').value));
  made.prepend(axes);
  const show = () => {
    const [, axis, percent] = /^([xyz])=([\d.]+)%$/.exec(state.values('section').join()) ?? [];
    if (axis) axes.value = axis;
    showNumber(made, percent ?? 100);
  };
  on('words', show);
  show();
  return made;
}

export function viewControls() {
  const { words } = view.options.find(({ name }) => name === 'view');
  const sides = words.filter(({ name }) => NAMES[name]).map(({ name }) => {
    const made = button(NAMES[name], () => setOption('view', [name]), { attributes: { 'aria-pressed': 'false' } });
    made.dataset.view = name;
    return made;
  });
  const fit = button('sizeWindow', followWindow), full = button('fullScreen', toggleFullScreen);
  full.hidden = !document.fullscreenEnabled;
  const show = () => {
    for (const one of sides) one.setAttribute('aria-pressed', String(state.values('view').at(-1) === one.dataset.view));
    fit.hidden = isFollowing();
  };
  on('words', show);
  show();
  document.addEventListener('fullscreenchange', () => (full.textContent = text(document.fullscreenElement ? 'fullScreenEnd' : 'fullScreen')));
  const buttons = element('div', { className: 'buttons view-buttons', attributes: { role: 'group', 'aria-label': text('sectionView') } }, ...sides, button('viewAll', viewAll), full, fit);
  return element('div', {}, buttons, cutControl());
}
