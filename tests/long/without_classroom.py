#!/usr/bin/env python3
"""without_classroom.py: tests the renderer without the classroom: it builds with -Dclassroom=false, passes its tests, and each command that needs the
classroom reports this in an error message."""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.join(ROOT, "build-test", "without-classroom")
LAMBENT = os.path.join(BUILD, "lambent")
results = []


def check(name, ok, output=""):
    results.append(ok)
    print("%s %d - %s" % ("ok" if ok else "not ok", len(results), name), flush=True)
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-30:]), flush=True)


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT)


def main():
    setup = run("meson", "setup", BUILD, "--buildtype=release", "-Dclassroom=false", *(["--reconfigure"] if os.path.exists(BUILD) else []))
    built = run("ninja", "-C", BUILD)
    check("it builds", setup.returncode == 0 and built.returncode == 0, setup.stdout + built.stdout)
    tests = run("meson", "test", "-C", BUILD, "--no-suite", "more", "--no-suite", "long")
    check("its tests pass", tests.returncode == 0, tests.stdout)
    for words in (["check", "x.frag"], ["plot", "spot"], ["explain", "teapot", "9,9", "-s", "16", "-o", os.path.join(BUILD, "figure.svg")]):
        done = run(LAMBENT, *words)
        check("'%s' is refused" % words[0], done.returncode == 3 and "install the package lambent-classroom" in done.stdout.splitlines()[-1], done.stdout)
    check("no figure is left", not os.path.exists(os.path.join(BUILD, "figure.svg")))
    print("1..%d" % len(results))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
