# test_lectures.py: the numbers and formulas of the pages about lectures come from the program, and the text of `explain` can be computed again.
import json
import math
import random
import re
import unittest

from harness import ROOT, Case


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


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
        for model in ("lambert", "phong", "blinn-phong", "kajiya-kay", "kajiya-kay-lecture"):
            formulas = self.explained("sphere", "16,16", "-s", 32, "--reflection", model)["triangles"][0]["formulas"]
            found = re.search(r"(?m)^\| `%s`[^|]*\| ([^|]*) \| ([^|]*) \|$" % model, page)
            gate = "[n·l > 0]" if formulas["gated"] else ""
            self.assertEqual(plain(found[1]), plain((gate if not formulas["D"].startswith("max(") else "") + formulas["D"]), model)
            self.assertEqual(plain(found[2]), plain(gate + formulas["base"] + "^α") if formulas["base"] else "0", model)

    def test_tone_of_shapes(self):
        """docs/lighting/tone.md names the shapes with the curve contrast, and the shapes without a curve."""
        page = " ".join((ROOT / "docs/lighting/tone.md").read_text().split())
        listed = [set(re.findall(r"[\w-]+", re.search(pattern, page)[1])) - {"and"} for pattern in (r"built-in shapes ([^.]*?) with their", r"The shapes ([^.]*?) are examples")]
        shapes = [line.split()[0] for line in self.good("shapes").stdout.decode().splitlines()]
        for shape in shapes:
            for model, curve in (("blinn-phong", None), ("kajiya-kay", "none")):
                tone = self.explained(shape, "1,1", "-s", 8, "--reflection", model)["tone"]
                self.assertEqual(tone, curve or ("contrast" if shape in listed[0] else "none"), shape)
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
                    color = [eval(python(rows["toned"][1].split(": ", 1)[1]), {"x": x, "min": min}) for x in color]
                    self.assertLess(max(abs(a - b) for a, b in zip(color, rows["toned"][0])), 3e-6)
                back = rows["background"][0]
                whole = alpha + (1 - alpha) * back[3]
                color = [(alpha * a + (1 - alpha) * back[3] * b) / whole if whole else 0 for a, b in zip(color, back)]
                color = [eval(python(rows["encoded"][1].split(": ", 1)[1]), {"x": x, "min": min}) for x in color]
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


if __name__ == "__main__":
    unittest.main()
