# test_figure.py: the figure of `explain -o`: the picture, its arrows and its numbers.
import base64
import json
import math
import re
import unittest
import xml.etree.ElementTree as xml

from harness import Case, pixel, read_png

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


SVG = "{http://www.w3.org/2000/svg}"


def embedded(svg):
    """The pictures in an SVG: their titles, corners and PNG bytes."""
    return [(i.find(SVG + "title").text, float(i.get("x")), float(i.get("y")), base64.b64decode(i.get("href").split("base64,")[1], validate=True))
            for i in svg.iter(SVG + "image")]


class Figure(Case):
    def figure(self, *words):
        """The SVG of explain -o, and the numbers of explain --json, which stay on standard output."""
        done = self.good("explain", *words, "--json", "-o", "f.svg")
        return xml.fromstring((self.folder / "f.svg").read_bytes()), json.loads(done.stdout)

    def test_picture_and_words(self):
        words = ("torus", "150,120", "-s", "320x240")
        svg, answer = self.figure(*words, "--title", "点 نقطة <&>")
        (title, x, y, png), = embedded(svg)
        self.assertTrue(png == self.good("torus", "-s", "320x240", "-o", "-").stdout)
        self.assertEqual((svg[0].tag, svg[0].text, title), (SVG + "title", "点 نقطة <&>", "点 نقطة <&>"))
        self.assertEqual(svg[1].tag, SVG + "desc")
        n, sum_of = answer["triangles"][0]["points"][0]["n"], answer["bytes"]
        self.assertIn("normal n is (%.3g, %.3g, %.3g)" % tuple(n), svg[1].text)
        self.assertIn("the pixel is %d %d %d with alpha %d" % tuple(sum_of), svg[1].text)
        texts = [t.text for t in svg.iter(SVG + "text")]
        self.assertEqual([texts.count(name) for name in "nlvrh"], [3] * 5)  # in the picture, from the side, in the table
        place = answer["triangles"][0]["places"][3]
        for space in ("object", "eye", "clip", "ndc", "window"):
            row = texts.index("NDC" if space == "ndc" else space)
            self.assertEqual(texts[row + 1:row + 1 + len(place[space])], ["%.6g" % x for x in place[space]], space)
        self.assertIn("counter-clockwise, the front; 2 · area = %.5g pixels" % answer["triangles"][0]["winding"], texts)

    def redo(self, texts):
        """Computes the numbers of a figure from its printed text alone, up to the bytes."""
        model, texts = texts[0], texts[texts.index("Vectors in eye space"):]

        def row(name, count=3):
            at = texts.index(name) + 1
            return [float(x) for x in texts[at:at + count]]

        def close(found, wanted, what, within=3e-5):
            for a, b in zip(found, wanted):
                self.assertLessEqual(abs(a - b), within * max(abs(a), abs(b)) + 2e-6, (what, found, wanted, texts))

        parts = [part.split(" = ") for text in texts for part in re.split(r", (?=[^() ]+(?:\([^)]*\))? = )", text)]
        line = {part[0]: float(part[-1].strip("°")) for part in parts if len(part) > 1}
        n, l, v = row("n"), row("l"), row("v")
        if "t" in texts:
            t = row("t")
            line["cos(t, l)"], line["cos(t, v)"] = dot(t, l), dot(t, v)
            sine = [math.sqrt(max(0, 1 - line["cos(t, %s)" % k] ** 2)) for k in "lv"]
            gate = dot(n, l) > 0
            close([line["D"], line["base"]], [gate * sine[0], max(sine[0] * sine[1] - line["cos(t, l)"] * line["cos(t, v)"], 0)], "threads")
        else:
            close(row("r"), [2 * dot(n, l) * a - b for a, b in zip(n, l)], "r")
            half = [a + b for a, b in zip(l, v)]
            close(row("h"), [x / math.hypot(*half) for x in half], "h")
            for name, a, b in (("θ(n, l)", n, l), ("φ(r, v)", row("r"), v), ("ψ(n, h)", n, row("h"))):
                self.assertAlmostEqual(line[name], math.degrees(math.acos(min(1, dot(a, b)))), delta=0.02)
            close([line["n·l"], line["D"]], [dot(n, l), max(dot(n, l), 0)], "D")
            close([line["base"]], [max(dot(row("r"), v) if "Phong shading, phong" in model else dot(n, row("h")), 0)], "base")
        close([line["S"]], [line["base"] ** line["α"] * (dot(n, l) > 0)], "S", 6e-6 * line["α"] + 1e-5)
        arriving = line["attenuation"] * line["spot"] * line.get("occlusion", 1)
        passed = row("passed") if "passed" in texts else (1, 1, 1)
        tint = row("surface colour") if "surface colour" in texts else (1, 1, 1)
        close(row("diffuse"), [k * p * c * line["D"] * arriving for k, p, c in zip(row("kd Ld"), passed, tint)], "diffuse")
        close(row("specular"), [k * p * line["S"] * arriving for k, p in zip(row("ks Ls"), passed)], "specular")
        terms = [row(name) for name in ("emission", "ambient", "diffuse", "specular", "other lights", "reflection") if name in texts]
        close(row("sum"), [sum(c) for c in zip(*terms)], "sum")
        # from the sum to the bytes, by the printed formulas
        color = row("interpolated") if "interpolated" in texts else row("sum")
        for text in texts[texts.index("From sum to bytes"):]:
            if share := re.fullmatch(r"([\d.e-]+) · colour", text):
                close(row(text), [float(share[1]) * x for x in color], text)
                color = [a + b for a, b in zip(row(text), row("+ others"))]
            elif factor := re.fullmatch(r"([·÷]) ([\d.e-]+)", text):
                color = [x * float(factor[2]) if factor[1] == "·" else x / float(factor[2]) for x in color]
                close(row(text), color, text)
        for name in (text for text in texts if re.match("toned: |over it|encoded: ", text)):
            formula = texts[texts.index(name) + 4].replace("²", "^2").replace("^", "**").replace("·", "*").replace("−", "-").replace("≤", "<=")
            formula = re.sub(r"(.*) \? (.*) : (.*)", r"(\2) if (\1) else (\3)", formula)
            back = row("background") if "background" in texts else color
            color = [eval(formula, {"x": x, "min": min, "background": b}) for x, b in zip(color, back)]
            close(row(name), color, name, 2e-5)
        formula = texts[texts.index("bytes") + 5]
        self.assertEqual(formula, "floor(255 · x + ½)")
        for found, x in zip(row("bytes"), color):
            self.assertIn(found, (math.floor(255 * x + 0.498), math.floor(255 * x + 0.502)), (color, texts))

    def test_sums(self):
        """Everything from the vectors to the bytes can be computed from the printed text, for all shapes and kinds of light."""
        lights = (("--light", "spot:position=1/2/3,cutoff=60,exponent=2,attenuation=1/0.1/0.05", "--ambient", "0.1"), ("--reflection", "phong", "--tone", "reinhard"),
                  ("--reflection", "kajiya-kay"), ("--color-mode", "raw", "--background", "white", "--material", "opacity=0.5"), ("--exposure", "-1", "--shading", "gouraud"),
                  ("--material", "emission=0.1,diffuse=1/0.5/0.2", "--shadows", "--ground", "--light", "point:position=2r/3r/2r"), ("--samples", "16"))
        done = 0
        for shape in ("teapot", "torus", "sphere", "cube", "gyroid", "cone", "torus-knot"):
            for more in ((), *lights):
                svg, answer = self.figure(shape, "54,50", "-s", "96", *more)
                texts = ["".join(t.itertext()) for t in svg.iter(SVG + "text")]
                if "From sum to bytes" in texts and "no light adds anything here" not in texts[2]:
                    with self.subTest((shape, more)):
                        self.redo(texts[next(i for i, t in enumerate(texts) if " reflection" in t):])
                        done += 1
        self.assertGreater(done, 40)

    def test_arrows(self):
        """Without perspective, the arrows are the vectors' x and y, starting at the point's position in the picture."""
        colors = {"n": "#0072b2", "l": "#c98a00", "r": "#b0558a", "h": "#d55e00"}
        for words in (("torus", "80,130"), ("teapot", "140,150", "--shading", "gouraud"), ("cube", "160,150", "--shading", "flat", "--azimuth", "30")):
            svg, answer = self.figure(*words, "-s", "320x240", "--projection", "orthographic", "--elevation", "40", "--light", "directional:direction=1/-2/-1")
            triangle = answer["triangles"][0]
            (_, left, top, _), = embedded(svg)
            corner = max(range(len(triangle["points"])), key=lambda i: triangle["weights"][i]) if len(triangle["points"]) > 1 else 0
            point = triangle["points"][corner]
            place = triangle["places"][3 if point["corner"] in (None, -1, "fragment") else point["corner"]]
            lines = {}
            for line in svg.iter(SVG + "polyline"):
                ends = [tuple(map(float, p.split(","))) for p in line.get("points").split()]
                if len(ends) == 2 and ends[0][0] < left + 320 and ends[0][1] < top + 240:
                    lines[line.get("stroke")] = ends
            vectors = {"n": point["n"], **{name: point["lights"][0][name] for name in "lrh"}}
            longest = max(math.hypot(v[0], v[1]) for v in vectors.values())
            for name, vector in vectors.items():
                (x0, y0), (x1, y1) = lines[colors[name]]
                self.assertAlmostEqual(x0, left + place["window"][0], delta=0.02, msg=(words, name))
                self.assertAlmostEqual(y0, top + 240 - place["window"][1], delta=0.02, msg=(words, name))
                scale = math.hypot(x1 - x0, y1 - y0) / math.hypot(*vector[:2])
                self.assertAlmostEqual(x1 - x0, scale * vector[0], delta=0.05, msg=(words, name))
                self.assertAlmostEqual(y1 - y0, -scale * vector[1], delta=0.05, msg=(words, name))
                self.assertGreater(scale * longest, 20)

    def test_png(self):
        """The same as pixels: the picture is on white, with its arrows; the numbers are written to standard output unless the figure is written
        there."""
        words = ("explain", "torus", "150,120", "-s", "320x240")
        plain = self.good(*words).stdout
        self.assertEqual(self.good(*words, "-o", "f.png").stdout, plain)
        width, height, data = read_png((self.folder / "f.png").read_bytes())
        self.assertGreater((width, height), (320 + 300, 240))
        self.assertEqual(set(data[3::4]), {255})
        self.assertEqual(self.good(*words, "-o", "-").stdout, (self.folder / "f.png").read_bytes())
        white = read_png(self.good("torus", "-s", "320x240", "--background", "white", "-o", "-").stdout)
        same = sum(pixel((width, height, data), x + 18, y + 39) == pixel(white, x, y) for y in range(200, 240) for x in range(320))
        self.assertGreater(same, 0.97 * 40 * 320)
        colors = {pixel((width, height, data), x, y)[:3] for y in range(39, 279) for x in range(18, 338)}
        self.assertLessEqual({(0x00, 0x72, 0xb2), (0xc9, 0x8a, 0x00), (0xd5, 0x5e, 0x00)}, colors)

    def test_elsewhere(self):
        """Cases: the background alone, lines, a light without a direction."""
        svg, answer = self.figure("torus", "1,1", "-s", "96")
        self.assertEqual(answer["triangles"], [])
        self.assertIn("Only the background is visible here.", [t.text for t in svg.iter(SVG + "text")])
        svg, answer = self.figure("torus", "48,60", "-s", "96", "--rig", "none")
        self.assertIn("no light adds anything here", [t.text for t in svg.iter(SVG + "text")])
        (self.folder / "line.obj").write_text("v 0 0 0\nv 1 1 0\nl 1 2\n")
        self.figure("line.obj", "48,48", "-s", "96", "--line-width", "9")

    def test_refused(self):
        left = self.new_files()
        self.bad(3, "explain", "cube", "8,8", "-s", 16, "-o", "f.exr", says=("f.exr", ".svg, .png, .ppm, .jpg"), leaves=left)
        self.bad(3, "explain", "cube", "8,8", "-s", 16, "-o", "f.gltf", says="f.gltf", leaves=left)
        self.bad(3, "explain", "cube", "8,8", "-s", 16, "-o", "f.png", "--title", "点", says=("U+70B9", "--font", ".svg"), leaves=left)
        self.bad(3, "explain", "cube", "8,8", "-s", 16, "-o", "f.png", "--title", "נ", says=("U+05E0", ".svg"), leaves=left)
        self.bad(1, "explain", "cube", "8,8", "-s", 16, "-o", "f.svg", "--dry-run", says="--dry-run", leaves=left)
        self.bad(5, "explain", "cube", "8,8", "-s", 16, "-o", "cube.obj/f.svg", says="cube.obj", leaves=left)

    def test_figure_of_threads(self):
        """The figure of Kajiya-Kay shows the tangent, but not r and h, which it does not use."""
        words = ("explain", "torus-knot", "100,80", "-s", 200, "--light", "point:position=2/2/3")
        letters = {}
        for model in ("kajiya-kay", "phong"):
            self.good(*words, "--reflection", model, "-o", "f.svg")
            root = xml.parse(self.folder / "f.svg").getroot()
            texts = [text.text for text in root.iter("{http://www.w3.org/2000/svg}text")]
            letters[model] = {t for t in texts if t in ("n", "l", "v", "r", "h", "t")}
            self.assertEqual(any("cos(t, l)" in t for t in texts if t), model == "kajiya-kay")
        self.assertEqual(letters, {"kajiya-kay": set("nlvt"), "phong": set("nlvrh")})
        self.given |= {"f.svg"}


if __name__ == "__main__":
    unittest.main()
