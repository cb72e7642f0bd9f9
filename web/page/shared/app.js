// app.js: provides the state, calls of the worker, the last picture, events and messages to all modules of the page.
//
// Each module of the page imports what it needs from here and registers its listeners when it is imported. page.js imports all of them.
//   on('words', f)    the command line has changed, or a gesture has ended
//   on('picture', f)  a picture is shown (view.picture), including quick pictures during a gesture
//   on('still', f)    the picture of the command line is shown, with all of its samples
//   on('ready', f)    the module has started: view.options, view.shapes
//   on('missing', f)  the list of missing files of the model has changed: view.missing
//   on('idle', f)     no drawing is in progress or waiting: view.isIdle
//   on('lights', f)   the lights of the model's file were read (written_lights.js)
//   on('settings', f)  the settings of the scene file were read (own_settings.js)
//   on('fit', f)      the picture has another position or size in the page
//   on('explained', f)  view.explained has changed: another point, or other numbers of the same point
import { $ } from '../base/dom.js';
import { insideWords } from '../base/inside.js';
import { giveFilesOf, openedPaths } from './opened.js';
import { openWorker } from '../worker/start.js';
import { START, State, fromFragment } from '../words/state.js';
import { localize, text } from '../base/strings.js';

localize(document); // the stage has its final size only after the page has its texts

// Returns the size that fills the stage, at most 1.6 million pixels.
export function stageSize() {
  const { clientWidth, clientHeight } = $('view'), ratio = devicePixelRatio || 1;
  const width = Math.max(320, clientWidth * ratio), height = Math.max(240, clientHeight * ratio), k = Math.min(1, Math.sqrt(1.6e6 / (width * height)));
  return `${Math.floor((k * width) / 8) * 8}x${Math.floor((k * height) / 8) * 8}`;
}

const filling = `--size=${stageSize()}`;
export const state = new State(fromFragment(location.hash) ?? insideWords(filling) ?? [START[0], filling, ...START.slice(1)]);
export const worker = openWorker();
export const { fetchRest } = worker;
// In the page of `lambent view`, served.js first fetches the files of the model.
const viewer = $('served') && import('../worker/served.js').then(({ servedCall }) => servedCall(worker.call));
const ask = viewer ? async (name, message) => (await viewer)(name, message) : worker.call;

// Calls the worker. First sends it the opened files of the command line's model.
export function call(name, message) {
  if (message.words) giveFilesOf(message.words[0], (files) => ask('files', { files }).catch(() => {}));
  return ask(name, message);
}

export const view = {
  picture: null, // the last drawing, without its pixels
  size: null, // width and height of the command line's picture; quick pictures are smaller
  explained: null, // the program's explanation of a pixel
  camera: null, // the current camera, newer than the picture during a gesture
  sphere: null,
  moving: false, // true while a gesture is in progress
  isIdle: false, // true after the first drawing has ended
  shapes: [],
  options: [],
  endings: [], // file name endings of models
  materials: [], // their names
  environments: [],
  settings: new Map(), // the values that the scene file gives to options, by the options' names
  missing: [], // paths of the model's missing files
  refusal: null, // the error message if missing files prevent a picture; null: there is a picture
};

const listeners = new Map();

export function on(name, listener) {
  listeners.set(name, [...(listeners.get(name) ?? []), listener]);
}

export function emit(name) {
  for (const listener of listeners.get(name) ?? []) listener();
}

// The page stores files under absolute paths. Messages show their names without the leading '/', as the command line does.
export function plainNames(sentence) {
  const paths = [state.model, ...openedPaths(), ...view.missing].filter((path) => path.startsWith('/'));
  return sentence.replace(/(^|[\s'"(])\//g, (found, before, at) => (paths.some((path) => sentence.startsWith(path, at + before.length)) ? before : found));
}

// Shows a message of the program or of the page, with buttons for possible actions, until the next picture.
export function refuse(sentence, ...buttons) {
  $('message-text').textContent = plainNames(sentence);
  $('message-buttons').replaceChildren(...buttons);
  $('message').hidden = false;
}

// Announces a sentence to screen readers. Nothing is visible.
export function say(sentence) {
  $('spoken').textContent = sentence;
}

// --- gestures: a gesture is one step of undo; the page draws quick pictures until the gesture ends

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
