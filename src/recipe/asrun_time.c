/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long a step took against its window, at what was set; a thickness against the time that it took. */
#include "base/text.h"
#include "process/process_law.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* what is at the bench or the machine beside the step's own time, in every run of it */
static double handling_s(const fw_process_step *s) {
    return s->finish_s + s->booked_stop_s - s->booked_stop_own_s;
}

/* What the log has of a run, from its start to its end by the clock, holds pauses between the parts of the step, what finishes it
   at the bench, and what somebody's presence takes beyond that; or it is the step's own time, where the log has that alone */
typedef enum part { ALL_OF_IT, LESS_PAUSES, LESS_FINISHES, LESS_HANDLING } part;

/* Was the same run asked after before, and is now in the log with the same start and an earlier end? Then it is without its finishes,
   as was asked for */
static bool is_alone(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *o = run->entry; o < e; o++)
        if (o->step == e->step && fw_text_same(o->wafer, e->wafer) && o->start_s == e->start_s &&
            o->end_s > e->end_s && strcmp(fw_recipe_asrun_in_time(run, o), "unclear") == 0)
            return true;
    return false;
}

/* what the entry by itself, of one load where there are several, leaves of the step's own time; longer_s: what its clock may be off */
static double of_run(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, part less,
                     double longer_s) {
    int together;
    double left = (e->end_s - e->start_s) / fw_recipe_asrun_loads(run, e, &together) + longer_s;
    if (less == LESS_HANDLING) left -= handling_s(e->as_set);
    if (less == LESS_FINISHES && !is_alone(run, e)) left -= e->as_set->finish_s;
    return less == ALL_OF_IT ? left : fw_process_step_own_s(e->as_set, fmax(0.0, left));
}

/* the same of all runs that come to one, each as long as it would have been at what is set in e; clocks: 1 where each is longer by
   what its clock may be off */
static double of_runs(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, part less,
                      double clocks) {
    const double last_s = e->as_set->time.nominal_s;
    double sum_s = 0.0;
    for (const fw_recipe_asrun_entry *o = e; o; o = fw_recipe_asrun_goes_on_from(run, o)) {
        const double of_s = o->as_set->time.nominal_s, by = of_s > 0.0 ? last_s / of_s : 1.0;
        sum_s += by * of_run(run, o, less, clocks * fw_recipe_asrun_clock_s(o));
    }
    return sum_s;
}

/* ---- does what was measured go with the time that it took? ----
   Where the step's own law has the time of a thickness that the step adds or takes away, and what is accepted holds that
   thickness from both sides, time and reading say one thing twice. */

/* by the law of the step as it was set in the entry; amount: an argument of the step as planned */
static fw_status time_for(fw_arena *arena, const fw_recipe_asrun_entry *e,
                          const fw_process_argument *amount, double amount_m,
                          fw_process_law_answer *answer) {
    return fw_process_step_time_of(arena, e->as_set, (int)(amount - e->step->argument), amount_m,
                                   answer);
}

static fw_status amount_in(fw_arena *arena, const fw_recipe_asrun_entry *e,
                           const fw_process_argument *amount, double time_s, double *amount_m) {
    return fw_process_step_amount_in(arena, e->as_set, (int)(amount - e->step->argument), time_s,
                                     amount_m);
}

/* All runs that come to one with e, in the time that they would have taken at what is set in e: t_o T_e/T_o, T the time of the law
   for the amount that was measured. all_s of one load; least_s without what may be pauses and handling in each; *n how many.
   NaN: one of them had no such time */
static fw_status in_runs(fw_arena *arena, const fw_recipe_asrun *run,
                         const fw_recipe_asrun_entry *e, const fw_process_argument *amount,
                         double measured, double time_s, int *n, double *all_s, double *least_s) {
    *n = 0, *all_s = *least_s = 0.0;
    for (const fw_recipe_asrun_entry *o = e; o; o = fw_recipe_asrun_goes_on_from(run, o), ++*n) {
        fw_process_law_answer answer;
        FW_TRY(time_for(arena, o, amount, measured, &answer));
        const double by =
            answer.computable && answer.value > 0 ? time_s / answer.value : (double)NAN;
        *all_s += by * of_run(run, o, ALL_OF_IT, 0.0);
        *least_s += by * of_run(run, o, LESS_HANDLING, 0.0);
    }
    return FW_OK;
}

/* loads: that may share its time, one after the other; read_s: how far a clock may be off */
static fw_status amount_in_time(fw_arena *arena, const fw_recipe_asrun *run,
                                const fw_recipe_asrun_entry *e, double loads, double read_s,
                                fw_recipe_amount_in_time *out) {
    const fw_process_step *s = e->step;
    fw_process_law_answer answer;
    *out = (fw_recipe_amount_in_time){.fits = true};
    const fw_process_argument *amount =
        s && e->fate == FW_FATE_RUN ? fw_recipe_asrun_amount_of_law(s) : NULL;
    if (!amount || amount->q->unknown || !e->as_set->time.computable) return FW_OK;
    const double measured = fw_recipe_asrun_amount_measured(e, amount->q, &out->measured);
    if (!(measured > 0)) return FW_OK;
    FW_TRY(time_for(arena, e, amount, measured, &answer));
    if (!answer.computable || !(answer.value > 0)) return FW_OK;
    /* handling, pauses and what is finished at the machine may be in it or not */
    int n;
    double one_s, least_s;
    FW_TRY(in_runs(arena, run, e, amount, measured, answer.value, &n, &one_s, &least_s));
    if (isnan(one_s)) return FW_OK;
    const double off = s->k * answer.uncertainty / answer.value, actual_s = loads * one_s;
    read_s *= n;
    out->took_s = actual_s;
    const bool brief = actual_s + read_s < answer.value * (1.0 - off);
    if (!brief && least_s - read_s / loads <= answer.value * (1.0 + off) * (1.0 + s->overrun))
        return FW_OK;
    out->fits = false;
    out->law_m = measured;
    out->time_s = brief ? actual_s : least_s;
    out->off = off;
    out->formula = fw_process_law_find(s->law)->formula;
    return amount_in(arena, e, amount, out->time_s, &out->law_m);
}

/* ---- how long it took ---- */

static double booked_stop_s(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    int together;
    return e->as_set->booked_stop_s * fw_recipe_asrun_loads(run, e, &together);
}

double fw_recipe_asrun_stop_by(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               const fw_recipe_runs *runs, double *surely) {
    const double one = runs->n > 1 ? e->as_set->booked_stop_s : booked_stop_s(run, e);
    if (surely) *surely = one + (runs->n - 1) * handling_s(e->as_set);
    return one;
}

/* what the entry took, or all of its runs at what was set in it */
static double took_s(const fw_recipe_asrun_entry *e, const fw_recipe_runs *runs) {
    return runs->n > 1 ? runs->time_s : e->end_s - e->start_s;
}

/* A step is booked with its over-etch, its pauses and what is finished at the bench, and is logged from its start to its
   end, or to the end of the etch alone: short is below the first look, long above the stop time with all of that. */
static const char *by_the_window(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    const double actual_s = took_s(e, &runs), read_s = runs.n * fw_recipe_asrun_clock_s(e);
    double surely;
    if (!e->as_set->time.computable) return "no plan";
    if (actual_s + read_s < e->as_set->time.first_look_s) return "short";
    fw_recipe_asrun_stop_by(run, e, &runs, &surely);
    return actual_s - read_s > surely ? "long" : "in window";
}

/* Where what a step does goes on for as long as the wafer is in it (a bath, a current), handling may explain only so much: the
   stop time with its pauses, its finishes, a minute for each without a time; or what the plan books. Test: left_in_the_bath */
static bool is_left_in_it(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                          double *by_s) {
    static const double untimed_s = 60.0;
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    const fw_process_step *s = e->as_set;
    int together, untimed = 0;
    const double loads = runs.n > 1 ? 1.0 : fw_recipe_asrun_loads(run, e, &together);
    for (int i = 0; i < e->step->nfinish; i++)
        untimed += e->step->finish[i].time == NULL;
    *by_s = loads * (s->booked_stop_own_s + untimed * untimed_s) +
            (runs.n - 1) * (s->finish_s + untimed * untimed_s);
    if (runs.n == 1)
        *by_s = fmax(*by_s, loads * s->booked_s); /* nobody asks what went as scheduled */
    return s->time.computable && fw_process_step_runs_on(e->step) &&
           took_s(e, &runs) - runs.n * fw_recipe_asrun_clock_s(e) > *by_s;
}

/* do several runs come to more than one of them may take, unless each has its handling in it? */
static bool adds_up_to_more(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                            const fw_recipe_runs *runs) {
    double surely;
    const double stop = fw_recipe_asrun_stop_by(run, e, runs, &surely),
                 took = runs->time_s - runs->n * fw_recipe_asrun_clock_s(e);
    return runs->n > 1 && e->as_set->time.computable && took > stop && took <= surely;
}

/* Which of what may be in the entry leaves less than the first look, where the entry as a whole reaches it? ALL_OF_IT: none does. The
   log may have the step's own time alone */
static part left_too_short(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                           double *left_s) {
    const fw_process_time *last = &e->as_set->time;
    if (!last->computable || of_runs(run, e, ALL_OF_IT, 1.0) < last->first_look_s) return ALL_OF_IT;
    for (part less = LESS_PAUSES; less <= LESS_FINISHES; less++) {
        *left_s = of_runs(run, e, less, 0.0);
        if (of_runs(run, e, less, 1.0) < last->first_look_s) return less;
    }
    return ALL_OF_IT;
}

int fw_recipe_asrun_put_inside(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               fw_text *out) {
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    double left_s;
    const part less = left_too_short(run, e, &left_s);
    if (less == ALL_OF_IT) return 0;
    fw_text_add(out, "took "), fw_recipe_asrun_put_took(out, e, &runs);
    fw_text_printf(out, ", of which its %s leave ",
                   less == LESS_PAUSES ? "pauses"
                   : e->as_set->pulse  ? "pauses and finishes"
                                       : "finishes");
    fw_schedule_put_duration(out, left_s);
    fw_text_add(out, ", and the first look is at ");
    fw_schedule_put_duration(out, e->as_set->time.first_look_s);
    return less == LESS_PAUSES ? 732 : 759;
}

/* what was asked, and no later entry has answered, is not in its window */
const char *fw_recipe_asrun_in_time(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const char *judged = by_the_window(run, e);
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    double by_s, left_s;
    if (strcmp(judged, "in window") != 0) return judged;
    return fw_recipe_asrun_is_late_as_set(run, e) || adds_up_to_more(run, e, &runs) ||
                   is_left_in_it(run, e, &by_s) || left_too_short(run, e, &left_s) != ALL_OF_IT
               ? "unclear"
               : judged;
}

bool fw_recipe_asrun_put_left_in_it(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                    fw_text *out) {
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    double by_s;
    if (strcmp(by_the_window(run, e), "in window") != 0 || !is_left_in_it(run, e, &by_s))
        return false;
    fw_text_add(out, "took ");
    fw_recipe_asrun_put_took(out, e, &runs);
    fw_text_add(out, ", and is to stop by ");
    fw_schedule_put_duration(out, e->as_set->time.stop_s);
    fw_text_add(out, ", with what is finished at the bench by ");
    fw_schedule_put_duration(out, by_s);
    return true;
}

/* As the planned settings judge it, it may have ended with its etch; as it was set, that was to stop before */
bool fw_recipe_asrun_is_late_as_set(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const fw_process_time *planned = &e->step->time, *set = &e->as_set->time;
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    int together;
    const double loads = runs.n > 1 ? 1.0 : fw_recipe_asrun_loads(run, e, &together),
                 actual_s = took_s(e, &runs) - runs.n * fw_recipe_asrun_clock_s(e);
    return e->as_set != e->step && !e->former && set->computable &&
           actual_s > loads * set->stop_s &&
           (!planned->computable || actual_s <= loads * planned->stop_s) &&
           strcmp(by_the_window(run, e), "in window") == 0;
}

static bool is_out_of_time(const char *judged) {
    return strcmp(judged, "short") == 0 || strcmp(judged, "long") == 0;
}

void fw_recipe_asrun_put_took(fw_text *out, const fw_recipe_asrun_entry *e,
                              const fw_recipe_runs *runs) {
    fw_schedule_put_duration(out, runs->n > 1 ? runs->took_s : e->end_s - e->start_s);
    if (runs->n < 2) return;
    fw_text_printf(out, " in %d runs", runs->n);
    if (fabs(runs->took_s - runs->time_s) < 0.5) return;
    fw_text_add(out, ", which are ");
    fw_schedule_put_duration(out, runs->time_s);
    fw_text_add(out, " at what was set in the last");
}

/* ", at what was set (temperature = 32 Cel; planned 19 min 31 s)"; nothing where it was set as planned */
static void put_as_set(fw_text *out, const fw_recipe_asrun_entry *e, double planned_s) {
    fw_text set = fw_text_new(out->arena);
    if (e->as_set == e->step) return;
    fw_recipe_asrun_put_settings(&set, e);
    out->failed = out->failed || fw_text_end(&set) != FW_OK;
    fw_text_printf(out, ", at what was set (%s%s", set.data ? set.data : "",
                   set.length > 0 ? "; planned " : "planned ");
    if (e->step->time.computable)
        fw_schedule_put_duration(out, planned_s);
    else
        fw_text_add(out, "was no time");
    fw_text_add(out, ")");
}

/* what the law makes of the time, less what may be pauses and handling where it was long: "; by its law that makes 49 um (planned 1 um), and as
   much sideways from every edge"; nothing where it has no amount */
static fw_status put_amount(fw_arena *arena, const fw_recipe_asrun *run,
                            const fw_recipe_asrun_entry *e, bool brief, fw_text *out) {
    const fw_process_argument *a = fw_recipe_asrun_amount_of_law(e->step);
    const double time = of_runs(run, e, brief ? ALL_OF_IT : LESS_HANDLING, 0.0);
    bool sideways = false;
    char value[2][32];
    fw_quantity_unit unit;
    if (!a || a->q->unknown || !(a->q->value > 0.0) || !(time > 0.0) ||
        !fw_quantity_unit_parse(a->q->unit, strlen(a->q->unit), &unit, NULL, NULL))
        return FW_OK;
    double amount = a->q->value;
    FW_TRY(amount_in(arena, e, a, time, &amount));
    for (int k = 0; k < e->step->nchange; k++)
        sideways =
            sideways || (e->step->change[k].isotropic && e->step->change[k].thickness == a->q);
    fw_text_printf(
        out, "; by its law that makes %s%s %s (planned %s %s)%s", brief ? "at most " : "at least ",
        fw_number_text(value[0], sizeof value[0], fw_quantity_unit_from_si(&unit, amount), 3),
        a->q->unit, fw_number_text(value[1], sizeof value[1], fw_quantity_in_unit(a->q), 3),
        a->q->unit, sideways ? ", and as much sideways from every edge" : "");
    return FW_OK;
}

/* "it took 45 min, and is to stop by 26 min"; NULL: in its window, or there is no plan */
static fw_status out_of_time(fw_arena *arena, const fw_recipe_asrun *run,
                             const fw_recipe_asrun_entry *e, const char **how) {
    const char *judged = fw_recipe_asrun_in_time(run, e);
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    const bool brief = strcmp(judged, "short") == 0;
    double surely;
    fw_recipe_asrun_stop_by(run, e, &runs, &surely);
    fw_text text = fw_text_new(arena);
    *how = NULL;
    if (!is_out_of_time(judged)) return FW_OK;
    fw_text_add(&text, "it took ");
    fw_recipe_asrun_put_took(&text, e, &runs);
    fw_text_add(&text, brief ? ", before the first look at " : ", and is to stop by ");
    fw_schedule_put_duration(&text, brief ? e->as_set->time.first_look_s : surely);
    put_as_set(&text, e, brief ? e->step->time.first_look_s : e->step->booked_stop_s);
    FW_TRY(put_amount(arena, run, e, brief, &text));
    if (!brief) fw_recipe_asrun_put_taken(e, runs.took_s, &text);
    FW_TRY(fw_text_end(&text));
    *how = text.data;
    return FW_OK;
}

/* "step S14 of wafer 2", what is the matter with it and what to do; why: which is to be written down, unless it is */
static fw_status ask(const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags, int number,
                     const char *matter, const char *text, const char *todo, bool why) {
    fw_diag_warning(diags, number, place, "step %s%s%s%s%s%s%s", e->at->id,
                    e->wafer ? " of wafer " : "", e->wafer ? e->wafer : "", matter, text, todo,
                    why && !e->deviation ? ", and write down why (deviation=...)" : "");
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* what is beyond its limits and changes no time that the program knows of */
static void ask_unknown_to_law(const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags) {
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        if (e->as_set != e->step || fw_recipe_asrun_allowed(s)) continue;
        fw_diag_warning(diags, 283, place,
                        "step %s: set %s = %s is not what the sheet allows, and the law of its "
                        "time does not know what that changes: it is judged by the time as planned",
                        e->step->id, s->name, s->text);
    }
}

/* FW-D684, where the time goes with the planned settings alone, unless what is finished at the bench is in it */
static fw_status ask_as_set(fw_arena *arena, const fw_recipe_asrun *run,
                            const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags) {
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    fw_text text = fw_text_new(arena), brief = fw_text_new(arena);
    ask_unknown_to_law(e, place, diags);
    const int asked = fw_recipe_asrun_put_inside(run, e, &brief);
    FW_TRY(fw_text_end(&brief));
    if (asked)
        FW_TRY(ask(e, place, diags, asked, " ", brief.data,
                   asked == 732
                       ? ": too short, unless that is its time without them; then log it with the "
                         "end by the clock, else go on with it"
                       : ": too short, unless that is its time without them; then log it with the "
                         "end by the clock, else its own time alone with the same start, and go "
                         "on with it",
                   false));
    if (fw_recipe_asrun_put_left_in_it(run, e, &text)) {
        FW_TRY(fw_text_end(&text));
        return ask(e, place, diags, 684, " ", text.data,
                   ": too long, unless the rest was not in it; log the time in it alone with the "
                   "same start, or look at what that leaves before the next step",
                   false);
    }
    if (!fw_recipe_asrun_is_late_as_set(run, e)) return FW_OK;
    fw_recipe_asrun_put_took(&text, e, &runs);
    fw_text_add(&text, ", and is to stop by ");
    fw_schedule_put_duration(&text, e->as_set->time.stop_s);
    put_as_set(&text, e, e->step->time.stop_s);
    FW_TRY(fw_text_end(&text));
    return ask(e, place, diags, 684, " took ", text.data,
               ": too long, unless what is finished at the bench is in it; look at what that "
               "leaves before the next step",
               false);
}

/* FW-D680, where runs add up to more than one may take unless each has its handling in it, which the log does not tell */
static fw_status ask_runs(fw_arena *arena, const fw_recipe_asrun *run,
                          const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags) {
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    fw_text text = fw_text_new(arena);
    if (!adds_up_to_more(run, e, &runs)) return FW_OK;
    fw_recipe_asrun_put_took(&text, e, &runs);
    fw_text_add(&text, ", and one run is to stop by ");
    fw_schedule_put_duration(&text, fw_recipe_asrun_stop_by(run, e, &runs, NULL));
    FW_TRY(fw_text_end(&text));
    return ask(e, place, diags, 680, ": what it does adds up, and comes to ", text.data,
               ": too long, unless what is finished at the bench is in each of them; look at what "
               "that leaves before the next step",
               false);
}

fw_status fw_recipe_asrun_amount_by_law(fw_arena *arena, const fw_recipe_asrun *run,
                                        const fw_recipe_asrun_entry *e, fw_recipe_amount_in_time *a,
                                        fw_text *planned, fw_text *actual) {
    int together;
    const double loads = fw_recipe_asrun_loads(run, e, &together);
    FW_TRY(amount_in_time(arena, run, e, loads, fw_recipe_asrun_clock_s(e), a));
    if (a->fits) return FW_OK;
    const char *unit = fw_recipe_asrun_accept(e->step, a->measured->measure)->unit;
    fw_quantity_unit in;
    if (!fw_quantity_unit_parse(unit, strlen(unit), &in, NULL, NULL)) return FW_INTERNAL;
    const double law = fw_quantity_unit_from_si(&in, a->law_m);
    char value[3][32];
    fw_text_printf(planned, "%s %s (%s to %s %s), by %s in ",
                   fw_number_text(value[0], sizeof value[0], law, 3), unit,
                   fw_number_text(value[1], sizeof value[1], law * fmax(0.0, 1.0 - a->off), 3),
                   fw_number_text(value[2], sizeof value[2], law * (1.0 + a->off), 3), unit,
                   a->formula);
    fw_schedule_put_duration(planned, a->time_s);
    if (a->time_s < a->took_s / loads) fw_text_add(planned, " (the rest of it may be handling)");
    fw_recipe_put_value(actual, a->measured->number);
    fw_text_printf(actual, " %s", unit);
    FW_TRY(fw_text_end(planned));
    return fw_text_end(actual);
}

/* FW-D654, where the law of the step contradicts what was measured after it */
static fw_status ask_amount(fw_arena *arena, const fw_recipe_asrun *run,
                            const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags) {
    fw_text planned = fw_text_new(arena), actual = fw_text_new(arena);
    fw_recipe_amount_in_time a;
    FW_TRY(fw_recipe_asrun_amount_by_law(arena, run, e, &a, &planned, &actual));
    if (a.fits) return FW_OK;
    fw_diag_warning(
        diags, 654, place,
        "step %s: %s = %s does not go with the time that it took: that makes %s. One of "
        "time, setting and reading is not what is written: give what was set otherwise "
        "(set NAME=VALUE), or measure again",
        e->at->id, a.measured->measure, actual.data, planned.data);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- what a filling of a bath has served ----
   Fillings that an entry names (bath=) are one where they are of one bath and one name, from when it was mixed under that name
   on. What nobody named is another one each time. */

static const fw_process_bath *bath_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const fw_process_bath *bath = NULL;
    for (int i = 0; e->step && e->bath && i < e->step->nuse && !bath; i++)
        bath = e->step->use[i].bath;
    return bath || !e->step || !e->bath ? bath : fw_process_step_mixes(run->flow, e->step);
}

static bool is_mixed_in(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    return fw_process_step_mixes(run->flow, e->step) != NULL;
}

/* of the same filling, and by then in the log: not later than e, nor taken back, nor one run of several that come to one */
static bool shares_bath(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o,
                        const fw_recipe_asrun_entry *e) {
    return o->bath && bath_of(run, o) == bath_of(run, e) && strcmp(o->bath, e->bath) == 0 &&
           (o == e || o->start_s < e->start_s || (o->start_s == e->start_s && o < e)) &&
           !fw_recipe_asrun_taken_back(run, o);
}

/* is the later of the two the same run put right, or gone on with? */
static bool is_one_run(const fw_recipe_asrun_entry *o, const fw_recipe_asrun_entry *later) {
    return o->step == later->step && fw_text_same(o->wafer, later->wafer);
}

fw_status fw_recipe_asrun_bath_life(fw_arena *arena, const fw_recipe_asrun *run,
                                    const fw_recipe_asrun_entry *e, const char **is,
                                    const char **allowed) {
    const fw_process_bath *bath = bath_of(run, e);
    const fw_recipe_asrun_entry *mixed = NULL, *first = e;
    int wafers = 0;
    *is = NULL;
    if (!bath || is_mixed_in(run, e)) return FW_OK;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        if (shares_bath(run, o, e) && is_mixed_in(run, o) && (!mixed || o->end_s > mixed->end_s))
            mixed = o;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++) {
        if (!shares_bath(run, o, e) || is_mixed_in(run, o) ||
            (mixed && o->start_s < mixed->start_s))
            continue;
        bool counted = false;
        for (const fw_recipe_asrun_entry *b = run->entry; b < o; b++)
            counted = counted || (shares_bath(run, b, e) && is_one_run(b, o) &&
                                  (!mixed || b->start_s >= mixed->start_s));
        if (!counted) wafers += o->wafer || run->nwafer == 0 ? 1 : run->nwafer;
        if (o->start_s < first->start_s) first = o;
    }
    const double most = bath->serves && !bath->serves->unknown ? floor(bath->serves->value + 1e-9)
                                                               : (double)INFINITY,
                 age_s = e->start_s - (mixed ? mixed->end_s : first->start_s),
                 keeps_s = bath->keeps && !bath->keeps->unknown
                               ? bath->keeps->value + fw_recipe_asrun_clock_s(e)
                               : (double)INFINITY;
    const bool many = wafers > most, old = age_s > keeps_s;
    if (!many && !old) return FW_OK;
    fw_text what = fw_text_new(arena), limit = fw_text_new(arena);
    fw_text_printf(&limit, "a filling of %s", bath->name);
    if (many) {
        fw_text_printf(&what, "wafer %d of one filling", wafers);
        fw_text_add(&limit, " serves ");
        fw_text_number(&limit, most, 4);
        fw_text_printf(&limit, " (%s)", bath->serves->id);
    }
    if (old) {
        fw_text_add(&what, many ? ", " : "");
        fw_schedule_put_duration(&what, age_s);
        fw_text_printf(&what, " after it was %s", mixed ? "mixed" : "first used");
        fw_text_add(&limit, many ? " and keeps for " : " keeps for ");
        fw_schedule_put_duration(&limit, bath->keeps->value);
        fw_text_printf(&limit, " (%s)", bath->keeps->id);
    }
    FW_TRY(fw_text_end(&what));
    FW_TRY(fw_text_end(&limit));
    *is = what.data, *allowed = limit.data;
    return FW_OK;
}

static fw_status ask_bath(fw_arena *arena, const fw_recipe_asrun *run,
                          const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags) {
    const char *is, *allowed;
    FW_TRY(fw_recipe_asrun_bath_life(arena, run, e, &is, &allowed));
    if (!is) return FW_OK;
    fw_diag_warning(diags, 708, place,
                    "step %s%s%s, bath %s: %s, and %s. What it does to the wafer "
                    "is not what was planned: look at that before the next step, mix anew and give "
                    "the next filling a name of its own (bath=)%s",
                    e->step->id, e->wafer ? " of wafer " : "", e->wafer ? e->wafer : "", e->bath,
                    is, allowed, e->deviation ? "" : ", and write down why (deviation=...)");
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_time(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, fw_place place,
                                   fw_diags *diags) {
    const char *how;
    if (e->fate != FW_FATE_RUN || !e->step)
        return FW_OK; /* what became of a wafer is no step that was run */
    FW_TRY(ask_amount(arena, run, e, place, diags));
    FW_TRY(fw_recipe_asrun_ask_values(e, place, diags));
    FW_TRY(fw_recipe_asrun_ask_waits(run, e, place, diags));
    FW_TRY(ask_runs(arena, run, e, place, diags));
    FW_TRY(ask_as_set(arena, run, e, place, diags));
    FW_TRY(fw_recipe_asrun_ask_at_once(arena, run, e, place, diags));
    FW_TRY(ask_bath(arena, run, e, place, diags));
    FW_TRY(fw_recipe_asrun_ask_contradictions(run, e, place, diags));
    FW_TRY(fw_recipe_asrun_ask_overtaken(run, e, place, diags));
    FW_TRY(fw_recipe_asrun_odd_time(arena, run, e, &how));
    if (how)
        FW_TRY(ask(e, place, diags, 703, " took otherwise than others: ", how,
                   ". What that leaves nobody has computed: look at it before the next step",
                   true));
    FW_TRY(out_of_time(arena, run, e, &how));
    return how ? ask(e, place, diags, 283, " went otherwise than planned: ", how,
                     "; look at what that leaves before the next step", true)
               : FW_OK;
}

/* ---- what it was planned with, and what it would be planned with here ---- */

/* with over-etch and pauses; without handling, and what is finished at the bench */
static double etch_s(const fw_process_step *s) {
    return s->booked_s - (s->booked_stop_s - s->booked_stop_own_s) - s->finish_s;
}

/* as they are written, with six digits */
static bool as_long(double a_s, double b_s, const fw_process_step *of) {
    return fabs(a_s - b_s) <= 1e-4 * fmax(a_s, b_s) + 1e-5 * of->booked_stop_s;
}

fw_status fw_recipe_asrun_put_otherwise(fw_arena *arena, const fw_recipe_asrun *run,
                                        const fw_recipe_asrun_entry *o, fw_text *how) {
    const fw_process_step *now, *then = o->as_set;
    FW_TRY(fw_recipe_asrun_as_set(arena, run, o, true, &now));
    if (then->time.computable == now->time.computable &&
        (!now->time.computable || (as_long(etch_s(then), etch_s(now), then) &&
                                   as_long(then->time.nominal_s, now->time.nominal_s, then))))
        return FW_OK;
    fw_text_printf(how, "step %s (line %d, %s) was planned with ", o->step->id, o->line, o->start);
    if (then->time.computable)
        fw_schedule_put_duration(how, etch_s(then));
    else
        fw_text_add(how, "a time that its line does not say");
    fw_text_add(how, ", and with the values that are used here it would be ");
    if (now->time.computable)
        fw_schedule_put_duration(how, etch_s(now));
    else
        fw_text_add(how, "none");
    return FW_OK;
}
