# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program says of a device of the gallery, for tools/solids/gallery and its test: pose of the body that is loaded first, peak
strain of the governing hinge at the equilibrium of the first scene, first frequencies in the plane and across it, each with its band.
Needs nothing but Python."""
import json
import math
import pathlib
import re
import subprocess
import xml.etree.ElementTree as tree

from drawn import bare, rotors_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs/gallery"
EFFECTS = "joint-elasticity,nonlinear-hinge,gravity,applied-load,tendon,point-spring,comb-drive,fringe-field,contact"
UNITS = {"nm": 1e-9, "um": 1e-6, "mm": 1e-3, "m": 1.0, "uN": 1e-6, "mN": 1e-3, "N": 1.0, "deg": math.pi / 180, "rad": 1.0, "ms": 1e-3,
         "s": 1.0, "V": 1.0, "s^2": 1.0, "1": 1.0}


class Device:
    """A device of the gallery with the numbers of its first scene, which loads it at once and for good."""

    def __init__(self, name, text=None):
        self.name = name
        text = re.sub(r"<!--.*?-->", "", text or (GALLERY / name / "device.xml").read_text(encoding="utf-8"), flags=re.S)
        # what is stated of a body or a hinge is not what is drawn of it
        text = re.sub(r'(<(?:hinge|link|platform)\b[^>]*?)/>', lambda m: re.sub(r' (stiffness|damping|mass|inertia)="[^"]*"', "", m[0]), text)
        if not re.search(r"<material [^>]*thickness=", text):
            text = text.replace("<material ", f'<material thickness="{flow_thickness(text):g} um" ', 1)
        for f in re.findall(r"<flow [^>]*?/>", text)[1:]:  # others have scenes of their own
            text = text.replace(f, "")
        self.text = text
        scene = re.search(r"<scene.*?</scene>", text, flags=re.S)[0]
        scene = re.sub(r' (law|rise|frequency)="[^"]*"', "", scene)
        for gone in (r"<air[^>]*?/>", r"<material-damping[^>]*?/>"):
            scene = re.sub(gone, "", scene)
        self.scene = scene
        self.body = next(b for b in re.findall(r' (?:on|a)="([^"]*)"', scene) if b != "ground")
        self.parameters = {p: self.number(v) for p, v in re.findall(r'<parameter name="([^"]*)" value="([^"]*)"', text)}

    def number(self, text):
        """an expression of the file in SI units"""
        def one(m):
            factor, units = 1.0, re.split(r"([ /])", m[2].strip())
            for i in range(0, len(units), 2):
                factor = factor * UNITS[units[i]] if i == 0 or units[i - 1] == " " else factor / UNITS[units[i]]
            return f"({m[1]}*{factor!r})"
        unit = "|".join(sorted(map(re.escape, UNITS), key=len, reverse=True))
        text = re.sub(rf"(?<![\w.])([0-9.]+(?:[eE][-+]?[0-9]+)?) +((?:{unit})(?:[ /](?:{unit}))*)(?![\w^])", one, text)
        return float(eval(text, {"__builtins__": {}}, dict(getattr(self, "parameters", {}))))  # of our own files

    def still(self):
        """the device under the load of its first scene, its loaded body's pose asked for"""
        head = re.sub(r"<scene.*?</scene>", "", self.text, flags=re.S)
        for gone in (r"<workspace.*?/>", r"<require.*?/>", r"<probe.*?/>"):
            head = re.sub(gone, "", head, flags=re.S)
        probes = "".join(f'<probe id="truth-{k}" kind="displacement" on="{self.body}" direction="{d} deg"/>' for k, d in (("x", 0), ("y", 90)))
        probes += f'<probe id="truth-phi" kind="angle" on="{self.body}"/>'
        probes += "".join(f'<probe id="force-{n}" kind="force" of="{n}"/>' for n in re.findall(r'<(?:comb-drive|contact) id="([^"]*)"', self.scene))
        wants = "".join(f'<require probe="truth-{k}" measure="final" min="-1 {u}"/>' for k, u in (("x", "m"), ("y", "m"), ("phi", "rad")))
        place = head.find("<die") if "<die" in head and head.find("<die") > head.find("</mechanism>") > 0 else head.find("</device>")
        return head[:place] + probes + wants + self.scene + head[place:]

    def steady(self, statics):
        """the same load with forces that stay for what pulls with one: the forces of tendons of one pull and of combs, as they are in
        the program's equilibrium"""
        force = {p["id"]: p["value"] for p in statics["probes"]}

        def pulled(m):
            e = tree.fromstring(m[0])
            if e.get("pull") is None:
                return m[0]
            eyes = [(i.get("on"), self.number(i.get("x", "0 m")), self.number(i.get("y", "0 m"))) for i in e]
            (body, x, y), (_, gx, gy) = eyes  # to the ground, over one eyelet
            here = placed(statics["q"][body], x, y)
            far, pull = math.dist(here, (gx, gy)), self.number(e.get("pull"))
            ring = re.sub(r'pull="[^"]*"', 'pull="0 N"', m[0])  # its eyelet is in the drawing
            return ring + as_force(body, x, y, pull * (gx - here[0]) / far, pull * (gy - here[1]) / far)

        def drawn_in(m):
            e = tree.fromstring(m[0])
            a, f = self.number(e.get("direction")), abs(force["force-" + e.get("id")])
            return as_force(e.get("on"), self.number(e.get("x")), self.number(e.get("y")), f * math.cos(a), f * math.sin(a))
        self.scene = re.sub(r"<tendon.*?</tendon>", pulled, self.scene, flags=re.S)
        self.scene = re.sub(r"<comb-drive[^>]*?/>", drawn_in, self.scene)

    def free(self):
        """the device without springs, its combs' rotors hanging on it, and its loads: of those the program says what bodies give"""
        text, loads = bare(self.text), re.sub(r"</?scene[^>]*>|<comb-drive[^>]*?/>", "", self.scene)
        scene = f'<scene name="solid" duration="10 ms">{rotors_of(self.text)}{loads}</scene>'
        wants = "".join(f'<require frequency="{n}" plane="in" min="0.001 Hz"/>' for n in (1, 2, 3))
        return text.replace("</device>", wants + scene + "</device>")

    def loads(self):
        return list(tree.fromstring(self.scene))

    def springs(self):
        return list(tree.fromstring(re.sub(r' xmlns="[^"]*"', "", self.text.split("?>", 1)[-1])).iter("spring"))


def placed(pose, x, y):
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + c * x - s * y, pose[1] + s * x + c * y


def as_force(body, x, y, fx, fy):
    return f'<force on="{body}" x="{x * 1e6:.9g} um" y="{y * 1e6:.9g} um" fx="{fx * 1e6:.9g} uN" fy="{fy * 1e6:.9g} uN" law="ramp" rise="1 ms"/>'


def flow_thickness(text):
    """um, of the first flow's own layer"""
    pack = (ROOT / "processes" / (re.search(r'<flow ref="([^"]*)"', text)[1] + ".xml")).read_text(encoding="utf-8")
    of = re.search(r'<process [^>]*thickness="([^"]*)"', pack)[1]
    return float(re.search(rf'<q id="{re.escape(of)}" value="([^"]*)"', pack)[1])


def run(program, folder, text, *words):
    file = folder / "device.xml"
    file.write_text(text, encoding="utf-8")
    done = subprocess.run([program, words[0], file, *words[1:], "--json"], capture_output=True, text=True, check=False)
    if not done.stdout.strip() or "diagnostics" in done.stdout[:80]:
        raise RuntimeError(f"{' '.join(words)}: {done.stderr[-800:]} {done.stdout[-800:]}")
    return json.loads(done.stdout)


def said(program, device, folder):
    """{quantity: (unit, value, lower, upper)}, and the program's answers: statics, check, modes"""
    statics = run(program, folder, device.still(), "statics")
    device.steady(statics)
    check = run(program, folder, device.still(), "check", "--corners", "none", "--advice", "none", "--effects", EFFECTS)
    modes = run(program, folder, device.free(), "modes", "--scene", "solid")
    swung = run(program, folder, device.free(), "check", "--corners", "none", "--advice", "none")
    out = {}
    for r in check["requirements"]:
        scale, unit = (1e3, "mrad") if r["unit"] == "rad" else (1e6, "um")
        out[f"{r['probe'][6:]} of {device.body}"] = (unit, r["value"] * scale, *(v * scale for v in r["band"]))
    most = max(h["utilisation"] for h in check["hinges"])
    top = next(h for h in check["hinges"] if h["utilisation"] > 0.9999 * most)  # mirrored hinges differ by rounding: the first
    limit = top["strain_limit"] * 1e6
    out[f"peak strain of {top['id']}"] = ("1e-6", top["peak_strain"] * 1e6, *(u * limit for u in top["utilisation_band"]))
    for r in swung["requirements"]:
        out[f"f{r['probe'][-1]} in the plane"] = ("Hz", r["value"], *r["band"])
    for i, m in enumerate(swung["out_of_plane"][0]["modes"][:3]):
        out[f"f{i + 1} across"] = ("Hz", m["f_Hz"], *m["band_Hz"])
    return out, {"statics": statics, "check": check, "modes": modes, "governing": top["id"]}
