#!/usr/bin/env python3
"""build.py [FOLDER]: builds the modules for the web in FOLDER (build-web): first the libraries (libraries.py), then WebAssembly with Meson and clang
19. Files that are up to date are not rebuilt. `make web` calls it; packages: group `web` of packages.txt."""
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

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bundle  # noqa: E402
import libraries  # noqa: E402
import module_parts  # noqa: E402
from bundle import correct_programs  # noqa: E402, F401
from module_parts import call  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
NEEDS = {"clang-19": "clang-19", "wasm-ld-19": "lld-19", "/usr/lib/llvm-19/bin/llvm-ar": "llvm-19", "dpkg-source": "dpkg-dev", "node": "nodejs",
         "wasm-split": "binaryen", "esbuild": "esbuild", "/usr/include/wasm32-wasi/stdio.h": "wasi-libc", "/usr/lib/llvm-19/include/wasm32-wasi/c++/v1/__config": "libc++-19-dev-wasm32",
         "/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a": "libclang-rt-19-dev-wasm32"}


def missing():
    """Returns the packages of the group `web` that are not installed."""
    return [package for need, package in NEEDS.items() if not (os.path.exists(need) if "/" in need else shutil.which(need))]


def packed_text(content):
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def with_files(page, files):
    """Adds files, {path: bytes}, to the one-file page, so that links can refer to them."""
    texts = "".join('<script type="text/plain" class="inside-file" data-path="%s" data-packed="gzip">%s</script>\n' % (html.escape(path), packed_text(content))
                    for path, content in sorted(files.items()))
    return page.replace('<script type="text/plain" id="worker">', texts + '<script type="text/plain" id="worker">', 1)


def packages(folder, source=HERE):
    """Installs the packages of SOURCE/package-lock.json in FOLDER/npm, unless they are installed. Returns the folder of the modules; None: npm is missing
    or cannot fetch them."""
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


def source_hash(text):
    return "'sha256-%s'" % base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def page_file(name):
    return open(os.path.join(HERE, "page", name)).read()


SCRIPT = '<script type="module" src="page.js"></script>'


def served_index(bundles):
    """The page for a server. It requests all files of its start at once."""
    text = page_file("index.html")
    if SCRIPT not in text:
        sys.exit("web: index.html has no %s" % SCRIPT)
    ahead = ['<link rel="modulepreload" href="%s">' % name for name in bundles.first if name != bundle.PAGE]
    ahead.append('<link rel="preload" href="lambent.wasm" as="fetch" type="application/wasm" crossorigin>')
    return text.replace(SCRIPT, "\n".join(ahead + [SCRIPT]))


def integrity(path):
    return "sha256-" + base64.b64encode(hashlib.sha256(open(path, "rb").read()).digest()).decode()


def make_offline(served, bundles):
    """The service worker of the served page, with a list of its files and their hashes. Files of the tab of shaders are stored on first use."""
    names = sorted(name for name in os.listdir(served) if name.endswith((".js", ".css", ".html", ".wasm", ".webp")) and name != OFFLINE)
    files = {"./" if name == "index.html" else name: integrity(os.path.join(served, name)) for name in names}
    shaders = bundles.shaders + ["check.wasm", bundle.CODEMIRROR]
    kinds = {"FILES": files, "LATER": [name for name in names if name in shaders + [DECODERS, ALONE]], "PLAIN": [*module_parts.PARTS[1:]], "THREADS": [*module_parts.THREADS_PARTS]}
    cache = hashlib.sha256(json.dumps(files, sort_keys=True).encode()).hexdigest()[:16]
    text = page_file("worker/" + OFFLINE).replace("lambent-HASH", "lambent-" + cache)
    for name, value in kinds.items():
        text, count = re.subn(r"^const %s = .*;$" % name, lambda m: "const %s = %s;" % (name, json.dumps(value)), text, flags=re.M)  # noqa: B023
        if count != 1:
            sys.exit("web: offline_worker.js has no list %s" % name)
    bundle.write(os.path.join(served, OFFLINE), text)


# Debian's source packages whose code is in the modules, and tool packages that add code.
SOURCES = [*(row["source"] for row in libraries.LIBRARIES), "draco", "meshoptimizer"]
TOOLS = ["wasi-libc", "libclang-rt-19-dev-wasm32", "libc++-19-dev-wasm32"]
OFFLINE, DECODERS = "offline_worker.js", "lambent-decoders.wasm"
CHECK = "wasm/classroom/web/check.wasm" # built by classroom/web/meson.build
POSTER = "start.webp" # shown until the first picture is drawn (docs/web.md)
ALONE = "alone.html" # lambent.html next to the served page, from which pages with a model are made
PACKED = (".js", ".css", ".html", ".wasm")
PACKER = """
const { readFileSync, statSync, utimesSync, writeFileSync, existsSync } = require('fs'), { brotliCompressSync, gzipSync, constants } = require('zlib');
for (const path of process.argv.slice(1)) {
  const made = statSync(path);
  for (const [ending, pack] of [['.gz', (bytes) => gzipSync(bytes, { level: 9 })],
    ['.br', (bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } })]]) {
    if (existsSync(path + ending) && statSync(path + ending).mtimeMs === made.mtimeMs) continue;
    writeFileSync(path + ending, pack(readFileSync(path)));
    utimesSync(path + ending, made.atime, made.mtime);
  }
}
"""


def pack(served):
    """Compresses each file of the served page with gzip and with brotli, for servers that send such files."""
    call("node", "-e", PACKER, *sorted(os.path.join(served, name) for name in os.listdir(served) if name.endswith(PACKED)))


def make_page(folder):
    """Writes the page as files for a server, and as a single file, from the modules that make_modules has built."""
    modules, with_threads = (os.path.join(folder, name, "web") for name in MODULES)
    served = os.path.join(folder, "page")
    os.makedirs(served, exist_ok=True)
    bundles = bundle.Bundles(folder)
    files = {**bundles.files, "index.html": served_index(bundles), "page.css": page_file("page.css")}
    for name in ("lambent.d.ts", "threads.d.ts"):
        files[name] = open(os.path.join(HERE, name)).read()
    files[POSTER] = open(os.path.join(bundle.ROOT, "docs", "pictures", POSTER), "rb").read()
    files[DECODERS] = open(os.path.join(folder, "decoders.wasm"), "rb").read()
    files["LICENCES"] = libraries.notices("The page of Lambent", folder, SOURCES, TOOLS)
    bundle.write(os.path.join(folder, "LICENCES"), files["LICENCES"])
    files["check.wasm"] = open(os.path.join(folder, CHECK), "rb").read()
    editor = bundle.codemirror(folder, packages(folder))
    if editor:
        files[bundle.CODEMIRROR] = editor
    for name, content in files.items():
        bundle.write(os.path.join(served, name), content)
    module_parts.split(os.path.join(modules, "lambent-unsplit"), [os.path.join(served, name) for name in module_parts.PARTS])
    module_parts.split_threads(os.path.join(with_threads, "lambent-unsplit"), [os.path.join(served, name) for name in module_parts.THREADS_PARTS])
    make_one_file(folder, bundles, editor)
    bundle.write(os.path.join(served, ALONE), open(os.path.join(folder, "lambent.html")).read())
    kept = {*files, *module_parts.PARTS, *module_parts.THREADS_PARTS, OFFLINE, ALONE}
    for name in os.listdir(served): # of older scripts
        if re.sub(r"\.(gz|br)$", "", name) not in kept:
            os.remove(os.path.join(served, name))
    make_offline(served, bundles)
    pack(served)
    shaders = [name for name in bundles.shaders if name != bundle.CHECK_WORKER]
    kinds = {"first": bundles.first + bundles.worker, "later": [name for name in bundles.later if name not in bundles.shaders],
             "editor": shaders + [bundle.CODEMIRROR] * bool(editor)}
    bundle.write(os.path.join(folder, "scripts.json"), json.dumps(kinds)) # for sizes.py
    bundle.write(os.path.join(folder, "lambent-threads.wasm"), open(os.path.join(with_threads, "lambent.wasm"), "rb").read()) # for lambent view, undivided


def make_one_file(folder, bundles, editor):
    style, script, page = page_file("page.css"), bundles.inside[bundle.PAGE], page_file("index.html")
    policy = ("default-src 'none'; script-src %s blob: 'wasm-unsafe-eval'; worker-src blob:; style-src %s; img-src blob: data:; base-uri 'none'; "
              "form-action 'none'" % (source_hash(script), source_hash(style)))
    page = re.sub(r'(Content-Security-Policy" content=")[^"]*', lambda m: m[1] + policy, page)
    page = page.replace('<link rel="stylesheet" href="page.css">', "<style>%s</style>" % style)
    page = page.replace(SCRIPT, "")
    texts = {name[:-3].replace("_", "-"): bundles.inside[name] for name in (bundle.WORKER, bundle.THREAD, bundle.CHECK_WORKER)}
    for name, file in (("wasm", "wasm/web/lambent.wasm"), ("check-wasm", CHECK)):
        texts[name] = packed_text(open(os.path.join(folder, file), "rb").read())
    texts["decoders"] = packed_text(open(os.path.join(folder, "decoders.wasm"), "rb").read())
    if editor:
        texts["codemirror"] = packed_text(editor)
    inside = "".join('<script type="text/plain" id="%s">%s</script>\n' % row for row in texts.items())
    notices = open(os.path.join(folder, "LICENCES")).read()
    if "--" + ">" in notices:
        sys.exit("web: the notices of licences would end the comment that contains them")
    page = page.replace("</body>", '%s<script type="module">%s</script>\n<!--\n%s\n-->\n</body>' % (inside, script, notices))
    bundle.write(os.path.join(folder, "lambent.html"), page)


# The folders of modules and their compiler options: one thread, and several threads with shared memory (web/libc/threads.c).
MODULES = {"wasm": [], "threads": ["-matomics"]}


def make_modules(folder, name, args):
    """Builds the modules of one row by Meson."""
    place = os.path.join(folder, name)
    places = os.path.join(folder, name + ".ini")
    text = ("[constants]\nweb_folder = '%s'\nweb_root = '%s'\nthread_args = %s\nweb_threads = %s\n"
            % (HERE, os.path.join(folder, "root"), args, str(bool(args)).lower()))
    bundle.write(places, text)
    known = os.path.join(place, "meson-private", "cmd_line.txt") # from an older build, with other files
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
    alone = open(os.path.join(folder, "lock"), "w") # two tests may build the same folder
    fcntl.flock(alone, fcntl.LOCK_EX)
    for script in ("libraries.py", "decoders.py"):
        if subprocess.run([sys.executable, os.path.join(HERE, script), folder]).returncode:
            sys.exit(1)
    for name, args in MODULES.items():
        make_modules(folder, name, args)
    make_page(folder)


if __name__ == "__main__":
    main()
