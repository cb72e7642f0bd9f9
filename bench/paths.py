"""paths.py: the folders of the bench."""
import os

BENCH = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(BENCH)
OUT = os.path.join(ROOT, "build-bench")  # its own build of everything, models, scenes, pictures; ignored by git
RESULTS = os.path.join(BENCH, "results")
PICTURES = os.path.join(OUT, "pictures")
LAMBENT = os.path.join(OUT, "lambent")
MODELS = os.path.join(OUT, "models")  # made by the bench
EXAMPLES = os.path.join(ROOT, "examples", "models")
REAL_MODELS = os.environ.get("LAMBENT_MODELS") and os.path.abspath(os.environ["LAMBENT_MODELS"])  # a folder of other models, of which there are rows too; None: only those above


def program(name):
    return os.path.join(OUT, "bench", "bench-" + name)
