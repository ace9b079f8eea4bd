#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Requests that must not be served: each is a raw head (and body) that an attacker could send or make a browser send.
Beside each the reason; `defence` is what refuses it, and with that defence built out (tests/serve/mutants.py) the request
must get through, so that the test is known to see the defence.

    hostile.py PROGRAM [--only DEFENCE]   exit status 0: none served; 1: some were"""
import concurrent.futures
import json
import random
import sys
import tempfile

from client import DEVICE, Server, statuses

MIB = 1024 * 1024


def cases(s, other_cookie):
    """(name, defence or None, bytes)"""
    host, good = f"Host: {s.host}\r\n", f"Cookie: {s.cookie}\r\n"
    token = f"X-Flexwright-Token: {s.token}\r\n"
    kind = "Content-Type: application/json\r\n"
    name, secret = s.cookie.split("=")

    def get(path, *headers, version="HTTP/1.1", method="GET"):
        return f"{method} {path} {version}\r\n{''.join(headers)}\r\n".encode()

    def post(path, *headers, body='{"text": "<device/>", "kind": "check"}', length=None):
        text = body if isinstance(body, bytes) else body.encode()
        n = len(text) if length is None else length
        return f"POST {path} HTTP/1.1\r\n{''.join(headers)}Content-Length: {n}\r\n\r\n".encode() + text

    mine = (host, good)
    write = (host, good, token, kind)
    # ---- Host: another name that points here (DNS rebinding) ----
    for value in ("evil.example", f"evil.example:{s.port}", "127.0.0.1", f"127.0.0.1:{s.port + 1}", f"localhost:{s.port}",
                  f"127.0.0.1.evil.example:{s.port}", f"0.0.0.0:{s.port}", f"[::1]:{s.port}", f"2130706433:{s.port}",
                  f"127.1:{s.port}", f"127.0.0.1:{s.port}.", f"127.0.0.1:0{s.port}", f"user@127.0.0.1:{s.port}", ""):
        yield f"Host {value!r}", "HOST", get("/api/session", f"Host: {value}\r\n", good)
    yield "no Host", None, get("/api/session", good)
    yield "Host twice", None, get("/api/session", host, "Host: evil.example\r\n", good)
    yield "Host twice, the good one last", None, get("/api/session", "Host: evil.example\r\n", host, good)
    yield "rebound name asks for the page", "HOST", get("/", f"Host: evil.example:{s.port}\r\n", good)
    yield "rebound name posts", "HOST", post("/api/jobs", f"Host: evil.example:{s.port}\r\n", good, token, kind)
    # ---- Origin: a page elsewhere ----
    for value in ("http://evil.example", "null", f"https://{s.host}", f"http://{s.host}/", "http://127.0.0.1",
                  f"http://127.0.0.1:{s.port + 1}", f"http://localhost:{s.port}", f"http://{s.host}.evil.example", "",
                  f"http://[::1]:{s.port}"):
        yield f"Origin {value!r}", "ORIGIN", get("/api/session", *mine, f"Origin: {value}\r\n")
    yield "Origin twice", None, get("/api/session", *mine, f"Origin: http://{s.host}\r\n", "Origin: null\r\n")
    yield "post from another origin with all tokens", "ORIGIN", post("/api/jobs", *write, "Origin: http://evil.example\r\n")
    # ---- Sec-Fetch-Site ----
    for value in ("cross-site", "same-site", "Same-Origin", "", "same-origin, cross-site"):
        yield f"Sec-Fetch-Site {value!r}", "FETCH_SITE", get("/api/session", *mine, f"Sec-Fetch-Site: {value}\r\n")
    yield "form of a bookmark posts", "FETCH_SITE", post("/api/jobs", *write, "Sec-Fetch-Site: none\r\n")
    yield "picture of another page", "FETCH_SITE", get("/", *mine, "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Dest: image\r\n")
    # ---- the one-time token ----
    yield "token a second time", "ONE_TIME", get(f"/?token={s.entry}", host)
    yield "token of another server", None, get("/?token=" + "0" * 64, host)
    yield "empty token", None, get("/?token=", host)
    yield "token and something", None, get(f"/?token={s.entry}&x=1", host)
    yield "token in the path", None, get(f"/token={s.entry}", host)
    yield "token on another page", None, get(f"/api/session?token={s.entry}", host)
    # ---- the cookie ----
    yield "no cookie", "COOKIE", get("/api/session", host)
    yield "no cookie, the page", "COOKIE", get("/", host)
    yield "cookie of another session", "COOKIE", get("/api/session", host, f"Cookie: {other_cookie}\r\n")
    yield "secret of another session under our name", "COOKIE", get("/api/session", host,
                                                                     f"Cookie: {name}={other_cookie.split('=')[1]}\r\n")
    yield "half a cookie", "COOKIE", get("/api/session", host, f"Cookie: {name}={secret[:32]}\r\n")
    yield "cookie and more", "COOKIE", get("/api/session", host, f"Cookie: {name}={secret}0\r\n")
    yield "cookie in capitals", "COOKIE", get("/api/session", host, f"Cookie: {name}={'A' * 64}\r\n")
    yield "two cookies of our name", "COOKIE", get("/api/session", host, f"Cookie: {name}={'0' * 64}; {name}={secret}\r\n")
    yield "our secret under another name", "COOKIE", get("/api/session", host, f"Cookie: x{name}={secret}\r\n")
    yield "the header's token as cookie", "COOKIE", get("/api/session", host, f"Cookie: {name}={s.token}\r\n")
    yield "Cookie twice", None, get("/api/session", host, f"Cookie: {name}=x\r\n", good)
    # ---- the token in the header ----
    yield "post without the header", "HEADER_TOKEN", post("/api/jobs", *mine, kind)
    yield "post with a wrong header", "HEADER_TOKEN", post("/api/jobs", *mine, kind, f"X-Flexwright-Token: {'0' * 64}\r\n")
    yield "post with the cookie's secret", "HEADER_TOKEN", post("/api/jobs", *mine, kind, f"X-Flexwright-Token: {secret}\r\n")
    yield "delete without the header", None, get("/api/jobs/1", *mine, method="DELETE")
    yield "header twice", None, post("/api/jobs", *write, token)
    # ---- what a form of another page can send ----
    for value in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x", "text/json",
                  "application/json, text/plain", "application/jsonp", "application/json; charset=latin-1", ""):
        yield f"Content-Type {value!r}", "CONTENT_TYPE", post("/api/jobs", *mine, token, f"Content-Type: {value}\r\n")
    yield "no Content-Type", "CONTENT_TYPE", post("/api/jobs", *mine, token)
    # ---- sizes ----
    big = json.dumps({"kind": "check", "text": "x" * (MIB + 10)})
    yield "body of more than 1 MiB", "BODY", post("/api/jobs", *write, body=big)
    yield "body of 9 GB announced", None, post("/api/jobs", *write, length=9 * 10**9)
    for value in ("-1", "+5", "1e3", "0x10", "5 5", "", "99999999999999999999999999", "18446744073709551617", "2147483648"):
        yield f"Content-Length {value!r}", None, post("/api/jobs", *write, length=value)
    yield "two lengths", None, post("/api/jobs", *write, "Content-Length: 3\r\n")
    yield "no length", None, f"POST /api/jobs HTTP/1.1\r\n{''.join(write)}\r\n".encode()
    yield "head of 64 KiB", None, get("/api/session", *mine, "X: " + "a" * 65536 + "\r\n")
    yield "2000 headers", None, get("/api/session", *mine, *[f"X{i}: {'a' * 20}\r\n" for i in range(2000)])
    yield "path of 20 KiB", None, get("/" + "a" * 20000, *mine)
    yield "path of 600 letters", None, get("/api/" + "a" * 600, *mine)
    # ---- the body's framing ----
    chunks = b"5\r\n{\"a\":\r\n0\r\n\r\n"
    yield "chunked", None, f"POST /api/jobs HTTP/1.1\r\n{''.join(write)}Transfer-Encoding: chunked\r\n\r\n".encode() + chunks
    yield "chunked and a length", None, post("/api/jobs", *write, "Transfer-Encoding: chunked\r\n", body=chunks)
    yield "a blank behind the header's name", None, f"POST /api/jobs HTTP/1.1\r\n{''.join(write)}Transfer-Encoding : chunked\r\n\r\n".encode() + chunks
    yield "a blank behind the header's name, and a length", None, post("/api/jobs", *write, "Transfer-Encoding : chunked\r\n", body=chunks)
    yield "a blank behind a name that nobody knows", None, get("/api/session", *mine, "X-Y : z\r\n")
    yield "a name with a sign that may not stand in it", None, get("/api/session", *mine, "X(Y): z\r\n")
    yield "Transfer-Encoding identity", None, post("/api/jobs", *write, "Transfer-Encoding: identity\r\n")
    yield "Transfer-Encoding xchunked", None, post("/api/jobs", *write, "Transfer-Encoding: xchunked\r\n")
    yield "chunk of 2^64", None, (f"POST /api/jobs HTTP/1.1\r\n{''.join(write)}Transfer-Encoding: chunked\r\n\r\n"
                                  "FFFFFFFFFFFFFFFFF\r\nx").encode()
    yield "GET with a body", None, get("/api/session", *mine, "Content-Length: 5\r\n") + b"hello"
    yield "a request hidden behind a refused one", None, post("/api/jobs", *mine, body="") + get("/api/session", *mine)
    yield "a request hidden in a refused body", None, post("/api/jobs", *mine, kind, length=10) + get("/api/session", *mine)
    # ---- methods and request lines ----
    for method in ("HEAD", "OPTIONS", "TRACE", "PUT", "PATCH", "CONNECT", "PROPFIND", "get", "GETGET", "M-SEARCH"):
        yield f"method {method}", None, get("/api/session", *mine, method=method)
    yield "CONNECT elsewhere", None, get("evil.example:443", *mine, method="CONNECT")
    yield "absolute form elsewhere", None, get("http://evil.example/", *mine)
    yield "absolute form of ourselves", None, get(f"http://{s.host}/api/session", *mine)
    yield "asterisk form", None, get("*", *mine, method="OPTIONS")
    yield "HTTP/1.0", None, get("/api/session", *mine, version="HTTP/1.0")
    yield "HTTP/2.0", None, get("/api/session", *mine, version="HTTP/2.0")
    yield "HTTP/1.1x", None, get("/api/session", *mine, version="HTTP/1.1x")
    yield "HTTP/0.9", None, b"GET /api/session\r\n\r\n"
    yield "preface of HTTP/2", None, b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
    yield "TLS", None, bytes.fromhex("16030100a5010000a10303") + b"\0" * 160
    yield "only line ends", None, b"\r\n" * 200
    yield "no method", None, f" /api/session HTTP/1.1\r\n{host}{good}\r\n".encode()
    yield "WebSocket", None, get("/api/socket", *mine, "Upgrade: websocket\r\nConnection: Upgrade\r\n")
    yield "zero byte in the path", "HEAD", f"GET /api/session\0 HTTP/1.1\r\n{host}{good}\r\n".encode()
    yield "zero byte behind the host", "HEAD", get("/api/session", f"Host: {s.host}\0.evil.example\r\n", good)
    yield "zero byte behind the method", None, f"GET\0 /api/session HTTP/1.1\r\n{host}{good}\r\n".encode()
    yield "zero byte in a header's name", None, get("/api/session", *mine, "X\0Y: 1\r\n")
    yield "folded header", None, f"GET /api/session HTTP/1.1\r\nHost:\r\n {s.host}x\r\n{good}\r\n".encode()
    # ---- paths ----
    for path in ("/../etc/passwd", "/..%2f..%2fetc/passwd", "/%2e%2e/etc/passwd", "/%2e%2e%2fetc%2fpasswd", "//etc/passwd",
                 "/./page.css/../../../etc/passwd", "/page.css%00.html", "/%252e%252e/etc/passwd", "/..\\..\\etc\\passwd",
                 "/%c0%ae%c0%ae/etc/passwd", "/etc/passwd", "/proc/self/environ", "/api/../api/session/..", "/api/session/",
                 "/api//session", "/API/SESSION", "/api/session;x", "/api/session%20", "/api/jobs/1/files/../../lock",
                 "/api/jobs/1/files/%2e%2e/%2e%2e/lock", "/api/jobs/1/files//etc/passwd", "/api/jobs/1/files/etc/passwd",
                 "/api/jobs/-1", "/api/jobs/4294967297", "/api/jobs/1x", "/api/jobs/1/printed", "/api/jobs/0", "/api/jobs/"):
        yield f"path {path}", None, get(path, *mine)
    yield "encoded letter", None, get("/api/sessio%6e", *mine)
    yield "a query", None, get("/api/session?x", *mine)
    yield "a query without a question", None, get("/api/session?callback=alert", *mine)


def garbage(s, count):
    """requests of somebody who has no cookie, changed in random places: cut, doubled, other bytes"""
    dice = random.Random(20261121)
    whole = (f"POST /api/jobs HTTP/1.1\r\nHost: {s.host}\r\nCookie: flexwright-{s.port}={'a' * 64}\r\nContent-Type: "
             f"application/json\r\nX-Flexwright-Token: {'b' * 64}\r\nContent-Length: 20\r\n\r\n" + "{\"kind\": \"check\"}   ").encode()
    for _ in range(count):
        data = bytearray(whole)
        for _ in range(dice.randint(1, 6)):
            at, what = dice.randrange(len(data)), dice.randrange(4)
            if what == 0:
                data[at] = dice.choice(b"\0\r\n :;=/%?\xff\x80{0A")
            elif what == 1:
                del data[at:at + dice.randint(1, 30)]
            elif what == 2:
                data[at:at] = data[at:at + dice.randint(1, 60)]
            else:
                data[at:at] = bytes([dice.choice(b"\0\r\n :;,\t")]) * dice.randint(1, 40)
            if len(data) < 2:
                data = bytearray(whole)
        yield bytes(data)


def served(answer):
    """an answer that gives anything: 2xx, 3xx, or something that is no HTTP"""
    codes = statuses(answer)
    return any(code < 400 for code in codes) or (answer and not codes)


def main():
    program = sys.argv[1]
    only = sys.argv[sys.argv.index("--only") + 1] if "--only" in sys.argv else None
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
        with Server(program, two) as other, Server(program, one, device=DEVICE) as server:
            server.enter()
            other_cookie = other.enter().cookie
            server.job({"kind": "check", "text": DEVICE.read_text(), "options": {"accuracy": 0.05, "corners": "none"}})
            wrong, count, failed_with = [], 0, 0
            chosen = [case for case in cases(server, other_cookie) if not only or case[1] == only]
            with concurrent.futures.ThreadPoolExecutor(8) as pool:
                answers = list(pool.map(lambda case: server.raw(case[2], wait=6.0), chosen))
            for (name, _, _), answer in zip(chosen, answers):
                count += 1
                codes = statuses(answer)
                if served(answer):
                    wrong.append(f"{name}: {answer[:80]!r}")
                failed_with += any(code >= 500 and code != 505 and code != 501 for code in codes)
                assert server.process.poll() is None, f"{name} ended the server: {server.said()}"
            status, _, _ = server.ask("GET", "/api/session")
            said = server.said()
            if not only:
                with concurrent.futures.ThreadPoolExecutor(28) as pool:
                    for answer in pool.map(lambda data: server.raw(data, wait=6.0, half_close=True), garbage(server, 300)):
                        if served(answer):
                            wrong.append(f"garbage: {answer[:80]!r}")
            if server.ask("GET", "/api/jobs/2")[0] != 404:
                wrong.append("a hostile request began a job")
    print(*wrong, sep="\n")
    print(f"{count} hostile requests, {len(wrong)} served, {failed_with} answered with a fault; the honest one after them: {status}")
    if said:
        print("the server said:", said)
    return 1 if wrong or failed_with or status != 200 or said or (count < 60 and not only) or not count else 0


if __name__ == "__main__":
    sys.exit(main())
