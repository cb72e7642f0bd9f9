// light_controls.js: buttons and sliders that move one light around the model and above it, relative to the view.
import { gestureKey, on, refuse, state, view } from '../shared/app.js';
import { add, cameraAxes, cross, dot, length, scale, sub, unit } from '../words/camera.js';
import { button, element } from '../base/dom.js';
import { lightText, movedTo, nameOf, newLight, parseLight, placeOf } from '../words/lights.js';
import { Picker } from '../controls/picker.js';
import { showNumber, slider } from '../controls/slider.js';
import { State, isMetal } from '../words/state.js';
import { text } from '../base/strings.js';
import { lightsNow, readLights, withLights, wordsOfLights } from './written_lights.js';

// The angles of each button in degrees: around the model, from the viewer to the right, and above the horizon.
const PLACES = [['lightFront', 0, 25], ['lightLeft', -75, 25], ['lightRight', 75, 25], ['lightAbove', 0, 85], ['lightBehind', 180, 35]];
const DEGREES = 180 / Math.PI, MOVABLE = ['point', 'spot', 'directional'];
let chosen = 0; // the moved light's index among the lights of --light

const isMovable = (one) => MOVABLE.includes(parseLight(one).type) && Boolean(placeOf(parseLight(one), view.camera, view.sphere));

// Returns the horizontal axes of the view, towards the eye and to the right, and the model's up axis.
function axes() {
  const { side, above, back } = cameraAxes(view.camera), pole = unit(view.picture.camera.pole);
  let front = sub(back, scale(pole, dot(back, pole)));
  if (length(front) < 1e-6) front = scale(above, dot(back, pole) > 0 ? -1 : 1);
  front = unit(front);
  return { front, right: length(cross(pole, front)) ? unit(cross(pole, front)) : side, pole };
}

function anglesOf(light) {
  const { front, right, pole } = axes(), way = unit(sub(placeOf(light, view.camera, view.sphere).position, view.sphere.centre));
  return { around: Math.atan2(dot(way, right), dot(way, front)) * DEGREES, height: Math.asin(Math.max(-1, Math.min(1, dot(way, pole)))) * DEGREES };
}

// Returns whether a light is in the direction of a button, within 2 degrees.
function isNear({ around, height }, [, at, above]) {
  const [h, g] = [height / DEGREES, above / DEGREES];
  return Math.sin(h) * Math.sin(g) + Math.cos(h) * Math.cos(g) * Math.cos((around - at) / DEGREES) > Math.cos(2 / DEGREES);
}

function placed(light, around, height) {
  const { front, right, pole } = axes(), far = Math.max(1.2 * view.sphere.radius, length(sub(placeOf(light, view.camera, view.sphere).position, view.sphere.centre)));
  const level = add(scale(front, Math.cos(around / DEGREES)), right, Math.sin(around / DEGREES));
  const way = add(scale(level, Math.cos(height / DEGREES)), pole, Math.sin(height / DEGREES));
  return movedTo(light, 'position', add(view.sphere.centre, way, far), view.camera, view.sphere);
}

function chosenIn(texts) {
  if (texts[chosen] && isMovable(texts[chosen])) return chosen;
  return texts.findIndex(isMovable);
}

// The angle of a built-in environment's brightest side in front of the model, in degrees around the up axis, from +X to -Z.
const BRIGHT = { studio: -90, sky: -47, soft: -131, outdoor: -47, night: -115, cyclorama: -141 };

// Metals reflect mainly their surroundings. Therefore a built-in environment turns with the light.
export function withTurned(words) {
  const made = new State(words), texts = made.values('light'), i = view.camera ? chosenIn(texts) : -1, bright = BRIGHT[made.values('environment').at(-1)];
  if (i < 0 || bright === undefined || !made.values('material').some(isMetal)) return words;
  const { pole } = axes(), east = Math.abs(pole[0]) > 0.5 ? [0, 1, 0] : [1, 0, 0], way = sub(placeOf(parseLight(texts[i]), view.camera, view.sphere).position, view.sphere.centre);
  const angle = Math.round(Math.atan2(dot(way, cross(pole, east)), dot(way, east)) * DEGREES - bright);
  return made.withValues('environment-rotation', [String((angle + 720) % 360)]);
}

// Returns words with a movable light. The lights that the program has chosen are written as options. If none of them can be moved, a new light is added. If
// only an environment lit the model, metals keep reflecting it. Other materials get some ambient light, because their unlit side would be black.
async function words() {
  const read = await readLights(state.words), made = new State(read ? withLights(state.words, read) : state.words), texts = made.values('light'), rest = texts.filter((one) => one !== 'none');
  if (texts.some(isMovable)) return made.words;
  const lit = made.withValues('light', [...rest, newLight('directional', texts, rest.length)]), [name, value] = state.values('material').some(isMetal) ? ['environment', 'studio'] : ['ambient', '0.25'];
  return made.values(name).length ? lit : new State(lit).withValues(name, [value]);
}

function changed(from, change, key) {
  const made = new State(from), texts = made.values('light'), i = chosenIn(texts);
  texts[i] = lightText(change(parseLight(texts[i])));
  state.set(withTurned(made.withValues('light', texts)), key);
}

// While the lights are being written as options, only the newest change is kept.
let waiting = null, isBusy = false;
async function change(how, key = null) {
  if (!view.camera) return;
  if (lightsNow().some(isMovable)) return changed(wordsOfLights(), how, key);
  waiting = how;
  if (isBusy) return;
  isBusy = true;
  try {
    changed(await words(), waiting, null);
  } catch (error) {
    refuse(error.message);
  }
  isBusy = false;
}

const withKey = (key, value) => (light) => ({ ...light, keys: new Map(light.keys).set(key, value) });
const titled = (key) => element('span', { textContent: text(key) });

export function lightControls() {
  const choice = element('select', { attributes: { 'aria-label': text('lightChoice') } });
  const around = slider(titled('lightAround'), text('lightAround'), [-180, 180, 1], 0, (value) => change((light) => placed(light, Number(value), anglesOf(light).height), gestureKey()));
  const height = slider(titled('lightHeight'), text('lightHeight'), [-90, 90, 1], 0, (value) => change((light) => placed(light, anglesOf(light).around, Number(value)), gestureKey()));
  const bright = slider(titled('lightBright'), text('lightBright'), [0, 4, 0.05], 1, (value) => change(withKey('intensity', value), gestureKey()));
  const color = new Picker(text('lightColor'), (value, key) => change(withKey('color', value), key));
  const places = PLACES.map(([key, at, above]) => button(key, () => change((light) => placed(light, at, above))));
  choice.onchange = () => {
    chosen = Number(choice.value);
    show();
  };
  function show() {
    const texts = view.camera && view.sphere ? lightsNow() : [], i = texts.length ? chosenIn(texts) : -1, movable = texts.flatMap((one, at) => (isMovable(one) ? [at] : []));
    choice.disabled = movable.length < 2; // not hidden, so that the buttons below it stay in place
    const key = movable.map((at) => nameOf(parseLight(texts[at]), at)).join('\n');
    if (choice.dataset.names !== key) choice.replaceChildren(...(movable.length ? movable.map((at) => new Option(nameOf(parseLight(texts[at]), at), at)) : [new Option(text('lightMain'))]));
    choice.dataset.names = key;
    choice.translate = false;
    if (i < 0) return places.forEach((one) => one.setAttribute('aria-pressed', 'false'));
    choice.value = i;
    if (view.moving) return;
    const light = parseLight(texts[i]), angles = anglesOf(light);
    places.forEach((one, at) => one.setAttribute('aria-pressed', String(isNear(angles, PLACES[at]))));
    showNumber(around, Math.round(angles.around) === -180 ? 180 : Math.round(angles.around));
    showNumber(height, Math.round(angles.height));
    showNumber(bright, light.keys.get('intensity') ?? 1);
    color.show(light.keys.get('color') ?? 'white');
  }
  for (const name of ['words', 'picture', 'lights']) on(name, show);
  show();
  return element('div', {}, choice, element('div', { className: 'buttons', attributes: { role: 'group', 'aria-label': text('lightPlaces') } }, ...places), around, height, bright,
    element('div', { className: 'slider' }, titled('lightColor'), color.input));
}
