// timeline.js: plays the animations of the model. It has a button for play and pause, and a slider for the time.
import { beginGesture, endGesture, gestureKey, on, state, view } from '../shared/app.js';
import { button, element } from '../base/dom.js';
import { setOption } from '../controls/row.js';
import { showNumber, slider } from '../controls/slider.js';
import { text } from '../base/strings.js';

export function timeline(animations) {
  const indexOf = (value) => Math.max(0, animations.findIndex(({ name }, i) => name === value || String(i) === value));
  const choice = element('select', { translate: false, attributes: { 'aria-label': text('timelineChoice') } }, ...animations.map(({ name }, i) => new Option(name ?? i, i)));
  const play = button('timelinePlay', () => (began === null ? start() : stop()));
  const length = () => animations[Number(choice.value)].seconds;
  const time = slider(element('span', { textContent: text('timelineTime') }), text('timelineTime'), [0, 1, 0.01], 0, (value) => {
    began = null;
    setOption('time', [value], gestureKey());
  });
  let began = null; // the clock time at which the animation was at 0; null if it is paused

  function step() {
    if (began === null || !time.isConnected) return stop();
    const at = ((performance.now() - began) / 1000) % Math.max(length(), 1e-3);
    beginGesture();
    setOption('time', [at.toFixed(3)], gestureKey());
  }
  function start() {
    began = performance.now() - 1000 * Number(time.querySelector('input').value);
    play.textContent = text('timelineStop');
    step();
  }
  function stop() {
    if (began !== null || view.moving) endGesture();
    began = null;
    play.textContent = text('timelinePlay');
  }
  choice.onchange = () => setOption('animation', [animations[Number(choice.value)].name ?? choice.value]);
  function show() {
    choice.value = indexOf(state.values('animation').at(-1));
    time.querySelector('input').max = length();
    showNumber(time, state.values('time').at(-1) ?? 0);
  }
  on('words', () => time.isConnected && show());
  on('picture', () => began !== null && requestAnimationFrame(step)); // requests the next picture after the previous one is shown
  show();
  choice.hidden = animations.length < 2;
  return element('div', {}, choice, element('div', { className: 'buttons' }, play), time);
}
