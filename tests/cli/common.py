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

# a pure torque, which strains in proportion: as made at worst a tenth more than as drawn
TURNED_LEAF = """<device xmlns="urn:flexwright:device:1" name="turned-leaf"><parameter name="push" value="0.2 mN"/>
<material ref="silicon-100" thickness="50 um" youngs-modulus="169 GPa" strength="1 GPa"/><limits safety-factor="2"/><flow ref="al-masked-rie"/>
<die clearance="400 um"/><flexure id="leaf" kind="leaf" length="400 um" width="8 um" gap="12 um"/><mechanism>
<body id="arm" x="0 mm" y="0.75 mm" width="150 um"/>
<revolute id="A" a="ground" b="arm" b-y="-0.75 mm" hinge="leaf" damping="1e-8 N m s/rad" axis="0 deg"/></mechanism>
<scene name="turn" duration="200 ms"><torque on="arm" value="push*1 mm" law="ramp" rise="100 ms"/></scene></device>
"""
