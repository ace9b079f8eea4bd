/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An estimate of a probability by the method that is asked for or that suits. */
#include "chance/estimate.h"
#include "base/text.h"
#include "chance/random.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* ---- methods of several parts, and the choice among all ---- */

/* Parts of a budget: points that decide whether a failure is common, and how many must fail for that; subset simulation
   that looks where failures are; gradients; a first part of importance sampling, and what it must be worth. */
enum { PILOT = 1000, COMMON = 30, TRIED = 1500, EFFECTIVE = 50, EXPLORED = 4, REPEATED = 8 };
#define OF_PILOT    0.1
#define OF_EXPLORED 0.35
#define OF_POINTS   0.2
#define SURE        0.999 /* level of the intervals that have to overlap */

static size_t part(const fw_chance_run *run, double share) {
    return (size_t)(share * (double)run->budget);
}

/* numbers of a part that no other part uses */
static fw_chance_run part_of(const fw_chance_run *run, uint64_t number) {
    fw_chance_run copy = *run;
    copy.seed = fw_chance_seed(run->seed, number);
    return copy;
}

static void account(fw_chance_run *run, const fw_chance_run *part) {
    run->used = part->used;
    run->unevaluated = part->unevaluated;
}

enum { SEED_PILOT = 1000001, SEED_SUBSET, SEED_WEIGHTED, SEED_COUNT };

static fw_status subsets_start(fw_chance_run *run, size_t budget, size_t wanted,
                               fw_chance_subset *s) {
    fw_chance_run of = part_of(run, SEED_SUBSET);
    fw_status status = fw_chance_subset_start(&of, budget, wanted, s);
    account(run, &of);
    return status;
}

static fw_status subsets(fw_chance_run *run, size_t budget, size_t most, fw_chance_subset *s) {
    fw_chance_run of = part_of(run, SEED_SUBSET);
    fw_status status = fw_chance_subset_repeat(&of, budget, most, s);
    account(run, &of);
    return status;
}

static fw_status weighted(fw_chance_run *run, size_t samples, bool chooses, fw_chance_weighted *w) {
    fw_chance_run of = part_of(run, SEED_WEIGHTED);
    fw_status status = fw_chance_weighted_draw(&of, samples, chooses, w);
    account(run, &of);
    return status;
}

/* repetitions, or points, for all that is left, with what each step said */

static fw_status subsets_to_the_end(fw_chance_run *run, fw_chance_subset *s,
                                    fw_chance_estimate *out) {
    for (size_t before = SIZE_MAX; before != s->repetitions;) {
        before = s->repetitions;
        FW_TRY(subsets(run, fw_chance_left(run), 1, s));
        fw_chance_subset_result(s, run->level, out);
        if (before != s->repetitions) fw_chance_trace(run, out, out);
    }
    return FW_OK;
}

static fw_status weighted_to_the_end(fw_chance_run *run, fw_chance_weighted *w,
                                     fw_chance_estimate *out) {
    enum { PARTS = 24 };
    size_t each = (fw_chance_left(run) / PARTS / run->batch + 1) * run->batch;
    do {
        size_t now = fw_chance_left(run) < each ? fw_chance_left(run) : each;
        FW_TRY(weighted(run, now, false, w));
        fw_chance_weighted_result(w, run->level, out);
        fw_chance_trace(run, out, out);
    } while (fw_chance_left(run) > 0);
    return FW_OK;
}

static const char *const all_looked_at =
    "the one input was followed to 8 standard deviations either way, a quarter of one at a time: "
    "only what fails between two of these values, and at none of them, is not in the interval";

/* What is not in the interval, how it was looked for, and what it takes to know more. Own points that none of them met a
   failure with say only as much as there are of them: where that is no less than the estimate itself, what is told is how
   many there would have to be. first: own points before, none of which failed */
static const char *caution_of(const fw_chance_run *run, const fw_chance_weighted *w, size_t first,
                              const fw_chance_estimate *e) {
    char text[32];
    const size_t own = w->own + first, n = run->limit->dimensions;
    const bool followed = w->points->followed;
    const double none = -log(1 - run->level), unseen = -expm1(-none / fmax(1, (double)own));
    const double p = w->points->origin_fails ? 1 - e->probability_low : e->probability_high;
    if (n == 1 && followed) return all_looked_at;
    const bool told = unseen < p || !(p > 0);
    const double points = none / p / fw_chance_weighted_own;
    return fw_arena_printf(
        run->arena,
        "failures were looked for %s; what fails, or has no value, apart from all these "
        "places is not in the interval%s%s%s",
        followed ? "along each input to 8 standard deviations either way, and from where subset "
                   "simulation met them"
                 : "from where subset simulation met them, but not along each input, for which the "
                   "budget was too small",
        told ? ", and rarer than " : "; an estimate of some ",
        fw_number_text(text, sizeof text, told ? unseen : points, 2),
        told ? ", as no point of the inputs' own distribution met it"
             : " points would meet it by chance if it were as likely as what was found");
}

static const char *const no_repetition =
    "there was one repetition of subset simulation only: a greater budget gives an interval";

static fw_status caution_of_subsets(fw_arena *arena, const fw_chance_subset *s,
                                    fw_chance_estimate *out) {
    char text[32];
    if (fw_chance_subset_unmet(s))
        FW_NEED(out->caution = fw_arena_printf(
                    arena,
                    "no failure was met, and whether there is one is not known: subset simulation "
                    "ended at a limit that is not the device's but nearer, below which %s of all "
                    "points lie, by several times more or less",
                    fw_number_text(text, sizeof text, s->most[0], 2)));
    else if (s->repetitions < 2)
        out->caution = no_repetition;
    return FW_OK;
}

static fw_status by_subsets(fw_chance_run *run, fw_chance_estimate *out) {
    fw_chance_subset s;
    if (run->limit->apart) return FW_LIMIT;
    FW_TRY(subsets_start(run, fw_chance_left(run), REPEATED, &s));
    FW_TRY(subsets_to_the_end(run, &s, out));
    return caution_of_subsets(run->arena, &s, out);
}

static fw_status by_design_points(fw_chance_run *run, fw_chance_estimate *out) {
    fw_chance_subset s;
    fw_chance_points points;
    fw_chance_weighted w;
    size_t start = run->used, budget = part(run, OF_EXPLORED);
    FW_TRY(subsets_start(run, budget, EXPLORED, &s));
    FW_TRY(subsets(run, budget - (run->used - start), EXPLORED, &s));
    FW_TRY(fw_chance_points_find(run, part(run, 2 * OF_POINTS), &s, &points));
    if (!points.count) return FW_SOLVER;
    fw_chance_weighted_start(&points, &w);
    FW_TRY(weighted_to_the_end(run, &w, out));
    out->points = points.count, out->point = points.point;
    FW_NEED(out->caution = caution_of(run, &w, 0, out));
    return FW_OK;
}

static fw_status pilot(fw_chance_run *run, fw_chance_count *count) {
    size_t n = run->limit->dimensions,
           total = part(run, OF_PILOT) < PILOT ? part(run, OF_PILOT) : PILOT;
    fw_mark mark = fw_arena_mark(run->arena);
    double *u = fw_arena_array(run->arena, double, total *n),
           *value = fw_arena_array(run->arena, double, total);
    FW_NEED(u && value ? u : NULL);
    uint64_t seed = fw_chance_seed(run->seed, SEED_PILOT);
    for (size_t i = 0; i < total; i++)
        for (size_t d = 0; d < n; d++)
            u[i * n + d] = fw_chance_normal(seed, i, d);
    FW_TRY(fw_chance_evaluate(run, total, u, value));
    for (size_t i = 0; i < total; i++)
        fw_chance_count_add(count, value[i]);
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
}

/* counting, by the points that suit the number of dimensions */
static fw_status counted(fw_chance_run *run, const char *because, fw_chance_estimate *out) {
    fw_chance_run of = part_of(run, SEED_COUNT);
    bool quasi = run->limit->dimensions <= FW_CHANCE_SOBOL_MOST;
    out->method = quasi ? FW_CHANCE_QUASI : FW_CHANCE_MONTE_CARLO;
    FW_NEED(out->reason =
                fw_arena_printf(run->arena, "%s%s", because,
                                quasi ? "" : "; Sobol' points do not have so many dimensions"));
    fw_status status = quasi ? fw_chance_quasi(&of, out) : fw_chance_monte_carlo(&of, out);
    account(run, &of);
    return status;
}

/* why a count is what is wanted; *because NULL: it is not */
static fw_status why_counted(fw_chance_run *run, const fw_chance_count *c, const char **because) {
    size_t safe = c->points - c->failed - c->unevaluated, met = c->failed;
    const char *format = NULL;
    if (c->unevaluated >= COMMON) {
        format = "%zu of the first %zu points could not be evaluated, which leaves more open than "
                 "any other method would gain";
        met = c->unevaluated;
    } else if (c->failed >= COMMON && safe >= COMMON) {
        format = "%zu of the first %zu points fail, which is often enough to count failures";
    } else if (c->failed >= COMMON) {
        format = "%zu of the first %zu points fail, so that it is survival that is rare";
    }
    *because = NULL;
    if (format) FW_NEED(*because = fw_arena_printf(run->arena, format, met, c->points));
    return FW_OK;
}

/* why importance sampling is not to be trusted here, NULL: it is. s NULL: subset simulation says nothing */
static const char *why_not_points(const fw_chance_points *points, const fw_chance_weighted *w,
                                  const fw_chance_subset *s) {
    if (!points->count) return "no design point was found";
    const double even = fw_chance_weighted_of_plane(w) / 2; /* of few points even a plane has few */
    if (fw_chance_weighted_effective(w) < fmin(EFFECTIVE, even))
        return "the failures met around the design points have uneven weights";
    fw_chance_estimate here, there;
    if (!s) return NULL;
    fw_chance_weighted_result(w, SURE, &here);
    fw_chance_subset_result(s, SURE, &there);
    if (here.high < there.low || here.low > there.high)
        return "importance sampling around design points contradicts it";
    return NULL;
}

/* what was found of a rare failure before it is decided how to go on */
typedef struct rare {
    fw_chance_subset subset;
    fw_chance_points points;
    fw_chance_weighted weighted;
    size_t first; /* points before, where all of them are safe */
    bool flat;    /* nothing leads towards a failure */
} rare;

static fw_status explore(fw_chance_run *run, rare *r) {
    size_t stop = run->used + part(run, OF_EXPLORED);
    fw_chance_subset *s = &r->subset;
    FW_TRY(subsets_start(run, part(run, OF_EXPLORED), EXPLORED, s));
    FW_TRY(subsets(run, stop - run->used, 1, s));
    r->flat = s->stuck > 0;
    if (r->flat)
        s->failing = 0; /* of it the inputs are followed alone */
    else
        FW_TRY(subsets(run, stop - run->used, EXPLORED - 1, s));
    FW_TRY(fw_chance_points_find(run, part(run, OF_POINTS), s, &r->points));
    fw_chance_weighted_start(&r->points, &r->weighted);
    size_t tried = TRIED < part(run, OF_PILOT) ? TRIED : part(run, OF_PILOT);
    return r->points.count ? weighted(run, tried, true, &r->weighted) : FW_OK;
}

/* the rest of the budget for the one or the other */
static fw_status go_on(fw_chance_run *run, rare *r, bool around_points, fw_chance_estimate *out) {
    out->points = r->points.count, out->point = r->points.point;
    if (around_points) {
        out->method = FW_CHANCE_IMPORTANCE;
        FW_TRY(weighted_to_the_end(run, &r->weighted, out));
        FW_NEED(out->caution = caution_of(run, &r->weighted, r->first, out));
        return FW_OK;
    }
    out->method = FW_CHANCE_SUBSET;
    if (run->limit->apart) return FW_LIMIT; /* one machine has to do it */
    FW_TRY(subsets_to_the_end(run, &r->subset, out));
    return caution_of_subsets(run->arena, &r->subset, out);
}

/* Distributions' tails are not known so far out that less than this could be said of anything. */
static const double tails_known = 1e-12;

/* Ends that the first points alone say are never given up, unless the estimate lies beyond them, and what tails are not
   known for is not told. */
static void no_less_than_counted(const fw_chance_count *first, fw_chance_estimate *out) {
    fw_chance_estimate c;
    fw_chance_counted(first, out->level, &c);
    if (out->probability_high < c.low || out->probability_low > c.high) return;
    out->low = fmax(out->low, c.low), out->high = fmin(out->high, c.high);
    if (out->low < tails_known) out->low = 0;
    out->high = fmax(out->high, tails_known);
    for (size_t k = 0; k < out->steps; k++) {
        fw_chance_step *s = &out->step[k];
        if (s->probability < c.low || s->probability > c.high) continue;
        s->low = fmax(s->low, c.low), s->high = fmin(s->high, c.high);
        if (s->low < tails_known) s->low = 0;
        s->high = fmax(s->high, tails_known);
    }
}

/* Decides by points of its own whether failures are common; if not, explores with subset simulation, looks for design
   points from the origin and from the failing points that it found, samples around these, and takes that unless it
   contradicts subset simulation or a few heavy weights decide. Nothing that decided is in the numbers that are reported,
   but the first 1500 points around the design points and the first repetitions of subset simulation, which are part of
   what is taken whether or not it is taken, and the count of the first points, beyond whose ends no interval goes. Test: test_automatic.c */
static fw_status automatic(fw_chance_run *run, fw_chance_estimate *out) {
    enum { SMALL_BUDGET = 3000 };
    if (run->budget < SMALL_BUDGET)
        return counted(
            run,
            "the budget is too small for anything but counting: where failures are rare, "
            "3000 points and more go to where they are",
            out);
    fw_chance_count count = {0};
    const char *because;
    rare r;
    FW_TRY(pilot(run, &count));
    FW_TRY(why_counted(run, &count, &because));
    if (because) return counted(run, because, out);
    FW_TRY(explore(run, &r));
    r.first = count.failed + count.unevaluated > 0 ? 0 : count.points;
    if (r.flat && !r.points.count)
        return counted(run, "the limit state shows no way towards a failure: there is but counting",
                       out);
    const char *why_not = why_not_points(&r.points, &r.weighted, r.flat ? NULL : &r.subset);
    if (r.flat && why_not)
        return counted(run,
                       "subset simulation finds no way towards a failure, and there are others "
                       "than those along one input: there is but counting",
                       out);
    if (!why_not)
        because = r.flat ? "where subset simulation finds no way inputs that were followed one by "
                           "one lead to failures"
                         : "subset simulation agrees with what design points say";
    FW_NEED(out->reason = fw_arena_printf(
                run->arena, "%zu of the first %zu points fail, which is too rare to count, and %s",
                count.failed, count.points, why_not ? why_not : because));
    FW_TRY(go_on(run, &r, !why_not, out));
    no_less_than_counted(&count, out);
    return FW_OK;
}

/* ---- one estimate by the method asked for ---- */

static const struct method {
    const char *id, *text;
} methods[] = {
#define ROW(name, id, text) {id, text},
    FW_CHANCE_METHODS(ROW)
#undef ROW
};

const char *fw_chance_method_id(fw_chance_method method) {
    return methods[method].id;
}

const char *fw_chance_method_text(fw_chance_method method) {
    return methods[method].text;
}

fw_status fw_chance_method_find(const char *id, fw_chance_method *method) {
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].id, id) == 0) {
            *method = (fw_chance_method)i;
            return FW_OK;
        }
    return FW_INPUT;
}

static fw_status run_of(fw_arena *arena, const fw_chance_limit *limit, const fw_chance_options *o,
                        fw_chance_run *run, const char **why) {
    *run = (fw_chance_run){.arena = arena,
                           .limit = limit,
                           .seed = o->seed,
                           .budget = o->budget,
                           .batch = o->batch ? o->batch : FW_CHANCE_BATCH,
                           .level = o->level != 0 ? o->level : 0.95};
    if (limit->dimensions < 1)
        *why = "nothing scatters, so that there is no probability to be estimated";
    else if (o->budget < FW_CHANCE_BUDGET_LEAST)
        *why = "a probability takes at least 200 evaluations";
    else if (!(run->level > 0 && run->level < 1))
        *why = "the level of an interval is above 0 and below 1";
    else
        return FW_OK;
    return FW_INPUT;
}

static fw_status by_method(fw_chance_run *run, fw_chance_method method, fw_chance_estimate *out) {
    switch (method) {
    case FW_CHANCE_AUTO:
        return automatic(run, out);
    case FW_CHANCE_MONTE_CARLO:
        return fw_chance_monte_carlo(run, out);
    case FW_CHANCE_QUASI:
        return fw_chance_quasi(run, out);
    case FW_CHANCE_IMPORTANCE:
        return by_design_points(run, out);
    case FW_CHANCE_SUBSET:
        return by_subsets(run, out);
    }
    return FW_INTERNAL;
}

fw_status fw_chance_estimate_check(const fw_chance_limit *limit, const fw_chance_options *options,
                                   const char **why) {
    fw_chance_run run;
    *why = NULL;
    return run_of(NULL, limit, options, &run, why);
}

fw_status fw_chance_estimate_run(fw_arena *arena, const fw_chance_limit *limit,
                                 const fw_chance_options *options, fw_chance_estimate *out,
                                 const char **why) {
    fw_chance_run run;
    *why = NULL;
    FW_TRY(run_of(arena, limit, options, &run, why));
    *out =
        (fw_chance_estimate){.method = options->method, .reason = "asked for", .level = run.level};
    FW_TRY(by_method(&run, options->method, out));
    out->evaluations = run.used;
    out->unevaluated = run.unevaluated;
    return FW_OK;
}
