#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The server under load, slow clients, signals and kill -9; jobs, files, archive, watching and saving.

    robust.py PROGRAM [TEST ...]"""
import concurrent.futures
import io
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import zipfile

from client import DEVICE, ROOT, Server, processes

TEXT = DEVICE.read_text()
QUICK = {"kind": "check", "text": TEXT, "options": {"accuracy": 0.05, "corners": "none"}}
SLOW = {"kind": "workspace", "text": TEXT, "options": {"accuracy": 1e-6}}
DEADLINE_S = 12.0  # a client that is too slow is cut by then


def scratch(directory):
    return [p for p in pathlib.Path(directory).iterdir() if p.name.startswith("flexwright-serve-")]


# ---- sockets ----

def only_loopback(program, directory):
    """the listening sockets of the server, from the kernel's own table"""
    with Server(program, directory) as server:
        inodes = set()
        for fd in pathlib.Path(f"/proc/{server.process.pid}/fd").iterdir():
            try:
                target = os.readlink(fd)
            except OSError:
                continue
            if target.startswith("socket:["):
                inodes.add(target[8:-1])
        listening = []
        for table in ("tcp", "tcp6", "udp", "udp6", "raw", "raw6"):
            for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
                field = line.split()
                if field[9] in inodes and (field[3] == "0A" or not table.startswith("tcp")):
                    listening.append((table, field[1]))
        assert listening == [("tcp", f"0100007F:{server.port:04X}")], listening


def half_open(program, directory):
    """40 clients that stop in the head and 20 that drip: an honest request within 5 s, all cut within 12 s"""
    with Server(program, directory) as server:
        server.enter()
        quiet = [server.connect() for _ in range(40)]
        for s in quiet:
            s.sendall(b"GET /api/session HTTP/1.1\r\nHost: ")
        dripping = [server.connect() for _ in range(20)]
        stop, cut = threading.Event(), {}
        began = time.monotonic()

        def drip():
            alive = set(dripping)
            while alive and not stop.wait(0.5):
                for s in list(alive):
                    try:
                        s.sendall(b"x")
                        s.setblocking(False)
                        if s.recv(1000) == b"":
                            raise ConnectionResetError
                    except BlockingIOError:
                        s.setblocking(True)
                    except OSError:
                        alive.discard(s)
                        cut[s] = time.monotonic() - began

        thread = threading.Thread(target=drip, daemon=True)
        thread.start()
        try:
            for _ in range(3):
                at = time.monotonic()
                assert server.ask("GET", "/api/session", timeout=10)[0] == 200
                took = time.monotonic() - at
                assert took <= 5.0, f"an honest request took {took:.1f} s"
            for s in quiet:
                s.settimeout(max(0.1, DEADLINE_S - (time.monotonic() - began)))
                try:
                    while s.recv(1000):
                        pass
                except socket.timeout:
                    raise AssertionError("a half-open client is still there after 12 s") from None
                except ConnectionError:
                    pass
            thread.join(timeout=DEADLINE_S)
        finally:
            stop.set()
            thread.join()
            for s in quiet + dripping:
                s.close()
        assert len(cut) == len(dripping) and max(cut.values()) <= DEADLINE_S, sorted(cut.values())


def drip_alone(program, directory):
    """with room for all, a client that always sends a little is cut by the deadline of the whole request"""
    with Server(program, directory) as server:
        server.enter()
        write = (f"Host: {server.host}\r\nCookie: {server.cookie}\r\nX-Flexwright-Token: {server.token}\r\n"
                 "Content-Type: application/json\r\nContent-Length: 5000\r\n\r\n")
        began, alive = time.monotonic(), {}
        for begin in ("G", "GET / HTTP/1.1\r\nX: ", "POST /api/jobs HTTP/1.1\r\n" + write):
            s = server.connect()
            s.sendall(begin.encode())
            alive[s] = begin
        while alive and time.monotonic() - began < DEADLINE_S:
            time.sleep(0.5)
            for s in list(alive):
                try:
                    s.sendall(b"x")
                    s.setblocking(False)
                    if not s.recv(1000):
                        raise ConnectionResetError
                except BlockingIOError:
                    s.setblocking(True)
                except OSError:
                    s.close()
                    del alive[s]
        for s in alive:
            s.close()
        assert not alive, f"they still drip after {DEADLINE_S} s: {[b[:20] for b in alive.values()]}"


def loaded(program, directory):
    """80 previews at once, with all tests 200: none ends in a fault of the server, and its processes stay below 200 MiB. FW_SERVE_PREVIEWS: so
    many instead, for sanitizers, which are slow and large"""
    number = int(os.environ.get("FW_SERVE_PREVIEWS", "200" if os.environ.get("FW_TEST_ALL") else "80"))
    with Server(program, directory) as server:
        server.enter()
        server.ask("POST", "/api/preview", {"text": TEXT})
        most, stop = [0], threading.Event()

        def watch():
            while not stop.wait(0.2):
                most[0] = max(most[0], sum(row[2] for row in processes(server.process.pid).values()))

        thread = threading.Thread(target=watch, daemon=True)
        thread.start()
        began = time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(number) as pool:
            many = list(pool.map(lambda i: server.ask("POST", "/api/preview", {
                "text": TEXT, "set": {"arc": f"{240 + i % 20} deg"}, "options": {"samples": 101}})[0], range(number)))
        took = time.monotonic() - began
        stop.set()
        thread.join()
        live = 501 not in many  # a build without live computing answers 501
        print(f"  {number} previews in {took:.1f} s, at most {most[0] / 2**20:.0f} MiB resident, live: {live}")
        assert all(status == 200 for status in many) or not live, sorted(set(many))
        assert most[0] <= (160 + number / 5) * 2**20 or "FW_SERVE_PREVIEWS" in os.environ  # 200 MiB at 200


# ---- jobs ----

def unpacked(data):
    with zipfile.ZipFile(io.BytesIO(data)) as z:
        assert {i.date_time for i in z.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        return {i.filename: z.read(i) for i in z.infolist()}


def archive(program, directory):
    """the archive is what the command line writes, byte by byte, and twice the same"""
    there = pathlib.Path(directory, "device.xml")
    there.write_text(TEXT)
    subprocess.run([program, "plan", "device.xml", "--set", "arc=250 deg", "--accuracy", "0.01", "-o", "planned", "-q"],
                   cwd=directory, check=False, stdout=subprocess.DEVNULL)
    planned = {str(p.relative_to(there.parent / "planned")): p.read_bytes()
               for p in sorted((there.parent / "planned").rglob("*")) if p.is_file()}
    assert len(planned) > 20
    with Server(program, directory, device="device.xml") as server:
        server.enter()
        job = server.job({"kind": "plan", "text": TEXT, "set": {"arc": "250 deg"}, "options": {"accuracy": 0.01, "at": "rest"}})
        assert job["state"] == "done" and job["exit_status"] == 0 and job["result"]["schema"] == "flexwright.verdict/1", job
        assert {f["path"]: f["bytes"] for f in job["files"]} == {k: len(v) for k, v in planned.items()}
        base = f"/api/jobs/{job['id']}"
        for path, data in planned.items():
            status, headers, got = server.ask("GET", f"{base}/files/{path}")
            assert (status, got) == (200, data), path
            assert "sandbox" in headers["content-security-policy"] and "same-origin" not in headers["content-security-policy"]
        status, headers, first = server.ask("GET", f"{base}/archive")
        assert status == 200 and headers["content-type"] == "application/zip", (status, first[:200])
        inside = unpacked(first)
        assert list(inside) == sorted(planned) and inside == planned
        # packed anew at another time of another zone the bytes are the same
        again = server.job({"kind": "plan", "text": TEXT, "set": {"arc": "250 deg"}, "options": {"accuracy": 0.01}})
        assert server.ask("GET", f"/api/jobs/{again['id']}/archive")[2] == first
        assert server.ask("DELETE", base)[0] == 200
        assert server.ask("GET", base)[0] == 404 and server.ask("GET", f"{base}/archive")[0] == 404
        assert len(list(scratch(directory)[0].iterdir())) == 2  # the lock and the second job


def jobs(program, directory):
    """queue, cancel, errors, options that are refused, forgetting"""
    with Server(program, directory) as server:
        server.enter()
        events = server.events()
        events.until("retry")
        first = server.json("POST", "/api/jobs", SLOW)["id"]
        events.until(f'"id": {first}, "state": "running"')
        waiting = [server.json("POST", "/api/jobs", QUICK)["id"] for _ in range(4)]
        status, _, data = server.ask("POST", "/api/jobs", QUICK)
        assert status == 429 and json.loads(data)["error"]["code"] == "FW-D287", data
        running = [pid for pid, row in processes(server.process.pid).items() if row[0] == server.process.pid]
        assert len(running) >= 3  # two workers and the job
        began = time.monotonic()
        assert server.json("DELETE", f"/api/jobs/{first}")["state"] == "cancelled"
        assert time.monotonic() - began < 1.0
        events.until(f'"id": {first}, "state": "cancelled"')
        assert server.json("DELETE", f"/api/jobs/{waiting[3]}")["state"] == "cancelled"
        cancelled = server.json("GET", f"/api/jobs/{first}")
        assert cancelled["state"] == "cancelled" and not cancelled["files"] and cancelled["exit_status"] is None
        assert server.ask("GET", f"/api/jobs/{first}/archive")[0] == 404
        assert server.json("DELETE", f"/api/jobs/{first}")["state"] == "cancelled"
        assert server.ask("GET", f"/api/jobs/{first}")[0] == 404
        events.until(f'"id": {waiting[2]}, "state": "done"', timeout=60)
        assert server.json("GET", f"/api/jobs/{waiting[0]}")["result"]["schema"] == "flexwright.verdict/1"
        bad = server.job({"kind": "check", "text": "<device"})
        assert bad["state"] == "failed" and bad["exit_status"] == 3 and any("FW-D" in m for m in bad["messages"]), bad
        for wrong in ({"kind": "check"}, {"kind": "rm", "text": ""}, {"kind": ["check"], "text": ""}, [], 1, "x",
                      {"kind": "check", "text": "", "options": {"output": "/elsewhere"}},
                      {"kind": "check", "text": "", "options": {"lab": "/etc/passwd"}},
                      {"kind": "check", "text": "", "options": {"accuracy": {"a": 1}}},
                      {"kind": "check", "text": "", "options": []}, {"kind": "check", "text": "", "set": {"": "1"}},
                      {"kind": "check", "text": "", "set": {"a=b": "1"}}, {"kind": "check", "text": "", "set": {"a": None}}):
            assert server.ask("POST", "/api/jobs", wrong)[0] == 400, wrong
        assert server.ask("POST", "/api/jobs", b'{"kind": "check", "text": "')[0] == 400
        assert server.ask("POST", "/api/jobs", b'\xff\xfe')[0] == 400
        for _ in range(14):  # beyond the 16 that are kept, the oldest is forgotten
            last = server.job({"kind": "check", "text": "<device"})["id"]
        assert server.ask("GET", f"/api/jobs/{last}")[0] == 200 and server.ask("GET", f"/api/jobs/{waiting[0]}")[0] == 404
        assert len(list(scratch(directory)[0].iterdir())) <= 17
        events.close()
        assert not server.said()


def kinds(program, directory):
    """every command that a page may start, as far as this version has it"""
    schemas = {"plan": "verdict", "check": "verdict", "workspace": "workspace", "modes": "modes", "statics": "statics",
               "assemble": "assemble", "hinge": "hinge", "recipe": "recipes", "mask": "masks", "simulate": "simulate"}
    with Server(program, directory) as server:
        server.enter()
        for kind, schema in schemas.items():
            job = server.job({"kind": kind, "text": TEXT, "options": {"accuracy": 0.05, "corners": "none", "effects": "auto"}})
            assert job["state"] == "done" and job["result"]["schema"] == f"flexwright.{schema}/1", (kind, job)
            assert job["files"] and all(f["bytes"] > 0 for f in job["files"]), (kind, job["files"])


def counted(program, directory):
    """the trade-off of a job counts its instructions within the job's limits, as the command line does"""
    text = (ROOT / "tests/data/six-bar-benchmark.xml").read_text()
    with Server(program, directory) as server:
        server.enter()
        job = server.job({"kind": "tradeoff", "text": text, "options": {"budget": 1, "corners": "none"}})
        result = job["result"]
        assert job["state"] == "done" and result["schema"] == "flexwright.tradeoff/1", job
        by = [p["instructions_by"] for p in result["points"] if p["state"] == "done"]
        if shutil.which("valgrind"):
            assert result["instructions_why"] is None and by.count("callgrind") > 3, (result["instructions_why"], by)
        else:
            assert result["instructions_why"] == "valgrind is not installed" and set(by) == {"model"}, by
        assert str(directory) not in json.dumps(job), "the directory of jobs is nobody's business"
        [work] = scratch(directory)
        assert sorted(p.name for p in (work / "job-1").iterdir()) == ["device.xml", "out", "printed"]
        assert (work / "job-1/device.xml").stat().st_mode & 0o777 == 0o600


def limits(program, directory):
    """what a child process may: the limits of jobs and workers, as the kernel has them"""
    with Server(program, directory) as server:
        server.enter()
        for _ in range(8):  # a worker has its share of time from its first question on
            server.ask("POST", "/api/preview", {"text": TEXT})
            server.ask("POST", "/api/pose", {"text": TEXT})
        server.json("POST", "/api/jobs", SLOW)
        time.sleep(0.3)
        children = [pid for pid, row in processes(server.process.pid).items() if row[0] == server.process.pid]
        assert len(children) == 3, children
        sanitized = b"libasan" in pathlib.Path(f"/proc/{children[0]}/maps").read_bytes()
        for pid in children:
            found = {line[:25].strip(): line[26:46].strip()
                     for line in pathlib.Path(f"/proc/{pid}/limits").read_text().splitlines()[1:]}
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            assert "NoNewPrivs:\t1" in status
            assert found["Max core file size"] == "0" and int(found["Max open files"]) <= 256
            assert sanitized or "unlimited" not in (found["Max file size"], found["Max address space"], found["Max cpu time"])
            assert os.getpgid(pid) == pid
            secrets = pathlib.Path(f"/proc/{pid}/environ").read_bytes() + pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
            assert server.cookie.split("=")[1].encode() not in secrets
            held = [os.readlink(f) for f in pathlib.Path(f"/proc/{pid}/fd").iterdir()]
            assert sum(h.startswith("socket:") for h in held) <= 1, held  # its channel; no socket of a client


def crash(program, directory):
    """a worker that is killed: the request says so, the next one is served"""
    with Server(program, directory) as server:
        server.enter()
        for _ in range(2):
            for pid, row in processes(server.process.pid).items():
                if row[0] == server.process.pid:
                    os.kill(pid, signal.SIGKILL)
            time.sleep(2.2)
            status, _, data = server.ask("POST", "/api/preview", {"text": TEXT})
            assert status in (200, 501), data
        assert len(processes(server.process.pid)) == 3


def abandoned(program, directory):
    """a slider that moves on: requests whose page went away are given up, and do not hold up the last one"""
    with Server(program, directory) as server:
        server.enter()
        if server.ask("POST", "/api/preview", {"text": TEXT})[0] == 501:
            print("  this build computes nothing live")
            return

        def ask(options):
            body = json.dumps({"text": heavy, "options": options}).encode()
            return (f"POST /api/preview HTTP/1.1\r\nHost: {server.host}\r\nCookie: {server.cookie}\r\n"
                    f"X-Flexwright-Token: {server.token}\r\nContent-Type: application/json\r\n"
                    f"Content-Length: {len(body)}\r\n\r\n").encode() + body

        heavy, options = DEVICE.parent.parent.joinpath("four-tendons/device.xml").read_text(), {"corners": "auto"}
        began = time.monotonic()
        for _ in range(25):
            with server.connect() as s:
                s.sendall(ask(options))
                time.sleep(0.02)
        status, _, data = server.ask("POST", "/api/preview", {"text": TEXT})
        took = time.monotonic() - began
        assert status == 200 and json.loads(data)["status"] == "ok", data[:300]
        began = time.monotonic()
        assert server.ask("POST", "/api/preview", {"text": heavy, "options": options})[0] == 200
        one = time.monotonic() - began
        print(f"  after 25 that were given up: {took:.2f} s; one of them takes {one:.2f} s")
        assert took < 0.5 * 25 * one / 2  # two workers


def cpu_of_children(server):
    """processor seconds of all processes below the server"""
    total = 0.0
    for pid in processes(server.process.pid):
        if pid != server.process.pid:
            stat = pathlib.Path(f"/proc/{pid}/stat").read_text()
            field = stat[stat.rindex(")") + 2:].split()
            total += (int(field[11]) + int(field[12])) / os.sysconf("SC_CLK_TCK")
    return total


def given_up(program, directory):
    """whose page went away stops computing: far less work than the whole, and the same processes go on"""
    text = (ROOT / "docs/gallery/copper-nodder/device.xml").read_text()
    body = json.dumps({"text": text, "options": {"detail": "full", "accuracy": 1e-5}}).encode()
    with Server(program, directory) as server:
        server.enter()
        first = set(processes(server.process.pid))
        begun = cpu_of_children(server)
        assert server.ask("POST", "/api/preview", json.loads(body))[0] == 200
        whole = cpu_of_children(server) - begun
        begun = cpu_of_children(server)
        asking = server.connect()
        asking.sendall(f"POST /api/preview HTTP/1.1\r\nHost: {server.host}\r\nCookie: {server.cookie}\r\n"
                       f"X-Flexwright-Token: {server.token}\r\nContent-Type: application/json\r\n"
                       f"Content-Length: {len(body)}\r\n\r\n".encode() + body)
        while cpu_of_children(server) - begun < 0.05:
            time.sleep(0.005)
        asking.close()
        last, quiet = -1.0, 0
        while quiet < 10:
            time.sleep(0.1)
            now = cpu_of_children(server)
            last, quiet = now, quiet + 1 if now == last else 0
        used = last - begun
        print(f"  the whole takes {whole:.2f} s of CPU, given up {used:.2f} s", flush=True)
        assert used < 0.6 * whole and set(processes(server.process.pid)) == first
        assert server.ask("POST", "/api/preview", {"text": TEXT})[0] == 200


def stopped(program, directory):
    """a worker that does not answer is ended after its time, and replaced"""
    with Server(program, directory) as server:
        server.enter()
        for pid, row in processes(server.process.pid).items():
            if row[0] == server.process.pid:
                os.kill(pid, signal.SIGSTOP)
        status, _, data = server.ask("POST", "/api/preview", {"text": TEXT}, timeout=40)
        assert status == 500 and json.loads(data)["error"]["code"] == "FW-D286", data
        assert server.ask("POST", "/api/preview", {"text": TEXT}, timeout=40)[0] in (200, 500, 501)


# ---- the file ----

def file(program, directory):
    """read, save whole or not at all, conflicts, and what an editor saves"""
    there = pathlib.Path(directory, "device.xml")
    there.write_text(TEXT)
    there.chmod(0o640)
    link = pathlib.Path(directory, "link.xml")
    link.symlink_to("device.xml")
    left, living = (pathlib.Path(directory, f"device.xml.tmp-{pid}") for pid in (2**30, os.getpid()))
    left.write_text("of a server that was killed while it saved")
    living.write_text("of one that saves")
    with Server(program, directory, device="link.xml") as server:
        server.enter()
        events = server.events()
        first = server.json("GET", "/api/file")
        events.until(first["version"])  # a page that comes back learns what it missed
        assert first["text"] == TEXT and first["name"] == "device.xml" and first["writable"]
        assert server.json("GET", "/api/session")["file"] == "device.xml"
        second = server.json("POST", "/api/file", {"text": TEXT + "<!-- é -->\n", "version": first["version"]})
        assert there.read_text() == TEXT + "<!-- é -->\n" and link.is_symlink() and there.stat().st_mode & 0o777 == 0o640
        events.until(second["version"])
        status, _, data = server.ask("POST", "/api/file", {"text": "lost", "version": first["version"]})
        conflict = json.loads(data)
        assert status == 409 and conflict["version"] == second["version"] and conflict["text"].endswith("<!-- é -->\n")
        there.write_text("by an editor, in place")
        third = events.until(r'event: file\ndata: {"version": "(?!%s|%s)([0-9a-f]{64})"}' % (
            first["version"], second["version"]), timeout=3).group(1)
        assert server.json("GET", "/api/file")["version"] == third
        other = pathlib.Path(directory, ".device.xml.swp")
        other.write_text("by an editor that puts a new file in place")
        other.rename(there)
        events.until(r'event: file\ndata: {"version": "(?!%s|%s|%s)[0-9a-f]{64}"}' % (
            first["version"], second["version"], third), timeout=3)
        there.unlink()
        assert server.ask("GET", "/api/file")[0] == 404
        there.write_bytes(b"\xff\xfe not UTF-8")
        time.sleep(0.2)
        assert server.ask("GET", "/api/file")[0] == 422
        there.write_bytes(b"x" * (2 << 20))
        assert server.ask("GET", "/api/file")[0] == 404
        status, _, data = server.ask("POST", "/api/file", {"text": "lost", "version": third})
        assert status == 500 and b"larger than" in data and there.stat().st_size == 2 << 20, data
        for wrong in ({}, {"text": 1, "version": ""}, {"text": ""}, []):
            assert server.ask("POST", "/api/file", wrong)[0] == 400, wrong
        events.close()
        assert not server.said() and [p for p in pathlib.Path(directory).iterdir() if ".tmp-" in p.name] == [living]
    with Server(program, directory) as server:
        server.enter()
        assert server.ask("GET", "/api/file")[0] == 404
        assert server.ask("POST", "/api/file", {"text": "", "version": ""})[0] == 404


def lost_file(program, directory):
    """a file that goes away, or becomes a pipe, is told; nothing hangs, and what cannot be read is not replaced"""
    there = pathlib.Path(directory, "device.xml")
    there.write_text(TEXT)
    with Server(program, directory, device="device.xml") as server:
        server.enter()
        events = server.events()
        first = server.json("GET", "/api/file")
        there.unlink()
        events.until(r'event: file\ndata: {"version": null, "why": "cannot be read: No such file', timeout=5)
        os.mkfifo(there)
        began = time.monotonic()
        status, _, data = server.ask("GET", "/api/file")
        assert status == 404 and b"no ordinary file" in data and time.monotonic() - began < 5
        status, _, data = server.ask("POST", "/api/file", {"text": "lost", "version": first["version"]})
        assert status == 500 and b"Move it away" in data and there.is_fifo()
        assert server.ask("POST", "/api/preview", {"text": TEXT})[0] == 200
        there.unlink()
        again = server.json("POST", "/api/file", {"text": TEXT, "version": first["version"]})  # written anew
        assert there.read_text() == TEXT and again["version"] == first["version"]
        events.until(r'event: file\ndata: {"version": "%s"}' % first["version"], timeout=5)
        events.close()
    pathlib.Path(directory, "pipe.xml").unlink(missing_ok=True)
    os.mkfifo(pathlib.Path(directory, "pipe.xml"))
    done = subprocess.run([program, "serve", "--no-browser", "pipe.xml"], cwd=directory, capture_output=True, timeout=20)
    assert done.returncode != 0 and b"cannot be read" in done.stderr, done


def draft(program, directory):
    """a text that nobody saved outlives the server, whatever port the next one has; for nobody but the user"""
    pathlib.Path(directory, "device.xml").write_text(TEXT)
    state = {"XDG_STATE_HOME": str(pathlib.Path(directory, "state"))}
    text = TEXT + "<!-- not saved: é -->\r\n"
    with Server(program, directory, device="device.xml", environment=state) as server:
        server.enter()
        assert server.json("GET", "/api/draft") == {"schema": "flexwright.draft/1", "text": None, "version": None}
        for wrong in ({}, {"text": 1, "version": ""}, {"text": ""}, {"text": "", "version": "", "path": "/"}, []):
            assert server.ask("POST", "/api/draft", wrong)[0] == 400, wrong
        assert server.json("POST", "/api/draft", {"text": text, "version": "v"}) == {"kept": True}
    kept = [p for p in pathlib.Path(directory, "state").rglob("*") if p.is_file()]
    assert len(kept) == 1 and kept[0].stat().st_mode & 0o777 == 0o600 and kept[0].parent.stat().st_mode & 0o777 == 0o700
    with Server(program, directory, environment=state) as server:  # of no file: another draft
        server.enter()
        assert server.json("GET", "/api/draft")["text"] is None
    with Server(program, directory, device="device.xml", environment=state) as server:
        server.enter()
        assert server.json("GET", "/api/draft")["text"] == text
        assert server.json("DELETE", "/api/draft") == {"kept": False} and not kept[0].exists()
        kept[0].write_text("nonsense")
        assert server.json("GET", "/api/draft")["text"] is None
        kept[0].unlink()
        kept[0].parent.rmdir()
        kept[0].parent.write_text("in the way")
        assert server.ask("POST", "/api/draft", {"text": text, "version": "v"})[0] == 503
    with Server(program, directory, device="device.xml", environment={"XDG_STATE_HOME": "", "HOME": ""}) as server:
        server.enter()
        assert server.json("GET", "/api/draft")["text"] is None
        assert server.ask("POST", "/api/draft", {"text": text, "version": "v"})[0] == 503


STUDY = """  <study name="widths" kind="sweep" as="drawn">
    <vary what="link" from="115 um" to="125 um" steps="12"/>
    <respond name="used" value="governing.utilisation"/>
  </study>
</device>"""


def beside(program, directory):
    """a log and the samples of a study that lie beside the file: what the program writes there in a terminal"""
    directory = pathlib.Path(directory)
    device = directory / "d.xml"
    shutil.copy(DEVICE, device)
    (directory / "mail.log").write_text("Nov 20 sendmail: not one of ours\n")
    (directory / "deep/er/and/deeper").mkdir(parents=True)
    outside = directory.parent / "flexwright-outside.log"
    outside.unlink(missing_ok=True)
    flow = {"flow": "al-masked-rie"}
    entry = "S01; start=2026-11-20T10:00; end=2026-11-20T10:08; by=AB; wafer=1; thickness=50.1 um"
    with Server(program, directory, device).enter() as server:
        ask = {"kind": "log", "text": device.read_text()}

        def log(expect="done", files=None, **options):
            job = server.job({**ask, "files": files or {}, "options": {**flow, **options}})
            assert job["state"] == expect, job
            return job
        open_ = log()["result"]  # before there is a log: what there is to enter
        assert open_["entries"] == 0 and "chain" not in open_ and "lot" not in open_
        assert any(m["measure"] == "thickness" and m["unit"] == "um" for m in open_["steps"][0]["measures"]), open_["steps"][0]
        for name in ("../flexwright-outside.log", str(outside), "mail.log", "d.xml", ".log", "-x.log", "a b.log", "a.log.log", "a/b.log"):
            status, _, data = server.ask("POST", "/api/jobs", {**ask, "options": {**flow, "run": name}})
            assert status == 400, (name, status, data)
        assert not outside.exists()
        log(run="lot7.log", entries="new.txt", files={"new.txt": entry + "\n"}, lot="L7", wafers="2")
        told = log(run="lot7.log")
        assert [told["result"][k] for k in ("lot", "wafers", "entries", "logged")] == ["L7", ["1", "2"], 1, 1]
        assert [f["path"] for f in told["files"]] == ["log.html"]
        # it is the log of the command, which goes on with it, and the page with that of the command
        mine = [program, "log", str(device), "--flow", "al-masked-rie", "--run", str(directory / "lot7.log")]
        assert json.loads(subprocess.run([*mine, "--json"], capture_output=True).stdout) == told["result"]
        subprocess.run([*mine, "-q", "--entry", entry.replace("wafer=1", "wafer=2")], check=True, capture_output=True)
        assert log(run="lot7.log")["result"]["entries"] == 2
        assert server.json("GET", "/api/beside")["logs"] == ["lot7.log"]
        assert server.ask("GET", "/api/beside/lot7.log")[2] == (directory / "lot7.log").read_bytes()
        for path in ("mail.log", "../d.xml", "d.xml", "lot7.log.head", "nothing.log"):
            assert server.ask("GET", f"/api/beside/{path}")[0] in (400, 403, 404), path
        refused = log("failed", run="lot7.log", entries="new.txt", files={"new.txt": "S01; start=2026-11-20T10:00; end=2026-11-19T10:08\n"})
        assert any("[FW-D282]" in m for m in refused["messages"]), refused
        whole = (directory / "lot7.log").read_text()
        (directory / "lot7.log").write_text(whole.replace("by=AB", "by=CD"))
        assert any("[FW-D280]" in m for m in log("failed", run="lot7.log")["messages"])
        (directory / "lot7.log").write_text(whole)
        changed = {**ask, "text": ask["text"].replace('value="240 deg"', 'value="238 deg"')}
        job = server.job({**changed, "options": {**flow, "run": "lot7.log"}})
        assert any("[FW-D281]" in m for m in job["messages"]), job

        # a study of the terminal, stopped, is opened as a copy and gone on with
        text = ask["text"].replace("</device>", STUDY)
        device.write_text(text)
        samples = directory / "deep/er/widths/study.sqlite"
        command = [program, "study", str(device), "-o", str(samples.parent), "-q"]
        running = subprocess.Popen([*command, "--jobs", "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(lambda: samples.exists() and samples.stat().st_size > 0)
        status, _, data = server.ask("POST", "/api/jobs", {"kind": "study", "text": text, "results": "deep/er/widths"})
        assert running.poll() is not None or (status == 400 and b"a study is running there" in data), (status, data)
        running.send_signal(signal.SIGINT)
        running.wait()
        assert server.json("GET", "/api/beside")["studies"] == ["deep/er/widths"]
        before = samples.read_bytes()
        job = server.job({"kind": "study", "text": text, "results": "deep/er/widths"})
        assert job["state"] == "done" and job["result"]["samples"]["run"] == 12, job
        assert samples.read_bytes() == before, "the directory was written into"
        subprocess.run([*command, "--resume"], check=True, capture_output=True)
        theirs = json.loads((samples.parent / "study.json").read_text())
        assert all(theirs[k] == job["result"][k] for k in ("samples", "responses", "inputs") if k in theirs) and theirs["samples"]["run"] == 12
        for wrong in ("..", "deep", "deep/er/widths/..", "/etc", "", 7):
            assert server.ask("POST", "/api/jobs", {"kind": "study", "text": text, "results": wrong})[0] == 400, wrong
        other = server.job({"kind": "study", "text": text.replace('to="125 um"', 'to="126 um"'), "results": "deep/er/widths"})
        assert other["state"] == "failed" and any("[FW-D495]" in m for m in other["messages"]), other


def words(program, directory):
    """what is no UTF-8 (a file's name, its text, a line that was cut) does not break the JSON of an answer"""
    odd = os.path.join(os.fsencode(directory), b"d\xff\xc3.xml")
    file = pathlib.Path(os.fsdecode(odd))
    file.write_bytes(b"<device name='\xff'/>")
    with Server(program, directory, device=os.fsdecode(odd)) as server:
        server.enter()
        assert server.json("GET", "/api/session")["file"] == "d??.xml"
        assert server.ask("GET", "/api/file")[0] == 422
        long = "<device name='" + "ä" * 3000 + "'/>"
        file.write_text(long, encoding="utf-8")
        answer = server.json("GET", "/api/file")
        assert answer["name"] == "d??.xml" and answer["text"] == long, answer["name"]
        for text in ("<device name='" + "ä" * 3000 + "'/>", "<" + "ü" * 5000 + ">", "<device a='" + "x" + "ö" * 2500 + "'"):
            job = server.job({"kind": "check", "text": text})
            assert job["state"] == "failed" and job["messages"], job


def entry(program, directory):
    """the printed address: once; by a file for the browser, because command lines are seen by all"""
    with Server(program, directory) as server:
        page = scratch(directory)[0] / "open.html"
        assert server.entry in page.read_text() and page.stat().st_mode & 0o777 == 0o600
        assert page.parent.stat().st_mode & 0o777 == 0o700
        # the browser says that it comes from a file: then no redirection, which would not carry the cookie
        status, headers, data = server.ask("GET", f"/?token={server.entry}", headers={"Sec-Fetch-Site": "cross-site"})
        assert status == 200 and b"refresh" in data and b"<script" not in data and not page.exists()
        server.cookie = headers["set-cookie"].split(";")[0]
        assert "HttpOnly" in headers["set-cookie"] and "SameSite=Strict" in headers["set-cookie"]
        status, headers, data = server.ask("GET", "/", headers={"Sec-Fetch-Site": "same-origin"})
        assert status == 200 and b"<title>" in data
        for name, value in (("x-content-type-options", "nosniff"), ("referrer-policy", "no-referrer"),
                            ("cross-origin-opener-policy", "same-origin"), ("cross-origin-resource-policy", "same-origin")):
            assert headers[name] == value, name
        policy = headers["content-security-policy"]
        for part in ("default-src 'self'", "object-src 'none'", "base-uri 'none'", "frame-ancestors 'none'"):
            assert part in policy and "unsafe" not in policy
        assert "access-control-allow-origin" not in headers
        status, again, data = server.ask("GET", "/", headers={"If-None-Match": headers["etag"]})
        assert status == 304 and not data and again["etag"] == headers["etag"]
        assert server.ask("GET", "/api/session")[1]["cache-control"] == "no-store"
        assert server.ask("GET", "/", headers={"Sec-Fetch-Site": "cross-site"})[0] == 403
        status, headers, data = server.ask("GET", f"/?token={server.entry}")  # by hand, a second time: in words
        assert status == 403 and headers["content-type"].startswith("text/html") and b"used already" in data


def streams(program, directory):
    """four pages may listen; one that goes away makes room"""
    with Server(program, directory) as server:
        server.enter()
        four = [server.events() for _ in range(4)]
        for e in four:
            e.until("retry")
        assert server.ask("GET", "/api/events")[0] == 429
        four[0].close()
        time.sleep(0.3)
        four[0] = server.events()
        four[0].until("retry")
        for e in four:
            e.close()


# ---- the end ----

def asked_while_it_ends(program, directory):
    """what is asked for in the very moment of the signal, streams, previews and jobs, is answered or cut, and the server ends well"""
    for last in (b"GET /api/events", b"POST /api/preview", b"POST /api/pose"):
        server = Server(program, directory).enter()
        body = json.dumps({"text": TEXT}).encode()
        head = last + (f" HTTP/1.1\r\nHost: {server.host}\r\nCookie: {server.cookie}\r\nX-Flexwright-Token: {server.token}\r\n"
                       f"Origin: http://{server.host}\r\n").encode()
        if last.startswith(b"POST"):
            head += f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n".encode() + body
        else:
            head += b"\r\n"
        many = [server.connect() for _ in range(6)]
        for s in many:
            s.sendall(head[:-5])
        server.ask("GET", "/api/session")  # they are taken, and read so far
        server.process.send_signal(signal.SIGSTOP)
        for s in many:
            s.sendall(head[-5:])
        server.process.send_signal(signal.SIGTERM)
        server.process.send_signal(signal.SIGCONT)
        server.process.wait(timeout=20)
        for s in many:
            s.close()
        server.stop()
        assert server.process.returncode == 0 and not server.said(), (last, server.process.returncode, server.said())


def signals(program, directory):
    """SIGTERM, SIGINT and SIGHUP end it, 2 s later at most on a quiet machine, whatever it does; nothing is left"""
    port = 0  # the next one takes the port of the first
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        server = Server(program, directory, options=["--port", str(port)]).enter()
        port = server.port
        server.json("POST", "/api/jobs", SLOW)
        events = server.events()
        events.until("retry")
        half = server.connect()
        half.sendall(b"GET / HT")
        children = [pid for pid in processes(server.process.pid) if pid != server.process.pid]
        took = server.stop(number)
        events.close()
        half.close()
        assert took <= 10.0, f"{took:.1f} s"  # a busy machine; the job, and clients who wait, would take minutes
        assert server.process.returncode == 0 and not server.said(), (server.process.returncode, server.said())
        assert not scratch(directory) and not any(os.path.exists(f"/proc/{pid}") for pid in children)


def killed(program, directory):
    """kill -9: its processes end with it, and the next server removes what it left; what lives is left alone"""
    living = Server(program, directory).enter()
    living.job(QUICK)
    killed_one = Server(program, directory).enter()
    killed_one.json("POST", "/api/jobs", SLOW)
    time.sleep(0.3)
    children = [pid for pid in processes(killed_one.process.pid) if pid != killed_one.process.pid]
    assert len(children) == 3 and len(scratch(directory)) == 2
    killed_one.stop(signal.SIGKILL)
    end = time.monotonic() + 3
    while any(os.path.exists(f"/proc/{pid}") and "Z" not in pathlib.Path(f"/proc/{pid}/stat").read_text().split(")")[1][:3]
              for pid in children):
        assert time.monotonic() < end, "a child lives on"
        time.sleep(0.05)
    assert len(scratch(directory)) == 2
    pathlib.Path(directory, "flexwright-serve-notes").mkdir()  # not ours: no lock in it
    with Server(program, directory):
        assert len(scratch(directory)) == 3
    assert len(scratch(directory)) == 2 and living.json("GET", "/api/jobs/1")["state"] == "done"
    living.stop()


def six(program, directory):
    """::1 only when asked for, with the same rules"""
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:
        print("  this machine has no ::1")
        return
    with Server(program, directory, options=["--ipv6"]) as server:
        server.enter()
        host = f"[::1]:{server.port}"
        head = f"GET /api/session HTTP/1.1\r\nHost: {host}\r\n"
        for headers, status in ((f"Cookie: {server.cookie}\r\n", 200), ("", 401),
                                (f"Cookie: {server.cookie}\r\nOrigin: http://{server.host}\r\n", 403)):
            with server.connect("::1") as s:
                s.sendall((head + headers + "\r\n").encode())
                assert s.recv(12).decode() == f"HTTP/1.1 {status}"


def in_a_terminal(program, directory, path, **display):
    """serve with this PATH and a display, :9 where none is named: its process, and the terminal's end of ours"""
    ours, theirs = os.openpty()
    display = display or {"DISPLAY": ":9"}
    others = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    run = subprocess.Popen([program, "serve"], stdout=theirs, stderr=theirs, stdin=theirs,
                           env={**others, **display, "TMPDIR": str(directory), "PATH": str(path)})
    os.close(theirs)
    return run, ours


def until(found):
    end = time.monotonic() + 10
    while not found():
        assert time.monotonic() < end
        time.sleep(0.02)


def browser(program, directory):
    """in a terminal with a display the browser is tried; one that is not there, or is no program, ends nothing"""
    directory = pathlib.Path(directory)
    (path := directory / "bin").mkdir()
    said, opener = directory / "said", path / "xdg-open"
    for mode in (None, 0o600, 0o700):
        if mode:
            opener.write_text(f'#!/bin/sh\necho "$# $1" >{said}.new\n/bin/cat "$1" >>{said}.new\n/bin/mv {said}.new {said}\n')
            opener.chmod(mode)
        run, ours = in_a_terminal(program, directory, path)
        text = os.read(ours, 1000)
        if mode == 0o700:
            until(said.exists)
        else:
            while b"FW-D285" not in text:
                text += os.read(ours, 1000)
            assert not said.exists()
        assert run.poll() is None and text.startswith(b"http://127.0.0.1:"), text
        url = text.split()[0].decode()
        run.terminate()
        assert run.wait(timeout=5) == 0
        os.close(ours)
    words, page = said.read_text().split("\n", 1)
    assert words.startswith(f"1 {directory}/flexwright-serve-") and words.endswith("/open.html"), words
    said.unlink()
    for display, opens in (({"DISPLAY": ""}, False), ({"DISPLAY": "", "WAYLAND_DISPLAY": ""}, False), ({"WAYLAND_DISPLAY": "wayland-0"}, True)):
        run, ours = in_a_terminal(program, directory, path, **display)
        text = b""
        while text.count(b"\n") < 2:  # the address, and what is said of it
            text += os.read(ours, 1000)
        if opens:
            until(said.exists)
        run.terminate()
        assert run.wait(timeout=5) == 0 and b"FW-D285" not in text and said.exists() == opens, (display, text)
        os.close(ours)
    token = url.split("token=")[1]
    assert token in page and token not in words, "the address is for the browser, not for a list of processes"


def started_wrongly(program, directory):
    """a port that is taken, a file that is not there"""
    with Server(program, directory) as server:
        run = subprocess.run([program, "serve", "--no-browser", "--port", str(server.port)], capture_output=True, timeout=10,
                             check=False, env={**os.environ, "TMPDIR": str(directory)})
        assert run.returncode == 5 and b"FW-D284" in run.stderr and not run.stdout, run
    for arguments, status in ((["nowhere.xml"], 5), (["--port", "x"], 2), (["--port", "65536"], 2), (["a", "b"], 2)):
        run = subprocess.run([program, "serve", "--no-browser", *arguments], capture_output=True, timeout=10, check=False,
                             env={**os.environ, "TMPDIR": str(directory)})
        assert run.returncode == status and run.stderr and not run.stdout, (arguments, run)
    assert not scratch(directory)


WAITING = [half_open, drip_alone, stopped]  # these do little but wait: beside the others
TESTS = [only_loopback, loaded, archive, jobs, kinds, counted, limits, crash, abandoned, given_up, file, lost_file, draft, beside, words,
         entry, streams, asked_while_it_ends, signals, killed, six, browser, started_wrongly]


def run(test, program):
    directory, began = tempfile.mkdtemp(), time.monotonic()
    try:
        test(program, directory)
        print(f"{test.__name__}: {time.monotonic() - began:.1f} s", flush=True)
        return 0
    except Exception as error:  # pylint: disable=broad-except
        print(f"{test.__name__} FAILED: {type(error).__name__}: {error}", flush=True)
        if "--trace" in sys.argv:
            raise
        return 1
    finally:
        shutil.rmtree(directory, ignore_errors=True)


def main():
    program, wanted = str(pathlib.Path(sys.argv[1]).resolve()), [a for a in sys.argv[2:] if not a.startswith("-")]
    chosen = [test for test in WAITING + TESTS if not wanted or test.__name__ in wanted]
    with concurrent.futures.ThreadPoolExecutor(len(WAITING)) as pool:
        early = [pool.submit(run, test, program) for test in chosen if test in WAITING]
        wrong = sum(run(test, program) for test in chosen if test in TESTS)
        wrong += sum(one.result() for one in early)
    return 1 if wrong or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
