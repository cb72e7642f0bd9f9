// curves.js: plots a light's attenuation, cone and highlight, and marks the explained point. The values come from the program (web_curves). This file computes
// only their positions.
import { call } from '../shared/app.js';
import { element, svg } from '../base/dom.js';
import { number } from './equations.js';
import { text } from '../base/strings.js';

const WIDTH = 200, HEIGHT = 76, LEFT = 26, BOTTOM = 16, TOP = 6;

// `at` is [x, y] of the marked point, or null.
function plot(title, values, farthest, unit, at) {
  const most = Math.max(1, at ? at[1] : 0, ...values) > 1.001 ? Math.min(2, Math.max(...values)) : 1;
  const x = (share) => LEFT + share * (WIDTH - LEFT - 8), y = (value) => TOP + (1 - Math.min(value, most) / most) * (HEIGHT - TOP - BOTTOM);
  const points = values.map((value, i) => `${x(i / (values.length - 1)).toFixed(1)},${y(value).toFixed(1)}`).join(' ');
  const label = (left, top, content, anchor) => {
    const made = svg('text', { x: left, y: top, 'text-anchor': anchor });
    made.textContent = content;
    return made;
  };
  const drawing = svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: 'curve', role: 'img', translate: 'no',
    'aria-label': at ? text('curveAt', { title, x: number(at[0]) + unit, y: number(at[1]) }) : title },
    svg('path', { class: 'axis', d: `M${LEFT} ${TOP}V${y(0)}H${x(1)}` }), svg('polyline', { points }),
    label(LEFT - 3, TOP + 7, number(most), 'end'), label(LEFT - 3, y(0), '0', 'end'), label(LEFT, HEIGHT - 4, '0', 'start'), label(x(1), HEIGHT - 4, number(farthest) + unit, 'end'));
  if (at) {
    const [px, py] = [x(Math.min(1, at[0] / farthest)), y(at[1])];
    drawing.append(svg('path', { class: 'guide', d: `M${px} ${y(0)}V${py}` }), svg('circle', { cx: px, cy: py, r: 3.5 }));
  }
  return element('figure', {}, element('figcaption', { textContent: title }), drawing);
}

// Returns the plots of a light. `light` is its index among the lights of the picture. `explained` is the same light in an explanation, or null.
export async function curvesOf({ words, light, explained, triangle, type = explained?.type, onlyHighlight = false }) {
  const place = element('div', { className: 'curves' });
  const farthest = Number((2 * (explained?.distance ?? 5)).toPrecision(1)) || 1, reflection = triangle?.model ?? 'blinn-phong';
  const curves = await call('curves', { words, of: { light, farthest, shininess: triangle?.material.shininess ?? 32, reflection } });
  if (type !== 'directional' && !onlyHighlight) place.append(plot(text('curveAttenuation'), curves.attenuation, farthest, '', explained && [explained.distance, explained.attenuation]));
  if (type === 'spot' && !onlyHighlight) {
    const angle = explained && (Math.acos(Math.max(-1, Math.min(1, explained.cos_axis))) * 180) / Math.PI;
    place.append(plot(text('curveSpot'), curves.spot, 90, '°', explained && [angle, explained.spot]));
  }
  // In this plot the light is directly above the surface, so φ is twice ψ.
  if (explained && triangle?.formulas.base && !triangle.formulas.microfacet && curves.highlight.some((value) => value > 0)) {
    const angle = reflection === 'phong' ? explained.phi_deg : 2 * explained.psi_deg;
    place.append(plot(text('curveHighlight'), curves.highlight, 90, '°', [Math.min(90, angle), explained.S]));
  }
  return place;
}
