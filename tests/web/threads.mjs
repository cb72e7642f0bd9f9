// threads.mjs MODULE THREADS_MODULE FOLDER: pictures by the module with threads, with 1, 2 and 4 of them, have the pixels of the module without. The
// models are in FOLDER. Prints lines of the Test Anything Protocol without numbers.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { Worker } from 'node:worker_threads';
import { Files, LambentError, open } from '../../web/lambent.js';
import { openThreads } from '../../web/threads.js';

const [, , single, shared, folder] = process.argv;
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
  for (const round of [1, 2]) { // with what the first has kept
    const found = [...PICTURES, ...REFUSED].map((words) => pixels(lambent, words)), differs = found.findIndex((hash, i) => hash !== expected[i]);
    ok(differs < 0, `threads: the same pixels and sentences with ${count}, round ${round}`, `${[...PICTURES, ...REFUSED][differs]}: found ${found[differs]}, expected ${expected[differs]}`);
  }
  const png = (from) => createHash('sha256').update(from.save(['teapot', '--size=512'], 'png')).digest('hex');
  ok(png(lambent) === png(one), `threads: the same file with ${count}`);
  lambent.end();
}

// A thread that ends in a trap ends the drawing too, which waits for it otherwise.
const failing = await openThreads(module, 2, worker('failing_thread.mjs'));
let said = null;
try {
  failing.draw(['teapot', '--size=128']);
} catch (error) {
  said = error;
}
ok(said instanceof WebAssembly.RuntimeError, 'threads: a thread that fails ends the drawing', String(said));
failing.end();

// Without a worker that starts, the caller draws alone.
const alone = await openThreads(module, 2, worker('no_such_thread.mjs'), files);
ok(alone.threads === 1 && pixels(alone, PICTURES[0]) === expected[0], 'threads: those that cannot be started are done without');
alone.end();
