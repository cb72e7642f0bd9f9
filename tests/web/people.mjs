// people.mjs PLAYWRIGHT BROWSER BUILD_WEB MODELS: tests typical situations: the data transferred before the first picture, slow drawings, missing
// files, links without files, small screens. It prints lines of the Test Anything Protocol without numbers, and commands with their pixels, like
// browser.mjs.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { commandOf, drawn, fragment, ok, pixels, settled, until, watchedPage } from './driver.mjs';
import { feedbackParts } from './feedback.mjs';
import { choose, fingers, isFirefoxPage } from './input.mjs';
import { newcomerParts } from './newcomer.mjs';
import { sceneParts } from './scene_files.mjs';
import { openBrowser } from './serve.mjs';

const [, , playwright, executablePath, built, models] = process.argv, FIRST_MAX = 300_000;
const { browser, origin, sent, close } = await openBrowser(playwright, executablePath, built), reports = [];
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const said = async (page, command) => console.log(`pixels ${JSON.stringify({ command: command ?? (await commandOf(page)), hash: await pixels(page) })}`);
const messageOf = (page) => page.locator('#message-text').textContent();
const go = (page, words) => page.evaluate((hash) => (location.hash = hash), fragment(words));
const open = async (address, options = {}) => {
  const page = await watchedPage(await browser.newContext({ viewport: { width: 1100, height: 800 }, ...options }), reports);
  await page.goto(address);
  return page;
};

// --- the transferred bytes before the first picture, without repeated downloads

async function firstPicture() {
  sent.length = 0; // of only this part
  const page = await watchedPage(await browser.newContext({ viewport: { width: 1330, height: 800 } }), reports);
  await page.addInitScript(() => new MutationObserver(() => (globalThis.firstDrawn ??= Date.now())).observe(document, { subtree: true, attributeFilter: ['data-drawn'] }));
  await page.addInitScript(() => new MutationObserver(() => (globalThis.hadPoster ||= document.getElementById('poster') !== null)).observe(document, { subtree: true, childList: true }));
  await page.goto(origin);
  await drawn(page, 'the first picture');
  const until_ms = await page.evaluate(() => globalThis.firstDrawn);
  const before = sent.filter(({ name, at }) => at < until_ms && name !== '/lambent-rest.wasm'), bytes = before.reduce((sum, one) => sum + one.bytes, 0);
  ok(bytes > 100_000 && bytes <= FIRST_MAX, `the first picture: ${bytes} bytes are sent before it, of ${FIRST_MAX}`, JSON.stringify(before));
  ok(!before.some(({ name }) => /offline|more|check|codemirror/.test(name)), 'the first picture: nothing else is asked for before it', JSON.stringify(before));
  const far = await page.evaluate(async () => {
    const poster = new Image(), canvas = document.getElementById('canvas'), room = document.getElementById('view'), one = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    if (!globalThis.hadPoster || document.getElementById('poster')) return NaN;
    poster.src = 'start.webp';
    await poster.decode();
    Object.assign(one.canvas, { width: 160, height: 100 });
    const rows = [poster, canvas].map((from) => {
      const k = Math.min(160 / room.clientWidth, 100 / room.clientHeight), scale = from === poster ? Math.min(room.clientWidth / poster.width, room.clientHeight / poster.height) * k : (canvas.clientWidth / canvas.width) * k;
      one.clearRect(0, 0, 160, 100);
      one.drawImage(from, 80 - (scale * from.width) / 2, 50 - (scale * from.height) / 2, scale * from.width, scale * from.height);
      return one.getImageData(0, 0, 160, 100).data;
    });
    return Math.sqrt(rows[0].reduce((sum, byte, i) => sum + (byte - rows[1][i]) ** 2, 0) / rows[0].length);
  });
  ok(far < 20, 'the first picture: until it is drawn, a stored picture like it is shown', `root mean square ${far}`);
  await page.evaluate(async () => {
    const { active, waiting, installing } = await navigator.serviceWorker.ready, worker = active ?? waiting ?? installing;
    if (worker.state !== 'activated') await new Promise((done) => (worker.onstatechange = () => worker.state === 'activated' && done()));
  });
  const large = sent.filter((one) => one.bytes > 20_000).map(({ name }) => name);
  ok(large.length === 3 && new Set(large).size === 3, 'without the server: no file is sent a second time to be stored', JSON.stringify(sent));
  const stored = await page.evaluate(async () => (await (await caches.open((await caches.keys())[0])).keys()).map((one) => one.url.replace(/^.*\//, '')));
  ok(stored.includes('lambent-rest.wasm') && !stored.some((name) => /check|codemirror|threads\.wasm/.test(name)), 'without the server: the tab of shaders is stored when it is used', stored.join(' '));
  await page.reload();
  await drawn(page, 'by the service worker');
  await page.locator('#tab-shaders').click();
  await until(page, async () => (await caches.match(new URL('check.wasm', location).href)) !== undefined);
  ok(true, 'without the server: a file that is used is stored');
  await page.context().close();
}

// --- slow drawings

const SLOW = ['torus-knot', '--size=1600x1200', '--ao=rays', '--samples=16'];

async function interrupted(address, label) {
  const page = await open(address + fragment(['sphere', '--size=96x96', '--background=white'])), isThreaded = address !== origin;
  await drawn(page, label);
  if (isThreaded) await until(page, () => Number(document.body.dataset.threads) > 1);
  const before = await pixels(page);
  await go(page, SLOW);
  await until(page, () => !document.getElementById('working').hidden && document.getElementById('progress').value > 0.5);
  await page.locator('#stop').click();
  const began = Date.now();
  await until(page, () => !document.getElementById('message').hidden);
  ok(Date.now() - began < 3000 && /stopped/.test(await messageOf(page)) && (await pixels(page)) === before, `${label}: Stop ends a drawing, and the picture stays`, `${Date.now() - began} ms: ${await messageOf(page)}`);
  await page.reload();
  await until(page, () => !document.getElementById('message').hidden);
  await pause(300);
  ok(/did not start it again/.test(await messageOf(page)) && (await page.locator('#working').isHidden()), `${label}: a page that is loaded again does not repeat it`, await messageOf(page));
  await page.locator('#message button').click();
  await until(page, () => !document.getElementById('working').hidden);
  const changed = Date.now();
  await go(page, ['cube', '--size=96x96', '--background=white']);
  await settled(page, label);
  ok(Date.now() - changed < 5000, `${label}: a drawing that is out of date ends`, `${Date.now() - changed} ms`);
  await said(page);
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  ok(true, `${label}: and the page goes on`);
  await page.context().close();
}

// Paths of light take long, so local lighting and a picture with few paths are shown before.
async function paths() {
  const page = await watchedPage(await browser.newContext({ viewport: { width: 1100, height: 800 } }), reports);
  await page.addInitScript(() => {
    const { prototype } = CanvasRenderingContext2D, put = prototype.putImageData;
    globalThis.shownPictures = 0;
    prototype.putImageData = function (...given) {
      if (this.canvas.id === 'canvas') globalThis.shownPictures++;
      return put.apply(this, given);
    };
  });
  await page.goto(origin + fragment(['sphere', '--size=120x96', '--background=white', '--bounces=2', '--paths=24']));
  await drawn(page, 'paths');
  const count = await page.evaluate(() => globalThis.shownPictures);
  ok(count === 3, 'paths of light: local lighting and few paths are shown before all paths', `${count} pictures`);
  await said(page);
  await page.context().close();
}

// --- files

async function files() {
  const page = await open(origin + fragment(['sphere', '--size=96x96', '--background=white'])), choose = (...names) => page.locator('#files').setInputFiles(names.map((name) => join(models, name)));
  await drawn(page, 'files');
  const model = async (path) => {
    await until(page, (name) => document.getElementById('model').value === name, path);
    await settled(page, path);
  };
  await choose('cube.ply');
  await model('/cube.ply');
  const first = await pixels(page);
  await choose('cube.obj', 'cube.mtl');
  await model('/cube.obj');
  const listed = await page.evaluate(() => [...document.getElementById('model').options].map((one) => one.value));
  ok(['/cube.ply', '/cube.obj', 'teapot'].every((name) => listed.includes(name)), 'opened files stay in the list', listed.join(' '));
  ok(await page.locator('#missing').isHidden(), 'nothing is missing where nothing is');
  await page.locator('#undo').click();
  await model('/cube.ply');
  ok((await pixels(page)) === first, 'undo over an opened file keeps the file before it');
  await page.locator('#redo').click();
  await model('/cube.obj');
  await said(page);

  // A model without its companions.
  const alone = await open(origin + fragment(['sphere', '--size=96x96', '--background=white']));
  await drawn(alone, 'alone');
  await alone.locator('#files').setInputFiles(join(models, 'textured/quad.obj'));
  await until(alone, () => !document.getElementById('missing').hidden);
  const asked = await alone.locator('#missing').textContent();
  ok(/missing: quad\.mtl\./.test(asked) && !(await alone.locator('#warnings').textContent()).includes('/quad'), 'a missing companion is asked for by its name', asked);
  await alone.locator('#files').setInputFiles(join(models, 'textured/quad.mtl'));
  await until(alone, () => /quad\.jpg/.test(document.getElementById('missing').textContent));
  ok(/quad\.jpg, side\.png|side\.png, quad\.jpg/.test(await alone.locator('#missing').textContent()), 'and then those that it names', await alone.locator('#missing').textContent());
  await alone.locator('#files').setInputFiles(['quad.jpg', 'side.png'].map((name) => join(models, 'textured', name)));
  await until(alone, () => document.getElementById('missing').hidden);
  await settled(alone, 'complete');
  await said(alone, (await commandOf(alone)).replace('quad.obj', 'textured/quad.obj'));
  ok((await alone.locator('#warnings').textContent()) === '', 'its warnings are gone with their reason', await alone.locator('#warnings').textContent());
  await alone.context().close();

  // A model whose buffer is missing is not drawn, and neither is a format that the page cannot read. The error messages name no
  // system package.
  mkdirSync(join(models, 'away'), { recursive: true });
  writeFileSync(join(models, 'away/part.gltf'), '{"asset":{"version":"2.0"},"buffers":[{"uri":"part.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}');
  await choose('away/part.gltf');
  await until(page, () => /missing: part\.bin\./.test(document.getElementById('message-text').textContent) && !document.getElementById('message').hidden);
  const bin = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  writeFileSync(join(models, 'away/part.bin'), bin);
  await choose('away/part.bin');
  await model('/part.gltf');
  ok(await page.locator('#missing').isHidden(), 'a model with its missing buffer is drawn');
  writeFileSync(join(models, 'away/broken.obj'), 'mtllib none.mtl\nv 0 0 0\nf 1 2 x\n');
  await choose('away/broken.obj');
  await until(page, () => /broken\.obj:3: a face names vertex '2'/.test(document.getElementById('message-text').textContent));
  ok(true, 'a damaged model says what is wrong, whatever else is missing');
  writeFileSync(join(models, 'away/thing.3mf'), Buffer.concat([Buffer.from('PK\x03\x04'), readFileSync(join(models, 'cube.ply'))]));
  await choose('away/thing.3mf');
  await until(page, () => /^thing\.3mf: /.test(document.getElementById('message-text').textContent)); // the page fetches the reader of 3MF first
  const sentence = await messageOf(page);
  ok(/^thing\.3mf: /.test(sentence) && !/Debian|package/.test(sentence), 'a sentence names the file without a slash, and no package', sentence);
  await choose('away/part.bin');
  await until(page, () => /no model among/.test(document.getElementById('message-text').textContent));
  ok(/\.3mf/.test(await messageOf(page)) && /\.gltf/.test(await messageOf(page)), 'the endings of models match the program', await messageOf(page));
  await page.context().close();
}

// Compressed files: the decoders are downloaded when such a file is opened.
async function compressed() {
  const corpus = new URL('../fuzz/corpus/gltf/', import.meta.url), damaged = JSON.parse(readFileSync(new URL('draco.gltf', corpus)));
  for (const name of ['draco', 'meshopt']) copyFileSync(new URL(`${name}.gltf`, corpus), join(models, `${name}.gltf`));
  const bytes = Buffer.from(damaged.buffers[0].uri.split(',')[1], 'base64').fill(255, 20, 60);
  damaged.buffers[0].uri = `data:application/octet-stream;base64,${bytes.toString('base64')}`;
  writeFileSync(join(models, 'damaged.gltf'), JSON.stringify(damaged));
  for (const [label, address] of [['served', origin], ['one file', pathToFileURL(join(built, 'lambent.html')).href]]) {
    const page = await open(address + fragment(['sphere', '--size=96x96', '--background=white']), { serviceWorkers: 'block' });
    await drawn(page, label);
    ok(label !== 'served' || !sent.some((one) => one.bytes && one.name.includes('decoders')), `${label}: no decoder is fetched before it is needed`);
    for (const name of ['draco.gltf', 'meshopt.gltf']) {
      await page.locator('#files').setInputFiles(join(models, name));
      await until(page, (path) => document.getElementById('model').value === path, `/${name}`);
      await settled(page, name);
      await said(page);
    }
    await page.locator('#files').setInputFiles(join(models, 'damaged.gltf'));
    await until(page, () => !document.getElementById('message').hidden);
    ok(/^damaged\.gltf: .*the compressed bytes are damaged/.test(await messageOf(page)), `${label}: damaged bytes are refused with their place`, await messageOf(page));
    await page.locator('#undo').click();
    await settled(page, 'after damaged bytes');
    await page.context().close();
  }
}

// A link to a local model.
async function links() {
  const camera = '--camera=eye=0/0/5,target=0/0/0,up=0/1/0,fovy=30', page = await open(origin + fragment(['/cube.ply', '--size=96x96', '--background=white', camera]));
  await until(page, () => !document.getElementById('message').hidden);
  ok(/needs cube\.ply\. Links contain no files/.test(await messageOf(page)) && (await page.locator('#missing').isHidden()), 'a link to a model of one\'s own says that it holds no files', await messageOf(page));
  await choose(page, () => page.getByRole('button', { name: 'Open it…' }).click(), join(models, 'cube.ply'));
  await drawn(page, 'of a link');
  ok((await commandOf(page)) === `lambent cube.ply --size=96x96 --background=white ${camera}`, 'and has its options once the file is opened', await commandOf(page));
  await said(page);
  await page.locator('#copy-link').click();
  ok(/contains no files\. Whoever opens it needs cube\.ply/.test(await page.locator('#status').textContent()), 'a copied link says so too', await page.locator('#status').textContent());
  await page.context().close();
}

// --- phones and tablets

async function screens() {
  for (const [width, height] of [[320, 640], [390, 844], [768, 1024]]) {
    const page = await open(origin, { viewport: { width, height }, hasTouch: true }), label = `${width} pixels wide`;
    await drawn(page, label);
    const box = (name) => page.locator(name).boundingBox(), canvas = await box('#canvas'), aside = await box('aside');
    ok(canvas.y < 40 && canvas.width >= (await page.evaluate(() => document.documentElement.clientWidth)) - 8 && aside.y > canvas.y + canvas.height - 1, `${label}: the picture is on top and fills the width`, JSON.stringify([canvas, aside]));
    ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${label}: nothing is wider`);
    const send = await fingers(page);
    const x = width / 2, y = canvas.y + canvas.height / 2;
    await send('touchStart', [x, y]);
    for (const step of [10, 20, 30]) await send('touchMove', [x + step, y]);
    await send('touchEnd');
    await settled(page, label);
    ok(/--camera=/.test(await commandOf(page)) && (await page.evaluate(() => scrollY)) === 0, `${label}: one finger turns`, await commandOf(page));
    const low = height - 30;
    await send('touchStart', [x, low]);
    for (let step = 1; step <= 10; step++) await send('touchMove', [x, low - 20 * step]);
    await send('touchEnd');
    if (isFirefoxPage(page)) await page.mouse.move(x, low).then(() => page.mouse.wheel(0, 200)); // touches of WebDriver do not scroll there
    await until(page, () => scrollY > 40);
    ok((await box('#canvas')).y < 40, `${label}: the page scrolls below the picture, which stays`, JSON.stringify(await box('#canvas')));
    await page.context().close();
  }
}

const parts = { firstPicture, stop: () => interrupted(origin, 'one thread'), stopThreads: () => interrupted(`${origin}isolated/`, 'threads'), paths, files, compressed, links, screens,
  ...newcomerParts({ open, origin, models, built, said }), ...feedbackParts({ open, origin, models, built }), ...sceneParts({ open, origin, models, said }) };
const only = process.env.LAMBENT_BROWSER?.split(',');
for (const [name, part] of Object.entries(parts)) {
  if (only && !only.includes(name)) continue;
  await part().then(() => ok(true, `${name} ran`), (error) => ok(false, name, error.stack));
}
ok(!reports.length, 'people: the browser reports no error, and the content-security policy refuses nothing', reports.join('\n'));
await close();
