#!/usr/bin/env python3
"""docs.py LAMBENT: writes anew what the project itself makes of its documentation: the command line's manual, and every picture that
a command in a Markdown file of the project draws. Such a command stands on a line of its own in a code block, begins with
`lambent ` and names its picture with `-o docs/pictures/…`."""
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
        # Of a check the verdict is the code: 6 tells of a shader that does not pass. 3: no OpenGL here, its sheet stays as it is.
        if done.returncode not in ((0, 3, 6) if command[1] == "check" else (0,)):
            sys.exit("docs.py: %s ended with %d" % (" ".join(command), done.returncode))


if __name__ == "__main__":
    main()
