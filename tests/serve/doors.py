#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""doors.py PROGRAM: a value that is wrong is refused wherever it comes in, for the same reason. Of the device: in the file, by
--set, and of the page by preview, edit and jobs. Of a process: in the pack, by --lab, by calibrate, and of the page by preview
and jobs.
Wrong values are made for every attribute that has a range, and for every quantity of every flow."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as tree

from client import ROOT, Server

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
ALL = bool(os.environ.get("FW_TEST_ALL"))
DEVICES = [ROOT / f"docs/gallery/{name}/device.xml" for name in ("reference-six-bar", "comb-stage", "free-form-gripper", "copper-nodder")]
SPACE, PACK = "{urn:flexwright:device:1}", "{urn:flexwright:process:1}"
CHECK = ("--corners", "none", "--advice", "none", "--measurements", "none", "-q")


def codes(text):
    return frozenset(re.findall(r"error: .*\[(FW-D\d+)\]", text))


def check(*arguments, environment=None, **options):
    done = subprocess.run([PROGRAM, "check", *map(str, arguments), *CHECK], capture_output=True, text=True, timeout=60,
                          env={**os.environ, **(environment or {})}, **options)
    return done.returncode, codes(done.stderr)


def wrong_numbers(a):
    """of an attribute of the table: below and above its range, of another kind, without a unit, no number"""
    unit = "" if a["unit"] == "1" else " " + a["unit"]
    lowest, highest = a["minimum"], a["maximum"]
    out = [f"nan{unit}", f"1e999{unit}", "4 kg s", f"1,5{unit}", "high"]
    if lowest is not None:
        out.append(f"{lowest - max(1e-3, abs(lowest)) * 0.5:.12g}{unit}")
    if highest is not None:
        out.append(f"{highest * 1.5:.12g}{unit}" if highest > 0 else f"{highest + 1:.12g}{unit}")
    if unit:
        out.append("7")
    return out


class Doors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.here = pathlib.Path(cls.temporary.name)
        cls.server = Server(PROGRAM, cls.here)
        cls.addClassCleanup(cls.server.stop)
        cls.server.enter()
        cls.table = {(e["parent"], e["name"]): e for e in cls.server.json("GET", "/api/table")["elements"]}

    def preview(self, text, **more):
        """status and numbers of the errors, as check has them"""
        answer = self.server.json("POST", "/api/preview", {"text": text, "options": {"corners": "none"}, **more})
        return answer["exit_status"], frozenset(d["code"] for d in answer["diagnostics"] if d["severity"] == "error")

    def job(self, text, **more):
        job = self.server.job({"kind": "check", "text": text, **more})
        return job["exit_status"], codes("\n".join(job["messages"]))

    # ---- the device ----
    def places(self, element, path=""):
        """(path, row of the table) of every attribute with a range: of the first element of each kind in each parent"""
        count = {}
        for child in element:
            name = child.tag.replace(SPACE, "")
            count[name] = count.get(name, 0) + 1
            row = self.table.get((element.tag.replace(SPACE, ""), name))
            if row is None or count[name] > 1:
                continue
            key = child.get(row["key"]) if row["key"] else None
            several = sum(x.tag == child.tag for x in element) > 1
            here = f"{path}{name}" + (f"[{key}]" if key else f"[{count[name]}]" if several else "")
            for a in row["attributes"]:
                if a["type"] == "number" and child.get(a["name"]) is not None:
                    yield f"{here}/@{a['name']}", a
            yield from self.places(child, here + "/")

    def test_of_the_device(self):
        seen, tried, jobs = set(), 0, 0
        for file in DEVICES:
            text = file.read_text()
            for path, a in self.places(tree.fromstring(text)):
                kind = re.sub(r"\[[^]]*\]", "", path)
                if kind in seen:
                    continue
                seen.add(kind)
                for number, value in enumerate(wrong_numbers(a)):
                    if not ALL and (len(seen) + number) % 9:
                        continue
                    with self.subTest(path=path, value=value):
                        tried += 1
                        by_set = check(file, "--set", f"{path}={value}")
                        self.assertEqual(by_set[0], 3)
                        self.assertTrue(by_set[1])
                        edited = self.server.json("POST", "/api/edit", {"text": text, "changes": [{"path": path, "value": value}]})
                        self.assertEqual(edited["status"], "ok")
                        self.assertEqual(check("-", input=edited["text"], cwd=file.parent), by_set, "in the file")
                        self.assertEqual(self.preview(text, set={path: value}), by_set, "set by the page")
                        self.assertEqual(self.preview(edited["text"]), by_set, "edited by the page")
                        if tried % 25 == 1:
                            jobs += 1
                            self.assertEqual(self.job(text, set={path: value}), by_set, "set by a job")
        self.assertGreater(tried, 50)
        self.assertGreater(jobs, 1)

    # ---- a process ----
    def test_of_a_process(self):
        """every quantity of every flow, too large, too small, below 0, exact where nobody is, and in units of another kind: the pack
        itself, a laboratory, and the page say the same of it"""
        data = self.here / "data"
        for folder in ("processes", "masks"):
            shutil.copytree(ROOT / folder, data / folder, ignore=shutil.ignore_patterns("gallery"), dirs_exist_ok=True)
        text = DEVICES[0].read_text()
        tried = refused = jobs = 0
        for flow in sorted(p.stem for p in (ROOT / "masks").glob("*.xml")):
            device = re.sub(r'\s*<(flow ref|workspace flow)="copper[^>]*/>', "", text)
            device = re.sub(r'\s*<scene [^>]*flow="copper.*?</scene>', "", device, flags=re.S).replace("al-masked-rie", flow)
            pack = (ROOT / f"processes/{flow}.xml").read_text()
            rows = re.findall(r'<q [^>]*id="([\w.-]+)"[^>]*/>', pack)
            for number, identity in enumerate(rows):
                row = re.search(rf'<q [^>]*id="{re.escape(identity)}"[^>]*/>', pack)[0]
                unit = re.search(r'unit="([^"]*)"', row)[1]
                was = re.search(r' value="([^"]*)"', row)
                if re.search(r'src="mask"', row):
                    continue
                value = float(was[1]) if was else 1.0
                # what a step's sheet only prints has the unit that its pack gives it; nothing computes with it, so nothing knows another
                rest = re.sub(rf'<set [^>]*q="{re.escape(identity)}"[^>]*/>', "", pack.replace(row, ""))
                printed_only = not re.search(rf'(?<![\w.-]){re.escape(identity)}(?![\w.-])', rest)
                for kind, (now, of) in enumerate(((value * 1e12 or 1e12, unit), (-abs(value) * 1e3 - 1e6, unit), (value, "kg2"),
                                                  (value * 1.01, unit))):
                    if not ALL and (number + kind) % (96 if kind == 3 else 29):  # what is fine costs most
                        continue
                    with self.subTest(flow=flow, id=identity, value=now, unit=of):
                        tried += 1
                        q = f'<q id="{identity}" value="{now:.12g}" urel="0.01" unit="{of}" status="typical" src="lab"/>'
                        lab = ('<process xmlns="urn:flexwright:process:1" flow="%s"><source id="lab" kind="handbook" date="2026-11-20">'
                               'lab</source>%s</process>' % (flow, q))
                        (self.here / "lab.xml").write_text(lab)
                        own = re.sub(r' (value|unit|u|urel|lo|hi|status|src|u-status|unknown)="[^"]*"', "", row)
                        own = own.replace("/>", f' value="{now:.12g}" urel="0.01" unit="{of}" status="typical" src="lab"/>')
                        (data / f"processes/{flow}.xml").write_text(pack.replace(row, own).replace(
                            "  <source ", '  <source id="lab" kind="handbook" date="2026-11-20">lab</source>\n  <source ', 1))
                        by_lab = check("-", "--flow", flow, "--lab", self.here / "lab.xml", input=device)
                        by_pack = check("-", "--flow", flow, input=device, environment={"FLEXWRIGHT_DATA": str(data)})
                        by_page = self.preview(device, lab={"lab.xml": lab}, options={"flow": flow})
                        if not (kind == 2 and printed_only):
                            self.assertEqual(by_lab[0] == 3, by_pack[0] == 3, f"laboratory {by_lab}, pack {by_pack}")
                        self.assertEqual(by_lab, by_page, "preview")
                        refused += by_lab[0] == 3
                        if kind == 2:
                            self.assertEqual(by_lab[0], 3)
                        if tried % 40 == 1:
                            jobs += 1
                            self.assertEqual(self.job(device, files={"lab.xml": lab}, options={"lab": "lab.xml", "flow": flow}), by_lab)
            (data / f"processes/{flow}.xml").write_text(pack)
        self.assertGreater(refused, tried / 3)
        self.assertGreater(jobs, 0)

    def test_of_a_laboratory(self):
        """what a laboratory pack says besides plain values: its sources, its machines and choices, and times that no bench keeps; the command, the
        page's preview and its jobs refuse it for the same reason"""
        device = re.sub(r'\s*<(flow ref|workspace flow)="copper[^>]*/>', "", DEVICES[0].read_text())
        device = re.sub(r'\s*<scene [^>]*flow="copper.*?</scene>', "", device, flags=re.S)
        source = '<source id="lab" kind="handbook" date="2026-11-20">lab</source>'
        rate = '<q id="rie.R" value="0.5" urel="0.01" unit="um/min" status="typical" src="lab"/>'
        strip = '<q id="strip.t" value="%s" urel="0.01" unit="%s" status="typical" src="lab"/>'
        for number, (body, code) in enumerate((
                (source + strip % ("3", "s"), "FW-D577 FW-D587"), (source + strip % ("0.05", "min"), "FW-D577 FW-D587"), (source + strip % ("10", "s"), None),
                (source + rate, None), (source + rate.replace("0.01", "5"), "FW-D530"), (source + rate.replace("typical", "measured"), "FW-D173"),
                (source.replace("11-20", "02-30") + rate, "FW-D171"), (source + rate + rate.replace("0.5", "0.6"), "FW-D211"),
                (source + rate.replace("0.5", "0,5"), "FW-D070"), (source + rate.replace('"lab"', '"nobody"'), "FW-D046"),
                ('<tool equipment="rie" open="09:00-12:00"/>', None), ('<tool equipment="rie" open="25:00-26:00"/>', "FW-D376"),
                ('<tool equipment="rie" open="09:00-12:00" days="Mo"/>', "FW-D376"), ('<tool equipment="rie" closed="2026-02-30"/>', "FW-D376"),
                ('<tool equipment="rie" closed="2026-03-02" to="2026-03-01"/>', "FW-D376"), ('<tool equipment="rei" open="09:00-12:00"/>', "FW-D376"),
                ('<choose alternative="nope"/>', "FW-D375"))):
            with self.subTest(body=body):
                lab = f'<process xmlns="urn:flexwright:process:1" flow="al-masked-rie">{body}</process>'
                (self.here / "lab.xml").write_text(lab)
                by_lab = check("-", "--flow", "al-masked-rie", "--lab", self.here / "lab.xml", input=device)
                self.assertEqual(by_lab[1], frozenset(code.split() if code else []))
                self.assertEqual(by_lab[0] == 3, bool(code))
                self.assertEqual(self.preview(device, lab={"lab.xml": lab}, options={"flow": "al-masked-rie"}), by_lab, "preview")
                if number % 4 == 0:
                    self.assertEqual(self.job(device, files={"lab.xml": lab}, options={"lab": "lab.xml", "flow": "al-masked-rie"}), by_lab, "job")

    def test_of_rows_that_make_no_sense(self):
        """coupons of widths below 0, of lines of metres and of depths of none: refused, and nothing is written"""
        table, lab = self.here / "rows.csv", self.here / "rows.xml"
        for row in ("undercut-ladder,width,10,-3,0.08,um,50,0.5,um", "cd-lines,line,2000000,1999999,0.1,um,,,", "cd-lines,line,-10,9,0.1,um,,,",
                    "etch-rate,rie.R,,45,0.1,um,-90,0.1,min", "etch-rate,rie.R,,45,0.1,um,90000,0.1,min", "etch-rate,rie.R,,2,0.1,m,90,0.1,min",
                    "etch-rate,rie.R,,45,90,um,90,0.1,min", "al-step,,,500,0.01,um,50,0.1,um", "plating-mass,,,-5,0.1,mg,100,1,C"):
            with self.subTest(row=row):
                lab.unlink(missing_ok=True)
                table.write_text("coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\n" + row + "\n")
                done = subprocess.run([PROGRAM, "calibrate", table, "--flow", "al-masked-rie", "-o", lab, "-q"], capture_output=True, text=True)
                self.assertEqual((done.returncode, lab.exists()), (3, False), done.stderr)
                self.assertTrue(codes(done.stderr))

    def test_of_calibrate(self):
        """every rate of every flow, read off a coupon as it is, a hundred thousand times too small and too large, and below 0: what
        calibrate writes is taken by --lab, and what makes no sense is not written"""
        table, lab = self.here / "rates.csv", self.here / "calibrated.xml"
        um_per_min, number, written, refused = {"um/min": 1.0, "nm/min": 1e-3, "Ao/s": 6e-3}, 0, 0, 0
        for flow in sorted(p.stem for p in (ROOT / "masks").glob("*.xml")):
            device = DEVICES[1].read_text().replace("silicon-on-glass", flow)
            for row in re.findall(r"<q [^>]*/>", (ROOT / f"processes/{flow}.xml").read_text()):
                identity, unit = re.search(r' id="([^"]*)"', row)[1], re.search(r' unit="([^"]*)"', row)[1]
                if unit not in um_per_min or "example" in identity:
                    continue
                was = re.search(r' value="([^"]*)"', row)
                rate = um_per_min[unit] * (float(was[1]) if was else 100.0 if unit == "nm/min" else 0.1)
                for factor in (1, 1e-5, 1e5, -1):
                    number += 1
                    if not ALL and number % 13:
                        continue
                    with self.subTest(flow=flow, id=identity, factor=factor):
                        depth = 10 * rate * factor
                        table.write_text("coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\n"
                                         f"etch-rate,{identity},,{depth:.9g},{abs(depth) * 0.02:.9g},um,10,0.01,min\n")
                        lab.unlink(missing_ok=True)
                        done = subprocess.run([PROGRAM, "calibrate", table, "--flow", flow, "-o", lab, "-q"], capture_output=True, text=True)
                        self.assertEqual(done.returncode == 0, lab.exists())
                        if factor == -1:
                            self.assertEqual((done.returncode, codes(done.stderr)), (3, {"FW-D278"}))
                        if factor == 1:
                            self.assertEqual(done.returncode, 0, done.stderr)
                        if done.returncode == 0:
                            self.assertNotEqual(check("-", "--flow", flow, "--lab", lab, input=device)[0], 3)
                            written += 1
                        else:
                            self.assertEqual(done.returncode, 3)
                            refused += 1
        self.assertGreater(written, 0)
        self.assertGreater(refused, 0)


if __name__ == "__main__":
    unittest.main()
