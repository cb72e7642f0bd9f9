# test_words.py: the command lines that a newcomer guessed for common wishes, with the outcome of each; and fifty more by a person who
# wrote them before the synonyms. "does": it does what was meant. "warns": so, with a warning that contains the text. "says": it is refused, and the message contains the right name.
# "nowhere": the message does not help. "pending": another change adds the wish.
import os
import shutil
import subprocess
import unittest

from harness import PROGRAM, SHARED_MODELS, Case, read_png

KNIGHT = SHARED_MODELS / "glb" / "kaykit_adventurers" / "Knight.glb"
HDR = SHARED_MODELS / "env" / "kloppenheim_05_1k.hdr"
ROWS = r"""
does | lambent stls/*.stl
does | lambent stls/ -o thumbs/
does | lambent --thumbnail 256 a.stl
does | lambent a.stl -s 256 -o t.png --bg white
does | lambent a.stl --background=white -o w.png
does | lambent a.stl --transparent -o w.png
does | lambent a.stl --view top -o top.png
does | lambent a.stl --top -o top.png
does | lambent a.stl --orthographic -o o.png
does | lambent a.stl --ortho -o o.png
warns the model has only one part | lambent a.stl --exploded -o o.png
does | lambent a.stl --section x=0 -o o.png
does | lambent a.stl --clip x:0 -o o.png
does | lambent a.stl --cut z -o o.png
does | lambent a.stl --turntable -o t.gif
does | lambent a.stl --turntable 12 -s 128 -o t.gif
says ffmpeg | lambent a.stl --turntable 12 -s 128 -o t.mp4
does | lambent a.stl --turntable 12 -s 128 -o t.webp
does | lambent a.stl --wireframe -s 256 -o wf.png
does | lambent a.stl --measure
does | lambent size a.stl
does | lambent info a.stl
does | lambent stats a.stl
does | lambent a.stl --count
does | lambent convert a.stl a.glb
does | lambent a.stl -o a2.glb
does | lambent a.stl -o a2.obj
does | lambent a.stl --depth -o d.png
does | lambent a.stl --show depth -o d.png
does | lambent a.stl --show depth -o d.exr
does | lambent a.stl --normals -o n.png
does | lambent a.stl --show normals -o n.png
does | lambent a.stl --mask -o m.png
does | lambent a.stl --show mask -o m.png
does | lambent a.stl --show silhouette -o m.png
does 6 | lambent diff a.stl b.stl
does | lambent compare a.stl b.stl -o c.png
does | lambent check a.stl
does | lambent validate a.stl
does | lambent info --check a.stl
does | lambent a.stl --scale-bar -o s.png
does | lambent a.stl --dimensions -o s.png
says a.stl + b.stl | lambent a.stl b.stl -o both.png
does | lambent a.stl + b.stl -o both.png
says --arrange | lambent --merge a.stl b.stl -o both.png
nowhere | lambent scene a.stl b.stl -o both.png
nowhere | lambent a.stl --logo x.png -o l.png
does | lambent a.stl --look-at 0,0,0 --eye 10,10,10 -o l.png
does | lambent a.stl --camera eye=100/100/100,target=0/0/0 -s 200 -o l.png
says --camera | lambent a.stl --intrinsics 500,500,320,240 -s 640x480 -o k.png
does | lambent a.stl --camera fx=500,fy=500,cx=320,cy=240,eye=100/100/100,target=0/0/0 -s 640x480 -o k.png
says --camera | lambent a.stl --camera-matrix k.json -o k.png
nowhere | lambent batch params.csv -o out/
does | lambent a.stl --views 24 -o 'v-{view}.png'
does | lambent a.stl --view sphere:24 -o 'v-{view}.png'
does | lambent a.stl --azimuth 0,90,180 -o 'v-{azimuth}.png'
does | lambent a.stl --sweep azimuth=0..360 --frames 4 -s 100 -o 'v-{frame}.png'
says ffmpeg | lambent Knight.glb --animation 0 -o k.mp4
does | lambent Knight.glb --animation Walking_A -s 128 -o k.webp
does | lambent Knight.glb --animate -s 128 -o k.webp
does | lambent a.stl --hdri env/kloppenheim_05_1k.hdr -o h.png
does | lambent a.stl --environment env/kloppenheim_05_1k.hdr -s 200 -o h.png
does | lambent a.stl --environment env/kloppenheim_05_1k.hdr --background environment -s 200 -o h.png
does | lambent contact-sheet stls/ -o cs.png
does | lambent compare stls/*.stl -o cs.png
does | lambent batch stls/ --sheet -o cs.png
does | cat a.stl | lambent - -s 64 > p.png; file p.png
does | cat a.stl | lambent -s 64 > p.png; file p.png
does | cat a.stl | lambent -o p.png
says lambent view | lambent a.stl --watch -o p.png
page | lambent watch a.stl
does 2 | lambent nosuch.stl
does 5 | lambent a.stl -o /nosuch/dir/p.png
does | lambent -v a.stl -s 64 -o p.png
does | lambent a.stl --width 800 --height 600
does | lambent a.stl --resolution 800x600
does | lambent a.stl 800x600
says one size is 800x600 | lambent a.stl --size 800,600 -o p.png
does | lambent render a.stl -o p.png
does | lambent a.stl p.png
does | lambent -i a.stl -o p.png
does | lambent a.stl --output p.png -s 64 --color steel
does | lambent a.stl --color=#ff0000 -s 64 -o p.png
does | lambent a.stl --color red --opacity 0.5 -s 64 -o p.png
does | lambent a.stl --antialiasing 4 -s 64 -o p.png
says 8 or 16 | lambent a.stl --samples 32 -s 64 -o p.png
does | lambent a.stl --no-shadows -s 64 -o p.png
does | lambent a.stl --grid --axes -s 64 -o p.png
says compare | lambent a.stl --title Hello -s 64 -o p.png
does | lambent a.stl --smooth -s 64 -o p.png
does | lambent a.stl --zoom-to-fit -s 64 -o p.png
says '--zoom' | lambent a.stl --margin 10 -s 64 -o p.png
does | lambent a.stl --help | head -3
does | lambent help camera | head -20
does | lambent help turntable | head -20
does | lambent help background | head -20
does | lambent --list-materials
says lambent materials | lambent a.stl --material wood -s 64 -o p.png
does | lambent a.stl --material glass -s 64 -o p.png
says point, directional or spot | lambent a.stl --light 1,1,1 -s 64 -o p.png
does | lambent a.stl --sun -s 64 -o p.png
says export the model as .stl | lambent a.dxf -o p.png
says export the model as .glb | lambent a.blend -o p.png
says '--size' | lambent a.stl --dpi 300 -o p.png
says use .png | lambent a.stl -o p.svg
says use .png | lambent a.stl -o p.tiff
says use .png | lambent a.stl -o p.pdf
does | lambent a.stl --quiet --overwrite -o p.png -s 64
does | lambent a.stl --output-dir x/
misleads | lambent s.obj --texture x.png -o p.png
says '--color' | lambent s.obj --no-texture -s 64 -o p.png
does | lambent Knight.glb --list-animations
does | lambent Knight.glb --hide Knight_Cape -s 64 -o p.png
does | lambent Knight.glb --only Knight_Body -s 64 -o p.png
"""
FIFTY = r"""
does | lambent a.stl --wire -o w.png
does | lambent a.stl --bgcolor white -o w.png
does | lambent a.stl --img-size 512 -o w.png
does | lambent a.stl --colour blue -o w.png
does | lambent a.stl --rotate-x 90 -o w.png
does | lambent a.stl --rot z:45 -o w.png
does | lambent a.stl --flat -o w.png
does | lambent a.stl --flat-shading -o w.png
does | lambent a.stl --front -o w.png
does | lambent a.stl --isometric -o w.png
does | lambent a.stl --iso -o w.png
does | lambent a.stl --zup -o w.png
does | lambent a.stl --up-axis z -o w.png
does | lambent a.stl --scale 2 -o w.png
does | lambent a.stl --shadow -o w.png
does | lambent a.stl --floor -o w.png
does | lambent a.stl --outline -o w.png
does | lambent a.stl --spin -o t.gif
says such as y:30 | lambent a.stl --rotate 360 -o t.webp
says --turntable N | lambent a.stl --frames 12 -o t.webp
does | lambent a.stl --fov 45 -o w.png
does | lambent a.stl --hq -o w.png
does | lambent a.stl --aa 8 -o w.png
does | lambent a.stl --ambient-occlusion -o w.png
does | lambent a.stl --ssao -o w.png
does | lambent a.stl --metallic 1 --roughness 0.2 -o w.png
does | lambent a.stl --material metal -o w.png
does | lambent a.stl --gold -o w.png
does | lambent a.stl -f jpg
does | lambent a.stl --format webp
gl | lambent a.stl --gpu -o w.png
does | lambent a.stl --threads 2 -o w.png
does | lambent a.stl -t 2 -o w.png
misleads | lambent a.stl > w.png
does | lambent open a.stl --help
does | lambent list a.stl
does | lambent show a.stl --help
does | lambent volume a.stl
does | lambent bbox a.stl
does | lambent a.stl --info
does | lambent a.stl --json
does | lambent help formats
does | lambent formats
does | lambent --formats
does | lambent a.stl -o w.jpeg --quality 90
does | lambent a.stl --exposure 1 -o w.png
does | lambent a.stl --light-intensity 2 -o w.png
does | lambent export a.stl a.obj
nowhere | lambent a.stl --to a.obj
does | lambent s.obj --backface-culling -o w.png
"""


def rows(text):
    return [tuple(part.strip() for part in line.split("|", 1)) for line in text.strip().splitlines()]


class Guesses(Case):
    def setUp(self):
        super().setUp()
        os.rename(self.folder / "cube.stl", self.folder / "a.stl")
        self.good("-q", "shape", "torus", "--segments", 12, "-o", "b.stl")
        self.good("-q", "shape", "sphere", "--segments", 12, "-o", "s.obj")
        (self.folder / "stls").mkdir()
        for name in ("a.stl", "b.stl"):
            shutil.copy(self.folder / name, self.folder / "stls")
        for path, to in ((KNIGHT, "Knight.glb"), (HDR, "env/" + HDR.name)):
            if path.exists():
                (self.folder / to).parent.mkdir(exist_ok=True)
                os.symlink(path, self.folder / to)
        (self.folder / "bin").mkdir()
        os.symlink(PROGRAM, self.folder / "bin" / "lambent")
        self.given = self.new_files() | self.given
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "XDG_CONFIG_HOME": str(self.folder / "no-settings")}

    def check(self, text):
        """Runs each line in a shell; returns the number of lines for each outcome."""
        counts = {}
        for outcome, line in rows(text):
            kind, _, detail = outcome.partition(" ")
            counts[kind] = counts.get(kind, 0) + 1
            if kind in ("pending", "page", "gl") or "Knight" in line and not KNIGHT.exists():
                continue
            with self.subTest(line):
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
                text = done.stdout.decode(errors="replace")
                self.assertEqual(done.returncode == int(detail if kind == "does" and detail else 0) if kind in ("does", "warns") else done.returncode != 0, kind != "misleads" or ">" not in line, text)
                self.assertIn(detail if kind in ("says", "warns") else "", text)
                if kind == "does":
                    self.assertNotIn("lambent: warning", text)
                for name in self.new_files():
                    path = self.folder / name
                    shutil.rmtree(path) if path.is_dir() else path.unlink()
        return counts

    def test_guesses(self):
        counts = self.check(ROWS)
        self.assertEqual(sum(counts.values()), 114)
        self.assertGreaterEqual(counts["does"] + counts["warns"] + counts.get("page", 0), 90)
        self.assertLessEqual(counts["nowhere"], 5)

    def test_fifty_more(self):
        counts = self.check(FIFTY)
        self.assertEqual(sum(counts.values()), 50)
        self.assertGreaterEqual(counts["does"], 35)
        self.assertLessEqual(counts["nowhere"], 5)


class Meanings(Case):
    """What a synonym does, not only that it is accepted."""

    def test_same_pictures(self):
        for words, own in (
                ("--bg white", "-b white"), ("--transparent", "-b transparent"), ("--top", "--view top"), ("--ortho", "--projection orthographic"),
                ("--depth", "--show depth"), ("--mask", "--show coverage"), ("--normals", "--show normals"), ("--unlit", "--show base-color"),
                ("--eye 3,2,1 --look-at 0,0.5,0", "--camera eye=3/2/1,target=0/0.5/0"), ("--rotate-x 30", "--rotate x:30"), ("--color steel", "--material chrome"),
                ("--color=gold", "--material gold"), ("--metallic 1 --roughness=0.2", "--material metallic=1,roughness=0.2"), ("--sun", "--light directional"),
                ("--look catalog --no-shadows", "--look catalog --ground off"), ("--outline", "--edges all"), ("--wire", "--wireframe"), ("--no-ao", "--ao off"),
                ("--overwrite", ""), ("--fit", ""), ("--hq", "--samples 16"), ("--azimuth -30 --flat", "--azimuth -30 --shading flat")):
            with self.subTest(words):
                self.assertEqual(self.png("cube.obj", "-s", 32, *words.split()), self.png("cube.obj", "-s", 32, *own.split()))
        for words, size in (("--width 8 --height 6", (8, 6)), ("--width 8", (8, 8)), ("--size 10 --height 4", (10, 4)), ("9x5", (9, 5)), ("--thumbnail 7", (7, 7))):
            self.assertEqual(self.png("cube.obj", *words.split())[:2], size, words)

    def test_own_words_come_first(self):
        """A file, a folder or a shape with the name of a synonym is not a synonym."""
        (self.folder / "stats").write_bytes((self.folder / "cube.ply").read_bytes())
        self.given.add("stats")
        self.good("stats", "-s", 8, "-o", "a.png")
        self.bad(1, "convert", "cube.stl", "a.glb", "--bg", "white", says="unknown option '--bg'", leaves={"a.png"})

    def test_format_beside_an_output(self):
        """--format agrees with the name, or is refused with the name to write, in both orders."""
        for words in (("--format", "exr", "-o", "f/"), ("-o", "f/", "--format", "exr")):
            self.bad(1, "cube.stl", "-s", 8, *words, says=["expected -o 'f/{stem}-{view}.exr'"])
        for words in (("--format", "webp", "-o", "a.webp"), ("-o", "a.webp", "--format", "webp")):
            self.good("cube.stl", "-s", 8, *words)
            self.assertEqual(self.new_files(), {"a.webp"})
            (self.folder / "a.webp").unlink()

    def test_refused_before_anything_is_drawn(self):
        for word in ("stast", "renderr", "640", "entirely-else"):
            self.bad(2, word, "cube.obj", says=word + ": cannot open")
            self.bad(2, "cube.obj", word, says=word + ": cannot open")

    def test_pipes(self):
        data = (self.folder / "cube.stl").read_bytes()
        for words in ((), ("-",)):
            self.assertEqual(read_png(self.good(*words, "-s", 8, stdin=data).stdout)[:2], (8, 8))
        self.assertFalse(self.new_files())
        self.good("-", "-s", 8, "--json", stdin=data)  # the report is on standard output
        self.assertEqual(self.new_files(), {"model.png"})
        self.good("-s", 8, "-o", "p.png", stdin=data)
        self.assertEqual(self.new_files(), {"model.png", "p.png"})

    def test_output_of_models_and_folders(self):
        self.good("cube.ply", "-o", "a.glb")
        self.good("convert", "cube.ply", "b.glb")
        self.assertEqual((self.folder / "a.glb").read_bytes(), (self.folder / "b.glb").read_bytes())
        (self.folder / "in").mkdir()
        shutil.copy(self.folder / "cube.stl", self.folder / "in")
        self.good("in", "-s", 8, "-o", "out/")
        self.assertTrue((self.folder / "out" / "cube.png").exists())
        self.good("batch", "cube.stl", "sphere", "-s", 8, "-o", "new")
        self.assertEqual({path.name for path in (self.folder / "new").iterdir()}, {"cube.png", "sphere.png", "lambent.jsonl"})
        (self.folder / "taken").write_text("kept")
        self.bad(1, "batch", "cube.stl", "sphere", "-s", 8, "-o", "taken", says="'taken' is a file, expected a folder")
        self.assertEqual((self.folder / "taken").read_text(), "kept")
        for command in ((), ("batch",), ("compare",)):
            self.bad(1, *command, "sphere", "-o", "s3://shop/{stem}.png", says="the address 's3://shop/{stem}.png', expected a file")

    @unittest.skipUnless(KNIGHT.exists(), "no models")
    def test_completion_of_names(self):
        words = lambda *given: [line.split("\t")[0] for line in self.good("complete", "--", *given).stdout.decode().splitlines()]
        os.symlink(KNIGHT, self.folder / "k.glb")
        self.assertIn("Knight_Cape", words("k.glb", "--hide", "Knight_"))
        self.assertIn("Walking_A", words("k.glb", "--animation", "Walk"))
        self.assertIn("gold@Knight_Body", words("k.glb", "--material", "gold@Kni"))
        self.assertIn("--hide=Knight_Body", words("k.glb", "--hide=Knight_B"))
        self.assertEqual(words("--hide", "Kni"), [])
        # A shell runs commands in the words that it completes, so a name that needs quotes is not offered.
        facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        (self.folder / "n.stl").write_text("".join(f"solid {name}\n{facet}endsolid\n" for name in ("good", "$(touch x)", "a;b", "-o")))
        self.assertEqual(words("n.stl", "--hide", ""), ["good"])

    def test_help_and_completion(self):
        self.assertIn(b"bgcolor", self.good("help", "background").stdout)
        self.assertEqual(self.good("help", "bgcolor").stdout, self.good("help", "background").stdout)
        self.assertIn(b"stats", self.good("help", "info").stdout)
        self.assertIn(b"transparent=transparent", self.good("generate", "man").stdout)
        self.assertEqual(self.good("complete", "--", "cube.obj", "--bgc").stdout.split(b"\t")[0], b"--bgcolor")
