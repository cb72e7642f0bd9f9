// inside.js: files that stand in the page, and the command line that `lambent MODEL -o page.html` puts there (tools/page/page_write.c):
// texts that are no scripts, in base64, packed by gzip where they say so.

async function bytesOf(place) {
  const letters = atob(place.textContent), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  if (place.dataset.packed !== 'gzip') return bytes;
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
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
