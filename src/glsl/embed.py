#!/usr/bin/env python3
"""embed.py OUT FILE...: writes text files as C strings text_NAME_ENDING, each up to a line "// --- C only". A line
`#include "NAME"` becomes the file of that name beside it."""
import os
import re
import sys


def quoted(line):
    return '"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


with open(sys.argv[1], "w") as out:
    for path in sys.argv[2:]:
        name = "text_" + re.sub("[.-]", "_", os.path.basename(path))
        def included(line):
            return open(os.path.join(os.path.dirname(path), line.group(1)), encoding="utf-8").read()
        source = open(path, encoding="utf-8").read().partition("// --- C only")[0]
        source = re.sub(r'^#include "(.*)"\n', included, source, flags=re.M)
        source.encode("ascii")  # GLSL 120 and 330 allow no other characters
        lines = source.splitlines(keepends=True)
        out.write("static const char %s[] =\n%s;\n" % (name, "\n".join(quoted(line) for line in lines)))
