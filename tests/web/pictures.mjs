// pictures.mjs MODULE FOLDER: reads command lines from standard input, one JSON list of words per line, whose files are in FOLDER; writes one
// line for each: the file's SHA-256, or the error message. A line {"explain": [words], "at": [x, y]} prints the explanation, {"curves":
// [words], "of": {...}} prints the curves of a light, and {"options": true} prints the options.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { LambentError, open } from '../../web/lambent.js';

const [, , wasm, folder] = process.argv;
const lambent = await open(readFileSync(wasm));
for (const name of readdirSync(folder, { recursive: true }))
  if (statSync(join(folder, name)).isFile()) lambent.files.set('/' + name, new Uint8Array(readFileSync(join(folder, name))));

for (const line of readFileSync(0, 'utf8').split('\n').filter(Boolean)) {
  const task = JSON.parse(line);
  try {
    if (task.options) console.log(JSON.stringify(lambent.options()));
    else if (task.curves) console.log(JSON.stringify(lambent.curves(task.curves, task.of)));
    else if (task.explain) console.log(JSON.stringify(lambent.explain(task.explain, ...task.at)));
    else console.log(createHash('sha256').update(lambent.save(task.words, task.ending)).digest('hex'));
  } catch (error) {
    if (!(error instanceof LambentError)) throw error;
    console.log(error.message);
  }
}
