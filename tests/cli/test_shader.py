# test_shader.py: the command `shader`: its outputs, its contract and its errors. tests/gl/contract.py draws with the shaders.
import base64
import ctypes
import json
import math
import re
import shutil
import struct
import subprocess
import unittest

from harness import Case, read_png


def uniforms_of(contract):
    return contract["uniforms"] + [u for draw in contract["draws"] for u in draw["uniforms"]]


# --- a small rasterizer, which draws Gouraud-shaded triangles from their vertex colours

def decoded(x):
    return ((x + 0.055) / 1.055) ** 2.4 if x > 0.04045 else x / 12.92


def encoded(x):
    x = min(max(x, 0.0), 1.0)
    return math.floor(255 * (1.055 * x ** (1 / 2.4) - 0.055 if x > 0.0031308 else 12.92 * x) + 0.5)


def read_obj(text):
    """The corners (position, normal, linear colour) of each triangle, and the name of its material, in the file's order."""
    points, colors, normals, triangles, material = [], [], [], [], ""
    for line in text.splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            points.append([float(x) for x in words[:3]])
            colors.append([decoded(math.floor(float(x) * 255 + 0.5) / 255) for x in words[3:6]] + [1.0])
        elif kind == "vn":
            normals.append([float(x) for x in words])
        elif kind == "usemtl":
            material = words[0]
        elif kind == "f":
            at = [[int(x) - 1 if x else 0 for x in word.split("/")] for word in words]
            corners = [(tuple(points[a[0]]), tuple(normals[a[-1]]), tuple(colors[a[0]])) for a in at]
            triangles += [(material, (corners[0], corners[k], corners[k + 1])) for k in range(1, len(corners) - 1)]
    return triangles


def tangent_of(normal):
    """A direction perpendicular to the normal."""
    x, y, z = normal
    t = [y * 0.5 - z * 0.8, z * 0.3 - x * 0.5, x * 0.8 - y * 0.3]
    return tuple(c / math.sqrt(sum(d * d for d in t)) for c in t)


def cover(positions, matrix, size):
    """The pixels whose centres a triangle covers: (x, y), the weights of its corners, the centre's distance from the edge, the depth, and whether the
    front is visible."""
    clip = [[sum(matrix[4 * k + row] * (p + (1,))[k] for k in range(4)) for row in range(4)] for p in positions]
    assert all(c[3] > 0 for c in clip)
    window = [((c[0] / c[3] + 1) * size / 2, (1 - c[1] / c[3]) * size / 2, c[2] / c[3]) for c in clip]
    (ax, ay, _), (bx, by, _), (cx, cy, _) = window
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return
    for y in range(max(math.floor(min(ay, by, cy)), 0), min(math.ceil(max(ay, by, cy)) + 1, size)):
        for x in range(max(math.floor(min(ax, bx, cx)), 0), min(math.ceil(max(ax, bx, cx)) + 1, size)):
            px, py = x + 0.5, y + 0.5
            u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area
            v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area
            bary = (u, v, 1 - u - v)
            if min(bary) < -0.02:
                continue
            shares = [b / c[3] for b, c in zip(bary, clip)]
            yield (x, y), [s / sum(shares) for s in shares], min(bary), sum(b * w[2] for b, w in zip(bary, window)), area < 0


LIGHTS = ["--light", "point:position=2/2/3,color=#ffeedd,attenuation=1/0.1/0.02", "--light", "directional:direction=-1/-1/-0.5,color=0.3/0.3/0.4",
          "--light", "spot:position=0/3/1,target=0/0/0,cutoff=24,exponent=4,color=0.2/0.9/0.3", "--light",
          "spot:position=-2/2/2,target=0/0/0,inner=10,outer=22,range=9,color=0.3/0.4/1", "--light",
          "spot:position=2/1/-3,target=0/0/0,exponent=20,color=0.9/0.5/0.2", "--light", "hemisphere:sky=0.1/0.1/0.2,ground=0.05/0.03/0"]


class Shader(Case):
    def contract(self, *words):
        return json.loads(self.good("shader", *words, "--json").stdout)

    def test_standard_output_has_everything(self):
        text = self.good("shader", "cube.obj", "--host", "c").stdout.decode()
        parts = re.findall(r"(?m)^// ===== (.*) =====$", text)
        self.assertEqual(parts, ["vertex shader", "fragment shader", "inputs", "host code"])
        self.assertEqual(text.count("#version 330 core"), 2)
        self.assertIn("Blinn (1977)", text)
        self.assertIn("model_view_projection", text)

    def test_without_a_model_the_switches_decide(self):
        text = self.good("shader", "--reflection", "phong", "--glsl", "300es").stdout.decode()
        self.assertIn("#version 300 es", text)
        self.assertEqual(self.good("shader", "--reflection", "phong", "--glsl", "300 es").stdout.decode(), text)
        self.assertIn("Phong (1975)", text)
        self.assertNotIn("Blinn", text)

    def test_lecture_style(self):
        for words in ((), ("--glsl", "120", "--reflection", "phong"), ("--glsl", "300es", "--products"), ("--shading", "gouraud"), ("--shading", "flat"),
                      ("--stage", "application")):
            with self.subTest(words):
                full, lecture = self.contract("sphere", "--lights-in", "array", *words), self.contract("sphere", "--style", "lecture", *words)
                for key in ("attributes", "uniforms", "draws", "lights_in", "flat"):
                    self.assertEqual(lecture[key], full[key])
                for stage in ("vertex", "fragment"):
                    text = re.split(r"\n(?=(?:layout|attribute|in|flat|varying|out) )", lecture[stage], maxsplit=1)[1]
                    lines = [line for line in text.splitlines() if line.strip() and not line.strip().startswith("//") and line.strip() not in "{}"]
                    self.assertLessEqual(len(lines), 42, text)
                    self.assertLess(len(lecture[stage]), len(full[stage]) + 300)

    def test_lecture_style_says_which_picture_it_draws(self):
        for words in ((), ("--stage", "application"), ("-o", "a")):
            self.assertIn("same picture with these options and --tone none --ao off", self.good("shader", "teapot", "--style", "lecture", *words).stdout.decode())
        self.given |= {"a.vert", "a.frag"}

    def test_lecture_style_refuses_what_it_does_not_have(self):
        for words, option in ((("--reflection", "ggx"), "reflection"), (("--gl1", "--shading", "gouraud"), "gl1"), (("--shadows",), "shadows"), (("--exposure", "1"), "exposure"),
                              (("--tone", "aces"), "tone"), (("--back-material", "gold"), "back-material"), (("--show", "diffuse"), "show"), (("--lights-in", "texture"), "lights-in")):
            with self.subTest(words):
                self.bad(3, "shader", "sphere", "--style", "lecture", *words, says=("'--style lecture' does not support '--" + option, "'--style full'"))
        (self.folder / "red.ppm").write_bytes(b"P6\n2 1\n255\nabcdef")
        (self.folder / "a.mtl").write_text("newmtl a\nmap_Kd red.ppm\n")
        (self.folder / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
        self.bad(3, "shader", "a.obj", "--style", "lecture", says="does not support textures", leaves=("red.ppm", "a.mtl", "a.obj"))

    # --- the C function of the application stage

    def model(self, colors=False, materials=False, transform=None, tangents=False):
        """Writes a knot with normals; returns its file and its triangles."""
        self.good("shape", "torus-knot", "--segments", "36x8", "-o", "plain.obj", "-q")
        lines, count = [], 0
        for line in (self.folder / "plain.obj").read_text().splitlines():
            count += line.startswith("v ")
            if line.startswith("vt "):
                continue
            if line.startswith("f "):
                line = re.sub(r"/\d*/", "//", line)
            if colors and line.startswith("v "):
                line += " %.3f %.3f %.3f" % (0.5 + 0.5 * math.sin(count), 0.5 + 0.5 * math.cos(3 * count), 0.7)
            lines.append(line)
        if materials:
            (self.folder / "m.mtl").write_text("newmtl red\nKa 0.2 0.1 0.1\nKd 0.8 0.3 0.2\nKs 0.6 0.6 0.6\nNs 30\n"
                                               "newmtl blue\nKa 0.1 0.1 0.3\nKd 0.2 0.4 0.8\nKs 0.3 0.3 0.3\nNs 12\nKe 0.02 0 0.05\n")
            faces = [i for i, line in enumerate(lines) if line.startswith("f ")]
            lines[faces[len(faces) // 2]:faces[len(faces) // 2]] = ["usemtl blue"]
            lines[faces[0]:faces[0]] = ["usemtl red"]
            lines[:0] = ["mtllib m.mtl"]
        (self.folder / "m.obj").write_text("\n".join(lines) + "\n")
        triangles = read_obj("\n".join(lines))
        if transform:
            (self.folder / "m.json").write_text(json.dumps({"lambent": 1, "objects": [{"file": "m.obj", "transform": transform}]}))
            return "m.json", triangles
        if not tangents:
            return "m.obj", triangles
        corners = [corner for _, corners in triangles for corner in corners]
        parts = [(5126, "VEC3", [c[0] for c in corners]), (5126, "VEC3", [c[1] for c in corners]), (5126, "VEC4", [(*tangent_of(c[1]), 1.0) for c in corners])]
        (self.folder / "m.bin").write_bytes(b"".join(struct.pack("<%df" % len(v), *v) for _, _, values in parts for v in values))
        views, accessors, at = [], [], 0
        for number, (kind, shape, values) in enumerate(parts):
            size = 4 * sum(map(len, values))
            views.append({"buffer": 0, "byteOffset": at, "byteLength": size})
            accessors.append({"bufferView": number, "componentType": kind, "count": len(values), "type": shape})
            at += size
        accessors[0].update({"min": [min(c[0][k] for c in corners) for k in range(3)], "max": [max(c[0][k] for c in corners) for k in range(3)]})
        (self.folder / "m.gltf").write_text(json.dumps(
            {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "buffers": [{"uri": "m.bin", "byteLength": at}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2}}]}], "bufferViews": views, "accessors": accessors}))
        return "m.gltf", triangles

    def light_vertex(self, contract, strict=True):
        """Compiles the printed C function and returns it as a Python function: (draw, position, normal, color) to its front and back colour."""
        (self.folder / "lit.c").write_text(contract["application"])
        library = self.folder / ("lit%d.so" % len(list(self.folder.glob("lit*.so"))))
        words = ["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", *(["-Werror"] if strict else [])]
        built = subprocess.run([*words, "-shared", "-fPIC", "lit.c", "-o", library, "-lm"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual((built.returncode, built.stdout.decode() if strict else ""), (0, ""), built.stdout.decode() + contract["application"])
        function, floats = ctypes.CDLL(str(library)).light_vertex, ctypes.c_float * 4
        names = [a["name"] for a in contract["attributes"]]
        known = {}

        def colors_of(number, position, normal, color):
            key = (number, position, normal, color)
            if key not in known:
                front, back = floats(), floats()
                arguments = [floats(*position), floats(*normal)]
                arguments += [floats(*tangent_of(normal))] if "const float tangent[3]" in contract["application"] else []
                arguments += [floats(*color)] if "const float color[4]" in contract["application"] else []
                function(ctypes.c_int(number), *arguments, front, *([back] if "back_color" in names else []))
                known[key] = tuple(front), tuple(back)
            return known[key]
        return colors_of

    def compare(self, model, triangles, *words, size=96):
        """Draws with the colours of the C function; returns the fraction of compared pixels, and the largest difference."""
        words = [model, "--size", str(size), *words]
        contract = self.contract(*words, "--style", "lecture", "--stage", "application")
        colors_of = self.light_vertex(contract)
        nearest, edges = {}, {}
        for number, draw in enumerate(contract["draws"]):
            matrix = next(u["value"] for u in draw["uniforms"] if u["name"] == "model_view_projection")
            for _, corners in triangles[draw["first_triangle"]:draw["first_triangle"] + draw["triangle_count"]]:
                for at, weights, inside, depth, front in cover([c[0] for c in corners], matrix, size):
                    if inside < 0.02:
                        edges[at] = min(depth, edges.get(at, 2))
                    if depth < nearest.get(at, (2,))[0]:
                        nearest[at] = depth, number, corners, weights, front == (draw["front"] == "counter-clockwise")
        done = self.good(*words, "--stage", "application", "--samples", "1", "--tone", "none", "--ao", "off", "-o", "-")
        _, _, wanted = read_png(done.stdout)
        compared, largest = 0, 0
        for (x, y), (depth, number, corners, weights, front) in nearest.items():
            if edges.get((x, y), 2) <= depth + 1e-3:
                continue
            sides = [colors_of(number, *corner)[0 if front else 1] for corner in corners]
            color = [sum(w * side[k] for w, side in zip(weights, sides)) for k in range(4)]
            got = [encoded(c) for c in color[:3]] + [math.floor(255 * color[3] + 0.5)]
            largest = max(largest, *(abs(a - b) for a, b in zip(got, wanted[4 * (y * size + x):])))
            compared += 1
        return compared / (sum(wanted[3::4]) / 255), largest

    @unittest.skipUnless(shutil.which("cc"), "there is no C compiler `cc` (package gcc)")
    def test_application_stage(self):
        """The C function compiles without a warning, and its colours give the picture of Gouraud shading."""
        for model, words in (({}, []), ({}, LIGHTS), ({}, ["--reflection", "phong", "--view", "back", *LIGHTS]),
                             ({}, ["--reflection", "lambert", "--one-sided", "--light", "directional:direction=-1/-1/-1"]),
                             ({}, ["--viewer", "infinite", "--light", "directional:direction=-1/-1/-1", "--view", "top"]),
                             ({}, ["--rig", "none", "--light", "ambient"]), ({}, ["--light", "spot:position=1/2/3,cutoff=30"]),
                             ({}, ["--reflection", "kajiya-kay", *LIGHTS]), ({}, ["--reflection", "kajiya-kay-lecture", "--view", "left"]),
                             ({}, ["--reflection", "kajiya-kay", "--material", "copper,fibre"]),
                             ({"transform": [["scale", 1, 2, 1]]}, ["--projection", "orthographic", "--rotate", "x:40", *LIGHTS]),
                             ({"colors": True}, LIGHTS), ({"materials": True}, LIGHTS), ({"tangents": True}, ["--reflection", "kajiya-kay", *LIGHTS]),
                             ({"transform": [["scale", -1, 1, 1]]}, ["--reflection", "phong", "--light", "point:attenuation=1/0/0.1"])):
            with self.subTest(words):
                share, largest = self.compare(*self.model(**model), *words)
                self.assertGreater(share, 0.4)
                self.assertLessEqual(largest, 1)

    @unittest.skipUnless(shutil.which("cc"), "there is no C compiler `cc` (package gcc)")
    def test_application_stage_of_flat_shading_is_lit_where_its_normal_says(self):
        _, triangles = self.model()
        contract = self.contract("m.obj", "--shading", "flat", "--style", "lecture", "--stage", "application", *LIGHTS)
        self.assertIn("// The three vertices of a triangle get the position of its last one and the face normal.\n", contract["application"])
        (p, n, _), colors_of = triangles[0][1][2], self.light_vertex(contract)
        smooth = self.light_vertex(self.contract("m.obj", "--style", "lecture", "--stage", "application", *LIGHTS))
        self.assertEqual(colors_of(0, p, n, (1, 1, 1, 1)), smooth(0, p, n, (1, 1, 1, 1)))

    @unittest.skipUnless(shutil.which("cc"), "there is no C compiler `cc` (package gcc)")
    def test_mistakes_in_the_application_stage(self):
        """Each mistake that the C function can contain changes its colours; the others are refused with an error message."""
        (_, triangles), scenes = self.model(transform=[["scale", 1, 2, 1]]), [["m.json", "--rotate", "y:30", "--style", "lecture", "--stage", "application", "--material", "shininess=4,specular=0.7",
                                            *more] for more in
                                           ([*LIGHTS, "--light", "spot:position=1/1/2,cutoff=5"], ["--reflection", "phong", "--light", "point:attenuation=1/0.1/0.02,ambient=0.3"])]
        right = [self.light_vertex(self.contract(*words)) for words in scenes]
        refused = set()
        vertices = sorted({corner for _, corners in triangles for corner in corners})[::3]
        for row in json.loads(self.good("shader", "--mistake", "list", "--json").stdout):
            wrong = []
            for words, expected in zip(scenes, right):
                done = self.run_program("shader", *words, "--mistake", row["mistake"], "--json")
                if done.returncode == 0:
                    colors_of = self.light_vertex(json.loads(done.stdout), strict=False)
                    wrong.append(max(abs(a - b) for v in vertices for side in (0, 1) for a, b in zip(colors_of(0, *v)[side], expected(0, *v)[side])))
                else:
                    self.assertEqual(done.returncode, 3)
                    self.assertIn(b"the shader lacks the code that this mistake changes", done.stderr)
            if wrong:
                self.assertGreater(max(wrong), 0.02, row["mistake"])
            else:
                refused.add(row["mistake"])
        self.assertEqual(refused, {"normal-not-unit", "normal-clip-space", "clip-space-vertex", "alpha-one"})

    def test_application_stage_says_what_it_does_not_have(self):
        self.bad(3, "shader", "sphere", "--style", "lecture", "--stage", "application", "--reflection", "ggx", says="'--style lecture' does not support '--reflection ggx'")
        self.assertIsNone(self.contract("sphere", "--stage", "application")["application"])
        self.assertIsNone(self.contract("sphere", "--style", "lecture")["application"])
        self.good("shader", "sphere", "--style", "lecture", "--stage", "application", "--host", "c", "-o", "s", "-q")
        self.assertEqual(self.new_files(), {"s.vert", "s.frag", "s.application.c", "s.c"})

    def test_mistakes_that_do_not_apply(self):
        self.bad(1, "shader", "--mistake", "nogate", says="did you mean 'no-gate'?")
        self.bad(1, "shader", "--mistake", "no-gate", "--style", "full", says="options '--mistake' and '--style full'")
        self.bad(3, "shader", "--mistake", "no-cone", says="mistake 'no-cone': the shader lacks the code that this mistake changes; expected a spot light")

    def test_mistakes(self):
        """Each mistake edits the text, and has a description."""
        for row in json.loads(self.good("shader", "--mistake", "list", "--json").stdout):
            self.assertEqual(set(row), {"mistake", "wrong", "looks", "needs"})
            self.assertIn(f"{row['mistake']}\n  Wrong: {row['wrong']}.\n  Seen: {row['looks']}\n", self.good("shader", "--mistake", "list").stdout.decode())
        right, wrong = self.contract("sphere", "--style", "lecture"), self.contract("sphere", "--mistake", "no-gate")
        self.assertIn("float S = dot(N, L) > 0.0 ? pow(max(dot(N, H), 0.0), material.shininess) : 0.0;", right["fragment"])
        self.assertIn("float S = pow(max(dot(N, H), 0.0), material.shininess);", wrong["fragment"])
        self.assertEqual({**wrong, "fragment": ""}, {**right, "fragment": ""})

    def test_files(self):
        self.good("shader", "cube.obj", "--glsl", "120", "-o", "mine", "--host", "c")
        self.assertEqual(self.new_files(), {"mine.vert", "mine.frag", "mine.c"})
        for name in ("mine.vert", "mine.frag"):
            text = (self.folder / name).read_text()
            self.assertTrue(text.startswith("#version 120\n"))
            self.assertNotRegex(text, r"\bflat (in|out)\b|layout|\buniform \w+ \{")
        self.assertIn("uniform Light lights[", (self.folder / "mine.frag").read_text())
        host = (self.folder / "mine.c").read_text()
        self.assertRegex(host, r'glUniform4fv\(glGetUniformLocation\(program, "lights\[0\]\.direction"\), 1, \w+\);')
        (self.folder / "folder").mkdir()
        self.good("shader", "cube.obj", "-o", "folder/")
        self.assertTrue((self.folder / "folder" / "cube.frag").exists())
        self.assertEqual(self.good("shader", "cube.obj", "-q", "-o", "again.frag").stdout, b"")
        self.assertTrue((self.folder / "again.vert").exists())

    def test_names_are_comments(self):
        """No name of a model ends the comment that contains it: not with a line end, a backslash, a trigraph or an end of a comment."""
        names = ("a\nint owned;\n//", "a\r\nint owned;", "a\\", "a??/", "*/ int owned; /*", "a\u2028int owned;", "a\x1b[2J\u009b\u202e")
        for name in names:
            corner = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()
            (self.folder / "n.gltf").write_text(json.dumps({
                "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}], "materials": [{"name": name}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                "buffers": [{"uri": "data:application/octet-stream;base64," + corner, "byteLength": 36}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}))
            text = self.good("shader", "n.gltf", "--host", "c").stdout.decode()
            for line in text.splitlines():
                if "owned" in line:
                    self.assertTrue(line.startswith("//") and "*/" not in line, line)
                self.assertFalse(line.endswith("\\") or "??/" in line, line)
            self.assertFalse(set(text) & set("\x1b\u009b\u202e\u2028"), name)

    def test_host_code_says_which_pictures_it_leaves_out(self):
        (self.folder / "red.ppm").write_bytes(b"P6\n2 1\n255\nabcdef")
        (self.folder / "a.mtl").write_text("newmtl a\nmap_Kd red.ppm\nnewmtl b\n")
        (self.folder / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3/1 2/1 1/1\n")
        host = self.good("shader", "a.obj", "--host", "c").stdout.decode().split("// ===== host code =====")[1]
        self.assertIn("// LEFT OUT: the pictures of textures", host)
        self.assertRegex(host, r"// LEFT OUT: diffuse_map is the picture .*red\.ppm, 2x1, sRGB colours, to be made linear: bind it with "
                               r"glActiveTexture\(GL_TEXTURE0 \+ 4\)\n    glUniform1i\(glGetUniformLocation\(program, \"diffuse_map\"\), 4\);")
        self.assertIn("// diffuse_map: this draw has no such map, and reads 1 whatever is bound to unit 4", host)
        self.assertNotIn("LEFT OUT", self.good("shader", "cube.obj", "--host", "c").stdout.decode())

    def test_every_uniform_of_the_text_is_in_the_contract_and_back(self):
        for words in (["--glsl", "120"], ["--glsl", "120", "--products"], ["--lights-in", "array", "--back-material", "gold"],
                      ["--glsl", "300es", "--products", "--lights-in", "texture"], ["--gl1", "--shading", "gouraud", "--glsl", "120"]):
            contract = self.contract("cube.obj", *words)
            text = contract["vertex"] + contract["fragment"]
            declared = set(re.findall(r"(?m)^uniform \w+ (\w+)", text))
            documented = {re.split(r"[.\[]", u["name"])[0] for u in uniforms_of(contract)}
            self.assertEqual(declared, documented, words)
            declared = set(re.findall(r"(?m)^(?:attribute|layout\(location = \d\) in) \w+ (\w+)", contract["vertex"]))
            self.assertEqual(declared, {a["name"] for a in contract["attributes"]}, words)
            for u in uniforms_of(contract):
                size = {"float": 1, "int": 1, "vec3": 3, "vec4": 4, "mat3": 9, "mat4": 16}.get(u["type"])
                self.assertEqual(len(u["value"]) if u["value"] is not None else None, size, u["name"])

    def test_blocks_have_the_layout_of_std140(self):
        contract = self.contract("cube.obj", "--light", "point", "--light", "hemisphere")
        offsets = {u["name"]: u["offset"] for u in uniforms_of(contract) if u["block"]}
        self.assertEqual(offsets["ambient_light"], 0)
        self.assertEqual(offsets["lights[0].position"], 16)
        self.assertEqual(offsets["lights[0].specular"], 16 + 5 * 16)
        self.assertEqual(offsets["hemispheres[0].up"], 16 + 6 * 16)
        self.assertEqual(offsets["material.shininess"], 80)
        self.assertEqual(offsets["material.fibre"], 84)

    def test_values_are_the_scene_s(self):
        lights = ["--light", "point:position=1/2/3,frame=camera,color=0.5/0.25/0.125,attenuation=1/0.5/0.25"]
        values = {u["name"]: u["value"] for u in uniforms_of(self.contract("cube.obj", "--glsl", "120", *lights, "--shininess", "7"))}
        self.assertEqual(values["lights[0].position"], [1, 2, 3, 1])
        self.assertEqual(values["lights[0].attenuation"], [1, 0.5, 0.25, 0])
        self.assertEqual(values["lights[0].diffuse"], [0.5, 0.25, 0.125, 1])
        self.assertEqual(values["material.shininess"], [7])
        products = {u["name"]: u["value"] for u in
                    uniforms_of(self.contract("cube.obj", "--glsl", "120", "--products", *lights))}
        for i in range(3):
            self.assertAlmostEqual(products["diffuse_product[0]"][i], values["material.diffuse"][i] * values["lights[0].diffuse"][i], 6)

    def test_hundreds_of_lights(self):
        lights = [w for i in range(300) for w in ("--light", "point:position=%d/1/1" % i)]
        contract = self.contract("cube.obj", "--lights-in", "texture", "--products", *lights)
        self.assertIn("i < 300", contract["fragment"])
        self.assertEqual({entry["name"]: entry["texels"] for entry in contract["lists"]}["light_list"], 1200)
        self.assertIn("uniform Light lights[300];", self.contract("cube.obj", "--glsl", "120", *lights)["fragment"])

    def test_what_is_refused(self):
        self.bad(1, "shader", "cube.obj", "--glsl", "110", says="330, 120 or 300es")
        self.bad(1, "shader", "cube.obj", "--glsl", "120", "--lights-in", "block", says="GLSL 120 has no uniform blocks")
        self.bad(1, "shader", "cube.obj", "--glsl", "120", "--lights-in", "texture", says="texelFetch")
        self.bad(1, "shader", "cube.obj", "--shading", "phong", "--stage", "vertex", says="fragment")
        self.bad(1, "shader", "cube.obj", "--object", "5", says="object is 5")
        self.bad(3, "shader", "cube.obj", "--show", "depth", says="depth")
        (self.folder / "lines.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
        self.bad(3, "shader", "lines.obj", says="contains only lines and points", leaves=["lines.obj"])
        self.bad(3, "shader", "lines.obj", "--object", "0", says="object 0 contains only lines and points", leaves=["lines.obj"])
        (self.folder / "lines.obj").unlink()
        self.bad(1, "shader", "cube.obj", "cube.stl", says="unexpected argument")
        self.bad(2, "shader", "nothing.obj", says="nothing.obj")
        self.bad(5, "shader", "cube.obj", "-o", "no/such/name", says="no/such")
