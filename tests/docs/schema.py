#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""schema.py PROGRAM: the RELAX NG schemas of device files and of studies before the program.

Every device file of the source that the program takes is valid, and every study in a file of its own. Of values of one attribute for each of several dimensions:
none that the program takes is refused; of a number alone, with or without a unit, all that the program refuses are, but for
products of units, of which the schema looks at the symbols only. Of tests/bad what is refused by the form of a value is."""
import itertools
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = ROOT / "docs/reference/device.rng"
STUDIES = ROOT / "docs/reference/study.rng"
PROGRAM = sys.argv[1]
HEAD = '<device xmlns="urn:flexwright:device:1" name="d">'
PLACES = (  # an attribute for each dimension: length, angle, pressure, pure, force, duration, any
    '<flexure id="A" kind="leaf" length="%s" width="10 um"/>',
    '<flexure id="A" kind="csfh" radius="1 mm" width="10 um" angle="%s"/>',
    '<material ref="silicon-100" youngs-modulus="%s"/>',
    '<limits safety-factor="%s"/>',
    '<scene name="s" duration="1 ms"><force on="b" x="0 um" y="0 um" fx="%s" fy="0 N"/></scene>',
    '<scene name="s" duration="%s"/>',
    '<parameter name="p" value="%s"/>',
)
NUMBERS = ("360", ".5", "1e-3", "1.e3", " + 4 ", "3,5")
UNITS = ("", " um", "um", " mm", " deg", "rad", " Pa", " GPa", " N", " uN", " ms", "s", " %", " kg", " foo", " mum", " µm", " 1", " m^1", " m2", " m um", " 1/s")
EXPRESSIONS = ("p", "2*p", "2*p + 5 um", "min(2 um, 3 um)", "sqrt(4 um^2)", "(5 um)", "-(5 um)", "3 um, 4 um", "2 p", "p q", "2 um 3 um",
               "1 um + 2 um", "pi*1 deg", "1.711e-6 N m/rad", "20 mA/cm2", "2 N/(1 m)^2", "atan2(1, 2)", "max(1 um, abs(-2 um)/2)", "* 5 um", "5 um +",
               "", " ", "2^3", "2^-1", "5 N/mm2*1 um", "90 deg/2", "5 um.", "1 / 2", "1e3 nm - 1 um", "f(", "2 {sccm}", "5 um/2")
LONE = re.compile(r"[\s+-]*[0-9.,e-]+\s*[^\s+*/(),^-]*\s*$")  # "^" is an operator, too
PRODUCT = re.compile(r"[0-9]\s*([A-Za-z1]+\^?-?\d*)(\s+|\s*[/*.]\s*)[A-Za-z]")
# refused for the form: no unit, another dimension, an unknown unit, a comma, an empty value
FORM = {20, 21, 24, 25, 33}
NOT_FORM = {  # ... but where only the program knows what is wanted: laws in time, joints that turn or slide, settings, bounds of a parameter
    "driver-dimension-of-slider", "driver-dimension", "law-factor-dimension", "law-table-dimension", "set-wrong-dimension", "driver-without-unit",
    "law-table-unit", "set-wrong-unit", "unit-in-chain",
    "parameter-value-of-another-kind"}


def valid(files, schema=SCHEMA):
    """which of them are"""
    out = set()
    for some in (files[i:i + 400] for i in range(0, len(files), 400)):
        done = subprocess.run(["xmllint", "--nonet", "--noout", "--relaxng", schema, *some], capture_output=True, text=True, errors="replace", check=False)
        if "internal error" in done.stderr.lower():
            sys.exit(done.stderr[-500:])
        out |= {pathlib.Path(m) for m in re.findall(r"^(.*) validates$", done.stderr, re.M)}
    return out


def codes(file):
    done = subprocess.run([PROGRAM, "check", file, "--corners", "none", "--advice", "none", "--json"], capture_output=True, text=True, check=False)
    return {int(n) for n in re.findall(r"FW-D(\d+)", done.stdout + done.stderr)}


def main():
    if not shutil.which("xmllint"):
        print("SKIPPED: xmllint is not installed (Debian: apt-get install libxml2-utils)")
        return 77
    wrong, counts = [], [0, 0, 0]
    known = [p for top in ("docs", "tests/data", "tests/studies") for p in sorted((ROOT / top).rglob("*.xml"))
             if 'xmlns="urn:flexwright:device:1"' in p.read_text(encoding="utf-8", errors="replace")[:8000]]
    good = valid(known)
    wrong += ["%s is refused" % p.relative_to(ROOT) for p in known if p not in good]
    studies = [p for top in ("docs", "tests/data", "tests/studies") for p in sorted((ROOT / top).rglob("*.xml"))
               if re.search(r'<study [^>]*xmlns="urn:flexwright:study:1"', p.read_text(encoding="utf-8", errors="replace"))]
    good = valid(studies, STUDIES)
    wrong += ["%s is refused" % p.relative_to(ROOT) for p in studies if p not in good]
    bad = sorted((ROOT / "tests/bad").glob("*.xml"))
    good = valid(bad)
    for file in bad:
        said = {int(n) for n in re.findall(r"FW-D(\d+)", file.with_suffix(".expect").read_text(encoding="utf-8"))}
        if said & FORM and file.stem not in NOT_FORM:
            counts[0] += 1
            if file in good:
                wrong.append("%s is accepted" % file.name)
    with tempfile.TemporaryDirectory() as where:
        files = []
        lone = ["".join(v) for v in itertools.product(NUMBERS, UNITS)]
        for k, place in enumerate(PLACES):
            for i, value in enumerate(lone + list(EXPRESSIONS)):
                if k and i % 7 != k % 7:  # of other dimensions some
                    continue
                file = pathlib.Path(where, "%d-%d.xml" % (k, i))
                file.write_text(HEAD + ('<parameter name="%s" value="2 um"/>' % ("q" if k == 6 else "p")) + place % value + "</device>", encoding="utf-8")
                files.append((file, value))
        good = valid([f for f, _ in files])
        for file, value in files:
            refused = codes(file) & set(range(20, 40))
            counts[1 + bool(refused)] += 1
            if not refused and file not in good:
                wrong.append("%s: the schema refuses '%s'" % (file.name, value))
            if refused & FORM and file in good and LONE.match(value) and not PRODUCT.search(value):
                wrong.append("%s: the schema takes '%s', %s" % (file.name, value, refused))
    print("%d device files; %d studies; %d of tests/bad; values: %d that the program takes, %d that it does not; %d wrong"
          % (len(known), len(studies), counts[0], counts[1], counts[2], len(wrong)))
    print("\n".join(wrong[:40]))
    return 0 if not wrong and len(studies) > 8 and counts[0] > 8 and min(counts[1:]) > 40 else 1


if __name__ == "__main__":
    sys.exit(main())
