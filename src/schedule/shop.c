/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shop of a computed flow. */
#include "process/process_law.h"
#include "schedule/place.h"
#include <math.h>
#include <string.h>

typedef struct making {
    fw_arena *arena;
    const fw_process_flow *flow;
    fw_diags *diags;
    fw_schedule_task *task;
    fw_schedule_machine *machine;
    fw_schedule_shop *shop;
} making;

static int step_index(const fw_process_flow *flow, const char *id, size_t n) {
    for (int i = 0; i < flow->nstep; i++)
        if (strlen(flow->step[i].id) == n && strncmp(flow->step[i].id, id, n) == 0) return i;
    return -1;
}

static int machine_of(making *m, const fw_process_step *s) {
    const char *id = s->equipment ? s->equipment->id : "",
               *title = s->equipment ? s->equipment->class_ : "no equipment named";
    for (int i = 0; i < m->shop->nmachine; i++)
        if (strcmp(m->machine[i].id, id) == 0) return i;
    m->machine[m->shop->nmachine] = (fw_schedule_machine){.id = id, .title = title, .places = 1};
    return m->shop->nmachine++;
}

static bool never_alone(const fw_process_step *s) {
    for (int i = 0; i < s->nhazard; i++)
        if (s->hazard[i]->buddy) return true;
    return false;
}

/* ---- how long baths keep ---- */

/* how long a filling may be used; INFINITY: nothing says it */
static double keeps_s(const fw_process_bath *bath) {
    return bath && bath->keeps && !bath->keeps->unknown ? bath->keeps->value : (double)INFINITY;
}

/* for how many wafers, one after the other; INFINITY: for all of a lot, or nobody knows */
static double serves(const fw_process_bath *bath) {
    return bath->serves && !bath->serves->unknown ? floor(bath->serves->value + 1e-9)
                                                  : (double)INFINITY;
}

/* how often the step is in the bath */
static int uses(const fw_process_step *s, const fw_process_bath *bath) {
    int n = 0;
    for (int k = 0; k < s->nuse; k++)
        n += s->use[k].bath == bath;
    return n;
}

/* The bath that the step mixes where each filling of a lot is mixed when its wafers need it, since it keeps only so long: for `serves`
   wafers, that are in it once. NULL: all are mixed at once */
static const fw_process_bath *mixed_in_time(const fw_process_flow *flow, const fw_process_step *s) {
    const fw_process_bath *bath = fw_process_step_mixes(flow, s);
    int passes = 0;
    if (!bath || !isfinite(keeps_s(bath)) || !(serves(bath) >= 1.0)) return NULL;
    for (const fw_process_step *k = flow->step; k < flow->step + flow->nstep; k++)
        passes += uses(k, bath);
    return passes == 1 && isfinite(serves(bath)) ? bath : NULL;
}

/* Most wafers of a lot that the step may mix one filling for, each of them as often in it as the flow says; 0: it mixes none, or
   one wafer takes several. Where nobody knows how many it serves these are all */
static int most_served(const fw_process_flow *flow, const fw_process_step *s, int wafers) {
    const fw_process_bath *bath = fw_process_step_mixes(flow, s);
    int passes = 0;
    for (const fw_process_step *k = flow->step; bath && k < flow->step + flow->nstep; k++)
        passes += uses(k, bath);
    return passes > 0 ? (int)fmin(wafers, floor(serves(bath) / passes + 1e-9)) : 0;
}

static void make_task(making *m, int index) {
    const fw_process_step *s = &m->flow->step[index];
    fw_schedule_task *t = &m->task[index];
    *t = (fw_schedule_task){.id = s->id,
                            .title = s->title,
                            .machine = machine_of(m, s),
                            .attended_s = s->attended_s,
                            .duration_s = s->attended_s,
                            .latest_s = s->attended_s,
                            .lot = fw_process_step_is_of_lot(s),
                            .by_day = never_alone(s),
                            .in_parts = s->pulse && s->pause && s->attended_s > 0.0,
                            .at_end = s->attended_s > 0.0 && fw_process_step_is_ended(s),
                            .unknown = !s->time.computable};
    const fw_process_bath *mixed = mixed_in_time(m->flow, s);
    if (mixed && serves(mixed) < m->shop->wafers) t->lot = false, t->filling = true;
    t->alone = strcmp(s->op, "hold") == 0 && s->attended_s <= 0.0 && !t->lot && !t->filling;
    t->load = t->alone     ? 1
              : t->lot     ? m->shop->wafers
              : t->filling ? (int)serves(mixed)
                           : fw_process_step_load(s);
    t->load = t->load > m->shop->wafers ? m->shop->wafers : t->load;
    if (t->alone && s->equipment) m->machine[t->machine].places = s->equipment->capacity;
    const int times = /* a filling after another */
        fw_process_step_times(m->flow, s, t->filling ? t->load : m->shop->wafers);
    t->serves = most_served(m->flow, s, m->shop->wafers);
    t->fillings = times;
    t->attended_s *= times;
    t->duration_s = t->latest_s = t->attended_s;
    if (t->unknown) return;
    t->duration_s = s->booked_s * times;
    t->latest_s = s->booked_stop_s * times;
}

static fw_status wrong(making *m, const char *part, size_t n, const char *what) {
    const char *text = fw_arena_strndup(m->arena, part, n);
    FW_NEED(text);
    fw_diag_error(m->diags, 199, (fw_place){0}, "planning time '%s' %s", text, what);
    return FW_USAGE;
}

/* "S03=90 min" */
static fw_status planned_one(making *m, const char *part, size_t n) {
    const char *equals = memchr(part, '=', n);
    if (!equals) return wrong(m, part, n, "is not STEP=TIME, for example S03=90 min");
    const char *number = equals + 1, *end = part + n, *unit_text = number;
    while (unit_text < end && strchr("+-.0123456789eE", *unit_text))
        unit_text++;
    size_t digits = (size_t)(unit_text - number);
    while (unit_text < end && *unit_text == ' ')
        unit_text++;
    int step = step_index(m->flow, part, (size_t)(equals - part));
    if (step < 0) return FW_OK; /* of another flow: looked at by fw_schedule_make's caller */
    fw_quantity_unit unit;
    double value;
    if (!fw_number_parse(number, digits, &value) || !(value >= 0.0) ||
        !fw_quantity_unit_parse(unit_text, (size_t)(end - unit_text), &unit, NULL, NULL) ||
        !fw_quantity_dimension_equal(unit.dimension, (fw_quantity_dimension){.s = 1}))
        return wrong(m, part, n, "is not a time with its unit, for example S03=90 min");
    double seconds = fw_quantity_unit_to_si(&unit, value);
    fw_schedule_task *t = &m->task[step];
    if (!(seconds <= 30.0 * 86400.0)) return wrong(m, part, n, "is longer than 30 days");
    const fw_process_law *law = fw_process_law_find(m->flow->step[step].law);
    if (!t->unknown && law && !law->stated) {
        char given[32], computed[32];
        fw_diag_warning(m->diags, 199, m->flow->step[step].place,
                        "the planning time of step %s, %s min, takes the place of a computed one "
                        "of %s min in schedule and calendar; the sheet keeps the computed window: "
                        "leave the planning time out, or correct what it is computed from",
                        m->flow->step[step].id,
                        fw_number_text(given, sizeof given, seconds / 60, 4),
                        fw_number_text(computed, sizeof computed, t->duration_s / 60, 4));
    }
    t->duration_s = t->latest_s = fmax(seconds, t->attended_s);
    t->unknown = false;
    t->stated = true;
    return FW_OK;
}

static fw_status planned(making *m, const char *list) {
    while (list && *list) {
        size_t n = strcspn(list, ",");
        FW_TRY(planned_one(m, list, n));
        list += n + (list[n] == ',');
    }
    return FW_OK;
}

/* a pause this long is never over night */
static double same_day_s(const making *m) {
    const fw_schedule_calendar *c = &m->shop->calendar;
    return fw_schedule_calendar_round(c) ? 8.0 * 3600.0 : 86400.0 - (c->close_s - c->open_s) - 1.0;
}

static fw_status make_holds(making *m, fw_schedule_hold **list) {
    int n = 2 * m->flow->nstep + m->flow->nwait;
    for (int i = 0; i < m->flow->nstep; i++)
        n += m->flow->step[i].nlag;
    FW_NEED(*list = fw_arena_array(m->arena, fw_schedule_hold, (size_t)n));
    for (int i = 0; i < m->flow->nstep; i++)
        for (int k = 0; k < m->flow->step[i].nlag; k++) {
            const fw_process_lag *lag = &m->flow->step[i].lag[k];
            int from = step_index(m->flow, lag->from, strlen(lag->from));
            if (from < 0) continue; /* the pack was refused for it */
            (*list)[m->shop->nhold++] =
                (fw_schedule_hold){.from = from,
                                   .to = i,
                                   .min_s = isnan(lag->min_s) ? -(double)INFINITY : lag->min_s,
                                   .max_s = isnan(lag->max_s) ? (double)INFINITY : lag->max_s};
        }
    for (int i = 0; i + 1 < m->flow->nstep; i++)
        if (m->task[i].by_day && m->task[i + 1].by_day)
            (*list)[m->shop->nhold++] = (fw_schedule_hold){.from = i,
                                                           .to = i + 1,
                                                           .min_s = -(double)INFINITY,
                                                           .max_s = same_day_s(m),
                                                           .implied = true};
    for (int i = 0; i < m->flow->nwait; i++) {
        const fw_process_wait *w = &m->flow->wait[i];
        (*list)[m->shop->nhold++] = (fw_schedule_hold){.from = w->from,
                                                       .to = w->to,
                                                       .min_s = -(double)INFINITY,
                                                       .max_s = w->max_s,
                                                       .implied = true,
                                                       .first_only = w->first_only,
                                                       .why = w->is};
    }
    for (int i = 0; i < m->flow->nstep; i++) {
        const fw_process_bath *bath = fw_process_step_mixes(m->flow, &m->flow->step[i]);
        if (!bath || !isfinite(keeps_s(bath)) || (bath->serves && bath->serves->unknown)) continue;
        for (int k = i + 1; k < m->flow->nstep; k++) {
            if (uses(&m->flow->step[k], bath) == 0) continue;
            const char *keeps =
                fw_arena_printf(m->arena, "a filling of %s, mixed in %s, keeps no longer (%s)",
                                bath->name, m->flow->step[i].id, bath->keeps->id);
            FW_NEED(keeps);
            (*list)[m->shop->nhold++] = (fw_schedule_hold){.from = i,
                                                           .to = k,
                                                           .min_s = -(double)INFINITY,
                                                           .max_s = keeps_s(bath),
                                                           .implied = true,
                                                           .keeps = keeps};
        }
    }
    return FW_OK;
}

/* the shop of a computed flow. FW_USAGE with FW-D199 for options that do not fit */
static fw_status shop_of(fw_arena *arena, const fw_process_flow *flow,
                         const fw_schedule_options *options, fw_diags *diags,
                         const fw_schedule_shop **shop) {
    making m = {.arena = arena, .flow = flow, .diags = diags};
    fw_schedule_hold *hold;
    FW_NEED(m.shop = fw_arena_one(arena, fw_schedule_shop));
    m.shop->wafers = options->wafers > 0 ? options->wafers : 1;
    m.shop->operators = options->operators > 0 ? options->operators : 1;
    if (!fw_schedule_calendar_parse(options->day ? options->day : FW_WORKING_DAY,
                                    &m.shop->calendar)) {
        fw_diag_error(diags, 199, (fw_place){0},
                      "working day '%s' is not like 08:00-18:00, 08:00-12:00,13:00-18:00, or none "
                      "for round the clock; "
                      "a first day stands behind it: 08:00-18:00 from 2026-11-23",
                      options->day);
        return FW_USAGE;
    }
    m.shop->calendar.undated = options->undated;
    m.shop->ntask = flow->nstep;
    FW_NEED(m.task = fw_arena_array(arena, fw_schedule_task, (size_t)flow->nstep));
    FW_NEED(m.machine = fw_arena_array(arena, fw_schedule_machine, (size_t)flow->nstep));
    for (int i = 0; i < flow->nstep; i++)
        make_task(&m, i);
    FW_TRY(planned(&m, options->planned));
    FW_TRY(make_holds(&m, &hold));
    FW_TRY(fw_schedule_tool_hours(arena, flow, &m.shop->calendar, m.machine, m.shop->nmachine,
                                  m.task, m.shop->ntask, diags));
    m.shop->task = m.task;
    m.shop->machine = m.machine;
    m.shop->hold = hold;
    for (int i = 0; i < flow->nstep;
         i++) /* else nobody could run it at all: it is looked at when there is somebody */
        if (m.task[i].in_parts && isinf(fw_schedule_alone_fit(m.shop, i, 0.0)))
            m.task[i].in_parts = false;
    *shop = m.shop;
    return FW_OK;
}

/* ---- what a schedule does not see to: FW-D739 ---- */

typedef struct last_use { /* of a filling, and of what is farthest behind it */
    double from_s, age_s;
    const char *task;
    int wafer; /* from 0 */
    bool mixed;
} last_use;

/* when what the wafer is in at a run was mixed by a step of the flow; NaN: none does that */
static double mixed_at(const fw_schedule *s, const fw_process_flow *flow,
                       const fw_process_bath *bath, int wafer) {
    for (int i = 0; i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        if (fw_process_step_mixes(flow, &flow->step[r->task]) == bath && wafer >= r->first &&
            wafer < r->first + r->count)
            return r->end_s;
    }
    return (double)NAN;
}

/* Where a bath is not mixed in a step of the flow its fillings serve so many wafers in the order in which these come, each from its
   first use on; without a number one serves all wafers of a step. The use that is longest behind */
static last_use worst_use(const fw_schedule *s, const fw_process_flow *flow,
                          const fw_process_bath *bath) {
    last_use worst = {.age_s = -1.0};
    double first_s = 0.0, most = serves(bath), n = 0.0;
    int of = -1;
    for (int i = 0; i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        for (int w = r->first; w < r->first + r->count * (uses(&flow->step[r->task], bath) > 0);
             w++) {
            const double at = mixed_at(s, flow, bath, w);
            if (n == 0.0 || n >= most || (isinf(most) && of != r->task))
                first_s = r->start_s, n = 0.0;
            of = r->task, n += 1.0;
            const double from_s = isnan(at) ? first_s : at;
            if (r->start_s - from_s > worst.age_s)
                worst =
                    (last_use){from_s, r->start_s - from_s, flow->step[r->task].id, w, !isnan(at)};
        }
    }
    return worst;
}

static fw_status ask_baths(const fw_schedule *s, const fw_process_flow *flow, fw_diags *diags) {
    for (const fw_process_bath *bath = flow->bath; bath < flow->bath + flow->nbath; bath++) {
        if (!isfinite(keeps_s(bath))) continue;
        const last_use use = worst_use(s, flow, bath);
        if (!(use.age_s > keeps_s(bath) + 1.0)) continue;
        fw_text text = fw_text_new(diags->arena);
        fw_schedule_put_duration(&text, keeps_s(bath));
        fw_text_printf(&text, " (%s), and this schedule has wafer %d in it, in %s, ",
                       bath->keeps->id, use.wafer + 1, use.task);
        fw_schedule_put_duration(&text, use.age_s);
        fw_text_printf(&text, " after it was %s", use.mixed ? "mixed" : "first used");
        FW_TRY(fw_text_end(&text));
        fw_diag_warning(diags, 739, flow->place,
                        "flow '%s': a filling of %s keeps for %s: mix one more for it, which the "
                        "amounts of the sheet do not count",
                        flow->id, bath->name, text.data);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- a filling for fewer wafers than it serves: FW-D758 ----
   Where no order is found each filling is mixed for at most n wafers, n the largest of which those of one filling alone come
   through the flow, then fewer. Test: test_tools.c, mixed_oftener */

static fw_status mixed_for(fw_arena *arena, const fw_schedule_shop *of, int n, int wafers,
                           fw_schedule_shop **out) {
    fw_schedule_task *task = fw_arena_array(arena, fw_schedule_task, (size_t)of->ntask);
    FW_NEED(task);
    FW_NEED(*out = fw_arena_one(arena, fw_schedule_shop));
    **out = *of;
    (*out)->task = task;
    (*out)->wafers = wafers;
    (*out)->soon = true;
    for (int i = 0; i < of->ntask; i++) {
        fw_schedule_task *t = &task[i];
        *t = of->task[i];
        if (t->serves > 0) {
            t->filling = true;
            t->lot = false;
            t->load = n < t->serves ? n : t->serves;
            t->duration_s /= t->fillings;
            t->latest_s /= t->fillings;
            t->attended_s /= t->fillings;
            t->fillings = 1;
        }
        t->load = t->lot || t->load > wafers ? wafers : t->load;
    }
    return FW_OK;
}

/* do n wafers, of one filling, come through the flow where the lot has no more? or all of the lot, n of them of each filling */
static fw_status comes_through(fw_arena *arena, const fw_schedule_shop *of, int n, int wafers,
                               bool *found) {
    fw_mark mark = fw_arena_mark(arena);
    fw_schedule_shop *shop;
    FW_TRY(mixed_for(arena, of, n, wafers, &shop));
    FW_TRY(fw_schedule_is_found(arena, shop, found));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* the largest n of which one filling's wafers come through, by halves: what n of them do fewer do, too; 1 where none do */
static fw_status most_at_once(fw_arena *arena, const fw_schedule_shop *of, int most, int *n) {
    int fails = most + 1;
    *n = 1;
    for (int next = 2; fails - *n > 1; next = fails > most ? 2 * *n : (*n + fails) / 2) {
        bool found;
        next = next > most ? most : next;
        FW_TRY(comes_through(arena, of, next, next, &found));
        if (found)
            *n = next;
        else
            fails = next;
    }
    return FW_OK;
}

static fw_status tell_oftener(const fw_schedule *s, const fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < s->shop->ntask; i++) {
        const fw_schedule_task *t = &s->shop->task[i];
        const fw_process_bath *bath =
            t->filling ? fw_process_step_mixes(flow, &flow->step[i]) : NULL;
        if (!bath || t->load >= t->serves) continue;
        int runs = 0;
        for (int k = 0; k < s->nrun; k++)
            runs += s->run[k].task == i;
        fw_diag_warning(
            diags, 758, flow->step[i].place,
            "flow '%s': step %s mixes %d fillings of %s, each for at most %d wafer%s of %d "
            "that it might serve%s%s%s: with fewer fillings no order was found that keeps "
            "all windows; the amounts of the sheet count them",
            flow->id, t->id, runs, bath->name, t->load, t->load == 1 ? "" : "s", t->serves,
            bath->serves ? " (" : "", bath->serves ? bath->serves->id : "",
            bath->serves ? ")" : "");
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

static fw_status say_tried(fw_arena *arena, const fw_schedule_shop *shop, fw_schedule *s) {
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, s->why);
    for (int i = 0, n = 0; i < shop->ntask; i++)
        if (shop->task[i].serves > 0)
            fw_text_printf(&text, "%s%s",
                           n++ > 0 ? " and "
                                   : "; a filling for every wafer by itself was tried, too, in ",
                           shop->task[i].id);
    FW_TRY(fw_text_end(&text));
    s->why = text.data;
    return FW_OK;
}

static fw_status mix_oftener(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                             fw_schedule *s) {
    int most = 0, n;
    for (int i = 0; i < shop->ntask; i++)
        most = shop->task[i].serves > most ? shop->task[i].serves : most;
    if (most == 0) return FW_OK;
    FW_TRY(most_at_once(arena, shop, most, &n));
    for (; n > 0; n = n > 6 ? n / 2 : n - 1) {
        bool found = n == 1; /* of which other hours are tried, too */
        if (!found) FW_TRY(comes_through(arena, shop, n, shop->wafers, &found));
        if (!found) continue;
        fw_schedule_shop *oftener;
        fw_schedule other;
        FW_TRY(mixed_for(arena, shop, n, shop->wafers, &oftener));
        FW_TRY(fw_schedule_solve(arena, oftener, effort, &other));
        if (other.feasible) {
            *s = other;
            return FW_OK;
        }
    }
    return s->bound.best_s > 0.0 ? say_tried(arena, shop, s) : FW_OK;
}

fw_status fw_schedule_make(fw_arena *arena, const fw_process_flow *flow,
                           const fw_schedule_options *options, fw_diags *diags,
                           const fw_schedule **schedule) {
    const fw_schedule_shop *shop;
    fw_schedule *s = fw_arena_one(arena, fw_schedule);
    FW_NEED(s);
    *schedule = s;
    FW_TRY(shop_of(arena, flow, options, diags, &shop));
    FW_TRY(fw_schedule_solve(arena, shop, options->effort, s));
    if (!s->feasible && s->pause_s) FW_TRY(mix_oftener(arena, shop, options->effort, s));
    if (!s->feasible && !s->pause_s)
        fw_diag_warning(diags, 196, flow->place, "flow '%s' cannot be run as it is written: %s",
                        flow->id, s->why);
    else if (!s->feasible)
        fw_diag_warning(diags, 197, flow->place, "flow '%s' has no schedule: %s", flow->id, s->why);
    else
        FW_TRY(ask_baths(s, flow, diags));
    if (s->feasible) FW_TRY(tell_oftener(s, flow, diags));
    return diags->failed ? FW_NOMEM : FW_OK;
}

const char *fw_schedule_wait_text(fw_schedule_wait wait) {
    static const char *const text[] = {"nothing",     "flow",       "machine",    "operator",
                                       "working day", "tool hours", "hold window"};
    return text[wait];
}

fw_status fw_schedule_loads(fw_arena *arena, const fw_schedule *plan, const fw_process_flow *flow,
                            const int **loads) {
    int *count;
    *loads = NULL;
    if (!plan || !plan->feasible) return FW_OK;
    int *of, at = 0; /* the step of every task: both stand in the order of the flow */
    FW_NEED(*loads = count = fw_arena_array(arena, int, (size_t)flow->nstep + 1));
    FW_NEED(of = fw_arena_array(arena, int, (size_t)plan->shop->ntask));
    for (int i = 0; i < plan->shop->ntask; i++) {
        while (at < flow->nstep && strcmp(flow->step[at].id, plan->shop->task[i].id) != 0)
            at++;
        of[i] = at;
    }
    for (int i = 0; i < plan->nrun; i++)
        count[of[plan->run[i].task]]++;
    return FW_OK;
}
