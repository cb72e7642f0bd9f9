// written_lights.js: writes the lights of the picture as options, so that the user can change lights that the program has chosen.
import { call, state } from './app.js';
import { lightWords } from './lights.js';
import { State } from './state.js';

// Returns the words with the picture's lights, and the number of lights. Draws the picture with these words, and returns null if it differs from the picture
// before.
export async function writtenLights() {
  const before = state.words, { lights, ambient } = await call('lights', { words: before });
  let words = state.withValues('rig', []);
  const change = (name, values) => (words = new State(words).withValues(name, values));
  change('light', lights.map(lightWords));
  change('ambient', ambient.some((x) => x > 0) ? [ambient.join('/')] : []);
  const [old, now] = [await call('draw', { words: before }), await call('draw', { words })];
  return old.pixels.some((byte, i) => byte !== now.pixels[i]) ? null : { words, count: lights.length };
}
