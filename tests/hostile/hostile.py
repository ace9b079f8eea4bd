#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents that somebody else wrote: refused, at their place, in little memory; or harmless in whatever opens what comes of them.

    hostile.py PROGRAM [--only REGEX] [--keep DIR]

documents.py has those that must be refused, and some that only look so. In texts (below) every text of a device, its flow,
layer table, laboratory pack, log and study says something that means more than it says to a terminal, a browser, a
spreadsheet, a calendar, a drawing program or a shell; where a file is refused for some of them, these are taken back and the
rest goes on, until it is taken; readers.py then looks at all that is written. Times are printed, not judged. KLayout, where it
is there, opens the drawings. Every fourth document and text of a log; with FW_TEST_ALL=1 (./test --all) or --all each of them."""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import documents  # noqa: E402
import readers  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAST = ["--corners", "none", "--accuracy", "3e-2", "--advice", "none", "--color", "never"]
M = readers.MARK
EVERY = 1 if os.environ.get("FW_TEST_ALL") or "--all" in sys.argv else 4

# ---- the program ----


class Ran:
    """one run: how it ended, what it said, and what it took"""

    def __init__(self, program, arguments, here, **environment):
        with tempfile.TemporaryDirectory() as name:
            out, err = pathlib.Path(name, "out"), pathlib.Path(name, "err")
            asked = {"words": [str(program), *map(str, arguments)], "here": str(here), "more": environment, "out": str(out), "err": str(err)}
            LAUNCHER.stdin.write(json.dumps(asked) + "\n")
            LAUNCHER.stdin.flush()
            self.status, self.kib, self.s = json.loads(LAUNCHER.stdout.readline())  # s: of the processor
            self.out, self.err = out.read_bytes(), err.read_bytes()


# The memory that a process took includes that of the one that began it: so runs are begun by one that holds nothing.
LAUNCH = """
import json, os, resource, sys
for line in sys.stdin:
    asked = json.loads(line)
    child = os.fork()
    if child == 0:
        os.chdir(asked["here"])
        for fd, path in ((0, "/dev/null"), (1, asked["out"]), (2, asked["err"])):
            os.dup2(os.open(path, os.O_RDWR | os.O_CREAT), fd)
        resource.setrlimit(resource.RLIMIT_CPU, (100, 110))
        os.execve(asked["words"][0], asked["words"], {**os.environ, "TERM": "xterm", **asked["more"]})
    _, status, used = os.wait4(child, 0)
    print(json.dumps([os.waitstatus_to_exitcode(status), used.ru_maxrss, used.ru_utime + used.ru_stime]), flush=True)
"""
LAUNCHER = subprocess.Popen([sys.executable, "-S", "-E", "-c", LAUNCH], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def places(ran):
    """(file, line, column, message) of each mistake that was named"""
    found = re.findall(r"^(\S[^\n:]*):(\d+):(\d+): error:([^\n]*)", ran.err.decode("utf-8", "replace"), re.M)
    return [(pathlib.Path(f).name, int(line), int(column), message) for f, line, column, message in found]


# ---- documents ----


def refusals(program, chosen, report):
    for kind in documents.KINDS[::EVERY]:
        if not chosen(kind.name):
            continue
        with tempfile.TemporaryDirectory() as name:
            here = pathlib.Path(name)
            arguments, environment = kind.make(here)
            before = {p: (p.stat().st_size, p.stat().st_mtime_ns) for p in here.rglob("*") if p.is_file()}
            ran = Ran(program, arguments, here, **environment)
            wrong = documents.judge(kind, ran)
            wrong += readers.terminal(ran.err, "standard error") + readers.terminal(ran.out, "standard output")
            if kind.refused and ran.kib > kind.most_kib:
                wrong.append(f"{ran.kib} KiB of memory")
            if kind.refused:
                wrong += [f"{p.name} was written" for p in here.rglob("*") if p.is_file() and before.get(p) != (p.stat().st_size, p.stat().st_mtime_ns)]
            outside = [p.name for p in here.parent.iterdir() if M in p.name]
            wrong += [f"{p} was written outside" for p in outside]
        report(kind.name, wrong, ran)


# ---- texts ----

TEXTS = [  # what each is for
    ("markup", f"{M}</title></text></p><script>alert(1)</script>"),
    ("an attribute's end", f"{M}\" onload=\"alert(1)\" x='' onclick='alert(2)"),
    ("a picture", f"{M}<img src=x onerror=alert(1)>"),
    ("an entity twice", f"{M}&lt;script&gt;alert(1)&lt;/script&gt;"),
    ("CDATA and comment", f"{M}]]>--><svg onload=alert(1)><!--"),
    ("an end of style", f"{M}}}</style><style>*{{display:none}}"),
    ("a link", f"javascript:alert('{M}')"),
    ("a formula", f"=HYPERLINK(\"http://127.0.0.1/{M}\")"),
    ("a formula with plus", f"+1+cmd|' /C {M}'!A0"),
    ("a formula with minus", f"-2+3+cmd|' /C {M}'!A0"),
    ("a formula with at", f"@SUM(1+1)*cmd|' /C {M}'!A0"),
    ("a formula behind a tab", f"\t=1+1+{M}"),
    ("a formula behind a blank", f" =1+1+{M}"),
    ("a formula in wide letters", f"\uff1d1+1+{M}"),
    ("a cell's end", f"{M}\",=1+1,\""),
    ("a line of CSV", f"{M}\n=1+1,{M}-forged"),
    ("a carriage return", f"\r=1+1+{M}"),
    ("a line of a message", f"{M}\n{M}-forged: error: all is well"),
    ("a calendar's line", f"{M}\r\nBEGIN:VALARM\r\nACTION:PROCEDURE\r\nEND:VALARM"),
    ("a calendar's marks", f"{M};X=1,2\\n\\,:"),
    ("a long text", f"{M} " + "\u00b5" * 700),
    ("one long word", M + "w" * 3000),
    ("an escape of C1", f"{M}\u009b31mred\u009b2J"),
    ("a title of the terminal", f"{M}\u009d0;owned\u009c"),
    ("a bell and a delete", f"{M}\x7f\x7f\x7f"),
    ("read from right to left", f"{M}\u202egpj.exe\u202c"),
    ("isolates", f"{M}\u2066\u2067{M}\u2069"),
    ("line separators", f"{M}\u2028{M}-forged\u2029{M}-forged"),
    ("nothing to be seen", f"{M}\u200b\u200d\ufeff"),
    ("other letters", f"{M}\u0430\u0435 \u05d0\u05d1 \u4e2d\u6587 \U0001f600 e\u0301\u0301\u0301\u0301"),
    ("a template of ours", f"{M}{{s}}{{r}}{{9}}{{c}}{{i}}"),
    ("a format of C", f"{M}%s%s%n%1000000d%p"),
    ("JSON", f"{M}\"}},{{\"verdict\":\"accept\"}}\\u0000"),
    ("DXF", f"{M}\n0\n{M}-forged\n0\nEOF"),
    ("STEP", f"{M}'); #1=CARTESIAN_POINT('',(0.,0.,0.)); \\X2\\0041\\X0\\"),
    ("Ruby", f"{M}#{{system('id')}}"),
    ("a shell", f"{M}$(id);`id`|id&&id>x"),
    ("a path", f"../../../{M}"),
    ("an absolute path", f"/tmp/{M}"),
    ("a path of Windows", f"C:\\{M}\\CON"),
    ("an option", f"--output={M}"),
    ("LaTeX and Markdown", f"{M}](javascript:alert(1)) \\input{{/etc/passwd}} |"),
    ("an expression", f"{M}${{7*7}}{{{{7*7}}}}<%= 7*7 %>"),
    ("XML of KLayout", f"{M}'.\"'\\'"),
]
FREE = {  # the attributes that hold words for people
    "device.xml": {"doc", "title"},
    "flow": {"title", "version", "name", "note", "class", "if", "measure", "stream"},
    "table": {"reading", "order", "name", "purpose", "source", "measure", "title"},
    "laboratory": {"title", "note", "version"},
}


def quoted(text):
    out = "".join(f"&#{ord(c)};" if ord(c) < 32 else {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"}.get(c, c) for c in text)
    return out


class Source:
    """a file of XML whose texts were exchanged, one after the other; those that are refused are taken back"""

    def __init__(self, path, names, first=0):
        self.path, self.clean = path, path.read_text(encoding="utf-8")
        bare = re.sub(r"<!--.*?-->", lambda m: " " * len(m.group()), self.clean, flags=re.S)
        spots = [(m.start(2), m.end(2)) for m in re.finditer(r'\s([\w-]+)="([^"]*)"', bare) if m[1] in names]
        spots += [(m.start(1), m.end(1)) for m in re.finditer(r">([^<>]*\w[^<>]*)</", bare)]
        self.spots = [[begin, end, TEXTS[(first + i) % len(TEXTS)]] for i, (begin, end) in enumerate(sorted(spots))]

    def write(self):
        out, at, self.where = [], 0, []
        for spot in self.spots:
            begin, end, text = spot
            out.append(self.clean[at:begin])
            start = "".join(out).encode()  # the place of the first byte, in lines and bytes
            words = self.clean[begin:end] if text is None else quoted(text[1])
            self.where.append((start.count(b"\n") + 1, len(start) - start.rfind(b"\n"), len(words.encode()), spot))
            out.append(words)
            at = end
        self.path.write_text("".join(out) + self.clean[at:], encoding="utf-8")

    def take_back(self, line, column, message):
        """what stands at a place that was refused; else what is quoted, from the element's line on; else the next"""
        on = [w for w in self.where if w[0] >= line and w[3][2]]
        hit = [w for w in on if w[0] == line and w[1] <= column <= w[1] + w[2]]
        said = [q for q in re.findall(r"'([^\n]{3,}?)'(?=[ ;,.:]|$)", message)]
        quoted = [w for w in on if any(q[:20] in w[3][2][1] for q in said)]
        hit = hit or quoted[:1] or on[:1]
        for w in hit:
            w[3][2] = None
        return hit


def settle(program, arguments, sources, here, environment, report):
    """exchanges and takes back until the files are taken; which texts stay: {name: places}"""
    refused = collections.Counter()
    for attempt in range(400):
        ran = Ran(program, arguments, here, **environment)
        wrong = readers.terminal(ran.err, "standard error") + readers.terminal(ran.out, "standard output")
        if wrong:
            report("texts: refusals", wrong, ran)
        if ran.status in (0, 1, 4):
            break
        taken = 0
        for file, line, column, message in places(ran):
            for source in sources:
                if source.path.name == file:
                    before = [s[2] for s in source.spots]
                    taken += len(source.take_back(line, column, message))
                    refused.update(b[0] for b, s in zip(before, source.spots) if b and not s[2])
        for source in sources:
            source.write()
        if not taken:
            report("texts: taken", [f"status {ran.status} with nothing left to take back: {ran.err[-600:]!r}"], ran)
            return refused, None
    left = collections.Counter(s[2][0] for source in sources for s in source.spots if s[2])
    return refused, left


def copies(here, hostile):
    """a device, its flow, layer table and a laboratory pack of our own"""
    data = here / "data"
    for name in ("processes", "masks"):
        (data / name).mkdir(parents=True)
        for path in (ROOT / name).glob("*.xml"):
            shutil.copy(path, data / name / path.name)
    text = (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text(encoding="utf-8")
    text = text.replace("<die ", '<die title="LEAF" ').replace('duration="20 ms"', 'duration="1 ms"')
    (here / "device.xml").write_text(text, encoding="utf-8")
    (here / "lab.xml").write_text(documents.LABORATORY, encoding="utf-8")
    if not hostile:
        return []
    return [Source(here / "device.xml", FREE["device.xml"]), Source(data / "processes/al-masked-rie.xml", FREE["flow"]),
            Source(data / "masks/al-masked-rie.xml", FREE["table"], 7), Source(here / "lab.xml", FREE["laboratory"], 3)]


def look_at(out, like, program, report):
    """every file that was written, as what opens it; `like`: the same of a harmless description"""
    count = 0
    for path in sorted(out.rglob("*")):
        if not path.is_file():
            continue
        data, what, other = path.read_bytes(), path.relative_to(out).as_posix(), like / path.relative_to(out)
        suffix, count, wrong = path.suffix, count + 1, []
        harmless = other.read_bytes() if other.is_file() else None
        if harmless is None:
            wrong.append(f"{what}: a file that the harmless description does not give")
        elif suffix == ".html":
            wrong = readers.page(data, what, harmless)
        elif suffix in (".svg", ".lyp", ".lyt", ".lyrdb", ".xml", ".vtu"):
            wrong = readers.xml(data, what, harmless)
        elif suffix == ".csv":
            wrong = readers.table(data, what)
        elif suffix == ".ics":
            wrong = readers.calendar(data, what, harmless)
        elif suffix == ".json":
            wrong = readers.json_document(data, what)
        elif suffix == ".dxf":
            wrong = readers.dxf(data, what)
        elif suffix in (".step", ".stp"):
            wrong = readers.step(data, what)
        elif suffix not in (".gds", ".oas", ".stl", ".png", ".sqlite"):
            wrong = readers.plain_text(data, what)
        report("texts: " + (suffix or path.name), wrong, None)
    return count


KLAYOUT = """
import pya, sys
for f in files.split(":"):
    ly = pya.Layout(); ly.read(f)
    assert ly.cells() > 0, f
    print("read", f)
"""


def drawings(out, report):
    files = [p for p in out.rglob("*") if p.suffix in (".gds", ".oas", ".dxf")]
    if not shutil.which("klayout"):
        return "KLayout is not installed"
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(KLAYOUT)
        script.flush()
        done = subprocess.run(["klayout", "-b", "-r", script.name, "-rd", "files=" + ":".join(map(str, files))],
                              capture_output=True, text=True, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, check=False)
    opened = len(re.findall("^read ", done.stdout, re.M))
    report("texts: drawings", [] if opened == len(files) else [f"{opened} of {len(files)} opened: {done.stderr[-500:]}"], None)
    return f"KLayout opened {opened} drawings"


def texts(program, report, keep):
    with tempfile.TemporaryDirectory() as name:
        where = pathlib.Path(keep or name)
        outs, said = [], ""
        for hostile in (False, True):
            here = where / ("hostile" if hostile else "harmless")
            shutil.rmtree(here, ignore_errors=True)
            here.mkdir(parents=True)
            sources = copies(here, hostile)
            for source in sources:
                source.write()
            environment = {"FLEXWRIGHT_DATA": str(here / "data")}
            common = ["--lab", "lab.xml", *FAST]
            if hostile:
                refused, left = settle(program, ["check", "device.xml", *common], sources, here, environment, report)
                if left is None:
                    return "nothing was taken"
                never = sorted(t[0] for t in TEXTS if not left[t[0]])
                said = (f"{sum(left.values())} places took {len([t for t in TEXTS if left[t[0]]])} of {len(TEXTS)} texts, "
                        f"{sum(refused.values())} refused some; nowhere taken: {', '.join(never) or 'none'}")
                report("texts: enough were taken", [] if sum(left.values()) > 100 else [said], None)
            command = ["plan", "device.xml", *common, "--force", "--mask-format", "all", "-v", "-o", "out"]
            ran = Ran(program, command, here, **environment)
            wrong = readers.terminal(ran.err, "standard error") + readers.terminal(ran.out, "standard output")
            if ran.status not in (0, 1, 4):
                wrong.append(f"plan ended with {ran.status}: {ran.err[-600:]!r}")
            report("texts: plan", wrong, ran)
            if hostile:
                laboratory(program, here, environment, report)
            outs.append(here / "out")
        if not all(o.is_dir() for o in outs):
            return said
        count = look_at(outs[1], outs[0], program, report)
        return f"{said}; {count} files were looked at; {drawings(outs[1], report)}"


def laboratory(program, here, environment, report):
    """the log, with every text in each of its words, and what it is set beside; measured values"""
    base = ["log", "device.xml", *documents.LOG_FAST, "--flow", "al-masked-rie", "--run", "lot.log"]
    entries, lost = 0, 0
    for i, (_, text) in list(enumerate(TEXTS))[::EVERY]:
        words = re.sub("[;\0]", " ", text)
        entry = f"S01; start=2026-11-01T08:00; end=2026-11-01T09:{i % 60:02d}; by=AB; note={words}; tool={words}; bath={words}"
        ran = Ran(program, [*base, "--entry", entry, "--instrument", words, "--lot", words, "--wafers", "3"], here, **environment)
        entries += ran.status == 0
        lost += ran.status != 0
        wrong = readers.terminal(ran.err, "standard error") + readers.terminal(ran.out, "standard output")
        if ran.status not in (0, 2, 3):
            wrong.append(f"log ended with {ran.status}: {ran.err[-300:]!r}")
        report("log: " + TEXTS[i][0], wrong, ran)
    if not entries:
        report("log", [f"no entry of {lost} was taken: {ran.err[-300:]!r}"], None)
        return
    ran = Ran(program, [*base, "--report", "log.html"], here, **environment)
    wrong = readers.terminal(ran.err, "standard error") + readers.terminal(ran.out, "standard output")
    page = (here / "log.html").read_bytes() if (here / "log.html").exists() else b""
    report("log: page", wrong + readers.page(page, "log.html", page) + ([] if page else ["no page"]), ran)
    ran = Ran(program, [*base, "--json"], here, **environment)
    report("log: JSON", readers.json_document(ran.out, "log --json"), ran)


# ---- all of it ----


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--keep")
    parser.add_argument("--all", action="store_true")
    o = parser.parse_args()
    program, failed, all_s, most = o.program.resolve(), 0, 0.0, [(0.0, ""), (0, "")]

    def report(name, wrong, ran):
        nonlocal failed, all_s
        for line in wrong:
            print(f"{name}: {line}", flush=True)
        failed += bool(wrong)
        all_s += ran.s if ran else 0
        if ran and not name.startswith("texts"):
            most[0] = max(most[0], (ran.s, name))
            most[1] = max(most[1], (ran.kib, name))

    def chosen(name):
        return re.search(o.only, name)

    report("readers", readers.seen(), None)
    told = f"{len(documents.KINDS)} kinds of documents and {len(TEXTS)} of texts"
    page = (ROOT / "docs/reliability.md").read_text(encoding="utf-8")
    report("docs/reliability.md", [] if told in page else [f"it does not say '{told}'"], None)
    refusals(program, chosen, report)
    kinds = len([k for k in documents.KINDS[::EVERY] if chosen(k.name)])
    said = texts(program, report, o.keep) if chosen("texts") else "no texts"
    print(f"{kinds} kinds of documents and {len(TEXTS)} of texts; {said}")
    print(f"{failed} wrong; {all_s:.0f} s of the processor, at most {most[0][0]:.2f} s ({most[0][1]}); most memory {most[1][0] / 1024:.0f} MiB ({most[1][1]})")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
