"""module_parts.py: the served page's module in parts: what draws the first pictures (lambent.wasm), what most pages need after that (lambent-rest.wasm),
and what is fetched when it is used (lambent-more.wasm): explanations, formulas, sweeps, scene files that are written. wasm-split (Binaryen) divides them; what a
page never calls is left out."""
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = ("lambent.wasm", "lambent-rest.wasm", "lambent-more.wasm")
# What the module uses of WebAssembly.
FEATURES = ["--enable-" + name for name in ("simd", "exception-handling", "bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals")]
# Functions by their objects in the linker's map.
UNUSED = r"libjpeg\.a\((jc(?!omapi)|jfdct)|jpeg_write\.c" # the page saves PNG; reading needs jcomapi too
MORE = r"cpu-recording\.a\.p|[/_]explain(_json)?\.c\.o|contents\.c\.o|sweep_option\.c\.o|show_all\.c\.o|formula_\w+\.c\.o|scene_write\.c\.o|:\((web_contents|(web|job)_explain)\)$"


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("web: %s failed:\n%s" % (" ".join(command[:3]), done.stdout[-4000:]))
    return done.stdout


def functions(map_path):
    """The names "archive(object):(symbol)" of the module's functions, in their order."""
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
    """The second division makes the table longer, which the first one's part says the exact length of: it takes any that is long enough."""
    call("wasm-dis", *FEATURES, module, "-o", work + ".wat")
    text, count = re.subn(r'(\(import "primary" "[^"]*" \(table \S+ \d+) \d+ funcref', r"\1 funcref", open(work + ".wat").read())
    if count != 1:
        sys.exit("web: wasm-split's part has %d tables, expected 1" % count)
    open(work + ".wat", "w").write(text)
    call("wasm-as", *FEATURES, work + ".wat", "-o", module)


def split(unsplit, parts):
    """Writes the three parts, of UNSPLIT.wasm and its map, unless they are newer."""
    newest = max(os.path.getmtime(path) for path in (unsplit + ".wasm", os.path.abspath(__file__), os.path.join(HERE, "split.mjs")))
    if all(os.path.exists(part) and os.path.getmtime(part) > newest for part in parts):
        return
    names = functions(unsplit + ".map")
    with tempfile.TemporaryDirectory() as work:
        at = lambda name: os.path.join(work, name)  # noqa: E731
        # Without names wasm-split calls functions by their numbers, and numbers those that stay anew.
        with open(at("unused"), "w") as out:
            out.write("\n".join(str(i) for i, name in enumerate(names) if re.search(UNUSED, name)))
        call("wasm-split", *FEATURES, unsplit + ".wasm", "--split-funcs=@" + at("unused"), "--placeholder-namespace=unused", "--export-prefix=u.", "-o1", at("a.wasm"), "-o2",
             at("unused.wasm"))
        kept = [name for name in names if not re.search(UNUSED, name)]
        with open(at("more"), "w") as out:
            out.write("\n".join(str(i) for i, name in enumerate(kept) if re.search(MORE, name)))
        call("wasm-split", *FEATURES, at("a.wasm"), "--split-funcs=@" + at("more"), "--placeholder-namespace=more", "--export-prefix=m.", "-o1", at("b.wasm"), "-o2",
             at("more.wasm"))
        call("wasm-opt", *FEATURES, "-O2", at("b.wasm"), "-o", at("c.wasm"))
        relax_table(at("more.wasm"), at("more"))
        call("wasm-opt", *FEATURES, "-O2", at("more.wasm"), "-o", parts[2])
        call("wasm-split", *FEATURES, "--instrument", at("c.wasm"), "-o", at("counting.wasm"))
        call("node", os.path.join(HERE, "split.mjs"), at("counting.wasm"), at("profile"))
        call("wasm-split", *FEATURES, at("c.wasm"), "--profile=" + at("profile"), "--placeholder-namespace=rest", "-o1", parts[0], "-o2", parts[1])
