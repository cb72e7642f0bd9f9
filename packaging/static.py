#!/usr/bin/env python3
"""static.py [FOLDER]: one program without shared libraries in FOLDER (build-static), FOLDER/lambent (make static).

Debian's packages have most of the libraries as archives. libspng and the decoders of meshoptimizer are compiled here from Debian's source packages, which
are fetched by name and held to a checksum."""
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "web"))
import libraries  # noqa: E402

# Debian's source package, the archive's name, files, header. SUMS has the tarballs' SHA-256 (Debian 12).
SOURCES = [
    {"source": "libspng", "library": "spng", "files": ["spng/spng.c"], "header": "spng/spng.h", "compiler": ["cc"], "needs": "zlib"},
    {"source": "meshoptimizer", "library": "meshopt", "header": None, "compiler": ["c++", "-fno-exceptions", "-fno-rtti"], "needs": "",
     "files": ["src/allocator.cpp", "src/indexcodec.cpp", "src/vertexcodec.cpp", "src/vertexfilter.cpp"]},
]
SUMS = {
    "libspng_0.7.3.orig.tar.gz": "a50cadbe808ffda1a7fab17d145f52a23b163f34b3eb3696c7ecb5a52340fc1d",
    "meshoptimizer_0.18+dfsg.orig.tar.xz": "881ea2cc687f1fef5ce70484e0ca6504e13856dd856677749f3763bc685956d3",
}


def call(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    if done.returncode:
        sys.exit("static: %s failed:\n%s" % (" ".join(map(str, command[:4])), done.stdout[-4000:]))
    return done.stdout


def check_sums(folder):
    for path in sorted((folder / "source").glob("*.orig.tar.*")):
        found = hashlib.sha256(path.read_bytes()).hexdigest()
        if SUMS.get(path.name) != found:
            sys.exit("static: %s has the SHA-256 %s, expected %s" % (path.name, found, SUMS.get(path.name, "one that packaging/static.py lists")))


def compile_library(row, folder):
    path = pathlib.Path(libraries.unpacked(str(folder), row["source"]))
    made = folder / "root"
    (made / "pkgconfig").mkdir(parents=True, exist_ok=True)
    objects = []
    for name in row["files"]:
        objects.append(str(made / (pathlib.Path(name).stem + ".o")))
        call(*row["compiler"], "-O2", "-fPIC", "-DSPNG_STATIC", "-w", "-c", str(path / name), "-o", objects[-1])
    archive = made / ("lib%s.a" % row["library"])
    call("ar", "crD", str(archive), *objects)
    if row["header"]:
        shutil.copy(path / row["header"], made)
        version = path.name.rsplit("-", 1)[1]
        (made / "pkgconfig" / (row["library"] + ".pc")).write_text(
            "Name: %s\nDescription: Debian's %s\nVersion: %s\nRequires: %s\nLibs: %s\nCflags: -I%s\n" % (
                row["library"], row["source"], version, row["needs"], archive, made))


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build-static").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    libraries.LIBRARIES = SOURCES
    if not all((folder / "root" / ("lib%s.a" % row["library"])).exists() for row in SOURCES):
        libraries.fetch(str(folder))
        check_sums(folder)
        for row in SOURCES:
            compile_library(row, folder)
    build = folder / "build"
    environment = {**os.environ, "PKG_CONFIG_PATH": str(folder / "root" / "pkgconfig"), "LIBRARY_PATH": str(folder / "root")}
    if not (build / "build.ninja").exists():
        call("meson", "setup", str(build), str(ROOT), "--buildtype=release", "--prefix=/usr/local", "-Dtests=false", "-Dstatic_program=true", env=environment)
    call("ninja", "-C", str(build), "lambent", env=environment)
    call("strip", "-o", str(folder / "lambent"), str(build / "lambent"))
    print("%s: %.1f MB" % (folder / "lambent", (folder / "lambent").stat().st_size / 1e6))


if __name__ == "__main__":
    main()
