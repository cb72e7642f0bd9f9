// quick.js: the first tab: the options that are used most, by their names in the program's table.
import { on, state, view } from './app.js';
import { Row } from './row.js';
import { text } from './strings.js';
import { addTab } from './tabs.js';

const NAMES = ['reflection', 'shading', 'show', 'color', 'shininess', 'normals', 'wireframe', 'look', 'shadows', 'ao', 'environment', 'background', 'size'];

const place = addTab('quick', text('tabQuick'));
let rows = [];

on('ready', () => {
  rows = NAMES.map((name) => new Row(view.options.find((option) => option.name === name), 'quick'));
  place.append(...rows.map((row) => row.place));
});
on('words', () => {
  if (!view.moving) for (const row of rows) row.show(state.values(row.option.name));
});
