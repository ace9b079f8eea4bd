# SPDX-License-Identifier: GPL-3.0-or-later
"""What opens the program's files, as far as it matters to somebody who hides something in a title: a spreadsheet, a browser, a
calendar, a terminal, a layout viewer, a CAD program. Each function gives a list of what is wrong, with the place."""
import csv
import html.parser
import io
import json
import re
import xml.etree.ElementTree as ET

MARK = "zqx"  # in every hostile text, so that it is found wherever it comes out
# bytes and characters that move the cursor, ring, or turn the order of what is read round
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]")
FORGED = re.compile(rf"^\s*{MARK}-forged", re.I | re.M)  # a hostile text that has begun a line of its own
NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)(e[-+]?\d+)?$", re.I)


def decoded(data, what):
    try:
        return data.decode("utf-8"), []
    except UnicodeDecodeError as error:
        return data.decode("utf-8", "replace"), [f"{what}: not UTF-8 at byte {error.start}"]


def plain_text(data, what, forged=True):
    text, wrong = decoded(data, what)
    found = CONTROL.search(text)
    if found:
        wrong.append(f"{what}: U+{ord(found.group()):04X} in {text[max(0, found.start() - 40):found.end() + 40]!r}")
    if forged and FORGED.search(text):
        wrong.append(f"{what}: a line that nobody wrote: {FORGED.search(text).group()!r}")
    return wrong


def terminal(data, what):
    """escapes of our own colours are taken out first; tests ask for none"""
    return plain_text(data, what)


def table(data, what):
    """RFC 4180; as many fields everywhere; no cell that a spreadsheet would compute"""
    wrong = plain_text(data, what)
    rows = list(csv.reader(io.StringIO(data.decode("utf-8", "replace"), newline=""), strict=True))
    for i, row in enumerate(rows):
        if len(row) != len(rows[0]):
            wrong.append(f"{what}: row {i + 1} has {len(row)} fields, the first {len(rows[0])}")
        for cell in row:
            if re.match("[=+\\-@\t\r\uff1d\uff0b\uff0d\uff20]", cell.lstrip(" \n")) and not NUMBER.match(cell):
                wrong.append(f"{what}: row {i + 1} has the formula {cell[:60]!r}")
    return wrong


class Page(html.parser.HTMLParser):
    """the elements with their attributes' names, and what a browser would run or fetch"""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.elements, self.runs, self.words, self.inside = {}, [], [], None

    def handle_starttag(self, tag, attrs):
        self.inside = tag
        for name, value in attrs or [("", "")]:
            self.elements[tag, name] = self.elements.get((tag, name), 0) + 1
            value = (value or "").strip().lower()
            if name.startswith("on") or (name in ("href", "src", "action", "data", "xlink:href") and
                                         not re.match(r"#|data:image/png|[\w./-]*$|https?://", value)):
                self.runs.append(f"<{tag} {name}={value[:60]!r}>")
            if MARK in name or MARK in tag or (name in ("style", "id", "class", "href", "src") and MARK in value):
                self.runs.append(f"<{tag} {name}={value[:60]!r}>")

    handle_startendtag = handle_starttag

    def handle_endtag(self, tag):
        self.inside = None

    def handle_comment(self, data):
        if MARK in data.lower():
            self.runs.append("a comment with " + data[:60])

    def handle_data(self, data):
        if self.inside in ("script", "style") and MARK in data.lower():
            at = data.lower().index(MARK)
            self.words.append(data[max(0, at - 30):at + 60])


def page(data, what, like):
    """`like`: the same page of a harmless description; its scripts, styles and fetching elements are all there may be"""
    text, wrong = decoded(data, what)
    pages = []
    for source in (text, like.decode("utf-8", "replace")):
        p = Page()
        p.feed(source)
        pages.append(p)
    got, want = pages
    wrong += [f"{what}: {run}" for run in got.runs]
    for kind in sorted(set(got.elements) - set(want.elements)):
        wrong.append(f"{what}: <{kind[0]} {kind[1]}> is in no harmless page")
    active = ("script", "style", "iframe", "object", "embed", "link", "base", "meta", "form", "img", "svg", "a")
    for tag in active:
        counts = [sum(n for (t, _), n in p.elements.items() if t == tag) for p in pages]
        if counts[0] != counts[1] and tag != "a":
            wrong.append(f"{what}: {counts[0]} of <{tag}>, in the harmless page {counts[1]}")
    for words in got.words:  # of a name inside a CSS string or JSON: nothing that ends either
        if re.search(r"[<>\\]|\*/", words[words.lower().index(MARK):]):
            wrong.append(f"{what}: in a script or style: {words!r}")
    return wrong + plain_text(data, what, forged=False)


def xml(data, what, like=None):
    """well-formed, and of no element or attribute that a harmless one has not"""
    wrong = plain_text(data, what, forged=False)
    names = []
    for source in (data, like or data):
        try:
            root = ET.fromstring(source)
        except ET.ParseError as error:
            return wrong + [f"{what}: {error}"]
        names.append({(e.tag, a) for e in root.iter() for a in ["", *e.attrib]})
        if source is data:
            for e in root.iter():
                for name, value in e.attrib.items():
                    plain = name.rpartition("}")[2].lower()
                    if plain.startswith("on") or (plain in ("href", "src") and not value.startswith(("#", "data:image/png"))):
                        wrong.append(f"{what}: <{e.tag} {name}={value[:60]!r}>")
    wrong += [f"{what}: <{tag} {name}> is in no harmless file" for tag, name in sorted(names[0] - names[1])]
    return wrong


def calendar(data, what, like):
    """RFC 5545: lines of at most 75 bytes that end with CRLF, no property or component that nobody wrote"""
    wrong, seen = [], []
    if not data.endswith(b"\r\n") or re.search(rb"(?<!\r)\n|\r(?!\n)", data):
        wrong.append(f"{what}: a line break that is no CRLF")
    wrong += [f"{what}: {len(line)} bytes in a line" for line in data.split(b"\r\n") if len(line) > 75]
    for source in (data, like):
        lines = source.decode("utf-8", "replace").replace("\r\n ", "").replace("\r\n\t", "").split("\r\n")[:-1]
        names = [re.match(r"([A-Z-]+)[;:]", line) for line in lines]
        seen.append([m.group(1) if m else line[:40] for m, line in zip(names, lines)])
        if source is data:
            wrong += plain_text("\n".join(lines).encode(), what)
            for line in lines:
                value = line.partition(":")[2]
                if line.startswith(("SUMMARY", "DESCRIPTION", "LOCATION")) and re.search(r"(?<!\\)(?:\\\\)*[;,]", value):
                    wrong.append(f"{what}: not escaped: {line[:80]!r}")
    if seen[0] != seen[1]:
        wrong.append(f"{what}: properties differ: {[a for a in seen[0] if a not in seen[1]][:5]}")
    return wrong


def json_document(data, what):
    def once(pairs):
        if len({k for k, _ in pairs}) != len(pairs):
            raise ValueError("a key twice")
        return dict(pairs)
    text, wrong = decoded(data, what)
    try:
        json.loads(text, object_pairs_hook=once, parse_constant=lambda word: (_ for _ in ()).throw(ValueError(word)))
    except ValueError as error:
        wrong.append(f"{what}: {error}")
    return wrong


def dxf(data, what):
    """group codes and values in turn"""
    wrong = plain_text(data, what)
    lines = data.decode("utf-8", "replace").split("\n")
    codes = lines[:-1:2]
    for i, code in enumerate(codes):
        if not re.match(r"\s*\d+$", code):
            return wrong + [f"{what}: line {2 * i + 1} is no group code: {code[:40]!r}"]
    if lines[-2:] != ["EOF", ""]:
        wrong.append(f"{what}: it does not end with EOF")
    return wrong


def step(data, what):
    """ISO 10303-21: every line of the data section is one entity once its strings are taken out"""
    text, wrong = decoded(data, what)
    bare = re.sub(r"'(?:[^']|'')*'", "''", text)
    body = bare[bare.index("DATA;") + 5:bare.index("ENDSEC;\nEND-ISO-10303-21;")]
    for entity in body.strip().split(";\n"):
        if entity and not re.match(r"#\d+=[A-Z_0-9]*\([^;']*(''[^;']*)*\)\s*;?$", entity.strip()):
            wrong.append(f"{what}: {entity.strip()[:80]!r}")
    if any(ord(c) > 126 or (ord(c) < 32 and c != "\n") for c in text):
        wrong.append(f"{what}: a character that STEP does not have")
    return wrong


def seen():
    """each reader finds what it is there for: those that it does not find"""
    calm = b"<html><head><style>a{}</style><script>1</script></head><body><p class='x'>a</p></body></html>"
    ics = b"BEGIN:VCALENDAR\r\nSUMMARY:a\\, b\r\nEND:VCALENDAR\r\n"
    cases = {
        "an escape": (plain_text, b"a\x1b[31m"), "C1": (plain_text, "a\u009b2J".encode()), "Latin-1": (plain_text, b"\xb5m"),
        "right to left": (terminal, "a\u202eb".encode()), "a forged line": (terminal, f"a\n{MARK}-forged: error".encode()),
        "a formula": (table, b"a,b\n1,=1+1\n"), "a row too long": (table, b"a,b\n1,2,3\n"), "a wide formula": (table, "a\n\uff1d1\n".encode()),
        "a script": (page, calm.replace(b"a</p>", b"<script>1</script></p>"), calm),
        "an attribute": (page, calm.replace(b"class='x'", b"class='x' onload='1'"), calm),
        "a link": (page, calm.replace(b"a</p>", b"<a href='javascript:1'>a</a></p>"), calm.replace(b"a</p>", b"<a href='#a'>a</a></p>")),
        "an end of style": (page, calm.replace(b"a{}", f"{MARK}*/<".encode()), calm),
        "no XML": (xml, b"<a><b></a>"), "an element": (xml, b"<a><script/></a>", b"<a/>"), "a call": (xml, b"<a onload='1'/>"),
        "a property": (calendar, ics.replace(b"END", b"ATTACH:x\r\nEND"), ics), "a bare line end": (calendar, ics.replace(b"\r\nEND", b"\nEND"), ics),
        "not escaped": (calendar, ics.replace(b"\\,", b","), ics), "a long line": (calendar, ics.replace(b"a", b"a" * 90), ics),
        "a key twice": (json_document, b'{"a": 1, "a": 2}'), "no number": (json_document, b'{"a": NaN}'),
        "no code": (dxf, b"0\nSECTION\nx\ny\n0\nEOF\n"), "no end": (dxf, b"0\nSECTION\n"),
        "an entity": (step, b"DATA;\n#1=A('x');\nPWN;\nENDSEC;\nEND-ISO-10303-21;"),
    }
    fine = [(plain_text, "a \u00b5m\n".encode()), (table, b'a,b\n-1.5e3,"\'=1, 2"\n'), (page, calm, calm), (xml, b"<a b='1'/>"), (calendar, ics, ics),
            (json_document, b'{"a": 1}'), (dxf, b"0\nSECTION\n0\nEOF\n"), (step, b"DATA;\n#1=A('it''s; x');\nENDSEC;\nEND-ISO-10303-21;")]
    missed = [name for name, (reader, data, *like) in cases.items() if not reader(data, "sample", *like)]
    return missed + [f"{reader.__name__} of what is fine: {reader(data, 'sample', *like)}" for reader, data, *like in fine if reader(data, "sample", *like)]
