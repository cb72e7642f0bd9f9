// slider.js: makes a slider that shows its number. `title` is the element before the slider. While the user moves the slider, `take` is called with the number
// as text. The whole movement is one step of undo.
import { beginGesture, endGesture } from '../shared/app.js';
import { element } from '../base/dom.js';

export function slider(title, label, [least, most, step], value, take) {
  const input = element('input', { type: 'range', min: least, max: most, step, attributes: { 'aria-label': label } });
  input.value = value;
  const output = element('output', { textContent: value, translate: false });
  input.oninput = () => {
    output.textContent = input.value;
    beginGesture();
    take(input.value);
  };
  input.onchange = endGesture;
  return element('label', { className: 'slider' }, title, input, output);
}

// Shows another number, except while the user moves the slider.
export function showNumber(made, value) {
  const input = made.querySelector('input');
  if (Number(input.value) !== Number(value)) input.value = value;
  made.querySelector('output').textContent = Number(Number(value).toFixed(2));
}
