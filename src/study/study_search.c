/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local searches for the least value of an objective where a constraint is at most 0, by COBYLA (linear
   models on a simplex, no derivatives; Powell 1994, as NLopt has it), several at once.

   In: shares of the ranges as starts; every candidate is written with few digits, read, drawn and judged as
   that text says, so that what is found is a design and no rounding of one. The best of all that was tried
   counts, not the last. Cost: `most` devices each. Test: tests/cli/test_study.py */
#include "study/study_parts.h"
#include <math.h>
#include <nlopt.h>
#include <pthread.h>
#include <string.h>

static const double rho = 0.15;      /* first step, share of a range */
static const double fine = 2e-4;     /* last step */
static const double as_bad_as = 1e3; /* of what could not be run */

bool fw_study_search_better(double fa, double ca, double fb, double cb) {
    if (isnan(ca)) return false;
    if (isnan(cb)) return true;
    if (ca <= 0 && cb <= 0) return fa < fb;
    return ca <= 0 || (cb > 0 && ca < cb);
}

typedef struct board { /* of all searches of one run */
    fw_study *study;
    fw_study_search *search;
    pthread_mutex_t lock; /* of status and the store */
    fw_status status;
} board;

typedef struct one { /* of one search */
    board *board;
    fw_study_search *s;
    nlopt_opt opt;
    fw_study_sample now;
    double *last; /* shares of `now` */
    bool known;   /* now is of last */
    double f, c, scale;
} one;

static int ranged(const fw_study *study) {
    int n = 0;
    for (int k = 0; k < study->nvary; k++)
        n += study->input[k].ntext == 0;
    return n;
}

static fw_status fill(const fw_study *study, const fw_study_search *s, const double *share,
                      fw_study_sample *sample) {
    int at = 0;
    for (int k = 0; k < study->ninput; k++)
        if (k < study->nvary && study->input[k].ntext == 0)
            FW_TRY(fw_study_input_at(&study->input[k], share[at++], s->digits, sample->text[k],
                                     &sample->value[k]));
        else
            memcpy(sample->text[k], s->from->text[k], FW_STUDY_TEXT),
                sample->value[k] = s->from->value[k];
    return FW_OK;
}

/* from the store, or run and kept */
static fw_status evaluate(one *o) {
    board *b = o->board;
    bool there = false, changed = false;
    fw_status status = FW_OK;
    pthread_mutex_lock(&b->lock);
    if (b->status != FW_OK) status = b->status;
    if (status == FW_OK && b->study->store)
        status = fw_study_store_get(b->study->store, o->now.i, &o->now, &there);
    if (status == FW_OK && !there && b->study->stored_only)
        status = fw_diag_error(&b->study->diags, 497, (fw_place){.file = b->study->options.file},
                               "sample %ld is in none of the shards; run the shard that has it to "
                               "its end with --resume",
                               o->now.i);
    pthread_mutex_unlock(&b->lock);
    if (status != FW_OK || there) return status;
    FW_TRY(fw_study_evaluate(b->study, b->study->options.cancel, &o->now, &changed));
    if (o->s->besides && o->now.run) FW_TRY(o->s->besides(o->s->context, &o->now));
    pthread_mutex_lock(&b->lock);
    status = fw_study_keep(b->study, &o->now);
    pthread_mutex_unlock(&b->lock);
    fw_study_tell(b->study);
    return status;
}

/* objective and constraint at these shares, once for both */
static void look(one *o, unsigned n, const double *x) {
    fw_study_search *s = o->s;
    if (o->known && memcmp(x, o->last, n * sizeof *x) == 0) return;
    memcpy(o->last, x, n * sizeof *x);
    o->known = true;
    o->now.i = s->first + s->used++;
    if (o->board->study->told) atomic_fetch_add(&o->board->study->told->done, 1);
    fw_status status = fill(o->board->study, s, x, &o->now);
    if (status == FW_OK) status = evaluate(o);
    if (status == FW_OK) status = fill(o->board->study, s, x, &o->now); /* texts, after the store */
    if (status != FW_OK) {
        pthread_mutex_lock(&o->board->lock);
        if (o->board->status == FW_OK) o->board->status = status;
        pthread_mutex_unlock(&o->board->lock);
        nlopt_force_stop(o->opt);
        return;
    }
    o->f = o->now.run ? s->objective(s->context, &o->now) : (double)NAN;
    o->c = o->now.run ? s->constraint(s->context, &o->now) : (double)NAN;
    if (isnan(o->f)) o->c = (double)NAN;
    if (s->used == 1 || fw_study_search_better(o->f, o->c, s->f, s->c)) {
        s->f = o->f, s->c = o->c;
        fw_study_sample_copy(o->board->study, &o->now, &s->best);
    }
    if (!(o->scale > 0) && isfinite(o->f)) o->scale = fmax(fabs(o->f), 1e-300);
    if (s->used >= s->most) nlopt_force_stop(o->opt);
}

static double objective(unsigned n, const double *x, double *gradient, void *context) {
    one *o = context;
    (void)gradient;
    look(o, n, x);
    return isfinite(o->f) ? o->f / o->scale : as_bad_as;
}

static double constraint(unsigned n, const double *x, double *gradient, void *context) {
    one *o = context;
    (void)gradient;
    look(o, n, x);
    return isfinite(o->c) ? o->c : o->c < 0 ? -1.0 : as_bad_as;
}

static fw_status search(board *b, fw_study_search *s, fw_arena *arena) {
    unsigned n = (unsigned)ranged(b->study);
    one o = {.board = b, .s = s};
    double least;
    FW_TRY(fw_study_sample_new(arena, b->study, &o.now));
    FW_NEED(o.last = fw_arena_array(arena, double, n + 1));
    s->used = 0;
    if (n == 0) {
        look(&o, 0, s->start);
        return FW_OK;
    }
    FW_NEED(o.opt = nlopt_create(NLOPT_LN_COBYLA, n));
    nlopt_set_min_objective(o.opt, objective, &o);
    nlopt_add_inequality_constraint(o.opt, constraint, &o, 1e-9);
    nlopt_set_lower_bounds1(o.opt, 0);
    nlopt_set_upper_bounds1(o.opt, 1);
    nlopt_set_initial_step1(o.opt, rho);
    nlopt_set_xtol_abs1(o.opt, fine);
    nlopt_set_maxeval(o.opt, s->most);
    nlopt_optimize(o.opt, s->start, &least); /* what it met is what counts */
    nlopt_destroy(o.opt);
    return FW_OK;
}

static fw_status search_one(void *context, long i) {
    board *b = context;
    fw_arena *arena = fw_arena_new(0);
    FW_NEED(arena);
    fw_status status = search(b, &b->search[i], arena);
    fw_arena_free(arena);
    return status == FW_OK ? b->status : status;
}

fw_status fw_study_search_from(const fw_study *study, const fw_study_sample *from,
                               fw_study_search *s) {
    int at = 0;
    s->from = from;
    FW_NEED(s->start = fw_arena_array(study->arena, double, (size_t)study->nvary + 1));
    for (int k = 0; k < study->nvary; k++)
        if (study->input[k].ntext == 0)
            s->start[at++] = fw_study_input_share(&study->input[k], from->value[k]);
    return FW_OK;
}

fw_status fw_study_search_run(fw_study *study, fw_study_search *search, int n) {
    board b = {.study = study, .search = search};
    for (int i = 0; i < n; i++) {
        search[i].f = search[i].c = (double)NAN;
        FW_TRY(fw_study_sample_new(study->arena, study, &search[i].best));
    }
    pthread_mutex_init(&b.lock, NULL);
    fw_status status = fw_study_each(study, n, search_one, &b);
    pthread_mutex_destroy(&b.lock);
    return status;
}
