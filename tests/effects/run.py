#!/usr/bin/env python3
"""run.py FULL WITHOUT: a library without effects (-Deffects=false) draws the same bytes of pictures that need none, and refuses each effect
with one sentence. The arguments are plain_picture.c, linked with both libraries."""
import subprocess
import sys


def lines(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()


full, without = lines(sys.argv[1]), lines(sys.argv[2], "effects")
hashes = [line for line in full if ":" not in line]
asked = [line for line in without if ":" in line]
UNSUPPORTED = "3"
checks = [("%d pictures are the same bytes" % len(hashes), hashes and hashes == [line for line in without if ":" not in line])]
checks += [("%s is refused: %s" % tuple(line.split(": ", 1)), "effects were left out" in line) for line in asked if not line.startswith("default look")]
checks += [("the default look is drawn", "default look: 0 " in asked and "default look: 0 " in full), ("each effect was asked for", len(asked) == 10)]
print("1..%d" % len(checks))
for number, (name, ok) in enumerate(checks, 1):
    print("%s %d - %s" % ("ok" if ok else "not ok", number, name))
sys.exit(0 if all(ok for _, ok in checks) else 1)
