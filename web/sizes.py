#!/usr/bin/env python3
"""sizes.py [FOLDER]: what a page loads first, part by part, as docs/web.md has it (tests/web.py compares). FOLDER: build-web, after make web.

The linker's map says which object each byte of the module comes from; gzip packs the parts together, so it has a size for the whole alone."""
import gzip
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import build  # noqa: E402

# Parts of the module: title, and what the object of a symbol is called in the map. The first that fits.
PARTS = [
    ("drawing: the kernels with SIMD", r"cpu-wasm\.a\.p"),
    ("explaining: the shading that keeps its numbers", r"cpu-recording\.a\.p"),
    ("JPEG", r"libjpeg"),
    ("PNG", r"libspng|libz\.a|lambent-image\.a\.p/png_"),
    ("model formats and scene files", r"lambent-(import|load|scene-file)\.a\.p|lambent-json|libjansson"),
    ("options, jobs, explanations as JSON", r"session\.a\.p"),
    ("the C library", r"wasm32-wasi|clang_rt|web-libc"),
    ("texts: option summaries, messages", r"<internal>.*rodata"),
    ("geometry, environments, shadows, edges, other pictures", r""),
]

FIRST = "all that loads first"


def parts_of(map_path):
    """Bytes by part. A line of the map has address, offset, size, and for a section of an object its file and symbol."""
    sizes = dict.fromkeys((title for title, _ in PARTS), 0)
    inside = False
    for line in open(map_path):
        found = re.match(r"\s*\S+\s+[0-9a-f]+\s+([0-9a-f]+)\s+(.*)", line)
        if not found:
            continue
        name = found[2].strip()
        if name in ("CODE", "DATA", "name", "producers", "target_features"):
            inside = name in ("CODE", "DATA")
        if inside and ":(" in name:
            sizes[next(title for title, pattern in PARTS if re.search(pattern, name))] += int(found[1], 16)
    return sizes


def packed(path):
    return len(gzip.compress(open(path, "rb").read(), 9))


def table(folder):
    """Rows: title, bytes, bytes after gzip or None."""
    module = os.path.join(folder, "wasm", "web", "lambent.wasm")
    rows = [(title, size, None) for title, size in parts_of(os.path.join(folder, "wasm", "web", "lambent.map")).items()]
    rows.append(("the module", os.path.getsize(module), packed(module)))
    page = os.path.join(folder, "page")
    first = build.modules_of(build.PAGE) + build.modules_of(build.WORKER)
    later = [name for name in build.later_modules_of(build.PAGE) + build.later_modules_of(build.WORKER) + build.modules_of(build.THREAD) if name not in first]
    later.append(build.CODEMIRROR)
    shaders = [name for name in build.modules_of(build.CHECK_WORKER) if name not in first + later]
    files = [name for name in os.listdir(page) if name.endswith((".js", ".html", ".css"))]

    def of(title, names):
        paths = [os.path.join(page, name) for name in names]
        return title, sum(os.path.getsize(path) for path in paths), sum(packed(path) for path in paths)

    rows.append(of("its part that draws the first picture", ["lambent.wasm"]))
    rows.append(of("scripts, page and style", [name for name in files if name not in later + shaders]))
    rows.append((FIRST, rows[-2][1] + rows[-1][1], rows[-2][2] + rows[-1][2]))
    rows.append(of("the other part of the module, fetched after the first picture", ["lambent-rest.wasm"]))
    rows.append(of("the module with threads, fetched in its place where the page is cross-origin isolated", ["lambent-threads.wasm"]))
    rows.append(of("scripts that are fetched when they are used", [name for name in files if name in later]))
    rows.append(of("checks of shaders, fetched when one is checked", [*shaders, "check.wasm"]))
    return rows


def main():
    print("| part | kB | kB after gzip |\n|---|---|---|")
    for title, size, small in table(sys.argv[1] if len(sys.argv) > 1 else "build-web"):
        print("| %s | %d | %s |" % (title, round(size / 1000), "" if small is None else round(small / 1000)))


if __name__ == "__main__":
    main()
