# test_settings.py: lambent.json, the user's own defaults: when it is read, when it is ignored, and what reports state
# about it.
import json
import os
import pathlib
import shlex

from harness import Case, read_png


class Settings(Case):
    def setUp(self):
        super().setUp()
        self.home = self.folder / "home"
        self.file = self.home / "lambent" / "lambent.json"
        self.file.parent.mkdir(parents=True)
        self.given.add("home")
        self.env = {"XDG_CONFIG_HOME": str(self.home), "CI": ""}

    def write(self, settings):
        self.file.write_text(settings if isinstance(settings, str) else json.dumps(settings, indent=1))

    def picture(self, *words, env=None):
        return self.good(*words, "-o", "-", env=env or self.env).stdout

    def size(self, *words, env=None):
        return read_png(self.picture(*words, env=env))[:2]


class Reading(Settings):
    def test_applies(self):
        self.write({"lambent": 1, "image": {"size": [64, 48], "background": "#ff0000"}, "edges": ["crease"], "edge_color": [0, 0.5, 1], "shadows": True})
        drawn = self.picture("cube.obj")
        self.assertEqual(read_png(drawn)[:2], (64, 48))
        self.assertEqual(read_png(drawn)[2][:4], b"\xff\0\0\xff")
        typed = self.picture("cube.obj", "--no-config", "-s", "64x48", "-b", "#ff0000", "--edges", "crease", "--edge-color", "0/0.5/1", "--shadows")
        self.assertEqual(drawn, typed)
        self.assertNotEqual(drawn, self.picture("cube.obj", "--no-config", "-s", "64x48", "-b", "#ff0000"))

    def test_printed_command_gives_the_same_bytes(self):
        self.write({"image": {"size": [50, 40], "tone": "aces", "exposure": 0.5, "samples": 2}, "ground": "color", "ground_color": "#446688",
                    "environment": {"builtin": "sky", "rotation": 30}, "light_cutoff": 0, "edge_angle": 30, "edges": [], "surfaces": True})
        drawn = self.picture("cube.obj")
        plan = self.good("cube.obj", "--dry-run", env=self.env).stdout.decode()
        words = shlex.split(next(line for line in plan.splitlines() if line.startswith("  options"))[len("  options"):])
        self.assertIn("--no-config", words)
        self.write({"image": {"size": [9, 9]}, "shadows": True})  # another user
        self.assertEqual(drawn, self.picture("cube.obj", *words))
        report = json.loads(self.good("cube.obj", "--dry-run", "--json", *words, env=self.env).stdout)
        self.assertNotIn("settings", report)

    def test_reports(self):
        self.write({"image": {"size": [40, 30]}, "shadows": True})
        expected = [{"name": "size", "value": "40x30"}, {"name": "shadows", "value": None}]
        self.assertEqual(self.report("cube.obj", env=self.env)["settings"], expected)
        self.assertEqual(self.report("cube.obj", "--dry-run", env=self.env)["settings"], expected)
        self.assertIn("settings --size 40x30 --shadows", self.good("cube.obj", "-v", env=self.env).stderr.decode())
        explained = json.loads(self.good("explain", "cube.obj", "20,15", "--json", env=self.env).stdout)
        self.assertEqual((explained["width"], explained["settings"]), (40, expected))
        self.assertNotIn("settings", self.report("cube.obj", "--no-config", env=self.env))
        self.assertNotIn("settings", self.report("cube.obj", "-s", "9", "--shadows", env=self.env))

    def test_every_setting_of_scene_files(self):
        """Each key of scene files that is also an option can be set in the same form, and is printed."""
        schema = json.loads(self.good("generate", "scene-schema").stdout)["properties"]
        models = {"$schema", "lambent", "image", "camera", "ambient", "environment", "reflection_map", "up", "materials", "objects", "lights", "sections", "ground_color"}
        keys = [key for key in schema if key not in models]
        self.assertGreater(len(keys), 25)
        for key in keys:
            kind = schema[key]
            while "oneOf" in kind or "anyOf" in kind:
                kind = (kind.get("oneOf") or kind.get("anyOf"))[0]
            value = (kind["enum"][0] if "enum" in kind else True if kind.get("type") == "boolean" else [] if kind.get("type") == "array"
                     else "#123456" if key.endswith("color") else kind.get("minimum", 1))
            value = "off" if key == "ground" else value
            with self.subTest(key=key, value=value):
                self.write({key: value})
                found = json.loads(self.good("config", "--json", env=self.env).stdout)["settings"]
                self.assertEqual([(row["name"], row["line"]) for row in found], [(key.replace("_", "-"), 2)])

    def test_precedence(self):
        self.write({"image": {"size": [40, 30]}, "shading": "flat", "edges": ["crease"]})
        self.assertEqual(self.size("cube.obj", "-s", "20"), (20, 20))
        self.good("cube.obj", "--stage", "fragment", "--shading", "phong", "-o", "a.png", env=self.env)
        report = self.report("cube.obj", "--look", "technical", "-s", "9", "--dry-run", env=self.env)
        self.assertNotIn("settings", report)  # the look determines shading and edges
        self.assertNotIn("settings", self.report("cube.obj", "--stage", "vertex", "--edges", "none", "-s", "9", env=self.env))
        self.good("cube.obj", "-o", "{stem}-{size}.png", "--sizes", "11,12", env=self.env)
        self.assertEqual(self.new_files(), {"a.png", "cube.png", "cube-11.png", "cube-12.png"})

    def test_scene_files_describe_themselves(self):
        self.good("cube.obj", "-s", "32", "--save-scene", "s.json", "-o", "a.png", env=self.env)
        plain = self.picture("s.json", "--no-config")
        self.write({"image": {"size": [40, 30], "background": "red", "exposure": 2, "tone": "aces", "samples": 1, "color_mode": "raw"}, "shadows": True,
                    "shading": "flat", "ground": "off", "edges": ["crease"], "environment": {"builtin": "sky", "rotation": 9}, "wireframe_color": "red",
                    "surfaces": False})
        self.assertEqual(self.picture("s.json"), plain)
        self.assertNotIn("settings", self.report("s.json", env=self.env))

    def test_ground_yields_to_flat_shading(self):
        self.write({"ground": "shadow"})
        for words in (["--shading", "flat"], ["--stage", "vertex"], ["--look", "technical"]):
            self.assertEqual(self.good("cube.obj", *words, "-q", "-o", "a.png", env=self.env).stderr, b"")

    def test_byte_order_mark(self):
        self.file.write_bytes(b"\xef\xbb\xbf{}")
        self.assertEqual(self.good("config", env=self.env).stdout.decode(), f"{self.file}: read\n")

    def test_config_command(self):
        self.write('{\n  "shadows": true,\n  "image": {\n    "background": "white"\n  }\n}\n')
        self.assertEqual(self.good("config", env=self.env).stdout.decode(),
                         f"{self.file}: read\n  line 4    --background white\n  line 2    --shadows\n")
        self.assertEqual(json.loads(self.good("config", "--json", "--no-config", env=self.env).stdout),
                         {"lambent": self.report("cube.obj")["lambent"], "file": str(self.file), "state": "off", "settings": []})
        self.assertIn("CI is set", self.good("config", env={**self.env, "CI": "true"}).stdout.decode())
        self.file.unlink()
        self.assertEqual(self.good("config", env=self.env).stdout.decode(), f"{self.file}: no such file\n")

    def test_home(self):
        (self.folder / ".config").mkdir()
        shown = self.good("config", env={"HOME": str(self.folder), "XDG_CONFIG_HOME": "", "CI": ""}).stdout.decode()
        self.assertTrue(shown.startswith(f"{self.folder}/.config/lambent/lambent.json: "), shown)
        self.assertIn("neither XDG_CONFIG_HOME nor HOME", self.good("config", env={"HOME": "", "XDG_CONFIG_HOME": "", "CI": ""}).stdout.decode())

    def test_thumbnailer(self):
        """The file manager's size has priority; the other settings apply."""
        self.write({"image": {"size": [40, 30], "background": "#00ff00"}})
        done = self.good("-q", "-s", "64", "--time-limit", "20", "-o", "-", "cube.stl", env=self.env)
        width, height, data = read_png(done.stdout)
        self.assertEqual((width, height, data[:4], done.stderr), (64, 64, b"\0\xff\0\xff", b""))


class Unread(Settings):
    def setUp(self):
        super().setUp()
        self.write({"image": {"size": [40, 30]}, "shadows": True})

    def test_elsewhere(self):
        """Batches, hashes and comparisons are the same for every user."""
        self.good("batch", "cube.obj", "-o", "b.png", "--journal", "none", env=self.env)
        self.assertEqual(read_png((self.folder / "b.png").read_bytes())[:2], (1024, 1024))
        self.good("hash", "cube.obj", "-o", "h", "-s", "32", env=self.env)
        self.good("hash", "--check", "h", env={**self.env, "XDG_CONFIG_HOME": str(self.folder)})
        self.assertNotIn("40x30", (self.folder / "h").read_text())
        self.assertEqual(self.run_program("diff", "cube.obj", "cube.obj", "--json", env=self.env).returncode, 0)
        for command in ("batch", "hash", "diff", "check", "compare", "info", "convert", "view"):
            done = self.run_program(command, "--config", self.file, "cube.obj", env=self.env)
            self.assertEqual(done.returncode, 1)
            self.assertIn("option '--config' does not apply to this command", done.stderr.decode())

    def test_ci(self):
        self.assertEqual(self.size("cube.obj", env={**self.env, "CI": "1"}), (1024, 1024))
        self.assertEqual(self.size("cube.obj", "--config", self.file, env={**self.env, "CI": "1"}), (40, 30))

    def test_never_beside_a_model(self):
        for name in ("lambent.json", ".lambent.json", "lambent/lambent.json", ".config/lambent/lambent.json"):
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.file.read_text())
        for env in ({"XDG_CONFIG_HOME": ".", "HOME": "."}, {"XDG_CONFIG_HOME": "", "HOME": ""}, {"XDG_CONFIG_HOME": ".config", "HOME": "relative"}):
            self.assertEqual(self.size("cube.obj", env={"CI": "", **env}), (1024, 1024))

    def test_page(self):
        """A page is the same for everybody, so the file is not even read."""
        self.write("{")
        done = self.run_program("cube.obj", "-o", "x.html", env={**self.env, "LAMBENT_PAGE": str(self.folder / "none")})
        self.assertNotIn("lambent.json", done.stderr.decode())


class Wrong(Settings):
    CASES = (
        ('{\n  "shadows": 1\n}', ":2: shadows: found a number, expected true or false"),
        ('{\n\n  "shadow": true }', ":3: shadow: unknown key; did you mean 'shadows'?"),
        ('{ "image": {\n "size": [0, 9] } }', ":2: image.size: found '0x9', expected W or WxH from 1 to 65535 pixels"),
        ('{ "image": { "size": 9 } }', ":1: image.size: found a number, expected a list"),
        ('{ "image": { "size": [1, "b"] } }', ":1: image.size: found '1xb', expected W or WxH"),
        ('{ "image": { "syze": [1, 2] } }', ":1: image.syze: unknown key; did you mean 'size'?"),
        ('{ "image": [] }', ":1: image: expected an object"),
        ('{ "image": { "samples": 3 } }', ":1: image.samples: found '3', expected 1, 2, 4, 8 or 16"),
        ('{ "image": { "background": "whit" } }', ":1: image.background: "),
        ('{ "shading": "glossy" }', ":1: shading: found 'glossy', expected flat"),
        ('{ "edges": "crease" }', ":1: edges: found a string, expected a list"),
        ('{ "ao_radius": 1e999 }', ":1: "),
        ('{ "ao_radius": -1 }', ":1: ao_radius: found '-1', expected a number from 0.001 to 10"),
        ('{ "ground_color": "red" }', ':1: ground_color: expected "ground": "color" as well'),
        ('{ "environment": { "builtin": "secret.hdr" } }', ':1: environment.builtin: found a file, expected the name of a built-in environment, such as "studio"'),
        ('{ "environment": { "equirectangular": "a.hdr" } }', ":1: environment.equirectangular: unknown key"),
        ('{ "environment": { "file": "a.hdr" } }', ":1: environment.file: unknown key, expected one of builtin, rotation"),
        ('{ "background": "white" }', ":1: background: unknown key; did you mean 'image.background'?"),
        ('{ "image": { "edges": [] } }', ":1: image.edges: unknown key; did you mean 'edges'?"),
        ('{ "up": "z" }', ":1: up: unknown key"),
        ('{ "output": "x.png" }', ":1: output: unknown key"),
        ('{ "lambent": 2 }', ":1: lambent: expected 1"),
        ('{ "shadows": true,\n "shadows": true }', ":2: not valid JSON: duplicate object key"),
        ("[1]", ":1: found a list, expected an object"),
        ('{ "shadows": true,\n\n', ":3: not valid JSON: "),
        ("", ":1: not valid JSON: "),
        ('{ "image": { "background": "a\\u0000b" } }', ":1: not valid JSON: "),
        ("\0{}", ":1: not valid JSON: "),
        ("[" * 60000, ":1: not valid JSON: "),
    )

    def test_sentences(self):
        for text, sentence in self.CASES:
            with self.subTest(text=text[:60]):
                self.write(text)
                done = self.bad(2, "cube.obj", env=self.env, says=f"lambent: {self.file}{sentence}")
                self.assertEqual(done.stderr.count(b"\n"), 1)
        report = json.loads(self.run_program("cube.obj", "--json", env=self.env).stdout)
        self.assertEqual(report["error"]["code"], "cannot-read")

    def test_files(self):
        """Links to a file are followed; pipes, folders, devices and huge files are refused immediately."""
        target = self.folder / "dot.json"
        target.write_text('{ "image": { "size": [8, 8] } }')
        self.file.symlink_to(target)
        self.assertEqual(self.size("cube.obj"), (8, 8))
        self.file.unlink()
        os.mkfifo(self.file)
        self.bad(2, "cube.obj", env=self.env, says="not a regular file", timeout=10)
        self.file.unlink()
        self.file.symlink_to("/dev/zero")
        self.bad(2, "cube.obj", env=self.env, says="not a regular file", timeout=10)
        self.file.unlink()
        self.file.mkdir()
        self.bad(2, "cube.obj", env=self.env, says="not a regular file")
        self.file.rmdir()
        with open(self.file, "wb") as out:
            out.truncate(1 << 40)
        self.bad(2, "cube.obj", env=self.env, says="longer than 64 KiB", timeout=10)
        self.file.unlink()
        self.file.symlink_to(self.file)  # a cycle: there is no file
        self.assertEqual(self.size("cube.obj"), (1024, 1024))

    def test_unreadable(self):
        user = self.plain_user()
        self.write("{}")
        self.file.chmod(0)
        self.bad(2, "cube.obj", env=self.env, user=user, says="cannot read: Permission denied")
        self.file.parent.chmod(0)  # as in a sandbox: it is unknown whether the file exists
        self.good("cube.obj", "-o", "-", "-s", "8", env=self.env, user=user)
        self.file.parent.chmod(0o755)

    def test_command_line(self):
        self.bad(2, "cube.obj", "--config", "nope", says="nope: cannot read: No such file or directory")
        self.write("{}")
        self.bad(1, "cube.obj", "--config", self.file, "--no-config", says="found --config and --no-config, expected one of them")

    def test_hint(self):
        """If the settings make a command invalid, the error message names their file."""
        self.write({"shadows": True})
        done = self.bad(1, "cube.obj", "--hide", "nothing", env=self.env)
        self.assertIn(f"The settings of {self.file} are in force; --no-config ignores them.", done.stderr.decode())

    def test_sandbox(self):
        """The file is read before the sandbox starts, because the sandbox hides its folder."""
        self.write({"image": {"size": [8, 8]}})
        self.assertEqual(pathlib.Path(self.file).parent.parent.name, "home")
        self.assertEqual(self.size("cube.obj", "--sandbox", "auto"), (8, 8))
