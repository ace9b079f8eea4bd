/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Yield: the share of devices that hold every limit that check looks at (hinges, requirements, clearances,
   pull-in), of each flow.

   A device is a point u of independent standard normal numbers: one for every input of the flow (edges,
   etch, thickness, modulus, as the pack states them) and for every <uncertain>. Its limit state is g = -ln of
   the largest share of a limit that it uses; g <= 0 fails. The probability is estimated by src/chance (which
   method, and why, is in the result). What the model itself may be off by is no chance: the band of the hinge that governs the
   nominal device moves the limit up and down, and the yield is a range from the one to the other. An
   input that a pack does not know (an assumed range) and spread="interval" make a range as well.
   Theory: docs/theory/chance.md. Test: tests/cli/test_study.py */
#include "chance/estimate.h"
#include "maths/functions.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum { PART = 100000000, BUDGET_USUAL = 4000 };

typedef struct cached {
    long i; /* number of its sample; -1: free */
    double ln;
} cached;

typedef struct yielding {
    fw_study *study;
    int flow;        /* of the plan */
    int ninput;      /* of the flow */
    int first_input; /* column of its first one */
    fw_study_scatter scatter;
    const double *unknown; /* values of what is not known; NULL: middles */
    double shift;          /* added to ln: what the model may be off by */
    long evaluated;        /* devices of this flow so far */
    long told;             /* those and what simulated wafers had, for progress */
    long base;             /* number of its first sample */
    /* devices by their values (open addressing): methods ask for the same ones again */
    double *key;   /* (room x npoint) */
    cached *value; /* (room) */
    size_t room, filled;
    /* of the estimators, which give back what they took: nothing of ours is in it */
    fw_arena *chance;
} yielding;

/* ---- one batch of devices, in threads ---- */

typedef struct batch {
    yielding *y;
    size_t n;
    const double *x;       /* (n x npoint) */
    fw_verdict_made *made; /* (n) */
    bool *wanted;          /* (n) not known from before */
} batch;

/* with settings of <uncertain>: the description read again and judged as drawn, then as made */
static fw_status judge_restated(const yielding *y, fw_arena *arena, const double *x,
                                fw_verdict_made *made) {
    const fw_study *study = y->study;
    const fw_plan *plan = study->plan;
    int n = study->nsetting;
    fw_device_set *set = fw_arena_array(arena, fw_device_set, (size_t)n);
    fw_verdict_variant_verdict *variant =
        fw_arena_array(arena, fw_verdict_variant_verdict, (size_t)plan->nflow);
    const fw_device *device;
    const fw_layout *layout = NULL;
    fw_diags diags = fw_diags_new(arena);
    FW_NEED(set && variant ? set : NULL);
    for (int k = 0; k < n; k++) {
        char *text = fw_arena_array(arena, char, FW_STUDY_TEXT);
        double shown;
        FW_NEED(text);
        FW_TRY(fw_study_input_write(&study->input[study->nvary + k], x[y->ninput + k], 12, text,
                                    &shown));
        set[k] = (fw_device_set){study->input[study->nvary + k].what, text};
    }
    *made = (fw_verdict_made){.ln = (double)NAN, .hinge = FW_NONE};
    fw_status status = fw_plan_restated(plan, arena, set, n, &device, variant);
    fw_verdict verdict = {.nvariant = plan->nflow, .variant = variant};
    fw_verdict_options options = plan->options.verdict;
    options.corners = FW_CORNERS_NONE;
    options.with_advice = false;
    options.at_a_glance = true;
    if (status == FW_OK)
        status = fw_verdict_run(arena, device, &options, &diags, &verdict, &layout);
    if (status == FW_OK)
        status = fw_verdict_made_at(arena, device, layout, &options, &variant[y->flow], x, made);
    if (status == FW_NOMEM || status == FW_CANCELLED || status == FW_OK) return status;
    made->ln = (double)NAN;
    return FW_OK;
}

static fw_status judge_one(const yielding *y, const double *x, fw_verdict_made *made) {
    const fw_plan *plan = y->study->plan;
    fw_arena *arena = fw_arena_part(plan->arena, 0);
    FW_NEED(arena);
    fw_arena_stop_with(arena, y->study->options.cancel);
    fw_status status;
    if (y->study->nsetting > 0)
        status = judge_restated(y, arena, x, made);
    else
        status = fw_verdict_made_at(arena, plan->device, plan->layout, &plan->options.verdict,
                                    &plan->verdict.variant[y->flow], x, made);
    made->why = NULL; /* of this arena */
    fw_arena_free(arena);
    return status;
}

static fw_status judge_kth(void *context, long k) {
    batch *b = context;
    return b->wanted[k]
               ? judge_one(b->y, b->x + (size_t)k * (size_t)b->y->scatter.npoint, &b->made[k])
               : FW_OK;
}

/* ---- devices that were judged before ---- */

static size_t slot_of(const yielding *y, const double *x) {
    size_t values = (size_t)y->scatter.npoint, n = values * sizeof *x, at = 0;
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    for (const unsigned char *byte = (const unsigned char *)x; at < n; at++)
        hash = (hash ^ byte[at]) * 1099511628211u;
    size_t k = (size_t)(hash ^ (hash >> 29)) & (y->room - 1);
    while (y->value[k].i >= 0 && memcmp(y->key + k * values, x, n) != 0)
        k = (k + 1) & (y->room - 1);
    return k;
}

static fw_status make_room(yielding *y, size_t more) {
    if (2 * (y->filled + more) < y->room) return FW_OK;
    yielding was = *y;
    size_t values = (size_t)y->scatter.npoint;
    y->room = y->room ? y->room : 256;
    while (2 * (y->filled + more) >= y->room)
        y->room *= 2;
    FW_NEED(y->key = fw_arena_array(y->study->arena, double, y->room *values));
    FW_NEED(y->value = fw_arena_array(y->study->arena, cached, y->room));
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

static void fill_sample(const yielding *y, const double *x, const cached *c,
                        fw_study_sample *sample) {
    const fw_study *study = y->study;
    for (int k = 0; k < study->ninput; k++)
        sample->value[k] = (double)NAN, sample->text[k][0] = '\0';
    for (int k = 0; k < y->ninput; k++)
        sample->value[y->first_input + k] = x[k];
    for (int k = 0; k < study->nsetting; k++)
        sample->value[study->nvary + k] = x[y->ninput + k];
    for (int k = 0; k < study->nresponse; k++)
        sample->response[k] = (double)NAN;
    sample->i = c->i;
    sample->run = !isnan(c->ln);
    sample->used = exp(c->ln);
    sample->decision = !sample->run ? -1 : c->ln > 0 ? 1 : 0;
    if (!sample->run)
        memcpy(sample->why, "it could not be judged", sizeof "it could not be judged");
}

/* what the store has of these devices is not judged again */
static fw_status from_store(yielding *y, batch *b, fw_study_sample *sample, long first) {
    for (size_t k = 0; y->study->store && k < b->n; k++) {
        bool there;
        if (!b->wanted[k]) continue;
        FW_TRY(fw_study_store_get(y->study->store, first + (long)k, sample, &there));
        if (!there) continue;
        b->wanted[k] = false;
        b->made[k] = (fw_verdict_made){.ln = sample->run ? log(sample->used) : (double)NAN,
                                       .hinge = FW_NONE};
    }
    return FW_OK;
}

/* n points, numbered from `first` on, into the store as well */
static fw_status judge_points(void *context, long first, size_t n, const double *x, double *ln) {
    yielding *y = context;
    fw_arena *scratch = fw_arena_part(y->study->arena, 0);
    FW_NEED(scratch);
    batch b = {.y = y, .n = n, .x = x};
    fw_study_sample sample;
    bool *stored = fw_arena_array(scratch, bool, n);
    b.made = fw_arena_array(scratch, fw_verdict_made, n);
    b.wanted = fw_arena_array(scratch, bool, n);
    fw_status status = stored && b.made && b.wanted ? FW_OK : FW_NOMEM;
    if (status == FW_OK) status = fw_study_sample_new(scratch, y->study, &sample);
    for (size_t k = 0; status == FW_OK && k < n; k++)
        b.wanted[k] = true;
    if (status == FW_OK) status = from_store(y, &b, &sample, first);
    for (size_t k = 0; status == FW_OK && k < n; k++)
        stored[k] = !b.wanted[k];
    if (status == FW_OK) status = fw_study_each(y->study, (long)n, judge_kth, &b);
    for (size_t k = 0; status == FW_OK && k < n; k++) {
        ln[k] = log(exp(b.made[k].ln)); /* as a store that is read again says it */
        cached c = {first + (long)k, ln[k]};
        if (stored[k]) continue;
        fill_sample(y, x + k * (size_t)y->scatter.npoint, &c, &sample);
        status = fw_study_keep(y->study, &sample);
    }
    fw_arena_free(scratch);
    FW_TRY(status);
    y->told += (long)n;
    const fw_study_options *o = &y->study->options;
    if (o->progress) o->progress(o->progress_context, y->told, 0, 0);
    return FW_OK;
}

static fw_status judge_new(yielding *y, fw_arena *scratch, size_t n, const double *x) {
    long first = y->base + y->evaluated;
    size_t values = (size_t)y->scatter.npoint;
    double *ln = fw_arena_array(scratch, double, n);
    FW_NEED(ln);
    FW_TRY(judge_points(y, first, n, x, ln));
    for (size_t k = 0; k < n; k++) {
        size_t to = slot_of(y, x + k * values);
        if (y->value[to].i < 0) y->filled++;
        memcpy(y->key + to * values, x + k * values, values * sizeof *x);
        y->value[to] = (cached){first + (long)k, ln[k]};
    }
    y->evaluated += (long)n;
    return FW_OK;
}

/* the last number of a point says at which place of the wafer it is, where that matters */
static const fw_chance_place *place_of(const yielding *y, const double *u) {
    const fw_study_scatter *s = &y->scatter;
    if (s->dimensions == s->joint.dimensions) return NULL;
    const fw_study_place *p =
        fw_study_scatter_place(s, fw_maths_normal_cdf(u[s->joint.dimensions]));
    return p ? &p->at : NULL;
}

static fw_status limit_with(yielding *y, fw_arena *scratch, size_t count, const double *u,
                            double *value) {
    const fw_study_scatter *s = &y->scatter;
    size_t values = (size_t)s->npoint, n = 0;
    double *x = fw_arena_array(scratch, double, count *values),
           *drawn = fw_arena_array(scratch, double, s->joint.values + 1);
    double *fresh = fw_arena_array(scratch, double, count *values);
    FW_NEED(x && fresh && drawn ? x : NULL);
    FW_TRY(make_room(y, count));
    for (size_t k = 0; k < count; k++) {
        const double *at = u + k * s->dimensions;
        fw_study_scatter_point(s, at, y->unknown, place_of(y, at), drawn, x + k * values);
        if (y->value[slot_of(y, x + k * values)].i >= 0) continue;
        memcpy(fresh + n++ * values, x + k * values, values * sizeof *x);
    }
    if (n > 0) FW_TRY(judge_new(y, scratch, n, fresh));
    for (size_t k = 0; k < count; k++)
        value[k] = -(y->value[slot_of(y, x + k * values)].ln + y->shift);
    return FW_OK;
}

static fw_status limit(void *context, size_t first, size_t count, const double *u, double *value) {
    yielding *y = context;
    fw_arena *scratch = fw_arena_part(y->study->arena, 0);
    (void)first;
    FW_NEED(scratch);
    fw_status status = fw_cancel_requested(y->study->options.cancel)
                           ? FW_CANCELLED
                           : limit_with(y, scratch, count, u, value);
    fw_arena_free(scratch);
    return status;
}

static void set_unknown(void *context, const double *unknown) {
    ((yielding *)context)->unknown = unknown;
}

/* ---- the estimate ---- */

typedef struct bounds {
    fw_chance_estimate most,
        least; /* at the values of what is only assumed with most, least failures */
    double *most_at, *least_at; /* those values */
    double low, high;           /* interval of the probability of failing, over both */
} bounds;

static fw_status estimate(yielding *y, bounds *out) {
    fw_study *study = y->study;
    const fw_chance_limit of = {.dimensions = y->scatter.dimensions, .g = limit, .context = y};
    const fw_chance_options o = {.method = FW_CHANCE_AUTO,
                                 .seed = (uint64_t)study->asked->seed,
                                 .budget = study->asked->samples > 0 ? (size_t)study->asked->samples
                                                                     : 4000,
                                 .level = study->asked->confidence};
    const fw_chance_joint *joint = &y->scatter.joint;
    const char *why = NULL;
    fw_status status;
    if (joint->unknowns == 0) {
        y->unknown = NULL;
        *out = (bounds){.most_at = NULL};
        status = fw_chance_estimate_run(y->chance, &of, &o, &out->most, &why);
        out->least = out->most;
        out->low = out->most.low, out->high = out->most.high;
    } else {
        double *low = fw_arena_array(study->arena, double, joint->unknowns),
               *high = fw_arena_array(study->arena, double, joint->unknowns);
        FW_NEED(low && high ? low : NULL);
        for (size_t k = 0; k < joint->unknowns; k++) {
            const fw_chance_distribution *d = &joint->variable[joint->unknown[k]].distribution;
            low[k] = d->low, high[k] = d->high;
        }
        const fw_chance_unknowns unknowns = {.count = joint->unknowns,
                                             .low = low,
                                             .high = high,
                                             .set = set_unknown,
                                             .search = FW_CHANCE_ENDS};
        fw_chance_range range;
        status = fw_chance_range_run(y->chance, &of, &unknowns, &o, &range, &why);
        y->unknown = NULL;
        if (status == FW_OK) {
            *out = (bounds){range.most,     range.least, range.most_at,
                            range.least_at, range.low,   range.high};
        }
    }
    if (status == FW_INPUT)
        return fw_diag_error(&study->diags, 490, study->asked->place, "study '%s': %s",
                             study->asked->name, why ? why : "its estimate could not be begun");
    return status;
}

/* the shares of the way to the nearest failing device: alpha^2 of every number, by the input that it is of */
static void shares_of(const yielding *y, const fw_chance_design_point *p, double *share) {
    const fw_study_scatter *s = &y->scatter;
    for (size_t d = 0; d < s->joint.dimensions; d++)
        for (int k = 0; k < s->groups; k++) {
            int v = (int)s->joint.u_variable[d] - s->group[k].first;
            if (v >= 0 && v < s->group[k].variables) share[k] += p->alpha[d] * p->alpha[d];
        }
    for (size_t d = s->joint.dimensions; d < s->dimensions; d++)
        share[s->groups] += p->alpha[d] * p->alpha[d];
}

static fw_status describe(yielding *y, const bounds *b, fw_study_flow_yield *out) {
    fw_study *study = y->study;
    const fw_study_scatter *s = &y->scatter;
    size_t n = (size_t)s->groups + (s->dimensions > s->joint.dimensions);
    const char **name = fw_arena_array(study->arena, const char *, n),
               **unit = fw_arena_array(study->arena, const char *, n);
    double *point = fw_arena_array(study->arena, double, (size_t)s->npoint),
           *drawn = fw_arena_array(study->arena, double, s->joint.values + 1);
    FW_NEED(name && unit && point && drawn ? name : NULL);
    for (size_t k = 0; k < n; k++) {
        bool place = k == (size_t)s->groups;
        name[k] = place ? "place on the wafer" : s->group[k].what;
        unit[k] = place ? "m" : s->group[k].unit;
    }
    out->ninput = (int)n, out->input = name, out->unit = unit;
    if (b->most.points == 0) return FW_OK;
    const fw_chance_design_point *p = &b->most.point[0];
    double *share = fw_arena_array(study->arena, double, n),
           *at = fw_arena_array(study->arena, double, n);
    FW_NEED(share && at ? share : NULL);
    const fw_chance_place *place = place_of(y, p->u);
    fw_study_scatter_point(s, p->u, b->most_at, place, drawn, point);
    shares_of(y, p, share);
    for (int k = 0; k < s->groups; k++)
        at[k] = s->group[k].count == 1 ? point[s->group[k].at] : (double)NAN;
    if (place) at[s->groups] = hypot(place->x_m, place->y_m);
    out->beta = p->beta, out->share = share, out->at = at;
    return FW_OK;
}

/* what the model may be off by is that of the hinge that governs the nominal device */
static fw_status judge_nominal(const yielding *y, const fw_verdict_variant_verdict *v,
                               fw_verdict_made *made) {
    double x[FW_FABRICATION_INPUTS];
    const fw_plan *plan = y->study->plan;
    for (int k = 0; k < v->ninput; k++)
        x[k] = v->input[k].nominal;
    return fw_verdict_made_at(plan->arena, plan->device, plan->layout, &plan->options.verdict, v, x,
                              made);
}

/* the yield where so many fail; what it points to outlives the estimators */
static fw_status end_of(const yielding *y, const fw_chance_estimate *e, const double *at,
                        fw_study_yield_end *out) {
    fw_arena *arena = y->study->arena;
    size_t n = y->scatter.joint.unknowns;
    fw_chance_step *step = fw_arena_array(arena, fw_chance_step, FW_CHANCE_STEPS);
    double *values = fw_arena_array(arena, double, n + 1);
    FW_NEED(step && values ? step : NULL);
    memcpy(step, e->step, e->steps * sizeof *step);
    if (n > 0) memcpy(values, at, n * sizeof *values);
    *out = (fw_study_yield_end){.value = 1 - 0.5 * (e->probability_low + e->probability_high),
                                .low = 1 - e->high,
                                .high = 1 - e->low,
                                .at = values,
                                .step = step,
                                .steps = e->steps};
    return FW_OK;
}

static fw_status both_ends(const yielding *y, const bounds *b, fw_study_flow_yield *out) {
    const fw_study_scatter *s = &y->scatter;
    size_t n = s->joint.unknowns;
    const char **name = fw_arena_array(y->study->arena, const char *, n + 1),
               **unit = fw_arena_array(y->study->arena, const char *, n + 1);
    FW_NEED(name && unit ? name : NULL);
    for (size_t k = 0; k < n; k++)
        for (int i = 0; i < s->groups; i++) {
            int v = (int)s->joint.unknown[k] - s->group[i].first;
            if (v >= 0 && v < s->group[i].variables)
                name[k] = s->group[i].what, unit[k] = s->group[i].unit;
        }
    out->nassumed = (int)n, out->assumed = name, out->assumed_unit = unit;
    out->each = (long)b->most.evaluations;
    FW_TRY(end_of(y, &b->most, b->most_at, &out->least));
    FW_TRY(end_of(y, &b->least, b->least_at, &out->most));
    out->value = n > 0 ? (double)NAN : out->least.value;
    return FW_OK;
}

static fw_status estimate_all(yielding *y, const fw_verdict_variant_verdict *v,
                              fw_study_flow_yield *out) {
    fw_arena *arena = y->study->arena;
    bounds plain, worst, best;
    fw_verdict_made nominal;
    FW_TRY(judge_nominal(y, v, &nominal));
    FW_TRY(estimate(y, &plain));
    FW_TRY(describe(y, &plain, out));
    out->sampled_low = 1 - plain.high, out->sampled_high = 1 - plain.low;
    FW_TRY(both_ends(y, &plain, out));
    out->method = fw_chance_method_text(plain.most.method);
    FW_NEED(out->reason = fw_arena_strdup(arena, plain.most.reason));
    if (plain.most.caution) FW_NEED(out->caution = fw_arena_strdup(arena, plain.most.caution));
    out->unevaluated = (long)plain.most.unevaluated;
    const double up = nominal.up, down = isfinite(nominal.down) ? nominal.down : 0;
    y->shift = up;
    FW_TRY(estimate(y, &worst));
    y->shift = -down;
    FW_TRY(estimate(y, &best));
    out->low = 1 - fmax(worst.high, plain.high), out->high = 1 - fmin(best.low, plain.low);
    out->band = exp(up + down);
    out->evaluations = y->evaluated;
    return FW_OK;
}

/* of one estimate; there are some more of each flow where the limit is moved or a range is not known */
long fw_study_count_yield(const fw_study *study) {
    return study->asked->samples > 0 ? study->asked->samples : BUDGET_USUAL;
}

/* only where somebody said on which level or where something differs: the yield itself does not need it */
static fw_status simulate_wafers(yielding *y, fw_study_flow_yield *out) {
    fw_study *study = y->study;
    fw_study_scatter *scatter = fw_arena_one(study->arena, fw_study_scatter);
    fw_study_levels *levels = fw_arena_one(study->arena, fw_study_levels);
    FW_NEED(scatter && levels ? levels : NULL);
    *scatter = y->scatter;
    FW_TRY(fw_study_levels_run(study, scatter, fw_study_count_yield(study), y->base + PART / 2,
                               judge_points, y, levels));
    out->levels = levels;
    out->evaluations += levels->devices;
    return FW_OK;
}

static fw_status yield_of(fw_study *study, int flow, int first_input, fw_study_flow_yield *out) {
    const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[flow];
    yielding y = {.study = study,
                  .flow = flow,
                  .ninput = v->ninput,
                  .first_input = first_input,
                  .base = (long)flow * PART};
    *out = (fw_study_flow_yield){.flow = v->variant->flow, .beta = (double)NAN};
    FW_TRY(fw_study_scatter_of(study, v, &y.scatter));
    if (y.scatter.dimensions == 0)
        return fw_diag_error(&study->diags, 491, study->asked->place,
                             "study '%s': nothing differs from device to device%s%s; add an "
                             "<uncertain>",
                             study->asked->name, v->variant->flow ? " in flow " : "",
                             v->variant->flow ? v->variant->flow : "");
    FW_NEED(y.chance = fw_arena_part(study->arena, 0));
    fw_status status = estimate_all(&y, v, out);
    if (status == FW_OK && y.scatter.levels) status = simulate_wafers(&y, out);
    fw_arena_free(y.chance);
    return status;
}

fw_status fw_study_kind_yield(fw_study *study, fw_study_result *result) {
    int flows = study->plan->nflow, column = study->nvary + study->nsetting;
    FW_NEED(result->yield = fw_arena_array(study->arena, fw_study_flow_yield, (size_t)flows));
    for (int i = 0; i < flows; i++) {
        const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[i];
        FW_TRY(yield_of(study, i, column, &result->yield[result->nyield++]));
        column += v->ninput;
    }
    return FW_OK;
}
