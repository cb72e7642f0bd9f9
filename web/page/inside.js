// inside.js: what stands in the page itself: the scripts and modules of the page in one file, packed by gzip; files, and the command line that
// `lambent MODEL -o page.html` puts there (tools/page/page_write.c). They are texts that no browser runs, in base64.

// The page in one file as it was before any script ran.
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

// The words of the command line; null: the page has none of its own.
export function insideWords() {
  const place = document.getElementById('inside-words');
  return place && JSON.parse(place.textContent);
}

// The files by their paths. Their texts leave the page, since the bytes take their place.
export async function takeInsideFiles() {
  const files = new Map();
  for (const place of document.querySelectorAll('script.inside-file')) {
    files.set(place.dataset.path, await bytesOf(place));
    place.remove();
  }
  return files;
}
