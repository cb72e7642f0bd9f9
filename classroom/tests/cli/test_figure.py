# test_figure.py: the figure of `explain -o`: the picture, its arrows and its numbers.
import base64
import json
import math
import unittest
import xml.etree.ElementTree as xml

from harness import Case, pixel, read_png

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
            self.assertEqual(texts[row + 1:row + 1 + len(place[space])], ["%.5g" % x for x in place[space]], space)
        self.assertIn("counter-clockwise, the front; 2 · area = %.5g pixels" % answer["triangles"][0]["winding"], texts)
        terms = answer["triangles"][0]["points"][0]["terms"]
        for name in ("ambient", "diffuse", "specular"):
            row = texts.index(name)
            self.assertEqual(texts[row + 1:row + 4], ["%.5g" % x for x in terms[name]], name)

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
                if len(ends) == 2 and ends[0][0] < left + 320:
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
