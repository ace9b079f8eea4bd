/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worst case: the least and the largest value of every response within the ranges. Corners (of many inputs: of a
   Sobol' sequence), the middle and points between are judged; from the best of them a local search goes on
   for each end of each response. Where a ridge leads to an end of a range its few devices climb a part of that: the best of
   them is tried with its inputs at their ends, of three at most in every combination, and the search goes on from the best of
   these. Every shard judges what the searches begin from, and a share of the searches. An end is the most extreme of all
   devices that were judged, whatever search came to it: a value that a device has; that none lies beyond it is not proved.
   Devices without a value (beyond pull-in, not drawable) are often the worst: fw_study_without_say tells of them.
   Test: tests/cli/test_study.py */
#include "chance/random.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum {
    CORNERS_MOST = 10, /* inputs of which all corners are looked at */
    BETWEEN = 8,       /* points of the sequence for each input, and so many more */
    DIGITS = 9,
    SEARCH_USUAL = 15, /* devices of a search for each input, and so many more */
    TOGETHER = 3,      /* inputs of which ends are tried in every combination */
    ROUNDS = 2,        /* of ends, and a search that goes on from them */
    ON = 6,            /* devices of such a search, as SEARCH_USUAL */
    PART = 1000000     /* numbers of samples of one search begin at a multiple of it */
};

typedef struct worst {
    fw_study *study;
    fw_chance_sobol sobol;
    long corners, n;
    fw_study_sample *kept; /* (n) by number */
    int nkept;
    fw_study_end *end; /* (nresponse x 2) */
} worst;

static int values_of(const fw_study_input *in) {
    return in->ntext > 0 ? in->ntext : 2;
}

static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const worst *w = context;
    long rest = k;
    *wanted = true;
    sample->i = k;
    for (int v = 0; v < w->study->ninput; v++) {
        const fw_study_input *in = &w->study->input[v];
        double share =
            k == w->corners
                ? 0.5
                : fw_chance_sobol_uniform(&w->sobol, (uint64_t)(k - w->corners), (size_t)v);
        if (k < w->corners) {
            int values = values_of(in), digit = (int)(rest % values);
            rest /= values;
            share = in->ntext > 0 ? (digit + 0.5) / values : digit;
        }
        FW_TRY(fw_study_input_at(in, share, DIGITS, sample->text[v], &sample->value[v]));
    }
    return FW_OK;
}

static fw_status take(void *context, const fw_study_sample *sample) {
    worst *w = context;
    const fw_study *study = w->study;
    fw_study_sample *to = &w->kept[w->nkept++];
    bool wanted;
    to->run = sample->run, to->decision = sample->decision, to->used = sample->used;
    memcpy(to->response, sample->response, (size_t)study->nresponse * sizeof *to->response);
    return fill(w, sample->i, to, &wanted);
}

/* ---- ends of ranges ---- */

static const double on_step = 0.02; /* first one of a search that goes on, share of a range */
static const double gain = 1e-6;    /* share of a value by which it is better */

/* devices with inputs of n at their ends */
static int ends_of(int n) {
    int all = 1;
    for (int i = 0; i < n && n <= TOGETHER; i++)
        all *= 3;
    return n <= TOGETHER ? all - 1 : 2 * n;
}

static int ends_most(int n) {
    return ROUNDS * (ends_of(n) + ON * (n + 1));
}

static const fw_study_tried *best_tried(const fw_study_descent *d) {
    const fw_study_tried *best = d->tried;
    for (int i = 1; i < d->used; i++)
        if (fw_study_search_better(d->tried[i].f, d->tried[i].c[0], best->f, best->c[0]))
            best = &d->tried[i];
    return best;
}

/* The `which`-th of them, from 1: of three at most by its digits to the base of 3 (0 as it is, 1 least, 2 largest), of more
   one input. false: nothing moves, or it is a corner and these were judged before */
static bool at_ends(int n, int which, bool corners, double *x) {
    bool moved = false, corner = true;
    for (int i = 0; i < n; i++) {
        const int rest = n <= TOGETHER ? which % 3 : which - 2 * i;
        const int to = rest == 1 || rest == 2 ? rest : 0;
        moved = moved || (to > 0 && x[i] != to - 1);
        if (to > 0) x[i] = to - 1;
        corner = corner && (x[i] == 0 || x[i] == 1);
        if (n <= TOGETHER) which /= 3;
    }
    return moved && !(corner && corners);
}

/* of many inputs each goes on from the best so far, so that one round may bring all of them to their ends */
static void try_ends(fw_study_descent *d, bool corners) {
    const fw_study_tried *from = best_tried(d);
    const size_t bytes = (size_t)d->n * sizeof *from->x;
    for (int k = 1; k <= ends_of(d->n) && !d->over; k++) {
        if (d->n > TOGETHER) from = best_tried(d);
        fw_study_tried *t = &d->tried[d->used];
        memcpy(t->x, from->x, bytes);
        if (!at_ends(d->n, k, corners, t->x)) continue;
        d->used++;
        d->over = !d->judge(d->context, t) || d->used >= d->most;
    }
}

/* COBYLA with at most so many devices */
static fw_status descend_by(fw_study_descent *d, int most, double *start, fw_arena *arena) {
    const int all = d->most;
    if (d->used + most < all) d->most = d->used + most;
    FW_TRY(fw_study_descent_cobyla(d, start, arena));
    if (d->used == d->most) d->over = false; /* it had no more */
    d->most = all;
    return FW_OK;
}

static fw_status descend_and_try(fw_study_descent *d, bool corners, double *start,
                                 fw_arena *arena) {
    FW_TRY(descend_by(d, d->most - ends_most(d->n), start, arena));
    d->step = on_step;
    for (int k = 0; k < ROUNDS && !d->over; k++) {
        const fw_study_tried *was = best_tried(d);
        try_ends(d, corners);
        const fw_study_tried *best = best_tried(d);
        if (d->over || !(best->f < was->f - gain * fabs(was->f))) return FW_OK;
        memcpy(start, best->x, (size_t)d->n * sizeof *start);
        FW_TRY(descend_by(d, ON * (d->n + 1), start, arena));
    }
    return FW_OK;
}

static fw_status after_corners(fw_study_descent *d, double *start, fw_arena *arena) {
    return descend_and_try(d, true, start, arena);
}

static fw_status after_points(fw_study_descent *d, double *start, fw_arena *arena) {
    return descend_and_try(d, false, start, arena);
}

/* ---- a search for an end of a response ---- */

typedef struct end_aim {
    int response;
    double sign;
} end_aim;

static double objective(const void *context, const fw_study_sample *sample) {
    const end_aim *a = context;
    return a->sign * sample->response[a->response];
}

static void no_constraint(const void *context, const fw_study_sample *sample, double *c,
                          bool *untold) {
    const end_aim *a = context;
    *untold = isnan(sample->response[a->response]);
    *c = *untold ? (double)NAN : -1;
}

/* from the most extreme of what was judged */
static fw_status begin_search(const worst *w, end_aim *a, long first, int most,
                              fw_study_search *search, bool *found) {
    const fw_study_sample *best = NULL;
    for (int i = 0; i < w->nkept; i++)
        if (w->kept[i].run && !isnan(objective(a, &w->kept[i])) &&
            (!best || objective(a, &w->kept[i]) < objective(a, best)))
            best = &w->kept[i];
    *found = best != NULL;
    if (!best) return FW_OK;
    *search = (fw_study_search){.objective = objective,
                                .nconstraint = 1,
                                .constraint = no_constraint,
                                .context = a,
                                .descend = w->corners > 0 ? after_corners : after_points,
                                .most = most,
                                .digits = DIGITS,
                                .first = first};
    return fw_study_search_from(w->study, best, search);
}

/* of all devices: what other searches came to, too */
static fw_status take_row(void *context, const fw_study_sample *sample) {
    const worst *w = context;
    const fw_study *study = w->study;
    for (int e = 0; sample->run && e < 2 * study->nresponse; e++) {
        const end_aim a = {e / 2, e % 2 == 0 ? 1 : -1};
        fw_study_end *end = &w->end[e];
        const double value = sample->response[a.response];
        if (isnan(value) || (end->known && !(a.sign * value < a.sign * end->value))) continue;
        if (!end->text)
            FW_NEED(end->text =
                        fw_arena_alloc(study->arena, (size_t)study->ninput, sizeof *end->text));
        end->value = value, end->known = true;
        FW_TRY(fw_study_settings_write(study, sample, DIGITS, end->text));
    }
    return FW_OK;
}

/* where nothing is stored */
static void take_end(const end_aim *a, const fw_study_search *s, fw_study_end *end) {
    const fw_study_sample *best = s->from;
    if (s->best.run && objective(a, &s->best) < objective(a, best)) best = &s->best;
    *end = (fw_study_end){.value = best->response[a->response], .text = best->text, .known = true};
}

/* 0: too many to look at */
static long corners_of(const fw_study *study) {
    long corners = 1;
    for (int v = 0; v < study->ninput && corners <= 1L << CORNERS_MOST; v++)
        corners *= values_of(&study->input[v]);
    return corners <= 1L << CORNERS_MOST ? corners : 0;
}

static long points_of(const fw_study *study) {
    long corners = corners_of(study), asked = study->asked->samples;
    return corners + 1 + (asked > 0 ? asked : BETWEEN * (study->ninput + 1L) + (corners ? 0 : 128));
}

static int ranged(const fw_study *study) {
    int n = 0;
    for (int k = 0; k < study->ninput; k++)
        n += study->input[k].ntext == 0;
    return n;
}

static int search_of(const fw_study *study) {
    return SEARCH_USUAL * (study->ninput + 1) + ends_most(ranged(study));
}

long fw_study_count_worst_case(const fw_study *study) {
    return points_of(study) + 2L * study->nresponse * search_of(study);
}

fw_status fw_study_check_worst_case(fw_study *study) {
    (void)study; /* any inputs and any responses will do */
    return FW_OK;
}

fw_status fw_study_kind_worst_case(fw_study *study, fw_study_result *result) {
    worst w = {.study = study, .corners = corners_of(study), .n = points_of(study)};
    int n = study->ninput, ends = 2 * study->nresponse, running = 0, most = search_of(study);
    FW_TRY(fw_chance_sobol_new(study->arena, (size_t)n, (uint64_t)study->asked->seed, &w.sobol));
    FW_NEED(w.kept = fw_arena_array(study->arena, fw_study_sample, (size_t)w.n));
    for (long i = 0; i < w.n; i++)
        FW_TRY(fw_study_sample_new(study->arena, study, &w.kept[i]));
    const fw_study_work work = {.n = w.n, .fill = fill, .take = take, .context = &w};
    FW_TRY(fw_study_pool_run(study, &work));
    fw_study_sort_samples(w.kept, w.nkept);

    FW_NEED(result->end = fw_arena_array(study->arena, fw_study_end, (size_t)ends));
    fw_study_search *search = fw_arena_array(study->arena, fw_study_search, (size_t)ends);
    end_aim *aim = fw_arena_array(study->arena, end_aim, (size_t)ends);
    int *of = fw_arena_array(study->arena, int, (size_t)ends);
    FW_NEED(search && aim && of ? search : NULL);
    for (int e = 0; e < ends; e++) {
        bool found;
        aim[e] = (end_aim){e / 2, e % 2 == 0 ? 1 : -1};
        FW_TRY(begin_search(&w, &aim[e], PART * (e + 1L), most, &search[running], &found));
        if (found) of[running++] = e;
    }
    if (study->options.shards > 0) { /* its own searches; merging has the results */
        int own = 0;
        for (int k = 0; k < running; k++)
            if (fw_study_is_due(study, of[k])) search[own++] = search[k];
        return fw_study_search_run(study, search, own);
    }
    FW_TRY(fw_study_search_run(study, search, running));
    w.end = result->end;
    if (study->store) FW_TRY(fw_study_store_each(study->store, take_row, &w));
    for (int k = 0; !study->store && k < running; k++)
        take_end(&aim[of[k]], &search[k], &result->end[of[k]]);
    FW_NEED(result->how =
                fw_arena_printf(study->arena,
                                "%ld corners, the middle and %ld points between, then for each "
                                "end a local search (COBYLA), its best with inputs at ends of "
                                "their ranges, and on from there, at most %d devices; each value "
                                "is the most extreme of all devices that were judged and have "
                                "one: that none "
                                "lies beyond it where none was, as at a resonance narrower than "
                                "points are apart, is not proved",
                                w.corners, w.n - w.corners - 1, most));
    return FW_OK;
}
