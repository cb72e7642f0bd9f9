# test_devices.py: the command `devices` on this machine and on a machine with a broken OpenGL; pictures by
# OpenGL.
import json
import os
import struct
import subprocess
import zlib

from harness import Case, PROGRAM, chunk


class Devices(Case):
    def test_lists(self):
        text = self.good("devices").stdout.decode()
        self.assertRegex(text, r"^cpu   cpu \w+, \d+ thread")
        self.assertIn("\ngl", text)
        answer = json.loads(self.good("devices", "--json").stdout)
        self.assertTrue(answer["cpu"].startswith("cpu "))
        # Either devices are listed, or the reason why there are none.
        self.assertTrue(answer["gl"] or answer["gl_reason"])
        for device in answer["gl"]:
            self.assertIn(device["name"] or device["place"], text)
            self.assertTrue(bool(device["versions"]) != bool(device["reason"]))

    def test_nothing_of_it_is_linked(self):
        linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True).stdout
        for library in ("libEGL", "libGL", "libOpenGL", "libgbm"):
            self.assertNotIn(library, linked)

    def test_broken_library(self):
        (self.folder / "libEGL.so.1").write_text("no library")
        done = subprocess.run([PROGRAM, "devices"], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("libEGL.so.1 cannot be opened", done.stdout)
        self.assertIn("apt install libegl1 libegl-mesa0 libgl1-mesa-dri", done.stdout)
        # The CPU still draws.
        drawn = subprocess.run([PROGRAM, "cube", "-s", "32x32"], capture_output=True, cwd=self.folder, timeout=60,
                               env={**os.environ, "LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual(drawn.returncode, 0)
        # If OpenGL is requested, Lambent does not switch to another device.
        for option in (["--device", "gl"], ["--device", "gles"], ["--gl-device", "0"]):
            self.bad(3, "cube", "-s", "32x32", *option, says=("libEGL.so.1 cannot be opened", "apt install libegl1"),
                     leaves=["cube.png"], env={"LD_LIBRARY_PATH": str(self.folder)})

    def test_options(self):
        self.bad(1, "cube", "--device", "vulkan", says=("vulkan", "auto, cpu, gl or gles"))
        self.bad(1, "cube", "--device", "cpu", "--gl-device", "0", says=("--device cpu", "--gl-device"))
        self.bad(1, "cube", "--device", "gl", "--isa", "plain", says="--isa")
        self.bad(1, "cube", "--texture-filter", "hardware", says=("--texture-filter hardware", "--device gl"))
        self.bad(1, "cube", "--device", "gl", "--texture-filter", "fast", says=("fast", "exact or hardware"))
        self.bad(1, "cube", "--device", "gl", "--stage", "vertex", "--shading", "phong", says=("phong", "fragment"))


class Drawing(Case):
    def setUp(self):
        super().setUp()
        devices = json.loads(self.good("devices", "--json").stdout)["gl"]
        self.usable = [d for d in devices if d["reason"] is None]
        if not self.usable:
            self.skipTest("no OpenGL here")

    def differing(self, a, b):
        """The pixels that differ by more than 1/255."""
        answer = json.loads(self.run_program("diff", a, b, "--json").stdout)
        return round(answer["share_over_1"] * answer["width"] * answer["height"])

    def apart(self, *words, device="gl"):
        """The pixels that differ by more than 1/255 between the two devices, and the report of OpenGL's picture."""
        self.good(*words, "-s", "64x48", "-o", "cpu.png")
        report = self.report(*words, "-s", "64x48", "-o", "gl.png", "--device", device)
        return self.differing("cpu.png", "gl.png"), report

    def test_shadows_through_surfaces_and_at_vertices(self):
        light = ["--shadows", "--light", "directional:direction=-0.4/-1/-0.3"]
        for more in (["torus-knot", "--opacity", "0.5"], ["torus-knot", "--shading", "gouraud", "--stage", "application"],
                     ["torus-knot", "--shading", "gouraud", "--stage", "vertex"], ["torus-knot", "--shading", "flat", "--stage", "application"],
                     ["torus-knot", "--shading", "flat", "--stage", "fragment"],
                     ["torus-knot", "--opacity", "0.5", "--shading", "gouraud", "--stage", "application"]):
            differ, _ = self.apart(*more, "--samples", 1, *light)
            self.assertLessEqual(differ, 12, more)
            self.good(*more, "-s", "64x48", "--samples", 1, *light[1:], "-o", "lit.png")
            self.assertGreater(self.differing("lit.png", "cpu.png"), 40, more)  # there are shadows

    def test_same_picture(self):
        for device, version in (("gl", "OpenGL 3.3"), ("gles", "OpenGL ES 3.0")):
            if not any(version in d["versions"] for d in self.usable):
                continue
            for more in ([], ["--opacity", "0.5"], ["--stage", "application"], ["--shading", "flat", "--background", "white"],
                         ["--show", "ids"], ["--reflection-map", "sky", "--reflectivity", "0.5"], ["--environment", "sky"], ["--environment", "sky", "--background", "environment:0.1"]):
                differ, report = self.apart("cube", "--samples", 1, *more, device=device)
                self.assertLessEqual(differ, 3, more)
                self.assertTrue(report["device"]["name"].startswith("gl "))
                self.assertEqual(report["device"]["isa"], None)
                self.assertGreater(report["counts"]["bytes_uploaded"], 0)
                self.assertGreater(report["counts"]["pixels_covered"], 0)
                steps = report["times_ms"]["steps"]
                self.assertTrue(steps["draw"] > 0 and steps["read"] > 0)
                self.assertEqual(steps["lighting"] > 0, "application" in more)

    def test_shadows_and_grounds(self):
        plain = self.png("torus-knot", "--samples", 1, "-s", "64x48", "--device", "gl")
        for more in (["--shadows"], ["--ground"], ["--ground", "checker", "--shadow-samples", 5], ["--ground", "#c08040", "--ao", "off"],
                     ["--ground", "--rig", "headlight"], ["--ground", "checker", "--show", "normals"], ["--ground", "--show", "ao"]):
            differ, _ = self.apart("torus-knot", "--samples", 1, *more)
            self.assertLessEqual(differ, 8, more)
            self.assertNotEqual((self.folder / "gl.png").read_bytes(), plain, more)

    def test_texture_filter(self):
        """The graphics card's filters give another picture, close to the exact one."""
        rows = b"".join(b"\0" + bytes(c for x in range(64) for c in ((230, 220, 200) if x // 8 % 2 == y // 8 % 2 else (40, 30, 20)))
                        for y in range(64))
        (self.folder / "tiles.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 64, 8, 2, 0, 0, 0)) +
                                                chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        (self.folder / "floor.mtl").write_text("newmtl a\nmap_Kd -s 5 5 tiles.png\n")
        (self.folder / "floor.obj").write_text("mtllib floor.mtl\nusemtl a\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 3/3 2/2 1/1\n")
        for name, options in (("given.ppm", []), ("exact.ppm", ["--texture-filter", "exact"]), ("fast.ppm", ["--texture-filter", "hardware"])):
            self.good("floor.obj", "-s", "96x96", "--samples", "1", "--device", "gl", *options, "-o", name)
        self.assertEqual(self.folder.joinpath("given.ppm").read_bytes(), self.folder.joinpath("exact.ppm").read_bytes())
        report = json.loads(self.run_program("diff", "given.ppm", "fast.ppm", "--json").stdout)
        self.assertGreater(report["maximum"], 0)
        self.assertLess(report["mean"], 0.01)
        # The printed shaders contain the same filters.
        self.assertIn("texelFetch(", self.good("shader", "floor.obj").stdout.decode())
        printed = self.good("shader", "floor.obj", "--texture-filter", "hardware").stdout.decode()
        self.assertIn("textureGrad(map, at, dx, dy)", printed)
        self.assertNotIn("texelFetch(", printed)

    def test_samples_and_repeated_frames(self):
        differ, _ = self.apart("cube", "--samples", 8, "--show", "coverage")
        self.assertLessEqual(differ, 3)
        # The counts belong to the frame with the median time, in which all data is already present. The first frame compiles shaders; to become the
        # median, it would have to be faster than seven of fifteen.
        report = self.report("cube", "-s", "32x32", "--ao", "off", "--device", "gl", "--repeat", 15, "-o", "r.png")
        self.assertEqual(report["counts"]["bytes_uploaded"], 0)

    def test_choosing(self):
        name = self.usable[0]["name"]
        for chosen in (str(self.usable[0]["number"]), name, name[:4].upper()):
            self.assertIn(name[:40], self.report("cube", "-s", "16x16", "--gl-device", chosen, "-o", "c.png")["device"]["name"])
        self.bad(3, "cube", "--gl-device", "voodoo", says=("'voodoo'", name), leaves=["c.png"])
        self.bad(3, "cube", "--device", "gl", "--gl-device", "99", says=("no device 99", "expected 0 to"), leaves=["c.png"])

    def test_what_it_cannot(self):
        self.bad(3, "explain", "cube", "5,5", "--device", "gl", says=("lambent: cube: the device 'gl", "cannot explain", "CPU device"))
