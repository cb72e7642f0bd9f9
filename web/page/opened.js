// opened.js: the files that were opened: a set for each time, so that a model keeps its own companions when others of the same names are opened.
// The worker has the files of one set at a time.
import { FILES_BYTES } from './memory.js';

const sets = []; // { files: Map of bytes by path }; the newest last
let given = null; // the set that the worker has

const sizeOf = (set) => [...set.files.values()].reduce((sum, bytes) => sum + bytes.length, 0);

// The set of a model; null: its file was not opened.
export const setOf = (model) => sets.findLast((set) => set.files.has(model)) ?? null;

export const openedPaths = () => [...new Set(sets.toReversed().flatMap((set) => [...set.files.keys()]))];

// Adds files; the oldest ones leave if all together are too many, except the files of `model`.
export function addFiles(files, model) {
  sets.push({ files });
  for (let i = 0; i < sets.length - 1 && sets.reduce((sum, set) => sum + sizeOf(set), 0) > FILES_BYTES; ) {
    if (sets[i].files.has(model)) i++;
    else sets.splice(i, 1);
  }
}

// Adds files to a model's files.
export function addCompanions(model, files) {
  const set = setOf(model);
  for (const [path, bytes] of files) set.files.set(path, bytes);
  given = null;
}

// Has `send` give the worker the files of a model, if it has others.
export function giveFilesOf(model, send) {
  const set = setOf(model);
  if (!set || set === given) return;
  given = set;
  send([...set.files]);
}
