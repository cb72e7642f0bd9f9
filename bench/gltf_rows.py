"""gltf_rows.py: rows of glTF files: textured models (from the repository, and with LAMBENT_MODELS more), alone and under an environment, and GLB
files of 1 and 10 million triangles, which the bench generates. It compares whole processes with F3D (whole.py), and measures the prefilter of an
environment separately."""
import base64
import functools
import json
import math
import os
import struct

import measure
import paths
import scenes
import whole

# Textured files that both programs read (no extension that F3D 1.3 lacks).
TEXTURED = {"spot": lambda: os.path.join(paths.EXAMPLES, "spot.glb")}
UNDER_ENVIRONMENT = ["spot"]
if paths.REAL_MODELS:
    TEXTURED.update({"knight": lambda: whole.real("glb/kaykit_adventurers/Knight.glb"),
                     "normal tangent": lambda: whole.real("glb/playcanvas/NormalTangentTest.glb"),
                     "toy car": lambda: whole.real("gltf-tests/khronos/ToyCar/glTF/ToyCar.gltf")})
    UNDER_ENVIRONMENT += ["knight", "toy car"]
# the minimum ratios of F3D's CPU time to Lambent's
CPU_TARGETS = {"spot": 8, "knight": 8, "normal tangent": 6, "toy car": 6}
ENVIRONMENT_TARGETS = {"spot": 65, "knight": 65, "toy car": 45}


def environment():
    """A generated Radiance picture of a sky with a sun over a dark ground. Its rows are not compressed."""
    made, width, height = os.path.join(paths.MODELS, "sky.hdr"), 1024, 512
    if os.path.exists(made):
        return made
    os.makedirs(paths.MODELS, exist_ok=True)
    data = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
    for y in range(height):
        up = math.cos(math.pi * (y + 0.5) / height)
        color = (0.3 + 0.2 * up, 0.45 + 0.2 * up, 0.9) if up > 0 else (0.1, 0.08, 0.06)
        row = bytearray(rgbe(color) * width)
        for x in range(width // 4 - 24, width // 4 + 24) if 0.4 < up < 0.7 else ():
            distance = math.hypot(x - width // 4, y - height * 5 // 16)
            row[4 * x:4 * x + 4] = rgbe([c + 200 * math.exp(-distance * distance / 20) for c in color])
        data += row
    with open(made + ".unfinished", "wb") as file:
        file.write(data)
    os.rename(made + ".unfinished", made)
    return made


def rgbe(color):
    """Three numbers with one exponent (Ward, "Real Pixels")."""
    fraction, exponent = math.frexp(max(color))
    return bytes([int(c * fraction * 256 / max(color)) for c in color] + [exponent + 128])


def glb(triangles):
    """A sphere as .glb, made from the PLY of the same size: positions and indices, one metallic-roughness material."""
    made = os.path.join(paths.MODELS, "sphere_%d.glb" % triangles)
    if os.path.exists(made):
        return made
    with open(scenes.model(triangles, "ply"), "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    words = data[:end].decode().split()
    vertices, faces = (int(words[words.index(kind) + 1]) for kind in ("vertex", "face"))
    positions = data[end:end + 12 * vertices]
    rows, indices = data[end + 12 * vertices:], bytearray(12 * faces)
    for byte in range(12):  # rows are a count of one byte and three numbers of four
        indices[byte::12] = rows[1 + byte::13]
    places = struct.unpack("<%df" % (3 * vertices), positions)
    bounds = [(min(places[i::3]), max(places[i::3])) for i in range(3)]
    document = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.4, 0.2, 1], "metallicFactor": 0.2, "roughnessFactor": 0.5}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3",
                       "min": [low for low, _ in bounds], "max": [high for _, high in bounds]},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * faces, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions), "target": 34962},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices), "target": 34963}],
        "buffers": [{"byteLength": len(positions) + len(indices)}]}
    head = json.dumps(document, separators=(",", ":")).encode()
    head += b" " * (-len(head) % 4)
    body = positions + bytes(indices)
    with open(made + ".unfinished", "wb") as file:
        file.write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(head) + len(body), len(head), 0x4E4F534A) + head)
        file.write(struct.pack("<II", len(body), 0x004E4942) + body)
    os.rename(made + ".unfinished", made)
    return made


def chunks(path):
    """The JSON document of a .gltf or .glb, and the binary data that follows it."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"glTF":
        return json.loads(data), b""
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length]), data[28 + length:]


def pictures(path):
    """The files of a model's pictures; embedded pictures are written to files."""
    document, binary = chunks(path)
    files = []
    for number, image in enumerate(document.get("images", [])):
        uri = image.get("uri", "")
        if uri and not uri.startswith("data:"):
            files.append(os.path.join(os.path.dirname(path), uri))
            continue
        view = document["bufferViews"][image["bufferView"]] if not uri else {}
        begin = view.get("byteOffset", 0)
        data = base64.b64decode(uri.partition(",")[2]) if uri else binary[begin:begin + view["byteLength"]]
        files.append(os.path.join(paths.MODELS, "%s-%d.picture" % (os.path.basename(path), number)))
        with open(files[-1], "wb") as file:
            file.write(data)
    return files


def pair(label, path, isas, display, seconds, environment=None, decoding=False):
    """Measures one file with both programs; `path` returns the file and `environment` the environment. The result is the same as from whole.whole.
    One sample and no occlusion make the work equal, because F3D does not smooth edges and computes no occlusion.
    With `decoding`, the decoding of its pictures is also measured separately."""
    display.require()
    path, environment = path(), environment and environment()
    file_name = label.replace(" ", "-").replace(",", "")
    ours, theirs = whole.picture(file_name + "-lambent"), whole.picture(file_name + "-f3d")
    options = [*whole.F3D_WORK] + (["--environment", environment] if environment else [])
    report = measure.lambent(path, "-s", whole.SIZE, *options, "-o", ours)
    peer = whole.f3d_command(path, report, theirs, whole.SIZE) + (["--hdri=" + environment] if environment else [])

    def command(isa):
        return [paths.LAMBENT, "-q", path, "-s", str(whole.SIZE), *options, "--isa", isa, "-o", ours]
    contestants = {isa: (lambda isa=isa: measure.whole_process(command(isa), ours)) for isa in isas}
    contestants["f3d"] = lambda: display.f3d(peer, theirs)
    if decoding:
        os.makedirs(paths.MODELS, exist_ok=True)
        decode = [paths.program("decode"), *pictures(path)]
        contestants["decoding"] = lambda: measure.process(decode)
    taken = measure.in_turn(contestants, seconds)
    decoded = [t.cpu_ms for t in taken.pop("decoding", [])]
    wall = {key: [t.wall_ms for t in rounds] for key, rounds in taken.items()}
    cpu = {key: [t.cpu_ms for t in rounds] for key, rounds in taken.items()}
    besides = {"decoding_cpu_ms": measure.spread(decoded), "besides_decoding_ratio": {
        isa: measure.ratio(cpu["f3d"], [all_of_it - part for all_of_it, part in zip(cpu[isa], decoded)]) for isa in isas}} if decoding else {}
    return {"file_bytes": os.path.getsize(path), "triangles": report["model"]["triangles"], "samples": 1, **besides,
            "options": [os.path.relpath(o, paths.ROOT) if o == environment else o for o in options], "size": whole.SIZE,
            "ms": {key: measure.spread(t) for key, t in wall.items()}, "cpu_ms": {key: measure.spread(t) for key, t in cpu.items()},
            "ratio": {isa: measure.ratio(wall["f3d"], wall[isa]) for isa in isas},
            "cpu_ratio": {isa: measure.ratio(cpu["f3d"], cpu[isa]) for isa in isas}, "steps_ms": report["times_ms"],
            "besides_encoder_ms": report["times_ms"]["total"] - report["times_ms"]["encode"], "peer": "F3D"}


def rows(isas, display):
    """(name, target of the CPU time's ratio or None, target of the wall time's, function that measures)."""
    for name, path in TEXTURED.items():
        yield "glb " + name, CPU_TARGETS[name], None, functools.partial(pair, "glb " + name, path, isas, display, 3, decoding=True)
    for name in UNDER_ENVIRONMENT:
        label = "glb %s, environment" % name
        yield label, ENVIRONMENT_TARGETS[name], None, functools.partial(pair, label, TEXTURED[name], isas, display, 3, environment)
    for triangles, word, target in ((1000000, "1M", 15), (10000000, "10M", 10)):
        yield "glb " + word, None, target, functools.partial(pair, "glb " + word, functools.partial(glb, triangles), isas, display, 5)


def prefilter():
    """The additional time of a process's first frame of a square with an environment of 1024x512: prefiltering all levels, because the roughness
    varies."""
    folder = paths.MODELS
    os.makedirs(folder, exist_ok=True)
    files = {"rough.ppm": "P6 2 1 255\n" + 3 * "\x14" + 3 * "\x7a", "rough.mtl": "newmtl rough\nKd 1 0.8 0.3\nPm 1\nPr 1\nmap_Pr rough.ppm\n",
             "rough.obj": "mtllib rough.mtl\nusemtl rough\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"}
    for name, text in files.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
    sphere = [os.path.join(folder, "rough.obj"), "-s", 64, "--samples", 1, "--environment", environment()]
    picture = whole.picture("prefilter")

    def frame(*more):
        return measure.lambent(*sphere, *more, "-o", picture)["times_ms"]["frame"]
    taken = measure.in_turn({"first": frame, "without": lambda: frame("--show", "base-color")}, 3)
    over = [a - b for a, b in zip(taken["first"], taken["without"])]
    return {"ms": {name: measure.spread(t) for name, t in taken.items()}, "over_ms": measure.spread(over)}
