"""shadow_rows.py: measures what shadows and a ground cost: whole processes with two threads, beside the same picture without occlusion and shadows, in
turn. bench/rays.c measures the hierarchy beside Embree's."""
import os

import measure
import paths
import scenes

PLAIN = ["--ao", "off", "--cavity", "off"]


def costs(path, size, words, isas):
    path, picture = path(), os.path.join(paths.PICTURES, "shadow.png")
    command = [paths.LAMBENT, "-q", path, "-s", str(size), "--threads", "2", "-o", picture]
    contestants = {(isa, of): lambda isa=isa, more=more: measure.whole_process([*command, "--isa", isa, *more], picture)
                   for isa in isas for of, more in (("with", words), ("plain", PLAIN))}
    taken = {key: [run.wall_ms for run in runs] for key, runs in measure.in_turn(contestants, 6).items()}
    return {"size": size, "options": words, "ms": {name: measure.spread(taken[isas[0], of]) for of, name in (("with", " ".join(words)), ("plain", " ".join(PLAIN)))},
            "ratio": {isa: measure.ratio(taken[isa, "with"], taken[isa, "plain"]) for isa in isas}}


def rows(isas):
    """(name, target, function that measures)."""
    def million():
        return scenes.model(1000000, "ply")

    def spot():
        return os.path.join(paths.EXAMPLES, "spot.obj")
    for name, target, path, size, words in (("shadows 1M ply", 6, million, 512, ["--shadows"]), ("ground 1M ply", 8, million, 512, ["--ground"]),
                                            ("ground spot", 3, spot, 1024, ["--ground"])):
        yield name, target, lambda path=path, size=size, words=words: costs(path, size, words, isas)
