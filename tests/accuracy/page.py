# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/accuracy.md from docs/data/accuracy-*.csv: nothing is measured here, so that the same data give the same page."""
import math
import textwrap

import pictures
from tables import Tables, interval_text

from report import plain, table


def small(value):
    return f"{value:.1e}".replace("e-0", "e-")


def millions(count):
    return plain(count / 1e6, 3)


def share(value, digits=1):
    return f"{100 * float(value):.{digits}f} %"


def prose(text):
    return [*textwrap.wrap(" ".join(text.split()), 118, break_long_words=False, break_on_hyphens=False), ""]


def image(name, text):
    return [f"![{text}](pictures/accuracy-{name}.svg)", ""]


def sentences(t):
    """what the page begins with: what the default buys, what one more digit costs, how sure the verdict is"""
    own, row, tight = t.asked(3), t.verdict("1e-3"), t.verdict("1e-8")
    ms = t.time_of("ms", "1e-3")
    took = f", about {plain(float(ms['ratio']), 2)} ms here" if t.ms_per_instruction else ""
    flips = int(row["flipped"])
    many = f"{100 * (float(t.random(1e-8)['default_median'])**0.2 - 1):.0f}"
    return [
        f"**The default (1e-3)** gives the peak hinge deflection of the reference six-bar with a true error of "
        f"{small(own['peak_error'])}, for {millions(own['instructions'])} million instructions{took}.",
        f"**One more digit costs {100 * (t.digit() - 1):.0f} %** (the mean of 1e-3 to 1e-8; {many} % in the median of the random devices "
        f"below). But hinges in closed form are "
        f"{100 * t.floor:.2g} % off the solids that CalculiX solves, so that digits beyond 1e-3 polish the numbers, not the device.",
        f"**The verdict** of {row['devices']} random devices near their limit: {flips or 'none'} accepted at the default and rejected at "
        f"1e-8, or the reverse (at most {share(row['flipped_high'], 2)}, 95 %); {share(row['inconclusive_share'])} stay undecided, "
        f"{share(tight['inconclusive_share'])} at 1e-8 too: that is the model's error band, which no tolerance takes away."]


def digits(t):
    base, body = t.asked(3)["instructions"], []
    for e in range(1, 9):
        r = t.asked(e)
        ratio = t.time_of("ratio", f"1e-{e}")
        name = f"**1e-{e}**, the default" if e == 3 else f"1e-{e}"
        many = t.random(10.0**-e)
        body.append((name, small(r["peak_error"]), small(r["estimate"]), millions(r["instructions"]), f"{r['instructions'] / base:.2f}",
                     interval_text(ratio) if ratio else "–", r["runs"],
                     f"{float(many['default_median']):.2f}, {float(many['default_90']):.2f}" if many else "–"))
    return table(["asked for", "true error of the peak", "its own estimate", "million instructions", "times the default",
                  "CPU time, times the default [90 %]", "runs", "1000 random devices, times the default: median, 90 %"], body)


def choose(t):
    uses = ((2, "draft", "sliders, sweeps over thousands of designs, a first look"),
            (3, "normal", "verdicts, masks, recipes: the default"),
            (6, "final", "the last check of a device near its limit; comparing two models with each other"))
    body = [(name, f"`--accuracy 1e-{e}`", f"{float(t.random(10.0**-e)['default_median']):.2f}", small(t.asked(e)["peak_error"]),
             share(t.verdict(f"1e-{e}")["inconclusive_share"]), what) for e, name, what in uses]
    return table(["", "option", "random devices: times the default, median", "six-bar: true error", "verdicts undecided", "good for"], body)


def curves_table(t, problem):
    """instructions at which each setting reaches an error, log-log between neighbours"""
    def at(rows, target):
        good = [r for r in rows if r["peak_error"] > 0]
        for a, b in zip(good, good[1:]):
            if a["peak_error"] >= target >= b["peak_error"] and a["peak_error"] > b["peak_error"]:
                w = math.log(a["peak_error"] / target) / math.log(a["peak_error"] / b["peak_error"])
                return math.exp((1 - w) * math.log(a["instructions"]) + w * math.log(b["instructions"]))
        return math.nan

    body = []
    for kind in ("by-integrator", "by-method"):
        for name, rows in t.settings(problem, kind):
            if kind == "by-method" and name == "chain":
                continue
            label = f"chain + {name}" if kind == "by-integrator" else f"{name} + dop853"
            best = min(rows, key=lambda r: r["peak_error"] if r["peak_error"] > 0 else math.inf)
            body.append((label, *(millions(at(rows, 10.0**-e)) for e in (5, 7, 9, 11)), small(best["peak_error"]), small(best["state_error"]),
                         best["rhs"], best["steps"]))
    return table(["setting", "million instructions at 1e-5", "1e-7", "1e-9", "1e-11", "smallest error of the peak", "of the state there",
                  "rhs there", "steps"], body)


def motion_section(t):
    lines = ["## Integrators and methods", "", *prose("""
        Every dot is one whole call at one tolerance (1e-5 to 1e-13), second run for the error estimate included; the bold line is what
        `--accuracy` chooses by itself. The reference is independent of the code measured: [reference.c](../tests/accuracy/reference.c),
        long double and extrapolation, which agrees to 1e-14 with tables in quad precision and with elliptic functions.""")]
    about = {"six-bar": ("Reference six-bar", "Integrators: the picture above. The error of the state is that of the table in quad "
                         "precision (mm, rad)."),
             "squeezer": ("Andrews' squeezer",
                          "Its driven crank has turned 15.8 rad after 30 ms: the error of the peak is one of the phase."),
             "windows-4": ("N four-bar windows, N = 4", "It passes through singular positions, where all bars are in line: there round-off "
                           "is amplified, and no setting gets reliably beyond 1e-10.")}
    for problem, (title, text) in about.items():
        name = problem.split("-4")[0]
        lines += [f"### {title}", "", *prose(text), *(image(name, f"{title}, integrators") if name != "six-bar" else []),
                  *image(f"{name}-methods", f"{title}, methods"), *curves_table(t, problem)]
    return lines


def size_section(t):
    body = [(r["n"], r["bodies"], 3 * r["n"] + 1, r["rhs"], millions(r["instructions"]),
             plain(r["instructions"] / r["rhs"] / r["bodies"])) for r in t.scaling()]
    each = [r["instructions"] / r["rhs"] / r["bodies"] for r in t.scaling()]
    more = (f"At N = {t.scaling()[-1]['n']} what is prepared once, not the motion, takes a share of {share(1 - min(each) / each[-1], 0)}: "
            "it grows faster.")
    return ["## Cost against size", "", *prose(f"""
        N four-bar windows, 1 s at rtol 1e-8: instructions grow as bodies^{t.slope():.2f} (N = 10 to 10 000), the building of the model and
        the error estimate included. {more if each[-1] > 1.2 * min(each) else ''}"""), *image("size", "cost against size"),
            *table(["N", "bodies", "joints", "rhs", "million instructions", "instructions per rhs and body"], body)]


def peers_section(t):
    return ["## Other codes on the same axes", "", *prose(f"""
        Rows: {t.fact('peers')}. Curves of other codes are their CPU times, put where our whole call takes as long; the error is that of the
        state. Ratios at equal error, in interleaved rounds with intervals, are in [benchmarks](benchmarks.md)."""),
            *image("peers", "other codes on the same axes")]


def verdict_section(t):
    def with_interval(r, name):
        return f"{share(r[f'{name}_share'])} [{share(r[f'{name}_low'])}, {share(r[f'{name}_high'])}]"

    body = [(r["accuracy"], r["accepted"], r["rejected"], r["inconclusive"],
             *(with_interval(r, name) for name in ("inconclusive", "changed", "flipped"))) for r in t["verdicts"]]
    return ["## How sure the verdict is", "", *prose("""
        Random chains and six-bars whose loads are scaled until their governing hinge is within some 20 % of its limit, judged at every
        accuracy and compared with 1e-8. Shares with intervals of 95 % (Wilson)."""), *image("verdicts", "verdict stability"),
            *table(["accuracy", "accepted", "rejected", "undecided", "undecided [95 %]", "decided otherwise than at 1e-8 [95 %]",
                    "accepted turns rejected, or back [95 %]"], body)]


def hinge_section(t):
    def span(level, what):
        return f"{share(min(t.off(level, what)), 2)} to {share(max(t.off(level, what)), 2)}"

    body = [(t.level_name(name), plain(t.cost(name)), span(name, "stiffness"), span(name, "strain")) for name in ("closed-form", "compliance", "elastica")]
    devices = dict.fromkeys(r["device"] for r in t["models"])
    at = {(r["device"], r["model"]): float(r["peak_error"]) for r in t["models"]}
    times = pictures.power(round(math.log10(t.cost("continuum") / t.cost("closed-form"))))
    return ["## The model's own error", "", *prose(f"""
        What no tolerance takes away. One hinge: {t.solids} hinges of the gallery beside 3-D finite elements ({t.fact('solids')}), which
        themselves scatter by 1 to 2 % in strain ([hinges](hinge-ladder.md)). A solid takes some {times} times as long as a closed form
        (by CPU time, one run of each)."""), *image("hinges", "one hinge beside solids"),
            *table(["level", "instructions, median", "stiffness off", "strain off"], body),
            *prose("A whole device: error of the peaks by each model of its hinges, against exact beams in the same scene."),
            *table(["device", "pins at the elastic centres", "flexures that give, closed form"],
                   [(d, share(at[d, "revolute"], 2), share(at[d, "compliance"], 4)) for d in devices])]


def mask_section(t):
    body = [(plain(float(r["tolerance_nm"])), f"{float(r['edge_error_nm']):.2f}", r["vertices"], r["bytes"]) for r in t["masks"]]
    return ["## Masks", "", *prose("""
        Mask of the reference six-bar by `--mask-tolerance`. The edge error is the certificate's, proved for every chord;
        [independent programs](theory/masks.md) check certificates."""), *image("masks", "masks"),
            *table(["tolerance nm", "largest edge error nm", "vertices", "bytes of GDSII"], body)]


def survey_row(r):
    def number(name, form=".2f"):
        return format(float(r[name]), form) if r[name] else "–"

    return (f"{float(r['accuracy']):.0e}".replace("e-0", "e-"), r["devices"],
            f"{share(r['share_below'])} [{share(r['share_low'])}, {share(r['share_high'])}]",
            f"{number('cost_median')}, {number('cost_90')}", share(r["cost_within"]) if r["cost_within"] else "–",
            f"{number('total_median')}, {number('total_90')}", f"{number('call_median')}, {number('call_90')}", r["dishonest"],
            " / ".join(number(f"ratio_{q}", ".2g") for q in ("least", "01", "10", "50", "90", "99")))


def survey_section(t):
    rows = [r for r in t["survey"] if r["group"] == "all"]
    if not rows:
        return []
    head = ["asked for", "devices", "true error below it [95 %]", "cost over the cheapest: median, 90 %", "at most 1.5 times",
            "all runs: median, 90 %", "over the call by --rtol: median, 90 %", "estimate below the true error", "estimated over true: least / 1 / 10 / 50 / 90 / 99 %"]
    return ["## Does --accuracy keep its word", "", *prose("""
        Random six-bars, four-bars, chains, sliders, rows and stiff rows under loads and effects of all kinds, each moved with `--accuracy` as
        asked, against a far tighter run ([how](../tests/accuracy/README.md)). Cost is that of the run that answers, over the cheapest setting
        of a grid that would have done; `all runs` adds those for the estimate and those that were not good enough; beside it, over what
        `--rtol` would have taken with that tolerance, known beforehand, its own run for the estimate included."""),
            *image("steering", "cost of what was chosen"), *image("honesty", "estimated over true error"),
            *table(head, [survey_row(r) for r in rows])]


def provenance_section(t):
    facts = [(r["what"], f"`{r['value']}`" if r["what"] == "command" else r["value"]) for r in t["provenance"]]
    data = ", ".join(f"[{name}](data/accuracy-{name}.csv)" for name in sorted([*(n for n in t.table if t[n]), "verdict-devices"]))
    return ["## Provenance", "", *table(["", ""], facts), *prose(f"""
        Instructions are those of the whole call, counted by callgrind with libm's variants pinned, so that every x86-64 processor counts the
        same. Times are CPU times, medians of interleaved rounds of fresh processes with their interval of 90 %; one that is wider than 10 %
        is not shown. Data: {data}.""")]


def read(docs):
    return Tables(docs)


def compose(t):
    lines = ["# What accuracy costs", "", "Written by `cmake --build build --target accuracy`; do not edit.", "",
             *[f"- {sentence}" for sentence in sentences(t)], "", "## What one more digit costs", "",
             *prose("Reference six-bar, 10 ms, as `--accuracy` chooses; errors are relative, of the peak hinge deflection."),
             *digits(t), *image("six-bar", "error against instructions"), "## Choose for me", "", *choose(t), *survey_section(t),
             *motion_section(t), *size_section(t), *peers_section(t), *verdict_section(t), *hinge_section(t), *mask_section(t),
             *provenance_section(t)]
    return "\n".join(lines).rstrip("\n") + "\n"


def write(docs, t):
    pictures.draw(docs / "pictures", t)
    (docs / "accuracy.md").write_text(compose(t), encoding="utf-8")
