# test_limits.py: limits for untrusted files: small files that claim to be huge, and each limit with its option.
import base64
import io
import itertools
import json
import math
import os
import pathlib
import resource
import struct
import subprocess
import sys
import zipfile
import zlib

from harness import Case, PROGRAM, chunk, long

BILLIONS = 4294967295
SANITIZED = b"libasan" in pathlib.Path(PROGRAM).read_bytes() or b"__asan_init" in pathlib.Path(PROGRAM).read_bytes()


def png(width, height, bits=8, color=2, data=b"\0" * 4):
    header = struct.pack(">IIBBBBB", width, height, bits, color, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")


def jpeg(width, height, progressive=False):
    return (b"\xff\xd8\xff\xdb\0\x43\0" + b"\1" * 64 + (b"\xff\xc2" if progressive else b"\xff\xc0") +
            struct.pack(">HBHHB", 17, 8, height, width, 3) + b"\1\x11\0\2\x11\0\3\x11\0" +
            b"\xff\xda\0\x0c\3\1\0\2\0\3\0\0\x3f\0" + b"\0" * 20 + b"\xff\xd9")


def exr(width, height):
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<IBBBBII", 2, 0, 0, 0, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    return (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\3") +
            attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0") +
            attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)) +
            attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0" + b"\0" * 64)


def webp(width, height):
    bits = (width - 1) | (height - 1) << 14
    body = b"WEBPVP8L" + struct.pack("<I", 12) + b"\x2f" + struct.pack("<I", bits) + b"\0" * 7
    return b"RIFF" + struct.pack("<I", len(body)) + body


PICTURES = {
    "a.png": png(65535, 65535), "wide.png": png(2147483647, 2147483647), "deep.png": png(20000, 20000, 16, 6), "text.png": png(4, 4),
    "a.jpg": jpeg(65500, 65500), "progressive.jpg": jpeg(65500, 65500, True), "small.jpg": jpeg(19000, 19000, True),
    "a.webp": webp(16384, 16384),
    "a.tga": struct.pack("<3B5x4HBB", 0, 0, 2, 0, 0, 65535, 65535, 24, 0) + b"\0" * 50,
    "packed.tga": struct.pack("<3B5x4HBB", 0, 0, 10, 0, 0, 65535, 65535, 24, 0) + b"\xff\0\0\0" * 20,
    "a.bmp": b"BM" + struct.pack("<IHHIIiiHHIIiiII", 200, 0, 0, 54, 40, 65535, 65535, 1, 24, 0, 0, 0, 0, 0, 0) + b"\0" * 40,
    "packed.bmp": b"BM" + struct.pack("<IHHIIiiHHIIiiII", 200, 0, 0, 54, 40, 65535, 65535, 1, 8, 1, 0, 0, 0, 0, 0) + b"\0" * 40,
    "a.hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 65535 +X 65535\n" + b"\2\2\x7f\xff\xff\1" * 10,
    "a.exr": exr(65535, 65535), "wide.exr": exr(2147483647, 2147483647), "a.ppm": b"P6 65535 65535 255\n" + b"\0" * 50,
    "a.pfm": b"PF\n65535 65535\n-1\n" + b"\0" * 50,
}


def gltf(**more):
    """One triangle whose positions are accessor 0; `more` replaces top-level keys or adds to them."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]}
    tree.update(more)
    return json.dumps(tree).encode()


def accessor(**more):
    return {"componentType": 5126, "count": BILLIONS, "type": "VEC3", **more}


def instances(count, **more):
    return gltf(accessors=[accessor(bufferView=0, count=3), accessor(count=count)], extensionsUsed=["EXT_mesh_gpu_instancing"],
                nodes=[{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}], **more)


def meshopt(count, mode, stride, **more):
    compressed = {"buffer": 0, "byteLength": 36, "byteStride": stride, "count": count, "mode": mode, **more}
    return gltf(extensionsUsed=["EXT_meshopt_compression"], extensionsRequired=["EXT_meshopt_compression"],
                buffers=[{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(b"\xa0" + b"\0" * 35).decode()}],
                bufferViews=[{"buffer": 0, "byteLength": count * stride, "byteStride": stride, "extensions": {"EXT_meshopt_compression": compressed}}],
                accessors=[accessor(bufferView=0, count=count)])


def varint(number):
    out = bytearray()
    while number >= 128:
        out.append(number & 127 | 128)
        number >>= 7
    return bytes(out) + bytes([number])


def draco(body, count=3):
    return gltf(extensionsUsed=["KHR_draco_mesh_compression"], extensionsRequired=["KHR_draco_mesh_compression"],
                meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
                                         "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
                buffers=[{"byteLength": len(body), "uri": "data:application/octet-stream;base64," + base64.b64encode(body).decode()}],
                bufferViews=[{"buffer": 0, "byteLength": len(body)}],
                accessors=[{"componentType": 5126, "count": count, "type": "VEC3"}, {"componentType": 5125, "count": count, "type": "SCALAR"}])


def draco_mesh(method, rest):
    return b"DRACO\2\2\1" + bytes([method]) + b"\0\0" + rest + b"\0" * 100


HUGE = (1 << 32) - 1
MODELS = {
    "index.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967295\n", "relative.obj": b"v 0 0 0\nf -4294967295 1 1\n",
    "number.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
    "ascii.ply": b"ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
    "binary.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + b"\0" * 60,
    "faces.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 4294967295\n"
                 b"property list uchar int vertex_indices\nend_header\n" + b"\0" * 60,
    "list.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                b"property list uint int vertex_indices\nend_header\n" + b"\0" * 12 + b"\xff" * 30,
    "empty.ply": b"ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
    "a.stl": b"\0" * 80 + struct.pack("<I", BILLIONS) + b"\0" * 50,
    "zeros.gltf": gltf(accessors=[accessor()]), "view.gltf": gltf(accessors=[accessor(bufferView=0)]),
    "sparse.gltf": gltf(accessors=[accessor(sparse={"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})]),
    "sparse-count.gltf": gltf(accessors=[accessor(sparse={"count": BILLIONS, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})]),
    "instances.gltf": instances(BILLIONS), "many-instances.gltf": instances(250000000),
    "buffer.gltf": gltf(buffers=[{"byteLength": 9000000000, "uri": "data:application/octet-stream;base64,AAAA"}]),
    "indices.gltf": gltf(accessors=[accessor(bufferView=0, count=3), {"componentType": 5125, "count": BILLIONS, "type": "SCALAR"}],
                         meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]),
    "meshopt.gltf": meshopt(BILLIONS, "ATTRIBUTES", 12), "meshopt-indices.gltf": meshopt(BILLIONS // 3 * 3, "TRIANGLES", 4),
    "meshopt-oct.gltf": meshopt(300000000, "ATTRIBUTES", 8, filter="OCTAHEDRAL"),
    "draco-sequential.gltf": draco(draco_mesh(0, varint(HUGE // 3) + varint(HUGE) + b"\1")),
    "draco-edgebreaker.gltf": draco(draco_mesh(1, b"\0" + varint(HUGE // 2) + varint(HUGE // 3) + b"\1" + varint(HUGE // 3) + b"\0\0")),
    "draco-valence.gltf": draco(draco_mesh(1, b"\2" + varint(HUGE // 2) + varint(HUGE // 3) + b"\1" + varint(HUGE // 3) + b"\0\0")),
    "draco-accessor.gltf": draco(draco_mesh(0, varint(1) + varint(3) + b"\1\0\1\2\1"), BILLIONS),
    "a.glb": b"glTF" + struct.pack("<III", 2, BILLIONS, BILLIONS) + b"JSON{}",
    "shape.json": json.dumps({"lambent": 1, "objects": [{"shape": "sphere", "slices": 16384, "stacks": 16384}]}).encode(),
    "image.json": json.dumps({"lambent": 1, "image": {"width": 65535, "height": 65535}, "objects": [{"shape": "cube"}]}).encode(),
}


def shared(mode, primitives=1, nodes=1, instances=0):
    """A glTF file whose primitives, nodes or instances share 24,000 indices of 100 vertices."""
    data = struct.pack("<300f", *(i * 7919 % 1000 / 1000 for i in range(300))) + struct.pack("<24000B", *(i * 37 % 100 for i in range(24000)))
    place = {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}} if instances else {}
    return gltf(buffers=[{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
                bufferViews=[{"buffer": 0, "byteLength": 1200}, {"buffer": 0, "byteOffset": 1200, "byteLength": 24000}],
                accessors=[accessor(bufferView=0, count=100), {"bufferView": 1, "componentType": 5121, "count": 24000, "type": "SCALAR"}, accessor(count=max(instances, 1))],
                meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": mode}] * primitives}], extensionsUsed=["EXT_mesh_gpu_instancing"],
                scenes=[{"nodes": list(range(nodes))}], nodes=[{"mesh": 0, "translation": [i, 0, 0], **place} for i in range(nodes)])


def pictures(files):
    """A GLB file of a triangle for each picture."""
    binary, views = struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1), [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}]
    for data in dict.fromkeys(files):
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary += data + bytes(-len(data) % 4)
    order = {data: i + 2 for i, data in enumerate(dict.fromkeys(files))}
    each = range(len(files))
    tree = json.loads(gltf(
        buffers=[{"byteLength": len(binary)}], bufferViews=views, images=[{"bufferView": order[f], "mimeType": "image/png"} for f in files],
        textures=[{"source": i} for i in each], materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in each],
        accessors=[accessor(bufferView=0, count=3), {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i} for i in each]}]))
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    return b"glTF" + struct.pack("<IIII", 2, 28 + len(text) + len(binary), len(text), 0x4e4f534a) + text + struct.pack("<II", len(binary), 0x4e4942) + binary


def package(model, **parts):
    """A 3MF file whose model part has these resources, with a triangle."""
    bytes_of = io.BytesIO()
    core, relation = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02", "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    with zipfile.ZipFile(bytes_of, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        archive.writestr("_rels/.rels", '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         f'<Relationship Target="/a.model" Id="r" Type="{relation}"/></Relationships>')
        archive.writestr("a.model", f'<model unit="millimeter" xmlns="{core}" xmlns:m="{core.replace("core/2015", "material/2015")}"><resources>{model}'
                         '<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>'
                         '<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources><build><item objectid="1"/></build></model>')
        for name, data in parts.items():
            archive.writestr(name.replace("_", "."), data)
    return bytes_of.getvalue()


class Limits(Case):
    # The system counts the peak resident memory from before exec(), so a small process starts the program and measures it.
    MEASURE = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode; "
               "u = resource.getrusage(resource.RUSAGE_CHILDREN); print(code, u.ru_utime + u.ru_stime, u.ru_maxrss / 1000)")

    def measured(self, *words, limit=None):
        """The exit code, the message, the processor time in seconds, and the peak resident memory in MB of a run."""
        done = subprocess.run([sys.executable, "-S", "-c", self.MEASURE, PROGRAM, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              preexec_fn=limit)
        code, cpu, memory = done.stdout.split()
        return int(code), done.stderr.decode(errors="replace"), float(cpu), float(memory)

    def claims(self, name, *words):
        code, text, cpu, memory = self.measured(*words)
        with self.subTest(name):
            self.assertIn(code, (2, 3, 4), f"{name}: {code} {text}")
            self.assertRegex(text, r"^lambent: (error: )?\S")
            if not SANITIZED:
                self.assertLess(cpu, 0.5, name)  # which includes some milliseconds for the program's start
                self.assertLess(memory, 150, name)

    def test_models_that_claim_too_much(self):
        for name, data in MODELS.items():
            (self.folder / name).write_bytes(data)
            self.claims(name, name, "-s", "16", "-o", "out.png")
            self.assertFalse((self.folder / "out.png").exists(), name)

    def test_pictures_that_claim_too_much(self):
        (self.folder / "one.png").write_bytes(png(1, 1))
        for name, data in PICTURES.items():
            (self.folder / name).write_bytes(data)
            # A WebP picture of one colour needs no bits for its pixels, so its size is valid; it ends at the memory limit.
            limit = ["--memory-limit", "500M"] if name == "a.webp" else []
            self.claims(name, "diff", name, name, *limit)
            self.claims(name, "cube.obj", "-s", "16", "--environment", name, "-o", "out.png", *limit)

    def unfolding(self):
        """Files below 100 kB that require much work: name, contents, and words of the error message; None: drawn."""
        corners = b" ".join(b"%d" % (i * 7 % 5 + 1) for i in range(48000))
        square = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .2 0\n"
        clear = [{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}]
        texture = {"images": [{"uri": "data:image/webp;base64," + base64.b64encode(webp(16383, 16383)).decode()}], "textures": [{"source": 0}],
                   "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]}
        textured = {"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
                    "accessors": [accessor(bufferView=0, count=3), {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}]}
        damaged = lambda i: png(8192, 8192, 1, 0, b"\0" * (8192 * 1025 - 1) + bytes([i]))[:-16] + b"\0\0\0\0" + png(1, 1)[-12:]
        (self.folder / "p.png").write_bytes(damaged(0))
        (self.folder / "spelled.mtl").write_text("".join(f"newmtl m{i}\nmap_Kd {'./' * i}p.png\n" for i in range(50)))
        lights = [{"type": "point", "position": [i, 2, 3]} for i in range(1500)]
        return {
            "polygon.obj": (square + b"f " + corners + b"\n", "layer-limit"),
            "clear.obj": (b"mtllib clear.mtl\nusemtl a\n" + square + b"f 1 2 3\n" * 11000, "layer-limit"),
            "instances.gltf": (instances(3000000), "object-limit"),
            "clear-instances.gltf": (instances(90000, materials=clear, meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}]), "cover"),
            "one-colour.gltf": (gltf(**texture, **textured), "16383×16383 pixels, expected at most"),
            "bits.gltf": (gltf(**{**texture, "images": [{"uri": "data:image/png;base64," + base64.b64encode(
                png(16000, 16000, 1, 0, bytes(2001 * 16000))).decode()}]}, **textured), "expansion-limit"),
            # One content is decoded once, however often and in whatever spelling the file names it; what is decoded and dropped again counts.
            "shared.glb": (pictures([damaged(0)] * 200), None),
            "damaged.glb": (pictures([damaged(i) for i in range(11)]), "in total, expected at most"),
            "spelled.obj": (b"mtllib spelled.mtl\n" + square + b"".join(b"usemtl m%d\nf 1 2 3\n" % i for i in range(50)), None),
            "shared.3mf": (package("".join(f'<m:texture2d id="{i}" path="/{spelling}.png" contenttype="image/png"/>'
                                           for i, spelling in enumerate(map("".join, itertools.product(*zip("abcdef", "ABCDEF"))), 2)), abcdef_png=damaged(0)), None),
            "elements.3mf": (package("<a/>" * 20000000), None),
            "primitives.gltf": (shared(4, primitives=800), "layer-limit"), "nodes.gltf": (shared(4, nodes=1000), None),
            "line-primitives.gltf": (shared(1, primitives=800), "triangles from lines and points"), "line-strips.gltf": (shared(3, primitives=800), "triangles from lines and points"),
            "line-nodes.gltf": (shared(1, nodes=1000), "triangles from lines and points"), "line-instances.gltf": (shared(1, instances=400), "triangles from lines and points"),
            "point-instances.gltf": (shared(0, instances=1000), "triangles from lines and points"), "fewer-point-instances.gltf": (shared(0, instances=150), None),
            "lights.json": (json.dumps({"lambent": 1, "objects": [{"shape": "cube"}], "lights": lights}).encode(), None),
            "spheres.json": (json.dumps({"lambent": 1, "objects": [{"shape": "sphere"}] * 1000}).encode(), "layer-limit"),
        }

    def test_large_triangles_beside_the_picture(self):
        """The walls of a room around the camera cover each pixel once."""
        room = {"lambent": 1, "objects": [{"shape": "cube"}], "camera": {"eye": [0.05, 0.1, 0.9], "target": [0.3, 0.2, -0.1], "fovy": 60, "near": 0.01, "far": 300}}
        (self.folder / "room.json").write_text(json.dumps(room))
        for size in (64, 128, 200):
            self.good("room.json", "-q", "-s", size, "-o", "-")

    @long
    def test_small_files_take_little(self):
        """No file below 100 kB takes more than 10 s of processor time or 1 GB of memory at the default size of picture."""
        (self.folder / "clear.mtl").write_text("newmtl a\nd 0.5\n")
        for name, (data, says) in self.unfolding().items():
            (self.folder / name).write_bytes(data)
            code, text, cpu, memory = self.measured(name, "-q", "-o", "out.png")
            with self.subTest(name):
                self.assertEqual(code, 4 if says else 0, text)
                self.assertIn(says or "", text)
                self.assertLess(len(data), 100000)
                if not SANITIZED:
                    self.assertLess(cpu, 10)
                    self.assertLess(memory, 1000)

    def test_small_files_end_in_time(self):
        """With higher size-dependent limits, the time limit stops the same files within half a second."""
        (self.folder / "clear.mtl").write_text("newmtl a\nd 0.5\n")
        raised = [word for name in ("object", "layer", "triangle", "expansion") for word in ("--%s-limit" % name, "2000000000")]
        for name, (data, _) in self.unfolding().items():
            if name not in ("polygon.obj", "clear.obj", "instances.gltf", "clear-instances.gltf"):
                continue
            (self.folder / name).write_bytes(data)
            code, text, cpu, _ = self.measured(name, *raised, "--time-limit", "0.2", "--threads", "2", "-q", "-o", "out.png")
            with self.subTest(name):
                self.assertEqual(code, 4, text)
                self.assertIn("--time-limit", text)
                self.assertLess(cpu, 2 * 0.7 if not SANITIZED else 10)

    def test_threads_never_decide(self):
        """Around the smallest sufficient memory limit, every number of threads gives the same exit code, message and picture: reading and drawing."""
        for i in range(24):
            side, bits, color = 256 + 16 * (i % 9), 16 if i % 3 else 8, 6 if i % 2 else 2
            row = 1 + side * bits // 8 * (4 if color == 6 else 3)
            (self.folder / f"{i}.png").write_bytes(png(side, side, bits, color, b"".join(bytes([0]) + bytes([i]) * (row - 1) for _ in range(side))))
        (self.folder / "m.mtl").write_text("".join(f"newmtl m{i}\nmap_Kd {i}.png\n" for i in range(24)))
        (self.folder / "m.obj").write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" +
                                           "".join(f"usemtl m{i}\nf 1/1 2/2 3/3\n" for i in range(24)))

        rings = [(math.cos(i / 20) * (1 + i % 3), math.sin(i / 20) * 2, i // 100) for i in range(20000)]
        (self.folder / "n.obj").write_text("".join("v %f %f %f\n" % p for p in rings) + "".join(f"f {i} {i + 1} {i + 100} {i + 99}\n" for i in range(1, 19900)))
        (self.folder / "fans.obj").write_text("".join("v %f %f %f\n" % p for p in rings[:300]) + ("f " + " ".join(map(str, range(1, 301))) + "\n") * 40)

        def answer(words, limit, threads):
            (self.folder / "m.png").unlink(missing_ok=True)
            done = subprocess.run([PROGRAM, *words, "-q", "-o", "m.png", "-j", str(threads), "--memory-limit", str(limit)], cwd=self.folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            return done.returncode, done.stderr, (self.folder / "m.png").read_bytes() if done.returncode == 0 else b""
        rows = [(("m.obj", "-s", "64"), 1000000), (("n.obj", "-s", "64"), 100000), (("fans.obj", "-s", "64"), 100000),
                (("teapot", "-s", "100", "--edges", "all"), 300000), (("torus", "-s", "64"), 100000), (("n.obj", "-s", "400", "--ao", "rays"), 300000),
                (("teapot", "-s", "300"), 200000), (("teapot", "-s", "200", "--material", "glass"), 200000)]
        for words, step in rows[:None if os.environ.get("LAMBENT_LONG") else 5]:
            low, high = 1 << 18, 1 << 26
            while high - low > step // 4:
                middle = (low + high) // 2
                low, high = (middle, high) if answer(words, middle, 1)[0] else (low, middle)
            for limit in (high - 3 * step, high - step, low, high, high + step, high + 5 * step):
                expected = answer(words, limit, 1)
                for threads in (2, 16):
                    self.assertEqual(answer(words, limit, threads), expected, (words, limit, threads))

    def test_triangles(self):
        triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 5
        (self.folder / "five.obj").write_text(triangle)
        self.good("five.obj", "-s", 8, "--triangle-limit", "5")
        os.remove(self.folder / "five.png")
        self.bad(4, "five.obj", "-s", 8, "--triangle-limit", "4", says=["five.obj", "5 triangles", "at most 4", "--triangle-limit"], leaves={"five.obj"})
        os.remove(self.folder / "five.obj")
        for ending, count in (("obj", 12), ("stl", 12), ("ply", 12)):
            if (self.folder / f"cube.{ending}").exists():
                self.bad(4, f"cube.{ending}", "-s", 8, "--triangle-limit", count - 1, says=["expected at most 11", "--triangle-limit"])
        (self.folder / "five.gltf").write_bytes(instances(5))
        self.good("five.gltf", "-s", 8, "--triangle-limit", "5", "-o", "a.png")
        os.remove(self.folder / "a.png")
        self.bad(4, "five.gltf", "-s", 8, "--triangle-limit", "4", says=["five.gltf", "5 triangles", "at most 4"], leaves={"five.gltf"})
        self.bad(4, "sphere", "--triangle-limit", "100", "-s", 8, says=["sphere", "at most 100"], leaves={"five.gltf"})

    def test_pixels_file_and_depth(self):
        (self.folder / "map.png").write_bytes(png(8, 4, data=b"\0" * 25 * 4))
        self.good("diff", "map.png", "map.png", "--pixel-limit", "32")
        self.bad(4, "diff", "map.png", "map.png", "--pixel-limit", "31", says=["map.png", "8×4", "are 32", "at most 31", "--pixel-limit"], leaves={"map.png"})
        self.bad(4, "cube.obj", "--environment", "map.png", "--pixel-limit", "31", says=["map.png", "--pixel-limit"], leaves={"map.png"})
        size = (self.folder / "cube.obj").stat().st_size
        self.bad(4, "cube.obj", "--file-limit", size - 1, says=["cube.obj", str(size), f"at most {size - 1}", "--file-limit"], leaves={"map.png"})
        self.bad(4, "-", "-o", "x.png", "--file-limit", 10, says=["standard input", "at most 10", "--file-limit"], leaves={"map.png"}, stdin=b"v 0 0 0\n" * 10)
        self.good("cube.obj", "--file-limit", size, "-s", 8)
        deep = gltf(extras=json.loads("[" * 20 + "]" * 20))
        (self.folder / "deep.gltf").write_bytes(deep)
        self.good("deep.gltf", "-s", 8, "--json-depth-limit", "21")
        os.remove(self.folder / "deep.png")
        os.remove(self.folder / "cube.png")
        self.bad(4, "deep.gltf", "-s", 8, "--json-depth-limit", "20", says=["deep.gltf", "21 deep", "at most 20", "--json-depth-limit"], leaves={"map.png", "deep.gltf"})
        # At the deepest allowed nesting, the parser's own stack is sufficient.
        (self.folder / "deep.gltf").write_bytes(gltf(extras=json.loads("[" * 900 + "]" * 900)).replace(b"[" * 800, b"[" * 1899).replace(b"]" * 800, b"]" * 1899))
        self.good("deep.gltf", "-s", 8, "--json-depth-limit", "2000")

    def test_values(self):
        for words in (("--triangle-limit", "0"), ("--pixel-limit", "none"), ("--file-limit", "none"), ("--json-depth-limit", "2001"), ("--time-limit", "no"),
                      ("--memory-limit", "no"), ("--triangle-limit", "5G")):
            self.bad(1, "cube.obj", *words, says=words[0])
        self.good("cube.obj", "-s", 8, "--memory-limit", "none", "--time-limit", "none", "--triangle-limit", "1M")
        self.bad(1, "check", "none.frag", "--memory-limit", "none", says="--memory-limit", leaves={"cube.png"})

    def test_memory_of_address_space(self):
        """The default is a quarter of RLIMIT_AS: models that do not fit are refused, and nothing crashes."""
        if SANITIZED:
            self.skipTest("sanitizers take more address space than any limit")
        limit = 2 << 30
        code, text, _, memory = self.measured("cube.obj", "-s", "12000", "-o", "a.ppm", limit=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(code, 4, text)
        self.assertIn("536.9 MB (--memory-limit)", text)
        self.assertEqual(self.new_files(), set())
        code, text, *_ = self.measured("cube.obj", "-s", "64", "-o", "a.ppm", limit=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(code, 0, text)

    def test_memory_of_a_control_group(self):
        """In a group of 512 MB, the default is 128 MB: models that do not fit are refused, so the kernel need not kill anything."""
        group = self.control_group(512 << 20)
        if SANITIZED:
            self.skipTest("sanitizers take more memory")
        enter = lambda: (group / "cgroup.procs").write_text(str(os.getpid()))
        code, text, *_ = self.measured("cube.obj", "-s", "7000", "-o", "a.ppm", limit=enter)
        self.assertEqual(code, 4, text)
        self.assertIn("134.2 MB", text)
        # 24 million numbers: the file fits into memory, the resulting data does not.
        (self.folder / "big.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 4000000 + "v 1 2 3\n" * 4000000)
        code, text, _, memory = self.measured("big.obj", "-s", "64", "-o", "a.ppm", limit=enter)
        self.assertEqual(code, 4, text)
        self.assertIn("--memory-limit", text)
        self.assertLess(memory, 512)
        code, text, *_ = self.measured("cube.obj", "-s", "1024", "-o", "a.ppm", limit=enter)
        self.assertEqual(code, 0, text)

    def control_group(self, limit):
        for base, name in ((pathlib.Path("/sys/fs/cgroup/memory"), "memory.limit_in_bytes"), (pathlib.Path("/sys/fs/cgroup"), "memory.max")):
            group = base / f"lambent-test-{os.getpid()}"
            try:
                if base.name == "memory" and not base.is_dir():
                    continue
                group.mkdir()
            except OSError:
                continue
            self.addCleanup(lambda: group.rmdir())
            try:
                (group / name).write_text(str(limit))
                return group
            except OSError:
                continue
        self.skipTest("this machine lets nobody make a control group")
