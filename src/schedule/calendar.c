/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When anything may run: the days and hours of people, and those of machines. */
#include "schedule/place.h"
#include "quantity/quantity.h"
#include "schedule/schedule.h"
#include <math.h>
#include <string.h>

/* ---- the working day ---- */

static const double day_s = 86400.0;

const char *const fw_schedule_weekday[] = {"Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"};

const fw_schedule_calendar fw_schedule_round_the_clock = {
    .open_s = 0.0, .close_s = 86400.0, .weekends = true};

bool fw_schedule_calendar_round(const fw_schedule_calendar *c) {
    return c->open_s <= 0.0 && c->close_s >= day_s && c->breaks == 0 && c->closed_days == 0;
}

int fw_schedule_calendar_weekday(const fw_schedule_calendar *c, long day) {
    long monday = c->dated ? c->first_day + 3 + day : day; /* 1970 began on a Thursday */
    return (int)((monday % 7 + 7) % 7);
}

static double ahead_of(const fw_schedule_calendar *c, int k) {
    return k < 0 ? 0.0 : c->ahead_s[k];
}

double fw_schedule_calendar_clock(const fw_schedule_calendar *c, double t) {
    int k = c->changes - 1;
    while (k >= 0 && t < c->change_s[k])
        k--;
    return t + ahead_of(c, k);
}

double fw_schedule_calendar_elapsed(const fw_schedule_calendar *c, double clock_s) {
    for (int k = -1; k < c->changes; k++) {
        const double t = clock_s - ahead_of(c, k);
        if (k >= 0 && t < c->change_s[k]) return c->change_s[k]; /* an hour that never is */
        if (k + 1 == c->changes || t < c->change_s[k + 1]) return t;
    }
    return clock_s;
}

static bool working(const fw_schedule_calendar *c, double day) {
    int weekday = fw_schedule_calendar_weekday(c, (long)day);
    return (c->weekends || weekday < 5) && !(c->closed_days >> weekday & 1u);
}

/* the k-th stretch of a day without a break, s of the day; false: there are not so many */
static bool stretch(const fw_schedule_calendar *c, int k, double span[2]) {
    if (k > c->breaks) return false;
    span[0] = k == 0 ? c->open_s : c->break_s[k - 1][1];
    span[1] = k == c->breaks ? c->close_s : c->break_s[k][0];
    return true;
}

static double longest_stretch(const fw_schedule_calendar *c) {
    double span[2], most = 0.0;
    for (int k = 0; stretch(c, k, span); k++)
        most = fmax(most, span[1] - span[0]);
    return most;
}

/* Earliest t >= from with [t, t + length] inside one working day, without a break. from, length s >= 0. INFINITY where
   length is longer than any stretch of a day. It never falls when `from` rises: what the bounds rest on.
   Cost: at most three days looked at. Test: test_calendar.c. */
double fw_schedule_calendar_fit(const fw_schedule_calendar *c, double from_s, double length_s) {
    double span[2];
    if (fw_schedule_calendar_round(c)) return from_s;
    if (length_s > longest_stretch(c) + 1e-9 || !isfinite(from_s)) return (double)INFINITY;
    for (double day = floor(fw_schedule_calendar_clock(c, from_s) / day_s);; day += 1.0)
        for (int k = 0; working(c, day) && stretch(c, k, span); k++) {
            double t = fmax(from_s, fw_schedule_calendar_elapsed(c, day * day_s + span[0]));
            if (t + length_s <= fw_schedule_calendar_elapsed(c, day * day_s + span[1]) + 1e-9)
                return t;
        }
}

/* End of the stretch that is open at t. Midnight closes too, where the day goes on: what follows is
   the next day's stretch. */
static double day_closes(const fw_schedule_calendar *c, double t) {
    double span[2], day = floor(fw_schedule_calendar_clock(c, t) / day_s);
    for (int k = 0; stretch(c, k, span); k++) {
        const double close = fw_schedule_calendar_elapsed(c, day * day_s + span[1]);
        if (t < close) return close;
    }
    return fw_schedule_calendar_elapsed(c, (day + 1.0) * day_s);
}

/* Earliest t with a working time of work_s between from_s and t. Test: test_calendar.c. */
double fw_schedule_calendar_worked(const fw_schedule_calendar *c, double from_s, double work_s) {
    double span[2];
    if (fw_schedule_calendar_round(c)) return from_s + work_s;
    if (work_s <= 0.0 || !isfinite(from_s)) return from_s;
    for (double day = floor(fw_schedule_calendar_clock(c, from_s) / day_s);; day += 1.0)
        for (int k = 0; working(c, day) && stretch(c, k, span); k++) {
            double open = fmax(from_s, fw_schedule_calendar_elapsed(c, day * day_s + span[0])),
                   close = fw_schedule_calendar_elapsed(c, day * day_s + span[1]);
            if (open >= close) continue;
            if (work_s <= close - open) return open + work_s;
            work_s -= close - open;
        }
}

double fw_schedule_calendar_start(const fw_schedule_calendar *c) {
    return fw_schedule_calendar_fit(c, fw_schedule_calendar_elapsed(c, c->first_s), 1.0);
}

fw_schedule_calendar fw_schedule_usual_day(const fw_schedule_calendar *of) {
    fw_schedule_calendar day = *of;
    day.open_s = 8.0 * 3600.0;
    day.close_s = 18.0 * 3600.0;
    day.breaks = 0;
    day.weekends = false;
    return day;
}

bool fw_schedule_same_day(const fw_schedule_calendar *a, const fw_schedule_calendar *b) {
    const double apart_s = fabs(a->open_s - b->open_s) + fabs(a->close_s - b->close_s);
    return apart_s < 1.0 && a->breaks == 0 && b->breaks == 0 && a->weekends == b->weekends;
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

/* ---- zones whose clocks are changed ----
   A rule as POSIX writes it (IEEE Std 1003.1-2017, chapter 8.3, TZ): "CET-1CEST,M3.5.0,M10.5.0/3" are one hour before UTC
   in winter (its sign is that of what is added to have UTC), summer from the last Sunday of March at 2:00 to the last one of
   October at 3:00. Ways of naming a day: Mm.w.d, the w-th (5: last) day d of the week of month m; Jn, the n-th of the year
   without 29 February; n, counted from 0 with it. The last line of a file of the system's zones is such a rule.
   Test: test_calendar.c, against zones of the system. */

typedef struct rule {
    char kind; /* 'M', 'J' or '0' */
    long month, week, day;
    double at_s; /* of that day's clock */
} rule;

static const char *number_of(const char *text, long least, long most, long *value) {
    if (!text || *text < '0' || *text > '9') return NULL;
    for (*value = 0; *text >= '0' && *text <= '9' && *value <= most; text++)
        *value = 10 * *value + (*text - '0');
    return *value < least || *value > most ? NULL : text;
}

/* "1", "5:30", "-3:45:00"; hours of a time of change reach over a week */
static const char *span_of(const char *text, long most_h, double *seconds) {
    long part[3] = {0};
    const double sign = text && *text == '-' ? -1.0 : 1.0;
    if (text && (*text == '-' || *text == '+')) text++;
    text = number_of(text, 0, most_h, &part[0]);
    for (int k = 1; k < 3 && text && *text == ':'; k++)
        text = number_of(text + 1, 0, 59, &part[k]);
    *seconds = sign * (3600.0 * (double)part[0] + 60.0 * (double)part[1] + (double)part[2]);
    return text;
}

/* "CET" or "<+0330>" */
static const char *behind_name(const char *text) {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz",
                      signs[] = "0123456789+-";
    const bool quoted = text && *text == '<';
    if (!text) return NULL;
    size_t n = quoted ? 0 : strspn(text, letters);
    if (quoted)
        while (text[1 + n] && (strchr(letters, text[1 + n]) || strchr(signs, text[1 + n])))
            n++;
    if (n < 3 || (quoted && text[1 + n] != '>')) return NULL;
    return text + n + (quoted ? 2 : 0);
}

static const char *rule_of(const char *text, rule *r) {
    *r = (rule){.kind = '0', .at_s = 7200.0};
    if (!text || *text++ != ',') return NULL;
    if (*text == 'M') {
        r->kind = 'M';
        text = number_of(text + 1, 1, 12, &r->month);
        text = text && *text == '.' ? number_of(text + 1, 1, 5, &r->week) : NULL;
        text = text && *text == '.' ? number_of(text + 1, 0, 6, &r->day) : NULL;
    } else if (*text == 'J') {
        r->kind = 'J';
        text = number_of(text + 1, 1, 365, &r->day);
    } else
        text = number_of(text, 0, 365, &r->day);
    return text && *text == '/' ? span_of(text + 1, 167, &r->at_s) : text;
}

static long first_of(long year, long month) { /* days since 1970-01-01 */
    const long y = year + (month > 12), m = month > 12 ? 1 : month;
    static const int before[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    const long leaps = (y - 1) / 4 - (y - 1) / 100 + (y - 1) / 400, until_1970 = 477;
    const bool leap = (y % 4 == 0 && y % 100 != 0) || y % 400 == 0;
    return 365 * (y - 1970) + leaps - until_1970 + before[m - 1] + (leap && m > 2);
}

/* s since 1970 of the clock as it was until then */
static double change_in(const rule *r, long year) {
    const long january = first_of(year, 1), leap = first_of(year, 3) - january - 59;
    long day = january + r->day;
    if (r->kind == 'J') day += (leap && r->day > 59 ? 1 : 0) - 1;
    if (r->kind == 'M') {
        const long first = first_of(year, r->month), next = first_of(year, r->month + 1),
                   sunday = ((first + 4) % 7 + 7) % 7; /* 1970 began on a Thursday, which is 4 */
        day = first + (r->day - sunday + 7) % 7 + 7 * (r->week - 1);
        while (day >= next)
            day -= 7;
    }
    return day_s * (double)day + r->at_s;
}

/* What the clock does from 0:00 of the first day on, for as long as a plan may last. Zones south of the equator begin a
   year in summer: the rules come in the order of time, whichever is first. */
static void clock_changes(fw_schedule_calendar *c, const rule rules[2], const double ahead_s[2]) {
    long civil[3];
    fw_quantity_civil(c->first_day, civil);
    double at[8], to[8], midnight = day_s * (double)c->first_day, first = ahead_s[0];
    int n = 0;
    for (long year = civil[0] - 1; year <= civil[0] + 2; year++) {
        const double begin = change_in(&rules[0], year) - ahead_s[0],
                     end = change_in(&rules[1], year) - ahead_s[1];
        const int summer = begin < end ? 0 : 1;
        at[n + summer] = begin, to[n + summer] = ahead_s[1];
        at[n + 1 - summer] = end, to[n + 1 - summer] = ahead_s[0];
        n += 2;
    }
    for (int k = 0; k < n && at[k] <= midnight - first; k++)
        first = to[k];
    c->zone_min = (int)lround(first / 60.0);
    for (int k = 0; k < n; k++) {
        const double when = at[k] - (midnight - first);
        if (!(when > 0.0) || c->changes == (int)(sizeof c->change_s / sizeof *c->change_s))
            continue;
        c->change_s[c->changes] = when;
        c->ahead_s[c->changes++] = to[k] - first;
    }
}

typedef struct zone {
    double ahead_s[2]; /* of UTC, in winter and in summer */
    rule rules[2];     /* when summer begins and ends */
    bool changed;      /* else it is ahead_s[0] all the time */
} zone;

static bool posix_zone(const char *text, zone *z) {
    double west_s;
    text = span_of(behind_name(text), 24, &west_s);
    if (!text) return false;
    z->ahead_s[0] = -west_s;
    if (!*text) return true;
    text = behind_name(text);
    z->ahead_s[1] = z->ahead_s[0] + 3600.0;
    z->changed = true;
    if (text && *text != ',') {
        text = span_of(text, 24, &west_s);
        z->ahead_s[1] = -west_s;
    }
    text = rule_of(rule_of(text, &z->rules[0]), &z->rules[1]);
    return text && !*text;
}

static bool is_on_earth(double ahead_s) {
    return ahead_s >= -12 * 3600.0 && ahead_s <= 14 * 3600.0;
}

/* "UTC", "UTC+01:00" or a rule, to the end of the text; zones reach from UTC-12:00 to UTC+14:00. "UTC+1" and
   the like are no rules: their sign is the other way round there, and nobody means that */
static bool zone_of(const char *text, zone *z) {
    static const char utc[] = "UTC";
    double ahead_s = 0.0;
    *z = (zone){.changed = false};
    if (strncmp(text, utc, sizeof utc - 1) != 0)
        return posix_zone(text, z) && is_on_earth(z->ahead_s[0]) && is_on_earth(z->ahead_s[1]);
    text += sizeof utc - 1;
    const char sign = *text, *end = sign ? clock_of(text + 1, &ahead_s) : text;
    if (!end || *end || (sign && sign != '+' && sign != '-')) return false;
    z->ahead_s[0] = sign == '-' ? -ahead_s : ahead_s;
    return is_on_earth(z->ahead_s[0]);
}

/* how far its clock is ahead of UTC at a time of UTC */
static double zone_ahead_at(const zone *z, double utc_s) {
    long civil[3];
    if (!z->changed) return z->ahead_s[0];
    fw_quantity_civil((long)floor(utc_s / day_s), civil);
    double last = -(double)INFINITY, ahead = z->ahead_s[0];
    for (long year = civil[0] - 1; year <= civil[0] + 1; year++)
        for (int k = 0; k < 2; k++) { /* rule 0 begins summer, on the clock of winter */
            const double at = change_in(&z->rules[k], year) - z->ahead_s[k];
            if (at <= utc_s && at > last) last = at, ahead = z->ahead_s[1 - k];
        }
    return ahead;
}

int fw_schedule_zone_times(const char *text, double clock_s, double utc_s[2]) {
    zone z;
    int n = 0;
    if (!zone_of(text, &z)) return -1;
    const double least = z.changed ? fmin(z.ahead_s[0], z.ahead_s[1]) : z.ahead_s[0],
                 most = z.changed ? fmax(z.ahead_s[0], z.ahead_s[1]) : z.ahead_s[0];
    const double ahead[2] = {most, least}; /* the earlier time first */
    for (int k = 0; k < (most > least ? 2 : 1); k++)
        if (zone_ahead_at(&z, clock_s - ahead[k]) == ahead[k]) utc_s[n++] = clock_s - ahead[k];
    return n;
}

/* behind the date of a calendar: a blank and a zone, or nothing */
static bool calendar_zone(const char *text, fw_schedule_calendar *c) {
    zone z;
    if (!*text) return true;
    if (*text != ' ' || !zone_of(text + 1, &z)) return false;
    c->zoned = true;
    c->zone_min = (int)lround(z.ahead_s[0] / 60.0);
    if (z.changed) clock_changes(c, z.rules, z.ahead_s);
    return true;
}

/* " from 2026-11-23", "T13:00" behind it, a zone behind that; a plan that begins in 9999 could end where dates have no
   four digits */
static bool date_of(const char *text, fw_schedule_calendar *c) {
    static const char before[] = " from ", last[] = "9999";
    const size_t n = sizeof before - 1;
    c->dated = strncmp(text, before, n) == 0 && fw_quantity_date_parse(text + n, &c->first_day) &&
               strncmp(text + n, last, sizeof last - 1) != 0;
    if (!c->dated) return false;
    text += n + sizeof "2026-11-23" - 1;
    if (*text == 'T') text = clock_of(text + 1, &c->first_s);
    return text && calendar_zone(text, c);
}

bool fw_schedule_calendar_parse(const char *text, fw_schedule_calendar *c) {
    *c = (fw_schedule_calendar){.open_s = 0.0, .close_s = day_s};
    if (strncmp(text, "none", 4) == 0) {
        text += 4;
        return !*text || date_of(text, c);
    }
    for (double open, close = -1.0;; text++) {
        const char *at = clock_of(text, &open);
        bool first = close < 0.0;
        if (!at || *at++ != '-' || (!first && !(open > close))) return false;
        if (!first) {
            if (c->breaks == 4) return false;
            c->break_s[c->breaks][0] = close;
            c->break_s[c->breaks++][1] = open;
        } else
            c->open_s = open;
        text = clock_of(at, &close);
        if (!text || !(open < close)) return false;
        c->close_s = close;
        if (*text != ',') return !*text || date_of(text, c);
    }
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

/* ---- hours of machines ----
   A run lies inside all hours of its machine, and touches no day on which it is closed. */

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
        end = fmin(end, day_closes(&m->hours[i], t));
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

/* Test: test_schedule.c, who_ends_it */
double fw_schedule_people_fit(const fw_schedule_calendar *calendar, const fw_schedule_task *task,
                              double from_s) {
    static const double put_in_s = 1.0;
    const double there = fw_schedule_task_there_s(task),
                 lead = fw_schedule_task_attended_from_s(task);
    if (!(there > 0.0)) return from_s;
    if (!task->at_end || task->by_day || task->in_parts)
        return fw_schedule_calendar_fit(calendar, from_s, there);
    for (double t = from_s;;) {
        const double before = t;
        t = fw_schedule_calendar_fit(calendar, t, put_in_s);
        if (!(t <= from_s + FW_HORIZON_S)) return (double)INFINITY; /* it takes longer than a day */
        t = fmax(t, fw_schedule_calendar_fit(calendar, t + lead, there) - lead);
        if (t <= before + 1e-6) return t;
    }
}

double fw_schedule_alone_fit(const fw_schedule_shop *shop, int task, double from_s) {
    const fw_schedule_task *k = &shop->task[task];
    double t = from_s;
    for (double before = -(double)INFINITY; t > before;) {
        if (!(t <= from_s + FW_HORIZON_S)) return (double)INFINITY; /* hours that never meet */
        before = t;
        t = fw_schedule_people_fit(&shop->calendar, k, t);
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

static fw_status read_hours(const fw_process_tool_time *t, fw_schedule_calendar *c,
                            fw_diags *diags) {
    if (!fw_schedule_calendar_parse(t->open, c) || c->dated || strcmp(t->open, "none") == 0)
        return fw_diag_error(diags, 376, t->place,
                             "open=\"%s\" is not like 09:00-17:00 or 09:00-12:00,13:00-17:00",
                             t->open);
    c->weekends = true;
    if (!days_of(t->days, &c->closed_days))
        return fw_diag_error(diags, 376, t->place,
                             "days=\"%s\" are not some of Mon Tue Wed Thu Fri Sat Sun", t->days);
    return FW_OK;
}

static fw_status read_closed(const fw_process_tool_time *t, long *from, long *to, fw_diags *diags) {
    if (fw_quantity_date_parse(t->from, from) && fw_quantity_date_parse(t->to, to) && *to >= *from)
        return FW_OK;
    return fw_diag_error(diags, 376, t->place,
                         "closed=\"%s\" to=\"%s\" are not two dates, the first one first", t->from,
                         t->to);
}

fw_status fw_schedule_tool_words(const fw_process_flow *flow, fw_diags *diags) {
    fw_status status = FW_OK;
    for (int i = 0; i < flow->ntool_time; i++) {
        const fw_process_tool_time *t = &flow->tool_time[i];
        fw_schedule_calendar hours;
        long from, to;
        fw_status of = t->open ? read_hours(t, &hours, diags) : read_closed(t, &from, &to, diags);
        if (of != FW_OK) status = of;
    }
    return status;
}

static fw_status hours_of(making *w, const fw_process_tool_time *t, fw_schedule_machine *m) {
    fw_schedule_calendar *c = &w->hours[m->nhours];
    FW_TRY(read_hours(t, c, w->diags));
    c->dated = w->day->dated;
    c->first_day = w->day->first_day;
    c->changes = w->day->changes;
    memcpy(c->change_s, w->day->change_s, sizeof c->change_s);
    memcpy(c->ahead_s, w->day->ahead_s, sizeof c->ahead_s);
    m->nhours++;
    return FW_OK;
}

static fw_status undated(const fw_process_tool_time *t, fw_diags *diags) {
    return fw_diag_error(diags, 376, t->place,
                         "'%s' is closed on dates, and the plan has none: begin it on one, "
                         "--day \"08:00-18:00 from %s\"",
                         t->equipment, t->from);
}

fw_status fw_schedule_tool_dates(const fw_process_flow *flow, const char *day, fw_diags *diags) {
    fw_schedule_calendar calendar;
    if (!fw_schedule_calendar_parse(day ? day : FW_WORKING_DAY, &calendar) || calendar.dated)
        return FW_OK; /* what is no day at all is said where it was read */
    for (int i = 0; i < flow->ntool_time; i++)
        if (!flow->tool_time[i].open) return undated(&flow->tool_time[i], diags);
    return FW_OK;
}

static fw_status closed_of(making *w, const fw_process_tool_time *t, fw_schedule_machine *m) {
    long from, to;
    FW_TRY(read_closed(t, &from, &to, w->diags));
    if (!w->day->dated) return w->day->undated ? FW_OK : undated(t, w->diags);
    double *span = w->closed_s[m->nclosed++];
    span[0] = fw_schedule_calendar_elapsed(w->day, day_s * (double)(from - w->day->first_day));
    span[1] = fw_schedule_calendar_elapsed(w->day, day_s * (double)(to + 1 - w->day->first_day));
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
