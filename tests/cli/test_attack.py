# test_attack.py: injected code inside the sandbox. attack.c is built here and preloaded into the program. After the sandbox has started, the code
# makes about 150 system calls from the main thread, from a new thread and from a thread of the program. None of them may succeed, in any command.
import errno
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest
import urllib.request

import test_batch
from harness import OWN_MODELS, PROGRAM, Case

VERSION = subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE).stdout.decode()
LANDLOCK = int((re.search(r"(?m)^sandbox Landlock (\d+) and seccomp$", VERSION) or [0, 0])[1])
# Calls that succeed without a sandbox, for root and for any user; the last ones delete the file.
FREE = ("setaffinity getaffinity getpriority ioprio_get getscheduler sched_getattr getparam limits kill kill-usr1 kill-parent tkill tgkill getpgid getsid "
        "clock F_SETOWN-socket F_SETOWN_EX F_GETOWN F_SETSIG O_ASYNC FIOASYNC FIOSETOWN SIOCSPGRP F_NOTIFY memfd socket unix-socket fork fchmod fchmodat "
        "utimensat futimens ftruncate flock open-write open-empty openat2-empty openat2-setuid make-setuid reopen own-memory link rename "
        "unlink unlink-renamed").split()


def setUpModule():
    global LIBRARY, FOLDER
    if not LANDLOCK:
        raise unittest.SkipTest("this machine or build has no complete sandbox")
    if not shutil.which("cc"):
        raise unittest.SkipTest("no compiler")
    FOLDER = tempfile.TemporaryDirectory(prefix="lambent-attack-")
    LIBRARY = pathlib.Path(FOLDER.name) / "attack.so"
    source = pathlib.Path(__file__).with_name("attack.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", LIBRARY, source, "-ldl", "-lpthread"], check=True)


def tearDownModule():
    FOLDER.cleanup()


class Attack(Case):
    def setUp(self):
        super().setUp()
        self.place = self.folder / "home"
        self.place.mkdir()
        self.victim = self.place / "victim"
        self.victim.write_text("of the user")
        shutil.copy(OWN_MODELS / "cube.obj", self.place)
        self.process = subprocess.Popen(["sh", "-c", "trap '' USR1 USR2; echo; exec sleep 600"], stdout=subprocess.PIPE)
        self.process.stdout.readline()
        self.addCleanup(self.end)
        self.model = open(OWN_MODELS / "cube.stl")  # for "-"
        self.addCleanup(self.model.close)

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def orders(self, **more):
        return {"LD_PRELOAD": str(LIBRARY), "ATTACK_LOG": str(self.folder / "log"), "ATTACK_FOLDER": str(self.place),
                "ATTACK_PROCESS": str(self.process.pid), **{k: str(v) for k, v in more.items()}}

    def state(self):
        about, number = self.victim.stat(), self.process.pid
        return (self.victim.read_text(), about.st_mode, about.st_uid, about.st_mtime_ns, about.st_nlink, os.listxattr(self.victim),
                sorted(os.sched_getaffinity(number)), os.getpriority(os.PRIO_PROCESS, number), os.sched_getscheduler(number),
                pathlib.Path(f"/proc/{number}/limits").read_text(), pathlib.Path(f"/proc/{number}/stat").read_text().split()[4:7])

    def attempts(self):
        """The attempts of each thread: {name: error}."""
        tried = {}
        for line in (self.folder / "log").read_text().splitlines():
            mode, thread, name, error = line.split(" ")
            tried.setdefault((mode, thread), {})[name] = int(error)
        (self.folder / "log").unlink()
        return tried

    def attack(self, *words, threads=("main", "thread"), code=0, more=(), **orders):
        """Runs the program under attack in the folder `home`, which then contains the files `more` in addition to its own."""
        before = self.state()
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.place, stdin=self.model, capture_output=True, timeout=60,
                              env={**os.environ, **self.orders(**orders)})
        self.assertEqual(done.returncode, code, (words, done.stderr.decode()))
        self.check(before, words, threads, ["draws"])
        found = {str(p.relative_to(self.place)) for p in self.place.rglob("*") if p.is_file()}
        self.assertEqual(found - {"victim", "cube.obj"}, set(more), words)
        for path in found:
            self.assertFalse((self.place / path).stat().st_mode & 0o7111, path)
        return done

    def check(self, before, words, threads, modes):
        tried = self.attempts()
        for mode in modes:
            for thread in threads:
                names = tried[mode, thread]
                self.assertGreater(len(names), 100, words)
                # The sandbox causes the failure, or the writer's answer, which is above 1000.
                wrong = [(n, error) for n, error in names.items() if error not in (errno.EPERM, errno.EACCES, errno.ENOSYS) and error < 1000]
                self.assertEqual(wrong, [], (words, mode, thread))
        self.assertEqual(self.state(), before, words)
        self.assertIsNone(self.process.poll())

    def test_without_sandbox(self):
        """The attempts are valid: without the sandbox they succeed."""
        self.run_program("shapes", env=self.orders(ATTACK_NOW=f" {' '.join(FREE)} "))
        tried = self.attempts()["free", "main"]
        self.assertEqual([(name, tried.get(name)) for name in FREE if tried.get(name) != 0], [])
        self.assertFalse(self.victim.exists())
        self.assertTrue((self.place / "fresh").stat().st_mode & 0o4000)

    def test_single_picture(self):
        """A new picture, and a replaced one: each is correct, and other files of the folder do not change, regardless of their creator."""
        own = self.place / "own.png"
        self.good("home/cube.obj", "-s", 40, "-o", own)
        other = own.read_bytes()
        paths = ":".join(["victim", str(self.victim), "new.png", "own.png", "./picture.png", "deeper/picture.png", "/etc/passwd", "log", "/dev/null", "."])
        wanted = self.good("home/cube.obj", "-s", 300, "-o", "-").stdout
        for words, name in ((["-o", "picture.png"], "picture.png"), ([], "cube.png"), (["-o", "."], "./cube.png"), (["-o", "new/"], "new/cube.png")):
            for _ in range(2):
                self.attack("cube.obj", "-s", 300, "--threads", 3, *words, threads=("main", "thread", "worker"), more={"own.png", name.lstrip("./")},
                            ATTACK_WRITE=paths)
                self.assertEqual((self.place / name).read_bytes(), wanted)
                self.assertEqual(own.read_bytes(), other)
            (self.place / name).unlink()

    def test_name_of_a_stranger(self):
        """A file with the name that the model gives to its picture does not change, unless the user names it."""
        (self.place / "cube.png").write_bytes(b"a photograph")
        self.attack("info", "cube.obj", more={"cube.png"}, ATTACK_WRITE="cube.png")
        self.assertEqual((self.place / "cube.png").read_bytes(), b"a photograph")
        done = subprocess.run([PROGRAM, "compare", "cube.obj", "--sheet", "stages", "-s", "16"], cwd=self.place,
                              env={**os.environ, **self.orders(ATTACK_WRITE="cube.png:cube-stages.png")}, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.attempts()["draws", "main"].get("write-0:cube-stages.png"), 0)  # the sheet's own name
        self.assertEqual((self.place / "cube.png").read_bytes(), b"a photograph")

    def test_modes(self):
        """A replaced picture loses the permission to be executed."""
        picture = self.place / "picture.png"
        picture.write_bytes(b"old")
        picture.chmod(0o4751)
        self.attack("cube.obj", "-s", 16, "-o", "picture.png", more={"picture.png"})
        self.assertEqual(picture.stat().st_mode & 0o7777, 0o640)

    def test_commands(self):
        (self.folder / "a.png").write_bytes(self.good("cube.obj", "-s", 16, "-o", "-").stdout)
        (self.folder / "scene.json").write_text('{"lambent": 1, "objects": [{"file": "cube.obj"}]}')  # which allows files to be read everywhere
        for words, more in ((["compare", "cube.obj", "--sheet", "stages", "-s", 16, "-o", "sheet.png"], {"sheet.png"}),
                            (["explain", "cube.obj", "8,8", "-s", 16, "-o", "figure.svg"], {"figure.svg"}), (["lights", "cube.obj"], {}),
                            (["shader", "cube.obj", "-o", "text"], {"text.vert", "text.frag"}), (["info", "cube.obj"], {}),
                            (["diff", "../a.png", "../a.png", "-o", "difference.png"], {"difference.png"}),
                            (["cube.obj", "-s", 16, "-o", "-"], {}), (["cube.obj", "-s", 16, "--show", "all", "-o", "all.exr"], {"all.exr"}),
                            (["cube.obj", "-s", 16, "-o", "a.png", "--save-scene", "scene.json"], {"a.png", "scene.json"}),
                            (["../scene.json", "-s", 16, "-o", "a.png"], {"a.png"}), (["-", "-s", 16, "-o", "a.png"], {"a.png"}),
                            (["cube.obj", "-s", 16, "--turntable", 3, "-o", "turn.png"], {"turn.png"}),
                            (["cube.obj", "-s", 16, "--turntable", 3, "-o", "turn-{frame}.png"], {f"turn-{i}.png" for i in range(3)}),
                            (["cube.obj", "teapot", "-s", 16, "--views", "front,left", "-o", "{stem}-{view}.png"],
                             {f"{stem}-{view}.png" for stem in ("cube", "teapot") for view in ("front", "left")})):
            if "all" in words and "OpenEXR" not in VERSION:
                continue
            self.attack(*words, more=more, ATTACK_WRITE="victim:new.png:turn-3.png:turn-00.png:text.geom")
            for name in more:
                (self.place / name).unlink()

    def test_convert(self):
        """Next to an OBJ file, its MTL file and numbered pictures may be created; next to other models, nothing. Older files and links do not
        change."""
        self.attack("convert", "cube.obj", "out.glb", "-q", more={"out.glb"}, ATTACK_WRITE="victim:new.png:out.mtl:out-0.png:cube.mtl:out.obj")
        names = "victim:out-front.png:out-12345.png:out-.png:o_t.mtl:out.png:out-0.jpg:deeper/out-0.png"
        self.attack("convert", "cube.obj", "out.obj", "-q", more={"out.glb", "out.obj"}, ATTACK_WRITE=names)
        (self.place / "mine-1.png").write_bytes(b"a photograph")
        os.symlink("victim", self.place / "out-1.png")
        self.attack("convert", "cube.obj", "mine.obj", "-q", more={"out.glb", "out.obj", "mine.obj", "mine-1.png", "out-1.png"}, ATTACK_WRITE="mine-1.png")
        self.attack("convert", "cube.obj", "out.obj", "-q", more={"out.glb", "out.obj", "mine.obj", "mine-1.png", "out-1.png"}, ATTACK_WRITE="out-1.png")
        self.assertEqual((self.place / "mine-1.png").read_bytes(), b"a photograph")

    def test_hash(self):
        """In the folder of --pictures, new files and Lambent's own files may be written, but not through links."""
        os.makedirs(self.place / "pics")
        (self.folder / "elsewhere").mkdir()
        os.symlink("../../elsewhere", self.place / "pics" / "deeper")
        (self.place / "pics" / "mine.png").write_bytes(b"a photograph")
        paths = "victim:new.png:pics/mine.png:pics/deeper/a.png:pics/../a.png:pics/a.txt:p-changes.png:a.hash"
        more = {"p.hash", "pics/mine.png", "pics/cube.obj.png"}
        self.attack("hash", "cube.obj", "-s", 16, "-o", "p.hash", "--pictures", "pics", more=more, ATTACK_WRITE=paths)
        self.attack("hash", "--check", "p.hash", more=more, ATTACK_WRITE=paths + ":p.hash:pics/cube.obj.png")
        self.assertEqual(os.listdir(self.folder / "elsewhere"), [])

    def test_batch(self):
        """In the output folder, only the files of the batch may be changed."""
        out = self.place / "out"
        out.mkdir()
        models = self.folder / "models"
        models.mkdir()
        for name in "abc":
            shutil.copy(OWN_MODELS / "cube.stl", models / f"{name}.stl")
        self.good("home/cube.obj", "-s", 8, "-o", out / "mine.png")  # of another run
        (out / "notes").write_text("of the user")
        kept = {name: (out / name).read_bytes() for name in ("mine.png", "notes")}
        paths = "out/notes:out/mine.png:out/d.png:out/deeper/a.png:out/a.png.png:../models/a.stl:out/lambent.jsonl:victim"
        files = {f"out/{name}" for name in ("a.png", "b.png", "c.png", "mine.png", "notes", "lambent.jsonl")}
        before = {*files, "out/lambent.jsonl.before"}
        for words, more in ((["-j", 2], files), (["-j", 2, "--resume"], files), (["--skip-same"], files), (["--isolate", "-j", 2], before),
                            (["--isolate", "--resume"], before)):
            for name in ("b.png", "c.png") if "--resume" in words else ():
                (out / name).unlink()
            threads = ("main", "thread", "worker") if words == ["-j", 2] else ("main", "thread")
            self.attack("batch", "../models", "-o", "out/", "-s", 16, *words, threads=threads, more=more, ATTACK_WRITE=paths)
            self.assertEqual({name: (out / name).read_bytes() for name in kept}, kept)
            self.assertEqual((out / "a.png").read_bytes(), self.good("models/a.stl", "-s", 16, "-o", "-").stdout)
        # The page reads pictures again, which an attacker may have written.
        thumbnails = ["out/page-files/" + test_batch.xxh64(f"out/{name}.png".encode() + b"\0")[6:] + ".png" for name in "abc"]
        page = {*before, "out/page.html", *thumbnails}
        for words in (["batch", "../models", "-o", "out/", "-s", 16, "--resume", "--report", "out/page.html"],
                      ["batch", "../models", "-o", "out/", "-s", 16, "--isolate", "--resume", "--report", "out/page.html"],
                      ["journal", "out/lambent.jsonl", "--report", "out/page.html"]):
            self.attack(*words, more=page, ATTACK_WRITE=paths)
            for thumbnail in thumbnails:
                (self.place / thumbnail).unlink()

    def test_worker(self):
        """From inside, only new files below --allow-path may be created (with --isolate, only the files of the job), and no existing file may be
        changed."""
        (self.folder / "jobs").write_text('{"id": 1, "model": "cube.obj", "options": {"size": 16}, "output": "a.png"}\n'
                                          '{"id": 2, "model": "cube.obj", "options": {"size": 16}}\n')
        for more in ([], ["--isolate"]):
            for _ in range(2):
                done = self.attack("batch", "--jobs", "../jobs", "--allow-path", ".", "-j", 1, *more, more={"a.png"}, threads=("main", "thread"),
                                   ATTACK_WRITE="victim:cube.obj:../new.png:../log")
                self.assertEqual(done.stdout.count(b'"written"'), 2)
            (self.place / "a.png").unlink()

    def test_viewer(self):
        """The viewer's server, and the process that draws for it."""
        page = self.folder / "page.html"
        page.write_text("<!doctype html>\n<html>\n<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                        "script-src 'sha256-x'; img-src blob: data:; base-uri 'none'; form-action 'none'\">\n</head>\n<body>\n</body>\n</html>\n")
        if b"libmicrohttpd" in self.run_program("view", "no-such-model.obj").stderr:
            self.skipTest("libmicrohttpd is not there")
        if LANDLOCK < 6:
            self.skipTest("Landlock 6 keeps the viewer's signals inside")
        before = self.state()
        viewer = subprocess.Popen([PROGRAM, "view", "--no-open", "home/cube.obj"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  env={**os.environ, **self.orders(ATTACK_MODE="serves"), "LAMBENT_PAGE": str(page)})
        self.addCleanup(viewer.kill)
        address = viewer.stdout.readline().decode().strip()
        with urllib.request.urlopen(address + "draw?w=%2Fcube.obj&w=--size%3D16&c=test", timeout=60) as answer:
            self.assertEqual(answer.status, 200)
        viewer.send_signal(signal.SIGINT)
        said = viewer.communicate()[1]
        self.assertEqual(viewer.returncode, 0, said)
        with open(self.folder / "log", "ab") as log:
            log.write(b"".join(line for line in said.splitlines(True) if line.startswith(b"drawing ")))
        self.check(before, "view", ("main", "thread"), ("serves", "drawing"))
