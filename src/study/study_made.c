/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices that a flow may make of a description, as a limit state of independent standard normal numbers: each judged as
   made, once for its values, in threads, and kept in the store under its number. A shard judges what chooses later points
   and its share of the rest. Test: tests/cli/test_study.py */
#include "base/text.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include "verdict/verdict_fabrication.h"
#include <math.h>
#include <string.h>
#include <time.h>

/* ---- one batch of devices, in threads ---- */

typedef struct batch {
    fw_study_yielding *y;
    size_t n;
    const double *x;           /* (n x npoint) */
    const long *number;        /* (n) of their samples */
    fw_verdict_made *made;     /* (n) */
    bool *wanted;              /* (n) not known from before */
    char (*why)[FW_STUDY_WHY]; /* (n) what is not known of it; "" */
    double *response;          /* (n x nresponse) */
} batch;

static const fw_verdict_made nothing_known = {
    .ln = (double)NAN, .low = (double)NAN, .high = (double)NAN};

/* far enough out a distribution has values that no number can have: that device is not judged */
static fw_status not_a_number(fw_arena *arena, const char *what, fw_verdict_made *made) {
    *made = nothing_known;
    FW_NEED(made->why = fw_arena_printf(arena, "%s would be beyond all numbers", what));
    return FW_OK;
}

/* with settings of its own: the description read again and judged as drawn, then as made */
static fw_status judge_restated(const fw_study_yielding *y, fw_arena *arena, const double *x,
                                fw_verdict_made *made) {
    const fw_study *study = y->study;
    const fw_plan *plan = study->plan;
    int n = study->nsetting, before = y->nbase;
    fw_device_set *set = fw_arena_array(arena, fw_device_set, (size_t)(n + before));
    fw_verdict_variant_verdict *variant =
        fw_arena_array(arena, fw_verdict_variant_verdict, (size_t)plan->nflow);
    const fw_device *device;
    const fw_layout *layout = NULL;
    fw_diags diags = fw_diags_new(arena);
    FW_NEED(set && variant ? set : NULL);
    for (int k = 0; k < before; k++)
        set[k] = y->base[k];
    for (int k = 0; k < n; k++) {
        char *text = fw_arena_array(arena, char, FW_STUDY_TEXT);
        double shown;
        FW_NEED(text);
        const fw_study_input *in = &study->input[study->nvary + k];
        if (!isfinite(fw_quantity_unit_from_si(&in->unit, x[y->ninput + k])))
            return not_a_number(arena, in->what, made);
        FW_TRY(fw_study_input_write(in, x[y->ninput + k], 12, text, &shown));
        set[before + k] = (fw_device_set){study->input[study->nvary + k].what, text};
    }
    *made = nothing_known;
    fw_status status = fw_plan_restated(plan, arena, set, before + n, &diags, &device, variant);
    fw_verdict verdict = {.nvariant = plan->nflow, .variant = variant};
    fw_verdict_options options = plan->options.verdict;
    options.corners = FW_CORNERS_NONE;
    options.with_advice = false;
    options.at_a_glance = true;
    options.motion.effects.untold = true;
    if (status == FW_OK)
        status = fw_verdict_run(arena, device, &options, &diags, &verdict, &layout);
    if (status == FW_OK)
        status = fw_verdict_made_at(arena, device, layout, &options, &variant[y->flow], x, made);
    if (status == FW_NOMEM || status == FW_CANCELLED || status == FW_OK) return status;
    *made = nothing_known;
    for (size_t i = 0; i < diags.count; i++) /* the first error says it */
        if (diags.item[i].severity == FW_ERROR && !made->why) made->why = diags.item[i].message;
    return FW_OK;
}

fw_status fw_study_yielding_judge(const fw_study_yielding *y, const double *x,
                                  fw_verdict_made *made, char *why, double *response) {
    const fw_plan *plan = y->study->plan;
    fw_arena *arena = fw_arena_part(plan->arena, 0);
    FW_NEED(arena);
    fw_arena_stop_with(arena, y->study->options.cancel);
    fw_status status;
    if (y->study->nsetting + y->nbase > 0)
        status = judge_restated(y, arena, x, made);
    else
        status = fw_verdict_made_at(arena, plan->device, plan->layout, &plan->options.verdict,
                                    &plan->verdict.variant[y->flow], x, made);
    if (status == FW_OK && y->study->held)
        status = fw_study_counted_judge(y, arena, x, made, response);
    if (why)
        snprintf(why, FW_STUDY_WHY, "%s",
                 status == FW_OK && isnan(made->ln) && made->why ? made->why : "");
    made->why = NULL; /* of this arena */
    fw_arena_free(arena);
    return status;
}

static fw_status judge_kth(void *context, long k) {
    batch *b = context;
    return b->wanted[k]
               ? fw_study_yielding_judge(b->y, b->x + (size_t)k * (size_t)b->y->scatter.npoint,
                                         &b->made[k], b->why[k],
                                         b->response + k * b->y->study->nresponse)
               : FW_OK;
}

/* ---- devices that were judged before ---- */

static size_t slot_of(const fw_study_yielding *y, const double *x) {
    size_t values = (size_t)y->scatter.npoint, n = values * sizeof *x, at = 0;
    uint64_t hash = FW_HASH_BEGIN;
    for (const unsigned char *byte = (const unsigned char *)x; at < n; at++)
        hash = fw_hash_add(hash, byte[at]);
    size_t k = (size_t)(hash ^ (hash >> 29)) & (y->room - 1);
    while (y->value[k].i >= 0 && memcmp(y->key + k * values, x, n) != 0)
        k = (k + 1) & (y->room - 1);
    return k;
}

static fw_status make_room(fw_study_yielding *y, size_t more) {
    if (2 * (y->filled + more) < y->room) return FW_OK;
    fw_study_yielding was = *y;
    size_t values = (size_t)y->scatter.npoint;
    y->room = y->room ? y->room : 256;
    while (2 * (y->filled + more) >= y->room)
        y->room *= 2;
    FW_NEED(y->key = fw_arena_array(y->study->arena, double, y->room *values));
    FW_NEED(y->value = fw_arena_array(y->study->arena, fw_study_cached, y->room));
    for (size_t k = 0; k < y->room; k++)
        y->value[k].i = -1;
    for (size_t k = 0; k < was.room; k++) {
        if (was.value[k].i < 0) continue;
        size_t to = slot_of(y, was.key + k * values);
        memcpy(y->key + to * values, was.key + k * values, values * sizeof *y->key);
        y->value[to] = was.value[k];
    }
    return FW_OK;
}

/* ---- the limit state ---- */

static void fill_sample(const fw_study_yielding *y, const double *x, const fw_study_cached *c,
                        const char *why, const double *response, fw_study_sample *sample) {
    const fw_study *study = y->study;
    for (int k = 0; k < study->ninput; k++)
        sample->value[k] = (double)NAN, sample->text[k][0] = '\0';
    for (int k = 0; k < y->ninput; k++)
        sample->value[y->first_input + k] = x[k];
    for (int k = 0; k < study->nsetting; k++)
        sample->value[study->nvary + k] = x[y->ninput + k];
    for (int k = 0; k < study->nresponse; k++)
        sample->response[k] = response[k];
    sample->i = c->i;
    sample->run = !isnan(c->ln[FW_STUDY_BY_VALUE]);
    sample->used = exp(c->ln[FW_STUDY_BY_VALUE]);
    sample->used_low = exp(c->ln[FW_STUDY_AT_BEST]);
    sample->used_high = exp(c->ln[FW_STUDY_AT_WORST]);
    sample->decision = !sample->run ? -1 : c->ln[FW_STUDY_BY_VALUE] > 0 ? 1 : 0;
    snprintf(sample->why, FW_STUDY_WHY, "%s",
             sample->run ? ""
             : why[0]    ? why
                         : "it could not be judged");
}

/* what the store has of these devices is not judged again */
static fw_status from_store(fw_study_yielding *y, batch *b, fw_study_sample *sample) {
    const fw_study *study = y->study;
    for (size_t k = 0; study->store && k < b->n; k++) {
        bool there;
        FW_TRY(fw_study_store_get(study->store, b->number[k], sample, &there));
        if (!there && study->stored_only)
            return fw_diag_error(&y->study->diags, 497, (fw_place){.file = study->options.file},
                                 "sample %ld is in none of the shards; run the shard that has it "
                                 "to its end with --resume",
                                 b->number[k]);
        if (!there) continue;
        b->wanted[k] = false;
        b->made[k] = nothing_known;
        if (sample->run)
            b->made[k] = (fw_verdict_made){.ln = log(sample->used),
                                           .low = log(sample->used_low),
                                           .high = log(sample->used_high)};
    }
    return FW_OK;
}

/* as a store that is read again says it */
static void read_back(const fw_verdict_made *made, double *ln) {
    ln[FW_STUDY_BY_VALUE] = log(exp(made->ln));
    ln[FW_STUDY_AT_BEST] = log(exp(made->low));
    ln[FW_STUDY_AT_WORST] = log(exp(made->high));
}

static fw_status judge_batch(fw_study_yielding *y, fw_arena *scratch, batch *b,
                             fw_study_cached *judged) {
    fw_study_sample sample;
    bool *stored = fw_arena_array(scratch, bool, b->n);
    b->made = fw_arena_array(scratch, fw_verdict_made, b->n);
    b->wanted = fw_arena_array(scratch, bool, b->n);
    b->why = fw_arena_alloc(scratch, b->n, sizeof *b->why);
    const size_t responses = (size_t)y->study->nresponse;
    FW_NEED(b->response = fw_arena_array(scratch, double, b->n *responses + 1));
    FW_NEED(stored && b->made && b->wanted && b->why ? stored : NULL);
    for (size_t k = 0; k < b->n * responses; k++)
        b->response[k] = (double)NAN;
    FW_TRY(fw_study_sample_new(scratch, y->study, &sample));
    for (size_t k = 0; k < b->n; k++)
        b->wanted[k] = true;
    FW_TRY(from_store(y, b, &sample));
    for (size_t k = 0; k < b->n; k++)
        stored[k] = !b->wanted[k];
    FW_TRY(fw_study_each(y->study, (long)b->n, judge_kth, b));
    for (size_t k = 0; k < b->n; k++) {
        judged[k].i = b->number[k];
        read_back(&b->made[k], judged[k].ln);
        if (stored[k]) continue;
        fill_sample(y, b->x + k * (size_t)y->scatter.npoint, &judged[k], b->why[k],
                    b->response + k * responses, &sample);
        FW_TRY(fw_study_keep(y->study, &sample));
    }
    return FW_OK;
}

/* n points under their numbers, into the store as well */
static fw_status judge_numbered(fw_study_yielding *y, size_t n, const long *number, const double *x,
                                fw_study_cached *judged) {
    fw_arena *scratch = fw_arena_part(y->study->arena, 0);
    FW_NEED(scratch);
    batch b = {.y = y, .n = n, .x = x, .number = number};
    fw_status status = judge_batch(y, scratch, &b, judged);
    fw_arena_free(scratch);
    FW_TRY(status);
    y->told += (long)n;
    const fw_study_options *o = &y->study->options;
    if (y->study->told)
        atomic_fetch_add(&y->study->told->done, (long)n), fw_study_tell(y->study);
    else if (o->progress)
        o->progress(o->progress_context, y->told, 0, 0);
    return FW_OK;
}

fw_status fw_study_yielding_points(void *context, long first, size_t n, const double *x,
                                   double *ln) {
    fw_study_yielding *y = context;
    fw_arena *scratch = fw_arena_part(y->study->arena, 0);
    FW_NEED(scratch);
    size_t values = (size_t)y->scatter.npoint, due = 0;
    long *number = fw_arena_array(scratch, long, n);
    size_t *at = fw_arena_array(scratch, size_t, n);
    double *of = fw_arena_array(scratch, double, n *values);
    fw_study_cached *own = fw_arena_array(scratch, fw_study_cached, n);
    fw_status status = number && at && of && own ? FW_OK : FW_NOMEM;
    for (size_t k = 0; status == FW_OK && k < n; k++) {
        ln[k] = -1; /* of another shard: nothing comes of it here */
        if (!fw_study_is_due(y->study, first + (long)k)) continue;
        memcpy(of + due * values, x + k * values, values * sizeof *x);
        at[due] = k;
        number[due++] = first + (long)k;
    }
    if (status == FW_OK) status = judge_numbered(y, due, number, of, own);
    for (size_t k = 0; status == FW_OK && k < due; k++)
        ln[at[k]] = own[k].ln[FW_STUDY_BY_VALUE];
    fw_arena_free(scratch);
    return status;
}

/* Points (count x npoint) that were not asked for before get the next numbers. steers: their values choose later points,
   so that every shard needs them; otherwise a shard judges its own. */
static fw_status know(fw_study_yielding *y, fw_arena *scratch, size_t count, const double *x,
                      bool steers) {
    size_t values = (size_t)y->scatter.npoint, n = 0;
    size_t *slot = fw_arena_array(scratch, size_t, count);
    long *number = fw_arena_array(scratch, long, count);
    double *fresh = fw_arena_array(scratch, double, count *values);
    fw_study_cached *judged = fw_arena_array(scratch, fw_study_cached, count);
    FW_NEED(slot && number && fresh && judged ? judged : NULL);
    for (size_t k = 0; k < count; k++) {
        size_t at = slot_of(y, x + k * values);
        fw_study_cached *c = &y->value[at];
        if (c->i < 0) {
            memcpy(y->key + at * values, x + k * values, values * sizeof *x);
            *c = (fw_study_cached){.i = y->base_number + y->evaluated++, .elsewhere = true};
            y->filled++;
        }
        if (!c->elsewhere || (!steers && !fw_study_is_due(y->study, c->i))) continue;
        c->elsewhere = false;
        memcpy(fresh + n * values, x + k * values, values * sizeof *x);
        slot[n] = at;
        number[n++] = c->i;
    }
    if (n > 0) FW_TRY(judge_numbered(y, n, number, fresh, judged));
    for (size_t k = 0; k < n; k++)
        memcpy(y->value[slot[k]].ln, judged[k].ln, sizeof judged[k].ln);
    return FW_OK;
}

static fw_status limit_with(fw_study_yielding *y, fw_arena *scratch, size_t count, const double *u,
                            bool steers, double *value) {
    const fw_study_scatter *s = &y->scatter;
    size_t values = (size_t)s->npoint;
    double *x = fw_arena_array(scratch, double, count *values),
           *drawn = fw_arena_array(scratch, double, s->joint.values + 1);
    FW_NEED(x && drawn ? x : NULL);
    FW_TRY(make_room(y, count));
    for (size_t k = 0; k < count; k++) {
        const double *at = u + k * s->dimensions;
        fw_study_scatter_point(s, at, y->unknown, fw_study_scatter_at(s, at), drawn,
                               x + k * values);
    }
    FW_TRY(know(y, scratch, count, x, steers));
    for (size_t k = 0; k < count; k++) {
        const fw_study_cached *c = &y->value[slot_of(y, x + k * values)];
        value[k] = c->elsewhere ? 1 : -c->ln[y->as];
    }
    return FW_OK;
}

static fw_status limit_of(fw_study_yielding *y, size_t count, const double *u, bool steers,
                          double *value) {
    fw_arena *scratch = fw_arena_part(y->study->arena, 0);
    FW_NEED(scratch);
    fw_status status = fw_cancel_requested(y->study->options.cancel)
                           ? FW_CANCELLED
                           : limit_with(y, scratch, count, u, steers, value);
    fw_arena_free(scratch);
    return status;
}

fw_status fw_study_yielding_limit(void *context, size_t first, size_t count, const double *u,
                                  double *value) {
    (void)first;
    return limit_of(context, count, u, true, value);
}

fw_status fw_study_yielding_apart(void *context, size_t first, size_t count, const double *u,
                                  double *value) {
    (void)first;
    return limit_of(context, count, u, false, value);
}

/* of a flow; y->chance is freed by the caller */
fw_status fw_study_yielding_begin(fw_study *study, int flow, int first_input,
                                  fw_study_yielding *y) {
    const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[flow];
    *y = (fw_study_yielding){.study = study,
                             .flow = flow,
                             .ninput = v->ninput,
                             .first_input = first_input,
                             .base_number = (long)flow * FW_STUDY_FLOW_PART};
    FW_TRY(fw_study_scatter_of(study, v, &y->scatter));
    if (y->scatter.dimensions == 0)
        return fw_diag_error(&study->diags, 491, study->asked->place,
                             "study '%s': nothing differs from device to device%s%s; add an "
                             "<uncertain>",
                             study->asked->name, v->variant->flow ? " in flow " : "",
                             v->variant->flow ? v->variant->flow : "");
    if (y->scatter.joint.unknowns > FW_CHANCE_UNKNOWNS_MOST)
        return fw_diag_error(
            &study->diags, 490, study->asked->place,
            "study '%s': of %d inputs nothing is known but their ends "
            "(spread=\"interval\", or assumed by the pack), and all settings of the "
            "ends of at most %d are looked at; state spread=\"uniform\" or an sd of "
            "some, or leave those out that matter least",
            study->asked->name, (int)y->scatter.joint.unknowns, FW_CHANCE_UNKNOWNS_MOST);
    FW_NEED(y->chance = fw_arena_part(study->arena, 0));
    return FW_OK;
}

/* What a middle die takes, of CPU time */
static fw_status time_die(fw_study_yielding *y) {
    struct timespec begun, ended;
    const fw_study_scatter *s = &y->scatter;
    double *u = fw_arena_array(y->chance, double, s->dimensions + 1),
           *x = fw_arena_array(y->chance, double, (size_t)s->npoint + 1),
           *drawn = fw_arena_array(y->chance, double, s->joint.values + 1);
    fw_verdict_made made;
    FW_NEED(u && x && drawn ? x : NULL);
    for (size_t d = 0; d < s->dimensions; d++)
        u[d] = 0.1; /* what is just as it is drawn is not judged again */
    fw_study_scatter_point(s, u, NULL, fw_study_scatter_at(s, u), drawn, x);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
    FW_TRY(fw_study_yielding_judge(y, x, &made, NULL, NULL));
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ended);
    y->study->seconds_each =
        (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec);
    return FW_OK;
}

/* The yield is estimated as computed, and with the limit moved either way by the model's band, at each corner of what is only
   assumed, and inside where dies that are looked at show that its ends may not be enough. Three that merely count have the
   same dies, where they are of the same values. */
static void foresee(const fw_study_yielding *y) {
    fw_study *study = y->study;
    const int samples = study->asked->samples;
    const long asked = samples > 0 ? samples : FW_STUDY_DIES_USUAL;
    const size_t unknowns = y->scatter.joint.unknowns;
    const long corners = 1L << unknowns;
    const long looks = (long)fw_chance_range_looks(unknowns);
    const long inside = (long)fw_chance_range_inside(unknowns);
    const long wafers = y->scatter.levels ? asked : 0;
    for (study->counted = 16; 2 * study->counted <= asked;)
        study->counted *= 2;
    study->estimates += 3 * corners;
    study->likely += corners * study->counted + looks + wafers;
    study->inside += inside * study->counted;
    study->most += 3 * ((corners + inside) * asked + looks) + wafers;
}

fw_status fw_study_yielding_check(fw_study *yield) {
    fw_status status = FW_OK;
    yield->estimates = yield->likely = yield->inside = yield->most = 0;
    for (int i = 0; status == FW_OK && i < yield->plan->nflow; i++) {
        fw_study_yielding y;
        status = fw_study_yielding_begin(yield, i, 0, &y);
        if (status == FW_OK) foresee(&y);
        if (status == FW_OK && i == 0 && yield->options.timed) status = time_die(&y);
        fw_arena_free(y.chance);
    }
    return status;
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
