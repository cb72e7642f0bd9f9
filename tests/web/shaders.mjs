// shaders.mjs PLAYWRIGHT CHROMIUM BUILD_WEB TASKS: checks of shaders in a browser, by its WebGL 2. TASKS: a JSON file, a list of {name, vertex, fragment,
// contract, verdict, mistakes}. Prints lines of the Test Anything Protocol without numbers, and what the browser's pictures differ by from the references.
import { readFileSync } from 'node:fs';
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

ok(reports.length === 0, 'the browser reports nothing', reports.join('\n'));
await close();
