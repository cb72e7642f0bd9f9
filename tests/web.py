#!/usr/bin/env python3
"""web.py [PART]: the library as WebAssembly, run by node: the image table has the recorded hashes, with and without SIMD.

Builds build-web/ as `make web` does, the first time in a minute or two; then what has changed. Skipped where a package of the group
`web` (packages.txt) is missing, or Debian's sources of the libraries cannot be fetched."""
import concurrent.futures
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-web")
sys.path.insert(0, os.path.join(ROOT, "web"))
import build  # noqa: E402

PARTS = 2 # node's, at once


class Results:
    def __init__(self):
        self.count = self.failed = 0

    def ok(self, good, label, why=""):
        self.count += 1
        self.failed += not good
        print("%s %d - %s" % ("ok" if good else "not ok", self.count, label))
        if not good and why:
            print("# " + "\n# ".join(why.splitlines()[:20]))


def node(*words):
    return subprocess.run(["node", os.path.join(ROOT, "tests", "web", words[0]), *words[1:]], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


def check_hashes(results):
    expected = {line.split()[0]: line.split()[1:] for line in open(os.path.join(ROOT, "tests/images/expected/hashes.txt"))}
    module = os.path.join(OUT, "wasm", "web", "image-hashes.wasm")
    with concurrent.futures.ThreadPoolExecutor(PARTS) as pool:
        runs = list(pool.map(lambda part: node("run.mjs", module, str(part), str(PARTS)), range(PARTS)))
    drawn = {}
    for done in runs:
        results.ok(done.returncode == 0, "a part of the image table is drawn", done.stderr)
        for line in done.stdout.splitlines():
            isa, name, *hashes = line.split()
            drawn[isa, name] = hashes
    for isa in ("scalar", "wasm"):
        for name, hashes in expected.items():
            results.ok(drawn.get((isa, name)) == hashes, "%s: %s" % (isa, name),
                       "drew %s, recorded is %s" % (drawn.get((isa, name)), hashes))


def main():
    results = Results()
    if build.missing():
        print("ok 1 - web # SKIP not installed: %s\n1..1" % " ".join(build.missing()))
        return 0
    done = subprocess.run([sys.executable, os.path.join(ROOT, "web", "build.py"), OUT], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    if "apt-get" in done.stdout and done.returncode:
        print("ok 1 - web # SKIP Debian's sources cannot be fetched\n1..1")
        return 0
    results.ok(done.returncode == 0, "build-web is built", done.stdout)
    if done.returncode == 0:
        check_hashes(results)
    print("1..%d" % results.count)
    return 1 if results.failed else 0


if __name__ == "__main__":
    sys.exit(main())
