#!/usr/bin/env python3
"""run.py [NAME …]: makes seven typical changes: a reflection model, a material field with its own reflection model, a picture setting, a picture
format, a model format, a value of --show, a field of a batch's journal. Each change is a patch in this folder, and is not part of the product.

Each patch is applied to a copy of the tree (build-test/change/tree), built and tested, tried with the program, and then removed. It may change at
most the number of files in CHANGES. If you change the architecture, update the patch; it then shows how many files such a change needs.
Generated pages (`make docs`) are not in the patches."""
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
OUT = os.path.join(ROOT, "build-test", "change")
TREE, PICTURES = os.path.join(OUT, "tree"), os.path.join(OUT, "pictures")
BUILD = os.path.join(TREE, "build") # as in a clone, so that a compiler cache finds its results
LAMBENT = os.path.join(BUILD, "lambent")
results = []


def check(name, ok, output=""):
    results.append(bool(ok))
    print("%s %d - %s" % ("ok" if ok else "not ok", len(results), name), flush=True)
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-40:]), flush=True)
    return ok


def run(*command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def lambent(*words):
    return run(LAMBENT, *map(str, words), cwd=PICTURES).stdout


def draw(name, *words):
    lambent(*words, "-s", 64, "-q", "-o", name)
    return name


def equal(a, b):
    return lambent("diff", a, b).splitlines()[-1:] == ["equal"]


def help_has(option, *words):
    return all(word in lambent("help", option) for word in words) and words[0] in lambent("generate", "markdown")


def reflection_model():
    sphere = ("sphere", "--light", "directional", "--material", "metallic=1,roughness=0.4,color=white", "--reflection")
    yield "help and documentation list it", help_has("reflection", "beckmann")
    yield "a scene file may name it", '"beckmann"' in lambent("generate", "scene-schema")
    yield "it differs from GGX", not equal(draw("a.png", *sphere, "ggx"), draw("b.png", *sphere, "beckmann"))
    yield "its shader is printed", "beckmann_lobe" in lambent("shader", *sphere, "beckmann")


def material_field():
    sphere = ("sphere", "--light", "directional", "--reflection")
    rim = (*sphere, "minnaert", "--material", "minnaert_rim=1")
    yield "help lists the model and the field", help_has("reflection", "minnaert") and help_has("materials", "minnaert_rim")
    yield "a scene file may have both", all('"%s"' % word in lambent("generate", "scene-schema") for word in ("minnaert", "minnaert_rim"))
    yield "its default is Lambert's surface", equal(draw("a.png", *sphere, "lambert"), draw("b.png", *sphere, "minnaert"))
    yield "another value is not", not equal("a.png", draw("c.png", *rim))
    lambent(*rim, "-s", 64, "-q", "-o", "d.png", "--save-scene", "d.json")
    yield "a saved scene draws the same", equal("c.png", draw("e.png", "d.json"))
    yield "its shader reads the field", "m.minnaert_rim" in lambent("shader", *rim)


def setting():
    dim = ("teapot", "--ambient", 0.5, "--ambient-scale", 0.5)
    yield "help and documentation list the option", help_has("ambient-scale", "--ambient-scale", "Multiply the ambient light.", "[1]")
    yield "completion knows it", "--ambient-scale" in lambent("complete", "--", "teapot", "--ambient-s")
    yield "it changes the picture", not equal(draw("a.png", *dim), draw("b.png", "teapot", "--ambient", 0.5))
    lambent(*dim, "-s", 64, "-q", "-o", "c.png", "--save-scene", "c.json")
    yield "a saved scene has the key and draws the same", '"ambient_scale": 0.5' in open(os.path.join(PICTURES, "c.json")).read() and \
        equal("a.png", draw("d.png", "c.json"))
    yield "its range is checked", "expected a number from 0.001 to 10" in lambent("teapot", "--ambient-scale", 11, "-o", "e.png")
    open(os.path.join(PICTURES, "f.json"), "w").write('{"lambent": 1, "objects": [{"shape": "teapot"}], "ambient_scale": 11}')
    yield "in scene files too", "ambient_scale" in lambent("f.json", "-o", "e.png")


def picture_format():
    yield "the list of formats has it", re.search(r"(?m)^  qoi +\.qoi  8 bits", lambent("formats"))
    yield "help and documentation list it", help_has("output", ".qoi")
    yield "it is written and read", equal(draw("a.png", "teapot"), draw("a.qoi", "teapot"))
    yield "sheets and figures are written", lambent("compare", "teapot", "--across", "shading", "-s", 32, "-q", "-o", "s.qoi") == ""
    yield "their errors list it", ".webp or .qoi" in lambent("explain", "teapot", "32,32", "-o", "x.exr")
    yield "an error suggests it", "use .qoi" in lambent("teapot", "-o", "a.qoii")


def model_format():
    pyramid = os.path.join(TREE, "tests", "fuzz", "corpus", "off", "pyramid.off")
    yield "the list of formats has it", re.search(r"(?m)^  off +\.off$", lambent("formats"))
    yield "it is read", json.loads(lambent("info", "--json", pyramid))["counts"]["triangles"] == 6
    yield "it is drawn", lambent(pyramid, "-s", 64, "-o", "a.png").startswith("a.png") and os.path.exists(os.path.join(PICTURES, "a.png"))
    open(os.path.join(PICTURES, "bad.off"), "w").write("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")
    yield "an error names the line", "bad.off:6: found '3', expected a vertex" in lambent("bad.off", "-o", "b.png").replace('"', "'")
    yield "errors list it", ".off" in lambent("nothing.xyz3", "-o", "c.png") or ".off" in lambent(__file__, "-o", "c.png")


def show_value():
    yield "help and documentation list it", help_has("show", "views", "directions to the eye")
    yield "completion knows it", "views" in lambent("complete", "--", "teapot", "--show", "vi")
    yield "a scene file and a sheet may name it", lambent("compare", "teapot", "--across", "show=views,normals", "-s", 32, "-q", "-o", "s.png") == ""
    yield "it differs from the normals", not equal(draw("a.png", "teapot", "--show", "views"), draw("b.png", "teapot", "--show", "normals"))
    yield "every instruction set draws it", equal(draw("c.pfm", "teapot", "--show", "views", "--isa", "scalar"), draw("d.pfm", "teapot", "--show", "views"))


def journal_field():
    os.makedirs(os.path.join(PICTURES, "models"), exist_ok=True)
    lambent("shape", "cube", "-o", "models/cube.obj")
    shutil.rmtree(os.path.join(PICTURES, "drawn"), ignore_errors=True)
    lambent("batch", "models", "-o", "drawn/", "-s", 16)
    lines = [json.loads(line) for line in open(os.path.join(PICTURES, "drawn", "lambent.jsonl"))]
    yield "the journal has it", [line["up"] for line in lines if "up" in line] == ["y"]


# The patch, the maximum number of files, and the test programs that must pass with it.
CHANGES = {
    "reflection_model": (3, reflection_model, ["lighting-equations", "lighting-widths", "lighting-words", "glsl"]),
    "material_field": (4, material_field, ["lighting-equations", "lighting-widths", "lighting-words", "materials", "scene-file"]),
    "setting": (3, setting, ["device", "scene-file"]),
    "picture_format": (4, picture_format, ["image", "encoders", "fuzz-qoi"]),
    "show_value": (4, show_value, ["glsl", "device"]),
    "journal_field": (1, journal_field, []),
    "model_format": (4, model_format, ["import", "fuzz-off"]),
}


def copy_tree():
    """The current tree without ignored files. Unchanged files keep their modification time, so that only little is rebuilt."""
    names = run("git", "ls-files", "-co", "--exclude-standard", cwd=ROOT).stdout.split("\n")
    wanted = {name for name in names if name and os.path.isfile(os.path.join(ROOT, name))}
    for folder, folders, files in os.walk(TREE):
        folders[:] = [name for name in folders if folder != TREE or name != "build"]
        for name in files:
            path = os.path.join(folder, name)
            if os.path.relpath(path, TREE) not in wanted:
                os.remove(path)
    for name in wanted:
        source, target = os.path.join(ROOT, name), os.path.join(TREE, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if not os.path.exists(target) or open(source, "rb").read() != open(target, "rb").read():
            shutil.copy(source, target)


def patch(name, *how):
    # Without a repository in a parent folder, git interprets the paths of a patch relative to the
    # current folder.
    return run("git", "apply", *how, os.path.join(HERE, name + ".patch"), cwd=TREE, env={**os.environ, "GIT_CEILING_DIRECTORIES": OUT})


def main():
    os.makedirs(PICTURES, exist_ok=True)
    copy_tree()
    if not os.path.exists(os.path.join(BUILD, "build.ninja")):
        done = run("meson", "setup", BUILD, TREE, "--buildtype=release", "-Dtests=true")
        if done.returncode:
            sys.exit(done.stdout)
    done = [patch(name) for name in CHANGES] + [patch(name, "-R") for name in reversed(CHANGES)]
    check("the patches can be applied together", all(one.returncode == 0 for one in done), "".join(one.stdout for one in done))
    for name in sys.argv[1:] or CHANGES:
        most, tries, tests = CHANGES[name]
        text = open(os.path.join(HERE, name + ".patch")).read()
        files = re.findall(r"(?m)^diff --git a/(\S+)", text)
        check("%s: %d files, at most %d" % (name, len(files), most), len(files) <= most, "\n".join(files))
        done = patch(name)
        if not check("%s: the patch applies" % name, done.returncode == 0, done.stdout):
            continue
        done = run("ninja", "-C", BUILD, "lambent", *("tests/test-" + test for test in tests))
        if check("%s: it builds without a warning" % name, done.returncode == 0 and "warning:" not in done.stdout, done.stdout):
            for test in tests:
                done = run(os.path.join(BUILD, "tests", "test-" + test), cwd=PICTURES)
                check("%s: test-%s" % (name, test), done.returncode == 0, done.stdout)
            for what, ok in tries():
                check("%s: %s" % (name, what), ok)
        done = patch(name, "-R")
        if done.returncode:
            sys.exit(done.stdout)
    sys.exit(0 if all(results) else 1)


main()
