#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# wafer.sh PROGRAM: the plate of a small wafer with a sweep, as the program writes it, against KLayout,
# gdspy and xmllint: strict reading, areas of the certificate, and the same wafer built die by die from the map.
# Exit 0 passed, 1 failed, 77 skipped because klayout is not installed.
program=$1
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.." || exit 1
export QT_QPA_PLATFORM=offscreen LC_ALL=C
if ! command -v klayout >/dev/null; then
    echo "SKIPPED: klayout is not installed"
    exit 77
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
device=tests/data/wafer/leaf-wafer.xml flow=al-masked-rie
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
make() { # make DIRECTORY OPTIONS...: the masks
    local directory=$1
    shift
    "$program" mask "$device" -q -o "$work/$directory" "$@" >"$work/out" 2>&1 || { cat "$work/out"; failed=1; }
}
# the same drawing on a smaller plate, with some of its dies; ./test --all: on 50.8 mm
if [ -n "${FW_TEST_ALL:-}" ]; then set --; else set -- --set "wafer/@diameter=32 mm" --set "wafer/@flat=10 mm"; fi
make wafer --mask-format all --corners none "$@"
dies=
for value in 7 8 11 15; do # 3 um is rejected: the nominal 8 um stands there
    make "die$value" --set "width=$value um" --corners none # the verdict is looked at elsewhere
    dies=$dies,$value=$work/die$value/masks/$flow.gds
done
stem=$work/wafer/masks/$flow-wafer
judge "strict reading without warnings" "$here/kl_nowarn.sh" "$stem.gds"
judge "OASIS, strict reading without warnings" "$here/kl_nowarn.sh" "$stem.oas"
judge "OASIS equal to GDSII" klayout -b -r "$here/kl_xor.py" -rd "a=$stem.gds" -rd "b=$stem.oas"
judge "OASIS has the cells and instances of GDSII" klayout -b -r "$here/kl_cells.py" -rd "a=$stem.gds" -rd "b=$stem.oas"
areas=()
while read -r layer _ _ area; do
    [ "$area" = - ] || areas+=("$layer:$area")
done < <(/usr/bin/python3 "$here/layers.py" "$stem.gds" "masks/$flow.xml" "$stem.json")
[ "${#areas[@]}" -ge 4 ] || { echo "FAIL  areas of ${#areas[@]} layers"; failed=1; }
judge "gdspy reads it, ${#areas[@]} areas" /usr/bin/python3 "$here/gdspy_read.py" "$stem.gds" "${areas[@]}"
judge "arrays are the map, the plate keeps 4 um" klayout -b -r "$here/kl_wafer.py" -rd "gds=$stem.gds" -rd "csv=$stem.csv" \
    -rd "dies=${dies#,}" -rd rule=4
judge "DXF with blocks, arcs against GDSII" klayout -b -r "$here/kl_dxf.py" -rd "gds=$stem.gds" -rd "dxf=$stem.dxf" \
    -rd "lyt=$work/wafer/masks/$flow.lyt"
written=$work/wafer/masks/$flow-plate
judge "written plate: KLayout's booleans of the layered one" klayout -b -r "$here/kl_plate.py" -rd "a=$stem.gds" \
    -rd "b=$written.gds" -rd "expression=1/0 NOT 2/0 NOT 3/0" -rd layer=1/0 -rd mirror=1
judge "written plate: strict reading without warnings" "$here/kl_nowarn.sh" "$written.gds"
judge "written plate: OASIS equal to GDSII" klayout -b -r "$here/kl_xor.py" -rd "a=$written.gds" -rd "b=$written.oas"
judge "SVG and map are well-formed" xmllint --noout --huge "$stem.svg" "$stem-map.svg"
[ "$failed" -eq 0 ] && echo "WAFER PASS" || echo "WAFER FAIL"
exit "$failed"
