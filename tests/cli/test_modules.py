# test_modules.py: the formats of lambent-formats: a small file of each with its size, colours and names; files that crash a reader; and what is
# said if the package is missing.
import json
import math
import pathlib
import random
import shutil
import struct
import subprocess
import unittest

from harness import Case, long, HAS_SANDBOX, PROGRAM, pixel, read_png, write_png

BUILD = pathlib.Path(PROGRAM).resolve().parent
HAS_ASSIMP, HAS_OCCT = ((BUILD / f"lambent-{name}.so").exists() for name in ("assimp", "occt"))
SHAPES = pathlib.Path(__file__).parent.parent / "modules"
CORNERS = [(x, y, z) for z in (0, 3) for y in (0, 2) for x in (0, 1)]  # a box of 1 × 2 × 3
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # counterclockwise from outside
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
ORANGE = (0.8, 0.4, 0.2)


def words(rows, form="%g", between=" "):
    return between.join(form % number for row in rows for number in row)


OFF = "OFF\n8 6 0\n" + "".join("%d %d %d\n" % c for c in CORNERS) + "".join("4 %d %d %d %d\n" % q for q in QUADS)
AC = ('AC3Db\nMATERIAL "paint" rgb %g %g %g amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 10 trans 0\nOBJECT world\nkids 1\nOBJECT poly\nname "box"\n' % ORANGE +
      "numvert 8\n" + "".join("%d %d %d\n" % c for c in CORNERS) + "numsurf 6\n" +
      "".join("SURF 0x0\nmat 0\nrefs 4\n" + "".join("%d 0 0\n" % v for v in q) for q in QUADS) + "kids 0\n")
X = ("xof 0303txt 0032\nMaterial paint { %g;%g;%g;1;; 0; 0;0;0;; 0;0;0;; }\nFrame box { Mesh {\n8;\n" % ORANGE +
     ",\n".join("%d;%d;%d;" % (x, y, -z) for x, y, z in CORNERS) + ";\n6;\n" + ",\n".join("4;%d,%d,%d,%d;" % q[::-1] for q in QUADS) +
     ";\nMeshMaterialList { 1; 6; 0,0,0,0,0,0; {paint} } } }\n")  # left-handed: z is negated, and faces are clockwise
AMF = ('<?xml version="1.0"?>\n<amf unit="inch"><object id="1"><mesh><vertices>' +
       "".join("<vertex><coordinates><x>%d</x><y>%d</y><z>%d</z></coordinates></vertex>" % c for c in CORNERS) + '</vertices><volume materialid="2">' +
       "".join("<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>" % t for t in TRIANGLES) + "</volume></mesh></object>" +
       '<material id="2"><color><r>%g</r><g>%g</g><b>%g</b></color></material></amf>\n' % ORANGE)
DAE = ('''<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="0.5"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><phong><diffuse><color>%g %g %g 1</color></diffuse><specular><color>0.5 0.5 0.5 1</color>
</specular><shininess><float>20</float></shininess></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="paint"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">%s</float_array><technique_common><accessor source="#a" count="8"
stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v">
<input semantic="POSITION" source="#p"/></vertices><polylist count="6" material="s"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4 4 4 4 4</vcount>
<p>%s</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="w"><node name="box"><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>''' % (*ORANGE, words(CORNERS), words(QUADS)))
FBX = ('''; FBX 7.4.0 project file
FBXHeaderExtension: { FBXHeaderVersion: 1003
 FBXVersion: 7400 }
GlobalSettings: { Version: 1000
 Properties70: { P: "UpAxis", "int", "Integer", "",%d
  P: "UpAxisSign", "int", "Integer", "",1
  P: "FrontAxis", "int", "Integer", "",%d
  P: "FrontAxisSign", "int", "Integer", "",%d
  P: "CoordAxis", "int", "Integer", "",0
  P: "CoordAxisSign", "int", "Integer", "",1
  P: "UnitScaleFactor", "double", "Number", "",2.54 } }
Objects: {
 Geometry: 100, "Geometry::", "Mesh" { Vertices: *24 { a: %s }
  PolygonVertexIndex: *24 { a: %s }
  GeometryVersion: 124
  LayerElementMaterial: 0 { Version: 101
   MappingInformationType: "AllSame"
   ReferenceInformationType: "IndexToDirect"
   Materials: *1 { a: 0 } }
  LayerElementUV: 0 { Version: 101
   MappingInformationType: "ByPolygonVertex"
   ReferenceInformationType: "Direct"
   UV: *48 { a: %s } }
  Layer: 0 { Version: 100
   LayerElement: { Type: "LayerElementMaterial"
    TypedIndex: 0 }
   LayerElement: { Type: "LayerElementUV"
    TypedIndex: 0 } } }
 Model: 200, "Model::box", "Mesh" { Version: 232
  Properties70: { P: "Lcl Translation", "Lcl Translation", "", "A",5,0,0 } }
 Material: 300, "Material::paint", "" { Version: 102
  ShadingModel: "phong"
  Properties70: { P: "DiffuseColor", "Color", "", "A",%g,%g,%g
   P: "DiffuseFactor", "Number", "", "A",1
   P: "SpecularColor", "Color", "", "A",0.5,0.5,0.5
   P: "SpecularFactor", "Number", "", "A",0.5
   P: "ShininessExponent", "Number", "", "A",20 } }
%s}
Connections: {
 C: "OO",200,0
 C: "OO",100,200
 C: "OO",300,200
%s}
''')
FBX_TEXTURE = ''' Texture: 400, "Texture::t", "" { Type: "TextureVideoClip"
  FileName: "C:\\\\work\\\\Maps\\\\Wood.PNG"
  RelativeFilename: "..\\\\Maps\\\\Wood.PNG" }
'''


def fbx(z_up=False, texture=False):
    ends = [(a, b, c, -d - 1) for a, b, c, d in QUADS]
    uv = [(0, 0, 1, 0, 1, 1, 0, 1)] * 6
    return FBX % (2 if z_up else 1, 1 if z_up else 2, -1 if z_up else 1, words(CORNERS, between=","), words(ends, between=","), words(uv, between=","),
                  *((1, 1, 1) if texture else ORANGE), FBX_TEXTURE if texture else "", ' C: "OP",400,300, "DiffuseColor"\n' if texture else "")


def chunk(kind, *parts):
    body = b"".join(parts)
    return struct.pack("<HI", kind, 6 + len(body)) + body


def studio():
    """A 3DS file."""
    color = chunk(0x0011, bytes(round(255 * c) for c in ORANGE))
    mesh = chunk(0x4100, chunk(0x4110, struct.pack("<H24f", 8, *sum(CORNERS, ()))),
                 chunk(0x4120, struct.pack("<H", 12), *(struct.pack("<4H", *t, 7) for t in TRIANGLES),
                       chunk(0x4130, b"paint\0", struct.pack("<H12H", 12, *range(12)))))
    return chunk(0x4D4D, chunk(0x3D3D, chunk(0xAFFF, chunk(0xA000, b"paint\0"), chunk(0xA020, color)), chunk(0x4000, b"box\0", mesh)))


def light_wave():
    """An LWO2 file."""
    def part(kind, *parts):
        body = b"".join(parts)
        return kind + struct.pack(">I", len(body)) + body + b"\0" * (len(body) % 2)

    def sub(kind, body):
        return kind + struct.pack(">H", len(body)) + body
    surface = part(b"SURF", b"paint\0\0\0", sub(b"COLR", struct.pack(">3fH", *ORANGE, 0)), sub(b"DIFF", struct.pack(">fH", 1, 0)))
    body = (b"LWO2" + part(b"TAGS", b"paint\0") + part(b"LAYR", struct.pack(">HH3f", 0, 0, 0, 0, 0), b"box\0") +
            part(b"PNTS", struct.pack(">24f", *(n for x, y, z in CORNERS for n in (x, y, -z)))) +
            part(b"POLS", b"FACE", *(struct.pack(">5H", 4, *q[::-1]) for q in QUADS)) +
            part(b"PTAG", b"SURF", *(struct.pack(">HH", i, 0) for i in range(6))) + surface)
    return b"FORM" + struct.pack(">I", len(body)) + body


# bytes, the size of the box, whether there is a material (AMF: colours of vertices), the unit
FILES = {
    "off": (OFF, [1, 2, 3], False, None), "ac": (AC, [1, 2, 3], True, None), "x": (X, [1, 2, 3], True, None), "amf": (AMF, [1, 2, 3], False, "inch"),
    "dae": (DAE, [0.5, 1.5, 1], True, "metre"), "fbx": (fbx(), [1, 2, 3], True, "inch"), "3ds": (studio(), [1, 3, 2], True, None), "lwo": (light_wave(), [1, 2, 3], True, None),
}
BYTES = {ending: row[0] if isinstance(row[0], bytes) else row[0].encode() for ending, row in FILES.items()}


class Modules(Case):
    def file(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    def info(self, *words, **more):
        return json.loads(self.good("info", "--json", *words, **more).stdout)

    def mutate(self, files, count):
        """Changed files are read or refused with one sentence, and nothing is written."""
        chance = random.Random(1)
        for ending, data in files.items():
            for number in range(count):
                changed = bytearray(data)
                for _ in range(chance.choice((1, 1, 2, 5, 20))):
                    at = chance.randrange(len(changed))
                    kind = chance.randrange(4)
                    if kind == 0:
                        changed[at] = chance.randrange(256)
                    elif kind == 1:
                        del changed[at:at + chance.randrange(1, 9)]
                    elif kind == 2:
                        changed[at:at] = changed[chance.randrange(len(changed)):][:chance.randrange(40)]
                    else:
                        changed[at:at + 1] = chance.choice((b"-1", b"99999999999", b"1e39", b"nan", b"\0\0\0\0", b"\xff\xff\xff\xff"))
                self.file("m." + ending, bytes(changed[:chance.choice((len(changed), len(changed), chance.randrange(len(changed) + 1)))]))
                done = self.run_program("info", "-q", "m." + ending, "--time-limit", 20, "--memory-limit", "300MB")
                text = done.stderr.decode(errors="replace")
                self.assertIn(done.returncode, (0, 2, 3, 4), f"{ending} {number}: {text}")
                self.assertTrue(done.returncode == 0 or text.count("\n") == 1, f"{ending} {number}: {text}")
            self.assertEqual(self.new_files(), {"m." + e for e in files if (self.folder / ("m." + e)).exists()})


@unittest.skipUnless(HAS_ASSIMP, "this build has no Assimp")
class Assimp(Modules):
    def same(self, one, other, message=None):
        """The colours differ by at most 4 of 255: the formats split the faces along other diagonals."""
        one, other = read_png(one), read_png(other)
        self.assertEqual(one[:2], other[:2])
        self.assertLessEqual(max(abs(a - b) for a, b in zip(one[2], other[2])), 4, message)

    def test_formats(self):
        for ending, (data, size, painted, unit) in FILES.items():
            with self.subTest(ending):
                self.file("box." + ending, data)
                info = self.info("box." + ending)
                self.assertEqual(info["format"], ending)
                self.assertEqual(info["counts"]["triangles"], 12)
                for found, wanted in zip(info["size"], size):
                    self.assertAlmostEqual(found, wanted, places=5)
                # the faces' order is right: the volume is positive
                self.assertAlmostEqual(info["measure"]["volume"], size[0] * size[1] * size[2], places=4)
                material = info["materials"][0]
                self.assertEqual(material.get("name"), None if ending in ("off", "amf") else "paint")
                if painted:  # the colour is decoded from sRGB
                    for found, wanted in zip(material["diffuse"], (0.6038, 0.1329, 0.0331)):
                        self.assertAlmostEqual(found, wanted, delta=0.002)
                self.assertEqual(info["unit"], unit)

    def test_same_picture(self):
        """The picture is the OBJ file's, with and without a sandbox, from a file and from standard input, and by its content alone."""
        self.file("box.obj", "mtllib box.mtl\no box\nusemtl paint\n" + "".join("v %d %d %d\n" % c for c in CORNERS) +
                  "".join("f %d %d %d %d\n" % tuple(v + 1 for v in q) for q in QUADS))
        self.file("box.mtl", "newmtl paint\nKd %g %g %g\n" % ORANGE)
        wanted = self.good("box.obj", "-s", 64, "-o", "-").stdout
        for ending in ("ac", "x", "lwo"):
            path = self.file("box." + ending, FILES[ending][0])
            for more in ([], ["--sandbox", "off"]) + ((["--sandbox", "require"],) if HAS_SANDBOX else ()):
                self.same(self.good(path, "-s", 64, "-o", "-", *more).stdout, wanted, ending)
            if ending != "lwo":
                self.same(self.good("-", "-s", 64, "-o", "-", stdin=path.read_bytes()).stdout, wanted)
            shutil.copy(path, self.folder / "nameless")
            self.same(self.good("nameless", "-s", 64, "-o", "-").stdout, wanted)
        # The variables of the environment select no other functions of the C library.
        plain = self.good("box.x", "-s", 64, "-o", "-").stdout
        self.assertEqual(self.good("box.x", "-s", 64, "-o", "-", env={"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-SSE4_1", "LC_ALL": "de_DE"}).stdout, plain)

    def test_fbx(self):
        self.file("up.fbx", fbx(z_up=True))
        self.assertEqual([round(n, 4) for n in self.info("up.fbx")["size"]], [1, 3, 2])
        material = self.info("up.fbx")["materials"][0]
        self.assertFalse(material.get("physical"))
        self.assertEqual(material["shininess"], 20)
        # The picture is found in the model's folder, by the last part of a path of another computer, in any case.
        self.file("model/wood.png", write_png(4, 2, b"\x40\x80\xff\xff" * 8))
        self.file("model/box.fbx", fbx(texture=True))
        info = self.info("model/box.fbx")
        self.assertTrue(info["textures"][0]["file"].endswith("Wood.PNG"), info["textures"])
        self.assertEqual(info["textures"][0]["width"], 4)
        self.file("model/lone/box.fbx", fbx(texture=True))
        done = self.good("model/lone/box.fbx", "-s", 16)
        self.assertEqual(done.stderr.count(b"warning"), 1)

    def test_fbx_warnings(self):
        """What Assimp loses without a word, and data that contradict each other, cost one warning."""
        lost = (' NodeAttribute: 500, "NodeAttribute::lamp", "Light" { TypeFlags: "Light"\n'
                '  Properties70: { P: "LightType", "enum", "", "",3 } }\n Model: 501, "Model::lamp", "Light" { Version: 232 }\n'
                ' NodeAttribute: 600, "NodeAttribute::eye", "Camera" { TypeFlags: "Camera"\n'
                '  Properties70: { P: "CameraProjectionType", "enum", "", "",1\n   P: "FieldOfView", "FieldOfView", "", "A",40 } }\n'
                ' Model: 601, "Model::eye", "Camera" { Version: 232 }\n}\n',
                'Connections: {\n C: "OO",500,501\n C: "OO",501,0\n C: "OO",600,601\n C: "OO",601,0\n')
        self.file("lost.fbx", fbx().replace("}\nConnections: {\n", "".join(lost)))
        done = self.good("lost.fbx", "-s", 16)
        self.assertIn(b"lost.fbx: its area lights are not drawn; its orthographic cameras show perspective\n", done.stderr)
        self.assertAlmostEqual(self.info("lost.fbx")["cameras"][0]["fovy_deg"], 40, places=3)
        self.file("point.fbx", fbx().replace("}\nConnections: {\n", "".join(lost)).replace('"enum", "", "",3', '"enum", "", "",0')
                  .replace('"enum", "", "",1', '"enum", "", "",0'))
        self.assertNotIn(b"not drawn", self.good("point.fbx", "-s", 16).stderr)
        self.file("twice.fbx", fbx().replace(' C: "OO",100,200\n', ' C: "OO",100,200\n' * 2))
        done = self.good("twice.fbx", "-s", 16)
        self.assertIn(b"twice.fbx: it contains an error, and is drawn as far as possible: Validation failed: aiNode::mMeshes", done.stderr)
        self.assertEqual([round(n, 4) for n in self.info("twice.fbx")["size"]], [1, 2, 3])
        self.assertTrue(1 << 20 < self.info("twice.fbx")["reader_memory_bytes"] < 1 << 32)

    def test_crash(self):
        """One sentence and exit 2; in a batch, the other models are drawn, and the worker lives."""
        crash = self.file("b.x", (SHAPES / "crash.x").read_bytes())
        self.bad(2, crash, says=["b.x: ", "lambent-import"])
        self.file("a.off", OFF)
        self.file("c.off", OFF)
        for more in ([], ["--isolate"], ["-j", 2]):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            done = self.run_program("a.off", "b.x", "c.off", "-s", 16, "-o", "out/", *more)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), ["a.png", "c.png"])

    def test_limits(self):
        many = "OFF\n300000 1 0\n" + "0 0 0\n" * 300000 + "3 0 1 2\n"
        self.file("many.off", many)
        self.bad(4, "many.off", "--memory-limit", "4MB", says="many.off: ")
        self.file("claim.off", "OFF\n2000000000 1 0\n0 0 0\n")
        self.bad(4, "claim.off", says=["claim.off: ", "memory"])
        self.file("box.off", OFF)
        self.bad(4, "box.off", "--triangle-limit", 5, says=["box.off: ", "--triangle-limit"])

    def test_mutations(self):
        self.mutate(BYTES, 12)

    @long
    def test_many_mutations(self):
        self.mutate(BYTES, 2500)

    def test_scene_file(self):
        self.file("box.ac", AC)
        self.file("scene.json", '{"lambent": 1, "objects": [{"file": "box.ac"}]}')
        self.assertEqual(self.info("scene.json")["counts"]["triangles"], 12)

    def test_missing(self):
        """Without the package, the sentence names it, and folders are drawn without these files."""
        shutil.copy(PROGRAM, self.folder / "lambent")
        self.file("models/box.fbx", fbx())
        self.file("models/box.obj", (self.folder / "cube.obj").read_bytes())
        alone = [str(self.folder / "lambent")]
        done = subprocess.run(alone + ["models/box.fbx"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr.decode(), "lambent: models/box.fbx: this is an FBX file, which the package lambent-formats reads "
                                               "(apt install lambent-formats)\n")
        done = subprocess.run(alone + ["formats"], stdout=subprocess.PIPE)
        self.assertIn("  fbx    .fbx  not installed: apt install lambent-formats\n", done.stdout.decode())
        self.assertNotIn("not installed", self.good("formats").stdout.decode().split("Pictures")[0])




def true_edges(name):
    """The edges of the shape that lambent-import marks: chains of sides between points at which not just two sides meet."""
    data = (SHAPES / name).read_bytes()
    request = struct.pack("<I16s16sIQQQdII", 3, b"occt", name.split(".")[-1].encode(), 60, 1 << 30, len(data), 1 << 30, 0.001, 0, 0)
    process = subprocess.Popen([BUILD / "lambent-import"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    process.stdin.write(request + data)
    process.stdin.flush()
    result, size = struct.unpack("<4xIQ416x", process.stdout.read(432))
    scene = process.stdout.read(size)
    process.communicate()
    length = struct.unpack_from("<I", scene, 12)[0]
    root, binary = json.loads(scene[20:20 + length]), scene[28 + length:]

    def array(accessor):
        accessor = root["accessors"][accessor]
        view = root["bufferViews"][accessor["bufferView"]]
        return memoryview(binary[view["byteOffset"]:][:view["byteLength"]]).cast({5121: "B", 5125: "I", 5126: "f"}[accessor["componentType"]])

    counts = {}
    for mesh in root["meshes"]:
        sides, primitive = set(), mesh["primitives"][0]
        positions, indices = array(primitive["attributes"]["POSITION"]), array(primitive["indices"])
        for triangle, inner in enumerate(array(primitive["extensions"]["LAMBENT_faces"]["inner"])):
            corners = [tuple(positions[3 * i:3 * i + 3]) for i in indices[3 * triangle:3 * triangle + 3]]
            sides |= {frozenset((corners[k], corners[(k + 1) % 3])) for k in range(3) if not inner >> k & 1}
        around = {}
        for side in sides:
            for point in side:
                around.setdefault(point, []).append(side)
        left, chains = set(sides), 0
        while left:
            chains, stack = chains + 1, [left.pop()]
            while stack:
                for point in stack.pop():
                    if len(around[point]) == 2:
                        stack += left.intersection(around[point])
                        left.difference_update(around[point])
        counts[mesh.get("name")] = chains
    return counts


# Made with OpenCASCADE: "stand" is a plate of 40 × 20 × 5 mm with a hole, orange with a blue top, and two pins of one part, in inches. "rounded" is a box
# of 40 × 30 × 20 with a fillet of radius 4 on each edge. "machine" has two instances, left and right, of the assembly "pair" of a red block and a pin, and
# a blue instance of the block; the pin of the right pair is green (a SHUO). "boxes" are two named solids of one group.
@unittest.skipUnless(HAS_OCCT, "this build has no OpenCASCADE")
class OpenCascade(Modules):
    STAND = {ending: (SHAPES / f"stand.{ending}").read_bytes() for ending in ("step", "iges", "brep")}
    VOLUME = (40 * 20 - math.pi * 16) * 5 + 2 * math.pi * 9 * 15  # mm³

    def test_shapes(self):
        for ending, (names, unit, pins) in {"step": (["plate:1", "pin:1", "p\u00efn:2"], "inch", 2), "iges": (["stand"], "inch", 2), "brep": ([], None, 1)}.items():
            with self.subTest(ending):
                info = self.info(self.file("stand." + ending, self.STAND[ending]))
                self.assertEqual((info["format"], info["up"], info["unit"]), (ending, "z", unit))
                scale = 1 if unit is None else 25.4
                for found, wanted in zip(info["size"], (40, 20, 20)):
                    self.assertAlmostEqual(found * scale, wanted, places=4)
                wanted = self.VOLUME - (2 - pins) * math.pi * 9 * 15
                self.assertAlmostEqual(info["measure"]["volume"] * scale**3 / wanted, 1, delta=0.01)
                self.assertEqual([n["name"] for n in info["names"] if n["objects"]], names)
                if unit:  # colours are decoded from sRGB; a face's own colour replaces its part's
                    colors = sorted(m["diffuse"] for m in info["materials"])
                    for found, wanted in zip(colors, ((0.01, 0.0331, 0.7874), (0.2140,) * 3, (0.6038, 0.1329, 0.0331))):
                        for a, b in zip(found, wanted):
                            self.assertAlmostEqual(a, b, delta=0.002)

    def test_deflection(self):
        path = self.file("stand.step", self.STAND["step"])
        counts = [json.loads(self.good(path, "-s", 32, "--json", "-o", "a.png", *more).stdout)["model"]["triangles"]
                  for more in (["--deflection", "0.01"], [], ["--deflection", "0.00025"], ["--deflection", "1e-5"])]
        self.assertTrue(counts[0] < counts[1] == counts[2] < counts[3], counts)
        self.bad(1, path, "--deflection", 0.5, says="--deflection")
        self.assertIn(b"'--deflection' applies only to STEP", self.good("cube.obj", "--deflection", 0.01, "-s", 16, "-o", "a.png").stderr)

    def test_measures(self):
        """Area and volume of the exact shape: the triangles of the pins and the hole deviate by 0.1 percent."""
        area = 2 * (40 * 20 - math.pi * 16) + 120 * 5 + 40 * math.pi + 2 * (2 * math.pi * 9 + 90 * math.pi)
        for ending in ("step", "iges", "brep"):
            info = self.info(self.file("stand." + ending, self.STAND[ending]))
            pins = 1 if ending == "brep" else 2
            scale = 1 if info["unit"] is None else 25.4
            self.assertTrue(info["measure"]["exact"] and info["measure"]["closed"])
            self.assertAlmostEqual(info["measure"]["volume"] * scale**3 / (self.VOLUME - (2 - pins) * math.pi * 135), 1, delta=1e-6)
            self.assertAlmostEqual(info["measure"]["area"] * scale**2 / (area - (2 - pins) * math.pi * 108), 1, delta=1e-6)
        self.assertIn("volume 4.597 cm\u00b3 (of the exact shape)", self.good("info", "stand.step").stdout.decode())
        self.assertFalse(self.info("cube.obj")["measure"]["exact"])

    def test_assemblies(self):
        """The names of assemblies and of their instances stand for all parts; a style of one instance changes no other."""
        self.file("machine.step", (SHAPES / "machine.step").read_bytes())
        info = self.info("machine.step")
        self.assertEqual({n["name"]: (n["objects"], n["groups"]) for n in info["names"]},
                         {"block:1": (2, 0), "pin:1": (2, 0), "lone": (1, 0), "machine": (0, 1), "left": (0, 1), "right": (0, 1),
                          "pair": (0, 2), "block": (0, 0), "pin": (0, 0)})

        def shown(*words):
            picture = read_png(self.good("machine.step", "-s", 96, "--view", "front", "-b", "white", *words, "-o", "-").stdout)
            return {name for name, seen in {"red": lambda r, g, b: r > 2 * g and r > 2 * b, "green": lambda r, g, b: g > 2 * r and g > 2 * b,
                                            "blue": lambda r, g, b: b > 2 * r and b > 2 * g, "grey": lambda r, g, b: r == g == b < 250}.items()
                    if any(seen(*pixel(picture, x, y)[:3]) for x in range(96) for y in range(96))}

        self.assertEqual(shown(), {"red", "green", "blue", "grey"})
        self.assertEqual(shown("--only", "left"), {"red", "grey"})
        self.assertEqual(shown("--only", "right"), {"red", "green"})
        self.assertEqual(shown("--only", "pin"), {"green", "grey"})  # the name of a part
        self.assertEqual(shown("--hide", "pair"), {"blue"})  # the blue instance of the red block
        self.assertEqual(shown("--hide", "right", "--hide", "lone"), {"red", "grey"})
        self.bad(1, "machine.step", "--hide", "lefd", says="did you mean 'left'?")

    def test_iges_names(self):
        """Names of solids within one shape: by a property (406), and by a label of eight characters."""
        self.file("boxes.iges", (SHAPES / "boxes.iges").read_bytes())
        self.assertEqual([(n["name"], n["parts"]) for n in self.info("boxes.iges")["names"] if n["parts"]], [("large box", 1), ("small", 1)])
        both, large = (self.good("boxes.iges", "-s", 64, "--view", "front", *words, "-o", "-").stdout for words in ((), ("--hide", "small")))
        self.assertNotEqual(both, large)

    def test_names(self):
        self.file("stand.step", self.STAND["step"])
        whole = self.good("stand.step", "-s", 64, "-o", "-").stdout
        hidden = self.good("stand.step", "-s", 64, "--hide", "plate:1", "-o", "-").stdout
        self.assertNotEqual(hidden, whole)
        self.assertNotEqual(self.good("stand.step", "-s", 64, "--hide", "plate", "-o", "-").stdout, whole)  # the part's name
        self.assertEqual(self.good("stand.step", "-s", 64, "--only", "pin:1", "--only", "p\u00efn:2", "-o", "-").stdout, hidden)
        self.bad(1, "stand.step", "-s", 64, "--hide", "bolt", says="plate:1")

    def test_edges(self):
        """The library's own counts of edges, without the seams of cylinders and the poles of spheres: no angle decides."""
        self.assertEqual(true_edges("rounded.brep"), {None: 48})  # TopExp: 56, of which 8 poles; all of them are tangent
        self.assertEqual(true_edges("stand.step"), {"plate": 14, "pin": 2})  # 15 and 3, of which one seam each
        path = self.file("rounded.brep", (SHAPES / "rounded.brep").read_bytes())
        plain, drawn = (self.good(path, "-s", 64, "--view", "top", *more, "-o", "-").stdout for more in ([], ["--edges", "crease"]))
        self.assertNotEqual(plain, drawn)

    def test_same_bytes(self):
        """The same bytes for each number of threads and each instruction set."""
        for ending, data in self.STAND.items():
            path = self.file("stand." + ending, data)
            wanted = self.good(path, "-s", 96, "--edges", "all", "-o", "-").stdout
            for more in (["--threads", 1], ["--threads", 5], ["--isa", "scalar"], ["--sandbox", "off"]):
                self.assertEqual(self.good(path, "-s", 96, "--edges", "all", "-o", "-", *more).stdout, wanted, more)
            self.assertEqual(self.good("-", "-s", 96, "--edges", "all", "-o", "-", stdin=data).stdout, wanted)

    def test_damaged(self):
        for ending, data in self.STAND.items():
            for size in (100, len(data) // 2):
                path = self.file("cut." + ending, data[:size])
                self.bad(2, path, says=[f"cut.{ending}: ", "cannot read the " + ending])
        self.file("few.step", self.STAND["step"])
        self.bad(4, "few.step", "--triangle-limit", 100, says=["few.step: ", "--triangle-limit"])
        claim = ("DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 0\nPolygon3D 0\n"
                 "PolygonOnTriangulations 0\nSurfaces 0\nTriangulations 1\n2000000000 2000000000 1 0\n")
        self.bad(4, self.file("claim.brep", claim), says=["claim.brep: ", "memory"])
        self.bad(4, self.file("long.brep", claim.replace("Locations 0", "Locations 2000000000")), "--time-limit", 1, says="long.brep: ")

    def test_mutations(self):
        self.mutate(self.STAND, 12)

    @long
    def test_many_mutations(self):
        self.mutate(self.STAND, 700)

    def test_missing(self):
        shutil.copy(PROGRAM, self.folder / "lambent")
        for name, data, described in (("part.step", self.STAND["step"], "a STEP file"), ("part.igs", self.STAND["iges"], "an IGES file"),
                                      ("part.brep", self.STAND["brep"], "a BREP file")):
            self.file(name, data)
            done = subprocess.run([str(self.folder / "lambent"), name], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual((done.returncode, done.stderr.decode()), (3, f"lambent: {name}: this is {described}, which the package lambent-formats reads "
                                                                      "(apt install lambent-formats)\n"))
        self.assertIn("  step   .step stp  with lambent-formats\n", self.good("formats").stdout.decode())
