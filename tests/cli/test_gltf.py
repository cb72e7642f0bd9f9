# test_gltf.py: options for glTF files: scenes, variants, cameras, required extensions; and scene files that name one.
import base64
import ctypes
import json
import math
import struct

from harness import Case, pixel, read_png, write_png

CORNERS = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
FULL = "eye=0/0/4,target=0/0/0,fovy=20"


def unlit(r, g, b, **more):
    return {"pbrMetallicRoughness": {"baseColorFactor": [r, g, b, 1]}, "extensions": {"KHR_materials_unlit": {}}, **more}


class GltfCase(Case):
    def model(self, name="model.gltf", **changes):
        """A square of two scenes, two variants and two cameras: red, and blue in the second scene, green as variant."""
        def square(material):
            return {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": material, "extensions": {
                "KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]}
        file = {
            "asset": {"version": "2.0"}, "scene": 0,
            "scenes": [{"name": "day", "nodes": [0, 2, 3]}, {"name": "night", "nodes": [1]}],
            "nodes": [{"mesh": 0, "name": "left"}, {"mesh": 1}, {"camera": 0, "translation": [0, 0, 9], "name": "near"},
                      {"camera": 1, "translation": [0, 0, 5]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.1, "znear": 0.5}},
                        {"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 4, "znear": 0, "zfar": 9}}],
            "materials": [unlit(1, 0, 0), unlit(0, 1, 0), unlit(0, 0, 1)], "meshes": [square(0), square(2)],
            "extensions": {"KHR_materials_variants": {"variants": [{"name": "plain"}, {"name": "mint"}]}},
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
            "buffers": [{"byteLength": 60, "uri": "data:;base64," + base64.b64encode(CORNERS).decode()}], **changes}
        (self.folder / name).write_text(json.dumps(file))
        return name


class Gltf(GltfCase):
    def middle(self, *words):
        self.good(*words, "-o", "a.png", "-s", "32", "-q", "-b", "black")
        return pixel(read_png((self.folder / "a.png").read_bytes()), 16, 16)[:3]

    def test_scenes_and_variants(self):
        model = self.model()
        self.assertEqual(self.middle(model), (255, 0, 0))
        self.assertEqual(self.middle(model, "--scene", "night"), (0, 0, 255))
        self.assertEqual(self.middle(model, "--scene", "1"), (0, 0, 255))
        self.assertEqual(self.middle(model, "--variant", "mint"), (0, 255, 0))
        self.assertEqual(self.middle(model, "--variant", "plain"), (255, 0, 0))
        self.bad(1, model, "--scene", "noon", says="there is no scene 'noon'; expected one of 0 ('day'), 1 ('night')")
        self.bad(1, model, "--variant", "2", says="there is no variant '2'; expected one of 0 ('plain'), 1 ('mint')")
        done = self.good("teapot", "--scene", "1", "-o", "a.png", "-s", "32")
        self.assertIn(b"apply only to glTF files", done.stderr)

    def test_factors(self):
        """Factors outside the standard's range are clamped, with one warning; light that overflows gives no NaN."""
        huge = {"pbrMetallicRoughness": {"baseColorFactor": [1e30, -5, 2, 9], "metallicFactor": 1e30, "roughnessFactor": -4}}
        model = self.model("huge.gltf", materials=[huge] * 3)
        done = self.good(model, "--variant", "plain", "-s", "16", "-o", "huge.pfm")
        self.assertEqual(done.stderr.count(b"warning"), 1)
        self.assertIn(b"materials[0].pbrMetallicRoughness.baseColorFactor: found 1e+30, which the standard does not allow; 1 is used "
                      b"(and 17 more of this kind)", done.stderr)
        self.good("cube.obj", "--material", "diffuse=1e38", "--material", "opacity=0.5", "--light", "directional:intensity=1e30",
                  "--ambient", "3e38", "-s", "16", "-o", "bright.pfm")
        for name in ("huge.pfm", "bright.pfm"):
            numbers = struct.unpack("<768f", (self.folder / name).read_bytes()[-3072:])
            self.assertTrue(all(math.isfinite(x) for x in numbers), name)

    def test_cameras(self):
        model = self.model()
        self.assertEqual(self.middle(model, "--camera", "1"), (255, 0, 0))
        self.good(model, "--camera", "1", "-o", "a.png", "-s", "64", "-q", "-b", "black", "--samples", "1")
        picture = read_png((self.folder / "a.png").read_bytes())  # 8 units high: the square fills the middle quarter
        red = [(x, y) for y in range(64) for x in range(64) if pixel(picture, x, y)[0]]
        self.assertEqual((min(red), max(red), len(red)), ((24, 24), (39, 39), 256))
        report = json.loads(self.good(model, "--camera", "near", "-o", "a.png", "-s", "32", "--json").stdout)
        self.assertEqual(report["camera"]["eye"], [0, 0, 9])
        self.assertEqual(report["camera"]["near"], 0.5)
        self.assertLess(report["camera"]["far"], 10)
        self.bad(1, model, "--camera", "far", leaves=(),
                 says="option '--camera': found 'far', expected keys such as eye=2/1/4, or a camera of the file, which has 0 ('near'), 1")
        self.bad(1, "cube.obj", "--camera", "0", says="a camera of the file, which has none")

    def test_animations(self):
        """The square leaves the picture's middle within two seconds; a scene file stores the time."""
        keys = struct.pack("<2f", 0, 2) + struct.pack("<6f", 0, 0, 0, 20, 0, 0)
        model = self.model(
            accessors=[{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                       {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                       {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                       {"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}],
            bufferViews=[{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                         {"buffer": 1, "byteLength": 32}],
            buffers=[{"byteLength": 60, "uri": "data:;base64," + base64.b64encode(CORNERS).decode()},
                     {"byteLength": 32, "uri": "data:;base64," + base64.b64encode(keys).decode()}],
            animations=[{"name": "still", "channels": [], "samplers": []},
                        {"name": "slide", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                         "samplers": [{"input": 2, "output": 3}]}])
        self.assertEqual(self.middle(model, "--camera", FULL, "--time", "1"), (255, 0, 0))  # of the first animation
        self.assertEqual(self.middle(model, "--camera", FULL, "--animation", "slide"), (255, 0, 0))
        self.assertEqual(self.middle(model, "--camera", FULL, "--animation", "slide", "--time", "1"), (0, 0, 0))
        self.assertEqual(self.middle(model, "--camera", FULL.replace("eye=0", "eye=10").replace("target=0", "target=10"),
                                     "--animation", "1", "--time", "1", "--save-scene", "a.json"), (255, 0, 0))
        first = (self.folder / "a.png").read_bytes()
        self.good("a.json", "-o", "a.png", "-q")
        self.assertEqual((self.folder / "a.png").read_bytes(), first)
        self.bad(1, model, "--animation", "fly", says="there is no animation 'fly'; expected one of 0 ('still'), 1 ('slide')")
        self.bad(1, model, "--animation", "slid", says="there is no animation 'slid'; did you mean 'slide'? expected one of")

    def moving(self, pointer, first, last, kind="SCALAR", **changes):
        """The square, with an animation of two seconds that changes one property."""
        flag = isinstance(first, bool)
        keys = struct.pack("<2f", 0, 2) + (bytes([first, last]) if flag else struct.pack(f"<{2 * len(first)}f", *first, *last))
        return self.model(
            "moving.gltf", extensionsUsed=["KHR_animation_pointer"],
            accessors=[{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                       {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                       {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                       {"bufferView": 2, "byteOffset": 8, "componentType": 5121 if flag else 5126,
                        "count": 2 if flag else 2 * len(first) // {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind],
                        "type": kind},
                       {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC2"}],
            bufferViews=[{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                         {"buffer": 1, "byteLength": len(keys)}, {"buffer": 0, "byteLength": 48, "byteStride": 12}],
            buffers=[{"byteLength": 60, "uri": "data:;base64," + base64.b64encode(CORNERS).decode()},
                     {"byteLength": len(keys), "uri": "data:;base64," + base64.b64encode(keys).decode()}],
            animations=[{"channels": [{"sampler": 0, "target": {"path": "pointer", "extensions": {
                "KHR_animation_pointer": {"pointer": pointer}}}}],
                "samplers": [{"input": 2, "output": 3, "interpolation": "STEP" if flag else "LINEAR"}]}], **changes)

    def test_animation_pointers(self):
        """An animated property draws the picture of a file that states the property's value, and differs without it."""
        metal = {"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.25}}
        picture = base64.b64encode(write_png(2, 2, bytes.fromhex("ff0000ff00ff00ff0000ffffffff00ff"))).decode()
        mapped = {"textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64," + picture}],
                  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                                 "extensions": {"KHR_materials_unlit": {}}}] * 3,
                  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 4}, "indices": 1, "material": 0}]}] * 2}
        lamp = {"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 90.0, "spot": {}}]}},
                "nodes": [{"mesh": 0}, {"mesh": 0}, {"translation": [0.0, 0.0, 3.0], "extensions": {
                    "KHR_lights_punctual": {"light": 0}}}, {}],
                "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.0}}] * 3}
        three = {"materials": [metal] * 3}
        light = "/extensions/KHR_lights_punctual/lights/0/"
        rows = (("/nodes/0/translation", "VEC3", (0, 0, 0), (1, 0.5, 0), {}),
                ("/nodes/0/rotation", "VEC4", (0, 0, 0, 1), (0, 0, math.sqrt(0.5), math.sqrt(0.5)), {}),
                ("/nodes/0/scale", "VEC3", (1, 1, 1), (0.5, 2, 1), {}),
                ("/materials/0/pbrMetallicRoughness/baseColorFactor", "VEC4", (1, 0, 0, 1), (0, 0, 1, 1), {}),
                ("/materials/0/pbrMetallicRoughness/roughnessFactor", "SCALAR", (0.1,), (0.9,), three),
                ("/materials/0/pbrMetallicRoughness/metallicFactor", "SCALAR", (1,), (0,), three),
                ("/materials/0/emissiveFactor", "VEC3", (0, 0, 0), (1, 0.5, 0), three),
                ("/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", "SCALAR", (0,), (1,), three),
                ("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", "VEC2",
                 (0, 0), (1, 0.5), mapped),
                ("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation", "SCALAR",
                 (0,), (3,), mapped),
                (light + "color", "VEC3", (1, 1, 1), (1, 0, 0), lamp), (light + "intensity", "SCALAR", (0,), (50,), lamp),
                (light + "spot/outerConeAngle", "SCALAR", (0.1,), (0.5,), lamp),
                ("/cameras/0/perspective/yfov", "SCALAR", (0.4,), (0.8,), {}),
                ("/cameras/1/orthographic/ymag", "SCALAR", (2,), (3,), {}))
        for pointer, kind, first, last, more in rows:
            with self.subTest(pointer):
                camera = "0" if "perspective" in pointer else "1" if "orthographic" in pointer else "eye=2/1/5,target=0/0/0,fovy=60"
                view = ("--camera", camera, "-s", "24", "-q", "-o")
                model = self.moving(pointer, first, last, kind, **more)
                file = json.loads((self.folder / model).read_text())
                *path, key = pointer.strip("/").split("/")
                owner = file
                for step in path:
                    owner = owner[int(step)] if isinstance(owner, list) else owner.setdefault(step, {})
                middle = [(a + b) / 2 for a, b in zip(first, last)]
                middle = [0, 0, math.sin(math.pi / 8), math.cos(math.pi / 8)] if key == "rotation" and kind == "VEC4" else middle
                owner[key] = middle if len(middle) > 1 else middle[0]
                (self.folder / "still.gltf").write_text(json.dumps(file))
                for name, words in (("moved", (model, "--time", "1")), ("still", ("still.gltf",)), ("first", (model,))):
                    self.good(*words, *view, f"{name}.png")
                self.assertEqual((self.folder / "moved.png").read_bytes(), (self.folder / "still.png").read_bytes())
                self.assertNotEqual((self.folder / "moved.png").read_bytes(), (self.folder / "first.png").read_bytes())
        visible = self.moving("/nodes/0/extensions/KHR_node_visibility/visible", True, False)
        self.bad(2, visible, "--time", "2", says="contains no triangles in its scene")
        self.assertEqual(self.middle(visible, "--time", "1", "--camera", FULL), (255, 0, 0))
        for pointer, says in (
                ("/materials/0/doubleSided", "channels[0].target: '/materials/0/doubleSided' is no property that this"),
                ("/materials/7/emissiveFactor", "'/materials/7/emissiveFactor' names nothing in the file"),
                ("/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation", "names nothing in the file"),
                ("/cameras/0/perspective/yfov/0", "is no property"), ("", "expected"), ("/nodes/0/weights/0", "names nothing")):
            kind, count = ("VEC3", 3) if "emissiveFactor" in pointer else ("SCALAR", 1)
            done = self.good(self.moving(pointer, [0] * count, [1] * count, kind), "--time", "1", "-o", "a.png", "-s", "16")
            self.assertEqual(done.stderr.count(says.encode()), 1, (pointer, done.stderr))

    def test_warnings_of_each_frame(self):
        """The file is read for each frame. Only the first frame measures whether the file's lamp leaves the model dark."""
        nodes = [{"mesh": 0}, {"mesh": 1}, {"translation": [0, 0, -3], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {}]
        model = self.moving("/nodes/0/translation", (0, 0, 0), (1, 0, 0), "VEC3", nodes=nodes,
                            materials=[{"pbrMetallicRoughness": {"metallicFactor": 0.0}}] * 3,
                            extensions={"KHR_lights_punctual": {"lights": [{"type": "point"}]}})
        done = self.good(model, "--sweep", "time=0..2", "--frames", "3", "-s", "16", "-o", "a.png")
        self.assertEqual(done.stderr.count(b"a dim studio also lights the model"), 1, done.stderr)

    def test_nodes_above_objects(self):
        """The name of a node stands for the objects below it too; other names keep their meaning."""
        red, blue = {"mesh": 0, "name": "red", "translation": [-1.5, 0, 0]}, {"mesh": 1, "name": "blue", "translation": [1.5, 0, 0]}
        model = self.model(nodes=[{"name": "arm", "children": [1, 2]}, red, {"name": "hand", "children": [3]}, blue],
                           scenes=[{"nodes": [0]}])

        def left_and_right(*words):
            self.good(model, "--camera", FULL.replace("20", "50"), *words, "-o", "a.png", "-s", "32", "-q", "-b", "black")
            picture = read_png((self.folder / "a.png").read_bytes())
            return [pixel(picture, x, 16)[:3] for x in (5, 27)]

        black, both = (0, 0, 0), [(255, 0, 0), (0, 0, 255)]
        self.assertEqual(left_and_right(), both)
        self.assertEqual(left_and_right("--hide", "hand"), [both[0], black])
        self.assertEqual(left_and_right("--only", "hand"), [black, both[1]])
        self.assertEqual(left_and_right("--only", "arm"), both)
        self.assertEqual(left_and_right("--material", "diffuse=0/1/0@hand"), [both[0], (0, 255, 0)])
        self.bad(1, model, "--hide", "hant", says="did you mean 'hand'?")
        (self.folder / "two.json").write_text(json.dumps({"lambent": 1, "objects": [
            {"file": model, "scene": "0", "transform": [["translate", 0, 9, 0]]}, {"file": model}]}))
        self.good("two.json", "--hide", "hand", "--camera", FULL.replace("20", "50"), "-o", "b.png", "-s", "32", "-q", "-b", "black")
        picture = read_png((self.folder / "b.png").read_bytes())
        self.assertEqual(pixel(picture, 27, 16)[:3], black)
        names = json.loads(self.good("info", model, "--json").stdout)["names"]
        self.assertEqual([(n["name"], n["objects"], n["groups"]) for n in names if n["name"]],
                         [("red", 1, 0), ("blue", 1, 0), ("arm", 0, 1), ("hand", 0, 1)])
        model = self.model(nodes=[{**red, "children": [1]}, {**blue, "translation": [3, 0, 0]}], scenes=[{"nodes": [0]}])
        self.assertEqual(left_and_right("--material", "diffuse=0/1/0@red"), [(0, 255, 0)] * 2)  # a node with a mesh and a child

    def test_morphed_colors(self):
        """Morph targets and animated weights change colours, which are clamped after all targets are added."""
        for kind, format_, white in ((5121, "<16B", 255), (5126, "<16f", 1)):
            base = struct.pack(format_, *([white, 0, 0, white] * 4))
            deltas = struct.pack("<24f", *([-2, 0, 0] * 4), *([0.5, 1, 0] * 4))
            data = CORNERS + base + deltas + struct.pack("<4f", 0, 2, 0, 1)
            views, at = [], 0
            for size in (48, 12, len(base), 48, 48, 8, 8):
                views.append({"buffer": 0, "byteOffset": at, "byteLength": size})
                at += size
            model = self.model(
                nodes=[{"mesh": 0}] * 4, bufferViews=views,
                accessors=[{"bufferView": i, "componentType": c, "count": n, "type": t, "normalized": c == 5121}
                           for i, (c, n, t) in enumerate(((5126, 4, "VEC3"), (5123, 6, "SCALAR"), (kind, 4, "VEC4"),
                                                          (5126, 4, "VEC3"), (5126, 4, "VEC3"), (5126, 2, "SCALAR"),
                                                          (5126, 2, "SCALAR")))],
                buffers=[{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
                materials=[unlit(1, 1, 1)] * 3, meshes=[{"weights": [1, 1], "primitives": [{
                    "attributes": {"POSITION": 0, "COLOR_0": 2}, "indices": 1, "material": 0,
                    "targets": [{"COLOR_0": 3}, {"COLOR_0": 4}]}]}],
                animations=[{"channels": [{"sampler": 0, "target": {"path": "pointer", "extensions": {
                    "KHR_animation_pointer": {"pointer": "/nodes/0/weights/0"}}}}], "samplers": [{"input": 5, "output": 6}]}])
            self.assertEqual(self.middle(model, "--camera", FULL), (0, 255, 0))  # 1 − 2 + 0.5
            self.assertEqual(self.middle(model, "--camera", FULL, "--time", "0"), (255, 255, 0))
            self.assertEqual(self.middle(model, "--camera", FULL, "--time", "1"), (188, 255, 0))  # 1 − 1 + 0.5

    def test_three_sets_of_coordinates(self):
        """The maps use any two sets; a map with a third set is omitted, but never the base colour."""
        info = [{"index": 0, "texCoord": i} for i in (5, 6, 7)]
        picture = base64.b64encode(write_png(1, 1, bytes([0, 255, 0, 255]))).decode()
        done = self.good(self.model(
            textures=[{"source": 0}], images=[{"uri": "data:image/png;base64," + picture}],
            materials=[{"pbrMetallicRoughness": {"baseColorTexture": info[0]}, "normalTexture": info[1],
                        "emissiveTexture": info[2], "emissiveFactor": [1, 1, 1]}] * 3), "-o", "a.png", "-s", "16")
        self.assertEqual(done.stderr.count(b"its emission map is not drawn: it uses TEXCOORD_"), 1, done.stderr)

    def test_one_warning_for_one_cause(self):
        """Each file is drawn with exactly the warnings listed: a consequence of a wrong value is not reported again, and nothing is left out in silence."""
        triangle = {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}
        instancing = {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}}
        one = [{"nodes": [0]}]
        for warning, changes in (
                ("meshes[1].primitives: expected at least one", {"meshes": [triangle, {"primitives": []}], "scenes": [{"nodes": [0, 1]}]}),
                ("meshes[0].primitives[1]: found \"x\"", {"meshes": [{"primitives": [*triangle["primitives"], "x"]}], "scenes": one}),
                ("scenes[0].nodes[1]: node 0 is listed already", {"scenes": [{"nodes": [0, 0]}]}),
                ("scenes[0]: found \"x\", expected an object", {"scenes": ["x"]}),
                ("nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: found no TRANSLATION", {"nodes": [instancing], "scenes": one}),
                ("skins[0]: found \"x\", expected an object", {"skins": ["x"], "nodes": [{"mesh": 0, "skin": 0}], "scenes": one}),
                ("cameras[0].perspective.yfov: found \"x\"",
                 {"cameras": [{"type": "perspective", "perspective": {"yfov": "x", "znear": 1}}], "nodes": [{"mesh": 0}, {"camera": 0}],
                  "scenes": [{"nodes": [0, 1]}]}),
                ("variants[0]: names none of the file's 2 variants",
                 {"meshes": [{"primitives": [{**triangle["primitives"][0], "extensions": {
                     "KHR_materials_variants": {"mappings": [{"material": 0, "variants": [7]}]}}}]}], "scenes": one})):
            with self.subTest(warning):
                done = self.good(self.model(**changes), *(("--variant", "mint") if "variants" in warning else ()), "-o", "a.png", "-s", "16")
                found = [line for line in done.stderr.decode().splitlines() if "warning" in line]
                self.assertEqual(len(found), 1, found)
                self.assertIn(warning, found[0])
        self.given.add("a.png")
        # Two causes in one object are two warnings.
        model = self.model(cameras=[{"type": "perspective", "perspective": {"yfov": 0.5, "zfar": "x"}}], nodes=[{"mesh": 0}, {"camera": 0}], scenes=[{"nodes": [0, 1]}])
        text = self.good(model, "-o", "a.png", "-s", "16").stderr.decode()
        self.assertIn("zfar: found \"x\"", text)
        self.assertIn("znear is missing", text)
        for list_name, key in (("buffers", "byteLength"), ("accessors", "count")):
            values = json.loads((self.folder / self.model()).read_text())[list_name]
            values[0][key] = None
            self.bad(2, self.model(**{list_name: values}), says="%s[0]: %s is missing" % (list_name, key))

    def test_required_extensions(self):
        model = self.model(extensionsRequired=["EXT_moonlight"], extensionsUsed=["EXT_moonlight"])
        self.bad(3, model, says=["extensionsRequired", "EXT_moonlight"])
        done = self.good(model, "--lenient", "-o", "a.png", "-s", "32")
        self.assertIn(b"does not draw: EXT_moonlight", done.stderr)

    def test_wrong_attributes(self):
        """Attributes of another length than POSITION are left out, with one line for each kind; the same shape is drawn."""
        plain = self.model()
        names = ("NORMAL", "TANGENT", "TEXCOORD_0", "COLOR_0", "JOINTS_0", "WEIGHTS_0")
        wide = {"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC4"}
        file = json.loads((self.folder / plain).read_text())
        file["accessors"] += [{**wide, "type": "VEC3"}, wide, {**wide, "type": "VEC2"}, wide, {**wide, "componentType": 5123}, wide]
        file["skins"] = [{"joints": [0]}]
        file["nodes"][0]["skin"] = 0
        for mesh in file["meshes"]:
            mesh["primitives"] *= 2
            mesh["primitives"][0]["attributes"].update((name, 2 + i) for i, name in enumerate(names))
        (self.folder / "wrong.gltf").write_text(json.dumps(file))
        done = self.good("wrong.gltf", "-o", "b.png", "-s", "32")
        self.good(plain, "-o", "a.png", "-s", "32")
        self.given.update(["a.png", "b.png"])
        for name in ("NORMAL", "TEXCOORD_0", "COLOR_0", "JOINTS_0"):
            self.assertEqual(done.stderr.count(f"attributes.{name}: found 1 elements, expected 4, one for each POSITION; drawn without it "
                                               "(and 1 more of this kind)".encode()), 1, done.stderr)
        self.assertEqual(done.stderr.count(b"warning"), 4, done.stderr)
        self.assertEqual((self.folder / "b.png").read_bytes(), (self.folder / "a.png").read_bytes())

    def test_unpadded_chunks(self):
        """trimesh pads no chunk to a multiple of four bytes."""
        model = self.model()
        file = json.loads((self.folder / model).read_text())
        del file["buffers"][0]["uri"]
        for padding in range(4):
            text = (json.dumps(file) + " " * padding).encode()
            chunks = struct.pack("<2I", len(text), 0x4e4f534a) + text + struct.pack("<2I", 60, 0x4e4942) + CORNERS
            (self.folder / "a.glb").write_bytes(struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks)
            self.assertEqual(self.png("a.glb", "-s", "32"), self.png(model, "-s", "32"), padding)

    def test_sides(self):
        model = self.model()
        behind = FULL.replace("0/0/4", "0/0/-4")
        self.assertEqual(self.middle(model, "--camera", FULL), (255, 0, 0))
        self.assertEqual(self.middle(model, "--camera", behind), (0, 0, 0))
        self.assertEqual(self.middle(model, "--camera", behind, "--cull", "none"), (255, 0, 0))
        model = self.model(materials=[unlit(1, 0, 0, doubleSided=True), unlit(0, 1, 0), unlit(0, 0, 1)])
        self.assertEqual(self.middle(model, "--camera", behind), (255, 0, 0))

    def test_scene_files(self):
        """--save-scene draws the same bytes again, with the selected parts of the file and changed objects."""
        light = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30}]}}
        model = self.model(
            nodes=[{"mesh": 0, "children": [1]}, {"mesh": 1, "translation": [1, 0.5, 0.5], "scale": [-1, 1, 1]},
                   {"translation": [1, 1, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {}],
            materials=[{"pbrMetallicRoughness": {"metallicFactor": 0.3}}, {"name": "b"}, {}],
            extensions={**light, "KHR_materials_variants": {"variants": [{"name": "plain"}, {"name": "mint"}]}})
        for words in ([], ["--rotate", "y:30"], ["--variant", "mint", "--cull", "none"], ["--color", "red", "--one-sided"],
                      ["--scene", "night", "--shininess", "9"], ["--material", "gold"]):
            with self.subTest(words=words):
                self.good(model, *words, "-o", "a.png", "-s", "48", "-q", "--save-scene", "a.json")
                self.good("a.json", "-o", "b.png", "-q")
                self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.given.update(["a.png", "b.png", "a.json"])

    def test_lights_that_leave_the_model_black(self):
        """A dim studio lights them too, unless an option sets the lights; a saved scene and each view repeat the picture."""
        light = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30}]}}
        for z, warns in ((-30, True), (30, False)):
            model = self.model(nodes=[{"mesh": 0}, {"mesh": 1}, {"translation": [0, 0, z], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {}],
                               materials=[{"pbrMetallicRoughness": {"metallicFactor": 0}}, {}, {}], extensions=light)
            for more, said in (((), warns), (("--rig", "studio"), False), (("--rig", "file"), False), (("--rig", "default"), False)):
                text = self.good(model, "-s", "48", "-o", "a.png", "--view", "front", *more).stderr
                self.assertEqual(b"of the picture black, so a dim studio also lights the model" in text, said, (z, more, text))
            self.good(model, "-s", "48", "-o", "a.png", "-q", "--view", "front", "--save-scene", "a.json")
            self.good("a.json", "-o", "b.png", "-q")
            text = self.good(model, "-s", "48", "-o", "{view}.png", "--view", "back,front").stderr
            self.assertEqual(text.count(b"a dim studio also lights the model"), warns, text)  # one warning for both views
            self.good(model, "-s", "48", "-o", "t{frame}.png", "-q", "--view", "front", "--sweep", "azimuth=0..0", "--frames", "2")
            files = [(self.folder / name).read_bytes() for name in ("a.png", "b.png", "front.png")]
            self.assertTrue(all(f == files[0] for f in files[1:]), [len(f) for f in files])
            self.assertEqual((self.folder / "t0.png").read_bytes(), (self.folder / "t1.png").read_bytes())
            self.given.update(["a.png", "b.png", "a.json", "front.png", "back.png", "t0.png", "t1.png"])

    def test_lights_beside_the_dim_studio(self):
        """With the dim studio, the few surfaces that the file's own lights reach have their colour, and are not white."""
        light = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 300}]}}
        blue = {"pbrMetallicRoughness": {"baseColorFactor": [0.04, 0.08, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0.5}}
        model = self.model(scenes=[{"nodes": [0, 1, 2]}], materials=[blue] * 3, extensions=light, nodes=[
            {"mesh": 0, "scale": [2, 2, 1]}, {"mesh": 1, "translation": [3, 0, 0], "rotation": [0, math.sin(math.pi / 8), 0, math.cos(math.pi / 8)]},
            {"translation": [40, 0, -1], "extensions": {"KHR_lights_punctual": {"light": 0}}}])
        text = self.good(model, "-s", "64", "-o", "a.png", "--view", "front").stderr
        self.assertIn(b"a dim studio also lights the model", text)
        picture = read_png((self.folder / "a.png").read_bytes())
        lit = max((pixel(picture, x, 32) for x in range(64) if pixel(picture, x, 32)[3] == 255), key=sum)
        self.assertTrue(lit[0] < 100 and lit[2] > 150, lit)

    def test_glass_that_is_not_shown(self):
        """A warning states that glass is opaque with methods that do not support it."""
        model = self.model(materials=[{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}, {}, {}])
        for words, said in (((), False), (("--reflection", "phong"), True), (("--shading", "gouraud"), True)):
            text = self.good(model, "-s", "16", "-b", "white", "-o", "a.png", *words).stderr
            self.assertEqual(b"glass is drawn opaque" in text, said, (words, text))

    def test_panes_that_are_only_blended(self):
        """With --glass auto, a blended material whose name says glass or window is drawn as thin glass; others stay."""
        def draw(*words, **material):
            blended = {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, material.pop("opacity", 0.3)]}}
            done = self.good(self.model(materials=[{**blended, **material}, {}, {}]), "-s", "32", "-b", "white", "--brighten", "off", "-v", "-o", "a.png", *words)
            return read_png((self.folder / "a.png").read_bytes())[2], b"blended materials drawn as glass: 1" in done.stderr
        glass = draw(name="any", alphaMode="OPAQUE", pbrMetallicRoughness={"baseColorFactor": [0.76, 0.82, 0.88, 1], "metallicFactor": 0, "roughnessFactor": 0.1},
                     extensions={"KHR_materials_transmission": {"transmissionFactor": 1}})[0]
        film = draw(name="Shop_WINDOW.001")
        self.assertEqual(draw("--glass", "auto", name="Shop_WINDOW.001"), (glass, True))
        self.assertNotEqual(film, (glass, False))
        self.assertEqual(film, draw("--glass", "auto", name="foil"))
        self.assertEqual(*(draw("--glass", word, name="glass", opacity=0.7) for word in ("off", "auto")))
        self.assertNotEqual(draw("--look", "catalog", name="glass"), draw("--look", "catalog", "--glass", "off", name="glass"))

    def test_moved_lights(self):
        """A scene file that places a model also places its lights and cameras."""
        light = {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 30, "name": "lamp"}]}}
        model = self.model(nodes=[{"mesh": 0}, {"mesh": 1}, {"camera": 0, "translation": [0, 0, 9]},
                                  {"translation": [1, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}], extensions=light)
        (self.folder / "a.json").write_text(json.dumps({"lambent": 1, "objects": [
            {"file": model, "transform": [["translate", 0, 10, 0], ["rotate", 90, 0, 1, 0]]}]}))
        lights = json.loads(self.good("lights", "a.json").stdout)["lights"]
        self.assertEqual([round(x, 6) for x in lights[0]["position"]], [3, 10, -1])
        self.assertEqual([round(x, 6) + 0 for x in lights[0]["direction"]], [-1, 0, 0])
        camera = json.loads(self.good("a.json", "--camera", "0", "-o", "a.png", "-s", "32", "--json").stdout)["camera"]
        self.assertEqual([round(x, 6) + 0 for x in camera["eye"]], [9, 10, 0])


class Compressed(Gltf):
    """KHR_meshopt_compression and EXT_meshopt_compression: the data is encoded with the library itself, and draws the same picture as the plain file."""

    def encode(self, library, kind, data, count, stride):
        bound = getattr(library, f"meshopt_encode{kind}Bound")
        bound.restype = ctypes.c_size_t
        size = bound(ctypes.c_size_t(count), ctypes.c_size_t(stride if kind == "VertexBuffer" else 4))
        out = ctypes.create_string_buffer(size)
        encode = getattr(library, f"meshopt_encode{kind}")
        encode.restype = ctypes.c_size_t
        words = (ctypes.c_uint32 * count)(*struct.unpack(f"<{count}H", data)) if kind != "VertexBuffer" else data
        if kind == "VertexBuffer":
            used = encode(out, ctypes.c_size_t(size), words, ctypes.c_size_t(count), ctypes.c_size_t(stride))
        else:
            used = encode(out, ctypes.c_size_t(size), words, ctypes.c_size_t(count))
        self.assertGreater(used, 0)
        return out.raw[:used]

    def file(self, damage=None, name="EXT_meshopt_compression", plain=False, packed=None, **more):
        try:
            library = ctypes.CDLL("libmeshoptimizer.so.2d")
        except OSError:
            self.skipTest("libmeshoptimizer is not installed")
        vertices = packed or self.encode(library, "VertexBuffer", CORNERS[:48], 4, 12)
        indices = self.encode(library, "IndexBuffer", CORNERS[48:], 6, 2)
        data = bytearray(vertices + bytes(-len(vertices) % 4) + indices)
        at = len(vertices) + (-len(vertices) % 4)
        if damage is not None:
            data[damage] ^= 0xff
        views = [{"buffer": 1, "byteLength": 48, "byteStride": 12, "extensions": {name: {
                      "buffer": 0, "byteLength": len(vertices), "byteStride": 12, "count": 4, "mode": "ATTRIBUTES", **more}}},
                 {"buffer": 1, "byteOffset": 48, "byteLength": 12, "extensions": {name: {
                      "buffer": 0, "byteOffset": at, "byteLength": len(indices), "byteStride": 2, "count": 6, "mode": "TRIANGLES"}}}]
        buffers = [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(bytes(data)).decode()},
                   {"byteLength": 60, "uri": "data:;base64," + base64.b64encode(CORNERS).decode()} if plain else {"byteLength": 60, "extensions": {name: {"fallback": True}}}]
        return self.model("packed.gltf", bufferViews=views, buffers=buffers, extensionsUsed=[name],
                          extensionsRequired=[] if plain else [name])

    def test_same_picture(self):
        wanted = self.png(self.model(), "-s", "32")
        for name in ("EXT_meshopt_compression", "KHR_meshopt_compression"):
            self.assertEqual(self.png(self.file(name=name), "-s", "32"), wanted)
            self.assertEqual(self.png(self.file(name=name, plain=True), "-s", "32"), wanted)

    def test_version_1(self):
        """Version 1 of attributes, by the encoder of meshoptimizer 1.3 (npm), also if libmeshoptimizer cannot decode it."""
        packed = bytes.fromhex("a1eaeaaa00ff00ff0000ff00000000000000000000000080bf000080bf00000000000000")
        wanted = self.png(self.model(), "-s", "32")
        self.assertEqual(self.png(self.file(packed=packed), "-s", "32"), wanted)
        # The filter COLOR, with the numbers of meshoptimizer's decoder: red, green, blue and white corners.
        for stride, component, packed_colors, colors in (
                (4, 5121, "a1bf007e02fe00fdfdfe0083fd0000000000000000000000000000000000000000407fc1ff00", "fe0100ff00fe00ff0180ffffffffffff"),
                (8, 5123, "a1ffaf000102010006020e00020201000d0f100003020000160d0000000000000000000000000000000004ff0701fcff0f0000", "efff10000000ffff0000efff0000ffff10000880ffffffffffffffffffffffff")):
            meshes = [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 2}, "indices": 1}]}]
            accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                         {"bufferView": 2, "componentType": component, "normalized": True, "count": 4, "type": "VEC4"}]
            pictures = []
            for data in (CORNERS + bytes.fromhex(colors), CORNERS + bytes.fromhex(packed_colors)):
                length = len(data) - len(CORNERS)
                views = [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}, {"buffer": 0, "byteOffset": 60, "byteLength": 4 * stride}]
                if length != 4 * stride:
                    views[2] = {"buffer": 1, "byteLength": 4 * stride, "extensions": {"KHR_meshopt_compression": {
                        "buffer": 0, "byteOffset": 60, "byteLength": length, "byteStride": stride, "count": 4, "mode": "ATTRIBUTES", "filter": "COLOR"}}}
                buffers = [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}, {"byteLength": 4 * stride}]
                pictures.append(self.png(self.model(nodes=[{"mesh": 0}], scenes=[{"nodes": [0]}], meshes=meshes, accessors=accessors, bufferViews=views, buffers=buffers), "-s", "32"))
            self.assertEqual(*pictures)
            self.assertNotEqual(pictures[0], wanted)
        for size in range(1, len(packed)):
            self.bad(2, self.file(packed=packed[:size]), "-o", "a.png", says="the compressed bytes are damaged")

    def test_wrong(self):
        self.bad(2, self.file(damage=0), "-o", "a.png", says="bufferViews[0].extensions.EXT_meshopt_compression: the compressed bytes are damaged")
        self.bad(2, self.file(byteStride=10), "-o", "a.png", says="byteStride: found 10, expected a multiple of 4")
        self.bad(2, self.file(count=5), "-o", "a.png", says="byteLength: found 48, but 5 elements of 12 bytes are 60")
        self.bad(2, self.file(filter="QUATERNION"), "-o", "a.png", says="the filter QUATERNION does not support ATTRIBUTES of 12 bytes")
        self.bad(2, self.file(mode="LINES"), "-o", "a.png", says="mode")


def turned(v, axis, angle):
    """Rodrigues' formula."""
    c, s = math.cos(angle), math.sin(angle)
    cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]]
    along = sum(a * b for a, b in zip(axis, v)) * (1 - c)
    return [c * v[i] + s * cross[i] + along * axis[i] for i in range(3)]


class Glass(GltfCase):
    def devices(self):
        usable = any(d["reason"] is None for d in json.loads(self.good("devices", "--json").stdout)["gl"])
        return ("cpu", "gl") if usable else ("cpu",)

    def center(self, model, device, eye):
        self.good(model, "-o", "a.pfm", "-s", "33", "--samples", "1", "-b", "black", "--device", device, "-q", "--light", "directional:intensity=0", "--ambient", "0",
                  "--camera", "eye={:.17g}/{:.17g}/{:.17g},target=0/0/0,fovy=1".format(*eye))
        return struct.unpack("<3f", (self.folder / "a.pfm").read_bytes()[-12 * (33 * 16 + 17):][:12])

    def test_path_in_a_scaled_volume(self):
        """The refracted direction, scaled axis by axis. A colour of (1, 0.5, 0.25) shows the path in the ratios of channels."""
        axis, angle = (0.48, 0.6, 0.64), 1.1
        half = [x * math.sin(angle / 2) for x in axis] + [math.cos(angle / 2)]
        for scale, eye, ior in (((1, 1, 0.1), (0, 0, 9), 1.5), ((1, 1, 0.1), (3, 1, 9), 1.5), ((2, 0.5, 3), (-4, 3, 6), 1.3), ((2, 0.5, 3), (-4, 3, 6), 1),
                                ((1, 3, 0.25), (5, 5, 6), 1)):
            length = math.sqrt(sum(x * x for x in eye))
            into = [-x / length / ior for x in eye]
            into[2] = -math.sqrt(1 - into[0] ** 2 - into[1] ** 2)  # Snell: the tangential part, divided by the index of refraction
            path = 7 * math.sqrt(sum((d * s) ** 2 for d, s in zip(into, scale))) / 1.5
            glass = {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0}, "extensions": {
                "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": ior},
                "KHR_materials_volume": {"thicknessFactor": 7, "attenuationDistance": 1.5, "attenuationColor": [1, 0.5, 0.25]}}}
            for rotation in ([0, 0, 0, 1], half):
                model = self.model(scenes=[{"nodes": [2]}], materials=[unlit(1, 1, 1), {}, glass], nodes=[
                    {"mesh": 0, "scale": [3, 3, 1], "translation": [0, 0, -1]}, {"mesh": 1, "scale": scale}, {"children": [0, 1], "rotation": rotation}])
                seen = turned(eye, axis, angle) if rotation is half else eye
                for device in self.devices() if ior == 1 else ("cpu",):
                    red, green, blue = self.center(model, device, seen)
                    self.assertAlmostEqual(green / red, 0.5 ** path, delta=2e-6 if device == "cpu" else 2e-5, msg=(scale, eye, ior, rotation, device))

    def test_cutoff_above_1(self):
        """No opacity reaches a cutoff above 1: the surface is invisible, and casts no shadow."""
        for cutoff, shown in ((1, True), (1.0001, False), (1.5, False), (1e30, False)):
            model = self.model(materials=[unlit(1, 0, 0, alphaMode="MASK", alphaCutoff=cutoff)] * 3)
            for device in self.devices():
                self.assertEqual(self.center(model, device, (0, 0, 9)), (float(shown), 0, 0), (cutoff, device))
        floor = {"pbrMetallicRoughness": {"metallicFactor": 0}}
        light = ["--light", "directional:direction=0/0/-1", "--shadows"]
        pictures = []
        for cutoff in (0.5, 1.5, None):
            above = [] if cutoff is None else [{"mesh": 0, "translation": [0, 0, 5], "scale": [2, 2, 1]}]
            model = self.model(scenes=[{"nodes": list(range(1 + len(above)))}], nodes=[{"mesh": 1}, *above],
                               materials=[unlit(1, 0, 0, alphaMode="MASK", alphaCutoff=cutoff or 0.5), {}, floor])
            pictures.append(self.png(model, "-s", "32", "--camera", "eye=0/-6/2,target=0/0/0,fovy=30", *light))
        self.assertEqual(pictures[1], pictures[2])
        self.assertNotEqual(pictures[0], pictures[2])
