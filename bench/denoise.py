#!/usr/bin/env python3
"""denoise.py LAMBENT [SIZE [PATHS]]: how close ten filtered pictures of 64 paths are to pictures of PATHS paths (16,384) without filter.

For each picture, the script prints the structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004: a Gaussian window with a standard deviation of 1.5 pixels,
the constants 0.01 and 0.03) of the displayed luminance with and without the filter, as the mean over the pixels that the model covers."""
import math
import os
import subprocess
import sys
import tempfile

import paths

EXAMPLES = os.path.join(paths.ROOT, "examples")
PICTURES = {
    "still life": [os.path.join(EXAMPLES, "still-life.json")],
    "Cornell box": [os.path.join(EXAMPLES, "cornell.json")],
    "bowl": [os.path.join(EXAMPLES, "bowl.json")],
    "textured cow": [os.path.join(EXAMPLES, "models", "spot.glb")],
    "machine parts": [os.path.join(EXAMPLES, "models", "parts.obj"), "--material", "silver,roughness=0.3", "--environment", "studio"],
    "gold knot": ["torus-knot", "--material", "gold", "--environment", "studio"],
    "glass teapot": ["teapot", "--material", "glass", "--environment", "sky"],
    "matt gyroid in the sky": ["gyroid", "--material", "white,roughness=1", "--environment", "sky"],
    "clear coat": ["metaballs", "--material", "#a01020,roughness=0.5,clearcoat=1", "--environment", "studio"],
    "small lamp": ["torus-knot", "--material", "white,roughness=0.6", "--light", "point:position=2/3/2,radius=0.3"],
}
REACH = 5
WEIGHTS = [math.exp(-i * i / (2 * 1.5 * 1.5)) for i in range(-REACH, REACH + 1)]


def drawn(words, size, *more):
    """The luminance (0 to 255) of a picture, row by row."""
    subprocess.run([*words, "-q", "-s", str(size), *more, "-o", "a.ppm"], check=True)
    with open("a.ppm", "rb") as file:
        pixels = file.read()[-3 * size * size:]
    return [0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2] for i in range(0, len(pixels), 3)]


def traced(words, size, count, denoise):
    return drawn(words, size, "--bounces", "4", "--paths", str(count), "--denoise", denoise)


def blurred(values, size):
    """Each pixel's mean under the window, which ends at the border."""
    for step, other in ((1, size), (size, 1)):
        out = [0.0] * len(values)
        for line in range(size):
            for at in range(size):
                total = weight = 0
                for i in range(max(0, at - REACH), min(size, at + REACH + 1)):
                    w = WEIGHTS[i - at + REACH]
                    total += w * values[line * other + i * step]
                    weight += w
                out[line * other + at * step] = total / weight
        values = out
    return values


def similarity(a, b, covered, size):
    mean_a, mean_b = blurred(a, size), blurred(b, size)
    squares = [blurred([x * y for x, y in zip(*pair)], size) for pair in ((a, a), (b, b), (a, b))]
    c1, c2, total = (0.01 * 255) ** 2, (0.03 * 255) ** 2, []
    for i in range(size * size):
        if covered[i]:
            ma, mb = mean_a[i], mean_b[i]
            va, vb, vab = squares[0][i] - ma * ma, squares[1][i] - mb * mb, squares[2][i] - ma * mb
            total.append((2 * ma * mb + c1) * (2 * vab + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2)))
    return sum(total) / len(total)


if __name__ == "__main__":
    program, size, count = os.path.abspath(sys.argv[1]), int(sys.argv[2] if len(sys.argv) > 2 else 128), int(sys.argv[3] if len(sys.argv) > 3 else 16384)
    os.chdir(tempfile.mkdtemp())
    all_on = []
    for name, words in PICTURES.items():
        words = [program, *words]
        truth, covered = traced(words, size, count, "off"), [v > 0 for v in drawn(words, size, "--show", "coverage", "-b", "black")]
        on, off = (similarity(traced(words, size, 64, word), truth, covered, size) for word in ("on", "off"))
        all_on.append(on)
        print("%s: %.4f with the filter, %.4f without" % (name, on, off), flush=True)
    print("mean: %.4f with the filter" % (sum(all_on) / len(all_on)))
