/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lower bounds of the end of all schedules. Each holds with windows, days and hours of machines: people and machines
   only delay a wafer alone, fitting into hours never makes a later start earlier, and where a window forbids loads that
   are counted here, the truth is later still. Tests: test_schedule.c, brute_force; test_tools.c, bounds. */
#include "schedule/place.h"
#include <math.h>

/* how often the machine runs the task, loads that its places take at once counted once */
static int rounds_of(const fw_schedule_shop *shop, int task) {
    const fw_schedule_task *t = &shop->task[task];
    int load = t->alone ? 1 : t->load, places = shop->machine[t->machine].places;
    int runs = (shop->wafers + load - 1) / load;
    return (runs + places - 1) / places;
}

static double there_of(const fw_schedule_task *t) {
    return t->by_day ? t->duration_s : t->attended_s;
}

/* earliest end of the flow when task `from` may start at t: tasks alone, in their hours */
static double rest_after(const fw_schedule_shop *shop, int from, double t) {
    for (int i = from; i < shop->ntask; i++)
        t = fw_schedule_alone_fit(shop, i, t) + shop->task[i].duration_s;
    return t;
}

/* Equal runs of one task on one place, each as early as it fits: no other order ends earlier, since a later start
   never fits earlier. */
static double task_bound(const fw_schedule_shop *shop, int task, double from_s) {
    double t = from_s;
    for (int i = rounds_of(shop, task); i > 0; i--)
        t = fw_schedule_alone_fit(shop, task, t) + shop->task[task].duration_s;
    return rest_after(shop, task + 1, t);
}

/* All runs on one machine follow each other. None starts before the first of its tasks can, and behind the last run
   the flow still has at least what follows the last of its tasks. */
static double machine_bound(const fw_schedule_shop *shop, int machine, const double *earliest_s) {
    int first = -1, last = -1;
    double busy = 0.0, there = 0.0, shortest = (double)INFINITY, most = 0.0;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (t->machine != machine) continue;
        first = first < 0 ? i : first;
        last = i;
        double load = t->alone ? 1.0 : t->load,
               runs = ceil(shop->wafers / load) / shop->machine[machine].places;
        busy += runs * t->duration_s;
        there += runs * there_of(t);
        if (t->duration_s > 0.0) shortest = fmin(shortest, t->duration_s);
        most = fmax(most, task_bound(shop, i, earliest_s[i]));
    }
    if (!(busy > 0.0)) return most;
    double t =
        fmax(fw_schedule_machine_worked(&shop->machine[machine], earliest_s[first], busy, shortest),
             fw_schedule_calendar_worked(&shop->calendar, earliest_s[first], there));
    return fmax(most, rest_after(shop, last + 1, t));
}

/* K people stand there for all attended parts; behind the last one its run and the flow go on */
static double operator_bound(const fw_schedule_shop *shop, const double *earliest_s) {
    double work = 0.0, from = (double)INFINITY, least = (double)INFINITY;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (!(t->attended_s > 0.0)) continue;
        work += ceil((double)shop->wafers / t->load) * t->attended_s;
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

void fw_schedule_lower_bounds(const fw_schedule_shop *shop, const double *earliest_s,
                              double start_s, fw_schedule_bound *b) {
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
