# test_compare.py: the command `compare`: every picture of a sheet equals the picture drawn with its options alone; captions, names,
# errors.
import base64
import json
import os
import re
import shlex
import xml.etree.ElementTree as xml

from harness import ROOT, Case, long, read_png

SVG = "{http://www.w3.org/2000/svg}"

# The defaults of sheets about shading (tools/sheet/sheet.c).
LIGHT = ("--light", "directional:frame=camera,direction=3/-1/-3,ambient=0.15,diffuse=0.7,specular=1")
GLOSSY = ("--material", "specular=0.7,shininess=100")


def part(picture, left, top, width, height):
    page, _, data = picture
    return b"".join(data[4 * (y * page + left):4 * (y * page + left + width)] for y in range(top, top + height))


class Looks(Case):
    def test_sheet(self):
        """`looks --sheet` is the comparison of all built-in looks."""
        self.good("looks", "--sheet", "-s", 48, "-q")
        names = [line.split()[0] for line in self.good("looks").stdout.decode().splitlines()]
        self.good("compare", "teapot", "--across", "look=" + ",".join(names), "-s", 48, "-q", "-o", "same.png")
        self.assertEqual((self.folder / "looks.png").read_bytes(), (self.folder / "same.png").read_bytes())


class Mistakes(Case):
    """Sheets of `--across mistake`, which OpenGL draws."""

    def sheet(self, *words):
        done = self.run_program("compare", "sphere", *words, "-s", "60x50", "-o", "sheet.png", "--json", timeout=None)
        if done.returncode == 3 and b"mistakes are drawn by OpenGL: " in done.stderr:
            self.skipTest(done.stderr.decode())
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return json.loads(done.stdout[done.stdout.index(b"{"):])["pictures"], done

    def test_named(self):
        pictures, _ = self.sheet("--across", "mistake=no-ambient,normal-by-model-view,no-gate")
        self.assertEqual([p["mistake"] for p in pictures], [None, "no-ambient", "normal-by-model-view", "no-gate"])
        means = [p["mean_difference"] for p in pictures]
        self.assertEqual((means[0], means[2]), (0, 0))  # the matrix is wrong only for stretched objects
        self.assertGreater(means[1], 0.01)
        self.assertGreater(means[3], 0)
        width, _, data = read_png((self.folder / "sheet.png").read_bytes())
        self.assertEqual(width, 4 * (60 + 4) + 4)

    def test_the_first_picture_is_that_of_the_cpu(self):
        """Shaders of the lecture style draw the CPU's picture, except at edges, where the devices antialias differently."""
        light = ("--light", "point:position=1/2/3,attenuation=0.5/0.1/0.1", "--light", "spot:position=-1/2/3,target=0/0/0,cutoff=20,exponent=3")
        self.sheet(*light, "--across", "mistake=no-cone", "--no-captions")
        page = read_png((self.folder / "sheet.png").read_bytes())
        alone = self.png("sphere", *light, "--material", "ambient=0.3/0.12/0.08,diffuse=0.75/0.3/0.2,specular=0.5,shininess=20", "--ao", "off", "-s", "60x50",
                         "-b", "white", "-q")[2]
        shown = part(page, 4, 4, 60, 50)
        far = sum(abs(a - b) > 1 for a, b in zip(shown, alone))
        self.assertLess(far, len(alone) / 200)

    def test_all(self):
        pictures, done = self.sheet("--across", "mistake=all", "--light", "directional:direction=-1/-1/-1", "--reflection", "phong")
        names = [p["mistake"] for p in pictures]
        left_out = re.search(r"omitted, because the scene does not show them: (.*)", (done.stdout + done.stderr).decode())[1].split(", ")
        known = [row["mistake"] for row in json.loads(self.good("shader", "--mistake", "list", "--json").stdout)]
        self.assertEqual(sorted([n for n in names if n] + left_out), sorted(known))
        self.assertIn("direction-reversed", names)
        self.assertIn("reflect-sign", names)
        self.assertIn("no-cone", left_out)
        self.assertIn("no-attenuation", left_out)

    def test_errors(self):
        self.bad(1, "compare", "sphere", "--across", "mistake=nogate", says="did you mean 'no-gate'?")
        self.bad(3, "compare", "sphere", "--across", "mistake=no-cone", says="mistake 'no-cone': the shader lacks the code that this mistake changes; expected a spot light")
        self.bad(1, "compare", "sphere", "--across", "mistake=no-gate", "--stage", "application", says="options '--stage application' and '--across mistake'")
        self.bad(1, "compare", "sphere", "--across", "mistake=no-gate", "--device", "cpu", says="see 'lambent compare -h'")
        many = [word for i in range(46) for word in ("--caption", f"Picture {i}")]  # the sphere shows fewer than all 47 mistakes
        self.bad(1, "compare", "sphere", "--across", "mistake", "-q", "-s", "32", *many, says="option '--caption': found 46, but the sheet has ")
        self.bad(3, "compare", "sphere", "--across", "mistake=no-gate", "--reflection", "ggx", says="'--style lecture' does not support '--reflection ggx'")
        self.bad(1, "compare", "sphere", "--across", "mistake=no-gate", "--device", "cpu", says="mistakes change shaders, and only OpenGL uses shaders")
        self.bad(1, "compare", "sphere", "--across", "mistake=no-gate", "--across", "shading", says="mistakes cannot be combined")


class Compare(Case):
    def alone(self, *words):
        return self.png(*words, "-b", "white", "-q")[2]

    def sheet(self, *words):
        return read_png(self.good("compare", *words, "-q", "-o", "-").stdout)

    def test_cells_are_what_their_options_give(self):
        page = self.sheet("cube.obj", "-s", "48x40", "--no-captions", "--across", "shading", "--azimuth", 50)
        gap = int(24 * 0.1) + 1
        self.assertEqual(page[:2], (3 * (48 + gap) + gap, 40 + 2 * gap))
        for i, shading in enumerate(("flat", "gouraud", "phong")):
            one = self.alone("cube.obj", "-s", "48x40", "--shading", shading, "--azimuth", 50, *LIGHT)
            self.assertEqual(part(page, gap + i * (48 + gap), gap, 48, 40), one, shading)

    def test_named_sheets(self):
        sizes = {"summary": (5, 1), "terms": (4, 2), "stages": (2, 1), "light": (2, 2), "ambient": (3, 1), "frames": (3, 2),
                 "surfaces": (3, 1)}
        for name, (columns, rows) in sizes.items():
            with self.subTest(name):
                width, height, _ = self.sheet("cube.obj", "--sheet", name, "--samples", 1, "-s", "48x36")
                inset = 36 // 6 * 3 + 1 if name == "stages" else 0
                head = 10 if name in ("summary", "terms", "stages", "surfaces") else 6  # the light is printed; the cube has a material
                self.assertEqual((width, height), (columns * 51 + 3, rows * (36 + inset + 8 + 3) + head + 3))

    def test_terms_add_up(self):
        """In raw numbers, ambient + diffuse + specular at shininess 50 equal the picture with all terms, up to the rounding of bytes."""
        page = self.sheet("sphere", "--sheet", "terms", "--no-captions", "--color-mode", "raw", "-s", "48x40", "-b", "0/0/0/1")
        gap = 3
        at = [part(page, gap + i % 4 * (48 + gap), gap + i // 4 * (40 + gap), 48, 40) for i in range(4)]
        for i in range(0, len(at[0]), 4):
            for k in range(3):
                self.assertLessEqual(abs(min(at[0][i + k] + at[1][i + k] + at[2][i + k], 255) - at[3][i + k]), 2)
        self.assertGreater(max(at[2][0::4]), 100)  # there is a highlight

    def test_turned_and_unturned_pictures_share_a_camera(self):
        """In the rows of the sheet `frames`, the model keeps its size and place."""
        page = self.sheet("cube.obj", "--sheet", "frames", "--no-captions", "-s", "48x40")
        lights = ["point:position=1.5r/1.5r/1.5r,ambient=0.15,frame=" + frame for frame in ("world", "camera", "object")]
        for i in range(6):
            turn = "y:-60" if i >= 3 else "y:0"
            one = self.alone("cube.obj", "-s", "48x40", "--light", lights[i % 3], "--rotate", turn)
            self.assertEqual(part(page, 3 + i % 3 * 51, 3 + i // 3 * 43, 48, 40), one, i)
        page = self.sheet("cube.obj", "--no-captions", "-s", "48x40", "--across", "rotate=x:0,y:30")
        for i, turns in enumerate((("x:0", "y:0"), ("x:0", "y:30"))):
            one = self.alone("cube.obj", "-s", "48x40", "--ao", "off", "--rotate", turns[0], "--rotate", turns[1])
            self.assertEqual(part(page, 3 + i * 51, 3, 48, 40), one, turns)

    def test_inset_shows_the_highlight(self):
        page = self.sheet("sphere", "--sheet", "stages", "--samples", 1, "--color-mode", "raw", "-s", "96x96", "--no-captions")
        left = 5 + 96 + 5  # per fragment
        whole = part(page, left, 5, 96, 96)
        inset = part(page, left, 5 + 96 + 2, 96, 48)
        brightest = max(whole[i] for i in range(0, len(whole), 4) if whole[i:i + 3] == 3 * whole[i:i + 1] and whole[i] < 255)
        middle = [inset[4 * (y * 96 + x)] for y in range(12, 36) for x in range(24, 72)]
        self.assertGreater(brightest, 180)
        self.assertGreaterEqual(max(middle), brightest - 4)
        self.assertLess(min(middle), brightest - 10)

    def test_captions(self):
        words = ("cube.obj", "--across", "azimuth=10,40", "-s", "120x60")
        plain, captioned = self.sheet(*words, "--no-captions"), self.sheet(*words)
        self.assertEqual(captioned[1] - plain[1], 15 + 20)
        for i in range(2):  # the pictures are the same
            left = 7 + i * (120 + 7)
            self.assertEqual(part(plain, left, 7, 120, 60), part(captioned, left, 7 + 15, 120, 60))
        caption = part(captioned, 7, 7 + 15 + 60, 120, 20)
        self.assertGreater(sum(value < 160 for value in caption[0::4]), 10)
        # The defaults of a sheet are printed below its title, within the page's margins.
        words = ("sphere", "--across", "viewer", "-s", "240x200")
        plain, captioned = self.sheet(*words, "--no-captions"), self.sheet(*words)
        self.assertEqual(captioned[1] - plain[1], 50 + 41)
        printed = part(captioned, 0, 29, captioned[0], 12)
        self.assertGreater(sum(value < 200 for value in printed[0::4]), 100)
        for left in (0, captioned[0] - 10):
            self.assertEqual(set(part(captioned, left, 0, 10, 13 + 50)), {255})
        self.bad(2, "compare", "cube.obj", "--font", "/nowhere.ttf", says="/nowhere.ttf")
        self.sheet("cube.obj", "-s", 8, "--font", "/nowhere.ttf", "--no-captions")

    def test_across(self):
        for across, count in (("reflection=lambert,phong,blinn-phong", 3), ("shininess", 3), ("light", 5), ("stage", 3), ("term", 5), ("show=normals,depth", 2), ("samples=1,4", 2),
                              ("material=gold;ruby,shininess=5", 2), ("material=gold,ruby,jade", 3), ("azimuth=0,30,60", 3)):
            with self.subTest(across):
                page = self.sheet("cube.obj", "-s", "48x40", "--no-captions", "--across", across)
                self.assertEqual(page[0], count * 51 + 3)
        two = self.sheet("cube.obj", "-s", "48x40", "--no-captions", "--across", "azimuth=0,10,20,30,40,50,60,70")
        self.assertEqual(two[:2], (4 * 51 + 3, 2 * 43 + 3))

        self.bad(1, "compare", "cube.obj", "--across", "light=point,spot:cutoff=9", says="semicolon")

    def test_shininess(self):
        """Without a material, the model gets a specular colour so that a highlight is visible; a given material does not change."""
        plain = self.sheet("cube.stl", "-s", "48x40", "--no-captions", "--across", "shininess=9")
        glossy = self.alone("cube.stl", "-s", "48x40", "--shininess", 9, "--material", "specular=0.7", *LIGHT)
        self.assertEqual(part(plain, 3, 3, 48, 40), glossy)
        for words in (["--material", "gold", "--across", "shininess=9"], ["--across", "material=gold", "--across", "shininess=9"]):
            page = self.sheet("cube.obj", "-s", "48x40", "--no-captions", *words)
            self.assertEqual(part(page, 3, 3, 48, 40), self.alone("cube.obj", "-s", "48x40", "--material", "gold", "--shininess", 9, *LIGHT))

    def test_defaults_yield(self):
        """The command line and the model's own settings override the settings of a sheet."""
        sphere = ("--segments", "24x12")
        (self.folder / "lit.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "sphere"}],
                                                          "lights": [{"type": "point", "position": [3, 1, 3]}]}))
        (self.folder / "gold.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "sphere", "material": "gold"}]}))
        for model, words, defaults in (
                ("sphere", (), (*sphere, *LIGHT, *GLOSSY)), ("teapot", (), ("--segments", "24x4", *LIGHT, *GLOSSY)),
                ("sphere", ("--segments", "9x7"), (*LIGHT, *GLOSSY)), ("sphere", ("--material", "diffuse=0.2"), (*sphere, *LIGHT)),
                ("sphere", ("--shininess", 7), (*sphere, *LIGHT, *GLOSSY)), ("sphere", ("--color", "red"), (*sphere, *LIGHT, *GLOSSY)),
                ("sphere", ("--rig", "studio"), (*sphere, *GLOSSY)), ("sphere", ("--light", "point"), (*sphere, *GLOSSY)),
                ("cube.obj", (), LIGHT), ("cube.stl", (), (*LIGHT, *GLOSSY)), ("cube.ply", ("--light", "point"), GLOSSY),
                ("lit.json", (), GLOSSY), ("gold.json", (), LIGHT)):
            with self.subTest(f"{model} {words}"):
                page = self.sheet(model, "-s", "48x40", "--no-captions", "--across", "shading=gouraud", *words)
                one = self.alone(model, "-s", "48x40", *defaults, *words, "--shading", "gouraud")
                self.assertTrue(part(page, 3, 3, 48, 40) == one)
        # They also override the anisotropic picture's own changes of the material.
        for words, more in (((), (*GLOSSY, "--material", "ambient=0.62,diffuse=0.3,shininess=30")), (("--material", "gold"), ())):
            page = self.sheet("sphere", "-s", "48x40", "--no-captions", *words)
            one = self.alone("sphere", "-s", "48x40", *sphere, *LIGHT, *more, *words, "--reflection", "kajiya-kay")
            self.assertTrue(part(page, 3 + 4 * 51, 3, 48, 40) == one)
        # A row of the default's own option takes its value from the row.
        for across, more in (("material=gold", LIGHT), ("segments=9x7", (*LIGHT, *GLOSSY))):
            option, value = across.split("=")
            page = self.sheet("sphere", "-s", "48x40", "--no-captions", "--across", "shading=flat", "--across", across)
            one = self.alone("sphere", "-s", "48x40", *more, *(sphere if option != "segments" else ()), "--shading", "flat", f"--{option}", value)
            self.assertTrue(part(page, 3, 3, 48, 40) == one, across)

    def shares(self, *words, inset=False):
        """The difference between neighbouring pictures of a sheet: the percentage of the model's pixels that differ by more than 16/255."""
        width, height, gap = 72, 60, 4
        page = self.sheet(*words, "-s", f"{width}x{height}", "--no-captions")
        step = height + gap + (height // 6 * 3 + gap // 2 if inset else 0)
        cells = [part(page, left, top, width, height) for top in range(gap, page[1] - height, step)
                 for left in range(gap, page[0] - width, width + gap)]
        while set(cells[-1]) == {255}:
            cells.pop()
        shares = []
        for a, b in zip(cells, cells[1:]):
            shown = differs = 0
            for i in range(0, len(a), 4):
                if a[i:i + 3] != a[:3] or b[i:i + 3] != b[:3]:
                    shown += 1
                    differs += max(abs(a[i + k] - b[i + k]) for k in range(3)) > 16
            shares.append(100 * differs / max(shown, 1))
        return shares

    def test_sheets_show_their_subject(self):
        """In each sheet of the teapot, and in rows about shading, every picture differs from the previous one. None means that the pictures are equal
        by definition."""
        for words, floors in {
                "--sheet summary": (6, 2.5, 50, 50), "--sheet terms": (50, 50, 50, 6, 1.5), "--sheet stages": (2.5,),
                "--sheet light": (50, 50, 50), "--sheet ambient": (50, 50), "--sheet frames": (50, 50, 40, 40, 50),
                "--sheet surfaces": (50, 50), "--across shading": (6, 2.5), "--across stage": (None, 2.5), "--across normals": (None, 2.5),
                "--across flat-normal": (10,), "--across reflection": (40, 4, 10, 25, 25, 30), "--across viewer": (3,),
                "--across rig": (None, 50, 50, 40, 40), "--across shininess": (20, 8), "--across light": (50, 50, 50, 50),
                "--across show": (50, 50, 50, 50), "--across color-mode=srgb,raw": (50,), "--across projection": (30,)}.items():
            with self.subTest(words):
                shares = self.shares("teapot", *words.split(), inset="stages" in words)
                self.assertGreaterEqual(len(shares), len(floors))
                for share, floor in zip(shares, [*floors, *[1.5] * len(shares)]):  # new values of an option come last
                    if floor is not None:
                        self.assertGreaterEqual(share, floor, [round(s, 2) for s in shares])
        # The band of the anisotropic picture extends from the pot's top to its bottom, and is its brightest
        # part.
        page = self.sheet("teapot", "--sheet", "summary", "-s", "96x80", "--no-captions")
        pot = part(page, 5 + 4 * 101, 5, 96, 80)
        bright = {i // 96 for i in range(96 * 80) if pot[4 * i + 3] and 225 < pot[4 * i] < 255}
        self.assertGreater(len(bright), 25)

    @long
    def test_pages_show_their_subject(self):
        """On the sheets of the pages, every picture differs from the previous one, except for pictures that are equal by definition."""
        equal = {"sphere.png": {0}, "frames.png": {2}, "normals.png": {6, 7}, "sides.png": {0}}
        faint = {"shadows-soft.png": 1, "shadows-terminator.png": 0.7,  # edges of shadows affect few pixels
                 "left-out.png": 0.5}  # only recesses
        commands = [line for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
                    for line in re.findall(r"(?m)^\s+lambent (compare .*-o docs/pictures/\S+)", page.read_text())]
        self.assertGreater(len(commands), 20)
        for line in commands:
            with self.subTest(line):
                words = shlex.split(line)[1:]
                picture = words[words.index("-o") + 1].rsplit("/")[-1]
                for option in ("-o", "-s"):
                    if option in words:
                        at = words.index(option)
                        del words[at:at + 2]
                words = [str(ROOT / word) if word.startswith("examples/") else word for word in words]
                shares = self.shares(*words, inset="stages" in words)
                for i, share in enumerate(shares):
                    if i not in equal.get(picture, ()):
                        self.assertGreaterEqual(share, faint.get(picture, 1.5), [round(s, 2) for s in shares])

    def test_json_says_the_words_of_each_picture(self):
        """The options alone draw the same picture as on the sheet."""
        for words in (("cube.obj", "--across", "shading", "--azimuth", "50"), ("torus", "--sheet", "frames"),
                      ("sphere", "--across", "ao=off,screen", "--across", "reflection=phong,ggx", "-b", "black")):
            with self.subTest(words):
                sheet = ("-s", "48x40", "--no-captions")
                said = json.loads(self.good("compare", *words, *sheet, "--json", "-o", "sheet.png").stdout)
                page = self.sheet(*words, *sheet)
                columns = (page[0] - 3) // 51
                self.assertEqual(said["model"], words[0])
                self.assertEqual(len(said["pictures"]), columns * ((page[1] - 3) // 43))
                common, i = [], 0
                while i < len(words):
                    if words[i] in ("--across", "--sheet"):
                        i += 2
                        continue
                    common.append(words[i])
                    i += 1
                for i, picture in enumerate(said["pictures"]):
                    one = self.png(*common, *picture["words"], "-s", "48x40", "-q")[2]
                    self.assertEqual(part(page, 3 + i % columns * 51, 3 + i // columns * 43, 48, 40), one, picture["caption"])

    def test_grid(self):
        """Two options crossed: the first defines the rows, the second the columns."""
        page = self.sheet("cube.obj", "-s", "48x40", "--no-captions", "--across", "shading=flat,phong", "--across", "azimuth=0,30,60")
        self.assertEqual(page[:2], (3 * 51 + 3, 2 * 43 + 3))
        for line, shading in enumerate(("flat", "phong")):
            for column, azimuth in enumerate((0, 30, 60)):
                one = self.alone("cube.obj", "-s", "48x40", "--shading", shading, "--azimuth", azimuth, *LIGHT)
                self.assertEqual(part(page, 3 + column * 51, 3 + line * 43, 48, 40), one, (shading, azimuth))
        self.bad(1, "compare", "cube.obj", "--across", "shading", "--across", "stage", "--across", "view", says="third")
        self.bad(4, "compare", "cube.obj", "--across", "samples=1,2,4,8,16", "--across", "azimuth=" + ",".join(map(str, range(13))), says="64")

    def test_names(self):
        done = self.good("compare", "cube.obj", "-s", 32)
        self.assertIn(b"cube-summary.png", done.stderr)
        self.good("compare", "cube.obj", "-s", 32, "--across", "shading", "-q")
        self.assertEqual(self.new_files(), {"cube-summary.png", "cube-shading.png"})
        (self.folder / "cube-terms.png").write_bytes(b"mine")
        self.given |= {"cube-terms.png", "cube-summary.png", "cube-shading.png"}
        self.bad(5, "compare", "cube.obj", "--sheet", "terms", "-s", 8, says="cube-terms.png")

    def test_same_bytes(self):
        words = ("compare", "cube.obj", "-s", 64, "--no-captions", "-q", "-o", "-")
        self.assertEqual(self.good(*words, "-j", 1, "--isa", "plain").stdout, self.good(*words, "-j", 3).stdout)

    def test_titles_of_rows(self):
        """The title of a row of values states the subject of the pictures."""
        for words, title in ((["cull"], "Culled sides of the surface"), (["azimuth=0,90"], "Values of --azimuth"),
                             (["normals", "shading=flat,phong"], "Rows: sources of the normals; columns: shading methods")):
            self.good("compare", "cube.obj", "-s", 16, "-o", "t.svg", *(word for one in words for word in ("--across", one)))
            self.assertEqual(xml.fromstring((self.folder / "t.svg").read_bytes())[0].text, f"{title} — cube.obj")

    def test_svg(self):
        """A sheet as SVG contains the pictures drawn with the options in --json, and text in any language as text."""
        done = self.good("compare", "cube.obj", "--sheet", "ambient", "-s", "80x60", "-o", "s.svg", "--json", "--title", "الضوء & <b>",
                         "--caption", "环境光", "--caption", "Łódź")
        svg = xml.fromstring((self.folder / "s.svg").read_bytes())
        answer = json.loads(done.stdout)["pictures"]
        self.assertEqual([t["caption"] for t in answer], ["环境光", "Łódź", "Ambient red, diffuse red"])
        self.assertEqual((svg[0].text, svg[1].text), ("الضوء & <b>", "3 pictures: 环境光; Łódź; Ambient red, diffuse red"))
        images = list(svg.iter(SVG + "image"))
        self.assertEqual([i.find(SVG + "title").text for i in images], [t["caption"] for t in answer])
        for image, picture in zip(images, answer):
            png = base64.b64decode(image.get("href").split("base64,")[1], validate=True)
            self.assertTrue(png == self.good("cube.obj", "-s", "80x60", *picture["words"], "-o", "-").stdout)
        texts = [t.text for t in svg.iter(SVG + "text")]
        self.assertEqual(texts[0], "الضوء & <b>")
        self.assertLessEqual({t["caption"] for t in answer}, set(texts))
        # The pictures are side by side, within the page.
        left = [float(i.get("x")) for i in images]
        self.assertTrue(all(b - a >= 80 for a, b in zip(left, left[1:])) and left[-1] + 80 <= float(svg.get("width")))
        self.bad(1, "compare", "cube.obj", "--caption", "a", "--caption", "b", "--caption", "c", "--sheet", "light", "--caption", "d", "--caption", "e",
                 says=("found 5", "4 pictures"), leaves=["s.svg"])
        self.bad(3, "compare", "cube.obj", "-s", 16, "-o", "s.png", "--caption", "环", says=("--caption", "U+73AF"), leaves=["s.svg"])
        self.bad(1, "compare", "cube.obj", "-s", 16, "-o", "s.png", "--title", "\udcff", says="UTF-8", leaves=["s.svg"])
        a, b = (self.png("compare", "cube.obj", "-s", 48, "--across", "shading=flat,phong", *more) for more in ([], ["--title", "Łódź — Φῶς"]))
        self.assertEqual(a[:2], b[:2])
        self.assertNotEqual(a[2], b[2])
        # An invalid byte in a model's name becomes a replacement character.
        name = b"c\xff.obj"
        (self.folder / "cube.obj").rename(os.path.join(os.fsencode(self.folder), name).decode(errors="surrogateescape"))
        self.good("compare", name.decode(errors="surrogateescape"), "-s", 16, "-o", "s.svg", "--across", "shading=flat")
        self.assertIn("c\ufffd.obj", xml.fromstring((self.folder / "s.svg").read_bytes())[0].text)

    def test_errors(self):
        self.bad(1, "compare", says="missing")
        self.bad(1, "compare", "-", says="standard input")
        self.bad(2, "compare", "missing.obj", says="missing.obj")
        self.bad(1, "compare", "cube.obj", "--sheet", "term", says="did you mean 'terms'?")
        self.bad(1, "compare", "cube.obj", "--across", "shadin", says="did you mean 'shading'?")
        self.bad(1, "compare", "cube.obj", "--across", "output", says="--across")
        self.bad(1, "compare", "cube.obj", "--across", "azimuth", says="azimuth=A,B,C")
        self.bad(1, "compare", "cube.obj", "--across", "shading=flat,,phong", says="empty")
        self.bad(1, "compare", "cube.obj", "--across", "shading=flat,rough", says="rough")
        self.bad(4, "compare", "cube.obj", "--across", "azimuth=" + ",".join(map(str, range(65))), says="64")
        self.bad(4, "compare", "cube.obj", "-s", 30000, says="65535")
        self.bad(3, "compare", "cube.obj", "-o", "sheet.pfm", says="sheet.pfm")
        self.bad(1, "compare", "cube.obj", "--verbose", says="option '--verbose' does not apply")
        self.bad(1, "cube.obj", "--sheet", "terms", says="does not apply")
