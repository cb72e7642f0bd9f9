# test_edges.py: --wireframe, --edges and related options.
import json
import math

from harness import Case, pixel

QUAD = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"
FRONT = ("-s", "64", "-b", "white", "--azimuth", "0", "--elevation", "0")


class Edges(Case):
    def model(self, name="quad.obj", text=QUAD):
        (self.folder / name).write_text(text)
        return name

    def test_polygons_have_no_diagonals(self):
        plain = self.png(self.model(), *FRONT)
        lines = self.png(self.model(), *FRONT, "--wireframe")
        self.assertNotEqual(lines, plain)
        self.assertEqual(pixel(lines, 32, 32), pixel(plain, 32, 32))
        cut = self.png(self.model("cut.obj", QUAD.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4")), *FRONT, "--wireframe")
        self.assertLess(pixel(cut, 32, 32)[0], pixel(plain, 32, 32)[0])

    def test_lines_alone(self):
        alone = self.png(self.model(), *FRONT, "--wireframe", "--surfaces", "off")
        self.assertEqual(pixel(alone, 32, 32), (255, 255, 255, 255))
        self.assertEqual(self.png(self.model(), *FRONT, "--edges", "boundary", "--edge-width", "1", "--surfaces", "off"), alone)
        dark = self.png(self.model(), *FRONT, "-b", "black", "--edges", "all", "--surfaces", "off")
        self.assertEqual(pixel(dark, 32, 32), (0, 0, 0, 255))
        self.assertEqual(max(pixel(dark, x, 32)[0] for x in range(64)), 255)

    def test_keys(self):
        """Keys in the value have the effect of the options that they replace, also over a scene file's settings and in a look."""
        model, old = self.model(), ("--edges", "crease,boundary", "--edge-width", 3, "--edge-color", "0.5/0/0/0.5", "--edge-angle", 20)
        drawn = self.png(model, *FRONT, *old)
        keys = "crease,boundary,width=3,color=0.5/0/0/0.5,angle=20"
        self.assertEqual(self.png(model, *FRONT, "--edges", keys), drawn)
        self.assertEqual(self.png(model, *FRONT, "--edges=color=0.5/0/0/0.5,angle=20,crease,width=3,boundary"), drawn)
        self.assertEqual(self.png(model, *FRONT, "--edges", "width=2"), self.png(model, *FRONT, "--edges", "all", "--edge-width", 2))
        wire = self.png(model, *FRONT, "--wireframe", "--wireframe-width", 2, "--wireframe-color", "red")
        for words in (("-w", "width=2,color=red"), ("--wireframe", "color=red,width=2"), ("--wireframe=width=2,color=red",)):
            self.assertEqual(self.png(*words, model, *FRONT), wire)
            self.assertEqual(self.png(model, *FRONT, *words), wire)
        (self.folder / "a.json").write_text(json.dumps({"lambent": 1, "edges": ["crease"], "edge_width": 9, "objects": [{"file": model}]}))
        (self.folder / "own.look").write_text("edges crease,boundary,width=3,color=0.5/0/0/0.5,angle=20\n")
        self.given.update(("a.json", "own.look"))
        self.assertEqual(self.png("a.json", *FRONT, "--edges", keys), self.png("a.json", *FRONT, *old))
        self.assertEqual(self.png(model, *FRONT, "--look", "own.look"), drawn)
        listed = self.good("--help").stdout.decode()
        for hidden in ("edge-width", "wireframe-color", "one-sided", "shininess", "opacity", "reflectivity", "turntable-light"):
            self.assertNotIn(f" --{hidden} ", listed)

    def test_scene_file(self):
        edges = {"wireframe": True, "edges": ["crease", "silhouette"], "edge_color": [1, 0, 0, 1], "edge_width": 2, "edge_angle": 30, "hidden_lines": "dash",
                 "surfaces": False}
        scene = {"lambent": 1, "image": {"size": [96, 96]}, **edges, "objects": [{"file": self.model()}, {"shape": "cube"}]}
        (self.folder / "a.json").write_text(json.dumps(scene))
        first = self.png("a.json", "--save-scene", "saved.json")
        saved = json.loads((self.folder / "saved.json").read_text())
        self.assertEqual({key: saved.get(key) for key in edges}, edges)
        self.assertEqual(self.png("saved.json"), first)
        self.assertNotEqual(self.png("a.json", "--hidden-lines", "remove"), first)
        self.assertNotEqual(self.png("a.json", "--surfaces", "on"), first)
        for key, value, says in (("edges", ["corner"], "crease"), ("edges", "crease", "crease"), ("hidden_lines", "dots", "dash"), ("edge_width", 0, "edge_width")):
            (self.folder / "b.json").write_text(json.dumps({**scene, key: value}))
            self.bad(2, "b.json", says=says, leaves=["saved.json"])

    def test_reported(self):
        answer = json.loads(self.good("cube", "-s", "64", "--edges", "all", "--json", "-o", "c.png").stdout)
        self.assertGreater(answer["times_ms"]["steps"]["edges"], 0)
        self.assertEqual(self.good("cube", "-s", "64", "--edges", "all", "--surfaces", "off", "-o", "d.png").stderr.count(b"\n"), 1)  # no warning

    def test_specks_are_left_out(self):
        """A crease of a few pixels alone is dirt, in a larger picture it is a line; of slivers it is dirt at any length that is seen."""
        plate = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"

        def tent(length, width):  # two faces upon a ridge along x, 45 degrees down on either side
            ridge = [(-length / 2, 0, 0.5), (length / 2, 0, 0.5)]
            sides = [(x, y, 0.5 - width) for y in (-width, width) for x in (-length / 2, length / 2)]
            return plate + "".join("v %g %g %g\n" % p for p in ridge + sides) + "f 5 7 8 6\nf 6 10 9 5\n"
        front = ("-b", "white", "--azimuth", "0", "--elevation", "0")
        for name, length, width, size, drawn in (("tent.obj", 0.1, 0.1, 100, False), ("tent.obj", 0.1, 0.1, 400, True), ("long.obj", 1, 0.1, 100, True), ("sliver.obj", 1, 0.002, 100, False)):
            model = self.model(name, tent(length, width))
            with self.subTest(name, size=size):
                self.assertEqual(self.png(model, "-s", size, *front) != self.png(model, "-s", size, *front, "--edges", "crease"), drawn)
        # A short edge in the middle of a long line stays.
        edges = [(i / 40 - 0.5, 0, 0.5) for i in range(41)]
        text = plate + "".join("v %g %g %g\nv %g -0.2 0.3\nv %g 0.2 0.3\n" % (*p, p[0], p[0]) for p in edges)
        text += "".join("f %d %d %d %d\nf %d %d %d %d\n" % (a, a + 1, a + 4, a + 3, a + 3, a + 5, a + 2, a) for a in range(5, 125, 3))
        line = self.png(self.model("many.obj", text), "-s", 100, *front, "--edges", "crease", "--surfaces", "off")
        self.assertGreater(sum(line[2][4 * (50 * 100 + x)] < 200 or line[2][4 * (49 * 100 + x)] < 200 for x in range(100)), 30)

    def test_dashes_run_along_curves(self):
        """A hidden circle of 360 edges, each shorter than a dash, has dashes along its whole length."""
        ring = [(math.cos(math.radians(a)), math.sin(math.radians(a))) for a in range(360)]
        text = "v 0 0 0\n" + "".join("v %.9f %.9f 0\n" % p for p in ring) + "".join("f 1 %d %d\n" % (i + 2, (i + 1) % 360 + 2) for i in range(360))
        text += "v -2 -2 1\nv 2 -2 1\nv 2 2 1\nv -2 2 1\nf 362 363 364 365\n"
        model, words = self.model("ring.obj", text), ("-s", "400", "-b", "white", "--azimuth", "0", "--elevation", "0", "--projection", "orthographic", "--edges", "boundary",
                                                      "--surfaces", "off", "--edge-width", "2")
        camera = self.report(model, *words, "-o", "r.png")["camera"]
        radius = 200 / camera["ortho_half_height"]

        def dark(*more):
            picture = self.png(model, *words, *more)
            around = [math.radians(a / 4) for a in range(1440)]
            return [pixel(picture, int(200 + radius * math.cos(a)), int(200 + radius * math.sin(a)))[0] < 128 for a in around]
        self.assertFalse(any(dark()))
        self.assertTrue(all(dark("--hidden-lines", "show")))
        dashes = dark("--hidden-lines", "dash")
        wanted = 2 * math.pi * radius / (8 * 2)
        starts = sum(now and not before for before, now in zip([dashes[-1]] + dashes, dashes))
        self.assertAlmostEqual(starts, wanted, delta=3)
        self.assertAlmostEqual(sum(dashes) / len(dashes), 5 / 8, delta=0.1)

    def test_lines_alone_have_no_ground(self):
        alone = ("teapot", "-s", "64", "--edges", "all", "--surfaces", "off")
        for ground in ("shadow", "checker", "red"):
            self.assertEqual(self.png(*alone, "--ground=" + ground), self.png(*alone), ground)
        answer = json.loads(self.good(*alone, "--ground", "--json", "-o", "g.png").stdout)
        self.assertEqual(answer["image"].get("ground_height"), None)

    def test_mistakes(self):
        self.bad(1, "cube", "--edges", "corners", says="crease")
        self.bad(1, "cube", "--edge-width", "0", says="--edge-width")
        self.bad(1, "cube", "--edges", "width=0", says="option '--edges': width: found '0'")
        self.bad(1, "cube", "--edges", "all,widht=2", says="found 'widht=2', expected angle=DEGREES, width=PIXELS, color=COLOR")
        self.bad(1, "cube", "--edges", "all,color=nocolor", says="option '--edges': color: found 'nocolor'")
        self.bad(1, "cube", "--wireframe=red", says="option '--wireframe': found 'red', expected width=PIXELS")
        self.bad(1, "cube", "--wireframe-color", "nocolor", says="nocolor")

    def test_opengl_has_the_same_lines(self):
        if not [d for d in json.loads(self.good("devices", "--json").stdout)["gl"] if d["reason"] is None]:
            self.skipTest("no OpenGL here")
        words = ("teapot", "--segments", "16", "-s", "96", "-b", "white", "--wireframe", "--edges", "all", "--hidden-lines", "dash", "--surfaces", "off")
        self.assertEqual(self.png(*words, "--device", "gl"), self.png(*words, "--device", "cpu"))
