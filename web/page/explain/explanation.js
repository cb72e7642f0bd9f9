// explanation.js: shows the calculation of one pixel: the sum, then the equations of each light. The details of one light are open, and its arrows are shown.
import { state } from '../shared/app.js';
import { curvesOf } from './curves.js';
import { element, ours } from '../base/dom.js';
import { aroundEquations, lightEquations, number, pixelEquations, sumEquation, triple } from './equations.js';
import { plainName } from '../words/lights.js';
import { text } from '../base/strings.js';

const strength = (light) => light.diffuse_term.concat(light.specular_term).reduce((sum, x) => sum + x, 0);
const greatest = (values) => values.reduce((best, value, i) => (value > values[best] ? i : best), 0);
const degrees = (x) => `${number(x)}°`;
const sentence = (content) => element('p', { textContent: content });

// Shows "name = formula = values = result", wrapped to as many lines as necessary.
function equation({ name, formula, values, result }) {
  const parts = [formula, values].filter(Boolean).map((part) => element('span', { textContent: ` = ${part}` }));
  return element('p', { className: 'equation', translate: false }, element('b', { textContent: name }), ...parts,
    element('span', { className: 'result', textContent: ` = ${Array.isArray(result) ? triple(result) : number(result)}` }));
}

function vector(name, value, about) {
  return element('p', { className: 'equation' }, element('b', { className: `chip arrow-${name}`, textContent: name, translate: false }),
    element('span', { textContent: ` = (${value.map(number).join(', ')}) `, translate: false }), element('small', { textContent: text(about) }));
}

export class Explanation {
  // `choose` is called with { point, light } when a corner or a light is chosen.
  constructor(place, choose) {
    this.place = place;
    this.choose = choose;
    this.chosen = { point: 0, light: 0 };
    this.picked = { point: null, light: null }; // chosen by the user; null: the program chooses the largest contribution
  }

  show(pixel) {
    const triangle = pixel.triangles[0];
    this.pixel = pixel;
    if (triangle) {
      const corner = this.picked.point ?? greatest(triangle.weights);
      this.chosen.point = triangle.points.length > 1 ? corner : 0;
      const { lights } = triangle.points[this.chosen.point];
      this.chosen.light = Math.min(this.picked.light ?? greatest(lights.map(strength)), Math.max(0, lights.length - 1));
    }
    const color = element('span', { className: 'color', attributes: { 'aria-hidden': 'true' } });
    color.style.background = `rgb(${pixel.bytes.slice(0, 3).join(' ')})`;
    const first = sentence(text('pixel', { ...pixel, bytes: pixel.bytes.join(' ') }));
    first.prepend(color, ' ');
    this.place.replaceChildren(first, ...(triangle ? this.#surface(triangle) : [sentence(text('background'))]));
  }

  #surface(triangle) {
    const point = triangle.points[this.chosen.point], parts = [];
    parts.push(sentence(text('surface', { object: triangle.object_name ?? text('unnamedObject', { number: triangle.object }), triangle: triangle.triangle, side: triangle.side })));
    if (triangle.points.length > 1) parts.push(this.#corners(triangle));
    parts.push(vector('n', point.n, triangle.lit_normal === '-n' ? 'aboutNormalBack' : 'aboutNormal'), vector('v', point.v, 'aboutView'));
    parts.push(element('h2', { textContent: text('sumTitle') }), equation(sumEquation(point)));
    if (triangle.points.length > 1) parts.push(sentence(text('interpolated', { color: triple(triangle.color.slice(0, 3)) })));
    if (this.pixel.triangles.length > 1) parts.push(sentence(text('moreTriangles', { count: this.pixel.triangles.length - 1 })));
    parts.push(element('h2', { textContent: text('bytesTitle') }), ...pixelEquations(this.pixel).map(equation));
    const around = aroundEquations(triangle, point);
    if (around.length) parts.push(element('h2', { textContent: text('aroundTitle') }));
    if (point.environment && around.length) parts.push(vector('R', point.environment.R, 'aboutReflected'));
    parts.push(...around.map(equation));
    if (point.lights.length) parts.push(element('h2', { textContent: text('lightsTitle') }));
    point.lights.forEach((light, i) => parts.push(this.#light(triangle, point, light, i)));
    return parts;
  }

  #corners(triangle) {
    const group = element('div', { className: 'buttons', attributes: { role: 'group', 'aria-label': text('corners') } });
    triangle.points.forEach((point, i) => {
      const one = element('button', { type: 'button', textContent: text('corner', { number: i, weight: number(triangle.weights[i]) }), attributes: { 'aria-pressed': String(i === this.chosen.point) } });
      one.onclick = () => {
        this.picked.point = i;
        this.show(this.pixel);
        this.choose(this.chosen);
      };
      group.append(one);
    });
    return group;
  }

  #light(triangle, point, light, i) {
    const open = i === this.chosen.light;
    const details = element('details', { open, className: 'light' });
    const added = light.diffuse_term.map((x, k) => x + light.specular_term[k]);
    const title = element('summary', {}, ours('span', plainName(light.name ?? light.type)), ours('small', ` +${triple(added)}`));
    details.append(title);
    // The details are filled when they are opened. The arrows then show the opened light.
    if (open) details.append(...this.#inside(triangle, point, light, i));
    title.onclick = (event) => {
      event.preventDefault();
      if (open) return;
      this.picked.light = i;
      this.show(this.pixel);
      this.choose(this.chosen);
      this.place.querySelectorAll('details.light > summary')[i].focus();
    };
    return details;
  }

  #inside(triangle, point, light, i) {
    const parts = [vector('l', light.l, 'aboutLight')];
    if (triangle.formulas.threads && point.t) parts.push(vector('t', point.t, 'aboutTangent'));
    else parts.push(vector('r', light.r, 'aboutMirrored'), vector('h', light.h, 'aboutHalf'), element('p', { className: 'equation', translate: false, textContent: `θ(n,l) ${degrees(light.theta_deg)} · φ(r,v) ${degrees(light.phi_deg)} · ψ(n,h) ${degrees(light.psi_deg)}` }));
    if (light.v_off_plane_deg > 0.05 && !triangle.formulas.threads) parts.push(sentence(text('offPlane', { degrees: number(light.v_off_plane_deg) })));
    if (light.left_out) parts.push(sentence(text('leftOut')));
    parts.push(...lightEquations(triangle, point, light).map(equation));
    // The previous curves stay visible until the new curves arrive.
    const holder = element('div', {}, ...(this.curves ? [this.curves] : []));
    curvesOf({ words: state.words, light: i, explained: light, triangle }).then((curves) => {
      this.curves = curves;
      holder.replaceChildren(curves);
    }, () => {});
    parts.push(holder);
    return parts;
  }
}
