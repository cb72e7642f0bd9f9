#!/usr/bin/env python3
"""npm.py [FOLDER]: writes the npm package (docs/npm.md) to FOLDER/npm-package, and packs it as FOLDER/lambent-VERSION.tgz (make npm). FOLDER
(build-web) contains the output of `make web`. The types of the options come from the program's own table, printed by the module."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
SIZE_MAX = 940_000  # bytes of the packed file

SCRIPTS = ["npm/index.js", "npm/drawing.js", "npm/index.d.ts", "npm/files.js", "npm/words.js", "npm/client.js", "npm/worker.js", "npm/README.md", "lambent.js", "decoders.js", "wasi.js"]
# Options that the package does not support: its own calls replace them, or they need files of the machine.
WITHOUT = ["output", "term", "durable", "save-scene", "stage"]


def key_of(name):
    return re.sub(r"-(\w)", lambda match: match[1].upper(), name)


def type_of(option):
    """The type of an option's value. Numeric values are accepted as numbers too."""
    if option["value"] is None:
        return "boolean"
    if option.get("words"):
        names = [word["name"] for word in option["words"]]
        numbers = [name for name in names if re.fullmatch(r"\d+", name)]
        return " | ".join([json.dumps(name) for name in names] + numbers + ["(string & {})"])
    one = "number | `${number}`" if option["number"] else "string | number"
    return "%s | (%s)[]" % (one, one) if option["repeats"] else one


def options_types(described):
    rows = []
    for option in described["options"]:
        if option["name"] in WITHOUT:
            continue
        default = "" if option["default"] is None else " Default: %s." % option["default"]
        summary = (option["summary"] + default).replace("*/", "* /")
        rows.append("  /** %s */\n  %s?: %s;" % (summary, key_of(option["name"]), type_of(option)))
    return ("// options.d.ts: made by web/npm.py from the program's table of options (version %s).\n\n"
            "/** The options of a picture, as on the command line: `lightCutoff: 0` is `--light-cutoff 0`, `true` an option without a value. */\n"
            "export interface DrawOptions {\n%s\n}\n" % (described["version"], "\n".join(rows)))


def package_json(version):
    return {
        "name": "lambent", "version": version, "description": "Pictures of 3D models, lit on the CPU: the same bytes on every machine", "license": "MIT", "type": "module",
        "main": "./index.js", "types": "./index.d.ts", "sideEffects": False, "engines": {"node": ">=18"},
        "exports": {".": {"types": "./index.d.ts", "default": "./index.js"}, "./worker": "./worker.js", "./lambent.wasm": "./lambent.wasm", "./decoders.wasm": "./decoders.wasm", "./package.json": "./package.json"},
        "keywords": ["3d", "render", "thumbnail", "gltf", "glb", "stl", "obj", "ply", "wasm"],
    }


def described(wasm):
    """The module's list of its options."""
    script = ("import { open } from %s; import { readFileSync } from 'node:fs';"
              "console.log(JSON.stringify((await open(readFileSync(%s))).options()));" % (json.dumps(str(HERE / "lambent.js")), json.dumps(str(wasm))))
    return json.loads(subprocess.run(["node", "--input-type=module", "-e", script], stdout=subprocess.PIPE, check=True).stdout)


def make(folder):
    """The package's folder and the packed file."""
    package = folder / "npm-package"
    shutil.rmtree(package, ignore_errors=True)
    package.mkdir(parents=True)
    wasm = folder / "wasm" / "web" / "lambent.wasm"
    for name in SCRIPTS:
        shutil.copy(HERE / name, package)
    shutil.copyfile(wasm, package / "lambent.wasm")
    shutil.copyfile(folder / "decoders.wasm", package / "decoders.wasm")
    options = described(wasm)
    (package / "options.d.ts").write_text(options_types(options))
    (package / "package.json").write_text(json.dumps(package_json(options["version"]), indent=2) + "\n")
    shutil.copy(folder / "LICENCES", package)
    shutil.copy(ROOT / "LICENSE", package)
    for path in package.iterdir():
        path.chmod(0o644)
    done = subprocess.run(["npm", "pack", "--silent", "--pack-destination", str(folder)], cwd=package, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit("npm: npm pack failed:\n" + done.stderr)
    packed = folder / done.stdout.strip().splitlines()[-1]
    if packed.stat().st_size > SIZE_MAX:
        sys.exit("npm: %s has %d bytes, expected at most %d" % (packed, packed.stat().st_size, SIZE_MAX))
    return package, packed


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build-web").resolve()
    if not (folder / "wasm" / "web" / "lambent.wasm").exists():
        sys.exit("npm: %s has no module; make web builds it" % os.path.relpath(folder))
    if not shutil.which("npm"):
        sys.exit("npm: npm is not installed")
    _, packed = make(folder)
    print("%s: %d kB" % (packed, packed.stat().st_size // 1000))


if __name__ == "__main__":
    main()
