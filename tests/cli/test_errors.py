# test_errors.py: every failure reports one sentence and its exit code, and leaves no files.
import base64
import json
import os
import struct
import subprocess
import zlib

from harness import Case, PROGRAM, chunk, pixel, read_png


def triangle(buffer, image=None):
    """A glTF triangle whose data are in a buffer, with a texture if there is an image."""
    texture = {"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}], "images": [{"uri": image}]}
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [buffer], **(texture if image else {}),
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, **({"material": 0} if image else {})}]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]}).encode()


class Models(Case):
    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        self.given.add(name)
        return name

    def one_sentence(self, done):
        text = done.stderr.decode()
        self.assertEqual(text.count("\n"), 1, text)
        self.assertLess(len(text), 600)

    def test_missing(self):
        self.one_sentence(self.bad(2, "missing.obj", says="missing.obj"))
        self.bad(2, "teapto", says="did you mean 'teapot'?")
        self.bad(2, "bunny", says="`lambent shapes` lists the shapes")
        self.bad(2, "box", says="did you mean 'cube'?")
        self.bad(2, "*.3mf", says="no file matches this pattern")
        self.bad(2, "none.png", says="write the name of the picture after -o")
        self.bad(2, "zoom", says="an option begins with dashes: --zoom")
        self.bad(2, "missing.obj", "shapes", says="a command comes first: lambent shapes")

    def test_folder(self):
        (self.folder / "folder.obj").mkdir()
        for name in ("folder.obj", "folder.obj/", ".", "..", "/"):
            self.one_sentence(self.bad(2, "render", name, says=f"lambent: {name}"))  # without "render": a contact sheet

    def test_not_regular(self):
        """Pipes, devices and folders are never opened, regardless of who names them: models, material files, scene files, pictures."""
        os.mkfifo(self.folder / "pipe")
        for name, says in (("pipe", "pipe: is a pipe, expected a regular file (- is standard input)"),
                           ("/dev/zero", "/dev/zero: is a device, expected a regular file"), (".", ".: is a directory, expected a file")):
            for words in (["render", name], ["sphere", "--environment", name], ["diff", name, name] if name != "." else ["info", name], ["lights", name], ["explain", name, "1,1"]):
                with self.subTest(words):
                    self.one_sentence(self.bad(2, *words, says=says, timeout=10))
            self.bad(2, "compare", "cube", "--sheet", "light", "-s", 16, "--font", name, "-o", "s.png", says=says.split(" (")[0], timeout=10)
        self.write("m.obj", b"mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertIn(b"pipe: is a pipe, expected a regular file; its materials", self.good("m.obj", "-s", 8, "-o", "-", timeout=10).stderr)
        for scene in ({"file": "pipe"}, {"shape": "cube"}):
            data = {"lambent": 1, "objects": [scene]}
            if "shape" in scene:
                data["environment"] = {"equirectangular": "pipe"}
            self.write("s.json", json.dumps(data).encode())
            self.one_sentence(self.bad(2, "s.json", says=["s.json: ", "pipe: is a pipe, expected a regular file"], timeout=10))
        with open(self.folder / "cube.obj", "rb") as model:  # a redirected file is a regular file, with any name
            self.good("/dev/stdin", "-s", 8, "-o", "-", stdin=model)
        self.good("-", "-s", 8, "-o", "-", stdin=(self.folder / "cube.obj").read_bytes())

    def test_material_files_are_read_once(self):
        """60 kB of mtllib lines once took gigabytes."""
        self.write("big.mtl", b"".join(b"newmtl m%d\nKd 1 0 0\nmap_Kd %d.png\n" % (i, i) for i in range(2000)))
        self.write("many.obj", b"mtllib big.mtl\n" * 4000 + b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m3\nf 1 2 3\n")
        self.good("many.obj", "-s", 8, "-o", "-", "--memory-limit", "36M", "--threads", 2)

    def test_thousand_spheres(self):
        spheres = [{"shape": "sphere", "transform": [["translate", i % 32, i // 32, 0], ["scale", 0.4]]} for i in range(1000)]
        self.write("spheres.json", json.dumps({"lambent": 1, "objects": spheres}).encode())
        self.good("spheres.json", "-s", 64, "-o", "-", "--memory-limit", "300M")

    def test_huge_picture(self):
        """A header of 40000×20000 pixels is rejected before memory is allocated."""
        row = b"\0" + bytes(5000)
        packer = zlib.compressobj()
        packed = b"".join(packer.compress(row) for _ in range(20000)) + packer.flush()
        self.write("huge.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 40000, 20000, 1, 0, 0, 0, 0)) +
                   chunk(b"IDAT", packed) + chunk(b"IEND", b""))
        for words in (["sphere", "--environment", "huge.png"], ["diff", "huge.png", "huge.png"]):
            self.one_sentence(self.bad(4, *words, says=["huge.png", "40000×20000", "at most 400000000 (--pixel-limit)"]))

    def test_half_right_texts(self):
        """Missing data in a truncated or edited text model is reported with its line: as a warning if all drawn data is present."""
        stl = (self.folder / "cube.stl").read_bytes()
        cut = stl[:stl.rindex(b"endsolid")]
        done = self.good(self.write("cut.stl", cut), "-s", 8, "-o", "-")
        self.assertIn(b"warning: cut.stl:%d: found the end of the file, expected \"endsolid\" for the solid in line 1" % (cut.count(b"\n") + 1), done.stderr)
        self.one_sentence(self.bad(2, self.write("zero.stl", stl.replace(b"outer", b"out\0r", 1)), says="zero.stl:3: found a zero byte"))
        header = b"ply\nformat ascii 1.0\n%selement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n" \
                 b"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0%s\n0 1 0\n3 0 1 2\n"
        done = self.good(self.write("blender.ply", header % (b"Created by Blender\n", b"")), "-s", 8, "-o", "-")
        self.assertIn(b"warning: blender.ply:3: found 'Created'", done.stderr)
        self.one_sentence(self.bad(2, self.write("more.ply", header % (b"", b" 5")), says="more.ply:11: vertex 2 of 3: found '5' after z"))
        self.one_sentence(self.bad(2, self.write("zero.ply", header % (b"comment \0\n", b"")), says="zero.ply:3: found a zero byte in the header"))

    def test_broken_attributes(self):
        """Colours, texture coordinates and normals that cannot be meant give one warning. Standard input with unknown first statements is read."""
        triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        ply = "ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n" \
              "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
        for count, warns in ((0, False), (5, True), (6, False), (7, True)):
            numbers = [i / 10 for i in range(count)]
            binary = struct.pack("<9fB3iB%df" % count, 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2, count, *numbers)
            for name, data in (("t.ply", (ply % "ascii" + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 %d %s\n" % (count, " ".join(map(str, numbers)))).encode()),
                               ("b.ply", (ply % "binary_little_endian").encode() + binary)):
                warnings = self.good(self.write(name, data), "-s", 8, "-o", "-").stderr.decode()
                self.assertEqual("1 of 1 faces have lists of texture coordinates of another length" in warnings, warns, (name, count, warnings))
        for color in ("nan 1 1", "1e30 1 1", "0 inf 0", "0 0 -3"):
            done = self.good(self.write("c.obj", (triangle.replace("0 0 0", "0 0 0 " + color) + "f 1 2 3\n").encode()), "-s", 8, "-o", "-")
            self.assertEqual(done.stderr.count(b"warning"), 1, done.stderr)
            self.assertIn(b"components of vertex colours that are negative, not numbers or above 65535 are limited (1)", done.stderr)
        self.write("n.obj", (triangle + "vn 0 0 1\nvn 0 1 0\n").encode())
        self.assertIn(b"found 2 normals for 3 points", self.good("convert", "n.obj", "n-out.ply").stderr)
        done = self.good("-", "-s", 8, "-o", "-", stdin=("hello world\n" * 40 + triangle + "f 1 2 3\n").encode())
        self.assertIn(b"standard input:1: unknown statement 'hello', the first of 40", done.stderr)
        self.bad(2, "-", "-o", "x.png", stdin=b"v for victory\n" * 40, says="unknown model format")
        self.one_sentence(self.bad(3, self.write("w.obj", b"v -3.4e38 0 0\nv 3.4e38 0 0\nv 0 3e38 0\nf 1 2 3\n"), says="a larger model cannot be drawn"))

    def test_meshlab(self):
        """MeshLab writes `Tr 1` for opaque materials: the picture is not blank, and one warning explains this."""
        mtl = b"#\n# Wavefront material file\n# Converted by Meshlab Group\n#\n\nnewmtl material_0\nKa 0.2 0.2 0.2\nKd 0.8 0.1 0.1\nKs 1 1 1\n" \
              b"%sillum 2\nNs 0.000000\n\n"
        self.write("m.obj", b"mtllib ./m.obj.mtl\nusemtl material_0\n" + b"".join(
            line + b"\n" for line in (self.folder / "cube.obj").read_bytes().split(b"\n") if not line.startswith((b"mtllib", b"usemtl"))))
        self.write("m.obj.mtl", mtl % b"")
        done = self.good("m.obj", "-s", 40, "-o", "-")
        wanted = done.stdout
        self.assertIn(b"warning: m.obj.mtl:11: with Ns 0 the highlight would cover all lit points; it is omitted", done.stderr)
        red, green, blue, alpha = pixel(read_png(wanted), 20, 24)
        self.assertTrue(red > 2 * green and red > 2 * blue and alpha == 255, (red, green, blue, alpha))  # not completely white
        self.write("m.obj.mtl", mtl % b"Tr 1.000000\n")
        done = self.good("m.obj", "-s", 40, "-o", "-")
        self.assertEqual(done.stdout, wanted)
        self.assertEqual(done.stderr.count(b"warning"), 2)
        self.assertIn(b"warning: m.obj.mtl:10: material 'material_0' is fully transparent (Tr 1); the picture would be empty, "
                      b"so everything is drawn opaque", done.stderr)
        self.good("m.obj", "-s", 40, "-o", "a.png", "--save-scene", "a.json")
        self.assertEqual((self.folder / "a.png").read_bytes(), wanted)
        self.assertEqual(self.good("a.json", "-o", "-").stdout, wanted)
        # Values given on the command line do not change.
        clear = self.good("m.obj", "-s", 40, "--opacity", 0, "-o", "-").stdout
        self.assertNotEqual(clear, wanted)

    def test_empty(self):
        for name in ("empty.obj", "empty.stl", "empty.ply", "empty"):
            self.one_sentence(self.bad(2, self.write(name, b""), says=name))
        self.bad(2, "-", stdin=b"", says="standard input")

    def test_unreadable(self):
        user = self.plain_user()
        os.chmod(self.folder / "cube.obj", 0)
        self.bad(2, "cube.obj", "-o", "-", says="cube.obj", user=user)

    def test_no_triangles(self):
        ply = b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        for name, data in (("none.obj", b"vn 0 0 1\nvt 0 0\n"), ("none.stl", b"solid none\nendsolid none\n"),
                           ("zero.stl", bytes(80) + struct.pack("<I", 0)), ("none.ply", ply)):
            self.one_sentence(self.bad(2, self.write(name, data), says=name))

    def test_cut_files(self):
        binary = bytes(80) + struct.pack("<I", 12)
        binary += b"".join(struct.pack("<12fH", 0, 0, 1, *(i % 3 for i in range(9)), 0) for _ in range(12))
        self.write("binary.stl", binary)
        for name in ("cube.stl", "cube.ply", "binary.stl"):
            data = (self.folder / name).read_bytes()
            for share in (0.3, 0.5, 0.9):
                cut = self.write("cut" + name[-4:], data[:int(len(data) * share)])
                with self.subTest(f"{name} cut at {share}"):
                    self.one_sentence(self.bad(2, cut, says=cut))

    def test_wrong_kind(self):
        self.good("cube.obj", "-s", 16, "-o", "picture.png")
        self.given.add("picture.png")
        before = (self.folder / "picture.png").read_bytes()
        done = self.run_program("picture.png")
        self.assertIn(done.returncode, (2, 3))
        self.assertIn(b"picture.png", done.stderr)
        self.assertNotIn(b"replaces", done.stderr)  # not the output of the failed picture
        self.assertEqual((self.folder / "picture.png").read_bytes(), before)
        for name, data in (("text.obj", b"Dear reader,\nthis is a letter.\n"), ("zeros.stl", bytes(1000)),
                           ("noise", bytes((i * 7919 + i * i) & 255 for i in range(2000)))):
            done = self.run_program(self.write(name, data))
            self.assertIn(done.returncode, (2, 3), name)
            self.one_sentence(done)
            self.assertEqual(self.new_files(), set())

    def test_formats_that_come_later(self):
        glb = struct.pack("<4sII", b"glTF", 3, 12 + 8 + 28) + struct.pack("<I4s", 28, b"JSON") + b'{"asset":{"version":"3.0"}} '
        self.bad(3, self.write("model.glb", glb), says="model.glb: byte 4: this is binary glTF 3.0, expected glTF 2.0")
        self.bad(3, self.write("model.blend", b"BLENDER-v279"), says="model.blend: this is a Blender file")

    def test_causes(self):
        """Each error names its own cause."""
        json_chunk = b'{"assets":{"generator":"lambent"},"scenes":[]}  '
        glb = struct.pack("<4sII", b"glTF", 2, 20 + len(json_chunk)) + struct.pack("<I4s", len(json_chunk), b"JSON") + json_chunk
        for damaged, says in ((b"gl\0F" + glb[4:], "found no binary glTF file, which begins with 'glTF'"), (b"\0" * 4 + glb[4:], "begins with 'glTF'")):
            self.bad(2, self.write("model.glb", damaged), says=says)
        done = self.bad(2, self.write("model.glb", glb[20:]))
        self.assertNotIn(b"unknown key", done.stderr)
        done = self.run_program("-", "-o", "x.png", stdin=b"junk")
        self.assertEqual(done.returncode, 2)
        self.assertNotIn(b"no built-in shape", done.stderr)
        self.write("tiny.obj", b"v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n")
        self.assertNotIn(b"light", self.run_program("tiny.obj", "--turntable", 2, "-s", 8, "-o", "t.png").stderr)

    def test_pointers_of_git_lfs(self):
        """A repository without its large files contains pointers instead. Errors and warnings say so, wherever the file is read."""
        pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:" + b"0" * 64 + b"\nsize 5970\n"
        said = "is a Git LFS pointer, not the file itself; 'git lfs pull' fetches it"
        for name in ("m.obj", "m.stl", "m.ply", "m.gltf", "m.glb", "m.3mf", "m.json", "m.fbx"):
            self.bad(2, self.write(name, pointer), says=f"{name}: {said}")
        self.bad(2, "-", stdin=pointer, says=f"standard input: {said}")
        for name in ("p.png", "p.bin", "p.mtl", "p.hdr"):
            self.write(name, pointer)
        self.bad(2, "diff", "p.png", "p.png", says=said)
        self.bad(2, "cube.obj", "--environment", "p.hdr", says=said)
        self.bad(2, self.write("b.gltf", triangle({"byteLength": 42, "uri": "p.bin"})), says=f"buffers[0].uri: p.bin: {said}")
        self.bad(2, self.write("s.json", b'{"lambent": 1, "objects": [{"file": "m.obj"}]}'), says=f"m.obj: {said}")
        inside = "data:;base64," + base64.b64encode(struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)).decode()
        face = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"
        self.write("t.mtl", b"newmtl a\nmap_Kd p.png\n")
        for model in (self.write("t.gltf", triangle({"byteLength": 42, "uri": inside}, "p.png")), self.write("t.obj", b"mtllib t.mtl\nusemtl a\n" + face),
                      self.write("l.obj", b"mtllib p.mtl\n" + face)):
            done = self.good(model, "-o", "a.png", "-s", "16")
            self.assertIn(said.encode(), done.stderr, model)

    def test_pictures_that_are_not_read(self):
        """A picture of another format is named as what it is."""
        inside = "data:;base64," + base64.b64encode(struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)).decode()
        model = self.write("t.gltf", triangle({"byteLength": 42, "uri": inside}, "p.png"))
        for data, name in ((b"II*\0", "a TIFF"), (b"MM\0*", "a TIFF"), (b"\xabKTX 20\xbb\r\n\x1a\n", "a KTX 2"),
                           (b"\0\0\0\x18ftypheic", "a HEIC"), (b"\xff\x0a", "a JPEG XL"), (b"\0\0\0\x0cJXL \r\n\x87\n", "a JPEG XL"), (b"DDS ", "a DDS"),
                           (b"8BPS", "a Photoshop"), (b"GIF89a", "a GIF")):
            self.write("p.png", data + bytes(60))
            self.bad(3, "diff", "p.png", "p.png", says=f"p.png: this is {name} picture, expected a PNG, JPEG")
            self.assertIn(f"images[0] (p.png): this is {name} picture, expected".encode(), self.good(model, "-o", "a.png", "-s", "16").stderr)
            self.bad(2, "p.png", "-o", "b.png", says=f"p.png: this is {name} picture")

    def test_bad_place_is_named(self):
        self.write("bad.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n")
        self.bad(2, "bad.obj", says="bad.obj:3")

    def test_control_characters_in_names(self):
        name = "evil\033[31m.obj"
        done = self.bad(2, name)
        self.assertNotIn(b"\033", done.stderr)


class Outputs(Case):
    def test_folder_missing(self):
        self.bad(5, "cube.obj", "-o", "no/such/place.png", says=["no/such/place.png", "folder"])

    def test_output_is_a_folder(self):
        (self.folder / "out.png").mkdir()
        self.good("cube.obj", "-o", "out.png", "-s", "16")  # pictures are written into it
        self.assertTrue((self.folder / "out.png" / "cube.png").is_file())
        (self.folder / "cube.png").mkdir()
        self.bad(5, "cube.obj", says=["cube.png", "-o"])

    def test_folder_is_a_file(self):
        self.bad(5, "cube.obj", "-o", "cube.mtl/x.png", says="cube.mtl")

    def test_folder_may_not_be_written(self):
        user = self.plain_user()
        os.chmod(self.folder, 0o555)
        try:
            self.bad(5, "cube.obj", says=["cube.png", "folder"], user=user)
        finally:
            os.chmod(self.folder, 0o755)

    def test_reported_before_the_work(self):
        # The model does not exist either; the output is checked first, before any long work.
        self.bad(5, "missing.obj", "-o", "no/x.png", says="no/x.png")

    def test_unknown_ending(self):
        for name in ("x.giff", "x.png.zip", ".png/x.bmp"):
            self.bad(3, "cube.obj", "-o", name, says=name)
        self.bad(3, "cube.obj", "-o", "x.step", says="x.step: lambent cannot write this format of models; write .glb")
        self.bad(3, "cube.obj", "-o", "x.apng", says="use .png, which contains all frames of an animation (APNG)")
        self.bad(3, "cube.obj", "-o", "part-v1.0", says="the extension .0 is not a picture format; expected .png")

    def test_full_device(self):
        with open("/dev/full", "wb") as full:
            done = self.run_program("cube.obj", "-s", 16, "-o", "-", stdout=full)
            self.assertEqual(done.returncode, 5)
            self.assertIn(b"standard output", done.stderr)
            self.bad(5, "cube.obj", "-s", 16, "-o", "/dev/full", says="/dev/full")
            for words in (("--help",), ("cube.obj", "-s", 16, "--json"), ("generate", "man")):
                done = self.run_program(*words, stdout=full)
                self.assertEqual(done.returncode, 5, words)

    def test_full_disk_leaves_nothing(self):
        # A limit on the file size simulates a full disk.
        script = f'ulimit -f 1; trap "" XFSZ; exec "{PROGRAM}" teapot -s 512 -o x.png'
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, timeout=30)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn(b"x.png", done.stderr)
        self.assertEqual(self.new_files(), set())

    def test_full_disk_keeps_the_old_picture(self):
        self.good("cube.obj", "-s", 16, "-o", "x.png")
        before = (self.folder / "x.png").read_bytes()
        script = f'ulimit -f 1; trap "" XFSZ; exec "{PROGRAM}" teapot -s 512 -o x.png'
        self.assertEqual(subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, timeout=30).returncode, 5)
        self.assertEqual((self.folder / "x.png").read_bytes(), before)

    def test_closed_pipe(self):
        done = subprocess.run(["bash", "-c", f'"{PROGRAM}" teapot -o - | head -c 10 | wc -c'], cwd=self.folder,
                              capture_output=True, timeout=30)
        self.assertEqual(done.stdout.strip(), b"10")
        self.assertEqual(self.new_files(), set())

    def test_full_file_system(self):
        """A real full disk, of 64 kB: an error message, exit 5, the old picture unchanged, and no other files; durable or not."""
        place = self.folder / "small"
        place.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", place], stderr=subprocess.DEVNULL).returncode:
            self.skipTest("this user may not mount a file system")
        self.addCleanup(subprocess.run, ["umount", place])
        self.good("cube.obj", "-s", 16, "-o", "small/x.png")
        before = (place / "x.png").read_bytes()
        for more in ([], ["--durable"], ["--sandbox", "off"]):
            self.bad(5, "teapot", "-s", 2000, "-o", "small/x.png", *more, says=["small/x.png", "No space left"])
            self.bad(5, "teapot", "-s", 2000, "-o", "small/new.png", *more, says=["small/new.png", "No space left"])
            self.assertEqual(os.listdir(place), ["x.png"])
            self.assertEqual((place / "x.png").read_bytes(), before)

    def test_durable(self):
        for words in (["cube.obj", "-s", 16, "-o", "a.png"], ["compare", "cube.obj", "--sheet", "stages", "-s", 40, "-o", "b.png"], ["materials", "-s", 60, "-o", "c.png"]):
            without = self.good(*words, "--no-captions").stdout if words[0] != "cube.obj" else self.good(*words).stdout
            name = words[-1]
            before = (self.folder / name).read_bytes()
            self.good(*words, *(["--no-captions"] if words[0] != "cube.obj" else []), "--durable")
            self.assertEqual((self.folder / name).read_bytes(), before, without)
        with open("/dev/full", "wb") as full:
            self.assertEqual(self.run_program("cube.obj", "-s", 16, "-o", "-", "--durable", stdout=full).returncode, 5)
        self.bad(5, "cube.obj", "-s", 16, "-o", "/dev/full", "--durable", says="/dev/full", leaves={"a.png", "b.png", "c.png"})

    def test_pipe_as_output(self):
        os.mkfifo(self.folder / "pipe.png")
        reader = subprocess.Popen(["cat", "pipe.png"], cwd=self.folder, stdout=subprocess.PIPE)
        self.good("cube.obj", "-s", 16, "-o", "pipe.png")
        self.assertTrue(reader.communicate(timeout=20)[0].startswith(b"\x89PNG"))

    def test_device_without_an_ending(self):
        self.good("cube.obj", "-s", 16, "-o", "/dev/null")
        done = self.good("cube.obj", "-s", 16, "-o", "/dev/stdout", "-q")
        self.assertTrue(done.stdout.startswith(b"\x89PNG"))

    def test_too_large_a_picture(self):
        self.bad(4, "cube.obj", "-s", "65535", "--memory-limit", "1G", says="65535x65535")
