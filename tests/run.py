#!/usr/bin/env python3
"""run.py [VARIANT …]: the whole test suite: builds with both compilers, in release and debug, with sanitizers, runs every test,
counts. `run.py gl` runs only what needs OpenGL, and names the drivers that it ran on; `run.py long` what takes too long for every day:
Meson's suite "long".

The last line is `N passed, N failed`, counted from the test programs' own output. Everything is built in
build-test/; a variant's log is build-test/VARIANT/meson-logs/testlog.txt.
"""
import json
import os
import re
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-test")

# Each variant is another build of the same tree. "only" names the tests for which it matters.
VARIANTS = [
    {"name": "gcc-release", "cc": "gcc", "options": ["--buildtype=release"]},
    {"name": "clang-sanitized", "cc": "clang", "options": ["--buildtype=debugoptimized", "-Db_sanitize=address,undefined",
                                                          "-Db_lundef=false"]},
    {"name": "gcc-debug", "cc": "gcc", "options": ["--buildtype=debug"], "only": ["images", "lighting-widths", "shapes"]},
    {"name": "clang-release", "cc": "clang", "options": ["--buildtype=release"], "only": ["images", "lighting-widths", "shapes"]},
    {"name": "clang-threads", "cc": "clang", "options": ["--buildtype=debugoptimized", "-Db_sanitize=thread",
                                                        "-Db_lundef=false"], "only": ["device", "obj", "obj-large", "ply", "stl"]},
]

# Not part of the whole suite: the same tests alone. Lines that match "tell" are printed.
GL = {"name": "gcc-release", "cc": "gcc", "options": ["--buildtype=release"], "tell": r"^gl .*OpenGL.*|.*farthest off.*|^the mask: .*",
      "only": ["gl-context", "gl-classic", "gl-device", "gl-caller", "gl-state", "gl-parity", "glsl"]}

# Not part of it either: tests/meson.build marks its tests with suite: 'long'.
LONG = {"name": "gcc-release", "cc": "gcc", "options": ["--buildtype=release"], "suite": ["--suite", "long"]}

ENVIRONMENT = {
    # A sanitizer's report fails its test. Following the storage that OpenGL's libraries have for each
    # thread, clang 14's search for leaks takes them for glibc 2.19's and may read where nothing is ("Tracer caught signal 11").
    "ASAN_OPTIONS": "detect_leaks=1:abort_on_error=0:allocator_may_return_null=1:intercept_tls_get_addr=0",
    # Mesa 25 (Debian 13) keeps 2352 bytes of its own to the end.
    "LSAN_OPTIONS": "suppressions=%s:print_suppressions=0" % os.path.join(ROOT, "tests", "leaks.supp"),
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    "TSAN_OPTIONS": "halt_on_error=1",
    "CMOCKA_MESSAGE_OUTPUT": "TAP",
}


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def build(variant):
    """Configures if needed and builds; returns an error text or None."""
    folder = os.path.join(OUT, variant["name"])
    if not os.path.exists(os.path.join(folder, "build.ninja")):
        done = run(["meson", "setup", folder, ROOT, "-Dtests=true"] + variant["options"], env={**os.environ, "CC": variant["cc"]})
        if done.returncode:
            return done.stdout
    # If only some tests run, only they are built: the other variants have compiled the rest.
    done = run(["ninja", "-C", folder] + ["tests/test-" + name for name in variant.get("only", [])])
    warnings = [line for line in done.stdout.splitlines() if "warning:" in line]
    if done.returncode:
        return done.stdout
    return "\n".join(warnings) if warnings else None


def count(entry):
    """Passed, failed and skipped checks of one test program, and the lines about failures."""
    output = entry.get("stdout", "") + entry.get("stderr", "")
    passed = len(re.findall(r"^ok \d+(?!.*# SKIP)", output, re.M))
    skipped = len(re.findall(r"^(?:not )?ok \d+.*# SKIP", output, re.M))  # CMocka says "not ok" there
    failures = re.findall(r"^not ok (?!.*# SKIP).*", output, re.M)
    if entry["result"] not in ("OK", "SKIP", "EXPECTEDFAIL") and not failures:
        failures = ["%s: ended with %s (%s)" % (entry["name"], entry["result"], entry.get("returncode"))]
    return passed, len(failures), skipped, failures


def test(variant):
    folder = os.path.join(OUT, variant["name"])
    log = os.path.join(folder, "meson-logs", "testlog.json")
    if os.path.exists(log):
        os.remove(log)
    run(["meson", "test", "-C", folder, "--no-rebuild", "--num-processes", str(max(2, len(os.sched_getaffinity(0)))), "--timeout-multiplier", "4",
         *variant.get("suite", [])] + variant.get("only", []),
        env={**os.environ, **ENVIRONMENT})
    totals = [0, 0, 0]
    told = set()
    if not os.path.exists(log):
        print("  no test of this variant ran")
        return [0, 1, 0]
    for line in open(log):
        entry = json.loads(line)
        passed, failed, skipped, failures = count(entry)
        if passed + failed + skipped == 0:
            failed, failures = 1, ["%s: ran no check" % entry["name"]]
        for i, n in enumerate((passed, failed, skipped)):
            totals[i] += n
        print("  %-28s %4d passed%s%s  %5.1f s" % (entry["name"], passed, ", %d failed" % failed if failed else "",
                                                  ", %d skipped" % skipped if skipped else "", entry.get("duration", 0)))
        if failed:
            print("    " + "\n    ".join(failures[:20]))
            print("    " + "\n    ".join((entry.get("stdout", "") + entry.get("stderr", "")).splitlines()[-40:]))
        for line in (entry.get("stdout", "") + entry.get("stderr", "")).splitlines():
            if re.match(variant.get("tell", "$."), line) and line not in told:
                told.add(line)
                print("    " + line)
        sys.stdout.flush()
    if "tell" in variant and not told:
        print("  OpenGL was not found: `lambent devices` says why")
    return totals


def main():
    names = sys.argv[1:]
    totals = [0, 0, 0]
    alone = {"gl": [GL], "long": [LONG]}.get(names[0] if len(names) == 1 else None)
    for variant in alone or VARIANTS:
        if names and not alone and variant["name"] not in names:
            continue
        start = time.time()
        print("%s: building" % variant["name"], flush=True)
        problem = build(variant)
        if problem:
            print(problem[-6000:])
            print("%s: a build that fails or warns counts as 1 failed" % variant["name"])
            totals[1] += 1  # a broken build and a warning both fail
        built = time.time()
        print("%s: built in %.0f s, testing" % (variant["name"], built - start), flush=True)
        result = test(variant)
        totals = [a + b for a, b in zip(totals, result)]
        print("%s: %d passed, %d failed, %d skipped in %.0f s" % (variant["name"], *result, time.time() - built), flush=True)
    if totals[2]:
        print("%d skipped: they say why in build-test/VARIANT/meson-logs/testlog.txt" % totals[2])
    print("%d passed, %d failed" % (totals[0], totals[1]))
    return 1 if totals[1] or not totals[0] else 0


if __name__ == "__main__":
    sys.exit(main())
