// memory.js: how much memory the page's parts may take. navigator.deviceMemory is the machine's in GiB, as Chromium has it: a power of 2, not above
// what the browser chooses to say (8, or 32). Other browsers do not say it.
const device = 2 ** 30 * (globalThis.navigator?.deviceMemory ?? 8);

const between = (least, bytes, most) => Math.min(Math.max(bytes, least), most);

// The memory for reading a model and for drawing it, if the command line has no --memory-limit: a quarter, as in the program. The module's
// addresses end at 4 GiB.
export const MODULE_BYTES = between(256e6, device / 4, 2e9);

// Of the files of a model, which are there three times while they are read.
export const FILES_BYTES = between(128e6, device / 8, 1.2e9);
