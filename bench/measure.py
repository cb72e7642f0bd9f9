"""measure.py: measures programs alternately, round after round, so that drift of the machine's speed has no effect; computes medians, and ratios
within a round with their spread."""
import contextlib
import json
import os
import signal
import statistics
import subprocess
import sys
import threading
import time
from typing import NamedTuple

import paths


LONGEST_S = 300  # a program that takes longer is considered hung
ROW_S = 40  # no further round for a row that has taken this long


class Failed(Exception):
    """A program failed; the text names it and the failure."""


class Absent(Failed):
    """The row's peer is not installed. The row reports this, and the bench succeeds without it."""


def output(command, **more):
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=LONGEST_S, **more)
    except subprocess.TimeoutExpired:
        raise Failed("%s: did not end within %d s" % (" ".join(command[:3]), LONGEST_S)) from None
    if done.returncode:
        raise Failed("%s: exit %d: %s" % (" ".join(command[:3]), done.returncode, done.stderr.decode(errors="replace").strip()[-300:]))
    return done.stdout.decode()


class Taken(NamedTuple):
    """The resources that a process used."""
    wall_ms: float
    cpu_ms: float  # of all its threads, in user and system mode


def process(command, errors=os.devnull):
    """Runs a whole process, from its start to its end. posix_spawn starts it. A fork of Python would first copy its page tables, which takes a
    millisecond that belongs to neither program. Its standard error goes to the file `errors`."""
    actions = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
               (os.POSIX_SPAWN_OPEN, 2, errors, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)]
    start = time.perf_counter()
    child = os.posix_spawnp(command[0], command, os.environ, file_actions=actions)
    hung = threading.Timer(LONGEST_S, os.kill, (child, signal.SIGKILL))
    hung.start()
    _, status, used = os.wait4(child, 0)
    wall = (time.perf_counter() - start) * 1e3
    hung.cancel()
    if status:
        code = os.waitstatus_to_exitcode(status)
        try:
            with open(errors, errors="replace") as file:
                said = file.read().strip()[-300:]
        except OSError:
            said = ""
        raise Failed("%s: %s: %s" % (" ".join(command[:3]), "did not end within %d s" % LONGEST_S if code == -signal.SIGKILL and
                                     wall > LONGEST_S * 1e3 else "exit %d" % code, said))
    return Taken(wall, (used.ru_utime + used.ru_stime) * 1e3)


def peak_bytes(command):
    """The peak memory use of a process. A fresh interpreter starts it, because Linux counts the memory of the process that calls posix_spawn as
    memory of the started process."""
    script = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)\n" \
             "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    return int(output([sys.executable, "-c", script, *map(str, command)])) * 1024


def whole_process(command, written):
    """A process that writes the file `written`, which must not exist, because replacing a file takes the file system longer, sometimes by
    milliseconds."""
    with contextlib.suppress(FileNotFoundError):
        os.remove(written)
    return process(command, written + ".stderr")


def lambent(*arguments):
    """Runs lambent and returns its report."""
    return json.loads(output([paths.LAMBENT, "--json", *map(str, arguments)]))


def usable_isas():
    """The instruction sets to report, the widest first: AVX-512 and AVX2 if the machine has them."""
    found = []
    for isa in ("avx512", "avx2", "neon"):
        try:
            lambent("sphere", "-s", 16, "--isa", isa, "-o", os.path.join(paths.PICTURES, "try.png"))
            found.append(isa)
        except Failed:
            pass
    return found or ["auto"]


# After this time (time.monotonic()) a row gets only one round, so that the bench also ends on a busy machine; results record
# their number of rounds.
hurry_from = float("inf")


def in_turn(contestants, seconds, least_rounds=3, most_rounds=15):
    """Runs every program once to warm up, and then all of them alternately until the time is used, at least `least_rounds` times; every second round
    runs backwards. No program therefore always follows the same one, whose gigabytes the system may still be reclaiming. After F3D with 10 million
    triangles, a process spent up to half a second more in the system. `contestants` maps each name to a function that measures once. Returns {name:
    [the result of each round]}."""
    for run in reversed(contestants.values()):
        run()
    begun = time.monotonic()
    taken = {name: [] for name in contestants}
    rounds = 0
    while rounds < most_rounds and (rounds < least_rounds or time.monotonic() - begun < seconds):
        if rounds and (time.monotonic() > hurry_from or time.monotonic() - begun > ROW_S):
            break
        for name, run in reversed(contestants.items()) if rounds % 2 else contestants.items():
            taken[name].append(run())
        rounds += 1
    return taken


def spread(numbers):
    """The median, the minimum, the maximum and the count."""
    return {"median": statistics.median(numbers), "least": min(numbers), "most": max(numbers), "rounds": len(numbers)}


def ratio(numerators, denominators):
    """Ratios within each round."""
    return spread([a / b for a, b in zip(numerators, denominators)])


def busy_s():
    """Seconds that the processors have been busy (or taken by the host) since the start of the system."""
    with open("/proc/stat") as file:
        user, nice, system, _, _, irq, softirq, steal = (int(word) for word in file.readline().split()[1:9])
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def own_s():
    """Seconds of this process and of the children that have ended."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def machine():
    """The machine of the measurements, and its load."""
    facts = {"processor": "unknown", "processors": len(os.sched_getaffinity(0)), "load_before": os.getloadavg()[0], "kernel": os.uname().release}
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            facts["processor"] = line.split(":", 1)[1].strip()
            break
    for line in open("/proc/meminfo"):
        if line.startswith("MemTotal"):
            facts["memory_bytes"] = int(line.split()[1]) * 1024
    try:
        facts["system"] = open("/etc/debian_version").read().strip()
    except OSError:
        facts["system"] = "not Debian"
    return facts
