#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page's server while its calls fail: the n-th fork, exec, pipe, pair of sockets, accept, poll, send, receive, dup, open, read, write,
close, mkdir, allocation ... of the server, or of every job and worker that it starts, once or from then on.

    served.py PROGRAM PRELOAD [--seed N] [--count N] [--all] [--kind NAME ...] [--children] [--at N ERRNO EVER]

A client does what the page does: it enters, asks for a preview, starts a job, reads its result and its archive. What must hold in each run:

  * the server begins, or ends by itself with 5 (6: memory) and the reason;
  * every answer is the right one, or an error of HTTP with its reason, or none: never another result;
  * where the call failed once, all that is asked afterwards is right;
  * descriptors do not grow, and of processes there are the workers alone, when no job runs any more;
  * SIGTERM ends it within 10 s, with no process, no directory and no socket left."""
import argparse
import errno
import http.client
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/serve"))
from client import DEVICE, Server, processes  # noqa: E402

ERRORS = {
    "fork": ["EAGAIN", "ENOMEM"], "exec": ["ENOMEM", "EAGAIN", "EMFILE", "EACCES"], "pipe": ["EMFILE", "ENFILE", "ENOMEM"],
    "socket": ["EMFILE", "ENFILE", "ENOBUFS", "ECONNABORTED", "EACCES", "EINTR"], "wait": ["EINTR", "ENOMEM"],
    "watch": ["ENOMEM", "ENOSPC"], "interrupted": ["EINTR"],
    "send": ["ECONNRESET", "EPIPE", "EAGAIN", "ENOBUFS", "EINTR"], "descriptor": ["EMFILE", "EINTR"],
    "open": ["EMFILE", "EACCES", "EIO", "ENOSPC", "EINTR"], "read": ["EIO", "EINTR"], "write": ["ENOSPC", "EIO", "EINTR"], "short": ["ENOSPC"],
    "close": ["EIO", "EINTR"], "mkdir": ["ENOSPC", "EACCES"], "opendir": ["EMFILE", "EIO"], "stat": ["EACCES", "EIO"], "unlink": ["EACCES", "EIO"],
    "rename": ["ENOSPC", "EIO"], "fsync": ["EIO"], "mmap": ["ENOMEM"], "memory": ["ENOMEM"]}
# of the server when the first job begins, behind its two workers; of every child of it
ALWAYS = [("fork", 3, "EAGAIN", True, False), ("exec", 1, "EACCES", True, False)]
TEXT = (ROOT / "tests/data/effect-costs/free.xml").read_text()
JOB = {"kind": "check", "text": DEVICE.read_text(), "options": {"accuracy": 0.1, "corners": "none", "advice": "none"}}
LIVE = {"text": TEXT}
TIMES = re.compile(rb'"(\w*cpu_s|cost)": ?(\{[^}]*\}|[-+.e\d]+)')
MOST_S = 30  # far above what any of this takes


def below(pid):
    """processes below this one that have not ended"""
    return [p for p, (_, state, _) in processes(pid).items() if p != pid and state != "Z"]


def descriptors(server):
    """of the server once connections are closed: the least that is seen"""
    least = 1 << 30
    for _ in range(8):
        least = min(least, len(os.listdir(f"/proc/{server.process.pid}/fd")))
        time.sleep(0.02)
    return least


class Refused(Exception):
    """an error of HTTP that says why, or no answer"""


def asked(server, method, path, body=None):
    try:
        status, _, data = server.ask(method, path, body, timeout=2 if server.deaf else MOST_S)
    except TimeoutError as error:
        if server.deaf:
            raise Refused(f"{path} is not heard") from error
        raise AssertionError(f"{path} is never answered") from error
    except (OSError, http.client.HTTPException) as error:
        raise Refused(f"{path}: {error!r}") from error
    if status >= 400:
        assert data.strip(), f"{path}: {status} without a reason"
        raise Refused(f"{path}: {status} {data[:200]!r}")
    return status, data


def script(server):
    """the page's questions in turn: {what: answer, or Refused}"""
    got = {}

    def step(what, method, path, body=None):
        try:
            got[what] = asked(server, method, path, body)[1]
        except Refused as refused:
            got[what] = refused
        if isinstance(got[what], bytes) and what in ("preview", "verdict"):
            got[what] = TIMES.sub(b"", got[what])
        if what == "preview" and isinstance(got[what], bytes) and b'"exit_status":5' in got[what] and b'"severity":"error"' in got[what]:
            got[what] = Refused("a preview that says what could not be read")
        return got[what] if isinstance(got[what], bytes) else None

    try:
        if server.cookie is None:  # the address with its token is good once: what failed behind it is asked again without
            status, headers, _ = server.ask("GET", f"/?token={server.entry}", cookie=False, timeout=2 if server.deaf else MOST_S)
            server.cookie = headers["set-cookie"].split(";")[0]
        if server.token is None:
            server.token = json.loads(asked(server, "GET", "/api/session")[1])["token"]
    except (Refused, OSError, http.client.HTTPException, KeyError) as error:
        got["entering"] = Refused(repr(error))
        return got
    step("preview", "POST", "/api/preview", LIVE)
    begun = step("begun", "POST", "/api/jobs", JOB)
    if begun is None:
        return got
    number = json.loads(begun)["id"]
    got["begun"] = b""
    end, refused = time.monotonic() + MOST_S, 0
    while time.monotonic() < end:
        job = step("state", "GET", f"/api/jobs/{number}")
        state = json.loads(job) if job is not None else {"state": "unknown"}
        if job is not None and state["state"] not in ("queued", "running"):
            break
        refused += job is None
        if refused > 5 and server.stays:
            return got  # where every answer needs what fails for good, none comes
        time.sleep(0.02)
    else:
        raise AssertionError(f"the job does not end: {got['state']}")
    if state["state"] == "done":
        got["state"] = json.dumps([state.get("exit_status"), state["state"]]).encode()
        step("verdict", "GET", f"/api/jobs/{number}/files/verdict.json")
        step("archive", "GET", f"/api/jobs/{number}/archive")
        if isinstance(got["archive"], bytes):
            got["archive"] = got["archive"][:2]
    else:
        assert state.get("messages") or state.get("why") or state.get("message") or "status" in state, f"a job failed without a word: {state}"
        got["state"] = Refused(json.dumps(state))
    return got


class Tried:
    def __init__(self, program, preload):
        self.program, self.preload = program, preload
        self.wanted, self.counts, self.seen, self.most = None, {}, 0, 0

    def begin(self, here, fault):
        environment = {"LD_PRELOAD": str(self.preload), "OPENBLAS_NUM_THREADS": "1", **fault}
        server = Server(self.program, here, environment=environment, patience=15)
        server.deaf = server.stays = False
        return server

    def clean(self):
        with tempfile.TemporaryDirectory() as name:
            report = pathlib.Path(name) / "count"
            with self.begin(name, {"FW_FAULT_KIND": "none", "FW_FAULT_REPORT": str(report)}) as server:
                self.wanted = script(server)
                again = script(server)
                script(server)
                self.most = descriptors(server) + 1  # jobs that are kept have their directories
            refused = [w for w in self.wanted.values() if isinstance(w, Refused)]
            assert not refused, f"without a fault: {refused}"
            assert again == self.wanted, "the same questions have other answers: " + ", ".join(k for k in again if again[k] != self.wanted[k])
            self.counts = {k: int(n) for k, n in (line.split() for line in report.read_text().splitlines())}

    def wrong(self, kind, n, error, ever, children):
        fault = {"FW_FAULT_KIND": kind, "FW_FAULT_AT": str(n), "FW_FAULT_ERRNO": str(getattr(errno, error)), "FW_FAULT_EVER": str(int(ever))}
        if children:
            fault["FW_FAULT_CHILDREN"] = "1"
        with tempfile.TemporaryDirectory() as name:
            try:
                server = self.begin(name, fault)
            except AssertionError:
                return self.refused_to_begin(pathlib.Path(name), kind)
            server.stays = ever
            server.deaf = ever and kind == "socket" and not children  # where nobody can be accepted for good, nobody is
            try:
                return self.of(server, pathlib.Path(name), ever or children)
            finally:
                if server.process.poll() is None:
                    server.process.kill()
                    server.process.wait()

    def refused_to_begin(self, here, kind):
        said = (here / "server.err").read_text()
        left = [p.name for p in here.iterdir() if p.name != "server.err"]
        if "; the address is http" in said:
            return None  # standard output failed; ended from here since it waits for somebody
        if "error:" not in said:
            return f"does not begin, and does not say why: {said[-300:]!r}"
        return f"does not begin, and leaves {left}" if left and kind not in ("unlink", "opendir", "memory", "open") else None

    def of(self, server, here, stays):
        pid = server.process.pid
        try:
            first = script(server)
            got = None
            for round_ in range(3):
                got = script(server)
                if round_ == 1 and (got == self.wanted or stays):
                    break  # else the call that failed was one of this round
        except FileNotFoundError:
            return f"the server ended: {server.process.wait()}: {server.said()[-300:]}"
        except AssertionError as error:
            return f"{error}; the server said {server.said()[-200:]!r}"
        for round_, answers in (("", first), (", asked again", got)):
            for what, answer in answers.items():
                if isinstance(answer, bytes) and answer != self.wanted[what]:
                    return f"another answer of {what}{round_}: {answer[:200]!r}"
        self.seen += any(isinstance(a, Refused) for a in first.values())
        if not stays and got != self.wanted:
            return "not right again: " + ", ".join(f"{k}: {v}" for k, v in got.items() if v != self.wanted.get(k))[:600]
        end = time.monotonic() + 5
        most = self.most
        while (len(below(pid)) > 3 or len(os.listdir(f"/proc/{pid}/fd")) > most) and time.monotonic() < end:
            time.sleep(0.05)
        if len(below(pid)) > 3:
            return f"{len(below(pid))} processes stay"
        if len(os.listdir(f"/proc/{pid}/fd")) > most:
            names = sorted(os.readlink(e) for e in pathlib.Path(f"/proc/{pid}/fd").iterdir())
            return f"{len(names)} descriptors, without a fault {most - 1}: {names}"
        return self.ended(server, here, stays)

    def ended(self, server, here, stays):
        children = below(server.process.pid)
        server.process.send_signal(signal.SIGTERM)
        try:
            status = server.process.wait(10)
        except subprocess.TimeoutExpired:
            return "SIGTERM does not end it within 10 s"
        time.sleep(0.05)
        left = [p for p in children if pathlib.Path(f"/proc/{p}").exists() and "Z" not in pathlib.Path(f"/proc/{p}/stat").read_text().split(")")[1][:3]]
        if left:
            return f"processes {left} are left"
        files = [p.name for p in here.iterdir() if p.name != "server.err"]
        if files and not stays:
            return f"left {files}"
        return None if status in (0, 5, 6, -signal.SIGTERM, 128 + signal.SIGTERM) else f"ended with {status}"


def fixed(program, preload):
    """what was found once, without a client: what is wrong"""
    def begun(fault, out, seconds):
        with tempfile.TemporaryDirectory() as name:
            report = pathlib.Path(name) / "count"
            environment = {**os.environ, "TMPDIR": name, "LD_PRELOAD": str(preload), "FW_FAULT_REPORT": str(report), **fault}
            with open(out, "wb") as stdout:
                server = subprocess.Popen([str(program), "serve", "--no-browser"], cwd=name, stdout=stdout, stderr=subprocess.PIPE, env=environment)
            try:
                status = server.wait(seconds)
            except subprocess.TimeoutExpired:
                server.send_signal(signal.SIGTERM)
                status = None
            said = server.communicate(timeout=10)[1].decode()
            counts = dict(line.split() for line in report.read_text().splitlines()) if report.exists() else {}
            return status, said, counts

    wrong = []
    memory = {"FW_FAULT_KIND": "memory", "FW_FAULT_AT": "1", "FW_FAULT_ERRNO": "12", "FW_FAULT_EVER": "1"}
    status, said, _ = begun(memory, "/dev/null", 10)
    if status != 6 or "error: " not in said:
        wrong.append(f"without memory it ends with {status} and says {said!r}")
    status, said, _ = begun({"FW_FAULT_KIND": "none"}, "/dev/full", 0.4)
    if "the address is http://127.0.0.1:" not in said:
        wrong.append(f"where standard output is full the address is nowhere: {status}, {said!r}")
    _, said, counts = begun({"FW_FAULT_KIND": "wait", "FW_FAULT_AT": "1", "FW_FAULT_ERRNO": "12", "FW_FAULT_EVER": "1"}, "/dev/null", 0.6)
    if not 0 < int(counts.get("wait", 0)) < 300:  # thousands where it does not rest
        wrong.append(f"without memory to wait with it asks {counts.get('wait')} times in 0.6 s; it said {said!r}")
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("preload", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--kind", nargs="*", default=sorted(ERRORS), choices=sorted(ERRORS))
    parser.add_argument("--all", action="store_true", help="every n of every kind, each error, once and from then on")
    parser.add_argument("--at", nargs=3, metavar=("N", "ERRNO", "EVER"), help="this one alone, of --kind")
    parser.add_argument("--children", action="store_true", help="with --at: of the jobs and workers")
    o = parser.parse_args()
    tried = Tried(o.program.resolve(), o.preload.resolve())
    tried.clean()
    rng, runs, bad = random.Random(o.seed), 0, 0
    if o.at:
        points = [(o.kind[0], int(o.at[0]), o.at[1], bool(int(o.at[2])), o.children)]
    elif o.all:
        points = [(k, n, e, ever, False) for k in o.kind for n in range(1, tried.counts[k] + 1) for e in ERRORS[k] for ever in (False, True)
                  if not (ever and e == "EINTR")]
    else:
        points = ALWAYS[:o.count] if o.kind == sorted(ERRORS) else []
        while len(points) < o.count:
            kind = rng.choice(o.kind)
            children = rng.random() < 0.3
            # of the server as often at its first calls, when it begins, as later; jobs and workers make as many as ten of most kinds
            n = 1 + int((10 if children else max(tried.counts[kind], 1)) ** rng.random())
            error = rng.choice(ERRORS[kind])
            points.append((kind, n, error, error != "EINTR" and rng.random() < 0.4, children))
    for what in fixed(tried.program, tried.preload) if not o.at and not o.all and o.kind == sorted(ERRORS) else []:
        bad += 1
        print(what, flush=True)
    for kind, n, error, ever, children in points:
        what = tried.wrong(kind, n, error, ever, children)
        runs += 1
        if what:
            bad += 1
            print(f"{kind} {n} of {tried.counts[kind]}, {error}{' and all later' if ever else ''}{' of its children' if children else ''}: {what}",
                  flush=True)
    print(f"{runs} runs, in {tried.seen} of which the client saw an error; {bad} wrong")
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
