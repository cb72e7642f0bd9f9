#!/usr/bin/env python3
# run.py: runs tests of the program. run.py PROGRAM [unittest's arguments; without them, all tests except `check` and `known`]
# run.py --modules prints the names of the test files of this folder; tests/meson.build makes a test of each, and the tests run in parallel.
# run.py --modules-without-classroom prints those that apply without the program lambent-classroom.
# run.py --long prints the test files that contain tests marked with harness.long. These run if LAMBENT_LONG is set: only these
# tests with "only", or all tests with "all". A test given by name always runs.
# The tests of the commands of lambent-classroom are in classroom/tests/cli.
import os
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).parent
CLASSROOM = HERE.parents[1] / "classroom" / "tests" / "cli"
paths = {path.stem: path for folder in (HERE, CLASSROOM) for path in sorted(folder.glob("test_*.py"))}
suite = sorted(name for name in paths if name not in ("test_check", "test_check_class", "test_check_teaching", "test_known"))
own = [name for name in suite if paths[name].parent == HERE]
if sys.argv[1:] == ["--modules"]:
    print("\n".join(own))
    sys.exit()
NEED_CLASSROOM = ("test_attack", "test_docs", "test_limits", "test_numbers", "test_output", "test_release", "test_resources", "test_shader", "test_terminal")
if sys.argv[1:] == ["--modules-without-classroom"]:
    print("\n".join(name for name in own if name not in NEED_CLASSROOM))
    sys.exit()
if sys.argv[1:] == ["--long"]:
    print("\n".join(name for name in suite if "    @long\n" in paths[name].read_text()))
    sys.exit()
if len(sys.argv) < 2:
    sys.exit("run.py: the program to test is missing: run.py build/lambent")
os.environ["LAMBENT"] = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path[:0] = [str(HERE), str(CLASSROOM)]


class Loader(unittest.TestLoader):
    """Skips the tests of `make test-long`, or all other tests."""

    def getTestCaseNames(self, case):
        names, wanted = super().getTestCaseNames(case), os.environ.get("LAMBENT_LONG", "")
        return [name for name in names if wanted == "all" or hasattr(getattr(case, name), "long") == (wanted == "only")]


class TapResult(unittest.TextTestResult):
    """Prints a line in the Test Anything Protocol for each test, so that the suite can count them."""

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
    unittest.main(module=None, testRunner=runner, testLoader=Loader())
unittest.main(module=None, argv=[sys.argv[0], *suite], testRunner=runner, testLoader=Loader())
