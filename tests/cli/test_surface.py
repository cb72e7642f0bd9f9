# test_surface.py: the default light depends on a model's surface, not on the order, the number or the format of its triangles; a black Ka in an
# MTL file blackens nothing.
import json
import random
import shutil
import unittest

from harness import ROOT, SHARED_MODELS, Case, pixel

SHARED_CASES = SHARED_MODELS.parent / "cases"


class Model:
    """The vertices and the triangles of an OBJ file, with all other lines kept."""

    def __init__(self, path):
        self.head, self.points, self.faces, self.attributes = [], [], [], {}
        material = ""
        for line in path.read_text().splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                self.points.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [word.split("/") for word in words[1:]]
                self.faces += [(material, (corners[0], corners[k], corners[k + 1])) for k in range(1, len(corners) - 1)]
            elif words[:1] == ["usemtl"]:
                material = line
            elif words[:1] == ["vt"]:
                self.attributes.setdefault("vt", []).append([float(x) for x in words[1:3]])
            elif words[:1] == ["mtllib"]:
                self.head.append(line)

    def text(self, faces):
        lines = self.head + ["v %.9g %.9g %.9g" % tuple(p) for p in self.points] + ["vt %.9g %.9g" % tuple(t) for t in self.attributes.get("vt", [])]
        last = ""
        for material, corners in faces:
            if material != last:
                lines.append(material)
                last = material
            lines.append("f " + " ".join("/".join(c[:2]).rstrip("/") for c in corners))
        return "\n".join(lines) + "\n"

    def middle(self, a, b):
        """Adds the middle of an edge."""
        new = []
        for values, x, y in zip((self.points, self.attributes.get("vt", [])), a, b):
            if not x:
                break
            values.append([(p + q) / 2 for p, q in zip(values[int(x) - 1], values[int(y) - 1])])
            new.append(str(len(values)))
        return new

    def divided(self):
        faces = []
        for material, (a, b, c) in list(self.faces):
            x, y, z = self.middle(a, b), self.middle(b, c), self.middle(c, a)
            faces += [(material, t) for t in ((a, x, z), (x, b, y), (z, y, c), (x, y, z))]
        return faces

    def changes(self):
        shuffled = self.faces[:]
        random.Random(3).shuffle(shuffled)
        yield "shuffled", self.text(sorted(shuffled, key=lambda face: face[0]))
        yield "doubled", self.text(self.faces + self.faces)
        yield "divided", self.text(self.divided())


class Surface(Case):
    def lights(self, model):
        return json.loads(self.good("lights", model, "--up", "y").stdout)["lights"]

    def same_picture(self, a, b, *, but=0.001):
        """At most one pixel in a thousand differs by more than 2/255, silhouettes excepted."""
        x, y = (self.png(model, "--up", "y", "--normals", "facet", "-s", "320", "-q") for model in (a, b))
        inside = [i for i in range(0, len(x[2]), 4) if x[2][i + 3] == y[2][i + 3] == 255]
        wrong = sum(max(abs(p - q) for p, q in zip(x[2][i:i + 3], y[2][i:i + 3])) > 2 for i in inside)
        self.assertLessEqual(wrong, but * len(inside), (a, b))

    def check(self, name, model):
        plain = Model(model)
        (self.folder / "plain.obj").write_text(plain.text(plain.faces))
        for change, text in plain.changes():
            (self.folder / f"{change}.obj").write_text(text)
            self.assertEqual(self.lights(f"{change}.obj"), self.lights("plain.obj"), (name, change))
            self.same_picture(f"{change}.obj", "plain.obj")
        for format in ("stl", "ply", "3mf"):
            self.good("convert", "plain.obj", f"plain.{format}", "-q")
            self.assertEqual(self.lights(f"plain.{format}"), self.lights("plain.obj"), (name, format))

    def test_shapes(self):
        for shape in ("teapot", "cube"):
            self.good("shape", shape, "-q", "-o", "shape.obj")
            self.check(shape, self.folder / "shape.obj")

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_models(self):
        for name in ("fish/fish_control_mesh", "kaykit_dungeon/barrel_large", "torus/torus"):
            folder = (SHARED_MODELS / "obj" / name).parent
            for file in folder.iterdir():
                if file.is_file():
                    shutil.copy(file, self.folder)
            self.check(name, SHARED_MODELS / "obj" / f"{name}.obj")

    @unittest.skipUnless(SHARED_CASES.is_dir(), "needs shared/cases")
    def test_plates(self):
        """One plate, its facets in two orders."""
        plates = [SHARED_CASES / "formats" / f"plate-{n}.stl" for n in (0, 3)]
        self.assertEqual(self.lights(plates[0]), self.lights(plates[1]))
        first, second = (self.png(plate, "-s", "256", "-q") for plate in plates)
        self.assertEqual(pixel(first, 128, 128), pixel(second, 128, 128))


class BlackAmbient(Case):
    def model(self, name, ambient):
        (self.folder / f"{name}.mtl").write_text(f"newmtl m\n{ambient}Kd 0.8 0.8 0.8\n")
        text = (ROOT / "tests" / "models" / "cube.obj").read_text().splitlines()
        body = [line for line in text if line.split()[:1] not in (["mtllib"], ["usemtl"])]
        (self.folder / f"{name}.obj").write_text(f"mtllib {name}.mtl\nusemtl m\n" + "\n".join(body) + "\n")
        return f"{name}.obj"

    def under(self, model, *words):
        picture = self.png(model, "--elevation", "-35", "-s", "96", "-q", *words)
        return min(picture[2][i] for i in range(0, len(picture[2]), 4) if picture[2][i + 3] == 255)

    def test_undersides(self):
        """The default lights do not read ka; lights that the user gives do."""
        models = [self.model("none", ""), self.model("black", "Ka 0 0 0\n"), self.model("white", "Ka 1 1 1\n")]
        self.assertGreater(self.under(models[0]), 40)
        self.assertEqual(len({self.under(model) for model in models}), 1)
        for words in (("--rig", "none", "--ambient", "0.5"), ("--light", "hemisphere"), ("--light", "ambient"), ("--rig", "lecture")):
            none, black, white = (self.under(model, *words) for model in models)
            self.assertEqual(black, 0, words)
            self.assertGreater(min(none, white), 20, words)
        self.assertGreater(self.under("black.obj", "--light", "hemisphere:by_diffuse=yes"), 40)

    def test_saved_scenes_and_explanations(self):
        """A saved scene has the same bytes, also with a hemisphere light of each kind; the explanation and the shader name kd."""
        model = self.model("black", "Ka 0 0 0\n")
        for words in ((), ("--light", "+hemisphere:sky=0.3", "--ambient", "0.1"), ("--rig", "three-point")):
            self.good(model, *words, "--elevation", "-35", "-s", "64", "-q", "-o", "a.png", "--save-scene", "s.json")
            self.good("s.json", "-s", "64", "-q", "-o", "b.png")
            self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes(), words)
        self.assertIn("kd ⊙ mix(ground, sky", self.good("explain", model, "48,48", "-s", "96").stdout.decode())
        self.assertIn("mul3(m.diffuse.rgb, hemispheres[i].sky.rgb)", self.good("shader", model).stdout.decode())
        self.assertIn("mul3((i < 1 ? m.ambient.rgb : m.diffuse.rgb), hemispheres[i].sky.rgb)",
                      self.good("shader", model, "--light", "+hemisphere:sky=0.3").stdout.decode())
