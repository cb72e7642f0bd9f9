#!/usr/bin/env python3
"""web.py PROGRAM RECORD_PAINTER: tests Lambent as WebAssembly in node. The image table has the recorded hashes, with and without SIMD. For the same
arguments, the module of the page writes the same files, error messages and explanations as PROGRAM; its size is within the limits. The module of
checks sends its painter the requests that RECORD_PAINTER recorded with OpenGL, and gives the same reports for the same pictures.

It builds build-web/ like `make web`: the first time in a minute or two, then only the changes. The test is skipped if a package of the group `web`
(packages.txt) is missing, or if Debian's sources of the libraries cannot be downloaded."""
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-web")
sys.path.insert(0, os.path.join(ROOT, "web"))
import build  # noqa: E402
import module_parts  # noqa: E402
import sizes  # noqa: E402

PARTS = 2 # node processes at the same time
# The folders of modules, and the numbers of threads for each part of the image table; 0 means a
# module without threads.
TABLE = {"wasm": ["0", "0"], "threads": ["2", "4"]}

# The files that a page loads first, and its module, without and with threads, in bytes after brotli compression (the
# table is in docs/web.md).
FIRST_LOAD_MAX, MODULE_MAX = 300_000, 592_000

# Pictures: arguments, and the extension of the file. make_models creates the folder of the models.
PICTURES = [
    (["teapot", "--size", "128"], "png"),
    (["teapot", "--size", "128x96"], "jpg"),
    (["cube.obj", "--size", "96", "--samples", "1"], "png"),
    (["cube.obj", "--size", "96", "--camera", "eye=3/2.5/4.25,target=0/0/0"], "png"),
    (["cube.obj", "--size", "96", "--rotate", "y:30", "--light", "position=1/2/3"], "png"),
    (["cube.obj", "--size", "96"], "png"),  # after lights and turns: the scene has not changed
    (["cube.obj", "--size", "96", "--wireframe", "--edges", "all"], "png"),
    (["cube.ply", "--size", "96", "--shading", "flat"], "ppm"),
    (["cube.stl", "--size", "96", "--shadows"], "pfm"),
    (["scene.json"], "png"),
    (["textured/quad.obj", "--size", "96"], "png"),
    (["textured/damaged.obj", "--size", "96"], "png"),  # its JPEG ends early, which tests the setjmp of libjpeg's errors
    (["torus-knot", "--size", "96", "--material", "brass", "--ao", "screen"], "png"),
    (["sphere", "--size", "96", "--environment", "studio", "--material", "metallic=1,roughness=0.3,color=white"], "png"),
    (["sphere", "--size", "96"], "png"),  # after an environment
    (["sphere", "--size", "96", "--look", "technical"], "png"),
    (["deflated.3mf", "--size", "96"], "png"),
    (["bambu.3mf", "--size", "96"], "png"),
]
# Error messages: the same as the program's, except for the program's name.
REFUSED = [["missing.obj"], ["teapot", "--sice", "4"], ["teapot", "--view", "frint"], ["broken.obj"], ["teapot", "--size", "0"],
           ["teapot", "--camera", "eye=1/2/3", "--view", "top"]]
# Curves of a light of the picture, and the equivalent `lambent plot`: kind, curve, index of the curve, farthest.
LAMP = "spot:position=1/2/3,attenuation=0.5/0.25/0.125,range=6,inner=10,outer=25"
CURVES = [(["sphere", "--light", LAMP], {"light": 0, "farthest": 8, "shininess": 20, "reflection": "phong"},
           [("attenuation", "attenuation", "0.5/0.25/0.125/6", 0, 8), ("spot", "spot", "inner=10,outer=25", 0, 90), ("highlight", "highlight", "20", 0, 90)]),
          (["teapot", "--light", "point:position=1/2/3", "--light", "spot:position=0/0/3,cutoff=30,exponent=8"],
           {"light": 1, "farthest": 4, "shininess": 50, "reflection": "blinn-phong"},
           [("attenuation", "attenuation", "1/0/0", 0, 4), ("spot", "spot", "cutoff=30,exponent=8", 0, 90), ("highlight", "highlight", "50", 1, 90)])]
EXPLAINED = [["cube.obj", "--size", "96"], ["torus-knot", "--size", "96", "--reflection", "phong"]]

# Checks: a program of classroom/tests/check, a contract ("" means recognised), whether its vertex shader is given, and an edit of the fragment
# shader.
CHECKS = [("angel", "", True, None), ("oregon-no-gate", "", True, None), ("nyu-direction", "nyu", False, None), ("pittsburgh-vertex", "", True, None),
          ("pittsburgh", "pittsburgh", True, ("max(dot(n, h), 0.0)", "max(dot(reflect(-l, n), v), 0.0)")), ("threejs-pbr", "", True, None),
          ("gltf", "", True, None), ("gltf-maps", "", True, None), ("oregon", "", True, ("void main", "void mian")), ("learnopengl", "", True, ("normalize(Normal)", "Normal"))]


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
    for kind, threads in TABLE.items():
        module = os.path.join(OUT, kind, "web", "image-hashes.wasm")
        with concurrent.futures.ThreadPoolExecutor(PARTS) as pool:
            runs = list(pool.map(lambda part: node("run.mjs", threads[part], module, str(part), str(PARTS), threads[part] or "1"), range(PARTS)))
        drawn = {}
        for done in runs:
            results.ok(done.returncode == 0, "%s: a part of the image table is drawn" % kind, done.stderr)
            for line in done.stdout.splitlines():
                isa, name, *hashes = line.split()
                drawn[isa, name] = hashes
        for isa in ("scalar", "wasm"):
            for name, hashes in expected.items():
                results.ok(drawn.get((isa, name)) == hashes, "%s, %s: %s" % (kind, isa, name),
                           "drew %s, recorded is %s" % (drawn.get((isa, name)), hashes))


def check_threads(results):
    with tempfile.TemporaryDirectory() as folder:
        make_models(folder)
        done = node("threads.mjs", *[os.path.join(OUT, kind, "web", "lambent.wasm") for kind in TABLE],
                    *[os.path.join(OUT, "page", name) for name in module_parts.THREADS_PARTS], folder)
        for line in done.stdout.splitlines():
            if line.startswith("#"):
                print(line)
            else:
                results.ok(line.startswith("ok "), line.split("ok ", 1)[1])
        results.ok(done.returncode == 0 and done.stdout.count("ok threads:") == 23, "threads: all of the checks ran", done.stderr)


def make_models(folder):
    """Models that refer to other files, as a page gets them: from the tests, one with pictures, one with a damaged picture."""
    for name in os.listdir(os.path.join(ROOT, "tests", "models")):
        shutil.copy(os.path.join(ROOT, "tests", "models", name), folder)
    textured = os.path.join(folder, "textured")
    os.makedirs(textured)
    photo = open(os.path.join(ROOT, "tests/pictures/jpeg/color420-progressive.jpg"), "rb").read()
    shutil.copy(os.path.join(ROOT, "tests/pictures/png/palette8-interlaced.png"), os.path.join(textured, "side.png"))
    for name, picture in (("quad", photo), ("damaged", photo[:len(photo) // 2])):
        open(os.path.join(textured, name + ".jpg"), "wb").write(picture)
        open(os.path.join(textured, name + ".mtl"), "w").write(
            "newmtl photo\nKd 1 1 1\nmap_Kd %s.jpg\nnewmtl side\nKd 1 1 1\nmap_Kd side.png\n" % name)
        open(os.path.join(textured, name + ".obj"), "w").write(
            "mtllib %s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
            "usemtl photo\nf 1/1 2/2 3/3 4/4\nusemtl side\nf 2/1 5/2 6/3 3/4\n" % name)
    for name in ("deflated.3mf", "bambu.3mf"):
        shutil.copy(os.path.join(ROOT, "tests/fuzz/corpus/3mf", name), folder)
    open(os.path.join(folder, "broken.obj"), "w").write("v 0 0 0\nf 1 2 x\n")


def shown(sentence):
    """An error message without its prefix and without the folder of the module's files."""
    return re.sub(r"^lambent: ", "", sentence.strip().splitlines()[0] if sentence.strip() else "")


def native(program, folder, words):
    return subprocess.run([program, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def check_module(results, program):
    module = os.path.join(OUT, "wasm", "web", "lambent.wasm")
    with tempfile.TemporaryDirectory() as folder:
        make_models(folder)
        tasks = [{"words": words, "ending": ending} for words, ending in PICTURES] + [{"words": words, "ending": "png"} for words in REFUSED]
        tasks += [{"explain": words, "at": [48, 48]} for words in EXPLAINED]
        tasks += [{"curves": words, "of": of} for words, of, _ in CURVES] + [{"options": True}]
        done = subprocess.run(["node", os.path.join(ROOT, "tests/web/pictures.mjs"), module, folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, input="".join(json.dumps(task) + "\n" for task in tasks))
        lines = done.stdout.splitlines()
        results.ok(len(lines) == len(tasks), "the module answers each line", done.stderr)
        lines += [""] * (len(tasks) - len(lines))
        for words, ending in PICTURES:
            path = os.path.join(folder, "out." + ending)
            run = native(program, folder, ["-q", *words, "-o", path])
            wanted = hashlib.sha256(open(path, "rb").read()).hexdigest() if run.returncode == 0 else shown(run.stderr)
            got = lines.pop(0)
            results.ok(got == wanted, "module: %s (%s)" % (" ".join(words), ending), "found %s, the program gives %s" % (got, wanted))
        for words in REFUSED:
            run = native(program, folder, words + ["-o", "out.png"])
            got = lines.pop(0)
            results.ok(run.returncode and got == shown(run.stderr), "module: refuses " + " ".join(words),
                       "found '%s', the program says '%s'" % (got, shown(run.stderr)))
        for words in EXPLAINED:
            run = native(program, folder, ["explain", words[0], "48,48", *words[1:], "--json"])
            got = json.loads(lines.pop(0))
            results.ok(got == json.loads(run.stdout), "module: explains " + " ".join(words), "found %s" % str(got)[:300])
        for words, _, plots in CURVES:
            curves = json.loads(lines.pop(0))
            for name, kind, curve, which, farthest in plots:
                run = native(program, folder, ["plot", kind, curve, "--to", str(farthest), "--json", "-o", os.path.join(folder, "plot.svg")])
                wanted = [y for _, y in json.loads(run.stdout)["curves"][which]["points"]] if run.returncode == 0 else run.stderr
                results.ok(curves.get(name) == wanted, "module: the curve of %s, %s" % (kind, curve), "found %s, plot has %s" % (str(curves)[:200], str(wanted)[:200]))
        options = {o["name"]: o for o in json.loads(lines.pop(0))["options"]}
        help_text = native(program, folder, ["--help"]).stdout + native(program, folder, ["shape", "--help"]).stdout
        listed = set(re.findall(r"^ +(?:-\w, )?--([\w-]+)", help_text, re.M))
        # Options that others have replaced still work, but help omits them.
        works = lambda name: "unknown option" not in native(program, folder, ["cube", "--%s=" % name, "--dry-run"]).stderr
        listed |= {name for name in set(options) - listed if works(name)}
        results.ok(len(options) > 60 and set(options) <= listed, "module: its options are those of the help",
                   str(sorted(set(options) - listed)))

def check_checks(results, recorder):
    module = os.path.join(OUT, "wasm", "classroom", "web", "check.wasm")
    with tempfile.TemporaryDirectory() as folder:
        files, asked = [], []
        for name, contract, has_vertex, edit in CHECKS:
            shaders = os.path.join(ROOT, "classroom", "tests", "check", name)
            vertex = open(shaders.replace("-no-gate", "") + ".vert").read() if has_vertex else ""
            fragment = open(shaders + ".frag").read()
            if edit:
                results.ok(fragment.count(edit[0]) == 1, "%s.frag has '%s'" % (name, edit[0]))
                fragment = fragment.replace(*edit)
            files.append(os.path.join(folder, "%d-%s" % (len(files), name)))
            asked.append({"fragment": fragment, "vertex": vertex, "contract": contract})
            done = subprocess.run([recorder, files[-1]], input="\0".join([fragment, vertex, contract, ""]), stderr=subprocess.PIPE, text=True)
            if done.returncode == 77:
                print("# no OpenGL: checks are not compared")
                return
            results.ok(done.returncode == 0, "recorded: " + name, done.stderr)
        done = subprocess.run(["node", os.path.join(ROOT, "classroom", "tests", "web", "check.mjs"), module, *files], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, input="".join(json.dumps(one) + "\n" for one in asked))
        lines = done.stdout.splitlines()
        for line in lines:
            if not line.startswith("#"):
                results.ok(line.startswith("ok "), "check: " + line.split("ok ", 1)[1], "\n".join(lines))
        results.ok(done.returncode == 0 and sum(line.startswith("ok ") for line in lines) == 2 * len(CHECKS) + 6, "check: all were replayed", done.stderr + done.stdout)


def check_sizes(results):
    """docs/web.md contains the sizes of the built files, to a tenth and 3 kB; the first load of a page is within the limits."""
    page = open(os.path.join(ROOT, "docs", "web.md")).read()
    rows = sizes.table(OUT)
    for title, *found in rows:
        said = re.search(r"^\| %s \| (\d+) \| (\d*) \| (\d*) \|$" % re.escape(title), page, re.M)
        for number, text in zip(found, said.groups() if said else [None] * 3):
            good = bool(said) and (not text if number is None else bool(text) and abs(int(text) * 1000 - number) <= number / 10 + 3000)
            results.ok(good, "docs/web.md has the size of: " + title, "found %s, the page says %s; web/sizes.py prints the table" % (number, text))
    for title, most in ((sizes.FIRST, FIRST_LOAD_MAX), (sizes.MODULE, MODULE_MAX), (sizes.THREADS, MODULE_MAX)):
        bytes_sent = next(row[3] for row in rows if row[0] == title)
        results.ok(bytes_sent <= most, "%s: %d bytes, of %d" % (title, bytes_sent, most))


def main():
    results = Results()
    program = os.path.abspath(sys.argv[1])
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
        check_threads(results)
        check_module(results, program)
        check_checks(results, os.path.abspath(sys.argv[2]))
        check_sizes(results)
        done = node("page.mjs", os.path.join(OUT, "lambent.html"))
        for line in done.stdout.splitlines():
            results.ok(line.startswith("ok "), "page: " + line.split(" ", 1 if line.startswith("ok ") else 2)[-1])
        results.ok(done.returncode == 0 and len(done.stdout.splitlines()) > 15, "page: all of its checks ran", done.stderr)
        done = node("pace.mjs")
        for line in done.stdout.splitlines():
            results.ok(line.startswith("ok "), "pace: " + line.partition("ok ")[2], line)
        results.ok(done.returncode == 0 and len(done.stdout.splitlines()) == 8, "pace: all of its checks ran", done.stderr)
    print("1..%d" % results.count)
    return 1 if results.failed else 0


if __name__ == "__main__":
    sys.exit(main())
