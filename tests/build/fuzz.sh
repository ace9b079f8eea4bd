#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A short run of every fuzz harness, from the gallery and the broken files, under ASan and UBSan.
# RUNS=1000000 tests/build/fuzz.sh for a long one.
set -eu
cd "$(dirname "$0")/../.."
cmake -S . -B build-fuzz -G Ninja -DCMAKE_C_COMPILER=clang -DFW_FUZZ=ON -DFW_SANITIZE=ON >/dev/null
cmake --build build-fuzz --target fuzz_device >/dev/null
corpus=$(mktemp -d)
trap 'rm -rf "$corpus"' EXIT
cp docs/gallery/*/device.xml tests/bad/*.xml "$corpus" 2>/dev/null || true
log=$corpus.log
status=0
build-fuzz/tests/fuzz/fuzz_device -runs="${RUNS:-100000}" -timeout=5 -rss_limit_mb=1024 \
    -dict=tests/fuzz/device.dict -print_final_stats=1 "$corpus" >"$log" 2>&1 || status=$?
tail -12 "$log"
rm -f "$log"
exit $status
