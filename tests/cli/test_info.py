# test_info.py: the command `info`: its report about a model; the JSON matches docs/info.schema.json.
import base64
import json
import struct

from harness import ROOT, check_value, write_png
from test_gltf import GltfCase

SCHEMA = json.loads((ROOT / "docs" / "info.schema.json").read_text())


class Info(GltfCase):
    def info(self, *words):
        rows = [json.loads(line) for line in self.good("info", "--json", *words).stdout.splitlines()]
        for row in rows:
            check_value(self, row, SCHEMA, "info", SCHEMA)
        return rows

    def test_gltf_file(self):
        model = self.model(asset={"version": "2.0", "generator": "by\x1bhand", "copyright": "nobody"},
                           extensionsUsed=["KHR_materials_unlit", "KHR_materials_dispersion", "NO_such"],
                           images=[{"uri": "skin.png"}])
        row = self.info(model)[0]
        self.assertEqual((row["format"], row["version"], row["generator"], row["copyright"]), ("gltf", "2.0", "by\x1bhand", "nobody"))
        self.assertEqual((row["unit"], row["up"], row["size"]), ("metre", "y", [2, 2, 0]))
        self.assertEqual(row["counts"], {"triangles": 2, "lines": 0, "points": 0, "vertices": 4, "objects": 1, "meshes": 1, "parts": 1,
                                         "stored_triangles": 2, "stored_vertices": 4})
        self.assertEqual(row["scenes"], [{"name": "day", "read": True}, {"name": "night", "read": False}])
        self.assertEqual(row["variants"], ["plain", "mint"])
        self.assertEqual([(m["kind"], m["base"]) for m in row["materials"]][:3],
                         [("unlit", [1, 0, 0]), ("unlit", [0, 1, 0]), ("unlit", [0, 0, 1])])
        self.assertEqual([c["name"] for c in row["cameras"]], ["near", None])
        self.assertAlmostEqual(row["cameras"][0]["fovy_deg"], 5.729578, 5)
        self.assertEqual((row["cameras"][0]["eye"], row["cameras"][1]["ortho_half_height"]), ([0, 0, 9], 4))
        self.assertEqual([(e["name"], e["required"], e["support"]) for e in row["extensions"]],
                         [("KHR_materials_unlit", False, "supported"), ("KHR_materials_dispersion", False, "ignored"), ("NO_such", False, "unknown")])
        self.assertEqual(row["textures"], [{"name": None, "file": "skin.png", "format": "png", "color_space": None, "width": 0, "height": 0,
                                            "memory_bytes": 0, "slots": []}])
        self.assertEqual(self.info(model, "--scene", "night")[0]["scenes"][1]["read"], True)
        text = self.good("info", model).stdout.decode()
        for words in ("gltf 2.0, written by by?hand", "copyright   nobody", "2 × 2 × 0 m, y up", "area 4 m², not closed", "2 triangles, 4 vertices", "0 'day', the scene that lambent reads",
                      "1 'night'", "0 unlit: base 1/0/0", "1 'mint'", "0 'near', perspective, 5.73 degrees high, at 0 0 9", "KHR_materials_dispersion: ignored",
                      "NO_such: unknown", "0 'skin.png', png; not read"):
            self.assertIn(words, text)

    def test_names(self):
        """Each name of an object or a part is listed once, and --hide accepts it."""
        (self.folder / "names.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\no body\ng door\nf 1 2 3\ng window\nf 1 3 2\ng door\nf 1 2 3\n")
        self.assertEqual(self.info("names.obj")[0]["names"], [{"name": "body", "objects": 1, "parts": 0, "groups": 0}, {"name": "body/door", "objects": 0, "parts": 2, "groups": 0},
                                                              {"name": "body/window", "objects": 0, "parts": 1, "groups": 0}])
        text = self.good("info", "names.obj").stdout.decode()
        self.assertIn("names       'body', 1 object\n            'body/door', 2 parts\n            'body/window', 1 part\n", text)
        self.assertEqual([row["name"] for row in self.info("cube")[0]["names"]], ["cube"])
        for name in ("body/door", "body/window"):
            self.good("names.obj", "--hide", name, "-s", 8, "-o", "hidden.png")
        (self.folder / "none.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertEqual(self.info("none.obj")[0]["names"], [])

    def test_measure(self):
        """The area, and the volume of closed objects, in the model's units if the format defines none."""
        for model, area, volume in (("cube.obj", 24, 8), ("cube.stl", 24, 8), ("cube.ply", 24, 8), ("sphere", 12.566, 4.18879), ("plane", 4, None)):
            measure = self.info(model)[0]["measure"]
            self.assertAlmostEqual(measure["area"] / area, 1, 2, model)
            self.assertEqual((measure["closed"], measure["size_mm"], measure["area_mm2"], measure["volume_mm3"]), (volume is not None, None, None, None))
            self.assertEqual(measure["volume"] is None, volume is None, model)
            if volume:
                self.assertAlmostEqual(measure["volume"] / volume, 1, 2, model)
        self.assertIn("area 24 units², closed: volume 8 units³", self.good("info", "cube.obj").stdout.decode())
        # A missing triangle, and a triangle that faces the other side.
        faces = (self.folder / "cube.obj").read_text()
        lines = [line for line in faces.splitlines() if line.startswith("f ")]
        for change in ("", " ".join([lines[0].split()[0], *reversed(lines[0].split()[1:])])):
            (self.folder / "open.obj").write_text(faces.replace(lines[0], change))
            self.assertFalse(self.info("open.obj")[0]["measure"]["closed"])
        # Each object of a scene counts, with its transform.
        (self.folder / "two.json").write_text(json.dumps({"lambent": 1, "objects": [{"file": "cube.obj"}, {"file": "cube.obj", "transform": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}]}))
        measure = self.info("two.json")[0]["measure"]
        self.assertEqual((measure["area"], measure["volume"]), (24 + 96, 8 + 64))

    def test_up_of_a_terrain(self):
        """A terrain in the xy plane is read as Z up, with a message; other models are not, and --up overrides it."""
        def grid(height, floor=False):
            n = 30
            vertices = [(x, y, height(x, y)) for y in range(n) for x in range(n)]
            faces = [(k + 1, k + 2, k + n + 2, k + n + 1) for k in range(n * (n - 1)) if k % n < n - 1]
            if floor:  # seen from below, like a plate
                vertices += [(x, y, -1) for x, y, _ in vertices]
                faces += [tuple(n * n + k for k in reversed(face)) for face in faces]
            return "".join("v %g %g %g\n" % v for v in vertices) + "".join("f %d %d %d %d\n" % f for f in faces)

        def hills(x, y):
            return 0.3 * ((7 * x + 5 * y * y) % 4)

        for name, text, up in (("hills", grid(hills), "z"), ("flat", grid(lambda x, y: 0), "y"), ("plate", grid(hills, True), "y"),
                               ("cone", grid(lambda x, y: 30 - abs(x - 15) - abs(y - 15)), "y")):
            (self.folder / f"{name}.obj").write_text(text)
            self.assertEqual(self.info(f"{name}.obj")[0]["up"], up, name)
            self.assertEqual(b"z is assumed to be up" in self.good(f"{name}.obj", "-s", "32", "-o", "a.png").stderr, up == "z", name)
        self.assertNotIn(b"z is assumed", self.good("hills.obj", "--up", "y", "-s", "32", "-o", "a.png").stderr)

    def test_up_of_a_lying_model(self):
        """A PLY or STL file with a model that stands on another axis than the usual one is turned, with a message; not by --up file, convert or +."""
        def boxes(turn, parts):
            """Triangles of boxes (low corner, high corner); `turn` maps a point with z up to the file's axes."""
            out = []
            for low, high in parts:
                p = [turn([(low, high)[i >> k & 1][k] for k in range(3)]) for i in range(8)]
                for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
                    out += [(p[a], p[b], p[c]), (p[a], p[c], p[d])]
            return out

        def write(name, triangles):
            if name.endswith(".stl"):
                data = b"\0" * 80 + struct.pack("<I", len(triangles)) + b"".join(struct.pack("<12fH", 0, 0, 0, *sum(map(list, t), []), 0) for t in triangles)
            else:
                head = "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face %d\n" \
                       "property list uchar int vertex_indices\nend_header\n" % (3 * len(triangles), len(triangles))
                data = (head + "".join("%g %g %g\n" % tuple(p) for t in triangles for p in t) +
                        "".join("3 %d %d %d\n" % (3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles)))).encode()
            (self.folder / name).write_bytes(data)

        animal = [((0, 0, .6), (1, .4, 1))] + [((x, y, 0), (x + .1, y + .1, .6)) for x in (.1, .8) for y in (.05, .25)]
        turns = {"z": lambda p: p, "y": lambda p: (p[0], p[2], -p[1]), "x": lambda p: (p[2], -p[0], -p[1])}
        for ending, usual in (("ply", "y"), ("stl", "z")):
            for up, turn in turns.items():
                name = f"animal-{up}.{ending}"
                write(name, boxes(turn, animal))
                self.assertEqual(self.info(name)[0]["up"], usual, name)
                self.assertEqual(self.report(name, "-s", "32")["model"]["up"], up, name)
                said = self.good(name, "-s", "32", "-o", f"{name}.png").stderr
                self.assertEqual(f"{up} is assumed to be up".encode() in said, up != usual, name)
                for words, same in ((("--up", up), True), (("--up", "file"), up == usual), (("--up", usual), up == usual)):
                    self.good(name, "-s", "32", *words, "-o", "given.png")
                    self.assertEqual((self.folder / f"{name}.png").read_bytes() == (self.folder / "given.png").read_bytes(), same, (name, words))
        # Models that stand on no axis, on two, or on the usual one, and low ones, are not turned.
        roof = [((0, 0, .6), (1, .4, 1)), ((.1, .05, 0), (.2, .15, .6))]
        low = [((0, 0, .1), (1, .4, .2))] + [((x, y, 0), (x + .1, y + .1, .1)) for x in (.1, .8) for y in (.05, .25)]
        for name, triangles in (("one-leg", boxes(turns["z"], roof)), ("low", boxes(turns["z"], low)), ("cube", boxes(turns["z"], [((0, 0, 0), (1, 1, 1))])),
                                ):
            write(f"{name}.ply", triangles)
            self.assertEqual(self.report(f"{name}.ply", "-s", "32")["model"]["up"], "y", name)
        said = self.good("animal-z.ply + cube.ply", "-s", "32", "-o", "two.png").stderr + self.good("convert", "animal-z.ply", "out.glb").stderr
        self.assertNotIn(b"is assumed to be up", said)

    def test_warnings_of_commands_without_a_picture(self):
        """Commands that read a model like a picture does print its warnings, each once; --quiet leaves them out."""
        lines = ["ply", "format ascii 1.0", "element vertex 3", *("property float " + name for name in ("x", "y", "z", "age")), "element face 1",
                 "property list uchar int vertex_indices", "end_header", "0 0 0 1", "1 0 0 2", "0 1 0 3", "3 0 1 2"]
        (self.folder / "aged.ply").write_text("\n".join(lines) + "\n")
        for words in (("explain", "aged.ply", "8,8", "-s", "16"), ("lights", "aged.ply"), ("shader", "aged.ply", "-o", "s/"), ("convert", "aged.ply", "a.glb")):
            self.assertEqual(self.good(*words).stderr.count(b"warning: aged.ply: contains data that is not drawn: age"), 1, words)
            if words[0] in ("explain", "shader"):
                self.assertNotIn(b"warning", self.good(*words, "-q").stderr, words)
        for code, words in ((0, ("sheet", "aged.ply", "cube", "-o", "a.png")), (0, ("hash", "aged.ply", "-o", "a.txt")),
                            (6, ("diff", "aged.ply", "cube", "-o", "a.html")), (6, ("diff", "cube", "aged.ply", "-o", "b.html"))):
            done = self.run_program(*words, "-s", "16")
            self.assertEqual((done.returncode, done.stderr.count(b"warning: aged.ply: contains data that is not drawn: age")), (code, 1), words)

    def test_drawing_memory(self):
        """The memory for drawing in addition to the model: at least the picture, more with more threads; no estimate if it exceeds the limit."""
        rows = [self.info("teapot", "--threads", n)[0]["drawing"] for n in (1, 3)]
        self.assertEqual([(r["width"], r["height"], r["threads"]) for r in rows], [(1024, 1024, 1), (1024, 1024, 3)])
        self.assertTrue(4 << 20 < rows[0]["memory_bytes"] < rows[1]["memory_bytes"] < 64 << 20, rows)
        self.assertRegex(self.good("info", "teapot").stdout.decode(), r"MB more to draw 1024×1024 pixels by \d+ thread")
        self.assertIsNone(self.info("teapot", "--threads", 3, "--memory-limit", "4M")[0]["drawing"])

    def test_required_extensions(self):
        """Models that cannot be drawn can still be inspected."""
        model = self.model(extensionsUsed=["NO_such"], extensionsRequired=["NO_such"])
        self.bad(3, model, "-o", "a.png", says="NO_such")
        row = self.info(model)[0]
        self.assertTrue(row["needs_lenient"])
        self.assertEqual(row["extensions"], [{"name": "NO_such", "required": True, "support": "unknown"}])
        self.assertIn(b"NO_such: required, unknown", self.good("info", model).stdout)
        self.assertIn(b"--lenient", self.good("info", model).stdout)
        self.assertFalse(self.info(model, "--lenient")[0]["needs_lenient"])
        # Other errors remain errors.
        done = self.run_program("info", "--json", self.model(asset={"version": "1.0"}))
        self.assertEqual(done.returncode, 3)
        row = json.loads(done.stdout)
        check_value(self, row, SCHEMA, "info", SCHEMA)
        self.assertEqual((row["error"]["exit"], row["error"]["code"]), (3, "unsupported"))

    def test_animations_and_lights(self):
        model = self.model(
            animations=[{"name": "spin", "channels": [], "samplers": [{"input": 2, "output": 2}]}] * 12,
            accessors=[{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                       {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                       {"componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2.5]}],
            nodes=[{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"mesh": 1}, {}, {}],
            extensionsUsed=["KHR_lights_punctual"],
            extensions={"KHR_lights_punctual": {"lights": [{"type": "point", "name": "lamp", "color": [0.5, 1, 0], "intensity": 3.14159265,
                                                            "range": 7}]}})
        row = self.info(model)[0]
        self.assertEqual(row["animations"][11], {"name": "spin", "seconds": 2.5, "channels": 0})
        self.assertEqual((row["lights"][0]["name"], row["lights"][0]["kind"], row["lights"][0]["color"], row["lights"][0]["range"]),
                         ("lamp", "point", [0.5, 1, 0], 7))
        self.assertAlmostEqual(row["lights"][0]["intensity"], 1, 5)
        text = self.good("info", model).stdout.decode()
        self.assertIn("0 'lamp', point, color 0.5/1/0, intensity 1, range 7", text)
        self.assertIn("7 'spin', 2.5 s, 0 channels", text)
        self.assertIn("4 more (--json lists all)", text)
        self.assertNotIn("8 'spin'", text)

    def test_other_formats(self):
        (self.folder / "two.mtl").write_text("newmtl shiny\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 40\nmap_Kd wood.jpg\n")
        (self.folder / "two.obj").write_text("mtllib two.mtl\nv 0 0 0\nv 2 0 0\nv 0 3 0\ng a\nusemtl shiny\nf 1 2 3\ng b\nf 1 3 2\n")
        row, teapot = self.info("two.obj", "teapot")
        self.assertEqual((row["format"], row["unit"], row["generator"], row["size"]), ("obj", None, None, [2, 3, 0]))
        self.assertEqual((row["counts"]["parts"], row["counts"]["triangles"]), (2, 2))
        material = row["materials"][0]
        self.assertEqual((material["name"], material["kind"], material["specular"], material["shininess"]), ("shiny", "classic", [1, 1, 1], 40))
        self.assertEqual(material["maps"], [{"slot": "diffuse", "file": "wood.jpg", "texture": None}])  # the file does not exist
        self.assertEqual((teapot["format"], teapot["textures"], teapot["extensions"]), ("shape", [], []))
        text = self.good("info", "two.obj", "teapot").stdout.decode()
        self.assertIn("0 'shiny', classic: diffuse 0.214, specular 1, shininess 40; maps diffuse", text)
        self.assertIn("unit unknown", text)
        self.assertIn("\n\nteapot\n", text)

    def test_textures(self):
        picture = write_png(4, 2, bytes([255, 128, 0, 255]) * 8)
        (self.folder / "map.png").write_bytes(picture)
        inside = "data:image/png;base64," + base64.b64encode(picture).decode()
        material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}},
                    "occlusionTexture": {"index": 0}, "emissiveTexture": {"index": 1}}
        model = self.model(materials=[material] * 3, textures=[{"source": 0}, {"source": 1}],
                           images=[{"uri": "map.png", "name": "skin"}, {"uri": inside}, {"uri": "gone.jpg"}])
        row = self.info(model)[0]
        color, numbers, glow, unread = row["textures"]
        self.assertEqual([t["color_space"] for t in row["textures"]], ["srgb", "linear", "srgb", None])
        self.assertEqual((color["name"], color["file"], color["format"], color["width"], color["height"]), ("skin", "map.png", "png", 4, 2))
        self.assertEqual((color["slots"], numbers["slots"], glow["slots"]), (["diffuse", "emission"], ["metallic", "roughness", "occlusion"], ["diffuse", "emission"]))  # equal contents share a texture
        self.assertEqual((glow["file"], glow["format"], unread["file"]), (None, "png", "gone.jpg"))
        # Without alpha: three bytes per texel at full size, three floats at smaller levels: 2x1 and
        # 1x1.
        self.assertEqual(color["memory_bytes"], 4 * 2 * 3 + (2 + 1) * 12)
        self.assertEqual([m["texture"] for m in row["materials"][0]["maps"]], [0, 0, 1, 1, 1])
        text = self.good("info", model).stdout.decode()
        for words in ("0 'skin', 'map.png', png, 4x2, srgb: diffuse, emission", "1 'skin', 'map.png', png, 4x2, linear: metallic, roughness, occlusion",
                      "2 in the model, png, 4x2, srgb: diffuse, emission", "3 'gone.jpg', jpg; not read", "maps diffuse, emission, metallic, roughness, occlusion"):
            self.assertIn(words, text)
        (self.folder / "two.mtl").write_text("newmtl a\nmap_Kd map.png\nnewmtl b\nmap_Kd map.png\nmap_Bump map.png\n")
        (self.folder / "two.obj").write_text("mtllib two.mtl\nv 0 0 0\nv 2 0 0\nv 0 3 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n"
                                             "usemtl b\nf 1/1 3/3 2/2\n")
        textures = self.info("two.obj")[0]["textures"]
        self.assertEqual([(t["file"], t["color_space"], t["slots"], t["format"]) for t in textures],
                         [("map.png", "srgb", ["diffuse"], "png"), ("map.png", "linear", ["bump"], "png")])
        text = self.good("info", self.folder / "two.obj").stdout.decode()
        self.assertIn("0 'map.png', png, 4x2, srgb: diffuse", text)

    def test_material_fields(self):
        plain = {"pbrMetallicRoughness": {"metallicFactor": 0.25}}
        coated = {"alphaMode": "MASK", "alphaCutoff": 0.25, "extensions": {
            "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.125},
            "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.25]}, "KHR_materials_ior": {"ior": 1.25},
            "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1.5707963267948966}}}
        model = self.model(materials=[plain, coated], extensionsUsed=list(coated["extensions"]))
        first, second = self.info(model)[0]["materials"]
        self.assertEqual((first["alpha_mode"], first["fields"]), ("opaque", {}))
        self.assertEqual((second["alpha_mode"], second["alpha_cutoff"]), ("mask", 0.25))
        self.assertEqual(second["fields"], {"ior": 1.25, "clearcoat": 0.5, "clearcoat_roughness": 0.125, "sheen_color": [1, 0.5, 0.25],
                                            "anisotropy": 0.5, "anisotropy_rotation": 90})
        text = self.good("info", model).stdout.decode()
        self.assertIn("clearcoat 0.5, clearcoat_roughness 0.125, sheen_color 1/0.5/0.25", text)
        self.assertIn("anisotropy_rotation 90, alpha mask below 0.25", text)

    def test_failures(self):
        done = self.run_program("info", "missing.obj", "teapot", "--json")
        self.assertEqual(done.returncode, 2)
        rows = [json.loads(line) for line in done.stdout.splitlines()]
        for row in rows:
            check_value(self, row, SCHEMA, "info", SCHEMA)
        self.assertEqual([row["error"] is None for row in rows], [False, True])
        self.assertIn(rows[0]["error"]["text"], done.stderr.decode())
        self.bad(1, "info", says="info")
        self.bad(1, "info", "teapot", "-", says="standard input")
        self.bad(1, "info", "teapot", "--size", "9", says="does not apply")
        self.bad(4, "info", "teapot", "--memory-limit", "1k", says="memory")
