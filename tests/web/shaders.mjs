// shaders.mjs PLAYWRIGHT CHROMIUM BUILD_WEB TASKS: checks of shaders in a browser, by its WebGL 2. TASKS: a JSON file, a list of {name, vertex, fragment,
// contract, verdict, mistakes}. Prints lines of the Test Anything Protocol without numbers, and what the browser's pictures differ by from the references.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openBrowser } from './serve.mjs';

const [, , playwright, executablePath, built, tasks] = process.argv;
const ok = (good, label, why = '') => console.log(`${good ? 'ok' : 'not ok'} ${label}${good || why === '' ? '' : `\n# ${String(why).replaceAll('\n', '\n# ')}`}`);
const { browser, origin, close } = await openBrowser(playwright, executablePath, built);
const page = await browser.newPage();
const reports = [];
page.on('pageerror', (error) => reports.push(error.message));
page.on('console', (message) => message.type() === 'error' && reports.push(message.text()));
await page.goto(origin);

// --- the worker

const lists = await page.evaluate(async () => {
  const worker = new Worker('check_worker.js', { type: 'module' });
  let id = 0;
  globalThis.ask = (message) =>
    new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => (data.error ? reject(new Error(data.error)) : resolve(data.result));
      worker.onerror = (event) => reject(new Error(event.message));
      worker.postMessage({ ...message, id: id++ });
    });
  return ask({ call: 'start', wasm: await (await fetch('check.wasm')).arrayBuffer() });
});
ok(lists.contracts.length >= 10, 'the module of checks starts');

let maximum = 0;
const differences = new Array(256).fill(0), shares = [];
for (const task of JSON.parse(readFileSync(tasks, 'utf8'))) {
  const found = await page.evaluate(async ({ vertex, fragment, contract }) => {
    const report = await ask({ call: 'check', fragment, vertex, contract, size: 128 }), counts = new Array(256).fill(0);
    for (const { theirs, reference } of report.scenes)
      for (let i = 0; i < theirs.length; i++) if (theirs[i - (i % 4) + 3] && reference[i - (i % 4) + 3]) counts[Math.abs(theirs[i] - reference[i])]++;
    return { ...report, counts, scenes: report.scenes.map(({ maximum, share_over }) => ({ maximum, share_over })) };
  }, task).catch((error) => ({ verdict: error.message, mistakes: [], scenes: [], notes: [] }));
  const mistakes = found.mistakes.map(({ id, certain }) => id + (certain ? '' : '?')).sort().join(' ');
  ok(found.verdict === task.verdict && mistakes === task.mistakes, `${task.name} ${task.verdict} ${task.mistakes}`,
    `found: ${found.verdict} ${mistakes}; ${JSON.stringify(found.scenes)}; ${found.notes.map(({ line, text }) => `${line}: ${text}`).join('\n')}`);
  if (found.verdict === 'passes') {
    maximum = Math.max(maximum, ...found.scenes.map((scene) => scene.maximum));
    shares.push(...found.scenes.map((scene) => scene.share_over));
    found.counts.forEach((count, difference) => (differences[difference] += count));
  }
  if (task.line) ok(found.notes.some(({ line, file }) => line === task.line && file === 'shader.frag'), `its line is ${task.line}`, JSON.stringify(found.notes));
}
const all = differences.reduce((sum, count) => sum + count, 0);
const quantile = (share) => {
  let sum = 0;
  return differences.findIndex((count) => (sum += count) >= share * all);
};
console.log(`# ${all} channels of correct shaders: 99 % within ${quantile(0.99)}/255, 99.9 % within ${quantile(0.999)}/255 of the reference; of those compared at most ` +
  `${(100 * Math.max(...shares)).toFixed(3)} % of a scene's pixels over the tolerance, the largest ${maximum.toFixed(4)}`);

// --- the tab

const until = async (there, f, argument) => {
  for (const end = Date.now() + 60000; Date.now() < end; await new Promise((done) => setTimeout(done, 20))) if (await there.evaluate(f, argument)) return true;
  throw new Error(`nothing came of ${f}`);
};
// Waits for a whole report; `verdict`: of what must come.
const judged = (there, verdict) =>
  until(there, (wanted) => {
    const { verdict, searched } = document.getElementById('shader-verdict')?.dataset ?? {};
    return searched === 'true' && verdict === wanted;
  }, verdict).catch(async (error) => {
    throw new Error(`no verdict '${verdict}': ${await there.locator('#panel-shaders').innerText().catch(() => '')}`, { cause: error });
  });

async function open(address) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 900 } });
  const there = await context.newPage();
  there.on('pageerror', (error) => reports.push(error.message));
  there.on('console', (message) => message.type() === 'error' && reports.push(message.text()));
  await there.addInitScript(() => addEventListener('securitypolicyviolation', (event) => console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`)));
  await there.goto(address);
  await there.locator('#tab-shaders').click();
  await judged(there, 'passes');
  return there;
}

// The pixels of a cell of the table of pictures, as a text.
const pixelsOf = (there, row, column) =>
  there.locator('.shader-scenes tbody tr').nth(row).locator('canvas').nth(column).evaluate((canvas) => canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.join());
const textIn = (there, name) => there.getByRole('textbox', { name, exact: true });

async function tab(address, label) {
  const there = await open(address);
  const say = (good, what, why) => ok(good, `${label}: ${what}`, why);
  say(await textIn(there, 'Fragment shader').evaluate((node) => node.classList.contains('cm-content')), 'the editor is CodeMirror');
  await there.locator('#shader-contract').selectOption('angel');
  await judged(there, 'passes');
  say((await pixelsOf(there, 0, 0)) !== '' && (await there.locator('.shader-scenes tbody tr').count()) > 5, 'each scene has its pictures');
  const before = await pixelsOf(there, 0, 0);

  // An error has its line, with a button that goes there; mended, it is correct again.
  await textIn(there, 'Fragment shader').click();
  await there.keyboard.press('Control+Home');
  await there.keyboard.press('End');
  await there.keyboard.type('\nfloat wrong = vec3(1.0);');
  await judged(there, 'refused');
  say(await there.getByRole('button', { name: 'shader.frag, line 2' }).first().isVisible(), 'an error has its line');
  say((await there.locator('.cm-lint-marker-error').count()) === 1, 'and stands beside it');
  await there.getByRole('button', { name: 'shader.frag, line 2' }).first().click();
  await there.keyboard.press('Shift+End');
  await there.keyboard.press('Delete');
  await judged(there, 'passes');
  say((await pixelsOf(there, 0, 0)) === before, 'without it the pictures are as before');

  // Escape and Tab leave the editor, Tab alone indents.
  await there.keyboard.press('Tab');
  say(await textIn(there, 'Fragment shader').evaluate((node) => node.getRootNode().activeElement === node), 'Tab indents');
  await there.keyboard.press('Escape');
  await there.keyboard.press('Tab');
  say(await textIn(there, 'Fragment shader').evaluate((node) => node.getRootNode().activeElement !== node), 'Escape and Tab leave');
  await there.getByRole('button', { name: 'Reset' }).click();
  await judged(there, 'passes');

  // An exercise: hints come when they are asked for, and writing what they say solves it.
  const exercises = await there.locator('#shader-task option[value^=exercise]').count();
  say(exercises > 5, `${exercises} exercises`);
  await there.locator('#shader-task').selectOption({ label: 'Find what is wrong 1' });
  await judged(there, 'differs');
  say((await there.locator('.shader-mistakes').count()) === 0, 'an exercise does not tell its mistake');
  await there.getByRole('button', { name: 'Hint' }).click();
  say((await there.locator('#shader-report').innerText()).includes('Look at these pictures') && (await there.locator('.shader-mistakes').count()) === 0, 'the first hint');
  await there.getByRole('button', { name: 'Hint' }).click();
  say((await there.locator('.shader-mistakes li').count()) > 0 && (await there.locator('.shader-mistakes code').count()) === 0, 'the second hint');
  await there.getByRole('button', { name: 'Hint' }).click();
  say((await there.locator('.shader-mistakes code').count()) > 0, 'the third hint');
  for (const [name, ending] of [['Fragment shader', 'frag'], ['Vertex shader', 'vert']]) {
    await textIn(there, name).click();
    await there.keyboard.press('Control+a');
    await there.keyboard.press('Delete');
    await there.keyboard.insertText(readFileSync(new URL(`../check/angel.${ending}`, import.meta.url), 'utf8'));
  }
  await judged(there, 'passes');
  say((await there.locator('#shader-verdict').textContent()).startsWith('Solved'), 'it is solved');
  await there.setViewportSize({ width: 320, height: 700 });
  say(await until(there, () => document.documentElement.scrollWidth <= 320).catch(() => false), 'it fits 320 pixels', await there.evaluate(() =>
    [document.documentElement.scrollWidth, ...[...document.querySelectorAll('*')].filter((node) => node.getBoundingClientRect().right > 320 && !node.closest('.wide'))
      .map((node) => `${node.tagName} ${node.id} ${node.className} ${node.getBoundingClientRect().right}`)].join('\n')));
  await there.context().close();
}

async function pseudo() {
  const there = await open(`${origin}?locale=pseudo`);
  const plain = await there.evaluate(() => {
    const found = [], walker = document.createTreeWalker(document.getElementById('panel-shaders'), NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode())
      if (/\p{L}{2}/u.test(node.data) && !node.parentElement.closest('[translate=no]') && !node.data.includes('⟦')) found.push(node.data);
    return found;
  });
  ok(!plain.length, 'every text of the tab is of the table', plain.join('\n'));
  await there.context().close();
}

for (const [name, part] of Object.entries({ served: () => tab(origin, 'served'), oneFile: () => tab(pathToFileURL(resolve(built, 'lambent.html')).href, 'one file'), pseudo }))
  await part().then(() => ok(true, `${name} ran`), (error) => ok(false, name, error.stack));

ok(reports.length === 0, 'the browser reports nothing, and the content-security policy refuses nothing', reports.join('\n'));
await close();
