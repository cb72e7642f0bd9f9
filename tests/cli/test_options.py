# test_options.py: tests the effect of every option.
import json
import os

from harness import Case, covered, pixel, read_png, write_png


class Picture(Case):
    def test_size(self):
        self.assertEqual(self.png("cube.obj", "--size", "40")[:2], (40, 40))
        self.assertEqual(self.png("cube.obj", "-s", "60x30")[:2], (60, 30))
        self.assertEqual(self.png("cube.obj", "-s17x5")[:2], (17, 5))

    def test_default_size_and_samples(self):
        image = self.report("cube.obj")["image"]
        self.assertEqual((image["width"], image["height"], image["samples"]), (1024, 1024, 4))
        for size, samples in ("512x512", 8), ("1024x256", 8), ("513x512", 4), ("16", 16), ("257x256", 8):
            image = self.report("cube.obj", "-s", size, "-o", "a.png", "--save-scene", "a.json")["image"]
            self.assertEqual(image["samples"], samples, size)
            whole = (self.folder / "a.png").read_bytes()
            self.assertEqual(self.good("cube.obj", "-s", size, "--samples", samples, "-o", "-").stdout, whole, size)
            self.assertEqual(self.good("a.json", "-o", "-").stdout, whole, size)

    def test_default_background_is_clear(self):
        picture = self.png("cube.obj", "--size", "64")
        self.assertEqual(pixel(picture, 0, 0), (0, 0, 0, 0))
        self.assertEqual(pixel(picture, 32, 32)[3], 255)

    def test_background(self):
        for text, expected in {
            "white": (255, 255, 255, 255), "#336699": (0x33, 0x66, 0x99, 255), "#369": (0x33, 0x66, 0x99, 255),
            "#33669980": (0x33, 0x66, 0x99, 0x80), "transparent": (0, 0, 0, 0), "1/0/0": (255, 0, 0, 255),
            "Orange": (255, 165, 0, 255), "0.5/0.5/0.5/1": (188, 188, 188, 255),
        }.items():
            with self.subTest(text):
                self.assertEqual(pixel(self.png("cube.obj", "-s", 16, "--background", text), 0, 0), expected)

    def test_background_raw(self):
        words = ("cube.obj", "-s", 16, "--color-mode", "raw", "-b")
        self.assertEqual(pixel(self.png(*words, "#336699"), 0, 0), (0x33, 0x66, 0x99, 255))
        self.assertEqual(pixel(self.png(*words, "0.5/0.5/0.5"), 0, 0), (128, 128, 128, 255))

    def test_samples(self):
        pictures = {n: self.png("cube.obj", "-s", 40, "--samples", n) for n in (1, 2, 4, 8, 16)}
        self.assertEqual({a for a in pictures[1][2][3::4]}, {0, 255})  # one sample: covered or not
        for n in (2, 4, 8, 16):
            self.assertGreater(len(set(pictures[n][2][3::4])), 2)
            self.assertTrue(all(abs(a * n / 255 - round(a * n / 255)) < 0.05 for a in pictures[n][2][3::4]))
        self.assertEqual(pictures[16], self.png("cube.obj", "-s", 40))

    def test_color_mode(self):
        raw, plain = self.png("cube.obj", "-s", 32, "--color-mode", "raw"), self.png("cube.obj", "-s", 32)
        self.assertNotEqual(raw, plain)
        # The former name of these two options.
        self.assertEqual(self.png("cube.obj", "-s", 32, "--color", "raw"), raw)
        self.assertEqual(self.png("cube.obj", "-s", 32, "--color=raw", "--color", "srgb"), plain)
        self.good("materials", "--color", "raw", "-s", 32, "--no-captions", "-o", "m.png")
        self.bad(1, "materials", "--color", "red", says="does not apply")
        self.assertEqual(self.png("cube.obj", "-s", 32, "--color", "raw", "--color", "#336699"),
                         self.png("cube.obj", "-s", 32, "--color-mode", "raw", "--color", "0.2/0.4/0.6"))

    def test_compress(self):
        self.bad(1, "cube.obj", "--compress", "bst", says=("--compress", "best"))
        words = ("cube.obj", "-s", "90x70", "--background", "white", "-o")
        self.good(*words, "fast.png", "--compress", "fast")
        self.good(*words, "plain.png")
        self.good(*words, "best.png", "--compress", "best")
        self.good(*words, "one.png", "--compress", "best", "--threads", 1)
        sizes = {name: (self.folder / (name + ".png")).stat().st_size for name in ("fast", "plain", "best")}
        self.assertEqual(sizes["fast"], sizes["plain"])
        self.assertLess(sizes["best"], 0.9 * sizes["fast"])
        self.assertEqual((self.folder / "best.png").read_bytes(), (self.folder / "one.png").read_bytes())
        self.assertIn(b"equal", self.good("diff", "best.png", "fast.png").stdout)
        for how in ("fast", "best"):
            self.good("compare", "cube.obj", "--across", "shading=flat,phong", "-s", "40", "--compress", how, "-o", how + "-sheet.png")
        self.assertLess(*((self.folder / (how + "-sheet.png")).stat().st_size for how in ("best", "fast")))

    def test_quality(self):
        for wrong in ("0", "101", "1.5", "best"):
            self.bad(1, "cube.obj", "--quality", wrong, says=("--quality", "1 to 100"))
        words = ("cube.obj", "-s", "90x70", "-b", "#204060")
        size = {}
        for name, more in (("a.jpg", ()), ("b.jpeg", ("--quality", 90)), ("c.jpg", ("--quality", 30)), ("a.webp", ()),
                           ("b.webp", ("--quality", 30)), ("a.png", ()), ("b.png", ("--quality", 30))):
            self.good(*words, *more, "-o", name)
            size[name] = (self.folder / name).stat().st_size
        self.assertEqual((self.folder / "a.jpg").read_bytes(), (self.folder / "b.jpeg").read_bytes())
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assertLess(size["c.jpg"], size["a.jpg"])
        self.assertLess(size["b.webp"], size["a.webp"])
        self.assertIn(b"equal", self.good("diff", "a.png", "a.webp").stdout)
        # 90 is the near distance, over the background.
        self.assertIn(b"within", self.good("diff", "a.png", "a.jpg", "--tolerance", 40).stdout)
        for name in ("s.jpg", "s.webp"):
            self.good("compare", "cube.obj", "--across", "shading=flat,phong", "-s", "40", "-o", name)
            self.good("compare", "cube.obj", "--across", "shading=flat,phong", "-s", "40", "--quality", 20, "-o", "low-" + name)
            self.assertLess((self.folder / ("low-" + name)).stat().st_size, (self.folder / name).stat().st_size)
        report = json.loads(self.good(*words, "--json", "-o", "a.webp").stdout)
        self.assertEqual(report["image"]["format"], "webp")

    def test_color_types(self):
        for type, words in ((4, ()), (0, ("-b", "white")), (2, ("-b", "#102030")), (6, ("--material", "gold"))):
            self.good("cone", "-s", "40x30", *words, "-o", "a.png")
            data = (self.folder / "a.png").read_bytes()
            self.assertEqual(data[25], type)
            pixels = read_png(data)[2]
            if type in (0, 2):  # the same numbers as in a format that always has three channels
                self.good("cone", "-s", "40x30", *words, "-o", "a.ppm")
                self.assertEqual(b"".join(pixels[i:i + 3] for i in range(0, len(pixels), 4)), (self.folder / "a.ppm").read_bytes()[-40 * 30 * 3:])
            (self.folder / "rgba.png").write_bytes(write_png(40, 30, pixels))
            self.assertIn(b"equal", self.good("diff", "a.png", "rgba.png").stdout)

    def test_formats(self):
        self.good("cube.obj", "-s", "20x10", "-o", "a.ppm", "-b", "white")
        data = (self.folder / "a.ppm").read_bytes()
        self.assertTrue(data.startswith(b"P6\n"))
        self.assertEqual(data[-20 * 10 * 3:][:3], b"\xff\xff\xff")
        self.good("cube.obj", "-s", "20x10", "-o", "a.pfm")
        data = (self.folder / "a.pfm").read_bytes()
        self.assertTrue(data.startswith(b"PF\n20 10\n"))
        self.assertGreater(len(data), 20 * 10 * 12)


class View(Case):
    def eye(self, *words):
        camera = self.report("cube.obj", "-s", 16, "-o", "view.png", *words)["camera"]
        return [e - t for e, t in zip(camera["eye"], camera["target"])]

    def direction(self, *words):
        eye = self.eye(*words)
        length = sum(c * c for c in eye) ** 0.5
        return [round(c / length, 6) + 0 for c in eye]

    def test_sides(self):
        for side, expected in {"front": [0, 0, 1], "back": [0, 0, -1], "left": [-1, 0, 0], "right": [1, 0, 0],
                               "top": [0, 1, 0], "bottom": [0, -1, 0], "iso": [0.57735] * 3}.items():
            with self.subTest(side):
                for found, wanted in zip(self.direction("--view", side), expected):
                    self.assertAlmostEqual(found, wanted, 5)

    def test_angles(self):
        self.assertEqual(self.direction("--azimuth", "90", "--elevation", "0"), [1, 0, 0])
        self.assertEqual(self.direction("--azimuth", "-90", "--elevation=0"), [-1, 0, 0])
        self.assertEqual(self.direction("--elevation", "0", "--view", "right"), [1, 0, 0])
        self.assertEqual(self.direction("--azimuth", "30", "--elevation", "20"), self.direction())
        self.assertEqual(self.direction("--view", "front", "--elevation", "90"), [0, 1, 0])

    def test_default_view_has_a_name(self):
        self.assertEqual(self.png("cube.obj", "-s", 32, "--view", "three-quarter"), self.png("cube.obj", "-s", 32))

    def test_fit_fills_the_picture(self):
        for words in ((), ("--view", "front"), ("--projection", "orthographic"), ("--azimuth", "200")):
            left, top, right, bottom = covered(self.png("cube.obj", "-s", "200", "--samples", 16, *words))
            with self.subTest(words):
                self.assertAlmostEqual(max(right - left, bottom - top) / 200, 0.92, delta=0.015)
                self.assertAlmostEqual(left + right, 200, delta=2)
                self.assertAlmostEqual(top + bottom, 200, delta=2)

    def test_zoom(self):
        def width(zoom):
            left, _, right, _ = covered(self.png("cube.obj", "-s", 200, "--view", "front", "--zoom", zoom))
            return right - left
        self.assertAlmostEqual(width(0.5) / width(1), 0.5, delta=0.03)

    def test_up(self):
        self.assertEqual(self.report("cube.obj", "-s", 16)["model"]["up"], "y")
        self.assertEqual(self.report("cube.stl", "-s", 16)["model"]["up"], "z")
        # For every axis, the directions up and front.
        for axis, above, front in (("x", [1, 0, 0], [0, 0, 1]), ("y", [0, 1, 0], [0, 0, 1]), ("z", [0, 0, 1], [0, -1, 0]),
                                   ("-x", [-1, 0, 0], [0, 0, 1]), ("-y", [0, -1, 0], [0, 0, 1]), ("-z", [0, 0, -1], [0, -1, 0])):
            self.assertEqual(self.report("cube.stl", "-s", 16, "--up", axis)["model"]["up"], axis)
            self.assertEqual(self.direction("--view", "top", "--up", axis), above)
            self.assertEqual(self.direction("--view", "front", "--up", axis), front)
            right = [above[1] * front[2] - above[2] * front[1], above[2] * front[0] - above[0] * front[2],
                     above[0] * front[1] - above[1] * front[0]]
            self.assertEqual(self.direction("--view", "right", "--up", axis), right)
            sky = ("torus-knot", "-s", 48, "--up", axis, "--light", "hemisphere:sky=1,ground=0")
            self.assertEqual(self.png(*sky), self.png(*sky[:-1], sky[-1] + ",up=" + "/".join(map(str, above))))
            plain = self.png("torus-knot", "-s", 48, "--up", axis)
            self.assertEqual(self.png("torus-knot", "-s", 48, "--up=" + axis.upper()), plain)
            if len(axis) == 1:
                self.assertEqual(self.png("torus-knot", "-s", 48, "--up", "+" + axis), plain)
                # The opposite axis, seen from the front, gives the same picture rotated by 180
                # degrees.
                words = ("torus-knot", "-s", 48, "--samples", 1, "--view", "front", "--rig", "none", "--ambient", "1", "--projection", "orthographic", "--up")
                (_, _, one), (_, _, other) = self.png(*words, axis), self.png(*words, "-" + axis)
                turned = b"".join(one[i:i + 4] for i in range(len(one) - 4, -4, -4))
                self.assertLess(sum(a != b for a, b in zip(other, turned)), 0.005 * len(one))
            # A scene file stores the value.
            self.good("cube.obj", "-s", 48, "--up", axis, "--save-scene", "up.json", "-o", "a.png")
            self.assertEqual(self.png("up.json"), read_png((self.folder / "a.png").read_bytes()))
            (self.folder / "own.json").write_text(json.dumps({"lambent": 1, "up": axis, "objects": [{"shape": "torus-knot"}]}))
            self.assertEqual(self.png("own.json", "-s", 48), plain)
        for name in ("+-z", "--z", "zz", "w", "+", "-"):
            self.bad(1, "cube.obj", "--up=" + name, says="expected auto, x, y, z, -x, -y, -z or file", leaves=self.new_files())
        # The coordinates do not change.
        self.assertEqual(self.report("teapot", "-s", 16, "--up", "z")["model"]["bounds"],
                         self.report("teapot", "-s", 16)["model"]["bounds"])

    def test_projection(self):
        camera = self.report("cube.obj", "-s", 16, "--projection", "orthographic")["camera"]
        self.assertIn("ortho_half_height", camera)
        self.assertNotIn("fovy_deg", camera)
        self.assertEqual(self.report("cube.obj", "-s", 16)["camera"]["fovy_deg"], 30)

    def test_camera(self):
        # A cube of half side 1 is seen from z = 5 straight on: its near face is 4 away; tan(fovy/2) = 1/2 puts the
        # face's edge at half of the picture's half height.
        degrees = "53.13010235415598"
        picture = self.png("cube.obj", "-s", 200, "--camera", f"eye=0/0/5,target=0/0/0,up=0/1/0,fovy={degrees}")
        self.assertEqual(covered(picture), (50, 50, 150, 150))
        picture = self.png("cube.obj", "-s", 200, "--camera", "eye=0/0/5,ortho=2")
        self.assertEqual(covered(picture), (50, 50, 150, 150))
        # If the far plane cuts the cube, its near face is visible; a near plane behind that face shows the
        # inside.
        picture = self.png("cube.obj", "-s", 200, "--camera", "eye=0/0/5,ortho=2,near=1,far=3")
        self.assertEqual(set(picture[2][3::4]), {0})

    def test_camera_of_the_report_gives_the_same_picture(self):
        def text(v):
            return "/".join(map(repr, v))
        for words in ((), ("--view", "iso", "--projection", "orthographic"), ("--azimuth", "123.4")):
            self.good("cube.obj", "-s", 64, "-o", "fitted.png", *words)
            camera = self.report("cube.obj", "-s", 64, "-o", "fitted.png", *words)["camera"]
            size = f"fovy={camera['fovy_deg']!r}" if "fovy_deg" in camera else f"ortho={camera['ortho_half_height']!r}"
            self.good("cube.obj", "-s", 64, "-o", "given.png", "--camera", f"eye={text(camera['eye'])},"
                      f"target={text(camera['target'])},up={text(camera['up'])},{size}")
            self.assertEqual((self.folder / "fitted.png").read_bytes(), (self.folder / "given.png").read_bytes())

    def test_camera_errors(self):
        for value, says in {
            "target=0/0/0": "'eye' is missing", "eye=1/2": "three numbers", "eye=1/2/3/4": "three numbers",
            "eye=1/2/x": "three numbers", "eye=nan/0/1": "three numbers", "eye=0x1/0/1": "three numbers",
            "ey=1/2/3": "did you mean 'eye'?", "eye=0/0/5,fovy=0": "above 0", "eye=0/0/5,fovy=180": "below 180",
            "eye=0/0/5,fovy=30,ortho=1": "expected only one", "eye=0/0/5,near=1": "only near",
            "eye=0/0/5,near=3,far=2": "near < far", "eye=0/0/5,near=0,far=2": "0 < near < far",
            "eye=0/0/5,ortho=-1": "at least 0", "eye=1/1/1,target=1/1/1": "same point", "eye=0/0/5,up=0/0/0": "direction",
            "eye=0/0/5,eye=0/0/6": "twice", "eye": "expected keys such as eye=2/1/4",
        }.items():
            with self.subTest(value):
                self.bad(1, "cube.obj", "--camera", value, says=["option '--camera'", says])
        for other in (("--view", "front"), ("--azimuth", 0), ("--elevation", 0), ("--zoom", 2),
                      ("--projection", "orthographic")):
            self.bad(1, "cube.obj", "--camera", "eye=0/0/5", *other, says=["'--camera'", other[0]])


class Surface(Case):
    def test_shading(self):
        words = ("sphere", "-s", 64, "--shading")
        pictures = {name: self.png(*words, name) for name in ("flat", "gouraud", "phong", "smooth", "normal")}
        self.assertEqual(pictures["smooth"], pictures["gouraud"])
        self.assertEqual(pictures["normal"], pictures["phong"])
        self.assertEqual(pictures["phong"], self.png("sphere", "-s", 64))
        self.assertEqual(len({p[2] for p in pictures.values()}), 3)

    def test_reflection(self):
        words = ("sphere", "-s", 64, "--reflection")
        names = ("none", "lambert", "phong", "blinn-phong", "kajiya-kay", "kajiya-kay-lecture")
        pictures = {name: self.png(*words, name) for name in names}
        self.assertEqual(len({p[2] for p in pictures.values()}), len(names))
        self.assertEqual(self.png(*words, "auto"), pictures["blinn-phong"])
        inside = {pixel(pictures["none"], x, 32) for x in range(20, 44)}
        self.assertEqual(len(inside), 1)  # unlit, so one colour

    def test_rig(self):
        pictures = {name: self.png("sphere", "-s", 64, "--rig", name) for name in ("auto", "none", "studio", "headlight")}
        self.assertEqual(pictures["auto"], pictures["studio"])
        self.assertEqual(len({p[2] for p in pictures.values()}), 3)
        self.assertEqual(pixel(pictures["none"], 32, 32), (0, 0, 0, 255))  # without any light

    def test_normals(self):
        # A sphere's own normals, facet normals, and smooth normals of a cube without normals.
        own, facet = (self.png("sphere", "-s", 64, "--normals", n) for n in ("file", "facet"))
        self.assertEqual(own, self.png("sphere", "-s", 64))
        self.assertNotEqual(own, facet)
        smooth = self.png("cube.ply", "-s", 64, "--normals", "smooth", "--crease-angle", "180")
        self.assertNotEqual(smooth, self.png("cube.ply", "-s", 64, "--normals", "facet"))
        # The default crease angle also splits a cube's sides.
        self.assertEqual(self.png("cube.ply", "-s", 64), self.png("cube.ply", "-s", 64, "--normals", "facet"))

    def test_crease_angle(self):
        # The cube's sides meet at 90 degrees.
        words = ("cube.ply", "-s", 64, "--crease-angle")
        sharp = self.png(*words, "89")
        self.assertEqual(sharp, self.png("cube.ply", "-s", 64))
        self.assertEqual(sharp, self.png(*words, "0"))
        self.assertNotEqual(sharp, self.png(*words, "91"))
        self.bad(1, "cube.ply", "--crease-angle", "181", says="from 0 to 180")


class Work(Case):
    def test_threads_do_not_change_the_picture(self):
        files = []
        for threads in (1, 2, 3, 8):
            report = self.report("teapot", "-s", 200, "-j", threads, "-o", "t.png")
            self.assertEqual(report["device"]["threads"], threads)
            files.append((self.folder / "t.png").read_bytes())
        self.assertEqual(len(set(files)), 1)

    def test_every_instruction_set_gives_the_same_bytes(self):
        files, used = set(), []
        for isa in ("scalar", "sse4", "avx2", "avx512", "neon"):
            done = self.run_program("teapot", "-s", 200, "--isa", isa, "-o", "t.png", "--json")
            if done.returncode == 3:
                self.assertIn(isa.encode(), done.stderr)
                continue
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(done.stdout)["device"]["isa"], isa)
            used.append(isa)
            files.add((self.folder / "t.png").read_bytes())
        self.assertIn("scalar", used)
        self.assertLess(len(used), 5)  # no machine supports all of them
        self.assertEqual(len(files), 1)

    def test_repeat(self):
        times = self.report("cube.obj", "-s", 64, "--repeat", 5)["times_ms"]
        self.assertEqual(times["frames"], 5)
        self.assertLessEqual(times["frame_least"], times["frame"])
        self.assertLessEqual(times["frame"], times["frame_most"])
        once = self.png("cube.obj", "-s", 64)
        self.assertEqual(once, self.png("cube.obj", "-s", 64, "--repeat", 3))

    def test_limits(self):
        self.bad(4, "cube.obj", "--time-limit", "0.001", "-s", "4000", "--repeat", "100000",
                 says=["cube.obj", "time limit of 0.001 s"])
        self.bad(4, "cube.obj", "--memory-limit", "1k", says="cube.obj")
        self.bad(4, "cube.obj", "--memory-limit", "1k", "-s", "8", says="memory limit")
        self.good("cube.obj", "--memory-limit", "200M", "--time-limit", "60", "-s", 64)
        for text in ("", "x", "0", "-5", "10Q", "5 M", "1e99"):
            self.bad(1, "cube.obj", f"--memory-limit={text}", says="--memory-limit", leaves={"cube.png"})


class CommandLine(Case):
    def test_unknown_options_name_the_nearest(self):
        for word, nearest in {"--szie": "--size", "--ouput": "--output", "--backgroun": "--background",
                              "-size": "--size", "--crease": "--crease-angle"}.items():
            self.bad(1, "cube.obj", word, "3", says=[f"unknown option '{word}'", f"did you mean '{nearest}'?"])
        for word, nearest in {"--resolutions": "size", "--transparency": "material opacity=SHARE", "--brightness": "exposure",
                              "--interpolation": "shading", "--lamp": "light", "--Size": "size", "--light_scale": "light-scale"}.items():
            self.bad(1, "cube.obj", word, "3", says=[f"unknown option '{word}'", f"did you mean '--{nearest}'?"])
        done = self.bad(1, "cube.obj", "--entirely-else", says="unknown option '--entirely-else'")
        self.assertNotIn(b"did you mean", done.stderr)
        self.bad(1, "cube.obj", "-Z", says="unknown option '-Z'")

    def test_values(self):
        for words, says in {
            ("--shading", "falt"): "did you mean 'flat'?", ("--view", "frnt"): "did you mean 'front'?",
            ("--samples", "3"): "expected 1, 2, 4, 8 or 16", ("--size", "0"): "found '0'",
            ("--size", "10x"): "found '10x'", ("--size", "70000"): "65535", ("--size", "-5"): "found '-5'",
            ("--size", "10x10x10"): "found", ("--size", "99999999999999999999"): "found", ("--threads", "0"): "from 1",
            ("--threads", "1.5"): "whole", ("--threads", "2000"): "to 1024", ("--azimuth", "abc"): "found 'abc'",
            ("--azimuth", "nan"): "found 'nan'", ("--zoom", "1,5"): "found '1,5'", ("--elevation", "91"): "to 90",
            ("--zoom", "0"): "from 0.001", ("--zoom", "inf"): "found", ("--background", "blurple"): "expected a colour", ("--color", "rde"): "did you mean 'red'?", ("--color", "ff8800"): "did you mean '#ff8800'?",
            ("-b", "none"): "did you mean 'transparent'?", 
            ("--color", "transparent"): "without alpha",
            ("--background", "#12345"): "expected a colour", ("--background", "1/2"): "expected a colour",
            ("--background", "-1/0/0"): "expected a colour", ("--isa", "mmx"): "expected auto, scalar",
            ("--output", ""): "empty", ("--repeat", "0"): "from 1", ("--time-limit", "0"): "from 0.001",
            ("--json=yes",): "takes no value",
            # Other names with the same meaning.
            ("--light", "distant"): "did you mean 'directional'?", ("--light", "sun:color=red"): "did you mean 'directional'?",
            ("--light", "spotlight"): "did you mean 'spot'?", ("--light", "sky"): "did you mean 'hemisphere'?",
            ("--light", "omni"): "did you mean 'point'?", ("--light", "spot:angle=20"): "did you mean 'cutoff'?",
            ("--light", "point:pos=1/2/3"): "did you mean 'position'?", ("--light", "point:power=2"): "did you mean 'intensity'?",
            ("--material", "albedo=red"): "did you mean 'diffuse'?",
            ("--material", "roughnes=0.5"): "did you mean 'roughness'?", ("--material", "alpha=0.5"): "did you mean 'opacity'?",
            ("--camera", "pos=1/2/3"): "did you mean 'eye'?", ("--camera", "fov=30"): "did you mean 'fovy'?",
            ("--sheet", "terms"): "does not apply to this command; it belongs to compare",
        }.items():
            with self.subTest(words):
                self.bad(1, "cube.obj", *words, says=[words[0].split("=")[0], says])

    def test_synonyms_of_values(self):
        """A word of other programs gives the picture of Lambent's own word."""
        for option, synonym, own in (
                ("--shading", "per-vertex", "gouraud"), ("--shading", "per-pixel", "phong"), ("--shading", "Faceted", "flat"), ("--stage", "per_pixel", "fragment"),
                ("--show", "ndotl", "n.l"), ("--show", "NdotH", "n.h"), ("--show", "normal", "normals"), ("--show", "zbuffer", "depth"), ("--show", "mask", "coverage"),
                ("--projection", "ortho", "orthographic"), ("--view", "isometric", "iso"), ("--view", "FRONT", "front"), ("--reflection", "blinn", "blinn-phong"),
                ("--rig", "3-point", "three-point"), ("--material", "plastic", "white-plastic"), ("--tone", "filmic", "aces")):
            with self.subTest(synonym):
                self.assertEqual(self.png("cube.obj", "-s", 32, option, synonym), self.png("cube.obj", "-s", 32, option, own))
                self.assertEqual(self.png("cube.obj", "-s", 32, f"{option}={synonym}"), self.png("cube.obj", "-s", 32, option, own))

    def test_missing_values(self):
        for word in ("--output", "-o", "--size", "--camera"):
            self.bad(1, "cube.obj", word, says="needs a value")
        self.bad(1, "cube.obj", "-o", "--json", says="needs a value")
        for word in ("--color", "--background", "-b", "--material"):  # the part of --color #ff8800 that a shell passes on
            self.bad(1, "cube.obj", word, says="# begins a comment unless it is quoted")

    def test_forms(self):
        for words in (("--size=20", "cube.obj"), ("--size", "20", "cube.obj"), ("-s20", "cube.obj"), ("-s", 20, "cube.obj"),
                      ("render", "cube.obj", "-s", "20"), ("-s", 99, "-s", 20, "cube.obj")):
            self.assertEqual(self.report(*words)["image"]["width"], 20)
        done = self.good("-qs20", "cube.obj")
        self.assertEqual((done.stdout, done.stderr), (b"", b""))

    def test_double_dash(self):
        (self.folder / "-odd.obj").write_bytes((self.folder / "cube.obj").read_bytes())
        self.good("-s", 16, "--", "-odd.obj")
        self.assertIn("-odd.png", self.new_files())

    def test_nothing_given(self):
        with open(os.devnull) as nothing:
            self.bad(1, stdin=nothing, says="no model given")

    def test_together(self):
        self.bad(1, "cube.obj", "-q", "-v", says="cannot be used together")
        self.bad(1, "cube.obj", "cube.stl", "-o", "x.png", says="names one picture")
        self.bad(1, "cube.obj", "cube.stl", says="would both be written to 'cube.png'")
        self.bad(1, "cube.obj", "-", says="single model")

    def test_segments(self):
        """Built-in shapes with the requested number of segments, also in files of --save-scene."""
        count = lambda *words: self.report(*words, "-s", 16, "-o", "a.png")["model"]["triangles"]
        self.assertEqual(count("cylinder", "--segments", "8x3"), 8 * 2 * 3 + 2 * 8)
        self.assertEqual(count("sphere", "--segments", "12x6"), 12 * 2 * 5)
        self.assertEqual(count("cube", "--segments", "4"), 2 * (4 * 4 * 2) + 4 * 4 * 2)
        self.good("sphere", "--segments", "9x5", "-s", 32, "--shading", "flat", "-q", "-o", "a.png", "--save-scene", "a.json")
        self.good("a.json", "-q", "-o", "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assertIn(b"'--segments' changes nothing", self.good("cube.obj", "--segments", 8, "-s", 16, "-o", "a.png").stderr)
        self.given |= self.new_files()
        for value in ("0", "2x", "x2", "8x0", "20000", "8.5", "-3", "8x4x2", ""):
            self.bad(1, "sphere", "--segments", value, says="--segments")
        self.bad(1, "sphere", "--segments", "2", says="slices")
        self.bad(4, "sphere", "--segments", "4000x4000", "--memory-limit", "50M", says="memory limit")

    def test_commands(self):
        shapes = [line.split()[0] for line in self.good("shapes").stdout.decode().splitlines()]
        for name in ("sphere", "torus", "plane", "cube", "cylinder", "cone", "teapot"):
            self.assertIn(name, shapes)
        formats = self.good("formats").stdout.decode()
        for name in ("obj", "stl", "ply", ".png", ".ppm", ".pfm"):
            self.assertIn(name, formats)
        self.bad(1, "shapes", "x", says="unexpected argument 'x'")
        self.bad(1, "shapes", "--size", 5, says="does not apply to this command")
        self.bad(1, "generate", says="missing argument")
        self.bad(1, "generate", "mna", says="did you mean 'man'?")
        self.bad(1, "help", "shaeps", says="did you mean 'shapes'?")
        self.assertIn(b"did you mean 'color'?", self.good("help", "colours").stdout)
        self.assertIn(b"colour paint", self.good("help", "colour").stdout)
        self.assertIn(b"did you mean 'exposure'?", self.good("help", "brightness").stdout)
        self.bad(1, "help", "nope", says=("unknown name 'nope'", "`lambent help` lists them"))
        self.assertIn(b"--light ", self.good("help", "light", "spot").stdout)
        render = self.good("help", "render").stdout
        self.assertTrue(render.startswith(b"Usage: lambent render MODEL"))
        self.assertIn(b"--exposure", render)
        self.assertNotIn(b"--tolerance", render)
        self.assertEqual(self.good("help", "shapes").stdout, self.good("shapes", "--help").stdout)
        self.assertIn(b"lambent plot spot cutoff=", self.good("help", "plot").stdout)
        self.assertNotIn(b"lambent compare", self.good("help", "plot").stdout)
        self.assertEqual(self.good("--json", "devices").stdout, self.good("devices", "--json").stdout)

    def test_former_names(self):
        """Options that were merged still work; the help and the completion do not list them."""
        for former, now, value in (("views", "view", "front,left"), ("sizes", "size", "16,24")):
            size = [] if now == "size" else ["-s", 16]
            self.good("cube.obj", "--" + former, value, *size, "-q", "-o", former + "/{view}-{size}.png")
            self.good("cube.obj", f"--{now}={value}", *size, "-q", "-o", now + "/{view}-{size}.png")
            names = sorted(path.name for path in (self.folder / now).iterdir())
            self.assertEqual(len(names), 2)
            self.assertEqual(names, sorted(path.name for path in (self.folder / former).iterdir()))
            for name in names:
                self.assertEqual((self.folder / now / name).read_bytes(), (self.folder / former / name).read_bytes())
            self.given |= {now, former} | self.new_files()
            for words in (("--help",), ("batch", "--help"), ("generate", "markdown"), ("generate", "man"), ("help", "batch")):
                text = self.good(*words).stdout.decode().replace("\\-", "-")
                self.assertNotRegex(text, rf"--{former}\b")
                if words[0] != "help":
                    self.assertIn("--" + now, text)
            self.assertEqual(self.good("help", "--" + former).stdout, self.good("help", "--" + now).stdout)
            self.bad(1, "compare", "cube.obj", "--" + now, value, says=f"option '--{now}': several values belong to render, batch; this command takes one")

    def test_version(self):
        text = self.good("--version").stdout.decode()
        self.assertRegex(text, r"^lambent \d+\.\d+\.\d+\n\S+")

    def test_every_shape_renders(self):
        for name in [line.split()[0] for line in self.good("shapes").stdout.decode().splitlines()]:
            with self.subTest(name):
                report = self.report(name, "-s", 48)
                self.assertEqual(report["model"]["format"], "shape")
                self.assertGreater(report["counts"]["pixels_covered"], 200)
                self.assertIn(f"{name}.png", self.new_files())
