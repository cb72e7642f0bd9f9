#!/usr/bin/env python3
"""static_program.py PROGRAM: tests the programs of `make static`, for this machine and for aarch64 (by qemu-user-static): each is one file of at most
11 MB that needs no other file, draws the same bytes as PROGRAM in an empty root, and refuses unsupported features with exit code 3. The empty root
needs root privileges; without them, the program runs in place."""
import base64
import json
import os
import pathlib
import platform
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/long"))
import cells  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
CORPUS = ROOT / "tests" / "fuzz" / "corpus"
PICTURES = ROOT / "tests" / "pictures"
MODELS = [*sorted((ROOT / "tests" / "models").glob("*")), ROOT / "examples" / "models" / "spot.glb", ROOT / "examples" / "models" / "spot.obj",
          CORPUS / "gltf" / "meshopt.gltf", CORPUS / "gltf" / "draco.gltf", CORPUS / "gltf" / "triangle.gltf", CORPUS / "3mf" / "deflated.3mf"]
TEXTURES = {"png": "png/palette8.png", "jpg": "jpeg/color420.jpg", "webp": "webp/lossy.webp"}
# The extension of the picture and the options before it.
DRAWN = [(".png", ["cube.obj"]), (".webp", ["spot.glb"]), (".jpg", ["spot.glb"]), (".png", ["spot.obj", "--ground"]), (".png", ["meshopt.gltf"]), (".png", ["triangle.gltf"]),
         (".png", ["cube.ply", "--edges", "all", "--shadows"]), (".png", ["cube.stl", "--compress", "best"]), (".webp", ["cube.stl", "--turntable", "3"]),
         (".png", ["teapot", "--material", "gold"]), (".pfm", ["torus-knot", "--ao", "rays"]), (".png", ["scene.json"]),
         *[(".png", [f"textured-{ending}.gltf"]) for ending in TEXTURES],
         (".png", ["compare", "cube", "--across", "material=gold,jade"]), (".png", ["plot", "attenuation"])]
REFUSED = [["draco.gltf", "-o", "x.png"], ["cube.obj", "-o", "x.exr"], ["cube.obj", "--device", "gl", "-o", "x.png"], ["view", "cube.obj"]]
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # which the static program contains
MACHINES = [platform.machine(), *({"aarch64"} - {platform.machine()})]
failed = 0
number = 0


def report(title, ok, output=""):
    global failed, number
    number += 1
    failed += not ok
    if not ok:
        print("# " + "\n# ".join(output.splitlines()[-30:]))
    print("%s %d - %s" % ("ok" if ok else "not ok", number, title))
    sys.stdout.flush()


def run(*command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)
    return done.returncode, done.stdout


def textured(picture, extensions):
    """A textured square in glTF."""
    corners = struct.pack("<12f8f6H", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 2, 0, 2, 3)
    data = "data:application/octet-stream;base64," + base64.b64encode(corners).decode()
    texture = {"extensions": {"EXT_texture_webp": {"source": 0}}} if extensions else {"source": 0}
    return json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": extensions or ["KHR_materials_unlit"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}], "textures": [texture], "images": [{"uri": picture}],
        "buffers": [{"byteLength": len(corners), "uri": data}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32}, {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}, {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]})


def fill(root):
    for path in MODELS:
        shutil.copy(path, root)
    for ending, picture in TEXTURES.items():
        shutil.copy(PICTURES / picture, root / ("texture." + ending))
        (root / f"textured-{ending}.gltf").write_text(textured("texture." + ending, ["EXT_texture_webp"] if ending == "webp" else []))


def words_of(words, name):
    """The command that draws NAME, because options of size do not apply to plots."""
    return [*words, "-q", *([] if words[0] == "plot" else ["-s", "120"]), "-o", name]


def try_machine(machine, root):
    home = pathlib.Path(os.environ.get("LAMBENT_STATIC", ROOT / "build-static"))
    folder = home if machine == platform.machine() else home.with_name(home.name + "-" + machine)
    emulator = None if machine == platform.machine() else shutil.which(f"qemu-{machine}-static")
    code, text = run(sys.executable, ROOT / "packaging" / "static.py", folder, machine)
    report(f"{machine}: make static builds the program", code == 0, text)
    if code:
        return
    program = folder / "lambent"
    report(f"{machine}: it has at most 11 MB", program.stat().st_size <= 11_000_000, str(program.stat().st_size))
    code, text = run("readelf", "-ld", program)
    report(f"{machine}: it needs no library and no loader", "INTERP" not in text and "NEEDED" not in text, text)
    notices = (folder / "LICENCES").read_text()
    report(f"{machine}: the notices of its libraries are beside it", all("==== " + name in notices for name in ("libspng", "zlib1g-dev", "libfreetype-dev")))
    if machine != platform.machine() and not emulator:
        report(f"{machine}: drawn by qemu # SKIP qemu-user-static is not installed", True)
        cells.skip("static, " + machine, "qemu-user-static is not installed")
        return
    for path in filter(None, [program, emulator]):
        shutil.copy(path, root)
    inside = "" if os.geteuid() == 0 else str(root)
    before = (["chroot", str(root)] if os.geteuid() == 0 else []) + ([f"{inside}/qemu-{machine}-static"] if emulator else []) + [inside + "/lambent"]
    code, text = run(*before, "--version", cwd=root)
    report(f"{machine}: --version lists what it contains", code == 0 and "static, with DejaVu Sans" in text and "libfreetype-2" in text and "without OpenGL" in text, text)
    for i, (ending, words) in enumerate(DRAWN):
        code, text = run(*before, *words_of(words, f"picture{i}{ending}"), cwd=root)
        other, more = run(PROGRAM, *words_of(words, f"other{i}{ending}"), cwd=root, env={**os.environ, "LAMBENT_FONT": FONT})
        same = code == other == 0 and (root / f"picture{i}{ending}").read_bytes() == (root / f"other{i}{ending}").read_bytes()
        report("%s: %s to %s: the same bytes" % (machine, " ".join(words), ending), same, text + more)
    row = "static, " + machine.replace("_", "-")
    cells.tell(row, "installs", "yes" if os.geteuid() == 0 else "not run: an empty root needs the rights of root")
    cells.draw_all(row, PROGRAM, root, lambda model, picture: run(*before, model, "-q", "-s", str(cells.SIZE), "-o", picture, cwd=root)[0], ["Draco"])
    for words in REFUSED:
        code, text = run(*before, *words, "-q", cwd=root)
        report("%s: %s: refused" % (machine, " ".join(words)), code == 3 and text.count("\n") == 1 and not (root / "x.png").exists(), "exit code %d: %s" % (code, text))
    if machine == platform.machine():
        try_container(folder)


def try_container(folder):
    """The container file, made from the native program."""
    if not shutil.which("buildah") or os.geteuid() != 0 or folder != ROOT / "build-static":
        print("# the container is not built: buildah, the rights of root or build-static is missing")
        return
    code, text = run("buildah", "--storage-driver", "vfs", "build", "--no-cache", "--isolation", "chroot", "-f", "packaging/ci/Containerfile", "-t", "lambent-test", ".", cwd=ROOT)
    report("the container file builds, and draws", code == 0 and "/tmp/cube.png  64x64" in text, text)
    run("buildah", "--storage-driver", "vfs", "rmi", "lambent-test")


def main():
    for machine in MACHINES:
        if machine != platform.machine() and not shutil.which(machine + "-linux-gnu-g++"):
            report(f"{machine} # SKIP g++-{machine}-linux-gnu is not installed", True)
            cells.skip("static, " + machine, f"g++-{machine}-linux-gnu is not installed")
            continue
        with tempfile.TemporaryDirectory(prefix="lambent-static-") as name:
            fill(pathlib.Path(name))
            try_machine(machine, pathlib.Path(name))
    print("1..%d" % number)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
