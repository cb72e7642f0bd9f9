# test_bench.py: the bench measures the repository's models, generates the others, and skips what is not
# installed.
import os
import subprocess
import sys

from harness import PROGRAM, ROOT, Case

SETUP = """
import os, sys
sys.path.insert(0, %r)
import paths
paths.OUT = paths.RESULTS = paths.PICTURES = os.getcwd()
paths.MODELS, paths.LAMBENT = os.path.join(paths.OUT, "models"), %r
import gltf_rows, run, whole
""" % (str(ROOT / "bench"), PROGRAM)


class Bench(Case):
    def python(self, text, **environment):
        known = {key: value for key, value in os.environ.items() if key != "LAMBENT_MODELS"}
        done = subprocess.run([sys.executable, "-c", SETUP + text], cwd=self.folder, env={**known, **environment}, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_models(self):
        """Rows need additional models only if LAMBENT_MODELS names them."""
        names = "print(*[name for name, _, _ in run.row_list(['avx2'], False, whole.Display(), True)], sep='\\n')"
        own = set(self.python(names).splitlines())
        others = set(self.python(names, LAMBENT_MODELS="/nowhere").splitlines()) - own
        self.assertTrue({"whole spot", "whole teapot", "glb spot", "three.js spot", "batch 256 px"} <= own)
        self.assertEqual({word for word in ("knight", "toy car", "normal tangent", "koala", "gallery") for name in others if word in name},
                         {"knight", "toy car", "normal tangent", "koala", "gallery"})
        made = self.python("print(whole.small_model('spot'), whole.small_model('teapot'), gltf_rows.TEXTURED['spot'](), gltf_rows.environment(), sep='\\n')")
        *models, environment = made.splitlines()
        for model in models:
            self.good(model, "-s", 8, "-o", "-", "--environment", environment)

    def test_what_is_not_installed(self):
        """Rows whose peer is missing report this, and the bench succeeds."""
        said = self.python("sys.argv = ['run.py', 'whole spot', 'three.js spot']\nsys.exit(run.main())", PATH="/nowhere")
        self.assertRegex(said, r"(?m)^ *\d+  whole spot +not measured: f3d or Xvfb is not installed")
        self.assertRegex(said, r"(?m)^ *\d+  three.js spot +not measured: three.js: chromium is not installed")
        said = self.python("gltf_rows.environment = lambda: '/nowhere.hdr'\nsys.argv = ['run.py', 'prefilter']\nprint(run.main())")
        self.assertRegex(said, r"NOT +not measured: .*nowhere.hdr(.|\n)*\n1\n$")  # a row that fails counts as a failure
