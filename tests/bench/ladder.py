#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and error of every level of a hinge beside each other, solids by CalculiX as the last: the hinges of the
gallery, told apart. Writes docs/hinge-ladder.md and docs/data/hinge-ladder.csv.

    tests/bench/ladder.py PROGRAM [--date 2026-11-20] [--rounds 5]"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DEVICES = ("reference-six-bar", "leaf-four-bar", "copper-nodder")  # of paths there is no solid
LEVELS = ("closed-form", "compliance", "elastica", "continuum")


def ladder(program, device, level):
    path = ROOT / "docs/gallery" / device / "device.xml"
    done = subprocess.run([program, "hinge", path, "--level", level, "--json"], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{device}: {done.stderr}")
    return [h for h in json.loads(done.stdout)["hinges"] if not h["same_as"]]


def rows(program, device, rounds):
    """cost: the median of rounds; the solids once, they take seconds"""
    whole = ladder(program, device, "all")
    again = [{level: ladder(program, device, level) for level in LEVELS[:3]} for _ in range(rounds - 1)]
    for k, hinge in enumerate(whole):
        found = {level["level"]: level for level in hinge["levels"] if level["solved"]}
        solid = found.get("continuum")
        if not solid:
            continue
        for name, level in found.items():
            cost = [level["cpu_s"]]
            for repeat in again if name != "continuum" else ():
                cost += [x["cpu_s"] for x in repeat[name][k]["levels"] if x["level"] == name]
            yield {
                "device": device,
                "hinge": hinge["id"],
                "flow": hinge["flow"],
                "level": name,
                "cpu_s": statistics.median(cost),
                "stiffness_off": level["stiffness_Nm_per_rad"] / solid["stiffness_Nm_per_rad"] - 1,
                # the level with drift has its centre at the limit angle: not comparable with that of a hinge at rest
                "centre_off_m": math.dist(level["centre_m"], solid["centre_m"]) if name != "compliance" else math.nan,
                "strain_off": level["strain_per_rad"] / solid["strain_per_rad"] - 1,
                "bound_off": hinge["strain_bound_per_rad"] / solid["strain_per_rad"] - 1,
                "stiffness_estimate": level["error"]["stiffness"],
                "centre_estimate_m": level["error"]["centre_m"],
                "strain_estimate": level["error"]["strain"],
            }


def cost(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def page(table, date):
    yield "# Hinges: what accuracy costs\n\n"
    yield ("Every level of `flexwright hinge --level all` on the hinges of the gallery: CPU time, how far it is from the solid "
           "that CalculiX solves (20-node bricks, real roots, two meshes), and what it says itself that it may be off by. "
           f"Measured {date} by `tests/bench/ladder.py build/flexwright` on a shared machine; data: "
           "[hinge-ladder.csv](data/hinge-ladder.csv).\n\n")
    yield "| device | hinge | flow | level | CPU | stiffness off % (own estimate) | centre off um | strain off % |\n"
    yield "|---|---|---|---|---|---|---|---|\n"
    for r in table:
        centre = "" if math.isnan(r["centre_off_m"]) else f"{1e6 * r['centre_off_m']:.3f} ({1e6 * r['centre_estimate_m']:.2f})"
        yield (f"| {r['device']} | {r['hinge']} | {r['flow'] or ''} | {r['level']} | {cost(r['cpu_s'])} "
               f"| {100 * r['stiffness_off']:+.2f} ({100 * r['stiffness_estimate']:.2f}) | {centre} "
               f"| {100 * r['strain_off']:+.2f} ({100 * r['strain_estimate']:.1f}) |\n")
    held = all(abs(r["stiffness_off"]) <= r["stiffness_estimate"] + 1e-3 for r in table)
    off, bound = ([100 * r[name] for r in table if r["level"] != "continuum"] for name in ("strain_off", "bound_off"))
    yield (f"\nStrain: {min(off):+.1f} to {max(off):+.1f} % beside these solids, whose strains at nodes scatter by 1 to 2 % with the mesh. "
           "Isotropic arcs are shown with (5) of [flexures](theory/flexure.md), leaves and crystals with the upper bound "
           f"(`strain_bound_per_rad`) that every verdict goes by: {min(bound):+.1f} to {max(bound):+.1f} % beside these solids, "
           "0 to 4 % beside converged ones. "
           + ("Every level is within its own estimate of the solid's stiffness.\n" if held
              else "Where a level is farther from the solid than it says, its estimate is wrong.\n"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--date", default="undated")
    parser.add_argument("--rounds", type=int, default=5)
    asked = parser.parse_args()
    table = [row for device in DEVICES for row in rows(asked.program, device, asked.rounds)]
    with (ROOT / "docs/data/hinge-ladder.csv").open("w", newline="") as out:
        writer = csv.DictWriter(out, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in r.items()} for r in table)
    (ROOT / "docs/hinge-ladder.md").write_text("".join(page(table, asked.date)))


if __name__ == "__main__":
    main()
