# test_batch.py: many models: sources, names, pictures, thumbnails, crashes and the progress shown.
import ctypes
import json
import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import subprocess
import time
import urllib.parse

from harness import PROGRAM, Case, read_png, write_png, writers_and_others


def xxh64(data):
    """XXH64 with the seed 0, an independent implementation of its specification."""
    mask, p = (1 << 64) - 1, (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
    rotate = lambda x, n: (x << n | x >> (64 - n)) & mask
    turn = lambda lane, word: rotate(lane + word * p[1] & mask, 31) * p[0] & mask
    at = 0
    if len(data) >= 32:
        lanes = [p[0] + p[1] & mask, p[1], 0, -p[0] & mask]
        while at + 32 <= len(data):
            for i in range(4):
                lanes[i] = turn(lanes[i], int.from_bytes(data[at + 8 * i:at + 8 * i + 8], "little"))
            at += 32
        total = sum(rotate(lane, n) for lane, n in zip(lanes, (1, 7, 12, 18))) & mask
        for lane in lanes:
            total = ((total ^ turn(0, lane)) * p[0] + p[3]) & mask
    else:
        total = p[4]
    total = total + len(data) & mask
    for size, factor, bits, times, plus in ((8, None, 27, p[0], p[3]), (4, p[0], 23, p[1], p[2]), (1, p[4], 11, p[0], 0)):
        while at + size <= len(data):
            word = int.from_bytes(data[at:at + size], "little")
            total = rotate(total ^ (turn(0, word) if factor is None else word * factor & mask), bits) * times + plus & mask
            at += size
    for shift, factor in ((33, p[1]), (29, p[2]), (32, 1)):
        total = (total ^ total >> shift) * factor & mask
    return "xxh64:%016x" % total


def default_interrupt():
    """Runs in the child: a shell that starts the tests in the background ignores Ctrl-C, and lambent keeps an ignored signal ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Batch(Case):
    def setUp(self):
        super().setUp()
        for name in os.listdir(self.folder):
            os.remove(self.folder / name)

    def cube(self, path, source="cube.stl"):
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes((pathlib.Path(__file__).parents[1] / "models" / source).read_bytes())
        return target

    def tree(self, count=6):
        for i in range(count):
            self.cube(f"in/{'ab'[i % 2]}/m{i}.stl")
        time.sleep(0.02)  # a file changed within a clock tick before it was read has no key
        return [f"in/{'ab'[i % 2]}/m{i}.stl" for i in range(count)]

    def files(self, folder="out"):
        return {os.path.relpath(os.path.join(path, name), self.folder / folder)
                for path, _, names in os.walk(self.folder / folder) for name in names}

    def pictures(self, folder="out"):
        return {name: (self.folder / folder / name).read_bytes() for name in self.files(folder) if name.endswith(".png")}

    def journal(self, path="out/lambent.jsonl"):
        """The picture records of a journal; every line is complete."""
        lines = [json.loads(line) for line in (self.folder / path).read_text().splitlines()]
        return [line for line in lines if "output" in line]

    def batch(self, *words, code=0, **more):
        done = self.run_program("batch", *words, *([] if "--sizes" in words else ["-s", 24]), **more)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return done


class Sources(Batch):
    def test_journal_is_a_regular_file(self):
        """Batch once renamed a device that was named as the journal, and put a file in its place."""
        self.good("shape", "cube", "-q", "-o", "cube.obj")
        os.mkfifo(self.folder / "pipe")
        self.given |= {"cube.obj", "pipe"}
        self.bad(5, "cube.obj", "-o", "{stem}.png", "--journal", "pipe", says="pipe: cannot write: found a folder, pipe or device, expected a regular file")
        self.assertTrue((self.folder / "pipe").is_fifo())
        self.assertFalse((self.folder / "pipe.before").exists())

    def test_folders(self):
        self.tree(4)
        self.cube("in/a/deep/c.OBJ", "cube.obj")
        self.cube("in/.hidden/h.stl")
        self.cube("in/a/.h.stl")
        (self.folder / "in/a/notes.txt").write_text("no model")
        (self.folder / "in/a/data.json").write_text("{}")
        os.symlink("..", self.folder / "in/b/up")  # a cycle
        done = self.batch("in", "-o", "out/{dir}/{stem}.png")
        self.assertEqual(set(self.pictures()), {"a/m0.png", "b/m1.png", "a/m2.png", "b/m3.png", "a/deep/c.png"})
        self.assertIn("5 of 5 pictures written", done.stderr.decode())
        self.assertEqual(done.stdout, b"")
        self.run_program("batch", "in/a/", self.folder / "in/b", "-s", 24, "-o", "two/{dir}/{stem}.png")
        self.assertEqual(set(self.pictures("two")), {"m0.png", "m1.png", "m2.png", "m3.png", "deep/c.png"})

    def test_links_of_a_folder(self):
        """A link that leads out of the folder fails unless the target's folder is allowed; broken links and links to other things than files also
        fail."""
        self.cube("in/deep/a.obj", "cube.obj")
        self.cube("elsewhere/secret.obj", "cube.obj")
        os.symlink("deep/a.obj", self.folder / "in/inside.obj")
        os.symlink("../elsewhere/secret.obj", self.folder / "in/out.obj")
        os.symlink("nowhere.obj", self.folder / "in/gone.obj")
        os.symlink("circle.obj", self.folder / "in/circle.obj")
        os.mkfifo(self.folder / "in/pipe.obj")
        for sandbox in ("auto", "off"):
            for several in ((), ("--views", "front,left")):
                done = self.run_program("batch", "in", "-s", 8, "--sandbox", sandbox, *several, "-o", "o/{stem}-{view}.png" if several else "o/")
                said = done.stderr.decode()
                self.assertEqual(done.returncode, 7, said)
                self.assertIn("in/out.obj: cannot open: a link that leads out of the folder that was given; name the file, or allow its folder (--allow-path", said)
                for name, why in (("gone", "No such file"), ("circle", "Too many levels"), ("pipe", "is a pipe, expected a regular file")):
                    self.assertRegex(said, f"in/{name}.obj: .*{why}")
                self.assertEqual(sorted({p.name.split("-")[0].split(".")[0] for p in (self.folder / "o").glob("*.png")}), ["a", "inside"])
                for path in (self.folder / "o").iterdir():
                    path.unlink()
        # A named file is read, and a file in an allowed folder is read.
        self.good("batch", "in/out.obj", "-s", 8, "-o", "o/")
        done = self.run_program("batch", "in", "-s", 8, "--allow-path", "elsewhere", "-o", "o/")
        self.assertEqual(done.returncode, 7)
        self.assertNotIn("out.obj", done.stderr.decode())
        self.assertTrue((self.folder / "o/out.png").exists())

    def test_lists(self):
        names = self.tree(4)
        (self.folder / "list").write_text("\r\n".join(names[:2]) + "\n\n")
        (self.folder / "more").write_text(names[3])
        self.batch("@list", names[2], "--files-from", "more", "-o", "out/")
        self.assertEqual(set(self.pictures()), {"m0.png", "m1.png", "m2.png", "m3.png"})
        self.batch("-", "-o", "in2/", stdin="\n".join(names).encode())
        self.assertEqual(set(self.pictures("in2")), set(self.pictures()))
        self.good("--files-from", "more", names[0], "-s", 24, "-o", "three/")
        self.assertEqual(set(self.pictures("three")), {"m0.png", "m3.png"})

    def test_out_is_output(self):
        self.tree(2)
        for word in (["--out", "out/{stem}.png"], ["--out=out/{stem}.png"]):
            self.batch("in", *word)
            self.assertEqual(set(self.pictures()), {"m0.png", "m1.png"})
            shutil.rmtree(self.folder / "out")
        self.assertEqual(read_png(self.good("in/a/m0.stl", "-s", 24, "--out", "-").stdout)[:2], (24, 24))
        self.assertEqual(json.loads(self.run_program("in/none.stl", "--out", "-", "--json").stderr)["error"]["code"], "cannot-read")

    def test_dry_run(self):
        self.tree(2)
        done = self.batch("in", "-o", "out/{stem}-{size}.png", "--dry-run")
        self.assertEqual(done.stdout.decode(), "in/a/m0.stl -> out/m0-24.png\nin/b/m1.stl -> out/m1-24.png\n")
        done = self.batch("in", "-o", "out/", "--dry-run", "--json")
        self.assertEqual([json.loads(line) for line in done.stdout.splitlines()],
                         [{"model": "in/a/m0.stl", "output": "out/m0.png"}, {"model": "in/b/m1.stl", "output": "out/m1.png"}])
        self.assertFalse((self.folder / "out").exists())

    def test_mistakes(self):
        self.cube("a/x.stl")
        self.cube("a/x.obj", "cube.obj")
        (self.folder / "empty").mkdir()
        (self.folder / "zero").write_bytes(b"a\0b\n")
        for words, code, says in ((["a"], 1, ["'a/x.obj' and 'a/x.stl' would both be written to 'x.png'", "{ext}"]),
                                  (["a/x.stl", "a/x.stl"], 1, "'a/x.stl' is listed twice"),
                                  ([], 1, "no model given"), (["empty"], 2, "found no model"), (["@none"], 2, "none: cannot read the list"),
                                  (["@zero"], 2, "zero byte"), (["a/x.stl", "-o", "-"], 1, "cannot write several pictures"),
                                  (["a/x.stl", "--views", "front,left", "-o", "x.png"], 1, "names one picture"),
                                  (["a/x.stl", "--views", "front,left", "-o", "{stem}.png"], 1, "needs {view}, {size} or {show}"),
                                  (["a/x.stl", "--views", "front,front"], 1, "a side twice"),
                                  (["a/x.stl", "--views", "front,side"], 1, "found 'side'"),
                                  (["a/x.stl", "--sizes", "16,0"], 1, "such as 1024,256x128"),
                                  (["a/x.stl", "--views", "front", "--azimuth", "3"], 1, "several sides and the option '--azimuth'"),
                                  (["a/x.stl", "--view", "front,left", "--view", "top"], 1, "several sides and the option '--view'"),
                                  (["a/x.stl", "-s", "16,24", "-s", "32"], 1, "give all sizes in one list"),
                                  (["a/x.stl", "--view", "front,side"], 1, "option '--view': found 'side'"),
                                  (["a/x.stl", "--resume", "--skip-same"], 1, "cannot be used together"),
                                  (["a/x.stl", "--resume", "--journal", "none"], 1, "needs a journal, but")):
            done = self.run_program("batch", *words)
            self.assertEqual(done.returncode, code, (words, done.stderr))
            for part in [says] if isinstance(says, str) else says:
                self.assertIn(part, done.stderr.decode())
            self.assertEqual(self.files(""), {"a/x.stl", "a/x.obj", "zero"})


class Page(Batch):
    def test_page(self):
        names = self.tree(3)
        (self.folder / names[1]).write_bytes(b"")
        self.cube("in/a/<b>&'\"%.stl")
        for more in ([], ["--isolate"], ["--resume"]):
            self.batch("in", "-o", "out/{stem}.png", "--report", "pages/p.html", *more, code=7)
            page = (self.folder / "pages/p.html").read_text()
            self.assertLess(page.index("Failed"), page.index("Pictures"))
            failed, pictures = page.split("<h2>Pictures</h2>")
            self.assertIn("in/b/m1.stl", failed)
            self.assertIn("cannot-read", failed)
            self.assertIn("&lt;b&gt;&amp;", pictures)
            self.assertNotIn("<b>&", page)
            self.assertNotIn("<script", page)
            images = re.findall(r'src="([^"]+)"', page)
            links = re.findall(r'href="([^"]+)"', page)
            self.assertEqual((len(images), len(links)), (3, 3))
            for address in images + links:
                self.assertTrue((self.folder / "pages" / urllib.parse.unquote(address)).is_file(), address)
                self.assertFalse(address.startswith("/"))
            small = [read_png((self.folder / "pages" / urllib.parse.unquote(a)).read_bytes()) for a in images]
            self.assertEqual({s[:2] for s in small}, {(24, 24)})
        self.batch("in", "-o", "large/", "--report", "p.html", "--sizes", "400x200,20", code=7)
        sizes = [read_png(path.read_bytes())[:2] for path in (self.folder / "p-files").iterdir()]
        # Without -o, nothing is written beside the page but its own folders; a folder is no page.
        self.batch("in", "--report", "own/q.html", code=7)
        self.assertEqual({path.name for path in (self.folder / "own").iterdir()}, {"q.html", "q-files", "q-pictures"})
        self.assertTrue((self.folder / "own/q-pictures/lambent.jsonl").is_file())
        for folder in ("own", "new/"):
            self.bad(1, "batch", "in", "--report", folder, says=("is a folder", "index.html"))
        self.assertEqual(sorted(set(sizes)), [(20, 20), (160, 80)])


class Pictures(Batch):
    def test_same_bytes_as_alone(self):
        names = self.tree(7)
        self.cube("in/a/cube.mtl", "cube.mtl")
        self.cube("in/a/c.obj", "cube.obj")
        for jobs in ("1", "3", "64"):
            shutil.rmtree(self.folder / "out", True)
            self.batch("in", "-o", "out/", "-j", jobs)
            together = self.pictures()
            self.assertEqual(len(together), 8)
            for name in [*names, "in/a/c.obj"]:
                self.good(name, "-s", 24, "-o", "alone.png")
                self.assertEqual((self.folder / "alone.png").read_bytes(), together[pathlib.Path(name).stem + ".png"], (jobs, name))
        self.good(*names, "-s", 24, "-o", "multi/")
        self.assertEqual({n: b for n, b in together.items() if n != "c.png"}, self.pictures("multi"))
        self.batch("in", "-o", "process/", "--isolate")
        self.assertEqual(self.pictures("process"), together)

    def test_views_and_sizes_of_one_reading(self):
        self.cube("cube.obj", "cube.obj")
        self.cube("cube.mtl", "cube.mtl")
        for look in ([], ["--rotate", "y:30"], ["--light", "point:frame=view,position=1r/2r/3r", "--light-scale", "0.5"], ["--light", "+spot"],
                     ["--show-lights"], ["--rig", "three-point", "--two-sided"]):
            done = self.good("cube.obj", "--view", "front,left,iso", "-s", "24,40x16", "-o", "out/", *look)
            self.assertEqual(len(done.stderr.splitlines()) >= 6, True)
            for view in ("front", "left", "iso"):
                for size in ("24", "40x16"):
                    self.good("cube.obj", "--view", view, "-s", size, "-o", "alone.png", *look)
                    self.assertEqual((self.folder / "alone.png").read_bytes(), (self.folder / f"out/cube-{view}-{size}.png").read_bytes(),
                                     (look, view, size))
            shutil.rmtree(self.folder / "out")

    def test_an_environment_is_read_once(self):
        """Workers share the model; each picture has the same bytes as when drawn alone."""
        names = self.tree(12)
        sky = self.folder / "sky.png"
        sky.write_bytes(write_png(32, 16, bytes((i * 7 + i // 64) % 256 if i % 4 < 3 else 255 for i in range(2048))))
        words = ["--environment", "sky.png", "--reflectivity", "0.8"]
        libc = ctypes.CDLL(None, use_errno=True)
        watch = libc.inotify_init1(os.O_NONBLOCK)
        self.assertGreaterEqual(libc.inotify_add_watch(watch, os.fsencode(sky), 0x20), 0)  # IN_OPEN
        self.batch(*names, "-o", "out/", "-j", "4", "--journal", "none", *words)
        self.assertEqual(len(os.read(watch, 65536)), 16)  # one event
        os.close(watch)
        self.good(names[0], "-s", 24, "-o", "alone.png", *words)
        self.assertEqual({data for data in self.pictures().values()}, {(self.folder / "alone.png").read_bytes()})
        self.good(names[0], "-s", 24, "-o", "without.png")
        self.assertNotEqual((self.folder / "without.png").read_bytes(), (self.folder / "alone.png").read_bytes())

    def test_order_of_messages(self):
        names = self.tree(8)
        (self.folder / names[3]).write_bytes(b"solid x\nfacet no")
        done = self.run_program(*names, "-s", 24, "--json", "-j", "4", "-o", "out/")
        self.assertEqual(done.returncode, 2)
        self.assertEqual([json.loads(line)["model"]["path"] for line in done.stdout.splitlines()], names)

    def test_failures(self):
        names = self.tree(4)
        (self.folder / names[1]).write_bytes(b"")
        done = self.batch("in", "-o", "out/", code=7)
        self.assertEqual(set(self.pictures()), {"m0.png", "m2.png", "m3.png"})
        self.assertIn("3 of 4 pictures written, 1 failed (cannot-read 1)", done.stderr.decode())
        self.assertIn("in/b/m1.stl", done.stderr.decode())
        [failed] = [r for r in self.journal() if r["class"] != "ok"]
        self.assertEqual((failed["class"], failed["exit"], failed["attempt"], failed["cause"]), ("cannot-read", 2, 1, "model"))
        for more in ([], ["--resume"], ["--isolate"], ["--retry-failed", "1"]):
            done = self.batch("in", "-o", "out/", "--failures-ok", *more)
            self.assertIn("1 failed", done.stderr.decode())
        self.good("in/b/m1.stl", names[0], "-s", 24, "-o", "out/", "--failures-ok")
        # Only failures of models are tolerated.
        self.batch("in", "-o", "out/", "--failures-ok", "--journal", "/proc/none", code=5)
        self.batch("in", "none", "-o", "out/", "--failures-ok", "--resume", "--tone", "aces", code=1)
        self.batch("in", "-o", "out/", code=7)
        self.assertIn("in/b/m1.stl", failed["error"])
        self.assertEqual(len(self.journal()), 4)


class Crashes(Batch):
    def test_a_crash_is_one_failed_line(self):
        """If a process is killed while it draws, only its own picture is lost."""
        names = self.tree(2)
        own = ":handle_segv=0" # AddressSanitizer would turn the signal into an exit code
        process = subprocess.Popen([PROGRAM, "batch", *names, "-s", "6000", "--samples", "16", "--isolate", "-j", "2", "-o", "out/"],
                                   cwd=self.folder, stderr=subprocess.PIPE,
                                   env=dict(os.environ, ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + own))
        child = None
        until = time.time() + 30
        while not child and time.time() < until:
            child = next(iter(writers_and_others(process.pid)[1]), None)
        os.kill(child, signal.SIGSEGV)
        text = process.communicate()[1].decode()
        self.assertEqual(process.returncode, 7, text)
        self.assertIn("its process was ended by signal 11 (Segmentation fault)", text)
        self.assertIn("1 of 2 pictures written, 1 failed (crashed 1)", text)
        records = self.journal()
        self.assertEqual(sorted((r["class"], r["exit"], r.get("cause")) for r in records), [("crashed", 8, "machine"), ("ok", 0, None)])
        self.assertEqual(len(self.pictures()), 1)


class Machines(Batch):
    """A failure of the machine is not a failure of the model: --resume draws the picture, --failures-ok does not hide the failure."""

    def limited(self, kind, limit, *words):
        def apply():
            resource.setrlimit(kind, (limit, resource.getrlimit(kind)[1]))
        return subprocess.run([PROGRAM, "batch", "in", "-s", "24", "-o", "out/", "--failures-ok", "--resume", *words], cwd=self.folder, preexec_fn=apply, capture_output=True)

    def check_resumed(self, count, stopped):
        """Ten failures in succession end the run with 5, and `lambent journal` exits as the run did. The next run draws every picture."""
        self.assertEqual(stopped.returncode, 5, stopped.stderr)
        self.assertIn(b"10 pictures in succession failed because of this machine", stopped.stderr)
        failed = [r for r in self.journal() if r["class"] != "ok"]
        self.assertEqual({r["cause"] for r in failed}, {"machine"})
        self.assertLess(len(failed), 20)  # pictures that are written in between start the count again
        self.assertEqual(self.run_program("journal", "out").returncode, 5)
        self.batch("in", "-o", "out/", "--failures-ok", "--resume")
        self.assertEqual(len(self.pictures()), count)
        self.assertEqual(self.run_program("journal", "out").returncode, 0)

    def test_no_descriptors(self):
        self.tree(24)
        self.check_resumed(24, self.limited(resource.RLIMIT_NOFILE, 8, "--isolate", "-j", "2"))

    def test_no_space(self):
        """The picture's folder is a file system without inodes."""
        self.tree(24)
        out = self.folder / "out"
        out.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m,nr_inodes=8", "tmpfs", out], capture_output=True).returncode:
            self.skipTest("a file system can be mounted only by root")
        try:
            for words in ([], ["--isolate"], ["--sandbox", "off"]):
                subprocess.run(["mount", "-o", "remount,nr_inodes=8", out], check=True)
                stopped = self.limited(resource.RLIMIT_NOFILE, 1000, *words)
                subprocess.run(["mount", "-o", "remount,nr_inodes=1000", out], check=True)
                self.check_resumed(24, stopped)
                for file in out.iterdir():
                    file.unlink()
        finally:
            subprocess.run(["umount", out], check=True)

    def test_older_lines_and_mixed_failures(self):
        """Lines of older versions have no cause. Exit codes 4 and 5 are tried again once, 2 is not."""
        names = self.tree(4)
        self.batch("in", "-o", "out/")
        path = self.folder / "out/lambent.jsonl"
        lines = [json.loads(line) for line in path.read_text().splitlines()]
        for line, exit, cause in zip([line for line in lines if "model" in line], (2, 4, 5, 8), (None, None, None, "machine")):
            line.update({"class": "failed", "exit": exit, "error": "e", **({"cause": cause} if cause else {})})
        path.write_text("".join(json.dumps(line) + "\n" for line in lines))
        for name in self.pictures():
            (self.folder / "out" / name).unlink()
        done = self.batch("in", "-o", "out/", "--resume", "--failures-ok")
        self.assertIn("3 of 4 pictures written, 1 failed", done.stderr.decode())
        self.assertEqual(len(names) - 1, len(self.pictures()))

    def test_a_model_that_ends_its_process(self):
        """The third time that a model's process is killed, the cause is the model, and the run no longer waits for it."""
        self.tree(1)
        for attempt, cause, code in ((1, "machine", 7), (2, "machine", 7), (3, "model", 0)):
            self.limited(resource.RLIMIT_CPU, 1, "-s", "12000", "--samples", "16", "--shadows", "--isolate", "-j", "1")
            [line] = self.journal()[-1:]
            self.assertEqual((line["attempt"], line["cause"]), (attempt, cause))
            self.assertEqual(self.run_program("journal", "out").returncode, code)


class Terminal(Batch):
    def test_progress(self):
        names = self.tree(30)
        for words in (["batch", "in", "-o", "out/"], [*names, "-o", "out/", "--quiet"], [*names, "-o", "out/"]):
            master, slave = pty.openpty()
            process = subprocess.Popen([PROGRAM, *words, "-s", "700", "--samples", "16", "-j", "2"], cwd=self.folder, stderr=slave,
                                       env={**os.environ, "TERM": "xterm", "NO_COLOR": "1"})
            os.close(slave)
            text = b""
            while True:
                try:
                    piece = os.read(master, 4096)
                except OSError:
                    break
                if not piece:
                    break
                text += piece
            self.assertEqual(process.wait(), 0)
            os.close(master)
            progress = re.findall(rb"\d+ of 30  \d+ %  [\d.e+]+ a second  \d+:\d\d left", text)
            if "--quiet" in words:
                self.assertEqual(text, b"")
            else:
                self.assertTrue(progress, text)
                self.assertIn(b"30 of 30 pictures written", text)
