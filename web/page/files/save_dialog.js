// save_dialog.js: the dialog that saves the picture with another size and background. It also makes a page with the model, a link, or a scene file, which the
// user can send to other people.
import { call, refuse, state, view } from '../shared/app.js';
import { copyLink, download, saveNamed, showCommand } from '../picture/bar.js';
import { $, button, element, ours } from '../base/dom.js';
import { saveScene } from './scene.js';
import { pageWithModel } from './packed_page.js';
import { setOf } from '../shared/opened.js';
import { State } from '../words/state.js';
import { text } from '../base/strings.js';
import { isFollowing, windowSize } from '../shared/window_size.js';

const WIDTHS = [1000, 2000, 4000], BACKGROUNDS = { white: 'backgroundWhite', transparent: 'backgroundNone' };
let dialog = null, chosen = { width: null, background: null };

// Returns the words of the saved picture: the current words with the chosen size and background. The picture's longer side has the chosen number of pixels.
function savedWords() {
  let words = state.words;
  if (chosen.width) {
    const { width, height } = view.size, k = chosen.width / Math.max(width, height);
    words = new State(words).withValues('size', [`${Math.round(k * width)}x${Math.round(k * height)}`]);
  }
  return chosen.background ? new State(words).withValues('background', [chosen.background]) : words;
}

// Makes a group of radio buttons.
function choice(title, name, rows, show) {
  const inputs = rows.map(([value, label], i) => {
    const input = element('input', { type: 'radio', name: `save-${name}`, checked: chosen[name] === value });
    input.onchange = () => {
      chosen[name] = value;
      show();
    };
    return element('label', { className: 'choice', id: `save-${name}-${i}` }, input, ' ', element('span', { textContent: label }));
  });
  return element('fieldset', {}, element('legend', { textContent: title }), element('div', { className: 'buttons' }, ...inputs));
}

function closing(act) {
  return async () => {
    dialog.close();
    try {
      await act();
    } catch (error) {
      refuse(error.message);
    }
  };
}

async function savePage() {
  $('status').textContent = text('pageMaking');
  const bytes = await pageWithModel(state.words, await call('used', { words: state.words }), isFollowing() ? windowSize() : '');
  const file = download(bytes, '.html', 'text/html');
  $('status').textContent = text('pageSaved', { file, size: (bytes.size / 1e6).toFixed(1) });
}

export function openSaveDialog() {
  if (!view.size) return;
  dialog?.remove();
  const line = ours('code', '', { id: 'save-command' }), show = () => showCommand(line, savedWords());
  const { width, height } = view.size, sizes = [[null, text('saveAsShown', { width, height })], ...WIDTHS.map((one) => [one, text('savePixels', { width: one })])];
  const backgrounds = [[null, text('saveBackground')], ...Object.entries(BACKGROUNDS).map(([value, key]) => [value, text(key)])];
  const close = button('closeDialog', () => dialog.close());
  dialog = element('dialog', { id: 'save-dialog', attributes: { 'aria-labelledby': 'save-title' } },
    element('h2', { id: 'save-title', textContent: text('saveTitle') }),
    choice(text('saveSize'), 'width', sizes, show), choice(text('sectionBackground'), 'background', backgrounds, show),
    element('details', {}, element('summary', { textContent: text('command') }), line),
    element('div', { className: 'buttons' }, button('savePng', closing(() => saveNamed(savedWords())), { id: 'save-png' })),
    element('h2', { textContent: text('sendTitle') }), element('p', { className: 'hint', textContent: text(setOf(state.model) ? 'sendHintFiles' : 'sendHint') }),
    element('div', { className: 'buttons' }, button('savePage', closing(savePage), { id: 'save-page' }), button('copyLink', copyLink, { id: 'save-link' }),
      button('saveScene', closing(saveScene), { id: 'save-scene' })),
    element('div', { className: 'buttons end' }, close));
  show();
  document.body.append(dialog);
  dialog.showModal();
}
