# test_diff.py: the command `diff`: numbers with known answers, the picture, exit codes.
import json
import struct
import zlib

from harness import Case, pixel, read_png


def ppm(width, height, pixels):
    return b"P6\n%d %d\n255\n" % (width, height) + bytes(pixels)


def pfm(width, height, rows):
    """`rows` from the bottom up, as in the format."""
    return b"PF\n%d %d\n-1.0\n" % (width, height) + struct.pack("<%df" % len(rows), *rows)


class Diff(Case):
    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        self.given.add(name)
        return name

    def pair(self):
        """Two pixels: one off by 10 and 1 in red and green, one by 2 in blue."""
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

    def test_tolerance_and_equal(self):
        a, b = self.pair()
        self.assertEqual(self.numbers(a, b, "--tolerance", 10)["differ"], 0)
        self.assertEqual(self.numbers(a, b, "--tolerance", 9.9, code=6)["differ"], 1)
        same = self.numbers(a, a)
        self.assertEqual((same["maximum"], same["psnr_db"], same["differ"]), (0, None, 0))
        self.assertIn("infinite", self.good("diff", a, a).stdout.decode())
        self.assertEqual(self.good("diff", a, a, "-q").stdout, b"")

    def test_interlaced(self):
        """A PNG in seven passes is the same picture, at every size, with 8 and 16 bits."""
        passes = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))
        for width, height in ((1, 1), (2, 3), (7, 9), (33, 40)):
            for depth in (1, 2):  # bytes a number
                pixel_at = lambda x, y: bytes((x * 31 + y * 17 + c * 50 + (x * y) % 7) & 255 for c in range(3 * depth))
                rows = [b"\0" + b"".join(pixel_at(x, y) for x in range(x0, width, dx))
                        for x0, y0, dx, dy in passes for y in range(y0, height, dy) if x0 < width]
                plain = [b"\0" + b"".join(pixel_at(x, y) for x in range(width)) for y in range(height)]
                for name, interlace, packed in (("i.png", 1, rows), ("p.png", 0, plain)):
                    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
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
        self.bad(1, "diff", a, f, says=("a.ppm holds bytes", "f.pfm floats"))
        self.bad(2, "diff", a, "missing.png", says="missing.png")
        self.bad(2, "diff", a, "cube.obj", says="cube.obj")
        self.bad(1, "diff", a, says="missing")
        self.bad(1, "diff", a, b, c, says="c.ppm")
        self.bad(1, "diff", a, b, "--samples", 4, says="does not apply")
        self.bad(1, "cube.obj", "--tolerance", 4, says="does not apply")
        self.bad(1, "diff", a, b, "--tolerance", -1, says="--tolerance")
        self.bad(1, "diff", a, b, "-o", "d.pfm", says="bytes")
        self.bad(3, "diff", a, b, "-o", "d.gif", says="d.gif")
        self.bad(5, "diff", a, b, "-o", "nowhere/d.png", says="nowhere")
        done = self.run_program("diff", a, c, "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["error"]["exit"]), (1, 1))
