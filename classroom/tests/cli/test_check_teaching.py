# test_check_teaching.py: the command `check` for teachers: generated contracts, grades in the formats of learning
# platforms, weights of scenes, and a sentence if no known mistake explains a difference.
import csv
import json
import re

from harness import ROOT
from test_check import SHADERS, CheckTest

PITTSBURGH_SUM = "ambient + attenuation * (diffuse + specular)"


class Written(CheckTest):
    """--write-contract FILE writes a file that loads again and gives the same verdict, with a comment for each entry."""

    def write(self, vert, frag):
        (self.folder / "s.vert").write_text(vert)
        (self.folder / "s.frag").write_text(frag)
        return ["s.frag", "--vertex", "s.vert"]

    def again(self, words, code=0):
        first = self.report_of(*words, "--write-contract", "c.json", code=code)
        second = self.report_of(*words, "--contract", "c.json", code=code)
        for key in ("verdict", "contract", "points", "mistakes"):
            self.assertEqual(first[key], second[key])
        contract = json.loads((self.folder / "c.json").read_text())
        for kind in ("attributes", "uniforms"):
            for entry in contract.get(kind, {}).values():
                self.assertTrue(entry["comment"])
        return contract

    def test_recognised(self):
        self.assertEqual(self.again(self.shader("pittsburgh", [("frag", "dot(n, l) <= 0.0", "false")]), code=6)["name"], "pittsburgh")

    def test_inferred(self):
        vert, frag = ((SHADERS / f"learnopengl.{ending}").read_text().replace("aPos", "inVertex").replace("aNormal", "inNormal").replace("lightPos", "sunPos")
                      for ending in ("vert", "frag"))
        contract = self.again(self.write(vert, frag))
        self.assertEqual(contract["uniforms"]["sunPos"]["role"], "light_position")
        self.assertIn("space", contract["uniforms"]["sunPos"]["comment"])
        self.again(self.write(vert.replace("normalize(mat3(transpose(inverse(model))) * inNormal)", "inNormal"), frag), code=6)

    def test_fixed_state(self):
        """Names of OpenGL's fixed state are written as in GLSL, and are allowed in a contract."""
        words = self.shader("glsl120")
        self.assertEqual(self.again(words)["uniforms"]["gl_LightSource[].position"]["role"], "light_position")
        self.assertEqual(self.report_of(*words, "--contract", "glsl120")["verdict"], "passes")

    def test_without_a_verdict(self):
        """The file then states the known inputs and the unknown input."""
        frag = (SHADERS / "learnopengl.frag").read_text().replace("uniform vec3 lightPos;", "uniform vec3 lightPos;\nuniform sampler2D shadowMap;")
        words = self.write((SHADERS / "learnopengl.vert").read_text(), frag.replace("FragColor = vec4(", "FragColor = dFdx(texture(shadowMap, vec2(0.0))) * vec4("))
        self.bad(1, "check", *words, "--write-contract", "c.json", says="dFdx", leaves=("s.frag", "s.vert", "c.json"))
        contract = json.loads((self.folder / "c.json").read_text())
        self.assertEqual(contract["uniforms"]["shadowMap"]["role"], "factor")
        self.assertIn("'model'", contract["comment"][-1])
        self.assertEqual(contract["uniforms"]["lightPos"]["role"], "factor")

    def test_cannot_be_written(self):
        words = self.shader("pittsburgh")
        (self.folder / "file").write_text("")
        done = self.run_program("check", *words, "-s", "32", "--write-contract", "file/c.json")
        self.assertEqual(done.returncode, 5)
        self.assertIn(b"passes", done.stdout)
        self.bad(1, "check", "a.frag", "b.frag", "--write-contract", "c.json", says="one submission", leaves=("s.frag", "s.vert", "file"))

    def test_defaults_and_comments(self):
        """A contract without attenuation and strengths expects none; an error message contains its line."""
        lines = ['{"contract": 1, "name": "mine", "space": "world", "comment": ["for", "people"],', '"attributes": {"p": {"role": "position", "type": "vec3", "comment": "a"},',
                 '"n": {"role": "normal", "type": "vec3"}},', '"uniforms": {"M": {"role": "model", "type": "mat4"}, "VP": {"role": "view_projection", "type": "mat4"},',
                 '"lamp": {"role": "light_position", "type": "vec3"},', '"paint": {"role": "color", "type": "vec3"}}}']
        words = self.write("#version 330\nin vec3 p, n; uniform mat4 M, VP; out vec3 P, N;\nvoid main() { vec4 q = M * vec4(p, 1.0); P = q.xyz;\n"
                           "N = normalize(transpose(inverse(mat3(M))) * n); gl_Position = VP * q; }\n",
                           "#version 330\nin vec3 P, N; uniform vec3 lamp, paint; out vec4 o;\n"
                           "void main() { o = vec4(paint * max(dot(normalize(N), normalize(lamp - P)), 0.0), 1.0); }\n")
        (self.folder / "my.json").write_text("\n".join(lines))
        self.assertEqual(self.report_of(*words, "--contract", "my.json")["verdict"], "passes")
        for line, old, new, says in ((5, "light_position", "light_positon", "uniforms.lamp.role"), (3, '"vec3"}}', '"mat4"}}', "attributes.n.type"),
                                     (1, '"people"', "1", "comment[1]")):
            (self.folder / "my.json").write_text("\n".join(lines).replace(old, new))
            self.bad(2, "check", *words, "--contract", "my.json", says=f"my.json:{line}: {says}: found", leaves=("s.frag", "s.vert", "my.json"))


class Grades(CheckTest):
    GATE = [("frag", "dot(n, l) <= 0.0", "false")]

    def weighted(self, weights):
        contract = json.loads((ROOT / "classroom" / "check" / "contracts" / "pittsburgh.json").read_text())
        (self.folder / "my.json").write_text(json.dumps({**contract, "weights": weights}))
        return ("--contract", "my.json", "--scenes", "all,gate,coarse")

    def test_weights(self):
        words = self.shader("pittsburgh", self.GATE)
        self.assertEqual(self.report_of(*words, "--scenes", "all,gate,coarse", code=6)["points"]["earned"], 2)
        points = self.report_of(*words, *self.weighted({"all": 2.5, "gate": 4}), code=6)["points"]
        self.assertEqual((points["earned"], points["possible"]), (3.5, 7.5))
        for weights, says in (({"gat": 1}, "my.json:1: weights.gat: unknown key; did you mean 'gate'"), ({"gate": -1}, "weights.gate: found -1")):
            self.bad(2, "check", *words, *self.weighted(weights), says=says, leaves=("s.frag", "s.vert", "my.json"))

    def test_platforms(self):
        words = [*self.shader("pittsburgh", self.GATE), *self.weighted({"gate": 2}), "-s", 64]
        done = self.run_program("check", *words, "--gradescope", "out/results.json", "--submitty", "validation_results.json", "--moodle", "grades.csv")
        self.assertEqual(done.returncode, 6, done.stderr)
        results = json.loads((self.folder / "out" / "results.json").read_text())
        self.assertEqual([(t["name"], t["score"], t["max_score"], t["status"]) for t in results["tests"]],
                         [("all", 1, 1, "passed"), ("gate", 0, 2, "failed"), ("coarse", 1, 1, "passed")])
        self.assertIn("n.l <= 0", results["tests"][1]["output"])
        validation = json.loads((self.folder / "validation_results.json").read_text())
        self.assertEqual((validation["status"], validation["data"]["score"], validation["data"]["status"]), ("success", 0.5, "warning"))
        row = next(csv.DictReader((self.folder / "grades.csv").read_text().splitlines()))
        self.assertEqual((row["Identifier"], row["Full name"], row["Grade"], row["Maximum Grade"]), ("", "s.frag", "50.00", "100.00"))
        self.assertIn("n.l <= 0", row["Feedback comments"])

    def test_no_verdict(self):
        """A shader that cannot be judged gets no points, and the reason as its output."""
        (self.folder / "s.frag").write_text("void main() { gl_FragColor = vec4(1.0); }\n")
        done = self.run_program("check", "s.frag", "--gradescope", "r.json", "--submitty", "v.json")
        self.assertEqual(done.returncode, 1)
        results = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((results["score"], results["tests"]), (0, []))
        self.assertIn("no verdict", results["output"])
        self.assertEqual(json.loads((self.folder / "v.json").read_text())["data"]["score"], 0)

    def test_moodle(self):
        """The names of Moodle's folders contain the participants' numbers."""
        for name in ("Ann Lee_4711_assignsubmission_file_", "bob"):
            (self.folder / "class" / name).mkdir(parents=True)
            for ending in ("frag", "vert"):
                (self.folder / "class" / name / f"s.{ending}").write_text((SHADERS / f"pittsburgh.{ending}").read_text())
        (self.folder / "class" / "Eve_4712_assignsubmission_file_").mkdir()
        done = self.run_program("check", "--class", "class", "--moodle", "grades.csv", "-s", 32)
        rows = list(csv.DictReader((self.folder / "grades.csv").read_text().splitlines()))
        self.assertEqual([(r["Identifier"], r["Full name"], r["Grade"]) for r in rows], [("Participant 4711", "Ann Lee", "100.00"), ("Participant 4712", "Eve", ""), ("", "bob", "100.00")])
        self.assertIn("expected a file that ends in .frag", rows[1]["Feedback comments"])
        self.bad(1, "check", "--class", "class", "--gradescope", "r.json", says="one submission", leaves=("class", "grades.csv"))


class Sentences(CheckTest):
    """If no known mistake explains a difference, the report describes the scenes."""

    def hint(self, name, *edits):
        report = self.report_of(*self.shader(name, edits), "--contract", name, code=6)
        self.assertEqual(report["mistakes"], [])
        return " ".join(self.notes(report, "hint"))

    def test_each(self):
        for name, says, *edits in (
                ("pittsburgh", "only the ambient term differs", ("frag", "vec4 ambient = ambient_product;", "vec4 ambient = 1.4 * ambient_product;")),
                ("pittsburgh", "0.7 times as bright", ("frag", "vec4(color.rgb,", "vec4(0.7 * color.rgb,")),
                ("nyu", "correct with one light, wrong with several", ("frag", "lights[i].lightPosition - varyingPosition", "lights[i].lightPosition - (1.0 + 0.3 * float(i)) * varyingPosition")),
                ("pittsburgh", "only directional lights differ", ("vert", "light.w == 0.0 ? light.xyz :", "light.w == 0.0 ? light.xyz * vec3(1.0, 0.6, 1.0) :")),
                ("pittsburgh", "scenes differ, most of all", ("frag", PITTSBURGH_SUM, "0.8 * ambient + attenuation * (1.1 * diffuse + specular * ambient.r)"))):
            with self.subTest(says):
                self.assertIn(says, self.hint(name, *edits))


class Texts(CheckTest):
    def test_line_ends(self):
        """Old Macs end lines with only a carriage return."""
        words = self.shader("pittsburgh", [("frag", "dot(n, l) <= 0.0", "dot(n, ll) <= 0.0")])
        for ending in ("frag", "vert"):
            path = self.folder / f"s.{ending}"
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r"))
        report = self.report_of(*words, code=6)
        self.assertEqual((report["verdict"], [n["line"] for n in report["notes"] if "ll" in n["text"]][0]), ("refused", 25))

    def test_many_names(self):
        """The time for 40,000 unused uniforms does not grow with their square."""
        words = self.shader("pittsburgh", [("frag", "varying vec3 N;", "".join(f"uniform float u{i};\n" for i in range(40000)) + "varying vec3 N;")])
        # This takes half a second; comparing each name with each word would take eight minutes.
        self.assertEqual(self.report_of(*words, "--scenes", "all", timeout=240)["verdict"], "passes")

    def test_cube_map(self):
        words = self.shader("learnopengl", [("frag", "uniform vec3 viewPos;", "uniform vec3 viewPos;\nuniform samplerCube depthMap;\nuniform sampler2D paint;"),
                                            ("frag", "lightColor * objectColor, 1.0)", "lightColor * objectColor * texture(paint, FragPos.xy).rgb * texture(depthMap, l).r, 1.0)")])
        done = self.run_program("check", *words, "--contract", "learnopengl")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(re.search(r"no verdict: .*depthMap", done.stderr.decode()), done.stderr)
        self.assertNotIn("0x", done.stderr.decode())
