# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the fault tests, on small devices, each with an earlier result in the place of its own."""
import hashlib
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIX_BAR = ROOT / "docs/gallery/reference-six-bar/device.xml"
LEAF = ROOT / "docs/gallery/leaf-four-bar/device.xml"
WAFER = ROOT / "tests/data/wafer/leaf-wafer.xml"


def without_times(data):
    """CPU time is the one thing that differs from run to run"""
    return re.sub(rb'"cpu_s": ?[-+.e\d]+', b"", data)


class Room:
    """a directory of its own with the files of another"""

    def __init__(self, like, path):
        self.path = path
        if like:
            shutil.copytree(like.path, path)
        else:
            path.mkdir(parents=True)

    def state(self):
        return {p.relative_to(self.path).as_posix(): hashlib.sha256(without_times(p.read_bytes())).hexdigest()
                for p in self.path.rglob("*") if p.is_file()}

    def leftovers(self, pattern):
        return sorted(p.name for p in self.path.rglob("*") if pattern.search(p.name))

    def remove(self):
        shutil.rmtree(self.path)


class Case:
    """`command` with {device}; what stands in `earlier` is run first, for the result that must stay"""

    def __init__(self, name, command, earlier=(), status=0, files=None):
        self.name, self.command, self.earlier, self.status, self.files = name, command, earlier, status, files or {}
        self.environment = {}
        self.resumes = name == "study"  # what it has come to is kept, and gone on with
        self.grows = name == "log"  # done twice it is another file
        self.without = {"doctor": {"stat", "opendir"}}.get(name, set())  # says what it cannot look at

    def arguments(self, room):
        return self.command

    def prepare(self, program, path):
        room = Room(None, path)
        for name, source in self.files.items():
            (path / name).write_text(source() if callable(source) else source.read_text())
        for arguments in self.earlier:
            status, _, said, _ = program.run(Case(self.name, arguments), room)
            if status not in (0, 1, 4):
                raise SystemExit(f"{self.name}: the earlier result could not be made: {said}")
        return room


SILICON = "al-masked-rie"
COUPONS = """coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit
arde-slots,,4,41.9,0.2,um,90,0.2,min
arde-slots,,10,45.6,0.2,um,90,0.2,min
arde-slots,,100,49.4,0.2,um,90,0.2,min
undercut-ladder,gone,3.5,,,,50,0.3,um
undercut-ladder,stands,4,,,,50,0.3,um
undercut-ladder,width,20,16.2,0.15,um,50,0.3,um
cd-lines,line,10,7.95,0.1,um
cd-lines,space,10,12.1,0.1,um
etch-rate,pan.R,,0.90,0.02,um,20,0.1,min
"""

STUDY = """<study xmlns="urn:flexwright:study:1" name="s" kind="sweep" points="sobol" samples="5" as="hinges" device="d.xml">
  <vary what="arc" from="200 deg" to="250 deg"/>
  <respond name="U" value="governing.utilisation"/>
</study>
"""
D = {"d.xml": SIX_BAR}
L = {"d.xml": LEAF}
OTHER = ["--accuracy", "1e-2"]
ALONE = ["--jobs", "1"]  # the n-th call is the same one in every run


def writer(name, *options, device=D, status=0):
    """a command that writes the directory `out`, where an earlier one with another accuracy stands"""
    return Case(name, [name, "d.xml", "-o", "out", *options], [[name, "d.xml", "-o", "out", *OTHER, *options]],
                status=status, files=device)


LOG = ["log", "d.xml", "--flow", SILICON, "--run", "lot.log"]
ENTRY = [*LOG, "--entry", "S18; start=2026-11-01T08:00; end=2026-11-01T10:05; by=AB; second=CD", "--instrument",
         "profilometer 2", "--wafer"]
CASES = [
    Case("check", ["check", "d.xml", "--json", *ALONE], files=D),
    writer("plan", *ALONE),
    writer("mask", "--mask-format", "all", *ALONE),
    writer("recipe", *ALONE),
    writer("statics", "--path"),
    writer("modes"),
    writer("assemble"),
    # an accuracy that is asked for starts another program
    Case("hinge", ["hinge", "d.xml", "-o", "out", "-q"],
         [["hinge", "d.xml", "-o", "out", "-q", "--level", "closed-form"]], files=D),
    Case("simulate", ["simulate", "d.xml", "--csv", "motion.csv", "--json"],
         [["simulate", "d.xml", "--csv", "motion.csv", "--samples", "11"]], files=D),
    Case("workspace", ["workspace", "d.xml", "-o", "out"], files=D),
    Case("wafer", ["mask", "d.xml", "-o", "out", *ALONE], [["mask", "d.xml", "-o", "out", *OTHER]], files={"d.xml": WAFER}),
    Case("calibrate", ["calibrate", "lot.csv", "--flow", SILICON, "-o", "lab.xml"],
         [["calibrate", "less.csv", "--flow", SILICON, "-o", "lab.xml"]],
         files={"lot.csv": lambda: COUPONS, "less.csv": lambda: COUPONS[:COUPONS.index("etch-rate")]}),
    Case("log", [*ENTRY, "2"], [[*ENTRY, "1", "--lot", "L7", "--wafers", "6"]], files=D),
    Case("report", [*LOG, "--report", "page.html", "--json"], [[*ENTRY, "1", "--lot", "L7", "--wafers", "6"]], files=D),
    # samples are kept in a data base, so that a study that was stopped goes on
    Case("study", ["study", "s.xml", "-o", "out", "--jobs", "1"], [["study", "s.xml", "-o", "out", "--jobs", "1", "--set", "link=125 um"]],
         files={**D, "s.xml": lambda: STUDY}),
    Case("init", ["init", "mine"]),
    Case("explain", ["explain", "FW-D204"]),
    Case("doctor", ["doctor"]),
]
