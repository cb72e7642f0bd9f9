// row.js: a control for an option of the program's table: its name, value and description.
import { gestureKey, on, state, view } from '../shared/app.js';
import { element, ours } from '../base/dom.js';
import { ownValue } from '../shared/own_settings.js';
import { Picker, hexOf } from './picker.js';
import { showNumber, slider } from './slider.js';
import { FORMULAS, VIEW, withModel, without } from '../words/state.js';
import { text } from '../base/strings.js';

// Sets the values of an option. --camera and the options of the view replace each other. The option of a formula also changes the model.
export function setOption(name, values, key = null) {
  if (name in FORMULAS && state.model !== name) return values.length ? state.set(withModel(state.words, name, values[0])) : undefined;
  if (name in FORMULAS && !values.length) values = [FORMULAS[name]];
  state.set(without(state.withValues(name, values), ...(VIEW.includes(name) ? ['camera'] : name === 'camera' ? VIEW : [])), key);
}

export class Row {
  // The ids of the row's elements begin with `prefix`, because an option can have two controls in the page. `plain` is a name in the page's language, which is
  // shown before the option's own name. `range` contains the minimum, maximum, step and start of a slider.
  constructor(option, prefix, { plain = null, range = null } = {}) {
    this.option = option;
    this.prefix = prefix;
    this.range = range;
    this.hint = plain ? (option.default ?? '') : option.value;
    this.change = (values, key) => setOption(option.name, values, key);
    this.label = ours('label', option.name, { htmlFor: `${prefix}-${option.name}`, title: option.summary });
    if (plain) this.label.replaceChildren(element('span', { textContent: plain, translate: true }), ' ', ours('code', option.name));
    if (option.kind === 'color') this.picker = new Picker(plain ?? text('pickColor', { option: option.name }), (value, key) => this.change([value], key));
    if (range) this.#addSlider(plain ?? option.name);
    this.reset = element('button', { type: 'button', className: 'reset', textContent: '×', title: text('without', { option: `--${option.name}` }), hidden: true,
      attributes: { 'aria-label': text('without', { option: `--${option.name}` }) } });
    this.reset.onclick = () => this.change([]);
    this.inputs = element('div', { className: this.picker ? 'with-color' : '' });
    const about = element('p', { id: `about-${prefix}-${option.name}` }, ours('span', option.summary));
    if (option.default) about.append(' ', element('span', { textContent: text('standard', { value: option.default }) }));
    if (option.name === 'color') on('picture', () => this.#showColor([]));
    this.place = element('div', { className: 'option' }, this.label, this.slider ?? this.inputs, this.reset, about);
    this.show([]);
  }

  // Adds a slider. It starts at the option's default if the default is a number.
  #addSlider(label) {
    const [least, , , start] = this.range;
    this.standard = start ?? (parseFloat(this.option.default ?? '') || Math.max(0, least));
    this.slider = slider('', label, this.range, this.standard, (value) => this.change([value], gestureKey()));
    this.slider.querySelector('input').id = this.label.htmlFor;
  }

  // Without a value, the colour of the scene file or of the model is shown.
  #showColor(values) {
    const own = this.option.name === 'color' && view.picture ? hexOf(view.picture.color) : '';
    this.picker?.show(values.at(-1) ?? ownValue(this.option.name) ?? (own || this.option.default || ''));
  }

  matches(wanted) {
    const o = this.option, words = (o.words ?? []).map((word) => word.name).join(' ');
    return wanted.split(/\s+/).every((part) => `${o.name} ${o.others ?? ''} ${o.summary} ${words}`.toLowerCase().includes(part));
  }

  show(values) {
    const own = ownValue(this.option.name), key = JSON.stringify([values, own]);
    if (this.shown === key) return;
    this.shown = key;
    this.reset.hidden = !values.length;
    this.label.classList.toggle('given', values.length > 0);
    this.#showColor(values);
    if (this.slider) return showNumber(this.slider, [values.at(-1), own].find((value) => value !== null && isFinite(value)) ?? this.standard);
    const focused = this.inputs.contains(document.activeElement);
    const shown = this.option.repeats ? [...values, null] : [values.length ? values.at(-1) : null];
    this.inputs.replaceChildren(...shown.map((value, i) => this.#control(value, i, values)), ...(this.picker ? [this.picker.input] : []));
    if (focused) this.inputs.firstChild.focus();
  }

  // Returns the words for a select element, or null if the option has other values. In the first tab, the words are returned even if the option has other
  // values.
  #words() {
    const { words, repeats, kind } = this.option, plain = (words ?? []).filter((word) => !/[A-Z]/.test(word.name));
    if (!plain.length || repeats) return null;
    return this.prefix === 'quick' || (kind === 'any' && plain.length === words.length) ? plain : null;
  }

  #control(value, i, values) {
    const o = this.option, words = this.#words(), own = ownValue(o.name), standard = own ?? o.default;
    const take = (value) => {
      const next = [...values];
      if (value === '') next.splice(i, 1);
      else next[o.repeats ? i : 0] = value;
      this.change(o.repeats ? next : next.slice(0, 1));
    };
    let control;
    if (!o.value) {
      // An option cannot remove a flag of the scene file.
      control = element('input', { type: 'checkbox', checked: value !== null || own === 'on', disabled: own === 'on', title: own === 'on' ? text('setByScene') : '' });
      control.onchange = () => this.change(control.checked ? [''] : []);
    } else if (words && (value === null || words.some((word) => word.name === value))) {
      control = element('select', { translate: false }, new Option(standard ? `(${standard})` : '—', ''), ...words.map((word) => {
        const choice = new Option(word.name, word.name);
        choice.title = word.summary ?? '';
        return choice;
      }));
      control.value = value ?? '';
      control.onchange = () => take(control.value);
    } else {
      control = element('input', { type: o.number && (value === null || isFinite(value)) ? 'number' : 'text', value: value ?? '', placeholder: own ?? this.hint, translate: false });
      if (control.type === 'number') {
        control.step = o.whole ? 1 : 'any';
        if (o.min !== undefined) Object.assign(control, { min: o.min, max: o.max });
      }
      control.onchange = () => take(control.value.trim());
    }
    if (i === 0) control.id = `${this.prefix}-${o.name}`;
    else control.setAttribute('aria-label', o.name);
    control.setAttribute('aria-describedby', `about-${this.prefix}-${o.name}`);
    return control;
  }
}
