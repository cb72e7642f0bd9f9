# test_contact_sheet.py: `lambent sheet`: the pictures of a folder's models, scale, pages, failures.
from harness import Case, pixel, read_png


class ContactSheets(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "models" / "deeper").mkdir(parents=True)
        for name, scale in (("models/a.obj", 1), ("models/deeper/b.obj", 4)):
            (self.folder / name).write_text("".join(f"v {x * scale} {y * scale} {z * scale}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) +
                                            "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")
        self.given = self.new_files() | self.given

    def ink(self, image, left, right, limit=300):
        """The number of columns that contain something else than the white page, in the rows of the pictures."""
        return sum(any(pixel(image, x, y)[0] < 250 for y in range(17, limit)) for x in range(left, right))

    def test_cells(self):
        self.good("models", "-o", "sheet.png", "--no-captions")
        sheet = read_png((self.folder / "sheet.png").read_bytes())
        self.assertEqual(sheet[:2], (3 * 17 + 2 * 256, 2 * 17 + 256))
        alone = self.good("models/a.obj", "-s", "256", "-b", "white", "-o", "alone.png") and read_png((self.folder / "alone.png").read_bytes())
        for y in range(0, 256, 5):
            for x in range(0, 256, 5):
                self.assertEqual(pixel(sheet, 17 + x, 17 + y)[:3], pixel(alone, x, y)[:3])
        self.good("sheet", "models", "-o", "scaled.png", "--to-scale", "--no-captions")
        scaled = read_png((self.folder / "scaled.png").read_bytes())
        big = self.ink(scaled, 17 + 256 + 17, 17 + 256 + 17 + 256, 270)
        self.assertEqual(big, self.ink(sheet, 290, 546, 270))
        self.assertAlmostEqual(self.ink(scaled, 17, 273, 270) / big, 1 / 4, delta=0.02)

    def test_threads_and_processes_give_the_same_bytes(self):
        words = ("sheet", "models", "teapot", "-s", "64x48", "-q", "-o")
        self.good(*words, "one.png", "--threads", 1)
        for name, more in (("all.png", ()), ("isolated.png", ("--isolate",)), ("open.png", ("--sandbox", "off"))):
            self.good(*words, name, *more)
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / "one.png").read_bytes(), name)

    def test_pages_and_formats(self):
        self.good("sheet", "models", "torus", "-s", "32", "--per-page", "2", "-o", "p.jpg")
        self.assertTrue(self.new_files() >= {"p-1.jpg", "p-2.jpg"})
        self.good("sheet", "models", "-s", "32", "--title", "Zwei & drei", "-o", "p.svg")
        text = (self.folder / "p.svg").read_text()
        for word in ("a.obj", "b.obj", "1 × 1 × 1", "4 × 4 × 4", "Zwei &amp; drei"):
            self.assertIn(word, text)
        self.bad(1, "sheet", "models", "torus", "--per-page", "1", "-o", "-", says=["--per-page 3"])

    def test_dark_page(self):
        """The page has the colour of the background, and light captions."""
        self.good("models", "-b", "#202428", "-s", "64", "-o", "sheet.png")
        sheet = read_png((self.folder / "sheet.png").read_bytes())
        self.assertEqual(pixel(sheet, 1, 1), (0x20, 0x24, 0x28, 255))
        self.assertGreater(max(pixel(sheet, x, y)[0] for x in range(sheet[0]) for y in range(70, sheet[1])), 0x80)

    def test_failures(self):
        (self.folder / "models" / "c.stl").write_text("solid x\nfacet oops\n")
        (self.folder / "empty").mkdir()
        self.given = self.new_files() | self.given
        done = self.run_program("sheet", "models", "-s", "32", "-o", "s.svg")
        self.assertEqual(done.returncode, 7, done.stderr)
        self.assertIn("not drawn", (self.folder / "s.svg").read_text())
        self.good("sheet", "models", "-s", "32", "-o", "s.svg", "--failures-ok")
        self.bad(2, "sheet", "empty", says=["empty"], leaves={"s.svg"})
        self.bad(1, "sheet", says=["no model given"], leaves={"s.svg"})
        self.bad(1, "sheet", "models", "-o", "pages/", says=["expected the file of one sheet"], leaves={"s.svg"})
        self.bad(1, "sheet", "models", "-o", "{stem}.png", says=["expected the file of one sheet"], leaves={"s.svg"})
        self.bad(5, "sheet", "models", "-s", "32", "-o", "missing/s.png", "-q", says=["missing/s.png"], leaves={"s.svg"})
