/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

/* Buckets of equal length, of each the least and the greatest sample in order of time: what a plot
   of that many pixels would show, with every peak in its place. in: y (count, step `stride`), most
   >= 4; out: index (most). Returns how many. Cost O(count). Proved by
   tests/unit/report/test_report_plot.c. */
int fw_report_decimate(const double *y, int stride, int count, int most, int *index) {
    if (count <= most || most < 4) {
        int n = count < most ? count : most;
        for (int i = 0; i < n; i++)
            index[i] = i;
        return n;
    }
    int buckets = (most - 2) / 2, n = 0;
    index[n++] = 0;
    for (int b = 0; b < buckets; b++) {
        int from = 1 + (int)((long long)(count - 2) * b / buckets);
        int to = 1 + (int)((long long)(count - 2) * (b + 1) / buckets);
        int least = from, greatest = from;
        for (int i = from; i < to; i++) {
            least = y[(size_t)i * (size_t)stride] < y[(size_t)least * (size_t)stride] ? i : least;
            greatest =
                y[(size_t)i * (size_t)stride] > y[(size_t)greatest * (size_t)stride] ? i : greatest;
        }
        index[n++] = least < greatest ? least : greatest;
        if (least != greatest) index[n++] = least < greatest ? greatest : least;
    }
    index[n++] = count - 1;
    return n;
}
