#!/usr/bin/env python3
"""static.py [FOLDER [MACHINE]]: one program without shared libraries in FOLDER (build-static), FOLDER/lambent, for this machine or for MACHINE
(make static, make static machine=aarch64). FOLDER/LICENCES contains the licence notices of its components.

Debian's packages have most of the libraries as archives. libspng and the decoders of meshoptimizer are compiled from Debian's source packages, which
are downloaded by name and verified by checksum. For another machine, Debian's packages for that machine are unpacked in FOLDER/debian; the system
does not change."""
import hashlib
import os
import pathlib
import platform
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "web"))
import libraries  # noqa: E402

# Debian's source package, the archive's name, files, header. SUMS has the tarballs' SHA-256.
SOURCES = [
    {"source": "libspng", "library": "spng", "files": ["spng/spng.c"], "header": "spng/spng.h", "compiler": "gcc", "flags": [], "needs": "zlib"},
    {"source": "meshoptimizer", "library": "meshopt", "header": None, "compiler": "g++", "flags": ["-fno-exceptions", "-fno-rtti"], "needs": "",
     "files": ["src/allocator.cpp", "src/indexcodec.cpp", "src/vertexcodec.cpp", "src/vertexfilter.cpp"]},
]
SUMS = {
    "libspng_0.7.3.orig.tar.gz": "a50cadbe808ffda1a7fab17d145f52a23b163f34b3eb3696c7ecb5a52340fc1d",
    "meshoptimizer_0.18+dfsg.orig.tar.xz": "881ea2cc687f1fef5ce70484e0ca6504e13856dd856677749f3763bc685956d3",
}
# The packages of the archives, and the packages that contain the licence notices.
PACKAGES = ["libbrotli-dev", "libdeflate-dev", "libexpat1-dev", "libfreetype-dev", "libjansson-dev", "libjpeg62-turbo-dev", "libpng-dev", "libwebp-dev", "zlib1g-dev"]
INSIDE = [*PACKAGES, "fonts-dejavu-core", "libc6-dev", "libgcc-*-dev"]
DEBIAN_NAMES = {"x86_64": "amd64", "aarch64": "arm64"}


# To reduce the size, the linker omits functions that nothing calls, and the program contains no tables for stack unwinding,
# which only C++ needs.
SECTIONS, UNUSED = "-ffunction-sections -fdata-sections -fno-asynchronous-unwind-tables", "-Wl,--gc-sections"


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


def compile_library(row, folder, prefix):
    path = pathlib.Path(libraries.unpacked(str(folder), row["source"]))
    made = folder / "root"
    (made / "pkgconfig").mkdir(parents=True, exist_ok=True)
    objects = []
    for name in row["files"]:
        objects.append(str(made / (pathlib.Path(name).stem + ".o")))
        call(prefix + row["compiler"], *row["flags"], "-O2", "-fPIC", "-DNDEBUG", "-DSPNG_STATIC", "-w", "-ffile-prefix-map=%s=." % folder, "-I%s" % (folder / "debian/usr/include"), "-c", str(path / name),
             "-o", objects[-1])
    archive = made / ("lib%s.a" % row["library"])
    call(prefix + "ar", "crD", str(archive), *objects)
    if row["header"]:
        shutil.copy(path / row["header"], made)
    version = path.name.rsplit("-", 1)[1]
    (made / "pkgconfig" / (row["library"] + ".pc")).write_text(
        "Name: %s\nDescription: Debian's %s\nVersion: %s\nRequires: %s\nLibs: %s\nCflags: -I%s\n" % (
            row["library"], row["source"], version, row["needs"], archive, made))


def unpack_packages(folder, machine):
    """Unpacks Debian's archives for another machine in FOLDER/debian, and adjusts the paths in the files of pkg-config."""
    debs, debian = folder / "debs", folder / "debian"
    (debs / "lists" / "partial").mkdir(parents=True, exist_ok=True)
    (debs / "status").write_text("")
    options = ["-o", "APT::Architecture=" + DEBIAN_NAMES[machine], "-o", "APT::Architectures=" + DEBIAN_NAMES[machine], "-o", "Dir::State::status=%s" % (debs / "status"),
               "-o", "Dir::State::lists=%s" % (debs / "lists"), "-o", "Dir::Cache=%s" % (debs / "cache"), "-o", "APT::Sandbox::User=", "-q"]
    call("apt-get", *options, "update", cwd=debs)
    call("apt-get", *options, "download", *PACKAGES, cwd=debs)
    for deb in sorted(debs.glob("*.deb")):
        call("dpkg-deb", "-x", str(deb), str(debian))
    for file in debian.glob("usr/lib/*/pkgconfig/*.pc"):
        file.write_text(file.read_text().replace("=/usr", "=%s/usr" % debian))


def cross_file(folder, machine, prefix):
    path = folder / "cross.ini"
    headers, files = next(folder.glob("debian/usr/include/*-linux-gnu")), next(folder.glob("debian/usr/lib/*/pkgconfig"))
    path.write_text("[binaries]\nc = '%sgcc'\nar = '%sar'\nstrip = '%sstrip'\npkgconfig = 'pkg-config'\n[built-in options]\nc_args = ['-I%s', '%s']\nc_link_args = ['-L%s', '%s']\n"
                    "[properties]\npkg_config_libdir = ['%s', '%s']\nneeds_exe_wrapper = true\n[host_machine]\nsystem = 'linux'\ncpu_family = '%s'\n"
                    "cpu = '%s'\nendian = 'little'\n" % (
                        prefix, prefix, prefix, headers, "', '".join(SECTIONS.split()), files.parent, UNUSED, folder / "root" / "pkgconfig", files, machine, machine))
    return path


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build-static").resolve()
    machine = sys.argv[2] if len(sys.argv) > 2 else platform.machine()
    is_cross = machine != platform.machine()
    if machine not in DEBIAN_NAMES:
        sys.exit("static: found the machine %s, expected %s" % (machine, " or ".join(DEBIAN_NAMES)))
    prefix = machine + "-linux-gnu-" if is_cross else ""
    folder.mkdir(parents=True, exist_ok=True)
    if not all((folder / "root" / "pkgconfig" / ("%s.pc" % row["library"])).exists() for row in SOURCES):
        libraries.fetch(str(folder), [row["source"] for row in SOURCES])
        check_sums(folder)
        if is_cross:
            unpack_packages(folder, machine)
        for row in SOURCES:
            compile_library(row, folder, prefix)
    build = folder / "build"
    environment = dict(os.environ) if is_cross else {**os.environ, "PKG_CONFIG_PATH": str(folder / "root" / "pkgconfig")}
    flags = [] if is_cross else ["-Dc_args=" + SECTIONS, "-Dc_link_args=" + UNUSED]
    if not (build / "build.ninja").exists():
        cross = ["--cross-file", str(cross_file(folder, machine, prefix))] if is_cross else []
        call("meson", "setup", str(build), str(ROOT), "--buildtype=release", "--prefix=/usr/local", "-Dtests=false", "-Dstatic_program=true", *cross, *flags,
             env=environment)
    elif flags: # they may have changed since
        call("meson", "configure", str(build), *flags, env=environment)
    call("ninja", "-C", str(build), "lambent", env=environment)
    call(prefix + "strip", "-o", str(folder / "lambent"), str(build / "lambent"))
    (folder / "LICENCES").write_text(libraries.notices("The program lambent", str(folder), [row["source"] for row in SOURCES], INSIDE))
    print("%s: %.1f MB" % (folder / "lambent", (folder / "lambent").stat().st_size / 1e6))


if __name__ == "__main__":
    main()
