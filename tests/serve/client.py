# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the server share: starting one, an honest client, and raw sockets for the others."""
import http.client
import json
import os
import pathlib
import re
import select
import signal
import socket
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEVICE = ROOT / "docs/gallery/reference-six-bar/device.xml"


def processes(of):
    """{pid: (parent, state, resident bytes)} of this process and all below it"""
    found, rows = [of], {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                stat = (entry / "stat").read_text()
            except OSError:
                continue
            fields = stat[stat.rindex(")") + 2:].split()
            rows[int(entry.name)] = (int(fields[1]), fields[0], int(fields[21]) * os.sysconf("SC_PAGE_SIZE"))
    for pid in found:
        found += [p for p, row in rows.items() if row[0] == pid and p not in found]
    return {pid: rows[pid] for pid in found if pid in rows}


class Server:
    """flexwright serve in a process; `with` ends it"""

    def __init__(self, program, directory, device=None, options=(), environment=None, patience=None):
        self.directory = pathlib.Path(directory)
        command = [str(pathlib.Path(program).resolve()), "serve", "--no-browser", *options]
        if device:
            command.append(str(device))
        self.errors = open(self.directory / "server.err", "wb")
        self.process = subprocess.Popen(command, cwd=directory, stdout=subprocess.PIPE, stderr=self.errors,
                                        env={**os.environ, "TMPDIR": str(self.directory), **(environment or {})})
        if patience and not select.select([self.process.stdout], [], [], patience)[0]:
            self.process.kill()
            self.process.wait()
        line = self.process.stdout.readline().decode() if self.process.poll() is None or not patience else ""
        found = re.match(r"http://(127\.0\.0\.1):(\d+)/\?token=([0-9a-f]{64})\n$", line)
        assert found, f"no address but {line!r}; {(self.directory / 'server.err').read_text()}"
        self.port, self.entry = int(found.group(2)), found.group(3)
        self.host = f"127.0.0.1:{self.port}"
        self.cookie = self.token = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self, how=signal.SIGTERM):
        """seconds that it took"""
        began = time.monotonic()
        if self.process.poll() is None:
            self.process.send_signal(how)
        self.process.wait(timeout=20)
        self.process.stdout.close()
        self.errors.close()
        return time.monotonic() - began

    def said(self):
        return (self.directory / "server.err").read_text()

    # ---- the honest client ----
    def enter(self):
        status, headers, said = self.ask("GET", f"/?token={self.entry}", cookie=False)
        assert status == 303 and headers["location"] == "/" and said == b"opening the page\n", (status, headers, said)
        self.cookie = headers["set-cookie"].split(";")[0]
        self.token = self.json("GET", "/api/session")["token"]
        return self

    def ask(self, method, path, body=None, headers=None, cookie=True, timeout=60):
        """status, headers (lower case), bytes"""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        all_headers = {"Host": self.host}
        if cookie and self.cookie:
            all_headers["Cookie"] = self.cookie
        if method != "GET" and self.token:
            all_headers["X-Flexwright-Token"] = self.token
            all_headers["Origin"] = f"http://{self.host}"
        if body is not None:
            all_headers["Content-Type"] = "application/json"
            body = body if isinstance(body, bytes) else json.dumps(body).encode()
        all_headers.update(headers or {})
        try:
            connection.request(method, path, body, all_headers)
            answer = connection.getresponse()
            return answer.status, {k.lower(): v for k, v in answer.getheaders()}, answer.read()
        finally:
            connection.close()

    def json(self, method, path, body=None, expect=(200, 202)):
        status, _, data = self.ask(method, path, body)
        assert status in expect, (method, path, status, data[:400])
        return json.loads(data)

    def job(self, body, timeout=120):
        """runs one to its end: its description"""
        number = self.json("POST", "/api/jobs", body)["id"]
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            job = self.json("GET", f"/api/jobs/{number}")
            if job["state"] not in ("queued", "running"):
                return job
            time.sleep(0.05)
        raise AssertionError(f"job {number} does not end: {job}")

    # ---- the others ----
    def connect(self, address="127.0.0.1"):
        return socket.create_connection((address, self.port), timeout=15)

    def raw(self, data, wait=3.0, half_close=False):
        """what comes back for these bytes, until the server closes or nothing comes for `wait` seconds"""
        with self.connect() as s:
            try:
                s.sendall(data)
                if half_close:
                    s.shutdown(socket.SHUT_WR)
            except OSError:
                pass
            got = b""
            s.settimeout(wait)
            try:
                while True:
                    part = s.recv(65536)
                    if not part:
                        break
                    got += part
                    if complete(got):
                        # anything that follows without being asked for would come at once
                        if not select.select([s], [], [], 0.05)[0]:
                            break
            except OSError:
                pass
            return got

    def events(self):
        return Events(self)


def complete(answer):
    head, mark, body = answer.partition(b"\r\n\r\n")
    length = re.search(rb"\r\ncontent-length: *(\d+)", head, re.I)
    return bool(mark) and bool(length) and len(body) >= int(length.group(1))


def statuses(answer):
    return [int(s) for s in re.findall(rb"HTTP/1\.[01] (\d{3})", answer)]


class Events:
    def __init__(self, server):
        self.socket = server.connect()
        self.socket.sendall(f"GET /api/events HTTP/1.1\r\nHost: {server.host}\r\nCookie: {server.cookie}\r\n\r\n".encode())
        self.text = ""

    def until(self, pattern, timeout=10):
        end = time.monotonic() + timeout
        while not (found := re.search(pattern, self.text, re.S)):
            left = end - time.monotonic()
            assert left > 0, f"no {pattern} in {self.text}"
            self.socket.settimeout(left)
            try:
                part = self.socket.recv(65536)
            except socket.timeout:
                continue
            assert part, f"the stream ended: {self.text}"
            self.text += part.decode()
        return found

    def close(self):
        self.socket.close()
