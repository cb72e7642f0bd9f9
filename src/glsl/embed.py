#!/usr/bin/env python3
"""embed.py OUT FILE...: writes text files as C strings text_NAME_ENDING, each up to a line "// --- C only"."""
import os
import sys


def quoted(line):
    return '"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


with open(sys.argv[1], "w") as out:
    for path in sys.argv[2:]:
        name = "text_" + os.path.basename(path).replace(".", "_")
        source = open(path, encoding="utf-8").read().partition("// --- C only")[0]
        source.encode("ascii")  # GLSL 120 and 330 allow no other characters
        lines = source.splitlines(keepends=True)
        out.write("static const char %s[] =\n%s;\n" % (name, "\n".join(quoted(line) for line in lines)))
