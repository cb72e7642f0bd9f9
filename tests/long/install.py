#!/usr/bin/env python3
"""install.py: tests make install and make uninstall on fresh machines of both Debian releases (tests/long/install.sh). mmdebstrap makes the root file
systems in a temporary folder; this needs root or sudo, a Debian mirror, and ten minutes. The test is skipped if no root file system can be made."""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RELEASES = ("bookworm", "trixie")


def main():
    failed = 0
    print("1..%d" % len(RELEASES))
    for number, release in enumerate(RELEASES, 1):
        title = "installed, used and uninstalled on a fresh %s" % release
        folder = tempfile.mkdtemp(prefix="lambent-root-")
        done = subprocess.run([ROOT / "scripts/fresh_root.sh", release, folder, "sh tests/long/install.sh"], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        subprocess.run(([] if os.geteuid() == 0 else ["sudo"]) + ["rm", "-rf", "--one-file-system", folder], check=True)
        if done.returncode:
            print("# " + "\n# ".join(done.stdout.splitlines()[-20:]))
        if done.returncode == 77:
            print("ok %d - %s # SKIP no root of Debian can be made here" % (number, title))
        else:
            failed += done.returncode != 0
            print("%s %d - %s" % ("not ok" if done.returncode else "ok", number, title))
        sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
