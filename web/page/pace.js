// pace.js: how large quick pictures are. While something moves, each has as many pixels as are drawn 30 times a second, by what the last ones have taken, and
// at least half of the width and height of the picture.
const FRAME_MS = 28; // with what the browser needs to show it, a thirtieth of a second
const SCALES = [1, 0.84, 0.71, 0.6, 0.5]; // of width and height: few, so that the size does not change all the time
const SMALL = 5e5; // pixels of a picture that begins with all of them
const FRAMES_MIN = 3; // that are measured before the size changes
const KEPT = 0.5; // of the mean, for each frame

export class Pace {
  #step = null;
  #mean = 0;
  #count = 0;

  // Another picture: what was measured says nothing of it.
  reset() {
    this.#step = null;
  }

  scale(pixels) {
    this.#step ??= pixels > SMALL ? SCALES.length - 1 : 0;
    return SCALES[this.#step];
  }

  // A picture of this scale has taken `ms`.
  measured(ms) {
    this.#mean = this.#count++ ? KEPT * this.#mean + (1 - KEPT) * ms : ms;
    if (this.#step === null || this.#count < FRAMES_MIN) return;
    const larger = SCALES[this.#step - 1] ?? Infinity, expected = this.#mean * (larger / SCALES[this.#step]) ** 2;
    if (this.#mean > FRAME_MS) this.#change(Math.min(this.#step + 1, SCALES.length - 1));
    else if (expected < 0.9 * FRAME_MS) this.#change(this.#step - 1);
  }

  #change(step) {
    this.#step = step;
    this.#count = 0;
  }
}
