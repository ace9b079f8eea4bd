# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/benchmarks.md and its pictures from the rows of docs/data/benchmarks.csv: nothing is measured
here, so that the same CSV gives the same bytes."""
import math

import curves
import picture

TARGET = 5e-9


def plain(value, digits=3):
    """A number for a table; a dash when there is none."""
    if math.isnan(value):
        return "–"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
        return f"{value:,.{places}f}".replace(",", " ")
    return f"{value:.{digits - 1}e}"


def small(value):
    return "–" if math.isnan(value) else f"{value:.1e}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows] + [""]


def ratio_text(row):
    if math.isnan(row.ratio_low):
        return f"{plain(row.ratio)} (one run)"
    noisy = (row.ratio_high - row.ratio_low) / row.ratio > 0.1
    return f"{plain(row.ratio)} [{plain(row.ratio_low)}, {plain(row.ratio_high)}]{' noisy' if noisy else ''}"


# ---- sections ----

def provenance(rows):
    facts = {r.peer: r.setting for r in curves.select(rows, "provenance")}
    skipped = [f"- {r.setting}" for r in curves.select(rows, "skipped")]
    lines = ["## Provenance", "", f"Command: `{facts.pop('command', '')}`", ""]
    lines += table(["", ""], [(k, v) for k, v in facts.items()])
    return lines + (["Skipped:", "", *skipped, ""] if skipped else [])


def ratios(rows):
    found = [r for r in rows if r.problem.startswith("ratio ")]
    own = {r.error: r for r in curves.select(rows, "ours")}
    lines = []
    for target in sorted({r.error for r in found}, reverse=True):
        here = [r for r in found if r.error == target]
        ms = own[target].cpu_ms if target in own else math.nan
        lines += [f"### At an error of {target:g} (Flexwright: {plain(ms)} ms)", ""]
        lines += table(["against", "its setting", "CPU ms", "times as long, median [90 %]", "rounds"],
                       [(r.problem[6:], f"{r.peer} {r.setting}", plain(r.cpu_ms), ratio_text(r), r.rounds)
                        for r in here])
    return lines


def survey(rows, ours):
    six = curves.groups([r for r in curves.select(rows, "sixbar") if (r.peer == "flexwright") == ours])
    body = []
    for (peer, setting), curve in six.items():
        failed = sum(math.isnan(r.error) for r in curve)
        reached = min((r.error for r in curve if r.error > 0), default=math.nan)
        body.append((peer, setting, *[plain(curves.cpu_at(curve, e)) for e in (2e-6, TARGET, 1e-10)],
                     small(reached), f"{failed} of {len(curve)}" if failed else "none"))
    return table(["code", "setting", "CPU ms at 2e-6", "at 5e-9", "at 1e-10", "smallest error", "failed"], body)


def right_hand_sides(rows):
    body = [(r.peer, r.setting, plain(1e6 * r.cpu_ms)) for r in curves.select(rows, "rhs", "flexwright")]
    best = {}
    for r in curves.select(rows, "sixbar", "flexwright"):
        if r.rhs and r.setting.endswith("dop853"):
            best[r.setting] = min(best.get(r.setting, math.inf), 1e6 * r.cpu_ms / r.rhs)
    body += [("flexwright", f"{s}: whole motion over its right-hand sides", plain(ns)) for s, ns in best.items()]
    body += [(r.peer, r.setting, plain(1e6 * r.cpu_ms)) for r in curves.select(rows, "rhs")
             if r.peer != "flexwright" and r.setting.startswith("six-bar")]
    return table(["code", "", "ns"], body)


def windows(rows):
    body = []
    ours = {r.setting: r for r in rows if r.problem.startswith("windows ours")}
    for r in [r for r in rows if r.problem.startswith("windows ratio")]:
        size = r.setting.split()[0]
        default = curves.select(rows, "windows", r.peer, size)
        failed, runs = sum(math.isnan(d.error) for d in default), len(default)
        good = min((d.error for d in default if d.error > 0), default=math.nan)
        body.append((size, f"{small(good)} ({failed} of {runs} stop)", small(r.error), plain(r.cpu_ms),
                     plain(ours[size].cpu_ms) if size in ours else "–", ratio_text(r)))
    lines = table(["N", "Simbody as it is: smallest error of B0", "projecting every step: error", "CPU ms",
                   "Flexwright at that error, CPU ms", "times as long"], body) if body else []
    own = curves.groups(curves.select(rows, "windows", "flexwright"))
    lines += ["Flexwright alone, error of B0 at 10 s and CPU ms:", ""]
    tolerances = sorted({r.tolerance for c in own.values() for r in c}, reverse=True)
    chosen = [t for t in tolerances if round(-math.log10(t)) in (6, 8, 10, 12)]
    body = []
    for (_, setting), curve in own.items():
        at = {r.tolerance: r for r in curve}
        body.append((setting, *[f"{small(at[t].error)}: {plain(at[t].cpu_ms)}" if t in at else "–" for t in chosen]))
    return lines + table(["N", *[f"rtol {t:.0e}" for t in chosen]], body)


def scaling(rows):
    own = curves.groups(curves.select(rows, "scaling"))
    simbody = {r.setting: r for r in curves.select(rows, "rhs", "Simbody")}
    body, per, theirs = [], [], []
    for (_, setting), curve in own.items():
        n = int(setting[2:])
        ok = {round(-math.log10(r.tolerance)): r for r in curve if r.rhs}
        cells = [plain(ok[e].cpu_ms / 1e3) if e in ok else "fails" for e in (6, 8, 10)]
        best = min((r.cpu_ms / r.rhs for r in ok.values()), default=math.nan)
        if not math.isnan(best):
            per.append((2 * n + 1, best))
        other = simbody[setting].cpu_ms if setting in simbody else math.nan
        if not math.isnan(other):
            theirs.append((2 * n + 1, other))
        body.append((n, 2 * n + 1, *cells, plain(1e3 * best), plain(1e6 * best / (2 * n + 1)), plain(1e3 * other)))
    lines = table(["N", "bodies", "CPU s per simulated s, rtol 1e-6", "1e-8", "1e-10", "one rhs, us",
                   "ns per body and rhs", "Simbody, one rhs, us"], body)
    for name, points in (("Flexwright", per), ("Simbody", theirs)):
        large = [p for p in points if p[0] >= 21]
        if len(large) > 2:
            lines.append(f"{name}: one right-hand side grows as bodies^{curves.exponent(large):.2f} (N >= 10).")
    return lines + [""]


def long_run(rows):
    return table(["", "rtol", "error (mm, rad)", "CPU s", "rhs"],
                 [(r.setting, f"{r.tolerance:.0e}", small(r.error), plain(r.cpu_ms / 1e3), r.rhs)
                  for r in curves.select(rows, "long")])


def instructions(rows):
    return table(["", "rtol", "instructions"], [(r.setting, "–" if math.isnan(r.tolerance) else f"{r.tolerance:.0e}", f"{r.rhs:,}".replace(",", " "))
                                               for r in curves.select(rows, "instructions")])


def marks(rows):
    def own(target):
        found = [r for r in curves.select(rows, "ours") if r.error == target]
        return found[0].cpu_ms if found else curves.cpu_at(
            curves.select(rows, "sixbar", "flexwright", "chain + dop853"), target)

    def times(label):
        found = [r for r in rows if r.problem == f"ratio {label}" and r.error == TARGET]
        return found[0].ratio if found else math.nan

    thousand = [r for r in curves.select(rows, "scaling", "flexwright", "N=1000") if r.rhs and r.tolerance <= 1.5e-8]
    ten = [r for r in curves.select(rows, "long", "flexwright", "10 s") if r.error <= 1e-8]
    single = [1e6 * r.cpu_ms for r in curves.select(rows, "rhs", "flexwright") if r.setting.startswith("six-bar")
              and "design" not in r.setting]
    lanes = [1e6 * r.cpu_ms for r in curves.select(rows, "rhs", "flexwright") if "avx512" in r.setting]
    per_body = [1e6 * r.cpu_ms for r in curves.select(rows, "rhs", "flexwright") if "four-bars" in r.setting]
    checks = [(a, f"at most {mark} ns", min(v) if b == "least" else max(v), "ns",
               (min(v) if b == "least" else max(v)) <= mark)
              for a, b, mark, v in (("one right-hand side of the six-bar", "least", 90, single),
                                    ("a design in a batch of 8, AVX-512", "least", 12, lanes),
                                    ("a body and right-hand side, N to 10 000", "most", 60, per_body)) if v]
    checks += [
        ("10 ms motion at error 5e-9", "at most 0.35 ms", own(TARGET), "ms", own(TARGET) <= 0.35),
    ]
    for name, mark, label in (
            ("Simbody's best integrator", 250, "Simbody, best of all integrators and settings"),
            ("IDA + KLU, GGL, analytic Jacobian", 30, "IDA + KLU, GGL, analytic Jacobian"),
            ("IDA + KLU, analytic Jacobian, best of index 1 and GGL", 30, "IDA + KLU, best of index 1 and GGL"),
            ("Octave as for a paper", 5000, "Octave as for a paper (SVD, ode45, loop)")):
        checks.append((name, f"at least {mark} times", times(label), "times", times(label) >= mark))
    if thousand:
        value = thousand[0].cpu_ms / 1e3
        checks.append(("N = 1000 windows, rtol 1e-8", "at most 0.12 s per simulated s", value, "s", value <= 0.12))
    if ten:
        value = ten[0].cpu_ms / 1e3
        checks.append(("10 s of the six-bar at 1e-8", "under 1 s", value, "s", value < 1))
    return table(["", "mark", "measured", "reached"],
                 [(a, b, "not measured" if math.isnan(v) else f"{plain(v)} {u}",
                   "–" if math.isnan(v) else "yes" if ok else "no") for a, b, v, u, ok in checks])


# ---- pictures ----

SHOWN = [("flexwright", "chain + dop853", "Flexwright, default", "#c1121f", 3.2, ""),
         ("flexwright", "whole call with error estimate", "whole call with error estimate", "#c1121f", 1.4, "5 3"),
         ("SUNDIALS", "CVODE Adams fixed point", "CVODE Adams, O(n) rhs", "#1b7837", 1.8, ""),
         ("SUNDIALS", "IDA index 1 Baumgarte KLU suppress", "IDA index 1, KLU", "#1f6fb4", 1.8, "6 3"),
         ("SUNDIALS", "IDA GGL KLU suppress", "IDA GGL, KLU", "#1f6fb4", 1.8, ""),
         ("Simbody", "CPodes BDF Newton cut at D", "Simbody, CPodes BDF", "#7b3294", 1.8, ""),
         ("Simbody", "RungeKuttaMerson cut at D", "Simbody, Runge-Kutta-Merson", "#7b3294", 1.8, "6 3"),
         ("Simbody", "Verlet", "Simbody, Verlet", "#7b3294", 1.2, "2 3"),
         ("Octave", "KKT lsode adams vectorised", "Octave, lsode, vectorised", "#946b00", 1.8, "6 3"),
         ("Octave", "svd ode45 loop", "Octave as for a paper", "#946b00", 1.8, "")]
COLOURS = ["#c1121f", "#1f6fb4", "#1b7837", "#7b3294", "#946b00", "#00808a", "#b03a7f", "#555555"]


def points(curve):
    return [(r.error, r.cpu_ms) for r in curve if r.error > 0 and r.cpu_ms > 0]


def pictures(docs, rows):
    lines = [(label, colour, width, dash, points(curves.select(rows, "sixbar", peer, setting)))
             for peer, setting, label, colour, width, dash in SHOWN]
    folder = docs / "pictures"
    names = [("work-precision.svg", "Reference six-bar, 10 ms: error against CPU time", lines)]
    own = curves.groups([r for r in curves.select(rows, "sixbar", "flexwright") if not r.setting.startswith("whole")])
    lines = [(setting, COLOURS[i % len(COLOURS)], 3 if i == 0 else 1.6, ["", "6 3", "2 3"][i // len(COLOURS) % 3],
              points(curve)) for i, ((_, setting), curve) in enumerate(own.items())]
    names.append(("work-precision-methods.svg", "Methods and integrators of Flexwright, six-bar, 10 ms", lines))
    return [name for name, title, lines in names if picture.draw(folder / name, title, lines)]


def write(docs, rows):
    drawn = pictures(docs, rows)

    def image(name):
        return [f"![{name}](pictures/{name})", ""] if name in drawn else []

    lines = ["# Benchmarks", "",
             "Written by `tests/bench/run` from [the measured rows](data/benchmarks.csv); do not edit. Every code solves",
             "the same problem with the same definition of the error on one processor in one run. The peers' programs",
             "are in `tests/bench/peers/`; `tests/bench/peers/install` installs the peers from Debian. They are no part",
             "of the product.", "",
             "CPU time is that of the motion, from the consistent start to the end, without building the model.",
             "Curves are interpolated in log-log to equal error. Ratios come from rounds A B A B with fresh processes:",
             "median of the ratios of the rounds and its interval of 90 % (order statistics).", "",
             "## Marks", "", *marks(rows), *image("work-precision.svg"),
             "## Reference six-bar, 10 ms", "",
             "Error: largest deviation over t = 1, 2 .. 10 ms and the 15 coordinates (mm, rad) from the quad-precision",
             "reference. Flexwright with its defaults, `chain` and `dop853`.", "", *ratios(rows),
             "Notes on the peers:", "",
             "- **Simbody**: cut at hinge F (a chain of five bodies) or at D (two branches); two point-in-plane rows; its",
             "  own tolerances, projection and norms varied. Debian's package is built with its internal checks on; a build",
             "  of one's own without them is about twice as fast, so halve its ratios for that.",
             "- **IDA**: multipliers get an absolute tolerance of 1 and a first step of 1e-4 ms; without that (\"uniform",
             "  tolerances\") the stabilised index-2 form stops. `suppress` leaves the multipliers out of the error test.",
             "- **CVODE** integrates accelerations from an O(n) elimination: the difference that remains is the integrator.",
             "- **Octave**: \"loop\" builds the matrices hinge by hinge as a textbook has it; \"vectorised\" has its index",
             "  vectors prepared. Baumgarte terms 10/ms.", "",
             "### Flexwright's methods and integrators", "", *survey(rows, True), *image("work-precision-methods.svg"),
             "### The peers' settings", "", *survey(rows, False),
             "## One right-hand side of the six-bar", "", *right_hand_sides(rows),
             "## N four-bar windows, 10 s", "",
             "2N+1 bars that pass through singular positions about ten times; error: largest deviation of position and",
             "velocity of B0 at 10 s (m, m/s) from elliptic functions.", "", *windows(rows),
             "## N four-bar windows: growth with N", "", *scaling(rows),
             "## 10 s of the six-bar, about 5000 periods of its first mode", "",
             "Error: largest deviation over 2000 times from a run at rtol 1e-13. Damped as in the reference, and undamped,",
             "where the motion never dies down.", "", *long_run(rows),
             "## Instructions", "", "Counted by callgrind. The first two motions are one whole call of `fw_dynamics_simulate`, error estimate included.",
             "The others are what a user calls: `fw_design_simulate` of a device that was read, with 2 rows, with 1001, and with",
             "`options.figures` (error estimate, largest joint forces); beside it the integrator's steps alone. The gate",
             "(`tests/bench/gate`) holds the call at 2 times its steps and 1001 rows at 1.3 times the call, at most.", "",
             *instructions(rows), *provenance(rows)]
    (docs / "benchmarks.md").write_text("\n".join(lines).rstrip("\n") + "\n", encoding="utf-8")
