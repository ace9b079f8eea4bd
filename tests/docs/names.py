#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names in pages and comments are those of the tree: every file.c and file.h, with the room that stands before it; every room/; every
identifier fw_... that docs/**/*.md, src/README.md and the comments of src, include, tests and tools speak of is there."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)
FILE = re.compile(r"(?<![\w/.<\"-])((?:[\w-]+/)*[\w-]+\.[ch])(?!\w|\.\w|/)")
PLACE = re.compile(r"(?<![\w/.<*])([a-z]{4,})/(?=[`.,;:)]|\s|$)")
WORD = re.compile(r"\bfw_\w+")
# what is no file of ours: headers of libraries and of the language, and examples of what a reader would write
FOREIGN = {"math.h", "stdio.h", "stdlib.h", "string.h", "errno.h", "unistd.h", "signal.h", "poll.h", "zlib.h", "lapacke.h", "cblas.h",
           "jansson.h", "fenv.h", "threads.h", "stdatomic.h", "device.c"}
problems = []

sources = sorted(p for folder in ("src", "include", "tests", "tools") for p in (ROOT / folder).rglob("*") if p.suffix in (".c", ".h", ".def"))
files = [str(p.relative_to(ROOT)) for p in sources]
names = {pathlib.PurePath(f).name for f in files}
tops = [p for p in ROOT.iterdir() if p.is_dir() and not p.name.startswith((".", "build"))]
directories = {p.name for p in tops}
directories.update(p.name for p in (ROOT / "web").iterdir())
for top in ("src", "include", "tests", "tools", "docs", "web/src"):
    directories.update(p.name for p in (ROOT / top).glob("**/") if "node_modules" not in p.parts)

comments, words = {}, set()
for path in sources:
    text = path.read_text(encoding="utf-8")
    said, code = [], []
    at = 0
    for match in CODE.finditer(text):
        code.append(text[at:match.start()])
        if match[0][:2] in ("/*", "//"):
            said.append((text.count("\n", 0, match.start()) + 1, match[0]))
        elif match[0].startswith('"'):
            code.append(match[0])  # names in #include and in macros that paste strings
        at = match.end()
    code.append(text[at:])
    comments[path] = said
    words.update(WORD.findall("".join(code)))
# names that macros put together: FW_EFFECT(air) makes fw_effect_air, and so on
pasted = {part for path in sources for part in re.findall(r"\bfw_\w*(?=##)", path.read_text(encoding="utf-8"))}


def known(word):
    if word in words or word.endswith("_") and any(w.startswith(word) for w in words):
        return True
    return any(word.startswith(start) and len(start) > 3 for start in pasted)


def look(where, text, room):
    """room: of a source, in whose comment this stands"""
    for name in FILE.findall(text):
        base = name.rpartition("/")[2]
        if base in FOREIGN or "NAME" in base:
            continue
        if base not in names or "/" in name and not any(f == name or f.endswith("/" + name) for f in files):
            problems.append(f"{where} names {name}, which is not there")
    private = re.search(r"[Pp]rivate\s+to\s(?:the\s\w+\sof\s)?([a-z]+)/", text)
    if private and room != private[1]:
        problems.append(f"{where} says that it is private to {private[1]}/, and it stands in {room}/")
    for name in PLACE.findall(text):
        if name not in directories:
            problems.append(f"{where} names the directory {name}/, which is not there")
    for word in WORD.findall(text):
        if not known(word):
            problems.append(f"{where} names {word}, which is not there")


for path in sources:
    for line, text in comments[path]:
        look(f"{path.relative_to(ROOT)}:{line}", text, path.relative_to(ROOT).parts[1] if path.parts[-2] != "include" else "")
pages = sorted([*(ROOT / "docs").rglob("*.md"), ROOT / "src/README.md", ROOT / "CONTRIBUTING.md"])
for path in pages:
    for line, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        look(f"{path.relative_to(ROOT)}:{line}", text, "")

if len(sources) < 300 or len(words) < 2000 or len(pages) < 50:
    problems.append("this test cannot read what it is to compare")
print("\n".join(dict.fromkeys(problems)) or f"{len(pages)} pages and the comments of {len(sources)} sources name what is there")
sys.exit(1 if problems else 0)
