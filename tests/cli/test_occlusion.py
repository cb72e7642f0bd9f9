# test_occlusion.py: --ao rays and related options.
import array
import json
import unittest

from harness import Case, SHARED_MODELS, pixel

SCENE = {"lambent": 1, "image": {"size": [48, 48], "samples": 1}, "ambient": [1, 1, 1], "lights": [], "ao": "rays", "ao_radius": 0.5, "ao_samples": 24,
         "objects": [{"shape": "plane", "transform": [["scale", 4, 1, 4]]},
                     {"shape": "cube", "transform": [["translate", 0, 1, 0]]}]}


class Occlusion(Case):
    def scene(self, name="rays.json", **more):
        (self.folder / name).write_text(json.dumps({**SCENE, **more}))
        return name

    def test_scene_and_options(self):
        drawn = self.png(self.scene())
        self.assertEqual(self.png(self.scene("auto.json", ao="auto", ao_radius=0.1, ao_samples=1), "--ao", "rays", "--ao-radius", "0.5", "--ao-samples", "24"), drawn)
        self.assertNotEqual(self.png(self.scene(), "--ao-samples", "25"), drawn)
        self.assertNotEqual(self.png(self.scene(), "--ao", "off"), drawn)
        self.assertEqual(self.png(self.scene(), "--save-scene", "saved.json"), drawn)
        saved = json.loads((self.folder / "saved.json").read_text())
        self.assertEqual((saved["ao"], saved["ao_radius"], saved["ao_samples"]), ("rays", 0.5, 24))
        self.assertEqual(self.png("saved.json"), drawn)

    def test_every_isa_and_thread_count(self):
        self.assertEqual(self.png(self.scene(), "--isa", "scalar", "--threads", "1"), self.png(self.scene(), "--threads", "3"))

    def test_explained_and_shown(self):
        shown = self.png(self.scene(), "--show", "ao")
        shares = set()
        covered = [(x, y) for y in range(48) for x in range(48) if pixel(shown, x, y)[3]]
        for x, y in covered[:: len(covered) // 6]:
            point = json.loads(self.good("explain", self.scene(), "%d,%d" % (x, y), "--json").stdout)["triangles"][0]["points"][0]
            shares.add(point["unoccluded"])
            self.assertAlmostEqual(point["unoccluded"] * 24, round(point["unoccluded"] * 24), places=5)
            self.assertEqual(pixel(shown, x, y)[0], int(255 * point["unoccluded"] + 0.5))
        self.assertGreater(len(shares), 1)

    def test_counts(self):
        report = self.report(self.scene())
        self.assertEqual(report["counts"]["rays"], 24 * report["counts"]["points_lit"])
        self.assertGreater(report["times_ms"]["steps"]["hierarchy"], 0)
        self.assertEqual(self.report(self.scene(), "--ao", "screen")["counts"]["rays"], 0)

    def report(self, *arguments):
        return json.loads(self.good(*arguments, "-o", "out.png", "--json").stdout)

    def test_what_is_refused(self):
        self.bad(1, self.scene(), "--ao-samples", "0", says="1 to 1024")
        self.bad(1, self.scene(), "--ao", "ray", says="rays")
        self.bad(1, self.scene(), "--shading", "flat", says="Phong shading")
        self.bad(2, self.scene("bad.json", ao_samples=2000), says="ao_samples")
        self.bad(3, self.scene(), "--device", "gl", says=("OpenGL",))

    def shares(self, model, *words):
        """A number for each pixel of `--show ao`, or of another quantity."""
        self.good(model, "-q", "-s", "640", "--samples", "1", "--show", "ao", *words, "-o", "a.pfm")
        return array.array("f", (self.folder / "a.pfm").read_bytes().split(b"\n", 3)[3])[::3]

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_screen_beside_rays(self):
        for name in ("glb/kenney_city/building-small-a.glb", "glb/kenney_city/pavement-fountain.glb", "ply/trimesh/featuretype.ply", "obj/kaykit_dungeon/chest_gold.obj"):
            model = str(SHARED_MODELS / name)
            depth, screen, rays = self.shares(model, "--show", "depth"), self.shares(model, "--ao", "screen"), self.shares(model, "--ao", "rays")
            apart = [255 * (s - r) for s, r, d in zip(screen, rays, depth) if d > 0]
            count = len(apart)
            found = ((sum(a * a for a in apart) / count) ** 0.5, sum(a < -25 for a in apart) / count, sum(a > 25 for a in apart) / count)
            self.assertTrue(found[0] <= 12 and found[1] <= 0.01 and found[2] <= 0.03, (name, found))
            self.assertLessEqual(max(self.shares(model)), 1)  # cavity shading lightens nothing

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_rays_start_in_the_triangle(self):
        """Smooth normals move the starts of shadow rays, but not of these."""
        model = str(SHARED_MODELS / "obj/kaykit_dungeon/shelf_small_candles.obj")
        words = ("-s", "64", "--show", "ao", "--ao", "rays", "--ao-samples", "8")
        self.assertEqual(self.png(model, *words), self.png(model, *words, "--normals", "facet"))
