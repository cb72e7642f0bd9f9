#!/usr/bin/env python3
"""beside.py sheets OURS PEER OUT [--seed N]   pairs of pictures of the same name, sides shuffled, for a blind judgement
beside.py tally OUT ANSWERS...              counts won, drawn and lost; an answer is "7A", "7B" or "7=", a file of answers a judge
beside.py page OURS PEER OUT                the pairs with names, ours on the left: sheets of WebP for docs/beside.md

OURS and PEER are folders of PNG files, such as bench/contact_sheet.py and bench/model_viewer.mjs write. `sheets` writes OUT/sheet-K.png and
OUT/key.json, which judges do not get to see. Needs python3-pil."""
import argparse
import json
import pathlib
import random

from PIL import Image, ImageDraw, ImageFont

SIDE, GAP, HEAD, COLUMNS, ROWS = 320, 8, 24, 2, 4
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def picture(path):
    """White background, in the size of a cell."""
    image = Image.open(path).convert("RGBA")
    page = Image.new("RGBA", image.size, "white")
    page.alpha_composite(image)
    return page.convert("RGB").resize((SIDE, SIDE), Image.LANCZOS)


def sheet(pairs):
    """`pairs`: (title, left path, right path)."""
    rows = (len(pairs) + COLUMNS - 1) // COLUMNS
    width = 2 * SIDE + GAP
    out = Image.new("RGB", (COLUMNS * width + (COLUMNS - 1) * 2 * GAP, rows * (SIDE + HEAD)), (110, 110, 110))
    draw, font = ImageDraw.Draw(out), ImageFont.truetype(FONT, 15)
    for i, (title, left, right) in enumerate(pairs):
        x, y = i % COLUMNS * (width + 2 * GAP), i // COLUMNS * (SIDE + HEAD)
        draw.text((x + 4, y + 3), title, font=font)
        out.paste(picture(left), (x, y + HEAD))
        out.paste(picture(right), (x + SIDE + GAP, y + HEAD))
    return out


def pages(items):
    return [items[i:i + COLUMNS * ROWS] for i in range(0, len(items), COLUMNS * ROWS)]


def common(ours, peer):
    return sorted(p.stem for p in ours.glob("*.png") if (peer / p.name).exists())


def write_sheets(given):
    names, chance, key = common(given.ours, given.peer), random.Random(given.seed), {}
    chance.shuffle(names)
    given.out.mkdir(parents=True, exist_ok=True)
    for k, part in enumerate(pages(list(enumerate(names, 1)))):
        pairs = []
        for number, name in part:
            ours_left = chance.random() < 0.5
            key[number] = (name, "A" if ours_left else "B")
            paths = [given.ours / f"{name}.png", given.peer / f"{name}.png"]
            pairs.append((f"{number}:  A left, B right", *(paths if ours_left else reversed(paths))))
        sheet(pairs).save(given.out / f"sheet-{k + 1}.png")
    (given.out / "key.json").write_text(json.dumps(key))
    print(len(names), "pairs")


def tally(given):
    """The majority of the judges decides; without a majority, the pair is a draw."""
    key = json.loads((given.out / "key.json").read_text())
    votes = {number: [] for number in key}
    for path in given.answers:
        for word in pathlib.Path(path).read_text().split():
            votes[word[:-1]].append(word[-1])
    count = {"won": 0, "drawn": 0, "lost": 0}
    for number, (name, ours) in key.items():
        won = sum(v == ours for v in votes[number])
        lost = sum(v not in (ours, "=") for v in votes[number])
        result = "won" if 2 * won > len(votes[number]) else "lost" if 2 * lost > len(votes[number]) else "drawn"
        count[result] += 1
        if result != "won":
            print(name, result, *votes[number])
    print(count)


def write_page(given):
    given.out.mkdir(parents=True, exist_ok=True)
    for k, part in enumerate(pages(common(given.ours, given.peer))):
        sheet([(name, given.ours / f"{name}.png", given.peer / f"{name}.png") for name in part]).save(
            given.out / f"{given.peer.name}-{k + 1}.webp", quality=80, method=6)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, run in (("sheets", write_sheets), ("page", write_page)):
        command = commands.add_parser(name)
        for folder in ("ours", "peer", "out"):
            command.add_argument(folder, type=pathlib.Path)
        command.add_argument("--seed", type=int, default=1)
        command.set_defaults(run=run)
    command = commands.add_parser("tally")
    command.add_argument("out", type=pathlib.Path)
    command.add_argument("answers", nargs="+")
    command.set_defaults(run=tally)
    given = parser.parse_args()
    given.run(given)


main()
