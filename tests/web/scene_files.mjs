// scene_files.mjs: scene files in the page: their own options, surroundings and lights, and the files that they name. people.mjs runs these parts and
// shares its functions with them.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { commandOf, drawn, fragment, ok, pixels, settled, until } from './driver.mjs';

const LIGHTS = [{ type: 'point', name: 'desk', position: [2, 3, 4] }, { type: 'spot', position: [0, 3, 3], cutoff: 35, diffuse: [0.9, 0.6, 0.3] }];
const MIRROR = { reflectivity: [0.8, 0.8, 0.8] };
const scene = (more) => JSON.stringify({ lambent: 1, objects: [{ shape: 'sphere', material: MIRROR }], ...more });
const START = fragment(['teapot', '--size=96x96', '--background=white', '--material=ruby', '--light=point:position=1/1/1', '--environment=studio', '--shadows', '--view=left']);

async function opened(page, path) {
  await page.locator('#files').setInputFiles(path);
  await until(page, (name) => document.getElementById('model').value === name, `/${path.replace(/^.*\//, '')}`);
}

// A scene file describes its whole picture: the options of the model before it do not stay.
async function sceneOptions({ open, origin, models }) {
  const page = await open(origin + START);
  await drawn(page, 'the model before');
  writeFileSync(join(models, 'sized.json'), scene({ image: { size: [120, 90], background: '#8899aa' }, environment: { builtin: 'sky' } }));
  writeFileSync(join(models, 'unsized.json'), scene({ lights: LIGHTS }));
  await opened(page, join(models, 'sized.json'));
  await settled(page, 'a scene');
  ok((await commandOf(page)) === 'lambent sized.json', "a scene file opens without the last model's options", await commandOf(page));
  const reflecting = await pixels(page), surroundings = page.getByRole('group', { name: 'Surroundings' });
  ok((await surroundings.getByRole('button', { pressed: true }).textContent()) === 'Default', 'the surroundings of the scene are chosen');
  await surroundings.getByRole('button', { name: 'None' }).click();
  await settled(page, 'no surroundings');
  ok(/ --environment=none$/.test(await commandOf(page)) && (await pixels(page)) !== reflecting, 'None removes the surroundings of the scene', await commandOf(page));
  await page.getByRole('group', { name: 'Background' }).getByRole('button', { name: 'Transparent' }).click();
  await settled(page, 'no background');
  ok(/ --background=transparent$/.test(await commandOf(page)), "Transparent replaces the scene's background", await commandOf(page));
  await opened(page, join(models, 'unsized.json'));
  await settled(page, 'a scene without a size');
  const filling = await page.evaluate(() => [document.getElementById('canvas').width, document.getElementById('view').clientWidth]);
  ok(/^lambent unsized\.json --size=\d+x\d+$/.test(await commandOf(page)) && Math.abs(filling[0] - filling[1]) < 9, 'a scene without a size fills the window', `${filling} ${await commandOf(page)}`);
  await page.context().close();
}

// The lights of a scene file are listed, and have handles. Moving one writes them out, without another change.
async function sceneLights({ open, origin, models, said }) {
  const page = await open(origin + fragment(['teapot', '--size=96x96'])), handles = page.locator('.handle'), choice = page.getByLabel('The light to move');
  await drawn(page, 'the model before');
  const path = join(models, 'lit.json');
  writeFileSync(path, scene({ image: { size: [160, 120], background: '#8899aa' }, lights: LIGHTS }));
  await opened(page, path);
  await settled(page, 'a scene with lights');
  await until(page, () => document.querySelectorAll('.handle').length === 4);
  ok((await choice.locator('option').allTextContents()).join() === 'desk,spot 2' && (await commandOf(page)) === 'lambent lit.json', 'the lights of a scene are listed', await choice.innerText());
  await page.locator('#tab-lights').click();
  await until(page, () => document.querySelectorAll('.lights li').length === 2);
  await page.locator('#tab-quick').click();
  const before = await pixels(page);
  await page.getByRole('button', { name: 'Behind', exact: true }).click();
  await settled(page, 'behind');
  const command = await commandOf(page);
  ok(/--light=point:position=\S+,name=desk --light=spot:position=0\/3\/3,\S+$/.test(command) && (await pixels(page)) !== before && (await handles.count()) === 4, 'Behind moves the first light of the scene', command);
  ok((await page.locator('#panel-quick').getByRole('slider', { name: 'Around' }).inputValue()) === '180', 'the light is behind the model', command);
  await said(page);
  await page.locator('#undo').click();
  await settled(page, 'undone');
  await choice.selectOption('1');
  await page.locator('.handle.aim').focus();
  await page.keyboard.press('ArrowRight');
  await until(page, () => document.body.dataset.gesture === undefined);
  await settled(page, 'a handle');
  ok(/--light=point:position=2\/3\/4,name=desk --light=spot:position=0\/3\/3,direction=(?!0\/0\/-1)/.test(await commandOf(page)), 'a handle moves a light of the scene', await commandOf(page));
  await said(page);
  await page.locator('#tab-lights').click();
  for (const name of ['desk', 'spot 1']) await page.getByRole('button', { name: `Remove ${name}`, exact: true }).click();
  await settled(page, 'no lights');
  ok(/ --light=none /.test(`${await commandOf(page)} `) && (await page.locator('.lights li').count()) === 1, 'the lights of a scene stay away after the last one is removed', await commandOf(page));
  await page.getByRole('button', { name: 'Restore the lights' }).click();
  await settled(page, 'lights again');
  await until(page, () => document.querySelectorAll('.handle').length === 4);
  ok(!/--light/.test(await commandOf(page)), 'the lights of the scene are restored', await commandOf(page));
  await page.context().close();
}

// Missing files: the old picture disappears, the message lists the files once, and files that are open are used without a question.
async function sceneFiles({ open, origin, models }) {
  const page = await open(origin + fragment(['teapot', '--size=96x96', '--background=white'])), shows = (name) => page.locator(name).evaluate((one) => getComputedStyle(one).visibility);
  await drawn(page, 'the model before');
  const path = join(models, 'names_quad.json');
  writeFileSync(path, JSON.stringify({ lambent: 1, image: { size: [96, 96] }, objects: [{ file: 'quad.obj' }] }));
  await opened(page, path);
  await until(page, () => !document.getElementById('message').hidden);
  const sentence = await page.locator('#message-text').textContent();
  ok(sentence.split('quad.obj').length === 2 && /missing: quad\.obj\. Choose/.test(sentence), 'the message names a missing file once', sentence);
  ok((await shows('#canvas')) === 'hidden' && (await shows('#message')) === 'visible', 'the picture of the last model disappears');
  await page.locator('#undo').click();
  await settled(page, 'undone');
  await until(page, () => getComputedStyle(document.getElementById('canvas')).visibility === 'visible');
  ok((await shows('#canvas')) === 'visible', 'and is there again after undo');
  await page.locator('#files').setInputFiles(['quad.obj', 'quad.mtl', 'quad.jpg', 'side.png'].map((name) => join(models, 'textured', name)));
  await until(page, () => document.getElementById('model').value === '/quad.obj');
  await settled(page, 'the model');
  await opened(page, path);
  await settled(page, 'the scene of an open model');
  ok((await page.locator('#message').isHidden()) && (await page.locator('#missing').isHidden()) && (await page.locator('#warnings').textContent()) === '', 'a scene uses files that are open', await page.locator('#stage').innerText());
  await page.context().close();
}

// The controls show the settings of a scene file. A flag that the file sets cannot be removed.
async function sceneSettings({ open, origin, models }) {
  const page = await open(origin + fragment(['teapot', '--size=96x96'])), exposure = page.locator('#quick-exposure'), shadows = page.locator('#quick-shadows');
  await drawn(page, 'the model before');
  const path = join(models, 'set.json');
  writeFileSync(path, scene({ image: { size: [120, 90], exposure: 1.5, background: [0.5, 0.2, 0.1] }, shadows: true, shading: 'flat', ao: 'off', environment: { builtin: 'sky', rotation: 40 } }));
  await opened(page, path);
  await settled(page, 'a scene with settings');
  await until(page, () => document.getElementById('quick-exposure').value === '1.5');
  ok((await shadows.isChecked()) && (await shadows.isDisabled()), 'the shadows of a scene are shown');
  const shown = (name) => page.locator(`#quick-${name}`).evaluate((one) => one.selectedOptions?.[0].textContent ?? (one.value || one.placeholder));
  const texts = Object.fromEntries(await Promise.all(['shading', 'ao', 'size', 'background', 'environment-rotation'].map(async (name) => [name, await shown(name)])));
  ok(JSON.stringify(texts) === '{"shading":"(flat)","ao":"(off)","size":"120x90","background":"0.5/0.2/0.1","environment-rotation":"40"}', 'other settings of a scene are shown', JSON.stringify(texts));
  ok((await commandOf(page)) === 'lambent set.json', 'the settings of a scene are not written as options', await commandOf(page));
  await exposure.focus();
  await exposure.press('ArrowRight');
  await settled(page, 'exposure');
  ok((await commandOf(page)) === 'lambent set.json --exposure=1.6', "a slider starts at the scene's value", await commandOf(page));
  await page.locator('#undo').click();
  await settled(page, 'undone');
  await page.locator('#model').selectOption('cube');
  await settled(page, 'another model');
  ok((await exposure.inputValue()) === '0' && !(await shadows.isChecked()) && (await shadows.isEnabled()) && (await shown('shading')) !== '(flat)', 'another model has the defaults again');
  await page.context().close();
}

export const sceneParts = (shared) => ({ sceneSettings: () => sceneSettings(shared), sceneOptions: () => sceneOptions(shared), sceneLights: () => sceneLights(shared), sceneFiles: () => sceneFiles(shared) });
