#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What commands say and draw, beside the gallery's: the terminal's text, the words of every page and picture, of every
picture what is drawn where, and the numbers and words of every JSON and CSV document. Each case is a small device and a command; what
it said is in tests/golden/said/CASE.txt, its figures in CASE.figures. A change that is wanted: FW_UPDATE=1 tests/golden/said.py PROGRAM,
and look at the difference.

    said.py PROGRAM [Said.test_CASE ...]

Pictures are kept as how many elements of each kind they have, their words, and a hash of what is drawn, to a tenth of a
pixel. Of documents each name of a field is a line, without the places in lists: how many numbers it has, their least and largest, their
mean and their mean weighed by place, so that one number that is another one, or in another place, is seen. Both are compared to 1e-5 of
the largest, and figures.py says how; that they are right is for the tests that compute them again, here they are what they were."""
import hashlib
import html
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from collections import Counter

import figures

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEPT = ROOT / "tests/golden/said"
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
VERSION = subprocess.run([str(PROGRAM), "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
QUICK = "--corners none --advice none --measurements none"
PADDLE = "tests/data/probes/gripper.xml"
CASES = {
    "statics_leaves": "statics docs/gallery/leaf-four-bar/device.xml -o OUT",
    "statics_gripper": f"statics {PADDLE} --scene close -o OUT",
    "statics_comb": "statics tests/data/effects/comb.xml -o OUT",
    "statics_crank": "statics docs/mechanisms/slider-crank.xml -o OUT",
    "statics_path": "statics docs/gallery/comb-stage/device.xml --path -o OUT",
    "modes_leaves": "modes docs/gallery/leaf-four-bar/device.xml -o OUT",
    "modes_crank": "modes docs/mechanisms/slider-crank.xml -o OUT",
    "assemble_toggle": "assemble docs/mechanisms/toggle.xml -o OUT",
    "assemble_squeezer": "assemble docs/mechanisms/squeezer.xml -o OUT",
    "assemble_hub": "assemble tests/data/figures/hub.xml -o OUT",
    "assemble_telescope": "assemble tests/data/figures/tele.xml -o OUT",
    "hinge_leaves": "hinge docs/gallery/leaf-four-bar/device.xml -o OUT",
    "hinge_paths": "hinge docs/gallery/free-form-four-bar/device.xml -o OUT",
    "simulate_guided": "simulate tests/data/figures/vm.xml --samples 201 -o OUT",
    "simulate_gripper": f"simulate {PADDLE} --samples 201 -o OUT",
    "simulate_comb": "simulate tests/data/effects/comb.xml --samples 201 -o OUT",
    "simulate_tendons": "simulate tests/data/effects/tendons.xml --samples 201 -o OUT",
    "simulate_film": "simulate tests/data/effects/closing-film.xml --samples 201 -o OUT",
    "check_gripper": f"check {PADDLE} --corners none --verbose",
    "check_stage": f"check docs/gallery/straight-stage/device.xml {QUICK} --verbose",
    "study_sweep": "study tests/data/said/sweep.xml --jobs 1 -o OUT",
    "study_line": "study tests/data/said/line.xml --jobs 1 -o OUT",
    "study_worst": "study tests/data/said/worst.xml --jobs 1 -o OUT",
    "study_survive": "study tests/data/said/survive.xml --jobs 1 -o OUT",
    "plan_gripper": f"plan {PADDLE} {QUICK} -o OUT",
    "plan_stage": f"plan docs/gallery/straight-stage/device.xml {QUICK} -o OUT",
    "plan_combs": f"plan docs/gallery/comb-stage/device.xml {QUICK} -o OUT",
    "plan_nodder": f"plan docs/gallery/copper-nodder/device.xml {QUICK} -o OUT",
    "plan_wafer": f"plan tests/data/wafer/leaf-wafer.xml {QUICK} -o OUT",
    "plan_thrown": f"plan tests/data/said/thrown.xml {QUICK} -o OUT",
    "plan_drying": "plan tests/data/said/drying.xml --lab tests/data/said/drying-lab.xml --corners none --measurements none -o OUT",
    "plan_slender": "plan tests/data/said/slender.xml --corners none --measurements none --verbose -o OUT",
    "plan_two_leaves": "plan tests/data/said/two-leaves.xml --lab tests/data/said/two-leaves-lab.xml --advice none --measurements all -o OUT",
    "check_tendons": "check tests/data/effects/tendons.xml --corners none --advice none --json",
    "check_leaf": "check tests/data/said/leaf.xml --json",
    "recipe_people": f"recipe tests/data/said/drying.xml {QUICK} --wafers 1 --operators 2 -o OUT "
                     "--day '08:00-12:00,13:00-18:00 from 2026-10-23 CET-1CEST,M3.5.0,M10.5.0/3'",
    "mask_formats": f"mask tests/data/said/drying.xml {QUICK} --mask-format all -o OUT",
    "mask_no_flow": "mask tests/data/said/leaf.xml -o OUT",
    "hinge_arcs": "hinge docs/gallery/reference-six-bar/device.xml --flow al-masked-rie -o OUT",
    "hinge_json": "hinge docs/gallery/leaf-four-bar/device.xml --json",
    "workspace_six": "workspace docs/gallery/reference-six-bar/device.xml --flow al-masked-rie --corners none -o OUT",
    "study_size": "study tests/data/said/size.xml --jobs 1 -o OUT",
    "study_limit": "study tests/data/said/limit.xml --jobs 1 -o OUT",
    "study_fitted": "study tests/data/said/fitted.xml --jobs 1 -o OUT",
    "study_front": "study tests/data/said/front.xml --jobs 1 -o OUT",
}
# kept byte for byte by gallery.sh, of other devices
GALLERY = re.compile(r"^masks/(?!.*\.outlines|.*-map)|^recipes/(?!.*\.(schedule|release))")
NUMBER = re.compile(r"-?\d+\.\d+(?:[eE][-+]?\d+)?")
BLOCK = re.compile(r"</?(?:p|h\d|tr|table|div|li|ul|section|figure|title|pre|summary|details|dt|dd|text|figcaption|caption)\b[^>]*>")


def rounded(match):
    text = f"{float(match.group()):.1f}"
    return "0.0" if text == "-0.0" else text


def words(markup):
    """lines of text, as a reader has them"""
    text = re.sub(r"<(script|style)\b.*?</\1>", "", markup, flags=re.S)
    text = html.unescape(re.sub(r"<[^>]*>", " ", BLOCK.sub("\n", text)))
    return [line for line in (" ".join(part.split()) for part in text.splitlines()) if line]


def drawn(picture):
    """kinds of elements, and what is drawn where"""
    kinds = Counter(re.findall(r"<([a-zA-Z]+)\b", picture))
    digest = hashlib.sha256(NUMBER.sub(rounded, picture).encode()).hexdigest()[:16]
    return f"picture {digest}: " + ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items()))


def reduced(path):
    text = path.read_text(encoding="utf-8")
    found, pictures = [], re.findall(r"<svg\b.*?</svg>(?!\s*<svg)", text, re.S) if path.suffix == ".html" else [text]
    rest = text
    for picture in pictures:
        found.append(drawn(picture))
        if path.suffix == ".html":
            rest = rest.replace(picture, "")
            found += ["  " + w for w in words(picture)[:400]]
    return found + words(rest)


def said(command, environment=None):
    """(all of it, its figures), without what the machine or the version is"""
    with tempfile.TemporaryDirectory() as place:
        out = pathlib.Path(place) / "out"
        argv = [str(PROGRAM), *shlex.split(command.replace("OUT", str(out))), "--color=never"]
        done = subprocess.run(argv, cwd=ROOT, capture_output=True, text=True, check=False, timeout=600, env=environment)
        lines = [f"$ flexwright {command}", f"exit {done.returncode}", *done.stderr.splitlines()]
        lines += [] if " --json" in command else done.stdout.splitlines()
        found = figures.of(out, done.stdout if " --json" in command else None)
        for path in sorted(out.rglob("*")):
            if path.suffix in (".svg", ".html") and not GALLERY.search(str(path.relative_to(out))):
                lines += [f"== {path.relative_to(out)}", *reduced(path)]
            elif path.suffix == ".html" and command.startswith("recipe"):
                lines += [f"== {path.relative_to(out)} {hashlib.sha256(chr(10).join(words(path.read_text(encoding='utf-8'))).encode()).hexdigest()[:16]}"]
            elif path.suffix in (".txt", ".ics", ".step", ".stl", ".oas", ".dxf") and "-coupons" not in path.name:
                # whole numbers of bytes and hashes are of files whose numbers may have other last digits
                text = re.sub(rb"\b[0-9a-f]{64}\b|-[0-9a-f]{16}\b|\d+ bytes", b"", path.read_bytes().replace(VERSION.encode(), b""))
                lines += [f"== {path.relative_to(out)} {hashlib.sha256(text).hexdigest()[:16]}"]
            elif path.suffix == ".png":
                lines += [f"== {path.relative_to(out)}"]
    text = "\n".join(line.rstrip() for line in lines) + "\n"
    text = re.sub(r"[\d.]+ [mun]?s of CPU", "TIME of CPU", text.replace(str(out), "OUT").replace(VERSION, "VERSION"))
    return re.sub(r" [\d.]+e-\d+(?=\n)", " TIME", text) if command.startswith("hinge") else text, found


class Said(unittest.TestCase):
    maxDiff = 4000

    def keeps(self, case):
        (now, numbers), kept = said(CASES[case]), KEPT / f"{case}.txt"
        if os.environ.get("FW_UPDATE"):
            kept.write_text(now, encoding="utf-8")
            others = [said(CASES[case], {**os.environ, **other})[1] for other in figures.ELSEWHERE]
            figures.write(kept.with_suffix(".figures"), numbers, others)
        wanted = "if that is wanted, FW_UPDATE=1 tests/golden/said.py PROGRAM"
        self.assertEqual(now, kept.read_text(encoding="utf-8"), f"{kept.relative_to(ROOT)}: {wanted}")
        self.assertEqual(figures.differ(kept.with_suffix(".figures"), numbers), [], wanted)

    def test_statics_leaves(self):
        self.keeps("statics_leaves")

    def test_statics_gripper(self):
        self.keeps("statics_gripper")

    def test_statics_comb(self):
        self.keeps("statics_comb")

    def test_statics_crank(self):
        self.keeps("statics_crank")

    def test_statics_path(self):
        self.keeps("statics_path")

    def test_modes_leaves(self):
        self.keeps("modes_leaves")

    def test_modes_crank(self):
        self.keeps("modes_crank")

    def test_assemble_toggle(self):
        self.keeps("assemble_toggle")

    def test_assemble_squeezer(self):
        self.keeps("assemble_squeezer")

    def test_assemble_hub(self):
        self.keeps("assemble_hub")

    def test_assemble_telescope(self):
        self.keeps("assemble_telescope")

    def test_hinge_leaves(self):
        self.keeps("hinge_leaves")

    def test_hinge_paths(self):
        self.keeps("hinge_paths")

    def test_simulate_guided(self):
        self.keeps("simulate_guided")

    def test_simulate_gripper(self):
        self.keeps("simulate_gripper")

    def test_simulate_comb(self):
        self.keeps("simulate_comb")

    def test_simulate_tendons(self):
        self.keeps("simulate_tendons")

    def test_simulate_film(self):
        self.keeps("simulate_film")

    def test_check_gripper(self):
        self.keeps("check_gripper")

    def test_check_stage(self):
        self.keeps("check_stage")

    def test_plan_gripper(self):
        self.keeps("plan_gripper")

    def test_plan_stage(self):
        self.keeps("plan_stage")

    def test_plan_combs(self):
        self.keeps("plan_combs")

    def test_plan_nodder(self):
        self.keeps("plan_nodder")

    def test_study_sweep(self):
        self.keeps("study_sweep")

    def test_study_line(self):
        self.keeps("study_line")

    def test_study_worst(self):
        self.keeps("study_worst")

    def test_study_survive(self):
        self.keeps("study_survive")

    def test_plan_wafer(self):
        self.keeps("plan_wafer")

    def test_plan_thrown(self):
        self.keeps("plan_thrown")

    def test_plan_drying(self):
        self.keeps("plan_drying")

    def test_plan_slender(self):
        self.keeps("plan_slender")

    def test_plan_two_leaves(self):
        self.keeps("plan_two_leaves")

    def test_check_tendons(self):
        self.keeps("check_tendons")

    def test_check_leaf(self):
        self.keeps("check_leaf")

    def test_recipe_people(self):
        self.keeps("recipe_people")

    def test_mask_formats(self):
        self.keeps("mask_formats")

    def test_mask_no_flow(self):
        """an accepted device that names no flow was called a rejected one"""
        self.keeps("mask_no_flow")

    def test_hinge_arcs(self):
        self.keeps("hinge_arcs")

    def test_hinge_json(self):
        self.keeps("hinge_json")

    def test_workspace_six(self):
        self.keeps("workspace_six")

    def test_study_size(self):
        self.keeps("study_size")

    def test_study_limit(self):
        self.keeps("study_limit")

    def test_study_fitted(self):
        self.keeps("study_fitted")

    def test_study_front(self):
        self.keeps("study_front")

    def test_every_case_is_kept(self):
        """and nothing else is"""
        for ending in ("txt", "figures"):
            self.assertEqual({p.stem for p in KEPT.glob("*." + ending)}, set(CASES))
        self.assertEqual({n.removeprefix("test_") for n in dir(self) if n.startswith("test_")} - {"every_case_is_kept"}, set(CASES))


if __name__ == "__main__":
    unittest.main()
