# reference.py: computes pixels of a scene file independently: rays through the pixels' centres and the sums of docs/lighting.md,
# in Python's double precision, without the renderer's code. It serves test_known.py: raw colours, one sample, meshes as lists.
import math

UNLIT = (0.0, 0.0, 0.0)


def add(a, b): return tuple(x + y for x, y in zip(a, b))
def sub(a, b): return tuple(x - y for x, y in zip(a, b))
def mul(a, b): return tuple(x * y for x, y in zip(a, b))
def scale(a, s): return tuple(x * s for x in a)
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def unit(a): return scale(a, 1 / math.sqrt(dot(a, a)))
def times(m, v): return tuple(dot(row, v) for row in m)
def product(a, b): return [[dot(row, column) for column in zip(*b)] for row in a]


def step(words):
    """A transform step as a 3x3 matrix and a translation."""
    one = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    if words[0] == "translate":
        return one, tuple(words[1:])
    if words[0] == "scale":
        s = words[1:] if len(words) == 4 else words[1:] * 3
        return [[s[0], 0, 0], [0, s[1], 0], [0, 0, s[2]]], (0, 0, 0)
    x, y, z = unit(words[2:])
    c, s = math.cos(math.radians(words[1])), math.sin(math.radians(words[1]))
    k = 1 - c
    return [[c + k * x * x, k * x * y - s * z, k * x * z + s * y], [k * x * y + s * z, c + k * y * y, k * y * z - s * x],
            [k * x * z - s * y, k * y * z + s * x, c + k * z * z]], (0, 0, 0)


def placement(steps):
    """The last step in the list is applied first."""
    if steps and not isinstance(steps[0], list):
        return [steps[0:3], steps[4:7], steps[8:11]], (steps[3], steps[7], steps[11])
    matrix, move = step(["scale", 1])
    for words in steps:
        m, t = step(words)
        move = add(times(matrix, t), move)
        matrix = product(matrix, m)
    return matrix, move


def cofactors(m):
    """det(m) times the inverse transpose."""
    a, b, c = m
    return [list(cross(b, c)), list(cross(c, a)), list(cross(a, b))]


class Reference:
    def __init__(self, scene, meshes, faces=None):
        self.scene, self.faces = scene, faces
        camera = scene["camera"]
        self.eye = tuple(camera["eye"])
        self.z = unit(sub(self.eye, camera["target"]))
        self.x = unit(cross(camera.get("up", (0, 1, 0)), self.z))
        self.y = cross(self.z, self.x)
        self.width, self.height = scene["image"]["size"]
        self.ortho = camera.get("ortho_half_height")
        self.half = self.ortho or math.tan(math.radians(camera.get("fovy", 30)) / 2)
        self.objects = {o.get("name"): placement(o.get("transform", [])) for o in scene["objects"]}
        self.first = scene["objects"][0].get("name")
        self.triangles = [t for o in scene["objects"] for t in self.place(o, meshes[o["file"]])]
        self.flat_order = {id(t): i for i, t in enumerate(self.triangles)}

    def place(self, o, mesh):
        matrix, move = placement(o.get("transform", []))
        normals = cofactors(matrix)
        mirrored = -1 if dot(normals[0], matrix[0]) < 0 else 1
        front = self.material(o.get("material", {}))
        back = dict(front, **self.given(o.get("back_material", {})))
        corners = [{"p": add(times(matrix, v["p"]), move), "n": scale(unit(times(normals, v["n"])), mirrored),
                    "t": unit(times(matrix, v["t"])), "color": v.get("color", (1, 1, 1)), "alpha": v.get("alpha", 1)} for v in mesh["vertices"]]
        for face in mesh["faces"]:
            c = [corners[i] for i in face]
            normal = scale(cross(sub(c[1]["p"], c[0]["p"]), sub(c[2]["p"], c[0]["p"])), mirrored)
            yield {"corners": c, "normal": normal, "front": front, "back": back, "two_sided": o.get("two_sided", True),
                   "cull": o.get("cull", "none")}

    def given(self, material):
        if isinstance(material, str):
            material = self.scene["materials"][material]
        out = {k: material[k] for k in ("ambient", "specular", "emission", "shininess", "reflectivity", "fibre") if k in material}
        if "diffuse" in material:
            out["diffuse"] = material["diffuse"][:3]
            if len(material["diffuse"]) == 4:
                out["alpha"] = material["diffuse"][3]
        if "opacity" in material:
            out["alpha"] = out.get("alpha", 1) * material["opacity"]
        return out

    def material(self, words):
        plain = {"diffuse": (0.62,) * 3, "alpha": 1, "specular": (0.12,) * 3, "emission": UNLIT, "shininess": 32, "reflectivity": UNLIT,
                 "fibre": False}
        plain.update(self.given(words))
        plain.setdefault("ambient", plain["diffuse"])
        return plain

    # --- light

    def out_of_frame(self, light, v, point):
        frame = light.get("frame", "world")
        if frame == "camera":
            out = add(add(scale(self.x, v[0]), scale(self.y, v[1])), scale(self.z, v[2]))
            return add(self.eye, out) if point else out
        if frame == "object":
            matrix, move = self.objects[light.get("object", self.first)]
            return add(times(matrix, v), move) if point else times(matrix, v)
        return tuple(v)

    def arriving(self, light, p):
        """The direction to the light, and the fraction of the light that arrives."""
        kind = light["type"]
        place = light.get("position", [0, 0, 0])
        if kind == "directional" or (len(place) == 4 and place[3] == 0):
            way = self.out_of_frame(light, light["direction"], False) if "direction" in light else \
                scale(self.out_of_frame(light, place[:3], False), -1)
            return scale(unit(way), -1), 1
        place = place if len(place) == 3 else scale(place[:3], 1 / place[3])
        at = self.out_of_frame(light, place, True)
        way = sub(at, p)
        d = math.sqrt(dot(way, way))
        l = scale(way, 1 / d)
        a, b, c = light.get("attenuation", (1, 0, 0))
        reach = 1 / (a + b * d + c * d * d)
        if light.get("range"):
            reach *= max(min(1 - (d / light["range"]) ** 4, 1), 0)
        if kind == "point":
            return l, reach
        if "target" in light:
            axis = unit(sub(self.out_of_frame(light, light["target"], True), at))
        else:
            axis = unit(self.out_of_frame(light, light.get("direction", (0, 0, -1)), False))
        c = -dot(l, axis)
        if "outer" in light:
            inner, outer = (math.cos(math.radians(light.get(k, 0))) for k in ("inner", "outer"))
            return l, reach * min(max((c - outer) / max(0.001, inner - outer), 0), 1) ** 2
        cutoff = light.get("cutoff", 180 if "exponent" in light else 45)
        if cutoff == 180:
            return l, reach * max(c, 0) ** light.get("exponent", 0)
        return l, reach * (c ** light.get("exponent", 0) if c >= math.cos(math.radians(cutoff)) else 0)

    def lit(self, m, p, n, t, color):
        """The colour that leaves p towards the eye."""
        model, alpha = self.scene.get("reflection", "blinn-phong"), m["shininess"]
        v = self.z if self.ortho or self.scene.get("viewer") == "infinite" else unit(sub(self.eye, p))
        if model == "none":
            return mul(m["diffuse"], color)
        t = unit(sub(t, scale(n, dot(n, t))))
        ambient, diffuse, specular = tuple(self.scene.get("ambient", UNLIT)), UNLIT, UNLIT
        for light in self.scene["lights"]:
            strength = scale(light.get("color", (1, 1, 1)), light.get("intensity", 1))
            if light["type"] == "ambient":
                ambient = add(ambient, light.get("ambient", strength))
                continue
            if light["type"] == "hemisphere":
                share = 0.5 + 0.5 * dot(n, unit(self.out_of_frame(light, light.get("up", (0, 1, 0)), False)))
                ambient = add(ambient, add(scale(light["ground"], 1 - share), scale(light["sky"], share)))
                continue
            ambient = add(ambient, light.get("ambient", UNLIT))
            l, share = self.arriving(light, p)
            nl = dot(n, l)
            gate, D, S = nl > 0, max(nl, 0), 0
            if model == "blinn-phong":
                S = max(dot(n, unit(add(l, v))), 0) ** alpha
            elif model == "phong":
                S = max(dot(sub(scale(n, 2 * nl), l), v), 0) ** alpha
            elif model.startswith("kajiya-kay"):
                sin_l, sin_v = (math.sqrt(dot(x, x)) for x in (cross(t, l), cross(t, v)))
                sign = -1 if model == "kajiya-kay" else 1
                S = max(sin_l * sin_v + sign * dot(t, l) * dot(t, v), 0) ** alpha
                gate = gate or m["fibre"] or sign > 0
                D = sin_l if gate else 0
            diffuse = add(diffuse, scale(mul(m["diffuse"], light.get("diffuse", strength)), share * D))
            specular = add(specular, scale(mul(m["specular"], light.get("specular", strength)), share * S if gate else 0))
        reflected = UNLIT
        if self.faces and any(m["reflectivity"]):
            reflected = mul(m["reflectivity"], self.look(sub(scale(n, 2 * dot(n, v)), v)))
        return add(add(m["emission"], mul(add(mul(m["ambient"], ambient), diffuse), color)), add(specular, reflected))

    def look(self, r):
        """OpenGL's table, bilinear within a face; None at a seam."""
        turn = math.radians(self.scene["reflection_map"].get("rotation", 0))
        x, y, z = math.cos(turn) * r[0] - math.sin(turn) * r[2], r[1], math.sin(turn) * r[0] + math.cos(turn) * r[2]
        across = {"x": (-z, z), "y": (x, x), "z": (x, -x)}
        axis, major = max(zip("xyz", (x, y, z)), key=lambda pair: abs(pair[1]))
        minus = major < 0
        s = across[axis][minus]
        t = (-z if minus else z) if axis == "y" else -y
        size, texels = self.faces[2 * "xyz".index(axis) + minus]
        u, v = ((q / abs(major) + 1) / 2 * size - 0.5 for q in (s, t))
        i, j = math.floor(u), math.floor(v)
        if not (0 <= i < size - 1 and 0 <= j < size - 1):
            raise Seam
        u, v = u - i, v - j
        row = lambda k: add(scale(texels[k][i], 1 - u), scale(texels[k][i + 1], u))
        return add(scale(row(j), 1 - v), scale(row(j + 1), v))

    # --- pixels

    def ray(self, i, j):
        sx = (2 * (i + 0.5) / self.width - 1) * self.half * self.width / self.height
        sy = (1 - 2 * (j + 0.5) / self.height) * self.half
        out = add(scale(self.x, sx), scale(self.y, sy))
        return (add(self.eye, out), scale(self.z, -1)) if self.ortho else (self.eye, sub(out, self.z))

    def hits(self, origin, way):
        """Nearest first; None near an edge, where the result depends on the snapping of corners."""
        found = []
        for triangle in self.triangles:
            a, b, c = (corner["p"] for corner in triangle["corners"])
            e1, e2 = sub(b, a), sub(c, a)
            q = cross(way, e2)
            det = dot(e1, q)
            if det == 0:
                continue
            s = sub(origin, a)
            r = cross(s, e1)
            u, v, d = dot(s, q) / det, dot(way, r) / det, dot(e2, r) / det
            if d <= 0 or min(u, v, 1 - u - v) < -0.02:
                continue
            if min(u, v, 1 - u - v) < 0.02:
                return None
            back = dot(triangle["normal"], scale(way, -1)) < 0
            if triangle["cull"] != ("back" if back else "front"):
                found.append((d, (1 - u - v, u, v), triangle, back))
        return sorted(found, key=lambda hit: hit[0])

    def color_of(self, triangle, weights, back):
        c, shading = triangle["corners"], self.scene.get("shading", "phong")
        turned = back and triangle["two_sided"]
        m, flip = triangle["back" if turned else "front"], -1 if turned else 1
        mix = lambda values: tuple(sum(w * x for w, x in zip(weights, column)) for column in zip(*values))
        alpha = m["alpha"] * sum(w * k["alpha"] for w, k in zip(weights, c))
        if shading == "flat":
            normal = c[2]["n"] if self.scene.get("flat_normal") == "vertex" else unit(triangle["normal"])
            return self.lit(m, c[2]["p"], scale(normal, flip), c[2]["t"], c[2]["color"]), m["alpha"] * c[2]["alpha"]
        if shading == "gouraud":
            return mix([self.lit(m, k["p"], scale(k["n"], flip), k["t"], k["color"]) for k in c]), alpha
        p, n, t, color = (mix([k[key] for k in c]) for key in ("p", "n", "t", "color"))
        return self.lit(m, p, scale(unit(n), flip), t, color), alpha

    def pixel(self, i, j):
        """Red, green and blue as stored in a .pfm; None if the pixel is not comparable."""
        hits = self.hits(*self.ray(i, j))
        if not hits or any(b[0] - a[0] < 1e-4 for a, b in zip(hits, hits[1:])):
            return None
        total, clear = UNLIT, 1
        try:
            for _, weights, triangle, back in hits:
                color, alpha = self.color_of(triangle, weights, back)
                total, clear = add(total, scale(color, clear * alpha)), clear * (1 - alpha)
        except Seam:
            return None
        total = scale(total, 2 ** self.scene["image"].get("exposure", 0))
        under = self.scene["image"].get("background", (0, 0, 0, 0))
        return add(total, scale(under[:3], clear * under[3]))


class Seam(Exception):
    pass
