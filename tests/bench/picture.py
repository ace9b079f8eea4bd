# SPDX-License-Identifier: GPL-3.0-or-later
"""Work-precision pictures: error against CPU time, log-log, one line per solver, as SVG."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 1000, 640
LEFT, RIGHT, TOP, BOTTOM = 84, 300, 64, 70
FONT = 'font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'


def decades(low, high):
    return range(math.floor(low + 1e-9), math.ceil(high - 1e-9) + 1)


def milliseconds(n):
    return {-2: "0.01 ms", -1: "0.1 ms", 0: "1 ms", 1: "10 ms", 2: "0.1 s", 3: "1 s", 4: "10 s"}.get(n, f"1e{n} ms")


def spread(places, gap):
    """Moves label heights apart to at least `gap`, keeping their order."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    y = [places[i] for i in order]
    for _ in range(200):
        for k in range(1, len(y)):
            short = gap - (y[k] - y[k - 1])
            if short > 0:
                y[k - 1] -= short / 2
                y[k] += short / 2
    low, high = TOP + 8, HEIGHT - BOTTOM
    shift = max(0, low - y[0]) if y else 0
    shift = min(shift, max(0, high - (y[-1] if y else 0))) or shift
    out = [0.0] * len(places)
    for place, i in zip(y, order):
        out[i] = place + shift
    return out


def draw(path, title, lines, errors=(-4, -12)):
    """lines: (label, colour, width, dash, [(error, cpu_ms)]); errors: decades, left to right."""
    lines = [(*line[:4], [(e, c) for e, c in line[4] if 10**errors[1] <= e <= 10**errors[0]]) for line in lines]
    lines = [line for line in lines if line[4]]
    if not lines:
        return False
    costs = [math.log10(c) for line in lines for _, c in line[4]]
    low, high = math.floor(min(costs)), math.ceil(max(costs))
    across, up = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def x(error):
        return LEFT + across * (errors[0] - math.log10(error)) / (errors[0] - errors[1])

    def y(cost):
        return HEIGHT - BOTTOM - up * (math.log10(cost) - low) / (high - low)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
           f'viewBox="0 0 {WIDTH} {HEIGHT}" {FONT} font-size="13">', f"<title>{escape(title)}</title>",
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
           f'<text x="{LEFT}" y="30" font-size="17" font-weight="bold">{escape(title)}</text>']
    for n in decades(low, high):
        place = y(10.0**n)
        out.append(f'<line x1="{LEFT}" y1="{place:.1f}" x2="{LEFT + across}" y2="{place:.1f}" stroke="#d8d8d8"/>')
        out.append(f'<text x="{LEFT - 8}" y="{place + 4.5:.1f}" text-anchor="end">{milliseconds(n)}</text>')
    for n in range(errors[0], errors[1] - 1, -1):
        place = x(10.0**n)
        out.append(f'<line x1="{place:.1f}" y1="{TOP}" x2="{place:.1f}" y2="{TOP + up}" stroke="#ececec"/>')
        out.append(f'<text x="{place:.1f}" y="{TOP + up + 22}" text-anchor="middle">1e{n}</text>')
    out.append(f'<text x="{LEFT + across / 2:.0f}" y="{HEIGHT - 16}" text-anchor="middle">largest error of any '
               "coordinate over 10 ms (mm, rad): more accurate to the right</text>")
    out.append(f'<text x="{LEFT - 62}" y="{TOP - 14}">CPU time</text>')
    ends = [max(points, key=lambda p: -p[0]) for *_, points in lines]
    labels = spread([y(c) for _, c in ends], 17)
    for (label, colour, width, dash, points), end, at in zip(lines, ends, labels):
        points = sorted(points, key=lambda p: -p[0])
        style = f'stroke="{colour}" stroke-width="{width}"' + (f' stroke-dasharray="{dash}"' if dash else "")
        path_points = " ".join(f"{x(e):.1f},{y(c):.1f}" for e, c in points)
        out.append(f'<polyline points="{path_points}" fill="none" {style} stroke-linejoin="round"/>')
        out += [f'<circle cx="{x(e):.1f}" cy="{y(c):.1f}" r="{1.4 + width / 2:.1f}" fill="{colour}"/>'
                for e, c in points]
        edge = LEFT + across
        out.append(f'<polyline points="{x(end[0]) + 4:.1f},{y(end[1]):.1f} {edge + 6:.1f},{at:.1f} '
                   f'{edge + 12:.1f},{at:.1f}" fill="none" stroke="{colour}" stroke-width="0.7" opacity="0.6"/>')
        weight = ' font-weight="bold"' if width > 2.5 else ""
        out.append(f'<text x="{edge + 16}" y="{at + 4.5:.1f}" fill="{colour}"{weight}>{escape(label)}</text>')
    out.append("</svg>")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(out) + "\n", encoding="utf-8")
    return True
