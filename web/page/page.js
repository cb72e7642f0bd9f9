// page.js: starts the page and imports its modules (app.js describes them). Tabs appear in the order of these imports.
import { call, emit, refuse, state, view } from './app.js';
import { takeInsideFiles } from './inside.js';
import { MODULE_BYTES } from './memory.js';
import { addFiles } from './opened.js';
import './drawing.js';
import './files.js';
import './quick.js';
import './later.js';
import './gestures.js';
import './window_size.js';
import './bar.js';

async function start() {
  try {
    Object.assign(view, await call('start', { memory: MODULE_BYTES }));
    const files = await takeInsideFiles();
    if (files.size) addFiles(files, state.model);
    emit('ready');
    emit('words');
  } catch (error) {
    refuse(error.message);
  }
}
if (document.getElementById('served')) import('./viewer.js'); // `lambent view`
start();
