# test_foreign.py: names of files and of what models contain are text in everything that the program writes: the pages and figures consist of the same
# elements as those for harmless names, and no output contains a control character.
import html.parser
import json
import re
import xml.etree.ElementTree

from harness import OWN_MODELS, Case

NAMES = ["\"><img src=x onerror=alert(1)>", "_script><script>alert(1)</script>", "<!--<script>", "' onload='alert(1)", "a]]>--><b>", "a\nb\r<b>", "\u202e<b>\u2028\u2029\u2066",
         "\x1b[2J\x9b<b>\x7f", "&lt;b&gt;&#60;<b>", "%s%n{stem}<b>", "\ufffe\uffff<b>", "</title></style></textarea></template><b>"]
HIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


class Tags(html.parser.HTMLParser):
    """The elements of a page with the names of their attributes."""

    def __init__(self, page):
        super().__init__()
        self.found = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, [name for name, _ in attrs]))

    def handle_endtag(self, tag):
        self.found.append("/" + tag)

    def handle_decl(self, decl):
        self.found.append(decl)

    handle_comment = unknown_decl = handle_pi = handle_decl


def tags_of(data):
    """The elements of an HTML or SVG file."""
    text = data.decode()
    if text.startswith("<!DOCTYPE html") or text.startswith("<!doctype html"):
        return Tags(text).found
    return [element.tag for element in xml.etree.ElementTree.fromstring(text).iter()]


class Foreign(Case):
    def write(self, name, folder):
        """Writes a model with this name, in which everything has this name, and a damaged one."""
        folder = self.folder / folder
        folder.mkdir()
        triangle = json.loads((OWN_MODELS.parent / "fuzz/corpus/gltf/triangle.gltf").read_text())
        for kind in ("nodes", "meshes", "materials", "scenes", "images", "cameras"):
            for item in triangle.get(kind, []):
                item["name"] = name
        triangle["asset"]["generator"] = triangle["asset"]["copyright"] = name
        triangle.setdefault("images", []).append({"uri": "no.png", "name": name})
        file = name.replace("/", "_")
        (folder / f"{file}.gltf").write_text(json.dumps(triangle))
        (folder / f"{file}.stl").write_bytes(b"bad")
        return f"{folder.name}/{file}.gltf"

    def outputs(self, name, folder):
        """Runs every command that prints names; returns its files, exit codes and texts."""
        model, out = self.write(name, folder), f"out-{folder}"
        (self.folder / out).mkdir()
        runs = {"report": ("batch", folder, "-s", 8, "--report", f"{out}/report.html", "-o", out + "/p/{stem}-{ext}.png"),
                "journal": ("journal", f"{out}/p", "--report", f"{out}/journal.html"), "merged": ("journal", f"{out}/p", "-o", f"{out}/merged"),
                "diff": ("diff", model, model, "-s", 16, "-o", f"{out}/diff.html"), "folders": ("diff", folder, folder, "-s", 8, "-o", f"{out}/folders.html"),
                "svg": ("compare", model, "-s", 16, "-o", f"{out}/compare.svg"), "3mf": ("convert", model, f"{out}/a.3mf"), "again": ("info", f"{out}/a.3mf"),
                "explain": ("explain", model, "8,8", "-s", 16), "info": ("info", model), "report-json": (model, "-s", 8, "--json", "-o", f"{out}/a.png"),
                "shader": ("shader", model), "host": ("shader", model, "--host", "c"), "lights": ("lights", model), "bad": (model[:-4] + "stl", "-s", 8),
                "hash": ("hash", folder, "-s", 8, "-o", f"{out}/a.hash", "--failures-ok"), "view": ("cube.obj", "--view", name), "option": ("--" + name,)}
        done = {key: self.run_program(*words) for key, words in runs.items()}
        return {key: run.returncode for key, run in done.items()}, b"".join(run.stdout + run.stderr for run in done.values()), self.folder / out

    def test_names(self):
        codes, _, out = self.outputs("harmless", "m")
        pages = {path.name: tags_of(path.read_bytes()) for path in out.iterdir() if path.suffix in (".html", ".svg")}
        self.assertEqual(set(pages), {"report.html", "journal.html", "diff.html", "folders.html", "compare.svg"})
        for number, name in enumerate(NAMES):
            own, text, out = self.outputs(name, f"m{number}")
            self.assertEqual(own, codes, name)
            self.assertEqual(HIDDEN.findall(text.decode()), [], name)
            for page, tags in pages.items():
                data = (out / page).read_bytes()
                self.assertEqual(tags_of(data), tags, (name, page))
                self.assertEqual(HIDDEN.findall(data.decode()), [], (name, page))
