#!/usr/bin/env python3
"""windows.py [FOLDER]: Lambent for Windows on x86-64 in FOLDER (build-windows): FOLDER/lambent.exe and the library, FOLDER/lambent.dll, by
mingw-w64 (make windows). The libraries are those of the module for the web (web/libraries.py), compiled from Debian's source packages."""
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "web"))
import libraries  # noqa: E402

PREFIX = "x86_64-w64-mingw32-"
COMPILER = PREFIX + "gcc-posix"
PROGRAMS = {COMPILER: "gcc-mingw-w64-x86-64-posix", "dpkg-source": "dpkg-dev", "meson": "meson", "ninja": "ninja-build"}


def missing():
    """The packages that are not installed."""
    return [package for program, package in PROGRAMS.items() if not shutil.which(program)]


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("windows: %s failed:\n%s" % (" ".join(map(str, command[:4])), done.stdout[-4000:]))
    return done.stdout


def build(folder):
    """Builds what is not up to date, and returns the folder of the build."""
    folder.mkdir(parents=True, exist_ok=True)
    libraries.CLANG, libraries.ARCHIVER, libraries.SIZE_T = COMPILER, PREFIX + "ar", "8"
    libraries.FLAGS = ["-DNDEBUG", "-D__USE_MINGW_ANSI_STDIO=1", "-DSPNG_STATIC", "-ffp-contract=off", "-w"]
    libraries.make(str(folder))
    places = folder / "places.ini"
    places.write_text("[constants]\nroot = '%s'\nheaders = '%s'\n" % (folder / "root", ROOT / "src/base/system/windows/include"))
    made = folder / "build"
    if not (made / "build.ninja").exists():
        shutil.rmtree(made, ignore_errors=True)
        call("meson", "setup", str(made), str(ROOT), "--cross-file", str(places), "--cross-file", str(ROOT / "packaging/windows.ini"),
             "--buildtype=release", "-Dtests=false", "-Dclassroom=false")
    output = call("ninja", "-C", str(made))
    if "warning:" in output:
        sys.exit("windows: the compiler warns:\n" + output[-4000:])
    return made


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build-windows").resolve()
    if missing():
        sys.exit("windows: not installed: " + " ".join(missing()))
    made = build(folder)
    for name in ("lambent.exe", "src/lambent.dll"):
        target = folder / pathlib.Path(name).name
        call(PREFIX + "strip", "-o", str(target), str(made / name))
        print("%s: %.1f MB" % (target, target.stat().st_size / 1e6))
    shutil.copy(made / "src/lambent.dll.a", folder)


if __name__ == "__main__":
    main()
