#!/usr/bin/env python3
"""check.py: counts the instructions of a fixed set of lambent jobs with callgrind and compares them with recorded counts.

    check.py LAMBENT            one check for each job: within 3 % of bench/instructions.json (make bench-check)
    check.py LAMBENT --record   rewrites that file (make bench-check-record)

With AVX2 (valgrind 3.19 knows no AVX-512) and one thread, the same build gives the same count to a few thousandths on any
machine and at any load, so a slow-down shows in the change that causes it. If a job became faster, record it again; otherwise the slack would hide
the next slow-down. Counts of another build (compiler, sanitizer, debug) are not comparable, so the checks are then skipped with a message. Output is
TAP."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

RECORDED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "instructions.json")
ROOM = 0.03


def patch(side):
    """Positions and triangles of a wavy square; every number is a short decimal, equal in each format."""
    positions = [(round(i / side, 4), round(0.1 * math.sin(0.3 * i) * math.cos(0.2 * j), 4), round(j / side, 4))
                 for j in range(side + 1) for i in range(side + 1)]
    triangles = []
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i
            triangles += [(a, a + side + 1, a + side + 2), (a, a + side + 2, a + 1)]
    return positions, triangles


def write_models(folder):
    positions, triangles = patch(90)
    with open(os.path.join(folder, "patch.obj"), "w") as file:
        file.writelines("v %g %g %g\n" % p for p in positions)
        file.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)
    with open(os.path.join(folder, "patch.ply"), "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(positions), len(triangles))).encode())
        file.write(b"".join(struct.pack("<3f", *p) for p in positions) + b"".join(struct.pack("<B3i", 3, *t) for t in triangles))
    with open(os.path.join(folder, "patch.stl"), "wb") as file:
        file.write(b"patch".ljust(80) + struct.pack("<I", len(triangles)))
        file.write(b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in t for x in positions[i]), 0) for t in triangles))


def jobs():
    """{name: arguments}. All together take less than a minute under callgrind."""
    lights = [word for i in range(16) for word in ("--light", "point:position=%.3fr/%.3fr/%.3fr,color=0.1,attenuation=1/0.1r/0.2r" % (
        3 * math.cos(0.4 * i), 2 * math.sin(1.1 * i), 3 * math.sin(0.4 * i)))]
    small = ["-s", "64", "--samples", "1"]
    found = {"start": ["--version"]}
    found.update({"read " + kind: small + ["patch." + kind] for kind in ("ply", "stl", "obj")})
    found.update({"draw phong": ["-s", "320", "--samples", "4", "teapot"], "draw phong, 1 sample": ["-s", "320", "--samples", "1", "teapot"],
                  "draw gouraud": ["-s", "256", "--samples", "4", "--shading", "gouraud", "teapot"], "draw flat": ["-s", "256", "--samples", "4", "--shading", "flat", "teapot"],
                  "16 lights": ["-s", "256", "--samples", "1", *lights, "sphere"], "translucent": ["-s", "200", "--samples", "4", "--opacity", "0.5", "torus-knot"],
                  "encode": ["-s", "700", "--samples", "1", "--reflection", "none", "-b", "white", "cube"],
                  "shadows": ["-s", "200", "--samples", "1", "--light", "point:position=2/3/2", "--shadows", "teapot"],
                  "edges": ["-s", "200", "--samples", "1", "--edges", "all", "teapot"], "wireframe": ["-s", "200", "--samples", "1", "--wireframe", "teapot"]})
    # The extra features of the default look have a job of their own.
    found = {name: words if words == ["--version"] else ["--ao", "off", *words] for name, words in found.items()}
    found["ambient occlusion"] = found["draw phong"][2:]
    found["default picture"] = ["teapot"]
    found["ambient occlusion, cells"] = ["-s", "800", "--samples", "1", "teapot"]
    found["glass on a ground"] = ["-s", "64", "--samples", "1", "--material", "glass", "--ground", "sphere"]
    found["ambient occlusion, rays"] = ["-s", "64", "--samples", "1", "--ao", "rays", "--ao-samples", "16", "teapot"]
    return found


def instructions(lambent, arguments, folder):
    """Counted over the whole process."""
    drawing = [] if arguments == ["--version"] else ["-q", "--isa", "avx2", "--threads", "1", "-o", "out.png"]
    # A fixed environment: its bytes are on the stack and shift the addresses of everything else there.
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", lambent, *drawing, *arguments], cwd=folder,
                          env={"PATH": "/usr/bin:/bin"}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    text = done.stderr.decode(errors="replace")
    found = re.search(r"Collected\s*:\s*(\d+)", text)
    if done.returncode or not found:
        raise RuntimeError("exit %d: %s" % (done.returncode, text[-400:]))
    return int(found.group(1))


def build_of(lambent):
    """The compiler and the kind of build, from lambent --version: "gcc 12.2.0, x86-64, release"."""
    told = subprocess.run([lambent, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()[1]
    return ", ".join(told.split(", ")[:3])


def why_not(build, record):
    """A reason to skip the checks, or None."""
    if not shutil.which("valgrind"):
        return "valgrind is not installed"
    if "avx2" not in open("/proc/cpuinfo").read():
        return "this processor has no AVX2"
    if record:
        return None
    if not os.path.exists(RECORDED):
        return "nothing is recorded (make bench-check-record)"
    recorded = json.load(open(RECORDED))["build"]
    return None if recorded == build else "recorded with %s, this is %s" % (recorded, build)


def main():
    lambent, record = os.path.abspath(sys.argv[1]), "--record" in sys.argv[2:]
    build = build_of(lambent)
    reason = why_not(build, record)
    if reason:
        print("1..1\nok 1 - instructions # SKIP %s" % reason)
        return 0
    recorded = {} if record else json.load(open(RECORDED))["instructions"]
    counted, failed = {}, 0
    todo = jobs()
    print("1..%d" % len(todo))
    with tempfile.TemporaryDirectory() as folder:
        write_models(folder)
        for number, (name, arguments) in enumerate(todo.items(), 1):
            count = counted[name] = instructions(lambent, arguments, folder)
            before = count if record else recorded.get(name)
            change = count / before - 1 if before else None
            good = change is not None and abs(change) <= ROOM
            failed += not good
            said = "not recorded" if before is None else "%d, %+.1f %% of the recorded %d" % (count, 100 * change, before)
            hint = "" if good else "; make bench-check-record, if this is intended" if before is None or change < 0 else "; slower"
            print("%s %d - %s: %s%s" % ("ok" if good else "not ok", number, name, said, hint), flush=True)
    if record:
        with open(RECORDED, "w") as file:
            json.dump({"build": build, "instructions": counted}, file, indent=1)
            file.write("\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
