#!/usr/bin/env python3
"""project.py version|tag|time: prints the version in meson.build, the name of its git tag, or the time of the commit in seconds since 1970.
project.py tree FOLDER: copies the sources to the new folder FOLDER: the committed files of a clone, or all files of an archive except built ones."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMIT = "$Format:%ct$" # git archive writes the time here (.gitattributes)


def version(root=ROOT):
    return re.search(r"^  version: '(.*)',", (root / "meson.build").read_text(), re.M)[1]


def tag(root=ROOT):
    return "v" + version(root)


def time():
    return int(COMMIT if COMMIT.isdigit() else subprocess.check_output(["git", "-C", ROOT, "log", "-1", "--format=%ct"]))


def tree(folder):
    if COMMIT.isdigit():
        files = ["tar", "-c", "--anchored", "--exclude=./build*", "--exclude=./dist", "--exclude=./out", "-C", ROOT, "."]
    else:
        files = ["git", "-C", ROOT, "archive", "HEAD"]
    pathlib.Path(folder).mkdir()
    with subprocess.Popen(files, stdout=subprocess.PIPE) as packed:
        subprocess.run(["tar", "-x", "-C", folder], stdin=packed.stdout, check=True)
    if packed.returncode:
        sys.exit("project: the sources cannot be copied")


if __name__ == "__main__":
    if sys.argv[1] == "tree":
        tree(sys.argv[2])
    else:
        print({"version": version, "tag": tag, "time": time}[sys.argv[1]]())
