// page.js: starts the page and imports its modules (app.js describes them). Tabs appear in the order of these imports.
import { call, emit, refuse, state, view } from './shared/app.js';
import { takeInsideFiles } from './base/inside.js';
import { MODULE_BYTES } from './base/memory.js';
import { addFiles } from './shared/opened.js';
import './picture/drawing.js';
import './picture/poster.js';
import './files/files.js';
import './quick.js';
import './later.js';
import './gestures.js';
import './shared/window_size.js';
import './picture/bar.js';

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
if (document.getElementById('served')) import('./picture/viewer.js'); // `lambent view`
start();
