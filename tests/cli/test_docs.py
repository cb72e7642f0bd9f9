# test_docs.py: the help, the man page, the completions and the docs are complete, well formed and up to date.
import re
import shlex
import shutil
import subprocess
import unittest

from harness import PROGRAM, ROOT, Case


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

    def test_every_output_has_every_option(self):
        wanted = options_of(self.help())
        self.assertGreater(len(wanted), 20)
        for kind in ("markdown", "bash"):
            self.assertEqual(options_of(self.good("generate", kind).stdout.decode()) - {"-"} & wanted, wanted, kind)
        man = self.good("generate", "man").stdout.decode().replace("\\-", "-")
        zsh = self.good("generate", "zsh").stdout.decode()
        fish = self.good("generate", "fish").stdout.decode()
        for option in wanted:
            self.assertIn(f"--{option}", man)
            self.assertIn(f"--{option}", zsh)
            self.assertRegex(fish, rf"-l {option}\b")

    def test_examples_are_right(self):
        # Every option of an example is in the table, and each example's command line parses.
        for line in re.findall(r"(?m)^  (lambent .*?)(?:  .*)?$", self.help().split("\nPicture:")[0]):
            words = shlex.split(line.replace("*.stl", "cube.stl").split("<")[0])[1:]
            (self.folder / "pictures").mkdir(exist_ok=True)
            limit = ["--memory-limit", "1k"] if words[0] not in ("diff", "plot", "explain", "check") else []
            done = self.run_program(*words, *limit, stdin=b"")
            self.assertNotEqual(done.returncode, 1, (line, done.stderr))

    def test_committed_docs_are_up_to_date(self):
        made = self.good("generate", "markdown").stdout.decode()
        kept = (ROOT / "docs" / "command-line.md").read_text()
        self.assertEqual(kept, made, "refresh it: lambent generate markdown > docs/command-line.md")

    def test_links_and_pictures(self):
        """Every link has a target, every picture is shown on a page, and each is drawn by a command on a page or by the program of
        mistakes."""
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
        self.assertEqual({p for p in kept if not p.name.startswith("mistake-")}, drawn)

    def test_anchors(self):
        """A link to a place in a page names a heading of it."""
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
            for link, place in re.findall(r"\]\(([^)#\s]*)#([^)\s]*)\)", page.read_text()):
                if "://" not in link:
                    target = (page.parent / link).resolve() if link else page
                    headings = {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-")
                                for h in re.findall(r"(?m)^#+ (.*)$", target.read_text())}
                    self.assertIn(place, headings, f"{page.name}: {link}#{place}")

    def test_completions(self):
        script = self.good("generate", "bash").stdout
        subprocess.run(["bash", "-n"], input=script, check=True)
        ask = script.decode() + """
            ask() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lambent; echo "${COMPREPLY[*]}"; }
            ask lambent --sha
            ask lambent --shading fl
            ask lambent tea
            ask lambent x.obj -o cube.o
            ask lambent generate b
        """
        done = subprocess.run(["bash", "-c", ask], cwd=self.folder, capture_output=True, check=True)
        self.assertEqual(done.stdout.decode().splitlines(), ["--shading", "flat", "teapot", "cube.obj", "bash"])
        for shell in ("zsh", "fish"):
            if shutil.which(shell):
                script = self.good("generate", shell).stdout
                subprocess.run([shell, "-n", "/dev/stdin"], input=script, check=True)

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


if __name__ == "__main__":
    unittest.main()
