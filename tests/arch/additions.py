#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A row is enough: a time law, an effect, a kind of hinge, a method of constrained dynamics, an integrator, a mask format,
a design rule, a test pattern, a coupon, a time law of a process, a command and an endpoint that the program does not have
(tests/arch/additions/*.patch, each of one new file and one line in a list; an endpoint is a function beside its row) are
added to a copy of the sources, and everything that should know of them is asked: simulate, the advice of check, hinge,
the report, tradeoff, --help, the reference page and the page's form.

    additions.py BUILD

Of the copy only what depends on a changed file is compiled, with the build's own commands; the rest of the program is the
build's own objects. What passes: the additions appear in each place, and a motion under both is that of the same torque
written as an expression."""
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/serve"))
sys.path.insert(0, str(ROOT / "tools"))
import client  # noqa: E402
import together  # noqa: E402
PATCHES = sorted((ROOT / "tests/arch/additions").glob("*.patch"))


def call(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


class Copy:
    """the sources with the patches, and programs linked from them"""

    def __init__(self, build, at):
        self.build, self.at = build, at
        for part in ("src", "include", "tests"):
            shutil.copytree(ROOT / part, at / part, ignore=shutil.ignore_patterns("node_modules"))
        self.added, self.changed = [], []
        for patch in PATCHES:
            touched = [line[6:] for line in patch.read_text().splitlines() if line.startswith("+++ b/")]
            new = [name for name in touched if not (ROOT / name).exists()]
            files = 0 if patch.stem == "endpoint" else 1  # whose function stands beside its row
            assert len(new) == files, f"{patch.name} adds {len(new)} files; {files} is enough"
            assert len(touched) == files + 1, f"{patch.name} changes {touched}"
            call(["git", "apply", "--recount", "-C1", patch], cwd=at)
            self.added += new
            self.changed += [name for name in touched if name not in new]
        self.compile()

    def commands(self):
        entries = json.loads(call(["ninja", "-C", self.build, "-t", "compdb"]))
        return {e["output"]: e["command"] for e in entries
                if "/fw_" in e["output"] and e["output"].endswith(".o")}

    def outdated(self, known):
        """objects that depend on a changed file"""
        found, output = set(), None
        paths = {str(ROOT / name) for name in self.changed}
        for line in call(["ninja", "-C", self.build, "-t", "deps"]).splitlines():
            if line and not line.startswith(" "):
                output = line.split(":")[0]
            elif os.path.normpath(self.build / line.strip()) in paths and output in known:
                found.add(output)
        return found

    def jobs(self):
        """[(what the build compiles a file with, the file)] of all that is outdated; a new file as another one of its room"""
        known = self.commands()
        jobs = [(known[output], output.split(".dir/")[1][:-2]) for output in sorted(self.outdated(known))]
        for name in self.added:
            room = name.split("/")[1]
            model = next(o for o in sorted(known) if f"/fw_{room}.dir/src/{room}/" in o and "-m" not in known[o].split())
            jobs.append((known[model].replace(model.split(".dir/")[1][:-2], name), name))
        return jobs

    def compile(self):
        """files of a room that name nothing alike as one (tools/together.py): to read the headers takes longest"""
        objects, jobs, groups = self.at / "objects", self.jobs(), {}
        objects.mkdir()
        of = together.grouped([self.at / name for _, name in jobs if (self.at / name).exists()], 8,
                              [self.at / "src", self.at / "include"])
        for command, name in jobs:
            flags = re.sub(r" -(?:o|c|M[DTF])(?: (?!-)\S+)?", "", command).replace(" -O2 ", " -O0 ")  # nothing here asks for speed
            for part in ("src", "include"):
                flags = flags.replace(f"-I{ROOT / part}", f"-I{self.at / part}")
            source = self.at / name if (self.at / name).exists() else self.build / name  # made by the build: from no changed file
            groups.setdefault((name.split("/")[1], of.get(source, name), flags), []).append(source)
        self.objects = []

        def one(job):
            number, ((room, _, flags), sources) = job
            text, made = objects / f"{number}.c", objects / f"src-{room}-{number}.o"
            text.write_text("".join(f'#include "{source}"\n' for source in sources))
            self.objects.append(made)
            done = subprocess.run(f"{flags} -Wno-shadow -o {made} -c {text}", shell=True, cwd=self.build, capture_output=True, text=True)
            return done.stderr + done.stdout if done.returncode else ""

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            wrong = [text for text in pool.map(one, enumerate(groups.items())) if text]
        if wrong:
            sys.exit("".join(wrong))
        self.objects.sort()
        print(f"{len(jobs)} files compiled, as {len(groups)}")

    def link(self, target, first=None):
        """a program of the build, with the new objects in front of the libraries"""
        command = call(["ninja", "-C", self.build, "-t", "commands", target]).splitlines()[-1]
        words = command.split(" ")
        at = words.index("-o")
        own = [w for w in words[:at] if w.endswith(".o")]
        program = self.at / pathlib.Path(target).name
        words[at + 1] = str(program)
        for w in own:
            words[words.index(w)] = str(first) if first else w
        # of rooms that the program is linked from: another one would ask for rooms above them
        words[at:at] = [str(o) for o in self.objects if f"libfw_{o.name.split('-')[1]}.a" in command]
        call(["sh", "-c", " ".join(words)], cwd=self.build)
        return program


def device(at, name, load):
    """the reference six-bar with one scene, in one flow"""
    text = (ROOT / "docs/gallery/reference-six-bar/device.xml").read_text()
    head, rest = text.split('  <scene name="step-load"')
    tail = rest[rest.index("  <die "):]
    head = head.replace('  <flow ref="copper-on-porous-silicon" material="copper-plated" thickness="9 um"/>\n', "")
    assert "copper" not in head
    file = at / f"{name}.xml"
    file.write_text(f'{head}  <scene name="turned" duration="5 ms">\n    {load}\n  </scene>\n{tail}')
    return file


MAGNET = '<magnetic-torque on="AB" moment="{} mA mm^2" field="100 mT" law="decay" time-constant="2 ms"{}/>'
SAME = '<torque on="AB" value="100 mT * {} mA mm^2" law="expression" factor="exp(-time/(2 ms))"/>'
SMALL, LARGE = 400, 20000
HAIRPIN = '<flexure id="hairpin" kind="hairpin" length="300 um" width="width" gap="8 um"/>'
HAIRPIN_AS_PATH = """<flexure id="hairpin" kind="path" width="width" gap="8 um">
    <line length="50 um"/><arc radius="63.66197723675813 um" angle="180 deg"/><line length="50 um"/></flexure>"""


def numbers(text):
    """all but what was measured on this machine"""
    text = re.sub(r'"(?:cpu|wall|us|seconds|cost)\w*": [^,\n]*', "", text)
    return [float(x) for x in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]


def check(copy):
    at = copy.at
    program = copy.link("flexwright")
    run = lambda *arguments, ok=(0,): _run(program, arguments, ok)
    small = device(at, "small", MAGNET.format(SMALL, ' start="0.5 ms"'))
    pages = []

    def expect(what, text, *words):
        for word in words:
            if word not in text:
                sys.exit(f"{what} does not know {word!r}:\n{text[:4000]}")
        pages.append(what)

    # the motion is that of the same torque as an expression
    mine = json.loads(run("simulate", device(at, "mine", MAGNET.format(SMALL, "")), "--json"))
    same = json.loads(run("simulate", device(at, "same", SAME.format(SMALL)), "--json"))
    ledger = {e["id"]: e for e in mine["effects"]}
    assert ledger["magnetic-torque"]["called_for"] and ledger["magnetic-torque"]["active"], ledger
    for a, b in zip(mine["peaks"], same["peaks"]):
        assert abs(a["angle_rad"] - b["angle_rad"]) <= 2e-3 * abs(b["angle_rad"]) + 1e-9, (a, b)
    assert max(abs(p["angle_rad"]) for p in mine["peaks"]) > 1e-3
    pages.append("simulate")

    # methods and integrators: the same motion, by the new ones
    pins = ("simulate", at / "mine.xml", "--json", "--hinge-model", "revolute")
    mine = json.loads(run(*pins))
    for option, rtol, within in ((("--method", "normal-equations"), "1e-8", 1e-6), (("--integrator", "heun"), "1e-6", 1e-4)):
        other = json.loads(run(*pins, "--rtol", rtol, *option))
        assert other[option[0][2:]] == option[1], other[option[0][2:]]
        for a, b in zip(mine["peaks"], other["peaks"]):
            assert abs(a["angle_rad"] - b["angle_rad"]) <= within * abs(b["angle_rad"]) + a["error_rad"], (option, a, b)
        expect("simulate --help", run("simulate", "--help"), option[1])
        said = subprocess.run([program, "simulate", at / "mine.xml", option[0], "none"], capture_output=True, text=True)
        expect("the names that are known", said.stderr, option[1])
    study = json.loads(run("tradeoff", ROOT / "docs/mechanisms/slider-crank.xml", "--budget", "2", "--no-time", "--json"))
    state = {(p["method"], p["integrator"]): p["state"] for p in reversed(study["points"])}  # at the loosest tolerance
    assert state[("normal-equations", "dop853")] == "done" and ("chain", "heun") in state, state
    pages.append("tradeoff")

    # a hinge: that of the same lines and arcs, in mechanics, motion and masks
    text = (ROOT / "docs/gallery/free-form-four-bar/device.xml").read_text()
    path = re.search(r'  <flexure id="hairpin".*?</flexure>\n', text, re.S).group()
    answers = []
    for own in (HAIRPIN, HAIRPIN_AS_PATH):
        file = at / "hairpin.xml"
        file.write_text(text.replace(path, own))
        answers.append([numbers(run(*command, file, "--json"))
                        for command in (("hinge", "--level", "closed-form"), ("simulate", "--hinge-model", "revolute"))])
        run("mask", file, "-o", at / "hairpin", "--force", "--corners", "none", "--flow", "al-masked-rie", ok=(0, 1, 4))
        answers[-1].append(numbers(next((at / "hairpin/masks").glob("*.svg")).read_text()))
    for mine, same in zip(*answers):
        assert len(mine) == len(same) > 100, (len(mine), len(same))
        for a, b in zip(mine, same):
            assert abs(a - b) <= 1e-7 * abs(b) + 1e-12, (a, b)
    pages.append("hinge and the masks of a hinge")
    file.write_text(text.replace(path, HAIRPIN.replace("length=", 'radius="70 um" length=')))
    said = subprocess.run([program, "assemble", file], capture_output=True, text=True)
    expect("what a hinge goes by", said.stderr, "a hairpin has no radius", "FW-D058")

    large = device(at, "large", MAGNET.format(LARGE, ""))
    expect("the advice of check", run("check", large, "--corners", "none", ok=(1,)), "REJECT", "magnetic fields")

    decks = at / "decks"
    said = subprocess.run([program, "hinge", small, "--deck", decks, "--level", "closed-form"], capture_output=True,
                          text=True)
    assert said.returncode in (0, 1), said.stderr
    assert not list(decks.glob("*mechanism*")), "a deck was written without the effect"
    expect("hinge --deck", said.stdout + said.stderr, "magnetic-torque", "cannot be written")

    out = at / "out"
    run("plan", small, "-o", out, "--mask-format", "points,svg", "--force", "--corners", "none", "--advice", "none",
        ok=(0, 1, 4))
    report = next(out.glob("*.html")).read_text()
    expect("the report", report, "magnet on AB in a field of", "decay with the time constant", "from 500")
    vertices = next((out / "masks").glob("*.points.csv")).read_text()
    assert vertices.count("\n") > 100, vertices
    pages.append("the masks")
    expect("--help", run("plan", "--help"), "points")
    assert run("greet", "world") == "hello world\n"
    expect("the list of commands", run("--help"), "greet     a greeting on standard output")
    expect("the help of the command", run("greet", "--help"), "Prints a greeting", "flexwright greet world")
    said = subprocess.run([program, "gret"], capture_output=True, text=True)
    expect("the command that was meant", said.stderr, "did you mean greet?")

    # the server: the new address answers who may ask, and nobody else
    with client.Server(str(program), str(at)) as server:
        assert server.ask("GET", "/api/greeting")[0] == 401
        server.enter()
        status, _, body = server.ask("GET", "/api/greeting")
        assert (status, json.loads(body)) == (200, {"hello": "you"}), (status, body)
        assert server.ask("POST", "/api/greeting", {})[0] == 405
    pages.append("the server")

    # the reference page, its schema, and what the page makes its form of
    source = at / "tests/arch/additions/pages.c"
    object_ = at / "pages.o"
    call(["cc", "-std=c17", f"-I{at}/src", f"-I{at}/include", "-c", source, "-o", object_])
    text = call([copy.link("tests/live", object_)])
    expect("the reference page and the schema", text, "| `decay` | `start`, **`time-constant`** |",
           "decay: after which a share of 1/e is left", "### `<magnetic-torque>`", '<element name="magnetic-torque">',
           "<value>decay</value>", '<attribute name="time-constant">', "hairpin: half a turn between two legs",
           "<value>hairpin</value>")
    form = json.loads(call([copy.link("tests/live"), "table"], input=""))
    elements = {e["name"]: e for e in form["elements"]}
    attributes = {a["name"]: a for a in elements["magnetic-torque"]["attributes"]}
    assert "decay" in attributes["law"]["choices"] and attributes["time-constant"]["unit"] == "ms", attributes
    assert any(f["name"] == "points" for f in form["mask_formats"]), form["mask_formats"]
    assert any(e["name"] == "magnetic-torque" for e in form["effects"]), form["effects"]
    kind, = (a for a in elements["flexure"]["attributes"] if a["name"] == "kind")
    assert "hairpin" in kind["choices"] and "hairpin: half" in kind["sentence"], kind
    assert any(m["name"] == "normal-equations" for m in form["methods"]), form["methods"]
    assert any(m["name"] == "heun" for m in form["integrators"]), form["integrators"]
    pages.append("the page's form")

    # what a laboratory adds: a rule and a pattern of a layer table, a step's time law, a coupon
    for part in ("processes", "masks"):
        shutil.copytree(ROOT / part, at / part)
    table = at / "masks/al-masked-rie.xml"
    text = table.read_text()
    rows = ('  <rule kind="extent" layer="text" min="500 um" severity="warning" source="tried"/>\n'
            '  <pattern kind="block" id="a-block" title="BLOCK" width="120 um"/>\n')
    table.write_text(text.replace("</mask-table>", rows + "</mask-table>"))
    os.environ["FLEXWRIGHT_DATA"] = str(at)
    out = at / "own"
    run("mask", small, "-o", out, "--force", "--corners", "none", ok=(0, 1, 4))
    certificate = next((out / "masks").glob("*-rie.json")).read_text()
    expect("the certificate", certificate, '"extent"')
    expect("the list of patterns", next((out / "masks").glob("*-coupons.json")).read_text(), "a-block", "block")
    pack = at / "processes/al-masked-rie.xml"
    text = pack.read_text()
    rate = '<time law="rate" overrun="0" k="2"><arg name="thickness" q="litho.resist"/><arg name="rate" q="bake.rate"/>'
    pack.write_text(text.replace(rate, rate.replace('"rate"', '"twice"', 1)))
    run("recipe", small, "--flow", "al-masked-rie", "-o", out, "--force")
    steps = json.loads((out / "recipes/al-masked-rie.json").read_text())["steps"]
    bake, = (s for s in steps if s["title"] == "Soft bake")
    assert bake["law"] == "twice" and abs(bake["time_s"]["nominal"] - 240) < 1e-6, bake
    pages.append("the recipe")
    pack.write_text(text.replace(rate, rate.replace('"rate"', '"twise"', 1)))
    said = subprocess.run([program, "recipe", small, "--flow", "al-masked-rie", "-o", out, "--force"],
                          capture_output=True, text=True)
    expect("the time law that was meant", said.stderr, "twice")
    pack.write_text(text)

    measured = at / "measured.csv"
    measured.write_text("coupon,feature,drawn_um,measured,u,unit\ncaliper,al.d,,1.02,0.01,um\ncaliper,al.d,,1.03,0.01,um\n")
    pack = at / "laboratory.xml"
    run("calibrate", measured, "--flow", "al-masked-rie", "-o", pack)
    expect("the laboratory pack", pack.read_text(), 'id="al.d"', "caliper")
    measured.write_text("coupon,feature,drawn_um,measured,u,unit\ncalliper,al.d,,1.02,0.01,um\n")
    said = subprocess.run([program, "calibrate", measured, "--flow", "al-masked-rie"], capture_output=True, text=True)
    expect("the list of coupons", said.stderr, "did you mean 'caliper'")
    print("known to: " + ", ".join(pages))


def _run(program, arguments, ok):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in ok:
        sys.exit(f"{' '.join(map(str, arguments))}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as here:
        check(Copy(build, pathlib.Path(here)))


if __name__ == "__main__":
    main()
