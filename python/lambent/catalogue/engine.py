"""engine.py: an engine hands out the rows: parts of about ten seconds, by measured cost, to the workers of a Dask scheduler."""
import os
import time

from .drawing import draw, failure, row_of
from .stores import Problem

PART_SECONDS, LEAST_SECONDS = 10, 1


def draw_part(rows, settings):
    """draw on a worker of Dask, with the seconds that it took. The processors of the worker are divided among its threads."""
    from distributed import get_worker
    start, jobs = time.monotonic(), settings.get("jobs") or max(1, len(os.sched_getaffinity(0)) // get_worker().state.nthreads)
    return draw(rows, **{**settings, "jobs": jobs}), time.monotonic() - start


def weight_of(row):
    return len(row["outputs"]) * (1 + (row.get("size") or 0) / 1e6)


class Parts:
    """Cuts the rows into parts. The cost of a row is a base and a share for its bytes, in proportion to the parts that are done."""

    def __init__(self, rows, total):
        self.rows, self.left, self.mean = iter(rows), total, 1.0
        self.seconds, self.weight = 1.0, 1.0  # a second each, until a part is done: the first parts are short, also on a slow machine

    def learn(self, rows, seconds):
        self.seconds, self.weight = self.seconds * 0.9 + seconds, self.weight * 0.9 + sum(map(weight_of, rows))

    def take(self, workers):
        """The next part: shorter towards the end, so that no worker is late."""
        part, weight, each = [], 0, self.seconds / self.weight
        limit = max(LEAST_SECONDS, min(PART_SECONDS, self.left * self.mean * each / (4 * workers))) / each
        for row in self.rows:
            part.append(row if "outputs" in row else row_of(row))
            weight += weight_of(part[-1])
            if weight >= limit:
                break
        self.left, self.mean = self.left - len(part), self.mean * 0.9 + weight / max(len(part), 1) * 0.1
        return part


def on_dask(client, rows, total=None, **settings):
    """Draws rows (see `draw`) with the workers of a scheduler, and yields the results as they come. If a worker dies, the scheduler gives its part to
    another; a part whose workers died again and again (distributed.scheduler.allowed-failures) fails. `total` is the number of rows, if `rows` has no length."""
    import distributed
    parts, running, made = Parts(rows, total or len(rows)), {}, distributed.as_completed()

    def fill():
        workers = max(1, sum(client.nthreads().values()))
        while len(running) < workers and (part := parts.take(workers)):  # one for each thread: nothing waits behind a slow worker
            future = client.submit(draw_part, part, settings, pure=False)
            running[future.key] = future, part
            made.add(future)

    try:
        fill()
        for future in made:
            _, part = running.pop(future.key)
            try:
                results, seconds = future.result()
                parts.learn(part, seconds)
            except distributed.scheduler.KilledWorker as error:
                lost = failure(Problem(str(error), "crashed", 8, "machine"))
                results = [{**lost, "model": row["model"], "output": output, "key": row.get("key")} for row in part for output in row["outputs"]]
            fill()
            yield from results
    finally:
        client.cancel([future for future, _ in running.values()])
