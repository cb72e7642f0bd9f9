// drawing.js: draws the command line in the worker and fits the picture to the stage. During a gesture, pictures have one sample and fewer pixels (pace.js).
// When the pointer rests, the full picture is drawn. If several drawings wait, only the newest one is drawn. Outdated drawings are ended, and the Stop button
// ends any drawing.
import { call, emit, on, plainNames, refuse, say, state, view, worker } from '../shared/app.js';
import { Ended } from '../worker/caller.js';
import { planesOf } from '../words/camera.js';
import { $, button } from '../base/dom.js';
import { Pace } from './pace.js';
import { text } from '../base/strings.js';
import { finished, isTooLong, started, stopped } from './unfinished.js';

const canvas = $('canvas'), context = canvas.getContext('2d'), pace = new Pace();
const PATIENCE_MS = 1000, SHOWN_MS = 400, FLAG_MS = 50;
const REST_MS = 50; // the full picture is drawn if a gesture makes no step for this long
const SHORT_MS = 200; // a full picture that takes less time is drawn when the pointer rests, even if no flag can end the drawing
let running = null, wanted = null, model = null;
let shown = null, whole_ms = 0; // the model of the shown picture; the time of the last full picture, without reading the model
let resting = 0, sharp = null; // the task of the full picture that was started when the pointer rested

// Returns the words of a quick picture, which has one sample and fewer pixels.
export function quickWords(words) {
  const [, width, height = width] = /^(\d+)(?:x(\d+))?$/.exec(state.values('size').at(-1) ?? (view.size ? `${view.size.width}x${view.size.height}` : '1024')) ?? [], few = words.filter((word) => !word.startsWith('--samples'));
  const scale = pace.scale(width * height);
  const sized = scale < 1 ? [...few.filter((word) => !word.startsWith('--size')), `--size=${Math.round(width * scale)}x${Math.round(height * scale)}`] : few;
  return [...sized, '--samples=1', '--bounces=0'];
}

// Returns the words of the pictures that are shown one after the other. Paths of light take long: local lighting and few paths come before.
function steps({ words, quick }) {
  if (quick) return [quickWords(words)];
  const bounces = words.findLast((word) => /^--bounces=[1-9]/.test(word)), others = words.filter((word) => !/^--(bounces|paths|noise|stop-after)=/.test(word));
  return bounces ? [[...others, '--bounces=0'], [...others, bounces, '--paths=8'], words] : [words];
}

// Draws the steps of a task, and shows all of them but the last, which it returns. A newer task ends it.
async function drawSteps(task) {
  let picture = null;
  for (const words of steps(task)) {
    if (picture) show(picture, { ...task, quick: true });
    if (wanted && !task.quick) throw new Ended();
    picture = await call('draw', { words, endable: true });
  }
  return picture;
}

// A drawing in progress in the worker. `done` is the finished fraction. Reading the model is the first half.
class Running {
  constructor(task) {
    Object.assign(this, { task, done: 0, isEnding: false, isStopped: false, timers: [] });
    if (!task.quick || task.words[0] !== model) this.#after(SHOWN_MS, () => ($('working').hidden = false));
  }

  #after(ms, act) {
    this.timers.push(setTimeout(act, ms));
  }

  // Ends an outdated drawing by the flag. If the drawing does not end, restarts the worker after a second, or after twice the time for reading the model,
  // whichever is longer. A restarted worker must read the model again. `now` means that the user has pressed Stop. Without a flag, the worker is then
  // restarted at once.
  end({ now = false } = {}) {
    if (view.giveUpPicture?.() || (this.isEnding && !now)) return;
    this.isEnding = true;
    this.isStopped ||= now;
    const flagged = this.#raise();
    this.#endWorker(now && !flagged ? 0 : Math.max(PATIENCE_MS, 2 * (view.picture?.read_ms ?? 0)));
  }

  #raise() {
    const flagged = worker.cancel();
    if (flagged) this.#after(FLAG_MS, () => this.#raise()); // a call clears the flag when it starts, so the flag is set repeatedly
    return flagged;
  }

  // Lets the worker finish reading a model that is still wanted, unless the user has pressed Stop.
  #endWorker(ms) {
    this.#after(ms, () => {
      const [name] = this.task.words;
      if (!this.isStopped && this.done < 0.5 && name !== model && wanted?.words[0] === name) return this.#endWorker(PATIENCE_MS);
      model = null;
      worker.restart();
    });
  }

  close() {
    for (const timer of this.timers) clearTimeout(timer);
    $('working').hidden = true;
    $('progress').removeAttribute('value');
  }
}

worker.onprogress = (share) => {
  if (!running) return;
  running.done = share;
  $('progress').value = share;
};

function draw(quick = false) {
  wanted = { words: state.words, quick };
  if (!running) work();
  else if (!running.task.quick || running.task.words[0] !== state.model) running.end();
}

// Draws the full picture while the gesture rests. The gesture may continue.
function sharpen() {
  draw();
  sharp = wanted ?? running.task;
}

// Draws a quick picture during a gesture. Otherwise draws the full picture, unless it is already shown or in progress.
function drawNow() {
  clearTimeout(resting);
  const isSharp = !view.moving && sharp?.words === state.words, { picture } = sharp ?? {};
  sharp = null;
  if (!isSharp) draw(view.moving);
  else if (picture) rest(picture, 'picture', 'still');
  if (view.moving && (worker.endsByFlag() || whole_ms < SHORT_MS)) resting = setTimeout(sharpen, REST_MS);
}

// Called when this picture is shown and no gesture is in progress. `events` are the events that listeners have not received yet.
function rest({ camera, sphere }, ...events) {
  Object.assign(view, { camera: { ...camera, ...planesOf(state.values('camera').at(-1)) }, sphere });
  events.forEach(emit);
}

async function work() {
  while (wanted) {
    const task = wanted;
    wanted = null;
    running = new Running(task);
    if (!task.quick) started(task.words);
    const [name] = task.words, began = performance.now();
    try {
      if (name !== model) forgetModel(name);
      canvas.setAttribute('aria-busy', String(name !== model));
      const picture = await drawSteps(task);
      if (!task.quick) finished();
      show(picture, task);
      measure(task, performance.now() - began - (name === model ? 0 : picture.read_ms));
      model = name;
    } catch (error) {
      $('status').textContent = '';
      finished();
      if (task === sharp) sharp = null;
      if (running.isStopped) stopped(task.words);
      if (!wanted && error instanceof Ended) refuseStopped();
      else if (!wanted) refused(error);
    }
    running.close();
    running = null;
    canvas.setAttribute('aria-busy', 'false');
  }
  rested();
}

// Before the first picture of a model there is no camera that keys could move, so they reach the button.
function refuseStopped() {
  const again = button('drawAgain', () => draw());
  refuse(text(state.model === shown ? 'stopped' : 'stoppedFirst'), again);
  $('view').classList.toggle('empty', state.model !== shown);
  if (state.model !== shown) again.focus();
}

function rested() {
  view.isIdle = true;
  emit('idle');
}

function measure(task, ms) {
  if (task.quick) pace.measured(ms);
  else whole_ms = ms;
}

// Removes the warnings and measurements of the previous model before another model is read.
function forgetModel(name) {
  $('status').textContent = text('loadingModel', { name: name.replace(/^\//, '') });
  $('warnings').textContent = '';
  pace.reset();
  view.missing = [];
  view.refusal = null;
  emit('missing');
}

// The picture of another model disappears. If files are missing, files.js shows the message together with possible actions.
function refused(error) {
  $('view').classList.toggle('empty', state.model !== shown);
  view.missing = error.missing ?? [];
  if (!view.missing.length) return refuse(error.message);
  view.refusal = error.message;
  emit('missing');
}

// Ends the drawing. The Stop button calls this function, and so does the Escape key during a long drawing.
function stop() {
  if (!running) return;
  wanted = null;
  $('status').textContent = text('stopping');
  running.end({ now: true });
}
$('stop').onclick = stop;
addEventListener('keydown', (event) => event.key === 'Escape' && !$('working').hidden && stop());

function show({ pixels, ...picture }, task) {
  canvas.width = picture.width;
  canvas.height = picture.height;
  context.putImageData(new ImageData(pixels, picture.width, picture.height), 0, 0);
  view.picture = picture;
  [shown] = task.words;
  $('view').classList.remove('empty');
  view.missing = picture.missing ?? [];
  view.refusal = null;
  if (!task.quick || !view.size) view.size = { width: picture.width, height: picture.height };
  if (task === sharp) task.picture = picture;
  if (!view.moving) rest(picture);
  document.body.dataset.drawn = task.quick ? '' : JSON.stringify(task.words);
  $('message').hidden = true;
  showStatus(picture);
  fit();
  emit('missing');
  emit('picture');
  if (!task.quick && !view.moving) rest(picture, 'still');
}

function showStatus({ width, height, triangles, frame_ms, warnings }) {
  const line = text('status', { width, height, triangles: triangles.toLocaleString('en'), ms: Math.round(frame_ms) });
  $('status').textContent = line;
  // The message below the picture lists the missing files.
  $('warnings').textContent = warnings.filter((one) => $('served') || !/No such file/.test(one)).map(plainNames).join(' · ');
}

// Makes the picture as large as possible, centred. If the picture is enlarged by three or more, its pixels appear as squares.
export function fit() {
  const { width, height } = view.size ?? canvas, room = $('view'), k = Math.min(room.clientWidth / width, room.clientHeight / height);
  const box = { left: (room.clientWidth - k * width) / 2, top: (room.clientHeight - k * height) / 2, width: k * width, height: k * height };
  for (const one of [canvas, $('overlay')]) for (const [name, value] of Object.entries(box)) one.style[name] = `${value}px`;
  canvas.style.imageRendering = k * devicePixelRatio >= 3 ? 'pixelated' : 'auto';
  emit('fit');
}
new ResizeObserver(fit).observe($('view'));

// The first picture is not drawn if the same picture took too long before the page was reloaded.
let isFirst = true;
on('words', () => {
  if (isFirst && isTooLong(state.words)) refuse(text('tooLong'), button('drawAgain', () => draw())), rested();
  else drawNow();
  isFirst = false;
});

// Announces the direction of the view to screen readers after a gesture.
let heard = null, last = '';
on('still', () => {
  clearTimeout(heard);
  const { camera, sphere } = view.picture, [x, y, z] = camera.eye.map((part, i) => part - camera.target[i]), [px, py, pz] = camera.pole;
  const far = Math.hypot(x, y, z), above = Math.round((Math.asin((x * px + y * py + z * pz) / far) * 180) / Math.PI);
  const around = Math.round((Math.atan2(x, py > 0.5 ? z : -y) * 180) / Math.PI), sentence = text('viewChanged', { around, above, far: (far / sphere.radius).toFixed(1) });
  if (last && sentence !== last) heard = setTimeout(() => say(sentence), 700);
  last = sentence;
});
