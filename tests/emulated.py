#!/usr/bin/env python3
"""emulated.py BUILD [NAME …]: tests the image table on other processors, under qemu's user mode: 64-bit Arm (plain C and NEON) and x86-64 without
SSE4 (core2duo) and without AVX (Nehalem). The pictures must be identical, byte for byte.

The test is part of the long tests (group `long` of packages.txt). The Arm libraries that the test program needs are downloaded as Debian packages and
unpacked in build-long/, not installed; the x86-64 program is BUILD/tests/test-images. Missing components are reported as skipped."""
import glob
import os
import platform
import re
import shutil
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-long")
SYSROOT = os.path.join(OUT, "arm64-root")
TRIPLE = "aarch64-linux-gnu"
PACKAGES = ["libspng-dev", "libspng0", "zlib1g-dev", "zlib1g", "libjpeg62-turbo-dev", "libjpeg62-turbo", "libjansson-dev",
            "libjansson4", "libcmocka-dev", "libcmocka0"]

# A qemu and its processor, the build, and the required instruction sets; a run without one of them proves nothing.
MACHINES = {
    "arm64": {"qemu": "qemu-aarch64", "cpu": "cortex-a72", "build": "arm64", "isas": "scalar neon"},
    "x86-64 core2duo": {"qemu": "qemu-x86_64", "cpu": "core2duo", "build": "x86_64", "isas": "scalar"},
    "x86-64 Nehalem": {"qemu": "qemu-x86_64", "cpu": "Nehalem", "build": "x86_64", "isas": "scalar sse4"},
}


def fetch_libraries():
    """Unpacks the Arm packages below SYSROOT; returns the reason if this fails, or None. apt's own lists do not change."""
    if os.path.exists(os.path.join(SYSROOT, "complete")):
        return None
    lists, packages = os.path.join(OUT, "apt"), os.path.join(OUT, "packages")
    os.makedirs(os.path.join(lists, "partial"), exist_ok=True)
    os.makedirs(packages, exist_ok=True)
    options = ["-oAPT::Architecture=amd64", "-oAPT::Architectures::=amd64", "-oAPT::Architectures::=arm64", "-oDir::State::Lists=" + lists,
               "-oAPT::Sandbox::User=root"]
    for command in (["update"], ["download"] + [name + ":arm64" for name in PACKAGES]):
        if subprocess.run(["apt-get"] + options + command, cwd=packages, capture_output=True).returncode:
            return "apt-get %s fails: the Arm libraries cannot be fetched" % command[0]
    for path in glob.glob(os.path.join(packages, "*.deb")):
        subprocess.run(["dpkg", "-x", path, SYSROOT], check=True)
    open(os.path.join(SYSROOT, "complete"), "w").close()
    return None


def arm_libraries():
    return [os.path.join(SYSROOT, folder, TRIPLE) for folder in ("usr/lib", "lib")]


def build_arm():
    """Builds the test program for Arm; returns the reason if this fails, or None."""
    folder = os.path.join(OUT, "arm64")
    if not shutil.which(TRIPLE + "-gcc"):
        return "gcc-aarch64-linux-gnu is not installed"
    reason = fetch_libraries()
    if reason:
        return reason
    if not os.path.exists(os.path.join(folder, "build.ninja")):
        libraries = os.path.join(SYSROOT, "usr/lib", TRIPLE)
        headers = [os.path.join(SYSROOT, "usr/include"), os.path.join(SYSROOT, "usr/include", TRIPLE)]
        cross = os.path.join(OUT, "arm64.ini")
        with open(cross, "w") as file:
            file.write("[binaries]\nc = '%s-gcc'\nar = '%s-ar'\nstrip = '%s-strip'\npkgconfig = 'pkg-config'\n" % (TRIPLE, TRIPLE, TRIPLE))
            file.write("[properties]\nsys_root = '%s'\npkg_config_libdir = '%s/pkgconfig'\n" % (SYSROOT, libraries))
            file.write("[built-in options]\nc_args = %r\nc_link_args = %r\n" % (
                [word for path in headers for word in ("-isystem", path)], ["-L" + libraries] + ["-Wl,-rpath-link," + path for path in arm_libraries()]))
            file.write("[host_machine]\nsystem = 'linux'\ncpu_family = 'aarch64'\ncpu = 'aarch64'\nendian = 'little'\n")
        subprocess.run(["meson", "setup", folder, ROOT, "--buildtype=release", "-Dtests=true", "--cross-file", cross], check=True,
                       stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder, "tests/test-images"], check=True, stdout=subprocess.DEVNULL)
    return None


def run(name, machine, number, build):
    """Prints the machine's line; returns whether all tests passed."""
    reason = None if shutil.which(machine["qemu"]) else "qemu-user is not installed"
    reason = reason if platform.machine() == "x86_64" else "it is known how to do this from x86-64 alone"
    if not reason and machine["build"] == "arm64":
        reason = build_arm()
        build = os.path.join(OUT, "arm64")
    if reason:
        print("ok %d - %s # SKIP %s" % (number, name, reason))
        return True
    command = [machine["qemu"], "-cpu", machine["cpu"]]
    if machine["build"] == "arm64":
        command += ["-L", "/usr/" + TRIPLE, "-E", "LD_LIBRARY_PATH=" + ":".join(arm_libraries())]
    start = time.time()
    done = subprocess.run(command + [os.path.join(build, "tests", "test-images")], capture_output=True, text=True,
                          env={**os.environ, "CMOCKA_MESSAGE_OUTPUT": "TAP"})
    text = done.stdout + done.stderr
    used = re.search(r"^# instruction sets: (.*)", text, re.M)
    passed = len(re.findall(r"^ok \d+", text, re.M))
    problem = None
    if done.returncode:
        problem = "ended with %d" % done.returncode
    elif not passed:
        problem = "no picture was compared"
    elif not used or used[1] != machine["isas"]:
        problem = "drawn by %s, expected %s" % (used and used[1], machine["isas"])
    if problem:
        print("not ok %d - %s: %s\n%s" % (number, name, problem, text[-2000:]))
        return False
    print("ok %d - %s: %d scenes have the recorded bytes, drawn by %s, in %.0f s" % (number, name, passed, used[1], time.time() - start))
    return True


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, names = sys.argv[1], sys.argv[2:]
    good = True
    for number, (name, machine) in enumerate(MACHINES.items(), 1):
        if not names or name in names:
            good &= run(name, machine, number, build)
            sys.stdout.flush()
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
