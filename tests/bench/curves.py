# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of the benchmark, interpolation of work-precision curves, medians with their interval."""
import csv
import io
import math

FIELDS = ["problem", "peer", "setting", "tolerance", "error", "cpu_ms", "rhs", "ratio", "ratio_low",
          "ratio_high", "rounds"]


def number(text):
    return math.nan if text == "" else float(text)


class Row:
    def __init__(self, problem, peer, setting, tolerance=math.nan, error=math.nan, cpu_ms=math.nan,
                 rhs=0, ratio=math.nan, ratio_low=math.nan, ratio_high=math.nan, rounds=0):
        self.problem, self.peer, self.setting = problem, peer, setting
        self.tolerance, self.error, self.cpu_ms = number(tolerance), number(error), number(cpu_ms)
        self.rhs, self.rounds = int(rhs), int(rounds)
        self.ratio, self.ratio_low, self.ratio_high = number(ratio), number(ratio_low), number(ratio_high)

    @property
    def name(self):
        return (self.peer, self.setting)


def parse(problem, text):
    """Rows that a program printed; other lines are skipped."""
    rows = []
    for fields in csv.reader(io.StringIO(text)):
        if len(fields) == 6:
            rows.append(Row(problem, *fields))
    return rows


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [Row(**fields) for fields in csv.DictReader(file)]


def write(path, rows):
    def text(value):
        return "" if isinstance(value, float) and math.isnan(value) else f"{value:.6g}" if isinstance(
            value, float) else str(value)

    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(FIELDS)
    for row in rows:
        writer.writerow([text(getattr(row, field)) for field in FIELDS])
    path.write_text(out.getvalue(), encoding="utf-8")


def select(rows, problem, peer=None, setting=None):
    return [r for r in rows if r.problem == problem and peer in (None, r.peer)
            and setting in (None, r.setting)]


def groups(rows):
    """Curves by (peer, setting), in order of appearance; each from loose to tight."""
    found = {}
    for row in rows:
        found.setdefault(row.name, []).append(row)
    return found


def bracket(curve, target):
    """The first neighbours on a curve whose errors enclose the target, loose to tight, or None."""
    good = [r for r in curve if r.error > 0 and r.cpu_ms > 0]
    for a, b in zip(good, good[1:]):
        if a.error >= target >= b.error and a.error > b.error:
            return a, b
    return None


def cpu_at(curve, target):
    """CPU ms at the target error, log-log between the enclosing points; NaN outside the curve."""
    ends = bracket(curve, target)
    if not ends:
        return math.nan
    a, b = ends
    w = math.log(a.error / target) / math.log(a.error / b.error)
    return math.exp((1 - w) * math.log(a.cpu_ms) + w * math.log(b.cpu_ms))


def cheapest(curves, target):
    """(name, CPU ms) of the cheapest curve at the target error, or None."""
    costs = [(cpu_at(curve, target), name) for name, curve in curves.items()]
    costs = [c for c in costs if not math.isnan(c[0])]
    return (min(costs)[1], min(costs)[0]) if costs else None


def median(values):
    v, n = sorted(values), len(values)
    return v[n // 2] if n % 2 else (v[n // 2 - 1] + v[n // 2]) / 2


def interval(values):
    """Median and its interval of 90 % (order statistics, no assumption on the distribution): the
    k-th smallest and largest, with the largest k such that P(Binomial(n, 1/2) < k) <= 5 %."""
    v, n = sorted(values), len(values)
    below, k = 0.0, 0
    while k < n // 2 and below + math.comb(n, k) / 2**n <= 0.05:
        below += math.comb(n, k) / 2**n
        k += 1
    k = max(k, 1)
    return median(v), v[k - 1], v[n - k]


def exponent(points):
    """Slope of log(cost) over log(size)."""
    x, y = [math.log(a) for a, _ in points], [math.log(b) for _, b in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx)**2 for a in x)
