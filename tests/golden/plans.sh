#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# plans.sh PROGRAM DIRECTORY: `plan` of every gallery device with masks of all formats, once for all tests that look at what it
# gives: DIRECTORY/NAME is the results, NAME.said what it printed, NAME.status how it ended. The same input gives the same bytes.
set -eu
program=$1
to=$2
cd "$(dirname "$0")/../.."
rm -rf "$to"
mkdir -p "$to"
for device in docs/gallery/${FW_GALLERY_ONLY:-*}/device.xml; do
    name=$(basename "$(dirname "$device")")
    status=0
    "$program" plan "$device" --mask-format all -o "$to/$name" >"$to/$name.said" 2>"$to/$name.err" || status=$?
    echo "$status" >"$to/$name.status"
    [ "$status" -le 1 ] || {
        cat "$to/$name.err"
        exit 1
    }
done
