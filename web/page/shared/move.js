// move.js: writes a moved camera as the option --camera, which replaces the other options of the view.
import { beginGesture, gestureKey, state, view } from './app.js';
import { cameraText, readCamera } from '../words/camera.js';
import { State, VIEW, without } from '../words/state.js';

// Moves the camera. Every step starts from the numbers in the text of --camera.
export function move(next) {
  beginGesture();
  const text = cameraText(next);
  view.camera = { ...next, ...readCamera(text) };
  state.set(new State(without(state.words, ...VIEW)).withValues('camera', [text]), gestureKey());
}
