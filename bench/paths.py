"""paths.py: the folders of the bench."""
import os

BENCH = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(BENCH)
OUT = os.path.join(ROOT, "build-bench")  # its own build of everything, models, scenes, pictures; ignored by git
RESULTS = os.path.join(BENCH, "results")
PICTURES = os.path.join(OUT, "pictures")
LAMBENT = os.path.join(OUT, "lambent")
# The folder of real models, by default next to the checkout.
REAL_MODELS = os.environ.get("LAMBENT_MODELS", os.path.join(ROOT, "..", "shared", "models"))


def program(name):
    return os.path.join(OUT, "bench", "bench-" + name)
