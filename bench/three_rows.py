"""three_rows.py: rows that compare a frame of textured glTF files with three.js in headless Chromium (software GPU SwiftShader): the same file,
camera, size and light, one sample each. npm installs three.js and playwright-core (bench/three/package-lock.json) in build-bench/npm; if they or
Chromium are missing, the rows report this."""
import functools
import json
import math
import os
import shutil
import statistics
import subprocess
import sys

import frames
import gltf_rows
import measure
import paths

sys.path.insert(0, os.path.join(paths.ROOT, "web"))
import build  # noqa: E402

SIZE = 1024
LIGHT = {"direction": (-0.5, -0.6, -0.62), "intensity": 1.5}
# The pictures differ because the equations of the two programs differ: multiple scattering, prefiltered environments, the order of
# blended surfaces.
MOST_DIFFERENT = 0.04


class Browser:
    """A context manager for three.mjs: sends tasks and returns answers. `folder` contains the files of the tasks."""

    name = "three.js"

    def __init__(self, folder):
        self.folder = folder

    def __enter__(self):
        chromium = shutil.which("chromium")
        if not chromium or not shutil.which("node"):
            raise measure.Absent("three.js: %s is not installed" % ("node" if chromium else "chromium"))
        modules = build.packages(paths.OUT, os.path.join(paths.BENCH, "three"))
        if not modules:
            raise measure.Absent("three.js: npm is missing or cannot install it")
        self.process = subprocess.Popen(["node", os.path.join(paths.BENCH, "three", "three.mjs"), modules, chromium, self.folder],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        try:
            self.process.wait(30)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def answer(self, **task):
        try:
            self.process.stdin.write(json.dumps(task) + "\n")
            self.process.stdin.flush()
            line = self.process.stdout.readline()
        except BrokenPipeError:
            line = ""
        told = json.loads(line) if line else {"error": "the browser has ended"}
        if isinstance(told, dict) and "error" in told:
            raise measure.Failed("%s: %s" % (self.name, told["error"]))
        return told


def tree_cpu_ms(root):
    """The processor time so far of a process and all its descendants."""
    parents, used = {}, {}
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open("/proc/%s/stat" % entry) as file:
                words = file.read().rpartition(")")[2].split()
        except OSError:  # it has ended in the meantime
            continue
        parents[int(entry)], used[int(entry)] = int(words[1]), int(words[11]) + int(words[12])

    def descends(pid):
        while pid in parents and pid != root:
            pid = parents[pid]
        return pid == root
    return sum(ticks for pid, ticks in used.items() if descends(pid)) * 1e3 / os.sysconf("SC_CLK_TCK")


def camera_of(report):
    """Lambent's fitted camera, with planes around the model."""
    camera, bounds = dict(report["camera"]), report["model"]["bounds"]
    far = max(math.dist(camera["eye"], [bounds[side][axis] for axis, side in enumerate(corner)])
              for corner in ((a, b, c) for a in bounds for b in bounds for c in bounds))
    return {**camera, "near": far / 1000, "far": far * 1.01}


def row(label, path, isas, gl_device, environment):
    path, name = path(), label.replace(" ", "-").replace(",", "").replace(".", "")
    environment = environment and environment()
    folder = os.path.commonpath([os.path.dirname(file) for file in (path, environment) if file])
    lit = (["--environment", environment] if environment else
           ["--light", "directional:direction=%g/%g/%g,intensity=%g" % (*LIGHT["direction"], LIGHT["intensity"])])
    options = ["-s", SIZE, "--samples", 1, "--ao", "off", *lit]
    ours, theirs = frames.picture(name + "-lambent"), frames.picture(name + "-three")
    report = measure.lambent(path, *options, "-o", ours)

    def ours_taken(*more):
        """The median frame of a process; the processor time covers the frames after the first."""
        command = [paths.LAMBENT, "-q", *map(str, options), *more, "-o", frames.picture(name, "ppm"), path]
        wall = measure.lambent("--repeat", count, *options, *more, "-o", frames.picture(name, "ppm"), path)["times_ms"]["frame"]
        first, all_of_them = (measure.process([*command, "--repeat", str(n)]).cpu_ms for n in (1, 1 + count))
        return measure.Taken(wall, (all_of_them - first) / count)
    with Browser(folder) as browser:
        task = {"load": os.path.relpath(path, folder), "size": [SIZE, SIZE], "camera": camera_of(report)}
        told = browser.answer(**task, **({"environment": os.path.relpath(environment, folder)} if environment else {"light": LIGHT}))
        browser.answer(save=theirs)
        difference = json.loads(measure.output([paths.LAMBENT, "diff", "--json", "--tolerance", "255", ours, theirs]))
        if difference["mean"] > MOST_DIFFERENT:
            raise measure.Failed("three.js draws a different picture (mean difference %.3f)" % difference["mean"])
        count = frames.REPEAT if browser.answer(frames=1)[0] < 200 else 3

        def theirs_taken():
            before = tree_cpu_ms(browser.process.pid)
            wall = statistics.median(browser.answer(frames=count))
            return measure.Taken(wall, (tree_cpu_ms(browser.process.pid) - before) / count)
        contestants = {isa: functools.partial(ours_taken, "--isa", isa) for isa in isas}
        contestants["three.js"] = theirs_taken
        taken = measure.in_turn(contestants, 6, most_rounds=7)
    wall = {key: [t.wall_ms for t in rounds] for key, rounds in taken.items()}
    cpu = {key: [t.cpu_ms for t in rounds] for key, rounds in taken.items()}
    beside = {"our OpenGL device": [], "with the card's filters": ["--texture-filter", "hardware"]} if gl_device else {}
    return {"ms": {key: measure.spread(t) for key, t in wall.items()}, "cpu_ms": {key: measure.spread(t) for key, t in cpu.items()},
            "cpu_ratio": {isa: measure.ratio(cpu["three.js"], cpu[isa]) for isa in isas}, "peer": told["version"],
            "peers_tried_ms": {key: ours_taken("--device", "gl", *more).wall_ms for key, more in beside.items()},
            "renderer": told["renderer"], "size": SIZE, "samples": 1, "triangles": report["model"]["triangles"],
            "difference": {key: difference[key] for key in ("mean", "maximum")},
            "ratio": {isa: measure.ratio(wall["three.js"], wall[isa]) for isa in isas}}


def rows(isas, gl_device):
    for name, path in gltf_rows.TEXTURED.items():
        yield "three.js " + name, 5, functools.partial(row, "three.js " + name, path, isas, gl_device, None)
    for name in gltf_rows.UNDER_ENVIRONMENT:
        label = "three.js %s, environment" % name
        yield label, 5, functools.partial(row, label, gltf_rows.TEXTURED[name], isas, gl_device, gltf_rows.environment)
