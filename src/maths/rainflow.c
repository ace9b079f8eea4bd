/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/functions.h"
#include <math.h>

static void push(fw_maths_turning *t, fw_arena *arena, double value) {
    if (t->count == t->room) {
        size_t room = t->room ? 2 * t->room : 64;
        double *more = fw_arena_grow(arena, t->value, t->count, room, sizeof *more);
        if (!more) {
            t->failed = true;
            return;
        }
        t->value = more;
        t->room = room;
    }
    t->value[t->count++] = value;
}

/* a turn is one when the history has come back by more than the gate */
static void follow(fw_maths_turning *t, fw_arena *arena, double value) {
    if (t->count == 0) {
        push(t, arena, value);
        t->latest = value;
    } else if (t->direction == 0) {
        if (fabs(value - t->latest) > t->gate) {
            t->direction = value > t->latest ? 1 : -1;
            t->latest = value;
        }
    } else if ((value - t->latest) * t->direction >= 0)
        t->latest = value;
    else if (fabs(value - t->latest) > t->gate) {
        push(t, arena, t->latest);
        t->direction = -t->direction;
        t->latest = value;
    }
}

/* extreme of the parabola through three samples, where the middle one is the outermost */
static bool vertex(const fw_maths_turning *p, double t, double s, double *value) {
    double a = p->t[1] - p->t[0], b = t - p->t[1], up = p->s[1] - p->s[0], down = s - p->s[1];
    if (!(a > 0) || !(b > 0) || !(up * down < 0)) return false;
    double slope = (up * b / a + down * a / b) / (a + b);
    double bend = 2 * (down / b - up / a) / (a + b);
    *value = p->s[1] - slope * slope / (2 * bend);
    return true;
}

/* One more sample. in: times s, values of any unit; out: t->value; error of a turning point
   O(spacing^3), turns below the gate are lost. Test: test_rainflow.c turning_points_of_a_sine */
void fw_maths_turning_add(fw_maths_turning *p, fw_arena *arena, double t, double s) {
    double top;
    if (p->samples >= 2 && vertex(p, t, s, &top)) follow(p, arena, top);
    follow(p, arena, s);
    p->t[0] = p->t[1];
    p->s[0] = p->s[1];
    p->t[1] = t;
    p->s[1] = s;
    p->samples++;
}

void fw_maths_turning_jump(fw_maths_turning *p) {
    p->samples = 0;
}

void fw_maths_turning_end(fw_maths_turning *p, fw_arena *arena) {
    if (p->direction != 0) push(p, arena, p->latest);
    p->direction = 0;
}

/* Rainflow counting, ASTM E1049 5.4.4: X the range of the last two turning points on the stack, Y
   that of the two before. X >= Y: Y is a cycle, or half a one where it begins the history. What
   stays at the end are half cycles.
   in: turn (n), in turn peaks and valleys; out: cycles; exact; cost O(n)
   source: ASTM E1049-85 (2017), the algorithm is described there; test_rainflow.c astm_example */
size_t fw_maths_rainflow(const double *turn, size_t n, double *work, fw_maths_cycle *cycle) {
    size_t top = 0, cycles = 0; /* work[0..top-1] is the stack */
    for (size_t i = 0; i < n; i++) {
        work[top++] = turn[i];
        while (top >= 3) {
            double a = work[top - 3], b = work[top - 2], c = work[top - 1];
            if (fabs(c - b) < fabs(b - a)) break;
            cycle[cycles++] = (fw_maths_cycle){fabs(b - a), 0.5 * (a + b), top == 3 ? 0.5 : 1.0};
            if (top == 3) {
                work[0] = b;
                work[1] = c;
                top = 2;
            } else {
                work[top - 3] = c;
                top -= 2;
            }
        }
    }
    for (size_t i = 0; i + 1 < top; i++)
        cycle[cycles++] =
            (fw_maths_cycle){fabs(work[i + 1] - work[i]), 0.5 * (work[i + 1] + work[i]), 0.5};
    return cycles;
}

/* ASTM E1049 5.4.5: a history that is repeated is cut where it is farthest out, so that only whole
   cycles are left, and closed there. Where its end is no turning point (end and beginning rise, or
   fall, into each other) it is left out.
   Test: test_rainflow.c astm_example_repeating */
size_t fw_maths_rainflow_repeating(const double *turn, size_t n, double *work,
                                   fw_maths_cycle *cycle) {
    size_t from = 0, m = 0;
    if (n < 2) return 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(turn[i]) > fabs(turn[from])) from = i;
    for (size_t i = 0; i <= n; i++) {
        double v = turn[(from + i) % n];
        while (m >= 1 && v == work[m - 1])
            m--;
        while (m >= 2 && (work[m - 1] - work[m - 2]) * (v - work[m - 1]) > 0)
            m--; /* on the way, no turn */
        work[m++] = v;
    }
    /* the stack of the plain count grows behind what it reads */
    size_t cycles = fw_maths_rainflow(work, m, work, cycle), half = 0, whole = 0;
    for (size_t i = 0; i < cycles; i++) { /* two halves of the largest make one */
        if (cycle[i].count < 1 && half++ % 2) continue;
        cycle[whole] = cycle[i];
        cycle[whole++].count = 1;
    }
    return whole;
}
