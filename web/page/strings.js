// strings.js: every text of the page, in one table. What the program says (names and summaries of options, sentences of errors, words of
// command lines) comes from the module and stands in elements with translate="no". ?locale=pseudo writes the table with accents between
// ⟦ and ⟧: a text without them has escaped the table, and one that is cut off would be cut off in a longer language.
const STRINGS = {
  picture: 'Picture',
  model: 'Model',
  openFiles: 'Open files…',
  openFolder: 'Open folder…',
  undo: 'Undo',
  redo: 'Redo',
  savePicture: 'Save PNG',
  canvas: 'The model. Arrow keys turn it.',
  keys: 'Drag: turn. Shift-drag or two fingers: move. Wheel, pinch, + and −: zoom. Arrow keys: turn; with Shift: move. Home: whole model. Click or Enter: explain the point.',
  drop: 'Drop a model, its files, or a folder. Nothing leaves this machine.',
  side: 'Options and explanations',
  tabOptions: 'Options',
  tabExplain: 'Explain',
  tabLights: 'Lights',
  addPoint: 'Add a point light',
  addSpot: 'Add a spot',
  addDirectional: 'Add a directional light',
  removeLight: 'Remove',
  removeNamed: 'Remove {light}',
  lightsHint: 'Each light of the command line has handles in the picture. Drag them, or move them by the arrow keys; with Shift and drag, or Page Up and Page Down, away from the eye and back. Delete removes a light.',
  handlePosition: '{light}: place',
  handleAim: '{light}: where it aims',
  handleCone: '{light}: edge of its cone',
  searchOptions: 'Search the options',
  noOption: 'No option has these words.',
  without: 'Without {option}',
  standard: 'Default: {value}.',
  explainHint: 'Click a point of the picture: its calculation stands here.',
  command: 'The command line of this picture',
  copyCommand: 'Copy command',
  copyLink: 'Copy link',
  copied: 'Copied',
  selected: 'Selected: press Ctrl-C',
  note: 'The picture is the state of this command line. Files stay on this machine; a link does not contain them.',
  status: '{width}×{height}, {triangles} triangles, {ms} ms',
  saved: 'saved {file}',
  savedHash: 'saved {file}, SHA-256 {hash}',
  noModel: '{files}: no model among the files, expected .obj, .stl, .ply, .gltf, .glb or a scene file',
  workerEnded: 'the worker ended',

  pixel: 'Pixel {x}, {y} · {shading} shading, {reflection} · bytes {bytes}',
  background: 'No surface is here: the background.',
  surface: '{object}, triangle {triangle}, {side} · n {n} · v {v} · ambient {ambient}',
  unnamedObject: 'object {number}',
  light: 'light',
  attenuation: 'attenuation',
  spot: 'spot',
  diffuse: 'diffuse = kd Ld D',
  specular: 'specular = ks Ls S',
  sum: 'Sum: {sum}',
};

const ACCENTS = { a: 'á', c: 'ç', e: 'é', i: 'î', n: 'ñ', o: 'ö', s: 'š', u: 'ü', A: 'Å', C: 'Ç', D: 'Ð', E: 'É', I: 'Î', N: 'Ñ', O: 'Ö', S: 'Š', U: 'Û' };

// A third longer, as German is.
export function pseudo(template) {
  const parts = template.split(/(\{\w+\})/);
  const accented = parts.map((part, i) => (i % 2 ? part : part.replace(/[A-Za-z]/g, (letter) => ACCENTS[letter] ?? letter))).join('');
  return `⟦${accented}${'~'.repeat(Math.ceil(template.length / 3))}⟧`;
}

const isPseudo = typeof location === 'object' && new URLSearchParams(location.search).get('locale') === 'pseudo';

// The text of a key, with {names} replaced by values.
export function text(key, values = {}) {
  const template = STRINGS[key];
  if (template === undefined) throw new Error(`strings.js has no '${key}'`);
  return (isPseudo ? pseudo(template) : template).replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

export const stringKeys = () => Object.keys(STRINGS);

// Fills what the page's HTML names: data-text, data-label (aria-label), data-title, data-placeholder.
export function localize(root) {
  for (const [attribute, set] of [
    ['text', (node, value) => (node.textContent = value)],
    ['label', (node, value) => node.setAttribute('aria-label', value)],
    ['title', (node, value) => (node.title = value)],
    ['placeholder', (node, value) => (node.placeholder = value)],
  ])
    for (const node of root.querySelectorAll(`[data-${attribute}]`)) set(node, text(node.dataset[attribute]));
}
