/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cmocka in the order in which it wants its own headers included, and comparisons of doubles that
   print both numbers. */
#ifndef FW_TEST_H
#define FW_TEST_H
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* How much of something repeated is done: all of it, or its first part where FW_TEST_QUICK is set.
   What asks here is registered twice (tests/CMakeLists.txt): the quick run does the part, the whole
   one everything. */
static inline int test_cases(int whole, int quick) {
    return getenv("FW_TEST_QUICK") ? quick : whole;
}

/* Under the sanitizers (tests/build/sanitized.sh sets FW_TEST_FEWEST) what is repeated over the same
   lines is done some ten times slower to pass the same edges: as few as pass them all. */
static inline int test_fewest(int cases, int fewest) {
    return getenv("FW_TEST_FEWEST") ? fewest : cases;
}

/* |got - want| <= tol, absolute */
#define assert_near(got, want, tol)                                                                \
    do {                                                                                           \
        double got_ = (got), want_ = (want), tol_ = (tol);                                         \
        if (!(fabs(got_ - want_) <= tol_))                                                         \
            fail_msg("%s = %.17g, expected %.17g +- %.3g (off by %.3g)", #got, got_, want_, tol_,  \
                     got_ - want_);                                                                \
    } while (0)

/* |got / want - 1| <= tol */
#define assert_relative(got, want, tol) assert_near((got), (want), fabs((double)(want)) * (tol))
#endif
