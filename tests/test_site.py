#!/usr/bin/env python3
"""test_site.py PROGRAM: tests `make site`: every link has a target, every figure of docs/lighting has its links to the Lab, and the module of the
page draws the pictures of these links. The test is skipped if a package of the group `web` is missing."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from urllib.parse import unquote

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "build-web")
sys.path[:0] = [os.path.join(ROOT, name) for name in ("web", "tests", "tests/long", "scripts")]
import build  # noqa: E402
import cells  # noqa: E402
import make_site  # noqa: E402
from web import Results  # noqa: E402

# Figures of docs/lighting that are not pictures of one model by `lambent`: diagrams (lambent plot, scripts/tone_plot.py), all materials on
# one sheet, an explained pixel, and pictures drawn by docs/tools with a deliberate mistake.
NO_LAB = r"beam\.png|lambert\.png|fresnel\.png|depth\.png|lobe\.png|highlight\.png|attenuation\.png|spot\.png|tone\.svg|tone-colors\.svg|materials\.png|explained\.png|mistake-.*"


def links_of(folder):
    """The pages below FOLDER, the options in their links to the Lab, and the links whose target or anchor is missing."""
    texts, words = {}, {}
    for where, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html") and name != "lab.html":
                path = os.path.join(where, name)
                texts[path] = open(path, encoding="utf-8").read()
    missing = []
    for path, text in texts.items():
        for link in re.findall(r'(?:href|src)="([^"]*)"', text):
            link = html.unescape(link)
            if re.match(r"[a-z]+:", link):
                continue
            file, _, anchor = link.partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            if os.path.basename(target) == "lab.html":
                if anchor:
                    words.setdefault(os.path.relpath(path, folder), []).append([unquote(word) for word in anchor.split("&")])
                continue
            if not os.path.isfile(target) or (anchor and target in texts and 'id="%s"' % unquote(anchor) not in texts[target]):
                missing.append("%s: %s" % (os.path.relpath(path, folder), link))
    return texts, words, missing


def check_links(results, folder):
    """Every href and src exists, including anchors. Returns the pages, and the options in the links to the Lab."""
    texts, words, missing = links_of(folder)
    results.ok(len(texts) > 40 and not missing, "every link of %d pages has its target" % len(texts), "\n".join(missing))
    return texts, words


def check_figures(results, folder, texts):
    count, without = 0, []
    for path, text in texts.items():
        if not os.path.relpath(path, folder).startswith(("docs/lighting/", "docs/lighting.html")):
            continue
        for figure in re.findall(r"<figure>.*?</figure>", text, re.S):
            picture = os.path.basename(re.search(r'src="([^"]*)"', figure)[1])
            count += 1
            if not re.fullmatch(NO_LAB, picture) and "lab.html#" not in figure:
                without.append("%s: %s" % (os.path.relpath(path, folder), picture))
    results.ok(count > 35 and not without, "every figure of docs/lighting (%d) opens in the Lab" % count, "\n".join(without))


def check_lab(results, folder, words):
    """The module draws a small picture for each link."""
    tasks = [(page, w) for page, all_words in sorted(words.items()) for w in all_words]
    small = [[w[0]] + [word for word in w[1:] if not word.startswith(("--size", "--samples", "--shadow-samples"))] + ["--size=24", "--samples=1", "--shadow-samples=1"] for _, w in tasks]
    with tempfile.TemporaryDirectory() as models:
        shutil.copytree(os.path.join(ROOT, "examples"), os.path.join(models, "examples"))
        done = subprocess.run(["node", os.path.join(ROOT, "tests/web/pictures.mjs"), os.path.join(OUT, "wasm", "web", "lambent.wasm"), models],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, input="".join(json.dumps({"words": w, "ending": "png"}) + "\n" for w in small))
    lines = done.stdout.splitlines()
    bad = ["%s: %s: %s" % (page, " ".join(w), line) for (page, w), line in zip(tasks, lines) if not re.fullmatch("[0-9a-f]{64}", line)]
    results.ok(len(lines) == len(tasks) > 80 and not bad, "the Lab draws what its %d links say" % len(tasks), "\n".join(bad) or done.stderr)
    lab = open(os.path.join(folder, "lab.html"), encoding="utf-8").read()
    included = re.findall(r'class="inside-file" data-path="([^"]*)"', lab)
    files = {w[0] for _, w in tasks if w[0].startswith("/")}
    results.ok(files and files <= set(included), "the Lab has the models of its links", str(files - set(included)))


def main():
    results = Results()
    program = os.path.abspath(sys.argv[1])
    missing = build.missing() + ([] if shutil.which("cmark-gfm") else ["cmark-gfm"])
    if missing:
        for column in ("installs", "page"):
            cells.tell("site", column, "not run: %s is not installed" % missing[0])
        print("ok 1 - site # SKIP not installed: %s\n1..1" % " ".join(missing))
        return 0
    done = subprocess.run([sys.executable, os.path.join(ROOT, "web", "build.py"), OUT], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode and "apt-get" in done.stdout:
        print("ok 1 - site # SKIP Debian's sources cannot be fetched\n1..1")
        return 0
    results.ok(done.returncode == 0, "build-web is built", done.stdout)
    with tempfile.TemporaryDirectory() as folder:
        make_site.make(program, folder, os.path.join(OUT, "lambent.html"))
        texts, words = check_links(results, folder)
        check_figures(results, folder, texts)
        cells.tell("site", "installs", "no" if results.failed else "yes")
        check_lab(results, folder, words)
        cells.tell("site", "page", "no" if results.failed else "yes")
    print("1..%d" % results.count)
    return 1 if results.failed else 0


if __name__ == "__main__":
    sys.exit(main())
