// app.js: what the parts of the page share: the state, the calls of the worker, the last picture, events and messages.
//
// A part of the page is a module that takes what it needs from here and adds its listeners when it is imported; page.js imports them all.
//   on('words', f)    the command line has changed, or a gesture has come to an end
//   on('picture', f)  a picture is shown (view.picture); quick ones while something moves too
//   on('still', f)    the picture of the command line is shown, with all of its samples
//   on('ready', f)    the module has started: view.options, view.shapes
import { $ } from './dom.js';
import { insideWords } from './inside.js';
import { openWorker } from './start.js';
import { State, fromFragment } from './state.js';

const START = ['teapot', '--size=960x720'];

export const state = new State(fromFragment(location.hash) ?? insideWords() ?? START);
export const { call } = openWorker();

export const view = {
  picture: null, // of the last drawing, without its pixels
  camera: null, // the one in use, ahead of the picture while something moves
  sphere: null,
  moving: false, // a gesture goes on
  shapes: [],
  options: [],
  files: new Map(),
};

const listeners = new Map();

export function on(name, listener) {
  listeners.set(name, [...(listeners.get(name) ?? []), listener]);
}

export function emit(name) {
  for (const listener of listeners.get(name) ?? []) listener();
}

// A sentence of the program, or of the page, that stays until the next picture.
export function refuse(sentence) {
  $('message').textContent = sentence;
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
  clearTimeout(still);
}

export function endGesture() {
  clearTimeout(still);
  still = setTimeout(() => {
    view.moving = false;
    gesture++;
    state.endGesture();
    emit('words');
  }, 120);
}

state.onchange = () => emit('words');
