# test_furnace.py: the white furnace: how much of a uniform white environment each lobe and layer of physical materials returns, by the
# split sum, by its own lobes (--reference) and by paths of light (--bounces 1). The table of docs/lighting/environment.md contains the first
# two numbers; with the words `--write LAMBENT`, this file writes the table.
import os
import struct
import sys

if __name__ == "__main__":
    os.environ["LAMBENT"] = os.path.abspath(sys.argv[-1])
from harness import ROOT, Case

COSINES = (1, 0.7, 0.5, 0.3, 0.2)
# Name, material, the largest relative difference between the split sum and the integral. The page explains the rows above 0.05.
ROWS = [
    ("matt dielectric", "white,physical=yes,roughness=1", 0.05),
    ("smooth dielectric", "white,physical=yes,roughness=0.2", 0.21),
    ("highlight of a dielectric alone", "black,physical=yes,roughness=0.4", 0.05),
    ("the same, ior 2, specular_weight 0.5", "black,physical=yes,roughness=0.4,ior=2,specular_weight=0.5", 0.05),
    ("metal, roughness 0.1", "white,metallic=1,roughness=0.1", 0.05),
    ("metal, roughness 0.5", "white,metallic=1,roughness=0.5", 0.05),
    ("metal, roughness 1", "white,metallic=1,roughness=1", 0.05),
    ("brushed metal, anisotropy 0.5, roughness 0.3", "white,metallic=1,anisotropy=0.5,roughness=0.3", 0.05),
    ("brushed metal, anisotropy 0.9, roughness 0.3", "white,metallic=1,anisotropy=0.9,roughness=0.3", 0.05),
    ("brushed metal, anisotropy 1, roughness 0.1", "white,metallic=1,anisotropy=1,roughness=0.1", 0.05),
    ("coat alone, roughness 0.05", "black,physical=yes,specular_weight=0,clearcoat=1,clearcoat_roughness=0.05", 0.05),
    ("coat alone, roughness 0.5", "black,physical=yes,specular_weight=0,clearcoat=1,clearcoat_roughness=0.5", 0.05),
    ("smooth coat on a matt base", "white,physical=yes,roughness=1,clearcoat=1,clearcoat_roughness=0.05", 0.05),
    ("sheen alone, roughness 0.3", "black,physical=yes,specular_weight=0,sheen_color=white,sheen_roughness=0.3", 0.05),
    ("sheen on a matt base", "white,physical=yes,roughness=1,sheen_color=white,sheen_roughness=0.5", 0.16),
    ("thin film on grey metal, 400 nm", "#bcbcbc,metallic=1,roughness=0.3,iridescence=1,iridescence_thickness_max=400", 0.18),
    ("glass: transmission 1", "white,physical=yes,roughness=0.2,transmission=1", 0.05),
]
BEGIN, END = "<!-- furnace: made by tests/cli/test_furnace.py -->\n", "<!-- end of furnace -->"
PAGE = ROOT / "docs/lighting/environment.md"


class Furnace(Case):
    def pixels(self, *words):
        self.good("sphere", "--segments", "200x100", "--projection", "orthographic", "-s", 48, "--samples", 1, "--ao", "off",
                  "-q", "-o", "out.pfm", *words)
        data = (self.folder / "out.pfm").read_bytes()
        numbers = struct.unpack("<%df" % (48 * 48 * 3), data[-48 * 48 * 12:])
        return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]

    def table(self):
        """For each row, the green channel at each cosine: the split sum, the integral and paths of light."""
        (self.folder / "white.pfm").write_bytes(b"PF\n64 32\n-1.0\n" + struct.pack("<f", 1) * (64 * 32 * 3))
        normals = self.pixels("--show", "normals")
        rings = [[i for i, n in enumerate(normals) if any(n) and abs(n[2] - c) < 0.03] for c in COSINES]
        for name, material, most in ROWS:
            all_three = []
            for words in ((), ("--reference", 4096), ("--bounces", 1, "--paths", 256)):
                green = self.pixels("--material", material, "--environment", "white.pfm", "--exposure", 0, "--tone", "none",
                                    "--specular-aa", "off", "--background", "black", *words)
                all_three.append([sum(green[i][1] for i in ring) / len(ring) for ring in rings])
            yield name, most, all_three

    def lines(self, table):
        yield "| surface | " + " | ".join("n·v = %g" % c for c in COSINES) + " |"
        yield "|---|" + "---|" * len(COSINES)
        for name, _, (split, exact, _) in table:
            yield "| %s | %s |" % (name, " | ".join("%.3f (%.3f)" % pair for pair in zip(split, exact)))

    def test_table(self):
        table = list(self.table())
        for name, most, (split, exact, paths) in table:
            for c, a, b, traced in zip(COSINES, split, exact, paths):
                # Sharp lobes are traced from several positions within a pixel, where the angle differs.
                self.assertLess(abs(traced - b) / max(b, 0.05), 0.03, f"{name}, n.v {c}: paths find {traced:.4f}, the integral is {b:.4f}")
                self.assertLess(abs(a - b) / max(b, 0.05), most, f"{name}, n.v {c}: the split sum is {a:.4f}, the integral {b:.4f}")
        self.assertIn(BEGIN + "\n".join(self.lines(table)) + "\n" + END, PAGE.read_text(),
                      "the table of the page is old: python3 tests/cli/test_furnace.py --write LAMBENT")

    def write(self):
        self.setUp()
        before, rest = PAGE.read_text().split(BEGIN, 1)
        PAGE.write_text(before + BEGIN + "\n".join(self.lines(self.table())) + "\n" + END + rest.split(END, 1)[1])
        self.doCleanups()


if __name__ == "__main__":
    Furnace().write()
