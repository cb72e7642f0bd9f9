#!/usr/bin/env python3
"""wheel.py PROGRAM: tests the wheel of `make python` as its users have it: in a new virtual environment, where pip installs and removes it. It prints its
cells of tests/long/table.py. NumPy and cffi are the system's, so no network is needed. The test is skipped without Debian's python3-venv."""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/long"))
import cells  # noqa: E402

failed = number = 0


def report(title, done):
    global failed, number
    number += 1
    failed += done.returncode != 0
    print("%sok %d - %s" % ("not " * (done.returncode != 0), number, title))
    if done.returncode:
        print("# " + "\n# ".join(done.stdout.splitlines()[-20:]))
    return done.returncode


def run(*words, **more):
    return subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def main():
    if report("make python builds it", run("make", "-C", ROOT, "python")):
        return 1
    wheel = next(ROOT.glob("build-python/*.whl"))
    with tempfile.TemporaryDirectory(prefix="lambent-wheel-") as name:
        folder, models = pathlib.Path(name, "venv"), pathlib.Path(name, "models")
        made = run("/usr/bin/python3", "-m", "venv", "--system-site-packages", folder)
        if made.returncode:
            cells.skip("wheel", "python3-venv is not installed", ["removed"])
            print("ok 2 - a virtual environment # SKIP python3-venv is not installed\n1..2")
            return 0
        installed = report("pip installs it", run(folder / "bin/pip", "install", "--no-index", wheel))
        cells.tell("wheel", "installs", "no" if installed else "yes")
        models.mkdir()
        code = "import sys, lambent; lambent.render(sys.argv[1], %d).save(sys.argv[2])" % cells.SIZE
        wrong = cells.draw_all("wheel", sys.argv[1], models, lambda model, picture: run(folder / "bin/python", "-c", code, model, picture, cwd=models).returncode)
        report("each format has the program's bytes", subprocess.CompletedProcess("", bool(wrong), ", ".join(wrong)))
        gone = run(folder / "bin/pip", "uninstall", "-y", "lambent")
        left = [str(path) for path in folder.rglob("*lambent*")]
        cells.tell("wheel", "removed", "no" if report("pip removes all of it", subprocess.CompletedProcess("", gone.returncode or bool(left), gone.stdout + "\n".join(left))) else "yes")
    print("1..%d" % number)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
