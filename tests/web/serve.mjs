// serve.mjs: serves the page of build-web/page on 127.0.0.1, and starts a browser for it. Below /isolated/, the page is cross-origin isolated.
// Files are sent with brotli compression to browsers that accept it; a file in the browser's cache is not sent again. `sent` contains the
// names, bytes and times of the answers.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve } from 'node:path';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.webp': 'image/webp' };

export const isFirefox = (executablePath) => /firefox/.test(executablePath);

// Firefox is controlled through WebDriver BiDi, which has a separate name in playwright-core; Chromium is controlled by its DevTools. Firefox supports
// WebGL only with a display; LAMBENT_DISPLAY states that there is one (tests/browser.py). With `dark`, Firefox's pages see a preference for dark
// colours; in Chromium, the context sets this.
export function launch(playwright, executablePath, { dark = false } = {}) {
  const { chromium, _bidiFirefox: firefox } = createRequire(join(resolve(playwright), 'x'))('playwright-core');
  if (isFirefox(executablePath)) return firefox.launch({ executablePath, headless: !process.env.LAMBENT_DISPLAY, firefoxUserPrefs: { 'webgl.force-enabled': true, 'layout.css.prefers-color-scheme.content-override': dark ? 0 : 1 } });
  return chromium.launch({ executablePath, headless: true, args: ['--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'] });
}

export async function openBrowser(playwright, executablePath, built, options) {
  const sent = [];
  const server = createServer((request, answer) => {
    const path = new URL(request.url, 'http://x').pathname, isolated = path.startsWith('/isolated/');
    const name = path.replace(/^\/isolated/, '').replace(/^\/$/, '/index.html');
    const headers = isolated ? { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' } : {};
    try {
      const packed = /\bbr\b/.test(request.headers['accept-encoding']) && !name.endsWith('.webp') ? { ending: '.br', 'content-encoding': 'br' } : { ending: '' }, { ending, ...encoding } = packed;
      const bytes = readFileSync(join(built, 'page', name + ending)), etag = `"${createHash('sha256').update(bytes).digest('hex').slice(0, 16)}"`, known = request.headers['if-none-match'] === etag;
      Object.assign(headers, { etag, 'cache-control': 'no-cache', vary: 'accept-encoding' });
      sent.push({ name, bytes: known ? 0 : bytes.length, at: Date.now() });
      answer.writeHead(known ? 304 : 200, { ...headers, ...encoding, 'content-type': TYPES[extname(name)] ?? 'application/octet-stream' }).end(known ? undefined : bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const browser = await launch(playwright, executablePath, options);
  const close = async () => {
    await browser.close();
    server.closeAllConnections();
    await new Promise((done) => server.close(done));
  };
  return { browser, origin: `http://127.0.0.1:${server.address().port}/`, sent, close };
}
