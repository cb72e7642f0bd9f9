#!/usr/bin/env python3
# run.py: all tests of the program as its users run it.  run.py PROGRAM [unittest's arguments]
import os
import pathlib
import sys
import unittest

if len(sys.argv) < 2:
    sys.exit("run.py: the program to test is missing: run.py build/lambent")
os.environ["LAMBENT"] = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path.insert(0, str(pathlib.Path(__file__).parent))
suite = ["test_options", "test_output", "test_errors", "test_docs"]
if len(sys.argv) > 1:
    unittest.main(module=None)
unittest.main(module=None, argv=[sys.argv[0], *suite])
