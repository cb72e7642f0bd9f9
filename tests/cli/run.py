#!/usr/bin/env python3
# run.py: runs tests of the program. run.py PROGRAM [unittest's arguments; without them, all tests except `check` and `known`]
# run.py --modules prints the names of those test files; tests/meson.build makes a test of each, and the tests run in parallel.
# run.py --modules-without-classroom prints the test files that apply to a program built with -Dclassroom=false.
# run.py --long prints the test files that contain tests marked with harness.long. These run if LAMBENT_LONG is set: only these
# tests with "only", or all tests with "all". A test given by name always runs.
import os
import pathlib
import sys
import unittest

suite = sorted(path.stem for path in pathlib.Path(__file__).parent.glob("test_*.py")
               if path.stem not in ("test_check", "test_check_class", "test_check_teaching", "test_known"))
if sys.argv[1:] == ["--modules"]:
    print("\n".join(suite))
    sys.exit()
NEED_CLASSROOM = ("test_attack", "test_completion", "test_docs", "test_explain", "test_limits", "test_numbers", "test_output", "test_plot", "test_release",
                  "test_resources", "test_terminal")
if sys.argv[1:] == ["--modules-without-classroom"]:
    print("\n".join(name for name in suite if name not in NEED_CLASSROOM))
    sys.exit()
if sys.argv[1:] == ["--long"]:
    print("\n".join(name for name in suite if "    @long\n" in (pathlib.Path(__file__).parent / f"{name}.py").read_text()))
    sys.exit()
if len(sys.argv) < 2:
    sys.exit("run.py: the program to test is missing: run.py build/lambent")
os.environ["LAMBENT"] = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path.insert(0, str(pathlib.Path(__file__).parent))


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
