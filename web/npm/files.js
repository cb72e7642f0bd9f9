// files.js: the files of a Lambent, in memory. Wrong types are rejected when they are set, not when they are read.
import { Files as Plain } from './wasi.js';

export function typeError(where, name, found, expected) {
  const kind = found === null ? 'null' : Array.isArray(found) ? 'an array' : typeof found === 'object' ? (found.constructor?.name ?? 'an object') : typeof found;
  return Object.assign(new TypeError(`${where}: found ${kind} as ${name}, expected ${expected}`), { code: 'BAD_ARGUMENT' });
}

function checkPath(where, path) {
  if (typeof path !== 'string' || path === '') throw typeError(where, 'path', path, 'a path such as "/model.stl"');
}

export class Files extends Plain {
  changed = false; // whether files have changed since the last call
  // Called with each change of the files, or null. A LambentWorker sets it (client.js).
  onChange = null;

  // Bytes are not copied. A string is stored as UTF-8.
  set(path, content) {
    checkPath('files.set', path);
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content)
      : content instanceof ArrayBuffer ? new Uint8Array(content)
      : ArrayBuffer.isView(content) ? new Uint8Array(content.buffer, content.byteOffset, content.byteLength) : null;
    if (!bytes) throw typeError('files.set', 'content', content, 'a Uint8Array, an ArrayBuffer or a text');
    super.set(path, bytes);
    this.changed = true;
    this.onChange?.(path, bytes);
  }

  get(path) {
    checkPath('files.get', path);
    return super.get(path);
  }

  has(path) {
    return this.get(path) !== undefined;
  }

  delete(path) {
    checkPath('files.delete', path);
    this.changed = true;
    this.onChange?.(path, null);
    return super.delete(path);
  }
}
