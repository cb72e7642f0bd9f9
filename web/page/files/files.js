// files.js: opens models from the menu, from files, from a folder, or by drag and drop. Files never leave the machine. If a model names files that are missing,
// the page asks the user for them.
import { emit, on, refuse, state, view } from '../shared/app.js';
import { $, button, element } from '../base/dom.js';
import { droppedFiles } from './dropped.js';
import { FILES_BYTES } from '../base/memory.js';
import { addCompanions, addFiles, openedPaths, setOf } from '../shared/opened.js';
import { companions, ranked, setsSize, withNeighbours } from './ranked_models.js';
import { FORMULAS, START, isScene, withModel } from '../words/state.js';
import { text } from '../base/strings.js';
import { windowSize } from '../shared/window_size.js';

const isModel = (path) => view.endings.includes(path.replace(/^.*\./, '').toLowerCase());
const baseOf = (path) => path.replace(/^.*\//, '').toLowerCase();
let isAnswer = false; // the user has pressed a button that asks for missing files
let rest = new Map(); // the remaining files of the last answer; the model may need them later
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

// Matches the options that refer to contents of a model.
const OF_MODEL = /^--(camera|hide|animation|time|variant|scene)=|^--(back-)?material=.*@/;

// Another model starts with its own view and materials, not with the view and materials of the first picture. A scene file describes the whole picture.
function takeModel(name) {
  const set = setOf(name), own = set ? START : [];
  if (set && isScene(name)) return state.set([name, ...(setsSize(name, set.files) ? [] : [windowSize()])]);
  const kept = state.words.filter((word, i) => !i || (!OF_MODEL.test(word) && !own.includes(word)));
  state.set(withModel(isScene(state.model) && !state.values('size').length ? [...kept, windowSize()] : kept, name));
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

async function takeFiles(list) {
  const isAsked = isAnswer, taken = await read(list);
  isAnswer = false;
  if (!taken.size) return;
  const names = [...taken.keys()], awaited = state.model.startsWith('/') && !setOf(state.model) && !view.camera ? state.model : null;
  const models = ranked(names.filter(isModel), taken), found = setOf(state.model) ? companions(view.missing, taken) : new Map();
  if (!models.length && !found.size) return refuse(text('noModel', { files: names.map(plain).join(', '), endings: view.endings.map((ending) => '.' + ending).join(', ') }));
  // If a folder contains the model itself, all its files are opened.
  const again = models.find((path) => baseOf(path) === baseOf(state.model));
  const completes = found.size && !again && (!models.length || isAsked || [...found.keys()].some(isModel));
  if (completes) return complete(found, taken);
  addFiles(taken, state.model);
  rest = new Map();
  const [first] = models, wanted = again && (awaited || view.missing.length) ? again : first;
  if (!wanted || wanted === state.model) emit('words'); // new contents under the same name
  else if ((awaited && !isScene(awaited)) || wanted === again) state.set([wanted, ...state.words.slice(1)]); // keeps the options of a link, or of the same model
  else takeModel(wanted);
}

// Adds missing files to the model. The other chosen files are kept, because the model may need them later.
function complete(found, taken) {
  const { files } = setOf(state.model), placed = withNeighbours(found, taken);
  addCompanions(state.model, [...placed].filter(([path]) => found.has(path) || !files.has(path)));
  rest = new Map([...taken].filter(([path]) => ![...found.values()].includes(path)));
  emit('words');
}

const askFiles = () => ((isAnswer = false), $('files').click()), askFolder = () => ((isAnswer = false), $('folder').click());
const asking = (open) => () => (open(), (isAnswer = true));

// Returns the opened files that may be the missing ones: the remaining files of the last answer and, for a scene file, the files of other models at the
// missing paths.
const openFiles = () => new Map([...(isScene(state.model) ? view.missing : []).flatMap((path) => (setOf(path) ? [[path, setOf(path).files.get(path)]] : [])), ...rest]);

// Explains how to add missing files. After opening a link to a local model, or after a reload, explains how to open the model itself.
on('missing', () => {
  const open = setOf(state.model) ? openFiles() : new Map(), known = companions(view.missing, open);
  if (known.size) return setTimeout(() => complete(known, open)); // after the current drawing
  const choose = button('chooseFiles', asking(askFiles)), folder = button('openFolder', asking(askFolder)), [model] = state.words;
  const isGone = view.missing.includes(model), sentence = isGone ? text('linkWithout', { file: plain(model) })
    : text(view.missing.some((path) => /\.mtl$/i.test(path)) ? 'missingMaterials' : 'missingFiles', { files: view.missing.map(plain).join(', ') });
  $('missing').hidden = Boolean(view.refusal) || !view.missing.length || $('missing').dataset.seen === sentence;
  $('missing').firstChild.textContent = sentence;
  $('missing').lastChild.replaceChildren(choose, folder, button('missingSeen', () => {
    $('missing').dataset.seen = sentence;
    $('missing').hidden = true;
  }));
  if (view.refusal && isGone) refuse(sentence, button('openNamed', askFiles), button('openFolder', askFolder));
  else if (view.refusal) refuse(/No such file/.test(view.refusal) ? sentence : `${view.refusal}. ${sentence}`, button('chooseFiles', asking(askFiles)), button('openFolder', asking(askFolder)));
});

$('model').onchange = (event) => takeModel(event.target.value);
$('open').onclick = askFiles;
$('open-folder').onclick = askFolder;
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
  isAnswer = false;
  takeFiles(await droppedFiles(event.dataTransfer));
});
