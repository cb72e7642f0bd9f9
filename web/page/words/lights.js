// lights.js: reads the lights of --light as text, and changes the text when a handle moves. Positions are converted to the light's frame and unit (model units,
// or radii from the middle) and written as decimal text. The picture depends only on this text.
import { add, cameraAxes, cross, decimal, dot, length, scale, sub, unit } from './camera.js';
import { text } from '../base/strings.js';

// Parses a text such as "+spot:position=1/2/3,cutoff=20". Returns the light's type, whether the light is added to the other lights, and the light's keys in
// order.
export function parseLight(text) {
  const [, plus, type, rest] = /^(\+?)([^:]*):?([^]*)$/.exec(text);
  const keys = new Map(rest.split(',').filter(Boolean).map((pair) => [pair.split('=')[0], pair.slice(pair.indexOf('=') + 1)]));
  return { plus, type, keys };
}

export function lightText({ plus, type, keys }) {
  const pairs = [...keys].map(([key, value]) => `${key}=${value}`).join(',');
  return plus + type + (pairs && `:${pairs}`);
}

// Returns the axes and the origin of a light's frame in world space. Returns null for the frame of an object, because the page does not know it.
function frameOf(light, camera, sphere) {
  const frame = light.keys.get('frame') ?? 'world';
  const { side, above, back } = cameraAxes(camera);
  if (frame === 'world') return { axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], origin: [0, 0, 0] };
  if (frame === 'camera') return { axes: [side, above, back], origin: camera.eye };
  if (frame === 'view') return { axes: [side, above, back], origin: sphere.centre };
  return null;
}

const turnedBy = (axes, v) => add(add(scale(axes[0], v[0]), axes[1], v[1]), axes[2], v[2]);
const intoAxes = (axes, v) => axes.map((axis) => dot(axis, v));

// Returns the three numbers of a key, and whether their unit is the radius.
function triple(value) {
  const parts = value.split('/'), w = parts.length === 4 ? Number(parts[3]) : 1;
  return { v: parts.slice(0, 3).map((part) => Number(part.replace(/r$/, '')) / (w || 1)), radii: /\dr/.test(value), w };
}

function pointOf(value, frame, sphere) {
  const { v, radii } = triple(value);
  return radii ? add(sphere.centre, turnedBy(frame.axes, v), sphere.radius) : add(frame.origin, turnedBy(frame.axes, v));
}

function pointText(point, frame, sphere, radii) {
  const v = radii ? scale(intoAxes(frame.axes, sub(point, sphere.centre)), 1 / sphere.radius) : intoAxes(frame.axes, sub(point, frame.origin));
  const digits = radii ? 4 : Math.min(12, Math.max(0, 4 - Math.floor(Math.log10(sphere.radius))));
  return v.map((x) => decimal(x, digits) + (radii ? 'r' : '')).join('/');
}

const directionText = (v, frame) => intoAxes(frame.axes, unit(v)).map((x) => decimal(x, 4)).join('/');

// Returns the light in world space: its `position` (a directional light has a point on a sphere around the model), the `direction` of its light, and for a spot
// light `aim` and `cone`. `cone` is the half angle in degrees, or null if the cone has no edge. Returns null if the light has no position, or if the page does
// not know the position.
export function placeOf(light, camera, sphere) {
  const frame = frameOf(light, camera, sphere), { type, keys } = light;
  if (!frame || !['point', 'spot', 'directional'].includes(type)) return null;
  const given = keys.get('position');
  if (type === 'directional' || (given && triple(given).w === 0)) {
    let direction = turnedBy(frame.axes, [0, 0, -1]);
    if (given && keys.has('target')) direction = sub(pointOf(keys.get('target'), frame, sphere), pointOf(given, frame, sphere));
    else if (given) direction = scale(turnedBy(frame.axes, triple(given).v), -1);
    else if (keys.has('direction')) direction = turnedBy(frame.axes, triple(keys.get('direction')).v);
    direction = unit(direction);
    return { directional: true, direction, position: add(sphere.centre, direction, -1.2 * sphere.radius) };
  }
  const atEye = !given && keys.get('frame') === 'camera';
  const position = atEye ? camera.eye : pointOf(given ?? '1r/2r/3r', frame, sphere);
  if (type === 'point') return { position };
  let aim = sphere.centre;
  if (keys.has('target')) aim = pointOf(keys.get('target'), frame, sphere);
  else if (keys.has('direction')) {
    const far = Math.max(0.5 * sphere.radius, length(sub(sphere.centre, position)));
    aim = add(position, unit(turnedBy(frame.axes, triple(keys.get('direction')).v)), far);
  }
  const cutoff = keys.has('cutoff') ? Number(keys.get('cutoff')) : keys.has('exponent') ? 180 : 45;
  const cone = keys.has('outer') ? Number(keys.get('outer')) : cutoff <= 90 ? cutoff : null;
  return { position, aim, direction: unit(sub(aim, position)), cone };
}

function withKeys(light, changes) {
  const keys = new Map(light.keys);
  for (const [key, value] of Object.entries(changes)) value === null ? keys.delete(key) : keys.set(key, value);
  return { ...light, keys };
}

// Moves a handle of the light to another point in world space. `part` is position, aim or cone.
export function movedTo(light, part, point, camera, sphere) {
  const frame = frameOf(light, camera, sphere), place = placeOf(light, camera, sphere), { keys } = light;
  if (part === 'position' && place.directional)
    return { ...withKeys(light, { position: null, target: null, direction: directionText(sub(sphere.centre, point), frame) }), type: 'directional' };
  if (part === 'position') return withKeys(light, { position: pointText(point, frame, sphere, !keys.has('position') || triple(keys.get('position')).radii) });
  if (part === 'aim' && keys.has('direction')) return withKeys(light, { direction: directionText(sub(point, place.position), frame) });
  if (part === 'aim') return withKeys(light, { target: pointText(point, frame, sphere, !keys.has('target') || triple(keys.get('target')).radii) });
  const way = sub(point, place.position), along = dot(way, place.direction);
  const across = length(sub(way, scale(place.direction, along)));
  return withCone(light, (Math.atan2(across, along) * 180) / Math.PI);
}

// Sets the cone's half angle in degrees. The inner angle of a soft cone is scaled with it.
export function withCone(light, degrees) {
  const angle = Math.max(1, Math.min(90, degrees)), outer = light.keys.get('outer');
  if (!outer) return withKeys(light, { cutoff: decimal(angle, 2) });
  const inner = (Number(light.keys.get('inner') ?? 0) / Number(outer)) * angle;
  return withKeys(light, { inner: decimal(inner, 2), outer: decimal(angle, 2) });
}

// Returns a point on the cone's edge, beside the aim.
export function coneEdge(place, camera) {
  const far = length(sub(place.aim, place.position)), { above, side } = cameraAxes(camera);
  let across = cross(place.direction, cross(side, place.direction));
  if (length(across) < 1e-3) across = above;
  const angle = Math.min(place.cone, 80) * (Math.PI / 180);
  return add(place.position, add(scale(place.direction, Math.cos(angle)), unit(across), Math.sin(angle)), far);
}

// Returns a new light in addition to the existing lights.
export function newLight(type, texts, number) {
  const others = texts.every((text) => text.startsWith('+')) ? '+' : '';
  const sign = number % 2 ? 1 : -1;
  const keys = { point: `position=${sign}r/1r/1.2r`, spot: `position=${0.6 * sign}r/1.4r/1.2r,cutoff=25`, directional: `direction=${-sign}/-1/-0.5` };
  return `${others}${type}:${keys[type]}`;
}

// Plain names of the lights of the built-in rigs.
const PLAIN = { key: 'lightMain', fill: 'lightFill', rim: 'lightRim', back: 'lightRim' };
export const plainName = (name) => (PLAIN[name] ? text(PLAIN[name]) : name);

export const nameOf = (light, i) => plainName(light.keys.get('name') ?? `${light.type} ${i + 1}`);

const STANDARD = ['ambient=0/0/0', 'diffuse=1/1/1', 'specular=1/1/1', 'attenuation=1/0/0'];

// Converts a light of a scene file to a value of --light, without the keys that have their defaults.
export function lightWords({ type, name, ...fields }) {
  const pairs = Object.entries(fields).map(([key, value]) => [key, Array.isArray(value) ? value.join('/') : value === true ? 'yes' : value === false ? 'no' : String(value)]);
  const keys = new Map(pairs.filter((pair) => type === 'ambient' || !STANDARD.includes(pair.join('='))));
  // A name on the command line cannot contain these characters.
  if (name) keys.set('name', name.replace(/[,=\s]+/g, '-'));
  return lightText({ plus: '', type, keys });
}
