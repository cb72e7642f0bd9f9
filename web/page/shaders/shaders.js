// shaders.js: the tab of shaders. It shows the texts of shaders, their pictures beside the reference, and the verdict of `lambent check` with the mistakes that
// it has found. Exercises are programs with a known mistake. The module makes these programs.
import './shader_strings.js';
import { $, button, element, ours } from '../base/dom.js';
import { PROGRAMS } from './programs.js';
import { Checks } from './shader_checks.js';
import { makeEditor } from './shader_editor.js';
import { HINTS, report, withoutOptions } from './shader_report.js';
import { text } from '../base/strings.js';

const SIZE = 128, TYPING_MS = 350;

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
const again = button('shaderAgain', () => open(), { hidden: true });

place.append(
  element('p', { className: 'hint', textContent: text('shaderHint') }),
  element('div', { className: 'buttons shader-bar' }, element('label', { textContent: text('shaderContract') + ' ' }, contracts),
    element('label', { textContent: text('shaderTask') + ' ' }, tasks), button('shaderReset', () => start()), hint),
  verdict, again,
  element('div', { className: 'shader-texts' }, element('section', {}, element('h2', { textContent: text('shaderFragment') }), places.fragment),
    element('section', {}, element('h2', { textContent: text('shaderVertexMade') }), places.vertex)),
  found, names);

// --- checks of the newest texts

const checks = new Checks();
let asked = { hints: 0, exercise: null }; // the subject of the report
let shown = null; // the last report
let own = false; // whether the texts are another program than the chosen one
let timer = 0;

async function run() {
  clearTimeout(timer);
  verdict.textContent = text('shaderWaits');
  const texts = { fragment: editors.fragment.text, vertex: editors.vertex.text };
  const highlight = asked.exercise?.highlight ?? '';
  // The program recognises the names of a text that the page did not write.
  await checks.run({ ...texts, contract: own ? '' : contracts.value, highlight, size: SIZE }, (report) => {
    shown = report;
    if (own) showNames(report.contract);
    show();
  }).catch(refused);
}

// Shows an error that occurred in place of an answer of the worker.
function refused({ message }) {
  shown = { verdict: 'fails', mistakes: [], notes: [{ kind: 'hint', file: null, line: 0, text: withoutOptions(message) }], scenes: [], searched: true };
  show();
}

function changed() {
  if (!lists) return;
  if (!own && isOther()) {
    own = true;
    asked = { hints: 0, exercise: null };
    if (editors.vertex.text === begun.vertex) editors.vertex.text = '';
  }
  clearTimeout(timer);
  timer = setTimeout(run, TYPING_MS);
}

function show() {
  verdict.dataset.verdict = shown?.verdict ?? '';
  verdict.dataset.searched = String(shown?.searched ?? false);
  hint.hidden = !asked.exercise;
  hint.disabled = asked.hints >= HINTS || shown?.verdict === 'passes';
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
const FILES = { fragment: 'shader.frag', vertex: 'shader.vert' };
const EXERCISE = 'exercise:'; // precedes the mistake's id

// Returns the lines of the correct program that the exercise does not contain.
function missingLines({ texts, correct }) {
  return Object.entries(FILES).flatMap(([part, file]) => {
    const there = new Set(texts[part].split('\n'));
    return correct[part].split('\n').map((code, i) => ({ file, line: i + 1, code })).filter(({ code }) => code.trim() && !there.has(code));
  });
}

let begun = null; // the texts that the page wrote

// Returns whether the fragment shader is another program: most of its lines differ from the chosen program.
function isOther() {
  const lines = (code) => code.split('\n').map((line) => line.trim()).filter((line) => line.length > 3);
  const known = new Set(lines(begun.fragment)), now = lines(editors.fragment.text);
  return now.filter((line) => known.has(line)).length < now.length / 2;
}

function begin(texts, exercise = null) {
  begun = texts;
  own = false;
  editors.fragment.text = texts.fragment;
  editors.vertex.text = texts.vertex;
  asked = { hints: 0, exercise };
  shown = null;
  found.replaceChildren();
  show();
  return run();
}

// Starts the chosen program or exercise. Exercises use the names of `lambent shader`.
async function beginTask() {
  if (!tasks.value) tasks.selectedIndex = 0; // the texts were another program
  const task = tasks.value;
  clearTimeout(timer);
  if (!task.startsWith(EXERCISE)) return begin(PROGRAMS.find(({ name }) => name === task));
  if (contracts.value !== 'lambent') showContract('lambent', task);
  verdict.textContent = text('shaderWaits');
  const row = lists.exercises.find(({ mistake }) => EXERCISE + mistake === task), made = await checks.exercise(row.mistake);
  return made && begin(made.texts, { ...row, highlight: made.highlight, missing: missingLines(made) });
}

const start = () => beginTask().catch(refused);

let lists = null;

// Shows the names of a contract that the program has recognised.
function showNames(name) {
  if (name !== contracts.value && lists.contracts.some((one) => one.name === name) && PROGRAMS.some(({ contract }) => contract === name)) showContract(name, '');
}

// Lists the contract's names, its correct programs and the exercises, and selects `task`, or the first program if `task` is null.
function showContract(name, task = null) {
  const group = (key, options) => element('optgroup', { label: text(key) }, ...options);
  const mine = PROGRAMS.filter(({ contract }) => contract === name);
  contracts.value = name;
  tasks.replaceChildren(group('shaderPrograms', mine.map(({ name }) => ours('option', name, { value: name }))),
    group('shaderExercises', lists.exercises.map(({ mistake, looks }, i) => ours('option', `${i + 1}. ${looks}`, { value: EXERCISE + mistake }))));
  tasks.value = task ?? mine[0].name;
  const contract = lists.contracts.find((one) => one.name === name);
  names.lastChild.replaceChildren(...contract.names.map((row) => element('tr', {}, ours('td', row.name), ours('td', row.type), ours('td', row.meaning))));
}

// Loads the module of checks and shows its lists. If the module cannot be loaded, a button is shown that tries again.
async function connect() {
  again.hidden = true;
  verdict.textContent = text('shaderWaits');
  lists = await checks.lists();
  const usable = lists.contracts.filter(({ name }) => PROGRAMS.some(({ contract }) => contract === name));
  contracts.replaceChildren(...usable.map(({ name, title }) => ours('option', title, { value: name })));
  contracts.onchange = () => {
    showContract(contracts.value);
    start();
  };
  tasks.onchange = start;
  showContract(usable[0].name);
  start();
}

function open() {
  connect().catch(({ message }) => {
    verdict.textContent = message;
    again.hidden = false;
  });
}

async function makeEditors() {
  editors.fragment = await makeEditor(places.fragment, { label: text('shaderFragment'), onchange: changed });
  editors.vertex = await makeEditor(places.vertex, { label: text('shaderVertex'), onchange: changed });
}

makeEditors().then(open);
