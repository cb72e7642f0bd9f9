// npm.mjs FOLDER: tests the npm package in node (tests/npm.py). FOLDER contains cube.stl, ball.stl, and expected.json: hashes of the program's
// PNG files by model.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { Files, Lambent, LambentError, open, openWorker } from 'lambent';

import { ok } from './driver.mjs';

const folder = process.argv[2], read = (name) => readFileSync(join(folder, name));
const expected = JSON.parse(read('expected.json')), wasm = readFileSync(process.env.LAMBENT_WASM);
const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');
const png = { as: 'png' }, options = { size: 96, view: 'front', lightCutoff: 0, shadows: true, light: ['point:position=1/2/3', 'ambient'] };
const words = ['/cube.stl', '--size', '96', '--view', 'front', '--light-cutoff', '0', '--shadows', '--light', 'point:position=1/2/3', '--light', 'ambient'];

async function refused(what, name, code, part) {
  try {
    await what();
  } catch (error) {
    return ok(error.name === name && error.code === code && error.message.includes(part), `${name} ${code}: ${part}`, `${error.name} ${error.code}: ${error.message}`);
  }
  ok(false, `${name} ${code}: ${part}`, 'nothing was thrown');
}

function tryDrawing(lambent, label) {
  lambent.files.set('/cube.stl', read('cube.stl'));
  ok(hash(lambent.draw('/cube.stl', options, png)) === expected.cube, `${label}: options by name draw the program's bytes`);
  ok(hash(lambent.draw(words, png)) === expected.cube, `${label}: words draw the program's bytes`);
  ok(hash(lambent.draw('/cube.stl', { size: 96, turntable: 4 }, png)) === expected.turning, `${label}: a turntable is the program's animated PNG`);
  ok(hash(lambent.draw('/cube.stl', options, png)) === expected.cube, `${label}: a picture after a turntable`);
  const picture = lambent.draw('/cube.stl', options);
  ok(picture.width === 96 && picture.pixels instanceof Uint8ClampedArray && picture.pixels.length === 96 * 96 * 4 && Array.isArray(picture.warnings), `${label}: pixels`);
}

async function trySources() {
  const server = createServer((request, answer) => {
    if (request.url === '/missing.wasm') answer.writeHead(404).end();
    else answer.writeHead(200, { 'content-type': request.url === '/plain' ? 'text/plain' : 'application/wasm' }).end(wasm);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const base = `http://127.0.0.1:${server.address().port}`;
  const sources = { nothing: undefined, bytes: wasm, 'an ArrayBuffer': wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.length), 'a module': await WebAssembly.compile(wasm),
    'a URL': `${base}/lambent.wasm`, 'a URL object': new URL(`${base}/lambent.wasm`), 'a file URL': new URL(`file://${process.env.LAMBENT_WASM}`),
    'a Response': await fetch(`${base}/lambent.wasm`), 'a promise of one': fetch(`${base}/plain`) };
  for (const [label, source] of Object.entries(sources)) {
    const lambent = await open(source);
    lambent.files.set('/cube.stl', read('cube.stl'));
    ok(hash(lambent.draw('/cube.stl', options, png)) === expected.cube, `opened from ${label}`);
    lambent.dispose();
  }
  await refused(() => open(`${base}/missing.wasm`), 'LambentError', 'CANNOT_READ', 'found the answer 404');
  await refused(() => open(42), 'TypeError', 'BAD_ARGUMENT', 'open: found number as source');
  await refused(() => open(null), 'TypeError', 'BAD_ARGUMENT', 'open: found null as source');
  server.closeAllConnections();
  server.close();
}

async function tryErrors(lambent) {
  await refused(() => lambent.draw('/missing.stl'), 'LambentError', 'CANNOT_READ', '/missing.stl');
  await refused(() => lambent.draw('/cube.stl', { view: 'frint' }), 'LambentError', 'BAD_ARGUMENT', 'front');
  await refused(() => lambent.draw('/cube.stl', { sice: 4 }), 'LambentError', 'BAD_ARGUMENT', 'size');
  await refused(() => lambent.draw('/cube.stl', { turntable: 4 }), 'LambentError', 'BAD_ARGUMENT', 'make files');
  await refused(() => lambent.draw('/cube.stl', { turntable: 4 }, { as: 'jpg' }), 'LambentError', 'UNSUPPORTED', 'contains one picture');
  await refused(() => lambent.draw('/cube.stl', { size: 96 }, { as: 'gif' }), 'TypeError', 'BAD_ARGUMENT', 'png');
  await refused(() => lambent.draw('/cube.stl', { size: {} }), 'TypeError', 'BAD_ARGUMENT', 'found Object as options.size');
  await refused(() => lambent.draw('/cube.stl', { size: NaN }), 'TypeError', 'BAD_ARGUMENT', 'options.size');
  await refused(() => lambent.draw(new Uint8Array(3)), 'TypeError', 'BAD_ARGUMENT', 'found Uint8Array as model');
  await refused(() => lambent.draw('--help'), 'TypeError', 'BAD_ARGUMENT', 'model');
  await refused(() => lambent.draw(['/cube.stl', 5]), 'TypeError', 'BAD_ARGUMENT', 'a word');
  await refused(() => lambent.draw('/cube.stl', {}, { signal: 1 }), 'TypeError', 'BAD_ARGUMENT', 'signal');
  await refused(() => lambent.files.set('/a', 7), 'TypeError', 'BAD_ARGUMENT', 'found number as content');
  await refused(() => lambent.files.set(7, read('cube.stl')), 'TypeError', 'BAD_ARGUMENT', 'found number as path');
  await refused(() => lambent.files.set('/a', [1, 2]), 'TypeError', 'BAD_ARGUMENT', 'found an array as content');
  await refused(() => lambent.explain('/cube.stl', 0.5, 1), 'TypeError', 'BAD_ARGUMENT', 'found number as x');
  lambent.files.set('/package.3mf', read('package.3mf'));
  ok(hash(lambent.draw('/package.3mf', { size: 96 }, png)) === expected.package, 'a 3MF file has the same bytes as the program draws');
  for (const name of Object.keys(expected.refused)) {
    lambent.files.set(`/a.${name}`, Buffer.from(expected.refused[name], 'base64'));
    try {
      lambent.draw(`/a.${name}`, { size: 16 });
      ok(false, `${name} is refused`);
    } catch (error) {
      ok(error.code === 'UNSUPPORTED' && !/debian|lib\w+-dev|apt/i.test(error.message), `${name}: a sentence without Debian's packages`, `${error.code}: ${error.message}`);
    }
  }
  ok(hash(lambent.draw('/cube.stl', options, png)) === expected.cube, 'after errors it draws as before');
}

async function tryDecoders(lambent, label) {
  for (const name of ['draco', 'meshopt']) {
    lambent.files.set(`/${name}.gltf`, Buffer.from(expected.refused[`${name}.gltf`], 'base64'));
    ok(hash(await lambent.draw(`/${name}.gltf`, { size: 96 }, png)) === expected[name], `${label}: ${name} draws the program's bytes`);
  }
  lambent.dispose();
}

function tryFiles() {
  const files = new Files();
  files.set('/model.stl', read('cube.stl'));
  const lambent = new Lambent(new WebAssembly.Module(wasm), files);
  const cube = hash(lambent.draw('/model.stl', { size: 96 }, png));
  files.set('/model.stl', read('ball.stl'));
  const ball = hash(lambent.draw('/model.stl', { size: 96 }, png));
  ok(cube === expected.plainCube && ball === expected.ball, 'a file that is replaced is read anew');
  files.set('/text.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
  ok(files.has('/text.obj') && lambent.draw('/text.obj', { size: 16 }).triangles === 1, 'a text as a file');
  ok(files.delete('/text.obj') && !files.has('/text.obj'), 'a file is deleted');
  return lambent;
}

async function tryAborts(lambent) {
  const slow = { size: 1024, samples: 16, shadows: true };
  const shares = [], drawn = lambent.draw('torus-knot', slow, { onProgress: (share) => shares.push(share), as: 'png' });
  ok(drawn.length > 1000 && shares.length > 1 && shares.every((share, i) => share >= 0 && share <= 1 && (i === 0 || share >= shares[i - 1])), 'progress rises from 0 to 1', shares.join(' '));
  const control = new AbortController();
  await refused(() => lambent.draw('torus-knot', slow, { signal: control.signal, onProgress: () => control.abort() }), 'AbortError', 20, 'aborted');
  lambent.files.set('/cube.stl', read('cube.stl'));
  ok(hash(lambent.draw('/cube.stl', options, png)) === expected.cube, 'after an aborted drawing it draws as before');
  await refused(() => lambent.draw('/cube.stl', {}, { signal: AbortSignal.abort() }), 'AbortError', 20, 'aborted');
}

async function tryWorker() {
  const lambent = await openWorker(wasm);
  lambent.files.set('/cube.stl', read('cube.stl'));
  const [one, two] = await Promise.all([lambent.draw('/cube.stl', options, png), lambent.draw(words)]);
  ok(hash(one) === expected.cube && two.pixels.length === 96 * 96 * 4, 'a worker draws the same bytes');
  const shares = [];
  await lambent.draw('torus-knot', { size: 1024, samples: 16, shadows: true }, { onProgress: (share) => shares.push(share) });
  ok(shares.length > 1, 'a worker tells its progress');
  const start = Date.now();
  await refused(() => lambent.draw('torus-knot', { size: 4096, samples: 16, shadows: true }, { signal: AbortSignal.timeout(200) }), 'TimeoutError', 23, 'timeout');
  ok(Date.now() - start < 5000, 'a worker ends a drawing when its signal says so');
  ok(hash(await lambent.draw('/cube.stl', options, png)) === expected.cube, 'the next call has its files');
  await refused(() => lambent.draw('/missing.stl'), 'LambentError', 'CANNOT_READ', '/missing.stl');
  await refused(() => lambent.draw('/cube.stl', { size: {} }), 'TypeError', 'BAD_ARGUMENT', 'options.size');
  ok((await lambent.lights('/cube.stl', options)) !== undefined && (await lambent.describe()).options.length > 50, 'lights and options of a worker');
  const waiting = lambent.draw('torus-knot', { size: 4096, samples: 16, shadows: true });
  setTimeout(() => lambent.dispose(), 100);
  await refused(() => waiting, 'LambentError', 'DISPOSED', 'disposed');
  await refused(() => lambent.draw('/cube.stl'), 'LambentError', 'DISPOSED', 'disposed');
  await openWorker(wasm).then((idle) => idle.draw('cube', { size: 16 })); // not disposed: node still ends
}

const lambent = await open(wasm);
tryDrawing(lambent, 'node');
ok(typeof lambent.explain('/cube.stl', 48, 48, options) === 'object' && lambent.lights('/cube.stl', options) !== undefined && lambent.describe().shapes.includes('teapot'), 'explain, lights, describe');
await tryErrors(lambent);
await tryAborts(lambent);
lambent.dispose();
await refused(() => lambent.draw('/cube.stl'), 'LambentError', 'DISPOSED', 'disposed');
ok(new LambentError('a', 'LIMIT') instanceof Error, 'LambentError is exported');
tryFiles().dispose();
await trySources();
await tryDecoders(await open(undefined, { decoders: true }), 'open');
await tryDecoders(await openWorker(wasm, { decoders: true }), 'openWorker');
await tryWorker();
