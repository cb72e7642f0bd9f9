// run.mjs MODULE WORD...: runs a WebAssembly program with no files; what it prints and its exit code are its own.
import { readFileSync } from 'node:fs';
import { Files, run } from '../../web/wasi.js';

const module = new WebAssembly.Module(readFileSync(process.argv[2]));
process.exitCode = run(module, new Files(), ['program', ...process.argv.slice(3)], (stream, text) =>
  (stream === 1 ? process.stdout : process.stderr).write(text));
