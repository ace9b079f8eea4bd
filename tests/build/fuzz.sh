#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A short run of every fuzz harness, from the gallery and the broken files, under ASan and UBSan.
# RUNS=1000000 tests/build/fuzz.sh for a long one; 40000 runs, with FW_TEST_ALL=1 (./test --all) 100000. LIVE_RUNS=3000: the functions behind the page, too, whose
# harness needs all rooms; test_live_hostile has a short run of the same. FILES_RUNS=1000000: every file that is read, by the
# tables of its rows, and JUDGE_RUNS=10000: through judging, masks and recipes; fuzz.files and fuzz.judge have short runs of these
# without the sanitizers. BODIES_RUNS=100000: what a page sends to each row of the server's table; fuzz.bodies has a short run. tests/build/coverage.py --run says what each reaches.
set -eu
cd "$(dirname "$0")/../.."
. tools/setup.sh
. tests/build/sanitized_build.sh
sanitized_build fuzz_device
[ -z "${LIVE_RUNS:-}" ] || sanitized_build fuzz_live
if [ -n "${FILES_RUNS:-}${JUDGE_RUNS:-}" ]; then
    sanitized_build fuzz_files
    sanitized_build fuzz_judge
    sanitized_build fuzzed_files
fi
corpus=$(mktemp -d)
trap 'rm -rf "$corpus"' EXIT
mkdir "$corpus/device" "$corpus/live"
cp tests/bad/*.xml "$corpus/device"
for file in docs/gallery/*/device.xml; do # all of one name
    cp "$file" "$corpus/device/$(basename "$(dirname "$file")").xml"
done
# a byte that chooses the function, then a small mechanism or a whole request
for file in docs/mechanisms/*.xml tests/data/effect-costs/free.xml; do
    for which in 200 201 202 203; do
        { printf "\\$which"; cat "$file"; } >"$corpus/live/$which-$(basename "$file")"
    done
done
for which in 0 1 2; do
    printf "\\$which"'{"text":"<device xmlns=\"urn:flexwright:device:1\" name=\"d\"/>","set":{"a":"1 um"},"options":{"samples":3},
"platform":{"x_m":1e-6,"phi_rad":0},"q":[1,2,3],"body":"b","flow":"f","changes":[{"path":"device/@name","value":"e"}]}' \
        >"$corpus/live/request-$which"
done
run() { # HARNESS RUNS
    log=$corpus/log
    status=0
    build-asan/tests/fuzz/fuzz_$1 -runs="$2" -timeout=20 -rss_limit_mb=1024 \
        -dict=tests/fuzz/device.dict -print_final_stats=1 "$corpus/$1" >"$log" 2>&1 || status=$?
    tail -12 "$log"
    return $status
}
run device "${RUNS:-$([ -n "${FW_TEST_ALL:-}" ] && echo 100000 || echo 40000)}"
[ -z "${LIVE_RUNS:-}" ] || run live "$LIVE_RUNS"
if [ -n "${BODIES_RUNS:-}" ]; then
    sanitized_build fuzz_bodies
    mkdir "$corpus/bodies"
    cp tests/fuzz/seeds/body-* "$corpus/bodies"
    run bodies "$BODIES_RUNS"
fi
[ -n "${FILES_RUNS:-}${JUDGE_RUNS:-}" ] || exit 0
mkdir "$corpus/files" "$corpus/judge"
build-asan/tests/fuzz/fuzzed_files corpus "$corpus/files"
for file in docs/gallery/*/device.xml tests/data/effects/*.xml; do
    for how in 0 3 4; do # other analyses, two methods, judging to the end
        { printf "\\$how"; cat "$file"; } >"$corpus/judge/$how-$(echo "$file" | tr / -)"
    done
done
[ -z "${FILES_RUNS:-}" ] || run files "$FILES_RUNS"
[ -z "${JUDGE_RUNS:-}" ] || run judge "$JUDGE_RUNS"
