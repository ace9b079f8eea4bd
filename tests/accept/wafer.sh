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
    inverted) more="-rd mirror=0 -rd field=$(/usr/bin/python3 -c "print($size - 8)")" ;;
    scaled) more="-rd mirror=1 -rd scale=1.0002 -rd tol=40" ;;
    both) more="-rd mirror=1 -rd scale=0.9997 -rd tol=40 -rd field=$(/usr/bin/python3 -c "print($size - 8)")" ;;
    esac
    judge "written plate, $name: KLayout's booleans" klayout -b -r "$here/kl_plate.py" -rd "a=$work/$name/masks/$flow-wafer.gds" \
        -rd "b=$work/$name/masks/$flow-plate.gds" -rd "expression=1/0 NOT 2/0 NOT 3/0" -rd layer=1/0 $more
    judge "written plate, $name: strict reading without warnings" "$here/kl_nowarn.sh" "$work/$name/masks/$flow-plate.gds"
done
# a flow of three plates, and its plates of one die
comb=docs/gallery/comb-stage/device.xml glass=silicon-on-glass
sed '/<wafer /d; s|<die tethers="no"/>|&<wafer diameter="32 mm" flat="10 mm" alignment="2 sites" test-dies="1"/><order plate="cavity" quantity="2"/>|' "$comb" >"$work/three.xml"
sed '/<wafer /d; s|<die tethers="no"/>|&<order scale="5"/><order plate="pads" tone="inverted" mirror="no" scale="1"/>|' "$comb" >"$work/one.xml"
for name in three one; do
    "$program" mask "$work/$name.xml" -q -o "$work/$name" --corners none --mask-format all >"$work/out" 2>&1 || { cat "$work/out"; failed=1; }
    while read -r plate layer expression; do
        written=$work/$name/masks/$glass-plate.$plate
        more="-rd mirror=1" layered=$work/three/masks/$glass-wafer.gds
        [ "$name" = one ] && layered=$work/one/masks/$glass.gds more="-rd mirror=1 -rd scale=5 -rd die=1"
        [ "$name$plate" = onepads ] && more="-rd die=1 -rd field=1"
        judge "$name: written plate of $plate: KLayout's booleans" klayout -b -r "$here/kl_plate.py" -rd "a=$layered" -rd "b=$written.gds" \
            -rd "expression=$expression" -rd "layer=$layer" $more
        judge "$name: $plate: strict reading without warnings" "$here/kl_nowarn.sh" "$written.gds"
        judge "$name: $plate: OASIS equal to GDSII" klayout -b -r "$here/kl_xor.py" -rd "a=$written.gds" -rd "b=$written.oas"
        judge "$name: $plate: order sheet is JSON" /usr/bin/python3 -m json.tool "$written.order.json"
    done <<'END'
cavity 6/0 6/0 NOT 7/0 OR 5/0
pads 8/0 8/0
device 1/0 1/0 NOT 2/0 NOT 3/0
END
done
judge "SVG and map are well-formed" xmllint --noout --huge "$stem.svg" "$stem-map.svg"
[ "$failed" -eq 0 ] && echo "WAFER PASS" || echo "WAFER FAIL"
exit "$failed"
