#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh DIR [REFERENCE_DIR]: independent programs (KLayout, gdspy, GEOS) judge every FLOW.gds in DIR:
# strict reading, width, space, angles, overlaps and grid per layer with the layer's own rule of
# masks/FLOW.xml (of FLOW-coupons.gds too) and with 4 um, polygon validity and clearance, areas of FLOW.json, FLOW.lyp loads.
# With REFERENCE_DIR the files of the same name must be equal layer by layer.
# Exit 0 passed, 1 failed, 77 skipped because klayout is not installed.
here=$(cd "$(dirname "$0")" && pwd)
tables=${FW_MASK_TABLES:-$here/../../masks}
export QT_QPA_PLATFORM=offscreen LC_ALL=C
if [ $# -lt 1 ] || [ ! -d "$1" ]; then
    echo "usage: run.sh DIR [REFERENCE_DIR]" >&2
    exit 2
fi
if ! command -v klayout >/dev/null; then
    echo "SKIPPED: klayout is not installed (Debian: apt-get install klayout python3-gdspy libgeos-dev)"
    exit 77
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failed=0
judge() { # judge NAME COMMAND...
    local name=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        echo "ok    $name"
    else
        echo "FAIL  $name"
        sed 's/^/      /' "$work/log" | tail -20
        failed=1
    fi
}
klayout_judges() { # klayout_judges NAME SCRIPT [NAME=VALUE]...: all are asked of one KLayout at the end
    local IFS=$'\t'
    echo "$*" >>"$work/jobs"
}
if ! ${CC:-cc} -O2 "$here/geos_check.c" -lgeos_c -lm -o "$work/geos_check" 2>"$work/log"; then
    echo "FAIL  geos_check does not compile (Debian: apt-get install libgeos-dev)"
    cat "$work/log"
    failed=1
fi
count=0
for gds in "$1"/*.gds; do
    [ -f "$gds" ] || continue
    count=$((count + 1))
    flow=$(basename "$gds" .gds) stem=${gds%.gds}
    judge "$flow: all that the certificate says" /usr/bin/python3 "$here/check_mask.py" "$stem.json"
    klayout_judges "$flow: strict reading without warnings" kl_nowarn.sh "f=$gds"
    /usr/bin/python3 "$here/layers.py" "$gds" "$tables/${flow%-coupons}.xml" "$stem.json" >"$work/layers"
    [ -s "$work/layers" ] || { echo "FAIL  $flow: no polygons"; failed=1; }
    areas=()
    while read -r layer width space area; do
        rules=("$width $space")
        [ "$width $space" = "4.0 4.0" ] || rules+=("4.0 4.0")
        for rule in "${rules[@]}"; do
            klayout_judges "$flow $layer: width ${rule% *} um, space ${rule#* } um, angles, overlaps" \
                kl_drc.py "f=$gds" "layer=$layer" "width=${rule% *}" "space=${rule#* }"
        done
        judge "$flow $layer: valid polygons, clearance above 20 nm" \
            "$work/geos_check" "$gds" "${layer%/*}" "${layer#*/}" 0.020
        [ "$area" = - ] || areas+=("$layer:$area")
    done <"$work/layers"
    judge "$flow: gdspy reads it, ${#areas[@]} areas" \
        /usr/bin/python3 "$here/gdspy_read.py" "$gds" "${areas[@]}"
    lyp=()
    [ -f "$stem.lyp" ] && lyp=("lyp=$stem.lyp")
    klayout_judges "$flow: picture${lyp:+ with its layer properties}" kl_png.py "f=$gds" "${lyp[@]}" "png=$work/$flow.png" w=400 h=400
    if [ -f "$stem.oas" ]; then
        klayout_judges "$flow: OASIS, strict reading without warnings" kl_nowarn.sh "f=$stem.oas"
        klayout_judges "$flow: OASIS equal to GDSII" kl_xor.py "a=$gds" "b=$stem.oas"
    fi
    if [ -f "$stem.dxf" ]; then
        klayout_judges "$flow: DXF with its technology file, arcs against GDSII" \
            kl_dxf.py "gds=$gds" "dxf=$stem.dxf" "lyt=$stem.lyt"
    fi
    if [ -n "$2" ]; then
        klayout_judges "$flow: equal to the reference" kl_xor.py "a=$gds" "b=$2/$flow.gds"
    fi
done
if [ "$count" -eq 0 ]; then
    echo "FAIL  no .gds file in $1"
    failed=1
else
    judge "KLayout was asked" /usr/bin/python3 "$here/kl_asked.py" "$work/jobs" "$work/answers"
    cat "$work/answers"
    ! grep -q ^FAIL "$work/answers" || failed=1
fi
[ "$failed" -eq 0 ] && echo "ACCEPT PASS ($count files)" || echo "ACCEPT FAIL"
exit "$failed"
