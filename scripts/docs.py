#!/usr/bin/env python3
"""docs.py LAMBENT: regenerates the generated parts of the documentation: the manual of the command line, and every picture drawn by
a command in a Markdown file of the project. Such a command is a line of a code block that begins with `lambent ` and names its
picture with `-o docs/pictures/…`."""
import glob
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def commands():
    for path in [os.path.join(ROOT, "README.md")] + sorted(glob.glob(os.path.join(ROOT, "docs", "**", "*.md"), recursive=True)):
        for line in open(path, encoding="utf-8"):
            if re.match(r"\s*lambent .*-o docs/pictures/", line):
                yield shlex.split(line, comments=True)


def main():
    program = os.path.abspath(sys.argv[1])
    os.makedirs(os.path.join(ROOT, "docs", "pictures", "lighting"), exist_ok=True)
    manual = subprocess.run([program, "generate", "markdown"], stdout=subprocess.PIPE, check=True).stdout
    with open(os.path.join(ROOT, "docs", "command-line.md"), "wb") as file:
        file.write(manual)
    for command in commands():
        print(" ".join(command))
        done = subprocess.run([program] + command[1:], cwd=ROOT)
        # The exit code of a check is its verdict: 6 means that the shader fails. 3: no OpenGL here; the sheet stays unchanged.
        if done.returncode not in ((0, 3, 6) if command[1] == "check" else (0,)):
            sys.exit("docs.py: %s ended with %d" % (" ".join(command), done.returncode))


if __name__ == "__main__":
    main()
