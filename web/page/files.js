// files.js: opens models from the menu, from files, from a folder, or by drag and drop. Files never leave the machine. If files that a model names are
// missing, the page asks for them.
import { emit, on, refuse, state, view } from './app.js';
import { $, button, element } from './dom.js';
import { droppedFiles } from './dropped.js';
import { FILES_BYTES } from './memory.js';
import { addCompanions, addFiles, openedPaths, setOf } from './opened.js';
import { FORMULAS, START, withModel } from './state.js';
import { text } from './strings.js';

const isModel = (path) => view.endings.includes(path.replace(/^.*\./, '').toLowerCase());
const baseOf = (path) => path.replace(/^.*\//, '').toLowerCase();
const plain = (path) => path.replace(/^\//, '');

function showModels() {
  const own = openedPaths().filter(isModel), shapes = [...view.shapes, ...Object.keys(FORMULAS)];
  if (![...own, ...shapes].includes(state.model)) own.unshift(state.model);
  const key = [...own, '', ...shapes].join('\n');
  if ($('model').dataset.names !== key) {
    const group = (label, names) => element('optgroup', { label: text(label), translate: true }, ...names.map((name) => new Option(plain(name), name)));
    $('model').replaceChildren(...(own.length ? [group('modelsOpened', own)] : []), group('modelsShapes', shapes));
    $('model').dataset.names = key;
  }
  $('model').value = state.model;
}
on('words', showModels);
on('ready', showModels);

// Options that refer to contents of a model.
const OF_MODEL = /^--(camera|hide|animation|time|variant|scene)=|^--(back-)?material=.*@/;

// Another model starts with its own view and materials, not with those of the first picture.
function takeModel(name) {
  const own = setOf(name) ? START : [];
  state.set(withModel(state.words.filter((word, i) => !i || (!OF_MODEL.test(word) && !own.includes(word))), name));
}

async function read(list) {
  const taken = new Map();
  const size = list.reduce((sum, [, file]) => sum + file.size, 0), large = list.reduce((a, b) => (a && a[1].size >= b[1].size ? a : b), null);
  const megabytes = (bytes) => Math.round(bytes / 1e6).toLocaleString('en');
  if (size > FILES_BYTES) {
    refuse(text('tooLarge', { file: large[0], size: megabytes(size), most: megabytes(FILES_BYTES) }));
    return taken;
  }
  let done = 0;
  for (const [path, file] of list) {
    $('status').textContent = text('loading', { name: path, amount: `${Math.round((100 * done) / (size || 1))} %` });
    taken.set('/' + path, new Uint8Array(await file.arrayBuffer()));
    done += file.size;
  }
  $('status').textContent = '';
  return taken;
}

// Missing files of the model among the given files, stored under the paths where the model expects them.
function companions(taken) {
  const found = new Map();
  for (const path of view.missing) {
    const same = [...taken.keys()].find((other) => baseOf(other) === baseOf(path));
    if (same) found.set(path, taken.get(same));
  }
  return found;
}

async function takeFiles(list) {
  const taken = await read(list);
  if (!taken.size) return;
  const names = [...taken.keys()], awaited = state.model.startsWith('/') && !setOf(state.model) && !view.camera ? state.model : null;
  const models = names.filter(isModel).sort((a, b) => a.split('/').length - b.split('/').length || (a < b ? -1 : 1));
  const found = setOf(state.model) ? companions(taken) : new Map();
  if (!models.length && !found.size) return refuse(text('noModel', { files: names.map(plain).join(', '), endings: view.endings.map((ending) => '.' + ending).join(', ') }));
  // A folder that contains the model itself is opened as a whole.
  const again = models.find((path) => baseOf(path) === baseOf(state.model));
  if (found.size && !(again && models.length)) addCompanions(state.model, found);
  else addFiles(taken, state.model);
  const [first] = models, wanted = again && (awaited || view.missing.length) ? again : first;
  if (!wanted || wanted === state.model) emit('words'); // new contents under the same name
  else if (awaited || wanted === again) state.set([wanted, ...state.words.slice(1)]); // keeps the options of a link, or of the same model
  else takeModel(wanted);
}

const openFiles = () => $('files').click(), openFolder = () => $('folder').click();

// Explains how to add missing files. After opening a link to a local model, explains how to open the model itself.
on('missing', () => {
  const buttons = [button('chooseFiles', openFiles), button('openFolder', openFolder)], [model] = state.words;
  const isGone = view.missing.includes(model), sentence = isGone ? text('linkWithout', { file: plain(model) })
    : text('missingFiles', { files: view.missing.map(plain).join(', ') });
  $('missing').hidden = Boolean(view.refusal) || !view.missing.length || $('missing').dataset.seen === sentence;
  $('missing').firstChild.textContent = sentence;
  $('missing').lastChild.replaceChildren(...buttons, button('missingSeen', () => {
    $('missing').dataset.seen = sentence;
    $('missing').hidden = true;
  }));
  if (view.refusal && isGone) refuse(sentence, button('openNamed', openFiles), buttons[1]);
  else if (view.refusal) refuse(`${view.refusal}. ${sentence}`, button('chooseFiles', openFiles), button('openFolder', openFolder));
});

$('model').onchange = (event) => takeModel(event.target.value);
$('open').onclick = openFiles;
$('open-folder').onclick = openFolder;
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
