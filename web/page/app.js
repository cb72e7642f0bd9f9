// app.js: what the parts of the page share: the state, the calls of the worker, the last picture, events and messages.
//
// A part of the page is a module that takes what it needs from here and adds its listeners when it is imported; page.js imports them all.
//   on('words', f)    the command line has changed, or a gesture has come to an end
//   on('picture', f)  a picture is shown (view.picture); quick ones while something moves too
//   on('still', f)    the picture of the command line is shown, with all of its samples
//   on('ready', f)    the module has started: view.options, view.shapes
//   on('missing', f)  files of the model are missing, or are not any more: view.missing
//   on('fit', f)      the picture stands elsewhere in the page, or has another size there
//   on('explained', f)  another point is explained, or the same one with other numbers: view.explained
import { $ } from './dom.js';
import { insideWords } from './inside.js';
import { giveFilesOf, openedPaths } from './opened.js';
import { openWorker } from './start.js';
import { START, State, fromFragment } from './state.js';
import { localize } from './strings.js';

localize(document); // the stage has its size once the page has its texts

// The size that fills the stage, at most 1.6 million pixels.
export function stageSize() {
  const { clientWidth, clientHeight } = $('view'), ratio = devicePixelRatio || 1;
  const width = Math.max(320, clientWidth * ratio), height = Math.max(240, clientHeight * ratio), k = Math.min(1, Math.sqrt(1.6e6 / (width * height)));
  return `${Math.floor((k * width) / 8) * 8}x${Math.floor((k * height) / 8) * 8}`;
}

export const state = new State(fromFragment(location.hash) ?? insideWords() ?? [START[0], `--size=${stageSize()}`, ...START.slice(1)]);
export const worker = openWorker();
export const { fetchRest } = worker;
// The viewer's page (served.js) gets the files of its models first.
const viewer = $('served') && import('./served.js').then(({ servedCall }) => servedCall(worker.call));
const ask = viewer ? async (name, message) => (await viewer)(name, message) : worker.call;

// A call of the worker, which has the opened files of the command line's model before it.
export function call(name, message) {
  if (message.words) giveFilesOf(message.words[0], (files) => ask('files', { files }).catch(() => {}));
  return ask(name, message);
}

export const view = {
  picture: null, // of the last drawing, without its pixels
  size: null, // width and height of the command line's picture, which a quick one is smaller than
  explained: null, // the pixel that is explained, as the program answers
  camera: null, // the one in use, ahead of the picture while something moves
  sphere: null,
  moving: false, // a gesture goes on
  shapes: [],
  options: [],
  endings: [], // of models
  materials: [], // their names
  environments: [],
  missing: [], // paths of the model's files that are not there
  refusal: null, // why there is no picture, if files are missing; null: there is one
};

const listeners = new Map();

export function on(name, listener) {
  listeners.set(name, [...(listeners.get(name) ?? []), listener]);
}

export function emit(name) {
  for (const listener of listeners.get(name) ?? []) listener();
}

// The page's files lie in the root of a tree; a person knows them by names without its '/', as the command line below the picture has them.
export function plainNames(sentence) {
  const paths = [state.model, ...openedPaths(), ...view.missing].filter((path) => path.startsWith('/'));
  return sentence.replace(/(^|[\s'"(])\//g, (found, before, at) => (paths.some((path) => sentence.startsWith(path, at + before.length)) ? before : found));
}

// A sentence of the program, or of the page, that stays until the next picture, with buttons for what can be done.
export function refuse(sentence, ...buttons) {
  $('message-text').textContent = plainNames(sentence);
  $('message-buttons').replaceChildren(...buttons);
  $('message').hidden = false;
}

// For those who hear the page: said once, shown nowhere.
export function say(sentence) {
  $('spoken').textContent = sentence;
}

// --- a gesture: one step of undo, quick pictures while it lasts

let gesture = 0, still = 0;

export const gestureKey = () => `gesture ${gesture}`;

export function beginGesture() {
  view.moving = true;
  document.body.dataset.gesture = '';
  clearTimeout(still);
}

export function endGesture() {
  clearTimeout(still);
  still = setTimeout(() => {
    view.moving = false;
    delete document.body.dataset.gesture;
    gesture++;
    state.endGesture();
    emit('words');
  }, 120);
}

state.onchange = () => emit('words');
