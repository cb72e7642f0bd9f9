"""paths.py: where the bench finds things and puts them."""
import os

BENCH = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(BENCH)
OUT = os.path.join(ROOT, "build-bench")  # its own build of everything, models, scenes, pictures; ignored by git
RESULTS = os.path.join(BENCH, "results")
PICTURES = os.path.join(OUT, "pictures")
LAMBENT = os.path.join(OUT, "lambent")
# Real models lie beside the checkout, or where this says.
REAL_MODELS = os.environ.get("LAMBENT_MODELS", os.path.join(ROOT, "..", "shared", "models"))


def program(name):
    return os.path.join(OUT, "bench", "bench-" + name)
