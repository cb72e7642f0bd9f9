// swatches.js: makes choices with small pictures. At most one choice is selected.
import { on, state } from '../shared/app.js';
import { element, ours } from '../base/dom.js';
import { thumbnail } from './thumbnails.js';

// A choice is { value, name, words (of the picture), label (a text of the page; default: the program's name), color (instead of a picture) }. `chosen` returns
// the current value, and `take` sets it. `named` means that the names are shown below the pictures.
export function swatches({ title, choices, chosen, take, named = false }) {
  const current = ours('span', '', { className: 'chosen' });
  const buttons = choices.map((choice) => {
    const shown = choice.color ? element('span', { className: 'swatch-color' }) : element('canvas', { width: 8, height: 8, attributes: { 'aria-hidden': 'true' } });
    if (choice.color) shown.style.background = choice.color;
    else if (choice.words) thumbnail(shown, choice.words);
    const name = choice.label ?? choice.name, made = element('button', { type: 'button', className: 'swatch', title: name, translate: Boolean(choice.label), attributes: { 'aria-label': name, 'aria-pressed': 'false' } }, shown);
    if (named) made.append(element('span', { textContent: name, attributes: { 'aria-hidden': 'true' } }));
    made.onclick = () => take(choice.value);
    if (!named) Object.assign(made, { onpointerenter: () => showName(choice), onfocus: () => showName(choice), onpointerleave: show, onblur: show });
    return made;
  });
  // Shows a name above the pictures: the name of the chosen picture, or of the picture under the pointer.
  function showName(choice) {
    current.textContent = choice.label ?? choice.name;
    current.translate = Boolean(choice.label);
  }
  function show() {
    const value = chosen();
    choices.forEach((choice, i) => buttons[i].setAttribute('aria-pressed', String(choice.value === value)));
    const one = choices.find((choice) => choice.value === value);
    reach(buttons[choices.indexOf(one)] ?? buttons[0]);
    showName(one ?? { name: value ?? '' });
  }
  // The Tab key reaches one picture, and arrow keys the others.
  function reach(button) {
    for (const other of buttons) other.tabIndex = other === button ? 0 : -1;
  }
  function onkeydown(event) {
    const at = buttons.indexOf(event.target), across = buttons.filter((one) => one.offsetTop === buttons[0].offsetTop).length;
    const to = buttons[{ ArrowRight: at + 1, ArrowLeft: at - 1, ArrowDown: at + across, ArrowUp: at - across, Home: 0, End: buttons.length - 1 }[event.key]];
    if (!to) return;
    reach(to);
    to.focus();
    event.preventDefault();
  }
  on('words', show);
  show();
  return element('div', { className: 'swatches', attributes: { role: 'group', 'aria-label': title } },
    element('p', {}, element('span', { textContent: title }), ' ', current), element('div', { className: named ? 'swatch-grid named' : 'swatch-grid', onkeydown }, ...buttons));
}
