#!/usr/bin/env python3
"""contact_sheet.py PROGRAM OUT [MODEL...]: draws models with the default settings, next to F3D's pictures.

Every model below the folder LAMBENT_MODELS (or those named; --short: a list of 19) on white, dark and blue at 1024, 256 and 128 pixels, by
Lambent's defaults and, where f3d and Xvfb are installed, by F3D with its best options (FXAA, ambient occlusion, tone mapping for glTF) and the
same camera. Existing pictures in OUT are not drawn again, so an interrupted run can be resumed; --again redraws Lambent's pictures, and keeps F3D's
pictures while the camera is unchanged. The report lists models that only one of the programs, or neither of them, can draw.

Writes the pictures, OUT/index.html, OUT/sheet-SIZE-BACKGROUND-PAGE.png (with montage, from ImageMagick) and OUT/statistics.txt: of the covered
pixels at 256 the mean grey and its 5th, 50th and 95th percentile, how far the outline's pixels are from each background, and how much of the
area that is covered at 256 is left at 128; then what is worth a look: the darkest, the brightest, the faintest outlines, the areas that shrink.
--options 'WORDS' adds options of lambent, to compare looks; --jobs N draws N models at a time; --f3d none leaves F3D out, --f3d white-256 has
it draw that picture alone (it takes ten times as long)."""
import argparse
import html
import json
import multiprocessing
import os
import re
import shutil
import struct
import subprocess
import sys
import zlib

SHORT = ["stl/trimesh/20mm-xyz-cube.stl", "stl/trimesh/featuretype.STL", "stl/trimesh/octagonal_pocket.stl", "stl/derived/koala.stl",
         "stl/derived/wingnut_ascii.stl", "stl/panda/hand.stl", "stl/ur3/shoulder.stl", "obj/nefertiti/nefertiti-lowres.obj", "obj/spot/spot_triangulated.obj",
         "obj/boat/boat.obj", "obj/teapot/teapot.obj", "obj/kaykit_dungeon/table_medium_decorated_A.obj", "obj/sword/sword-quad-dominant.obj",
         "ply/derived/koala_normals.ply", "ply/trimesh/featuretype.ply", "glb/kaykit_adventurers/Knight.glb", "glb/playcanvas/chess-board.glb",
         "glb/bevy/Fox.glb", "gltf/bevy/PalmTree/PalmTree.gltf"]
# Folders in the order in which they are drawn: models first, then the test files of glTF, most of them squares.
FOLDERS = ("stl", "obj", "ply", "glb", "gltf", "gltf-tests")
BACKGROUNDS = {"white": (255, 255, 255), "dark": (38, 38, 42), "blue": (47, 84, 130)}
SIZES = (1024, 256, 128)
SHOWN = {1024: 448, 256: 256, 128: 128}  # pictures per side of a sheet, and models per sheet
MODELS_PER_SHEET = {1024: 8, 256: 24, 128: 96}
ENDINGS = (".stl", ".obj", ".ply", ".glb", ".gltf")
PATIENCE_S = 300


def listed(folder):
    """All models below a folder."""
    found = [os.path.join(root, name) for root, _, names in os.walk(folder) for name in names if name.lower().endswith(ENDINGS)]

    def order(path):
        first = os.path.relpath(path, folder).split(os.sep)[0]
        return (FOLDERS.index(first) if first in FOLDERS else len(FOLDERS), "asset-generator" in path, path)
    return sorted(found, key=order)


EVERY_PICTURE = [(background, size) for background in BACKGROUNDS for size in SIZES]


def picture_name(name, maker, background, size):
    return "%s-%s-%s-%d.png" % (name, maker, background, size)


def run(*words):
    try:
        return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, 124, b"", b"no end after %d s" % PATIENCE_S)


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
        for i in range(len(row)) if method else ():
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


def grey(color):
    return (299 * color[0] + 587 * color[1] + 114 * color[2]) / 1000


def area(white, dark):
    """Covered area in pixels, from the same picture over two backgrounds."""
    paper = grey(BACKGROUNDS["white"]) - grey(BACKGROUNDS["dark"])
    return sum(min(max(1 - (a - b) / paper, 0), 1) for a, b in zip(white, dark))


def statistics(folder, name, maker):
    """Covered pixels have the same value over two backgrounds. Returns None if pictures are missing or empty."""
    try:
        pictures = {b: greys(os.path.join(folder, picture_name(name, maker, b, 256))) for b in BACKGROUNDS}
        small = [greys(os.path.join(folder, picture_name(name, maker, b, 128)))[2] for b in ("white", "dark")]
    except (FileNotFoundError, KeyError, struct.error, zlib.error):
        return None
    width, _, white = pictures["white"]
    dark = pictures["dark"][2]
    covered = [abs(a - b) < 0.5 for a, b in zip(white, dark)]
    values = sorted(v for v, inside in zip(white, covered) if inside)
    if not values:
        return None
    rim = [i for i in range(len(covered)) if covered[i] and width <= i < len(covered) - width and 0 < i % width < width - 1 and
           not all(covered[j] for j in (i - 1, i + 1, i - width, i + width))]
    result = {"mean": sum(values) / len(values), "area": area(white, dark) / len(white)}
    result["kept"] = area(*small) / len(small[0]) / result["area"] if result["area"] > 0 else 0
    for share in (5, 50, 95):
        result[str(share)] = values[int((len(values) - 1) * share / 100)]
    for background, color in BACKGROUNDS.items():
        result[background] = sum(abs(pictures[background][2][i] - grey(color)) for i in rim) / max(1, len(rim))
    return result


def f3d_words(path, camera, size, color, out):
    def numbers(vector):
        return ",".join("%.9g" % x for x in vector)
    ending = path.lower().rsplit(".", 1)[1]
    return ["f3d", path, "--dry-run", "--quiet", "--output=" + out, "--resolution=%d,%d" % (size, size), "--fxaa", "--ssao",
            "--bg-color=" + ",".join("%.4f" % (c / 255) for c in color), "--camera-position=" + numbers(camera["eye"]),
            "--camera-focal-point=" + numbers(camera["target"]), "--camera-view-up=" + numbers(camera["up"]),
            "--camera-view-angle=%.9g" % camera["fovy_deg"], "--up=%s" % ("+Z" if ending == "stl" else "+Y"),
            *(["--tone-mapping"] if ending in ("glb", "gltf") else [])]


def draw(job):
    """Draws the missing pictures of one model, and then writes its record."""
    program, path, name, folder, options, f3d_pictures, again = job
    record_path = os.path.join(folder, name + ".json")
    record = json.load(open(record_path, encoding="utf-8")) if os.path.exists(record_path) else {}
    cameras = dict(record.get("cameras", {}))
    drawn = False
    if again or "lambent" not in record:
        drawn, record["refused"] = True, None
        for background, size in EVERY_PICTURE:
            done = run(program, path, *options, "-s", size, "-b", "#%02x%02x%02x" % BACKGROUNDS[background], "-o",
                       os.path.join(folder, picture_name(name, "lambent", background, size)), "--json")
            if done.returncode:
                record["refused"] = (done.stderr.decode("utf-8", "replace").strip().splitlines() or ["status %d" % done.returncode])[-1]
                break
            cameras[str(size)] = json.loads(done.stdout)["camera"]
        record["lambent"] = None if record["refused"] else statistics(folder, name, "lambent")
    for background, size in f3d_pictures if not record["refused"] else ():
        out = os.path.join(folder, picture_name(name, "f3d", background, size))
        key = "%s-%d" % (background, size)
        asked = record.setdefault("asked of f3d", {})  # the camera of each picture, also of those that it did not draw
        if asked.get(key) == cameras[str(size)]:
            continue
        drawn, asked[key] = True, cameras[str(size)]
        if os.path.exists(out):
            os.remove(out)
        run(*f3d_words(path, cameras[str(size)], size, BACKGROUNDS[background], out))
    if drawn:
        record.update(path=path, name=name, cameras=cameras, f3d=statistics(folder, name, "f3d"))
        with open(record_path + ".new", "w", encoding="utf-8") as file:
            json.dump(record, file)
        os.replace(record_path + ".new", record_path)
    return record


def line_of(name, maker, s):
    if not s:
        return "%-48s %-8s not all pictures" % (name[-48:], maker)
    return "%-48s %-8s mean %5.1f  5 %% %5.1f  50 %% %5.1f  95 %% %5.1f  outline to white %5.1f  dark %5.1f  blue %5.1f  kept at 128 %5.1f %%" % (
        name[-48:], maker, s["mean"], s["5"], s["50"], s["95"], s["white"], s["dark"], s["blue"], 100 * s["kept"])


def report(records, makers):
    lines = []
    for record in records:
        if record["refused"]:
            lines.append("%-48s lambent  refuses: %s" % (record["name"][-48:], record["refused"]))
            continue
        lines += [line_of(record["name"], maker, record.get(maker)) for maker in makers]
    for maker in makers:
        drawn = [(r["name"], r[maker]) for r in records if r.get(maker)]
        if not drawn:
            continue

        def ends(title, key, reverse=False, drawn=drawn):
            lines.append("%s, %s" % (maker, title))
            lines.extend("    %-60s %6.2f" % (name[-60:], key(s)) for name, s in sorted(drawn, key=lambda d: key(d[1]), reverse=reverse)[:10])
        means = sorted(s["mean"] for _, s in drawn)
        lines += ["", "%s: %d models drawn; mean grey: median %.1f, a tenth below %.1f, a tenth above %.1f" % (
            maker, len(drawn), means[len(means) // 2], means[len(means) // 10], means[len(means) * 9 // 10])]
        ends("the darkest:", lambda s: s["mean"])
        ends("the brightest:", lambda s: s["mean"], True)
        for background in BACKGROUNDS:
            ends("the faintest outlines on %s:" % background, lambda s, b=background: s[b])
        ends("the least area kept at 128, of that at 256:", lambda s: s["kept"])
    return lines


def sheets(records, makers, folder):
    for size in SIZES:
        step = MODELS_PER_SHEET[size]
        columns = {1024: 4, 256: 8, 128: 16}[size]
        for background in BACKGROUNDS:
            for page in range(0, len(records), step):
                words = []
                for record in records[page:page + step]:
                    for maker in makers:
                        picture = picture_name(record["name"], maker, background, size)
                        there = os.path.exists(os.path.join(folder, picture))
                        words += ["-label", record["name"][-28:] + " " + maker, picture if there else "xc:grey50[%dx%d!]" % (SHOWN[size], SHOWN[size])]
                run("montage", "-pointsize", 9, *[os.path.join(folder, w) if w.endswith(".png") else w for w in words], "-geometry",
                    "%dx%d+2+2" % (SHOWN[size], SHOWN[size]), "-tile", "%dx" % columns,
                    os.path.join(folder, "sheet-%d-%s-%02d.png" % (size, background, page // step + 1)))


def page_of_all(records, makers, folder):
    with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
        file.write("<!doctype html><meta charset=utf-8><title>Contact sheet</title><table>\n")
        for record in records:
            for size in SIZES:
                cells = "".join("<td><img loading=lazy width=%d src='%s'>" % (min(size, 320), html.escape(picture_name(record["name"], maker, background, size)))
                                for background in BACKGROUNDS for maker in makers)
                file.write("<tr><th>%s %d%s\n" % (html.escape(record["name"]), size, cells))
        file.write("</table>\n")


def screen():
    """An X server without a screen for F3D, and its process; xvfb-run would start one for every picture."""
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x1100x24", "-nolisten", "tcp"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL)
    os.environ["DISPLAY"] = ":" + server.stdout.readline().decode().strip()
    return server


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("out")
    parser.add_argument("models", nargs="*")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--options", default="")
    parser.add_argument("--f3d", default="all")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    given = parser.parse_args()
    root = os.environ.get("LAMBENT_MODELS", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "shared", "models"))
    models = given.models or ([os.path.join(root, m) for m in SHORT] if given.short else listed(root))
    if not models:
        sys.exit("contact_sheet.py: no models; name some, or their folder with LAMBENT_MODELS")
    f3d_pictures = [p for p in EVERY_PICTURE if given.f3d == "all" or "%s-%d" % p in given.f3d.split(",")]
    if not (shutil.which("f3d") and shutil.which("Xvfb")):
        f3d_pictures = []
    makers = ["lambent"] + (["f3d"] if f3d_pictures else [])
    os.makedirs(given.out, exist_ok=True)

    def name_of(path):
        inside = os.path.relpath(path, root)
        return re.sub(r"[^A-Za-z0-9_]+", "-", os.path.basename(path) if inside.startswith("..") else inside)
    jobs = [(os.path.abspath(given.program), path, name_of(path), given.out, given.options.split(), f3d_pictures, given.again) for path in models]
    server = screen() if f3d_pictures else None
    records = []
    try:
        with multiprocessing.Pool(given.jobs) as pool:
            for record in pool.imap(draw, jobs):
                records.append(record)
                print("%d of %d: %s%s" % (len(records), len(jobs), record["name"], ", refused" if record["refused"] else ""), flush=True)
    finally:
        if server:
            server.terminate()
            server.wait()
    with open(os.path.join(given.out, "statistics.txt"), "w", encoding="utf-8") as file:
        file.write("\n".join(report(records, makers)) + "\n")
    page_of_all(records, makers, given.out)
    if shutil.which("montage"):
        sheets(records, makers, given.out)


if __name__ == "__main__":
    main()
