#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is required of devices under voltage: bands hold what the same device does with a modulus that is off by what its flexures'
stiffness is said to be off by."""
import json
import pathlib
import re
import tempfile
import unittest

from common import run

CLAMP = """<device xmlns="urn:flexwright:device:1" name="clamp-arm"><parameter name="volts" value="39 V" min="0 V" max="300 V"/>
<material ref="silicon-100" youngs-modulus="160 GPa" thickness="50 um"/><flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no" anchor="500 um"/>
<flexure id="la" kind="leaf" length="500 um" width="8 um" fillet="5 um"/><mechanism><body id="arm" x="0 mm" y="0 mm">
<plate x="0.9 mm" width="900 um" height="160 um"/><plate x="1.25 mm" y="0.2 mm" width="150 um" height="300 um"/></body>
<revolute id="A" a="ground" b="arm" hinge="la" axis="-90 deg"/></mechanism>
<probe id="way" kind="displacement" on="arm" x="1.1 mm" y="-0.08 mm" direction="-90 deg"/>
<probe id="kk" kind="stiffness" on="arm" x="1.1 mm" y="-0.08 mm" direction="-90 deg"/><probe id="pull" kind="force" of="cl"/>%s
<scene name="go" duration="40 ms"><comb-drive id="cl" kind="plate" on="arm" x="1.0 mm" y="-0.08 mm" direction="-90 deg" gap="12 um"
length="400 um" voltage="volts"%s/><air kind="slide" on="arm" gap="20 um"/></scene></device>"""
SLOWLY = ' law="ramp" rise="30 ms"'


def said_of(text, *settings, command="check", more=()):
    options = ("--corners", "none", "--advice", "none") if command == "check" else ()
    with tempfile.TemporaryDirectory() as place:
        device = pathlib.Path(place, "device.xml")
        device.write_text(text)
        done = run(command, device, *options, "--json", *more, *(w for s in settings for w in ("--set", s)))
    return json.loads(done.stdout)


def modulus(gpa):
    return f"material/@youngs-modulus={gpa} GPa"


class Equilibria(unittest.TestCase):
    """A frequency and a stiffness about an equilibrium that a softer device has elsewhere."""

    ASKED = '<require frequency="1" plane="in" min="580 Hz" scene="go"/><require probe="kk" min="0.1 N/m" scene="go"/>'

    def test_the_equilibrium_moves_with_the_stiffness(self):
        text = CLAMP % (self.ASKED, SLOWLY)
        said = said_of(text)
        self.assertEqual(said["verdict"], "inconclusive")
        for gpa in (158.4, 161.6):
            other = said_of(text, modulus(gpa))
            for was, now in zip(said["requirements"], other["requirements"]):
                self.assertTrue(was["band"][0] < now["value"] < was["band"][1], (was["probe"], gpa, was["band"], now["value"]))

    def test_far_from_pull_in_bands_are_narrow(self):
        low, high = said_of(CLAMP % (self.ASKED, SLOWLY), "volts=10 V")["requirements"][0]["band"]
        self.assertLess(high - low, 0.02 * high)

    def test_without_a_softer_equilibrium_it_is_undecided(self):
        said = said_of(CLAMP % (self.ASKED.replace("580 Hz", "10 Hz"), SLOWLY), "volts=41.2 V")
        first = said["requirements"][0]
        self.assertEqual(first["verdict"], "inconclusive")
        self.assertTrue(any("no stable equilibrium was found" in r["text"] for r in said["reasons"]), said["reasons"])


GUIDED = """<device xmlns="urn:flexwright:device:1" name="guided"><parameter name="volts" value="60 V"/><parameter name="force" value="0 uN"/>
<material ref="silicon-100" youngs-modulus="160 GPa" thickness="50 um"/><flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no"/>
<flexure id="la" kind="leaf" length="900 um" width="5 um" fillet="5 um"/><flexure id="lb" kind="leaf" length="780 um" width="5 um" fillet="5 um"/>
<mechanism><body id="stage" x="0 mm" y="1.2 mm"><plate width="3400 um" height="300 um" y="0.1 mm"/></body>
<revolute id="A" a="ground" a-x="-1.1 mm" a-y="0.4 mm" b="stage" b-x="-1.1 mm" b-y="-0.8 mm" hinge="la" axis="0 deg"/>
<revolute id="B" a="ground" a-x="1.1 mm" a-y="0.46 mm" b="stage" b-x="1.1 mm" b-y="-0.74 mm" hinge="lb" axis="0 deg"/></mechanism>
<probe id="stroke" kind="displacement" on="stage" direction="0 deg"/><require probe="stroke" measure="final" min="0.1 um"/>
<scene name="slow" duration="60 ms"><comb-drive id="main" kind="comb" on="stage" x="1.75 mm" y="0.1 mm" direction="0 deg" fingers="12" gap="10 um"
overlap="40 um" length="120 um" width="8 um" voltage="volts" law="ramp" rise="58 ms"/><force on="stage" fx="force" law="ramp" rise="58 ms"/>
<air kind="slide" on="stage" gap="20 um"/></scene></device>"""


class PullIn(unittest.TestCase):
    """What pull-in voltages may be off by for the stiffness of flexures: no more than that stiffness is, where nothing else acts."""

    def pull_in(self, *settings):
        return said_of(GUIDED, *settings, command="statics")["pull_in"][0]

    def test_a_leaf_that_is_far_displaced_is_hardly_stretched(self):
        pull = self.pull_in()
        self.assertTrue(0.005 < pull["stiffness_error"] < 0.03, pull)  # it was 4.05: of energies along leaves that become shorter
        softer = self.pull_in(modulus(160 * (1 - pull["stiffness_error"])))
        self.assertAlmostEqual((softer["voltage_V"] / pull["voltage_V"]) ** 2, 1 - pull["stiffness_error"], places=3)
        said = said_of(GUIDED)
        self.assertEqual(said["verdict"], "accept", said["reasons"])

    def test_other_loads_are_followed_again(self):
        pull = self.pull_in("force=100 uN")
        softer = self.pull_in("force=100 uN", modulus(160 * (1 - 0.005)))
        self.assertGreaterEqual(pull["stiffness_error"], 1 - (softer["voltage_V"] / pull["voltage_V"]) ** 2)

    def test_so_it_is_with_modes(self):
        with tempfile.TemporaryDirectory() as place:
            device = pathlib.Path(place, "device.xml")
            device.write_text(GUIDED)
            said = json.loads(run("modes", device, "--at", "equilibrium", "--set", "volts=300 V", "--json").stdout)
        self.assertLess(said["stiffness_error"], 0.03)  # it was 0.35


ON_AN_ARM = """<device xmlns="urn:flexwright:device:1" name="clamp"><parameter name="volts" value="20 V" min="0 V" max="300 V"/>
<material ref="silicon-100" youngs-modulus="160 GPa" thickness="50 um"/><flow ref="silicon-on-glass" carrier="insulating"/>
<flexure id="la" kind="leaf" length="500 um" width="6 um" fillet="5 um"/><flexure id="lb" kind="leaf" length="400 um" width="7 um" fillet="5 um"/>
<mechanism><body id="arm" x="0.5 mm" y="0.6 mm" mass="0.05 mg" inertia="0.01 mg mm^2" com-x="0.3 mm" com-y="0.05 mm"/>
<body id="tip" x="1.8 mm" y="0.7 mm" mass="0.02 mg" inertia="0.003 mg mm^2"/>
<revolute id="A" a="ground" a-x="0 mm" a-y="0.5 mm" b="arm" b-x="-0.5 mm" b-y="-0.1 mm" hinge="la" axis="0 deg"/>
<revolute id="B" a="arm" a-x="0.9 mm" a-y="0.1 mm" b="tip" b-x="-0.4 mm" b-y="0 mm" hinge="lb" axis="-90 deg"/></mechanism>
<scene name="both" duration="60 ms">
<comb-drive id="p1" kind="plate" on="arm" x="0.6 mm" y="0.2 mm" direction="90 deg" gap="12 um" length="300 um" voltage="volts"/>
<comb-drive id="p2" kind="comb" on="tip" against="arm" x="0.2 mm" y="-0.1 mm" direction="-80 deg" gap="5 um" fingers="20" overlap="30 um"
length="70 um" width="8 um" voltage="1.2*volts"/><force on="tip" x="0.1 mm" fy="-1 uN"/></scene></device>"""


class Followed(unittest.TestCase):
    """A path of equilibria that is smooth is followed to where it turns, however little its softest motion is pushed on the way."""

    def test_a_plate_and_a_comb_on_one_arm(self):
        # rigid bodies on eight beam elements a leaf, with these electrodes, lose their stability at 28.97 V without ends of fingers,
        # which add (B^3/(6 g^3) + b B^2/g^2)/(B^3/(6 g^3)) = 1.23 to what the comb turns its rotor by, and 1.08 aside
        pull = said_of(ON_AN_ARM, command="statics")["pull_in"][0]
        self.assertNotEqual(pull["kind"], "none", pull["why"])
        self.assertTrue(0.96 < pull["voltage_V"] / 1.2 / 28.97 < 0.985, pull["voltage_V"] / 1.2)


def clamp(*drives):
    """Plates at the arm of CLAMP, each with its table."""
    start = CLAMP % ('<require probe="way" measure="peak" max="12 um" scene="go"/>', "")
    head, tail = start.split('<comb-drive', 1)
    place = {"down": 'x="1.0 mm" y="-0.08 mm" direction="-90 deg"', "up": 'x="0.8 mm" y="0.08 mm" direction="90 deg"'}
    plates = "".join(f'<comb-drive id="{name}" kind="plate" on="arm" {place[side]} gap="12 um" length="{length}" voltage="volts" law="table" table="{table}"/>'
                     for name, (side, length, table) in zip(("cl", "d1", "d2"), drives))
    return (head + plates + tail.split("/>", 1)[1]).replace('duration="40 ms"', 'duration="90 ms"')


class Drives(unittest.TestCase):
    """Drives that do not act together pull in as those do that act at an instant."""

    FIRST, LATER = "0 ms: 0; 30 ms: 1; 40 ms: 1; 45 ms: 0", "0 ms: 0; 50 ms: 0; 80 ms: 1"

    def pull_in(self, *drives):
        return said_of(clamp(*drives), "volts=30 V", command="statics")["pull_in"][0]

    def test_those_that_oppose_each_other(self):
        alone = self.pull_in(("down", "400 um", self.FIRST))["voltage_V"]
        both = self.pull_in(("down", "400 um", self.FIRST), ("up", "400 um", self.LATER))
        self.assertLess(abs(both["voltage_V"] / alone - 1), 1e-6)  # 49.25 V for 41.31, as if both held it at once
        self.assertLess(abs(both["at_s"] - 40e-3), 1e-6)
        self.assertEqual(both["comb"], "cl")
        said = said_of(clamp(("down", "400 um", self.FIRST), ("up", "400 um", self.LATER)), "volts=40.5 V")
        self.assertIn("pulls in at 41.31 V, or at less", " ".join(r["text"] for r in said["reasons"]))

    def test_those_that_follow_each_other(self):
        alone = self.pull_in(("up", "400 um", self.FIRST))["voltage_V"]
        each = self.pull_in(("up", "400 um", self.FIRST), ("down", "200 um", self.LATER), ("up", "100 um", "0 ms: 0; 85 ms: 0; 86 ms: 0.1"))
        self.assertLess(each["voltage_V"], alone * (1 + 1e-6))
        after = self.pull_in(("down", "400 um", self.FIRST), ("down", "399 um", self.LATER))["voltage_V"]
        self.assertLess(abs(after / self.pull_in(("down", "400 um", self.FIRST))["voltage_V"] - 1), 1e-6)

    def test_those_of_one_law_are_one(self):
        together = self.pull_in(("down", "400 um", self.LATER), ("up", "400 um", self.LATER))
        self.assertIsNone(together["at_s"])
        self.assertGreater(together["voltage_V"], 45)


class Motions(unittest.TestCase):
    """What may be missing of a pull is in what motions are required to do and in what hinges bear, found again with that pull."""

    STEP = '<require probe="way" measure="peak" min="%s" scene="go"/><require probe="pull" measure="maximum" min="1 nN" scene="go"/>'

    def holds(self, was, now):
        self.assertTrue(was["band"][0] < now["value"] < was["band"][1], (was["probe"], was["measure"], was["band"], now["value"]))

    def test_of_a_comb(self):
        text = GUIDED.replace('<scene name="slow"', '<probe id="pull" kind="force" of="main"/><require probe="pull" measure="final" min="0.1 uN"/><scene name="slow"')
        said = said_of(text)
        fringe = said["pull_in"][0]["fringe"]
        self.assertGreater(fringe, 0.03)
        more = said_of(text, f"volts={60 * (1 + fringe) ** 0.5 * 0.9999} V")
        for was, now in zip(said["requirements"], more["requirements"]):
            self.holds(was, now)
            self.assertLess(was["band"][1] - was["value"], (fringe + 0.025) * was["value"])  # in proportion, far from pull-in
        for was, now in zip(said["hinges"], more["hinges"]):
            self.assertLess(now["utilisation"], was["utilisation_band"][1])

    def test_what_it_surely_holds_is_said(self):
        """the largest voltage of a scene that the margin still allows: there it is accepted, and a little above it is not"""
        def margin(volts):
            pull = said_of(GUIDED, f"volts={volts} V", command="statics")["pull_in"][0]
            share = (1 + pull["fringe"]) * (volts / pull["fingers_V"]) ** 2
            return pull, pull["margin"] ** 2 * (1 - pull["stiffness_error"]) / (1 + pull["fringe"]) * (1 - share)
        least = margin(60)[0]["least_V"]
        self.assertLess(least, margin(60)[0]["voltage_V"])
        self.assertAlmostEqual(margin(least)[1], 1, delta=1e-3)

    def test_near_pull_in_it_is_more_than_in_proportion(self):
        text = CLAMP % ('<require probe="way" measure="final" max="6 um" scene="go"/>', SLOWLY)
        said = said_of(text)
        fringe = said["pull_in"][0]["fringe"]
        more = said_of(text, f"volts={39 * (1 + fringe) ** 0.5 * 0.9999} V", modulus(159.2))
        self.holds(said["requirements"][0], more["requirements"][0])
        self.assertGreater(more["requirements"][0]["value"], 1.15 * said["requirements"][0]["value"])

    def test_thrown_near_its_stator(self):
        # rejected with a band of 1 %, where a modulus 0.6 % lower turns it
        text = CLAMP % (self.STEP % "5.26 um", "")
        said = said_of(text, "volts=37 V")
        self.assertLess(said["requirements"][0]["value"], 5.26e-6)
        self.assertGreater(said_of(text, "volts=37 V", modulus(159))["requirements"][0]["value"], 5.26e-6)
        self.assertEqual(said["requirements"][0]["verdict"], "inconclusive", said["requirements"][0])
        self.assertEqual(said["verdict"], "inconclusive")
        # what it does for certain is decided all the same: with less pull, or stiffer, it goes as far
        said = said_of(CLAMP % (self.STEP % "4.9 um", ""), "volts=37 V")
        self.assertEqual(said["requirements"][0]["verdict"], "accept", said["requirements"][0])

    def test_with_exact_beams_of_a_stated_stiffness(self):
        # they are off by nothing, and the fringe was left out with what they are off by: 94.7 % (92.7 to 95.8) accepted beside 92.7 to 127.1
        text = f"""<device xmlns="urn:flexwright:device:1" name="arm"><material ref="silicon-100" thickness="28 um" strength="100 MPa"/>
<limits safety-factor="2"/><flow ref="silicon-on-glass" carrier="insulating"/><flexure id="F" kind="csfh" radius="57 um" angle="176 deg" width="6.6 um" fillet="3 um"/>
<mechanism><body id="arm" x="-312 um" y="-416 um" mass="6.2 ug" inertia="0.56 ug mm^2"/><revolute id="H" a="ground" a-x="0 um" a-y="0 um" b="arm"
 b-x="312 um" b-y="416 um" hinge="F" axis="-67 deg" stiffness="2.9e-07 N m/rad"/></mechanism><scene name="go" duration="11 ms"><comb-drive id="V" kind="comb"
 on="arm" x="0 um" y="0 um" direction="323 deg" fingers="52" gap="24.6 um" overlap="20.5 um" length="170 um" voltage="116 V" law="expression"
 factor="(1 - cos(pi*time/(11 ms)))/2"/></scene></device>"""
        usual, exact = said_of(text), said_of(text, more=("--hinge-model", "elastica"))
        fringe = exact["pull_in"][0]["fringe"]
        for said in usual, exact:
            hinge = said["hinges"][0]
            self.assertGreater(hinge["utilisation_band"][1], hinge["utilisation"] * (1 + 0.9 * fringe), said["hinge_model"])

    def test_a_carrier_that_conducts_takes_of_the_pull(self):
        text = GUIDED.replace("silicon-on-glass", "soi-deep-rie").replace(' carrier="insulating"', "")
        low = {flow: (r := said_of(t)["requirements"][0])["band"][0] / r["value"] for flow, t in (("glass", GUIDED), ("soi", text))}
        self.assertLess(low["soi"], low["glass"] - 0.02)


# a stage on four leaves between two combs at its right side, or above and below it
STAGE = """<device xmlns="urn:flexwright:device:1" name="stage"><parameter name="volts" value="15 V" min="0 V" max="200 V"/>
<material ref="silicon-100" thickness="50 um"/><flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no"/>
<flexure id="leaf" kind="leaf" length="400 um" width="6 um" gap="10 um"/><mechanism><body id="left" x="0 mm" y="0.75 mm" width="120 um"/>
<body id="stage" x="0.9 mm" y="1.5 mm" plate-width="0.7 mm" plate-height="1.5 mm"/><body id="right" x="1.8 mm" y="0.75 mm" width="120 um"/>
<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="left" b-x="0 mm" b-y="-0.75 mm" hinge="leaf"/>
<revolute id="B" a="left" a-x="0 mm" a-y="0.75 mm" b="stage" b-x="-0.9 mm" b-y="0 mm" hinge="leaf"/>
<revolute id="C" a="stage" a-x="0.9 mm" a-y="0 mm" b="right" b-x="0 mm" b-y="0.75 mm" hinge="leaf"/>
<revolute id="D" a="right" a-x="0 mm" a-y="-0.75 mm" b="ground" b-x="1.8 mm" b-y="0 mm" hinge="leaf"/></mechanism>
<scene name="go" duration="20 ms">%s<air kind="slide" on="stage" gap="20 um"/></scene>%s</device>"""
DRIVE = """<comb-drive id="%s" kind="comb" on="stage" x="%g mm" y="%g mm" direction="%d deg" fingers="15" gap="10 um" %s voltage="volts"/>"""


def aligned(away_um):
    shape = f'overlap="40 um" length="{40 + away_um} um"'
    return "".join(DRIVE % (name, 0.43, y, 0, shape) for name, y in (("upper", 0.44), ("lower", -0.44)))


def aside(shape):
    return "".join(DRIVE % (name, 0, y, turn, shape) for name, y, turn in (("upper", 0.845, 90), ("lower", -0.845, -90)))


class LeaningWalls(unittest.TestCase):
    """walls that lean by 3 % of a depth of 50 um stand 0.75 um further out at one face: electrodes and contacts as made were those of
    straight walls, so that plates that snap at 27.5 V were accepted at 28, and a grip of 2.75 mN where 2.2 was the most"""
    DEVICE = """<device xmlns="urn:flexwright:device:1" name="leans"><material ref="silicon-100" thickness="50 um"%(modulus)s/>
<limits safety-factor="1.2"/><flow ref="%(flow)s"/><flexure id="leaf" kind="leaf" length="500 um" width="12 um" fillet="6 um"/>
<mechanism><body id="head" x="0 mm" y="0.9 mm" plate-width="0.6 mm" plate-height="0.6 mm"/>
<revolute id="A" a="ground" b="head" b-y="-0.9 mm" hinge="leaf" axis="0 deg"/></mechanism>%(asked)s
<scene name="s" duration="60 ms">%(acts)s<material-damping loss-factor="0.2"/></scene><die clearance="600 um"%(die)s/></device>"""
    LAB = """<process xmlns="urn:flexwright:process:1" flow="%(flow)s"><source id="me" kind="measured" date="2026-10-01">me</source>%(q)s</process>"""

    def judged(self, flow, a, values, acts, asked, modulus="", die=""):
        q = "".join(f'<q id="{k}" value="{v}" u="0" unit="{unit}" status="measured" src="me"/>' for k, v, unit in values(a))
        with tempfile.TemporaryDirectory() as here:
            lab = pathlib.Path(here) / "lab.xml"
            lab.write_text(self.LAB % {"flow": flow, "q": q})
            text = self.DEVICE % {"flow": flow, "acts": acts, "asked": asked, "modulus": modulus, "die": die}
            done = run("check", "-", "--lab", lab, "--json", "--advice", "none", input=text)
        self.assertIn(done.returncode, (0, 1, 4), done.stderr)
        return json.loads(done.stdout)

    def test_plates_snap_earlier(self):
        """C' = eps h L/((g - x)^2 - d^2): the fold is at 27.5 V with d = 1.5 um, the stiffer leaf included, and 29.4 V of straight walls"""
        def at(volts, a):
            acts = f'<comb-drive id="plate" kind="plate" on="head" x="0.3 mm" direction="0 deg" gap="6 um" length="400 um" voltage="{volts} V" law="ramp" rise="40 ms"/>'
            said = self.judged("soi-deep-rie", a, lambda a: (("drie.A", a, "1"), ("litho.edge", 0, "um"), ("soi.d", 50, "um")), acts,
                               '<probe id="way" kind="displacement" on="head" direction="0 deg"/><require probe="way" measure="final" max="3 um"/>',
                               modulus=' youngs-modulus="150 GPa"', die=' release-pitch="72 um"')
            found = re.findall(r"pull-in of comb drive plate is at ([\d.]+) V", " ".join(r["text"] for r in said["reasons"]))
            return said["verdict"], [float(v) for v in found]

        verdict, pull_in = at(28, 0.97)
        self.assertEqual(verdict, "inconclusive")
        self.assertAlmostEqual(pull_in[0] / 27.5, 1, delta=0.01)
        self.assertEqual(at(28, 1)[0], "accept")

    def test_contacts_meet_where_walls_stand_out_most(self):
        """a stop in series with a cable of its own stiffness, 2 um away: (4 - 2 um) 1 N/mm, and 0.75 um more where the wall leans"""
        def at(a, most, stop="2 um"):
            acts = ('<tendon id="pull" draw="4 um" stiffness="2000 N/m" law="ramp" rise="30 ms"><eyelet on="head"/><eyelet on="ground" x="0.85 mm" y="0.9 mm"/></tendon>'
                    f'<contact id="stop" a="head" a-x="0.3 mm" a-face="0 deg" b="ground" b-x="0.3 mm + {stop}" b-y="0.9 mm" side="outside" undrawn="placed" '
                    'distance="0 um" stiffness="2000 N/m" damping="1e-3 N s/m"/>')
            said = self.judged("al-masked-rie", a, lambda a: (("rie.A", a, "1"), ("litho.edge", 0, "um"), ("made.al-edge", 0, "um"), ("si.d", 50, "um")), acts,
                               f'<probe id="grip" kind="force" of="stop"/><require probe="grip" measure="final" {most}/>')
            grip = [r for r in said["requirements"] if r["probe"] == "grip"]
            return said["verdict"], {r["code"] for r in said["reasons"]}, grip

        verdict, codes, _ = at(0.97, 'max="2.2 mN"')
        self.assertEqual(verdict, "inconclusive")
        self.assertIn("FW-D712", codes)
        verdict, codes, grip = at(0.97, 'max="3 mN"')
        self.assertEqual((verdict, codes & {"FW-D712"}), ("accept", set()))
        made = grip[0]["as_fabricated"]
        for band in (made["band"], made["all_corners_band"]):
            self.assertTrue(band[0] < 2.0e-3 and 2.75e-3 < band[1] < 2.9e-3, made)
        self.assertEqual(at(1, 'max="2.2 mN"')[0], "accept")


class Tips(unittest.TestCase):
    """What ends of fingers add (decision 212). Independent: a finite solution of the finger's cell with square tips, and its fold on the
    device's own spring; round tips pull somewhat less, and edges add less to what the root pulls than to faces."""

    def pull_in(self, drives, *settings):
        return said_of(STAGE % (drives, ""), *settings, command="statics")["pull_in"][0]

    def test_the_root_of_the_other_comb_pulls(self):
        for away, square in ((10, 18.4), (16, 33.0), (20, 42.3)):  # 57 V without
            found = self.pull_in(aligned(away), "volts=5 V")
            self.assertEqual(found["kind"], "fold")
            self.assertTrue(square < found["voltage_V"] < 1.15 * square, (away, found["voltage_V"]))
            # square tips are within what may be missing
            self.assertLess(found["voltage_V"] / (1 + found["fringe"]) ** 0.5, 1.06 * square)
        self.assertEqual(said_of(STAGE % (aligned(10), ""), "volts=30 V", command="statics").get("verdict"), None)
        said = said_of(STAGE % (aligned(10), ""), "volts=30 V")
        self.assertEqual(said["verdict"], "reject", said["reasons"])

    def test_ends_draw_aside(self):
        for overlap, true in ((10, 35.25), (20, 27.7)):  # 43.25 and 30.6 V without
            found = self.pull_in(aside(f'overlap="{overlap} um" length="100 um"'), "volts=5 V")
            self.assertEqual(found["kind"], "side")
            self.assertLess(abs(found["voltage_V"] / true - 1), 0.02, (overlap, found["voltage_V"]))

    def test_a_depth_that_no_flow_makes(self):
        shape = 'overlap="10 um" length="100 um"%s'
        plain, shallow, deep = (self.pull_in(aside(shape % more), "volts=5 V")["voltage_V"] for more in ("", ' depth="10 um"', ' depth="80 um"'))
        self.assertEqual([plain, plain], [shallow, deep])
        with tempfile.TemporaryDirectory() as place:
            device = pathlib.Path(place, "device.xml")
            for more, told in ((' depth="10 um"', True), (' depth="50 um"', False)):
                device.write_text(STAGE % (aside(shape % more), ""))
                said = run("statics", device, "--set", "volts=5 V").stderr
                self.assertEqual("FW-D713" in said and "all of the layer, 50 um" in said, told, said)

    def test_one_voltage_between_two_electrodes(self):
        two = DRIVE % ("bias", 0, 0.845, 90, 'overlap="10 um" length="100 um"')
        with tempfile.TemporaryDirectory() as place:
            device = pathlib.Path(place, "device.xml")
            device.write_text(STAGE % (aside('overlap="10 um" length="100 um"') + two, ""))
            done = run("statics", device)
            self.assertEqual(done.returncode, 3)
            self.assertIn("comb drive bias and comb drive upper are the same electrodes", done.stderr)
            self.assertIn("FW-D714", done.stderr)
            device.write_text(STAGE % (aside('overlap="10 um" length="100 um"') + two.replace('"volts"', '"0 V"'), ""))
            self.assertNotIn("FW-D714", run("statics", device, "--set", "volts=5 V").stderr)

    def test_beyond_what_was_tested(self):
        said = said_of(STAGE % (aside('overlap="4 um" length="100 um"'), ""), "volts=5 V")
        self.assertEqual(said["verdict"], "inconclusive")
        self.assertIn("overlap by less than half of its gap", " ".join(r["text"] for r in said["reasons"]))

    def test_a_capacitance_has_its_ends_in_a_band(self):
        probe = '<probe id="c" kind="capacitance" of="upper"/><require probe="c" measure="final" min="1 fF" scene="go"/>'
        said = said_of(STAGE % (aligned(60).replace("40 um", "20 um").replace("100 um", "80 um"), probe), "volts=5 V")["requirements"][0]
        low, high = said["band"]
        # two gaps of 15 fingers: strips, edges 0.195, ends 15.8 um in the plane and 1.27 times that in space
        true = 2 * 15 * 8.854e-12 * 50e-6 * (20 * 1.195 + 15.8 * 1.27) / 10
        self.assertTrue(low < true < high, (said["band"], true))
        self.assertGreater(high / low, 1.1)



TIP = """<device xmlns="urn:flexwright:device:1" name="tip"><parameter name="press" value="0.35 mN"/><material ref="silicon-100" thickness="50 um"/>
<limits safety-factor="2"/><flow ref="al-masked-rie"/><flexure id="f" kind="leaf" length="400 um" width="9 um" fillet="6 um"/><mechanism>
<body id="arm" x="0.75 mm" y="0 mm"><plate width="700 um" height="200 um"/></body>
<revolute id="A" a="ground" b="arm" b-x="-0.75 mm" hinge="f" axis="90 deg"/></mechanism>
<scene name="tip" duration="%s"><force on="arm" x="0.2 mm" fx="-press" fy="0.05 mN" law="ramp" rise="%s"/></scene></device>"""

TOGGLE = """<device xmlns="urn:flexwright:device:1" name="toggle"><parameter name="half" value="sqrt((1.2 mm)^2 - (75 um)^2)"/>
<parameter name="th" value="asin(75 um/(1.2 mm))"/><parameter name="xs" value="2*half + 0.35 mm"/><parameter name="load" value="100 uN"/>
<material ref="silicon-100" thickness="50 um"/><flow ref="soi-deep-rie"/><die release-pitch="79 um" tethers="no"/>
<flexure id="thin" kind="leaf" length="300 um" width="5 um"/><flexure id="guide" kind="leaf" length="400 um" width="13 um"/><mechanism>
<body id="left" x="half/2" y="37.5 um" phi="th" width="80 um"/><body id="right" x="1.5*half" y="37.5 um" phi="-th" width="80 um"/>
<body id="slider" x="xs" y="0 mm" plate-width="0.2 mm" plate-height="0.62 mm"/>
<revolute id="A" a="ground" b="left" b-x="-0.6 mm" hinge="thin" axis="th-90 deg" free-angle="th"/>
<revolute id="B" a="left" a-x="0.6 mm" b="right" b-x="-0.6 mm" hinge="thin" axis="-90 deg" free-angle="-2*th"/>
<revolute id="C" a="right" a-x="0.6 mm" b="slider" b-x="-0.35 mm" hinge="thin" axis="-th-90 deg" free-angle="th"/>
<revolute id="E" a="ground" a-x="xs" a-y="0.53 mm" b="slider" b-y="0.53 mm" hinge="guide" axis="180 deg"/>
<revolute id="F" a="ground" a-x="xs" a-y="-0.53 mm" b="slider" b-y="-0.53 mm" hinge="guide" axis="0 deg"/></mechanism>
<scene name="hold" duration="2.2 s"><force on="left" x="0.6 mm" fy="-load" law="ramp" rise="2 s"/><air kind="slide" gap="2 um"/></scene></device>"""
AT_REST = ("--effects", "joint-elasticity,applied-load,nonlinear-hinge")


class Slowly(unittest.TestCase):
    """A scene that is followed as a row of equilibria is followed as one with larger loads, too; where that row ends it may snap."""

    def may_snap(self, said):
        return any(r["code"] == "FW-D672" for r in said["reasons"])

    def test_a_leaf_that_has_no_fold(self):
        """it turns 2.79, 2.86 and 2.98 deg under 1, 1.017 and 1.05 times its load, and 20.8 under three times that"""
        for press in ("0.30 mN", "0.35 mN"):
            said = said_of(TIP % ("2 s", "1.8 s"), f"press={press}")
            self.assertEqual(said["verdict"], "accept", said["reasons"])
        softer = said_of(TIP % ("2 s", "1.8 s"), "press=0.3559 mN")  # 1.017 times
        self.assertLess(softer["hinges"][0]["utilisation"], said["hinges"][0]["utilisation_band"][1])

    def test_whatever_the_accuracy(self):
        """inertia, which its bound says does 0.63 %, acts in the first of them"""
        for accuracy in ("1e-3", "7e-3", "3e-2"):
            said = said_of(TIP % ("200 ms", "180 ms"), more=("--accuracy", accuracy))
            self.assertEqual(said["verdict"], "accept", (accuracy, said["reasons"]))

    def test_so_it_is_at_corners(self):
        with tempfile.TemporaryDirectory() as place:
            device = pathlib.Path(place, "device.xml")
            device.write_text(TIP % ("200 ms", "180 ms"))
            said = json.loads(run("check", device, "--advice", "none", "--json").stdout)
        self.assertEqual(said["verdict"], "accept", said["reasons"])

    def test_a_toggle_that_snaps(self):
        """at 213 uN"""
        said = said_of(TOGGLE, "load=150 uN", more=AT_REST)
        self.assertEqual(said["verdict"], "accept", said["reasons"])
        said = said_of(TOGGLE, "load=211 uN", more=AT_REST)
        self.assertEqual(said["verdict"], "inconclusive")
        self.assertTrue(self.may_snap(said), said["reasons"])

    def test_a_plate_that_may_pull_in(self):
        for volts, verdict in (("30 V", "accept"), ("40 V", "inconclusive"), ("42 V", "inconclusive")):
            said = said_of(CLAMP.replace("40 ms", "2 s") % ("", ' law="ramp" rise="1.8 s"'), f"volts={volts}")
            self.assertEqual(said["verdict"], verdict, (volts, said["reasons"]))

if __name__ == "__main__":
    unittest.main()
