#!/usr/bin/env python3
"""packages.py PROGRAM: tests the Debian packages of `make deb`: their links lead somewhere, lintian accepts them, and they are installed, used and removed in
a fresh root file system of Debian 12 (tests/long/try_packages.sh), tested there by autopkgtest, installed in a container, and built and used in
Debian 13. The test needs debhelper and lintian; the parts with a root file system also need root, mmdebstrap and a mirror. tests/long/table.py compares the
bytes of two builds."""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv[1]).resolve()
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests/long")]
import cells  # noqa: E402
import test_site  # noqa: E402

failed = 0
number = 0


def report(title, ok, output="", skip=None):
    global failed, number
    number += 1
    failed += not ok
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-30:]))
    print("%s %d - %s%s" % ("ok" if ok else "not ok", number, title, " # SKIP " + skip if skip else ""))
    sys.stdout.flush()


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    return done.returncode, done.stdout


AS_ROOT = [] if os.geteuid() == 0 else ["sudo"]


def in_root(release, folder, files, command):
    """Runs a command in the root file system of a release, which is made on first use, with files in its /debs."""
    place = folder + "/" + release
    if files:
        code, text = run(ROOT / "scripts/fresh_root.sh", release, place, "mkdir /debs")
        if code:
            return code, text
        subprocess.run(AS_ROOT + ["cp", *files, place + "/root/debs"], check=True)
    return run(ROOT / "scripts/fresh_root.sh", release, place, command)


def try_autopkgtest(root, files):
    """The tests of debian/tests, run in the root file system like Debian runs them."""
    if not shutil.which("autopkgtest"):
        report("autopkgtest", True, skip="autopkgtest is not installed")
        return
    script = 'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; cd /tmp; autopkgtest --no-built-binaries "$@" -- chroot "$0"'
    code, text = run(*AS_ROOT, "unshare", "--mount", "--fork", "sh", "-c", script, root, *files)
    report("autopkgtest", code == 0, text)


def try_container(root, page):
    """The image of the full program, on the root file system of Debian 12: the jobs of examples/kubernetes-job.yaml draw every model once."""
    title = "the container of the full program runs the job for Kubernetes"
    if not shutil.which("buildah") or os.geteuid() != 0:
        report(title, True, skip="buildah or the rights of root are missing")
        return
    buildah = ["buildah", "--storage-driver", "vfs"]
    base = run(*buildah, "from", "scratch")[1].strip()
    steps = [run(*buildah, "copy", "-q", base, root, "/"), run(*buildah, "commit", "-q", base, "lambent-base")]
    steps.append(run(*buildah, "build", "--isolation", "chroot", "--build-arg", "BASE=localhost/lambent-base", "-f", ROOT / "packaging/ci/Containerfile.full", "-t", "lambent-full", page))
    text = (ROOT / "examples/kubernetes-job.yaml").read_text()
    words = [word.strip().strip('"') for word in re.search(r"(?s)command: \[(.*?)\]", text)[1].split(",")]
    with tempfile.TemporaryDirectory(prefix="lambent-pod-") as folder:
        models, pictures = pathlib.Path(folder, "models"), pathlib.Path(folder, "pictures")
        models.mkdir()
        pictures.mkdir()
        cells.fill(PROGRAM, models)
        (models / "ply").mkdir()
        (models / "cube.ply").rename(models / "ply/cube.ply") # or its picture would have the name of the STL file's
        pod = run(*buildah, "from", "lambent-full")[1].strip()
        for index in range(int(re.search(r"completions: (\d+)", text)[1])):
            steps.append(run(*buildah, "run", "--isolation", "chroot", "--env", "JOB_COMPLETION_INDEX=%d" % index, "-v", "%s:/models:ro" % models, "-v", "%s:/pictures" % pictures, pod, "--", *words))
        drawn = list(pictures.rglob("*.png"))
    for name in (pod, base):
        run(*buildah, "rm", name)
    run(*buildah, "rmi", "lambent-full", "lambent-base")
    report(title, not any(code for code, _ in steps) and len(drawn) == len(cells.MODELS), "\n".join(text for code, text in steps if code) + str(drawn))


def tell(release, code, text):
    """The cells of the table: those that try_packages.sh says."""
    for line in re.findall(r"^cell: (.*) \| (\w+)$", text, re.M):
        cells.tell("packages, Debian " + release, *line)
    if code == 77:
        for column in COLUMNS[release == "12":]:
            cells.tell("packages, Debian " + release, column, "not run: no root of Debian can be made here")


COLUMNS = ["builds", "installs", *cells.MODELS, "page", "man, completion", "removed"]


def main():
    print("1..7")
    titles = ("make deb builds the packages", "lintian has no error and no warning", "every link in the packages has its target",
              "installed, used and removed in a fresh root", "autopkgtest", "the container of the full program runs the job for Kubernetes",
              "built, installed, used and removed on Debian 13")
    if not all(map(shutil.which, ("dh", "dpkg-buildpackage", "lintian"))):
        for title in titles:
            report(title, True, skip="debhelper or lintian is not installed")
        for release in ("12", "13"):
            for column in COLUMNS:
                cells.tell("packages, Debian " + release, column, "not run: debhelper or lintian is not installed")
        return 0
    with tempfile.TemporaryDirectory(prefix="lambent-deb-") as folder:
        first = str(ROOT / "build-deb")
        code, text = run(ROOT / "packaging/deb.sh", first)
        report(titles[0], code == 0, text)
        code, text = run("lintian", "--allow-root", "--fail-on", "error,warning", *glob.glob(first + "/*.changes"))
        report(titles[1], code == 0, text)
        for deb in glob.glob(first + "/*.deb"):
            subprocess.run(["dpkg-deb", "-x", deb, folder + "/unpacked"], check=True)
        texts, _, missing = test_site.links_of(folder + "/unpacked")
        report(titles[2], len(texts) > 40 and not missing, "\n".join(missing))
        if in_root("bookworm", folder, [], "true")[0] == 77:
            for title in titles[3:]:
                report(title, True, skip="no root of Debian can be made here")
            tell("12", 77, "")
            tell("13", 77, "")
            return failed > 0
        models = pathlib.Path(folder, "models")
        models.mkdir()
        cells.fill(PROGRAM, models)
        debs = [path for path in glob.glob(first + "/*.deb") if "dbgsym" not in path]
        sources = glob.glob(first + "/*.dsc") + glob.glob(first + "/*.tar.xz")
        code, text = in_root("bookworm", folder, [*debs, *models.iterdir()], "sh tests/long/try_packages.sh /debs")
        report(titles[3], code == 0, text)
        tell("12", code, text)
        try_autopkgtest(folder + "/bookworm/root", debs + glob.glob(first + "/*.dsc"))
        try_container(folder + "/bookworm/root", ROOT)
        code, text = in_root("trixie", folder, [*sources, *models.iterdir()], "sh tests/long/build_packages.sh /debs && echo 'cell: builds | yes' && sh tests/long/try_packages.sh /debs")
        report(titles[6], code == 0, text)
        tell("13", code, text)
        subprocess.run(AS_ROOT + ["rm", "-rf", "--one-file-system", folder + "/bookworm", folder + "/trixie"], check=True)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
