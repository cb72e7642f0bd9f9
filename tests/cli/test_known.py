# test_known.py: compares .pfm pictures of scene files with the same sums in double precision (reference.py).
import copy
import json
import math
import struct

from harness import Case
from reference import Reference, add, dot, scale, unit

SIZE = (20, 15)
BRASS = {"ambient": [0.33, 0.22, 0.03], "diffuse": [0.78, 0.57, 0.11], "specular": [0.99, 0.91, 0.81], "emission": [0.02, 0, 0.01], "shininess": 27.8}
POINT = {"type": "point", "position": [2, 3, 4], "ambient": [0.1, 0.05, 0.1], "diffuse": [1, 0.8, 0.9], "specular": [0.7, 1, 1],
         "attenuation": [0.5, 0.02, 0.03]}
SUN = {"type": "directional", "direction": [-1, -2, -1], "color": [1, 0.8, 0.5], "intensity": 0.8}
TURNED = [["translate", 0.1, 0.2, 0], ["rotate", 30, 0.2, 0, 1], ["scale", 0.7, 1.3, 1], ["rotate", -50, 0, 1, 0]]


def ball(around=7, along=5, colors=None):
    """An open piece of a sphere with both sides visible."""
    vertices, faces = [], []
    for j in range(along + 1):
        for i in range(around + 1):
            theta, phi = 0.5 + 2.1 * j / along, 4.4 * i / around
            n = (math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi))
            v = {"p": n, "n": n, "t": (-math.sin(phi), 0.0, -math.cos(phi))}
            if colors:
                v["color"] = (i / around, 1 - j / along, 0.5)
                v["alpha"] = 0.2 + 0.7 * j / along
            vertices.append(v)
    for j in range(along):
        for i in range(around):
            a, b = j * (around + 1) + i, (j + 1) * (around + 1) + i
            faces += [(a, b, b + 1), (a, b + 1, a + 1)]
    return {"vertices": vertices, "faces": faces}


def plane(n=(0, 0, 1)):
    corners = [(-1.3, -1.0, 0.0), (1.3, -1.0, 0.0), (1.3, 1.0, 0.0), (-1.3, 1.0, 0.0)]
    return {"vertices": [{"p": p, "n": n, "t": (1, 0, 0)} for p in corners], "faces": [(0, 1, 2), (0, 2, 3)]}


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


class Known(Case):
    def write_mesh(self, name, mesh):
        """Rounded to floats, as in the reference."""
        colored = "color" in mesh["vertices"][0]
        for v in mesh["vertices"]:
            for key in v:
                v[key] = single(v[key]) if key == "alpha" else tuple(single(x) for x in v[key])
        keys = ["p", "n", "t"] + (["color"] if colored else [])
        names = ["x", "y", "z", "nx", "ny", "nz", "tx", "ty", "tz"] + (["red", "green", "blue", "alpha"] if colored else [])
        lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh['vertices'])}", *(f"property float {n}" for n in names),
                 f"element face {len(mesh['faces'])}", "property list uchar int vertex_indices", "end_header"]
        for v in mesh["vertices"]:
            numbers = [x for key in keys for x in v[key]] + ([v["alpha"]] if colored else [])
            lines.append(" ".join("%.9g" % x for x in numbers))
        lines += ["3 %d %d %d" % face for face in mesh["faces"]]
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def agree(self, scene, meshes, faces=None, most=2e-4, mean=2e-6, least=SIZE[0] * SIZE[1] // 13):
        scene = copy.deepcopy(scene)
        scene = {"lambent": 1, "image": {}, "camera": {"eye": [0.4, 1.1, 4.2], "target": [0.1, 0, 0], "up": [0, 1, 0], "fovy": 38, "near": 0.5, "far": 50},
                 "reflection": "blinn-phong", "ambient": [0.1, 0.2, 0.15], **scene}
        scene["image"] = {"size": list(SIZE), "samples": 1, "color": "raw", "background": [0.2, 0.1, 0.4, 0.5], **scene["image"]}
        scene["lights"] = scene.get("lights", [POINT, SUN])
        for o in scene["objects"]:
            o.setdefault("file", "ball.ply")
            o.setdefault("material", BRASS)
        (self.folder / "s.json").write_text(json.dumps(scene))
        for name, mesh in meshes.items():
            self.write_mesh(name, mesh)
        self.good("s.json", "-q", "-o", "s.pfm")
        head, size, _, data = (self.folder / "s.pfm").read_bytes().split(b"\n", 3)
        numbers = struct.unpack(f"<{SIZE[0] * SIZE[1] * 3}f", data)
        reference = Reference(scene, meshes, faces)
        largest = total = counted = 0
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                want = reference.pixel(i, j)
                if not want:
                    continue
                at = 3 * ((SIZE[1] - 1 - j) * SIZE[0] + i)
                counted += 1
                for got, x in zip(numbers[at:at + 3], want):
                    largest = max(largest, abs(got - x))
                    total += abs(got - x)
        self.assertGreaterEqual(counted, least, scene)
        self.assertLessEqual(largest, most, scene)
        self.assertLessEqual(total / (3 * counted), mean, scene)

    def test_lights(self):
        frames = [{"frame": "world"}, {"frame": "camera"}, {"frame": "object"}, {"frame": "object", "object": "other"}]
        spots = [{"cutoff": 25, "exponent": 8}, {"exponent": 12}, {"inner": 10, "outer": 28}, {"outer": 20}, {"cutoff": 90, "exponent": 3},
                 {"cutoff": 180, "exponent": 2}, {}, {"cutoff": 30}]
        objects = [{"name": "ball", "transform": TURNED}, {"name": "other", "transform": [["translate", -0.5, 0, -2], ["scale", 2, 1, 0.5]], "two_sided": False}]
        mesh = {"ball.ply": ball()}
        for frame in frames:
            self.agree({"objects": objects, "lights": [{**POINT, **frame}]}, mesh)
            self.agree({"objects": objects, "lights": [{**SUN, **frame}, {**SUN, "direction": [1, -0.5, 0.2], "color": [0.1, 0.2, 1], **frame}]}, mesh)
        for i, spot in enumerate(spots):
            light = {"type": "spot", "position": [0.2, 1, 3], "direction": [0, -0.3, -1], "attenuation": [0, 0.1, 0.1], "range": 9, **spot,
                     **frames[i % 4]}
            if light["frame"] == "camera":
                light.update(position=[0.3, 0.2, 0.5], direction=[0, 0, -1])
            self.agree({"objects": objects, "lights": [light]}, mesh)
        self.agree({"objects": objects, "lights": [{"type": "spot", "position": [2, 2, 2, 0.5], "target": [0.1, 0.2, 0], "exponent": 20}]}, mesh)
        self.agree({"objects": objects, "lights": [{"type": "point", "position": [4, 6, 8, 2]}, {"type": "directional", "position": [1, 1, 1, 0]}]}, mesh)
        self.agree({"objects": objects, "lights": [{"type": "ambient", "color": [0.3, 0.1, 0.2], "intensity": 2},
                                                   {"type": "hemisphere", "sky": [0.3, 0.4, 0.6], "ground": [0.2, 0.1, 0], "up": [0.2, 1, 0.1]}]}, mesh)

    def test_methods(self):
        for shading in ("flat", "gouraud", "phong", "smooth", "normal"):
            plain = {"smooth": "gouraud", "normal": "phong"}.get(shading, shading)
            for reflection in ("none", "lambert", "phong", "blinn-phong", "kajiya-kay", "kajiya-kay-lecture"):
                if shading != plain and reflection != "phong":
                    continue
                self.agree({"objects": [{"transform": TURNED}], "shading": plain, "reflection": reflection}, {"ball.ply": ball()})
        self.agree({"objects": [{}], "shading": "flat", "flat_normal": "vertex"}, {"ball.ply": ball()})
        self.agree({"objects": [{}], "viewer": "infinite"}, {"ball.ply": ball()})
        for shininess, factor in ((0, 1), (1, 1), (128, 1), (1000, 8)):
            self.agree({"objects": [{"material": {**BRASS, "shininess": shininess}}]}, {"ball.ply": ball()}, most=2e-4 * factor, mean=2e-6 * factor)
        self.agree({"objects": [{"material": {**BRASS, "fibre": True}}], "reflection": "kajiya-kay"}, {"ball.ply": ball()})
        self.agree({"objects": [{}], "image": {"exposure": -1.25}}, {"ball.ply": ball()})

    def test_sides(self):
        back = {"diffuse": [0.8, 0.2, 0.2], "shininess": 5}
        mesh = {"ball.ply": ball()}
        for shading in ("flat", "gouraud", "phong"):
            for turn in (TURNED, [["scale", 1, -1.2, 0.8]], [["rotate", 100, 0, 1, 0], ["scale", -1]]):
                for two_sided in (True, False):
                    self.agree({"objects": [{"transform": turn, "back_material": back, "two_sided": two_sided}], "shading": shading}, mesh)
        for cull in ("back", "front"):
            self.agree({"objects": [{"cull": cull, "back_material": back, "transform": [["rotate", 60, 0, 1, 0]]}]}, mesh)
        self.agree({"objects": [{"transform": [1, 0.2, 0, 0.1, 0, 1.1, 0.3, 0, 0.1, 0, 0.8, 0.2, 0, 0, 0, 1]}]}, mesh)

    def test_orthographic(self):
        camera = {"eye": [1.4, 1.1, 4.2], "target": [0.1, 0, 0], "up": [0.1, 1, 0], "ortho_half_height": 1.3, "near": 0.5, "far": 50}
        spot = {"type": "spot", "frame": "camera", "position": [0.3, 0.2, 1], "direction": [0, 0, -1], "cutoff": 25, "exponent": 8}
        for shading in ("flat", "gouraud", "phong"):
            self.agree({"objects": [{"transform": TURNED}], "camera": camera, "shading": shading, "lights": [POINT, spot]}, {"ball.ply": ball()})

    def test_translucent(self):
        glass = {**BRASS, "diffuse": [0.2, 0.4, 0.8, 0.5]}
        meshes = {"plane.ply": plane(), "ball.ply": ball()}
        crossing = [{"file": "plane.ply", "name": "a", "material": glass, "transform": [["rotate", 35, 0, 1, 0]]},
                    {"file": "plane.ply", "name": "b", "material": {**BRASS, "opacity": 0.3}, "transform": [["rotate", -40, 0, 1, 0.2], ["scale", 0.8, 0.8, 1]]},
                    {"file": "plane.ply", "name": "c", "material": BRASS, "transform": [["translate", 0, 0, -2], ["scale", 1.4]]}]
        for shading in ("flat", "gouraud", "phong"):
            self.agree({"objects": crossing, "shading": shading}, meshes)
            self.agree({"objects": crossing[::-1], "shading": shading}, meshes)
            self.agree({"objects": [{"material": glass, "transform": TURNED, "back_material": {"diffuse": [0.9, 0.1, 0.1, 0.25]}}], "shading": shading}, meshes)
            self.agree({"objects": [{"material": glass, "transform": TURNED, "two_sided": False}], "shading": shading, "image": {"background": [0, 0, 0, 0]}}, meshes)
            self.agree({"objects": [{"material": {**BRASS, "diffuse": [0.7, 0.6, 0.5, 0.9]}}], "shading": shading}, {"ball.ply": ball(colors=True)})
        self.agree({"objects": [{}]}, {"ball.ply": ball(colors=True)})

    def test_environment(self):
        faces, names = [], []
        for face in range(6):
            size = 24
            texels = [[tuple(int(127.5 + 60 * math.sin(0.13 * (s + 2 * face) + k) + 60 * math.cos(0.11 * t * (k + 1) + face)) / 255 for k in range(3))
                       for s in range(size)] for t in range(size)]
            names.append(f"f{face}.ppm")
            (self.folder / names[-1]).write_bytes(b"P6\n%d %d\n255\n" % (size, size) + bytes(round(x * 255) for row in texels for c in row for x in c))
            faces.append((size, texels))
        mirror = {**BRASS, "reflectivity": [0.5, 0.7, 0.9]}
        for rotation in (0, 65, -200):
            for shading in ("phong", "gouraud", "flat"):
                objects = [{"material": mirror, "transform": TURNED, "back_material": {"reflectivity": [0.9, 0.1, 0.2]}}]
                self.agree({"objects": objects, "shading": shading, "reflection_map": {"faces": names, "rotation": rotation}}, {"ball.ply": ball()}, faces,
                           5e-4, 5e-6, 25)
        camera = {"eye": [1.4, -1.1, 4.2], "target": [0.1, 0, 0], "ortho_half_height": 1.3, "near": 0.5, "far": 50}
        glass = {**mirror, "diffuse": [0.2, 0.4, 0.8, 0.5]}
        self.agree({"objects": [{"material": glass, "two_sided": False}], "camera": camera, "reflection_map": {"faces": names, "rotation": 20}},
                   {"ball.ply": ball()}, faces, 5e-4, 5e-6, 25)


    def test_converges(self):
        """With twice as many segments, the error of a sphere falls by a factor of 4, and by 2 with one colour per triangle."""
        matte = {**BRASS, "shininess": 10}
        lamp = {"type": "point", "position": [1.5, 2.2, 5], "attenuation": [0.5, 0.02, 0.03], "diffuse": [1, 0.8, 0.9], "specular": [0.7, 1, 1]}
        for shading, factor in (("flat", 2), ("gouraud", 4), ("phong", 4)):
            errors = []
            for segments in (24, 48, 96):
                scene = {"lambent": 1, "image": {"size": list(SIZE), "samples": 1, "color": "raw"}, "shading": shading, "lights": [lamp],
                         "camera": {"eye": [0.4, 1.1, 4.2], "target": [0.1, 0, 0], "fovy": 25}, "ambient": [0.1, 0.2, 0.15],
                         "objects": [{"shape": "sphere", "slices": 2 * segments, "stacks": segments, "material": matte}]}
                (self.folder / "s.json").write_text(json.dumps(scene))
                self.good("s.json", "-q", "-o", "s.pfm")
                data = (self.folder / "s.pfm").read_bytes().split(b"\n", 3)[3]
                numbers = struct.unpack(f"<{SIZE[0] * SIZE[1] * 3}f", data)
                exact = Reference({**scene, "objects": [{"file": "none"}]}, {"none": {"vertices": [], "faces": []}})
                off = []
                for j in range(SIZE[1]):
                    for i in range(SIZE[0]):
                        origin, way = exact.ray(i, j)
                        way = unit(way)
                        b = dot(origin, way)
                        under = b * b - dot(origin, origin) + 1
                        if under < 0.1:  # outside the ball, or so close to its outline that the outline of the triangles decides
                            continue
                        p = add(origin, scale(way, -b - math.sqrt(under)))
                        want = exact.lit(exact.material(matte), p, p, (0.3, 0.5, -0.8), (1, 1, 1))
                        at = 3 * ((SIZE[1] - 1 - j) * SIZE[0] + i)
                        off += [abs(got - x) for got, x in zip(numbers[at:at + 3], want)]
                self.assertGreater(len(off), 300)
                errors.append(sum(off) / len(off))
            for coarse, fine in zip(errors, errors[1:]):
                self.assertGreater(coarse / fine, 0.85 * factor, (shading, errors))
                self.assertLess(coarse / fine, 1.2 * factor, (shading, errors))
