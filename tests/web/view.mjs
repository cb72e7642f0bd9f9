// view.mjs PLAYWRIGHT BROWSER MODEL FOLDER PROCESS LARGE: tests `lambent view` in a browser. MODEL is the address of a viewer of FOLDER's part.obj,
// a copy of cube.obj, whose process id is PROCESS. LARGE is the address of a viewer of a folder with points.ply, which is too large for the page;
// "" means none. It prints lines of the Test Anything Protocol without numbers, and commands with their pixels, like browser.mjs.
import { copyFileSync, renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { saved } from './input.mjs';
import { commandOf, drawn, fragment, ok, pixels, settled, until, watchedPage } from './driver.mjs';
import { launch } from './serve.mjs';

const [, , playwright, executablePath, model, folder, viewer, large] = process.argv;
const browser = await launch(playwright, executablePath), context = await browser.newContext({ viewport: { width: 1000, height: 760 } }), reports = [];
const part = join(folder, 'part.obj');

// The browser itself reports a damaged file's answer (422), and requests to a viewer that has ended.
const forgetReports = (expected) => reports.splice(0, reports.length, ...reports.filter((report) => !expected.test(report)));

const message = (page) => page.locator('#message').textContent();
const said = (command, hash, label) => console.log(`pixels ${JSON.stringify({ command, hash, label })}`);

// Waits until the colours of the canvas change.
async function changed(page, before) {
  for (const end = Date.now() + 60000; Date.now() < end; await page.waitForTimeout(20)) if ((await pixels(page)) !== before) return pixels(page);
  throw new Error('the picture has not changed');
}

async function oneModel() {
  const page = await watchedPage(context, reports);
  await page.goto(model);
  await drawn(page, 'the model');
  const command = await commandOf(page), first = await pixels(page);
  ok(command === 'lambent part.obj --size=96x96 --background=white', "the command line is the viewer's", command);
  said(command.replace('part.obj', 'cube.obj'), first, 'the viewer draws its model');
  ok((await page.title()) === 'part.obj · Lambent' && (await page.locator('#gallery').count()) === 0, 'the title is the model, and there is no gallery', await page.title());
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'turned');
  const turned = await commandOf(page), before = await pixels(page);
  ok(/--camera=/.test(turned) && before !== first, 'it is turned', turned);
  said(turned.replace('part.obj', 'cube.obj'), before, 'the viewer draws it turned');

  // The page that is sent contains the model, and no data of the viewer.
  await page.locator('#export').click();
  const { bytes } = await saved(page, () => page.locator('#save-page').click()), sent = join(folder, 'sent.html'), text = bytes.toString();
  writeFileSync(sent, text);
  const other = await watchedPage(context, reports);
  await other.goto(pathToFileURL(sent).href);
  await drawn(other, 'what was sent');
  ok((await pixels(other)) === before && !text.includes(new URL(model).pathname.split('/')[1]), 'a page is sent from the viewer, without its address');
  await other.close();

  // The file is replaced like editors do it, damaged, and written again.
  await page.evaluate(() => {
    const spoken = document.getElementById('spoken');
    globalThis.heard = [];
    new MutationObserver(() => heard.push(spoken.textContent)).observe(spoken, { childList: true, characterData: true, subtree: true });
  });
  copyFileSync(join(folder, 'other.obj'), part + '.new');
  renameSync(part + '.new', part);
  const after = await changed(page, before);
  await drawn(page, 'reloaded');
  ok((await commandOf(page)) === turned, 'a changed file: the view stays', await commandOf(page));
  said(turned.replace('part.obj', 'other.obj'), after, 'a changed file is drawn anew');
  const heard = await page.evaluate(() => globalThis.heard);
  ok(heard.some((sentence) => sentence.startsWith('The file has changed')), 'a changed file is announced', heard.join('\n'));
  writeFileSync(part, 'v 0 0 0\nf 1 2 x\n');
  await until(page, () => !document.getElementById('message').hidden);
  // Reported by the viewer, or by the page if the viewer has not read the file yet.
  ok([part, 'part.obj'].includes((await message(page)).replace(/:2: a face names vertex '2', but the file has 1$/, '')) && (await pixels(page)) === after, 'a damaged file: the sentence, and the picture stays', await message(page));
  copyFileSync(join(folder, 'cube.obj'), part);
  await until(page, () => document.getElementById('message').hidden);
  await drawn(page, 'mended');
  ok((await pixels(page)) === before, 'a mended file: its picture');
  process.kill(Number(viewer), 'SIGINT');
  await until(page, () => document.getElementById('message').textContent.startsWith('lambent view has ended'));
  await page.locator('#undo').click();
  await settled(page, 'without the viewer');
  ok((await pixels(page)) === first, 'without the viewer: what was sent is drawn');
  forgetReports(/status of 422|ERR_CONNECTION|ERR_INCOMPLETE|EventSource/);
  await page.close();
}

async function gallery() {
  const page = await watchedPage(context, reports), points = '/points.ply';
  await page.goto(large);
  const links = await page.locator('li a').evaluateAll((list) => list.map((link) => link.textContent));
  ok(['cube.obj', 'cube.ply', 'points.ply', 'broken.obj'].every((name) => links.some((text) => text.endsWith(name))), 'the gallery lists the models', links.join(' '));
  for (const link of await page.locator('li a').all()) await link.scrollIntoViewIfNeeded();
  await until(page, () => [...document.images].every((image) => image.complete && image.naturalWidth === 256));
  ok(true, 'each has its picture, or its sentence');
  const shown = () => page.evaluate(() => [...document.querySelectorAll('li:not([hidden]) a')].map((link) => link.dataset.name));
  await page.keyboard.press('/');
  await page.keyboard.type('CUBE');
  ok((await shown()).length > 1 && (await shown()).every((name) => /cube/.test(name)), 'the gallery finds names', (await shown()).join(' '));
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowRight');
  ok((await page.evaluate(() => document.activeElement.dataset.name)) === (await shown())[1], 'arrow keys go from model to model');
  await page.keyboard.press('Escape');
  await page.locator('#order').selectOption('size');
  const [largest] = await shown();
  await page.locator('#order').selectOption('failed');
  const [failed] = await shown();
  ok(largest === 'points.ply' && /broken\.obj$/.test(failed), 'the gallery sorts by size, and by errors', `${largest} ${failed}`);
  await page.locator('#order').selectOption('date');
  const times = await page.evaluate(() => [...document.querySelectorAll('li')].map((item) => Number(item.dataset.time)));
  ok(times.every((time, i) => !i || time <= times[i - 1]), 'and by date');
  await page.locator('li a', { hasText: 'cube.ply' }).click();
  await until(page, () => document.body.dataset.drawn);
  await drawn(page, 'of the gallery');
  ok((await commandOf(page)) === 'lambent cube.ply', 'a click opens a model', await commandOf(page));
  await page.locator('#gallery').click();
  await until(page, () => document.images.length > 3);
  ok(page.url() === large, 'and the link leads back', page.url());

  // The program draws models that are too large for the page.
  await page.goto(`${large}page${fragment([points, '--size=96x96', '--background=white', '--samples=1'])}`);
  await drawn(page, 'the points');
  const status = await page.locator('#status').textContent();
  ok(/drawn by lambent view, since the model has 2100000 triangles, lines and points, more than the 2000000 that a page draws/.test(status), 'a large model is drawn by the program, and the page says so', status);
  said(await commandOf(page), await pixels(page), 'a large model has the pixels of the program');
  await page.locator('#canvas').press('ArrowRight');
  await settled(page, 'the points, turned');
  said(await commandOf(page), await pixels(page), 'a large model, turned');
  await page.evaluate((hash) => (location.hash = hash), fragment(['/cube.obj', '--size=96x96', '--background=white']));
  await settled(page, 'a small one again');
  ok(!/drawn by lambent view/.test(await page.locator('#status').textContent()), 'a small model after it is drawn by the page', await page.locator('#status').textContent());
  said(await commandOf(page), await pixels(page), 'a small model after it');
  await page.close();
  forgetReports(/status of 422/); // the picture of broken.obj
}

for (const [name, act] of Object.entries({ oneModel, ...(large ? { gallery } : {}) }))
  await act().then(() => ok(true, `view: ${name} ran`), (error) => ok(false, `view: ${name}`, error.stack));
ok(!reports.length, 'view: the browser reports no error, and the content-security policy refuses nothing', reports.join('\n'));
await browser.close();
