#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/limits.md says of how the program tells about a limit is what the program says: a row that names a diagnostic, or quotes
an output, has a device here that runs into the limit, and the answer contains what the row promises. Rows of which the page says that
the program does not tell are listed, too, so that a new row must be decided on.

    tests/docs/limits.py PROGRAM"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SIX, COMB, FREE = (f"docs/gallery/{name}/device.xml" for name in ("reference-six-bar", "comb-stage", "free-form-four-bar"))
LEAF, THEORY = "docs/gallery/leaf-four-bar/device.xml", "tests/data/theory"
PORTAL, CART, LEVER = f"{THEORY}/portal.xml", f"{THEORY}/cart.xml", f"{THEORY}/lever.xml"
REACH = ('x-min="-150 um" x-max="150 um" y-min="-60 um" y-max="60 um" phi-min="-2 deg" phi-max="2 deg"',
         'x-min="-1 um" x-max="1 um" y-min="0 um" y-max="225.5 um" phi-min="0 deg" phi-max="0.01 deg"')
LATCH = ('<comb-drive id="latch" kind="plate" on="stage" x="0.35 mm" direction="0 deg" gap="13 um" length="200 um" voltage="60 V" law="ramp" '
         'rise="5 ms"/><contact id="stop" a="stage" a-x="0.35 mm" a-face="0 deg" b="ground" b-x="1.26 mm" b-y="1.5 mm" side="outside" '
         'distance="0 um" stiffness="500 N/m" damping="1e-2 N s/m"/><air kind="slide" on="stage" gap="20 um"/>')

# beginning of a row: device, what is changed in it (None: nothing), command and options, what the answer must contain
CASES = {
    "Motion out of the plane": (f"{THEORY}/ring.xml", ("</scene>", '<gravity gz="-9.8 m/s^2"/></scene>'),
                                "check --corners none --advice none", "acts across the plane, and what the device does out of its plane is not known"),
    "Give of hinges whose axis": (f"{THEORY}/ring.xml", None, "simulate", r"foot stays a pin: the axis is not known"),
    "Poses that only flexures": ("tests/data/straight-legs.xml", None, "check --corners none --advice none",
                                 r"leg A-B-C lacks 2\.06 um, and its flexures may give by up to 485 um.*FW-D727"),
    "Payload, stiffness and ways": ("tests/data/straight-legs.xml",
                                    ("</device>", '<scene name="held" duration="1 us"><force on="CD" fy="1 uN"/></scene></device>'),
                                    "check --corners none --advice none", "without payload.*FW-D730"),
    "Solids as hinges": (f"{THEORY}/flexures.xml", None, "hinge --json", '"level": ?"continuum"|"level": "ends".*"strain": 0\\.011'),
    "What tips devices with guides": ("tests/data/effects/rubbing.xml", None, "check --corners none --advice none",
                                      r"out of the plane.*not known: joint slide is no flexure"),
    "Bending of links": (LEAF, None, "check --corners none --advice none --set body[crank]/@width=17um "
                         "--set body[coupler]/@width=17um --set body[rocker]/@width=17um", "FW-D510"),
    "Mass of flexures in motions": (f"{THEORY}/long-leaf.xml", None, "check --corners none --advice none", "FW-D725.*FW-D726|FW-D726.*FW-D725"),
    "Strength of bodies": (f"{THEORY}/neck.xml", None, "check --corners none --advice none",
                           r"neck: INCONCLUSIVE.*body arm is not known to bear what force brings.*where it is [67]"),
    "Notching at the foot": ("tests/data/swept-holes.xml", None, "check --corners none --advice none -v", "over-etch at the oxide may notch the foot of narrow lines"),
    "Flexures close to each other": ("docs/gallery/straight-stage/device.xml", None,
                                     "check --corners none --advice none --set flexure[leaf]/@length=1900um", r"1500 um apart, but their surfaces .*FW-D125"),
    "Paths with long straight pieces": ("tests/bad/path-ends-meet.xml", None, "check", "FW-D264"),
    "Corners and holes in": ("tests/bad/path-width-steps.xml", None, "check", "FW-D263"),
    "Bistables of curved beams": ("tests/data/snaps-late.xml", None, "statics --path --set push=1.6mN", "FW-D690"),
    "Drift along the axis of a path": (FREE, None, "hinge", r"FW-D265"),
    "Comparison with finite elements": (f"{THEORY}/flexures.xml", None, "hinge --json --set flexure[arc]/@width=2.2um", '"outside": true'),
    "Contact of what has no": (f"{THEORY}/flexures.xml", None,
                               "check --corners none --advice none --set flexure[arc]/@gap=1.2um --set flexure[arc]/@width=5um", "FW-D204"),
    "Friction that depends on speed": (CART, None, "statics --scene rub --json", "left out at rest: friction can hold in a range"),
    "Memory of films of air": (f"{THEORY}/lever.xml", ('gap="2 um" area="0.1 mm^2"', 'gap="300 um" area="0.1 mm^2"'),
                               "simulate --scene film", "outside its validity: gap over"),
    "Latches by pull-in": (COMB, ('<air kind="slide" on="stage" gap="20 um"/>', LATCH), "check --corners none --advice none",
                           "no electrodes touch in it, because it is over before.*or because a contact.*FW-D248"),
    "Temperature that varies": (PORTAL, None, "simulate --scene warm", r"the common expansion of 0\.00029 is scaled out"),
    "Breakdown of air at tips": (COMB, None, "recipe", "breaks down between 260 and 351 V"),
    "Stick and slip of cables": ("tests/data/theory/lever.xml", None, "statics --scene rubbed", "friction may hold it anywhere within this of the places above"),
    "Fringe fields of plates": (CART, None, "statics --scene plate", "may add up to 3.5 %"),
    "Etched gaps of combs": (COMB, None, "check", r"the gap of comb drive upper, drawn 10 um, is not known until"),
    "Pull-in of a voltage put on at once": (CART, ('voltage="20 V"', 'voltage="57 V"'), "simulate --scene plate",
                                            "this is dynamic pull-in.*FW-D242"),
    "Drawing of prismatic, distance": ("tests/data/effects/rubbing.xml", None, "mask --corners none --advice none", "prismatic joint slide at .* is not drawn.*FW-D130"),
    "Stops of hinges": ("tests/data/effects/rubbing.xml", ('hinge="A"/>', 'hinge="A" stop-max="9 deg" stop-stiffness="1 uN m/rad"/>'),
                        "mask --corners none --advice none", "stop of hinge hinge at .* is not drawn.*FW-D130"),
    "What drives a joint": ("docs/gallery/copper-nodder/device.xml",
                            ("</mechanism>", '<driver id="hand" joint="A" value="0.1 deg*t/(1 s)"/></mechanism>'),
                            "check --corners none --advice none", "from outside: driver hand moves and holds hinge A.*FW-D598"),
    "Peaks behind several blows": ("tests/data/between-joint-stops.xml", None, "check --corners none --advice none", "times as large.*FW-D685"),
    "Actuators that find no room": (COMB, ('x="0.43 mm" y="0.44 mm"', 'x="0.75 mm" y="0.1 mm"'), "mask", "FW-D131"),
    "Quasi-static motion with starting": (LEVER, None, "simulate --scene moving --effects none", "starts with velocities.*FW-D254"),
    "Proof of how much bounds": (LEVER, None, "simulate --scene weight", "weight: answer of the modes to it, put on at once"),
    "Bounds with slack tendons": (f"{THEORY}/stopped.xml", None, "simulate",
                                  r"inertia +yes +inf +- +kept: no bound holds while joint-stop may"),
    "The error of `--effects none`": (LEVER, None, "simulate --scene weight --effects none",
                                      r"gravity +no .*called for, but no effect was asked for"),
    "Load paths and contacts of more than 400": ("401", None, "statics --path", "load paths are followed for up to 400 bodies .this mechanism has 401.*FW-D599"),
    "Side branches of load paths": (f"{THEORY}/mast.xml", None, "statics --scene press --path", r"0\.5000000000 +bifurcation"),
    "Flat dyads with `minimal`": ("docs/mechanisms/toggle.xml", None, "simulate --method minimal", "use --method chain.*FW-D109"),
    "Shares of joints that repeat": (LEVER, ("<spring id", '<revolute id="again" a="ground" b="bar" b-y="-0.5 mm"/><spring id'),
                                     "assemble", "redundant here, because other joints already impose it: again"),
    "Certified workspace of anything": (COMB, None, "workspace", "FW-D217"),
    "What else holds": (SIX, ("</six-bar>", '</six-bar><mechanism><body id="R" x="1.5 mm" y="3.5 mm" mass="1 ug" inertia="1 ug mm^2"/>'
                        '<revolute id="r" a="CD" a-y="0.325 mm" b="R" b-y="-0.3 mm"/><spring id="S" a="ground" b="R" stiffness="1 N/m"/></mechanism>'),
                        "check --corners none --advice none", "FW-D646"),
    "Proof at stretched": (SIX, REACH, "workspace --flow al-masked-rie", "NOT PROVED.*FW-D218|FW-D218.*NOT PROVED"),
    "Scatter of lives": (LEAF, None, "check", r"limit by fracture.*typical: DelRio"),
    "Ranges that a pack does not know": (LEAF, None, "check", "0.99 to 1 is assumed, and the verdict holds there only"),
    "Motion and strain of bodies with release holes": (SIX, ('<die width="5.6 mm"', '<die release-pitch="30 um" width="5.6 mm"'),
                                               "mask --corners none --advice none", "no hole can be opened near.*FW-D189"),
    "Times of handling steps": (SIX, None, "recipe --flow al-masked-rie", r'class="tag assumed"'),
    "What the release reaches": (SIX, None, "recipe --flow copper-on-porous-silicon", "NOT COMPUTABLE, missing: "),
}
# the program says nothing, and the page says so
SILENT = ["Dimples below what moves", "What goes between the extremes of loads", "Ladders and rings in rings, as they dry", "Breaking tethers", "Faces and corners of contacts", "Stiffness of contacts", "Residual stress that varies", "Resistance of nets", "Bond wires and guides",
          "Tight bounds", "Drivers that shake as fast", "Pulses of an expression", "Peaks of joint forces at singular", "Differences within one device", "Resonances where a frequency goes", "What throws back, where arcs",
          "Bias that differs from place", "Polygons that others make of the arcs", "Safety instructions",
          "Leaves that bend out between", "What only the words of a pack",
          "Contacts and weight in the picture", "Studies on the page", "Browsers other than Chromium", "Wide kernels and FMA"]
# looked at by another test
ELSEWHERE = {"OASIS as cells": "tests/klayout/cells.py",
             "Contacts between walls that lean": "tests/cli/test_near_pull_in.py",
             "Openings between one's own outlines": "tests/unit/process/test_fixed_point.c",
             "Lettering and leaning walls": "tests/accept/step.py",
             "The full judgement while a slider": "tests/docs/json_keys.py",
             "How wafers of different lots": "tests/unit/process/test_wafers.c",
             "Water for rinsing": "tests/unit/recipe/test_recipe.c"}
problems = []


def chain(bodies):
    """a device of so many bars in a row"""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<device xmlns="urn:flexwright:device:1" name="many"><mechanism>']
    lines += [f'<body id="b{i}" mass="1 mg" inertia="1 mg mm^2" x="{i} mm" y="0 mm"/>' for i in range(bodies)]
    for i in range(bodies):
        before = f'a="b{i - 1}" a-x="0.5 mm"' if i else 'a="ground" a-x="-0.5 mm"'
        lines.append(f'<revolute id="j{i}" {before} b="b{i}" b-x="-0.5 mm" stiffness="1 uN m/rad"/>')
    lines.append(f'</mechanism><scene name="s" duration="1 ms"><force on="b{bodies - 1}" fy="1 uN"/></scene></device>')
    return "\n".join(lines)


def answer(row, here):
    device, change, command, _ = CASES[row]
    path = here / "device.xml"
    if device.isdigit():
        path.write_text(chain(int(device)), encoding="utf-8")
    else:
        text = (ROOT / device).read_text(encoding="utf-8")
        if change and text.count(change[0]) == 0:
            problems.append(f"{row}: {device} has no {change[0]}")
        path.write_text(text.replace(change[0], change[1], 1) if change else text, encoding="utf-8")
    verb, *options = command.split()
    options = [re.sub(r"=(\d[\d.]*)(\w+)$", r"=\1 \2", o) for o in options]
    if verb == "mask":
        options += ["-o", str(here / "out")]
    if verb == "recipe":
        options += ["-o", str(here / "run")]
    done = subprocess.run([PROGRAM, verb, path, *options], capture_output=True, text=True, cwd=ROOT, timeout=120, check=False)
    sheets = [p.read_text(encoding="utf-8") for p in (here / "run").rglob("*.html")]  # the status of a time stands there
    return done.stdout + done.stderr + "".join(sheets)


text = (ROOT / "docs/limits.md").read_text(encoding="utf-8")
rows = {}
for line in text.splitlines():
    cells = re.split(r" \| ", line.strip().strip("|").strip())
    if line.startswith("| ") and len(cells) == 4 and cells[0] != "what is left out":
        rows[cells[0]] = cells[2]
listed = [*CASES, *SILENT, *ELSEWHERE]
for row in rows:
    if sum(row.startswith(start) for start in listed) != 1:
        problems.append(f"this test does not know the row '{row}', or knows it twice")
with tempfile.TemporaryDirectory() as folder:
    for number, start in enumerate(listed):
        told = next((cell for row, cell in rows.items() if row.startswith(start)), None)
        if told is None:
            problems.append(f"docs/limits.md has no row '{start}'")
        elif start in SILENT and not told.startswith("It does not"):
            problems.append(f"'{start}': nobody has looked whether the program says: {told}")
        elif start in CASES:
            if told.startswith("It does not"):
                problems.append(f"'{start}': the page says that the program does not tell, and it does")
            for code in re.findall(r"FW-D\d+", CASES[start][3]):
                if code not in told:
                    problems.append(f"'{start}' does not name {code}")
            here = pathlib.Path(folder) / str(number)
            here.mkdir()
            said = answer(start, here)
            if not re.search(CASES[start][3], said, re.S):
                problems.append(f"'{start}': the program does not say {CASES[start][3]}:\n{said[:1500]}")
for start, path in ELSEWHERE.items():
    if not (ROOT / path).exists():
        problems.append(f"{path}, which is to look at '{start}', is not there")

print("\n".join(problems) or f"{len(rows)} limits: {len(CASES)} tried, {len(SILENT)} silent, {len(ELSEWHERE)} tried elsewhere")
sys.exit(1 if problems else 0)
