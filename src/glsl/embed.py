#!/usr/bin/env python3
"""embed.py OUT FILE...: text files as C strings, text_NAME_ENDING each."""
import os
import sys


def quoted(line):
    return '"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


with open(sys.argv[1], "w") as out:
    for path in sys.argv[2:]:
        name = "text_" + os.path.basename(path).replace(".", "_")
        lines = open(path, encoding="ascii").read().splitlines(keepends=True)
        out.write("static const char %s[] =\n%s;\n" % (name, "\n".join(quoted(line) for line in lines)))
