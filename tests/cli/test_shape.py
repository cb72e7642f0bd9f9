# test_shape.py: the command `shape`: built-in shapes and formulas, as pictures and as model files.
from harness import Case, read_png

RIPPLE = "x=u*cos(v); y=u*sin(v); z=cos(3u)"


class Shape(Case):
    def test_built_in_shapes_are_those_of_render(self):
        self.good("shape", "torus", "-o", "a.png", "-s", "64")
        self.good("torus", "-o", "b.png", "-s", "64")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_model_files_show_the_same_picture(self):
        words = ["shape", "--parametric", RIPPLE, "--u", "0..4", "--segments", "40x60"]
        self.good(*words, "-o", "drawn.png", "-s", "128")
        for ending in ("obj", "ply"):
            self.good(*words, "-o", "r." + ending)
            self.good("r." + ending, "-o", "read.png", "-s", "128")
            self.assertEqual((self.folder / "drawn.png").read_bytes(), (self.folder / "read.png").read_bytes(), ending)
        self.good(*words, "-o", "r.stl")
        self.assertEqual((self.folder / "r.stl").stat().st_size, 84 + 50 * (2 * 40 * 60 - 60))  # the centre is a pole

    def test_up(self):
        words = ["shape", "--parametric", "x=u; y=2+v; z=0", "--u", "0..1", "--v", "0..1", "--segments", "3x1"]
        self.good(*words, "-o", "z.obj")
        self.good(*words, "--up", "y", "-o", "y.obj")
        self.assertEqual((self.folder / "z.obj").read_text().splitlines()[0], "v 0 0 -2")
        self.assertEqual((self.folder / "y.obj").read_text().splitlines()[0], "v 0 2 0")

    def test_default_name(self):
        self.good("shape", "--parametric", RIPPLE, "-s", "32")
        self.assertEqual(read_png((self.folder / "parametric.png").read_bytes())[:2], (32, 32))

    def test_implicit(self):
        """An expression that is zero on the surface: as a model file with the gradient's normals, as a picture, and errors for expressions without a
        surface."""
        sphere = "x^2+y^2+z^2-1"
        self.good("shape", "--implicit", sphere, "--segments", 20, "-o", "s.obj")
        lines = [line.split() for line in (self.folder / "s.obj").read_text().splitlines()]
        points, normals = ([list(map(float, words[1:])) for words in lines if words[0] == kind] for kind in ("v", "vn"))
        self.assertTrue(len(points) > 500 and len(points) == len(normals))
        for p, n in zip(points, normals):
            self.assertAlmostEqual(sum(x * x for x in p), 1, 5)
            for a, b in zip(p, n):
                self.assertAlmostEqual(a, b, 5)
        self.good("shape", "--implicit", "x^2+y^2+z^2 = 1", "-s", "32")
        self.assertEqual(read_png((self.folder / "implicit.png").read_bytes())[:2], (32, 32))
        self.good("shape", "--implicit", sphere, "--segments", 20, "--z", "0..1", "--flip", "-o", "s.obj")
        heights = [float(line.split()[2]) for line in (self.folder / "s.obj").read_text().splitlines() if line.startswith("v ")]
        self.assertEqual(min(heights), 0)  # z is up in formulas, y in OBJ
        for words, says in (([sphere + "*w"], "option '--implicit': column 15: found 'w'"), (["(x+y)^2"], "option '--implicit': no surface found in x = -16..16"),
                            (["x", "--x", "0..q"], "option '--x': column 4: found 'q'"), (["x", "--segments", "9x9"], "option '--implicit': an implicit surface needs"),
                            (["x", "--u", "0..1"], "option '--u' belongs to --parametric"), (["x", "--parametric", RIPPLE], "expected one of them")):
            self.bad(1, "shape", "--implicit", *words, says=says, leaves=self.new_files())
        self.bad(1, "shape", "--parametric", RIPPLE, "--x", "0..1", says="option '--x' belongs to --implicit", leaves=self.new_files())
        self.bad(1, "shape", "torus", "--implicit", sphere, says="one of them", leaves=self.new_files())

    def test_errors(self):
        self.bad(1, "shape", says="--parametric")
        self.bad(1, "shape", "torsu", says="torsu")
        self.bad(1, "shape", "torus", "--parametric", RIPPLE, says="one of them")
        self.bad(1, "shape", "torus", "--u", "0..1", says="belongs to --parametric")
        self.bad(1, "shape", "--parametric", "x=cos(u;y=v;z=0", says="lambent: option '--parametric': column 8: found ';'")
        self.bad(1, "shape", "--parametric", RIPPLE, "--u", "0..w", says="lambent: option '--u': column 4: found 'w'")
        self.bad(1, "shape", "torus", "-o", "t.obj", "-s", "64", says="changes nothing in a model file")
        self.bad(5, "shape", "torus", "-o", "nowhere/t.obj", says="nowhere")
        for name in ("w.gltf", "w.pgn"):
            self.bad(3, "shape", "torus", "-o", name, says=(name, ".png, .ppm", "a model file is .obj, .stl or .ply"))
        self.bad(1, "cube.obj", "--parametric", RIPPLE, says="belongs to explain, shape")
