#!/usr/bin/env python3
"""count_lines.py [REVISION [REVISION]]: counts the code lines of the product by folder, without blank lines and comments: C, C++, headers, .inc,
GLSL, JavaScript, Python and shell scripts. The lines of tests and of the bench are counted separately. Reads git's files in the working tree or in a
revision. With two revisions, it also prints the difference, which is what an issue's limit of lines refers to."""
import collections
import os
import re
import subprocess
import sys

PRODUCT = ["src", "include", "program", "tools", "web", "classroom", "python", "scripts", "packaging"]
TESTS = ("tests/", "bench/", "classroom/tests/", "packaging/debian/tests/")
CLASSROOM = ("classroom/", "include/lambent/check.h", "web/check/") # the last in older revisions
DRAWING = ("src/core/cpu/", "src/gpu/gl/", "src/gpu/glsl/", "src/core/lighting/")
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


def kind_of(name, first_line):
    """How the file marks comments: the extension, or for a file without one the interpreter on its first line; None if it is not code."""
    ending = name.rpartition(".")[2] if "." in name.rpartition("/")[2] else ""
    if ending in C_LIKE + ("py", "sh"):
        return ending
    return "sh" if first_line.startswith("#!") else None


def count(revision):
    """The lines of each folder, and the sums: of the product, of the part of it that is the classroom, of tests, and of the code that draws."""
    listed = git("ls-tree", "-r", "--name-only", revision) if revision else git("ls-files")
    folders, sums = collections.Counter(), collections.Counter()
    for name in listed.decode().split("\n"):
        top = name.split("/")[0]
        if not (top in PRODUCT or name.startswith(TESTS)) or (not revision and not os.path.exists(name)):
            continue
        data = git("show", "%s:%s" % (revision, name)) if revision else open(name, "rb").read()
        kind = kind_of(name, data[:80].decode("utf-8", "replace"))
        if not kind:
            continue
        lines = code_lines(data.decode("utf-8", "replace"), kind)
        folders["/".join(name.split("/")[:-1][:2 if name.startswith(("src/", "program/", "tools/", "tests/", "classroom/")) else 1])] += lines
        is_test = name.startswith(TESTS)
        sums["tests and bench" if is_test else "product"] += lines
        sums["product: classroom"] += lines if not is_test and name.startswith(CLASSROOM) else 0
        sums["cpu + gl + glsl + lighting"] += lines if name.startswith(DRAWING) else 0
    return folders, sums


def main():
    revisions = sys.argv[1:3] or [None]
    counted = [count(revision) for revision in revisions]
    for part in (0, 1):
        for name in sorted(set().union(*(one[part] for one in counted))):
            numbers = [one[part][name] for one in counted]
            difference = " %+7d" % (numbers[1] - numbers[0]) if len(numbers) > 1 else ""
            if not part and len(numbers) > 1 and numbers[0] == numbers[1]:
                continue
            print("%-26s %s%s" % (name, " ".join("%7d" % number for number in numbers), difference))


if __name__ == "__main__":
    main()
