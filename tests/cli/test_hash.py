# test_hash.py: the command `hash`: files of hashes, what they say about models that change, their sheets; hostile files and names.
import json
import os
import shutil

from harness import Case, read_png
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
        """Another model in place of a.stl."""
        self.good("shape", "torus", "-o", "m/a.stl", "-q")

    def test_file(self):
        self.write()
        version = self.good("--version").stdout.decode().split()[1]
        head, rows = self.lines()[:3], dict(reversed(line.split("  ")) for line in self.lines()[3:])
        self.assertEqual(head, ["lambent hashes 1", f"version {version}", "options --size 64"])
        self.assertEqual(list(rows), ["m/a.stl", "m/sub/cube.obj", "teapot"])
        for name, hashed in rows.items():  # the pixels of the picture that the program writes
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
        self.assertEqual(self.check("--check", "deep/er/q.hash", "-s", 64, code=0), ["2 equal"])

    def test_files_of_options(self):
        """An environment and a look are named relative to the file of hashes, from whichever folder it is checked."""
        (self.folder / "sky").mkdir()
        self.good("teapot", "-s", "64x32", "-b", "#336699", "-o", "sky/a b.png", "-q")
        (self.folder / "sky" / "own.look").write_text("--ground shadow\n")
        options = ["--environment", "sky/a b.png", "--look", "sky/own.look", "--reflectivity", "0.5", "-s", 32]
        self.good("hash", "m", "-o", "sky/p.hash", *options)
        self.assertEqual(self.lines("sky/p.hash")[2], "options --size 32 --look own.look --environment 'a b.png' --reflectivity 0.5")
        self.assertEqual(self.check("--check", "sky/p.hash", code=0), ["2 equal"])
        self.assertEqual(self.check("--check", self.folder / "sky/p.hash", code=0), ["2 equal"])
        self.assertEqual(self.check("m", "--check", "sky/p.hash", *options, code=0), ["2 equal"])
        os.makedirs(self.folder / "deep" / "er")
        for face in "abcdef":
            self.good("teapot", "-s", "16", "-o", f"sky/{face}.png", "-q")
        self.good("hash", "m", "-o", "deep/er/q.hash", "--environment", ",".join(f"sky/{face}.png" for face in "abcdef"), "-s", 32)
        self.assertIn(",".join(f"../../sky/{face}.png" for face in "abcdef"), self.lines("deep/er/q.hash")[2])
        self.assertEqual(self.check("--check", "deep/er/q.hash", code=0), ["2 equal"])
        self.good("hash", "m", "-o", "deep/er/q.hash", "--environment", "studio", "--look", "catalog", "-s", 32)
        self.assertEqual(self.lines("deep/er/q.hash")[2], "options --size 32 --look catalog --environment studio")
        self.assertEqual(self.check("--check", "deep/er/q.hash", code=0), ["2 equal"])

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
        # A model of the file that is no longer there fails if nothing else says which models there are.
        self.check("-s", 64, "--check", "p.hash", code=7)

    def test_says_first(self):
        """Another version or other options are named before the pictures are drawn."""
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
        """Without options of the picture --check takes those of the file, and none that do anything else."""
        self.good("hash", "m", "teapot", "-o", "p.hash", "-s", 64, "-b", "#fff", "--light", "point:position=1/2/3", "-q")
        self.given.add("p.hash")
        text = (self.folder / "p.hash").read_text()
        self.assertIn("--background '#fff'", text)
        self.assertEqual(self.check("--check", "p.hash", code=0), ["3 equal"])
        head = text.splitlines()[2]
        for line, says in (("options -o evil.png", "expected options that change the picture"), ("options --nope 3", "unknown option '--nope'"),
                           ("options --size 64 '", "expected options that change the picture"), ("options --json", "expected options that change the picture")):
            (self.folder / "p.hash").write_text(text.replace(head, line))
            self.bad(2, "hash", "--check", "p.hash", says=says)

    def test_update_of_some(self):
        """--update of one model keeps the hashes of others that exist, and drops those of files that are gone."""
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
        # A picture that is not the one of the hash is not taken for the old one.
        shutil.copy(self.folder / "kept" / "teapot.png", self.folder / "kept" / "m" / "a.stl.png")
        shutil.copy(self.folder / "cube.stl", self.folder / "m" / "a.stl")
        self.check("-s", 64, "--check", "p.hash", "--update", "--pictures", "kept", code=0)
        width, _, pixels = read_png((self.folder / "p-changes.png").read_bytes())
        self.assertEqual(set(column(2)), {b"\xff\xff\xff"})  # no difference: there is no old picture
        # Nothing changes: no sheet.
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
        (self.folder / "m" / "a.stl").write_text("nonsense")  # a model of the file is not excused
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
        """A folder that cannot be made is said once, before anything is drawn."""
        (self.folder / "file").write_text("")
        self.given.add("file")
        for folder, says in (("file", "found the file 'file', expected a folder"), ("file/x", "cannot make the folder 'file/x': Not a directory")):
            done = self.bad(5, "hash", "m", "-s", 8, "-o", "p.hash", "--pictures", folder, says=says)
            self.assertNotIn(b"failed", done.stderr)
        user = self.plain_user()
        if user:
            os.mkdir(self.folder / "theirs", 0o755)
            self.given.add("theirs")
            self.bad(5, "hash", "m", "-s", 8, "-o", "-", "--pictures", "theirs", says="theirs: cannot write to the folder: Permission denied", user=user)
        self.write()
        self.given.add("p.hash")
        self.check("--check", "p.hash", "--pictures", "file", code=0)  # which writes no pictures

    def test_report_beside_the_file(self):
        """The file on standard output, the report alone on standard error."""
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

    def test_command_line(self):
        for words, says in ((["m"], "expected either -o FILE"), (["m", "-o", "p", "--check", "p"], "expected either"), (["-o", "p.hash"], "no model"),
                            (["m", "-o", "p.hash", "--update"], "--check FILE"), (["m", "-o", "p/"], "expected a file"),
                            (["m", "-o", "p.hash", "--device", "gl"], "CPU device"), (["m", "m/a.stl", "-o", "p.hash"], "given twice"),
                            (["m", "-o", "p.hash", "--resume"], "does not apply"), (["m", "-o", "p.hash", "--turntable", "4"], "does not apply")):
            self.bad(1, "hash", *words, says=says)
        self.bad(5, "hash", "m", "-o", "no/where/p.hash", says="no/where")
        out = self.good("hash", "m/a.stl", "-s", 8, "-o", "-").stdout.decode().splitlines()
        self.assertEqual((out[0], out[3][24:]), ("lambent hashes 1", " m/a.stl"))
