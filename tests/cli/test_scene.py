# test_scene.py: scene files: drawn, overridden by options, written and drawn again with identical bytes, and checked against
# their schema.
import json
import re
import shutil
import signal
import struct
import subprocess

from harness import OWN_MODELS, PROGRAM, SHARED_MODELS, Case, long, pixel, read_png, write_png, wait_until_caught

SCHEMA = json.loads(subprocess.run([PROGRAM, "generate", "scene-schema"], stdout=subprocess.PIPE, check=True).stdout)
KNOWN = {"type", "enum", "examples", "const", "required", "additionalProperties", "properties", "items", "minItems", "maxItems", "minimum",
         "maximum", "exclusiveMinimum", "minLength", "pattern", "anyOf", "$ref", "$defs", "$schema", "title", "description", "default"}
KINDS = {"object": dict, "array": list, "string": str, "integer": int, "number": (int, float), "boolean": bool, "null": type(None)}


def misfit(value, schema, place="scene"):
    """The first violation of the schema (the part of JSON Schema that it uses); None means valid."""
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        return misfit(value, SCHEMA[schema["$ref"].split("/")[1]][schema["$ref"].rsplit("/", 1)[1]], place)
    if "anyOf" in schema:
        tries = [misfit(value, s, place) for s in schema["anyOf"]]
        return None if None in tries else tries[-1]
    if "const" in schema and value != schema["const"] or "enum" in schema and value not in schema["enum"]:
        return f"{place}: {value!r}"
    kinds = schema.get("type", [])
    kinds = kinds if isinstance(kinds, list) else [kinds]
    if kinds and not any(isinstance(value, KINDS[k]) and (k == "boolean") == isinstance(value, bool) for k in kinds):
        return f"{place}: {value!r} is not {kinds}"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        if not schema.get("minimum", value) <= value <= schema.get("maximum", value) or value <= schema.get("exclusiveMinimum", value - 1):
            return f"{place}: {value}"
    if isinstance(value, str) and (len(value) < schema.get("minLength", 0) or not re.search(schema.get("pattern", ""), value)):
        return f"{place}: {value!r}"
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            return f"{place}: {len(value)} items"
        return next((m for i, v in enumerate(value) if (m := misfit(v, schema["items"], f"{place}[{i}]"))), None)
    if isinstance(value, dict):
        for key in schema.get("required", ()):
            if key not in value:
                return f"{place}: no {key}"
        for key, inner in value.items():
            of = schema.get("properties", {}).get(key, schema.get("additionalProperties"))
            if of is False:
                return f"{place}.{key}: unknown"
            if m := misfit(inner, of, f"{place}.{key}"):
                return m
    return None


class Scene(Case):
    def setUp(self):
        super().setUp()
        shutil.copy(OWN_MODELS / "scene.json", self.folder)
        self.given.add("scene.json")
        self.example = json.loads((self.folder / "scene.json").read_text())

    def write(self, scene, name="scene.json"):
        (self.folder / name).write_text(scene if isinstance(scene, str) else json.dumps(scene))

    def again(self, *words):
        """Draws with --save-scene and draws the scene file; the bytes are identical."""
        (self.folder / "sub").mkdir(exist_ok=True)
        self.good(*words, "-o", "a.png", "--save-scene", "sub/saved.json")
        self.good("sub/saved.json", "-o", "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes(), words)
        saved = json.loads((self.folder / "sub" / "saved.json").read_text())
        self.assertIsNone(misfit(saved, SCHEMA))
        return saved

    def test_every_field_of_a_material(self):
        """Each key of the schema is a key of --material, and is saved, read again, and explained."""
        for key, field in SCHEMA["$defs"]["material"]["properties"].items():
            if field.get("$ref", "").startswith("#/$defs/key_"):  # a key that sets other fields: test_doors.py
                continue
            word, value = {"boolean": ("yes", True), "number": ("0.5", 0.5)}.get(field.get("type"), ("0.5/0.25/0.125", [0.5, 0.25, 0.125]))
            with self.subTest(key):
                self.good("sphere", "-s", 8, "--material", f"{key}={word}", "-o", "a.png", "--save-scene", "a.json", "-q")
                [thing] = json.loads((self.folder / "a.json").read_text())["objects"]
                opacity = key == "opacity"  # which is part of the colour
                self.assertEqual(thing["material"]["diffuse"][3] if opacity else thing["material"][key], value)
                thing["material"] = {key: value}
                (self.folder / "b.json").write_text(json.dumps({"lambent": 1, "objects": [thing]}))
                answer = json.loads(self.good("explain", "b.json", "4,4", "-s", 8, "--json").stdout)["triangles"][0]["material"]
                rows = {"ambient": 0, "diffuse": 1, "specular": 2}
                self.assertEqual(answer["matrix"][rows[key]] if key in rows else answer[key], value)

    def test_example(self):
        width, height, data = self.png("scene.json")
        self.assertEqual((width, height), (256, 192))
        self.assertGreater(sum(1 for i in range(3, len(data), 4) if data[i]), 5000)
        self.assertIsNone(misfit(self.example, SCHEMA))

    def test_options_go_before_the_file(self):
        self.assertEqual(self.png("scene.json", "-s", "64x48")[:2], (64, 48))
        plain = self.png("scene.json")
        for words in (["--color-mode", "srgb"], ["--shading", "flat"], ["--reflection", "phong"], ["-b", "white"], ["--view", "top"],
                      ["--rig", "studio"], ["--samples", "16"]):
            self.assertNotEqual(self.png("scene.json", *words), plain, words)
        self.assertEqual(self.png("scene.json", "--color-mode", "raw", "--shading", "phong", "--samples", "1"), plain)

    def test_saved_scenes_give_the_same_bytes(self):
        for words in (["scene.json"], ["cube.obj", "--rig", "headlight"], ["cube.stl", "--shading", "flat", "--zoom", "1.37"],
                      ["torus-knot", "--normals", "facet", "--color-mode", "raw", "-b", "#102030"],
                      ["cube.ply", "--projection", "orthographic", "--crease-angle", "95", "--up", "x"],
                      ["cube.obj", "--material", "gold", "--rotate", "x:20", "--rig", "lecture"],
                      ["cube.obj", "--shininess", "77", "--back-material", "jade", "--light", "point:position=2r/1r/3r,frame=object",
                       "--light-scale", "0.7", "--stage", "vertex", "--viewer", "infinite", "--cull", "front"],
                      ["cube.stl", "--reflection", "kajiya-kay", "--opacity", "0.5", "--light", "+spot:position=0/2r/0,frame=camera,cutoff=33"],
                      ["cube.obj", "--camera", "eye=3.1/2.7/5.3,fovy=33.3,near=1,far=20", "--reflection", "phong"]):
            saved = self.again(*words, "-s", "120x90")
            self.assertEqual(saved["image"]["size"], [120, 90])
        self.assertEqual(saved["objects"][0]["file"], "../cube.obj")
        # A second saved file is identical.
        self.good("sub/saved.json", "-o", "b.png", "--save-scene", "sub/twice.json")
        self.assertEqual((self.folder / "sub/saved.json").read_bytes(), (self.folder / "sub/twice.json").read_bytes())

    def test_formulas(self):
        """--save-scene of a formula's picture, and the keys of the object."""
        ripple = "x=u*cos(v); y=u*sin(v); z=cos(3u)"
        for words, want in ((["--u", "0..4", "--segments", "40x60"], {"u": "0..4", "segments": [40, 60]}), (["--v", "0..pi", "--flip", "--cull", "back"], {"v": "0..pi", "flip": True}),
                            (["--rotate", "x:20", "--normals", "facet", "--segments", "30"], {"segments": [30, 30]}),
                            (["--up", "y", "--material", "gold", "--view", "front"], {}), (["--reflection-map", "sky", "--reflectivity", "0.4"], {})):
            saved = self.again("shape", "--parametric", ripple, *words, "-s", "64")
            [thing] = saved["objects"]
            self.assertEqual(thing["shape"], {"parametric": {"formula": ripple, **want}}, words)
        # Several copies of the same surface are one mesh; another formula, range or division is
        # another mesh.
        flat = {"parametric": {"formula": "x=u; y=v; z=0", "u": "0..1", "v": "0..1", "segments": [2, 3]}}
        others = [{"parametric": {**flat["parametric"], **change}} for change in ({"u": "0..2"}, {"v": "0..2"}, {"flip": True}, {"segments": [2, 4]}, {"formula": "x=u; y=v; z=1"})]
        scene = {"lambent": 1, "objects": [{"shape": shape} for shape in (flat, flat, *others, flat)]}
        self.assertIsNone(misfit(scene, SCHEMA))
        self.write(scene, "formulas.json")
        self.given |= {"formulas.json"}
        answer = json.loads(self.good("info", "formulas.json", "--json").stdout)["counts"]
        self.assertEqual((answer["meshes"], answer["objects"], answer["triangles"]), (6, 8, 12 * 3 + 12 * 4 + 16))
        for shape, says in (({"parametric": {"formula": "x=u; y=v; z=w"}}, ("objects[0].shape", "'w'")), ({"parametric": {"u": "0..1"}}, ("objects[0].shape.parametric", "'formula' is missing")),
                            ({"parametric": "x=u"}, ("objects[0].shape", "y is missing")), ({"parametric": 1}, ("objects[0].shape.parametric", "expected a string or an object")), ({"parametrics": {}}, ("parametrics", "parametric")),
                            ({"parametric": {**flat["parametric"], "segments": [2]}}, ("segments", "two whole numbers")),
                            ({"parametric": {**flat["parametric"], "segments": [2, 20000]}}, ("segments", "two whole numbers")),
                            ({"parametric": {**flat["parametric"], "u": "0..x"}}, ("objects[0].shape", "range of u"))):
            self.write({"lambent": 1, "objects": [{"shape": shape}]}, "formulas.json")
            self.bad(2, "formulas.json", "-s", 8, says=("formulas.json", *says), leaves=self.new_files())
        self.write({"lambent": 1, "objects": [{"shape": {"parametric": {"formula": "x=u; y=v; z=" + "0+" * 4000 + "0"}}}]}, "formulas.json")
        self.bad(4, "formulas.json", "-s", 8, says=("formulas.json", "at most 4096"), leaves=self.new_files())
        self.write({"lambent": 1, "objects": [{"shape": flat, "radius": 2}]}, "formulas.json")
        self.bad(2, "formulas.json", "-s", 8, says="radius", leaves=self.new_files())

    def test_implicit_formulas(self):
        """--save-scene of an implicit surface, its keys, a string instead of the object, and the limit on the operations of a file."""
        torus = "a=2; (sqrt(x^2+y^2)-a)^2+z^2-1"
        for words, want in (([], {}), (["--x", "0..3", "--z", "-1..a", "--segments", "30", "--flip"], {"x": "0..3", "z": "-1..a", "segments": 30, "flip": True})):
            saved = self.again("shape", "--implicit", torus, *words, "-s", "64")
            self.assertEqual(saved["objects"][0]["shape"], {"implicit": {"formula": torus, **want}})
            self.assertIsNone(misfit(saved, SCHEMA))
        one = {"implicit": {"formula": "x^2+y^2+z^2-1", "segments": 8}}
        others = [{"implicit": {**one["implicit"], **change}} for change in ({"x": "0..1"}, {"z": "0..1"}, {"flip": True}, {"segments": 9})]
        scene = {"lambent": 1, "objects": [{"shape": shape} for shape in (one, one, *others, {"implicit": "x^2+y^2+z^2 = 1"})]}
        self.assertIsNone(misfit(scene, SCHEMA))
        self.write(scene, "formulas.json")
        self.given |= {"formulas.json"}
        answer = json.loads(self.good("info", "formulas.json", "--json").stdout)["counts"]
        self.assertEqual((answer["meshes"], answer["objects"]), (6, 7))
        for shape, says in (({"implicit": "x^2+w"}, "column 5: found 'w'"), ({"implicit": {"x": "0..1"}}, "'formula' is missing"), ({"implicit": {"formula": "x", "u": "0..1"}}, "implicit.u"),
                            ({"implicit": {"formula": "x", "segments": 1025}}, "segments"), ({"implicit": "x", "parametric": "x=u; y=v; z=0"}, "contains both"),
                            ({"implicit": "x^2+y^2"}, "nowhere negative")):
            self.write({"lambent": 1, "objects": [{"shape": shape}]}, "formulas.json")
            self.bad(2, "formulas.json", "-s", 8, says=("formulas.json: objects[0].shape", says), leaves=self.new_files())

    @long
    def test_work_of_implicit_formulas(self):
        """All implicit surfaces of a scene file together take a few seconds at most."""
        dense = "+".join(f"sin({k}x)*cos({k}y-z)" for k in range(1, 150))
        self.write({"lambent": 1, "objects": [{"shape": {"implicit": {"formula": dense, "segments": 1024, "flip": bool(k)}}} for k in range(2)]}, "formulas.json")
        self.bad(4, "formulas.json", "-s", 8, says="expected fewer segments")

    def test_saved_scenes_of_real_models(self):
        models = [m for kind in ("obj", "stl", "ply") for m in sorted(SHARED_MODELS.glob(f"{kind}/**/*.{kind}"))
                  if m.stat().st_size < 400000][::9]
        if not models:
            self.skipTest(f"no models at {SHARED_MODELS} (LAMBENT_MODELS)")
        drawn = [model for model in models if self.run_program(model, "-s", "8", "-o", "-").returncode == 0]
        self.assertGreater(len(drawn), len(models) / 2)
        for model in drawn:
            self.again(model, "-s", "80x60")

    def test_save_scene_is_refused(self):
        self.bad(1, "cube.obj", "cube.stl", "--save-scene", "x.json", says="single model")
        self.bad(1, "-", "--save-scene", "x.json", says="standard input")
        self.bad(5, "cube.obj", "-s", "8", "--save-scene", "nowhere/x.json", says="nowhere", leaves=["cube.png"])

    def test_lights(self):
        lights = json.loads(self.good("lights", "scene.json").stdout)
        self.assertEqual([l["name"] for l in lights["lights"]], ["key", "sun", "lamp", "torch"])
        self.assertEqual(lights["ambient"], [0.05, 0.05, 0.05])
        self.assertEqual(lights["lights"][2]["cutoff"], 25)
        self.assertEqual(len(json.loads(self.good("lights", "cube.obj").stdout)["lights"]), 4)
        rig = json.loads(self.good("lights", "cube.obj", "--rig", "headlight").stdout)["lights"]
        self.assertEqual(len(rig), 1)
        for light in lights["lights"] + rig:
            self.assertIsNone(misfit(light, SCHEMA["properties"]["lights"]["items"]))
        # --light replaces the file's lights, or adds to them.
        for sign, count in (("", 1), ("+", 5)):
            self.good("scene.json", "--light", sign + "point:position=1/2/3", "--save-scene", "lit.json", "-q", "-s", 8, "-o", "lit.png")
            self.assertEqual(len(json.loads((self.folder / "lit.json").read_text())["lights"]), count, sign)
        # The output consists of keys of scene files.
        plain = {k: v for k, v in self.example.items()}
        self.write({**plain, **lights}, "copy.json")
        self.assertEqual(self.png("copy.json"), self.png("scene.json"))

    def test_raw_reaches_the_models(self):
        ply = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
               "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "-9 -9 0 128 64 32\n9 -9 0 128 64 32\n0 9 0 128 64 32\n3 0 1 2\n")
        self.write(ply, "c.ply")
        scene = {"lambent": 1, "image": {"size": [9, 9], "samples": 1, "color": "raw"}, "reflection": "none",
                 "camera": {"eye": [0, 0, 4]}, "objects": [{"file": "c.ply", "material": {"diffuse": [1, 1, 1]}}]}
        self.write(scene)
        self.assertEqual(self.png("scene.json")[2][160:164], bytes([128, 64, 32, 255]))
        # Colours are decoded and encoded again; the bytes are identical.
        self.assertEqual(self.png("scene.json", "--color-mode", "srgb")[2][160:164], bytes([128, 64, 32, 255]))
        scene["image"]["color"] = "srgb"
        self.write(scene)
        self.good("scene.json", "-o", "s.pfm")
        import struct
        value = struct.unpack_from("<f", (self.folder / "s.pfm").read_bytes(), len(b"PF\n9 9\n-1.0\n") + 40 * 12)[0]
        self.assertAlmostEqual(value, ((128 / 255 + 0.055) / 1.055) ** 2.4, places=5)

    def test_models_elsewhere(self):
        """A scene file may refer to files anywhere; with --files-inside, only to files in its own folder."""
        (self.folder / "sub").mkdir()
        picture = self.png("scene.json")
        for name in ("../cube.ply", str(self.folder / "cube.ply"), "link.ply"):
            self.example["objects"][1]["file"] = name
            self.write(self.example, "sub/up.json")
            (self.folder / "sub/link.ply").unlink(missing_ok=True)
            (self.folder / "sub/link.ply").symlink_to("../cube.ply")
            self.bad(2, "sub/up.json", "--files-inside", "-o", "x.png", says=["sub/up.json: objects[1].file: ", "leads out of the folder sub/", "--files-inside"])
            self.assertEqual(self.png("sub/up.json"), picture)
        for name, says in (("none.ply", "none.ply"), ("/dev/zero", "leads out of the folder"), ("scene.json", "scene file")):
            self.example["objects"][1]["file"] = name
            self.write(self.example)
            self.bad(2, "scene.json", "--files-inside", "-o", "x.png", says=["objects[1].file", says])
        self.example["objects"][1]["file"] = "/dev/zero"
        self.write(self.example)
        self.bad(2, "scene.json", "-o", "x.png", says=["/dev/zero: is a device, expected a regular file"])

    def test_saved_beside_or_not(self):
        """A saved scene can be drawn from any folder; with --files-inside, --save-scene reports if this is impossible."""
        (self.folder / "sub").mkdir()
        self.good("cube.obj", "-s", "8", "-o", "face.png")
        outside = b"warning: the saved scene file names files outside of its folder"
        for words, beside in ((["cube.obj", "--save-scene", "s.json"], True), (["sphere", "--save-scene", "sub/s.json"], True),
                              ([self.folder / "cube.obj", "--save-scene", "./s.json"], True), (["cube.obj", "--save-scene", "sub/s.json"], False),
                              (["sphere", "--reflection-map", "sky", "--reflectivity", "1", "--save-scene", "sub/s.json"], True),
                              (["sphere", "--reflection-map", ",".join(["face.png"] * 6), "--reflectivity", "1", "--save-scene", "sub/s.json"], False)):
            done = self.good(*words, "-s", "8", "-o", "a.png", "--files-inside")
            self.assertEqual(outside in done.stderr, not beside, words)
            done = self.run_program(words[-1], "-o", "b.png", "--files-inside")
            self.assertEqual(done.returncode, 0 if beside else 2, words)
            self.good(words[-1], "-o", "b.png")
            self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())


class Environment(Case):
    def test_faces(self):
        """A scene's environment equals the environment given on the command line; without it, the picture differs."""
        names = []
        for i, color in enumerate(("red", "cyan", "white", "#202020", "lime", "blue")):
            names.append(f"face{i}.png")
            self.good("cube.obj", "-s", "8", "--camera", "eye=0/0/5,target=0/0/9", "-b", color, "-q", "-o", names[-1])
        scene = {"lambent": 1, "image": {"size": [48, 48], "samples": 1},
                 "materials": {"mirror": {"diffuse": [0.1, 0.1, 0.1], "reflectivity": [0.8, 0.8, 0.8]}},
                 "objects": [{"shape": "sphere", "material": "mirror"}],
                 "lights": [{"type": "directional", "direction": [0, 0, -1]}]}
        (self.folder / "bare.json").write_text(json.dumps(scene))
        scene["reflection_map"] = {"faces": names, "rotation": 30}
        (self.folder / "mirrored.json").write_text(json.dumps(scene))
        self.good("bare.json", "-o", "bare.png")
        self.good("mirrored.json", "-o", "mirrored.png")
        self.good("bare.json", "--reflection-map", ",".join(names), "--environment-rotation", "30", "-o", "asked.png")
        read = lambda name: (self.folder / name).read_bytes()
        self.assertEqual(read("mirrored.png"), read("asked.png"))
        self.assertNotEqual(read("mirrored.png"), read("bare.png"))
        self.good("bare.json", "--reflection-map", ",".join(names), "--environment-rotation", "30", "-q", "-o", "asked.png",
                  "--save-scene", "saved.json")
        self.good("saved.json", "-o", "saved.png")
        self.assertEqual(read("saved.png"), read("asked.png"))
        # The option rotates a scene file's own environment, and the saved file stores the rotation.
        self.good("mirrored.json", "--environment-rotation", "75", "-q", "-o", "asked.png", "--save-scene", "saved.json")
        self.assertEqual(json.loads(read("saved.json"))["reflection_map"]["rotation"], 75)
        self.good("saved.json", "-o", "saved.png")
        self.good("bare.json", "--reflection-map", ",".join(names), "--environment-rotation", "75", "-o", "turned.png")
        self.assertEqual(read("saved.png"), read("turned.png"))
        self.assertEqual(read("saved.png"), read("asked.png"))
        self.assertNotEqual(read("saved.png"), read("mirrored.png"))

    def test_built_in(self):
        for model in ("sphere", "cube.obj"):
            self.good(model, "-s", 40, "--reflection-map", "sky", "--environment-rotation", 20, "--reflectivity", "0.4/0.5/0.6", "-q",
                      "-o", "asked.png", "--save-scene", "sky.json")
            self.assertEqual(json.loads((self.folder / "sky.json").read_text())["reflection_map"], {"builtin": "sky", "rotation": 20})
            self.good("sky.json", "-o", "saved.png")
            self.assertEqual((self.folder / "asked.png").read_bytes(), (self.folder / "saved.png").read_bytes())
        self.scene("bad.json", {"lambent": 1, "environment": {"builtin": "studoi"}, "objects": [{"shape": "cube"}]})
        self.given |= self.new_files()
        self.bad(2, "bad.json", says=("environment.builtin", "studoi", "sky, studio", "did you mean 'studio'"))
        self.scene("bad.json", {"lambent": 1, "objects": [{"shape": "cube"}], "lights": [{"type": "point", "position": ["2r", "2r", "2x"]}]})
        self.bad(2, "bad.json", says=('lights[0].position[2]: found "2x"', 'such as "2r"'))

    def scene(self, name, content):
        (self.folder / name).write_text(json.dumps(content))
        self.given.add(name)

    def test_unseen(self):
        """An environment that nothing reflects causes a warning; an environment above the memory limit causes an error."""
        self.assertIn(b"environment is invisible", self.good("cube.obj", "-s", 20, "--reflection-map", "sky", "-o", "a.png").stderr)
        self.assertNotIn(b"not seen", self.good("cube.obj", "-s", 20, "--reflection-map", "sky", "--reflectivity", 1, "-o", "a.png").stderr)
        self.assertIn(b"environment is invisible", self.good("cube.obj", "-s", 20, "--environment", "sky", "--reflection", "phong", "-o", "a.png").stderr)
        self.assertNotIn(b"invisible", self.good("cube.obj", "-s", 20, "--environment", "sky", "-o", "a.png").stderr)
        self.scene("unseen.json", {"lambent": 1, "reflection_map": {"builtin": "studio"}, "objects": [{"shape": "cube"}]})
        self.assertIn(b"environment is invisible", self.good("unseen.json", "-s", 20, "-o", "a.png").stderr)
        self.good("cube.obj", "-s", "1200x600", "-q", "-o", "wide.png")
        self.scene("heavy.json", {"lambent": 1, "environment": {"equirectangular": "wide.png"}, "objects": [{"shape": "cube"}]})
        self.given |= self.new_files()
        self.bad(4, "heavy.json", "--memory-limit", "11M", "-s", 20, says="memory limit")
        self.good("unseen.json", "--memory-limit", "11M", "-s", 20, "--samples", 4, "--threads", 2, "-q", "-o", "a.png")
        self.given |= self.new_files()
        self.bad(4, "unseen.json", "--environment", "wide.png", "--memory-limit", "11M", "-s", 20, says="memory limit")

    def test_exposure(self):
        """2^stops times the light; the background and alpha do not change."""
        box = {"lambent": 1, "image": {"size": [24, 24], "samples": 4, "color": "raw", "exposure": 1.5, "background": [0.1, 0.2, 0.3, 0.5]},
               "objects": [{"shape": "sphere"}], "lights": [{"type": "directional", "direction": [0, 0, -1]}]}
        self.scene("bright.json", box)
        self.good("bright.json", "--exposure", 0, "-o", "plain.pfm")
        self.good("bright.json", "-o", "bright.pfm")
        self.good("bright.json", "--show", "diffuse", "-o", "diffuse.pfm")
        self.good("bright.json", "--show", "specular", "-o", "specular.pfm")
        self.good("bright.json", "-b", "transparent", "-o", "clear.pfm")
        plain, bright, clear = (self.floats(name) for name in ("plain.pfm", "bright.pfm", "clear.pfm"))
        self.assertEqual(bright[:3], plain[:3])
        middle = 3 * (12 * 24 + 12)
        for c in range(3):
            self.assertAlmostEqual(bright[middle + c] / plain[middle + c], 2**1.5, 5)
        # The terms over a transparent background add up to the picture over it.
        self.good("bright.json", "-b", "transparent", "--show", "diffuse", "-o", "diffuse.pfm")
        self.good("bright.json", "-b", "transparent", "--show", "specular", "-o", "specular.pfm")
        self.good("bright.json", "-b", "transparent", "--show", "ambient", "-o", "ambient.pfm")
        for whole, *terms in zip(clear, *(self.floats(name) for name in ("diffuse.pfm", "specular.pfm", "ambient.pfm"))):
            self.assertAlmostEqual(whole, sum(terms), 5)
        # Exposure does not change surface quantities.
        for what in ("normals", "depth", "n.l"):
            self.good("bright.json", "--show", what, "-o", "a.pfm")
            self.good("bright.json", "--show", what, "--exposure", 0, "-o", "b.pfm")
            self.assertEqual((self.folder / "a.pfm").read_bytes(), (self.folder / "b.pfm").read_bytes())
        self.good("bright.json", "--exposure", -2.25, "-q", "-o", "asked.png", "--save-scene", "kept.json")
        self.assertEqual(json.loads((self.folder / "kept.json").read_text())["image"]["exposure"], -2.25)
        self.good("kept.json", "-o", "kept.png")
        self.assertEqual((self.folder / "asked.png").read_bytes(), (self.folder / "kept.png").read_bytes())
        answer = json.loads(self.good("explain", "bright.json", "12,12", "--json").stdout)
        self.good("bright.json", "-o", "bright.png")
        self.assertAlmostEqual(answer["exposure"], 2**1.5, 6)
        self.assertEqual(answer["exposure_stops"], 1.5)
        self.assertEqual(tuple(answer["bytes"]), pixel(read_png((self.folder / "bright.png").read_bytes()), 12, 12))
        self.given |= self.new_files()
        self.bad(1, "bright.json", "--exposure", "200", says="-100 to 100")

    def floats(self, name):
        data = (self.folder / name).read_bytes()
        head = data.split(b"\n", 3)
        return struct.unpack(f"<{24 * 24 * 3}f", head[3])

    def test_warned_of(self):
        """Warnings about valid but unlikely input: coefficients over 1, the lights of a file without lights, a scene file without --show."""
        (self.folder / "s.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "cube", "material": {"diffuse": [2, 0, 0], "ambient": [0, 0, 0]}}]}))
        self.assertIn(b"diffuse is 2, which reflects more light than it receives", self.good("s.json", "-s", 8).stderr)
        lights = [{"type": "point", "position": [0, 0, 3], "name": name} for name in ("key", "fill", "key")]
        (self.folder / "l.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "cube"}], "lights": lights}))
        self.assertIn(b"l.json: lights[0] and lights[2] are both named 'key'", self.good("l.json", "-s", 8).stderr)
        (self.folder / "l.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "cube"}], "lights": lights[:2]}))
        self.assertNotIn(b"warning", self.good("l.json", "-s", 8).stderr)
        self.assertIn(b"above 1", self.good("cube", "-s", 8, "--reflectivity", 1.5, "--reflection-map", "sky").stderr)
        self.assertIn(b"the model has no lights", self.good("cube", "-s", 8, "--rig", "file").stderr)
        self.assertIn(b"describes the picture without --show", self.good("cube", "-s", 8, "--show", "normals", "--save-scene", "t.json").stderr)
        for words in (["cube", "-s", 8], ["cube", "-s", 8, "--rig", "file", "--light", "+point"], ["cube", "-s", 8, "--save-scene", "t.json"]):
            self.assertNotIn(b"warning", self.good(*words).stderr)

    def test_object_of_two(self):
        scene = {"lambent": 1, "objects": [{"name": "a", "shape": "cube"}, {"name": "a", "shape": "sphere"}]}
        (self.folder / "s.json").write_text(json.dumps(scene))
        self.good("s.json", "-s", 8, "-o", "ok.png")
        self.bad(1, "s.json", "-o", "no.png", "--light", "point:position=0/0/2,frame=object:a", says="2 objects are named 'a'", leaves={"ok.png"})
        scene["lights"] = [{"type": "point", "frame": "object", "object": "a"}]
        (self.folder / "s.json").write_text(json.dumps(scene))
        self.bad(2, "s.json", "-o", "no.png", says="2 objects are named 'a'", leaves={"ok.png"})

    def test_limits_while_a_picture_is_read(self):
        """Limits apply while an environment's picture is read, which takes 0.2 s and more."""
        wide = write_png(4096, 2048, bytes(4096 * 2048 * 4))
        (self.folder / "wide.png").write_bytes(wide)
        self.scene("wide.json", {"lambent": 1, "environment": {"equirectangular": "wide.png"}, "objects": [{"shape": "cube"}]})
        for words in (["sphere", "--environment", "wide.png"], ["wide.json"]):
            self.bad(4, *words, "-s", 16, "--time-limit", "0.02", "-o", "x.png", says="time limit", timeout=10)
            started = subprocess.Popen([PROGRAM, *words, "-s", "16", "-o", "x.png"], cwd=self.folder, stderr=subprocess.PIPE)
            wait_until_caught(started, signal.SIGINT)
            started.send_signal(signal.SIGINT)
            self.assertIn(b"interrupted", started.communicate(timeout=30)[1])
            self.assertEqual(started.returncode, -signal.SIGINT)
            self.bad(4, *words, "-s", 16, "--memory-limit", "100M", "-o", "x.png", says="memory limit", timeout=10)

    def test_missing_face(self):
        (self.folder / "s.json").write_text(json.dumps({"lambent": 1, "environment": {"faces": ["no.png"] * 6},
                                                         "objects": [{"shape": "cube"}]}))
        self.bad(2, "s.json", says="no.png")
