#!/usr/bin/env python3
"""count_lines.py [REVISION]: counts the code lines of the product by folder: C, C++, headers, .inc, GLSL, JavaScript and Python, without
blank lines and comments. Reads git's files in the working tree or in a revision."""
import collections
import re
import subprocess
import sys

PRODUCT = ["src", "include", "tools", "web", "classroom"]
DRAWING = ("src/cpu/", "src/gl/", "src/glsl/", "src/lighting/")
C_LIKE = ("c", "h", "cpp", "inc", "glsl", "js", "mjs", "ts")
# Strings, template literals and the slashes of regular expressions are not comments; the first match wins.
C_TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|`(?:\\.|[^`\\])*`|//[^\n]*|/\*.*?\*/', re.S)
PYTHON_TOKEN = re.compile(r'(?m)^[ \t]*("""|\'\'\')(?:.*?)\1[ \t]*$|("""|\'\'\')(?:\\.|.)*?\2|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|#[^\n]*', re.S)


def code_lines(text, kind):
    def without_comment(match):
        token = match[0]
        is_comment = token.startswith(("//", "/*")) if kind in C_LIKE else token.startswith("#") or match[1]
        return "\n" * token.count("\n") if is_comment else token

    text = (C_TOKEN if kind in C_LIKE else PYTHON_TOKEN).sub(without_comment, text)
    return sum(1 for line in text.splitlines() if line.strip())


def git(*words):
    return subprocess.run(["git", *words], stdout=subprocess.PIPE, check=True).stdout


def main():
    revision = sys.argv[1] if len(sys.argv) > 1 else None
    names = git("ls-tree", "-r", "--name-only", revision, *PRODUCT) if revision else git("ls-files", *PRODUCT)
    folders, total, drawing = collections.Counter(), 0, 0
    for name in names.decode().split("\n"):
        kind = name.rpartition(".")[2]
        if kind not in C_LIKE + ("py",):
            continue
        text = git("show", "%s:%s" % (revision, name)).decode() if revision else open(name, encoding="utf-8").read()
        lines = code_lines(text, kind)
        folders["/".join(name.split("/")[:-1][:2 if name.startswith(("src/", "tools/")) else 1])] += lines
        total += lines
        drawing += lines if name.startswith(DRAWING) else 0
    for folder, lines in sorted(folders.items()):
        print("%-24s %6d" % (folder, lines))
    print("%-24s %6d" % ("cpu + gl + glsl + lighting", drawing))
    print("%-24s %6d" % ("product", total))


if __name__ == "__main__":
    main()
