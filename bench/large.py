#!/usr/bin/env python3
"""large.py: draws an STL file of 100 million triangles (5 GB), and measures its time and its peak memory. It needs 5 GB of disk and 10 GB of memory
and takes minutes, so `make bench` does not include it: run `BENCH=large make bench`.

    large.py            prints the table: medians of three runs for each instruction set
    large.py --write    also writes it into docs/speed.md

The program generates the file, and removes it afterwards. If the file fits into memory, the system's page cache contains it from the second run on,
so the first run is not measured. Exit status 1: a target is not reached."""
import datetime
import os
import shutil
import statistics
import sys

import made_part
import measure
import paths
import scenes

PAGE = os.path.join(paths.ROOT, "docs", "speed.md")
TRIANGLES, RUNS = 100000000, 3
CPU_S, SHARE = 8, 0.95  # targets: processor time; peak memory as a share of the file
DISK, MEMORY = 6e9, 10e9  # bytes that must be free


def free_memory():
    with open("/proc/meminfo") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("MemAvailable"))


def table(path, reached):
    facts, picture = measure.machine(), os.path.join(paths.PICTURES, "large.png")
    yield "Measured %s on %s, %d processors, at a load of %.1f." % (datetime.date.today(), facts["processor"], facts["processors"], facts["load_before"])
    yield ""
    yield "| instruction set | time | processor time (at most %d s) | peak memory, as a share of the file (at most %g) |" % (CPU_S, SHARE)
    yield "|---|---|---|---|"
    for isa in measure.usable_isas():
        command = [paths.LAMBENT, "-q", path, "-s", "1024", "--samples", "1", "--normals", "facet", "--isa", isa, "-o", picture]
        share = measure.peak_bytes(command) / os.path.getsize(path)
        taken = [measure.whole_process(command, picture) for _ in range(RUNS)]
        cpu = statistics.median(t.cpu_ms for t in taken) / 1e3
        reached.append(cpu <= CPU_S and share <= SHARE)
        yield "| `%s` | %.1f s | %.1f s | %.2f |" % (isa, statistics.median(t.wall_ms for t in taken) / 1e3, cpu, share)


def main():
    os.makedirs(paths.PICTURES, exist_ok=True)
    if shutil.disk_usage(paths.OUT).free < DISK or free_memory() < MEMORY:
        sys.exit("large.py: expected %.0f GB of free disk and %.0f GB of available memory" % (DISK / 1e9, MEMORY / 1e9))
    path = scenes.model(TRIANGLES, "stl")
    lines, reached = [], []
    try:
        for line in table(path, reached):
            print(line, flush=True)
            lines.append(line)
    finally:
        os.remove(path)
    if "--write" in sys.argv:
        made_part.write(PAGE, "large", "large.py", lines)
    return 0 if all(reached) else 1


if __name__ == "__main__":
    sys.exit(main())
