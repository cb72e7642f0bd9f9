#!/usr/bin/env python3
"""static_program.py PROGRAM: the program of `make static`: one file of at most 9 MB that needs no other, draws in an empty root what PROGRAM draws, byte for
byte, and refuses what it does not contain with exit code 3. The empty root needs the rights of root; without them it runs where it is."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv[1]).resolve()
CORPUS = ROOT / "tests" / "fuzz" / "corpus"
MODELS = [*sorted((ROOT / "tests" / "models").glob("cube.*")), ROOT / "examples" / "models" / "spot.glb", CORPUS / "gltf" / "meshopt.gltf",
          CORPUS / "gltf" / "draco.gltf", CORPUS / "3mf" / "deflated.3mf"]
# The ending of the picture and the words before it; "": the words alone.
DRAWN = [(".png", ["cube.obj"]), (".webp", ["spot.glb"]), (".jpg", ["spot.glb"]), (".png", ["meshopt.gltf"]), (".png", ["cube.ply", "--edges", "all", "--shadows"]),
         (".png", ["cube.stl", "--compress", "best"]), (".webp", ["cube.stl", "--turntable", "3"]), (".png", ["teapot", "--material", "gold"])]
REFUSED = [["draco.gltf", "-o", "x.png"], ["deflated.3mf", "-o", "x.png"], ["cube.obj", "-o", "x.exr"], ["cube.obj", "--device", "gl", "-o", "x.png"], ["view", "cube.obj"]]
failed = 0
number = 0


def report(title, ok, output=""):
    global failed, number
    number += 1
    failed += not ok
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-30:]))
    print("%s %d - %s" % ("ok" if ok else "not ok", number, title))
    sys.stdout.flush()


def run(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)
    return done.returncode, done.stdout


def main():
    folder = pathlib.Path(os.environ.get("LAMBENT_STATIC", ROOT / "build-static"))
    code, text = run(sys.executable, ROOT / "packaging" / "static.py", folder)
    report("make static builds the program", code == 0, text)
    if code:
        return 1
    program = folder / "lambent"
    report("it has at most 9 MB", program.stat().st_size <= 9_000_000, str(program.stat().st_size))
    code, text = run("readelf", "-ld", program)
    report("it needs no library and no loader", "INTERP" not in text and "NEEDED" not in text, text)
    with tempfile.TemporaryDirectory(prefix="lambent-static-") as name:
        root = pathlib.Path(name)
        for path in [program, *MODELS]:
            shutil.copy(path, root)
        before = ["chroot", str(root), "/lambent"] if os.geteuid() == 0 else [str(root / "lambent")]
        code, text = run(*before, "--version", cwd=root)
        report("--version lists what it contains", code == 0 and "static, with FreeType" in text and "without OpenGL" in text, text)
        for i, (ending, words) in enumerate(DRAWN):
            code, text = run(*before, *words, "-q", "-s", "120", "-o", f"picture{i}{ending}", cwd=root)
            other, more = run(PROGRAM, *words, "-q", "-s", "120", "-o", f"other{i}{ending}", cwd=root)
            same = code == other == 0 and (root / f"picture{i}{ending}").read_bytes() == (root / f"other{i}{ending}").read_bytes()
            report("%s to %s: the same bytes" % (" ".join(words), ending), same, text + more)
        for words in REFUSED:
            code, text = run(*before, *words, "-q", cwd=root)
            report("%s: refused" % " ".join(words), code == 3 and text.count("\n") == 1 and not (root / "x.png").exists(), "exit code %d: %s" % (code, text))
    if shutil.which("buildah") and os.geteuid() == 0 and folder == ROOT / "build-static":
        code, text = run("buildah", "--storage-driver", "vfs", "build", "--no-cache", "--isolation", "chroot", "-f", "packaging/ci/Containerfile", "-t", "lambent-test", ".", cwd=ROOT)
        report("the container file builds, and draws", code == 0 and "/tmp/cube.png  64x64" in text, text)
        run("buildah", "--storage-driver", "vfs", "rmi", "lambent-test")
    else:
        print("# the container is not built: buildah, the rights of root or build-static is missing")
    print("1..%d" % number)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
