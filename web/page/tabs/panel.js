// panel.js: the tab of all options. It has a control for each option of the program, in the groups of the program's help. The search finds options by name, by
// synonyms and by description.
import { on, state, view } from '../shared/app.js';
import { $, element, ours } from '../base/dom.js';
import { Row } from '../controls/row.js';

// The tab does not show these options. They concern output files, which the page saves by buttons, or a terminal.
const LEFT_OUT = ['output', 'save-scene', 'durable', 'compress', 'quality', 'term'];

class Panel {
  #rows = [];

  constructor(place, search, none, options) {
    const groups = new Map();
    for (const option of options) {
      if (LEFT_OUT.includes(option.name)) continue;
      if (!groups.has(option.group)) {
        const details = element('details', {}, ours('summary', option.group));
        details.open = groups.size < 1;
        groups.set(option.group, details);
        place.append(details);
      }
      const row = new Row(option, 'option');
      this.#rows.push(row);
      groups.get(option.group).append(row.place);
    }
    search.oninput = () => (none.hidden = this.#find(search.value.trim().toLowerCase(), groups));
  }

  // Returns whether any option matches.
  #find(words, groups) {
    for (const row of this.#rows) row.place.hidden = !row.matches(words);
    for (const details of groups.values()) {
      const any = [...details.querySelectorAll('.option')].some((row) => !row.hidden);
      details.hidden = !any;
      if (words) details.open = any;
    }
    return this.#rows.some((row) => !row.place.hidden);
  }

  // Shows the values of the state.
  show(state) {
    for (const row of this.#rows) row.show(state.values(row.option.name));
  }
}

$('panel-options').append($('search'), $('options'), $('no-option'));

// The option table is part of the module, which may still be loading.
let panel = null;
function fill() {
  panel = new Panel($('options'), $('search'), $('no-option'), view.options);
  panel.show(state);
}
if (view.options.length) fill();
else on('ready', fill);
for (const name of ['words', 'settings'])
  on(name, () => {
    if (!view.moving) panel?.show(state);
  });
