# test_3mf.py: typical, faulty and hostile 3MF files.
import io
import json
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import unittest
import zipfile
import zlib

from harness import PROGRAM, ROOT, Case, check_value, long, write_png

SCHEMA = json.loads((ROOT / "docs" / "info.schema.json").read_text())
CORE = 'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"'
MATERIALS = 'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"'
PRODUCTION = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"'
RELATION = '<Relationship Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="%s" Id="r"/>'
FACES = ((0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7))
PROBLEM = "this build does not support 3MF"


def relations(*targets):
    return ('<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">' +
            "".join(RELATION % target for target in targets) + "</Relationships>")


def package(files, compression=zipfile.ZIP_DEFLATED):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", compression) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return out.getvalue()


def box(x=1, y=1, z=1, properties=lambda face: ""):
    """The <mesh> of a box from 0/0/0 to x/y/z."""
    corners = [(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0), (0, 0, z), (x, 0, z), (x, y, z), (0, y, z)]
    return ("<mesh><vertices>" + "".join('<vertex x="%s" y="%s" z="%s"/>' % corner for corner in corners) + "</vertices><triangles>" +
            "".join('<triangle v1="%d" v2="%d" v3="%d"%s/>' % (*face, properties(i // 2)) for i, face in enumerate(FACES)) +
            "</triangles></mesh>")


def model(resources, items='<item objectid="1"/>', attributes="", spaces=CORE):
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<model {spaces} {attributes}><resources>{resources}</resources><build>{items}</build></model>'


class ThreeMF(Case):
    def setUp(self):
        super().setUp()
        probe = self.run_program("info", self.save("probe.3mf", model(f'<object id="1">{box()}</object>')))
        if PROBLEM in probe.stderr.decode() or "is not installed" in probe.stderr.decode():
            self.skipTest(probe.stderr.decode().strip())

    def save(self, name, root, compression=zipfile.ZIP_DEFLATED, **more):
        files = {"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": root}
        files.update({key.replace("__", "/").replace("_dot_", "."): value for key, value in more.items()})
        return self.save_bytes(name, package(files, compression))

    def save_bytes(self, name, data):
        (self.folder / name).write_bytes(data)
        self.given.add(name)
        return name

    def pixels(self, name, view, *places):
        width, height, pixels = self.png(name, "-s", 64, "--view", view, "--show", "base-color", "--projection", "orthographic", "--samples", 1, "-o", "-")
        return [tuple(pixels[4 * (int(y * height) * width + int(x * width)):][:3]) for x, y in places]

    def info(self, name, *words):
        row = json.loads(self.good("info", "--json", name, *words).stdout)
        check_value(self, row, SCHEMA, "info", SCHEMA)
        return row


class Read(ThreeMF):
    def test_units_and_measure(self):
        """Units, size in millimetres, area and volume; Z is up."""
        for unit, millimetres, name in (("", 1, "millimetre"), ("micron", 1e-3, "micrometre"), ("centimeter", 10, "centimetre"), ("inch", 25.4, "inch"),
                                        ("foot", 304.8, "foot"), ("meter", 1000, "metre")):
            row = self.info(self.save("a.3mf", model(f'<object id="1">{box(1, 2, 3)}</object>', attributes=f'unit="{unit}"' if unit else "")))
            self.assertEqual((row["format"], row["unit"], row["up"], row["size"]), ("3mf", name, "z", [1, 2, 3]))
            measure = row["measure"]
            self.assertEqual((measure["closed"], measure["area"]), (True, 22))
            for key, wanted in (("volume", 6), ("area_mm2", 22 * millimetres**2), ("volume_mm3", 6 * millimetres**3)):
                self.assertAlmostEqual(measure[key] / wanted, 1, 9, key)
            for axis in range(3):
                self.assertAlmostEqual(measure["size_mm"][axis] / millimetres, axis + 1, 9)
        text = self.good("info", self.save("a.3mf", model(f'<object id="1">{box(1, 2, 3)}</object>', attributes='unit="inch"'))).stdout.decode()
        self.assertIn("1 × 2 × 3 in (25.4 × 50.8 × 76.2 mm), z up", text)
        self.assertRegex(text, r"area 141.9 cm², closed: volume 98.32 cm³")

    def test_transforms_and_instances(self):
        """Components within components, rotated; each item is an object, a mesh is stored once."""
        resources = (f'<object id="5" name="leaf">{box()}</object>'
                     '<object id="6"><components><component objectid="5" transform="0 1 0 -1 0 0 0 0 1 10 0 0"/><component objectid="5"/></components></object>'
                     '<object id="1"><components><component objectid="6" transform="2 0 0 0 2 0 0 0 2 0 0 0"/></components></object>'
                     f'<object id="9" name="unused">{box(100, 100, 100)}</object>')
        row = self.info(self.save("a.3mf", model(resources, '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 7"/><item objectid="5"/>')))
        self.assertEqual((row["counts"]["objects"], row["counts"]["meshes"], row["counts"]["triangles"]), (3, 1, 36))
        # (x, y) becomes (10 − y, x), and the result is doubled.
        self.assertEqual((row["bounds"]["min"], row["bounds"]["max"]), ([0, 0, 0], [20, 2, 9]))

    def test_parts(self):
        """The production extension: parts with their own units, as slicers write them."""
        root = model('<object id="1"><components><component objectid="3" p:path="/3D/Objects/a_1.model"/></components></object>'
                     f'<object id="2">{box()}</object>', '<item objectid="1" p:UUID="x"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 50 0 0"/>',
                     'requiredextensions="p" unit="millimeter"', f'{CORE} {PRODUCTION} xmlns:v="http://example.com/package/2021"')
        part = model(f'<object id="3">{box(1, 1, 1)}</object>', "", 'unit="centimeter"')
        name = self.save("a.3mf", root, **{"3D__Objects__a_1_dot_model": part})
        row = self.info(name)
        self.assertEqual((row["size"], row["counts"]["objects"]), ([51, 10, 10], 2))
        self.assertEqual([(e["required"], e["support"]) for e in row["extensions"]], [(True, "supported"), (False, "unknown")])
        self.bad(2, "info", self.save("b.3mf", root), says="its part 3D/Objects/a_1.model cannot be read")
        self.bad(3, "info", self.save("c.3mf", root.replace('requiredextensions="p"', 'requiredextensions="p v"')),
                 says=("requires the extension", "package/2021", "--lenient"))
        self.good("info", "--lenient", self.save("d.3mf", root.replace('requiredextensions="p"', 'requiredextensions="v"'), **{"3D__Objects__a_1_dot_model": part}))

    def test_base_materials(self):
        """Named materials with colours: the triangles of a material are a part; triangles without a material keep the default."""
        materials = '<basematerials id="2"><base name="red PLA" displaycolor="#FF0000"/><base name="clear" displaycolor="#0000FF80"/></basematerials>'
        name = self.save("a.3mf", model(materials + f'<object id="1" pid="2" pindex="0">{box(1, 1, 1, lambda face: " p1=%s1%s" % (chr(34), chr(34)) if face == 3 else "")}</object>'))
        row = self.info(name)
        self.assertEqual([(m["name"], m["diffuse"]) for m in row["materials"]], [("red PLA", [1, 0, 0]), ("clear", [0, 0, 1])])
        self.assertAlmostEqual(row["materials"][1]["opacity"], 128 / 255, 6)
        self.assertEqual(row["counts"]["parts"], 2)
        width, height, pixels = self.png(name, "-s", 16, "--view", "front", "--show", "base-color", "-o", "-")
        self.assertEqual(tuple(pixels[4 * (8 * width + 8):][:3]), (255, 0, 0))

    def pixel(self, name, view, at=(0.5, 0.5)):
        return self.pixels(name, view, at)[0]

    def test_colors(self):
        """Colour groups: colours of triangles and of corners, a default of the object, and composites."""
        def properties(face):
            return {2: ' pid="2" p1="0"', 3: ' pid="2" p1="1" p2="1" p3="1"', 4: ' pid="4" p1="0"', 5: ' pid="5" p1="0"'}.get(face, "")
        groups = ('<m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#8000FFFF"/></m:colorgroup>'
                  '<basematerials id="3"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#0000FF"/></basematerials>'
                  '<m:compositematerials id="4" matid="3" matindices="0 1"><m:composite values="1 0"/></m:compositematerials>'
                  '<m:multiproperties id="5" pids="2 2" blendmethods="multiply"><m:multi pindices="0 1"/></m:multiproperties>')
        name = self.save("a.3mf", model(groups + f'<object id="1">{box(1, 1, 1, properties)}</object>', spaces=f"{CORE} {MATERIALS}"))
        self.assertEqual(self.pixel(name, "front"), (0, 255, 0))
        self.assertEqual(self.pixel(name, "right"), (128, 0, 255))
        self.assertEqual(self.pixel(name, "back"), (255, 0, 0))
        self.assertEqual(self.pixel(name, "left"), (0, 0, 0))
        default = self.save("b.3mf", model(f'<object id="1">{box()}</object>'))
        self.assertEqual(self.pixel(name, "top"), self.pixel(default, "top"))

    def test_converted_colors(self):
        """Colours of corners stay in 3MF and in OBJ, which repeats vertices; a model without materials warns of none."""
        group = '<m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#8000FF"/></m:colorgroup>'
        words = {2: ' pid="2" p1="0"', 3: ' pid="2" p1="1" p2="0" p3="1"'}
        mesh = box(properties=lambda face: words.get(face, ""))
        name = self.save("a.3mf", model(f'{group}<object id="1">{mesh}</object>', spaces=f"{CORE} {MATERIALS}"))
        for output in ("b.3mf", "b.obj"):
            self.assertEqual(json.loads(self.good("convert", name, output, "--json").stdout)["losses"], [])
            self.given |= self.new_files()
            for view in ("front", "right", "back"):
                pictures = [self.png(file, "-s", 64, "--view", view, "-o", "-")[2] for file in (name, output)]
                self.assertLessEqual(max(abs(a - b) for a, b in zip(*pictures)), 1, (output, view))
        losses = json.loads(self.good("convert", "cube.stl", "c.glb", "--json").stdout)["losses"]
        self.given |= self.new_files()
        self.assertEqual(losses, [])

    def test_texture(self):
        """A texture's lower left corner is (0, 0); a missing picture causes a warning."""
        picture = write_png(2, 2, bytes([255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255]))
        groups = ('<m:texture2d id="2" path="/3D/t.png" contenttype="image/png" filter="nearest"/><m:texture2dgroup id="3" texid="2">'
                  '<m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0"/><m:tex2coord u="1" v="1"/><m:tex2coord u="0" v="1"/></m:texture2dgroup>')
        square = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="1" y="0" z="1"/><vertex x="0" y="0" z="1"/></vertices>'
                  '<triangles><triangle v1="0" v2="1" v3="2" pid="3" p1="0" p2="1" p3="2"/><triangle v1="0" v2="2" v3="3" pid="3" p1="0" p2="2" p3="3"/></triangles></mesh>')
        root = model(f'{groups}<object id="1">{square}</object>', spaces=f"{CORE} {MATERIALS}")
        name = self.save("a.3mf", root, **{"3D__t_dot_png": picture})
        self.assertEqual([self.pixel(name, "front", at) for at in ((0.3, 0.3), (0.7, 0.3), (0.3, 0.7), (0.7, 0.7))],
                         [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)])
        done = self.good(self.save("b.3mf", root), "-s", 8, "-o", "-")
        self.assertIn(b"its part 3D/t.png cannot be read: the archive has no part of this name; drawn without it", done.stderr)

    def test_layers(self):
        """Textures over a base colour are mixed with it; an opaque base stays opaque."""
        clear = write_png(2, 2, bytes([255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 0, 255, 255, 255, 255]))
        groups = ('<basematerials id="5"><base name="a" displaycolor="#00FFFF"/><base name="b" displaycolor="#FF00FF"/></basematerials>'
                  '<m:texture2d id="2" path="/3D/t.png" contenttype="image/png" filter="nearest"/><m:texture2dgroup id="3" texid="2">'
                  '<m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0"/><m:tex2coord u="1" v="1"/><m:tex2coord u="0" v="1"/></m:texture2dgroup>'
                  '<m:multiproperties id="4" pids="5 3"%s>%s</m:multiproperties>')
        square = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="1" y="0" z="1"/><vertex x="0" y="0" z="1"/></vertices>'
                  '<triangles><triangle v1="0" v2="1" v3="2" pid="4" p1="0" p2="1" p3="2"/><triangle v1="0" v2="2" v3="3" pid="4" p1="0" p2="2" p3="3"/></triangles></mesh>')

        def save(name, blend="", last=0):
            multi = "".join(f'<m:multi pindices="{last if i == 3 else 0} {i}"/>' for i in range(4))
            return self.save(name, model(groups % (blend, multi) + f'<object id="1">{square}</object>', spaces=f"{CORE} {MATERIALS}"), **{"3D__t_dot_png": clear})

        corners = ((0.3, 0.3), (0.7, 0.3), (0.3, 0.7), (0.7, 0.7))
        name = save("a.3mf")
        self.assertEqual([self.pixel(name, "front", at) for at in corners], [(255, 0, 0), (0, 255, 255), (0, 255, 255), (255, 255, 255)])
        self.assertEqual(self.info(name)["warnings"], [])
        name = save("b.3mf", ' blendmethods="multiply"')
        self.assertEqual(self.pixel(name, "front", (0.3, 0.3)), (0, 0, 0))
        name = save("c.3mf", last=1)  # different colours under a texture
        self.assertIn("without mixing their layers", " ".join(self.info(name)["warnings"]))

    def test_display_properties(self):
        """Metals and dielectrics, assigned to the group or to the element, also if they are defined later."""
        groups = ('<basematerials id="2" displaypropertiesid="7"><base name="a" displaycolor="#FFAA00"/><base name="b" displaycolor="#FFAA00"/></basematerials>'
                  '<basematerials id="3"><base name="c" displaycolor="#FFAA00" displaypropertiesid="8"/></basematerials>'
                  '<m:pbmetallicdisplayproperties id="7"><m:pbmetallic name="x" metallicness="1" roughness="0.25"/><m:pbmetallic name="y"/>'
                  '</m:pbmetallicdisplayproperties>'
                  '<m:pbspeculardisplayproperties id="8"><m:pbspecular name="z" specularcolor="#FF0000" glossiness="0.5"/></m:pbspeculardisplayproperties>')
        root = model(groups + f'<object id="1" pid="2" pindex="0">{box()}</object>', spaces=f"{CORE} {MATERIALS}")
        found = {row["name"]: row for row in self.info(self.save("a.3mf", root))["materials"]}
        self.assertEqual((found["a"]["metallic"], found["a"]["roughness"]), (1, 0.25))
        self.assertEqual((found["b"]["metallic"], found["b"]["roughness"]), (0, 1))
        self.assertEqual((found["c"]["metallic"], found["c"]["roughness"]), (0, 0.5))

    def test_undeclared_prefix(self):
        """As in the consortium's samples: Lambent refuses the name, and with --lenient reads it as a name of the surrounding element."""
        root = model('<basematerials id="2"><base name="a" displaycolor="#C0C0C0" displaypropertiesid="9"/></basematerials>'
                     f'<object id="1" pid="2" pindex="0">{box()}</object><m:pbmetallicdisplayproperties id="9"><ms:pbmetallic name="x" metallicness="1" '
                     'roughness="0.25"/></m:pbmetallicdisplayproperties>', spaces=f"{CORE} {MATERIALS}")
        name = self.save("a.3mf", root)
        self.bad(2, "info", name, says=("3D/3dmodel.model:2: found the name ms:pbmetallic, whose prefix is not declared", "--lenient"))
        self.assertEqual(self.info(name, "--lenient")["materials"][0]["metallic"], 1)

    def test_beams_and_slices(self):
        beams = 'xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"'
        lattice = '<b:beamlattice radius="1" minlength="0.1"><b:beams><b:beam v1="0" v2="1"/><b:beam v1="1" v2="2"/></b:beams></b:beamlattice></mesh>'
        root = model(f'<object id="1">{box().replace("</mesh>", lattice)}</object>', spaces=f"{CORE} {beams}")
        self.assertIn("not drawn: the beams of its lattices (2)", " ".join(self.info(self.save("a.3mf", root))["warnings"]))
        alone = root[:root.index("<triangles>")] + root[root.index("</triangles>") + 12:]
        self.bad(3, "info", self.save("b.3mf", alone), says="its objects contain only beams (2) and no triangles; lambent does not draw beams")
        slices = 'xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07"'
        root = model(f'<object id="1" s:slicestackid="3">{box()}</object>', spaces=f"{CORE} {slices}")
        self.assertIn("not drawn: slices; objects with slices (1)", " ".join(self.info(self.save("c.3mf", root))["warnings"]))

    def test_not_an_archive(self):
        """Errors of files with any content whose name ends in .3mf."""
        whole = package({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": model(f'<object id="1">{box()}</object>')})
        for data, says in ((whole[:40], "the file is truncated: found 40 bytes of a ZIP archive"), (whole[:-30], "the file is truncated"),
                           (b"hello there", "not a ZIP archive, as a 3MF file is: found 11 bytes"), (package({"a": "b"}), "_rels/.rels cannot be read")):
            self.bad(2, "info", self.save_bytes("a.3mf", data), says=says)

    def test_names_of_parts(self):
        """The relationships determine the root part; the file may have any name, or none."""
        data = package({"_rels/.rels": relations("/Elsewhere/Thing.MODEL.model"), "Elsewhere/Thing.MODEL.model": model(f'<object id="1">{box()}</object>')})
        self.save_bytes("noise", data)
        self.assertEqual(self.info("noise")["format"], "3mf")
        self.good("-", "-s", 8, "-o", "-", stdin=data)
        self.bad(2, "info", self.save_bytes("none.3mf", package({"_rels/.rels": relations(), "a.model": "x"})), says="names no 3D model")
        self.bad(2, "info", self.save_bytes("two.3mf", package({"_rels/.rels": relations("/a.model", "/b.model"), "a.model": "x"})), says="second 3D model")
        self.bad(2, "info", self.save_bytes("zip.3mf", package({"letter.txt": "hello"})), says="its part _rels/.rels cannot be read: the archive has no part of this name")

    def test_sandbox(self):
        """Lambent opens the libraries and reads the file inside the sandbox, also in a batch."""
        name = self.save("a.3mf", model(f'<object id="1">{box()}</object>'))
        if self.run_program("cube.obj", "-s", 8, "--sandbox", "require", "-o", "-").returncode == 3:
            self.skipTest("no complete sandbox here")
        plain = self.good(name, "-s", 32, "--sandbox", "off", "-o", "-").stdout
        self.assertEqual(self.good(name, "-s", 32, "--sandbox", "require", "-o", "-").stdout, plain)
        self.good("-q", "batch", name, "cube.obj", "--isolate", "-s", 32, "--sandbox", "require", "-o", "out/")
        self.assertEqual((self.folder / "out" / "a.png").read_bytes()[:4], b"\x89PNG")

    def test_unknown_properties(self):
        """Property groups of other vendors, and elements that a group lacks: one warning, and the default colour."""
        vendor = '<v:mats id="9" xmlns:v="http://example.com/2016"/>'
        groups = f'{vendor}<m:colorgroup id="2"><m:color color="#FF0000"/></m:colorgroup>'
        third = ("<triangle ", '<triangle pid="2" p1="0" p2="0" p3="8" ', 1)
        for words, of_triangle, says in (('pid="9" pindex="0"', (), 'pid="9", p1="0"'), ('pid="7" pindex="0"', (), 'pid="7", p1="0"'),
                                         ('pid="2" pindex="1"', (), 'pid="2", p1="1"'), ("", third, 'pid="2", p3="8"')):
            mesh = box().replace(*of_triangle) if of_triangle else box()
            name = self.save("a.3mf", model(f'{groups}<object id="1" {words}>{mesh}</object>', spaces=f"{CORE} {MATERIALS}"))
            warnings = self.info(name)["warnings"]
            self.assertEqual(len(warnings), 1, warnings)
            self.assertIn("unknown property (" + says, warnings[0])

    def test_zip64(self):
        """Microsoft's 3D Builder writes ZIP64 records also in small files."""
        data = package({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": model(f'<object id="1">{box()}</object>')})
        end = data.rindex(b"PK\5\6")
        size, start = struct.unpack_from("<II", data, end + 12)
        record = struct.pack("<IQHHIIQQQQ", 0x06064b50, 44, 45, 45, 0, 0, 2, 2, size, start) + struct.pack("<IIQI", 0x07064b50, 0, end, 1)
        for counts in ((0xffff, 0xffff), (2, 2)):
            name = self.save_bytes("a.3mf", data[:end] + record + struct.pack("<IHHHHIIH", 0x06054b50, 0, 0, *counts, 0xffffffff, 0xffffffff, 0))
            self.assertEqual(self.info(name)["counts"]["triangles"], 12)

    @unittest.skipUnless(shutil.which("bwrap"), "no bubblewrap")
    def test_library_missing(self):
        """Without expat, an error message names the package; other formats still work."""
        name = self.save("a.3mf", model(f'<object id="1">{box()}</object>'))
        for library, files, debian in (("libexpat.so.1", "libexpat.so.1", "libexpat1"),):
            found = [path for folder in ("/usr/lib", "/lib") for path in pathlib.Path(folder).glob(f"*/{files}")]
            hide = [word for path in found for word in ("--ro-bind", "/dev/null", str(path.resolve()))]
            box_words = ["bwrap", "--dev-bind", "/", "/", *hide, "--chdir", str(self.folder), PROGRAM]
            if subprocess.run([*box_words, "--version"], capture_output=True).returncode:
                self.skipTest("bubblewrap cannot make a sandbox here")
            done = subprocess.run([*box_words, "info", name], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(f"needs {library}, which is not installed (Debian's package {debian})", done.stderr)
            self.assertEqual(subprocess.run([*box_words, "info", "cube.obj"], capture_output=True).returncode, 0)


SLIC3R = 'xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06"'
RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
COLORS = {"Metadata__Slic3r_PE_dot_config": '; generated\n; extruder_colour = "";#00FF00;""\n; filament_colour = #FF0000;#123456;#0000FF\n'}
PROJECT = {"Metadata__project_settings_dot_config": '{"other": [1], "filament_colour": ["#FF0000", "#00FF00FF", "#0000FF"]}'}


def boxes(*origins, painted=""):
    """One <mesh> of unit boxes; `painted` is an attribute of the first box's two front triangles."""
    corners = [(x + a, y + b, z + c) for x, y, z in origins for a, b, c in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]
    faces = [[8 * i + v for v in face] for i in range(len(origins)) for face in FACES]
    return ("<mesh><vertices>" + "".join('<vertex x="%s" y="%s" z="%s"/>' % corner for corner in corners) + "</vertices><triangles>" + "".join(
        '<triangle v1="%d" v2="%d" v3="%d"%s/>' % (*face, f" {painted}" if i in (4, 5) else "") for i, face in enumerate(faces)) + "</triangles></mesh>")


def prusa(*volumes, extruder=1):
    rows = "".join(f'<volume firstid="{first}" lastid="{last}">' + "".join(f'<metadata type="volume" key="{key}" value="{value}"/>' for key, value in keys) +
                   "</volume>" for first, last, *keys in volumes)
    return {"Metadata__Slic3r_PE_model_dot_config": f'<?xml version="1.0"?>\n<config><object id="1" instances_count="1">{rows}'
            f'<metadata type="object" key="extruder" value="{extruder}"/></object></config>'}


def bambu(objects):
    text = "".join(f'<object id="{number}"><metadata key="extruder" value="{extruder}"/>' + "".join(
        f'<part id="{part}" subtype="{kind}"><metadata key="extruder" value="{own}"/></part>' for part, kind, own in parts) + "</object>"
        for number, extruder, parts in objects)
    return {"Metadata__model_settings_dot_config": f"<config>{text}<plate/></config>"}


class Slicers(ThreeMF):
    """Projects of PrusaSlicer, Bambu Studio and OrcaSlicer: the parts that print, in the colours of their filaments."""

    def front(self, name, *places):
        return self.pixels(name, "front", *places)

    def test_prusa(self):
        mesh = boxes((0, 0, 0), (2, 0, 0), (4, 0, 0), (6, 0, 0), (8, 0, 0), (10, 0, 0))
        kinds = ("ModelPart", "NegativeVolume", "ParameterModifier", "SupportEnforcer", "SupportBlocker", "ModelPart")
        volumes = [(12 * i, 12 * i + 11, ("volume_type", kind)) for i, kind in enumerate(kinds)]
        volumes[5] += (("extruder", 3),)
        for order in (volumes, volumes[::-1]):
            name = self.save("a.3mf", model(f'<object id="1">{mesh}</object>', spaces=f"{CORE} {SLIC3R}"), **COLORS, **prusa(*order, extruder=2))
            row = self.info(name)
            self.assertEqual((row["size"], row["measure"]["closed"], row["measure"]["volume"], row["counts"]["triangles"]), ([11, 1, 1], True, 2, 24))
            self.assertEqual(row["warnings"], [f"{name}: not drawn, because they do not print: modifiers (1), support enforcers (1), support blockers (1), negative volumes (1)"])
            self.assertEqual(self.front(name, (0.05, 0.5), (0.95, 0.5)), [GREEN, BLUE])
        old = self.save("b.3mf", model(f'<object id="1">{boxes((0, 0, 0), (2, 0, 0))}</object>'), **prusa((0, 11), (12, 23, ("modifier", 1))))
        self.assertEqual(self.info(old)["measure"]["volume"], 1)
        odd = self.save("c.3mf", model(f'<object id="1">{boxes((0, 0, 0))}</object>'), **prusa((0, 11, ("volume_type", "Ghost"), ("extruder", 2))))
        self.assertEqual(len(self.info(odd)["warnings"]), 2)
        self.assertIn('unknown kind "Ghost", drawn as one that prints', self.info(odd)["warnings"][0])

    def test_bambu(self):
        leaves = "".join(f'<object id="{i}" type="{kind}">{boxes((2 * i, 0, 0))}</object>' for i, kind in ((1, "model"), (2, "other"), (3, "other"), (4, "model")))
        components = [f'<component p:path="/3D/Objects/o.model" objectid="{i}"/>' for i in range(1, 5)]
        root = model(f'<object id="7"><components>{"".join(components)}</components></object><object id="8"><components>{components[0]}</components></object>',
                     '<item objectid="7"/><item objectid="8" transform="1 0 0 0 1 0 0 0 1 0 0 2"/><item objectid="8" printable="0"/>', 'requiredextensions="p"', f"{CORE} {PRODUCTION}")
        config = bambu([(7, 1, [(1, "normal_part", 0), (2, "negative_part", 0), (3, "modifier_part", 0), (4, "normal_part", 3)]), (8, 2, [(1, "normal_part", 0)])])
        name = self.save("a.3mf", root, **{"3D__Objects__o_dot_model": model(leaves, "")}, **PROJECT, **config)
        row = self.info(name)
        self.assertEqual((row["counts"]["objects"], row["counts"]["meshes"], row["measure"]["volume"]), (3, 3, 3))
        self.assertEqual(row["warnings"], [f'{name}: not drawn, because they do not print: modifiers (1), negative volumes (1), items with printable="0" (1)'])
        # The object 1 twice, above with the filament of another object; the object 4 on the right.
        self.assertEqual(self.front(name, (0.05, 0.7), (0.05, 0.3), (0.95, 0.7)), [RED, GREEN, BLUE])
        # Without the configuration, the type "other" still says that an object does not print.
        self.assertEqual(self.info(self.save("b.3mf", root, **{"3D__Objects__o_dot_model": model(leaves, "")}))["counts"]["objects"], 3)

    def test_paintings(self):
        """Painted triangles, whole and subdivided. Neighbours are cut too, so the mesh stays closed."""
        corner, middle, far = (0.9, 0.9), (0.6, 0.65), (0.3, 0.95)  # of the lower right triangle of the front
        for i, (painting, colors, triangles) in enumerate((("4", (RED, RED, RED), 12), ("8", (GREEN, GREEN, GREEN), 12), ("0C", (BLUE, BLUE, BLUE), 12), ("", (RED, RED, RED), 12),
                                            ("00083", (RED, GREEN, RED), 22), ("8000083", (RED, GREEN, RED), 22), ("0C0043", None, 22), ("845", None, 16),
                                            ("8481", None, 16), ("484856", None, 24), ("zz", (RED, RED, RED), 12), ("3", None, 22), ("9C", (RED, RED, RED), 12))):
            attribute, settings = ((f'slic3rpe:mmu_segmentation="{painting}"', COLORS), (f'paint_color="{painting}"', PROJECT))[i % 2]
            name = self.save("a.3mf", model(f'<object id="1">{boxes((0, 0, 0), painted=attribute)}</object>', spaces=f"{CORE} {SLIC3R}"), **settings)
            row = self.info(name)
            measure = row["measure"]
            self.assertEqual((measure["closed"], round(measure["volume"], 6), round(measure["area"], 6)), (True, 1, 6), painting)
            self.assertEqual(row["counts"]["triangles"], triangles, painting)
            self.assertEqual(bool(row["warnings"]), painting in ("8000083", "zz", "3", "9C", "8481"), (painting, row["warnings"]))
            if colors:
                self.assertEqual(tuple(self.front(name, corner, middle, far)), colors, painting)
        # A split side: the half at the first corner is painted with the filament 1, the other half with 2.
        name = self.save("a.3mf", model('<object id="1">' + boxes((0, 0, 0), painted='paint_color="845"') + "</object>"), **PROJECT)
        self.assertEqual(self.front(name, (0.5, 0.9), (0.9, 0.5)), [RED, GREEN])
        plain = self.info(self.save("b.3mf", model('<object id="1">' + boxes((0, 0, 0), painted='paint_color="8"') + "</object>")))
        self.assertIn("names no colours for the filaments", plain["warnings"][0])

    def test_damaged_configurations(self):
        """A configuration that cannot be read costs a warning, not the model."""
        root = model(f'<object id="1">{boxes((0, 0, 0))}</object>')
        for part, text in (("model_settings", "<config><object id='1'>"), ("model_settings", "<!DOCTYPE a><config/>"), ("model_settings", b"\0" * 40_000_000),
                           ("model_settings", "<config>" + " " * 40_000_000), ("Slic3r_PE_model", "<config><object/></config>"), ("Slic3r_PE", b"\n" * 40_000_000),
                           ("Slic3r_PE_model", '<config><object id="1"><volume firstid="-1"/></object></config>'), ("project_settings", "{"), ("project_settings", ""),
                           ("project_settings", '{"filament_colour": ["#FF0000"'), ("project_settings", "[" * 100000), ("project_settings", b'"' + b"a" * 40_000_000)):
            name = self.save("a.3mf", root, **{f"Metadata__{part}_dot_config": text})
            row = self.info(name)
            self.assertEqual((len(row["warnings"]), row["counts"]["triangles"]), (1, 12), (part, text[:30], row["warnings"]))
            self.assertIn(f"Metadata/{part}.config", row["warnings"][0])
        for text, broken in (('{"filament_colour": 7}', 0), ('{"filament_colour": [7, null, "red", "#12", "", "#FF0000"]}', 4), ("[]", 0)):
            warnings = self.info(self.save("a.3mf", root, Metadata__project_settings_dot_config=text))["warnings"]
            self.assertEqual(len(warnings), broken, text)
            self.assertTrue(all("as the colour of filament %d, expected #RRGGBB" % (i + 1) in warning for i, warning in enumerate(warnings)), warnings)
        prusa = self.save("b.3mf", root, Metadata__Slic3r_PE_dot_config='; extruder_colour = "";blue\n; filament_colour = #FF0000;#123\n')
        self.assertEqual([w.split("found ")[1][:30] for w in self.info(prusa)["warnings"]],
                         ['"#123" as the colour of filame', '"blue" as the colour of filame'])

    def test_nothing_prints(self):
        """A sliced file, or one of modifiers alone: the sentence names the slicer."""
        made = '<metadata name="Application">BambuStudio-01.10</metadata><resources/>'
        empty = model("", "")
        sliced = {"Metadata__plate_1_dot_gcode": "G1", "Metadata__plate_1_dot_png": "x", "Metadata__plate_1_small_dot_png": "x"}
        says = ("is a sliced file", "G-code for a printer (Metadata/plate_1.gcode) and no model", "its picture is the part Metadata/plate_1.png")
        self.bad(3, "info", self.save("a.3mf", empty, **sliced), says=("Bambu Studio or OrcaSlicer", *says))
        self.bad(3, "info", self.save("b.3mf", empty.replace("<resources></resources>", made), **sliced), says=("written by BambuStudio-01.10", *says))
        only = self.save("c.3mf", model(f'<object id="1">{boxes((0, 0, 0))}</object>').replace("<resources>", made[:-12] + "<resources>"),
                         **prusa((0, 11, ("volume_type", "NegativeVolume"))))
        self.bad(2, "info", only, says=("contains nothing that prints, only negative volumes (1)", "written by BambuStudio-01.10"))


class Faults(ThreeMF):
    def test_faults(self):
        """The error message names the part, the line and the error."""
        good = f'<object id="1">{box()}</object>'
        for change, words in (
                (lambda m: m.replace('x="1"', 'x="one"', 1), 'found x="one", expected a number'),
                (lambda m: m.replace(' z="0"', "", 1), "the attribute z is missing"),
                (lambda m: m.replace('v1="0"', 'v1="8"', 1), 'found v1="8", expected a vertex below 8'),
                (lambda m: m.replace('v1="0"', 'v1="99999999999"', 1), 'found v1="99999999999", expected a whole number'),
                (lambda m: m.replace('v1="0"', 'v1="-1"', 1), 'found v1="-1"'),
                (lambda m: m.replace('objectid="1"', 'objectid="2"'), 'found objectid="2", expected the id of an object'),
                (lambda m: m.replace('objectid="1"', 'objectid="1" transform="1 2 3"'), 'found transform="1 2 3", expected 12 finite numbers'),
                (lambda m: m.replace("<model", '<model unit="parsec"'), 'found unit="parsec"'),
                (lambda m: m.replace("</resources>", good + "</resources>"), "the id 1 is used twice"),
                (lambda m: m.replace('<item objectid="1"/>', ""), "its build contains no items"),
                (lambda m: m.replace(box(), ""), "have no triangles"),
                (lambda m: m.replace("</build>", ""), "not well-formed XML: mismatched tag"),
                (lambda m: m.replace(CORE, ""), "found the element model, expected model of 3MF"),
                (lambda m: m.replace("<build>", "<build>\0"), "not well-formed XML"),
                (lambda m: "", "not well-formed XML: no element found")):
            done = self.bad(2, "info", self.save("bad.3mf", change(model(good))), says=words)
            self.assertRegex(done.stderr.decode(), r"^lambent: bad.3mf: [^\n]+\n$", words)
        # Triangles with a vertex that is not finite are left out.
        for number in ("nan", "-inf", "1e999"):
            name = self.save("bad.3mf", model(good).replace('x="1"', f'x="{number}"', 1))
            self.assertIn("1 vertices have coordinates that are not finite", self.good(name, "-s", 8, "-o", "bad.png").stderr.decode())
        # A cycle, and a transform without a volume.
        circle = '<object id="1"><components><component objectid="2"/></components></object><object id="2"><components><component objectid="1"/></components></object>'
        self.bad(2, "info", self.save("bad.3mf", model(circle)), says="found objectid=\"1\", an object that contains this one")
        flat = self.save("flat.3mf", model(good, '<item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 0 0 0 0"/>'))
        self.assertIn("whose transform has no volume or is above 1e30 (1)", " ".join(self.info(flat)["warnings"]))
        # A number that leaves the range of float would end in a file without coordinates.
        far = '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 1e39 0 0"/>'
        self.assertIn("is above 1e30 (1)", " ".join(self.info(self.save("far.3mf", model(good, '<item objectid="1"/>' + far)))["warnings"]))
        self.bad(2, "convert", self.save("far.3mf", model(good, far)), "far.obj", says="transforms of all objects have no volume or are above 1e30 (1)")

    def test_cut_files(self):
        """A truncated file, or a file with a wrong byte, is read or refused with an error message."""
        whole = package({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": model(f'<object id="1">{box()}</object>')})
        for size in range(0, len(whole), 97):
            done = self.run_program("info", self.save_bytes("cut.3mf", whole[:size]))
            self.assertEqual((done.returncode, done.stderr.count(b"\n")), (2, 1), (size, done.stderr))
        for at in range(0, len(whole), 61):
            data = bytearray(whole)
            data[at] ^= 0x55
            done = self.run_program("info", self.save_bytes("wrong.3mf", bytes(data)))
            self.assertIn(done.returncode, (0, 2, 3), (at, done.stderr))
            self.assertLessEqual(done.stderr.count(b"\n"), 1)


class Hostile(ThreeMF):
    """Small files that would expand enormously: less than 10 s of processor time and 1 GB, with an error message."""

    def refused(self, name, code, says, *words):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = self.bad(code, "info", name, *words, says=says)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 10, name)
        self.assertLess(after.ru_maxrss, 1_000_000, name)  # of the largest child so far
        self.assertEqual(done.stderr.count(b"\n"), 1)
        self.assertLess((self.folder / name).stat().st_size, 100_000)

    def test_entities(self):
        """Billion laughs, and any other document type."""
        entities = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10 if i else "ha"}">' for i in range(10))
        laughs = f'<!DOCTYPE model [{entities}]><model {CORE}><metadata name="Copyright">&l9;</metadata></model>'
        self.refused(self.save("a.3mf", laughs), 2, "document type")
        self.refused(self.save("b.3mf", f'<!DOCTYPE model SYSTEM "file:///etc/passwd"><model {CORE}/>'), 2, "document type")

    def test_doubling(self):
        """Forty components, each of which contains the previous one twice."""
        objects = f'<object id="1">{box()}</object>' + "".join(
            f'<object id="{i}"><components><component objectid="{i - 1}"/><component objectid="{i - 1}"/></components></object>' for i in range(2, 42))
        self.refused(self.save("a.3mf", model(objects, '<item objectid="41"/>')), 4, "--object-limit")
        empty = objects.replace(box(), "")
        self.refused(self.save("b.3mf", model(empty, '<item objectid="41"/>')), 4, "--object-limit")

    def test_paintings(self):
        """A digit of a painting becomes a triangle; a painted side cuts every triangle at it."""
        tree = "0"
        for _ in range(9):
            tree = 4 * tree + "3"
        triangle = '<triangle v1="0" v2="1" v3="2"%s/>'
        corners = '<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>'
        for painting, count, plain in ((tree, 1, 100000), (tree, 20, 0), ("3" * 1_000_000, 40, 0)):
            triangles = triangle % f' paint_color="{painting}"' * count + triangle % "" * plain
            root = model(f'<object id="1"><mesh>{corners}<triangles>{triangles}</triangles></mesh></object>')
            self.refused(self.save("a.3mf", root, **PROJECT), 4, "--expansion-limit")

    def test_deep(self):
        objects = f'<object id="1">{box()}</object>' + "".join(
            f'<object id="{i}"><components><component objectid="{i - 1}"/></components></object>' for i in range(2, 1000))
        self.refused(self.save("a.3mf", model(objects, '<item objectid="999"/>')), 2, "nested in more than 100 components")
        self.refused(self.save("b.3mf", f"<model {CORE}>" + "<a>" * 100000), 2, "more than 256 elements")

    def test_long_tokens(self):
        """An element, a comment and a text of many megabytes, which expat would scan again and again."""
        for i, text in enumerate(('<model a="' + "a" * 30_000_000, "<!--" + "a" * 30_000_000, "<a" + " " * 30_000_000)):
            self.refused(self.save(f"{i}.3mf", text), 2, "more than 1048576 bytes")

    def test_spaces(self):
        """A part that expands a thousandfold is read up to the limit."""
        spaces = model(f'<object id="1">{box()}</object>').encode() + b" " * 20_000_000
        self.good("info", self.save("large.3mf", spaces))

    @long
    def test_bomb(self):
        """Five hundred names for the same compressed bytes, all of which are read."""
        part = zlib.compressobj(9, zlib.DEFLATED, -15)
        text = f"<model {CORE}><resources><object id='1'/></resources>".encode() + b" \n" * 3_000_000 + b"<build/></model>"
        packed = part.compress(text) + part.flush()
        names = [b"p%d.model" % i for i in range(500)]
        components = "".join(f'<component objectid="1" p:path="/p{i}.model"/>' for i in range(500))
        root = model(f'<object id="1"><components>{components}</components></object>', spaces=f"{CORE} {PRODUCTION}")
        data = bytearray(package({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": root}))
        end = data.rindex(b"PK\5\6")
        start = struct.unpack_from("<I", data, end + 16)[0]
        rows = bytes(data[start:end])
        body = bytes(data[:start])
        shared = len(body)
        head = struct.pack("<HHHHHIIIHH", 20, 0, 8, 0, 0x21, zlib.crc32(text), len(packed), len(text), 0, 0)
        body += struct.pack("<I", 0x04034b50) + head[:-4] + struct.pack("<HH", len(names[0]), 0) + names[0] + packed
        for name in names:
            rows += struct.pack("<IH", 0x02014b50, 20) + head[:-4] + struct.pack("<HHHHHII", len(name), 0, 0, 0, 0, 0, shared) + name
        data = body + rows + struct.pack("<IHHHHIIH", 0x06054b50, 0, 0, 502, 502, len(rows), len(body), 0)
        self.refused(self.save_bytes("many.3mf", data), 4, "--expansion-limit")

    def test_mixed_layers(self):
        """Many groups that mix the same large texture with a colour."""
        corner = '<m:tex2coord u="0" v="0"/>'
        groups = (f'<basematerials id="1"><base name="a" displaycolor="#ff0000"/></basematerials><m:texture2d id="2" path="/t.png" contenttype="image/png"/>'
                  f'<m:texture2dgroup id="3" texid="2">{corner}</m:texture2dgroup>')
        groups += "".join(f'<m:multiproperties id="{i}" pids="1 3"><m:multi pindices="0 0"/></m:multiproperties>' for i in range(10, 300))
        picture = write_png(1000, 1000, bytes([0, 0, 255, 128]) * 1_000_000)
        root = model(f'{groups}<object id="4">{box()}</object>', '<item objectid="4"/>', spaces=f"{CORE} {MATERIALS}")
        self.refused(self.save("a.3mf", root, **{"t_dot_png": picture}), 4, "--expansion-limit")

    def test_claims(self):
        """Wrong numbers of entries and wrong sizes in the archive."""
        good = package({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": model(f'<object id="1">{box()}</object>')})
        end = good.rindex(b"PK\5\6")
        for offset, form, value in ((8, "<HH", (65535, 65535)), (12, "<I", (0xfffffff0,)), (16, "<I", (0xfffffff0,))):
            data = bytearray(good)
            struct.pack_into(form, data, end + offset, *value)
            self.refused(self.save_bytes("a.3mf", bytes(data)), 2, "a.3mf: ")
        large = struct.pack("<IQHHIIQQQQ", 0x06064b50, 44, 45, 45, 0, 0, 1 << 40, 1 << 40, 1 << 46, 0)
        data = good[:end] + large + struct.pack("<IIQI", 0x07064b50, 0, end, 1) + good[end:]
        self.refused(self.save_bytes("b.3mf", data), 2, "its list of entries")

    def test_limits(self):
        name = self.save("a.3mf", model(f'<object id="1">{box()}</object>', '<item objectid="1"/>' * 5))
        self.bad(4, "info", name, "--triangle-limit", "11", says="12 triangles, expected at most 11")
        self.bad(4, "info", name, "--object-limit", "4", says="5 objects, expected at most 4")
        self.bad(4, "info", name, "--file-limit", "100", says="--file-limit")
        self.bad(4, "info", name, "--memory-limit", "100k", says="--memory-limit")

    def test_many(self):
        """The time for 8,000 ids, references and colours does not grow with their square."""
        colors = "".join(f'<m:color color="#{i:06x}"/>' for i in range(8000))
        objects = "".join(f'<object id="{i}"><components><component objectid="1"/></components></object>' for i in range(3, 8000))
        # in rows, because thousands of boxes at one position take seconds to draw
        items = "".join(f'<item objectid="{i}" transform="1 0 0 0 1 0 0 0 1 {20 * (i % 90)} {20 * (i // 90)} 0"/>' for i in range(3, 8000))
        name = self.save("a.3mf", model(f'<m:colorgroup id="2">{colors}</m:colorgroup><object id="1" pid="2" pindex="9">{box()}</object>{objects}', items,
                                        spaces=f"{CORE} {MATERIALS}"))
        before = os.times()
        self.assertEqual(self.info(name)["counts"]["objects"], 7997)
        self.assertLess(os.times().children_user - before.children_user, 2)


@unittest.skipUnless(os.environ.get("LAMBENT_3MF"), "LAMBENT_3MF names no folder of samples")
class Samples(ThreeMF):
    """The consortium's samples: each is drawn, or refused with an error message."""

    def test_samples(self):
        drawn = 0
        for path in sorted(pathlib.Path(os.environ["LAMBENT_3MF"]).rglob("*.3mf")):
            done = self.run_program(path, "-q", "-s", 64, "-o", "-")
            self.assertIn(done.returncode, (0, 2, 3), path)
            self.assertEqual(done.stderr.count(b"\n"), done.returncode != 0, (path, done.stderr))
            drawn += done.returncode == 0
        self.assertGreater(drawn, 0)
