#!/usr/bin/env python3
"""embed.py [--dialect] OUT FILE...: writes text files as C strings text_NAME_ENDING, each up to a line "// --- C only". Replaces a line
`#include "NAME"` by the contents of that file in the same folder. With --dialect, translates the dialect of src/core/lighting to GLSL: num
becomes float, mask becomes bool, STRUCT(name) becomes struct name, and num_of(1.0f) becomes 1.0. FN, the definitions of these words,
and the suffix f of numbers are removed."""
import os
import re
import sys

DEFINITIONS = re.compile(r"#ifdef|#endif|#pragma|precision|#define (?:FN$|STRUCT|num |mask |vec3_of |vec4_of )|float num_of\(")
WORDS = {"num": "float", "num_of": "float", "mask": "bool", "vec3_of": "vec3", "vec4_of": "vec4"}
TOKEN = re.compile(r"(//.*)|\b(?:FN|SCENE|IN_SCENE) |\bSTRUCT\((\w+)\)|\bnum_of\(([-.0-9e]*)f?\)|(?<!\w)(\d\w*)f\b|\b(num|num_of|mask|vec3_of|vec4_of)\b")


def glsl(line):
    def replaced(match):
        comment, struct, constant, number, word = match.groups()
        return comment or struct and "struct " + struct or constant or number or WORDS.get(word, "")
    return "" if DEFINITIONS.match(line) else TOKEN.sub(replaced, line)


def quoted(line):
    return '"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


files = [word for word in sys.argv[1:] if word != "--dialect"]
with open(files[0], "w") as out:
    for path in files[1:]:
        name = "text_" + re.sub("[.-]", "_", os.path.basename(path))
        def included(line):
            return open(os.path.join(os.path.dirname(path), line.group(1)), encoding="utf-8").read()
        source = open(path, encoding="utf-8").read().partition("// --- C only")[0]
        source = re.sub(r'^#include "(.*)"\n', included, source, flags=re.M)
        source.encode("ascii")  # GLSL 120 and 330 allow no other characters
        lines = source.splitlines(keepends=True)
        if "--dialect" in sys.argv:
            lines = [glsl(line) for line in lines]
        out.write("static const char %s[] =\n%s;\n" % (name, "\n".join(quoted(line) for line in lines)))
