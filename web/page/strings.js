// strings.js: every text of the page, in one table; a part of the page that is fetched later adds its own texts to it (shader_strings.js). What the
// program says (names and summaries of options, sentences of errors, words of command lines) comes from the module and stands in elements with
// translate="no". ?locale=pseudo writes the table with accents between ⟦ and ⟧: a text without them has escaped the table, and one that is cut
// off would be cut off in a longer language.
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
  touchKeys: 'One finger turns, two move and zoom. A tap explains the point.',
  drop: 'Drop a model, its files, or a folder. Nothing leaves this machine.',
  side: 'Options and explanations',
  tabQuick: 'Picture',
  tabOptions: 'Options',
  tabShaders: 'Shaders',
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
  explainHint: 'Point at the picture: the calculation stands here, and its vectors stand on the surface. A click, or Enter for the middle, pins the point; Alt and arrow keys move it; Escape lets it go.',
  command: 'The command line of this picture',
  copyCommand: 'Copy command',
  copyLink: 'Copy link',
  copied: 'Copied',
  selected: 'Selected: press Ctrl-C',
  note: 'The picture is the state of this command line. Files stay on this machine; a link does not contain them.',
  status: '{width}×{height}, {triangles} triangles, {ms} ms',
  saved: 'saved {file}',
  savedHash: 'saved {file}, SHA-256 {hash}',
  noModel: '{files}: no model among the files, expected one of {endings}',
  modelsOpened: 'Opened',
  modelsShapes: 'Shapes',
  chooseFiles: 'Choose files…',
  missingFiles: 'Files that belong to this model are missing: {files}. Choose them, or the folder with all of them.',
  missingSeen: 'Draw without them',
  linkWithout: 'This is a link to {file}. Links contain no files: open that file here to see the picture.',
  openNamed: 'Open it…',
  linkCopied: 'The link contains no files: whoever opens it needs {file}.',
  workerEnded: 'the worker ended',
  gallery: '← Gallery',
  drawnByProgram: 'drawn by lambent view, since {reason}',
  notByProgram: 'The page cannot do this with a model that lambent view draws.',
  fileChanged: 'The file has changed: the picture is new.',
  viewerEnded: 'lambent view has ended. What it has sent can still be turned.',

  stop: 'Stop',
  stopping: 'Stopping…',
  stopped: 'The drawing was stopped. The picture before it stays.',
  tooLong: 'This picture took long, and was not finished when the page was closed. It is not drawn by itself.',
  drawAgain: 'Draw it',
  progress: 'Share of the picture that is drawn',
  loading: 'Loading {name}: {amount}',
  loadingModel: 'Loading {name}…',
  notLoaded: '{name} could not be loaded: the server answers {code}',
  notReached: '{name} could not be loaded: the server cannot be reached',
  tooLarge: '{file}: the files have {size} MB together, more than the {most} MB that this page takes on this machine; the program lambent draws them',
  viewChanged: 'Seen from {around} degrees around and {above} degrees above, {far} radii away.',
  saveScene: 'Save scene file',
  savedScene: 'saved {file}; it names the files of the model, and does not contain them',

  compare: 'Before and now',
  divider: 'Line between before and now',
  before: 'Left, before:',
  keepNow: 'Keep this one',
  swap: 'Swap',
  endSplit: 'End',

  mineLights: 'Write out the lights',
  mineDone: '{count} lights stand in the command line now. The picture is the same.',
  mineDiffers: 'These lights cannot be written out: the picture would change.',
  sliderOf: '{name} of {light}',
  sliderShininess: 'Shininess of the highlights',
  curveAttenuation: 'Attenuation over distance',
  curveSpot: 'Cone over the angle from its axis',
  curveHighlight: 'Highlight over the angle φ',
  curveAt: '{title}: at {x} it is {y}',
  curveHint: 'Point at the picture, or click: the highlight of that point stands here as a curve.',

  pixel: 'Pixel {x}, {y} · {shading} shading, {reflection} · bytes {bytes}',
  background: 'No surface is here: the background.',
  surface: '{object}, triangle {triangle}, {side}',
  unnamedObject: 'object {number}',
  pinned: 'Pinned to the surface.',
  pinHidden: 'The pinned point is hidden: this is what stands before it.',
  pinOutside: 'The pinned point is outside of the picture.',
  unpin: 'Unpin',
  unpinned: 'Unpinned.',
  speak: 'Speak',
  aboutNormal: 'normal',
  aboutNormalBack: 'normal, reversed: the back is seen',
  aboutView: 'to the eye',
  aboutLight: 'to the light',
  aboutMirrored: 'the light mirrored: 2 (n·l) n − l',
  aboutHalf: 'halfway: (l + v) / |l + v|',
  corners: 'Corners of the triangle, where the light is computed',
  corner: 'Corner {number}, weight {weight}',
  sumTitle: 'Sum',
  aroundTitle: 'From all around',
  aboutReflected: 'the eye mirrored: 2 (n·v) n − v',
  lightsTitle: 'Lights',
  interpolated: 'The sums of the three corners, by their weights: {color}.',
  bytes: 'Encoded for the screen: bytes {bytes}.',
  moreTriangles: 'The pixel shows {count} more triangles in part.',
  leftOut: 'Left out: too weak here (--light-cutoff).',

  spokenBackground: 'Pixel {x}, {y} shows the background.',
  spokenPixel: 'Pixel {x}, {y} shows {object}: red {red}, green {green}, blue {blue}, of 255.',
  spokenTerm: '{percent} percent of its light is {term}.',
  spokenLight: 'The light {light} arrives at {angle} degrees from the normal: diffuse {diffuse}, highlight {specular}.',
  spokenBehind: 'The light {light} is behind the surface.',
  termAmbient: 'ambient',
  termDiffuse: 'diffuse',
  termSpecular: 'specular',
  termReflection: 'reflection of the surroundings',
  termEmission: 'its own',
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

// Texts of a part of the page that is fetched later, with their table.
export const addStrings = (more) => Object.assign(STRINGS, more);

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
