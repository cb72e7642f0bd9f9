#!/usr/bin/env python3
"""windows_program.py PROGRAM: tests Lambent for Windows (make windows) with Wine. The image table has the recorded hashes for each instruction set,
with one thread and with four. The program draws the same bytes as PROGRAM, with file names in any script, with pipes, over an older file and from a
program that uses the library; it refuses unsupported features with an error message and exit code 3."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "packaging"), str(ROOT / "tests" / "long")]
import static_program  # noqa: E402
import windows  # noqa: E402
import cells  # noqa: E402
from static_program import PROGRAM, report, words_of  # noqa: E402

FOLDER = ROOT / "build-windows"
WINE = shutil.which("wine64") or "/usr/lib/wine/wine64"
REFUSED = [*static_program.REFUSED, ["check", "lambent.frag"], ["cube.obj", "--sandbox", "require", "-o", "x.png"], ["batch", "cube.obj", "--isolate", "-o", "x.png"]]
SIZE_MAX = 9_000_000
environment = {**os.environ, "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "winemenubuilder.exe,mscoree,mshtml=", "LC_ALL": "C.UTF-8"}


def run(*command, **more):
    """Returns the exit code, standard output as bytes, and the errors as text."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment, **more)
    return done.returncode, done.stdout, done.stderr.decode(errors="replace")


def lambent(root, *words, **more):
    return run(WINE, FOLDER / "lambent.exe", *words, cwd=root, **more)


def try_hashes():
    """Each line of the program is compared with the recorded one."""
    recorded = dict(line.split(" ", 1) for line in (ROOT / "tests/images/expected/hashes.txt").read_text().splitlines())
    for threads in ("1", "4"):
        code, out, errors = run(WINE, FOLDER / "build/tests/windows/image-hashes.exe", "0", "1", threads)
        rows = [line.split(" ", 2) for line in out.decode().splitlines()]
        wrong = [" ".join(row) for row in rows if recorded.get(row[1]) != row[2]]
        sets = {row[0] for row in rows}
        report("%d pictures of the image table, by %s threads and %d instruction sets: the recorded hashes" % (len(rows), threads, len(sets)),
               code == 0 and not wrong and len(rows) == len(recorded) * len(sets) and "scalar" in sets, errors + "\n".join(wrong))


def same(root, name, other):
    return (root / name).exists() and (root / name).read_bytes() == (root / other).read_bytes()


def try_pictures(root):
    environment["LAMBENT_FONT"] = static_program.FONT
    for i, (ending, words) in enumerate(static_program.DRAWN):
        code, _, errors = lambent(root, *words_of(words, f"picture{i}{ending}"))
        other, _, more = run(PROGRAM, *words_of(words, f"other{i}{ending}"), cwd=root)
        report("%s to %s: the same bytes" % (" ".join(words), ending), code == other == 0 and same(root, f"picture{i}{ending}", f"other{i}{ending}"), errors + more)


def try_names(root):
    """File names, pipes, and existing files."""
    run(PROGRAM, "cube.obj", "-s", "120", "-o", "cube.png", cwd=root)
    run(PROGRAM, "cube.stl", "-s", "120", "-o", "stl.png", cwd=root)
    folder = root / "größe 模型"
    folder.mkdir()
    for name in ("cube.obj", "cube.mtl"):
        shutil.copy(root / name, folder)
    code, _, errors = lambent(root, "größe 模型/cube.obj", "-q", "-s", "120", "-o", "größe 模型/図.png")
    report("names in any script", code == 0 and same(root, "größe 模型/図.png", "cube.png"), errors)
    code, _, errors = lambent(root, "größe 模型\\cube.obj", "-q", "-s", "120", "-o", "Z:" + str(root).replace("/", "\\") + "\\drive.png")
    report("backslashes and drives", code == 0 and same(root, "drive.png", "cube.png"), errors)
    deep = "/".join(["x" * 60] * 5)
    (root / deep).mkdir(parents=True)
    for name in ("cube.obj", "cube.mtl"):
        shutil.copy(root / name, root / deep)
    code, _, errors = lambent(root, deep + "/cube.obj", "-q", "-s", "120", "-o", deep + "/cube.png")
    report("a path of more than 260 letters", code == 0 and same(root, deep + "/cube.png", "cube.png"), errors)
    (root / "old.png").write_text("an older file\r\n")
    code, _, errors = lambent(root, "cube.obj", "-q", "-s", "120", "-o", "old.png")
    report("an older file is replaced, and nothing is left beside it", code == 0 and same(root, "old.png", "cube.png") and not list(root.glob(".lambent*")), errors)
    code, out, errors = lambent(root, "cube.obj", "-q", "-s", "120", "-o", "-")
    report("a picture on standard output", code == 0 and out == (root / "cube.png").read_bytes(), errors)
    code, out, errors = lambent(root, "-", "-q", "-s", "120", "-o", "-", input=(root / "cube.stl").read_bytes())
    report("a model from a pipe", code == 0 and out == (root / "stl.png").read_bytes(), errors)
    for words in (["missing.obj"], ["größe 模型/fehlt.obj"], ["cube.obj", "-o", "none/x.png"]):
        code, _, errors = lambent(root, *words, "-q")
        other, _, more = run(PROGRAM, *words, "-q", cwd=root)
        report("%s: the same sentence and exit code" % " ".join(words), code == other != 0 and errors == more, errors + more)


def try_hash_file(root):
    code, _, errors = lambent(root, "hash", "cube.obj", "cube.stl", "-o", "hashes.txt")
    other, _, more = run(PROGRAM, "hash", "cube.obj", "cube.stl", "--check", "hashes.txt", cwd=root)
    report("hashes written on Windows match Linux", code == other == 0, errors + more)
    code, _, errors = lambent(root, "batch", "cube.obj", "cube.stl", "-q", "-s", "120", "-o", "all-{stem}-{ext}.png", "--journal", "journal.jsonl")
    report("a batch with its journal", code == 0 and same(root, "all-cube-obj.png", "cube.png") and (root / "journal.jsonl").exists(), errors)
    code, _, errors = lambent(root, "batch", "cube.obj", "cube.stl", "-s", "120", "-o", "all-{stem}-{ext}.png", "--journal", "journal.jsonl", "--resume")
    report("--resume draws nothing again", code == 0 and "2 done before" in errors, errors)


def try_library(root):
    """examples/render.c, linked with the library."""
    code, _, errors = run(windows.COMPILER, "-I", ROOT / "include", ROOT / "examples/render.c", FOLDER / "lambent.dll.a", "-o", root / "render.exe")
    shutil.copy(FOLDER / "lambent.dll", root)
    tried, _, more = run(WINE, "render.exe", "cube.obj", "library.png", cwd=root)
    native = PROGRAM.parent / "src/liblambent.so.0"
    run("cc", "-I", ROOT / "include", ROOT / "examples/render.c", native, "-Wl,-rpath," + str(native.parent), "-o", root / "render")
    run(root / "render", "cube.obj", "native.png", cwd=root)
    exported = subprocess.run([windows.PREFIX + "objdump", "-p", FOLDER / "lambent.dll"], stdout=subprocess.PIPE, text=True).stdout
    names = re.findall(r"^\s*\[ *\d+\] (\w+)$", exported, re.M)
    wanted = re.findall(r"(lam_\w+)@", (ROOT / "packaging/debian/liblambent0.symbols").read_text())
    report("examples/render.c draws by the library what it draws on Linux", code == tried == 0 and same(root, "library.png", "native.png"), errors + more)
    report("the library shows the public names alone", set(names) == set(wanted), " ".join(sorted(set(names) ^ set(wanted))))
    needed = set(re.findall(r"DLL Name: (\S+)", exported))
    report("it needs Windows' own libraries alone", needed <= {"KERNEL32.dll", "msvcrt.dll"}, str(needed))


def main():
    if windows.missing() or not os.path.exists(WINE):
        cells.skip("Windows", "mingw-w64 or Wine is not installed")
        report("Lambent for Windows # SKIP not installed: " + " ".join(windows.missing() or ["wine64"]), True)
        print("1..1")
        return 0
    built = subprocess.run([sys.executable, ROOT / "packaging/windows.py", FOLDER], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    report("make windows builds it without warnings", built.returncode == 0, built.stdout)
    notices = FOLDER / "LICENCES"
    report("the notices of its libraries are beside it", notices.exists() and all("==== " + name in notices.read_text() for name in ("libspng", "freetype", "mingw-w64-common")))
    if built.returncode == 0:
        report("the program has at most %g MB" % (SIZE_MAX / 1e6), (FOLDER / "lambent.exe").stat().st_size <= SIZE_MAX)
        with tempfile.TemporaryDirectory(prefix="lambent-windows-") as name:
            root = pathlib.Path(name) / "files"
            root.mkdir()
            environment["WINEPREFIX"] = str(pathlib.Path(name) / "wine")
            static_program.fill(root)
            shutil.copy(ROOT / "classroom/tests/check/lambent.frag", root)
            try_hashes()
            try_pictures(root)
            try_names(root)
            try_hash_file(root)
            try_library(root)
            cells.tell("Windows", "installs", "yes")
            cells.draw_all("Windows", PROGRAM, root, lambda model, picture: lambent(root, model, "-q", "-s", str(cells.SIZE), "-o", picture)[0], ["Draco"])
            for words in REFUSED:
                code, _, text = lambent(root, *words, "-q")
                report("%s: refused" % " ".join(words), code == 3 and text.count("\n") == 1 and not (root / "x.png").exists(), "exit code %d: %s" % (code, text))
            run(os.path.join(os.path.dirname(os.path.realpath(WINE)), "wineserver"), "-w") # it writes to the folder until it ends
    print("1..%d" % static_program.number)
    return static_program.failed > 0


if __name__ == "__main__":
    sys.exit(main())
