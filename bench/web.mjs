// web.mjs MODULE FOLDER: reads {"words": [...], "frames": N} from each line of standard input, and draws the picture N
// times. Prints a line with the times of the frames in milliseconds as a JSON list. File names refer to files in
// FOLDER.
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
