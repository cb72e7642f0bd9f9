#!/usr/bin/env python3
"""page.py PROGRAM: tests the page of `make web` as one file with a model of each format, in Debian's chromium. Its pixels must equal the program's. It prints
the page's cells of tests/long/table.py. The test is skipped without chromium or playwright-core."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name) for name in ("tests", "tests/long", "web")]
import browser  # noqa: E402
import build  # noqa: E402
import cells  # noqa: E402
from web import Results  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def main():
    results, modules = Results(), build.packages(str(ROOT / "build-web"))
    chromium, node = shutil.which("chromium"), ["node", str(ROOT / "tests/web/formats.mjs"), os.path.dirname(modules or "")]
    if not chromium or not modules:
        cells.skip("page", "chromium or playwright-core is not installed", ["page"])
        print("1..0 # SKIP chromium or playwright-core is not installed")
        return 0
    with tempfile.TemporaryDirectory(prefix="lambent-page-") as name:
        folder = pathlib.Path(name)
        cells.fill(PROGRAM, folder)
        models = {column: pathlib.Path(paths[0]).name for column, paths in cells.MODELS.items()}
        for model in models.values():
            subprocess.run([PROGRAM, model, "-q", "-s", str(cells.SIZE), "-b", "white", "-o", model + ".html"], cwd=folder, check=True, env={**os.environ, "LAMBENT_PAGE": str(ROOT / "build-web/lambent.html")})
        done = subprocess.run([*node, chromium, name, *(model + ".html" for model in models.values())], stdout=subprocess.PIPE, text=True)
        for column, line in zip(models, done.stdout.splitlines()):
            said, before = json.loads(line), results.failed
            if said["command"]:
                browser.check_picture(results, PROGRAM, name, "pixels", said)
            results.ok(said["command"] and not said["reports"], "%s: no errors" % said["name"], "\n".join(said["reports"]))
            cells.tell("page", column, "no" if results.failed > before else "yes")
        for column in ("installs", "page"):
            cells.tell("page", column, "no" if results.failed or done.returncode else "yes")
    print("1..%d" % results.count)
    return results.failed > 0 or done.returncode


if __name__ == "__main__":
    sys.exit(main())
