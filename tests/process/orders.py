#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""orders.py LINT_PACKS [--update]: the packs with every step left out once, every pair of neighbouring steps exchanged
once, every rinse, drying, cooling, venting and hazard left out once, every step done twice, every rinse elsewhere, and what the program says
of each: docs/process-orders.md, kept as a golden file that a process engineer can read. What a step that is left out was named in (a <lag> from it, a goto to it) goes with it."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKS = ("al-masked-rie", "copper-on-porous-silicon", "soi-deep-rie", "soi-double-sided", "silicon-on-glass")
HEAD = """# What is said of a flow with a step or a rinse too few or too many, or two steps in the wrong order

Every step of the packs left out once, every pair of neighbouring steps exchanged once, every rinse, drying, cooling
and venting at the end of a step and every hazard of a step left out once, every step done once more right behind itself
and at the end of its phase, which is the next strip, and every rinse done at a bench of its own
(`tests/process/orders.py`).
*refused*: an error, no plan is made. *warned*: the plan is made, and says so. *accepted*: nothing is said; the last
column has the reason why that is right. A message is the first of its case.
"""

# why nothing need be said where nothing is: of a step that is left out (id), or of a pair that is exchanged (id id)
LOOKS = "it measures and changes nothing; what it would have found stays unseen"
SHARP = "loose and free parts are sharp: no tool brings that, the pack says it"
GAS = "hydrogen comes of the current: no tool brings it, the pack says it"
FINE = {
    "S04": LOOKS, "S12": LOOKS, "S15": LOOKS, "S19": LOOKS, "S23": LOOKS, "C19": LOOKS, "C23": LOOKS, "C28": LOOKS,
    "D11": LOOKS, "D13": LOOKS, "B11": LOOKS, "B21": LOOKS, "B24": LOOKS,
    "B02 B01": "the wafer may be cleaned before it is measured", "B11 B10": "the cut may be measured with its resist",
    "B12 B11": "the cut may be measured with the primer on it", "B22 B21": "the windows may be looked at without the resist",
    "S10": "only some resists need it, and the resist is not stated",
    "S02 S01": "the wafer may be cleaned before it is measured", "C02 C01": "the wafer may be cleaned before it is measured",
    "D02 D01": "the wafer may be cleaned before it is measured",
    "S06 S05": "the primer may be there before the carrier",
    "S13 S12": "the resist may be measured after its hard bake as well",
    "S16 S15": "the aluminium may be measured without the resist as well",
    "C17": "no heat follows before the developer, and the hold is shorter than the way there",
    "C03 C02": "the bath may be mixed before the wafer is clean",
    "C04 C03": "the wafer may wait in the cell for the bath",
    "C14 C13": "the bead may be taken off before the bake",
    "C15 C14": "the resist may take up water before the bead is off",
    "D11 D10": "the cut may be measured with its resist",
    "D12 D11": "the cut may be measured after the release",
    "G16": LOOKS, "G17": LOOKS, "G29": LOOKS, "G35": LOOKS, "G40": LOOKS, "G43": LOOKS,
    "G53": "the last one: a chip may be probed instead of wired",
    "G02 G01": "the wafer may be cleaned before it is measured",
    "G04 G03": "metal is evaporated on a dry wafer, in vacuum",
    "G13 G12": "gold and chromium mask the glass by themselves, with more pinholes",
    "G17 G16": "two looks at two wafers", "G18 G17": "the wafer may be cleaned before it is measured",
    "G30 G29": "the sheet resistance may be measured after the bake as well",
    "G36 G35": "the resist may be measured after its hard bake as well",
    "G40 G39": "the aluminium may be measured with the resist as well",
    "the dry of G12": "the next step is in a liquid", "the dry of G37": "the saw is wet",
    "the rinse of G20": "solvents may be dried", "the rinse of G27": "solvents may be dried",
    "the rinse of G38": "the saw rinses with water itself", "the rinse of G46": "the other one is left",
    "rinse 2 of G46": "the first one is left",
    **{f"h.sharp of {name}": SHARP for name in "S20 S21 D13 B21 B24 G19 G44 G45 G50".split()},
    "h.hydrogen of C05": GAS, "h.hydrogen of C22": GAS,
    "h.drive of G51": "the prober brings no voltage by itself: on it other steps push and look, and only the pack says what drives",
    **{f"{name} rinsed at another bench": "solvents may be carried within the minute that they may stay" for name in "G13 G20 G27".split()},
    "G38 rinsed at another bench": "it is the saw's water",
    "G50 G49": "the device may be looked at without its tethers as well",
}


# ... of a step that is done once more
LOOKS_AGAIN = "it measures once more and changes nothing"
CLEANS = "a clean wafer is cleaned"
DRIES = "a dry wafer bears the dryer once more, and nothing else comes of it"
BAKES = "a wafer without resist bears the bake, and a resist that is developed bears it twice as long"
FINE_AGAIN = {
    **{name: LOOKS_AGAIN for name in "S04 S12 S15 S19 S23 C19 C23 C28 D11 D13 B11 B21 B24 G16 G17 G29 G35 G40 G43 G49 G51".split()},
    **{name: CLEANS for name in "S02 C06 D02 B02 G02 G18 G20".split()},
    **{name: DRIES for name in "S22 C08 C27 G47".split()},
    **{name: BAKES for name in "S13 C09 D08 B08 B19 G04 G09 G21 G30 G36".split()},
    "S06": "a primer of one molecule does not grow", "D03": "a primer of one molecule does not grow",
    "B03": "a primer of one molecule does not grow", "B12": "a primer of one molecule does not grow",
    "C03": "a second filling is mixed; none of it meets the wafer, and the bill of the lot has it",
    "C04": "mounted and looked at for leaks once more",
    "C14": "the rim is free already", "C15": "twice the time is within the day that it may wait",
    "C17": "twice the time is within what an image lasts",
    "C20": "the resist loses as much again, at the rate that its <exposed> names; the second dip takes the second oxide",
    "G38": "the blade runs in its own cut", "G48": "what is broken is apart",
    "G50": "there is no tether left", "G52": "what is glued stays", "G53": "a bonded chip bears another wire",
}


BATHS = """
## Out of one liquid into another without a rinse

Every ordered pair of the liquids of the packs, on one wafer.

| wet with | must not go into | is warned of before |
|---|---|---|
"""
MOVES = """
## Every step at every other place

Of every step moved to every place that is not its neighbour's (`FW_TEST_ALL=1 tests/process/orders.py`), those of which
nothing is said.

| flow | step | before | why that is right |
|---|---|---|---|
"""
BARE = """
## Without a single `<requires>`

The same flows, cases and moves of neighbours where a pack says nothing of the wafer that a step wants: those that are
accepted then and not above, with the reason why films, liquids and states are not asked for more. The pack's own
`<requires>` refuses each of them.

| flow | case | step | why that is all that can be known |
|---|---|---|---|
"""
SEEN = "nothing on the wafer is harmed, and what is missing is seen at once at the bench"
FINE_BARE = {
    "S10 S11": "a developed resist bears the bake; whether it needed one before is not stated of it",
    "S11 S10": "a developed resist bears the bake; whether it needed one before is not stated of it",
    "S10 once more after S16": "a wafer without resist bears the bake",
    "C14": "a spinner may take the bead off in its own recipe; the contact check of the jig finds a rim that is covered",
    "C15": "only some resists take up water again, and the resist is not stated",
    "C16 C15": "only some resists take up water again, and the resist is not stated",
    "C17 C16": "a coated resist bears the hold, and no heat follows the exposure",
    "C18 C17": "a developed resist bears the hold, and no heat follows the exposure",
    "D13 D12": "it measures what is cut; that the released device is not looked at is as without it",
    "B21 B20": "nothing is seen through a window that is not cut, and nothing is harmed",
    "B24 B23": "it measures what is cut; that the released device is not looked at is as without it",
    "G38": "a tool does not say whether it cuts or breaks, so that a step which parts the wafer may be a saw; glass that is not cut breaks anywhere",
    "G49": LOOKS, "G51": LOOKS,
    "G50": "the sheet says before use that tethers are to be broken",
    "G52": "a chip that lies loose is not bonded: " + SEEN,
    "G49 G48": "the wafer may be looked at before it is broken",
    "G51 G50": "a device that its tethers hold does not move: " + SEEN,
    "G52 G51": "the chip may be driven in its package as well",
    "G53 G52": "a chip that lies loose is not bonded: " + SEEN,
}
FINE_ELSEWHERE = {
    "S06": "the primer lies on the aluminium all the same, and is looked at with it",
    "C01": "what comes in may be measured after it was cleaned",
    "C03": "a bath may be mixed before the wafer comes in",
    "D01": "what comes in may be measured after it was cleaned",
    "D11": "the cut may be measured after the release",
    "B11": "a microscope sees the cut through the resist of the front as well, and after it",
    "B21": "the windows may be looked at when the device is free as well",
    "G16": "two looks at two wafers",
    "G17": "the second wafer may come in at any time before it is cleaned",
    "G40": "the aluminium may be measured before the glass is sawn",
}


def split(text):
    """the pack before its first step, (id, op, text) of every step, and what follows"""
    parts = re.split(r"(?=^  <step )", text, flags=re.M)
    last, tail = parts[-1].split("</step>")
    steps = parts[1:-1] + [last + "</step>\n"]
    return parts[0], [(re.search(r'id="(\w+)"', s)[1], re.search(r'title="([^"]*)"', s)[1], s) for s in steps], \
        tail.lstrip("\n")


def without_lags(text, names):
    """a step without the holds that count from those steps: they would run backwards, or from nowhere"""
    return re.sub(rf'    <lag from="({"|".join(names)})"[^>]*/>\n', "", text) if names else text


def text_of(steps):
    """all steps one after the other; what is done again when one fails is itself where the other is not done yet"""
    done, out = set(), []
    for name, _, s in steps:
        done.add(name)
        out.append(re.sub(r'goto="(\w+)"', lambda m: m[0] if m[1] in done else f'goto="{name}"', s))
    return "".join(out)


def without(steps, k):
    gone = steps[k][0]
    rest = []
    for i, (name, title, s) in enumerate(steps):
        if i == k:
            continue
        s = without_lags(s, [gone])
        rest.append((name, title, s))
    return rest


def exchanged(steps, k):
    a, b = steps[k], steps[k + 1]
    b = (b[0], b[1], without_lags(b[2], [a[0]]))
    return steps[:k] + [b, a] + steps[k + 2:]


def unfinished(steps):
    """each rinse, drying, cooling and venting at the end of a step left out, one after the other"""
    for k, (name, title, s) in enumerate(steps):
        met = {}
        for finish in re.finditer(r' *<finish kind="(\w+)"[^>]*/>\n?', s):
            kind = finish[1]
            met[kind] = met.get(kind, 0) + 1
            which = f"the {kind}" if met[kind] == 1 else f"{kind} {met[kind]}"
            yield f"without {which} of {name}", title, \
                steps[:k] + [(name, title, s[:finish.start()] + s[finish.end():])] + steps[k + 1:]


def harmless(steps):
    """each hazard of a step left out, one after the other"""
    for k, (name, title, s) in enumerate(steps):
        for hazard in re.finditer(r'<hazard-ref ref="([^"]*)"/>', s):
            yield f"without {hazard[1]} of {name}", title, \
                steps[:k] + [(name, title, s[:hazard.start()] + s[hazard.end():])] + steps[k + 1:]


def rinsed_elsewhere(head, steps):
    """what is rinsed and dried at the end of a step that is done in a liquid is so at a bench of its own: the wafer is carried there wet"""
    takes = " ".join(sorted({word for some in re.findall(r'takes="([^"]*)"', head) for word in some.split()}))
    bench = '  <equipment id="rinse-bench" class="rinse bench" capacity="99"' + (f' takes="{takes}"' if takes else "") + ">x</equipment>\n"
    place = head.rindex("</source>\n") + len("</source>\n")
    finish = re.compile(r' *<finish [^>]*?(?:/>|>[^<]*</finish>)\n?')
    for k, (name, title, s) in enumerate(steps):
        if not re.search(r'<finish kind="rinse"', s):
            continue
        own = s.split("<alternative")[0]  # another way of a later step may stand behind it
        rest = s[len(own):]
        time = re.search(r'<arg name="time" q="([^"]*)"', "".join(x for _, _, x in steps))[1]
        carried = f'''  <step id="{name}R" op="clean" title="rinse" equipment="rinse-bench" in-source="no" batch="1" attended="5">
    <purpose>x</purpose><time law="const" overrun="0" k="2"><arg name="time" q="{time}"/></time>
    <endpoint>x</endpoint><accept measure="x" lo="" hi="" unit="1" sites="1" every="1"/><on-fail if="x" then="hold">x</on-fail>
{"".join(finish.findall(own))}  </step>
'''
        yield f"{name} rinsed at another bench", title, head[:place] + bench + head[place:] + text_of(
            steps[:k] + [(name, title, finish.sub("", own) + rest), (name + "R", "rinse", carried)] + steps[k + 1:])


def copied(step):
    """the step a second time: under an id of its own, without holds, and without ids of what it derives"""
    name, title, s = step
    s = re.sub(r"    <lag [^>]*/>\n", "", s).replace(f'<step id="{name}"', f'<step id="{name}B"', 1)
    return name + "B", title, re.sub(r'(<(?:derive|time) [^>]*?) id="[^"]*"', r"\1", s)


def repeated(steps):
    """each step once more right behind itself, and once more at the end of its phase, which is the next strip"""
    ends = [k for k, (_, _, s) in enumerate(steps) if 'op="strip"' in s.split(">")[0]] + [len(steps) - 1]
    for k, step in enumerate(steps):
        end = next(e for e in ends if e >= k)
        for at in sorted({k, end}):
            later = [(n, t, s.replace(f'<lag from="{step[0]}"', f'<lag from="{step[0]}B"')) for n, t, s in steps[at + 1:]]
            case = f"{step[0]} once more" + (f" after {steps[at][0]}" if at > k else "")
            yield case, step[1], steps[:at + 1] + [copied(step)] + later


def cases(text):
    head, steps, tail = split(text)
    whole = lambda list_: head + text_of(list_) + tail
    yield "as it is", "", whole(steps)
    for k, (name, title, _) in enumerate(steps):
        yield f"without {name}", title, whole(without(steps, k))
    for k in range(len(steps) - 1):
        yield f"{steps[k + 1][0]} before {steps[k][0]}", f"{steps[k + 1][1]} / {steps[k][1]}", whole(exchanged(steps, k))
    for case, title, left in unfinished(steps):
        yield case, title, whole(left)
    for case, title, left in harmless(steps):
        yield case, title, whole(left)
    for case, title, text_ in rinsed_elsewhere(head, steps):
        yield case, title, text_ + tail
    for case, title, more in repeated(steps):
        yield case, title, whole(more)


def moved(steps):
    """(step, what it stands before, the steps) of every step at every other place but its neighbours' """
    for k, step in enumerate(steps):
        rest = steps[:k] + steps[k + 1:]
        for j in range(len(steps)):
            if abs(j - k) < 2:
                continue
            here = (step[0], step[1], without_lags(step[2], [name for name, _, _ in rest[j:]]))
            before = [(n, t, without_lags(x, [step[0]])) for n, t, x in rest[:j]]
            yield step[0], rest[j][0] if j < len(rest) else "the end", before + [here] + rest[j:]


def elsewhere(program, name, folder):
    """{step: places where nothing is said}, and how many were tried"""
    head, steps, tail = split((ROOT / f"processes/{name}.xml").read_text(encoding="utf-8"))
    fine, tried, batch = {}, list(moved(steps)), 200
    for first in range(0, len(tried), batch):
        part = tried[first:first + batch]
        files = [folder / f"{i:03d}.xml" for i in range(len(part))]
        for file, (_, _, made) in zip(files, part):
            file.write_text(head + text_of(made) + tail, encoding="utf-8")
        run = subprocess.run([program, ROOT / "processes/base.xml", *files], capture_output=True, text=True, check=True)
        for line in run.stdout.splitlines():
            cells = line.split("\t")
            if cells[1] == "accepted":
                step, before, _ = part[files.index(pathlib.Path(cells[0]))]
                fine.setdefault(step, []).append(before)
    return fine, len(tried)


def moves(program, count):
    """the last section of the page; a minute of processor time"""
    out = [MOVES]
    with tempfile.TemporaryDirectory() as kept:
        for name in PACKS:
            folder = pathlib.Path(kept) / name
            folder.mkdir()
            fine, tried = elsewhere(program, name, folder)
            for step, places in fine.items():
                if step not in FINE_ELSEWHERE:
                    count.setdefault("unexplained", []).append(f"{name}: {step} before {', '.join(places)}")
                out.append(f"| {name} | {step} | {', '.join(places)} | {FINE_ELSEWHERE.get(step, '')} |\n")
            out.append(f"| {name} | {tried} moves | all others are refused or warned of | |\n")
    return "".join(out)


def liquids():
    """id: name of every hazard that wets, of the shared pack and of all flows"""
    found = {}
    for name in ("base",) + PACKS:
        text = (ROOT / f"processes/{name}.xml").read_text(encoding="utf-8")
        for hazard in re.finditer(r'<hazard ([^>]*wets="yes"[^>]*)>', text):
            found[re.search(r'id="([^"]*)"', hazard[1])[1]] = re.search(r'name="([^"]*)"', hazard[1])[1]
    return found


def dipped(name, hazard, rinses):
    return f'''  <step id="{name}" op="clean" title="{name}" equipment="dip-{name}" in-source="no" batch="1" second-signature="yes">
    <purpose>x</purpose><time law="const" overrun="0" k="2"><arg name="time" q="inspect.t"/></time>
    <endpoint>x</endpoint><accept measure="x" lo="" hi="" unit="1" sites="1" every="1"/>
    <hazard-ref ref="{hazard}"/><on-fail if="x" then="hold">x</on-fail>{rinses}
  </step>
'''


def baths(program, count):
    """what is said where a wafer goes out of one liquid into another without a rinse, of every ordered pair"""
    of = liquids()
    head, steps, tail = split((ROOT / "processes/silicon-on-glass.xml").read_text(encoding="utf-8"))
    bench = "".join(f'  <equipment id="dip-{x}" class="bath" capacity="1">x</equipment>\n' for x in ("X1", "X2"))
    rinses = '<finish kind="rinse"/><finish kind="dry" by="spin"/>'
    pairs = [(a, b) for a in of for b in of if a != b]
    out = [BATHS]
    with tempfile.TemporaryDirectory() as kept:
        files = [pathlib.Path(kept) / f"{i:03d}.xml" for i in range(len(pairs))]
        for file, (a, b) in zip(files, pairs):
            two = dipped("X1", a, "") + dipped("X2", b, rinses)
            file.write_text(head + bench + steps[0][2] + two + "".join(s for _, _, s in steps[1:]) + tail,
                            encoding="utf-8")
        run = subprocess.run([program, ROOT / "processes/base.xml", *files], capture_output=True, text=True, check=True)
        says = {pair: "" for pair in pairs}
        for line in run.stdout.splitlines():
            cells = line.split("\t")
            pair = pairs[files.index(pathlib.Path(cells[0]))]
            if cells[2] in ("FW-D336", "FW-D503") and "step X2 brings" in cells[3]:
                says[pair] = re.search("must not meet: ([^;]*);", cells[3])[1] if cells[2] == "FW-D336" else "spoils"
    for a in of:
        refused = [f"{of[b]}: {says[a, b]}" for b in of if a != b and says[a, b] not in ("", "spoils")]
        warned = [of[b] for b in of if a != b and says[a, b] == "spoils"]
        out.append(f"| {of[a]} | {'; '.join(refused)} | {', '.join(warned)} |\n")
    for a, b in pairs:
        if not says[a, b]:
            count.setdefault("unexplained", []).append(f"{a} into {b}: nothing is said")
        if says[a, b] != says[b, a]:
            count.setdefault("unexplained", []).append(f"{a} with {b} is not {b} with {a}")
    return "".join(out)


def outcome(lines, plain):
    """what is said that is not said of the pack as it is"""
    new = [line for line in lines if line[1:] not in plain]
    errors = [line for line in new if line[1] == "error"]
    first = (errors or new or [None])[0]
    word = "refused" if errors else "warned" if new else "accepted"
    return word, first


def said(program, name, folder, keep_requires=True):
    text = (ROOT / f"processes/{name}.xml").read_text(encoding="utf-8")
    if not keep_requires:
        text = re.sub(r" *<requires [^>]*/>\n", "", text)
    made = list(cases(text))
    files = []
    for i, (_, _, text) in enumerate(made):
        files.append(folder / f"{i:03d}.xml")
        files[-1].write_text(text, encoding="utf-8")
    run = subprocess.run([program, ROOT / "processes/base.xml", *files], capture_output=True, text=True, check=True)
    lines = {}
    for line in run.stdout.splitlines():
        cells = line.split("\t")
        lines.setdefault(cells[0], []).append(cells)
    plain = {tuple(c[1:]) for c in lines[str(files[0])]}
    for (case, title, _), file in zip(made, files):
        yield case, title, *outcome([(c[0], *c[1:]) for c in lines[str(file)]],
                                    {tuple(c) for c in plain} if case != "as it is" else {("accepted",)})


def key_of(case):
    return case.replace("without ", "").replace(" before ", " ")


def reason(case):
    return FINE_AGAIN.get(case.split()[0], "") if " once more" in case else FINE.get(key_of(case), "")


def bare(program, count):
    """what only the pack's own words refuse"""
    out = [BARE]
    with tempfile.TemporaryDirectory() as kept:
        for name in PACKS:
            folder = pathlib.Path(kept) / name
            folder.mkdir()
            for case, title, word, _ in said(program, name, folder, keep_requires=False):
                if word != "accepted" or case == "as it is" or reason(case):
                    continue
                why = FINE_BARE.get(key_of(case), "")
                if not why:
                    count.setdefault("unexplained", []).append(f"{name}, no requires: {case}")
                out.append(f"| {name} | {case} | {title} | {why} |\n")
    return "".join(out)


def page(program):
    out = [HEAD]
    count = {}
    with tempfile.TemporaryDirectory() as kept:
        for name in PACKS:
            folder = pathlib.Path(kept) / name
            folder.mkdir()
            out.append(f"\n## {name}\n\n| case | step | outcome | first message |\n|---|---|---|---|\n")
            for case, title, word, first in said(program, name, folder):
                why = reason(case)
                text = f"{first[2]}: {first[3]}" if first and len(first) > 3 else why
                if word == "accepted" and case != "as it is" and not why:
                    count.setdefault("unexplained", []).append(f"{name}: {case}")
                count[word] = count.get(word, 0) + 1
                out.append(f"| {case} | {title} | {word} | {text.replace('|', '/')} |\n")
    return "".join(out), count


def main():
    text, count = page(sys.argv[1])
    golden = ROOT / "docs/process-orders.md"
    text += baths(sys.argv[1], count)
    text += bare(sys.argv[1], count)
    if os.environ.get("FW_TEST_ALL"):
        text += moves(sys.argv[1], count)
    else:
        _, heading, kept = golden.read_text(encoding="utf-8").partition(MOVES)
        text += heading + kept
    print(", ".join(f"{v} {k}" for k, v in count.items() if isinstance(v, int)))
    if "--update" in sys.argv:
        golden.write_text(text, encoding="utf-8")
    bad = count.get("unexplained", [])
    for case in bad:
        print(f"accepted without a reason in FINE: {case}")
    same = golden.exists() and golden.read_text(encoding="utf-8") == text
    if not same:
        print("docs/process-orders.md is not what the program says; look at it with --update")
    return 1 if bad or not same else 0


if __name__ == "__main__":
    sys.exit(main())
