#!/usr/bin/env python3
"""static_library.py OUTPUT INPUT OBJCOPY -- COMPILER…: makes a static library of one object. Names that the shared library hides are
local in this object, so they cannot conflict with names of a program."""
import os
import subprocess
import sys

output, library, objcopy = sys.argv[1:4]
compiler = sys.argv[5:]
whole = output + ".o"
subprocess.run([*compiler, "-r", "-nostdlib", "-o", whole, "-Wl,--whole-archive", library, "-Wl,--no-whole-archive"], check=True)
subprocess.run([objcopy, "--localize-hidden", whole], check=True)
if os.path.exists(output):
    os.remove(output)
subprocess.run(["ar", "rcs", output, whole], check=True)
os.remove(whole)
