// formats.mjs PLAYWRIGHT CHROMIUM FOLDER PAGE…: opens pages that contain a model (`lambent MODEL -o page.html`), and prints the command line and the hash of
// the picture of each (tests/long/page.py).
import { join } from 'node:path';

import { commandOf, drawn, pixels, watchedPage } from './driver.mjs';
import { launch } from './serve.mjs';

const [playwright, chromium, folder, ...names] = process.argv.slice(2);
const browser = await launch(playwright, chromium);
for (const name of names) {
  const reports = [], page = await watchedPage(browser, reports);
  try {
    await page.goto(`file://${join(folder, name)}`);
    await drawn(page, name);
    console.log(JSON.stringify({ name, command: await commandOf(page), hash: await pixels(page), reports }));
  } catch (error) {
    console.log(JSON.stringify({ name, command: '', hash: '', reports: [error.message, ...reports] }));
  }
  await page.close();
}
await browser.close();
