# test_diff.py: the command `diff`: numbers with known answers, the picture, exit codes.
import base64
import json
import os
import re
import shutil
import struct
import zlib

from harness import Case, chunk, covered, pixel, read_png


def ppm(width, height, pixels):
    return b"P6\n%d %d\n255\n" % (width, height) + bytes(pixels)


def pfm(width, height, rows):
    """`rows` are in order from the bottom up, as in the format."""
    return b"PF\n%d %d\n-1.0\n" % (width, height) + struct.pack("<%df" % len(rows), *rows)


class Diff(Case):
    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        return name

    def pair(self):
        """Two pixels: one differs by 10 and 1 in red and green, one by 2 in blue."""
        return (self.write("a.ppm", ppm(2, 1, [100, 50, 0, 7, 8, 9])),
                self.write("b.ppm", ppm(2, 1, [110, 49, 0, 7, 8, 11])))

    def numbers(self, *words, code=0):
        done = self.run_program("diff", *words, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)

    def test_numbers(self):
        a, b = self.pair()
        found = self.numbers(a, b, code=6)
        self.assertEqual((found["a"], found["b"], found["width"], found["height"]), (a, b, 2, 1))
        self.assertAlmostEqual(found["maximum"], 10 / 255, 15)
        self.assertAlmostEqual(found["mean"], 13 / 8 / 255, 15)
        self.assertAlmostEqual(found["rmse"], (105 / 8) ** 0.5 / 255, 15)
        self.assertAlmostEqual(found["psnr_db"], 36.949810, 5)  # 10 log10(255² · 8/105)
        self.assertEqual((found["share_over_1"], found["share_over_2"]), (1, 0.5))
        self.assertEqual((found["differ"], found["tolerance"], found["picture"]), (1, 0, None))
        text = self.run_program("diff", a, b).stdout.decode()
        for part in ("0.03921569 (10/255)", "36.95 dB", "100 % of 2x1 pixels", "50 %", "different"):
            self.assertIn(part, text)

    def test_missing_alpha(self):
        """PFM has no alpha: only its colours are compared with those of a picture that has."""
        words = ("cube.obj", "-s", 24, "--samples", 4, "-q", "-o")
        for name in ("a.pfm", "a.exr"):
            done = self.run_program(*words, name)
            if b"OpenEXR" in done.stderr:
                self.skipTest("OpenEXR is not there")
        for pair in (("a.pfm", "a.exr"), ("a.exr", "a.pfm")):
            self.assertEqual(self.numbers(*pair)["maximum"], 0)
        self.good("cube.obj", "-s", 24, "--samples", 4, "-q", "-b", "black", "-o", "b.exr")
        self.assertEqual(self.numbers("a.exr", "b.exr", code=6)["maximum"], 1)  # both have alpha
        self.assertEqual(self.numbers("a.pfm", "b.exr")["maximum"], 0)

    def test_tolerance_and_equal(self):
        a, b = self.pair()
        self.assertEqual(self.numbers(a, b, "--tolerance", 10)["differ"], 0)
        self.assertEqual(self.numbers(a, b, "--tolerance", 9.9, code=6)["differ"], 1)
        same = self.numbers(a, a)
        self.assertEqual((same["maximum"], same["psnr_db"], same["differ"]), (0, None, 0))
        self.assertIn("infinite", self.good("diff", a, a).stdout.decode())
        self.assertEqual(self.good("diff", a, a, "-q").stdout, b"")

    def test_interlaced(self):
        """A PNG with seven passes is the same picture, at every size, with 8 and 16 bits."""
        passes = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))
        for width, height in ((1, 1), (2, 3), (7, 9), (33, 40)):
            for depth in (1, 2):  # bytes per number
                pixel_at = lambda x, y: bytes((x * 31 + y * 17 + c * 50 + (x * y) % 7) & 255 for c in range(3 * depth))
                rows = [b"\0" + b"".join(pixel_at(x, y) for x in range(x0, width, dx))
                        for x0, y0, dx, dy in passes for y in range(y0, height, dy) if x0 < width]
                plain = [b"\0" + b"".join(pixel_at(x, y) for x in range(width)) for y in range(height)]
                for name, interlace, packed in (("i.png", 1, rows), ("p.png", 0, plain)):
                    self.write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8 * depth, 2, 0, 0, interlace)) +
                               chunk(b"IDAT", zlib.compress(b"".join(packed))) + chunk(b"IEND", b""))
                self.assertEqual(self.numbers("i.png", "p.png")["maximum"], 0)
                self.assertNotEqual(self.run_program("diff", "i.png", self.write("z.ppm", ppm(width, height, bytes(3 * width * height)))).returncode, 0)

    def test_picture(self):
        a, b = self.pair()
        self.assertEqual(self.run_program("diff", a, b, "-o", "d.png", "--gain", 20).returncode, 6)
        found = read_png((self.folder / "d.png").read_bytes())
        self.assertEqual((pixel(found, 0, 0), pixel(found, 1, 0)), ((200, 20, 0, 255), (0, 0, 40, 255)))
        done = self.run_program("diff", a, b, "-o", "-", "--gain", 100, "--json")
        self.assertEqual(pixel(read_png(done.stdout), 0, 0), (255, 100, 0, 255))
        self.assertEqual(json.loads(done.stderr)["differ"], 1)

    def test_alpha_shows_grey(self):
        self.good("cube.obj", "-s", 8, "-o", "clear.png", "-q")
        self.good("cube.obj", "-s", 8, "-o", "black.png", "-b", "0/0/0/1", "-q")
        self.assertEqual(self.run_program("diff", "clear.png", "black.png", "-o", "d.png").returncode, 6)
        self.assertEqual(pixel(read_png((self.folder / "d.png").read_bytes()), 0, 0), (255, 255, 255, 255))

    def test_floats(self):
        a = self.write("a.pfm", pfm(1, 2, [0, 0, 0, 1, 2, 3]))
        b = self.write("b.pfm", pfm(1, 2, [0, 0, 0.5, 1, 2, 5]))
        self.assertEqual(self.numbers(a, b, "--tolerance", 510)["maximum"], 2)
        self.assertEqual(self.run_program("diff", a, b, "-o", "d.pfm", "--gain", 4).returncode, 6)
        data = (self.folder / "d.pfm").read_bytes()[-24:]
        self.assertEqual(struct.unpack("<6f", data), (0, 0, 2, 0, 0, 8))
        self.assertEqual(self.run_program("diff", a, b, "-o", "d.png", "--gain", 0.5).returncode, 6)
        found = read_png((self.folder / "d.png").read_bytes())
        self.assertEqual((pixel(found, 0, 0), pixel(found, 0, 1)), ((0, 0, 255, 255), (0, 0, 64, 255)))

    def test_errors(self):
        a, b = self.pair()
        c = self.write("c.ppm", ppm(1, 2, [0] * 6))
        f = self.write("f.pfm", pfm(2, 1, [0] * 6))
        self.bad(1, "diff", a, c, says=("a.ppm has 2x1 pixels", "c.ppm 1x2"))
        self.bad(1, "diff", a, f, says=("a.ppm contains bytes", "f.pfm contains floats"))
        self.bad(2, "diff", a, "missing.png", says="missing.png")
        self.bad(2, "diff", a, "cube.obj", says="cube.obj")
        self.bad(1, "diff", a, says="missing")
        self.bad(1, "diff", a, b, c, says="c.ppm")
        self.bad(1, "diff", a, b, "--samples", 4, says="does not apply")
        self.bad(1, "cube.obj", "--tolerance", 4, says="does not apply")
        self.bad(1, "diff", a, b, "--tolerance", -1, says="--tolerance")
        self.bad(1, "diff", a, b, "-o", "d.pfm", says="bytes")
        self.bad(3, "diff", a, b, "-o", "d.tif", says="d.tif")
        self.bad(5, "diff", a, b, "-o", "nowhere/d.png", says="nowhere")
        done = self.run_program("diff", a, c, "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["error"]["exit"]), (1, 1))


class Models(Case):
    """Models, and folders of models: old on the left, new on the right, with one camera."""

    def setUp(self):
        super().setUp()
        for side in ("old", "new"):
            (self.folder / side / "sub").mkdir(parents=True)
            shutil.copy(self.folder / "cube.obj", self.folder / side / "sub")
            shutil.copy(self.folder / "cube.mtl", self.folder / side / "sub")
            self.box(f"{side}/part.obj", 1)
        self.given.update(("old", "new"))

    def box(self, name, width, colour=""):
        """A box around the origin, 2 high and deep."""
        corners = [(x * width, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        faces = ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6")
        (self.folder / name).write_text("".join("v %g %g %g\n" % c for c in corners) + "".join(f"f {f}\n" for f in faces))

    def diff(self, *words, code):
        done = self.run_program("diff", *words, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)

    def pictures(self, page="report.html"):
        """The pictures of the page in order, with their captions."""
        text = (self.folder / page).read_text()
        self.assertNotIn("<script", text)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)', text), [])
        return [(caption, read_png(base64.b64decode(data))) for data, caption in
                re.findall(r'src="data:image/png;base64,([^"]+)"><figcaption>([^<]+)', text)]

    def test_equal(self):
        found = self.diff("old", "new", "-o", "report.html", code=0)
        self.assertEqual([found[key] for key in ("equal", "changed", "added", "removed", "failed")], [2, 0, 0, 0, 0])
        self.assertEqual(self.pictures(), [])
        self.assertEqual(self.diff("old/part.obj", "new/part.obj", code=0)["equal"], 1)
        self.assertEqual(self.good("diff", "old", "new", "-q").stdout, b"")

    def test_each_kind(self):
        self.box("new/part.obj", 2)
        shutil.copy(self.folder / "cube.stl", self.folder / "new" / "more.stl")
        shutil.copy(self.folder / "cube.ply", self.folder / "old" / "gone.ply")
        (self.folder / "new" / "bad.obj").write_text("nonsense")
        (self.folder / "old" / "bad.obj").write_text("nonsense")
        self.box("new/half.obj", 1)
        (self.folder / "old" / "half.obj").write_text("nonsense")
        for more in ([], ["--isolate"], ["-j", 1]):
            found = self.diff("old", "new", "-o", "report.html", *more, code=7)
            self.assertEqual({row["name"]: row["change"] for row in found["models"]},
                             {"bad.obj": "failed", "gone.ply": "removed", "half.obj": "failed", "more.stl": "added", "part.obj": "changed", "sub/cube.obj": "equal"})
            rows = {row["name"]: row for row in found["models"]}
            self.assertIn("new/bad.obj", rows["bad.obj"]["error"])
            self.assertIn("old/half.obj", rows["half.obj"]["error"])
            self.assertEqual((rows["part.obj"]["counts_before"], rows["more.stl"]["counts_after"]), ("12 triangles", "12 triangles"))
            self.assertEqual([caption for caption, _ in self.pictures()], ["before", "after", "difference", "after", "before"])
        self.assertEqual(self.diff("old", "new", "--failures-ok", code=6)["failed"], 2)
        text = self.run_program("diff", "old", "new").stdout.decode()
        for line in ("changed  part.obj", "removed  gone.ply", "added    more.stl", "failed   bad.obj", "1 changed, 2 failed, 1 added, 1 removed, 1 equal"):
            self.assertIn(line, text)

    def test_one_camera(self):
        """A box that becomes twice as wide: in front view, both have the same height, the new one is twice as wide, and both are within the
        picture."""
        self.box("new/part.obj", 2)
        found = self.diff("old", "new", "-o", "report.html", "--view", "front", "--projection", "orthographic", "--rig", "headlight", "-s", 200, code=6)
        self.assertEqual(found["changed"], 1)
        (_, before), (_, after), (_, where) = self.pictures()
        boxes = [covered(p) for p in (before, after)]
        (l0, t0, r0, b0), (l1, t1, r1, b1) = boxes
        self.assertEqual((t0, b0), (t1, b1))
        self.assertAlmostEqual((r1 - l1) / (r0 - l0), 2, delta=0.05)
        self.assertTrue(l1 > 0 and r1 < 200)
        self.assertEqual(pixel(where, 100, 100), (0, 0, 0, 255))
        self.assertNotEqual(pixel(where, l1 + 2, 100), (0, 0, 0, 255))
        over = lambda a, b: any(abs(m - n) > 1 for m, n in zip(a, b))
        share = sum(over(pixel(before, x, y), pixel(after, x, y)) for x in range(200) for y in range(200)) / 200**2
        self.assertAlmostEqual(found["models"][0]["share_over_1"], share, 9)

    def test_turned(self):
        """Both models rotate about one axis, so an unchanged part does not move."""
        self.box("new/part.obj", 1)
        with open(self.folder / "new" / "part.obj", "a") as file:  # a second box beside the first
            file.write("".join("v %g %g %g\n" % (x + 5, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)))
            file.write("".join(f"f {f}\n" for f in ("9 11 12 10", "13 14 16 15", "9 10 14 13", "11 15 16 12", "9 13 15 11", "10 12 16 14")))
        self.diff("old", "new", "-o", "report.html", "--view", "front", "--rotate", "x:30", "--rig", "headlight", "-s", 200, code=6)
        (_, before), (_, after), (_, where) = self.pictures()
        left, top, right, bottom = covered(before)
        x, y = (left + right) // 2, (top + bottom) // 2
        self.assertEqual(pixel(where, x, y), (0, 0, 0, 255))
        self.assertEqual(covered(after)[0], left)

    def test_own_camera_and_shapes(self):
        self.diff("teapot", "sphere", "--camera", "eye=0/0/9", "-s", 64, "-o", "a.html", code=6)
        (_, before), _, _ = self.pictures("a.html")
        self.assertEqual(before, self.png("teapot", "--camera", "eye=0/0/9", "-s", 64))
        self.assertEqual(self.diff("teapot", "teapot", "--exposure", "auto", "-s", 64, code=0)["equal"], 1)

    def test_page(self):
        """Names are text, not markup; the page is written to standard output; a title replaces the folders' names."""
        self.box("new/a<b>&\"c.obj", 1)
        page = self.run_program("diff", "old", "new", "-o", "-", "--title", "x<y", "-s", 32).stdout.decode()
        self.assertIn("a&lt;b&gt;&amp;", page)
        self.assertIn("<h1>x&lt;y</h1>", page)
        self.assertTrue(page.endswith("</html>\n"))

    def test_errors(self):
        os.mkdir(self.folder / "empty")
        os.mkdir(self.folder / "empty2")
        self.given.update(("empty", "empty2", "a.png"))
        self.good("cube.obj", "-s", 8, "-o", "a.png", "-q")
        self.assertEqual(self.diff("empty", "new", "-s", 32, code=6)["added"], 2)
        self.bad(2, "diff", "empty", "empty2", says="no model")
        self.bad(1, "diff", "old", "new/part.obj", says=("old is a folder", "two folders"))
        for words in (("old", "none"), ("none", "old")):
            self.bad(2, "diff", *words, says="none: cannot open: No such file or directory; the other side, old, is a folder")
        self.bad(1, "diff", "old", "teapot", says=("old is a folder and teapot is not", "two folders"))
        self.bad(3, "diff", "old", "new", "-o", "x.png", says=".html")
        self.bad(5, "diff", "old", "new", "-o", "no/where/x.html", says="no/where")
        self.bad(1, "diff", "a.png", "a.png", "--samples", 4, says="does not apply to pictures")
        self.bad(1, "diff", "old", "new", "--resume", says="does not apply")
        self.bad(1, "diff", "old", "new", "--files-from", "x", says="--files-from")
        (self.folder / "new" / "part.obj").write_text("nonsense")
        self.bad(2, "diff", "old/part.obj", "new/part.obj", says="new/part.obj")
