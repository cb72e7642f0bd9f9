#!/usr/bin/env python3
"""packages.py: the Debian packages of `make deb`: built twice in different folders to the same bytes, without complaints of lintian, and installed, used and
removed in a fresh root of Debian 12 (tests/long/try_packages.sh). Needs debhelper and lintian; the last part also root, mmdebstrap and a mirror."""
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


def main():
    print("1..4")
    if not all(map(shutil.which, ("dh", "dpkg-buildpackage", "lintian"))):
        for title in ("built", "built again", "lintian", "used"):
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
        code, text = run(ROOT / "scripts/fresh_root.sh", "bookworm", folder + "/clean", "true")
        if code == 77:
            report("installed, used and removed in a fresh root", True, skip="no root of Debian can be made here")
            return failed > 0
        as_root = [] if os.geteuid() == 0 else ["sudo"]
        debs = [path for path in glob.glob(first + "/*.deb") if "dbgsym" not in path]
        subprocess.run(as_root + ["mkdir", folder + "/clean/root/debs"], check=True)
        subprocess.run(as_root + ["cp", *debs, folder + "/clean/root/debs"], check=True)
        code, text = run(ROOT / "scripts/fresh_root.sh", "bookworm", folder + "/clean", "sh tests/long/try_packages.sh /debs")
        report("installed, used and removed in a fresh root", code == 0, text)
        subprocess.run(as_root + ["rm", "-rf", "--one-file-system", folder + "/clean"], check=True)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
