# test_check.py: the command `check`: correct shaders pass, each known mistake is identified, and shaders that do not compile,
# never end or write NaN are reported. The file has more than 600 lines because it contains one test for each option and each
# kind of submission, with the programs that they share.
import base64
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from harness import ROOT, Case, PROGRAM, check_value, long, read_png, write_png

sys.path.insert(0, str(ROOT / "classroom" / "tests" / "check"))
from correct import SHADERS as CORRECT  # noqa: E402
from demands import demanding  # noqa: E402
from lectures import LECTURES  # noqa: E402
from mistakes import MISTAKES  # noqa: E402
import renamed  # noqa: E402

SHADERS = ROOT / "classroom" / "tests" / "check"
EVERY = int(os.environ.get("LAMBENT_CHECK_EVERY", "1"))  # only every n-th mistake and correct style; make test-long checks all
SCHEMA = json.loads((ROOT / "docs" / "check.schema.json").read_text())
# A search draws thousands of pictures with the same code; with sanitizers, the tests without a search cover
# all of this code.
searches = unittest.skipIf("LAMBENT_SANITIZED" in os.environ, "a long search: builds without sanitizers run it")


def gl_missing():
    devices = json.loads(subprocess.run([PROGRAM, "devices", "--json"], stdout=subprocess.PIPE).stdout)
    if any(device["reason"] is None for device in devices["gl"]):
        return None
    return "no OpenGL here: " + (devices["gl_reason"] or "; ".join(d["reason"] for d in devices["gl"]) or "no device")


def edited(name, edits=()):
    """The edited texts of a shader of classroom/tests/check, by ending."""
    texts = {}
    for ending in ("frag", "vert"):
        path = SHADERS / f"{name}.{ending}"
        if path.exists():
            texts[ending] = path.read_text()
    for ending, old, new in edits:
        assert texts[ending].count(old) == 1, f"{name}.{ending}: {old}"
        texts[ending] = texts[ending].replace(old, new)
    return texts


class CheckTest(Case):
    MISSING = gl_missing()

    def setUp(self):
        super().setUp()
        if self.MISSING:
            self.skipTest(self.MISSING)

    def shader(self, name, edits=()):
        """Writes an edited shader of classroom/tests/check as s.frag and s.vert; returns the arguments that check it."""
        for ending, text in edited(name, edits).items():
            (self.folder / f"s.{ending}").write_text(text)
        return ["s.frag", *(["--vertex", "s.vert"] if (SHADERS / f"{name}.vert").exists() else [])]

    def run_program(self, *words, **more):
        return super().run_program(*words, **{"timeout": None, **more})  # even on a slow machine

    def report_of(self, *words, code=0, size=64, **more):
        done = self.run_program("check", *words, "-s", size, "--json", **more)
        self.assertEqual(done.returncode, code, done.stderr.decode() + done.stdout.decode())
        report = json.loads(done.stdout)
        check_value(self, report, SCHEMA, "check")
        return report

    def notes(self, report, kind):
        return [note["text"] for note in report["notes"] if note["kind"] == kind]


class Right(CheckTest):
    def test_each_contract(self):
        for name, contract, lit in (("pittsburgh", "pittsburgh", "fragment"), ("pittsburgh-vertex", "pittsburgh", "vertex"),
                                    ("oregon", "oregon", "fragment"), ("nyu", "nyu", "fragment"),
                                    ("nyu-direction", "nyu", "fragment"), ("lambent", "lambent", "fragment"),
                                    ("pittsburgh-blocks", "pittsburgh", "fragment"), ("pittsburgh-helpers", "pittsburgh", "fragment"),
                                    ("learnopengl", "learnopengl", "fragment"), ("learnopengl-materials", "learnopengl", "fragment"),
                                    ("learnopengl-spot", "learnopengl", "fragment"), ("learnopengl-lights", "learnopengl", "fragment"),
                                    ("angel", "angel", "fragment"), ("angel-vertex", "angel", "vertex"), ("mdn", "mdn", "vertex"),
                                    ("threejs", "threejs", "fragment"), ("threejs-raw", "threejs", "fragment"),
                                    ("learnopengl-pbr", "learnopengl-pbr", "fragment"), ("gltf", "gltf", "fragment"),
                                    ("threejs-pbr", "threejs", "fragment"), ("webglfundamentals", "webglfundamentals", "fragment"),
                                    ("feup", "feup", "fragment"), ("stthomas", "stthomas", "fragment"), ("learnopengl-pbr-maps", "learnopengl-pbr", "fragment"),
                                    ("gltf-maps", "gltf", "fragment"), ("threejs-pbr-maps", "threejs", "fragment")):
            with self.subTest(name):
                report = self.report_of(*self.shader(name), size=128)
                self.assertEqual((report["verdict"], report["contract"], report["lit_in"]), ("passes", contract, lit))
                # Only the raw material of three.js has no name for a highlight, and one frame comes from
                # derivatives.
                self.assertEqual((report["mistakes"], len(report["notes"])), ([], int(name in ("threejs-raw", "learnopengl-pbr-maps", "pittsburgh-helpers"))))
                # The reference comes from the CPU device, and the pictures agree far within the
                # tolerance. Only at the edge of a cone, single pixels may be on its other side.
                self.assertLess(max(scene["maximum"] for scene in report["scenes"] if "spot" not in scene["name"]), 1e-3)
                self.assertLess(max(scene["share_over"] for scene in report["scenes"]), 1e-3)
                self.assertGreater(min(scene["pixels"] for scene in report["scenes"]), 1000)

    def test_every_correct_style(self):
        """The shaders of classroom/tests/check/correct.py, each of which is correct in a different way."""
        self.assertGreaterEqual(len(CORRECT), 60)
        groups = {}  # shaders with the same options are checked together
        for number, (name, options, texts) in list(enumerate(CORRECT))[::EVERY]:
            for ending, text in texts.items():
                (self.folder / f"{number:03}.{ending}").write_text(text, newline="")
                groups.setdefault(tuple(options), []).append(f"{number:03}.{ending}")
        for options, files in groups.items():
            done = self.run_program("check", *files, *options, "-s", 64, "--json")
            for report in map(json.loads, done.stdout.splitlines()):
                with self.subTest(CORRECT[int(report["fragment"][:3])][0]):
                    check_value(self, report, SCHEMA, "check")
                    self.assertEqual((report.get("verdict"), report["mistakes"], self.notes(report, "unknown")), ("passes", [], []), report)
            self.assertEqual(done.stdout.count(b"\n"), sum(file.endswith("frag") for file in files), done.stderr)

    def test_toon_and_gooch(self):
        """Own programs with these lobes pass a contract that names the lobe, whatever the word of a printed shader; a wrong one differs."""
        matt, shiny = "max(dot(n, l), 0.0);", "pow(max(dot(n, h), 0.0), shininess);"
        gate, warm = "    if (dot(n, l) <= 0.0)\n        specular = vec4(0.0);\n", "0.5 + 0.5 * dot(n, l)"
        lobes = {"toon": ((matt, "ceil(3.0 * max(dot(n, l), 0.0)) / 3.0;"), (shiny, "step(0.5, %s);" % shiny[:-1])),
                 "gooch": ((matt, "mix(0.2, 0.6, %s);" % warm), (shiny, "vec4(vec2(%s), 0.5 - 0.5 * dot(n, l), 1.0);" % warm), (gate, ""))}
        contract, right = json.loads(self.good("generate", "contract-pittsburgh").stdout), (SHADERS / "pittsburgh.frag").read_text()
        words = ("own.frag", "--vertex", str(SHADERS / "pittsburgh.vert"), "--contract", "own.json")
        for lobe, edits in lobes.items():
            (self.folder / "own.json").write_text(json.dumps({**contract, "name": "own", "highlight": lobe}))
            text = right
            for old, new in edits:
                self.assertEqual(text.count(old), 1)
                text = text.replace(old, new)
            (self.folder / "own.frag").write_text(text)
            report = self.report_of(*words)
            self.assertEqual((report["verdict"], len(report["notes"])), ("passes", int(lobe == "gooch")), lobe)  # Gooch ignores the shininess
            (self.folder / "own.frag").write_text(text.replace("3.0", "4.0").replace("0.6", "0.8"))
            report = self.report_of(*words, code=6)
            self.assertIn("does not search for mistakes", " ".join(self.notes(report, "hint")))
            self.good("shader", "--reflection", lobe, "--style", "lecture", "-q", "-o", "p")
            self.assertEqual(self.report_of("p.frag", "--vertex", "p.vert")["verdict"], "passes")
            self.given |= {"own.json", "own.frag", "p.frag", "p.vert"}

    def test_printed_shaders(self):
        """Shaders printed by `lambent shader` pass: their loops show which lights they use."""
        light = {"point": "point:attenuation=1/0.1/0.02", "plain": "point:position=1/2/3", "sun": "directional",
                 "spot": "spot:cutoff=30", "cones": "spot:inner=10,outer=20", "exponent": "spot:exponent=9", "sky": "hemisphere"}
        for words, lights in (
                ("", ""), ("--glsl 120 --products", ""), ("--glsl 300es --lights-in array", "plain"), ("--products", "point plain sun spot"),
                ("--glsl 120", "cones"), ("--color-mode raw --one-sided", "exponent sky"), ("--shading gouraud --back-material gold", "spot"),
                ("--shading flat --glsl 300es", "sun"), ("--shading flat --stage fragment", "point"), ("--reflection phong", "point sun"),
                ("--reflection lambert --exposure 1", "sun"), ("--glsl 120", "point " * 90), ("--products", "sun " * 90), ("--show diffuse --reflection none", "")):
            with self.subTest(words + " " + lights):
                self.good("shader", *words.split(), *[w for name in lights.split() for w in ("--light", light[name])], "-q", "-o", "p")
                report = self.report_of("p.frag", "--vertex", "p.vert")
                self.assertEqual((report["verdict"], report["contract"], report["notes"]), ("passes", "lambent", []))
                self.assertIn("spot" if lights == "spot" else "directional" if lights in ("sun", "sun " * 90) else "near",
                              [scene["name"] for scene in report["scenes"]])

    def test_printed_reflection_models(self):
        """Printed shaders of `lambent shader` pass with every reflection model: unchanged, with products, and in two other forms."""
        text = " ".join(self.good("--help").stdout.decode().split())
        models = re.search(r"The reflection model: ([a-z, -]*) or auto\.", text)[1].split(", ")
        self.assertGreaterEqual(len(models), 8)
        every = EVERY == 1
        forms = ("--glsl 120", "--glsl 300es --tone none", "--stage vertex", "--shading flat --color-mode raw", "--single-scattering --tone agx",
                 "--viewer infinite --tone reinhard", "--gl1", "--gl1 --products", "--glsl 120 --products --tone aces", "--shading gouraud --one-sided")
        files, printed = [], {}
        for i, model in enumerate(models):
            for words in ("", "--products", *(forms[(2 * i + k) % len(forms)] for k in range(2))) if every else (forms[i % len(forms)],):
                name = f"p{len(printed):03}"
                self.good("shader", "--reflection", model, *words.split(), "-q", "-o", name)
                printed[name + ".frag"] = f"{model} {words}"
                files += [name + ".frag", name + ".vert"]
        done = self.run_program("check", *files, "-s", 48, "--json")
        reports = {r["fragment"]: r for r in map(json.loads, done.stdout.splitlines())}
        self.assertEqual(set(reports), set(printed), done.stderr)
        for file, words in printed.items():
            with self.subTest(words):
                check_value(self, reports[file], SCHEMA, "check")
                self.assertEqual((reports[file].get("verdict"), reports[file].get("contract"), reports[file].get("notes")), ("passes", "lambent", []), reports[file])
                self.assertGreaterEqual(len(reports[file]["scenes"]), 2)

    @long
    def test_printed_model_with_a_mistake(self):
        """For a reflection model without known mistakes, the verdict is right and states this; for GGX, mistakes are found."""
        for model, old, new, ids in (("oren-nayar", "b.diffuse * ", "0.5 * b.diffuse * ", None), ("ggx --single-scattering", "b.diffuse = b.diffuse * (1.0 - (", "b.diffuse = b.diffuse * (1.0 - 0.0 * (", ["diffuse-not-reduced"])):
            with self.subTest(model):
                self.good("shader", "--reflection", *model.split(), "-q", "-o", "p")
                text = (self.folder / "p.frag").read_text()
                self.assertEqual(text.count(old), 1, text)
                (self.folder / "p.frag").write_text(text.replace(old, new))
                report = self.report_of("p.frag", "--vertex", "p.vert", code=6)
                self.assertEqual((report["verdict"], [m["id"] for m in report["mistakes"]]), ("differs", ids or []), report)
                self.assertEqual("lambent does not search for mistakes" in " ".join(self.notes(report, "hint")), not ids)

    def test_printed_shaders_with_a_mistake(self):
        self.good("shader", "--light", "directional", "--light", "point:attenuation=1/0.1/0.02", "-q", "-o", "p")
        text = (self.folder / "p.frag").read_text()
        self.assertEqual(text.count("b.n_dot_l > 0.0"), 1)
        (self.folder / "p.frag").write_text(text.replace("both(b.n_dot_l > 0.0, present(s.v))", "present(s.v)"))
        report = self.report_of("p.frag", "--vertex", "p.vert", code=6)
        self.assertEqual([m["id"] for m in report["mistakes"]], ["no-gate"])

    def test_printed_shaders_that_cannot_be_checked(self):
        for words, says in ((["--lights-in", "texture"], "--lights-in array or block"), (["--stage", "application"], "no lighting to check"),
                            (["--glsl", "120", "--shading", "flat"], "--glsl 330")):
            self.good("shader", *words, "-q", "-o", "p")
            self.bad(3, "check", "p.frag", "--vertex", "p.vert", says=says, leaves=("p.vert", "p.frag"))

    def test_printed_maps(self):
        """The shader of a glTF file with every map passes; in each scene, its maps contain other numbers."""
        pictures = ["data:image/png;base64," + base64.b64encode(write_png(2, 2, bytes(range(i, i + 16)))).decode() for i in range(4)]
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        data = b"".join(struct.pack("<3f", *p) for p in corners) + struct.pack("<9f", *[0, 0, 1] * 3) + \
            b"".join(struct.pack("<2f", *p[:2]) for p in corners)
        views = [(0, 36, "VEC3"), (36, 36, "VEC3"), (72, 24, "VEC2")]
        file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{
                    "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}, "roughnessFactor": 0.8},
                    "normalTexture": {"index": 2}, "occlusionTexture": {"index": 1}, "emissiveTexture": {"index": 3}, "emissiveFactor": [1, 0.5, 0.25]}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "material": 0}]}],
                "textures": [{"source": i} for i in range(4)], "images": [{"uri": picture} for picture in pictures],
                "accessors": [{"bufferView": i, "componentType": 5126, "count": 3, "type": kind, **({"min": [0, 0, 0], "max": [1, 1, 0]} if i == 0 else {})}
                              for i, (_, _, kind) in enumerate(views)],
                "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size, _ in views],
                "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
        (self.folder / "maps.gltf").write_text(json.dumps(file))
        printed = ["shader", "maps.gltf", "--single-scattering", "--rig", "headlight", "--tone", "none", "-q", "-o", "m"]
        words = ["m.frag", "--vertex", "m.vert"]
        for more in (["--shading", "gouraud"], ["--glsl", "120"], ["--glsl", "300es"]):
            self.good(*printed, *more)
            self.assertEqual(self.report_of(*words)["verdict"], "passes", more)
        file["materials"][0]["alphaMode"] = "MASK"
        (self.folder / "maps.gltf").write_text(json.dumps(file))
        self.good(*printed)
        self.assertIn("alpha_cutoff", (self.folder / "m.frag").read_text())
        report = self.report_of(*words)
        self.assertEqual((report["verdict"], report["contract"], report["mistakes"], report["notes"]), ("passes", "lambent", [], []), report)
        self.assertLessEqual({"bumps", "bumps aside", "mirrored", "glow"}, {scene["name"] for scene in report["scenes"]})
        text = (self.folder / "m.frag").read_text()
        self.assertEqual(text.count("metallic_texel.b"), 1)
        (self.folder / "m.frag").write_text(text.replace("metallic_texel.b", "metallic_texel.r"))
        told = self.report_of(*words, code=6)["mistakes"]
        self.assertEqual([m["id"] for m in told], ["metallic-from-red"])

    def test_alone(self):
        """For a fragment shader alone, Lambent generates a correct vertex shader in the same version of GLSL."""
        for name in ("pittsburgh", "oregon", "nyu", "lambent", "learnopengl", "learnopengl-lights", "angel", "threejs", "threejs-raw"):
            with self.subTest(name):
                self.shader(name)
                self.assertEqual(self.report_of("s.frag")["verdict"], "passes")

    def test_versions(self):
        """The same shaders without a version line, in 120, 330 core, 330 compatibility and 300 es."""
        modern = {"attribute ": "in ", "gl_FragColor": "pixel"}
        for first, out in (("", False), ("#version 120\n", False), ("#version 330 compatibility\n", False),
                           ("#version 330 core\n", True), ("#version 300 es\nprecision highp float;\n", True)):
            with self.subTest(first):
                words = self.shader("nyu")
                for ending in ("vert", "frag"):
                    text = (SHADERS / f"nyu.{ending}").read_text().replace("#version 120\n", "")
                    if out:
                        text = text.replace("varying ", "out " if ending == "vert" else "in ")
                        for old, new in modern.items():
                            text = text.replace(old, new)
                        if ending == "frag":
                            text = "out vec4 pixel;\n" + text
                    (self.folder / f"s.{ending}").write_text(first + text)
                self.assertEqual(self.report_of(*words)["verdict"], "passes")

    def test_options(self):
        words = self.shader("pittsburgh", [("vert", "vec4 light = model_view * light_position", "vec4 light = light_position")])
        self.assertEqual(self.report_of(*words, "--light-frame", "camera")["verdict"], "passes")
        words = self.shader("pittsburgh", [("frag", "dot(n, h)", "dot(reflect(-l, n), v)")])
        self.assertEqual(self.report_of(*words, "--highlight", "phong")["verdict"], "passes")
        report = self.report_of(*words, "--scenes", "diffuse,ambient")
        self.assertEqual([scene["name"] for scene in report["scenes"]], ["ambient", "diffuse"])
        self.assertEqual(report["verdict"], "passes")
        self.assertEqual(self.report_of(*words, "--tolerance", 255)["verdict"], "passes")

    def test_terms(self):
        """A term without a declared name is not expected, unless --terms requests it."""
        lines = (SHADERS / "pittsburgh.frag").read_text().splitlines(keepends=True)
        text = "".join(line for line in lines if "specular_product;" not in line and "specular = vec4(0.0)" not in line and "dot(n, l) <=" not in line)
        text = text.replace("specular_product * pow(max(dot(n, h), 0.0), shininess)", "vec4(0.0)")
        words = self.shader("pittsburgh")
        (self.folder / "s.frag").write_text(text)
        report = self.report_of(*words)
        self.assertEqual(report["verdict"], "passes")
        self.assertIn("no name of these terms: specular; --terms all", " ".join(self.notes(report, "hint")))
        self.assertTrue(all("does not use it" in n["text"] for n in self.report_of(*words, "--terms", "ambient,diffuse")["notes"]))
        report = self.report_of(*words, "--terms", "all", code=6)
        self.assertEqual([m["id"] for m in report["mistakes"]], ["no-specular"])
        self.bad(1, "check", "s.frag", "--terms", "ambient,difuse", says="did you mean 'diffuse'", leaves=("s.frag", "s.vert"))

    def test_low_precision(self):
        """With mediump, which llvmpipe computes with 16 bits, the pictures agree as closely as with highp."""
        for first in ("#version 100\nprecision mediump float;\n", "precision mediump float;\n",
                      "#ifdef GL_ES\nprecision lowp float;\n#endif\nvarying mediump vec3 unused;\n"):
            words = self.shader("pittsburgh")
            for ending in ("vert", "frag"):
                text = (SHADERS / f"pittsburgh.{ending}").read_text().replace("#version 120\n", "" if ending == "vert" else first)
                (self.folder / f"s.{ending}").write_text(("#version 100\n" if "#version" in first and ending == "vert" else "") + text)
            report = self.report_of(*words, size=128)
            self.assertEqual((report["verdict"], report["notes"]), ("passes", []))
            self.assertLess(max(scene["maximum"] for scene in report["scenes"]), 1e-3)
        (self.folder / "s.frag").write_text("precision mediump float;\nuniform vec4 ambient_product;\nvoid main() { lowp x = 1; }\n")
        report = self.report_of(*words, code=6)
        self.assertEqual([note["line"] for note in report["notes"] if note["kind"] == "compiler"][:1], [3])

    def test_byte_order_mark(self):
        words = self.shader("pittsburgh")
        for ending in ("vert", "frag"):
            path = self.folder / f"s.{ending}"
            path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
        self.assertEqual(self.report_of(*words)["verdict"], "passes")

    def test_styles(self):
        """A normal turned towards the eye by faceforward() is not a mistake, and does not hide one."""
        turned = ("frag", "vec3 v = normalize(V);", "vec3 v = normalize(V);\n    n = faceforward(n, -v, n);")
        report = self.report_of(*self.shader("pittsburgh", [turned]))
        self.assertEqual((report["verdict"], report["mistakes"]), ("passes", []))
        self.assertIn("faceforward", " ".join(self.notes(report, "hint")))
        report = self.report_of(*self.shader("pittsburgh", [turned, ("frag", "dot(n, l) <= 0.0", "false")]), code=6)
        self.assertEqual([m["id"] for m in report["mistakes"]], ["no-gate"])

    def test_sheet_and_text(self):
        words = self.shader("oregon", [("frag", "dot(n, l) > 0.0 ?", "true ?")])
        done = self.run_program("check", *words, "-s", 48, "-o", "sheet.png", "--no-captions")
        self.assertEqual(done.returncode, 6, done.stderr)
        for part in ("contract oregon", "no-gate", "write  float s = dot(N, L) > 0.0 ? pow(max(dot(R, V), 0.0), uShininess)"):
            self.assertIn(part, done.stdout.decode())
        width, height, _ = read_png((self.folder / "sheet.png").read_bytes())
        self.assertGreater(width, 3 * 48)
        self.assertGreater(height, 9 * 48)
        lists = self.good("check", "--list").stdout.decode()
        for part in ("contract pittsburgh", "uLightX", "lights[].lightPosition", "no-gate", "coarse"):
            self.assertIn(part, lists)


class Mistakes(CheckTest):
    """One method for each row of classroom/tests/check/mistakes.py, generated below. The rows are checked together, like the submissions of a class."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if cls.MISSING:
            return
        folder = pathlib.Path(tempfile.mkdtemp(prefix="lambent-cli-"))
        cls.addClassCleanup(shutil.rmtree, folder, True)
        calls = collections.defaultdict(list)  # pictures are cached by contract, so the shaders of a contract stay together
        for number, (name, ids, edits) in list(enumerate(MISTAKES))[::EVERY]:
            options = demanding(PROGRAM, name, ids.split(), folder)
            for ending, text in edited(name, edits).items():
                (folder / f"{number:03}.{ending}").write_text(text)
                calls[name == "pittsburgh", options].append(f"{number:03}.{ending}")

        def check(call):
            (_, options), files = call
            return subprocess.run([PROGRAM, "check", *files, *options, "-s", "64", "--json"], cwd=folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE)

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            done = list(pool.map(check, calls.items()))
        cls.said = b"".join(d.stderr for d in done).decode()
        cls.reports = {r["fragment"]: r for d in done for r in map(json.loads, d.stdout.splitlines())}

    def tell(self, number, expected):
        report = self.reports.get(f"{number:03}.frag")
        self.assertTrue(report, self.said)
        check_value(self, report, SCHEMA, "check")
        reported = report["mistakes"]
        self.assertEqual(sorted(m["id"] for m in reported), sorted(expected.split()), json.dumps(report))
        for mistake in reported:
            self.assertEqual(mistake["certain"], 1)
            self.assertTrue(mistake["says"] and mistake["write"])
            self.assertNotIn("{", mistake["write"].replace("{ ", ""))


for number, row in list(enumerate(MISTAKES))[::EVERY]:
    def method(self, number=number, expected=row[1]):
        self.tell(number, expected)
    setattr(Mistakes, "test_%03d_%s_%s" % (number, row[0], row[1].replace(" ", "_and_")), method)


# A list of scenes that contains the requirements of each mistake of `lambent shader --mistake`. The Phong model
# needs its own highlight.
LAMP = "point:attenuation=0.4/0.3/0.2"
LAMP_AND_SUN = ("--light", LAMP, "--light", "directional:direction=-1/-1/-1")
SCENES = (("--light", LAMP), ("--light", LAMP, "--reflection", "phong"), ("--light", "directional:direction=-1/-1/-1"),
          ("--light", "spot:position=0/3/1,target=0/0/0,cutoff=24,exponent=4"), LAMP_AND_SUN)


class LectureStyle(CheckTest):
    def test_correct(self):
        """Shaders in the lecture style pass with any lights and with lighting in either stage."""
        flat, gouraud = ("--shading", "flat"), ("--shading", "gouraud")
        for number, words in enumerate((*SCENES, (*SCENES[0], *gouraud), (*SCENES[3], *flat), (*SCENES[1], *gouraud, "--products"),
                                        ("--reflection", "lambert"), ("--viewer", "infinite"), ("--reflection", "kajiya-kay", *LAMP_AND_SUN),
                                        ("--reflection", "kajiya-kay-lecture", *gouraud))):
            with self.subTest(words):
                self.good("shader", "sphere", *words, "--style", "lecture", "-o", "s", "-q")
                phong = ("--highlight", "phong") if "phong" in words else ()
                report = self.report_of("s.frag", "--vertex", "s.vert", *phong)
                self.assertEqual((report["verdict"], report["contract"]), ("passes", "lambent"))

    def test_mistakes(self):
        """Each mistake that `lambent shader` offers changes the pictures, and is named."""
        table = json.loads(self.good("shader", "--mistake", "list", "--json").stdout)
        self.assertGreater(len(table), 40)
        used, expected = {}, {}
        for number, row in list(enumerate(table))[::EVERY]:
            self.assertTrue(row["wrong"] and row["looks"].endswith("."), row)
            for scene in SCENES:
                done = self.run_program("shader", "sphere", *scene, "--mistake", row["mistake"], "-o", f"{number:03}", "-q")
                if done.returncode == 0:
                    break
                self.assertIn(f"mistake '{row['mistake']}': the shader lacks the code that this mistake changes; expected {row['needs']}", done.stderr.decode())
            self.assertEqual(done.returncode, 0, row)
            used.setdefault("phong" in scene, []).append(f"{number:03}")
            expected[f"{number:03}.frag"] = row["mistake"]
        for phong, names in used.items():
            files = [f"{name}.{ending}" for name in names for ending in ("frag", "vert")]
            done = self.run_program("check", *files, *(("--highlight", "phong") if phong else ()), "-s", "64", "--json")
            for report in map(json.loads, done.stdout.splitlines()):
                with self.subTest(expected[report["fragment"]]):
                    self.assertEqual(report["verdict"], "differs")
                    reported = [(m["id"], m["certain"]) for m in report["mistakes"]]
                    also = [(m["also"] or "").split() for m in report["mistakes"]]
                    right = expected.pop(report["fragment"])
                    self.assertTrue(reported == [(right, 1)] or right in sum(also, []), (reported, also))
        self.assertFalse(expected, "not checked")


class Refused(CheckTest):
    def test_names_of_rewritten_texts_mean_nothing_on_the_desktop(self):
        """`fixed_NormalMatrix` replaces gl_NormalMatrix only in texts rewritten for OpenGL ES."""
        words = self.shader("lambent", [("vert", "uniform mat3 normal_matrix", "uniform mat3 fixed_NormalMatrix"), ("vert", "normal_matrix * ", "fixed_NormalMatrix * ")])
        self.bad(1, "check", *words, says="no verdict", leaves=("s.frag", "s.vert"))

    def hints_of(self, name, edits, *hints):
        report = self.report_of(*self.shader(name, edits), code=6)
        self.assertEqual(report["verdict"], "refused")
        self.assertTrue(self.notes(report, "compiler"))
        found = " | ".join(self.notes(report, "hint"))
        for hint in hints:
            self.assertIn(hint, found)
        return report

    def test_spelling(self):
        self.hints_of("pittsburgh", [("vert", "void main()", "main()")], "void main()")
        self.hints_of("pittsburgh", [("vert", "gl_Position", "gl_position")], "'gl_position' should be gl_Position")
        self.hints_of("oregon", [("frag", "in vec3 vNs, vLs, vEs;", "in vec3v Ns; in vec3v Ls; in vec3v Es;")], "did you mean `vec3 vNs`")
        self.hints_of("pittsburgh", [("frag", "vec3 h = normalize(l + v);", "vec3 half = normalize(l + v); vec3 h = half;")], "reserved word")
        self.hints_of("pittsburgh-vertex", [("vert", "max(dot(n, l), 0.0)", "max(dot(n, l), 0)")], "0.0")
        self.hints_of("pittsburgh", [("frag", "vec3 n = normalize(N);", "vec3 n = normalize(N)")], "';'")
        report = self.hints_of("pittsburgh", [("frag", "vec3 v = normalize(V);", "vec3 v = normalize(eye_point - P);\nuniform vec3 eye_position;")])
        line = [note["line"] for note in report["notes"] if note["kind"] == "compiler"][0]
        self.assertEqual((SHADERS / "pittsburgh.frag").read_text().splitlines()[line - 1].strip(), "vec3 v = normalize(V);")

    def test_undeclared(self):
        self.hints_of("oregon", [("frag", "    float s =", "    diffuse = uColor;\n    float s =")], "'diffuse' is not declared")
        self.hints_of("nyu", [("frag", "float attenuation =", "float weakened =")], "'attenuation' is not declared")

    def test_global_from_uniform(self):
        """GLSL ES allows only constants as initial values of globals."""
        for ending, old, new in (("vert", "varying ", "out "), ("frag", "varying ", "in ")):
            text = (SHADERS / f"nyu.{ending}").read_text().replace("#version 120\n", "").replace("attribute ", "in ").replace(old, new)
            text = text.replace("gl_FragColor", "pixel").replace("void main()", "vec3 tint = uColor;\nvoid main()" if ending == "frag" else "void main()")
            (self.folder / f"s.{ending}").write_text("#version 300 es\nprecision highp float;\n" + ("out vec4 pixel;\n" if ending == "frag" else "") + text)
        report = self.report_of("s.frag", "--vertex", "s.vert", code=6)
        self.assertEqual(report["verdict"], "refused")
        self.assertIn("GLSL ES can initialise globals only with constants: assign 'tint'", " ".join(self.notes(report, "hint")))

    def test_names_of_two(self):
        self.hints_of("pittsburgh", [("frag", "uniform float shininess;", "uniform float shininess; uniform vec3 eye_point;"),
                                 ("frag", "normalize(V)", "normalize(eye_position)")], "but 'eye_point' is")
        self.hints_of("pittsburgh", [("frag", "uniform vec4 ambient_product;", "uniform mat4 ambient_product;")],
                  "write uniform vec4 ambient_product")

    def test_nearest_of_what_is_declared(self):
        """Similar names are searched only among names that are valid in the statement: by spelling, sound and role, never in another function."""
        report = self.hints_of("pittsburgh", [("frag", "vec3 v = normalize(V);", "vec3 v = normalise(V) + eye_position + light_dir;"),
                                          ("frag", "uniform float shininess;", "uniform float shininess;\nuniform vec3 eye_point;\n"
                                           "float other(float light_dir) { return light_dir; }")],
                           "no function 'normalise'; did you mean 'normalize'", "'eye_position' is not declared, but 'eye_point' is",
                           "'light_dir' is not declared: give it a type")
        self.assertNotIn("'light_dir' is not declared, but", " ".join(self.notes(report, "hint")))

    def test_young_functions(self):
        matrix = [("vert", "normalize(normal_matrix * vNormal.xyz)", "normalize(transpose(inverse(mat3(model_view))) * vNormal.xyz)")]
        report = self.hints_of("pittsburgh", matrix, "inverse() needs GLSL 140 (in WebGL 300 es), and this shader is GLSL 120: write `#version 140`")
        self.assertEqual(len(self.notes(report, "compiler")), 1)  # neither overloads nor resulting errors
        self.assertEqual(self.report_of(*self.shader("pittsburgh", matrix + [("vert", "#version 120", "#version 140"),
                                                                            ("frag", "#version 120", "#version 140")]))["verdict"], "passes")

    def test_misspelt_position(self):
        """A misspelt gl_Position does not turn varyings into attributes."""
        report = self.hints_of("pittsburgh", [("vert", "gl_Position", "gl_position")], "'gl_position' should be gl_Position")
        self.assertEqual(self.notes(report, "unknown"), [])

    def test_both_shaders(self):
        """The errors of both shaders are reported together."""
        report = self.hints_of("pittsburgh", [("vert", "void main()", "main()"), ("frag", "normalize(V)", "normalize(W)")],
                           "write `void main()`", "'W' is not declared")
        self.assertEqual({note["file"] for note in report["notes"] if note["kind"] == "compiler"}, {"s.vert", "s.frag"})
        report = self.hints_of("lambent", [("frag", "lights[i].attenuation;", "lights[i].atenuation;")], "no member 'atenuation'; did you mean 'attenuation'")

    def test_old_and_new(self):
        self.hints_of("oregon", [("vert", "#version 330 compatibility\n", ""), ("frag", "#version 330 compatibility\n", "")],
                  "#version 330 compatibility")
        self.hints_of("oregon", [("vert", "330 compatibility", "330 core")], "exists only in old GLSL")

    def test_link(self):
        self.hints_of("pittsburgh", [("vert", "varying vec3 L;", "varying vec3 LL;"), ("vert", "    L = light.w", "    LL = light.w")],
                  "writes no 'L'")
        self.hints_of("pittsburgh", [("vert", "varying vec3 L;", "varying vec4 L;"), ("vert", "L = light.w == 0.0 ? light.xyz : light.xyz - point.xyz", "L = light")],
                  "is a vec3 here and a vec4")


class Hints(CheckTest):
    def test_slips(self):
        """A missing semicolon is one sentence, and an assignment without a type is not taken for another name."""
        vert, frag = renamed.RIGHT["eye blinn"]
        for old, new, says, lines in (("l = normalize(way);\n", "l = normalize(way)\n", "is a ';' missing", 1), ("vec3 c = Ka", "c = Ka", "give it a type", 0)):
            (self.folder / "s.vert").write_text(vert)
            (self.folder / "s.frag").write_text(frag.replace(old, new))
            report = self.report_of("s.frag", "--vertex", "s.vert", code=6)
            self.assertEqual(report["verdict"], "refused")
            self.assertIn(says, " ".join(self.notes(report, "hint")))
            if lines:
                self.assertEqual(len(self.notes(report, "unknown")) + len(self.notes(report, "hint")), lines, report["notes"])


class Renamed(CheckTest):
    def test_every_name(self):
        """Right and wrong shaders in the forms of public repositories, with their inputs renamed: no right shader differs, and no name is wrong."""
        counts = collections.Counter()
        for row in list(renamed.rows())[::2 * EVERY]:
            verdict, detail = renamed.judge(PROGRAM, row, self.folder)
            counts[row[0], verdict] += 1
            self.assertNotIn(verdict, ("differs", "wrong name", "error", *(["passes"] if row[0] == "wrong" else [])), (row[:3], detail))
        self.assertGreaterEqual(counts["right", "passes"], 2 * counts["right", "no verdict"], counts)
        self.assertGreaterEqual(counts["wrong", "true name"], counts["wrong", "no verdict"], counts)

    def test_roles(self):
        """Only a clear name contradicts a role; --role states the role, and --explain-roles prints all roles."""
        vert, frag = renamed.RIGHT["world phong"]
        for name, text in (("s.vert", vert.replace("aNormal", "norm")), ("s.frag", re.sub(r"lightPos|viewPos", lambda m: {"lightPos": "viewPos", "viewPos": "lightPos"}[m[0]], frag))):
            (self.folder / name).write_text(text)
        words = ["s.frag", "--vertex", "s.vert"]
        self.bad(1, "check", *words, says=("the eye or the light", "--role"), leaves=("s.frag", "s.vert"))
        report = self.report_of(*words, "--role", "viewPos=light", "--role", "lightPos=eye", "--explain-roles")
        self.assertEqual(report["verdict"], "passes")
        self.assertIn("lightPos (uniform): eye, because it is stated", " ".join(self.notes(report, "hint")))
        self.bad(1, "check", *words, "--role", "eye", says="NAME=ROLE", leaves=("s.frag", "s.vert"))

    def test_row_vectors(self):
        """Row vectors with the names of a contract of column vectors: the right shader passes, and the advice keeps the order."""
        vert, frag = renamed.RIGHT["row vectors"]
        (self.folder / "s.frag").write_text(frag)
        for matrix, verdict, ids in (("transpose(inverse(model))", "passes", []), ("model", "differs", ["normal-by-model-view"])):
            (self.folder / "s.vert").write_text(vert.replace("transpose(inverse(model))", matrix))
            report = self.report_of("s.frag", "--vertex", "s.vert", code=6 if ids else 0)
            self.assertEqual((report["verdict"], [m["id"] for m in report["mistakes"]]), (verdict, ids))
        self.assertIn("normalize(aNormal * transpose(inverse(mat3(model))))", report["mistakes"][0]["write"])

    def verdict_of(self, vert, frag):
        (self.folder / "s.vert").write_text(vert)
        (self.folder / "s.frag").write_text(frag)
        done = self.run_program("check", "s.frag", "--vertex", "s.vert", "--json", "-s", 48)
        report = json.loads(done.stdout)
        return (report["verdict"], [m["id"] for m in report["mistakes"]]) if "verdict" in report else ("none", report["error"]["text"])

    def test_styles(self):
        """Right shaders with toon steps, rims, other lobes and tone curves pass or have no verdict."""
        counts = collections.Counter()
        for name, rest in list(renamed.STYLES.items())[::2 if EVERY > 10 else 1]:
            verdict, detail = self.verdict_of(*renamed.eye(renamed.L, "LightPosition - P", rest=rest))
            self.assertIn(verdict, ("passes", "none"), (name, detail))
            counts[verdict] += 1
        self.assertGreater(counts["passes"], counts["none"])

    def test_moved_vertices(self):
        """A shader that moves its vertices is judged without the movement: its mistakes are named, but it does not pass."""
        vert, frag = renamed.RIGHT["eye phong"]
        for head, point in (("uniform float height; in float much;", "vertexPosition + height * vertexNormal * much"), ("uniform float time;", "vertexPosition + vec3(0.0, time * time, 0.0)")):
            moved = vert.replace("void main", head + "\nvoid main").replace("vec4(vertexPosition", "vec4(" + point)
            self.assertIn("move the vertices", self.verdict_of(moved, frag)[1])
            self.assertEqual(self.verdict_of(moved.replace("NormalMatrix * vertexNormal", "vertexNormal"), frag), ("differs", ["normal-object-space"]))

    def test_integers(self):
        """Lights with a kind: a branch that was not tried is no reason to pass, but a mistake in the other branch is named."""
        vert, frag = renamed.RIGHT["world phong"]
        frag = frag.replace("uniform vec3 lightPos;", "uniform vec3 lightPos;\nuniform int kind;").replace(
            "toLight = lightPos - FragPos", "toLight = kind == 0 ? vec3(0.0) : kind == 1 ? lightPos - FragPos : vec3(0.0)")
        self.assertIn("integers are 1", self.verdict_of(vert, frag)[1])
        self.assertEqual(self.verdict_of(vert, frag.replace("viewPos - FragPos", "FragPos - viewPos")), ("differs", ["eye-backwards"]))

    def test_highlights_times_the_diffuse_terms(self):
        """The sum of all highlights, multiplied by the sum of the diffuse terms, and without a name of another course in the advice."""
        vert, frag = renamed.RIGHT["eye array of positions"]
        wrong = frag.replace("c = Ka;", "c = Ka, e = vec3(0.0), g = Kd;").replace("c += Kd * d", "e += d").replace("c += Ks", "g += Ks").replace(
            "FragColor = vec4(c, 1.0)", "FragColor = vec4(c + e * g, 1.0)")
        self.assertEqual(self.verdict_of(vert, wrong), ("differs", ["specular-times-n.l"]))
        self.assertNotIn("uKs", self.run_program("check", "s.frag", "--vertex", "s.vert").stdout.decode())

    def test_recursion(self):
        """A function that calls itself, or is only declared, gets no verdict, also if the check evaluates the texts before a driver reads them."""
        vert, frag = renamed.rename(dict(zip(("vert", "frag"), renamed.RIGHT["prototypes"])), "letters", 1).values()
        (self.folder / "s.vert").write_text(vert)
        body = "float lambert(vec3 n, vec3 l) { return max(dot(n, l), 0.0); }"
        self.assertIn(body, frag)
        for text in (frag.replace(body, body.replace("max(", "lambert(n, l) + max(")), frag.replace(body, ""),
                     frag.replace(body, "").replace("n = normalize(N)", "n = normalize(N) * float[int(lambert(N, N))](1.0)[0]"),
                     frag.replace(body, "const float k = lambert(vec3(1.0), vec3(1.0));" + body.replace("max(", "k * max("))):
            (self.folder / "s.frag").write_text(text)
            done = self.run_program("check", "s.frag", "--vertex", "s.vert", "-s", 32)
            self.assertIn(done.returncode, (1, 6), done.stdout.decode() + done.stderr.decode())
            self.assertNotIn(b"passes", done.stdout)

    def test_roles_of_an_engine(self):
        """The matrices of three.js keep their roles, also on the way to gl_Position: the eye in world space minus a point in eye space is a mistake."""
        vert = ("varying vec3 p, n;\nvoid main() { vec4 q = modelViewMatrix * vec4(position, 1.0); p = q.xyz; n = transpose(inverse(mat3(modelViewMatrix))) * normal;\n"
                "gl_Position = projectionMatrix * q; }\n")
        frag = ("varying vec3 p, n;\nuniform vec3 lampAt;\nvoid main() { vec3 N = normalize(n), L = normalize(lampAt - p), V = normalize(%s);\n"
                "float d = max(dot(N, L), 0.0); gl_FragColor = vec4(vec3(0.3 + 0.5 * d + (d > 0.0 ? 0.8 * pow(max(dot(reflect(-L, N), V), 0.0), 50.0) : 0.0)), 1.0); }\n")
        for way, verdict, ids in (("-p", "passes", []), ("cameraPosition - p", "differs", ["spaces-mixed"])):
            for name, text in (("s.vert", vert), ("s.frag", frag % way)):
                (self.folder / name).write_text(text)
            report = self.report_of("s.frag", "--vertex", "s.vert", code=6 if ids else 0)
            self.assertEqual((report["verdict"], [m["id"] for m in report["mistakes"]]), (verdict, ids))


class Unruly(CheckTest):
    def test_unknown_names(self):
        report = self.report_of(*self.shader("pittsburgh", [("frag", "uniform float shininess;", "uniform float shinines;"),
                                                            ("frag", "0.0), shininess)", "0.0), shinines)")]),
                                "--scenes", "highlight")
        self.assertIn("did you mean 'shininess'", " ".join(self.notes(report, "unknown")))  # without a contract, a name is only evidence
        self.assertEqual(self.report_of("s.frag", "--vertex", "s.vert", "--scenes", "highlight", "--contract", "pittsburgh", code=6)["verdict"], "differs")

    @long
    @searches
    def test_none_known(self):
        report = self.report_of(*self.shader("oregon", [("frag", "vec4(color, 1.0)", "vec4(color.bgr * gl_FragCoord.y / 60.0, 1.0)")]),
                                "--scenes", "all,diffuse,gate", "--contract", "oregon", code=6)
        self.assertEqual((report["verdict"], report["mistakes"]), ("differs", []))
        self.assertIn("No known mistake", self.run_program("check", "s.frag", "-s", 32, "--scenes", "all", "--contract", "oregon").stdout.decode())

    @searches
    def test_search_limit(self):
        """The search ends at its limit and reports this; if the limit is sufficient, it changes nothing."""
        words = [*self.shader("oregon", [("frag", "vec4(color, 1.0)", "vec4(color.bgr * gl_FragCoord.y / 60.0, 1.0)")]), "--contract", "oregon"]
        reported = [self.report_of(*words, "--scenes", "all", "--search-limit", n, size=48, code=6) for n in (100, 20000, 10000)]
        self.assertEqual([(r["verdict"], r["mistakes"]) for r in reported], [("differs", [])] * 3)
        self.assertEqual([r["search_stopped"] for r in reported], [1, 0, 0])
        self.assertEqual(reported[1]["tried"], reported[2]["tried"])
        self.assertTrue(1 <= reported[0]["tried"] <= 100 < reported[1]["tried"], [r["tried"] for r in reported])
        text = self.run_program("check", *words, "--scenes", "all", "-s", 48, "--search-limit", 100).stdout.decode()
        self.assertIn(f"None of {reported[0]['tried']} mistakes and sets of mistakes explains the difference; the search ended at its limit (--search-limit)", text)
        words = [*self.shader("oregon", [("frag", "dot(n, l) > 0.0 ?", "true ?")]), "--contract", "oregon"]
        for limit, ids in ((1, []), (10000, ["no-gate"])):
            self.assertEqual([m["id"] for m in self.report_of(*words, "--search-limit", limit, code=6)["mistakes"]], ids)
        report = self.report_of(*self.shader("oregon"))
        self.assertEqual((report["tried"], report["search_stopped"]), (0, 0))
        self.bad(1, "check", "s.frag", "--search-limit", "0", says="--search-limit", leaves=("s.frag", "s.vert"))

    def test_two_together(self):
        report = self.report_of(*self.shader("nyu", [("frag", "normalize(varyingNormal)", "varyingNormal"), ("frag", "* s * attenuation", "* s")]),
                                "--scenes", "all,diffuse,coarse,near", code=6)
        self.assertEqual({m["id"] for m in report["mistakes"]}, {"normal-not-unit", "specular-not-attenuated"})

    @searches
    def test_every_size(self):
        """Pictures with mistakes are drawn at every second or third pixel of large pictures; the names are the same."""
        words = self.shader("pittsburgh", [("frag", "0.0), shininess)", "0.0), 2.0 * shininess)")])
        for size in (96, 119, 121, 128):
            report = self.report_of(*words, "--scenes", "all,highlight,gate", size=size, code=6)
            self.assertEqual([m["id"] for m in report["mistakes"]], ["shininess-multiplied"], size)
            self.assertLess(report["mistakes"][0]["mean_after"], 1e-3)

    def test_not_numbers(self):
        report = self.report_of(*self.shader("oregon", [("frag", "max(dot(r, e), 0.0)", "dot(r, e)"), ("frag", "dot(n, l) > 0.0 ?", "true ?")]),
                                "--scenes", "gate,diffuse", code=6)
        self.assertEqual(report["verdict"], "not a number")
        self.assertGreater(sum(scene["not_numbers"] for scene in report["scenes"]), 0)
        self.assertTrue(any("NaN" in text for text in self.notes(report, "hint")))

    # A software driver leaves a loop after about ten thousand iterations; these iterations are slow, and there are
    # many pixels.
    LOOP = """float turn = 0.0;
    while (turn < 2.0) {
        turn = 0.5 * sin(turn + shininess) * pow(1.5 + cos(turn), 1.1);
    }
    vec3 n = 0.0001 * turn + normalize(N);"""

    def endless(self):
        return [*self.shader("pittsburgh", [("frag", "vec3 n = normalize(N);", self.LOOP)]), "-s", "512"]

    def processes(self):
        """The processes with this test's variable in their environment."""
        mark, found = b"LAMBENT_TEST=" + str(self.folder).encode(), []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and mark in (entry / "environ").read_bytes().split(b"\0"):
                    found.append((int(entry.name), (entry / "cmdline").read_bytes()))
            except OSError:  # ended, or not readable
                pass
        return found

    def wait_for(self, condition):
        while not condition():  # limited by the suite's own time limit
            time.sleep(0.05)

    def test_endless(self):
        report = self.report_of(*self.endless()[:-2], "--stop-after", 0.3, size=512, code=6, env={"LAMBENT_TEST": str(self.folder)})
        self.assertEqual((report["verdict"], report["scenes"]), ("endless", []))
        self.assertEqual(self.processes(), [])

    def test_endless_and_asker_killed(self):
        """The drawing process ends even if its parent can no longer stop it."""
        asker = subprocess.Popen([PROGRAM, "check", *self.endless(), "--stop-after", "1e5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                 env={**os.environ, "LAMBENT_TEST": str(self.folder)})
        self.wait_for(lambda: any(b"check-worker" in words for _, words in self.processes()))
        asker.kill()
        asker.wait()
        self.wait_for(lambda: not self.processes())

    def test_interrupted(self):
        asker = subprocess.Popen([PROGRAM, "check", *self.endless(), "--stop-after", "1e5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, env={**os.environ, "LAMBENT_TEST": str(self.folder)})
        self.wait_for(lambda: any(b"check-worker" in words for _, words in self.processes()))
        asker.send_signal(signal.SIGINT)
        self.assertEqual(asker.wait(), -signal.SIGINT)
        self.assertEqual(self.processes(), [])

    # Texts that took minutes when the main process read them: reading is linear now, and the limits of `check` apply to it.
    HUGE = {"calls": "#define F(a) a\nvoid main(){ " + "F(" * 440000,
            "nested": "#define F(a) a a a a a a a a\nvoid main(){ float x=0.0; " + "F(" * 14 + "x+=1.0;" + ")" * 14 + " }",
            "defines": "".join(f"#define Z{i}\n" for i in range(80000)),
            "nots": "#if " + "!" * 900000 + "1\n#endif\n",
            "conditions": "".join(f"#define A{i} (A{i + 1} + A{i + 1})\n" for i in range(60)) + "#if A0\n#endif\n",
            "arrays": "uniform float " + ",".join(["a[n]"] * 200000) + ";\n",
            "members": "struct S {" + "float m;" * 120 + "}; uniform S " + ",".join(["s"] * 300000) + ";\n"}

    def test_huge_texts(self):
        """A class with such submissions is checked as far as possible, and a signal ends the check at any time."""
        for name, text in self.HUGE.items():
            (self.folder / "class" / name).mkdir(parents=True)
            (self.folder / "class" / name / "s.frag").write_text(edited("oregon-no-gate")["frag"].replace("void main", text + "void main", 1))
        self.shader("pittsburgh")
        (self.folder / "class" / "zoe").mkdir()
        for ending in ("frag", "vert"):
            shutil.copy(self.folder / f"s.{ending}", self.folder / "class" / "zoe")
        started = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = self.run_program("check", "--class", "class", "-s", 32, "--scenes", "all", "--stop-after", 1, "--json", "--memory-limit", "300M")
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        reports = {report["submission"]: report for report in map(json.loads, done.stdout.splitlines())}
        self.assertEqual(sorted(reports), sorted([*self.HUGE, "zoe"]))
        self.assertEqual(reports["zoe"].get("verdict"), "passes", done.stderr)
        for name in ("arrays", "members"):
            self.assertRegex(reports[name]["error"], "too long to check|exceeded its time limit")
        if "LAMBENT_SANITIZED" not in os.environ:
            self.assertLess(used.ru_utime - started.ru_utime, 5 * len(reports))
        asker = subprocess.Popen([PROGRAM, "check", "--class", "class", "-s", "512", "--stop-after", "1e5"], cwd=self.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.2)
        asker.send_signal(signal.SIGTERM)
        self.assertEqual(asker.wait(10), -signal.SIGTERM)

    @long
    def test_endless_and_left(self):
        """Mesa 22 leaves such a loop after some iterations, and its processor time reveals it; Mesa 25 continues until the limit stops it."""
        report = self.report_of(*self.shader("pittsburgh", [("frag", "vec3 n = normalize(N);", self.LOOP)]), "--scenes", "all",
                                "--stop-after", 20, code=6)
        self.assertEqual(report["verdict"], "endless")
        if report["scenes"]:  # the driver left the loop, and the scene is complete
            self.assertIn("an endless loop", " ".join(self.notes(report, "hint")))

    def test_draws_nothing(self):
        report = self.report_of(*self.shader("pittsburgh", [("frag", "gl_FragColor =", "discard; gl_FragColor =")]), code=6)
        self.assertEqual((report["verdict"], report["mistakes"]), ("differs", []))
        self.assertIn("100 % of the model is not drawn", " ".join(self.notes(report, "hint")))
        report = self.report_of(*self.shader("nyu", [("frag", "gl_FragColor =", "vec4 color =")]), code=6)
        self.assertIn("the shader writes no colour", " ".join(self.notes(report, "hint")))
        self.assertEqual(report["mistakes"], [])

    def test_outputs(self):
        """Shaders of the core profile that do not use the normal, or do not write a vec4."""
        text = "#version 330 core\nuniform vec4 ambient_product;\nin vec3 fN;\nout %s o;\nvoid main() { o = %s(ambient_product); }\n"
        for kind, said in (("vec4", None), ("ivec4", "a picture consists of floats"), ("vec3", "leaves channels undefined")):
            (self.folder / "s.frag").write_text(text % (kind, kind))
            report = self.report_of("s.frag", "--scenes", "ambient", code=6 if kind == "ivec4" else 0)
            if said:
                self.assertIn(said, " ".join(self.notes(report, "hint")))
            else:
                self.assertEqual(report["verdict"], "passes")
                self.assertEqual(len(report["notes"]), 1, report["notes"])  # no name for a diffuse or specular term
                self.assertIn("no name of these terms: diffuse, specular", report["notes"][0]["text"])

    def test_unused_and_unset(self):
        """An unknown name on which nothing depends does no harm; an unknown name with the value 0 is reported before any mistake."""
        unused = ("frag", "uniform float shininess;", "uniform float shininess;\nuniform vec3 of_no_use;")
        self.assertEqual([(n["kind"], n["text"]) for n in self.report_of(*self.shader("pittsburgh", [unused]), "--scenes", "all")["notes"]],
                         [("hint", "the shader declares the uniform 'of_no_use', but does not use it")])
        words = self.shader("pittsburgh", [("vert", "uniform mat3 normal_matrix;", "uniform mat3 turn;"),
                                           ("vert", "normal_matrix * vNormal", "turn * vNormal")])
        self.assertEqual(self.report_of(*words)["contract"], "inferred")  # its use determines its role
        self.bad(1, "check", *words, "--contract", "pittsburgh", says=("an input has no value", "'turn'"), leaves=("s.frag", "s.vert"))

    def test_driver_sleeps(self):
        """A driver that waits forever uses no processor time, so the limit on elapsed time stops it."""
        self.driver("#include <unistd.h>\n#define STAND for (;;) pause()\n")
        report = self.report_of(*self.shader("oregon"), "--stop-after", 0.1, code=6, env={"LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual(report["verdict"], "endless")

    def driver(self, start):
        """A replacement for the driver, in which each function executes STAND."""
        source = self.folder / "egl.c"
        source.write_text(start + "void *eglGetProcAddress(const char *n) { (void)n; STAND; }\n" + "".join(
            f"void *egl{name}(void) {{ STAND; }}\n" for name in
            ("BindAPI", "ChooseConfig", "CreateContext", "CreatePbufferSurface", "DestroyContext", "DestroySurface", "GetCurrentContext",
             "GetCurrentDisplay", "GetCurrentSurface", "GetDisplay", "GetError", "Initialize", "MakeCurrent", "QueryAPI", "QueryString")))
        if subprocess.run(["cc", "-shared", "-fPIC", "-o", self.folder / "libEGL.so.1", source]).returncode:
            self.skipTest("no C compiler")

    def test_driver_dies(self):
        self.driver("#include <stdlib.h>\n#define STAND abort()\n")
        report = self.report_of(*self.shader("oregon"), code=6, env={"LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual(report["verdict"], "crashes")

    def test_bad_use(self):
        self.shader("oregon")
        self.bad(1, "check", says="no shader", leaves=("s.frag", "s.vert"))
        self.bad(2, "check", "none.frag", says="none.frag", leaves=("s.frag", "s.vert"))
        self.bad(1, "check", "s.frag", "--scenes", "gat", says=("'gat'", "'gate'"), leaves=("s.frag", "s.vert"))
        self.bad(1, "check", "s.frag", "--scenes", "spot", says="spot", leaves=("s.frag", "s.vert"))
        self.bad(1, "check", "s.frag", "-s", "64x32", says="square", leaves=("s.frag", "s.vert"))
        (self.folder / "s.frag").write_text("void main() { gl_FragColor = vec4(1.0); }\n")
        self.bad(1, "check", "s.frag", says=("no verdict", "--contract"), leaves=("s.frag", "s.vert"))
        # A shader of unknown names that does not compile: its error, not the names.
        for text, line in (("#version 330\nin vec3 foo;\nout vec4 col;\nvoid main() { col = vec4(foo, 1.0) }\n", 4), ("void main() { gl_FragColor = strange; }\n", 1)):
            (self.folder / "s.frag").write_text(text)
            said = self.run_program("check", "s.frag")
            self.assertEqual(said.returncode, 6)
            self.assertIn(f"s.frag:{line}: error", said.stdout.decode())


class Contracts(CheckTest):
    """A contract is a file: built-in contracts, and a teacher's own contract."""

    def own(self, old_names):
        """Oregon's contract with other names, as my.json, and its correct shaders with the same names."""
        words = self.shader("oregon")
        text = (ROOT / "classroom" / "check" / "contracts" / "oregon.json").read_text()
        for path, name in ((self.folder / "s.frag", "s.frag"), (self.folder / "s.vert", "s.vert")):
            shader = path.read_text()
            for old, new in old_names.items():
                shader = shader.replace(old, new)
            path.write_text(shader)
        for old, new in {**old_names, '"oregon"': '"mine"'}.items():
            text = text.replace(old, new)
        (self.folder / "my.json").write_text(text)
        return words

    def test_own_file(self):
        words = self.own({"uKa": "shareAmbient", "uKd": "shareDiffuse", "uKs": "shareSpecular", "uColor": "paint", "uLight": "lamp",
                          "uSpecularColor": "gloss", "uShininess": "power"})
        report = self.report_of(*words, "--contract", "my.json")
        self.assertEqual((report["verdict"], report["contract"], report["notes"]), ("passes", "mine", []))
        text = (self.folder / "s.frag").read_text()
        self.assertEqual(text.count("dot(n, l) > 0.0 ?"), 1)
        (self.folder / "s.frag").write_text(text.replace("dot(n, l) > 0.0 ?", "true ?"))
        report = self.report_of(*words, "--contract", "my.json", code=6)
        self.assertEqual([m["id"] for m in report["mistakes"]], ["no-gate"])
        self.assertIn("power", report["mistakes"][0]["write"])

    def test_named(self):
        words = self.shader("nyu")
        self.assertEqual(self.report_of(*words, "--contract", "nyu")["contract"], "nyu")
        self.bad(1, "check", *words, "--contract", "oregan", says=("'oregan'", "auto, lambent", "did you mean 'oregon'"), leaves=("s.frag", "s.vert"))

    def test_schema(self):
        """The schema contains the keys and roles that the reader knows, and a printed built-in contract can be read again."""
        schema = json.loads(self.good("generate", "contract-schema").stdout)
        wrong = {"contract": 1, "name": "x", "zzzzzzzzzzzzzz": 1}
        for keys, nest in ((schema["properties"], lambda file: file),
                           (schema["properties"]["undeclared"]["properties"], lambda file: {
                               "contract": 1, "name": "x", "attributes": {"p": {"role": "position", "type": "vec3"}},
                               "undeclared": {"zzzzzzzzzzzzzz": 1}})):
            (self.folder / "my.json").write_text(json.dumps(nest(wrong)))
            text = self.run_program("check", "s.frag", "--contract", "my.json").stderr.decode()
            self.assertEqual(set(re.search(r"unknown key; expected ([a-z_, ]*)", text)[1].split(", ")), set(keys), text)
        (self.folder / "my.json").write_bytes(self.good("generate", "contract-threejs").stdout)
        words = self.shader("threejs")
        self.assertEqual(self.report_of(*words, "--contract", "my.json", "--scenes", "all")["verdict"], "passes")
        self.bad(1, "generate", "contract-nobodys", says="the name of a built-in contract", leaves=("my.json", "s.frag", "s.vert"))

    def write(self, vert, frag):
        (self.folder / "s.vert").write_text(vert)
        (self.folder / "s.frag").write_text(frag)
        return ["s.frag", "--vertex", "s.vert"]

    def test_unknown(self):
        """For names of no contract, the use of the inputs determines their roles. Without evidence, Lambent prints a sentence instead of a
        verdict."""
        vert, frag = ((SHADERS / f"learnopengl.{ending}").read_text() for ending in ("vert", "frag"))
        for old, new in (("aPos", "inVertex"), ("aNormal", "inNormal"), ("uniform mat4 model;", "uniform mat4 M;"), ("(model", "(M")):
            vert = vert.replace(old, new)
        frag = frag.replace("lightPos", "sunPos").replace("viewPos", "camera")
        report = self.report_of(*self.write(vert, frag))
        self.assertEqual((report["verdict"], report["contract"]), ("passes", "inferred"))
        wrong = vert.replace("normalize(mat3(transpose(inverse(M))) * inNormal)", "inNormal")
        self.assertNotEqual(wrong, vert)
        report = self.report_of(*self.write(wrong, frag), code=6)
        self.assertEqual([(m["id"], m["certain"]) for m in report["mistakes"]], [("normal-object-space", 1)])
        black = "void main() { gl_FragColor = vec4(0, 0, 0, 1); }"
        for texts, options, says in (((vert, frag), ("--contract", "learnopengl"), ("an input has no value", "'M'", "'sunPos'")),
                                     (("void main() { gl_Position = gl_Vertex; }", black), (), ("no verdict",))):
            self.bad(1, "check", *self.write(*texts), *options, leaves=("s.frag", "s.vert"), says=says)
        for contract in ("oregon", "learnopengl", "pittsburgh"):  # a black picture passes nowhere
            done = self.run_program("check", *self.write(vert, black), "--contract", contract)
            self.assertNotEqual(done.returncode, 0, contract)
        # A slip of the pen counts as a mistake of the shader.
        text = (SHADERS / "learnopengl.frag").read_text().replace("viewPos", "viewPosn")
        report = self.report_of(*self.write((SHADERS / "learnopengl.vert").read_text(), text), "--contract", "learnopengl", code=6)
        self.assertIn("'viewPosn' is not in the contract learnopengl; did you mean 'viewPos'", " ".join(self.notes(report, "unknown")))

    def test_inferred(self):
        """Shaders without a contract: fixed state, numeric lights, accepted forms, two mistakes, and unrecognised inputs."""
        fixed = ("varying vec3 N, L;\nvoid main() {\n    N = normalize(gl_NormalMatrix * gl_Normal);\n    L = gl_LightSource[0].position.xyz - vec3(gl_ModelViewMatrix * gl_Vertex);\n"
                 "    gl_Position = ftransform();\n}\n",
                 "varying vec3 N, L;\nvoid main() {\n    float d = max(dot(normalize(N), normalize(L)), 0.0);\n"
                 "    gl_FragColor = gl_FrontMaterial.ambient * gl_LightModel.ambient + gl_FrontMaterial.diffuse * gl_LightSource[0].diffuse * d;\n}\n")
        report = self.report_of(*self.write(*fixed))
        self.assertEqual((report["verdict"], report["contract"]), ("passes", "inferred"))
        eye = ("#version 330\nin vec3 inPosition, inNormal; uniform mat4 MV, P; out vec3 n, p;\n"
               "void main() { n = inverse(transpose(mat3(MV))) * inNormal; vec4 e = MV * vec4(inPosition, 1.0); p = e.xyz; gl_Position = P * e; }\n",
               "#version 330\nin vec3 n, p; uniform vec3 paint; out vec4 o; const vec3 lightDir = vec3(0.3, 0.4, 0.86);\n"
               "void main() { vec3 N = normalize(n); float d = max(dot(N, lightDir), 0.0), s = pow(max(dot(reflect(-lightDir, N), normalize(-p)), 0.0), 20.0);\n"
               "o = vec4(paint * (0.2 + 0.6 * d) + vec3(0.3 * s), 1.0); }\n")
        report = self.report_of(*self.write(*eye))
        self.assertEqual(report["verdict"], "passes")
        self.assertIn("exponent of the highlight is 20", " ".join(self.notes(report, "hint")))
        for old, new, expected in (("vec3 N = normalize(n)", "vec3 N = n", ["normal-never-unit"]), ("max(dot(N, lightDir), 0.0), s", "dot(N, lightDir), s", ["no-clamp"])):
            report = self.report_of(*self.write(eye[0], eye[1].replace(old, new)), code=6)
            self.assertEqual([m["id"] for m in report["mistakes"]], expected)
        toon = eye[1].replace("0.6 * d", "(d > 0.5 ? 0.6 : 0.1)")
        report = self.report_of(*self.write(eye[0], toon))
        self.assertIn("no sum of an ambient, a diffuse and a specular term", " ".join(self.notes(report, "hint")))
        staged = eye[1].replace("in vec3 n, p;", "in vec3 n, p, fromGeometry;").replace("paint * (", "fromGeometry * (")
        self.bad(1, "check", *self.write(eye[0], staged), says=("'fromGeometry'", "another stage"), leaves=("s.frag", "s.vert"))

    def test_varyings_of_no_contract(self):
        (self.folder / "s.frag").write_text((SHADERS / "mdn.frag").read_text())
        self.bad(1, "check", "s.frag", says=("vLighting", "--vertex"), leaves=("s.frag",))

    def test_numbers_for_names(self):
        """Numbers in an exercise's text may be replaced by other numbers, and a highlight may have the colour of the surface or of the light."""
        words = self.shader("learnopengl", [("frag", "ambientStrength = 0.1", "ambientStrength = 0.3"), ("frag", "specularStrength = 0.5", "specularStrength = 0.8"),
                                            ("frag", ", 32.0)", ", 64.0)")])
        self.assertEqual(self.report_of(*words)["verdict"], "passes")
        words = self.shader("learnopengl", [("frag", "(ambientStrength + diffuse + specularStrength * specular) * lightColor * objectColor",
                                             "(ambientStrength + diffuse) * lightColor * objectColor + specularStrength * specular * lightColor")])
        self.assertEqual(self.report_of(*words)["verdict"], "passes")
        words = self.shader("mdn", [("vert", "vec3(0.3, 0.3, 0.3)", "vec3(0.1, 0.2, 0.3)"), ("vert", "vec3(0.85, 0.8, 0.75)", "vec3(-0.5, 1.0, 0.2)"),
                                    ("vert", "vec3(1.0, 1.0, 1.0)", "vec3(0.5)")])
        self.assertEqual(self.report_of(*words)["verdict"], "passes")

    @searches
    def test_numbers_without_names(self):
        """If the text does not show the meaning of its numbers, the shader is evaluated; a mistake is still found."""
        edits = [("frag", "    float ambientStrength = 0.1;\n", ""), ("frag", "    float specularStrength = 0.5;\n", ""),
                 ("frag", "(ambientStrength + diffuse + specularStrength * specular)", "(0.25 + diffuse + 0.7 * specular)")]
        report = self.report_of(*self.shader("learnopengl", edits))
        self.assertEqual(report["verdict"], "passes")
        words = self.shader("learnopengl", edits + [("frag", "diffuse > 0.0 ?", "true ?")])
        self.assertIn("highlight remains on surfaces that face away", " ".join(self.notes(self.report_of(*words), "hint")))
        report = self.report_of(*words, *demanding(PROGRAM, "learnopengl", ["no-gate"], self.folder), code=6)
        self.assertEqual([m["id"] for m in report["mistakes"]], ["no-gate"])
        # Numbers that fit better than the numbers of the exercise explain nothing.
        for old, new, expected in [("reflect(-l, n)", "reflect(l, n)", ["reflect-sign"]), ("vec3 v = normalize(viewPos - FragPos)", "vec3 v = viewPos - FragPos", ["half-of-raw-eye"]),
                                   ("max(dot(n, l), 0.0)", "pow(max(dot(n, l), 0.0), 2.0)", ["n.l-squared"])][::EVERY]:
            for names in (*([edits] if "2.0" not in new else []), [("frag", "    float ambientStrength = 0.1;\n    float specularStrength = 0.5;", "    float ambientStrength = 0.1, specularStrength = 0.5;")]):
                report = self.report_of(*self.shader("learnopengl", [*names, ("frag", old, new)]), code=6)
                found = [{m["id"], *(m["also"] or "").split()} for m in report["mistakes"]]
                if names is not edits:
                    self.assertEqual(len(found), 1, old)
                self.assertTrue(all(set(expected) & one for one in found), (old, found))
        report = self.report_of(*self.shader("mdn", [
            ("vert", "vec3 ambientLight = vec3(0.3, 0.3, 0.3)", "vec3 a = vec3(0.2)"), ("vert", "vec3 directionalLightColor = vec3(1.0, 1.0, 1.0)", "vec3 b = vec3(0.8, 0.7, 0.6)"),
            ("vert", "vec3 directionalVector = normalize(vec3(0.85, 0.8, 0.75))", "vec3 c = normalize(vec3(0.2, 1.0, 0.5))"),
            ("vert", "ambientLight + directionalLightColor * max(dot(normal, directionalVector)", "a + b * max(dot(normal, c)")]))
        self.assertEqual(report["verdict"], "passes")

    def test_scenes_once(self):
        """Scenes that a shader cannot distinguish are drawn once."""
        names = [scene["name"] for scene in self.report_of(*self.shader("learnopengl"))["scenes"]]
        self.assertIn("all", names)
        self.assertNotIn("diffuse", names)
        self.assertIn("diffuse", [scene["name"] for scene in self.report_of(*self.shader("learnopengl-materials"))["scenes"]])

    def test_engine(self):
        """three.js declares names for a ShaderMaterial: messages use the line numbers of the original text, and nothing is declared twice."""
        report = self.report_of(*self.shader("threejs", [("vert", "* normal)", "* nromal)"), ("frag", "vec3 h = normalize(l + v);", "vec3 h = normalize(l + w);")]), code=6)
        self.assertEqual(report["verdict"], "refused")
        lines = {note["file"]: note["line"] for note in report["notes"] if note["kind"] == "compiler"}
        for ending, part in (("vert", "* normal)"), ("frag", "vec3 h =")):
            text = (SHADERS / f"threejs.{ending}").read_text().splitlines()
            self.assertEqual(lines[f"s.{ending}"], next(i for i, line in enumerate(text, 1) if part in line))
        self.assertIn("'nromal' is not declared, but 'normal' is", " ".join(self.notes(report, "hint")))
        report = self.report_of(*self.shader("threejs", [("frag", "uniform vec3 lightPosition;", "#include <common>\nuniform vec3 lightPosition;")]), code=6)
        self.assertIn("GLSL has no #include", " ".join(self.notes(report, "hint")))
        words = self.shader("threejs-raw", [("vert", "uniform mat3 normalMatrix;", "")])
        self.assertEqual(self.report_of(*words, code=6)["verdict"], "refused")

    def test_lectures(self):
        """The findings in the courses' own programs (docs/check/contracts.md)."""
        files = [f"{name}.{ending}" for name, *_ in LECTURES[::EVERY] for ending in ("vert", "frag")]
        for file in files:
            shutil.copy(SHADERS / "lectures" / file, self.folder)
        for name, contract, _, verdict, expected in LECTURES[::EVERY]:
            with self.subTest(name):
                report = self.report_of(f"{name}.frag", "--vertex", f"{name}.vert", "--contract", contract, code=0 if verdict == "passes" else 6)
                self.assertEqual((report["verdict"], report["contract"]), (verdict, contract))
                hints = " | ".join(self.notes(report, "hint"))
                for part in expected if verdict == "refused" else ():
                    self.assertIn(part, hints)
                if verdict != "refused":
                    self.assertEqual(sorted(m["id"] for m in report["mistakes"]), sorted(expected))

    def test_wrong_file(self):
        words = self.shader("nyu")
        self.bad(2, "check", *words, "--contract", "none.json", says="none.json", leaves=("s.frag", "s.vert"))
        (self.folder / "my.json").write_text('{"contract": 1, "name": "mine", "uniforms": {"x": {"role": "ligth_position"}}}')
        self.bad(2, "check", *words, "--contract", "my.json", leaves=("s.frag", "s.vert", "my.json"),
                 says=("my.json:1: uniforms.x.role: found \"ligth_position\"", "did you mean 'light_position'"))


class Several(CheckTest):
    """Several shaders in one call: files are paired by name, and a shader that cannot be checked does not stop the others."""

    def write(self, name, shader, edits=()):
        for ending, text in edited(shader, edits).items():
            path = self.folder / f"{name}.{ending}"
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)

    def test_class(self):
        gate = [("frag", "dot(n, l) <= 0.0", "false")]
        self.write("ann/phong", "pittsburgh")
        self.write("bob/phong", "pittsburgh", gate)
        self.write("cem/phong", "pittsburgh", gate)
        (self.folder / "dee").mkdir()
        (self.folder / "dee" / "phong.frag").write_text("void main() { gl_FragColor = vec4(1.0); }\n")
        names = [f"{name}/phong" for name in ("ann", "bob", "cem", "dee")]
        files = [n + ".frag" for n in names] + [n + ".vert" for n in names[:3]] + ["eve/phong.frag"]
        words = ("check", *files, "-s", "32", "--scenes", "gate,all")
        done = self.run_program(*words, "--json", "-o", "sheets/", "--no-captions")
        self.assertEqual(done.returncode, 6, done.stderr)
        reports = [json.loads(line) for line in done.stdout.splitlines()]
        for report in reports:
            check_value(self, report, SCHEMA, "check")
        self.assertEqual([r["fragment"] for r in reports], [n + ".frag" for n in names] + ["eve/phong.frag"])
        self.assertEqual([r["vertex"] for r in reports], [n + ".vert" for n in names[:3]] + [None, None])
        self.assertEqual([r.get("verdict") for r in reports], ["passes", "differs", "differs", None, None])
        self.assertEqual([m["id"] for m in reports[1]["mistakes"]], ["no-gate"])
        # The second such shader is compared with cached pictures, with identical results.
        self.assertEqual(reports[1]["mistakes"], reports[2]["mistakes"])
        self.assertEqual([r["exit_code"] for r in reports[3:]], [1, 2])
        self.assertIn("--contract", reports[3]["error"])
        self.assertIn("eve/phong.frag", reports[4]["error"])
        self.assertEqual(sorted(p.name for p in (self.folder / "sheets").iterdir()), [f"{n}-phong.png" for n in ("ann", "bob", "cem")])
        self.run_program("check", *files[:1], files[4], "-s", "32", "--scenes", "gate", "-o", "one/", "--no-captions")
        self.assertEqual([p.name for p in (self.folder / "one").iterdir()], ["ann-phong.png"])
        text = self.run_program(*words).stdout.decode()
        self.assertIn("1 of 5 pass", text)
        self.assertEqual(text.count("no-gate:"), 2)

    def test_bad_use(self):
        self.write("a", "pittsburgh")
        self.write("b", "pittsburgh")
        files = ("a.frag", "a.vert", "b.frag", "b.vert")
        self.bad(1, "check", "a.frag", "b.vert", says=("b.vert", "same name"), leaves=files)
        self.bad(1, "check", "a.frag", "b.frag", "-o", "x.png", says="folder", leaves=files)
        self.bad(1, "check", "a.frag", "-", says="single", leaves=files)


class Without(Case):
    def test_no_gl(self):
        """Without libEGL, the error message names the package to install."""
        (self.folder / "libEGL.so.1").write_text("no library")
        (self.folder / "s.frag").write_text((SHADERS / "oregon.frag").read_text())
        done = self.run_program("check", "s.frag", env={"LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("install", done.stderr.decode())
