#!/usr/bin/env python3
"""browser.py PROGRAM [--long|--firefox]: tests the page of `make web` in Debian's chromium, or firefox-esr, driven by playwright-core
(web/browser.mjs): gestures and the resulting command lines, controls, links, drops, explanations, the single-file page, the page without its server,
names and roles, and texts. After random sequences of gestures, 3 or with --long 30, PROGRAM draws the copied command, and the pixels must equal the
canvas. Shaders are checked with the browser's WebGL 2 (web/shaders.mjs): correct shaders pass, and known mistakes get their names; --long checks all
of them. For `lambent view` (web/view.mjs), a model is turned and its file changes; --long adds a gallery, and a model that is too large for the page.
web/people.mjs tests typical situations: the bytes before the first picture, slow drawings, missing and compressed files, small screens.

With --firefox these tests run in Firefox, through WebDriver BiDi (web/input.mjs contains the few differences). The tests are skipped if the browser, a
package of the group `web`, or playwright-core is missing; npm installs playwright-core in build-web/npm, as specified in web/package-lock.json."""
import hashlib
import json
import os
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-web")
sys.path[:0] = [os.path.join(ROOT, "web"), os.path.join(ROOT, "tests"), os.path.join(ROOT, "classroom", "tests", "check")]
import build  # noqa: E402
from mistakes import MISTAKES  # noqa: E402
from web import Results, make_models  # noqa: E402


def colors_of(path):
    """The RGB bytes of a PPM file."""
    data = open(path, "rb").read()
    header = re.match(rb"P6\s+#[^\n]*\n\d+ \d+\s+255\n", data)
    return data[header.end():]


def check_picture(results, program, folder, kind, said):
    """Draws a command line that the page copied; it begins with "lambent"."""
    path = os.path.join(folder, "drawn.ppm" if kind == "pixels" else "drawn.png")
    command = "%s -q %s -o %s" % (shlex.quote(program), said["command"].split(" ", 1)[1], path)
    done = subprocess.run(["sh", "-c", command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        results.ok(False, "drawn: " + said["command"], done.stderr)
        return
    data = colors_of(path) if kind == "pixels" else open(path, "rb").read()
    results.ok(hashlib.sha256(data).hexdigest() == said["hash"], "%s: %s" % (said.get("label", "the same " + kind), said["command"]))
    os.remove(path)


# Mistakes for which the browser's pictures give another result than native OpenGL: the name is uncertain, and a browser hides colours
# that are not numbers.
IN_BROWSER = {("learnopengl-pbr", "no-masking"): "no-masking?", ("learnopengl-pbr", "no-clamp"): ""}
# The cases without --long: correct programs, one for each kind of names, and mistakes of a highlight, of a gate and of a vertex
# shader.
SOME_CORRECT = ["pittsburgh", "oregon", "nyu", "learnopengl-lights", "mdn", "threejs-pbr"]
SOME_MISTAKES = [("pittsburgh", "phong-lobe"), ("oregon", "no-gate"), ("pittsburgh", "normal-by-model-view")]


def shader_tasks(long):
    """Checks of classroom/tests/check for the browser: correct programs and known mistakes (with `long` all), one that does not compile."""
    def text(name, ending):
        path = os.path.join(ROOT, "classroom", "tests", "check", "%s.%s" % (name, ending))
        return open(path).read() if os.path.exists(path) else ""

    tasks = []
    for name in build.correct_programs():
        if long or name in SOME_CORRECT:
            tasks.append({"name": name, "vertex": text(name, "vert"), "fragment": text(name, "frag"), "contract": "", "verdict": "passes", "mistakes": ""})
    for name, ids, edits in MISTAKES:
        if long or (name, ids) in SOME_MISTAKES:
            task = {"name": name, "vertex": text(name, "vert"), "fragment": text(name, "frag"), "contract": "", "verdict": "differs",
                    "mistakes": IN_BROWSER.get((name, ids), " ".join(sorted(ids.split())))}
            for ending, old, new in edits:
                key = {"frag": "fragment", "vert": "vertex"}[ending]
                task[key] = task[key].replace(old, new)
            tasks.append(task)
    line = text("angel", "frag").count("\n", 0, text("angel", "frag").index("normalize(")) + 1
    tasks.append({"name": "angel with an error", "vertex": text("angel", "vert"), "fragment": text("angel", "frag").replace("normalize(", "normalise(", 1),
                  "contract": "", "verdict": "refused", "mistakes": "", "line": line})
    return tasks


def check_shaders(results, modules, browser, folder, long):
    path = os.path.join(folder, "shaders.json")
    tasks = shader_tasks(long)
    json.dump(tasks, open(path, "w"))
    display, with_display = [], {}
    if "firefox" in browser: # it supports WebGL only with a display
        if not shutil.which("xvfb-run"):
            print("# no xvfb: shaders are not checked in Firefox")
            return
        display, with_display = ["xvfb-run", "-a"], {"LAMBENT_DISPLAY": "1"}
    done = subprocess.run([*display, "node", os.path.join(ROOT, "tests", "web", "shaders.mjs"), modules, browser, OUT, path, "all" if long else "some"], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, env={**os.environ, **with_display})
    for line in done.stdout.splitlines():
        if line.startswith("#"):
            print(line)
        else:
            results.ok(line.startswith("ok "), "shaders: " + line.split("ok ", 1)[1])
    results.ok(done.returncode == 0 and len(done.stdout.splitlines()) > len(tasks), "all shaders were checked", done.stderr)


def start_viewer(program, *words):
    """Starts a viewer with the built page and returns its address; None if libmicrohttpd is missing."""
    viewer = subprocess.Popen([program, "view", "--no-open", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              env={**os.environ, "LAMBENT_PAGE": os.path.join(OUT, "lambent.html")})
    address = viewer.stdout.readline().strip()
    if address:
        return viewer, address
    error = viewer.communicate()[1]
    if "libmicrohttpd" in error:
        return None, None
    raise RuntimeError("lambent view: " + error)


def make_points(path):
    """A model with more points than the page draws (tools/view): 100 visible layers of one square."""
    columns, layers = 145, 100
    square = [(x / columns, y / columns) for x in range(columns) for y in range(columns)][:21000]
    body = b"".join(struct.pack("<63000f", *(number for x, y in square for number in (x, y, z / layers))) for z in range(layers))
    header = "ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % (layers * len(square))
    open(path, "wb").write((header + "property float x\nproperty float y\nproperty float z\nend_header\n").encode() + body)


def check_view(results, program, modules, browser, folder, long):
    watched = os.path.join(folder, "watched")
    os.makedirs(watched)
    for name in ("part.obj", "cube.obj"):
        shutil.copy(os.path.join(ROOT, "tests", "models", "cube.obj"), os.path.join(watched, name))
    shutil.copy(os.path.join(ROOT, "tests", "models", "cube.mtl"), watched)
    open(os.path.join(watched, "other.obj"), "w").write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    viewers = [start_viewer(program, os.path.join(watched, "part.obj"), "--size", "96x96", "--background", "white")]
    if long:
        make_points(os.path.join(folder, "points.ply"))
        viewers.append(start_viewer(program, folder))
    if not viewers[0][0]:
        print("# no libmicrohttpd: lambent view is not tested")
        return
    try:
        done = subprocess.run(["node", os.path.join(ROOT, "tests", "web", "view.mjs"), modules, browser, viewers[0][1], watched, str(viewers[0][0].pid),
                               viewers[1][1] if long else ""], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    finally:
        for viewer, _ in viewers:
            viewer.kill()
            viewer.communicate()
    drawn = report(results, program, done.stdout, lambda said: folder if "points.ply" in said["command"] or "after it" in said["label"] else watched)
    results.ok(done.returncode == 0 and drawn == (6 if long else 3), "lambent view was tested", done.stderr)


def check_barriers(results, program, modules, browser, folder):
    """Runs axe-core on every tab of the page, and on the gallery of `lambent view` for the models of the folder."""
    viewer, gallery = start_viewer(program, folder)
    try:
        done = subprocess.run(["node", os.path.join(ROOT, "tests", "web", "axe.mjs"), modules, browser, OUT, gallery or ""], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
    finally:
        if viewer:
            viewer.kill()
            viewer.communicate()
    report(results, program, done.stdout, lambda said: folder)
    galleries = 4 if gallery else 0
    results.ok(done.returncode == 0 and done.stdout.count("ok axe: the tab") == 20 and done.stdout.count("ok axe: the gallery") == galleries,
               "axe-core has looked at every tab, and at the gallery", done.stderr)


def report(results, program, lines, folder_of):
    """Processes the output lines of a script: results, and pictures that the program must also draw. Returns the number of pictures with a label."""
    drawn = 0
    for line in lines.splitlines():
        kind, _, text = line.partition(" ")
        if kind in ("pixels", "file"):
            check_picture(results, program, folder_of(json.loads(text)), kind, json.loads(text))
            drawn += "label" in json.loads(text)
        elif kind == "#":
            print(line)
        else:
            results.ok(kind == "ok", text if kind == "ok" else text.partition(" ")[2])
    return drawn


def skip(why):
    print("ok 1 - browser # SKIP %s\n1..1" % why)
    return 0


def main():
    program, long, name = os.path.abspath(sys.argv[1]), "--long" in sys.argv, "firefox-esr" if "--firefox" in sys.argv else "chromium"
    browser = shutil.which(name)
    if not browser or build.missing():
        return skip("not installed: " + " ".join(build.missing() + ([] if browser else [name])))
    results = Results()
    done = subprocess.run([sys.executable, os.path.join(ROOT, "web", "build.py"), OUT], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        if "apt-get" in done.stdout:
            return skip("Debian's sources cannot be fetched")
        results.ok(False, "build-web is built", done.stdout)
    modules = build.packages(OUT)
    if not modules:
        return skip("npm cannot install playwright-core")
    sequences = 30 if long else 3
    with tempfile.TemporaryDirectory() as folder:
        check_shaders(results, modules, browser, folder, long)
        make_models(folder)
        check_view(results, program, modules, browser, folder, long)
        with open(os.path.join(OUT, "included.html"), "w") as out:
            model = open(os.path.join(folder, "cube.ply"), "rb").read()
            out.write(build.with_files(open(os.path.join(OUT, "lambent.html")).read(), {"/cube.ply": model}))
        filled = subprocess.run([program, "-q", "textured/quad.obj", "--size", "96", "--background", "white", "-o", os.path.join(OUT, "filled.html")], cwd=folder,
                                env={**os.environ, "LAMBENT_PAGE": os.path.join(OUT, "lambent.html")}, stderr=subprocess.PIPE, text=True)
        results.ok(filled.returncode == 0, "a page is written with a model in it", filled.stderr)
        done = subprocess.run(["node", os.path.join(ROOT, "tests", "web", "browser.mjs"), modules, browser, OUT, folder, str(sequences)],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        drawn = report(results, program, done.stdout, lambda said: folder)
        check_barriers(results, program, modules, browser, folder)
        people = subprocess.run(["node", os.path.join(ROOT, "tests", "web", "people.mjs"), modules, browser, OUT, folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)
        report(results, program, people.stdout, lambda said: folder)
        results.ok(people.returncode == 0 and "links ran" in people.stdout, "the page was met as people meet it", people.stderr)
        results.ok(done.returncode == 0 and drawn == sequences, "%d sequences of gestures were drawn" % sequences, done.stderr)
    print("1..%d" % results.count)
    return 1 if results.failed else 0


if __name__ == "__main__":
    sys.exit(main())
