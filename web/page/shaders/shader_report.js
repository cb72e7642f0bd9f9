// shader_report.js: shows the report of a check.
import { button, element, ours } from '../base/dom.js';
import { text } from '../base/strings.js';

const VERDICTS = { passes: 'shaderPasses', differs: 'shaderDiffers', refused: 'shaderRefused', endless: 'shaderEndless', 'not a number': 'shaderNumbers', fails: 'shaderFails' };
const number = (x, digits) => x.toFixed(digits);

function picture(scene, which, label, size) {
  const canvas = element('canvas', { width: size, height: size, attributes: { role: 'img', 'aria-label': text('shaderPicture', { scene: scene.name, which: label }) } });
  if (scene[which]) canvas.getContext('2d').putImageData(new ImageData(scene[which], size), 0, 0);
  return element('td', {}, canvas);
}

function scenesTable(report, size) {
  const kinds = [['theirs', text('shaderTheirs')], ['reference', text('shaderReference')], ['difference', text('shaderDifference')]];
  const head = [text('shaderScene'), ...kinds.map(([, label]) => label), text('shaderLargest'), text('shaderMean'), text('shaderOver'), ''];
  const rows = report.scenes.map((scene) =>
    element('tr', {}, element('th', { scope: 'row' }, ours('span', scene.name, { title: scene.shows })), ...kinds.map(([which, label]) => picture(scene, which, label, size)),
      ours('td', number(scene.maximum, 3)), ours('td', number(scene.mean, 4)), ours('td', `${number(100 * scene.share_over, 1)} %`),
      element('td', { textContent: text(scene.passes ? 'shaderSame' : 'shaderOther'), className: scene.passes ? '' : 'bad' })));
  const table = element('table', { className: 'shader-scenes' }, element('caption', { textContent: text('shaderScenes') }),
    element('thead', {}, element('tr', {}, ...head.map((title) => element('th', { scope: 'col', textContent: title })))), element('tbody', {}, ...rows));
  return element('div', { className: 'wide', tabIndex: 0, attributes: { role: 'region', 'aria-label': text('shaderScenes') } }, table);
}

const lineButton = (file, line, goTo) => button('shaderLine', () => goTo(file, line), { textContent: text('shaderLine', { file, line }) });

// Removes the clauses of a message that name options of the command line, which the page does not have.
export const withoutOptions = (said) => said.split('; ').filter((clause) => !/(^|[\s`])--\w/.test(clause)).join('; ');

function notesList(report, goTo) {
  return element('ul', { className: 'shader-notes' }, ...report.notes.map(({ file, line, text: said }) => {
    const place = file && line ? [lineButton(file, line, goTo), ' '] : [];
    return element('li', {}, ...place, ours('span', withoutOptions(said)));
  }));
}

function mistakesList(report, withCode) {
  const { certain, share } = report.mistakes.at(-1);
  const items = report.mistakes.map((mistake) => {
    const item = element('li', {}, ours('strong', mistake.id), ours('span', ` ${withoutOptions(mistake.says)}`),
      element('small', { textContent: ` (${text('shaderMeans', { before: number(mistake.mean_before, 4), after: number(mistake.mean_after, 4) })})` }));
    if (withCode) item.append(element('div', {}, `${text('shaderWrite')} `, ours('code', mistake.write)));
    return item;
  });
  const title = certain ? text('shaderMistakes') : text('shaderMistakesSome', { share: Math.round(100 * share) });
  return [element('p', { textContent: title }), element('ul', { className: 'shader-mistakes' }, ...items)];
}

// The number of hints of an exercise. The first hint names the scenes to look at, the second the mistake, and the third the correct lines. Other mistakes are
// shown with the second hint.
export const HINTS = 3;

function hintsOf(report, { hints, exercise }, goTo) {
  const { mistake, wrong, missing } = exercise, named = element('p', {}, ours('strong', mistake), ours('span', ` ${wrong}`));
  if (report.verdict === 'passes') return [named];
  const out = [], scenes = report.scenes.filter((scene) => !scene.passes).map((scene) => scene.name).join(', ');
  if (hints > 0 && scenes) out.push(element('p', {}, text('shaderHintScenes', { scenes })));
  if (hints > 1) out.push(named);
  if (hints > 2) out.push(element('p', { textContent: text('shaderHintLines') }), element('ul', { className: 'shader-mistakes' },
    ...missing.map(({ file, line, code }) => element('li', {}, lineButton(file, line, goTo), ' ', ours('code', code.trim())))));
  const known = ({ id, also }) => id === mistake || (also ?? '').split(' ').includes(mistake);
  if (hints > 1 && report.mistakes.some((one) => !known(one))) out.push(...mistakesList(report, hints > 2));
  return out;
}

// Shows the verdict as a sentence, and the details below it. `asked` contains the exercise and the number of requested hints.
export function report(report, asked, size, goTo) {
  const solved = asked.exercise && report.verdict === 'passes';
  const verdict = text(solved ? 'shaderSolved' : (VERDICTS[report.verdict] ?? 'shaderFails'));
  const content = report.notes.length ? [notesList(report, goTo)] : [];
  if (asked.exercise) content.push(...hintsOf(report, asked, goTo));
  else if (report.mistakes.length) content.push(...mistakesList(report, true));
  else if (report.verdict === 'differs' && report.searched && !report.cut) content.push(element('p', { textContent: text('shaderUnknown', { tried: report.tried }) }));
  if (report.scenes.length) content.push(scenesTable(report, size));
  if (report.driver) content.push(element('p', { className: 'hint' }, text('shaderDrawnBy', { driver: report.driver })));
  const search = asked.exercise ? null : !report.searched ? 'shaderSearches' : report.cut ? 'shaderCut' : null;
  return { sentence: search ? text(search, { verdict }) : verdict, content };
}
