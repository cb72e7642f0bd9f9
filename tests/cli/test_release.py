# test_release.py: the version number, and the notes of `make release`.
import hashlib
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from harness import PROGRAM, ROOT, Case

SPEC = importlib.util.spec_from_file_location("release", ROOT / "packaging" / "release.py")
release = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(release)


class Release(Case):
    def test_version(self):
        """meson.build contains the version number; the header, the program and the change log agree with it."""
        version = release.version()
        header = (ROOT / "include" / "lambent" / "base.h").read_text()
        numbers = [re.search(rf"LAM_VERSION_{part} +(\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH")]
        self.assertEqual((".".join(numbers), re.search(r'LAM_VERSION_TEXT +"(.*)"', header)[1]), (version, version))
        self.assertEqual(self.good("--version").stdout.decode().splitlines()[0], "lambent " + version)
        self.assertTrue(release.section())

    def test_archive(self):
        """An unpacked source archive, which has no .git, knows the commit's time, and copies itself without what was built in it."""
        if not (ROOT / ".git").exists():
            self.skipTest("no clone")
        first, second = self.folder / "first", self.folder / "second"
        release.project.tree(first)
        (first / "build-deb").mkdir()
        (first / "build-deb" / "old").touch()
        subprocess.run([first / "scripts/project.py", "tree", second], check=True)
        self.assertFalse((second / "build-deb").exists())
        for place in (first, second):
            self.assertFalse((place / ".git").exists())
            self.assertEqual([subprocess.check_output([place / "scripts/project.py", fact], text=True).strip() for fact in ("version", "tag", "time")],
                             [release.version(), "v" + release.version(), str(release.project.time())])
        self.assertTrue((second / "web/build.py").exists() and (second / "packaging/debian/rules").exists())

    def test_materials(self):
        """The bill of materials lists each file with its hash, and each source package whose code is in it."""
        dist, web = self.folder / "dist", self.folder / "web"
        for folder in (dist, web / "source"):
            folder.mkdir(parents=True)
        (dist / "lambent-page.zip").write_bytes(b"page")
        (dist / "NOTES.md").write_bytes(b"notes")
        (web / "source" / "zlib_1.2.13.dfsg-1.dsc").touch()
        bill = release.materials(dist, {"lambent-page.zip": (web, [])})
        zlib = "pkg:deb/debian/zlib@1.2.13.dfsg-1?arch=source"
        self.assertEqual([part["bom-ref"] for part in bill["components"]], ["NOTES.md", "lambent-page.zip", zlib])
        self.assertEqual(bill["components"][1]["hashes"][0]["content"], hashlib.sha256(b"page").hexdigest())
        self.assertEqual({row["ref"]: row["dependsOn"] for row in bill["dependencies"]}, {"NOTES.md": [], "lambent-page.zip": [zlib]})

    @unittest.skipUnless(shutil.which("nm"), "no nm")
    def test_symbols(self):
        """The symbols files of the Debian packages match the exports of the libraries; otherwise `make deb` would stop."""
        if not list(pathlib.Path(PROGRAM).parent.glob("src/liblambent.so")):
            self.skipTest("this build has no shared library")
        done = subprocess.run([sys.executable, ROOT / "packaging" / "symbols.py", pathlib.Path(PROGRAM).parent, "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr + "python3 packaging/symbols.py BUILD writes them anew")

    @unittest.skipUnless(shutil.which("git"), "no git")
    def test_notes(self):
        """Pictures that differ from the last release are listed by name."""
        root = pathlib.Path(self.folder) / "project"
        expected = root / release.EXPECTED
        expected.parent.mkdir(parents=True)

        def git(*words):
            subprocess.run(["git", "-C", root, "-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false", *words], check=True,
                           stdout=subprocess.DEVNULL)

        def write(version, changes, **pictures):
            (root / "meson.build").write_text(f"project('lambent', 'c',\n  version: '{version}',\n")
            (root / "CHANGELOG.md").write_text(changes)
            expected.write_text("".join(f"{name} {text}\n" for name, text in pictures.items()))
            git("add", "-A")
            git("commit", "-q", "-m", version)

        root.mkdir(exist_ok=True)
        git("init", "-q")
        write("0.1.0", "# Changelog\n\n## 0.1.0\n\n- The first.\n", cube="1", ball="1", torus="1")
        self.assertIn("This is the first release.", release.notes(root))
        git("tag", "v0.1.0")
        write("0.2.0", "# Changelog\n\n## 0.2.0 (today)\n\n- The second.\n\n## 0.1.0\n\n- The first.\n", cube="1", ball="1", torus="1")
        self.assertEqual(release.section(root), "- The second.")
        self.assertIn("The pictures are those of v0.1.0, byte for byte.", release.notes(root))
        write("0.2.0", "# Changelog\n\n## 0.2.0\n\n- The second.\n", cube="1", ball="2", knot="1")
        self.assertEqual(release.changed_pictures("v0.1.0", root), [("ball", "changed"), ("knot", "new"), ("torus", "gone")])
        self.assertIn("- ball: changed\n- knot: new\n- torus: gone\n", release.notes(root))
        write("0.3.0", "# Changelog\n")
        with self.assertRaises(SystemExit):
            release.section(root)
