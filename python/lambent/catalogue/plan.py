"""plan.py: the rows of a run: models from stores and lists, the names of their pictures, and the journal, which makes rows superfluous. The plan is a
temporary data base on the disk, so that memory does not grow with the number of models.

An object cannot grow, so the journal is a folder of segments: JSON Lines with the keys of `lambent batch` (docs/batch.md). No two runs write the same
segment, and each line is written once."""
import csv
import datetime
import hashlib
import itertools
import json
import os
import re
import secrets
import sqlite3
import subprocess
import tempfile
import time

from .drawing import program
from .stores import Problem, fetch, folder_of, inside, join, listed, put, read

OWN_COLUMNS = ("model", "output")
LINES, SECONDS = int(os.environ.get("LAMBENT_SEGMENT", 1000)), 30  # of a segment


def asked(*words, text=""):
    """What the program prints."""
    done = subprocess.run([program(), *words], input=text, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        raise Problem(done.stderr.strip().removeprefix("lambent: "), "usage", done.returncode)
    return done.stdout


def known_options():
    """{spelling: (name, whether a value follows)} of the program's options."""
    found = {}
    for letter, name, value in re.findall(r"^ +(?:(-\w), |    )--([a-z0-9-]+)(?: (\S+))?(?=  |$)", asked("--help"), re.M):
        found["--" + name] = found[letter] = name, bool(value)
    return found


def model_endings():
    """The endings of files that are models."""
    models = asked("formats").split("\n\n")[0].split("Pictures")[0]
    return {word.strip(".") for line in models.split("\n")[1:] for word in line.split()[1:]} - {"json"}


class Names:
    """Fills the pattern of -o for each picture, as `lambent batch` does (docs/batch.md)."""

    def __init__(self, pattern, views, sizes):
        self.views, self.sizes = views, sizes
        head, brace, _ = pattern.partition("{")
        self.root = folder_of(head)
        self.pattern = pattern[len(self.root):]
        if not brace and "." not in self.pattern:
            self.root = pattern if pattern.endswith("/") else pattern + "/"
            self.pattern = "{stem}" + "-{view}" * (len(views) > 1) + "-{size}" * (len(sizes) > 1) + ".png"
        wrong = set(re.findall(r"\{(.*?)\}", self.pattern)) - {"dir", "stem", "ext", "view", "size"}
        if wrong:
            raise Problem("-o: found '{%s}', expected {dir}, {stem}, {ext}, {view} or {size}" % sorted(wrong)[0], "usage", 1)

    def of(self, name, options):
        """The names for a model with this name below its folder."""
        folder, _, file = name.rpartition("/")
        stem, _, ending = file.rpartition(".")
        parts = {"dir": "/".join(part for part in folder.split("/") if part not in ("", ".", "..")), "stem": stem or file, "ext": ending}
        views, sizes = ([str(options[name])] if name in options else given for name, given in (("view", self.views), ("size", self.sizes)))
        for parts["view"], parts["size"] in itertools.product(views, sizes):
            filled = re.sub(r"\{(\w+)\}", lambda found: parts[found[1]], self.pattern)
            yield join(self.root, re.sub("/+", "/", filled).lstrip("/"))


class Source:
    """What the command line names: folders and models, or a list with the folder of its models."""

    def __init__(self, operands, catalogue, names):
        self.operands, self.catalogue, self.names = operands, catalogue, names
        self.endings = model_endings()

    def rows(self):
        """(row, bytes, tag) of each model."""
        for operand in [] if self.catalogue else self.operands:
            folder = operand if operand.endswith("/") else operand + "/"
            found = listed(folder)
            if self.is_model(operand):
                folder, found = folder_of(operand), [(operand, None, None)]
            yield from ((self.row(address, folder, {}), size, tag) for address, size, tag in found if self.is_model(address[len(folder):]))
        if self.catalogue:
            yield from ((row, None, None) for row in self.listed_rows())

    def is_model(self, name):
        return name.rpartition(".")[2].lower() in self.endings and not name.startswith(".") and "/." not in name

    def row(self, model, prefix, options):
        return {"model": model, "prefix": prefix, "outputs": list(self.names.of(model[len(prefix):], options)), "options": options}

    def listed_rows(self):
        """The rows of a list: CSV with a header, JSON Lines, or a name on each line."""
        prefix = self.operands[0] if self.operands else folder_of(self.catalogue)
        prefix = prefix if not prefix or prefix.endswith("/") else prefix + "/"
        kind = self.catalogue.rpartition(".")[2].lower()
        with tempfile.NamedTemporaryFile("r", encoding="utf-8", newline="") as lines:
            fetch(self.catalogue, lines.name, folder_of(self.catalogue))
            number, seen = 0, set(OWN_COLUMNS)
            try:
                for number, found in enumerate(csv.DictReader(lines, strict=True) if kind == "csv" else lines, 1):
                    row = found if kind == "csv" else json.loads(found) if kind == "jsonl" else {"model": found.strip()}
                    row = {name: value for name, value in row.items() if value not in ("", None)}
                    if not seen.issuperset(row):
                        seen.update(self.check_columns(row))
                    yield self.listed_row(row, prefix, number)
            except (Problem, ValueError, AttributeError, TypeError, csv.Error) as error:
                raise Problem("%s: row %d: %s" % (self.catalogue, number, error), getattr(error, "name", "cannot-read"), getattr(error, "exit", 2)) from None

    def check_columns(self, row):
        """The worker knows the options of pictures: it refuses others, and those that open or write files, before anything is drawn."""
        if None in row:
            raise Problem("more values than columns", "usage", 1)
        options = {name: value for name, value in row.items() if name not in OWN_COLUMNS}
        answer = json.loads(asked("batch", "--jobs", "-", "--quiet", "--failures-ok", text=json.dumps({"id": 0, "data": "AA==", "name": "x.obj", "options": options})))
        if answer["outcome"] == "refused":
            raise Problem(answer["error"].removeprefix("line 1: "), "usage", 1)
        return row

    def listed_row(self, row, prefix, number):
        options = {name: value for name, value in row.items() if name not in OWN_COLUMNS}
        if not isinstance(row.get("model"), str):
            raise Problem("column 'model': is missing", "usage", 1)
        name = row["model"].removeprefix(prefix)
        if "://" in name or not inside(name):
            raise Problem("%s: is outside %s" % (row["model"], prefix or "the folder of the list"))
        for column in ("view", "size"):
            if "," in str(options.get(column, "")):
                raise Problem("column '%s': found '%s', expected one value, because a row is one picture" % (column, options[column]), "usage", 1)
        made = self.row(prefix + name, prefix, options)
        if "output" in row:
            output = row["output"].removeprefix(self.names.root)
            if not inside(output) or "://" in output:
                raise Problem("column 'output': %s: is outside %s" % (row["output"], self.names.root), "usage", 1)
            made["outputs"] = [self.names.root + output]
        return {**made, "row": number}


class Plan:
    """All rows of a run and their pictures."""

    failed = 0  # pictures that failed in an earlier run and are not drawn again

    def __init__(self):
        self.base = sqlite3.connect("", isolation_level=None, check_same_thread=False)  # a temporary file
        self.base.executescript("""
            PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA cache_size = -32000; BEGIN;
            CREATE TABLE rows(number INTEGER PRIMARY KEY, mine INT, size INT, tag TEXT, row TEXT);
            CREATE TABLE outputs(output TEXT PRIMARY KEY, number INT, key TEXT, seen TEXT, done_key TEXT, done TEXT) WITHOUT ROWID;""")

    def add(self, row, size, tag, mine, settings):
        """Adds a row. Two pictures with one name are an error before anything is drawn."""
        key = hashlib.md5(json.dumps([settings, row["options"], row["model"]], sort_keys=True).encode()).hexdigest()
        number = self.base.execute("INSERT INTO rows(mine, size, tag, row) VALUES (?, ?, ?, ?)", (mine, size, tag, json.dumps({**row, "key": key}))).lastrowid
        for output in row["outputs"]:
            try:
                self.base.execute("INSERT INTO outputs(output, number, key) VALUES (?, ?, ?)", (output, number, key))
            except sqlite3.IntegrityError:
                other = self.base.execute("SELECT row FROM rows JOIN outputs USING(number) WHERE output = ?", (output,)).fetchone()[0]
                raise Problem("%s and %s: both pictures would be %s" % (json.loads(other)["model"], row["model"], output), "usage", 1) from None

    def see(self, found):
        """Notes the pictures that exist."""
        self.base.executemany("UPDATE outputs SET seen = ? WHERE output = ?", ((tag, output) for output, _, tag in found))

    def note(self, lines):
        """Notes lines of the journal; later lines replace earlier ones."""
        kept = ("class", "cause", "stored", "tag", "files", "attempt")
        self.base.executemany("UPDATE outputs SET done = ?, done_key = ? WHERE output = ?",
                              ((json.dumps({name: line.get(name) for name in kept}), line.get("key"), line["output"]) for line in lines))

    def count(self):
        return self.base.execute("SELECT count(*) FROM outputs JOIN rows USING(number) WHERE mine").fetchone()[0]

    def check_resume(self):
        """The rows to draw must be those of the journal."""
        other = self.base.execute("SELECT output FROM outputs JOIN rows USING(number) WHERE mine AND done_key != key LIMIT 1").fetchone()
        if other:
            raise Problem("--resume: %s: the journal lists it with other options or another version; draw without --resume, or use --skip-same" % other, "usage", 1)

    def todo(self, resume, same, retries):
        """The rows to draw, and those that are unchanged unless one of their files is ("unless"), which costs requests, so draw_row looks."""
        known = self.base.execute("SELECT number, size, tag, row, key = done_key, seen, done FROM rows JOIN outputs USING(number) WHERE mine ORDER BY number")
        for _, pictures in itertools.groupby(known, lambda found: found[0]):
            needed, row = False, None
            for _, size, tag, text, right_key, seen, done in pictures:
                row, line = row or {**json.loads(text), "size": size}, json.loads(done) if done and (resume or same) else None
                whole = line and line["class"] == "ok" and seen is not None and seen == line["stored"]
                if line and line["class"] != "ok":
                    row["attempt"] = max(row.get("attempt", 1), line["attempt"] + 1)
                if line and resume:
                    failed = line["class"] != "ok" and line["cause"] == "model" and line["attempt"] > retries
                    self.failed += failed
                    needed = needed or not whole and not failed
                elif whole and right_key and tag in (None, line["tag"]):
                    row["unless"] = [file for file in line["files"] if tag is None or file["path"] != row["model"]]
                else:
                    needed = True
            row["unless"] = [] if needed else row.get("unless", [])
            if needed or row["unless"]:
                yield row


def key_of(address):
    """The run and the number of a segment: lambent-RUN-000001.jsonl"""
    return address.rpartition("/")[2].removeprefix("lambent-").removesuffix(".jsonl").rpartition("-")[::2]


class Journal:
    """The journal of a run, and those of the runs before it."""

    def __init__(self, folder, header):
        self.folder, self.header, self.lines, self.count, self.since = folder, header, [], 0, time.monotonic()
        self.run = "%s-%s" % (datetime.datetime.utcnow().strftime("%Y%m%dT%H%M%S%f"), secrets.token_hex(4))

    def runs(self):
        """The runs that no later run replaced: {run: (header, addresses of the segments)}."""
        found = {}
        for address in sorted((address for address, _, _ in listed(self.folder) if address.endswith(".jsonl")), key=key_of):
            found.setdefault(key_of(address)[0], []).append(address)
        headers = [json.loads(read(addresses[0]).split(b"\n", 1)[0]) for addresses in found.values()]
        old = {run for header in headers for run in header.get("replaces", ())}
        return {run: (header, found[run]) for run, header in zip(found, headers) if run not in old}

    def texts(self):
        """(header, bytes) of the segments in the order of their runs."""
        return ((header, read(address)) for header, addresses in self.runs().values() for address in addresses)

    def lines_before(self):
        """The lines about pictures of earlier runs."""
        return (line for _, text in self.texts() for line in map(json.loads, text.splitlines()) if "output" in line)

    def begin(self, fresh):
        """Starts the run. A run that does not continue an earlier one replaces the journals that are there, of its shard."""
        old = [run for run, (header, _) in self.runs().items() if header["shard"] == self.header["shard"]] if fresh else []
        self.lines.append({**self.header, "run": self.run, "replaces": old})
        self.write()

    def add(self, line):
        """Adds a line, and writes a segment if it is full or old."""
        self.lines.append(line)
        if len(self.lines) >= LINES or time.monotonic() - self.since >= SECONDS:
            self.write()

    def write(self):
        self.count += 1
        data = "".join(json.dumps(line, ensure_ascii=False, separators=(",", ":")) + "\n" for line in self.lines)
        put(join(self.folder, "lambent-%s-%06d.jsonl" % (self.run, self.count)), data.encode(errors="replace"))
        self.lines, self.since = [], time.monotonic()

    def end(self, code):
        self.lines.append({"ended": code is not None, "exit": 130 if code is None else code})
        self.write()


def summary(folder, words):
    """`lambent journal` on the segments of a folder, or of the folder of the pictures."""
    with tempfile.TemporaryDirectory() as made:
        for header, text in Journal(folder if "lambent.journal" in folder else join(folder, "lambent.journal/"), {}).texts():
            shard = "-%s-of-%s" % tuple(header["shard"].split("/")) if header["shard"] != "1/1" else ""
            with open(os.path.join(made, "lambent%s.jsonl" % shard), "ab") as file:
                file.write(text)
        return subprocess.run([program(), "journal", made, *words]).returncode
