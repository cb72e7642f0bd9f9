#!/usr/bin/env python3
"""make_wheel.py BUILD FOLDER: builds the wheel from the library in Meson's build folder BUILD, and leaves the wheel and its inputs in FOLDER (make
python)."""
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import project  # noqa: E402


def build(library, folder):
    """The path of the new wheel. The same sources give the same bytes, because it uses the commit's time."""
    folder = pathlib.Path(folder).resolve()
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.whl"):
        old.unlink()
    done = subprocess.run([sys.executable, "setup.py", "-q", "egg_info", "--egg-base", folder, "build", "--build-base", folder / "build", "bdist_wheel",
                           "--bdist-dir", folder / "wheel", "--dist-dir", folder], cwd=ROOT / "python", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={"SOURCE_DATE_EPOCH": str(project.time()), **os.environ, "LAMBENT_BUILD": str(pathlib.Path(library).resolve())})
    if done.returncode:
        raise RuntimeError(done.stdout)
    return next(folder.glob("*.whl"))


if __name__ == "__main__":
    try:
        print("The wheel: %s" % os.path.relpath(build(*sys.argv[1:3])))
    except RuntimeError as error:
        sys.exit("make_wheel.py: %s" % error)
