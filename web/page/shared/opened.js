// opened.js: keeps the opened files. Files that are opened together are a set, so that a model keeps its companions if other files with the same names are
// opened later. The worker has the files of one set at a time.
import { FILES_BYTES } from '../base/memory.js';

const sets = []; // { files: Map of bytes by path }, the newest last
let given = null; // the set whose files the worker has

const sizeOf = (set) => [...set.files.values()].reduce((sum, bytes) => sum + bytes.length, 0);

// Returns the set of a model, or null if the user has not opened the model's file.
export const setOf = (model) => sets.findLast((set) => set.files.has(model)) ?? null;

export const openedPaths = () => [...new Set(sets.toReversed().flatMap((set) => [...set.files.keys()]))];

// Adds files. If the total size is above the limit, the oldest sets are removed, except the set of `model`.
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

// Sends the files of a model to the worker by `send`, unless the worker already has them.
export function giveFilesOf(model, send) {
  const set = setOf(model);
  if (!set || set === given) return;
  given = set;
  send([...set.files]);
}
