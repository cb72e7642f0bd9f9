"""engine.py: an engine hands out the rows to the workers of a Dask scheduler, in parts that take each of them about ten seconds, and less at the end."""
import collections
import contextlib
import os
import queue
import time

from .drawing import draw_each, failure, row_of
from .stores import Problem

PART_SECONDS, LEAST_SECONDS, GUESS = 10, 2, 0.25  # the guess is for a row
AHEAD = 2000  # rows in memory for each worker, at most


def draw_part(rows, settings):
    """Draws rows on a worker of Dask. Returns the results, the seconds that they took and the worker. The processors of the worker are divided among its threads."""
    from distributed import get_worker
    worker, start = get_worker(), time.monotonic()
    jobs = settings.get("jobs") or max(1, len(os.sched_getaffinity(0)) // worker.state.nthreads)
    task, results = worker.state.tasks[worker.get_current_task()], []
    with contextlib.closing(draw_each(rows, **{**settings, "jobs": jobs})) as drawn:
        for result in drawn:
            results.append(result)
            if task.state == "cancelled":  # the client has the results of a copy, or ended
                break
    return results, time.monotonic() - start, worker.address


def weight_of(row):
    return len(row["outputs"]) * (1 + (row.get("size") or 0) / 1e6)


class Parts:
    """Cuts the rows into parts. The cost of a row is a base and a share for its bytes, times the seconds that the last part of the worker took for each."""

    def __init__(self, rows):
        self.rows, self.each, self.waiting, self.weight, self.over = iter(rows), {}, collections.deque(), 0, False

    def learn(self, worker, rows, seconds):
        self.each[worker] = seconds / sum(map(weight_of, rows))

    def take(self, worker, threads):
        """The next part for a worker, and when it is late. Towards the end, a part takes two thirds of the time that is left, so that all workers end
        together. The first part of a worker is short."""
        slowest = max(self.each.values(), default=GUESS)
        rate = sum(count / self.each.get(name, slowest) for name, count in threads.items())
        while not self.over and self.weight < 2 * PART_SECONDS * rate and len(self.waiting) < AHEAD * len(threads):
            if row := next(self.rows, None):
                self.waiting.append(row if "outputs" in row else row_of(row))
                self.weight += weight_of(self.waiting[-1])
            self.over = not row
        seconds = max(LEAST_SECONDS, min(PART_SECONDS, self.weight / rate * 2 / 3) if worker in self.each else 0)
        part, limit = [], self.weight - seconds / self.each.get(worker, slowest)
        while self.waiting and (not part or self.weight > limit):
            part.append(self.waiting.popleft())
            self.weight -= weight_of(part[-1])
        return part, time.monotonic() + 3 * seconds


def on_dask(client, rows, **settings):
    """Draws rows (see `draw`) with the workers of a scheduler, and yields the results as they come. If a worker dies, the scheduler gives its part to
    another; a part whose workers died again and again (distributed.scheduler.allowed-failures) fails. If no rows are left, idle workers draw copies of
    parts that are late."""
    import distributed
    parts, running, done = Parts(rows), {}, queue.SimpleQueue()  # running: {future: (part, when it is late, worker)}

    def fill():
        """Gives each idle thread a part: nothing waits behind a slow worker. The scheduler may have moved parts of dead workers."""
        threads, places = client.nthreads(), {key: worker for worker, keys in client.processing().items() for key in keys}
        load = collections.Counter(places.get(future.key, worker) for future, (_, _, worker) in running.items())
        for worker in [worker for worker, count in threads.items() for _ in range(count - load[worker])]:
            part, late = parts.take(worker, threads)
            if not part:
                copies = collections.Counter(id(part) for part, _, _ in running.values())
                part = next((part for part, late, _ in running.values() if late < time.monotonic() and copies[id(part)] == 1), None)
            if part:
                future = client.submit(draw_part, part, settings, pure=False, workers=[worker], allow_other_workers=True)
                running[future] = part, late, worker
                future.add_done_callback(done.put)

    try:
        while fill() or running or not parts.over:
            try:
                future = done.get(timeout=1)
            except queue.Empty:  # are there new workers, or late parts?
                continue
            if future not in running:  # its copy was faster
                continue
            part = running.pop(future)[0]
            copies = [other for other, found in running.items() if found[0] is part]
            try:
                results, seconds, worker = future.result()
                parts.learn(worker, part, seconds)
            except distributed.scheduler.KilledWorker as error:
                if copies:
                    continue
                lost = failure(Problem(str(error), "crashed", 8, "machine"))
                results = [{**lost, "model": row["model"], "output": output, "key": row.get("key")} for row in part for output in row["outputs"]]
            client.cancel(copies)
            for other in copies:
                del running[other]
            fill()
            yield from results
    finally:
        client.cancel(list(running))
