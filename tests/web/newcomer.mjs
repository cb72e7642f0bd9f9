// newcomer.mjs: typical tasks of a user who has never seen the page: five tasks, each within five actions and without typing; the tabs of the picture
// and of the model; the window's size, and the browser's Back. people.mjs runs these parts and shares its functions with them.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { commandOf, drawn, fragment, ok, pixels, settled, until } from './driver.mjs';
import { choose, saved } from './input.mjs';

const MOST = 5;

// Simulates a user and counts the actions: clicks on named elements, and choosing files in the system's
// dialog.
class Hand {
  actions = 0;

  constructor(page) {
    this.page = page;
  }

  async click(role, name, within = 'body') {
    this.actions++;
    await this.page.locator(within).getByRole(role, { name, exact: true }).click();
  }

  async choose(button, files) {
    await choose(this.page, () => this.click('button', button), files);
    this.actions++;
  }

  // Returns the file that the browser downloads when a button is clicked.
  download(name) {
    return saved(this.page, () => this.click('button', name, 'dialog'));
  }

  done(task) {
    ok(this.actions <= MOST, `${task}: ${this.actions} actions`);
    this.actions = 0;
  }
}

const BEHIND = '--background=#8899aa'; // opaque: a PPM has no alpha

// The mean of red, green and blue over the pixels of the model.
const meanColor = (page) => page.evaluate(() => {
  const canvas = document.getElementById('canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height), sum = [0, 0, 0];
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if ((data[i] !== 0x88 || data[i + 1] !== 0x99 || data[i + 2] !== 0xaa) && ++count) for (const k of [0, 1, 2]) sum[k] += data[i + k];
  return sum.map((x) => Math.round(x / count));
});

async function tasks({ open, models, said }, address, label) {
  const page = await open(address + fragment(['teapot', '--size=480x360', BEHIND])), hand = new Hand(page), textured = (command) => command.replace('quad.obj', 'textured/quad.obj');
  await drawn(page, label);
  await hand.choose('Open files…', ['quad.obj', 'quad.mtl', 'quad.jpg', 'side.png'].map((name) => join(models, 'textured', name)));
  await until(page, () => document.getElementById('model').value === '/quad.obj');
  await settled(page, label);
  ok(await page.locator('#missing').isHidden(), `${label}: a model is open with its textures`);
  await said(page, textured(await commandOf(page)));
  hand.done(`${label}: open a model with its textures`);

  const before = await meanColor(page);
  await hand.click('button', 'gold');
  await settled(page, 'gold');
  const [red, green, blue] = await meanColor(page);
  ok(/ --material=gold,/.test(await commandOf(page)) && red > 1.1 * green && green > 1.5 * blue, `${label}: the model is of gold`, `${before} ${[red, green, blue]} ${await commandOf(page)}`);
  await said(page, textured(await commandOf(page)));
  hand.done(`${label}: make it gold`);

  await hand.click('button', 'Behind');
  await until(page, () => location.hash.includes('light'));
  await settled(page, 'behind');
  const [light] = /--light=\S+/.exec(await commandOf(page)) ?? [''];
  await until(page, () => document.querySelector('.handle')); // its script is fetched after the picture
  ok(await page.locator('.handle').first().isVisible(), `${label}: the light has a handle`, light);
  ok((await page.locator('#panel-quick').getByRole('slider', { name: 'Around' }).inputValue()) === '180', `${label}: the light is behind the model`, light);
  await said(page, textured(await commandOf(page)));
  hand.done(`${label}: move the light behind it`);

  await hand.click('button', 'Save and send…');
  await hand.click('radio', '2000 pixels');
  await hand.click('radio', 'White');
  const command = await page.locator('#save-command').textContent(), png = await hand.download('Save picture');
  ok(png.bytes.readUInt32BE(16) === 2000 && /--background=white/.test(command), `${label}: a picture of 2000 pixels is saved`, command);
  await until(page, () => /^Saved quad\.png: 2000×1500 pixels, background white$/.test(document.getElementById('status').textContent));
  const hash = createHash('sha256').update(png.bytes).digest('hex');
  console.log(`file ${JSON.stringify({ command: textured(command), hash })}`);
  hand.done(`${label}: save a 2000-pixel picture on white`);
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned after it');
  ok(await page.locator('#missing').isHidden(), `${label}: after saving, no file is missing`, await page.locator('#missing').textContent());
  await page.locator('#undo').click();
  await settled(page, 'turned back');

  const now = await pixels(page);
  await hand.click('button', 'Save and send…');
  const sent = await hand.download('Save a page with the model'), path = join(models, `sent-${label.replace(' ', '-')}.html`);
  hand.done(`${label}: send it to a colleague`);
  writeFileSync(path, sent.bytes);
  const other = await open(pathToFileURL(path).href);
  await drawn(other, 'what was sent');
  ok((await pixels(other)) === now && (await other.locator('#missing').isHidden()), `${label}: the colleague sees the same picture`, `${sent.name}: ${await commandOf(other)}`);
  await other.locator('#canvas').press('ArrowRight');
  await settled(other, 'what was sent, turned');
  ok((await pixels(other)) !== now, `${label}: and turns it`);
  await other.context().close();
  await page.context().close();
}

// --- the tab of the picture: each control writes its option

const CONTROLS = [
  ['button', 'Front', /--view=front$/], ['button', 'Isometric', /--view=iso$/], ['button', 'ruby', /--material=ruby$/], ['button', 'sky', /--environment=sky$/],
  ['button', 'technical', /--look=technical$/], ['button', 'Black', /--background=black /], ['button', 'Left', /--light=point:position=\S+$/, 'Where the light comes from'],
];
const SMALL = ['sphere', '--size=96x96', BEHIND, '--light=point:position=1r/1r/2r'];

// The slider that cuts the model: the section stays while the model turns, and one step of undo takes it away.
async function cutOpen(page) {
  const panel = page.locator('#panel-quick'), before = await commandOf(page), whole = await pixels(page);
  await panel.getByLabel('Axis of the cut').selectOption('z');
  const slider = panel.getByRole('slider', { name: 'Cut open' });
  await slider.focus();
  await slider.fill('50');
  await settled(page, 'cut');
  ok(/ --section=z=50%$/.test(await commandOf(page)) && (await pixels(page)) !== whole, 'control: the model is cut open', await commandOf(page));
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'cut and turned');
  const turned = await commandOf(page);
  await page.locator('#undo').click();
  await page.locator('#undo').click();
  await settled(page, 'whole again');
  ok(turned.includes('--section=z=50%') && (await commandOf(page)) === before, 'control: the cut stays while the model turns, and is one step of undo', `${turned}\n${await commandOf(page)}`);
  await page.locator('#redo').click();
  await settled(page, 'cut again');
}

async function controls({ open, origin, said }) {
  const page = await open(origin + fragment(SMALL));
  await drawn(page, 'controls');
  for (const [role, name, wanted, group] of CONTROLS) {
    const within = page.locator('#panel-quick');
    await (group ? within.getByRole('group', { name: group }) : within).getByRole(role, { name, exact: true }).first().click();
    await settled(page, name);
    ok(wanted.test(await commandOf(page)), `control: ${name}`, await commandOf(page));
    await said(page);
    await page.locator('#undo').click();
    await settled(page, `${name}, undone`);
  }
  await page.locator('#panel-quick').getByLabel('Colour', { exact: true }).last().fill('#336699');
  await settled(page, 'a colour');
  ok(/--color=#336699$/.test((await commandOf(page)).replaceAll("'", '')), 'control: a colour by the picker', await commandOf(page));
  await cutOpen(page);
  await said(page);
  await page.locator('#option-names').check();
  ok(await page.locator('#panel-quick label code', { hasText: /^color$/ }).isVisible(), "the options' own names are shown to those who want them");
  await page.locator('#panel-quick').getByRole('button', { name: 'Whole model' }).click();
  await until(page, () => [...document.querySelectorAll('.swatch canvas')].every((one) => one.width > 8 && one.getContext('2d').getImageData(one.width / 2, one.height / 2, 1, 1).data[3] === 255));
  ok(true, 'each choice has its picture');
  const stops = await page.evaluate(() => [...document.querySelectorAll('.swatches')].map((group) => group.querySelectorAll('.swatch[tabindex="0"]').length));
  ok(stops.length > 1 && stops.every((count) => count === 1), 'the Tab key reaches one choice of each group', stops.join(' '));
  const focused = () => page.evaluate(() => document.activeElement.title);
  await page.getByRole('group', { name: 'Material' }).first().locator('.swatch[tabindex="0"]').focus();
  const first = await focused();
  await page.keyboard.press('ArrowRight');
  const second = await focused();
  await page.keyboard.press('ArrowLeft');
  ok(second !== first && (await focused()) === first, 'the arrow keys move from choice to choice', `${first}, ${second}`);
  await page.context().close();
}

// --- the tab of the model

// A triangle that moves for two seconds.
function moving() {
  const numbers = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1, 0]), uri = `data:application/octet-stream;base64,${Buffer.from(numbers.buffer).toString('base64')}`;
  const accessor = (byteOffset, count, type, more = {}) => ({ bufferView: 0, byteOffset, componentType: 5126, count, type, ...more });
  return JSON.stringify({ asset: { version: '2.0' }, buffers: [{ uri, byteLength: 68 }], bufferViews: [{ buffer: 0, byteLength: 68 }],
    accessors: [accessor(0, 3, 'VEC3', { min: [0, 0, 0], max: [1, 1, 0] }), accessor(36, 2, 'SCALAR', { min: [0], max: [2] }), accessor(44, 2, 'VEC3')],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
    animations: [{ name: 'up', samplers: [{ input: 1, output: 2 }], channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }] }] });
}

async function contents({ open, origin, models, said }) {
  const page = await open(origin + fragment(SMALL)), spot = new URL('../../examples/models/spot.glb', import.meta.url);
  await drawn(page, 'contents');
  writeFileSync(join(models, 'spot.glb'), readFileSync(spot));
  await page.locator('#files').setInputFiles(join(models, 'spot.glb'));
  await until(page, () => document.getElementById('model').value === '/spot.glb');
  await settled(page, 'contents');
  await page.locator('#tab-contents').click();
  await until(page, () => document.querySelector('#panel-contents .measures'));
  const text = await page.locator('#panel-contents').innerText();
  ok(/0\.943 × 1\.69 × 1\.718 m/.test(text) && /943\.1 × 1,690 × 1,718 mm/.test(text) && /glazed\s+metallic 0, roughness 0\.6/.test(text), 'the tab of the model has its size with the unit, its objects and materials', text);
  for (const name of ['spot', 'glazed']) {
    await page.getByRole('checkbox', { name: `Show ${name}` }).uncheck();
    await settled(page, `without ${name}`);
    const isEmpty = await page.evaluate(() => {
      const canvas = document.getElementById('canvas');
      return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.every((byte, i) => byte === [0x88, 0x99, 0xaa, 255][i % 4]);
    });
    ok(new RegExp(`--hide=${name}$`).test(await commandOf(page)) && isEmpty, `${name} is hidden`, await commandOf(page));
    await page.getByRole('checkbox', { name: `Show ${name}` }).check();
    await settled(page, `with ${name}`);
  }
  await page.getByLabel('Colour of glazed').fill('#3366ff');
  await settled(page, 'a colour of a material');
  ok(/--material=color=#3366ff@glazed$/.test((await commandOf(page)).replaceAll("'", '')), 'a material has another colour', await commandOf(page));
  await said(page);

  writeFileSync(join(models, 'moving.gltf'), moving());
  await page.locator('#files').setInputFiles(join(models, 'moving.gltf'));
  await until(page, () => document.getElementById('model').value === '/moving.gltf' && document.querySelector('#panel-contents [type=range]'));
  ok(!/@|hide/.test(await commandOf(page)), 'what names objects of one model leaves with it', await commandOf(page));
  await page.getByRole('slider', { name: 'Time (s)' }).press('ArrowRight');
  await settled(page, 'the time line');
  ok(/--time=0\.01$/.test(await commandOf(page)), 'an animation stands at the time of its slider', await commandOf(page));
  await page.getByRole('button', { name: 'Play' }).click();
  await until(page, () => Number(document.querySelector('#panel-contents [type=range]').value) > 0.05);
  await page.getByRole('button', { name: 'Pause' }).click();
  await settled(page, 'paused');
  await said(page);
  await page.locator('#undo').click();
  await settled(page, 'undone');
  ok(/--time=0\.01$/.test(await commandOf(page)), 'playing is one step of undo', await commandOf(page));
  await page.context().close();
}

// --- the window and its history

async function windows({ open, origin }) {
  const page = await open(origin), sizeOf = async () => /--size=(\d+)x(\d+)/.exec(await commandOf(page)).slice(1).map(Number);
  await drawn(page, 'the window');
  const [before] = await sizeOf();
  await page.setViewportSize({ width: 1300, height: 800 });
  await until(page, (width) => Number(/size%3D(\d+)/.exec(location.hash)[1]) > width, before + 150);
  await drawn(page, 'a wider window');
  ok((await sizeOf())[0] === before + 200 && (await page.locator('#undo').isDisabled()), 'the picture follows the window', String(await sizeOf()));
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned');
  const turned = await commandOf(page);
  await page.goBack();
  await settled(page, 'back');
  ok(!/--camera/.test(await commandOf(page)), "Back leads to the picture as it was opened", await commandOf(page));
  await page.goForward();
  await settled(page, 'forward');
  ok((await commandOf(page)) === turned, 'and Forward to the work', await commandOf(page));
  await page.context().close();

  // A message appears over the picture, and keeps the list of missing files readable.
  for (const width of [320, 1280]) {
    const small = await open(origin, { viewport: { width, height: 640 } });
    await drawn(small, 'small');
    await small.locator('#files').setInputFiles({ name: 'alone.obj', mimeType: 'text/plain', buffer: Buffer.from('mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n') });
    await until(small, () => !document.getElementById('missing').hidden);
    await small.locator('#files').setInputFiles({ name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('no model') });
    await until(small, () => !document.getElementById('message').hidden);
    const [message, missing] = await Promise.all(['#message', '#missing'].map((name) => small.locator(name).boundingBox()));
    ok(message.y + message.height <= missing.y && message.y >= 0, `${width} pixels wide: a message does not cover the missing files`, JSON.stringify([message, missing]));
    await small.context().close();
  }
}

export const newcomerParts = (shared) => ({
  newcomer: () => tasks(shared, shared.origin, 'served'),
  newcomerOneFile: () => tasks(shared, pathToFileURL(join(shared.built, 'lambent.html')).href, 'one file'),
  peopleControls: () => controls(shared),
  contents: () => contents(shared),
  windows: () => windows(shared),
});
