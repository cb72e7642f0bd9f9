#!/usr/bin/env python3
"""sizes.py [FOLDER]: the sizes of the files that a page loads, part by part, as in docs/web.md (tests/web.py compares). FOLDER is build-web, after
make web.

The linker's map contains the object of each byte of the module. For files that a server sends compressed, it also prints the compressed sizes."""
import json
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import module_parts  # noqa: E402

# Parts of the module: title, and a pattern for a symbol's object in the map. The first match
# counts.
PARTS = [
    ("drawing: the kernels with SIMD", r"-wasm\.a\.p"),
    ("explaining: the shading that keeps its numbers", r"cpu-recording\.a\.p"),
    ("JPEG", r"libjpeg"),
    ("PNG", r"libspng|libz\.a|lambent-image\.a\.p/png_"),
    ("model formats and scene files", r"lambent-(import|load|scene-file)\.a\.p|lambent-json|libjansson"),
    ("options, jobs, explanations as JSON", r"session\.a\.p"),
    ("the C library", r"wasm32-wasi|clang_rt|web-libc"),
    ("texts: option summaries, messages", r"<internal>.*rodata"),
    ("geometry, environments, shadows, edges, other pictures", r""),
]

FIRST, MODULE = "all files of the first load", "the module of a page: the first two parts"
THREADS = "the module with threads, loaded instead of the second part if the page is cross-origin isolated"


def parts_of(map_path):
    """Bytes by part. A line of the map contains address, offset, size, and for a section of an object its file and symbol."""
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


def packed(paths):
    """Bytes without compression, after gzip, and after brotli (web/build.py writes these files)."""
    return [sum(os.path.getsize(path + ending) for path in paths) for ending in ("", ".gz", ".br")]


def table(folder):
    """Rows: title, bytes, bytes after gzip and after brotli, or None."""
    module, page = os.path.join(folder, "wasm", "web", "lambent.wasm"), os.path.join(folder, "page")
    scripts = json.load(open(os.path.join(folder, "scripts.json")))

    def of(title, names):
        return (title, *packed([os.path.join(page, name) for name in names]))

    first, rest, more = module_parts.PARTS
    start = scripts["first"] + ["index.html", "page.css"]
    rows = [(title, size, None, None) for title, size in parts_of(os.path.join(folder, "wasm", "web", "lambent.map")).items()]
    rows += [("the module as a whole", os.path.getsize(module), None, None), of("its first part, which draws the first picture", [first]), of("scripts, page and style", start),
             of(FIRST, [first, *start]), of("its second part, loaded after the first picture", [rest]), of(MODULE, [first, rest]),
             of("its third part, loaded on first use: explanations, formulas, 3MF, scene files", [more]),
             of("the decoders of Draco and meshoptimizer, loaded when a file needs them", ["lambent-decoders.wasm"]),
             of(THREADS, [module_parts.THREADS_PARTS[0]]), of("its second part, loaded on first use", [module_parts.THREADS_PARTS[1]]),
             of("scripts that are loaded on first use", scripts["later"]),
             of("the editor of shaders", scripts["editor"]),
             of("the module of shader checks, loaded when you check a shader", ["check_worker.js", "check.wasm"])]
    return rows


def main():
    print("| part | kB | gzip | brotli |\n|---|---|---|---|")
    for title, *sizes in table(sys.argv[1] if len(sys.argv) > 1 else "build-web"):
        print("| %s | %s |" % (title, " | ".join("" if size is None else str(round(size / 1000)) for size in sizes)))


if __name__ == "__main__":
    main()
