# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/data/accuracy-*.csv, and the figures that page and pictures draw from them."""
import csv
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import curves  # noqa: E402

NAMES = ("motions", "verdicts", "hinges", "hinge-costs", "models", "masks", "times", "peers", "provenance")
OPTIONAL = ("survey", "honesty")
NUMBERS = ("state_error", "peak_error", "estimate")
WIDE = 0.1  # an interval wider than this share of its median is not worth a number
WHOLE = ("flexwright", "whole call with error estimate")


def interval_text(row, digits=2):
    """a ratio with its interval, or why there is none"""
    middle, low, high = (float(row[name]) for name in ("ratio", "ratio_low", "ratio_high"))
    if (high - low) / middle > WIDE:
        return "noisy, not shown"
    return f"{middle:.{digits}f} [{low:.{digits}f}, {high:.{digits}f}]"


class Tables:
    def __init__(self, docs):
        self.table = {}
        for name in NAMES + OPTIONAL:
            path = docs / "data" / f"accuracy-{name}.csv"
            if name in OPTIONAL and not path.exists():
                self.table[name] = []
                continue
            with path.open(newline="", encoding="utf-8") as file:
                self.table[name] = list(csv.DictReader(file))
        for row in self["motions"]:
            row.update({name: float(row[name]) for name in NUMBERS})
            row.update({name: int(row[name]) for name in ("rhs", "steps", "runs", "instructions")})

    def __getitem__(self, name):
        return self.table[name]

    # ---- motions ----

    def curve(self, problem, kind, setting):
        return [r for r in self["motions"] if (r["problem"], r["kind"], r["setting"]) == (problem, kind, setting)]

    def settings(self, problem, kind):
        """(name, rows), the cheapest first"""
        names = dict.fromkeys(r["setting"] for r in self["motions"] if (r["problem"], r["kind"]) == (problem, kind))
        found = [(name, self.curve(problem, kind, name)) for name in names]
        return sorted(found, key=lambda one: (one[0] not in ("chain", "dop853"), min(r["instructions"] for r in one[1])))

    def asked(self, exponent):
        """the six-bar as --accuracy 10^-exponent moves it"""
        return next(r for r in self.curve("six-bar", "by-accuracy", "--accuracy") if round(-math.log10(float(r["tolerance"]))) == exponent)

    def digit(self, first=3, last=8):
        """how many times as many instructions one more digit takes, in the mean"""
        return (self.asked(last)["instructions"] / self.asked(first)["instructions"])**(1 / (last - first))

    def random(self, accuracy):
        """what --accuracy does to the random devices; None where it was not tried"""
        return next((r for r in self["survey"] if r["group"] == "all" and float(r["accuracy"]) == accuracy), None)

    def scaling(self):
        found = []
        for r in self["motions"]:
            if r["problem"].startswith("scale-"):
                n = int(r["problem"][6:])
                found.append({**r, "n": n, "bodies": 2 * n + 1})
        return sorted(found, key=lambda r: r["n"])

    def slope(self):
        return curves.exponent([(r["bodies"], r["instructions"]) for r in self.scaling() if r["n"] >= 10])

    # ---- time ----

    def time_of(self, what, accuracy):
        return next((r for r in self["times"] if (r["what"], r["accuracy"]) == (what, accuracy)), None)

    @property
    def ms_per_instruction(self):
        """None where it is too noisy"""
        row = self.time_of("ms", "1e-3")
        if not row or interval_text(row) == "noisy, not shown":
            return None
        return float(row["ratio"]) / self.asked(3)["instructions"]

    @property
    def peers_per_ms(self):
        """instructions of our whole call over its CPU time where the peers were measured, at the same tolerances"""
        own = {r["tolerance"]: r["instructions"] for r in self.curve("six-bar", "by-integrator", "dop853")}
        rows = [r for r in self["peers"] if (r["peer"], r["setting"]) == WHOLE]
        found = [own[key] / float(r["cpu_ms"]) for r in rows if (key := f"{float(r['tolerance']):.0e}") in own]
        return statistics.median(found)

    # ---- models ----

    def off(self, level, what):
        """of every hinge: how far `what` is from the solid's; of solids their own estimate"""
        column = f"{what}_estimate" if level == "continuum" else f"{what}_off"
        return [max(abs(float(r[column])), 1e-6) for r in self["hinges"] if r["level"] == level]

    def cost(self, level):
        """instructions, the median of all hinges; of solids by their time, from one run of each"""
        if level != "continuum":
            return statistics.median(int(r["instructions"]) for r in self["hinge-costs"] if r["level"] == level)
        took = {name: statistics.median(float(r["cpu_s"]) for r in self["hinges"] if r["level"] == name)
                for name in ("elastica", "continuum")}
        return self.cost("elastica") * took["continuum"] / took["elastica"]

    def level_name(self, level):
        return {"closed-form": "closed form", "compliance": "with drift", "elastica": "exact beam",
                "continuum": "solid (by its time)"}[level]

    @property
    def solids(self):
        return len([r for r in self["hinges"] if r["level"] == "continuum"])

    def model(self, name):
        """least, median and largest error of a peak by this model of the hinges"""
        found = [float(r["peak_error"]) for r in self["models"] if r["model"] == name]
        return min(found), statistics.median(found), max(found)

    @property
    def floor(self):
        """what no tolerance takes away: hinges in closed form beside solids, the median of their stiffness"""
        return statistics.median(self.off("closed-form", "stiffness"))

    def floors(self):
        """for the work-precision picture"""
        pins, giving = self.model("revolute")[1], self.model("compliance")[1]
        return [(self.floor, 1e-14, f"in here the model is wrong by more: closed-form hinges beside solids, {100 * self.floor:.2g} %"),
                (pins, pins, f"pins instead of flexures: {100 * pins:.2g} %"),
                (giving, giving, f"flexures that give, beside exact beams: {giving:.0e}".replace("e-0", "e-"))]

    # ---- verdicts ----

    def verdict(self, accuracy):
        return next(r for r in self["verdicts"] if r["accuracy"] == accuracy)

    def fact(self, what):
        return next((r["value"] for r in self["provenance"] if r["what"] == what), "not stated")
