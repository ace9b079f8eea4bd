#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which tests run under the sanitizers: a set that passes nearly every edge of control flow of src/ that all quick tests pass, and
every function, without those that take long and add little.

edges.py make             runs every quick test by itself in build-edges (clang, a counter at each edge) and writes
                          left-out.txt: the tests whose edges others pass, too, and what each takes; and not-reached.txt:
                          the functions that none enters. Some minutes; make both anew when a test of the sanitizers says so
edges.py choose           the same from what the last make has measured
edges.py more REGEX       after make: the same of other tests, of the whole that is only in ./test --all, say, one by one: the edges
                          that neither the tests of make nor those of REGEX before it pass, with their functions
edges.py reached DIR PROGRAMS
                          what programs have left in DIR (FW_EDGES_TO): every external function of src/ that is not in
                          not-reached.txt was passed, else its name is printed and the status is 1; PROGRAMS is their build directory

A test that is not in left-out.txt runs, so that a new one does. An edge is known by its file, its function and its place in it,
whatever program it is in. tests/build/sanitized_beside.sh, what else runs under the sanitizers, comes first."""
import collections
import json
import os
import pathlib
import pickle
import re
import struct
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TREE = ROOT / "build-edges"
LEFT_OUT, NOT_REACHED = HERE / "left-out.txt", HERE / "not-reached.txt"
START = 0.5  # s, of a program, and of a test to be compiled
FEW, SHORT = 15, 1.0  # edges that nothing else passes for each second under the sanitizers; s, what is not worth leaving out


def functions(program):
    """sorted (address, name) of what a program has; a function that only its file sees is FILE:NAME"""
    text = subprocess.run(["readelf", "-sW", program], capture_output=True, text=True, check=True).stdout
    found, file = [], ""
    for row in text[text.index(".symtab"):].splitlines():
        part = row.split()
        if len(part) < 8:
            continue
        if part[3] == "FILE":
            file = part[7]
        elif part[3] == "FUNC" and part[6] != "UND":
            outside = part[4] != "LOCAL" or part[7].startswith("fw_")  # hidden ones stand at the end, behind any file
            found.append((int(part[1], 16), part[7] if outside else f"{file}:{part[7]}"))
    return sorted(found)


def places(directory, programs):
    """{program: [(function, offset, at its start) of each edge]}"""
    known = {}
    for file in directory.glob("*.places"):
        program = next(p for p in (programs / file.stem, programs / "tests" / file.stem, programs / "tools/solids" / file.stem)
                       if p.is_file())
        table, at, rows = functions(program), 0, list(struct.iter_unpack("<QQ", file.read_bytes()))
        known[file.stem] = [None] * len(rows)
        for i in sorted(range(len(rows)), key=lambda i: rows[i]):
            while at + 1 < len(table) and table[at + 1][0] <= rows[i][0]:
                at += 1
            known[file.stem][i] = (table[at][1], rows[i][0] - table[at][0], bool(rows[i][1]))
    return known


def passed(directory, known):
    edges = set()
    for file in directory.glob("*.edges"):
        where = known[file.stem.rpartition("-")[0]]
        edges.update(where[i] for i, byte in enumerate(file.read_bytes()) if byte)
    return edges


def build():
    subprocess.run(["cmake", "-S", ROOT, "-B", TREE, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DFW_EDGES=edge", "-DFW_TESTS=ON",
                    "-DFW_PAGE=OFF", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_FLAGS_DEBUG=-O1"], check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", TREE, "--target", "sanitized"], check=True, stdout=subprocess.DEVNULL)


def quick():
    """of ctest: what may run under the sanitizers"""
    never = re.search(r"^sanitized_never='(.*)'$", (ROOT / "tests/build/sanitized_build.sh").read_text(), re.M).group(1)
    return "-L", "quick|longer", "-E", never, "-R", "^(unit|hard)[.]"  # others always run


def candidates(*which):
    """{name: (command, environment, directory)}"""
    listed = subprocess.run(["ctest", "--test-dir", TREE, *which, "--show-only=json-v1"], capture_output=True, text=True,
                            check=True).stdout
    found = {}
    for test in json.loads(listed)["tests"]:
        properties = {p["name"]: p["value"] for p in test["properties"]}
        found[test["name"]] = (test["command"], dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", [])),
                               properties["WORKING_DIRECTORY"])
    return found


def run(command, environment, directory, known):
    """the edges that it passes, and how long it takes"""
    with tempfile.TemporaryDirectory() as to:
        before = time.monotonic()
        done = subprocess.run(command, env={**os.environ, **environment, "FW_TEST_FEWEST": "1", "FW_EDGES_TO": to}, cwd=directory, capture_output=True,
                              check=False)
        if done.returncode:
            sys.exit("%s: status %d\n%s" % (command, done.returncode, (done.stdout + done.stderr)[-2000:].decode()))
        taken = time.monotonic() - before
        to = pathlib.Path(to)
        for name, where in places(to, TREE).items() if any(f.stem not in known for f in to.glob("*.places")) else ():
            known[name] = where
        return passed(to, known), taken


def costs(seconds):
    """what each test takes under the sanitizers: as ctest has measured it there, or eight times what it takes without"""
    found = {name: 8 * s for name, s in seconds.items()}
    measured = ROOT / "build-asan/Testing/Temporary/CTestCostData.txt"
    for line in measured.read_text().splitlines() if measured.exists() else ():
        name, *rest = line.split()
        if name in found and len(rest) == 2:
            found[name] = float(rest[1])
    return {name: START + s for name, s in found.items()}


def stays(name, cost):
    """short, or it reads what somebody else has written: the same edges with other bytes are another test"""
    return cost[name] < SHORT or "hostile" in name


def least(sets, cost, edges):
    """tests, those with most new edges for their time first; left out are long ones that add few edges and no function"""
    left, chosen = set(edges), []
    gain = {name: len(s & left) for name, s in sets.items()}
    while gain:
        while True:  # what a test adds only shrinks: look anew at the best alone
            best = max(gain, key=lambda n: gain[n] / cost[n])
            now = len(sets[best] & left)
            if now == gain[best]:
                break
            gain[best] = now
        new = sets[best] & left
        if now >= FEW * cost[best] or stays(best, cost) or {e[0] for e in new} & {e[0] for e in left if e[2]}:
            chosen.append(best)
            left -= new
        del gain[best]
    count = collections.Counter(e for n in chosen for e in sets[n] & edges)
    for name in sorted(chosen, key=lambda n: -cost[n]):  # later ones may make it superfluous
        if not stays(name, cost) and all(count[e] > 1 for e in sets[name] & edges):
            chosen.remove(name)
            count.subtract(sets[name] & edges)
    return chosen


def make():
    build()
    known, sets, seconds = {}, {}, {}
    beside, taken = run([ROOT / "tests/build/sanitized_beside.sh", TREE], {}, ROOT, known)
    print("beside the tests: %d edges, %.0f s" % (len(beside), taken), flush=True)
    for name, what in candidates(*quick()).items():
        sets[name], seconds[name] = run(*what, known)
    (TREE / "edges.pickle").write_bytes(pickle.dumps((known, beside.union(*sets.values()), beside, sets, seconds)))
    return choose()


def choose():
    known, everything, beside, sets, seconds = pickle.loads((TREE / "edges.pickle").read_bytes())
    cost = costs(seconds)
    chosen = least(sets, cost, everything - beside)
    passed_by = beside.union(*(sets[n] for n in chosen))
    starts = {name for table in known.values() for name, _, start in table if start and name.startswith("fw_")}
    reached_by = {name for name, _, _ in passed_by}
    said = "%d of the %d edges that all %d pass are passed by %d of them, in %.0f s of %.0f s" % (
        len(passed_by), len(everything), len(sets), len(chosen), sum(cost[n] for n in chosen), sum(cost.values()))
    LEFT_OUT.write_text("# made by tests/edges/edges.py: quick tests that run under the sanitizers only with ./test --all.\n# %s\n%s" % (
        said, "".join("%s %.1f s, %d edges of its own\n" % (n, cost[n], len(sets[n] - passed_by)) for n in sorted(set(sets) - set(chosen)))))
    NOT_REACHED.write_text("# made by tests/edges/edges.py: external functions of src/ that no test enters that runs under the sanitizers\n"
                           + "".join(n + "\n" for n in sorted(starts - reached_by)))
    print("%s; %d functions of %d not reached" % (said, len(starts - reached_by), len(starts)))
    return 0


def more(regex):
    subprocess.run(["cmake", "--build", TREE, "--target", "hard"], check=True, stdout=subprocess.DEVNULL)
    known, everything, *_ = pickle.loads((TREE / "edges.pickle").read_bytes())
    for name, what in candidates("-R", regex).items():
        edges, taken = run(*what, known)
        new = edges - everything
        everything |= edges
        where = ", ".join("%s %d" % pair for pair in collections.Counter(e[0] for e in new).most_common())
        print("%s, %.1f s: %d edges, %d of them new%s" % (name, taken, len(edges), len(new), ": " + where if new else ""), flush=True)
    return 0


def reached(directory, programs):
    known = places(directory, programs)
    # those with a name that other files know: which others are left of a file depends on how it is optimised
    names = {name for table in known.values() for name, _, start in table if start and name.startswith("fw_")}
    found = {name for name, _, _ in passed(directory, known)}
    excused = {r for r in NOT_REACHED.read_text().splitlines() if not r.startswith("#")}
    missing = sorted(names - found - excused)
    for name in missing:
        print("%s is in no test that runs under the sanitizers: write one, or run tests/edges/edges.py make" % name)
    print("%d functions of %d ran under the sanitizers" % (len(found & names), len(names)))
    return 1 if missing else 0


if __name__ == "__main__":
    if sys.argv[1:] in (["make"], ["choose"]):
        sys.exit({"make": make, "choose": choose}[sys.argv[1]]())
    if len(sys.argv) == 3 and sys.argv[1] == "more":
        sys.exit(more(sys.argv[2]))
    if len(sys.argv) == 4 and sys.argv[1] == "reached":
        sys.exit(reached(*map(pathlib.Path, sys.argv[2:])))
    sys.exit(__doc__)
