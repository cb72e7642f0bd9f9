// feedback.mjs: how the page answers: files that belong together, controls that stay in place, the message after saving, before and now, and a light's
// handle outside the picture. people.mjs runs these parts and shares its functions with them.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { commandOf, drawn, fragment, ok, pixels, settled, until } from './driver.mjs';
import { choose, drop, isFirefoxPage, saved } from './input.mjs';

const WORDS = ['sphere', '--size=96x96', '--background=white'];
const boxOf = (page, name) => page.locator(name).boundingBox();
const model = async (page, path) => {
  await until(page, (name) => document.getElementById('model').value === name, path);
  await settled(page, path);
};

// WebDriver BiDi cannot choose a folder; there it is dropped.
const openFolder = (page, path) => (isFirefoxPage(page) ? drop(page, path) : page.locator('#folder').setInputFiles(path));

// A saved scene file, and then the folder with its model: the scene stays, with its size.
async function scenes({ open, origin, models }) {
  const page = await open(origin + fragment(WORDS));
  await drawn(page, 'scenes');
  await openFolder(page, join(models, 'textured'));
  await model(page, '/textured/damaged.obj');
  await page.locator('#model').selectOption('/textured/quad.obj');
  await model(page, '/textured/quad.obj');
  await page.evaluate((hash) => (location.hash = hash), fragment(['/textured/quad.obj', '--size=200x100', '--background=white', '--view=left']));
  await settled(page, 'the scene');
  const before = await pixels(page);
  await page.locator('#export').click();
  const { name, bytes } = await saved(page, () => page.locator('#save-scene').click());
  writeFileSync(join(models, name), bytes);
  await page.context().close();

  const other = await open(origin);
  await drawn(other, 'a scene alone');
  await other.locator('#files').setInputFiles(join(models, name));
  await until(other, () => !document.getElementById('message').hidden);
  const sentence = await other.locator('#message-text').textContent();
  ok(/missing: textured\/quad\.obj\./.test(sentence) && !/No such file/.test(sentence), 'a scene without its model asks for the model', sentence);
  await openFolder(other, join(models, 'textured'));
  await model(other, '/quad.json');
  ok((await other.locator('#message').isHidden()) && (await other.locator('#missing').isHidden()), 'the folder completes the scene', await other.locator('#stage').innerText());
  ok((await pixels(other)) === before && (await commandOf(other)) === 'lambent quad.json', 'the scene is the saved picture, with its size', await commandOf(other));
  const { width, height } = await boxOf(other, '#canvas');
  await other.locator('#canvas').press('ArrowRight');
  await until(other, () => document.body.dataset.gesture === undefined);
  const turned = await boxOf(other, '#canvas');
  ok(turned.width === width && turned.height === height, 'a scene with its own size keeps its shape while it turns', JSON.stringify(turned));
  await other.context().close();
}

// A material file and its textures, chosen at once, complete the model at once.
async function companions({ open, origin, models }) {
  const page = await open(origin + fragment(WORDS));
  await drawn(page, 'companions');
  await page.locator('#files').setInputFiles(join(models, 'textured/quad.obj'));
  await until(page, () => !document.getElementById('missing').hidden);
  ok((await page.locator('#warnings').textContent()) === '', 'only one message asks for a missing file', await page.locator('#warnings').textContent());
  await page.locator('#files').setInputFiles(['quad.mtl', 'quad.jpg', 'side.png'].map((name) => join(models, 'textured', name)));
  await until(page, () => document.getElementById('missing').hidden && document.getElementById('warnings').textContent === '');
  await settled(page, 'companions');
  ok((await commandOf(page)).startsWith('lambent quad.obj'), 'materials and textures are taken at once', await commandOf(page));

  // Missing files together with another model: they open that model, unless they were chosen by the button of the message.
  await page.locator('#files').setInputFiles({ name: 'alone.obj', mimeType: 'text/plain', buffer: Buffer.from('mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl photo\nf 1/1 2/1 3/1\n') });
  await until(page, () => document.getElementById('model').value === '/alone.obj' && !document.getElementById('missing').hidden);
  const textured = ['quad.obj', 'quad.mtl', 'quad.jpg', 'side.png'].map((name) => join(models, 'textured', name));
  await page.locator('#files').setInputFiles(textured);
  await model(page, '/quad.obj');
  await page.locator('#model').selectOption('/alone.obj');
  await until(page, () => document.getElementById('model').value === '/alone.obj' && !document.getElementById('missing').hidden);
  await choose(page, () => page.locator('#missing').getByRole('button', { name: 'Choose files…' }).click(), textured);
  await until(page, () => document.getElementById('missing').hidden);
  await settled(page, 'an answer');
  ok((await commandOf(page)).startsWith('lambent alone.obj'), 'another model is opened, except in answer to the question for files', await commandOf(page));
  await page.context().close();
}

// Controls stay under the pointer, and say what they did.
async function places({ open, origin }) {
  const page = await open(origin + fragment(['teapot', '--size=480x360', '--background=white']), { viewport: { width: 1280, height: 800 } });
  await drawn(page, 'places');
  const behind = page.getByRole('button', { name: 'Behind', exact: true });
  await behind.scrollIntoViewIfNeeded();
  const before = await behind.boundingBox(), canvas = await boxOf(page, '#canvas');
  await behind.click();
  await until(page, () => location.hash.includes('light'));
  await settled(page, 'behind');
  const after = await behind.boundingBox(), now = await boxOf(page, '#canvas');
  ok(before.x === after.x && before.y === after.y, 'the button stays under the pointer', JSON.stringify([before, after]));
  const names = async (on) => (await on.getByLabel('The light to move').locator('option').allTextContents()).join();
  ok((await names(page)) === 'Main light,Fill light' && /name=key.*name=fill/.test(await commandOf(page)), 'the lights of a curved model have plain names', await names(page));
  const flat = await open(origin + fragment(['cube', '--size=96x96']));
  await drawn(flat, 'a cube');
  await flat.getByRole('button', { name: 'Behind', exact: true }).click();
  await until(flat, () => location.hash.includes('light'));
  await settled(flat, 'a cube from behind');
  ok((await names(flat)) === 'Main light,Fill light,Light from behind' && /name=key.*name=fill.*name=rim/.test(await commandOf(flat)), 'the lights of a cube have plain names', await names(flat));
  await flat.context().close();
  ok((await page.locator('[aria-pressed=true]', { hasText: /^(From the front|Left|Right|Above|Behind)$/ }).allTextContents()).join() === 'Behind', 'the chosen direction is marked');
  ok(JSON.stringify(canvas) === JSON.stringify(now), 'a longer command line leaves the picture in place', JSON.stringify([canvas, now]));
  await page.getByRole('button', { name: 'gold', exact: true }).click();
  await settled(page, 'gold');
  const grown = await page.evaluate(() => {
    const working = document.getElementById('working'), height = () => document.getElementById('view').clientHeight, idle = height();
    working.hidden = false;
    const busy = height();
    working.hidden = true;
    return busy - idle;
  });
  ok(grown === 0, 'progress and Stop leave the picture in place', `${grown} pixels`);
  const save = await boxOf(page, '#save');
  await saved(page, () => page.locator('#save').click());
  await until(page, () => /^Saved/.test(document.getElementById('status').textContent));
  ok((await page.locator('#status').textContent()) === 'Saved teapot.png: 480×360 pixels, background white', 'the message names size and background', await page.locator('#status').textContent());
  ok(JSON.stringify([save, now]) === JSON.stringify([await boxOf(page, '#save'), await boxOf(page, '#canvas')]), 'saving moves nothing');

  // Before and now: the picture before the last change, until Escape.
  const gold = await pixels(page);
  await page.getByRole('button', { name: 'ruby', exact: true }).click();
  await settled(page, 'ruby');
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'ruby, turned');
  await page.locator('#compare').click();
  await until(page, () => document.getElementById('before')?.dataset.drawn);
  const words = JSON.parse(await page.locator('#before').getAttribute('data-drawn'));
  ok(words.some((word) => word.startsWith('--material=gold')) && words.some((word) => word.startsWith('--camera')) && (await pixels(page, 'before')) !== gold, 'before is the state before the last change, from the present side', words.join(' '));
  await page.keyboard.press('Escape');
  ok((await page.locator('#divider').count()) === 0 && (await page.locator('#compare').getAttribute('aria-pressed')) === 'false', 'Escape ends before and now');
  await page.context().close();
}

// Before and now without a change: the sentence is about the state, also after the next change. Lines of commands break between words.
async function compared({ open, origin }) {
  const page = await open(origin, { viewport: { width: 1280, height: 800 } });
  await drawn(page, 'compared');
  await page.locator('#compare').click();
  const title = page.locator('#split-bar > span');
  await until(page, () => document.getElementById('before')?.dataset.drawn);
  ok(/^Nothing has changed yet/.test(await title.textContent()), 'before and now: nothing has changed yet', await title.textContent());
  await page.getByRole('button', { name: 'ruby', exact: true }).click();
  await settled(page, 'ruby');
  ok((await title.textContent()) === 'Left, before:', 'before and now: after a change, the left side is the state before it', await title.textContent());
  for (const id of ['command', 'before-command']) {
    const broken = await page.locator(`#${id} span`).evaluateAll((words) => words.filter((word) => word.getClientRects().length > 1).map((word) => word.textContent));
    ok((await page.locator(`#${id} span`).count()) > 3 && !broken.length, `#${id}: lines break between words`, broken.join(' '));
  }
  await page.context().close();
}

// Metals: the surroundings leave with the metal and turn with the light; the colour field shows the colour of a named material.
async function metals({ open, origin, models }) {
  const page = await open(origin + fragment(['sphere', '--size=96x96', '--background=white'])), choose = (name) => page.getByRole('button', { name, exact: true }).click().then(() => settled(page, name));
  const color = page.locator('#panel-quick').getByLabel('Colour', { exact: true }).last();
  await drawn(page, 'metals');
  await choose('gold');
  ok(/--environment=studio$/.test(await commandOf(page)) && (await color.inputValue()) === '#ffe59e', 'gold reflects the studio, and the colour field is golden', `${await color.inputValue()} ${await commandOf(page)}`);
  const gold = await page.evaluate(brightness);
  await page.getByRole('button', { name: 'Behind', exact: true }).click();
  await until(page, () => location.hash.includes('light'));
  await settled(page, 'behind');
  const behind = await page.evaluate(brightness), changed = gold.filter((x, i) => Math.abs(x - behind[i]) > 16).length / gold.filter((x) => x < 255).length;
  ok(changed > 0.2, 'Behind is visible on gold', `${changed} ${await commandOf(page)}`);
  await choose('ruby');
  ok(!/environment/.test(await commandOf(page)) && (await color.inputValue()) === '#9d0b0b', 'another material removes the studio, and has its colour', `${await color.inputValue()} ${await commandOf(page)}`);
  await page.context().close();

  // After a reload, an opened file is gone. The materials still have their pictures.
  const other = await open(origin + fragment(['sphere', '--size=96x96']));
  await drawn(other, 'before a reload');
  await other.locator('#files').setInputFiles(join(models, 'cube.ply'));
  await until(other, () => location.hash.includes('cube.ply'));
  await settled(other, 'a file');
  await other.reload();
  await until(other, () => !document.getElementById('message').hidden);
  ok(/needs cube\.ply\. .* a page forgets them when it is loaded again/.test(await other.locator('#message-text').textContent()), 'a reloaded page asks for its file', await other.locator('#message-text').textContent());
  await until(other, () => document.querySelectorAll('.swatch canvas').length > 20 && [...document.querySelectorAll('.swatch canvas')].every((one) => one.width > 8));
  ok(true, 'a reloaded page draws the pictures of its materials');
  await other.evaluate((hash) => (location.hash = hash), fragment(['/cube.ply', '--size=96x96', '--light=point:position=1/2/3']));
  await until(other, () => document.getElementById('command').textContent.includes('--light'));
  await other.getByRole('button', { name: 'gold', exact: true }).click();
  await until(other, () => document.getElementById('command').textContent.endsWith(' --environment=studio'));
  ok(true, 'a metal can be chosen before there is a picture');
  await other.context().close();
}

function brightness() {
  const canvas = document.getElementById('canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return Array.from({ length: data.length / 4 }, (_, i) => (data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 3);
}

// A page that was sent fills the window of the receiver, if the picture filled the window of the sender.
async function sent({ open, origin, models }) {
  const page = await open(origin, { viewport: { width: 1280, height: 800 } });
  await drawn(page, 'the sender');
  await page.locator('#export').click();
  const { bytes } = await saved(page, () => page.locator('#save-page').click()), path = join(models, 'sent-phone.html');
  writeFileSync(path, bytes);
  await until(page, () => /^Saved teapot\.html/.test(document.getElementById('status').textContent));
  await page.context().close();
  const phone = await open(pathToFileURL(path).href, { viewport: { width: 390, height: 844 }, hasTouch: true });
  await drawn(phone, 'the receiver');
  const canvas = await boxOf(phone, '#canvas'), stage = await boxOf(phone, '#view');
  ok(stage.width - canvas.width < 9 && stage.height - canvas.height < 9, 'a sent page fills the window of a phone', JSON.stringify([canvas, stage]));
  await phone.context().close();
}

// The handle of a light outside the picture follows the pointer.
async function farLights({ open, origin }) {
  for (const light of ['directional:direction=1/0/0.02', 'point:position=-9/2/0', 'point:position=0/3/30']) {
    const page = await open(origin + fragment(['sphere', '--size=200x200', '--view=front', '--zoom=1.6', `--light=${light}`]));
    await drawn(page, light);
    const handle = page.locator('.handle.position');
    await until(page, () => document.querySelector('.handle.position.out'));
    const from = await handle.boundingBox(), canvas = await boxOf(page, '#canvas'), start = [from.x + from.width / 2, from.y + from.height / 2];
    const to = [canvas.x + 0.6 * canvas.width, canvas.y + 0.4 * canvas.height];
    await page.mouse.move(...start);
    await page.mouse.down();
    for (const part of [0.2, 0.6, 1]) await page.mouse.move(...start.map((x, i) => x + part * (to[i] - x)));
    await page.mouse.up();
    await settled(page, light);
    const end = await handle.boundingBox(), away = Math.hypot(end.x + end.width / 2 - to[0], end.y + end.height / 2 - to[1]);
    ok(away < 3, `a handle outside the picture follows the pointer: ${light}`, `${away} pixels away: ${await commandOf(page)}`);
    await page.context().close();
  }
}

export const feedbackParts = (shared) => ({ scenes: () => scenes(shared), companions: () => companions(shared), places: () => places(shared), compared: () => compared(shared),
  metals: () => metals(shared), sent: () => sent(shared), farLights: () => farLights(shared) });
