# SPDX-License-Identifier: GPL-3.0-or-later
"""The package of the source tree with the library of a build; the name of the build is the first argument."""
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAM = BUILD / "flexwright"
os.environ["FLEXWRIGHT_LIBRARY"] = str(BUILD / "libflexwright.so.0")
os.environ.setdefault("FLEXWRIGHT_DATA", str(ROOT))
sys.path.insert(0, str(ROOT / "python"))

GALLERY = ROOT / "docs" / "gallery"
SIX_BAR = str(GALLERY / "reference-six-bar" / "device.xml")
