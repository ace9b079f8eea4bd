#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Full disks, small memory, signals and kills: what was there before stays, or the new is complete."""
import hashlib
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from common import ALL, GALLERY, PROGRAM, run  # noqa: E402


STUDY = f"""<study xmlns="urn:flexwright:study:1" name="s" kind="sweep" points="sobol" samples="5" as="hinges" device="{GALLERY}">
  <vary what="arc" from="200 deg" to="250 deg"/>
  <respond name="U" value="governing.utilisation"/>
</study>
"""


def intact(out):
    """every file that the manifest lists is there with its hash, and no other"""
    manifest = json.loads((out / "manifest.json").read_text())
    listed = {o["name"]: o["sha256"] for o in manifest["outputs"]}
    found = {p.relative_to(out).as_posix() for p in out.rglob("*") if p.is_file()} - {"manifest.json"}
    return found == set(listed) and all(
        hashlib.sha256((out / n).read_bytes()).hexdigest() == h for n, h in listed.items())


class Faults(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)
        self.out = self.here / "out"

    def left_alone(self):
        self.assertEqual([p.name for p in self.here.iterdir()], ["out"])
        self.assertTrue(intact(self.out))

    def test_file_size_limit_at_many_sizes(self):
        self.assertEqual(run("plan", GALLERY, "-o", self.out).returncode, 0)
        before = (self.out / "manifest.json").read_bytes()
        largest = max(p.stat().st_size for p in self.out.rglob("*") if p.is_file())
        for i in range(0, 20, 1 if ALL else 3):
            limit = 1 + largest * i // 20
            result = run("plan", GALLERY, "-o", self.out, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (limit, limit)))
            self.assertEqual(result.returncode, 5, f"limit {limit}: {result.stderr}")
            self.assertIn("FW-D222", result.stderr)
            self.left_alone()
            self.assertEqual(before, (self.out / "manifest.json").read_bytes())

    def test_standard_output_full(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "check", GALLERY, "--json"], stdout=full,
                                    stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 5)
        self.assertIn("standard output", result.stderr)

    def test_closed_pipe(self):
        process = subprocess.Popen([PROGRAM, "simulate", GALLERY, "--samples", "100000", "--csv", "-"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.close()
        process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(timeout=60), 5)

    def test_read_only_target(self):
        if os.geteuid() == 0:
            self.skipTest("root writes everywhere")
        self.here.chmod(0o500)
        self.addCleanup(self.here.chmod, 0o700)
        self.assertEqual(run("plan", GALLERY, "-o", self.out).returncode, 5)

    def test_small_memory(self):
        """from far too little to enough: a clean end with 6, or the whole result; never a torn one"""
        statuses = set()
        for megabytes in [*range(20, 140, 6), *range(140, 420, 20)][::1 if ALL else 3]:
            size = megabytes << 20
            # one BLAS thread: OpenBLAS ends the process when it cannot start its threads, before main
            result = run("plan", GALLERY, "-o", self.out, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
            statuses.add(result.returncode)
            # 127: the loader could not map the libraries, so the program never ran
            self.assertIn(result.returncode, (0, 6, 127), f"{megabytes} MB: {result.stderr[-500:]}")
            if result.returncode != 0:
                self.assertFalse(self.out.exists())
            else:
                self.left_alone()
                break
        self.assertIn(0, statuses)

    def test_kill_at_random_instants(self):
        self.assertEqual(run("plan", GALLERY, "-o", self.out).returncode, 0)
        start = time.monotonic()
        run("plan", GALLERY, "-o", self.out)
        whole = time.monotonic() - start
        rng = random.Random(1)
        for _ in range(40 if ALL else 12):
            process = subprocess.Popen([PROGRAM, "plan", GALLERY, "-o", self.out],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(rng.random() * whole * 1.1)
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assertTrue(intact(self.out))
        self.assertEqual(run("plan", GALLERY, "-o", self.out).returncode, 0)
        self.left_alone()  # and the leftovers of the killed are gone

    def at_once(self, *arguments, runs=10):
        """exit statuses and messages of so many runs of a command that begin together"""
        processes = [subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                     for _ in range(runs)]
        said = [p.communicate(timeout=120)[1] for p in processes]
        return [p.returncode for p in processes], said

    def test_ten_plans_at_once(self):
        """into one directory: one result, whole, and nothing beside it"""
        status, said = self.at_once("plan", GALLERY, "-o", self.out)
        self.assertEqual(set(status), {0}, said)
        self.left_alone()

    def test_ten_studies_at_once(self):
        """one writes, the others say so; with --resume they wait for it, and find nothing left to do"""
        study = self.here / "s.xml"
        study.write_text(STUDY)
        status, said = self.at_once("study", study, "-o", self.out, "--jobs", "1")
        self.assertIn(0, status)
        self.assertLessEqual(set(status), {0, 3}, said)
        self.assertTrue(all("another process writes" in text for s, text in zip(status, said) if s == 3), said)
        alone = {p.name: p.read_bytes() for p in self.out.rglob("*") if p.is_file()}
        status, said = self.at_once("study", study, "-o", self.out, "--jobs", "1", "--resume")
        self.assertEqual(set(status), {0}, said)
        self.assertEqual(alone, {p.name: p.read_bytes() for p in self.out.rglob("*") if p.is_file()})

    def test_ten_entries_at_once(self):
        """each is in the log once, and their chain holds"""
        log = self.here / "lot.log"
        base = ["log", GALLERY, "--flow", "al-masked-rie", "--run", log]
        entry = "S18; start=2026-11-01T08:00; end=2026-11-01T10:05; by=AB; second=CD"
        begun = run(*base, "--lot", "L7", "--wafers", "12", "--entry", entry, "--instrument", "profilometer 2", "--wafer", "1")
        self.assertEqual(begun.returncode, 0, begun.stderr)
        processes = [subprocess.Popen([PROGRAM, *map(str, base), "--entry", entry, "--instrument", "profilometer 2", "--wafer", str(w)],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for w in range(2, 12)]
        said = [p.communicate(timeout=120)[1] for p in processes]
        self.assertEqual({p.returncode for p in processes}, {0}, said)
        self.assertEqual(log.read_text().count("S18"), 11)
        self.assertEqual(run(*base, "--report", self.here / "page.html").returncode, 0)

    def test_disks_of_their_own(self):
        """a full one and a read-only one: the earlier result stays, and what went wrong is said"""
        self.assertEqual(run("plan", GALLERY, "-o", self.out).returncode, 0)
        size = sum(p.stat().st_size for p in self.out.rglob("*") if p.is_file())
        disk = self.here / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={int(1.6 * size)}", "tmpfs", disk], capture_output=True, check=False)
        if mounted.returncode:
            self.skipTest("file systems cannot be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=False)
        study = self.here / "s.xml"
        study.write_text(STUDY)
        out = disk / "out"
        self.assertEqual(run("plan", GALLERY, "-o", out).returncode, 0)
        before = (out / "manifest.json").read_bytes()
        self.assertEqual(run("study", study, "-o", disk / "s", "--jobs", "1").returncode, 0)
        (disk / "filled").write_bytes(b"x" * max(os.statvfs(disk).f_bavail * os.statvfs(disk).f_bsize - 8192, 0))
        for arguments in (["plan", GALLERY, "-o", out], ["study", study, "-o", disk / "other", "--jobs", "1"],
                          ["study", study, "-o", disk / "s", "--jobs", "1"]):
            full = run(*arguments)
            self.assertEqual(full.returncode, 5, full.stderr)
            self.assertRegex(full.stderr, "No space left on device|disk is full")
        self.assertEqual(before, (out / "manifest.json").read_bytes())
        self.assertTrue(intact(out))
        self.assertTrue((disk / "s/study.html").exists())
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        for arguments in (["plan", GALLERY, "-o", out], ["study", study, "-o", disk / "s", "--jobs", "1"]):
            refused = run(*arguments)
            self.assertEqual(refused.returncode, 5, refused.stderr)
            self.assertRegex(refused.stderr, "[Rr]ead-only|readonly")
        self.assertTrue(intact(out))

    def test_interrupt(self):
        long_scene = self.here / "long.xml"
        # a load that never rests: what dies away is soon over however long the scene
        long_scene.write_text(GALLERY.read_text().replace('duration="10 ms"', 'duration="100 s"').replace(
            '<force on="CD" fx=', '<force on="CD" law="sine" frequency="2 kHz" fx='))
        for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            process = subprocess.Popen([PROGRAM, "plan", long_scene, "-o", self.out],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(0.3)  # reading and layout are over, the motion is not
            process.send_signal(number)
            asked = time.monotonic()
            self.assertEqual(process.wait(timeout=60), status)
            self.assertLess(time.monotonic() - asked, 20)
            self.assertEqual([p.name for p in self.here.iterdir()], ["long.xml"])


if __name__ == "__main__":
    unittest.main()
