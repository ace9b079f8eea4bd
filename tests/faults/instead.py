#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pipes, sockets, devices and directories in place of every file that is read or written, for good or while the page is
open: refused with the name and the reason, never waited for.

    instead.py PROGRAM"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / part) for part in ("cli", "serve", "faults")]
from common import FLOWS, GALLERY, GRIPPER, PROGRAM, ROOT  # noqa: E402
from client import Server  # noqa: E402
from cases import COUPONS, SILICON  # noqa: E402

SECONDS = 30  # each of these takes well below one; beyond it waits for somebody who never comes


def pipe(path):
    os.mkfifo(path)


def a_socket(path):
    with socket.socket(socket.AF_UNIX) as made:
        where = os.getcwd()
        os.chdir(path.parent)  # its address has room for a short name
        made.bind(path.name)
        os.chdir(where)


def device(path):
    path.symlink_to("/dev/zero")


def directory(path):
    path.mkdir()


KINDS = {"pipe": pipe, "socket": a_socket, "device": device, "directory": directory}


class Instead(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)
        self.count = 0

    def run_it(self, *arguments, environment=None):
        self.count += 1
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.here, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=SECONDS, env={**os.environ, **(environment or {})})

    def each(self, arguments, name, status=(5,), environment=None, words=True):
        """with each kind in the place of the file `name`"""
        kept = self.here / name
        if kept.is_dir() and not kept.is_symlink():
            self.fail(name)
        before = kept.read_bytes() if kept.exists() else None
        for kind, make in KINDS.items():
            with self.subTest(name=name, kind=kind):
                if kept.exists():
                    kept.unlink()
                make(kept)
                listed = sorted(p.name for p in self.here.iterdir())
                result = self.run_it(*arguments, environment=environment)
                self.assertIn(result.returncode, status, result.stderr)
                self.assertIn(pathlib.Path(name).name, result.stderr)
                if words:
                    self.assertIn(kind, result.stderr)
                self.assertEqual(listed, sorted(p.name for p in self.here.iterdir()))
                kept.rmdir() if kind == "directory" else kept.unlink()
        if before is not None:
            kept.write_bytes(before)

    def test_inputs(self):
        shutil.copy(GALLERY, self.here / "device.xml")
        for command in ("check", "plan", "simulate", "hinge"):
            self.each([command, "device.xml", "-q"], "device.xml")
        (self.here / "lab.xml").write_text("")
        self.each(["recipe", "device.xml", "--lab", "lab.xml", "-o", "out"], "lab.xml")
        self.each(["mask", "device.xml", "--layers", "layers.txt", "-o", "out"], "layers.txt")
        self.each(["calibrate", "lot.csv", "--flow", SILICON], "lot.csv")
        log = ["log", "device.xml", "--flow", SILICON, "--run", "lot.log"]
        self.each(log, "lot.log")
        self.each([*log, "--entry", "S18; start=2026-11-01T08:00; end=2026-11-01T10:05; by=AB"], "lot.log", words=False)

    def test_packs_and_drawings(self):
        shutil.copy(GALLERY, self.here / "device.xml")
        for part in ("processes", "masks"):
            shutil.copytree(ROOT / part, self.here / part)
        data = {"FLEXWRIGHT_DATA": str(self.here)}
        for name in ("processes/base.xml", f"processes/{FLOWS[0]}.xml", f"masks/{FLOWS[0]}.xml"):
            self.each(["check", "device.xml"], name, environment=data)
        for source in GRIPPER.parent.iterdir():
            shutil.copy(source, self.here)
        drawing = next(self.here.glob("*.dxf"), None)
        if drawing:
            self.each(["check", "device.xml"], drawing.name, status=(3, 5))

    def test_places_of_results(self):
        """where a directory of results should stand, and its manifest"""
        shutil.copy(GALLERY, self.here / "device.xml")
        for kind in ("pipe", "socket", "device"):
            with self.subTest(kind=kind):
                KINDS[kind](self.here / "out")
                result = self.run_it("recipe", "device.xml", "-o", "out")
                self.assertEqual(result.returncode, 5, result.stderr)
                self.assertIn("out: error:", result.stderr)
                (self.here / "out").unlink()
        (self.here / "out").mkdir()
        for kind, make in KINDS.items():
            with self.subTest(manifest=kind):
                make(self.here / "out/manifest.json")
                result = self.run_it("recipe", "device.xml", "-o", "out")
                self.assertEqual(result.returncode, 5, result.stderr)
                self.assertIn("manifest.json", result.stderr)
                self.assertEqual([p.name for p in (self.here / "out").iterdir()], ["manifest.json"])
                (self.here / "out/manifest.json").rmdir() if kind == "directory" else (self.here / "out/manifest.json").unlink()

    def test_the_page(self):
        """the file that the page watches becomes something else: the server answers on, ends when it is told to, and what
        is saved does not replace what nobody has seen"""
        shutil.copy(GALLERY, self.here / "device.xml")
        for kind in ("pipe", "socket", "device"):
            with self.subTest(kind=kind):
                file = self.here / "device.xml"
                with Server(PROGRAM, self.here, file) as server:
                    server.enter()
                    text = file.read_text()
                    file.unlink()
                    KINDS[kind](file)
                    time.sleep(1.5)  # it looks once a second
                    self.assertEqual(server.ask("GET", "/api/session")[0], 200)
                    self.assertLess(server.stop(signal.SIGTERM), 10)
                file.unlink()
                file.write_text(text)
        for kind, make in KINDS.items():
            with self.subTest(started=kind):
                make(self.here / kind)
                result = self.run_it("serve", "--no-browser", kind)
                self.assertEqual(result.returncode, 5, result.stderr)
                self.assertIn(kind, result.stderr)


if __name__ == "__main__":
    unittest.main()
