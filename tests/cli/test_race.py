# test_race.py: somebody exchanges every folder and file of a run by links to others, thousands of times a second. No file outside may be read or written.
import base64
import ctypes
import json
import os
import random
import re
import shutil
import signal
import subprocess
import threading
import time

from harness import PROGRAM, Case, long

JOBS = int(os.environ.get("LAMBENT_RACE", "6000" if os.environ.get("LAMBENT_LONG") else "40"))  # of each mode
EXCHANGE = 2  # RENAME_EXCHANGE
MODES = ([], ["--isolate"], ["--sandbox", "require"], ["--sandbox", "off"], ["--sandbox", "off", "--isolate"])
SCENE = "mtllib {0}.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 {1} 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
CODE = ctypes.CDLL(None, use_errno=True)


class Racer:
    """A process that exchanges names with links, each in an open folder."""

    def __init__(self, folder, pairs):
        self.pairs = [(os.open(folder / inside, os.O_PATH | os.O_DIRECTORY), name.encode()) for inside, name in pairs]
        for place, name in self.pairs:
            os.symlink(os.fsencode(folder / "far" / os.path.relpath(os.readlink(f"/proc/self/fd/{place}"), folder.resolve())) + b"/" + name,
                       b"link to " + name, dir_fd=place)
        self.process = os.fork()
        if not self.process:  # the pipes of the program are not this process's
            kept = {place for place, _ in self.pairs}
            for file in range(4096):
                if file not in kept and file != 2:
                    try:
                        os.close(file)
                    except OSError:
                        pass
        while not self.process:
            place, name = random.choice(self.pairs)
            for _ in range(2):  # there and back, so that only one name at a time is a link
                CODE.renameat2(place, name, place, b"link to " + name, EXCHANGE)
                if random.random() < 0.5:
                    time.sleep(random.random() / 5000)

    def stop(self):
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        for place, name in self.pairs:
            if os.path.islink(f"/proc/self/fd/{place}/{name.decode()}"):
                CODE.renameat2(place, name, place, b"link to " + name, EXCHANGE)
            os.unlink(b"link to " + name, dir_fd=place)
            os.close(place)


class Race(Case):
    def setUp(self):
        super().setUp()
        for place, height in (("top", 1), ("far/top", 2)):
            color = "1 0 0" if height == 1 else "0 0 1"
            inside = self.folder / place / "a/b"
            inside.mkdir(parents=True)
            self.good("teapot" if height == 1 else "sphere", "-s", 8, "-o", f"{place}/a/b/t.png", "-q")
            (inside / "x.mtl").write_text(f"newmtl m\nKd {color}\nmap_Kd t.png\n")
            (inside / "x.obj").write_text(SCENE.format("x", height))
        # What may be seen: the model with the files that it names, or without those that are links at the moment.
        self.seen = set()
        shutil.copytree(self.folder / "top", self.folder / "part")
        for gone in (None, "a/b/t.png", "a/b/x.mtl"):
            if gone:
                (self.folder / "part" / gone).unlink()
            self.seen.add(self.good("part/a/b/x.obj", "-s", 8, "-o", "-", "-q").stdout)
        self.assertEqual(len(self.seen), 3)
        self.far = self.good("far/top/a/b/x.obj", "-s", 8, "-o", "-", "-q").stdout
        for number in range(JOBS):
            for place in ("top", "far/top"):
                shutil.copy(self.folder / place / "a/b/x.obj", self.folder / place / "a/b" / f"m{number}.obj")

    def snapshot(self):
        return {path: path.is_file() and path.read_bytes() for path in (self.folder / "far").rglob("*")}

    def check(self, before, out, words):
        self.assertEqual(self.snapshot(), before, words)
        pictures = [path.read_bytes() for path in (self.folder / out).rglob("*.png") if path.is_file()]
        self.assertFalse([1 for picture in pictures if picture not in self.seen], words)
        return len(pictures)

    def jobs(self, words):
        for place in ("top/out/o", "far/top/out/o"):
            shutil.rmtree(self.folder / place, True)
            os.makedirs(self.folder / place)
        (self.folder / "far/top/out/o/n1.png").write_bytes(self.far)  # Lambent's own picture, which a worker may replace
        before = self.snapshot()
        process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", "--allow-path", "top", "-s", "8", "-j", "2", "--ahead", "3", *words], cwd=self.folder,
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        def say(job):
            process.stdin.write(json.dumps(job).encode() + b"\n")
            process.stdin.flush()
        say({"id": "first", "model": "top/a/b/x.obj"})
        answers = [json.loads(process.stdout.readline())]
        self.assertEqual(answers[0]["outcome"], "written", answers)
        def read():
            answers.extend(map(json.loads, process.stdout))
        reader = threading.Thread(target=read)
        reader.start()
        racer = Racer(self.folder, [("", "top"), ("top", "a"), ("top/a", "b"), ("top/a/b", "x.obj"), ("top/a/b", "x.mtl"), ("top/a/b", "t.png"), ("top", "out"), ("top/out", "o")])
        for number in range(JOBS):
            job = {"id": number, "model": f"top/a/b/{'x' if number % 2 else f'm{number}'}.obj"}
            say({**job, "output": f"top/out/o/n{number}.png"} if number % 4 else job)
        process.stdin.close()
        reader.join()
        process.wait()
        racer.stop()
        said = process.stderr.read()
        self.assertEqual((process.returncode in (0, 7), len(answers)), (True, JOBS + 1), (words, said))
        shown = [base64.b64decode(a["data"]) for a in answers if a.get("data")]
        self.assertTrue(shown)
        self.assertFalse([1 for picture in shown if picture not in self.seen], words)
        return self.check(before, "top/out", words) + len(shown)

    def batch(self, words):
        for place in ("out", "page", "far/out", "far/page"):
            shutil.rmtree(self.folder / place, True)
        for place in ("out/a/b", "page/p-files", "far/out/a/b", "far/page/p-files"):
            os.makedirs(self.folder / place)
        before = self.snapshot()
        process = subprocess.Popen([PROGRAM, "batch", "top", "-s", "8", "-j", "2", "-o", "out/{dir}/{stem}.png", "--journal", "none", "--report", "page/p.html",
                                    *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not list((self.folder / "out").rglob("*.png")):
            time.sleep(0.001)
        racer = Racer(self.folder, [("", "top"), ("top", "a"), ("top/a", "b"), ("top/a/b", "x.mtl"), ("top/a/b", "t.png"), ("", "out"), ("out", "a"), ("out/a", "b"),
                                    ("", "page"), ("page", "p-files")])
        process.wait()
        racer.stop()
        self.assertIn(process.returncode, (0, 5, 7), words)  # 5: ten pictures in a row could not be written
        return self.check(before, "out", words)

    def race(self):
        for words in MODES:
            for run in (self.jobs, self.batch):
                count = run(words)
                print(f"# {run.__name__} {' '.join(words)}: {count} pictures of {JOBS}, none from outside")

    def test_links_come_and_go(self):
        self.race()

    @long
    def test_many(self):
        self.race()

    def test_nothing_is_opened_by_its_path(self):
        """After the start, each open() of the user's folders begins at a handle."""
        if not shutil.which("strace"):
            self.skipTest("no strace")
        for words in (["--isolate"], []):
            self.trace(words)

    def trace(self, words):
        shutil.rmtree(self.folder / "out", True)
        calls = "open,openat,openat2,creat,mkdir,mkdirat,rename,renameat,renameat2,link,linkat,unlink,unlinkat,symlink,symlinkat"
        log = self.folder / "trace"
        done = subprocess.run(["strace", "-f", "-s", "300", "-e", "trace=" + calls, "-o", log, PROGRAM, "batch", "top", "-s", "8", "-o", "out/{dir}/{stem}.png",
                               "--report", "page/p.html", *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if b"PTRACE" in done.stderr or not log.read_text():
            self.skipTest("strace may not trace")
        self.assertEqual(done.returncode, 0, done.stderr)
        own = re.escape(str(self.folder))
        named = re.compile(rf'(?:AT_FDCWD, |^\d+ +(?:open|creat|mkdir|rename|link|unlink)\()"((?!/)[^"]*|{own}[^"]*)"(.*)')
        by_path = [found.groups() for found in map(named.search, log.read_text().splitlines()) if found]
        self.assertEqual(sorted(name for name, _ in by_path), [".", "top"], words)  # each once, at the start
        for _, how in by_path:
            self.assertIn("O_PATH|O_DIRECTORY", how)
