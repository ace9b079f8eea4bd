#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_tech.py PROGRAM [TO]: the technologies of tech/, one for each flow of masks/: layers and properties as the program writes them
beside a mask, and the rules as a DRC script. FLEXWRIGHT_DATA: a laboratory's own tables. tests/klayout compares."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "python"))
sys.dont_write_bytecode = True
from flexwright_klayout import rules  # noqa: E402

# any device will do: nothing of it is in what is written
DEVICE = """<device xmlns="urn:flexwright:device:1" name="any"><flow ref="%s"/>%s</device>"""


def body():
    here = HERE / "devices/reference-six-bar.xml"  # installed, else in the source
    text = (here if here.exists() else HERE.parent / "docs/gallery/reference-six-bar/device.xml").read_text(encoding="utf-8")
    rest = text[text.index("<parameter"):text.index("</device>")]
    lines = [line for line in rest.splitlines() if "<flow " not in line]
    return re.sub(r' flow="[^"]*"', "", "\n".join(lines))


def technologies(program, flows):
    """{path below tech/: text}"""
    files = {}
    for flow in flows:
        with tempfile.TemporaryDirectory() as where:
            device = pathlib.Path(where, "any.xml")
            device.write_text(DEVICE % (flow, body()), encoding="utf-8")
            done = subprocess.run([program, "mask", device, "--force", "--corners", "none", "--advice", "none", "--mask-format", "gds", "-q",
                                   "-o", pathlib.Path(where, "out")], capture_output=True, text=True, check=False)
            masks = pathlib.Path(where, "out/masks")
            if not (masks / (flow + ".json")).exists():
                sys.exit("%s: status %d\n%s" % (flow, done.returncode, done.stderr))
            certificate = json.loads((masks / (flow + ".json")).read_text(encoding="utf-8"))
            top = "flexwright-%s/" % flow
            for ending in (".lyt", ".lyp"):
                files[top + flow + ending] = (masks / (flow + ending)).read_text(encoding="utf-8").replace("REJECTED: ", "").replace("REJECTED ", "")
            files[top + "drc/" + flow + ".lydrc"] = rules.script(certificate)
    return files


def main():
    to = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else HERE / "tech"
    tables = pathlib.Path(os.environ.get("FLEXWRIGHT_DATA", HERE.parent)) / "masks"
    flows = sorted(p.stem for p in tables.glob("*.xml"))
    for name, text in technologies(sys.argv[1], flows).items():
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        (to / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
