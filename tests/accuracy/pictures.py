# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of docs/accuracy.md from its tables. Colours, dashes and marks differ together, so that no figure needs colour."""
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import picture  # noqa: E402
import report  # noqa: E402
from picture import Axis, Line  # noqa: E402

# dark enough for text on white, apart for every kind of colour vision (after Okabe and Ito, and Tol)
INK = ["#c1121f", "#0072b2", "#117733", "#aa4499", "#a85400", "#332288", "#00808a", "#666666", "#882255", "#000000"]
DASH = ["", "", "6 3", "", "6 3", "2 3", "2 3", "6 3", "2 3", ""]
MARK = ["circle", "square", "triangle", "diamond", "ring", "square", "triangle", "diamond", "ring", "diamond"]
PEAK = "error of the peak hinge deflection, relative: more accurate to the right"


def power(n):
    if n < 6:
        return f"{10**n:,}".replace(",", " ")
    return f"{10**(n % 3)} {'million' if n < 9 else 'billion'}" if n < 12 else f"1e{n}"


def duration(ms):
    """two digits, in the unit that fits"""
    for unit, size in (("s", 1e3), ("ms", 1), ("us", 1e-3)):
        if ms >= 0.995 * size:
            return f"{float(f'{ms / size:.2g}'):g} {unit}"
    return f"{ms / 1e-6:.2g} ns"


def series(k, label, points, **more):
    k %= len(INK)
    return Line(label, INK[k], points, dash=DASH[k], mark=MARK[k], **more)


def upright(lines, caption, text=None):
    """a logarithmic axis around all points"""
    values = [math.log10(v) for line in lines for p in line.points for v in p[1:] if v > 0]
    return Axis(math.floor(min(values)), math.ceil(max(values)), caption, text)


def milliseconds(per_instruction):
    """the thin second axis, or none where the time is too noisy to show"""
    if not per_instruction:
        return None
    return "about, on the machine below", lambda n: duration(10.0**n * per_instruction)


def work_precision(path, title, named, tables, floors=(), notes=(), error="peak_error", caption=PEAK):
    """named: (label, rows); the first line is the default"""
    lines = [series(k, label, [(r[error], r["instructions"]) for r in rows if r[error] > 0], width=3.2 if k == 0 else 1.6,
                    ordered=True) for k, (label, rows) in enumerate(named)]
    return picture.chart(path, title, lines, Axis(-1, -14, caption), upright(lines, "instructions", power), floors,
                         milliseconds(tables.ms_per_instruction), notes)


def motions(folder, t):
    titles = {"six-bar": "Reference six-bar, 10 ms", "squeezer": "Andrews' squeezer, 30 ms",
              "windows-4": "Four four-bar windows, 2 s"}
    for problem, title in titles.items():
        own = ("as --accuracy chooses", t.curve(problem, "by-accuracy", "--accuracy"))
        notes = [(r["peak_error"], r["instructions"], r["tolerance"].replace("e-0", "e-")) for r in own[1]
                 if r["peak_error"] > 0 and r["tolerance"] in ("1e-03", "1e-05", "1e-07")] if problem == "six-bar" else []
        floors = t.floors() if problem == "six-bar" else ()
        name = problem.split("-4")[0]
        work_precision(folder / f"accuracy-{name}.svg", f"{title}: integrators (method chain)",
                       [own, *t.settings(problem, "by-integrator")], t, floors, notes)
        work_precision(folder / f"accuracy-{name}-methods.svg", f"{title}: methods (integrator dop853)",
                       [own, *t.settings(problem, "by-method")], t)


def peers(folder, t):
    """CPU times of peers at the height where ours is at the same time"""
    lines = []
    for peer, setting, label, colour, width, dash in report.SHOWN:
        rows = [r for r in t["peers"] if (r["peer"], r["setting"]) == (peer, setting)]
        points = [(float(r["error"]), float(r["cpu_ms"]) * t.peers_per_ms) for r in rows]
        lines.append(Line(label, colour, points, width, dash))
    up = upright([line for line in lines if line.points], "instructions", power)
    return picture.chart(folder / "accuracy-peers.svg", "Reference six-bar, 10 ms: other codes on the same axes", lines,
                         Axis(-3, -13, "largest error of any coordinate over 10 ms (mm, rad): more accurate to the right"), up, (),
                         ("peers: by their CPU time", lambda n: duration(10.0**n / t.peers_per_ms)))


def size(folder, t):
    rows, slope = t.scaling(), t.slope()
    points = [(r["bodies"], r["instructions"]) for r in rows]
    last = points[-1]
    line = [(n, last[1] * (n / last[0])**slope) for n, _ in points[2:]]
    lines = [series(0, "whole call", points, width=3.2), Line(f"bodies^{slope:.2f}", "#777777", line, 1.2, "5 4", "ring")]
    return picture.chart(folder / "accuracy-size.svg", "N four-bar windows, 1 s at rtol 1e-8: cost against size", lines,
                         Axis(0, 5, "bodies (2N + 1)", lambda n: f"{10**n:,}".replace(",", " ")), upright(lines, "instructions", power),
                         second=milliseconds(t.ms_per_instruction))


def verdicts(folder, t):
    names = (("inconclusive", "undecided"), ("changed", "decided otherwise than at 1e-8"),
             ("flipped", "accepted turns rejected, or back"))
    lines = []
    for k, (name, label) in enumerate(names):
        points = [(float(r["accuracy"]), *(100 * float(r[f"{name}_{part}"]) for part in ("share", "low", "high"))) for r in t["verdicts"]]
        lines.append(series(k, label, points))
    top = 10 * math.ceil(max(p[3] for line in lines for p in line.points) / 10)
    title = f"Verdicts of {t['verdicts'][0]['devices']} random devices near their limit"
    return picture.chart(folder / "accuracy-verdicts.svg", title, lines,
                         Axis(-1, -8, "accuracy asked for; bars: intervals of 95 %"),
                         Axis(0, top, "share", lambda n: f"{n} %", log=False, ticks=range(0, top + 1, 10 if top > 20 else 5)), height=460)


def hinges(folder, t):
    """cheap levels: distance to the solids; solids: what they say of themselves"""
    lines, levels = [], ("closed-form", "compliance", "elastica", "continuum")
    for k, (what, label) in enumerate((("stiffness", "stiffness"), ("strain", "strain per radian"))):
        for worst in (False, True):
            points = [((max if worst else statistics.median)(t.off(level, what)), t.cost(level)) for level in levels]
            lines.append(Line(f"{label}, {'worst hinge' if worst else 'median'}", INK[k], points, 1.2 if worst else 1.8,
                              "2 3" if worst else "", "ring" if worst else MARK[k], ordered=True))
    notes = [(max(t.off(level, "strain")), t.cost(level), t.level_name(level)) for level in levels]
    return picture.chart(folder / "accuracy-hinges.svg", f"One hinge: {t.solids} hinges beside 3-D finite elements (CalculiX)", lines,
                         Axis(0, -4, "distance to the solid, relative; of the solid: what its two meshes differ by"),
                         upright(lines, "instructions", power), notes=notes, height=560)


def masks(folder, t):
    rows = t["masks"]
    lines = [series(k, name, [(float(r["edge_error_nm"]), float(r[name])) for r in rows])
             for k, name in enumerate(("bytes", "vertices"))]
    across = Axis(3, 0, "largest distance of an edge from its arc, nm (the 1 nm grid alone: 0.7)", lambda n: f"{10**n:,} nm".replace(",", " "))
    return picture.chart(folder / "accuracy-masks.svg", "Mask of the reference six-bar: what a finer arc costs", lines,
                         across, upright(lines, "in the GDSII file", lambda n: f"{10**n:,}".replace(",", " ")), height=460)


def steering(folder, t):
    rows = [r for r in t["survey"] if r["group"] == "all"]
    names = (("cost_median", "answering run, median"), ("cost_90", "answering run, nine of ten"), ("total_median", "all runs, median"),
             ("total_90", "all runs, nine of ten"))
    lines = [series(k, label, [(float(r["accuracy"]), float(r[name])) for r in rows if r[name]]) for k, (name, label) in enumerate(names)]
    lines.append(Line("1.5, the aim", "#777777", [(1e-1, 1.5), (1e-9, 1.5)], 1.2, "5 4", "ring"))
    top = max(2, math.ceil(max(p[1] for line in lines for p in line.points)))
    return picture.chart(folder / "accuracy-steering.svg", "What --accuracy chose, over the cheapest setting that would have done", lines,
                         Axis(-1, -9, "accuracy asked for"), Axis(0, top, "cost, times", log=False, ticks=range(0, top + 1, max(1, top // 10))),
                         height=460)


def honesty(folder, t):
    """share of devices whose estimate is at least so many times the true error"""
    lines, accuracies = [], list(dict.fromkeys(r["accuracy"] for r in t["honesty"]))
    for k, accuracy in enumerate(accuracies):
        rows = [r for r in t["honesty"] if r["accuracy"] == accuracy]
        whole, above, points = sum(int(r["devices"]) for r in rows), 0, []
        for r in sorted(rows, key=lambda r: -float(r["log10_from"])):
            above += int(r["devices"])
            if float(r["log10_from"]) > -9:
                points.append((10**float(r["log10_from"]), 100 * above / whole))
        lines.append(series(k, f"asked {float(accuracy):.0e}".replace("e-0", "e-"), points))
    return picture.chart(folder / "accuracy-honesty.svg", "Estimated over true error: share of devices that reach the ratio", lines,
                         Axis(-2, 5, "estimated over true error; below 1 an estimate is too small", lambda n: f"{10.0**n:g}"),
                         Axis(0, 100, "share", lambda n: f"{n} %", log=False, ticks=range(0, 101, 20)), [(1, 1, "the true error")],
                         height=460)


def draw(folder, tables):
    """names of what was drawn"""
    motions(folder, tables)
    for one in (peers, size, verdicts, hinges, masks):
        one(folder, tables)
    if tables["survey"]:
        steering(folder, tables)
        honesty(folder, tables)

