#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""nets.py PROGRAM: masks of random comb stages in every flow with an insulating carrier, pads probed or led to the edge: KLayout's net
extractor finds in the written polygons what the certificate says (kl_nets.py). 77: there is no KLayout."""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

import kl_asked

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PROGRAM = sys.argv[1]
CASES = 24 if os.environ.get("FW_TEST_ALL") else 5
FLOWS = ("al-masked-rie", "soi-deep-rie")


def variant(text, lot, flow):
    """other fingers, gaps and places of both drives; each pad probed or at the edge"""
    def drive(match):
        words = match.group(0)
        sign = -1 if 'y="-' in words else 1
        for name, value in (("y", f"{sign * lot.uniform(0.36, 0.48):.3f} mm"), ("fingers", lot.randint(4, 15)),
                            ("gap", f"{lot.uniform(6, 14):.2f} um"), ("overlap", f"{lot.uniform(20, 60):.1f} um")):
            words = re.sub(rf' {name}="[^"]*"', f' {name}="{value}"', words)
        if lot.random() < 0.7:  # the pad of the other one is shut in by the mechanism
            words = words.replace('id="upper"', 'id="upper" pad="edge"')
        return words
    text = re.sub(r"<comb-drive[^>]*>", drive, text)
    text = re.sub(r'<parameter name="volts" value="[^"]*"', f'<parameter name="volts" value="{lot.uniform(5, 40):.1f} V"', text)
    return re.sub(r'<flow ref="[^"]*"', f'<flow ref="{flow}"', text)


def main():
    if not shutil.which("klayout"):
        return 77
    source = (ROOT / "docs/gallery/comb-stage/device.xml").read_text()
    lot, edges, bad, made, jobs, names = random.Random(20261123), 0, 0, 0, [], []
    with tempfile.TemporaryDirectory() as work:
        for k in range(CASES):
            flow = FLOWS[k % len(FLOWS)]
            device, out = pathlib.Path(work, f"{k}.xml"), pathlib.Path(work, str(k))
            device.write_text(variant(source, lot, flow))
            run = subprocess.run([PROGRAM, "mask", str(device), "-q", "--force", "-o", str(out)], capture_output=True, text=True,
                                 cwd=ROOT, check=False)
            stem = out / "masks" / flow
            if not stem.with_suffix(".gds").exists():
                print(f"case {k}: no mask:\n{run.stderr}")
                bad += 1
                continue
            made += 1
            certificate = stem.with_suffix(".json")
            edges += '"contact": "edge"' in certificate.read_text()
            jobs.append({"script": str(HERE / "kl_nets.py"), "vars": {"f": f"{stem}.gds", "certificate": str(certificate), "layer": "1/0"}})
            names.append(f"case {k}, {flow}")
        traced, why = kl_asked.ask(jobs)
        if traced is None:
            print(why)
            return 1
        for name, (passed, output) in zip(names, traced):
            if not passed:
                print(f"{name}:\n{output}")
                bad += 1
    print(f"{made} masks, {edges} with tracks, {bad} wrong")
    return 1 if bad or not edges or edges == made else 0


if __name__ == "__main__":
    sys.exit(main())
