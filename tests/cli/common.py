# SPDX-License-Identifier: GPL-3.0-or-later
"""Running the program from tests."""
import os
import pathlib
import re
import resource
import subprocess
import sys
import unittest

ALL = bool(os.environ.get("FW_TEST_ALL"))  # ./test --all: the whole of what repeats, not its first part
# A test that takes seconds and passes hardly a branch of the program that others do not (branches counted test by test with
# FW_EDGES_TO, tests/edges): what it says of figures another test says too, or says of fewer devices
only_all = unittest.skipUnless(ALL, "with ./test --all")
ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs/gallery/reference-six-bar/device.xml"
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
GRIPPER = ROOT / "docs/gallery/free-form-gripper/device.xml"
FLOWS = ("al-masked-rie", "copper-on-porous-silicon")


def run(*arguments, **options):
    """ends after 240 s of a processor, not of a clock: on a machine that is busy the same work has the same answer. What
    waits for ever is ended by the clock, after half an hour."""
    options.setdefault("cwd", ROOT)
    options.setdefault("preexec_fn", lambda: resource.setrlimit(resource.RLIMIT_CPU, (240, 250)))
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=1800, **options)


def device_for(flow):
    """the six-bar, whose silicon is made in that flow where it does not name it"""
    text = GALLERY.read_text()
    if flow in text:
        return text
    # holes, so that what etches from below is through within a working day
    return text.replace("al-masked-rie", flow).replace("<die ", '<die release-pitch="60 um" ')


def loose_gripper(pull="18 uN", copper_pull="1.8 uN"):
    """the gallery's gripper with nothing between its jaws, and nothing required of it"""
    text = re.sub(r'\s*<(probe|require|contact|parameter name="bead")\b[^>]*/>', "", GRIPPER.read_text())
    for name, value in (("pull", pull), ("copper_pull", copper_pull)):
        text = re.sub(rf'(<parameter name="{name}" value=)"[^"]*"', rf'\1"{value}"', text)
    return text.replace('"14 ms"', '"20 ms"')
