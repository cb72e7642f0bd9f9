"""The pictures of the package equal the program's pictures: the same bytes, and the same hash as in its journal."""
import base64
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import lambent

CASES = [
    ("teapot", {}, []),
    ("tests/models/cube.obj", {}, []),
    ("tests/models/cube.stl", {"up": "y", "wireframe": True}, ["--up", "y", "--wireframe"]),
    ("tests/models/cube.ply", {"edges": "all", "hidden_lines": "dash"}, ["--edges", "all", "--hidden-lines", "dash"]),
    ("examples/models/spot.glb", {"azimuth": 150}, ["--azimuth", "150"]),
    ("tests/models/scene.json", {}, []),
    ("examples/shadows.json", {}, []),
    ("torus", {"shadows": True, "ground": "checker"}, ["--shadows", "--ground", "checker"]),
    ("torus", {"material": "ruby", "background": "#dfe6ee", "view": "iso"}, ["--material", "ruby", "--background", "#dfe6ee", "--view", "iso"]),
    ("torus", {"light": ["point:position=-2r/3r/2r"], "ambient": 0.1}, ["--light", "point:position=-2r/3r/2r", "--ambient", "0.1"]),
    ("torus", {"light": lambent.Light("spot", position=(2, 3, 1), cutoff=30, color="orange")}, ["--light", "spot:position=2/3/1,cutoff=30,color=orange"]),
    ("torus", {"reflection": "kajiya-kay", "rig": "headlight"}, ["--reflection", "kajiya-kay", "--rig", "headlight"]),
    ("examples/models/spot.glb", {"reflection": "phong"}, ["--reflection", "phong"]),
    ("examples/models/spot.glb", {"environment": "sky", "environment_rotation": 40, "tone": "aces", "exposure": -1},
     ["--environment", "sky", "--environment-rotation", "40", "--tone", "aces", "--exposure", "-1"]),
    ("torus", {"section": ["x=0", "z=60%,color=orange"]}, ["--section", "x=0", "--section", "z=60%,color=orange"]),
    ("torus", {"rotate": "x:30", "color": "#ff8800", "dimensions": True}, ["--rotate", "x:30", "--color", "#ff8800", "--dimensions"]),
    ("torus", {"rotate": ["x:30", "y:-20"], "section": "x=0"}, ["--rotate", "x:30", "--rotate", "y:-20", "--section", "x=0"]),
    ("examples/models/parts.obj", {"only": ["ring", "body"]}, ["--only", "ring", "--only", "body"]),
    ("examples/models/parts.obj", {"hide": "ring", "grid": True, "axes": True, "scale_bar": True}, ["--hide", "ring", "--grid", "--axes", "--scale-bar"]),
    ("teapot", {"show": "n.l"}, ["--show", "n.l"]),
    ("teapot", {"camera": lambent.Camera(eye=(2, 1, 4), fovy=40), "exposure": "auto"}, ["--camera", "eye=2/1/4,fovy=40", "--exposure", "auto"]),
    ("teapot", {"stage": "vertex", "color_mode": "raw", "samples": 1, "background": "#456", "material": "#fa0", "ambient": "#111"},
     ["--stage", "vertex", "--color-mode", "raw", "--samples", "1", "-b", "#456", "--material", "#fa0", "--ambient", "#111"]),
    ("examples/shadows.json", {"rig": "none", "ambient": 0.5}, ["--rig", "none", "--ambient", "0.5"]),
    ("examples/shadows.json", {"rig": "default"}, ["--rig", "default"]),
    ("examples/shadows.json", {"rig": "headlight"}, ["--rig", "headlight"]),
    ("teapot", {"orthographic": True, "zoom": 2}, ["--projection", "orthographic", "--zoom", "2"]),
]


class SameAsTheProgram(unittest.TestCase):
    def test_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, (model, keywords, words) in enumerate(CASES):
                with self.subTest(model=model, words=words):
                    path = "%s/%d.png" % (folder, number)
                    subprocess.run([os.environ["LAMBENT"], model, *words, "-s", "128x96", "-o", path, "-q"], check=True)
                    self.assertEqual(lambent.render(model, (128, 96), **keywords).png(), pathlib.Path(path).read_bytes())

    def test_turntable(self):
        """The frames and the file of a turntable are the program's."""
        with tempfile.TemporaryDirectory() as folder:
            for model, words, keywords in (("teapot", [], {}), ("examples/models/spot.glb", ["--view", "front"], {"view": "front"}),
                                           ("tests/models/cube.stl", ["--light", "point:position=1r/2r/2r"], {"light": "point:position=1r/2r/2r"})):
                subprocess.run([os.environ["LAMBENT"], model, *words, "--turntable", "5", "-s", "64", "-o", folder + "/t.gif", "-q"], check=True)
                frames = lambent.turntable(model, 5, 64, **keywords)
                frames.save(folder + "/p.gif")
                self.assertEqual(pathlib.Path(folder, "p.gif").read_bytes(), pathlib.Path(folder, "t.gif").read_bytes(), model)
        self.assertRaisesRegex(lambent.BadValue, "whole number from 2", lambent.turntable, "teapot", 0)
        self.assertRaisesRegex(lambent.BadValue, "ends in .gif", frames.save, "t.jpg")
        self.assertRaisesRegex(lambent.BadValue, "no picture", lambent.Frames().save, "t.gif")

    def test_diff(self):
        a, b = lambent.render("teapot", 64), lambent.render("teapot", 64, color="red")
        self.assertEqual(a.diff(a)["maximum"], 0)
        self.assertGreater(a.diff(b)["mean"], 0)
        self.assertRaises(lambent.BadValue, a.diff, lambent.render("teapot", 32))

    def test_scene_changes(self):
        """Scene.hide, only, rotate and save."""
        parts = lambent.load("examples/models/parts.obj")
        self.assertRaisesRegex(lambent.BadValue, "found 'lid', expected the name of an object, a part or a material: body, foot", parts.hide, "lid")
        whole = parts.bounds
        self.assertLess(parts.only("body").bounds[1][1], whole[1][1])
        with tempfile.TemporaryDirectory() as folder:
            scene = lambent.Scene().add("sphere").rotate("x", 90)
            self.assertEqual(scene.save(folder + "/a.glb"), ())
            self.assertEqual(lambent.load(folder + "/a.glb").triangles, scene.triangles)
            self.assertRaises(lambent.Unsupported, scene.save, folder + "/a.fbx")
            subprocess.run([os.environ["LAMBENT"], "convert", "examples/models/spot.glb", folder + "/c.obj", "-q"], check=True)
            lambent.load("examples/models/spot.glb").save(folder + "/d.obj")
            self.assertEqual(len(os.listdir(folder)), 7, os.listdir(folder))

    def test_default_size(self):
        with tempfile.TemporaryDirectory() as folder:
            for model in ("tests/models/cube.stl", "tests/models/scene.json"):
                subprocess.run([os.environ["LAMBENT"], model, "-o", folder + "/a.png", "-q"], check=True)
                lambent.render(model).save(folder + "/b.png")
                self.assertEqual(pathlib.Path(folder, "a.png").read_bytes(), pathlib.Path(folder, "b.png").read_bytes())

    def test_dark_file(self):
        """A glTF file whose own lights leave most of the model black gets a dim studio, and the Scene does not change."""
        corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0], [1, 1, 0]], np.float32).tobytes()
        light = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30}]}}
        gltf = {"asset": {"version": "2.0"}, "extensionsUsed": list(light), "extensions": light, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                "nodes": [{"mesh": 0}, {"translation": [0, 0, -30], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
                "bufferViews": [{"buffer": 0, "byteLength": 72}],
                "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64," + base64.b64encode(corners).decode()}]}
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "lit.gltf").write_text(json.dumps(gltf))
            subprocess.run([os.environ["LAMBENT"], folder + "/lit.gltf", "-s", "96", "-o", folder + "/a.png", "-q"], check=True)
            scene = lambent.load(folder + "/lit.gltf")
            before = repr(scene.lights)
            pictures = [lambent.render(folder + "/lit.gltf", 96), scene.render(96), scene.render(96)]
            self.assertEqual({picture.png() for picture in pictures}, {pathlib.Path(folder, "a.png").read_bytes()})
            self.assertIn("studio", pictures[0].warnings[-1])
            self.assertEqual(repr(scene.lights), before)

    def test_hash_of_the_journal(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["LAMBENT"], "batch", "tests/models/cube.obj", "-s", "512", "-o", folder + "/{stem}.png", "--journal", folder + "/journal", "-q"], check=True)
            lines = [json.loads(line) for line in pathlib.Path(folder, "journal").read_text().splitlines()]
            self.assertEqual([line["hash"] for line in lines if "hash" in line], [lambent.render("tests/models/cube.obj", 512).hash])

    def test_bytes_of_a_model(self):
        data = pathlib.Path("tests/models/cube.stl").read_bytes()
        for kind in (bytes, bytearray, memoryview):
            self.assertEqual(lambent.render(kind(data), 64, name="cube.stl").png(), lambent.render("tests/models/cube.stl", 64).png())
        self.assertEqual(lambent.render(pathlib.Path("tests/models/cube.stl"), 64).png(), lambent.render("tests/models/cube.stl", 64).png())


class Scenes(unittest.TestCase):
    def test_sections_and_files(self):
        scene = lambent.Scene().add("sphere")
        self.assertAlmostEqual(scene.set_sections("z=0.1", "x")[0], np.pi * 0.99, 2)
        cut = scene.triangles
        self.assertEqual(scene.set_sections(), [])
        self.assertNotEqual(scene.triangles, cut)
        with self.assertRaises(lambent.BadValue):
            scene.set_sections("q=1")
        scene = lambent.Scene().add("examples/models/spot.glb").add("tests/models/cube.obj", transform=[[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        self.assertEqual(scene.triangles, lambent.load("examples/models/spot.glb").triangles + lambent.load("tests/models/cube.obj").triangles)
        self.assertGreater(scene.bounds[1][0], 3)
        self.assertEqual(lambent.Scene().add("tests/models/cube.stl").up, "z")
        self.assertGreater(scene.render(64, background="white")[..., 0].std(), 10)
        with self.assertRaises(lambent.BadValue):
            lambent.Scene().add("examples/models/spot.glb", material="gold")


class Arrays(unittest.TestCase):
    def test_read_only_and_without_a_copy(self):
        picture = lambent.render("cube", (60, 40))
        self.assertEqual((picture.shape, picture.dtype, picture.flags.writeable), ((40, 60, 4), np.uint8, False))
        with self.assertRaises(ValueError):
            picture[0, 0] = 0
        self.assertTrue(np.shares_memory(picture, np.asarray(picture)))
        self.assertIs(type(picture.mean()), np.float64)
        self.assertIs(type(picture / 255), np.ndarray)

    def test_part_and_others(self):
        picture = lambent.render("cube", 64)
        part = picture[10:30, 5:50]
        with tempfile.TemporaryDirectory() as folder:
            part.save(folder + "/part.png")
            picture.save(pathlib.Path(folder, "a.jpg"), quality=80)
            self.assertEqual(pathlib.Path(folder, "part.png").read_bytes(), np.ascontiguousarray(part).view(lambent.Picture).png())
            self.assertEqual(pathlib.Path(folder, "a.jpg").read_bytes()[:2], b"\xff\xd8")
        self.assertEqual(part.camera.eye, picture.camera.eye)
        self.assertIsNone(picture[..., 0]._repr_png_())
        self.assertEqual(picture._repr_png_()[:4], b"\x89PNG")
        with self.assertRaisesRegex(lambent.BadValue, "found an array of 64x64 numbers"):
            picture[..., 0].png()

    def test_floats(self):
        picture = lambent.render("cube", 32, floats=True, show="depth")
        self.assertEqual(picture.dtype, np.float32)
        self.assertGreater(picture[16, 16, 0], 1)
        self.assertEqual(picture.encode("pfm")[:2], b"PF")

    def test_calibrated_cameras(self):
        """K and pose give the program's picture; a camera in another convention, and the matrices of a picture's camera, give the same picture."""
        K, pose = [[90, 0, 40.5], [0, 80, 31], [0, 0, 1]], [[1, 0, 0, 0.2], [0, -1, 0, 0.1], [0, 0, -1, 4], [0, 0, 0, 1]]
        picture = lambent.render("teapot", (96, 64), camera=lambent.Camera(K=K, pose=np.array(pose, np.float32)))
        words = "K=90/0/40.5/0/80/31/0/0/1,pose=" + "/".join(str(n) for row in pose for n in row)
        self.assertEqual(picture.hash, lambent.render("teapot", (96, 64), camera=words).hash)
        same = lambent.Camera(fx=90, fy=80, cx=41, cy=31.5, pose=np.array(pose) * [[1, -1, -1, 1]], convention="opengl")
        self.assertEqual(picture.hash, lambent.render("teapot", (96, 64), camera=same).hash)
        np.testing.assert_allclose(picture.camera.K, K)
        np.testing.assert_allclose(picture.camera.pose, pose, atol=1e-12)
        fitted = lambent.render("teapot", (96, 64)).camera
        self.assertAlmostEqual(fitted.K[1, 1], 32 / np.tan(np.radians(15)))
        again = lambent.render("teapot", (96, 64), camera=lambent.Camera(K=fitted.K, pose=fitted.pose))
        self.assertLess(np.abs(again.astype(int) - lambent.render("teapot", (96, 64))).max(), 2)
        self.assertIsNone(lambent.Camera(fovy=40).K)
        self.assertEqual(lambent.Camera(fx=90, fy=80, cx=7, cy=8, eye=(0, 0, 4)).cx, 7)
        for wrong in ({"K": np.eye(4)}, {"K": K, "pose": -np.eye(4)}, {"K": [[90, 1, 2], [0, 80, 3], [0, 0, 1]]}, {"K": K, "fovy": 3}):
            self.assertRaises(lambent.BadValue, lambent.Camera, **wrong)

    def test_views(self):
        """The directions of a number are those of --view; depth is an array of distances."""
        ways = lambent.views("ring:4@30")
        np.testing.assert_allclose([ways[1]["azimuth"], ways[1]["elevation"]], [90, 30])
        self.assertEqual(len(lambent.views(24)), 24)
        self.assertRaises(lambent.BadValue, lambent.views, "ring:0")
        scene = lambent.Scene().add("cube")
        depths = [scene.render(33, show="depth", floats=True, **way)[..., 0] for way in ways]
        self.assertEqual(depths[0].shape, (33, 33))
        np.testing.assert_allclose(depths[0], depths[2], rtol=1e-5)

    def test_camera_of_a_picture(self):
        first = lambent.render("teapot", 64, azimuth=70)
        self.assertEqual(first.hash, lambent.render("teapot", 64, camera=first.camera).hash)
        self.assertNotEqual(first.hash, lambent.render("teapot", 64).hash)
