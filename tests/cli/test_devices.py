# test_devices.py: the command `devices`, on this machine and on one whose OpenGL is broken.
import json
import os
import subprocess

from harness import Case, PROGRAM


class Devices(Case):
    def test_lists(self):
        text = self.good("devices").stdout.decode()
        self.assertRegex(text, r"^cpu   cpu \w+, \d+ thread")
        self.assertIn("\ngl", text)
        told = json.loads(self.good("devices", "--json").stdout)
        self.assertTrue(told["cpu"].startswith("cpu "))
        # Either there are devices, or the reason why there are none.
        self.assertTrue(told["gl"] or told["gl_reason"])
        for device in told["gl"]:
            self.assertIn(device["name"] or device["place"], text)
            self.assertTrue(bool(device["versions"]) != bool(device["reason"]))

    def test_nothing_of_it_is_linked(self):
        linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True).stdout
        for library in ("libEGL", "libGL", "libOpenGL", "libgbm"):
            self.assertNotIn(library, linked)

    def test_broken_library(self):
        (self.folder / "libEGL.so.1").write_text("no library")
        self.given |= {"libEGL.so.1"}
        done = subprocess.run([PROGRAM, "devices"], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("libEGL.so.1 cannot be opened", done.stdout)
        self.assertIn("apt install libegl1 libegl-mesa0 libgl1-mesa-dri", done.stdout)
        # Pictures are drawn as ever.
        drawn = subprocess.run([PROGRAM, "cube", "-s", "32x32"], capture_output=True, cwd=self.folder, timeout=60,
                               env={**os.environ, "LD_LIBRARY_PATH": str(self.folder)})
        self.assertEqual(drawn.returncode, 0)
