// lab.mjs MODULES CHROMIUM BUILD_WEB FOLDER: runs the page of build-web in Chromium, cross-origin isolated, and
// simulates a user who turns the model.
//
// Reads a task on each line of standard input, and answers with a line of JSON, {"error": …} where it failed:
//     {"load": ["/a.glb", "--size=928x656", …]}  draws it; a model whose name begins with "/" is a file of FOLDER  -> {"threads", "version"}
//     {"turn": ms, "paced": true}    drags the picture round for this time, by steps that follow the pictures, or the screen if paced. `frames`
//                                    are the milliseconds between the pictures, `sharp` the milliseconds from the last step to the whole
//                                    picture, and `scale` the mean width of the pictures as a fraction of the full width   -> {"frames", "sharp", "scale"}
//     {"whole": n}                   milliseconds between n whole pictures, each from another side                   -> {"frames"}
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve } from 'node:path';
import { createInterface } from 'node:readline';

const [, , modules, executablePath, built, folder] = process.argv;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };
const server = createServer((request, answer) => {
  const name = new URL(request.url, 'http://x').pathname.replace(/^\/$/, '/index.html');
  try {
    answer.writeHead(200, { 'content-type': TYPES[extname(name)] ?? 'application/octet-stream', 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' })
      .end(readFileSync(join(resolve(built, 'page'), name)));
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const { chromium } = createRequire(join(resolve(modules), 'x'))('playwright-core');
const browser = await chromium.launch({ executablePath, headless: true, args: ['--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'] });

const fragment = (words) => '#' + words.map(encodeURIComponent).join('&');

// Runs in the page before the page's scripts. Records the time and the size of each picture that the page shows.
function watch() {
  const { putImageData } = CanvasRenderingContext2D.prototype, test = (globalThis.test = { shown: [], next: () => {}, whole: 0 });
  CanvasRenderingContext2D.prototype.putImageData = function (...given) {
    putImageData.apply(this, given);
    test.shown.push({ at: performance.now(), width: given[0].width, height: given[0].height });
    setTimeout(() => test.next());
  };
  const observed = new MutationObserver(() => document.body.dataset.drawn && (test.whole = performance.now()));
  addEventListener('DOMContentLoaded', () => observed.observe(document.body, { attributes: true, attributeFilter: ['data-drawn'] }));
  // Moves the mouse back and forth with the button down, in steps of one degree.
  test.turn = async (ms, paced) => {
    const canvas = document.getElementById('canvas'), box = canvas.getBoundingClientRect(), [, width] = /--size=(\d+)x/.exec(decodeURIComponent(location.hash));
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    test.shown.length = 0;
    let i = 0, last = 0;
    const step = () => {
      last = performance.now();
      const across = 60 * Math.sin(++i / 20);
      canvas.dispatchEvent(new PointerEvent('pointermove', { pointerId: test.pointer, pointerType: 'mouse', isPrimary: true, buttons: 1, bubbles: true, clientX: middle[0] + 4 * across, clientY: middle[1] + across }));
    };
    const end = performance.now() + ms;
    await new Promise((done) => {
      const go = () => (performance.now() < end ? (step(), paced && requestAnimationFrame(go)) : done());
      test.next = paced ? () => {} : go;
      go();
    });
    test.next = () => {};
    const turned = test.shown.slice();
    // Waits for the whole picture after the last step.
    while (test.whole < last && performance.now() < last + 5000) await new Promise((done) => setTimeout(done, 2));
    if (test.whole < last) throw new Error('no whole picture follows');
    return { frames: turned.slice(1).map((one, k) => one.at - turned[k].at), sharp: test.whole - last, scale: turned.reduce((sum, one) => sum + one.width / width, 0) / turned.length };
  };
  addEventListener('pointerdown', ({ pointerId }) => (test.pointer = pointerId), { capture: true });
}

let page, words, failed;
const drawn = () => page.waitForFunction(() => document.body.dataset.drawn === JSON.stringify(location.hash.slice(1).split('&').map(decodeURIComponent)), undefined, { timeout: 60000 });
const commands = {
  async load(task) {
    await page?.context().close();
    page = await (await browser.newContext({ viewport: { width: 1500, height: 900 }, bypassCSP: true, serviceWorkers: 'block' })).newPage();
    failed = [];
    page.on('pageerror', (problem) => failed.push(problem.message));
    await page.addInitScript(watch);
    words = task.load;
    const file = words[0].startsWith('/');
    await page.goto(`http://127.0.0.1:${server.address().port}/${fragment(file ? ['cube', '--size=96x96'] : words)}`);
    await drawn();
    if (file) {
      await page.locator('#files').setInputFiles(join(folder, words[0]));
      await page.waitForFunction((name) => document.getElementById('model').value === name, words[0]);
      await page.evaluate((hash) => (location.hash = hash), fragment(words));
      await drawn();
    }
    await page.waitForFunction(() => document.body.dataset.threads, undefined, { timeout: 30000 });
    const box = await page.locator('#canvas').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.evaluate(() => globalThis.test.turn(2000, false)); // the engine compiles frequently used code
    return { threads: Number(await page.evaluate(() => document.body.dataset.threads)) };
  },
  turn: ({ turn, paced = false }) => page.evaluate(([ms, by]) => globalThis.test.turn(ms, by), [turn, paced]),
  async whole({ whole }) {
    await page.mouse.up();
    await page.waitForTimeout(400);
    const given = words.filter((word) => !/^--(camera|samples)/.test(word));
    return page.evaluate(([count, list]) => new Promise((done) => {
      const { test } = globalThis, frames = [], begin = 2;
      let i = 0, last = 0;
      test.next = () => {
        if (last && i > begin) frames.push(performance.now() - last);
        if (frames.length === count) return (test.next = () => {}), done({ frames });
        last = performance.now();
        location.hash = '#' + [...list, `--azimuth=${30 + ++i}`].map(encodeURIComponent).join('&');
      };
      test.next();
    }), [whole, [...given, '--samples=1']]);
  },
};
for await (const line of createInterface({ input: process.stdin })) {
  const task = JSON.parse(line), name = Object.keys(commands).find((key) => key in task);
  try {
    const answer = await commands[name](task);
    if (failed.length) throw new Error(failed.join('; '));
    console.log(JSON.stringify(answer));
  } catch (problem) {
    console.log(JSON.stringify({ error: String(problem.message).split('\n')[0] }));
  }
}
await browser.close();
server.closeAllConnections();
server.close();
