// window_size.js: the picture follows the window, as long as its size is the one that filled the window before.
import { on, stageSize, state } from './app.js';

let filled = stageSize(), timer = 0;

export const isFollowing = () => state.values('size').at(-1) === filled;

// The picture fills the window from now on.
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
// Texts of the page may come later than its size.
on('ready', () => {
  if (!isFollowing()) filled = stageSize();
});
