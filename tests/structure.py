#!/usr/bin/env python3
"""structure.py BUILD: the dependencies between source files, read from the symbols of the objects in the build folder.

Two rules order the folders (docs/architecture.md). Files never depend on one another in a circle, in the library or in the programs; and a folder of
the library or of a program uses none below it in the list, and none of the other program. The include paths of the build keep the library's headers to
that order; this test checks function calls, and the programs' headers (a fifth rule). A sixth: no C file outside src/system asks for Windows. A seventh: no folder of the library, the program or the web page has more than 25 files. The third rule: every file that a page or a comment names exists.
The fourth keeps reflection models replaceable: only a lobe's row in src/core/lighting/lobes.h describes it. The ninth orders the scripts of the web page: they import
only from their own folder and folders before it in the list FOLDERS of web/bundle.py, and never in a circle. The tenth: only public functions have more
than 8 parameters. The eleventh holds the wings of src: the core uses only itself, src/system and the entry headers of the effects, apart from CORE_USES, and the other
wings also enter the effects by these headers only."""
import collections
import functools
import glob
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def library_folders():
    """The folders in their order: the base's own, and the subdir() lines of src/meson.build with their wings."""
    text = open(os.path.join(ROOT, "src", "meson.build")).read()
    inner = re.findall(r"'(\w+)'", re.search(r"^base_folders = \[(.*)\]", text, re.M)[1])
    names = re.findall(r"^ *subdir\('([\w/]+)'\)", text, re.M)
    return ["core/base/" + name for name in inner] + [name for name in names if name != "core/base"]


def floors(folder, name):
    """The folders of a program or of the program library in their order: the list NAME in FOLDER/meson.build."""
    text = open(os.path.join(ROOT, folder, "meson.build")).read()
    folders = re.findall(r"'([\w/.]+)'", re.search(r"^%s = \[(.*?)\]" % name, text, re.M | re.S)[1])
    return ["%s/%s" % (folder, inner) for inner in folders]


class Order:
    """src → program → tools, and src → program → classroom: neither program knows the other. A program's main.c may use all of its folders."""

    def __init__(self):
        self.trunk = library_folders() + floors("program", "program_folders")
        self.programs = [floors("tools", "floors") + ["tools"], ["classroom/check"] + floors("classroom", "classroom_floors") + ["classroom"]]

    def allows(self, user, used):
        """Whether a file of the folder USER may use one of the folder USED."""
        for folders in [self.trunk] + [self.trunk + program for program in self.programs]:
            if user in folders:
                return used in folders and folders.index(used) <= folders.index(user)
        raise ValueError("%s is in no list of folders" % user)


def folder_of(file):
    """core/base/text/number -> core/base/text; gpu/gl/loader -> gpu/gl; formats/import/obj/obj -> formats/import; system/files/file -> system;
    tools/batch/jobs/job_words -> tools/batch/jobs."""
    if file.startswith(("tools/", "program/", "classroom/commands/", "classroom/main", "gpu/glsl/")):
        return os.path.dirname(file)
    return "/".join(file.split("/")[:1 if file.startswith("system/") else 3 if file.startswith("core/base/") else 2])


@functools.cache
def program_files():
    """The C files and headers of the programs and of the program library, as paths from the root."""
    return ["classroom/main.c"] + sorted(os.path.relpath(os.path.join(path, name), ROOT) for top in ("program", "tools", "classroom/commands")
                                         for path, _, names in os.walk(os.path.join(ROOT, top)) for name in names if name.endswith((".c", ".h")))


def headers_back(order):
    """(file, header) for each header that a file of a program includes from a folder that it may not use. The header of the check is the classroom's."""
    place = {os.path.basename(file): file for file in program_files() if file.endswith(".h")}
    for file in program_files():
        for name in re.findall(r'^#include ["<]([^">]+)[">]', open(os.path.join(ROOT, file), encoding="utf-8").read(), re.M):
            header = "classroom/check/check.h" if name == "lambent/check.h" else place.get(name)
            if header and not order.allows(folder_of(file), folder_of(header)):
                yield file, header


def objects(build):
    for top in ("src", "program", "classroom/check", "lambent.p", "lambent-classroom.p"):
        for path, _, names in os.walk(os.path.join(build, top)):
            # without_effects.c defines the same functions as the effects.
            yield from (os.path.join(path, name) for name in names if name.endswith(".o") and "without-effects" not in path)


def source_of(build, path):
    """src/gpu/gl/liblambent-gl.a.p/loader.c.o -> gl/loader; sub-folders are in the object's name, joined by _.
    lambent.p/tools_job_job_scene.c.o -> tools/job/job_scene."""
    if os.path.basename(os.path.dirname(path)) in ("lambent.p", "lambent-classroom.p"):
        name = os.path.basename(path)[:-2]
        return next(file[:-2] for file in program_files() if file.replace("/", "_") == name)
    top, *folders = os.path.relpath(path, build).split(os.sep)[:-2]
    folder = "/".join(folders)
    name, inside = re.sub(r"\.c\.o$", "", os.path.basename(path)), os.path.join(ROOT, top, folder)
    folder = folder if top == "src" else os.path.normpath("%s/%s" % (top, folder))
    for inner in sorted(os.listdir(inside)):
        if name.startswith(inner + "_") and os.path.exists(os.path.join(inside, inner, name[len(inner) + 1:] + ".c")):
            return "%s/%s/%s" % (folder, inner, name[len(inner) + 1:])
    return "%s/%s" % (folder, name)


def graph(build):
    defined, used = {}, collections.defaultdict(set)
    paths = list(objects(build))
    files = {path: source_of(build, path) for path in paths}
    # One process for all: hundreds would take most of the test's time.
    for line in subprocess.run(["nm", "-A", *paths], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines():
        path, rest = line.split(":", 1)
        kind, symbol = rest.split()[-2:]
        if kind in "TDBRV":
            defined[symbol] = files[path]
        elif kind == "U":
            used[files[path]].add(symbol)
    edges = collections.defaultdict(lambda: collections.defaultdict(list))
    for file, symbols in used.items():
        for symbol in symbols:
            if symbol in defined and defined[symbol] != file:
                edges[file][defined[symbol]].append(symbol)
    return edges


def circles(edges):
    """Tarjan's strongly connected components of more than one file."""
    index, low, stack, on, found, count = {}, {}, [], set(), [], [0]

    def visit(v):
        index[v] = low[v] = count[0]
        count[0] += 1
        stack.append(v)
        on.add(v)
        for w in edges.get(v, {}):
            if w not in index:
                visit(w)
                low[v] = min(low[v], low[w])
            elif w in on:
                low[v] = min(low[v], index[w])
        if low[v] == index[v]:
            part = []
            while not part or part[-1] != v:
                part.append(stack.pop())
                on.discard(part[-1])
            if len(part) > 1:
                found.append(sorted(part))

    sys.setrecursionlimit(10000)
    for v in list(edges):
        if v not in index:
            visit(v)
    return found


# The only headers of src/effects that other wings include. They call only functions that these headers or include/lambent declare.
ENTRIES = ["environment/environment.h", "rays/rays.h", "edges/edges.h", "occlusion/occlusion.h", "paths/paths.h"]
# What the core uses outside core, system and these headers: the reader of scene files reads JSON, and adds the shapes and model files that a scene names.
CORE_USES = {"core/description": ("formats/json", "formats/import", "formats/prepare", "formats/shapes")}
WING = re.compile(r"core|effects|formats|gpu|system")


def leaves_wing(edges):
    """(file, complaint) for each include or call that leaves a wing of src where it must not."""
    src = os.path.join(ROOT, "src")
    read = lambda path: open(os.path.join(ROOT, path), encoding="utf-8").read()  # noqa: E731
    place = collections.defaultdict(set)
    files = [os.path.relpath(os.path.join(path, name), src) for path, _, names in os.walk(src) for name in names if name.endswith((".c", ".h", ".inc"))]
    for file in files:
        place[os.path.basename(file)].add(file)
    declared = "".join(read("src/effects/" + name) for name in ENTRIES)
    declared += "".join(read(name) for name in glob.glob("include/lambent/*.h", root_dir=ROOT))

    def allowed(file, wing, folder):
        return wing in ("core", "system") or folder in CORE_USES.get("/".join(file.split("/")[:2]), ())

    for file in sorted(files):
        own = file.split("/")[0]
        for name in re.findall(r'^#include "([^"]+)"', read("src/" + file), re.M):
            for header in place[name] if len(place[name]) == 1 else ():
                wing, folder = header.split("/")[0], "/".join(header.split("/")[:2])
                if own != "effects" and wing == "effects" and header[len("effects/"):] not in ENTRIES:
                    yield file, "includes %s, which is no entry of the effects" % header
                elif own == "core" and wing != "effects" and not allowed(file, wing, folder):
                    yield file, "includes " + header
    for file in sorted(edges):
        own = file.split("/")[0]
        for other in sorted(edges[file]) if WING.fullmatch(own) else ():
            wing, folder = other.split("/")[0], "/".join(other.split("/")[:2])
            if own != "effects" and wing == "effects":
                inner = [name for name in edges[file][other] if not re.search(r"\b%s\(" % name, declared)]
                yield from ((file, "calls %s of %s" % (name, other)) for name in sorted(inner))
            elif own == "core" and not allowed(file, wing, folder):
                yield file, "calls %s of %s" % (", ".join(sorted(edges[file][other])), other)


TOPS = "src|program|classroom|tools|tests|include|web|scripts|bench|examples|docs"
# What is asked of the system that a program is compiled for, outside the one folder that knows Windows.
WINDOWS = re.compile(r"\b_WIN\w*\b|\b__MINGW\w*|<windows\.h>")
NAMED = re.compile(r"(?<![\w./-])((?:%s)/[\w./-]*\w)" % TOPS)  # a path from the root
BARE = re.compile(r"(?<![\w./<-])([a-z][a-z_0-9]+\.(?:c|inc|h))(?!\w)")  # a file without its folder, in a comment of the library
ELSEWHERE = {"jpeglib.h", "teapots.c", "docs/turning"}  # a library's, a program's that is cited, a program that is built


def missing_files():
    """(file, name) for each path in a page or a C file, and each file in a comment of the library, that is not there."""
    files = [os.path.relpath(os.path.join(path, name), ROOT) for top in ["."] + TOPS.split("|") for path, folders, names in
             os.walk(os.path.join(ROOT, top)) if top != "." or not folders.clear() for name in names]
    known = {os.path.basename(name) for name in files}
    for file in files:
        if not file.endswith((".c", ".h", ".inc", ".md")) or file == "CHANGELOG.md" or "node_modules" in file:
            continue
        for line in open(os.path.join(ROOT, file), encoding="utf-8", errors="replace"):
            for name in NAMED.findall(line):
                # A name may stand for several files or one that is made: docs/turning.c, results/DATE.json, job_*.
                if not (os.path.exists(os.path.join(ROOT, name)) or glob.glob(os.path.join(ROOT, name) + "*") or
                        "DATE" in name or name in ELSEWHERE):
                    yield file, name
            if file.startswith(("src/", "program/", "classroom/")) and not file.endswith(".md") and "//" in line:
                yield from ((file, name) for name in BARE.findall(line.split("//", 1)[1]) if name not in known | ELSEWHERE)


NAMED_LOBE = re.compile(r"[!=]= *LAM_REFLECTION_(?!NONE\b|AUTO\b)\w+")


def windows_elsewhere():
    """Files of C that ask for Windows outside src/system."""
    for top in ("src", "program", "tools", "classroom", "include"):
        for path, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [f for f in folders if os.path.relpath(os.path.join(path, f), ROOT) != os.path.join("src", "system")]
            for name in sorted(names):
                if name.endswith((".c", ".h", ".inc")) and WINDOWS.search(open(os.path.join(path, name), encoding="utf-8").read()):
                    yield os.path.relpath(os.path.join(path, name), ROOT)


def tests_in_no_suite():
    """Test files that no meson.build names. Those in tests/cli and tests/python are found by their scripts, and english.py is a part of style.py."""
    text = "".join(open(file).read() for file in glob.glob(os.path.join(ROOT, "**", "tests", "**", "meson.build"), recursive=True))
    for pattern in ("tests/*/test_*.c", "tests/*.py", "tests/*/run.py", "classroom/tests/*/test_*.*", "classroom/tests/web/*.py"):
        for file in sorted(glob.glob(pattern, root_dir=ROOT)):
            stem = os.path.splitext(os.path.basename(file))[0]
            if file != "tests/english.py" and not re.search(r"\b%s\b|'%s'" % (re.escape(stem), re.escape(stem.removeprefix("test_"))), text):
                yield file


def large_folders():
    """Folders of the library, the program and the page with more than 25 files: nobody finds one at a glance."""
    for top in ("src", "program", "tools", "classroom", "web"):
        for path, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [name for name in folders if name not in ("node_modules", "tests")]
            if len(names) > 25:
                yield os.path.relpath(path, ROOT), len(names)


IMPORT = re.compile(r"""(?:\bfrom |\bimport |\bimport\()["'](\.[^"']*)["']""")


def page_folders():
    """The folders of the page in their order: the list in web/bundle.py. Scripts outside web/page come before them: they know nothing of the page."""
    text = open(os.path.join(ROOT, "web", "bundle.py"), encoding="utf-8").read()
    names = re.findall(r'"([\w.]+)"', re.search(r"^FOLDERS = \[(.*)\]", text, re.M)[1])
    return ["web", "classroom/web", *(os.path.normpath("web/page/" + name) for name in names)]


def script_imports():
    """{file: {imported file: [the text of the import]}} of the scripts of web/, with what is imported when it is first used."""
    edges = {}
    for pattern in ("web/*.js", "classroom/web/*.js", "web/page/**/*.js"):
        for file in glob.glob(pattern, root_dir=ROOT, recursive=True):
            edges[file] = collections.defaultdict(list)
            for name in IMPORT.findall(open(os.path.join(ROOT, file), encoding="utf-8").read()):
                edges[file][os.path.normpath(os.path.join(os.path.dirname(file), name))].append(name)
    return edges


def imports_back():
    """(file, complaint) for each script of the page that is in no folder of the list, imports from a folder after its own, or is in a circle."""
    edges, order = script_imports(), page_folders()
    for file in sorted(edges):
        if os.path.dirname(file) not in order:
            yield file, "is in a folder that web/bundle.py does not list"
            continue
        for other in sorted(edges[file]):
            folder = os.path.dirname(other)
            if folder not in order or order.index(folder) > order.index(os.path.dirname(file)):
                yield file, "imports " + other
    for part in circles(edges):
        yield part[0], "is in a circle with " + ", ".join(part[1:])


def lobes_asked_by_name():
    """(file, comparison) for each reflection model that the library compares by its name. The lecture style spells out the equations of a few models."""
    src = os.path.join(ROOT, "src")
    for path, _, names in os.walk(src):
        for name in sorted(names):
            file = os.path.relpath(os.path.join(path, name), src)
            if file.endswith((".c", ".h", ".inc")) and not file.startswith("gpu/glsl/lecture/"):
                yield from ((file, found) for found in NAMED_LOBE.findall(open(os.path.join(src, file), encoding="utf-8").read()))


FUNCTION = re.compile(r"^[a-z_][\w *]*?\b(\w+)\(((?:[^()]|\([^()]*\))*)\)\s*[{;]", re.M)


def long_parameter_lists():
    """(file, function, count) for each function with more than 8 parameters that is not public."""
    for top in ("src", "program", "tools", "classroom", "web"):
        for path, _, names in os.walk(os.path.join(ROOT, top)):
            for name in sorted(names):
                if name.endswith((".c", ".h", ".inc", ".cpp")):
                    text = re.sub(r"//[^\n]*", "", open(os.path.join(path, name), encoding="utf-8").read())
                    for function, parameters in FUNCTION.findall(text):
                        count = len(re.sub(r"\([^()]*\)", "", parameters).split(","))
                        if count > 8 and not function.startswith("lam_"):
                            yield os.path.relpath(os.path.join(path, name), ROOT), function, count


LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
FIELD = re.compile(r"\blam_(?:control|load_params|draw_params|shader_params|object)\.\w+|\blam_scene_set_environment\b")


def options_in_messages():
    """(file, complaint) for each text of the library that names an option of the program, or a field for which the program knows no option or
    which no header has. The library of checks (classroom/check) belongs to the command `check`: its hints name its options."""
    def read(path):
        return open(os.path.join(ROOT, path), encoding="utf-8").read()
    known = set(re.findall(r'\{"(lam_\w+(?:\.\w+)?)", "--', read("program/base/option_names.c")))
    known |= {"lam_draw_params." + member for member in re.findall(r"MEMBER\(\w+, (\w+)\)", read("src/core/scene/fields/settings.c"))}
    headers = "".join(read("include/lambent/" + name) for name in os.listdir(os.path.join(ROOT, "include/lambent")))
    for field in sorted(known):
        if not re.search(r"\b%s\b" % field.split(".")[-1], headers):
            yield "program/base/option_names.c", field + " is in no header"
    for path, _, names in os.walk(os.path.join(ROOT, "src")):
        for name in sorted(names):
            file = os.path.relpath(os.path.join(path, name), ROOT)
            if not file.endswith((".c", ".h", ".inc")):
                continue
            for text in LITERAL.findall(re.sub(r"(?m)^\s*//.*", "", read(file))):
                yield from ((file, "names the option " + option) for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", text))
                yield from ((file, "no option is known for " + field) for field in FIELD.findall(text) if field not in known)


def main():
    edges, order = graph(sys.argv[1]), Order()
    used = lambda a, b: "%s uses %s: %s" % (a, b, ", ".join(sorted(edges[a][b])[:6]))  # noqa: E731
    enters = lambda a, b: a.startswith("core/") and b.startswith("effects/")  # noqa: E731  the eleventh rule
    back = sorted((a, b) for a in edges for b in edges[a] if not order.allows(folder_of(a), folder_of(b)) and not enters(a, b))
    rules = [
        ("no circle between files", [used(a, b) for part in circles(edges) for a in part for b in part if b in edges[a]]),
        ("no folder uses one below it", [used(a, b) for a, b in back]),
        ("files that pages and comments name are there", ["%s names %s" % one for one in sorted(set(missing_files()))]),
        ("what is asked of a lobe is asked of its row", ["src/%s: %s" % one for one in lobes_asked_by_name()]),
        ("no folder of a program includes a header from one below it, or from the other program", ["%s includes %s" % one for one in headers_back(order)]),
        ("no text of the library names an option of the program", ["%s: %s" % one for one in options_in_messages()]),
        ("Windows is known to src/system alone", ["%s asks for it" % file for file in sorted(windows_elsewhere())]),
        ("every test file is in a suite", ["%s is in none" % file for file in tests_in_no_suite()]),
        ("no folder has more than 25 files", ["%s has %d" % one for one in sorted(large_folders())]),
        ("no script of the page imports from a folder after its own", ["%s %s" % one for one in imports_back()]),
        ("no internal function has more than 8 parameters", ["%s: %s has %d" % one for one in long_parameter_lists()]),
        ("the wings of src use one another only as listed", ["%s %s" % one for one in leaves_wing(edges)])]
    print("1..%d" % len(rules))
    for number, (rule, complaints) in enumerate(rules, 1):
        print("%s %d - %s" % ("not ok" if complaints else "ok", number, rule))
        for complaint in complaints:
            print("#   " + complaint)
    if not edges:
        print("# no objects were found in %s" % sys.argv[1])
    return 1 if not edges or any(complaints for _, complaints in rules) else 0


if __name__ == "__main__":
    sys.exit(main())
