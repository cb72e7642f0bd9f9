"""turning_rows.py: measures how quickly the page follows a user who turns a model, with one thread for each processor, in headless Chromium: the
teapot at 928 × 656, and a ball of 100,000 triangles, alternating with three.js on the software GPU of the same browser. `python3 bench/run.py
turning` measures only these rows, in two minutes. They need the page (make web); if the page, three.js or Chromium is missing, they report this. The
page is first built again from the present sources, so that these rows never measure an older page.

`as shown`: each program with its own settings while the model turns. The page draws one sample for each pixel, and at least half of the width and
height (web/page/picture/pace.js);
three.js draws all pixels, with 4 samples (antialias). `equal`: both draw all pixels with 1 sample; the page then draws complete pictures, as after
any change."""
import functools
import json
import math
import os
import shutil
import statistics
import struct
import subprocess
import sys

import frames
import measure
import paths
import three_rows
import build

WIDTH, HEIGHT = 928, 656
TEAPOT = ["teapot", "--material=ambient=#12657a,diffuse=#1688a5,specular=0.7,shininess=80", "--light=point:position=0.3r/0.5r/1r", "--ambient=0.3"]
FRAMES_PER_S, SHARP_MS, TIMES = 30, 150, 3
PAGE = os.path.join(paths.ROOT, "build-web")
ROWS, COLUMNS = 200, 250  # two triangles per cell


def make_ball(path):
    """Writes a GLB file of a ball with waves: 100,000 triangles with normals."""
    points, normals = [], []
    for i in range(ROWS + 1):
        for j in range(COLUMNS + 1):
            down, around = math.pi * (0.02 + 0.96 * i / ROWS), 2 * math.pi * j / COLUMNS
            away = 1 + 0.05 * math.sin(8 * around) * math.sin(6 * down)
            unit = (math.sin(down) * math.cos(around), math.cos(down), math.sin(down) * math.sin(around))
            normals += unit
            points += [away * x for x in unit]
    corners = []
    for i in range(ROWS):
        for j in range(COLUMNS):
            a, b = i * (COLUMNS + 1) + j, (i + 1) * (COLUMNS + 1) + j
            corners += [a, a + 1, b, b, a + 1, b + 1]
    chunks = [struct.pack("<%df" % len(points), *points), struct.pack("<%df" % len(normals), *normals), struct.pack("<%dI" % len(corners), *corners)]
    offsets = [sum(map(len, chunks[:i])) for i in range(3)]
    extremes = {"min": [min(points[i::3]) for i in range(3)], "max": [max(points[i::3]) for i in range(3)]}
    count = len(points) // 3
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.2, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 0.5}}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", **extremes},
                          {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
                          {"bufferView": 2, "componentType": 5125, "count": len(corners), "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": len(chunk)} for offset, chunk in zip(offsets, chunks)],
            "buffers": [{"byteLength": sum(map(len, chunks))}]}
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(chunks)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)) + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body)


@functools.cache
def build_page():
    """Builds the changes of the page since the last `make web`."""
    if not os.path.exists(os.path.join(PAGE, "page", "page.js")):
        raise measure.Absent("the page is missing: make web")
    done = subprocess.run([sys.executable, build.__file__, PAGE], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise measure.Absent("the page cannot be built: " + (done.stdout.strip().splitlines() or ["make web"])[-1])


class Page(three_rows.Browser):
    """A context manager for lab.mjs: sends tasks and returns answers."""

    name = "the page"

    def __enter__(self):
        build_page()
        chromium, modules = shutil.which("chromium"), build.packages(paths.OUT, os.path.join(paths.BENCH, "three"))
        if not chromium or not modules:
            raise measure.Absent("the page: %s is missing" % ("playwright-core" if chromium else "chromium"))
        self.process = subprocess.Popen(["node", os.path.join(paths.BENCH, "three", "lab.mjs"), modules, chromium, PAGE, self.folder], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return self


def turned(page, paced=False):
    return page.answer(turn=1500, paced=paced)


def teapot():
    with Page(paths.MODELS) as page:
        told = page.answer(load=[TEAPOT[0], "--size=%dx%d" % (WIDTH, HEIGHT), *TEAPOT[1:]])
        taken = [turned(page, True) for _ in range(5)]
    rates = [1000 * len(one["frames"]) / sum(one["frames"]) for one in taken]
    sharp, scale = measure.spread([one["sharp"] for one in taken]), statistics.median(one["scale"] for one in taken)
    return {"ms": {"the page": measure.spread([statistics.median(one["frames"]) for one in taken]), "the whole picture": sharp}, "frames_per_s": measure.spread(rates), "scale": scale,
            "threads": told["threads"], "reached": statistics.median(rates) >= FRAMES_PER_S and sharp["median"] <= SHARP_MS}


def beside_three():
    path = os.path.join(paths.MODELS, "turning.glb")
    os.makedirs(paths.MODELS, exist_ok=True)
    if not os.path.exists(path):
        make_ball(path)
    direction = three_rows.LIGHT["direction"]
    words = ["--size=%dx%d" % (WIDTH, HEIGHT), "--ao=off", "--light=directional:direction=%g/%g/%g,intensity=%g" % (*direction, three_rows.LIGHT["intensity"])]
    ours, theirs = frames.picture("turning-lambent"), frames.picture("turning-three")
    report = measure.lambent(path, *words, "--samples=1", "-o", ours)
    task = {"load": "turning.glb", "size": [WIDTH, HEIGHT], "camera": three_rows.camera_of(report), "light": three_rows.LIGHT}
    with Page(paths.MODELS) as page, three_rows.Browser(paths.MODELS) as plain, three_rows.Browser(paths.MODELS) as smooth:
        camera = ",".join("%s=%s" % (key, "/".join("%.5f" % x for x in report["camera"][key])) for key in ("eye", "target", "up"))
        threads = page.answer(load=["/turning.glb", *words, "--camera=%s,fovy=%g" % (camera, report["camera"]["fovy_deg"])])["threads"]
        told = plain.answer(**task)
        smooth.answer(**task, antialias=True)
        plain.answer(save=theirs)
        difference = json.loads(measure.output([paths.LAMBENT, "diff", "--json", "--tolerance", "255", ours, theirs]))
        if difference["mean"] > three_rows.MOST_DIFFERENT:
            raise measure.Failed("three.js draws a different picture (mean difference %.3f)" % difference["mean"])
        scales = []

        def shown():
            one = turned(page)
            scales.append(one["scale"])
            return statistics.median(one["frames"])

        def of_three(browser):
            return statistics.median(browser.answer(frames=20, turn=3))
        taken = measure.in_turn({"the page": shown, "three.js": functools.partial(of_three, smooth)}, 25, most_rounds=9)
        page_whole = functools.partial(lambda: statistics.median(page.answer(whole=12)["frames"]))
        equal = measure.in_turn({"the page": page_whole, "three.js": functools.partial(of_three, plain)}, 15, most_rounds=7)
    ratio = {"shown": measure.ratio(taken["three.js"], taken["the page"]), "at equal resolution and samples": measure.ratio(equal["three.js"], equal["the page"])}
    return {"ms": {**{key: measure.spread(t) for key, t in taken.items()}, **{key + ", equal": measure.spread(t) for key, t in equal.items()}}, "ratio": ratio,
            "scale": statistics.median(scales), "threads": threads, "peer": told["version"], "renderer": told["renderer"], "triangles": report["model"]["triangles"],
            "difference": {key: difference[key] for key in ("mean", "maximum")}, "reached": ratio["shown"]["median"] >= TIMES}


def rows():
    """(name, target in words, function that measures and judges)."""
    yield "turning the teapot", "≥ %d frames a second, whole within %d ms" % (FRAMES_PER_S, SHARP_MS), teapot
    yield "turning 100,000 triangles", "≥ %d × three.js as shown" % TIMES, beside_three
