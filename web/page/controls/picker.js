// picker.js: a colour field with the browser's colour picker. All changes during one use of the picker are one step of undo.
import { beginGesture, endGesture, gestureKey, view } from '../shared/app.js';
import { element } from '../base/dom.js';

const probe = document.createElement('canvas').getContext('2d');
const byte = (x) => Math.round(255 * Math.max(0, Math.min(1, x))).toString(16).padStart(2, '0');
const encoded = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

// Returns "#rrggbb" for linear red, green and blue.
export const hexOf = (rgb) => `#${rgb.map((x) => byte(encoded(x))).join('')}`;

// Converts a colour of an option to "#rrggbb". The colour is #rgb, #rrggbb, #rrggbbaa, a name, linear r/g/b, or one linear number. Returns null for any other
// form.
function hexOfText(value) {
  const numbers = value.split('/').map(Number);
  if (numbers.every((x) => x >= 0) && value !== '' && numbers.length !== 2 && numbers.length < 5) return hexOf(numbers.length === 1 ? [numbers[0], numbers[0], numbers[0]] : numbers.slice(0, 3));
  if (/^#[\da-f]{8}$/i.test(value)) return value.slice(0, 7).toLowerCase();
  probe.fillStyle = '#010203';
  probe.fillStyle = value;
  return /^#[\da-f]{6}$/.test(probe.fillStyle) && probe.fillStyle !== '#010203' ? probe.fillStyle : null;
}

export class Picker {
  constructor(label, take) {
    this.input = element('input', { type: 'color', attributes: { 'aria-label': label } });
    this.input.oninput = () => {
      beginGesture();
      take(this.input.value, gestureKey());
    };
    this.input.onchange = endGesture;
  }

  show(value) {
    if (!view.moving) this.input.value = hexOfText(value) ?? '#808080';
  }
}
