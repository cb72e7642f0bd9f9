// written_lights.js: writes the picture's lights as options, so that the page can change lights that the program has chosen or read from a file.
import { call, emit, on, state, view } from '../shared/app.js';
import { lightWords, newLight } from '../words/lights.js';
import { State, appearance } from '../words/state.js';

const MOST = 16; // if a file contains more lights, the page does not change them
const SMALL = ['96x96'];
let own = null; // the lights of the model's file, and the words that they were read for

// `lights`: { texts, ambient, exposure, tone } of readLights.
export function withLights(words, { texts, ambient, exposure, tone }) {
  const change = (name, values) => (words = new State(words).withValues(name, values));
  change('rig', []);
  change('light', texts);
  change('exposure', exposure);
  if (tone) change('tone', [tone]);
  return change('ambient', ambient);
}

// Returns the lights of the picture. The lights of a glTF file need an automatic exposure. Returns null if the picture with the written lights differs.
export async function readLights(words) {
  const { lights, ambient, image } = await call('lights', { words }), old = await call('draw', { words });
  for (const exposure of [new State(words).values('exposure'), ['auto']]) {
    const made = { texts: lights.map(lightWords), ambient: ambient.some((x) => x > 0) ? [ambient.join('/')] : [], exposure, tone: image?.tone };
    const now = await call('draw', { words: withLights(words, made) });
    if (now.pixels.every((byte, i) => byte === old.pixels[i])) return made;
  }
  return null;
}

const isOwn = () => view.picture?.own_lights && !state.values('light').length && own?.texts && own.model === state.model;

// Returns the lights that the page can change: the lights of --light if there are any, otherwise the lights of the model's file.
export const lightsNow = () => (isOwn() ? own.texts : state.values('light'));

// Returns the words in which --light sets these lights.
export const wordsOfLights = () => (isOwn() ? withLights(state.words, own) : state.words);

export const setLights = (texts, key = null) => state.set(new State(wordsOfLights()).withValues('light', texts), key);

// Removes a light. "none" keeps the lights away that would return without any light: the lights of the model's file, or of the program. Removing "none"
// restores them.
export function removeLight(i) {
  const texts = lightsNow(), rest = texts.filter((_, at) => at !== i), replaced = texts[i] !== 'none' && !texts[i].startsWith('+');
  setLights(replaced && rest.every((one) => one.startsWith('+')) ? ['none', ...rest] : rest);
}

// Adds a light and removes "none".
export function addLight(type) {
  const texts = lightsNow(), rest = texts.filter((one) => one !== 'none');
  setLights([...rest, newLight(type, texts, rest.length)]);
}

// Reads the lights of a file when its picture is shown, and again when an option may have changed them.
async function readOwn() {
  const { words, model } = state, key = appearance(words);
  if (!view.picture.own_lights || own?.key === key) return;
  const small = new State(words).withValues('size', SMALL), made = await readLights(small).catch(() => null);
  own = { key, model, ...(made?.texts.length <= MOST ? made : {}) };
  emit('lights');
}
on('still', readOwn);
if (view.picture) readOwn();
