"""whole.py: compares a whole lambent process, model file to PNG, with F3D drawing the same file with the same camera. Each file has two rows: one
with the same work as F3D (the file's own normals or facets, one sample, no occlusion; by default, Debian's F3D smooths neither faces nor edges and
computes no occlusion), and one with Lambent's default pictures (smooth normals, several samples, occlusion).

Each uses its own studio lights (F3D: VTK's light kit), both write 1024x1024 PNG. F3D uses a running display: starting the X server and its CPU time
are not counted. The pictures stay in build-bench/pictures for inspection."""
import functools
import os
import shutil
import statistics
import subprocess

import measure
import paths
import scenes

SIZE = 1024
F3D_WORK = ("--samples", "1", "--ao", "off")  # F3D smooths no edges and computes no occlusion by default


class Display:
    """An X server without a screen, on the first free number, that F3D has drawn on."""

    def __init__(self):
        self.server = None

    @staticmethod
    def require():
        if not (shutil.which("f3d") and shutil.which("Xvfb")):
            raise measure.Absent("f3d or Xvfb is not installed (packages.txt, group bench)")

    def open(self):
        self.require()
        self.start()
        measure.output(["f3d", scenes.model(1000), "--dry-run", "--quiet", "--output=" + picture("try-f3d")])

    def f3d(self, command, written):
        """The time that F3D used. If it crashes on a display that was used before, it runs once more on a new one."""
        try:
            return measure.whole_process(command, written)
        except measure.Failed:
            self.close()
            self.open()
            return measure.whole_process(command, written)

    def start(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1100x24", "-nolisten", "tcp", "-noreset"],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        # Reads up to the line's end: the server exits if its number is not read completely.
        with os.fdopen(read) as told:
            number = told.readline().strip()
        if not number:
            raise measure.Failed("Xvfb does not start")
        os.environ["DISPLAY"] = ":" + number

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.wait()
            self.server = None


def f3d_command(path, report, picture, size):
    """F3D with Lambent's fitted camera."""
    def numbers(vector):
        return ",".join("%.9g" % x for x in vector)
    camera = report["camera"]
    return ["f3d", path, "--dry-run", "--quiet", "--output=" + picture, "--resolution=%d,%d" % (size, size), "--no-background",
            "--camera-position=" + numbers(camera["eye"]), "--camera-focal-point=" + numbers(camera["target"]),
            "--camera-view-up=" + numbers(camera["up"]), "--camera-view-angle=%.9g" % camera["fovy_deg"]]


def picture(name):
    return os.path.join(paths.PICTURES, name + ".png")


def carries_normals(path):
    """Whether the file has normals of its own, for each vertex."""
    with open(path, "rb") as file:
        if path.endswith(".ply"):
            return b"property float nx" in file.read(4096)
        return path.endswith(".obj") and any(line.startswith(b"vn ") for line in file)


def whole(name, path, isas, display, seconds, size=SIZE):
    """Measures one file, which the function `path` generates or finds: Lambent with each instruction set, for F3D's work and with its defaults, and
    F3D. Returns the results of the two rows:
    {same_work: result}."""
    display.require()
    path = path()
    file_name = name.replace(" ", "-").replace(",", "")
    ours, theirs = picture(file_name + "-lambent"), picture(file_name + "-f3d")
    options = {True: [*F3D_WORK] + ([] if carries_normals(path) else ["--normals", "facet"]), False: []}

    def command(same_work, isa):
        return [paths.LAMBENT, "-q", path, "-s", str(size), *options[same_work], "--isa", isa, "-o", ours]
    # Runs outside the rounds, to get the steps and the time without the encoder, because a report
    # takes time.
    reports = {same_work: [measure.lambent(path, "-s", size, *work, "-o", ours) for _ in range(3)] for same_work, work in options.items()}
    contestants = {(same_work, isa): (lambda same_work=same_work, isa=isa: measure.whole_process(command(same_work, isa), ours))
                   for same_work in options for isa in isas}
    peer = f3d_command(path, reports[True][0], theirs, size)
    contestants["f3d"] = lambda: display.f3d(peer, theirs)
    taken = measure.in_turn(contestants, seconds)

    def row(same_work):
        of_row = {isa: taken[same_work, isa] for isa in isas}
        wall = {key: [t.wall_ms for t in rounds] for key, rounds in dict(of_row, f3d=taken["f3d"]).items()}
        cpu = {key: [t.cpu_ms for t in rounds] for key, rounds in dict(of_row, f3d=taken["f3d"]).items()}
        report = reports[same_work][0]
        return {"file_bytes": os.path.getsize(path), "triangles": report["model"]["triangles"], "samples": report["image"]["samples"],
                "options": options[same_work], "size": size,
                "ms": {key: measure.spread(t) for key, t in wall.items()}, "cpu_ms": {key: measure.spread(t) for key, t in cpu.items()},
                "ratio": {isa: measure.ratio(wall["f3d"], wall[isa]) for isa in isas},
                "cpu_ratio": {isa: measure.ratio(cpu["f3d"], cpu[isa]) for isa in isas}, "steps_ms": report["times_ms"],
                "besides_encoder_ms": statistics.median(r["times_ms"]["total"] - r["times_ms"]["encode"] for r in reports[same_work]),
                "peer": "F3D"}
    return {same_work: row(same_work) for same_work in options}


def real(path):
    """A file in the folder LAMBENT_MODELS."""
    found = os.path.normpath(os.path.join(paths.REAL_MODELS, path))
    if not os.path.exists(found):
        raise measure.Failed("%s is not in the folder that LAMBENT_MODELS names" % found)
    return found


REAL = {"koala": "obj/koala/koala.obj", "koala.stl": "stl/derived/koala.stl", "gallery": "ply/derived/gallery.ply"}


def small_model(name):
    """A model that Lambent and F3D read: from the repository, generated, or from LAMBENT_MODELS."""
    if name == "spot":
        return os.path.join(paths.EXAMPLES, "spot.obj")
    if name == "teapot":
        made = os.path.join(paths.MODELS, "teapot.obj")
        if not os.path.exists(made):
            os.makedirs(paths.MODELS, exist_ok=True)
            measure.output([paths.LAMBENT, "shape", "teapot", "-q", "-o", made])
        return made
    return real(REAL[name])


def both(label, targets, path, isas, display, seconds, size=SIZE):
    """The two rows of a file and their targets, measured together when the first one is needed; `path` is a function."""
    measured = functools.cache(lambda: whole(label, path, isas, display, seconds, size))
    yield label, targets[0], lambda: measured()[True]
    yield label + ", default", targets[1], lambda: measured()[False]


def rows(isas, display, full):
    """(name, target, function that measures) of the rows of whole processes."""
    for name in ("spot", "teapot"):
        yield from both("whole " + name, (30, 22), lambda name=name: small_model(name), isas, display, 3)
    for triangles, word, targets, seconds in ((1000000, "1M", ((27, 16), (25, 14), (30, 22)), 4), (10000000, "10M", ((15, None), (8, None), (20, None)), 6)):
        for kind, of_both in zip(("ply", "stl", "obj"), targets):
            yield from both("whole %s %s" % (word, kind), of_both, lambda triangles=triangles, kind=kind: scenes.model(triangles, kind),
                            isas, display, seconds)
    if not full:
        return
    for size in (256, 1024):
        for name in REAL if paths.REAL_MODELS else ():
            yield from both("whole %s %d px" % (name, size), (None, None), lambda name=name: small_model(name), isas, display, 6, size)
        for triangles in (10000, 100000, 1000000, 10000000):
            for kind in ("ply", "stl", "obj"):
                if size == 1024 and triangles >= 1000000:
                    continue  # above
                yield from both("whole %d %s %d px" % (triangles, kind, size), (None, None),
                                lambda triangles=triangles, kind=kind: scenes.model(triangles, kind), isas, display, 6, size)
