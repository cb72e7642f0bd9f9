// pictures.mjs MODULES CHROMIUM FOLDER OUT: draws models with model-viewer and F3D 3.5 in Chromium, for bench/beside.py.
//
// Reads one JSON object per line of standard input, and writes OUT/PEER/NAME.png of size × size pixels, on white:
//     {"peer": "model-viewer", "name", "path", "size"}
//     {"peer": "f3d-3.5" | "f3d-3.5-tone", "name", "path", "size", "camera", "up"}
// `path` is below FOLDER. `camera` has the fields that `lambent --json` prints, and `up` is an axis such as "+Z".
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, relative, resolve, sep } from 'node:path';
import { createInterface } from 'node:readline';

const [, , modules, executablePath, folder, out] = process.argv;
const { chromium } = createRequire(join(resolve(modules), 'x'))('playwright-core');
const TIME_LIMIT_MS = 150000;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
const PAGE = '<!doctype html><link rel="icon" href="data:,"><body style="margin:0"><canvas id="canvas"></canvas>';
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

// The functions below run in the page.

// Draws a model with the default environment and tone curve, from 30 degrees to the right of the front and 20 above, and
// returns the PNG file in base64. Without minimumRenderScale, software rendering would lower the resolution.
async function drawModelViewer({ path, size }) {
  document.getElementById('canvas').remove();
  await import('/modules/@google/model-viewer/dist/model-viewer.min.js');
  const Viewer = await customElements.whenDefined('model-viewer');
  Viewer.minimumRenderScale = 1;
  Viewer.dracoDecoderLocation = '/modules/three/examples/jsm/libs/draco/gltf/';
  Viewer.ktx2TranscoderLocation = '/modules/three/examples/jsm/libs/basis/';
  const viewer = document.createElement('model-viewer');
  viewer.setAttribute('camera-orbit', '30deg 70deg auto');
  viewer.setAttribute('interaction-prompt', 'none');
  viewer.style.cssText = `width:${size}px;height:${size}px;background:#fff`;
  const loaded = new Promise((done, failed) => {
    viewer.addEventListener('error', () => failed(new Error('the model was not loaded')));
    viewer.addEventListener('load', done);
  });
  viewer.src = '/models/' + path;
  document.body.append(viewer);
  await loaded;
  viewer.jumpCameraToGoal();
  let picture, before;
  do { // wait until the environment and all textures are shown, which takes seconds with software rendering
    before = picture;
    await new Promise((done) => setTimeout(done, 2500));
    picture = viewer.toDataURL('image/png');
  } while (picture !== before || picture.length < 10000);
  return picture.split(',')[1];
}

// Draws a model with F3D's best settings, and returns the PNG file in base64.
async function drawF3d({ path, files, camera, up, size, tone }) {
  if (!globalThis.f3d) {
    const { default: start } = await import('/modules/f3d/dist/f3d.js');
    globalThis.f3d = await start({ canvas: document.getElementById('canvas') });
    globalThis.f3d.Engine.autoloadPlugins();
    globalThis.engine = globalThis.f3d.Engine.create();
  }
  const { f3d, engine } = globalThis, options = engine.getOptions(), window = engine.getWindow();
  for (const file of files) {
    const bytes = new Uint8Array(await (await fetch('/models/' + file)).arrayBuffer());
    f3d.FS.mkdirTree('/' + file.split('/').slice(0, -1).join('/'), 0o777);
    f3d.FS.writeFile('/' + file, bytes);
  }
  const values = {
    'render.effect.ambient_occlusion': 'true', 'render.effect.antialiasing.enable': 'true', 'render.effect.antialiasing.mode': 'ssaa',
    'render.effect.tone_mapping': String(tone), 'render.effect.blending.enable': 'true', 'render.hdri.ambient': 'true',
    'render.background.color': '1,1,1', 'render.grid.enable': 'false', 'ui.axis': 'false', 'ui.drop_zone.enable': 'false',
    'ui.loader_progress': 'false', 'scene.up_direction': up,
  };
  for (const [name, value] of Object.entries(values)) options.setAsString(name, value);
  window.setSize(size, size);
  engine.getScene().clear();
  engine.getScene().add('/' + path);
  const view = window.getCamera();
  view.position = camera.eye;
  view.focalPoint = camera.target;
  view.viewUp = camera.up;
  view.viewAngle = camera.fovy_deg;
  window.render();
  await new Promise((done) => setTimeout(done, 300));
  // saveBuffer() returns memory that is already freed, so the pixels are copied instead. The first row of the copied
  // pixels is the picture's last row.
  const image = window.renderToImage(false), pixels = image.getContent(), channels = pixels.length / (size * size);
  const sheet = Object.assign(document.createElement('canvas'), { width: size, height: size }), drawing = sheet.getContext('2d');
  const copy = drawing.createImageData(size, size);
  for (let y = 0; y < size; y++)
    for (let x = 0; x < size; x++)
      for (let c = 0; c < 4; c++) copy.data[4 * (y * size + x) + c] = c < 3 ? pixels[channels * ((size - 1 - y) * size + x) + c] : 255;
  drawing.putImageData(copy, 0, 0);
  return sheet.toDataURL('image/png').split(',')[1];
}

// Returns the model and the files in its folder and subfolders, because the model may need them.
function filesOf(path) {
  if (/\.(glb|stl|ply)$/i.test(path)) return [path];
  const top = dirname(join(roots.models, path));
  const beside = readdirSync(top, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile() && !/\.(obj|glb|gltf|stl|ply)$/i.test(entry.name));
  return [path, ...beside.map((entry) => relative(roots.models, join(entry.parentPath, entry.name)))];
}

let page, peer;
async function open(task) {
  await page?.context().browser().close().catch(() => {});
  const browser = await chromium.launch({ executablePath, args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
  page = await browser.newPage({ viewport: { width: task.size, height: task.size } });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  peer = task.peer;
}

// Calls a function in the page. The page stays open for the next model of F3D, because preparing F3D's environment
// takes half a minute.
async function draw(task, tries = 2) {
  if (task.peer !== peer || peer === 'model-viewer') await open(task);
  const clock = setTimeout(() => page.context().browser().close(), TIME_LIMIT_MS);
  try {
    mkdirSync(join(out, task.peer), { recursive: true });
    const file = join(out, task.peer, `${task.name}.png`);
    const data = task.peer === 'model-viewer' ? await page.evaluate(drawModelViewer, task)
      : await page.evaluate(drawF3d, { ...task, tone: task.peer === 'f3d-3.5-tone', files: filesOf(task.path) });
    writeFileSync(file, Buffer.from(data, 'base64'));
  } catch (error) {
    peer = null; // the browser may have crashed: software rendering sometimes starts too slowly
    if (tries === 1) console.error(`${task.peer} ${task.name}: ${error.message.split('\n')[0]}`);
  }
  clearTimeout(clock);
  if (!peer && tries > 1) await draw(task, tries - 1);
}

for await (const line of createInterface({ input: process.stdin })) await draw(JSON.parse(line));
await page?.context().browser().close();
server.closeAllConnections();
server.close();
