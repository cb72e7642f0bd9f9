"""steps.py: measures single steps (reading, PNG, the lighting step, memory, start-up) and the limits of this machine."""
import json
import os

import measure
import paths
import scenes


def read_ms(path, isa="auto"):
    """lambent's time from a file's name to usable positions and indices, and to normals (welding and computing)."""
    times = measure.lambent("-s", 16, "--samples", 1, "--isa", isa, "-o", os.path.join(paths.PICTURES, "read.png"), path)["times_ms"]
    return times["read"], times["prepare"]


def reading(kind, isas):
    """1 M and 10 M triangles, from the page cache, each in a fresh process; the slower rate of the two decides."""
    result = {"rates": {}, "ms": {}, "ratio": {}, "peer": "Assimp"}
    for triangles, word, seconds in ((1000000, "1M", 4), (10000000, "10M", 6)):
        path = scenes.model(triangles, kind)
        size = os.path.getsize(path)
        prepare = []

        def ours():
            read, made = read_ms(path)
            prepare.append(made)
            return read
        contestants = {"lambent": ours}
        for other in ("touch", "copy", "assimp"):
            contestants[other] = lambda other=other: float(measure.output([paths.program("reading"), other, path]))
        taken = measure.in_turn(contestants, seconds, most_rounds=7)
        result["ms"].update({"%s, %s" % (word, key): measure.spread(t) for key, t in taken.items()})
        result["ms"]["%s, normals" % word] = measure.spread(prepare[1:])
        result["rates"].update({"%s, %s" % (word, key): measure.spread([size / 1e6 / ms for ms in t]) for key, t in taken.items()})
        result["ratio"][word] = measure.ratio(taken["assimp"], taken["lambent"])
    return result


def png():
    """A lit picture of the bumpy sphere, 1024x1024, RGBA."""
    picture = os.path.join(paths.PICTURES, "lit.png")
    measure.lambent("-s", 1024, "--zoom", 1.2, "-o", picture, scenes.model(1000000))
    return {"encoders": json.loads(measure.output([paths.program("png"), picture, "25"])), "peer": "libpng level 1"}


# Floating-point operations of one point light with attenuation at one point, Blinn-Phong, counted in src/core/lighting and
# base/math/functions.h. Each + - x, comparison, selection and division counts as one. Work that a compiler can move out of the
# loop over the lights, and integer work on a float's bits, is not counted.
OPERATIONS = {"vector to the light, its square and inverse root": 3 + 5 + 13, "direction, distance": 3 + 1, "attenuation": 7 + 2,
              "n.l, clamped, gate": 5 + 2 + 1 + 1, "l + v, n.(l + v), its length": 3 + 5 + 5 + 13 + 1,
              "logarithm": 1 + 1 + 1 + 21 + 4 + 3 + 2, "times the shininess": 4, "power of two": 1 + 2 + 2 + 11 + 1 + 2,
              "gate of the highlight": 1, "two products of colour, two sums": 2 + 6 + 6}
# Operations of the point itself, independent of the lights: perspective-correct weights, position and normal, transformation to
# eye space, the sum.
POINT_OPERATIONS = {"weights": 12 + 9 + 2 + 3 + 3 + 3, "position": 12 + 18, "normal": 12 + 21, "to the eye": 24, "tint and sum": 6 + 12}


def lighting_step(isas):
    """The lighting step of a frame (fetching and interpolating attributes, and the equations of 16 lights that reach every visible point), as counted
    operations for evaluated lights, compared with the processor's rate without fused operations."""
    count, of_point = sum(OPERATIONS.values()), sum(POINT_OPERATIONS.values())
    rates = json.loads(measure.output([paths.program("arithmetic")]))
    scene = scenes.Scene("lighting", scenes.model(100000), scenes.from_the_front(16))
    picture = os.path.join(paths.PICTURES, "lighting.ppm")
    threads = len(os.sched_getaffinity(0))
    result = {"operations": count, "arithmetic": rates, "shares": {}, "rates": {}, "threads": threads, "peer": "multiply and add, apart"}

    def per_second(isa):
        report = measure.lambent("--repeat", 15, "--isa", isa, "-j", threads, "-o", picture, scene.json)
        counts = report["counts"]
        return (counts["lights_evaluated"] * count + counts["points_lit"] * of_point) / report["times_ms"]["steps"]["lighting"] / 1e6
    taken = measure.in_turn({isa: (lambda isa=isa: per_second(isa)) for isa in isas if isa in rates}, 4)
    # The machine's rate is measured again between the rounds; the higher rate counts.
    again = json.loads(measure.output([paths.program("arithmetic")]))
    for isa, values in taken.items():
        peak = max(rates[isa]["unfused"], again[isa]["unfused"]) * threads
        result["shares"][isa] = measure.spread([v / peak for v in values])
        result["rates"][isa] = measure.spread(values)
    if not result["shares"]:
        raise measure.Failed("no instruction set here whose rate is known")
    return result


def memory_of_10m(isas):
    path = scenes.model(10000000)
    picture = os.path.join(paths.PICTURES, "memory.png")
    size = os.path.getsize(path)
    peaks = {isa: measure.peak_bytes([paths.LAMBENT, "-q", path, "--samples", 1, "--isa", isa, "-o", picture]) for isa in isas}
    peaks["4 samples"] = measure.peak_bytes([paths.LAMBENT, "-q", path, "-o", picture])
    return {"bytes": peaks, "file_bytes": size, "ratio": {key: measure.spread([p / size]) for key, p in peaks.items()}, "peer": "the file"}


def memory_of_threads():
    """The peak with 16 threads beside 2, at default settings. Every thread has its own scratch memory."""
    picture = os.path.join(paths.PICTURES, "memory.png")
    models = {"teapot": "teapot", "1M ply": scenes.model(1000000), "1M stl": scenes.model(1000000, "stl")}
    peaks = {name: {threads: measure.peak_bytes([paths.LAMBENT, "-q", model, "-j", threads, "-s", 1024, "-o", picture]) for threads in (2, 16)}
             for name, model in models.items()}
    return {"bytes": peaks, "ratio": {name: measure.spread([peak[16] / peak[2]]) for name, peak in peaks.items()}, "peer": "2 threads"}


def start_up():
    """`lambent --version` (reads every option table and writes one line), compared with a program that does nothing."""
    taken = measure.in_turn({"lambent": lambda: measure.process([paths.LAMBENT, "--version"]).wall_ms,
                             "true": lambda: measure.process(["/bin/true"]).wall_ms}, 3, least_rounds=50, most_rounds=400)
    over = [a - b for a, b in zip(taken["lambent"], taken["true"])]
    return {"ms": {key: measure.spread(t) for key, t in taken.items()}, "over_ms": measure.spread(over), "peer": "/bin/true",
            "opengl_or_gui_libraries": loaded_graphics()}


def loaded_graphics():
    """Libraries of OpenGL or windows that the program is linked with; there must be none."""
    names = measure.output(["ldd", paths.LAMBENT])
    return [line.split()[0] for line in names.splitlines() if any(word in line for word in ("libGL", "libEGL", "libgtk", "libX11", "wayland"))]


def limits():
    """The speed of memory (memory.c) and the cost of starting a process."""
    return {"arithmetic": json.loads(measure.output([paths.program("arithmetic")])),
            "memory_gb_s": json.loads(measure.output([paths.program("memory")])),
            "process_ms": measure.spread([measure.process(["/bin/true"]).wall_ms for _ in range(100)])}


def distance(isa, memory, process_ms):
    """Each step of drawing the 1 M PLY, with its minimum on this machine: [(step, ms, minimum ms, reason)]."""
    path, width = scenes.model(1000000), 1024
    reports = [measure.lambent("-s", width, "--samples", 1, "--isa", isa, "-o", os.path.join(paths.PICTURES, "steps.png"), path)
               for _ in range(5)]
    report = sorted(reports, key=lambda r: r["times_ms"]["total"])[2]
    times, steps, vertices = report["times_ms"], report["times_ms"]["steps"], report["model"]["vertices"]
    triangles, size = report["model"]["triangles"], os.path.getsize(path)
    read, copy, touch = (memory[name + "_2"] * 1e6 for name in ("read", "copy", "first_touch_2m"))  # bytes per millisecond
    kept = 12 * vertices + 12 * triangles
    pixels = width * width
    return [
        ("start", process_ms, process_ms, "a process that does nothing"),
        ("read", times["read"], size / read + kept / touch, "the file read once, positions and indices written to fresh memory"),
        ("normals", times["prepare"] + steps["normals"], kept / read, "positions and indices read once"),
        ("camera", times["camera"], 12 * vertices / read, "positions read once"),
        ("vertices", steps["vertices"], 12 * vertices / read + 16 * vertices / touch, "positions read once, projected ones written once"),
        ("flatten", steps["flatten"], 0, "lists of objects and lights; no triangle is looked at"),
        ("triangles", steps["triangles"], (12 * triangles + 16 * vertices) / read, "indices and projected vertices read once"),
        ("coverage", steps["coverage"], 0, "arithmetic, in tiles that stay in the cache"),
        ("lighting", steps["lighting"], 0, "arithmetic: the row of the lighting step"),
        ("resolve", steps["resolve"], 4 * pixels / touch, "the picture written once"),
        ("encode", times["encode"], 4 * pixels / read + report["image"]["bytes"] / copy, "the picture read once, the file written"),
    ]
