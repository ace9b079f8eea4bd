#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Masks of every gallery device, as the program writes them, against KLayout, gdspy and GEOS.
# FW_GALLERY_PLANS: where tests/golden/plans.sh has left them.
set -eu
program=$1
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
plans=${FW_GALLERY_PLANS:-}
[ -n "$plans" ] || {
    plans=$work/plans
    tests/golden/plans.sh "$program" "$plans"
}
for device in docs/gallery/*/device.xml; do
    name=$(basename "$(dirname "$device")")
    status=$(cat "$plans/$name.status")
    if [ "$status" -eq 1 ] && [ "$name" = copper-nodder ] && [ ! -e "$plans/$name/masks" ]; then
        continue # rejected, on purpose: it has no masks
    fi
    [ "$status" -eq 0 ] || exit "$status"
    mkdir "$work/$name"
    cp -r "$plans/$name/masks" "$work/$name"
    set -- "$@" "$work/$name/masks"
    case $name in # test dies differ by the die's size alone
    reference-six-bar | leaf-four-bar) ;;
    *) rm -f "$work/$name"/masks/*-coupons.* ;;
    esac
done
shift
tests/accept/judge.py "$@"
# one by one, as people have it, with pictures: one flow, ./test --all both, which judge.py above has judged by the same scripts
rm -f "$work"/reference-six-bar/masks/*-coupons.*
[ -n "${FW_TEST_ALL:-}" ] || rm -f "$work"/reference-six-bar/masks/copper-on-porous-silicon.*
tests/accept/run.sh "$work/reference-six-bar/masks"
# cut for readers that take 199 vertices: the same polygons, whose widths and spaces judge.py above has seen; ./test --all: those of
# the cut files, too. One die: its wafer repeats the same cells 499 times (accept.wafer looks at plates)
sed '/<wafer /d' docs/gallery/comb-stage/device.xml >"$work/one.xml"
"$program" mask "$work/one.xml" -o "$work/one" -q
"$program" mask "$work/one.xml" --mask-vertices 199 -o "$work/cut" -q
rm -f "$work"/cut/masks/*-coupons.*
if [ -n "${FW_TEST_ALL:-}" ]; then
    tests/accept/run.sh "$work/cut/masks" "$work/one/masks"
    exit
fi
for gds in "$work"/cut/masks/*.gds; do
    printf '%s\t' "${gds##*/}, strict reading without warnings" kl_nowarn.sh >>"$work/jobs"
    printf 'f=%s\n' "$gds" >>"$work/jobs"
    printf '%s\t' "${gds##*/}, the same polygons" kl_xor.py "a=$gds" >>"$work/jobs"
    printf 'b=%s\n' "$work/one/masks/${gds##*/}" >>"$work/jobs"
done
/usr/bin/python3 tests/accept/kl_asked.py "$work/jobs" "$work/answers"
cat "$work/answers"
! grep -q ^FAIL "$work/answers"
