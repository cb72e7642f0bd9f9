// later.js: fetches modules of the page when they are first used, and adds their tabs.
import { fetchRest, on, refuse, state, view } from './shared/app.js';
import { $ } from './base/dom.js';
import { keepOffline } from './worker/offline.js';
import { addTab } from './base/tabs.js';
import { text } from './base/strings.js';

const used = (loading) => loading.catch((error) => refuse(error.message));

addTab('contents', text('tabContents'), () => used(import('./tabs/contents_tab.js')));
addTab('options', text('tabOptions'), () => used(import('./tabs/panel.js')));
addTab('lights', text('tabLights'), () => used(import('./lights/light_tab.js')));
addTab('explain', text('tabExplain'), () => used(import('./explain/explaining.js')));
addTab('shaders', text('tabShaders'), () => used(import('./shaders/shaders.js')));

// Explains the point at a fraction of the picture's width and height.
export async function explainAt(across, down) {
  const explaining = await used(import('./explain/explaining.js'));
  explaining?.pinAt(across, down);
}

let isFirst = true;
on('still', () => {
  const rest = fetchRest().catch(() => {}); // a later call asks again and reports the error
  if (isFirst) rest.then(keepOffline);
  isFirst = false;
  if (state.values('light').length || view.picture.own_lights) used(import('./lights/handles.js'));
});

$('compare').onclick = async () => (await used(import('./picture/split.js')))?.toggle();
$('export').onclick = async () => (await used(import('./files/save_dialog.js')))?.openSaveDialog();
