// handles.js: shows handles for the lights in the picture. Each light of --light has a handle for its position. A spot light also has handles for its aim and
// its cone. A handle is a button that can be dragged or moved by keys.
import { beginGesture, endGesture, gestureKey, on, say, view } from '../shared/app.js';
import { add, dot, onBall, project, scale, shifted, sub, unit } from '../words/camera.js';
import { $, element, svg } from '../base/dom.js';
import { coneEdge, lightText, movedTo, nameOf, parseLight, placeOf, withCone } from '../words/lights.js';
import { text } from '../base/strings.js';
import { lightsNow, removeLight, setLights } from './written_lights.js';

const canvas = $('canvas'), overlay = $('overlay'), lines = $('overlay-lines');
const PARTS = { position: 'handlePosition', aim: 'handleAim', cone: 'handleCone' };
const handles = new Map(); // maps "NUMBER PART" to its button
let texts = [];

function rewrite(i, light) {
  texts = texts.map((old, at) => (at === i ? lightText(light) : old));
  beginGesture();
  setLights(texts, gestureKey());
  say(texts[i]);
}

// Moves a handle by fractions of the picture's height. A directional light's handle stays on the near or the far side of its sphere.
function moveHandle(i, part, right, up, away = 0) {
  const light = parseLight(texts[i]), place = placeOf(light, view.camera, view.sphere);
  if (!place) return;
  const from = part === 'cone' ? coneEdge(place, view.camera) : place[part];
  let to = shifted(view.camera, from, right, up, away);
  if (place.directional) to = add(view.sphere.centre, unit(sub(to, view.sphere.centre)), 1.2 * view.sphere.radius);
  rewrite(i, movedTo(light, part, to, view.camera, view.sphere));
}

// Moves a position or an aim to a point of the canvas, in CSS pixels. If the position or the aim is behind the eye, it is first moved in front of the eye.
function moveHandleTo(i, part, left, top) {
  const light = parseLight(texts[i]), place = placeOf(light, view.camera, view.sphere), x = left / canvas.clientWidth, y = top / canvas.clientHeight;
  if (!place) return;
  const { camera, sphere } = view, aspect = canvas.width / canvas.height, ball = { centre: sphere.centre, radius: 1.2 * sphere.radius };
  let from = place[part], to;
  if (place.directional) to = onBall(camera, ball, x, y, aspect, dot(sub(from, sphere.centre), sub(camera.eye, sphere.centre)) < 0);
  else {
    if (project(camera, from, aspect).behind) from = scale(add(camera.eye, sphere.centre), 0.5);
    const at = project(camera, from, aspect);
    to = shifted(camera, from, (x - at.x) * aspect, at.y - y);
  }
  rewrite(i, movedTo(light, part, to, camera, sphere));
}

function makeHandle(i, part) {
  const handle = element('button', { type: 'button', className: `handle ${part}` });
  let last = null, grip = null; // grip: the vector from the handle's middle to the pointer, in CSS pixels
  const gripOf = ({ clientX, clientY }) => ({ x: clientX - parseFloat(handle.style.left), y: clientY - parseFloat(handle.style.top) });
  handle.onpointerdown = (event) => {
    handle.setPointerCapture(event.pointerId);
    last = { x: event.clientX, y: event.clientY };
    grip = gripOf(event);
    handle.focus();
    event.preventDefault();
  };
  handle.onpointermove = (event) => {
    if (!last) return;
    const x = (event.clientX - last.x) / canvas.clientHeight, y = (last.y - event.clientY) / canvas.clientHeight;
    if (event.shiftKey) moveHandle(i, part, 0, 0, y);
    else if (part === 'cone') moveHandle(i, part, x, y);
    else moveHandleTo(i, part, event.clientX - grip.x, event.clientY - grip.y);
    if (event.shiftKey) grip = gripOf(event);
    last = { x: event.clientX, y: event.clientY };
  };
  handle.onpointerup = handle.onpointercancel = () => {
    if (last && view.moving) endGesture();
    last = null;
  };
  handle.onkeydown = (event) => {
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [0, 0, 1], PageDown: [0, 0, -1] }[event.key];
    const step = event.shiftKey ? 0.005 : 0.03;
    if (event.key === 'Delete') removeLight(i);
    else if (arrow && part === 'cone') turnCone(i, (arrow[0] || arrow[1] || arrow[2]) * (event.shiftKey ? 0.25 : 2));
    else if (arrow) moveHandle(i, part, ...arrow.map((part) => part * step));
    else return;
    event.preventDefault();
    if (view.moving) endGesture();
  };
  return handle;
}

function turnCone(i, degrees) {
  const light = parseLight(texts[i]), place = placeOf(light, view.camera, view.sphere);
  rewrite(i, withCone(light, (place.cone ?? 90) + degrees));
}

// --- in the picture

// Limits a handle to the stage. A light outside the picture is shown at the border of the stage, in the light's direction from the middle. `turn` is the angle
// of that direction.
function inside(point, width, height) {
  const at = project(view.camera, point, canvas.width / canvas.height), edge = 24;
  const x = (at.x - 0.5) * width, y = (at.y - 0.5) * height, right = width / 2 - edge, below = height / 2 - edge;
  const rim = Math.min(right / Math.abs(x || 1e-9), below / Math.abs(y || 1e-9)), scale = at.behind ? rim : Math.min(1, rim);
  return { x: width / 2 + scale * x, y: height / 2 + scale * y, out: at.behind || scale < 0.999, turn: Math.atan2(y, x), end: at.behind ? null : { x: width / 2 + x, y: height / 2 + y } };
}

function show() {
  if (!view.camera || !view.sphere) return;
  texts = lightsNow();
  const width = canvas.clientWidth, height = canvas.clientHeight, wanted = new Map(), drawn = [];
  lines.setAttribute('viewBox', `0 0 ${width} ${height}`);
  texts.forEach((one, i) => {
    const light = parseLight(one), place = placeOf(light, view.camera, view.sphere);
    if (!place) return;
    const at = inside(place.position, width, height);
    wanted.set(`${i} position`, at);
    if (place.directional) drawn.push([at, inside(add(view.sphere.centre, place.direction, -0.6 * view.sphere.radius), width, height)]);
    if (place.aim) {
      wanted.set(`${i} aim`, inside(place.aim, width, height));
      drawn.push([at, wanted.get(`${i} aim`)]);
    }
    if (place.aim && place.cone !== null) {
      const edge = coneEdge(place, view.camera), other = add(scale(add(place.position, place.direction, dotAlong(edge, place)), 2), edge, -1);
      wanted.set(`${i} cone`, inside(edge, width, height));
      drawn.push([at, wanted.get(`${i} cone`)], [at, inside(other, width, height)]);
    }
  });
  for (const [key, handle] of handles)
    if (!wanted.has(key)) {
      handle.remove();
      handles.delete(key);
    }
  for (const [key, at] of wanted) {
    const [number, part] = key.split(' '), i = Number(number);
    if (!handles.has(key)) {
      handles.set(key, makeHandle(i, part));
      overlay.append(handles.get(key));
    }
    const handle = handles.get(key), label = text(PARTS[part], { light: nameOf(parseLight(texts[i]), i) });
    handle.setAttribute('aria-label', label);
    handle.title = label;
    handle.classList.toggle('out', at.out);
    handle.style.left = `${at.x}px`;
    handle.style.top = `${at.y}px`;
  }
  // A line continues to its end beyond the border, and the overlay clips it.
  const ends = ({ out, end, ...at }) => (end && Math.hypot(end.x, end.y) < 1e5 ? end : at);
  lines.replaceChildren(...drawn.map(([a, b]) => svg('line', { x1: ends(a).x, y1: ends(a).y, x2: ends(b).x, y2: ends(b).y })),
    ...[...wanted.values()].filter(({ out }) => out).map(({ x, y, turn }) =>
      svg('path', { class: 'rim', d: 'M12 -7L22 0L12 7Z', transform: `translate(${x} ${y}) rotate(${(turn * 180) / Math.PI})` })));
}

const dotAlong = (point, { position, direction }) => sub(point, position).reduce((sum, x, i) => sum + x * direction[i], 0);

on('picture', show);
on('words', () => view.picture && show());
on('fit', show);
on('lights', show);
show();
