#!/usr/bin/env python3
"""build.py [FOLDER]: the modules for the web in FOLDER (build-web): the libraries (libraries.py), then WebAssembly by Meson and
clang 19. What is up to date is left alone. `make web` calls it; packages: group `web` of packages.txt."""
import base64
import fcntl
import gzip
import hashlib
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
NEEDS = {"clang-19": "clang-19", "wasm-ld-19": "lld-19", "/usr/lib/llvm-19/bin/llvm-ar": "llvm-19", "dpkg-source": "dpkg-dev", "node": "nodejs",
         "wasm-split": "binaryen", "/usr/include/wasm32-wasi/stdio.h": "wasi-libc",
         "/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a": "libclang-rt-19-dev-wasm32"}


def missing():
    """The packages of the group that are not installed."""
    return [package for need, package in NEEDS.items() if not (os.path.exists(need) if "/" in need else shutil.which(need))]


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("web: %s failed:\n%s" % (" ".join(command[:3]), done.stdout[-4000:]))
    return done.stdout


# The page's scripts begin here; what they import is found in them (modules_of), and what they fetch when it is used, import('./NAME.js'), too
# (later_modules_of).
PAGE = "page.js"
WORKER = "worker.js"
THREAD = "thread.js" # of the module with threads

CHECK_WORKER = "check_worker.js"
CODEMIRROR = "codemirror.js" # made from npm's

# The one-file page has in it what the served one fetches: scripts of workers as texts, the rest packed. These functions stand before its script,
# and in place of those of the same names; "": it needs none.
INSIDE_FIRST = """const insideText = (id) => document.getElementById(id).textContent;
const insideStream = (id) => new Response(new Blob([Uint8Array.from(atob(insideText(id)), (letter) => letter.charCodeAt(0))]).stream().pipeThrough(new DecompressionStream('gzip')));
const insideScript = (text) => URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
"""
INSIDE = {
    "fetchModule": "",
    "openWorker": """function openWorker() {
  const served = document.getElementById('served'), threads = served && JSON.parse(served.textContent).threads; // by lambent view
  return caller(new Worker(insideScript(insideText('worker'))), insideStream('wasm').arrayBuffer(),
    threads ? withThreads(async () => (await import('./served.js')).fetchThreads(), insideScript(insideText('thread'))) : []);
}
""",
    "openCheck": """function openCheck() {
  wasm ??= insideStream('check-wasm').arrayBuffer();
  const worker = new Worker(insideScript(insideText('check-worker')));
  return { ...caller(worker, wasm), end: () => worker.terminate() };
}
""",
    "openCodeMirror": """async function openCodeMirror() {
  return import(insideScript(await insideStream('codemirror').text()));
}
""",
}


def packed_text(content):
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def with_files(page, files):
    """The one-file page with files in it, {path: bytes}, for links that draw them."""
    texts = "".join('<script type="text/plain" class="inside-file" data-path="%s" data-packed="gzip">%s</script>\n' % (html.escape(path), packed_text(content))
                    for path, content in sorted(files.items()))
    return page.replace('<script type="text/plain" id="worker">', texts + '<script type="text/plain" id="worker">', 1)


def correct_programs():
    """The correct programs of the contracts (tests/check) that WebGL 2 can draw: GLSL ES 3.00 has no blocks of varyings."""
    return sorted(name[:-5] for name in os.listdir(os.path.join(ROOT, "tests", "check")) if name.endswith(".vert") and name != "pittsburgh-blocks.vert")


def programs():
    """The script with the correct programs that the page offers."""
    contracts = [name[:-5] for name in os.listdir(os.path.join(ROOT, "src", "check", "contracts"))]
    rows = []
    for name in correct_programs():
        mine = max((contract for contract in contracts if name == contract or name.startswith(contract + "-")), key=len)
        texts = {part: open(os.path.join(ROOT, "tests", "check", name + ending)).read() for part, ending in (("vertex", ".vert"), ("fragment", ".frag"))}
        rows.append({"name": name, "contract": mine, **texts})
    return "export const PROGRAMS = %s;\n" % json.dumps(rows)


def packages(folder, source=HERE):
    """The folder of node's modules with what SOURCE/package-lock.json names, installed in FOLDER/npm where it is not yet; None: npm is missing or cannot
    get it."""
    place = os.path.join(folder, "npm")
    lock = open(os.path.join(source, "package-lock.json")).read()
    stamp = os.path.join(place, "installed")
    if not os.path.exists(stamp) or open(stamp).read() != lock:
        if not shutil.which("npm"):
            return None
        os.makedirs(place, exist_ok=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(os.path.join(source, name), place)
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1"], cwd=place, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        if done.returncode:
            return None
        open(stamp, "w").write(lock)
    return os.path.join(place, "node_modules")


def codemirror(folder):
    """The text editor as one script with its licences; None: npm cannot get it, and the page has a plain field in its place."""
    modules = packages(folder)
    if not modules:
        print("web: npm cannot install CodeMirror: shaders are edited in a plain field", flush=True)
        return None
    facts, made = os.path.join(folder, "npm", "codemirror.json"), os.path.join(folder, "npm", CODEMIRROR)
    done = subprocess.run([os.path.join(modules, ".bin", "esbuild"), os.path.join(HERE, "check", "codemirror.src.js"), "--bundle", "--minify", "--format=esm",
                             "--target=es2022", "--metafile=" + facts, "--outfile=" + made], env={**os.environ, "NODE_PATH": modules}, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode:
        sys.exit("web: esbuild fails:\n" + done.stderr.decode()[-3000:])
    used = sorted({re.search(r"node_modules/((?:@[^/]+/)?[^/]+)/", name)[1] for name in json.load(open(facts))["inputs"] if "node_modules/" in name})
    licences = {}
    for name in used:
        licences.setdefault(open(os.path.join(modules, name, "LICENSE")).read().strip(), []).append(name)
    notice = "\n\n".join("%s\n\n%s" % (", ".join(names), text) for text, names in licences.items())
    return b"/*\n" + notice.encode() + b"\n*/\n" + open(made, "rb").read()


def page_file(name):
    """A file of the page, a script without the lines that are comments alone: the page loads sooner."""
    if name == "programs.js":
        return programs()
    paths = [os.path.join(HERE, folder, name) for folder in ("page", "check", "")]
    text = open(next((path for path in paths if os.path.exists(path)), paths[0])).read()
    return re.sub(r"^[ \t]*//.*\n", "", text, flags=re.M) if name.endswith(".js") else text


IMPORT = re.compile(r"^import (?:(\{[^}]*\}) from )?'\./([\w.]+)';\n", re.M)
LATER = re.compile(r"\bimport\('\./([\w.]+)'\)")


def modules_of(name, above=()):
    """A script and all that it imports, each after those that it imports."""
    if name in above:
        sys.exit("web: %s import one another" % " and ".join(above[above.index(name):]))
    found = []
    for _, other in IMPORT.findall(page_file(name)):
        found += [module for module in modules_of(other, above + (name,)) if module not in found]
    return found + [name]


def later_modules_of(first):
    """What a script fetches when it is used: the modules of its import('./NAME.js'), and what these import that it has not from its start."""
    found = modules_of(first)
    start = len(found)
    for name in found: # which grows
        for other in LATER.findall(page_file(name)):
            found += [module for module in modules_of(other) if module not in found]
    return found[start:]


def plain_script(first):
    """Modules as one script: each is a function that returns its exports, so that names at the top of two of them do not collide. Those of the
    start are called where they stand, and those that are fetched when they are used, at their first use. Modules import by name alone, and do not
    await at the top."""
    out = []
    later = later_modules_of(first)

    def module(name):
        return "module_" + re.sub(r"\W", "_", name) + ("()" if name in later else "")

    for name in modules_of(first) + later:
        variable = "module_" + re.sub(r"\W", "_", name)
        text = IMPORT.sub(lambda m: "const %s = %s;\n" % (m[1].replace(" as ", ": "), module(m[2])) if m[1] else module(m[2]) + ";\n", page_file(name))
        for function, inside in INSIDE.items():
            text = re.sub(r"^(export )?(async )?function %s\([^\n]*\) \{\n.*?\n\}\n" % function, lambda m: (m[1] or "") + inside if inside else "", text, count=1, flags=re.S | re.M)
        text = LATER.sub(lambda m: "Promise.resolve().then(() => %s)" % module(m[1]), text)
        listed = [word.strip() for group in re.findall(r"^export \{(.*)\};\n", text, flags=re.M) for word in group.split(",")]
        text = re.sub(r"^export \{.*\};\n", "", text, flags=re.M)
        declared = re.findall(r"^export (?:async )?(?:function|class|const|let) ([\w$]+|\{[^}]*\})", text, flags=re.M)
        exports = sorted(set(listed + [word.strip() for one in declared for word in one.strip("{}").split(",")]))
        text = re.sub(r"^export ", "", text, flags=re.M)
        if re.search(r"^(import|export)\b", text, flags=re.M):
            sys.exit("web: %s: an import or export in a form that the one-file page cannot have" % name)
        made = "(() => {\n%sreturn { %s };\n})()" % (text, ", ".join(exports))
        out.append("function %s() { return %s.made ??= %s; }\n" % (variable, variable, made) if name in later else "const %s = %s;\n" % (variable, made))
    return "".join(out)


def write(path, content):
    """Writes a file, unless it is as it should be: another test may read it."""
    content = content.encode() if isinstance(content, str) else content
    if not os.path.exists(path) or open(path, "rb").read() != content:
        with open(path + ".new", "wb") as out:
            out.write(content)
        os.replace(path + ".new", path)


def source_hash(text):
    return "'sha256-%s'" % base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def served_file(name):
    """A file of the served page, which has a service worker: what starts it is beside the page's script."""
    text = page_file(name)
    script = '<script type="module" src="page.js"></script>'
    if name != "index.html":
        return text
    if script not in text:
        sys.exit("web: index.html has no %s" % script)
    return text.replace(script, script + '\n<script type="module" src="offline.js"></script>')


def make_offline(served):
    """The service worker of the served page; its list is of all files that the page loads."""
    write(os.path.join(served, "offline.js"), page_file("offline.js"))
    files = sorted(name for name in os.listdir(served) if name.endswith((".js", ".css", ".html", ".wasm")) and name != "offline_worker.js")
    threads = [name for name in files if name == "lambent-threads.wasm"]
    contents = hashlib.sha256(b"".join(name.encode() + open(os.path.join(served, name), "rb").read() for name in files)).hexdigest()
    worker = page_file("offline_worker.js").replace("lambent-HASH", "lambent-" + contents[:16])
    lists = "const FILES = %s, THREADS = %s;" % (json.dumps(["./"] + [name for name in files if name not in threads]), json.dumps(threads))
    if "const FILES = [], THREADS = [];" not in worker:
        sys.exit("web: offline_worker.js has no lists of files")
    write(os.path.join(served, "offline_worker.js"), worker.replace("const FILES = [], THREADS = [];", lists))


# What the module uses of WebAssembly, for wasm-split.
FEATURES = ["--enable-" + name for name in ("simd", "exception-handling", "bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals")]


def split(wasm, served):
    """The served page's module in two: lambent.wasm has the functions that draw the first pictures (split.mjs), lambent-rest.wasm the others, which
    the page fetches after the first picture, or when it needs them."""
    parts = [os.path.join(served, name) for name in ("lambent.wasm", "lambent-rest.wasm")]
    newest = max(os.path.getmtime(path) for path in (wasm, os.path.abspath(__file__), os.path.join(HERE, "split.mjs")))
    if all(os.path.exists(part) and os.path.getmtime(part) > newest for part in parts):
        return
    with tempfile.TemporaryDirectory() as work:
        counting, profile = os.path.join(work, "counting.wasm"), os.path.join(work, "profile")
        call("wasm-split", *FEATURES, "--instrument", wasm, "-o", counting)
        call("node", os.path.join(HERE, "split.mjs"), counting, profile)
        call("wasm-split", *FEATURES, wasm, "--profile=" + profile, "-o1", parts[0], "-o2", parts[1])


def make_page(folder):
    """The page as files that a server serves, and as one file that works by itself, of the modules that make_modules has made."""
    modules, with_threads = (os.path.join(folder, name, "web") for name in MODULES)
    served = os.path.join(folder, "page")
    os.makedirs(served, exist_ok=True)
    names = modules_of(PAGE) + later_modules_of(PAGE) + modules_of(WORKER) + later_modules_of(WORKER) + modules_of(THREAD) + modules_of(CHECK_WORKER) + ["index.html", "page.css", "lambent.d.ts", "threads.d.ts"]
    for name in names:
        write(os.path.join(served, name), served_file(name))
    for name in set(os.listdir(served)) - set(names): # of modules that are no more
        if name.endswith(".js") and not name.startswith("offline") and name != CODEMIRROR:
            os.remove(os.path.join(served, name))
    write(os.path.join(served, "check.wasm"), open(os.path.join(modules, "check.wasm"), "rb").read())
    write(os.path.join(served, "lambent-threads.wasm"), open(os.path.join(with_threads, "lambent.wasm"), "rb").read())
    split(os.path.join(modules, "lambent.wasm"), served)
    editor = codemirror(folder)
    if editor:
        write(os.path.join(served, CODEMIRROR), editor)
    elif os.path.exists(os.path.join(served, CODEMIRROR)):
        os.remove(os.path.join(served, CODEMIRROR))
    make_offline(served)

    style = page_file("page.css")
    script = INSIDE_FIRST + plain_script(PAGE)
    page = page_file("index.html")
    policy = ("default-src 'none'; script-src %s blob: 'wasm-unsafe-eval'; worker-src blob:; style-src %s; img-src blob: data:; base-uri 'none'; "
              "form-action 'none'" % (source_hash(script), source_hash(style)))
    page = re.sub(r'(Content-Security-Policy" content=")[^"]*', lambda m: m[1] + policy, page)
    page = page.replace('<link rel="stylesheet" href="page.css">', "<style>%s</style>" % style)
    page = page.replace('<script type="module" src="page.js"></script>', "")
    texts = {"worker": plain_script(WORKER), "thread": plain_script(THREAD), "check-worker": plain_script(CHECK_WORKER)}
    for name, file in (("wasm", "lambent.wasm"), ("check-wasm", "check.wasm")):
        texts[name] = packed_text(open(os.path.join(modules, file), "rb").read())
    if editor:
        texts["codemirror"] = packed_text(editor)
    inside = "".join('<script type="text/plain" id="%s">%s</script>\n' % row for row in texts.items())
    page = page.replace("</body>", '%s<script type="module">%s</script>\n</body>' % (inside, script))
    write(os.path.join(folder, "lambent.html"), page)
    write(os.path.join(folder, "lambent-threads.wasm"), open(os.path.join(with_threads, "lambent.wasm"), "rb").read()) # for lambent view


# The folders of modules, and what they are compiled with: for one thread, and for several with a memory that they share (web/libc/threads.c).
MODULES = {"wasm": [], "threads": ["-matomics"]}


def make_modules(folder, name, args):
    """The modules of one row, by Meson."""
    place = os.path.join(folder, name)
    places = os.path.join(folder, name + ".ini")
    text = ("[constants]\nweb_folder = '%s'\nweb_root = '%s'\nthread_args = %s\nweb_threads = %s\n"
            % (HERE, os.path.join(folder, "root"), args, str(bool(args)).lower()))
    write(places, text)
    known = os.path.join(place, "meson-private", "cmd_line.txt") # of an older folder, with other files
    if not os.path.exists(known) or places not in open(known).read():
        shutil.rmtree(place, ignore_errors=True)
        call("meson", "setup", place, ROOT, "--cross-file", places, "--cross-file", os.path.join(HERE, "wasm32.ini"),
             "--buildtype=release", "-Dtests=false")
    output = call("ninja", "-C", place)
    if "warning:" in output:
        sys.exit("web: the compiler warns:\n" + output[-4000:])


def main():
    folder = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build-web"))
    if missing():
        sys.exit("web: not installed: " + " ".join(missing()))
    os.makedirs(folder, exist_ok=True)
    alone = open(os.path.join(folder, "lock"), "w") # two tests build the same folder
    fcntl.flock(alone, fcntl.LOCK_EX)
    libraries = subprocess.run([sys.executable, os.path.join(HERE, "libraries.py"), folder])
    if libraries.returncode:
        sys.exit(1)
    for name, args in MODULES.items():
        make_modules(folder, name, args)
    make_page(folder)


if __name__ == "__main__":
    main()
