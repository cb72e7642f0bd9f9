// explanation.js: one pixel's calculation as tables: each light with its vectors, cosines and terms, then the sum.

import { text } from './strings.js';

const number = (x) => (x === null || x === undefined ? '' : Math.abs(x) >= 1e-4 || x === 0 ? String(+x.toFixed(4)) : x.toExponential(2));
const triple = (v) => (v ? v.map(number).join(' ') : '');

// Cells are keys of strings.js, {key}, or symbols, numbers and names.
function row(kind, cells) {
  const tr = document.createElement('tr');
  cells.forEach((content, i) => {
    const cell = document.createElement(kind === 'head' || i === 0 ? 'th' : 'td');
    cell.textContent = content.key ? text(content.key) : content;
    cell.translate = Boolean(content.key);
    tr.append(cell);
  });
  return tr;
}

function paragraph(content) {
  const p = document.createElement('p');
  p.textContent = content;
  return p;
}

export function explanation(pixel) {
  const place = document.createDocumentFragment();
  place.append(paragraph(text('pixel', { ...pixel, bytes: pixel.bytes.join(' ') })));
  if (!pixel.triangles.length) {
    place.append(paragraph(text('background')));
    return place;
  }
  const triangle = pixel.triangles[0], point = triangle.points[0];
  place.append(paragraph(text('surface', { object: triangle.object_name ?? text('unnamedObject', { number: triangle.object }), triangle: triangle.triangle,
    side: triangle.side, n: triple(point.n), v: triple(point.v), ambient: triple(point.ambient_term) })));
  const table = document.createElement('table');
  const head = document.createElement('thead'), body = document.createElement('tbody');
  head.append(row('head', [{ key: 'light' }, 'l', 'h', 'n·l', { key: 'attenuation' }, { key: 'spot' }, 'D', 'S', { key: 'diffuse' }, { key: 'specular' }]));
  for (const light of point.lights)
    body.append(row('body', [light.name ?? light.type, triple(light.l), triple(light.h), number(light.n_dot_l), number(light.attenuation), number(light.spot),
      number(light.D), number(light.S), triple(light.diffuse_term), triple(light.specular_term)]));
  table.append(head, body);
  place.append(table);
  place.append(paragraph(text('sum', { sum: triple(pixel.sum) })));
  return place;
}
