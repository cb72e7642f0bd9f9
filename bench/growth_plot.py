"""growth_plot.py: one series as an SVG: both axes logarithmic, the lines of lambent and its peer, and a guide of slope one."""
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 420, 70, 30, 24, 56
OURS, PEER, GUIDE, TEXT = "#1a56a0", "#c05020", "#aaaaaa", "#222222"
UNITS = {"triangles": "triangles", "pixels": "pixels of the picture", "lights": "point lights", "threads": "threads"}


def short(value):
    for size, letter in ((1e6, " M"), (1e3, " k")):
        if value >= size:
            return "%g%s" % (value / size, letter)
    return "%g" % value


def label(axis, value):
    return "%d²" % round(math.sqrt(value)) if axis == "pixels" else short(value)


def svg(series):
    x, ours, peer = series["x"], series["ours_ms"], series.get("peer_ms")
    low_x, high_x = min(x), max(max(x), 1.01 * min(x))
    # A proportional line (with threads: inversely proportional) from Lambent's last point (or its
    # first).
    guide = [ours[0] * x[0] / v for v in x] if series["axis"] == "threads" else [ours[-1] * v / x[-1] for v in x]
    every = ours + (peer or []) + (guide if series["axis"] == "threads" else [])
    low_y, high_y = 10 ** math.floor(math.log10(min(every))), 10 ** math.ceil(math.log10(max(every)))

    def across(value):
        return LEFT + (WIDTH - LEFT - RIGHT) * math.log(value / low_x) / math.log(high_x / low_x)

    def up(value):
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * math.log(value / low_y) / math.log(high_y / low_y)

    def text(left, top, words, anchor="middle", color=TEXT, more=""):
        return '<text x="%.1f" y="%.1f" text-anchor="%s" fill="%s"%s>%s</text>' % (left, top, anchor, color, more, words)

    def path(values, color, more=""):
        points = " ".join("%.1f,%.1f" % (across(a), up(b)) for a, b in zip(x, values))
        dots = "".join('<circle cx="%.1f" cy="%.1f" r="3.5" fill="%s"/>' % (across(a), up(b), color) for a, b in zip(x, values))
        return '<polyline points="%s" fill="none" stroke="%s" stroke-width="2"%s/>%s' % (points, color, more, dots)

    parts = ['<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d" font-family="DejaVu Sans, sans-serif" '
             'font-size="13">' % (WIDTH, HEIGHT, WIDTH, HEIGHT), '<rect width="100%" height="100%" fill="white"/>']
    value = low_y
    while value <= high_y * 1.001:
        parts.append('<line x1="%d" x2="%d" y1="%.1f" y2="%.1f" stroke="#dddddd"/>' % (LEFT, WIDTH - RIGHT, up(value), up(value)))
        parts.append(text(LEFT - 8, up(value) + 4, "%g" % value, "end"))
        value *= 10
    for value in x:
        parts.append('<line x1="%.1f" x2="%.1f" y1="%d" y2="%d" stroke="#eeeeee"/>' % (across(value), across(value), TOP, HEIGHT - BOTTOM))
        parts.append(text(across(value), HEIGHT - BOTTOM + 18, label(series["axis"], value)))
    parts.append('<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="%s"/>' % (LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM,
                                                                                        GUIDE))
    parts.append('<clipPath id="frame"><rect x="%d" y="%d" width="%d" height="%d"/></clipPath>' % (
        LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM))
    parts.append('<polyline points="%s" fill="none" stroke="%s" stroke-dasharray="5 4" clip-path="url(#frame)"/>' % (
        " ".join("%.1f,%.1f" % (across(a), up(b)) for a, b in zip(x, guide)), GUIDE))
    parts.append(path(ours, OURS))
    if peer:
        parts.append(path(peer, PEER))
    parts.append(text(LEFT + 12, TOP + 20, "Lambent", "start", OURS))
    parts.append(text(LEFT + 90, TOP + 20, "OpenGL on llvmpipe", "start", PEER) if peer else "")
    parts.append(text(WIDTH - RIGHT - 12, HEIGHT - BOTTOM - 12, "dashed: in proportion" if series["axis"] != "threads" else
                      "dashed: half the time with twice the threads", "end", "#777777"))
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 14, UNITS[series["axis"]]))
    parts.append(text(18, (TOP + HEIGHT - BOTTOM) / 2, "ms a frame", more=' transform="rotate(-90 18 %.0f)"' % ((TOP + HEIGHT - BOTTOM) / 2)))
    return "\n".join(part for part in parts if part) + "\n</svg>\n"
