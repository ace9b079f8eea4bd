# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/pictures/effect-costs.svg from docs/data/effect-costs.csv: one bar for each effect, its dearest kind, on a logarithmic axis.
tests/build/effects.py writes it with the table; tests/docs/effects.py looks whether it is what the data say."""
import csv
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA, PICTURE = ROOT / "docs/data/effect-costs.csv", ROOT / "docs/pictures/effect-costs.svg"
INK, BLUE, GREY, FILL = "#24292f", "#0b5cad", "#6b7480", "#d7e3f1"


def draw():
    dearest = {}
    with DATA.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["effect"] not in ("provenance", "fast kernel"):
                dearest[row["effect"]] = max(dearest.get(row["effect"], 0), float(row["each"]))
    order = sorted(dearest.items(), key=lambda item: -item[1])
    height = 60 + 18 * len(order)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 {height}" width="640" height="{height}" '
             'font-family="sans-serif" font-size="12" role="img">',
             "<title>Instructions that one instance of each effect adds to a right-hand side</title>",
             f'<rect width="640" height="{height}" rx="8" fill="#ffffff"/>']
    for i, (effect, each) in enumerate(order):
        y = 24 + 18 * i
        width = 360 * math.log(each / 10) / math.log(2000) if each > 10 else 0
        lines.append(f'<text x="150" y="{y + 11}" fill="{INK}" text-anchor="end">{effect}</text>')
        if width:
            lines.append(f'<rect x="160" y="{y}" width="{width:.1f}" height="13" fill="{FILL}" stroke="{BLUE}"/>')
        lines.append(f'<text x="{166 + width:.1f}" y="{y + 11}" fill="{INK if each else GREY}">'
                     f'{f"{each:.0f}" if each else "nothing"}</text>')
    lines.append(f'<text x="160" y="{40 + 18 * len(order)}" fill="{GREY}">instructions for each instance, logarithmic; '
                 "the dearest kind of each effect</text>")
    return "\n".join([*lines, "</svg>"]) + "\n"
