"""Errors, threads, progress, Ctrl-C and limits."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import lambent
import numpy as np
from lambent import _options
from lambent._core import CLASSES
from lambent._native import ffi, lib

SLOW = {"ao": "rays", "ao_samples": 1024}  # seconds for a picture of 1024 pixels


# Imports the package with docstrings as Python 3.13 stores them: without their indentation.
STRIPPED = """
import ast, importlib.machinery, inspect, sys
class Loader(importlib.machinery.SourceFileLoader):
    def path_stats(self, path): # no compiled file is read
        raise OSError
    def source_to_code(self, data, path):
        tree = ast.parse(data)
        for node in ast.walk(tree):
            if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node) is not None:
                node.body[0].value.value = inspect.cleandoc(node.body[0].value.value)
        return compile(tree, path, "exec")
native = (importlib.machinery.ExtensionFileLoader, importlib.machinery.EXTENSION_SUFFIXES)
sys.path_hooks.insert(0, importlib.machinery.FileFinder.path_hook(native, (Loader, [".py"])))
sys.path_importer_cache.clear()
import lambent
assert "\\n    model " not in lambent.render.__doc__, "the docstring is indented"
print(lambent.turntable.__doc__.count("Raises Error"))
"""


class Errors(unittest.TestCase):
    def test_docstrings_without_indentation(self):
        done = subprocess.run([sys.executable, "-B", "-c", STRIPPED], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.stdout, "1\n")

    def test_every_kind_has_a_class(self):
        self.assertEqual(set(CLASSES), set(ffi.typeof("lam_code").elements) - {lib.LAM_OK})
        for name in lambent.__all__:
            self.assertTrue(getattr(lambent, name).__doc__, name)

    def test_kinds(self):
        with tempfile.TemporaryDirectory() as folder:
            broken, empty = pathlib.Path(folder, "broken.glb"), pathlib.Path(folder, "empty.obj")
            broken.write_bytes(b"glTF\2\0\0\0")
            empty.write_text("# nothing\n")
            for kind, other, pattern, call in (
                (lambent.FileNotFound, FileNotFoundError, "^missing.stl: ", lambda: lambent.render("missing.stl")),
                (lambent.FileNotFound, FileNotFoundError, "^no.hdr: ", lambda: lambent.render("cube", environment="no.hdr")),
                (lambent.BadModel, OSError, "broken.glb: ", lambda: lambent.render(broken)),
                (lambent.BadModel, OSError, "empty.obj: ", lambda: lambent.render(empty)),
                (lambent.BadModel, OSError, "^page.obj: ", lambda: lambent.render(b"<html>", name="page.obj")),
                (lambent.BadValue, ValueError, "^size: found 0, expected one or two whole numbers", lambda: lambent.render("cube", 0)),
                (lambent.BadValue, ValueError, "^shading: found 'fong', expected flat, gouraud", lambda: lambent.render("cube", shading="fong")),
                (lambent.BadValue, ValueError, "^shadow_samples: found 300, expected a whole number from 1 to 256", lambda: lambent.render("cube", shadow_samples=300)),
                (lambent.BadValue, ValueError, "^background: .*blakc", lambda: lambent.render("cube", background="blakc")),
                (lambent.BadValue, ValueError, "^samples: found 'many', expected a whole number", lambda: lambent.render("cube", samples="many")),
                (lambent.BadValue, ValueError, "^zoom: found -1, expected a number above 0", lambda: lambent.render("cube", zoom=-1)),
                (lambent.BadValue, ValueError, "^azimuth: found nan, expected a number that is finite", lambda: lambent.render("cube", azimuth=float("nan"))),
                (lambent.BadValue, ValueError, "^time_limit: found nan", lambda: lambent.render("cube", time_limit=float("nan"))),
                (lambent.BadValue, ValueError, "zero character", lambda: lambent.render("cube\0.obj")),
                (lambent.BadValue, ValueError, "shininess", lambda: lambent.Material(shininess=-1)),
                (lambent.BadValue, ValueError, "cutoff", lambda: lambent.Light("spot", cutoff=200)),
                (lambent.BadValue, ValueError, "eye", lambda: lambent.Camera(eye="here")),
                (lambent.BadValue, ValueError, "^vertices: found an array of the shape 4 and", lambda: lambent.Mesh([1, 2, 3, 4])),
                (lambent.BadValue, ValueError, "[0-9]+", lambda: lambent.render(([[0, 0, 0]], [[0, 1, 2]]))),
                (lambent.BadValue, ValueError, "^Scene.add: found int", lambda: lambent.render(5)),
                (lambent.Unsupported, NotImplementedError, "tif", lambda: lambent.render("cube", 16).encode("tif")),
                (lambent.CannotWrite, OSError, "/none/", lambda: lambent.render("cube", 16).save("/none/a.png")),
                (lambent.LimitReached, lambent.Error, "triangles, expected at most 3", lambda: lambent.render("tests/models/cube.obj", triangle_limit=3)),
                (lambent.OutOfMemory, MemoryError, "memory limit", lambda: lambent.render("examples/models/spot.glb", memory_limit=1000)),
                (lambent.OutOfMemory, MemoryError, "^size: a picture of 4000x3000 pixels needs 48.0 MB", lambda: lambent.render("cube", (4000, 3000), memory_limit=40_000_000)),
                (lambent.BadModel, OSError, "no triangles", lambda: lambent.render(([], []))),
                (lambent.BadModel, OSError, "no triangles", lambda: lambent.render(([[0, 0, 0]], []))),
                (lambent.BadValue, ValueError, "0 to 255 is written '#rrggbb'", lambda: lambent.render("cube", color=(255, 0, 0))),
                (lambent.TimeLimit, TimeoutError, "the time limit of 0.2 s is over", lambda: lambent.render("teapot", 1024, time_limit=0.2, **SLOW)),
            ):
                with self.subTest(pattern=pattern):
                    with self.assertRaisesRegex(kind, pattern) as caught:
                        call()
                    self.assertIs(type(caught.exception), kind)
                    self.assertIsInstance(caught.exception, other)
                    self.assertIsInstance(caught.exception, lambent.Error)
                    self.assertNotIn("\n", str(caught.exception))

    def test_whatever_is_passed(self):
        """Values of any type, in every keyword and argument, are drawn or raise lambent.Error with one sentence."""
        values = [object(), -1, 2 ** 70, float("nan"), "", "\ud800", "a\0b", [], [1, 2], {}, b"x", int, np.zeros((2, 2)), [None], (1, "a"), True, len, 1j, "x" * 3000]
        triangle, picture = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), lambent.render("cube", 4)
        keywords = set(_options.KEYWORDS) | set(_options.OTHERS) | set(_options.CHANGES) | {"name"}
        calls = {"render(%s)" % name: lambda value, name=name: lambent.render("cube", 8, **{name: value}) for name in keywords - {"threads"}}
        calls |= {"Mesh(%s)" % name: lambda value, name=name: lambent.Scene().add(lambent.Mesh(*triangle, **{name: value}))
                  for name in ("normals", "texcoords", "colors", "material", "name")}
        calls |= {"add(%s)" % name: lambda value, name=name: lambent.Scene().add("cube", **{name: value}) for name in ("material", "name", "transform")}
        calls |= {"model": lambda value: lambent.render(value, 8), "size": lambda value: lambent.render("cube", value),
                  "Material": lambent.Material, "diffuse": lambda value: lambent.Material(diffuse=value), "shininess": lambda value: lambent.Material(shininess=value),
                  "map": lambda value: lambent.Material().set_map("diffuse", value), "Light": lambent.Light, "Camera": lambent.Camera,
                  "position": lambda value: lambent.Light("point", position=value), "fovy": lambda value: lambent.Camera(fovy=value),
                  "vertices": lambent.Mesh, "faces": lambda value: lambent.Mesh(triangle[0], value), "encode": picture.encode,
                  "quality": lambda value: picture.encode("jpg", quality=value), "load(name)": lambda value: lambent.load(b"x", name=value),
                  "lights": lambda value: setattr(lambent.Scene().add("cube"), "lights", value), "up": lambda value: setattr(lambent.Scene(), "up", value),
                  "ambient": lambda value: setattr(lambent.Scene(), "ambient", value), "environment": lambda value: lambent.Scene().set_environment(value),
                  "rotation": lambda value: lambent.Scene().set_environment("sky", value), "material": lambda value: lambent.Scene().add("cube").set_material(value),
                  "index": lambda value: lambent.Scene().set_material("ruby", value)}
        refused = 0
        for name, call in calls.items():
            for value in values:
                with self.subTest(call=name, value=repr(value)[:40]):
                    try:
                        call(value)
                    except lambent.Error as error:
                        self.assertNotIn("\n", str(error))
                        refused += 1
        self.assertGreater(refused, 800)

    def test_unknown_keywords(self):
        for pattern, call in (("'shadow'; did you mean 'shadows'", lambda: lambent.render("cube", shadow=True)),
                              ("'material'; it is for lambent.render", lambda: lambent.Scene().add("cube").render(material="ruby"))):
            self.assertRaisesRegex(TypeError, pattern, call)
        self.assertRaisesRegex(AttributeError, "Material has no attribute 'shinyness'; it has ambient", setattr, lambent.Material(), "shinyness", 3)
        self.assertRaisesRegex(AttributeError, "a light of the type ambient has no cutoff", setattr, lambent.Light("ambient"), "cutoff", 3)


class Calls(unittest.TestCase):
    def test_eight_threads(self):
        scene = lambent.load("examples/models/spot.glb")
        with ThreadPoolExecutor(8) as pool:
            hashes = set(pool.map(lambda number: (scene.render(128) if number % 2 else lambent.render("examples/models/spot.glb", 128)).hash, range(24)))
            threads = set(pool.map(lambda number: scene.render(128, reflection="kajiya-kay").hash, range(8)))
        self.assertEqual((hashes, len(threads)), ({lambent.render("examples/models/spot.glb", 128).hash}, 1))

    def test_other_threads_run(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        start = time.monotonic()
        try:
            self.assertRaises(lambent.TimeLimit, lambent.render, "teapot", 1024, time_limit=0.5, threads=1, **SLOW)
        finally:
            done.set()
            thread.join()
        self.assertGreater(len([at for at in ticks if at > start]), 10)

    def test_progress(self):
        told = []
        lambent.render("examples/models/spot.obj", 512, progress=lambda share, step: told.append((share, step, threading.current_thread())))
        self.assertEqual({thread for _, _, thread in told}, {threading.current_thread()})
        self.assertTrue({"read", "frame"} <= {step for _, step, _ in told} and all(0 <= share <= 1 for share, _, _ in told))

    def test_progress_cancels(self):
        def fail(share, step):
            raise KeyError(step)

        self.assertRaises(lambent.Cancelled, lambent.render, "teapot", 1024, progress=lambda share, step: share < 0.01, **SLOW)
        self.assertRaisesRegex(KeyError, "frame", lambent.render, "teapot", 1024, progress=fail, **SLOW)

    def test_control_c(self):
        code = "import lambent; print('ready', flush=True); lambent.render('teapot', 4096, ao='rays', ao_samples=1024)"
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        process.stdout.readline()
        time.sleep(0.5)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        _, text = process.communicate(timeout=20)
        self.assertIn("KeyboardInterrupt", text.splitlines()[-1])
        self.assertLess(time.monotonic() - start, 5)

    def test_the_program_needs_no_python(self):
        self.assertNotIn("python", subprocess.check_output(["ldd", os.environ["LAMBENT"]], text=True))
