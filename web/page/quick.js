// quick.js: the first tab, with the most common settings. Its contents are fetched while the first picture is drawn.
import { on, refuse } from './shared/app.js';
import { text } from './base/strings.js';
import { addTab } from './base/tabs.js';

addTab('quick', text('tabQuick'));
on('ready', () => import('./tabs/picture_tab.js').catch((error) => refuse(error.message)));
