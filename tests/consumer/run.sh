#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh BUILD PROGRAM: installs the build into a temporary prefix and builds consumer.c against that
# tree alone, by pkg-config (C99, C17, C++17) and by find_package. Each must decide and write what the
# program does, byte for byte. Then with the header of a former version against the present library, and
# the small users of numbers in C and C++.
set -eu
build=$(cd "$1" && pwd)
program=$(readlink -f "$2")
here=$(cd "$(dirname "$0")" && pwd)
device=$here/../../docs/gallery/reference-six-bar/device.xml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix" # nothing in the tree may remember where it was installed
pc=$(find "$work/prefix" -name flexwright.pc)
lib=$(dirname "$(dirname "$pc")")
export PKG_CONFIG_PATH="${pc%/*}" LD_LIBRARY_PATH="$lib"
data=$(pkg-config --variable=datadir flexwright)
cp "$here/consumer.c" "$work/" # away from the sources: only the installed header is found
cd "$work"
cp "$device" device.xml
"$program" plan device.xml -o want -q >/dev/null 2>&1

strict="-Wall -Wextra -Wconversion -Wshadow -pedantic -Werror"
try() { # try NAME PROGRAM
    status=0
    "$2" device.xml "out-$1" "$data" >"$1.txt" 2>"$1.err" || status=$?
    if [ $status -ne 0 ] || ! grep -q '^flexwright .*: decision 0$' "$1.txt"; then
        echo "$1: status $status"
        cat "$1.txt" "$1.err"
        exit 1
    fi
    diff -r -q want "out-$1" || exit 1
    echo "$1: $(head -1 "$1.txt")"
}
# shellcheck disable=SC2046,SC2086
{
    cc -std=c99 $strict consumer.c -o c99 $(pkg-config --cflags --libs flexwright)
    cc -std=c17 $strict consumer.c -o c17 $(pkg-config --cflags --libs flexwright)
    cc -std=c17 $strict consumer.c -o alone $(pkg-config --cflags --libs flexwright) -Wl,-rpath,$(pkg-config --variable=libdir flexwright)
    c++ -std=c++17 $strict -x c++ consumer.c -x none -o cxx $(pkg-config --cflags --libs flexwright)
}
try pkg-config-c99 ./c99
try pkg-config-c17 ./c17
try pkg-config-c++17 ./cxx
unset LD_LIBRARY_PATH # as docs/c-api.md has it
try pkg-config-rpath ./alone
export LD_LIBRARY_PATH="$lib"
mkdir found
cp "$here/CMakeLists.txt" consumer.c found/
cmake -S found -B found/build -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build found/build >/dev/null
try find_package found/build/consumer

# a program that was compiled before: its options are shorter, and nothing else has changed
for former in flexwright with-arrays; do # the first state, and the one that added arrays, progress and cancelling
    "$here/abi.py" "$here/former/$former.h" "$here/../../include/flexwright.h"
done
# shellcheck disable=SC2046,SC2086
cc -std=c17 $strict -I"$here/former" consumer.c -o former -L"$lib" -lflexwright
try former ./former

# numbers: what the program's JSON says
"$program" check device.xml --json >verdict.json 2>/dev/null
"$program" simulate device.xml --json >motion.json 2>/dev/null
cp "$here/numbers.c" "$here/motion.cpp" .
# shellcheck disable=SC2046,SC2086
{
    cc -std=c99 $strict numbers.c -o numbers $(pkg-config --cflags --libs flexwright)
    c++ -std=c++17 $strict -x c++ numbers.c -x none -o numbers-cxx $(pkg-config --cflags --libs flexwright)
    c++ -std=c++17 $strict motion.cpp -o motion $(pkg-config --cflags --libs flexwright)
}
./numbers device.xml >numbers.txt # with the packs of the library's own tree
./numbers-cxx device.xml "$data" >numbers-cxx.txt
cmp numbers.txt numbers-cxx.txt
"$program" simulate device.xml --set 'arc=230 deg' --json >motion-230.json 2>/dev/null
./motion device.xml "$data" >motion.txt
python3 - <<'END'
import json, re
lines = open("numbers.txt").read().splitlines()
for h in json.load(open("verdict.json"))["hinges"]:
    want = (f"hinge {h['id']}: {100 * h['utilisation']:.1f} % as drawn, "
            f"{100 * h['as_fabricated']['utilisation']:.1f} % as made")
    assert want in lines, (want, lines)
x, y, phi = json.load(open("motion.json"))["final"]["q"]["CD"]
assert f"CD at 10 ms: x {1e6 * x:.3f} um, y {1e6 * y:.3f} um, phi {phi:.5f} rad (m,m,rad)" in lines, lines
assert "told of progress: yes" in lines
seen = dict(re.findall(r"hinge (\w+): (\S+) rad", open("motion.txt").read()))
for p in json.load(open("motion-230.json"))["peaks"]:
    assert abs(float(seen[p["hinge"]]) - abs(p["angle_rad"])) < 2e-3 * abs(p["angle_rad"]), (p, seen)
END
echo "numbers: $(head -1 numbers.txt)"
