#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Same inputs, same bytes: wherever, whenever and under whatever settings the program runs. Without FMA
units libm gives other last bits, so motion and verdict may differ there in the last printed digits;
masks and recipes may not."""
import os
import pathlib
import tempfile
import unittest

from common import GALLERY, run

PLAIN = {"PATH": os.environ["PATH"]}


class Reproducible(unittest.TestCase):
    def plan(self, where, **environment):
        out = pathlib.Path(where) / "out"
        directory = pathlib.Path(where) / "cwd"
        directory.mkdir()
        device = directory / "device.xml"
        device.write_text(GALLERY.read_text())
        result = run("plan", "device.xml", "--mask-format", "all", "-o", out, cwd=directory, env={**PLAIN, **environment})
        self.assertEqual(result.returncode, 0, result.stderr)
        return {p.relative_to(out).as_posix(): p.read_bytes() for p in sorted(out.rglob("*")) if p.is_file()}

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        base = pathlib.Path(self.temporary.name)
        (base / "a").mkdir()
        self.base = base
        self.first = self.plan(base / "a")

    def compare(self, name, only="", **environment):
        (self.base / name).mkdir()
        other = self.plan(self.base / name, **environment)
        self.assertEqual(set(self.first), set(other))
        for file, content in self.first.items():
            if file.startswith(only):
                self.assertTrue(content == other[file], f"{file} differs: {name}")

    def test_settings_of_the_user_do_not_matter(self):
        self.compare("again")
        self.compare("zone", TZ="Pacific/Auckland", HOME="/nonexistent")
        self.compare("language", LANG="de_DE.UTF-8", LC_ALL="de_DE.UTF-8", LC_NUMERIC="de_DE.UTF-8")
        self.compare("threads", OPENBLAS_NUM_THREADS="2", OMP_NUM_THREADS="2")

    def test_without_fma_masks_and_recipes_are_the_same(self):
        off = "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX512F"
        self.compare("plain", only="masks/", GLIBC_TUNABLES=off)
        self.compare("plain2", only="recipes/", GLIBC_TUNABLES=off)


if __name__ == "__main__":
    unittest.main()
