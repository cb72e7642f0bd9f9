// later.js: fetches modules of the page when they are first used, and adds their tabs.
import { fetchRest, on, refuse, state, view } from './app.js';
import { $ } from './dom.js';
import { keepOffline } from './offline.js';
import { addTab } from './tabs.js';
import { text } from './strings.js';

const used = (loading) => loading.catch((error) => refuse(error.message));

addTab('contents', text('tabContents'), () => used(import('./contents_tab.js')));
addTab('options', text('tabOptions'), () => used(import('./panel.js')));
addTab('lights', text('tabLights'), () => used(import('./light_tab.js')));
addTab('explain', text('tabExplain'), () => used(import('./explaining.js')));
addTab('shaders', text('tabShaders'), () => used(import('./shaders.js')));

// Explains the point at a fraction of the picture's width and height.
export async function explainAt(across, down) {
  const explaining = await used(import('./explaining.js'));
  explaining?.pinAt(across, down);
}

let isFirst = true;
on('still', () => {
  const rest = fetchRest().catch(() => {}); // a later call asks again and reports the error
  if (isFirst) rest.then(keepOffline);
  isFirst = false;
  if (state.values('light').length || view.picture.own_lights) used(import('./handles.js'));
});

$('compare').onclick = async () => (await used(import('./split.js')))?.toggle();
$('export').onclick = async () => (await used(import('./save_dialog.js')))?.openSaveDialog();
