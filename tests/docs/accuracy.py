#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/accuracy.md and its pictures are what their data say, and the numbers of its first sentences, worked out here once more
from the data alone, are those that stand there. What the data must show of themselves is here, too."""
import csv
import math
import pathlib
import re
import statistics
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
sys.path.insert(0, str(ROOT / "tests/accuracy"))
sys.dont_write_bytecode = True
import page  # noqa: E402
import pictures  # noqa: E402

problems = []
text = (DOCS / "accuracy.md").read_text(encoding="utf-8")


def rows(name):
    with (DOCS / f"data/accuracy-{name}.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def near(what, found, wanted, digits):
    """as far as the printed digits go"""
    if not abs(found - wanted) <= 0.51 * 10**-digits:
        problems.append(f"{what}: the page says {found}, its data {wanted}")


def quoted(pattern, what):
    match = re.search(pattern, text)
    if not match:
        problems.append(f"the page no longer says {what}")
        return None
    return match.groups()


# ---- the page is what its data say ----

tables = page.read(DOCS)
if page.compose(tables) != text:
    problems.append("docs/accuracy.md is not what its data say: tests/accuracy/run --report")
with tempfile.TemporaryDirectory() as work:
    folder = pathlib.Path(work)
    pictures.draw(folder, tables)
    for path in sorted(folder.iterdir()):
        kept = DOCS / "pictures" / path.name
        if not kept.exists() or kept.read_bytes() != path.read_bytes():
            problems.append(f"{path.name} is not what the data say")
    drawn = {path.name for path in folder.iterdir()}
for name in re.findall(r"\]\(pictures/(accuracy-[\w-]+\.svg)\)", text):
    if name not in drawn:
        problems.append(f"the page shows {name}, which nothing draws")

# ---- its sentences ----

six = {round(-math.log10(float(r["tolerance"]))): r for r in rows("motions") if r["problem"] == "six-bar" and r["kind"] == "by-accuracy"}
if said := quoted(r"true error of (\S+), for ([\d.]+) million instructions", "what the default buys"):
    near("true error, in digits", math.log10(float(said[0])), math.log10(float(six[3]["peak_error"])), 1)
    near("millions of instructions", float(said[1]), int(six[3]["instructions"]) / 1e6, 2)
if said := quoted(r"One more digit costs (\d+) %", "what a digit costs"):
    near("a digit", float(said[0]), 100 * ((int(six[8]["instructions"]) / int(six[3]["instructions"]))**0.2 - 1), 0)
paid = [float(r["default_median"]) for r in tables["survey"] if r["group"] == "all"]
if said := quoted(r"(\d+) % in the median of the random devices", "what a digit costs the random devices"):
    near("a digit of random devices", float(said[0]), 100 * (paid[-1]**0.2 - 1), 0)
closed = [abs(float(r["stiffness_off"])) for r in rows("hinges") if r["level"] == "closed-form"]
if said := quoted(r"closed form are ([\d.]+) % off the solids", "the model's error"):
    near("closed form", float(said[0]), 100 * statistics.median(closed), 1)
judged = {r["accuracy"]: r for r in rows("verdicts")}
devices = [r["decisions"] for r in rows("verdict-devices") if "-" not in r["decisions"]]
flips = sum({d[2], d[-1]} == {"a", "r"} for d in devices)
if said := quoted(r"verdict\*\* of (\d+) random devices near their limit: (\w+) accepted", "how sure the verdict is"):
    if int(said[0]) != len(devices) or said[1] != (str(flips) if flips else "none"):
        problems.append(f"the verdicts: the page says {said}, its data {len(devices)} devices and {flips} flips")
if said := quoted(r"; ([\d.]+) % stay undecided", "how many stay undecided"):
    near("undecided", float(said[0]), 100 * sum(d[2] == "i" for d in devices) / len(devices), 1)

# ---- what the data must show ----

if set(judged) != {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-8"}:
    problems.append("an accuracy is missing among the verdicts")
# one device may need one run more at one accuracy than at the next: of as many runs, and of the random devices in the median
for runs in {six[e]["runs"] for e in range(1, 9)}:
    counts = [int(six[e]["instructions"]) for e in range(1, 9) if six[e]["runs"] == runs]
    if any(b < 0.9 * a for a, b in zip(counts, counts[1:])):
        problems.append(f"more accuracy costs less, by {runs} runs: {counts}")
if paid[1] != 1 or any(b <= a for a, b in zip(paid, paid[1:])):
    problems.append(f"more accuracy costs no more: {paid}")
for e in range(1, 9):
    if not float(six[e]["peak_error"]) < 10.0**-e:
        problems.append(f"--accuracy 1e-{e} misses it on the six-bar: {six[e]['peak_error']}")
    if not float(six[e]["peak_error"]) <= float(six[e]["estimate"]):
        problems.append(f"the estimate at 1e-{e} is too small")
methods = {r["setting"] for r in rows("motions") if r["kind"] == "by-method"}
integrators = {r["setting"] for r in rows("motions") if r["kind"] == "by-integrator" and not r["problem"].startswith("scale")}
if len(methods) != 9 or len(integrators) != 9:
    problems.append(f"{len(methods)} methods and {len(integrators)} integrators")
for problem in ("six-bar", "squeezer", "windows-4"):
    best = min(float(r["peak_error"]) for r in rows("motions") if r["problem"] == problem)
    if not best < 1e-10:
        problems.append(f"no setting gets {problem} below 1e-10: {best}")
for r in tables["survey"]:
    if r["group"] == "all" and not float(r["share_below"]) >= 0.99:
        problems.append(f"--accuracy {r['accuracy']} holds for {r['share_below']} of the random devices only")
for r in rows("times"):
    wide = (float(r["ratio_high"]) - float(r["ratio_low"])) / float(r["ratio"]) > 0.1
    if wide and r["what"] == "ratio" and f"{float(r['ratio']):.2f} [" in text:
        problems.append(f"a time at {r['accuracy']} is shown though its interval is too wide")
if re.search(r"\bnan\b", text):
    problems.append("the page shows something that is not a number")

print("\n".join(problems) or f"{len(text.split())} words, {len(drawn)} pictures")
sys.exit(1 if problems else 0)
