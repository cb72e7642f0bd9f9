# test_annotations.py: --dimensions, --scale-bar, --axes and --grid.
import json

from harness import Case, pixel

BOX = "".join(f"v {x} {y} {z}\n" for x in (0, 4) for y in (0, 2) for z in (0, 1)) + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
FRONT = ("-s", "400x300", "-b", "white", "--view", "front", "--projection", "orthographic", "--color", "0/0/1", "--ao", "off")


def ink(picture, x, y):
    """Whether a pixel is dark and grey: a line of an annotation, not the blue model nor the white background."""
    r, g, b, _ = pixel(picture, x, y)
    return max(r, g, b) < 190 and max(r, g, b) - min(r, g, b) < 12


def runs(flags):
    """The first and last index of each run of true flags."""
    starts = [i for i, flag in enumerate(flags) if flag and (i == 0 or not flags[i - 1])]
    return [(s, next((i for i in range(s, len(flags)) if not flags[i]), len(flags)) - 1) for s in starts]


class Annotations(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "box.obj").write_text(BOX)
        self.given.add("box.obj")

    def longest(self, picture, down, start):
        """The longest straight run of ink: (position, first, last), in a column if `down` is set, behind the model's end."""
        width, height = picture[:2]
        found = ((place, *run) for place in range(start + 3, width if down else height)
                 for run in runs([ink(picture, *((place, i) if down else (i, place))) for i in range(height if down else width)]))
        return max(found, key=lambda f: f[2] - f[1])

    def model(self, picture):
        width, height = picture[:2]
        blue = [(x, y) for x in range(width) for y in range(height) if pixel(picture, x, y)[2] > pixel(picture, x, y)[0] + 40]
        return min(x for x, _ in blue), min(y for _, y in blue), max(x for x, _ in blue) + 1, max(y for _, y in blue) + 1

    def test_lengths(self):
        """The arrows are as long as the model's sides, and the bar as its number says."""
        drawn = self.png("box.obj", *FRONT, "--dimensions")
        left, top, right, bottom = self.model(drawn)
        row, first, last = self.longest(drawn, False, bottom)
        self.assertLessEqual(abs(last + 1 - first - (right - left)), 2)
        column, first, last = self.longest(drawn, True, right)
        self.assertLessEqual(abs(last + 1 - first - (bottom - top)), 2)
        bar = self.png("box.obj", *FRONT, "--scale-bar")
        left, _, right, _ = self.model(bar)
        _, first, last = self.longest(bar, False, 270)
        self.assertLessEqual(abs(last + 1 - first - (right - left) / 4), 3)  # one unit of the four

    def test_fitted(self):
        """Nothing of the dimensions lies outside the picture, from any side."""
        for side in ("three-quarter", "front", "top", "left", "iso", "back"):
            for size in ("400x300", "200x400", "160"):
                for projection in ("perspective", "orthographic"):
                    drawn = self.png("box.obj", "-s", size, "-b", "white", "--view", side, "--projection", projection, "--dimensions")
                    width, height = drawn[:2]
                    border = [(x, y) for x in range(width) for y in (0, height - 1)] + [(x, y) for x in (0, width - 1) for y in range(height)]
                    self.assertEqual([p for p in border if pixel(drawn, *p) != (255, 255, 255, 255)], [], (side, size, projection))

    def test_hidden_grid(self):
        plain, grid = self.png("box.obj", *FRONT, "--elevation", "30"), self.png("box.obj", *FRONT, "--elevation", "30", "--grid")
        left, top, right, bottom = self.model(plain)
        inside = [(x, y) for x in range(left + 3, right - 3, 3) for y in range(top + 3, bottom - 3, 3)]
        self.assertEqual([p for p in inside if pixel(plain, *p) != pixel(grid, *p)], [])
        self.assertGreater(sum(pixel(plain, x, y) != pixel(grid, x, y) for x in range(0, 400, 3) for y in range(0, 300, 3)), 300)

    def test_same_bytes_at_every_door(self):
        words = ("--dimensions", "--scale-bar", "--axes", "--grid")
        drawn = self.png("box.obj", "-s", "200", *words, "--save-scene", "a.json")
        for more in (("--threads", "1"), ("--isa", "scalar"), ("--threads", "7")):
            self.assertEqual(self.png("box.obj", "-s", "200", *words, *more), drawn)
        saved = json.loads((self.folder / "a.json").read_text())
        self.assertEqual([saved[key] for key in ("dimensions", "scale_bar", "axes", "grid")], [True] * 4)
        self.assertEqual(self.png("a.json"), drawn)
        del saved["dimensions"], saved["camera"]
        (self.folder / "b.json").write_text(json.dumps(saved))
        self.assertEqual(self.png("b.json", "-s", "200", "--dimensions"), drawn)

    def test_only_on_pictures(self):
        for words in (("--show", "depth"), ("--show", "normals")):
            self.assertEqual(self.png("box.obj", *FRONT, *words, "--grid", "--axes"), self.png("box.obj", *FRONT, *words))

    def test_dark_and_floats(self):
        for background, low in (("black", False), ("white", True), ("transparent", True)):
            drawn = self.png("sphere", "-s", "200", "-b", background, "--scale-bar")
            line = [pixel(drawn, x, 200 - 11) for x in range(100, 200)]
            self.assertTrue(any(p[3] == 255 and (max(p[:3]) < 90 if low else min(p[:3]) > 180) for p in line), background)
        self.good("sphere", "-s", "64", "--axes", "-o", "a.exr")
