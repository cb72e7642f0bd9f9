#!/usr/bin/env python3
"""npm.py PROGRAM: tests the npm package (docs/npm.md), packed and installed: in node, where the pictures equal PROGRAM's bytes, bundled by esbuild,
with TypeScript, and in Debian's chromium, on a page without a bundler and on a bundled page.

The test is skipped if a package of the group `web` or npm is missing; parts that need downloads of npm (TypeScript, playwright-core) or chromium are
skipped likewise."""
import base64
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "web"), str(ROOT / "tests"), str(ROOT / "tests/long")]
import build  # noqa: E402
import cells  # noqa: E402
import npm as package  # noqa: E402
from web import Results  # noqa: E402

OUT = ROOT / "build-web"
HERE = ROOT / "tests" / "web"
CORPUS = ROOT / "tests" / "fuzz" / "corpus"
WORDS = ["cube.stl", "--size", "96", "--view", "front", "--light-cutoff", "0", "--shadows", "--light", "point:position=1/2/3", "--light", "ambient"]


def run(*words, **more):
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)
    return done.returncode, done.stdout


def make_inputs(program, folder):
    """Models, and the program's pictures of them."""
    def drawn(*words):
        subprocess.run([program, "-q", *words, "-o", "drawn.png"], cwd=folder, check=True)
        return hashlib.sha256((folder / "drawn.png").read_bytes()).hexdigest()

    for shape in ("cube", "sphere"):
        subprocess.run([program, "-q", "shape", shape, "-o", "ball.stl" if shape == "sphere" else "cube.stl"], cwd=folder, check=True)
    refused = {"draco.gltf": CORPUS / "gltf" / "draco.gltf", "meshopt.gltf": CORPUS / "gltf" / "meshopt.gltf"}
    expected = {"cube": drawn(*WORDS), "plainCube": drawn("cube.stl", "--size", "96"), "turning": drawn("cube.stl", "--size", "96", "--turntable", "4"),
                "ball": drawn("ball.stl", "--size", "96"),
                "package": drawn(str(CORPUS / "3mf" / "bambu.3mf"), "--size", "96"),
                "draco": drawn(str(CORPUS / "gltf" / "draco.gltf"), "--size", "96"), "meshopt": drawn(str(CORPUS / "gltf" / "meshopt.gltf"), "--size", "96"),
                "refused": {name: base64.b64encode(path.read_bytes()).decode() for name, path in refused.items()}}
    shutil.copy(CORPUS / "3mf" / "bambu.3mf", folder / "package.3mf")
    (folder / "expected.json").write_text(json.dumps(expected))


def tap(results, code, text):
    """The output lines of a script in tests/web, as results of this script."""
    lines = text.splitlines()
    for i, line in enumerate(lines):
        if line.startswith(("ok ", "not ok ")):
            why = [later[2:] for later in lines[i + 1:i + 6] if later.startswith("# ")]
            results.ok(line.startswith("ok "), line.split(" ", 2 if line.startswith("not") else 1)[-1], "\n".join(why))
    results.ok(code == 0, "the script ends", "\n".join(lines[-15:]))


def esbuild(modules, *words, **more):
    found = modules and os.path.join(modules, ".bin", "esbuild")
    return run(found if found and os.path.exists(found) else "esbuild", *words, "--bundle", "--format=esm", "--target=es2022", **more)


def try_node(results, folder, modules):
    wasm = folder / "node_modules" / "lambent" / "lambent.wasm"
    for name in ("npm.mjs", "driver.mjs"):
        shutil.copy(HERE / name, folder)
    environment = {**os.environ, "LAMBENT_WASM": str(wasm)}
    tap(results, *run("node", "npm.mjs", folder, cwd=folder, env=environment))
    (folder / "small.mjs").write_text("import { open } from 'lambent'; import wasm from 'lambent/lambent.wasm';\n"
                                      "const lambent = await open(wasm); console.log(lambent.draw('cube', { size: 16 }).width);\n")
    code, text = esbuild(modules, "small.mjs", "--platform=node", "--loader:.wasm=binary", "--outfile=bundle.mjs", "--minify", cwd=folder)
    results.ok(code == 0 and "warning" not in text.lower(), "esbuild bundles it for node, the module inside", text)
    with tempfile.TemporaryDirectory() as elsewhere:
        shutil.copy(folder / "bundle.mjs", elsewhere)
        code, text = run("node", "bundle.mjs", cwd=elsewhere)
        results.ok((code, text) == (0, "16\n"), "the bundle runs without the package", text)


# Draws a model with the files beside it, and writes the picture.
DRAW = """import { open } from 'lambent';
import { readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
const [model, picture] = process.argv.slice(-2), lambent = await open(undefined, { decoders: true });
for (const name of readdirSync('.')) if (statSync(name).isFile()) lambent.files.set('/' + name, readFileSync(name));
writeFileSync(picture, lambent.draw('/' + model, { size: %d }, { as: 'png' }));
""" % cells.SIZE


def try_cells(results, program, folder, installed):
    """The cells of tests/long/table.py."""
    models = folder / "models"
    models.mkdir()
    wrong = cells.draw_all("npm", program, models, lambda model, picture: run("node", "--input-type=module", "-e", DRAW, "--", model, picture, cwd=models)[0])
    results.ok(not wrong, "each format has the program's bytes", ", ".join(wrong))
    cells.tell("npm", "installs", "yes" if installed else "no")
    code, text = run("npm", "uninstall", "--no-audit", "--no-fund", "lambent", cwd=folder)
    left = [str(path) for path in (folder / "node_modules").rglob("*") if path.is_file() and not path.name.startswith(".")]
    results.ok(code == 0 and not left, "npm removes all of it", text + "\n".join(left))
    cells.tell("npm", "removed", "yes" if code == 0 and not left else "no")


def try_types(results, folder, modules):
    tsc = modules and os.path.join(modules, "typescript", "bin", "tsc")
    if not tsc or not os.path.exists(tsc):
        results.ok(True, "types # SKIP npm cannot get TypeScript")
        return
    shutil.copy(HERE / "npm_sample.ts", folder)
    for kind in ("bundler", "nodenext"):
        module = "esnext" if kind == "bundler" else kind
        code, text = run("node", tsc, "--noEmit", "--strict", "--skipLibCheck", "false", "--target", "es2022", "--lib", "es2022,dom", "--module", module,
                         "--moduleResolution", kind, "npm_sample.ts", cwd=folder)
        results.ok(code == 0, f"tsc --noEmit ({kind})", text)


def try_pages(results, folder, modules, tools):
    chromium = shutil.which("chromium")
    if not chromium or not modules or not os.path.exists(os.path.join(modules, "playwright-core")):
        results.ok(True, "pages # SKIP chromium or playwright-core is not installed")
        return
    plain, bundled = folder / "plain", folder / "bundled"
    plain.mkdir()
    shutil.copytree(folder / "node_modules" / "lambent", plain / "lambent")
    shutil.copy(HERE / "npm_page.js", plain / "page.js")
    (plain / "index.html").write_text('<!doctype html><title></title><script type="importmap">{"imports": {"lambent": "./lambent/index.js"}}</script>'
                                      '<script type="module" src="page.js"></script>')
    shutil.copy(HERE / "npm_page.js", folder / "page.js")
    code, text = esbuild(modules, "page.js", "worker=lambent/worker", "--loader:.wasm=file", '--define:PAGE_WORKER="worker.js"', "--platform=browser", "--outdir=bundled", cwd=folder)
    results.ok(code == 0 and "warning" not in text.lower(), "esbuild bundles a page", text)
    (bundled / "index.html").write_text('<!doctype html><title></title><script type="module" src="page.js"></script>')
    vite = tools and os.path.join(tools, "vite", "bin", "vite.js")
    if vite and os.path.exists(vite):
        script = (HERE / "npm_page.js").read_text()
        (folder / "page.js").write_text(script.replace("bundled ? (await import('lambent/lambent.wasm')).default : ", "")) # the import is esbuild's
        (folder / "index.html").write_text('<!doctype html><title></title><script type="module" src="page.js"></script>')
        code, text = run("node", vite, "build", "--base=./", "--logLevel=warn", cwd=folder)
        results.ok(code == 0 and "warning" not in text.lower(), "Vite bundles a page without settings", text)
    else:
        results.ok(True, "Vite # SKIP npm cannot get Vite")
    tap(results, *run("node", HERE / "npm_page.mjs", os.path.dirname(modules), chromium, folder))


def main():
    program, results = str(pathlib.Path(sys.argv[1]).resolve()), Results()
    if build.missing() or not shutil.which("npm"):
        cells.skip("npm", "npm or a package of the group web is not installed", ["removed"])
        print("1..0 # SKIP not installed: " + " ".join(build.missing() + ["npm"] * (not shutil.which("npm"))))
        return 0
    code, text = run(sys.executable, ROOT / "web" / "build.py", OUT)
    if code and "libraries" in text:
        print("1..0 # SKIP the libraries' sources cannot be fetched")
        return 0
    results.ok(code == 0, "make web", text)
    made, packed = package.make(OUT)
    results.ok(packed.stat().st_size <= package.SIZE_MAX, "npm pack: %d kB, at most %d" % (packed.stat().st_size // 1000, package.SIZE_MAX // 1000))
    notices = (made / "LICENCES").read_text()
    results.ok(all("==== " + name in notices for name in build.SOURCES + build.TOOLS), "the notices of what the module contains")
    modules = build.packages(str(OUT))
    with tempfile.TemporaryDirectory(prefix="lambent-npm-") as name:
        folder = pathlib.Path(name)
        (folder / "package.json").write_text('{"type": "module", "private": true}')
        code, text = run("npm", "install", "--offline", "--no-audit", "--no-fund", packed, cwd=folder)
        results.ok(code == 0, "npm install of the packed file", text)
        installed = code == 0
        make_inputs(program, folder)
        try_node(results, folder, modules)
        tools = build.packages(str(OUT / "npm-tools"), str(HERE / "npm-tools"))
        try_types(results, folder, tools)
        try_pages(results, folder, modules, tools)
        try_cells(results, program, folder, installed)
    print("1..%d" % results.count)
    return results.failed > 0


if __name__ == "__main__":
    sys.exit(main())
