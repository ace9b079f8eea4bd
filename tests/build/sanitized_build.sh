# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: the one tree of clang under AddressSanitizer and UndefinedBehaviorSanitizer, for all tests that want it; the rooms
# that read files carry the fuzzer's counters, the others one for each function. sanitized_build TARGET [cmake option]
sanitized_build() {
    configure_and_build build-asan -DCMAKE_C_COMPILER=clang -DFW_SANITIZE=ON -DFW_FUZZ=ON -DFW_TESTS=ON -DFW_PAGE=OFF \
        -DFW_EDGES=func -DFW_TOGETHER=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="-g1 -O1" \
        ${2:+"$2"} --target "$1"
}

# What both builds find of numbers the other one found: left out are tests of motion that take seconds and reach no branch
# that others do not, but for 38 of 42875. Hard tests alone reach 119, one of them 73. What reads sources and pages runs nothing
# of ours; what recomputes pages asks `check`, `modes` and `simulate`, which the gallery does here, too. Turns are dealt out among all
# tests of the other build, of which this one has a part.
sanitized_never='^(arch|gate|judge|library)|^build.labels|^docs.(accuracy|effects|gallery_solids|masks|names|pages|theory)|dynamics.test_(trust|method_motions|envelope|peak|element_motion|hinge_bounds)|test_cancel_threads|hard_(flat|impacts|redundant)'
