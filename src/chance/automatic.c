/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/automatic.h"
#include "base/text.h"
#include "chance/estimators.h"
#include "chance/random.h"
#include "chance/sobol.h"
#include <math.h>

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

static fw_status weighted(fw_chance_run *run, size_t samples, fw_chance_weighted *w) {
    fw_chance_run of = part_of(run, SEED_WEIGHTED);
    fw_status status = fw_chance_weighted_draw(&of, samples, w);
    account(run, &of);
    return status;
}

static const char *caution_of(fw_arena *arena, const fw_chance_weighted *w, double level) {
    char text[32];
    double unseen = -expm1(log(1 - level) / fmax(1, (double)w->own));
    return fw_arena_printf(arena,
                           "a failure, or a point without a value, that is far from all design "
                           "points and that none of %zu points of the inputs' own distribution "
                           "met, is not in the interval; it would be rarer than %s",
                           w->own, fw_number_text(text, sizeof text, unseen, 2));
}

static const char *const no_repetition =
    "there was one repetition of subset simulation only: a greater budget gives an interval";

fw_status fw_chance_in_subsets(fw_chance_run *run, fw_chance_estimate *out) {
    fw_chance_subset s;
    FW_TRY(subsets_start(run, fw_chance_left(run), REPEATED, &s));
    FW_TRY(subsets(run, fw_chance_left(run), SIZE_MAX, &s));
    fw_chance_subset_result(&s, run->level, out);
    if (s.repetitions < 2) out->caution = no_repetition;
    return FW_OK;
}

fw_status fw_chance_around_points(fw_chance_run *run, fw_chance_estimate *out) {
    fw_chance_subset s;
    fw_chance_points points;
    fw_chance_weighted w;
    size_t start = run->used, budget = part(run, OF_EXPLORED);
    FW_TRY(subsets_start(run, budget, EXPLORED, &s));
    FW_TRY(subsets(run, budget - (run->used - start), EXPLORED, &s));
    FW_TRY(fw_chance_points_find(run, part(run, 2 * OF_POINTS), s.failing, s.failed, &points));
    if (!points.count) return FW_SOLVER;
    fw_chance_weighted_start(&points, &w);
    FW_TRY(weighted(run, fw_chance_left(run), &w));
    fw_chance_weighted_result(&w, run->level, out);
    out->points = points.count, out->point = points.point;
    FW_NEED(out->caution = caution_of(run->arena, &w, run->level));
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

/* why importance sampling is not to be trusted here, NULL: it is */
static const char *why_not_points(const fw_chance_points *points, const fw_chance_weighted *w,
                                  const fw_chance_subset *s) {
    if (!points->count) return "no design point was found";
    if (fw_chance_weighted_effective(w) < EFFECTIVE)
        return "the failures met around the design points have uneven weights";
    fw_chance_estimate here, there;
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
    bool flat; /* nothing leads towards a failure */
} rare;

static fw_status explore(fw_chance_run *run, rare *r) {
    size_t stop = run->used + part(run, OF_EXPLORED);
    fw_chance_subset *s = &r->subset;
    FW_TRY(subsets_start(run, part(run, OF_EXPLORED), EXPLORED, s));
    FW_TRY(subsets(run, stop - run->used, 1, s));
    r->flat = s->stuck > 0;
    if (r->flat) return FW_OK;
    FW_TRY(subsets(run, stop - run->used, EXPLORED - 1, s));
    FW_TRY(fw_chance_points_find(run, part(run, OF_POINTS), r->subset.failing, r->subset.failed,
                                 &r->points));
    fw_chance_weighted_start(&r->points, &r->weighted);
    size_t tried = TRIED < part(run, OF_PILOT) ? TRIED : part(run, OF_PILOT);
    return r->points.count ? weighted(run, tried, &r->weighted) : FW_OK;
}

/* the rest of the budget for the one or the other */
static fw_status go_on(fw_chance_run *run, rare *r, bool around_points, fw_chance_estimate *out) {
    out->points = r->points.count, out->point = r->points.point;
    if (around_points) {
        out->method = FW_CHANCE_IMPORTANCE;
        FW_TRY(weighted(run, fw_chance_left(run), &r->weighted));
        fw_chance_weighted_result(&r->weighted, run->level, out);
        FW_NEED(out->caution = caution_of(run->arena, &r->weighted, run->level));
        return FW_OK;
    }
    out->method = FW_CHANCE_SUBSET;
    FW_TRY(subsets(run, fw_chance_left(run), SIZE_MAX, &r->subset));
    fw_chance_subset_result(&r->subset, run->level, out);
    if (r->subset.repetitions < 2) out->caution = no_repetition;
    return FW_OK;
}

/* Decides by points of its own whether failures are common; if not, explores with subset simulation, looks for design
   points from the origin and from the failing points that it found, samples around these, and takes that unless it
   contradicts subset simulation or a few heavy weights decide. Nothing that decided is in the numbers that are reported,
   but the first 1500 points around the design points and the first repetitions of subset simulation: these are part of
   what is taken whether or not it is taken. Test: test_automatic.c */
fw_status fw_chance_automatic(fw_chance_run *run, fw_chance_estimate *out) {
    enum { SMALL_BUDGET = 3000 };
    if (run->budget < SMALL_BUDGET)
        return counted(run, "the budget is too small for anything but counting", out);
    fw_chance_count count = {0};
    const char *because;
    rare r;
    FW_TRY(pilot(run, &count));
    FW_TRY(why_counted(run, &count, &because));
    if (because) return counted(run, because, out);
    FW_TRY(explore(run, &r));
    if (r.flat)
        return counted(run, "the limit state shows no way towards a failure: there is but counting",
                       out);
    const char *why_not = why_not_points(&r.points, &r.weighted, &r.subset);
    if (!why_not) because = "subset simulation agrees with what design points say";
    FW_NEED(out->reason = fw_arena_printf(
                run->arena, "%zu of the first %zu points fail, which is too rare to count, and %s",
                count.failed, count.points, why_not ? why_not : because));
    return go_on(run, &r, !why_not, out);
}
