#!/usr/bin/env python3
"""occlusion.py: measures the difference between screen-space ambient occlusion and ray-traced occlusion.

    occlusion.py LAMBENT [MODEL…]       a line for each model, by default all of the folder LAMBENT_MODELS, and for all together
    occlusion.py LAMBENT --write        writes the table of docs/lighting/occlusion.md

Differences (screen − rays) of `--show ao` in bytes, at the covered pixels of the fitted view, one sample a pixel, at two sizes. Pictures are the same on every machine, so these numbers are too."""
import array
import concurrent.futures
import os
import subprocess
import sys
import tempfile

import made_part
import paths

SIZES, RAYS = (256, 640), 256
PAGE = os.path.join(paths.ROOT, "docs", "lighting", "occlusion.md")
KINDS = ("obj", "stl", "ply", "glb")


def models():
    """The first file of each format in each folder; broken files and files that only test a reader are too small to count."""
    if not paths.REAL_MODELS:
        sys.exit("occlusion.py: no model given, expected some or LAMBENT_MODELS=FOLDER")
    for kind in KINDS:
        for folder, _, names in sorted(os.walk(os.path.join(paths.REAL_MODELS, kind))):
            found = [os.path.join(folder, name) for name in sorted(names) if name.lower().endswith("." + kind)]
            yield from [path for path in found if 10000 < os.path.getsize(path) < 4000000 and "draco" not in path][:1]


def channel(lambent, model, folder, size, *words):
    """The first channel of a picture of numbers, one number for each pixel; None if the model cannot be drawn."""
    path = os.path.join(folder, "a.pfm")
    done = subprocess.run([lambent, model, "-q", "-s", str(size), "--samples", "1", "--threads", "1", *words, "-o", path], stderr=subprocess.DEVNULL)
    if done.returncode:
        return None
    with open(path, "rb") as file:
        return array.array("f", file.read().split(b"\n", 3)[3])[::3]


def differences(lambent, model, size):
    with tempfile.TemporaryDirectory() as folder:
        depth = channel(lambent, model, folder, size, "--show", "depth")
        if depth is None:
            return None
        rays = channel(lambent, model, folder, size, "--show", "ao", "--ao", "rays", "--ao-samples", str(RAYS))
        screen = channel(lambent, model, folder, size, "--show", "ao", "--ao", "screen")
        return array.array("f", [255 * (s - r) for s, r, d in zip(screen, rays, depth) if d > 0])


def summary(values):
    """The root mean square, the mean, and the percentages of pixels that are more than 25 bytes too dark and too bright."""
    count = len(values)
    return ((sum(v * v for v in values) / count) ** 0.5, sum(values) / count, 100 * sum(v < -25 for v in values) / count, 100 * sum(v > 25 for v in values) / count)


def row(name, s):
    return "| %s | %.1f | %+.1f | %.2f %% | %.2f %% |" % (name, *s)


def table(lambent, given):
    """Each model has the same weight: the figures for all models are means over the models."""
    yield "| | root mean square | mean | over 25 too dark | over 25 too bright |"
    yield "|---|---|---|---|---|"
    for size in SIZES:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            found = list(pool.map(lambda model: differences(lambent, model, size), given))
        rows = sorted(((summary(d), os.path.basename(m)) for d, m in zip(found, given) if d), reverse=True)
        everything = tuple(sum(s[i] for s, _ in rows) / len(rows) for i in range(4))
        within = sum(s[0] <= 12 and s[2] <= 1 and s[3] <= 3 for s, _ in rows)
        yield row("%d models at %d², %d within 12, 1 %% and 3 %%" % (len(rows), size, within), everything)
        for s, name in rows[: 5 if len(given) > 8 else len(given)]:
            yield row("%s, %d²" % (name, size), s)


def main():
    lambent, write = os.path.abspath(sys.argv[1]), "--write" in sys.argv
    given = [m for m in sys.argv[2:] if m != "--write"] or list(models())
    lines = []
    for line in table(lambent, given):
        print(line, flush=True)
        lines.append(line)
    if write:
        made_part.write(PAGE, "difference", "occlusion.py", lines)


if __name__ == "__main__":
    main()
