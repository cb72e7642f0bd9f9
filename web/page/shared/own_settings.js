// own_settings.js: reads the settings of a scene file, so that the controls show them instead of the program's defaults.
import { call, emit, on, state, view } from './app.js';
import { isScene } from '../words/state.js';

const NOT_SETTINGS = ['lambent', 'materials', 'objects', 'lights'];
let model = null, content = '';

function textOf(value, name) {
  if (Array.isArray(value)) return value.join({ size: 'x', edges: ',' }[name] ?? '/');
  return typeof value === 'boolean' ? (value ? 'on' : 'off') : String(value);
}

// Returns the values of a scene file's settings by the names of their options. A flag has the value 'on' or 'off'.
function settingsOf({ image = {}, environment, reflection_map: map, camera, ...settings }) {
  const around = environment ?? map, name = around?.builtin ?? around?.equirectangular ?? around?.faces;
  const surroundings = around && { [map ? 'reflection-map' : 'environment']: name, environment_rotation: around.rotation };
  const found = { ...settings, ...image, ...surroundings, projection: camera?.ortho ? 'orthographic' : undefined };
  return new Map(Object.entries(found).filter(([name, value]) => value !== undefined && !NOT_SETTINGS.includes(name))
    .map(([name, value]) => [name.replaceAll('_', '-'), textOf(value, name)]));
}

async function read() {
  const { words } = state, scene = isScene(words[0]);
  const bytes = scene ? await call('file', { words, path: words[0] }).catch(() => null) : null; // null if the program draws the scene (lambent view)
  const now = bytes ? new TextDecoder().decode(bytes) : '';
  if (words[0] !== state.model || (model === words[0] && content === now)) return;
  [model, content] = [words[0], now];
  try {
    view.settings = now ? settingsOf(JSON.parse(now)) : new Map();
  } catch {
    view.settings = new Map(); // a file that the program reads, but JSON.parse does not
  }
  emit('settings');
}

// Returns the value that the scene file gives an option, or null.
export const ownValue = (name) => (model === state.model ? view.settings.get(name) ?? null : null);

on('still', read);
if (view.picture) read();
