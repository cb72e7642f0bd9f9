#!/usr/bin/env python3
"""libraries.py FOLDER: compiles the libraries that Lambent uses to read files for WebAssembly, from Debian's source packages, in FOLDER/root: Jansson
(JSON), libspng with zlib (PNG), libjpeg-turbo (JPEG), expat (3MF). It does nothing if they exist.

apt-get finds the sources with a separate list of the host's archives in FOLDER; the system's own lists do not change.
"""
import concurrent.futures
import functools
import glob
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# packaging/windows.py sets others.
CLANG = "clang-19"
ARCHIVER = "/usr/lib/llvm-19/bin/llvm-ar"
SIZE_T = "4" # bytes
FLAGS = ["--target=wasm32-wasi", "-DNDEBUG", "-msimd128", "-mbulk-memory", "-mnontrapping-fptoint", "-ffp-contract=off", "-w",
         "-mllvm", "-wasm-enable-sjlj", "-isystem", os.path.join(os.path.dirname(os.path.abspath(__file__)), "libc")]

JPEG = """jaricom jcapimin jcapistd jccoefct jccolor jcdctmgr jchuff jcinit jcmainct jcmarker jcmaster jcomapi jcparam
jcprepct jcsample jdapimin jdapistd jdarith jdatadst jdatasrc jdcoefct jdcolor jddctmgr jdhuff jdinput
jdmainct jdmarker jdmaster jdphuff jdpostct jdsample jerror jfdctint jidctint jutils jmemmgr jmemnobs jsimd_none""".split()
# Parts that no picture of Lambent needs, omitted because a page downloads the module.
JPEG_WITHOUT = """DCT_IFAST DCT_FLOAT C_MULTISCAN_FILES C_PROGRESSIVE INPUT_SMOOTHING BLOCK_SMOOTHING IDCT_SCALING UPSAMPLE_MERGING
QUANT_1PASS QUANT_2PASS""".split()
ZLIB = "adler32 crc32 deflate inffast inflate inftrees trees zutil compress uncompr".split()

# Each row contains Debian's source package, the files, the headers that others include (or their folder, `include`), the data for pkg-config, and
# flags: optimised for size if the speed does not matter.
LIBRARIES = [
    {"source": "zlib", "library": "z", "files": [n + ".c" for n in ZLIB], "headers": ["zlib.h", "zconf.h"], "pc": "zlib", "flags": ["-O2"]},
    {"source": "jansson", "library": "jansson", "files": ["src/*.c"], "headers": ["src/jansson.h", "src/jansson_config.h"], "pc": "jansson",
     "flags": ["-Oz", "-DHAVE_CONFIG_H"]},
    {"source": "libspng", "library": "spng", "files": ["spng/spng.c"], "headers": ["spng/spng.h"], "pc": "spng", "needs": "zlib", "flags": ["-Os"]},
    {"source": "libjpeg-turbo", "library": "jpeg", "files": [n + ".c" for n in JPEG],
     "headers": ["jpeglib.h", "jmorecfg.h", "jerror.h", "jconfig.h"], "pc": "libjpeg", "flags": ["-Os", "-DUSE_CLZ_INTRINSIC"]},
    {"source": "expat", "library": "expat", "files": ["expat/lib/xml%s.c" % n for n in ("parse", "role", "tok")],
     "headers": ["expat/lib/expat.h", "expat/lib/expat_external.h"], "pc": "expat", "flags": ["-Oz", "-DXML_STATIC"]},
]


def run(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    if done.returncode:
        sys.exit("web: %s failed:\n%s" % (" ".join(command[:6]), done.stdout[-3000:]))
    return done.stdout


def fetch(folder, names):
    """Unpacks the source packages of these names below FOLDER/source."""
    source = os.path.join(folder, "source")
    lists = os.path.join(source, "lists")
    os.makedirs(os.path.join(lists, "partial"), exist_ok=True)
    rows = ""
    for path in ["/etc/apt/sources.list"] + glob.glob("/etc/apt/sources.list.d/debian*"):
        if os.path.exists(path):
            text = open(path).read()
            rows += re.sub(r"^Types:.*", "Types: deb-src", text, flags=re.M) + "\n" if path.endswith(".sources") else ""
            if not path.endswith(".sources"):
                with open(os.path.join(source, "apt.list"), "w") as out:
                    out.write("".join("deb-src " + line[4:] for line in text.splitlines(True) if line.startswith("deb ")))
    if rows:
        open(os.path.join(source, "apt.sources"), "w").write(rows)
    options = ["-o", "Dir::Etc::sourcelist=/dev/null", "-o", "Dir::Etc::sourceparts=" + source, "-o", "Dir::State::lists=" + lists,
               "-o", "Dir::Cache=" + os.path.join(source, "cache"), "-o", "APT::Sandbox::User=", "-q"]
    run("apt-get", *options, "update", cwd=source)
    for name in names:
        # The newest version first. An archive may list a version, such as a security update, before it has its files.
        rows = run("apt-cache", *options, "madison", name).splitlines()
        versions = list(dict.fromkeys(row.split("|")[1].strip() for row in reversed(rows) if row.endswith("Sources")))
        versions.sort(key=functools.cmp_to_key(lambda a, b: -1 if subprocess.run(["dpkg", "--compare-versions", a, "gt", b]).returncode == 0 else 1))
        for version in versions[:-1]:
            done = subprocess.run(["apt-get", *options, "source", "--download-only", "%s=%s" % (name, version)], cwd=source, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            if done.returncode == 0:
                break
            print("libraries: %s %s cannot be fetched, so an older version is used" % (name, version), flush=True)
        else:
            run("apt-get", *options, "source", "--download-only", "%s=%s" % (name, versions[-1]) if versions else name, cwd=source)
    for dsc in glob.glob(os.path.join(source, "*.dsc")):
        if not unpacked(folder, os.path.basename(dsc).split("_")[0]):
            run("dpkg-source", "--no-check", "-x", dsc, cwd=source)


def unpacked(folder, name):
    found = [p for p in glob.glob(os.path.join(folder, "source", name + "-[0-9]*")) if os.path.isdir(p)]
    return found[0] if found else None


def notices(what, folder, sources, packages):
    """The licence notices of a file that contains code of these unpacked source packages and installed packages."""
    texts = ["%s contains the following software. What Debian's packages say of each:\n" % what, open(os.path.join(ROOT, "LICENSE")).read()]
    places = {name: unpacked(folder, name) + "/debian/copyright" for name in sources}
    places.update({name: glob.glob("/usr/share/doc/%s/copyright" % name)[0] for name in packages})
    texts += ["==== %s\n\n%s" % (name, open(path).read()) for name, path in places.items()]
    if any("common-licenses/Apache-2.0" in text for text in texts):
        texts.append(open("/usr/share/common-licenses/Apache-2.0").read())
    return "\n".join(texts)


def configure(name, path):
    """The headers that a library's own configuration would make."""
    def fill(template, values, defined=()):
        text = open(os.path.join(path, template)).read()
        for key, value in values.items():
            text = text.replace("@%s@" % key, value)
        text = re.sub(r"^#cmakedefine (\w+)(.*)", lambda m: "#define %s%s" % m.groups() if m[1] in defined else "", text, flags=re.M)
        open(os.path.join(path, template[:-3]), "w").write(text)

    if name == "jansson":
        fill("src/jansson_config.h.in", {"json_inline": "inline", "json_have_long_long": "1", "json_have_localeconv": "0",
                                         "json_have_atomic_builtins": "0", "json_have_sync_builtins": "0"})
        open(os.path.join(path, "src/jansson_private_config.h"), "w").write("#define HAVE_STDINT_H 1\n#define HAVE_SYS_TYPES_H 1\n")
    if name == "expat":
        open(os.path.join(path, "expat_config.h"), "w").write(
            "#define BYTEORDER 1234\n#define XML_CONTEXT_BYTES 1024\n#define XML_DTD 1\n#define XML_NS 1\n#define XML_POOR_ENTROPY 1\n#define HAVE_MEMMOVE 1\n")
    if name == "libjpeg-turbo":
        version = os.path.basename(path).rsplit("-", 1)[1]
        number = "%d%03d%03d" % tuple(int(n) for n in version.split("."))
        fill("jconfig.h.in", {"JPEG_LIB_VERSION": "62", "VERSION": version, "LIBJPEG_TURBO_VERSION_NUMBER": number, "BITS_IN_JSAMPLE": "8"},
             ["D_ARITH_CODING_SUPPORTED", "MEM_SRCDST_SUPPORTED"])
        fill("jconfigint.h.in", {"BUILD": "lambent", "INLINE": "inline", "THREAD_LOCAL": "_Thread_local",
                                 "CMAKE_PROJECT_NAME": name, "VERSION": version, "SIZE_T": SIZE_T})
        fill("jversion.h.in", {"COPYRIGHT_YEAR": "2023"})
        header = os.path.join(path, "jmorecfg.h")
        text = re.sub(r"^#define (%s)_SUPPORTED" % "|".join(JPEG_WITHOUT), r"#undef \1_SUPPORTED", open(header).read(), flags=re.M)
        open(header, "w").write(text)


def build(row, folder):
    root = os.path.join(folder, "root")
    path = unpacked(folder, row["source"])
    configure(row["source"], path)
    objects = os.path.join(folder, "objects", row["library"])
    os.makedirs(objects, exist_ok=True)
    files = [f for pattern in row["files"] for f in sorted(glob.glob(os.path.join(path, pattern)))]
    flags = FLAGS + row.get("flags", []) + ["-I" + os.path.join(root, "include"), "-I" + path, "-I" + os.path.join(path, "src"), "-I" + os.path.join(path, "include")]

    def compile_one(source):
        target = os.path.join(objects, os.path.basename(source)[:-1] + "o")
        run(CLANG, *flags, "-c", source, "-o", target)
        return target

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        made = list(pool.map(compile_one, files))
    archive = os.path.join(root, "lib", "lib%s.a" % row["library"])
    run(ARCHIVER, "crs", archive, *made)
    for header in row["headers"]:
        shutil.copy(os.path.join(path, header), os.path.join(root, "include"))
    # The version of Debian's sources of zlib has a suffix.
    version = re.match(r"[\d.]*\d", os.path.basename(path).rsplit("-", 1)[1])[0]
    with open(os.path.join(root, "lib", "pkgconfig", row["pc"] + ".pc"), "w") as out:
        out.write("Name: %s\nDescription: Debian's %s\nVersion: %s\n%sLibs: %s\nCflags: -I%s\n" % (
            row["pc"], row["source"], version, "Requires: %s\n" % row["needs"] if "needs" in row else "", archive,
            os.path.join(path, row["include"]) if "include" in row else os.path.join(root, "include")))


def make(folder, rows):
    """Compiles the libraries of these rows to FOLDER/root, unless they exist."""
    done = os.path.join(folder, "root", "complete")
    stamp = open(os.path.abspath(__file__)).read() + repr(rows)
    if os.path.exists(done) and open(done).read() == stamp:
        return
    for name in ("include", "lib/pkgconfig"):
        os.makedirs(os.path.join(folder, "root", name), exist_ok=True)
    if any(unpacked(folder, row["source"]) is None for row in rows):
        print("libraries: fetching Debian's sources of " + ", ".join(row["source"] for row in rows), flush=True)
        fetch(folder, [row["source"] for row in rows])
    for row in rows:
        print("libraries: compiling " + row["source"], flush=True)
        build(row, folder)
    with open(done, "w") as out:
        out.write(stamp)


if __name__ == "__main__":
    make(os.path.abspath(sys.argv[1]), LIBRARIES)
