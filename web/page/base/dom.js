// dom.js: creates elements of the page.
import { text } from './strings.js';

export const $ = (id) => document.getElementById(id);

// Creates an element with properties. `attributes` are HTML attributes that are not properties (aria-…, translate).
export function element(name, { attributes = {}, ...properties } = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

// Creates an element with words of the program, which the page does not translate.
export const ours = (name, content, properties = {}) => element(name, { textContent: content, translate: false, ...properties });

const SVG = 'http://www.w3.org/2000/svg';

export function svg(name, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

export function button(key, action, properties = {}) {
  const made = element('button', { type: 'button', textContent: text(key), ...properties });
  made.onclick = action;
  return made;
}
