#!/usr/bin/env python3
"""machines.py [--long]: tests that the library compiles for another machine: 64-bit Arm with NEON kernels. (tests/web.py builds for WebAssembly.)
Clang's cross compiler with Debian's C library checks the types, intrinsics and warnings of every source file in the folders that a picture needs,
except the importers and codecs that depend on a packaged library. Without --long, it checks only files that mention a processor or include such a
file. It generates no code, because this takes minutes; tests/emulated.py builds for other processors and draws there, in `make test-long`."""
import glob
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROOMS = ["core", "effects", "formats", "system"]
INCLUDES = ["include", "src/core/lighting"] + [os.path.relpath(path, ROOT) for room in ROOMS
                                         for path, _, _ in os.walk(os.path.join(ROOT, "src", room)) if "windows" not in path]
FLAGS = ["-std=gnu11", "-fsyntax-only", "-D_GNU_SOURCE", "-DNDEBUG", "-ffp-contract=off", "-fno-math-errno", "-Wall", "-Werror", "-Wno-psabi"]
MACHINES = {
    "arm64": {"flags": ["--target=aarch64-linux-gnu", "-isystem", "/usr/aarch64-linux-gnu/include"],
              "needs": "/usr/aarch64-linux-gnu/include/stdio.h", "package": "libc6-dev-arm64-cross",
              "kernels": [("scalar", 1), ("neon", 4)], "without": ["file_write_web.c"]},
}
LEFT_OUT = ["png_read.c", "jpeg.c", "jpeg_write.c"]  # libspng's and libjpeg's headers come from the host


# Text that depends on the processor: intrinsics, and headers that contain or select them.
PROCESSOR = re.compile(r'__ARM|__aarch64__|__x86_64__|immintrin|#include "(lanes|double_lanes|eights|cpu_features|float_state|byte_masks|isa|kernels)[.]h"')


def sources(machine, long):
    files = []
    for room in ROOMS:
        files += sorted(glob.glob(os.path.join(ROOT, "src", room, "**", "*.c"), recursive=True))
    files = [path for path in files if long or PROCESSOR.search(open(path).read())]
    files = [path for path in files if "/windows/" not in path]
    # Files that are compiled once for each instruction set.
    of_isa = {"src/core/cpu/%s/%s.c" % (name, name): machine["kernels"] for name in ("raster", "shade", "lights")}
    of_isa.update({"src/effects/" + name: machine["kernels"] for name in
                   ("environment/environment_lookups.c", "occlusion/occlusion_kernels.c", "rays/ray_kernels.c")})
    of_isa["src/effects/environment/environment_kernels.c"] = [("scalar", 4)]
    of_isa.update({path: [("scalar", 1)] for path in (
        "src/core/geometry/normals/corner_fan_simd.c", "src/core/geometry/normals/positions/position_simd.c",
        "src/formats/prepare/tangent_kernels.c", "src/effects/edges/edge_rays.c")})
    skipped = LEFT_OUT + machine["without"] + [os.path.basename(path) for path in of_isa]
    for_each = [(path, isa) for path, isas in of_isa.items() for isa in isas]
    return [(f, []) for f in files if os.path.basename(f) not in skipped] + [
        (os.path.join(ROOT, path), ["-DISA=" + isa, "-DLANES=%d" % lanes]) for path, (isa, lanes) in for_each]


def main():
    count, bad = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        powers = os.path.join(folder, "number_powers.h")
        subprocess.run([sys.executable, os.path.join(ROOT, "src/core/base/text/number_powers.py"), powers], check=True)
        for name, machine in MACHINES.items():
            if not os.path.exists(machine["needs"]):
                count += 1
                print("ok %d - %s # SKIP the package %s is not installed" % (count, name, machine["package"]))
                continue
            for path, more in sources(machine, "--long" in sys.argv):
                count += 1
                done = subprocess.run(["clang"] + machine["flags"] + FLAGS + more + ["-I" + os.path.join(ROOT, i) for i in INCLUDES] +
                                      ["-I" + folder, path],
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                label = "%s: %s %s" % (name, os.path.relpath(path, ROOT), " ".join(more))
                print("%s %d - %s" % ("not ok" if done.returncode else "ok", count, label))
                if done.returncode:
                    bad += 1
                    print("# " + "\n# ".join(done.stdout.splitlines()[:12]))
    print("1..%d" % count)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
