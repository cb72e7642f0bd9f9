# test_page.py: `lambent MODEL -o page.html`: the single-file page with the model, its related files and the command line.
#
# Most tests use a small page of their own (LAMBENT_PAGE); its contents are the additions of the program. tests/browser.py
# tests the real page in a browser.
import base64
import hashlib
import html
import json
import os
import re
import shutil
import subprocess

from harness import OWN_MODELS, PROGRAM, Case, write_png

SCRIPT = "console.log('</bo' + 'dy>');"
POLICY = "default-src 'none'; script-src 'sha256-%s'" % base64.b64encode(hashlib.sha256(SCRIPT.encode()).digest()).decode()
PAGE = ("<!doctype html>\n<html>\n<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"%s\">\n</head>\n<body>\n<main></main>\n"
        "<script type=\"module\">%s</script>\n</body>\n</html>\n" % (POLICY, SCRIPT))


def files_in(page):
    """The files in a page, by their paths."""
    found = re.findall(r'<script type="text/plain" class="inside-file" data-path="([^"]*)">([A-Za-z0-9+/=]*)</script>', page)
    return {html.unescape(path): base64.b64decode(text) for path, text in found}


def words_in(page):
    found = re.findall(r'<script type="application/json" id="inside-words">([^<]*)</script>', page)
    assert len(found) == 1, found
    return json.loads(found[0])


class Page(Case):
    def setUp(self):
        super().setUp()
        self.page = self.folder / "lambent.html"
        self.page.write_text(PAGE)
        self.env = {"LAMBENT_PAGE": str(self.page)}

    def make(self, *words, output="out.html"):
        done = self.good(*words, "-o", output, env=self.env)
        return (self.folder / output).read_text(), done

    def model(self, folder="m"):
        """An OBJ with a material library and a texture in a sub-folder."""
        place = self.folder / folder
        (place / "pictures").mkdir(parents=True)
        (place / "quad.obj").write_text("mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\n")
        (place / "a b.mtl").write_text("newmtl a\nKd 1 1 1\nmap_Kd pictures/x&y.png\n")
        (place / "pictures" / "x&y.png").write_bytes(write_png(1, 1, b"\xff\x40\x20\xff"))
        (place / "not-named.txt").write_text("secret")
        return place

    def test_the_page_stays_as_it_is_around_what_is_put_in(self):
        page, _ = self.make("cube.obj", "--size", "32")
        start, end = PAGE.rsplit("</body>", 1)
        self.assertTrue(page.startswith(start))
        self.assertTrue(page.endswith("</body>" + end))
        scripts = re.findall(r"<script([^>]*)>(.*?)</script>", page, re.S)
        run = [text for kind, text in scripts if "text/plain" not in kind and "application/json" not in kind]
        self.assertEqual(run, [SCRIPT])  # one executable script, whose hash is in the policy
        self.assertIn(base64.b64encode(hashlib.sha256(run[0].encode()).digest()).decode(), page)

    def test_the_model_and_all_files_that_it_reads(self):
        place = self.model()
        page, _ = self.make("m/quad.obj", "--size", "32")
        inside = files_in(page)
        self.assertEqual(set(inside), {"/quad.obj", "/a b.mtl", "/pictures/x&y.png"})
        for path, data in inside.items():
            self.assertEqual(data, (place / path[1:]).read_bytes(), path)
        self.assertEqual(words_in(page)[0], "/quad.obj")
        self.assertNotIn("secret", page)
        self.assertNotIn(str(self.folder), page)

    def test_the_same_bytes_every_time_and_from_every_place(self):
        self.model()
        first, _ = self.make("m/quad.obj", "--size", "32")
        again, _ = self.make(self.folder / "m" / "quad.obj", "--size", "32", "--threads", "2", output="again.html")
        self.assertEqual(first, again)

    def test_the_words_draw_the_same_picture(self):
        for words in (["--size", "40x30", "--light", "point:position=1/2/3", "--material", "brass", "--light",
                       "directional:direction=-1/-2/-1", "--two-sided"],
                      ["--size", "32", "--look", "technical"], ["--size", "32", "--edges", "crease", "--rotate", "y:30", "--rotate", "x:10"],
                      ["--size", "32", "--reflection-map", "studio", "--reflectivity", "0.5", "--view", "top"]):
            with self.subTest(words=words):
                page, _ = self.make("cube.obj", *words)
                inside = words_in(page)
                self.assertEqual(inside[0], "/cube.obj")
                drawn = self.good("cube.obj", *words, "-o", "-").stdout
                self.assertEqual(drawn, self.good("cube.obj", *inside[1:], "-o", "-").stdout)

    def test_options_of_the_machine_are_left_out(self):
        page, _ = self.make("cube.obj", "--size", "32", "--threads", "1", "--memory-limit", "1G", "--durable", "--quiet", "--isa", "plain")
        self.assertEqual(words_in(page), ["/cube.obj", "--size=32"])

    def test_a_shape_needs_no_file(self):
        page, _ = self.make("torus-knot", "--size", "32")
        self.assertEqual((words_in(page)[0], files_in(page)), ("torus-knot", {}))

    def test_a_formula_comes_with_its_ranges(self):
        for kind, formula, more in (("implicit", "x^2+y^2+z^2 = 1", ["--z=0..1", "--flip"]), ("parametric", "x=u; y=v; z=sin(u)", ["--v=0..pi"])):
            self.good("shape", f"--{kind}={formula}", *more, "-o", "f.html", env=self.env)
            self.assertEqual(words_in((self.folder / "f.html").read_text()), [kind, f"--{kind}={formula}", *more])

    def test_an_environment_comes_with_it(self):
        (self.folder / "elsewhere").mkdir()
        sky = write_png(4, 2, b"\x20\x40\x80\xff" * 8)
        (self.folder / "elsewhere" / "sky.png").write_bytes(sky)
        page, _ = self.make("cube.obj", "--size", "32", "--environment", "elsewhere/sky.png")
        self.assertEqual(files_in(page)["/.environment/1-sky.png"], sky)
        self.assertIn("--environment=/.environment/1-sky.png", words_in(page))
        page, _ = self.make("cube.obj", "--size", "32", "--reflection-map", "elsewhere/sky.png", "--reflectivity", "0.5")
        self.assertIn("--reflection-map=/.environment/1-sky.png", words_in(page))

    def test_names_and_words_cannot_end_their_texts(self):
        name = "a\"'<b>&.obj"
        shutil.copy(OWN_MODELS / "cube.obj", self.folder / name)
        page, _ = self.make(name, "--size", "32", "--material", "brass")
        self.assertIn("/" + name, files_in(page))
        self.assertEqual(words_in(page)[0], "/" + name)
        self.assertEqual(page.count("<b>"), 0)

    def test_a_scene_file_may_name_files_beside_it_alone(self):
        (self.folder / "deep").mkdir()
        (self.folder / "deep" / "scene.json").write_text(self.scene_text("../cube.obj"))
        self.bad(3, "deep/scene.json", "-o", "out.html", env=self.env, says=["outside the folder", "cube."])
        (self.folder / "scene.json").write_text(self.scene_text("cube.obj"))
        page, _ = self.make("scene.json", "--size", "32")
        self.assertTrue({"/scene.json", "/cube.obj"} <= set(files_in(page)))

    def test_a_link_does_not_lead_out_of_the_folder(self):
        place = self.model()
        (self.folder / "secret.txt").write_text("newmtl a\n# secret\n")
        (place / "a b.mtl").unlink()
        (place / "a b.mtl").symlink_to("../secret.txt")
        for mode in ("auto", "off"):
            self.bad(3, "m/quad.obj", "-s", "32", "-q", "--sandbox", mode, "-o", "out.html", env=self.env, says=["a b.mtl", "outside the folder"])
        (self.folder / "link.obj").symlink_to("m/quad.obj")  # the user names the model itself
        page, _ = self.make("link.obj", "-s", "32", "-q")
        self.assertIn("/link.obj", files_in(page))
        self.assertNotIn(base64.b64encode(b"# secret").decode()[:8], page)

    def scene_text(self, name):
        """A scene file as --save-scene writes it, with another path for its model."""
        self.good("cube.obj", "--size", "32", "--save-scene", "saved.json", "-o", "-")
        text = (self.folder / "saved.json").read_text()
        os.remove(self.folder / "saved.json")
        self.assertIn('"cube.obj"', text)
        return text.replace('"cube.obj"', json.dumps(name))

    def missing_page(self):
        """Without a page, the error message names the command that builds it, for a program in its build folder and for other programs."""
        place = self.folder / "a b"
        (place / "build").mkdir(parents=True)
        program = shutil.copy(PROGRAM, place / "build" / "lambent")
        for sources, command in ((False, "`make web install`"), (True, f"make -C '{place}' web")):
            if sources:
                (place / "web").mkdir()
                (place / "web" / "build.py").touch()
            for words in (["cube.obj", "-o", "out.html"], ["view", "cube.obj"]):
                done = subprocess.run([program, *words], cwd=self.folder, capture_output=True, env={**os.environ, "LAMBENT_PAGE": ""})
                self.assertEqual(done.returncode, 3)
                self.assertRegex(done.stderr.decode(), r"^lambent: (cube.obj: )?the page, lambent.html, is not (built|installed)")
                self.assertIn(command, done.stderr.decode())
        shutil.rmtree(place)

    def test_what_is_refused(self):
        self.missing_page()
        self.bad(2, "cube.obj", "-o", "out.html", env={"LAMBENT_PAGE": "/nowhere/lambent.html"}, says="/nowhere/lambent.html: cannot read")
        self.bad(2, "missing.obj", "-o", "out.html", env=self.env, says="missing.obj")
        self.bad(1, "-", "-o", "out.html", env=self.env, says="needs a model with a name", stdin=b"solid\nendsolid\n")
        self.bad(1, "cube.obj", "-o", "out.html", "--show", "all", env=self.env, says="--show all")
        self.bad(1, "cube.obj", "-o", "{view}.html", "--views", "front,top", env=self.env, says="one picture")
        self.page.write_text("no end")
        self.bad(3, "cube.obj", "-o", "out.html", env=self.env, says="not lambent.html")

    def test_a_model_that_is_too_large(self):
        with open(self.folder / "large.obj", "w") as out:
            out.write((OWN_MODELS / "cube.obj").read_text())
            out.write(("#" * 999 + "\n") * 100000)
        self.bad(4, "large.obj", "-s", "16", "-o", "out.html", env=self.env, says=["large.obj", "100 MB"])

    def test_reports(self):
        report = self.report("cube.obj", "--size", "32", "-o", "out.html", env=self.env)
        self.assertEqual(report["image"]["path"], "out.html")
        done = self.good("cube.obj", "-o", "other.html", "--dry-run", env=self.env)
        self.assertIn(b"other.html, html", done.stdout)
        self.assertFalse((self.folder / "other.html").exists())

    def test_each_model_of_a_batch(self):
        self.good("cube.obj", "cube.stl", "--size", "32", "-o", "{stem}-{ext}.html", env=self.env)
        self.assertEqual(words_in((self.folder / "cube-obj.html").read_text())[0], "/cube.obj")
        self.assertEqual(words_in((self.folder / "cube-stl.html").read_text())[0], "/cube.stl")

    def test_the_sandbox_lets_it_be_written(self):
        offered = self.good("--version").stdout.decode().splitlines()[2]
        if "seccomp" not in offered or ";" in offered:
            self.skipTest(offered)
        self.good("cube.obj", "--size", "32", "-o", "out.html", "--sandbox", "require", env=self.env)

