#!/usr/bin/env python3
"""table.py PROGRAM: tests every artefact of docs/install.md, and prints a table of them (make test-packages). It builds each twice, here and in an
unpacked source archive in another folder, and compares the bytes; the scripts of ROWS install, use and remove what was built here. A cell says "not run" if
its test was skipped. An empty cell, or "no", is a failure. It needs the committed tree, and up to two hours."""
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "scripts"))
import project  # noqa: E402

DRAWN = ["glTF", "OBJ with texture", "PLY", "STL", "3MF", "Draco"]
COLUMNS = ["builds", "equal twice", "installs", *DRAWN, "page", "man, completion", "removed"]
# Row: the target of make, its files, the test that fills the other cells, and the columns that do not apply: a single file has no manual, and the page
# needs a server or a package.
FILE = ["page", "man, completion", "removed"]
ROWS = {
    "packages, Debian 12": (["deb"], ["build-deb/*.deb"], ["long/packages.py", PROGRAM], []),
    "packages, Debian 13": (None, [], None, ["equal twice"]),
    "static, x86-64": (["static"], ["build-static/lambent", "build-static/LICENCES"], ["long/static_program.py", PROGRAM], FILE),
    "static, aarch64": (["static", "machine=aarch64"], ["build-static-aarch64/lambent"], None, FILE),
    "Windows": (["windows"], ["build-windows/lambent.exe", "build-windows/lambent.dll"], ["long/windows_program.py", PROGRAM], FILE),
    "wheel": (["python"], ["build-python/*.whl"], ["long/wheel.py", PROGRAM], ["page", "man, completion"]),
    "npm": (["npm"], ["build-web/*.tgz"], ["npm.py", PROGRAM], ["page", "man, completion"]),
    "page": (["web"], ["build-web/lambent.html", "build-web/page/*"], ["long/page.py", PROGRAM], ["man, completion", "removed"]),
    "site": (["site"], ["build-site/**/*"], ["test_site.py", PROGRAM], [*DRAWN, "man, completion", "removed"]),
}


def run(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)
    return done.returncode, done.stdout


def sums(tree, patterns):
    return {str(path.relative_to(tree)): hashlib.sha256(path.read_bytes()).hexdigest() for pattern in patterns for path in tree.glob(pattern)
            if path.is_file() and "dbgsym" not in path.name}


def build(cells, tree):
    """Builds all rows here and in TREE."""
    for row, (target, files, _, _) in ROWS.items():
        if not target:
            continue
        outputs = []
        for place in (tree, ROOT):
            code, text = run("make", "-C", place, *target)
            outputs.append(sums(place, files) if code == 0 else None)
            if code:
                print("# %s in %s:\n# %s" % (row, place, "\n# ".join(text.splitlines()[-20:])), flush=True)
        cells[row, "builds"] = "yes" if outputs[0] else "no"
        same = outputs[0] and outputs[0] == outputs[1]
        cells[row, "equal twice"] = "yes" if same else "no"
        if outputs[0] and outputs[1] and not same:
            print("# %s differs: %s" % (row, sorted(name for name in outputs[0].keys() | outputs[1] if outputs[0].get(name) != outputs[1].get(name))), flush=True)


def table(cells):
    rows = [["", *COLUMNS]] + [[row, *(cells.get((row, column), "").split(":")[0] for column in COLUMNS)] for row in ROWS]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("# | %s |" % " | ".join(text.ljust(width) for text, width in zip(row, widths)) for row in rows)


def main():
    cells = {(row, column): "–" for row, (_, _, _, without) in ROWS.items() for column in without}
    if run("git", "-C", ROOT, "status", "--porcelain")[1]:
        sys.exit("table: the tree has changes that are not committed")
    failures = []
    with tempfile.TemporaryDirectory(prefix="lambent-table-") as folder:
        tree = pathlib.Path(folder, "another-folder")
        project.tree(tree)
        build(cells, tree)
    for row, (_, _, test, _) in ROWS.items():
        if not test:
            continue
        code, text = run(sys.executable, ROOT / "tests" / test[0], *test[1:], cwd=ROOT)
        for name, column, state in re.findall(r"^cell: (.*?) \| (.*?) \| (.*)$", text, re.M):
            cells[name, column] = state
        failures += ["%s: %s" % (test[0], line) for line in re.findall(r"^not ok .*", text, re.M)]
        if code:
            failures.append("%s: exit code %d" % (test[0], code))
            print("# " + "\n# ".join(text.splitlines()[-60:]), flush=True)
    print(table(cells))
    number = 0
    for row in ROWS:
        for column in COLUMNS:
            state, number = cells.get((row, column), "empty"), number + 1
            if state == "–":
                continue
            print("%s %d - %s: %s: %s" % ("not ok" if state in ("no", "empty") else "ok", number, row, column, state.replace("not run:", "not run # SKIP")))
            failures += [row] * (state in ("no", "empty"))
    for failure in failures:
        print("# failed: " + failure)
    print("%s %d - the tests of the artefacts\n1..%d" % ("not ok" if failures else "ok", number + 1, number + 1))
    return 1 if failures else 0


if __name__ == "__main__":
    os.environ.pop("MAKEFLAGS", None)
    sys.exit(main())
