# test_gltf_mutations.py: each optional property of valid glTF files gets a wrong type, null, −1, 0 and a huge number. The files are drawn with at
# most one more warning. Lambent refuses a file only if the property describes geometry (GEOMETRY).
import collections
import json
import re
import struct
import subprocess
import unittest

from harness import Case, long, PROGRAM, ROOT, SHARED_MODELS

# Required properties, by their paths without indices.
REQUIRED = re.compile(r"""asset|asset\.version|accessors\.(componentType|count|type)|accessors\.sparse\.(count|indices|values)(\..*)?
    |buffers\.byteLength|bufferViews\.(buffer|byteLength)|cameras\.(type|perspective|orthographic)|cameras\.perspective\.(yfov|znear)
    |cameras\.orthographic\..*|meshes\.primitives|meshes\.primitives\.attributes|skins\.joints|.*Texture\.index|animations\.(channels|samplers)
    |animations\.channels\.(sampler|target|target\.path)|animations\.samplers\.(input|output)|.*KHR_lights_punctual\.(lights|lights\.type|light)
    |.*KHR_materials_variants\..*|.*(KHR_draco_mesh_compression|EXT_meshopt_compression|EXT_mesh_gpu_instancing)(\..*)?|.*extras(\..*)?""", re.X)
# Optional properties that describe geometry: without them, or with others, the file contains less or other geometry.
GEOMETRY = re.compile(r"""accessors(\.(bufferView|byteOffset))?|bufferViews(\.(byteOffset|byteStride|extensions))?|buffers(\.uri)?|nodes(\.(mesh|children))?
    |meshes(\.primitives\.(indices|mode|attributes\.POSITION))?""", re.X)
WRONG = ("x", None, -1, 0, 1e300)  # 0 instead of "x" if the right type is a string


def mutations(value):
    """Yields (path, replacement) for the first property of each kind."""
    seen, todo = set(), [((), value)]
    while todo:
        path, value = todo.pop(0)
        if isinstance(value, list):
            todo += [(path + (i,), item) for i, item in enumerate(value) if isinstance(item, (dict, list))]
            continue
        for key, member in value.items():
            here = path + (key,)
            kind = kind_of(here)
            if isinstance(member, (dict, list)) and key != "extras":
                todo.append((here, member))
            if kind not in seen and not REQUIRED.fullmatch(kind):
                for replacement in WRONG[isinstance(member, str):]:
                    yield here, replacement
            seen.add(kind)


def kind_of(path):
    return ".".join(part for part in path if isinstance(part, str))


def replaced(value, path, replacement):
    if not path:
        return replacement
    copy = value.copy()
    copy[path[0]] = replaced(value[path[0]], path[1:], replacement)
    return copy


def unpacked(path, folder):
    """Copies a model into a folder as JSON text and the files that it names. Returns the JSON value."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        size = struct.unpack_from("<I", data, 12)[0]
        model = json.loads(data[20:20 + size])
        (folder / "binary.bin").write_bytes(data[28 + size:])
        if model.get("buffers") and "uri" not in model["buffers"][0]:
            model["buffers"][0]["uri"] = "binary.bin"
    else:
        model = json.loads(data)
    for item in model.get("buffers", []) + model.get("images", []):
        uri = item.get("uri", "data:")
        source = path.parent / uri.replace("%20", " ")
        if not uri.startswith("data:") and path.suffix == ".gltf" and source.is_file():
            target = folder / uri.replace("%20", " ")
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(source.read_bytes())
    return model


class Mutations(Case):
    def draw(self, folder, values):
        """Draws JSON values as model files of a folder. Returns the exit code and the warnings about the file of each."""
        for i, value in enumerate(values):
            (folder / f"{i}.gltf").write_text(json.dumps(value))
        jobs = "".join(json.dumps({"id": i, "model": f"{i}.gltf"}) + "\n" for i in range(len(values)))
        done = subprocess.run([PROGRAM, "batch", "--jobs", "-", "--allow-path", ".", "-s", "8", "--samples", "1"], input=jobs, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=folder, timeout=600)
        answers = {answer["id"]: answer for answer in map(json.loads, done.stdout.splitlines())}
        self.assertEqual(len(answers), len(values), done.stderr[-500:])
        return [(answers[i]["exit"], {text.split(": ", 1)[1] for text in answers[i].get("warnings", []) if text.startswith(f"{i}.gltf: ")})
                for i in range(len(values))]

    def check(self, models, every):
        """Draws every n-th mutation of each model."""
        counts, wrong = collections.Counter(), collections.Counter()
        for number, model in enumerate(models):
            folder = self.folder / f"m{number}"
            folder.mkdir()
            value = unpacked(model, folder)
            cases = [case for i, case in enumerate(mutations(value)) if (i + number) % every == 0]
            (code, usual), *answers = self.draw(folder, [value] + [replaced(value, *case) for case in cases])
            self.assertEqual(code, 0, model)
            for (path, replacement), (code, warnings) in zip(cases, answers):
                kind, more = kind_of(path), sorted(warnings - usual)
                geometry = GEOMETRY.fullmatch(kind)
                self.assertTrue(code == 0 or (geometry and code in (2, 3)), (model, kind, replacement, code))
                counts["geometry" if geometry else "other", code == 0 and len(more) <= 1] += 1
                # Without the file's lights, the nodes that refer to them are wrong too.
                if not geometry and len(more) > 1 and kind not in ("extensions", "extensions.KHR_lights_punctual"):
                    wrong[kind, replacement, *more] += 1
        self.assertFalse(wrong)
        drawn = counts["other", True]
        self.assertGreaterEqual(drawn, 0.95 * (drawn + counts["other", False]))
        self.assertGreater(drawn, 20 * len(models) / every)
        print(f"# {dict(counts)}")

    def test_own(self):
        """The files that the fuzzer begins with: several features in each file."""
        self.check([ROOT / "tests/fuzz/corpus/gltf" / name for name in ("all.gltf", "lines.gltf", "triangle.gltf")], 1)

    def shared(self, count):
        models = [m for m in SHARED_MODELS.rglob("*.gl[tb]*") if m.stat().st_size < 200000 and not re.search("Negative|Compatibility|[dD]raco|found", str(m))]
        return sorted(models)[::max(1, len(models) // count)][:count]

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_shared(self):
        self.check(self.shared(10), 10)

    @long
    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_all_shared(self):
        self.check(self.shared(40), 1)
