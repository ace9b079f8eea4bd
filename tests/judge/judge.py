#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""judge.py [--judge PROGRAM] [--program FLEXWRIGHT] [--seed N] [--count N] [--class TOPOLOGY/KIND/LOAD] [--jobs N] [--keep DIR]

Random devices, each loaded so that the judge's own exact beams find a hinge at 0.9 to 1.1 of its limit; then the program's
verdict of the same device, by its default and by exact beams. Exit 1 on a false accept or reject, or where less than 99.5 %
of the truths lie in their bands. README.md says what truth is."""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import threading

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import devices  # noqa: E402

CPU_S = 300

WANTED = 0.995
LOCK = threading.Lock()

def run(command, most=CPU_S):
    """status, output, messages and seconds of processor time"""
    process = subprocess.Popen([str(v) for v in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (most, most)))
    said = []
    thread = threading.Thread(target=lambda: said.append(process.stderr.read()))
    thread.start()
    out = process.stdout.read()
    thread.join()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    took = used.ru_utime + used.ru_stime
    process.stdout.close()
    process.stderr.close()
    return process.returncode, out, said[0] if took < most - 0.5 else "more than %g s" % most, took

def make(options, seed, wanted, where):
    """(device, share, duration, truths of the hinges), or None and why the seed gives no device"""
    device = devices.Device(seed, wanted)
    model = where / ("%d.model" % seed)
    model.write_text(device.model(), encoding="utf-8")
    status, out, why, _ = run([options.judge, "modes", model])
    if status:
        return None, "modes: " + why
    omega = [float(v) for v in out.split()]
    if omega[0] < 1e-3 * omega[-1] * 1e-3:
        return None, "a mode without stiffness"
    duration = device.timing(omega[0])
    model.write_text(device.model(duration), encoding="utf-8")
    aim = device.strength_of() * device.target
    most = {"voltage": 9000, "heat": 2900, "turn": 3, "slide": 500, "rod": 500}.get(device.load, 1e12)
    status, out, why, _ = run([options.judge, "aim", model, "%.15g" % aim, "%.15g" % most])
    if status:
        return None, "no load leads there: %s" % (why.strip() or "status %d" % status)
    found = json.loads(out)
    if not device.moving:  # loads soften some devices: slow is what is slow there, too
        if not found["omega"] > 0:
            return None, "no stiffness under the load"
        # and what is soft answers more by as much to the little that inertia adds
        soft = min(omega[0], found["omega"])
        duration = device.timing(soft * soft / omega[0])
    truths = [f["stress"] / device.strength_of() for f in found["flexures"]]
    return (device, found["share"], duration, truths, found), ""

def verdict(options, path, elastica):
    more = ["--hinge-model", "elastica"] if elastica else []
    status, out, why, took = run([options.program, "check", path, "--json", "--corners", "none", "--advice", "none",
                                  "--no-progress", *more], options.most)
    try:
        return json.loads(out), why, took
    except ValueError:
        return None, "status %d: %s" % (status, why.strip()), took

WORSE = ("accept", "inconclusive", "reject")
# parts that come together, and parts that are not in the drawing (decisions 46 and 60), of which the judge knows nothing
MEETING = {"FW-D130", "FW-D131", "FW-D294", "FW-D295"}
# electrodes that touch, sideways or at the ends of their fingers: the judge's combs pull along alone
TOUCHING = "FW-D242"

def of_strain(said):
    """the verdict without what the judge does not look at: drawings that cannot be made, and parts that meet"""
    reasons = [r["verdict"] for r in said["reasons"] if r["code"] not in MEETING]
    return max([h["verdict"] for h in said["hinges"]] + reasons, key=WORSE.index)

def compare(said, truths, names):
    """what is wrong with a verdict: list of words"""
    wrong, most, decision = [], max(truths), of_strain(said)
    if said["verdict"] == "accept" and most > 1:
        wrong.append("false accept")
    if decision == "accept" and most > 1:
        wrong.append("false accept of the hinges")
    if decision == "reject" and most <= 1:
        wrong.append("false reject")
    hinges = {h["id"]: h for h in said["hinges"]}
    worst = names[truths.index(most)]
    for name, truth in zip(names, truths):
        low, high = hinges[name]["utilisation_band"] if name in hinges else (0, float("inf"))
        if not low <= truth <= high:
            wrong.append("band" if name == worst else "other band")
    return wrong

def one(options, seed, wanted, where):
    row = examine(options, seed, wanted, where)
    if options.json:  # a line at a time: what is known when a long run is stopped
        with LOCK, open(options.json, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
    return row


def examine(options, seed, wanted, where):
    row = {"seed": seed}
    made, why = make(options, seed, wanted, where)
    if not made:
        device = devices.Device(seed, wanted)
        return dict(row, name="/".join((device.topology, device.kind, device.load)), skipped=why)
    device, share, duration, truths, found = made
    path = where / ("%d.xml" % seed)
    path.write_text(device.xml(share, duration), encoding="utf-8")
    names = [h.name for h in device.hinges]
    worst = truths.index(max(truths))
    more = (("stated", device.stated), ("drawn", device.drawn), ("silicon", device.material.crystal))
    row.update(name="/".join((device.topology, device.kind, device.load)), more=" ".join(word for word, so in more if so),
               share=share, bodies=found["bodies"], truth=max(truths), at=found["flexures"][worst]["at"],
               hinge=names[worst], path=str(path))
    for model in ("default", "elastica"):
        said, why, took = verdict(options, path, model == "elastica")
        row[model + " s"] = took
        if said and not said.get("hinges") and TOUCHING in {r["code"] for r in said["reasons"]}:
            return dict(row, skipped="its electrodes touch, which the judge's do not")
        if said is None or not said.get("hinges"):
            row[model] = {"wrong": ["error"], "why": why or "no hinges"}
            continue
        hinge = {h["id"]: h for h in said["hinges"]}.get(names[worst])
        row[model] = {"verdict": said["verdict"], "wrong": compare(said, truths, names), "why": why.strip(),
                      "utilisation": hinge["utilisation"], "band": hinge["utilisation_band"], "parts": hinge.get("band_parts"),
                      "bands": {h["id"]: h["utilisation_band"] for h in said["hinges"]}}
    bands = [row[m].get("bands", {}) for m in ("default", "elastica")]
    row["apart"] = [k for k in bands[0] if k in bands[1]
                    and (bands[0][k][1] < bands[1][k][0] or bands[1][k][1] < bands[0][k][0])]
    return row

def wrongs(row):
    out = [("%s: %s" % (m, w)) for m in ("default", "elastica") for w in row.get(m, {}).get("wrong", [])]
    return out + (["models do not meet"] if row.get("apart") else [])

def table(rows, key):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    print("%-34s %5s %5s | %6s %6s %6s %6s %6s %8s | %6s %6s %6s %6s %6s %8s | %5s" % (
        "", "n", "skip", "accept", "reject", "inconc", "band", "error", "time s", "accept", "reject", "inconc", "band", "error",
        "time s", "apart"))
    for name in sorted(groups):
        group = groups[name]
        done = [r for r in group if "skipped" not in r]
        cells = []
        for model in ("default", "elastica"):
            what = [r[model] for r in done]
            cells += [sum("false accept" in w["wrong"] for w in what), sum("false reject" in w["wrong"] for w in what),
                      sum(w.get("verdict") == "inconclusive" for w in what), sum("band" in w["wrong"] for w in what),
                      sum("error" in w["wrong"] for w in what),
                      "%8.2f" % (sum(r[model + " s"] for r in done) / max(1, len(done)))]
        print("%-34s %5d %5d | %6d %6d %6d %6d %6d %s | %6d %6d %6d %6d %6d %s | %5d" % (
            name, len(done), len(group) - len(done), *cells, sum(bool(r["apart"]) for r in done)))

def report(rows, verbose):
    print("accept, reject: false ones; band: truth outside of the governing hinge's band; first by default, then exact beams")
    table(rows, lambda r: r["name"].split("/")[0] + " " + r["name"].split("/")[2])
    print()
    table(rows, lambda r: "kind " + r["name"].split("/")[1])
    print()
    table([r for r in rows if "more" in r], lambda r: r["more"] or "isotropic, axis only")
    print()
    table(rows, lambda r: "all")
    bad = [r for r in rows if "skipped" not in r and wrongs(r)]
    bad.sort(key=lambda r: -abs(r.get("default", {}).get("utilisation", 9) / r["truth"] - 1))
    print("\nworst first: seed, class, truth, utilisation and band by default, by exact beams")
    for row in bad[:None if verbose else 25]:
        text = ["%d %s %s truth %.4f %s" % (row["seed"], row["name"], row["more"], row["truth"], row["hinge"])]
        for model in ("default", "elastica"):
            said = row[model]
            text.append("%s %.4f %.4f..%.4f" % (said["verdict"], said["utilisation"], *said["band"]) if "band" in said
                        else "error " + said["why"][:100])
        print("  " + " | ".join(text) + " | " + ", ".join(wrongs(row)))

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--judge", default="build/tests/judge")
    parser.add_argument("--program", default="build/flexwright")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=24)
    parser.add_argument("--class", dest="wanted", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--most", type=int, default=30, help="seconds of processor time for one verdict")
    parser.add_argument("--keep", default="")
    parser.add_argument("--json", default="", help="file that gets a line of JSON for every device")
    parser.add_argument("--report", default="", help="such a file, to be reported again; nothing is judged")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    if options.report:
        report([json.loads(line) for line in pathlib.Path(options.report).read_text(encoding="utf-8").splitlines()],
               options.verbose)
        return 0
    pattern = re.compile(options.wanted.replace("*", ".*") + "$") if options.wanted else None
    fitting = [c for c in devices.classes() if not pattern or pattern.match("/".join(c))]
    if not fitting:
        sys.exit("no class is called so; there are " + " ".join("/".join(c) for c in devices.classes()))
    with tempfile.TemporaryDirectory() as own:
        where = pathlib.Path(options.keep or own)
        where.mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            seeds = range(options.seed, options.seed + options.count)
            rows = list(pool.map(lambda s: one(options, s, fitting[s % len(fitting)] if pattern else None, where), seeds))
    report(rows, options.verbose)
    done = [r for r in rows if "skipped" not in r]
    false = sum("false" in w for r in done for w in wrongs(r))
    held = sum("band" not in r[m]["wrong"] and "error" not in r[m]["wrong"] for r in done for m in ("default", "elastica"))
    share = held / max(1, 2 * len(done))
    print("\n%d devices (%d seeds gave none): %d false verdicts, %.2f %% of the truths in their bands, %d pairs of models apart"
          % (len(done), len(rows) - len(done), false, 100 * share, sum(bool(r["apart"]) for r in done)))
    return 1 if false or share < WANTED or any(r["apart"] for r in done) else 0

if __name__ == "__main__":
    sys.exit(main())
