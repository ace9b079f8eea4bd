#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bands.py [--program FLEXWRIGHT] [--rows FILE] [DEVICE.xml ...]

What the bands of hinges are made of: median and mean of every part, in per cent of the utilisation, downwards and upwards, by kind of
hinge. Of device files all their hinges, as drawn; --rows: of the governing hinges of a run of judge.py --json."""
import argparse
import collections
import json
import re
import statistics
import subprocess

PARTS = ("root", "stiffness", "hinge_model", "place", "bodies", "numbers")


def of_file(program, path):
    """(kind, band and parts) of every hinge of a device file that is strained"""
    said = subprocess.run([program, "check", path, "--json", "--corners", "none", "--advice", "none", "--no-progress"],
                          capture_output=True, text=True, check=False).stdout
    text = open(path, encoding="utf-8").read()
    kinds = {}
    for name, more in re.findall(r'<flexure id="([^"]*)"([^>]*)', text):
        kinds[name] = "varying" if "width-middle" in more else (re.findall(r'kind="(\w+)"', more) or ["csfh"])[0]
    of = dict(re.findall(r'<revolute id="([^"]*)"[^>]*?hinge="([^"]*)"', text, re.S))
    for hinge in json.loads(said).get("hinges", []):
        if hinge["utilisation"] and hinge["utilisation"] > 1e-6:
            yield kinds.get(of.get(hinge["id"]), "hinge"), hinge


def of_rows(path):
    for line in open(path, encoding="utf-8"):
        row = json.loads(line)
        if "parts" in row.get("default", {}):
            said = row["default"]
            yield row["name"].split("/")[1], {"utilisation": said["utilisation"], "utilisation_band": said["band"], "band_parts": said["parts"]}


def show(found):
    groups = collections.defaultdict(list)
    for kind, hinge in found:
        groups[kind].append(hinge)
        groups["all"].append(hinge)
    print("%-9s %4s %-8s %13s" % ("", "n", "", "whole") + "".join("%14s" % p for p in PARTS))
    for kind in sorted(groups, key=lambda k: (k == "all", k)):
        columns = []
        for hinge in groups[kind]:
            use, band = hinge["utilisation"], hinge["utilisation_band"]
            columns.append([(1 - band[0] / use, band[1] / use - 1)] + [hinge["band_parts"][p] for p in PARTS])
        for name, of in (("median", statistics.median), ("mean", statistics.mean)):
            print("%-9s %4d %-8s" % (kind, len(columns), name) +
                  "".join("%7.2f %6.2f" % tuple(100 * of([c[k][end] for c in columns]) for end in (0, 1)) for k in range(len(PARTS) + 1)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/flexwright")
    parser.add_argument("--rows", default="")
    parser.add_argument("device", nargs="*")
    options = parser.parse_args()
    found = list(of_rows(options.rows)) if options.rows else []
    for path in options.device:
        found += of_file(options.program, path)
    show(found)


if __name__ == "__main__":
    main()
