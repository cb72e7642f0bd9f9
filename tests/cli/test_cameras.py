# test_cameras.py: cameras as data: intrinsics and poses against OpenCV's formula, and off-centre pictures against parts of larger ones.
import json
import math
import struct

from harness import Case, read_png

# Three points of a triangle without symmetry, in front of cameras about 4 units away.
CORNERS = ((-0.7, -0.4, 0.2), (0.8, -0.1, -0.3), (0.1, 0.9, 0.4))


def turned(x, y, position):
    """A pose with the axes of OpenCV: the camera that looks along -z is turned about x, then about y, in degrees."""
    a, b = math.radians(x), math.radians(y)
    right = (math.cos(b), 0, -math.sin(b))
    down = (-math.sin(b) * math.sin(a), -math.cos(a), -math.cos(b) * math.sin(a))
    ahead = (-math.sin(b) * math.cos(a), math.sin(a), -math.cos(b) * math.cos(a))
    return [[right[i], down[i], ahead[i], position[i]] for i in range(3)] + [[0, 0, 0, 1]]


def opengl(pose):
    """The same pose with the axes of OpenGL."""
    return [[row[0], -row[1], -row[2], row[3]] for row in pose[:3]] + [pose[3]]


def projected(point, K, pose):
    """OpenCV's formula: the point in the camera's axes, then u = fx X/Z + cx and v = fy Y/Z + cy."""
    x, y, z = (sum(pose[k][axis] * (point[k] - pose[k][3]) for k in range(3)) for axis in range(3))
    fx, fy, cx, cy = K
    return fx * x / z + cx, fy * y / z + cy, z


def words(K, pose, **more):
    pairs = dict(zip(("fx", "fy", "cx", "cy"), K), pose="/".join(repr(float(n)) for row in pose for n in row), **more)
    return ",".join("%s=%s" % pair for pair in pairs.items())


class Cameras(Case):
    # size, fx, fy, cx, cy, pose: centred; off centre; fx and fy differ; a tall picture whose axis is outside
    ROWS = (((200, 200), (300, 300, 99.5, 99.5), turned(0, 0, (0, 0, 4))),
            ((240, 160), (260, 260, 150.25, 110.5), turned(-8, 5, (0.3, 0.2, 4))),
            ((200, 120), (330, 180, 90, 70), turned(12, -20, (-1.5, -1, 3.6))),
            ((180, 440), (260, 500, 4.5, 260.25), turned(3, 24, (0.9, -0.3, 3.8))))

    def setUp(self):
        super().setUp()
        (self.folder / "three.obj").write_text("".join("v %g %g %g\n" % point for point in CORNERS) + "f 1 2 3\n")

    def middle(self, size, *words):
        """The middle of the area that a picture covers, in pixels as OpenCV counts them. (The 16 samples of a pixel are not symmetric about
        its centre: their mean is 1/32 pixel away.)"""
        self.good("three.obj", "-s", "%dx%d" % size, "--show", "coverage", "--samples", 8, "-o", "a.pfm", *words)
        data = struct.unpack("<%df" % (3 * size[0] * size[1]), (self.folder / "a.pfm").read_bytes()[-12 * size[0] * size[1]:])[::3]
        total = sum(data)
        self.assertGreater(total, 1000)
        return (sum(value * (at % size[0]) for at, value in enumerate(data)) / total,
                sum(value * (size[1] - 1 - at // size[0]) for at, value in enumerate(data)) / total)

    def test_opencv(self):
        """The middle of a drawn triangle and the positions of its corners are those of OpenCV's formula, within 0.01 pixels."""
        for size, K, pose in self.ROWS:
            expected = [projected(point, K, pose) for point in CORNERS]
            centre = [sum(corner[axis] for corner in expected) / 3 for axis in range(2)]
            shifted = (*K[:2], K[2] + 0.5, K[3] + 0.5) # OpenGL counts from the picture's corner
            (self.folder / "scene.json").write_text(json.dumps({"lambent": 1, "objects": [{"file": "three.obj"}], "camera": {
                "K": [[K[0], 0, K[2]], [0, K[1], K[3]], [0, 0, 1]], "pose": pose}}))
            spelled = (("--camera", words(K, pose)), ("--camera", words(shifted, opengl(pose), convention="opengl")), ("--camera", words(K, pose), "--device", "gl"),
                       ("--camera", "K=%g/0/%r/0/%g/%r/0/0/1,pose=%s" % (K[0], K[2], K[1], K[3], words((), pose)[5:])))
            with self.subTest(size=size):
                for more in spelled:
                    found = self.middle(size, *more)
                    self.assertTrue(all(abs(a - b) < 0.01 for a, b in zip(found, centre)), (more, found, centre))
                self.good("scene.json", "-s", "%dx%d" % size, "-o", "b.png")
                self.good("three.obj", "-s", "%dx%d" % size, "-o", "c.png", *spelled[0])
                self.assertEqual((self.folder / "b.png").read_bytes(), (self.folder / "c.png").read_bytes())
                told = json.loads(self.good("explain", "three.obj", "-s", "%dx%d" % size, "%d,%d" % tuple(map(round, centre)), "--json", *spelled[0]).stdout)
                for place, (u, v, z) in zip(told["triangles"][0]["places"], expected): # y of the window points up
                    self.assertLess(abs(place["window"][0] - 0.5 - u) + abs(size[1] - place["window"][1] - 0.5 - v), 0.001)

    def test_saved(self):
        """A saved scene draws the same bytes, and the report has the same numbers."""
        size, K, pose = self.ROWS[2]
        told = json.loads(self.good("three.obj", "-s", "%dx%d" % size, "-o", "a.png", "--json", "--camera", words(K, pose), "--save-scene", "s.json").stdout)
        self.assertEqual([told["camera"][key] for key in ("fx", "fy", "cx", "cy")], list(K))
        self.good("s.json", "-o", "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_parts(self):
        """A camera off the centre shows a part of a larger picture, with shadows, occlusion, edges and a ground."""
        pose = turned(-20, 30, (2.1, 1.6, 3.4))
        effects = ("torus-knot", "-b", "white", "--samples", 4, "--no-config")
        for more in (("--ao", "screen"), ("--ao", "rays", "--shadows"), ("--ground", "checker"), ("--edges", "crease,silhouette"), ("--device", "gl", "--ao", "screen")):
            with self.subTest(more):
                self.good(*effects, *more, "-s", "240x200", "-o", "whole.png", "--camera", words((260, 260, 119.5, 99.5), pose))
                self.good(*effects, *more, "-s", "120x96", "-o", "part.png", "--camera", words((260, 260, 119.5 - 80, 99.5 - 24), pose))
                whole, part = (read_png((self.folder / name).read_bytes()) for name in ("whole.png", "part.png"))
                self.assertLess(self.differing(part, lambda x, y: whole[2][((y + 24) * 240 + x + 80) * 4:][:3]), 0.01)

    @staticmethod
    def differing(picture, other):
        """The share of pixels, away from the border, in which a channel differs by more than 3/255."""
        width, height, data = picture[:3]
        inner = [(x, y) for y in range(16, height - 16) for x in range(16, width - 16)]
        return sum(max(abs(a - b) for a, b in zip(data[(y * width + x) * 4:][:3], other(x, y))) > 3 for x, y in inner) / len(inner)

    def test_wide_pixels(self):
        """With fx twice fy, occlusion is that of square pixels: the mean of two pixels beside each other."""
        pose = turned(-20, 30, (2.1, 1.6, 3.4))
        draw = lambda name, size, K: self.good("torus-knot", "-b", "white", "--samples", 16, "-s", size, "--show", "ao", "-o", name, "--camera", words(K, pose))
        draw("square.png", "100x100", (130, 130, 49.5, 49.5))
        draw("wide.png", "200x100", (260, 130, 99.5, 49.5))
        square, wide = (read_png((self.folder / name).read_bytes()) for name in ("square.png", "wide.png"))
        means = [sum(abs(square[2][(y * 100 + x) * 4] - (wide[2][(y * 200 + 2 * x) * 4] + wide[2][(y * 200 + 2 * x + 1) * 4]) / 2) for x in range(100) for y in range(100)) / 1e4]
        self.assertLess(means[0], 2)

    def test_refused(self):
        K, pose = (300, 300, 99.5, 99.5), turned(0, 0, (0, 0, 4))
        mirrored = [[-row[0], *row[1:]] for row in pose[:3]] + pose[3:]
        scaled = [[2 * n for n in row[:3]] + row[3:] for row in pose[:3]] + pose[3:]
        skewed = [[row[0] * math.cos(0.1) + math.sin(0.1) * row[1], *row[1:]] for row in pose[:3]] + pose[3:]
        for camera, says in ((words((0, 300, 1, 1), pose), "fx is 0"), (words((300, -2, 1, 1), pose), "fy is -2"), (words(K[:3], pose), "cy is missing"),
                             (words(K, pose, k1=0.1), "k1=0.1"), (words(K, pose, skew=1), "skew=1"), ("K=1/1/1/0/1/1/0/0/1,eye=0/0/4", "no skew"),
                             (words(K, mirrored), "mirrors"), (words(K, scaled), "length 2"), (words(K, skewed), "not orthogonal"),
                             (words(K, [[0] * 4] * 4), "last row"), (words(K, pose, fovy=30), "both fx and fovy"), (words(K, pose, eye="1/2/3"), "both pose and eye"),
                             (words(K, pose, convention="blender"), "opencv or opengl"), ("fx=1,fy=1,cx=0,cy=0", "'eye' is missing"), (words((*K[:2], 1e300, 1), pose), "cx")):
            with self.subTest(says):
                self.bad(1, "three.obj", "--camera", camera, says=says)
        self.good("three.obj", "--camera", words(K, pose, k1=0, p2=0, skew=0), "-s", 50)


class Views(Case):
    def drawn(self, *words):
        """The names of the new files, without journals."""
        before = self.new_files()
        self.good(*words, "-s", 16, "-q")
        return sorted(self.new_files() - before)

    def transforms(self, name="transforms.json"):
        return json.loads((self.folder / name).read_text())

    def test_names(self):
        """A number of directions, rings, azimuths and sides, with their names and placeholders."""
        for words, files in ((("--view", "3"), ["cube-0.png", "cube-1.png", "cube-2.png", "transforms.json"]),
                             (("--views", "sphere:2"), ["cube-0.png", "cube-1.png", "transforms.json"]),
                             (("--view", "ring:2@10,top"), ["cube-0.png", "cube-1.png", "cube-top.png", "transforms.json"]),
                             (("--view", "ring:4", "-o", "{azimuth}.png"), ["0.png", "180.png", "270.png", "90.png", "transforms.json"]),
                             (("--azimuth", "0,90.5", "--elevation", "10"), ["cube-0.png", "cube-90.5.png"]),
                             (("--view", "front,back"), ["cube-back.png", "cube-front.png"])):
            with self.subTest(words):
                self.assertEqual(self.drawn("cube.obj", *words), files)
                for name in files:
                    (self.folder / name).unlink()
        self.assertEqual(len(self.drawn("cube.obj", "--view", 300)), 301)
        self.assertEqual(self.transforms()["frames"][299]["file_path"], "cube-299.png")

    def test_quantities(self):
        """A list of quantities draws each of them, and a frame of transforms.json belongs to the first."""
        self.assertEqual(self.drawn("cube.obj", "--show", "color,depth", "--view", "front,top"),
                         ["cube-front-color.png", "cube-front-depth.png", "cube-top-color.png", "cube-top-depth.png"])
        self.good("batch", "cube.obj", "--views", 2, "--show", "color,ids,normals,light:key", "-s", 24, "-o", "d/{stem}/{view}-{show}.exr")
        self.assertEqual([frame["file_path"] for frame in self.transforms("d/cube/transforms.json")["frames"]], ["0-color.exr", "1-color.exr"])
        for show in "ids", "normals", "light:key", "color":
            self.good("cube.obj", "--view", "front", "-s", 24, "-o", "one.exr", *(["--show", show] if show != "color" else []))
            self.good("cube.obj", "--view", "front", "-s", 24, "-o", "two-{show}.exr", "--show", show + ",depth")
            self.assertEqual((self.folder / "one.exr").read_bytes(), (self.folder / f"two-{show}.exr").read_bytes())
        words = ("batch", "cube.obj", "-s", 16, "-o", "same/{show}.png", "--skip-same", "--show")
        self.good(*words, "ids,depth")
        self.assertIn("2 unchanged", self.good(*words, "ids,depth").stderr.decode())
        for words, says in ((("--show", "color,deph"), "did you mean 'depth'?"), (("--show", "ids,ids"), "{show}"), (("--show", "ids,color", "-o", "a.png"), "names one picture"),
                            (("--show", "ids,color", "--save-scene", "a.json"), "single picture"), (("--show", "ids,color", "--turntable", "4"), "--show")):
            self.bad(1, "cube.obj", *words, says=says)

    def test_angles(self):
        """A direction is drawn as --azimuth and --elevation draw it, and the directions of a sphere have equal heights and the golden angle."""
        self.good("cube.obj", "--view", "ring:4@30", "-s", 64, "-o", "{azimuth}.png", "-q")
        self.good("cube.obj", "--azimuth", "0,90", "--elevation", 30, "-s", 64, "-o", "list-{view}.png", "-q")
        self.good("cube.obj", "--azimuth", "90", "--elevation", 30, "-s", 64, "-o", "alone.png", "-q")
        self.assertEqual((self.folder / "alone.png").read_bytes(), (self.folder / "list-90.png").read_bytes())
        for a, b in zip(*(read_png((self.folder / name).read_bytes())[2] for name in ("90.png", "alone.png"))):
            self.assertLessEqual(abs(a - b), 1)
        self.good("sphere", "--view", 8, "-s", 16, "-o", "s/", "-q")
        ways = [[row[2] for row in frame["transform_matrix"][:3]] for frame in self.transforms("s/transforms.json")["frames"]]
        for i, way in enumerate(ways):
            self.assertAlmostEqual(way[1], 1 - (2 * i + 1) / 8, delta=1e-8)
            turn = math.radians(180 * (3 - math.sqrt(5)) * i)
            self.assertAlmostEqual(way[0], math.sin(turn) * math.hypot(way[0], way[2]), delta=1e-8)

    def test_refused(self):
        for words, says in ((("--view", "0"), "from 1 to 10000"), (("--view", "20000"), "10000"), (("--view", "ring:4@91"), "ring:N@ELEVATION"), (("--view", "sphere:x"), "sphere:N"),
                            (("--view", "front,frnt"), "did you mean 'front'?"), (("--view", "9999,9999"), "more than 10000 views"), (("--view", "4", "--azimuth", "3"), "--azimuth"),
                            (("--view", "4,4"), "a side twice"), (("--azimuth", "1,1"), "an angle twice"), (("--azimuth", "1,x"), "degrees"), (("--azimuth", "1,2", "--views", "4"), "--azimuth"),
                            (("--view", "4", "-o", "a.png"), "names one picture"), (("--view", "4", "--save-scene", "s.json"), "single picture")):
            with self.subTest(words):
                self.bad(1, "cube.obj", *words, says=says)
        (self.folder / "transforms.json").write_text('{"camera_angle_x": 1, "frames": []}')
        self.bad(5, "cube.obj", "--view", 2, says="lambent did not write it")
        self.bad(1, "cube.obj", "cube.stl", "--view", 2, "-o", "{ext}-{view}.png", says="transforms.json")

    def test_batch(self):
        """Each model has a file of its cameras; --resume draws the missing pictures, and --skip-same only those whose view changed."""
        words = ("batch", "cube.obj", "torus.json", "--view", "3", "-s", 16, "-o", "out/{stem}/{view}.png")
        (self.folder / "torus.json").write_text('{"lambent": 1, "objects": [{"shape": "torus"}]}')
        self.good(*words)
        first = (self.folder / "out/torus/transforms.json").read_bytes()
        self.assertEqual(self.transforms("out/torus/transforms.json")["frames"][2]["file_path"], "2.png")
        (self.folder / "out/torus/1.png").unlink()
        self.good(*words, "--resume")
        self.assertTrue((self.folder / "out/torus/1.png").exists())
        self.assertEqual(first, (self.folder / "out/torus/transforms.json").read_bytes())
        words = ("batch", "cube.obj", "-s", 16, "-o", "same/{view}.png", "--skip-same", "--view")
        self.good(*words, "2")
        self.assertIn("2 unchanged", self.good(*words, "2").stderr.decode())
        self.assertNotIn("2 unchanged", self.good(*words, "ring:2").stderr.decode())


class Files(Case):
    def test_round_trip(self):
        """A transforms.json that Lambent wrote draws the same bytes; so does the program's picture of one of its cameras."""
        for words in ((), ("--projection", "orthographic"), ("--zoom", "1.3", "--rotate", "x:20"), ("--light", "point:frame=camera,position=1r/1r/0r", "--shadows")):
            with self.subTest(words):
                self.good("cube.obj", *words, "--view", "5,iso", "-s", "48x40", "-o", "a/{view}.png", "-q")
                kept = [word for word in words if word not in ("--projection", "orthographic", "--zoom", "1.3")]
                self.good("cube.obj", *kept, "--cameras", "a/transforms.json", "-o", "b/{view}.png", "-q")
                for i, name in enumerate(["0", "1", "2", "3", "4", "iso"]):
                    self.assertEqual((self.folder / f"a/{name}.png").read_bytes(), (self.folder / f"b/{i}.png").read_bytes(), name)
        self.assertEqual(read_png((self.folder / "b/0.png").read_bytes())[:2], (48, 40))

    def test_formats(self):
        """JSON, CSV and frames of other programs are the same cameras as words; --size scales the intrinsics."""
        K, pose = (60, 50, 30.5, 22), turned(10, 20, (1, 0.5, 4))
        self.good("cube.obj", "-s", "64x48", "-o", "one.png", "--camera", words(K, pose))
        one = (self.folder / "one.png").read_bytes()
        flat = "/".join(repr(float(n)) for row in pose for n in row)
        files = {"list.json": json.dumps([{"K": [[K[0], 0, K[2]], [0, K[1], K[3]], [0, 0, 1]], "pose": pose, "width": 64, "height": 48}]),
                 "named.json": json.dumps({"cameras": [dict(zip(("fx", "fy", "cx", "cy"), K), pose=[n for row in pose for n in row], width=64, height=48)]}),
                 "rows.csv": "fx,fy,cx,cy,pose,convention,width,height\n" + ",".join(map(repr, K)) + f",{flat},,64,48\r\n",
                 "nerf.json": json.dumps({"fl_x": K[0], "fl_y": K[1], "cx": K[2] + 0.5, "cy": K[3] + 0.5, "w": 64, "h": 48, "k1": 0, "aabb_scale": 4,
                                          "frames": [{"file_path": "./r_0", "sharpness": 3, "transform_matrix": opengl(pose)}]})}
        for name, text in files.items():
            (self.folder / name).write_text(text)
            self.good("cube.obj", "--cameras", name, "-o", "two-{view}.png")
            self.assertEqual(one, (self.folder / "two-0.png").read_bytes(), name)
        self.good("cube.obj", "-s", "128x96", "-o", "one.png", "--camera", words((120, 100, 61.5, 44.5), pose))
        self.good("cube.obj", "--cameras", "list.json", "-s", "128x96", "-o", "two-{view}.png")
        self.assertEqual((self.folder / "one.png").read_bytes(), (self.folder / "two-0.png").read_bytes())
        self.bad(1, "cube.obj", "--cameras", "list.json", "-s", "96", "-o", "three-{view}.png", says=("64x48", "96x96", "another ratio"))
        (self.folder / "angle.json").write_text(json.dumps({"camera_angle_x": math.radians(40), "frames": [{"transform_matrix": opengl(pose)}]}))
        self.good("cube.obj", "--cameras", "angle.json", "-s", 40, "-o", "two-{view}.png")
        self.good("cube.obj", "--camera", "fovy=40,pose=" + flat, "-s", 40, "-o", "one.png")
        for a, b in zip(*(read_png((self.folder / name).read_bytes())[2] for name in ("one.png", "two-0.png"))):
            self.assertLessEqual(abs(a - b), 1)

    def test_refused(self):
        """Errors name the file, the row and the field."""
        row = {"fx": 60, "fy": 60, "cx": 30, "cy": 20, "pose": [n for line in turned(0, 0, (0, 0, 4)) for n in line]}
        for name, text, says in (("a.json", json.dumps([row, {**row, "fx": -1}]), ("a.json: row 2: fx", "-1")), ("a.json", json.dumps([row, {**row, "k1": 0.1}]), ("row 2", "k1")),
                                 ("a.json", json.dumps([{**row, "f": 1}]), ("row 1", "'f'")), ("a.json", "[1]", "row 1"), ("a.json", "[]", "no cameras"), ("a.json", "{", "a.json:1"),
                                 ("a.csv", "eye,fovy\n0/0/4,30\n0/0/4,200\n", ("a.csv: row 2: ", "fovy")), ("a.csv", "eye,fovy\n1/2/3,4,5\n", "row 1"), ("a.csv", "eye\n", "no cameras"),
                                 ("a.json", json.dumps({"frames": [{"transform_matrix": turned(0, 0, (0, 0, 4))[:3]}]}), ("row 1: pose", "3 rows")),
                                 ("a.json", json.dumps({"camera_angle_x": 1, "w": 1e300, "frames": [{"transform_matrix": turned(0, 0, (0, 0, 4))}]}), ("row 1", "width=1e+300")),
                                 ("a.json", json.dumps([{**row, "width": 3}]), ("row 1", "has only width"))):
            with self.subTest(says):
                (self.folder / name).write_text(text)
                found = self.run_program("cube.obj", "--cameras", name)
                self.assertIn(found.returncode, (1, 2))
                for part in (says,) if isinstance(says, str) else says:
                    self.assertIn(part, found.stderr.decode())
        self.bad(2, "cube.obj", "--cameras", "none.json", says="none.json: cannot open")
        (self.folder / "a.json").write_text(json.dumps([row]))
        for word in ("--view", "front"), ("--camera", "eye=0/0/4"), ("--zoom", "2"), ("--views", "3"):
            self.bad(1, "cube.obj", "--cameras", "a.json", *word, says="several cameras")
