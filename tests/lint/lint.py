#!/usr/bin/env python3
"""lint.py BUILD: cppcheck and clang-tidy over src, program, classroom and tools, with the compile commands of a build folder. Exceptions and their reasons
are in tests/lint/cppcheck.txt and .clang-tidy. Tools that are not installed are reported as skipped. The exit code is 1 if there is a finding."""
import concurrent.futures
import glob
import json
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Options that only gcc knows.
GCC_ONLY = re.compile(r" -f(excess-precision=\S+|no-semantic-interposition|no-thread-jumps)")


def commands(build):
    """One compile command for each C file of src, program, classroom and tools."""
    found = {}
    for entry in json.load(open(os.path.join(build, "compile_commands.json"))):
        path = os.path.relpath(os.path.realpath(os.path.join(entry["directory"], entry["file"])), ROOT)
        if path.endswith(".c") and path.startswith(("src/", "program/", "classroom/", "tools/")) and path not in found:
            found[path] = dict(entry, command=GCC_ONLY.sub("", entry["command"]))
    return found


def cppcheck(files):
    done = subprocess.run(["cppcheck", "-q", "-j", str(len(os.sched_getaffinity(0))), "--enable=warning,portability,performance", "--inline-suppr", "--std=c11",
                           "--language=c", "--suppressions-list=tests/lint/cppcheck.txt", "--suppress=missingIncludeSystem", "--suppress=unmatchedSuppression",
                           "-Iinclude", *["-I" + path for path in sorted(glob.glob("src/core/base/*/", root_dir=ROOT))], "-Isrc/system", "-Isrc/system/files", "-Isrc/core/lighting", "--template={file}:{line}: {id}: {message}", *files],
                          cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return [line for line in done.stdout.splitlines() if line.strip()]


def clang_tidy(found, build):
    folder = os.path.join(build, "lint")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "compile_commands.json"), "w") as out:
        json.dump(list(found.values()), out)

    def one(path):
        done = subprocess.run(["clang-tidy", "-p", folder, "--quiet", path], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return [line for line in done.stdout.splitlines() if re.search(r": (warning|error): ", line)]

    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        lines = [line for lines in pool.map(one, found) for line in lines]
    return sorted(set(lines))  # a header's finding is reported once


def main():
    build = os.path.abspath(sys.argv[1])
    found = commands(build)
    bad = 0
    for number, (name, run) in enumerate((("cppcheck", lambda: cppcheck(list(found))), ("clang-tidy", lambda: clang_tidy(found, build))), 1):
        if not shutil.which(name):
            print("ok %d - %s # SKIP not installed: apt-get install %s" % (number, name, name), flush=True)
            continue
        lines = run()
        bad += bool(lines)
        print("%sok %d - %s over %d files" % ("not " if lines else "", number, name, len(found)), flush=True)
        for line in lines:
            print("# " + line)
    print("1..2")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
