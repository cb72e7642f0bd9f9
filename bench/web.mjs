// web.mjs MODULE FOLDER: reads {"words": [...], "frames": N} from standard input, one on a line, and draws each N times; writes the times of
// the frames in milliseconds as a JSON list on a line. Files are those of FOLDER by their names.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { open } from '../web/lambent.js';

const [, , module, folder] = process.argv;
const lambent = await open(readFileSync(module));
for (const name of folder ? readdirSync(folder) : [])
  if (statSync(join(folder, name)).isFile()) lambent.files.set('/' + name, new Uint8Array(readFileSync(join(folder, name))));
for await (const line of createInterface({ input: process.stdin })) {
  const { words, frames } = JSON.parse(line);
  console.log(JSON.stringify(Array.from({ length: frames }, () => lambent.draw(words).frame_ms)));
}
