// panel.js: a control for each option of the program's table, in the groups of its help, found by name, by other names that people
// try, and by what it says of itself.

import { element, ours } from './dom.js';
import { text } from './strings.js';

// They name files to write, which the page does by buttons.
const LEFT_OUT = ['output', 'save-scene', 'durable', 'compress', 'quality'];

export class Panel {
  #rows = [];

  constructor(place, search, none, options, change) {
    const groups = new Map();
    for (const option of options) {
      if (LEFT_OUT.includes(option.name)) continue;
      if (!groups.has(option.group)) {
        const details = element('details', {}, ours('summary', option.group));
        details.open = groups.size < 1;
        groups.set(option.group, details);
        place.append(details);
      }
      const row = new Row(option, change);
      this.#rows.push(row);
      groups.get(option.group).append(row.place);
    }
    search.oninput = () => (none.hidden = this.#find(search.value.trim().toLowerCase(), groups));
  }

  // Whether any option has the words.
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

class Row {
  constructor(option, change) {
    this.option = option;
    this.change = (values) => change(option.name, values);
    this.label = ours('label', option.name, { htmlFor: `option-${option.name}` });
    this.reset = element('button', { type: 'button', className: 'reset', textContent: '×', title: text('without', { option: `--${option.name}` }), hidden: true,
      attributes: { 'aria-label': text('without', { option: `--${option.name}` }) } });
    this.reset.onclick = () => this.change([]);
    this.inputs = element('div');
    const about = element('p', { id: `about-${option.name}` }, ours('span', option.summary));
    if (option.default) about.append(' ', element('span', { textContent: text('standard', { value: option.default }) }));
    this.place = element('div', { className: 'option' }, this.label, this.inputs, this.reset, about);
    this.show([]);
  }

  matches(wanted) {
    const o = this.option, words = (o.words ?? []).map((word) => word.name).join(' ');
    return wanted.split(/\s+/).every((part) => `${o.name} ${o.others ?? ''} ${o.summary} ${words}`.toLowerCase().includes(part));
  }

  show(values) {
    const key = values.join('\n');
    if (this.shown === key) return;
    this.shown = key;
    this.reset.hidden = !values.length;
    this.label.classList.toggle('given', values.length > 0);
    const focused = this.inputs.contains(document.activeElement);
    const shown = this.option.repeats ? [...values, null] : [values.length ? values.at(-1) : null];
    this.inputs.replaceChildren(...shown.map((value, i) => this.#control(value, i, values)));
    if (focused) this.inputs.firstChild.focus();
  }

  #control(value, i, values) {
    const o = this.option;
    const take = (value) => {
      const next = [...values];
      if (value === '') next.splice(i, 1);
      else next[o.repeats ? i : 0] = value;
      this.change(o.repeats ? next : next.slice(0, 1));
    };
    let control;
    if (!o.value) {
      control = element('input', { type: 'checkbox', checked: value !== null });
      control.onchange = () => this.change(control.checked ? [''] : []);
    } else if (o.words && !o.repeats && o.kind === 'any' && !o.words.some((word) => /[A-Z]/.test(word.name)) && (value === null || o.words.some((word) => word.name === value))) {
      control = element('select', { translate: false }, new Option('—', ''), ...o.words.map((word) => {
        const choice = new Option(word.name, word.name);
        choice.title = word.summary ?? '';
        return choice;
      }));
      control.value = value ?? '';
      control.onchange = () => take(control.value);
    } else {
      control = element('input', { type: o.number && (value === null || isFinite(value)) ? 'number' : 'text', value: value ?? '', placeholder: o.value, translate: false });
      if (control.type === 'number') {
        control.step = o.whole ? 1 : 'any';
        if (o.min !== undefined) Object.assign(control, { min: o.min, max: o.max });
      }
      control.onchange = () => take(control.value.trim());
    }
    if (i === 0) control.id = `option-${o.name}`;
    else control.setAttribute('aria-label', o.name);
    control.setAttribute('aria-describedby', `about-${o.name}`);
    return control;
  }
}
