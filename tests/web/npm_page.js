// npm_page.js: the script of the pages of npm_page.mjs. PAGE_WASM and PAGE_WORKER are set in a bundle; a page without a bundler has
// neither.
import { open, openWorker } from 'lambent';

const hash = async (bytes) => [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
const bundled = typeof PAGE_WORKER === 'string';
const source = bundled ? (await import('lambent/lambent.wasm')).default : undefined;
const worker = bundled ? () => new Worker(PAGE_WORKER, { type: 'module' }) : undefined;
const options = { size: 96, view: 'front', lightCutoff: 0, shadows: true, light: ['point:position=1/2/3', 'ambient'] };

async function draw(lambent) {
  lambent.files.set('/cube.stl', await (await fetch('../cube.stl')).arrayBuffer());
  return hash(await lambent.draw('/cube.stl', options, { as: 'png' }));
}

try {
  document.title = JSON.stringify({ here: await draw(await open(source)), worker: await draw(await openWorker(source, { worker })) });
} catch (error) {
  document.title = JSON.stringify({ error: `${error.name}: ${error.message}` });
}
