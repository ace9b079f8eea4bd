#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""symbols.py LIBRARY: the shared library exports the functions of include/flexwright.h, all of them and
nothing else."""
import pathlib
import re
import subprocess
import sys

header = (pathlib.Path(__file__).resolve().parents[2] / "include/flexwright.h").read_text()
header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
declared = set(re.findall(r"^FW_API [^;{]*?(\w+)\(", header, flags=re.M))
listing = subprocess.run(["nm", "-D", "--defined-only", "--format=posix", sys.argv[1]],
                         capture_output=True, text=True, check=True).stdout
exported = {line.split()[0] for line in listing.splitlines()}
for name in sorted(exported - declared):
    print(f"exported but not in flexwright.h: {name}")
for name in sorted(declared - exported):
    print(f"in flexwright.h but not exported: {name}")
print(f"{len(declared)} functions declared, {len(exported)} symbols exported")
sys.exit(0 if declared and exported == declared else 1)
