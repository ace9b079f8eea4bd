/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worst case: the least and the largest value of every response within the ranges. Corners (of many inputs: of a
   Sobol' sequence), the middle and points between are judged; from the best of them a local search goes on
   for each end of each response. Every shard judges what the searches begin from, and a share of the searches. A value that was found is one that a device has; that none lies beyond it is not proved.
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
    PART = 1000000     /* numbers of samples of one search begin at a multiple of it */
};

typedef struct worst {
    fw_study *study;
    fw_chance_sobol sobol;
    long corners, n;
    fw_study_sample *kept; /* (n) by number */
    int nkept;
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
                                .most = most,
                                .digits = DIGITS,
                                .first = first};
    return fw_study_search_from(w->study, best, search);
}

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

static int search_of(const fw_study *study) {
    return SEARCH_USUAL * (study->ninput + 1);
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
    for (int k = 0; k < running; k++)
        take_end(&aim[of[k]], &search[k], &result->end[of[k]]);
    FW_NEED(result->how =
                fw_arena_printf(study->arena,
                                "%ld corners, the middle and %ld points between, then a local "
                                "search (COBYLA, at most %d "
                                "devices) for each end; that nothing lies beyond is not proved",
                                w.corners, w.n - w.corners - 1, most));
    return FW_OK;
}
