# test_lights.py: lights, looks and up axes from the command line.
import json
import os
import math
import re
import struct
import unittest

from harness import Case, SHARED_MODELS, pixel

DIFFUSE_ONLY = ("--material", "specular=0,ambient=0")


def difference(a, b):
    """The largest difference of a byte between two pictures."""
    return max(abs(x - y) for x, y in zip(a[2], b[2]))


class UpAxis(Case):
    def light(self, *words):
        self.good("part.stl", *words, "--save-scene", "lit.json", "-s", "8", "-q", "-o", "a.png")
        scene = json.loads((self.folder / "lit.json").read_text())
        [light] = [light for light in scene["lights"] if light["type"] != "ambient"]
        return light

    def test_defaults_turn_with_it(self):
        """Lights without a position are in front of the model for any up axis; positions given by a user stay in the model's axes."""
        self.good("shape", "cube", "-q", "-o", "part.stl")
        r = math.sqrt(3)
        for up, position, way in (("z", (r, -3 * r, 2 * r), (0, 1, 0)), ("y", (r, 2 * r, 3 * r), (0, 0, -1)), ("-z", (-r, -3 * r, -2 * r), (0, 1, 0))):
            for words in (["--light", "point"], ["--light", "spot"], ["--rig", "lecture"]):
                found = self.light("--up", up, *words)["position"]
                self.assertTrue(all(abs(a - b) < 1e-5 for a, b in zip(found, position)), (up, words, found))
            self.assertEqual(self.light("--up", up, "--light", "directional")["direction"], list(way), up)
        self.assertEqual(self.light("--light", "point:position=1/2/3")["position"], [1, 2, 3])
        self.assertEqual(self.light("--light", "directional:direction=0/0/-1")["direction"], [0, 0, -1])


class Default(Case):
    def test_faces_of_a_cube(self):
        """From every azimuth, the three visible faces differ by 20 steps each, for grey meshes and for white physical ones."""
        scene = {"lambent": 1, "objects": [{"shape": "cube", "material": {"diffuse": [1, 1, 1], "metallic": 0}}]}
        (self.folder / "white.json").write_text(json.dumps(scene))
        for ending in ("obj", "stl"):
            self.good("shape", "cube", "-q", "-o", "part." + ending)
        self.good("convert", "white.json", "white.glb", "-q")
        for model in ("part.obj", "part.stl", "white.json", "white.glb"):
            for azimuth in range(15, 76, 15):
                words = (model, "-s", "64", "--azimuth", azimuth)
                normals, picture = self.png(*words, "--show", "normals"), self.png(*words)
                faces = {}
                for n, c in zip(zip(*[iter(normals[2])] * 4), zip(*[iter(picture[2])] * 4)):
                    if n[3] == c[3] == 255:
                        faces.setdefault(n, []).append(c[1])
                tones = sorted(sorted(face)[len(face) // 2] for face in faces.values() if len(face) > 40)
                with self.subTest(model, azimuth=azimuth, tones=tones):
                    self.assertEqual(len(tones), 3)
                    self.assertGreaterEqual(min(tones[1] - tones[0], tones[2] - tones[1]), 20)
                    self.assertLessEqual(tones[2], 245) # darker than white paper

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_nothing_burns(self):
        """Seen from any side, at most 1 % of the pixels are plain white although their base colour is not. The default view is as bright as without the soft curve."""
        for name in ("stairs_wide", "torch_mounted", "table_medium_decorated_A", "keyring", "bed_frame"):
            model = str(SHARED_MODELS / "obj/kaykit_dungeon" / (name + ".obj"))
            for view in ([], ["--elevation", 80], ["--elevation", -30], ["--azimuth", 210, "--elevation", 50], ["--azimuth", -60, "--elevation", 5]):
                words = (model, "-s", "160", "--samples", "1", *view)
                pictures = [zip(*[iter(self.png(*words, *more)[2])] * 4) for more in ([], ["--show", "base-color"], ["--tone", "none"])]
                seen = [(p, b, n) for p, b, n in zip(*pictures) if p[3] == 255]
                burnt = sum(min(p[:3]) == 255 and max(b[:3]) < 235 for p, b, _ in seen)
                self.assertLessEqual(burnt, 0.01 * len(seen), (name, view))
                if not view:
                    self.assertAlmostEqual(sum(sum(p[:3]) for p, _, _ in seen) / len(seen), sum(sum(n[:3]) for _, _, n in seen) / len(seen), delta=9)

    def test_form(self):
        """Curved models have no rim light. Models with few triangles and files with animations, whose form may change, have one."""
        lights = lambda *words: [light["name"] for light in json.loads(self.good("lights", *words, "--rig", "studio").stdout)["lights"]]
        self.good("convert", "sphere", "still.glb", "-q")
        data = (self.folder / "still.glb").read_bytes()
        size = struct.unpack("<I", data[12:16])[0]
        gltf, buffer = json.loads(data[20:20 + size]), data[28 + size:]
        gltf["bufferViews"] += [{"buffer": 0, "byteOffset": len(buffer) + 16 * i, "byteLength": 4 + 12 * i} for i in range(2)]
        view, accessor = len(gltf["bufferViews"]) - 2, len(gltf["accessors"])
        gltf["accessors"] += [{"bufferView": view, "componentType": 5126, "count": 1, "type": "SCALAR", "min": [0], "max": [0]},
                              {"bufferView": view + 1, "componentType": 5126, "count": 1, "type": "VEC4"}]
        gltf["animations"] = [{"samplers": [{"input": accessor, "output": accessor + 1}],
                               "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}]
        buffer += struct.pack("<8f", 0, 0, 0, 0, 0, 0, 0, 1)
        gltf["buffers"][0] = {"byteLength": len(buffer), "uri": "moving.bin"}
        (self.folder / "moving.bin").write_bytes(buffer)
        (self.folder / "moving.gltf").write_text(json.dumps(gltf))
        self.assertEqual(lights("still.glb"), ["key", "fill", "sky"])
        for words in (["moving.gltf"], ["moving.gltf", "--animation", "0"], ["sphere", "--segments", "16x8"], ["cube"]):
            self.assertEqual(lights(*words), ["key", "fill", "rim", "sky"], words)

    def test_dark_models_get_more_light(self):
        """Their exposure depends on their colours. It is the same from every side, and is not used with a given exposure, colour or light."""
        self.good("shape", "torus-knot", "-q", "-o", "white.obj")
        shape = (self.folder / "white.obj").read_text()
        for name, kd in (("white", 0.8), ("grey", 0.3), ("black", 0.01), ("lamp", 0.01)):
            (self.folder / f"{name}.mtl").write_text(f"newmtl a\nKd {kd} {kd} {kd}\n" + "Ke 0.5 0.5 0.5\n" * (name == "lamp"))
            (self.folder / f"{name}.obj").write_text(f"mtllib {name}.mtl\nusemtl a\n" + shape)
        stops = lambda *words: [float(s) for s in re.findall(r"exposure raised by ([0-9.]+) stops for a dark model", self.good(*words, "-s", "32", "-v", "-o", "v-{view}.png").stderr.decode())]
        [grey], [black] = stops("grey.obj"), stops("black.obj")
        self.assertTrue(0.5 <= grey < black <= 2.5, (grey, black))
        self.assertEqual(stops("black.obj", "--view", "back,top"), [black] * 2)
        # a device with a small lamp of its own is brightened less, so that the lamp keeps its colour
        (self.folder / "device.mtl").write_text("newmtl a\nKd 0.0001 0.0001 0.0001\nnewmtl lamp\nKd 0 0 0\nKe 0.5 0.5 0.5\n")
        body, last = shape.rstrip("\n").rsplit("\n", 1)
        (self.folder / "device.obj").write_text(f"mtllib device.mtl\nusemtl a\n{body}\nusemtl lamp\n{last}\n")
        self.assertEqual(stops("device.obj"), [1.25])
        for words in (["white.obj"], ["lamp.obj"], ["torus-knot"], ["torus-knot", "--color", "#020202"], ["black.obj", "--exposure", "0"], ["black.obj", "--color", "#020202"],
                      ["black.obj", "--light", "point"], ["black.obj", "--environment", "sky"], ["black.obj", "--rig", "headlight"], ["black.obj", "--look", "classic"],
                      ["black.obj", "--color-mode", "raw"], ["black.obj", "--ground", "checker"], ["black.obj", "--brighten", "off"]):
            self.assertEqual(stops(*words), [], words)
        draw = lambda *words: self.png("black.obj", "-s", "48", *words)
        black = round(48 * black) / 48 # the printed number is rounded
        self.assertEqual(draw(), draw("--exposure", black))
        self.assertGreater(max(draw()[2][1::4]), 2 * max(draw("--brighten", "off")[2][1::4]))
        explained = json.loads(self.good("explain", "black.obj", "24,24", "-s", "48", "--json").stdout)
        self.assertAlmostEqual(explained["exposure"], 2 ** black, places=4)

    def test_light_falls_off_across_large_faces(self):
        """The key light and the fill light are near: no face of a cube has one tone from edge to edge, and none is half dark."""
        plain = ("cube", "-s", "200", "--samples", "1", "--ao", "off", "--cavity", "off", "-b", "white")
        triangles, picture = self.png(*plain, "--show", "ids")[2], self.png(*plain)[2]
        faces = {}
        for i in range(0, len(picture), 4):
            faces.setdefault(triangles[i : i + 3], []).append(picture[i])
        spans = [max(values) - min(values) for color, values in faces.items() if color != b"\xff" * 3 and len(values) > 500]
        self.assertEqual(len(spans), 6)
        for span in spans:
            self.assertTrue(8 <= span <= 28, spans)

    def test_white_models_get_less_light(self):
        """On a white page, edges of white physical models would vanish. Their exposure is the same from every side."""
        for name, material in (("white", {}), ("cream", {"diffuse": [0.85] * 3}), ("metal", {"metallic": 1}), ("glass", {"transmission": 1}),
                               ("lamp", {"emission": [0.1] * 3})):
            objects = [{"shape": "torus-knot", "material": {"diffuse": [0.98] * 3, "metallic": 0, "roughness": 0.5, **material}}]
            (self.folder / f"{name}.json").write_text(json.dumps({"lambent": 1, "objects": objects}))
            self.good("convert", f"{name}.json", f"{name}.glb", "-q")
        objects += [{"shape": "cube", "material": {"diffuse": [0.5] * 3, "metallic": 0}}]
        del objects[0]["material"]["emission"]
        (self.folder / "both.json").write_text(json.dumps({"lambent": 1, "objects": objects}))
        self.good("convert", "both.json", "both.glb", "-q")
        self.good("shape", "torus-knot", "-q", "-o", "classic.obj")
        stops = lambda *words: [float(s) for s in re.findall(r"exposure lowered by ([0-9.]+) stops for a white model", self.good(*words, "-s", "32", "-v", "-o", "v-{view}.png").stderr.decode())]
        self.assertEqual(stops("white.glb", "--view", "back,top"), [0.833] * 2)
        for words in (["cream.glb"], ["metal.glb"], ["glass.glb"], ["lamp.glb"], ["both.glb"], ["classic.obj"], ["white.json"], ["white.glb", "--exposure", "0"],
                      ["white.glb", "--color", "white"], ["white.glb", "--light", "point"], ["white.glb", "--look", "classic"], ["white.glb", "--brighten", "off"]):
            self.assertEqual(stops(*words), [], words)
        draw = lambda *words: self.png("white.glb", "-s", "48", *words)
        self.assertEqual(draw(), draw("--exposure", -5 / 6))
        self.assertLess(draw()[2][1::4], draw("--brighten", "off")[2][1::4])

    def test_named_metals_mirror_the_studio(self):
        """The name of a metal alone means the physical metal under the default lights, and the row of the classic table under other lights."""
        physical = "diffuse=1/0.782/0.344,metallic=1,roughness=0.2"
        draw = lambda *words: self.png("teapot", "-s", "48", *words)
        self.assertEqual(draw("--material", "gold"), draw("--material", physical))
        for words in (["--look", "classic"], ["--rig", "studio"], ["--light", "point"], ["--gl1"], ["--reflection", "phong"], ["--shading", "flat"]):
            self.assertEqual(draw("--material", "gold", *words), draw("--material", "gold,opacity=1", *words), words)
        self.assertNotEqual(draw("--material", "gold"), draw("--material", "gold,opacity=1"))


class Looks(Case):
    def test_built_in(self):
        listed = [line.split()[0] for line in self.good("looks").stdout.decode().splitlines()]
        self.assertEqual(listed, ["studio", "classic", "catalog", "technical"])
        default = self.png("teapot", "-s", "48")
        self.assertEqual(self.png("teapot", "-s", "48", "--look", "studio"), default)
        pictures = {self.png("teapot", "-s", "48", "--look", name) for name in listed}
        self.assertEqual(len(pictures), 4)
        # A printed look can be used as a file.
        for name in listed:
            (self.folder / "copy.look").write_bytes(self.good("looks", name).stdout)
            self.assertEqual(self.png("teapot", "-s", "48", "--look", "copy.look"), self.png("teapot", "-s", "48", "--look", name), name)

    def test_command_line_overrides(self):
        head = self.png("teapot", "-s", "48", "--rig", "headlight", "--ao", "off")
        for words in (["--look", "classic", "--rig", "headlight"], ["--rig", "headlight", "--look", "classic"]):
            self.assertEqual(self.png("teapot", "-s", "48", *words), head, words)
        light = ["--light", "directional:direction=-1/-1/-1"]
        own = self.png("teapot", "-s", "48", *light, "--ao", "off")
        self.assertEqual(self.png("teapot", "-s", "48", "--look", "classic", *light), own)
        self.assertEqual(self.png("teapot", "-s", "48", *light, "--look", "classic"), own)
        more = ["--light", "+directional:direction=-1/-1/-1"]
        self.assertNotIn(self.png("teapot", "-s", "48", "--look", "classic", *more), (own, self.png("teapot", "-s", "48", "--look", "classic")))
        self.assertEqual(self.png("teapot", "-s", "48", "--ground", "off", "--look", "catalog"), self.png("teapot", "-s", "48"))
        self.assertEqual(self.png("teapot", "-s", "48", "--look", "catalog", "--ground", "off"), self.png("teapot", "-s", "48"))

    def test_files(self):
        def look(text):
            (self.folder / "my.look").write_text(text)
            return "my.look"
        drawn = self.png("teapot", "-s", "48", "--background", "#203040", "--ground", "--shading", "phong")
        self.assertEqual(self.png("teapot", "-s", "48", "--look", look("# mine\n\n  --background #203040 \n--ground\nshading=phong\n")), drawn)
        self.bad(1, "teapot", "--look", look("--ao off\n--output a.png\n"), says="my.look:2: found 'output'")
        self.bad(1, "teapot", "--look", look("--ao maybe\n"), says="my.look:1: --ao: found 'maybe'")
        self.bad(1, "teapot", "--look", look("--rig\n"), says="--rig needs a value")
        self.bad(1, "teapot", "--look", look("--shadows yes\n"), says="takes no value")
        self.bad(1, "teapot", "--look", look("--ao off\0\n"), says="not a look")
        self.bad(1, "teapot", "--look", look("#" * 70000), says="64 KiB")
        os.mkfifo(self.folder / "pipe.look")  # opening it would wait for a writer
        for path in ("pipe.look", "/dev/zero", "."):
            self.bad(1, "teapot", "--look", path, says="not a regular file")
        self.bad(1, "teapot", "--look", "clasic", says="did you mean 'classic'?")
        self.bad(1, "teapot", "--look", "classic", "--look", "studio", says="given twice")
        self.bad(1, "looks", "new", says="expected studio")


class Pictures(Case):
    def picture(self, *words, model="sphere", size=64):
        return self.png(model, "-s", size, *words)

    def same(self, a, b, most=0):
        self.assertLessEqual(difference(self.picture(*a), self.picture(*b)), most, f"{a} against {b}")

    def other(self, a, b):
        self.assertGreater(difference(self.picture(*a), self.picture(*b)), 1, f"{a} against {b}")


class Lights(Pictures):
    def test_list_with_a_ground(self):
        """The lights are listed that light the picture: with a ground, a curved model has the rim light too."""
        for words in (["torus-knot"], ["torus-knot", "--ground"], ["cube", "--ground"]):
            listed = json.loads(self.good("lights", *words).stdout)["lights"]
            self.good(*words, "-s", 16, "-o", "x.png", "--save-scene", "x.json")
            self.assertEqual(listed, json.loads((self.folder / "x.json").read_text())["lights"], words)
            self.assertEqual([light["name"] for light in listed], ["key", "fill", *(["rim"] if "--ground" in words else []), "sky"])

    def test_a_light_replaces_the_default_and_plus_adds(self):
        sky = ("--light", "hemisphere:sky=0.5,ground=0.1")
        self.same(("--light", "none"), ("--rig", "none"))
        self.assertEqual(pixel(self.picture("--light", "none"), 32, 32), (0, 0, 0, 255))
        self.other((), sky)
        self.same(("--rig", "studio", *sky), ("--light", "+" + sky[1]))
        self.same(("--rig", "none", *sky), sky)
        self.same(("--light", "none", *sky), sky)
        self.other(("--light", "+" + sky[1]), ())

    def test_ambient(self):
        flat = ("--reflection", "lambert", "--color-mode", "raw", "--material", "ambient=1/0.5/0.25", "--light", "none")
        self.assertEqual(pixel(self.picture(*flat, "--ambient", "0.4"), 32, 32), (102, 51, 26, 255))
        self.same((*flat, "--ambient", "0.4"), (*flat, "--light", "ambient:ambient=0.4"))
        self.same((*flat, "--ambient", "0.4"), (*flat, "--light", "ambient:color=0.2,intensity=2"))
        self.same((*flat, "--ambient", "#808080"), (*flat, "--ambient", "gray"))

    def test_rigs(self):
        rigs = {name: self.picture("--rig", name) for name in ("studio", "headlight", "three-point", "lecture", "none")}
        self.assertEqual(len({p[2] for p in rigs.values()}), 5)
        self.same(("--rig", "auto"), ("--rig", "studio"))
        self.same(("--rig", "file"), ("--rig", "none"))  # a shape has no lights of its own
        self.same(("--rig", "lecture"), ("--light", "point:position=1r/2r/3r,ambient=0.1,diffuse=1,specular=1,attenuation=1/0/0"))
        self.same(("--rig", "headlight"), ("--light", "directional:direction=0/0/-1,frame=camera"))

    def test_radii(self):
        # The sphere's radius is 1 and its centre is the origin, so radii equal the model's units.
        self.same(("--light", "point:position=2r/1r/3r"), ("--light", "point:position=2/1/3"), 1)
        self.same(("--light", "point:position=0/2r/0"), ("--light", "point:position=0/2/0"), 1)
        self.same(("--light", "point:position=2/1/3,attenuation=1/2.7r/5r"), ("--light", "point:position=2/1/3,attenuation=1/2.7/5"), 1)
        self.same(("--light", "point:position=2/1/3,range=4r"), ("--light", "point:position=2/1/3,range=4"), 1)
        self.other(("--light", "point:position=2/1/3,range=4r"), ("--light", "point:position=2/1/3"))
        # A model ten times as large, far from the origin, looks the same under the same command.
        lines = [line.split() for line in (self.folder / "cube.obj").read_text().splitlines()]
        large = [" ".join(["v", *(repr(10 * float(x) + 70) for x in w[1:4])]) if w[:1] == ["v"] else " ".join(w) for w in lines]
        (self.folder / "large.obj").write_text("\n".join(large) + "\n")
        words = ("--light", "point:position=2r/1r/3r,attenuation=0.2/0.1r/0.1r,range=9r", "--light", "spot:position=0/3r/1r,cutoff=30")
        a, b = self.picture(*words, model="cube.obj"), self.picture(*words, model="large.obj")
        far_off = sum(abs(x - y) > 2 for x, y in zip(a[2], b[2]))  # except for some edge pixels
        self.assertLess(far_off, 0.01 * len(a[2]))
        self.assertGreater(max(a[2][0::4]), 60)

    def test_directional(self):
        self.same(("--light", "point:position=1/2/3/0"), ("--light", "directional:direction=-1/-2/-3"))
        self.same(("--light", "directional:position=1/2/3,target=0/0/0"), ("--light", "directional:direction=-1/-2/-3"))
        self.same(("--light", "point:position=2/4/6/2"), ("--light", "point:position=1/2/3"))

    def test_colors(self):
        at = "directional:direction=-1/-2/-3"
        self.same(("--light", at + ",color=#ff8000,intensity=0.5", "--color-mode", "raw"),
                  ("--light", at + ",diffuse=0.5/0.25098039/0,specular=0.5/0.25098039/0", "--color-mode", "raw"))
        self.same(("--light", at + ",color=red,diffuse=0/1/0,specular=0"), ("--light", at + ",diffuse=0/1/0,specular=0"))
        self.other(("--light", at + ",color=red"), ("--light", at + ",color=0/1/0"))
        self.same(("--light", at, "--light-scale", "0.5"), ("--light", at + ",intensity=0.5"))
        self.same(("--light-scale", "1"), ())
        self.other(("--light-scale", "0.5"), ())

    def test_spots(self):
        at = "spot:position=0/0/4,target=0/0/0,"
        self.same(("--light", at + "cutoff=10"), ("--light", "spot:position=0/0/4,direction=0/0/-1,cutoff=10"))
        self.same(("--light", at + "cutoff=10"), ("--light", "spot:position=0/0/4,cutoff=10"))  # points at the middle
        cones = [self.picture("--light", at + keys)[2] for keys in ("cutoff=10", "cutoff=5", "exponent=60", "inner=5,outer=10",
                                                                     "cutoff=10,exponent=60", "cutoff=180")]
        self.assertEqual(len(set(cones)), len(cones))

    def test_frames(self):
        words = ("--rotate", "y:90")
        world, camera = "point:position=0/0/4", "point:position=0/0/4,frame=camera"
        model = "point:position=0/0/4,frame=object"
        self.other(("--light", world), ("--light", camera))
        self.same(("--light", world), ("--light", model))
        self.same((*words, "--light", model), (*words, "--light", "point:position=4/0/0"), 1)
        self.same((*words, "--light", model), (*words, "--light", model + ":sphere"), 1)
        # A light in the camera's frame is at the eye.
        eye = "/".join(map(repr, self.report("sphere", "-s", 16)["camera"]["eye"]))
        self.same(("--light", "point:frame=camera"), ("--light", f"point:position={eye}"), 1)

    def test_rotation_turns_the_model_under_fixed_lights(self):
        light = ("--light", "directional:direction=-1/-1/-1", *DIFFUSE_ONLY, "--view", "front")
        cube = {r: self.picture(*light, *r, model="cube.obj") for r in (("--rotate", "y:0"), ("--rotate", "y:90"), ("--rotate", "y:30"))}
        still, quarter, between = cube.values()
        self.assertLessEqual(difference(still, quarter), 1)  # a cube looks the same, and is lit from there too
        self.assertGreater(difference(still, between), 9)
        both = ("--rotate", "x:90", "--rotate", "y:90"), ("--rotate", "y:90", "--rotate", "x:90")
        a, b = (self.picture(*light, *r, model="teapot") for r in both)
        self.assertGreater(difference(a, b), 9)  # in the given order

    def test_one_camera_for_every_angle(self):
        """A model rotated by any angle about one axis or several is seen by one camera, and is not cut off."""
        for turns in (["y:0"], ["y:45"], ["y:-100"]), (["x:0", "y:0"], ["x:10", "y:45"], ["y:300", "z:50"]):
            cameras = []
            for turn in turns:
                words = [word for one in turn for word in ("--rotate", one)]
                cameras.append(self.report("cube.obj", "-s", "120x90", *words)["camera"])
                width, height, data = self.picture(*words, model="cube.obj", size="120x90")
                alpha = data[3::4]
                rim = alpha[:width] + alpha[-width:] + alpha[::width] + alpha[width - 1::width]
                self.assertEqual(set(rim), {0}, turn)
            self.assertEqual(cameras[1:], cameras[:1] * 2)
        # If the sweep fits, it is the camera of the unrotated model.
        self.assertEqual(*(self.report("sphere", "-s", 64, *words)["camera"] for words in ([], ["--rotate", "y:70"])))
        # A named or exact camera, and the camera of a scene file, do not change.
        self.assertEqual(*(self.report("cube.obj", "-s", 64, "--camera", "eye=1/2/9", *words)["camera"] for words in ([], ["--rotate", "y:70"])))

    def test_errors(self):
        for value, says in {
            "pont": "did you mean 'point'?", "": "expected ambient", "point:positon=1/2/3": "did you mean 'position'?",
            "point:zzz=1": "expected position, direction", "point:position": "expected key=value", "point:position=nan/0/0": "three numbers",
            "point:position=1/2/3,position=1/2/3": "given twice", "point:color=nan": "expected a colour", "point:intensity=inf": "expected a number",
            "spot:cutoff=nan": "number", "point:frame=eye": "expected world, camera", "point:frame=object:": "name of one object", "+none": "expected ambient",
        }.items():
            with self.subTest(value):
                self.bad(1, "sphere", "--light", value, says=["option '--light'", says])
        self.bad(1, "sphere", "--light", "point:frame=object:spere", says=["no object is named 'spere'", "did you mean 'sphere'?"])
        self.bad(1, "sphere", "--light", says="needs a value")
        for value in ("-1", "nan", "blurple"):
            self.bad(1, "sphere", "--ambient", value, says="option '--ambient'")
        for value in ("-1", "nan", "x"):
            self.bad(1, "sphere", "--light-scale", value, says="from 0")
        for value in ("y", "w:30", "y:", "y:nan", "y:1e9", "30"):
            self.bad(1, "sphere", "--rotate", value, says="an axis and degrees")
        self.bad(1, "sphere", "--rig", "lectur", says="did you mean 'lecture'?")


class Markers(Case):
    def test_show_lights(self):
        """Markers glow at the lights in the lights' colours; the lighting of the model and the view do not change."""
        words = ["cube.obj", "-s", "120", "--samples", "1", "--zoom", "0.25", "--light",
                 "point:position=0/2r/0,color=lime"]
        plain, marked = self.png(*words), self.png(*words, "--show-lights")
        green = sum(pixel(marked, x, y)[:3] == (0, 255, 0) for x in range(120) for y in range(60))
        self.assertGreater(green, 1)
        self.assertEqual(pixel(plain, 60, 60), pixel(marked, 60, 60))

    def test_markers_outside_of_the_picture_are_named(self):
        """A marker without visible pixels causes a warning; a marker with visible pixels causes none."""
        def warned(*words):
            report = self.report("cube.obj", "-s", "120x80", "--samples", "1", "--show-lights", *words)
            return " ".join(w for w in report.get("warnings", []) if "--show-lights" in w)

        for camera in ("eye=0/0/8,fovy=40", "eye=0/0/8,ortho=3"):
            for x, y in ((0, 2.5), (3.5, 0), (0, -4), (-4.2, 2.8), (6, 0), (0, 9), (1.5, -1.5)):
                lamp = ("--camera", camera, "--light", f"point:position={x}/{y}/0,color=lime,name=lamp")
                plain, marked = self.png("cube.obj", "-s", "120x80", *lamp), self.png("cube.obj", "-s", "120x80", *lamp, "--show-lights")
                seen = plain[2] != marked[2]
                self.assertEqual(bool(warned(*lamp)), not seen, (camera, x, y))
        camera = ("--camera", "eye=0/0/8,fovy=40")
        self.assertIn("the marker of light 'lamp' lies outside", warned(*camera, "--light", "point:position=0/0/9,name=lamp"))  # behind the eye
        self.assertEqual(warned(*camera, "--light", "point:position=0/0/7,name=lamp"), "")
        many = [word for i in range(5) for word in ("--light", f"point:position={90 + i}/0/0")]
        self.assertIn("the markers of lights 1, 2, 3 and 2 more lie outside", warned(*camera, *many))
        self.assertEqual(warned("--zoom", "0.1"), "")
