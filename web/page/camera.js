// camera.js: orbit, pan and zoom of a camera that is held as the text of --camera. Every step starts from the numbers that the text
// says, and ends with a text: what is drawn, copied and linked is the same decimal numbers.

export const sub = (a, b) => a.map((x, i) => x - b[i]);
export const add = (a, b, k = 1) => a.map((x, i) => x + k * b[i]);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const scale = (a, k) => a.map((x) => x * k);
export const length = (a) => Math.sqrt(dot(a, a));
export const unit = (a) => scale(a, 1 / (length(a) || 1));

// Five digits below the size of the view, without zeros at the end.
export function decimal(x, digits) {
  const text = x.toFixed(digits);
  return text.includes('.') ? text.replace(/\.?0+$/, '').replace(/^-0$/, '0') : text;
}

export function cameraText(camera) {
  const distance = length(sub(camera.eye, camera.target));
  const digits = Math.min(12, Math.max(0, 5 - Math.floor(Math.log10(distance))));
  const triple = (v, d = digits) => v.map((x) => decimal(x, d)).join('/');
  return `eye=${triple(camera.eye)},target=${triple(camera.target)},up=${triple(camera.up, 5)},` +
    (camera.ortho > 0 ? `ortho=${decimal(camera.ortho, digits)}` : `fovy=${decimal(camera.fovy_deg, 4)}`);
}

// A vector turned about a unit axis (Rodrigues' formula).
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

// The whole camera around a point: radians to the right, and up to a little below the pole, the axis that stays upright.
export function orbit(camera, right, up, pole, centre) {
  const axis = unit(pole), out = unit(sub(camera.eye, camera.target));
  const elevation = Math.asin(Math.max(-1, Math.min(1, dot(out, axis))));
  const level = sub(out, scale(axis, dot(out, axis)));
  // Straight above or below, what is up in the picture says where the side is.
  const forward = length(level) > 1e-6 ? unit(level) : unit(scale(camera.up, elevation > 0 ? -1 : 1));
  const side = unit(cross(axis, forward)), climb = Math.max(-1.55, Math.min(1.55, elevation + up)) - elevation;
  const around = (point) => add(centre, turned(turned(sub(point, centre), side, -climb), axis, right));
  return { ...camera, eye: around(camera.eye), target: around(camera.target), up: axis };
}

// The same direction, from so far that a ball is in the picture however the camera turns around it: one fit for all angles.
export function around(camera, sphere, aspect) {
  const out = unit(sub(camera.eye, camera.target)), half = (camera.fovy_deg * Math.PI) / 360;
  const tight = Math.min(half, Math.atan(Math.tan(half) * aspect));
  const distance = sphere.radius / Math.sin(tight);
  const ortho = camera.ortho > 0 ? sphere.radius / Math.min(1, aspect) : 0;
  return { ...camera, eye: add(sphere.centre, out, distance), target: sphere.centre, ortho };
}

// Moves the view to the right and up, by parts of the picture's height.
export function pan(camera, right, up) {
  const out = sub(camera.eye, camera.target), back = unit(out);
  const side = unit(cross(camera.up, back)), above = cross(back, side);
  const height = camera.ortho > 0 ? 2 * camera.ortho : 2 * length(out) * Math.tan((camera.fovy_deg * Math.PI) / 360);
  const move = add(scale(side, -right * height), above, -up * height);
  return { ...camera, eye: add(camera.eye, move), target: add(camera.target, move) };
}

export function zoom(camera, factor) {
  if (camera.ortho > 0) return { ...camera, ortho: camera.ortho / factor };
  return { ...camera, eye: add(camera.target, sub(camera.eye, camera.target), 1 / factor) };
}

// The numbers that a text of cameraText says.
export function readCamera(text) {
  const parts = Object.fromEntries(text.split(',').map((part) => part.split('=')));
  const triple = (v) => v.split('/').map(Number);
  return { eye: triple(parts.eye), target: triple(parts.target), up: triple(parts.up),
    ortho: parts.ortho ? Number(parts.ortho) : 0, fovy_deg: parts.fovy ? Number(parts.fovy) : 30 };
}

// The eye's axes in the world: to the right, up, and back towards the eye.
export function cameraAxes(camera) {
  const back = unit(sub(camera.eye, camera.target)), side = unit(cross(camera.up, back));
  return { side, above: cross(back, side), back };
}

// Half the height of the picture at a depth before the eye, in model units.
const halfHeight = (camera, depth) => (camera.ortho > 0 ? camera.ortho : depth * Math.tan((camera.fovy_deg * Math.PI) / 360));

// Where the picture shows a point: parts of its width and height from the upper left corner. `behind`: the eye looks away from it.
export function project(camera, point, aspect) {
  const { side, above, back } = cameraAxes(camera), way = sub(point, camera.eye), depth = -dot(way, back);
  const behind = camera.ortho <= 0 && depth < 1e-3 * length(way), half = halfHeight(camera, behind ? 0.02 * length(way) || 1 : depth);
  return { x: 0.5 + dot(way, side) / (2 * half * aspect), y: 0.5 - dot(way, above) / (2 * half), depth, behind };
}

// The point moved in the plane of the picture, by parts of the picture's height, and away from the eye by a factor of its distance.
export function shifted(camera, point, right, up, away = 0) {
  const { side, above, back } = cameraAxes(camera), depth = Math.max(-dot(sub(point, camera.eye), back), 0.02 * length(sub(camera.eye, camera.target)));
  const height = 2 * halfHeight(camera, depth);
  return add(add(add(point, side, right * height), above, up * height), back, -away * height);
}
