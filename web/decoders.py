#!/usr/bin/env python3
"""decoders.py FOLDER: compiles the decoders of compressed glTF files for WebAssembly, from Debian's source packages of Draco and meshoptimizer with
the program's own interface to Draco (src/formats/import/gltf/draco), to FOLDER/decoders.wasm: a separate module, which the page downloads when a file needs
it. It does nothing if the module is up to date. C++ exceptions end the module (a trap); the data is then damaged."""
import concurrent.futures
import hashlib
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import libraries  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OWN = os.path.join(ROOT, "src", "formats", "import", "gltf", "draco", "draco_module.cpp")
FLAGS = ["--target=wasm32-wasi", "-std=c++17", "-Oz", "-DNDEBUG", "-fignore-exceptions", "-fno-rtti", "-mbulk-memory", "-mnontrapping-fptoint",
         "-ffp-contract=off", "-w"]
# Draco's configuration: the features that glTF files use. (Draco's own build generates this
# header.)
FEATURES = "".join("#define DRACO_%s_SUPPORTED\n" % name for name in (
    "MESH_COMPRESSION", "NORMAL_ENCODING", "STANDARD_EDGEBREAKER", "PREDICTIVE_EDGEBREAKER", "BACKWARDS_COMPATIBILITY"))
WITHOUT = ("test", "encod", "expert", "stripifier", "cleanup", "equivalence", "dedup", "mesh_splitter", "features", "mesh_utils", "connected", "builder",
           "triangle_soup", "cycle_timer", "file", "structural_metadata", "property", "compression_options")
# The function that C++ code calls to throw.
THROW = """#include <cstddef>
extern "C" void *__cxa_allocate_exception(std::size_t) { __builtin_trap(); }
extern "C" void __cxa_throw(void *, void *, void (*)(void *)) { __builtin_trap(); }
"""
EXPORTS = ["malloc", "free", "lambent_draco_functions"] + ["meshopt_decode" + name for name in (
    "VertexBuffer", "IndexBuffer", "IndexSequence", "FilterOct", "FilterQuat", "FilterExp")]


def sources(folder):
    draco, meshopt = (os.path.join(libraries.unpacked(folder, name), "src") for name in ("draco", "meshoptimizer"))
    found = [os.path.join(meshopt, name + ".cpp") for name in ("vertexcodec", "indexcodec", "vertexfilter", "allocator")] + [OWN]
    for part in ("attributes", "compression", "core", "mesh", "metadata", "point_cloud"):
        for place, _, names in os.walk(os.path.join(draco, "draco", part)):
            found += [os.path.join(place, name) for name in names if name.endswith(".cc") and not any(word in name for word in WITHOUT)]
    return sorted(found), [draco, meshopt]


def stamp():
    return hashlib.sha256(b"".join(open(path, "rb").read() for path in (os.path.abspath(__file__), OWN, OWN[:-3] + "h"))).hexdigest()


def main():
    folder = os.path.abspath(sys.argv[1])
    made, mark = os.path.join(folder, "decoders.wasm"), os.path.join(folder, "decoders.stamp")
    if os.path.exists(made) and os.path.exists(mark) and open(mark).read() == stamp():
        return
    if not all(libraries.unpacked(folder, name) for name in ("draco", "meshoptimizer")):
        print("web: fetching Debian's sources of draco, meshoptimizer", flush=True)
        libraries.fetch(folder, ["draco", "meshoptimizer"])
    print("web: compiling draco and meshoptimizer", flush=True)
    place = os.path.join(folder, "objects", "decoders")
    os.makedirs(os.path.join(place, "draco"), exist_ok=True)
    open(os.path.join(place, "draco", "draco_features.h"), "w").write(FEATURES)
    open(os.path.join(place, "throw.cpp"), "w").write(THROW)
    found, folders = sources(folder)
    flags = FLAGS + ["-I" + path for path in [place, *folders]]

    def compile_one(source):
        target = os.path.join(place, "%s-%s.o" % (hashlib.sha256(source.encode()).hexdigest()[:8], os.path.basename(source)))
        libraries.run("clang++-19", *flags, "-c", source, "-o", target)
        return target

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        objects = list(pool.map(compile_one, found + [os.path.join(place, "throw.cpp")]))
    libraries.run("clang++-19", "--target=wasm32-wasi", "-O2", "-mexec-model=reactor", "-fno-exceptions", "-Wl,--gc-sections", "-Wl,-s", "-Wl,--export-table",
                  "-Wl,-z,stack-size=1048576", *["-Wl,--export=" + name for name in EXPORTS], "-o", made, *objects)
    with open(mark, "w") as out:
        out.write(stamp())


if __name__ == "__main__":
    main()
