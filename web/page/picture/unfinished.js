// unfinished.js: stores for this browser tab whether a long drawing was unfinished or stopped when the page was closed. If so, the page does not start the same
// drawing by itself.
const KEY = 'lambent-unfinished', LONG_MS = 3000;
let timer = 0;

function remember(words) {
  try {
    if (words) sessionStorage.setItem(KEY, JSON.stringify(words));
    else sessionStorage.removeItem(KEY);
  } catch {
    // without storage, the page draws it again
  }
}

// Called when a drawing starts. A long drawing is stored until it is finished.
export function started(words) {
  finished();
  timer = setTimeout(() => remember(words), LONG_MS);
}

// Called when the user stops a drawing.
export const stopped = remember;

export function finished() {
  clearTimeout(timer);
  remember(null);
}

export function isTooLong(words) {
  try {
    return sessionStorage.getItem(KEY) === JSON.stringify(words);
  } catch {
    return false;
  }
}
