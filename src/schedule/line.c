/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/line.h"
#include <math.h>

static const double tiny_s = 1e-6;

/* one place: whatever overlaps must be over first, since nothing fits before it any more */
static double after_all(const fw_line *line, double t, double length) {
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < line->n; i++)
            if (line->start_s[i] < t + length - tiny_s && line->end_s[i] > t + tiny_s) {
                t = line->end_s[i];
                again = true;
            }
    }
    return t;
}

/* how many spans hold the moment x; *first_end is when the first of them ends */
static int holding(const fw_line *line, double x, double *first_end) {
    int n = 0;
    *first_end = (double)INFINITY;
    for (int i = 0; i < line->n; i++)
        if (line->start_s[i] <= x + tiny_s && line->end_s[i] > x + tiny_s) {
            *first_end = fmin(*first_end, line->end_s[i]);
            n++;
        }
    return n;
}

/* Earliest t' >= t with a place free from t' to t' + length. A moment x in [t, t + length) at which
   all places are taken forbids every start up to the first end of those that take them; only t and
   the starts of spans can be such moments. length 0 fits anywhere. Cost: n^2 at most.
   Test: test_schedule.c, line. */
double fw_line_fit(const fw_line *line, double t, double length) {
    double end;
    if (length <= 0.0) return t;
    if (line->places == 1) return after_all(line, t, length);
    for (bool again = true; again;) {
        again = holding(line, t, &end) >= line->places;
        for (int i = 0; i < line->n && !again; i++)
            again = line->start_s[i] > t && line->start_s[i] < t + length - tiny_s &&
                    holding(line, line->start_s[i], &end) >= line->places;
        if (again) t = end;
    }
    return t;
}

void fw_line_add(fw_line *line, double start, double end) {
    if (end <= start) return;
    line->start_s[line->n] = start;
    line->end_s[line->n++] = end;
}
