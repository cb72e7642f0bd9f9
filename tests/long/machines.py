#!/usr/bin/env python3
"""machines.py PROGRAM: tests real clusters (docs/batch.md). Slurm with three nodes on this host runs examples/slurm-array.sh as a job array over 500
models. One node is killed and its tasks are requeued; nothing is lost and nothing is done twice. A second test uses Open MPI with two ranks.

Everything runs as this user in a temporary folder: munged, slurmctld and three slurmd, on separate ports, without cgroups and systemd. The packages
are in the group `long` of packages.txt; without them, the test is skipped."""
import getpass
import glob
import json
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
NODES, TASKS, MODELS, BROKEN = ("n1", "n2", "n3"), 12, 500, (17, 202, 441)
PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def find(name):
    """Finds a program; Debian's daemons are in /usr/sbin, which may not be in PATH."""
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def check(fact, what):
    if not fact:
        raise AssertionError(what)


def wait_for(what, seconds, condition):
    until = time.time() + seconds
    while time.time() < until:
        result = condition()
        if result:
            return result
        time.sleep(0.2)
    raise AssertionError("waited %d s for %s" % (seconds, what))


# --- models

def sphere(path, slices, squash):
    """A sphere with a few to some thousand triangles, as an OBJ file."""
    import math
    lines, stacks = [], slices // 2
    for i in range(stacks + 1):
        for k in range(slices):
            a, b = math.pi * i / stacks, 2 * math.pi * k / slices
            lines.append("v %.6f %.6f %.6f" % (math.sin(a) * math.cos(b), squash * math.cos(a), math.sin(a) * math.sin(b)))
    for i in range(stacks):
        for k in range(slices):
            n = (k + 1) % slices
            lines.append("f %d %d %d %d" % (i * slices + k + 1, i * slices + n + 1, (i + 1) * slices + n + 1, (i + 1) * slices + k + 1))
    path.write_text("\n".join(lines) + "\n")


def make_models(folder):
    rng = random.Random(5)
    for i in range(MODELS):
        path = folder / ("%02d" % (i % 20)) / ("m%03d.obj" % i)
        path.parent.mkdir(parents=True, exist_ok=True)
        if i in BROKEN:
            path.write_text("v 0 0 0\nf 1 2 3\n")
        else:
            sphere(path, rng.choice((8, 16, 32, 64)), 0.3 + rng.random())


# --- the expected final state

def records_of(folder):
    """The lines of all journals of a folder: of runs and of pictures."""
    runs, pictures = [], []
    for path in sorted(glob.glob(str(folder / "lambent*.jsonl"))):
        for line in open(path):
            try:
                record = json.loads(line)
            except ValueError:
                continue  # truncated by the kill
            (pictures if "output" in record else runs).append({**record, "journal": os.path.basename(path)})
    return runs, pictures


def pictures_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.png")}


def check_whole(folder, expected, tries):
    """The pictures of an undisturbed run, and one result for each: `tries` lines for failed pictures."""
    found = pictures_of(folder)
    check(found == expected, "%d pictures, expected %d; %d differ" % (len(found), len(expected), sum(
        found.get(name) != data for name, data in expected.items())))
    names = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
    other = {name for name in names - set(expected) if not re.fullmatch(r"lambent(-\d+-of-\d+)?\.jsonl", name)}
    check(not other, "left behind: %s" % sorted(other)[:5])
    outcomes = {}
    for record in records_of(folder)[1]:
        outcomes.setdefault(os.path.relpath(record["output"], folder), []).append(record["class"])
    check(len(outcomes) == MODELS, "%d outcomes of %d models" % (len(outcomes), MODELS))
    twice = [name for name, classes in outcomes.items() if name in expected and classes != ["ok"]]
    check(not twice, "drawn twice or not at all: %s" % twice[:5])
    failed = sorted(name for name in outcomes if name not in expected)
    check(failed == sorted("%02d/m%03d.png" % (i % 20, i) for i in BROKEN), "failed: %s" % failed)
    check(all(outcomes[name] == ["cannot-read"] * tries for name in failed), "tries: %s" % [outcomes[name] for name in failed])


# --- a private Slurm

class Slurm:
    def __init__(self, folder):
        self.folder, self.processes = folder, {}
        ports = free_ports(1 + len(NODES))
        user, host = getpass.getuser(), socket.gethostname().split(".")[0]
        key = folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        for name in ("state",) + tuple("spool." + node for node in NODES):
            (folder / name).mkdir()
        self.conf = folder / "slurm.conf"
        self.conf.write_text("""ClusterName=lambent
SlurmctldHost=%s(127.0.0.1)
SlurmctldPort=%d
SlurmUser=%s
SlurmdUser=%s
AuthType=auth/munge
AuthInfo=socket=%s/munge.socket,cred_expire=5
StateSaveLocation=%s/state
SlurmdSpoolDir=%s/spool.%%n
SlurmctldPidFile=%s/slurmctld.pid
SlurmdPidFile=%s/slurmd.%%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
JobRequeue=1
SlurmdTimeout=10
KillWait=3
MinJobAge=36000
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
""" % (host, ports[0], user, user, *[folder] * 5) + "".join(
            "NodeName=%s NodeHostname=%s NodeAddr=127.0.0.1 Port=%d CPUs=1 RealMemory=8000 State=UNKNOWN\n" % (node, host, port)
            for node, port in zip(NODES, ports[1:])) + "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n")
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf), "PATH": os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]}
        for name in list(self.environment):  # independent of any Slurm outside this test
            if name.startswith(("SLURM_", "SBATCH_")) and name != "SLURM_CONF":
                del self.environment[name]

    def start(self):
        self.run_daemon("munged", "--foreground", "--force", "--key-file=%s/munge.key" % self.folder, "--socket=%s/munge.socket" % self.folder,
                        "--pid-file=%s/munged.pid" % self.folder, "--log-file=%s/munged.log" % self.folder,
                        "--seed-file=%s/munged.seed" % self.folder)
        wait_for("munged", 20, lambda: (self.folder / "munge.socket").exists())
        self.run_daemon("slurmctld", "-D", "-f", str(self.conf))
        for node in NODES:
            self.start_node(node)
        wait_for("three idle nodes", 60, lambda: self.ask("sinfo", "-h", "-t", "idle", "-o", "%D").strip() == str(len(NODES)))

    def start_node(self, node):
        self.run_daemon("slurmd", "-D", "-N", node, "-f", str(self.conf), name=node)

    def run_daemon(self, program, *words, name=None):
        log = open(self.folder / ((name or program) + ".out"), "w")
        self.processes[name or program] = subprocess.Popen([find(program), *words], stdout=log, stderr=log, env=self.environment)

    def ask(self, *command):
        done = subprocess.run([find(command[0]), *command[1:]], capture_output=True, text=True, env=self.environment)
        return done.stdout if done.returncode == 0 else ""

    def steps_of(self, node):
        """The processes of jobs on a node, and their slurmstepd."""
        found = set()
        for folder in glob.glob("/proc/[0-9]*"):
            try:
                environ = open(folder + "/environ", "rb").read().split(b"\0")
                status = open(folder + "/status").read()
            except OSError:
                continue
            if b"SLURMD_NODENAME=" + node.encode() not in environ or b"SLURM_CONF=" + str(self.conf).encode() not in environ:
                continue
            found.add(int(os.path.basename(folder)))
            parent = int(re.search(r"^PPid:\s+(\d+)", status, re.M).group(1))
            try:
                if open("/proc/%d/comm" % parent).read().startswith("slurmstepd"):
                    found.add(parent)
            except OSError:
                pass
        return found

    def kill_node(self, node):
        """The state after a power failure: neither slurmd nor slurmstepd nor the job exists."""
        self.processes[node].kill()
        killed = 0
        for _ in range(5):
            for process in self.steps_of(node):
                try:
                    os.kill(process, signal.SIGKILL)
                    killed += 1
                except ProcessLookupError:
                    pass
            time.sleep(0.05)
        self.processes.pop(node).wait()
        return killed

    def tasks(self, job):
        """Each task's fields as scontrol shows them."""
        tasks = {}
        for line in self.ask("scontrol", "-o", "show", "job", str(job)).splitlines():
            fields = dict(word.partition("=")[::2] for word in line.split())
            if fields.get("ArrayTaskId", "").isdigit():
                tasks[int(fields["ArrayTaskId"])] = fields
        return tasks

    def stop(self):
        for node in NODES:
            for process in self.steps_of(node):
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        for process in reversed(list(self.processes.values())):
            process.terminate()
        for process in self.processes.values():
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


# --- the tests

def expected_pictures(folder):
    """The result of one run on one machine, with the options of examples/slurm-array.sh."""
    done = subprocess.run([PROGRAM, "batch", str(folder / "models"), "-o", str(folder / "one" / "{dir}" / "{stem}.png"), "-s", "256",
                           "--journal", "none"], capture_output=True, text=True)
    check(done.returncode == 7, done.stderr)
    pictures = pictures_of(folder / "one")
    check(len(pictures) == MODELS - len(BROKEN), done.stderr)
    return pictures


def journal_of(folder, task):
    path = folder / "slurm" / ("lambent-%02d-of-%d.jsonl" % (task + 1, TASKS))
    return path.read_text().count('"output"') if path.exists() else 0


def a_task_underway(slurm, folder, job):
    """A node whose task has drawn some of its pictures, but not all."""
    for task, fields in slurm.tasks(job).items():
        if fields["JobState"] == "RUNNING" and 3 <= journal_of(folder, task) <= 20:
            return fields["NodeList"], task
    return None


def array_survives_a_node(folder, expected):
    slurm = Slurm(folder)
    try:
        slurm.start()
        start = time.time()
        (folder / "logs").mkdir()
        # With one thread each, a kill finds tasks in progress.
        job = int(slurm.ask("sbatch", "--parsable", "--array=0-%d" % (TASKS - 1), "--cpus-per-task=1", "--mem=100",
                            "-o", str(folder / "logs/%a.txt"), str(ROOT / "examples/slurm-array.sh"), str(folder / "models"),
                            str(folder / "slurm")) or check(False, "sbatch failed"))
        node, task = wait_for("a task underway", 120, lambda: a_task_underway(slurm, folder, job))
        killed = slurm.kill_node(node)
        check(killed >= 2, "killed %d processes of %s" % (killed, node))
        at_kill = journal_of(folder, task)
        check(slurm.tasks(job)[task]["JobState"] in ("RUNNING", "COMPLETING"), "task %d was over before its node was killed" % task)
        wait_for("task %d to be requeued" % task, 120, lambda: int(slurm.tasks(job)[task]["Restarts"]) == 1)
        slurm.start_node(node)  # the node comes back
        done = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL")
        wait_for("the array to end", 300, lambda: len(slurm.tasks(job)) == TASKS and all(
            fields["JobState"] in done for fields in slurm.tasks(job).values()))
        tasks = slurm.tasks(job)
        check_whole(folder / "slurm", expected, 2)  # the script has --retry-failed 1
        runs, _ = records_of(folder / "slurm")
        again = sorted(i for i, fields in tasks.items() if fields["Restarts"] != "0")
        check(again == [task], "requeued: %s" % again)
        check(sum(run["shard"] == "%d/%d" % (task + 1, TASKS) for run in runs if "shard" in run) == 2, "the requeued task did not run twice")
        check(at_kill < journal_of(folder, task), "task %d had drawn all when its node was killed" % task)
        for i, fields in tasks.items():  # the script has --failures-ok
            check(fields["ExitCode"] == "0:0" and fields["JobState"] == "COMPLETED", "task %d: %s" % (i, fields["ExitCode"]))
        print("# %d models, %d tasks on %d nodes in %.0f s; node %s killed with task %d after %d of its pictures (%d processes), requeued" % (
            MODELS, TASKS, len(NODES), time.time() - start, node, task, at_kill, killed))
    except Exception:
        for path in sorted(folder.glob("*.out")) + sorted(folder.glob("logs/*")):
            print("# %s:\n#   %s" % (path.name, "\n#   ".join(path.read_text(errors="replace").splitlines()[-15:])))
        raise
    finally:
        slurm.stop()


def two_ranks(folder, expected):
    """Open MPI sets its variables also for programs without MPI. If one rank exited with 7, Open MPI would end the other."""
    done = subprocess.run([find("mpirun"), "--allow-run-as-root", "--oversubscribe", "-n", "2", PROGRAM, "batch", str(folder / "models"), "-o",
                           str(folder / "mpi" / "{dir}" / "{stem}.png"), "-s", "256", "--shard", "auto", "--failures-ok"], capture_output=True, text=True,
                          timeout=300)
    check(done.returncode == 0, done.stderr[-2000:])
    check_whole(folder / "mpi", expected, 1)
    journals = sorted(path.name for path in (folder / "mpi").glob("*.jsonl"))
    check(journals == ["lambent-1-of-2.jsonl", "lambent-2-of-2.jsonl"], "journals: %s" % journals)
    print("# Open MPI: two ranks, %s pictures" % " and ".join(
        str((folder / "mpi" / name).read_text().count('"ok"')) for name in journals))


def main():
    tests = (("slurm: a node is killed, nothing is lost or done twice", ("munged", "slurmctld", "slurmd", "sbatch"), array_survives_a_node),
             ("open mpi: two ranks", ("mpirun",), two_ranks))
    print("1..%d" % len(tests))
    failed = 0
    with tempfile.TemporaryDirectory(prefix="lambent-machines-") as name:
        folder = pathlib.Path(name)
        expected = None
        for number, (title, programs, test) in enumerate(tests, 1):
            missing = [program for program in programs if not find(program)]
            if missing:
                print("ok %d - %s # SKIP %s is not installed" % (number, title, missing[0]))
                continue
            try:
                if expected is None:
                    make_models(folder / "models")
                    expected = expected_pictures(folder)
                test(folder, expected)
                print("ok %d - %s" % (number, title))
            except Exception as problem:
                failed += 1
                print("# %s: %s" % (type(problem).__name__, problem))
                print("not ok %d - %s" % (number, title))
            sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
