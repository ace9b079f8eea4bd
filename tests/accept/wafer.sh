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
: >"$work/jobs" # what KLayout is asked, all in one run of it at the end: its start takes longer than most of the questions
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
klayout_judges() { # klayout_judges NAME SCRIPT [NAME=VALUE]...
    local IFS=$'\t'
    echo "$*" >>"$work/jobs"
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
klayout_judges "strict reading without warnings" kl_nowarn.sh "f=$stem.gds"
klayout_judges "OASIS, strict reading without warnings" kl_nowarn.sh "f=$stem.oas"
klayout_judges "OASIS equal to GDSII" kl_xor.py "a=$stem.gds" "b=$stem.oas"
klayout_judges "OASIS has the cells and instances of GDSII" kl_cells.py "a=$stem.gds" "b=$stem.oas"
areas=()
while read -r layer _ _ area; do
    [ "$area" = - ] || areas+=("$layer:$area")
done < <(/usr/bin/python3 "$here/layers.py" "$stem.gds" "masks/$flow.xml" "$stem.json")
[ "${#areas[@]}" -ge 4 ] || { echo "FAIL  areas of ${#areas[@]} layers"; failed=1; }
judge "gdspy reads it, ${#areas[@]} areas" /usr/bin/python3 "$here/gdspy_read.py" "$stem.gds" "${areas[@]}"
klayout_judges "arrays are the map, the plate keeps 4 um" kl_wafer.py "gds=$stem.gds" "csv=$stem.csv" \
    "dies=${dies#,}" rule=4
klayout_judges "DXF with blocks, arcs against GDSII" kl_dxf.py "gds=$stem.gds" "dxf=$stem.dxf" \
    "lyt=$work/wafer/masks/$flow.lyt"
written=$work/wafer/masks/$flow-plate
klayout_judges "written plate: KLayout's booleans of the layered one" kl_plate.py "a=$stem.gds" \
    "b=$written.gds" "expression=1/0 NOT 2/0 NOT 3/0" layer=1/0 mirror=1
klayout_judges "written plate: strict reading without warnings" kl_nowarn.sh "f=$written.gds"
klayout_judges "written plate: OASIS equal to GDSII" kl_xor.py "a=$written.gds" "b=$written.oas"
# the same plate as another one is ordered: every <order> against KLayout's booleans of the layered file
order() { # order NAME DEVICE ELEMENT: the device with the element in its <wafer>
    sed "s|</wafer>|$3</wafer>|" "$2" >"$work/$1.xml"
}
order inverted "$device" '<order tone="inverted" mirror="no"/>'
order scaled "$device" '<order scale="1.0002" barcode="A-7" flat-line="yes"/>'
order both "$device" '<order scale="0.9997" tone="inverted"/>'
for name in inverted scaled both; do
    # the steps of the sweep are looked at above; one device is on all places here
    sed -i '/<sweep/d' "$work/$name.xml"
    "$program" mask "$work/$name.xml" -q -o "$work/$name" --corners none "$@" >"$work/out" 2>&1 || { cat "$work/out"; failed=1; }
    size=$(sed -n 's/.*"size_mm": \([0-9.]*\).*/\1/p' "$work/$name/masks/$flow-plate.order.json")
    case $name in
    inverted) more="mirror=0 field=$(/usr/bin/python3 -c "print($size - 8)")" ;;
    scaled) more="mirror=1 scale=1.0002 tol=40" ;;
    both) more="mirror=1 scale=0.9997 tol=40 field=$(/usr/bin/python3 -c "print($size - 8)")" ;;
    esac
    klayout_judges "written plate, $name: KLayout's booleans" kl_plate.py "a=$work/$name/masks/$flow-wafer.gds" \
        "b=$work/$name/masks/$flow-plate.gds" "expression=1/0 NOT 2/0 NOT 3/0" layer=1/0 $more
    klayout_judges "written plate, $name: strict reading without warnings" kl_nowarn.sh "f=$work/$name/masks/$flow-plate.gds"
done
# a flow of three plates, and its plates of one die
comb=docs/gallery/comb-stage/device.xml glass=silicon-on-glass
sed '/<wafer /d; /<order /d; s|<die tethers="no"/>|&<wafer diameter="32 mm" flat="10 mm" alignment="2 sites" test-dies="1"/><order plate="cavity" quantity="2"/>|' "$comb" >"$work/three.xml"
sed '/<wafer /d; /<order /d; s|<die tethers="no"/>|&<order scale="5"/><order plate="pads" tone="inverted" mirror="no" scale="1"/>|' "$comb" >"$work/one.xml"
for name in three one; do
    "$program" mask "$work/$name.xml" -q -o "$work/$name" --corners none --mask-format all >"$work/out" 2>&1 || { cat "$work/out"; failed=1; }
    while read -r plate layer expression; do
        written=$work/$name/masks/$glass-plate.$plate
        more="mirror=1" layered=$work/three/masks/$glass-wafer.gds
        [ "$name" = one ] && layered=$work/one/masks/$glass.gds more="mirror=1 scale=5 die=1"
        [ "$name$plate" = onepads ] && more="die=1 field=1"
        klayout_judges "$name: written plate of $plate: KLayout's booleans" kl_plate.py "a=$layered" "b=$written.gds" \
            "expression=$expression" "layer=$layer" $more
        klayout_judges "$name: $plate: strict reading without warnings" kl_nowarn.sh "f=$written.gds"
        klayout_judges "$name: $plate: OASIS equal to GDSII" kl_xor.py "a=$written.gds" "b=$written.oas"
        judge "$name: $plate: order sheet is JSON" /usr/bin/python3 -m json.tool "$written.order.json"
    done <<'END'
cavity 6/0 6/0 NOT 7/0 OR 5/0
pads 8/0 8/0
device 1/0 1/0 NOT 2/0 NOT 3/0
END
done
judge "KLayout was asked" /usr/bin/python3 "$here/kl_asked.py" "$work/jobs" "$work/answers"
cat "$work/answers"
! grep -q ^FAIL "$work/answers" || failed=1
judge "SVG and map are well-formed" xmllint --noout --huge "$stem.svg" "$stem-map.svg"
[ "$failed" -eq 0 ] && echo "WAFER PASS" || echo "WAFER FAIL"
exit "$failed"
