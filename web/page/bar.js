// bar.js: undo and redo, the command line and its copy buttons, saving, and the address.
import { call, on, refuse, state, view } from './app.js';
import { $, ours } from './dom.js';
import { setOf } from './opened.js';
import { command, commandWords, fromFragment, toFragment } from './state.js';
import { text } from './strings.js';

on('words', () => {
  // Each word is an element, so that lines break between words if possible.
  $('command').replaceChildren(...commandWords(state.words).flatMap((word) => [ours('span', word), ' ']).slice(0, -1));
  $('undo').disabled = !state.canUndo;
  $('redo').disabled = !state.canRedo;
  if (!view.moving) remember(toFragment(state.words));
});

// The address contains the picture's command line. The browser's Back returns to the picture as it was opened, and Forward to the changed picture: the first
// change, and each other model, adds an entry to the history.
let isFirst = true;
function remember(hash) {
  const before = fromFragment(location.hash), isSame = before?.join('\n') === state.words.join('\n');
  if (!isFirst && !isSame && (!history.state?.isChanged || before?.[0] !== state.model)) history.pushState({ isChanged: true }, '', hash);
  else history.replaceState(history.state, '', hash);
  isFirst = false;
}

$('undo').onclick = () => state.undo();
$('redo').onclick = () => state.redo();
addEventListener('keydown', (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches('input, textarea, [contenteditable]')) return;
  if (event.key === 'z') (event.shiftKey ? state.redo() : state.undo(), event.preventDefault());
  if (event.key === 'y') (state.redo(), event.preventDefault());
});

export async function copy(copied, button) {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(copied);
    button.textContent = text('copied');
  } catch {
    getSelection().selectAllChildren($('command'));
    button.textContent = text('selected');
  }
  setTimeout(() => (button.textContent = label), 1500);
}
$('copy-command').onclick = (event) => copy(command(state.words), event.target);
export const linkOf = () => location.href.split('#')[0] + toFragment(state.words);
$('copy-link').onclick = (event) => {
  copy(linkOf(), event.target);
  if (setOf(state.model)) $('status').textContent = text('linkCopied', { file: state.model.slice(1) });
};

// Offers bytes as a file named after the model.
export function download(bytes, ending, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([bytes], { type }));
  link.download = state.model.replace(/^.*\//, '').replace(/\.\w+$/, '') + ending;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  return link.download;
}

// Saves the picture of the given words, which may differ from those of the page.
export async function saveNamed(words) {
  try {
    const bytes = await call('save', { words, ending: 'png' });
    const digest = await crypto.subtle?.digest('SHA-256', bytes);
    const hash = [...new Uint8Array(digest ?? [])].map((b) => b.toString(16).padStart(2, '0')).join('');
    const file = download(bytes, '.png', 'image/png');
    $('status').textContent = hash ? text('savedHash', { file, hash }) : text('saved', { file });
  } catch (error) {
    refuse(error.message);
  }
}
$('save').onclick = () => saveNamed(state.words);

addEventListener('hashchange', () => {
  const words = fromFragment(location.hash);
  if (words) state.set(words);
});
