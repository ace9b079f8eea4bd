/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Yield: the share of devices that hold every limit that check looks at (hinges, requirements, clearances,
   pull-in), of each flow.

   A device is a point u of independent standard normal numbers: one for every input of the flow (edges,
   etch, thickness, modulus, as the pack states them) and for every <uncertain>. Its limit state is g = -ln of
   the largest share of a limit that it uses; g <= 0 fails. The probability is estimated by src/chance (which
   method, and why, is in the result). What the model itself may be off by is no chance: every check
   of every device is read at the upper end of its own band, and at the lower one, and the yield is a range from the one to
   the other (decision 236). An
   input that a pack does not know (an assumed range) and spread="interval" make a range as well, over their ends and, where
   dies show that these may not be enough, inside (src/chance/range.c).
   Theory: docs/theory/chance.md. Test: tests/cli/test_study.py */
#include "chance/estimate.h"
#include "maths/functions.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

static void set_unknown(void *context, const double *unknown) {
    ((fw_study_yielding *)context)->unknown = unknown;
}

/* ---- the estimate ---- */

typedef struct bounds {
    fw_chance_estimate most,
        least; /* at the values of what is only assumed with most, least failures */
    double *most_at, *least_at; /* those values */
    double low, high;           /* interval of the probability of failing, over both */
    size_t settings;            /* of what is only assumed, with an estimate each */
} bounds;

static fw_chance_options options_of(const fw_study *study) {
    return (fw_chance_options){.method = FW_CHANCE_AUTO,
                               .seed = (uint64_t)study->asked->seed,
                               .budget =
                                   study->asked->samples > 0 ? (size_t)study->asked->samples : 4000,
                               .level = study->asked->confidence};
}

static fw_status not_begun(fw_study *study, const char *why) {
    return fw_diag_error(&study->diags, 490, study->asked->place, "study '%s': %s",
                         study->asked->name, why ? why : "its estimate could not be begun");
}

/* that something scatters was looked at when it was opened (fw_study_yielding_check) */
fw_status fw_study_check_yield(fw_study *study) {
    const fw_chance_limit of = {.dimensions = 1};
    const fw_chance_options o = options_of(study);
    const char *why;
    return fw_chance_estimate_check(&of, &o, &why) == FW_OK ? FW_OK : not_begun(study, why);
}

/* what dies of a study say that one shard of them cannot follow, and what to do instead of it */
static fw_status not_apart(fw_study *study, const char *what, const char *say,
                           const char *instead) {
    return fw_diag_error(&study->diags, 490, study->asked->place,
                         "shards: %s of study '%s' %s; run it in one piece, in as many threads as "
                         "there are (--jobs)%s",
                         what, study->asked->name, say, instead);
}

static fw_status rare_apart(fw_study *study) {
    return not_apart(study, "failures",
                     "are so rare, and lie so, that subset simulation looks for them, and each of "
                     "its points is chosen by the ones before",
                     "; or, for several machines, the same study on each with a seed of its own, "
                     "of whose estimates the mean is the answer");
}

static fw_status inside_apart(fw_study *study) {
    return not_apart(study, "dies",
                     "show that the least or the most yield may lie inside what is only assumed, "
                     "and the yield at one value says which value is looked at next",
                     ", or state spread=\"uniform\" or an sd of what is only assumed");
}

/* side: the extremes of the probability of failing that are wanted */
static fw_status estimate(fw_study_yielding *y, fw_chance_side side, bounds *out) {
    fw_study *study = y->study;
    const bool apart = study->options.shards > 0;
    const fw_chance_limit of = {.dimensions = y->scatter.dimensions,
                                .g = fw_study_yielding_limit,
                                .apart = apart ? fw_study_yielding_apart : NULL,
                                .context = y};
    const fw_chance_options o = options_of(study);
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
                                             .search = FW_CHANCE_WHERE_NEEDED,
                                             .side = side};
        fw_chance_range range;
        status = fw_chance_range_run(y->chance, &of, &unknowns, &o, &range, &why);
        y->unknown = NULL;
        if (status == FW_OK) {
            *out = (bounds){range.most, range.least, range.most_at, range.least_at,
                            range.low,  range.high,  range.settings};
        }
    }
    if (status == FW_LIMIT && apart) return why ? inside_apart(study) : rare_apart(study);
    if (status == FW_INPUT) return not_begun(study, why);
    return status;
}

/* the shares of the way to the nearest failing device: alpha^2 of every number, by the input that it is of */
static void shares_of(const fw_study_yielding *y, const fw_chance_design_point *p, double *share) {
    const fw_study_scatter *s = &y->scatter;
    for (size_t d = 0; d < s->joint.dimensions; d++)
        for (int k = 0; k < s->groups; k++) {
            int v = (int)s->joint.u_variable[d] - s->group[k].first;
            if (v >= 0 && v < s->group[k].variables) share[k] += p->alpha[d] * p->alpha[d];
        }
    for (size_t d = s->joint.dimensions; d < s->dimensions; d++)
        share[s->groups] += p->alpha[d] * p->alpha[d];
}

static fw_status describe(fw_study_yielding *y, const bounds *b, fw_study_flow_yield *out) {
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
    const fw_chance_place *place = fw_study_scatter_at(s, p->u);
    fw_study_scatter_point(s, p->u, b->most_at, place, drawn, point);
    shares_of(y, p, share);
    for (int k = 0; k < s->groups; k++)
        at[k] = s->group[k].count == 1 ? point[s->group[k].at] : (double)NAN;
    if (place) at[s->groups] = hypot(place->x_m, place->y_m);
    out->beta = p->beta, out->share = share, out->at = at;
    return FW_OK;
}

/* the device that is intended: how far apart both readings of it are */
static fw_status judge_nominal(const fw_study_yielding *y, const fw_verdict_variant_verdict *v,
                               fw_verdict_made *made) {
    double x[FW_FABRICATION_INPUTS];
    const fw_plan *plan = y->study->plan;
    for (int k = 0; k < v->ninput; k++)
        x[k] = v->input[k].nominal;
    return fw_verdict_made_at(plan->arena, plan->device, plan->layout, &plan->options.verdict, v, x,
                              made);
}

/* the yield where so many fail; what it points to outlives the estimators */
static fw_status end_of(const fw_study_yielding *y, const fw_chance_estimate *e, const double *at,
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

/* where the least and the most were looked for; one of a single estimate needs no words */
static fw_status sought(fw_arena *arena, long corners, fw_study_flow_yield *out) {
    if (corners == 1) return FW_OK;
    const bool inside = out->settings > corners;
    out->sought =
        inside
            ? fw_arena_printf(
                  arena,
                  "least and most are of %ld settings of what is only assumed, %ld of them "
                  "inside its ends, as not all dies have it better at the same end; between "
                  "these settings it may be a little less, or more",
                  out->settings, out->settings - corners)
            : fw_arena_printf(
                  arena,
                  "least and most are at the ends of what is only assumed, and nothing inside was "
                  "estimated: of the dies that were looked at all that come near a limit have it "
                  "better at the same end");
    FW_NEED(out->sought);
    return FW_OK;
}

static fw_status both_ends(const fw_study_yielding *y, const bounds *b, fw_study_flow_yield *out) {
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
    out->settings = (long)b->settings;
    FW_TRY(sought(y->study->arena, 1L << n, out));
    FW_TRY(end_of(y, &b->most, b->most_at, &out->least));
    FW_TRY(end_of(y, &b->least, b->least_at, &out->most));
    out->value = n > 0 ? (double)NAN : out->least.value;
    return FW_OK;
}

static fw_status estimate_all(fw_study_yielding *y, const fw_verdict_variant_verdict *v,
                              fw_study_flow_yield *out) {
    fw_arena *arena = y->study->arena;
    bounds plain, worst, best;
    fw_verdict_made nominal;
    FW_TRY(judge_nominal(y, v, &nominal));
    FW_TRY(estimate(y, FW_CHANCE_BOTH_SIDES, &plain));
    FW_TRY(describe(y, &plain, out));
    out->sampled_low = 1 - plain.high, out->sampled_high = 1 - plain.low;
    FW_TRY(both_ends(y, &plain, out));
    out->method = fw_chance_method_text(plain.most.method);
    FW_NEED(out->reason = fw_arena_strdup(arena, plain.most.reason));
    if (plain.most.caution) FW_NEED(out->caution = fw_arena_strdup(arena, plain.most.caution));
    out->unevaluated = (long)plain.most.unevaluated;
    y->as = FW_STUDY_AT_WORST;
    FW_TRY(estimate(y, FW_CHANCE_MOST_ONLY, &worst));
    y->as = FW_STUDY_AT_BEST;
    FW_TRY(estimate(y, FW_CHANCE_LEAST_ONLY, &best));
    y->as = FW_STUDY_BY_VALUE;
    out->low = 1 - fmax(worst.high, plain.high), out->high = 1 - fmin(best.low, plain.low);
    out->band = exp(nominal.high - nominal.low);
    out->evaluations = y->evaluated;
    return FW_OK;
}

/* of one estimate; there are some more of each flow where the limit is moved or a range is not known */
long fw_study_count_yield(const fw_study *study) {
    return study->asked->samples > 0 ? study->asked->samples : FW_STUDY_DIES_USUAL;
}

/* only where somebody said on which level or where something differs: the yield itself does not need it */
static fw_status simulate_wafers(fw_study_yielding *y, fw_study_flow_yield *out) {
    fw_study *study = y->study;
    fw_study_scatter *scatter = fw_arena_one(study->arena, fw_study_scatter);
    fw_study_levels *levels = fw_arena_one(study->arena, fw_study_levels);
    FW_NEED(scatter && levels ? levels : NULL);
    *scatter = y->scatter;
    FW_TRY(fw_study_levels_run(study, scatter, fw_study_count_yield(study),
                               y->base_number + FW_STUDY_FLOW_PART / 2, fw_study_yielding_points, y,
                               levels));
    out->levels = levels;
    out->evaluations += levels->devices;
    return FW_OK;
}

static fw_status yield_of(fw_study *study, int flow, int first_input, fw_study_flow_yield *out) {
    const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[flow];
    fw_study_yielding y;
    *out = (fw_study_flow_yield){.flow = v->variant->flow, .beta = (double)NAN};
    FW_TRY(fw_study_yielding_begin(study, flow, first_input, &y));
    fw_status status = estimate_all(&y, v, out);
    if (status == FW_OK && y.scatter.levels) status = simulate_wafers(&y, out);
    fw_arena_free(y.chance);
    return status;
}

static fw_status yields(fw_study *study, fw_study_result *result) {
    int flows = study->plan->nflow, column = study->nvary + study->nsetting;
    FW_NEED(result->yield = fw_arena_array(study->arena, fw_study_flow_yield, (size_t)flows));
    for (int i = 0; i < flows; i++) {
        const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[i];
        FW_TRY(yield_of(study, i, column, &result->yield[result->nyield++]));
        column += v->ninput;
    }
    return FW_OK;
}

fw_status fw_study_kind_yield(fw_study *study, fw_study_result *result) {
    fw_study_told told = {
        .most = study->most, .begun_s = fw_study_now_s(), .thread = pthread_self()};
    study->told = &told;
    fw_status status = yields(study, result);
    study->told = NULL;
    return status;
}

/* ---- the dies of a device that a size looks at ---- */

fw_status fw_study_dies_asked(fw_arena *arena, const fw_study *of, const fw_study_sample *chosen,
                              const fw_device_study **out) {
    fw_device_study *asked = fw_arena_one(arena, fw_device_study);
    const size_t n = (size_t)of->asked->nuncertain;
    FW_NEED(asked);
    *asked = *of->asked;
    asked->kind = FW_STUDY_IS_yield;
    asked->judge = FW_JUDGE_MADE;
    asked->nvary = asked->nrespond = 0;
    /* thirty that fail; FW_STUDY_DIES_RARE are the least with which rare failures are not merely counted */
    asked->samples = (int)lround(fmin(fmax(30 / (1 - asked->yield), 400), FW_STUDY_DIES_RARE));
    FW_NEED(asked->uncertain = fw_arena_array(arena, fw_device_uncertain, n));
    bool *met = fw_arena_array(arena, bool, (size_t)of->nvary);
    FW_NEED(met);
    for (size_t k = 0; k < n; k++) {
        fw_device_uncertain *u = &asked->uncertain[k];
        *u = of->asked->uncertain[k];
        if (!u->deviates || met[u->chosen]) continue; /* further rows are deviations already */
        const fw_study_input *in = &of->input[u->chosen];
        const bool within = in->now >= in->from && in->now <= in->to;
        const double value = chosen   ? chosen->value[u->chosen]
                             : within ? in->now
                                      : 0.5 * (in->from + in->to);
        met[u->chosen] = true;
        if (u->spread == FW_SPREAD_NORMAL)
            u->mean = value;
        else
            u->from += value, u->to += value;
    }
    *out = asked;
    return FW_OK;
}

/* ln of what dies use, their band in it: (n x dimensions) */
static fw_status used_at(fw_study_yielding *y, size_t n, const double *u, double *ln) {
    FW_TRY(fw_study_yielding_limit(y, 0, n, u, ln));
    for (size_t k = 0; k < n; k++)
        ln[k] = isnan(ln[k]) ? -HUGE_VAL : -ln[k];
    return FW_OK;
}

/* the ends of what is only assumed that are worst at u; *unknown follows */
static fw_status worst_ends(fw_study_yielding *y, const double *u, double *unknown, double *ln) {
    const fw_chance_joint *joint = &y->scatter.joint;
    double trial[FW_FABRICATION_INPUTS + 16];
    size_t n = joint->unknowns < 10 ? joint->unknowns : 10;
    *ln = -HUGE_VAL;
    for (size_t k = 0; k < joint->unknowns; k++)
        unknown[k] = y->scatter.middle[k];
    if (joint->unknowns > sizeof trial / sizeof *trial) return FW_LIMIT;
    for (size_t corner = 0; corner < (size_t)1 << n; corner++) {
        double here;
        memcpy(trial, unknown, joint->unknowns * sizeof *trial);
        for (size_t k = 0; k < n; k++) {
            const fw_chance_distribution *d = &joint->variable[joint->unknown[k]].distribution;
            trial[k] = corner >> k & 1 ? d->high : d->low;
        }
        y->unknown = joint->unknowns > 0 ? trial : NULL;
        FW_TRY(used_at(y, 1, u, &here));
        if (corner > 0 && !(here > *ln)) continue;
        *ln = here;
        memcpy(unknown, trial, joint->unknowns * sizeof *trial);
    }
    y->unknown = joint->unknowns > 0 ? unknown : NULL;
    return FW_OK;
}

enum { TURNS = 6 };
static const double apart =
    0.3; /* of differences, in standard deviations: wider than a first look is off by */

/* from u, which uses *ln, along the gradient there; *turned false: it stays, or nothing is worse */
static fw_status turn(fw_study_yielding *y, double beta, size_t n, double *u, double *ln,
                      double *trial, bool *turned) {
    double length = 0, *value = trial + n * n, *next = value + n, used;
    for (size_t i = 0; i < n; i++) {
        memcpy(trial + i * n, u, n * sizeof *u);
        trial[i * n + i] += apart;
    }
    FW_TRY(used_at(y, n, trial, value));
    *turned = false;
    for (size_t i = 0; i < n; i++) {
        next[i] = isfinite(value[i]) ? value[i] - *ln : 0;
        length += next[i] * next[i];
    }
    if (!(length > 0)) return FW_OK;
    double step = 0;
    for (size_t i = 0; i < n; i++) {
        next[i] *= beta / sqrt(length);
        step += (next[i] - u[i]) * (next[i] - u[i]);
    }
    FW_TRY(used_at(y, 1, next, &used));
    if (!(used > *ln)) return FW_OK;
    memcpy(u, next, n * sizeof *u);
    *ln = used;
    *turned = sqrt(step) > 0.02 * beta;
    return FW_OK;
}

static fw_status worst_of(fw_study_yielding *y, double beta, fw_study_die *die) {
    size_t n = die->dimensions;
    double *trial = fw_arena_array(y->chance, double, n *n + 2 * n + 1);
    FW_NEED(trial);
    for (int ends = 0; ends < 2; ends++) { /* the ends that are worst may be others there */
        double there;
        bool turned = true;
        FW_TRY(worst_ends(y, die->u, die->unknown, &there));
        if (ends == 0) die->intended = there;
        if (ends > 0 && !(there > die->ln)) break;
        die->ln = there;
        for (int k = 0; turned && k < TURNS; k++)
            FW_TRY(turn(y, beta, n, die->u, &die->ln, trial, &turned));
    }
    return FW_OK;
}

/* with the model's band against the device; y->chance is freed by the caller */
static fw_status begin_worst(fw_study *dies, int flow, fw_study_yielding *y) {
    FW_TRY(fw_study_yielding_begin(dies, flow, 0, y));
    y->as = FW_STUDY_AT_WORST;
    return FW_OK;
}

fw_status fw_study_dies_worst(fw_study *dies, int flow, double beta, fw_arena *arena,
                              fw_study_die *die) {
    fw_study_yielding y;
    fw_status status = begin_worst(dies, flow, &y);
    *die = (fw_study_die){
        .flow = flow, .dimensions = y.scatter.dimensions, .unknowns = y.scatter.joint.unknowns};
    die->u = fw_arena_array(arena, double, die->dimensions + 1);
    die->unknown = fw_arena_array(arena, double, die->unknowns + 1);
    if (!die->u || !die->unknown) status = FW_NOMEM;
    if (status == FW_OK) status = worst_of(&y, beta, die);
    fw_arena_free(y.chance);
    return status;
}

fw_status fw_study_dies_failing(fw_study *dies, int flow, double *share) {
    fw_study_yielding y;
    fw_chance_estimate e;
    const char *why;
    fw_status status = begin_worst(dies, flow, &y);
    const fw_chance_limit of = {
        .dimensions = y.scatter.dimensions, .g = fw_study_yielding_limit, .context = &y};
    fw_chance_options o = {.method = FW_CHANCE_IMPORTANCE,
                           .seed = (uint64_t)dies->asked->seed,
                           .budget =
                               (size_t)fmax(dies->asked->samples / 5, FW_CHANCE_BUDGET_LEAST)};
    double ends = 0;
    const size_t n = y.scatter.joint.unknowns;
    double *origin = NULL, *unknown = NULL;
    if (status == FW_OK) {
        origin = fw_arena_array(y.chance, double, of.dimensions + 1);
        unknown = fw_arena_array(y.chance, double, n + 1);
        if (!origin || !unknown) status = FW_NOMEM;
    }
    if (status == FW_OK) status = worst_ends(&y, origin, unknown, &ends);
    if (status == FW_OK) status = fw_chance_estimate_run(y.chance, &of, &o, &e, &why);
    if (status == FW_SOLVER || status == FW_LIMIT) { /* no way towards a failure was found */
        o.method = FW_CHANCE_AUTO;
        status = fw_chance_estimate_run(y.chance, &of, &o, &e, &why);
    }
    if (status == FW_OK) *share = e.probability_high;
    fw_arena_free(y.chance);
    return status;
}

static fw_status die_at(const fw_study *dies, const fw_study *of, const fw_study_sample *chosen,
                        const fw_study_die *die, fw_arena *arena, double *ln) {
    fw_study at = *dies; /* what is found of this device lies in `arena` */
    const fw_device *device;
    fw_device_set *set = fw_arena_array(arena, fw_device_set, (size_t)of->nvary);
    fw_verdict_variant_verdict *variant =
        fw_arena_array(arena, fw_verdict_variant_verdict, (size_t)dies->plan->nflow);
    FW_NEED(set && variant ? set : NULL);
    at.arena = arena, at.diags = fw_diags_new(arena);
    for (int k = 0; k < of->nvary; k++)
        set[k] = (fw_device_set){of->input[k].what, chosen->text[k]};
    FW_TRY(fw_study_dies_asked(arena, of, chosen, &at.asked));
    FW_TRY(fw_plan_restated(dies->plan, arena, set, of->nvary, NULL, &device, variant));
    fw_study_yielding y = {.study = &at, .flow = die->flow, .base = set, .nbase = of->nvary};
    y.ninput = variant[die->flow].ninput;
    FW_TRY(fw_study_scatter_of(&at, &variant[die->flow], &y.scatter));
    if (y.scatter.dimensions != die->dimensions || y.scatter.joint.unknowns != die->unknowns)
        return FW_OK;
    double *drawn = fw_arena_array(arena, double, y.scatter.joint.values + 1),
           *x = fw_arena_array(arena, double, (size_t)y.scatter.npoint);
    fw_verdict_made made;
    FW_NEED(drawn && x ? x : NULL);
    fw_study_scatter_point(&y.scatter, die->u, die->unknowns > 0 ? die->unknown : NULL,
                           fw_study_scatter_at(&y.scatter, die->u), drawn, x);
    FW_TRY(fw_study_yielding_judge(&y, x, &made, NULL, NULL));
    *ln = made.high;
    return FW_OK;
}

fw_status fw_study_dies_at(const fw_study *dies, const fw_study *of, const fw_study_sample *chosen,
                           const fw_study_die *die, double *ln) {
    fw_arena *arena = fw_arena_part(dies->plan->arena, 0);
    FW_NEED(arena);
    *ln = (double)NAN;
    fw_status status = die_at(dies, of, chosen, die, arena, ln);
    fw_arena_free(arena);
    return fw_plan_is_final(status) ? status
                                    : FW_OK; /* what cannot be read or drawn has no number */
}
