# test_shadows.py: --shadows and related options.
import json
import struct

from harness import Case, pixel

SCENE = {"lambent": 1, "image": {"size": [64, 64], "samples": 1}, "camera": {"eye": [0, 8, 0.01], "target": [0, 0, 0], "ortho_half_height": 4},
         "shadows": True,
         "objects": [{"name": "floor", "shape": "plane", "transform": [["scale", 4, 1, 4]]},
                     {"name": "box", "shape": "cube", "transform": [["translate", 0, 1, 0], ["scale", 0.5, 0.5, 0.5]]}],
         "lights": [{"name": "sun", "type": "directional", "direction": [1, -1, 0]}]}
SHADOW, LIT = (44, 32), (10, 32)  # beside the box, inside and outside its shadow


class Shadows(Case):
    def scene(self, name="shadows.json", **more):
        (self.folder / name).write_text(json.dumps({**SCENE, **more}))
        return name

    def test_scene_and_option(self):
        dark = self.png(self.scene())
        self.assertEqual(pixel(dark, *SHADOW)[:3], (0, 0, 0))
        self.assertGreater(pixel(dark, *LIT)[0], 50)
        plain = self.scene("plain.json", shadows=False)
        self.assertEqual(pixel(self.png(plain), *SHADOW), pixel(self.png(plain), *LIT))
        self.assertEqual(self.png(plain, "--shadows"), dark)
        off = self.scene("off.json", lights=[{**SCENE["lights"][0], "shadows": False}])
        self.assertEqual(self.png(off), self.png(plain))

    def test_every_isa_and_thread_count(self):
        first = self.png(self.scene(), "--isa", "scalar", "--threads", "1")
        self.assertEqual(self.png(self.scene(), "--threads", "3"), first)

    def test_shared_rays_and_single_rays_agree(self):
        """With up to 48 samples each point has its own rays. The default shares them between neighbours: the same light, but for the noise of 48 rays."""
        pole = {"name": "pole", "shape": "cube", "transform": [["translate", 0, 1, 0], ["scale", 0.1, 1, 0.1]]}
        far = {"eye": [-5, 3, 0.01], "target": [-5, 0, 0], "ortho_half_height": 2}
        floor = {**SCENE["objects"][0], "transform": [["scale", 6, 1, 4]]}
        sun = {"name": "sun", "type": "directional", "direction": [-8, -1, 0], "radius": 1}
        lamp = {"name": "lamp", "type": "point", "position": [4, 2, 0], "radius": 0.3}
        for name, light, camera, objects in (
                ("far from its pole, under a low sun", sun, far, [pole]),
                ("a sun of 40 degrees", {**sun, "direction": [1, -1, 0], "radius": 40}, SCENE["camera"], SCENE["objects"]),
                ("a lamp beside a pole", lamp, SCENE["camera"], [floor, pole]),
                ("a lamp wider than its distance", {**lamp, "position": [1, 2, 0], "radius": 2}, SCENE["camera"], SCENE["objects"])):
            scene = self.scene(lights=[light], camera=camera, objects=objects, ground="color", ground_color=[0.8, 0.8, 0.8])
            shared, single = (self.png(scene, *words) for words in ((), ("--shadow-samples", "48")))
            unlit = self.png(self.scene("plain.json", lights=[{**light, "shadows": False}], camera=camera, objects=objects, ground="color", ground_color=[0.8, 0.8, 0.8]))
            self.assertGreater(sum(pixel(shared, x, y)[1] < 0.8 * pixel(unlit, x, y)[1] for x in range(64) for y in range(64)), 40, name)
            apart = [abs(pixel(shared, x, y)[1] - pixel(single, x, y)[1]) for x in range(64) for y in range(64)]
            self.assertLess(max(apart), 24, name)
            self.assertLess(sum(apart) / len(apart), 1.5, name)

    def test_saved_scene_is_the_same(self):
        scene = self.scene(lights=[{"type": "directional", "direction": [1, -1, 0], "radius": 5}], shadow_samples=7, shadow_terminator=False)
        first = self.png(scene, "--save-scene", "saved.json")
        saved = json.loads((self.folder / "saved.json").read_text())
        self.assertEqual((saved["shadows"], saved["shadow_samples"], saved["shadow_terminator"], saved["lights"][0]["radius"]), (True, 7, False, 5))
        self.assertEqual(self.png("saved.json"), first)

    def test_light_option(self):
        dark = self.png("teapot", "-s", "64", "--shadows", "--light", "directional:direction=-1/-1/0")
        self.assertNotEqual(dark, self.png("teapot", "-s", "64", "--light", "directional:direction=-1/-1/0"))
        self.assertEqual(self.png("teapot", "-s", "64", "--light", "directional:direction=-1/-1/0"),
                         self.png("teapot", "-s", "64", "--shadows", "--light", "directional:direction=-1/-1/0,shadows=no"))

    def test_explained(self):
        answer = json.loads(self.good("explain", self.scene(), "%d,%d" % SHADOW, "--json").stdout)
        light = answer["triangles"][0]["points"][0]["lights"][0]
        self.assertEqual((light["casts_shadows"], light["passed"], light["in_the_way"]["object"]), (True, [0, 0, 0], 1))
        self.assertGreater(light["in_the_way"]["distance"], 0.1)
        text = self.good("explain", self.scene(), "%d,%d" % SHADOW).stdout.decode()
        self.assertIn("of object 1 blocks the light", text)
        self.assertIn("nothing blocks the light", self.good("explain", self.scene(), "%d,%d" % LIT).stdout.decode())
        self.assertNotIn("blocks the light", self.good("explain", self.scene(shadows=False), "%d,%d" % LIT).stdout.decode())

    def test_glass_elsewhere_leaves_a_ground_its_shadow(self):
        """If a material transmits light, light is tinted: lights without shadows light a catcher a second time."""
        box = SCENE["objects"][1]
        glass = {"name": "glass", "shape": "cube", "transform": [["translate", -2.5, 1, -2.5], ["scale", 0.3, 0.3, 0.3]], "material": "glass"}
        materials = {"glass": {"physical": True, "metallic": 0, "roughness": 0.4, "transmission": 1}}
        camera = {"eye": [0, 8, 0.01], "target": [0, 0, 0], "ortho_half_height": 4}
        alphas = []
        for objects in ([box], [box, glass]):
            shown = self.png(self.scene("caught.json", ground="shadow", ao="off", camera=camera, objects=objects, materials=materials))
            alphas.append(pixel(shown, 40, 32)[3])
        self.assertGreater(alphas[0], 200)
        self.assertEqual(*alphas)

    def test_glass_colours_its_shadow(self):
        """A transmitting surface passes its base colour: a pane once, two panes the product, and a volume at the point where light enters it."""
        def passed(material, shape="plane", floor=None, *words):
            pane = {"name": "pane", "shape": shape, "transform": [["translate", 0.3, 1, 0], ["scale", 0.5, 0.5 if shape == "cube" else 1, 0.5]], "material": "pane"}
            objects = [{**SCENE["objects"][0], "material": "floor"}, pane]
            if "two" in words:
                objects.append({**pane, "name": "other", "transform": [["translate", 0, 1.5, 0], ["scale", 0.5, 1, 0.5]]})
            scene = self.scene("glass.json", objects=objects,
                               materials={"floor": floor or {"diffuse": [0.8, 0.8, 0.8]}, "pane": {"physical": True, "metallic": 0, "roughness": 0.4, **material}})
            answer = json.loads(self.good("explain", scene, "%d,%d" % SHADOW, "--json").stdout)
            light = answer["triangles"][-1]["points"][0]["lights"][0]
            for a, b in zip(light["diffuse_term"], light["passed"]):
                self.assertAlmostEqual(a, light["diffuse_term"][0] * b / light["passed"][0] if light["passed"][0] else 0, 6)
            self.assertEqual(self.png(scene, "--isa", "scalar", "--threads", "1"), self.png(scene, "--threads", "3"))
            return light["passed"]

        def near(a, b):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, 6)

        red = {"diffuse": [0.9, 0.2, 0.1], "transmission": 1}
        near(passed(red), [0.9, 0.2, 0.1])
        near(passed(red, "plane", {"physical": True, "diffuse": [0.8, 0.8, 0.8], "metallic": 0, "roughness": 0.9}), [0.9, 0.2, 0.1])
        near(passed({**red, "transmission": 0.5}), [0.45, 0.1, 0.05])
        near(passed({**red, "metallic": 0.5}), [0.45, 0.1, 0.05])
        near(passed({**red, "diffuse": [0.9, 0.2, 0.1, 0.5]}), [0.95, 0.6, 0.55])
        near(passed(red, "plane", None, "two"), [0.81, 0.04, 0.01])
        near(passed(red, "cube"), [0.81, 0.04, 0.01])
        near(passed({**red, "thickness": 0.5}, "cube"), [0.9, 0.2, 0.1])
        near(passed({"diffuse": [0.9, 0.2, 0.1]}), [0, 0, 0])

    def test_show(self):
        for term in ("diffuse", "specular", "light:sun"):
            self.assertEqual(pixel(self.png(self.scene(), "--show", term), *SHADOW)[:3], (0, 0, 0), term)
        lit = self.scene("ambient.json", ambient=[0.5, 0.5, 0.5])
        picture = self.png(lit, "--show", "ambient")
        self.assertEqual(pixel(picture, *SHADOW), pixel(picture, *LIT))

    def test_ground(self):
        # Alone, or before a model, it catches shadows; a following word or colour is its value.
        caught = self.png("cube", "-s", "64", "--ground", "--rig", "lecture")
        self.assertEqual(self.png("--ground", "cube", "-s", "64", "--rig", "lecture"), caught)
        self.assertEqual(self.png("cube", "-s", "64", "--ground=shadow", "--rig", "lecture"), caught)
        alphas = {pixel(caught, x, y)[3] for x in range(64) for y in range(48, 64, 3)}
        self.assertTrue(any(0 < a < 255 for a in alphas), alphas)
        self.assertEqual(self.png("cube", "-s", "64", "--ground", "off"), self.png("cube", "-s", "64"))
        red = self.png("cube", "-s", "64", "--ground", "red", "--rig", "headlight")
        r, g, b, a = pixel(red, 2, 60)
        self.assertTrue(r > 100 and g == b == 0 and a == 255)
        # A saved scene file, drawn again.
        name = self.scene("ground.json", ground="color", ground_color=[0, 0.5, 0], objects=[{"name": "box", "shape": "cube"}])
        self.assertEqual(self.png(name), self.png(self.scene("other.json", objects=[{"name": "box", "shape": "cube"}]), "--ground", "0/0.5/0"))
        self.good(name, "--ground", "checker", "-q", "-o", "a.png", "--save-scene", "saved.json")
        self.assertEqual(json.loads((self.folder / "saved.json").read_text())["ground"], "checker")
        report = json.loads(self.good("cube", "--ground", "checker", "-s", "16", "-o", "a.png", "--json").stdout)["image"]
        self.assertAlmostEqual(report["ground_height"], -1, 3)
        self.assertEqual(report["ground_square"], 0.5)
        text = self.good("explain", "cube", "2,60", "--ground", "-s", "64").stdout.decode()
        self.assertIn("the ground (shadow), its triangle", text)
        self.assertIn("taken away", text)
        answer = json.loads(self.good("explain", "cube", "2,60", "--ground", "-s", "64", "--json").stdout)["triangles"][0]
        self.assertEqual((answer["ground"], answer["object"], answer["mesh"]), ("shadow", None, None))
        self.assertGreaterEqual(answer["unobstructed"], answer["received"])
        self.bad(1, "cube", "--ground", "--shading", "flat", says="Phong")
        self.bad(1, "cube", "--ground=chequer", says="expected off, shadow, checker or a colour")
        self.bad(2, self.scene("bad.json", ground="chequer"), says="ground")

    def test_lamp_of_an_environment(self):
        """The studio's brightest lamp casts shadows if it lights the model; if nothing blocks it, the picture does not change."""
        (self.folder / "even.pfm").write_bytes(b"PF\n16 8\n-1.0\n" + struct.pack("<384f", *[0.5] * 384))
        look = ("--material", "#cccccc,metallic=0,roughness=0.9", "-s", "64x48", "--ao", "off", "--samples", 1, "-q")
        for shape, environment, least, most in (("sphere", "studio", 0, 16), ("torus-knot", "studio", 20, 255), ("torus-knot", "sky", 5, 60),
                                                ("torus-knot", "even.pfm", 0, 0)):
            for words, to in (((), "a.png"), (("--shadows",), "b.png")):
                self.good(shape, *look, "--environment", environment, *words, "-o", to)
            answer = json.loads(self.run_program("diff", "a.png", "b.png", "--json").stdout)
            self.assertTrue(least <= round(255 * answer["maximum"]) <= most, (shape, environment, answer["maximum"]))
        text = self.good("explain", "torus-knot", "32,20", *look[:-1], "--shadows").stdout
        self.assertIn(b"the environment's lamp", text)

    def test_what_is_refused(self):
        self.bad(1, self.scene(), "--shadow-samples", "0", says="1 to 256")
        self.bad(1, self.scene(), "--shadow-terminator", "maybe", says="on")
        self.bad(1, "teapot", "--light", "directional:radius=1r", says="expected a number")
        self.bad(1, "teapot", "--light", "point:radius=-1", says="at least 0")
        self.bad(1, "teapot", "--light", "ambient:radius=1", says="no 'radius'")
        self.bad(2, self.scene("bad.json", shadows=1), says="shadows")
        self.bad(2, self.scene("bad.json", lights=[{"type": "point", "radius": -1}]), says="radius")
