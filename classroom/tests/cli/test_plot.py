# test_plot.py: the command `plot`: its numbers compared with the formulas, its pictures as PNG and
# SVG.
import json
import math
import xml.etree.ElementTree as xml

from harness import Case, pixel, read_png

SVG = "{http://www.w3.org/2000/svg}"


class Plot(Case):
    def numbers(self, *words):
        return json.loads(self.good("plot", *words, "-o", "p.png", "--json", "-s", "320x200").stdout)

    def test_attenuation(self):
        found = self.numbers("attenuation", "1/0.54/0.2", "1/0/1", "1/0/0", "1/0/0/20", "0/0/1")
        self.assertEqual((found["plot"], found["picture"], len(found["curves"])), ("attenuation", "p.png", 5))
        below = [curve["below_1_255_from"] for curve in found["curves"]]
        self.assertAlmostEqual(below[0], (-0.54 + math.sqrt(0.54 ** 2 + 4 * 0.2 * 254)) / 0.4, 4)
        self.assertAlmostEqual(below[1], math.sqrt(254), 4)
        self.assertIsNone(below[2])
        self.assertAlmostEqual(below[3], 20 * (1 - 1 / 255) ** 0.25, 3)
        self.assertAlmostEqual(below[4], math.sqrt(255), 4)
        for d, value in found["curves"][0]["points"]:
            self.assertAlmostEqual(value, 1 / (1 + 0.54 * d + 0.2 * d * d), 6)
        self.assertEqual(len(found["curves"][0]["points"]), 101)
        text = self.good("plot", "attenuation", "1/0/1", "1/0/0", "-o", "p.png").stdout.decode()
        self.assertRegex(text, r"1/0/1 +below 1/255 from 15\.937\n.*1/0/0 +never below")

    def test_axis(self):
        """Curves fill the axis: the last one falls to a twentieth at its end."""
        for words in ([], ["1/0/1"], ["1/0.1/0", "1/0/1"], ["1/0/0/20", "1/0/1"]):
            curves = self.numbers("attenuation", *words)["curves"]
            self.assertAlmostEqual(max(c["points"][-1][1] for c in curves if c["below_1_255_from"]), 1 / 20, 3)

    def test_attenuation_of_lights(self):
        """Lights in the form of --light, and lights of a scene file, give the curves of their numbers."""
        scene = {"lambent": 1, "objects": [{"shape": "cube"}], "lights": [
            {"type": "point", "name": "key", "attenuation": [1, 0.02, 0.01]}, {"type": "directional"},
            {"type": "spot", "attenuation": [0, 0, 2], "range": 3}]}
        (self.folder / "lights.json").write_text(json.dumps(scene))
        (self.folder / "dark.json").write_text(json.dumps({**scene, "lights": []}))
        found = self.numbers("attenuation", "1/0/1", "point:attenuation=1/0/1,name=lamp", "spot:attenuation=1/0.5/0.25,range=9", "lights.json")
        curves = found["curves"]
        self.assertEqual([c["label"] for c in curves], ["a/b/c = 1/0/1", "lamp: a/b/c = 1/0/1", "a/b/c = 1/0.5/0.25, range 9",
                                                        "key: a/b/c = 1/0.02/0.01", "light 3: a/b/c = 0/0/2, range 3"])
        self.assertEqual(curves[0]["points"], curves[1]["points"])
        self.assertEqual(curves[0]["below_1_255_from"], curves[1]["below_1_255_from"])
        self.assertAlmostEqual(curves[3]["below_1_255_from"], (-0.02 + math.sqrt(0.0004 + 0.04 * 254)) / 0.02, 3)
        for d, value in curves[2]["points"]:
            self.assertAlmostEqual(value, max(1 - (d / 9) ** 4, 0) / (1 + 0.5 * d + 0.25 * d * d), 6)
        for word, says in (("point:attenuation=1/2r/3", "without r"), ("directional", "point or spot"), ("point:atenuation=1", "attenuation"),
                           ("dark.json", "no point or spot light"), ("missing.obj", "file with lights"), ("none", "a/b/c")):
            self.bad(1, "plot", "attenuation", word, says=says, leaves={"p.png"})

    def test_spot(self):
        found = self.numbers("spot", "cutoff=30,exponent=8", "inner=20,outer=35")
        for angle, value in found["curves"][0]["points"]:
            self.assertAlmostEqual(value, math.cos(math.radians(angle)) ** 8 if angle < 30.01 else 0, 5)
        inner, outer = math.cos(math.radians(20)), math.cos(math.radians(35))
        for angle, value in found["curves"][1]["points"]:
            part = min(max((math.cos(math.radians(angle)) - outer) / (inner - outer), 0), 1)
            self.assertAlmostEqual(value, part * part, 4)

    def test_highlight(self):
        found = self.numbers("highlight", "50")
        self.assertEqual([c["label"] for c in found["curves"]],
                         ["Phong, shininess 50", "Blinn–Phong, shininess 50", "Blinn–Phong, shininess 200"])
        for curve, power, share in zip(found["curves"], (50, 50, 200), (1, 0.5, 0.5)):
            for angle, value in curve["points"]:
                self.assertAlmostEqual(value, max(math.cos(math.radians(angle) * share), 0) ** power, 4)

    def test_png(self):
        self.good("plot", "attenuation", "1/0/0.5")
        picture = read_png((self.folder / "attenuation.png").read_bytes())
        self.assertEqual(picture[:2], (1600, 1000))
        self.assertEqual(pixel(picture, 0, 0), (255, 255, 255, 255))
        colors = {pixel(picture, x, y) for x in range(100, 1500, 3) for y in range(100, 900, 3)}
        self.assertIn((0, 0x72, 0xb2, 255), colors)
        # A file that lambent did not write is not replaced.
        (self.folder / "spot.png").write_bytes(b"mine")
        self.bad(5, "plot", "spot", says="spot.png")
        self.assertEqual((self.folder / "spot.png").read_bytes(), b"mine")
        small = read_png(self.good("plot", "spot", "-s", "64x40", "-o", "-").stdout)
        self.assertEqual(small[:2], (64, 40))

    def test_svg(self):
        self.good("plot", "attenuation", "1/0.54/0.2", "1/0/1", "1/0/0", "-o", "p.svg", "-s", "900x500")
        root = xml.parse(self.folder / "p.svg").getroot()
        self.assertEqual((root.tag, root.get("width"), root.get("height")), (SVG + "svg", "900", "500"))
        words = [text.text for text in root.iter(SVG + "text")]
        # The legend lists points beyond the axis.
        for word in ("a/b/c = 1/0.54/0.2 (below 1/255 from 34.31)", "a/b/c = 1/0/1 (below 1/255 from 15.94)", "distance d", "0.2", "1/255"):
            self.assertIn(word, words)
        curves = [line for line in root.iter(SVG + "polyline") if line.get("stroke") == "#d55e00"]
        self.assertTrue(any(len(line.get("points").split()) > 100 for line in curves))
        self.good("plot", "attenuation", "1/0.54/0.2", "1/0/1", "1/0/0", "-o", "p.svg", "--to", "40")
        root = xml.parse(self.folder / "p.svg").getroot()
        words = [text.text for text in root.iter(SVG + "text")]
        self.assertEqual((len(list(root.iter(SVG + "circle"))), "34.31" in words, "15.94" in words, "a/b/c = 1/0/1" in words), (2, True, True, True))
        self.good("plot", "attenuation", "-o", "q.svg", "--no-captions")
        self.assertEqual(list(xml.parse(self.folder / "q.svg").getroot().iter(SVG + "text")), [])

    def test_fonts(self):
        self.good("plot", "spot", "-o", "p.png", "--no-captions", "--font", "/nowhere.ttf")
        self.good("plot", "spot", "-o", "p.svg", "--font", "/nowhere.ttf")
        self.bad(2, "plot", "spot", "-o", "f.png", "--font", "/nowhere.ttf", says="/nowhere.ttf")
        self.bad(2, "plot", "spot", "-o", "f.png", env={"LAMBENT_FONT": "/else.ttf"}, says="/else.ttf")
        self.bad(2, "plot", "spot", "-o", "f.png", "--font", "cube.obj", says="cube.obj")

    def test_errors(self):
        self.bad(1, "plot", says="missing")
        self.bad(1, "plot", "spott", says="did you mean 'spot'?")
        self.bad(1, "plot", "spot", "cutoff=100", says="up to 90, or 180")
        self.bad(1, "plot", "spot", "inner=30,outer=20", says="less than outer, which is 20")
        for word in ("1", "1/2", "1/2/3/4/5", "1/2/x", "a", "0/0/0", "-1/0/1", "1//2"):
            self.bad(1, "plot", "attenuation", "--", word, says="plot attenuation")
        for word in ("30", "cutoff=30,inner=3", "cutoff", "cutoff=120", "inner=30,outer=20", "inner=20", "cutoff=1,cutoff=2",
                     "exponent=-1", "wide=3"):
            self.bad(1, "plot", "spot", word, says="plot spot")
        for word in ("-5", "x", "1/2"):
            self.bad(1, "plot", "highlight", "--", word, says="plot highlight")
        self.bad(4, "plot", "attenuation", *["1/0/1"] * 33, says="32")
        self.bad(3, "plot", "spot", "-o", "p.pfm", says="p.pfm")
        self.bad(5, "plot", "spot", "-o", "nowhere/p.svg", says="nowhere")
        self.bad(1, "plot", "spot", "--samples", "4", says="does not apply")
