#!/usr/bin/env python3
"""packages.py: tests the Debian packages of `make deb`: they are built twice in different folders with identical bytes, checked by lintian,
installed, used and removed in a fresh root file system of Debian 12 (tests/long/try_packages.sh), tested there by autopkgtest, and built and used in
Debian 13. The test needs debhelper and lintian; the parts with a root file system also need root, mmdebstrap and a mirror."""
import glob
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
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


def main():
    print("1..6")
    if not all(map(shutil.which, ("dh", "dpkg-buildpackage", "lintian"))):
        for title in ("built", "built again", "lintian", "used", "autopkgtest", "Debian 13"):
            report(title, True, skip="debhelper or lintian is not installed")
        return 0
    with tempfile.TemporaryDirectory(prefix="lambent-deb-") as folder:
        first, second = folder + "/first", folder + "/another-folder"
        code, text = run(ROOT / "packaging/deb.sh", first)
        report("make deb builds the packages", code == 0, text)
        code, text = run(ROOT / "packaging/deb.sh", second) if code == 0 else (1, "")
        same = code == 0 and open(first + "/SHA256SUMS").read() == open(second + "/SHA256SUMS").read()
        report("a second build in another folder gives the same bytes", same, text)
        code, text = run("lintian", "--allow-root", "--fail-on", "error,warning", *glob.glob(first + "/*.changes"))
        report("lintian has no error and no warning", code == 0, text)
        if in_root("bookworm", folder, [], "true")[0] == 77:
            for title in ("installed, used and removed in a fresh root", "autopkgtest", "built and used on Debian 13"):
                report(title, True, skip="no root of Debian can be made here")
            return failed > 0
        debs = [path for path in glob.glob(first + "/*.deb") if "dbgsym" not in path]
        sources = glob.glob(first + "/*.dsc") + glob.glob(first + "/*.tar.xz")
        code, text = in_root("bookworm", folder, debs, "sh tests/long/try_packages.sh /debs")
        report("installed, used and removed in a fresh root", code == 0, text)
        try_autopkgtest(folder + "/bookworm/root", debs + glob.glob(first + "/*.dsc"))
        code, text = in_root("trixie", folder, sources, "sh tests/long/build_packages.sh /debs && sh tests/long/try_packages.sh /debs")
        report("built, installed, used and removed on Debian 13", code == 0, text)
        subprocess.run(AS_ROOT + ["rm", "-rf", "--one-file-system", folder + "/bookworm", folder + "/trixie"], check=True)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
