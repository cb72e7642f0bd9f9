// ranked_models.js: chooses the opened model that is shown first, and finds the missing files of a model among the opened files.

const folderOf = (path) => path.replace(/[^/]*$/, '');
const baseOf = (path) => path.replace(/^.*\//, '').toLowerCase();
const endingOf = (path) => path.replace(/^.*\./, '').toLowerCase();

// Returns the path for a relative name in a file of this folder.
function pathFrom(folder, name) {
  const parts = [];
  for (const part of (folder + name.trim().replaceAll('\\', '/')).split('/')) part === '..' ? parts.pop() : part !== '.' && part && parts.push(part);
  return '/' + parts.join('/');
}

const HEAD = 1 << 16, START_OF = 1 << 14; // in bytes; this much of a file is searched for names
const textOf = (bytes, most) => new TextDecoder().decode(bytes.subarray(0, most));

// Returns 3 if the files contain the model's materials and textures, 2 if they contain its materials, 1 if the model names no materials, or 0 if files are
// missing that it names.
function completeness(path, files) {
  const folder = folderOf(path), has = (name) => files.has(pathFrom(folder, name));
  if (endingOf(path) === 'obj') {
    const library = /^mtllib[ \t]+(.+?)\s*$/m.exec(textOf(files.get(path), START_OF))?.[1];
    if (!library) return 1;
    if (!has(library)) return 0;
    const maps = [...textOf(files.get(pathFrom(folder, library)), HEAD).matchAll(/^\s*map_\w+[ \t]+(?:.*[ \t])?(\S+)\s*$/gm)].map(([, name]) => name);
    return maps.length && maps.every(has) ? 3 : maps.length ? 1 : 2;
  }
  if (endingOf(path) !== 'gltf') return endingOf(path) === 'glb' ? 3 : 1;
  return [...textOf(files.get(path), HEAD).matchAll(/"uri"\s*:\s*"([^":]+)"/g)].every(([, name]) => has(decodeURI(name))) ? 3 : 0;
}

// Sorts the paths of models. Complete models come first, then models in outer folders, then large models. Scene files come last, because many .json files are
// not scene files.
export function ranked(models, files) {
  const rows = models.map((path) => ({ path, level: endingOf(path) === 'json' ? -1 : completeness(path, files), depth: path.split('/').length, size: files.get(path).length }));
  return rows.sort((a, b) => b.level - a.level || a.depth - b.depth || b.size - a.size || (a.path < b.path ? -1 : 1)).map(({ path }) => path);
}

// Returns the number of equal parts at the ends of two paths.
function sharedParts(a, b) {
  const [x, y] = [a, b].map((path) => path.toLowerCase().split('/').reverse());
  const at = x.findIndex((part, i) => part !== y[i]);
  return at < 0 ? x.length : at;
}

// Finds the missing files among `files`. Returns a map from the path at which the model expects a file to the path of the file in `files`. If several files
// have the same name, the file whose folders agree best is used.
export function companions(missing, files) {
  const found = new Map();
  for (const path of missing) {
    const [same] = [...files.keys()].filter((other) => baseOf(other) === baseOf(path)).sort((a, b) => sharedParts(b, path) - sharedParts(a, path));
    if (same) found.set(path, same);
  }
  return found;
}

// Returns the found files by the paths at which the model expects them. Also returns the files in the same folders, because the found files may name them.
export function withNeighbours(found, files) {
  const placed = new Map();
  for (const [path, same] of found)
    for (const [other, bytes] of files) if (other.startsWith(folderOf(same))) placed.set(folderOf(path) + other.slice(folderOf(same).length), bytes);
  for (const [path, same] of found) placed.set(path, files.get(same));
  return placed;
}

// Returns whether a model is a scene file that sets a size.
export function setsSize(path, files) {
  if (endingOf(path) !== 'json') return false;
  try {
    return Boolean(JSON.parse(new TextDecoder().decode(files.get(path))).image?.size);
  } catch {
    return false; // the program reports the error
  }
}
