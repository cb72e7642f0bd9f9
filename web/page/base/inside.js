// inside.js: reads the data that the page itself contains. The one-file page contains scripts and modules, compressed by gzip. A page that `lambent MODEL -o
// page.html` writes (tools/page/page_write.c) also contains files and a command line. All of these are texts in script elements that browsers do not run.
// Binary data is encoded in base64.

// A copy of the one-file page as it was before any script ran.
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

// Returns the words of the command line, or null if the page contains none. If the picture filled the sender's window, it gets `size`, which fills this window.
export function insideWords(size) {
  const place = document.getElementById('inside-words'), words = place && JSON.parse(place.textContent);
  return place?.dataset.window ? words.map((word) => (word === place.dataset.window ? size : word)) : words;
}

// Returns the files by path. The texts of the files are removed from the page to save memory.
export async function takeInsideFiles() {
  const files = new Map();
  for (const place of document.querySelectorAll('script.inside-file')) {
    files.set(place.dataset.path, await bytesOf(place));
    place.remove();
  }
  return files;
}
