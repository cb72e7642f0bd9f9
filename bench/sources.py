#!/usr/bin/env python3
"""sources.py: time and noise of traced paths under 10 and 10,000 lamps, spots or emitting triangles over a floor.

    sources.py LAMBENT [OTHER]      one line for each scene and program

Time: processor time of --bounces 2 --paths 64. Noise: root mean square error of --bounces 1 --paths 64, as a share of the mean, against 2,048 paths of LAMBENT."""
import array
import json
import os
import random
import resource
import subprocess
import sys
import tempfile

SIZE, COUNTS = 128, (10, 10000)


def scenes():
    """Yields a name, the scene, and the text of its model of emitting triangles."""
    chance = random.Random(5)
    floor = [{"shape": "cube", "material": "floor", "transform": [["translate", 0, -1, 0], ["scale", 10, 1, 10]]}]
    scene = {"lambent": 1, "image": {"size": [SIZE, SIZE], "tone": "none"}, "ambient": [0, 0, 0], "camera": {"eye": [0, 0.1, 9], "target": [0, -2, 4], "fovy": 30},
             "materials": {"floor": {"diffuse": [0.6] * 3, "specular": [0] * 3}, "lamp": {"diffuse": [0] * 3, "specular": [0] * 3, "emission": [40] * 3}}}
    for count in COUNTS:
        places = [(chance.uniform(-9, 9), chance.uniform(0.15, 0.6), chance.uniform(-9, 9)) for _ in range(count)]
        lamps = [{"type": "point", "position": p, "attenuation": [0, 0, 1], "color": [40 / count * chance.uniform(0.2, 2) for _ in range(3)]} for p in places]
        yield "%d lamps" % count, {**scene, "objects": floor, "lights": lamps}, ""
        spots = [{"type": "spot", "position": [x, 4 * y, z], "direction": [chance.uniform(-0.3, 0.3), -1, chance.uniform(-0.3, 0.3)], "inner": 10, "outer": 25,
                  "attenuation": [0, 0, 1], "color": [400 / count * chance.uniform(0.2, 2) for _ in range(3)]} for x, y, z in places]
        if count > 10: # ten spots would light almost nothing of the picture
            yield "%d spots" % count, {**scene, "objects": floor, "lights": spots}, ""
        side = 0.5 / count ** 0.5
        text = "".join("v %g %g %g\n" % (x + a * side, y, z + b * side) for x, y, z in places for a, b in ((-1, -1), (1, -1), (0, 1)))
        text += "".join("f %d %d %d\n" % (3 * i + 1, 3 * i + 2, 3 * i + 3) for i in range(count))
        yield "%d triangles" % count, {**scene, "objects": floor + [{"file": "lamps.obj", "material": "lamp"}], "lights": []}, text


def values(program, bounces, paths):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "scene.json", "-q", "--denoise", "off", "--bounces", str(bounces), "--paths", str(paths), "-o", "out.pfm"], check=True)
    with open("out.pfm", "rb") as file:
        return array.array("f", file.read()[-12 * SIZE * SIZE:]), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


if __name__ == "__main__":
    programs = [os.path.abspath(name) for name in sys.argv[1:]]
    os.chdir(tempfile.mkdtemp())
    for name, scene, text in scenes():
        for file, content in (("scene.json", json.dumps(scene)), ("lamps.obj", text)):
            with open(file, "w") as to:
                to.write(content)
        truth = values(programs[0], 1, 2048)[0]
        for program in programs:
            picture = values(program, 1, 64)[0]
            error = (sum((a - b) ** 2 for a, b in zip(picture, truth)) / len(truth)) ** 0.5 / (sum(truth) / len(truth))
            print("%s: %.2f s, noise %.3f of the mean   %s" % (name, min(values(program, 2, 64)[1] for _ in range(3)), error, os.path.basename(program)), flush=True)
