// split.mjs COUNTING PROFILE: draws the first pictures of a visit, with a module instrumented by wasm-split, and writes a profile of the called functions.
// web/build.py puts these functions into the first part of the module.
import { readFileSync, writeFileSync } from 'node:fs';
import { Lambent } from './lambent.js';
import { around, cameraText, orbit } from './page/words/camera.js';
import { START } from './page/words/state.js';

const [, , counting, profile] = process.argv;
let instance = null;
const Instance = WebAssembly.Instance;
WebAssembly.Instance = function (...given) {
  return (instance = new Instance(...given));
};

const lambent = new Lambent(new WebAssembly.Module(readFileSync(counting)));
lambent.limitMemory(1e9);
lambent.options();
// The first picture, and the same model from another side with all samples and as during a gesture (quickWords in page/picture/drawing.js).
for (const size of ['320x344', '944x656', '472x328']) {
  const words = [...START, `--size=${size}`], { camera, sphere } = lambent.draw(words);
  const turned = cameraText(orbit(around(camera, sphere, 1.4), 0.3, 0.2, camera.pole, sphere.centre));
  for (const samples of [[], ['--samples=1', '--bounces=0']]) lambent.draw([...words, `--camera=${turned}`, ...samples]);
}
const { memory, __write_profile } = instance.exports, size = __write_profile(0, 0), at = memory.buffer.byteLength;
memory.grow(Math.ceil(size / 65536));
__write_profile(at, size);
writeFileSync(profile, new Uint8Array(memory.buffer, at, size));
