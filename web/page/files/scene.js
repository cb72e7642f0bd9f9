// scene.js: saves the scene file of the picture, as --save-scene does. The scene file refers to the model's files and does not contain them.
import { call, refuse, state } from '../shared/app.js';
import { download } from '../picture/bar.js';
import { $ } from '../base/dom.js';
import { text } from '../base/strings.js';

export async function saveScene() {
  try {
    $('status').textContent = text('savedScene', { file: download(await call('scene', { words: state.words }), '.json', 'application/json') });
  } catch (error) {
    refuse(error.message);
  }
}
