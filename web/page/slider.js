// slider.js: a slider with its number. `title`: what stands before it; `take` gets the number as text while it moves. One gesture is one step of undo.
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

// Shows another number, unless a hand is on the slider.
export function showNumber(made, value) {
  const input = made.querySelector('input');
  if (Number(input.value) !== Number(value)) input.value = value;
  made.querySelector('output').textContent = Number(Number(value).toFixed(2));
}
