#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every page of docs/theory and docs/theory/effects has the sections that a reader needs, a picture that exists, no line above 120
characters, and a worked example whose numbers are computed here again from its inputs, in plain Python and, where a command gives them, by the program.

    tests/docs/theory.py PROGRAM [--write]

An example is a fenced block:

    ```example
    given    r = 100 um              # an input, in the unit that stands there
    found    K = 0.68557 uN m/rad    # what the equations of the page make of the inputs
    program  K = 0.68557 uN m/rad    # what a command of the program says
    ```

A printed number may be off by half a unit of its last digit. The functions that compute it have the page's name (theory_*.py beside
this file): PAGE(given) for `found`, PAGE_program(run, given) for `program`, all in SI units; of the folder effects effect_PAGE. --write puts the computed numbers into
the pages, with as many digits as stand there."""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs/theory"
sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import theory_chance  # noqa: E402
import theory_effects  # noqa: E402
import theory_fabrication  # noqa: E402
import theory_flexures  # noqa: E402
import theory_motion  # noqa: E402

SECTIONS = ["Question", "Picture", "Equations", "Example", "Validity", "Proved and tested", "Sources"]
# a page about an effect says besides when a scene has it, and what leaving it out changes at most
EFFECT = [*SECTIONS[:3], "When it is called for", "Bound", *SECTIONS[3:]]
NO_EFFECT = {"costs", "envelope"}  # pages of that folder about all effects together
LONGEST = 120
UNITS = {"": 1, "1": 1, "%": 1e-2, "m": 1, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "rad": 1, "deg": 0.017453292519943295, "kg": 1,
         "g": 1e-3, "ug": 1e-9, "s": 1, "ms": 1e-3, "min": 60, "h": 3600, "Hz": 1, "kHz": 1e3, "N": 1, "mN": 1e-3, "uN": 1e-6,
         "Pa": 1, "MPa": 1e6, "GPa": 1e9, "A": 1, "mA": 1e-3, "C": 1, "cm": 1e-2, "mol": 1, "mg": 1e-6, "V": 1, "K": 1, "mJ": 1e-3}
LINE = re.compile(r"^(given|found|program)\s+(\w+)\s*=\s*(\S+)([^#]*?)(\s*#.*)?$")
problems = []


def factor(unit):
    """SI value of a unit such as `uN m/rad` or `um^2`: what follows a slash divides"""
    value = 1.0
    for i, part in enumerate(unit.split("/")):
        for name in part.split():
            base, _, power = name.partition("^")
            value *= UNITS[base] ** ((int(power) if power else 1) * (-1 if i else 1))
    return value


def step_of(printed):
    """half a unit of the last digit"""
    digits, _, power = printed.lower().partition("e")
    return 0.51 * 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))


def as_printed(value, like):
    if like == "?":
        return f"{value:#.5g}"
    digits, e, _ = like.lower().partition("e")
    places = len(digits.partition(".")[2])
    return f"{value:.{places}e}".replace("e-0", "e-").replace("e+0", "e") if e else f"{value:.{places}f}"


def composed(kind, name, number, unit, note):
    return f"{kind:<8} {name:<8} = {f'{number} {unit.strip()}':<20} {(note or '').strip()}".rstrip()


class Runner:
    """runs a command once and keeps its JSON document"""

    def __init__(self, program):
        self.program, self.kept = program, {}

    def __call__(self, *arguments):
        if arguments not in self.kept:
            done = subprocess.run([self.program, *arguments, "--quiet"], capture_output=True, text=True, cwd=ROOT, check=False)
            if not done.stdout:
                raise RuntimeError(f"{' '.join(arguments)}: {done.stderr.strip()}")
            self.kept[arguments] = json.loads(done.stdout) if "--json" in arguments else done.stdout
        return self.kept[arguments]


def function_of(path):
    """the name of what computes the example of a page"""
    return ("effect_" if path.parent != PAGES else "") + path.stem.replace("-", "_")


def functions(name):
    for module in (theory_flexures, theory_motion, theory_fabrication, theory_effects, theory_chance):
        if hasattr(module, name):
            return getattr(module, name), getattr(module, name + "_program", None)
    return None, None


def example(path, text, run, write):
    """the text of the page, with the numbers put in where asked for"""
    short, block = path.name, re.search(r"^```example\n(.*?)^```$", text, re.M | re.S)
    if not block:
        problems.append(f"{short} has no example block")
        return text
    compute, ask = functions(function_of(path))
    if not compute:
        problems.append(f"{short}: no function {function_of(path)} computes its example")
        return text
    lines, given = block.group(1).splitlines(), {}
    for line in lines:
        match = LINE.match(line)
        if not match or match[4].strip() and not all(re.match(r"[\w%]+(\^\d+)?$", u) for u in re.split(r"[ /]+", match[4].strip())):
            problems.append(f"{short}: this line of the example cannot be read: {line}")
            return text
        if match[1] == "given":
            given[match[2]] = float(match[3]) * factor(match[4].strip())
    values = {"found": compute(given), "program": ask(run, given) if ask else {}}
    kinds = [LINE.match(line)[1] for line in lines]
    if kinds.count("given") < 1 or kinds.count("found") < 2:
        problems.append(f"{short}: the example needs an input and two results")
    for i, line in enumerate(lines):
        kind, name, printed, unit, note = LINE.match(line).groups()
        if kind == "given":
            lines[i] = composed(kind, name, printed, unit, note)
            continue
        if name not in values[kind]:
            problems.append(f"{short}: nothing computes `{kind} {name}`")
            continue
        value = values[kind][name] / factor(unit.strip())
        if write:
            lines[i] = composed(kind, name, as_printed(value, printed), unit, note)
        elif not abs(value - float(printed)) <= step_of(printed):
            problems.append(f"{short}: {kind} {name} is {value:.9g} {unit.strip()}, the page says {printed}")
    return text[:block.start(1)] + "\n".join(lines) + "\n" + text[block.end(1):]


def page(path, run, write):
    text = path.read_text(encoding="utf-8")
    short = path.name
    headings = re.findall(r"^## (.*)$", text, re.M)
    wanted = SECTIONS if path.parent == PAGES or path.stem in NO_EFFECT else EFFECT
    if headings != wanted:
        problems.append(f"{short} has the sections {headings}, wanted are {wanted}")
        return
    parts = dict(zip(wanted, re.split(r"^## .*\n", text, flags=re.M)[1:]))
    for name, part in parts.items():
        if not part.strip():
            problems.append(f"{short}: the section {name} is empty")
    pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", parts["Picture"])
    if not pictures:
        problems.append(f"{short} shows no picture")
    for name in pictures:
        if not (path.parent / name).exists():
            problems.append(f"{short} shows {name}, which is not there")
    for name in re.findall(r"`(?:[\w./-]*/)?(test_\w+)\.(?:c|py)`", parts["Proved and tested"]) or [None]:
        if name is None:
            problems.append(f"{short} names no test")
    changed = example(path, text, run, write)
    if changed != text and write:
        path.write_text(changed, encoding="utf-8")


def main():
    write = "--write" in sys.argv[2:]
    run = Runner(sys.argv[1])
    pages = sorted(p for p in PAGES.rglob("*.md") if p.name != "README.md")
    for path in [*pages, *PAGES.rglob("README.md")]:
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if len(line) > LONGEST:
                problems.append(f"{path.name}:{number} has {len(line)} characters, {LONGEST} are allowed")
    for path in pages:
        page(path, run, write)
    print("\n".join(problems) or f"{len(pages)} pages, their examples recomputed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
