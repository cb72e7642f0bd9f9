// contents_tab.js: the tab of the model. It shows the model's measures, objects, materials, animations and variants. The user can hide objects and colour
// materials.
import { call, on, state, view } from '../shared/app.js';
import { $, element, ours } from '../base/dom.js';
import { Picker, hexOf } from '../controls/picker.js';
import { setOption } from '../controls/row.js';
import { State } from '../words/state.js';
import { text } from '../base/strings.js';
import { timeline } from './timeline.js';

const READS = ['scene', 'variant', 'up', 'normals', 'lenient', 'segments', 'parametric', 'implicit', 'u', 'v', 'x', 'y', 'z', 'flip'];
const UNITS = [[1, 'm'], [0.01, 'cm'], [0.001, 'mm'], [1e-6, 'µm'], [0.0254, 'in'], [0.3048, 'ft']];
const place = $('panel-contents');
let read = null, isReading = false;

// Returns the words that determine how the model is read.
const readWords = () => [state.model, ...state.words.slice(1).filter((word) => READS.includes(word.slice(2).split('=')[0]))].join('\n');

const digits = (x) => Number(x.toPrecision(4)).toLocaleString('en');
const count = (x) => x.toLocaleString('en');

function measures({ size, unit_m, triangles, vertices, object_count, material_count }) {
  const unit = UNITS.find(([metres]) => Math.abs(unit_m / metres - 1) < 1e-3);
  const sides = size.map(digits).join(' × ');
  const rows = [['contentsSize', unit ? `${sides} ${unit[1]}` : text('contentsNoUnit', { size: sides })]];
  if (unit && unit[1] !== 'mm') rows.push(['', `${size.map((x) => digits(x * unit_m * 1000)).join(' × ')} mm`]);
  rows.push(['contentsTriangles', count(triangles)], ['contentsVertices', count(vertices)], ['contentsObjects', count(object_count)], ['contentsMaterials', count(material_count)]);
  return element('dl', { className: 'measures' }, ...rows.flatMap(([key, value]) => [element('dt', { textContent: key && text(key) }), element('dd', { textContent: value, translate: false })]));
}

const hidden = (name) => state.values('hide').includes(name);

// Makes a row with a box that shows or hides all objects, parts or materials with this name.
function row(name, shown, about, ...more) {
  const box = element('input', { type: 'checkbox', checked: !name || !hidden(name), disabled: !name, attributes: { 'aria-label': text('contentsShown', { name: shown }) } });
  box.onchange = () => setOption('hide', box.checked ? state.values('hide').filter((one) => one !== name) : [...state.values('hide'), name]);
  if (name) box.dataset.name = name;
  return element('li', {}, box, element('span', { className: 'named' }, ours('span', shown), ' ', element('small', { textContent: about, translate: false })), ...more);
}

function objects({ objects, object_count, materials }) {
  const nameOf = (index) => materials[index]?.name ?? '';
  // Objects with the same name are hidden together.
  const groups = objects.reduce((map, one) => map.set(one.name, [...(map.get(one.name) ?? []), one]), new Map());
  const rows = [...groups].map(([name, list]) => {
    const parts = list.length === 1 && list[0].parts.filter((part) => part.name && part.name !== name).length > 1 ? list[0].parts : [], triangles = list.reduce((sum, one) => sum + one.triangles, 0);
    const made = row(name, `${name ?? text('contentsUnnamed')}${list.length > 1 ? ` ×${list.length}` : ''}`, text('contentsCount', { count: count(triangles) }));
    if (parts.length) made.append(element('ul', {}, ...parts.map((part) => row(part.name, part.name ?? text('contentsUnnamed'), `${text('contentsCount', { count: count(part.triangles) })} ${nameOf(part.material)}`))));
    return made;
  });
  if (objects.length < object_count) rows.push(element('li', { textContent: text('contentsMore', { count: count(object_count - objects.length) }) }));
  return element('ul', { className: 'contents' }, ...rows);
}

// Returns the colour that the user has given a material. If there is none, returns the model's colour.
function colorOf(material) {
  const own = state.values('material').findLast((one) => one.startsWith('color=') && one.endsWith(`@${material.name}`));
  return own ? own.slice('color='.length, -material.name.length - 1) : hexOf(material.color);
}

function materialRow(material) {
  const numbers = material.physical ? text('contentsPhysical', { metallic: digits(material.metallic), roughness: digits(material.roughness) }) : text('contentsClassic', { shininess: digits(material.shininess) });
  const about = [numbers, ...(material.opacity < 1 ? [text('contentsOpacity', { opacity: digits(material.opacity) })] : []), ...(material.maps.length ? [text('contentsMaps', { maps: material.maps.join(', ') })] : [])].join(' · ');
  const picker = new Picker(text('contentsColor', { name: material.name ?? text('contentsUnnamed') }), (value, key) => {
    const others = state.values('material').filter((one) => !(one.startsWith('color=') && one.endsWith(`@${material.name}`)));
    state.set(new State(state.words).withValues('material', [...others, `color=${value}@${material.name}`]), key);
  });
  picker.input.disabled = !material.name;
  picker.show(colorOf(material));
  return row(material.name, material.name ?? text('contentsUnnamed'), about, picker.input);
}

function materials({ materials, material_count }) {
  const rows = materials.map(materialRow);
  if (materials.length < material_count) rows.push(element('li', { textContent: text('contentsMore', { count: count(material_count - materials.length) }) }));
  return element('ul', { className: 'contents' }, ...rows);
}

function variants(list) {
  const choice = element('select', { translate: false, attributes: { 'aria-label': text('contentsVariant') } }, new Option('—', ''), ...list.map((name, i) => new Option(name ?? i, name ?? i)));
  choice.value = state.values('variant').at(-1) ?? '';
  choice.onchange = () => setOption('variant', choice.value === '' ? [] : [choice.value]);
  return element('label', { className: 'choice' }, element('span', { textContent: text('contentsVariant') }), ' ', choice);
}

const section = (key, ...children) => element('details', { open: true }, element('summary', { textContent: text(key) }), ...children);

function show(contents) {
  const parts = [section('contentsMeasures', measures(contents))];
  if (contents.animations.some(({ seconds }) => seconds > 0)) parts.push(section('contentsAnimations', timeline(contents.animations)));
  if (contents.variants.length) parts.push(section('contentsVariant', variants(contents.variants)));
  parts.push(section('contentsObjects', objects(contents)));
  if (contents.materials.length) parts.push(section('contentsMaterials', materials(contents)));
  place.replaceChildren(...parts);
}

async function refresh() {
  const key = readWords();
  if (place.hidden || isReading || !view.picture) return;
  if (read === key) return showBoxes();
  isReading = true;
  try {
    show(await call('contents', { words: state.words })); // the model of these words is already loaded
  } catch (error) {
    place.replaceChildren(ours('p', error.message));
  }
  read = key;
  isReading = false;
}

function showBoxes() {
  for (const box of place.querySelectorAll('input[data-name]')) box.checked = !hidden(box.dataset.name);
}

place.append(element('p', { className: 'hint', textContent: text('contentsWait') }));
on('still', refresh);
on('words', showBoxes);
new ResizeObserver(refresh).observe(place); // runs when the tab becomes visible again
