# test_hash.py: the command `hash`: files of hashes, reports about changed models, their sheets; hostile files and names.
import json
import os
import resource
import shutil
import subprocess

from harness import PROGRAM, Case, read_png
from test_batch import xxh64


class Hash(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "m" / "sub").mkdir(parents=True)
        shutil.copy(self.folder / "cube.stl", self.folder / "m" / "a.stl")
        shutil.copy(self.folder / "cube.obj", self.folder / "m" / "sub")
        shutil.copy(self.folder / "cube.mtl", self.folder / "m" / "sub")
        self.given.add("m")

    def write(self, *more, code=0):
        done = self.run_program("hash", "m", "teapot", "-s", 64, "-o", "p.hash", *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def lines(self, name="p.hash"):
        return (self.folder / name).read_text().splitlines()

    def check(self, *words, code):
        done = self.run_program("hash", *words)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout.decode().splitlines()

    def grow(self):
        """Writes another model as a.stl."""
        self.good("shape", "torus", "-o", "m/a.stl", "-q")

    def test_file(self):
        self.write()
        version = self.good("--version").stdout.decode().split()[1]
        head, rows = self.lines()[:3], dict(reversed(line.split("  ")) for line in self.lines()[3:])
        self.assertEqual(head, ["lambent hashes 1", f"version {version}", "options --size 64"])
        self.assertEqual(list(rows), ["m/a.stl", "m/sub/cube.obj", "teapot"])
        for name, hashed in rows.items():  # the pixels of the program's picture
            self.assertEqual(hashed, xxh64(self.png(name, "-s", 64)[2]).replace("xxh64:", "pixels:"))

    def test_equal(self):
        self.write()
        for words in (["m", "teapot", "-s", 64], ["-s", 64], ["-s", 64, "--isolate"], ["-s", 64, "-j", 1]):
            self.assertEqual(self.check(*words, "--check", "p.hash", code=0), ["3 equal"])
        os.makedirs(self.folder / "deep" / "er")
        os.rename(self.folder / "p.hash", self.folder / "deep" / "er" / "q.hash")
        self.check("m", "--check", "deep/er/q.hash", "-s", 64, code=6)  # names are relative to the file
        self.good("hash", "m", "-o", "deep/er/q.hash", "-s", 64)
        self.assertIn("../../m/a.stl", "".join(self.lines("deep/er/q.hash")))
        self.assertEqual(self.check("--check", "deep/er/q.hash", "-s", 64, "--allow-path", "m", code=0), ["2 equal"])

    def test_files_of_options(self):
        """An environment and a look are named relative to the file of hashes, from whichever folder the check runs."""
        (self.folder / "sky").mkdir()
        self.good("teapot", "-s", "64x32", "-b", "#336699", "-o", "sky/a b.png", "-q")
        (self.folder / "sky" / "own.look").write_text("--ground shadow\n")
        options = ["--environment", "sky/a b.png", "--look", "sky/own.look", "--reflectivity", "0.5", "-s", 32]
        self.good("hash", "m", "-o", "sky/p.hash", *options)
        self.assertEqual(self.lines("sky/p.hash")[2], "options --size 32 --look own.look --environment 'a b.png' --reflectivity 0.5")
        self.assertEqual(self.check("--check", "sky/p.hash", "--allow-path", "m", code=0), ["2 equal"])
        self.assertEqual(self.check("m", "--check", self.folder / "sky/p.hash", code=0), ["2 equal"])
        self.assertEqual(self.check("m", "--check", "sky/p.hash", *options, code=0), ["2 equal"])
        os.makedirs(self.folder / "deep" / "er")
        for face in "abcdef":
            self.good("teapot", "-s", "16", "-o", f"sky/{face}.png", "-q")
        self.good("hash", "m", "-o", "deep/er/q.hash", "--environment", ",".join(f"sky/{face}.png" for face in "abcdef"), "-s", 32)
        self.assertIn(",".join(f"../../sky/{face}.png" for face in "abcdef"), self.lines("deep/er/q.hash")[2])
        self.assertEqual(self.check("m", "--check", "deep/er/q.hash", "--allow-path", "sky", code=0), ["2 equal"])
        self.good("hash", "m", "-o", "deep/er/q.hash", "--environment", "studio", "--look", "catalog", "-s", 32)
        self.assertEqual(self.lines("deep/er/q.hash")[2], "options --size 32 --look catalog --environment studio")
        self.assertEqual(self.check("m", "--check", "deep/er/q.hash", code=0), ["2 equal"])

    def test_differences(self):
        self.write()
        self.grow()
        os.remove(self.folder / "m" / "sub" / "cube.obj")
        shutil.copy(self.folder / "cube.ply", self.folder / "m" / "n.ply")
        before = self.lines()
        self.assertEqual(self.check("m", "teapot", "-s", 64, "--check", "p.hash", code=6),
                         ["changed  m/a.stl", "missing  m/sub/cube.obj", "new      m/n.ply", "1 equal, 1 changed, 1 missing, 1 new"])
        found = json.loads(self.run_program("hash", "m", "teapot", "-s", 64, "--check", "p.hash", "--json").stdout)
        self.assertEqual([found[key] for key in ("equal", "changed", "missing", "new", "failed", "written")],
                         [["teapot"], ["m/a.stl"], ["m/sub/cube.obj"], ["m/n.ply"], [], False])
        self.assertEqual(self.lines(), before)  # it only reads
        # If no models are given, a model in the file that no longer exists is a failure.
        self.check("-s", 64, "--check", "p.hash", code=7)

    def test_says_first(self):
        """Another version or other options are reported before the pictures are drawn."""
        self.write()
        text = (self.folder / "p.hash").read_text()
        (self.folder / "p.hash").write_text(text.replace("version ", "version 0.0.7-"))
        done = self.run_program("hash", "--check", "p.hash", "-s", 64)
        self.assertEqual((done.returncode, done.stdout), (0, b"3 equal\n"))
        self.assertIn(b"p.hash was written by version 0.0.7-", done.stderr)
        done = self.run_program("hash", "--check", "p.hash", "-b", "white", "-s", 64)
        self.assertEqual(done.returncode, 6)
        self.assertIn(b"'--size 64', and these are '--size 64 --background white'", done.stderr)

    def test_options_of_the_file(self):
        """Without picture options, --check uses only the file's picture options."""
        self.good("hash", "m", "teapot", "-o", "p.hash", "-s", 64, "-b", "#fff", "--light", "point:position=1/2/3", "-q")
        text = (self.folder / "p.hash").read_text()
        self.assertIn("--background '#fff'", text)
        self.assertEqual(self.check("--check", "p.hash", code=0), ["3 equal"])
        head = text.splitlines()[2]
        for line, says in (("options -o evil.png", "expected options that change the picture"), ("options --nope 3", "unknown option '--nope'"),
                           ("options --size 64 '", "expected options that change the picture"), ("options --json", "expected options that change the picture")):
            (self.folder / "p.hash").write_text(text.replace(head, line))
            self.bad(2, "hash", "--check", "p.hash", says=says)

    def test_update_of_some(self):
        """--update of one model keeps the hashes of other existing models, and drops the hashes of deleted files."""
        self.write()
        before = self.lines()
        os.remove(self.folder / "m/sub/cube.obj")
        self.check("m/a.stl", "--check", "p.hash", "--update", code=0)
        self.assertEqual(self.lines(), [line for line in before if "cube.obj" not in line])

    def test_update(self):
        self.write("--pictures", "kept")
        self.assertEqual(xxh64(read_png((self.folder / "kept/m/a.stl.png").read_bytes())[2]).replace("xxh64", "pixels"), self.lines()[3].split()[0])
        self.grow()
        out = self.check("m", "teapot", "-s", 64, "--check", "p.hash", "--update", "--pictures", "kept", code=0)
        self.assertEqual(out[-1], "written to p.hash; old and new pictures: p-changes.png")
        width, height, pixels = read_png((self.folder / "p-changes.png").read_bytes())
        column = lambda k: [pixels[4 * (y * width + 16 + 336 * k + x):][:3] for y in range(68, 132) for x in range(64)]
        old, new, where = (set(column(k)) for k in range(3))
        self.assertTrue(len(old) > 9 and len(new) > 9 and len(where) > 9)
        self.assertNotEqual(column(0), column(1))
        self.assertEqual(self.check("--check", "p.hash", "-s", 64, code=0), ["3 equal"])
        self.assertEqual(xxh64(read_png((self.folder / "kept/m/a.stl.png").read_bytes())[2]).replace("xxh64", "pixels"), self.lines()[3].split()[0])
        # A picture that does not match the hash is not used as the old one.
        shutil.copy(self.folder / "kept" / "teapot.png", self.folder / "kept" / "m" / "a.stl.png")
        shutil.copy(self.folder / "cube.stl", self.folder / "m" / "a.stl")
        self.check("-s", 64, "--check", "p.hash", "--update", "--pictures", "kept", code=0)
        width, _, pixels = read_png((self.folder / "p-changes.png").read_bytes())
        self.assertEqual(width, 16 + 336)  # only new pictures: there is no old picture to compare with
        self.assertGreater(len(set(column(0))), 9)
        # Without changes, there is no sheet.
        os.remove(self.folder / "p-changes.png")
        self.check("-s", 64, "--check", "p.hash", "--update", code=0)
        self.assertFalse((self.folder / "p-changes.png").exists())

    def test_failures(self):
        (self.folder / "m" / "bad.obj").write_text("nonsense")
        done = self.bad(7, "hash", "m", "-o", "p.hash", says=("m/bad.obj", "is not written", "--failures-ok"))
        self.assertEqual(done.stdout, b"2 hashes, 1 failed\n")
        self.write("--failures-ok")
        self.assertNotIn("bad", "".join(self.lines()))
        self.check("m", "teapot", "-s", 64, "--check", "p.hash", "--failures-ok", code=0)
        self.assertEqual(self.check("m", "teapot", "-s", 64, "--check", "p.hash", code=7)[0], "failed   m/bad.obj")
        (self.folder / "m" / "a.stl").write_text("nonsense")  # a failed model of the file is not ignored
        self.check("m", "teapot", "-s", 64, "--check", "p.hash", "--failures-ok", code=6)

    def test_names(self):
        """Line ends and backslashes in names; names that lead out of the folder of pictures."""
        odd = "m/a\nb\\c.stl"
        shutil.copy(self.folder / "cube.stl", self.folder / odd)
        self.write("--pictures", "in/kept")
        self.assertIn("m/a\\nb\\\\c.stl", (self.folder / "p.hash").read_text())
        self.assertEqual(self.check("--check", "p.hash", "-s", 64, code=0), ["4 equal"])
        os.mkdir(self.folder / "x")
        self.good("hash", "m/a.stl", "-s", 8, "-o", "x/p.hash", "--pictures", "x/kept")
        self.assertTrue((self.folder / "x/kept/m/a.stl.png").exists())

    def test_folder_of_pictures(self):
        """If a folder cannot be created, one error message appears before anything is drawn."""
        (self.folder / "file").write_text("")
        for folder, says in (("file", "found the file 'file', expected a folder"), ("file/x", "cannot make the folder 'file/x': Not a directory")):
            done = self.bad(5, "hash", "m", "-s", 8, "-o", "p.hash", "--pictures", folder, says=says)
            self.assertNotIn(b"failed", done.stderr)
        user = self.plain_user()
        if user:
            os.mkdir(self.folder / "theirs", 0o755)
            self.bad(5, "hash", "m", "-s", 8, "-o", "-", "--pictures", "theirs", says="theirs: cannot write to the folder: Permission denied", user=user)
        self.write()
        self.check("--check", "p.hash", "--pictures", "file", code=0)  # which writes no pictures

    def test_report_beside_the_file(self):
        """The file is written to standard output, and only the report to standard error."""
        done = self.good("hash", "m", "-s", 8, "-o", "-", "--json")
        self.assertTrue(done.stdout.startswith(b"lambent hashes 1\n"))
        self.assertEqual(len(json.loads(done.stderr)["new"]), 2)

    def test_bad_files(self):
        self.write()
        text = (self.folder / "p.hash").read_text()
        self.given.update(("p.hash", "b.hash"))
        for bad, says in ((b"", "the file ends"), (b"hello\n", "expected 'lambent hashes 1'"), (text[:30].encode(), "lines 'version' and 'options'"),
                          (text.replace("pixels:", "xxh64:").encode(), "b.hash:4"), (text.replace("m/a.stl", "m/\\x").encode(), "b.hash:4"),
                          (text.replace("m/a.stl", "teapot").encode(), "twice"), (text.replace("m/a", "m/\0").encode(), "zero byte"),
                          (b"\xff\xfe" + os.urandom(100), "b.hash")):
            (self.folder / "b.hash").write_bytes(bad)
            self.bad(2, "hash", "m", "--check", "b.hash", says=says)
        self.bad(2, "hash", "m", "--check", "missing.hash", says="missing.hash")

    def test_names_of_a_stranger(self):
        """A file may name models, looks and environments below its folder or in --allow-path, after resolving links; the contents of other files are
        not shown."""
        os.mkdir(self.folder / "repository")
        os.mkdir(self.folder / "elsewhere")
        (self.folder / "elsewhere" / "secret.look").write_text("token-1234 x\n")
        self.good("teapot", "-s", 32, "-o", "elsewhere/sky.png", "-q")
        shutil.copy(self.folder / "cube.stl", self.folder / "elsewhere")
        (self.folder / "repository" / "own.look").write_text("environment elsewhere/sky.png\n")
        (self.folder / "elsewhere" / "scene.json").write_text('{"lambent": 1, "objects": [{"file": "cube.stl"}]}')
        (self.folder / "repository" / "scene.json").write_text('{"lambent": 1, "objects": [{"file": "../elsewhere/cube.stl"}]}')
        os.symlink("../elsewhere/cube.stl", self.folder / "repository" / "link.stl")
        self.given |= self.new_files()
        version, options = self.good("--version").stdout.decode().split()[1], self.folder / "repository" / "p.hash"

        def file(line, name):
            options.write_text(f"lambent hashes 1\nversion {version}\noptions{line}\npixels:0123456789abcdef  {name}\n")

        outside = "which is not below the folder of this file; --allow-path allows it"
        look = self.folder / "elsewhere" / "secret.look"
        for line in (" --look ../elsewhere/secret.look", f" --look {look}", f" --look={look}", " --look own.look", " --environment ../elsewhere/sky.png"):
            file(line, "teapot")
            done = self.bad(2, "hash", "--check", "repository/p.hash", says=":3: found ")
            self.assertNotIn(b"1234", done.stderr)
            self.assertTrue(outside.encode() in done.stderr or "=" in line, done.stderr)
        for name in ("../elsewhere/cube.stl", str(self.folder / "elsewhere/cube.stl"), "link.stl", "../elsewhere/scene.json"):
            file("", name)
            self.bad(2, "hash", "--check", "repository/p.hash", says=outside)
            self.check("--check", "repository/p.hash", "--allow-path", "elsewhere", code=6)
        file("", "scene.json")  # a file of hashes does not allow reading it anywhere
        done = self.run_program("hash", "--check", "repository/p.hash", "--sandbox", "off")
        self.assertEqual(done.returncode, 7, done.stderr)
        self.check("--check", "repository/p.hash", "--allow-path", "elsewhere", code=6)

    def test_files_that_are_none(self):
        """A pipe, a device and a huge file are refused immediately; a list that exceeds the memory limit is an error."""
        os.mkfifo(self.folder / "pipe")
        os.symlink("/dev/zero", self.folder / "zero")
        with open(self.folder / "huge", "wb") as huge:
            huge.truncate((64 << 20) + 1)
        self.given.update(("pipe", "zero", "huge"))
        for name, says in (("pipe", "not a regular file"), ("zero", "not a regular file"), ("m", "not a regular file"), ("huge", "has more than 64 MiB")):
            self.bad(2, "hash", "--check", name, says=says)
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        done = subprocess.run([PROGRAM, "hash", "@/dev/zero", "-o", "-"], capture_output=True, preexec_fn=limit)
        self.assertEqual((done.returncode, done.stdout), (4, b""), done.stderr)

    def test_links(self):
        """Links below the folder of --pictures, and links with the name of the sheet, are not followed."""
        os.makedirs(self.folder / "pics")
        os.mkdir(self.folder / "elsewhere")
        os.symlink("../elsewhere", self.folder / "pics" / "m")
        self.given.update(("pics", "elsewhere", "p.hash", "p-changes.png", "theirs.png"))
        for sandbox in ("auto", "off"):
            self.bad(7, "hash", "m/a.stl", "-s", 16, "-o", "p.hash", "--pictures", "pics", "--sandbox", sandbox, says="a link that leads out of the folder")
            self.assertEqual(os.listdir(self.folder / "elsewhere"), [])
        self.write("-q")
        self.grow()
        self.good("teapot", "-s", 16, "-o", "theirs.png", "-q")
        before = (self.folder / "theirs.png").read_bytes()
        os.symlink("theirs.png", self.folder / "p-changes.png")
        for sandbox in ("auto", "off"):
            self.bad(5, "hash", "-s", 64, "--check", "p.hash", "--update", "--sandbox", sandbox, says=["p-changes.png: cannot write", "link"])
            self.assertEqual((self.folder / "theirs.png").read_bytes(), before)

    def test_printed_names(self):
        """A name is printed on one line, without characters that control a terminal or change the text direction."""
        self.write("-q")
        for name in ("a\n::error::x\t.stl", "b\x1b[2J\u009b\u202ey\\.stl"):
            shutil.copy(self.folder / "cube.stl", self.folder / "m" / name)
        printed = ["new      m/a\\n::error::x?.stl", "new      m/b?[2J?<U+202E>y\\\\.stl"]
        self.assertEqual(self.check("m", "teapot", "-s", 64, "--check", "p.hash", code=6)[:2], printed)
        os.mkdir(self.folder / "empty")
        done = self.run_program("diff", "empty", "m", "-s", 16, "-o", "page.html")
        lines = done.stdout.decode().splitlines()
        self.assertEqual([lines[0], lines[2]], [line.replace("new  ", "added").replace("m/", "") for line in printed])
        page = (self.folder / "page.html").read_text()
        self.assertIn("Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\"", page)
        self.assertFalse(set(page) & set("\x1b\u009b\u202e"))

    def test_command_line(self):
        for words, says in ((["m"], "expected either -o FILE"), (["m", "-o", "p", "--check", "p"], "expected either"), (["-o", "p.hash"], "no model"),
                            (["m", "-o", "p.hash", "--update"], "--check FILE"), (["m", "-o", "p/"], "expected a file"),
                            (["m", "-o", "p.hash", "--device", "gl"], "CPU device"), (["m", "m/a.stl", "-o", "p.hash"], "given twice"),
                            (["m", "-o", "p.hash", "--resume"], "does not apply"), (["m", "-o", "p.hash", "--turntable", "4"], "does not apply")):
            self.bad(1, "hash", *words, says=says)
        self.bad(5, "hash", "m", "-o", "no/where/p.hash", says="no/where")
        out = self.good("hash", "m/a.stl", "-s", 8, "-o", "-").stdout.decode().splitlines()
        self.assertEqual((out[0], out[3][24:]), ("lambent hashes 1", " m/a.stl"))
