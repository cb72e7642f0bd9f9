// move.js: writes a moved camera as the option --camera, which replaces the other options of the view.
import { beginGesture, gestureKey, state, view } from './app.js';
import { cameraText, readCamera } from './camera.js';
import { State, VIEW } from './state.js';

// Moves the camera. Every step starts from the numbers in the text of --camera.
export function move(next) {
  beginGesture();
  const text = cameraText(next);
  let words = state.words;
  for (const name of VIEW) words = new State(words).withValues(name, []);
  view.camera = { ...next, ...readCamera(text) };
  state.set(new State(words).withValues('camera', [text]), gestureKey());
}
