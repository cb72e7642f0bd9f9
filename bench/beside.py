#!/usr/bin/env python3
"""beside.py draw PROGRAM OUT             draws the models of bench/peers/models.txt with Lambent and its peers: OUT/ours, OUT/f3d, …
beside.py sheets [--crop] OURS OUT PEER...   pairs of pictures of the same name, sides shuffled, for a blind judgement; --crop: to the model
beside.py tally OUT ANSWERS...         counts won, drawn and lost; an answer is "7L", "7R" or "7=", a file of answers a judge
beside.py page OURS PEER OUT           the pairs with names, ours on the left: sheets of WebP for docs/beside.md

`draw` needs LAMBENT_MODELS, the folder of the models, python3-pil, F3D 1.3 and Xvfb (Debian's f3d and xvfb), Chromium, node and npm, which
installs F3D 3.5 and model-viewer (bench/peers/package-lock.json). It skips pictures that exist, so it can be repeated. Each peer uses its best
settings and the same camera: F3D 1.3 FXAA, ambient occlusion, depth peeling and tone mapping of glTF, at twice the size; F3D 3.5 also
supersampling and its own environment; model-viewer its defaults, at twice the size. OUT/f3d has the better of the two pictures of F3D,
which a person chose: see bench/peers/models.txt.

`sheets` writes OUT/page_KK.png, OUT/NN_left.png and OUT/NN_right.png, and OUT/key.json, which judges do not get to see."""
import argparse
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys

from PIL import Image, ImageChops, ImageDraw, ImageFont

import contact_sheet
import paths

sys.path.insert(0, os.path.join(paths.ROOT, "web"))
import build  # noqa: E402

SIDE, GAP, HEAD, COLUMNS, ROWS = 320, 8, 24, 2, 3
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
PEERS = pathlib.Path(paths.BENCH) / "peers"


def listed():
    """Of each model its name, its path, the better F3D, and whether model-viewer draws it."""
    for line in (PEERS / "models.txt").read_text().splitlines():
        if not line.startswith("#"):
            name, path, *words = line.split()
            yield name, path, next((w for w in words if w.startswith("f3d")), "f3d-1.3"), "model-viewer" in words


def draw_ours(program, path, out):
    """Draws a model, and returns what Lambent prints of it as JSON."""
    done = contact_sheet.run(program, path, "-s", 2 * SIDE, "-b", "white", "-o", out, "--json")
    if done.returncode:
        sys.exit("beside.py: %s" % done.stderr.decode().strip())
    return json.loads(done.stdout)


def draw_peers(given, tasks):
    """Draws the missing pictures of `tasks`: (peer, name, path, report of Lambent)."""
    root = paths.REAL_MODELS
    tasks = [task for task in tasks if not (given.out / task[0] / (task[1] + ".png")).exists()]
    old = [task for task in tasks if task[0] == "f3d-1.3"]
    if old and shutil.which("f3d") and shutil.which("Xvfb"):
        server = contact_sheet.screen()
        for peer, name, path, report in old:
            words = contact_sheet.f3d_words(os.path.join(root, path), report["camera"], 2 * SIDE, (255, 255, 255), str(given.out / peer / (name + ".png")))
            contact_sheet.run(*words, "--depth-peeling")
        server.terminate()
    modules = build.packages(os.path.join(paths.OUT, "peers"), str(PEERS))
    if not modules or not shutil.which("chromium"):
        sys.exit("beside.py: F3D 3.5 and model-viewer need npm and chromium")
    lines = [json.dumps({"peer": peer, "name": name, "path": path, "size": 2 * SIDE if peer == "model-viewer" else SIDE, "camera": report["camera"],
                         "up": "+" + report["model"]["up"].upper()})
             for peer, name, path, report in sorted(tasks, key=lambda task: task[0]) if peer != "f3d-1.3"]
    subprocess.run(["node", str(PEERS / "pictures.mjs"), modules, shutil.which("chromium"), root, str(given.out)],
                   input="\n".join(lines), text=True, check=True)


def draw(given):
    if not paths.REAL_MODELS:
        sys.exit("beside.py: name the folder of models with LAMBENT_MODELS")
    for folder in ("ours", "f3d", "f3d-1.3"):
        (given.out / folder).mkdir(parents=True, exist_ok=True)
    tasks = []
    for name, path, _, in_browser in listed():
        report = draw_ours(given.program.absolute(), os.path.join(paths.REAL_MODELS, path), given.out / "ours" / (name + ".png"))
        tasks += [(peer, name, path, report) for peer in ["f3d-1.3", "f3d-3.5", "f3d-3.5-tone"] + ["model-viewer"] * in_browser]
    draw_peers(given, tasks)
    for name, _, best, _ in listed():
        for peer in (best, "f3d-1.3", "f3d-3.5"):
            if (given.out / peer / (name + ".png")).exists():
                shutil.copy(given.out / peer / (name + ".png"), given.out / "f3d")
                break


def picture(path, crop=False):
    """On white, as large as a cell. `crop`: to the model, so that models have the same size whatever the distance of a program's camera."""
    image = Image.open(path).convert("RGBA")
    page = Image.new("RGBA", image.size, "white")
    page.alpha_composite(image)
    page = page.convert("RGB")
    box = crop and ImageChops.difference(page, Image.new("RGB", page.size, "white")).convert("L").point(lambda v: 255 * (v > 3)).getbbox()
    if box:
        side = round(1.06 * max(box[2] - box[0], box[3] - box[1]))
        left, top = (box[0] + box[2] - side) // 2, (box[1] + box[3] - side) // 2
        square = Image.new("RGB", (side, side), "white")
        square.paste(page.crop(box), (box[0] - left, box[1] - top))
        page = square
    return page.resize((SIDE, SIDE), Image.LANCZOS)


def sheet(pairs, crop=False):
    """`pairs`: (title, left path, right path)."""
    rows = (len(pairs) + COLUMNS - 1) // COLUMNS
    width = 2 * SIDE + GAP
    out = Image.new("RGB", (COLUMNS * width + (COLUMNS - 1) * 2 * GAP, rows * (SIDE + HEAD)), (110, 110, 110))
    draw, font = ImageDraw.Draw(out), ImageFont.truetype(FONT, 15)
    for i, (title, left, right) in enumerate(pairs):
        x, y = i % COLUMNS * (width + 2 * GAP), i // COLUMNS * (SIDE + HEAD)
        draw.text((x + 4, y + 3), title, font=font)
        out.paste(picture(left, crop), (x, y + HEAD))
        out.paste(picture(right, crop), (x + SIDE + GAP, y + HEAD))
    return out


def pages(items):
    return [items[i:i + COLUMNS * ROWS] for i in range(0, len(items), COLUMNS * ROWS)]


def common(ours, peer):
    return sorted(p.stem for p in ours.glob("*.png") if (peer / p.name).exists())


def write_sheets(given):
    chance, pairs, key = random.Random(given.seed), [], {}
    given.out.mkdir(parents=True, exist_ok=True)
    for peer in given.peers:
        names = common(given.ours, peer)
        chance.shuffle(names)
        pairs += [(name, peer) for name in names]
    for k, part in enumerate(pages(list(enumerate(pairs, 1))), 1):
        rows = []
        for number, (name, peer) in part:
            side = chance.choice(("left", "right"))
            key[number] = {"name": name, "peer": peer.name, "ours": side}
            paths_ = [given.ours / f"{name}.png", peer / f"{name}.png"][::1 if side == "left" else -1]
            rows.append((str(number), *paths_))
            for which, path in zip(("left", "right"), paths_):
                picture(path, given.crop).save(given.out / f"{number:02}_{which}.png")
        sheet(rows, given.crop).save(given.out / f"page_{k:02}.png")
    (given.out / "key.json").write_text(json.dumps(key, indent=1))
    print(len(pairs), "pairs")


def tally(given):
    """The majority of the judges decides; without one the pair is a draw."""
    key = json.loads((given.out / "key.json").read_text())
    votes = {number: [] for number in key}
    for path in given.answers:
        for word in pathlib.Path(path).read_text().split():
            votes[word[:-1]].append(word[-1])
    count = {}
    for number, pair in key.items():
        ours = "L" if pair["ours"] == "left" else "R"
        won = sum(v == ours for v in votes[number])
        lost = sum(v not in (ours, "=") for v in votes[number])
        result = "won" if 2 * won > len(votes[number]) else "lost" if 2 * lost > len(votes[number]) else "drawn"
        count[pair["peer"], result] = count.get((pair["peer"], result), 0) + 1
        if result != "won":
            print(pair["name"], pair["peer"], result, *votes[number])
    for (peer, result), number in sorted(count.items()):
        print(peer, result, number)


def write_page(given):
    given.out.mkdir(parents=True, exist_ok=True)
    for k, part in enumerate(pages(common(given.ours, given.peer))):
        sheet([(name, given.ours / f"{name}.png", given.peer / f"{name}.png") for name in part]).save(
            given.out / f"{given.peer.name}-{k + 1}.webp", quality=80, method=6)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, run, words in (("draw", draw, ("program", "out")), ("sheets", write_sheets, ("ours", "out")), ("page", write_page, ("ours", "peer", "out")),
                             ("tally", tally, ("out",))):
        command = commands.add_parser(name)
        command.set_defaults(run=run)
        for word in words:
            command.add_argument(word, type=pathlib.Path)
        if name == "sheets":
            command.add_argument("peers", nargs="+", type=pathlib.Path)
            command.add_argument("--seed", type=int, default=1)
            command.add_argument("--crop", action="store_true", help="crop both pictures to the model")
        elif name == "tally":
            command.add_argument("answers", nargs="+")
    given = parser.parse_args()
    given.run(given)


main()
