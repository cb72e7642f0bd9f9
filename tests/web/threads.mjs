// threads.mjs MODULE THREADS_MODULE PART PART FOLDER: pictures of the module with 1, 2 and 4 threads, and of a page's two PARTs, have the same pixels
// as pictures of the module without threads. The models are in FOLDER. Prints lines of the Test Anything Protocol without numbers.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { Worker } from 'node:worker_threads';
import { Files, LambentError, PartMissing, open } from '../../web/lambent.js';
import { openThreads } from '../../web/threads.js';

const [, , single, shared, firstPart, secondPart, folder] = process.argv;
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const ok = (good, label, why = '') => console.log(`${good ? 'ok' : 'not ok'} ${label}${good || why === '' ? '' : `\n# ${why}`}`);
const worker = (script) => () => new Worker(new URL(script, import.meta.url));
const files = new Files();
for (const name of readdirSync(folder, { recursive: true }))
  if (statSync(join(folder, name)).isFile()) files.set('/' + name, new Uint8Array(readFileSync(join(folder, name))));

const PICTURES = [['teapot', '--size=200x150', '--shadows'], ['torus-knot', '--size=160x120', '--ao=rays', '--samples=1'], ['torus-knot', '--size=160', '--ao=screen'],
  ['/cube.obj', '--size=96', '--wireframe', '--edges=all'], ['/textured/quad.obj', '--size=200'], ['/textured/damaged.obj', '--size=96'],
  ['sphere', '--size=160', '--environment=studio', '--material=metallic=1,roughness=0.3,color=white'],
  ['sphere', '--size=160', '--material=opacity=0.5'], ['/cube.stl', '--size=96', '--normals=smooth'], ['/scene.json'], ['teapot', '--size=128', '--threads=2'],
  ['teapot', '--size=128', '--threads=3', '--shading=flat']];
const REFUSED = [['/missing.obj'], ['/broken.obj'], ['teapot', '--size=0']];

const pixels = (lambent, words) => {
  try {
    const { width, height, pixels } = lambent.draw(words);
    return `${width}x${height} ${createHash('sha256').update(pixels).digest('hex')}`;
  } catch (error) {
    if (error instanceof LambentError) return error.message;
    throw error;
  }
};

const one = await open(readFileSync(single)), module = await WebAssembly.compile(readFileSync(shared));
for (const name of files.list()) one.files.set(name, files.get(name));
const expected = [...PICTURES, ...REFUSED].map((words) => pixels(one, words));
ok(expected.every((said, i) => / [0-9a-f]{64}$/.test(said) === i < PICTURES.length), 'threads: pictures and errors are those that are meant', expected.join('; '));
for (const count of [1, 2, 4]) {
  const lambent = await openThreads(module, count, worker('../../web/thread.js'), files);
  ok(lambent.threads === count, `threads: ${count} draw`, `found ${lambent.threads}`);
  for (const round of [1, 2]) { // with the data kept by the first
    const found = [...PICTURES, ...REFUSED].map((words) => pixels(lambent, words)), differs = found.findIndex((hash, i) => hash !== expected[i]);
    ok(differs < 0, `threads: the same pixels and sentences with ${count}, round ${round}`, `${[...PICTURES, ...REFUSED][differs]}: found ${found[differs]}, expected ${expected[differs]}`);
  }
  const png = (from) => createHash('sha256').update(from.save(['teapot', '--size=512'], 'png')).digest('hex');
  ok(png(lambent) === png(one), `threads: the same file with ${count}`);
  lambent.end();
}

// In two parts: the first draws the same picture without the second, and reports when it needs the
// second.
const parts = await Promise.all([firstPart, secondPart].map((path) => WebAssembly.compile(readFileSync(path))));
const FORMULA = ['parametric', '--parametric=x=cos(u)*(2+cos(v)); y=sin(u)*(2+cos(v)); z=sin(v)', '--size=96'], IMPLICIT = ['implicit', '--implicit=x^2+y^2+z^2-1', '--size=96'];
const missingPart = (call) => {
  try {
    return `found ${JSON.stringify(call()).slice(0, 200)}`;
  } catch (error) {
    return error instanceof PartMissing ? error.part : String(error);
  }
};
const apart = await openThreads(parts[0], 2, worker('../../web/thread.js'), files), all = [...PICTURES, ...REFUSED];
const drawn = all.map((words) => pixels(apart, words)); // scene files too: options and scene files have one reader
ok(same(drawn, expected), 'threads: the same pixels and sentences by the first of two parts', drawn.filter((one, i) => one !== expected[i]).join('; '));
ok(missingPart(() => apart.explain(['teapot', '--size=96'], 48, 48)) === 'threads-more', 'threads: explaining asks for the second part', missingPart(() => apart.explain(['teapot', '--size=96'], 48, 48)));
apart.end();
const whole = await openThreads(parts[0], 2, worker('../../web/thread.js'), files, null, [parts[1]]);
for (const words of [FORMULA, IMPLICIT, PICTURES[0], ['/scene.json']]) ok(pixels(whole, words) === pixels(one, words), `threads: both parts draw ${words[0]}`, pixels(whole, words));
ok(same(whole.explain(['teapot', '--size=96'], 48, 48), one.explain(['teapot', '--size=96'], 48, 48)), 'threads: both parts explain as the whole module does');
ok(same(whole.lights(['teapot']), one.lights(['teapot'])), 'threads: both parts list lights as the whole module does');
whole.end();

// A thread that traps also ends the drawing, which would otherwise wait for it.
const failing = await openThreads(module, 2, worker('failing_thread.mjs'));
let said = null;
try {
  failing.draw(['teapot', '--size=128']);
} catch (error) {
  said = error;
}
ok(said instanceof WebAssembly.RuntimeError, 'threads: a thread that fails ends the drawing', String(said));
failing.end();

// If no worker starts, the caller draws alone.
const alone = await openThreads(module, 2, worker('no_such_thread.mjs'), files);
ok(alone.threads === 1 && pixels(alone, PICTURES[0]) === expected[0], 'threads: those that cannot be started are done without');
alone.end();
