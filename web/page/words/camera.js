// camera.js: turns, pans and zooms a camera that is given as the text of --camera. Every step reads the numbers of the text and writes a new text, so the
// picture, the copied command and the link contain the same decimal numbers.

export const sub = (a, b) => a.map((x, i) => x - b[i]);
export const add = (a, b, k = 1) => a.map((x, i) => x + k * b[i]);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const scale = (a, k) => a.map((x) => x * k);
export const length = (a) => Math.sqrt(dot(a, a));
export const unit = (a) => scale(a, 1 / (length(a) || 1));

// Returns whether the camera sets its near and far planes. If not, the program fits them.
const isCut = ({ near }) => typeof near === 'number';

// Returns a decimal text without trailing zeros.
export function decimal(x, digits) {
  const text = x.toFixed(digits);
  return text.includes('.') ? text.replace(/\.?0+$/, '').replace(/^-0$/, '0') : text;
}

export function cameraText(camera) {
  const distance = length(sub(camera.eye, camera.target));
  const digits = Math.min(12, Math.max(0, 5 - Math.floor(Math.log10(distance))));
  const triple = (v, d = digits) => v.map((x) => decimal(x, d)).join('/');
  return `eye=${triple(camera.eye)},target=${triple(camera.target)},up=${triple(camera.up, 5)},` +
    (camera.ortho > 0 ? `ortho=${decimal(camera.ortho, digits)}` : `fovy=${decimal(camera.fovy_deg, 4)}`) +
    (isCut(camera) ? `,near=${decimal(camera.near, digits)},far=${decimal(camera.far, digits)}` : '');
}

// Rotates a vector about a unit axis (Rodrigues' formula).
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

// Rotates the camera around a point by `right` and `up`, in radians. The camera stops just before it is straight above or below the point.
export function orbit(camera, right, up, pole, centre) {
  const axis = unit(pole), out = unit(sub(camera.eye, camera.target));
  const elevation = Math.asin(Math.max(-1, Math.min(1, dot(out, axis))));
  const level = sub(out, scale(axis, dot(out, axis)));
  // From straight above or below, the picture's up vector determines the side.
  const forward = length(level) > 1e-6 ? unit(level) : unit(scale(camera.up, elevation > 0 ? -1 : 1));
  const side = unit(cross(axis, forward)), climb = Math.max(-1.55, Math.min(1.55, elevation + up)) - elevation;
  const around = (point) => add(centre, turned(turned(sub(point, centre), side, -climb), axis, right));
  return { ...camera, eye: around(camera.eye), target: around(camera.target), up: axis };
}

// Moves the eye to a distance at which a ball fits the picture. The ball then fits from all directions.
export function around(camera, sphere, aspect) {
  const out = unit(sub(camera.eye, camera.target)), half = (camera.fovy_deg * Math.PI) / 360;
  const tight = Math.min(half, Math.atan(Math.tan(half) * aspect));
  const distance = sphere.radius / Math.sin(tight);
  const ortho = camera.ortho > 0 ? sphere.radius / Math.min(1, aspect) : 0;
  return { ...camera, eye: add(sphere.centre, out, distance), target: sphere.centre, ortho };
}

// Moves the view to the right and up, in fractions of the picture's height.
export function pan(camera, right, up) {
  const out = sub(camera.eye, camera.target), back = unit(out);
  const side = unit(cross(camera.up, back)), above = cross(back, side);
  const height = camera.ortho > 0 ? 2 * camera.ortho : 2 * length(out) * Math.tan((camera.fovy_deg * Math.PI) / 360);
  const move = add(scale(side, -right * height), above, -up * height);
  return { ...camera, eye: add(camera.eye, move), target: add(camera.target, move) };
}

export function zoom(camera, factor) {
  if (camera.ortho > 0) return { ...camera, ortho: camera.ortho / factor };
  const out = sub(camera.eye, camera.target), nearer = length(out) * (1 - 1 / factor);
  const planes = isCut(camera) ? { near: Math.max(camera.near - nearer, 1e-3 * length(out)), far: camera.far - nearer } : {};
  return { ...camera, ...planes, eye: add(camera.target, out, 1 / factor) };
}

// Returns the planes that a value of --camera sets. They are null if the program fits them.
export function planesOf(text) {
  const [near, far] = [/,near=([^,]+)/, /,far=([^,]+)/].map((pattern) => pattern.exec(text)?.[1]);
  return near && far ? { near: Number(near), far: Number(far) } : { near: null, far: null };
}

// Reads a text of cameraText.
export function readCamera(text) {
  const parts = Object.fromEntries(text.split(',').map((part) => part.split('=')));
  const triple = (v) => v.split('/').map(Number);
  return { eye: triple(parts.eye), target: triple(parts.target), up: triple(parts.up),
    ortho: parts.ortho ? Number(parts.ortho) : 0, fovy_deg: parts.fovy ? Number(parts.fovy) : 30, ...planesOf(text) };
}

// Returns the eye's axes in world space: to the right, upwards, and backwards.
export function cameraAxes(camera) {
  const back = unit(sub(camera.eye, camera.target)), side = unit(cross(camera.up, back));
  return { side, above: cross(back, side), back };
}

// Returns half the picture's height at a depth in front of the eye, in model units.
const halfHeight = (camera, depth) => (camera.ortho > 0 ? camera.ortho : depth * Math.tan((camera.fovy_deg * Math.PI) / 360));

// Projects a point to fractions of the picture's width and height, from the upper left corner. `behind`: the point is behind the eye.
export function project(camera, point, aspect) {
  const { side, above, back } = cameraAxes(camera), way = sub(point, camera.eye), depth = -dot(way, back);
  const behind = camera.ortho <= 0 && depth < 1e-3 * length(way), half = halfHeight(camera, behind ? 0.02 * length(way) || 1 : depth);
  return { x: 0.5 + dot(way, side) / (2 * half * aspect), y: 0.5 - dot(way, above) / (2 * half), depth, behind };
}

// Returns the point of a ball's surface that is seen at a position in the picture. The position is in fractions of the picture's width and height. The point is
// on the side towards the eye, or on the far side if `isFar` is set. If the ball is not at that position, the nearest point of its surface is returned.
export function onBall(camera, { centre, radius }, x, y, aspect, isFar) {
  const { side, above, back } = cameraAxes(camera), half = halfHeight(camera, 1);
  const across = add(scale(side, 2 * (x - 0.5) * half * aspect), above, 2 * (0.5 - y) * half), isParallel = camera.ortho > 0;
  const from = isParallel ? add(camera.eye, across) : camera.eye, way = unit(isParallel ? scale(back, -1) : sub(across, back));
  const middle = dot(sub(centre, from), way), closest = sub(add(from, way, middle), centre), gap = radius * radius - dot(closest, closest);
  if (gap <= 0) return add(centre, unit(closest), radius);
  return add(add(centre, closest), way, Math.sqrt(gap) * (isFar ? 1 : -1));
}

// Moves a point in the picture plane, in fractions of the picture's height, and away from the eye by a fraction of its distance.
export function shifted(camera, point, right, up, away = 0) {
  const { side, above, back } = cameraAxes(camera), depth = Math.max(-dot(sub(point, camera.eye), back), 0.02 * length(sub(camera.eye, camera.target)));
  const height = 2 * halfHeight(camera, depth);
  return add(add(add(point, side, right * height), above, up * height), back, -away * height);
}
