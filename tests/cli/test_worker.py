# test_worker.py: lambent batch --jobs: jobs as lines of JSON and their answers, including hostile ones (docs/worker.md).
# The file has more than 600 lines because it contains one test for each key of a job and for each way to end a worker.
import base64
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import statistics
import struct
import subprocess
import threading
import time
import unittest

from harness import OWN_MODELS, PROGRAM, ROOT, Case, long, read_png, write_png, wait_until_caught, writers_and_others
from test_batch import xxh64

JOBS = int(os.environ.get("LAMBENT_JOBS", "300"))  # of Many; `make test-long` uses 10,000


# AddressSanitizer would turn a signal into an exit code.
SANITIZER = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":handle_segv=0"}


class Worker:
    """A worker, and a thread that collects its answers."""

    def __init__(self, folder, *words, env=None):
        self.process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", *map(str, words)], cwd=folder, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **SANITIZER, **(env or {})})
        self.answers, self.came = [], threading.Condition()
        self.err = b""
        self.readers = [threading.Thread(target=self.read, daemon=True), threading.Thread(target=self.read_err, daemon=True)]
        for reader in self.readers:
            reader.start()

    def read(self):
        for line in self.process.stdout:
            answer = json.loads(line)
            with self.came:
                self.answers.append(answer)
                self.came.notify_all()

    def read_err(self):
        self.err = self.process.stderr.read()

    def say(self, *jobs):
        for job in jobs:
            line = job if isinstance(job, bytes) else json.dumps(job).encode()
            self.process.stdin.write(line + b"\n")
        self.process.stdin.flush()

    def answer(self, id, seconds=60):
        """Waits for the answer to a job."""
        until = time.time() + seconds
        with self.came:
            while True:
                found = [a for a in self.answers if a["id"] == id]
                if found:
                    return found[0]
                if not self.came.wait(until - time.time()):
                    raise AssertionError(f"no answer to {id!r}: {self.answers}")

    def end(self, seconds=120):
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        try:
            code = self.process.wait(seconds)
        finally:
            self.process.kill()
        for reader in self.readers:
            reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        return code


class Jobs(Case):
    def setUp(self):
        super().setUp()
        for name in os.listdir(self.folder):
            os.remove(self.folder / name)
        for name in ("in", "out", "secret"):
            (self.folder / name).mkdir()
        for path in OWN_MODELS.glob("cube.*"):
            shutil.copy(path, self.folder / "in")
        shutil.copy(OWN_MODELS / "cube.stl", self.folder / "secret")

    def start(self, *words, allow=("in", "out"), **more):
        worker = Worker(self.folder, *(word for path in allow for word in ("--allow-path", path)), *words, **more)
        self.addCleanup(worker.process.kill)
        return worker

    def answers(self, *jobs, words=(), code=7, **more):
        """The answers to jobs, in the order of the jobs if they have ids."""
        worker = self.start(*words, **more)
        worker.say(*jobs)
        self.assertEqual(worker.end(), code, worker.err.decode())
        self.worker = worker
        order = {json.dumps(job["id"]): i for i, job in enumerate(jobs) if isinstance(job, dict) and "id" in job}
        return sorted(worker.answers, key=lambda a: order.get(json.dumps(a["id"]), len(order)))

    def one(self, job, **more):
        found = self.answers(job, **more)
        self.assertEqual(len(found), 1, found)
        return found[0]

    def data(self, name="cube.stl"):
        return base64.b64encode((OWN_MODELS / name).read_bytes()).decode()


class Answers(Jobs):
    def test_no_pause_while_jobs_wait(self):
        """With -j 1 and --isolate, each job takes as long if others wait as if it is alone: the worker does not pause."""
        def gap(in_flight, count=16):
            worker = self.start("--isolate", "-j", "1", "-s", "16", "--ao", "off")
            worker.say({"id": "first", "model": "in/cube.obj"})
            worker.answer("first")
            times = [time.monotonic()]
            for i in range(0, count, in_flight):
                worker.say(*({"id": k, "model": "in/cube.obj"} for k in range(i, i + in_flight)))
                for k in range(i, i + in_flight):
                    worker.answer(k)
                    times.append(time.monotonic())
            self.assertEqual(worker.end(), 0, worker.err)
            return statistics.median(b - a for a, b in zip(times, times[1:]))
        self.assertLess(gap(16), max(0.05, 4 * gap(1)))

    def test_same_picture_as_alone(self):
        """Files and inline pictures have the same bytes as from `lambent`, with every form of options, and with --isolate."""
        ways = ({"size": 40, "color": "#f80", "two-sided": True, "wireframe": False, "light": ["point", "+spot"]},
                ["-s", "40", "--color=#f80", "--two-sided", "--light", "point", "--light", "+spot"], ["-s", 40, "--color", "#f80", "--two-sided",
                                                                                                    "--light=point", "--light=+spot"])
        self.good("in/cube.obj", *map(str, ways[1]), "-o", "alone.png")
        alone = (self.folder / "alone.png").read_bytes()
        for words in ((), ("--isolate",), ("-j", "1"), ("-j", "1", "--isolate")):
            jobs = [{"id": i, "model": "in/cube.obj", "options": way, "output": f"out/new/{i}.png"} for i, way in enumerate(ways)]
            jobs += [{"id": f"i{i}", "model": "in/cube.obj", "options": way} for i, way in enumerate(ways)]
            for answer, job in zip(self.answers(*jobs, words=words, code=0), jobs):
                self.assertEqual((answer["id"], answer["outcome"], answer["class"], answer["exit"], answer["error"]),
                                 (job["id"], "written", "ok", 0, None))
                data = (self.folder / job["output"]).read_bytes() if "output" in job else base64.b64decode(answer["data"], validate=True)
                self.assertEqual(data, alone)
                self.assertEqual((answer["hash"], answer["bytes"], answer["width"], answer["height"]), (xxh64(alone), len(alone), 40, 40))
                self.assertEqual((answer["model"], answer["output"], answer["format"], answer["triangles"]),
                                 ("in/cube.obj", job.get("output"), "obj", 12))
                self.assertEqual("data" in answer, "output" not in job)
                self.assertLessEqual({"read", "frame", "encode", "total"}, set(answer["times_ms"]))
            shutil.rmtree(self.folder / "out/new")

    def test_inline_models(self):
        self.good("in/cube.stl", "-s", "32", "-o", "alone.png")
        alone = (self.folder / "alone.png").read_bytes()
        found = self.answers({"id": 1, "data": self.data(), "options": {"size": 32}}, {"id": 2, "data": self.data(), "name": "x.stl", "options": {"size": 32}},
                             {"id": 3, "data": self.data("cube.obj"), "name": "cube.obj", "options": {"size": 32}},
                             {"id": 4, "data": base64.b64encode(b"solid x\nfacet no").decode(), "name": "bad.stl"}, words=["--isolate"])
        self.assertEqual([base64.b64decode(a["data"]) for a in found[:2]], [alone, alone])
        self.assertEqual(found[2]["outcome"], "written")  # without its material library, which causes a warning
        self.assertIn("cube.mtl", found[2]["warnings"][0])
        self.assertEqual((found[3]["outcome"], found[3]["class"], found[3]["exit"]), ("failed", "cannot-read", 2))
        self.assertTrue(found[3]["error"].startswith("bad.stl:"), found[3]["error"])

    def test_environments_are_shared_while_their_files_are_the_same(self):
        def sky(shade):
            (self.folder / "in/sky.png").write_bytes(write_png(8, 4, bytes([shade, 255 - shade, 40, 255]) * 32))
        job = {"model": "in/cube.stl", "options": {"size": 16, "reflectivity": 0.8, "reflection-map": "in/sky.png"}}
        worker, pictures = self.start("-j", "2"), []
        for shade in (10, 200, 10):
            sky(shade)
            worker.say(*({"id": f"{len(pictures)}-{i}", **job} for i in range(3)))
            same = {base64.b64decode(worker.answer(f"{len(pictures)}-{i}")["data"]) for i in range(3)}
            self.good("in/cube.stl", "-s", 16, "--reflectivity", 0.8, "--reflection-map", "in/sky.png", "-o", "alone.png")
            self.assertEqual(same, {(self.folder / "alone.png").read_bytes()})
            pictures.append(same.pop())
        self.assertEqual((worker.end(), len(set(pictures))), (0, 2))
        # More environments than the cache keeps; one of them is not a picture.
        names = [*(f"in/{i}.png" for i in range(6)), "sky", "studio", "in/cube.stl"]
        for i in range(6):
            (self.folder / f"in/{i}.png").write_bytes(write_png(8, 4, bytes([40 * i, 90, 40, 255]) * 32))
        jobs = [{"id": i, "model": "in/cube.stl", "options": {"size": 16, "reflectivity": 0.8, "reflection-map": names[i % len(names)]}} for i in range(45)]
        by_name = {}
        for answer, job in zip(self.answers(*jobs, words=["-j", "4"]), jobs):
            by_name.setdefault(job["options"]["reflection-map"], set()).add(answer.get("data"))
        self.assertEqual({name: len(found) for name, found in by_name.items()}, {name: 1 for name in names})
        self.assertEqual((by_name["in/cube.stl"], len(set.union(*by_name.values()))), ({None}, len(names)))

    def test_several_pictures(self):
        job = {"model": "in/cube.stl", "options": {"views": "front,left", "sizes": "16,20x10"}}
        for words in ((), ("--isolate",)):
            here, file = self.answers({"id": "a", **job}, {"id": "b", "output": "out/{stem}-{view}-{size}.png", **job}, words=words, code=0)
            self.assertEqual([(p["view"], p["width"], p["height"]) for p in here["pictures"]],
                             [("front", 16, 16), ("front", 20, 10), ("left", 16, 16), ("left", 20, 10)])
            for inline, written in zip(here["pictures"], file["pictures"]):
                self.assertEqual(base64.b64decode(inline["data"]), (self.folder / written["output"]).read_bytes())
                self.assertEqual(inline["hash"], written["hash"])
            self.assertEqual([p["output"] for p in file["pictures"]], ["out/cube-front-16.png", "out/cube-front-20x10.png", "out/cube-left-16.png",
                                                                       "out/cube-left-20x10.png"])

    def test_animation_and_layers(self):
        found = self.answers({"id": 1, "model": "in/cube.stl", "options": {"size": 16, "turntable": 3}},
                             {"id": 2, "model": "in/cube.stl", "options": {"size": 16, "turntable": 3}, "output": "out/a.png"},
                             {"id": 3, "model": "in/cube.stl", "options": {"size": 16, "show": "depth"}, "format": "pfm"}, code=0)
        self.assertEqual(base64.b64decode(found[0]["data"]), (self.folder / "out/a.png").read_bytes())
        self.assertIn(b"acTL", base64.b64decode(found[0]["data"]))
        self.assertTrue(base64.b64decode(found[2]["data"]).startswith(b"Pf\n16 16\n"))

    def test_options_of_the_worker_come_first(self):
        found = self.answers({"id": 1, "model": "teapot"}, {"id": 2, "model": "teapot", "options": {"size": 20}}, words=["-s", "12"], code=0)
        self.assertEqual([a["width"] for a in found], [12, 20])

    def test_end(self):
        """No line end after the last line, no jobs, empty lines, a file of jobs."""
        worker = self.start()
        worker.process.stdin.write(b"\r\n \n" + json.dumps({"id": 1, "model": "in/cube.stl", "options": {"size": 8}}).encode())
        self.assertEqual((worker.end(), [a["outcome"] for a in worker.answers]), (0, ["written"]))
        self.assertIn(b"1 of 1 pictures written", worker.err)
        self.assertEqual(self.answers(code=0), [])
        (self.folder / "jobs").write_text('{"id": 1, "model": "in/cube.stl", "options": {"size": 8}}\n')
        for more in ([], ["--isolate"]):
            done = self.good("batch", "--jobs", "jobs", "--allow-path", "in", "-q", *more)
            self.assertEqual((json.loads(done.stdout)["outcome"], done.stderr), ("written", b""))

    def test_journal_and_skip_same(self):
        jobs = [{"id": i, "model": "in/cube.stl", "options": {"size": 8 + i}, "output": f"out/{i}.png"} for i in range(3)]
        jobs.append({"id": 9, "model": "in/none.stl", "output": "out/9.png"})
        time.sleep(0.02)  # a file changed within a clock tick before it was read has no key
        for more in ([], ["--isolate"]):
            self.answers(*jobs, words=["--journal", "log/j.jsonl", *more])
            lines = [json.loads(line) for line in (self.folder / "log/j.jsonl").read_text().splitlines()]
            self.assertEqual(sorted((r["id"], r["output"], r["class"]) for r in lines if "output" in r),
                             [(0, "out/0.png", "ok"), (1, "out/1.png", "ok"), (2, "out/2.png", "ok"), (9, "out/9.png", "cannot-read")])
            changed = [dict(jobs[0], options={"size": 30}), dict(jobs[1], id="other"), jobs[2]]
            found = self.answers(*changed, words=["--journal", "log/j.jsonl", "--skip-same", *more], code=0)
            self.assertEqual([(a["id"], a["outcome"]) for a in found], [(0, "written"), ("other", "same"), (2, "same")])
            self.assertEqual(found[1]["output"], "out/1.png")


class Refusals(Jobs):
    def refuse(self, job, says, code=None, **more):
        found = self.one(job, **more)
        self.assertEqual((found["outcome"], found["line"]), ("refused", 1), found)
        self.assertTrue(found["error"].startswith("line 1: "), found)
        self.assertIn(says, found["error"])
        if code is not None:
            self.assertEqual(found["exit"], code, found)
        return found

    def test_lines(self):
        for line, says in ((b"not json", "expected JSON"), (b"[1, 2]", "found a list"), (b"3", "expected JSON"), (b'{"id": 1', "expected JSON"),
                           (b"\x00\x01\xff\xfe", "expected JSON"), (b'{"id": "\xff"}', "expected JSON"), (b'{"id": 1, "id": 2}', "expected JSON"),
                           (b"[" * 100000, "expected JSON"), (b'{"id": 1e400}', "expected JSON"), (b"{}", "key 'id': is missing"),
                           (b'{"id": null}', "found null"), (b'{"id": 1.5}', "found a number"), (b'{"id": ["a"]}', "found a list"),
                           (b'{"id": "%s"}' % (b"x" * 201), "at most 200"), (b'{"cancel": {}}', "key 'cancel': found an object"),
                           (b'{"cancel": 1, "id": 2}', "stands alone")):
            found = self.refuse(line, says, 1)
            self.assertIsNone(found["id"])
            self.assertTrue(found["error"].isascii() and found["error"].isprintable())

    def test_jobs(self):
        model = {"id": "x", "model": "in/cube.stl"}
        for job, says, code in (
                ({"id": "x"}, "expected either key 'model'", 1), ({**model, "data": "AAAA"}, "expected either", 1), ({**model, "sise": 3}, "found key 'sise'", 1),
                ({"id": "x", "model": 3}, "key 'model': found an integer", 1), ({"id": "x", "model": ""}, "key 'model': is empty", 1),
                ({"id": "x", "model": "-"}, "standard input", 1), ({"id": "x", "data": "A"}, "base64", 1), ({"id": "x", "data": "AAA!"}, "character 3", 1),
                ({"id": "x", "data": "AB=="}, "base64", 1), ({"id": "x", "data": "AAAA", "name": "../x"}, "without a folder", 1),
                ({**model, "name": "a"}, "only with key 'data'", 1), ({**model, "options": 3}, "key 'options'", 1), ({**model, "options": [None]}, "word 1", 1),
                ({**model, "options": ["x"]}, "unexpected word 'x'", 1), ({**model, "options": ["-"]}, "unexpected word '-'", 1),
                ({**model, "options": ["--"] + ["a"]}, "unexpected word 'a'", 1), ({**model, "options": ["-s"] * 1001}, "more than 1000", 1),
                ({**model, "options": {"sise": 3}}, "did you mean '--size'?", 1), ({**model, "options": {"size": {}}}, "'size'", 1),
                ({**model, "options": {"size": True}}, "needs a value", 1), ({**model, "options": {"size=3 --x": 1}}, "name of an option", 1),
                ({**model, "options": {"size": "9999999"}}, "from 1 to 65535", 1), ({**model, "options": {"views": "front", "azimuth": 3}}, "together", 1),
                ({**model, "options": {"camera": "eye=0/0/0", "view": "front"}}, "together", 1), ({**model, "format": "tif"}, None, 3),
                ({**model, "format": "../x"}, "key 'format'", 1), ({**model, "output": "out/a.png", "format": "png"}, "key 'format'", 1),
                ({**model, "output": "out/{frame}.png"}, "{frame}", 1), ({**model, "output": "out/{x}.png"}, "'{x}'", 1),
                ({**model, "output": "out/a.png", "options": {"views": "front,left"}}, "names one picture", 1), ({**model, "output": "-"}, "omit this key", 1),
                ({**model, "timeout_s": 0}, "timeout_s", 1), ({**model, "timeout_s": "1"}, "timeout_s", 1), ({**model, "timeout_s": 601}, "at most 600", 1)):
            found = self.one(job)
            self.assertEqual((found["id"], found["exit"]), ("x", code), (job, found))
            if says:
                self.assertEqual(found["outcome"], "refused", (job, found))
                self.assertIn(says, found["error"], job)

    def test_options_that_are_the_workers(self):
        for option, value in {"memory-limit": "9G", "time-limit": "none", "file-limit": "1T", "allow-path": "/", "sandbox": "off", "threads": 9, "device": "gl",
                              "journal": "x", "jobs": "-", "files-from": "in/cube.obj", "resume": True, "isolate": True, "report": "x.html", "json": True,
                              "verbose": True, "dry-run": True, "help": True, "version": True, "save-scene": "out/x.json", "output": "out/x.png",
                              "font": "in/cube.obj", "repeat": 3, "gl-device": "1", "durable": True}.items():
            self.refuse({"id": 1, "model": "teapot", "options": {option: value}}, f"option '--{option}' is not allowed in a job", 1)
        self.assertEqual(sorted(os.listdir(self.folder / "out")), [])

    def test_paths(self):
        folder = self.folder
        os.symlink(folder / "secret", folder / "in/away")
        os.symlink("../secret/cube.stl", folder / "in/file.stl")
        os.symlink("../secret/new.png", folder / "out/nowhere.png")
        os.symlink("../secret", folder / "out/away")
        os.mkfifo(folder / "in/pipe.stl")
        os.mkfifo(folder / "out/pipe.png")
        (folder / "secret/look").write_text("size 3")
        (folder / "in/mtl.obj").write_text("mtllib ../secret/x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (folder / "in/scene.json").write_text(json.dumps({"lambent": 1, "objects": [{"mesh": "../secret/cube.stl"}]}))
        before = {name: (folder / "secret" / name).read_bytes() for name in os.listdir(folder / "secret")}
        for more in ([], ["--isolate"], ["--sandbox", "off"], ["--sandbox", "off", "--isolate"]):
            inputs = [str(folder / "secret/cube.stl"), "secret/cube.stl", "in/../secret/cube.stl", "in/away/cube.stl", "in/file.stl", "/etc/passwd",
                      "in/away/none.stl", "in/none/../../secret/cube.stl", "..", ".", "/", "in/../..", "/proc/self/environ", "/dev/zero", "/dev/stdin"]
            outputs = ["secret/x.png", "x.png", "in/../x.png", "out/away/x.png", "out/nowhere.png", str(folder / "x.png"), "out/pipe.png", "/dev/stdout",
                       "/dev/null", "out/none/../../secret/x.png", "../x.png", "{dir}/../x.png", "out/../secret/{stem}.png"]
            jobs = [{"id": f"in{i}", "model": path} for i, path in enumerate(inputs)]
            jobs += [{"id": f"out{i}", "model": "teapot", "options": {"size": 8}, "output": path} for i, path in enumerate(outputs)]
            jobs += [{"id": "env", "model": "teapot", "options": {"environment": "secret/sky.hdr"}},
                     {"id": "env6", "model": "teapot", "options": {"environment": "in/a,in/b,in/c,in/d,in/e,secret/f"}},
                     {"id": "look", "model": "teapot", "options": {"look": "secret/look"}}, {"id": "look2", "model": "teapot", "options": ["--look", "secret/look"]}]
            for answer, job in zip(self.answers(*jobs, words=more), jobs):
                self.assertEqual(answer["outcome"], "refused", (more, job, answer))
                self.assertEqual(answer["exit"], 5 if job["id"].startswith("out") else 2, (more, job, answer))
                self.assertIn("regular file" if job.get("output") == "out/pipe.png" else "is outside", answer["error"], job)
            # Files of a model must be in the model's folder; a pipe is not opened; a folder is not a
            # model.
            found = self.answers({"id": 1, "model": "in/mtl.obj"}, {"id": 2, "model": "in/scene.json"}, {"id": 3, "model": "in/pipe.stl"}, {"id": 4, "model": "in"},
                                 words=more)
            self.assertIn("x.mtl", found[0]["warnings"][0])
            self.assertEqual([(a["outcome"], a["exit"]) for a in found[1:]], [("failed", 2)] * 3, found)
            self.assertEqual({name: (folder / "secret" / name).read_bytes() for name in os.listdir(folder / "secret")}, before)
            self.assertFalse((folder / "x.png").exists())

    def test_nothing_is_allowed_by_default(self):
        found = self.answers({"id": 1, "model": "in/cube.stl"}, {"id": 2, "model": "teapot", "options": {"size": 8}}, {"id": 3, "model": "teapot", "output": "a.png"},
                             allow=())
        self.assertEqual([a["outcome"] for a in found], ["refused", "written", "refused"])
        self.assertIn("--allow-path", found[0]["error"])

    def test_allowed_reads(self):
        (self.folder / "in/look").write_text("samples 1\n")
        found = self.one({"id": 1, "model": str(self.folder / "in/../in/cube.stl"), "options": {"look": "in/look", "size": 8}, "output": str(self.folder / "out/../out/a/b.png")},
                         code=0)
        self.assertEqual(found["outcome"], "written")
        self.assertTrue((self.folder / "out/a/b.png").exists())

    def test_ids(self):
        """An id may be used again after its answer, but not before."""
        worker = self.start("-j", "1")
        worker.say({"id": "a", "model": "teapot", "options": {"size": 3000, "samples": 16}}, {"id": "a", "model": "teapot", "options": {"size": 8}},
                   {"id": 1, "model": "teapot", "options": {"size": 8}}, {"id": "1", "model": "teapot", "options": {"size": 8}})
        self.assertEqual(worker.answer(None)["error"], "line 2: key 'id': another job with this id is waiting or being drawn")
        worker.say({"cancel": "a"})
        worker.answer("a"), worker.answer(1), worker.answer("1")
        worker.say({"id": "a", "model": "teapot", "options": {"size": 8}})
        self.assertEqual(worker.end(), 7)
        self.assertEqual([a["outcome"] for a in worker.answers if a["id"] == "a"], ["cancelled", "written"])

    def test_long_lines(self):
        worker = self.start("--line-limit", "5000")
        job = {"id": 1, "model": "in/cube.stl", "options": {"size": 8}}
        worker.say(job, b"x" * 5001, b"y" * 3000000, {**job, "id": 2}, b" " * (5000 - len(json.dumps({**job, "id": 3}))) + json.dumps({**job, "id": 3}).encode())
        self.assertEqual(worker.end(), 7)
        self.assertEqual(sorted((a["id"] or 0, a.get("line", 0), a["exit"]) for a in worker.answers), [(0, 2, 4), (0, 3, 4), (1, 0, 0), (2, 0, 0), (3, 0, 0)])
        self.assertIn("longer than the limit of 5000 bytes (--line-limit)", worker.answer(None)["error"])

    def test_command_line(self):
        for words, says in ((["in/cube.stl"], "names its model"), (["-o", "out/"], "'--jobs' and '--output'"), (["--resume"], "'--resume'"), (["--report", "r.html"], "'--report'"),
                            (["--skip-same"], "--journal FILE"), (["--allow-path", "in/cube.stl"], "expected a folder"), (["--json"], "'--json'"), (["--shard", "1/2"], "'--shard'"), (["--ahead", "0"], "'--ahead'")):
            done = self.run_program("batch", "--jobs", "-", *words)
            self.assertEqual(done.returncode, 1, (words, done.stderr))
            self.assertIn(says, done.stderr.decode())
        self.assertIn(b"-j 4 sets", self.run_program("batch", "in", "--jobs", "4").stderr)
        self.assertIn(b"lambent batch --jobs -", self.run_program("in/cube.stl", "--jobs", "-").stderr)
        self.assertIn(b"requires --jobs", self.run_program("batch", "in", "--ahead", "4").stderr)
        done = self.run_program("batch", "--jobs", "none")
        self.assertEqual((done.returncode, done.stderr), (2, b"lambent: none: cannot read the jobs: No such file or directory\n"))


class Lists(Jobs):
    """--list: rows with a model, a picture and options."""

    def answers(self, name, text, *words, exit=0):
        (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        done = self.run_program("batch", "--list", name, "--allow-path", ".", "-q", *words)
        self.assertEqual(done.returncode, exit, done.stderr)
        return {answer["id"] or answer["line"]: answer for answer in map(json.loads, done.stdout.splitlines())}

    def test_csv_and_json_lines_are_the_same_pictures(self):
        rows = [{"model": "in/cube.stl", "output": "out/a.png", "size": "32", "view": "front", "material": "gold,roughness=0.2"},
                {"model": "sphere", "output": 'out/b "2".png', "size": "24x16", "two-sided": True}]
        lines = "\ufeffmodel,output,size,view,material,two-sided\r\nin/cube.stl,out/a.png,32,front,\"gold,roughness=0.2\",\r\n\r\nsphere,\"out/b \"\"2\"\".png\",24x16,,,true\r\n"
        drawn = []
        for name, text in (("list.csv", lines), ("list.jsonl", "".join(json.dumps(row) + "\n" for row in rows))):
            answers = self.answers(name, text, "-b", "white")
            self.assertEqual([answers[id]["outcome"] for id in sorted(answers)], ["written"] * 2)
            drawn.append([(self.folder / row["output"]).read_bytes() for row in rows])
            for row in rows:
                (self.folder / row["output"]).unlink()
        self.assertEqual(*drawn)
        self.good("in/cube.stl", "-q", "-s", 32, "--view", "front", "--material", "gold,roughness=0.2", "-b", "white", "-o", "alone.png")
        self.assertEqual((self.folder / "alone.png").read_bytes(), drawn[0][0])

    def test_errors_name_the_line(self):
        for name, text, line, says in (
                ("a.csv", "model,output,siez\ncube,a.png,8\n", 2, "line 2: unknown option '--siez'"), ("a.csv", "model,output\ncube,a.png,8\n", 2, "found 3 fields, expected at most 2"),
                ("a.csv", "model,model\ncube,a.png\n", 1, "column 2: found 'model'"), ("a.csv", "model;output\ncube;a.png\n", 1, "found the column 'model;output', expected names separated by commas"),
                ("a.csv", "model\ncube\n", 2, "the first line names no valid columns"), ("a.csv", "output,model\n,cube\n", 2, "column 'output': is missing"), ("a.csv", b"model,output\ncube,a\0.png\n", 2, "expected fields of CSV"),
                ("a.csv", 'model,output\n"cube,a.png\n', 2, "each quoted field on one line"), ("a.csv", b"model,output\ncube,\xff.png\n", 2, "UTF-8"),
                ("a.csv", "model,output,journal\ncube,a.png,j\n", 2, "journal"), ("a.csv", "model,output\ncube,../a.png\n", 2, "../a.png"),
                ("a.jsonl", "[1]\n", 1, "expected an object of JSON"), ("a.jsonl", '{"output": "a.png"}\n', 1, "expected either key 'model'")):
            answer = self.answers(name, text, exit=7)[line]
            self.assertEqual(answer["outcome"], "refused", text)
            self.assertIn(says, answer["error"], text)
        answers = self.answers("a.csv", "model,output\ncube,a.png\nsphere,a.png\n", "-s", 8, exit=7)
        self.assertEqual([answers[2]["outcome"], answers[3]["outcome"]], ["written", "refused"])
        self.assertIn("line 3: column 'output': line 2 names 'a.png', too", answers[3]["error"])
        for words, says in ((("--list", "list.txt"), "FILE.csv or FILE.jsonl"), (("--list", "a.csv", "--jobs", "-"), "cannot be used together"), (("--list", "a.csv", "cube"), "each row names its model"),
                            (("--list", "a.csv", "-o", "x/"), "'--list' and '--output'"), (("--list", "none.csv"), "none.csv: cannot read")):
            self.assertIn(says, self.run_program("batch", *words).stderr.decode(), words)


class Flow(Jobs):
    SLOW = {"model": "teapot", "options": {"size": 3000, "samples": 16}}

    def test_backpressure(self):
        """One job is being drawn, two wait, one is read; the others stay in the pipe."""
        for more in ([], ["--isolate"]):
            worker = self.start("-j", "1", "--ahead", "2", *more)
            worker.say({"id": "slow", "model": "teapot", "options": {"size": 6000, "samples": 16}})
            time.sleep(0.3)
            os.set_blocking(worker.process.stdin.fileno(), False)
            line = json.dumps({"id": 0, "model": "in/cube.stl", "x": "y" * 4000}).encode() + b"\n"  # refused as soon as it is read
            good = [json.dumps({"id": i, "model": "in/cube.stl", "options": {"size": 8}}).encode() + b"\n" for i in range(3)]
            sent = 0
            for piece in [*good, *[line] * 40]:
                try:
                    sent += os.write(worker.process.stdin.fileno(), piece) == len(piece)
                except BlockingIOError:
                    break
            time.sleep(0.5)
            self.assertLess(sent, 43)  # the pipe is full because nobody reads
            with worker.came:
                self.assertEqual(worker.answers, [])
            os.set_blocking(worker.process.stdin.fileno(), True)
            worker.end()
            self.assertEqual({a["id"] for a in worker.answers if a["outcome"] == "written"}, {"slow", 0, 1, 2})

    def test_cancel(self):
        for more in ([], ["--isolate"]):
            worker = self.start("-j", "1", *more)
            worker.say({"id": "drawn", "model": "teapot", "options": {"size": 12000, "samples": 16}, "output": "out/big.png"}, {"id": "waits", **self.SLOW})
            time.sleep(0.4)
            start = time.time()
            worker.say({"cancel": "waits"}, {"cancel": "drawn"}, {"cancel": "other"})
            for id in ("waits", "drawn"):
                answer = worker.answer(id, 10)
                self.assertEqual((answer["outcome"], answer["class"], answer["exit"], answer["error"]), ("cancelled", "cancelled", 130, "teapot: cancelled"))
            self.assertLess(time.time() - start, 15)
            self.assertEqual(worker.answer(None)["outcome"], "ignored")
            worker.say({"id": "after", "model": "in/cube.stl", "options": {"size": 8}})
            self.assertEqual(worker.answer("after")["outcome"], "written")
            self.assertEqual(worker.end(), 0, worker.err)
            self.assertIn(b"2 cancelled", worker.err)
            self.assertEqual(os.listdir(self.folder / "out"), [])

    def test_timeout(self):
        for more in ([], ["--isolate"]):
            start = time.time()
            found = self.answers({"id": 1, "model": "teapot", "options": {"size": 8000, "samples": 16}, "timeout_s": 0.4},
                                 {"id": 2, "model": "in/cube.stl", "options": {"size": 8}, "timeout_s": 30},
                                 {"id": 3, "model": "in/cube.stl", "options": {"size": 500, "turntable": 100000}, "timeout_s": 0.4}, words=more)
            self.assertEqual([(a["outcome"], a["class"]) for a in found], [("failed", "limit"), ("written", "ok"), ("failed", "limit")])
            self.assertIn("the time limit of 0.4 s was reached", found[0]["error"])
            self.assertLess(time.time() - start, 30)

    def test_crashes_and_hangs(self):
        """With --isolate, a process that crashes or hangs affects only its own job."""
        for number, outcome, says in ((signal.SIGSEGV, "crashed", "ended by signal 11"), (signal.SIGKILL, "crashed", "ended by signal 9"),
                                      (signal.SIGSTOP, "limit", "the time limit of 1 s was reached")):
            worker = self.start("-j", "1", "--isolate", "--time-limit", "1" if number == signal.SIGSTOP else "60")
            worker.say({"id": 1, "model": "teapot", "options": {"size": 12000 if number != signal.SIGSTOP else 6000, "samples": 16}, "output": "out/x.png"})
            until = time.time() + 20
            while not writers_and_others(worker.process.pid)[1] and time.time() < until:
                time.sleep(0.005)
            os.kill(writers_and_others(worker.process.pid)[1][0], number)
            answer = worker.answer(1, 20)
            self.assertEqual((answer["outcome"], answer["class"]), ("failed", outcome))
            self.assertIn(says, answer["error"])
            worker.say({"id": 2, "model": "in/cube.stl", "options": {"size": 8}})
            self.assertEqual(worker.answer(2)["outcome"], "written")
            self.assertEqual(worker.end(), 7)
            self.assertEqual(os.listdir(self.folder / "out"), [])

    def test_interrupt(self):
        """After Ctrl-C or SIGTERM, every job is answered and no partial files remain, within about a second."""
        for number in (signal.SIGINT, signal.SIGTERM):
            for more in ([], ["--isolate"]):
                worker = self.start("-j", "2", *more)
                worker.say(*({"id": i, "model": "teapot", "options": {"size": 8000, "samples": 16}, "output": f"out/{i}.png"} for i in range(5)), {"cancel": "nobody"})
                self.assertEqual(worker.answer(None, 20)["outcome"], "ignored")  # all five have been read
                start = time.time()
                worker.process.send_signal(number)
                self.assertEqual(worker.end(20), -number, worker.err)
                self.assertLess(time.time() - start, 15)
                self.assertEqual(sorted((a["id"], a["outcome"], a["exit"]) for a in worker.answers if a["id"] is not None), [(i, "cancelled", 130) for i in range(5)])
                self.assertIn(b"interrupted: 0 of 5 pictures written", worker.err)
                self.assertEqual(os.listdir(self.folder / "out"), [])

    def test_interrupt_while_nobody_reads(self):
        """Unread answers do not prevent the worker from ending."""
        process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", "-j", "2"], cwd=self.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for i in range(6):
            process.stdin.write(json.dumps({"id": i, "model": "teapot", "options": {"size": 600}}).encode() + b"\n")
        process.stdin.flush()
        wait_until_caught(process, signal.SIGTERM)
        time.sleep(1)
        start = time.time()
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(30), -signal.SIGTERM)
        self.assertLess(time.time() - start, 15)
        process.communicate()

    def test_output_is_closed(self):
        for more in ([], ["--isolate"]):
            for idle in (True, False):
                process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", "-j", "2", *more], cwd=self.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE)
                if not idle:
                    for i in range(4):
                        process.stdin.write(json.dumps({"id": i, **self.SLOW}).encode() + b"\n")
                    process.stdin.flush()
                    time.sleep(0.2)
                process.stdout.close()  # its input stays open
                start = time.time()
                self.assertEqual(process.wait(30), 5)
                self.assertLess(time.time() - start, 30)
                text = process.stderr.read().decode()
                self.assertEqual(text.count("standard output: cannot write answers: Broken pipe"), 1, text)
                process.stdin.close()
                process.stderr.close()

    def test_socket(self):
        """Standard input and output may be a socket, as from inetd and systemd."""
        here, there = socket.socketpair()
        process = subprocess.Popen([PROGRAM, "batch", "--jobs", "-", "-q"], cwd=self.folder, stdin=there, stdout=there)
        there.close()
        with here.makefile("rw") as stream:
            print(json.dumps({"id": 1, "model": "teapot", "options": {"size": 400}}), file=stream, flush=True)
            answer = json.loads(stream.readline())
            self.assertEqual(read_png(base64.b64decode(answer["data"]))[:2], (400, 400))
            here.shutdown(socket.SHUT_WR)
            self.assertEqual(process.wait(20), 0)
        here.close()


def hostile(random, number, folder):
    """A malformed line, the possible results in its answer, and its id, or None if it has none."""
    job = {"id": number, "model": "in/cube.stl", "options": {"size": 16}}
    claims = b"\0" * 80 + struct.pack("<I", 4000000000) + b"\0" * 50
    ply = b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n\0\0"
    cut = (OWN_MODELS / "cube.glb").read_bytes() if (OWN_MODELS / "cube.glb").exists() else (OWN_MODELS / "cube.stl").read_bytes()
    inline = lambda data, name: {"id": number, "data": base64.b64encode(data).decode(), "name": name, "options": {"size": 16}}
    kinds = [
        lambda: (bytes(random.choice(b"{}[]\",:0123abc\xff\x00 ") for _ in range(random.randrange(1, 300))), None),
        lambda: (bytes(b for b in random.randbytes(random.randrange(1, 2000)) if b != 10) + b"x", None),
        lambda: (json.dumps(job).encode()[:-random.randrange(1, 30)], None),
        lambda: (b"[" * random.randrange(1, 5000), None),
        lambda: (inline(claims, "x.stl"), {"failed"}),
        lambda: (inline(ply, "x.ply"), {"failed"}),
        lambda: (inline(cut[:random.randrange(1, len(cut))], "x.bin"), {"failed", "written"}),
        lambda: (inline(random.randbytes(500), random.choice(["x.obj", "x.glb", "x.ply", "x.stl", "x.json"])), {"failed", "written"}),
        lambda: (inline(b'{"asset":{"version":"2.0"},"x":' + b"[" * 3000, "x.gltf"), {"failed"}),
        lambda: (inline(b"mtllib /etc/passwd\nmtllib ../../../etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "x.obj"), {"written"}),
        lambda: ({**job, "model": random.choice(["/etc/passwd", "../x", "in/../secret/cube.stl", "in/away/cube.stl", "in/link.stl", "/proc/self/mem", "/dev/zero", ".."])},
                 {"refused"}),
        lambda: ({**job, "model": random.choice(["in/none.stl", "in", "in/pipe.stl", "in/empty.stl", "in/huge.stl", "in/cut.stl"])}, {"failed"}),
        lambda: ({**job, "output": random.choice(["/x.png", "../x.png", "out/away/x.png", "out/pipe.png", "secret/x.png", "/dev/full"])}, {"refused"}),
        lambda: ({**job, "options": random.choice([{"size": -1}, {"size": "1e9"}, {"nonsense": 1}, ["--"] * 5 + ["x"], {"json": True}, {"light": "what=?"},
                                                   {"camera": "eye=nan"}, "x", 7])}, {"refused"}),
        lambda: ({**job, "options": {"size": "65535x65535", "samples": 16}}, {"failed"}),
        lambda: ({**job, "model": "teapot", "options": {"size": 4000, "samples": 16}, "timeout_s": 0.02}, {"failed"}),
        lambda: ({**job, "options": {"turntable": 100000, "size": 64}, "timeout_s": 0.05}, {"failed"}),
        lambda: ({**job, "timeout_s": random.choice([-1, 0, "x", 1e300])}, {"refused"}),
        lambda: ({**job, "format": random.choice(["tif", "x" * 11, "PNG"])}, {"failed", "refused"}),
        lambda: ({**job, "id": random.choice([None, {}, [], 1.5, "y" * 300])}, None),
        lambda: ({"cancel": random.choice([-99, "nobody", None])}, None),
        lambda: (b"z" * random.randrange(70000, 200000), None),
    ]
    return random.choice(kinds)()


class Many(Jobs):
    """Hundreds of jobs, including hostile ones; `make test-long` has 10,000: nothing is lost, nothing hangs, and memory use is constant."""

    def prepare(self):
        folder = self.folder
        os.symlink(folder / "secret", folder / "in/away")
        os.symlink("../secret/cube.stl", folder / "in/link.stl")
        os.symlink("../secret", folder / "out/away")
        os.mkfifo(folder / "in/pipe.stl")
        os.mkfifo(folder / "out/pipe.png")
        (folder / "in/empty.stl").write_bytes(b"")
        (folder / "in/huge.stl").write_bytes(b"\0" * 80 + struct.pack("<I", 4000000000) + b"\0" * 50)
        (folder / "in/cut.stl").write_bytes((OWN_MODELS / "cube.stl").read_bytes()[:200])

    def resident(self, worker):
        text = pathlib.Path(f"/proc/{worker.process.pid}/status").read_text()
        return int(next(line for line in text.splitlines() if line.startswith("VmRSS")).split()[1])

    def run_many(self, *more):
        self.prepare()
        rng = random.Random(15)
        worker = self.start("-j", "2", "--ahead", "8", "--line-limit", "65536", *more)
        self.good("in/cube.stl", "-s", "16", "-o", "alone.png")
        self.good("in/cube.stl", "-s", "24", "-o", "alone24.png")
        alone = {size: (self.folder / name).read_bytes() for size, name in ((16, "alone.png"), (24, "alone24.png"))}
        expected, good, lines, sizes, cancels = {}, {}, 0, [], []
        # The memory that a process keeps for reuse grows with the largest job; these jobs are as
        # large as any below.
        for number in range(-8, 0):
            worker.say({"id": number, "model": "teapot", "options": {"size": 4000, "samples": 16}, "timeout_s": 0.3}, b"z" * 200000)
            expected[number] = {"failed", "written"}
            lines += 1
        for number in range(JOBS):
            kind = rng.random()
            if kind < 0.3:
                line, outcomes = hostile(rng, number, self.folder)
                lines += outcomes is None
                if outcomes:
                    expected[number] = outcomes
            elif kind < 0.35:
                line = {"id": number, "model": "teapot", "options": {"size": 200}}
                expected[number] = {"written", "cancelled"}
                cancels.append(number)
            else:
                size = rng.choice([16, 24])
                line = {"id": number, "model": "in/cube.stl", "options": {"size": size}}
                if rng.random() < 0.5:
                    line["output"] = f"out/{number}.png"
                expected[number], good[number] = {"written"}, (size, line.get("output"))
            worker.say(line)
            if cancels and rng.random() < 0.3:
                worker.say({"cancel": cancels[-1]})
                lines += 1  # at most: it is answered if the job was already done
                cancels.pop()
            if number % 50 == 49:
                worker.answer(max(expected), 120)  # earlier jobs may still be drawn
                sizes.append(self.resident(worker))
        self.assertEqual(worker.end(300), 7, worker.err[-2000:])
        by_id = {}
        for answer in worker.answers:
            by_id.setdefault(answer["id"], []).append(answer)
        nameless = by_id.pop(None, [])
        self.assertEqual(set(by_id), set(expected))
        self.assertLessEqual(len(nameless), lines)
        for number, outcomes in expected.items():
            self.assertEqual(len(by_id[number]), 1, number)
            self.assertIn(by_id[number][0]["outcome"], outcomes, by_id[number])
        for number, (size, output) in good.items():
            answer = by_id[number][0]
            data = (self.folder / output).read_bytes() if output else base64.b64decode(answer["data"])
            self.assertEqual(data, alone[size], number)
        written = {name for name in os.listdir(self.folder / "out") if not name.startswith(("away", "pipe"))}
        self.assertEqual(written, {os.path.basename(output) for _, output in good.values() if output})
        self.assertEqual(os.listdir(self.folder / "secret"), ["cube.stl"])
        third = len(sizes) // 3
        early, late = max(sizes[third:2 * third]), max(sizes[2 * third:])
        print(f"# {JOBS} jobs: resident memory at most {early} kB in the second third, {late} kB in the last one")
        if self.sanitized():
            return
        self.assertLess(late, 200000)
        if JOBS >= 3000:  # each kind of job has occurred often by then
            self.assertLess(late, early * 1.05 + 4000)

    def sanitized(self):
        return b"__asan_init" in pathlib.Path(PROGRAM).read_bytes()

    def test_many(self):
        self.run_many()

    @long
    def test_many_isolated(self):
        self.run_many("--isolate")


class Examples(Jobs):
    def check_example(self, *command):
        names = ["in/cube.stl", "in/cube.obj", "in/none.stl"]
        done = subprocess.run([*map(str, command), *names], cwd=self.folder, env={**os.environ, "LAMBENT": PROGRAM}, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("in/none.stl: cannot open", done.stdout)
        for name in ("cube.stl", "cube.obj"):
            self.good(f"in/{name}", "-s", "256", "-o", "alone.png")
            self.assertEqual((self.folder / f"{name}.png").read_bytes(), (self.folder / "alone.png").read_bytes())

    def test_python(self):
        self.check_example("python3", ROOT / "examples/worker.py")

    @unittest.skipUnless(shutil.which("node"), "needs node")
    def test_node(self):
        self.check_example("node", ROOT / "examples/worker.mjs")
