// scene.js: saves the scene file of the picture, as --save-scene does. The scene file refers to the model's files and does not contain them.
import { call, refuse, state } from './app.js';
import { download } from './bar.js';
import { $ } from './dom.js';
import { text } from './strings.js';

export async function saveScene() {
  try {
    $('status').textContent = text('savedScene', { file: download(await call('scene', { words: state.words }), '.json', 'application/json') });
  } catch (error) {
    refuse(error.message);
  }
}
