// shaders.js: the tab of shaders: texts, what they draw beside the reference, the verdict of `lambent check` and the mistakes that it names;
// exercises are programs with a known mistake.
import './shader_strings.js';
import { openCheck } from './check_start.js';
import { $, button, element, ours } from './dom.js';
import { EXERCISES, PROGRAMS } from './programs.js';
import { makeEditor } from './shader_editor.js';
import { report } from './shader_report.js';
import { text } from './strings.js';

const SIZE = 128, TYPING_MS = 350, ENDLESS_MS = 30000;

const place = $('panel-shaders');
const contracts = element('select', { id: 'shader-contract', translate: false });
const tasks = element('select', { id: 'shader-task' });
const verdict = element('p', { id: 'shader-verdict', attributes: { role: 'status' }, textContent: text('shaderWaits') });
const found = element('div', { id: 'shader-report' });
const names = element('details', { id: 'shader-names' }, element('summary', { textContent: text('shaderNames') }), element('table', { translate: false }));
const places = { fragment: element('div', { className: 'shader-text' }), vertex: element('div', { className: 'shader-text' }) };
const hint = button('shaderAskHint', () => {
  asked.hints++;
  show();
});

place.append(
  element('p', { className: 'hint', textContent: text('shaderHint') }),
  element('div', { className: 'buttons shader-bar' }, element('label', { textContent: text('shaderContract') + ' ' }, contracts),
    element('label', { textContent: text('shaderTask') + ' ' }, tasks), button('shaderReset', () => begin()), hint),
  verdict,
  element('div', { className: 'shader-texts' }, element('section', {}, element('h3', { textContent: text('shaderFragment') }), places.fragment),
    element('section', {}, element('h3', { textContent: text('shaderVertexMade') }), places.vertex)),
  found, names);

// --- checking: the newest texts alone

let check = null, started = null; // the worker, and the promise of its lists
let asked = { hints: 0, exercise: false }; // what the report is about
let shown = null; // the last report
let round = 0, timer = 0, searching = false;

function restart() {
  check?.end();
  check = openCheck();
  started = check.call('start', {});
  searching = false;
}

// A report, or null where newer texts came in between.
async function ask(mine, pictures) {
  const late = new Promise((resolve) => setTimeout(resolve, ENDLESS_MS, 'late'));
  await started;
  const answer = await Promise.race([late, check.call('check', { fragment: editors.fragment.text, vertex: editors.vertex.text, contract: contracts.value, size: SIZE, pictures })]);
  if (mine !== round) return null;
  if (answer !== 'late') return answer;
  restart();
  return { verdict: 'endless', mistakes: [], notes: [], scenes: [] };
}

async function run() {
  const mine = ++round;
  if (searching) restart();
  verdict.textContent = text('shaderWaits');
  try {
    const quick = await ask(mine, 1); // pictures and verdict, without a search
    if (!quick) return;
    shown = { ...quick, searched: quick.verdict !== 'differs' };
    show();
    if (shown.searched) return;
    searching = true;
    const whole = await ask(mine, 0);
    if (!whole) return;
    searching = false;
    shown = { ...whole, searched: true };
    show();
  } catch (error) {
    if (mine !== round) return;
    shown = { verdict: 'fails', mistakes: [], notes: [{ kind: 'hint', file: null, line: 0, text: error.message }], scenes: [], searched: true };
    show();
  }
}

function changed() {
  clearTimeout(timer);
  timer = setTimeout(run, TYPING_MS);
}

function show() {
  verdict.dataset.verdict = shown?.verdict ?? '';
  verdict.dataset.searched = String(shown?.searched ?? false);
  hint.hidden = !asked.exercise;
  if (!shown) return;
  const { sentence, content } = report(shown, asked, SIZE, (file, line) => editorOf(file).goTo(line));
  verdict.textContent = sentence;
  found.replaceChildren(...content);
  for (const [kind, editor] of Object.entries(editors))
    editor.showErrors(shown.notes.filter(({ file, line }) => line && file && editorOf(file) === editors[kind]).map(({ line, text }) => ({ line, text })));
}

// --- programs

const editors = {};
const editorOf = (file) => (file.endsWith('.vert') ? editors.vertex : editors.fragment);
const named = (name) => PROGRAMS.find((program) => program.name === name);

// The texts of a program of the list: correct, or with the edits of an exercise.
function textsOf(value) {
  const [kind, which] = value.split(':');
  if (kind === 'program') return { ...named(which) };
  const { program, edits } = EXERCISES[Number(which)], texts = { ...named(program) };
  for (const [part, old, wrong] of edits) texts[part] = texts[part].replace(old, () => wrong);
  return texts;
}

function begin() {
  const texts = textsOf(tasks.value);
  editors.fragment.text = texts.fragment;
  editors.vertex.text = texts.vertex;
  asked = { hints: 0, exercise: tasks.value.startsWith('exercise:') };
  shown = null;
  found.replaceChildren();
  show();
  run();
}

function chooseContract(lists) {
  const mine = PROGRAMS.filter(({ contract }) => contract === contracts.value);
  const exercises = [...EXERCISES.entries()].filter(([, { program }]) => mine.some(({ name }) => name === program));
  tasks.replaceChildren(
    ...mine.map(({ name }) => element('option', { value: `program:${name}`, textContent: text('shaderCorrect', { name }) })),
    ...exercises.map(([index], i) => element('option', { value: `exercise:${index}`, textContent: text('shaderExercise', { number: i + 1 }) })));
  const contract = lists.contracts.find(({ name }) => name === contracts.value);
  names.lastChild.replaceChildren(...contract.names.map((row) => element('tr', {}, ours('td', row.name), ours('td', row.type), ours('td', row.meaning))));
  begin();
}

async function start() {
  restart();
  editors.fragment = await makeEditor(places.fragment, { label: text('shaderFragment'), onchange: changed });
  editors.vertex = await makeEditor(places.vertex, { label: text('shaderVertex'), onchange: changed });
  const lists = await started;
  const usable = lists.contracts.filter(({ name }) => PROGRAMS.some(({ contract }) => contract === name));
  contracts.replaceChildren(...usable.map(({ name, title }) => element('option', { value: name, textContent: title })));
  contracts.onchange = () => chooseContract(lists);
  tasks.onchange = begin;
  chooseContract(lists);
}

start().catch((error) => (verdict.textContent = text('shaderNoPlace', { error: error.message })));
