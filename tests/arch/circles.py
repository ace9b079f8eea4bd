#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""circles.py BUILD: no source calls one that calls it back, by however many others between. Read from the objects of
the libraries of the rooms (libfw_*.a): who defines which external name, who needs it. A reader who begins with any file
and goes down comes to an end. A helper that two files of a family need stands in a third, below both."""
import pathlib
import re
import subprocess
import sys

LINE = re.compile(r"^(?P<where>\S+): *[0-9a-f]* (?P<kind>[A-Za-z]) (?P<name>\S+)$")


def needs(build):
    """{source: {source that it needs: names}}, each source as ROOM/FILE"""
    libraries = sorted(build.glob("libfw_*.a"))
    if not libraries:
        sys.exit(f"{build} has no libraries of rooms")
    said = subprocess.run(["nm", "-A", "-g", *libraries], capture_output=True, text=True, check=True).stdout
    defined, wanted = {}, []
    for line in said.splitlines():
        found = LINE.match(line)
        if not found:
            continue
        library, member = found["where"].rsplit(":", 1)
        source = pathlib.Path(library).stem.removeprefix("libfw_") + "/" + member.removesuffix(".o")
        if found["kind"] == "U":
            wanted.append((source, found["name"]))
        elif found["kind"] in "TRDBV":
            defined[found["name"]] = source
    arrows = {}
    for source, name in wanted:
        at = defined.get(name, source)
        if at != source:
            arrows.setdefault(source, {}).setdefault(at, set()).add(name)
    return arrows


def circles(arrows):
    """strongly connected sets of more than one source (R. Tarjan, SIAM J. Comput. 1 (1972) 146)"""
    order, low, stack, found = {}, {}, [], []

    def visit(source):
        order[source] = low[source] = len(order)
        stack.append(source)
        for other in arrows.get(source, ()):
            if other not in order:
                visit(other)
                low[source] = min(low[source], low[other])
            elif other in stack:
                low[source] = min(low[source], order[other])
        if low[source] == order[source]:
            at = stack.index(source)
            if len(stack) - at > 1:
                found.append(set(stack[at:]))
            del stack[at:]

    for source in sorted(arrows):
        if source not in order:
            visit(source)
    return found


def main():
    sys.setrecursionlimit(10000)
    # tried on a circle of three and a file beside it
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) == [{"a", "b", "c"}]
    arrows = needs(pathlib.Path(sys.argv[1]))
    if len(arrows) < 200:
        sys.exit(f"only {len(arrows)} sources need another: the names are not read")
    found = circles(arrows)
    for circle in found:
        print(f"a circle of {len(circle)}:")
        for source in sorted(circle):
            for other in sorted(circle & arrows.get(source, {}).keys()):
                print(f"  {source} needs of {other}: {', '.join(sorted(arrows[source][other]))}")
    print(f"{len(arrows)} sources, {len(found)} circles")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
