// pace.js: chooses the size of quick pictures. They have as many pixels as can be drawn 30 times a second, measured on the last pictures. Their width and
// height are at least half of the full picture's.
const FRAME_MS = 28; // a thirtieth of a second, less the time that the browser needs to show the picture
const SCALES = [1, 0.84, 0.71, 0.6, 0.5]; // of width and height; there are few, so that the size changes rarely
const SMALL = 5e5; // pixels; smaller pictures start at full size
const FRAMES_MIN = 3; // number of measured pictures before the size changes
const KEPT = 0.5; // fraction of the mean that remains after each picture

export class Pace {
  #step = null;
  #mean = 0;
  #count = 0;

  // Removes the measurements. Call it before the pictures of another model.
  reset() {
    this.#step = null;
  }

  scale(pixels) {
    this.#step ??= pixels > SMALL ? SCALES.length - 1 : 0;
    return SCALES[this.#step];
  }

  // Adds a measurement: a picture of this scale took `ms`.
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
