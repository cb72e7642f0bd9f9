#!/usr/bin/env python3
"""style.py: checks that every C file, header and .inc file has the layout of one version of the formatter, and that pages, help, messages and
comments are free of the phrases and long sentences listed in english.py.

The version is fixed because clang-format's layout changes from release to release; Debian 12 and 13 both have this one.
The formatter never changes the text of a comment (.clang-format: ReflowComments).

Files with a correct layout are remembered in build-test/style.json by a hash of the formatter's version, .clang-format and their text. Only changed
files are formatted again, which takes a tenth of a second each."""
import hashlib
import json
import os
import re
import subprocess
import sys

import english

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FORMATTER = "clang-format-19"
REMEMBERED = os.path.join(ROOT, "build-test", "style.json")
FOLDERS = ("include", "src", "program", "classroom", "tools", "examples", "bench", "docs", "tests", "web")


def sources(folder):
    for path, _, names in sorted(os.walk(os.path.join(ROOT, folder))):
        yield from (os.path.join(path, name) for name in sorted(names) if name.endswith((".c", ".h", ".inc")))


def right_before(version):
    """The hashes of files with a correct layout, and a function that returns a file's hash."""
    rules = hashlib.sha256(version + open(os.path.join(ROOT, ".clang-format"), "rb").read())

    def hash_of(path):
        both = rules.copy()
        both.update(os.path.basename(path).encode() + b"\0" + open(path, "rb").read())
        return both.hexdigest()

    try:
        with open(REMEMBERED) as file:
            return set(json.load(file)), hash_of
    except (OSError, ValueError):
        return set(), hash_of


def remember(right):
    os.makedirs(os.path.dirname(REMEMBERED), exist_ok=True)
    with open(REMEMBERED + ".%d" % os.getpid(), "w") as file:
        json.dump(sorted(right), file, indent=0)
    os.replace(file.name, REMEMBERED)


def main():
    failed = 0
    try:
        version = subprocess.run([FORMATTER, "--version"], stdout=subprocess.PIPE, check=True).stdout
    except FileNotFoundError:
        print("1..1\nnot ok 1 - %s is not installed (packages.txt)" % FORMATTER)
        return 1
    before, hash_of = right_before(version)
    right = set()
    groups = list(english.files())
    print("1..%d" % (len(FOLDERS) + len(groups) + 1))
    for number, folder in enumerate(FOLDERS, 1):
        files = list(sources(folder))
        hashes = {path: hash_of(path) for path in files}
        changed = [path for path in files if hashes[path] not in before]
        done = subprocess.run([FORMATTER, "--dry-run", "--Werror", *changed], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, cwd=ROOT)
        ok = done.returncode == 0 and files
        right.update(hashes[path] for path in files if ok or path not in changed)
        print("%s %d - %s: %d files, %d formatted now" % ("ok" if ok else "not ok", number, folder, len(files), len(changed)))
        if not ok:
            failed += 1
            print("\n".join("# " + line for line in done.stdout.splitlines()[:40]))
            print("# mend it with: %s -i FILE" % FORMATTER)
    remember(right)
    return 1 if failed + check_english(groups, len(FOLDERS)) else 0


def check_english(groups, number):
    """Prints a row for each group of files, and one for the patterns themselves. Returns the number of failures."""
    failed = 0
    for name, paths in groups:
        number += 1
        found = [complaint for path in paths for complaint in english.complaints(path)]
        print("%s %d - English of %s: %d files" % ("not ok" if found or not paths else "ok", number, name, len(paths)))
        print("".join("# %s\n" % complaint for complaint in found[:40]), end="")
        failed += bool(found or not paths)
    blind = [pattern for (pattern, _), example in zip(english.PHRASES, english.EXAMPLES) if not re.search(pattern, example)]
    blind += [pattern for pattern, _, example in english.PAGE_PHRASES if not re.search(pattern, example)]
    blind += ["EXAMPLES"] * (len(english.PHRASES) != len(english.EXAMPLES))
    print("%s %d - each phrase is found in its example" % ("not ok" if blind else "ok", number + 1))
    print("".join("# %s\n" % pattern for pattern in blind), end="")
    return failed + bool(blind)


if __name__ == "__main__":
    sys.exit(main())
