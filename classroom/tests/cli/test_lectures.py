# test_lectures.py: the numbers and formulas of the pages about lectures come from the program, and the text of `explain` can be computed again.
import json
import math
import os
import random
import re
import shlex
import subprocess
import unittest

from harness import PROGRAM, ROOT, Case, read_png
from lecture_rows import CHECK, LECTURES, PICTURE, ROWS


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.hypot(*a) for x in a]


def python(formula):
    """A printed formula of x as a Python expression."""
    for a, b in (("²", "**2"), ("^", "**"), ("·", "*"), ("−", "-"), ("≤", "<="), ("½", "0.5"), ("÷", "/")):
        formula = formula.replace(a, b)
    return re.sub(r"(.*) \? (.*) : (.*)", r"(\2) if (\1) else (\3)", formula)


class Pages(Case):
    def explained(self, *words):
        return json.loads(self.good("explain", *words, "--json").stdout)

    def test_angles(self):
        """docs/mistakes.md: φ is at most 2ψ, equal in the plane of n and l, and the error reaches 180°."""
        self.assertRegex((ROOT / "docs/mistakes.md").read_text(), r"Otherwise φ is smaller\s+than 2ψ. The error is largest, up to 180°")
        rows, most = random.Random(1), 0
        for i in range(20000):
            n, grazing = (0, 0, 1), 10 ** -rows.uniform(0, 6)
            l = unit([rows.gauss(0, 1), rows.gauss(0, 1), abs(rows.gauss(0, 1)) * grazing + 1e-12])
            turn, up = rows.uniform(0, 2 * math.pi) if i % 2 else math.pi + grazing ** 0.5, grazing * abs(rows.gauss(0, 1)) + 1e-12
            v = unit([math.cos(turn) * l[0] - math.sin(turn) * l[1], math.sin(turn) * l[0] + math.cos(turn) * l[1], up])
            r, h = [2 * dot(n, l) * a - b for a, b in zip(n, l)], unit([a + b for a, b in zip(l, v)])
            phi, psi = (math.degrees(math.acos(max(-1, min(1, dot(a, b))))) for a, b in ((r, v), (n, h)))
            self.assertLess(phi - 2 * psi, 1e-3)
            most = max(most, 2 * psi - phi)
        self.assertTrue(179 < most <= 180, most)

    def test_table_of_models(self):
        """docs/lighting.md: the formulas of D and S are the program's, with the gate."""
        def plain(formula):
            return re.sub(r"[ ·]", "", formula)
        page = (ROOT / "docs/lighting.md").read_text()
        for model in ("lambert", "phong", "blinn-phong", "kajiya-kay", "kajiya-kay-lecture", "toon", "gooch"):
            formulas = self.explained("sphere", "16,16", "-s", 32, "--reflection", model)["triangles"][0]["formulas"]
            found = re.search(r"(?m)^\| `%s`[^|]*\| ([^|]*) \| ([^|]*) \|$" % model, page)
            gate = "[n·l > 0]" if formulas["gated"] else ""
            self.assertEqual(plain(found[1]), plain((gate if not formulas["D"].startswith("max(") else "") + formulas["D"]), model)
            self.assertEqual(plain(found[2]), plain(gate + formulas["base"] + "^α") if formulas["base"] else "0", model)

    def test_tone_of_shapes(self):
        """docs/lighting/tone.md names the shapes with the curve contrast, and the shapes with the curve soft."""
        page = " ".join((ROOT / "docs/lighting/tone.md").read_text().split())
        listed = [set(re.findall(r"[\w-]+", re.search(pattern, page)[1])) - {"and"} for pattern in (r"built-in shapes ([^.]*?) with their", r"The shapes ([^.]*?) are examples")]
        shapes = [line.split()[0] for line in self.good("shapes").stdout.decode().splitlines()]
        for shape in shapes:
            for model, curve in (("blinn-phong", None), ("kajiya-kay", "soft")):
                tone = self.explained(shape, "1,1", "-s", 8, "--reflection", model)["tone"]
                self.assertEqual(tone, curve or ("contrast" if shape in listed[0] else "soft"), shape)
        self.assertEqual(listed[0] | listed[1], set(shapes))

    def test_text(self):
        """The last steps of `explain`, from the printed text alone, give the bytes of the picture."""
        for words in (("teapot",), ("torus", "--tone", "reinhard", "--exposure", "1"), ("sphere", "--reflection", "kajiya-kay"), ("cube", "--color-mode", "raw"),
                      ("teapot", "--material", "opacity=0.4", "--background", "#884422", "--tone", "reinhard"), ("gyroid", "--background", "white"),
                      ("torus-knot", "--light", "point:position=2r/2r/3r,intensity=2"), ("teapot", "--background", "#80808080")):
            for at in ("33,30", "20,20", "47,40"):
                text = self.good("explain", *words, at, "-s", 64).stdout.decode()
                text = text[text.index("\npixel "):]
                rows = {name.strip(): ([float(x) for x in numbers.split()], remark.strip()) for name, numbers, remark in
                        re.findall(r"(?m)^  (\S.{23})((?: +-?[\d.]+(?:e[+-]\d+)?){1,4})(?:   (.*))?$", text)}
                parts = [(row[0], float(row[1].split()[1])) for row in rows.values() if row[1].startswith("counts ")]
                total = rows["weighted sum"][0]
                if parts:
                    for k in range(3):
                        self.assertAlmostEqual(total[k], sum(c[k] * c[3] * w for c, w in parts), delta=2e-6)
                alpha, exposure = total[3], rows["exposure"][0][0]
                color = [exposure * x / alpha if alpha else 0 for x in total[:3]]
                if "toned" in rows:
                    color = [eval(python(rows["toned"][1].split(": ", 1)[1]), {"x": x, "min": min, "max": max}) for x in color]
                    self.assertLess(max(abs(a - b) for a, b in zip(color, rows["toned"][0])), 3e-6)
                back = rows["background"][0]
                whole = alpha + (1 - alpha) * back[3]
                color = [(alpha * a + (1 - alpha) * back[3] * b) / whole if whole else 0 for a, b in zip(color, back)]
                color = [eval(python(rows["encoded"][1].split(": ", 1)[1]), {"x": x, "min": min, "max": max}) for x in color]
                for found, x in zip(rows["bytes"][0], [*color, whole]):
                    self.assertIn(found, (math.floor(255 * x + 0.499), math.floor(255 * x + 0.501)), (words, at, text))

    def test_off_the_plane(self):
        """`explain` says why φ is not 2ψ; in the plane of n and l it is."""
        light = ("--light", "point:frame=camera,position=0/2/0")
        for at, inside in (("240,150", True), ("300,150", False)):
            words = ("sphere", at, "-s", 481, "--samples", 1, "--view", "front", *light)
            one = self.explained(*words)["triangles"][0]["points"][0]["lights"][0]
            self.assertEqual(abs(one["phi_deg"] - 2 * one["psi_deg"]) < 1e-3, inside)
            self.assertEqual("φ/2, because v is" in self.good("explain", *words).stdout.decode(), not inside)

    def test_formulas(self):
        """The gradient, ∂p/∂u × ∂p/∂v and the triangle's plane, computed again from the printed numbers."""
        for at in ("120,100", "100,90"):
            text = self.good("explain", "--implicit", "x^2+y^2/4+z^2/9=1", at, "-s", 240).stdout.decode()
            (x, y, z), gradient, n = (self.numbers(text, name) for name in ("x, y, z", "∇f", "n"))
            self.close(gradient, (2 * x, y / 2, 2 * z / 9))
            self.close(n, unit(gradient))
            words = ("--parametric", "x=cos(u)*sin(v); y=cos(u)*cos(v); z=sin(u)", "--u=-pi/2..pi/2", "--v=-pi..pi")
            text = self.good("explain", *words, at, "-s", 240).stdout.decode()
            (u, v), p, p_u, p_v, n = (self.numbers(text, name) for name in ("u, v", "p(u, v)", "∂p/∂u", "∂p/∂v", "n"))
            self.close(p, (math.cos(u) * math.sin(v), math.cos(u) * math.cos(v), math.sin(u)))
            self.close(p_u, (-math.sin(u) * math.sin(v), -math.sin(u) * math.cos(v), math.cos(u)))
            self.close(p_v, (math.cos(u) * math.cos(v), -math.cos(u) * math.sin(v), 0))
            self.close(n, unit(cross(p_u, p_v)))
            self.close(n, p)  # of a unit sphere
            self.assertLess(math.dist(p, self.numbers(text, "position in the mesh")), 0.01)
            fragment = self.explained("--implicit", "x+y^2=0.1", "30,30", "-s", 64)["triangles"][0]
            for corner in fragment["places"][:3]:
                self.assertAlmostEqual(dot(fragment["plane"][:3], corner["object"]) + fragment["plane"][3], 0, delta=1e-6)
        self.bad(1, "explain", "--implicit", "x", "sphere", "9,9", says="found 'sphere' and --implicit")
        self.bad(1, "explain", "sphere", says="the pixel after the model 'sphere' is missing")
        self.bad(1, "explain", "sphere", "9,9", "--u", "0..1", says="--u")

    def numbers(self, text, name):
        return [float(x) for x in re.search(r"(?m)^ +%s((?: +-?[\d.]+(?:e[+-]\d+)?)+)" % re.escape(name), text)[1].split()]

    def test_plots(self):
        """The values of the plots, computed again by textbook formulas, and `explain --figure beam`."""
        def cosine(x):
            return math.cos(math.radians(x)) if x < 90 else 0.0

        peak = max(self.ggx(0.3, 89.99 * k / 720) for k in range(-720, 721))
        formulas = {
            ("lambert", "share"): cosine, ("lambert", "area"): lambda x: 1 / math.cos(math.radians(x)),
            ("fresnel", "0.04"): lambda x: 0.04 + 0.96 * (1 - cosine(x)) ** 5,
            ("fresnel", "ior=1.5"): self.fresnel, ("tone", "none"): lambda x: min(x, 1), ("tone", "reinhard"): lambda x: x / (1 + x),
            ("tone", "contrast"): lambda x: min(0.4 * (x / 0.4) ** 2, 1), ("depth", "0.1/20"): lambda x: max(0, 20 / 19.9 * (1 - 0.1 / x)) if x else 0,
            ("lobe", "phong:50"): lambda x: max(math.cos(math.radians(x - 45)), 0) ** 50, ("lobe", "blinn-phong:200"): lambda x: math.cos(math.radians((x - 45) / 2)) ** 200,
            ("lobe", "lambert"): lambda x: 1, ("lobe", "ggx:0.3"): lambda x: self.ggx(0.3, x) / peak}
        for (kind, word), formula in formulas.items():
            answer = json.loads(self.good("plot", kind, word, "-s", "200x150", "--json", "-o", "p.png").stdout)
            for x, y in answer["curves"][0]["points"]:
                if (kind, word, x) not in (("lambert", "area", 90), ("lobe", "ggx:0.3", 90)):
                    self.assertAlmostEqual(y, formula(x), delta=2e-5 * max(1, y), msg=(kind, word, x))
        self.assertIn("24-bit step at far 0.00024", self.good("plot", "depth", "0.1/20", "-o", "p.png").stdout.decode())
        for words in (("fresnel", "2"), ("fresnel", "ior=1"), ("tone", "film"), ("depth", "2/1"), ("lobe", "ggx:3"), ("lobe", "lambert:1"), ("lambert", "x")):
            self.bad(1, "plot", *words, "-o", "q.png", says=("plot " + words[0], words[1]))
        self.bad(1, "plot", "lob", says="did you mean 'lobe'")
        self.good("explain", "sphere", "60,40", "-s", 96, "--light", "point:position=1/2/3", "--figure", "beam", "-o", "b.svg")
        texts = re.findall(r"<text[^>]*>([^<]*)", (self.folder / "b.svg").read_text())
        width, light = (float(next(t for t in texts if t.startswith(begin)).split("= ")[-1]) for begin in ("beam: 1, surface", "light on an area"))
        rows = texts[texts.index("Vectors in eye space"):]
        n, l = ([float(x) for x in rows[rows.index(name) + 1:rows.index(name) + 4]] for name in "nl")
        self.assertAlmostEqual(light, dot(n, l), delta=3e-6)
        self.assertAlmostEqual(width * light, 1, delta=1e-5)
        self.bad(1, "sphere", "--figure", "beam", says="--figure")
        self.given |= {"p.png", "b.svg"}

    def fresnel(self, degrees, ior=1.5):
        a = math.cos(math.radians(degrees)) if degrees < 90 else 0.0
        b = math.cos(math.asin(math.sin(math.radians(degrees)) / ior))
        return (((a - ior * b) / (a + ior * b)) ** 2 + ((b - ior * a) / (b + ior * a)) ** 2) / 2

    def ggx(self, roughness, degrees):
        """D V n·l for a light at 45 degrees (Walter et al. 2007; Smith, height-correlated)."""
        a, v, n_l = roughness ** 2, math.radians(degrees), math.cos(math.radians(45))
        n_v, h = math.cos(v), (v - math.radians(45)) / 2
        d = a * a / ((math.cos(h) ** 2 * (a * a - 1) + 1) ** 2)
        smith = [math.sqrt(1 + a * a * (1 / (c * c) - 1)) for c in (n_l, max(n_v, 1e-9))]
        return d / (2 * n_v * n_l * (smith[0] + smith[1])) * n_l * 1.0 if n_v > 1e-9 else 0

    def test_across(self):
        """Switches and fields of materials in a row; each cell is the picture that the options draw alone."""
        scene = ("--light", "point:position=1r/2r/3r", "--ao", "off", "--background", "white", "-s", "64")
        for across, cells in (("match-highlights", ((), ("--match-highlights",))), ("two-sided", ((), ("--two-sided",))),
                              ("emission=0,0.2,0.3/0/0", [("--material", "emission=" + x) for x in ("0", "0.2", "0.3/0/0")]),
                              ("fibre", [("--reflection", "kajiya-kay", "--material", "fibre=" + x) for x in ("no", "yes")])):
            more = ("--reflection", "kajiya-kay") if across == "fibre" else ()
            self.good("compare", "sphere", "--across", across, *scene, *more, "-o", "row.png")
            width, height, pixels = read_png((self.folder / "row.png").read_bytes())
            rows = [pixels[4 * width * y:4 * width * (y + 1)] for y in range(height)]
            for words in cells:
                one_width, _, one = read_png(self.good("sphere", *scene, *words, "-o", "-").stdout)
                middle = one[4 * one_width * 32:4 * one_width * 33]
                self.assertTrue(any(middle in row for row in rows), (across, words))
        self.good("compare", "sphere", "--across", "match-highlights", "--across", "shininess=5,50", *scene, "-o", "row.png")
        self.bad(1, "compare", "sphere", "--across", "match-highlights=1", says="is a switch without values")
        self.bad(1, "compare", "sphere", "--across", "emission", says="'emission' needs values")
        self.bad(1, "compare", "sphere", "--across", "emision=1", says="did you mean 'emission'")
        self.given |= {"row.png"}

    def close(self, found, wanted):
        for a, b in zip(found, wanted, strict=True):
            self.assertAlmostEqual(a, b, delta=2e-6)


class Exercises(Case):
    def test_exercises(self):
        """Twenty exercises of a seed, with one or two mistakes: at least twelve, each visible in 2 % of the pixels and named by the check."""
        done = self.run_program("exercises", "--count", 20, "--seed", 7, "-o", "class", "--title", "Week <5>", timeout=600)
        if done.returncode == 3 and b"OpenGL" in done.stderr:
            self.skipTest("OpenGL is missing")
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        listed = {line.split()[0]: line.split()[1].split("+") for line in done.stdout.decode().splitlines()}
        self.assertEqual(list(listed), ["exercise-%02d" % i for i in range(1, 21)])
        self.assertGreaterEqual(len({m for both in listed.values() for m in both}), 12)
        self.assertGreaterEqual(sum(len(both) == 2 for both in listed.values()), 5)
        folder = self.folder / "class"
        students, key = ((folder / name).read_text() for name in ("students.html", "key.html"))
        self.assertIn("<h1>Week &lt;5&gt;", students)
        for name, mistakes in listed.items():
            for mistake in mistakes:
                self.assertIn("<b>%s</b>" % mistake, key)
                self.assertNotIn(mistake, students)
            self.assertIn(name + ".frag", students)
            width, height, pixels = read_png((folder / (name + ".png")).read_bytes())
            different = sum(max(abs(pixels[4 * (y * width + x) + c] - pixels[4 * (y * width + x + 272) + c]) for c in range(3)) > 2
                            for y in range(40, 296) for x in range(16, 272))
            self.assertGreaterEqual(different, 0.02 * 256 * 256, (name, mistakes))
        checked = self.run_program("check", "--class", "class", "--csv", "grades.csv")
        self.assertEqual(checked.returncode, 6)
        for line in checked.stdout.decode().splitlines()[:20]:
            self.assertEqual({m.strip(",") for m in line.split()[5:]}, set(listed[line.split()[0]]), line)
        # the same seed gives the same exercises, another seed gives others
        again, other = (self.good("exercises", "--count", 2, "--seed", seed, "-o", "again%d" % seed).stdout.decode() for seed in (7, 8))
        self.assertEqual(again.splitlines(), ["%s  %s" % (name, "+".join(both)) for name, both in list(listed.items())[:2]])
        self.assertNotEqual(again, other)
        self.assertEqual((self.folder / "again7/exercise-01.frag").read_bytes(), (folder / "exercise-01.frag").read_bytes())
        self.bad(1, "exercises", says="-o class/")
        self.bad(1, "exercises", "--count", "0", "-o", "c", says="--count")
        self.given |= {"class", "again7", "again8", "grades.csv"}

    def test_help(self):
        for word in ("teaching", "exercise", "winding", "halfway"):
            self.assertRegex(self.good("help", word).stdout.decode(), "teaching|[Ee]xercises", word)

    def test_small_things(self):
        """A warning of one picture of a sheet, markers of white lights on white, and vector graphics."""
        for values, warned in (("0,0.5", False), ("0.5,0", False), ("0,0", True)):
            done = self.good("compare", "sphere", "--reflection-map", "sky", "--across", "reflectivity=" + values, "-s", "32", "-o", "s.png")
            self.assertEqual(b"environment is invisible" in done.stderr, warned, values)
        words = ("sphere", "--light", "point:position=1.15/1.05/0.9", "--background", "white", "-s", "192", "-o", "-")
        (_, _, plain), (_, _, marked) = (read_png(self.good(*words, *more).stdout) for more in ((), ("--show-lights",)))
        white = {i for i in range(0, len(marked), 4) if plain[i] == 255}
        self.assertGreater(len([i for i in white if marked[i] < 128]), 5)
        for words in (("explain", "sphere", "8,8", "-s", "16"), ("plot", "spot"), ("compare", "sphere")):
            self.bad(3, *words, "-o", "x.pdf", says="for vector graphics, use .svg")
        self.given |= {"s.png"}

    def test_beam_of_the_terms(self):
        """The sheet of the terms ends with Lambert's law: after the six pictures stands a beam with its two numbers, in ink and in the beam's colour."""
        page = self.good("compare", "sphere", "--sheet", "terms", "-s", "240x200", "-o", "terms.svg") and (self.folder / "terms.svg").read_text()
        for text in ("An oblique beam covers more area", "light on an area of 1: cos θ = n·l = 0.6", "beam: 1, surface: 1/cos θ = 1.66667"):
            self.assertIn(text, page)
        self.good("compare", "sphere", "--sheet", "terms", "-s", "240x200", "--no-captions", "-o", "s.png")
        width, height, pixels = read_png((self.folder / "s.png").read_bytes())
        rows = range(height // 2, height)
        self.assertGreater(sum(tuple(pixels[4 * (y * width + x):][:3]) == (0xc7, 0x77, 0) for y in rows for x in range(width // 2, width * 3 // 4)), 20)
        self.given |= {"terms.svg", "s.png"}

    def test_plain_captions(self):
        """Without the lines of options, only the letters of captions and titles are left."""
        inks = []
        for style in ("full", "plain"):
            self.good("compare", "sphere", "--across", "shininess=5,50", "-s", "160x120", "--captions", style, "-o", "s.png")
            width, height, pixels = read_png((self.folder / "s.png").read_bytes())
            inks.append(sum(max(pixels[4 * width * y:4 * width * (y + 1)]) > min(pixels[4 * width * y:4 * width * (y + 1)]) for y in list(range(40)) + list(range(height - 45, height))))
        self.assertLess(inks[1], inks[0])
        self.given |= {"s.png"}


class Lectures(Case):
    """docs/lectures.md: every row of the lectures with its command, which is run here, and its picture or numbers."""

    def command(self, number, command, result):
        """A row's command as it is printed."""
        size = "" if " -s " in command else " -s 480x300" if command.startswith("plot") else " -s 200x167" if command.startswith("compare") else " -s 240"
        if result == CHECK:
            return "lambent " + re.sub(r"\S+\.(frag|vert)\b", r"classroom/tests/check/lectures/\g<0>", command)
        return "lambent " + command + (size + " -o docs/pictures/lectures/%02d.png" % number if result == PICTURE else "")

    def lines(self, output, names):
        """The first line of the output that begins with each name."""
        text = output.splitlines()
        return [next(line.strip() for line in text if line.lstrip().startswith(name.lstrip()) and line.startswith(name[:4] if name[0] in " /" else "")) for name in names]

    def page(self):
        def anchor(title):
            return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")
        yield "# The lectures, row by row\n\nThis page shows every statement, formula, figure, method and program of three lectures on lighting, in our words, and\nwhat today's courses add. Each row has a command, its picture or its numbers, and a link to the page that explains it.\nA test runs every command (`classroom/tests/cli/test_lectures.py`)."
        for title, first, last in LECTURES:
            yield "\n**[%s](#%s)**\n" % (title, anchor(title))
            for number, statement, *_ in ROWS[first - 1:last]:
                yield "- [%d. %s](#%s)" % (number, statement.rstrip("."), anchor("%d. %s" % (number, statement.rstrip("."))))
        for title, first, last in LECTURES:
            yield "\n## " + title
            for number, statement, command, result, link in ROWS[first - 1:last]:
                yield "\n### %d. %s\n" % (number, statement.rstrip("."))
                words = command and self.command(number, command, result)
                yield "    " + words if command else "![%s](pictures/%s)" % (statement, result)
                if not command:
                    pass
                elif result == PICTURE:
                    yield "\n![%s](pictures/lectures/%02d.png)" % (statement, number)
                elif result != CHECK:
                    yield "\n".join(["", *("    " + line for line in self.lines(self.run_row(words), result))])
                yield "\n[Explanation](%s)" % link

    def run_row(self, words):
        self.given |= {"row.png"}
        words = [str(ROOT / w) if w.startswith(("examples/", "classroom/")) else "row.png" if w.startswith("docs/") else w for w in shlex.split(words)[1:]]
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode == 3 and b"OpenGL" in done.stderr:
            return None
        self.assertIn(done.returncode, (0, 6) if words[0] == "check" else (0,), done.stderr.decode())
        return done.stdout.decode()

    def test_page(self):
        self.assertEqual([row[0] for row in ROWS], list(range(1, len(ROWS) + 1)))
        text = "\n".join(self.page()) + "\n"
        path = ROOT / "docs/lectures.md"
        if os.environ.get("UPDATE"):
            path.write_text(text)
        self.assertEqual(path.read_text(), text, "UPDATE=1 writes the page, and scripts/docs.py draws its pictures")

    def test_rows(self):
        for number, statement, command, result, link in ROWS:
            if result not in (PICTURE, CHECK) or not command:
                continue  # the page contains the lines of this row
            with self.subTest(number):
                output = self.run_row(self.command(number, command, result))
                if output is None:
                    continue  # OpenGL is missing
                if result == PICTURE:
                    width, height, pixels = read_png((self.folder / "row.png").read_bytes())
                    self.assertGreater(len({pixels[i:i + 4] for i in range(0, len(pixels), 4)}), 2, "the picture is nearly empty")
                    self.assertTrue((ROOT / ("docs/pictures/lectures/%02d.png" % number)).exists())
                else:
                    self.assertIn(command.split()[1], output)
                page, _, heading = link.partition("#")
                self.assertTrue((ROOT / "docs" / page).exists(), link)
                if heading:
                    self.assertIn(heading, [re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in re.findall(r"(?m)^#+ (.*)$", (ROOT / "docs" / page).read_text())])


if __name__ == "__main__":
    unittest.main()
