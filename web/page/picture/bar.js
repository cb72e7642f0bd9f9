// bar.js: provides undo and redo, shows the command line with its copy buttons, saves pictures, and keeps the address up to date.
import { call, on, refuse, state, view } from '../shared/app.js';
import { $, ours } from '../base/dom.js';
import { setOf } from '../shared/opened.js';
import { State, command, commandWords, fromFragment, toFragment } from '../words/state.js';
import { text } from '../base/strings.js';

// Shows a command line. Each word is an element, so that lines break between words if possible.
export const showCommand = (place, words) => place.replaceChildren(...commandWords(words).flatMap((word) => [ours('span', word), ' ']).slice(0, -1));

on('words', () => {
  showCommand($('command'), state.words);
  $('undo').disabled = !state.canUndo;
  $('redo').disabled = !state.canRedo;
  if (!view.moving) remember(toFragment(state.words));
});

// The address contains the picture's command line. The first change of a picture adds an entry to the browser's history, and so does each other model. Back
// returns to the picture as it was opened, and Forward returns to the changed picture.
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
  let isCopied = false;
  button.style.minWidth = `${button.offsetWidth}px`; // so that the buttons beside it stay in place
  try {
    await navigator.clipboard.writeText(copied);
    button.textContent = text('copied');
    isCopied = true;
  } catch {
    getSelection().selectAllChildren($('command'));
    button.textContent = text('selected');
  }
  setTimeout(() => (button.textContent = label), 1500);
  return isCopied;
}
$('copy-command').onclick = (event) => copy(command(state.words), event.target);
const linkOf = () => location.href.split('#')[0] + toFragment(state.words);
export async function copyLink(event) {
  if (await copy(linkOf(), event.target)) $('status').textContent = setOf(state.model) ? text('linkCopied', { file: state.model.slice(1) }) : text('linkDone');
}
$('copy-link').onclick = copyLink;

// Offers bytes as a file named after the model.
export function download(bytes, ending, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([bytes], { type }));
  link.download = state.model.replace(/^.*\//, '').replace(/\.\w+$/, '') + ending;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  return link.download;
}

// Returns a description of a saved PNG. The size and the kind of pixels are read from its first bytes.
function savedLine(words, bytes, file) {
  const head = new DataView(bytes.buffer, bytes.byteOffset), size = { width: head.getUint32(16), height: head.getUint32(20) }, hasAlpha = bytes[25] >= 4;
  const color = new State(words).values('background').at(-1);
  if (hasAlpha) return text('savedTransparent', { file, ...size });
  return color ? text('savedColor', { file, ...size, color }) : text('savedOpaque', { file, ...size });
}

// Saves the picture of `words`, which may differ from the words of the page.
export async function saveNamed(words) {
  try {
    const bytes = await call('save', { words, ending: 'png' });
    $('status').textContent = savedLine(words, bytes, download(bytes, '.png', 'image/png'));
  } catch (error) {
    refuse(error.message);
  }
}
$('save').onclick = () => saveNamed(state.words);

addEventListener('hashchange', () => {
  const words = fromFragment(location.hash);
  if (words) state.set(words);
});
