# __main__.py: the command lambent-catalogue, which does with stores what `lambent batch` does with folders (docs/catalogue.md).
"""lambent-catalogue [MODELS ...] -o PATTERN [OPTION ...]
       lambent-catalogue journal FOLDER [OPTION of lambent journal ...]

Draws the models of a folder or a list in an object store: s3://BUCKET/FOLDER/, https:// (with --list), a folder of this machine,
or another address that fsspec knows. Every option of lambent for pictures and limits can be added: -s 256 --view front,iso."""
import argparse
import collections
import csv
import hashlib
import json
import os
import re
import signal
import sys
import tempfile
import time

from . import plan
from .drawing import draw_each
from .engine import on_dask
from .stores import Problem, join, listed, put

OWN_ELSEWHERE = {"report", "shard-by", "files-from", "durable", "jobs", "isolate", "allow-path", "ahead", "config", "repeat"}  # of lambent batch, not here
SHARDS = ("SLURM_ARRAY_TASK_ID", "OMPI_COMM_WORLD_RANK", "JOB_COMPLETION_INDEX")
TROUBLES = 10  # failures of the machine in succession that end the run


def parser():
    def fail(message):
        raise Problem("%s; see lambent-catalogue --help" % message, "usage", 1)

    made = argparse.ArgumentParser(prog="lambent-catalogue", usage=__doc__, allow_abbrev=False)
    made.error = fail
    made.add_argument("models", nargs="*", help="folders with models, or models; with --list, the folder of the list's models")
    made.add_argument("-o", "--output", metavar="PATTERN", help="the pictures: s3://shop/thumbs/{dir}/{stem}.png")
    made.add_argument("--list", metavar="FILE", help="a list of pictures: .csv or .jsonl with the columns model, output and any option; or a name on each line")
    made.add_argument("--resume", action="store_true", help="skip pictures that the journal lists as done")
    made.add_argument("--skip-same", action="store_true", help="skip pictures whose files (by their ETags) and options match the journal")
    made.add_argument("--retry-failed", metavar="N", type=int, default=0, help="with --resume: draw failed pictures again, at most N times [0]")
    made.add_argument("--failures-ok", action="store_true", help="exit with 0 even if models fail, provided that the journal records each")
    made.add_argument("--journal", metavar="FOLDER", help="the folder of the journal's segments, or none [lambent.journal/ beside the pictures]")
    made.add_argument("--results", metavar="FILE", help="also write the results of all pictures of this run: .csv or .jsonl")
    made.add_argument("--shard", metavar="K/N", help="draw only part K of N; auto/N takes K from Kubernetes, Slurm or Open MPI")
    made.add_argument("--dask", metavar="ADDRESS", help="draw with the workers of this Dask scheduler: tcp://scheduler:8786")
    made.add_argument("-j", "--threads", metavar="N", type=int, default=0, help="models that are drawn at the same time [one per processor]")
    made.add_argument("--size-limit", metavar="BYTES", type=int, default=1 << 30, help="reject a model with more bytes, its other files included [1 GiB]")
    made.add_argument("--dry-run", action="store_true", help="list the models with the names of their pictures")
    made.add_argument("-q", "--quiet", action="store_true", help="print only errors")
    return made


def split_words(words, own):
    """The words of this command, and the program's options for pictures, one word for each."""
    known = {spelling: option for spelling, option in plan.known_options().items() if spelling not in own._option_string_actions and option[0] not in OWN_ELSEWHERE}
    mine, theirs, words = [], [], iter(words)
    for word in words:
        spelling, equals, value = word.partition("=") if word.startswith("--") else (word[:2], "=" * (len(word) > 2), word[2:])
        if spelling not in known:
            mine.append(word)
            continue
        name, has_value = known[spelling]
        if has_value and not equals:
            equals, value = "=", next(words, "")
        theirs.append("--" + name + equals + value)
    return mine, theirs


def values_of(theirs, name, otherwise):
    """The last list of values of an option."""
    return ([word.partition("=")[2] for word in theirs if word.startswith("--%s=" % name)] or [otherwise])[-1].split(",")


def shard_of(text):
    """K and N of --shard."""
    part, _, count = (text or "1/1").partition("/")
    if part == "auto":
        found = [os.environ[name] for name in SHARDS if name in os.environ]
        part = str(int(found[0]) + 1) if len(found) == 1 else part
    if not (part.isdecimal() and count.isdecimal() and 1 <= int(part) <= int(count)):
        raise Problem("--shard: found %s, expected K/N with K from 1 to N, or auto/N and one of the variables %s" % (text, ", ".join(SHARDS)), "usage", 1)
    return int(part), int(count)


class Report:
    """The progress line, the results and the summary."""

    COLUMNS = ("row", "model", "output", "class", "error", "bytes", "hash", "ms", "warnings")

    def __init__(self, given, total):
        self.given, self.total, self.start = given, total, time.monotonic()
        self.counts, self.warnings, self.machine, self.troubles = collections.Counter(), 0, 0, 0
        self.line = sys.stderr.isatty() and not given.quiet
        self.results = tempfile.TemporaryFile("w+", newline="")
        self.table = csv.DictWriter(self.results, self.COLUMNS, extrasaction="ignore") if (given.results or "").endswith(".csv") else None
        if self.table:
            self.table.writeheader()

    def add(self, result):
        self.counts[result["class"]] += 1
        machine = result.get("cause") == "machine"
        self.warnings, self.machine, self.troubles = self.warnings + len(result.get("warnings", ())), self.machine + machine, (self.troubles + 1) * machine
        if result.get("error"):
            print("%s%s%s" % ("\r\033[K" * self.line, "row %d: " % result["row"] if "row" in result else "", result["error"]), file=sys.stderr)
        if self.table:
            self.table.writerow({**result, "ms": result.get("times_ms", {}).get("total"), "warnings": "; ".join(result.get("warnings", ()))})
        elif self.given.results:
            self.results.write(json.dumps(result) + "\n")
        done, seconds = self.counts.total(), time.monotonic() - self.start
        if self.line and done % 8 == 0:
            print("\r\033[K%d of %d, %.1f a second, %d s left" % (done, self.total, done / seconds, (self.total - done) * seconds / done), end="", file=sys.stderr, flush=True)

    def finish(self, failed_before):
        """Prints the summary and writes the results. Returns the exit code."""
        seconds, written, same = time.monotonic() - self.start, self.counts.pop("ok", 0), self.counts.pop("same", 0)
        stopped, failed = self.troubles >= TROUBLES, self.counts.total()
        unchanged = same if stopped else self.total - written - failed - failed_before
        text = "%d of %d pictures written" % (written, self.total) + ", %d unchanged" % unchanged * bool(unchanged)
        text += ", %d failed (%s)" % (failed, ", ".join("%s %d" % pair for pair in sorted(self.counts.items()))) if failed else ""
        text += "; the run stopped because %d in succession failed because of the machine or the store" % TROUBLES * stopped
        text += ", %d failed before" % failed_before * bool(failed_before) + ", %d warnings" % self.warnings * bool(self.warnings)
        if not self.given.quiet:
            print("%s%s; %.1f s, %.3g a second" % ("\r\033[K" * self.line, text, seconds, written / max(seconds, 1e-9)), file=sys.stderr)
        if self.given.results:
            self.results.seek(0)
            put(self.given.results, self.results.read().encode())
        return 5 if stopped or self.counts["cannot-write"] else 7 if self.machine or (failed or failed_before) and not self.given.failures_ok else 0


def make_plan(given, theirs, version, part, count):
    names = plan.Names(given.output, values_of(theirs, "view", "three-quarter"), values_of(theirs, "size", "1024"))
    made, key = plan.Plan(), [theirs, version]
    for row, size, tag in plan.Source(given.models, given.list, names).rows():
        name = row["model"][len(row["prefix"]):]
        made.add(row, size, tag, int(hashlib.md5(name.encode()).hexdigest(), 16) % count == part - 1, key)
    return made, names.root


def run(given, theirs):
    """Draws. Returns the exit code."""
    plan.asked("batch", "--jobs", "-", "--quiet", *theirs)  # wrong options end here, with the program's sentence
    version, shard = plan.asked("--version").split("\n")[:2], shard_of(given.shard)
    made, root = make_plan(given, theirs, version, *shard)
    if given.dry_run:
        sys.stdout.writelines("%s -> %s\n" % (row["model"], output) for row in made.todo(False, False, 0) for output in row["outputs"])
        return 0
    keeps, folder = given.journal != "none", given.journal or join(root, "lambent.journal/")
    book = plan.Journal(folder, {"lambent": version[0].split()[-1], "build": version[1], "options": " ".join(theirs), "folder": root, "pictures": made.count(),
                                 "shard": "%d/%d" % shard})
    if given.resume or given.skip_same:
        made.note(book.lines_before())
        made.see(listed(root))
    if given.resume:
        made.check_resume()
    if keeps:
        book.begin(not given.resume and not given.skip_same)
    report, code = Report(given, made.count()), None
    settings = {"options": theirs, "jobs": given.threads, "size_limit": given.size_limit}
    rows = made.todo(given.resume, given.skip_same, given.retry_failed)
    if given.dask:
        import distributed
    client = distributed.Client(given.dask) if given.dask else None
    results = on_dask(client, rows, **settings) if client else draw_each(rows, **settings)
    try:
        for result in results:
            report.add(result)
            if keeps and result["class"] != "same":
                book.add(result)
            if report.troubles >= TROUBLES:
                break
        code = report.finish(made.failed)
        return code
    finally:
        results.close()
        if client:
            client.close()
        if keeps:
            book.end(code)


def main(words=None):
    words = list(sys.argv[1:] if words is None else words)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        if words[:1] == ["journal"]:
            return plan.summary((words[1:] or [""])[0], words[2:])
        own = parser()
        mine, theirs = split_words(words, own)
        given = own.parse_intermixed_args(mine)
        if not given.output or not (given.models or given.list):
            raise Problem("expected models and -o PATTERN; see lambent-catalogue --help", "usage", 1)
        return run(given, theirs)
    except (Problem, ImportError, OSError) as error:
        print("lambent-catalogue: %s" % error, file=sys.stderr)
        return getattr(error, "exit", 3)
    except KeyboardInterrupt:
        print("lambent-catalogue: interrupted; continue with --resume", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
