"""whole.py: compares a whole lambent process, model file to PNG, with F3D drawing the same file with the same camera.

Each uses its own studio lights (F3D: VTK's light kit), both write 1024x1024 PNG. F3D runs on a running display: starting the X
server is not counted. The pictures stay in build-bench/pictures for inspection."""
import os
import shutil
import statistics
import subprocess

import measure
import paths
import scenes

SIZE = 1024


class Display:
    """An X server without a screen, on the first free number, that F3D has drawn on."""

    def __init__(self):
        self.server = None

    def open(self):
        if not (shutil.which("f3d") and shutil.which("Xvfb")):
            raise measure.Failed("f3d or Xvfb is not installed (packages.txt, group bench)")
        self.start()
        measure.output(["f3d", scenes.model(1000), "--dry-run", "--quiet", "--output=" + picture("try-f3d")])

    def f3d_ms(self, command, written):
        """F3D's time. If it crashes on a display used before, it runs once more on a new one."""
        try:
            return measure.wall_ms(command, written)
        except measure.Failed:
            self.close()
            self.open()
            return measure.wall_ms(command, written)

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
    """F3D with lambent's fitted camera."""
    def numbers(vector):
        return ",".join("%.9g" % x for x in vector)
    camera = report["camera"]
    return ["f3d", path, "--dry-run", "--quiet", "--output=" + picture, "--resolution=%d,%d" % (size, size), "--no-background",
            "--camera-position=" + numbers(camera["eye"]), "--camera-focal-point=" + numbers(camera["target"]),
            "--camera-view-up=" + numbers(camera["up"]), "--camera-view-angle=%.9g" % camera["fovy_deg"]]


def picture(name):
    return os.path.join(paths.PICTURES, name + ".png")


def whole(name, path, samples, isas, display, seconds, size=SIZE):
    """One file: lambent with each instruction set, also with the other number of samples, and F3D. `samples` decides."""
    file_name = name.replace(" ", "-").replace(",", "")
    other = 4 if samples == 1 else 1

    def ours(isa, count):
        return [paths.LAMBENT, "-q", path, "-s", str(size), "--samples", str(count), "--isa", isa, "-o", picture(file_name + "-lambent")]
    report = measure.lambent(path, "-s", size, "--samples", samples, "-o", picture(file_name + "-lambent"))
    commands = {isa: ours(isa, samples) for isa in isas}
    commands["%d samples" % other] = ours(isas[0], other)
    contestants = {key: (lambda c=command: measure.wall_ms(c, picture(file_name + "-lambent"))) for key, command in commands.items()}
    theirs = picture(file_name + "-f3d")
    peer = f3d_command(path, report, theirs, size)
    contestants["f3d"] = lambda: display.f3d_ms(peer, theirs)
    taken = measure.in_turn(contestants, seconds)
    # The time without the encoder, from separate runs, since a report costs time.
    besides = [r["times_ms"]["total"] - r["times_ms"]["encode"] for r in
               (measure.lambent(path, "-s", size, "--samples", samples, "-o", picture(file_name + "-lambent")) for _ in range(3))]
    return {"file_bytes": os.path.getsize(path), "triangles": report["model"]["triangles"], "samples": samples, "size": size,
            "ms": {key: measure.spread(t) for key, t in taken.items()},
            "ratio": {key: measure.ratio(taken["f3d"], t) for key, t in taken.items() if key != "f3d"},
            "steps_ms": report["times_ms"], "besides_encoder_ms": statistics.median(besides), "peer": "F3D"}


def small_model(name):
    """A real model from the collection next to the checkout, readable by lambent and F3D."""
    path = os.path.normpath(os.path.join(paths.REAL_MODELS, {"spot": "obj/spot/spot_triangulated.obj", "teapot": "obj/teapot/teapot.obj",
                                                             "koala": "obj/koala/koala.obj", "koala.stl": "stl/derived/koala.stl",
                                                             "gallery": "ply/derived/gallery.ply"}[name]))
    if not os.path.exists(path):
        raise measure.Failed("%s is not here; LAMBENT_MODELS names the folder of models" % path)
    return path


def rows(isas, display, full):
    """(name, target, function that measures) of the rows of whole processes."""
    for name in ("spot", "teapot"):
        yield "whole " + name, 30, lambda name=name: whole("whole " + name, small_model(name), 4, isas, display, 4)
    for triangles, word, targets, seconds in ((1000000, "1M", (30, 15, 25), 5), (10000000, "10M", (15, 8, 20), 8)):
        for kind, target in zip(("ply", "stl", "obj"), targets):
            yield ("whole %s %s" % (word, kind), target, lambda triangles=triangles, kind=kind, word=word, seconds=seconds:
                   whole("whole %s %s" % (word, kind), scenes.model(triangles, kind), 1, isas, display, seconds))
    if not full:
        return
    for size in (256, 1024):
        for name in ("koala", "koala.stl", "gallery"):
            label = "whole %s %d px" % (name, size)
            yield label, None, lambda label=label, name=name, size=size: whole(label, small_model(name), 4, isas, display, 6, size)
        for triangles in (10000, 100000, 1000000, 10000000):
            for kind in ("ply", "stl", "obj"):
                if size == 1024 and triangles >= 1000000:
                    continue  # above
                label = "whole %d %s %d px" % (triangles, kind, size)
                yield label, None, lambda label=label, triangles=triangles, kind=kind, size=size: whole(
                    label, scenes.model(triangles, kind), 1, isas, display, 6, size)
