# SPDX-License-Identifier: GPL-3.0-or-later
"""Running the program from tests."""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs/gallery/reference-six-bar/device.xml"
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
FLOWS = ("al-masked-rie", "copper-on-porous-silicon")


def run(*arguments, **options):
    options.setdefault("cwd", ROOT)
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=240, **options)
