#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""absurd.py LINT_PACKS: every quantity of every pack, and of the base pack, with values that nobody can mean: none, less than
none, a millionth and a million times. Each is refused or warned of, or stands in FINE with its reason. Without FW_TEST_ALL
each quantity has one of the four in turn."""
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKS = ("al-masked-rie", "copper-on-porous-silicon", "soi-deep-rie", "soi-double-sided", "silicon-on-glass")
TIMES = {"none": 0.0, "below none": -1.0, "a millionth": 1e-6, "a million": 1e6}
KINDS = tuple(TIMES)

# why nothing need be said: a pattern of ids, the values, the reason
EVEN = ("none", "a millionth")
FINE = [
    (r"litho\.edge|made\.wall|al\.stress", KINDS, "it lies on either side of none"),
    (r"rie\.bias", ("none", "below none", "a millionth"), "a chamber's bias is read with either sign, and is zero without a capacitor"),
    (r"(back|litho)\.gap", EVEN, "in contact there is no gap"),
    (r"(al|metal)\.overetch", EVEN, "a layer may be etched no longer than it takes"),
    (r"(rie|back)\.break|expose\.pause", EVEN, "it may be gone on with at once"),
    (r"(rie|drie)\.S|rie\.kappa", EVEN, "an etch may be as fast in a slot as in the open, and in a full chamber"),
    (r"(made|back)\.A", EVEN, "as much sideways as down: the verdict judges what is left of the device"),
    (r"(ps|pan)\.Ea", EVEN, "a rate may not depend on the temperature"),
    (r"chromium\.R-al|develop\.(al|R-porous)|rie\.R-(wax|glass)|descum\.R", EVEN, "it may be taken too slowly to be measured"),
    (r"thief\.area", EVEN, "there need be no thief"),
    (r"dry\.angle", EVEN, "a liquid that spreads has none"),
    (r"cu\.(limit|bath-fall)", EVEN, "a limit that is as tight as that is warned of as soon as the bath is known"),
    (r"(resist|wafer)\.type", EVEN, "a type is a name"),
    (r"al\.base|bond\.(gas|p)", EVEN, "what the best pumps leave"),
    (r"bond\.p", ("a million",), "silicon is bonded to glass in air as well"),
    (r"insulator\.resistivity", ("a millionth", "a million"), "oxides and glasses have 1e8 to 1e20 ohm cm"),
    (r"(pan\.T-warm|pan\.T-reference|cu\.bath-T|ps\.T|seed\.T|rie\.T)", ("a millionth",), "it is the freezing point of water, and no absurd temperature"),
]


def quantities(text):
    """(id, start, end) of every <q> that has a value, or has none yet, outside of comments and of materials,
    which are the device's as well"""
    hidden = re.sub(r"<!--.*?-->|<material id.*?</material>", lambda m: " " * len(m[0]), text, flags=re.S)
    for found in re.finditer(r"<q\s[^>]*?>", hidden):
        if 'status="derived"' not in found[0]:
            yield re.search(r'id="([^"]*)"', found[0])[1], found.start(), found.end()


def with_value(element, times):
    """the element with a value so many times its own, or so many of its unit where it has none"""
    value = re.search(r'\svalue="([^"]*)"', element)
    size = float(value[1]) if value else 1.0
    size = size if size else 1.0
    if 'unit="Cel"' in element and times <= 0:
        size, times = 1.0, -273.15 + 10 * times  # none of it is the absolute zero
    for gone in ("value", "u", "urel", "lo", "hi", "unknown"):
        element = re.sub(rf'\s{gone}="[^"]*"', "", element)
    return re.sub(r'(id="[^"]*")', rf'\1 value="{size * times!r}" u="0"', element, count=1)


def cases(text):
    for i, (name, start, end) in enumerate(quantities(text)):
        for k, (kind, times) in enumerate(TIMES.items()):
            if not os.environ.get("FW_TEST_ALL") and k != i % len(TIMES):
                continue
            yield name, kind, text[:start] + with_value(text[start:end], times) + text[end:]


def lines_of(program, base, files):
    run = subprocess.run([program, base, *files], capture_output=True, text=True, check=True)
    out = collections.defaultdict(list)
    for line in run.stdout.splitlines():
        cells = line.split("\t")
        out[cells[0]].append(cells)
    return out


def is_told(lines, plain):
    return any(tuple(c[1:]) not in plain for c in lines if c[1] != "accepted")


def accepted(program, folder):
    """(pack, quantity, kind) of which nothing is said"""
    base = ROOT / "processes/base.xml"
    plain = {}
    for name in PACKS:
        file = ROOT / f"processes/{name}.xml"
        plain[name] = {tuple(c[1:]) for c in lines_of(program, base, [file])[str(file)]}
        made = list(cases(file.read_text(encoding="utf-8")))
        files = [folder / f"{i:05d}.xml" for i in range(len(made))]
        for path, (_, _, text) in zip(files, made):
            path.write_text(text, encoding="utf-8")
        lines = lines_of(program, base, files)
        for path, (q, kind, _) in zip(files, made):
            if not is_told(lines[str(path)], plain[name]):
                yield name, q, kind
    for q, kind, text in cases(base.read_text(encoding="utf-8")):
        path = folder / "base.xml"
        path.write_text(text, encoding="utf-8")
        flows = [ROOT / f"processes/{name}.xml" for name in PACKS]
        lines = lines_of(program, path, flows)
        if not any(is_told(lines[str(flow)], plain[name]) for flow, name in zip(flows, PACKS)):
            yield "base", q, kind


def why(q, kind):
    for pattern, kinds, reason in FINE:
        if re.fullmatch(pattern, q) and kind in kinds:
            return reason
    return None


def main():
    bad, fine = [], 0
    with tempfile.TemporaryDirectory() as kept:
        for name, q, kind in accepted(sys.argv[1], pathlib.Path(kept)):
            if why(q, kind):
                fine += 1
            else:
                bad.append((name, q, kind))
    for name, q, kind in bad:
        print(f"{name}: {q}, {kind}: nothing is said")
    print(f"{len(bad)} without a reason, {fine} with one")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
