#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""random_devices.py FIRST COUNT DIR: device files of seeds FIRST, FIRST + 1, ..., with the options of `flexwright mask`
that go with each in DIR/SEED.options. The same seed is the same device on every machine.

Six families (a seed's remainder by six): six-bars, six-bars with cables, cranks on two to four legs of any hinge,
stages with combs or plates, chains of bars, four-bars of free-form hinges. Dimensions vary about those of the
gallery, beyond what the gallery declares; not every one can be drawn, and the program then has to say why."""
import pathlib
import random
import sys

HEAD = '<device xmlns="urn:flexwright:device:1" name="%s">\n'
TITLES = ("", "STAGE 7", "A-1/B.2", "UM 0123456789", "GRIPPER_3 REV C", "X")


class Draw:
    """numbers of one seed; only random() itself, which every version of Python gives alike"""

    def __init__(self, seed):
        self.source = random.Random(seed)

    def between(self, low, high, step=None):
        value = low + (high - low) * self.source.random()
        return round(value / step) * step if step else value

    def whole(self, low, high):
        return low + int(self.source.random() * (high - low + 1))

    def of(self, *things):
        return things[int(self.source.random() * len(things))]

    def often(self, share):
        return self.source.random() < share


def um(value):
    return "%.3f um" % value


def csfh(draw, name, length, narrow=False):
    arc = draw.between(140, 260)
    width = draw.between(6, 9 if narrow else 12)
    more = ' width-middle="%s"' % um(width * draw.between(1.0, 1.5)) if draw.often(0.15) else ""
    if draw.often(0.1):
        more += ' fillet="%s"' % um(draw.between(5, 9))
    form = draw.of('length="%s" angle="%.6g deg"' % (um(length), arc),
                   'radius="%s" angle="%.6g deg"' % (um(length / (arc * 3.14159265 / 180)), arc))
    return '  <flexure id="%s" kind="csfh" %s width="%s" gap="%s"%s/>\n' % (name, form, um(width), um(draw.between(7, 12)), more)


def leaf(draw, name):
    width = draw.between(6, 14)
    more = ' width-middle="%s"' % um(width * draw.between(0.5, 1.0)) if width > 12 and draw.often(0.5) else ""
    gap = ' gap="%s"' % um(draw.between(7, 14)) if draw.often(0.8) else ""
    return '  <flexure id="%s" kind="leaf" length="%s" width="%s"%s%s/>\n' % (name, um(draw.between(200, 600)), um(width), gap, more)


def path(draw, name):
    width, gap = draw.between(6, 10), draw.between(7, 10)
    head = '  <flexure id="%s" kind="path" width="%s" gap="%s">\n' % (name, um(width), um(gap))
    if draw.often(0.5):  # hairpin
        leg = draw.between(30, 80)
        body = ('    <line length="%s"/>\n    <arc radius="%s" angle="180 deg"/>\n    <line length="%s"/>\n'
                % (um(leg), um(draw.between(55, 90)), um(leg)))
    else:  # hook
        thin = width * draw.between(0.75, 1.0)
        body = ('    <line length="%s" width-end="%s"/>\n    <arc radius="%s" angle="%.6g deg" width-end="%s"/>\n'
                % (um(draw.between(80, 160)), um(max(thin, 6)), um(draw.between(70, 110)), draw.between(60, 110), um(width)))
    return head + body + "  </flexure>\n"


def hinge_of_any_kind(draw, name):
    kind = draw.of("csfh", "csfh", "leaf", "leaf", "path")
    return csfh(draw, name, draw.between(180, 380)) if kind == "csfh" else leaf(draw, name) if kind == "leaf" else path(draw, name)


def flows(draw, carrier=False):
    """the flows, and their names"""
    silicon = '  <flow ref="al-masked-rie"%s/>\n' % (' carrier="insulating"' if carrier else "")
    copper = '  <flow ref="copper-on-porous-silicon" material="copper-plated" thickness="%s"/>\n' % um(draw.between(7, 10))
    which = "silicon" if carrier else draw.of("silicon", "copper", "both")
    return (silicon if which != "copper" else "") + (copper if which != "silicon" else "")


def die(draw, width_um, height_um):
    if draw.often(0.5):
        return ""
    title = draw.of(*TITLES)
    more = ' title="%s"' % title if title else ""
    if draw.often(0.4):
        more += ' width="%s" height="%s"' % (um(width_um + draw.between(1800, 3500)), um(height_um + draw.between(1800, 3500)))
    if draw.often(0.3):
        more += ' frame="%s"' % um(draw.between(200, 500))
    if draw.often(0.3):
        more += ' lane="%s"' % um(draw.between(60, 200))
    if draw.often(0.3):
        more += ' clearance="%s"' % um(draw.between(60, 300))
    if draw.often(0.2):
        more += ' tethers="no"'
    return "  <die%s/>\n" % more


def scene(content):
    return '  <scene name="s" duration="0.1 ms">\n%s  </scene>\n' % content


def six_bar(draw, cables):
    points = {"A": (700, 150), "B": (200, 1400), "C": (800, 2700), "D": (2200, 2750), "E": (2850, 1450), "F": (2300, 150)}
    size, mirror = draw.between(0.95, 1.6), draw.often(0.5)
    lengths = {"A": 300, "B": 250, "C": 200, "D": 240, "E": 350, "F": 400}
    longer = draw.between(0.75, 1.3)

    def place(x, y, off=0.0):
        x, y = size * x + draw.between(-off, off), size * y + draw.between(-off, off)
        return "%.6g um" % (-x if mirror else x), "%.6g um" % y

    out = [csfh(draw, k, longer * v * draw.between(0.9, 1.1)) for k, v in lengths.items()] + ["  <six-bar>\n"]
    for k, (x, y) in points.items():
        axis = ' axis="%.6g deg"' % draw.between(-180, 180) if draw.often(0.02) else ""
        out.append('    <hinge at="%s" x="%s" y="%s" flexure="%s"%s/>\n' % (k, *place(x, y, 60), k, axis))
    for k in ("AB", "BC", "DE", "EF"):
        out.append('    <link id="%s" width="%s"/>\n' % (k, um(draw.between(100, 200))))
    px, py = place(1500, 2900)
    out.append('    <platform id="CD" width="%s" height="%s" x="%s" y="%s"/>\n  </six-bar>\n'
               % (um(size * draw.between(1350, 1600)), um(size * draw.between(400, 520)), px, py))
    if not cables:
        return "".join(out) + scene('    <force on="CD" fx="1 nN" fy="0 mN"/>\n'), 3000 * size, 3000 * size
    sign, lines = -1 if mirror else 1, []
    for name, x, y in (("T1", -0.55, 3500), ("T2", 0.55, 3500))[:draw.whole(1, 2)]:
        end = (1500 + x / 0.55 * draw.between(2200, 2700)) * size
        hole = ' hole="%s"' % um(draw.between(40, 120)) if draw.often(0.5) else ""
        ring = ' ring="%s"' % um(draw.between(15, 50)) if draw.often(0.5) else ""
        lines.append('    <tendon id="%s" stiffness="262 N/m" slack="-1 nm" draw="0 um">\n'
                     '      <eyelet on="CD" x="%s" y="%s"%s%s/>\n      <eyelet on="ground" x="%s" y="%s"%s%s/>\n    </tendon>\n'
                     % (name, um(sign * x * 1000 * size), um(draw.between(60, 140) * size), hole, ring,
                        um(sign * end), um(y * size), hole, ring))
    return "".join(out) + scene("".join(lines)), 3000 * size, 3000 * size


def revolute(name, a, ax, ay, b, bx, by, hinge):
    return ('    <revolute id="%s" a="%s" a-x="%s" a-y="%s" b="%s" b-x="%s" b-y="%s" hinge="%s"/>\n'
            % (name, a, um(ax), um(ay), b, um(bx), um(by), hinge))


def legs(draw, kind=hinge_of_any_kind, count=None):
    """a coupler on `count` cranks; every hinge its own"""
    count = count or draw.whole(2, 4)
    pitch, height = draw.between(800, 1300, 2), draw.between(1200, 2200, 2)  # halves are exact
    flexures = [kind(draw, "L%d" % i) for i in range(draw.whole(1, 3))]
    body = '    <body id="coupler" x="%s" y="%s" width="%s"' % (um(pitch * (count - 1) / 2), um(height), um(draw.between(130, 200)))
    if count > 2:  # a hinge in the middle of a bar would cut it
        body += (' plate-width="%s" plate-height="%s" plate-x="%s" plate-y="%s"'
                 % (um(pitch * (count - 1) + draw.between(-100, 300)), um(draw.between(200, 400)), um(pitch * (count - 1) / 2),
                    um(height + draw.between(450, 700))))
    body += "/>\n"
    joints = ""
    for i in range(count):
        lean = draw.between(-80, 80, 2) if draw.often(0.3) else 0
        body += ('    <body id="leg%d" x="%s" y="%s" width="%s"/>\n'
                 % (i, um(i * pitch + lean / 2), um(height / 2), um(draw.between(100, 180))))
        flexure = lambda: "L%d" % draw.whole(0, len(flexures) - 1)
        joints += revolute("A%d" % i, "ground", i * pitch, 0, "leg%d" % i, -lean / 2, -height / 2, flexure())
        joints += revolute("B%d" % i, "leg%d" % i, lean / 2, height / 2, "coupler",
                           i * pitch + lean - pitch * (count - 1) / 2, 0, flexure())
    text = "".join(flexures) + "  <mechanism>\n" + body + joints + "  </mechanism>\n"
    pushed = scene('    <force on="coupler" fx="1 nN" fy="0 mN"/>\n')
    return text + pushed, pitch * (count - 1) + 800, height + 500 + (900 if count > 2 else 0)


def comb_stage(draw):
    plate, height = draw.between(650, 900), draw.between(1300, 1700)
    fingers, gap, width = draw.whole(4, 16), draw.between(7, 11), draw.between(6, 10)
    while fingers * 2 * (gap + width) > height / 2 - 150:
        fingers -= 1
    overlap = draw.between(20, 60)
    length = overlap + draw.between(40, 80)
    comb = ""
    for name, side in (("upper", 1), ("lower", -1)):
        comb += ('    <comb-drive id="%s" kind="comb" on="stage" x="%s" y="%s" direction="0 deg" fingers="%d" gap="%s" '
                 'overlap="%s" length="%s" width="%s" voltage="1 V"/>\n'
                 % (name, um(plate / 2 + length - overlap / 2 + draw.between(0, 4)), um(side * height * 0.29), fingers, um(gap),
                    um(overlap), um(length), um(width)))
    half = plate / 2 + draw.between(480, 620)
    y0 = height / 2
    text = leaf(draw, "leaf") + '  <mechanism>\n'
    text += '    <body id="left" x="0 um" y="%s" width="120 um"/>\n' % um(y0)
    text += '    <body id="stage" x="%s" y="%s" plate-width="%s" plate-height="%s"/>\n' % (um(half), um(2 * y0), um(plate), um(height))
    text += '    <body id="right" x="%s" y="%s" width="120 um"/>\n' % (um(2 * half), um(y0))
    text += revolute("A", "ground", 0, 0, "left", 0, -y0, "leaf") + revolute("B", "left", 0, y0, "stage", -half, 0, "leaf")
    text += revolute("C", "stage", half, 0, "right", 0, y0, "leaf") + revolute("D", "right", 0, -y0, "ground", 2 * half, 0, "leaf")
    return text + "  </mechanism>\n" + scene(comb), 2 * half + 400, 2 * y0 + height / 2


def chain(draw):
    """one to four bars one behind the other, from the ground upwards"""
    count, x, y, last = draw.whole(1, 4), 0.0, 0.0, "ground"
    flexures, bodies, joints, at = "", "", "", (0.0, 0.0)
    for i in range(count):
        length, lean = draw.between(900, 1500), draw.between(-250, 250)
        flexures += hinge_of_any_kind(draw, "F%d" % i)
        bodies += ('    <body id="bar%d" x="%s" y="%s" width="%s"/>\n'
                   % (i, um(x + lean / 2), um(y + length / 2), um(draw.between(110, 220))))
        joints += revolute("J%d" % i, last, at[0], at[1], "bar%d" % i, -lean / 2, -length / 2, "F%d" % i)
        x, y, last, at = x + lean, y + length, "bar%d" % i, (lean / 2, length / 2)
    plate = draw.between(300, 700)  # at the end of the last bar: a tool
    bodies = bodies.rsplit("/>", 1)[0] + (' plate-width="%s" plate-height="%s" plate-x="%s" plate-y="%s"/>\n'
                                          % (um(plate), um(draw.between(150, 400)), um(x), um(y)))
    return (flexures + "  <mechanism>\n" + bodies + joints + "  </mechanism>\n"
            + scene('    <force on="bar%d" fx="1 nN" fy="0 mN"/>\n' % (count - 1)), 1500, y)


def free_form(draw):
    return legs(draw, lambda d, name: path(d, name) if d.often(0.6) else csfh(d, name, d.between(200, 350), narrow=True), 2)


def device(seed):
    """(text, options of the program) of a seed"""
    draw = Draw(seed)
    family = seed % 6
    body, width, height = (six_bar(draw, False) if family == 0 else six_bar(draw, True) if family == 1 else
                           legs(draw) if family == 2 else comb_stage(draw) if family == 3 else
                           chain(draw) if family == 4 else free_form(draw))
    # as the cell: cut to 32 characters, and other characters replaced
    name = "random-%d" % seed + draw.of("", "", "-of_a_longer_name_than_a-cell-takes")
    text = HEAD % name + '  <material ref="silicon-100" strength="2.5 GPa" thickness="50 um"/>\n' + flows(draw, family == 3)
    text += body + die(draw, width, height) + "</device>\n"
    options = []
    if draw.often(0.5):
        options += ["--mask-tolerance", draw.of("0.5", "1", "1.42", "2", "3.7", "10", "50")]
    if draw.often(0.4):
        options += ["--mask-vertices", "199"]
    return text, options


def main():
    first, count, where = int(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    where.mkdir(parents=True, exist_ok=True)
    for seed in range(first, first + count):
        text, options = device(seed)
        (where / ("%d.xml" % seed)).write_text(text, encoding="utf-8")
        (where / ("%d.options" % seed)).write_text(" ".join(options) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
