// wasi.js: the system interface for modules of Lambent. It provides files in memory, a clock, and printed text. It implements the functions of WASI preview 1
// (https://github.com/WebAssembly/WASI/blob/main/legacy/preview1/docs.md) that Lambent calls. It does not access the machine's files.

const OK = 0, BADF = 8, EXIST = 20, INVAL = 28, ISDIR = 31, NOENT = 44, NOSYS = 52, NOTDIR = 54, NOTEMPTY = 55;
const FOLDER = 3, FILE = 4, CHARACTERS = 2; // kinds of files
const ROOT = 3; // the number of the opened root, after the three streams

// Thrown when a module exits by proc_exit.
export class Exit extends Error {
  constructor(code) {
    super(`ended with ${code}`);
    this.code = code;
  }
}

// Files in memory. The bytes of each file are stored by its absolute path, such as "/model/bunny.obj". A folder exists if a file was stored in it or if the
// module has created it.
export class Files {
  constructor() {
    this.files = new Map();
    this.folders = new Set(['']);
    this.absent = new Set(); // paths that were opened or looked up, but do not exist
    this.used = new Set(); // paths of opened files
  }

  static clean(path) {
    const parts = [];
    for (const part of path.split('/')) {
      if (part === '..') parts.pop();
      else if (part !== '' && part !== '.') parts.push(part);
    }
    return parts.length ? '/' + parts.join('/') : '';
  }

  set(path, bytes) {
    const clean = Files.clean(path);
    this.files.set(clean, { bytes, size: bytes.length });
    for (let at = clean.lastIndexOf('/'); at > 0; at = clean.lastIndexOf('/', at - 1)) this.folders.add(clean.slice(0, at));
  }

  get(path) {
    const file = this.files.get(Files.clean(path));
    return file && file.bytes.subarray(0, file.size);
  }

  delete(path) {
    return this.files.delete(Files.clean(path));
  }

  list() {
    return [...this.files.keys()].sort();
  }

  kind(clean) {
    return this.files.has(clean) ? FILE : this.folders.has(clean) ? FOLDER : 0;
  }
}

// Returns the imports of a module whose command line is `words`. `print(stream, text)` is called with text that the module prints to stream 1 or 2.
export function system(files, words, print) {
  const encoder = new TextEncoder(), decoders = [];
  const open = new Map([[ROOT, { path: '', folder: true }]]);
  let memory = null, next = ROOT + 1;
  const view = () => new DataView(memory.buffer);
  const bytes = (at, size) => new Uint8Array(memory.buffer, at, size);
  const text = (at, size) => new TextDecoder().decode(bytes(at, size).slice());
  const encoded = words.map((word) => encoder.encode(word + '\0'));
  const within = (fd, at, size) => Files.clean(open.get(fd).path + '/' + text(at, size));

  function lists(list, base, at) {
    for (const item of list) {
      view().setUint32(at, base, true);
      bytes(base, item.length).set(item);
      base += item.length;
      at += 4;
    }
  }

  function about(at, kind, size) { // filestat
    bytes(at, 64).fill(0);
    view().setUint8(at + 16, kind);
    view().setBigUint64(at + 24, 1n, true);
    view().setBigUint64(at + 32, BigInt(size), true);
  }

  function grow(file, size) {
    if (size > file.bytes.length) {
      const larger = new Uint8Array(Math.max(size, file.bytes.length * 2, 4096));
      larger.set(file.bytes.subarray(0, file.size));
      file.bytes = larger;
    }
    if (size > file.size) file.size = size;
  }

  // Calls `part(at, size)` for each block of a list. `part` returns the number of bytes that it has transferred. Stops after a block that was not fully
  // transferred. Returns the total number of bytes.
  function transfer(list, count, part) {
    let sum = 0;
    for (let i = 0; i < count; i++) {
      const at = view().getUint32(list + 8 * i, true), size = view().getUint32(list + 8 * i + 4, true);
      const done = part(at, size);
      sum += done;
      if (done < size) break;
    }
    return sum;
  }

  function read(fd, list, count, offset, result) {
    const one = open.get(fd);
    if (!one || one.folder) {
      if (fd !== 0) return one ? ISDIR : BADF;
      view().setUint32(result, 0, true); // standard input is empty
      return OK;
    }
    let from = offset;
    const sum = transfer(list, count, (at, size) => {
      const part = one.file.bytes.subarray(from, Math.min(from + size, one.file.size));
      bytes(at, part.length).set(part);
      from += part.length;
      return part.length;
    });
    view().setUint32(result, sum, true);
    return sum;
  }

  function stream(fd, list, count, result) {
    decoders[fd] ??= new TextDecoder();
    const sum = transfer(list, count, (at, size) => {
      print(fd, decoders[fd].decode(bytes(at, size).slice(), { stream: true }));
      return size;
    });
    view().setUint32(result, sum, true);
    return OK;
  }

  const calls = {
    args_sizes_get(count, size) {
      view().setUint32(count, encoded.length, true);
      view().setUint32(size, encoded.reduce((sum, word) => sum + word.length, 0), true);
      return OK;
    },
    args_get(list, base) {
      lists(encoded, base, list);
      return OK;
    },
    environ_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return OK;
    },
    environ_get: () => OK,
    clock_res_get(clock, at) {
      view().setBigUint64(at, 1000n, true);
      return OK;
    },
    clock_time_get(clock, precision, at) {
      const ms = clock === 0 ? Date.now() : performance.timeOrigin + performance.now(); // the same clock in all threads
      view().setBigUint64(at, BigInt(Math.round(ms * 1e6)), true);
      return OK;
    },
    random_get(at, size) {
      bytes(at, size).fill(7); // no picture depends on random numbers
      return OK;
    },
    proc_exit(code) {
      throw new Exit(code);
    },
    sched_yield: () => OK,
    poll_oneoff: () => NOSYS,
    fd_prestat_get(fd, at) {
      if (fd !== ROOT) return BADF;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return OK;
    },
    fd_prestat_dir_name(fd, at) {
      view().setUint8(at, 47); // "/"
      return OK;
    },
    fd_fdstat_get(fd, at) {
      const one = open.get(fd);
      if (!one && fd > 2) return BADF;
      bytes(at, 24).fill(0);
      view().setUint8(at, fd <= 2 ? CHARACTERS : one.folder ? FOLDER : FILE);
      view().setBigUint64(at + 8, 0x1fffffffn, true); // all rights
      view().setBigUint64(at + 16, 0x1fffffffn, true);
      return OK;
    },
    fd_fdstat_set_flags: () => OK,
    fd_close: (fd) => (open.delete(fd) || fd <= 2 ? OK : BADF),
    fd_sync: () => OK,
    fd_filestat_get(fd, at) {
      const one = open.get(fd);
      if (!one && fd > 2) return BADF;
      about(at, fd <= 2 ? CHARACTERS : one.folder ? FOLDER : FILE, one?.file ? one.file.size : 0);
      return OK;
    },
    fd_read(fd, list, count, result) {
      const one = open.get(fd), sum = read(fd, list, count, one?.at ?? 0, result);
      if (!one?.file) return sum;
      one.at += sum;
      return OK;
    },
    fd_pread(fd, list, count, offset, result) {
      const sum = read(fd, list, count, Number(offset), result);
      return open.get(fd)?.file ? OK : sum;
    },
    fd_write(fd, list, count, result) {
      if (fd === 1 || fd === 2) return stream(fd, list, count, result);
      const one = open.get(fd);
      if (!one?.file) return BADF;
      const sum = transfer(list, count, (at, size) => {
        grow(one.file, one.at + size);
        one.file.bytes.set(bytes(at, size), one.at);
        one.at += size;
        return size;
      });
      view().setUint32(result, sum, true);
      return OK;
    },
    fd_seek(fd, offset, whence, result) {
      const one = open.get(fd);
      if (!one?.file) return fd <= 2 ? INVAL : BADF;
      const to = Number(offset) + (whence === 0 ? 0 : whence === 1 ? one.at : one.file.size);
      if (to < 0) return INVAL;
      one.at = to;
      view().setBigUint64(result, BigInt(to), true);
      return OK;
    },
    fd_readdir(fd, at, size, cookie, result) {
      const one = open.get(fd);
      if (!one?.folder) return one ? NOTDIR : BADF;
      const names = new Map();
      for (const [list, kind] of [[files.folders, FOLDER], [files.files.keys(), FILE]])
        for (const path of list)
          if (path.startsWith(one.path + '/') && path.indexOf('/', one.path.length + 1) < 0)
            names.set(path.slice(one.path.length + 1), kind);
      const entries = [...names].sort((a, b) => (a[0] < b[0] ? -1 : 1));
      let used = 0;
      for (let i = Number(cookie); i < entries.length && used < size; i++) {
        const name = encoder.encode(entries[i][0]), entry = new Uint8Array(24 + name.length), fields = new DataView(entry.buffer);
        fields.setBigUint64(0, BigInt(i + 1), true);
        fields.setUint32(16, name.length, true);
        fields.setUint8(20, entries[i][1]);
        entry.set(name, 24);
        const part = entry.subarray(0, size - used);
        bytes(at + used, part.length).set(part);
        used += part.length;
      }
      view().setUint32(result, used, true);
      return OK;
    },
    path_filestat_get(fd, flags, path, length, at) {
      const clean = within(fd, path, length), kind = files.kind(clean);
      if (!kind) {
        files.absent.add(clean);
        return NOENT;
      }
      about(at, kind, kind === FILE ? files.files.get(clean).size : 0);
      return OK;
    },
    path_open(fd, lookup, path, length, how, rights, inheriting, flags, result) {
      const clean = within(fd, path, length), kind = files.kind(clean);
      const create = how & 1, folder = how & 2, exclusive = how & 4, truncate = how & 8;
      if (!kind && !create) {
        files.absent.add(clean);
        return NOENT;
      }
      if (kind && create && exclusive) return EXIST;
      if (folder && kind !== FOLDER) return NOTDIR;
      if (kind === FILE) files.used.add(clean);
      if (kind === FOLDER) {
        if (create || truncate) return ISDIR;
        open.set(next, { path: clean, folder: true });
      } else {
        if (!kind && !files.folders.has(clean.slice(0, clean.lastIndexOf('/')))) return NOENT;
        if (!kind || truncate) files.set(clean, new Uint8Array(0));
        open.set(next, { path: clean, file: files.files.get(clean), at: flags & 1 ? files.files.get(clean).size : 0 });
      }
      view().setUint32(result, next++, true);
      return OK;
    },
    path_create_directory(fd, path, length) {
      const clean = within(fd, path, length);
      if (files.kind(clean)) return EXIST;
      files.folders.add(clean);
      return OK;
    },
    path_remove_directory(fd, path, length) {
      const clean = within(fd, path, length);
      if ([...files.files.keys(), ...files.folders].some((other) => other.startsWith(clean + '/'))) return NOTEMPTY;
      return files.folders.delete(clean) ? OK : NOENT;
    },
    path_unlink_file: (fd, path, length) => (files.delete(within(fd, path, length)) ? OK : NOENT),
    path_rename(fd, path, length, other, to, toLength) {
      const from = within(fd, path, length), file = files.files.get(from);
      if (!file) return NOENT;
      files.files.delete(from);
      files.files.set(within(other, to, toLength), file);
      return OK;
    },
    path_readlink: () => INVAL,
    path_link: () => NOSYS,
    path_symlink: () => NOSYS,
  };
  // All other functions return NOSYS.
  const imports = new Proxy(calls, { get: (target, name) => target[name] ?? (() => NOSYS), has: () => true });
  return { wasi_snapshot_preview1: imports, attach: (instance) => (memory = instance.exports.memory) };
}

// Runs a module that has a main function, and returns the exit code.
export function run(module, files, words, print) {
  const host = system(files, words, print);
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1 });
  host.attach(instance);
  try {
    instance.exports._start();
    return 0;
  } catch (error) {
    if (error instanceof Exit) return error.code;
    throw error;
  }
}
