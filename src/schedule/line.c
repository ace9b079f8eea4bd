/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/line.h"
#include <math.h>
#include <string.h>

static const double tiny_s = 1e-6;

/* first span that starts at x or later */
static int starting(const fw_schedule_line *line, double x) {
    int low = 0, high = line->n;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (line->start_s[middle] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* one place: whatever overlaps must be over first, since nothing fits before it any more */
static double after_all(const fw_schedule_line *line, double t, double length) {
    for (int i = starting(line, t - line->longest_s); i < line->n; i++) {
        if (line->start_s[i] >= t + length - tiny_s) break;
        if (line->end_s[i] > t + tiny_s) t = line->end_s[i];
    }
    return t;
}

/* how many spans hold the moment x; *first_end is when the first of them ends */
static int holding(const fw_schedule_line *line, double x, double *first_end) {
    int n = 0;
    *first_end = (double)INFINITY;
    for (int i = starting(line, x - line->longest_s); i < line->n; i++) {
        if (line->start_s[i] > x + tiny_s) break;
        if (line->end_s[i] <= x + tiny_s) continue;
        *first_end = fmin(*first_end, line->end_s[i]);
        n++;
    }
    return n;
}

/* Earliest t' >= t with a place free from t' to t' + length. A moment x in [t, t + length) at which
   all places are taken forbids every start up to the first end of those that take them; only t and
   the starts of spans can be such moments. length 0 fits anywhere. Cost: the square
   of the spans near t.
   Test: test_schedule.c, line. */
double fw_schedule_line_fit(const fw_schedule_line *line, double t, double length) {
    double end;
    if (length <= 0.0) return t;
    if (line->places == 1) return after_all(line, t, length);
    for (bool again = true; again;) {
        again = holding(line, t, &end) >= line->places;
        for (int i = starting(line, t); i < line->n && !again; i++) {
            if (line->start_s[i] >= t + length - tiny_s) break;
            again = holding(line, line->start_s[i], &end) >= line->places;
        }
        if (again) t = end;
    }
    return t;
}

void fw_schedule_line_add(fw_schedule_line *line, double start, double end) {
    if (end <= start) return;
    int at = starting(line, start);
    size_t behind = (size_t)(line->n - at) * sizeof *line->start_s;
    memmove(&line->start_s[at + 1], &line->start_s[at], behind);
    memmove(&line->end_s[at + 1], &line->end_s[at], behind);
    line->start_s[at] = start;
    line->end_s[at] = end;
    line->longest_s = fmax(line->longest_s, end - start);
    line->n++;
}

void fw_schedule_line_remove(fw_schedule_line *line, double start, double end) {
    if (end <= start) return;
    int at = starting(line, start);
    while (at < line->n && line->end_s[at] != end)
        at++;
    if (at == line->n) return; /* it was never added */
    size_t behind = (size_t)(--line->n - at) * sizeof *line->start_s;
    memmove(&line->start_s[at], &line->start_s[at + 1], behind);
    memmove(&line->end_s[at], &line->end_s[at + 1], behind);
}
