// check.mjs MODULE RECORDED...: checks shaders with the module of the page and a painter that replays a file of classroom/tests/check/record_painter.c:
// each request must equal the recorded one, and gets the recorded answer; the report must also equal the recorded one. Standard input contains a
// line for each file, JSON {fragment, vertex, contract}. Prints lines of the Test Anything Protocol without numbers.
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { Check } from '../../web/check.js';

const COMPONENTS = [0, 1, 1, 1, 2, 3, 4, 9, 16, 4]; // for each lam_check_type
const FIRST_HASH = 2166136261;
const hash = (before, bytes) => bytes.reduce((sum, byte) => Math.imul(sum ^ byte, 16777619) >>> 0, before);

class Replay {
  #bytes;
  #at = 0;
  #memory;
  #inputs = new Map();
  #next = 1;
  #requested = []; // values since the last drawing
  #meshes = new Map();
  #last = null; // drawing: it is recorded once if it is requested twice in a row

  constructor(bytes) {
    this.#bytes = bytes;
  }

  attach(instance) {
    this.#memory = instance.exports.memory;
  }

  get imports() {
    return Object.fromEntries(['open', 'close', 'compile', 'input_count', 'input', 'forget', 'mesh', 'value', 'stream', 'draw'].map((name) => [name, (...all) => this[name](...all)]));
  }

  // --- the file

  take(letter) {
    const found = String.fromCharCode(this.#bytes[this.#at++]);
    if (found !== letter) throw new Error(`asked for ${letter}, recorded is ${found} at ${this.#at - 1}`);
  }

  number() {
    this.#at += 4;
    return this.#bytes.readUInt32LE(this.#at - 4);
  }

  text() {
    const end = this.#bytes.indexOf(0, this.#at), text = this.#bytes.subarray(this.#at, end);
    this.#at = end + 1;
    return text;
  }

  rest() {
    return this.#bytes.subarray(this.#at).toString();
  }

  expect(what, found) {
    const recorded = this.number();
    if (recorded !== found) throw new Error(`${what} is not the recorded one: ${found}, ${recorded}`);
  }

  // --- the module's memory

  memory(at, size) {
    return new Uint8Array(this.#memory.buffer, at, size);
  }

  string(at) {
    const bytes = this.memory(at);
    return bytes.subarray(0, bytes.indexOf(0));
  }

  put(at, text) {
    this.memory(at, text.length + 1).set([...text, 0]);
  }

  putNumbers(at, ...numbers) {
    new Int32Array(this.#memory.buffer, at, numbers.length).set(numbers);
  }

  // --- the painter

  open(size, renderer) {
    this.take('O');
    this.put(renderer, this.text());
    return this.#next++;
  }

  close() {}

  compile(place, vertex, fragment, refused, vertexLog, fragmentLog, linkLog) {
    this.take('C');
    this.#last = null;
    this.expect('the text of a program', hash(hash(FIRST_HASH, this.string(vertex)), this.string(fragment)));
    const built = this.number();
    this.putNumbers(refused, this.number());
    for (const log of [vertexLog, fragmentLog, linkLog]) this.put(log, this.text());
    const inputs = [];
    for (let count = this.number(); count > 0; count--) inputs.push({ name: Buffer.from(this.text()), numbers: [this.number(), this.number(), this.number()] });
    this.#inputs.set(this.#next, inputs);
    return built ? this.#next++ : 0;
  }

  input_count(program) {
    return this.#inputs.get(program).length;
  }

  input(program, index, name, capacity, numbers) {
    const input = this.#inputs.get(program)[index];
    this.put(name, input.name);
    this.putNumbers(numbers, ...input.numbers);
  }

  forget(program) {
    this.#inputs.delete(program);
  }

  mesh(place, number, vertices, indexCount, positions, normals, tangents, indices) {
    let all = FIRST_HASH;
    for (const [at, size] of [[positions, vertices * 12], [normals, vertices * 16], [tangents, vertices * 12], [indices, indexCount * 2]]) all = hash(all, this.memory(at, size));
    this.#meshes.set(number, all);
  }

  value(program, input, first, count, numbers) {
    const components = COMPONENTS[this.#inputs.get(program)[input].numbers[0]];
    this.#requested.push(new Uint8Array(Int32Array.of(input, first, count).buffer), this.memory(numbers, 4 * count * components).slice());
  }

  stream(program, input, components, vertices, numbers) {
    this.#requested.push(new Uint8Array(Int32Array.of(input, components).buffer), this.memory(numbers, 4 * vertices * components).slice());
  }

  draw(place, program, mesh, indexCount, position, normal, tangent, cull, pixels) {
    const how = new Uint8Array(Int32Array.of(position, normal, tangent, cull).buffer), size = 16 * SIZE * SIZE;
    const drawing = [...this.#requested, how].reduce(hash, this.#meshes.get(mesh));
    this.#requested = [];
    if (this.#last?.drawing !== drawing) {
      this.take('D');
      this.expect('a drawing', drawing);
      this.#last = { drawing, pixels: this.#bytes.subarray(this.#at, this.#at + size) };
      this.#at += size;
    }
    this.memory(pixels, size).set(this.#last.pixels);
    return 0;
  }
}

const SIZE = 40; // TEST_SIZE of record_painter.c
const [, , wasm, ...files] = process.argv;
const module = new WebAssembly.Module(readFileSync(wasm));
const asked = readFileSync(0, 'utf8').split('\n').filter(Boolean).map((line) => JSON.parse(line));
const ok = (good, label, why) => console.log(`${good ? 'ok' : 'not ok'} ${label}${good ? '' : `\n# ${why}`}`);

for (const [i, file] of files.entries()) {
  const replay = new Replay(readFileSync(file));
  const check = new Check(module, replay);
  try {
    const report = check.check({ ...asked[i], size: SIZE });
    replay.take('J');
    const recorded = JSON.parse(replay.rest());
    ok(JSON.stringify(report) === JSON.stringify(recorded), `${basename(file)}: ${report.verdict} ${report.mistakes.map((m) => m.id).join(' ')}`,
      `recorded is ${JSON.stringify(recorded).slice(0, 600)}, found ${JSON.stringify(report).slice(0, 600)}`);
    const pictures = report.scenes.flatMap((_, scene) => ['theirs', 'reference', 'difference'].map((which) => check.picture(scene, which, SIZE)));
    ok(pictures.every((picture) => picture?.length === 4 * SIZE * SIZE), `${basename(file)}: its pictures`, '');
  } catch (error) {
    ok(false, basename(file), error.message);
  }
}
// A painter that accepts every shader.
class Accepting extends Replay {
  open(size, renderer) {
    this.put(renderer, Buffer.from('accepts'));
    return 1;
  }

  compile(place, vertex, fragment, refused, ...logs) {
    this.putNumbers(refused, 0);
    for (const log of logs) this.put(log, Buffer.alloc(0));
    return 1;
  }

  input_count() {
    return 0;
  }

  mesh() {}

  draw() {
    return 0;
  }
}

const empty = new Check(module, new Accepting(Buffer.alloc(0)));
const refused = (asked) => {
  try {
    return JSON.stringify(empty.check(asked));
  } catch (error) {
    return error.message;
  }
};
ok(refused({ fragment: 'void main() {}' }).startsWith('no verdict: the names match no known contract'), 'a shader of no contract is refused', refused({ fragment: 'void main() {}' }));
ok(refused({ fragment: 'void main() {}', contract: 'x' }) === "there is no contract 'x'", 'a contract that is not there is refused', refused({ fragment: '', contract: 'x' }));
const lists = empty.lists();
ok(lists.contracts.length >= 10 && lists.mistakes.length > 50 && lists.scenes.length > 10, 'the lists', JSON.stringify(lists).slice(0, 200));
const { texts, correct, highlight } = empty.exercise('reflect-sign');
ok(highlight === 'phong' && texts.vertex === correct.vertex && correct.fragment.includes('reflect(-L, N)') && texts.fragment === correct.fragment.replace('reflect(-L, N)', 'reflect(L, N)'), 'an exercise', texts.fragment);
ok(lists.exercises.every(({ mistake, looks, wrong }) => looks && wrong && empty.exercise(mistake).texts), 'every exercise is made', JSON.stringify(lists.exercises));
try {
  ok(false, 'an exercise that is not there', JSON.stringify(empty.exercise('x')));
} catch (error) {
  ok(error.message === "mistake 'x' is not known; expected one of lam_shader_mistake_row", 'an exercise that is not there is refused', error.message);
}
