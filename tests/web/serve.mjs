// serve.mjs: the page of build-web/page on 127.0.0.1, and a browser for it. Below /isolated/ it is cross-origin isolated.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve } from 'node:path';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

export function launch(playwright, executablePath) {
  const { chromium } = createRequire(join(resolve(playwright), 'x'))('playwright-core');
  return chromium.launch({ executablePath, headless: true, args: ['--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'] });
}

export async function openBrowser(playwright, executablePath, built) {
  const server = createServer((request, answer) => {
    const path = new URL(request.url, 'http://x').pathname, isolated = path.startsWith('/isolated/');
    const name = path.replace(/^\/isolated/, '').replace(/^\/$/, '/index.html');
    const headers = isolated ? { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' } : {};
    try {
      const bytes = readFileSync(join(built, 'page', name));
      answer.writeHead(200, { ...headers, 'content-type': TYPES[extname(name)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const browser = await launch(playwright, executablePath);
  const close = async () => {
    await browser.close();
    server.closeAllConnections();
    await new Promise((done) => server.close(done));
  };
  return { browser, origin: `http://127.0.0.1:${server.address().port}/`, close };
}
