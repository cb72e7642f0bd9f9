// worker.js: draws in a separate thread. Messages: {id, call, ...}. Answers: {id, result}, {id, error, cancelled}, {progress} or {id, missing}. `progress` is
// the finished fraction of the running call. `missing` is a part of the module that the call needs. The page then fetches the part and sends the call again. If
// several drawings wait, the page sends only the newest one.
import { Decoders } from '../../decoders.js';
import { Lambent, LambentError, PartMissing } from '../../lambent.js';

const parts = new Map(); // by name, if the module is divided
let lambent = null, decoders = null, first = null, broken = null, memory = 0;
let threaded = null; // the module with threads, and the number of threads

let model = null; // the last drawn model

const progress = (share) => self.postMessage({ progress: share });

function use(made) {
  lambent = made;
  lambent.decoders = decoders;
  lambent.limitMemory(memory);
  broken = null;
}

async function useThreads() {
  const { openThreads } = await import('../../threads.js'), { module, count, script } = threaded;
  use(await openThreads(module, count, () => new Worker(script, { type: 'module' }), lambent.files, progress, parts.has('threads-more') ? [parts.get('threads-more')] : []));
}

// Informs the page about the threads; `flag` is the address of the cancel flag in their memory.
const aboutThreads = () => ({ threads: lambent.threads, shared: lambent.instance.exports.memory.buffer, flag: lambent.instance.exports.web_cancel_flag() });

// The part of a divided module that each of these calls needs. The part is downloaded before the call, because a call that stops at a missing part loses the
// model.
const NEEDS = { explain: 'more', curves: 'more', lights: 'more', scene: 'more', contents: 'more' };
const neededPart = ({ call, parted }) => parted && NEEDS[call] && (threaded ? 'threads-' : '') + NEEDS[call];

const calls = {
  async start({ wasm, memory: bytes }) {
    memory = bytes;
    first = await WebAssembly.compile(wasm);
    use(new Lambent(first, undefined, { progress }));
    return lambent.options();
  },
  // Adds a part of the module, or replaces the module by the module with threads. A Lambent that has stopped at a missing part is replaced by a new one. Any
  // other Lambent receives the part.
  async complete({ part, wasm, threads }) {
    if (threads) {
      threaded = { module: await WebAssembly.compile(wasm), ...threads };
      await useThreads().catch((error) => {
        threaded = null;
        throw error;
      });
      return aboutThreads();
    }
    if (part === 'decoders') {
      lambent.decoders = decoders = new Decoders(await WebAssembly.compile(wasm));
      lambent.forget();
      return { threads: lambent.threads ?? 1 };
    }
    parts.set(part, await WebAssembly.compile(wasm));
    if (threaded && broken) {
      lambent.end();
      await useThreads();
    } else if (broken) use(new Lambent(first, lambent.files, { parts: [...parts.values()], progress }));
    else lambent.complete(parts.get(part));
    return threaded ? aboutThreads() : { threads: 1 };
  },
  files({ files }) {
    for (const path of lambent.files.list()) lambent.files.delete(path);
    for (const [path, bytes] of files) lambent.files.set(path, bytes);
    lambent.forget();
    model = null;
    return null;
  },
  // `missing` contains the paths that the reader has not found.
  draw({ words }) {
    if (model !== words[0]) for (const paths of [lambent.files.absent, lambent.files.used]) paths.clear();
    model = words[0];
    return { ...lambent.draw(words), missing: [...lambent.files.absent] };
  },
  save: ({ words, ending }) => lambent.save(words, ending),
  explain: ({ words, x, y }) => lambent.explain(words, x, y),
  curves: ({ words, of }) => lambent.curves(words, of),
  lights: ({ words }) => lambent.lights(words),
  scene: ({ words }) => lambent.scene(words),
  contents: ({ words }) => lambent.contents(words),
  // Returns the bytes of a file.
  file: ({ path }) => lambent.files.get(path).slice(),
  // Returns the files from which the last picture's model was read, as [path, bytes].
  used: () => [...lambent.files.used].filter((path) => lambent.files.get(path)).map((path) => [path, lambent.files.get(path).slice()]),
};

self.onmessage = async ({ data }) => {
  try {
    if (broken && data.call !== 'complete') throw new PartMissing(broken);
    const needed = neededPart(data);
    if (needed && !parts.has(needed)) return self.postMessage({ id: data.id, missing: needed });
    const result = await calls[data.call](data);
    if (lambent.wantsDecoders && !decoders) return self.postMessage({ id: data.id, missing: 'decoders' });
    const moved = result?.pixels ? [result.pixels.buffer] : [];
    self.postMessage({ id: data.id, result }, moved);
  } catch (error) {
    if (error instanceof LambentError && lambent.wantsDecoders && !decoders) self.postMessage({ id: data.id, missing: 'decoders' });
    else if (error instanceof PartMissing) {
      broken = error.part;
      self.postMessage({ id: data.id, missing: error.part });
    } else self.postMessage({ id: data.id, error: error.message, cancelled: error instanceof LambentError && error.cancelled, missing_files: [...(lambent?.files.absent ?? [])] });
  }
};
