// slider.js: a slider with its number. `title`: the element before it. `take` receives the number as text during the gesture, which is one step of undo.
import { beginGesture, endGesture } from './app.js';
import { element } from './dom.js';

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
