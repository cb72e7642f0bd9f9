#!/usr/bin/env python3
"""windows.py [FOLDER]: builds Lambent for Windows on x86-64 in FOLDER (build-windows) with mingw-w64 (make windows): the static program lambent.exe,
and the library lambent.dll with lambent.dll.a for linkers. The libraries inside are the same as in the module for the web (web/libraries.py) and in
the
static program (packaging/static.py), compiled from Debian's source packages."""
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "web"), str(ROOT / "scripts")]
import libraries  # noqa: E402
import project  # noqa: E402

PREFIX = "x86_64-w64-mingw32-"
COMPILER = PREFIX + "gcc-posix"
INSIDE = ["fonts-dejavu-core", "gcc-mingw-w64-base", "mingw-w64-common"] # the font, the compiler's library, and Windows' libraries with threads
PROGRAMS = {COMPILER: "gcc-mingw-w64-x86-64-posix", PREFIX + "g++-posix": "g++-mingw-w64-x86-64-posix", "dpkg-source": "dpkg-dev", "meson": "meson", "ninja": "ninja-build"}

# The modules of FreeType that are listed in its ftmodule.h.
FREETYPE = """autofit bdf cff cid/type1cid lzw/ftlzw gzip/ftgzip pcf pfr psaux pshinter psnames raster sdf sfnt smooth svg truetype type1/type1 type42/type42 winfonts/winfnt
base/ftbase base/ftbitmap base/ftdebug base/ftglyph base/ftinit base/ftmm base/ftsystem""".split()
# Rows like libraries.LIBRARIES.
MORE = [
    {"source": "libdeflate", "library": "deflate", "files": ["lib/*.c", "lib/x86/cpu_features.c"], "headers": ["libdeflate.h"], "pc": "libdeflate", "flags": ["-O2"]},
    {"source": "libwebp", "library": "webp", "files": ["sharpyuv/*.c", *("src/%s/*.c" % n for n in ("dec", "dsp", "enc", "utils"))], "headers": [], "include": "src", "pc": "libwebp",
     "flags": ["-O2"]},
    {"source": "libwebp", "library": "webpmux", "files": ["src/mux/*.c"], "headers": [], "include": "src", "pc": "libwebpmux", "needs": "libwebp", "flags": ["-O2"]},
    {"source": "freetype", "library": "freetype", "files": ["src/%s.c" % (n if "/" in n else n + "/" + n) for n in FREETYPE], "headers": [], "include": "include",
     "pc": "freetype2", "flags": ["-O2", "-DFT2_BUILD_LIBRARY", "-DFT_CONFIG_OPTION_SYSTEM_ZLIB"]},
    {"source": "meshoptimizer", "library": "meshopt", "files": ["src/%s.cpp" % n for n in ("allocator", "indexcodec", "vertexcodec", "vertexfilter")], "headers": [],
     "pc": "meshopt", "flags": ["-O2", "-fno-exceptions", "-fno-rtti"]},
]


def missing():
    """The packages that are not installed."""
    return [package for program, package in PROGRAMS.items() if not shutil.which(program)]


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("windows: %s failed:\n%s" % (" ".join(map(str, command[:4])), done.stdout[-4000:]))
    return done.stdout


def build(folder):
    """Builds outdated parts, and returns the build folder."""
    folder.mkdir(parents=True, exist_ok=True)
    libraries.CLANG, libraries.ARCHIVER, libraries.SIZE_T = COMPILER, PREFIX + "ar", "8"
    libraries.FLAGS = ["-DNDEBUG", "-D__USE_MINGW_ANSI_STDIO=1", "-DSPNG_STATIC", "-ffp-contract=off", "-w", "-ffile-prefix-map=%s=." % folder]
    libraries.make(str(folder), libraries.LIBRARIES + MORE)
    places = folder / "places.ini"
    places.write_text("[constants]\nroot = '%s'\nheaders = '%s'\n" % (folder / "root", ROOT / "src/system/windows/include"))
    made = folder / "build"
    if not (made / "build.ninja").exists():
        shutil.rmtree(made, ignore_errors=True)
        call("meson", "setup", str(made), str(ROOT), "--cross-file", str(places), "--cross-file", str(ROOT / "packaging/windows.ini"),
             "--buildtype=release", "-Dtests=false", "-Dstatic_program=true")
    output = call("ninja", "-C", str(made))
    if "warning:" in output:
        sys.exit("windows: the compiler warns:\n" + output[-4000:])
    return made


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build-windows").resolve()
    if missing():
        sys.exit("windows: not installed: " + " ".join(missing()))
    os.environ["SOURCE_DATE_EPOCH"] = str(project.time()) # the linker and strip store it
    made = build(folder)
    for name in ("lambent.exe", "src/lambent.dll"):
        target = folder / pathlib.Path(name).name
        call(PREFIX + "strip", "-o", str(target), str(made / name))
        print("%s: %.1f MB" % (target, target.stat().st_size / 1e6))
    shutil.copy(made / "src/lambent.dll.a", folder)
    sources = [row["source"] for row in libraries.LIBRARIES + MORE]
    (folder / "LICENCES").write_text(libraries.notices("Each of the files lambent.exe and lambent.dll", str(folder), sources, INSIDE))


if __name__ == "__main__":
    main()
