"""frames.py: compares one frame (scene loaded, picture not written) with OpenGL on Mesa's llvmpipe with all processors: our
OpenGL device, and the plain program bench-opengl with its lights in a loop or as literals, with and without a depth pass first.
The models of these rows are closed, so both sides also draw with back faces culled, which does not change the picture. The
fastest of each side counts."""
import json
import math
import os
import statistics

import measure
import paths
import scenes

REPEAT = 7  # frames of one process; their median is one sample


def picture(name, end="png"):
    return os.path.join(paths.PICTURES, name.replace(" ", "-") + "." + end)


def ours_ms(scene, *options, frames=REPEAT):
    return measure.lambent("--repeat", frames, *options, "-o", picture(scene.name, "ppm"), scene.json)["times_ms"]["frame"]


def opengl(scene, form, frames=REPEAT, save=False):
    command = [paths.program("opengl"), scene.text, *form, "--frames", str(frames), "--seconds", "2"]
    if save:
        command += ["--picture", picture(scene.name + "-opengl", "ppm")]
    return json.loads(measure.output(command))


def has_gl_device():
    """Whether this lambent has the OpenGL device."""
    try:
        measure.lambent("--device", "gl", "-s", 16, "-o", picture("try"), "sphere")
        return True
    except measure.Failed:
        return False


def peers(scene, gl_device):
    """Tries each OpenGL variant of the scene once: {name: ms}, the driver's name, and the difference of its picture from ours."""
    forms = {"loop": ["loop"], "written": ["written"]}
    if scene.shading == "flat":
        forms.update({name + ", derivatives": form + ["--derivatives"] for name, form in forms.items()})
    forms.update({name + ", depth first": form + ["--depth-first"] for name, form in forms.items()})
    forms.update({name + ", culled": form + ["--cull"] for name, form in forms.items()})
    if gl_device:
        forms["our OpenGL device"], forms["our OpenGL device, culled"] = [], ["--cull", "back"]
    tried, renderer, difference, failed = {}, "", {"mean": 0, "share_over_2": 0, "maximum": 0}, []
    ours_ms(scene, frames=1)
    kept = picture(scene.name + "-kept", "ppm")
    os.replace(picture(scene.name, "ppm"), kept)
    for name, form in forms.items():
        plain = not name.startswith("our")
        theirs = picture(scene.name + ("-opengl" if plain else ""), "ppm")
        try:
            if plain:
                report = opengl(scene, form, frames=3, save=True)
                tried[name], renderer = report["frame_ms"], report["renderer"]
            else:
                tried[name] = ours_ms(scene, "--device", "gl", *form, frames=3)
                os.replace(theirs, picture(scene.name + "-gl-device", "ppm"))
                theirs = picture(scene.name + "-gl-device", "ppm")
        except measure.Failed as problem:
            failed.append(str(problem))
            continue
        told = json.loads(measure.output([paths.LAMBENT, "diff", "--json", "--tolerance", "255", kept, theirs]))
        # The same lighting gives the same picture; edges, flat triangles and interpolation by the driver may differ in a few pixels.
        if told["mean"] > 2 / 255:
            raise measure.Failed("%s: OpenGL (%s) draws a different picture (mean difference %.4f)" % (scene.name, name, told["mean"]))
        difference = {key: max(before, told[key]) for key, before in difference.items()}
    os.replace(kept, picture(scene.name, "ppm"))
    if all(name.startswith("our") for name in tried):  # our own device alone is too weak a comparison
        raise measure.Failed("; ".join(failed))
    return tried, forms, renderer, difference, failed


def frame(scene, isas, gl_device, seconds):
    tried, forms, renderer, difference, failed = peers(scene, gl_device)
    best = min(tried, key=tried.get)
    frames = REPEAT if tried[best] < 200 else 3
    contestants = {}
    for isa in isas:
        contestants[isa] = lambda isa=isa: ours_ms(scene, "--isa", isa, frames=frames)
        contestants[isa + ", culled"] = lambda isa=isa: ours_ms(scene, "--isa", isa, "--cull", "back", frames=frames)
    if best.startswith("our"):
        contestants["opengl"] = lambda: ours_ms(scene, "--device", "gl", *forms[best], frames=frames)
    else:
        contestants["opengl"] = lambda: opengl(scene, forms[best], frames)["frame_ms"]
    taken = measure.in_turn(contestants, seconds, most_rounds=7)
    fastest = {isa: min(taken[isa], taken[isa + ", culled"], key=statistics.median) for isa in isas}
    return {"ms": {key: measure.spread(t) for key, t in taken.items()}, "peers_tried_ms": tried, "peer": "llvmpipe, " + best,
            "renderer": renderer, "difference": difference, "peers_failed": failed, "size": scene.size, "samples": scene.samples,
            "ratio": {isa: measure.ratio(taken["opengl"], fastest[isa]) for isa in isas}}


def scene_of(name, triangles, lights, shading, size, samples):
    return scenes.Scene(name.replace(" ", "-"), scenes.model(triangles), scenes.around(lights), shading, size, samples)


# The rows with targets: together they include every size, number of lights, shading, picture and number of samples.
NAMED = ((2, "frame 10k", 10000, 1, "phong", (1024, 1024), 1), (3, "frame 1M", 1000000, 1, "phong", (1024, 1024), 1),
         (3, "frame 10M flat", 10000000, 1, "flat", (512, 512), 1), (4.5, "frame 100k 16 lights 4 samples", 100000, 16, "phong", (1024, 1024), 4),
         (3, "frame 1M 64 lights", 1000000, 64, "phong", (1920, 1080), 1),
         (4, "frame 100k 256 lights gouraud 4K", 100000, 256, "gouraud", (3840, 2160), 1))


def product():
    for triangles in (10000, 100000, 1000000, 10000000):
        for lights in (1, 4, 16, 64, 256):
            for shading in ("phong", "gouraud", "flat"):
                for size in ((512, 512), (1024, 1024), (1920, 1080), (3840, 2160)):
                    for samples in (1, 4):
                        name = "frame %d %d lights %s %dx%d %d samples" % (triangles, lights, shading, *size, samples)
                        yield name, triangles, lights, shading, size, samples


def rows(isas, gl_device, full):
    for target, name, *what in NAMED:
        yield name, target, lambda name=name, what=what: frame(scene_of(name, *what), isas, gl_device, 4)
    for name, *what in product() if full else ():
        yield name, 3, lambda name=name, what=what: frame(scene_of("product", *what), isas, gl_device, 2)


def spread_lights(count, radius, end=None):
    """Lights a little above the terrain (model.c has its height), evenly in both directions. Their light falls to 1/255 at `radius`; with `end`, the
    lights have glTF's range there and contribute nothing beyond it. Without it, each light contributes everywhere, and the many distant lights add
    up."""
    lights = []
    for i in range(count):
        # A sequence that fills the plane evenly (Roberts' R2).
        x, z = 1 - 2 * ((0.5 + (i + 1) * 0.7548776662466927) % 1), (1 - 2 * ((0.5 + (i + 1) * 0.5698402909980532) % 1)) * 9 / 16
        y = 0.02 * math.sin(11 * x + 3 * z) + 0.015 * math.cos(17 * z - 5 * x) + 0.12 * radius
        light = {"position": (x, y, z), "color": tuple(4 + 2 * ((i * step) % 7) / 6 for step in (1, 3, 5)),
                 "attenuation": (1.0, 0.0, 254 * 5 / radius ** 2)}
        lights.append(dict(light, range=end) if end else light)
    return lights


def lights_a_tile_radius(count, wanted, pixels_per_unit, tile=64, size=(1920, 1080)):
    """The radius at which each tile has on average `wanted` lights. A disc of radius r touches (pi r^2 + 4 r s + s^2)/s^2 tiles of side s, including
    tiles beyond the picture's edge."""
    touched = wanted * (size[0] / tile) * (size[1] / tile) / count
    low, high = 0.0, 10000.0
    for _ in range(80):
        middle = (low + high) / 2
        if (math.pi * middle ** 2 + 4 * middle * tile + tile ** 2) / tile ** 2 < touched:
            low = middle
        else:
            high = middle
    return low / pixels_per_unit


def many_lights(count, wanted, isas):
    """`count` small lights over a terrain, compared with 16 lights of the same kind that are evaluated everywhere (no cutoff)."""
    # Seen straight from above, so that the terrain fills the picture from side to side.
    terrain, size, height, half = scenes.model(200000, shape="terrain"), (1920, 1080), 4.0, 0.55
    radius = lights_a_tile_radius(count, wanted, size[1] / (2 * half))
    view = {"size": size, "eye": (0.0, height, 0.0), "up": (0.0, 0.0, -1.0), "fovy": 2 * math.degrees(math.atan(half / height)),
            "planes": (3.0, 5.0)}
    many = scenes.Scene("lights-%d" % count, terrain, spread_lights(count, radius, radius), **view)
    endless = scenes.Scene("lights-%d-endless" % count, terrain, spread_lights(count, radius), **view)
    # The same attenuation, and a range that covers the picture: each light affects every point.
    few = scenes.Scene("lights-16", terrain, spread_lights(16, radius, 1000.0), **view)
    try:
        ours_ms(few, "--light-cutoff", 0, frames=1)
        cutoff = ["--light-cutoff", 0]
    except measure.Failed:
        cutoff = []  # a lambent without light lists evaluates every light anyway
    contestants = {}
    for isa in isas:
        contestants[isa] = lambda isa=isa: ours_ms(many, "--isa", isa, frames=3)
        contestants[isa + ", 16 lights"] = lambda isa=isa: ours_ms(few, "--isa", isa, *cutoff, frames=3)
    if ours_ms(many, frames=1) > 5000:
        raise measure.Failed("a frame with %d lights takes more than 5 s: this lambent has no light lists" % count)
    taken = measure.in_turn(contestants, 4, most_rounds=7)
    if count <= 1000:
        taken["without an end"] = [ours_ms(endless, "--isa", isas[0], frames=1)]
    result = {"ms": {key: measure.spread(t) for key, t in taken.items()}, "radius": radius, "lights_a_tile": wanted,
              "ratio": {isa: measure.ratio(taken[isa], taken[isa + ", 16 lights"]) for isa in isas}, "peer": "16 lights everywhere"}
    if "without an end" in taken:
        result["ratio"]["without an end"] = measure.ratio(taken["without an end"], taken[isas[0] + ", 16 lights"])
    if cutoff:
        measure.lambent(*cutoff, "-o", picture("lights-%d-all" % count, "ppm"), many.json)
        told = json.loads(measure.output([paths.LAMBENT, "diff", "--json", "--tolerance", "255", picture(many.name, "ppm"),
                                          picture("lights-%d-all" % count, "ppm")]))
        result["difference"] = {"maximum": told["maximum"], "mean": told["mean"]}
    return result


def threads(isas):
    """The 1 M scene with one thread and with two threads. It draws enough frames to outweigh the first ones, in which the system has not yet given
    each thread its own processor; these can be half of seven short frames."""
    scene = scene_of("frame 1M", 1000000, 1, "phong", (1024, 1024), 1)
    contestants = {"%s, %d" % (isa, n): (lambda isa=isa, n=n: ours_ms(scene, "--isa", isa, "-j", n, frames=30)) for isa in isas for n in (1, 2)}
    taken = measure.in_turn(contestants, 5)
    return {"ms": {key: measure.spread(t) for key, t in taken.items()}, "peer": "one thread",
            "ratio": {isa: measure.ratio(taken[isa + ", 1"], taken[isa + ", 2"]) for isa in isas}}


def growth(isas):
    """Series of frames for the plots: {series: {"axis", "x", "ours_ms", "peer_ms"}}; ours with the widest instruction set."""
    found = {}
    for axis, steps in (
            ("triangles", [(n, (n, 1, "phong", (1024, 1024), 1)) for n in (10000, 100000, 1000000, 10000000)]),
            ("pixels", [(n * n, (100000, 1, "phong", (n, n), 1)) for n in (256, 512, 1024, 2048)]),
            ("lights", [(n, (100000, n, "phong", (1024, 1024), 1)) for n in (1, 4, 16, 64, 256)])):
        series = found[axis] = {"axis": axis, "x": [], "ours_ms": [], "peer_ms": []}
        for value, what in steps:
            scene = scene_of("growth", *what)
            series["x"].append(value)
            series["ours_ms"].append(statistics.median(ours_ms(scene, "--isa", isas[0], "--cull", "back") for _ in range(3)))
            forms = [[lights, *order, "--cull"] for lights in ("loop", "written") for order in ([], ["--depth-first"])]
            series["peer_ms"].append(min(opengl(scene, form, frames=3)["frame_ms"] for form in forms))
    scene = scene_of("growth", 1000000, 1, "phong", (1024, 1024), 1)
    counts = [n for n in (1, 2, 4, 8, 16, 32) if n <= len(os.sched_getaffinity(0))]
    found["threads"] = {"axis": "threads", "x": counts, "ours_ms": [statistics.median(
        ours_ms(scene, "--isa", isas[0], "-j", n) for _ in range(3)) for n in counts]}
    return found
