#!/usr/bin/env python3
"""cycles.py LAMBENT [--noise]: compares paths of light with Cycles (Debian's package blender, started without its window).

Both programs draw the same five scenes with the same triangles: matt walls, a sky, a point lamp, metal and glass. For each scene, the script prints the
mean of both pictures (linear, without tone curve, filter or adaptive sampling), the difference of the means, and the root mean square difference of
blocks of 8 by 8 pixels, both as a fraction of the mean. It ends with 1 if a mean differs by more than 2 %.

--noise compares the noise at equal time on two threads: the root mean square error of each program against its own picture with 64 times as many paths,
times the square root of the time for tracing alone."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

SIZE, BLOCK, BOUNCES, PATHS, NOISY = 128, 8, 32, 1024, 64

WHITE, RED, GREEN = ({"diffuse": c, "specular": [0, 0, 0]} for c in ([0.73] * 3, [0.63, 0.06, 0.05], [0.14, 0.45, 0.09]))
METAL = {"physical": True, "diffuse": [0.9, 0.6, 0.3], "metallic": 1, "roughness": 0.5}
GLASS = {"physical": True, "diffuse": [1, 1, 1], "roughness": 0, "transmission": 1, "thickness": 1, "ior": 1.5}


def glowing(*color):
    return {"diffuse": [0, 0, 0], "specular": [0, 0, 0], "emission": list(color)}


def thing(shape, material, at, *scale):
    return {"shape": shape, "material": material, "transform": [["translate", *at], ["scale", *scale]]}


def room(floor, left, right, back):
    return [thing("cube", floor, (0, -0.05, 0), 1.1, 0.05, 1.1), thing("cube", floor, (0, 2.05, 0), 1.1, 0.05, 1.1),
            thing("cube", back, (0, 1, -1.05), 1.1, 1.1, 0.05), thing("cube", left, (-1.05, 1, 0), 0.05, 1.1, 1.1),
            thing("cube", right, (1.05, 1, 0), 0.05, 1.1, 1.1)]


LAMP = thing("cube", "lamp", (0, 1.98, 0), 0.35, 0.01, 0.35)
IN_ROOM, ON_FLOOR = [[0, 0.7, 4.2], [0, 0.7, 0], 24], [[0, 2.2, 4.5], [0, 0.5, 0], 36]
FLOOR = thing("cube", "white", (0, -0.5, 0), 4, 0.5, 4)
SCENES = {
    "matt walls": {"objects": [*room("white", "red", "green", "white"), LAMP, thing("cube", "white", (-0.3, 0.5, -0.3), 0.3, 0.5, 0.3)], "camera": IN_ROOM},
    "sky": {"objects": [FLOOR, thing("sphere", "white", (-0.8, 0.7, 0), 0.7), thing("cube", "red", (0.8, 0.5, 0), 0.5)], "camera": ON_FLOOR, "sky": 0.8},
    "point lamp": {"objects": [FLOOR, thing("sphere", "green", (-0.8, 0.7, 0), 0.7), thing("cube", "white", (0.8, 0.5, 0), 0.5)], "camera": ON_FLOOR, "lamp": [2, 4, 2]},
    "metal": {"objects": [*room("white", "red", "green", "white"), LAMP, thing("sphere", "metal", (0, 0.6, 0), 0.6)], "camera": IN_ROOM},
    "glass": {"objects": [*room("dim", "rose", "lime", "dim"), thing("sphere", "glass", (0, 0.8, 0.2), 0.7)], "camera": IN_ROOM},
}
MATERIALS = {"white": WHITE, "red": RED, "green": GREEN, "lamp": glowing(9, 8, 6), "metal": METAL, "glass": GLASS, "dim": glowing(0.2, 0.2, 0.2),
             "rose": glowing(0.9, 0.1, 0.1), "lime": glowing(0.1, 0.8, 0.2)}
POWER = 6  # the lamp's colour at a distance of 1

# Runs in Blender. Coordinates stay as they are, with y up. Cycles' lamp of P watts has the irradiance P / (4 pi d²); Lambent's lamp of colour c has pi c / d².
IN_BLENDER = r'''
import bpy, json, math, mathutils, sys, time
job = json.loads(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
scene, context = bpy.context.scene, bpy.context
scene.render.engine = "CYCLES"
for name, value in {"device": "CPU", "samples": job["paths"], "use_adaptive_sampling": False, "use_denoising": False, "pixel_filter_type": "BOX", "filter_width": 1,
                    "sample_clamp_direct": 0, "sample_clamp_indirect": 0, "blur_glossy": 0, "caustics_reflective": True, "caustics_refractive": True,
                    "max_bounces": job["bounces"], "diffuse_bounces": job["bounces"], "glossy_bounces": job["bounces"], "transmission_bounces": job["bounces"],
                    "use_auto_tile": False, "seed": job["seed"]}.items():
    setattr(scene.cycles, name, value)
scene.render.resolution_x = scene.render.resolution_y = job["size"]
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", 2
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
scene.render.image_settings.exr_codec = "NONE"
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = [job["sky"]] * 3 + [1]

def material(m):
    made = bpy.data.materials.new("m")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    if m.get("transmission"):
        node = tree.nodes.new("ShaderNodeBsdfGlass")
        node.inputs["Roughness"].default_value, node.inputs["IOR"].default_value = m["roughness"], m["ior"]
        node.inputs["Color"].default_value = m["diffuse"] + [1]
    elif m.get("metallic"):
        node = tree.nodes.new("ShaderNodeBsdfPrincipled")
        node.distribution = "MULTI_GGX"
        node.inputs["Metallic"].default_value, node.inputs["Roughness"].default_value = 1, m["roughness"]
        node.inputs["Base Color"].default_value = m["diffuse"] + [1]
    elif m.get("emission"):
        node = tree.nodes.new("ShaderNodeEmission")
        node.inputs["Color"].default_value, node.inputs["Strength"].default_value = m["emission"] + [1], 1
    else:
        node = tree.nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = m["diffuse"] + [1]
    tree.links.new(node.outputs[0], out.inputs["Surface"])
    return made

materials = {name: material(m) for name, m in job["materials"].items()}
for thing in job["objects"]:
    bpy.ops.wm.obj_import(filepath=job["shapes"][thing["shape"]], forward_axis="Y", up_axis="Z")
    for object in context.selected_objects:
        (_, x, y, z), (_, *scale) = thing["transform"]
        object.matrix_world = mathutils.Matrix.Translation((x, y, z)) @ mathutils.Matrix.Diagonal((*(scale if len(scale) == 3 else scale * 3), 1))
        object.data.materials.clear()
        object.data.materials.append(materials[thing["material"]])
if job["lamp"]:
    lamp = bpy.data.lights.new("lamp", "POINT")
    lamp.energy, lamp.shadow_soft_size = 4 * math.pi ** 2 * job["power"], 0
    made = bpy.data.objects.new("lamp", lamp)
    made.location = job["lamp"]
    scene.collection.objects.link(made)
eye, target, fovy = job["camera"]
camera = bpy.data.cameras.new("camera")
camera.sensor_fit, camera.angle = "VERTICAL", math.radians(fovy)
made = bpy.data.objects.new("camera", camera)
back = (mathutils.Vector(eye) - mathutils.Vector(target)).normalized()
right = mathutils.Vector((0, 1, 0)).cross(back).normalized()
made.matrix_world = mathutils.Matrix.Translation(eye) @ mathutils.Matrix((right, back.cross(right), back)).transposed().to_4x4()
scene.collection.objects.link(made)
scene.camera = made
scene.render.filepath = job["out"]
bpy.ops.render.render(write_still=True)
'''


def scene_of(name):
    own = SCENES[name]
    eye, target, fovy = own["camera"]
    sky, lamp = own.get("sky", 0), own.get("lamp")
    return {"lambent": 1, "image": {"size": [SIZE, SIZE], "background": [sky] * 3, "tone": "none"}, "ambient": [sky] * 3, "materials": MATERIALS,
            "objects": own["objects"], "camera": {"eye": eye, "target": target, "fovy": fovy, "near": 0.01, "far": 100},
            "lights": [{"type": "point", "position": lamp, "color": [POWER] * 3, "attenuation": [0, 0, 1]}] if lamp else []}


def lambent(program, folder, name, paths):
    """The linear colours, bottom row first, and the seconds of drawing."""
    with open(os.path.join(folder, "scene.json"), "w") as file:
        json.dump(scene_of(name), file)
    done = subprocess.run([program, "scene.json", "--bounces", str(BOUNCES), "--paths", str(paths), "--denoise", "off", "--threads", "2", "--time-limit", "none", "-o", "l.pfm", "--json"],
                          cwd=folder, check=True, stdout=subprocess.PIPE)
    data = open(os.path.join(folder, "l.pfm"), "rb").read()
    return struct.unpack("<%df" % (3 * SIZE * SIZE), data[-12 * SIZE * SIZE:]), json.loads(done.stdout)["times_ms"]["steps"]["tiles"] / 1000


def exr_colors(path):
    """The colours of an uncompressed EXR picture with scan lines of floats, bottom row first."""
    data = open(path, "rb").read()
    at, names = 8, []
    while data[at]:
        key, at = data[at:data.index(b"\0", at)], data.index(b"\0", at) + 1
        at = data.index(b"\0", at) + 1
        size = struct.unpack_from("<i", data, at)[0]
        at += 4
        if key == b"channels":
            names = re.findall(rb"([A-Za-z.]+)\0\x02\0\0\0", data[at:at + size])
        at += size
    offsets = struct.unpack_from("<%dQ" % SIZE, data, at + 1)
    out = []
    for offset in reversed(offsets):
        rows = struct.unpack_from("<%df" % (len(names) * SIZE), data, offset + 8)
        channel = {name.decode()[-1]: rows[k * SIZE:(k + 1) * SIZE] for k, name in enumerate(names)}
        out += [channel[c][x] for x in range(SIZE) for c in "RGB"]
    return out


def cycles(folder, shapes, name, paths, seed=0):
    own, out = SCENES[name], os.path.join(folder, "c.exr")
    job = {"paths": paths, "bounces": BOUNCES, "size": SIZE, "sky": own.get("sky", 0), "materials": MATERIALS, "objects": own["objects"], "lamp": own.get("lamp"),
           "power": POWER, "camera": own["camera"], "shapes": shapes, "out": out, "seed": seed}
    script = os.path.join(folder, "scene.py")
    with open(script, "w") as file:
        file.write(IN_BLENDER)
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--debug-cycles", "--python", script, "--", json.dumps(job)],
                          cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={**os.environ, "GLOG_v": "1"})
    if done.returncode:
        sys.exit(done.stdout[-3000:])
    seconds = re.search(r"Path Tracing\s+([0-9.]+)", done.stdout)
    return exr_colors(out), float(seconds[1]) if seconds else math.nan


def blocks(colors):
    sums = {}
    for i, value in enumerate(colors):
        at = i // 3
        key = (at // SIZE // BLOCK, at % SIZE // BLOCK, i % 3)
        sums[key] = sums.get(key, 0) + value
    return [sums[key] / BLOCK ** 2 for key in sorted(sums)]


def root_mean_square(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))


def main():
    program = os.path.abspath(sys.argv[1])
    if not shutil.which("blender"):
        return print("cycles: skipped, because the package blender is missing")
    with tempfile.TemporaryDirectory() as folder:
        shapes = {}
        for shape in ("cube", "sphere"):
            shapes[shape] = os.path.join(folder, shape + ".obj")
            subprocess.run([program, "convert", shape, shapes[shape], "-q"], check=True)
        far = False
        for name in SCENES:
            if "--noise" in sys.argv:
                work = []
                for draw in (lambda n, k: lambent(program, folder, name, n), lambda n, k: cycles(folder, shapes, name, n, k)):
                    few, seconds = draw(NOISY, 1)
                    error = root_mean_square(few, draw(64 * NOISY, 2)[0])
                    work.append(error * math.sqrt(seconds))
                    print("%-11s %s: error %.4f with %d paths in %.2f s" % (name, ("Lambent", "Cycles ")[len(work) - 1], error, NOISY, seconds))
                print("%-11s noise at equal time: %.2f of Cycles'" % (name, work[0] / work[1]), flush=True)
                continue
            ours, theirs = lambent(program, folder, name, PATHS)[0], cycles(folder, shapes, name, PATHS)[0]
            means = [sum(c) / len(c) for c in (ours, theirs)]
            apart = means[0] / means[1] - 1
            far |= abs(apart) > 0.02
            print("%-11s means %.5f and %.5f, %+.2f %%; blocks %.2f %%" % (name, *means, 100 * apart, 100 * root_mean_square(blocks(ours), blocks(theirs)) / means[1]),
                  flush=True)
        sys.exit(far)


if __name__ == "__main__":
    main()
