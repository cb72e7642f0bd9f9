# test_docs.py: the help, the man page, the completions and the docs are complete, well formed and up to date.
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from harness import PROGRAM, ROOT, Case, long, pixel, read_png


def options_of(text):
    return set(re.findall(r"(?<![\w-])--([a-z][a-z0-9-]*)", text))


class Docs(Case):
    def help(self):
        return self.good("--help").stdout.decode()

    def test_help(self):
        text = self.help()
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertNotIn("`", text)
        self.assertLess(text.index("Examples:"), text.index("--output"))
        for option in ("output", "size", "samples", "background", "view", "azimuth", "elevation", "zoom", "up", "camera",
                       "threads", "isa", "shading", "reflection", "color", "crease-angle", "json", "quiet", "verbose",
                       "version", "help"):
            self.assertIn(f"--{option}", text)
        for code in ("0", "1", "2", "3", "4", "5", "6", "130"):
            self.assertRegex(text, rf"(?m)^  {code} ")

    def test_contracts(self):
        """docs/check/contracts.md contains the current names and programs; test_check tests its reports."""
        done = subprocess.run([sys.executable, ROOT / "scripts" / "contracts.py", PROGRAM, "--check"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout.decode())
        page = (ROOT / "docs" / "check" / "contracts.md").read_text()
        for link in re.findall(r"\]\(([^)]*)\)", page):
            if link.startswith("#"):
                self.assertIn(f"\n## `{link[1:]}`\n", page)
            else:
                self.assertTrue((ROOT / "docs" / "check" / link).exists(), link)
        for lecture in (ROOT / "classroom" / "tests" / "check" / "lectures").iterdir():
            self.assertIn(f"lectures/{lecture.stem}.", page)

    def test_brief_help(self):
        """-h is short: 25 lines of 80 columns, with the examples first and every command listed."""
        lines = self.good("-h").stdout.decode().splitlines()
        self.assertLessEqual(len(lines), 25)
        self.assertLessEqual(max(map(len, lines)), 80)
        text = "\n".join(lines)
        self.assertNotIn("`", text)
        self.assertLess(text.index("lambent koala.obj"), text.index("--output"))
        for option in ("output", "size", "background", "view", "up", "material", "color", "light", "shading"):
            self.assertRegex(text, rf"(?m)^  .*--{option}\b")
        for word in ("gl-device", "light-cutoff", "tolerance"):
            self.assertNotIn(f"--{word}", text)
        self.assertIn("lambent --help", text)
        commands = re.search(r"Commands: ([\w\s,]*)\nComplete help", text).group(1).replace(",", "").split()
        self.assertGreater(len(commands), 10)
        for command in ("render", *commands):
            brief, whole = (self.good(command, way).stdout.decode() for way in ("-h", "--help"))
            self.assertTrue(brief.startswith(("Usage: lambent " + command, "lambent renders")), brief)
            self.assertLessEqual(options_of(brief) - {"help"}, options_of(whole), command)
            self.assertLessEqual(len(brief.splitlines()), 40, command)
        self.assertEqual(self.good("-qh").stdout, self.good("-h").stdout)

    def test_help_by_subject(self):
        """Every subject, command and option has a page, and every option belongs to a subject."""
        listed = self.good("help").stdout.decode()
        subjects, commands = (re.findall(r"(?m)^  ([a-z-]+)", part) for part in
                              listed.split("Subjects:")[1].split("Options:")[0].split("Commands:"))
        self.assertGreater(len(subjects), 15)
        pages = {name: self.good("help", name).stdout.decode() for name in subjects + commands}
        for name, page in pages.items():
            self.assertGreater(len(page.splitlines()), 1, name)
            self.assertNotIn("`", page)
            self.assertLessEqual(max(map(len, page.splitlines())), 100, name)
        options = options_of(self.good("generate", "markdown").stdout.decode().split("## Commands")[0]) - {"help", "version"}
        options -= {"out"}  # another name of --output
        options = {name for name in options if self.run_program("help", name).returncode == 0}
        self.assertGreater(len(options), 60)
        for name in options:
            own = self.good("help", "--" + name).stdout.decode()
            if f"--{name}" in own.partition("Other names:")[2]:
                continue
            self.assertRegex(own, rf"^  (-\w, |    )--{name}\b")
            self.assertTrue(any(re.search(rf"(?m)^  (-\w, |    )--{name}\b", pages[s]) for s in subjects), name)
        self.assertEqual(self.good("help", "-o").stdout, self.good("help", "--output").stdout)
        self.assertEqual(self.good("help", "all").stdout, self.good("--help").stdout)
        self.assertIn("frame=world|camera|view|object", pages["lights"])
        for key in ("cutoff", "attenuation", "sky"):
            self.assertRegex(pages["lights"], rf"(?m)^  {key} ")
        self.assertRegex(pages["materials"], r"(?m)^  roughness_angle ")
        self.assertRegex(pages["exit-codes"], r"(?m)^  130 ")

    def test_own_options_first(self):
        """A command describes its own options, and then lists the options that it shares with pictures of models."""
        for command, own in (("shape", "parametric"), ("shader", "glsl"), ("compare", "across"), ("batch", "journal"), ("view", "port")):
            page = self.good(command, "--help").stdout.decode()
            rows, _, shared = page.partition("\nShared with pictures of models (lambent --help describes them")
            options = re.findall(r"(?m)^  (?:-\w, |    )--([a-z][a-z0-9-]*)", rows)
            self.assertIn(own, options)
            self.assertRegex(shared, r"(?m)^  Shading +--shading, ")
            self.assertFalse(set(options) & set(re.findall(r"--([a-z][a-z0-9-]*)", shared.partition(":\n")[2])), command)
            self.assertLess(len(page.splitlines()), 110, command)
            self.assertLess(rows.index("--" + own), rows.index("--output") if "  -o, --output" in rows else len(rows))

    def test_commands_show_their_own_defaults(self):
        def default(command, option):
            page = " ".join(self.good(command, "--help").stdout.decode().split())
            return re.search(rf"--{option} .*?(?:\[([^]]*)\] (?=--|-\w,|[A-Z]|$)|(?= --| -\w,))", page).group(1)
        for command, size in (("render", "1024"), ("compare", "480x400 each"), ("plot", "1600x1000"), ("check", "128"), ("materials", "1024x593")):
            self.assertEqual(default(command, "size W[xH]".replace("[", "\\[").replace("]", "\\]")), size)
        self.assertEqual(read_png(self.good("plot", "spot", "-o", "-", "-q", "--no-captions").stdout)[:2], (1600, 1000))
        self.assertEqual(read_png(self.good("materials", "-o", "-", "--no-captions").stdout)[:2], (1024, 593))
        page = read_png(self.good("compare", "cube.obj", "--across", "azimuth=1", "-o", "-", "-q", "--no-captions").stdout)
        self.assertEqual(page[:2], (480 + 2 * 25, 400 + 2 * 25))
        self.assertEqual(pixel(page, 28, 28), (255, 255, 255, 255))
        self.assertEqual([default(c, "output FILE") for c in ("render", "compare", "plot", "shader", "diff", "materials", "check")],
                         ["MODEL.png", "MODEL-SHEET.png", "KIND.png", "standard output", "no picture, no page", "no sheet", "no sheet"])
        self.assertEqual([default(c, "background COLOR") for c in ("render", "compare")], ["transparent", "white"])
        self.assertEqual([default(c, "tolerance STEPS") for c in ("diff", "check")], ["0", "2"])
        # Their behaviour without -o.
        self.good("compare", "cube.obj", "-s", 16, "--no-captions", "-q")
        self.good("plot", "spot", "-s", 64, "--no-captions", "-q")
        self.assertEqual(self.new_files(), {"cube-summary.png", "spot.png"})
        self.good("materials")
        self.assertIn(b"#version", self.good("shader", "cube.obj").stdout)
        self.good("diff", "spot.png", "spot.png")
        self.assertEqual(self.new_files(), {"cube-summary.png", "spot.png"})

    def test_usage_errors_say_where_to_look(self):
        for words, says in ((("cube.obj", "--light", "sun"), "lambent help light"), (("plot", "x"), "lambent plot -h"),
                            (("diff", "a"), "lambent diff -h"), (("cube.obj", "--nothing-like-it"), "lambent -h"),
                            (("cube.obj", "-o"), "lambent help output")):
            done = self.bad(1, *words, says=f"Try '{says}'.")
            self.good(*says.split()[1:])

    def test_every_output_has_every_option(self):
        wanted = options_of(self.help())
        self.assertGreater(len(wanted), 20)
        self.assertEqual(options_of(self.good("generate", "markdown").stdout.decode()) & wanted, wanted)
        man = self.good("generate", "man").stdout.decode().replace("\\-", "-")
        for option in wanted:
            self.assertIn(f"--{option}", man)

    def test_examples_are_right(self):
        # Every option of an example is in the table, and each example's command line can be parsed.
        for line in re.findall(r"(?m)^  (lambent .*?)(?:  .*)?$", self.help().split("\nPicture:")[0]):
            words = shlex.split(line.replace("*.stl", "cube.stl").split("<")[0])[1:]
            (self.folder / "pictures").mkdir(exist_ok=True)
            limit = ["--memory-limit", "1k"] if words[0] not in ("diff", "plot", "explain", "check") else []
            done = self.run_program(*words, *limit, stdin=b"")
            self.assertNotEqual(done.returncode, 1, (line, done.stderr))

    @unittest.skipUnless(shutil.which("dpkg-query"), "not Debian")
    def test_packages_of_libraries(self):
        """The packages that `make` installs include every library that is loaded when needed; libchafa only draws in terminals."""
        sources = [path for folder in ("src", "program", "tools", "classroom") for ending in ("c", "h") for path in (ROOT / folder).rglob("*." + ending)]
        names = {name for path in sources for name in re.findall(r'"(lib[\w+-]+\.so\.[\w.]+)"', path.read_text())} - {"libchafa.so.0"}
        self.assertGreaterEqual(names, {"libmeshoptimizer.so.2d", "libwebp.so.7", "libmicrohttpd.so.12"})
        owners = subprocess.run(["dpkg-query", "-S", *("*/" + name for name in names)], capture_output=True, text=True).stdout.splitlines()
        needs = {}
        for line in subprocess.run(["dpkg-query", "-W", "-f", "${Package}|${Pre-Depends}, ${Depends}\n"], capture_output=True, text=True).stdout.splitlines():
            package, depends = line.split("|", 1)
            needs[package] = set(re.findall(r"(?:^|[,|]) *([a-z0-9.+-]+)", depends))
        found, new = set(), {name for line in re.findall(r"(?m)^build (\S+)$", (ROOT / "packages.txt").read_text()) for name in line.split("|")}
        while new:
            found |= new
            new = {need for package in new for need in needs.get(package, ())} - found
        self.assertGreater(len(owners), 5)
        for line in owners:
            self.assertIn(line.split(":")[0], found, line)

    def test_committed_docs_are_up_to_date(self):
        made = self.good("generate", "markdown").stdout.decode()
        kept = (ROOT / "docs" / "command-line.md").read_text()
        self.assertEqual(kept, made, "refresh it: lambent generate markdown > docs/command-line.md")

    def sheet(self, page, picture):
        """The pictures of a page's sheet, scaled to 48 pixels: caption and pixels."""
        [line] = re.findall(rf"(?m)^ +lambent (compare .* -o docs/pictures/lighting/{picture}\.png)$", (ROOT / "docs/lighting" / page).read_text())
        words = [word.replace("examples/", str(ROOT / "examples") + "/") for word in shlex.split(line)[:-2]]
        size = words.index("-s")
        del words[size : size + 2]
        done = json.loads(self.good(*words, "-s", "48", "-o", "sheet.png", "--json").stdout)
        more = [word for i, word in enumerate(words[2:], 2) if "--across" not in words[i - 1 : i + 1]]
        more = [word for i, word in enumerate(more) if word not in ("--sheet",) and (i == 0 or more[i - 1] != "--sheet")]
        return {one["caption"]: self.good(words[1], "-s", "48", *more, *one["words"], "-o", "-").stdout for one in done["pictures"]}

    def test_rows_of_sheets(self):
        """Sheets about normals and sides show differences: each method with its own normals, each omitted side."""
        normals = self.sheet("shading.md", "normals")
        for shading, different in (("flat", 1), ("gouraud", 3), ("phong", 3)):
            self.assertEqual(len({normals[f"normals {source}, shading {shading}"] for source in ("file", "smooth", "facet")}), different, shading)
        self.assertEqual(len(set(self.sheet("surfaces.md", "sides").values())), 3)

    @long
    def test_sheets_of_pages(self):
        """No two pictures of a sheet in docs/lighting are equal, except for flat shading, which ignores vertex normals."""
        checked = 0
        for page in sorted((ROOT / "docs/lighting").glob("*.md")):
            for picture in re.findall(r"(?m)^ +lambent compare .*--across.* -o docs/pictures/lighting/([a-z-]+)\.png$", page.read_text()):
                seen = {}
                for caption, pixels in self.sheet(page.name, picture).items():
                    same = seen.setdefault(pixels, caption)
                    self.assertTrue(same == caption or "shading flat" in caption, f"{page.name}, {picture}: '{caption}' is '{same}'")
                checked += 1
        self.assertGreater(checked, 20)

    def test_readme_commands(self):
        """Every command in a code block of the README and of docs/examples.md works, in order, in a built tree. One picture, which takes 14 s of
        processor time, is drawn smaller."""
        self.run_readme({"examples/still-life.json": "-s 160 --samples 1"})

    @long
    def test_readme_commands_in_full(self):
        self.run_readme({})

    def run_readme(self, more):
        (self.folder / "build").mkdir()
        os.symlink(PROGRAM, self.folder / "build" / "lambent")
        shutil.copytree(ROOT / "examples", self.folder / "examples")
        (self.folder / "docs" / "pictures").mkdir(parents=True)  # it exists in the tree
        pages = (ROOT / "README.md").read_text() + (ROOT / "docs" / "examples.md").read_text()
        blocks = re.findall(r"(?m)^\n((?:    \S.*\n)+)", pages)
        lines = [line.strip() for block in blocks for line in block.splitlines()]
        ours = [line for line in lines if not line.startswith("make ")]
        self.assertGreater(sum(line.startswith("lambent ") for line in ours), 12)
        for line in lines:
            if line not in ours:
                target = line.split("#")[0].split()[1:]
                self.assertRegex((ROOT / "Makefile").read_text(), rf"(?m)^{target[0]}:", line)
        gl = self.run_program("sphere", "--device", "gl", "-s", 8, "-o", "-").returncode == 0
        path = [p for p in os.environ["PATH"].split(":") if not (pathlib.Path(p) / "lambent").exists()]
        settings = [line for line in ours if not line.startswith("lambent ")]
        for line in ours:
            if line in settings or (not gl and ("--device gl" in line or "lambent check" in line)):
                continue
            line += "".join(f" {words}" for part, words in more.items() if part in line)
            done = subprocess.run(["bash", "-c", "\n".join([*settings, line])], cwd=self.folder, capture_output=True, timeout=120,
                                  env={**os.environ, "PATH": ":".join(path)})
            self.assertEqual(done.returncode, 0, f"{line}: {done.stderr.decode()}")
            for name in re.findall(r"-o (\S+)", line):
                if "{" not in name:  # a pattern
                    self.assertTrue((self.folder / name).exists(), line)
        self.assertEqual(set(os.listdir(self.folder / "out" / "catalogue")), {"spot.png", "parts.png"})
        self.assertEqual({path.name for path in (self.folder / "out" / "thumbs").glob("*.png")}, {f"{model}-{view}.png" for model in ("spot-glb", "spot-obj", "parts-obj") for view in ("front", "left")})

    def test_commands_of_the_pages(self):
        """Every command in a code block of the README and of docs/ is valid: options, values and commands. Most file names are invented."""
        tried = 0
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
            for line in re.findall(r"(?m)^    (lambent .*)$", page.read_text()):
                words = shlex.split(re.split(r" [<>|] |\s#\s", line)[0])[1:]
                if "[OPTIONS]" in words or "COMMAND" in words:
                    continue
                tried += 1
                limit = ["--count", "1"] if words[0] == "exercises" else ["--memory-limit", "1k"] if words[0] not in ("diff", "plot", "check", "materials", "devices", "generate", "formats", "journal") else []
                (self.folder / "docs" / "pictures" / "lighting").mkdir(parents=True, exist_ok=True)
                done = self.run_program(*words, *limit)
                self.assertNotEqual(done.returncode, 1, (page.name, line, done.stderr))
        self.assertGreater(tried, 20)

    def test_links_and_pictures(self):
        """Every link has a target, every picture appears on a page, and a command on a page or the program of mistakes draws it."""
        shown, drawn = set(), set()
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
            text = page.read_text()
            for link in re.findall(r"\]\(([^)#\s]*)(?:#[^)\s]*)?\)", text):
                if link and "://" not in link:
                    target = (page.parent / link).resolve()
                    self.assertTrue(target.exists(), f"{page.name}: {link}")
                    if target.suffix == ".png":
                        shown.add(target)
            drawn |= {ROOT / name for name in re.findall(r"(?m)^\s+lambent .*-o (docs/pictures/\S+)", text)}
        kept = set((ROOT / "docs" / "pictures").rglob("*.png"))
        self.assertEqual(shown, kept)
        self.assertEqual({p for p in kept if not p.name.startswith("mistake-")}, {p for p in drawn if p.suffix == ".png"})
        self.assertEqual([p for p in drawn if not p.exists()], [])

    def test_anchors(self):
        """A link to a section of a page refers to an existing heading."""
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
            for link, place in re.findall(r"\]\(([^)#\s]*)#([^)\s]*)\)", page.read_text()):
                if "://" not in link:
                    target = (page.parent / link).resolve() if link else page
                    headings = {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-")
                                for h in re.findall(r"(?m)^#+ (.*)$", target.read_text())}
                    self.assertIn(place, headings, f"{page.name}: {link}#{place}")

    @unittest.skipUnless(shutil.which("groff"), "no groff")
    def test_man_page(self):
        page = self.good("generate", "man").stdout
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-P-c"], input=page, capture_output=True, check=True)
        self.assertEqual(done.stderr, b"")
        plain = re.sub(b".\b", b"", done.stdout)  # without overstriking
        for word in (b"--crease-angle", b"EXIT STATUS", b"EXAMPLES", b"NO_COLOR"):
            self.assertIn(word, plain)

    def test_schema_describes_every_option_word(self):
        schema = (ROOT / "docs" / "report.schema.json").read_text()
        for isa in re.search(r"The instruction set: (.*)", self.help()).group(1).split(" [")[0].rstrip(".").replace(" or ", ", ").split(", "):
            if isa and isa != "auto":
                self.assertIn(f'"{isa}"', schema)
