// picture_tab.js: the tab of the picture. It shows views, materials, lights, surroundings and style with plain names. Each row of the table below is an option
// of the program and its plain name. The option's own name is shown beside it if the user wants it.
import { on, state, view } from '../shared/app.js';
import { $, element } from '../base/dom.js';
import { lightControls, withTurned } from '../lights/light_controls.js';
import { Row, setOption } from '../controls/row.js';
import { START, State, isMetal, isScene, without } from '../words/state.js';
import { text } from '../base/strings.js';
import { swatches } from '../controls/swatches.js';
import { viewControls } from './view_controls.js';

// [title of the section, function that makes the content above the rows, rows: [option, plain name, slider]]. A slider is minimum, maximum, step and start
// (default: the option's default).
const SECTIONS = [
  ['sectionView', viewControls, [['projection', 'plainProjection'], ['up', 'plainUp']]],
  ['sectionMaterial', materials, [['color', 'plainColor'], ['opacity', 'plainOpacity', [0, 1, 0.01, 1]]]],
  ['sectionLight', lightControls, [['light-scale', 'plainLightScale', [0, 4, 0.05]], ['shadows', 'plainShadows'], ['ao', 'plainAo']]],
  ['sectionEnvironment', environments, [['environment-rotation', 'plainRotation', [0, 360, 5]]]],
  ['sectionBackground', backgrounds, [['background', 'plainBackground'], ['ground', 'plainGround']]],
  ['sectionLook', looks, [['exposure', 'plainExposure', [-4, 4, 0.1]], ['wireframe', 'plainWireframe'], ['edges', 'plainEdges'], ['dimensions', 'plainDimensions'], ['axes', 'plainAxes'], ['grid', 'plainGrid']]],
  ['sectionShading', null, [['reflection', 'plainReflection'], ['shading', 'plainShading'], ['show', 'plainShow'], ['shininess', 'plainShininess'], ['normals', 'plainNormals'], ['size', 'plainSize']]],
];

const SPHERE = ['sphere', '--size=88x88', '--samples=8'], OWN = '--material=color=#b8b8b8'; // OWN: shown for the model's own material

// The material of the whole model. Materials of single objects (@NAME) are kept. A metal replaces the model's textures and reflects the studio, which
// another material removes.
function materials() {
  const whole = () => state.values('material').filter((value) => !value.includes('@'));
  const own = START.find((word) => word.startsWith('--material=')).slice('--material='.length);
  const take = (value) => {
    const others = state.values('material').filter((one) => one.includes('@')), around = state.values('environment').join();
    let words = new State(without(state.words, 'color')).withValues('material', value === null ? others : [value, ...others]);
    if (isMetal(value) && !around) words = withTurned(new State(words).withValues('environment', ['studio']));
    else if (!isMetal(value) && isMetal(whole().at(-1)) && around === 'studio') words = without(words, 'environment', 'environment-rotation');
    state.set(words);
  };
  const choices = view.materials.map(({ name, metal }) => ({ value: metal ? `${name},${metal}` : name, name, words: [...SPHERE, `--material=${name}`] }));
  const first = [{ value: null, label: text('materialOwn'), words: [...SPHERE, OWN] }, { value: own, label: text('materialFirst'), words: [...SPHERE, `--material=${own}`] }];
  return swatches({ title: text('sectionMaterial'), choices: [...first, ...choices], chosen: () => whole().at(-1) ?? null, take });
}

function environments() {
  const ball = [...SPHERE, '--material=color=white,metallic=1,roughness=0.05'];
  const choices = [{ value: null, label: text('environmentOwn'), words: [...SPHERE, OWN] }, { value: 'none', label: text('environmentNone'), words: [...SPHERE, '--material=color=white,specular=0.6,shininess=60'] },
    ...view.environments.map((name) => ({ value: name, name, words: [...ball, `--environment=${name}`] }))];
  return swatches({ title: text('sectionEnvironment'), choices, chosen: () => state.values('environment').at(-1) ?? null, take: (value) => setOption('environment', value === null ? [] : [value]), named: true });
}

function looks() {
  const { words, default: standard } = view.options.find(({ name }) => name === 'look');
  const choices = words.map(({ name }) => ({ value: name, name, words: ['teapot', '--size=128x96', '--samples=8', `--look=${name}`] }));
  return swatches({ title: text('plainLook'), choices, chosen: () => state.values('look').at(-1) ?? standard, take: (value) => setOption('look', value === standard ? [] : [value]), named: true });
}

function backgrounds() {
  const choices = [['transparent', 'backgroundNone', 'transparent'], ['white', 'backgroundWhite', '#fff'], ['#808080', 'backgroundGrey', '#808080'], ['black', 'backgroundBlack', '#000']]
    .map(([value, key, color]) => ({ value, label: text(key), color }));
  const own = () => (isScene(state.model) ? null : 'transparent'); // a scene file may set a background
  return swatches({ title: text('sectionBackground'), choices, chosen: () => state.values('background').at(-1) ?? own(), take: (value) => setOption('background', value === own() ? [] : [value]) });
}

function optionNames() {
  const KEY = 'lambent-option-names', box = element('input', { type: 'checkbox', id: 'option-names' });
  const show = () => (document.body.dataset.names = box.checked ? 'shown' : '');
  try {
    box.checked = localStorage.getItem(KEY) === '1';
  } catch {
    // the page may have no access to storage
  }
  box.onchange = () => {
    show();
    try {
      localStorage.setItem(KEY, box.checked ? '1' : '0');
    } catch {
      // without storage, the choice lasts until the page is closed
    }
  };
  show();
  return element('label', { className: 'names' }, box, ' ', element('span', { textContent: text('optionNames') }));
}

const place = $('panel-quick'), rows = [];
for (const [title, make, list] of SECTIONS) {
  const made = list.map(([name, plain, range]) => new Row(view.options.find((option) => option.name === name), 'quick', { plain: text(plain), range }));
  rows.push(...made);
  place.append(element('details', { open: true }, element('summary', { textContent: text(title) }), ...(make ? [make()] : []), ...made.map((row) => row.place)));
}
place.append(optionNames());

function show() {
  if (!view.moving) for (const row of rows) row.show(state.values(row.option.name));
}
for (const name of ['words', 'settings']) on(name, show);
show();
