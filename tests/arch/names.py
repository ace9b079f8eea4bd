#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One word for one thing: every type and every external function carries the name of its room, no two rooms have a type
or a file of the same name, and words that docs/glossary.md has retired do not come back as identifiers."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SRC = ROOT / "src"
# the language of the house: memory, text, status, diagnostics, output, hashes stand without a prefix
UNPREFIXED = {"base"}
# rooms whose names say the singular: fw_effect_gravity is the row of the effect "gravity" of effects/
PREFIX = {"effects": r"effects?"}
# retired word -> the field's word; in identifiers only, a comment may use plain English
RETIRED = {
    "pace": "tolerance, modal_speed", "contest": "integrator_trial", "kink": "near_zero", "kinks": "near_zero",
    "poise": "stability", "tire": "fatigue", "books": "energy_balance", "doubt": "nonlinearity or uncertainty",
    "unsure": "nonlinearity", "pushes": "modal_loads", "tie": "joint", "ties": "joints", "ntie": "njoint",
    "price": "cost", "closer": "refinement",
}
# where such a word is the field's own: a kink of a strip's outline, ties of a schedule's tied operations, the
# price of a bottle
KEPT = {("flexure", "kink"), ("flexure", "kinks"), ("schedule", "tie"), ("schedule", "ties"),
        ("process", "price"), ("process", "price_units")}

COMMENT = re.compile(r"/\*.*?\*/", re.S)
STRING = re.compile(r'"(\\.|[^"\\\n])*"')
TYPES = [re.compile(r"\b(?:struct|enum|union)\s+(fw_\w+)\s*\{"), re.compile(r"\}\s*(fw_\w+)\s*;"),
         re.compile(r"\btypedef\b[^;{}]*?\(\s*\*\s*(fw_\w+)\s*\)"),
         re.compile(r"\btypedef\s+[^;{}()]*?\b(fw_\w+)\s*(?:\[[^\]]*\])?;")]
FUNCTIONS = [re.compile(r"^(?!\s*(?:typedef|static|return|#))[A-Za-z_][\w\s\*]*?\b(fw_\w+)\s*\([^;{}]*\)\s*;", re.M)]
EXTERN = re.compile(r"^\s*extern\s+([^;(]*);", re.M)
DECLARED = re.compile(r"\b(fw_\w+)\s*(?=[,\[]|$)")


def code_of(path):
    text = COMMENT.sub(lambda m: "\n" * m.group(0).count("\n"), path.read_text())
    return STRING.sub('""', text)


def names(patterns, text):
    return {m.group(1) for pattern in patterns for m in pattern.finditer(text)}


def visible(text):
    """names that a header gives to other files"""
    return names(FUNCTIONS, text) | {name for m in EXTERN.finditer(text) for name in DECLARED.findall(m.group(1).strip())}


def prefix_problems(room, name, kinds, public):
    wanted = PREFIX.get(room, room)
    if name in public or re.match(rf"fw_{wanted}(_|$)", name):
        return
    yield f"{kinds} {name} of {room}/ does not carry its room's name (fw_{room}_...)"


def problems():
    public = set(re.findall(r"\bfw_\w+", (ROOT / "include/flexwright.h").read_text()))
    rooms_of_type, files = collections.defaultdict(set), collections.defaultdict(set)
    bodies = collections.defaultdict(list)  # where "struct NAME {" stands
    for path in sorted(SRC.rglob("*.[ch]")):
        where = path.relative_to(SRC).as_posix()
        room, text = where.split("/")[0], code_of(path)
        files[path.name].add(where)
        for name in sorted(names(TYPES, text)):
            rooms_of_type[name].add(room)
        for m in TYPES[0].finditer(text):
            bodies[m.group(1)].append(where)
        if room not in UNPREFIXED:
            for name in sorted(names(TYPES, text)):
                yield from (f"{where}: {p}" for p in prefix_problems(room, name, "the type", public))
            if path.suffix == ".h":
                for name in sorted(visible(text)):
                    yield from (f"{where}: {p}" for p in prefix_problems(room, name, "the function or table", public))
        for name in sorted(set(re.findall(r"\b[A-Za-z_]\w*\b", text))):
            for part in name.lower().split("_"):
                if part in RETIRED and (room, part) not in KEPT:
                    yield f"{where}: '{part}' in {name}: write {RETIRED[part]} (docs/glossary.md)"
    for name, rooms in sorted(rooms_of_type.items()):
        if len(rooms) > 1:
            yield f"the type {name} is defined in {' and '.join(sorted(rooms))}"
    for name, where in sorted(bodies.items()):
        if len(where) > 1 and len(rooms_of_type[name]) == 1:
            yield f"the type {name} is defined in {' and in '.join(where)}"
    for name, where in sorted(files.items()):
        if len({w.split('/')[0] for w in where}) > 1:
            yield f"the file name {name} stands in {', '.join(sorted(where))}"


def main():
    found = list(problems())
    for line in found:
        print(line)
    print(f"{len(found)} names are wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
