"""cells.py: the cells of the table of artefacts (tests/long/table.py). A test prints a line for each of its cells; the table collects them."""
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What each column of formats draws; the files beside the model follow it.
MODELS = {"glTF": ["examples/models/spot.glb"], "OBJ with texture": ["examples/tiles/tiles.obj", "examples/tiles/tiles.mtl", "examples/tiles/tiles.png"],
          "PLY": ["tests/models/cube.ply"], "STL": ["tests/models/cube.stl"], "3MF": ["tests/fuzz/corpus/3mf/deflated.3mf"], "Draco": ["tests/fuzz/corpus/gltf/draco.gltf"]}
SIZE = 96


def tell(row, column, state):
    """`state`: "yes", "no", "refused" (the page says so), or "not run: REASON"."""
    print("cell: %s | %s | %s" % (row, column, state), flush=True)


def skip(row, reason, columns=()):
    for column in ["installs", *MODELS, *columns]:
        tell(row, column, "not run: " + reason)


def fill(program, folder):
    """Copies the models to FOLDER, and draws the picture MODEL.expected of each by the program of the build."""
    for paths in MODELS.values():
        for path in paths:
            shutil.copy(ROOT / path, folder)
        name = pathlib.Path(paths[0]).name
        subprocess.run([program, name, "-q", "-s", str(SIZE), "-o", "expected.png"], cwd=folder, check=True)
        (folder / "expected.png").rename(folder / (name + ".expected"))


def draw_all(row, program, folder, draw, refused=()):
    """`draw(model, picture)` draws in FOLDER and returns an exit code. Returns the formats whose picture differs from the program's."""
    fill(program, folder)
    wrong = []
    for column, paths in MODELS.items():
        name = pathlib.Path(paths[0]).name
        code = draw(name, "own.png")
        same = code == 0 and (folder / "own.png").exists() and (folder / "own.png").read_bytes() == (folder / (name + ".expected")).read_bytes()
        state = "yes" if same else "refused" if code == 3 and column in refused else "no"
        tell(row, column, state)
        wrong += [column] * (state == "no")
        (folder / "own.png").unlink(missing_ok=True)
    return wrong
