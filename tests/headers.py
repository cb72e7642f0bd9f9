#!/usr/bin/env python3
"""headers.py BUILD: tests the library as users get it: each public header compiles alone as C11 and as C++17; the library installs; the examples
compile with pkg-config, run, and write a picture; the exported symbols of the shared library are checked."""
import glob
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = sys.argv[1]
results = []


def check(name, ok, output=""):
    results.append(bool(ok))
    print("%s %d - %s" % ("ok" if ok else "not ok", len(results), name))
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-20:]))
    return ok


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def headers(folder):
    for path in sorted(glob.glob(os.path.join(ROOT, "include", "lambent", "*.h"))):
        name = os.path.basename(path)
        text = "#include <lambent/%s>\n" % name
        for language, compiler, standard in (("c", "cc", "c11"), ("c++", "c++", "c++17")):
            done = run([compiler, "-x", language, "-std=" + standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-I",
                        os.path.join(ROOT, "include"), "-fsyntax-only", "-"], input=text)
            check("%s alone as %s" % (name, standard), done.returncode == 0, done.stdout)


def installed(folder):
    stage = os.path.join(folder, "stage")
    done = run(["meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", stage])
    check("meson install", done.returncode == 0, done.stdout)
    found = glob.glob(stage + "/**/lambent.pc", recursive=True)
    check("lambent.pc is installed", len(found) == 1, str(found))
    if len(found) != 1:
        return None
    return {**os.environ, "PKG_CONFIG_PATH": os.path.dirname(found[0]), "PKG_CONFIG_SYSROOT_DIR": stage,
            "LD_LIBRARY_PATH": os.path.dirname(os.path.dirname(found[0]))}


def uninstalled(stage):
    """Only the standard folders remain; `make` itself sets Debian's folder of libraries."""
    files = run(["meson", "introspect", "--installed", BUILD])
    prefix = next(option["value"] for option in json.loads(run(["meson", "introspect", "--buildoptions", BUILD]).stdout)
                  if option["name"] == "prefix")
    done = run([sys.executable, os.path.join(ROOT, "scripts", "uninstall.py"), stage, prefix], input=files.stdout)
    left = [os.path.relpath(os.path.join(path, name), stage + prefix) for path, folders, names in os.walk(stage + prefix) for name in folders + names]
    check("uninstall leaves nothing", done.returncode == 0 and set(left) <= {"bin", "include", "lib", "lib64", "share", "share/man"},
          done.stdout + str(left))
    for name in ("meson", "ninja"):  # only the requested ones are needed
        with open(os.path.join(stage, name), "w") as program:
            program.write("#!/bin/sh\necho %s \"$@\"\n" % name)
        os.chmod(program.name, 0o755)
    multiarch = run(["gcc", "-print-multiarch"]).stdout.strip()
    done = run(["make", "-C", ROOT, "install", "build=" + stage, "-o", stage + "/build.ninja", "DESTDIR=" + stage],
               env={**os.environ, "PATH": stage + ":" + os.environ["PATH"]})
    check("make install names the folder of libraries", not multiarch or "--prefix=/usr/local --libdir=lib/%s\n" % multiarch in done.stdout, done.stdout)


def installed_example(environment, name):
    found = glob.glob(os.path.join(environment["PKG_CONFIG_SYSROOT_DIR"], "**", "doc", "lambent", "examples", name + ".c"), recursive=True)
    check("example %s is installed" % name, len(found) == 1, str(found))
    return found[0] if found else os.path.join(ROOT, "examples", name + ".c")


def static(folder, environment):
    """The static library alone, with `pkg-config --static`: it is complete, and defines no symbol that could collide with a program's symbols."""
    libraries = os.path.dirname(environment["PKG_CONFIG_PATH"])
    library, alone = os.path.join(libraries, "liblambent.a"), os.path.join(folder, "alone")
    if not check("the static library is installed", os.path.exists(library)):
        return
    lines = run(["nm", "-g", "--defined-only", library]).stdout.split("\n")
    names = [line.split()[2] for line in lines if len(line.split()) == 3]
    check("the static library defines lam_ names only", bool(names) and all(n.startswith("lam_") for n in names),
          " ".join(n for n in names if not n.startswith("lam_")))
    os.mkdir(alone)
    os.symlink(library, os.path.join(alone, "liblambent.a"))
    flags = run(["pkg-config", "--static", "--cflags", "--libs", "lambent"], env=environment)
    check("pkg-config --static names what the library needs", flags.returncode == 0 and "-lspng" in flags.stdout, flags.stdout)
    own = os.path.join(folder, "own.c")
    open(own, "w").write("int fail(void); int fail(void) { return 1; }\n") # the library contains an internal function of that name
    program, picture = os.path.join(folder, "static"), os.path.join(folder, "static.png")
    words = [word for word in flags.stdout.split() if word != "-L" + libraries]
    built = run(["cc", "-std=c11", installed_example(environment, "render"), own, "-o", program, "-L" + alone] + words, env=environment)
    if check("example render links statically", built.returncode == 0, built.stdout):
        plain = {k: v for k, v in environment.items() if k != "LD_LIBRARY_PATH"}
        ran = run([program, os.path.join(ROOT, "tests", "models", "cube.obj"), picture], env=plain)
        same = ran.returncode == 0 and open(picture, "rb").read() == open(os.path.join(folder, "render.png"), "rb").read()
        check("it draws the shared library's picture, without it", same and "liblambent" not in run(["ldd", program]).stdout, ran.stdout)


def examples(folder, environment):
    flags = run(["pkg-config", "--cflags", "--libs", "lambent"], env=environment)
    check("pkg-config knows lambent", flags.returncode == 0, flags.stdout)
    models = os.path.join(ROOT, "tests", "models")
    cube = os.path.join(models, "cube.obj")
    arguments = {"render": [cube], "materials": [], "opengl": [cube]}
    for name, more in arguments.items():
        source = installed_example(environment, name)
        program, picture = os.path.join(folder, name), os.path.join(folder, name + ".png")
        built = run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", source, "-o", program] + flags.stdout.split() +
                    (["-lEGL"] if name == "opengl" else []), env=environment)
        check("example %s compiles" % name, built.returncode == 0, built.stdout)
        if built.returncode:
            continue
        ran = run([program] + more + [picture], env=environment)
        if name == "opengl" and ran.returncode == 3 and "there is no OpenGL" in ran.stdout:
            print("ok %d - example opengl # SKIP %s" % (len(results) + 1, ran.stdout.strip()))
            results.append(True)
            continue
        good = ran.returncode == 0 and os.path.exists(picture) and open(picture, "rb").read(8) == b"\x89PNG\r\n\x1a\n"
        check("example %s leaves a picture" % name, good, ran.stdout)
    wrong = run([os.path.join(folder, "render"), "no-such-file.obj", os.path.join(folder, "none.png")], env=environment)
    check("example render tells a missing file", wrong.returncode == 2 and "no-such-file.obj" in wrong.stdout and
          not os.path.exists(os.path.join(folder, "none.png")), wrong.stdout)
    lines = sum(1 for line in open(os.path.join(ROOT, "examples", "render.c")))
    check("example render is under 25 lines (%d)" % lines, lines < 25)


def pixels_of(path):
    """The size and the bytes of a BMP with 32 bits per pixel; None if it does not exist."""
    data = open(path, "rb").read() if os.path.exists(path) else b""
    if data[:2] != b"BM":
        return None
    start, width, height = (int.from_bytes(data[at:at + 4], "little", signed=True) for at in (10, 18, 22))
    return width, abs(height), data[start:]


def widget(folder, environment):
    """The example with a window (SDL2) turns a model in its own buffer, 30 times a second, with SDL's driver without a display."""
    sdl = run(["pkg-config", "--cflags", "--libs", "sdl2"])
    if sdl.returncode:
        print("ok %d - example widget # SKIP SDL2 is not installed: apt install libsdl2-dev" % (len(results) + 1))
        results.append(True)
        return
    flags = run(["pkg-config", "--cflags", "--libs", "lambent"], env=environment)
    program = os.path.join(folder, "widget")
    built = run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", installed_example(environment, "widget"), "-o", program] + flags.stdout.split() +
                sdl.stdout.split(), env=environment)
    if not check("example widget compiles", built.returncode == 0, built.stdout):
        return
    cube, pictures = os.path.join(ROOT, "tests", "models", "cube.obj"), []
    for frames in ("1", "30"):
        bmp = os.path.join(folder, "widget-%s.bmp" % frames)
        ran = run([program, cube, frames, bmp], env={**environment, "SDL_VIDEODRIVER": "dummy"}, timeout=60)
        check("example widget draws %s pictures" % frames, ran.returncode == 0 and ran.stdout.startswith(frames + " pictures of 640x480"), ran.stdout)
        pictures.append(pixels_of(bmp))
    rate = float(ran.stdout.split(", ")[1].split()[0]) if ran.returncode == 0 else 0
    check("example widget keeps to 30 pictures a second (%.1f)" % rate, 5 < rate < 32, ran.stdout)
    shown = all(p and p[:2] == (640, 480) and len({p[2][at:at + 4] for at in range(0, len(p[2]), 4)}) > 3 for p in pictures)
    check("example widget shows the model, and turns it", shown and pictures[0] != pictures[1])
    wrong = run([program, "no-such-file.obj"], env={**environment, "SDL_VIDEODRIVER": "dummy"})
    check("example widget tells a missing file", wrong.returncode == 1 and "no-such-file.obj" in wrong.stdout, wrong.stdout)


def check_library(folder, environment):
    """liblambent-check: a program built with only its pkg-config file checks a shader, and saves a picture with liblambent."""
    flags = run(["pkg-config", "--cflags", "--libs", "lambent-check"], env=environment)
    check("pkg-config knows lambent-check", flags.returncode == 0, flags.stdout)
    program, picture = os.path.join(folder, "check"), os.path.join(folder, "check.pfm")
    built = run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", installed_example(environment, "check"), "-o", program] +
                flags.stdout.split(), env=environment)
    check("example check compiles", built.returncode == 0, built.stdout)
    if built.returncode:
        return
    shader = os.path.join(ROOT, "classroom", "tests", "check", "oregon-no-gate.frag")
    ran = run([program, shader, picture], env=environment)
    if ran.returncode == 3 and "OpenGL" in ran.stdout:
        print("ok %d - example check # SKIP %s" % (len(results) + 1, ran.stdout.strip()))
        results.append(True)
        return
    good = ran.returncode == 0 and "no-gate: " in ran.stdout and open(picture, "rb").read(3) == b"PF\n"
    check("example check names the mistake and saves a picture", good, ran.stdout)


def exported(name):
    library = [path for path in glob.glob(os.path.join(BUILD, "*", name + ".so.*.*.*")) if os.path.isfile(path)]
    lines = run(["nm", "-D", "--defined-only", library[0]]).stdout.split("\n") if library else []
    return [line.split()[2] for line in lines if len(line.split()) == 3]


def functions_of(name, version):
    """The names of the exported functions; each must have the version, which is an absolute symbol itself."""
    names = [symbol for symbol in exported(name) if symbol not in (version, "%s@@%s" % (version, version))]
    other = [symbol for symbol in names if not symbol.endswith("@@" + version)]
    check("%s: every symbol has the version %s" % (name, version), bool(names) and not other, " ".join(other))
    return [symbol.partition("@@")[0] for symbol in names]


def symbols():
    names, of_check = functions_of("liblambent", "LAMBENT_0"), functions_of("liblambent-check", "LAMBENT_CHECK_0")
    strange = [n for n in names if not n.startswith("lam_") or n.startswith("lam_check")]
    check("liblambent exports lam_ names only, and none of lam_check", bool(names) and not strange, " ".join(strange))
    strange = [n for n in of_check if not n.startswith("lam_check_")]
    check("liblambent-check exports lam_check_ names only", bool(of_check) and not strange, " ".join(strange))


def documentation(folder):
    """Every public declaration has a comment, and the reference (scripts/reference.py) contains every function of the libraries."""
    sys.path.insert(0, os.path.join(ROOT, "scripts"))
    import reference
    all_headers = reference.headers(os.path.join(ROOT, "include", "lambent"))
    wrong = list(reference.complaints(all_headers))
    check("every public declaration is documented", not wrong, "\n".join(wrong))
    functions = {item.name for header in all_headers for item in header.items if item.kind == "function"}
    names = {symbol.partition("@@")[0] for symbol in exported("liblambent") + exported("liblambent-check") if symbol.startswith("lam_")}
    check("the reference has the functions that the libraries export", functions == names, " ".join(functions ^ names))
    sample = os.path.join(folder, "sample.h")
    with open(sample, "w") as file:
        file.write("// sample.h: x.\n#ifndef A\n\n// A thing.\ntypedef struct lam_a {\n    int b; // documented\n    int c, *d[2];\n"
                   "    int e; // %s\n} lam_a;\n\nLAM_API int lam_f(void);\n\n"
                   "// Two.\nLAM_API int lam_g(int a,\n                  int b);\nLAM_API void lam_h(void);\n" % ("long " * 20))
    found = [line.partition(": ")[2] for line in reference.complaints([reference.parse(sample)])]
    check("the absence of documentation is found", [f.split(" ")[:2] for f in found] ==
          [["lam_a.c", "is"], ["lam_a.d", "is"], ["lam_a", "e:"], ["lam_f", "is"]], "\n".join(found))
    pages = glob.glob(os.path.join(folder, "stage", "**", "reference.md"), recursive=True)
    text = open(pages[0], encoding="utf-8").read() if pages else ""
    missing = [n for n in names if '<a id="%s">' % n not in text]
    check("the reference is installed and has them all", bool(pages) and not missing, " ".join(missing))


def main():
    with tempfile.TemporaryDirectory() as folder:
        headers(folder)
        environment = installed(folder)
        if environment:
            examples(folder, environment)
            widget(folder, environment)
            static(folder, environment)
            check_library(folder, environment)
            documentation(folder)
            uninstalled(environment["PKG_CONFIG_SYSROOT_DIR"])
        symbols()
    print("1..%d" % len(results))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
