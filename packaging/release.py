#!/usr/bin/env python3
"""release.py [FOLDER]: builds a complete release in FOLDER (dist): the source, the Debian packages, the static programs, the changes, and checksums
(make release). It releases the committed tree, with the version in meson.build.

release.py --notes prints the changes: the section of CHANGELOG.md, and the pictures of tests/images that differ from the last release (the newest tag
vX.Y.Z), by name."""
import hashlib
import pathlib
import platform
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MACHINES = ("x86_64", "aarch64")  # of the static programs
EXPECTED = "tests/images/expected/hashes.txt"  # one line for each picture: its name, and the hash of its bytes


def git(*words, root=ROOT):
    return subprocess.run(["git", "-C", str(root), *words], stdout=subprocess.PIPE, check=True, text=True).stdout


def version(root=ROOT):
    return re.search(r"^  version: '(.*)',", (root / "meson.build").read_text(), re.M)[1]


def section(root=ROOT):
    """The section of the change log about this version."""
    text = (root / "CHANGELOG.md").read_text()
    found = re.search(r"(?ms)^## %s\b[^\n]*\n(.*?)(?=^## |\Z)" % re.escape(version(root)), text)
    if not found:
        sys.exit("release: CHANGELOG.md has no section %s" % version(root))
    return found[1].strip()


def last_release(root=ROOT):
    tags = [tag for tag in git("tag", "--list", "v*", "--sort=-version:refname", root=root).split() if tag != "v" + version(root)]
    return tags[0] if tags else None


def hashes(text):
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {row[0]: row[1:] for row in rows}


def changed_pictures(tag, root=ROOT):
    """The pictures whose recorded bytes differ from a tag's, with one of the words new, changed and gone."""
    before, now = hashes(git("show", "%s:%s" % (tag, EXPECTED), root=root)), hashes((root / EXPECTED).read_text())
    words = {name: "new" if name not in before else "gone" if name not in now else "changed" for name in before.keys() | now.keys()
             if before.get(name) != now.get(name)}
    return sorted(words.items())


def notes(root=ROOT):
    tag = last_release(root)
    lines = ["# Lambent " + version(root), "", section(root), "", "## Pictures", ""]
    if not tag:
        return "\n".join(lines + ["This is the first release."]) + "\n"
    rows = changed_pictures(tag, root)
    lines.append("Against %s, of the pictures that the tests hold to their bytes:" % tag if rows else "The pictures are those of %s, byte for byte." % tag)
    return "\n".join(lines + [""] * bool(rows) + ["- %s: %s" % row for row in rows]) + "\n"


def run(*command):
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("release: %s failed:\n%s" % (" ".join(map(str, command)), done.stdout[-3000:]))


def main():
    if sys.argv[1:] == ["--notes"]:
        print(notes(), end="")
        return
    dist = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "dist").resolve()
    if git("status", "--porcelain"):
        sys.exit("release: the tree has changes that are not committed")
    text = notes()
    shutil.rmtree(dist, ignore_errors=True)
    dist.mkdir(parents=True)
    name = "lambent-" + version()
    run("git", "archive", "--format=tar.gz", "--prefix=%s/" % name, "-o", dist / (name + ".tar.gz"), "HEAD")
    run(ROOT / "packaging" / "deb.sh", ROOT / "build-deb")
    for path in sorted((ROOT / "build-deb").glob("*.deb")):
        if "dbgsym" not in path.name:
            shutil.copy(path, dist)
    for machine in MACHINES:
        folder = ROOT / ("build-static" + "-%s" % machine * (machine != platform.machine()))
        run(sys.executable, ROOT / "packaging" / "static.py", folder, machine)
        shutil.copy(folder / "lambent", dist / ("%s-%s-linux" % (name, machine)))
    shutil.copy(folder / "LICENCES", dist / ("%s-linux-licences.txt" % name))
    (dist / "NOTES.md").write_text(text)
    files = sorted(path for path in dist.iterdir())
    sums = "".join("%s  %s\n" % (hashlib.sha256(path.read_bytes()).hexdigest(), path.name) for path in files)
    (dist / "SHA256SUMS").write_text(sums)
    for path in files:
        print("%9.1f kB  %s" % (path.stat().st_size / 1e3, path.name))


if __name__ == "__main__":
    main()
