// window_size.js: adapts the picture to the window while its size is the one that filled the window before.
import { on, stageSize, state } from './app.js';

let filled = stageSize(), timer = 0;

export const windowSize = () => `--size=${filled}`;
export const isFollowing = () => state.words.includes(windowSize());

// From now on, the picture fills the window.
export function followWindow() {
  filled = stageSize();
  state.set(state.withValues('size', [filled]));
}

addEventListener('resize', () => {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const before = filled;
    filled = stageSize();
    if (filled !== before && state.values('size').at(-1) === before) state.replace(`--size=${before}`, `--size=${filled}`);
  }, 150);
});
// Texts that arrive late can change the size of the stage.
on('ready', () => {
  if (!isFollowing()) filled = stageSize();
});
