/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local searches (study_descent.c) for the least value of an objective where constraints are at most 0, several at once.

   In: shares of the ranges as starts; every candidate is written with few digits, read, drawn and judged as
   that text says, so that what is found is a design and no rounding of one. The best of all that was tried
   counts, not the last. Cost: `most` devices each. Test: tests/cli/test_study.py */
#include "study/study_parts.h"
#include "verdict/verdict_fabrication.h"
#include <math.h>
#include <pthread.h>
#include <string.h>

typedef struct board { /* of all searches of one run */
    fw_study *study;
    fw_study_search *search;
    pthread_mutex_t lock; /* of status and the store */
    fw_status status;
} board;

typedef struct one { /* of one search */
    board *board;
    fw_study_search *s;
    fw_study_sample now;
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

/* what was judged, as the search sees it */
static void see(const fw_study_search *s, const fw_study_sample *sample, fw_study_tried *t) {
    t->f = sample->run ? s->objective(s->context, sample) : (double)NAN;
    t->untold = true;
    for (int k = 0; k < s->nconstraint; k++)
        t->c[k] = (double)NAN;
    if (!isnan(t->f)) s->constraint(s->context, sample, t->c, &t->untold);
}

/* the best is kept */
static void numbers(one *o, fw_study_tried *t) {
    fw_study_search *s = o->s;
    see(s, &o->now, t);
    const double c = fw_study_tried_worst(t, s->nconstraint);
    if (s->used > 1 && !fw_study_search_better(t->f, c, s->f, s->c)) return;
    s->f = t->f, s->c = c;
    fw_study_sample_copy(o->board->study, &o->now, &s->best);
}

static bool judge(void *context, fw_study_tried *t) {
    one *o = context;
    board *b = o->board;
    o->now.i = o->s->first + o->s->used++;
    if (b->study->told) atomic_fetch_add(&b->study->told->done, 1);
    fw_status status = fill(b->study, o->s, t->x, &o->now);
    if (status == FW_OK) status = evaluate(o);
    if (status == FW_OK) status = fill(b->study, o->s, t->x, &o->now); /* texts, after the store */
    if (status != FW_OK) {
        pthread_mutex_lock(&b->lock);
        if (b->status == FW_OK) b->status = status;
        pthread_mutex_unlock(&b->lock);
        o->now.run = false;
    }
    numbers(o, t);
    return status == FW_OK;
}

static fw_status search(board *b, fw_study_search *s, fw_arena *arena) {
    one o = {.board = b, .s = s};
    fw_study_descent d = {.n = ranged(b->study),
                          .m = s->nconstraint,
                          .most = s->most,
                          .judge = judge,
                          .context = &o,
                          .tried = s->tried};
    FW_TRY(fw_study_sample_new(arena, b->study, &o.now));
    s->used = 0;
    if (d.n == 0) {
        judge(&o, s->tried);
        return FW_OK;
    }
    return s->known ? fw_study_descent_models(&d, s->known, s->nknown, arena)
                    : fw_study_descent_cobyla(&d, s->start, arena);
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

static bool same_lists(const fw_study *study, const fw_study_sample *a, const fw_study_sample *b) {
    for (int k = 0; k < study->nvary; k++)
        if (study->input[k].ntext > 0 && strcmp(a->text[k], b->text[k]) != 0) return false;
    return true;
}

double fw_study_search_apart(const fw_study *study, const fw_study_sample *a,
                             const fw_study_sample *b) {
    double most = 0;
    for (int k = 0; k < study->nvary; k++) {
        const fw_study_input *in = &study->input[k];
        if (in->ntext > 0)
            most = strcmp(a->text[k], b->text[k]) != 0 ? 1 : most;
        else
            most = fmax(most, fabs(a->value[k] - b->value[k]) / (in->to - in->from));
    }
    return most;
}

fw_status fw_study_search_knows(const fw_study *study, fw_study_search *s,
                                const fw_study_sample *sample, int nsample,
                                const fw_study_search *search, int nsearch) {
    int most = nsample;
    fw_study_tried *known;
    for (int i = 0; i < nsearch; i++)
        most += search[i].used;
    FW_NEED(known = fw_arena_array(study->arena, fw_study_tried, (size_t)most + 1));
    s->known = known;
    for (int i = 0; i < nsample; i++) {
        fw_study_search shares;
        if (!same_lists(study, &sample[i], s->from)) continue;
        fw_study_tried *t = &known[s->nknown++];
        FW_NEED(t->c = fw_arena_array(study->arena, double, (size_t)s->nconstraint));
        FW_TRY(fw_study_search_from(study, &sample[i], &shares));
        t->x = shares.start;
        see(s, &sample[i], t);
    }
    for (int i = 0; i < nsearch; i++)
        for (int k = 0; k < search[i].used && same_lists(study, search[i].from, s->from); k++)
            known[s->nknown++] = search[i].tried[k];
    return FW_OK;
}

static fw_status room_for_tried(const fw_study *study, fw_study_search *s) {
    const size_t n = (size_t)ranged(study), most = (size_t)(s->most > 0 ? s->most : 1);
    double *x = fw_arena_array(study->arena, double, most *n + 1),
           *c = fw_arena_array(study->arena, double, most *(size_t)s->nconstraint + 1);
    FW_NEED(x && c ? x : NULL);
    FW_NEED(s->tried = fw_arena_array(study->arena, fw_study_tried, most));
    for (size_t i = 0; i < most; i++)
        s->tried[i].x = x + i * n, s->tried[i].c = c + i * (size_t)s->nconstraint;
    return FW_OK;
}

fw_status fw_study_search_run(fw_study *study, fw_study_search *search, int n) {
    board b = {.study = study, .search = search};
    for (int i = 0; i < n; i++) {
        search[i].f = search[i].c = (double)NAN;
        FW_TRY(fw_study_sample_new(study->arena, study, &search[i].best));
        FW_TRY(room_for_tried(study, &search[i]));
    }
    pthread_mutex_init(&b.lock, NULL);
    fw_status status = fw_study_each(study, n, search_one, &b);
    pthread_mutex_destroy(&b.lock);
    return status;
}

/* ---- what comes of them ---- */

fw_status fw_study_keep_found(fw_study *study, const fw_study_sample *sample, double excess,
                              fw_study_found *found) {
    fw_study_sample own;
    FW_TRY(fw_study_sample_new(study->arena, study, &own));
    fw_study_sample_copy(study, sample, &own);
    *found = (fw_study_found){.text = own.text,
                              .value = own.value,
                              .response = own.response,
                              .excess = excess,
                              .decision = own.decision,
                              .i = own.i};
    return FW_OK;
}

fw_status fw_study_check_apart(fw_study *study) {
    if (study->asked->kind != FW_STUDY_IS_size) return FW_OK;
    return fw_diag_error(
        &study->diags, 490, study->asked->place,
        "shards: a study of kind %s chooses each of its samples by the ones before; "
        "run it in one piece, in as many threads as there are (--jobs); or, for several machines, "
        "a study on each "
        "with a part of the ranges, of which the best is the answer",
        fw_device_study_kind_text(study->asked->kind));
}

/* ---- where a device is among all of a sweep, for response surfaces (study_fitted.c) ----
   Inputs that are chosen go by the share of their range. Of what is left to chance a device has the values of its settings
   and, of its flow, the state that they make (fw_verdict_fabrication): how far edges stand out, how much walls flare,
   thickness and modulus against what is drawn. Whatever differs in a flow, and wherever on the wafer the die is, the device
   is a function of these four numbers alone. */

enum { STATE = 4 };

static int chances(const fw_study *study) {
    return study->nsetting + (study->asked->judge == FW_JUDGE_DIE ? STATE : 0);
}

static void chance_of(const fw_study *study, const fw_study_sample *sample, double *at) {
    const int first = study->nvary + study->nsetting;
    if (study->nsetting > 0)
        memcpy(at, sample->value + study->nvary, (size_t)study->nsetting * sizeof *at);
    if (study->asked->judge != FW_JUDGE_DIE) return;
    const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[0];
    const fw_verdict_fabrication made =
        fw_verdict_fabrication_at(v->input, v->ninput, sample->value + first);
    const double state[STATE] = {made.edge_m, made.flare_m, made.thickness_ratio,
                                 made.youngs_ratio};
    memcpy(at + study->nsetting, state, sizeof state);
}

void fw_study_axes_place(const fw_study_axes *axes, const fw_study *study,
                         const fw_study_sample *sample, double *z) {
    const int vary = study->nvary;
    for (int v = 0; v < vary; v++)
        z[v] = 2 * fw_study_input_share(&study->input[v], sample->value[v]) - 1;
    chance_of(study, sample, axes->chance);
    for (int a = 0; a < axes->n; a++) {
        const fw_study_chance_axis *x = &axes->axis[a];
        const double low = x->low.value[0], high = x->high.value[0];
        z[vary + a] = 2 * (axes->chance[x->number] - low) / (high - low) - 1;
    }
}

/* keeps the outermost; way: 1 the largest, -1 the least */
static void keep_end(fw_study_outer *e, double value, long at, int way) {
    for (int i = 0; i < FW_STUDY_FARTHEST; i++) {
        if (e->at[i] >= 0 && way * (value - e->value[i]) <= 0) continue;
        memmove(e->value + i + 1, e->value + i, (size_t)(FW_STUDY_FARTHEST - 1 - i) * sizeof value);
        memmove(e->at + i + 1, e->at + i, (size_t)(FW_STUDY_FARTHEST - 1 - i) * sizeof at);
        e->value[i] = value, e->at[i] = at;
        return;
    }
}

/* Each goes from -1 to 1 between the devices that have least and most of it. These and some beside them are judged first: no
   device that is told lies beyond, and what a surface misses at the ends is seen by others near by. One that is the same in
   all devices is left out. */
fw_status fw_study_axes_find(const fw_study *study, const fw_study_points *points,
                             fw_study_sample *room, fw_study_axes *out) {
    const int n = chances(study);
    *out = (fw_study_axes){.n = 0};
    FW_NEED(out->axis = fw_arena_array(study->arena, fw_study_chance_axis, (size_t)n));
    FW_NEED(out->chance = fw_arena_array(study->arena, double, (size_t)n + 1));
    for (int i = 0; i < n; i++)
        for (int k = 0; k < FW_STUDY_FARTHEST; k++)
            out->axis[i].low.at[k] = out->axis[i].high.at[k] = -1;
    for (long k = 0; n > 0 && k < points->n; k++) {
        if (fw_cancel_requested(study->options.cancel)) return FW_CANCELLED;
        FW_TRY(points->at(points->context, k, room));
        chance_of(study, room, out->chance);
        for (int i = 0; i < n; i++) {
            keep_end(&out->axis[i].low, out->chance[i], k, -1);
            keep_end(&out->axis[i].high, out->chance[i], k, 1);
        }
    }
    for (int i = 0; i < n; i++) {
        const double low = out->axis[i].low.value[0], high = out->axis[i].high.value[0];
        if (!(high - low > 1e-12 * fabs(high))) continue;
        out->axis[out->n] = out->axis[i];
        out->axis[out->n++].number = i;
    }
    return FW_OK;
}
