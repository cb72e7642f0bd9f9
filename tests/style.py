#!/usr/bin/env python3
"""style.py: checks that every C file, header and .inc file has the layout of one version of the formatter.

The version is fixed because clang-format's layout changes from release to release; Debian 12 and 13 both have this one.
The formatter never changes the text of a comment (.clang-format: ReflowComments)."""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FORMATTER = "clang-format-19"
FOLDERS = ("include", "src", "tools", "scenes", "examples", "bench", "docs", "tests", "web")


def sources(folder):
    for path, _, names in sorted(os.walk(os.path.join(ROOT, folder))):
        yield from (os.path.join(path, name) for name in sorted(names) if name.endswith((".c", ".h", ".inc")))


def main():
    failed = 0
    print("1..%d" % len(FOLDERS))
    for number, folder in enumerate(FOLDERS, 1):
        files = list(sources(folder))
        try:
            done = subprocess.run([FORMATTER, "--dry-run", "--Werror", *files], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, cwd=ROOT)
        except FileNotFoundError:
            print("not ok %d - %s: %s is not installed (packages.txt)" % (number, folder, FORMATTER))
            failed += 1
            continue
        ok = done.returncode == 0 and files
        print("%s %d - %s: %d files" % ("ok" if ok else "not ok", number, folder, len(files)))
        if not ok:
            failed += 1
            print("\n".join("# " + line for line in done.stdout.splitlines()[:40]))
            print("# mend it with: %s -i FILE" % FORMATTER)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
