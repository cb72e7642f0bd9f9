"""bundle.py: bundles the page's scripts with esbuild (Debian's package). The served page has a script for its start, and
others that it fetches on first use. The page in one file contains all of them."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)

PAGE = "page.js"
WORKER, THREAD, CHECK_WORKER = "worker.js", "thread.js", "check_worker.js" # each runs in a thread of its own
SOURCES = {PAGE: "web/page/page.js", WORKER: "web/page/worker/worker.js", THREAD: "web/thread.js", CHECK_WORKER: "classroom/web/check_worker.js"}
# The folders of page/ in their order: a file imports only from its own folder and from folders before it (tests/structure.py). "." is page/ itself.
FOLDERS = ["base", "words", "worker", "shared", "controls", "picture", "files", "explain", "lights", "tabs", "shaders", "."]
CODEMIRROR = "codemirror.js" # made from npm packages
COMMON = ["--bundle", "--minify", "--charset=utf8", "--legal-comments=none", "--target=es2022", "--log-level=warning", "--external:node:worker_threads"]


def write(path, content):
    """Writes a file, unless it already has this content, because another test may be reading it."""
    content = content.encode() if isinstance(content, str) else content
    if not os.path.exists(path) or open(path, "rb").read() != content:
        with open(path + ".new", "wb") as out:
            out.write(content)
        os.replace(path + ".new", path)


def correct_programs():
    """The correct programs of the contracts (classroom/tests/check) that WebGL 2 can draw. GLSL ES 3.00 has no blocks of varyings."""
    return sorted(name[:-5] for name in os.listdir(os.path.join(ROOT, "classroom", "tests", "check")) if name.endswith(".vert") and name != "pittsburgh-blocks.vert")


def programs():
    """The script with the correct programs that the page offers."""
    contracts = [name[:-5] for name in os.listdir(os.path.join(ROOT, "classroom", "check", "contracts"))]
    rows = []
    for name in correct_programs():
        mine = max((contract for contract in contracts if name == contract or name.startswith(contract + "-")), key=len)
        texts = {part: open(os.path.join(ROOT, "classroom", "tests", "check", name + ending)).read() for part, ending in (("vertex", ".vert"), ("fragment", ".frag"))}
        rows.append({"name": name, "contract": mine, **texts})
    return "export const PROGRAMS = %s;\n" % json.dumps(rows)


def esbuild(*words, cwd=None, env=None):
    done = subprocess.run(["esbuild", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=cwd, env=env)
    if done.returncode or done.stderr:
        sys.exit("web: esbuild fails:\n" + done.stderr.decode()[-3000:])
    return done.stdout.decode()


def codemirror(folder, modules):
    """The text editor of shaders as one script with its licences, from the npm packages in MODULES. None: there are none, and the page uses a plain
    text field."""
    if not modules:
        print("web: npm cannot install CodeMirror: shaders are edited in a plain field", flush=True)
        return None
    facts, made = os.path.join(folder, "npm", "codemirror.json"), os.path.join(folder, "npm", CODEMIRROR)
    esbuild(os.path.join(ROOT, "classroom", "web", "codemirror.src.js"), *COMMON, "--format=esm", "--metafile=" + facts, "--outfile=" + made,
            env={**os.environ, "NODE_PATH": modules})
    used = sorted({re.search(r"node_modules/((?:@[^/]+/)?[^/]+)/", name)[1] for name in json.load(open(facts))["inputs"] if "node_modules/" in name})
    licences = {}
    for name in used:
        licences.setdefault(open(os.path.join(modules, name, "LICENSE")).read().strip(), []).append(name)
    notice = "\n\n".join("%s\n\n%s" % (", ".join(names), text) for text, names in licences.items())
    return b"/*\n" + notice.encode() + b"\n*/\n" + open(made, "rb").read()


def gather(folder):
    """Copies all scripts to FOLDER/scripts, in the same folders, and adds the correct programs, so that their imports work."""
    place = os.path.join(folder, "scripts")
    names = [name for pattern in ("web/*.js", "classroom/web/*.js", "web/page/**/*.js") for name in glob.glob(pattern, root_dir=ROOT, recursive=True)]
    texts = {name: open(os.path.join(ROOT, name)).read() for name in names}
    texts["web/page/shaders/programs.js"] = programs()
    for name, text in texts.items():
        path = os.path.join(place, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        write(path, text)
    for name in set(glob.glob("**/*.js", root_dir=place, recursive=True)) - set(texts):
        os.remove(os.path.join(place, name))
    return place


class Bundles:
    """`first`: the files that the start of the served page loads; `later`: the files that it fetches on first use; `shaders`: the files among `later` for
    the tab of shaders. `inside`: the scripts of the single-file page, by name."""

    def __init__(self, folder):
        folder = os.path.abspath(folder)
        place, made = gather(folder), os.path.join(folder, "bundles")
        shutil.rmtree(made, ignore_errors=True)
        facts = os.path.join(folder, "bundles.json")
        esbuild(SOURCES[PAGE], SOURCES[WORKER], *COMMON, "--splitting", "--format=esm", "--define:ONE_FILE=false", "--entry-names=[name]", "--chunk-names=[name]-[hash]", "--outdir=" + made,
                "--metafile=" + facts, "--external:*/" + CODEMIRROR, cwd=place)
        outputs = {os.path.basename(path): facts for path, facts in json.load(open(facts))["outputs"].items()}
        self.first = self._with_imports(outputs, [PAGE])
        self.worker = self._with_imports(outputs, [WORKER])
        shaders = [name for name, facts in outputs.items() if facts.get("entryPoint") == "web/page/shaders/shaders.js"]
        self.later = [name for name in outputs if name not in self.first + self.worker]
        self.shaders = shaders + [CHECK_WORKER]
        for name in (THREAD, CHECK_WORKER):
            esbuild(SOURCES[name], *COMMON, "--format=esm", "--define:ONE_FILE=false", "--outfile=" + os.path.join(made, name), cwd=place)
        self.later.append(THREAD)
        self.files = {name: open(os.path.join(made, name)).read() for name in os.listdir(made)}
        self.inside = {name: esbuild(SOURCES[name], *COMMON, "--format=" + ("esm" if name == PAGE else "iife"), "--define:ONE_FILE=true", "--external:*/" + CODEMIRROR, cwd=place)
                       for name in (PAGE, WORKER, THREAD, CHECK_WORKER)}

    @staticmethod
    def _with_imports(outputs, names):
        """The outputs, with everything that they import statically."""
        found = list(names)
        for name in found: # which grows
            for other in outputs[name]["imports"]:
                base = os.path.basename(other["path"])
                if other["kind"] == "import-statement" and base not in found:
                    found.append(base)
        return found
