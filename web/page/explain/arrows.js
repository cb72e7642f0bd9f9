// arrows.js: draws the vectors of an explained point as arrows over the picture: n, v, l, r, h, the tangent t of threads, and R if the surface reflects the
// environment. All arrows have the same length in space, a fifth of the picture's height. An arrow that points towards the eye or away from it is shown as a ring.
import { view } from '../shared/app.js';
import { project } from '../words/camera.js';
import { $, svg } from '../base/dom.js';

const LENGTH = 0.2, place = $('overlay-arrows');

// Returns for each arrow the name, the vector, and whether the reflection model uses the vector.
function vectorsOf(triangle, point, light) {
  const list = [['n', point.n, true], ['v', point.v, true]];
  if (point.environment && point.terms.reflection.some((x) => x !== 0)) list.push(['R', point.environment.R, true]);
  if (point.t && /\bt,/.test(triangle.formulas.D)) list.push(['t', point.t, true]);
  if (!light) return list;
  const base = triangle.formulas.base ?? '';
  const uses = (name) => base.includes(`·${name}`) || base.includes(`${name}·`) || (triangle.formulas.microfacet && name === 'h');
  return [...list, ['l', light.l, true], ['r', light.r, uses('r')], ['h', light.h, uses('h')]];
}

export function clearArrows() {
  place.replaceChildren();
}

// `chosen` contains the number of the point (a corner in Gouraud shading) and the number of the light.
export function showArrows(pixel, chosen) {
  clearArrows();
  const triangle = pixel?.triangles[0], point = triangle?.points[chosen.point];
  if (!point || !view.picture) return;
  const canvas = $('canvas'), width = canvas.clientWidth, height = canvas.clientHeight;
  const { fovy_deg, ortho } = view.picture.camera, aspect = pixel.width / pixel.height;
  const eye = { eye: [0, 0, 0], target: [0, 0, -1], up: [0, 1, 0], fovy_deg, ortho };
  const onScreen = (v) => {
    const at = project(eye, v, aspect);
    return [at.x * width, at.y * height];
  };
  const tail = onScreen(point.position);
  const depth = ortho > 0 ? 2 * ortho : -2 * point.position[2] * Math.tan((fovy_deg * Math.PI) / 360), labels = [];
  let rings = 0;
  place.setAttribute('viewBox', `0 0 ${width} ${height}`);
  for (const [name, vector, used] of vectorsOf(triangle, point, point.lights[chosen.light])) {
    const tip = onScreen(point.position.map((x, i) => x + LENGTH * depth * vector[i]));
    const group = svg('g', { class: `arrow arrow-${name}${used ? '' : ' unused'}`, 'data-name': name, 'data-tip': tip.map((x) => x.toFixed(2)).join(' ') });
    const [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]], size = Math.hypot(dx, dy), [ux, uy] = size > 0 ? [dx / size, dy / size] : [1, 0];
    if (size < 9) {
      // An arrow towards the eye is a ring with a dot. An arrow away from the eye is a ring with a cross.
      const parts = vector[2] > 0 ? [svg('circle', { cx: tail[0], cy: tail[1], r: 1.5 })] : [svg('path', { d: `M${tail[0] - 5} ${tail[1] - 5}l10 10m0 -10l-10 10` })];
      for (const kind of ['casing', 'core']) group.append(svg('g', { class: kind }, svg('circle', { cx: tail[0], cy: tail[1], r: 7 }), ...parts.map((part) => part.cloneNode())));
    } else {
      const head = Math.min(11, size * 0.5), at = (back, across) => `${tip[0] - back * ux - across * uy} ${tip[1] - back * uy + across * ux}`;
      const line = `M${tail[0]} ${tail[1]}L${at(head * 0.6, 0)}`, point = `M${tip[0]} ${tip[1]}L${at(head, head * 0.45)}L${at(head, -head * 0.45)}Z`;
      for (const kind of ['casing', 'core']) group.append(svg('g', { class: kind }, svg('path', { class: 'shaft', d: line }), svg('path', { class: 'head', d: point })));
    }
    const label = [tip[0] + 13 * ux, tip[1] + 13 * uy];
    // Letters of rings are drawn in a row on the left. The other letters move away from their arrows.
    if (size < 9) [label[0], label[1]] = [tail[0] - 17 * ++rings, tail[1]];
    else for (const other of labels) if (Math.hypot(other[0] - label[0], other[1] - label[1]) < 17) [label[0], label[1]] = [label[0] - 17 * uy, label[1] + 17 * ux];
    labels.push(label);
    const letter = svg('text', { x: label[0], y: label[1] });
    letter.textContent = name === 'n' && triangle.lit_normal === '-n' ? '−n' : name;
    group.append(letter);
    place.append(group);
  }
  place.append(svg('circle', { class: 'foot', cx: tail[0], cy: tail[1], r: 3 }));
}
