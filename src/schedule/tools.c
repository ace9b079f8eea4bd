/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hours of machines: a run lies inside all hours of its machine, and touches no day on which it is closed. */
#include "schedule/place.h"
#include <math.h>
#include <string.h>

static const double day_s = 86400.0;

double fw_schedule_machine_fit(const fw_schedule_machine *m, double from_s, double length_s) {
    double t = from_s;
    for (double before = -(double)INFINITY; t > before;) {
        if (!(t <= from_s + FW_HORIZON_S)) return (double)INFINITY; /* hours that never meet */
        before = t;
        for (int i = 0; i < m->nhours; i++)
            t = fw_schedule_calendar_fit(&m->hours[i], t, length_s);
        for (int i = 0; i < m->nclosed; i++)
            if (t < m->closed_s[i][1] && t + length_s > m->closed_s[i][0]) t = m->closed_s[i][1];
    }
    return t;
}

double fw_schedule_machine_closes(const fw_schedule_machine *m, double t) {
    double end = (double)INFINITY;
    for (int i = 0; i < m->nhours; i++)
        end = fmin(end, fw_schedule_calendar_closes(&m->hours[i], t));
    for (int i = 0; i < m->nclosed; i++)
        if (m->closed_s[i][0] > t) end = fmin(end, m->closed_s[i][0]);
    return end;
}

double fw_schedule_machine_worked(const fw_schedule_machine *m, double from_s, double work_s,
                                  double least_s) {
    for (double t = from_s;;) {
        t = fw_schedule_machine_fit(m, t, least_s);
        if (!isfinite(t)) return t;
        double close = fw_schedule_machine_closes(m, t);
        if (work_s <= close - t) return t + work_s;
        work_s -= close - t;
        t = close;
    }
}

double fw_schedule_alone_fit(const fw_schedule_shop *shop, int task, double from_s) {
    const fw_schedule_task *k = &shop->task[task];
    double there = k->by_day ? k->duration_s : k->attended_s, t = from_s;
    for (double before = -(double)INFINITY; t > before;) {
        if (!(t <= from_s + FW_HORIZON_S)) return (double)INFINITY; /* hours that never meet */
        before = t;
        if (there > 0.0) t = fw_schedule_calendar_fit(&shop->calendar, t, there);
        t = fw_schedule_machine_fit(&shop->machine[k->machine], t, k->duration_s);
    }
    return t;
}

/* ---- from the words of a laboratory ---- */

/* "Mon Tue": the others are closed; false: another word, or none */
static bool days_of(const char *text, unsigned *closed) {
    unsigned open = 0;
    while (*text) {
        size_t n = strcspn(text, " \t\n");
        int day = 0;
        while (day < 7 && (strlen(fw_schedule_weekday[day]) != n ||
                           strncmp(text, fw_schedule_weekday[day], n) != 0))
            day++;
        if (day == 7) return false;
        open |= 1u << day;
        text += n + strspn(text + n, " \t\n");
    }
    *closed = open ? ~open & 0x7fu : 0u;
    return true;
}

typedef struct making {
    fw_arena *arena;
    const fw_schedule_calendar *day;
    fw_schedule_calendar *hours;
    double (*closed_s)[2];
    fw_diags *diags;
} making;

static fw_status hours_of(making *w, const fw_process_tool_time *t, fw_schedule_machine *m) {
    fw_schedule_calendar *c = &w->hours[m->nhours];
    if (!fw_schedule_calendar_parse(t->open, c) || c->dated || strcmp(t->open, "none") == 0)
        return fw_diag_error(w->diags, 376, t->place,
                             "open=\"%s\" is not like 09:00-17:00 or 09:00-12:00,13:00-17:00",
                             t->open);
    c->weekends = true;
    c->dated = w->day->dated;
    c->first_day = w->day->first_day;
    if (!days_of(t->days, &c->closed_days))
        return fw_diag_error(w->diags, 376, t->place,
                             "days=\"%s\" are not some of Mon Tue Wed Thu Fri Sat Sun", t->days);
    m->nhours++;
    return FW_OK;
}

static fw_status closed_of(making *w, const fw_process_tool_time *t, fw_schedule_machine *m) {
    long from, to;
    if (!fw_schedule_date_parse(t->from, &from) || !fw_schedule_date_parse(t->to, &to) || to < from)
        return fw_diag_error(w->diags, 376, t->place,
                             "closed=\"%s\" to=\"%s\" are not two dates, the first one first",
                             t->from, t->to);
    if (!w->day->dated)
        return fw_diag_error(w->diags, 376, t->place,
                             "'%s' is closed on dates, and the plan has none: begin it on one, "
                             "--day \"08:00-18:00 from %s\"",
                             t->equipment, t->from);
    double *span = w->closed_s[m->nclosed++];
    span[0] = day_s * (double)(from - w->day->first_day);
    span[1] = day_s * (double)(to + 1 - w->day->first_day);
    return FW_OK;
}

/* every run has a place where no other run stands */
static fw_status long_enough(const fw_process_tool_time *t, const fw_schedule_machine *m,
                             const fw_schedule_task *task, fw_diags *diags) {
    if (isfinite(fw_schedule_machine_fit(m, 0.0, task->duration_s))) return FW_OK;
    return fw_diag_error(diags, 376, t->place,
                         "a run of step %s takes %.4g min, and '%s' is never open for so long; "
                         "widen its hours",
                         task->id, task->duration_s / 60.0, m->id);
}

static fw_status of_machine(making *w, const fw_process_flow *flow, fw_schedule_machine *m) {
    size_t most = (size_t)flow->ntool_time;
    FW_NEED(w->hours = fw_arena_array(w->arena, fw_schedule_calendar, most));
    FW_NEED(w->closed_s = fw_arena_raw(w->arena, most * sizeof *w->closed_s));
    for (int i = 0; i < flow->ntool_time; i++) {
        const fw_process_tool_time *t = &flow->tool_time[i];
        if (strcmp(t->equipment, m->id) == 0)
            FW_TRY(t->open ? hours_of(w, t, m) : closed_of(w, t, m));
    }
    m->hours = w->hours;
    m->closed_s = (const double(*)[2])w->closed_s;
    return FW_OK;
}

fw_status fw_schedule_tool_hours(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_schedule_calendar *day, fw_schedule_machine *machine,
                                 int n, const fw_schedule_task *task, int ntask, fw_diags *diags) {
    making w = {.arena = arena, .day = day, .diags = diags};
    for (int i = 0; i < n && flow->ntool_time > 0; i++)
        FW_TRY(of_machine(&w, flow, &machine[i]));
    for (int i = 0; i < flow->ntool_time; i++)
        for (int k = 0; k < ntask; k++)
            if (strcmp(machine[task[k].machine].id, flow->tool_time[i].equipment) == 0)
                FW_TRY(
                    long_enough(&flow->tool_time[i], &machine[task[k].machine], &task[k], diags));
    return FW_OK;
}
