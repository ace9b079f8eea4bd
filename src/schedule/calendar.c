/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/schedule.h"
#include <math.h>
#include <string.h>

static const double day_s = 86400.0;

bool fw_schedule_calendar_round(const fw_schedule_calendar *c) {
    return c->open_s <= 0.0 && c->close_s >= day_s;
}

static bool working(const fw_schedule_calendar *c, double day) {
    return c->weekends || fmod(day, 7.0) < 5.0;
}

/* Earliest t >= from with [t, t + length] inside one working day. from, length s >= 0. INFINITY
   where length is longer than the day. It never falls when `from` rises: what the bounds rest on.
   Cost: at most three days looked at. Test: test_calendar.c. */
double fw_schedule_calendar_fit(const fw_schedule_calendar *c, double from_s, double length_s) {
    if (fw_schedule_calendar_round(c)) return from_s;
    if (length_s > c->close_s - c->open_s + 1e-9 || !isfinite(from_s)) return (double)INFINITY;
    for (double day = floor(from_s / day_s);; day += 1.0) {
        double t = fmax(from_s, day * day_s + c->open_s);
        if (working(c, day) && t + length_s <= day * day_s + c->close_s + 1e-9) return t;
    }
}

/* Earliest t with a working time of work_s between from_s and t. Test: test_calendar.c. */
double fw_schedule_calendar_worked(const fw_schedule_calendar *c, double from_s, double work_s) {
    if (fw_schedule_calendar_round(c)) return from_s + work_s;
    if (work_s <= 0.0 || !isfinite(from_s)) return from_s;
    for (double day = floor(from_s / day_s);; day += 1.0) {
        if (!working(c, day)) continue;
        double open = fmax(from_s, day * day_s + c->open_s), close = day * day_s + c->close_s;
        if (open >= close) continue;
        if (work_s <= close - open) return open + work_s;
        work_s -= close - open;
    }
}

/* "08:00" at text; 24:00 is the end of the day */
static const char *clock_of(const char *text, double *seconds) {
    static const char shape[] = "00:00";
    for (int i = 0; i < 5; i++)
        if (shape[i] == ':' ? text[i] != ':' : text[i] < '0' || text[i] > '9') return NULL;
    int hour = 10 * (text[0] - '0') + text[1] - '0', minute = 10 * (text[3] - '0') + text[4] - '0';
    *seconds = 3600.0 * hour + 60.0 * minute;
    return minute > 59 || *seconds > day_s ? NULL : text + 5;
}

bool fw_schedule_calendar_parse(const char *text, fw_schedule_calendar *c) {
    *c = (fw_schedule_calendar){.open_s = 0.0, .close_s = day_s};
    if (strcmp(text, "none") == 0) return true;
    const char *at = clock_of(text, &c->open_s);
    if (!at || *at++ != '-') return false;
    at = clock_of(at, &c->close_s);
    return at && *at == '\0' && c->open_s < c->close_s;
}

void fw_schedule_put_duration(fw_text *out, double seconds) {
    if (seconds < 99.5) {
        fw_text_number(out, seconds, seconds < 9.95 ? 2 : 3);
        fw_text_add(out, " s");
        return;
    }
    long total = lround(fmin(seconds, 1e9));
    if (total < 7200) {
        fw_text_printf(out, "%ld min", total / 60);
        if (total % 60) fw_text_printf(out, " %ld s", total % 60);
        return;
    }
    total = (total + 30) / 60;
    fw_text_printf(out, "%ld h", total / 60);
    if (total % 60) fw_text_printf(out, " %ld min", total % 60);
}
