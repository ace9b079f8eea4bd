#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""frequencies.py PROGRAM JUDGE [SEED COUNT]

The three slowest frequencies of random devices by the judge's own exact beams, and by `modes` on every model of the hinges that
has them: the truth lies within the error that the program states of each. Devices that a driver moves are left out: the judge's
swing freely."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import devices  # noqa: E402

LOOKED_AT = 3
DRIVEN = ("rod", "slide", "turn", "shock")
PRINTED = 1e-8  # relative, of the judge's digits

def truths(judge, device, where):
    where.write_text(device.model(), encoding="utf-8")
    done = subprocess.run([judge, "modes", where], capture_output=True, text=True, timeout=60)
    return sorted(float(v) for v in done.stdout.split()) if done.returncode == 0 else []

def wrongs(program, path, model, true):
    done = subprocess.run([program, "modes", path, "--json", "-q", "--hinge-model", model], capture_output=True, text=True, timeout=60)
    if done.returncode:
        return None
    modes = sorted(json.loads(done.stdout)["modes"], key=lambda m: m["omega_rad_per_s"])
    if len(modes) != len(true):  # pins have but the slowest
        modes = modes[:1]
    return ["%s: %.6g rad/s, truth %.6g, error %s" % (model, m["omega_rad_per_s"], t, m["frequency_error"])
            for m, t in list(zip(modes, true))[:LOOKED_AT]
            if m["frequency_error"] is None or abs(t / m["omega_rad_per_s"] - 1) > m["frequency_error"] + PRINTED]

def main(program, judge, seed=3001, count=40):
    done = bad = 0
    with tempfile.TemporaryDirectory() as where:
        path = pathlib.Path(where) / "device.xml"
        for n in range(int(seed), int(seed) + int(count)):
            device = devices.Device(n, None)
            true = [] if device.load in DRIVEN else truths(judge, device, pathlib.Path(where) / "model")
            if not true or true[0] <= 0:
                continue
            path.write_text(device.xml(1e-9, 1e-3), encoding="utf-8")
            for model in ("auto", "compliance", "elastica"):
                wrong = wrongs(program, path, model, true)
                if wrong is None:
                    continue
                done += 1
                bad += len(wrong) > 0
                for line in wrong:
                    print("%d %s/%s/%s %s" % (n, device.topology, device.kind, device.load, line))
    print("%d answers about random devices, %d with a truth outside of its error" % (done, bad))
    return 1 if bad or done < int(count) else 0

if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
