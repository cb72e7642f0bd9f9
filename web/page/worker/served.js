// served.js: used in the page of `lambent view` (tools/view). Models come from the folder that the program shows. The program itself draws models that are too
// large for the page.
// Addresses are relative to the page's own address, which contains the token.
import { Ended } from './caller.js';
import { text } from '../base/strings.js';

// `gallery` is true if the viewer shows a folder.
export const served = JSON.parse(document.getElementById('served').textContent);

const client = crypto.randomUUID(); // a newer picture of this page cancels the older one
// Fetches the module with threads (start.js), which the viewer serves beside the page.
export const fetchThreads = async () => bytesOf(await ask('threads.wasm', []));

let known = null; // the last requested model, with the reason why the program draws it, or null if the module has its files
let drawing = null; // aborts the request of a picture

async function ask(address, words, { signal, ...more } = {}) {
  const query = new URLSearchParams([...words.map((word) => ['w', word]), ['c', client], ...Object.entries(more)]);
  const answer = await fetch(`${address}?${query}`, { signal });
  if (!answer.ok) throw new Error(await answer.text());
  return answer;
}

const bytesOf = async (answer) => new Uint8Array(await answer.arrayBuffer());

async function fileOf(path) {
  const answer = await fetch('files' + path.split('/').map(encodeURIComponent).join('/'));
  if (!answer.ok) throw new Error(`${path.slice(1)}: ${await answer.text()}`);
  return [path, await bytesOf(answer)];
}

// Returns the facts about the model. The module then has its files, unless the program draws it.
async function take(call, words) {
  const key = [words[0], ...words.filter((word) => /^--(environment|reflection-map)=/.test(word))].join('\n');
  if (known?.key === key && !known.stale) return known;
  const taken = (known = { key, stale: true, paths: new Set([words[0]]), native: null });
  const about = await (await ask('model', words)).json();
  for (const path of [...about.files.map((file) => file.path), ...about.missing]) taken.paths.add(path);
  taken.native = about.native;
  taken.stale = false;
  try {
    if (!about.native) await call('files', { files: await Promise.all(about.files.map((file) => fileOf(file.path))) });
  } catch (error) {
    taken.stale = true;
    throw error;
  }
  return taken;
}

let last = Promise.resolve();

const natively = {
  // Draws pictures one after the other, because a picture and the picture that it is compared with are requested at the same time.
  draw({ words }) {
    const next = last.then(() => drawNow(words));
    last = next.catch(() => {});
    return next;
  },
  save: async ({ words }) => bytesOf(await ask('picture', words)),
  explain: async ({ words, x, y }) => (await ask('explain', words, { x, y })).json(),
};

async function drawNow(words) {
  const own = (drawing = new AbortController());
  const bytes = await ask('draw', words, { signal: own.signal }).then(bytesOf).catch((error) => {
    throw own.signal.aborted ? new Ended() : error;
  }).finally(() => (drawing = drawing === own ? null : drawing));
  const end = bytes.indexOf(10); // a line of JSON, then RGBA
  return { ...JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))), pixels: new Uint8ClampedArray(bytes.buffer, end + 1) };
}

// Cancels the picture that the program is drawing, because a newer picture is wanted. Returns false if the program is not drawing.
export function giveUpPicture() {
  drawing?.abort();
  return Boolean(drawing);
}

// Returns the reason why the program draws the model, or null if the page draws it.
export const nativeReason = (model) => (known?.key.split('\n')[0] === model ? known.native : null);

// Returns a function that calls the worker and first sends it the files of a served model. The files of models that were opened in the page are not fetched.
export function servedCall(call) {
  let own = [], holdsOwn = false;
  return async (name, message) => {
    if (name === 'files') {
      own = message.files;
      holdsOwn = true;
      known = null;
      return call(name, message);
    }
    const model = message.words?.[0];
    if (!model?.startsWith('/')) return call(name, message);
    if (own.some(([path]) => path === model)) {
      if (!holdsOwn) await call('files', { files: own });
      holdsOwn = true;
      known = null;
      return call(name, message);
    }
    const { native } = await take(call, message.words);
    holdsOwn = false;
    if (native && !natively[name]) throw new Error(text('notByProgram'));
    return native ? natively[name](message) : call(name, message);
  };
}

// Calls `changed` if a file of the model has changed. Calls `lost` with true if the viewer has ended, and with false if it is back.
export function watchServed(changed, lost) {
  const events = new EventSource('events');
  let timer = 0, isLost = false;
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      if (known) known.stale = true;
      changed();
    }, 100); // several files are often written together
  };
  events.onmessage = ({ data }) => {
    const path = JSON.parse(data); // the path of a file, or with a trailing "/" the path of a folder in which any file may have changed
    if (known?.paths.has(path) || (path.endsWith('/') && [...(known?.paths ?? [])].some((one) => one.startsWith(path)))) later();
  };
  events.onerror = () => lost((isLost = true));
  events.onopen = () => {
    if (!isLost) return;
    lost((isLost = false));
    later();
  };
}
