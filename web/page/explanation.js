// explanation.js: one pixel's calculation as tables: each light with its vectors, cosines and terms, then the sum.

const number = (x) => (x === null || x === undefined ? '' : Math.abs(x) >= 1e-4 || x === 0 ? String(+x.toFixed(4)) : x.toExponential(2));
const triple = (v) => (v ? v.map(number).join(' ') : '');

function row(kind, cells) {
  const tr = document.createElement('tr');
  cells.forEach((text, i) => {
    const cell = document.createElement(kind === 'head' || i === 0 ? 'th' : 'td');
    cell.textContent = text;
    tr.append(cell);
  });
  return tr;
}

function paragraph(text) {
  const p = document.createElement('p');
  p.textContent = text;
  return p;
}

export function explanation(pixel) {
  const place = document.createDocumentFragment();
  place.append(paragraph(`Pixel ${pixel.x}, ${pixel.y} · ${pixel.shading} shading, ${pixel.reflection} · bytes ${pixel.bytes?.join(' ') ?? ''}`));
  if (!pixel.triangles.length) {
    place.append(paragraph('No surface is here: the background.'));
    return place;
  }
  const triangle = pixel.triangles[0], point = triangle.points[0];
  place.append(paragraph(`${triangle.object_name ?? 'object ' + triangle.object}, triangle ${triangle.triangle}, ${triangle.side} · n ${triple(point.n)} · v ${triple(point.v)} · ambient ${triple(point.ambient_term)}`));
  const table = document.createElement('table');
  const head = document.createElement('thead'), body = document.createElement('tbody');
  head.append(row('head', ['light', 'l', 'h', 'n·l', 'attenuation', 'spot', 'D', 'S', 'diffuse = kd Ld D', 'specular = ks Ls S']));
  for (const light of point.lights)
    body.append(row('body', [light.name ?? light.type, triple(light.l), triple(light.h), number(light.n_dot_l), number(light.attenuation), number(light.spot),
      number(light.D), number(light.S), triple(light.diffuse_term), triple(light.specular_term)]));
  table.append(head, body);
  place.append(table);
  const terms = pixel.sum && !Array.isArray(pixel.sum) ? Object.entries(pixel.sum).filter(([, v]) => Array.isArray(v)).map(([k, v]) => `${k} ${triple(v)}`).join(' · ') : triple(pixel.sum);
  place.append(paragraph(`Sum: ${terms}`));
  return place;
}
