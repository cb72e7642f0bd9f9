// light_tab.js: the tab of the lights of --light. It shows the words, sliders and curves of each light. It adds and removes lights, and writes the lights that
// the program has chosen as options.
import { gestureKey, on, refuse, say, state, view } from '../shared/app.js';
import { curvesOf } from '../explain/curves.js';
import '../explain/explaining.js';
import { $, button, element, ours } from '../base/dom.js';
import { lightText, nameOf, parseLight } from '../words/lights.js';
import { slider } from '../controls/slider.js';
import { text } from '../base/strings.js';
import { addLight, lightsNow, readLights, removeLight, setLights, withLights } from './written_lights.js';

const place = $('panel-lights'), list = element('ul', { className: 'lights' });
const adders = ['point', 'spot', 'directional'].map((type) =>
  button({ point: 'addPoint', spot: 'addSpot', directional: 'addDirectional' }[type], () => addLight(type)));
const mine = button('mineLights', makeMine), highlight = element('div');
place.append(element('p', { className: 'hint', textContent: text('lightsHint') }), element('div', { className: 'buttons' }, ...adders, mine), list, highlight);

// The sliders of a light: key, index within its value, minimum, maximum, step, default.
const SLIDERS = {
  color: [],
  point: [['intensity', 0, 0, 4, 0.05, 1], ['attenuation', 0, 0, 2, 0.05, 1], ['attenuation', 1, 0, 1, 0.01, 0], ['attenuation', 2, 0, 1, 0.01, 0]],
  directional: [['intensity', 0, 0, 4, 0.05, 1]],
};
SLIDERS.spot = [...SLIDERS.point, ['cutoff', 0, 1, 90, 1, 45], ['exponent', 0, 0, 64, 1, 0]];
const SOFT = [['inner', 0, 0, 89, 1, 0], ['outer', 0, 1, 90, 1, 45]];

function slidersOf(i, light) {
  const soft = light.keys.has('outer') ? SOFT : null;
  const rows = (SLIDERS[light.type] ?? []).filter(([key]) => !soft || (key !== 'cutoff' && key !== 'exponent')).concat((light.type === 'spot' && soft) || []);
  return rows.map(([key, part, least, most, step, standard]) => {
    const parts = (light.keys.get(key) ?? (key === 'attenuation' ? '1/0/0' : String(standard))).split('/'), unit = parts[part].endsWith('r') ? 'r' : '';
    const name = key === 'attenuation' ? `${key} ${'abc'[part]}` : key;
    return slider(ours('span', name), text('sliderOf', { name, light: nameOf(light, i) }), [least, most, step], parseFloat(parts[part]), (value) => {
      const texts = [...lightsNow()], now = parseLight(texts[i]), values = [...parts];
      values[part] = value + unit;
      if (key === 'attenuation' && values.every((one) => parseFloat(one) === 0)) values[0] = '0.01';
      parts[part] = values[part];
      now.keys.set(key, values.join('/'));
      texts[i] = lightText(now);
      setLights(texts, gestureKey());
    });
  });
}

// Returns the explanation of a light of the command line. These lights are the last ones of the scene.
function explainedLight(pixel, i, texts) {
  const reaching = texts.map(parseLight).map(({ type }, at) => ({ type, at })).filter(({ type }) => ['point', 'spot', 'directional'].includes(type));
  const own = pixel?.triangles[0]?.points[0].lights.filter((light) => light.light !== null).slice(-reaching.length);
  return own?.[reaching.findIndex(({ at }) => at === i)] ?? null;
}

// Returns the words with one light only. The light is then the first light of the picture.
const wordsOf = (one) => state.withValues('light', [one.replace(/^\+/, '')]);

function showLight(one, i) {
  const light = parseLight(one), isNone = light.type === 'none', remover = button(isNone ? 'restoreLights' : 'removeLight', () => removeLight(i));
  if (!isNone) remover.setAttribute('aria-label', text('removeNamed', { light: nameOf(light, i) }));
  const curves = element('div', { className: 'curves-of' });
  curves.refresh = () => {
    const now = lightsNow()[i];
    if (light.type !== 'point' && light.type !== 'spot') return;
    curvesOf({ words: wordsOf(now), light: 0, explained: explainedLight(view.explained, i, lightsNow()), type: light.type }).then((made) => curves.replaceChildren(made), () => {});
  };
  curves.refresh();
  return element('li', {}, element('div', { className: 'light-head' }, ours('code', one), remover), ...slidersOf(i, light), curves);
}

// The slider for the shininess of the material, with the highlight's curve at the explained point.
const exponent = slider(ours('span', 'shininess'), text('sliderShininess'), [0, 3, 0.01], 1.5, (log) => {
  state.set(state.withValues('shininess', [String(Number((10 ** log).toPrecision(3)))]), gestureKey());
});
const plotted = element('div');
highlight.append(exponent, plotted);

function showHighlight() {
  const triangle = view.explained?.triangles[0], { lights } = triangle?.points[0] ?? { lights: [] };
  const light = lights.reduce((best, one) => (one.S > (best?.S ?? -1) ? one : best), null), [value] = state.values('shininess');
  const alpha = Number(value ?? triangle?.material.shininess ?? /shininess=([\d.]+)/.exec(state.values('material').at(-1))?.[1] ?? 32);
  if (!view.moving) exponent.querySelector('input').value = Math.log10(Math.max(1, alpha));
  exponent.querySelector('output').textContent = String(Number(alpha.toPrecision(4)));
  if (light) curvesOf({ words: state.words, light: lights.indexOf(light), explained: light, triangle, onlyHighlight: true }).then((made) => plotted.replaceChildren(made), () => {});
  else plotted.replaceChildren(element('p', { className: 'hint', textContent: text('curveHint') }));
}

let listed = null;
function show() {
  const texts = lightsNow();
  showHighlight();
  if (view.moving || listed === texts.join('\n')) return;
  listed = texts.join('\n');
  // If a slider has the focus, the slider that replaces it gets the focus.
  const inputs = [...list.querySelectorAll('input')], at = inputs.indexOf(document.activeElement);
  list.replaceChildren(...texts.map(showLight));
  if (at >= 0) [...list.querySelectorAll('input')][at]?.focus();
}

function refresh() {
  showHighlight();
  for (const curves of list.querySelectorAll('.curves-of')) curves.refresh();
}

async function makeMine() {
  try {
    const made = await readLights(state.words);
    if (!made) return refuse(text('mineDiffers'));
    state.set(withLights(state.words, made));
    say(text('mineDone', { count: made.texts.length }));
  } catch (error) {
    refuse(error.message);
  }
}

show();
on('words', show);
on('lights', show);
on('picture', () => {
  if (!view.explained) refresh();
});
on('explained', refresh);
