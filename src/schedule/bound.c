/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/bound.h"
#include <math.h>

static double runs_of(const fw_schedule_shop *shop, int task) {
    const fw_schedule_task *t = &shop->task[task];
    int at_once = t->alone ? shop->machine[t->machine].places : t->load;
    return ceil((double)shop->wafers / at_once);
}

static double there_of(const fw_schedule_task *t) {
    return t->by_day ? t->duration_s : t->attended_s;
}

/* earliest end of the flow when task `from` may start at t: tasks alone, in the working day */
static double rest_after(const fw_schedule_shop *shop, int from, double t) {
    for (int i = from; i < shop->ntask; i++) {
        double there = there_of(&shop->task[i]);
        if (there > 0.0) t = fw_schedule_calendar_fit(&shop->calendar, t, there);
        t += shop->task[i].duration_s;
    }
    return t;
}

/* Runs on one machine follow each other. None starts before the first of its tasks can, and behind
   the last run the flow still has at least what follows the last of its tasks. */
static double machine_bound(const fw_schedule_shop *shop, int machine, const double *earliest_s) {
    int first = -1, last = -1;
    double busy = 0.0, there = 0.0;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (t->machine != machine) continue;
        first = first < 0 ? i : first;
        last = i;
        /* where a run occupies one of several places, so many run at once */
        double share = t->alone ? 1.0 : 1.0 / shop->machine[machine].places;
        busy += runs_of(shop, i) * t->duration_s * share;
        there += t->alone ? 0.0 : runs_of(shop, i) * there_of(t) * share;
    }
    if (first < 0) return 0.0;
    double t = fmax(earliest_s[first] + busy,
                    fw_schedule_calendar_worked(&shop->calendar, earliest_s[first], there));
    return rest_after(shop, last + 1, t);
}

/* K people stand there for all attended parts; behind the last one its run and the flow go on */
static double operator_bound(const fw_schedule_shop *shop, const double *earliest_s) {
    double work = 0.0, from = (double)INFINITY, least = (double)INFINITY;
    for (int i = 0; i < shop->ntask; i++) {
        if (!(shop->task[i].attended_s > 0.0)) continue;
        work += runs_of(shop, i) * shop->task[i].attended_s;
        from = fmin(from, earliest_s[i]);
    }
    if (work <= 0.0) return 0.0;
    double t = fw_schedule_calendar_worked(&shop->calendar, from, work / shop->operators);
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *k = &shop->task[i];
        if (k->attended_s > 0.0)
            least = fmin(least, rest_after(shop, i + 1, t + k->duration_s - k->attended_s));
    }
    return least;
}

/* Each bound holds for every schedule, windows and days included: people and machines only delay a
   wafer alone, fitting into the day never makes a later start earlier, and where a window forbids
   loads that are counted here, the truth is later still. Test: test_schedule.c, brute_force. */
void fw_schedule_bounds(const fw_schedule_shop *shop, const double *earliest_s, double start_s,
                        fw_schedule_bound *b) {
    int last = shop->ntask - 1;
    *b = (fw_schedule_bound){.path_s = earliest_s[last] + shop->task[last].duration_s - start_s};
    for (int m = 0; m < shop->nmachine; m++) {
        double at = machine_bound(shop, m, earliest_s) - start_s;
        if (at <= b->machine_s) continue;
        b->machine_s = at;
        b->machine = m;
    }
    b->operator_s = fmax(0.0, operator_bound(shop, earliest_s) - start_s);
    b->best_s = fmax(b->path_s, fmax(b->machine_s, b->operator_s));
}
