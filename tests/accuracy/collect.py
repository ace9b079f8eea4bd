# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that docs/accuracy.md shows, measured: one function per table, each returns its rows."""
import collections
import csv
import hashlib
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests/bench"))
import callgrind  # noqa: E402
import curves  # noqa: E402
import ladder as hinge_ladder  # noqa: E402
import programs  # noqa: E402
import report  # noqa: E402

REFERENCES = [ROOT / "tests/data/accuracy-reference.csv", programs.REFERENCE]
PROBLEMS = ("six-bar", "squeezer", "windows-4")
SIZES = (2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000)
ACCURACIES = ("1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-8")  # of verdicts.c
SIX_BAR = ROOT / "docs/gallery/reference-six-bar/device.xml"
# devices whose flexures are drawn, so that their hinges have models to choose from
DRAWN = ("comb-stage", "copper-nodder", "four-tendons", "free-form-four-bar", "leaf-four-bar")
MASK_TOLERANCES_NM = (1.42, 2, 5, 10, 20, 50, 100, 200, 500)
TIME_ROUNDS = 21


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, arguments))}: status {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


def as_json(*arguments):
    return json.loads(run(*arguments))


def kept(program, arguments, work):
    """What work() gives, or gave for this very program and these arguments: counts and verdicts do not depend on the day, and a
    run that was interrupted goes on where it was."""
    key = hashlib.sha256(b"\0".join([program.read_bytes(), repr(callgrind.PINNED).encode(), *(str(a).encode() for a in arguments),
                                     *(path.read_bytes() for path in REFERENCES)])).hexdigest()
    path = program.parent / "counted" / f"{key}.json"
    if path.exists():
        return json.loads(path.read_text(encoding="utf-8"))
    found = work()
    path.parent.mkdir(exist_ok=True)
    part = path.with_suffix(".part")
    part.write_text(json.dumps(found), encoding="utf-8")
    part.rename(path)
    return found


# ---- motions ----

MOTION = ("problem", "setting", "tolerance", "state_error", "peak_error", "estimate", "rhs", "steps", "runs")


def count_motions(program, kind, problem, setting, first, last, step):
    """rows of one curve with the instructions of every motion"""
    arguments = [problem, kind, *REFERENCES, setting, first, last, step]
    return kept(program, arguments, lambda: counted(program, kind, arguments))


def counted(program, kind, arguments):
    said, status, parts = callgrind.count(program, arguments)
    found = [dict(zip(MOTION, fields)) for fields in csv.reader(io.StringIO(said)) if len(fields) == 10]
    if status or len(found) != len(parts):
        sys.exit(f"{arguments}: {len(found)} motions, {len(parts)} counted, status {status}")
    return [{"kind": kind, **row, "instructions": part.total} for row, part in zip(found, parts)]


def motion_jobs(build):
    """what is counted, the dearest first: [(function, arguments)]"""
    program = build / "tests/accuracy/accuracy_motions"
    jobs = []
    for kind, last, step in (("by-method", 11, 2), ("by-integrator", 13, 1)):
        for setting in run(program, "list", kind).split():
            jobs += [(count_motions, (program, kind, problem, setting, 5, last, step)) for problem in PROBLEMS]
    jobs += [(count_motions, (program, "by-accuracy", problem, "--accuracy", 1, 10, 1)) for problem in PROBLEMS]
    jobs += [(count_motions, (program, "by-integrator", f"scale-{n}", "dop853", 8, 8, 1)) for n in reversed(SIZES)]
    slow = ("bsimp", "svd", "udwadia", "schur", "alpha", "scale-10000", "radau")
    return sorted(jobs, key=lambda job: next((i for i, name in enumerate(slow) if name in "".join(job[1][2:4])), len(slow)))


# ---- what --accuracy promises ----

def survey(build, count):
    """[(table, rows)] of accuracy_survey (README.md)"""
    program, names = build / "tests/accuracy_survey", ("survey", "honesty")

    def work():
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder) / name for name in names]
            run(program, "--count", count, "--seed", 1, "--csv", paths[0], "--honesty", paths[1], "--jobs", 2)
            return [path.read_text(encoding="utf-8") for path in paths]

    texts = kept(program, [count, 1], work)
    return [(name, list(csv.DictReader(io.StringIO(text)))) for name, text in zip(names, texts)]


# ---- verdicts ----

def verdict_devices(build, first, count):
    """[(seed, letters, utilisation)]"""
    program = build / "tests/accuracy/accuracy_verdicts"
    said = kept(program, [first, count], lambda: run(program, first, count))
    return [(int(a), b, float(c)) for a, b, c in csv.reader(io.StringIO(said))]


def wilson(part, whole, z=1.959964):
    """Interval of 95 % of a share (Wilson, J. Am. Stat. Assoc. 22, 209, 1927)."""
    p, d = part / whole, 1 + z * z / whole
    middle, half = (p + z * z / (2 * whole)) / d, z / d * math.sqrt(p * (1 - p) / whole + z * z / (4 * whole * whole))
    return max(0.0, middle - half), min(1.0, middle + half)


def verdicts(devices):
    """per accuracy: how many are decided otherwise than by the tightest run"""
    letters = [d[1] for d in devices if "-" not in d[1]]
    for i, accuracy in enumerate(ACCURACIES):
        row = collections.Counter(text[i] for text in letters)
        changed = sum(text[i] != text[-1] for text in letters)
        flipped = sum({text[i], text[-1]} == {"a", "r"} for text in letters)
        found = {"accuracy": accuracy, "devices": len(letters), "accepted": row["a"], "rejected": row["r"]}
        for name, part in (("inconclusive", row["i"]), ("changed", changed), ("flipped", flipped)):
            low, high = wilson(part, len(letters))
            found |= {name: part, f"{name}_share": part / len(letters), f"{name}_low": low, f"{name}_high": high}
        yield found


# ---- hinges and their models ----

HINGE = ("device", "hinge", "flow", "level", "cpu_s", "stiffness_off", "strain_off", "stiffness_estimate",
         "strain_estimate")  # of ladder.py


def hinges(build, with_solids):
    """the ladder of every hinge, against CalculiX: from the rows at hand where it is not installed"""
    if not with_solids:
        with (ROOT / "docs/data/hinge-ladder.csv").open(newline="", encoding="utf-8") as file:
            return [{k: row[k] for k in HINGE} for row in csv.DictReader(file)]
    program = build / "flexwright"
    return [{k: row[k] for k in HINGE}
            for device in hinge_ladder.DEVICES for row in hinge_ladder.rows(program, device, 1)]


def hinge_costs(build):
    """instructions of every cheap level of every hinge"""
    program, found = build / "tests/accuracy/accuracy_levels", []
    for device in hinge_ladder.DEVICES:
        said, status, parts = callgrind.count(program, [ROOT / "docs/gallery" / device / "device.xml"], "fw_plan_ladder_climb")
        names = list(csv.reader(io.StringIO(said)))
        if status or len(names) != len(parts):
            sys.exit(f"{device}: {len(names)} levels, {len(parts)} counted, status {status}")
        found += [{"device": device, "hinge": hinge, "level": level, "instructions": part.total}
                  for (hinge, level), part in zip(names, parts)]
    return found


def times(ratios):
    middle, low, high = curves.interval(ratios)
    return {"ratio": middle, "ratio_low": low, "ratio_high": high, "rounds": len(ratios)}


def models(build, device):
    """largest error of a peak hinge angle by each model of the hinges, against exact beams in the same scene"""
    path, peaks = ROOT / "docs/gallery" / device / "device.xml", {}
    for model in ("elastica", "compliance", "revolute"):
        said = as_json(build / "flexwright", "simulate", path, "--json", "--accuracy", "1e-5", "--hinge-model", model)
        peaks[model] = said["hinge_model"]["used"], [abs(p["angle_rad"]) for p in said["peaks"]]
    if peaks["elastica"][0] != "elastica":
        sys.exit(f"{device} has no exact beams")
    exact = peaks["elastica"][1]
    return [{"device": device, "model": model, "peak_error": max(abs(a - b) for a, b in zip(found, exact)) / max(exact)}
            for model, (_, found) in peaks.items() if model != "elastica"]


# ---- masks ----

def masks(build):
    found = []
    for tolerance in MASK_TOLERANCES_NM:
        with tempfile.TemporaryDirectory() as work:
            out = pathlib.Path(work) / "out"
            said = as_json(build / "flexwright", "mask", SIX_BAR, "--flow", "al-masked-rie", "--corners", "none", "--mask-tolerance",
                           tolerance, "-q", "--json", "-o", out)
            device = said["masks"][0]["layers"][0]
            found.append({"tolerance_nm": tolerance, "edge_error_nm": device["edge_error_nm"], "vertices": device["vertices"],
                          "bytes": (out / "masks/al-masked-rie.gds").stat().st_size})
    return found


# ---- time ----

def time_ratios(build):
    """CPU time at every accuracy over that at the default, in rounds of fresh processes"""
    rounds = [dict((float(a), float(b)) for a, b in csv.reader(io.StringIO(run(build / "tests/accuracy/accuracy_times"))))
              for _ in range(TIME_ROUNDS)]
    rows = [{"what": "ratio", "accuracy": f"{a:.0e}".replace("e-0", "e-"), **times([r[a] / r[1e-3] for r in rounds])} for a in rounds[0]]
    return rows + [{"what": "ms", "accuracy": "1e-3", **times([r[1e-3] for r in rounds])}]


# ---- peers ----

PEER = ("peer", "setting", "tolerance", "error", "cpu_ms")


def peers(build, anew):
    """[(peer, setting, state error, CPU ms)] of what the benchmarks' picture shows, and by whom they were measured"""
    shown = [(peer, setting) for peer, setting, *_ in report.SHOWN]
    if not anew:
        rows = curves.read(ROOT / "docs/data/benchmarks.csv")
        date = curves.select(rows, "provenance", "date")[0].setting
        said = f"the rows of docs/data/benchmarks.csv, measured {date}"
    else:
        made, rows = programs.Programs(build, ["simbody", "sundials", "octave"], built=True), []
        for peer, setting in shown:
            if peer in made.run:
                rows += made.measure(peer, "sixbar", "--quick", "--only", setting)
        missing = [name for name in ("Simbody", "SUNDIALS", "Octave") if name not in made.run]
        said = "measured in this run" + "".join(f"; {name} is not installed" for name in missing)
    found = [dict(zip(PEER, (r.peer, r.setting, r.tolerance, r.error, r.cpu_ms))) for r in rows
             if r.problem == "sixbar" and r.name in shown and r.error > 0 and r.cpu_ms > 0]
    return found, said


# ---- provenance ----

def source_hash():
    """of all files below src/, by name and content: the same sources, the same hash, whatever the commit"""
    whole = hashlib.sha256()
    for path in sorted((ROOT / "src").rglob("*")):
        if path.is_file():
            whole.update(str(path.relative_to(ROOT)).encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return whole.hexdigest()


def provenance(build, date, facts):
    processor, system = programs.machine()
    built = json.loads((build / "tests/bench/gate.json").read_text(encoding="utf-8"))
    flags = " ".join(re.findall(r"-f\S+", (ROOT / "cmake/flags.cmake").read_text(encoding="utf-8").split("add_compile_options", 1)[1]
                                .split(")")[0]))
    loaded = run("ldd", build / "flexwright")
    blas = re.search(r"=> (\S*libopenblas\S*)", loaded) or re.search(r"=> (\S*libblas\S*)", loaded)
    cpu = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    said = [("command", "cmake --build build --target accuracy"), ("date", date), ("sources", f"sha256 {source_hash()} of src/"),
             ("compiler", built["compiler"]), ("flags", f"{built['flags']} {flags}"), ("system", system), ("processor", processor),
             ("FMA", "yes" if re.search(r"\bfma\b", cpu) else "no"),
             ("AVX-512", "yes, not while counting" if re.search(r"\bavx512f\b", cpu) else "no"),
             ("BLAS", pathlib.Path(blas.group(1)).resolve().name if blas else "unknown"),
             ("libc", run("ldd", "--version").splitlines()[0]),
             ("instructions", run("valgrind", "--version").strip() + f" (callgrind), GLIBC_TUNABLES={callgrind.PINNED['GLIBC_TUNABLES']}"),
             *sorted(facts.items())]
    return [{"what": what, "value": value} for what, value in said]
