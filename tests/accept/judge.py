#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""judge.py [--scripts DIR] [--verbose] DIR...: every FLOW.gds in the directories, with what lies beside it, before KLayout, gdspy,
GEOS and own readers (outlines.py). KLayout and Python start once for all. Exit 0 passed, 1 failed, 77: klayout is missing.

Of each file: strict reading without warnings (GDSII, OASIS); width, space, angles, overlaps and grid with each layer's own rule
and with 4 um; merged areas; gdspy's counts and areas; GEOS validity and clearance; OASIS equal to GDSII; DXF and SVG within
the tolerance (XOR, and distance of every vertex and edge from the exact arcs); the certificate's counts, areas, extents, edges
and hash, and the hashes of the order sheet. --scripts: another directory with the same kl_*.py, gdspy_read.py, geos_check.c."""
import argparse
import contextlib
import hashlib
import io
import json
import math
import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
import kl_asked  # noqa: E402
import outlines  # noqa: E402

TABLES = pathlib.Path(os.environ.get("FW_MASK_TABLES", HERE.parents[1] / "masks"))
GRID_UM = 1e-3
SNAP_UM = GRID_UM / math.sqrt(2)
WRITTEN_UM = 3e-6  # both formats write pm; an arc is off by some of them


class Judge:
    def __init__(self, scripts, verbose):
        self.scripts, self.verbose = scripts, verbose
        self.work = pathlib.Path(tempfile.mkdtemp())
        self.jobs, self.asked, self.failed, self.passed, self.worst = [], [], [], 0, {}

    def say(self, name, good, output=""):
        if good:
            self.passed += 1
            if self.verbose:
                print("ok    " + name)
        else:
            self.failed.append(name)
            print("FAIL  " + name)
            print("".join("      " + line + "\n" for line in output.strip().splitlines()[-20:]), end="", flush=True)

    def most(self, name, value):
        self.worst[name] = max(self.worst.get(name, 0.0), value)

    def ask(self, name, script, **variables):
        """a check for KLayout"""
        own = HERE / script
        path = own if script in ("kl_svg.py", "kl_dxf.py") else self.scripts / script
        self.jobs.append({"script": str(path), "vars": {k: str(v) for k, v in variables.items()}})
        self.asked.append(name)

    def python(self, script, *arguments):
        """status and output of a script in this interpreter"""
        out, kept = io.StringIO(), sys.argv
        sys.argv = [str(script), *map(str, arguments)]
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                runpy.run_path(str(script), run_name="__main__")
            status = 0
        except SystemExit as left:
            status = left.code or 0
        finally:
            sys.argv = kept
        return status, out.getvalue()

    def start(self):
        compiled = subprocess.run([os.environ.get("CC", "cc"), "-O2", self.scripts / "geos_check.c", "-lgeos_c", "-lm", "-o",
                                   self.work / "geos_check"], capture_output=True, text=True, check=False)
        self.say("geos_check compiles", compiled.returncode == 0, compiled.stderr)

    def flow(self, gds):
        stem = gds.with_suffix("")
        name = "%s %s" % (gds.parent.parent.name, stem.name)
        self.ask(name + ": strict reading", "kl_nowarn.sh", f=gds)
        table = TABLES / (stem.name + ".xml")
        _, text = self.python(HERE / "layers.py", gds, table, str(stem) + ".json")
        rows = [line.split() for line in text.splitlines()]
        self.say(name + ": has polygons", bool(rows))
        areas, least = [], self.chords(pathlib.Path(str(stem) + ".json"))
        for layer, width, space, area in rows:
            for rule in dict.fromkeys([(width, space), ("4.0", "4.0")]):
                self.ask("%s %s: width %s um, space %s um" % (name, layer, *rule), "kl_drc.py", f=gds, layer=layer, width=rule[0],
                         space=rule[1])
            self.clearance(name, gds, layer, float(least.get(layer, 0)))
            if area != "-":  # what the certificate does not add up
                areas.append("%s:%s" % (layer, area))
        self.ask(name + ": merged areas", "kl_area.py", f=gds, expect=",".join(areas), rel="1e-9")
        self.say(name + ": gdspy", *self.verdict(self.python(self.scripts / "gdspy_read.py", gds, *areas)))
        self.formats(name, gds, stem)

    @staticmethod
    def verdict(result):
        return result[0] == 0, result[1]

    @staticmethod
    def chords(certificate):
        """{layer: um}: 0.9 of the shortest edge that the certificate names; less only where it says so of a cut"""
        if not certificate.exists():
            return {}
        said = json.loads(certificate.read_text(encoding="utf-8"))
        least = {k["gds"]: 0.9e-3 * k["shortest_edge_nm"] for k in said["layers"] if k["polygons"]}
        for shape in said["shapes"]:
            cut = 1e-3 * shape.get("cut_clearance_nm", math.inf)
            if cut < 0.9e-3 * shape["shortest_edge_nm"] * (1 - 1e-9):
                least[shape["gds"]] = min(least[shape["gds"]], cut * (1 - 1e-9))
        return least

    def clearance(self, name, gds, layer, least):
        """no vertex nearer to an edge than 0.9 of the shortest edge, and 20 nm in any case"""
        done = subprocess.run([self.work / "geos_check", gds, *layer.split("/"), "%.6f" % max(0.020, least)],
                              capture_output=True, text=True, check=False)
        self.say("%s %s: GEOS" % (name, layer), done.returncode == 0, done.stdout + done.stderr)

    def formats(self, name, gds, stem):
        json_file = pathlib.Path(str(stem) + ".json")
        certificate = json.loads(json_file.read_text(encoding="utf-8"))
        tolerance = certificate["tolerance_nm"] * 1e-3
        file = {ending: pathlib.Path("%s.%s" % (stem, ending)) for ending in ("oas", "svg", "dxf", "lyt")}
        if file["oas"].exists():
            self.ask(name + ": OASIS, strict reading", "kl_nowarn.sh", f=file["oas"])
            self.ask(name + ": OASIS equal to GDSII", "kl_xor.py", a=gds, b=file["oas"])
        near = tolerance + 5.5e-3  # two roundings to the grid, chords of the other side, and whole nanometres
        if file["dxf"].exists():
            self.ask(name + ": DXF by KLayout", "kl_dxf.py", gds=gds, dxf=file["dxf"], lyt=file["lyt"],
                     tol=near + tolerance)  # KLayout's own arcs
        if file["svg"].exists():
            self.ask(name + ": SVG and GDSII", "kl_svg.py", gds=gds, svg=file["svg"], json=json_file, here=HERE, tol=near)
        polygons = outlines.read_gds(gds)
        exact = {}
        if file["svg"].exists():
            exact["SVG"] = outlines.read_svg(file["svg"], certificate["extent_um"])
        if file["dxf"].exists():
            layers = {k: v for k, v in re.findall(r"'([^' ]+) : (\d+/\d+)'", file["lyt"].read_text(encoding="utf-8"))}
            exact["DXF"] = outlines.read_dxf(file["dxf"], layers)
        kind = next(iter(exact), None)
        if kind:
            self.distances("%s: %s" % (name, kind), exact[kind], polygons, tolerance)
        if len(exact) == 2:
            off = [outlines.same(*pair) for layer in polygons for p, q in (exact.values(),)
                   for pair in ((p.get(layer, []), q.get(layer, [])), (q.get(layer, []), p.get(layer, [])))]
            self.most("point of an SVG from the DXF, pm", 1e6 * max(off))
            self.say(name + ": SVG and DXF are the same arcs", max(off) <= 2 * WRITTEN_UM, "%g pm apart" % (1e6 * max(off)))
        self.certificate(name, certificate, gds, polygons, exact.get("SVG"))
        self.order(name, stem)

    def distances(self, name, shapes, polygons, tolerance):
        """every vertex within the rounding of the exact outline, every edge within the tolerance besides, and back"""
        problems = []
        if set(k for k, v in shapes.items() if v) != set(polygons):
            problems.append("layers %s and %s" % (sorted(shapes), sorted(polygons)))
        for layer, list_ in polygons.items():
            vertex, edge, back, met = outlines.compare(shapes.get(layer, []), [p * GRID_UM for p in list_], SNAP_UM + WRITTEN_UM)
            if not met or max(edge, back) > tolerance + SNAP_UM + WRITTEN_UM:
                problems.append("layer %s: vertices %.3f nm, edges %.3f nm, outlines %.3f nm away%s"
                                % (layer, 1e3 * vertex, 1e3 * edge, 1e3 * back, "" if met else ", order or number differs"))
            self.most("vertex from the exact outline, nm", 1e3 * vertex)
            self.most("edge from the exact outline less tolerance, nm", 1e3 * (edge - tolerance))
        self.say(name + " within rounding and tolerance", not problems, "\n".join(problems))

    def certificate(self, name, certificate, gds, polygons, shapes):
        problems = []

        def equal(what, said, found, within=0.0):
            if not (said == found or (within and said is not None and abs(said - found) <= within)):
                problems.append("%s: %r, and it is %r" % (what, said, found))

        equal("sha256", certificate["gds_sha256"], hashlib.sha256(gds.read_bytes()).hexdigest())
        every = np.concatenate([p for v in polygons.values() for p in v])
        for i, (said, found) in enumerate(zip(certificate["extent_um"], [*every.min(axis=0), *every.max(axis=0)])):
            equal("extent %d" % i, said, found * GRID_UM, SNAP_UM + certificate["tolerance_nm"] * 1e-3)
        for layer in certificate["layers"]:
            list_, key = polygons.get(layer["gds"], []), layer["gds"]
            twice = sum(int(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - np.roll(p[:, 0], -1) * p[:, 1])) for p in list_)
            equal(key + " polygon area", layer["polygon_area_um2"], twice / 2e6, 1e-9 * abs(twice / 2e6) + 1e-9)
            if shapes is not None:
                whole = sum(outlines.area(o) for o in shapes.get(key, []))
                equal(key + " exact area", layer["area_um2"], whole, 1e-7 * abs(whole) + 1e-9)
                equal(key + " shapes", layer["polygons"], len(shapes.get(key, [])))
            if abs(layer["polygon_area_um2"] - layer["area_um2"]) > layer["area_bound_um2"]:
                problems.append(key + " areas differ by more than their bound")
            if len(list_) == layer["polygons"] and list_:  # not cut
                equal(key + " vertices", layer["vertices"], sum(len(p) for p in list_))
                edge = min(np.hypot(*(np.roll(p, -1, axis=0) - p).T).min() for p in list_)
                equal(key + " shortest edge", layer["shortest_edge_nm"], edge, 1e-5 * edge)
        self.say(name + ": certificate", not problems, "\n".join(problems))

    def order(self, name, stem):
        path = pathlib.Path(str(stem) + ".order.json")
        if not path.exists():
            return
        wrong = [f["name"] for f in json.loads(path.read_text(encoding="utf-8"))["files"]
                 if hashlib.sha256((path.parent / f["name"]).read_bytes()).hexdigest() != f["sha256"]]
        self.say(name + ": order sheet's hashes", not wrong, " ".join(wrong))

    def klayout(self):
        answers, why = kl_asked.ask(self.jobs)
        if answers is None:
            self.say("KLayout runs", False, why)
            return
        for name, (passed, output) in zip(self.asked, answers):
            self.say(name, passed, output)

    def end(self):
        shutil.rmtree(self.work)
        for name, value in self.worst.items():
            print("largest distance of a%s %.4f" % ("n " + name if name[0] in "aeiou" else " " + name, value))
        print("JUDGE %s: %d checks passed, %d failed" % ("FAIL" if self.failed else "PASS", self.passed, len(self.failed)))
        return 1 if self.failed else 0


def judge(directories, scripts=HERE, verbose=False):
    """status, and the names of the checks that failed"""
    one = Judge(scripts, verbose)
    one.start()
    count = 0
    for directory in directories:
        for gds in sorted(pathlib.Path(directory).glob("*.gds")):
            if gds.name.endswith(".violations.gds"):
                continue  # outlines with markers of what is wrong, to look at
            if re.search(r"-(plate|wafer)(\.\w+)?\.gds$", gds.name):
                continue  # whole wafers and their plates as ordered have no certificate: accept.wafer
            one.flow(gds)
            count += 1
    one.say("%d files" % count, count > 0)
    one.klayout()
    return one.end(), one.failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", nargs="+")
    parser.add_argument("--scripts", type=pathlib.Path, default=HERE)
    parser.add_argument("--verbose", action="store_true")
    asked = parser.parse_args()
    if not shutil.which("klayout"):
        print("SKIPPED: klayout is not installed (Debian: apt-get install klayout python3-gdspy libgeos-dev)")
        return 77
    return judge(asked.directory, asked.scripts, asked.verbose)[0]


if __name__ == "__main__":
    sys.exit(main())
