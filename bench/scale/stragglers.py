#!/usr/bin/env python3
"""stragglers.py [--check]: computes how many shards a batch should have (docs/scale.md). Simulates 100 machines of 4 cores that take one shard after
another, as in a job array, and writes docs/pictures/scale-shards.svg and the tables of docs/scale.md; --check compares instead.

The time of each model is drawn from the measured times of 437 models (times-256.txt and times-1024.txt in this folder: milliseconds on one core, from
journals of `lambent batch -j 1`). Models are assigned to shards at random, like by a hash. Every shard has a start-up time and a planning time, for
all models (`--shard-by name`) or for its own (`--shard-by list`); five machines in a hundred have half the speed. The numbers and the picture are the
same on every machine."""
import heapq
import pathlib
import random
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
DOCS = HERE.parents[1] / "docs"
MACHINES, CORES, SLOW, START_S = 100, 4, 5, 5.0
PLAN_S = 1.4e-6  # per model, measured with a list of a million in random order
WAYS = ("name", "list")
SHARDS = (1, 2, 4, 8, 16, 32, 64)  # for each machine
COUNTS = {10 ** 4: 20, 10 ** 5: 5, 10 ** 6: 1, 10 ** 7: 20, 10 ** 8: 20}  # number of models: number of simulations to average
MANY = 10 ** 7  # from here on, the work of a shard is drawn from its approximate normal distribution
CORE_HOUR, GIB = 0.05, 2.0 ** 30  # dollars: typical price of a virtual core of a large cloud, 2026
PICTURE_BYTES, LINE_BYTES = {256: 27300, 1024: 262000}, 885  # means over the same runs


def times_s(size):
    return [float(line) / 1e3 for line in open(HERE / ("times-%d.txt" % size))]


def shard_seconds(works):
    """The time of a shard on a machine of speed 1: each core takes the next model."""
    free = [0.0] * min(CORES, max(1, len(works)))
    for work in works:
        heapq.heapreplace(free, free[0] + work)
    return max(free)


def deal(count, shard_count, measured, rng):
    """The time of each shard on a machine of speed 1, and the work of all."""
    if count >= MANY:  # a sum of a Poisson number of times
        each = count / shard_count
        mean, square = sum(measured) / len(measured), sum(work * work for work in measured) / len(measured)
        works = [rng.gauss(each * mean, (each * square) ** 0.5) for _ in range(shard_count)]
        return [work / CORES for work in works], sum(works)
    shards, total = [[] for _ in range(shard_count)], 0.0
    for _ in range(count):
        work = measured[int(rng.random() * len(measured))]
        shards[int(rng.random() * shard_count)].append(work)
        total += work
    return [shard_seconds(works) for works in shards], total


def simulate(count, per_machine, seed, measured):
    """For each way of dividing the models: the time until the last shard is done, relative to evenly divided work."""
    shards, total = deal(count, MACHINES * per_machine, measured, random.Random(seed))
    even = total / CORES / (MACHINES - SLOW / 2)
    return [last_end(shards, PLAN_S * planned) / even for planned in (count, count / len(shards))]


def last_end(shards, plan_s):
    machines = [(0.0, i) for i in range(MACHINES)]  # the first machines are slow, without loss of generality
    heapq.heapify(machines)
    last = 0.0
    for seconds in shards:
        start, machine = heapq.heappop(machines)
        end = start + START_S + (plan_s + seconds) * (2 if machine < SLOW else 1)
        last = max(last, end)
        heapq.heappush(machines, (end, machine))
    return last


# --- an engine that balances: lambent-catalogue --dask (python/lambent/catalogue/engine.py)

ENGINE_PLAN_S, PART_S, PART_STEP_S, LEAST_S = 70e-6, 10.0, 0.15, 2.0  # per model in the plan; a part, what it costs more, and the last parts


def balanced(count, seed, measured, planned):
    """The time until all parts are done, relative to evenly divided work. A part takes its machine ten seconds, and two thirds of the rest at the end."""
    rng, mean, square = random.Random(seed), sum(measured) / len(measured), sum(work * work for work in measured) / len(measured)
    rate, left, last = CORES * (MACHINES - SLOW / 2) / mean, count, 0.0  # models a second of all machines
    machines = [(START_S + planned * count * ENGINE_PLAN_S, i) for i in range(MACHINES)]
    while left:
        start, machine = heapq.heappop(machines)
        speed = CORES * (0.5 if machine < SLOW else 1)
        rows = min(left, max(1, int(max(LEAST_S, min(PART_S, left / rate * 2 / 3)) * speed / mean)))
        end = start + PART_STEP_S + max(0, rng.gauss(rows * mean, (rows * square) ** 0.5)) / speed
        left, last = left - rows, max(last, end)
        heapq.heappush(machines, (end, machine))
    return last / (count / rate)


def engine_table(found):
    measured = times_s(256)
    lines = ["| models | best `--shard-by name` | best `--shard-by list` | Dask | Dask, without its plan |", "|---|---|---|---|---|"]
    for count in COUNTS:
        best = [min(found[count, way]) for way in WAYS]
        lines.append("| %s | %.2f | %.2f | %.2f | %.2f |" % (power(count), *best, *[balanced(count, 1, measured, planned) for planned in (1, 0)]))
    return lines


def results():
    measured = times_s(256)
    found = {}
    for count, tries in COUNTS.items():
        runs = [[simulate(count, k, seed, measured) for seed in range(tries)] for k in SHARDS]
        for i, way in enumerate(WAYS):
            found[count, way] = [sum(run[i] for run in of_k) / tries for of_k in runs]
    return found


# --- the picture

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 680, 420, 70, 170, 24, 56
COLORS = {10 ** 4: "#c05020", 10 ** 5: "#2a8040", 10 ** 6: "#1a56a0", 10 ** 7: "#7030a0", 10 ** 8: "#606060"}
LOW, HIGH = 1.0, 16.0


def power(number):
    return "10" + "".join("⁰¹²³⁴⁵⁶⁷⁸⁹"[int(digit)] for digit in str(len(str(number)) - 1))


def svg(found):
    from math import log
    across = lambda k: LEFT + (WIDTH - LEFT - RIGHT) * log(k) / log(SHARDS[-1])
    up = lambda y: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * log(y / LOW) / log(HIGH / LOW)
    text = lambda x, y, words, anchor="middle", color="#222222", more="": '<text x="%.1f" y="%.1f" text-anchor="%s" fill="%s"%s>%s</text>' % (
        x, y, anchor, color, more, words)
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d" font-family="DejaVu Sans, sans-serif" '
             'font-size="13">' % (WIDTH, HEIGHT, WIDTH, HEIGHT), '<rect width="100%" height="100%" fill="white"/>']
    for y in (1, 1.2, 1.5, 2, 3, 5, 10):
        parts.append('<line x1="%d" x2="%d" y1="%.1f" y2="%.1f" stroke="#dddddd"/>' % (LEFT, WIDTH - RIGHT, up(y), up(y)))
        parts.append(text(LEFT - 8, up(y) + 4, "%g" % y, "end"))
    for k in SHARDS:
        parts.append('<line x1="%.1f" x2="%.1f" y1="%d" y2="%d" stroke="#eeeeee"/>' % (across(k), across(k), TOP, HEIGHT - BOTTOM))
        parts.append(text(across(k), HEIGHT - BOTTOM + 18, str(k)))
    parts.append('<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="#aaaaaa"/>' % (LEFT, TOP, WIDTH - LEFT - RIGHT,
                                                                                              HEIGHT - TOP - BOTTOM))
    for (count, way), values in found.items():
        points = [(across(k), up(value)) for k, value in zip(SHARDS, values) if value <= HIGH]
        parts.append('<polyline points="%s" fill="none" stroke="%s" stroke-width="2"%s/>' % (
            " ".join("%.1f,%.1f" % point for point in points), COLORS[count], ' stroke-dasharray="6 4"' if way == "list" else ""))
        parts += ['<circle cx="%.1f" cy="%.1f" r="3.5" fill="%s"/>' % (*point, COLORS[count]) for point in points]
        if count >= MANY or way == "name":  # with fewer models, both curves nearly coincide
            label = power(count) + " models" + (", by list" if way == "list" else "")
            parts.append(text(points[-1][0] + 10, points[-1][1] + 4, label, "start", COLORS[count]))
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 14, "shards for each of 100 machines"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(text(18, middle, "time, 1: all work evenly shared", more=' transform="rotate(-90 18 %.0f)"' % middle))
    return "\n".join(parts) + "\n</svg>\n"


# --- the tables

def duration(seconds):
    for size, unit in ((86400, "days"), (3600, "hours"), (60, "minutes")):
        if seconds >= 2 * size:
            return "%.3g %s" % (seconds / size, unit)
    return "%.3g s" % seconds


def volume(count):
    for size, unit in ((2.0 ** 40, "TiB"), (GIB, "GiB"), (2.0 ** 20, "MiB"), (2.0 ** 10, "KiB")):
        if count >= size:
            return "%.3g %s" % (count / size, unit)
    return "%d bytes" % count


def hours(value):
    return "%.3g" % value if value < 1000 else format(round(value), ",")


def dollars(value):
    return "under $0.01" if value < 0.01 else "$%.2f" % value if value < 10 else "$%s" % format(round(value), ",")


def quantile_table():
    lines = ["| size | mean | half below | 90 % below | 99 % below | longest |", "|---|---|---|---|---|---|"]
    for size in (256, 1024):
        t = times_s(size)
        lines.append("| %d² | %s ms |" % (size, " ms | ".join("%.0f" % (1e3 * v) for v in (
            sum(t) / len(t), t[len(t) // 2], t[len(t) * 9 // 10], t[len(t) * 99 // 100], t[-1]))))
    return lines


def cost_table():
    lines = ["| models | size | core hours | cost | on 4 cores | on 100 machines of 4 | pictures | journals |", "|---|---|---|---|---|---|---|---|"]
    for power_of in range(3, 9):
        for size in (256, 1024):
            t, count = times_s(size), 10 ** power_of
            work = count * sum(t) / len(t)
            lines.append("| %s | %d² | %s | %s | %s | %s | %s | %s |" % (
                power(count), size, hours(work / 3600), dollars(work / 3600 * CORE_HOUR), duration(work / CORES),
                duration(work / CORES / MACHINES) if work / CORES / MACHINES > 60 else "–",
                volume(count * PICTURE_BYTES[size]), volume(count * LINE_BYTES)))
    return lines


def shard_table(found):
    lines = ["| models | `--shard-by` | " + " | ".join(str(k) for k in SHARDS) + " |", "|---|---|" + "---|" * len(SHARDS)]
    return lines + ["| %s | `%s` | %s |" % (power(count), way, " | ".join("%.2f" % value for value in values))
                    for (count, way), values in found.items()]


def main():
    found = results()
    page = (DOCS / "scale.md").read_text()
    for name, lines in (("times", quantile_table()), ("cost", cost_table()), ("shards", shard_table(found)), ("engine", engine_table(found))):
        page = re.sub(r"(<!-- %s -->\n)(?:\|.*\n)*" % name, lambda mark: mark.group(1) + "\n".join(lines) + "\n", page)
    made = {DOCS / "pictures" / "scale-shards.svg": svg(found), DOCS / "scale.md": page}
    other = [path for path, text in made.items() if not path.exists() or path.read_text() != text]
    if "--check" in sys.argv[1:]:
        print("1..1\n%sok 1 - docs/scale.md has the numbers of its simulation" % ("not " if other else ""))
        return 1 if other else 0
    for path in other:
        path.write_text(made[path])
    return 0


if __name__ == "__main__":
    sys.exit(main())
