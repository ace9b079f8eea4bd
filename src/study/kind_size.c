/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizing: the values with which a response is least or largest while every limit holds and check accepts the device; of
   two responses the Pareto front.

   The description as it stands and a Sobol' sequence over the ranges are judged first; from the best of them, apart from each other,
   local searches by models of all that was judged (study_descent.c), and some more from the best of further points, apart from
   where these ended; the best of these with its inputs at the ends of their ranges; and one search more, by models again, with what
   the searches left of their devices. What is returned is a device that was judged as its texts say. Of two goals each is sought
   alone, then the first with the second held at levels in the widest gaps between (epsilon constraints; Haimes, Lasdon, Wismer 1971),
   and the front is what no other one of all that was judged and accepted beats. What is the largest of what hinges use has a model
   of each. Nothing is proved: a better one may be where nobody looked.
   At a wanted yield all of these are only what further searches begin with (study_search.c).
   Test: tests/cli/test_study.py, tests/cli/test_sizing.py */
#include "chance/random.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum {
    STARTS = 3,  /* of local searches, a goal each */
    PASSES = 16, /* of such levels */
    DIGITS = 5,  /* of what is tried: more no mask resolves */
    AGAIN = 36,  /* devices over the ranges once more, or as many as at first */
};

typedef struct goal {
    int response;
    double sign; /* 1: minimise, -1: maximise */
} goal;

typedef struct sizing {
    fw_study *study;
    fw_study_result *result;
    goal goal[2];
    int ngoal;
    fw_chance_sobol sobol;
    long first_n, more_n;  /* samples of the first look, and of further ones */
    long lists;            /* combinations of listed values */
    fw_study_sample *kept; /* (nkept) all that was judged, of the first look in their order */
    int nkept;
    long nend;             /* devices at ends of ranges */
    int for_ends;          /* devices kept for the ends */
    bool ranged;           /* an input is of a range */
    fw_study_watch watch;  /* corners that devices as made are looked at in (study_made.c) */
    long nwhole;           /* devices that were looked at in all corners once more */
    int levels, held_most; /* of two goals: levels of the second, devices of a search at one */
} sizing;

/* ---- what is small, and what must not be above 0 ---- */

static double goal_of(const fw_study_sample *sample, const goal *g) {
    return g->sign * sample->response[g->response];
}

/* above 0: a limit of a response is missed, or check does not accept */
static double constraint_of(const fw_study *study, const fw_study_sample *sample) {
    double limits = fw_study_excess(study, sample);
    if (!sample->run || isnan(limits) || isnan(sample->used)) return (double)NAN;
    return fmax(limits, log(fmax(sample->used, 1e-6)));
}

typedef struct aim { /* of one search */
    const sizing *s;
    const goal *goal;
    const goal *held; /* NULL: none */
    double level;     /* of the one held */
    double scale;
} aim;

static double objective(const void *context, const fw_study_sample *sample) {
    const aim *a = context;
    return goal_of(sample, a->goal);
}

static double constraint(const aim *a, const fw_study_sample *sample) {
    const double c = constraint_of(a->s->study, sample);
    return !a->held || isnan(c) ? c : fmax(c, (goal_of(sample, a->held) - a->level) / a->scale);
}

/* the same, each for itself: limits of responses, what is used, what is held */
static void constraints(const void *context, const fw_study_sample *sample, double *c,
                        bool *untold) {
    const aim *a = context;
    const double used = isnan(sample->used) ? (double)NAN : log(fmax(sample->used, 1e-6));
    c += fw_study_limits(a->s->study, sample, c);
    *c++ = used;
    if (a->held) *c = (goal_of(sample, a->held) - a->level) / a->scale;
    *untold = isnan(used) || (sample->decision != 0 && sample->used <= fw_study_beyond);
}

static int constraints_of(const aim *a) {
    return fw_study_limits(a->s->study, NULL, NULL) + 1 + (a->held != NULL);
}

static bool is_largest(const aim *a, const goal *g) {
    return g->sign > 0 && fw_study_response_is_largest(&a->s->study->response[g->response]);
}

/* of the numbers above that are the largest of several, these */
static void parts(const void *context, const fw_study_sample *sample, double *part) {
    const aim *a = context;
    const fw_study *study = a->s->study;
    if (is_largest(a, a->goal)) part = fw_study_used_by(study, sample, 0, 1, part);
    fw_study_limits_parts(study, sample, NULL, &part);
    for (int j = 0; j < study->nuse; j++) {
        const double use = sample->use[FW_USE_NUMBERS * j + FW_USE_HIGH];
        *part++ = log(use < 1e-6 ? 1e-6 : use); /* NaN stays */
    }
    if (a->held && is_largest(a, a->held))
        fw_study_used_by(study, sample, a->level, a->scale, part);
}

/* how many each of them has, the objective first */
static fw_status count_parts(const aim *a, fw_study_search *search) {
    const fw_study *study = a->s->study;
    const int n = 1 + constraints_of(a);
    int *count = fw_arena_array(study->arena, int, (size_t)n), *at = count;
    FW_NEED(count);
    *at++ = is_largest(a, a->goal) ? study->nuse : 0;
    fw_study_limits_parts(study, NULL, &at, NULL);
    *at++ = study->nuse;
    if (a->held) *at = is_largest(a, a->held) ? study->nuse : 0;
    search->parts = count, search->part = parts;
    for (int k = 0; k < n; k++)
        search->npart += count[k];
    return FW_OK;
}

/* ---- the first look ---- */

/* sample 0: as it stands where that is within the ranges, else their middles */
static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    sizing *s = context;
    const fw_study *study = s->study;
    long point = k / s->lists;
    *wanted = s->nkept == 0 || k > 0; /* the first one may have been judged alone */
    sample->i = k;
    sample->watch = s->watch.n > 0 ? &s->watch : NULL;
    FW_TRY(fw_study_lists_write(study, k % s->lists, sample));
    for (int v = 0; v < study->nvary; v++) {
        const fw_study_input *in = &study->input[v];
        if (in->ntext > 0) continue;
        bool now = point == 0 && in->now >= in->from && in->now <= in->to;
        if (now)
            FW_TRY(fw_study_input_write(in, in->now, 12, sample->text[v], &sample->value[v]));
        else
            FW_TRY(fw_study_input_at(
                in,
                point == 0 ? 0.5
                           : fw_chance_sobol_uniform(&s->sobol, (uint64_t)point - 1, (size_t)v),
                DIGITS, sample->text[v], &sample->value[v]));
    }
    return FW_OK;
}

/* the same, and further ones behind what the first look had */
static fw_status fill_more(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sizing *s = context;
    return fill(context, s->first_n + s->more_n + k, sample, wanted);
}

static fw_status take(void *context, const fw_study_sample *sample) {
    sizing *s = context;
    /* rows of the store have no texts of ranged values: written again from their number */
    bool wanted;
    fw_study_sample *to = &s->kept[s->nkept++];
    fw_study_sample_copy(s->study, sample, to);
    return fill(s, sample->i, to, &wanted);
}

/* ---- what is found ---- */

/* the best for an aim; -1: nothing was run */
static int best_for(const sizing *s, const aim *a) {
    int best = FW_NONE;
    for (int i = 0; i < s->nkept; i++) {
        const fw_study_sample *k = &s->kept[i], *b = best == FW_NONE ? NULL : &s->kept[best];
        if (k->run && (!b || fw_study_search_better(objective(a, k), constraint(a, k),
                                                    objective(a, b), constraint(a, b))))
            best = i;
    }
    return best;
}

typedef struct at_ends {
    sizing *s;
    const fw_study_sample *from;
    long first; /* number of the first one */
    /* (n) the input, and 1 for the upper end of its range, 0 for the lower; NULL: it is judged as it is, at all corners */
    const int (*move)[2];
} at_ends;

static fw_status fill_end(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const at_ends *e = context;
    const fw_study *study = e->s->study;
    *wanted = true;
    sample->i = e->first + k;
    sample->watch = e->move && e->s->watch.n > 0 ? &e->s->watch : NULL;
    for (int v = 0; v < study->nvary; v++) {
        memcpy(sample->text[v], e->from->text[v], FW_STUDY_TEXT);
        sample->value[v] = e->from->value[v];
    }
    if (!e->move) return FW_OK;
    const int moved = e->move[k][0];
    return fw_study_input_at(&study->input[moved], e->move[k][1], DIGITS, sample->text[moved],
                             &sample->value[moved]);
}

static fw_status take_end(void *context, const fw_study_sample *sample) {
    const at_ends *e = context;
    bool wanted;
    fw_study_sample *to = &e->s->kept[e->s->nkept++];
    FW_TRY(fw_study_sample_new(e->s->study->arena, e->s->study, to));
    fw_study_sample_copy(e->s->study, sample, to);
    return fill_end(context, sample->i - e->first, to, &wanted);
}

/* The best for an aim. Where it was accepted at the corners that were watched it is judged at all of them first, and where it is
   not the best any more, the next one is. */
static fw_status best_whole(sizing *s, const aim *a, int *best) {
    while ((*best = best_for(s, a)) != FW_NONE && fw_study_is_partly(&s->kept[*best])) {
        at_ends e = {.s = s, .from = &s->kept[*best]};
        e.first = FW_STUDY_SEARCH_PART / 4 + s->nwhole++;
        const fw_study_work work = {.n = 1, .fill = fill_end, .take = take_end, .context = &e};
        FW_TRY(fw_study_pool_run(s->study, &work));
        s->kept[*best] = s->kept[--s->nkept]; /* in its place */
        fw_study_watch_add(&s->watch, s->kept[*best].corner);
    }
    return FW_OK;
}

static fw_study_search search_of(const aim *a, int most, long *first) {
    const int best = best_for(a->s, a);
    const fw_study_sample *than = best == FW_NONE ? NULL : &a->s->kept[best];
    *first += FW_STUDY_SEARCH_PART;
    return (fw_study_search){.objective = objective,
                             .nconstraint = constraints_of(a),
                             .constraint = constraints,
                             .context = a,
                             .most = most,
                             .digits = DIGITS,
                             .first = *first - FW_STUDY_SEARCH_PART,
                             .watch = a->s->watch,
                             .than_f = than ? objective(a, than) : (double)NAN,
                             .than_c = than ? constraint(a, than) : (double)NAN,
                             .keeps_all = true};
}

/* All that a search judged may be the answer, also what is not the best of this search: of two goals one that is best for
   neither may be on the front, and at a wanted yield one that uses less. */
static void join(sizing *s, const fw_study_search *search) {
    for (int k = 0; k < search->used; k++)
        s->kept[s->nkept++] = search->all[k];
    for (int k = search->watch.n; k-- > 0;)
        fw_study_watch_add(&s->watch, search->watch.text[k]);
}

static const double apart_by = 0.1; /* of a range */

/* starts of searches for an aim: the best of what was judged from sample `since` on, each apart from the others and from where
   those before them (nbefore) ended */
static fw_status starts(sizing *s, const aim *a, int since, const fw_study_search *before,
                        int nbefore, fw_study_search *search, int *n, int most, long *first) {
    const fw_study_sample *chosen[STARTS];
    for (*n = 0; *n < STARTS;) {
        const fw_study_sample *best = NULL;
        double f = (double)NAN, c = (double)NAN;
        for (int i = since; i < s->nkept; i++) {
            const fw_study_sample *k = &s->kept[i];
            bool apart = k->run;
            for (int j = 0; j < *n && apart; j++)
                apart = fw_study_search_apart(s->study, k, chosen[j]) > apart_by;
            for (int j = 0; j < nbefore && apart; j++)
                apart = fw_study_search_apart(s->study, k, &before[j].best) > apart_by;
            if (!apart) continue;
            double fk = objective(a, k), ck = isnan(fk) ? (double)NAN : constraint(a, k);
            if (!best || fw_study_search_better(fk, ck, f, c)) best = k, f = fk, c = ck;
        }
        if (!best) break;
        chosen[*n] = best;
        fw_study_search *one = &search[(*n)++];
        *one = search_of(a, most, first);
        FW_TRY(fw_study_search_from(s->study, best, one));
        FW_TRY(count_parts(a, one));
        FW_TRY(fw_study_search_knows(s->study, one, s->kept, s->nkept));
    }
    return FW_OK;
}

/* devices with which a local search comes farther than its first steps, one for each input: with fewer the ends of the
   ranges and one search from all that was judged have them */
static int worth_it(const fw_study *study) {
    return 2 * (study->nvary + 1);
}

/* n searches, and what they judged; *left: devices that there are */
static fw_status run_all(sizing *s, fw_study_search *search, int n, int *left) {
    FW_TRY(fw_study_search_run(s->study, search, n));
    for (int i = 0; i < n; i++)
        join(s, &search[i]), *left -= search[i].used;
    return FW_OK;
}

/* Where searches from the best of few devices end, another place may be better that none of these was near. So the ranges are
   looked at once more by further points of the sequence, as far as half of what the searches left beyond what the last search
   has goes, and searches begin at the best of these that are apart from where the first ones ended. *left: devices that there
   are. Test: tests/cli/test_sizing.py, SeveralMinima */
static fw_status look_again(sizing *s, const aim *a, const fw_study_search *ended, int n, int most,
                            int *left, long *first) {
    fw_study_search search[STARTS];
    const int since = s->nkept, half = (*left - most) / 2,
              look = (int)fmin(fmax((double)s->first_n, AGAIN), half);
    if (n == 0 || look < worth_it(s->study)) return FW_OK;
    for (int i = 0; i < look; i++)
        FW_TRY(fw_study_sample_new(s->study->arena, s->study, &s->kept[since + i]));
    const fw_study_work work = {.n = look, .fill = fill_more, .take = take, .context = s};
    FW_TRY(fw_study_pool_run(s->study, &work));
    fw_study_sort_samples(&s->kept[since], s->nkept - since);
    s->more_n += look, *left -= look;
    /* so few that each comes near its end: the last search goes on from the best of all */
    int best, each = (int)fmin(2 * worth_it(s->study), half / STARTS);
    FW_TRY(best_whole(s, a, &best));
    FW_TRY(starts(s, a, since, ended, n, search, &n, each, first));
    return run_all(s, search, n, left);
}

/* one that goes on from all that was judged */
static fw_status further(sizing *s, const aim *a, int from, int most, long *first,
                         fw_study_search *one) {
    *one = search_of(a, most, first);
    FW_TRY(fw_study_search_from(s->study, &s->kept[from], one));
    FW_TRY(count_parts(a, one));
    FW_TRY(fw_study_search_knows(s->study, one, s->kept, s->nkept));
    one->begin = FW_NONE;
    return FW_OK;
}

/* with the devices that the others left */
static fw_status go_on(sizing *s, const aim *a, int left, long *first) {
    fw_study_search one;
    int from;
    FW_TRY(best_whole(s, a, &from));
    if (from == FW_NONE || left <= 0) return FW_OK;
    FW_TRY(further(s, a, from, left, first, &one));
    return run_all(s, &one, 1, &left);
}

/* ---- the ends of the ranges ---- */

/* The best for an aim with one of its inputs at an end of its range, each in turn; then the best of these, until none is
   better. A search of few devices ends before the end of a range that its goal leads to, and where several do, in no corner.
   *left: devices that there are for it. Test: tests/cli/test_sizing.py, Ends */
static fw_status try_ends(sizing *s, const aim *a, int *left) {
    const fw_study *study = s->study;
    int(*move)[2] = fw_arena_alloc(study->arena, 2 * (size_t)study->nvary + 1, sizeof *move);
    FW_NEED(move);
    for (int round = 0, was = FW_NONE; round <= study->nvary; round++) {
        int from, n = 0;
        FW_TRY(best_whole(s, a, &from));
        const int before = s->nkept;
        if (from == FW_NONE || from == was) return FW_OK;
        was = from;
        for (int v = 0; v < study->nvary; v++) {
            const fw_study_input *in = &study->input[v];
            if (in->ntext > 0) continue;
            const double share = fw_study_input_share(in, s->kept[from].value[v]);
            for (int end = 0; end < 2; end++)
                if (fabs(share - end) > 1e-6) move[n][0] = v, move[n++][1] = end;
        }
        if (n > *left) n = *left;
        at_ends e = {s, &s->kept[from], FW_STUDY_SEARCH_PART / 2 + s->nend, move};
        const fw_study_work work = {.n = n, .fill = fill_end, .take = take_end, .context = &e};
        FW_TRY(fw_study_pool_run(s->study, &work));
        fw_study_sort_samples(&s->kept[before], n); /* they came in any order */
        s->nend += n, *left -= n;
    }
    return FW_OK;
}

/* Devices of each local search of an aim, *n: of how many at most. Where each would end too early one has those of all. */
static int devices_of_each(const sizing *s, int most, int *n) {
    *n = STARTS;
    if (most >= worth_it(s->study)) return most;
    *n = STARTS * most > s->study->nvary;
    return STARTS * most;
}

/* searches for one aim; all that they judged joins what was judged */
static fw_status seek(sizing *s, const aim *a, int most, long *first) {
    fw_study_search *search = fw_arena_array(s->study->arena, fw_study_search, STARTS);
    int n, of, left = FW_SIZE_SEARCHES * most;
    FW_NEED(search);
    FW_TRY(best_whole(s, a, &n));
    FW_TRY(starts(s, a, 0, NULL, 0, search, &n, devices_of_each(s, most, &of), first));
    if (n > of) n = of;
    FW_TRY(run_all(s, search, n, &left));
    FW_TRY(look_again(s, a, search, n, most, &left, first));
    FW_TRY(try_ends(s, a, &left));
    return go_on(s, a, left, first);
}

/* devices that are left of the budget, but for those that the ends have at last */
static int left_of(const sizing *s) {
    return (int)(fw_study_count_size(s->study) - s->nkept - s->for_ends);
}

/* The ends once more, from all that was judged by now: of a budget that was asked for an eighth is kept for it */
static fw_status ends_again(sizing *s, long *first) {
    for (int g = 0; g < 2; g++) {
        const aim a = {.s = s, .goal = &s->goal[g]};
        FW_TRY(go_on(s, &a, left_of(s) / (2 - g), first));
    }
    return FW_OK;
}

/* devices that are accepted and hold every limit; p: room for all that were judged */
static int accepted(const sizing *s, fw_study_on_front *p) {
    int n = 0;
    for (int i = 0; i < s->nkept; i++) {
        const fw_study_sample *k = &s->kept[i];
        const double c = constraint_of(s->study, k);
        if (k->decision == FW_ACCEPT && c <= 0)
            p[n++] = (fw_study_on_front){{goal_of(k, &s->goal[0]), goal_of(k, &s->goal[1])}, i, c};
    }
    return n;
}

/* The first goal with the second one held at these levels (n), each a search of its own from all that was judged, side by
   side and with its share of what is left; wide: of the second goal, along the front */
static fw_status hold(sizing *s, const double *level, int n, double wide, long *first) {
    aim *held = fw_arena_array(s->study->arena, aim, (size_t)n);
    fw_study_search *search = fw_arena_array(s->study->arena, fw_study_search, (size_t)n);
    int left = left_of(s);
    const int most = left / n;
    FW_NEED(held && search ? held : NULL);
    if (most > s->held_most) s->held_most = most;
    s->levels += n;
    for (int k = 0; k < n; k++) {
        held[k] = (aim){s, &s->goal[0], &s->goal[1], .level = level[k], .scale = wide};
        FW_TRY(further(s, &held[k], best_for(s, &held[k]), most, first, &search[k]));
    }
    return run_all(s, search, n, &left);
}

/* The second goal is held where the front has its widest gaps, at as many levels at once as searches that come somewhere can be paid
   for: at more of them none would. p, level: room for all of them */
static fw_status hold_gaps(sizing *s, fw_study_on_front *p, double *level, long *first) {
    const int each = 2 * worth_it(s->study), passes = s->study->asked->samples > 0 ? PASSES : 1;
    for (int pass = 0; pass < passes; pass++) {
        const int left = left_of(s), room = (PASSES + 1) * FW_SIZE_LEVELS - s->levels,
                  most = (int)fmin(fmin(FW_SIZE_LEVELS, room), fmax(1, left / each)),
                  n = fw_study_front(p, accepted(s, p));
        if (left <= 0 || (s->levels > 0 && left < each)) break;
        const int more = fw_study_front_levels(p, n, level, s->levels, most);
        if (more == 0) break;
        FW_TRY(hold(s, level + s->levels, more, p[0].f[1] - p[n - 1].f[1], first));
    }
    return FW_OK;
}

/* Where a budget was asked for that goes on until it is used, but for a quarter that the ends have first.
   Test: tests/cli/test_sizing.py, Lever, Pair */
static fw_status two_goals(sizing *s, long *first) {
    const fw_study *study = s->study;
    const size_t most = (size_t)fw_study_count_size(study) + 1;
    fw_study_on_front *p = fw_arena_array(study->arena, fw_study_on_front, most);
    double *level = fw_arena_array(study->arena, double, FW_SIZE_LEVELS *(PASSES + 1));
    FW_NEED(p && level ? p : NULL);
    s->for_ends = study->asked->samples > 0 ? left_of(s) / 4 : 0;
    FW_TRY(hold_gaps(s, p, level, first));
    if (s->for_ends == 0) return FW_OK;
    s->for_ends = 0;
    FW_TRY(ends_again(s, first));
    return hold_gaps(s, p, level, first);
}

static fw_status front(sizing *s) {
    fw_study_on_front *p = fw_arena_array(s->study->arena, fw_study_on_front, (size_t)s->nkept + 1);
    FW_NEED(p);
    return fw_study_front_keep(s->study, s->kept, p, accepted(s, p), s->result);
}

static fw_status finish(sizing *s) {
    fw_study_result *r = s->result;
    const aim a = {.s = s, .goal = &s->goal[0]};
    int best;
    FW_TRY(best_whole(s, &a, &best));
    if (best == FW_NONE) return FW_OK;
    double c = constraint_of(s->study, &s->kept[best]);
    if (!(c <= 0)) return fw_study_keep_found(s->study, &s->kept[best], c, &r->nearest);
    if (s->ngoal == 2) return front(s);
    FW_NEED(r->found = fw_arena_one(s->study->arena, fw_study_found));
    r->nfound = 1;
    return fw_study_keep_found(s->study, &s->kept[best], c, r->found);
}

/* what a person is told of the searches */
static const char *said_of(const sizing *s, int single) {
    int n;
    const int each = devices_of_each(s, single, &n);
    const char *alone = n > 1   ? "each"
                        : n > 0 ? "in a single one"
                                : "in a single one (too few: left out)",
               *held = "",
               *beside = s->study->asked->yield > 0
                             ? ", the last ones with the dies that are worst for the best device"
                         : s->watch.n > 0 ? ", at the corners that governed before, and at all of "
                                            "them only of what would be the best"
                                          : "";
    if (s->levels > 0 &&
        !(held = fw_arena_printf(
              s->study->arena, " for a goal alone and %d with the second one held at %s%d level%s",
              s->held_most, s->levels > 1 ? "each of " : "", s->levels, s->levels > 1 ? "s" : "")))
        return NULL;
    return fw_arena_printf(
        s->study->arena,
        "%ld devices over the ranges, then local searches (quadratic models) from the best of "
        "them, at most %d devices %s%s, the same from further devices over the ranges, the best at "
        "ends of the ranges, and one search from all of them%s; a better one may be where none was "
        "tried",
        s->first_n, each, alone, held, beside);
}

static fw_status prepare(sizing *s, int *most) {
    fw_study *study = s->study;
    int n = 0, at;
    for (int k = 0; k < study->nresponse; k++) {
        fw_device_respond_goal g = study->response[k].asked->goal;
        if (g != FW_GOAL_NONE) s->goal[s->ngoal++] = (goal){k, g == FW_GOAL_MINIMISE ? 1 : -1};
    }
    for (int k = 0; k < study->nvary; k++)
        n += study->input[k].ntext == 0;
    s->lists = fw_study_lists_count(study, FW_SIZE_LISTS_MOST, &at);
    long budget = fw_study_count_size(study), searches = fw_study_size_searches(study, s->ngoal);
    s->first_n = (n == 0 ? 1 : 1 + 4 * n) * s->lists;
    if (s->first_n > budget) s->first_n = budget;
    s->ranged = n > 0;
    *most = n == 0 ? 0 : (int)((budget - s->first_n) / searches);
    FW_NEED(s->kept = fw_arena_array(study->arena, fw_study_sample, (size_t)budget + 2));
    for (long i = 0; i < s->first_n; i++)
        FW_TRY(fw_study_sample_new(study->arena, study, &s->kept[i]));
    return fw_chance_sobol_new(study->arena, (size_t)study->nvary, (uint64_t)study->asked->seed,
                               &s->sobol);
}

/* what was judged so far, and searches from the best accepted one with the dies that are worst for it */
static fw_status at_yield(sizing *s, int most, long *first) {
    const aim a = {.s = s, .goal = &s->goal[0]};
    const fw_study_search like = search_of(&a, most, first);
    FW_TRY(fw_study_at_yield(s->study, &like, s->kept, s->nkept, s->result));
    const int best = best_for(s, &a);
    if (s->result->nfound > 0 || s->result->nearest.text || best == FW_NONE) return FW_OK;
    const double missed = constraint_of(s->study, &s->kept[best]);
    return fw_study_keep_found(s->study, &s->kept[best], fmax(missed, 1e-6), &s->result->nearest);
}

/* where corners are watched the first device says which */
static fw_status first_look(sizing *s) {
    fw_study_work work = {.n = 1, .fill = fill, .take = take, .context = s};
    if (s->study->watches) FW_TRY(fw_study_pool_run(s->study, &work));
    if (s->nkept > 0) fw_study_watch_add(&s->watch, s->kept[0].corner);
    work.n = s->first_n;
    FW_TRY(fw_study_pool_run(s->study, &work));
    fw_study_sort_samples(s->kept, s->nkept); /* they came in any order */
    return FW_OK;
}

static fw_status size(fw_study *study, fw_study_result *result) {
    sizing s = {.study = study, .result = result};
    int most;
    long first = FW_STUDY_SEARCH_PART;
    FW_TRY(prepare(&s, &most));
    FW_TRY(first_look(&s));
    const long left = fw_study_count_size(study) - s.first_n;
    /* of two goals each alone has as many as without a budget, up to half of it: a front reaches no farther than its ends */
    const int ends = (int)fmin(FW_SIZE_EACH * (study->nvary + 1),
                               (double)(left / 4) / FW_SIZE_SEARCHES),
              single = s.ngoal == 2 && s.ranged && ends > most ? ends : most;
    for (int g = 0; g < s.ngoal && single > 0; g++) {
        const aim a = {.s = &s, .goal = &s.goal[g]};
        FW_TRY(seek(&s, &a, single, &first));
    }
    if (s.ngoal == 2 && single > 0) FW_TRY(two_goals(&s, &first));
    FW_NEED(result->how = said_of(&s, single));
    FW_TRY(study->asked->yield > 0 ? at_yield(&s, most, &first) : finish(&s));
    if (result->nearest.text) return fw_study_tell_limits(study, &result->nearest);
    return result->nfound == 1 && s.ngoal == 1 ? fw_study_tell_limits(study, result->found) : FW_OK;
}

/* At a wanted yield nobody knows how many dies will be asked for; else no more is judged than the budget */
fw_status fw_study_kind_size(fw_study *study, fw_study_result *result) {
    fw_study_told told = {.most = study->asked->yield > 0 ? 0 : fw_study_count_size(study),
                          .begun_s = fw_study_now_s(),
                          .thread = pthread_self()};
    study->told = &told;
    fw_status status = size(study, result);
    study->told = NULL;
    return status;
}
