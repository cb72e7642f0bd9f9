"""scenes.py: the scenes of the bench: models made by bench-model, and each scene twice, as Lambent's scene file and as the text
file of the plain OpenGL program (opengl_scene.c), with the same camera, lights and material."""
import json
import math
import os
import subprocess

import paths

DIFFUSE, SPECULAR, SHININESS, AMBIENT = (0.55, 0.5, 0.45), (0.3, 0.3, 0.3), 32, 0.1
EYE, UP, FOVY, PLANES = (1.7, 1.2, 3.4), (0.0, 1.0, 0.0), 32.0, (1.5, 7.0)


def model(triangles, kind="ply", shape="sphere"):
    """A model's file, made if it is missing."""
    folder = paths.MODELS
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "%s_%d.%s" % (shape, triangles, kind))
    if not os.path.exists(path):
        unfinished = os.path.join(folder, "unfinished." + kind)
        subprocess.run([paths.program("model"), shape, str(triangles), unfinished], check=True)
        os.rename(unfinished, path)
    return path


def around(count):
    """Point lights on a sphere around the model, evenly spread (Fibonacci's spiral), slightly coloured; together as
    bright as one light, so that no picture is overexposed."""
    lights = []
    for i in range(count):
        height = 1 - 2 * (i + 0.5) / count if count > 1 else 0.55
        turn = i * math.pi * (3 - math.sqrt(5)) + 0.6
        ring = math.sqrt(1 - height * height)
        place = (2.4 * ring * math.cos(turn), 2.4 * height, 2.4 * ring * math.sin(turn))
        strength = 2.2 if count == 1 else 5.0 / count
        color = tuple(strength * (1 + 0.4 * math.cos(turn + k * 2.1)) for k in range(3)) if count > 1 else (strength,) * 3
        lights.append({"position": place, "color": color, "attenuation": (1.0, 0.1, 0.05)})
    return lights


def from_the_front(count):
    """The same lights, moved to the eye, so that each reaches every visible point."""
    return [dict(light, position=tuple(2.2 * e + 0.25 * p for e, p in zip(EYE, light["position"]))) for light in around(count)]


class Scene:
    """One model under point lights: .json is Lambent's file, .text the OpenGL program's."""

    def __init__(self, name, model_path, lights, shading="phong", size=(1024, 1024), samples=1, eye=EYE, target=(0.0, 0.0, 0.0), up=UP,
                 planes=PLANES, fovy=FOVY):
        self.name, self.model, self.lights, self.shading, self.size, self.samples = name, model_path, lights, shading, size, samples
        self.eye, self.target, self.up, self.planes, self.fovy = eye, target, up, planes, fovy
        folder = os.path.join(paths.OUT, "scenes")
        os.makedirs(folder, exist_ok=True)
        self.json, self.text = (os.path.join(folder, name + end) for end in (".json", ".txt"))
        self.write_json()
        self.write_text()

    def write_json(self):
        scene = {
            "lambent": 1,
            # The results of the equations, as written by the OpenGL program: no sRGB on either side.
            "image": {"size": self.size, "samples": self.samples, "background": [0, 0, 0], "color": "raw"},
            "camera": {"eye": self.eye, "target": self.target, "up": self.up, "fovy": self.fovy, "near": self.planes[0],
                       "far": self.planes[1]},
            "ambient": [AMBIENT] * 3, "shading": self.shading, "reflection": "blinn-phong",
            "objects": [{"file": os.path.relpath(self.model, os.path.dirname(self.json)), "two_sided": False,
                         "material": {"diffuse": DIFFUSE, "ambient": DIFFUSE, "specular": SPECULAR, "shininess": SHININESS}}],
            "lights": [dict({"type": "point"}, **light) for light in self.lights]}
        with open(self.json, "w") as file:
            json.dump(scene, file)

    def write_text(self):
        def line(word, *numbers):
            return word + "".join(" %.9g" % n for n in numbers) + "\n"
        with open(self.text, "w") as file:
            file.write("model %s\nshading %s\n" % (self.model, self.shading))
            file.write(line("size", *self.size) + line("samples", self.samples) + line("eye", *self.eye) + line("up", *self.up))
            file.write(line("target", *self.target) + line("fovy", self.fovy) + line("planes", *self.planes))
            file.write(line("ambient", *(AMBIENT * d for d in DIFFUSE)) + line("shininess", SHININESS))
            for light in self.lights:
                diffuse = [c * d for c, d in zip(light["color"], DIFFUSE)]
                specular = [c * s for c, s in zip(light["color"], SPECULAR)]
                file.write(line("light", *light["position"], *diffuse, *specular, *light["attenuation"]))
