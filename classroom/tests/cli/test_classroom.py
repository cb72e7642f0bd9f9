# test_classroom.py: lambent starts lambent-classroom beside itself, with the same command line, streams, signals and exit codes, and never another
# program of that name. Without it, a message names the package.
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from harness import PROGRAM, Case

CLASSROOM = str(pathlib.Path(PROGRAM).with_name("lambent-classroom"))
FAKE = "#!/bin/sh\necho fake >&2\nexit 77\n"
# A command line for each way to start the program.
STARTS = [("plot", "spot", "-o", "out.png"), ("check", "none.frag"), ("explain", "cube", "8,8", "-s", "16", "-o", "out.png"), ("shader", "--mistake", "list"),
          ("generate", "contract-schema")]


class Classroom(Case):
    def install(self, *names, folder="bin"):
        """Copies of the programs, beside each other."""
        (self.folder / folder).mkdir(parents=True, exist_ok=True)
        for name in names:
            shutil.copy(pathlib.Path(PROGRAM).with_name(name), self.folder / folder)
        return str(self.folder / folder / "lambent")

    def fake(self, path):
        (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / path).write_text(FAKE)
        (self.folder / path).chmod(0o755)

    def run_in(self, program, *words, cwd=None, **more):
        return subprocess.run([program, *words], cwd=cwd or self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)

    def test_same_as_by_itself(self):
        for words in (("plot", "spot", "--json", "-o", "a.svg"), ("plot", "spt"), ("plot", "attenuation", "1/0/0/x"), ("check", "none.frag", "--json"),
                      ("check", "--list"), ("generate", "contract-nyu"), ("generate", "contract-none"), ("check", "-h"), ("plot", "--tilt"), ("plot",)):
            by_lambent, alone = (self.run_in(program, *words) for program in (PROGRAM, CLASSROOM))
            self.assertEqual((by_lambent.returncode, by_lambent.stdout, by_lambent.stderr), (alone.returncode, alone.stdout, alone.stderr), words)
        self.assertEqual(self.run_in(CLASSROOM, "teapot").returncode, 1)
        self.assertIn("lambent check", self.run_in(CLASSROOM, "--help").stdout)

    def test_contracts_that_completion_offers(self):
        listed = [line.split()[1].rstrip(":") for line in self.good("check", "--list").stdout.decode().splitlines() if line.startswith("contract ")]
        offered = [line.split("\t")[0] for line in self.good("complete", "--", "check", "--contract", "").stdout.decode().splitlines()]
        self.assertEqual(offered[:len(listed) + 1], ["auto", *listed])

    def test_missing(self):
        """No other program of that name runs: in the current folder, in PATH, or below the folder."""
        alone = self.install("lambent")
        for path in ("lambent-classroom", "path/lambent-classroom", "bin/classroom/lambent-classroom"):
            self.fake(path)
        environment = {**os.environ, "PATH": "%s:.:%s" % (self.folder / "path", os.environ["PATH"])}
        for words in STARTS:
            for program, cwd in ((alone, self.folder), ("./lambent", self.folder / "bin")):
                done = self.run_in(program, *words, cwd=cwd, env=environment)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), (words, done.stderr))
                self.assertIn("install the package lambent-classroom", done.stderr)
                self.assertFalse((cwd / "out.png").exists())
        self.assertIn('"exit": 3', self.run_in(alone, "plot", "spot", "--json").stdout)
        self.assertEqual(self.run_in(alone, "check", "--help").returncode, 0)
        self.assertIn("tolerance", self.run_in(alone, "complete", "--", "check", "--tol").stdout)
        self.assertEqual(self.run_in(alone, "explain", "cube", "8,8", "-s", "16").returncode, 0)

    def test_found(self):
        """Beside the program's file, also through a link; then in libexec."""
        self.install("lambent", "lambent-classroom")
        (self.folder / "links").mkdir()
        (self.folder / "links" / "l").symlink_to("../bin/lambent")
        self.fake("links/lambent-classroom")
        other = self.install("lambent", folder="other/bin")
        self.install("lambent-classroom", folder="other/libexec/lambent")
        for program in (str(self.folder / "links" / "l"), other):
            done = self.run_in(program, "plot", "spot", "-o", "a.svg")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("below 1/255", done.stdout)

    def test_damaged_figure(self):
        """A process that ends without a figure, or answers something else, is reported, and leaves no file."""
        program = self.install("lambent")
        for script in (FAKE, "#!/bin/sh\nkill -9 $$\n", "#!/bin/sh\nexec true\n", "#!/bin/sh\ncat >/dev/null; echo 1234567890\n"):
            (self.folder / "bin" / "lambent-classroom").write_text(script)
            (self.folder / "bin" / "lambent-classroom").chmod(0o755)
            done = self.run_in(program, "explain", "cube", "8,8", "-s", "16", "-o", "out.png")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("figure", done.stderr)
            self.assertFalse((self.folder / "out.png").exists())
        for request in (b"{}\n{}\n", b"\n", b'{"svg": true}\n{"width": 65535, "height": 65535, "shading": "phong"}\n1234'):
            done = subprocess.run([CLASSROOM, "explain", "cube", "8,8"], input=request, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual((done.returncode, done.stderr), (1, b""))
            self.assertIn(b"same version", done.stdout)

    def test_no_request(self):
        """If lambent fails before the figure, it alone reports the error, even if SIGPIPE is ignored."""
        done = self.run_in("/bin/sh", "-c", "trap '' PIPE; exec \"$0\" explain none.obj 1,1 -o out.png", PROGRAM)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)

    def test_signals(self):
        """The program takes the place of lambent: the same process, which ends by the signal."""
        process = subprocess.Popen([PROGRAM, "check", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        name = pathlib.Path(f"/proc/{process.pid}/comm")
        for _ in range(500):
            if name.read_text().startswith("lambent-classro"):
                break
            time.sleep(0.01)
        self.assertTrue(name.read_text().startswith("lambent-classro"))
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=20)
        self.assertEqual(process.returncode, -signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
