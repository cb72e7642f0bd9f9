// axe.mjs PLAYWRIGHT BROWSER BUILD_WEB [GALLERY]: runs axe-core in every tab of the page, and in the gallery at the address GALLERY, in light and
// dark colours, in a wide window and at 320 pixels. It must find no accessibility problem. Prints lines of the Test Anything Protocol without
// numbers.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { drawn, fragment, ok, until } from './driver.mjs';
import { isFirefox, openBrowser } from './serve.mjs';

const [, , playwright, executablePath, built, gallery] = process.argv;
const AXE = readFileSync(join(playwright, 'axe-core', 'axe.min.js'), 'utf8');
const WORDS = ['sphere', '--size=96x96', '--background=white', '--light=point:position=0.5/0.5/3'];

// For each finding: the rule, and the first elements.
async function findings(page) {
  return page.evaluate(async () => {
    const { violations } = await globalThis.axe.run(document, { resultTypes: ['violations'] });
    return violations.map(({ id, help, nodes }) => `${id}: ${help}\n${nodes.slice(0, 4).map(({ html, failureSummary }) => `${html.slice(0, 160)}\n  ${failureSummary.split('\n').slice(1, 3).join(' ').trim()}`).join('\n')}`);
  });
}

// Fills each tab before axe checks it.
const TABS = {
  quick: async () => {},
  options: async (page) => until(page, () => document.querySelector('#options details') && [...document.querySelectorAll('#options details')].every((one) => (one.open = true))),
  lights: async (page) => until(page, () => document.querySelector('#panel-lights .slider')),
  explain: async (page) => {
    await page.locator('#canvas').press('Enter');
    await until(page, () => document.getElementById('explain').textContent.length > 100);
  },
  shaders: async (page) => until(page, () => document.getElementById('shader-verdict')?.textContent && !document.querySelector('#panel-shaders [aria-busy=true]')),
};

async function look(page, label) {
  const found = await findings(page);
  ok(!found.length, `axe: ${label}`, found.join('\n'));
}

for (const dark of [false, true]) {
  const { browser, origin, close } = await openBrowser(playwright, executablePath, built, { dark }), scheme = dark ? 'dark' : 'light';
  for (const width of [1280, 320]) {
    const context = await browser.newContext({ viewport: { width, height: 900 }, ...(isFirefox(executablePath) ? {} : { colorScheme: scheme, bypassCSP: true }) });
    const page = await context.newPage(), size = `${scheme}, ${width} pixels wide`;
    await page.addInitScript(AXE);
    await page.goto(origin + fragment(WORDS));
    await drawn(page, size);
    ok((await page.evaluate(() => matchMedia('(prefers-color-scheme: dark)').matches)) === dark, `axe: the page is ${scheme}`);
    for (const [name, show] of Object.entries(TABS)) {
      await page.locator(`#tab-${name}`).click();
      await show(page);
      await look(page, `the tab '${name}', ${size}`);
    }
    await page.evaluate((hash) => (location.hash = hash), fragment(['sphere', '--size=96x96', '--camera=eye=1']));
    await until(page, () => !document.getElementById('message').hidden);
    await look(page, `a refused option, ${size}`);
    if (gallery) {
      await page.goto(gallery);
      await until(page, () => document.querySelectorAll('li a').length > 2 && [...document.images].every((image) => image.complete && image.naturalWidth));
      await look(page, `the gallery, ${size}`);
    }
    await context.close();
  }
  await close();
}
