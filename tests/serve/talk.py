#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""talk.py PROGRAM [Talk.test_...]: a page's whole talk with the server, a second in all: every row of what it can be asked, what
comes back, and what is there afterwards. What means harm, load and kills are hostile.py, doors.py and robust.py."""
import contextlib
import hashlib
import http.client
import io
import json
import os
import pathlib
import re
import sqlite3
import sys
import tempfile
import time
import unittest
import zipfile

from client import ROOT, Server, processes

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
TEXT = re.sub(r"<require[^>]*/>", "", (ROOT / "tests/data/probes/gripper.xml").read_text(encoding="utf-8"))
QUICK = {"effects": "none", "corners": "none", "samples": 11}


class Talk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.place = pathlib.Path(cls.kept.name)
        cls.home = cls.place / "home"
        cls.home.mkdir()
        cls.file = cls.place / "jaws.xml"
        cls.file.write_text(TEXT, encoding="utf-8")
        os.chmod(cls.file, 0o640)
        cls.server = Server(PROGRAM, cls.place, cls.file, environment={"XDG_STATE_HOME": str(cls.home)}).enter()

    @classmethod
    def tearDownClass(cls):
        took = cls.server.stop()
        left = [p for p in cls.place.iterdir() if p.name.startswith("flexwright") or ".tmp-" in p.name]
        cls.kept.cleanup()
        if took > 5 or left or cls.server.process.returncode != 0:
            raise AssertionError((took, left, cls.server.process.returncode))

    def fails(self, status, method, path, body=None):
        got, headers, data = self.server.ask(method, path, body)
        self.assertEqual((got, headers["content-type"]), (status, "application/json"), (method, path, data[:200]))
        error = json.loads(data)["error"]
        self.assertTrue(error["message"])
        return error["message"]

    def begin(self, body):
        status, _, data = self.server.ask("POST", "/api/jobs", body)
        self.assertEqual(status, 202, data)
        return json.loads(data)["id"]

    def ends(self, number):
        for _ in range(600):
            job = self.server.json("GET", f"/api/jobs/{number}")
            if job["state"] not in ("queued", "running"):
                return job
            time.sleep(0.02)
        self.fail(job)

    def in_order(self, numbers):
        """of jobs that wait the one that was asked for first begins first, until all have ended"""
        states = {}
        while not all(states.get(n) in ("done", "failed", "cancelled") for n in numbers):
            # later ones are asked first: one that has begun since is no mistake
            states = {n: self.server.json("GET", f"/api/jobs/{n}")["state"] for n in reversed(numbers)}
            begun = [states[n] != "queued" for n in numbers]
            self.assertEqual(begun, sorted(begun, reverse=True), states)
            time.sleep(0.01)

    def test_session_and_page(self):
        session = self.server.json("GET", "/api/session")
        self.assertEqual((session["file"], session["token"]), ("jaws.xml", self.server.token))
        self.assertEqual(session["limits"], {"body_bytes": 1 << 20, "connections": 32, "streams": 4, "queued_jobs": 4, "preview_samples": 2001})
        status, headers, data = self.server.ask("GET", "/")
        if status == 404:  # built without the page
            return
        self.assertEqual((status, len(data)), (200, int(headers["content-length"])))
        self.assertIn("text/html", headers["content-type"])
        again = self.server.ask("GET", "/", headers={"If-None-Match": headers["etag"]})
        self.assertEqual((again[0], again[2]), (304, b""))
        self.assertEqual(self.server.ask("GET", "/", headers={"If-None-Match": '"other"'})[2], data)

    def test_what_is_not_there(self):
        for status, method, path in ((404, "GET", "/api/nothing"), (405, "PUT", "/api/file"), (405, "DELETE", "/api/session"), (404, "GET", "/api/jobs/999"),
                                     (404, "DELETE", "/api/jobs/999"), (404, "GET", "/api/jobs/x"), (404, "GET", "/api/jobs/0000000001"),
                                     (404, "GET", "/api/beside/none.log")):
            self.fails(status, method, path)
        self.assertEqual(self.server.ask("POST", "/api/file", b"{}", {"Content-Type": "text/plain"})[0], 415)
        self.assertEqual(self.server.ask("POST", "/api/file", b"", {"Content-Length": str((1 << 20) + 1)})[0], 413)
        for path in ("/api/file", "/api/draft", "/api/jobs", "/api/preview", "/api/picture", "/api/pose", "/api/edit", "/api/explore"):
            self.fails(400, "POST", path, b"[1, 2")

    def test_the_file(self):
        """saved whole with its permissions, refused where it is another, and its change is an event"""
        stream = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=5)
        stream.request("GET", "/api/events", headers={"Host": self.server.host, "Cookie": self.server.cookie})
        events = stream.getresponse()
        self.assertEqual(events.getheader("content-type"), "text/event-stream")
        def said(version):
            for _ in range(50):
                line = events.readline().decode()
                if version in line:
                    return line
            return self.fail(version)
        first = self.server.json("GET", "/api/file")
        self.assertEqual((first["name"], first["text"], first["writable"]), ("jaws.xml", TEXT, True))
        self.assertEqual(first["version"], hashlib.sha256(TEXT.encode()).hexdigest())
        said(first["version"])
        other = TEXT + "<!-- \u00e4 -->\n"
        now = self.server.json("POST", "/api/file", {"text": other, "version": first["version"]})
        self.assertEqual(now["version"], hashlib.sha256(other.encode()).hexdigest())
        self.assertEqual(self.file.read_text(encoding="utf-8"), other)
        self.assertEqual(self.file.stat().st_mode & 0o777, 0o640)
        stale = self.server.json("POST", "/api/file", {"text": TEXT, "version": first["version"]}, expect=(409,))
        self.assertEqual((stale["text"], stale["version"]), (other, now["version"]))
        self.assertEqual(self.file.read_text(encoding="utf-8"), other)
        self.file.write_text(TEXT, encoding="utf-8")  # by an editor
        said(first["version"])
        stream.close()
        self.file.write_bytes(b"\xff<device/>")
        self.fails(422, "GET", "/api/file")
        self.file.unlink()
        self.fails(404, "GET", "/api/file")
        self.file.write_text(TEXT, encoding="utf-8")

    def test_streams(self):
        """four pages listen, a fifth is told so, and may where one has gone"""
        def listen():
            one = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=5)
            one.request("GET", "/api/events", headers={"Host": self.server.host, "Cookie": self.server.cookie})
            return one, one.getresponse().status
        for _ in range(100):  # that of another case may still be going
            streams = [listen() for _ in range(4)]
            if [s for _, s in streams] == [200] * 4:
                break
            for one, _ in streams:
                one.close()
            time.sleep(0.05)
        self.assertEqual([s for _, s in streams], [200] * 4)
        self.fails(429, "GET", "/api/events")
        for one, _ in streams:
            one.close()
        for _ in range(100):
            one, status = listen()
            one.close()
            if status == 200:
                return
            time.sleep(0.05)
        self.fail("no place becomes free")

    def test_a_draft(self):
        empty = {"schema": "flexwright.draft/1", "text": None, "version": None}
        self.assertEqual(self.server.json("GET", "/api/draft"), empty)
        draft = {"text": "<device \u00e9", "version": "7"}
        self.assertEqual(self.server.json("POST", "/api/draft", draft), {"kept": True})
        self.assertEqual(self.server.json("GET", "/api/draft"), {**empty, **draft})
        for wrong in ({"text": "a"}, {"text": 1, "version": "7"}, {**draft, "more": 1}):
            self.fails(400, "POST", "/api/draft", wrong)
        self.assertEqual(self.server.json("GET", "/api/draft"), {**empty, **draft})
        self.assertEqual(self.server.json("DELETE", "/api/draft"), {"kept": False})
        self.assertEqual(self.server.json("GET", "/api/draft"), empty)

    def test_what_lies_beside(self):
        log = "flexwright as-run 1\tflow=al-masked-rie\tplan=" + 64 * "0" + "\tlot=L7\twafers=1\n"
        (self.place / "lot7.log").write_text(log)
        (self.place / "note.log").write_text("nothing of ours\n")
        (self.place / "other.txt").write_text("x")
        study = self.place / "out/widths"
        study.mkdir(parents=True)
        (study / "study.sqlite").write_bytes(b"")
        found = self.server.json("GET", "/api/beside")
        self.assertEqual(found["studies"], ["out/widths"])
        # whose they are: of what is no store nothing is known
        self.assertEqual(found["results"], [{"directory": "out/widths", "study": None, "kind": None, "device": None}])
        with contextlib.closing(sqlite3.connect(study / "study.sqlite")) as db, db:
            db.execute(f"PRAGMA application_id = {0x46775374}")
            db.execute("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT)")
            db.executemany("INSERT INTO study VALUES (?, ?)", [("study", "widths"), ("kind", "sweep"), ("device", "jaws")])
        found = self.server.json("GET", "/api/beside")
        self.assertEqual(found["results"], [{"directory": "out/widths", "study": "widths", "kind": "sweep", "device": "jaws"}])
        self.assertEqual((found["logs"], pathlib.Path(found["directory"]).resolve()), (["lot7.log"], self.place.resolve()))
        self.assertEqual(self.server.ask("GET", "/api/beside/lot7.log")[2], log.encode())
        for name in ("other.txt", "../jaws.xml", "jaws.xml", "note.log", "none.log"):
            self.assertIn(self.server.ask("GET", f"/api/beside/{name}")[0], (400, 404))

    def test_what_workers_compute(self):
        table = self.server.json("GET", "/api/table")
        self.assertEqual(table["schema"], "flexwright.table/1")
        preview = self.server.json("POST", "/api/preview", {"text": TEXT, "options": QUICK})
        self.assertEqual(preview["schema"], "flexwright.preview/1")
        picture = self.server.json("POST", "/api/picture", {"text": TEXT, "options": QUICK})
        self.assertEqual(picture["schema"], "flexwright.picture/1")
        self.assertEqual(picture["motion"]["q"], preview["motion"]["q"])
        pose = self.server.json("POST", "/api/pose", {"text": TEXT, "body": "left", "platform": {"x_m": 1e-6}})
        self.assertEqual(pose["schema"], "flexwright.pose/1")
        edit = self.server.json("POST", "/api/edit", {"text": TEXT, "changes": [{"path": "leaf", "value": "550 um"}]})
        self.assertEqual(edit["text"], TEXT.replace('"leaf" value="400 um"', '"leaf" value="550 um"'))
        self.assertIn("not known", self.fails(400, "POST", "/api/edit", {"text": TEXT, "change": []}))
        # they read and print nothing of the terminal's
        workers = [p for p in processes(self.server.process.pid) if p != self.server.process.pid]
        self.assertTrue(workers)
        for pid in workers:
            self.assertEqual([os.readlink(f"/proc/{pid}/fd/{fd}") for fd in (0, 1)], ["/dev/null"] * 2)

    def test_jobs(self):
        """one runs, four wait, a sixth is told so; those that are cancelled or forgotten are gone, and what one made is what the
        command makes"""
        slow = {"kind": "plan", "text": (ROOT / "docs/gallery/comb-stage/device.xml").read_text(encoding="utf-8")}
        first = self.begin(slow)
        waits = [self.begin({"kind": "statics", "text": TEXT, "options": {"scene": "close"}, "set": {"leaf": "390 um"}}) for _ in range(4)]
        self.assertEqual(waits, [first + i for i in range(1, 5)])
        while self.server.json("GET", f"/api/jobs/{first}")["state"] == "queued":
            time.sleep(0.01)
        message = None
        for _ in range(2):  # where the first has begun there is room for one more
            status, _, data = self.server.ask("POST", "/api/jobs", {"kind": "statics", "text": TEXT})
            if status == 202:
                waits.append(json.loads(data)["id"])
            else:
                message = (status, json.loads(data)["error"])
        if message:
            self.assertEqual((message[0], message[1]["code"]), (429, "FW-D287"))
        gone = self.server.json("DELETE", f"/api/jobs/{waits[1]}")
        self.assertEqual(gone, {"id": waits[1], "state": "cancelled"})
        self.assertEqual(self.server.json("GET", f"/api/jobs/{waits[1]}")["state"], "cancelled")
        running = self.server.json("DELETE", f"/api/jobs/{first}")
        self.assertIn(running["state"], ("cancelled", "done"))
        self.in_order([waits[0], *waits[2:]])
        done = self.ends(waits[0])
        self.assertEqual((done["state"], done["exit_status"], done["kind"]), ("done", 0, "statics"), done["messages"])
        self.assertTrue(0 < done["seconds"] < 30)
        self.assertEqual(done["result"]["schema"], "flexwright.statics/1")
        files = {f["path"]: f for f in done["files"]}
        self.assertEqual(list(files), sorted(files))
        self.assertLessEqual({"statics.json", "statics.svg"}, set(files))
        archive = zipfile.ZipFile(io.BytesIO(self.server.ask("GET", f"/api/jobs/{waits[0]}/archive")[2]))
        self.assertEqual(sorted(archive.namelist()), sorted(files))
        for name, file in files.items():
            status, headers, data = self.server.ask("GET", f"/api/jobs/{waits[0]}/files/{name}")
            self.assertEqual((status, headers["content-type"], len(data)), (200, file["type"], file["bytes"]))
            self.assertIn("sandbox", headers["content-security-policy"])
            self.assertEqual(archive.read(name), data)
        self.fails(400, "GET", f"/api/jobs/{waits[0]}/files/../statics.svg")
        self.fails(404, "GET", f"/api/jobs/{waits[0]}/files/statics")
        self.fails(404, "GET", f"/api/jobs/{waits[0]}/more")
        self.fails(404, "DELETE", f"/api/jobs/{waits[0]}/files/statics.svg")
        self.assertEqual(self.server.json("DELETE", f"/api/jobs/{waits[0]}"), {"id": waits[0], "state": "done"})
        self.fails(404, "GET", f"/api/jobs/{waits[0]}")
        self.assertEqual(self.server.json("DELETE", f"/api/jobs/{waits[0]}"), {"id": waits[0], "state": "gone"})
        for number in waits[2:]:
            self.assertEqual(self.ends(number)["state"], "done")

    def test_jobs_of_pages_that_are_gone(self):
        """a page that was loaded anew four times had begun four checks that nobody could end; what nobody has asked for ends when no page
        looks at it, and every page sees what waits"""
        slow = {"kind": "study", "text": (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text(encoding="utf-8").replace("</device>", """
<study name="many" kind="yield" samples="4000"><uncertain what="material/@thickness" mean="50 um" sd="0.5 um"/></study></device>"""), "options": {"study": "many"}}
        asked = self.begin(slow)
        mine = self.begin({"kind": "check", "text": TEXT, "automatic": True})
        listed = {j["id"]: j for j in self.server.json("GET", "/api/jobs")["jobs"]}
        self.assertEqual((listed[asked]["kind"], listed[asked]["study"], listed[asked]["automatic"]), ("study", "many", False))
        self.assertEqual((listed[mine]["kind"], listed[mine]["study"], listed[mine]["automatic"]), ("check", None, True))
        self.assertEqual(set(listed[mine]), {"id", "kind", "study", "of", "automatic", "state", "seconds", "stage"})
        self.assertEqual(list(listed), sorted(listed))
        # another page ends both
        for number in (asked, mine):
            self.server.json("DELETE", f"/api/jobs/{number}")
            states = {j["id"]: j["state"] for j in self.server.json("GET", "/api/jobs")["jobs"]}
            self.assertIn(states.get(number), ("cancelled", None))

    def test_jobs_that_are_wrong(self):
        self.assertIn("plan, check", self.fails(400, "POST", "/api/jobs", {"kind": "rm", "text": TEXT}))
        for body in ({"kind": "plan"}, {"kind": "plan", "text": TEXT, "options": {"output": "/x/y"}}, {"kind": "plan", "text": TEXT, "set": [1]},
                     {"kind": "plan", "text": TEXT, "set": {"a=b": "1"}}, {"kind": "plan", "text": TEXT, "options": {"lab": "/etc/passwd"}},
                     {"kind": "plan", "text": TEXT, "files": {"../a.xml": "x"}}, {"kind": "plan", "text": TEXT, "files": {"device.xml": 3}},
                     {"kind": "log", "text": TEXT, "options": {"run": "../x.log"}}, {"kind": "study", "text": TEXT, "resume": 12345},
                     {"kind": "study", "text": TEXT, "of": 7}, {"kind": "study", "text": TEXT, "of": "x" * 201},
                     {"kind": "study", "text": TEXT, "results": "../x"}, {"kind": "plan", "text": TEXT, "options": {"scene\x00": 1, "flow": "a" * 2001}}):
            self.fails(400, "POST", "/api/jobs", body)
        failed = self.ends(self.begin({"kind": "check", "text": "<device", "of": "what a page knows it by"}))
        self.assertEqual(failed["of"], "what a page knows it by")
        self.assertEqual((failed["state"], failed["exit_status"], failed["files"]), ("failed", 3, []))
        self.assertTrue(any("jaws.xml:1" in m for m in failed["messages"]), failed["messages"])


if __name__ == "__main__":
    unittest.main()
