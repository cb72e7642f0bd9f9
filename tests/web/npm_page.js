// npm_page.js: the script of the pages of npm_page.mjs. esbuild sets PAGE_WORKER; Vite and a page without a bundler need nothing.
import { open, openWorker } from 'lambent';

const hash = async (bytes) => [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
const bundled = typeof PAGE_WORKER === 'string';
const options = { size: 96, view: 'front', lightCutoff: 0, shadows: true, light: ['point:position=1/2/3', 'ambient'] };

async function draw(lambent) {
  lambent.files.set('/cube.stl', await (await fetch('../cube.stl')).arrayBuffer());
  return hash(await lambent.draw('/cube.stl', options, { as: 'png' }));
}

async function main() {
  const source = bundled ? (await import('lambent/lambent.wasm')).default : undefined;
  const worker = bundled ? () => new Worker(PAGE_WORKER, { type: 'module' }) : undefined;
  return { here: await draw(await open(source)), worker: await draw(await openWorker(source, { worker })) };
}

main()
  .catch((error) => ({ error: `${error.name}: ${error.message}` }))
  .then((found) => (document.title = JSON.stringify(found)));
