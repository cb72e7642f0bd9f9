# test_sandbox.py: --sandbox and --allow-path: accessible files, inaccessible files, and the messages.
import json
import os
import shutil
import subprocess

from harness import Case, PROGRAM, write_png

HAVE = "off" not in subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE).stdout.decode().split("sandbox ")[1]
FULL = "and seccomp" in subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE).stdout.decode()
REQUIRE = ("--sandbox", "require")


class Sandbox(Case):
    def setUp(self):
        super().setUp()
        if not FULL and self._testMethodName != "test_without":
            self.skipTest("this machine or build has no complete sandbox")

    def file(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    def test_what_is_said(self):
        self.assertRegex(self.good("--version").stdout.decode(), r"(?m)^sandbox Landlock \d+ and seccomp$")
        report = self.report("cube.obj", "-s", 8)
        self.assertGreater(report["sandbox"]["landlock"], 0)
        self.assertTrue(report["sandbox"]["seccomp"])
        self.assertEqual(self.report("cube.obj", "-s", 8, "--sandbox", "off")["sandbox"], {"landlock": 0, "seccomp": False})
        self.assertIn("sandbox  Landlock", self.good("cube.obj", "-s", 8, "-v").stderr.decode())
        self.assertIn("sandbox  off; --sandbox off", self.good("cube.obj", "-s", 8, "-v", "--sandbox", "off").stderr.decode())

    def test_same_bytes(self):
        for words in (["cube.obj", "-s", 40], ["teapot", "-s", 40, "--threads", 3], ["cube.stl", "-s", 40, "--environment", "studio"]):
            self.assertEqual(self.good(*words, *REQUIRE, "-o", "-").stdout, self.good(*words, "--sandbox", "off", "-o", "-").stdout)

    def test_every_command(self):
        for words in (["cube.obj", "-s", 16], ["cube.obj", "-s", 16], ["cube.obj", "-s", 16, "-o", "new/below/"], ["info", "cube.obj", "cube.stl"],
                      ["explain", "cube.obj", "8,8", "-s", 16], ["lights", "cube.obj"], ["shader", "cube.obj", "-o", "text"],
                      ["compare", "cube.obj", "--sheet", "stages", "-s", 40, "-o", "sheet.png"], ["compare", "cube.obj", "--sheet", "stages", "-s", 40],
                      ["diff", "cube.png", "cube.png", "-o", "difference.png"], ["cube.obj", "-s", 16, "--save-scene", "saved.json"], ["saved.json", "-s", 16],
                      ["cube.obj", "teapot", "-s", 16, "-o", "two/"], ["torus", "cube.obj", "-s", 16, "-o", "three/"], ["cube.obj", "-o", "-", "-s", 8]):
            self.good(*words, *REQUIRE)
        self.assertTrue((self.folder / "new/below/cube.png").exists() and (self.folder / "sheet.png").exists() and (self.folder / "text.frag").exists())
        os.mkfifo(self.folder / "pipe")
        reader = subprocess.Popen(["cat", "pipe"], cwd=self.folder, stdout=subprocess.PIPE)
        self.good("cube.obj", "-s", 8, "-o", "pipe", *REQUIRE)
        self.assertEqual(reader.communicate()[0][:4], b"\x89PNG")
        self.assertEqual(self.good("-", "-o", "-", "-s", 8, *REQUIRE, stdin=(self.folder / "cube.stl").read_bytes()).stdout[:4], b"\x89PNG")

    def test_files_that_options_name(self):
        """Files of looks, environments and pictures of a sheet may be anywhere; naming them is sufficient."""
        self.file("models/cube.obj", (self.folder / "cube.obj").read_bytes())
        self.file("else/blue.png", write_png(4, 2, b"\x40\x80\xff\xff" * 8))
        self.file("else/red.png", write_png(4, 2, b"\xff\x40\x20\xff" * 8))
        self.file("else/blue.look", "background white\nreflectivity 1\nenvironment else/blue.png\n")
        for number, words in enumerate((["--across", "environment=else/blue.png,else/red.png"], ["--across", "look=else/blue.look,studio"],
                                        ["--across", "look=else/blue.look,classic", "--across", "environment=else/red.png,else/blue.png"],
                                        ["--look", "else/blue.look", "--across", "shading=flat,phong"])):
            words = ["compare", "models/cube.obj", *words, "-s", 32, "--no-captions", "--reflectivity", 1, "-o"]
            self.good(*words, "a.ppm", "--sandbox", "require")
            self.good(*words, "b.ppm", "--sandbox", "off")
            self.assertEqual((self.folder / "a.ppm").read_bytes(), (self.folder / "b.ppm").read_bytes(), number)
        for words in (["models/cube.obj"], ["explain", "models/cube.obj", "8,8"], ["batch", "models", "-o", "out/"],
                      ["batch", "models", "--isolate", "-o", "out/"]):
            self.good(*words, "--look", "else/blue.look", "-s", 16, *REQUIRE)
        job = {"id": 1, "model": "models/cube.obj", "output": "job.png", "options": {"look": "else/blue.look", "size": "16"}}
        for more in ([], ["--isolate"]):
            done = self.good("batch", "--jobs", "-", "--allow-path", ".", *more, *REQUIRE, stdin=json.dumps(job).encode() + b"\n")
            self.assertEqual(json.loads(done.stdout)["outcome"], "written", done.stdout)

    def test_optional_libraries(self):
        """Libraries that are loaded on first use also load in the sandbox."""
        for ending in ("webp", "exr"):
            done = self.run_program("cube.obj", "-s", "32x16", "-o", "a." + ending, *REQUIRE)
            self.assertIn(done.returncode, (0, 3), done.stderr)
            if done.returncode == 0:
                self.good("sphere", "-s", 16, "--environment", "a." + ending, "--reflectivity", 1, *REQUIRE, "-o", "b.png")
        without = self.run_program("plot", "spot", "-o", "plot.png")
        if without.returncode == 0:
            self.good("compare", "cube.obj", "--sheet", "terms", "-s", 40, "-o", "c.png", *REQUIRE)
        import test_limits
        bad = self.file("damaged.gltf", test_limits.MODELS["draco-sequential.gltf"])
        modes = [self.run_program(bad, "-s", 8, "--sandbox", mode).stderr for mode in ("require", "off")]
        self.assertEqual(modes[0], modes[1])  # whether found or missing

    def test_a_model_reads_its_folder_alone(self):
        cube = (self.folder / "cube.obj").read_text()
        picture = self.good("cube.obj", "-s", 8, "-o", "-").stdout
        self.file("secret/map.png", picture)
        self.file("shop/maps/map.png", picture)
        os.symlink("../secret/map.png", self.folder / "shop/link.png")
        os.symlink("maps/map.png", self.folder / "shop/inside.png")
        for name, good in (("maps/map.png", True), ("maps/../maps/map.png", True), ("maps/../../shop/maps/map.png", False), ("inside.png", None), ("link.png", False), ("../secret/map.png", False),
                           (str(self.folder / "secret/map.png"), False)):
            self.file("shop/a.mtl", f"newmtl m\nmap_Kd {name}\n")
            self.file("shop/a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
            for mode in ("require", "off"):
                done = self.good("shop/a.obj", "-s", 8, "-o", "a.png", "--sandbox", mode)
                expected = mode == "off" if good is None else good  # "require" follows no link below the folder
                self.assertEqual(b"drawn without this texture" not in done.stderr, expected, f"{name} {mode} {done.stderr}")
        # A link named by the user is followed.
        os.symlink("../cube.obj", self.folder / "shop/mine.obj")
        self.good("shop/mine.obj", "-s", 8, "-o", "a.png", *REQUIRE)
        self.assertTrue(cube)

    def test_scene_files(self):
        self.file("shop/a.json", json.dumps({"lambent": 1, "objects": [{"file": "../cube.obj"}]}))
        self.good("shop/a.json", "-s", 8, "-o", "a.png")
        self.assertIn("may name files anywhere", self.good("shop/a.json", "-s", 8, "-o", "a.png", "-v").stderr.decode())
        leaves = {"shop", "a.png"}
        self.bad(2, "shop/a.json", "-s", 8, "-o", "a.png", *REQUIRE, says=["cube.obj", "leads out of the folder"], leaves=leaves)
        self.good("shop/a.json", "-s", 8, "-o", "a.png", *REQUIRE, "--allow-path", ".")
        self.file("other/b", "")
        self.bad(2, "shop/a.json", "-s", 8, "-o", "shop/a.png", "--allow-path", "other", says=["cube.obj", "Permission denied", "--allow-path"], leaves={*leaves, "other"})
        self.bad(1, "cube.obj", "--allow-path", "none", says=["--allow-path", "none"], leaves={*leaves, "other"})

    def test_files_of_the_command_line(self):
        picture = self.good("cube.obj", "-s", "64x32", "-o", "-").stdout
        self.file("far/wide.png", picture)
        self.file("near/cube.obj", (self.folder / "cube.obj").read_bytes())
        self.good("near/cube.obj", "--environment", "far/wide.png", "-s", 8, "-o", "near/a.png", *REQUIRE)
        self.good("diff", "far/wide.png", "far/wide.png", *REQUIRE)
        font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
        if os.path.exists(font):
            shutil.copy(font, self.folder / "far/font.ttf")
            self.good("compare", "near/cube.obj", "--font", "far/font.ttf", "--sheet", "terms", "-s", 40, "-o", "near/c.png", *REQUIRE)

    def test_opengl(self):
        done = self.bad(3, "cube.obj", "--device", "gl", *REQUIRE, says=["--sandbox require", "OpenGL"])
        self.assertEqual(done.stderr.count(b"\n"), 1)
        done = self.run_program("cube.obj", "--device", "gl", "-s", 16, "-v")
        if done.returncode == 0:
            self.assertIn(b"sandbox  off; OpenGL", done.stderr)

    def test_outputs(self):
        """As without the sandbox, an older picture is replaced, another program's file is not, and a link leads to the replaced file."""
        self.good("cube.obj", "-s", 8, *REQUIRE)
        self.good("cube.obj", "-s", 8, *REQUIRE)
        self.file("cube.png", b"mine")
        self.bad(5, "cube.obj", "-s", 8, *REQUIRE, says="did not write", leaves={"cube.png"})
        self.file("real/a.png", b"old")
        os.symlink("real/a.png", self.folder / "a.png")
        self.good("cube.obj", "-s", 8, "-o", "a.png", *REQUIRE)
        self.assertTrue((self.folder / "a.png").is_symlink())
        self.assertEqual((self.folder / "real/a.png").read_bytes()[:4], b"\x89PNG")

    def test_without(self):
        """If a method is missing, auto continues and require reports an error; under Valgrind, no privileges are dropped."""
        environment = {"LD_PRELOAD": "vgpreload_not_there.so"}
        done = self.run_program("cube.obj", "-s", 8, "-v", env=environment)
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"sandbox  off; ", done.stderr)
        done = self.run_program("cube.obj", "-s", 8, *REQUIRE, env=environment)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr.decode(), r"lambent: option '--sandbox require': the sandbox is not complete: \S")
