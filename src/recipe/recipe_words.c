/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/recipe.h"
#include "recipe/asrun_parts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool listed(const fw_recipe_row *row, int n, const fw_quantity *q) {
    for (int i = 0; i < n; i++)
        if (row[i].q == q) return true;
    return false;
}

static const char *in_words(fw_arena *arena, const char *name) {
    char *words = fw_arena_strdup(arena, name);
    for (char *c = words; c && *c; c++)
        if (*c == '_') *c = ' ';
    return words;
}

fw_status fw_recipe_step_rows(fw_arena *arena, const fw_process_step *s, fw_recipe_row **row,
                              int *n) {
    size_t most = (size_t)(s->nsetting + s->nargument + s->nneed + s->nderived);
    FW_NEED(*row = fw_arena_array(arena, fw_recipe_row, most));
    *n = 0;
    for (int i = 0; i < s->nsetting; i++)
        (*row)[(*n)++] = (fw_recipe_row){s->setting[i].name, s->setting[i].tolerance_low,
                                         s->setting[i].tolerance_high, s->setting[i].q, false};
    for (int i = 0; i < s->nargument + s->nneed; i++) {
        const fw_process_argument *a =
            i < s->nargument ? &s->argument[i] : &s->need[i - s->nargument];
        if (listed(*row, *n, a->q)) continue;
        const char *name = in_words(arena, a->name);
        FW_NEED(name);
        (*row)[(*n)++] = (fw_recipe_row){name, "", "", a->q, false};
    }
    for (int i = 0; i < s->nderived; i++)
        (*row)[(*n)++] = (fw_recipe_row){s->derived[i]->id, "", "", s->derived[i], true};
    return FW_OK;
}

double fw_recipe_row_uncertainty(const fw_quantity *q) {
    fw_quantity_unit unit;
    if (!q->unit || !fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL))
        return q->uncertainty;
    unit.offset = 0.0; /* a width has no zero point */
    return fw_quantity_unit_from_si(&unit, q->uncertainty);
}

void fw_recipe_put_plain(fw_text *out, double value) {
    fw_text_number(out, value, FW_PLAIN_DIGITS);
}

void fw_recipe_put_known(fw_text *out, const fw_quantity *q) {
    if (q->word)
        fw_text_csv(out, q->word);
    else if (!q->unknown)
        fw_recipe_put_plain(out, fw_quantity_in_unit(q));
}

void fw_recipe_put_uncertainty(fw_text *out, double value) {
    fw_text_number(out, value, FW_UNCERTAINTY_DIGITS);
}

void fw_recipe_put_value(fw_text *out, double value) {
    double size = fabs(value);
    if (size >= 1e5 && size < 1e7 && floor(size) == size)
        fw_text_number(out, value, FW_UNCERTAINTY_DIGITS);
    else
        fw_text_number(out, value, size >= 100.0 && size < 1e6 ? 6 : 4);
}

static const struct {
    const char *from, *to;
} symbols[] = {{"um", "µm"},   {"Cel", "°C"}, {"Ao", "Å"},        {"ohm", "Ω"},   {"kohm", "kΩ"},
               {"Mohm", "MΩ"}, {"uN", "µN"},  {"{sccm}", "sccm"}, {"cm2", "cm²"}, {"cm3", "cm³"},
               {"m2", "m²"},   {"m3", "m³"},  {"cm-2", "cm⁻²"},   {"mm2", "mm²"}};

static void put_symbol(fw_text *out, const char *s, size_t n) {
    for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; i++)
        if (strlen(symbols[i].from) == n && memcmp(symbols[i].from, s, n) == 0) {
            fw_text_add(out, symbols[i].to);
            return;
        }
    for (size_t i = 0; i < n; i++) {
        char one[2] = {s[i], '\0'};
        fw_text_escaped(out, one);
    }
}

void fw_recipe_put_unit(fw_text *out, const char *unit) {
    if (strcmp(unit, "1") == 0) return;
    while (*unit) {
        size_t n = strcspn(unit, " /.*");
        put_symbol(out, unit, n);
        unit += n;
        if (*unit) {
            fw_text_bytes(out, unit, 1);
            unit++;
        }
    }
}

/* the other code points that keyboards have for what is printed */
static const char *typed(const char *word) {
    static const char *const same[][2] = {
        {"μm", "um"}, {"μN", "uN"}, {"\xe2\x84\xa6", "ohm"}, {"\xe2\x84\xab", "Ao"}};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
        if (strcmp(word, same[i][0]) == 0) return same[i][1];
    for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; i++)
        if (strcmp(word, symbols[i].to) == 0) return symbols[i].from;
    return word;
}

const char *fw_recipe_unit_of_printed(fw_arena *arena, const char *unit) {
    fw_text text = fw_text_new(arena);
    while (*unit) {
        const size_t n = strcspn(unit, " /.*");
        const char *word = fw_arena_strndup(arena, unit, n);
        if (!word) return NULL;
        fw_text_add(&text, typed(word));
        unit += n;
        if (*unit) fw_text_bytes(&text, unit++, 1);
    }
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

const char *fw_recipe_missing_list(fw_arena *arena, const fw_process_time *time) {
    fw_text list = fw_text_new(arena);
    fw_text_add(&list, "");
    for (int i = 0; i < time->nmissing; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", time->missing[i]);
    return fw_text_end(&list) == FW_OK ? list.data : NULL;
}

void fw_recipe_put_limits(fw_text *out, const char *low, const char *high) {
    const bool both = low[0] && high[0];
    fw_text_add(out, both ? "" : low[0] ? "&ge; " : high[0] ? "&le; " : "");
    fw_text_escaped(out, low);
    fw_text_add(out, both ? " to " : "");
    fw_text_escaped(out, high);
}

const char *fw_recipe_finish_words(fw_arena *arena, const fw_process_finish *f) {
    static const struct {
        const char *by, *words;
    } drying[] = {{"spin", "by spinning"},
                  {"nitrogen", "with nitrogen"},
                  {"oven", "in the oven"},
                  {"air", "in air"},
                  {"vapour", "in alcohol vapour"},
                  {"sublimation", "by sublimation"},
                  {"critical-point", "at the critical point"}};
    switch (f->kind) {
    case FW_FINISH_RINSE:
        return fw_arena_printf(arena, "rinse in %s",
                               f->text[0] ? f->text
                               : f->with  ? f->with->name
                                          : "deionised water");
    case FW_FINISH_DRY:
        for (size_t i = 0; i < sizeof drying / sizeof drying[0]; i++)
            if (strcmp(drying[i].by, f->by) == 0)
                return fw_arena_printf(arena, "dry %s", drying[i].words);
        return fw_arena_printf(arena, "dry by %s", f->by);
    case FW_FINISH_COOL:
        return "let it cool";
    case FW_FINISH_VENT:
        return "vent and take it out";
    }
    return "";
}

int fw_recipe_wafers(const fw_recipe_header *header) {
    return header->schedule ? header->schedule->shop->wafers : 1;
}

void fw_recipe_put_moment(fw_text *out, const fw_schedule_calendar *c, double seconds) {
    long minutes = lround(fw_schedule_calendar_clock(c, seconds) / 60.0), civil[3];
    if (c->dated) {
        fw_quantity_civil(c->first_day + minutes / 1440, civil);
        fw_text_printf(out, "%s %04ld-%02ld-%02ld, %02ld:%02ld",
                       fw_schedule_weekday[fw_schedule_calendar_weekday(c, minutes / 1440)],
                       civil[0], civil[1], civil[2], minutes / 60 % 24, minutes % 60);
        return;
    }
    fw_text_printf(out, "day %ld, %02ld:%02ld", minutes / 1440 + 1, minutes / 60 % 24,
                   minutes % 60);
}

void fw_recipe_put_wafers(fw_text *out, const fw_schedule_run *run) {
    fw_text_printf(out, "%d", run->first + 1);
    if (run->count > 1) fw_text_printf(out, "-%d", run->first + run->count);
}

static void put_span(fw_text *out, double from_s, double to_s) {
    long from = lround(from_s / 60.0), to = lround(to_s / 60.0);
    fw_text_printf(out, "%02ld:%02ld to %02ld:%02ld", from / 60, from % 60, to / 60, to % 60);
}

static void put_utc(fw_text *out, int zone_min) {
    const int size = abs(zone_min);
    fw_text_add(out, "UTC");
    if (size) fw_text_printf(out, "%c%02d:%02d", zone_min < 0 ? '-' : '+', size / 60, size % 60);
}

/* and where its clocks are changed before the plan ends */
static void put_zone(fw_text *out, const fw_schedule_calendar *c, double end_s) {
    if (!c->zoned) return;
    fw_text_add(out, ", ");
    put_utc(out, c->zone_min);
    for (int k = 0; k < c->changes && c->change_s[k] < end_s; k++) {
        const double before = k ? c->ahead_s[k - 1] : 0.0;
        fw_text_printf(out, ", the clock goes %s by ", c->ahead_s[k] > before ? "forward" : "back");
        fw_schedule_put_duration(out, fabs(c->ahead_s[k] - before));
        fw_text_add(out, " at ");
        fw_recipe_put_moment(out, c, c->change_s[k]);
        fw_text_add(out, " (then ");
        put_utc(out, c->zone_min + (int)lround(c->ahead_s[k] / 60.0));
        fw_text_add(out, ")");
    }
}

static void put_day(fw_text *out, const fw_schedule_calendar *c, double end_s) {
    if (fw_schedule_calendar_round(c))
        fw_text_add(out, "round the clock");
    else {
        put_span(out, c->open_s, c->close_s);
        fw_text_add(out, ", Monday to Friday");
    }
    for (int i = 0; i < c->breaks; i++) {
        fw_text_add(out, i ? ", " : ", nobody there ");
        put_span(out, c->break_s[i][0], c->break_s[i][1]);
    }
    put_zone(out, c, end_s);
}

static void put_machine_days(fw_text *out, const fw_schedule_calendar *c) {
    for (int day = 0; day < 7 && c->closed_days; day++)
        if (!(c->closed_days >> day & 1u)) fw_text_printf(out, "%s ", fw_schedule_weekday[day]);
    if (!c->breaks) put_span(out, c->open_s, c->close_s);
    for (int i = 0; i <= c->breaks && c->breaks; i++) {
        fw_text_add(out, i ? ", " : "");
        put_span(out, i ? c->break_s[i - 1][1] : c->open_s,
                 i == c->breaks ? c->close_s : c->break_s[i][0]);
    }
}

/* "rie is open Tue Thu 09:00 to 13:00"; nothing for a machine without hours */
static void put_hours(fw_text *out, const fw_schedule_shop *shop, int machine) {
    const fw_schedule_machine *m = &shop->machine[machine];
    if (!m->nhours && !m->nclosed) return;
    fw_text_add(out, " ");
    fw_text_escaped(out, m->id);
    fw_text_add(out, " is ");
    for (int i = 0; i < m->nhours; i++) {
        fw_text_add(out, i ? ", and " : "open ");
        put_machine_days(out, &m->hours[i]);
    }
    for (int i = 0; i < m->nclosed; i++) {
        fw_text_add(out, i || m->nhours ? ", closed from " : "closed from ");
        fw_recipe_put_moment(out, &shop->calendar, m->closed_s[i][0]);
        fw_text_add(out, " to ");
        fw_recipe_put_moment(out, &shop->calendar, m->closed_s[i][1]);
    }
    fw_text_add(out, ".");
}

static void put_percent(fw_text *out, double part) {
    char text[32];
    fw_text_printf(out, "%s %%", fw_percent_text(text, sizeof text, part));
}

/* the steps whose time is not known, or is the user's own */
static void put_steps(fw_text *out, const fw_schedule_shop *shop, bool stated) {
    int n = 0;
    for (int i = 0; i < shop->ntask; i++)
        if (stated ? shop->task[i].stated : shop->task[i].unknown) {
            fw_text_add(out, n++ ? ", " : "");
            fw_text_escaped(out, shop->task[i].id);
        }
}

static const char *bound_words(const fw_schedule *s) {
    const fw_schedule_bound *b = &s->bound;
    if (b->best_s <= b->path_s) return "one wafer alone, with its holds and the working day";
    return b->best_s <= b->machine_s ? s->shop->machine[b->machine].title
                                     : "everything that somebody must stand by";
}

void fw_recipe_put_schedule_summary(fw_text *out, const fw_schedule *s) {
    const fw_schedule_shop *shop = s->shop;
    int stated = 0;
    for (int i = 0; i < shop->ntask; i++)
        stated += shop->task[i].stated;
    fw_text_printf(out, "%d wafer%s, %d operator%s, ", shop->wafers, shop->wafers > 1 ? "s" : "",
                   shop->operators, shop->operators > 1 ? "s" : "");
    put_day(out, &shop->calendar, s->feasible ? s->start_s + s->makespan_s : 0.0);
    if (!s->feasible) {
        fw_text_add(out, ": there is no schedule. ");
        fw_text_escaped(out, s->why ? s->why : "");
        fw_text_add(out, ".");
        return;
    }
    fw_text_printf(out, ": %s", s->unknown ? "at least " : "");
    fw_schedule_put_duration(out, s->makespan_s);
    fw_text_add(out, ", until ");
    fw_recipe_put_moment(out, &s->shop->calendar, s->start_s + s->makespan_s);
    fw_text_add(out, ". No schedule is shorter than ");
    fw_schedule_put_duration(out, s->bound.best_s);
    fw_text_add(out, " (");
    fw_text_escaped(out, bound_words(s));
    if (s->optimal)
        fw_text_add(out, "): this one is shortest.");
    else {
        fw_text_add(out, "); this one is ");
        put_percent(out, s->gap);
        fw_text_add(out, " above that.");
    }
    for (int i = 0; i < shop->nmachine; i++)
        put_hours(out, shop, i);
    if (s->unknown) {
        fw_text_add(out, " The times of ");
        put_steps(out, shop, false);
        fw_text_add(out, " are not known: they are counted with the time that somebody must stand "
                         "by, and nothing more.");
    }
    if (stated) {
        fw_text_add(out, " The times of ");
        put_steps(out, shop, true);
        fw_text_add(out, " are planning times of the user.");
    }
    if (s->late) {
        fw_text_add(out, " When every step runs to its stop time: ");
        fw_text_escaped(out, s->late);
        fw_text_add(out, ".");
    }
}

/* ---- times as they are written in a log ---- */

static bool digits(const char *s, int n, int *value) {
    *value = 0;
    for (int i = 0; i < n; i++) {
        if (s[i] < '0' || s[i] > '9') return false;
        *value = 10 * *value + (s[i] - '0');
    }
    return true;
}

/* "Z", "+02:00", " UTC", " UTC+02:00"; nothing: not said */
static bool ahead_read(const char *s, double *ahead_s) {
    int hour, minute;
    *ahead_s = (double)NAN;
    if (!*s) return true;
    *ahead_s = 0.0;
    if (strcmp(s, "Z") == 0 || strcmp(s, " UTC") == 0) return true;
    if (strncmp(s, " UTC", 4) == 0) s += 4;
    if ((*s != '+' && *s != '-') || strlen(s) != 6 || s[3] != ':' || !digits(s + 1, 2, &hour) ||
        !digits(s + 4, 2, &minute) || minute > 59)
        return false;
    *ahead_s = (*s == '-' ? -1.0 : 1.0) * (3600.0 * hour + 60.0 * minute);
    return *ahead_s >= -12.0 * 3600.0 && *ahead_s <= 14.0 * 3600.0;
}

bool fw_recipe_asrun_time_read(const char *s, double *time_s, double *ahead_s) {
    int hour, minute, second = 0;
    long day;
    if (strlen(s) < 16 || !fw_quantity_date_parse(s, &day) || s[10] != 'T' || s[13] != ':')
        return false;
    if (!digits(s + 11, 2, &hour) || !digits(s + 14, 2, &minute)) return false;
    const bool seconds = s[16] == ':';
    if (seconds && !digits(s + 17, 2, &second)) return false;
    if (hour > 23 || minute > 59 || second > 59) return false;
    *time_s = 86400.0 * (double)day + 3600.0 * hour + 60.0 * minute + second;
    return ahead_read(s + (seconds ? 19 : 16), ahead_s);
}

/* ---- is it within its limits? ---- */

const char *const fw_recipe_site_name[FW_RECIPE_SITES] = {"centre", "top", "left", "bottom",
                                                          "right"};

double fw_recipe_asrun_limit(const char *text, double absent) {
    double value;
    return text[0] && fw_number_parse(text, strlen(text), &value) ? value : absent;
}

bool fw_recipe_asrun_inside(const char *low, const char *high, double value) {
    return value >= fw_recipe_asrun_limit(low, -(double)INFINITY) &&
           value <= fw_recipe_asrun_limit(high, (double)INFINITY);
}

bool fw_recipe_asrun_allowed(const fw_recipe_set *set) {
    return isnan(set->value) || fw_recipe_asrun_inside(set->low, set->high, set->value);
}

const fw_process_accept *fw_recipe_asrun_accept(const fw_process_step *step, const char *measure) {
    for (int i = 0; i < step->naccept; i++)
        if (strcmp(step->accept[i].measure, measure) == 0) return &step->accept[i];
    return NULL;
}

bool fw_recipe_asrun_accepted(const fw_recipe_measured *m) {
    if (isnan(m->number)) return !strstr(m->value, "no"); /* yes, at every site */
    bool all = true;
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        all &= isnan(m->site[i]) || fw_recipe_asrun_inside(m->low, m->high, m->site[i]);
    return all;
}

const fw_recipe_measured *fw_recipe_asrun_not_accepted(const fw_recipe_asrun_entry *o) {
    for (int i = 0; i < o->nmeasured; i++)
        if (!fw_recipe_asrun_accepted(&o->measured[i])) return &o->measured[i];
    return NULL;
}

static const char limits_of[] = "limits of ";

bool fw_recipe_asrun_is_limits(const char *name) {
    return strncmp(name, limits_of, sizeof limits_of - 1) == 0;
}

static void put_limits_of(const char *before, const char *name, const char *low, const char *high,
                          double planned, const char *unit, fw_text *out) {
    fw_text_printf(out, "\t%s%s%s=%s %s ", limits_of, before, name, low[0] ? low : "-",
                   high[0] ? high : "-");
    if (isnan(planned))
        fw_text_add(out, "-");
    else
        fw_text_number(out, planned, FW_PLAIN_DIGITS);
    fw_text_printf(out, " %s", unit);
}

void fw_recipe_asrun_put_limits(const fw_recipe_asrun_entry *e, fw_text *out) {
    for (const fw_recipe_measured *m = e->measured; m < e->measured + e->nmeasured; m++)
        if (!isnan(m->number))
            put_limits_of("", m->measure, m->low, m->high, (double)NAN,
                          fw_recipe_asrun_accept(e->step, m->measure)->unit, out);
    for (const fw_recipe_set *s = e->set; s < e->set + e->nset; s++)
        if (s->q && !isnan(s->value))
            put_limits_of("set ", s->name, s->low, s->high, s->planned, s->q->unit, out);
}

/* a number of a line in the unit that the flow has now; "-": "" */
static const char *in_unit(fw_arena *arena, fw_word word, const fw_quantity_unit *is,
                           const fw_quantity_unit *want) {
    double value;
    fw_text text = fw_text_new(arena);
    if (fw_word_is(word, "-")) return "";
    if (!fw_number_parse(word.at, word.length, &value)) return NULL;
    if (!want) return fw_arena_strndup(arena, word.at, word.length);
    value = fw_quantity_unit_from_si(want, fw_quantity_unit_to_si(is, value));
    fw_text_number(&text, value, FW_PLAIN_DIGITS);
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

fw_status fw_recipe_asrun_take_limits(fw_arena *arena, fw_recipe_asrun_entry *e, const char *name,
                                      const char *text) {
    const char *unit = NULL, *number[3];
    fw_recipe_measured *m = NULL;
    fw_recipe_set *s = NULL;
    fw_quantity_unit is, want;
    fw_word word[3];
    name += sizeof limits_of - 1;
    for (int i = 0; i < e->nmeasured; i++)
        if (strcmp(e->measured[i].measure, name) == 0) m = &e->measured[i];
    for (int i = 0; i < e->nset && strncmp(name, "set ", 4) == 0; i++)
        if (strcmp(e->set[i].name, name + 4) == 0 && e->set[i].q) s = &e->set[i];
    if (!m && !s) return FW_OK;
    for (int i = 0; i < 3; i++)
        if (!fw_word_next(&text, " ", &word[i])) return FW_OK;
    text += strspn(text, " ");
    unit = m ? fw_recipe_asrun_accept(e->step, name)->unit : s->q->unit;
    const bool same = strcmp(unit, text) == 0;
    if (!same && (!fw_quantity_unit_parse(text, strlen(text), &is, NULL, NULL) ||
                  !fw_quantity_unit_parse(unit, strlen(unit), &want, NULL, NULL) ||
                  !fw_quantity_dimension_equal(is.dimension, want.dimension)))
        return FW_OK; /* it is another thing now */
    for (int i = 0; i < 3; i++)
        FW_NEED(number[i] = in_unit(arena, word[i], &is, same ? NULL : &want));
    e->limited = true;
    *(m ? &m->low : &s->low) = number[0];
    *(m ? &m->high : &s->high) = number[1];
    if (s) s->planned = fw_recipe_asrun_limit(number[2], (double)NAN);
    return FW_OK;
}

static void put_with_unit(fw_text *out, double value, const char *unit) {
    fw_recipe_put_value(out, value);
    if (strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
}

void fw_recipe_asrun_put_out(const fw_recipe_measured *m, const char *unit, fw_text *out) {
    for (int k = 0, n = 0; k < FW_RECIPE_SITES; k++) {
        if (isnan(m->site[k]) || fw_recipe_asrun_inside(m->low, m->high, m->site[k])) continue;
        fw_text_add(out, n++ ? ", " : "");
        put_with_unit(out, m->site[k], unit);
        if (m->nsite > 1) fw_text_printf(out, " (%s)", fw_recipe_site_name[k]);
    }
}

void fw_recipe_asrun_put_set(const fw_recipe_set *s, fw_text *out) {
    if (!s->q || isnan(s->value)) {
        fw_text_add(out, s->text);
        return;
    }
    put_with_unit(out, s->value, s->q->unit);
    const size_t number = strcspn(s->text, " ");
    const char *written = s->text + number + strspn(s->text + number, " ");
    const char *unit = *written ? fw_recipe_unit_of_printed(out->arena, written) : s->q->unit;
    if (unit && strcmp(unit, s->q->unit) != 0) fw_text_printf(out, " (written %s)", s->text);
}

/* "48 to 52", "at most 52" */
void fw_recipe_put_span(fw_text *out, const char *low, const char *high) {
    const char *between = low[0] && high[0] ? " to " : low[0] ? " or more" : "at most ";
    fw_text_printf(out, "%s%s%s", low, between, high);
}

void fw_recipe_asrun_put_taken(const fw_recipe_asrun_entry *e, double time_s, fw_text *out) {
    for (int i = 0; i < e->step->nexposed && fw_process_step_runs_on(e->step); i++) {
        const fw_process_exposed *x = &e->step->exposed[i];
        char um[32];
        if (!x->rate || x->rate->unknown || !(x->rate->value > 0.0)) continue;
        fw_text_printf(out, "; up to %s um of %s where it is open",
                       fw_number_text(um, sizeof um, 1e6 * x->rate->value * time_s, 3),
                       x->material);
    }
}

/* the amount that the law takes; NULL: its time is not that of an outcome (a bake, a spin) */
const fw_process_argument *fw_recipe_asrun_amount_of_law(const fw_process_step *s) {
    for (int i = 0; i < s->nargument; i++) {
        const fw_process_argument *a = &s->argument[i];
        if (strcmp(a->name, "thickness") != 0 && strcmp(a->name, "depth") != 0) continue;
        for (int k = 0; k < s->nchange; k++)
            if (s->change[k].thickness == a->q) return a;
    }
    return NULL;
}

/* what was measured of it, SI; NaN: nothing */
double fw_recipe_asrun_amount_measured(const fw_recipe_asrun_entry *e, const fw_quantity *planned,
                                       const fw_recipe_measured **as) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, e->measured[i].measure);
        fw_quantity_unit unit;
        if (!a || isnan(e->measured[i].number) || !a->low[0] || !a->high[0] ||
            !fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) ||
            !fw_quantity_dimension_equal(unit.dimension, planned->dimension) ||
            !fw_recipe_asrun_inside(a->low, a->high,
                                    fw_quantity_unit_from_si(&unit, planned->value)))
            continue;
        *as = &e->measured[i];
        return fw_quantity_unit_to_si(&unit, e->measured[i].number);
    }
    return (double)NAN;
}

/* "temperature = 32 Cel" of whatever the entry says that was set otherwise */
void fw_recipe_asrun_put_settings(fw_text *out, const fw_recipe_asrun_entry *e) {
    const char *between = "";
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        if (!s->q || isnan(s->value) || (!s->q->unknown && s->value == fw_quantity_in_unit(s->q)))
            continue;
        fw_text_printf(out, "%s%s = ", between, s->name);
        put_with_unit(out, s->value, s->q->unit);
        between = ", ";
    }
}

fw_status fw_recipe_asrun_odd_time(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, const char **planned) {
    static const double times = 2.0, day_s = 8.0 * 3600.0;
    const double took = e->end_s - e->start_s, clock_s = fw_recipe_asrun_clock_s(e);
    double least = (double)INFINITY, most = 0.0;
    *planned = NULL;
    if (!e->step || e->as_set->time.computable || !fw_process_step_runs_on(e->step)) return FW_OK;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++) {
        if (o->step != e->step || fw_text_same(o->wafer, e->wafer) ||
            fw_recipe_asrun_taken_back(run, o) || !fw_recipe_asrun_is_last(run, o))
            continue;
        least = fmin(least, o->end_s - o->start_s), most = fmax(most, o->end_s - o->start_s);
    }
    const bool other = most > 0.0;
    if (other ? took - clock_s <= times * most && took + clock_s >= least / times : took <= day_s)
        return FW_OK;
    fw_text text = fw_text_new(arena);
    const char *missing = fw_recipe_missing_list(arena, &e->as_set->time);
    FW_NEED(missing);
    fw_text_printf(&text, "no planned time%s%s%s; %s", *missing ? " (missing " : "", missing,
                   *missing ? ")" : "",
                   other ? "other wafers took " : "it took longer than a working day");
    if (other) fw_schedule_put_duration(&text, least);
    if (other && most > least) fw_text_add(&text, " to "), fw_schedule_put_duration(&text, most);
    FW_TRY(fw_text_end(&text));
    *planned = text.data;
    return FW_OK;
}
