#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""together.py SIZE FILE...: which sources of one target may be compiled as one, at most SIZE of them: no two name the same
at the level of the file (a static function or object, a type, an enumerator, a macro), and a macro is no word of a file behind it.
What the level of one file names may be a local name of another: such a tree is compiled with -Wno-shadow. Prints one line "FILE GROUP" for each
FILE, in their order; files of different folders are never of one group. A compiler reads headers and starts once for each group, a third of its time under the sanitizers; the
usual build compiles each file by itself, so that a file that misses a header of its own is noticed there.
tests/build/together.py tries it on files with every kind of name."""
import functools
import pathlib
import re
import sys

ASIDE = re.compile(r"""/\*.*?\*/|//[^\n]*|("(?:\\.|[^"\\\n])*")|'(?:\\.|[^'\\\n])*'""", re.S)  # comments, strings, characters
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.M)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", re.M | re.S)
ENUM = re.compile(r"\benum\b[^;{}()]*\{([^{}]*)\}")
NAME = re.compile(r"[A-Za-z_]\w*")
OPENING, CLOSING = ("(", "[", "{"), (")", "]", "}")
PLACES = [pathlib.Path(__file__).parents[1] / place for place in ("src", "include", "tests/unit")]
SYSTEM = set("open close read write link pipe index time remove truncate accept listen bind send".split())  # of headers of other files
LONELY = re.compile(r"^#include <(complex|gsl/gsl_complex\w*)\.h>", re.M)  # they define I
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
COMMON = set("static const volatile inline extern struct union enum typedef void char short int long float double signed unsigned bool "
             "_Bool size_t return sizeof if else for while do switch case".split())


def names(text):
    """(what a file names at its own level, its macros, all words that it has); the first are identifiers outside of braces and
    parentheses, and enumerators"""
    text = ASIDE.sub(lambda m: '""' if m.group(1) else " ", text)
    macros = set(MACRO.findall(text))
    own = set(macros)
    words = set(NAME.findall(text))
    text = DIRECTIVE.sub(" ", text.replace("\\\n", " "))
    for inside in ENUM.findall(text):
        own.update(m.group(0) for part in inside.split(",") for m in [NAME.search(part)] if m)
    depth, outside = 0, []
    for part in re.split(r"([{}()\[\]])", text):
        if part in OPENING:
            outside.append(part if depth == 0 else "")
            depth += 1
        elif part in CLOSING:
            depth -= 1
        elif depth == 0:
            outside.append(part)
    # what is declared is the last name before its parameters, its value, its braces or its end
    for statement in re.split(r"[;{]", "".join(outside)):
        own.update(re.findall(r"(\w+)\s*(?=[(\[=,]|$)", statement.strip()))
    return {name for name in own - COMMON if name != "main" and not name.startswith("fw_")}, macros, words


@functools.cache
def looked_at(path):
    """(text, what names() says of it): of a header once, though many files include it"""
    text = path.read_text(encoding="utf-8")
    return text, names(text)


@functools.cache
def header_of(folder, name, places):
    """the header of ours that `name` is in a file of `folder`, or None"""
    return next(((p / name).resolve() for p in (folder, *places) if (p / name).is_file()), None)


@functools.cache
def headers(path, places):
    """({name: header} of the headers of ours that a file includes, and that these include; how many ask for <complex.h>)"""
    found, lonely, todo, known = {}, 0, [path], set()
    while todo:
        place = todo.pop()
        text, _ = looked_at(place)
        lonely += LONELY.search(text) is not None
        for name in INCLUDE.findall(text):
            header = header_of(place.parent, name, places)
            if header and header.suffix == ".h" and header not in known:
                known.add(header)
                todo.append(header)
                found.update(dict.fromkeys(looked_at(header)[1][0], header))
    return found, lonely


def grouped(files, size, places):
    """{file: number of its group}"""
    groups, of = [], {}
    for path in map(pathlib.Path, files):
        own, macros, words = looked_at(path)[1]
        theirs, lonely = headers(path, tuple(places))
        alone = lonely or own & SYSTEM
        for number, group in enumerate(groups):
            other = group["theirs"]
            if (group["size"] < size and not alone and not own & (group["own"] | other.keys())
                    and not group["own"] & theirs.keys() and not group["macros"] & words
                    and all(other[name] == theirs[name] for name in other.keys() & theirs.keys())):
                break
        else:
            number = len(groups)
            group = {"size": size if alone else 0, "own": set(), "macros": set(), "theirs": {}}
            groups.append(group)
        group["size"] += 1
        group["own"] |= own
        group["macros"] |= macros
        group["theirs"] |= theirs
        of[path] = number
    return of


if __name__ == "__main__":
    folders = {}
    for file in sys.argv[2:]:
        folders.setdefault(pathlib.Path(file).parent, []).append(file)
    for files in folders.values():
        for path, group in grouped(files, int(sys.argv[1]), PLACES).items():
            print(path, group)
