// Files in memory, and the functions of the system interface (WASI preview 1) that the module imports from its host.
// There is one folder, the root, and there are no links and users. The page's worker uses this, and so do the tests,
// under node.

/* exported makeFiles, makeSystem */

const errors = { SUCCESS: 0, BADF: 8, EXIST: 20, INVAL: 28, ISDIR: 31, NOENT: 44, NOSPC: 51, NOSYS: 52, NOTDIR: 54,
  NOTEMPTY: 55 };
const kinds = { directory: 3, file: 4 };

/** A file that grows. Its contents are the first `size` of `bytes`. */
const emptyFile = () => ({ bytes: new Uint8Array(1024), size: 0 });

/** Makes room for `size` bytes in a file. Returns false if there is no memory for it. */
function makeRoom(file, size) {
  if (size <= file.bytes.length) return true;
  try {
    const grown = new Uint8Array(Math.max(size, 2 * file.bytes.length));
    grown.set(file.bytes.subarray(0, file.size));
    file.bytes = grown;
    return true;
  } catch {
    return false;
  }
}

/** Files by their full names without the first slash. A folder has the value null. */
function makeFiles() {
  const entries = new Map([["", null]]);
  const numbers = new Map();
  const files = {
    entries,
    /** A number that identifies the file as long as it exists. */
    numberOf(entry, name) {
      const key = entry ?? name;
      if (!numbers.has(key)) numbers.set(key, numbers.size + 1);
      return numbers.get(key);
    },
    write(name, bytes) {
      entries.set(name, { bytes, size: bytes.length });
    },
    read: (name) => entries.get(name)?.bytes.slice(0, entries.get(name).size),
    /** The files below a folder, by their names relative to it. */
    below: (folder) => [...entries].filter(([name, file]) => file && name.startsWith(`${folder}/`))
      .map(([name, file]) => [name.slice(folder.length + 1), file.bytes.subarray(0, file.size)]),
    remove(folder) {
      for (const name of [...entries.keys()])
        if (name === folder || name.startsWith(`${folder}/`)) entries.delete(name);
    },
  };
  return files;
}

/** Simplifies a name: "a/./b/../c" becomes "a/c". */
function plainName(name) {
  const parts = [];
  for (const part of name.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== "" && part !== ".") parts.push(part);
  }
  return parts.join("/");
}

const parentOf = (name) => name.slice(0, Math.max(0, name.lastIndexOf("/")));

/** State that the calls below share: open descriptors, and the module's memory. */
function makeHost(files, memory, print) {
  const open = new Map([[0, { name: "" }], [1, { print: true }], [2, { print: true }], [3, { name: "" }]]);
  const host = { files, entries: files.entries, open, next: 4,
    view: () => new DataView(memory().buffer),
    bytes: () => new Uint8Array(memory().buffer),
    nameAt: (at, length) => plainName(new TextDecoder().decode(host.bytes().slice(at, at + length))),
    /** The parts of memory that a list of addresses and sizes describes. */
    pieces: (at, count) => Array.from({ length: count }, (_, i) => {
      const from = host.view().getUint32(at + 8 * i, true);
      return host.bytes().subarray(from, from + host.view().getUint32(at + 8 * i + 4, true));
    }),
    writeStat(at, name) {
      const file = host.entries.get(name);
      const v = host.view();
      for (let k = 0; k < 64; k += 8) v.setBigUint64(at + k, 0n, true);
      v.setBigUint64(at + 8, BigInt(files.numberOf(file, name)), true);
      v.setUint8(at + 16, file ? kinds.file : kinds.directory);
      v.setBigUint64(at + 24, 1n, true);
      v.setBigUint64(at + 32, BigInt(file?.size ?? 0), true);
      return errors.SUCCESS;
    },
    writeTo(one, piece) {
      if (one.print) return print(new TextDecoder().decode(piece.slice())), true;
      const { file } = one;
      if (!makeRoom(file, one.at + piece.length)) return false;
      file.bytes.set(piece, one.at);
      one.at += piece.length;
      file.size = Math.max(file.size, one.at);
      return true;
    },
  };
  return host;
}

/** Calls about descriptors. */
const descriptorCalls = ({ open, view, bytes, writeStat }) => ({
  fd_prestat_get(fd, at) {
    if (fd !== 3) return errors.BADF;
    view().setUint32(at, 0, true);
    view().setUint32(at + 4, 1, true);
    return errors.SUCCESS;
  },
  fd_prestat_dir_name: (fd, at) => (bytes()[at] = 47, errors.SUCCESS), // "/"
  fd_fdstat_get(fd, at) {
    const one = open.get(fd);
    if (!one) return errors.BADF;
    const v = view();
    v.setBigUint64(at, 0n, true);
    v.setUint8(at, one.print ? 2 : one.file ? kinds.file : kinds.directory);
    v.setUint16(at + 2, one.appends ? 1 : 0, true);
    v.setBigUint64(at + 8, 0xffffffffffffn, true);
    v.setBigUint64(at + 16, 0xffffffffffffn, true);
    return errors.SUCCESS;
  },
  fd_fdstat_set_flags: () => errors.SUCCESS,
  fd_sync: () => errors.SUCCESS,
  fd_datasync: () => errors.SUCCESS,
  fd_close: (fd) => (open.delete(fd) ? errors.SUCCESS : errors.BADF),
  fd_filestat_get(fd, at) {
    const one = open.get(fd);
    return one && !one.print ? writeStat(at, one.name) : errors.BADF;
  },
  fd_filestat_set_size(fd, size) {
    const file = open.get(fd)?.file;
    if (!file) return errors.BADF;
    if (!makeRoom(file, Number(size))) return errors.NOSPC;
    file.bytes.fill(0, Math.min(file.size, Number(size)), Number(size));
    file.size = Number(size);
    return errors.SUCCESS;
  },
});

/** Reading and writing. */
const byteCalls = ({ open, view, pieces, writeTo }) => ({
  fd_seek(fd, offset, whence, at) {
    const one = open.get(fd);
    if (!one?.file) return errors.BADF;
    one.at = Number(offset) + [0, one.at, one.file.size][whence];
    view().setBigUint64(at, BigInt(one.at), true);
    return errors.SUCCESS;
  },
  fd_write(fd, at, count, into) {
    const one = open.get(fd);
    if (!one?.file && !one?.print) return errors.BADF;
    let written = 0;
    for (const piece of pieces(at, count)) {
      if (!writeTo(one, piece)) return errors.NOSPC;
      written += piece.length;
    }
    view().setUint32(into, written, true);
    return errors.SUCCESS;
  },
  fd_read(fd, at, count, into) {
    const one = open.get(fd);
    if (!one?.file) return errors.BADF;
    let read = 0;
    for (const piece of pieces(at, count)) {
      const part = one.file.bytes.subarray(one.at, Math.min(one.file.size, one.at + piece.length));
      piece.set(part);
      one.at += part.length;
      read += part.length;
    }
    view().setUint32(into, read, true);
    return errors.SUCCESS;
  },
});

/** Opening by a name, and what a folder has. */
const openingCalls = (host) => ({
  path_open(fd, follow, nameFrom, nameLength, flags, rights, inheriting, fdFlags, into) {
    const { entries, open } = host;
    const name = host.nameAt(nameFrom, nameLength);
    const [creates, isFolder, isNew, cuts] = [1, 2, 4, 8].map((bit) => (flags & bit) !== 0);
    if (entries.has(name) && creates && isNew) return errors.EXIST;
    if (!entries.has(name)) {
      if (!creates || entries.get(parentOf(name)) !== null) return errors.NOENT;
      entries.set(name, emptyFile());
    }
    const file = entries.get(name);
    if (isFolder && file) return errors.NOTDIR;
    if (cuts && file) file.size = 0;
    const appends = (fdFlags & 1) !== 0;
    open.set(host.next, { name, file, at: appends && file ? file.size : 0, appends });
    host.view().setUint32(into, host.next++, true);
    return errors.SUCCESS;
  },
  fd_readdir(fd, at, length, cookie, into) {
    const { entries, open } = host;
    const folder = open.get(fd)?.name;
    const names = [...entries.keys()].filter((name) => name !== "" && parentOf(name) === folder);
    let used = 0;
    for (let i = Number(cookie); i < names.length && used < length; ++i) {
      const name = new TextEncoder().encode(names[i].slice(folder === "" ? 0 : folder.length + 1));
      const record = new Uint8Array(24 + name.length);
      const v = new DataView(record.buffer);
      v.setBigUint64(0, BigInt(i + 1), true);
      v.setUint32(16, name.length, true);
      v.setUint8(20, entries.get(names[i]) ? kinds.file : kinds.directory);
      record.set(name, 24);
      const part = record.subarray(0, Math.min(record.length, length - used));
      host.bytes().set(part, at + used);
      used += part.length;
    }
    host.view().setUint32(into, used, true);
    return errors.SUCCESS;
  },
});

/** Making, renaming and removing by names. */
const nameCalls = ({ entries, open, nameAt, writeStat }) => ({
  path_filestat_get(fd, follow, nameFrom, nameLength, at) {
    const name = nameAt(nameFrom, nameLength);
    return entries.has(name) ? writeStat(at, name) : errors.NOENT;
  },
  path_create_directory(fd, nameFrom, nameLength) {
    const name = nameAt(nameFrom, nameLength);
    if (entries.has(name)) return errors.EXIST;
    if (entries.get(parentOf(name)) !== null) return errors.NOENT;
    entries.set(name, null);
    return errors.SUCCESS;
  },
  path_unlink_file(fd, nameFrom, nameLength) {
    const name = nameAt(nameFrom, nameLength);
    if (!entries.has(name)) return errors.NOENT;
    if (entries.get(name) === null) return errors.ISDIR;
    entries.delete(name);
    return errors.SUCCESS;
  },
  path_remove_directory(fd, nameFrom, nameLength) {
    const name = nameAt(nameFrom, nameLength);
    if (entries.get(name) !== null || !entries.has(name)) return entries.has(name) ? errors.NOTDIR : errors.NOENT;
    if ([...entries.keys()].some((other) => other.startsWith(`${name}/`))) return errors.NOTEMPTY;
    entries.delete(name);
    return errors.SUCCESS;
  },
  path_rename(fd, fromAt, fromLength, toFd, toAt, toLength) {
    const [from, to] = [nameAt(fromAt, fromLength), nameAt(toAt, toLength)];
    if (!entries.get(from)) return errors.NOENT;
    entries.set(to, entries.get(from));
    entries.delete(from);
    for (const one of open.values()) if (one.name === from) one.name = to;
    return errors.SUCCESS;
  },
  path_readlink: () => errors.INVAL,
});

/** Imports of a module from WASI. `memory()` returns the module's memory once it exists. */
function makeSystem(files, memory, print = () => {}) {
  const host = makeHost(files, memory, print);
  const { view } = host;
  const calls = { ...descriptorCalls(host), ...byteCalls(host), ...openingCalls(host), ...nameCalls(host),
    clock_time_get(id, precision, at) {
      const milliseconds = id === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(milliseconds * 1e6)), true);
      return errors.SUCCESS;
    },
    environ_sizes_get(countAt, sizeAt) {
      view().setUint32(countAt, 0, true);
      view().setUint32(sizeAt, 0, true);
      return errors.SUCCESS;
    },
    environ_get: () => errors.SUCCESS,
    sched_yield: () => errors.SUCCESS,
    proc_exit(code) {
      throw new Error(`the module ended with code ${code}`);
    },
  };
  return new Proxy(calls, { get: (all, name) => all[name] ?? (() => errors.NOSYS) });
}
