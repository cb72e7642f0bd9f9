// packed_page.js: writes the page as one file that contains a model, as `lambent MODEL -o page.html` does. A browser can open the file locally, without a
// network.
import { fetchModule } from '../worker/start.js';
import { pristine } from '../base/inside.js';
import { text } from '../base/strings.js';

const MOST = 1e8; // largest total size of the files in bytes, as in the program

async function packed(bytes) {
  const gzip = await new Response(new Blob([bytes]).stream().pipeThrough(new CompressionStream('gzip'))).blob();
  const url = await new Promise((done, failed) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.onerror = () => failed(reader.error);
    reader.readAsDataURL(gzip);
  });
  return url.slice(url.indexOf(',') + 1);
}

// Returns the text of the one-file page. It is this page itself, or a file beside the served page.
async function emptyPage() {
  if (!pristine) return new TextDecoder().decode(await fetchModule('alone.html'));
  const page = pristine.cloneNode(true);
  for (const own of page.querySelectorAll('#served, #inside-words, .inside-file')) own.remove();
  return `<!doctype html>\n${page.outerHTML}\n`;
}

const quoted = (path) => path.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');

// `files`: [path, bytes]. `filling`: the size that fills the window, as a word, or ''. Returns a Blob.
export async function pageWithModel(words, files, filling) {
  const size = files.reduce((sum, [, bytes]) => sum + bytes.length, 0);
  if (size > MOST) throw new Error(text('pageTooLarge', { size: Math.round(size / 1e6), most: MOST / 1e6 }));
  const page = await emptyPage(), end = page.lastIndexOf('</body>');
  const texts = [];
  for (const [path, bytes] of files) texts.push(`<script type="text/plain" class="inside-file" data-path="${quoted(path)}" data-packed="gzip">${await packed(bytes)}</script>\n`);
  texts.push(`<script type="application/json" id="inside-words"${filling && ` data-window="${filling}"`}>${JSON.stringify(words).replaceAll('<', '\\u003c')}</script>\n`);
  return new Blob([page.slice(0, end), ...texts, page.slice(end)], { type: 'text/html' });
}
