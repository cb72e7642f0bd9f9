// panel.js: a control for each option of the program's table, in the groups of its help, found by name, by other names that people
// try, and by what it says of itself.

// They name files to write, which the page does by buttons.
const LEFT_OUT = ['output', 'save-scene', 'durable', 'compress', 'quality'];

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export class Panel {
  #rows = [];

  constructor(place, search, options, change) {
    const groups = new Map();
    for (const option of options) {
      if (LEFT_OUT.includes(option.name)) continue;
      if (!groups.has(option.group)) {
        const details = element('details', {}, element('summary', { textContent: option.group }));
        details.open = groups.size < 1;
        groups.set(option.group, details);
        place.append(details);
      }
      const row = new Row(option, change);
      this.#rows.push(row);
      groups.get(option.group).append(row.place);
    }
    search.oninput = () => this.#find(search.value.trim().toLowerCase(), groups);
  }

  #find(text, groups) {
    for (const row of this.#rows) row.place.hidden = !row.matches(text);
    for (const details of groups.values()) {
      const any = [...details.querySelectorAll('.option')].some((row) => !row.hidden);
      details.hidden = !any;
      if (text) details.open = any;
    }
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
    this.label = element('label', { textContent: option.name, htmlFor: `option-${option.name}` });
    this.reset = element('button', { type: 'button', textContent: '×', title: `Without --${option.name}`, hidden: true });
    this.reset.setAttribute('aria-label', `Without --${option.name}`);
    this.reset.onclick = () => this.change([]);
    this.inputs = element('div');
    const standard = option.default ? ` Default: ${option.default}.` : '';
    const about = element('p', { textContent: option.summary + standard, id: `about-${option.name}` });
    this.place = element('div', { className: 'option' }, this.label, this.inputs, this.reset, about);
    this.show([]);
  }

  matches(text) {
    const o = this.option, words = (o.words ?? []).map((word) => word.name).join(' ');
    return text.split(/\s+/).every((part) => `${o.name} ${o.others ?? ''} ${o.summary} ${words}`.toLowerCase().includes(part));
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
    const take = (text) => {
      const next = [...values];
      if (text === null || text === '') next.splice(i, 1);
      else next[o.repeats ? i : 0] = text;
      this.change(o.repeats ? next : next.slice(0, 1));
    };
    let control;
    if (!o.value) {
      control = element('input', { type: 'checkbox', checked: value !== null });
      control.onchange = () => this.change(control.checked ? [''] : []);
    } else if (o.words && !o.repeats && o.kind === 'any' && !o.words.some((word) => /[A-Z]/.test(word.name)) && (value === null || o.words.some((word) => word.name === value))) {
      control = element('select', {}, new Option('—', ''), ...o.words.map((word) => {
        const choice = new Option(word.name, word.name);
        choice.title = word.summary ?? '';
        return choice;
      }));
      control.value = value ?? '';
      control.onchange = () => take(control.value);
    } else {
      control = element('input', { type: o.number && (value === null || isFinite(value)) ? 'number' : 'text', value: value ?? '', placeholder: o.value });
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
