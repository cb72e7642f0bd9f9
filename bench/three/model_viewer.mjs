// model_viewer.mjs MODULES CHROMIUM FOLDER OUT: draws glTF models with <model-viewer> in Chromium, with its defaults, from the same side as
// Lambent.
//
// Reads "NAME PATH" on each line of standard input, PATH below FOLDER, and writes OUT/NAME.png, 512 pixels, on white. MODULES is a node_modules
// folder with @google/model-viewer and three (for Draco's decoder). It is a separate folder, because model-viewer needs an older three than the
// bench.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve, sep } from 'node:path';
import { createInterface } from 'node:readline';

const [, , modules, executablePath, folder, out] = process.argv;
const { chromium } = createRequire(import.meta.url)('playwright-core');
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
const PAGE = '<!doctype html><link rel="icon" href="data:,"><body style="margin:0"><script type="module" src="/modules/@google/model-viewer/dist/model-viewer.min.js"></script>';
const roots = { modules: resolve(modules), models: resolve(folder) };

const server = createServer((request, response) => {
  const [, root, ...rest] = decodeURIComponent(new URL(request.url, 'http://x').pathname).split('/');
  if (!root) return response.setHeader('content-type', 'text/html').end(PAGE);
  const path = roots[root] && resolve(join(roots[root], ...rest));
  if (!path?.startsWith(roots[root] + sep)) return response.writeHead(404).end();
  try {
    response.setHeader('content-type', TYPES[extname(path)] ?? 'application/octet-stream').end(readFileSync(path));
  } catch {
    response.writeHead(404).end();
  }
}).listen(0, '127.0.0.1');
await new Promise((done) => server.once('listening', done));

const show = (path) => new Promise(async (done, failed) => {
  await customElements.whenDefined('model-viewer');
  customElements.get('model-viewer').dracoDecoderLocation = '/modules/three/examples/jsm/libs/draco/gltf/';
  const viewer = document.createElement('model-viewer');
  viewer.setAttribute('camera-orbit', '30deg 70deg auto'); // 30 degrees to the right of the front, 20 above
  viewer.setAttribute('interaction-prompt', 'none');
  viewer.style.cssText = 'width:512px;height:512px;background:#fff';
  viewer.addEventListener('error', () => failed(new Error('the model was not loaded')));
  viewer.addEventListener('load', () => { viewer.jumpCameraToGoal(); setTimeout(done, 2500); });
  viewer.src = '/models/' + path;
  document.body.append(viewer);
});

const browser = await chromium.launch({ executablePath, args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
for await (const line of createInterface({ input: process.stdin })) {
  const [name, path] = line.split(' ');
  const page = await browser.newPage({ viewport: { width: 512, height: 512 } });
  try {
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.evaluate(show, path);
    await page.screenshot({ path: join(out, `${name}.png`) });
  } catch (error) {
    console.error(`${name}: ${error.message.split('\n')[0]}`);
  }
  await page.close();
}
await browser.close();
server.close();
