#!/usr/bin/env python3
"""contract.py PROGRAM [--every N] [CASE...]: tests that the shaders and the C code of `lambent shader` draw the same picture as `lambent`.

For each case the printed C code is compiled into contract_host.c, which does not link lambent. The test compares its picture with the CPU device's
picture at one sample per pixel. At least 99.9 % of the pixels differ by at most 1/255; a pixel may differ by more than 2/255 only if its 3x3
neighbourhood contains an edge of the model, an object, a side or a light's cone, or the line n.l = 0 of a light. Without a compiler, EGL or OpenGL,
the cases are skipped with a message.
"""
import ctypes
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))
PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
os.environ["LAMBENT"] = PROGRAM
from harness import read_png  # noqa: E402

SIZE = 128


# --- the model: a ring and a bowl, with normals

def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def rounded(values):
    return list(struct.unpack("%df" % len(values), struct.pack("%df" % len(values), *values)))


def decoded(x):
    """Decodes an sRGB channel to linear light."""
    return ((x + 0.055) / 1.055) ** 2.4 if x > 0.04045 else x / 12.92


def grid(columns, rows, point):
    """Returns the positions and normals of a surface, and its triangles."""
    points = [point(i / columns, j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    return points, triangles


def ring(u, v):
    a, b = 2 * math.pi * u, 2 * math.pi * v
    n = [math.cos(a) * math.cos(b), math.sin(b), -math.sin(a) * math.cos(b)]
    return [math.cos(a) * 0.7 + 0.28 * n[0], 0.28 * n[1] + 0.1, -math.sin(a) * 0.7 + 0.28 * n[2]], n


def bowl(u, v):
    """Visible from both sides; its normals point down."""
    x, z = 2.4 * u - 1.2, 1.2 - 2.4 * v
    return [x, 0.5 * (x * x + z * z) - 0.6, z], unit([x, -1, z])


class Model:
    """Two parts, each with a material; `corners` are (position, normal, color) of every triangle in the file's order."""

    def __init__(self, folder, colors=False):
        self.path = folder / ("colors.obj" if colors else "model.obj")
        lines, self.corners, base = ["mtllib model.mtl"], [], 1
        (folder / "model.mtl").write_text("newmtl red\nKa 0.2 0.1 0.1\nKd 0.8 0.3 0.2\nKs 0.6 0.6 0.6\nNs 30\n"
                                          "newmtl blue\nKa 0.1 0.1 0.3\nKd 0.2 0.4 0.8\nKs 0.3 0.3 0.3\nNs 12\nKe 0.02 0 0.05\n")
        lines.append("o model")
        for name, surface in (("red", grid(40, 20, ring)), ("blue", grid(12, 12, bowl))):
            points, triangles = surface
            made = []
            for p, n in points:
                color = [0.5 + 0.5 * math.sin(5 * p[0]), 0.5 + 0.5 * math.cos(4 * p[1]), 0.75 + 0.25 * math.sin(7 * p[2])]
                p, n, color = [["%.6f" % x for x in part] for part in (p, n, color)]
                lines.append("v " + " ".join(p + color if colors else p))
                lines.append("vn " + " ".join(n))
                linear = [decoded(math.floor(float(c) * 255 + 0.5) / 255) for c in color]
                made.append((rounded([float(x) for x in p]), [float(x) for x in n], linear + [1.0]))
            lines.append("usemtl " + name)
            for t in triangles:
                lines.append("f " + " ".join("%d//%d" % (base + k, base + k) for k in t))
                self.corners.append([made[k] for k in t])
            base += len(points)
        self.path.write_text("\n".join(lines) + "\n")


class Shape:
    """A built-in shape, as a file with few triangles, so that its triangles are known here."""

    def __init__(self, folder, name):
        self.path, points, normals, self.corners = folder / (name + ".obj"), [], [], []
        run([PROGRAM, "shape", name, "-o", self.path, "-q", "--segments", "24x12"], check=True)
        for line in self.path.read_text().splitlines():
            kind, *words = line.split() or [""]
            if kind in ("v", "vn"):
                (points if kind == "v" else normals).append(rounded([float(x) for x in words]))
            elif kind == "f":
                corners = [word.split("/") for word in words]
                corners = [(points[int(c[0]) - 1], normals[int(c[2]) - 1], [1.0] * 4) for c in corners]
                self.corners += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]


def vertices(model, contract, front):
    """Returns the vertex buffer with the contract's attributes. `front` computes the colours for the stage application."""
    names = [a["name"] for a in contract["attributes"]]
    old_flat = contract["flat"] and contract["glsl"] == "120"
    out = bytearray()
    for number, triangle in enumerate(model.corners):
        p = [corner[0] for corner in triangle]
        face = unit(cross([b - a for a, b in zip(p[0], p[1])], [b - a for a, b in zip(p[0], p[2])]))
        draw = next(d for d, run in enumerate(contract["draws"]) if run["first_triangle"] <= number < run["first_triangle"] + run["triangle_count"])
        for position, normal, color in triangle:
            given = {"position": position, "normal": face if contract["flat"] else normal,
                     "color": triangle[2][2] if old_flat else color, "provoking_position": p[2]}
            if "front_color" in names:
                given["front_color"], given["back_color"] = front(draw, p[2] if contract["flat"] else position, given["normal"], color)
            for name in names:
                out += struct.pack("%df" % len(given[name]), *given[name])
    return bytes(out)


# --- the environment: six small pictures, and the same texels as floats

def write_png(path, side, pixel):
    raw = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(side)) for y in range(side))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def make_cube(folder, side=32):
    names, floats = [], []
    for face in range(6):
        def pixel(x, y):
            return (60 + 30 * face, 40 + int(150 * (0.5 + 0.5 * math.sin(0.2 * x + face))),
                    60 + int(150 * (0.5 + 0.5 * math.cos(0.15 * y))))
        name = folder / ("face%d.png" % face)
        write_png(name, side, pixel)
        names.append(str(name))
        for y in range(side):
            for x in range(side):
                floats += [decoded(c / 255) for c in pixel(x, y)]
    (folder / "cube").write_bytes(struct.pack("%df" % len(floats), *floats))
    return ",".join(names), str(folder / "cube"), side


# --- one case

def run(words, **more):
    return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more)


def edges(picture):
    """Returns the pixels whose 3x3 neighbourhood has more than one colour."""
    width, height, data = picture
    rows = [[data[4 * (y * width + x):4 * (y * width + x) + 4] for x in range(width)] for y in range(height)]
    return {(x, y) for y in range(height) for x in range(width)
            if any(rows[v][u] != rows[y][x] for v in range(max(y - 1, 0), min(y + 2, height))
                   for u in range(max(x - 1, 0), min(x + 2, width)))}


def picture(folder, model, words):
    done = subprocess.run([PROGRAM, str(model.path), "-o", "-", "--samples", "1", "--ao", "off", "--brighten", "off", "--size", str(SIZE), *words],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert done.returncode == 0, done.stderr.decode()
    return read_png(done.stdout)


def mask_of(folder, model, words, lights):
    """Returns the pixels at edges of the model and between its sides, and at the border of each light: at n.l = 0 and at cones."""
    geometry = [w for w in words]
    mask = edges(picture(folder, model, geometry + ["--show", "facing"]))
    depth = picture(folder, model, geometry + ["--show", "depth"])
    width, height, data = depth
    for y in range(height):
        for x in range(width):
            near = [data[4 * (v * width + u)] for v in range(max(y - 1, 0), min(y + 2, height))
                    for u in range(max(x - 1, 0), min(x + 2, width))]
            if max(near) - min(near) > 6:
                mask.add((x, y))
    for light in range(lights):
        _, _, lit = picture(folder, model, geometry + ["--show", "light:%d" % (light + 1)])
        dark = bytearray()
        for i in range(width * height):
            dark += b"\0\0\0\1" if max(lit[4 * i:4 * i + 3]) == 0 else b"\1\1\1\1"
        mask |= edges((width, height, bytes(dark)))
    return mask


class Skip(Exception):
    pass


def draw(folder, name, model, words, shader_words, cube):
    base = folder / name
    made = run([PROGRAM, "shader", model.path, "--size", SIZE, *words, *shader_words, "--host", "c", "-o", base, "--json"])
    assert made.returncode == 0, made.stdout.decode()
    contract = json.loads(made.stdout[made.stdout.index(b"{"):])
    program = folder / (name + ".program")
    built = run(["cc", "-std=c11", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-Wno-unused-function", '-DHOST="%s.c"' % base, "-Wno-strict-prototypes",
                 HERE / "contract_host.c", "-o", program, "-lEGL", "-lGL"])
    if built.returncode and (b"EGL/egl.h" in built.stdout or b"cannot find -l" in built.stdout):
        raise Skip("the headers and libraries of OpenGL are not installed (packages libegl-dev, libgl-dev)")
    assert built.returncode == 0, built.stdout.decode()
    kd = [(0.8, 0.3, 0.2), (0.2, 0.4, 0.8)]

    def front(draw, position, normal, color):  # with lighting in the application: the vertex colour times the material's
        light = [a * decoded(b) for a, b in zip(color[:3], kd[draw])] + [1.0]
        return light, light
    if contract["application"]:
        library = folder / (name + ".so")
        built = run(["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-shared", "-fPIC", str(base) + ".application.c", "-o", library, "-lm"])
        assert built.returncode == 0, built.stdout.decode()
        function, four, colors = ctypes.CDLL(str(library)).light_vertex, ctypes.c_float * 4, "const float color[4]" in contract["application"]

        def front(draw, position, normal, color):
            sides = four(), four()
            function(ctypes.c_int(draw), four(*position), four(*normal), *([four(*color)] if colors else []), *sides)
            return list(sides[0]), list(sides[1])
    (folder / (name + ".vertices")).write_bytes(vertices(model, contract, front))
    drawn = run([program, contract["glsl"], SIZE, SIZE, str(base) + ".vert", str(base) + ".frag", str(base) + ".vertices",
                 str(base) + ".raw", *(cube[1:] if cube else [])],
                env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"}, timeout=600)
    if drawn.returncode == 77:
        raise Skip(drawn.stdout.decode().strip())
    assert drawn.returncode == 0, drawn.stdout.decode()
    return (folder / (name + ".raw")).read_bytes()


def compare(folder, model, words, lights, drawn, promised=()):
    """Returns the fraction of pixels within 1/255, the number of pixels beyond 2/255, and the number of those outside the mask."""
    width, height, wanted = picture(folder, model, [*words, *promised])
    far, within = [], 0
    for i in range(width * height):
        off = max(abs(a - b) for a, b in zip(wanted[4 * i:4 * i + 4], drawn[4 * i:4 * i + 4]))
        within += off <= 1
        if off > 2:
            far.append(((i % width, i // width), off))
    covered = sum(wanted[3::4]) // 255
    assert covered > width * height // 10, "the picture is nearly empty"
    outside = []
    if far:
        mask = mask_of(folder, model, words, lights)
        outside = [f for f in far if f[0] not in mask]
    return within / (width * height), len(far), outside


LIGHTS = ["--light", "point:position=2/2/3,color=#ffeedd,attenuation=1/0.1/0.02", "--light", "directional:direction=-1/-1/-0.5,color=0.3/0.3/0.4",
          "--light", "spot:position=0/3/1,target=0/0/0,cutoff=24,exponent=4,color=0.2/0.9/0.3", "--light",
          "spot:position=-2/2/2,target=0/0/0,inner=10,outer=22,range=9,color=0.3/0.4/1", "--light",
          "spot:position=2/1/-3,target=0/0/0,exponent=20,color=0.9/0.5/0.2", "--light", "hemisphere:sky=0.1/0.1/0.2,ground=0.05/0.03/0"]
# Name, options of both commands, options of `lambent shader`, model, environment.
CASES = [
    ("block", [], ["--glsl", "330"]),
    ("block-lights", LIGHTS, ["--glsl", "330"]),
    ("block-products", LIGHTS, ["--glsl", "330", "--products"]),
    ("array", LIGHTS, ["--glsl", "330", "--lights-in", "array"]),
    ("array-products", LIGHTS, ["--glsl", "330", "--lights-in", "array", "--products"]),
    ("texture", LIGHTS, ["--glsl", "330", "--lights-in", "texture"]),
    ("texture-products", LIGHTS, ["--glsl", "330", "--lights-in", "texture", "--products"]),
    ("old", LIGHTS, ["--glsl", "120"]),
    ("old-products", LIGHTS, ["--glsl", "120", "--products"]),
    ("old-flat", ["--shading", "flat", *LIGHTS], ["--glsl", "120"]),
    ("old-flat-vertex", ["--shading", "flat", "--stage", "vertex"], ["--glsl", "120"]),
    ("old-gouraud", ["--shading", "gouraud", *LIGHTS], ["--glsl", "120"]),
    ("old-colors-flat", ["--shading", "flat"], ["--glsl", "120"], "colors"),
    ("es", LIGHTS, ["--glsl", "300es"]),
    ("es-texture", LIGHTS, ["--glsl", "300es", "--lights-in", "texture"]),
    ("es-flat", ["--shading", "flat"], ["--glsl", "300es"]),
    ("es-gouraud", ["--shading", "gouraud", *LIGHTS], ["--glsl", "300es", "--products"]),
    ("flat-vertex", ["--shading", "flat", "--stage", "vertex", *LIGHTS], []),
    ("flat-fragment", ["--shading", "flat", "--stage", "fragment", *LIGHTS], []),
    ("colors", LIGHTS, [], "colors"),
    ("colors-flat", ["--shading", "flat"], [], "colors"),
    ("phong", ["--reflection", "phong", *LIGHTS], []),
    ("lambert", ["--reflection", "lambert", *LIGHTS], []),
    ("unlit", ["--reflection", "none"], []),
    ("kajiya-kay", ["--reflection", "kajiya-kay", *LIGHTS], []),
    ("kajiya-kay-lecture", ["--reflection", "kajiya-kay-lecture"], ["--glsl", "300es"]),
    ("fibre", ["--reflection", "kajiya-kay", "--material", "copper,fibre"], []),
    ("gl1", ["--gl1", "--shading", "gouraud", *LIGHTS], ["--glsl", "120"]),
    ("gl1-block", ["--gl1", "--shading", "gouraud", *LIGHTS], ["--products"]),
    ("gl1-texture", ["--gl1", "--shading", "gouraud", *LIGHTS], ["--products", "--lights-in", "texture"]),
    ("back-material", ["--back-material", "ruby", *LIGHTS], []),
    ("back-material-products", ["--back-material", "ruby", *LIGHTS], ["--products"]),
    ("back-material-texture", ["--back-material", "ruby", *LIGHTS], ["--products", "--lights-in", "texture"]),
    ("back-material-gouraud", ["--back-material", "ruby", "--shading", "gouraud"], ["--glsl", "120"]),
    ("one-sided", ["--one-sided"], []),
    ("culled", ["--cull", "back", "--view", "top"], []),
    ("orthographic", ["--projection", "orthographic", *LIGHTS], []),
    ("infinite", ["--viewer", "infinite", *LIGHTS], []),
    ("match", ["--match-highlights"], []),
    ("exposure", ["--exposure", "1"], []),
    ("passed", LIGHTS, ["--shadows"]),
    ("passed-old", LIGHTS, ["--glsl", "120", "--products", "--shadows"]),
    ("passed-texture", LIGHTS, ["--glsl", "300es", "--lights-in", "texture", "--shadows"]),
    ("raw", ["--color-mode", "raw", *LIGHTS], []),
    ("specular", ["--show", "specular", *LIGHTS], []),
    ("diffuse", ["--show", "diffuse", *LIGHTS], ["--glsl", "120"]),
    ("one-light", ["--show", "light:3", *LIGHTS], []),
    ("turned", ["--rotate", "x:40", "--view", "left"], []),
    ("application", ["--stage", "application", "--reflection", "none"], [], "colors"),
    ("environment", ["--reflectivity", "0.5"], [], "plain", "cube"),
    ("environment-old", ["--reflectivity", "0.3", "--environment-rotation", "40"], ["--glsl", "120"], "plain", "cube"),
    ("lecture", LIGHTS, ["--style", "lecture"]),
    ("lecture-studio", [], ["--style", "lecture", "--lights-in", "block"]),
    ("lecture-products", LIGHTS, ["--style", "lecture", "--products", "--glsl", "300es"]),
    ("lecture-old", ["--reflection", "phong", *LIGHTS], ["--style", "lecture", "--glsl", "120"]),
    ("lecture-old-flat", ["--shading", "flat", *LIGHTS], ["--style", "lecture", "--glsl", "120", "--products"]),
    ("lecture-flat", ["--shading", "flat", *LIGHTS], ["--style", "lecture"]),
    ("lecture-gouraud", ["--shading", "gouraud", "--reflection", "phong", *LIGHTS], ["--style", "lecture"]),
    ("lecture-lambert", ["--reflection", "lambert", "--one-sided", *LIGHTS], ["--style", "lecture", "--glsl", "300es"]),
    ("lecture-colors", ["--projection", "orthographic", *LIGHTS], ["--style", "lecture"], "colors"),
    ("lecture-colors-gouraud", ["--shading", "gouraud"], ["--style", "lecture", "--products"], "colors"),
    ("lecture-kajiya-kay", ["--reflection", "kajiya-kay", *LIGHTS], ["--style", "lecture"]),
    ("lecture-kajiya-kay-fibre", ["--reflection", "kajiya-kay", "--material", "copper,fibre"], ["--style", "lecture", "--glsl", "120", "--products"]),
    ("lecture-kajiya-kay-lecture", ["--reflection", "kajiya-kay-lecture", "--shading", "gouraud"], ["--style", "lecture", "--glsl", "300es"]),
    ("lecture-application", ["--stage", "application", *LIGHTS], ["--style", "lecture"]),
    ("lecture-application-colors", ["--stage", "application", "--reflection", "phong", *LIGHTS], ["--style", "lecture", "--glsl", "120"], "colors"),
    ("lecture-application-flat", ["--stage", "application", "--shading", "flat", *LIGHTS], ["--style", "lecture"]),
    ("lecture-environment", ["--reflectivity", "0.5"], ["--style", "lecture"], "plain", "cube"),
    ("environment-es", ["--reflectivity", "0.5", "--shading", "gouraud"], ["--glsl", "300es"], "plain", "cube"),
]


# docs/teaching.md: lecture-style shaders draw the picture of `lambent` with the same options and these.
PROMISE = ["--tone", "none", "--ao", "off"]


def main():
    words = sys.argv[2:]
    for line in run([PROGRAM, "shapes"]).stdout.decode().splitlines():
        for stage in ("application", "vertex", "fragment"):
            CASES.append(("promise-%s-%s" % (line.split()[0], stage), ["--stage", stage], ["--style", "lecture"], line.split()[0]))
    step = int(words[1]) if words[:1] == ["--every"] else 1
    chosen = CASES[::step] if step > 1 or not words else [c for c in CASES if c[0] in words]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="lambent-contract-"))
    models = {"plain": Model(folder), "colors": Model(folder, True)}
    cube = make_cube(folder)
    failed = 0
    print("1..%d" % len(chosen))
    missing = None if shutil.which("cc") else "there is no C compiler `cc` (package gcc)"
    for number, case in enumerate(chosen, 1):
        name, words, shader_words = case[:3]
        if missing:
            print("ok %d - %s # SKIP %s" % (number, name, missing), flush=True)
            continue
        named = case[3] if len(case) > 3 else "plain"
        model = models[named] = models.get(named) or Shape(folder, named)
        is_shape = isinstance(model, Shape)
        environment = cube if len(case) > 4 else None
        if environment:
            words = words + ["--reflection-map", environment[0]]
        try:
            drawn = draw(folder, name, model, words, shader_words, environment)
            within, far, outside = compare(folder, model, [w for w in words], 2 if is_shape else words.count("--light") or 4, drawn, PROMISE if is_shape else ())
            ok = within >= 0.999 and not outside
            note = "%.3f %% within 1/255, %d beyond 2/255" % (100 * within, far)
            if outside:
                note += ", away from edges: %s" % outside[:8]
        except Skip as reason:
            missing = reason
            print("ok %d - %s # SKIP %s" % (number, name, reason), flush=True)
            continue
        except (AssertionError, subprocess.TimeoutExpired) as problem:
            ok, note = False, str(problem)
        failed += not ok
        print("%s %d - %s: %s" % ("ok" if ok else "not ok", number, name, note.replace("\n", "\n# ")), flush=True)
    if failed:
        print("# the pictures are in %s" % folder)
    else:
        shutil.rmtree(folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
