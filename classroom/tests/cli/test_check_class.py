# test_check_class.py: `lambent check --class`: a folder of submissions, points in a CSV file, and a page with the pictures.
import csv
import json
import os
import re
import shutil
import subprocess

from harness import PROGRAM, check_value, read_png
import test_check
from test_check import SCHEMA, CheckTest, edited

GATE = ("frag", "dot(n, l) <= 0.0", "false")
# Each line uses the previous one three times: a kilobyte of text becomes some ten million
# instructions.
BOMB = "#define A0 x = x * 1.0001 + y;\n" + "".join(f"#define A{i} {f'A{i - 1} ' * 8}\n" for i in range(1, 9))


class Class(CheckTest):
    def write(self, name, shader, edits=(), endings=("frag", "vert")):
        """Writes the files of a submission, name.frag and name.vert."""
        for ending, text in edited(shader, edits).items():
            if ending in endings:
                path = self.folder / "class" / f"{name}.{ending}"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)

    def grade(self, *words, code, folder="class", out="sheets/", csv_file="out/grades.csv", **more):
        done = self.run_program("check", "--class", folder, *(["--csv", csv_file] if csv_file else []), *(["-o", out] if out else []),
                                "-s", 32, "--no-captions", *words, **more)
        self.assertEqual(done.returncode, code, done.stderr.decode() + done.stdout.decode())
        return done

    def grades(self, path="out/grades.csv"):
        with open(self.folder / path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        for row in rows:
            self.assertEqual(len(row), len(rows[0]), row)
        return {row[0]: dict(zip(rows[0], row)) for row in rows[1:]}

    def test_everything(self):
        """An error in one submission affects only that submission, and the report states it."""
        self.write("ann/main", "pittsburgh")
        (self.folder / "class/ann/main.vert").rename(self.folder / "class/ann/other.vert")
        self.write("bob/phong", "pittsburgh", [GATE])
        self.write("cem/deep/down/phong", "pittsburgh", [("frag", "pow(", "pwo(")])
        self.write("dee/a", "pittsburgh")
        self.write("dee/b", "pittsburgh", [GATE])
        (self.folder / "class/eve").mkdir()
        (self.folder / "class/eve/report.txt").write_text("my shader is on my other laptop\n")
        self.write("fay/phong", "pittsburgh", [("frag", "vec3 n = normalize(N);", test_check.Unruly.LOOP)])
        self.write("gil/phong", "pittsburgh", [("frag", "vec3 n = normalize(N);", "float x = shininess, y = x; A8 vec3 n = normalize(N) + 1e-5 * x;")])
        text = (self.folder / "class/gil/phong.frag").read_text()
        (self.folder / "class/gil/phong.frag").write_text(BOMB + text)
        (self.folder / "class/hal").mkdir()
        (self.folder / "class/hal/phong.frag").write_bytes(b"void main() { \0 }")
        self.write("=ida", "pittsburgh", [("frag", "vec3 n = normalize(N);", "vec3 n = N;")])
        self.write("<i>jo, \"kim\" & co", "pittsburgh")
        (self.folder / "class/__MACOSX").mkdir()
        (self.folder / "class/__MACOSX/._phong.frag").write_text("")
        done = self.grade("--scenes", "all,gate,diffuse", "--json", "--stop-after", 4, code=6)
        reports = {r["submission"]: r for r in map(json.loads, done.stdout.splitlines())}
        names = ["<i>jo, \"kim\" & co", "=ida", "ann", "bob", "cem/deep/down", "dee/a", "dee/b", "eve", "fay", "gil", "hal"]
        self.assertEqual(list(reports), names)
        for report in reports.values():
            check_value(self, report, SCHEMA, "check")
        verdicts = ["passes", "differs", "passes", "differs", "refused", "passes", "differs", None, "endless", "too much memory", None]
        self.assertEqual([r.get("verdict") for r in reports.values()], verdicts)
        self.assertEqual(reports["ann"]["vertex"], "class/ann/other.vert")
        self.assertIn("no shader", reports["eve"]["error"])
        rows = self.grades()
        self.assertEqual(list(rows), [("'" if n[0] == "=" else "") + n for n in names])
        self.assertEqual([r["verdict"] for r in rows.values()], [v or "no verdict" for v in verdicts])
        self.assertEqual([(r["points"], r["of"]) for r in rows.values()],
                         [("3", "3"), ("0", "3"), ("3", "3"), ("2", "3"), ("0", "3"), ("3", "3"), ("2", "3"), ("", ""), ("0", "3"), ("0", "3"), ("", "")])
        self.assertEqual((rows["bob"]["mistakes"], rows["bob"]["scene gate"], rows["bob"]["diffuse"], rows["bob"]["scene spot"]), ("no-gate", "0", "1", ""))
        self.assertIn("pwo", rows["cem/deep/down"]["says"])
        self.assertIn("--memory-limit", rows["gil"]["says"])
        self.check_page(reports)

    def check_page(self, reports):
        page = (self.folder / "sheets/index.html").read_text()
        self.assertIn("&lt;i&gt;jo, &quot;kim&quot; &amp; co", page)
        self.assertNotIn("<i>jo", page)
        rows = re.findall("<tr><th>(.*?)</th>(.*?)</tr>", page, re.S)[1:]
        self.assertEqual(len(rows), len(reports))
        pictures = re.findall('src="([^"]*)"', page)
        self.assertEqual(len(pictures), len([r for r in reports.values() if r.get("scenes")]))
        for report in reports.values():
            if report.get("scenes"):
                width, height = read_png((self.folder / report["picture"]).read_bytes())[:2]
                self.assertGreater(width, 3 * 32)  # the shader's picture, the reference and the difference
                self.assertGreater(height, 3 * 32)
        self.assertIn("write", json.dumps(reports["bob"]))
        self.assertIn("no-gate</b>", dict(rows)["bob"])
        self.assertIn("no shader in this folder", dict(rows)["eve"])

    def test_deep_folders(self):
        """A folder nested below sixteen others is not searched, and Lambent reports this."""
        deepest = "/".join(["ann"] + ["in"] * 15)
        self.write(deepest + "/phong", "pittsburgh")
        self.write(deepest + "/in/phong", "pittsburgh")
        self.grade("--scenes", "gate", code=2)
        rows = self.grades()
        self.assertEqual({name: row["verdict"] for name, row in rows.items()}, {deepest: "passes", deepest + "/in": "no verdict"})
        self.assertIn("too deeply", rows[deepest + "/in"]["says"])

    def test_outputs_that_cannot_be_written(self):
        """The verdicts are available even if the pictures fail."""
        self.write("ann", "pittsburgh")
        self.write("bob", "pittsburgh")
        words = ("--scenes", "gate,all")
        (self.folder / "pre/bob.png").mkdir(parents=True)
        done = self.grade(*words, out="pre", code=5)
        self.assertIn("2 of 2 pass", done.stdout.decode())
        self.assertIn("pre/bob.png", done.stderr.decode())
        self.assertEqual([r["verdict"] for r in self.grades().values()], ["passes"] * 2)
        self.assertTrue((self.folder / "pre/ann.png").exists())
        self.assertIn("bob.png: cannot write", (self.folder / "pre/index.html").read_text())
        (self.folder / "file").write_text("")
        done = self.grade(*words, out="file", code=5)
        self.assertIn("2 of 2 pass", done.stdout.decode())
        self.assertEqual(done.stderr.decode().count("\n"), 1)
        self.assertEqual(len(self.grades()), 2)
        done = self.grade(*words, out="new/folder", csv_file="/dev/full", code=5)
        self.assertIn("/dev/full: cannot write: No space left", done.stderr.decode())
        self.assertIn("2 of 2 pass", done.stdout.decode())
        self.assertEqual(sorted(os.listdir(self.folder / "new/folder")), ["ann.png", "bob.png", "index.html"])
        self.assertEqual(self.grade(*words, out=None, csv_file=None, code=0).stderr, b"")

    def test_threads_change_nothing(self):
        for name, edits in (("a", ()), ("b", [GATE]), ("c", [GATE]), ("d", ()), ("e", [GATE])):
            self.write(name, "pittsburgh", edits)
        words = ("--scenes", "gate,all", "--json")
        one = self.grade(*words, "--threads", 1, out=None, csv_file=None, code=6).stdout
        self.assertEqual(self.grade(*words, "--threads", 3, out=None, csv_file=None, code=6).stdout, one)

    def test_memory_limit(self):
        self.write("ann", "pittsburgh")
        rows = lambda *words, code: self.grade("--scenes", "all", *words, out=None, code=code) and self.grades()  # noqa: E731
        self.assertEqual(rows("--memory-limit", "8Mi", code=6)["ann"]["verdict"], "too much memory")
        self.assertEqual(rows("--memory-limit", "600M", code=0)["ann"]["verdict"], "passes")

    def test_hostile_names(self):
        """A folder's name prints no line of its own, and a spreadsheet evaluates no name."""
        names = {"bob\nann passes": ("bob?ann passes", "bob?ann passes"), "c\x1b[2J\u202e": ("c?[2J<U+202E>", "c?[2J<U+202E>"),
                 " =1+1": (" =1+1", "' =1+1"), "＝1+1": ("＝1+1", "'＝1+1")}
        for name in names:
            self.write(f"{name}/s", "pittsburgh")
        done = self.grade("--scenes", "gate", code=0)
        self.assertEqual({re.split(" {2,}", line)[0] for line in done.stdout.decode().split("\n")[:-2]}, {shown for shown, _ in names.values()})
        self.assertEqual(set(self.grades()), {cell for _, cell in names.values()})
        page = (self.folder / "sheets/index.html").read_text()
        self.assertIn("Content-Security-Policy", page)
        self.assertFalse(set(page) & set("\x1b\u202e"))

    def test_without_proc(self):
        """The test simulates a missing /proc, as in a bare chroot. (Sanitizers read /proc themselves.)"""
        if "LAMBENT_SANITIZED" in os.environ:
            self.skipTest("sanitizers need /proc")
        self.write("ann", "pittsburgh")
        self.write("bob", "pittsburgh", [GATE])
        bare = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs none /proc && test ! -e /proc/self && exec "$@"', "sh"]
        if not shutil.which("unshare") or subprocess.run([*bare, "true"], stderr=subprocess.DEVNULL).returncode:
            self.skipTest("no name space without /proc can be made here")
        words = ["check", "--class", "class", "--scenes", "gate", "-s", "32"]
        there = self.run_program(*words)
        for program, path in ((PROGRAM, None), ("lambent", os.path.dirname(PROGRAM))):
            env = {**os.environ, **({"PATH": path + ":" + os.environ["PATH"]} if path else {})}
            done = subprocess.run([*bare, program, *words], cwd=self.folder, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual((done.returncode, done.stdout), (6, there.stdout), done.stderr)

    def test_bad_use(self):
        self.bad(2, "check", "--class", "none", says="none")
        (self.folder / "empty").mkdir()
        self.bad(1, "check", "--class", "empty", says=("empty", "no submission", ".frag"), leaves=("empty",))
        self.bad(1, "check", "--class", "empty", "x.frag", says=("--class", "x.frag"), leaves=("empty",))
        self.write("ann", "pittsburgh", endings=("vert",))
        done = self.grade(code=2)
        self.assertIn("no fragment shader", done.stderr.decode())
