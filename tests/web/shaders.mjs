// shaders.mjs PLAYWRIGHT BROWSER BUILD_WEB TASKS EXERCISES: tests shader checks in a browser with WebGL 2. TASKS is a JSON file, a list of {name,
// vertex, fragment, contract, verdict, mistakes}; EXERCISES is all or some. It prints lines of the Test Anything Protocol without numbers, and
// the differences between the browser's pictures and the references.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { ok, until, watchedPage } from './driver.mjs';
import { insertText } from './input.mjs';
import { openBrowser } from './serve.mjs';

const [, , playwright, executablePath, built, tasks, exercises] = process.argv;
const { browser, origin, close } = await openBrowser(playwright, executablePath, built);
const reports = [], page = await watchedPage(browser, reports);
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

// Exercises: the correct texts pass, and the others get the name of their mistake.
for (const { mistake, looks, wrong } of lists.exercises.filter((_, i) => exercises === 'all' || i % 16 === 0)) {
  const [report, correct] = await page.evaluate(async (mistake) => {
    const { texts, correct, highlight } = await ask({ call: 'exercise', mistake }), asked = { call: 'check', contract: 'lambent', highlight, size: 64 };
    return [await ask({ ...asked, ...texts }), await ask({ ...asked, ...correct })];
  }, mistake);
  const named = report.mistakes.some(({ id, also }) => id === mistake || (also ?? '').split(' ').includes(mistake));
  ok(correct.verdict === 'passes' && report.verdict === 'differs' && named && looks && wrong, `exercise ${mistake}`, JSON.stringify([correct.verdict, report.verdict, report.mistakes]));
}
ok(lists.exercises.length > 40, `${lists.exercises.length} exercises`);

// --- the tab

// Waits for a complete report with this `verdict`.
const judged = (there, verdict) =>
  until(there, (wanted) => {
    const { verdict, searched } = document.getElementById('shader-verdict')?.dataset ?? {};
    return searched === 'true' && verdict === wanted;
  }, verdict).catch(async (error) => {
    throw new Error(`no verdict '${verdict}': ${await there.locator('#panel-shaders').innerText().catch(() => '')}`, { cause: error });
  });

async function newPage() {
  return watchedPage(await browser.newContext({ viewport: { width: 1200, height: 900 }, serviceWorkers: 'block' }), reports);
}

async function open(address, prepare = null) {
  const there = await newPage();
  if (prepare) await there.addInitScript(prepare);
  await there.goto(address);
  await there.locator('#tab-shaders').click();
  await judged(there, 'passes');
  return there;
}

// The pixels of a cell in the table of pictures, as a string.
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

  // An error shows its line, with a button that jumps there; after the correction, the shader is
  // correct again.
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

  // Escape followed by Tab leaves the editor; Tab alone indents.
  await there.keyboard.press('Tab');
  say(await textIn(there, 'Fragment shader').evaluate((node) => node.getRootNode().activeElement === node), 'Tab indents');
  await there.keyboard.press('Escape');
  await there.keyboard.press('Tab');
  say(await textIn(there, 'Fragment shader').evaluate((node) => node.getRootNode().activeElement !== node), 'Escape and Tab leave');
  await there.getByRole('button', { name: 'Reset' }).click();
  await judged(there, 'passes');

  // An exercise: hints appear on request, and following them solves it.
  await there.locator('#shader-task').selectOption('exercise:normal-not-unit');
  await judged(there, 'differs');
  const reportText = () => there.locator('#shader-report').innerText(), hint = there.getByRole('button', { name: 'Hint' });
  say((await there.locator('#shader-contract').inputValue()) === 'lambent' && !(await reportText()).includes('normal-not-unit'), 'an exercise has the names of lambent shader, and does not tell its mistake');
  await hint.click();
  say((await reportText()).includes('Look at these pictures') && !(await reportText()).includes('normal-not-unit'), 'the first hint');
  await hint.click();
  say(/normal-not-unit the interpolated normal/.test(await reportText()) && (await there.locator('.shader-mistakes code').count()) === 0, 'the second hint', await reportText());
  await hint.click();
  const lines = await there.locator('.shader-mistakes code').allInnerTexts();
  say(lines.length === 1 && /normalize\(eye_normal\)/.test(lines[0]) && (await hint.isDisabled()), 'the third hint is the last', lines.join('\n'));
  await there.locator('.shader-mistakes button').click();
  await there.keyboard.press('Home');
  await there.keyboard.press('Shift+End');
  await insertText(there, textIn(there, 'Fragment shader'), lines[0]);
  await judged(there, 'passes');
  say((await there.locator('#shader-verdict').textContent()).startsWith('Solved') && (await hint.isDisabled()), 'it is solved');
  await there.locator('#shader-task').selectOption('exercise:reflect-sign');
  await judged(there, 'differs');
  say(!(await hint.isDisabled()), 'another one has hints again');

  // Another program in place of an exercise: its names are recognised, and the hints go. Completions wait until they are asked for.
  await hint.click();
  const learnopengl = (ending) => readFileSync(new URL(`../../classroom/tests/check/learnopengl.${ending}`, import.meta.url), 'utf8');
  const replace = async (name, content) => {
    await textIn(there, name).click();
    await there.keyboard.press('Control+a');
    await insertText(there, textIn(there, name), content);
  };
  await replace('Fragment shader', learnopengl('frag'));
  await judged(there, 'passes');
  say((await there.locator('#shader-contract').inputValue()) === 'learnopengl' && (await hint.isHidden()) && !(await reportText()).includes('Look at these'), 'another program has its own names and no hints', await reportText());
  await replace('Vertex shader', learnopengl('vert'));
  await judged(there, 'passes');
  await replace('Fragment shader', learnopengl('frag').replace('uniform vec3 lightPos', 'uniform vec3 unheardOf').replaceAll('lightPos', 'unheardOf').replaceAll('objectColor', 'strange'));
  await there.waitForTimeout(1500);
  say(!/(^|\s)--\w/m.test(await reportText()), 'a message names no option of the command line', await reportText());
  await textIn(there, 'Fragment shader').click();
  await there.keyboard.press('Control+a');
  await there.keyboard.type('n');
  await there.keyboard.type('orm');
  await there.waitForTimeout(300);
  say((await there.locator('.cm-tooltip-autocomplete').count()) === 0, 'completions do not appear unasked');
  await there.keyboard.press('Enter');
  say((await textIn(there, 'Fragment shader').evaluate((node) => node.cmView?.view?.state.doc.toString() ?? node.innerText)).trim() === 'norm', 'and Enter is a new line');
  await there.getByRole('button', { name: 'Reset' }).click();
  await judged(there, 'passes');
  await there.setViewportSize({ width: 320, height: 700 });
  say(await until(there, () => document.documentElement.scrollWidth <= 320).catch(() => false), 'it fits 320 pixels', await there.evaluate(() =>
    [document.documentElement.scrollWidth, ...[...document.querySelectorAll('*')].filter((node) => node.getBoundingClientRect().right > 320 && !node.closest('.wide'))
      .map((node) => `${node.tagName} ${node.id} ${node.className} ${node.getBoundingClientRect().right}`)].join('\n')));
  await there.context().close();
}

// Simulated delays: `hold` delays the messages of checks, and time limits are kept until they are requested.
function delays() {
  const post = Worker.prototype.postMessage, timeout = setTimeout;
  const test = (globalThis.test = { hold: () => false, held: [], limits: [], sent: 0 });
  Worker.prototype.postMessage = function (message, ...more) {
    const send = () => post.call(this, message, ...more);
    if (message.call === 'check') test.sent++;
    if (message.call === 'check' && test.hold(message)) test.held.push(send);
    else send();
  };
  globalThis.setTimeout = (f, ms, ...more) => (ms === 30000 || ms === 1500 ? void test.limits.push({ f, ms }) : timeout(f, ms, ...more));
}

const stateOf = (there) => there.locator('#shader-verdict').evaluate((node) => ({ ...node.dataset, sentence: node.textContent }));
const testIn = (there, f, argument) => there.evaluate(f, argument);

async function delayed() {
  const there = await open(origin, delays), choose = (task) => there.locator('#shader-task').selectOption(task);
  const heldIs = (count) => until(there, (wanted) => test.held.length === wanted, count);
  const wrong = async () => {
    await there.locator('#shader-contract').selectOption('angel');
    await judged(there, 'passes');
    await textIn(there, 'Fragment shader').click();
    await there.keyboard.press('Control+a');
    await there.keyboard.press('Delete');
    await insertText(there, textIn(there, 'Fragment shader'), readFileSync(new URL('../../classroom/tests/check/angel.frag', import.meta.url), 'utf8').replace('pow(', '0.5 * pow('));
  };

  // If the search takes too long, the report without it remains.
  await testIn(there, () => (test.hold = ({ pictures }) => pictures === 0));
  await wrong();
  await heldIs(1);
  const before = await stateOf(there);
  await testIn(there, () => test.limits.filter(({ ms }) => ms === 30000).at(-1).f());
  await until(there, () => document.getElementById('shader-verdict').dataset.searched === 'true');
  const after = await stateOf(there);
  ok(before.verdict === 'differs' && before.searched === 'false' && after.verdict === 'differs' && /search .* took too long/.test(after.sentence) && !/No known mistake/.test(await there.locator('#shader-report').innerText()),
    'a search that takes too long leaves the verdict as it is, and says so', JSON.stringify([before, after]));
  ok((await there.locator('.shader-scenes tbody tr').count()) > 5, 'and its pictures');

  // Newer texts during a check: the worker gets one at a time, and the older answer is never shown.
  await testIn(there, () => Object.assign(test, { hold: ({ pictures }) => pictures === 1, held: [], sent: 0 }));
  await textIn(there, 'Fragment shader').press('Control+End');
  await there.keyboard.type(' ');
  await heldIs(1);
  await choose('angel'); // correct
  await choose('angel-vertex');
  await testIn(there, () => ((test.hold = () => false), test.held[0]()));
  await judged(there, 'passes');
  ok((await testIn(there, () => test.sent)) === 2, 'texts in between are not checked', await testIn(there, () => test.sent));

  // Newer texts end a check that takes too long, and its time limit then has no effect.
  await testIn(there, () => Object.assign(test, { hold: ({ pictures }) => pictures === 1, held: [], limits: [] }));
  await textIn(there, 'Fragment shader').press('Control+End');
  await there.keyboard.type(' ');
  await heldIs(1);
  await choose('angel');
  await until(there, () => test.limits.some(({ ms }) => ms === 1500));
  await testIn(there, () => ((test.hold = () => false), test.limits.find(({ ms }) => ms === 1500).f()));
  await judged(there, 'passes');
  await testIn(there, () => test.limits.forEach(({ f }) => f()));
  await choose('angel-vertex');
  await judged(there, 'passes');
  ok(true, 'a check that goes on is ended by newer texts, which have their own verdict');

  // Nothing arrives in time: this is the verdict, and the next texts get a verdict again.
  await testIn(there, () => Object.assign(test, { hold: ({ pictures }) => pictures === 1, held: [], limits: [] }));
  await choose('angel');
  await heldIs(1);
  await testIn(there, () => ((test.hold = () => false), test.limits.find(({ ms }) => ms === 30000).f()));
  await judged(there, 'endless');
  await choose('angel-vertex');
  await judged(there, 'passes');
  ok(true, 'what does not end is endless, and what follows is not');
  await there.context().close();
}

// The first download of the module of checks fails.
async function refetched() {
  const there = await newPage();
  let refused = 'abort';
  await there.route('**/check.wasm', (route) => (refused === 'abort' ? route.abort() : refused ? route.fulfill({ status: refused }) : route.continue()));
  await there.goto(origin);
  await there.locator('#tab-shaders').click();
  const again = there.getByRole('button', { name: 'Try again' });
  for (const [next, sentence] of [[404, 'check.wasm could not be loaded: the server cannot be reached'], [null, 'check.wasm could not be loaded: the server answers 404']]) {
    await until(there, (wanted) => document.getElementById('shader-verdict')?.textContent === wanted, sentence);
    ok(true, sentence);
    refused = next;
    await again.click();
  }
  await judged(there, 'passes');
  ok(await again.isHidden(), 'and another attempt loads it');
  reports.splice(0, reports.length, ...reports.filter((report) => !report.includes('Failed to load resource'))); // these two
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

const only = process.env.LAMBENT_BROWSER?.split(',');
for (const [name, part] of Object.entries({ served: () => tab(origin, 'served'), oneFile: () => tab(pathToFileURL(resolve(built, 'lambent.html')).href, 'one file'), delayed, refetched, pseudo })) {
  if (only && !only.includes(name)) continue;
  await part().then(() => ok(true, `${name} ran`), (error) => ok(false, name, error.stack));
}

ok(reports.length === 0, 'the browser reports nothing, and the content-security policy refuses nothing', reports.join('\n'));
await close();
