#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rooms and their arrows: a file includes only its own room and rooms on lower floors, third-party
headers only where the design allows them, and no file grows past what a reader can hold."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = re.search(r"set\(FW_ROOMS ([^)]*)\)", (ROOT / "cmake/rooms.cmake").read_text()).group(1).split()
CAST = set(re.search(r"set\(FW_ROOMS_CAST ([^)]*)\)", (ROOT / "cmake/rooms.cmake").read_text()).group(1).split())
BY_VOID = re.compile(r"\*\)\s*\((const )?void \*\)|[^=]= \((const )?void \*\)")
FLOOR = {room: i for i, room in enumerate(ROOMS)}
ALLOWED = {  # header prefix -> rooms that may include it
    "libxml/": {"xml"},
    "gsl/": {"maths"},
    "lapacke": {"maths"},
    "cblas": {"maths"},
    "cairo": {"report"},
    "zlib": {"mask"},
    "microhttpd": {"serve"},
    "zip.h": {"serve"},
    "jansson": {"base", "plan", "study", "serve", "cli"},  # readers: what is written goes through base/json.h
}
MOST_LINES, MOST_FILES = 600, 619
BANNED = [(re.compile(r"\b(assert|abort|exit)\s*\("), "ends the process"),
          (re.compile(r"\b(malloc|calloc|realloc)\s*\("), "takes memory outside the arena"),
          (re.compile(r"\b(time|localtime|gmtime|gettimeofday)\s*\("), "reads the clock"),
          (re.compile(r"\bsetlocale\s*\("), "changes the locale"),
          (re.compile(r"\bjson_(dump\w*|v?pack\w*|object|array|string|real|integer)\s*\("),
           "writes JSON beside base/json.h")]
# elements of SVG come from the canvas alone; device/ names elements of the description that are called alike, and
# xml/schema.c those of RELAX NG
SVG = re.compile(r'"[^"\n]*</?(svg|path|rect|circle|line|poly\w+|text|tspan|g|use|defs|animate\w*)[ >"/\\]')
INCLUDE = re.compile(r'\s*#\s*include\s+([<"])([^>"]+)')
LABEL = re.compile(r"\bcase\s+([^:]+):")
OTHERS = re.compile(r"XML_|MHD_|JSON_")  # enums of libraries; all others that have names are ours
EXCUSED = {"base/arena.c", "cli/options.c", "cli/cli_commands.c"}


def defaults(code):
    """lines of `default:` in a switch over an enum of ours: there gcc could not report a new member"""
    for found in re.finditer(r"\bswitch\s*\(", code):
        start = code.index("{", found.end())
        depth, end = 1, start + 1
        while depth:
            depth += {"{": 1, "}": -1}.get(code[end], 0)
            end += 1
        body = code[start + 1:end - 1]
        inner = re.sub(r"\bswitch\s*\([^{]*\{[^{}]*\}", "", body)  # a switch inside has its own
        names = [label for label in LABEL.findall(inner) if re.match(r"[A-Za-z_]", label) and not OTHERS.match(label)]
        if names and re.search(r"\bdefault\s*:", inner):
            yield code.count("\n", 0, found.start()) + 1, names[0]


def problems():
    for path in sorted((ROOT / "src").rglob("*.[ch]")):
        name = path.relative_to(ROOT / "src").as_posix()
        room = name.split("/")[0]
        if room not in FLOOR:
            yield f"{name}: room '{room}' is not in cmake/rooms.cmake"
            continue
        text = path.read_text()
        lines = text.splitlines()
        if len(lines) > MOST_LINES:
            yield f"{name}: {len(lines)} lines; split it (at most {MOST_LINES})"
        if "SPDX-License-Identifier: GPL-3.0-or-later" not in lines[0]:
            yield f"{name}:1: no SPDX line"
        canvas = name in ("base/svg.c", "xml/schema.c") or room == "device"
        for number, line in enumerate([] if canvas or not SVG.search(text) else lines, 1):
            if SVG.search(line):
                yield f"{name}:{number}: writes SVG by itself; that is for base/svg.h"
        code = re.sub(r'/\*.*?\*/|"(\\.|[^"\\\n])*"', lambda m: "\n" * m.group(0).count("\n"), text, flags=re.S)
        plain = re.sub(r"'(\\.|[^'\\\n])'", "0", code)
        for number, member in defaults(plain):
            yield f"{name}:{number}: a switch over an enum of ours ({member}) has a default; name every member, and return behind it"
        if room not in CAST and BY_VOID.search(plain):
            yield f"{name}: casts a pointer by way of void; add '{room}' to FW_ROOMS_CAST, so that the sanitizers look at its alignment"
        for number, line in enumerate(lines, 1):
            include = INCLUDE.match(line) if "include" in line else None
            if not include:
                continue
            target = include.group(2)
            if include.group(1) == '"':
                other = target.split("/")[0]
                if other not in FLOOR:
                    yield f'{name}:{number}: "{target}" is in no room'
                elif FLOOR[other] > FLOOR[room]:
                    yield f"{name}:{number}: {room} may not include {other} (a floor above)"
            for prefix, rooms in ALLOWED.items():
                if target.startswith(prefix) and room not in rooms:
                    yield f"{name}:{number}: <{target}> belongs to {', '.join(sorted(rooms))}"
        banned = [] if name in EXCUSED else [(pattern, why) for pattern, why in BANNED if pattern.search(code)]
        if banned:
            for number, line in enumerate(code.splitlines(), 1):
                for pattern, why in banned:
                    if pattern.search(line):
                        yield f"{name}:{number}: {pattern.search(line).group(0)}...) {why}"


def main():
    found = list(problems())
    count = sum(1 for _ in (ROOT / "src").rglob("*.[ch]"))
    if count > MOST_FILES:
        found.append(f"{count} files below src/, more than {MOST_FILES}: join families")
    for line in found:
        print(line)
    print(f"{count} files in {len(ROOMS)} rooms, {len(found)} wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
