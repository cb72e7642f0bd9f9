# test_desktop.py: the files for desktops (packaging/desktop), and thumbnails as requested by GNOME and Xfce.
import configparser
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import time
import unittest
import xml.etree.ElementTree

from harness import HAS_SANDBOX, PROGRAM, ROOT, Case

DESKTOP = ROOT / "packaging" / "desktop"
ID = "io.github.lambent.lambent"
ENDINGS = {"3mf": "model/3mf", "stl": "model/stl", "glb": "model/gltf-binary", "gltf": "model/gltf+json", "obj": "model/obj", "ply": "application/vnd.ply"}


def entry(name):
    parser = configparser.RawConfigParser()
    parser.optionxform = str
    parser.read(DESKTOP / name)
    return parser[parser.sections()[0]]


def tool(name):
    return unittest.skipUnless(shutil.which(name), f"{name} is not installed")


def expand(command, **fields):
    """The words of an Exec line, with its fields replaced."""
    return [re.sub("%([a-z])", lambda match: fields[match[1]], word) for word in shlex.split(command)]


class Files(Case):
    def test_formats(self):
        """Every model format has a MIME type in all of the files; scene files have none, because they are JSON."""
        reads = re.search(r"lambent reads (.*) and scene files", self.run_program("a.blend").stderr.decode())[1]
        self.assertEqual({word.strip(" .") for word in reads.split(",")}, set(ENDINGS))
        for name in ("lambent.thumbnailer", f"{ID}.desktop"):
            types = entry(name)["MimeType"].strip(";").split(";")
            self.assertEqual(set(types) - {"model/x.stl-ascii", "model/x.stl-binary"}, set(ENDINGS.values()), name)
        space = "{http://www.freedesktop.org/standards/shared-mime-info}"
        types = xml.etree.ElementTree.parse(DESKTOP / "lambent-mime.xml").getroot()
        self.assertEqual({kind.find(f"{space}glob").get("pattern")[2:]: kind.get("type") for kind in types}, ENDINGS)
        info = xml.etree.ElementTree.parse(DESKTOP / f"{ID}.metainfo.xml").getroot()
        self.assertEqual({node.text for node in info.iter("mediatype")}, set(ENDINGS.values()))
        self.assertEqual(info.find("launchable").text, f"{ID}.desktop")

    @tool("desktop-file-validate")
    def test_desktop_file(self):
        done = subprocess.run(["desktop-file-validate", DESKTOP / f"{ID}.desktop"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    @tool("appstreamcli")
    def test_metainfo(self):
        done = subprocess.run(["appstreamcli", "validate", "--no-net", DESKTOP / f"{ID}.metainfo.xml"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)

    @tool("update-mime-database")
    def test_mime_types(self):
        folder = self.folder / "mime" / "packages"
        folder.mkdir(parents=True)
        shutil.copy(DESKTOP / "lambent-mime.xml", folder / "lambent.xml")
        done = subprocess.run(["update-mime-database", folder.parent], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Unknown", done.stderr)
        globs = (folder.parent / "globs2").read_text()
        for ending, kind in ENDINGS.items():
            self.assertRegex(globs, rf"(?m)^\d+:{re.escape(kind)}:\*\.{ending}$")


class Thumbnails(Case):
    """The thumbnailer's command line works for every file name."""
    NAMES = ("cube.stl", "-a.stl", "a b'c\"d.stl", "%i%o.stl", "{stem}.stl", "größe.stl", "a;rm -rf $HOME.stl", "file:name.stl", "noise")

    def command(self, path, output, size=128):
        return expand(entry("lambent.thumbnailer")["Exec"], i=str(path), o=str(output), s=str(size))

    def test_names(self):
        """The picture has the requested size, and is a PNG for any output name."""
        model = (self.folder / "cube.stl").read_bytes()
        for name in self.NAMES:
            path = self.folder / name
            path.write_bytes(model)
            for output in ("thumbnail", "thumb.png"):
                words = self.command(path, self.folder / output)
                subprocess.run(words, check=True, cwd="/", env={**os.environ, "PATH": f"{pathlib.Path(PROGRAM).resolve().parent}:{os.environ['PATH']}"})
                data = (self.folder / output).read_bytes()
                self.assertEqual((data[:4], data[16:24]), (b"\x89PNG", (128).to_bytes(4, "big") * 2), name)
                os.remove(self.folder / output)

    def in_bubblewrap(self, path, output, more=()):
        """Runs like GNOME's thumbnailers: no network, one readable file, one writable folder."""
        program = pathlib.Path(PROGRAM).resolve()
        words = [word.replace("lambent -q", "lambent -q " + " ".join(more)) for word in self.command("/tmp/in/" + path.name, "/tmp/out/" + output.name)]
        binds = [word for name in ("/lib", "/lib64", "/bin", "/sbin") for word in
                 (("--symlink", os.readlink(name), name) if os.path.islink(name) else ("--ro-bind-try", name, name))]
        return ["bwrap", "--ro-bind", "/usr", "/usr", "--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache", *binds, "--proc", "/proc", "--dev", "/dev",
                "--chdir", "/", "--setenv", "GIO_USE_VFS", "local", "--setenv", "PATH", "/opt/lambent:/usr/bin", "--unshare-all", "--die-with-parent", "--ro-bind", str(program.parent), "/opt/lambent",
                "--bind", str(output.parent), "/tmp/out", "--ro-bind", str(path), "/tmp/in/" + path.name, *words]

    def can_wrap(self):
        if subprocess.run(["bwrap", "--ro-bind", "/", "/", "--unshare-all", "true"], capture_output=True).returncode:
            self.skipTest("bubblewrap cannot make a sandbox here")

    @tool("bwrap")
    def test_bubblewrap(self):
        """Inside bubblewrap, and inside the program's own sandbox within it."""
        self.can_wrap()
        out = self.folder / "out"
        out.mkdir()
        model = (self.folder / "cube.stl").read_bytes()
        for name in self.NAMES:
            (self.folder / name).write_bytes(model)
            more = ("--sandbox", "require") if HAS_SANDBOX else ()
            done = subprocess.run(self.in_bubblewrap(self.folder / name, out / "gnome-desktop-thumbnailer.png", more), capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertEqual(os.listdir(out), ["gnome-desktop-thumbnailer.png"])
            os.remove(out / "gnome-desktop-thumbnailer.png")

    @tool("bwrap")
    def test_bad_file(self):
        self.can_wrap()
        out = self.folder / "out"
        out.mkdir()
        (self.folder / "bad.stl").write_bytes(b"solid x\nfacet garbage")
        done = subprocess.run(self.in_bubblewrap(self.folder / "bad.stl", out / "a.png"), capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n"), (out / "a.png").stat().st_size), (2, 1, 0))


@unittest.skipUnless(all(map(shutil.which, ("dbus-run-session", "gdbus", "update-mime-database"))), "dbus, gdbus or update-mime-database is not installed")
class Tumbler(Case):
    """Xfce's thumbnail service on its own bus, with the files where `make install` puts them."""

    def setUp(self):
        super().setUp()
        found = sorted(path for folder in ("/usr/lib", "/usr/libexec") for path in pathlib.Path(folder).glob("**/tumblerd"))
        if not found:
            self.skipTest("tumbler is not installed")
        self.daemon = found[0]

    def test_service(self):
        share, programs, home = self.folder / "share", self.folder / "programs", self.folder / "home"
        (share / "thumbnailers").mkdir(parents=True)
        (share / "mime" / "packages").mkdir(parents=True)
        programs.mkdir()
        home.mkdir()
        shutil.copy(DESKTOP / "lambent.thumbnailer", share / "thumbnailers")
        shutil.copy(DESKTOP / "lambent-mime.xml", share / "mime" / "packages" / "lambent.xml")
        subprocess.run(["update-mime-database", share / "mime"], check=True, stderr=subprocess.DEVNULL)
        os.symlink(pathlib.Path(PROGRAM).resolve(), programs / "lambent")
        models = self.folder / "models"
        models.mkdir()
        for name in ("cube.stl", "cube.obj", "cube.ply"):
            shutil.copy(self.folder / name, models)
        shutil.copy(ROOT / "tests" / "fuzz" / "corpus" / "3mf" / "deflated.3mf", models / "a b.3mf")
        names = sorted(os.listdir(models))
        uris = [(models / name).as_uri() for name in names]
        types = [ENDINGS[name.rsplit(".", 1)[1]] for name in names]
        call = ["gdbus", "call", "--session", "--dest", "org.freedesktop.thumbnails.Thumbnailer1", "--object-path", "/org/freedesktop/thumbnails/Thumbnailer1",
                "--method", "org.freedesktop.thumbnails.Thumbnailer1.Queue", json.dumps(uris), json.dumps(types), "normal", "default", "0"]
        script = f"{shlex.quote(str(self.daemon))} & gdbus wait --session --timeout 20 org.freedesktop.thumbnails.Thumbnailer1; {shlex.join(call)}; wait"
        session = subprocess.Popen(["dbus-run-session", "--", "sh", "-c", script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   start_new_session=True, env={"PATH": f"{programs}:{os.environ['PATH']}", "HOME": str(home), "XDG_CACHE_HOME": str(home / "cache"),
                                                                "XDG_DATA_HOME": str(home), "XDG_DATA_DIRS": f"{share}:/usr/local/share:/usr/share"})
        made = []
        for _ in range(300):
            made = list((home / "cache" / "thumbnails").glob("normal/*.png"))
            if len(made) == len(names) or session.poll() is not None:
                break
            time.sleep(0.1)
        os.killpg(session.pid, 15)
        text = session.communicate()[0]
        self.assertEqual(len(made), len(names), text)
        for path in made:
            data = path.read_bytes()
            self.assertEqual(data[:4], b"\x89PNG")
            self.assertIn(b"Thumb::URI", data)
