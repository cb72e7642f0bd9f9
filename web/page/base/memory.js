// memory.js: sets the memory limits of the page. navigator.deviceMemory is the machine's memory in GiB in Chromium: a power of 2, limited by the browser to 8
// or 32. Other browsers do not report it.
const device = 2 ** 30 * (globalThis.navigator?.deviceMemory ?? 8);

const between = (least, bytes, most) => Math.min(Math.max(bytes, least), most);

// The memory limit for reading a model and for drawing it, if the command line contains no --memory-limit. It is a quarter of the machine's memory, as in the
// program. It is at most 2 GB, because a module can address only 4 GiB.
export const MODULE_BYTES = between(256e6, device / 4, 2e9);

// The size limit of a model's files. During reading, the files are in memory three times.
export const FILES_BYTES = between(128e6, device / 8, 1.2e9);
