// inside.js: data inside the page itself: scripts and modules of the one-file page, compressed by gzip; files and the command line that
// `lambent MODEL -o page.html` writes (tools/page/page_write.c). They are base64 texts in script elements that browsers do not run.

// The text of the one-file page before any script has run.
export const pristine = ONE_FILE ? document.documentElement.cloneNode(true) : null;

export const insideText = (id) => document.getElementById(id).textContent;
export const insideScript = (code) => URL.createObjectURL(new Blob([code], { type: 'text/javascript' }));

const unpacked = (bytes) => new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')));
const decoded = (letters) => Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0));

export const insideStream = (id) => unpacked(decoded(insideText(id)));

async function bytesOf(place) {
  const bytes = decoded(place.textContent);
  return place.dataset.packed === 'gzip' ? new Uint8Array(await unpacked(bytes).arrayBuffer()) : bytes;
}

// The words of the command line; null: the page contains none. A picture that filled the sender's window fills this one: `size`.
export function insideWords(size) {
  const place = document.getElementById('inside-words'), words = place && JSON.parse(place.textContent);
  return place?.dataset.window ? words.map((word) => (word === place.dataset.window ? size : word)) : words;
}

// The files by path. Their texts are removed from the page to save memory.
export async function takeInsideFiles() {
  const files = new Map();
  for (const place of document.querySelectorAll('script.inside-file')) {
    files.set(place.dataset.path, await bytesOf(place));
    place.remove();
  }
  return files;
}
