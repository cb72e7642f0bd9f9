#!/usr/bin/env python3
"""web.py PROGRAM [MODULE]: compares the module of the page in node with PROGRAM with SSE4, both with one thread: the shortest frame of each, and
their ratio. Rounds alternate, so a busy machine affects both equally. MODULE: build-web/wasm/web/lambent.wasm (make web)."""
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROUNDS, FRAMES = 3, 8
ROWS = [
    ("teapot", ["teapot", "--size", "960x720"]),
    ("teapot, 1 sample", ["teapot", "--size", "960x720", "--samples", "1"]),
    ("torus knot, flat", ["torus-knot", "--size", "960x720", "--shading", "flat"]),
    ("torus knot, physical", ["torus-knot", "--size", "960x720", "--material", "brass"]),
    ("sphere, environment", ["sphere", "--size", "960x720", "--environment", "studio", "--material", "metallic=1,roughness=0.3,color=white"]),
    ("sphere, coat", ["sphere", "--size", "960x720", "--material", "color=red,roughness=0.4,clearcoat=1,clearcoat_roughness=0.1"]),
    ("teapot, shadows", ["teapot", "--size", "640x480", "--shadows"]),
    ("teapot, ambient occlusion", ["teapot", "--size", "640x480", "--ao", "screen"]),
]


def native(program, words):
    done = subprocess.run([program, *words, "--isa", "sse4", "--threads", "1", "--repeat", str(FRAMES), "--json", "-o", os.path.join(tempfile.gettempdir(), "lambent-web.ppm")],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["times_ms"]["frame_least"]


def main():
    program = os.path.abspath(sys.argv[1])
    module = sys.argv[2] if len(sys.argv) > 2 else os.path.join(ROOT, "build-web", "wasm", "web", "lambent.wasm")
    web = subprocess.Popen(["node", os.path.join(ROOT, "bench", "web.mjs"), module], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    best = [[float("inf")] * 2 for _ in ROWS]
    for _ in range(ROUNDS):
        for (_, words), times in zip(ROWS, best):
            web.stdin.write(json.dumps({"words": words, "frames": FRAMES}) + "\n")
            web.stdin.flush()
            times[0] = min(times[0], *json.loads(web.stdout.readline()))
            times[1] = min(times[1], native(program, words))
    web.stdin.close()
    print("%-28s %9s %9s %6s" % ("", "web ms", "SSE4 ms", "ratio"))
    for (name, _), (a, b) in zip(ROWS, best):
        print("%-28s %9.2f %9.2f %6.2f" % (name, a, b, a / b))


if __name__ == "__main__":
    main()
