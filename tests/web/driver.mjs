// driver.mjs: functions that the tests of the page in a browser share.
import { createHash } from 'node:crypto';

export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

// A line of the Test Anything Protocol without its number.
export const ok = (good, label, why = '') => console.log(`${good ? 'ok' : 'not ok'} ${label}${good || why === '' ? '' : `\n# ${String(why).replaceAll('\n', '\n# ')}`}`);

// Opens a page, and adds the browser's errors and all refusals of its content security policy to `reports`.
export async function watchedPage(where, reports) {
  const page = await where.newPage();
  page.on('pageerror', (error) => reports.push(error.message));
  page.on('console', (message) => message.type() === 'error' && reports.push(message.text()));
  await page.addInitScript(() => addEventListener('securitypolicyviolation', (event) => console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`)));
  return page;
}

export const fragment = (words) => '#' + words.map(encodeURIComponent).join('&');
export const commandOf = (page) => page.locator('#command').textContent();

// Waits until `f` is true in the page. (Playwright's own function evaluates a string in the page, which the policy correctly
// refuses.)
export async function until(page, f, argument) {
  for (const end = Date.now() + 60000; Date.now() < end; await new Promise((done) => setTimeout(done, 20))) if (await page.evaluate(f, argument)) return true;
  throw new Error(`nothing came of ${f}`);
}

// Waits until the picture of the command line, with all samples, is on the canvas.
export async function drawn(page, change) {
  await until(page, () => {
    const shown = document.body.dataset.drawn;
    const words = location.hash.slice(1).split('&').map(decodeURIComponent);
    return shown && shown === JSON.stringify(words);
  }).catch(async (error) => {
    throw new Error(`${change}: no picture of ${await page.evaluate(() => `${location.hash}; drawn is ${document.body.dataset.drawn}; ${document.getElementById('message').textContent}`)}`, { cause: error });
  });
}

// Waits until a gesture has ended (its last step is a timer, and the page reports that it is in progress) and its picture is
// visible.
export async function settled(page, label) {
  await page.evaluate(() => new Promise((done) => setTimeout(done)));
  await until(page, () => document.body.dataset.gesture === undefined);
  await drawn(page, label);
}

// SHA-256 of a canvas' colours.
export async function pixels(page, id = 'canvas') {
  const colors = await page.evaluate((name) => {
    const canvas = document.getElementById(name), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const bytes = data.filter((_, i) => i % 4 !== 3);
    let text = '';
    for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(text);
  }, id);
  return createHash('sha256').update(Buffer.from(colors, 'base64')).digest('hex');
}
