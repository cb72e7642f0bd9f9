// unfinished.js: whether a picture that takes long was still being drawn, or had been stopped, when this page was last open in its tab: then it is not begun
// again by itself. The browser keeps the words for the tab alone.
const KEY = 'lambent-unfinished', LONG_MS = 3000;
let timer = 0;

function remember(words) {
  try {
    if (words) sessionStorage.setItem(KEY, JSON.stringify(words));
    else sessionStorage.removeItem(KEY);
  } catch {
    // a page may have no storage: then it draws again
  }
}

// A drawing has begun; if it takes long, it is remembered until it is finished.
export function started(words) {
  finished();
  timer = setTimeout(() => remember(words), LONG_MS);
}

// A person has stopped it.
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
