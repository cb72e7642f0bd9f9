#!/usr/bin/env python3
"""table.py PROGRAM [ROW…]: tests every artefact of docs/install.md, or only the named rows, and prints a table (make test-packages). It builds each
artefact twice, here and in an unpacked source archive in another folder, and compares the bytes; the scripts of ROWS install, use and remove what was
built here. A cell says "not run" if
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
    "wheel": (["python"], ["build-python/*.whl"], ["long/wheel.py", PROGRAM], ["page", "man, completion"]),
    "npm": (["npm"], ["build-web/*.tgz"], ["npm.py", PROGRAM], ["page", "man, completion"]),
    "page": (["web"], ["build-web/lambent.html", "build-web/page/*"], ["long/page.py", PROGRAM], ["man, completion", "removed"]),
    "site": (["site"], ["build-site/**/*"], ["test_site.py", PROGRAM], [*DRAWN, "man, completion", "removed"]),
    "static, x86-64": (["static"], ["build-static/lambent", "build-static/LICENCES"], ["long/static_program.py", PROGRAM], FILE),
    "static, aarch64": (["static", "machine=aarch64"], ["build-static-aarch64/lambent"], None, FILE),
    "packages, Debian 12": (["deb"], ["build-deb/*.deb"], ["long/packages.py", PROGRAM], []),
    "packages, Debian 13": (None, [], None, ["equal twice"]),
    "Windows": (["windows"], ["build-windows/lambent.exe", "build-windows/lambent.dll"], ["long/windows_program.py", PROGRAM], FILE),
}


def run(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)
    return done.returncode, done.stdout


def sums(tree, patterns):
    return {str(path.relative_to(tree)): hashlib.sha256(path.read_bytes()).hexdigest() for pattern in patterns for path in tree.glob(pattern)
            if path.is_file() and "dbgsym" not in path.name}


def build(cells, row, tree):
    """Builds a row here and in TREE."""
    target, files, _, _ = ROWS[row]
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


def groups():
    """The chosen rows, in lists: a row with a test, and the rows after it whose cells the same test fills."""
    lists = []
    for name, (_, _, test, _) in ROWS.items():
        if test:
            lists.append([])
        lists[-1].append(name)
    wanted = sys.argv[2:] or list(ROWS)
    unknown = set(wanted) - set(ROWS)
    if unknown:
        sys.exit("table: there is no row %s; expected %s" % (", ".join(sorted(unknown)), ", ".join(ROWS)))
    return [names for names in lists if set(names) & set(wanted)]


def table(cells, rows):
    lines = [["", *COLUMNS]] + [[row, *(cells.get((row, column), "").split(":")[0] for column in COLUMNS)] for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return "\n".join("# | %s |" % " | ".join(text.ljust(width) for text, width in zip(line, widths)) for line in lines)


def test(cells, rows):
    """Runs the test of a list of rows, which fills their cells. Returns the failures."""
    script, *words = ROWS[rows[0]][2]
    code, text = run(sys.executable, ROOT / "tests" / script, *words, cwd=ROOT)
    for name, column, state in re.findall(r"^cell: (.*?) \| (.*?) \| (.*)$", text, re.M):
        cells[name, column] = state
    if code:
        print("# " + "\n# ".join(text.splitlines()[-60:]), flush=True)
    return ["%s: %s" % (script, line) for line in re.findall(r"^not ok .*", text, re.M)] + ["%s: exit code %d" % (script, code)] * (code != 0)


def main():
    chosen, failures = groups(), []
    rows = [row for names in chosen for row in names]
    cells = {(row, column): "–" for row in rows for column in ROWS[row][3]}
    if run("git", "-C", ROOT, "status", "--porcelain")[1]:
        sys.exit("table: the tree has changes that are not committed")
    with tempfile.TemporaryDirectory(prefix="lambent-table-") as folder:
        tree = pathlib.Path(folder, "another-folder")
        project.tree(tree)
        for names in chosen:
            for row in names:
                if ROWS[row][0]:
                    build(cells, row, tree)
            failures += test(cells, names)
            print(table(cells, names), flush=True)
    print(table(cells, rows))
    number = 0
    for row in rows:
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
