// files.js: models come in by the menu, as files, as a folder, or dropped; nothing leaves the machine.
import { call, emit, on, refuse, state, view } from './app.js';
import { $ } from './dom.js';
import { droppedFiles } from './dropped.js';
import { FILES_BYTES } from './memory.js';
import { FORMULAS, START, withModel } from './state.js';
import { text } from './strings.js';

const MODELS = /\.(obj|stl|ply|gltf|glb|json)$/i;

function showModels() {
  const own = [...view.files.keys()].filter((path) => MODELS.test(path));
  const names = [...own, ...view.shapes, ...Object.keys(FORMULAS)];
  if (!names.includes(state.model)) names.unshift(state.model);
  const key = names.join('\n');
  if ($('model').dataset.names !== key) {
    $('model').replaceChildren(...names.map((name) => new Option(name.replace(/^\//, ''), name)));
    $('model').dataset.names = key;
  }
  $('model').value = state.model;
}
on('words', showModels);
on('ready', showModels);

// Another model is seen whole: its own view. A file's materials are its own, not those of the first picture.
function takeModel(name) {
  const own = view.files.has(name) ? START : [];
  state.set(withModel(state.words.filter((word, i) => !i || (!word.startsWith('--camera') && !own.includes(word))), name));
}

async function takeFiles(list) {
  const taken = new Map();
  const size = list.reduce((sum, [, file]) => sum + file.size, 0), large = list.reduce((a, b) => (a && a[1].size >= b[1].size ? a : b), null);
  const megabytes = (bytes) => Math.round(bytes / 1e6).toLocaleString('en');
  if (size > FILES_BYTES) return refuse(text('tooLarge', { file: large[0], size: megabytes(size), most: megabytes(FILES_BYTES) }));
  let read = 0;
  for (const [path, file] of list) {
    $('status').textContent = text('loading', { name: path, amount: `${Math.round((100 * read) / (size || 1))} %` });
    taken.set('/' + path, new Uint8Array(await file.arrayBuffer()));
    read += file.size;
  }
  if (!taken.size) return;
  view.files = taken;
  await call('files', { files: [...taken] });
  const names = [...taken.keys()];
  const models = names.filter((path) => MODELS.test(path)).sort((a, b) => a.split('/').length - b.split('/').length || (a < b ? -1 : 1));
  if (!models.length) refuse(text('noModel', { files: names.map((path) => path.slice(1)).join(', ') }));
  else if (models[0] === state.model) emit('words'); // new contents under an old name
  else takeModel(models[0]);
}

$('model').onchange = (event) => takeModel(event.target.value);
$('open').onclick = () => $('files').click();
$('open-folder').onclick = () => $('folder').click();
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
