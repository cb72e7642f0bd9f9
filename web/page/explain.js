// explain.js: the point of the picture that is explained.
import { call, refuse, state } from './app.js';
import { $ } from './dom.js';
import { explanation } from './explanation.js';
import { addTab, selectTab } from './tabs.js';
import { text } from './strings.js';

const place = addTab('explain', text('tabExplain'));
place.append(Object.assign(document.createElement('p'), { className: 'hint', textContent: text('explainHint') }), $('explain'));

// A part of the picture's width and height.
export async function explainAt(across, down) {
  const canvas = $('canvas');
  const x = Math.min(canvas.width - 1, Math.floor(across * canvas.width)), y = Math.min(canvas.height - 1, Math.floor(down * canvas.height));
  const words = state.words.filter((word) => !word.startsWith('--show'));
  try {
    $('explain').replaceChildren(explanation(await call('explain', { words, x, y })));
    $('explain').hidden = false;
    place.firstChild.hidden = true;
    selectTab('explain');
  } catch (error) {
    refuse(error.message);
  }
}
