// view_controls.js: makes buttons for views from all sides, for the whole model and for full screen, and a slider that cuts the model open.
import { gestureKey, on, refuse, state, view } from '../shared/app.js';
import { cut, cutShare } from '../words/camera.js';
import { $, button, element } from '../base/dom.js';
import { move } from '../shared/move.js';
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

// Cuts the front of the model away. Both sides of the faces are then drawn, because the inside of the model is visible.
function cutTo(share) {
  if (!view.camera) return;
  const key = gestureKey(), culled = state.values('cull');
  move(cut(view.camera, view.sphere, share));
  if (share > 0 && !culled.length) state.set(state.withValues('cull', ['none']), key);
  if (!(share > 0) && culled.join() === 'none') state.set(state.withValues('cull', []), key);
}

function cutControl() {
  const made = slider(element('span', { textContent: text('viewCut') }), text('viewCut'), [0, 1, 0.01], 0, (value) => cutTo(Number(value)));
  const show = () => !view.moving && view.camera && showNumber(made, cutShare(view.camera, view.sphere).toFixed(2));
  on('picture', show);
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
