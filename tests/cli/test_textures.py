# test_textures.py: textures of OBJ and glTF files: the position of a picture, its options, and the warning about a
# missing one.
import base64
import json
import math
import shutil
import struct

from harness import ROOT, Case, pixel, read_png, write_png

RED, GREEN, BLUE, WHITE = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 255)
# Rows from the top: red green, blue white.
QUARTERS = write_png(8, 8, bytes(RED * 4 + GREEN * 4) * 4 + bytes(BLUE * 4 + WHITE * 4) * 4)
SQUARE = """mtllib m.mtl
v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
vn 0 0 1
usemtl a
f 1/1/1 2/2/1 3/3/1 4/4/1
"""
LOOK = ["-s", "32", "-b", "black", "--camera", "eye=0/0/4,target=0/0/0,fovy=28.07", "--samples", "1", "-o", "a.png"]


def corners(picture):
    """The pixels in the middle of the picture's quarters: upper left, upper right, lower left, lower right."""
    return [pixel(picture, x, y)[:3] for y in (4, 27) for x in (4, 27)]


class Textures(Case):
    def give(self, name, data):
        (self.folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
        self.given.add(name)
        return name

    def drawn(self, *words):
        self.good(*words, *LOOK)
        self.given.add("a.png")
        return corners(read_png((self.folder / "a.png").read_bytes()))

    def obj(self, statements, picture=QUARTERS):
        self.give("t.png", picture)
        self.give("m.mtl", "newmtl a\nKd 0 0 0\nKa 0 0 0\nillum 0\n" + statements)
        return self.give("m.obj", SQUARE)

    def test_search(self):
        """Pictures that moved: beside the material's file, by their last component, in another case, with %20, in quotes."""
        def fill(files, mtl="m.mtl", name="t.png"):
            for file in files:
                path = self.folder / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(QUARTERS)
            path = self.folder / mtl
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"newmtl a\nKd 1 1 1\nillum 0\nmap_Kd {name}\n")
            (self.folder / "m.obj").write_text(SQUARE.replace("m.mtl", mtl))

        rows = [  # files, MTL file, name, expected: drawn, words in the single warning
            (["sub/t.png"], "sub/m.mtl", "t.png", True, None),
            (["t.png", "sub/t.png"], "sub/m.mtl", "sub/t.png", True, None),
            (["sub/t.png"], "sub/m.mtl", "..\\t.png", True, "'sub/t.png' is used"),
            (["sub/t.png"], "sub/m.mtl", "C:\\tex\\t.png", True, "'sub/t.png' is used"),
            (["t.png"], "m.mtl", "C:\\tex\\t.png", True, None),
            (["t.png"], "m.mtl", "textures/t.png", True, "names the file 'textures/t.png'; 't.png' is used"),
            (["Textures/T.PNG"], "m.mtl", "textures/t.png", True, "'Textures/T.PNG' is used"),
            (["T.png", "t.PNG"], "m.mtl", "t.png", False, "several files differ from this name only in case"),
            (["T.png", "t.png"], "m.mtl", "t.png", True, None),
            (["my t.png"], "m.mtl", "my%20t.png", True, "'my t.png' is used"),
            (["my t.png", "my%20t.png"], "m.mtl", "my%20t.png", True, None),
            (["My t.png"], "m.mtl", "sub/my%20t.png", True, "'My t.png' is used"),
            (["my t.png"], "m.mtl", '"my t.png"', True, None),
            (["t.png"], "m.mtl", "t.png -bm 1 # map", True, None),
            ([], "m.mtl", "t.png", False, "t.png: cannot open"),
        ]
        for sandbox in ("off", "require"):
            for files, mtl, name, drawn, words in rows:
                for left in ("sub", "Textures", "t.png", "T.png", "t.PNG", "my t.png", "My t.png", "my%20t.png"):
                    path = self.folder / left
                    if path.is_dir():
                        shutil.rmtree(path)
                    elif path.exists():
                        path.unlink()
                fill(files, mtl, name)
                done = self.good("m.obj", *LOOK, "--sandbox", sandbox)
                warnings = done.stderr.decode().count("warning:")
                picture = corners(read_png((self.folder / "a.png").read_bytes()))
                self.assertEqual(picture[0] == RED[:3], drawn, (files, name))
                self.assertEqual(warnings, words is not None, (files, name, done.stderr))
                self.assertIn(words or "", done.stderr.decode())
        # Never outside of the model's folder.
        (self.folder / "in").mkdir()
        (self.folder / "out.png").write_bytes(QUARTERS)
        (self.folder / "in" / "OUT.png").symlink_to("../out.png")
        (self.folder / "in" / "m.mtl").write_text("newmtl a\nillum 0\nmap_Kd ../out.png\n")
        (self.folder / "in" / "m.obj").write_text(SQUARE)
        done = self.good("in/m.obj", *LOOK)
        self.assertIn("drawn without this texture", done.stderr.decode())
        self.assertNotEqual(corners(read_png((self.folder / "a.png").read_bytes()))[0], RED[:3])

    def test_ply(self):
        """PLY names its pictures in comments. Texture coordinates of vertices and of faces, ASCII and binary, small and large
        (read in parts), draw the same picture, and converted files keep it."""
        r, g, b, w = RED[:3], GREEN[:3], BLUE[:3], WHITE[:3]
        self.give("t.png", QUARTERS)
        uv = [(0, 0), (1, 0), (1, 1), (0, 1)]
        at = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        for wedge in (False, True):
            for form in ("ascii", "binary_little_endian", "binary_big_endian"):
                for more in (0, 100000):  # faces that fill the file
                    vertex = "" if wedge else "property float s\nproperty float t\n"
                    face = "property list uchar float texcoord\n" if wedge else ""
                    header = (f"ply\nformat {form} 1.0\ncomment TextureFile t.png\nelement vertex 4\nproperty float x\nproperty float y\n"
                              f"property float z\n{vertex}element face {1 + more}\nproperty list uchar int vertex_indices\n{face}end_header\n")
                    rows = [(*at[i], 0, *(() if wedge else uv[i])) for i in range(4)]
                    if form == "ascii":
                        body = "".join(" ".join(map(str, row)) + "\n" for row in rows)
                        body += "4 0 1 2 3" + (" 8 0 0 1 0 1 1 0 1" if wedge else "") + "\n"
                        body = (body + more * ("3 0 0 0" + (" 0" if wedge else "") + "\n")).encode()
                    else:
                        end = "<" if "little" in form else ">"
                        body = b"".join(struct.pack(f"{end}{len(row)}f", *row) for row in rows)
                        body += struct.pack(f"{end}B4i", 4, 0, 1, 2, 3) + (struct.pack(f"{end}B8f", 8, *sum(uv, ())) if wedge else b"")
                        body += more * (struct.pack(f"{end}B3i", 3, 0, 0, 0) + (b"\0" if wedge else b""))
                    self.give("m.ply", header.encode() + body)
                    self.assertEqual(self.drawn("m.ply", "--show", "base-color"), [r, g, b, w], (wedge, form, more))
            for other in ("glb", "obj"):
                self.good("convert", "m.ply", f"n.{other}")
                self.given |= self.new_files()
                self.assertEqual(self.drawn(f"n.{other}", "--show", "base-color"), [r, g, b, w], (wedge, other))

    def test_mtl_orientation_and_options(self):
        r, g, b, w = RED[:3], GREEN[:3], BLUE[:3], WHITE[:3]
        # MTL's t points up, so the picture is upright, as in a viewer.
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke t.png\n")), [r, g, b, w])
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke -o 0.5 0 t.png\n")), [g, r, w, b])
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke -o 0 0.5 t.png\n")), [b, w, r, g])
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke -s 4 1 t.png\n")), [g, r, w, b])
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke -clamp on -o 1 0 t.png\n")), [g, g, w, w])
        self.assertEqual(self.drawn(self.obj("Ke 1 1 1\nmap_Ke -mm 1 -1 t.png\n"))[0], (0, 255, 255))
        # illum 0 shows the picture itself.
        self.assertEqual(self.drawn(self.obj("map_Kd t.png\n")), [r, g, b, w])
        for statement, said in (("map_Kd -bm\n", True), ("map_Kd\n", False)): # some exporters write an empty statement
            text = self.good(self.obj(statement), *LOOK).stderr
            self.assertEqual(b"m.mtl:5: found options without a file name" in text, said, text)

    def test_mtl_opacity(self):
        half = write_png(8, 8, bytes((RED[:3] + (0,)) * 4 + GREEN * 4) * 4 + bytes((BLUE[:3] + (0,)) * 4 + WHITE * 4) * 4)
        for statements in ("map_Kd t.png\n", "map_Kd t.png\nmap_d t.png\n", "map_Kd t.png\nmap_d -imfchan m t.png\n"):
            found = self.drawn(self.obj(statements, half))
            self.assertEqual([found[0], found[2]], [(0, 0, 0)] * 2, statements)  # the background
            self.assertEqual([found[1], found[3]], [GREEN[:3], WHITE[:3]], statements)

    def test_mtl_shading(self):
        # A bump map that rises to the left is brighter under a light from the right.
        ramp = write_png(8, 1, b"".join(bytes((240 - 30 * x,) * 3 + (255,)) for x in range(8)))
        light = ["--light", "directional:direction=-1/0/-1,diffuse=0.5", "--rig", "none"]
        plain = "newmtl a\nKd 0.6 0.6 0.6\nKs 0 0 0\n"
        grey = self.give("m.obj", SQUARE)
        self.give("m.mtl", plain)
        before = self.drawn(grey, *light)[0][0]
        for statement, picture in (("map_Bump -clamp on -bm 5 t.png", ramp),):
            self.give("t.png", picture)
            self.give("m.mtl", plain + statement + "\n")
            self.assertGreater(self.drawn(grey, *light)[0][0], before + 5, statement)

    def test_missing_and_broken(self):
        done = self.good(self.obj("Ke 1 1 1\nmap_Ke nowhere.png\nmap_Kd t.png\n", b"no picture"), *LOOK)
        self.assertIn(b"nowhere.png", done.stderr)
        self.assertIn(b"t.png: byte 0", done.stderr)
        self.assertEqual(done.stderr.count(b"drawn without this texture"), 2)

    # --- glTF

    def gltf(self, texture=None, info=None, sampler=None, second=False, **changes):
        places = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
        coordinates = struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0)
        other = struct.pack("<8f", *[0.25, 0.25] * 4)
        data = places + coordinates + other + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
        file = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2}, "indices": 3, "material": 0}]}],
            "materials": [{"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, **(info or {})}}}],
            "textures": [texture or {"source": 0, **({"sampler": 0} if sampler else {})}], "samplers": [sampler or {}],
            "images": [{"uri": "data:image/png;base64," + base64.b64encode(QUARTERS).decode()}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC2"},
                          {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 4, "type": "VEC2"},
                          {"bufferView": 0, "byteOffset": 112, "componentType": 5123, "count": 6, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}], **changes}
        return self.give("m.gltf", json.dumps(file))

    def test_gltf_coordinates(self):
        r, g, b, w = RED[:3], GREEN[:3], BLUE[:3], WHITE[:3]
        nearest = {"magFilter": 9728, "minFilter": 9728}
        self.assertEqual(self.drawn(self.gltf(sampler=nearest)), [r, g, b, w])
        self.assertEqual(self.drawn(self.gltf(sampler=nearest, info={"texCoord": 1})), [r, r, r, r])
        move = {"extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}}
        self.assertEqual(self.drawn(self.gltf(sampler=nearest, info=move)), [g, r, w, b])
        clamp = {**nearest, "wrapS": 33071}
        self.assertEqual(self.drawn(self.gltf(sampler=clamp, info=move)), [g, g, w, w])
        other = {"extensions": {"KHR_texture_transform": {"texCoord": 1}}}
        self.assertEqual(self.drawn(self.gltf(sampler=nearest, info=other)), [r, r, r, r])
        # A quarter turn about (0, 0), moved back into the picture.
        turn = {"extensions": {"KHR_texture_transform": {"rotation": 1.5707963267948966, "offset": [0, 1]}}}
        self.assertEqual(self.drawn(self.gltf(sampler=nearest, info=turn)), [b, r, w, g])

    def test_specular_glossiness(self):
        """The map's colours and alpha multiply both factors: a map of one texel is the same as other factors."""
        def glossy(texel, specular, glossiness, **diffuse):
            self.give("t.png", write_png(1, 1, bytes(texel)))
            found = {"diffuseFactor": [0.5, 0.4, 0.9, 1], "specularFactor": specular, "glossinessFactor": glossiness,
                     "specularGlossinessTexture": {"index": 0}, **diffuse}
            self.good(self.gltf(images=[{"uri": "t.png"}], materials=[{"extensions": {"KHR_materials_pbrSpecularGlossiness": found}}]),
                      "--light", "directional:direction=-0.2/0.3/-1,intensity=0.7", "--tone", "none", "--single-scattering", *LOOK)
            return corners(read_png((self.folder / "a.png").read_bytes()))

        def linear(byte):
            return ((byte / 255 + 0.055) / 1.055) ** 2.4
        plain = glossy((255, 255, 255, 255), [0.5 * linear(200), 0.25 * linear(100), linear(50)], 0.8 * 102 / 255)
        mapped = glossy((200, 100, 50, 102), [0.5, 0.25, 1], 0.8)
        for a, b in zip(sum(plain, ()), sum(mapped, ())):
            self.assertLessEqual(abs(a - b), 1)
        for other in (glossy((100, 100, 50, 102), [0.5, 0.25, 1], 0.8), glossy((200, 100, 50, 200), [0.5, 0.25, 1], 0.8)):
            self.assertGreater(max(abs(a - b) for a, b in zip(sum(plain, ()), sum(other, ()))), 3)
        # Only Lambert's part, as in the extension: diffuse (1 - max specular)(1 - max F), F = f0 except for 2e-5 along the normal.
        matt = glossy((255, 255, 255, 255), [0.5, 0.2, 0], 0, diffuseFactor=[1, 1, 1, 1])
        black = glossy((255, 255, 255, 255), [0.5, 0.2, 0], 0, diffuseFactor=[0, 0, 0, 1])
        cosine = 1 / (0.2 ** 2 + 0.3 ** 2 + 1) ** 0.5
        self.assertAlmostEqual(linear(matt[0][2]) - linear(black[0][2]), 0.7 * cosine * 0.5 * 0.5, delta=0.01)

    def test_gltf_tangents(self):
        """Computed tangents follow the texture coordinates after the normal map's transform, also in a scene file; given tangents do not change."""
        bent = write_png(1, 1, bytes((200, 90, 220, 255)))
        for scale, angle in (([1, 1], 0.7), ([-1, 1], 0.7), ([1, -1], 0.7), ([2, -3], 0.7), ([2, 3], 0), ([-1, 1], 0), ([1, -1], 0)):
            # s' = a s + b t, t' = c s + d t, and the square has p = (s, -t)
            a, b, c, d = math.cos(angle) * scale[0], math.sin(angle) * scale[1], -math.sin(angle) * scale[0], math.cos(angle) * scale[1]
            sign = math.copysign(1, a * d - b * c)
            along = [sign * d / math.hypot(c, d), sign * c / math.hypot(c, d), 0, sign]

            def file(**attributes):
                given = {"images": [{"uri": "data:image/png;base64," + base64.b64encode(bent).decode()}],
                         "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}, "normalTexture": {
                             "index": 0, "extensions": {"KHR_texture_transform": {"scale": scale, "rotation": angle}}}}]}
                self.gltf(**given)
                found = json.loads((self.folder / "m.gltf").read_text())
                data = base64.b64decode(found["buffers"][0]["uri"].split(",")[1])
                start = len(data)
                data += struct.pack("<12f", *[0, 0, 1] * 4) + struct.pack("<16f", *along * 4)
                found["buffers"] = [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}]
                found["bufferViews"][0]["byteLength"] = len(data)
                found["accessors"] += [{"bufferView": 0, "byteOffset": start, "componentType": 5126, "count": 4, "type": "VEC3"},
                                       {"bufferView": 0, "byteOffset": start + 48, "componentType": 5126, "count": 4, "type": "VEC4"}]
                found["meshes"][0]["primitives"][0]["attributes"].update(attributes)
                return self.give("m.gltf", json.dumps(found))
            light = ("--light", "directional:direction=-0.6/0.5/-1,intensity=1.5")
            want = self.drawn(file(NORMAL=4, TANGENT=5), *light)
            self.assertNotEqual(want, self.drawn(file(NORMAL=4), *light, "--shading", "flat"))
            made = self.drawn(file(NORMAL=4), *light)
            self.assertTrue(all(abs(x - y) <= 1 for one, other in zip(made, want) for x, y in zip(one, other)), (scale, angle, made, want))
            self.give("s.json", json.dumps({"lambent": 1, "objects": [{"file": "m.gltf"}]}))
            self.assertEqual(self.drawn("s.json", *light), made, scale)

    def test_gltf_pictures(self):
        self.give("t.png", QUARTERS)
        self.assertEqual(self.drawn(self.gltf(images=[{"uri": "t.png"}]))[0], self.drawn(self.gltf())[0])
        done = self.good(self.gltf(images=[{"uri": "nowhere.png"}]), *LOOK)
        self.assertIn(b"nowhere.png", done.stderr)
        done = self.good(self.gltf(images=[{"uri": "data:;base64,AAAA"}]), *LOOK)
        self.assertIn(b"images[0]: byte 0: not the start of", done.stderr)

    def test_gltf_extensions(self):
        """The picture of EXT_texture_webp and EXT_texture_avif is drawn, not the fallback, if it can be read; escaped base64 is read as the same bytes."""
        red = write_png(8, 8, bytes(RED) * 64)
        for kind in ("webp", "avif"):
            picture = (ROOT / f"tests/pictures/{kind}/lossless.{kind}").read_bytes()
            uris = ["data:image/png;base64," + base64.b64encode(red).decode(), f"data:image/{kind};base64," + base64.b64encode(picture).decode()]
            images = [{"uri": uri} for uri in uris]
            alone = self.gltf(images=images, texture={"source": 1})
            done = self.good(alone, *LOOK)
            both = {"source": 0, "extensions": {f"EXT_texture_{kind}": {"source": 1}}}
            if b"install the Debian package" in done.stderr:
                self.assertEqual(self.drawn(self.gltf(images=images, texture=both)), [RED[:3]] * 4)
                continue
            want = self.drawn(alone)
            self.assertEqual(self.drawn(self.gltf(images=images, texture=both)), want)
            self.assertEqual(self.drawn(self.gltf(images=images, texture={"extensions": both["extensions"]})), want)
            self.assertNotEqual(want, [RED[:3]] * 4)
            escaped = [{"uri": uri.replace("+", "%2B").replace("/", "%2f").replace("=", "%3D").replace("image%2f", "image/")} for uri in uris]
            self.assertIn("%2", escaped[1]["uri"])
            self.assertEqual(self.drawn(self.gltf(images=escaped, texture=both)), want)

    def test_filters(self):
        """The filters of `--map-filter`, the probes of `--anisotropy`, and the footprint that `explain` prints, which a
        pixel beside it confirms."""
        tiles = str(ROOT / "examples/tiles/tiles.obj")
        look = ["-s", "320x200", "--samples", "1", "--camera", "eye=0/0.9/2.2,target=0/0/-3"]

        def texel_at(x, y):
            if x % 32 == 0 or y % 32 == 0:
                return 96, 92, 86
            return (40, 62, 88) if (x // 32 + y // 32) % 2 else (124, 114, 94) if (x // 4 + y // 4) % 2 else (150, 140, 120)

        def explained(x, y, *options):
            map_ = json.loads(self.good("explain", tiles, f"{x},{y}", *look, "--json", *options).stdout)["triangles"][0]["maps"][0]
            self.assertEqual((map_["map"], map_["width"], map_["height"]), ("diffuse", 128, 128))
            return map_
        for x, y in ((160, 150), (90, 120), (230, 100), (160, 90)):
            for words, most in (([], 8), (["--anisotropy", "1"], 1), (["--anisotropy", "3"], 3), (["--map-filter", "trilinear"], 8), (["--map-filter", "bilinear"], 1)):
                m = explained(x, y, *words)
                a, b = math.hypot(*m["across"]), math.hypot(*m["down"])
                ratio = max(1, min(0.8 * max(a, b) / min(a, b), most)) if max(a, b) > 1 else 1
                self.assertEqual(m["probes"], math.ceil(ratio - 1e-5), (x, y, words))
                self.assertAlmostEqual(m["level"], math.log2(max(a, b) / ratio), delta=1e-4)
            right, below = explained(x + 1, y), explained(x, y + 1)
            for other, step in ((right, m["across"]), (below, m["down"])):
                for k in range(2):  # the derivatives change a little from pixel to pixel, and the picture repeats every 128 texels
                    apart = (other["place"][k] - m["place"][k] - step[k] + 64) % 128 - 64
                    self.assertLess(abs(apart), 0.02 + 0.1 * max(a, b))
            nearest = explained(x, y, "--map-filter", "nearest")
            texel = texel_at(*(int(at) for at in nearest["place"]))
            for k in range(3):
                byte = texel[k] / 255
                self.assertAlmostEqual(nearest["texel"][k], byte / 12.92 if byte <= 0.04045 else ((byte + 0.055) / 1.055) ** 2.4, delta=1e-6)
        drawn = {}
        for words in ("", "--anisotropy 8", "--anisotropy 1", "--map-filter nearest", "--map-filter bilinear", "--map-filter trilinear", "--map-filter file"):
            self.good(tiles, *look, "-o", f"{len(drawn)}.png", *words.split())
            drawn[words] = (self.folder / f"{len(drawn)}.png").read_bytes()
        self.assertEqual(drawn[""], drawn["--anisotropy 8"])
        self.assertEqual(drawn[""], drawn["--map-filter trilinear"])
        self.assertEqual(drawn[""], drawn["--map-filter file"])
        self.assertEqual(len(set(drawn.values())), 4)
        self.bad(1, tiles, "--map-filter", "cubic", "-o", "b.png", says="file, nearest, bilinear or trilinear")

    def test_gltf_wrong(self):
        for said, changes in (("textures[0].source: found 4", {"texture": {"source": 4}}), ("Texture.index: found 7", {"info": {"index": 7}}),
                              ("samplers[0].wrapS: found 5, expected 33071, 33648 or 10497", {"sampler": {"wrapS": 5}}),
                              ("textures[0]: its only picture is KTX 2", {"texture": {"extensions": {"KHR_texture_basisu": {"source": 0}}}}),
                              ("images[0]: found neither uri nor bufferView", {"images": [{}]})):
            done = self.good(self.gltf(**changes), *LOOK)
            self.assertIn(said.encode(), done.stderr)
            self.assertEqual(done.stderr.count(b"drawn without it"), 1, done.stderr)
