#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every effect of src/effects/effects.def has a page in docs/theory/effects with what a reader needs to judge
it, each under a heading of its own; its README lists all of them, and the tests that pages name exist."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs/theory/effects"
HEADINGS = ("Formula", "When it is called for", "Bound", "Validity", "Source", "Test")
OTHERS = {"README", "costs"}
problems = []

names = re.findall(r"^FW_EFFECT\((\w+)\)", (ROOT / "src/effects/effects.def").read_text(), re.M)
ids = [name.replace("_", "-") for name in names]
readme = (PAGES / "README.md").read_text()
tests = {path.name for path in (ROOT / "tests").rglob("test_*")}
if len(ids) < 18:
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
    if not re.search(r"^\| \[" + effect + r"\]\(" + effect + r"\.md\) \|", readme, re.M):
        problems.append(f"the table of README.md does not list {effect}")
for page in PAGES.glob("*.md"):
    if page.stem not in OTHERS and page.stem not in ids:
        problems.append(f"{page.name} is of no effect")
    for test in re.findall(r"test_\w+\.(?:c|py)\b", page.read_text()):
        if test not in tests:
            problems.append(f"{page.name} names {test}, which is not there")
if "theory/effects/README.md" not in (ROOT / "docs/index.md").read_text():
    problems.append("docs/index.md does not link the effects")

print("\n".join(problems) or f"{len(ids)} effects, a page each")
sys.exit(1 if problems else 0)
