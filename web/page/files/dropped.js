// dropped.js: reads dropped files, including the files in dropped folders. If the page was opened as a local file, Chromium cannot read the file of an entry
// (webkitGetAsEntry), so the item's own file and the folder's handle are tried first. Other browsers provide only entries.

async function ofHandle(handle, prefix) {
  if (handle.kind === 'file') return [[prefix + handle.name, await handle.getFile()]];
  const lists = [];
  for await (const child of handle.values()) lists.push(await ofHandle(child, `${prefix}${handle.name}/`));
  return lists.flat();
}

async function ofEntry(entry, prefix) {
  if (entry.isFile) return [[prefix + entry.name, await new Promise((resolve, reject) => entry.file(resolve, reject))]];
  const reader = entry.createReader(), found = [];
  for (;;) {
    const part = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (!part.length) return found;
    for (const child of part) found.push(...(await ofEntry(child, `${prefix}${entry.name}/`)));
  }
}

async function ofItem(file, entry, handle) {
  if (!entry?.isDirectory) return file ? [[file.name, file]] : [];
  const folder = await handle;
  return folder ? ofHandle(folder, '') : ofEntry(entry, '');
}

// Returns [path, File] pairs of a DataTransfer. Call it within the drop event.
export async function droppedFiles(transfer) {
  const items = [...transfer.items].filter((item) => item.kind === 'file');
  return (await Promise.all(items.map((item) => ofItem(item.getAsFile(), item.webkitGetAsEntry(), item.getAsFileSystemHandle?.())))).flat();
}
