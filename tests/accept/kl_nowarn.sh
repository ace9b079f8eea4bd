#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# kl_nowarn.sh FILE : load with KLayout strictly (no big records, no multi-XY, BOX = error; OASIS: strict mode); any Warning/ERROR line on stdout/stderr fails
T=$(mktemp --suffix=.py); cat > "$T" <<'PY'
import pya,sys
o=pya.LoadLayoutOptions(); o.gds2_allow_big_records=False; o.gds2_allow_multi_xy_records=False; o.gds2_box_mode=3
o.oasis_expect_strict_mode=1
o.warn_level=2
ly=pya.Layout(); ly.read(f,o)
ghost=[c.name for c in ly.each_cell() if c.is_ghost_cell()]
if ghost: print("ERROR ghost cells",ghost)
tc=[c.name for c in ly.top_cells()]
if len(tc)!=1: print("ERROR top cells",tc)
print("read",f,"cells",ly.cells())
PY
OUT=$(QT_QPA_PLATFORM=offscreen klayout -b -r "$T" -rd f="$1" 2>&1); rc=$?; rm -f "$T"; echo "$OUT"
[ $rc -eq 0 ] && ! echo "$OUT" | grep -Eqi 'warning|error' && { echo "NOWARN PASS $1"; exit 0; }; echo "NOWARN FAIL $1"; exit 1
