#!/usr/bin/env python3
"""run.py [more|long|gl] [VARIANT …]: builds Lambent, runs its tests and counts them. Without a word, it runs the tests for every change: the suite
without a name in tests/meson.build. `more` runs the suite "more", `long` both "more" and "long", and `gl` the tests that need OpenGL; it also prints
the drivers.

It builds everything in build-test/, and only what the tests need. The tests of all variants share one pool with one process per processor; tests that
Meson marks as not parallel run alone, at the end. The output of a test is in build-test/VARIANT/tests/NAME.txt, and the time of each test is in
build-test/tests.json. The last line is `N passed, N failed`, counted from the output of the test programs; the durations precede it. It lists tests
that take more than 5 s of processor time.
"""
import concurrent.futures
import json
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-test")

# Each variant is another build of the same tree. "only" lists the tests to which it applies, "suites" the words with which it runs.
VARIANTS = [
    {"name": "gcc-release", "cc": "gcc", "options": ["--buildtype=release"], "suites": ["now", "more", "long"]},
    {"name": "clang-sanitized", "cc": "clang", "options": ["--buildtype=debugoptimized", "-Doptimization=1", "-Dc_args=-g1",
                                                          "-Db_sanitize=address,undefined", "-Db_lundef=false"], "suites": ["now", "more", "long"]},
    {"name": "clang-release", "cc": "clang", "options": ["--buildtype=release"], "suites": ["more", "long"], "only": ["images", "lighting-widths", "shapes"]},
    {"name": "clang-threads", "cc": "clang", "options": ["--buildtype=debugoptimized", "-Db_sanitize=thread", "-Db_lundef=false"],
     "suites": ["more", "long"], "only": ["cli-batch", "cli-view", "cli-worker", "device", "large-files", "obj", "obj-large", "ply", "stl"]},
    {"name": "gcc-debug", "cc": "gcc", "options": ["--buildtype=debug"], "suites": ["long"], "only": ["images", "lighting-widths", "shapes"]},
]
SUITES = {"now": [""], "more": ["more"], "long": ["more", "long"]} # the suites of tests/meson.build for each word

# This variant is not part of the whole suite; it runs the same tests alone. Lines that match "tell"
# are printed.
GL = {**VARIANTS[0], "env": {"LAMBENT_LONG": "1"}, "tell": r"^gl .*OpenGL.*|.*farthest off.*|^the mask: .*",
      "only": ["gl-context", "gl-classic", "gl-device", "gl-caller", "gl-state", "gl-parity", "glsl"]}

ENVIRONMENT = {
    "XDG_CONFIG_HOME": "/nonexistent",  # ignore the settings of the user who runs the tests
    # A sanitizer's report fails its test. When clang 14's leak detector follows the thread storage of OpenGL's libraries, it
    # mistakes it for glibc 2.19's and may read unmapped memory ("Tracer caught signal 11").
    "ASAN_OPTIONS": "detect_leaks=1:abort_on_error=0:allocator_may_return_null=1:intercept_tls_get_addr=0",
    # Mesa 25 (Debian 13) keeps 2352 bytes of its own until the end.
    "LSAN_OPTIONS": "suppressions=%s:print_suppressions=0" % os.path.join(ROOT, "tests", "leaks.supp"),
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    "TSAN_OPTIONS": "halt_on_error=1",
    "CMOCKA_MESSAGE_OUTPUT": "TAP",
    # glibc fills new memory with this value, so code that reads uninitialized memory finds the same
    # value in each run.
    "MALLOC_PERTURB_": "165",
}
RUNNING = set() # tests, each the leader of its process group
SLOWER = 4 # Meson's limits are for an idle machine


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def introspect(variant, what):
    done = subprocess.run(["meson", "introspect", "--" + what, os.path.join(OUT, variant["name"])], stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def configure(variant):
    """Returns an error text or None."""
    folder = os.path.join(OUT, variant["name"])
    if os.path.exists(os.path.join(folder, "build.ninja")):
        done = run(["ninja", "-C", folder, "build.ninja"]) # Meson's list of tests is from its last look at meson.build
        return done.stdout if done.returncode else None
    done = run(["meson", "setup", folder, ROOT, "-Dtests=true"] + variant["options"], env={**os.environ, "CC": variant["cc"]})
    return done.stdout if done.returncode else None


def build(variant, tests):
    """Builds the programs that the tests run, and all installed files if the tests install them; returns an error text or None."""
    folder = os.path.join(OUT, variant["name"])
    wanted = {test["cmd"][0] for test in tests}.union(*(test["depends"] for test in tests))
    installs = any(test["name"] == "headers" for test in tests)
    files = [file for target in introspect(variant, "targets")
             if target["id"] in wanted or (target["installed"] and installs) or wanted.intersection(target["filename"])
             for file in target["filename"]]
    done = run(["ninja", "-C", folder] + sorted({os.path.relpath(file, folder) for file in files}))
    warnings = [line for line in done.stdout.splitlines() if "warning:" in line]
    if done.returncode:
        return done.stdout
    return "\n".join(warnings) if warnings else None


def count(output, end):
    """The passed, failed and skipped checks of one test program, and the lines about failures. `end` describes how it ended, or is empty."""
    passed = len(re.findall(r"^ok \d+(?!.*# SKIP)", output, re.M))
    skipped = len(re.findall(r"^(?:not )?ok \d+.*# SKIP", output, re.M))  # CMocka prints "not ok" there
    failures = re.findall(r"^not ok (?!.*# SKIP).*", output, re.M)
    if not failures and (end or passed + skipped == 0):
        failures = [end or "ran no check"]
    return passed, len(failures), skipped, failures


def tests_of(variant, suites):
    """Meson's data about the variant's tests that are to run."""
    found, names = introspect(variant, "tests"), variant.get("only")
    for name in names or []:
        assert name in [test["name"] for test in found], "%s has no test '%s'" % (variant["name"], name)
    if names: # in any suite: other variants run the rest
        return [dict(test, variant=variant) for test in found if test["name"] in names]
    return [dict(test, variant=variant) for test in found if (test["suite"][0].partition(":")[2] if test["suite"] else "") in suites]


def end_of(status, late):
    """Describes how a test ended, if it failed."""
    if late:
        return "ended after its time of %d s" % late
    if os.WIFSIGNALED(status):
        return "ended by signal %d (%s)" % (os.WTERMSIG(status), signal.Signals(os.WTERMSIG(status)).name)
    return "ended with exit code %d" % os.WEXITSTATUS(status) if os.WEXITSTATUS(status) not in (0, 77) else ""


def run_test(test):
    """Runs a test in its own process group, which is killed when its time is over."""
    folder = os.path.join(OUT, test["variant"]["name"])
    path = os.path.join(folder, "tests", test["name"] + ".txt")
    limit, late = test["timeout"] * SLOWER, []
    start = time.time()
    with open(path, "wb") as log:
        process = subprocess.Popen(test["cmd"], cwd=test["workdir"] or folder, env={**os.environ, **ENVIRONMENT, **test["variant"].get("env", {}), **test["env"]}, stdin=subprocess.DEVNULL,
                                   stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

        def stop():
            late.append(limit)
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(limit, stop)
        timer.start()
        RUNNING.add(process.pid)
        _, status, used = os.wait4(process.pid, 0) # including the processes that it waited for
        RUNNING.discard(process.pid)
        timer.cancel()
        process.returncode = status
    with open(path, errors="replace") as log:
        output = log.read()
    counts = count(output, end_of(status, late and late[0]))
    return test, output, counts, used.ru_utime + used.ru_stime, time.time() - start


def tell(test, output, counts, processor, printed):
    """Prints a test's row, and its messages about failures."""
    passed, failed, skipped, failures = counts
    print("  %-15s %-24s %4d passed%s%s  %5.1f s" % (test["variant"]["name"], test["name"], passed, ", %d failed" % failed if failed else "",
                                                    ", %d skipped" % skipped if skipped else "", processor))
    if failed:
        print("    " + "\n    ".join(failures[:20]))
        print("    " + "\n    ".join(output.splitlines()[-40:]))
    for line in output.splitlines():
        if re.match(test["variant"].get("tell", "$."), line) and line not in printed:
            printed.add(line)
            print("    " + line)
    sys.stdout.flush()


def run_tests(tests):
    """Runs tests, first those that tests/meson.build marks as first; returns (test, counts, processor time, time) of each, and the printed lines."""
    done, printed = [], set()
    for folder in {os.path.join(OUT, test["variant"]["name"], "tests") for test in tests}:
        os.makedirs(folder, exist_ok=True)
    for processes, chosen in ((max(2, len(os.sched_getaffinity(0))), [test for test in tests if test["is_parallel"]]),
                              (1, [test for test in tests if not test["is_parallel"]])):
        with concurrent.futures.ThreadPoolExecutor(processes) as pool:
            jobs = [pool.submit(run_test, test) for test in sorted(chosen, key=lambda test: -test["priority"])]
            try:
                for job in concurrent.futures.as_completed(jobs):
                    test, output, counts, processor, wall = job.result()
                    tell(test, output, counts, processor, printed)
                    done.append((test, counts, processor, wall))
            except KeyboardInterrupt:
                pool.shutdown(wait=False, cancel_futures=True)
                for group in list(RUNNING):
                    os.killpg(group, signal.SIGTERM)
                sys.exit("run.py: interrupted")
    return done, printed


def minutes(seconds):
    return "%d min %d s" % divmod(round(seconds), 60) if seconds >= 60 else "%d s" % round(seconds)


def main():
    signal.signal(signal.SIGINT, signal.default_int_handler) # background jobs of a shell ignore it, and so would the tests
    words = sys.argv[1:]
    word = words.pop(0) if words and words[0] in ("more", "long", "gl") else "now"
    known = [variant["name"] for variant in VARIANTS]
    if any(name not in known for name in words):
        sys.exit("run.py: expected more, long or gl, then some of: " + " ".join(known))
    variants = [GL] if word == "gl" else [variant for variant in VARIANTS if (variant["name"] in words if words else word in variant["suites"])]
    tests, totals, begin = [], [0, 0, 0], time.time()
    for variant in variants:
        start, before = time.time(), resource.getrusage(resource.RUSAGE_CHILDREN)
        print("%s: building" % variant["name"], flush=True)
        problem = configure(variant)
        if not problem:
            chosen = tests_of(variant, SUITES.get(word))
            problem = build(variant, chosen)
            tests += chosen
        if problem:
            print(problem[-6000:])
            print("%s: a build that fails or warns counts as 1 failed" % variant["name"])
            totals[1] += 1  # a broken build and a warning both fail
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        print("%s: built in %s, %.0f s of processor time" % (variant["name"], minutes(time.time() - start), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime), flush=True)
    start = time.time()
    done, printed = run_tests(tests)
    wall = time.time() - start
    with open(os.path.join(OUT, "tests%s.json" % ("" if word == "now" else "-" + word)), "w") as out:
        json.dump([{"variant": test["variant"]["name"], "test": test["name"], "passed": counts[0], "failed": counts[1], "skipped": counts[2],
                    "processor_s": round(processor, 2), "wall_s": round(wall, 2)} for test, counts, processor, wall in done], out, indent=0)
    for variant in variants:
        rows = [(counts, processor) for test, counts, processor, _ in done if test["variant"] is variant]
        sums = [sum(counts[i] for counts, _ in rows) for i in range(3)]
        totals = [a + b for a, b in zip(totals, sums)]
        print("%s: %d passed, %d failed, %d skipped, %.0f s of processor time" % (variant["name"], *sums, sum(processor for _, processor in rows)))
    if word == "gl" and not printed:
        print("OpenGL was not found: `lambent devices` says why")
    if totals[2]:
        print("%d skipped: they say why in build-test/VARIANT/tests/" % totals[2])
    slow = sorted(((processor, test) for test, _, processor, _ in done if processor > 5), key=lambda row: -row[0])
    if slow:
        print("more than 5 s of processor time: " + ", ".join("%s %s %.0f s" % (test["variant"]["name"], test["name"], processor) for processor, test in slow))
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print("tests took %.0f s of processor time, %s" % (sum(processor for _, _, processor, _ in done), minutes(wall)))
    print("with the builds: %.0f s of processor time, %s" % (used.ru_utime + used.ru_stime, minutes(time.time() - begin)))
    print("%d passed, %d failed" % (totals[0], totals[1]))
    return 1 if totals[1] or not totals[0] else 0


if __name__ == "__main__":
    sys.exit(main())
