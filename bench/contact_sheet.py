#!/usr/bin/env python3
"""contact_sheet.py PROGRAM OUT [MODEL...]: pictures of models as strangers see them first, beside F3D's.

Every model (by default those of a list in the folder LAMBENT_MODELS) on white, dark and blue at 1024, 256 and 128 pixels, by Lambent's
defaults and, where f3d and xvfb-run are installed, by F3D with its best options (FXAA, ambient occlusion, tone mapping for glTF) and the
same camera. Writes OUT/index.html, the pictures, and OUT/statistics.txt: of the covered pixels at 256 the mean grey and its 5th, 50th and
95th percentile, and how far the outline's pixels are from each background; where montage (ImageMagick) is there also OUT/sheet-SIZE-BACKGROUND.png.
--options 'WORDS' adds options of lambent, to compare looks; --no-f3d leaves F3D out."""
import argparse
import html
import json
import os
import shutil
import struct
import subprocess
import sys
import zlib

MODELS = ["stl/trimesh/20mm-xyz-cube.stl", "stl/trimesh/featuretype.STL", "stl/trimesh/octagonal_pocket.stl", "stl/derived/koala.stl",
          "stl/derived/wingnut_ascii.stl", "stl/panda/hand.stl", "stl/ur3/shoulder.stl", "obj/nefertiti", "obj/spot/spot_triangulated.obj", "obj/boat", "obj/teapot",
          "obj/kaykit_dungeon", "obj/sword", "ply/derived", "ply/trimesh", "glb/kaykit_adventurers", "glb/playcanvas", "glb/bevy", "gltf/bevy"]
BACKGROUNDS = {"white": (255, 255, 255), "dark": (38, 38, 42), "blue": (47, 84, 130)}
SIZES = (1024, 256, 128)
ENDINGS = (".stl", ".obj", ".ply", ".glb", ".gltf")


def listed(folder):
    """The list's files; of a folder the largest model below 8 MB."""
    for entry in MODELS:
        path = os.path.join(folder, entry)
        if os.path.isfile(path):
            yield path
        elif os.path.isdir(path):
            found = [os.path.join(root, name) for root, _, names in os.walk(path) for name in names if name.lower().endswith(ENDINGS)]
            yield from sorted((f for f in found if os.path.getsize(f) < 8 << 20), key=lambda f: (-os.path.getsize(f), f))[:1]


def run(*words):
    return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)


def read_png(path):
    """Width, height and the RGB bytes of an 8-bit PNG without interlacing."""
    data = open(path, "rb").read()
    at, packed, width, height, kind = 8, b"", 0, 0, 0
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if name == b"IHDR":
            width, height, _, kind = struct.unpack(">IIBB", body[:10])
        elif name == b"IDAT":
            packed += body
        at += 12 + length
    step = {0: 1, 2: 3, 4: 2, 6: 4}[kind]
    raw, before, out = zlib.decompress(packed), bytearray(width * step), bytearray()
    for y in range(height):
        start = y * (width * step + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + width * step])
        for i in range(len(row)):
            a, b = row[i - step] if i >= step else 0, before[i]
            c = before[i - step] if i >= step else 0
            if method == 4:
                p = a + b - c
                d = (abs(p - a), abs(p - b), abs(p - c))
                guess = a if d[0] <= d[1] and d[0] <= d[2] else b if d[1] <= d[2] else c
            else:
                guess = (0, a, b, (a + b) // 2)[method]
            row[i] = (row[i] + guess) & 255
        for x in range(0, len(row), step):
            out += row[x:x + 1] * 3 if step < 3 else row[x:x + 3]
        before = row
    return width, height, bytes(out)


def greys(path):
    width, height, rgb = read_png(path)
    return width, height, [(299 * rgb[i] + 587 * rgb[i + 1] + 114 * rgb[i + 2]) / 1000 for i in range(0, len(rgb), 3)]


def statistics(folder, name, maker):
    """One line: the covered pixels are those that two backgrounds leave alike."""
    pictures = {b: greys(os.path.join(folder, "%s-%s-%s-256.png" % (name, maker, b))) for b in BACKGROUNDS}
    width, height, white = pictures["white"]
    dark = pictures["dark"][2]
    covered = [abs(a - b) < 0.5 for a, b in zip(white, dark)]
    values = sorted(v for v, inside in zip(white, covered) if inside)
    if not values:
        return "%-9s nothing is covered" % maker
    rim = [i for i in range(len(covered)) if covered[i] and width <= i < len(covered) - width and 0 < i % width < width - 1 and
           not all(covered[j] for j in (i - 1, i + 1, i - width, i + width))]
    line = "%-9s mean %5.1f  5 %% %5.1f  50 %% %5.1f  95 %% %5.1f" % ((maker, sum(values) / len(values)) + tuple(
        values[int((len(values) - 1) * share)] for share in (0.05, 0.5, 0.95)))
    for background, (r, g, b) in BACKGROUNDS.items():
        paper, shown = (299 * r + 587 * g + 114 * b) / 1000, pictures[background][2]
        line += "  outline to %s %5.1f" % (background, sum(abs(shown[i] - paper) for i in rim) / max(1, len(rim)))
    return line


def draw(program, path, name, folder, options, with_f3d):
    ending = path.lower().rsplit(".", 1)[1]
    camera = None
    for background, color in BACKGROUNDS.items():
        for size in SIZES:
            out = os.path.join(folder, "%s-%%s-%s-%d.png" % (name, background, size))
            done = run(program, path, *options, "-s", size, "-b", "#%02x%02x%02x" % color, "-o", out % "lambent", "--json")
            if done.returncode:
                return False
            camera = json.loads(done.stdout)["camera"]
            if with_f3d:
                def numbers(vector):
                    return ",".join("%.9g" % x for x in vector)
                run("xvfb-run", "-a", "f3d", path, "--dry-run", "--quiet", "--output=" + out % "f3d", "--resolution=%d,%d" % (size, size), "--fxaa", "--ssao",
                    "--bg-color=" + ",".join("%.4f" % (c / 255) for c in color), "--camera-position=" + numbers(camera["eye"]),
                    "--camera-focal-point=" + numbers(camera["target"]), "--camera-view-up=" + numbers(camera["up"]),
                    "--camera-view-angle=%.9g" % camera["fovy_deg"], "--up=%s" % ("+Z" if ending == "stl" else "+Y"),
                    *(["--tone-mapping"] if ending in ("glb", "gltf") else []))
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("out")
    parser.add_argument("models", nargs="*")
    parser.add_argument("--options", default="")
    parser.add_argument("--no-f3d", action="store_true")
    given = parser.parse_args()
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "shared", "models")
    models = given.models or list(listed(os.environ.get("LAMBENT_MODELS", root)))
    if not models:
        sys.exit("contact_sheet.py: no models; name some, or the folder with LAMBENT_MODELS")
    with_f3d = not given.no_f3d and shutil.which("f3d") and shutil.which("xvfb-run")
    makers = ["lambent"] + (["f3d"] if with_f3d else [])
    os.makedirs(given.out, exist_ok=True)
    names, lines = [], []
    for path in models:
        name = os.path.basename(path).replace(".", "-")
        name = name if name not in names else name + "-%d" % len(names)
        if not draw(given.program, path, name, given.out, given.options.split(), with_f3d):
            print("%s: not drawn" % path, file=sys.stderr)
            continue
        names.append(name)
        for maker in makers:
            try:
                lines.append("%-28s %s" % (name[:28], statistics(given.out, name, maker)))
            except FileNotFoundError:
                lines.append("%-28s %-9s drew nothing" % (name[:28], maker))
            print(lines[-1], flush=True)
    with open(os.path.join(given.out, "statistics.txt"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    with open(os.path.join(given.out, "index.html"), "w", encoding="utf-8") as file:
        file.write("<!doctype html><meta charset=utf-8><title>Contact sheet</title><table>\n")
        for name in names:
            for size in SIZES:
                cells = "".join("<td><img width=%d src='%s-%s-%s-%d.png'>" % (min(size, 320), html.escape(name), maker, background, size)
                                for background in BACKGROUNDS for maker in makers)
                file.write("<tr><th>%s %d%s\n" % (html.escape(name), size, cells))
        file.write("</table>\n")
    for size in SIZES if shutil.which("montage") else ():
        for background in BACKGROUNDS:
            pictures = ["%s-%s-%s-%d.png" % (name, maker, background, size) for name in names for maker in makers]
            subprocess.run(["montage", "-label", "%f", "-geometry", "%dx%d+3+3" % ((min(size, 256),) * 2), "-tile", "8x",
                            *[p for p in pictures if os.path.exists(os.path.join(given.out, p))], "sheet-%d-%s.png" % (size, background)],
                           cwd=given.out, stderr=subprocess.DEVNULL, check=False)


main()
