#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# gallery.sh PROGRAM [--update]: the committed masks, recipes, drawings, verdicts and ledgers of effects
# of the gallery are what the program makes today, byte for byte (verdicts: the words and the percentages
# that it prints; ledgers: the table of simulate for every scene).
set -eu
# FW_GALLERY_PLANS: where tests/golden/plans.sh has left them. FW_GALLERY_ONLY: one device by its name.
program=$1
update=${2:-}
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
plans=${FW_GALLERY_PLANS:-}
[ -n "$plans" ] || {
    plans=$work/plans
    tests/golden/plans.sh "$program" "$plans"
}
status=0
keep() { # keep NEW COMMITTED
    if [ -n "$update" ]; then
        mkdir -p "$(dirname "$2")"
        cp "$1" "$2"
    elif ! cmp -s "$1" "$2"; then
        echo "$2 is not what the program makes: tests/golden/gallery.sh PROGRAM --update, and look"
        status=1
    fi
}
for device in docs/gallery/${FW_GALLERY_ONLY:-*}/device.xml; do
    name=$(basename "$(dirname "$device")")
    sed '/^results:/d' "$plans/$name.said" >"$work/$name.txt"
    keep "$work/$name.txt" "docs/gallery/$name/verdict.txt"
    keep "$plans/$name/device.svg" "docs/gallery/$name/device.svg"
    sed -n 's/.*<scene name="\([^"]*\)".*/\1/p' "$device" | while read -r scene; do
        echo "scene $scene"
        # the ledger is of scene and model: the tolerance that the last digits of forces take changes nothing in it
        "$program" simulate "$device" --scene "$scene" --rtol 1e-7 2>/dev/null | sed -n '/^  effect  /,$p'
    done >"$work/$name.ledger"
    keep "$work/$name.ledger" "docs/gallery/$name/ledger.txt"
    for file in "$plans/$name"/masks/*.gds "$plans/$name"/masks/*.svg "$plans/$name"/masks/*.lyp "$plans/$name"/masks/*.lyt; do
        case $file in # test dies differ by the die's size and the flow alone: those of one device
        */reference-six-bar/*) ;;
        *-coupons.*) continue ;;
        esac
        [ -f "$file" ] && keep "$file" "masks/gallery/$name/$(basename "$file")"
    done
    for file in "$plans/$name"/recipes/*.html "$plans/$name"/recipes/*.csv "$plans/$name"/recipes/*.sections.svg \
        "$plans/$name"/recipes/*.stack.svg; do
        [ -f "$file" ] && keep "$file" "recipes/gallery/$name/$(basename "$file")"
    done
done
exit $status
