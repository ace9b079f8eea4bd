#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""flexwright study slurm: a cluster of one node is started here (munged, slurmctld, slurmd of Debian), a node is lost in the
middle, and what comes out has the bytes of a run on one machine."""
import contextlib
import getpass
import os
import pathlib
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

from common import GALLERY, PROGRAM, run

FLOW = ("--flow", "al-masked-rie")
PATHS = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
DAEMONS = {name: shutil.which(name, path=PATHS) for name in ("munged", "slurmctld", "slurmd", "sbatch")}
PARALLEL = shutil.which("parallel")
MISSING = [name for name, path in DAEMONS.items() if not path]


def sweep(steps, kind="sweep"):
    return (f'<study xmlns="urn:flexwright:study:1" name="s" kind="{kind}" as="drawn" device="{GALLERY}">\n'
            f'<vary what="arc" from="200 deg" to="260 deg" steps="{steps}"/>'
            '<vary what="flexure[C]/@width" values="7.5 um; 8 um"/>'
            '<respond name="U" value="governing.utilisation" max="1"/></study>')


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Cluster:
    """one node with two processors, on this machine, of this user"""

    def __init__(self, place):
        self.place, self.running = place, {}
        for name in ("state", "spool", "munge"):
            (place / name).mkdir(mode=0o700)
        (place / "munge/key").write_bytes(os.urandom(64))
        (place / "munge/key").chmod(0o600)
        host, user = socket.gethostname().split(".")[0], getpass.getuser()
        # a requeued job begins when its old credential is over: cred_expire, at least 5 s
        (place / "slurm.conf").write_text(f"""ClusterName=flexwright
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={place}/munge/socket,cred_expire=5
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd.pid
SlurmctldLogFile={place}/slurmctld.log
SlurmdLogFile={place}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
PriorityType=priority/basic
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=1
NodeName=node NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = dict(os.environ, SLURM_CONF=str(place / "slurm.conf"), PATH=PATHS)
        munge = place / "munge"
        self.start("munged", "--foreground", "--force", "--num-threads=1", f"--key-file={munge}/key",
                   f"--socket={munge}/socket", f"--pid-file={munge}/pid", f"--log-file={munge}/log",
                   f"--seed-file={munge}/seed")
        self.until(lambda: (munge / "socket").exists(), 20, "munged has its socket")
        self.start("slurmctld", "-D", "-i")
        self.start_node()
        self.until(lambda: self.ask("sinfo", "-h", "-o", "%T").strip() == "idle", 30, "the node is idle")

    def start(self, name, *arguments):
        with open(self.place / f"{name}.out", "ab") as out:
            self.running[name] = subprocess.Popen([DAEMONS[name], *arguments], env=self.environment, stdout=out,
                                                  stderr=out, stdin=subprocess.DEVNULL)

    def start_node(self):
        self.start("slurmd", "-D", "-N", "node")

    def ask(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=30).stdout

    def until(self, holds, seconds, what):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                logs = [p.read_text(errors="replace")[-2000:] for p in self.place.rglob("*.log")]
                raise AssertionError(f"not within {seconds} s: {what}\n{self.ask('squeue')}\n" + "\n".join(logs))
            time.sleep(0.05)

    def processes(self):
        """of the jobs: what has our configuration in its environment and is no daemon of ours"""
        daemons = {p.pid for p in self.running.values()}
        for entry in pathlib.Path("/proc").iterdir():
            with contextlib.suppress(OSError):
                if entry.name.isdigit() and int(entry.name) not in daemons | {os.getpid()}:
                    if f"SLURM_CONF={self.place}/slurm.conf".encode() in (entry / "environ").read_bytes():
                        yield int(entry.name), (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode()

    def stop(self):
        for pid, _ in self.processes():
            with contextlib.suppress(OSError):
                os.kill(pid, signal.SIGKILL)
        for process in reversed(self.running.values()):
            process.terminate()
            try:
                process.wait(timeout=5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


class Slurm(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="fw-slurm-")).resolve()
        self.addCleanup(shutil.rmtree, self.place, ignore_errors=True)

    def write(self, text, name="study.xml"):
        (self.place / name).write_text(text)
        return self.place / name

    def bytes_of(self, out):
        """the results, without scripts, logs and shards"""
        ours = {"array.sh", "merge.sh", "shards", "slurm"}
        return {str(p.relative_to(out)): p.read_bytes() for p in sorted(out.rglob("*"))
                if p.is_file() and p.relative_to(out).parts[0] not in ours}

    def rows(self, store):
        try:
            with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True, timeout=1)) as db:
                return {row[0] for row in db.execute("SELECT i FROM sample")}
        except sqlite3.Error:
            return set()

    def alone(self, path, *more):
        done = run("study", path, "-o", self.place / "alone", *FLOW, *more, cwd=self.place)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.bytes_of(self.place / "alone")

    def test_scripts_in_a_directory_with_any_name(self):
        path = self.write(sweep(4))
        odd = self.place / "it's 50 % of #1"
        odd.mkdir()
        wanted = self.alone("study.xml", "--set", "link=121 um")
        slurm = ("study", "slurm", "--no-submit", "study.xml", "--shards", 3, f"-o{odd.name}/out", "--sbatch",
                 "--partition=long --time=60", "--jobs=2", *FLOW, "--set", "link=121 um")
        done = run(*slurm, cwd=self.place)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing is submitted", done.stdout)
        script = (odd / "out/array.sh").read_text()
        for line in ("#SBATCH --array=1-3", "#SBATCH --partition=long --time=60", "#SBATCH --cpus-per-task=2",
                     "#SBATCH --requeue", "#SBATCH --output='it'\\''s 50 %% of #1/out'/slurm/shard-%a.log"):
            self.assertIn(line + "\n", script)
        for task in (2, 3, 1, 3):  # one of them again: it finds nothing left to do
            done = subprocess.run(["sh", odd / "out/array.sh"], env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)},
                                  capture_output=True, text=True, cwd="/", timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = subprocess.run(["sh", odd / "out/merge.sh"], capture_output=True, text=True, cwd="/", timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.bytes_of(odd / "out"), wanted)
        again = run(*slurm, cwd=self.place)
        self.assertEqual(again.returncode, 3)
        self.assertIn("FW-D554", again.stderr)
        self.assertEqual(run(*slurm, "--resume", cwd=self.place).returncode, 0)
        self.assertEqual(path.read_text(), sweep(4))

    @unittest.skipUnless(PARALLEL, "GNU parallel is not installed (Debian: parallel)")
    def test_gnu_parallel_does_as_well(self):
        self.write(sweep(4))
        wanted = self.alone("study.xml")
        (self.place / "shards").mkdir()
        task = f"{PROGRAM} study study.xml {' '.join(FLOW)} --shard {{}}/3 --jobs 1 --resume -o shards/{{}}"
        subprocess.run([PARALLEL, "-j", "2", task], input="1\n2\n3\n", text=True, check=True, cwd=self.place, timeout=120,
                       env=dict(os.environ, HOME=str(self.place)), capture_output=True)
        done = run("study", "merge", *(f"shards/{i}" for i in (1, 2, 3)), "-o", "out", *FLOW, cwd=self.place)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.bytes_of(self.place / "out"), wanted)

    def test_what_is_refused_before_anything_is_written(self):
        path, out = self.write(sweep(4)), self.place / "out"
        size = self.write(sweep(4, "size").replace('max="1"', 'goal="minimise"'), "size.xml")
        self.write('#!/bin/sh\necho no such partition >&2\nexit 1\n', "sbatch").chmod(0o755)
        for words, status, says in (
                ((path,), 2, "needs --shards"), ((path, path, "--shards", 2), 2, "takes one FILE"),
                (("-", "--shards", 2), 2, "standard input"), ((path, "--shards", 2, "--shard", "1/2"), 2, "--shard I/N"),
                ((path, "--shards", 1001), 2, "MaxArraySize"), ((path, "--shards", 2, "--sbatch", "long"), 2, "--partition"),
                ((size, "--shards", 2), 3, "run it in one piece"),
                ((path, "--shards", 2, "--set", "link=120\num"), 3, "FW-D554")):
            done = run("study", "slurm", *words, "-o", out, *FLOW)
            self.assertEqual(done.returncode, status, (words, done.stderr))
            self.assertIn(says, done.stderr)
            self.assertFalse(out.exists(), words)
        self.assertEqual(run("study", path, "--no-submit", *FLOW).returncode, 2)
        for paths, says in ((str(self.place / "nothing"), "could not be started"), (str(self.place) + ":/bin", "no such partition")):
            done = run("study", "slurm", path, "--shards", 2, "-o", out, *FLOW, env=dict(os.environ, PATH=paths))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("FW-D555", done.stderr)
            self.assertIn(says, done.stderr)
            shutil.rmtree(out)

    def test_one_process_at_a_time_writes_into_a_directory(self):
        path, out = self.write(sweep(60)), self.place / "out"
        first = subprocess.Popen([PROGRAM, "study", path, "-o", out, *FLOW, "--jobs", "1"], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL)
        try:
            while first.poll() is None and len(self.rows(out / "study.sqlite")) < 2:
                time.sleep(0.02)
            first.send_signal(signal.SIGSTOP)
            self.assertIsNone(first.poll())
            refused = run("study", path, "-o", out, *FLOW)
            self.assertEqual(refused.returncode, 3)
            self.assertIn("FW-D553", refused.stderr)
            late = run("study", path, "-o", out, *FLOW, "--resume", "--time-limit", 1)
            self.assertEqual(late.returncode, 6, late.stderr)
            second = subprocess.Popen([PROGRAM, "study", path, "-o", out, *FLOW, "--resume"],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.assertIn("FW-D553", second.stderr.readline())
        finally:
            first.send_signal(signal.SIGKILL)
            first.wait()
        second.communicate()
        self.assertEqual(second.returncode, 0)
        self.assertEqual(len(self.rows(out / "study.sqlite")), 120)
        # killed before anything was begun: an empty file is no store of somebody else
        (self.place / "empty").mkdir()
        (self.place / "empty/study.sqlite").touch()
        done = run("study", self.write(sweep(2), "two.xml"), "-o", self.place / "empty", *FLOW, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)

    @unittest.skipIf(MISSING, f"not installed: {', '.join(MISSING)} (Debian: slurmctld slurmd slurm-client munge)")
    def test_a_node_is_lost_and_the_bytes_are_those_of_one_machine(self):
        # so many samples that a task lasts some seconds on this machine, and is there to be lost
        steps, took = 30, 0.0
        while took < 3:
            steps, begun = 2 * steps, time.monotonic()
            self.write(sweep(steps))
            shutil.rmtree(self.place / "alone", ignore_errors=True)
            wanted, out = self.alone("study.xml"), self.place / "out"
            took = time.monotonic() - begun
        share = -(-2 * steps // 3)  # two widths, three tasks
        cluster = Cluster(self.place)
        self.addCleanup(cluster.stop)
        done = run("study", "slurm", "study.xml", "-o", "out", "--shards", 3, *FLOW, cwd=self.place,
                   env=cluster.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        array = done.stdout.split()[1].rstrip(":")
        stores = {i: out / f"shards/{i}/study.sqlite" for i in (1, 2)}
        cluster.until(lambda: all(len(self.rows(s)) > 2 for s in stores.values()), 60, "two tasks have samples")
        # the daemon of the node goes, and with it the first task; the second one runs on without its daemon
        cluster.running["slurmd"].kill()
        cluster.running["slurmd"].wait()
        task = next(pid for pid, line in cluster.processes() if "--shard 1/3" in line and "slurmstepd" not in line)
        step = int(pathlib.Path(f"/proc/{task}/stat").read_text().rsplit(")", 1)[1].split()[1])
        for pid in (step, task):  # its guardian first, which would report that it was killed
            os.kill(pid, signal.SIGKILL)
        lost = self.rows(stores[1])
        self.assertTrue(2 < len(lost) < share, lost)
        cluster.ask("scontrol", "update", "NodeName=node", "State=DOWN", "Reason=lost")
        # the second one may have come to its end before, on a machine that was busy when the study was measured
        ended = 1 if len(self.rows(stores[2])) >= 2 * steps // 3 else 0
        cluster.until(lambda: cluster.ask("squeue", "-h", "-t", "PENDING", "-o", "%i").count(f"{array}_") >= 3 - ended, 20,
                      "the tasks are in the queue again")
        self.assertFalse((out / "study.json").exists())
        cluster.start_node()
        cluster.until(lambda: not cluster.ask("squeue", "-h").strip(), 90, "all jobs are done")
        logs = "".join(p.read_text() for p in sorted((out / "slurm").iterdir()))
        self.assertTrue((out / "study.json").exists(), logs)
        self.assertEqual(self.bytes_of(out), wanted)
        self.assertEqual(self.rows(stores[1]) & lost, lost)  # a sample judged twice would have been refused by the store
        self.assertEqual(len(self.rows(stores[1])), share)


if not PARALLEL:
    MISSING = [*MISSING, "parallel"]

if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if MISSING:
        print(f"SKIPPED in part: {', '.join(MISSING)} not installed")
    sys.exit(1 if not result.wasSuccessful() else 77 if MISSING else 0)
