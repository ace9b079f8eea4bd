# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents of a stranger, by kind: what must be refused with a message at its place, and what looks dangerous and is not."""
import gzip
import hashlib
import pathlib
import re
import shutil
import struct

M = "zqx"
ROOT = pathlib.Path(__file__).resolve().parents[2]
LEAF = (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text(encoding="utf-8")
FLOW = "al-masked-rie"
LABORATORY = """<?xml version="1.0" encoding="UTF-8"?>
<process xmlns="urn:flexwright:process:1" flow="al-masked-rie" id="ours" version="1" title="our values">
  <source id="bench" kind="measured" date="2026-11-01">our bench</source>
  <q id="pan.R" value="60" u="2" unit="nm/min" status="measured" src="bench" note="three wafers"/>
</process>
"""
KINDS = []
FAST = ["--corners", "none", "--accuracy", "3e-2", "--advice", "none", "--color", "never"]
LOG_FAST = ["--corners", "none", "--accuracy", "3e-2", "--color", "never"]


class Kind:
    """make(here) writes the files and gives (arguments, environment); refused: an exit status of 3 or 6 (of an option 2, too), with a number;
    None: refused or harmless"""

    def __init__(self, name, make, refused, says=""):
        self.name, self.make, self.refused, self.says = name, make, refused, says
        # as many elements, and as many polygons, as a file may have are in memory before the next one is refused
        self.most_kib = 1024 * (160 if name in ("50000 bodies", "a drawing: arrays of arrays") else 64)


def judge(kind, ran):
    said = ran.err.decode("utf-8", "replace")
    wrong = []
    if ran.status not in {True: (2, 3) if kind.name.startswith("an option") else (3, 6), False: (0, 1, 4), None: (0, 1, 2, 3, 4, 6)}[kind.refused]:
        wrong.append(f"status {ran.status}: {said[-400:]!r}")
    if kind.refused and not re.search(r"error: .*\[FW-D\d{3}\]", said, re.S):
        wrong.append(f"no message with a number: {said[-400:]!r}")
    if kind.refused and kind.says and not re.search(kind.says, said):
        wrong.append(f"it does not say {kind.says!r}: {said[-400:]!r}")
    return wrong


def device(name, text, refused=True, says="", files=None, command="check", more=()):
    def make(here):
        (here / "device.xml").write_bytes(text if isinstance(text, bytes) else text.encode())
        for file, data in (files or {}).items():
            (here / file).parent.mkdir(parents=True, exist_ok=True)
            (here / file).write_bytes(data if isinstance(data, bytes) else data.encode())
        output = ["-o", "out"] if command in ("plan", "mask", "recipe") else []
        return [command, "device.xml", *FAST, *output, *more], {}
    KINDS.append(Kind(name, make, refused, says))


def leaf(old, new):
    assert old in LEAF, old
    return LEAF.replace(old, new, 1)


# ---- XML ----

HEAD = '<?xml version="1.0"?>\n'
DEVICE = '<device xmlns="urn:flexwright:device:1" name="d">'
device("a billion laughs", HEAD + '<!DOCTYPE d [<!ENTITY a "ha">' + "".join(
    f'<!ENTITY a{i} "{("&a" + str(i - 1 if i > 1 else "") + ";") * 10}">' for i in range(1, 10)) + "]><d>&a9;</d>", says="D004")
device("one entity, long and often", HEAD + f'<!DOCTYPE d [<!ENTITY a "{"x" * 100000}">]><d>{"&a;" * 10000}</d>', says="D004")
device("an entity of a file", HEAD + '<!DOCTYPE d [<!ENTITY x SYSTEM "file:///etc/passwd">]><d name="&x;"/>', says="D004")
device("an entity of the network", HEAD + '<!DOCTYPE d [<!ENTITY x SYSTEM "http://127.0.0.1:9/x">]><d>&x;</d>', says="D004")
device("a parameter entity", HEAD + '<!DOCTYPE d [<!ENTITY % x SYSTEM "/etc/hostname"> %x;]><d/>', says="D004")
device("a default by DTD", HEAD + '<!DOCTYPE device [<!ATTLIST body mass CDATA "1 kg">]>' + LEAF.partition("?>")[2], says="D004")
device("an entity without a DTD", leaf('name="push"', 'name="&push;"'), says="D005")
device("a stylesheet", leaf("<device", '<?xml-stylesheet href="x.xsl"?><device'), says="D006")
device("XInclude", leaf("<limits", '<x:include xmlns:x="http://www.w3.org/2001/XInclude" href="/etc/passwd"/><limits'))
device("an element of another namespace", leaf("<limits", '<script xmlns="http://www.w3.org/1999/xhtml">alert(1)</script><limits'))
device("nested without end", "<a>" * 400000, says="D007")
device("elements without end", "<d>" + "<a/>" * 1000000 + "</d>", says="D008")
device("attributes without end", "<d " + " ".join(f'a{i}="1"' for i in range(300000)) + "/>", says="D009")
device("attributes of one name", "<d " + 'a="1" ' * 60 + "/>", says="D013")
device("a value without end", f'<d a="{"x" * 8000000}"/>', says="D010")
device("a name of an element without end", "<" + "x" * 4000000 + "/>")
device("a comment without end", "<d><!--" + "x" * 8000000 + "</d>", says="D011")
device("CDATA without end", "<d><![CDATA[" + "]" * 4000000)
device("nothing but blanks", b" " * 8000000)
device("larger than may be", b"<d>" + b" " * (9 << 20) + b"</d>")
device("a sparse file of a terabyte", "")
KINDS.pop()  # below, where the file is made sparse
device("UTF-16", LEAF.encode("utf-16"), says="D003")
device("UTF-32", LEAF.encode("utf-32"))
device("UTF-7", leaf('encoding="UTF-8"', 'encoding="UTF-7"'), says="D003")
device("EBCDIC", LEAF.encode("cp500"))
device("Latin-1", leaf('name="push"', 'name="p\u00fcsh"').encode("latin-1"), says="D003")
device("an overlong slash", leaf('name="push"', 'name="@"').encode().replace(b'"@"', b'"\xc0\xaf"'), says="D003")
device("half of a surrogate", leaf('name="push"', 'name="@"').encode().replace(b'"@"', b'"\xed\xa0\x80"'), says="D003")
device("NUL", leaf('name="push"', 'name="pu\0sh"'), says="D002")
device("gzip in place of XML", gzip.compress(LEAF.encode(), mtime=0))
device("a bomb of gzip", gzip.compress(b" " * 50_000_000, mtime=0))
device("an archive", b"PK\x03\x04" + b"\0" * 1000)
device("a program", b"\x7fELF\x02\x01\x01" + b"\0" * 1000)

# ---- characters that a terminal takes for orders ----

for title, character in (("ESC", "\x1b[2J"), ("a bell", "\a"), ("a backspace", "\b\b\b\b"), ("DEL", "\x7f"), ("CSI of C1", "\u009b2J"),
                         ("OSC of C1", "\u009d0;owned\u009c"), ("a right-to-left override", "\u202e"), ("an isolate", "\u2067")):
    for how, text in (("", character), (" as a reference", "".join(f"&#x{ord(c):x};" for c in character))):
        device(f"{title} in a name{how}", leaf('name="push"', f'name="{M}{text}"'))
        device(f"{title} in words{how}", leaf('doc="width of every leaf"', f'doc="{M}{text}"'))
device("a line break in a name", leaf('name="push"', f'name="{M}&#10;{M}-forged: error: none"'))
device("a carriage return in a name", leaf('name="push"', f'name="{M}&#13;{M}-forged: error: none"'))
device("ESC in an unknown element", leaf("<limits", "<\x1b[31m/><limits"))
device("ESC in what is no XML", "\x1b[31m\x1b]0;owned\a")
device("C1 in an unknown unit", leaf('value="8 um"', 'value="8 \u009bm"'))
device("a broken character where a message ends", leaf('name="push"', f'name="{"x" * 79}\u00b5{"y" * 40}"'))

# ---- numbers ----

device("a width of two signs", leaf('value="8 um"', 'value="--8 um"'), refused=None)
for number in ("1e309 um", "-1e309 um", "1e999999999999 um", "1e-999999999999 um", "nan um", "inf um", "0x10 um", "1_000 um", "1,5 um",
               "8 um / 0", "0/0", "(8 um)^1e9", "9^9^9^9 * 1 um", "8 um^999999999", "sqrt(-1) * 1 um", "8 \u00b5m\u0660", "\u0668 um", "8e um",
               "8 um um", "8 um; rm -rf /", "width", "leaf", "", "-0 um", "%n um", "{s} um"):
    device(f"a width of {number!r}", leaf('value="8 um" min="6 um" max="16 um"', f'value="{number}"'))
device("a number of 4000 digits", leaf('value="8 um"', f'value="{"8" * 3990} um"'))
device("brackets, as many as fit", leaf('value="8 um"', f'value="{"(" * 2000}8 um{")" * 2000}"'))
device("signs, as many as fit", leaf('value="8 um"', f'value="{"-" * 4000}8 um"'))
device("parameters in a circle", leaf("<material", '<parameter name="a" value="b"/><parameter name="b" value="a"/><material'))
device("5000 parameters in a row", leaf("<material", "".join(f'<parameter name="p{i}" value="{f"p{i-1}" if i else "1 um"} + 1 um"/>'
                                                              for i in range(5000)) + "<material"), refused=None)
device("parameters that double", leaf("<material", "".join(f'<parameter name="p{i}" value="{f"p{i-1}*p{i-1}" if i else "1e9"}"/>'
                                                            for i in range(40)) + "<material"))
device("50000 bodies", leaf("<revolute", "".join(f'<body id="b{i}" x="0 mm" y="{i} nm" width="9 um"/>' for i in range(50000)) + "<revolute"),
       more=("--time-limit", "5"))
device("a million copies", leaf('<body id="crank" x="0 mm" y="0.75 mm" width="120 um"/>',
                                '<body id="crank" x="0 mm" y="0.75 mm" mass="1 mg" inertia="1e-12 kg m^2"><disc radius="1 um" copies="1000000" '
                                'pitch-x="2 um" hole="yes"/></body>'))
device("a comb of a billion fingers", leaf('<gravity', '<comb-drive id="c" kind="comb" on="coupler" direction="0 deg" fingers="1000000000" '
                                           'gap="1 um" overlap="1 um" voltage="1 V"/><gravity'))
device("a scene of a million years", leaf('duration="20 ms"', 'duration="3e13 s"'))
device("a scene of 1e12 periods", leaf('fx="0.06 mN"', 'fx="0.06 mN" law="sine" frequency="1e14 Hz"'))

# ---- names ----

for name in ("../../zqx", "/etc/zqx", "a/b", "a\\b", ".", "..", "-o", "con:", "a b", "a;b", "a|b", "$(id)", "`id`", "a'b", "&lt;script&gt;",
             "&quot;&gt;x", "=1+1", "%n%n", "{s}{r}", "\u0430bc", "a\u200bb", "x" * 65, "x" * 4000, ""):
    device(f"a device called {name[:20]!r}{'...' if len(name) > 20 else ''}", leaf('name="leaf-four-bar"', f'name="{name}"'))
device("a scene called ../../zqx", leaf('name="push"', 'name="../../zqx"'), command="plan")
device("a flow called ../../etc/passwd", leaf('<flow ref="al-masked-rie"', '<flow ref="../../etc/passwd"'))
device("a material called ../base", leaf('ref="silicon-100"', 'ref="../base"'))

# ---- drawings ----


def record(kind, data=b""):
    data += b"\0" * (len(data) % 2)
    return struct.pack(">HH", len(data) + 4, kind) + data


def ints(*values):
    return b"".join(struct.pack(">i", v) for v in values)


def square(layer=1, size=30000):
    return (record(0x0800) + record(0x0D02, struct.pack(">h", layer)) + record(0x0E02, b"\0\0") +
            record(0x1003, ints(0, 0, size, 0, size, size, 0, size, 0, 0)) + record(0x1100))


def cell(name, body):
    return record(0x0502, b"\0" * 24) + record(0x0606, name) + body + record(0x0700)


UNITS = record(0x0305, bytes.fromhex("3e4189374bc6a7f03944b82fa09b5a54"))


def library(*cells, units=UNITS):
    return record(0x0002, struct.pack(">h", 600)) + record(0x0102, b"\0" * 24) + record(0x0206, b"LIB") + units + b"".join(cells) + record(0x0400)


def sref(name, x=0, y=0):
    return record(0x0A00) + record(0x1206, name) + record(0x1003, ints(x, y)) + record(0x1100)


def aref(name, columns, rows, pitch=100000):
    return (record(0x0B00) + record(0x1206, name) + record(0x1302, struct.pack(">HH", columns, rows)) +
            record(0x1003, ints(0, 0, columns * pitch, 0, 0, rows * pitch)) + record(0x1100))


def drawn(name, data, file="logo.gds", refused=True, says="", asked=None):
    text = leaf("<die ", f'<cell file="{asked or file}" x="0.9 mm" y="-0.6 mm"/><die ')
    device("a drawing: " + name, text, refused, says, {file: data} if data is not None else {}, command="mask", more=("--force",))


for path in ("../../../etc/passwd", "/etc/passwd", "C:\\logo.gds", "a/../../logo.gds", "./logo.gds", "logo.gds/", "", "~/.bashrc", "file:///etc/passwd",
             "a//b", "http://127.0.0.1/x", "\u202elogo.gds"):
    drawn(f"at {path!r}", None, asked=path)
drawn("a directory", b"", file="logo.gds/inside", asked="logo.gds")
drawn("empty", b"")
drawn("neither of the formats", b"\x89PNG\r\n\x1a\n" + b"\0" * 100)
drawn("a record of no length", library(cell(b"A", square())).replace(record(0x1100), b"\0\0\x11\0", 1))
drawn("a record of odd length", library(cell(b"A", square()))[:100] + b"\0\x05\x11\0\0")
drawn("a record beyond the end", library(cell(b"A", square()))[:-10])
drawn("no end", library(cell(b"A", square()))[:-4])
drawn("bytes behind the end", library(cell(b"A", square())) + b"\x1b[31m" * 1000, refused=None)
drawn("a cell in itself", library(cell(b"A", sref(b"A") + square())))
drawn("cells in a circle", library(cell(b"A", sref(b"B")), cell(b"B", sref(b"A") + square()), cell(b"C", sref(b"A"))))
drawn("cells that double, 40 deep", library(cell(b"c0", square()), *(cell(b"c%d" % i, sref(b"c%d" % (i - 1)) * 2) for i in range(1, 41))))
drawn("cells that double, 25 deep", library(cell(b"c0", square()), *(cell(b"c%d" % i, sref(b"c%d" % (i - 1)) * 2) for i in range(1, 26))))
drawn("cells of nothing that double", library(cell(b"c0", b""), *(cell(b"c%d" % i, sref(b"c%d" % (i - 1)) * 2) for i in range(1, 31))))
drawn("an array of 32767 by 32767", library(cell(b"A", square(size=10)), cell(b"B", aref(b"A", 32767, 32767, 1))))
drawn("arrays of arrays", library(cell(b"A", square(size=10)), cell(b"B", aref(b"A", 999, 999, 50)), cell(b"C", aref(b"B", 999, 999, 9))))
drawn("a reference to nothing", library(cell(b"A", sref(b"GONE"))))
drawn("points of 2^31", library(cell(b"A", square(size=2**31 - 1))))
drawn("a unit of nothing", library(cell(b"A", square()), units=record(0x0305, b"\0" * 16)))
drawn("a unit of 1e60 m", library(cell(b"A", square()), units=record(0x0305, b"\x7f" + b"\xff" * 7 + b"\x7f" + b"\xff" * 7)))
drawn("an escape for a name", library(cell(b"\x1b[31m\x9b2J\xff", sref(b"\x1b]0;x\x07") + square())))
drawn("a name of 65000 bytes", library(cell(b"A" * 65000, sref(b"B" * 65000))))
drawn("200 000 cells", library(*(cell(b"c%d" % i, b"") for i in range(200000))))
drawn("gzip", gzip.compress(library(cell(b"A", square())), mtime=0))
drawn("OASIS", b"%SEMI-OASIS\r\n" + b"\0" * 100)


def groups(*pairs):
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def entities(body, end="0\nENDSEC\n0\nEOF\n"):
    return groups((0, "SECTION"), (2, "ENTITIES")) + body + end


LINE = groups((0, "LWPOLYLINE"), (8, "L"), (90, 3), (70, 1), (10, 0), (20, 0), (10, 30), (20, 0), (10, 0), (20, 30))


def dxf(name, data, refused=True, says=""):
    drawn("of DXF: " + name, data, "logo.dxf", refused, says)


dxf("a code that is no number", entities(LINE).replace("90\n", "\x1b[31m\n", 1))
dxf("no end", entities(LINE * 3, ""), refused=None)
dxf("coordinates of 1e308", entities(LINE.replace("\n30\n", "\n1e308\n")))
dxf("coordinates of nan", entities(LINE.replace("\n30\n", "\nnan\n")))
dxf("a bulge of 1e300", entities(LINE.replace("20\n0\n", "20\n0\n42\n1e300\n", 1)))
dxf("a layer of escapes", entities(LINE.replace("8\nL\n", "8\n\x1b[31m\u009b2J\u202e\n") + LINE))
dxf("two million points", entities(groups((0, "LWPOLYLINE"), (8, "L"), (70, 1)) + "10\n0\n20\n0\n" * 1000000))
dxf("a line without end", "0\nSECTION\n2\n" + "E" * 8000000)
dxf("nothing but codes", "0\n" * 2000000)
dxf("of binary", b"AutoCAD Binary DXF\r\n\x1a\0" + b"\0" * 100)

# ---- flows, layer tables and laboratory packs ----


def pack(name, old, new, where="processes", refused=True, says="", command="recipe"):
    def make(here):
        for folder in ("processes", "masks"):
            (here / "data" / folder).mkdir(parents=True)
            for path in (ROOT / folder).glob("*.xml"):
                shutil.copy(path, here / "data" / folder / path.name)
        path = here / "data" / where / f"{FLOW}.xml"
        text = path.read_text(encoding="utf-8")
        assert old in text, (name, old)
        path.write_text(text.replace(old, new), encoding="utf-8")
        (here / "device.xml").write_text(LEAF.replace("20 ms", "1 ms"), encoding="utf-8")
        return [command, "device.xml", *FAST, "--force", "-o", "out"], {"FLEXWRIGHT_DATA": str(here / "data")}
    KINDS.append(Kind(f"a {'flow' if where == 'processes' else 'layer table'}: {name}", make, refused, says))


for bad in ("../../zqx", "S&#13;&#10;BEGIN:VALARM", "S,=1+1", "&lt;script&gt;", "S 1", "", "=1+1", "x" * 5000, "S\u202e"):
    pack(f"a step called {bad[:24]!r}", 'id="S12"', f'id="{bad}"')
    pack(f"itself called {bad[:24]!r}", '<process xmlns="urn:flexwright:process:1" id="al-masked-rie"',
         f'<process xmlns="urn:flexwright:process:1" id="{bad}"')
    pack(f"a material called {bad[:24]!r}", '<step id="S02"', f'<material id="{bad}" name="x"/><step id="S02"')
pack("a number of 1e999", 'id="spin.t" value="60"', 'id="spin.t" value="1e999"')
pack("an uncertainty below nothing", 'id="spin.t" value="60" u="1"', 'id="spin.t" value="60" u="-1"')
pack("a rate of nothing", 'value="10" urel="0.1" unit="Ao/s"', 'value="0" urel="0.1" unit="Ao/s"')
pack("a DTD", "<process ", "<!DOCTYPE process [<!ENTITY a 'x'>]><process ")
pack("another namespace", "urn:flexwright:process:1", "urn:flexwright:process:2")
pack("a DTD", "<mask-table ", "<!DOCTYPE mask-table [<!ENTITY a 'x'>]><mask-table ", "masks")
pack("a layer number of 99999", 'gds="1/0"', 'gds="99999/0"', "masks")
pack("a colour that ends a style", 'colour="#3d6aa8"', 'colour="red;}&lt;/style>"', "masks")
pack("a layer called ../x", 'name="AL_MASK"', 'name="../x"', "masks")
pack("a pattern without end", 'to="24 um" step="0.5 um"', 'to="24 um" step="1 fm"', "masks")
pack("another flow", 'flow="al-masked-rie"', 'flow="../../zqx"', "masks")


def given(name, option, file, data, command="recipe", refused=True, says="", more=()):
    def make(here):
        (here / "device.xml").write_text(LEAF.replace("20 ms", "1 ms"), encoding="utf-8")
        (here / file).write_bytes(data if isinstance(data, bytes) else data.encode())
        return [command, "device.xml", *FAST, option, file, *more, "-o", "out"], {}
    KINDS.append(Kind(name, make, refused, says))


given("a laboratory pack: escapes in an unknown id", "--lab", "lab.xml", LABORATORY.replace('id="pan.R"', f'id="{M}&#x9b;31m&#x202e;"'))
given("a laboratory pack: of a flow called ../x", "--lab", "lab.xml", LABORATORY.replace('flow="al-masked-rie"', 'flow="../x"'), refused=False)
given("a laboratory pack: a DTD", "--lab", "lab.xml", LABORATORY.replace("<process", "<!DOCTYPE a [<!ENTITY b 'c'>]><process"))
given("a laboratory pack: outside what makes sense", "--lab", "lab.xml", LABORATORY.replace('value="60"', 'value="6e99"'))
given("layers: escapes", "--layers", "layers.txt", f"structure 7/0 name \x1b[31m{M}\n", "mask")
given("layers: numbers beyond", "--layers", "layers.txt", "structure 70000000000/0\n", "mask")
given("layers: NUL and no line end", "--layers", "layers.txt", b"structure 7/0 name A\0B" + b"x" * 100000, "mask")
given("layers: two million lines", "--layers", "layers.txt", "structure 7/0\n" * 2000000, "mask")

# ---- logs, measured values, studies ----


def chained(*lines):
    """a log of these lines, each with its chain: whoever writes it may write it whole"""
    out, chain = b"", ""
    for line in lines:
        line = line if isinstance(line, bytes) else line.encode()
        chain = hashlib.sha256(chain.encode() + line).hexdigest()
        out += line + b"\tchain=" + chain.encode() + b"\n"
    return out


def log(name, data, refused=True, says=""):
    def make(here):
        (here / "device.xml").write_text(LEAF.replace("20 ms", "1 ms"), encoding="utf-8")
        (here / "lot.log").write_bytes(data)
        return ["log", "device.xml", *LOG_FAST, "--flow", FLOW, "--run", "lot.log"], {}
    KINDS.append(Kind("a log: " + name, make, refused, says))


log("nothing but escapes", b"\x1b[31m\x9b2J\n" * 1000)
log("one line of 8 MB", b"flexwright-log 1\t" + b"x" * 8000000 + b"\n")
log("a chain of another", chained("flexwright-log\t1\tflow=al-masked-rie", "S01") .replace(b"S01", b"S02"))
log("NUL", chained(b"flexwright-log 1\tflow=al-masked-rie\0"))
log("a flow of escapes", chained("flexwright-log 1\tflow=\x1b[31m\tplan=" + "0" * 64))


def calibrate(name, data, refused=True, says=""):
    def make(here):
        (here / "lot.csv").write_bytes(data if isinstance(data, bytes) else data.encode())
        return ["calibrate", "lot.csv", "--flow", FLOW, "-o", "lab.xml"], {}
    KINDS.append(Kind("measured values: " + name, make, refused, says))


COUPONS = "coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\n"
ROW = "arde-slots,,4,41.9,0.2,um,90,0.2,min\n"
calibrate("a quote that never ends", COUPONS + '"' + ROW * 10)
calibrate("NUL", (COUPONS + ROW).encode().replace(b"41.9", b"41\0.9"))
calibrate("six thousand rows", COUPONS + ROW * 6000)
calibrate("a field of 4 MB", COUPONS + "x" * 4000000 + "\n")
calibrate("escapes", COUPONS + ROW.replace("arde-slots", f"\x1b[31m{M}\u009b2J"))
calibrate("a formula", COUPONS + ROW.replace("41.9", "=1+1"))
calibrate("numbers beyond", COUPONS + ROW.replace("41.9", "1e309"))
calibrate("nan", COUPONS + ROW.replace("41.9", "nan"))
calibrate("no rows", COUPONS)
calibrate("Latin-1", (COUPONS + ROW.replace("um", "\u00b5m")).encode("latin-1"))
calibrate("100 columns", "coupon" + ",x" * 100 + "\n")


def study(name, body, refused=True, says="", head='kind="sweep"'):
    def make(here):
        (here / "device.xml").write_text(LEAF.replace("20 ms", "1 ms"), encoding="utf-8")
        (here / "study.xml").write_text(f'<study xmlns="urn:flexwright:study:1" name="s" {head} device="device.xml">{body}</study>', encoding="utf-8")
        return ["study", "study.xml", "-o", "out", "--color", "never"], {}
    KINDS.append(Kind("a study: " + name, make, refused, says))


study("10^15 devices", '<vary what="width" from="8 um" to="9 um" steps="100000"/>' * 3)
study("a device elsewhere", '<vary what="width" values="8 um"/>', head='kind="sweep" device="/etc/passwd"')
study("a path of escapes", f'<vary what="{M}&#x9b;31m&#10;{M}-forged" values="8 um"/>')
study("a number of nan", '<vary what="width" from="nan um" to="9 um"/>')
study("a response of 4000 brackets", f'<vary what="width" values="8 um"/><respond name="r" value="{"[" * 4000}"/>')
study("called ../../zqx", '<vary what="width" values="8 um"/>', head='kind="sweep" name="../../zqx"')


def sparse(here):
    with open(here / "device.xml", "wb") as file:
        file.truncate(1 << 40)
    return ["check", "device.xml", *FAST], {}


KINDS.append(Kind("a sparse file of a terabyte", sparse, True))


def option(name, *arguments):
    def make(here):
        (here / "device.xml").write_text(LEAF.replace("20 ms", "1 ms"), encoding="utf-8")
        return ["check", "device.xml", *FAST, *arguments], {}
    KINDS.append(Kind("an option: " + name, make, True))


option("escapes for a value", "--set", f"width=\x1b[31m\u009b2J{M}")
option("escapes for a path", "--set", f"\x1b[31m\n{M}-forged: error: none=1 um")
option("escapes for an option", f"--\x1b[31m{M}")
option("an expression of 60 000 brackets", "--set", "width=" + "(" * 60000 + "8 um" + ")" * 60000)


def named(name, file):
    def make(here):
        (here / file).write_text("<d/>")
        return ["check", file, *FAST], {}
    KINDS.append(Kind("a file called " + name, make, True))


named("an escape", f"\x1b[31m{M}\x1b[0m.xml")
named("a line break", f"a\n{M}-forged: error: all is well.xml")
named("no UTF-8", b"a\xff\xfe.xml".decode("utf-8", "surrogateescape"))
named("read from right to left", f"{M}\u202elmx.exe")
