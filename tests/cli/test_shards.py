# test_shards.py: --shard: many machines draw parts of one batch; exactly one machine draws each model, in any environment.
import json
import os
import re
import shutil
import subprocess
import urllib.parse

from harness import PROGRAM, ROOT
from test_batch import Batch, xxh64

VARIABLES = ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_STEP",
             "JOB_COMPLETION_INDEX", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE")


def shard_of(name, count):
    """docs/batch.md: XXH64 of the name's bytes, modulo the number of shards, plus 1."""
    return int(xxh64(name.encode())[6:], 16) % count + 1


class Shards(Batch):
    def setUp(self):
        super().setUp()
        for name in VARIABLES:
            os.environ.pop(name, None)

    def models(self, *words, code=0, env={}):
        """The models listed by a dry run."""
        done = subprocess.run([PROGRAM, "batch", *map(str, words), "--dry-run"], cwd=self.folder, capture_output=True,
                              env={**os.environ, **{key: str(value) for key, value in env.items()}})
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return [line.split(" -> ")[0] for line in done.stdout.decode().splitlines()] if not code else done.stderr.decode()

    def slurm(self, number, first, last, step=1, count=None):
        count = (last - first) // step + 1 if count is None else count
        return {"SLURM_ARRAY_TASK_ID": number, "SLURM_ARRAY_TASK_MIN": first, "SLURM_ARRAY_TASK_MAX": last,
                "SLURM_ARRAY_TASK_COUNT": count, "SLURM_ARRAY_TASK_STEP": step}

    # --- which models

    def test_every_model_once(self):
        names = self.tree(40)
        for count in (1, 2, 7, 100):
            parts = [self.models("in", "-o", "out/", "--shard", f"{k}/{count}") for k in range(1, count + 1)]
            self.assertEqual(sorted(sum(parts, [])), sorted(names))
            for k, part in enumerate(parts, 1):
                self.assertEqual(part, sorted(n for n in names if shard_of(n[len("in/"):], count) == k))

    def test_added_files_move_no_other(self):
        self.tree(20)
        before = {k: set(self.models("in", "-o", "out/", "--shard", f"{k}/5")) for k in range(1, 6)}
        for i in range(20):
            self.cube(f"in/c/n{i}.stl")
        for k in range(1, 6):
            after = set(self.models("in", "-o", "out/", "--shard", f"{k}/5"))
            self.assertEqual({n for n in after if "/c/" not in n}, before[k])

    def test_names(self):
        """Relative to the given folder, wherever it is; for lists and operands, the normalised path."""
        self.tree(12)
        for k in (1, 2, 3):
            shard = ["-o", "out/", "--shard", f"{k}/3"]
            here = [n[len("in/"):] for n in self.models("in", *shard)]
            self.assertEqual([n[len("in/"):] for n in self.models("in/", *shard)], here)
            self.assertEqual([n[len("./in/"):] for n in self.models("./in", *shard)], here)
            whole = str(self.folder / "in")
            self.assertEqual([n[len(whole) + 1:] for n in self.models(whole, *shard)], here)
        self.cube("x/y.stl")
        forms = ["x/y.stl", "./x/y.stl", "x//y.stl", "x/./y.stl", "x/../x/y.stl", "in/../x/y.stl", "in/a/../../x/y.stl"]
        for form in forms:
            drawn = [k for k in range(1, 10) if self.models(form, "-o", "out/", "--shard", f"{k}/9")]
            self.assertEqual(drawn, [shard_of("x/y.stl", 9)], form)
        (self.folder / "list").write_text("".join(n + "\n" for n in self.tree(12)))
        for k in (1, 2):
            self.assertEqual(self.models("@list", "-o", "out/", "--shard", f"{k}/2"),
                             [n for n in self.tree(12) if shard_of(n, 2) == k])

    def test_pictures_of_one_name_in_two_shards(self):
        self.cube("a/m.stl")
        self.cube("b/m.stl")
        self.assertNotEqual(shard_of("a/m.stl", 7), shard_of("b/m.stl", 7))
        for k in range(1, 8):
            self.assertIn("both be written", self.models("a/m.stl", "b/m.stl", "-o", "out/", "--shard", f"{k}/7", code=1))

    # --- where the number comes from

    def test_written(self):
        self.tree(2)
        for text in ("0/2", "3/2", "1/0", "2", "", "/2", "1/", "-1/2", "1/2/3", "a/2", "auto/", "auto/0", "auto/x", "autos", "1/99999999"):
            self.assertIn("--shard", self.models("in", "-o", "out/", "--shard", text, code=1), text)

    def auto(self, env, text="auto", code=0):
        self.tree(30)
        return self.models("in", "-o", "out/", "--shard", text, env=env, code=code)

    def test_slurm(self):
        expected = [self.models("in", "-o", "out/", "--shard", f"{k}/4") if self.tree(30) else None for k in range(1, 5)]
        for first, step in ((0, 1), (1, 1), (0, 5), (1, 2)):
            ids = range(first, first + 4 * step, step)
            self.assertEqual([self.auto(self.slurm(i, first, ids[-1], step)) for i in ids], expected)
        self.assertEqual([self.auto(self.slurm(i, 0, 3), "auto/4") for i in range(4)], expected)
        without = self.slurm(2, 0, 3)
        del without["SLURM_ARRAY_TASK_STEP"]
        self.assertEqual(self.auto(without), expected[2])
        # Resubmitted tasks keep their part if its number is given, and are refused otherwise.
        again = self.slurm(3, 1, 3, 2)
        self.assertEqual(self.auto(again, "auto/4"), expected[3])
        for env in (self.slurm(17, 17, 17), self.slurm(2, 2, 3), self.slurm(3, 0, 7, 1, 3), self.slurm(9, 0, 3), self.slurm(1, 0, 4, 2),
                    self.slurm(0, 0, 0, 1, 0), self.slurm("x", 0, 3), self.slurm(-1, 0, 3)):
            self.assertIn("--shard", self.auto(env, code=1), env)
        self.assertIn("is 4, expected 0 to 3", self.auto(self.slurm(4, 1, 4), "auto/4", code=1))  # counted from 1: otherwise the first part would be missing
        for name in ("SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_COUNT"):
            env = self.slurm(1, 0, 3)
            del env[name]
            self.assertIn(name + " is not set", self.auto(env, code=1))

    def test_kubernetes(self):
        expected = [self.models("in", "-o", "out/", "--shard", f"{k}/3") if self.tree(30) else None for k in (1, 2, 3)]
        self.assertEqual([self.auto({"JOB_COMPLETION_INDEX": i}, "auto/3") for i in range(3)], expected)
        self.assertIn("--shard auto/N", self.auto({"JOB_COMPLETION_INDEX": 1}, code=1))
        self.assertIn("is 3, expected 0 to 2", self.auto({"JOB_COMPLETION_INDEX": 3}, "auto/3", code=1))

    def test_open_mpi(self):
        expected = [self.models("in", "-o", "out/", "--shard", f"{k}/3") if self.tree(30) else None for k in (1, 2, 3)]
        for text in ("auto", "auto/3"):
            self.assertEqual([self.auto({"OMPI_COMM_WORLD_RANK": i, "OMPI_COMM_WORLD_SIZE": 3}, text) for i in range(3)], expected)
        self.assertIn("OMPI_COMM_WORLD_SIZE", self.auto({"OMPI_COMM_WORLD_RANK": 0}, code=1))
        self.assertIn("OMPI_COMM_WORLD_SIZE is 2", self.auto({"OMPI_COMM_WORLD_RANK": 0, "OMPI_COMM_WORLD_SIZE": 2}, "auto/3", code=1))
        self.auto({"OMPI_COMM_WORLD_RANK": 2, "OMPI_COMM_WORLD_SIZE": 2}, code=1)

    def test_doubt(self):
        """No answer and two answers are errors; without --shard, the environment is ignored."""
        self.assertIn("none of", self.auto({}, code=1))
        both = {**self.slurm(0, 0, 1), "OMPI_COMM_WORLD_RANK": 0, "OMPI_COMM_WORLD_SIZE": 2}
        self.assertIn("both", self.auto(both, code=1))
        self.assertEqual(len(self.models("in", "-o", "out/", env=both)), 30)

    def test_kubernetes_example(self):
        """Its command draws every model once, and a failed model does not make a pod fail."""
        text = (ROOT / "examples" / "kubernetes-job.yaml").read_text()
        words = [word.strip().strip('"') for word in re.search(r"(?s)command: \[(.*?)\]", text).group(1).split(",")]
        completions = int(re.search(r"completions: (\d+)", text).group(1))
        self.assertEqual(words[words.index("--shard") + 1], f"auto/{completions}")
        for field in ("completionMode: Indexed", "backoffLimitPerIndex: ", "action: Ignore", "type: DisruptionTarget", "restartPolicy: Never"):
            self.assertIn(field, text)
        names = self.tree(20)
        (self.folder / names[4]).write_bytes(b"")
        words = [re.sub("^/(?=models|pictures)", f"{self.folder}/", word).replace("/models", "/in") for word in words]
        for i in range(completions):
            done = self.run_program(*words[1:], env={"JOB_COMPLETION_INDEX": str(i)})
            self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertEqual(len(self.pictures("pictures")), 19)

    # --- parts of a list

    def parts(self, count, *words, code=0):
        return [self.models("@list", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/{count}", "--shard-by", "list", *words, code=code)
                for k in range(1, count + 1)]

    def test_parts_of_a_list(self):
        """Each name is in exactly one part, in the list's order, for any borders of the parts; empty lines are ignored."""
        names = sorted(f"{folder}/{'m' * (i % 7)}{i:02}.stl" for folder in ("a", "b") for i in range(20))
        for text in ("".join(n + "\n" for n in names), "\r\n".join(names), "\n\n" + "\n\n\n".join(names) + "\n\n"):
            (self.folder / "list").write_text(text, newline="")
            for count in (1, 2, 7, 39):
                found = self.parts(count)
                self.assertEqual(sum(found, []), names)
                self.assertLessEqual(max(map(len, found)), len(names) / count * 2 + 1)
        (self.folder / "list").write_text("")
        self.assertEqual(self.parts(2), [[], []])

    def test_a_part_reads_only_its_bytes(self):
        """A sparse file of 8 GB, which a test cannot read completely in the available time."""
        lines, part = [b"a/%05d.stl\n" % i for i in range(6000)], 1 << 14  # bytes
        with open(self.folder / "list", "wb") as file:
            file.seek((4 << 30) - 2 * part)
            file.write(b"\n" + b"".join(lines))
            file.truncate(8 << 30)
        drawn = self.models("@list", "-o", "out/{stem}.png", "--shard", f"{(1 << 18) + 1}/{1 << 19}", "--shard-by", "list")
        first = -(-(2 * part - 1) // len(lines[0]))  # the first line that begins in the part
        self.assertEqual(drawn, [line[:-1].decode() for line in lines[first:-(-(3 * part - 1) // len(lines[0]))]])

    def test_the_order_of_a_list(self):
        """No shard sees all names. Their order guarantees that no two pictures share a name, also at the borders of parts."""
        for lines, says in ((["a/1.stl", "a/3.stl", "a/2.stl", "a/4.stl"], "'out/a/2.png' comes after 'out/a/3.png'"),
                            (["a/1.stl", "a/2.obj", "a/2.stl", "a/4.stl"], "would both be written to 'out/a/2.png'"),
                            (["a/1.stl", "a/2.stl", "a/2.stl", "a/4.stl"], "'a/2.stl' is listed twice")):
            (self.folder / "list").write_text("\n".join(lines))
            for count in (1, 2, 4):
                done = [self.run_program("batch", "@list", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/{count}", "--shard-by", "list", "--dry-run")
                        for k in range(1, count + 1)]
                self.assertEqual(sum(d.returncode == 1 and says in d.stderr.decode() for d in done), 1, (lines, count))
        (self.folder / "list").write_text("a/1.stl\n")
        self.assertIn("divides a single list", self.models("b/2.stl", "@list", "--shard", "1/2", "--shard-by", "list", code=1))
        self.assertIn("divides a single list", self.models("@list", "@list", "--shard", "1/2", "--shard-by", "list", code=1))
        self.assertIn("not a regular file", self.models("-", "--shard", "1/2", "--shard-by", "list", code=1))
        self.assertIn("requires --shard", self.models("@list", "--shard-by", "list", code=1))

    def test_the_list_of_the_documentation(self):
        """The documented command sorts any names by their pictures; shards of that list draw each model once."""
        names = ["models/b/bolt.stl", "models/b/bolt.m5.stl", "models/b/bolt.a.stl", "models/b/bolt.z.stl", "models/b-c/x.stl", "models/b/bolt-2.stl", "models/a.stl"]
        for name in names:
            self.cube(name)
        page = (ROOT / "docs" / "scale.md").read_text()
        make, draw = re.search(r"    (lambent batch models .* > list)\n    (lambent batch @list .*)\n", page).groups()
        path = os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]
        subprocess.run(make, shell=True, cwd=self.folder, check=True, env={**os.environ, "PATH": path})
        self.assertEqual(sorted((self.folder / "list").read_text().split()), sorted(names))
        found = [self.models(*draw.replace("17/2000", f"{k}/3").replace("'", "").split()[2:]) for k in (1, 2, 3)]
        self.assertEqual(sorted(sum(found, [])), sorted(names))

    def test_a_list_that_has_changed(self):
        names = self.tree(6)
        (self.folder / "list").write_text("\n".join(sorted(names)))
        words = ["@list", "-o", "out/{dir}/{stem}.png", "--shard-by", "list"]
        for k in (1, 2):
            self.batch(*words, "--shard", f"{k}/2")
        self.assertEqual(len(self.pictures()), 6)
        self.assertIn("0 of 3 pictures written, 3 done before", self.batch(*words, "--shard", "2/2", "--resume").stderr.decode())
        (self.folder / "list").write_text("\n".join(sorted(names + ["in/a/m00.stl"])))
        self.assertIn("--shard-by list of", self.batch(*words, "--shard", "2/2", "--resume", code=1).stderr.decode())

    # --- the run

    def header(self, path):
        return json.loads((self.folder / path).read_text().splitlines()[0])

    def test_run(self):
        """Shards draw the pictures of one run, each with its own journal and page."""
        names = self.tree(9)
        self.batch("in", "-o", "one/{dir}/{stem}.png")
        for k in (1, 2, 3):
            done = self.batch("in", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/3", "--report", "pages/p.html")
            count = sum(shard_of(n[len("in/"):], 3) == k for n in names)
            self.assertIn(f"shard {k}/3: {count} of {count} pictures written", done.stderr.decode())
        self.assertEqual(self.pictures("out"), self.pictures("one"))
        self.assertEqual({n for n in self.files() if not n.endswith(".png")}, {f"lambent-{k}-of-3.jsonl" for k in (1, 2, 3)})
        self.assertEqual({n for n in self.files("pages") if "/" not in n}, {f"p-{k}-of-3.html" for k in (1, 2, 3)})
        records = sum((self.journal(f"out/lambent-{k}-of-3.jsonl") for k in (1, 2, 3)), [])
        self.assertEqual(sorted(r["model"] for r in records), sorted(names))
        self.assertEqual(self.header("out/lambent-2-of-3.jsonl")["shard"], "2/3")
        self.assertEqual(self.header("out/lambent-2-of-3.jsonl")["pictures"], len(self.journal("out/lambent-2-of-3.jsonl")))

    def test_resume(self):
        self.tree(9)
        for k in (1, 2):
            self.batch("in", "-o", "out/{stem}.png", "--shard", f"{k}/2", "--journal", "j/log.jsonl")
        done = self.batch("in", "-o", "out/{stem}.png", "--shard", "2/2", "--journal", "j/log.jsonl", "--resume")
        self.assertIn("0 of", done.stderr.decode())
        self.assertEqual(self.files("j"), {"log-1-of-2.jsonl", "log-2-of-2.jsonl"})

    def test_another_number_of_shards(self):
        """The option would assign models to other shards than those that drew them."""
        self.tree(3)
        self.batch("in", "-o", "out/", "--shard", "03/12")
        self.assertTrue((self.folder / "out/lambent-03-of-12.jsonl").exists())
        done = self.batch("in", "-o", "out/", "--shard", "1/2", code=1)
        self.assertIn("lambent-03-of-12.jsonl belongs to a run with 12 shards", done.stderr.decode())
        self.assertEqual(len(self.pictures()), len(self.journal("out/lambent-03-of-12.jsonl")))
        self.batch("in", "-o", "out/", "--shard", "4/12")

    def test_a_shard_without_models(self):
        self.cube("in/m.stl")
        empty = 1 + shard_of("m.stl", 2) % 2
        done = self.batch("in", "-o", "out/", "--shard", f"{empty}/2", "--report", "p.html")
        self.assertIn("0 of 0 pictures", done.stderr.decode())
        self.assertEqual(self.pictures(), {})
        self.assertEqual(self.header(f"out/lambent-{empty}-of-2.jsonl")["pictures"], 0)
        self.batch("in", "-o", "out/", "--shard", f"{empty}/2", "--resume", "--isolate")

    def test_render(self):
        """`lambent A B` uses the same loop."""
        names = self.tree(6)
        for k in (1, 2):
            self.run_program(*names, "-s", 24, "-o", "out/", "--shard", f"{k}/2", "--journal", "log.jsonl")
        self.assertEqual(len(self.pictures()), 6)
        self.assertEqual(len(self.journal("log-1-of-2.jsonl") + self.journal("log-2-of-2.jsonl")), 6)


class Merge(Batch):
    """`lambent journal`: combines the journals of a batch."""

    def sum(self, *words, code=0):
        done = self.run_program("journal", *words)
        self.assertEqual(done.returncode, code, done.stdout.decode() + done.stderr.decode())
        return done.stdout.decode() if code in (0, 7) else done.stderr.decode()

    def shards(self, count=3, numbers=None, models=9, broken=(4,), *more):
        names = self.tree(models)
        for i in broken:
            (self.folder / names[i]).write_bytes(b"")
        for k in numbers or range(1, count + 1):
            self.run_program("batch", "in", "-s", 24, "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/{count}", *more)
        return names

    def test_sum(self):
        names = self.shards()
        text = self.sum("out", code=7)
        self.assertIn("8 of 9 pictures written, 1 failed (cannot-read 1); 3 journals; ", text)
        self.assertIn(names[4] + ": ", text)
        report = json.loads(self.sum("--json", *sorted((self.folder / "out").glob("*.jsonl")), code=7))
        self.assertEqual([report[key] for key in ("whole", "pictures", "written", "failed", "classes", "shards", "missing_shards", "in_two_journals")],
                         [True, 9, 8, 1, {"cannot-read": 1}, 3, [], 0])
        self.assertEqual([(part["shard"], part["ended"]) for part in report["journals"]], [(1, True), (2, True), (3, True)])
        self.assertEqual(sum(part["written"] for part in report["journals"]), 8)
        times = sorted(r["times_ms"]["total"] for k in (1, 2, 3) for r in self.journal(f"out/lambent-{k}-of-3.jsonl") if r["class"] == "ok")
        self.assertAlmostEqual(report["times_ms"]["total"], sum(times), places=1)
        for key, at in (("median", 4), ("percent_90", 7), ("longest", 7)):
            self.assertAlmostEqual(report["times_ms"][key], times[at], places=2)
        self.assertEqual(self.sum("out", "-q", code=7), "")
        self.cube(names[4])
        for k in (1, 2, 3):
            self.batch("in", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/3", "--resume", "--retry-failed", 1)
        self.assertTrue(self.sum("out/").startswith("9 of 9 pictures written; 3 journals"))

    def test_what_is_missing(self):
        self.shards(4, (1, 3), broken=())
        text = self.sum("out", code=7)
        self.assertIn("shard 2/4 has no journal\nshard 4/4 has no journal\n", text)
        self.assertEqual(json.loads(self.sum("out", "--json", code=7))["missing_shards"], [2, 4])
        # The journal of a killed run has no final line, and another line may be truncated.
        for k in (2, 4):
            self.batch("in", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/4")
        self.sum("out")
        path = self.folder / "out/lambent-3-of-4.jsonl"
        lines = path.read_text().splitlines(True)
        self.assertEqual(json.loads(lines[-1]), {"ended": True, "exit": 0})
        path.write_text("".join(lines[:-2]) + lines[-2][:40])
        text = self.sum("out", code=7)
        self.assertIn(f"out/lambent-3-of-4.jsonl: the run has not ended: {len(lines) - 3} of {len(lines) - 2} pictures\n8 of 9 pictures", text)
        self.batch("in", "-o", "out/{dir}/{stem}.png", "--shard", "3/4", "--resume")
        self.sum("out")

    def test_a_picture_in_two_journals(self):
        self.shards(2, broken=())
        one, two = self.folder / "out/lambent-1-of-2.jsonl", self.folder / "out/lambent-2-of-2.jsonl"
        line = next(line for line in two.read_text().splitlines(True) if '"output"' in line)
        one.write_text(one.read_text() + line)
        output = json.loads(line)["output"]
        self.assertIn(f"1 picture is in two journals: {output} is in out/lambent-1-of-2.jsonl and in out/lambent-2-of-2.jsonl", self.sum("out", code=7))
        self.assertEqual(json.loads(self.sum("out", "--json", code=7))["written"], 9)  # it counts once

    def test_merged(self):
        """A run without shards can continue the merged journal."""
        names = self.shards(broken=())
        self.sum("out", "-o", "out/lambent.jsonl")
        self.assertEqual(sorted(r["model"] for r in self.journal()), sorted(names))
        self.assertIn("0 of 9 pictures written, 9 done before", self.batch("in", "-o", "out/{dir}/{stem}.png", "--resume").stderr.decode())
        self.assertIn("9 unchanged", self.batch("in", "-o", "out/{dir}/{stem}.png", "--skip-same").stderr.decode())
        self.assertEqual(self.sum("out", "-o", "-").count('"output"'), 9)  # the journals of the shards, not the merged one
        self.assertIn("9 of 9", self.sum("out/lambent.jsonl"))

    def test_latest_line_counts(self):
        names = self.shards(2)
        shutil.copy(self.folder / names[0], self.folder / names[4])
        for k in (1, 2):
            self.batch("in", "-o", "out/{dir}/{stem}.png", "--shard", f"{k}/2", "--resume", "--retry-failed", 1)
        report = json.loads(self.sum("out", "--json"))
        self.assertEqual((report["written"], report["failed"], report["classes"]), (9, 0, {}))

    def test_page(self):
        names = self.shards()
        self.sum("out", "--report", "all.html", code=7)
        page = (self.folder / "all.html").read_text()
        self.assertIn("<h1>8 of 9 pictures</h1>", page)
        self.assertEqual(page.count("<figure>"), 8)
        self.assertEqual(page.count('<li><b class="bad">'), 1)
        for address in re.findall(r'(?:href|src)="([^"]*)"', page):
            self.assertTrue((self.folder / urllib.parse.unquote(address)).is_file(), address)
        self.assertLess(page.index(names[4]), page.index(names[0]))
        self.assertEqual(len(self.files("all-files")), 8)

    def test_names_that_are_not_utf8(self):
        self.cube("in/m.stl")
        os.rename(self.folder / "in/m.stl", os.fsencode(self.folder) + b"/in/\xe9\xff.stl")
        self.batch("in", "-o", "out/")
        self.sum("out", "--report", "all.html")
        address = re.search(r'href="([^"]*)"', (self.folder / "all.html").read_text()).group(1)
        self.assertTrue(os.path.isfile(os.fsencode(self.folder) + b"/" + urllib.parse.unquote_to_bytes(address)), address)
        self.assertEqual(len(self.files("all-files")), 1)

    def test_what_it_refuses(self):
        self.shards(2, broken=())
        (self.folder / "notes").write_text("hello\n")
        (self.folder / "empty").mkdir()
        for words, says, code in ((["out", "notes"], "expected a journal of lambent", 1), (["empty"], "found no journal", 2),
                                  (["none.jsonl"], "cannot read the journal", 2), (["out", "out"], "the same shard", 1), ([], "", 1),
                                  (["out", "-o", "-", "--json"], "both write", 1), (["out", "-o", "/proc/none.jsonl"], "/proc/none", 5)):
            self.assertIn(says, self.sum(*words, code=code))
        self.batch("in", "-o", "other/{stem}.png", "--shard", "1/3")
        self.assertIn("2 shards, and 3", self.sum("out", "other", code=1))
        self.batch("in", "-o", "third/{dir}/{stem}.png", "--shard", "2/2", "--journal", "third/x.jsonl", "--tone", "aces")
        self.assertIn("--tone", self.sum("out/lambent-1-of-2.jsonl", "third/x-2-of-2.jsonl", code=1))
