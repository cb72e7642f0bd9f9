// browser.mjs PLAYWRIGHT BROWSER BUILD_WEB MODELS SEQUENCES: tests the page in a browser with pointers, keys and drops. It prints lines of the Test
// Anything Protocol without numbers, and for each random sequence of gestures "pixels {command, hash}": the command that the page copies, and the
// SHA-256 of the canvas' colours; the caller (browser.py) draws that command with the program. The file has more than 600 lines because it contains
// one test for each user action, in one browser, which takes seconds to start.
import { createHash } from 'node:crypto';
import { truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { commandOf, drawn, fragment, ok, pixels, same, settled, until, watchedPage } from './driver.mjs';
import { drop, fingers, saved } from './input.mjs';
import { isFirefox, openBrowser } from './serve.mjs';

const [, , playwright, executablePath, built, models, sequences] = process.argv, all = Number(sequences) > 3; // all cases, in make test-long
const { browser, origin, close } = await openBrowser(playwright, executablePath, built);
const context = await browser.newContext({ viewport: { width: 1100, height: 800 }, permissions: isFirefox(executablePath) ? [] : ['clipboard-read', 'clipboard-write'] });

// The browser's reports about the page: errors, and everything that its content security policy has refused.
const reports = [];
async function openPage(address, where = context) {
  const page = await watchedPage(where, reports);
  await page.goto(address);
  return page;
}

const undoIn = (page) => page.locator('#undo').click();

// The tab with all options, with the options that a search text finds.
async function find(page, words) {
  await page.locator('#tab-options').click();
  await page.locator('#search').fill(words);
}

async function start(words, where) {
  const page = await openPage(origin + fragment(words), where);
  await drawn(page, 'start');
  return page;
}

async function drag(page, from, by, { key = null, button = 'left' } = {}) {
  if (key) await page.keyboard.down(key);
  await page.mouse.move(...from);
  await page.mouse.down({ button });
  await page.mouse.move(from[0] + by[0] / 2, from[1] + by[1] / 2);
  await page.mouse.move(from[0] + by[0], from[1] + by[1]);
  await page.mouse.up({ button });
  if (key) await page.keyboard.up(key);
}

async function middle(page) {
  const box = await page.locator('#canvas').boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2, width: box.width, height: box.height };
}

// --- each gesture changes the command line as listed in this table. Numbers are within 0.002.

const CAMERA = '--camera=eye=0/0/5,target=0/0/0,up=0/1/0,fovy=30', START = ['sphere', '--size=120x120', CAMERA];
const side = 5 * Math.sin(Math.PI / 24), depth = 5 * Math.cos(Math.PI / 24), step = 0.05 * 10 * Math.tan(Math.PI / 12);
const key = (name) => (page) => page.locator('#canvas').press(name);
const camera = (...eye) => ({ eye, target: [0, 0, 0] });
const GESTURES = [
  ['ArrowRight', key('ArrowRight'), camera(side, 0, depth)],
  ['ArrowLeft', key('ArrowLeft'), camera(-side, 0, depth)],
  ['ArrowUp', key('ArrowUp'), camera(0, side, depth)],
  ['ArrowDown', key('ArrowDown'), camera(0, -side, depth)],
  ['Shift+ArrowRight', key('Shift+ArrowRight'), { eye: [-step, 0, 5], target: [-step, 0, 0] }],
  ['Shift+ArrowUp', key('Shift+ArrowUp'), { eye: [0, -step, 5], target: [0, -step, 0] }],
  ['+', key('+'), camera(0, 0, 5 / 1.15)],
  ['-', key('-'), camera(0, 0, 5 * 1.15)],
  ['wheel', async (page) => {
    const at = await middle(page);
    await page.mouse.move(at.x, at.y);
    await page.mouse.wheel(0, -100);
  }, camera(0, 0, 5 * Math.exp(-0.15))],
  ['drag right by half the height', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [at.height / 2, 0]);
  }, camera(-5, 0, 0)],
  ['drag down by a quarter of the height', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [0, at.height / 4]);
  }, camera(0, 5 * Math.sin(Math.PI / 4), 5 * Math.cos(Math.PI / 4))],
  ['Shift and drag right by a tenth', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [at.height / 10, 0], { key: 'Shift' });
  }, { eye: [-2 * step, 0, 5], target: [-2 * step, 0, 0] }],
  ['Shift and drag down by a tenth', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [0, at.height / 10], { key: 'Shift' });
  }, { eye: [0, 2 * step, 5], target: [0, 2 * step, 0] }],
  ['Ctrl and drag right by half the height, without an environment', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [at.height / 2, 0], { key: 'Control' });
  }, camera(-5, 0, 0)],
  ['Home', key('Home'), null],
];

const cameraOf = (text) => {
  const found = /--camera=(\S+)/.exec(text);
  return found && Object.fromEntries(found[1].split(',').map((part) => part.split('=')).map(([name, value]) => [name, value.split('/').map(Number)]));
};
const NEAR = isFirefox(executablePath) ? 0.005 : 0.002; // Firefox moves the pointer by whole pixels
const near = (a, b) => a?.length === b.length && a.every((x, i) => Math.abs(x - b[i]) < NEAR);

async function gestures() {
  const page = await start(START);
  for (const [label, act, wanted] of GESTURES) {
    await act(page);
    await settled(page, label);
    const text = await commandOf(page), found = cameraOf(text);
    const good = wanted ? found && near(found.eye, wanted.eye) && near(found.target, wanted.target) && near(found.fovy, [30]) : !found;
    ok(good && text.startsWith('lambent sphere --size=120x120'), `gesture: ${label}`, text);
    await undoIn(page);
    ok((await commandOf(page)) === ['lambent', ...START].join(' '), `gesture: ${label}, undone at once`, await commandOf(page));
    await settled(page, `undo ${label}`); // the next gesture starts from the visible picture
    if (!all && label !== 'wheel') continue;
    await page.locator('#redo').click();
    await settled(page, `redo ${label}`);
    ok((await commandOf(page)) === text, `gesture: ${label}, and redone`, await commandOf(page));
    await undoIn(page);
    await settled(page, `undo ${label}`);
  }
  await page.close();
}

// Each of these changes the initial command line to the listed one. '' means no change.
const handle = (part) => (page) => page.locator(`.handle.${part}`);
const press = (find, name) => async (page) => find(page).press(name);
const dragHandle = (part, right, up, shift = false) => async (page) => {
  const box = await handle(part)(page).boundingBox(), at = await middle(page);
  await drag(page, [box.x + 22, box.y + 22], [right * at.height, -up * at.height], { key: shift && 'Shift' });
};
const inTab = (tab, act) => async (page) => {
  await page.locator(`#tab-${tab}`).click();
  await act(page);
};
const click = (name) => (page) => page.getByRole('button', { name, exact: true }).click();
const slide = (name, key) => (page) => page.getByRole('slider', { name }).press(key);
const POINT = '--light=point:position=0/0/0', SPOT = '--light=spot:position=0/1/0,target=0/0/0,cutoff=20', SUN = '--light=directional:direction=0/0/-1';
const WORDS = [
  ['handle of a light: ArrowRight', POINT, press(handle('position'), 'ArrowRight'), '--light=point:position=0.0804/0/0'],
  ['handle of a light: Shift+ArrowUp', POINT, press(handle('position'), 'Shift+ArrowUp'), '--light=point:position=0/0.0134/0'],
  ['handle of a light: PageUp', POINT, press(handle('position'), 'PageUp'), '--light=point:position=0/0/-0.0804'],
  ['handle of a light: dragged right by a quarter of the height', POINT, dragHandle('position', 0.25, 0), /--light=point:position=0\.6(69|70)\d*\/0\/0$/],
  ['handle of a light: Shift and dragged up by a quarter', POINT, dragHandle('position', 0, 0.25, true), /--light=point:position=0\/0\/-0\.6\d+$/],
  ['handle of a light: Delete', POINT, press(handle('position'), 'Delete'), '--light=none'],
  ['handle of a spot: where it aims', SPOT, press(handle('aim'), 'ArrowRight'), '--light=spot:position=0/1/0,target=0.0804/0/0,cutoff=20'],
  ['handle of a spot: the edge of its cone', SPOT, press(handle('cone'), 'ArrowRight'), '--light=spot:position=0/1/0,target=0/0/0,cutoff=22'],
  ['handle of a directional light: ArrowRight', SUN, press(handle('position'), 'ArrowRight'), /--light=directional:direction=-0\.0\d+\/0\/-0\.99\d+$/],
  ['button: a point light', null, inTab('lights', click('Add a point light')), '--light=+point:position=-1r/1r/1.2r'],
  ['button: a spot', POINT, inTab('lights', click('Add a spot')), `${POINT} --light=spot:position=0.6r/1.4r/1.2r,cutoff=25`],
  ['button: a directional light', null, inTab('lights', click('Add a directional light')), '--light=+directional:direction=1/-1/-0.5'],
  ['button: the last light is removed', POINT, inTab('lights', click('Remove point 1')), '--light=none'],
  ['button: an added light is removed', '--light=+point:position=1r/1r/1r', inTab('lights', click('Remove point 1')), null],
  ['button: the removed lights are restored', '--light=none', inTab('lights', click('Restore the lights')), null],
  ['button: a point light in place of none', '--light=none', inTab('lights', click('Add a point light')), '--light=point:position=-1r/1r/1.2r'],
  ['slider: intensity', POINT, inTab('lights', slide('intensity of point 1', 'ArrowRight')), `${POINT},intensity=1.05`],
  ['slider: attenuation', POINT, inTab('lights', slide('attenuation c of point 1', 'ArrowRight')), `${POINT},attenuation=1/0/0.01`],
  ['slider: cone', SPOT, inTab('lights', slide('cutoff of spot 1', 'ArrowLeft')), '--light=spot:position=0/1/0,target=0/0/0,cutoff=19'],
  ['slider: shininess', POINT, inTab('lights', slide('Shininess of the highlights', 'ArrowRight')), `${POINT} --shininess=33.1`],
  ['choice: reflection', null, inTab('quick', (page) => page.locator('#quick-reflection').selectOption('phong')), '--reflection=phong'],
  ['choice: a term', null, inTab('quick', (page) => page.locator('#quick-show').selectOption('diffuse')), '--show=diffuse'],
  ['switch: wireframe', null, inTab('quick', (page) => page.locator('#quick-wireframe').check()), '--wireframe'],
  ['Ctrl and drag right by a tenth: surroundings', '--environment=studio', async (page) => {
    const at = await middle(page);
    await drag(page, [at.x, at.y], [at.height / 10, 0], { key: 'Control' });
  }, /^lambent .* --environment=studio --environment-rotation=1[78](\.\d+)?$/],
  ['a click pins', POINT, async (page) => page.mouse.click((await middle(page)).x + 30, (await middle(page)).y), ''],
  ['Enter pins the middle', POINT, key('Enter'), ''],
  ['Alt+ArrowLeft moves the pinned point', POINT, key('Alt+ArrowLeft'), ''],
  ['Escape lets it go', POINT, key('Escape'), ''],
  ['pointing', POINT, inTab('explain', async (page) => page.mouse.move((await middle(page)).x, (await middle(page)).y)), ''],
  ['before and now', POINT, click('Before and now'), ''],
];

async function words() {
  const page = await start(START);
  for (const [label, light, act, wanted] of all ? WORDS : WORDS.filter((_, i) => i % 2 === 0)) {
    await page.evaluate((hash) => (location.hash = hash), fragment([...START, ...(light ? [light] : [])]));
    await settled(page, `before ${label}`);
    const before = await commandOf(page);
    if (/position|direction/.test(light)) await until(page, () => document.querySelector('.handle'));
    await act(page);
    await settled(page, label);
    const text = await commandOf(page), rest = wanted === '' ? light : wanted;
    const good = rest instanceof RegExp ? rest.test(text) : text === ['lambent', ...START, ...(rest ? [rest] : [])].join(' ');
    ok(good, `gesture: ${label}`, text);
    if (wanted !== '') {
      await undoIn(page);
      ok((await commandOf(page)) === before, `gesture: ${label}, undone at once`, await commandOf(page));
    }
  }
  await page.close();
}

// --- during a movement: quick pictures, and the complete picture when the pointer rests, with the button
// still down

async function rested() {
  // With threads, a flag can stop the complete picture on any machine.
  const page = await openPage(`${origin}isolated/${fragment(['sphere', '--size=400x300', '--background=white'])}`);
  await drawn(page, 'with threads');
  await until(page, () => document.body.dataset.threads);
  const at = await middle(page);
  if ((await page.evaluate(() => navigator.hardwareConcurrency)) < 2) return console.log('# one processor: the page waits for the button');
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 40, at.y);
  await page.mouse.move(at.x + 80, at.y);
  const camera = /--camera=\S+/.exec(await commandOf(page))?.[0];
  await until(page, (word) => document.body.dataset.drawn?.includes(word) && document.body.dataset.gesture !== undefined, camera);
  const hash = await pixels(page);
  ok(Boolean(camera), 'a hand that rests: the whole picture is drawn before the button is released', camera);
  await page.mouse.up();
  await settled(page, 'released');
  ok((await pixels(page)) === hash, 'a hand that rests: the same picture when it is released');
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash })}`);
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned on');
  await undoIn(page);
  await settled(page, 'undone');
  ok((await pixels(page)) === hash && (await commandOf(page)).endsWith(camera), 'a hand that rests: it is one step of undo', await commandOf(page));
  await page.close();
}

// --- touch

async function touch() {
  const touched = await browser.newContext({ viewport: { width: 700, height: 900 }, hasTouch: true });
  const page = await start(START, touched), send = await fingers(page), at = await middle(page);
  await send('touchStart', [at.x - 40, at.y], [at.x + 40, at.y]);
  for (const apart of [50, 60, 70, 80]) await send('touchMove', [at.x - apart, at.y], [at.x + apart, at.y]);
  await send('touchEnd');
  await settled(page, 'pinch');
  const found = cameraOf(await commandOf(page));
  ok(found && Math.abs(Math.hypot(...found.eye.map((x, i) => x - found.target[i])) - 2.5) < 0.01, 'touch: fingers twice as far apart, twice as near', await commandOf(page));
  await send('touchStart', [at.x, at.y]);
  await send('touchEnd');
  await until(page, () => document.getElementById('pinned') && !document.getElementById('pinned').hidden && document.querySelector('#overlay-arrows .arrow'));
  await page.locator('#pinned button').first().click();
  ok((await arrowsIn(page)).length === 0, 'touch: a tap pins the point, and its button lets it go');
  await touched.close();
}

// --- controls, links, copies

async function controls() {
  const page = await start(START);
  const option = (name) => page.locator(`#option-${name}`);
  await find(page, 'shading');
  await option('shading').selectOption('flat');
  await settled(page, 'shading');
  ok((await commandOf(page)).endsWith(' --shading=flat'), 'control: a choice', await commandOf(page));
  await find(page, 'wireframe');
  await option('wireframe').check();
  await settled(page, 'wireframe');
  ok((await commandOf(page)).endsWith(' --shading=flat --wireframe'), 'control: a switch', await commandOf(page));
  await option('wireframe').uncheck();
  await settled(page, 'no wireframe');
  await find(page, 'wireframe-width');
  await option('wireframe-width').fill('-1');
  await option('wireframe-width').press('Enter');
  await until(page, () => !document.getElementById('message').hidden);
  ok(/option '--wireframe-width'/.test(await page.locator('#message').textContent()), "control: a refused value has the program's sentence", await page.locator('#message').textContent());
  await undoIn(page);
  await settled(page, 'undo');
  await page.locator('#copy-command').click();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  ok(copied === (await commandOf(page)), 'the command is copied', copied);
  await page.locator('#copy-link').click();
  const link = await page.evaluate(() => navigator.clipboard.readText()), other = await openPage(link);
  await drawn(other, 'link');
  ok((await commandOf(other)) === copied && (await pixels(other)) === (await pixels(page)), 'a link opens the same picture', link);
  await other.close();
  const { bytes } = await saved(page, () => page.locator('#save').click()), png = createHash('sha256').update(bytes).digest('hex');
  await until(page, () => /^Saved .*pixels/.test(document.getElementById('status').textContent));
  console.log(`file ${JSON.stringify({ command: copied, hash: png })}`);
  await page.close();
}

// --- the explanation of a point contains the bytes of its pixel

async function explained() {
  const page = await start(['sphere', '--size=200x200', '--background=#203040', '--samples=1']), at = await middle(page);
  await page.mouse.click(at.x + at.width * 0.1025, at.y - at.height * 0.0975);
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  const bytes = await page.evaluate(() => [...document.getElementById('canvas').getContext('2d').getImageData(120, 80, 1, 1).data]);
  const text = await page.locator('#explain').textContent();
  ok(text.includes(bytes.slice(0, 3).join(' ')), 'explain: the bytes of the pixel', `${bytes}: ${text}`);
  await page.locator('#canvas').press('Enter');
  await until(page, (before) => document.getElementById('explain').textContent !== before, text);
  ok(/100, 100/.test(await page.locator('#explain').textContent()), 'explain: Enter explains the middle');
  await page.close();
}

const explainedText = (page) => page.locator('#explain').textContent();
const arrowsIn = (page) => page.evaluate(() => [...document.querySelectorAll('#overlay-arrows .arrow')].map((arrow) => ({ name: arrow.dataset.name, tip: arrow.dataset.tip.split(' ').map(Number), ring: Boolean(arrow.querySelector('.core > circle')) })));

// Plane geometry determines the arrows: for a ball of radius 1, seen from 5 away, half of the picture's height is 5 tan 15°
// there.
async function arrows() {
  const page = await start(['sphere', '--size=121x121', CAMERA, '--light=point:position=0/3/0']), at = await middle(page), before = await commandOf(page);
  await page.locator('#tab-explain').click();
  await until(page, () => document.querySelector('#pinned'));
  const hover = async (right, up) => {
    const text = await explainedText(page);
    await page.mouse.move(at.x + right * at.height, at.y - up * at.height);
    await until(page, (old) => document.getElementById('explain').textContent !== old && document.querySelector('#overlay-arrows .arrow'), text);
  };
  await hover(0, 0);
  const middleArrows = await arrowsIn(page);
  ok(same(middleArrows.map(({ name }) => name), ['n', 'v', 'l', 'r', 'h']), 'arrows: pointing at the picture shows n, v, l, r, h', JSON.stringify(middleArrows));
  ok(middleArrows.filter(({ ring }) => ring).map(({ name }) => name).join('') === 'nv', 'arrows: what points to the eye is a ring', JSON.stringify(middleArrows));
  await hover(30 / 121, 0);
  const half = Math.tan(Math.PI / 12), slope = (30 / 121) * 2 * half, angle = Math.atan(slope);
  // The ray meets the ball at depth 5 − t.
  const t = 5 * Math.cos(angle) - Math.sqrt(1 - (5 * Math.sin(angle)) ** 2), n = [t * Math.sin(angle), 5 - t * Math.cos(angle)], away = 5 - n[1];
  const length = 0.2 * 2 * away * half, tip = 0.5 + (n[0] + length * n[0]) / (2 * (away - length * n[1]) * half);
  const found = (await arrowsIn(page)).find(({ name }) => name === 'n');
  ok(found && Math.abs(found.tip[0] / at.height - tip) < 0.004 && Math.abs(found.tip[1] / at.height - 0.5) < 0.004, 'arrows: the normal ends where geometry has it', `${found?.tip.map((x) => x / at.height)}, expected ${tip}`);
  await page.mouse.move(at.x, Math.min(at.y + at.height, 795)); // within the window
  await until(page, () => !document.querySelector('#overlay-arrows .arrow'));
  ok((await commandOf(page)) === before, 'arrows: pointing changes no command line');

  // A pinned point: its numbers change with the picture, it stays on the surface, and Escape unpins
  // it.
  await page.mouse.click(at.x + 0.1 * at.height, at.y - 0.1 * at.height);
  await until(page, () => !document.getElementById('pinned').hidden && document.querySelector('#overlay-arrows .arrow'));
  await page.locator('#tab-lights').click();
  const slider = page.locator('#panel-lights .lights .slider input').first(), old = await explainedText(page);
  await slider.focus();
  for (let i = 0; i < 4; i++) await slider.press('ArrowRight');
  await settled(page, 'intensity');
  await until(page, (text) => document.getElementById('explain').textContent !== text, old);
  ok((await commandOf(page)) === `${before},intensity=1.2`, 'gesture: the slider of a light', await commandOf(page));
  ok(/Pinned/.test(await page.locator('#pinned').textContent()) && !(await page.locator('#panel-lights').isHidden()), 'pinned: its numbers change with a slider');
  const marked = await page.locator('#panel-lights .curve').first().getAttribute('aria-label'), said = /attenuation = .*? = ([\d.]+)D/.exec(await explainedText(page));
  ok(/: 1 at [\d.]+$/.test(marked) && said?.[1] === '1', 'curves: the pinned point is marked', `${marked}; ${said}`);
  const pixel = /Pixel (\d+), (\d+)/.exec(await explainedText(page)).slice(1).map(Number);
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned');
  await until(page, (x) => !document.getElementById('explain').textContent.includes(`Pixel ${x},`), pixel[0]);
  const turned = /Pixel (\d+), (\d+)/.exec(await explainedText(page)).slice(1).map(Number);
  // The point (x, y, z) of the ball, seen from an angle of 7.5° further.
  const across = (pixel[0] + 0.5) / 121 - 0.5, up = 0.5 - (pixel[1] + 0.5) / 121, ray = [across * 2 * half, up * 2 * half, -1], size = Math.hypot(...ray), u = ray.map((x) => x / size);
  const meets = -5 * u[2] - Math.sqrt((5 * u[2]) ** 2 - 24), point = [meets * u[0], meets * u[1], 5 + meets * u[2]], a = Math.PI / 24;
  const seen = [point[0] * Math.cos(a) - point[2] * Math.sin(a), point[1], point[0] * Math.sin(a) + point[2] * Math.cos(a)], wanted = (0.5 + seen[0] / (2 * (5 - seen[2]) * half)) * 121;
  ok(Math.abs(turned[0] + 0.5 - wanted) < 1.5, 'pinned: the point stays on the surface when the camera turns', `${turned}, expected ${wanted}`);
  await page.locator('#canvas').press('Alt+ArrowRight');
  await until(page, (x) => !document.getElementById('explain').textContent.includes(`Pixel ${x},`), turned[0]);
  ok(Number(/Pixel (\d+)/.exec(await explainedText(page))[1]) === turned[0] + 12, 'pinned: Alt and an arrow move the point by 12 pixels', await explainedText(page));
  ok((await page.locator('#spoken').textContent()).length > 40, 'pinned: it is said as a sentence', await page.locator('#spoken').textContent());
  await page.keyboard.press('Escape');
  ok((await arrowsIn(page)).length === 0 && (await page.locator('#pinned').isHidden()), 'pinned: Escape lets it go');
  await page.close();
}

// --- before and now, the lights of the program, the scene file

async function compared() {
  const page = await start(['torus-knot', '--size=96x96', '--background=white']);
  const beforePixels = async (words) => {
    await until(page, (wanted) => document.getElementById('before')?.dataset.drawn === wanted, JSON.stringify(words));
    return pixels(page, 'before');
  };
  await page.locator('#compare').click();
  await until(page, () => document.getElementById('divider'));
  await page.locator('#tab-quick').click();
  await page.locator('#quick-shading').selectOption('flat');
  await settled(page, 'flat');
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned');
  const camera = /--camera=\S+/.exec(await commandOf(page))[0], words = ['torus-knot', '--size=96x96', '--background=white', camera];
  console.log(`pixels ${JSON.stringify({ command: ['lambent', ...words].join(' '), hash: await beforePixels(words) })}`);
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page) })}`);
  const divider = page.locator('#divider');
  await divider.press('Shift+ArrowRight');
  await divider.press('ArrowLeft');
  ok((await divider.getAttribute('aria-valuenow')) === '58', 'before and now: keys move the line', await divider.getAttribute('aria-valuenow'));
  const box = await divider.boundingBox(), at = await middle(page);
  await drag(page, [box.x + box.width / 2, at.y], [at.x - at.width / 4 - box.x - box.width / 2, 0]);
  ok((await divider.getAttribute('aria-valuenow')) === '25', 'before and now: a drag moves the line', await divider.getAttribute('aria-valuenow'));
  await page.getByRole('button', { name: 'Swap' }).click();
  await settled(page, 'swapped');
  ok(!(await commandOf(page)).includes('flat'), 'before and now: swapped', await commandOf(page));
  await page.locator('#compare').click();
  ok((await page.locator('#before').count()) === 0, 'before and now: it ends');
  await page.locator('#compare').click();
  await until(page, () => document.getElementById('before')?.dataset.drawn);
  await page.locator('#model').selectOption('cube');
  await settled(page, 'another model');
  ok((await page.locator('#before').count()) === 0 && (await page.locator('#compare').getAttribute('aria-pressed')) === 'false', 'before and now: another model ends it');
  await page.close();
}

async function lights() {
  for (const words of [['teapot', '--size=96x96', '--background=white'], ['cube', '--size=96x96', '--background=white', '--rig=lecture', '--shadows']]) {
    const page = await start(words), hash = await pixels(page);
    await page.locator('#tab-lights').click();
    await page.getByRole('button', { name: 'Turn the lights into options' }).click();
    await until(page, () => /--light/.test(document.getElementById('command').textContent));
    await settled(page, 'lights written out');
    ok((await pixels(page)) === hash, `lights are written out: the same picture of ${words.join(' ')}`, await commandOf(page));
    console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash })}`);
    await page.locator('#export').click();
    const { name, bytes } = await saved(page, () => page.locator('#save-scene').click()), scene = JSON.parse(bytes.toString());
    ok(scene.lambent === 1 && scene.lights.length > 0 && name === `${words[0]}.json`, 'the scene file is saved', JSON.stringify(scene).slice(0, 300));
    await page.close();
  }
}

// Formulas: a model of the menu, changed by its option, and removed by another model.
async function formulas() {
  const page = await start(['teapot', '--size=96x96', '--background=white']);
  await page.locator('#model').selectOption('implicit');
  await settled(page, 'an implicit surface');
  const sphere = await pixels(page);
  ok((await commandOf(page)).startsWith("lambent shape '--implicit=x^2+y^2+z^2-1' --size=96x96"), 'an implicit surface is chosen', await commandOf(page));
  await find(page, 'implicit');
  await page.locator('#option-implicit').fill('(sqrt(x^2+y^2)-2)^2+z^2 = 1');
  await page.locator('#option-implicit').blur();
  await until(page, () => document.getElementById('command').textContent.includes('sqrt'));
  await settled(page, 'a torus');
  ok((await pixels(page)) !== sphere, 'another formula is another picture');
  await page.locator('#model').selectOption('cube');
  await settled(page, 'a cube');
  ok((await commandOf(page)).startsWith('lambent cube --size=96x96'), 'the formula goes with its model', await commandOf(page));
  await page.close();
}

// The picture fills a large window, and the first one has the window's size.
async function sizes() {
  const large = await browser.newContext({ viewport: { width: 2200, height: 1200 } });
  const page = await start(['sphere', '--size=64x48'], large), room = await page.locator('#view').boundingBox(), box = await page.locator('#canvas').boundingBox();
  ok(Math.abs(box.height - room.height) < 2 || Math.abs(box.width - room.width) < 2, 'the picture fills the stage', JSON.stringify([box, room]));
  ok(Math.abs(box.width / box.height - 4 / 3) < 0.01, 'the picture keeps its shape');
  const first = await openPage(origin, large);
  await drawn(first, 'first picture');
  const [, width, height] = /--size=(\d+)x(\d+)/.exec(await commandOf(first)).map(Number);
  ok(width * height > 1.2e6 && width * height <= 1.6e6, 'the first picture has a size for the window', await commandOf(first));
  await until(first, () => document.querySelector('.handle'));
  ok(!(await first.evaluate(() => document.querySelector('.handle').classList.contains('out'))), 'the handle of its light is in the picture');
  await large.close();
}

// --- files and folders, dropped by the system

async function files() {
  const page = await start(['sphere', '--size=96x96', '--background=white']);
  const model = async (path) => {
    await until(page, (name) => document.getElementById('model').value === name, path);
    await settled(page, path);
  };
  await drop(page, join(models, 'cube.ply'));
  await model('/cube.ply');
  ok((await commandOf(page)) === 'lambent cube.ply --size=96x96 --background=white', 'a dropped file', await commandOf(page));
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page) })}`);
  await drop(page, join(models, 'textured'));
  await model('/textured/damaged.obj');
  await page.locator('#model').selectOption('/textured/quad.obj');
  await model('/textured/quad.obj');
  ok((await commandOf(page)) === 'lambent textured/quad.obj --size=96x96 --background=white', 'a dropped folder, with the pictures that its model names', await commandOf(page));
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page) })}`);
  await page.locator('#files').setInputFiles(join(models, 'cube.stl'));
  await model('/cube.stl');
  ok((await commandOf(page)).startsWith('lambent cube.stl '), 'an opened file');
  await drop(page, join(models, 'broken.obj'));
  await until(page, () => !document.getElementById('message').hidden);
  ok((await page.locator('#message').textContent()) === "broken.obj:2: a face names vertex '2', but the file has 1", "a refused file has the program's sentence", await page.locator('#message').textContent());
  await page.close();
}

// If the browser reports little memory, files and pictures are refused with the numbers.
async function memory() {
  const small = await browser.newContext();
  await small.addInitScript(() => Object.defineProperty(Navigator.prototype, 'deviceMemory', { get: () => 1 }));
  const page = await start(['sphere', '--size=96x96'], small), sentence = () => page.locator('#message').textContent(), large = join(models, 'large.stl');
  writeFileSync(large, '');
  truncateSync(large, 200e6);
  await drop(page, large);
  await until(page, () => !document.getElementById('message').hidden);
  ok((await sentence()) === 'large.stl: the files have 200 MB together, but the limit of this page on this machine is 134 MB. The program lambent can draw them.', 'memory: files', await sentence());
  await page.evaluate((hash) => (location.hash = hash), fragment(['sphere', '--size=12000x12000']));
  await until(page, () => document.getElementById('message').textContent.includes('memory limit'));
  ok((await sentence()) === 'the picture of 12000x12000 pixels needs 576.0 MB, more than the memory limit of 268.4 MB (--memory-limit)', 'memory: a picture', await sentence());
  await small.close();
}

// --- the single-file page, and the served page without its server

async function oneFile() {
  const page = await openPage(pathToFileURL(join(built, 'lambent.html')) + fragment(['sphere', '--size=96x96', '--background=white']));
  await drawn(page, 'one file');
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page) })}`);
  const other = await openPage(pathToFileURL(join(built, 'included.html')) + fragment(['/cube.ply', '--size=96x96', '--background=white']));
  await drawn(other, 'a model in the page');
  console.log(`pixels ${JSON.stringify({ command: await commandOf(other), hash: await pixels(other) })}`);
  await other.close();
  const filled = await openPage(pathToFileURL(join(built, 'filled.html')).href);
  await drawn(filled, 'a page written by the program');
  const command = await commandOf(filled);
  ok(command === 'lambent quad.obj --size=96 --background=white', "its command line is the program's", command);
  console.log(`pixels ${JSON.stringify({ command: command.replace('quad.obj', 'textured/quad.obj'), hash: await pixels(filled) })}`);
  await filled.close();
  await drop(page, join(models, 'cube.obj'));
  await until(page, () => document.getElementById('model').value === '/cube.obj');
  await settled(page, 'one file');
  await drop(page, join(models, 'textured'));
  await until(page, () => document.getElementById('model').value === '/textured/damaged.obj');
  await page.locator('#model').selectOption('/textured/quad.obj');
  await settled(page, 'one file, a folder');
  await usesLater(page, 'one file');
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page) })}`);
  await page.close();
}

// The parts that are downloaded on first use.
async function usesLater(page, label) {
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  for (const tab of ['options', 'lights']) await page.locator(`#tab-${tab}`).click();
  await page.locator('#compare').click();
  await until(page, () => document.getElementById('divider') && document.querySelector('#options details') && document.querySelector('#panel-lights .slider'));
  ok(true, `${label}: explains, has all options, lights, before and now`);
}

async function offline() {
  const away = await browser.newContext(), page = await start(START, away);
  await page.evaluate(async () => {
    const { active, waiting, installing } = await navigator.serviceWorker.ready, worker = active ?? waiting ?? installing;
    if (worker.state !== 'activated') await new Promise((done) => (worker.onstatechange = () => worker.state === 'activated' && done()));
  });
  await away.setOffline(true);
  await page.reload();
  await drawn(page, 'offline');
  await page.locator('#canvas').press('+');
  await settled(page, 'offline, zoomed');
  ok(cameraOf(await commandOf(page)).eye[2] < 5, 'without the server: the page loads again, and draws');
  await usesLater(page, 'without the server');
  ok(same(await page.evaluate(() => caches.keys().then((names) => names.length)), 1), 'without the server: one cache');
  await away.close();
}

// --- the module in two parts: the first picture and its rotations need only the first part; functions of the second part wait for it, and report an
// error if it is unavailable

async function twoParts() {
  const alone = await browser.newContext({ serviceWorkers: 'block', viewport: { width: 1100, height: 800 } }), page = await alone.newPage();
  let refused = true;
  await page.route('**/lambent-rest.wasm', (route) => (refused ? route.abort() : route.continue()));
  await page.goto(origin);
  await drawn(page, 'the first part');
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'the first part, turned');
  const turned = await pixels(page);
  ok(await page.locator('#message').isHidden(), 'two parts: the first draws the first picture and its turns');
  await page.locator('#canvas').press('Enter');
  await until(page, () => !document.getElementById('message').hidden);
  ok(true, 'two parts: what needs the second says that it cannot be had');
  refused = false;
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  await page.locator('#canvas').press('ArrowLeft');
  await settled(page, 'both parts');
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'both parts, turned');
  await undoIn(page);
  await undoIn(page);
  await settled(page, 'both parts, back');
  ok((await pixels(page)) === turned, 'two parts: the same pixels with both');
  await alone.close();
}

// --- several threads if the page is cross-origin isolated, after the first picture: the same pixels

async function isolated() {
  const words = [...START, '--shadows'], page = await openPage(`${origin}isolated/${fragment(words)}`), cores = await page.evaluate(() => navigator.hardwareConcurrency);
  ok(await page.evaluate(() => crossOriginIsolated), 'isolated: the page is');
  await until(page, () => document.body.dataset.threads);
  const threads = Number(await page.evaluate(() => document.body.dataset.threads));
  ok(threads === Math.min(cores, 16), `isolated: ${threads} threads draw, of ${cores} processors`);
  const plain = await start(words);
  for (const one of [page, plain]) {
    await drawn(one, 'isolated');
    await one.locator('#canvas').press('ArrowRight');
    await settled(one, 'isolated, turned');
  }
  ok((await pixels(page)) === (await pixels(plain)), 'isolated: the same pixels as with one thread');
  ok(same(await plain.evaluate(() => [crossOriginIsolated, document.body.dataset.threads ?? '1']), [false, '1']), 'isolated: one thread elsewhere');
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  ok(true, 'isolated: explains');
  for (const one of [page, plain]) await one.close();

  // A formula needs the other part of the module with threads, which is then downloaded.
  const formula = ['implicit', '--implicit=x^2+y^2+z^2-1', '--size=96x96'], hashes = [];
  for (const address of [`${origin}isolated/`, origin]) {
    const one = await openPage(address + fragment(formula));
    await drawn(one, 'a formula');
    if (address !== origin) await until(one, () => document.body.dataset.threads);
    await one.locator('#canvas').press('ArrowRight');
    await settled(one, 'a formula, turned');
    hashes.push(await pixels(one));
    await one.close();
  }
  ok(hashes[0] === hashes[1], 'isolated: a formula has the same pixels');
  const alone = await browser.newContext({ serviceWorkers: 'block' }), refused = await alone.newPage();
  await refused.route('**/lambent-threads.wasm', (route) => route.abort());
  await refused.goto(`${origin}isolated/${fragment(words)}`);
  await until(refused, () => document.body.dataset.threads);
  ok((await refused.evaluate(() => document.body.dataset.threads)) === '1', 'isolated: one thread where the module with threads cannot be had');
  await alone.close();
}

// --- roles, names and the focus order; texts; narrow pages

// Uses Chromium's accessibility tree, as reported by its DevTools; axe.mjs checks both browsers.
async function named(page) {
  const { nodes } = await (await context.newCDPSession(page)).send('Accessibility.getFullAXTree');
  const property = (node, name) => node.properties?.find((p) => p.name === name)?.value.value;
  const unnamed = nodes.filter((node) => !node.ignored && property(node, 'focusable') && !node.name?.value && node.role.value !== 'RootWebArea' && node.role.value !== 'scrollable');
  ok(nodes.length > 100 && !unnamed.length, 'whatever has the focus has a name', JSON.stringify(unnamed.map((node) => [node.role.value, node.properties])).slice(0, 500));
  const roleOf = (name) => nodes.find((node) => node.name?.value?.includes(name))?.role.value;
  ok(roleOf('The model') === 'application' && nodes.some((node) => node.role.value === 'tab') && nodes.some((node) => node.role.value === 'combobox'), 'roles: the picture, the tabs, the choice of a model');
  ok(nodes.some((node) => node.role.value === 'main') && nodes.some((node) => node.role.value === 'contentinfo') && nodes.some((node) => node.role.value === 'complementary'), 'roles: main, the options, the footer');
}

async function accessible() {
  const page = await start(START);
  if (!isFirefox(executablePath)) await named(page);
  const order = [];
  for (let i = 0; i < 400; i++) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => document.activeElement.id || document.activeElement.tagName);
    if (at === 'BODY') break;
    order.push(at);
  }
  const wanted = ['model', 'open', 'open-folder', 'save', 'canvas', 'tab-quick', 'quick-shading', 'command', 'copy-command', 'copy-link'];
  ok(same(order.filter((id) => wanted.includes(id)).slice(0, wanted.length), wanted), 'the focus goes from the bar to the picture, the options, the command', order.join(' '));
  await page.setViewportSize({ width: 320, height: 640 });
  ok(await page.evaluate(() => document.documentElement.scrollWidth <= 320), '320 pixels wide: nothing is wider');
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  ok(await page.evaluate(() => document.documentElement.scrollWidth <= 320), '320 pixels wide: an explanation is no wider either');
  await page.close();
}

// All texts of the page are in one table (web/page/base/strings.js); with the pseudo-locale, each is between ⟦ and ⟧. Texts of the program are in
// elements with translate="no".
async function pseudo() {
  const page = await openPage(`${origin}?locale=pseudo${fragment(START)}`);
  await drawn(page, 'pseudo-locale');
  await page.locator('#tab-options').click();
  await page.locator('#tab-lights').click();
  await page.locator('#compare').click();
  await until(page, () => document.getElementById('divider') && document.querySelector('#panel-lights button') && document.querySelector('#options details'));
  await page.locator('#tab-explain').click();
  await page.locator('#canvas').press('Enter');
  await until(page, () => document.getElementById('explain').textContent.length > 100);
  const escaped = await page.evaluate(() => {
    const found = [], of = (element) => element.closest('[translate=no], script, style');
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const plain = (text) => /\p{L}/u.test(text) && !/⟦[^]*⟧/.test(text);
    while (walk.nextNode()) if (!of(walk.currentNode.parentElement) && plain(walk.currentNode.data)) found.push(walk.currentNode.data.trim());
    for (const element of document.body.querySelectorAll('[aria-label], [placeholder], [title]'))
      for (const name of ['aria-label', 'placeholder', 'title']) if (element.hasAttribute(name) && element.translate && plain(element.getAttribute(name))) found.push(`${name}=${element.getAttribute(name)}`);
    return found;
  });
  ok(!escaped.length, 'no text outside of the table', [...new Set(escaped)].slice(0, 30).join('\n'));
  await page.close();
}

// --- random sequences of gestures: the canvas has the same pixels as the copied command

function random(seed) { // xorshift32
  let x = seed * 2654435761 >>> 0 || 1;
  return (n) => {
    x ^= x << 13, x >>>= 0, x ^= x >>> 17, x ^= x << 5, x >>>= 0;
    return x % n;
  };
}

const CHOICES = [['shading', ['flat', 'gouraud', 'phong']], ['reflection', ['phong', 'blinn-phong']], ['tone', ['none', 'agx']]];

async function sequence(page, seed) {
  const pick = random(seed), shapes = ['teapot', 'torus-knot', 'sphere'];
  await page.goto('about:blank');
  await page.goto(origin + fragment([shapes[pick(3)], '--size=160x120', '--background=#8899aa']));
  await drawn(page, `sequence ${seed}`);
  const acts = [];
  for (let i = 0, count = 4 + pick(6); i < count; i++) {
    const at = await middle(page), act = pick(12);
    acts.push(act);
    if (act < 3) await drag(page, [at.x, at.y], [pick(200) - 100, pick(160) - 80], { key: act === 2 && 'Shift' });
    else if (act === 3) (await page.mouse.move(at.x, at.y), await page.mouse.wheel(0, pick(400) - 200));
    else if (act === 4) await page.locator('#canvas').press(['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight', '+', '-', 'Shift+ArrowLeft', 'Home'][pick(8)]);
    else if (act === 5) await page.locator('#model').selectOption(shapes[pick(3)]);
    else if (act < 8) {
      const [name, words] = CHOICES[pick(CHOICES.length)], control = page.locator(`#option-${name}`);
      await find(page, name);
      const there = await control.locator('option').evaluateAll((list) => list.map((o) => o.value));
      const offered = words.filter((word) => there.includes(word));
      if (offered.length) await control.selectOption(offered[pick(offered.length)]);
    } else if (act === 10) {
      await page.mouse.click(at.x + pick(120) - 60, at.y + pick(90) - 45);
      await page.locator('#tab-quick').click();
    } else if (act === 11) {
      await page.locator('#tab-lights').click();
      await page.getByRole('button', { name: ['Add a point light', 'Add a spot'][pick(2)] }).click();
    } else {
      const button = page.locator(act === 8 ? '#undo' : '#redo');
      if (await button.isEnabled()) await button.click();
    }
    if (pick(2)) await settled(page, `sequence ${seed}: ${acts}`);
  }
  await settled(page, `sequence ${seed}: ${acts}`);
  console.log(`pixels ${JSON.stringify({ command: await commandOf(page), hash: await pixels(page), label: `sequence ${seed}` })}`);
}

async function sequencesOf(count) {
  const page = await openPage('about:blank');
  for (let seed = 1; seed <= count; seed++) await sequence(page, seed);
  await page.close();
}

const parts = { gestures, words, rested, touch, controls, explained, arrows, compared, lights, formulas, sizes, files, memory, oneFile, offline, twoParts, isolated, accessible, pseudo, random: () => sequencesOf(Number(sequences)) };

const only = process.env.LAMBENT_BROWSER?.split(',');
for (const [name, part] of Object.entries(parts)) {
  if (only && !only.includes(name)) continue;
  const began = Date.now();
  await part().then(() => ok(true, `${name} ran`), (error) => ok(false, name, error.stack));
  if (process.env.LAMBENT_TIMES) console.log(`# ${name}: ${Date.now() - began} ms`);
}
ok(!reports.length, 'the browser reports no error, and the content-security policy refuses nothing', reports.join('\n'));
await close();
