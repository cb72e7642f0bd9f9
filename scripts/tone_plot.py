#!/usr/bin/env python3
"""tone_plot.py BUILD: draws the tone curves for docs/lighting/tone.md with the library: docs/pictures/lighting/tone.svg and tone-colors.svg.

The first plots grey light against the encoded value; the second shows the effect of the curves on saturated light of increasing brightness. BUILD is
a build folder, whose liblambent is called (lam_tone_apply)."""
import ctypes
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 420, 58, 24, 20, 54
COLORS = {"none": "#777777", "reinhard": "#1a56a0", "aces": "#c05020", "agx": "#2f8f4e", "khronos-neutral": "#7a3fa0", "contrast": "#b08a00", "soft": "#333333"}
LOW, HIGH = -7, 5  # stops relative to 0.18


class Rgb(ctypes.Structure):
    _fields_ = [("r", ctypes.c_float), ("g", ctypes.c_float), ("b", ctypes.c_float)]


def load(build):
    found = sorted(pathlib.Path(build).resolve().glob("src/liblambent.so*"))
    if not found:
        sys.exit(f"{build}: no src/liblambent.so, expected the folder of a build")
    library = ctypes.CDLL(str(found[0]))
    library.lam_tone_name.restype = ctypes.c_char_p
    library.lam_tone_apply.restype = Rgb
    library.lam_tone_apply.argtypes = [ctypes.c_int, Rgb]
    names = {}
    while library.lam_tone_name(len(names)):
        names[library.lam_tone_name(len(names)).decode()] = len(names)

    def apply(name, color):
        c = library.lam_tone_apply(names[name], Rgb(*color))
        return c.r, c.g, c.b
    return [n for n in names if n != "auto"], apply


def encoded(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def across(stops):
    return LEFT + (WIDTH - LEFT - RIGHT) * (stops - LOW) / (HIGH - LOW)


def up(value):
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * value


def text(x, y, words, anchor="middle", color="#222222", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}"{more}>{words}</text>'


def page(parts, height=HEIGHT):
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" '
                      'font-family="DejaVu Sans, sans-serif" font-size="13">', '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


def curves(names, apply):
    parts = []
    for i in range(5):
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{up(i / 4):.1f}" y2="{up(i / 4):.1f}" stroke="#dddddd"/>')
        parts.append(text(LEFT - 8, up(i / 4) + 4, "%g" % (i / 4), "end"))
    for stops in range(LOW, HIGH + 1):
        parts.append(f'<line x1="{across(stops):.1f}" x2="{across(stops):.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#eeeeee"/>')
        parts.append(text(across(stops), HEIGHT - BOTTOM + 18, "%+d" % stops if stops else "0"))
    for number, name in enumerate(names):
        points = []
        for i in range(20 * (HIGH - LOW) + 1):
            light = 0.18 * 2 ** (LOW + i / 20)
            points.append(f"{across(LOW + i / 20):.1f},{up(encoded(apply(name, (light,) * 3)[1])):.1f}")
        parts.append(f'<polyline points="{" ".join(points)}" fill="none" stroke="{COLORS[name]}" stroke-width="2"/>')
        parts.append(f'<line x1="{LEFT + 14}" x2="{LEFT + 38}" y1="{TOP + 20 + 20 * number}" y2="{TOP + 20 + 20 * number}" stroke="{COLORS[name]}" stroke-width="3"/>')
        parts.append(text(LEFT + 46, TOP + 24 + 20 * number, name, "start", COLORS[name]))
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, "grey light, stops from 0.18"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(text(14, middle, "encoded, 0 to 1", more=f' transform="rotate(-90 14 {middle:.0f})"'))
    return page(parts)


def colors(names, apply):
    """A row for each curve: red, orange, green and blue light from dark to very bright."""
    hues, steps, row, left = ((1, 0.03, 0.03), (1, 0.4, 0.03), (0.05, 0.8, 0.08), (0.05, 0.1, 1)), 24, 22, 130
    parts, y = [], 10
    for hue in hues:
        for name in names:
            parts.append(text(left - 8, y + 16, name, "end"))
            for i in range(steps):
                light = 0.18 * 2 ** (LOW + 1 + i * (HIGH + 1 - LOW) / steps)
                c = [round(255 * encoded(x)) for x in apply(name, [light * h for h in hue])]
                width = (WIDTH - left - 10) / steps
                parts.append(f'<rect x="{left + i * width:.1f}" y="{y}" width="{width + 0.5:.1f}" height="{row}" fill="#{c[0]:02x}{c[1]:02x}{c[2]:02x}"/>')
            y += row
        y += 10
    return page(parts, y)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    names, apply = load(sys.argv[1])
    folder = ROOT / "docs/pictures/lighting"
    (folder / "tone.svg").write_text(curves(names, apply))
    (folder / "tone-colors.svg").write_text(colors(names, apply))


if __name__ == "__main__":
    main()
