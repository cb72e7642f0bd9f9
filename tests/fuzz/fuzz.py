#!/usr/bin/env python3
"""fuzz.py [time=SECONDS] [runs=N] [jobs=N] [coverage] [TARGET …]: builds the fuzz targets with libFuzzer and sanitizers, and runs them one after
another, for a minute each by default.

With `coverage`, nothing is fuzzed: a build in build-fuzz/coverage runs the seeds and the inputs found so far, and the table shows the lines of
each reader that they reach (clang's source coverage).

Inputs that reach new code are kept in build-fuzz/corpus/TARGET, so that the next run continues from there; failing inputs are written to
build-fuzz/finds, and their names are printed. One line for each target: executions, coverage at the
beginning and at the end, finds. The exit code is 1 if there is a find.
"""
import glob
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
OUT = os.path.join(ROOT, "build-fuzz")
MODELS = os.path.join(ROOT, "..", "shared", "models")

# A target's initial inputs, besides its corpus: folders and file extensions. Folders below `MODELS` are used if they
# exist. A format without a row here starts with its files in tests/models and tests/pictures.
SEEDS = {
    "obj": [("tests/models", ".obj"), ("MODELS/obj", ".obj")], "mtl": [("tests/models", ".mtl"), ("MODELS/obj", ".mtl")],
    "ply": [("tests/models", ".ply"), ("MODELS/ply", ".ply")], "stl": [("tests/models", ".stl"), ("MODELS/stl", ".stl")],
    "gltf": [("MODELS/gltf-tests", ".gltf"), ("MODELS/gltf", ".gltf")],
    "glb": [("MODELS/glb", ".glb"), ("MODELS/gltf-tests", ".glb")],
    "scene": [("tests/models", ".json"), ("tools/help", ".json"), ("examples", ".json")],
    "settings": [], "hash": [], "journal": [], "request": [], "shader": [("classroom/tests/check", ".frag")],
}
# These inputs begin with 24 bytes of options. Every model and scene file is also an input, after zeros.
WITH_OPTIONS = ("render", "library", "file")
SEED_BYTES = 16384

# The words of a format are the string literals of the files that read it, by default the files in its folder in src/formats/import; other dictionaries are in
# dictionaries/.
WORDS = {
    "obj": ["src/formats/import/obj"], "mtl": ["src/formats/import/obj/mtl.c", "src/formats/import/obj/mtl_maps.c"], "gltf": ["src/formats/import/gltf"], "glb": ["src/formats/import/gltf"],
    "3mf": ["src/formats/import/threemf"],
    "scene": ["src/core/description", "src/core/scene"],
    "render": ["src/formats/import/obj", "src/formats/import/ply", "src/formats/import/gltf"], "job": ["tools/batch/jobs", "program/options", "src/core/description"], "formula": ["src/formats/shapes/formula_parse.c"],
    "library": ["src/formats/import/obj", "src/formats/import/ply", "src/formats/import/gltf"], "file": ["src/formats/import"],
    "settings": ["tools/options", "program/options", "src/core/scene/fields", "src/core/description"], "hash": ["tools/commands/hash/hash_file.c"], "journal": ["tools/batch/journal", "tools/batch/model"],
    "request": ["tools/view", "program/options"], "shader": ["classroom/check/text", "classroom/check/contract"],
}
NUMBERS = ("obj", "mtl", "ply", "stl", "gltf", "glb", "3mf", "scene", "render", "library", "file", "job", "formula", "settings", "shader")

# The sources of each reader, for `coverage`: a target's own folder in src/formats/import by default.
READERS = {
    "obj": ["src/formats/import/obj"], "mtl": ["src/formats/import/obj/mtl.c", "src/formats/import/obj/mtl_maps.c"], "gltf": ["src/formats/import/gltf"], "glb": ["src/formats/import/gltf"],
    "3mf": ["src/formats/import/threemf"], "scene": ["src/core/description", "src/formats/json"], "png": ["src/formats/image/png/png_read.c"],
    "file": ["src/formats/load", "src/formats/import", "src/system/files/file.c"], "formula": ["src/formats/shapes"], "job": ["tools/batch/jobs"],
    "settings": ["tools/options/settings_file.c"], "hash": ["tools/commands/hash/hash_file.c"], "journal": ["tools/batch/journal/journal.c", "tools/batch/journal/journal_sum.c"],
    "request": ["tools/view/view_routes.c", "tools/view/view_answer.c", "tools/view/view_events.c", "tools/view/drawing/view_words.c", "tools/view/drawing/view_files.c"],
    "shader": ["classroom/check/text", "classroom/check/contract"],
    "library": ["src/formats/export", "src/gpu/glsl", "src/core/device"], "render": ["src/core/frame", "src/core/cpu"], "picture": ["src/core/frame", "src/core/cpu"],
}

# A slow input also counts as a find: SECONDS on a busy machine, with sanitizers, for an input of at most
# 16 KB.
LIMITS = ["-timeout=10", "-rss_limit_mb=1200", "-malloc_limit_mb=600", "-max_len=%d" % SEED_BYTES, "-report_slow_units=5"]
ENVIRONMENT = {
    "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1:intercept_tls_get_addr=0:max_allocation_size_mb=2000"
                    ":quarantine_size_mb=16",  # the size of the largest inputs; more would only be new pages to clear
    "LSAN_OPTIONS": "suppressions=%s:print_suppressions=0" % os.path.join(ROOT, "tests", "leaks.supp"),
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
}


SANITIZED = ["-Doptimization=1", "-Ddebug=true", "-Db_sanitize=address,undefined", "-Db_lundef=false", "-Dc_args=-fsanitize=fuzzer-no-link"]
COVERED = ["-Doptimization=0", "-Dc_args=-fprofile-instr-generate -fcoverage-mapping -fsanitize=fuzzer-no-link", "-Dc_link_args=-fprofile-instr-generate",
           "-Db_lundef=false"]


def build(out, options, jobs, wanted):
    """Builds the wanted targets, all by default, in the folder `out`; returns their names."""
    if not os.path.exists(os.path.join(out, "build.ninja")):
        subprocess.run(["meson", "setup", out, ROOT, "-Dfuzz=true", "-Dtests=false"] + options, check=True,
                       env={**os.environ, "CC": "clang"}, stdout=subprocess.DEVNULL)
    listed = subprocess.run(["ninja", "-C", out, "-t", "targets", "all"], check=True, capture_output=True, text=True).stdout
    names = re.findall(r"^tests/fuzz/fuzz-([a-z0-9]+): ", listed, re.M)
    draco = ["lambent-draco.so"] if "\nlambent-draco.so: " in listed else []
    unknown = sorted(set(wanted) - set(names))
    if unknown:
        sys.exit("fuzz.py: there is no target %s; there are %s" % (", ".join(unknown), " ".join(names)))
    names = wanted or names
    subprocess.run(["ninja", "-C", out, "-j", str(jobs)] + ["tests/fuzz/fuzz-" + name for name in names] + draco, check=True,
                   stdout=subprocess.DEVNULL)
    # The module is searched next to the program and in the parent folder.
    link = os.path.join(out, "tests", "lambent-draco.so")
    if draco and not os.path.lexists(link):
        os.symlink("../lambent-draco.so", link)
    return names


def dictionary(target):
    """Writes the target's dictionary; returns its path."""
    lines = []
    for place in WORDS.get(target, [os.path.join("src/formats/import", target)]):
        path = os.path.join(ROOT, place)
        sources = [path] if os.path.isfile(path) else sorted(glob.glob(os.path.join(path, "**", "*.c"), recursive=True))
        for source in sources:
            for line in open(source):
                if not line.startswith(("#", "//")):
                    lines += re.findall(r'"[A-Za-z0-9_ .:/#?=-]{1,40}"', line)
    for name in [target] + ["numbers"] * (target in NUMBERS):
        path = os.path.join(HERE, "dictionaries", name + ".dict")
        if os.path.exists(path):
            lines += [line.rstrip("\n") for line in open(path) if line.startswith('"')]
    path = os.path.join(OUT, "dictionaries", target + ".dict")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write("\n".join(dict.fromkeys(lines)) + "\n")
    return path


def seeds(target):
    """Copies a target's initial inputs into one folder and returns it."""
    folder = os.path.join(OUT, "seeds", target)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    places = [(os.path.join("tests/fuzz/corpus", target), "")] + SEEDS.get(target, [("tests/models", "." + target), (os.path.join("tests/pictures", target), "")])
    if target in WITH_OPTIONS:
        places += [(os.path.join("tests/fuzz/corpus", name), "") for name in ("obj", "ply", "stl", "gltf", "glb", "scene")]
    count = 0
    for place, ending in places:
        top = os.path.join(MODELS, place[len("MODELS/"):]) if place.startswith("MODELS/") else os.path.join(ROOT, place)
        for parent, folders, names in os.walk(top):
            folders.sort()
            for name in sorted(names):
                path = os.path.join(parent, name)
                if name.endswith(ending) and os.path.getsize(path) <= SEED_BYTES:
                    data = open(path, "rb").read()
                    if target in WITH_OPTIONS and not place.endswith(target):
                        data = bytes(24) + data
                    with open(os.path.join(folder, "%04d-%s" % (count, name)), "wb") as file:
                        file.write(data)
                    count += 1
    return folder


def fuzz(target, seconds, runs):
    """Runs one target. Returns the executions, the first and last coverage, the last features, and the names of finds."""
    corpus, finds = os.path.join(OUT, "corpus", target), os.path.join(OUT, "finds")
    os.makedirs(corpus, exist_ok=True)
    os.makedirs(finds, exist_ok=True)
    before = set(os.listdir(finds))
    log = os.path.join(OUT, target + ".log")
    command = [os.path.join(OUT, "tests", "fuzz", "fuzz-" + target), corpus, seeds(target), "-dict=" + dictionary(target),
               "-artifact_prefix=%s/%s-" % (finds, target), "-max_total_time=%d" % seconds, "-print_final_stats=1"] + LIMITS
    with open(log, "w") as file:
        code = subprocess.run(command + (["-runs=%d" % runs] if runs else []), stdout=file, stderr=file,
                              env={**os.environ, **ENVIRONMENT}).returncode
    text = open(log, errors="replace").read()
    coverage = [int(number) for number in re.findall(r"^#\d+\t(?:INITED|NEW|REDUCE|pulse|RELOAD|DONE) +cov: (\d+)", text, re.M)]
    features = re.findall(r" ft: (\d+)", text)
    executions = re.findall(r"stat::number_of_executed_units: (\d+)", text) or re.findall(r"^#(\d+)\t", text, re.M)
    new = sorted(set(os.listdir(finds)) - before)
    if code and not new:
        new = ["no input, see %s" % log]
    return (int(executions[-1]) if executions else 0, coverage[0] if coverage else 0, coverage[-1] if coverage else 0,
            int(features[-1]) if features else 0, new)


def coverage(target):
    """Runs the inputs of a target once. Returns the number of inputs, and the lines of its reader: all, and the reached ones."""
    out = os.path.join(OUT, "coverage")
    program, profile = os.path.join(out, "tests", "fuzz", "fuzz-" + target), os.path.join(out, target)
    corpus = os.path.join(OUT, "corpus", target)
    folders = [seeds(target)] + [corpus] * os.path.isdir(corpus)
    run = subprocess.run([program, "-runs=0"] + LIMITS + folders, env={**os.environ, "LLVM_PROFILE_FILE": profile + ".profraw"}, capture_output=True,
                         text=True, errors="replace")
    if run.returncode:
        sys.exit("fuzz.py: %s ends with %d:\n%s" % (target, run.returncode, run.stderr[-2000:]))
    subprocess.run(["llvm-profdata", "merge", "-o", profile + ".profdata", profile + ".profraw"], check=True)
    listed = subprocess.run(["llvm-cov", "export", "-summary-only", "-instr-profile", profile + ".profdata", program], check=True, capture_output=True, text=True)
    lines = reached = 0
    for file in json.loads(listed.stdout)["data"][0]["files"]:
        name = os.path.relpath(os.path.realpath(os.path.join(out, file["filename"])), ROOT)
        if any(name == place or name.startswith(place + "/") for place in READERS.get(target, ["src/formats/import/" + target, "src/formats/image/formats/%s.c" % target])):
            lines += file["summary"]["lines"]["count"]
            reached += file["summary"]["lines"]["covered"]
    return sum(len(os.listdir(folder)) for folder in folders), lines, reached


def main():
    seconds, runs, jobs, covers, wanted = 60, 0, os.cpu_count(), False, []
    for word in " ".join(sys.argv[1:]).split():
        key, equals, value = word.partition("=")
        if equals and key == "time":
            seconds = int(value)
        elif equals and key == "runs":
            runs = int(value)
        elif equals and key == "jobs":
            jobs = int(value)
        elif word == "coverage":
            covers = True
        elif equals:
            sys.exit("fuzz.py: %s is not known; expected time=SECONDS, runs=N, jobs=N, or names of targets" % word)
        else:
            wanted.append(word)
    if covers:
        print("%-8s %8s %8s %8s" % ("target", "inputs", "lines", "reached"), flush=True)
        for name in build(os.path.join(OUT, "coverage"), COVERED, jobs, wanted):
            inputs, lines, reached = coverage(name)
            print("%-8s %8d %8d %7.1f %%" % (name, inputs, lines, 100 * reached / max(1, lines)), flush=True)
        return 0
    failed = False
    print("%-8s %12s %10s %10s %10s" % ("target", "executions", "edges 0", "edges", "features"), flush=True)
    for name in build(OUT, SANITIZED, jobs, wanted):
        executions, first, last, features, finds = fuzz(name, seconds, runs)
        print("%-8s %12d %10d %10d %10d  %s" % (name, executions, first, last, features, " ".join(finds)), flush=True)
        failed |= bool([find for find in finds if "-slow-unit-" not in find])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
