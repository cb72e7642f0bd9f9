#!/usr/bin/env python3
"""make_site.py LAMBENT [FOLDER]: converts README and docs/ to HTML pages in build-site, which a browser reads from a folder or a server, without
scripts and without a network. Pictures drawn by a `lambent` command have links to the Lab (lab.html: the page of `make web` in one file, with the
example models), one for each picture of a sheet; `lambent compare --json` lists the options of each picture. Markdown is converted by cmark-gfm
(packages.txt, group web)."""
import concurrent.futures
import html
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from urllib.parse import quote

import reference
from docs import ROOT, pages

sys.path.insert(0, os.path.join(ROOT, "web"))
import build  # noqa: E402

# Commands whose figures are not pictures of a model: diagrams, and sheets of several models.
NO_PICTURE = ("plot", "materials", "check")
# Short names of options in the commands of the pages.
SHORT = {"-s": "--size", "-b": "--background", "-o": "--output", "-r": "--reflection"}
NAVIGATION = [("README.md", "Lambent"), ("docs/lighting.md", "Lighting"), ("docs/command-line.md", "Command line"), ("docs/shaders.md", "Shaders"),
              ("docs/check.md", "Check"), ("docs/formats.md", "Formats"), ("docs/architecture.md", "Architecture"), ("docs/reference.md", "C interface")]


def target_of(path):
    """Returns the place of a project file in the site."""
    if path == "README.md":
        return "index.html"
    if path.endswith(".md"):
        return path[:-3] + ".html"
    return path if re.search(r"\.(png|svg|jpg|webp|gif)$", path) else path + ".html"


def relative(target, page):
    return os.path.relpath(target, os.path.dirname(page) or ".")


# --- commands and the Lab

def option_words(words):
    """Splits a command line of a page into words: --name=value, --name. A word that begins with a dash and a letter is an option."""
    found, i = [], 0
    while i < len(words):
        word = SHORT.get(words[i], words[i])
        is_option = re.match(r"--?[a-z]", word)
        if not is_option:
            raise ValueError("%s: expected an option" % word)
        if "=" in word or i + 1 == len(words) or re.match(r"--?[a-z]", words[i + 1]):
            found.append(word)
            i += 1
        else:
            found.append("%s=%s" % (word, words[i + 1]))
            i += 2
    return found


def larger(words):
    """The size of a figure's picture, doubled, because a figure is small and the Lab has room."""
    return [re.sub(r"\d+", lambda m: str(2 * int(m[0])), word) if word.startswith("--size=") else word for word in words]


def without(words, names):
    return [word for word in words if word.split("=")[0] not in names]


def model_of(word):
    return "/" + word if "/" in word or "." in word else word


def pictures_of(program, command):
    """Returns [caption, options for the Lab] for each picture that a figure's command draws. A diagram has no such pictures."""
    words = shlex.split(command, comments=True)[1:]
    if words[0] in NO_PICTURE or any("mistake=" in word for word in words):  # the Lab does not draw mistakes
        return []
    if words[0] != "compare":
        own = option_words(words[1:])
        return [("", [model_of(words[0])] + larger(without(own, ("--output", "--turntable", "--sweep", "--frames", "--fps"))))]
    own = option_words(words[2:])
    base = without(own, ("--output", "--across", "--sheet"))
    with tempfile.TemporaryDirectory() as folder:
        small = without(own, ("--output", "--size", "--samples"))
        done = subprocess.run([program, "compare", words[1], *small, "--size=16", "--samples=1", "--json", "--output=" + os.path.join(folder, "sheet.png")],
                              cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit("site: %s: %s" % (command, done.stderr))
    return [(p["caption"], [model_of(words[1])] + larger(base) + option_words(p["words"])) for p in json.loads(done.stdout)["pictures"]]


def lab_links(program, command, page):
    """The links below a figure."""
    links = []
    for caption, words in pictures_of(program, command):
        address = "%s#%s" % (relative("lab.html", page), "&".join(quote(word, safe="") for word in words))
        links.append('<a href="%s">%s</a>' % (html.escape(address), html.escape(caption or "this picture")))
    return '<figcaption class="lab">Open in the Lab: %s</figcaption>' % " · ".join(links) if links else ""


# --- one page

def heading_id(text, seen):
    """GitHub's anchors: the words of a heading in small letters, joined by dashes."""
    plain = html.unescape(re.sub(r"<[^>]*>", "", text)).lower()
    name = re.sub(r"[^\w\- ]", "", plain.strip()).replace(" ", "-")
    seen[name] = seen.get(name, -1) + 1
    return name if not seen[name] else "%s-%d" % (name, seen[name])


def body_of(program, path, text):
    """Returns a Markdown file as HTML, and the project files that it links to."""
    page, linked, seen = target_of(path), set(), {}
    done = subprocess.run(["cmark-gfm", "-e", "table", "-e", "strikethrough", "-e", "autolink", "--unsafe"], input=text, stdout=subprocess.PIPE, text=True, check=True)
    body = re.sub(r"<h([1-6])>(.*?)</h\1>", lambda m: '<h%s id="%s">%s</h%s>' % (m[1], heading_id(m[2], seen), m[2], m[1]), done.stdout, flags=re.S)

    def address(match):
        before, link = match[1], html.unescape(match[2])
        if re.match(r"[a-z]+:|#", link):
            return match[0]
        file, hash_, anchor = link.partition("#")
        named = os.path.normpath(os.path.join(os.path.dirname(path), file))
        linked.add(named)
        return '%s="%s"' % (before, html.escape(relative(target_of(named), page) + hash_ + anchor))

    body = re.sub(r'(href|src)="([^"]*)"', address, body)
    # A figure and the command below it.
    def figure(match):
        command = html.unescape(match[3] or "").strip()
        drawn = command.startswith("lambent ") and "\n" not in command and "-o docs/pictures/" in command
        links = lab_links(program, command, page) if drawn else ""
        code = "<pre class=\"wrapped\"><code>%s</code></pre>" % html.escape(command) if drawn else match[2] or ""
        return "<figure>%s%s%s</figure>\n" % (match[1], links, code)

    body = re.sub(r"<p>((?:<img[^>]*/?>\s*)+)</p>\s*(<pre><code>([^<]*)</code></pre>)?", figure, body)
    body = re.sub(r"<img ", '<img loading="lazy" ', body)
    body = body.replace("<table>", '<div class="wide" tabindex="0"><table>').replace("</table>", "</table></div>")
    return body, linked


def whole_page(path, title, body):
    page = target_of(path)
    parts = ['<a href="%s"%s>%s</a>' % (relative(target_of(to), page), ' aria-current="page"' if to == path else "", name) for to, name in NAVIGATION]
    parts.append('<a href="%s">The Lab</a>' % relative("lab.html", page))
    return """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>%s</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="%s">
</head>
<body>
<nav aria-label="Pages">%s</nav>
<main>
%s</main>
</body>
</html>
""" % (html.escape(title), relative("site.css", page), "\n".join(parts), body.replace("<pre>", '<pre tabindex="0">')) # the keyboard scrolls it


def title_of(text, path):
    found = re.search(r"^# (.*)", text, re.M)
    return re.sub(r"[`*]", "", found[1]) + ("" if path == "README.md" else " · Lambent") if found else path


# --- the site

def write(folder, target, text):
    path = os.path.join(folder, target)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)


def source_page(path):
    """Converts a project file to a page; a folder becomes a list of its files."""
    full = os.path.join(ROOT, path)
    if os.path.isdir(full):
        items = ["<li><a href=\"%s\">%s</a></li>" % (os.path.basename(path) + "/" + name + ".html", name) for name in sorted(os.listdir(full))]
        return whole_page(path, path, "<h1>%s</h1>\n<ul>%s</ul>\n" % (html.escape(path), "".join(items)))
    return whole_page(path, path, "<h1>%s</h1>\n<pre><code>%s</code></pre>\n" % (html.escape(path), html.escape(open(full, encoding="utf-8").read())))


def text_of(path):
    if path != "docs/reference.md":
        return open(os.path.join(ROOT, path), encoding="utf-8").read()
    lines = []
    reference.write(reference.headers(os.path.join(ROOT, "include", "lambent")), lines)
    return "\n".join(lines)


def make(program, folder, lab):
    """Writes the site; `lab` is the single-file page."""
    shutil.rmtree(folder, ignore_errors=True)
    texts, linked, waiting = {}, set(), {os.path.relpath(path, ROOT) for path in pages()} | {"docs/reference.md"}
    while waiting:
        new = {path: text_of(path) for path in sorted(waiting)}
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            made = list(pool.map(lambda path: body_of(program, path, new[path]), new))
        for path, (body, more) in zip(new, made):
            write(folder, target_of(path), whole_page(path, title_of(new[path], path), body))
            linked |= more
        texts.update(new)
        waiting = {path for path in linked if path.endswith(".md") and path not in texts}
    for path in sorted(linked - set(texts)):
        full = os.path.join(ROOT, path)
        if not os.path.exists(full):
            sys.exit("site: %s is linked, and is not there" % path)
        if target_of(path) == path:
            os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
            shutil.copy(full, os.path.join(folder, path))
            continue
        write(folder, target_of(path), source_page(path))
        for name in os.listdir(full) if os.path.isdir(full) else []:
            write(folder, target_of(os.path.join(path, name)), source_page(os.path.join(path, name)))
    shutil.copy(os.path.join(ROOT, "scripts", "site.css"), folder)
    examples = {}
    for where, _, names in os.walk(os.path.join(ROOT, "examples")):
        for name in names:
            if name.endswith((".obj", ".mtl", ".json", ".glb")):
                path = os.path.join(where, name)
                examples["/" + os.path.relpath(path, ROOT)] = open(path, "rb").read()
    write(folder, "lab.html", build.with_files(open(lab, encoding="utf-8").read(), examples))


def main():
    program = os.path.abspath(sys.argv[1])
    folder = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else os.path.join(ROOT, "build-site"))
    lab = os.path.join(ROOT, "build-web", "lambent.html")
    if not os.path.exists(lab):
        sys.exit("site: %s is not there: `make web` makes it" % lab)
    make(program, folder, lab)
    print("The site: %s" % os.path.join(folder, "index.html"))


if __name__ == "__main__":
    main()
