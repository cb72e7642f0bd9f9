"""batch_rows.py: rows of `lambent batch`: the processor time of a model among many, with its journal, against a process of F3D that draws the
same, and against `lambent -j 1` for that model alone."""
import functools
import os
import shutil
import statistics

import measure
import paths
import whole

MODELS = 64
# What is drawn: options, size, and the least factor of F3D's processor time.
ROWS = {"batch 1024 px, no occlusion": (["--samples", "4", "--ao", "off"], 1024, 20), "batch 1024 px": (["--samples", "4"], 1024, 12),
        "batch 256 px": (["--samples", "8"], 256, 40)}


def folder_of_models():
    """Links to one real model under many names, so that every file is read and drawn."""
    source, folder = whole.small_model("spot"), os.path.join(paths.OUT, "models", "batch")
    if not os.path.exists(folder):
        os.makedirs(folder + ".unfinished", exist_ok=True)
        for i in range(MODELS):
            shutil.copy(source, os.path.join(folder + ".unfinished", "spot_%02d.obj" % i))
        os.rename(folder + ".unfinished", folder)
    return folder


def batch(label, options, size, isas, display, seconds=4):
    folder, out = folder_of_models(), os.path.join(paths.PICTURES, "batch")
    one, name = os.path.join(folder, "spot_00.obj"), label.replace(" ", "-").replace(",", "")
    alone, theirs = whole.picture(name + "-alone"), whole.picture(name + "-f3d")
    report = measure.lambent(one, "-s", size, *options, "-o", alone)
    workers = len(os.sched_getaffinity(0))

    def run(isa):
        shutil.rmtree(out, ignore_errors=True)
        return measure.process([paths.LAMBENT, "batch", folder, "-q", "-s", str(size), *options, "--isa", isa, "-o", out + "/"], alone + ".stderr")
    contestants = {("batch", isa): (lambda isa=isa: run(isa)) for isa in isas}
    contestants.update({("alone", isa): (lambda isa=isa: measure.whole_process(
        [paths.LAMBENT, "-q", one, "-j", "1", "-s", str(size), *options, "--isa", isa, "-o", alone], alone)) for isa in isas})
    contestants["f3d"] = functools.partial(display.f3d, whole.f3d_command(one, report, theirs, size), theirs)
    taken = measure.in_turn(contestants, seconds)
    peer = [t.cpu_ms for t in taken["f3d"]]
    ours = {isa: [t.cpu_ms / MODELS for t in taken["batch", isa]] for isa in isas}
    single = {isa: [t.cpu_ms for t in taken["alone", isa]] for isa in isas}
    factor = {isa: measure.ratio(peer, ours[isa]) for isa in isas}
    return {"models": MODELS, "workers": workers, "options": options, "size": size, "samples": report["image"]["samples"], "peer": "F3D",
            "cpu_ms": {**{isa: measure.spread(t) for isa, t in ours.items()}, **{isa + ", alone": measure.spread(t) for isa, t in single.items()},
                       "f3d": measure.spread(peer)},
            "ms": {isa: measure.spread([t.wall_ms / MODELS for t in taken["batch", isa]]) for isa in isas},
            "ratio": factor, "cpu_ratio": factor,  # of processor time: one process of F3D uses other numbers of threads
            "alone_ratio": {isa: measure.ratio(ours[isa], single[isa]) for isa in isas},
            "busy": {isa: statistics.median(t.cpu_ms / t.wall_ms / workers for t in taken["batch", isa]) for isa in isas}}


def rows(isas, display):
    """(name, target, function that measures)."""
    for label, (options, size, target) in ROWS.items():
        yield label, target, functools.partial(batch, label, options, size, isas, display)
