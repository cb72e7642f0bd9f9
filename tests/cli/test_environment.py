# test_environment.py: --environment in each of its forms, its rotation and its errors; and --opacity.
import json
import struct

from harness import Case, pixel, read_png

FACES = ((255, 0, 0), (0, 255, 255), (255, 255, 255), (30, 30, 30), (0, 255, 0), (0, 0, 255))
MIRROR = ("sphere", "-s", 40, "--view", "front", "--samples", 1, "--rig", "none", "--reflectivity", 1, "--material", "ambient=0", "-q")


class Pictures(Case):
    def ppm(self, name, width, height, color_at):
        """A picture of the colours that color_at(x, y) gives."""
        data = bytes(part for y in range(height) for x in range(width) for part in color_at(x, y))
        (self.folder / name).write_bytes(b"P6\n%d %d\n255\n" % (width, height) + data)
        return name

    def draw(self, environment, *more, model=MIRROR):
        data = self.good(*model, "--reflection-map", environment, *more, "-o", "-").stdout
        return read_png(data), data

    def six(self):
        return ",".join(self.ppm(f"f{i}.ppm", 4, 4, lambda x, y: color) for i, color in enumerate(FACES))


class EnvironmentOption(Pictures):
    def test_crosses_are_six_faces(self):
        places = {True: ((2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1)), False: ((2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (1, 3))}
        six = self.draw(self.six())[1]
        for lying, at in places.items():
            colors = dict(zip(at, FACES))
            cross = self.ppm("cross.ppm", 16 if lying else 12, 12 if lying else 16, lambda x, y: colors.get((x // 4, y // 4), (9, 9, 9)))
            self.assertEqual(self.draw(cross)[1], six, lying)

    def test_where_faces_lie(self):
        """In the middle, a mirror ball seen from the front shows the direction behind the eye, +Z; at its right, it shows +X."""
        picture, _ = self.draw(self.six())
        self.assertEqual(pixel(picture, 20, 20)[:3], FACES[4])
        self.assertEqual(pixel(picture, 34, 20)[:3], FACES[0])
        self.assertEqual(pixel(picture, 6, 20)[:3], FACES[1])
        self.assertEqual(pixel(picture, 20, 6)[:3], FACES[2])
        self.assertEqual(pixel(picture, 20, 34)[:3], FACES[3])
        # Counter-clockwise from above: +X moves to -Z, and +Z to +X.
        picture, data = self.draw(self.six(), "--environment-rotation", 90)
        self.assertEqual(pixel(picture, 34, 20)[:3], FACES[4])
        self.assertEqual(pixel(picture, 20, 20)[:3], FACES[1])
        self.assertEqual(self.draw(self.six(), "--environment-rotation", -270)[1], data)
        picture, _ = self.draw(self.six(), "--reflectivity", "0/0.5/1", "--color-mode", "raw")
        self.assertEqual(pixel(picture, 6, 20)[:3], (0, 128, 255))

    def test_equirectangular(self):
        halves = self.ppm("halves.ppm", 64, 32, lambda x, y: (255, 0, 0) if x < 32 else (0, 0, 255))
        read = lambda data: [pixel(data, x, 20)[:3] for x in (6, 34)]
        self.assertEqual(read(self.draw(halves)[0]), [(255, 0, 0), (0, 0, 255)])
        self.assertEqual(read(self.draw(halves, "--environment-rotation", 180)[0]), [(0, 0, 255), (255, 0, 0)])
        # The same with PNG, and with floats in Radiance and PFM.
        self.good("teapot", "-s", "64x32", "-q", "-b", "#406080", "-o", "a.png")
        self.good("teapot", "-s", "64x32", "-q", "-b", "#406080", "-o", "a.ppm")
        self.assertEqual(self.draw("a.png")[1], self.draw("a.ppm")[1])
        (self.folder / "b.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + bytes((64, 128, 192, 128)) * 8)
        (self.folder / "b.pfm").write_bytes(b"PF\n4 2\n-1.0\n" + struct.pack("<24f", *(0.25, 0.5, 0.75) * 8))
        (picture, one), (_, other) = self.draw("b.hdr", "--color-mode", "raw"), self.draw("b.pfm", "--color", "raw")
        self.assertEqual(one, other)
        self.assertEqual(pixel(picture, 20, 20)[:3], (64, 128, 191))

    def test_explained(self):
        text = self.good("explain", "sphere", "20,20", *MIRROR[1:-1], "--reflection-map", self.six()).stdout.decode()
        self.assertIn("kr ⊙ environment = (1 1 1) ⊙ (0 1 0)", text)

    def test_lights_classic_materials(self):
        """The white furnace: classic materials return their share of a constant environment. A mirror's mean is its environment's, and lights are added."""
        (self.folder / "white.pfm").write_bytes(b"PF\n4 2\n-1.0\n" + struct.pack("<24f", *(1,) * 24))
        furnace = ("sphere", "-s", 40, "--view", "front", "--samples", 1, "--exposure", 0, "--tone", "none", "--ao", "off", "-q", "--color-mode", "raw",
                   "--environment", "white.pfm", "-o", "-")
        for material, low, high in (("diffuse=1,specular=0", 253, 255), ("diffuse=1,specular=0.5,shininess=300", 253, 255), ("diffuse=0.5,specular=0", 124, 138),
                                    ("diffuse=0/0/0,specular=0", 3, 14), ("diffuse=0/0/0,specular=0,reflectivity=1", 253, 255),
                                    ("diffuse=0/0/0,specular=0,reflectivity=0.5", 126, 138)):
            picture = read_png(self.good(*furnace, "--material", material).stdout)
            for at in (20, 20), (28, 14), (12, 25):
                self.assertTrue(low <= pixel(picture, *at)[1] <= high, (material, at, pixel(picture, *at)))
        self.good("convert", "sphere", "a.stl", "-q")
        draw = lambda *words: self.good("a.stl", "-s", 40, "-q", *words, "-o", "-").stdout
        lit = draw("--environment", "sky")
        self.assertEqual(len({lit, draw(), draw("--environment", "studio"), draw("--environment", "sky", "--environment-rotation", 90)}), 4)
        # It replaces the rig, also if options change the rig's lights, and is added to lights that the user names.
        self.assertEqual(draw("--environment", "sky", "--light-scale", 3), lit)
        self.assertNotEqual(draw("--environment", "sky", "--light", "directional:direction=-1/-1/-1"), lit)
        self.assertNotEqual(draw("--environment", "sky", "--rig", "headlight"), lit)
        # The last of the two options counts; the saved scene file gives the same picture.
        self.assertEqual(draw("--reflection-map", "studio", "--environment", "sky"), lit)
        self.assertEqual(draw("--environment", "studio", "--reflection-map", "sky", "--reflectivity", 0.5), draw("--reflection-map", "sky", "--reflectivity", 0.5))
        for word, key in (("--environment", "environment"), ("--reflection-map", "reflection_map")):
            saved = draw(word, "sky", "--reflectivity", 0.5, "--save-scene", "s.json")
            self.assertEqual(json.loads((self.folder / "s.json").read_text())[key]["builtin"], "sky")
            self.assertEqual(self.good("s.json", "-q", "-o", "-").stdout, saved)
        (self.folder / "two.json").write_text(json.dumps({"lambent": 1, "environment": {"builtin": "sky"}, "reflection_map": {"builtin": "sky"}, "objects": [{"shape": "cube"}]}))
        self.bad(2, "two.json", "-o", "x.png", says="reflection_map: found together with 'environment'")

    def test_explained_light(self):
        """`explain` adds up the environment's share of a classic material."""
        words = ("explain", "teapot", "20,22", "-s", 40, "--samples", 1, "--environment", "sky", "--material", "diffuse=0.6/0.3/0.1,specular=0.4,shininess=20", "--json")
        point = json.loads(self.good(*words).stdout)["triangles"][0]["points"][0]
        around, terms = point["environment"], point["terms"]
        for c in range(3):
            self.assertGreater(around["diffuse_part"][c], 0)
            self.assertAlmostEqual(around["diffuse_part"][c], terms["diffuse"][c], 6)
            self.assertAlmostEqual(around["specular_part"][c], terms["specular"][c], 6)

    def test_none(self):
        """`none` removes a scene file's environment, also from its copy. A physical model without lights then has the rig's lights."""
        ball = {"lambent": 1, "image": {"size": [40, 40]}, "objects": [{"shape": "sphere", "material": {"reflectivity": [1, 1, 1]}}], "lights": []}
        for name, more in (("ball.json", {}), ("sky.json", {"environment": {"builtin": "sky"}})):
            (self.folder / name).write_text(json.dumps({**ball, **more}))
        plain, sky = (self.good(name, "-q", "-o", "-").stdout for name in ("ball.json", "sky.json"))
        self.assertNotEqual(plain, sky)
        self.assertEqual(self.good("sky.json", "-q", "--environment", "none", "--save-scene", "copy.json", "-o", "-").stdout, plain)
        self.assertEqual(self.good("copy.json", "-q", "-o", "-").stdout, plain)
        frames = self.good("sky.json", "-q", "--environment", "none", "--turntable", "2", "-o", "{frame}.png") and sorted(self.folder.glob("*.png"))
        self.assertEqual([frame.read_bytes() == plain for frame in frames], [True, True])
        metal = ("sphere", "-s", 40, "-q", "--material", "metallic=1,roughness=0.3,diffuse=0.9/0.7/0.4", "-o", "-")
        self.assertEqual(self.good(*metal, "--environment", "none").stdout, self.good(*metal, "--rig", "studio").stdout)
        self.assertNotEqual(self.good(*metal).stdout, self.good(*metal, "--environment", "none").stdout)

    def test_reference(self):
        """The integral over directions: close to the split sum for mirror-like lobes, reported with its number, and rejected if out of range."""
        metal = (*MIRROR[:-1], "--material", "#ffc356,metallic=1,roughness=0.1", "--environment", "sky", "--tone", "none", "-q")
        split, summed = (read_png(self.good(*metal, *more, "-o", "-").stdout) for more in ((), ("--reference", 1024)))
        apart = [abs(a - b) for y in range(12, 28) for x in range(12, 28) for a, b in zip(pixel(split, x, y), pixel(summed, x, y))]
        self.assertGreater(max(apart), 0)
        self.assertLess(sum(apart) / len(apart), 4)
        text = self.good("explain", "sphere", "20,20", *metal[1:-1], "--reference", 64).stdout.decode()
        self.assertIn("the integral of the environment's light, by 64 directions", text)
        self.assertNotIn("prefiltered", text)
        line = json.loads(self.good("explain", "sphere", "20,20", *metal[1:-1], "--reference", 64, "--json").stdout)
        self.assertEqual(line["reference"], 64)
        self.bad(1, *metal, "--reference", 5, "-o", "x.png", says=("reference is 5", "16 to 1048576"))
        self.bad(1, *metal, "--reference", 2000000, "-o", "x.png", says="0 to 1048576")

    def test_wrong(self):
        self.ppm("odd.ppm", 10, 7, lambda x, y: (1, 2, 3))
        good = self.ppm("good.ppm", 4, 4, lambda x, y: (1, 2, 3))
        self.bad(2, *MIRROR, "--environment", "missing.hdr", "-o", "x.png", says=("option '--environment': missing.hdr", "cannot open"))
        self.bad(3, *MIRROR, "--environment", "odd.ppm", "-o", "x.png", says=("odd.ppm", "10×7", "2:1"))
        self.bad(3, *MIRROR, "--environment", ",".join([good] * 5 + ["odd.ppm"]), "-o", "x.png", says=("odd.ppm", "squares of one size"))
        self.bad(1, *MIRROR, "--environment", ",".join([good] * 5), "-o", "x.png", says=("found 5 names", "px,nx,py,ny,pz,nz"))
        self.bad(1, *MIRROR, "--environment", ",".join([good] * 5) + ",", "-o", "x.png", says="one of them empty")
        (self.folder / "text.png").write_text("not a picture")
        self.bad(2, *MIRROR, "--environment", "text.png", "-o", "x.png", says=("text.png", "byte 0"))
        self.bad(1, *MIRROR, "--reflectivity", "-1", "-o", "x.png", says="0 to 1000")


class Background(Pictures):
    """--background environment[:BLUR]: the environment along the rays of the camera."""

    def floats(self, *words, size=40):
        data = self.good(*words, "-s", size, "--samples", 1, "-q", "-o", "out.pfm") and (self.folder / "out.pfm").read_bytes()
        numbers = struct.unpack("<%df" % (size * size * 3), data[-12 * size * size:])
        return lambda x, y: numbers[3 * ((size - 1 - y) * size + x):][:3]

    def test_white_furnace(self):
        """A white matt ball before a white environment is invisible."""
        (self.folder / "white.pfm").write_bytes(b"PF\n4 2\n-1.0\n" + struct.pack("<24f", *(1,) * 24))
        for blur in ("", ":0", ":0.3", ":1"):
            data = read_png(self.good("sphere", "--environment", "white.pfm", "--background", "environment" + blur, "--material", "diffuse=1,specular=0", "-s", 24,
                                      "--ao", "off", "--exposure", 0, "--tone", "none", "-q", "-o", "-").stdout)
            self.assertTrue(all(v >= 253 for v in data[2]), blur)

    def test_rays(self):
        """The camera looks at -Z from the front; at the picture's edge, the direction differs by half the angle of view; rays of an orthographic view are parallel."""
        six = ("cube", "--environment", self.six(), "--background", "environment", "--exposure", 0, "--color-mode", "raw", "--tone", "none")
        same = lambda found, i: [self.assertAlmostEqual(a, b / 255, 5, i) for a, b in zip(found, FACES[i])]
        for side, i in (("front", 5), ("back", 4), ("left", 0), ("right", 1), ("top", 3), ("bottom", 2)):
            same(self.floats(*six, "--view", side, "--fov", 5)(0, 0), i)
        wide = self.floats(*six, "--camera", "eye=0/0/30,target=0/0/0,fovy=120")
        for x, y, i in ((15, 15, 5), (1, 20, 1), (38, 20, 0), (20, 1, 2), (20, 38, 3)):
            same(wide(x, y), i)
        same(self.floats(*six, "--view", "front", "--fov", 5, "--environment-rotation", 90)(0, 0), 0)
        flat = self.floats(*six, "--view", "front", "--projection", "orthographic")
        same(flat(0, 0), 5)
        same(flat(39, 39), 5)

    def test_exposure_blur_and_doors(self):
        sky = ("cube", "--environment", "sky", "--background", "environment:0.2")
        one, two = (self.floats(*sky, "--exposure", stops) for stops in (0, 1))
        self.assertAlmostEqual(one(2, 2)[1] * 2, two(2, 2)[1], 6)
        png = lambda *words: self.good(*words, "-s", 40, "-q", "-o", "-").stdout
        pictures = [png("cube", "--environment", "sky", "--background", text) for text in ("environment", "environment:0", "environment:0.2", "environment:1", "white")]
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(len(set(pictures)), 4)
        saved = png(*sky, "--save-scene", "s.json")
        self.assertEqual(saved, pictures[2])
        self.assertEqual(png("s.json"), saved)
        self.assertEqual(png("s.json", "--background", "white"), pictures[4])
        self.assertEqual(read_png(saved)[2][3::4], b"\xff" * 1600)
        for at in ("2,2", "20,20", "12,9"):
            told = json.loads(self.good("explain", *sky, at, "-s", 40, "--json").stdout)
            self.assertEqual(tuple(told["bytes"]), pixel(read_png(saved), *map(int, at.split(","))), at)
        self.assertNotIn(b"\xff" * 40, read_png(png(*sky, "--show", "normals"))[2])
        self.bad(1, "cube", "--background", "environment", "-o", "x.png", says="no environment lights this scene")
        self.bad(1, "cube", "--background", "environment:2", "-o", "x.png", says="environment:BLUR from 0 to 1")


class Opacity(Case):
    def test_layers(self):
        """One side of a cube transmits half, and both sides a quarter; 1 is opaque, 0 shows nothing."""
        words = ("cube", "-s", 20, "--view", "front", "--samples", 1)
        for opacity, more, alpha in ((0.5, ("--cull", "back"), 128), (0.5, (), 191), (1, (), 255), (0, (), 0), (0.2, ("--cull", "front"), 51)):
            picture = self.png(*words, "--opacity", opacity, *more)
            self.assertEqual(pixel(picture, 10, 10)[3], alpha, (opacity, more))
        # Over white, in raw numbers: the mean of the surface and its background.
        plain, half = (pixel(self.png(*words, "--cull", "back", "--color-mode", "raw", "-b", "white", "--opacity", opacity), 10, 10) for opacity in (1, 0.5))
        for c in range(3):
            self.assertLessEqual(abs(half[c] - (plain[c] + 255) / 2), 1)
