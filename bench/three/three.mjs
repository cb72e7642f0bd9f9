// three.mjs MODULES CHROMIUM FOLDER: draws models with three.js in Chromium, which uses the software GPU SwiftShader.
//
// Reads a task on each line of standard input, and answers with a line of JSON, {"error": …} where it failed:
//     {"load": "glb/a.glb", "size": [w, h], "camera": {eye, target, up, fovy_deg, near, far}, "light": {direction, intensity},
//      "environment": "env/a.hdr", "antialias": true}   a model of FOLDER; one of light and environment   -> {"renderer", "version"}
//     {"frames": n, "turn": degrees}          the camera turns between frames                    -> [milliseconds of each]
//     {"save": "picture.png"}                 writes the picture                                  -> {}
// A frame ends when one of its pixels has been read back, because gl.finish() does not wait in Chromium.
import { readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve, sep } from 'node:path';
import { createInterface } from 'node:readline';

const [, , modules, executablePath, folder] = process.argv;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.png': 'image/png', '.jpg': 'image/jpeg' };
const PAGE = `<!doctype html><link rel="icon" href="data:,"><body style="margin:0"><script type="importmap">{"imports": {"three": "/three/build/three.module.js"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from '/three/examples/jsm/loaders/GLTFLoader.js';
import { HDRLoader } from '/three/examples/jsm/loaders/HDRLoader.js';
let renderer, scene, camera, target = new THREE.Vector3();
window.load = async (task) => {
  const [width, height] = task.size;
  renderer = new THREE.WebGLRenderer({ antialias: Boolean(task.antialias), alpha: true });
  renderer.setPixelRatio(1);
  renderer.setSize(width, height);
  renderer.setClearColor(0, 0);
  renderer.toneMapping = THREE.NeutralToneMapping; // the same as Lambent's
  document.body.append(renderer.domElement);
  scene = new THREE.Scene();
  const { eye, up, fovy_deg, near, far } = task.camera;
  camera = new THREE.PerspectiveCamera(fovy_deg, width / height, near, far);
  camera.position.set(...eye);
  camera.up.set(...up);
  camera.lookAt(target.set(...task.camera.target));
  scene.add((await new GLTFLoader().loadAsync('/models/' + task.load)).scene);
  if (task.light) {
    // In Lambent, Lambert's term is the base colour. three.js divides the base colour by pi.
    const light = new THREE.DirectionalLight(0xffffff, task.light.intensity * Math.PI);
    light.position.set(...task.light.direction.map((x) => -x));
    scene.add(light);
  }
  if (task.environment) {
    const made = new THREE.PMREMGenerator(renderer);
    scene.environment = made.fromEquirectangular(await new HDRLoader().loadAsync('/models/' + task.environment)).texture;
  }
  const gl = renderer.getContext(), named = gl.getExtension('WEBGL_debug_renderer_info');
  return { renderer: gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER), version: 'three.js r' + THREE.REVISION };
};
const pixel = new Uint8Array(4);
const draw = () => {
  const gl = renderer.getContext();
  renderer.render(scene, camera);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  if (gl.getError() || gl.isContextLost()) throw new Error('WebGL failed');
};
window.frames_of = (count, turn = 0) => Array.from({ length: count }, () => {
  camera.position.sub(target).applyAxisAngle(camera.up, turn * Math.PI / 180).add(target);
  camera.lookAt(target);
  const begun = performance.now();
  draw();
  return performance.now() - begun;
});
window.picture = () => {
  draw();
  return renderer.domElement.toDataURL('image/png');
};
window.ready = true;
</script>`;

const roots = { '/three/': join(resolve(modules), 'three'), '/models/': resolve(folder) };
const server = createServer((request, answer) => {
  const name = decodeURIComponent(new URL(request.url, 'http://x').pathname);
  if (name === '/') return answer.writeHead(200, { 'content-type': 'text/html' }).end(PAGE);
  try {
    const root = Object.keys(roots).find((start) => name.startsWith(start));
    const path = resolve(roots[root], name.slice(root.length));
    if (!path.startsWith(roots[root] + sep)) throw new Error('outside');
    answer.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' }).end(readFileSync(path));
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const { chromium } = createRequire(join(resolve(modules), 'x'))('playwright-core');
const browser = await chromium.launch({ executablePath, headless: true, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'] });

let page, failed;
const commands = {
  async load(task) {
    await page?.close();
    page = await browser.newPage({ viewport: { width: task.size[0], height: task.size[1] } });
    failed = [];
    page.on('pageerror', (problem) => failed.push(problem.message));
    page.on('console', (message) => message.type() === 'error' && failed.push(message.text()));
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.waitForFunction(() => window.ready, undefined, { timeout: 30000 });
    const told = await page.evaluate((given) => window.load(given), task);
    await page.evaluate(() => window.frames_of(2)); // compiles shaders and uploads textures
    if (failed.length) throw new Error(failed.join('; '));
    return told;
  },
  frames: (task) => page.evaluate(([count, turn]) => window.frames_of(count, turn), [task.frames, task.turn ?? 0]),
  async save(task) {
    const url = await page.evaluate(() => window.picture());
    writeFileSync(task.save, Buffer.from(url.split(',')[1], 'base64'));
    return {};
  },
};
for await (const line of createInterface({ input: process.stdin })) {
  const task = JSON.parse(line), name = Object.keys(commands).find((key) => key in task);
  try {
    console.log(JSON.stringify(await commands[name](task)));
  } catch (problem) {
    console.log(JSON.stringify({ error: String(problem.message).split('\n')[0] }));
  }
}
await browser.close();
server.closeAllConnections();
server.close();
