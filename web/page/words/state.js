// state.js: the state of the page: the words of a command line, with options in the order in which they were given. Undo and redo use lists of earlier and
// later states.
// The picture, the link, and the shown and copied command are made from the same words.

// The first picture. It has one light, and a material with a highlight, so that each term of the sum is visible.
export const START = ['teapot', '--material=ambient=#12657a,diffuse=#1688a5,specular=0.7,shininess=80', '--light=point:position=0.3r/0.5r/1r', '--ambient=0.3'];

// The models that are formulas. The name of the model is also the name of its option. The value is the initial formula.
export const FORMULAS = { parametric: 'a=2; x=(a+cos(v))*cos(u); y=(a+cos(v))*sin(u); z=sin(v)', implicit: 'x^2+y^2+z^2-1' };
const OF_FORMULAS = [...Object.keys(FORMULAS), 'u', 'v', 'x', 'y', 'z', 'flip'];

export const isScene = (model) => /\.json$/i.test(model);

// Returns the words with another model, and with a formula if the model is a formula. Options of the old formula are removed.
export function withModel(words, name, formula = FORMULAS[name]) {
  const rest = words.slice(1).filter((word) => !OF_FORMULAS.includes(word.slice(2).split('=')[0]));
  return formula ? [name, `--${name}=${formula}`, ...rest] : [name, ...rest];
}

// Options that determine the view. --camera replaces all of them.
export const VIEW = ['view', 'azimuth', 'elevation', 'zoom', 'fov', 'projection'];

// Returns the words without some options.
export const without = (words, ...names) => names.reduce((rest, name) => new State(rest).withValues(name, []), words);

// Returns the words that determine how the model looks, independent of the view.
export const appearance = (words) => without(words, ...VIEW, 'camera', 'size').join('\n');

// Returns whether a value of --material is a metal, which reflects its surroundings.
export const isMetal = (material) => /\bmetallic=1\b/.test(material ?? '');

export class State {
  #past = [];
  #future = [];
  #mergeKey = null;

  constructor(words) {
    this.words = words;
    this.onchange = () => {};
  }

  // Sets the words. Changes with the same key (one gesture) are one step of undo.
  set(words, mergeKey = null) {
    if (words.length === this.words.length && words.every((word, i) => word === this.words[i])) return;
    if (!mergeKey || mergeKey !== this.#mergeKey) this.#past.push(this.words);
    this.#mergeKey = mergeKey;
    this.#future = [];
    this.words = words;
    this.onchange();
  }

  // Replaces a word in the current words and in all steps of undo and redo. Does not add a step.
  replace(old, word) {
    const change = (words) => words.map((one) => (one === old ? word : one));
    this.#past = this.#past.map(change);
    this.#future = this.#future.map(change);
    this.words = change(this.words);
    this.onchange();
  }

  endGesture() {
    this.#mergeKey = null;
  }

  #go(from, to) {
    if (!from.length) return;
    to.push(this.words);
    this.words = from.pop();
    this.#mergeKey = null;
    this.onchange();
  }

  undo() {
    this.#go(this.#past, this.#future);
  }

  redo() {
    this.#go(this.#future, this.#past);
  }

  // Returns the previous states. The newest state is the last.
  get past() {
    return this.#past;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  get model() {
    return this.words[0];
  }

  // Returns the values of an option, in order. The word "--name=value" has the value "value", and the word "--name" has the value ''.
  values(name) {
    return this.words
      .slice(1)
      .filter((word) => word === `--${name}` || word.startsWith(`--${name}=`))
      .map((word) => word.slice(name.length + 3));
  }

  // Returns the words with other values of an option, at the same position. An empty list removes the option.
  withValues(name, values) {
    const is = (word) => word === `--${name}` || word.startsWith(`--${name}=`);
    const at = this.words.findIndex((word, i) => i > 0 && is(word));
    const words = this.words.filter((word, i) => i === 0 || !is(word));
    const added = values.map((value) => (value === '' ? `--${name}` : `--${name}=${value}`));
    words.splice(at < 0 ? words.length : at, 0, ...added);
    return words;
  }
}

// Quotes a word for a POSIX shell.
export function quoted(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

// Returns the words of the command that draws the same picture, quoted for a shell. File names are relative to the opened folder.
export function commandWords(words) {
  const model = words[0].replace(/^\//, '');
  // If a file name equals a shape or command, or begins like an option, it gets the prefix './'.
  const named = model !== words[0] && (!/[./]/.test(model) || model.startsWith('-')) ? './' + model : model;
  return ['lambent', words[0] in FORMULAS ? 'shape' : named, ...words.slice(1)].map(quoted);
}

export const command = (words) => commandWords(words).join(' ');

// Converts the words to the fragment of an address, and back. fromFragment() returns null if the fragment contains no words.
export function toFragment(words) {
  return '#' + words.map(encodeURIComponent).join('&');
}

export function fromFragment(fragment) {
  if (fragment.length < 2) return null;
  try {
    return fragment.slice(1).split('&').map(decodeURIComponent);
  } catch {
    return null;
  }
}
