#!/usr/bin/env python3
"""run.py: measures lambent as a whole process beside F3D (when it is installed), alternating, medians and ratios.

Writes bench/results/DATE.json. Times are wall-clock seconds; a ratio is the median of the pairs' ratios, so that a machine whose
speed drifts does not decide it. BENCH=full adds the files of ten million triangles."""
import datetime
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time

import models

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LAMBENT = os.path.join(ROOT, "build", "lambent")
SHARED = os.environ.get("LAMBENT_MODELS", os.path.join(ROOT, "..", "shared", "models"))
OUT = os.path.join(ROOT, "build-bench")


def seconds(command):
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode:
        raise RuntimeError("%s: exit %d: %s" % (" ".join(command), done.returncode, done.stderr.decode()[-300:]))
    return time.perf_counter() - start


def measure(ours, peer, runs):
    """Alternating runs after a warm-up of each: lists of seconds."""
    mine, theirs = [], []
    seconds(ours)
    if peer:
        seconds(peer)
    for _ in range(runs):
        mine.append(seconds(ours))
        if peer:
            theirs.append(seconds(peer))
    return mine, theirs


def rows():
    for name, path in (("spot", "obj/spot/spot_quadrangulated.obj"), ("koala", "obj/koala/koala.obj"),
                       ("koala", "stl/derived/koala.stl"), ("gallery", "ply/derived/gallery.ply")):
        path = os.path.join(SHARED, path)
        if os.path.exists(path):
            yield "%s.%s" % (name, path.rsplit(".", 1)[1]), path
        else:
            print("left out: %s is not here" % path)
    for triangles in [100000, 1000000] + ([10000000] if os.environ.get("BENCH") == "full" else []):
        for kind, path in models.make(os.path.join(OUT, "models"), triangles).items():
            yield "%d triangles, %s" % (triangles, kind), path


def main():
    f3d = shutil.which("f3d") and shutil.which("xvfb-run")
    os.makedirs(OUT, exist_ok=True)
    display = None
    if f3d:
        # One display for all runs: starting the X server is not F3D's time.
        display = subprocess.Popen(["Xvfb", ":77", "-screen", "0", "1280x1100x24"], stderr=subprocess.DEVNULL)
        os.environ["DISPLAY"] = ":77"
        time.sleep(1)
    else:
        print("f3d or xvfb is not installed: no ratios")
    table = []
    try:
        for name, path in rows():
            ours = [LAMBENT, "-q", path, "-o", os.path.join(OUT, "ours.png")]
            peer = ["f3d", path, "--output=" + os.path.join(OUT, "f3d.png"), "--resolution=1024,1024"] if f3d else None
            mine, theirs = measure(ours, peer, 5)
            row = {"name": name, "lambent_s": statistics.median(mine), "lambent_runs_s": mine}
            if theirs:
                row.update(f3d_s=statistics.median(theirs), f3d_runs_s=theirs,
                           ratio=statistics.median(b / a for a, b in zip(mine, theirs)))
            table.append(row)
            print("%-28s lambent %8.1f ms" % (name, row["lambent_s"] * 1e3) +
                  ("   f3d %8.1f ms   %5.1f times" % (row["f3d_s"] * 1e3, row["ratio"]) if theirs else ""), flush=True)
    finally:
        if display:
            display.terminate()
    os.makedirs(os.path.join(ROOT, "bench", "results"), exist_ok=True)
    version = subprocess.run([LAMBENT, "--version"], stdout=subprocess.PIPE, text=True).stdout.strip()
    report = {"date": datetime.date.today().isoformat(), "machine": platform.processor() or platform.machine(),
              "processors": os.cpu_count(), "load": os.getloadavg(), "version": version, "size": "1024x1024", "samples": 4, "rows": table}
    path = os.path.join(ROOT, "bench", "results", report["date"] + ".json")
    with open(path, "w") as file:
        json.dump(report, file, indent=1)
        file.write("\n")
    print("written: " + os.path.relpath(path, ROOT))


if __name__ == "__main__":
    sys.exit(main())
