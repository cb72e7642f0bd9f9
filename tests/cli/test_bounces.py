# test_bounces.py: --bounces and --paths: closed forms of light between surfaces, equality with local lighting, and hostile scenes.
import json
import math
import struct

from harness import ROOT, Case

BLACK = [0, 0, 0]


def matt(albedo, emission=0):
    return {"diffuse": [albedo] * 3, "specular": BLACK, "emission": [emission] * 3}


def physical(**more):
    return {"physical": True, "diffuse": [1, 1, 1], **more}


GLASS = physical(roughness=0, transmission=1, thickness=1, ior=1.5)
METAL = physical(metallic=1, roughness=0.3)


def mean(values):
    return sum(values) / len(values)


def rms(a, b):
    return math.sqrt(mean([(x - y) ** 2 for x, y in zip(a, b)]))


class Bounces(Case):
    def draw(self, objects, materials, camera, *words, size=24, background=(0, 0, 0, 1), **more):
        """The linear red values of a scene's picture."""
        eye, target, fovy = camera
        scene = {"lambent": 1, "image": {"size": [size, size], "background": background, "tone": "none"}, "ambient": BLACK, "lights": [],
                 "objects": objects, "materials": materials,
                 "camera": {"eye": eye, "target": target, "fovy": fovy, "near": 0.01, "far": 300}, **more}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.good("scene.json", "-q", "-o", "out.pfm", *words, *([] if "--denoise" in words else ["--denoise", "off"]))
        data = (self.folder / "out.pfm").read_bytes()
        return struct.unpack("<%df" % (size * size * 3), data[-size * size * 12:])

    def check_mean(self, values, wanted, case):
        """The mean is within four of its standard errors, and within 0.3 %."""
        values = values[::3]
        mean = sum(values) / len(values)
        error = math.sqrt(sum((v - mean) ** 2 for v in values)) / len(values)
        self.assertLessEqual(abs(mean - wanted), 4 * error + 1e-6 * wanted, (case, mean, wanted, error))
        self.assertLessEqual(abs(mean - wanted), 0.003 * wanted, (case, mean, wanted))

    def test_furnace_of_matt_walls(self):
        """N reflections in a box that emits e everywhere: e (1 + a + … + a^N)."""
        inside = ([0.05, 0.1, 0.12], [0.3, 0.2, -0.1], 60)
        for albedo in (0.2, 0.5, 0.9):
            for bounces in (1, 2, 8):
                values = self.draw([{"shape": "cube", "material": "m"}], {"m": matt(albedo, 0.25)}, inside, "--bounces", bounces, "--paths", 256)
                self.check_mean(values, 0.25 * sum(albedo ** k for k in range(bounces + 1)), (albedo, bounces))

    def test_uniform_sky(self):
        """A convex matt body returns its albedo of a uniform sky; glass and white metal are invisible in it."""
        (self.folder / "white.pfm").write_bytes(b"PF\n8 4\n-1.0\n" + struct.pack("<f", 1) * (8 * 4 * 3))
        skies = {"ambient": ({"ambient": [1, 1, 1]}, matt(0.5), 0.5),
                 "hemisphere": ({"lights": [{"type": "hemisphere", "sky": [1, 1, 1], "ground": [1, 1, 1]}]}, matt(0.5), 0.5),
                 "metal": ({"environment": {"equirectangular": "white.pfm"}}, METAL, 1),
                 "glass": ({"environment": {"equirectangular": "white.pfm"}}, GLASS, 1)}
        for case, (sky, material, wanted) in skies.items():
            values = self.draw([{"shape": "sphere", "material": "m"}], {"m": material}, ([0, 0, 5], BLACK, 10), "--bounces", 12, **sky)
            self.check_mean(values, wanted, case)

    def test_emitters(self):
        """A lamp over a floor, and two parallel plates: (configuration factor) · albedo · emission. A pane of glass before a lamp lets
        (1 − R) / (1 + R) through, with R = 0.04, by all its inner reflections."""
        floor = {"shape": "cube", "material": "floor", "transform": [["translate", 0, -1, 0], ["scale", 100, 1, 100]]}
        lamp = {"shape": "cube", "material": "lamp", "transform": [["translate", 0, 2.05, 0], ["scale", 1, 0.05, 1]]}
        materials = {"floor": matt(0.5), "lamp": matt(0, 1)}
        side = 1 / 2  # of the quarter of the lamp, relative to its height
        factor = 4 / (2 * math.pi) * 2 * side / math.sqrt(1 + side * side) * math.atan(side / math.sqrt(1 + side * side))
        self.check_mean(self.draw([floor, lamp], materials, ([6, 3, 0], BLACK, 0.05), "--bounces", 1, "--paths", 1024), 0.5 * factor, "lamp")
        lamp["transform"] = [["translate", 0, 2.05, 0], ["scale", 100, 0.05, 100]]
        factor = 4 / (2 * math.pi) * 2 * 50 / math.sqrt(2501) * math.atan(50 / math.sqrt(2501))
        self.check_mean(self.draw([floor, lamp], materials, ([1, 1, 0], BLACK, 0.05), "--bounces", 1, "--paths", 1024), 0.5 * factor, "plates")
        pane = {"shape": "cube", "material": "glass", "transform": [["scale", 3, 3, 0.2]]}
        wall = {"shape": "cube", "material": "lamp", "transform": [["translate", 0, 0, -2], ["scale", 9, 9, 1]]}
        values = self.draw([pane, wall], {"glass": GLASS, "lamp": matt(0, 1)}, ([0, 0, 5], BLACK, 0.01), "--bounces", 40, "--paths", 1024)
        self.check_mean(values, (1 - 0.04) / (1 + 0.04), "pane")

    def test_caustics(self):
        """With --caustics, a ball of glass is invisible in a furnace with reflecting walls, and focuses the light of a lamp on the floor."""
        ball = {"shape": "sphere", "material": "glass", "transform": [["scale", 0.4]]}
        room = [{"shape": "cube", "material": "wall"}, ball]
        values = self.draw(room, {"wall": matt(0.5, 0.25), "glass": GLASS}, ([0.5, 0.3, 0.9], [0, -0.4, 0], 70), "--bounces", 40, "--paths", 256, "--caustics")
        self.check_mean(values, 0.5, "furnace")
        scene = [{"shape": "cube", "material": "floor", "transform": [["translate", 0, -1, 0], ["scale", 4, 0.1, 4]]}, ball,
                 {"shape": "cube", "material": "lamp", "transform": [["translate", 0, 6, 0], ["scale", 1, 0.01, 1]]}]
        materials = {"floor": matt(0.8), "glass": GLASS, "lamp": matt(0, 5)}
        under = [sum(self.draw(scene, materials, ([1.5, -0.6, 0], [0, -0.9, 0], 3), "--bounces", 2, "--paths", 512, *words)) for words in ((), ("--caustics",))]
        self.assertGreater(under[1], 2 * under[0])
        self.assertEqual(*(self.draw(scene, materials, ([1.5, 0, 0], [0, -0.5, 0], 60), "--bounces", 2, "--paths", 8, "--caustics", *words) for words in (("-j", 1, "--isa", "scalar"), ("-j", 3))))

    def test_equals_local_lighting(self):
        """One lamp and one reflection is what local lighting computes with shadows, for every model that needs no blur."""
        objects = [{"shape": "torus-knot", "material": "m"},
                   {"shape": "cube", "material": "n", "transform": [["translate", 0, -2, 0], ["scale", 4, 1, 4]]}]
        materials = {"m": {"diffuse": [0.7, 0.31, 0.13], "specular": [0.3, 0.2, 0.9], "shininess": 37, "ambient": BLACK}, "n": matt(0.6)}
        lamps = [{"type": "point", "position": [2, 3, 4], "intensity": 1.3, "attenuation": [1, 0.1, 0.02]},
                 {"type": "spot", "position": [2, 3, 4], "direction": [-2, -3, -4], "inner": 10, "outer": 25},
                 {"type": "directional", "direction": [-1, -2, -1]}]
        for lamp in lamps:
            for model in ("lambert", "phong", "blinn-phong", "oren-nayar", "toon", "gooch", "kajiya-kay"):
                local, traced = (self.draw(objects, materials, ([0, 1, 5], BLACK, 40), "--reflection", model, *words, size=64, lights=[lamp])
                                 for words in (("--shadows",), ("--bounces", 1, "--paths", 16)))
                self.assertEqual(local, traced, (model, lamp["type"]))

    def test_one_picture(self):
        """Threads and instruction sets do not change a byte."""
        words = (ROOT / "examples/cornell.json", "-q", "--bounces", 4, "--paths", 3, "-s", 40, "-o", "-")
        pictures = {self.good(*words, "--threads", threads, "--isa", isa).stdout for threads, isa in ((1, "scalar"), (3, "auto"), (16, "scalar"))}
        self.assertEqual(len(pictures), 1)

    def test_denoise(self):
        """The filter brings 32 paths nearer to 1,024, leaves pixels without noise alone, and is off for many paths and one bounce."""
        def floats(*words, size=48):
            self.good(ROOT / "examples/cornell.json", "-q", "--bounces", 3, "-s", size, "-o", "c.pfm", *words)
            data = (self.folder / "c.pfm").read_bytes()
            return struct.unpack("<%df" % (size * size * 3), data[-size * size * 12:])

        def apart(a, b):
            return sum(abs(min(x, 1) - min(y, 1)) for x, y in zip(a, b)) / len(a)
        truth, noisy, smooth = (floats("--paths", n, "--denoise", how) for n, how in ((1024, "off"), (32, "off"), (32, "auto")))
        self.assertEqual(smooth, floats("--paths", 32, "--denoise", "on"))
        self.assertLess(apart(smooth, truth), 0.65 * apart(noisy, truth))
        self.assertLess(abs(sum(min(v, 1) for v in smooth) / sum(min(v, 1) for v in truth) - 1), 0.03)
        lamp = ([{"shape": "sphere", "material": "m"}], {"m": matt(0, 0.7)}, ([0, 0, 5], BLACK, 40))
        self.assertEqual(*(self.draw(*lamp, "--bounces", 3, "--paths", 8, "--denoise", how) for how in ("on", "off")))
        for words in (("--bounces", 1, "--paths", 4), ("--bounces", 2, "--paths", 1)):
            self.assertEqual(*(self.good("sphere", "-q", *words, "-s", 16, "--denoise", how, "-o", "-").stdout for how in ("auto", "off")))
        values = self.draw([{"shape": "cube", "material": "m"}], {"m": matt(0.5, 1e30)}, ([0.05, 0.1, 0.9], [0.3, 0.2, -0.1], 60),
                           "--bounces", 5, "--paths", 4, "--denoise", "on", size=16)
        self.assertTrue(all(0 <= v < 1.1e31 for v in values))

    def test_passes(self):
        """--noise ends parts of the picture; --stop-after gives the bytes of the paths that it reports; both do not depend on threads."""
        words = (ROOT / "examples/cornell.json", "-q", "--bounces", 2, "-s", "130x70")

        def image(*more):
            return json.loads(self.good(*words, *more, "-o", "p.png", "--json").stdout)["image"], (self.folder / "p.png").read_bytes()
        few, many = image("--paths", 32)[0], image("--paths", 128)[0]
        self.assertEqual([few["paths"], many["paths"]], [32, 128])
        self.assertAlmostEqual(few["noise"] / many["noise"], 2, delta=0.5)
        ended, bytes_of_one = image("--noise", 5, "--paths", 512, "-j", 1, "--isa", "scalar")
        self.assertEqual(bytes_of_one, image("--noise", 5, "--paths", 512, "-j", 3)[1])
        self.assertLessEqual(ended["noise"], 5)
        self.assertTrue(32 <= ended["paths"] < 512, ended)
        self.assertNotEqual(ended["paths"] % 16, 0, "all tiles have the same number of paths")
        stopped, picture = image("--stop-after", 0.5)
        self.assertEqual(picture, image("--paths", int(stopped["paths"]))[1])
        self.assertEqual(stopped["paths"] % 16, 0)
        comment = b"tEXtComment\0%d paths of light, estimated noise %.2f of 255" % (stopped["paths"], stopped["noise"])
        self.assertIn(comment, picture)
        self.assertNotIn(b"tEXtComment", image("--bounces", 0)[1])

    def test_explain(self):
        """The light after each number of reflections adds up to the picture's pixel, within its standard error."""
        words = (ROOT / "examples/cornell.json", "-s", 32, "--bounces", 3, "--paths", 1024)
        self.good(*words, "-q", "--denoise", "off", "-o", "p.pfm")
        data = struct.unpack("<3072f", (self.folder / "p.pfm").read_bytes()[-12288:])
        for x, y in ((6, 16), (16, 2), (27, 22)):
            found = json.loads(self.good("explain", words[0], "%d,%d" % (x, y), *words[1:], "--json").stdout)
            bounces = found["bounces"]
            self.assertEqual((len(bounces), found["paths"]), (4, 1024))
            for c in range(3):
                pixel = data[3 * (32 * (31 - y) + x) + c]
                error = math.sqrt(sum(b["error"][c] ** 2 for b in bounces))
                self.assertLessEqual(abs(sum(b["light"][c] for b in bounces) - pixel), 8 * error + 1e-5, (x, y, c))
            on_ceiling = y == 2 # which the lamp does not light
            self.assertEqual(bounces[1]["light"][0] < bounces[2]["light"][0], on_ceiling, (x, y))
        text = self.good("explain", words[0], "6,16", *words[1:-1], 16).stdout.decode()
        for part in ("belong to local lighting, without --bounces", "light between surfaces: 16 paths", "emission", "standard error"):
            self.assertIn(part, text)

    def test_hostile_scenes(self):
        """No picture contains a NaN, no path is endless, and limits hold."""
        for name, material in {"bright": matt(0.5, 1e30), "mirrors": physical(metallic=1, roughness=0), "glass": GLASS,
                               "white": matt(1, 0.1)}.items():
            objects = [{"shape": "cube", "material": "m"}, {"shape": "sphere", "material": "m", "transform": [["scale", 0.3]]}]
            values = self.draw(objects, {"m": material}, ([0.05, 0.1, 0.9], [0.3, 0.2, -0.1], 60), "--bounces", 200, "--paths", 4, size=16,
                               lights=[{"type": "point", "position": [0.4, 0.4, 0.8]}])
            self.assertTrue(all(0 <= v < 1.1e30 for v in values), name)
        lamps = [{"type": "point", "position": [i % 50 - 25, 9, i // 50 - 25], "color": [1e-4] * 3} for i in range(100000)]
        values = self.draw([{"shape": "sphere", "material": "m"}], {"m": matt(0.5)}, ([0, 0, 5], BLACK, 10), "--bounces", 2, "--paths", 4, size=8, lights=lamps)
        self.assertTrue(all(0 < v < 10 for v in values), "many lights")
        self.bad(4, "scene.json", "--bounces", 1000, "--paths", 65536, "-s", 512, "--time-limit", 0.3, "-o", "late.png", says=("time limit",))

    def test_many_lamps(self):
        """Each point chooses among 1,000 lamps, or 1,000 emitting triangles, by their distances and its normal, so that few paths suffice."""
        floor = {"shape": "cube", "material": "floor", "transform": [["translate", 0, -1, 0], ["scale", 10, 1, 10]]}
        places = [(i % 40 * 0.5 - 9.7 + i * 7 % 11 / 40, 0.2 + i * 5 % 13 / 30, i // 40 * 0.8 - 9.6 + i * 3 % 17 / 40) for i in range(1000)]
        camera = ([0, 0.1, 9], [0, 0, 0], 10)
        lamps = [{"type": "point", "position": p, "color": [0.002 * (1 + i % 5)] * 3, "attenuation": [0, 0, 1]} for i, p in enumerate(places)]
        exact = self.draw([floor], {"floor": matt(0.6)}, camera, lights=lamps)
        values = self.draw([floor], {"floor": matt(0.6)}, camera, "--bounces", 1, "--paths", 64, lights=lamps)
        self.assertLess(rms(values, exact), 0.06 * mean(exact))
        corners = "".join("v %g %g %g\n" % (x + a, y, z + b) for x, y, z in places for a, b in ((-0.01, -0.01), (0.01, -0.01), (0, 0.01)))
        (self.folder / "lamps.obj").write_text(corners + "".join("f %d %d %d\n" % (3 * i + 1, 3 * i + 2, 3 * i + 3) for i in range(1000)))
        objects = [floor, {"file": "lamps.obj", "material": "lamp"}]
        camera = ([0, 0.1, 9], [0, -2, 4], 10)
        exact = self.draw(objects, {"floor": matt(0.6), "lamp": matt(0, 40)}, camera, "--bounces", 1, "--paths", 2048)
        values = self.draw(objects, {"floor": matt(0.6), "lamp": matt(0, 40)}, camera, "--bounces", 1, "--paths", 64)
        self.assertLess(rms(values, exact), 0.06 * mean(exact))

    def test_sheet(self):
        """The cell after the last picture is twice the difference between the third and the last."""
        words = ("compare", "torus-knot", "--sheet", "truth", "-s", 24, "--paths", 2, "--no-captions")
        done = self.good(*words, "-o", "sheet.ppm", "--compress", "fast")
        self.assertNotIn(b"warning", done.stderr)
        data, wide = (self.folder / "sheet.ppm").read_bytes(), 4 * 26 + 2

        def cell(i):
            x, y = 2 + i % 4 * 26, 2 + i // 4 * 26
            rows = data[-3 * wide * (2 * 26 + 2):]
            return [v for row in range(y, y + 24) for v in rows[3 * (row * wide + x):3 * (row * wide + x + 24)]]
        local, paths, apart = cell(2), cell(5), cell(6)
        self.assertEqual(apart, [min(255, 2 * abs(a - b)) for a, b in zip(local, paths)])
        self.assertGreater(max(apart), 50)

    def test_warnings(self):
        """Options of paths say that they need --bounces, unless a picture without bounces is asked for."""
        for words in (("--paths", 8), ("--noise", 3), ("--stop-after", 1), ("--denoise", "on"), ("--caustics",)):
            done = self.good("cube", "-s", 16, *words, "-o", "a.png")
            self.assertIn("option '%s' has no effect without --bounces" % words[0], done.stderr.decode())
            self.assertNotIn(b"warning", self.good("cube", "-s", 16, *words, "--bounces", 0, "-o", "a.png").stderr)
        for words, warns in ((("--light", "point:position=1/2/3"), True), (("--environment", "studio", "--rig", "none"), False)):
            done = self.good("cube", "-s", 16, "--material", "glass", "--bounces", 2, "--paths", 1, "--caustics", *words, "-o", "a.png")
            self.assertEqual(b"lamps shed no light through glass" in done.stderr, warns, words)

    def test_refusals(self):
        self.bad(1, "sphere", "--bounces", 1, "--shading", "gouraud", "-o", "a.png", says=("bounces needs Phong shading",))
        self.bad(1, "sphere", "--bounces", 1, "--gl1", "-o", "a.png", says=("cannot be combined with bounces",))
        self.bad(1, "sphere", "--bounces", 1001, "-o", "a.png", says=("1000",))
        # Values of surfaces need no paths, and the paths have no effect on them.
        self.assertEqual(self.good("sphere", "--bounces", 2, "--show", "normals", "-s", 16, "-q", "-o", "-").stdout,
                         self.good("sphere", "--show", "normals", "-s", 16, "-q", "-o", "-").stdout)
