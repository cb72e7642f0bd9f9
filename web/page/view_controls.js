// view_controls.js: views by buttons: from the sides, the whole model, the whole screen.
import { on, refuse, state, view } from './app.js';
import { $, button, element } from './dom.js';
import { setOption } from './row.js';
import { State, VIEW } from './state.js';
import { text } from './strings.js';
import { followWindow, isFollowing } from './window_size.js';

const NAMES = { front: 'viewFront', back: 'viewBack', left: 'viewLeft', right: 'viewRight', top: 'viewTop', bottom: 'viewBottom', iso: 'viewIso' };

// The view that the program chooses, of the whole model.
export const viewAll = () => state.set([...VIEW.filter((name) => name !== 'projection'), 'camera'].reduce((words, name) => new State(words).withValues(name, []), state.words));

function toggleFullScreen() {
  const done = document.fullscreenElement ? document.exitFullscreen() : $('stage').requestFullscreen();
  done.catch((error) => refuse(error.message));
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
  return element('div', { className: 'buttons view-buttons', attributes: { role: 'group', 'aria-label': text('sectionView') } }, ...sides, button('viewAll', viewAll), full, fit);
}
