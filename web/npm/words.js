// words.js: converts typed options to the words of a command line, and removes names of Debian packages from messages.
import { typeError } from './files.js';

const FORMATS = ['pixels', 'png', 'jpg', 'ppm', 'pfm'];

// Converts the key of an option to the option: "lightCutoff" becomes "--light-cutoff".
const nameOf = (key) => '--' + key.replace(/[A-Z]/g, (letter) => '-' + letter.toLowerCase());

function checkWords(where, words) {
  for (const word of words) if (typeof word !== 'string') throw typeError(where, 'a word', word, 'a text');
  return words;
}

function wordsOfOption(where, key, value) {
  if (value === undefined || value === null || value === false) return [];
  if (value === true) return [nameOf(key)];
  if (Array.isArray(value)) return value.flatMap((one) => wordsOfOption(where, key, one));
  if (typeof value !== 'string' && (typeof value !== 'number' || !Number.isFinite(value)))
    throw typeError(where, `options.${key}`, value, 'a text, a finite number, true, false or an array of them');
  return [`${nameOf(key)}=${value}`];
}

// Returns the words of a model and its options. `model` may also be an array of words, which is then returned.
export function wordsOf(where, model, options = {}) {
  if (Array.isArray(model)) return checkWords(where, model);
  if (typeof model !== 'string' || model === '' || model.startsWith('-'))
    throw typeError(where, 'model', model, 'a path such as "/model.stl", the name of a shape, or an array of words');
  if (typeof options !== 'object' || options === null || Array.isArray(options)) throw typeError(where, 'options', options, 'an object');
  return [model, ...Object.entries(options).flatMap(([key, value]) => wordsOfOption(where, key, value))];
}

// Checks the last argument of draw: signal, onProgress, as.
export function checkCall(where, call = {}) {
  const { signal, onProgress, as = 'pixels' } = call ?? {};
  if (typeof call !== 'object' || call === null) throw typeError(where, 'call', call, 'an object');
  if (signal !== undefined && typeof signal?.throwIfAborted !== 'function') throw typeError(where, 'signal', signal, 'an AbortSignal');
  if (onProgress !== undefined && typeof onProgress !== 'function') throw typeError(where, 'onProgress', onProgress, 'a function');
  if (!FORMATS.includes(as)) throw typeError(where, `as "${as}"`, as, FORMATS.join(', '));
  return { signal, onProgress, as };
}

// The program's messages name Debian packages, which help only if the program is installed.
export function plainSentence(text) {
  return text.replace(/ \([^()]*\b(?:Debian|lib[\w+-]+-dev)\b[^()]*\)/g, '').replace(/;[^;]*\bDebian packages?\b[^;]*$/, '').replace(/\bis not installed\b/g, 'is not in this module');
}
