#!/usr/bin/env python3
"""run.py PROGRAM BUILD: builds the wheel (python/setup.py) from the library in BUILD, unpacks it, and compares it with the program:
tests/python/test_*.py, the doctests of the package and of docs/python.md, and the cells of examples/notebook.ipynb. The tests are skipped if the
required Debian packages are missing."""
import doctest
import importlib.util
import os
import pathlib
import shutil
import sys
import unittest
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
NEEDED = {"cffi": "python3-cffi", "numpy": "python3-numpy", "setuptools": "python3-setuptools", "wheel": "python3-wheel"}


def unpacked(build):
    """The folder that contains the package of a new wheel, and the wheel."""
    import make_wheel
    folder = pathlib.Path(build, "python").resolve()
    try:
        made = make_wheel.build(build, folder)
    except RuntimeError as error:
        sys.exit("1..1\nnot ok 1 - the wheel is built\n# " + "\n# ".join(str(error).splitlines()[-30:]))
    shutil.rmtree(folder / "unpacked", ignore_errors=True)
    with zipfile.ZipFile(made) as archive:
        archive.extractall(folder / "unpacked")
    return folder / "unpacked", made


class TapResult(unittest.TextTestResult):
    """Prints a line of the Test Anything Protocol for each test."""

    lines = 0

    def tell(self, test, word, note=""):
        self.lines += 1
        print("%s %d - %s%s" % (word, self.lines, str(test).split(" ")[0], note), flush=True)

    def addSuccess(self, test):
        self.tell(test, "ok")

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.tell(test, "not ok")

    def addError(self, test, err):
        super().addError(test, err)
        self.tell(test, "not ok")

    def addSkip(self, test, reason):
        self.tell(test, "ok", " # SKIP " + reason)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err:
            self.tell(subtest, "not ok")


def main():
    missing = [package for module, package in NEEDED.items() if not importlib.util.find_spec(module)]
    if not pathlib.Path("/usr/include/python%d.%d/Python.h" % sys.version_info[:2]).exists():
        missing.append("python3-dev")
    if missing:
        print("1..1\nok 1 - the Python package # SKIP not installed: " + " ".join(missing))
        return 0
    sys.path.insert(0, str(ROOT / "python"))
    folder, made = unpacked(sys.argv[2])
    os.environ.update(PYTHONPATH=str(folder), LAMBENT=str(pathlib.Path(sys.argv[1]).resolve()), LAMBENT_WHEEL=str(made))
    sys.path[:1] = [str(folder), str(HERE)]
    os.chdir(ROOT)
    import lambent
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromNames(sys.argv[3:] or sorted(path.stem for path in HERE.glob("test_*.py"))))
    if not sys.argv[3:]:
        for name in ("__init__", "_scene", "_picture", "_fields", "_mesh"):
            module = lambent if name == "__init__" else getattr(lambent, name)
            suite.addTests(doctest.DocTestSuite(module) if doctest.DocTestFinder(exclude_empty=True).find(module) else [])
        suite.addTest(doctest.DocFileSuite(str(ROOT / "docs/python.md"), module_relative=False, optionflags=doctest.ELLIPSIS))
    result = unittest.TextTestRunner(resultclass=TapResult, verbosity=0).run(suite)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
