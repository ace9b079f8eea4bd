#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages and comments refer to is there: tests and source files by name, headings behind '#', diagnostics by number,
commands of the program, every page, decision and gallery device from its index, and every term of the glossary on its page."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
problems = []

pages = sorted([*DOCS.rglob("*.md"), *ROOT.glob("*.md"), ROOT / "src/README.md"])
sources = sorted(path for folder in ("src", "tests", "include") for path in (ROOT / folder).rglob("*.[ch]"))
names = {path.name for folder in ("src", "tests", "tools", "include") for path in (ROOT / folder).rglob("*")}
known_codes = {int(n) for n in re.findall(r"^X\((\d+),", (ROOT / "src/base/diagnostics.def").read_text(), re.M)}
if len(known_codes) < 100 or len(pages) < 50 or len(sources) < 300:
    problems.append("this test cannot read what it is to compare")


def anchor(heading):
    """as the usual readers of Markdown make them"""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)|[`*]", r"\1", heading).strip().lower()
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", plain))


anchors = {page: {anchor(h) for h in re.findall(r"^#+ (.*)$", page.read_text(), re.M)} for page in pages}
for page in pages:
    text, short = page.read_text(), page.relative_to(ROOT)
    for target, fragment in re.findall(r"\]\(([^)#:]*)#([^)]+)\)", text):
        there = (page.parent / target).resolve() if target else page
        if there in anchors and fragment not in anchors[there]:
            problems.append(f"{short} links to {target}#{fragment}, and there is no such heading")
    for code in re.findall(r"FW-D(\d{3})", text):
        if int(code) not in known_codes:
            problems.append(f"{short} names FW-D{code}, which does not exist")
    if page.name == "CHANGELOG.md":
        continue
    for name in re.findall(r"`(?:[\w./-]*/)?(\w+\.(?:c|h|py|sh|def))`", text):
        if name not in names and "NAME" not in name:
            problems.append(f"{short} names {name}, which is not there")
for path in sources:
    for name in re.findall(r"\btest_\w+\.(?:c|py)\b", path.read_text()):
        if name not in names:
            problems.append(f"{path.relative_to(ROOT)} names {name}, which is not there")
    for name in re.findall(r"\bdocs/[\w./-]+\.(?:md|csv)\b", path.read_text()):
        if not (ROOT / name).exists():
            problems.append(f"{path.relative_to(ROOT)} names {name}, which is not there")


def indexed(index, targets):
    text = index.read_text()
    for target in targets:
        if f"({target})" not in text and f"({target}#" not in text:
            problems.append(f"{index.relative_to(ROOT)} does not link {target}")


indexed(DOCS / "decisions/README.md", sorted(p.name for p in (DOCS / "decisions").glob("0*.md")))
indexed(DOCS / "gallery/README.md", sorted(f"{p.parent.name}/device.xml" for p in DOCS.glob("gallery/*/device.xml")))
indexed(DOCS / "theory/README.md",
        sorted([p.name for p in (DOCS / "theory").glob("*.md") if p.name != "README.md"] + ["effects/README.md"]))
indexed(DOCS / "index.md", sorted(f"reference/{p.name}" for p in (DOCS / "reference").iterdir()))

indexed(DOCS / "theory/effects/README.md", sorted(p.name for p in (DOCS / "theory/effects").glob("*.md") if p.name != "README.md"))

# a term of the glossary is used where the glossary says that it is explained
glossary = (DOCS / "glossary.md").read_text().partition("## ")[0]
terms = re.findall(r"^\| ([^|]+) \| [^|]+ \| \[[^]]*\]\(([^)#]+)[^)]*\) \|$", glossary, re.M)
if len(terms) < 20:
    problems.append("this test cannot read the glossary")
for row, target in terms:
    there = " ".join((DOCS / target).read_text().lower().replace("**", "").split())
    for term in row.split(", "):
        if term.lower() not in there:
            problems.append(f"docs/glossary.md sends the reader of '{term}' to {target}, which does not use it")

print("\n".join(dict.fromkeys(problems)) or f"{len(pages)} pages and {len(sources)} sources refer to what is there")
sys.exit(1 if problems else 0)
