# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of documents that a command wrote, short enough to be kept: {FILE FIELD: [numbers] or words}.

A field is the names that lead to it, a list's places left out: `scenes[].peaks[].angle_rad`; of a table (CSV) its column. Numbers are
kept as count, least, largest, sum and sum weighed by place, to eight digits, and are the same within 1e-5 of the largest of the field.
Words are kept as they are while they are few and short, else as a hash. What says when, where and with which program it was
made is left out; and so is, when they are renewed, what a processor without FMA and AVX computes otherwise: numbers that are 0 but
for rounding, and what hangs on them."""
import csv
import hashlib
import json
import re

TOLERANCE = 1e-5
ELSEWHERE = ({}, {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-AVX", "OPENBLAS_CORETYPE": "Nehalem"})
# the same for all devices of a flow, or long, and kept of `simulate` with fewer samples
ELSEWHERE_TOO = re.compile(r"^manifest|-coupons|^motion/")
LEFT_OUT = re.compile(r"sha256|hash|version|cpu_s|written|generator|created|steps_tried|evaluations", re.I)


def gather(value, field, to):
    if LEFT_OUT.search(field):
        return
    if isinstance(value, dict):
        for name, inner in value.items():
            gather(inner, f"{field}.{name}" if field else name, to)
    elif isinstance(value, list):
        to.setdefault(field + "#", []).append(len(value))
        for inner in value:
            gather(inner, field + "[]", to)
    else:
        to.setdefault(field, []).append(value)


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def summed(values):
    placed = [(i + 1, float(v)) for i, v in enumerate(values) if isinstance(v, (int, float)) and not isinstance(v, bool)]
    numbers = [v for _, v in placed if abs(v) < 1e300]
    if numbers and len(numbers) + sum(v in (None, "") for v in values) == len(values):
        n = len(values)
        return [n, len(numbers), min(numbers), max(numbers), sum(numbers) / n, sum(i * v for i, v in placed) / n / n]
    words = json.dumps([float(f"{v:.6g}") if isinstance(v, float) else v for v in values], ensure_ascii=False)
    return words if len(words) < 100 else f"{len(values)} {hashlib.sha256(words.encode()).hexdigest()[:16]}"


def of(directory, printed):
    """of all documents of a directory, and of what was printed"""
    documents = {} if printed is None else {"printed": printed}
    for path in sorted(directory.rglob("*")):
        if path.suffix in (".json", ".csv") and not ELSEWHERE_TOO.search(str(path.relative_to(directory))):
            documents[str(path.relative_to(directory))] = path.read_text(encoding="utf-8")
    found = {}
    for name, text in documents.items():
        fields = {}
        if name.endswith(".csv"):
            rows = list(csv.reader(text.splitlines()))
            for column, title in enumerate(rows[0] if rows else ()):
                fields[title] = [number(row[column]) for row in rows[1:] if column < len(row)]
        else:
            gather(json.loads(text), "", fields)
        found.update({f"{name} {field}": summed(values) for field, values in fields.items() if values})
    return found


def same(a, b, tolerance=TOLERANCE):
    if isinstance(a, str) or isinstance(b, str) or a[:2] != b[:2]:
        return a == b
    most = tolerance * max(abs(a[2]), abs(a[3]))
    return all(abs(x - y) <= most for x, y in zip(a[2:], b[2:]))


def write(path, now, others):
    """without what is otherwise elsewhere, or the next time"""
    lines = []
    for name, value in sorted(now.items()):
        if all(name in other and same(value, other[name], 0.1 * TOLERANCE) for other in others):
            lines.append(f"{name}\t" + (value if isinstance(value, str) else " ".join(f"{v:.8g}" for v in value)))
        else:
            lines.append(f"{name}\trounding")
    path.write_text("".join(line + "\n" for line in lines), encoding="utf-8")


def differ(path, now):
    """what is not as it was kept: [field: then, now]"""
    kept = dict(line.split("\t", 1) for line in path.read_text(encoding="utf-8").splitlines() if line)
    wrong = [f"{name}: not there" for name in kept if name not in now] + [f"{name}: new" for name in now if name not in kept]
    for name, value in now.items():
        then = kept.get(name)
        if then in (None, "rounding"):
            continue
        was = then if isinstance(value, str) else [float(v) for v in then.split()] if re.fullmatch(r"[-+.e\d ]+", then) else then
        if not same(was, value):
            wrong.append(f"{name}: {then}, now {value}")
    return wrong[:20]
