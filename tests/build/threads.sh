#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Designs in two threads under ThreadSanitizer: it reports every access to memory that two threads
# share without an order between them. Some twenty times slower: fewer moments of cancelling.
set -eu
cd "$(dirname "$0")/../.."
. tools/setup.sh
configure_and_build build-threads -DCMAKE_C_COMPILER=clang -DFW_TESTS=ON -DFW_PAGE=OFF -DFW_TOGETHER=ON -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_C_FLAGS_DEBUG="-g1 -O0" -DCMAKE_C_FLAGS=-fsanitize=thread --target cancel_threads
FW_CANCEL_MOMENTS=1 TSAN_OPTIONS="halt_on_error=1 second_deadlock_stack=1" build-threads/tests/cancel_threads
