#!/usr/bin/env python3
"""build.py [FOLDER]: the modules for the web in FOLDER (build-web): the libraries (libraries.py), then WebAssembly by Meson and
clang 19. What is up to date is left alone. `make web` calls it; packages: group `web` of packages.txt."""
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
NEEDS = {"clang-19": "clang-19", "wasm-ld-19": "lld-19", "/usr/lib/llvm-19/bin/llvm-ar": "llvm-19", "dpkg-source": "dpkg-dev", "node": "nodejs",
         "/usr/include/wasm32-wasi/stdio.h": "wasi-libc",
         "/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a": "libclang-rt-19-dev-wasm32"}


def missing():
    """The packages of the group that are not installed."""
    return [package for need, package in NEEDS.items() if not (os.path.exists(need) if "/" in need else shutil.which(need))]


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("web: %s failed:\n%s" % (" ".join(command[:3]), done.stdout[-4000:]))
    return done.stdout


def main():
    folder = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build-web"))
    if missing():
        sys.exit("web: not installed: " + " ".join(missing()))
    os.makedirs(folder, exist_ok=True)
    libraries = subprocess.run([sys.executable, os.path.join(HERE, "libraries.py"), folder])
    if libraries.returncode:
        sys.exit(1)
    wasm = os.path.join(folder, "wasm")
    if not os.path.exists(os.path.join(wasm, "build.ninja")):
        places = os.path.join(folder, "places.ini")
        with open(places, "w") as out:
            out.write("[constants]\nweb_folder = '%s'\nweb_root = '%s'\n" % (HERE, os.path.join(folder, "root")))
        call("meson", "setup", wasm, ROOT, "--cross-file", places, "--cross-file", os.path.join(HERE, "wasm32.ini"),
             "--buildtype=release", "-Dtests=false")
    output = call("ninja", "-C", wasm)
    if "warning:" in output:
        sys.exit("web: the compiler warns:\n" + output[-4000:])


if __name__ == "__main__":
    main()
