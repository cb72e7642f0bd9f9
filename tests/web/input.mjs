// input.mjs: user actions that need different calls in Chromium and Firefox: touches, dropped files, saved files. Chromium uses its DevTools
// protocol. Firefox simulates touches through WebDriver BiDi; an event in the page drops files, and the test intercepts dialogs and saved files.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';

const FILE_MAX = 1e6; // bytes; for larger files, only the size is sent, and the contents are zeros

export const isFirefoxPage = (page) => page.context().browser().browserType().name() !== 'chromium';

// A function (type, ...points): touchStart, touchMove or touchEnd of touches at these points.
export async function fingers(page) {
  if (!isFirefoxPage(page)) {
    const session = await page.context().newCDPSession(page);
    return (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  }
  const { _session: session } = page._connection.toImpl(page)._delegate;
  let last = [];
  return async (type, ...points) => {
    if (points.length) last = points;
    const steps = last.map(([x, y]) => ({
      touchStart: [{ type: 'pointerMove', x: Math.round(x), y: Math.round(y) }, { type: 'pointerDown', button: 0 }],
      touchMove: [{ type: 'pointerMove', x: Math.round(x), y: Math.round(y) }],
      touchEnd: [{ type: 'pointerUp', button: 0 }],
    })[type]);
    const actions = steps.map((actions, id) => ({ type: 'pointer', id: `finger ${id}`, parameters: { pointerType: 'touch' }, actions }));
    await session.send('input.performActions', { context: session.sessionId, actions });
  };
}

// Describes a file or a folder to the page: names, and base64 bytes or a number of zeros.
function described(path) {
  const about = statSync(path), name = basename(path);
  if (about.isDirectory()) return { name, children: readdirSync(path).map((child) => described(join(path, child))) };
  return about.size > FILE_MAX ? { name, size: about.size } : { name, bytes: readFileSync(path).toString('base64') };
}

// Runs in the page: drops files, with entries as in the File and Directory Entries API.
function dropInPage(files) {
  const entryOf = ({ name, children, bytes, size }) => {
    if (!children) return { name, isFile: true, isDirectory: false, file: (done) => done(new File([bytes === undefined ? new ArrayBuffer(size) : Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0))], name)) };
    let left = children.map(entryOf);
    return { name, isFile: false, isDirectory: true, createReader: () => ({ readEntries: (done) => done(left.splice(0, 2)) }) };
  };
  const items = files.map(entryOf).map((entry) => {
    let own = null;
    if (entry.isFile) entry.file((file) => (own = file));
    return { kind: 'file', getAsFile: () => own, webkitGetAsEntry: () => entry };
  });
  for (const type of ['dragenter', 'dragover', 'drop']) {
    const event = new Event(type, { bubbles: true, cancelable: true });
    Object.defineProperty(event, 'dataTransfer', { value: { items, types: ['Files'], files: [] } });
    document.getElementById('canvas').dispatchEvent(event);
  }
}

// Drops files and folders like the system does.
export async function drop(page, ...paths) {
  if (isFirefoxPage(page)) return page.evaluate(dropInPage, paths.map(described));
  const session = await page.context().newCDPSession(page), box = await page.locator('#canvas').boundingBox();
  const data = { items: [], files: paths.map((path) => resolve(path)), dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await session.send('Input.dispatchDragEvent', { type, x: box.x + box.width / 2, y: box.y + box.height / 2, data });
}

// Inserts text at the cursor of an editor, in one step. WebDriver BiDi would type single letters, so the editor would indent them and close
// brackets; in Firefox, the test pastes the text.
export async function insertText(page, editor, text) {
  if (!isFirefoxPage(page)) return page.keyboard.insertText(text);
  return editor.evaluate((node, pasted) => {
    const event = new Event('paste', { bubbles: true, cancelable: true });
    Object.defineProperty(event, 'clipboardData', { value: { getData: (type) => (type === 'text/plain' ? pasted : '') } });
    node.dispatchEvent(event);
  }, text);
}

// Selects files in the dialog that `act` opens.
export async function choose(page, act, path) {
  if (!isFirefoxPage(page)) {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), act()]);
    return chooser.setFiles(path);
  }
  await page.evaluate(() => {
    const { click } = HTMLInputElement.prototype;
    HTMLInputElement.prototype.click = function () {
      globalThis.openedDialog = this.id;
      HTMLInputElement.prototype.click = click;
    };
  });
  await act();
  return page.locator(`#${await page.evaluate(() => globalThis.openedDialog)}`).setInputFiles(path);
}

// The name and the bytes of the file that the page saves when `act` runs.
export async function saved(page, act) {
  if (!isFirefoxPage(page)) {
    const [download] = await Promise.all([page.waitForEvent('download'), act()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }
  await page.evaluate(() => {
    const { createObjectURL } = URL, { click } = HTMLAnchorElement.prototype;
    let blob = null;
    URL.createObjectURL = (made) => createObjectURL.call(URL, (blob = made));
    globalThis.savedFile = new Promise((done) => {
      HTMLAnchorElement.prototype.click = async function () {
        Object.assign(URL, { createObjectURL });
        HTMLAnchorElement.prototype.click = click;
        const bytes = new Uint8Array(await blob.arrayBuffer());
        done({ name: this.download, letters: btoa(bytes.reduce((text, byte) => text + String.fromCharCode(byte), '')) });
      };
    });
  });
  await act();
  const { name, letters } = await page.evaluate(() => globalThis.savedFile);
  return { name, bytes: Buffer.from(letters, 'base64') };
}
