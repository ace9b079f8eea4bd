#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every effect of src/device/effects.def has a page in docs/theory/effects with what a reader needs to judge
it, each under a heading of its own; its README lists all of them; what the table of the program keeps or prices is
what pages say. That the tests that they name exist: pages.py."""
import csv
import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import effect_costs_picture  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs/theory/effects"
HEADINGS = ("Equations", "When it is called for", "Bound", "Validity", "Proved and tested", "Sources")
OTHERS = {"README", "costs", "envelope"}
problems = []

names = re.findall(r"^FW_EFFECT(?:_ELEMENT)?\((\w+)", (ROOT / "src/device/effects.def").read_text(), re.M)
ids = [name.replace("_", "-") for name in names]
readme = (PAGES / "README.md").read_text()
rows = dict(re.findall(r"^\| \[([\w-]+)\]\([\w-]+\.md\) \|(.*)\|$", readme, re.M))
costs = list(csv.DictReader((ROOT / "docs/data/effect-costs.csv").open()))
if len(ids) < 18 or len(costs) < 20:
    problems.append("effects.def has lost effects, or this test cannot read it")

for name, effect in zip(names, ids):
    page = PAGES / f"{effect}.md"
    if not page.exists():
        problems.append(f"{effect} has no page {page.relative_to(ROOT)}")
        continue
    text = page.read_text()
    # a section is what stands between its heading and the next one of the same level
    sections = dict(re.findall(r"^## ([^\n:,]+)[^\n]*\n(.*?)(?=^## |\Z)", text, re.M | re.S))
    for heading in HEADINGS:
        if len(sections.get(heading, "").split()) < 3:
            problems.append(f"{effect}.md says nothing under '## {heading}'")
    if f"src/effects/{name}.c" not in text and f"`{name}.c`" not in text:
        problems.append(f"{effect}.md does not say where its code is (src/effects/{name}.c)")
    if effect not in rows:
        problems.append(f"the table of README.md does not list {effect}")
        continue
    source = (ROOT / f"src/effects/{name}.c").read_text()
    kept, bound = ".kept = true" in source, sections.get("Bound", "")
    if kept != rows[effect].endswith(" ∞, kept "):
        problems.append(f"README.md and {name}.c disagree on whether {effect} is kept")
    if kept and not re.match(r"\s*(∞, and the|The) effect is kept whatever was asked for", bound):
        problems.append(f"{effect}.md does not begin its bound with what is kept")
    if not kept and effect not in ("joint-stop", "contact", "friction") and not re.search(r"\b(tested|proved)\b", bound):
        problems.append(f"{effect}.md does not say whether its bound is proved or tested")
    if re.search(r"\d instructions", text):
        problems.append(f"{effect}.md states a cost: that is in costs.md, which is counted")
    cost = re.search(r"\.cost = (\d+)", source)
    counted = [float(row["each"]) for row in costs if row["effect"] == effect]
    if counted and abs(max(counted) - float(cost.group(1) if cost else 0)) > 0.25 * max(counted):
        problems.append(f"{name}.c states a cost of {cost and cost.group(1)}, and {max(counted)} was counted")
if effect_costs_picture.PICTURE.read_text() != effect_costs_picture.draw():
    problems.append("effect-costs.svg is not what effect-costs.csv says: tests/build/effects.py write draws it")
for page in PAGES.glob("*.md"):
    if page.stem not in OTHERS and page.stem not in ids:
        problems.append(f"{page.name} is of no effect")
if "theory/effects/README.md" not in (ROOT / "docs/index.md").read_text():
    problems.append("docs/index.md does not link the effects")

print("\n".join(problems) or f"{len(ids)} effects, a page each")
sys.exit(1 if problems else 0)
