# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: the one tree of clang under AddressSanitizer and UndefinedBehaviorSanitizer, for all tests that want it; the rooms
# that read files carry the fuzzer's counters, too. sanitized_build TARGET
sanitized_build() {
    configure_and_build build-asan -DCMAKE_C_COMPILER=clang -DFW_SANITIZE=ON -DFW_FUZZ=ON -DFW_TESTS=ON -DFW_PAGE=OFF \
        -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="-g1 -O1" --target "$1"
}
