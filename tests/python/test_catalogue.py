"""test_catalogue.py: lambent-catalogue (docs/catalogue.md): folders, a real store behind a proxy that breaks requests, lists, kills and Dask."""
import collections
import contextlib
import io
import json
import os
import pathlib
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
from unittest import mock

try:
    import boto3  # noqa: F401
    from lambent.catalogue import __main__ as command, drawing, engine, stores
    MISSING = None
except ImportError as error:
    MISSING = "python3-boto3 is not installed (%s)" % error
import hosts
import store

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONG = os.environ.get("LAMBENT_LONG") == "all"
PROGRAM = os.environ.get("LAMBENT", "lambent")
QUAD = "v 0 0 0\nv 1 0 0\nv 1 %g 0\nv 0 1 %g\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"


def command_line(*words):
    return [sys.executable, "-m", "lambent.catalogue", *words]


def catalogue(*words, **env):
    """Runs the command in this process. Returns the exit code, the output and the messages."""
    out, err = io.StringIO(), io.StringIO()
    before = signal.getsignal(signal.SIGTERM)
    with mock.patch.dict(os.environ, env), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        stores.store_named.cache_clear()
        try:
            code = command.main(words)
        finally:
            signal.signal(signal.SIGTERM, before)
    return code, out.getvalue(), err.getvalue()


def batch(*words):
    return subprocess.run([PROGRAM, "batch", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def make_models(folder, count):
    """Small OBJ files in three folders, and models with other files: MTL and a texture, and glTF with a buffer whose name has a space."""
    folder = pathlib.Path(folder)
    for i in range(count):
        path = folder / "abc"[i % 3] / ("m%04d.obj" % i)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(QUAD % (1 + i % 7, i / count) + "f 1 2 3 4\n")
    (folder / "d e" / "tex").mkdir(parents=True)
    subprocess.run([PROGRAM, "cube", "-s", "16", "-b", "red", "-o", folder / "d e" / "tex" / "t.png", "-q"], check=True)
    (folder / "d e" / "x.obj").write_text("mtllib x.mtl\n" + QUAD % (1, 0) + "usemtl a\nf 1/1 2/2 3/3 4/4\n")
    (folder / "d e" / "x.mtl").write_text("newmtl a\nmap_Kd tex/t.png\n")
    (folder / "d e" / "y z.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
    (folder / "d e" / "y.gltf").write_text(json.dumps({
        "asset": {"version": "2.0"}, "buffers": [{"uri": "y%20z.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}))
    # A texture in a comment of a PLY file: no pattern finds its name, so the worker's answer does.
    (folder / "d e" / "w.ply").write_text("ply\nformat ascii 1.0\ncomment TextureFile tex/t.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                          "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                          "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n")
    return folder


def pictures_below(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in pathlib.Path(folder).rglob("*") if path.is_file() and "lambent" not in path.name}


class Case(unittest.TestCase):
    def setUp(self):
        if MISSING:
            self.skipTest(MISSING)
        warnings.simplefilter("ignore", ResourceWarning)  # connections of clients that a test leaves
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(made.name)
        self.folder = pathlib.Path(made.name)

    def catalogue(self, *words, code=0, **env):
        found, out, err = catalogue(*words, **env)
        self.assertEqual(found, code, err[-2000:])
        return out, err


class Folders(Case):
    def test_the_pictures_and_names_are_those_of_batch(self):
        make_models("models", 12)
        for words in (["-o", "%s/{dir}/{stem}.png", "-s", "32"], ["-o", "%s/{dir}-{stem}-{ext}-{view}.jpg", "--view=front,iso", "-s16"],
                      ["-o", "%s/{view}/{dir}/{size}/{stem}.png", "--view", "iso", "-s", "16,24x8", "--material", "gold"]):
            out = [word.replace("%s", "theirs") for word in words]
            self.assertEqual(batch("models", *out).returncode, 0)
            self.catalogue("models/", *[word.replace("%s", "ours") for word in words])
            self.assertEqual(pictures_below("ours"), pictures_below("theirs"), words)
            listed = self.catalogue("models/", *out, "--dry-run")[0].splitlines()
            self.assertEqual(sorted(listed), sorted(batch("models", *out, "--dry-run").stdout.splitlines()))
            subprocess.run(["rm", "-r", "ours", "theirs"])

    def test_resume_and_skip_same_draw_only_the_rest(self):
        models = make_models("models", 5)
        (models / "a" / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        words = ["models/", "-o", "out/{dir}/{stem}.png", "-s", "16"]
        self.assertIn("8 of 9 pictures written, 1 failed", self.catalogue(*words, code=7)[1])
        self.assertIn("0 of 9 pictures written, 8 unchanged, 1 failed before", self.catalogue(*words, "--resume", code=7)[1])
        self.assertIn("8 unchanged", self.catalogue(*words, "--resume", "--failures-ok")[1])
        self.assertIn("0 of 9 pictures written, 8 unchanged, 1 failed (cannot-read 1)", self.catalogue(*words, "--resume", "--retry-failed", "2", code=7)[1])
        (pathlib.Path("out/a/m0000.png")).unlink()
        self.assertIn("1 of 9", self.catalogue(*words, "--resume", "--failures-ok")[1])
        self.assertIn("with other options", self.catalogue(*words, "--color", "red", "--resume", code=1)[1])
        (models / "a" / "bad.obj").unlink()
        (models / "d e" / "x.mtl").write_text("newmtl a\nKd 1 0 0\n")  # a file that a model names
        (models / "b" / "m0001.obj").write_text(QUAD % (3, 3) + "f 1 2 3\n")
        self.assertIn("2 of 8 pictures written, 6 unchanged", self.catalogue(*words, "--skip-same")[1])
        self.assertIn("0 of 8 pictures written, 8 unchanged", self.catalogue(*words, "--skip-same")[1])
        self.assertIn("8 of 8 pictures written", self.catalogue(*words, "--skip-same", "--color", "red")[1])
        out, _ = self.catalogue(*words[:2], "out/{dir}/{stem}.png", "-s", "16")
        self.assertEqual(batch("models", "-o", "theirs/{dir}/{stem}.png", "-s", "16").returncode, 0)
        self.assertEqual(pictures_below("out"), pictures_below("theirs"))
        done = subprocess.run(command_line("journal", "out"), stdout=subprocess.PIPE, text=True)
        self.assertIn("8 of 8 pictures written; 1 journal", done.stdout)
        self.assertEqual(done.returncode, 0)

    def test_lists_have_columns(self):
        make_models("models", 6)
        pathlib.Path("l.csv").write_text("model,output,view,size,material,background\na/m0000.obj,p/one.png,front,32,gold,white\nb/m0001.obj,,iso,,,\n"
                                         "models/c/m0002.obj,,,24x8,,\n")
        rows = [{"model": "a/m0000.obj", "output": "p/one.png", "view": "front", "size": 32, "material": "gold", "background": "white"},
                {"model": "b/m0001.obj", "view": "iso"}, {"model": "c/m0002.obj", "size": "24x8"}]
        pathlib.Path("l.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
        for kind in ("csv", "jsonl"):
            self.catalogue("models/", "--list", "l." + kind, "-o", kind + "/{stem}-{view}-{size}.png", "-s", "16", "--results", kind + "/results." + kind)
        found = pictures_below("csv")
        table = found.pop("results.csv").decode().splitlines()
        self.assertEqual(len(table), 4)
        self.assertRegex(table[1], r"^\d,models/.*,ok,,\d+,xxh64:\w{16},[\d.]+,")
        results = [json.loads(line) for line in pictures_below("jsonl")["results.jsonl"].splitlines()]
        self.assertEqual({"class", "bytes", "hash", "times_ms", "warnings", "row"} - set(results[0]), set())
        self.assertEqual(set(found), {"p/one.png", "m0001-iso-16.png", "m0002-three-quarter-24x8.png"})
        subprocess.run([PROGRAM, "models/a/m0000.obj", "-s", "32", "--view", "front", "--material", "gold", "-b", "white", "-o", "one.png", "-q"], check=True)
        self.assertEqual(found["p/one.png"], pathlib.Path("one.png").read_bytes())
        self.assertEqual(found, {name: data for name, data in pictures_below("jsonl").items() if name != "results.jsonl"})

    def test_wrong_rows_are_refused_before_anything_is_drawn(self):
        make_models("models", 2)
        pathlib.Path("secret.obj").write_text(QUAD % (1, 1) + "f 1 2 3\n")
        os.symlink(self.folder / "secret.obj", "models/a/link.obj")
        for row, sentence in (
                ({"model": "../secret.obj"}, "is outside models/"), ({"model": str(self.folder / "secret.obj")}, "is outside models/"),
                ({"model": "http://169.254.169.254/latest.obj"}, "is outside models/"), ({"model": "s3://other/x.obj"}, "is outside models/"),
                ({"model": "a/m0000.obj", "output": "../x.png"}, "is outside out/"), ({"model": "a/m0000.obj", "output": "/x.png"}, "is outside out/"),
                ({"model": "a/m0000.obj", "output": "s3://x/y.png"}, "is outside out/"), ({"model": "a/m0000.obj", "colour": "red"}, "unknown option '--colour'"),
                ({"output": "x.png"}, "column 'model': is missing"), ({"model": "a/m0000.obj", "size": "16,32"}, "a row is one picture"),
                ({"model": "a/m0000.obj", "size": "no"}, "option '--size'"),
                *[({"model": "a/m0000.obj", name: value}, "") for name, value in (
                    ("save-scene", "x.json"), ("journal", "j"), ("report", "r.html"), ("environment", "/etc/passwd"), ("look", "/etc/passwd"), ("config", "c.json"),
                    ("allow-path", "/"), ("files-from", "secret.obj"), ("turntable", "/x"), ("sandbox", "off"), ("isolate", True))]):
            with self.subTest(row=row):
                pathlib.Path("l.jsonl").write_text(json.dumps({"model": "a/m0000.obj", "output": "first.png"}) + "\n" + json.dumps(row) + "\n")
                before = sorted(map(str, self.folder.rglob("*")))
                code, _, err = catalogue("models/", "--list", "l.jsonl", "-o", "out/", "-s", "16")
                self.assertIn("l.jsonl: row 2: ", err)
                self.assertIn(sentence, err)
                self.assertIn(code, (1, 2))
                self.assertEqual(sorted(map(str, self.folder.rglob("*"))), before)
        pathlib.Path("l.jsonl").write_text('{"model": "a/link.obj"}\n')
        self.assertIn("is a link that leads out of models/", self.catalogue("models/", "--list", "l.jsonl", "-o", "out/", "-s", "16", code=7)[1])

    def test_names_that_models_give_stay_inside(self):
        """A model that names files above its folder, on the web or in the machine gets none of them."""
        make_models("models", 1)
        pathlib.Path("out.mtl").write_text("newmtl a\nKd 1 0 0\n")
        pathlib.Path("models/up.mtl").write_text("newmtl a\nKd 1 0 0\n")
        model = "".join("mtllib %s\n" % name for name in ("../up.mtl", "../../out.mtl", self.folder / "out.mtl", "http://127.0.0.1:1/x.mtl", "..\\up.mtl"))
        pathlib.Path("models/a/evil.obj").write_text(model + QUAD % (1, 1) + "usemtl a\nf 1 2 3\n")
        asked = []
        with mock.patch.object(drawing, "fetch", lambda address, *more: asked.append(address) or stores.fetch(address, *more)):
            self.catalogue("models/a/evil.obj", "-o", "out/", "-s", "16")
        self.assertEqual([name for name in asked if not re.fullmatch(r"models/a/[a-z]+\.(obj|mtl)", name)], [])

    def test_errors_are_one_sentence(self):
        make_models("models", 1)
        for words, code, sentence in (
                (["models/"], 1, "expected models and -o PATTERN"), (["models/", "-o", "x/", "--view", "frnt"], 1, "did you mean 'front'?"),
                (["models/", "-o", "x/", "--materail", "gold"], 1, "unrecognized arguments"), (["models/", "-o", "x/{name}.png"], 1, "found '{name}'"),
                (["models/", "-o", "x/x.png"], 1, "both pictures would be x/x.png"), (["models/", "-o", "x/", "--shard", "3/2"], 1, "--shard: found 3/2"),
                (["models/", "-o", "x/", "--shard", "auto/2"], 1, "--shard: found auto/2, expected K/N"), (["models/", "-o", "x/", "--list", "no.csv"], 2, "no.csv: No such file"),
                (["nothing://x/", "-o", "x/"], 3, "nothing://"), (["https://localhost/x/", "-o", "x/"], 1, "name the models with --list")):
            _, err = self.catalogue(*words, code=code)
            self.assertIn(sentence, err)
            self.assertEqual(err.count("\n"), 1 + ("help view" in err), err)
        self.assertIn("install lambent", self.catalogue("models/", "-o", "x/", code=3, LAMBENT="/nonexistent")[1])

    def test_shards_are_parts(self):
        make_models("models", 20)
        for index in range(3):
            self.catalogue("models/", "-o", "out/{dir}/{stem}.png", "-s", "8", "--shard", "auto/3", JOB_COMPLETION_INDEX=str(index))
        self.catalogue("models/", "-o", "whole/{dir}/{stem}.png", "-s", "8")
        self.assertEqual(pictures_below("out"), pictures_below("whole"))
        self.assertIn("23 of 23 pictures written", subprocess.run(command_line("journal", "out"), stdout=subprocess.PIPE, text=True).stdout)

    def test_the_kubernetes_example_draws_each_model_once(self):
        text = (ROOT / "examples" / "kubernetes-catalogue.yaml").read_text()
        words = [word.strip().strip('"') for word in re.search(r"(?s)command: \[(.*?)\]", text)[1].split(",")]
        completions = int(re.search(r"completions: (\d+)", text)[1])
        self.assertEqual(words[:3] + [words[words.index("--shard") + 1]], ["python3", "-m", "lambent.catalogue", "auto/%d" % completions])
        for field in ("completionMode: Indexed", "backoffLimitPerIndex: ", "action: Ignore", "type: DisruptionTarget", "restartPolicy: Never"):
            self.assertIn(field, text)
        make_models("models", 20)
        pathlib.Path("models/a/bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        words = [word.replace("s3://shop/", "") for word in words[3:]]
        for index in range(completions):
            self.catalogue(*words, JOB_COMPLETION_INDEX=str(index))
        self.assertEqual(len(pictures_below("thumbs")), 23)
        lines = [json.loads(line) for path in pathlib.Path("thumbs/lambent.journal").iterdir() for line in path.read_text().splitlines()]
        self.assertEqual(len({line["output"] for line in lines if "output" in line}), len([line for line in lines if "output" in line]))

    def test_parts_fit_the_pace_of_their_workers(self):
        """Two workers of 10 and 2.5 pictures a second end together, and each row is in one part."""
        rows = [{"model": str(index), "outputs": [str(index)]} for index in range(1000)]
        parts, threads, pace = engine.Parts(rows), {"fast": 1, "slow": 1}, {"fast": 0.1, "slow": 0.4}
        free, given = {"fast": 0.0, "slow": 0.0}, {"fast": [], "slow": []}
        while not parts.over or parts.waiting:
            worker = min(free, key=free.get)
            part, late = parts.take(worker, threads)
            self.assertGreater(late, time.monotonic())
            parts.learn(worker, part, len(part) * pace[worker])
            free[worker] += len(part) * pace[worker]
            given[worker].append(part)
        self.assertEqual(sorted(int(row["model"]) for some in given.values() for part in some for row in part), list(range(1000)))
        self.assertEqual([len(given[worker][0]) for worker in given], [8, 20])  # two seconds by a guess, then by the pace of the slowest that is known
        self.assertTrue({99, 100} & set(map(len, given["fast"])))
        self.assertTrue({24, 25} & set(map(len, given["slow"])))
        self.assertLess(max(free.values()) / (1000 / 12.5), 1.03)
        endless = engine.Parts(({"model": "m", "outputs": ["o"]} for _ in iter(int, 1)))
        endless.each["fast"] = 1e-9  # rows that cost nothing do not fill the memory
        endless.take("fast", threads)
        self.assertLessEqual(len(endless.waiting), engine.AHEAD * len(threads))

    def test_the_costs_of_the_page(self):
        """docs/scale.md: $0.40 for 10^6 reads, $5 for 10^6 writes, $0.023 for a GiB and month, and the times and sizes of the page's other tables."""
        rows = re.findall(r"(?m)^\| 10(.) \| \$([\d.,]+) \| \$([\d.,]+) \| \$([\d.,]+) \| \$([\d.,]+) \| \$([\d.,]+) \|$", (ROOT / "docs/scale.md").read_text())
        self.assertEqual(len(rows), 4)
        for power, *found in rows:
            n = 10 ** "⁰¹²³⁴⁵⁶⁷⁸".index(power)
            month = 0.023 / 2 ** 30
            expected = (n * (0.4e-6 + 5e-6 * (1 + 3 / 1000)), n * 0.080 / 3600 * 0.05, n * 0.007 / 3600 * 0.05, n * 26 * 2 ** 20 / 1000 * month, n * 200e3 * month)
            for text, value in zip(found, expected):
                self.assertLess(abs(float(text.replace(",", "")) - value), max(0.006, value * 0.012), (n, text, value))

    def test_fsspec_stores_and_their_absence(self):
        try:
            import fsspec
        except ImportError:
            self.skipTest("python3-fsspec is not installed")
        memory = fsspec.filesystem("memory")
        for path in make_models("models", 3).rglob("*.*"):
            memory.pipe_file("/shop/" + str(path.relative_to("models")), path.read_bytes()) if path.is_file() else None
        self.catalogue("memory://shop/", "-o", "memory://thumbs/{dir}/{stem}.png", "-s", "16")
        self.assertIn("0 of 6 pictures written, 6 unchanged", self.catalogue("memory://shop/", "-o", "memory://thumbs/{dir}/{stem}.png", "-s", "16", "--skip-same")[1])
        batch("models", "-o", "out/{dir}/{stem}.png", "-s", "16")
        self.assertEqual({path.removeprefix("/thumbs/"): memory.cat_file(path) for path in memory.find("/thumbs") if "lambent" not in path}, pictures_below("out"))
        self.assertRegex(self.catalogue("gs://shop/", "-o", "x/", code=3)[1], "gs://shop/: .*install gcsfs")


class StoreCase(Case):
    """A test with Swift. The class starts one store for its tests."""

    @classmethod
    def setUpClass(cls):
        cls.reason = MISSING or store.why_not()
        if not cls.reason:
            cls.made = tempfile.TemporaryDirectory()
            cls.swift = store.Swift(cls.made.name + "/swift")
            cls.addClassCleanup(cls.made.cleanup)
            cls.addClassCleanup(cls.swift.stop)
            cls.client = cls.swift.client()
            cls.buckets = 0

    def setUp(self):
        if self.reason:
            self.skipTest(self.reason)
        super().setUp()
        type(self).buckets += 1
        self.bucket = "shop%d" % self.buckets
        self.client.create_bucket(Bucket=self.bucket)
        self.models, self.to = "s3://%s/models/" % self.bucket, "s3://%s/thumbs/{dir}/{stem}.png" % self.bucket
        self.env = {**store.KEYS, "AWS_ENDPOINT_URL": self.swift.address}

    def upload(self, folder):
        import concurrent.futures
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            list(pool.map(lambda path: self.client.put_object(Bucket=self.bucket, Key="models/" + str(path.relative_to(folder)), Body=path.read_bytes()),
                          [path for path in folder.rglob("*") if path.is_file()]))

    def stored(self, prefix="thumbs/", inner=""):
        pages = self.client.get_paginator("list_objects_v2").paginate(Bucket=self.bucket, Prefix=prefix)
        return {found["Key"][len(prefix):]: self.client.get_object(Bucket=self.bucket, Key=found["Key"])["Body"].read()
                for page in pages for found in page.get("Contents", ()) if ("lambent.journal" in found["Key"]) == bool(inner)}

    def proxy(self, **how):
        made = store.Proxy(self.swift.address, **how)
        self.addCleanup(made.stop)
        self.env["AWS_ENDPOINT_URL"] = made.address
        return made

    def expected(self, folder, *words):
        self.assertEqual(batch(str(folder), "-o", "expected/{dir}/{stem}.png", *words).returncode, 0)
        return pictures_below("expected")

    def check_journal(self, pictures, skip=()):
        """Each picture has lines in the journal, the last with its bytes. The pictures named in `skip` failed."""
        segments = self.stored("thumbs/", "journal")
        lines = [json.loads(line) for data in segments.values() for line in data.splitlines()]
        found = {}
        for line in lines:
            if "output" in line:
                found.setdefault(line["output"].partition("/thumbs/")[2], []).append(line)
        self.assertEqual(set(found), set(pictures))
        drawn = {name: rows[-1]["bytes"] for name, rows in found.items() if name not in skip}
        self.assertEqual({name: len(pictures[name]) for name in drawn}, drawn)
        return found, lines


class Stores(StoreCase):
    """Everything with Swift."""

    def test_a_store_that_breaks_requests(self):
        models = make_models("models", 400 if LONG else 12)
        self.upload(models)
        expected = self.expected(models, "-s", "16")
        proxy = self.proxy(fail=0.1, cut=0.02, corrupt=0.02, delay=0.005)
        self.catalogue(self.models, "-o", self.to, "-s", "16", **self.env)
        self.assertGreater(len(proxy.requests), len(expected) * 2)
        self.assertEqual(self.stored(), expected)
        found, _ = self.check_journal(expected)
        self.assertEqual({len(rows) for rows in found.values()}, {1})
        self.assertIn("0 of %d" % len(expected), self.catalogue(self.models, "-o", self.to, "-s", "16", "--resume", **self.env)[1])
        self.assertIn("0 of %d" % len(expected), self.catalogue(self.models, "-o", self.to, "-s", "16", "--skip-same", **self.env)[1])
        self.client.put_object(Bucket=self.bucket, Key="models/d e/x.mtl", Body=b"newmtl a\nKd 0 1 0\n")
        self.assertIn("1 of %d" % len(expected), self.catalogue(self.models, "-o", self.to, "-s", "16", "--skip-same", **self.env)[1])

    @unittest.skipUnless(LONG, "in make test-long")
    def test_kills_and_two_runs_at_once(self):
        models = make_models("models", 150)
        self.upload(models)
        expected = self.expected(models, "-s", "64")
        words = command_line(self.models, "-o", self.to, "-s", "64", "--resume", "-q")
        rounds, segment, flight = int(os.environ.get("LAMBENT_KILLS", 60)), 20, 20
        rng, killed, removed, run = random.Random(3), collections.Counter(), 0, None

        def between(method, path):
            """Kills the run when it has put pictures and is about to put their segment, which does not arrive."""
            if run and method == "PUT" and "lambent.journal" in path and "000001.jsonl" not in path:
                run.kill()
                return b"HTTP/1.1 503 Slow Down\r\nContent-Length: 0\r\n\r\n"

        proxy = self.proxy()
        environment = {**os.environ, **self.env, "LAMBENT_SEGMENT": str(segment)}
        for number in range(rounds):
            run = subprocess.Popen(words, env=environment)
            proxy.hostile = between if number % 2 else None
            try:
                killed["between a picture and its segment"] += run.wait(None if number % 2 else rng.uniform(0.5, 6)) == -signal.SIGKILL
            except subprocess.TimeoutExpired:
                run.kill()
                run.wait()
                killed["at random"] += 1
            for name, data in self.stored().items():
                self.assertEqual(data, expected[name], name)  # none half-written
            if rng.random() < 0.3:  # so that there is always work left
                for name in self.stored():
                    self.client.delete_object(Bucket=self.bucket, Key="thumbs/" + name)
                    removed += 1
        proxy.hostile = None
        self.assertGreater(min(killed["at random"], killed["between a picture and its segment"]), 0)
        drawn = sum(method == "PUT" and "/thumbs/" in path and "lambent.journal" not in path for method, path in proxy.requests)
        print("# kills: %d rounds, %s; %d pictures, %d drawn, %d of them because the test had removed them" % (rounds, dict(killed), len(expected), drawn, removed), flush=True)
        self.assertLessEqual(drawn, len(expected) + removed + sum(killed.values()) * (segment + flight))
        both = [subprocess.Popen(words, env=environment) for _ in range(2)]
        self.assertEqual([run.wait() for run in both], [0, 0])
        self.assertEqual(self.stored(), expected)
        _, lines = self.check_journal(expected)
        for run in {line["run"] for line in lines if "run" in line}:
            data = b"".join(data for name, data in self.stored("thumbs/", "journal").items() if run in name)
            outputs = [json.loads(line)["output"] for line in data.splitlines() if b'"output"' in line]
            self.assertEqual(len(outputs), len(set(outputs)))
        sent = sum(size for path, size in proxy.put_bytes.items() if "lambent.journal" in path)
        size = sum(map(len, self.stored("thumbs/", "journal").values()))
        print("# journal: %d bytes written, %d bytes at the end: %.2f" % (sent, size, sent / size), flush=True)
        self.assertLessEqual(sent, 2 * size)
        self.assertIn("0 of %d" % len(expected), self.catalogue(self.models, "-o", self.to, "-s", "64", "--resume", **self.env)[1])

    def solids(self, sizes):
        """STL files of these sizes in bytes, with small triangles at random in a cube."""
        pathlib.Path("solids").mkdir()
        rng = random.Random(4)
        centres = [[rng.random() for _ in range(3)] for _ in range(2000)]
        points = [struct.pack("<12fH", 0, 0, 0, *[value + 0.02 * rng.random() for _ in range(3) for value in centre], 0) for centre in centres]
        for index, size in enumerate(sizes):
            count = size // 50
            pathlib.Path("solids/m%04d.stl" % index).write_bytes(b" " * 80 + struct.pack("<I", count) + b"".join(points[(index + i) % 2000] for i in range(count)))
        self.upload(pathlib.Path("solids"))

    def timed(self, *words):
        """The seconds and the processor time of a command and its processes."""
        start = time.monotonic()
        process = subprocess.Popen(words, env={**os.environ, **self.env}, stderr=subprocess.DEVNULL)
        _, code, used = os.wait4(process.pid, 0)
        process.returncode = code
        self.assertEqual(code, 0)
        return time.monotonic() - start, used.ru_utime + used.ru_stime

    def hold(self, compare, *values):
        """An assertion about time, if the machine does not do much else."""
        busy = os.getloadavg()[0] > 2 * os.cpu_count()
        print("# not asserted, because the load is %.0f" % os.getloadavg()[0], flush=True) if busy else compare(*values)

    @unittest.skipUnless(LONG, "in make test-long")
    def test_processor_time_is_that_of_files_and_6_ms(self):
        count, rng = int(os.environ.get("LAMBENT_SOLIDS", 500)), random.Random(5)
        self.solids([int(20e3 * 100 ** rng.random()) for _ in range(count)])
        times = {}
        for most in (10, count):  # their difference is without the start of the programs
            names = ["m%04d.stl" % index for index in range(most)]
            pathlib.Path("names").write_text("".join(name + "\n" for name in names))
            pathlib.Path("paths").write_text("".join("solids/%s\n" % name for name in names))
            times[most] = (self.timed(PROGRAM, "batch", "@paths", "-o", "files/", "-s", "256", "--isolate", "-q")[1],
                           self.timed(*command_line(self.models, "--list", "names", "-o", self.to, "-s", "256", "-q"))[1])
        files, stores_ = [(times[count][index] - times[10][index]) / (count - 10) * 1e3 for index in range(2)]
        print("# processor time: %d models of 20 kB to 2 MB: %.1f ms from files, %.1f ms from the store: %.1f ms more" % (count, files, stores_, stores_ - files), flush=True)
        self.hold(self.assertLessEqual, stores_ - files, 6)
        self.assertEqual(self.stored(), pictures_below("files"))

    @unittest.skipUnless(LONG, "in make test-long")
    def test_delays_and_slow_lines_are_hidden(self):
        self.solids([20000] * 200 + [2000000] * 100)
        for name, indices in (("one", range(1)), ("small", range(200)), ("large", range(200, 300))):
            pathlib.Path(name).write_text("".join("m%04d.stl\n" % index for index in indices))
        rates = []
        for delay in (0.0, 0.03):
            self.proxy(delay=delay)
            one, small = [self.timed(*command_line(self.models, "--list", name, "-o", "out/", "-s", "64", "-q"))[0] for name in ("one", "small")]
            rates.append(199 / (small - one))
        print("# delay of 30 ms: %.1f models a second, %.1f without: %.2f" % (rates[1], rates[0], rates[1] / rates[0]), flush=True)
        self.hold(self.assertGreaterEqual, rates[1] / rates[0], 0.85)
        proxy = self.proxy(rate=25e6)
        self.timed(*command_line(self.models, "--list", "large", "-o", "out/", "-s", "64", "-q"))
        part = 200e6 / proxy.rate / proxy.lasted()
        print("# line of 200 Mbit/s: %.2f of it" % part, flush=True)
        self.hold(self.assertGreaterEqual, part, 0.95)

    def test_errors_of_stores_are_one_sentence(self):
        make_models("models", 1)
        self.upload(pathlib.Path("models"))
        proxy = self.proxy()
        denied = b"HTTP/1.1 403 Forbidden\r\nContent-Length: %d\r\n\r\n%s"
        skewed = b"<?xml version='1.0'?><Error><Code>RequestTimeTooSkewed</Code><Message>x</Message></Error>"
        for words, env, code, sentence in (
                (["s3://nobody/x/"], {}, 2, "there is no such bucket"), ([self.models], {"AWS_SECRET_ACCESS_KEY": "x"}, 2, "AWS_SECRET_ACCESS_KEY"),
                ([self.models], {"AWS_ACCESS_KEY_ID": "x:y"}, 2, "AWS_"), ([self.models], {"AWS_ENDPOINT_URL": "http://nohost.invalid"}, 2, "cannot connect to http://nohost.invalid"),
                ([self.models], {"AWS_ACCESS_KEY_ID": "", "AWS_SECRET_ACCESS_KEY": "", "HOME": "/nonexistent"}, 2, "there are no credentials"),
                ([self.models], {"skew": "1"}, 2, "set the clock")):
            proxy.hostile = (lambda *_: denied % (len(skewed), skewed)) if "skew" in env else None
            code_found, _, err = catalogue(*words, "-o", "x/", "-s", "16", **{**self.env, **env})
            self.assertEqual(code_found, code, err)
            self.assertIn(sentence, err)
            self.assertEqual(err.count("\n"), 1, err)
            self.assertFalse(os.path.exists("x"))

    def test_hostile_stores(self):
        """Endless bodies, redirects, wrong lengths: a sentence each, no request elsewhere, no picture."""
        canary = store.Proxy(self.swift.address)  # nobody may ask it
        self.addCleanup(canary.stop)
        pathlib.Path("models").mkdir()
        pathlib.Path("models/m.stl").write_bytes(b"solid\nendsolid\n")
        self.upload(pathlib.Path("models"))
        redirect = "HTTP/1.1 %s\r\nLocation: %s\r\nx-amz-bucket-region: evil.invalid/#\r\nContent-Length: 0\r\n\r\n"
        answers = {
            " bytes or more; --size-limit is 1000000": b"HTTP/1.1 200 OK\r\nETag: \"x\"\r\n\r\nendless", "has 99999999999 bytes or more": b"HTTP/1.1 200 OK\r\nETag: \"x\"\r\nContent-Length: 99999999999\r\n\r\nx",
            "redirect": (redirect % ("302 Found", canary.address + "/secret")).encode(), "redirects": (redirect % ("307 Temporary", "file:///etc/passwd")).encode(),
            "the store": (redirect % ("301 Moved", "http://169.254.169.254/latest")).encode(), "": b"HTTP/1.1 200 OK\r\nETag: \"x\"\r\nContent-Length: 50\r\n\r\nshort"}
        proxy = self.proxy(hostile=lambda method, path: answer if method == "GET" and path.endswith("m.stl") else None)
        with mock.patch.object(stores, "TRIES", 2):
            for sentence, answer in answers.items():
                code, _, err = catalogue(self.models, "-o", "out/", "-s", "16", "--size-limit", "1000000", **self.env)
                self.assertEqual(code, 7, err)
                self.assertIn("m.stl: ", err)
                self.assertIn(sentence, err)
                self.assertEqual(list(pathlib.Path("out").glob("*.png")), [])
            for place in ("http://127.0.0.1/x", canary.address + "/secret", "file:///etc/passwd"):
                answer = (redirect % ("302 Found", place)).encode()
                pathlib.Path("l.txt").write_text("m.stl\n")
                err = self.catalogue(proxy.address + "/x/", "--list", "l.txt", "-o", "out/", "-s", "16", code=7, **self.env)[1]
                self.assertIn("redirects to %s, which Lambent does not follow" % place, err)
        self.assertEqual(canary.requests, [])

    def test_web_addresses_are_read(self):
        models = make_models("models", 3)
        self.upload(models)
        names = [str(path.relative_to("models")) for path in sorted(models.rglob("*")) if path.suffix in (".obj", ".gltf", ".ply")]
        pathlib.Path("l.txt").write_text("".join(name + "\n" for name in names))

        def web(method, path):
            from urllib.parse import unquote
            file = models / unquote(path).removeprefix("/x/")
            data = file.read_bytes() if file.is_file() else None
            head = b"HTTP/1.1 %s\r\nETag: \"%x\"\r\nContent-Length: %d\r\n\r\n" % (b"404 No" if data is None else b"200 OK", hash(data) & 0xffff, len(data or b""))
            return head + (data or b"" if method == "GET" else b"")

        proxy = self.proxy(hostile=web)
        self.catalogue(proxy.address + "/x/", "--list", "l.txt", "-o", "out/{dir}/{stem}.png", "-s", "16")
        self.assertEqual(pictures_below("out"), self.expected(models, "-s", "16"))
        self.assertIn("6 unchanged", self.catalogue(proxy.address + "/x/", "--list", "l.txt", "-o", "out/{dir}/{stem}.png", "-s", "16", "--skip-same")[1])

    def scheduler(self, paces):
        """A scheduler and its workers, one for each pace in pictures a second, on three hosts if the machine permits namespaces, with the store behind
        the same bridge. Returns the scheduler's address and the hosts, or None."""
        reason, net = hosts.why_not(), None
        if reason:
            print("# dask: on one host: " + reason, flush=True)
        else:
            net = hosts.Hosts(3)
            self.addCleanup(net.stop)
            self.proxy(host=net.address)
        host, port = net.address if net else "127.0.0.1", store.free_ports(1)[0]
        environment = {**os.environ, **self.env, "LAMBENT_PACED": PROGRAM, "LAMBENT": str(pathlib.Path(__file__).with_name("pace.py"))}
        address = "tcp://%s:%d" % (host, port)
        logs = [open("dask-%d.log" % index, "w") for index in range(len(paces) + 1)]
        self.dask = [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", host, "--port", str(port), "--no-dashboard"],
                                      stderr=logs[0], start_new_session=True)]
        for index, pace in enumerate(paces):
            words = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard", "--name", "w%d" % index]
            self.dask.append(subprocess.Popen(net.command(index % 3, *words) if net else words, stderr=logs[index + 1], start_new_session=True,
                                              env={**environment, "PACE": str(pace)}))
        self.addCleanup(lambda: [(os.killpg(process.pid, signal.SIGKILL), process.wait()) for process in self.dask])
        return address, net

    @unittest.skipUnless(LONG, "in make test-long")
    def test_dask_balances_and_survives_kills(self):
        try:
            import distributed
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        fast, count = float(os.environ.get("LAMBENT_DASK_PACE", 3)), int(os.environ.get("LAMBENT_DASK_MODELS", 2000))
        models = make_models("models", count)
        self.upload(models)
        expected = self.expected(models, "-s", "16")
        paces = [fast] * 5 + [fast / 4]
        ideal, rng = len(expected) / sum(paces), random.Random(6)
        address, _ = self.scheduler(paces)
        with distributed.Client(address) as client:
            client.wait_for_workers(len(paces))
            rows = [{"model": self.models + "a/m0000.obj", "output": "s3://%s/x/a.png" % self.bucket, "size": 16}]
            with mock.patch.dict(os.environ, self.env):
                results = list(engine.on_dask(client, rows))
                self.assertEqual([result["class"] for result in results], ["ok"])
                self.assertEqual([result["hash"] for result in drawing.draw(rows)], [results[0]["hash"]])
            self.assertEqual(self.stored("x/"), {"a.png": expected["a/m0000.png"]})
            for kills in (0, 6):
                start = time.monotonic()
                to = "s3://%s/thumbs%d/{dir}/{stem}.png" % (self.bucket, kills)
                run = subprocess.Popen(command_line(self.models, "-o", to, "-s", "16", "--dask", address), env={**os.environ, **self.env})
                for _ in range(kills):
                    time.sleep(ideal / (kills + 1))
                    pids = [info["pid"] for info in client.run(lambda: {"pid": os.getpid()}).values()]
                    os.kill(rng.choice(pids), signal.SIGKILL)
                self.assertEqual(run.wait(), 0)
                seconds = time.monotonic() - start
                print("# dask: %d pictures, %d kills, %.1f s, ideal %.1f s: %.3f" % (len(expected), kills, seconds, ideal, seconds / ideal), flush=True)
                self.assertEqual(self.stored("thumbs%d/" % kills), expected)
                lines = [line for data in self.stored("thumbs%d/" % kills, "journal").values() for line in data.splitlines() if b'"output"' in line]
                self.assertEqual(len(lines), len(expected))
                self.hold(self.assertLessEqual, seconds / ideal, 1.15)

    @unittest.skipUnless(LONG, "in make test-long")
    def test_a_lost_host_does_not_hold_up_dask(self):
        """The cable of one of three hosts is cut, so its workers neither answer nor end."""
        try:
            import distributed
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        if hosts.why_not():
            self.skipTest(hosts.why_not())
        models = make_models("models", 120)
        self.upload(models)
        expected = self.expected(models, "-s", "16")
        address, net = self.scheduler([1] * 6)
        with distributed.Client(address) as client:
            client.wait_for_workers(6)
        start = time.monotonic()
        run = subprocess.Popen(command_line(self.models, "-o", self.to, "-s", "16", "--dask", address), env={**os.environ, **self.env})
        time.sleep(12)
        net.cut(2)
        self.assertEqual(run.wait(), 0)
        print("# dask: %d pictures, a third of the workers lost after 12 s: %.1f s" % (len(expected), time.monotonic() - start), flush=True)
        self.assertEqual(self.stored(), expected)
        found, _ = self.check_journal(expected)
        self.assertEqual({len(rows) for rows in found.values()}, {1})


if __name__ == "__main__":
    unittest.main(verbosity=2)
