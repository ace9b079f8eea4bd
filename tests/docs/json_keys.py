#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/reference/json.md explains every key that the program prints, in the section of its document; and what the
ledger's numbers are said to be holds: a fraction, null for what is not bounded, 0 for what is not called for."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
program = pathlib.Path(sys.argv[1]).resolve()
page = (ROOT / "docs/reference/json.md").read_text()
sections = {name: set(re.findall(r"`(\w+)`", text))
            for name, text in re.findall(r"^## ([^\n]+)\n(.*?)(?=^## |\Z)", page, re.M | re.S)}
# keys of these objects are ids of bodies and joints
BY_ID = {"q", "com", "v", "a", "before", "after", "shape", "damped_shape", "velocity", "acceleration", "revolute_N", "tie_N_Nm",
         "driver_N_or_Nm", "limit_rad", "boundary_share", "dq"}
SHARED = {"effects": "Effects: the ledger", "pull_in": "Pull-in", "hinge_model": "Hinge model", "measurements": "measurements",
          "wiring": "wiring"}
# pictures of docs/studies.md and docs/tutorial.md, drawn by their studies
PICTURES = {"width-and-arc": {"map-used.svg": "study-map.svg"},
            "which-matters": {"tornado-C.svg": "study-tornado.svg"},
            "which-of-six": {"tornado-used.svg": "study-six.svg"},
            "largest-workspace": {"design-1.svg": "study-workspace.svg"},
            "where-on-the-wafer": {"wafer-al-masked-rie.svg": "study-wafer.svg"}}
EFFECTS = len(re.findall(r"^FW_EFFECT(?:_ELEMENT)?\(\w+", (ROOT / "src/device/effects.def").read_text(), re.M))
problems, seen, documents = [], {}, 0

SIX = "docs/gallery/reference-six-bar/device.xml"
GRIPPER = "tests/data/probes/gripper.xml"
COMB = "docs/gallery/comb-stage/device.xml"
RUNS = (
    ("verdict", ["check", SIX]),
    ("verdict", ["check", SIX, "--set", "limits/@safety-factor=12"]),
    ("verdict", ["check", GRIPPER, "--measurements", "all"]),
    ("verdict", ["check", COMB, "--set", "volts=110 V", "--advice", "none"]),
    ("simulate", ["simulate", COMB]),
    ("simulate", ["simulate", "docs/mechanisms/slider-crank.xml"]),
    ("simulate", ["simulate", SIX, "--method", "minimal", "--effects", "all"]),
    ("verdict", ["check", GRIPPER]),
    ("verdict", ["check", GRIPPER, "--set", "pull=0.25 mN", "--advice", "none"]),
    ("simulate", ["simulate", GRIPPER]),
    ("statics", ["statics", GRIPPER]),
    ("modes", ["modes", GRIPPER]),
    ("statics", ["statics", COMB]),
    ("statics", ["statics", "docs/mechanisms/toggle.xml", "--path"]),
    ("statics", ["statics", "docs/mechanisms/slider-crank.xml"]),
    ("modes", ["modes", COMB]),
    ("assemble", ["assemble", "docs/mechanisms/squeezer.xml", "--rates", "1 rad/s"]),
    ("assemble", ["assemble", "docs/mechanisms/slider-crank.xml"]),
    ("hinge", ["hinge", SIX]),
    ("workspace", ["workspace", SIX]),
    ("recipe", ["recipe", COMB]),
    ("recipe", ["recipe", SIX]),
    ("mask", ["mask", COMB]),
    ("tradeoff", ["tradeoff", SIX, "--budget", "1"]),
)


def walk(value, section, shared=None):
    if isinstance(value, list):
        for item in value:
            walk(item, section, shared)
    elif isinstance(value, dict):
        for key, inner in value.items():
            known = sections[SHARED[shared] if shared else section] | {"schema", "recipes", "masks"}
            seen.setdefault(section, set()).add(key)
            if key not in known:
                problems.append(f"json.md does not explain {key} under '## {SHARED.get(shared, section)}'")
            if key not in BY_ID:
                walk(inner, section, key if key in SHARED else shared)


def ledger(document, what):
    for entry in document.get("effects", []):
        bound, cost = entry["bound"], entry["cost"]
        if not entry["called_for"] and (entry["active"] or bound != 0 or cost != 0):
            problems.append(f"{what}: {entry['id']} is not called for, and yet something")
        if bound is not None and "at most" in entry["reason"]:
            said = float(re.search(r"at most ([0-9.e+-]+) %", entry["reason"]).group(1))
            if abs(said - 100 * bound) > 0.006 * said + 1e-300:
                problems.append(f"{what}: {entry['id']} says {said} % for {bound}")
    if document.get("effects") and len({e["id"] for e in document["effects"]}) != EFFECTS:
        problems.append(f"{what}: not {EFFECTS} effects")


for section, command in RUNS:
    done = subprocess.run([program, *command, "--json"], cwd=ROOT, capture_output=True, text=True, timeout=240)
    if done.returncode not in (0, 1, 4):
        problems.append(f"{' '.join(command)}: status {done.returncode}\n{done.stderr}")
        continue
    document = json.loads(done.stdout)
    documents += 1
    if not document["schema"].startswith(f"flexwright.{section}"):
        problems.append(f"{' '.join(command)} prints {document['schema']}")
    walk(document, section)
    ledger(document, " ".join(command))
for command, status in ((["check", "tests/bad/flow-misspelt.xml"], 3), (["simulate", SIX, "--scene", "nix"], 3)):
    done = subprocess.run([program, *command, "--json"], cwd=ROOT, capture_output=True, text=True, timeout=60)
    document = json.loads(done.stdout)
    documents += 1
    walk(document, "diagnostics")
    for item in document["diagnostics"]:  # the same as on standard error
        if done.returncode != status or f"{item['severity']}: {item['message']} [{item['code']}]" not in done.stderr:
            problems.append(f"{' '.join(command)}: status {done.returncode}, {item}\n{done.stderr}")
    if not any(item["severity"] == "error" for item in document["diagnostics"]):
        problems.append(f"{' '.join(command)}: no error among its diagnostics")
with tempfile.TemporaryDirectory() as here:
    log = ["log", SIX, "--flow", "copper-on-porous-silicon", "--run", f"{here}/run.log"]
    for words in ("C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; copper bright in the mould=yes",
                  "C22; start=2026-11-20T10:30; end=2026-11-20T10:52; by=AB; second=CD; tool=p; bath=7; thickness=9; note=x"):
        first = [] if pathlib.Path(f"{here}/run.log").exists() else ["--lot", "7", "--wafers", "2"]
        subprocess.run([program, *log, *first, "--entry", words], cwd=ROOT, capture_output=True, timeout=240)
    for wafer, current in (("1", "20"), ("2", "30")):
        subprocess.run([program, *log, "--entry", "C22; start=2026-11-20T10:30; end=2026-11-20T10:52; by=AB; second=CD", "--wafer",
                        wafer, "--instrument", "p", "--site", "thickness=9 9 9.1 9 9 um", "--setting",
                        f"current density={current} mA/cm2", "--coupon",
                        "plating-pads, drawn=1 mm, value=9 um, u=0.1 um, at=25 C/cm2"], cwd=ROOT, capture_output=True, timeout=240)
    walk(json.loads(subprocess.run([program, *log, "--json"], cwd=ROOT, capture_output=True, timeout=240).stdout), "as-run")
    subprocess.run([program, "plan", COMB, "-q", "-o", f"{here}/o", "--set", "volts=49 V"], cwd=ROOT, capture_output=True,
                   timeout=240)
    walk(json.loads((pathlib.Path(here) / "o/manifest.json").read_text()), "manifest")
    subprocess.run([program, "workspace", SIX, "-q", "-o", f"{here}/s"], cwd=ROOT, capture_output=True, timeout=240)
    walk(json.loads((pathlib.Path(here) / "s/certificate.json").read_text()), "workspace-certificate")
    for plate in ("cavity", "pads", "device"):
        walk(json.loads((pathlib.Path(here) / f"o/masks/silicon-on-glass.{plate}.order.json").read_text()), "order")
    walk(json.loads((pathlib.Path(here) / "o/recipes/silicon-on-glass.sections.json").read_text()), "sections")
    walk(json.loads((pathlib.Path(here) / "o/recipes/silicon-on-glass.measurements.json").read_text()), "measurements")
    subprocess.run([program, "mask", "tests/data/wafer/leaf-wafer.xml", "-q", "-o", f"{here}/w"], cwd=ROOT, capture_output=True,
                   timeout=240)
    walk(json.loads((pathlib.Path(here) / "w/masks/al-masked-rie-wafer.json").read_text()), "wafer")
    walk(json.loads((pathlib.Path(here) / "w/masks/al-masked-rie-plate.order.json").read_text()), "written plate")

    names = ["width-and-arc", "worst-load", "widest-hinge", "how-many-survive", "which-matters"]
    if os.environ.get("FW_TEST_ALL") or os.environ.get("FW_UPDATE"):
        names += ["which-of-six", "largest-workspace", "where-on-the-wafer"]
    for name in names:
        form = (ROOT / f"docs/studies/{name}.xml").read_text().replace("../gallery", str(ROOT / "docs/gallery"))
        if not os.environ.get("FW_TEST_ALL") and not os.environ.get("FW_UPDATE"):  # keys need no more than a few devices
            form = form.replace('samples="300"', 'samples="200"').replace('as="made"', 'as="drawn" samples="12"')
            if 'kind="sensitivity"' in form:  # of one input
                first, *others = re.findall(r"<vary [^>]*/>", form)
                for other in others:
                    form = form.replace(other, "")
                form = form.replace('kind="sensitivity"', 'kind="sensitivity" samples="128"')
        (pathlib.Path(here) / f"{name}.xml").write_text(form)
        one = ["--study", name] if form.count("<study ") > 1 else []
        done = subprocess.run([program, "study", f"{here}/{name}.xml", "-q", "-o", f"{here}/{name}", "--flow", "al-masked-rie", *one],
                              cwd=ROOT, capture_output=True, text=True, timeout=900)
        if done.returncode:
            problems.append(f"docs/studies/{name}.xml: status {done.returncode}\n{done.stderr}")
            continue
        walk(json.loads((pathlib.Path(here) / name / "study.json").read_text()), "study")
        for picture in PICTURES.get(name, {}):
            drawn = (pathlib.Path(here) / name / "pictures" / picture).read_bytes()
            kept = ROOT / "docs/pictures" / PICTURES[name][picture]
            if os.environ.get("FW_UPDATE"):
                kept.write_bytes(drawn)
            elif not os.environ.get("FW_TEST_ALL") and 'samples="128"' in form:
                continue  # of fewer samples
            elif not kept.exists() or kept.read_bytes() != drawn:
                problems.append(f"docs/pictures/{kept.name} is not what docs/studies/{name}.xml draws; FW_UPDATE=1 renews it")

# documents of the page, and requests as they are explained
live = pathlib.Path(sys.argv[2]).resolve()
text = (ROOT / SIX).read_text()
LIVE = (
    ("table", None),
    ("preview", {"text": text, "set": {"arc": "230 deg"}, "options": {"samples": 5}}),
    ("preview", {"text": (ROOT / COMB).read_text(), "options": {"samples": 5, "detail": "full"}}),
    ("preview", {"text": text.replace("<flexure ", "<flexur ")}),
    ("preview", {"text": (ROOT / "docs/gallery/four-tendons/device.xml").read_text(), "options": {"samples": 2}}),
    ("preview", {"text": (ROOT / "docs/mechanisms/squeezer.xml").read_text(), "options": {"samples": 2}}),
    ("preview", {"text": (ROOT / "docs/mechanisms/slider-crank.xml").read_text(), "options": {"samples": 2}}),
    ("picture", {"text": text, "set": {"arc": "230 deg"}, "options": {"samples": 5}, "lab": {}}),
    ("picture", {"text": text.replace("<flexure ", "<flexur ")}),
    ("pose", {"text": text, "platform": {"x_m": 1e-4}}),
    ("pose", {"text": (ROOT / COMB).read_text(), "body": "stage", "platform": {"x_m": 1e-6, "phi_rad": 0.0}}),
    ("edit", {"text": text, "changes": [{"path": "arc", "value": "1 deg"}, {"add": "", "element": "flow", "attributes": {}},
                                        {"remove": "flow[3]"}]}),
    ("explore", {"text": text, "set": {"link": "130 um"}, "options": {"detail": "quick"}, "inputs": ["arc"], "values": ["governing.utilisation"],
                 "points": [["230 deg"], ["-1 deg"]]}),
)
for kind, request in LIVE:
    done = subprocess.run([live, kind], cwd=ROOT, input=json.dumps(request), capture_output=True, text=True, timeout=60)
    document = json.loads(done.stdout)
    documents += 1
    if done.returncode or document["schema"] != f"flexwright.{kind}/1":
        problems.append(f"live {kind}: status {done.returncode}, {done.stdout[:200]}")
    walk(document.pop("verdict", None), "verdict")
    walk(document.pop("effects", None), kind)  # names, not a ledger
    document.pop("hinge_model", None)  # a word here, an object elsewhere
    walk(document, "preview" if kind == "picture" else kind)  # the same members
    for key in request or {}:
        if key not in sections[kind]:
            problems.append(f"json.md does not explain {key} of the request '## {kind}'")

print("\n".join(dict.fromkeys(problems)) or f"{documents} documents, {sum(map(len, seen.values()))} keys explained")
sys.exit(1 if problems else 0)
