# test_sections.py: --section: areas, cut surfaces and messages.
import json
import math
import struct

from harness import Case, pixel, read_png

FRONT = ("--view", "front", "--projection", "orthographic", "-s", "256")


def box(low, high, inward=False):
    """The 12 triangles of a box, as nine numbers each."""
    corner = lambda i: tuple((low, high)[i >> k & 1][k] for k in range(3))  # noqa: E731
    for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        for triangle in ((a, b, c), (a, c, d)):
            yield sum(map(corner, reversed(triangle) if inward else triangle), ())


def stl(*solids):
    triangles = [t for solid in solids for t in solid]
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(struct.pack("<12fH", 0, 0, 0, *t, 0) for t in triangles)


def obj(**parts):
    """An OBJ file with a group for each list of triangles."""
    lines, n = [], 0
    for name, triangles in parts.items():
        lines.append("g " + name)
        for t in triangles:
            lines += ["v %g %g %g" % t[i:i + 3] for i in (0, 3, 6)] + ["f %d %d %d" % (n + 1, n + 2, n + 3)]
            n += 3
    return "\n".join(lines) + "\n"


OUTER, INNER = ((-2, -2, -2), (2, 2, 2)), ((-1, -1, -1), (1, 1, 1))
HOLES = [((-1.5 + 1.1 * i, -1.5 + 1.1 * j, -1.9), (-0.8 + 1.1 * i, -0.8 + 1.1 * j, 1.5)) for i in range(3) for j in range(3)]


class Sections(Case):
    def file(self, name, data):
        (self.folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
        self.given.add(name)
        return name

    def area(self, model, *sections):
        words = [w for s in sections for w in ("--section", s)]
        return [s["area"] for s in json.loads(self.good("info", model, "--json", *words).stdout)["sections"]]

    def test_areas(self):
        """Five bodies with known areas. (The built-in shapes are fine polyhedra; the torus has the radii 1 − r and r.)"""
        hollow = self.file("hollow.stl", stl(box(*OUTER), box(*INNER, inward=True)))
        tube = 1 - json.loads(self.good("info", "torus", "--json").stdout)["bounds"]["max"][1]
        rows = [("sphere", "z=0.1", math.pi * 0.99), ("sphere", "normal=1/2/3,distance=-0.5", math.pi * 0.75),
                ("torus", "y=0", math.pi * (1 - (2 * tube - 1) ** 2)), ("torus", "x=0", 2 * math.pi * (1 - tube) ** 2),
                ("cylinder", "y=20%", math.pi), (hollow, "z=0.1", 12), (hollow, "z=10%", 16), (hollow, "normal=1/1/1,distance=0", 9 * math.sqrt(3)),
                (self.file("holes.stl", stl(box(*OUTER), *(box(*h, inward=True) for h in HOLES))), "-z=0", 16 - 9 * 0.49),
                (self.file("flipped.stl", stl(box(*OUTER, inward=True))), "x=0", 16),
                (self.file("union.stl", stl(box(*OUTER), box(*INNER))), "x=0", 16),
                (self.file("parts.obj", obj(case=box(*OUTER), battery=box(*INNER))), "x=0", 16)]
        for model, section, area in rows:
            self.assertLess(abs(self.area(model, section)[0] / area - 1), 1e-3, (model, section))
        self.assertEqual([round(a, 6) for a in self.area(hollow, "z=0.1", "x=0")], [12, 2.1 * 4 - 1.1 * 2])

    def test_picture_agrees(self):
        """Depth, object numbers and cover of a cut surface seen from the front, and its area."""
        model = self.file("hollow.stl", stl(box(*OUTER), box(*INNER, inward=True)))
        words = (model, *FRONT, "--up", "y", "--samples", "1", "--section", "z=0.25,color=#ff0000")
        pixels = [(x, y) for x in range(256) for y in range(256)]
        count = lambda picture, is_one: sum(bool(is_one(pixel(picture, x, y))) for x, y in pixels)  # noqa: E731
        seen = count(self.png(*words), lambda p: p[3])
        red = count(self.png(*words, "--rig", "none", "--ambient", "1", "--tone", "none"), lambda p: p[:3] == (255, 0, 0))
        self.assertLess(abs(red / seen - self.area(model, "z=0.25")[0] / 16), 0.01)
        depth = self.png(*words, "--show", "depth")
        near = max(pixel(depth, x, y)[0] for x, y in pixels if pixel(depth, x, y)[3])
        self.assertEqual(count(depth, lambda p: p[3] and p[0] == near), red)
        self.assertEqual(count(self.png(*words, "--show", "ids"), lambda p: p[3]), seen)
        shadow = lambda section: self.png(model, "-s", "64", "--up", "z", "--ground", "--section", section)  # noqa: E731
        dark = [sum(p == 0 and a for p, a in zip(data[0::4], data[3::4])) for _, _, data in (shadow("z=2"), shadow("z=-1"))]
        self.assertGreater(dark[0], 2 * dark[1]) # the shadow of a cut model is shorter

    def test_parts(self):
        """Each part has its own cut surface, with its name; one body of two materials has one."""
        parts = self.file("parts.obj", "mtllib m.mtl\n" + obj(case=box(*OUTER), battery=box(*INNER)).replace("g battery", "g battery\nusemtl red"))
        self.file("m.mtl", "newmtl red\nKd 1 0 0\n")
        words = (parts, *FRONT, "--section", "z=0.5", "--rig", "none", "--ambient", "1", "--tone", "none", "--brighten", "off")
        middle = pixel(self.png(*words, "--material", "ambient=1/0/0@battery"), 128, 128)
        self.assertEqual(middle[:3], (255, 0, 0))
        self.assertNotEqual(pixel(self.png(*words, "--hide", "battery"), 128, 128)[:3], (255, 0, 0))
        halves = list(box(*OUTER))
        self.assertEqual(self.area(self.file("halves.obj", obj(a=halves[:5], b=halves[5:])), "normal=1/1/0,distance=0.3"),
                         self.area(self.file("one.obj", obj(a=halves)), "normal=1/1/0,distance=0.3"))

    def test_warnings(self):
        lid = self.file("open.stl", stl(list(box(*OUTER))[1:]))
        for model, section, note in ((lid, "x=0", "has holes"), ("teapot", "x=0", "has holes"), ("sphere", "x=3", "removes nothing"),
                                     ("sphere", "-z=0", "removes the other side"),
                                     (self.file("l.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n"), "x=0.1", "lines and points")):
            warnings = self.report(model, "-s", "32", "--section", section, "-o", "a.png")["warnings"]
            self.assertEqual([note in w for w in warnings].count(True), 1, (model, warnings))
        self.assertEqual(self.area(lid, "x=0"), [0])
        warnings = self.report("sphere", "-s", "32", "--section", "x=0", "--opacity", "0.5", "-o", "a.png")["warnings"]
        self.assertIn("transparent", " ".join(warnings))
        self.bad(1, "sphere", "--section", "x=-3", says=("remove the whole model",))
        for wrong in ("q=1", "q", "x=", "x=1k", "x=nan", "normal=0/0/0", "normal=1/2", "x=0,y=0", "x=0,color=quux", "distance=3", "normal=1/0/0,normal=0/1/0"):
            self.bad(1, "sphere", "--section", wrong, says=("--section",))
        self.bad(1, "sphere", *("--section", "x=0") * 9, says=("at most 8",))

    def test_scene_file(self):
        """A saved scene file draws the same bytes; its sections can be replaced."""
        for words in (("--section", "x=0"), ("--section", "z=40%,color=orange", "--section", "-x=-0.2", "--edges", "crease"), ("--section", "y=10%", "--rotate", "x:30")):
            first = self.png("torus", "-s", "96", *words, "--save-scene", "saved.json")
            self.given.add("saved.json")
            self.assertEqual(self.png("saved.json"), first)
        scene = {"lambent": 1, "image": {"size": [64, 64]}, "sections": ["x=0", "z=50%"], "objects": [{"shape": "torus"}, {"shape": "sphere", "transform": [["scale", 0.4]]}]}
        self.file("a.json", json.dumps(scene))
        both = self.png("a.json")
        self.assertEqual(self.png("a.json", "--section", "x=0", "--section", "z=50%"), both)
        whole = self.png("a.json", "--section", "none")
        self.file("b.json", json.dumps({**scene, "sections": []}))
        self.assertEqual(self.png("b.json"), whole)
        self.assertNotEqual(whole, both)
        for wrong, place in (("q", "sections"), (["x=0", 3], "sections[1]"), (["x=0"] * 9, "sections")):
            self.file("c.json", json.dumps({**scene, "sections": wrong}))
            self.bad(2, "c.json", says=(place,))

    def test_convert(self):
        self.file("hollow.stl", stl(box(*OUTER), box(*INNER, inward=True)))
        self.good("convert", "hollow.stl", "half.stl", "--section", "x=0.5", "--section", "normal=0/1/1,distance=0.1")
        measure = json.loads(self.good("info", "half.stl", "--json").stdout)["measure"]
        self.assertTrue(measure["closed"])
        self.given.add("half.stl")

    def test_several_pictures(self):
        """Views, a turntable and a batch draw the pictures that are drawn alone."""
        words = ("torus", "-s", "48", "--section", "x=0")
        self.good(*words, "--view", "top,front", "-o", "v-{view}.png")
        self.good(*words, "--turntable", "4", "-o", "t-{frame}.png")
        self.good("batch", *words, "-o", "b-{stem}.png", "--journal", "none")
        for name, more in (("v-front.png", ("--view", "front")), ("b-torus.png", ()), ("t-1.png", ("--rotate", "y:90", "-o", "-"))):
            drawn = (self.folder / name).read_bytes()
            if name[0] != "t": # a turntable fits the camera to all of its frames
                self.assertEqual(read_png(drawn), self.png(*words, *more), name)
        frames = [read_png((self.folder / f"t-{i}.png").read_bytes()) for i in range(4)]
        self.assertEqual(len(set(map(str, frames))), 4)


class Parts(Case):
    """--only and --explode, which treat each part as an object."""

    def setUp(self):
        super().setUp()
        text = "mtllib m.mtl\n" + obj(case=box(*OUTER), lid=box((-2, 2, -2), (2, 2.4, 2)), foot=box((3, -2.4, -1), (3.5, -2, 0))).replace("g foot", "g foot\nusemtl red")
        (self.folder / "a.obj").write_text(text)
        (self.folder / "m.mtl").write_text("newmtl red\nKd 1 0 0\n")
        self.given.update(("a.obj", "m.mtl"))

    def test_only(self):
        (self.folder / "lid.obj").write_text(obj(lid=box((-2, 2, -2), (2, 2.4, 2))))
        self.given.add("lid.obj")
        words = ("-s", "64", "--up", "y", "--rig", "headlight")
        self.assertEqual(self.png("a.obj", *words, "--only", "lid"), self.png("lid.obj", *words))
        self.assertEqual(self.png("a.obj", *words, "--only", "red"), self.png("a.obj", *words, "--only", "foot"))
        self.assertEqual(self.png("a.obj", *words, "--only", "case", "--only", "lid", "--only", "foot"), self.png("a.obj", *words))
        self.bad(1, "a.obj", "--only", "lit", says=("--only", "lid"))

    def test_explode(self):
        words = ("-s", "64", "--rig", "headlight")
        self.assertEqual(self.png("a.obj", *words, "--explode", "0"), self.png("a.obj", *words))
        whole, apart = (self.png("a.obj", *FRONT[:-1], "96", *more) for more in ((), ("--explode", "y=1")))
        rows = [sum(any(picture[2][4 * (y * 96 + x) + 3] for x in range(96)) for y in range(96)) for picture in (whole, apart)]
        self.assertGreater(rows[0], 70)
        self.assertLess(sum(any(apart[2][4 * (y * 96 + x) + 3] for x in range(30, 60)) for y in range(96)), rows[1])  # a gap below the lid
        self.assertIn("only one part", self.report("torus", "-s", "8", "--explode", "1", "-o", "a.png")["warnings"][0])
        for wrong in ("-1", "x", "w=1", "nan", "1001"):
            self.bad(1, "a.obj", "--explode", wrong, says=("--explode",))

    def test_metal_on_one_part(self):
        """A physical material on one part leaves the parts without a material lit."""
        picture = self.png("a.obj", "-s", "64", "--material", "gold@lid")
        self.assertGreater(pixel(picture, 24, 40)[0], 60)


class Several(Case):
    """Several models in one picture: a.stl + b.stl."""

    def setUp(self):
        super().setUp()
        self.given.update(("a.stl", "b.obj"))
        (self.folder / "a.stl").write_bytes(stl(box((0, 0, 0), (1, 1, 2))))
        (self.folder / "b.obj").write_text(obj(b=box((0, 0, 0), (1, 3, 1))))

    def size(self, *words):
        found = json.loads(self.good("info", *words, "--json").stdout)
        return [round(x, 6) for x in found["size"]]

    def test_places(self):
        gap = 0.15 * 3
        for words, size in ((("a.stl", "+", "a.stl"), [2 + 0.3, 1, 2]), (("a.stl", "+", "b.obj"), [2 + gap, 1, 3]), (("b.obj", "+", "a.stl"), [2 + gap, 3, 1]),
                            (("a.stl", "+", "a.stl", "+", "a.stl", "--arrange", "grid"), [2.3, 2.3, 2]), (("a.stl", "+", "b.obj", "--arrange", "as-is"), [1, 3, 2]),
                            (("sphere", "+", "cube"), [4.3, 2, 2])):
            self.assertEqual(self.size(*words), size, words)

    def test_pictures(self):
        words = ("-s", "64", "-b", "white", "--camera", "eye=4/5/6,target=0.5/0.5/0.5")
        both = self.png("a.stl", "+", "b.obj", "--arrange", "as-is", *words)
        self.assertEqual(self.png("b.obj", "+", "a.stl", "--arrange", "as-is", "--up", "z", *words), self.png("a.stl", "+", "b.obj", "--arrange", "as-is", "--up", "z", *words))
        scene = {"lambent": 1, "up": "z", "objects": [{"file": "a.stl"}, {"file": "b.obj"}]}
        (self.folder / "s.json").write_text(json.dumps(scene))
        self.given.add("s.json")
        self.assertEqual(self.png("s.json", *words), both)
        self.good("a.stl", "+", "b.obj", "-s", "8")
        self.assertIn("a.png", self.new_files())
        self.good("convert", "a.stl", "+", "b.obj", "c.glb")

    def test_refused(self):
        self.bad(2, "a.stl", "+", "c.stl", says=("c.stl",))
        self.bad(2, "a.stl", "+", says=("+",))
        self.bad(3, "a.stl", "+", "b.obj", "--save-scene", "s.json", "-o", "a.png", says=("scene file",), leaves={"a.png"})


class Print(Case):
    """info --print: what prevents a model from being printed."""

    def check(self, data, code, *words):
        (self.folder / "p.stl").write_bytes(data)
        self.given.add("p.stl")
        done = self.run_program("info", "p.stl", "--print", "--json", *words)
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)["print"]

    def test_findings(self):
        whole = list(box((0, 0, 0), (1, 2, 3)))
        turned = [whole[0][3:6] + whole[0][0:3] + whole[0][6:9]]
        for triangles, code, expected in (
                (whole, 0, {"printable": True, "holes": 0, "volume": 6, "center_of_mass": [0.5, 1, 1.5], "overhang_area": 0}),
                (whole[2:], 6, {"holes": 1, "open_edges": 4, "center_of_mass": None, "longest_holes": [{"middle": [0.5, 1, 0], "length": 6, "edges": 4}]}),
                (whole[1:-1], 6, {"holes": 2, "open_edges": 6}),
                (turned + whole[1:], 6, {"turned_edges": 3, "open_edges": 0, "printable": False}),
                (whole + whole[:1], 6, {"shared_edges": 3}),
                (list(box((0, 0, 0), (1, 2, 3), inward=True)), 6, {"printable": False, "volume": -6, "open_edges": 0}),
                (whole + list(box((0, 0, 4), (1, 1, 5))), 0, {"overhang_area": 1, "volume": 7})):
            found = self.check(stl(triangles), code)
            self.assertEqual({key: found[key] for key in expected}, expected)

    def test_overhang_and_text(self):
        sphere = json.loads(self.run_program("info", "sphere", "--print", "--json", "--overhang", "60").stdout)["print"]
        self.assertAlmostEqual(sphere["overhang_area"], 2 * math.pi * (1 - math.sin(math.radians(60))), 2)
        text = self.run_program("info", "teapot", "--print").stdout.decode()
        self.assertIn("6 holes: 512 edges of only one face", text)
        self.assertIn("can be printed", self.good("info", "torus", "--print").stdout.decode())
        self.bad(1, "info", "sphere", "--print", "--overhang", "91", says=("--overhang",))
        self.bad(1, "sphere", "--print", says=("--print",))
