/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders for qsort: one comparison of numbers, from which the comparators of rows are made, key by
   key, and the sort of plain numbers. The last key of a row should tell equal rows apart: qsort
   keeps no order among rows that compare as equal. Test: test_sort.c */
#ifndef FW_BASE_SORT_H
#define FW_BASE_SORT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

/* -1, 0, 1: a before, beside, after b. Numbers have to be numbers: a NaN is beside everything */
static inline int fw_order_doubles(double a, double b) {
    return (a > b) - (a < b);
}
static inline int fw_order_wholes(long long a, long long b) {
    return (a > b) - (a < b);
}

/* of two doubles, for qsort */
static inline int fw_compare_doubles(const void *a, const void *b) {
    return fw_order_doubles(*(const double *)a, *(const double *)b);
}

/* ascending; n may be 0, and list then NULL */
static inline void fw_sort_doubles(double *list, size_t n) {
    if (n > 1) qsort(list, n, sizeof *list, fw_compare_doubles);
}

/* a is above b, and not by rounding alone: of what is equal, mirrored hinges say, the first one is the largest on
   every machine */
static inline bool fw_above_rounding(double a, double b) {
    return a > (1 + 1e-6) * b;
}
#endif
