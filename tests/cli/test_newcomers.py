# test_newcomers.py: commands that new users type: each works, or an error message states the correct form.
import os

from harness import Case, covered, read_png

ANIMATION = "use .gif or .webp, which support animations; for a video, pipe frames to ffmpeg"
SIZE = "-s 640x480"


class Sentences(Case):
    def check(self, rows):
        """`rows`: {command line: (exit code, parts of the error message)}."""
        for line, (code, *says) in rows.items():
            with self.subTest(line):
                self.one_sentence(self.bad(code, *line.split(), says=says, leaves=self.new_files()))

    def one_sentence(self, done):
        lines = [line for line in done.stderr.decode().splitlines() if not line.startswith("Try 'lambent ")]
        self.assertEqual(len(lines), 1, lines)

    def test_models(self):
        (self.folder / "folder").mkdir()
        (self.folder / "noise.step").write_text("hello there\n")
        self.given |= {"folder", "noise.step"}
        models = self.good("formats").stdout.decode().split("Pictures")[0].splitlines()[1:-1]
        reads = "lambent reads %s and scene files (.json)" % ", ".join("." + ending.strip(".") for line in models[:5] for ending in line.split()[1:])
        self.assertIn(".stl, .ply, ", reads)
        self.check({
            "folder": (2, "found no model in the folder"), "render folder": (2, "lambent batch folder", "lambent view folder"),
            "https://example.com/a.glb": (2, "download it first", reads),
            "https://example.com/a.blend": (2, "download it first", reads, "export the model as .glb"),
            "a.blend": (2, reads, "export the model as .glb"), "a.dxf": (2, reads, "as .stl"),
            "cub.obj": (2, "did you mean 'cube.obj'?"), "cube.OBJ": (2, "did you mean 'cube.obj'?"),
            r"C:\models\cube.obj": (2, "separate folders by /"), "640": (2, SIZE), "opne": (2, "did you mean 'view'?"), "open": (1, "view: missing argument"),
            "stast cube.obj": (2, "stast: cannot open", "did you mean 'info'?"), "cube.obj entirely-else": (2, "no built-in shape has this name"),
            "diff cube.obj cube.png": (2, "diff compares two pictures, or two models"),
        })

    def test_pictures(self):
        self.check({
            "cube.obj -o t.mp4": (3, "lambent cannot write .mp4", ANIMATION), "cube.obj -o t.webm": (3, ANIMATION),
            "cube.obj -o t.pdf": (3, "use .png"), "cube.obj -o t.hdr": (3, "use .exr"), "cube.obj -o t.pgn": (3, "use .png"),
            "shape cube -o t.glb": (3, ".obj, .stl or .ply"),
            "cube.obj --output=~/t.png": (1, "--output ~/t.png"), "cube.obj --watch -o t.png": (1, "the command is: lambent view"),
            "-w 640 -h 480 cube.obj": (1, SIZE), "cube.obj -w640": (1, SIZE), "cube.obj -h480": (1, SIZE),
        })
        self.assertFalse(self.new_files())

    def test_options(self):
        self.check({
            "cube.obj -c red": (1, "'--color'"), "cube.obj -l point": (1, "'--light'"), "-V": (1, "'--version'"),
            "-?": (1, "'--help'"), "cube.obj –size 640": (1, "a typographic dash"), "cube.obj —size 640": (1, "a typographic dash"),
            "cube.obj --ao": (1, "needs a value: auto, off, screen or rays"), "cube.obj --turntable 0": (1, "from 2"),
            "cube.obj --opacity 50%": (1, "50% is 0.5"), "cube.obj --light 1,1,1": (1, "point, directional or spot"),
            "cube.obj --dpi 300": (1, "'--size'"), "cube.obj --margin 3": (1, "'--zoom'"), "cube.obj --material wood": (1, "`lambent materials` lists"),
            "cube.obj -s 80,60 -o t.png": (1, "one size is 800x600"),
            "cube.obj --color 255,128,0": (1, "'#ff8000'"), "cube.obj --color rgb(255,128,0)": (1, "'#ff8000'"),
            "cube.obj --color 0xff8800": (1, "'#ff8800'"),
            "compare cube.obj other": (1, "lambent diff"), "compare cube.obj cube.stl --sheet terms": (1, "lambent sheet draws many"), "explain cube.obj 5 4": (1, "such as 512,400"),
            "shapes teapot": (1, "lambent teapot"), "materials gold": (1, "--material gold"),
            "cube.obj --fov 60 --projection orthographic": (1, "--fov"), "cube.obj --fov 0": (1, "--fov"),
            "cube.obj -s 200 200": (1, "'--size': found '200 200', expected one word: 200x200"),
            "cube.obj --camera fovy=180": (1, "--camera"), "cube.obj --camera eye=1/2/3 --fov 60": (1, "'--camera' and '--fov'"),
        })

    def test_colors_of_bytes(self):
        for words, says in (("--color 255/0/0", "numbers from 0 to 1: it reflects more light than it receives; for 0 to 255 write #ff0000"),
                            ("--background 255/128/0", "numbers from 0 to 1; for 0 to 255 write #ff8000"),
                            ("--light point:color=255/0/0", "numbers from 0 to 1; for 0 to 255 write #ff0000"),
                            ("--material diffuse=0/0/255", "(above 1); for 0 to 255 write #0000ff")):
            with self.subTest(words):
                said = self.good("cube.obj", "-s", 8, "-o", "-", *words.split()).stderr.decode()
                self.assertEqual(said.count("warning"), 1, said)
                self.assertIn(says, said)
        for words in ("--color 1/0/0", "--background 0.5", "--ambient 2", "--light point:color=255/0/0,attenuation=0/0/1"):
            self.assertNotIn(b"warning", self.good("cube.obj", "-s", 8, "-o", "-", *words.split()).stderr, words)


class Works(Case):
    def test_lists_without_batch(self):
        (self.folder / "list.txt").write_text("cube.obj\n\ncube.stl\n")
        self.good("--files-from", "list.txt", "-s", 8, "-o", "out/{stem}-{ext}.png")
        self.assertEqual(set(os.listdir(self.folder / "out")), {"cube-obj.png", "cube-stl.png"})
        self.bad(1, "--files-from", "list.txt", "--save-scene", "a.json", says="a list of models")
        with open(os.devnull) as nothing:
            self.bad(1, stdin=nothing, says="no model given")
        self.bad(1, "compare", "--files-from", "list.txt", says="does not apply")

    def test_options_before_a_command(self):
        self.good("-q", "shape", "teapot", "-o", "a.stl")
        self.good("-o", "b.stl", "--segments", "8", "-q", "shape", "teapot")
        self.good("--ground", "shape", "cube", "-s", 8, "-q")  # a word that the option does not accept
        self.assertEqual(self.new_files(), {"a.stl", "b.stl", "cube.png"})
        self.bad(2, "--", "shape", says="a command comes first", leaves=self.new_files())
        self.assertIn(b"--sheet", self.good("complete", "--", "-q", "compare", "--sh").stdout)

    def test_field_of_view(self):
        wide, plain = (self.png("cube.obj", "-s", 40, *more) for more in (("--fov", 60), ()))
        self.assertNotEqual(wide, plain)
        self.assertEqual(plain, self.png("cube.obj", "-s", 40, "--fov", 30))
        self.assertEqual(wide, self.png("cube.obj", "-s", 40, "--camera", "fovy=60"))
        self.assertEqual(wide, self.png("cube.obj", "-s", 40, "--fovy", 60))
        left, top, right, bottom = covered(wide)
        self.assertGreater(max(right - left, bottom - top), 34)  # it fits the picture
        camera = self.report("cube.obj", "-s", 8, "--camera", "fovy=60", "--azimuth", 10)["camera"]
        self.assertAlmostEqual(camera["fovy_deg"], 60)
        self.good("cube.obj", "-s", 8, "--sweep", "fov=20..60", "--frames", 3, "-o", "{frame}.png")
        self.assertNotEqual((self.folder / "0.png").read_bytes(), (self.folder / "2.png").read_bytes())

    def test_scene_files_are_fitted_anew(self):
        self.good("cube.obj", "-s", 40, "--azimuth", 90, "-o", "-", "--save-scene", "a.json")
        self.assertEqual(read_png(self.good("a.json", "--fov", 60, "--azimuth", 90, "-o", "-").stdout),
                         self.png("cube.obj", "-s", 40, "--azimuth", 90, "--fov", 60))

    def test_help_finds_words(self):
        for words, found in ((["attenuation"], "\n  attenuation  "), (["viewport"], "--size"), (["normal"], "--normals"), (["pbr"], "--reflection"),
                             (["field", "of", "view"], "--fov"), (["glTF"], "--variant")):
            with self.subTest(words):
                self.assertIn(found, self.good("help", *words).stdout.decode())
        self.assertIn("lambent help lights", " ".join(self.good("help", "light").stdout.decode().split()))
        self.assertRegex(self.good("help", "lights").stdout.decode(), r"(?m)^  attenuation ")
        self.bad(1, "help", "entirely-else", says="unknown name 'entirely-else'")

    def test_lines_that_need_the_page_are_marked(self):
        text = " ".join(self.good("--help").stdout.decode().split("Picture:")[0].split())
        for line in ("-o koala.html", "view koala.obj", "view models/"):
            self.assertRegex(text, rf"{line} [^()]*\(after make web\)")


class OtherFolders(Case):
    """Textures in a folder next to the model's folder."""

    def setUp(self):
        super().setUp()
        for name in ("models", "textures"):
            (self.folder / name).mkdir()
        self.good("cube.obj", "-s", 8, "-b", "#0000ff", "-o", "textures/t.png")
        (self.folder / "textures" / "t.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd ../textures/t.png\n")
        (self.folder / "models" / "t.obj").write_text("mtllib ../textures/t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        self.given |= {"models", "textures"}

    def test_allowed(self):
        without = self.good("models/t.obj", "-s", 16, "-o", "-")
        self.assertIn(b"the name is '../textures/t.mtl', outside of this folder; use --allow-path FOLDER to allow it", without.stderr)
        allowed = {}
        for path in (".", "textures"):
            for sandbox in ("require", "off"):
                done = self.good("models/t.obj", "-s", 16, "-o", "-", "--allow-path", path, "--sandbox", sandbox)
                self.assertNotIn(b"warning", done.stderr)
                allowed[path, sandbox] = done.stdout
        self.assertEqual(len(set(allowed.values())), 1)
        self.assertNotEqual(without.stdout, allowed[".", "off"])
        done = self.good("models/t.obj", "-s", 16, "-o", "-", "--allow-path", "models")
        self.assertIn(b"outside of this folder", done.stderr)
        # A single file may be allowed, without the other files in its folder.
        done = self.good("models/t.obj", "-s", 16, "-o", "-", "--allow-path", "textures/t.mtl")
        self.assertIn(b"the name is '../textures/t.png', outside of this folder", done.stderr)
        self.assertNotIn(b"t.mtl", done.stderr)

    def test_absolute_names_and_links(self):
        (self.folder / "models" / "t.mtl").write_text(f"newmtl m\nKd 1 1 1\nmap_Kd {self.folder}/textures/t.png\n")
        (self.folder / "models" / "l.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd link/t.png\n")
        (self.folder / "models" / "link").symlink_to("../textures")
        text = (self.folder / "models" / "t.obj").read_text()
        for library in ("t.mtl", "l.mtl"):
            (self.folder / "models" / "a.obj").write_text(text.replace("../textures/t.mtl", library))
            self.assertIn(b"drawn without this texture", self.good("models/a.obj", "-s", 8, "-o", "-").stderr)
            self.assertNotIn(b"warning", self.good("models/a.obj", "-s", 8, "-o", "-", "--allow-path", "textures").stderr)

    def test_jobs_stay_in_their_folders(self):
        job = b'{"id": "1", "model": "models/t.obj", "output": "out.png", "options": ["-s", "8"]}\n'
        done = self.good("batch", "--jobs", "-", "--allow-path", ".", stdin=job)
        self.assertIn(b"outside of this folder", done.stdout)
