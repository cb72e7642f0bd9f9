// window_size.js: adapts the picture to the window when the window's size changes. It does so only if the picture filled the window before.
import { on, stageSize, state } from './app.js';

let filled = stageSize(), timer = 0;

export const windowSize = () => `--size=${filled}`;
export const isFollowing = () => state.words.includes(windowSize());

// Makes the picture fill the window, also after the window's size changes.
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
// Texts that are shown late can change the size of the stage.
on('ready', () => {
  if (!isFollowing()) filled = stageSize();
});
