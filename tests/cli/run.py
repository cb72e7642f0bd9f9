#!/usr/bin/env python3
# run.py: runs all tests of the program.  run.py PROGRAM [unittest's arguments]
import os
import pathlib
import sys
import unittest

if len(sys.argv) < 2:
    sys.exit("run.py: the program to test is missing: run.py build/lambent")
os.environ["LAMBENT"] = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path.insert(0, str(pathlib.Path(__file__).parent))
suite = ["test_show", "test_options", "test_output", "test_errors", "test_docs", "test_numbers", "test_diff", "test_plot", "test_compare",
         "test_lights", "test_scene", "test_gltf", "test_textures", "test_explain", "test_environment", "test_devices", "test_shader", "test_completion", "test_shadows", "test_limits", "test_occlusion", "test_sandbox", "test_batch", "test_shards", "test_edges", "test_animation"]


class TapResult(unittest.TextTestResult):
    """Prints a line of the Test Anything Protocol for each test, so that the suite can count them."""

    lines = 0

    def tell(self, test, ok, note=""):
        self.lines += 1
        print("%s %d - %s%s" % ("ok" if ok else "not ok", self.lines, test.id(), note), flush=True)

    def addSuccess(self, test):
        super().addSuccess(test)
        self.tell(test, True)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.tell(test, False)

    def addError(self, test, err):
        super().addError(test, err)
        self.tell(test, False)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err:
            self.tell(subtest, False)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.tell(test, True, " # SKIP " + reason)


runner = unittest.TextTestRunner(resultclass=TapResult, verbosity=0)
if len(sys.argv) > 1:
    unittest.main(module=None, testRunner=runner)
unittest.main(module=None, argv=[sys.argv[0], *suite], testRunner=runner)
