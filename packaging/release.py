#!/usr/bin/env python3
"""release.py [FOLDER]: builds a complete release of the committed tree in FOLDER (dist): all that docs/install.md lists, with its bill of materials
(CycloneDX), the changes, and checksums (make release). SIGN_KEY names the key that signs the checksums: a file of minisign, or a key of gpg.

release.py --notes prints the changes: the section of CHANGELOG.md, and the pictures of tests/images that differ from the last release (the newest tag
vX.Y.Z), by name."""
import hashlib
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / name) for name in ("scripts", "packaging", "web")]
import build as web  # noqa: E402
import project  # noqa: E402
import static  # noqa: E402
import windows  # noqa: E402
from project import version  # noqa: E402

MACHINES = ("x86_64", "aarch64")  # of the static programs
EXPECTED = "tests/images/expected/hashes.txt"  # one line for each picture: its name, and the hash of its bytes


def git(*words, root=ROOT):
    return subprocess.run(["git", "-C", str(root), *words], stdout=subprocess.PIPE, check=True, text=True).stdout


def section(root=ROOT):
    """The section of the change log about this version."""
    text = (root / "CHANGELOG.md").read_text()
    found = re.search(r"(?ms)^## %s\b[^\n]*\n(.*?)(?=^## |\Z)" % re.escape(version(root)), text)
    if not found:
        sys.exit("release: CHANGELOG.md has no section %s" % version(root))
    return found[1].strip()


def last_release(root=ROOT):
    tags = [tag for tag in git("tag", "--list", "v*", "--sort=-version:refname", root=root).split() if tag != project.tag(root)]
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
    return done.stdout


def zipped(path, files):
    """Writes a zip file of {name: file}; the same files give the same bytes."""
    date = time.gmtime(project.time())[:6]
    with zipfile.ZipFile(path, "w") as out:
        for name in sorted(files):
            info = zipfile.ZipInfo(name, date)
            info.external_attr = 0o644 << 16
            out.writestr(info, files[name].read_bytes(), zipfile.ZIP_DEFLATED)


def below(folder):
    return {str(path.relative_to(folder)): path for path in folder.rglob("*") if path.is_file()}


def build_all(dist, name):
    """Builds all files in DIST. Returns, for the files that contain code of others, the folder with its source packages, and the other packages."""
    run("git", "archive", "--format=tar.gz", "--prefix=%s/" % name, "-o", dist / (name + ".tar.gz"), "HEAD")
    for target in ("deb", "windows", "python", "npm", "site"):
        run("make", target)
    for path in sorted([*ROOT.glob("build-deb/*.deb"), *ROOT.glob("build-python/*.whl"), *ROOT.glob("build-web/*.tgz")]):
        if "dbgsym" not in path.name:
            shutil.copy(path, dist)
    parts = {}
    for machine in MACHINES:
        is_cross = machine != platform.machine()
        run("make", "static", *["machine=" + machine] * is_cross)
        folder = ROOT / ("build-static" + "-%s" % machine * is_cross)
        target = "%s-%s-linux" % (name, machine)
        shutil.copy(folder / "lambent", dist / target)
        parts[target] = (folder, static.INSIDE)
    shutil.copy(folder / "LICENCES", dist / ("%s-linux-licences.txt" % name))
    zipped(dist / (name + "-x86_64-windows.zip"), {file: ROOT / "build-windows" / file for file in ("lambent.exe", "lambent.dll", "lambent.dll.a", "LICENCES")})
    zipped(dist / (name + "-page.zip"), below(ROOT / "build-web/page"))
    zipped(dist / (name + "-site.zip"), below(ROOT / "build-site"))
    parts[name + "-x86_64-windows.zip"] = (ROOT / "build-windows", windows.INSIDE)
    for path in [*dist.glob("*-page.zip"), *dist.glob("*-site.zip"), *dist.glob("*.tgz"), *dist.glob("lambent-page_*.deb"), *dist.glob("lambent-doc_*.deb")]:
        parts[path.name] = (ROOT / "build-web", web.TOOLS)
    parts.update({path.name: (None, ["libspng0", "libjansson4", "libjpeg62-turbo", "zlib1g"]) for path in dist.glob("*.whl")})
    return parts


def materials(dist, parts):
    """The bill of materials: each file of the release, and the Debian packages whose code is in it."""
    components, links = {}, []
    for path in sorted(dist.iterdir()):
        own = {"type": "file", "bom-ref": path.name, "name": path.name, "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(path.read_bytes()).hexdigest()}]}
        folder, packages = parts.get(path.name, (None, []))
        rows = [dsc.stem.split("_", 1) + ["source"] for dsc in folder.glob("source/*.dsc")] if folder else []
        if packages:
            rows += [line.split() + ["binary"] for line in run("dpkg-query", "-W", "-f", "${Package} ${source:Version}\n", *packages).splitlines()]
        refs = ["pkg:deb/debian/%s@%s%s" % (package, number.replace("+", "%2B").replace(":", "%3A"), "?arch=source" * (kind == "source")) for package, number, kind in rows]
        components.update({ref: {"type": "library", "bom-ref": ref, "purl": ref, "name": row[0], "version": row[1]} for ref, row in zip(refs, rows)})
        components[path.name] = own
        links.append({"ref": path.name, "dependsOn": sorted(set(refs))})
    return {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "components": [components[ref] for ref in sorted(components)], "dependencies": links,
            "metadata": {"timestamp": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(project.time())),
                         "component": {"type": "application", "name": "lambent", "version": version(), "licenses": [{"license": {"id": "MIT"}}]}}}


def sign(path):
    key = os.environ.get("SIGN_KEY")
    if not key:
        print("%s is not signed: SIGN_KEY names no key" % path.name)
    elif os.path.exists(key):
        run("minisign", "-S", "-s", key, "-m", path, "-t", project.tag())
    else:
        run("gpg", "--batch", "--yes", "--armor", "--detach-sign", "--local-user", key, path)


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
    parts = build_all(dist, name)
    (dist / (name + ".cdx.json")).write_text(json.dumps(materials(dist, parts), indent=1) + "\n")
    (dist / "NOTES.md").write_text(text)
    files = sorted(path for path in dist.iterdir())
    sums = "".join("%s  %s\n" % (hashlib.sha256(path.read_bytes()).hexdigest(), path.name) for path in files)
    (dist / "SHA256SUMS").write_text(sums)
    for path in files:
        print("%9.1f kB  %s" % (path.stat().st_size / 1e3, path.name))
    sign(dist / "SHA256SUMS")


if __name__ == "__main__":
    main()
