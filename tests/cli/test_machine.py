# test_machine.py: strange machines. strange.c is built here and preloaded into the program: file systems that lack calls or lose handles, kernels without
# Landlock, seccomp or openat2, and a clock that jumps. The program writes the same bytes as usual, or prints one sentence and leaves no file.
import contextlib
import errno
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from harness import HAS_SANDBOX, PROGRAM, ROOT, Case, read_png
from test_limits import SANITIZED

LONG = bool(os.environ.get("LAMBENT_LONG"))
KILLS = 60 if LONG else 6


def setUpModule():
    global LIBRARY, FOLDER
    if SANITIZED:
        raise unittest.SkipTest("a sanitizer's library must be the first one")
    if not shutil.which("cc"):
        raise unittest.SkipTest("no compiler")
    FOLDER = tempfile.TemporaryDirectory(prefix="lambent-machine-")
    os.chmod(FOLDER.name, 0o755)  # also for a plain user
    LIBRARY = pathlib.Path(FOLDER.name) / "strange.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", LIBRARY, pathlib.Path(__file__).with_name("strange.c"), "-ldl"], check=True)


def tearDownModule():
    FOLDER.cleanup()


# Commands that read models and write files, in a folder with a model and an older picture.
COMMANDS = {
    "new": "cube.obj -s 16 -q -o out/new.png",
    "over": "cube.obj -s 16 -q -o out/old.png --durable",
    "free": "cube.obj -s 16 -q -o out/old.png --sandbox off",
    "batch": "batch in -s 16 -j 2 -o out/b/{stem}{ext}.png",
    "isolate": "batch in -s 16 -j 2 --isolate -o out/b/{stem}{ext}.png",
    "resume": "batch in -j 2 -s 16 -o out/r/{stem}{ext}.png --resume",
    "same": "batch in -j 2 -s 16 -o out/r/{stem}{ext}.png --skip-same",
    "convert": "convert cube.obj out/c.obj",
    "journal": "journal out/r",
}
# What is strange, and for the commands that fail: the exit code and a part of the sentence. The others write the same files as usual.
MACHINES = [
    ("tmpfile={EOPNOTSUPP}", {}),  # NFS, FAT, some FUSE file systems
    ("tmpfile={EISDIR}", {}),  # kernels that ignore O_TMPFILE
    ("linkat={EPERM}", {}),  # no hard links
    ("linkat={EXDEV}", {}),  # overlayfs
    ("linkat={EMLINK} fsync={EOPNOTSUPP} fchmod={EOPNOTSUPP}", {}),
    ("tmpfile={EINVAL} fsync={ENOSYS} fchmod={ENOSYS}", {}),
    ("openat2={ENOSYS}", {}),
    ("openat2={EPERM}", {}),  # filters of older container programs
    ("read={EINTR}/2 pread={EINTR}/2 write={EINTR}/2", {}),
    ("unlinkat={EBUSY}", {}),  # a removed file that is still open, on NFS
    ("tmpfile={EOPNOTSUPP} renameat={EXDEV}", {name: (5 if name in ("new", "over", "free", "convert") else 7, "cannot write: Operation not supported" if name != "convert" else "cannot write")
                                               for name in ("new", "over", "free", "batch", "isolate", "convert")}),
    ("renameat={ESTALE}", {name: (5, "Stale file handle") for name in ("over", "free", "convert")}),
    ("fsync={EIO}", {"over": (5, "Input/output error")}),
    ("flock={ENOLCK}", {}),  # with a warning
    ("flock={ENOSYS}", {}),  # Lustre without locks
    ("readdir={EIO}@4", {name: (2, "in: cannot read the folder: Input/output error") for name in ("batch", "isolate", "resume", "same")}),
    ("fstatat64={ESTALE}@3", {name: (2, "cannot read: Stale file handle") for name in ("batch", "isolate", "resume", "same")}),
    ("read={EIO}@1", {name: (2, "cannot read") for name in ("resume", "same", "journal")}),
    ("pread={EIO}", {name: (4 if name in ("new", "over", "free", "convert") else 7, "Input/output error") for name in ("new", "over", "free", "batch", "isolate", "convert")}),
    ("clock=3600", {}),
    ("clock=-1000000000", {}),
    ("landlock={ENOSYS}", {}),
    ("landlock={EOPNOTSUPP} seccomp={EINVAL} openat2={ENOSYS}", {}),
    ("privileges={EINVAL}", {}),
]


class Machine(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "in").mkdir()
        for model in self.folder.glob("cube.*"):
            shutil.copy(model, self.folder / "in")
        time.sleep(0.02)  # a model whose time is that of the run might have changed while it was read
        self.good("batch", "in", "-s", 16, "-o", "out/r/{stem}{ext}.png", "-q")
        self.good("teapot", "-s", 8, "-o", "out/old.png", "-q")
        self.before = self.files()
        shutil.move(self.folder / "out", self.folder / "before")

    def files(self):
        """The files except journals, whose times differ."""
        return {path.relative_to(self.folder): path.read_bytes() for path in (self.folder / "out").rglob("*") if path.is_file() and ".jsonl" not in path.name}

    def strange(self, what, command, **more):
        shutil.rmtree(self.folder / "out", True)
        shutil.copytree(self.folder / "before", self.folder / "out")
        env = {"LD_PRELOAD": str(LIBRARY), "STRANGE": what.format(**vars(errno))} if what else {}
        return self.run_program(*command.split(), env=env, **more)

    def test_machines(self):
        usual = {}
        for name, command in COMMANDS.items():
            self.assertEqual(self.strange("", command).returncode, 0)
            usual[name] = self.files()
        for what, failures in MACHINES:
            for name, command in COMMANDS.items():
                done = self.strange(what, command)
                text = done.stderr.decode()
                code, says = failures.get(name, (0, ""))
                self.assertEqual(done.returncode, code, (what, name, text))
                self.assertIn(says, text, (what, name))
                files = self.files()
                if not code:
                    self.assertEqual(files, usual[name], (what, name))
                    self.assertEqual("has no locks" in text, "flock" in what and command.startswith("batch"), (what, name, text))
                for path, data in files.items():  # nothing half-written, and no other file
                    self.assertIn(data, (usual[name].get(path), self.before.get(path)), (what, name, path))

    def test_clock(self):
        """If the clock was set while a model was drawn, it does not show whether the model has changed since, so --skip-same draws it again."""
        for what, has_key in (("", True), ("clock=3600", False)):
            self.strange(what, COMMANDS["batch"].replace("-j 2", "-j 1"))
            records = [json.loads(line) for line in (self.folder / "out/b/lambent.jsonl").read_text().splitlines()]
            self.assertEqual([bool(r.get("key")) for r in records if "output" in r], [has_key] * 3, what)
        done = self.strange("clock=100000", "teapot -s 64 -o out/a.png --time-limit 30 --json")
        report = json.loads(done.stdout)
        self.assertLess(report["times_ms"]["total"], 30000)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_memory(self):
        """One failed allocation, also inside expat, zlib, libjpeg, libspng, OpenEXR and FreeType: the same bytes, or the machine's failure."""
        for name in ("png/palette8.png", "jpeg/color420.jpg"):
            shutil.copy(ROOT / "tests/pictures" / name, self.folder)
        shutil.copy(ROOT / "tests/fuzz/corpus/exr/triangle.exr", self.folder)
        (self.folder / "t.mtl").write_text("newmtl a\nKd 1 1 1\nKs 1 1 1\nmap_Kd palette8.png\nmap_Ks color420.jpg\nbump triangle.exr\n")
        (self.folder / "t.obj").write_text("mtllib t.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        for words, numbers in ((f"{ROOT}/tests/fuzz/corpus/3mf/deflated.3mf -s 8", range(40, 160, 1 + 2 * (not LONG))), ("t.obj -s 8", range(1, 400, 1 + 6 * (not LONG))),
                               ("compare cube.obj -s 8", range(1, 700, 1 + 19 * (not LONG)))):
            usual = self.good(*words.split(), "-o", "-").stdout
            for number in numbers:
                done = self.strange(f"malloc={{ENOMEM}}@{number}", words + " -j 1 -o - --sandbox off")
                self.assertIn((done.returncode, done.stdout), ((0, usual), (4, b""), (4, usual)), (words, number, done.stderr))

    @unittest.skipUnless(HAS_SANDBOX, "no sandbox here")
    def test_kernels(self):
        """What --version reports, and what `require` refuses."""
        for what, active, says in (("", "Landlock", None), ("landlock={ENOSYS}", "seccomp; the kernel does not support Landlock", "does not support Landlock"),
                                   ("seccomp={EINVAL}", "; the kernel does not support seccomp", "does not support seccomp"),
                                   ("landlock={ENOSYS} seccomp={EINVAL}", "sandbox off", "supports neither"),
                                   ("landlock-create={EPERM}", None, "refuses Landlock"), ("landlock-enter={E2BIG}", None, "refuses Landlock"),
                                   ("privileges={EINVAL}", None, "drop privileges")):
            for user in {None, self.plain_user()}:
                version = self.strange(what, "--version", user=user).stdout.decode()
                self.assertIn(active or "", version)
                done = self.strange(what, "cube.obj -s 16 -o - --sandbox require", user=user)
                self.assertEqual(done.returncode, 3 if says else 0, (what, done.stderr))
                self.assertIn(says or "", done.stderr.decode())
                self.assertEqual(self.strange(what, "cube.obj -s 16 -o -", user=user).returncode, 0)


class Pipes(Case):
    def test_non_blocking(self):
        """A pipe that another process has made non-blocking, read slowly."""
        picture = self.good("teapot", "-s", 900, "-o", "-").stdout
        self.assertGreater(len(picture), 1 << 16)
        read, write = os.pipe()
        os.set_blocking(write, False)
        process = subprocess.Popen([PROGRAM, "teapot", "-s", "900", "-o", "-", "-q"], stdout=write)
        os.close(write)
        time.sleep(0.5)
        with open(read, "rb") as file:
            self.assertEqual(file.read(), picture)
        self.assertEqual(process.wait(), 0)


class Kills(Case):
    """Processes that are killed at any moment, the program's own processes among them."""

    def kill(self, process):
        """Kills the program or one of its processes. Returns whether it was the program."""
        time.sleep(random.random() * 0.4)
        victim = process.pid
        if process.poll() is None and random.random() < 0.6:
            victim = random.choice([*map(int, pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()), process.pid])
        with contextlib.suppress(ProcessLookupError):
            os.kill(victim, signal.SIGKILL)
        return victim == process.pid

    def test_merge(self):
        """A merged journal, or a page of a journal, is the old one or the new one."""
        self.good("batch", "cube.obj", "-s", 8, "-o", "out/{stem}.png", "--journal", "out/lambent.jsonl")
        journal = self.folder / "out/lambent.jsonl"
        first, line, last = journal.read_bytes().splitlines(True)[:3]
        journal.write_bytes(first + b"".join(line.replace(b"cube", b"cube%d" % i) for i in range(20000)) + last)
        for words in (["-o", "new"], ["--report", "new"]):
            self.good("journal", "out", *words)
            new = (self.folder / "new").read_bytes()
            for number in range(KILLS):
                (self.folder / "new").write_bytes(b"old")
                process = subprocess.Popen([PROGRAM, "journal", "out", *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.kill(process)
                process.wait()
                self.assertIn((self.folder / "new").read_bytes(), (b"old", new))
            self.assertFalse(list(self.folder.glob(".lambent-*")))

    def test_worker(self):
        """After a kill, each picture is whole, and each job of a surviving worker has one answer."""
        for number in range(KILLS):
            words = ([], ["--isolate", "-j", "3"], ["--sandbox", "off"])[number % 3]
            out = self.folder / f"out{number}"
            out.mkdir()
            process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", "--allow-path", ".", "-s", "200", *words], cwd=self.folder, stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            for job in range(30):
                process.stdin.write(json.dumps({"id": job, "model": "cube.obj", "output": f"{out.name}/{job}.png"}).encode() + b"\n")
            process.stdin.flush()
            whole = self.kill(process)
            with contextlib.suppress(BrokenPipeError):
                process.stdin.close()
            lines = process.stdout.read().splitlines(True)
            process.wait()
            process.stdout.close()
            answers = [json.loads(line) for line in lines if line.endswith(b"\n")]
            self.assertEqual(len({a["id"] for a in answers}), len(answers))
            self.assertTrue(whole or len(answers) == 30, (words, len(answers)))
            for answer in answers:
                self.assertTrue(answer["outcome"] != "written" or (out / f"{answer['id']}.png").exists(), answer)
            for path in out.glob("*.png"):
                read_png(path.read_bytes())


@unittest.skipUnless(shutil.which("bwrap"), "bubblewrap is not installed")
class Bare(Case):
    def test_no_home_and_no_tmp(self):
        """Without /tmp and /home, with a read-only current folder: everything works that writes to a folder that exists."""
        if subprocess.run(["bwrap", "--ro-bind", "/", "/", "--unshare-all", "true"], capture_output=True).returncode:
            self.skipTest("bubblewrap cannot make a sandbox here")
        (self.folder / "out").mkdir()
        links = [word for name in ("/lib", "/lib64", "/bin") for word in (("--symlink", os.readlink(name), name) if os.path.islink(name) else ("--ro-bind-try", name, name))]
        bare = ["bwrap", "--clearenv", "--setenv", "HOME", "/none", "--ro-bind", "/usr", "/usr", *links, "--proc", "/proc", "--dev", "/dev", "--unshare-all", "--die-with-parent", "--ro-bind",
                pathlib.Path(PROGRAM).resolve().parent, "/opt/lambent", "--ro-bind", self.folder, "/m", "--bind", self.folder / "out", "/o", "--chdir", "/m", "/opt/lambent/lambent"]
        for words, code in (("cube.obj -s 8 -o /o/a.png", 0), ("cube.obj -s 8 -o -", 0), ("cube.obj -s 8", 5), ("batch cube.obj cube.stl -s 8 --isolate -o /o/{stem}{ext}.png", 0),
                            ("convert cube.obj /o/c.obj", 0), ("diff cube.obj cube.obj -s 8 -o /o/d.html", 0), ("hash cube.obj -s 8 -o /o/h.hash", 0), ("config", 0), ("info cube.obj", 0)):
            done = subprocess.run([*bare, *words.split()], capture_output=True)
            self.assertEqual(done.returncode, code, (words, done.stderr))
            self.assertIn("Read-only file system" if code else "", done.stderr.decode())
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["a.png", "c.mtl", "c.obj", "cubeobj.png", "cubestl.png", "d.html", "h.hash", "lambent.jsonl"])
