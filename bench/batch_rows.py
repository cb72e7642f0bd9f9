"""batch_rows.py: rows of `lambent batch`: the processor time of a model among many, with its journal, against a process of F3D that draws the
same, and against `lambent -j 1` for that model alone."""
import functools
import json
import os
import shutil
import statistics
import subprocess
import time

import measure
import paths
import whole

# Each row gives the options, the size, the required factor of F3D's processor time, and the models. A run takes seconds on four
# processors. With a total of 0.2 s, a tenth would be the start of the program and the last models, when some workers are idle.
ROWS = {"batch 1024 px, no occlusion": (["--samples", "4", "--ao", "off"], 1024, 25, 256), "batch 1024 px": (["--samples", "4"], 1024, 12, 256),
        "batch 256 px": (["--samples", "8"], 256, 80, 1024)}


def folder_of_models(count):
    """One model with many names, so that Lambent reads and draws every file."""
    source, folder = whole.small_model("spot"), os.path.join(paths.MODELS, "batch-%d" % count)
    if not os.path.exists(folder):
        shutil.rmtree(folder + ".unfinished", ignore_errors=True)
        os.makedirs(folder + ".unfinished")
        for i in range(count):
            shutil.copy(source, os.path.join(folder + ".unfinished", "spot_%04d.obj" % i))
        os.rename(folder + ".unfinished", folder)
    return folder


def busy(taken, others_s, workers):
    """The fraction of the available processor time that a run used, excluding the time used by other processes."""
    return taken.cpu_ms / 1e3 / max(taken.wall_ms / 1e3 * workers - others_s, taken.cpu_ms / 1e3)


def batch(label, options, size, models, isas, display, seconds=6):
    display.require()
    folder, out = folder_of_models(models), os.path.join(paths.PICTURES, "batch")
    one, name = os.path.join(folder, "spot_0000.obj"), label.replace(" ", "-").replace(",", "")
    alone, theirs = whole.picture(name + "-alone"), whole.picture(name + "-f3d")
    report = measure.lambent(one, "-s", size, *options, "-o", alone)
    workers = len(os.sched_getaffinity(0))
    shares = {isa: [] for isa in isas}

    def run(isa):
        shutil.rmtree(out, ignore_errors=True)
        before = measure.busy_s()
        taken = measure.process([paths.LAMBENT, "batch", folder, "-q", "-s", str(size), *options, "--isa", isa, "-o", out + "/"], alone + ".stderr")
        others_s = measure.busy_s() - before - taken.cpu_ms / 1e3 if workers == os.cpu_count() else 0
        shares[isa].append(busy(taken, max(others_s, 0), workers))
        return taken
    contestants = {("batch", isa): (lambda isa=isa: run(isa)) for isa in isas}
    contestants.update({("alone", isa): (lambda isa=isa: measure.whole_process(
        [paths.LAMBENT, "-q", one, "-j", "1", "-s", str(size), *options, "--isa", isa, "-o", alone], alone)) for isa in isas})
    contestants["f3d"] = functools.partial(display.f3d, whole.f3d_command(one, report, theirs, size), theirs)
    taken = measure.in_turn(contestants, seconds)
    peer = [t.cpu_ms for t in taken["f3d"]]
    ours = {isa: [t.cpu_ms / models for t in taken["batch", isa]] for isa in isas}
    single = {isa: [t.cpu_ms for t in taken["alone", isa]] for isa in isas}
    factor = {isa: measure.ratio(peer, ours[isa]) for isa in isas}
    return {"models": models, "workers": workers, "options": options, "size": size, "samples": report["image"]["samples"], "peer": "F3D",
            "cpu_ms": {**{isa: measure.spread(t) for isa, t in ours.items()}, **{isa + ", alone": measure.spread(t) for isa, t in single.items()},
                       "f3d": measure.spread(peer)},
            "ms": {isa: measure.spread([t.wall_ms / models for t in taken["batch", isa]]) for isa in isas},
            "ratio": factor, "cpu_ratio": factor,  # of processor time: one process of F3D uses other numbers of threads
            "alone_ratio": {isa: measure.ratio(ours[isa], single[isa]) for isa in isas},
            "busy": {isa: statistics.median(shares[isa]) for isa in isas}}


def worker(jobs=100):
    """Milliseconds per job of `batch --jobs - --isolate -j 1` for a small model, for each number of jobs in flight."""
    model, out = os.path.join(paths.ROOT, "tests", "models", "cube.obj"), os.path.join(paths.PICTURES, "worker.png")
    command = [paths.LAMBENT, "batch", "--jobs", "-", "--isolate", "-j", "1", "-q", "-s", "64", "--allow-path", paths.ROOT, "--allow-path", paths.PICTURES]

    def run(in_flight):
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            def send(job):
                process.stdin.write(json.dumps({"id": job, "model": model, "output": out}).encode() + b"\n")
                process.stdin.flush()
            start, sent = 0, 0
            for answered in range(-1, jobs):  # the first job warms up
                while sent < jobs + 1 and sent - answered <= (in_flight if answered >= 0 else 1):
                    send(sent)
                    sent += 1
                if json.loads(process.stdout.readline())["exit"]:
                    raise RuntimeError("a job failed")
                start = start or time.perf_counter()
        return (time.perf_counter() - start) * 1e3 / jobs
    taken = measure.in_turn({n: (lambda n=n: run(n)) for n in (1, 2, 4, 8, 16)}, 10)
    ms = {"%d in flight" % n: measure.spread(t) for n, t in taken.items()}
    return {"jobs": jobs, "ms": ms, "over_ms": max(ms.values(), key=lambda m: m["median"])}


def rows(isas, display):
    """(name, target, function that measures)."""
    for label, (options, size, target, models) in ROWS.items():
        yield label, target, functools.partial(batch, label, options, size, models, isas, display)
