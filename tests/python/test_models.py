"""Scenes, meshes from arrays and from other packages' objects, materials, lights, and generated attributes."""
import copy
import functools
import json
import multiprocessing
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock
import zipfile

import numpy as np

import lambent
from lambent import _options
from lambent._core import every, text_of
from lambent._fields import Field
from lambent._native import lib

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def thing(**members):
    return types.SimpleNamespace(**members)


def hash_of(scene, camera):
    return scene.render(48, camera=camera).hash


class Meshes(unittest.TestCase):
    def file(self):
        """The cube as an OBJ file, read by the program's reader."""
        text = "".join("v %g %g %g\n" % tuple(corner) for corner in CORNERS) + "".join("f %d %d %d\n" % tuple(face + 1) for face in TRIANGLES)
        return lambent.render(text.encode(), 64, name="cube.obj").hash

    def test_objects_of_other_packages(self):
        cell = thing(type="triangle", data=TRIANGLES)
        for model in ((CORNERS, TRIANGLES), (CORNERS.tolist(), QUADS.tolist()), lambent.Mesh(CORNERS, QUADS), CORNERS[TRIANGLES], thing(vertices=CORNERS, faces=TRIANGLES),
                      thing(vertices=CORNERS, triangles=TRIANGLES), thing(points=CORNERS, cells=[cell]), lambent.Scene().add((CORNERS, QUADS))):
            with self.subTest(model=type(model)):
                expected = lambent.render(lambent.Mesh(CORNERS[TRIANGLES].reshape(-1, 3), np.arange(36).reshape(-1, 3)), 64).hash \
                    if isinstance(model, np.ndarray) else self.file()
                self.assertEqual(lambent.render(model, 64).hash, expected)

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("python3-meshio is not installed")
        self.assertEqual(lambent.render(meshio.Mesh(CORNERS, [("triangle", TRIANGLES), ("vertex", [[0]])]), 64).hash, self.file())

    def test_scene_like_trimesh(self):
        graph = {"a": (np.eye(4), "cube"), "b": (np.diag([1, 1, 1, 1]) + np.array([[0, 0, 0, 2]] + [[0] * 4] * 3), "cube")}
        model = thing(geometry={"cube": thing(vertices=CORNERS, faces=TRIANGLES)},
                      graph=type("Graph", (dict,), {"nodes_geometry": ["a", "b"]})(graph))
        self.assertEqual(lambent.load(model).bounds, ((0, 0, 0), (3, 1, 1)))

    def test_colors(self):
        red = np.tile([255, 0, 0, 255], (8, 1)).astype(np.uint8)
        by_vertex = lambent.render(thing(vertices=CORNERS, faces=TRIANGLES, visual=thing(kind="vertex", vertex_colors=red)), 64)
        by_face = lambent.render(thing(vertices=CORNERS, faces=TRIANGLES, visual=thing(kind="face", face_colors=red[:1].repeat(12, 0))), 64)
        by_quad = lambent.render(lambent.Mesh(CORNERS, QUADS, colors=red[:6, :3]), 64)
        self.assertEqual(by_vertex.hash, by_face.hash)
        self.assertEqual(by_quad.hash, by_face.hash)
        middle = by_vertex[32, 32].astype(int)
        self.assertGreater(middle[0], middle[1] + 50)

    def test_texture(self):
        pixels = np.zeros((16, 16, 3), np.uint8)
        pixels[:8] = 255, 0, 0  # the upper half: t above 0.5
        square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        material = thing(image=pixels)
        picture = lambent.render(thing(vertices=square, faces=[[0, 1, 2], [0, 2, 3]], visual=thing(kind="texture", uv=np.array(square)[:, :2], material=material)), 64, view="front")
        redness = picture[..., 0].astype(int) - picture[..., 1]
        self.assertGreater(redness[16, 32], 100)
        self.assertEqual(redness[48, 32], 0)

    def test_lines_and_points(self):
        for model, count in (((CORNERS, [[0, 1], [2, 3]]), lib.lam_scene_line_count), (CORNERS, lib.lam_scene_point_count)):
            scene = lambent.Scene().add(model)
            self.assertEqual(count(scene._handle), 8 if model is CORNERS else 2)
            self.assertGreater(scene.render(64)[..., 3].max(), 0)

    def test_far_from_zero(self):
        self.assertEqual(lambent.render((CORNERS + 1e7, TRIANGLES), 64, camera=lambent.Camera(eye=(1e7 + 4, 1e7 + 3, 1e7 + 5))).hash,
                         lambent.render((CORNERS, TRIANGLES), 64, camera=lambent.Camera(eye=(4, 3, 5))).hash)

    def test_wireframe_leaves_out_inner_edges(self):
        polygons, triangles = (lambent.render((CORNERS, faces), 64, wireframe=True, surfaces=False)[..., 3].sum() for faces in (QUADS, TRIANGLES))
        self.assertLess(polygons, triangles)


class Scenes(unittest.TestCase):
    def test_build(self):
        scene = lambent.Scene().add("cube", "ruby", name="a").add("sphere", transform=[[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        self.assertEqual((round(scene.bounds[1][0], 6), len(scene.materials)), (4, 1))
        before = scene.render(64)
        scene.set_material("shininess=5", 0)
        self.assertEqual(scene.materials[0].shininess, 5)
        self.assertNotEqual(scene.render(64).hash, before.hash)
        scene.lights = [lambent.Light("point", position=(3, 3, 3)), "ambient:color=0.2"]
        self.assertEqual([light.type for light in scene.lights], ["point", "ambient"])
        lights = scene.lights
        lights[0].diffuse = "orange"
        self.assertRaises(lambent.BadValue, setattr, lights[0], "range", -1)
        scene.lights = lights
        self.assertAlmostEqual(scene.lights[0].diffuse[1], 0.376, 3)
        scene.up, scene.ambient = "z", 0.5
        scene.set_environment("sky", 90)
        self.assertEqual((scene.up, scene.ambient), ("z", (0.5, 0.5, 0.5)))
        self.assertRaises(lambent.BadValue, scene.set_material, "ruby", 7)

    def test_copies_outlive_their_scene(self):
        material, light = lambent.load("examples/models/spot.glb").materials[0], lambent.load("examples/shadows.json").lights[0]
        scene = lambent.Scene().add("cube", material)
        scene.lights = [light]
        self.assertEqual(scene.materials[0].name, material.name)
        self.assertEqual(scene.lights[0].type, light.type)
        scene.render(32)

    def test_pickles_and_copies(self):
        """Cameras, lights, materials and scenes go through pickle and copy, and a pool of processes draws with them."""
        checks = np.indices((8, 8)).sum(0)[..., None] % 2 * np.full(3, 255, np.uint8)
        textured = lambent.Material("physical=yes,metallic=0", roughness=0.25)
        textured.set_map("diffuse", checks.astype(np.uint8))
        square = lambent.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]], texcoords=[[0, 0], [1, 0], [1, 1], [0, 1]], material=textured)
        file = lambent.load("examples/models/spot.glb", crease_angle=30)
        file.rotate("y", 30)
        file.set_material("roughness=0.9")
        built = lambent.Scene().add("teapot", "jade", name="pot").add(square, transform=np.diag([2, 2, 2, 1.0]))
        built.lights = [lambent.Light("point", position=(2, 3, 4), name="lamp"), "hemisphere:sky=0.3,ground=0.1"]
        built.up, built.ambient = "z", 0.1
        built.hide("pot")
        data = lambent.load(pathlib.Path("tests/models/cube.obj").read_bytes(), name="a.obj")
        found = built.render(48)
        cameras = [lambent.Camera(eye=(3, 2, 5), fovy=40), lambent.Camera(K=[[90, 0, 24], [0, 90, 24], [0, 0, 1]], pose=np.linalg.inv(np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 4], [0, 0, 0, 1]]))),
                   found.camera]
        for again in (lambda item: pickle.loads(pickle.dumps(item)), copy.copy, copy.deepcopy):
            for scene in (file, built, data, again(file)):
                self.assertEqual(again(scene).render(48).hash, scene.render(48).hash)
            for camera in cameras:
                self.assertEqual(file.render(48, camera=again(camera)).hash, file.render(48, camera=camera).hash)
                self.assertEqual(repr(again(camera)), repr(camera))
            for light in [*built.lights, lambent.Light("spot:position=2r/3r/1r,cutoff=20", color="orange")]:
                other = again(light)
                self.assertEqual(repr(other), repr(light))
                setattr(other, "sky" if light.type == "hemisphere" else "diffuse", "red")
                self.assertNotEqual(repr(other), repr(light))
            other = again(textured)
            other.roughness = 0.5
            self.assertEqual((textured.roughness, other.roughness), (0.25, 0.5))
            self.assertEqual(lambent.Scene().add(square, again(textured)).render(32).hash, lambent.Scene().add(square).render(32).hash)
        square.vertices[:] = 0  # a scene does not change with the arrays that it was made from
        self.assertEqual(pickle.loads(pickle.dumps(built)).render(48).hash, found.hash)
        with self.assertRaises(lambent.Unsupported):
            pickle.dumps(file.materials[0])
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            pictures = pool.map(functools.partial(hash_of, file), cameras)
        self.assertEqual(pictures, [hash_of(file, camera) for camera in cameras])

    def test_objects_and_picking(self):
        scene = lambent.load("examples/models/parts.obj")
        self.assertRegex(repr(scene), r"^Scene\(\d objects, 48 triangles, 'parts.obj'\)$")
        scene.only("knob")  # each part is an object now
        scene = pickle.loads(pickle.dumps(scene))
        by_name = {item.name: item for item in scene.objects}
        self.assertEqual(len(by_name), 4)
        self.assertEqual([name for name, item in by_name.items() if not item.hidden], ["knob"])
        for item in by_name.values():
            item.hidden = False
        lid = by_name["knob"]
        corners = lid.vertices[lid.faces].reshape(-1, 3)
        self.assertEqual(lid.faces.shape, (12, 3))
        before, size = scene.bounds, corners.max(0) - corners.min(0)
        place = np.eye(4)
        place[0, 3] = 10 * np.max(size)
        lid.transform = place
        self.assertEqual(lid.transform.tolist(), place.tolist())
        self.assertAlmostEqual(scene.bounds[1][0], corners[:, 0].max() + place[0, 3], 4)
        picked = scene.pick(32, 32, 64, camera=lambent.Camera(eye=tuple(corners.mean(0) + place[:3, 3] + [0, 0, 50 * np.max(size)]),
                                                             target=tuple(corners.mean(0) + place[:3, 3]), fovy=2))
        self.assertEqual(picked.object.name, "knob")
        self.assertAlmostEqual(picked.position[2], corners[:, 2].max(), 3)
        self.assertIn("'knob'", repr(picked))
        self.assertIsNone(scene.pick(0, 0, 64))
        lid.name = "cover"
        scene.objects[1].material = None
        by_name["knob"].remove()
        self.assertEqual(len(scene.objects), 3)
        self.assertEqual(scene.bounds[0][1:], before[0][1:])
        with self.assertRaisesRegex(lambent.BadValue, "read scene.objects again"):
            lid.hidden = True
        for key, value, words in (("transform", [[1]], "1x1, expected 4x4"), ("material", 99, "found 99"), ("name", 7, "expected a string")):
            with self.assertRaisesRegex(lambent.BadValue, words):
                setattr(scene.objects[0], key, value)
        self.assertRaises(lambent.BadValue, scene.pick, 64, 0, 64)

    def test_errors_have_pythons_words(self):
        for keyword, value, words in (("memory_limit", 200000, "memory limit"), ("threads", -4, "threads is -4"), ("crease_angle", 500, "^crease_angle: found 500"),
                                      ("azimuth", "x", "expected a number"), ("memory_limit", -5, "^memory_limit: found -5")):
            with self.assertRaisesRegex(lambent.Error, words) as caught:
                lambent.render("examples/models/spot.obj", 64, **{keyword: value})
            self.assertNotRegex(str(caught.exception), r"_bytes|_rad|lam_|cpu:")

    def test_page(self):
        scene = lambent.load("tests/models/cube.obj")
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "lambent.html")
            page.write_text("<html><body>page</body></html>")
            with unittest.mock.patch.dict("os.environ", {"LAMBENT_PAGE": str(page)}):
                text = scene.page()
                self.assertIn("<iframe", scene._repr_html_())
            self.assertIn('data-path="/cube.obj"', text)
            self.assertIn('data-path="/cube.mtl"', text)
            self.assertIn('id="inside-words">["/cube.obj"]', text)
        self.assertIn("<img src", lambent.Scene().add("cube")._repr_html_())


class Tables(unittest.TestCase):
    def test_every_field_is_an_attribute(self):
        for cls, table in ((lambent.Material, lib.lam_material_field), (lambent.Light, lib.lam_light_field)):
            for row in every(table):
                field = getattr(cls, text_of(row.key))
                self.assertIsInstance(field, Field)
                self.assertIn(text_of(row.summary), field.__doc__)
        self.assertIn("0 to 180; degrees; default 45; spot", lambent.Light.cutoff.__doc__)

    def test_every_setting_is_a_keyword(self):
        for row in every(lib.lam_draw_setting):
            self.assertIn(text_of(row.key), _options.KEYWORDS)
            self.assertIn(text_of(row.summary), lambent.render.__doc__)

    def test_values(self):
        material = lambent.Material("gold,opacity=0.5", reflectivity=0.25)
        self.assertEqual((material.opacity, material.reflectivity), (0.5, (0.25, 0.25, 0.25)))
        material.metallic = 1
        self.assertTrue(material.physical)
        material.fibre, material.diffuse = True, "#f80"
        self.assertEqual((material.fibre, material.diffuse[2:]), (True, (0.0, 1.0)))
        light = lambent.Light("directional", direction=(0, -1, 0), radius=0.27, shadows=False)
        self.assertEqual((light.radius, light.shadows), (0.27, False))
        self.assertEqual(repr(lambent.Camera(eye=(1, 2, 3), ortho=2)).count("ortho=2.0"), 1)
        self.assertEqual(repr(light).split(",")[0], "Light('directional'")


class Package(unittest.TestCase):
    def test_stubs(self):
        folder = pathlib.Path(lambent.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        stub = (folder / "__init__.pyi").read_text()
        compile(stub, "__init__.pyi", "exec")
        for name in lambent.__all__:
            self.assertRegex(stub, r"(?m)^(class|def) %s\b" % name)
        sample = ("import lambent\npicture = lambent.render('x.stl', 512, shadows=True, ground='checker')\nhash: str = picture.hash\n"
                  "light = lambent.Light('spot', cutoff=20)\nlight.cutoff = 'wide'  # wrong\nlambent.render('x.stl', shadowy=True)  # wrong\n"
                  "scene = lambent.Scene().add('cube', lambent.Material(diffuse='#f80'))\nlambent.render('x', ground='grass')  # wrong\n")
        with tempfile.TemporaryDirectory() as where:
            pathlib.Path(where, "sample.py").write_text(sample)
            try:
                done = subprocess.run(["mypy", "--no-incremental", "sample.py"], cwd=where, stdout=subprocess.PIPE, text=True)
            except FileNotFoundError:
                self.skipTest("mypy is not installed")
        lines = [int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error:" in line]
        self.assertEqual(lines, [number for number, line in enumerate(sample.splitlines(), 1) if "wrong" in line], done.stdout)

    def test_wheel_holds_its_libraries(self):
        names = zipfile.ZipFile(os.environ["LAMBENT_WHEEL"]).namelist()
        self.assertRegex(os.environ["LAMBENT_WHEEL"], r"lambent-[0-9.]+-cp311-abi3-manylinux_2_\d+_\w+\.whl$")
        for part in ("lambent/_native.abi3.so", "lambent/libs/libspng.so.0", "lambent/libs/libspng0.copyright", "lambent/LICENSE", "lambent/py.typed"):
            self.assertIn(part, names)
        self.assertEqual(lambent.render("tests/fuzz/corpus/gltf/draco.gltf", 16).shape, (16, 16, 4))
        files = [str(path) for path in pathlib.Path(lambent.__file__).parent.rglob("*.so*")]
        symbols = subprocess.check_output(["objdump", "-T", *files], text=True)
        self.assertEqual(max(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", symbols)), int(re.search(r"manylinux_2_(\d+)", os.environ["LAMBENT_WHEEL"])[1]))
        text = subprocess.check_output(["ldd", str(pathlib.Path(lambent.__file__).parent / "_native.abi3.so")], text=True)
        self.assertNotIn("liblambent", text)
        self.assertIn("lambent/libs/libspng.so.0", text)

    def test_notebook(self):
        cells = [cell for cell in json.loads(pathlib.Path("examples/notebook.ipynb").read_text())["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 4)
        code = "".join("".join(cell["source"]) + "\n" for cell in cells)
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-c", code], cwd="examples", env={**os.environ, "TMPDIR": folder}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
