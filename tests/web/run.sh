#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh PROGRAM BUILD-DIRECTORY [SCRIPT]: the tests of the page in headless Chromium, or one file of them, or another script of
# this directory. Exit status 77: there is no Chromium or
# no npm on this machine. The libraries are fetched once for each lock file.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "$1")
place=$(realpath "$2")/web-tests
# the shell is Chromium without its windows: the same engine, a fifth less of processor; FW_CHROMIUM=/usr/bin/chromium is the whole
chromium=${FW_CHROMIUM:-$(command -v chromium-headless-shell || command -v chromium || command -v chromium-browser || true)}
[ -n "$chromium" ] || { echo "no chromium"; exit 77; }
command -v npm >/dev/null || { echo "no npm"; exit 77; }
node=$(command -v node || command -v nodejs)
mkdir -p "$place"
if ! cmp -s "$here/package-lock.json" "$place/done.json"; then
    cp "$here/package.json" "$here/package-lock.json" "$place"
    (cd "$place" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
    cp "$here/package-lock.json" "$place/done.json"
fi
export FW_PROGRAM="$program" FW_SOURCE="${here%/tests/web}" FW_WEB_LIBRARIES="$place" FW_CHROMIUM="$chromium"
export FLEXWRIGHT_DATA="$FW_SOURCE"
case "${3:-every.test.mjs}" in
*.test.mjs) exec "$node" --test "$here/${3:-every.test.mjs}" ;;
*) exec "$node" "$here/$3" ;;
esac
