# test_shader.py: the command `shader`: its outputs, its contract and its errors. tests/gl/contract.py draws with the shaders.
import json
import re

from harness import Case


def uniforms_of(contract):
    return contract["uniforms"] + [u for draw in contract["draws"] for u in draw["uniforms"]]


class Shader(Case):
    def contract(self, *words):
        return json.loads(self.good("shader", *words, "--json").stdout)

    def test_standard_output_has_everything(self):
        text = self.good("shader", "cube.obj", "--host", "c").stdout.decode()
        parts = re.findall(r"(?m)^// ===== (.*) =====$", text)
        self.assertEqual(parts, ["vertex shader", "fragment shader", "inputs", "host code"])
        self.assertEqual(text.count("#version 330 core"), 2)
        self.assertIn("Blinn (1977)", text)
        self.assertIn("model_view_projection", text)

    def test_without_a_model_the_switches_decide(self):
        text = self.good("shader", "--reflection", "phong", "--glsl", "300es").stdout.decode()
        self.assertIn("#version 300 es", text)
        self.assertEqual(self.good("shader", "--reflection", "phong", "--glsl", "300 es").stdout.decode(), text)
        self.assertIn("Phong (1975)", text)
        self.assertNotIn("Blinn", text)

    def test_lecture_style(self):
        for words in ((), ("--glsl", "120", "--reflection", "phong"), ("--glsl", "300es", "--products"), ("--shading", "gouraud"), ("--shading", "flat"),
                      ("--stage", "application")):
            with self.subTest(words):
                full, lecture = self.contract("sphere", "--lights-in", "array", *words), self.contract("sphere", "--style", "lecture", *words)
                for key in ("attributes", "uniforms", "draws", "lights_in", "flat"):
                    self.assertEqual(lecture[key], full[key])
                for stage in ("vertex", "fragment"):
                    text = re.split(r"\n(?=(?:layout|attribute|in|flat|varying|out) )", lecture[stage], maxsplit=1)[1]
                    lines = [line for line in text.splitlines() if line.strip() and not line.strip().startswith("//") and line.strip() not in "{}"]
                    self.assertLessEqual(len(lines), 42, text)
                    self.assertLess(len(lecture[stage]), len(full[stage]) + 300)

    def test_lecture_style_refuses_what_it_does_not_have(self):
        for words, option in ((("--reflection", "ggx"), "reflection"), (("--gl1", "--shading", "gouraud"), "gl1"), (("--shadows",), "shadows"), (("--exposure", "1"), "exposure"),
                              (("--tone", "aces"), "tone"), (("--back-material", "gold"), "back-material"), (("--show", "diffuse"), "show"), (("--lights-in", "texture"), "lights-in")):
            with self.subTest(words):
                self.bad(3, "shader", "sphere", "--style", "lecture", *words, says=("'--style lecture' does not have '--" + option, "'--style full'"))
        (self.folder / "red.ppm").write_bytes(b"P6\n2 1\n255\nabcdef")
        (self.folder / "a.mtl").write_text("newmtl a\nmap_Kd red.ppm\n")
        (self.folder / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
        self.bad(3, "shader", "a.obj", "--style", "lecture", says="does not have textures", leaves=("red.ppm", "a.mtl", "a.obj"))

    def test_mistakes_that_do_not_apply(self):
        self.bad(1, "shader", "--mistake", "nogate", says="did you mean 'no-gate'?")
        self.bad(1, "shader", "--mistake", "no-gate", "--style", "full", says="options '--mistake' and '--style full'")
        self.bad(3, "shader", "--mistake", "no-cone", says="mistake 'no-cone': the shader does not have what it spoils; expected a spotlight")

    def test_mistakes(self):
        """Each mistake edits the text, and says what it is."""
        for row in json.loads(self.good("shader", "--mistake", "list", "--json").stdout):
            self.assertEqual(set(row), {"mistake", "wrong", "looks", "needs"})
            self.assertIn(f"{row['mistake']}\n  Wrong: {row['wrong']}.\n  Seen: {row['looks']}\n", self.good("shader", "--mistake", "list").stdout.decode())
        right, wrong = self.contract("sphere", "--style", "lecture"), self.contract("sphere", "--mistake", "no-gate")
        self.assertIn("float S = dot(N, L) > 0.0 ? pow(max(dot(N, H), 0.0), material.shininess) : 0.0;", right["fragment"])
        self.assertIn("float S = pow(max(dot(N, H), 0.0), material.shininess);", wrong["fragment"])
        self.assertEqual({**wrong, "fragment": ""}, {**right, "fragment": ""})

    def test_files(self):
        self.good("shader", "cube.obj", "--glsl", "120", "-o", "mine", "--host", "c")
        self.assertEqual(self.new_files(), {"mine.vert", "mine.frag", "mine.c"})
        for name in ("mine.vert", "mine.frag"):
            text = (self.folder / name).read_text()
            self.assertTrue(text.startswith("#version 120\n"))
            self.assertNotRegex(text, r"\bflat (in|out)\b|layout|\buniform \w+ \{")
        self.assertIn("uniform Light lights[", (self.folder / "mine.frag").read_text())
        host = (self.folder / "mine.c").read_text()
        self.assertRegex(host, r'glUniform4fv\(glGetUniformLocation\(program, "lights\[0\]\.direction"\), 1, \w+\);')
        (self.folder / "folder").mkdir()
        self.good("shader", "cube.obj", "-o", "folder/")
        self.assertTrue((self.folder / "folder" / "cube.frag").exists())
        self.assertEqual(self.good("shader", "cube.obj", "-q", "-o", "again.frag").stdout, b"")
        self.assertTrue((self.folder / "again.vert").exists())

    def test_host_code_says_which_pictures_it_leaves_out(self):
        (self.folder / "red.ppm").write_bytes(b"P6\n2 1\n255\nabcdef")
        (self.folder / "a.mtl").write_text("newmtl a\nmap_Kd red.ppm\nnewmtl b\n")
        (self.folder / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3/1 2/1 1/1\n")
        host = self.good("shader", "a.obj", "--host", "c").stdout.decode().split("// ===== host code =====")[1]
        self.assertIn("// LEFT OUT: the pictures of textures", host)
        self.assertRegex(host, r"// LEFT OUT: diffuse_map is the picture .*red\.ppm, 2x1, sRGB colours, to be made linear: bind it with "
                               r"glActiveTexture\(GL_TEXTURE0 \+ 4\)\n    glUniform1i\(glGetUniformLocation\(program, \"diffuse_map\"\), 4\);")
        self.assertIn("// diffuse_map: this draw has no such map, and reads 1 whatever is bound to unit 4", host)
        self.assertNotIn("LEFT OUT", self.good("shader", "cube.obj", "--host", "c").stdout.decode())

    def test_every_uniform_of_the_text_is_in_the_contract_and_back(self):
        for words in (["--glsl", "120"], ["--glsl", "120", "--products"], ["--lights-in", "array", "--back-material", "gold"],
                      ["--glsl", "300es", "--products", "--lights-in", "texture"], ["--gl1", "--shading", "gouraud", "--glsl", "120"]):
            contract = self.contract("cube.obj", *words)
            text = contract["vertex"] + contract["fragment"]
            declared = set(re.findall(r"(?m)^uniform \w+ (\w+)", text))
            told = {re.split(r"[.\[]", u["name"])[0] for u in uniforms_of(contract)}
            self.assertEqual(declared, told, words)
            declared = set(re.findall(r"(?m)^(?:attribute|layout\(location = \d\) in) \w+ (\w+)", contract["vertex"]))
            self.assertEqual(declared, {a["name"] for a in contract["attributes"]}, words)
            for u in uniforms_of(contract):
                size = {"float": 1, "int": 1, "vec3": 3, "vec4": 4, "mat3": 9, "mat4": 16}.get(u["type"])
                self.assertEqual(len(u["value"]) if u["value"] is not None else None, size, u["name"])

    def test_blocks_have_the_layout_of_std140(self):
        contract = self.contract("cube.obj", "--light", "point", "--light", "hemisphere")
        offsets = {u["name"]: u["offset"] for u in uniforms_of(contract) if u["block"]}
        self.assertEqual(offsets["ambient_light"], 0)
        self.assertEqual(offsets["lights[0].position"], 16)
        self.assertEqual(offsets["lights[0].specular"], 16 + 5 * 16)
        self.assertEqual(offsets["hemispheres[0].up"], 16 + 6 * 16)
        self.assertEqual(offsets["material.shininess"], 80)
        self.assertEqual(offsets["material.fibre"], 84)

    def test_values_are_the_scene_s(self):
        lights = ["--light", "point:position=1/2/3,frame=camera,color=0.5/0.25/0.125,attenuation=1/0.5/0.25"]
        values = {u["name"]: u["value"] for u in uniforms_of(self.contract("cube.obj", "--glsl", "120", *lights, "--shininess", "7"))}
        self.assertEqual(values["lights[0].position"], [1, 2, 3, 1])
        self.assertEqual(values["lights[0].attenuation"], [1, 0.5, 0.25, 0])
        self.assertEqual(values["lights[0].diffuse"], [0.5, 0.25, 0.125, 1])
        self.assertEqual(values["material.shininess"], [7])
        products = {u["name"]: u["value"] for u in
                    uniforms_of(self.contract("cube.obj", "--glsl", "120", "--products", *lights))}
        for i in range(3):
            self.assertAlmostEqual(products["diffuse_product[0]"][i], values["material.diffuse"][i] * values["lights[0].diffuse"][i], 6)

    def test_hundreds_of_lights(self):
        lights = [w for i in range(300) for w in ("--light", "point:position=%d/1/1" % i)]
        contract = self.contract("cube.obj", "--lights-in", "texture", "--products", *lights)
        self.assertIn("i < 300", contract["fragment"])
        self.assertEqual({entry["name"]: entry["texels"] for entry in contract["lists"]}["light_list"], 1200)
        self.assertIn("uniform Light lights[300];", self.contract("cube.obj", "--glsl", "120", *lights)["fragment"])

    def test_what_is_refused(self):
        self.bad(1, "shader", "cube.obj", "--glsl", "110", says="330, 120 or 300es")
        self.bad(1, "shader", "cube.obj", "--glsl", "120", "--lights-in", "block", says="GLSL 120 has no uniform blocks")
        self.bad(1, "shader", "cube.obj", "--glsl", "120", "--lights-in", "texture", says="texelFetch")
        self.bad(1, "shader", "cube.obj", "--shading", "phong", "--stage", "vertex", says="fragment")
        self.bad(1, "shader", "cube.obj", "--object", "5", says="object is 5")
        self.bad(3, "shader", "cube.obj", "--show", "depth", says="depth")
        (self.folder / "lines.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
        self.bad(3, "shader", "lines.obj", says="has only lines and points", leaves=["lines.obj"])
        self.bad(3, "shader", "lines.obj", "--object", "0", says="object 0 has only lines and points", leaves=["lines.obj"])
        (self.folder / "lines.obj").unlink()
        self.bad(1, "shader", "cube.obj", "cube.stl", says="unexpected argument")
        self.bad(2, "shader", "nothing.obj", says="nothing.obj")
        self.bad(5, "shader", "cube.obj", "-o", "no/such/name", says="no/such")
