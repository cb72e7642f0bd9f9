"""drawing.py: draws rows with one `lambent batch --jobs - --isolate`, which has no network and can read only the folder of its job. The models are
copied into this folder from their store, and the pictures of the answers go to theirs."""
import base64
import concurrent.futures
import contextlib
import glob
import itertools
import json
import os
import queue
import re
import shutil
import subprocess
import tempfile
import threading
import urllib.parse

from .stores import Problem, fetch, folder_of, inside, join, put, tag

# The names of other files in a model: fetched before the first drawing. Names that these patterns overlook are in the worker's answer, because the
# reader looked for the files, and the model is then drawn again.
NAMES = {"obj": rb"(?m)^\s*mtllib\s+(.+?)\s*$", "mtl": rb"(?mi)^\s*(?:map_\w+|bump|disp|norm|refl)\s(?:.*\s)?(\S+)\s*$", "gltf": rb'"uri"\s*:\s*("(?!data:)(?:[^"\\]|\\.)*")'}
NOT_KEPT = {"id", "data", "outcome", "pictures", "line", "files", "key"}  # of an answer
ROUNDS = 8  # of reading a model again, because it changed
JOURNAL = "worker.jsonl"  # the worker's own journal, which is emptied now and then
MEMORY = 256 << 20  # bytes of models that wait or are drawn


def program():
    """The name of the program."""
    name = os.environ.get("LAMBENT", "lambent")
    if not shutil.which(name):
        raise Problem("%s: is not a program; install lambent, or set LAMBENT" % name, "unsupported", 3)
    return name


class Worker:
    """The process, and the answers that are awaited."""

    def __init__(self, folder, settings, jobs):
        command = [program(), "batch", "--jobs", "-", "--isolate", "--quiet", "--failures-ok", "--allow-path", folder, "--ahead", "10000",
                   "-j", str(jobs), "--journal", os.path.join(folder, JOURNAL),  # so that answers name the files that the reader looked for
                   *settings.get("options", ())]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.waiting, self.numbers, self.lock, self.ended = {}, itertools.count(), threading.Lock(), None
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            answer = json.loads(line)
            self.waiting.pop(answer["id"]).set_result(answer)
        text = self.process.stderr.read().decode(errors="replace").strip().split("\n")[0]
        with self.lock:
            self.ended = Problem(text or "the worker ended", "crashed", self.process.wait() or 8, "machine")
            for future in self.waiting.values():
                future.set_exception(self.ended)

    def draw(self, job):
        """Sends a job and waits for its answer."""
        future = concurrent.futures.Future()
        with self.lock:
            if self.ended:
                raise self.ended
            number = next(self.numbers)
            self.waiting[number] = future
            with contextlib.suppress(OSError):  # the reader tells why
                self.process.stdin.write(json.dumps({"id": number, **job}).encode() + b"\n")
                self.process.stdin.flush()
        return future.result()


class Budget:
    """Holds back the next model while many bytes wait to be drawn."""

    def __init__(self, limit):
        self.limit, self.held, self.changed = limit, 0, threading.Condition()

    def add(self, count, wait=False):
        with self.changed:
            self.changed.wait_for(lambda: not wait or not self.held or self.held + count <= self.limit)
            self.held += count
            self.changed.notify_all()


class Model:
    """A model in the folder of its job, with the files that it names."""

    def __init__(self, row, folder, settings, budget):
        self.row, self.folder, self.settings, self.budget = row, folder, settings, budget
        self.home, self.name, self.files, self.bytes = folder_of(row["model"]), row["model"].rpartition("/")[2], {}, 0
        os.mkdir(folder)

    def add(self, name):
        """Fetches a file; a file that the store lacks is recorded as missing."""
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        left = self.settings.get("size_limit", 1 << 30) - self.bytes
        self.files[name], count = fetch(self.home + name, path, self.row["prefix"], left)
        self.bytes += count
        self.budget.add(count)
        if pattern := NAMES.get(name.rpartition(".")[2].lower()):
            with open(path, "rb") as file:
                found = dict.fromkeys(re.findall(pattern, file.read()))
            for text in (text.decode(errors="replace") for text in found):
                text = urllib.parse.unquote(json.loads(text)) if text.startswith('"') else text
                self.add_other(join(os.path.dirname(name), text.replace("\\", "/").removeprefix("./")))

    def add_other(self, name):
        """Fetches a file that the model names, if it is in the model's folder or below and not known yet. Returns whether it is there now."""
        if name in self.files or not inside(name) or ":" in name:
            return False
        self.files[name] = None
        try:
            self.add(name)
        except Problem as problem:
            if problem.kind not in ("gone", "model"):
                raise
        return self.files[name] is not None

    def fetch(self):
        """Fetches everything. A model that changed meanwhile is read again, so that its files belong together."""
        for _ in range(ROUNDS):
            self.add(self.name)
            if len(self.files) == 1 or tag(self.row["model"]) == self.files[self.name]:
                return
            self.remove()
            os.mkdir(self.folder)
        raise Problem("%s: changes while it is read" % self.row["model"], cause="machine")

    def missing(self, answer):
        """Fetches the files for which the reader looked in vain. Returns whether one is there now."""
        absent = [found["path"] for part in answer.get("pictures", [answer]) for found in part.get("files", ()) if found["hash"] == "absent"]
        names = [os.path.relpath(path, self.folder) for path in dict.fromkeys(absent) if path.startswith(self.folder + "/")]
        return any([self.add_other(name) for name in names])

    def remove(self):
        self.budget.add(-self.bytes)
        self.files, self.bytes = {}, 0
        shutil.rmtree(self.folder, ignore_errors=True)


def failure(problem):
    return {"class": problem.name, "exit": problem.exit, "error": str(problem), "cause": problem.cause, "warnings": []}


def draw_row(row, worker, folder, settings, budget):
    """The results of one model, one for each of its pictures."""
    outputs, model, size = row["outputs"], None, row.get("size") or 0
    try:
        if row.get("unless") and all(tag(found["path"]) == found["tag"] for found in row["unless"]):
            return [{"class": "same", "model": row["model"], "output": output} for output in outputs]
        budget.add(size, wait=True)
        try:
            model = Model(row, folder, settings, budget)
            model.fetch()
        finally:
            budget.add(-size)
        job = {"model": os.path.join(folder, model.name), "options": row.get("options", {}), "format": outputs[0].rpartition(".")[2]}
        while model.missing(answer := worker.draw(job)):  # each time, at least one more file is there
            pass
        parts = answer.get("pictures", [answer])
    except (Problem, OSError) as error:
        if worker.ended:
            raise
        parts = [failure(error if isinstance(error, Problem) else Problem("%s: %s" % (row["model"], error.strerror), cause="machine"))] * len(outputs)
    results = []
    for output, part in zip(outputs, parts if len(parts) == len(outputs) else parts[:1] * len(outputs)):
        result = {name: value for name, value in part.items() if name not in NOT_KEPT}
        result.update({name: row[name] for name in ("row", "key", "model") if name in row}, output=output, attempt=row.get("attempt", 1))
        # The user knows the models by their addresses, not by the folder of the job.
        result.update({name: json.loads(json.dumps(result[name]).replace(folder + "/", folder_of(row["model"]))) for name in ("error", "warnings") if name in result})
        if model:
            result.update(tag=model.files.get(model.name), files=[{"path": model.home + name, "tag": found} for name, found in model.files.items()])
        try:
            if part["class"] == "ok":
                result["stored"] = put(output, base64.b64decode(part["data"]))
            else:
                result.setdefault("cause", "model")
        except Problem as problem:
            result.update(failure(problem))
        results.append(result)
    if model:
        model.remove()
    return results


def new_folder():
    """A folder for jobs. Folders that killed processes left are removed."""
    start = os.path.join(os.path.realpath(tempfile.gettempdir()), "lambent-catalogue-")
    for old in glob.glob(start + "*"):
        if not os.path.exists("/proc/" + old[len(start):].partition("-")[0]):
            shutil.rmtree(old, ignore_errors=True)
    return tempfile.mkdtemp(prefix="%s%d-" % (start, os.getpid()))


def draw_each(rows, **settings):
    """Draws rows as they come, and yields the results as they come. Settings: options (words for the worker), jobs, size_limit, memory."""
    jobs = settings.get("jobs") or len(os.sched_getaffinity(0))
    folder, results, lock = new_folder(), queue.SimpleQueue(), threading.Lock()
    budget, rows, worker = Budget(settings.get("memory", MEMORY)), iter(enumerate(rows)), None

    def work():
        try:
            while True:
                with lock:
                    number, row = next(rows, (0, None))
                if row is None:
                    return results.put(None)
                if number % 1000 == 999:
                    os.truncate(os.path.join(folder, JOURNAL), 0)
                results.put(draw_row(row, worker, os.path.join(folder, str(number)), settings, budget))
        except BaseException as error:  # the run ends with it
            results.put(error)

    try:
        worker = Worker(folder, settings, jobs)
        threads = [threading.Thread(target=work, daemon=True) for _ in range(min(jobs * 4 + 12, 60))]  # most of them wait for the store or the worker
        for thread in threads:
            thread.start()
        for _ in threads:
            while (found := results.get()) is not None:
                if isinstance(found, BaseException):
                    raise found
                yield from found
        worker.process.stdin.close()
        worker.process.wait()
    finally:
        if worker:
            worker.process.kill()
        shutil.rmtree(folder, ignore_errors=True)


def draw(rows, **settings):
    """Draws a list of rows and returns a list of results: a pure function for engines, which starts its own worker and ends it. A row is a dict:
    model and output (addresses), prefix (above which no file is read), and options of the picture by their names."""
    return list(draw_each([row if "outputs" in row else row_of(row) for row in rows], **settings))


def row_of(row):
    """The row of a user as draw_each expects it."""
    options = {name: value for name, value in row.items() if name not in ("model", "output", "prefix")}
    return {"prefix": folder_of(row["model"]), **row, "outputs": [row["output"]], "options": options}
