# test_output.py: the paths of pictures, overwriting, the contents of the streams, and the report.
import json
import os
import pty
import random
import resource
import select
import shutil
import signal
import subprocess
import time
import unittest

from harness import PROGRAM, SHARED_MODELS, Case, check_report, read_png, wait_until_caught


class Names(Case):
    def test_names_with_escape_sequences(self):
        """Control characters are printed as question marks."""
        os.rename(self.folder / "cube.obj", self.folder / "\x1b[31mred.obj")
        done = self.good("\x1b[31mred.obj", "-s", 8)
        self.given.update({"\x1b[31mred.obj", "\x1b[31mred.png"})
        self.assertNotIn(b"\x1b", done.stdout + done.stderr)
        self.assertIn(b"?[31mred.png", done.stdout + done.stderr)

    def test_name_of_the_model(self):
        (self.folder / "sub").mkdir()
        for name in ("sub/odd.name.OBJ", "sub/none", "sub/.hidden"):
            shutil.copy(self.folder / "cube.obj", self.folder / name)
        shutil.copy(self.folder / "cube.mtl", self.folder / "sub")
        self.given.add("sub")
        self.good("cube.obj", "-s", 16)
        for name in ("sub/odd.name.OBJ", "sub/none", "sub/.hidden"):
            self.good(name, "-s", 16)
        self.assertEqual(self.new_files(), {"cube.png", "odd.name.png", "none.png", ".hidden.png"})

    def test_standard_input(self):
        for model in ("cube.obj", "cube.stl", "cube.ply"):
            data = (self.folder / model).read_bytes()
            report = self.report("-", "-s", 16, stdin=data)
            self.assertEqual(report["model"]["format"], model[-3:])
            self.assertEqual(report["image"]["path"], "model.png")
        self.assertEqual(self.new_files(), {"model.png"})

    def test_own_picture_is_replaced(self):
        self.good("cube.obj", "-s", 16)
        self.good("cube.obj", "-s", 24)
        self.assertEqual(read_png((self.folder / "cube.png").read_bytes())[0], 24)

    def test_foreign_file_stays(self):
        for content in (b"", b"precious", b"\x89PNG\r\n\x1a\n" + b"x" * 600):
            (self.folder / "cube.png").write_bytes(content)
            self.bad(5, "cube.obj", "-s", 16, says=["cube.png", "-o"], leaves={"cube.png"})
            self.assertEqual((self.folder / "cube.png").read_bytes(), content)

    def test_named_file_is_replaced(self):
        (self.folder / "cube.png").write_bytes(b"precious")
        self.good("cube.obj", "-s", 16, "-o", "cube.png")
        read_png((self.folder / "cube.png").read_bytes())

    def test_files_of_the_model_stay(self):
        """No command replaces a file that it reads: the model, files that it refers to, or a compared picture."""
        self.good("cube.obj", "-s", 8, "-o", "skin.png", "-q")
        (self.folder / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
        (self.folder / "skin.obj").write_text("mtllib skin.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        (self.folder / "s.json").write_text(json.dumps({"lambent": 1, "objects": [{"file": "skin.obj"}]}))
        self.good("cube.obj", "-s", 8, "-o", "other.png", "-q")
        self.given.update({"skin.png", "skin.mtl", "skin.obj", "s.json", "other.png"})
        kept = {name: (self.folder / name).read_bytes() for name in self.given}
        for words in (["skin.obj", "-s", 8, "-o", "skin.png"], ["skin.obj", "-s", 8, "-o", "x.png", "--save-scene", "skin.mtl"], ["convert", "skin.obj", "skin.obj"],
                      ["convert", "s.json", "skin.obj"], ["diff", "skin.png", "other.png", "-o", "other.png"], ["hash", "skin.obj", "-o", "skin.mtl"]):
            done = self.run_program(*words)
            self.assertNotEqual(done.returncode, 0, words)
            self.assertRegex(done.stderr, b"would replace|same file", words)
            self.assertEqual(kept, {name: (self.folder / name).read_bytes() for name in kept}, words)
        self.good("s.json", "-s", 8, "-o", "x.png", "--save-scene", "s.json", "-q")  # a scene file may be overwritten

    def test_link_is_written_through_or_replaced_whole(self):
        os.symlink("target.png", self.folder / "out.png")
        self.good("cube.obj", "-s", 16, "-o", "out.png")
        read_png((self.folder / "out.png").read_bytes())

    def test_shape_before_file(self):
        shutil.copy(self.folder / "cube.obj", self.folder / "teapot")
        self.assertEqual(self.report("teapot", "-s", 16)["model"]["format"], "shape")
        self.assertEqual(self.report("./teapot", "-s", 16)["model"]["format"], "obj")

    def test_folder(self):
        for folder in ("out", "other"):
            (self.folder / folder).mkdir()
            self.given.add(folder)
        shutil.copy(self.folder / "cube.stl", self.folder / "other" / "second.stl")
        self.good("cube.obj", "other/second.stl", "-s", 16, "-o", "out/")
        self.assertEqual(self.new_files(), set())
        self.assertEqual(set(os.listdir(self.folder / "out")), {"cube.png", "second.png"})
        (self.folder / "out" / "cube.png").write_bytes(b"precious")
        self.bad(5, "cube.obj", "-s", 16, "-o", "out/", says=["out/cube.png", "-o"])
        self.bad(1, "cube.obj", "cube.stl", "-o", "out/", says="would both be written to 'out/cube.png'")

    def test_missing_folder_is_made(self):
        """Every command that writes files creates a folder given with a trailing slash, as soon as there is something to write."""
        (self.folder / "one.png").write_bytes(self.good("cube.obj", "-s", 16, "-o", "-", "-q").stdout)
        data = (self.folder / "cube.obj").read_bytes()
        for words, names in ((("cube.obj", "-s", 16), {"cube.png"}), (("teapot", "./cube.obj", "-s", 16), {"teapot.png", "cube.png"}),
                             (("-", "-s", 16), {"model.png"}), (("compare", "cube.obj", "-s", 16, "--no-captions"), {"cube-summary.png"}),
                             (("materials", "-s", 64, "--no-captions"), {"materials.png"}),
                             (("plot", "spot", "-s", 64, "--no-captions"), {"spot.png"}),
                             (("shader", "cube.obj", "--host", "c"), {"cube.vert", "cube.frag", "cube.c"}),
                             (("diff", "one.png", "one.png"), {"one-difference.png"})):
            with self.subTest(words[0]):
                for _ in range(2):  # a file written by lambent is replaced
                    self.good(*words, "-o", "deep/new/", stdin=data)
                    self.assertEqual(set(os.listdir(self.folder / "deep" / "new")), names)
                shutil.rmtree(self.folder / "deep")
        self.bad(1, "cube.obj", "cube.stl", "-o", "deep/new/", says="would both be written")
        self.bad(2, "missing.obj", "-o", "deep/new/", says="missing.obj")
        self.bad(5, "cube.obj", "-o", "deep/x.png", says="deep")  # the folder of a named picture may be a typing mistake
        self.bad(1, "cube.obj", "torus", "-o", "deep", says="name a folder, -o pictures/")
        self.good("-q", "cube.obj", "-o", "deep")  # without an extension, it is a PNG, as thumbnailers name it
        self.assertEqual((self.folder / "deep").read_bytes(), self.good("cube.obj", "-o", "-").stdout)
        self.good("-q", "cube.obj", "-s", 32, "--turntable", 2, "-o", "deep")
        self.assertIn(b"acTL", (self.folder / "deep").read_bytes())
        self.good("-q", "compare", "cube.obj", "--sheet", "stages", "-s", 16, "-o", "deep")
        os.remove(self.folder / "deep")
        self.bad(5, "cube.obj", "-o", "cube.mtl/", says="'cube.mtl' is not a folder")
        self.bad(5, "cube.obj", "-o", "cube.mtl/in/", says="cube.mtl/in")
        user = self.plain_user()
        if user:
            self.bad(5, "cube.obj", "-o", "deep/new/", says="deep/new/cube.png", user=user)

    def test_several_models(self):
        shutil.copy(self.folder / "cube.stl", self.folder / "second.stl")
        (self.folder / "broken.ply").write_bytes(b"ply\nformat ascii 1.0\n")
        self.given |= {"second.stl", "broken.ply"}
        done = self.run_program("cube.obj", "broken.ply", "missing.obj", "second.stl", "-s", 16, "--json")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.new_files(), {"cube.png", "second.png"})
        reports = [json.loads(line) for line in done.stdout.splitlines()]
        for report in reports:
            check_report(self, report)
        self.assertEqual([r["error"] and r["error"]["exit"] for r in reports], [None, 2, 2, None])
        self.assertEqual([r["model"]["path"] for r in reports], ["cube.obj", "broken.ply", "missing.obj", "second.stl"])
        text = done.stderr.decode()
        self.assertIn("broken.ply", text)
        self.assertIn("missing.obj", text)


class Patterns(Case):
    """Names of pictures with patterns in braces."""

    def names(self):
        return {os.path.relpath(os.path.join(path, name), self.folder)
                for path, _, names in os.walk(self.folder) for name in names if name.endswith((".png", ".ppm"))}

    def setUp(self):
        super().setUp()
        for folder in ("a", "b/deep"):
            (self.folder / folder).mkdir(parents=True)
            shutil.copy(self.folder / "cube.stl", self.folder / folder)

    def test_words(self):
        self.good("a/cube.stl", "b/deep/cube.stl", "-s", "24x16", "--view", "left", "-o", "out/{dir}/{stem}-{view}-{size}.png")
        self.assertEqual(self.names(), {"out/a/cube-left-24x16.png", "out/b/deep/cube-left-24x16.png"})
        self.assertEqual(read_png((self.folder / "out/a/cube-left-24x16.png").read_bytes())[:2], (24, 16))
        self.good("a/cube.stl", "-s", 16, "-o", "{stem}.{size}.{view}.ppm")
        self.assertIn("cube.16.three-quarter.ppm", self.names())
        self.good("a/cube.stl", "cube.obj", "-s", 16, "-o", "{stem}-{ext}.png")
        self.assertLessEqual({"cube-stl.png", "cube-obj.png"}, self.names())
        self.good("a/cube.stl", "-s", 16, "-o", "{{{stem}}}.png")
        self.assertIn("{cube}.png", self.names())
        self.good("-", "-s", 16, "-o", "{dir}/in-{stem}.png", stdin=(self.folder / "cube.stl").read_bytes())
        self.assertIn("in-model.png", self.names())  # not /in-model.png, because the folder is empty

    def test_the_folder_stays_below(self):
        for model in ("./a/../a/./cube.stl", self.folder / "a" / "cube.stl", "../" + self.folder.name + "/a/cube.stl"):
            self.good(model, "-s", 16, "-o", "out/{dir}/{stem}.png")
        below = str(self.folder).strip("/")
        self.assertEqual(self.names(), {"out/a/a/cube.png", "out/" + below + "/a/cube.png",
                                        "out/" + self.folder.name + "/a/cube.png"})

    def test_pictures_are_replaced(self):
        (self.folder / "cube.png").write_bytes(b"not ours")
        self.good("cube.obj", "-s", 16, "-o", "{stem}.png")
        read_png((self.folder / "cube.png").read_bytes())

    def test_mistakes(self):
        for pattern, says in (("{name}.png", "found '{name}' in the name, expected one of {stem}, {ext}, {dir}, {view}, {azimuth}, {show}, {size};"),
                              ("{frame}.png", "found '{frame}'"), ("{stem.png", "'{stem.png' in the name, an unmatched brace"),
                              ("stem}.png", "'}.png' in the name, an unmatched brace"), ("{}.png", "found '{}'"),
                              ("{a{b}}.png", "an unmatched brace")):
            self.bad(1, "cube.obj", "-o", pattern, says=[says, "option '--output'"])
        self.bad(1, "a/cube.stl", "b/deep/cube.stl", "-o", "{stem}.png",
                 says=["'a/cube.stl' and 'b/deep/cube.stl' would both be written to 'cube.png'", "{dir}"])
        self.bad(3, "cube.obj", "-o", "{stem}.tif", says="tif")


class Streams(Case):
    def test_quiet_and_plain(self):
        done = self.good("cube.obj", "-s", 16)
        self.assertEqual(done.stdout, b"")
        self.assertRegex(done.stderr.decode(), r"^cube\.png  16x16  12 triangles  [\d.]+ ms\n$")
        done = self.good("cube.obj", "-s", 16, "-q")
        self.assertEqual((done.stdout, done.stderr), (b"", b""))

    def test_verbose(self):
        done = self.good("cube.obj", "-s", 16, "-v")
        self.assertEqual(done.stdout, b"")
        text = done.stderr.decode()
        for word in ("model    cube.obj (obj), 12 triangles", "camera", "device   cpu", "read", "prepare", "frame",
                     "vertices", "tiles", "lighting", "encode", "total"):
            self.assertIn(word, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 160)

    def test_picture_on_standard_output(self):
        done = self.good("cube.obj", "-s", 16, "-o", "-")
        self.assertEqual(read_png(done.stdout)[:2], (16, 16))
        self.assertEqual(self.new_files(), set())
        self.good("cube.obj", "-s", 16, "-o", "same.png")
        self.assertEqual((self.folder / "same.png").read_bytes(), done.stdout)

    def test_one_text_on_each_stream(self):
        """With --json and -o -, every command writes the file to standard output, and one line of JSON to standard error."""
        self.good("cube.obj", "-s", 8, "-o", "a.png", "-q")
        for command, begins in ((["cube.obj", "-s", 8], b"\x89PNG"), (["compare", "cube.obj", "-s", "64x64", "--no-captions"], b"\x89PNG"),
                                (["materials", "-s", 64], b"\x89PNG"), (["plot", "highlight", "10", "--no-captions"], b"\x89PNG"), (["diff", "a.png", "a.png"], b"\x89PNG"),
                                (["hash", "cube.obj", "-s", 8], b"lambent hashes 1\n"), (["diff", "cube.obj", "cube.stl", "-s", 8], b"<!DOCTYPE")):
            done = self.run_program(*command, "--json", "-o", "-")
            with self.subTest(command=command):
                self.assertIn(done.returncode, (0, 6))
                self.assertTrue(done.stdout.startswith(begins), done.stdout[:80])
                self.assertNotIn(b"\n{", done.stdout)
                self.assertIsInstance(json.loads(done.stderr), dict)
        for command in (["explain", "cube.obj", "2,2", "-s", 8], ["journal", "."]):
            self.bad_report(1, *command)

    def bad_report(self, code, *command):
        done = self.run_program(*command, "--json", "-o", "-")
        self.assertEqual((done.returncode, done.stdout), (code, b""))
        self.assertIn("both write to standard output", json.loads(done.stderr)["error"]["text"])

    def test_report_moves_when_the_picture_takes_standard_output(self):
        done = self.good("cube.obj", "-s", 16, "-o", "-", "--json", "-v")
        read_png(done.stdout)
        report = json.loads(done.stderr)  # and nothing else
        check_report(self, report)
        self.assertEqual((report["image"]["path"], report["image"]["bytes"]), ("-", len(done.stdout)))
        done = self.run_program("missing.obj", "-o", "-", "--json")
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertEqual(json.loads(done.stderr)["error"]["exit"], 2)
        done = self.run_program("--nonsense", "-o", "-", "--json")
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertEqual(json.loads(done.stderr)["error"]["code"], "usage")

    def test_no_colors_without_a_terminal(self):
        for env in ({"TERM": "xterm"}, {"TERM": "xterm", "NO_COLOR": "1"}):
            self.assertNotIn(b"\033", self.run_program("missing.obj", env=env).stderr)

    def on_terminal(self, *words, env):
        """The program's output if its standard error is a terminal."""
        mine, its = pty.openpty()
        process = subprocess.Popen([PROGRAM, *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=its, env={**os.environ, **env})
        os.close(its)
        text = b""
        while True:
            try:
                part = os.read(mine, 65536)
            except OSError:
                break
            if not part:
                break
            text += part
        process.wait(60)
        os.close(mine)
        return process.returncode, text

    def test_colors_on_a_terminal(self):
        for env, colored in (({"TERM": "xterm", "NO_COLOR": ""}, True), ({"TERM": "xterm", "NO_COLOR": "1"}, False),
                             ({"TERM": "dumb", "NO_COLOR": ""}, False)):
            code, text = self.on_terminal("missing.obj", env=env)
            self.assertEqual(code, 2)
            self.assertEqual(b"\033[" in text, colored, env)

    def test_progress_bar(self):
        slow = ("teapot", "-s", 512, "--repeat", 100000, "--time-limit", 1.5)  # still working after half a second
        code, text = self.on_terminal(*slow, env={"TERM": "xterm", "NO_COLOR": ""})
        self.assertEqual(code, 4)
        self.assertIn(b"[#" if b"[#" in text else b"[....", text)
        self.assertIn(b" %", text)
        self.assertIn(b"\r\033[K", text)
        for env, words in (({"TERM": "dumb"}, slow), ({"TERM": "xterm"}, (*slow, "-q")),
                           ({"TERM": "xterm"}, ("teapot", "-s", 64))):
            self.assertNotIn(b"[K", self.on_terminal(*words, env=env)[1])

    def test_binary_never_goes_to_a_terminal(self):
        mine, its = pty.openpty()
        done = self.run_program("cube.obj", "-o", "-", stdout=its)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"terminal", done.stderr)
        self.assertEqual(select.select([mine], [], [], 0)[0], [])
        done = self.run_program("-", stdin=os.fdopen(its, "rb", closefd=False))
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"terminal", done.stderr)
        os.close(mine)
        os.close(its)


class Report(Case):
    def test_cube(self):
        report = self.report("cube.obj", "-s", "64x32", "--samples", 8, "-j", 2)
        model = report["model"]
        self.assertEqual(model, {"path": "cube.obj", "format": "obj", "triangles": 12, "lines": 0, "points": 0, "vertices": 8, "meshes":
                                 model["meshes"], "objects": model["objects"], "materials": model["materials"],
                                 "lights": 0, "up": "y", "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}})
        self.assertGreaterEqual(model["materials"], 2)
        self.assertEqual(report["image"], {"path": "cube.png", "format": "png", "width": 64, "height": 32, "samples": 8,
                                           "bytes": (self.folder / "cube.png").stat().st_size, "exposure_stops": 0,
                                           "exposure": "literal"})
        self.assertEqual(report["device"]["threads"], 2)
        times = report["times_ms"]
        self.assertLessEqual(sum(times[k] for k in ("read", "prepare", "camera", "frame", "encode")),
                             times["total"] + 0.01)
        steps = times["steps"]
        self.assertLessEqual(steps["flatten"] + steps["vertices"] + steps["triangles"] + steps["tiles"],
                             times["frame"] + 0.01)
        self.assertEqual(report["counts"]["triangles"], 12)
        self.assertGreater(report["counts"]["pixels_covered"], 100)

    def test_version_agrees(self):
        report = self.report("cube.obj", "-s", 16)
        self.assertEqual(self.good("--version").stdout.decode().split()[1], report["lambent"])

    def test_dry_run(self):
        """Prints what would be written, and writes nothing; it also reports the errors of drawing."""
        words = ("cube.obj", "-s", "40x30", "--samples", 2, "--light", "point:position=1/2/3", "--light", "ambient", "-b", "#fff", "--dry-run")
        text = self.good(*words, "-o", "a.jpg").stdout.decode()
        for part in ("cube.obj\n", "obj, 12 triangles", "a.jpg, jpg, 40x30, 2 samples per pixel\n", "camera    eye ", "device    cpu",
                     "--size 40x30 --samples 2 --background '#fff' --light point:position=1/2/3 --light ambient"):
            self.assertIn(part, text)
        self.assertNotIn("--dry-run", text)
        self.good(*words, "--save-scene", "s.json", "-q")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), sorted({"cube.obj", *self.given}))
        (self.folder / "a.png").write_bytes(b"old")
        self.assertIn(b"a.png, png, 40x30, 2 samples per pixel; replaces the file", self.good(*words, "-o", "a.png").stdout)
        self.assertEqual((self.folder / "a.png").read_bytes(), b"old")
        report = json.loads(self.good(*words, "-o", "a.png", "--json").stdout)
        check_report(self, report)
        self.assertEqual({k: v for k, v in report["planned"].items() if k != "options"},
                         {"path": "a.png", "format": "png", "width": 40, "height": 30, "samples": 2, "replaces": True})
        self.assertIn({"name": "light", "value": "ambient"}, report["planned"]["options"])
        self.assertIn({"name": "dry-run", "value": None}, report["planned"]["options"])
        # A scene file's own settings are used.
        (self.folder / "s.json").write_text(json.dumps({"lambent": 1, "image": {"size": [33, 22]}, "objects": [{"shape": "cube"}]}))
        self.assertIn(b"png, 33x22, ", self.good("s.json", "--dry-run", "-o", "s.png").stdout)
        self.assertFalse((self.folder / "s.png").exists())
        (self.folder / "cube.png").write_bytes(b"not ours")
        for more, code in (((), 5), (("-o", "a.tif"), 3), (("-o", "cube.obj/a.png"), 5)):
            drawn, planned = self.run_program("cube.obj", *more), self.run_program("cube.obj", "--dry-run", *more)
            self.assertEqual((drawn.returncode, drawn.stderr), (code, planned.stderr))
            self.assertEqual(planned.returncode, code)
        self.assertEqual(self.run_program("missing.obj", "--dry-run").returncode, 2)
        for command in (("explain", "teapot", "1,1"), ("shader", "teapot")):
            self.bad(1, *command, "--dry-run", says="dry-run")

    def test_errors_are_reported(self):
        for words, code, name in ((("missing.obj",), 2, "cannot-read"), (("cube.obj", "-o", "x.tif"), 3, "unsupported"),
                                  (("cube.obj", "--memory-limit", "1k"), 4, "limit"),
                                  (("cube.obj", "-o", "no/x.png"), 5, "cannot-write"), (("--size", "x"), 1, "usage")):
            done = self.run_program(*words, "--json")
            report = json.loads(done.stdout)
            check_report(self, report)
            self.assertEqual((done.returncode, report["error"]["exit"], report["error"]["code"]), (code, code, name))
            self.assertIn(report["error"]["text"], done.stderr.decode())

    def test_strange_names(self):
        for name in (b"caf\xc3\xa9.obj", b"caf\xe9.obj", b'q"\\\x01.obj'):
            path = os.path.join(os.fsencode(self.folder), name)
            shutil.copy(self.folder / "cube.obj", path)
            report = self.report(os.fsdecode(name), "-s", 16)
            wanted = name.decode("utf-8", "replace")
            self.assertEqual(report["model"]["path"], wanted)

    def test_locale_changes_nothing(self):
        plain = self.report("cube.obj", "-s", 16, "--azimuth", "12.5")
        for locale in ("de_DE.UTF-8", "C", "tr_TR.UTF-8"):
            other = self.report("cube.obj", "-s", 16, "--azimuth", "12.5", env={"LC_ALL": locale, "LANG": locale})
            self.assertEqual((other["camera"], other["model"]), (plain["camera"], plain["model"]))

    def test_warnings(self):
        (self.folder / "lost.obj").write_text("mtllib lost.mtl\n" + (self.folder / "cube.obj").read_text().split("\n", 2)[2])
        done = self.good("lost.obj", "-s", 16)
        text = done.stderr.decode()
        self.assertIn("lambent: warning: ", text)
        self.assertEqual(text.count("lost.mtl"), 1)
        self.assertEqual(self.good("lost.obj", "-s", 16, "-q").stderr, b"")
        report = self.report("lost.obj", "-s", 16)
        self.assertTrue(any("lost.mtl" in w for w in report["warnings"]))


class Interrupt(Case):
    def test_control_c(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([PROGRAM, "teapot", "-s", "1024", "--repeat", "100000"], cwd=self.folder,
                                  stderr=subprocess.PIPE, stdout=subprocess.PIPE) as process:
                wait_until_caught(process, number)
                time.sleep(0.1)
                process.send_signal(number)
                sent = time.monotonic()
                _, text = process.communicate(timeout=20)
                self.assertLess(time.monotonic() - sent, 15)
            # The signal ends the program: a shell reports 128 + number, and stops its loop.
            self.assertEqual(process.returncode, -number)
            self.assertEqual(text, b"lambent: teapot: interrupted\n")
            self.assertEqual(self.new_files(), set())

    def test_exit_code_in_a_shell(self):
        script = f'"{PROGRAM}" teapot -q -s 1024 --repeat 100000 & sleep 1; kill -TERM $!; wait $!; echo $?'
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, timeout=30)
        self.assertEqual(done.stdout, b"143\n")

    def test_standard_input_can_be_interrupted(self):
        read, write = os.pipe()
        with subprocess.Popen([PROGRAM, "-"], cwd=self.folder, stdin=read, stderr=subprocess.PIPE) as process:
            wait_until_caught(process, signal.SIGINT)
            time.sleep(0.1)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=30)
        os.close(read)
        os.close(write)
        self.assertEqual(process.returncode, -signal.SIGINT)


class RealModels(Case):
    @unittest.skipUnless(SHARED_MODELS.is_dir(), f"no models at {SHARED_MODELS}")
    def test_one_of_each_format(self):
        for ending in ("obj", "stl", "ply"):
            model = min(SHARED_MODELS.glob(f"{ending}/**/*.{ending}"), key=lambda p: (p.stat().st_size < 50000, p.stat().st_size))
            with self.subTest(model.name):
                report = self.report(model, "-s", 128)
                self.assertEqual(report["model"]["format"], ending)
                self.assertGreater(report["counts"]["pixels_covered"], 500)


NO_UNNAMED_FILES = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/types.h>
#include <unistd.h>

// As on a file system without unnamed files.
int openat64(int folder, const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    mode_t mode = va_arg(more, mode_t);
    va_end(more);
    if ((flags & O_TMPFILE) == O_TMPFILE) {
        if (write(2, "refused\\n", 8) != 8)
            return -1;
        errno = EOPNOTSUPP;
        return -1;
    }
    return ((int (*)(int, const char *, int, mode_t))dlsym(RTLD_NEXT, "openat64"))(folder, path, flags, mode);
}
"""


class Killed(Case):
    """Whenever the program ends while it reads, draws or writes, its folder contains the complete picture or nothing new."""

    def setUp(self):
        super().setUp()
        self.words = [PROGRAM, "teapot", "-s", "700", "-q", "-o", "x.png"]
        # A sanitizer's own handlers allocate memory, so they may never end in the middle of an
        # allocation.
        own = "".join(f":handle_{name}=0" for name in ("segv", "sigbus", "sigill", "sigfpe", "abort", "sigtrap"))
        self.env = dict(os.environ, ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + own)

    def kill(self, number, delay):
        process = subprocess.Popen(self.words, cwd=self.folder, stderr=subprocess.DEVNULL, env=self.env)
        try:
            process.wait(delay)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
        process.wait(60)
        return process.returncode

    def kill_with_all(self, numbers):
        start = time.monotonic()
        subprocess.run(self.words, cwd=self.folder, check=True, env=self.env, stderr=subprocess.DEVNULL)
        length, whole = time.monotonic() - start, (self.folder / "x.png").read_bytes()
        chance = random.Random(11)
        ended = 0
        for number in numbers:
            for old in (False, True):
                if not old:
                    (self.folder / "x.png").unlink(missing_ok=True)
                elif not (self.folder / "x.png").exists():
                    (self.folder / "x.png").write_bytes(whole)
                ended += self.kill(number, chance.uniform(0.2, 1) * length) < 0
                # The process that writes may still be about to rename the file.
                patience = time.monotonic() + 5
                while any(name.endswith(".part") for name in self.new_files()) and time.monotonic() < patience:
                    time.sleep(0.01)
                with self.subTest(f"signal {number}"):
                    self.assertLessEqual(self.new_files(), {"x.png"})
                    if "x.png" in self.new_files():
                        self.assertEqual((self.folder / "x.png").read_bytes(), whole)
        return ended

    def catchable(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
        harmless = {signal.SIGKILL, signal.SIGSTOP, signal.SIGTSTP, signal.SIGTTIN, signal.SIGTTOU, signal.SIGCONT, signal.SIGCHLD,
                    signal.SIGURG, signal.SIGWINCH}
        return sorted(signal.valid_signals() - harmless - set(range(signal.SIGRTMIN + 1, signal.SIGRTMAX)))

    def test_signals(self):
        self.assertGreater(self.kill_with_all(self.catchable()), 10)

    def test_kill(self):
        self.assertGreater(self.kill_with_all([signal.SIGKILL] * 15), 5)

    def test_signals_without_unnamed_files(self):
        (self.folder / "refuse.c").write_text(NO_UNNAMED_FILES)
        made = shutil.which("cc") and subprocess.run(["cc", "-shared", "-fPIC", "-o", "refuse.so", "refuse.c", "-ldl"], cwd=self.folder, check=False)
        if not made or made.returncode:
            self.skipTest("no compiler")
        self.given |= {"refuse.c", "refuse.so"}
        self.env["LD_PRELOAD"] = str(self.folder / "refuse.so")
        done = subprocess.run(self.words, cwd=self.folder, capture_output=True, env=self.env)
        if done.returncode:
            self.skipTest("the program does not start with another library")
        self.assertIn(b"refused", done.stderr)
        self.assertGreater(self.kill_with_all(self.catchable()), 10)

    def test_file_size_limit(self):
        """SIGXFSZ with its default action."""
        done = subprocess.run(["bash", "-c", f'ulimit -f 1; exec "{PROGRAM}" teapot -s 512 -o x.png'], cwd=self.folder,
                              capture_output=True, timeout=30)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn(b"x.png: cannot write: File too large", done.stderr)
        self.assertEqual(self.new_files(), set())
        for words in (("plot", "spot", "-o", "x.svg"), ("shader", "teapot", "-o", "x"), ("teapot", "--save-scene", "x.json", "-s", "8", "-o", "-")):
            limit = f'ulimit -f 1; exec "{PROGRAM}" {" ".join(words)} > /dev/null'
            done = subprocess.run(["bash", "-c", limit], cwd=self.folder, capture_output=True, timeout=30)
            self.assertIn(done.returncode, (0, 5), (words, done.stderr))  # 0 because the file is small
            self.assertFalse([n for n in self.new_files() if "part" in n or n.startswith(".")])
