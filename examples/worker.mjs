#!/usr/bin/env node
// worker.mjs: draws thumbnails with one running `lambent batch --jobs -`. worker.mjs MODEL ...
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { createInterface } from 'node:readline';

const models = process.argv.slice(2);
const worker = spawn(process.env.LAMBENT ?? 'lambent', ['batch', '--jobs', '-', '--quiet', '--isolate', '--allow-path', '.'],
  { stdio: ['pipe', 'pipe', 'inherit'] });

// The worker stops reading while many jobs wait. A write then waits too, so answers are read at the same
// time.
async function send() {
  for (const [id, model] of models.entries()) {
    const job = { id, model, options: { size: 256 }, timeout_s: 20 };
    if (!worker.stdin.write(JSON.stringify(job) + '\n')) await once(worker.stdin, 'drain');
  }
  worker.stdin.end();
}

send();
for await (const line of createInterface({ input: worker.stdout })) { // in the order in which they finish
  const answer = JSON.parse(line);
  if (answer.outcome === 'written') {
    const picture = basename(models[answer.id]) + '.png';
    writeFileSync(picture, Buffer.from(answer.data, 'base64'));
    console.log(`${picture}: ${answer.triangles} triangles, ${answer.times_ms.total} ms`);
  } else {
    console.log(answer.error);
    process.exitCode = 1;
  }
}
