// npm_page.mjs PLAYWRIGHT CHROMIUM FOLDER: tests pages with the npm package in a browser (tests/npm.py): FOLDER/plain/index.html uses it without a
// bundler, FOLDER/bundled/index.html bundled by esbuild, FOLDER/dist/index.html by Vite. Each page draws with open() and openWorker() and stores its results in document.title.
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';

import { ok } from './driver.mjs';
import { launch } from './serve.mjs';

const [playwright, chromium, folder] = process.argv.slice(2);
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
const server = createServer((request, answer) => {
  try {
    const path = new URL(request.url, 'http://x').pathname, bytes = readFileSync(join(folder, path));
    answer.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' }).end(bytes);
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const browser = await launch(playwright, chromium), expected = JSON.parse(readFileSync(join(folder, 'expected.json')));
for (const kind of ['plain', 'bundled', ...(existsSync(join(folder, 'dist')) ? ['dist'] : [])]) {
  const page = await browser.newPage(), reports = [];
  page.on('pageerror', (error) => reports.push(error.message));
  page.on('console', (message) => message.type() === 'error' && reports.push(message.text()));
  await page.goto(`http://127.0.0.1:${server.address().port}/${kind}/index.html`);
  await page.waitForFunction(() => document.title !== '', null, { timeout: 60000 }).catch(() => {});
  const found = JSON.parse((await page.title()) || '{}');
  ok(found.here === expected.cube && found.worker === expected.cube, `a ${kind} page draws the program's bytes, itself and in a worker`, `${JSON.stringify(found)} ${reports.join('; ')}`);
}
await browser.close();
server.closeAllConnections();
server.close();
