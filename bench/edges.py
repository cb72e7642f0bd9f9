#!/usr/bin/env python3
"""edges.py: measures the time of lines over the picture of a million triangles, at 1024² with AVX2 and two threads.

    edges.py LAMBENT            prints the table: milliseconds, the least of three runs
    edges.py LAMBENT --write    also writes it into docs/edges.md

The first frame builds the bounding volume hierarchy and lists the edges; the next only finds what is hidden and draws."""
import json
import os
import subprocess
import sys
import tempfile

import made_part
import paths

PAGE = os.path.join(paths.ROOT, "docs", "edges.md")
MODEL = ["torus-knot", "--segments", "1024x488", "-s", "1024", "--isa", "avx2", "--threads", "2"]
KINDS = [["--wireframe"], ["--edges", "all"], ["--edges", "silhouette"], ["--edges", "crease"]]
RUNS = 3


def steps(lambent, options, frames, picture):
    """The report of a run: its number of triangles, and the steps of its frame (of several frames the median)."""
    done = subprocess.run([lambent, *MODEL, *options, "--repeat", str(frames), "--json", "-o", picture], check=True, stdout=subprocess.PIPE)
    report = json.loads(done.stdout)
    return report["model"]["triangles"], report["times_ms"]["steps"]


def table(lambent):
    yield "| | hierarchy | edges, first frame | edges, next frames |"
    yield "|---|---|---|---|"
    with tempfile.TemporaryDirectory() as folder:
        picture = os.path.join(folder, "lines.ppm")
        for options in KINDS:
            first = [steps(lambent, options, 1, picture) for _ in range(RUNS)]
            rest = [steps(lambent, options, 3, picture) for _ in range(RUNS)]
            yield "| `%s`, %s triangles | %.0f ms | %.0f ms | %.0f ms |" % (
                " ".join(options), format(first[0][0], ","), min(s["hierarchy"] for _, s in first),
                min(s["edges"] for _, s in first), min(s["edges"] for _, s in rest))


def main():
    lines = []
    for line in table(os.path.abspath(sys.argv[1])):
        print(line, flush=True)
        lines.append(line)
    if "--write" in sys.argv:
        made_part.write(PAGE, "cost", "edges.py", lines)


if __name__ == "__main__":
    main()
