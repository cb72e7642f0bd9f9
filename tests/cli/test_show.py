# test_show.py: --show: terms that add up, numbers with their encodings, lights by name.
import json
import struct
import zlib

from harness import Case, pixel, png_chunks, read_png

SIZE = 40


class Show(Case):
    def floats(self, *words):
        """The numbers of a PFM, in the file's order."""
        self.good(*words, "-s", SIZE, "-o", "a.pfm")
        data = (self.folder / "a.pfm").read_bytes()
        if data.startswith(b"Pf"):  # one number for each pixel
            return sum(((v,) * 3 for v in struct.unpack("<%df" % (SIZE * SIZE), data[-SIZE * SIZE * 4:])), ())
        return struct.unpack("<%df" % (SIZE * SIZE * 3), data[-SIZE * SIZE * 12:])

    def test_terms_add_up(self):
        for words in (), ("--shading", "gouraud"), ("--shading", "flat"), ("--reflection", "none"):
            with self.subTest(words):
                whole = self.floats("cube.obj", *words)
                terms = [self.floats("cube.obj", *words, "--show", t)
                         for t in ("ambient", "diffuse", "specular", "emission", "reflection")]
                for values in zip(whole, *terms):
                    self.assertAlmostEqual(values[0], sum(values[1:]), delta=1e-6)
                self.assertGreater(max(whole), 0.1)

    def test_lights_add_up(self):
        whole = self.floats("cube.obj")
        lights = [self.floats("cube.obj", "--show", "light:" + n) for n in ("key", "fill", "3", "sky")]
        for values in zip(whole, *lights):
            self.assertAlmostEqual(values[0], sum(values[1:]), delta=1e-6)

    def test_codes(self):
        middle = {what: pixel(self.png("sphere", "--view", "front", "-s", SIZE + 1, "--show", what, "-b", "white"), 20, 20)
                  for what in ("normals", "facing", "coverage", "n.l", "overdraw", "clipped")}
        self.assertTrue(all(abs(a - b) <= 2 for a, b in zip(middle["normals"], (128, 128, 255, 255))), middle)
        self.assertEqual(middle["facing"], (0, 102, 255, 255))
        self.assertEqual(middle["coverage"], (255, 255, 255, 255))
        self.assertEqual(middle["overdraw"], (102, 102, 102, 255))  # front and back
        self.assertEqual(middle["n.l"][0], middle["n.l"][2])

    def test_glass(self):
        """glass is a material like the named ones: it is transparent, and keys after the name change it."""
        plain = self.png("cube.obj", "-s", 48, "-b", "white", "--material", "white,roughness=0,transmission=1")
        self.assertEqual(plain, self.png("cube.obj", "-s", 48, "-b", "white", "--material", "glass"))
        self.assertEqual(plain, self.png("cube.obj", "-s", 48, "-b", "white", "--material", "red", "--material", "Glass"))
        rough = self.png("cube.obj", "-s", 48, "-b", "white", "--material", "glass,roughness=0.4")
        self.assertEqual(rough, self.png("cube.obj", "-s", 48, "-b", "white", "--material", "white,roughness=0.4,transmission=1"))
        self.assertNotEqual(rough, plain)
        self.bad(1, "cube.obj", "--material", "glas", says="did you mean 'glass'?")
        self.assertIn("--material glass", self.good("help", "glass").stdout.decode())

    def test_materials(self):
        """Material properties: colours with the sRGB curve, numbers unchanged; classic materials have no roughness."""
        gold = ("sphere", "--view", "front", "-s", SIZE + 1, "--material", "#ffc356,metallic=0.6,roughness=0.4")
        at = lambda what, *more: pixel(self.png(*gold, "--show", what, *more), 20, 20)
        self.assertEqual(at("base-color"), (255, 195, 86, 255))
        self.assertEqual(at("base-color", "--color-mode", "raw")[0], 255)
        for shading in ("flat", "gouraud", "phong"):
            self.assertEqual((at("roughness", "--shading", shading), at("metallic", "--shading", shading)), ((102, 102, 102, 255), (153, 153, 153, 255)))
        self.assertEqual(at("roughness", "--reflection", "phong"), (102, 102, 102, 255))
        self.assertEqual((at("occlusion"), at("lod")), ((255, 255, 255, 255), (0, 0, 0, 255)))
        self.assertEqual(pixel(self.png("sphere", "--view", "front", "-s", SIZE + 1, "--show", "roughness"), 20, 20), (0, 0, 0, 255))
        self.assertEqual(self.floats(*gold[:-2], "--material", "#ffc356,metallic=0.6,roughness=0.4", "--show", "roughness")[SIZE * SIZE // 2 * 3 + 60], struct.unpack("f", struct.pack("f", 0.4))[0])

    def test_environment_is_black_with_a_sentence(self):
        """Without an environment and without physical materials, --show environment says why it is black."""
        said = lambda *words: "--show environment' is black" in self.good(*words, "-s", 16, "--show", "environment", "-o", "e.png").stderr.decode()
        physical = ("--material", "white,roughness=0.4")
        self.assertTrue(said("sphere"))
        self.assertTrue(said("sphere", *physical, "--light", "point"))
        self.assertFalse(said("sphere", *physical))
        self.assertFalse(said("sphere", "--environment", "sky", "--reflectivity", "0.5"))

    def test_vectors_without_maps(self):
        """Normals and cosines are not colours: a texture does not multiply them, wherever they are computed."""
        (self.folder / "red.ppm").write_bytes(b"P6 1 1 255\n\xff\x10\x08")
        (self.folder / "red.mtl").write_text("newmtl a\nmap_Kd red.ppm\n")
        mesh = "usemtl a\nv -1 -1 0\nv 1 -1 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
        for name, start in ("red.obj", "mtllib red.mtl\n"), ("plain.obj", ""):
            (self.folder / name).write_text(start + mesh)
        for what in ("normals", "tangents", "n.l", "n.h"):
            for shading in ("phong", "gouraud", "flat"):
                words = ("--view", "front", "--light", "directional:direction=0/0/-1", "--shading", shading, "--show", what)
                self.assertEqual(self.floats("red.obj", *words), self.floats("plain.obj", *words), (what, shading))

    def test_colors_without_material(self):
        """A surface with vertex colours and no material shows these colours, also from a scene file; without colours, it is grey."""
        head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        tail = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        corners = ("-9 -9 0", "9 -9 0", "0 9 0")
        (self.folder / "colored.ply").write_text(head + colors + tail + "".join(c + " 250 130 20\n" for c in corners) + "3 0 1 2\n")
        (self.folder / "plain.ply").write_text(head + tail + "".join(c + "\n" for c in corners) + "3 0 1 2\n")
        (self.folder / "colored.obj").write_text("".join("v %s 0.5 0.25 1\n" % c for c in corners) + "f 1 2 3\n")
        (self.folder / "both.json").write_text('{"lambent": 1, "objects": [{"file": "colored.ply"}, {"file": "plain.ply", "transform": [["translate", 30, 0, 0]]}]}')
        look = ("-s", SIZE + 1, "--show", "base-color", "--camera", "eye=0/0/30,target=0/0/0,fovy=10")
        grey = pixel(self.png("plain.ply", *look), 20, 20)
        self.assertTrue(grey[0] == grey[1] == grey[2] and 200 < grey[0] < 212, grey)
        self.assertEqual(pixel(self.png("colored.ply", *look), 20, 20), (250, 130, 20, 255))
        self.assertEqual(pixel(self.png("both.json", *look), 20, 20), (250, 130, 20, 255))
        self.assertEqual(pixel(self.png("colored.obj", *look), 20, 20), (128, 64, 255, 255))
        self.assertEqual(pixel(self.png("both.json", *look[:-1], "eye=30/0/30,target=30/0/0,fovy=10"), 20, 20), grey)

    def test_background(self):
        """Quantities of surfaces use the picture's background, also on sheets; quantities of pixels have no background."""
        names = {"normals": 1, "depth": 1, "facing": 1, "ids": 1, "n.l": 1, "n.h": 1, "diffuse": 1, "picture": 1, "coverage": 0, "overdraw": 0}
        for what, shows in names.items():
            for color, bytes4 in (("#506070", (0x50, 0x60, 0x70, 255)), ("#ff800080", (255, 128, 0, 128)), (None, (0, 0, 0, 0))):
                words = ["sphere", "-s", 16, "--show", what] + (["-b", color] if color else [])
                self.assertEqual(pixel(self.png(*words), 0, 0), bytes4 if shows else (0, 0, 0, 255), words)
        self.good("sphere", "-s", 16, "--show", "depth", "-b", "#506070", "-o", "a.ppm")
        self.assertEqual((self.folder / "a.ppm").read_bytes()[-3 * 256:][:3], bytes((0x50, 0x60, 0x70)))
        self.assertEqual(self.floats("sphere", "--show", "depth", "-b", "#506070")[:3], (0, 0, 0))
        for words, at in (("materials",), (1, 1)), (("compare", "cube.obj", "--across", "show=depth,ambient"), (6, 6)):
            for color, bytes4 in ((None, (255, 255, 255, 255)), ("#506070", (0x50, 0x60, 0x70, 255))):
                sheet = self.png(*words, "-s", 60, "--no-captions", *(["-b", color] if color else []))
                self.assertEqual(pixel(sheet, *at), bytes4, words)
        self.assertEqual(pixel(self.png("materials", "-s", 60, "-b", "transparent", "--no-captions"), 1, 1), (0, 0, 0, 0))

    def test_depth_range(self):
        """The nearest vertex is white, and the report contains both ends."""
        report = self.report("cube.obj", "--view", "front", "-s", 33, "--show", "depth", "-o", "d.png")["image"]
        near, far = report["depth_near"], report["depth_far"]
        whole = read_png((self.folder / "d.png").read_bytes())
        self.assertEqual(pixel(whole, 16, 16), (255, 255, 255, 255))  # the cube's front
        size = self.report("cube.obj", "-s", 33)["model"]["bounds"]
        self.assertAlmostEqual(far - near, size["max"][2] - size["min"][2], delta=1e-5)
        self.good("cube.obj", "-s", 33, "--show", "depth", "-o", "d.pfm")
        self.assertNotIn("depth_near", self.report("cube.obj", "-s", 33)["image"])

    def test_one_surface_at_several_samples(self):
        """Two squares, one behind the other: no pixel at an edge stores a mean of both."""
        corners = [(0.98, -0.2), (0.2, 0.98), (-0.98, 0.2), (-0.2, -0.98)]
        (self.folder / "two.obj").write_text("".join(f"v {k * x} {k * y} {z}\n" for z, k in ((0, 1), (-5, 3)) for x, y in corners) +
                                             "o near\nf 4 1 2 3\no far\nf 8 5 6 7\n")
        has_gl = b"\ngl " in self.good("devices").stdout
        for device in ("cpu", "gl") if has_gl else ("cpu",):
            for show, expected in (("depth", 2), ("ids", 3), ("facing", 1), ("base-color", 1), ("normals", 1)):
                for samples in (1, 2, 4, 8, 16):
                    found = self.floats("two.obj", "--projection", "orthographic", "--azimuth", 0, "--elevation", 0, "--show", show,
                                        "--samples", samples, "--device", device)
                    pixels = {tuple(round(x, 3) for x in found[i:i + 3]) for i in range(0, len(found), 3)} - {(0, 0, 0)}
                    self.assertLessEqual(len(pixels), expected, (device, show, samples, pixels))

    def test_numbers_are_not_srgb(self):
        for what, expected in ("normals", False), ("diffuse", True), ("picture", True):
            self.good("sphere", "-s", 16, "--show", what, "-o", what + ".png")
            self.assertEqual(b"sRGB" in (self.folder / (what + ".png")).read_bytes(), expected, what)

    def test_wrong(self):
        self.bad(1, "cube.obj", "--show", "diffuze", says=("diffuze", "did you mean 'diffuse'?", "overdraw"))
        self.bad(1, "cube.obj", "--show", "light", says="light:NAME")
        self.bad(1, "cube.obj", "--show", "n.l:", says="after the colon")
        self.bad(1, "cube.obj", "--show", "light:kye", says=("'kye'", "'key', 'fill', 'rim', 'sky'"))
        self.bad(1, "cube.obj", "--show", "n.h:sky", says="no light with a direction is 'sky'")
        self.bad(1, "cube.obj", "--show", "n.l", "--rig", "none", says="there is none")

    def single(self, *words):
        """The numbers of a 16-bit PNG and of a PFM with one channel, row by row from the top."""
        self.good(*words, "-s", SIZE, "-o", "n.png")
        chunks = list(png_chunks((self.folder / "n.png").read_bytes()))
        self.assertEqual(struct.unpack(">IIBB", chunks[0][1][:10]), (SIZE, SIZE, 16, 0))
        raw, above, rows = zlib.decompress(b"".join(body for kind, body in chunks if kind == b"IDAT")), [0] * 2 * SIZE, []
        for y in range(SIZE):
            kind, row = raw[y * (2 * SIZE + 1)], list(raw[y * (2 * SIZE + 1) + 1:(y + 1) * (2 * SIZE + 1)])
            for i in range(2 * SIZE):
                a, b, c = row[i - 2] if i > 1 else 0, above[i], above[i - 2] if i > 1 else 0
                nearest = min((a, b, c), key=lambda v: (abs(a + b - c - v), (a, b, c).index(v)))
                row[i] = (row[i] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
            rows += struct.unpack(">%dH" % SIZE, bytes(row))
            above = row
        self.good(*words, "-s", SIZE, "-o", "n.pfm")
        data = (self.folder / "n.pfm").read_bytes()
        self.assertTrue(data.startswith(b"Pf\n"))
        floats = struct.unpack("<%df" % (SIZE * SIZE), data[-SIZE * SIZE * 4:])
        return rows, [v for y in reversed(range(SIZE)) for v in floats[y * SIZE:(y + 1) * SIZE]]

    def test_depth_with_a_scale(self):
        whole, exact = self.single("teapot", "--show", "depth", "--depth-scale", 1000)
        self.assertGreater(max(exact), 1)
        self.assertEqual([round(1000 * v) for v in exact if not abs(1000 * v % 1 - 0.5) < 0.01],
                         [w for w, v in zip(whole, exact) if not abs(1000 * v % 1 - 0.5) < 0.01])
        self.bad(4, "teapot", "--show", "depth", "--depth-scale", 1e6, "-o", "d.png", says=["expected a scale of at most"], leaves=["n.png", "n.pfm"])

    def test_labels(self):
        """Three boxes side by side, in two objects: the labels stand where the boxes are, and the names beside them."""
        text = "".join(f"g {name}\n" + "".join(f"v {x + 3 * k} {y} 0\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))) +
                       f"f {4 * k + 1} {4 * k + 2} {4 * k + 3} {4 * k + 4}\n" for k, name in enumerate(("left", "middle")))
        (self.folder / "two.obj").write_text(text)
        (self.folder / "s.json").write_text(json.dumps({"lambent": 1, "objects": [{"file": "two.obj"}, {
            "file": "two.obj", "name": "second", "transform": [["translate", 6, 0, 0]]}]}))
        self.given = self.new_files() | self.given
        words = ("s.json", "--azimuth", 0, "--elevation", 0)
        for quantity, wanted in (("part-id", [1, 2, 3, 4]), ("object-id", [1, 2])):
            labels, floats = self.single(*words, "--show", quantity)
            self.assertEqual([float(v) for v in labels], list(floats))
            row = labels[SIZE // 2 * SIZE:(SIZE // 2 + 1) * SIZE]
            self.assertEqual([v for i, v in enumerate(row) if v and (i == 0 or row[i - 1] != v)], wanted if quantity == "part-id" else [1, 1, 2, 2])
        self.assertEqual(self.report(*words, "--show", "part-id", "-s", 8, "-o", "l.png")["image"]["labels"], ["left", "middle"] * 2)
        self.good("batch", "s.json", "--view", 2, "--show", "object-id,part-id", "-s", 8, "-o", "out/")
        cameras = json.loads((self.folder / "out" / "transforms.json").read_text())
        self.assertEqual((len(cameras["object-id"]), cameras["part-id"]), (2, ["left", "middle"] * 2))
        colors = {pixel(self.png(*words, "--show", "part-id", "-s", 64, "-o", "-", "--turntable", 2), 4, 32)}
        self.assertEqual(len(colors), 1)

    def test_world_normals(self):
        """A quad that faces z has the normal 0, 0, 1 from every side."""
        for azimuth in (0, 30, -50):
            values = self.floats("quad.obj" if (self.folder / "quad.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n") else "",
                                 "--azimuth", azimuth, "--show", "normals-world")
            middle = 3 * (SIZE // 2 * SIZE + SIZE // 2)
            for value, wanted in zip(values[middle:middle + 3], (0, 0, 1)):
                self.assertAlmostEqual(value, wanted, places=5)


class All(Case):
    def test_layers(self):
        done = self.run_program("cube.obj", "-s", "16", "--show", "all", "-o", "all.exr")
        if b"OpenEXR" in done.stderr and done.returncode == 3:
            self.skipTest("OpenEXR's library is not installed")
        self.assertEqual(done.returncode, 0, done.stderr)
        data = (self.folder / "all.exr").read_bytes()
        for name in (b"ambient.R", b"diffuse.G", b"specular.B", b"emission.R", b"reflection.R", b"light.1-key.R", b"light.4-sky.B"):
            self.assertIn(name + b"\0", data)
        self.bad(1, "cube.obj", "--show", "all", "-o", "all.png", says=".exr", leaves=["all.exr"])
