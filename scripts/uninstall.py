#!/usr/bin/env python3
"""uninstall.py DESTDIR PREFIX: removes the files that `meson introspect --installed` lists on standard input, below DESTDIR, and the folders that are
then empty. It keeps the standard folders in PREFIX (bin, share, share/man …)."""
import json
import os
import sys

destination, prefix = sys.argv[1], sys.argv[1] + os.path.normpath(sys.argv[2])
folders = set()
removed = 0


def remove(path):
    global removed
    if os.path.lexists(path) and (os.path.islink(path) or not os.path.isdir(path)):
        os.remove(path)
        print("removed " + path)
        removed += 1
    folders.add(os.path.dirname(path))


for source, target in json.load(sys.stdin).items():
    target = destination + target
    if os.path.isdir(source) and os.path.isdir(target):
        for name in os.listdir(source):
            remove(os.path.join(target, name))
    else:
        remove(target)
        # The links of a shared library are not listed.
        folder, name = os.path.split(target)
        stem = name.split(".so")[0] + ".so"
        if ".so." in name and os.path.isdir(folder):
            for other in os.listdir(folder):
                if other == stem or other.startswith(stem + "."):
                    remove(os.path.join(folder, other))
for folder in folders:
    below = os.path.relpath(folder, prefix)
    while "/" in below and not below.startswith("..") and below != "share/man" and os.path.isdir(folder) and not os.listdir(folder):
        os.rmdir(folder)
        folder, below = os.path.dirname(folder), os.path.dirname(below)
if not removed:
    sys.exit("nothing of Lambent is installed there")
