# test_convert.py: the command `convert`: round trips that draw the same bytes, reported losses, files next to the model, hostile names.
import base64
import json
import os
import resource
import signal
import struct
import subprocess
import time
import zipfile

from harness import PROGRAM, ROOT, Case, covered, read_png

CORPUS = ROOT / "tests" / "fuzz" / "corpus"
SPOT = ROOT / "examples" / "models" / "spot.glb"


def glb(data):
    """The JSON and the buffer of a GLB file."""
    magic, version, length = struct.unpack("<4sII", data[:12])
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON" and size % 4 == 0
    rest, kind = struct.unpack("<I4s", data[20 + size:28 + size])
    assert kind == b"BIN\0" and rest % 4 == 0 and 28 + size + rest == len(data)
    return json.loads(data[20:20 + size]), data[28 + size:]


class Convert(Case):
    def convert(self, model, output):
        """Converts a model and returns the report; exactly its files exist."""
        before = set(os.listdir(self.folder))
        report = json.loads(self.good("convert", model, output, "--json").stdout)
        names = [os.path.basename(file["path"]) for file in report["files"]]
        self.assertEqual(names[0], os.path.basename(output))
        self.assertEqual(set(os.listdir(self.folder)) - before, set(names) - before)
        for file in report["files"]:
            self.assertEqual((self.folder / file["path"]).stat().st_size, file["bytes"])
        return report

    def picture(self, model, *words):
        return self.png(model, "-s", 96, *words)

    def same(self, model, output, *words):
        """A round trip that preserves the picture exactly."""
        report = self.convert(model, output)
        self.assertEqual(self.picture(model, *words), self.picture(output, *words), f"{model} to {output}: {report['losses']}")
        return report

    def check_glb(self, path):
        """The properties of every GLB file: views within the buffer, accessors within views, indices in range."""
        root, data = glb((self.folder / path).read_bytes())
        self.assertEqual(root["buffers"][0]["byteLength"], len(data))
        sizes = {5121: 1, 5125: 4, 5126: 4}
        widths = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
        for view in root["bufferViews"]:
            self.assertTrue(view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(data))
        for accessor in root["accessors"]:
            bytes_ = accessor["count"] * sizes[accessor["componentType"]] * widths[accessor["type"]]
            self.assertEqual(bytes_, root["bufferViews"][accessor["bufferView"]]["byteLength"])
        for mesh in root["meshes"]:
            for primitive in mesh["primitives"]:
                count = root["accessors"][primitive["attributes"]["POSITION"]]["count"]
                self.assertEqual({root["accessors"][a]["count"] for a in primitive["attributes"].values()}, {count})
                view = root["bufferViews"][root["accessors"][primitive["indices"]]["bufferView"]]
                indices = struct.unpack_from("<%dI" % (view["byteLength"] // 4), data, view["byteOffset"])
                self.assertLess(max(indices), count)
                self.assertLess(primitive["material"], len(root["materials"]))
        return root, data

    # --- names

    def test_names(self):
        """Solids of STL, and objects and groups of OBJ, keep their names in GLB and OBJ; other formats say that they lose them."""
        facet = "facet normal 0 0 1\nouter loop\nvertex %d 0 0\nvertex %d 1 0\nvertex %d 0 1\nendloop\nendfacet\n"
        (self.folder / "two.stl").write_text("".join(f"solid {name}\n{facet % (x, x + 1, x)}endsolid {name}\n" for name, x in (("left", 0), ("right", 2))))
        (self.folder / "g.obj").write_text("o body\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng door\nf 1 2 3\ng window\nf 1 2 4\no wheel\nf 2 3 4\n")
        for model, names in (("two.stl", ["left", "right"]), ("g.obj", ["body/door", "body/window", "wheel"])):
            self.same(model, "a.obj")
            self.convert(model, "b.glb")
            self.convert("b.glb", "c.obj")
            root, _ = self.check_glb("b.glb")
            self.assertEqual([node["name"] for node in root["nodes"]], names)
            for written in ("a.obj", "c.obj"):
                found, thing = [], None
                for word, _, name in (line.partition(" ") for line in (self.folder / written).read_text().splitlines()):
                    if word == "o":
                        thing = name
                    if word in "og":
                        found[len(found) - (found[-1:] == [thing] and word == "g"):] = [name if word == "o" else f"{thing}/{name}"]
                self.assertEqual(found, names, written)
                self.assertIn("triangle", self.good(written, "--hide", names[0], "-s", 16, "-o", "a.png").stdout)
            for output in ("a.stl", "a.ply", "a.3mf"):
                self.assertIn(f"names of parts are omitted ({len(names)})", " ".join(self.convert(model, output)["losses"]))

    def test_texture_in_3mf(self):
        """A texture becomes its mean colour."""
        self.good("cube", "-b", "#ff8000", "--hide", "cube", "-s", 8, "-o", "t.png")
        (self.folder / "t.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd t.png\n")
        (self.folder / "t.obj").write_text("mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
        self.assertIn("mean colour", " ".join(self.convert("t.obj", "t.3mf")["losses"]))
        with zipfile.ZipFile(self.folder / "t.3mf") as archive:
            self.assertIn(b'displaycolor="#FF8000FF"', archive.read("3D/3dmodel.model"))

    # --- round trips

    def test_threshold(self):
        """A material that its alphaCutoff makes invisible becomes visible in OBJ: a loss."""
        data = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()
        tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + data}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]}
        for cutoff, lost in ((0.5, False), (2, True)):
            tree["materials"] = [{"alphaMode": "MASK", "alphaCutoff": cutoff}]
            (self.folder / "cut.gltf").write_text(json.dumps(tree))
            self.assertEqual("MTL has no threshold" in self.good("convert", "cut.gltf", "cut-out.obj", "--json").stdout.decode(), lost)

    def test_glb_to_glb(self):
        """Every glTF file of the corpus that can be drawn gives the same bytes, or a sentence that lists the losses."""
        self.assertEqual(self.same(SPOT, "spot.glb")["losses"], [])
        self.check_glb("spot.glb")
        count = 0
        for path in sorted(CORPUS.glob("gltf/*")):
            if path.suffix not in (".gltf", ".glb") or self.run_program("info", path, "-q").returncode or self.run_program(path, "-s", 8, "-o", "-").returncode:
                continue
            with self.subTest(path.name):
                report = self.convert(path, f"{path.stem}.glb")
                self.check_glb(f"{path.stem}.glb")
                if not report["losses"]:
                    count += 1
                    self.assertEqual(self.picture(path), self.picture(f"{path.stem}.glb"))
        self.assertGreater(count, 3)

    def test_twice(self):
        """A file written by Lambent loses nothing, and becomes the same file again."""
        for name in ("a.glb", "a.obj", "a.ply", "a.stl"):
            self.convert("cube.obj", name)
            ending = name.split(".")[1]
            self.convert(name, f"b.{ending}")
            self.convert(f"b.{ending}", f"c.{ending}")
            b, c = ((self.folder / f"{n}.{ending}").read_bytes().replace(b"c.mtl", b"b.mtl") for n in "bc")
            self.assertEqual(b, c, name)

    def test_same_pictures(self):
        """OBJ with its materials; PLY and OBJ without materials; STL as it is read."""
        self.assertEqual(self.same("cube.obj", "o.obj")["losses"], [])
        self.assertIn(b"usemtl", (self.folder / "o.obj").read_bytes())
        self.assertEqual(self.same("cube.ply", "p.ply")["losses"], [])
        self.assertEqual(self.same("cube.ply", "p.obj")["losses"], [])
        self.same("cube.stl", "s.stl")
        self.same("cube.stl", "s.ply")
        self.same("cube.stl", "s.obj")
        self.same("teapot", "t.ply")
        self.same("teapot", "t.obj", "--view", "back")

    def test_textures(self):
        """Pictures are written next to an OBJ file, and into a GLB file."""
        report = self.convert(SPOT, "spot.obj")
        self.assertEqual([os.path.basename(f["path"]) for f in report["files"]], ["spot.obj", "spot-0.png", "spot.mtl"])
        self.assertIn("map_Kd", (self.folder / "spot.mtl").read_text())
        self.convert("spot.obj", "again.obj")
        self.assertEqual(self.picture("spot.obj"), self.picture("again.obj"))
        self.convert("spot.obj", "spot.glb")
        root, _ = self.check_glb("spot.glb")
        self.assertEqual(len(root["images"]), 1)
        colors = lambda name: self.picture(name, "--show", "base-color")
        self.assertEqual(colors("spot.obj"), colors("spot.glb"))

    def test_colors(self):
        """Vertex colours in PLY, OBJ and GLB."""
        (self.folder / "c.ply").write_text("""ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 7
1 1 0 9 20 255
0 1 0 200 100 50
3 0 1 2
3 0 2 3
""")
        self.same("c.ply", "d.ply")
        self.same("c.ply", "d.obj")
        self.convert("c.ply", "d.glb")
        colors = lambda name: self.picture(name, "--show", "base-color", "--view", "front", "--samples", 1)
        a, b = colors("c.ply"), colors("d.glb")
        self.assertLessEqual(max(abs(x - y) for x, y in zip(a[2], b[2])), 1)

    def test_strokes(self):
        """Lines and points: GLB and OBJ support both, PLY supports points, STL neither."""
        (self.folder / "l.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
        (self.folder / "p.ply").write_text("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 2 3\n")
        self.given.update(("l.obj", "p.ply"))
        self.same("l.obj", "k.obj")
        self.convert("l.obj", "k.glb")
        self.assertEqual(self.check_glb("k.glb")[0]["meshes"][0]["primitives"][0]["mode"], 1)
        self.same("p.ply", "q.ply")
        self.same("p.ply", "q.obj")
        self.given |= self.new_files()
        self.bad(1, "convert", "l.obj", "x.stl", says="STL")
        self.bad(1, "convert", "l.obj", "x.ply", says="PLY")
        self.bad(1, "convert", "p.ply", "x.3mf", says="3MF")

    def test_up(self):
        """The up axis is preserved: z in STL and 3MF, y in other formats."""
        for name in ("s.glb", "s.obj", "s.ply"):
            self.convert("cube.stl", name)
            a, b = self.picture("cube.stl", "--show", "coverage"), self.picture(name, "--show", "coverage")
            self.assertEqual(covered(a), covered(b), name)
        for up in ("x", "-x", "y", "-y", "z", "-z"):
            self.good("shape", "teapot", "-o", "t.obj", "-q")
            self.good("convert", "t.obj", "u.ply", "--up", up, "-q")
            a, b = self.picture("t.obj", "--up", up, "--show", "coverage"), self.picture("u.ply", "--show", "coverage")
            self.assertEqual(covered(a), covered(b), up)
            os.remove(self.folder / "u.ply")

    def test_lights_and_cameras(self):
        """Lights of a scene file that glTF supports; a camera; unsupported features."""
        scene = {"lambent": 1, "objects": [{"file": "cube.obj"}], "camera": {"eye": [3, 2, 5], "target": [0, 0, 0], "fovy": 40},
                 "lights": [{"type": "point", "position": [2, 3, 4], "diffuse": [9, 8, 7], "specular": [9, 8, 7], "attenuation": [0, 0, 1]},
                            {"type": "ambient", "ambient": [0.1, 0.1, 0.1]}]}
        (self.folder / "s.json").write_text(json.dumps(scene))
        report = self.convert("s.json", "s.glb")
        root, _ = self.check_glb("s.glb")
        light = root["extensions"]["KHR_lights_punctual"]["lights"][0]
        self.assertEqual(light["type"], "point")
        self.assertAlmostEqual(light["intensity"] * light["color"][1], 8 * 3.14159265, 4)
        self.assertEqual(len(root["cameras"]), 1)
        self.assertAlmostEqual(root["cameras"][0]["perspective"]["yfov"], 0.6981317, 5)
        self.assertIn("ambient and hemisphere lights are omitted: glTF does not support them", report["losses"])
        self.assertTrue(any("classic materials" in loss for loss in report["losses"]))
        self.assertEqual(covered(self.picture("s.json", "--show", "coverage")), covered(self.picture("s.glb", "--camera", "0", "--show", "coverage")))
        losses = self.convert("s.json", "s.stl")["losses"]
        for word in ("lights", "cameras", "materials", "normals"):
            self.assertTrue(any(loss.startswith(word) for loss in losses), (word, losses))
        lights = [(CORPUS / "gltf" / name) for name in os.listdir(CORPUS / "gltf") if "light" in name and name.endswith((".gltf", ".glb"))]
        for path in lights[:1]:
            self.same(path, "l.glb")

    def test_3mf(self):
        report = self.convert("cube.obj", "c.3mf")
        again = self.convert("cube.obj", "d.3mf")
        self.assertEqual((self.folder / "c.3mf").read_bytes(), (self.folder / "d.3mf").read_bytes())
        with zipfile.ZipFile(self.folder / "c.3mf") as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual(archive.namelist(), ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"])
            self.assertIn(b'displaycolor="#', archive.read("3D/3dmodel.model"))
        self.assertEqual(json.loads(self.good("info", "c.3mf", "--json").stdout)["counts"]["triangles"], 12)
        a, b = self.picture("cube.obj", "--show", "base-color"), self.picture("c.3mf", "--show", "base-color")
        self.assertLessEqual(max(abs(x - y) for x, y in zip(a[2], b[2])), 1)
        self.assertTrue(any("normals" in loss for loss in report["losses"]) and again)

    def test_thumbnail(self):
        self.good("convert", "cube.obj", "c.glb", "--thumbnail", "-q")
        root, data = self.check_glb("c.glb")
        image = root["images"][root["asset"]["thumbnail"]]
        view = root["bufferViews"][image["bufferView"]]
        self.assertEqual(image["mimeType"], "image/png")
        self.assertEqual(read_png(data[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]), self.png("cube.obj", "-s", 512))
        self.convert("c.glb", "d.glb")
        self.assertEqual(self.picture("c.glb"), self.picture("d.glb"))
        self.given |= self.new_files()
        self.bad(1, "convert", "cube.obj", "x.obj", "--thumbnail", says=".glb")
        self.bad(1, "convert", "cube.obj", "-o", "x.glb", says="write lambent convert MODEL OUT.glb")

    # --- limits

    def bomb(self, objects):
        """A small GLB file with many objects of 100 triangles each (EXT_mesh_gpu_instancing)."""
        data = struct.pack("<9f4I", 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 1, 2)
        sparse = {"count": 2, "indices": {"bufferView": 1, "componentType": 5125}, "values": {"bufferView": 2}}
        root = {"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "scene": 0, "scenes": [{"nodes": [0]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                              {"componentType": 5125, "count": 300, "type": "SCALAR", "sparse": sparse},
                              {"componentType": 5126, "count": objects, "type": "VEC3"}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "buffers": [{"byteLength": len(data)}],
                "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}}],
                "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": n} for a, n in ((0, 36), (36, 8), (44, 8))]}
        text = json.dumps(root).encode()
        text += b" " * (-len(text) % 4)
        (self.folder / "bomb.glb").write_bytes(struct.pack("<4s4I", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text +
                                               struct.pack("<2I", len(data), 0x004E4942) + data)
        self.given.add("bomb.glb")

    def test_limits(self):
        """The export obeys the limits of memory and time, and ends soon after a signal."""
        self.bomb(90000)
        many = ["--expansion-limit", "100000000"]
        for ending in ("obj", "ply", "stl", "3mf"):
            output = f"o.{ending}"
            self.bad(4, "convert", "bomb.glb", output, says="--expansion-limit")
            self.bad(4, "convert", "bomb.glb", output, "--memory-limit", "300MB", *many, says="--memory-limit")
            self.bad(4, "convert", "bomb.glb", output, "--memory-limit", "none", "--time-limit", 0.5, *many, says="time limit")
        self.bad(4, "convert", "bomb.glb", "o.glb", "--memory-limit", "60MB", says="--memory-limit")
        process = subprocess.Popen([PROGRAM, "convert", "bomb.glb", "o.obj", "-q", "--memory-limit", "none", *many], cwd=self.folder)
        time.sleep(0.6)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), -signal.SIGINT)
        self.assertLess(time.monotonic() - begin, 2)
        self.assertEqual(self.new_files(), set())

    # --- files

    def test_files_beside(self):
        """A file of another program does not change; converting again replaces Lambent's own file. Odd names do not lead out of the folder."""
        (self.folder / "mine.mtl").write_text("precious")
        self.bad(5, "convert", "cube.obj", "mine.obj", says=("mine.mtl would be overwritten", "mine.obj does not exist"))
        self.assertEqual((self.folder / "mine.mtl").read_text(), "precious")
        self.good("convert", "cube.obj", "o.obj", "-q")
        self.good("convert", "cube.obj", "o.obj", "-q")
        os.mkdir(self.folder / "sub")
        self.good("convert", SPOT, "sub/a b.c.obj", "-q")
        self.assertEqual(sorted(os.listdir(self.folder / "sub")), ["a b.c-0.png", "a b.c.mtl", "a b.c.obj"])
        self.assertEqual(self.picture("sub/a b.c.obj", "--show", "coverage"), self.picture(SPOT, "--show", "coverage"))

    def test_links_beside(self):
        """A link with the name of a file next to the model is not followed, with or without the model, with or without the sandbox."""
        (self.folder / "precious").write_text("of the user")
        self.given.update(("precious", "ship.obj", "ship.mtl", "ship-0.png"))
        for name in ("ship.mtl", "ship-0.png"):
            for target in ("precious", "missing"):
                for sandbox in ("auto", "off"):
                    (self.folder / "ship.obj").write_text("older")
                    os.symlink(target, self.folder / name)
                    self.bad(5, "convert", SPOT, "ship.obj", "--sandbox", sandbox, says=(name, "is a link"))
                    self.assertEqual(((self.folder / "precious").read_text(), (self.folder / "ship.obj").read_text()), ("of the user", "older"))
                    self.assertFalse((self.folder / "missing").exists())
                    os.remove(self.folder / name)
        (self.folder / "ship.obj").unlink()
        os.symlink("real.obj", self.folder / "ship.obj")  # a link named by the user is followed
        (self.folder / "real.obj").write_text("older")
        self.good("convert", SPOT, "ship.obj", "-q")
        self.assertTrue((self.folder / "ship.obj").is_symlink() and (self.folder / "real.obj").stat().st_size > 1000)

    def test_all_files_or_none(self):
        """If one file of the model cannot be written, all older files remain."""
        old = {}
        self.good("convert", "cube.obj", "o.obj", "-q")
        for name in ("o.obj", "o.mtl"):
            old[name] = (self.folder / name).read_bytes()
        self.given.update(("o.obj", "o.mtl"))
        for sandbox in ("auto", "off"):  # the picture fits, and the model does not
            command = [PROGRAM, "convert", "-q", SPOT, "o.obj", "--sandbox", sandbox]
            done = subprocess.run(command, cwd=self.folder, capture_output=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (120000, 120000)))
            self.assertEqual((done.returncode, {name: (self.folder / name).read_bytes() for name in old}), (5, old), done.stderr)
            self.assertEqual(sorted(self.new_files()), [])

    def test_names_that_files_cannot_have(self):
        """OBJ and MTL name files without quotes, so files next to the model get names that can be read back."""
        self.good("convert", "-q", SPOT, "plain.obj")
        expected = self.picture("plain.obj")
        for name, stem in (("-bm 1", "_bm 1"), (" lead", "_lead"), ("back\\slash", "back_slash"), ("line\nend", "line_end"), ("tab\tcr\r", "tab_cr_"),
                           ("-s 1 1 1 x", "_s 1 1 1 x"), ("ä b", "ä b"), (b"bad\xff", "bad_"), ("trail ", "trail ")):
            with self.subTest(name=name):
                folder = os.fsencode(self.folder)
                self.good("convert", "-q", "--", SPOT, os.fsdecode(os.fsencode(name) + b".obj"))
                self.assertTrue({stem + ".mtl", stem + "-0.png"} <= set(os.listdir(self.folder)), os.listdir(folder))
                read = self.good("./" + os.fsdecode(os.fsencode(name)) + ".obj", "-q", "-s", 96, "-o", "-")
                self.assertEqual((read_png(read.stdout), read.stderr), (expected, b""))

    def test_nothing_is_left_if_the_model_cannot_be_written(self):
        """The files next to the model are written first; on failure, new files are removed and older files remain."""
        (self.folder / "m.mtl").write_text("newmtl a\nKd 1 0 0\n")
        (self.folder / "m.obj").write_text("mtllib m.mtl\n" + "".join(f"v {i} {i * i} 0\n" for i in range(2000)) + "usemtl a\nf 1 2 3\n")
        self.given.update(("m.mtl", "m.obj"))
        for sandbox in ("auto", "off"):
            command = [PROGRAM, "convert", "m.obj", "n.obj", "--sandbox", sandbox]
            done = subprocess.run(command, cwd=self.folder, capture_output=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)))
            self.assertEqual((done.returncode, self.new_files()), (5, set()), done.stderr)
            self.assertIn(b"n.obj", done.stderr)
        self.good("convert", "m.obj", "n.obj", "-q")
        old = (self.folder / "n.mtl").read_text()
        done = subprocess.run(command, cwd=self.folder, capture_output=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)))
        self.assertEqual((done.returncode, self.new_files(), (self.folder / "n.mtl").read_text()), (5, {"n.obj", "n.mtl"}, old))

    def test_errors(self):
        for words, code, says in ((["cube.obj", "x.fbx"], 3, ".glb, .obj, .stl, .ply or .3mf"), (["cube.obj", "x"], 3, "write .glb"),
                                  (["cube.obj", "-"], 1, "selects the format"), (["cube.obj"], 1, "missing argument"),
                                  (["cube.obj", "a.glb", "b.glb"], 1, "the command writes one model"), (["cube.obj", "cube.obj"], 1, "the same file"),
                                  (["missing.obj", "x.glb"], 2, "missing.obj"), (["cube.obj", "no/where/x.glb"], 5, "no/where"),
                                  (["cube.obj", "x.glb", "--samples", "4"], 1, "does not apply")):
            self.bad(code, "convert", *words, says=says)
        (self.folder / "bad.obj").write_text("nonsense")
        self.bad(2, "convert", "bad.obj", "x.glb", says="bad.obj")

    def test_endings_in_capitals(self):
        """The format of .STL equals .stl, and the file keeps the given name."""
        for ending in ("STL", "GLB", "Obj", "PLY", "3MF"):
            self.good("convert", "cube.obj", f"c.{ending}", "-q")
            self.good(f"c.{ending}", "-s", 16, "-o", "x.png", "-q")
        self.given.update({"c.STL", "c.GLB", "c.Obj", "c.PLY", "c.3MF", "c.mtl", "x.png"})

    def test_names(self):
        """Names of materials and objects with every kind of character become names that can be read back."""
        (self.folder / "m.mtl").write_text("newmtl a b\nKd 1 0 0\nnewmtl <&\">\nKd 0 1 0\n")
        (self.folder / "m.obj").write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng x%s\\n\nusemtl a b\nf 1 2 3\nusemtl <&\">\nf 1 3 2\n")
        self.given.update(("m.mtl", "m.obj"))
        for name in ("n.obj", "n.glb", "n.3mf", "n.ply"):
            self.convert("m.obj", name)
            self.picture(name)
        self.same("m.obj", "k.obj")

    def test_text(self):
        done = self.good("convert", "cube.obj", "c.stl")
        self.assertIn(b"warning: materials are omitted (", done.stderr)
        self.assertTrue(done.stderr.endswith(b"c.stl  12 triangles  684 bytes\n"))
        self.assertEqual(self.good("convert", "cube.obj", "c.stl", "-q").stderr, b"")
