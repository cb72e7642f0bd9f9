#!/usr/bin/env python3
"""hardening.py FILE…: checks that the program and the libraries of a release build are hardened: position-independent, all
relocations read-only before main (full RELRO), no executable stack, stack protector, FORTIFY, and on x86-64 a landing pad at each
exported function and the marks of control-flow protection (CET). The compiler flags are in meson.build."""
import os
import platform
import re
import subprocess
import sys


def output(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def landing_pads(path):
    """Exported functions that do not begin with endbr64; None if the machine has no such instruction."""
    if platform.machine() != "x86_64":
        return None
    exported = {line.split()[-1].split("@")[0] for line in output("readelf", "-Ws", "--dyn-syms", path).splitlines()
                if re.search(r" FUNC +GLOBAL +DEFAULT +\d", line)}
    without, name = [], None
    for line in output("objdump", "-d", "--no-show-raw-insn", path).splitlines():
        start = re.match(r"[0-9a-f]+ <(\w+)>:", line)
        if start:
            name = start.group(1) if start.group(1) in exported else None
        elif name and line.strip():
            if "endbr64" not in line:
                without.append(name)
            name = None
    return [name for name in without if name != "_start"]  # from the C library


def marks(path):
    """The features that all objects of a file are marked for: IBT (landing pads), SHSTK (shadow stack)."""
    lists = re.findall(r"x86 feature: (.*)", output("readelf", "-Wn", path))
    return set.intersection(*(set(found.split(", ")) for found in lists)) if lists else set()


def wanted_marks(path):
    """The objects of a static library need both marks; other files need IBT only if the C library's start files, which are linked into every file,
    have it."""
    if platform.machine() != "x86_64":
        return set()
    start_files = [output("cc", "-print-file-name=" + name).strip() for name in ("Scrt1.o", "crti.o", "crtn.o")]
    return {"SHSTK", "IBT"} if path.endswith(".a") or all("IBT" in marks(name) for name in start_files) else {"SHSTK"}


def properties(path):
    wanted = wanted_marks(path)
    yield "marks " + (", ".join(sorted(wanted)) or "none"), wanted <= marks(path)
    if path.endswith(".a"):
        return
    header, segments = output("readelf", "-Wh", path), output("readelf", "-Wl", path)
    dynamic, symbols = output("readelf", "-Wd", path), output("readelf", "-Ws", "--dyn-syms", path)
    yield "position-independent", "DYN (" in header
    yield "full RELRO", "GNU_RELRO" in segments and "NOW" in dynamic
    yield "no executable stack", re.search(r"GNU_STACK .* RW ", segments) is not None
    yield "stack protector", "__stack_chk_fail" in symbols
    yield "FORTIFY", re.search(r"UND __\w+_chk(@|$| )", symbols, re.M) is not None
    without = landing_pads(path)
    if without is not None:
        yield "landing pads" + ("" if not without else ": none in " + ", ".join(without[:5])), not without


def main():
    rows = [(os.path.basename(path), name, good) for path in sys.argv[1:] for name, good in properties(path)]
    print("1..%d" % len(rows))
    for number, (path, name, good) in enumerate(rows, 1):
        print("%s %d - %s: %s" % ("ok" if good else "not ok", number, path, name))
    return 0 if all(good for _, _, good in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
