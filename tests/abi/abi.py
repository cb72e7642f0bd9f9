#!/usr/bin/env python3
"""abi.py BUILD PROGRAM [--record]: tests that programs and libraries of different versions work together (include/lambent/base.h, "Growth").

The layout of all public structs equals the recorded one (tests/abi/layout.txt), except for fields that replace reserved words. A program compiled
with headers without the newest fields, with today's headers, and with headers with one more field, gets the same picture, explanation and report from
today's library; every call rejects a field that the library does not know. In addition, lam_render draws the same picture as the program."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

import layout

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
BUILD, PROGRAM = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
HEADERS, RECORDED = os.path.join(ROOT, "include", "lambent"), os.path.join(HERE, "layout.txt")
# Values, and structs that a standard or a formula defines; these never change.
FIXED = {"lam_error", "lam_cancel", "lam_vec3", "lam_rgb", "lam_rgba", "lam_mat4", "lam_attenuation", "lam_bytes", "lam_surface_point"}
results = []


def check(name, ok, output=""):
    results.append(ok)
    print("%s %d - %s" % ("ok" if ok else "not ok", len(results), name))
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-40:]))
    return ok


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def build(source, include, program, *more):
    folders = [os.path.join(BUILD, name) for name in ("src", "classroom")]
    return run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-I", include, source, "-o", program, *more, *("-L" + folder for folder in folders),
                "-llambent-check", "-llambent", *("-Wl,-rpath," + folder for folder in folders)])


def layout_now(folder):
    source, program = os.path.join(folder, "layout.c"), os.path.join(folder, "layout")
    open(source, "w").write(layout.layout_program(layout.read(HEADERS)))
    built = run(["cc", "-I", os.path.dirname(HEADERS), source, "-o", program])
    if built.returncode:
        sys.exit("layout.c does not compile: " + built.stdout)
    return run([program]).stdout


def check_layout(now):
    recorded, found = layout.parse_layout(open(RECORDED).read()), layout.parse_layout(now)
    check("%d structs: every recorded field is in its place" % len(recorded[0]), not layout.differences(recorded, found),
          "\n".join(layout.differences(recorded, found)))
    new = sorted(set(found[0]) - set(recorded[0]))
    check("every struct is recorded", not new, "not in layout.txt (abi.py BUILD PROGRAM --record): " + " ".join(new))
    short = sorted(n for n, (_, fields) in found[0].items() if ("reserved" in fields) == (n in FIXED))
    check("every struct that may grow ends in LAM_RESERVED", not short, " ".join(short))
    # Tests that the comparison detects differences.
    for name, change in (("a field moved", {"width": (4, 4)}), ("a field gone", {"width": None})):
        size, fields = recorded[0]["lam_image"]
        moved = {**found[0], "lam_image": (size, {k: v for k, v in {**fields, **change}.items() if v})}
        check("%s would be noticed" % name, bool(layout.differences(recorded, (moved, found[1]))))


def older(now):
    """The last fields of every struct that begin at a whole word become reserved words."""
    sizes = layout.parse_layout(now)[0]
    gone = []

    def change(name, fields):
        if fields[-1].name != "reserved":
            return fields
        places = sizes[name][1]
        for at in range(len(fields) - 2, 0, -1):
            if places[fields[at].name][0] % 8 == 0:
                words = (places["reserved"][0] - places[fields[at].name][0]) // 8
                gone.extend("%s.%s" % (name, field.name) for field in fields[at:-1])
                return fields[:at] + [layout.Field("reserved", "LAM_RESERVED(%d)" % (words + fields[-1].reserved))]
        return fields
    return change, gone


def newer(name, fields):
    """Adds one field to every struct that allows it."""
    if fields[-1].name != "reserved":
        return fields
    return fields[:-1] + [layout.Field("newest", "uint64_t newest"),
                          layout.Field("reserved", "LAM_RESERVED(%d)" % (fields[-1].reserved - 1))]


# Structs with reserved words that a caller does not fill: a table of the library, the painter's own results, or a result.
GIVEN_BY_THE_LIBRARY = {"lam_setting", "lam_field", "lam_check_report"}


def inputs():
    """The structs that may grow and that a caller fills: structs behind a pointer to const in a function's parameter, and structs that such a struct
    points to."""
    text = "".join(re.sub(r"//[^\n]*", "", open(path).read()) for path in sorted(glob.glob(os.path.join(HEADERS, "*.h"))))
    bodies = {name: body for body, name in re.findall(r"typedef struct lam_\w+ \{(.*?)\n\} (lam_\w+);", text, re.S) if "LAM_RESERVED" in body}
    wanted = {name for call in re.findall(r"LAM_API[^;(]*(\([^;]*;)", text) for name in re.findall(r"const (?:struct )?(lam_\w+) \*", call)} & set(bodies)
    wanted -= GIVEN_BY_THE_LIBRARY
    while True:
        more = {name for outer in wanted for name in re.findall(r"(?m)^\s+const (lam_\w+) \*", bodies[outer])} & set(bodies)
        if more <= wanted | GIVEN_BY_THE_LIBRARY:
            return wanted
        wanted |= more - GIVEN_BY_THE_LIBRARY


def check_versions(now, folder):
    change, gone = older(now)
    layout.rewrite(HEADERS, os.path.join(folder, "older", "lambent"), change)
    layout.rewrite(HEADERS, os.path.join(folder, "newer", "lambent"), newer)
    outputs, source = {}, os.path.join(HERE, "versions.c")
    for version, include in (("today's", os.path.dirname(HEADERS)), ("older", os.path.join(folder, "older")),
                             ("newer", os.path.join(folder, "newer"))):
        program = os.path.join(folder, "with-" + version[:5] + "-headers")
        built = build(source, include, program, *(["-DNEWER"] if version == "newer" else []))
        if not check("a program compiled against %s headers" % version, built.returncode == 0, built.stdout):
            continue
        ran = run([program, os.path.join(ROOT, "tests", "models", "cube.obj")])
        outputs[version] = ran.stdout
        check("it runs with today's library", ran.returncode == 0, ran.stdout)
    check("older headers lack fields: %d of them, lam_image.stride among them" % len(gone), "lam_image.stride" in gone, " ".join(gone))
    check("the older program gets the same picture, explanation and report", outputs.get("older") == outputs.get("today's") != None,
          "older:\n%s\ntoday's:\n%s" % (outputs.get("older"), outputs.get("today's")))
    refused = outputs.get("newer", "").split("refused:\n")
    check("so does the newer one, its new fields being zero", refused[0] == outputs.get("today's"), outputs.get("newer", ""))
    check("a field that the library does not know is refused by every call", len(refused) == 2 and ": no" not in refused[1], outputs.get("newer", ""))
    tried = set(re.findall(r"(?m)^(lam_\w+)(?: of \w+)?: yes", refused[-1]))
    check("every struct that a caller fills is among them (%d)" % len(inputs()), len(inputs()) > 25 and inputs() == tried, " ".join(inputs() ^ tried))


def check_render(folder):
    program = os.path.join(folder, "render_one")
    built = build(os.path.join(HERE, "render_one.c"), os.path.dirname(HEADERS), program)
    if not check("render_one compiles", built.returncode == 0, built.stdout):
        return
    models = os.path.join(ROOT, "tests", "models")
    for name in ("cube.obj", "cube.mtl"):  # the files that a scene file names must be next to it
        shutil.copy(os.path.join(models, name), folder)
    scene = os.path.join(folder, "scene.json")
    open(scene, "w").write('{"lambent": 1, "image": {"size": [300, 200], "samples": 8, "background": "navy"}, "stage": "vertex", '
                           '"reflection": "phong", "objects": [{"shape": "torus-knot"}, {"file": "cube.obj"}]}')
    for model in (os.path.join(models, "cube.obj"), os.path.join(ROOT, "examples", "models", "spot.obj"), "teapot", scene):
        pictures = [os.path.join(folder, name) for name in ("program.png", "library.png")]
        drawn = run([PROGRAM, model, "-o", pictures[0], "-q"])
        again = run([program, model, pictures[1]])
        same = drawn.returncode == again.returncode == 0 and open(pictures[0], "rb").read() == open(pictures[1], "rb").read()
        check("lam_render draws %s as the program does" % os.path.basename(model), same, drawn.stdout + again.stdout)
    wrong = run([program, os.path.join(folder, "none.obj"), os.path.join(folder, "none.png")])
    check("lam_render refuses a missing file with LAM_CANNOT_READ", wrong.returncode == 2 and "none.obj" in wrong.stdout, wrong.stdout)


def main():
    with tempfile.TemporaryDirectory() as folder:
        now = layout_now(folder)
        if "--record" in sys.argv:
            head = "# Sizes and offsets of the public structs, and the constants, on 64-bit machines (abi.py --record).\n"
            open(RECORDED, "w").write(head + now)
            return 0
        check_layout(now)
        check_versions(now, folder)
        check_render(folder)
    print("1..%d" % len(results))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
