#!/usr/bin/env python3
"""scripts.py PROGRAM: checks the lines that machines read. Every executable begins with `#!`, its interpreter parses it, and so does the interpreter
of every other script. Every YAML file is parsed. Every file in examples/ is run here, or by the test that EXAMPLES names.

Output is TAP."""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The tool that each kind of example is for. A text names the test that runs the example.
EXAMPLES = {
    ".c": "meson.build compiles the C examples; tests/headers.py and examples/render.c's users run them",
    ".ipynb": "tests/python/test_models.py runs the cells",
    ".py": "tests/cli/test_worker.py runs the workers",
    ".mjs": "tests/cli/test_worker.py runs the workers",
}
PARSERS = {"sh": ["sh", "-n"], "bash": ["bash", "-n"], "node": ["node", "--check"],
           "python3": [sys.executable, "-c", "import sys; compile(open(sys.argv[1], encoding='utf-8').read(), sys.argv[1], 'exec')"],
           "make": ["make", "--dry-run", "--question", "-f"]}
ENDINGS = {".sh": "sh", ".py": "python3", ".js": "node", ".mjs": "node"}
done = {"number": 0, "failed": 0}


def report(name, problems, skip=""):
    done["number"] += 1
    done["failed"] += bool(problems)
    print("%s %d - %s%s" % ("not ok" if problems else "ok", done["number"], name, " # SKIP " + skip if skip else ""))
    print("".join("# %s\n" % line for line in problems[:40]), end="")


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, errors="replace", cwd=ROOT, **more)


def tracked():
    """The tracked files, with a flag for executables. A source archive has no .git: then its files, with the flags of the file system."""
    listed = run(["git", "ls-files", "-s", "-z"])
    if listed.returncode == 0 and listed.stdout:
        rows = [row.split("\t") for row in listed.stdout.split("\0") if row]
        return [(ROOT / name, row.startswith("100755")) for row, name in rows if (ROOT / name).is_file()]
    return [(path, os.access(path, os.X_OK)) for path in sorted(ROOT.rglob("*")) if path.is_file() and not path.relative_to(ROOT).parts[0].startswith("build")]


def interpreter(path):
    """The name of the interpreter on the first line, or None."""
    with open(path, "rb") as file:
        first = file.readline().decode("utf-8", "replace").split()
    if not first or not first[0].startswith("#!"):
        return None
    return os.path.basename(first[1] if first[0] == "#!/usr/bin/env" and len(first) > 1 else first[0][2:] or first[1])


def check_scripts(files):
    without = [str(path.relative_to(ROOT)) for path, executable in files if (executable or path.suffix == ".sh") and not interpreter(path)]
    report("every executable and every .sh file begins with #!", without)
    kinds = {}
    for path, _ in files:
        kind = interpreter(path) or ENDINGS.get(path.suffix)
        if kind:
            kinds.setdefault(kind, []).append(path)
    for kind, paths in sorted(kinds.items()):
        if kind == "node" and run(["sh", "-c", "command -v node"]).returncode:
            report("node parses its scripts", [], "node is not installed")
            continue
        problems = ["no parser for %s is listed in %s: %s" % (kind, os.path.basename(__file__), paths[0])] if kind not in PARSERS else []
        for path in paths if not problems else []:
            parsed = run(PARSERS[kind] + [str(path)])
            if parsed.returncode and not (kind == "make" and parsed.returncode == 1): # 1: something would be made
                problems.append("%s: %s" % (path.relative_to(ROOT), parsed.stdout.strip()))
        report("%s parses its scripts: %d" % (kind, len(paths)), problems)
    makefile = run(["make", "--dry-run", "all", "test", "test-more", "test-long", "release"])
    report("make parses the Makefile", [makefile.stdout] if makefile.returncode else [])


def check_yaml(files):
    code = "import sys, yaml\nfor name in sys.argv[1:]: list(yaml.safe_load_all(open(name, encoding='utf-8')))"
    names = [str(path) for path, _ in files if path.suffix in (".yaml", ".yml")]
    parsed = run(["/usr/bin/python3", "-c", code, *names])
    report("every YAML file is parsed: %d" % len(names), [parsed.stdout] if parsed.returncode or not names else [])


def check_examples(files, program):
    """Draws the scenes, and compares what Slurm reads from the job script with the number of shards."""
    unknown = []
    for path in (path for path, _ in files if path.parent == ROOT / "examples"):
        if path.suffix == ".json":
            with tempfile.TemporaryDirectory() as folder:
                drawn = run([program, str(path), "-s", "16", "--samples", "1", "-o", os.path.join(folder, "p.png")])
            report("examples/%s is drawn" % path.name, [drawn.stdout] if drawn.returncode else [])
        elif path.suffix == ".sh":
            head = path.read_text().split("\nset ")[0].splitlines() # Slurm reads the lines before the first command
            options = dict(line[len("#SBATCH "):].partition("=")[::2] for line in head if line.startswith("#SBATCH "))
            shards = "shards=${SHARDS:-%d}" % (int(options.get("--array", "0-0").split("-")[1]) + 1)
            missing = {"--job-name", "--array", "--cpus-per-task", "--mem", "--time", "--requeue", "--open-mode"}.difference(options)
            report("examples/%s: Slurm's options are before the first command" % path.name,
                   ["no #SBATCH line with " + name for name in sorted(missing)] + ["expected " + shards] * (shards not in path.read_text()))
        elif path.suffix == ".yaml":
            pass # parsed above
        elif path.suffix not in EXAMPLES:
            unknown.append("no check is listed for " + path.name)
    report("each kind of example has a check", unknown)


def main():
    files = tracked()
    check_scripts(files)
    check_yaml(files)
    check_examples(files, os.path.abspath(sys.argv[1]))
    print("1..%d" % done["number"])
    return 1 if done["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
