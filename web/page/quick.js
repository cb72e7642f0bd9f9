// quick.js: the first tab, with the most common settings. Its contents are fetched while the first picture is drawn.
import { on, refuse } from './app.js';
import { text } from './strings.js';
import { addTab } from './tabs.js';

addTab('quick', text('tabQuick'));
on('ready', () => import('./picture_tab.js').catch((error) => refuse(error.message)));
