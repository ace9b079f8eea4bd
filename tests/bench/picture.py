# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts as SVG: work-precision pictures (log-log, one line per solver, labelled at its end) and their kin."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 1000, 640
LEFT, RIGHT, TOP, BOTTOM = 84, 300, 64, 70
FONT = 'font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'


def milliseconds(n):
    return {-2: "0.01 ms", -1: "0.1 ms", 0: "1 ms", 1: "10 ms", 2: "0.1 s", 3: "1 s", 4: "10 s"}.get(n, f"1e{n} ms")


def spread(places, gap, height=HEIGHT):
    """Moves label heights apart to at least `gap`, keeping their order."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    y = [places[i] for i in order]
    for _ in range(200):
        for k in range(1, len(y)):
            short = gap - (y[k] - y[k - 1])
            if short > 0:
                y[k - 1] -= short / 2
                y[k] += short / 2
    low, high = TOP + 8, height - BOTTOM
    shift = max(0, low - y[0]) if y else 0
    shift = min(shift, max(0, high - (y[-1] if y else 0))) or shift
    out = [0.0] * len(places)
    for place, i in zip(y, order):
        out[i] = place + shift
    return out


class Axis:
    """From `start` to `end`, which are powers of ten where it is logarithmic; either may be the larger."""

    def __init__(self, start, end, caption, text=None, log=True, ticks=None):
        self.start, self.end, self.caption, self.log = start, end, caption, log
        self.ticks = ticks or (list(range(start, end + (1 if end > start else -1), 1 if end > start else -1)) if log else [])
        self.text = text or (lambda n: f"1e{n}" if log else f"{n:g}")

    def share(self, value):
        """0 at the start, 1 at the end"""
        return ((math.log10(value) if self.log else value) - self.start) / (self.end - self.start)

    def holds(self, value):
        return (value > 0 or not self.log) and -1e-9 <= self.share(value) <= 1 + 1e-9


class Line:
    """points: (x, y) or (x, y, low, high), of which the last two are an interval of y; ordered: they are joined as they come, else
    from left to right"""

    def __init__(self, label, colour, points, width=1.6, dash="", mark="circle", ordered=False):
        self.label, self.colour, self.width, self.dash, self.mark, self.ordered = label, colour, width, dash, mark, ordered
        self.points = points


def marker(shape, x, y, r, colour):
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="{colour}"/>'
    if shape == "ring":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="#ffffff" stroke="{colour}" stroke-width="1.4"/>'
    around = {"square": ((-1, -1), (1, -1), (1, 1), (-1, 1)), "triangle": ((0, -1.3), (1.2, 0.9), (-1.2, 0.9)),
              "diamond": ((0, -1.4), (1.4, 0), (0, 1.4), (-1.4, 0))}[shape]
    corners = " ".join(f"{x + r * dx:.1f},{y + r * dy:.1f}" for dx, dy in around)
    return f'<polygon points="{corners}" fill="{colour}"/>'


class Frame:
    """Where things are: the axes on the page."""

    def __init__(self, across, up, height):
        self.across, self.up, self.height = across, up, height
        self.width, self.tall, self.edge = WIDTH - LEFT - RIGHT, height - TOP - BOTTOM, WIDTH - RIGHT

    def x(self, value):
        return LEFT + self.width * self.across.share(value)

    def y(self, value):
        return self.height - BOTTOM - self.tall * min(max(self.up.share(value), 0), 1)


def floor_parts(f, floors):
    for begin, end, text in floors:
        left, right = sorted((f.x(begin), f.x(end)))
        colour = "#fbf4e4" if right > left else "#d9a441"
        yield f'<rect x="{left:.1f}" y="{TOP}" width="{max(right - left, 2):.1f}" height="{f.tall}" fill="{colour}"/>'
        if right > left:
            yield f'<text x="{left + 10:.1f}" y="{TOP + 18}" font-size="12" fill="#6b4a00">{escape(text)}</text>'
            continue
        yield (f'<text x="{left - 5:.1f}" y="{TOP + 32}" transform="rotate(-90 {left - 5:.1f} {TOP + 32})" text-anchor="end" '
               f'font-size="12" fill="#6b4a00">{escape(text)}</text>')


def axis_parts(f, second):
    """grid, numbers and captions; the thin second axis at the right edge"""
    for n in f.up.ticks:
        place = f.y(10.0**n if f.up.log else n)
        yield f'<line x1="{LEFT}" y1="{place:.1f}" x2="{f.edge}" y2="{place:.1f}" stroke="#d8d8d8"/>'
        yield f'<text x="{LEFT - 8}" y="{place + 4.5:.1f}" text-anchor="end">{escape(f.up.text(n))}</text>'
        if second and n != f.up.ticks[-1] and (label := second[1](n)):
            yield f'<text x="{f.edge - 4}" y="{place - 3:.1f}" text-anchor="end" font-size="11" fill="#777777">{escape(label)}</text>'
    for n in f.across.ticks:
        place = f.x(10.0**n if f.across.log else n)
        yield f'<line x1="{place:.1f}" y1="{TOP}" x2="{place:.1f}" y2="{TOP + f.tall}" stroke="#ececec"/>'
        yield f'<text x="{place:.1f}" y="{TOP + f.tall + 22}" text-anchor="middle">{escape(f.across.text(n))}</text>'
    yield (f'<text x="{LEFT + f.width / 2:.0f}" y="{f.height - 16}" text-anchor="middle">{escape(f.across.caption)}</text>')
    yield f'<text x="{LEFT - 62}" y="{TOP - 14}">{escape(f.up.caption)}</text>'
    if second:
        yield f'<text x="{f.edge}" y="{TOP - 14}" text-anchor="end" font-size="11" fill="#777777">{escape(second[0])}</text>'


def line_parts(f, line, points, end, at):
    """the line, its points with their intervals, and its label at height `at` with a thread to its end"""
    if not line.ordered:
        points = sorted(points, key=lambda p: f.across.share(p[0]))
    style = f'stroke="{line.colour}" stroke-width="{line.width}"' + (f' stroke-dasharray="{line.dash}"' if line.dash else "")
    if line.width:
        way = " ".join(f"{f.x(p[0]):.1f},{f.y(p[1]):.1f}" for p in points)
        yield f'<polyline points="{way}" fill="none" {style} stroke-linejoin="round"/>'
    for p in points:
        if len(p) == 4:
            yield f'<path d="M{f.x(p[0]) - 4:.1f} {f.y(p[2]):.1f}h8m-4 0V{f.y(p[3]):.1f}m-4 0h8" fill="none" stroke="{line.colour}"/>'
        yield marker(line.mark, f.x(p[0]), f.y(p[1]), 1.4 + (line.width or 3) / 2, line.colour)
    yield (f'<polyline points="{f.x(end[0]) + 4:.1f},{f.y(end[1]):.1f} {f.edge + 6:.1f},{at:.1f} '
           f'{f.edge + 12:.1f},{at:.1f}" fill="none" stroke="{line.colour}" stroke-width="0.7" opacity="0.6"/>')
    weight = ' font-weight="bold"' if line.width > 2.5 else ""
    yield f'<text x="{f.edge + 16}" y="{at + 4.5:.1f}" fill="{line.colour}"{weight}>{escape(line.label)}</text>'


def chart(path, title, lines, across, up, floors=(), second=None, notes=(), height=HEIGHT):
    """floors: (from, to, text): a stretch of the axis across, named along its edge; a line where both are the same. second: (caption, text of a tick) for a
    thin second axis at the right edge. notes: (x, y, text) beside points. Lines are labelled where they end. False: no points."""
    lines = [(line, [p for p in line.points if across.holds(p[0]) and up.holds(p[1])]) for line in lines]
    lines = [(line, points) for line, points in lines if points]
    if not lines:
        return False
    f = Frame(across, up, height)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
           f'viewBox="0 0 {WIDTH} {height}" {FONT} font-size="13">', f"<title>{escape(title)}</title>",
           f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
           f'<text x="{LEFT}" y="30" font-size="17" font-weight="bold">{escape(title)}</text>',
           *floor_parts(f, floors), *axis_parts(f, second)]
    ends = [max(points, key=lambda p: across.share(p[0])) for _, points in lines]
    for (line, points), end, at in zip(lines, ends, spread([f.y(p[1]) for p in ends], 17, height)):
        out += line_parts(f, line, points, end, at)
    out += [f'<text x="{f.x(x) + 7:.1f}" y="{f.y(y) + 16:.1f}" font-size="12" stroke="#ffffff" stroke-width="3" '
            f'paint-order="stroke" fill="#333333">{escape(text)}</text>' for x, y, text in notes]
    out.append("</svg>")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(out) + "\n", encoding="utf-8")
    return True


def draw(path, title, lines, errors=(-4, -12)):
    """Error against CPU time. lines: (label, colour, width, dash, [(error, cpu_ms)]); errors: decades, left to right."""
    lines = [(*line[:4], [(e, c) for e, c in line[4] if 10**errors[1] <= e <= 10**errors[0]]) for line in lines]
    costs = [math.log10(c) for line in lines for _, c in line[4]]
    if not costs:
        return False
    across = Axis(*errors, "largest error of any coordinate over 10 ms (mm, rad): more accurate to the right")
    up = Axis(math.floor(min(costs)), math.ceil(max(costs)), "CPU time", milliseconds)
    return chart(path, title, [Line(label, colour, points, width, dash) for label, colour, width, dash, points in lines], across, up)
