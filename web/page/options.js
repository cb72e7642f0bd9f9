// options.js: the tab of all options.
import { on, state, view } from './app.js';
import { $ } from './dom.js';
import { Panel } from './panel.js';
import { State, VIEW } from './state.js';
import { text } from './strings.js';
import { addTab } from './tabs.js';

addTab('options', text('tabOptions')).append($('search'), $('options'), $('no-option'));
let panel = null;

// An angle takes the place of a camera, and a camera that of every angle.
export function setOption(name, values) {
  let words = state.withValues(name, values);
  const without = VIEW.includes(name) ? ['camera'] : name === 'camera' ? VIEW : [];
  for (const other of without) words = new State(words).withValues(other, []);
  state.set(words);
}

on('ready', () => (panel = new Panel($('options'), $('search'), $('no-option'), view.options, setOption)));
on('words', () => {
  if (!view.moving) panel?.show(state);
});
