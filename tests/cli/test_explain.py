# test_explain.py: the command `explain`: the explained pixel equals the picture's, as text and as JSON.
import json
import math
import random
import re

from harness import SHARED_MODELS, Case, covered, pixel


class Explain(Case):
    def explained(self, *words):
        return json.loads(self.good("explain", *words, "--json").stdout)

    def same_as_picture(self, model, *options, count=6):
        """Random pixels of the model's box, and one outside."""
        picture = self.png(model, *options)
        left, top, right, bottom = covered(picture)
        pick = random.Random(f"{model}{options}")
        for _ in range(count):
            x, y = pick.randrange(left, right), pick.randrange(top, bottom)
            answer = self.explained(model, f"{x},{y}", *options)
            self.assertEqual(tuple(answer["bytes"]), pixel(picture, x, y), (model, options, x, y))
            self.check_sum(answer)
        self.assertEqual(self.explained(model, "0,0", *options)["triangles"], [])

    def check_sum(self, answer):
        total = [0, 0, 0, 0]
        for triangle in answer["triangles"]:
            self.assertAlmostEqual(sum(triangle["weights"]), 1, 5)
            self.assertEqual(triangle["weight"], triangle["samples"] / answer["samples"])
            alpha = triangle["color"][3] * triangle["weight"]
            for c in range(3):
                total[c] += triangle["color"][c] * alpha
            total[3] += alpha
            for point in triangle["points"]:
                for c in range(3):
                    self.assertAlmostEqual(sum(term[c] for term in point["terms"].values()), point["sum"][c], 5)
        for c in range(4):
            self.assertAlmostEqual(total[c], answer["sum"][c], 5)

    def test_formulas_of_the_model(self):
        for model, highlight, gated in (("phong", "max(r·v, 0)", True), ("blinn-phong", "max(n·h, 0)", True), ("lambert", None, True), ("kajiya-kay-lecture", None, False)):
            triangle = self.explained("sphere", "48,48", "--size", "96", "--reflection", model)["triangles"][0]
            formulas = triangle["formulas"]
            self.assertEqual(triangle["model"], model)
            self.assertEqual((formulas["gated"], formulas["microfacet"]), (gated, False))
            self.assertEqual(formulas["D"], "max(n·l, 0)" if gated else "sin(t,l)")
            if highlight or gated:
                self.assertEqual(formulas["base"], highlight)

    def test_methods(self):
        for shading in ("flat", "gouraud", "phong"):
            self.same_as_picture("torus-knot", "-s", "90x70", "--shading", shading)
        for samples in (1, 16):
            self.same_as_picture("teapot", "-s", 80, "--samples", samples, "--reflection", "phong", "-b", "#20406080")
        for reflection in ("none", "lambert", "kajiya-kay", "kajiya-kay-lecture"):
            self.same_as_picture("cone", "-s", 64, "--reflection", reflection, "--rig", "headlight", "--color-mode", "raw", count=3)
        self.same_as_picture("cube.obj", "-s", 64, "--view", "iso", "--projection", "orthographic")

    def test_models(self):
        models = [SHARED_MODELS / "obj/spot/spot_triangulated.obj", SHARED_MODELS / "ply/derived/spot_colour_le.ply"]
        if not all(model.exists() for model in models):
            self.skipTest("the shared models are not there")
        for model in models:
            self.same_as_picture(str(model), "-s", 200)

    def test_opengl_rows(self):
        """The rows of --gl1 name the lights' ambient terms, and the texture that multiplies interpolated light."""
        model = SHARED_MODELS / "obj/spot/spot_triangulated.obj"
        if not model.exists():
            self.skipTest("the shared models are not there")
        words = ("explain", model, "-s", 64, "--gl1", "--look", "classic", "--samples", 1, "--light", "point:position=2/3/4,ambient=0.4", "32,32")
        for shading in ("phong", "gouraud", "flat"):
            text = self.good(*words, "--shading", shading).stdout.decode()
            at_point = shading == "phong"
            self.assertIn("ka ⊙ La_global + Σ of the lights' ambient terms" +
                          (", times texture and vertex colour" if at_point else "") + " = ka ⊙ (", text)
            self.assertEqual("; ambient and diffuse times the texture" in text, not at_point)

    def test_places(self):
        """Each space follows from the previous one; the point's window position is the position at which the pixel is lit."""
        scene = {"lambent": 1, "objects": [{"shape": "teapot", "transform": [["scale", -1, 1, 1]]}]}
        (self.folder / "mirrored.json").write_text(json.dumps(scene))
        for words in (["teapot", "30,30"], ["teapot", "30,30", "--shading", "gouraud"], ["mirrored.json", "30,30"],
                      ["cube.stl", "32,24"],  # has no indices
                      ["teapot", "30,30", "--projection", "orthographic"]):
            answer = self.explained(*words, "-s", "64x48", "--samples", 1)
            for triangle in answer["triangles"]:
                *corners, point = triangle["places"]
                for place in triangle["places"]:
                    x, y, z, w = place["clip"]
                    self.assertGreater(w, 0)
                    for got, expected in zip(place["ndc"], (x / w, y / w, z / w)):
                        self.assertAlmostEqual(got, expected, 12)
                    for got, n, size in zip(place["window"], place["ndc"], (64, 48, 1)):
                        self.assertAlmostEqual(got, (n + 1) * size / 2, 9)
                    self.assertTrue(-1 <= place["ndc"][2] <= 1)
                    self.assertLess(place["eye"][2], 0)
                for space in ("object", "eye", "clip"):
                    for k, got in enumerate(point[space]):
                        self.assertAlmostEqual(got, sum(w * c[space][k] for w, c in zip(triangle["weights"], corners)), 4)
                self.assertAlmostEqual(point["window"][0], triangle["picture_position"][0], 2)
                self.assertAlmostEqual(48 - point["window"][1], triangle["picture_position"][1], 2)
                (x1, y1, _), (x2, y2, _), (x3, y3, _) = (c["window"] for c in corners)
                area = (x3 - x2) * (y1 - y2) - (y3 - y2) * (x1 - x2)
                self.assertAlmostEqual(triangle["winding"], area, 6)
                mirrored = words[0] == "mirrored.json"
                self.assertEqual(triangle["winding"] > 0, (triangle["side"] == "front") != mirrored)
        (self.folder / "mirrored.json").unlink()
        (self.folder / "line.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 0.001 0\nl 1 2\nl 1 3\n")
        line = self.explained("line.obj", "32,24", "-s", "64x48", "--view", "front")["triangles"][0]
        self.assertEqual((line["places"], "line" in line), (None, True))
        (self.folder / "line.obj").unlink()
        text = self.good("explain", "teapot", "30,30", "-s", 64).stdout.decode()
        for words in ("from the mesh to the window", "NDC", "clip ÷ w", "winding", "counter-clockwise"):
            self.assertIn(words, text)

    def test_matrices(self):
        """A student can compute each line of the text: eye, clip, NDC and window coordinates with the matrices, and n with the normal matrix."""
        def times(matrix, v):
            return [sum(a * b for a, b in zip(row, v)) for row in matrix]

        def unit(v):
            length = math.sqrt(sum(x * x for x in v))
            return [x / length for x in v]

        def near(got, expected, places):
            for a, b in zip(got, expected, strict=True):
                self.assertAlmostEqual(a, b, places)

        scene = {"lambent": 1, "objects": [{"shape": "torus", "transform": [["rotate", 30, 1, 2, 3], ["scale", -1, 1.5, 2]]}]}
        (self.folder / "stretched.json").write_text(json.dumps(scene))
        for words in (["teapot"], ["stretched.json"], ["teapot", "--projection", "orthographic"], ["stretched.json", "--shading", "gouraud"],
                      ["stretched.json", "--shading", "flat"], ["cube.stl"]):
            words = [words[0], "20,24", *words[1:]]
            for triangle in self.explained(*words, "-s", "64x48", "--samples", 1)["triangles"]:
                m, *corners = triangle["matrices"], *triangle["places"]
                # The normal matrix N is the inverse transpose of the model-view matrix's 3×3 part M, so that
                # N · Mᵀ is the unit matrix.
                for i in range(3):
                    near([sum(m["normal"][i][k] * m["model_view"][j][k] for k in range(3)) for j in range(3)], [float(i == j) for j in range(3)], 9)
                for place in corners:
                    near(place["eye"], times(m["model_view"], [*place["object"], 1])[:3], 5)
                    near(place["clip"], times(m["projection"], [*place["eye"], 1]), 4)
                *corners, point = corners
                if triangle["face_normal"]:
                    a, b = ([x - y for x, y in zip(corners[k]["object"], corners[0]["object"])] for k in (1, 2))
                    n = unit(times(m["normal"], [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]))
                    self.assertNotIn("normal", corners[0])
                    normals = [n]
                else:
                    normals = [unit(times(m["normal"], corner["normal"])) for corner in corners]
                    if len(triangle["points"]) == 1:
                        normals = [unit([sum(w * n[k] for w, n in zip(triangle["weights"], normals)) for k in range(3)])]
                sign = -1 if triangle["lit_normal"] == "-n" else 1
                for lit, n in zip(triangle["points"], normals, strict=True):
                    near([sign * x for x in lit["n"]], n, 4)
            text = self.good("explain", *words, "-s", "64x48", "--samples", 1).stdout.decode()
            for part in ("model-view matrix  ", "projection matrix  ", "normal matrix  ", "(x + 1) · 64/2, (y + 1) · 48/2, (z + 1)/2 of NDC",
                         "cross product" if "flat" in words else "winding"):
                self.assertIn(part, text, words)
            self.assertEqual("(p1 − p0) × (p2 − p0)" in text, triangle["face_normal"])

    def test_cones(self):
        """A spot light's factor can be computed from the printed numbers, and for 0 the text states the reason."""
        for cone, says in (("cutoff=40,exponent=8", "c^ε = "), ("cutoff=2,exponent=8", "outside of the cone: c < cos cutoff"), ("cutoff=180,exponent=3", "c^ε = "),
                           ("inner=10,outer=60", "clamp((c − cos outer) / "), ("inner=1,outer=2", "outside of the cone, c ≤ cos outer"),
                           ("cutoff=180,exponent=2,direction=0/0/1", "max(c, 0)^ε")):
            words = ("sphere", "38,38", "-s", 64, "--samples", 1, "--view", "front", "--light", "spot:position=0/0/3," + cone)
            text = self.good("explain", *words).stdout.decode()
            self.assertRegex(text, rf"spot +\S+   {re.escape(says)}", cone)
            [light] = self.explained(*words)["triangles"][0]["points"][0]["lights"]
            c, cone = light["cos_axis"], light["cone"]
            if "outer_deg" in cone:
                inner, outer = (math.cos(math.radians(cone[key])) for key in ("inner_deg", "outer_deg"))
                expected = min(max((c - outer) / max(0.001, inner - outer), 0), 1) ** 2
            else:
                cutoff = cone["cutoff_deg"]
                expected = 0 if cutoff is not None and c < math.cos(math.radians(cutoff)) else max(c, 0) ** cone["exponent"]
            self.assertAlmostEqual(light["spot"], expected, 5)
        self.assertIsNone(self.explained("sphere", "38,38", "-s", 64, "--light", "point")["triangles"][0]["points"][0]["lights"][0]["cone"])

    def test_rows_of_the_material(self):
        """Fields of physical materials with default values are not printed."""
        text = self.good("explain", "sphere", "32,32", "-s", 64).stdout.decode()
        for name in ("f0_color", "sheen_color", "attenuation_color", "iridescence_ior"):
            self.assertNotIn(name, text)
        self.assertRegex(text, r"emission +0 +0 +0\n")
        self.assertIn("sheen_color", self.good("explain", "sphere", "32,32", "-s", 64, "--material", "#ffc356,metallic=0,sheen_color=0.5").stdout.decode())

    def test_isa_does_not_matter(self):
        words = ("explain", "teapot", "30,30", "-s", 64, "--json")
        self.assertEqual(self.good(*words).stdout, self.good(*words, "--isa", "plain", "-j", 1).stdout)

    def test_environment(self):
        """The reflection term follows from R, printed in both spaces, and from the environment's light in that direction."""
        scene = ("-s", 64, "--reflection-map", "sky", "--reflectivity", "0.25/0.5/1", "--samples", 1)
        self.same_as_picture("sphere", *scene, "--environment-rotation", 70, count=3)
        answer = [self.explained("sphere", "32,32", *scene, "--environment-rotation", turn) for turn in (0, 90)]
        points = [t["triangles"][0]["points"][0] for t in answer]
        for point in points:
            n, v, r = point["n"], point["v"], point["environment"]["R"]
            twice = 2 * sum(a * b for a, b in zip(n, v))
            for c in range(3):
                self.assertAlmostEqual(r[c], twice * n[c] - v[c], 5)
                self.assertAlmostEqual(point["terms"]["reflection"][c], (0.25, 0.5, 1)[c] * point["environment"]["light"][c], 6)
        # The environment is rotated counter-clockwise, seen from above, so the lookup direction rotates the other
        # way.
        straight, turned = (p["environment"]["direction"] for p in points)
        for got, expected in zip(turned, (-straight[2], straight[1], straight[0])):
            self.assertAlmostEqual(got, expected, 5)
        self.assertIsNone(self.explained("sphere", "32,32", "-s", 64)["triangles"][0]["points"][0]["environment"])
        text = self.good("explain", "sphere", "32,32", *scene).stdout.decode()
        for part in ("2 (n·v) n − v", "environment's own axes", "light from there", "kr ⊙ environment = (0.25 0.5 1) ⊙ ("):
            self.assertIn(part, text)

    def test_text(self):
        text = self.good("explain", "teapot", "31,34", "-s", 64, "--rig", "headlight").stdout.decode()
        for part in ("teapot: pixel 31,34 of 64x64", "triangle", "16 samples a pixel", "weights of the corners", "θ", "φ", "ψ", "°   between n and l",
                     "base^α", "spot · attenuation · kd ⊙ Ld · D = 1 · 1 · (", "weighted sum", "--color-mode srgb", "floor(255 · x + ½)"):
            self.assertIn(part, text)
        counts = [tuple(map(int, pair)) for pair in re.findall(r": (\d+) of (\d+) samples", text)]
        self.assertTrue(counts and all(of == 16 for _, of in counts) and sum(n for n, _ in counts) <= 16)
        landed = tuple(map(int, re.search(r"bytes +(\d+) +(\d+) +(\d+) +(\d+)", text).groups()))
        self.assertEqual(landed, pixel(self.png("teapot", "-s", 64, "--rig", "headlight"), 31, 34))
        self.assertIn("Only the background is visible here", self.good("explain", "teapot", "0,0", "-s", 64).stdout.decode())
        self.assertEqual(self.new_files(), set())

    def test_physical(self):
        """Every part of a microfacet lobe and of environment light, as text and as JSON."""
        words = ("sphere", "20,20", "-s", "41", "--samples", "1", "--view", "front", "--material", "#ffc356,metallic=0.5,roughness=0.4")
        lit = (*words, "--light", "directional:direction=0/0/-1")
        text = self.good("explain", *lit).stdout.decode()
        for part in ("D(h)", "V  ", "F  ", "π D(h) V max(n·l, 0)", "base colour", "roughness                       0.4"):
            self.assertIn(part, text)
        triangle = json.loads(self.good("explain", *lit, "--json").stdout)["triangles"][0]
        light = triangle["points"][0]["lights"][0]
        self.assertAlmostEqual(light["distribution"], 1 / (math.pi * 0.4 ** 4), places=1)  # in the middle, n = h, so D is 1 / (pi alpha^2)
        self.assertAlmostEqual(light["S"], math.pi * light["distribution"] * light["visibility"] * light["n_dot_l"], places=3)
        self.assertEqual(triangle["values"]["metallic"], 0.5)
        self.assertEqual((triangle["maps"], triangle["values"]["tangent"]), ([], None))
        # With a light from the command line or a classic look, the roughness does not change; in the studio, the
        # variance of the normals increases it.
        lit_roughness = lambda *more: json.loads(self.good("explain", *words, *more, "--json").stdout)["triangles"][0]["values"]["lit_roughness"]
        given = triangle["values"]["roughness"]
        self.assertEqual(triangle["values"]["lit_roughness"], given)
        self.assertEqual((lit_roughness("--look", "classic"), lit_roughness("--specular-aa", "off"), lit_roughness("--reference", "64")), (given, given, given))
        self.assertTrue(given < lit_roughness() < 0.42)
        self.assertIn("widened to ", self.good("explain", *words).stdout.decode())
        text = self.good("explain", *words, "--environment", "studio").stdout.decode()
        for part in ("diffuse part", "mirrored part", "of the prefiltered environment for the roughness: "):
            self.assertIn(part, text)
        point = json.loads(self.good("explain", *words, "--environment", "studio", "--json").stdout)["triangles"][0]["points"][0]
        around = point["environment"]
        for c, base in enumerate(json.loads(self.good("explain", *words, "--environment", "studio", "--json").stdout)["triangles"][0]["values"]["base_color"]):
            glass = 0.04 * around["scale"] + around["bias"]
            self.assertAlmostEqual(around["diffuse_part"][c], base * 0.5 * around["irradiance"][c] * (1 - glass), places=5)
            self.assertAlmostEqual(point["terms"]["diffuse"][c], around["diffuse_part"][c], places=6)
            self.assertAlmostEqual(point["terms"]["specular"][c], around["specular_part"][c], places=6)
            self.assertEqual(point["terms"]["reflection"][c], 0)
            self.assertGreater(around["specular_part"][c], 0.01)

    def test_layers(self):
        """Each layer of a physical material separately, with its share of a light and of the environment; the shares add up to the terms."""
        words = ("sphere", "14,20", "-s", "41", "--samples", "1", "--view", "front", "--environment", "studio", "--light", "directional:direction=0/0/-1",
                 "--material", "#ffc356,roughness=0.4,clearcoat=0.5,clearcoat_roughness=0.1,sheen_color=0.2/0.4/0.6,sheen_roughness=0.5,transmission=0.25")
        text = self.good("explain", *words).stdout.decode()
        for part in ("  layers\n", "    share ", "    n_c ", "    left ", "    matt ", "    sheen ", "    coat ", "    sheen part ", "    coat part ",
                     "the environment's other parts"):
            self.assertIn(part, text)
        self.assertNotIn("    coat ", self.good("explain", "sphere", "14,20", "-s", "41", "--material", "#ffc356,roughness=0.4,ior=1.8").stdout.decode())
        point = json.loads(self.good("explain", *words, "--json").stdout)["triangles"][0]["points"][0]
        layers, light = point["layers"], point["lights"][0]
        facing = sum(a * b for a, b in zip(layers["coat_normal"], point["v"]))
        self.assertAlmostEqual(layers["coat"], 0.5 * (0.04 + 0.96 * (1 - facing) ** 5), places=5)
        self.assertEqual(layers["matt"], 0.75)
        parts = light["layers"]
        self.assertAlmostEqual(light["D"], (1 - layers["coat"]) * parts["sheen_left"] * parts["base_diffuse"], places=5)
        for c in range(3):
            returned = (1 - layers["coat"]) * (parts["sheen_left"] * parts["base"][c] + parts["sheen"][c]) + parts["coat"]
            self.assertAlmostEqual(light["specular_term"][c], returned, places=4)
            mirrored = sum(layers[name + "_part"][c] for name in ("mirrored", "sheen", "coat"))
            self.assertAlmostEqual(mirrored, point["environment"]["specular_part"][c], places=5)
            self.assertAlmostEqual(light["specular_term"][c] + mirrored, point["terms"]["specular"][c], places=4)
            self.assertAlmostEqual(light["diffuse_term"][c] + point["environment"]["diffuse_part"][c], point["terms"]["diffuse"][c], places=5)

    def test_wrong(self):
        for place in ("5", "5,", ",5", "a,b", "1,2,3", "1.5,2", "0x1,2", "", "9999999999,1"):
            self.bad(1, "explain", "teapot", place, says="expected a pixel X,Y")
        self.bad(1, "explain", "teapot", "64,0", "-s", 64, says=("64,0", "64x64", "63,63"))
        self.bad(1, "explain", "teapot", "0,40", "-s", "64x40", says="is outside")
        self.bad(1, "explain", "teapot", says="missing")
        self.bad(2, "explain", "no-such.obj", "1,1", says="no-such.obj")
        self.assertEqual(self.run_program("explain", "teapot", "64,0", "-s", 64, "--json").returncode, 1)
