"""module_parts.py: divides the served page's module into parts: functions for the first pictures (lambent.wasm), functions that most pages need after
that (lambent-rest.wasm), and functions downloaded on first use (lambent-more.wasm): explanations, formulas, sections, sweeps, arithmetic JPEG, 3MF, reading and
writing scene files. The module with threads has two parts; the first (lambent-threads.wasm) replaces both. wasm-split (Binaryen) divides them; functions that a
page never calls are omitted."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = ("lambent.wasm", "lambent-rest.wasm", "lambent-more.wasm")
THREADS_PARTS = ("lambent-threads.wasm", "lambent-threads-more.wasm")
# The features of WebAssembly that the module uses.
FEATURES = ["--enable-" + name for name in ("simd", "exception-handling", "bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals")]
# The functions of each object in the linker's map.
UNUSED = r"libjpeg\.a\((jc(?!omapi)|jfdct)|jpeg_write\.c" # the page saves PNG; reading also needs jcomapi
# Only the calling thread runs them: the other threads have only the first part.
MORE = r"cpu-recording\.a\.p|[/_]explain(_json)?\.c\.o|contents\.c\.o|sweep_option\.c\.o|(mesh_cut|regions|outlines)\.c\.o|scene_join\.c\.o|show_all\.c\.o|jdarith\.o|formula_\w+\.c\.o|threemf_threemf_\w+\.c\.o|libexpat\.a|scene_write\.c\.o|scene_(objects|models|transforms)\.c\.o|:\((web_contents|web_curves|web_lights|light_of|curve_json|(web|job)_explain)\)$"


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("web: %s failed:\n%s" % (" ".join(command[:3]), done.stdout[-4000:]))
    return done.stdout


def functions(map_path):
    """The names "archive(object):(symbol)" of the module's functions, in order."""
    names, inside = [], False
    for line in open(map_path):
        found = re.match(r"\s*\S+\s+[0-9a-f]+\s+[0-9a-f]+\s+(.*)", line)
        name = found[1].strip() if found else ""
        if name in ("CODE", "DATA"):
            inside = name == "CODE"
        elif inside and ":(" in name:
            names.append(name)
    return names


def relax_table(module, work):
    """The second division makes the table longer, but the first one's part states its exact length; therefore it accepts any sufficient length."""
    call("wasm-dis", *FEATURES, module, "-o", work + ".wat")
    text, count = re.subn(r'(\(import "primary" "[^"]*" \(table \S+ \d+) \d+ funcref', r"\1 funcref", open(work + ".wat").read())
    if count != 1:
        sys.exit("web: wasm-split's part has %d tables, expected 1" % count)
    open(work + ".wat", "w").write(text)
    call("wasm-as", *FEATURES, work + ".wat", "-o", module)


def is_new(unsplit, parts):
    newest = max(os.path.getmtime(path) for path in (unsplit + ".wasm", os.path.abspath(__file__), os.path.join(HERE, "split.mjs")))
    return all(os.path.exists(part) and os.path.getmtime(part) > newest for part in parts)


class Division:
    """The divisions that all modules share, in a folder of files: `first` is a module without functions that pages never call and without `more`, its
    second part."""

    def __init__(self, unsplit, work, more, features=()):
        """`more`: the namespace in which the first part calls the second (web/lambent.js)."""
        self.work, self.features = work, [*FEATURES, *features]
        names = functions(unsplit + ".map")
        self._divide(unsplit + ".wasm", names, UNUSED, "unused", ("a.wasm", "unused.wasm"))
        self._divide(self.at("a.wasm"), [name for name in names if not re.search(UNUSED, name)], MORE, more, ("b.wasm", "more.wasm"))
        self.first, self.more = self.at("c.wasm"), self.at("more.wasm")
        call("wasm-opt", *self.features, "-Oz", self.at("b.wasm"), "-o", self.first) # as fast as with -O2

    def at(self, name):
        return os.path.join(self.work, name)

    def _divide(self, module, names, pattern, namespace, parts):
        # Without names, wasm-split calls functions by number, and renumbers the remaining ones.
        with open(self.at(namespace), "w") as out:
            out.write("\n".join(str(i) for i, name in enumerate(names) if re.search(pattern, name)))
        call("wasm-split", *self.features, module, "--split-funcs=@" + self.at(namespace), "--placeholder-namespace=" + namespace, "--export-prefix=%s." % namespace[0],
             "-o1", self.at(parts[0]), "-o2", self.at(parts[1]))


def split(unsplit, parts):
    """Writes the three parts of UNSPLIT.wasm and its map, unless they are newer."""
    if is_new(unsplit, parts):
        return
    with tempfile.TemporaryDirectory() as work:
        made = Division(unsplit, work, "more")
        relax_table(made.more, made.at("more"))
        call("wasm-opt", *FEATURES, "-Oz", made.more, "-o", parts[2])
        call("wasm-split", *FEATURES, "--instrument", made.first, "-o", made.at("counting.wasm"))
        call("node", os.path.join(HERE, "split.mjs"), made.at("counting.wasm"), made.at("profile"))
        call("wasm-split", *FEATURES, made.first, "--profile=" + made.at("profile"), "--placeholder-namespace=rest", "-o1", parts[0], "-o2", parts[1])


def split_threads(unsplit, parts):
    """Writes the two parts of the module with threads in the same way."""
    if is_new(unsplit, parts):
        return
    with tempfile.TemporaryDirectory() as work:
        made = Division(unsplit, work, "threads-more", ["--enable-threads"])
        shutil.copyfile(made.first, parts[0])
        call("wasm-opt", *made.features, "-Oz", made.more, "-o", parts[1])
