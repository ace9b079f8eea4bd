#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""random_masks.py PROGRAM [--scripts DIR] [--keep DIR]: masks of random devices (random_devices.py) before judge.py.

FW_MASKS_COUNT (6; with FW_TEST_ALL=1, as in ./test --all, 14) devices that can be drawn, from seed FW_MASKS_FIRST (0) on. A device that is refused must have a reason of
those below, and at least six of ten must be drawn; what was refused is listed."""
import argparse
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
import judge  # noqa: E402
import random_devices  # noqa: E402

# parts that have no room, a die or hinge that cannot be drawn, and rules of the mask; never "an error of the program"
REASONS = {120, 121, 122, 123, 124, 125, 126, 127, 128, 129, 136, 137, 143, 144, 145, 152, 264}
# the drawing is what counts here: the motion is judged quickly, and a design that is rejected is drawn all the same
FAST = ["--force", "--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--mask-format", "all"]


def draw(program, seed, where):
    """directory of the masks, or None and the reasons (a set of numbers)"""
    text, options = random_devices.device(seed)
    file = where / ("%d.xml" % seed)
    file.write_text(text, encoding="utf-8")
    done = subprocess.run([program, "mask", file, *FAST, *options, "-o", where / str(seed)], capture_output=True, text=True, check=False)
    masks = where / str(seed) / "masks"
    for test_die in masks.glob("*-coupons.*"):  # much the same for all; gallery.sh judges them
        test_die.unlink()
    broken = re.search(r"error: .*\[FW-D1[45]\d\]", done.stderr)  # --force writes a mask that breaks a rule, too: it is refused
    if done.returncode in (0, 1, 4) and not broken and list(masks.glob("*.gds")):
        return masks, done
    return None, done


def collect(program, first, count, where):
    """directories of `count` drawn devices; False: something was refused without a reason of those above"""
    found, refused, tried, good = [], collections.Counter(), 0, True
    while len(found) < count and tried < 2 * count + 10:
        seed = first + tried
        tried += 1
        masks, done = draw(program, seed, where)
        if masks:
            found.append(masks)
            continue
        reasons = {int(n) for n in re.findall(r"error: .*\[FW-D(\d+)\]", done.stderr)}
        refused.update("FW-D%d" % n for n in reasons)
        if 152 in reasons:  # parts that meet do so on the grid of 1 nm, too
            reasons.discard(147)
        if not reasons or not reasons <= REASONS:
            good = False
            print("FAIL  seed %d: status %d\n%s" % (seed, done.returncode, done.stderr[:2000]))
    print("seeds %d to %d: %d drawn, refused: %s" % (first, first + tried - 1, len(found),
                                                    ", ".join("%s %d" % r for r in sorted(refused.items())) or "none"), flush=True)
    return found, good and len(found) == count and 10 * count >= 6 * tried


def asked_of(description, name, first, few, every, packages="klayout", **options):
    """What a comparison of random drawings with KLayout is asked for: the command line (PROGRAM, --keep and `options`, keyword
    arguments of add_argument by name), the first seed and how many, of FW_NAME_FIRST and FW_NAME_COUNT. Ends with 77 without KLayout."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--keep", type=pathlib.Path)
    for option, how in options.items():
        parser.add_argument("--" + option, **how)
    asked = parser.parse_args()
    if not shutil.which("klayout"):
        print("SKIPPED: klayout is not installed (Debian: apt-get install %s)" % packages)
        sys.exit(77)
    count = every if os.environ.get("FW_TEST_ALL") else few
    return asked, int(os.environ.get("FW_%s_FIRST" % name, first)), int(os.environ.get("FW_%s_COUNT" % name, count))


def main():
    asked, first, count = asked_of(__doc__, "MASKS", first=0, few=6, every=14, packages="klayout python3-gdspy libgeos-dev",
                                   scripts={"type": pathlib.Path, "default": HERE})
    with tempfile.TemporaryDirectory() as temporary:
        where = asked.keep or pathlib.Path(temporary)
        where.mkdir(parents=True, exist_ok=True)
        found, good = collect(asked.program, first, count, where)
        if not good:
            print("too few devices, or a refusal without a reason")
        status, _ = judge.judge(found, asked.scripts)
    return 0 if good and status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
