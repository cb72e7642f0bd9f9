# test_materials.py: materials and methods of shading from the command line.
import json
import math
import os
import shutil

from harness import ROOT, pixel, read_png
from test_lights import DIFFUSE_ONLY, Pictures, difference


class Materials(Pictures):
    def test_named(self):
        brass = "ambient=0.329412/0.223529/0.027451,diffuse=0.780392/0.568627/0.113725,specular=0.992157/0.941176/0.807843,shininess="
        self.same(("--material", "brass", "--color-mode", "raw"), ("--material", brass + "27.89743616", "--color", "raw"))
        # Published values are display values, so they are decoded unless --color-mode raw is given.
        self.same(("--material", "red-rubber"), ("--material", "ambient=0.00393594/0/0,diffuse=0.2140411/0.1328683/0.1328683,"
                                                 "specular=0.4479884/0.00309598/0.00309598,shininess=10"))
        (self.folder / "named.json").write_text('{"lambent": 1, "objects": [{"shape": "sphere", "material": "red-rubber"}]}')
        for mode in ("srgb", "raw"):
            words = ("--color", mode, "--view", "front")
            self.assertEqual(self.picture(*words, model="named.json"), self.picture(*words, "--material", "red-rubber"))
        self.same(("--material", "Black_Plastic"), ("--material", "black-plastic"))
        self.same(("--material", "gold,shininess=5"), ("--material", "gold", "--shininess", "5"))
        self.other(("--material", "gold"), ("--material", "ruby"))

    def test_keys(self):
        self.same(("--material", "ambient=0.62,diffuse=0.62,specular=0.12,shininess=32,emission=0"), ())  # the default values
        self.same(("--material", "color=1/0.5/0,ka=0.2,kd=0.8,specular_color=1,ks=0.3"),
                  ("--material", "ambient=0.2/0.1/0,diffuse=0.8/0.4/0,specular=0.3"))
        self.same(("--material", "kd=0.5"), ("--material", "diffuse=0.31"))
        self.same(("--material", "color=red,ambient=0"), ("--material", "diffuse=red,ambient=0"))
        self.same(("--material", "shininess=5"), ("--shininess", "5"))
        glow = self.picture("--material", "ambient=0,diffuse=0,specular=0,emission=0.5", "--color-mode", "raw")
        self.assertEqual(pixel(glow, 32, 32), (128, 128, 128, 255))
        self.other(("--material", "fibre", "--reflection", "kajiya-kay"), ("--reflection", "kajiya-kay"))
        self.same(("--material", "fibre=no", "--reflection", "kajiya-kay"), ("--reflection", "kajiya-kay"))

    def test_by_name(self):
        (self.folder / "two.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng left\nf 1 2 3\ng right\nf 2 4 3\n")
        words = ("--view", "front", "--reflection", "none", "--color-mode", "raw")
        picture = self.picture(*words, "--material", "diffuse=0/0/1", "--material", "diffuse=1/0/0@right", model="two.obj")
        self.assertEqual((pixel(picture, 20, 44), pixel(picture, 44, 20)), ((0, 0, 255, 255), (255, 0, 0, 255)))
        named = self.picture(*words, "--material", "gold", "--material", "ruby@left", model="two.obj")
        self.assertEqual((pixel(named, 20, 44)[:3], pixel(named, 44, 20)[:3]), ((157, 11, 11), (192, 155, 58)))
        self.bad(1, "two.obj", "--material", "gold@rigth", says=["no object, part or material 'rigth'", "did you mean 'right'?"], leaves={"two.obj"})
        self.same(("--material", "gold@sphere"), ("--material", "gold"))

    def test_materials_of_glb(self):
        """The model's opaque materials become transparent, and the name of a metal also replaces its textures."""
        spot = os.path.join(ROOT, "examples", "models", "spot.glb")
        self.assertEqual(pixel(self.picture(model=spot), 32, 32)[3], 255)
        self.assertIn(pixel(self.picture("--opacity", "0.5", model=spot), 32, 32)[3], range(100, 156))
        for x, y in ((32, 32), (26, 36), (36, 40)):
            red, green, blue, _ = pixel(self.picture("--material", "gold", "--look", "studio", model=spot), x, y)
            self.assertTrue(red >= green > blue and red > 40, (x, y, red, green, blue))

    def test_ambient_is_diffuse(self):
        self.same(("--ambient", "1", "--material", "diffuse=0.3/0.2/0.1,ambient=diffuse"), ("--ambient", "1", "--material", "color=0.3/0.2/0.1"))
        (self.folder / "black.mtl").write_text("newmtl a\nKa 0 0 0\nKd 0.7 0.7 0.7\n")
        (self.folder / "black.obj").write_text("mtllib black.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertGreater(pixel(self.picture("--look", "technical", "--view", "front", model="black.obj"), 25, 40)[0], 150)

    def test_color(self):
        """A colour alone is a valid material, and --color sets the colour of every material."""
        for color in ("red", "#ff8800", "0.2/0.4/0.1"):
            wanted = ("--material", "color=" + color)
            self.same(("--color", color), wanted)
            self.same(("--material", color), wanted)
            self.same(("--material", color + ",shininess=90"), ("--material", f"color={color},shininess=90"))
            self.same(("--material", color + "@sphere"), wanted)
            self.same(("--back-material", color, "--view", "back"), ("--back-material", "color=" + color, "--view", "back"))
            self.same(("--material", "gold", "--color", color), ("--material", "gold,color=" + color))
            self.other(("--color", color), ())
        top = pixel(self.picture("--color", "red"), 32, 20)
        self.assertEqual((top[0] > 150, top[1] < 90, top[2] < 90), (True, True, True), top)
        self.same(("--rig", "studio", "--material", "silver"), ("--rig", "studio", "--material", "silver,opacity=1"))  # the material, not the HTML colour
        self.other(("--material", "silver"), ("--color", "silver"))
        # Every material of a model; a warning appears if colours of the model multiply.
        picture = self.picture("--color", "#00ff00", "--light", "none", "--ambient", "1", "--view", "front", model="cube.obj")
        self.assertEqual(pixel(picture, 32, 32)[:3], (0, 255, 0))
        ply = "ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(
            f"property {kind} {name}\n" for kind, names in (("float", "xyz"), ("uchar", ("red", "green", "blue"))) for name in names)
        (self.folder / "own.ply").write_text(ply + "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                             "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n")
        self.assertIn("the model's own colours multiply", self.report("own.ply", "-s", 16, "--color", "white", "-o", "own.png")["warnings"][0])
        self.assertEqual(self.report("own.ply", "-s", 16, "--material", "ruby", "-o", "own.png")["warnings"], [])

    def test_back(self):
        (self.folder / "one.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        words = ("--reflection", "none", "--color-mode", "raw", "--material", "diffuse=0/0/1", "--back-material", "diffuse=1/0/0", "--view")
        self.assertEqual(pixel(self.picture(*words, "front", model="one.obj"), 20, 44), (0, 0, 255, 255))
        self.assertEqual(pixel(self.picture(*words, "back", model="one.obj"), 44, 44), (255, 0, 0, 255))
        lit = ("--light", "directional:frame=camera", "--shininess", "3", "--view", "back")
        self.assertEqual(self.picture(*lit, "--back-material", "emission=0", model="one.obj"), self.picture(*lit, model="one.obj"))
        # With the unchanged normal, back faces are dark; with culling, they disappear.
        dark = self.picture(*lit, "--one-sided", *DIFFUSE_ONLY, model="one.obj")
        self.assertEqual(pixel(dark, 44, 44), (0, 0, 0, 255))
        self.assertEqual(dark, self.picture(*lit, "--back-faces", "one-sided", *DIFFUSE_ONLY, model="one.obj"))
        self.assertEqual(self.picture(*lit, "--two-sided", model="one.obj"), self.picture(*lit, model="one.obj"))
        self.assertEqual(set(self.picture(*lit, "--cull", "back", model="one.obj")[2]), {0})
        self.assertEqual(self.picture(*lit, "--cull", "front", model="one.obj"), self.picture(*lit, "--cull", "none", model="one.obj"))
        self.bad(1, "one.obj", "--one-sided", "--two-sided", says="cannot be used together", leaves={"one.obj"})

    def test_warnings_and_errors(self):
        for value in ("kd=1.5", "specular=1/2/1", "ambient=3"):
            done = self.good("sphere", "-s", 16, "--material", value)
            self.assertIn(b"above 1", done.stderr)
            self.assertIn("above 1", self.report("sphere", "-s", 16, "--material", value)["warnings"][0])
        self.assertNotIn(b"above 1", self.good("sphere", "-s", 16, "--material", "emission=3,kd=1,diffuse=1").stderr)
        (self.folder / "sphere.png").unlink()
        for value, says in {
            "bras": "did you mean 'brass'?", "": "empty", "kd=nan": "a number", "shininess=inf": "a number", "gold,ruby": "expected key=value", "kd=1,kd=1": "given twice",
            "gold@": "nothing after '@'", "#ff000080": "without alpha", "#ff80": "expected a colour", "rde": "did you mean 'red'?", "0.5": "a colour or key=value",
            "1/2": "expected a colour", "red,color=blue": "given twice",
        }.items():
            with self.subTest(value):
                self.bad(1, "sphere", "--material", value, says=["option '--material'", says])
        self.bad(1, "sphere", "--back-material", "bras", says=["option '--back-material'", "did you mean 'brass'?"])
        self.bad(1, "sphere", "--back-material", "gold@spere", says="did you mean 'sphere'?")
        for words in (("--shininess", "-1"), ("--shininess", "nan"), ("--opacity", "-0.1"), ("--opacity", "1.1")):
            self.bad(1, "sphere", *words, says=[words[0], "expected a number from 0"])


    def test_hide(self):
        objects = [{"name": "ball", "shape": "sphere", "material": "red"}, {"name": "box", "shape": "cube", "transform": [["translate", 2, 0, 0]], "material": "blue"}]
        materials = {"red": {"diffuse": [1, 0, 0]}, "blue": {"diffuse": [0, 0, 1]}}
        for name, list_of in (("both", objects), ("ball", objects[:1])):
            (self.folder / f"{name}.json").write_text(json.dumps({"lambent": 1, "materials": materials, "objects": list_of}))
        seen = ("--shadows", "--ground", "shadow", "--camera", "eye=1/3/9,target=1/0/0,fovy=40")
        alone, both = (self.picture(*seen, model=f"{name}.json") for name in ("ball", "both"))
        self.assertNotEqual(alone, both)
        self.assertEqual(self.picture(*seen, "--hide", "box", model="both.json"), alone)
        self.assertEqual(self.picture(*seen, "--hide", "blue", model="both.json"), alone)
        self.assertEqual(self.picture("--hide", "box", model="both.json"), self.picture(model="ball.json"))
        self.bad(1, "both.json", "--hide", "bal", says=["option '--hide': the model has no object, part or material 'bal'", "did you mean 'ball'?"], leaves=("ball.json", "both.json"))
        for words in (("both.json", "ball.json"), ("batch", "-v", "both.json", "ball.json", "--journal", "none")):
            said = self.good(*words, "--hide", "box", "-s", 8, "-o", "many/").stderr.decode()
            self.assertIn("warning: option '--hide': the model has no object, part or material 'box'; it has 'ball', 'red', 'blue'", said)
        shutil.rmtree(self.folder / "many")
        self.bad(1, "both.json", "--hide", "nothing", says=["'nothing'; it has 'ball', 'box', 'red', 'blue'"], leaves=("ball.json", "both.json"))

    def test_list(self):
        text = self.good("materials", "--color-mode", "raw").stdout.decode()
        lines = {line.split()[0]: line.split()[1:] for line in text.splitlines() if line}
        self.assertEqual(lines["brass"][6:10], ["0.992157", "0.941176", "0.807843", "27.8974"])
        self.assertEqual(len([line for line in text.splitlines() if len(line.split()) == 11 and line.split()[1][0].isdigit()]), 24)
        self.assertIn("teapots.c", text)
        answer = json.loads(self.good("materials", "--json", "--color-mode", "raw").stdout)["materials"]
        self.assertEqual([material["name"] for material in answer], list(lines)[1:25])
        self.assertEqual(answer[[material["name"] for material in answer].index("brass")],
                         {"name": "brass", "ambient": [0.329412, 0.223529, 0.027451], "diffuse": [0.780392, 0.568627, 0.113725],
                          "specular": [0.992157, 0.941176, 0.807843], "shininess": 27.897436})
        # Without --color-mode raw, these are the linear numbers of --material and scene files.
        chrome = self.good("materials").stdout.decode().split("chrome")[1].split()
        self.assertEqual(chrome[3:7], ["0.132868"] * 3 + ["0.561662"])
        answer = json.loads(self.good("materials", "--json").stdout)["materials"]
        words = ["%s=%s" % (key, "/".join(map(repr, value)) if key != "shininess" else value)
                 for key, value in answer[10].items() if key != "name"]
        self.same(("--rig", "studio", "--material", "gold"), ("--rig", "studio", "--material", ",".join(words)))
        self.good("materials", "-o", "sheet.png", "-s", "300")
        self.assertEqual(self.new_files(), {"sheet.png"})
        width, height, data = sheet = self.png("materials", "-s", "300x200")
        self.assertEqual((width, height), (300, 200))
        middles = {pixel(sheet, 25 + 50 * column, y)[:3] for column in range(6) for y in (45, 82, 120, 158)}
        self.assertGreaterEqual(len(middles), 20)
        # Chrome, silver and white plastic look different: the grey of the body or the highlight distinguishes them.
        looks, sheet = [], self.png("materials", "-s", "300x200", "-b", "transparent")
        for column, row in ((2, 1), (5, 1), (4, 2)):
            greys = sorted(pixel(sheet, x, y)[0] for x in range(50 * column, 50 * column + 50) for y in range(20 + 37 * row, 46 + 37 * row)
                           if pixel(sheet, x, y)[3] == 255)
            looks.append((greys[len(greys) // 2], greys[-len(greys) // 50]))
        for i in range(3):
            self.assertGreater(max(abs(a - b) for a, b in zip(looks[i], looks[i - 1])), 20, looks)
        # The captions are below the swatches, and only there.
        clear = ("materials", "-s", "300x200", "-b", "transparent")
        words, plain = self.png(*clear), self.png(*clear, "--no-captions")
        differs = [(x, y) for y in range(200) for x in range(300) if pixel(words, x, y) != pixel(plain, x, y)]
        self.assertGreater(len(differs), 24 * 20)
        self.assertTrue(all(pixel(plain, x, y)[3] == 0 for x, y in differs))
        self.bad(2, "materials", "-o", "none.png", "--font", "/nowhere.ttf", says="/nowhere.ttf", leaves={"sheet.png"})
        self.bad(1, "materials", "gold", says="unexpected argument", leaves={"sheet.png"})


class Methods(Pictures):
    def test_flat_is_gouraud_with_facet_normals_only_under_directional_diffuse_light(self):
        coarse = (self.folder / "coarse.obj")
        points = [(x, y, x * x - y * y * 0.7 + 0.3 * x * y) for y in (-1, -0.5, 0, 0.5, 1) for x in (-1, -0.5, 0, 0.5, 1)]
        faces = [f"f {i + 1} {i + 2} {i + 7}\nf {i + 1} {i + 7} {i + 6}" for i in range(19) if i % 5 != 4]
        coarse.write_text("\n".join("v %g %g %g" % p for p in points) + "\n" + "\n".join(faces) + "\n")

        def both(*words):
            flat = self.picture("--shading", "flat", *words, model="coarse.obj", size=100)
            facet = self.picture("--shading", "gouraud", "--normals", "facet", *words, model="coarse.obj", size=100)
            return difference(flat, facet)

        sun = ("--light", "directional:direction=-1/-2/-3")
        self.assertEqual(both(*sun, *DIFFUSE_ONLY), 0)
        self.assertGreater(both("--light", "point:position=1r/1r/1r", *DIFFUSE_ONLY), 4)
        shiny = ("--material", "specular=1,shininess=20")
        self.assertGreater(both(*sun, *shiny, "--viewer", "local"), 4)
        self.assertEqual(both(*sun, *shiny, "--viewer", "infinite"), 0)

    def test_stages(self):
        gouraud, phong = self.picture("--shading", "gouraud"), self.picture()
        for stage, expected in {"application": gouraud, "vertex": gouraud, "fragment": phong}.items():
            self.assertEqual(self.picture("--stage", stage), expected)
        flat = self.picture("--shading", "flat")
        for stage in ("application", "vertex", "fragment"):
            self.assertEqual(self.picture("--stage", stage, "--shading", "flat"), flat)
        for stage in ("application", "vertex"):
            self.assertEqual(self.picture("--stage", stage, "--shading", "smooth"), gouraud)
            self.bad(1, "sphere", "--stage", stage, "--shading", "phong", says=["phong works with fragment", "stage " + stage])
            self.bad(1, "sphere", "--shading", "normal", "--stage", stage, says="phong works with fragment")
        self.assertEqual(self.picture("--stage", "fragment", "--shading", "normal"), phong)
        self.bad(1, "sphere", "--stage", "fragment", "--shading", "gouraud", says="gouraud works with application or vertex")
        self.bad(1, "sphere", "--stage", "pixl", says="expected auto, application, vertex or fragment")

    def test_switches(self):
        shiny = ("--material", "specular=1", "--light", "point:position=1/1/2,attenuation=0/0/1,ambient=1")
        for words in (("--viewer", "infinite"), ("--match-highlights",), ("--gl1", "--shading", "gouraud"),
                      ("--flat-normal", "vertex", "--shading", "flat")):
            plain = [w for w in words if w in ("--shading", "gouraud", "flat")]
            a, b = (self.picture(*shiny, *w, model="torus") for w in (words, plain))
            self.assertNotEqual(a, b, words)
        for words in (("--viewer", "local"), ("--flat-normal", "face"), ("--cull", "none")):
            self.same((*shiny, *words), shiny)
        # With matching, Blinn-Phong at alpha equals plain Blinn-Phong at four times alpha.
        self.same((*shiny, "--match-highlights", "--shininess", "8"), (*shiny, "--shininess", "32"))
        for words in (("--viewer", "far"), ("--flat-normal", "edge"), ("--cull", "all")):
            self.bad(1, "sphere", *words, says=["option '" + words[0] + "'", "expected"])

    def test_many_lights(self):
        lights = [{"type": "point", "position": [2.5 * math.cos(i), math.sin(7 * i), 2.5 * math.sin(i)], "intensity": 0.004,
                   "attenuation": [1, 0, 2], "range": 2.5} for i in range(300)]
        scene = {"lambent": 1, "image": {"size": [64, 64]}, "objects": [{"shape": "sphere"}], "lights": lights}
        (self.folder / "many.json").write_text(json.dumps(scene))
        (self.folder / "all.json").write_text(json.dumps(dict(scene, light_cutoff=0)))

        def picture(name, *words):
            report = self.report(name, *words, "-o", "lit.png")
            return read_png((self.folder / "lit.png").read_bytes()), report["counts"]["lights_evaluated"]
        some, every, coarse = (picture("many.json", *words) for words in ((), ("--light-cutoff", "0"), ("--light-cutoff", "0.2")))
        self.assertLessEqual(difference(some[0], every[0]), 1)
        self.assertLess(difference(coarse[0], every[0]), 0.2 * 255 + 1)
        self.assertGreater(difference(coarse[0], every[0]), 1)
        self.assertLess(coarse[1], some[1])
        self.assertLessEqual(some[1], every[1])
        # The file sets it, the command line overrides it, and --save-scene stores it.
        self.assertEqual(picture("all.json"), every)
        self.assertEqual(picture("all.json", "--light-cutoff", "0.2"), coarse)
        self.assertEqual(picture("many.json", "--light-cutoff", "0.2", "--save-scene", "kept.json"), coarse)
        self.assertEqual(json.loads((self.folder / "kept.json").read_text())["light_cutoff"], 0.2)
        self.assertEqual(picture("kept.json"), coarse)
        answer = self.good("explain", "many.json", "20,30", "--light-cutoff", "0.2").stdout.decode()
        self.assertRegex(answer, r"\d+ of 300 lights contribute nothing here; \d+ more were skipped: too weak")
        self.assertEqual(self.run_program("many.json", "--light-cutoff", "1.5").returncode, 1)

    def test_tangents_from_texture_coordinates(self):
        quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        for name, coordinates in {"along": "0 0,1 0,1 1,0 1", "across": "0 0,0 1,1 1,1 0", "none": ""}.items():
            lines = "".join(f"vt {c}\n" for c in coordinates.split(",") if c)
            corners = "f 1/1 2/2 3/3 4/4" if lines else "f 1 2 3 4"
            (self.folder / f"{name}.obj").write_text(f"{quad}{lines}{corners}\n")
        words = ("--reflection", "kajiya-kay", "--light", "point:position=1/0.2/0.6", "--material", "specular=1", "--view", "front")
        along, across, none = (self.picture(*words, model=f"{n}.obj") for n in ("along", "across", "none"))
        self.assertGreater(difference(along, across), 9)
        self.assertEqual(along, none)  # the direction field of a plane that faces +z is along x
