/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions, their order, the errors of the model that they allow for, and what a refined computation may decide. */
#include "statics/statics.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* motion: largest difference of any hinge's peak section moment, joint force included, between
   ideal pins and geometrically exact flexures over the four reference load cases of a whole
   six-bar, 2.9 % (0.7 % at the governing hinge); strain: more than the closed form's peak strain is
   off by within its range (fw_flexure_error), for what is bounded and not judged */
const fw_verdict_model_errors fw_verdict_model_error = {0.029, 0.029};
const double fw_verdict_first_accuracy = 3e-2;

const char *fw_verdict_decision_text(fw_verdict_decision decision) {
    switch (decision) {
    case FW_ACCEPT:
        return "accept";
    case FW_INCONCLUSIVE:
        return "inconclusive";
    case FW_REJECT:
        return "reject";
    }
    return "inconclusive";
}

/* the order of decisions: nothing else compares them */
static int badness(fw_verdict_decision decision) {
    switch (decision) {
    case FW_ACCEPT:
        return 0;
    case FW_INCONCLUSIVE:
        return 1;
    case FW_REJECT:
        break;
    }
    return 2;
}

bool fw_verdict_is_worse(fw_verdict_decision a, fw_verdict_decision b) {
    return badness(a) > badness(b);
}

fw_verdict_decision fw_verdict_worse(fw_verdict_decision a, fw_verdict_decision b) {
    return fw_verdict_is_worse(a, b) ? a : b;
}

/* the worse decision, then the higher utilisation; the band holds that of both */
void fw_verdict_keep_worst(fw_verdict_hinge_verdict *worst, const fw_verdict_hinge_verdict *other) {
    double low = fmax(worst->utilisation_low, other->utilisation_low);
    double high = fmax(worst->utilisation_high, other->utilisation_high);
    double breaks = worst->scene ? worst->failure_probability : (double)NAN;
    if (!worst->scene || fw_verdict_governs(other, worst)) *worst = *other;
    worst->failure_probability = fmax(breaks, other->failure_probability); /* passes by NaN */
    worst->utilisation_low = low;
    worst->utilisation_high = high;
}

bool fw_verdict_governs(const fw_verdict_hinge_verdict *h, const fw_verdict_hinge_verdict *other) {
    if (h->decision != other->decision) return fw_verdict_is_worse(h->decision, other->decision);
    return h->utilisation > other->utilisation;
}

/* ---- what a refined computation may decide ----
   Whether a refined computation can decide an undecided device. A hinge uses U with the band
     U (1 - m) - n to U (1 + m') + n,   m, m': model, n: numbers,
   and of either a part l stays whatever is computed. What the refined computation finds lies within
   n + U (m - l) of U, and its band is U' (1 - l) to U' (1 + l'); with tighter numbers alone within
   n, and of the same m. It pays where all undecided hinges may then be accepted, or one of them rejected.
   Test: test_closer.c. */

/* numbers that are known better than this decide nothing */
static const double fw_known = 1e-5;
const double fw_verdict_tightest = 1e-6;

typedef struct reach { /* lowest upper end and highest lower end that a band may come to have */
    double high, low;
} reach;

static reach reach_of(const fw_verdict_hinge_verdict *h, bool hinges) {
    double u = h->utilisation, n = h->numeric;
    if (!(u > 0)) return (reach){h->utilisation_high, h->utilisation_low};
    double up = (h->utilisation_high - n) / u - 1, down = 1 - (h->utilisation_low + n) / u;
    double stays_up = hinges ? fmin(up, h->lasting) : up;
    double stays_down = hinges ? fmin(down, h->lasting_low) : down;
    return (reach){(u - n - u * (up - stays_up)) * (1 + stays_up),
                   (u + n + u * (down - stays_down)) * (1 - stays_down)};
}

/* with numbers (and hinges) as good as they get */
static bool may_decide(const fw_verdict_hinge_verdict *hinge, int nhinge, bool hinges) {
    bool accept = true, reject = false, any = false;
    for (int k = 0; k < nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &hinge[k];
        if (!h->scene || h->decision != FW_INCONCLUSIVE) continue;
        reach r = reach_of(h, hinges);
        accept = accept && !h->touches && r.high < 1;
        reject = reject || r.low > 1;
        any = any || hinges || h->numeric > fw_known;
    }
    return any && (accept || reject);
}

fw_verdict_refinement fw_verdict_refinement_of(const fw_verdict_hinge_verdict *hinge, int nhinge) {
    if (may_decide(hinge, nhinge, false)) return FW_REFINE_NUMBERS;
    return may_decide(hinge, nhinge, true) ? FW_REFINE_HINGES : FW_REFINE_NOTHING;
}

/* half of what lies between 1 and the nearer end of a band without numbers; these are taken to go
   with the accuracy */
double fw_verdict_enough(const fw_verdict_hinge_verdict *hinge, int nhinge, double accuracy) {
    double share = 1;
    for (int k = 0; k < nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &hinge[k];
        if (!h->scene || h->decision != FW_INCONCLUSIVE || !(h->numeric > 0)) continue;
        double n = h->numeric, high = h->utilisation_high - n, low = h->utilisation_low + n;
        share = fmin(share, 0.5 * fmin(fabs(1 - high), fabs(1 - low)) / n);
    }
    return accuracy * share;
}

fw_verdict_options fw_verdict_tighter(const fw_verdict_options *options,
                                      fw_verdict_refinement refinement) {
    fw_verdict_options tight = *options;
    double asked = options->motion.accuracy > 0 ? options->motion.accuracy : 1e-3;
    tight.motion.accuracy = fmin(asked, fw_verdict_tightest);
    tight.motion.rtol = 0.0;
    if (refinement == FW_REFINE_HINGES) tight.motion.hinge_accuracy = asked;
    return tight;
}

/* ---- what of a clearance is used ---- */

static double between(double used) {
    const double least = 1e-3, most = 1e3; /* a thousandth is as good as nothing, and has slopes */
    return fmin(fmax(used, least), most);
}

/* Share of what there is to use up by the nearest pair: of a motion, the distance that it has lost over
   what it may lose; of a required box, what is asked for over what is left. At 1 there is just as
   much as is asked for. */
double fw_verdict_search_used_nearest(const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    const double target = c->required_m + c->wall_m, most = HUGE_VAL;
    double used = target / l->m;
    if (c->box == FW_NONE) used = (l->start_m - l->m) / (l->start_m - target);
    if (c->box == FW_NONE && l->start_m <= target) used = most;
    if (l->m <= 0) used = 1 / l->share;
    return between(used);
}

/* By any pair of a motion: what is nearest may have lost nothing of its distance, as fingers of a comb that slide
   by each other, while others have lost nearly all. by_nearest: distances were found, not bounded */
double fw_verdict_search_used(const fw_verdict_clearance *c, bool by_nearest) {
    const bool meet = c->least.m <= 0 && c->least.share > 0;
    const double nearest = by_nearest || meet ? fw_verdict_search_used_nearest(c) : 0;
    return between(c->box == FW_NONE ? fmax(nearest, c->way.share) : nearest);
}

/* ---- what speaks against a scene ---- */

fw_status fw_verdict_scene_reason(fw_verdict_variant_verdict *v, const fw_device_scene *scene,
                                  int number, fw_verdict_decision decision, double keep,
                                  const char *text) {
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = scene->name,
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = number,
                                                  .decision = decision,
                                                  .keep = fmin(fmax(keep, 1e-3), 0.99),
                                                  .text = text};
    return FW_OK;
}

/* ---- what a law does near a resonance ----
   Bands hold what a stiffness is off by in proportion. A law that goes to and fro for many periods near a mode does much
   more or less where the mode lies a little lower or higher than computed, which its own error allows. Of each load whose
   law goes to and fro, and of each mode, A(w) is the largest answer of an oscillator with the mode's damping
   (fw_quantity_law_swing); with w_k how much the load does to mode k at rest,

     up = max over loads of sum w_k max A/sum w_k A(w_k),   down likewise with the least A,

   over frequencies within the mode's error and what bodies give, half a radian apart at the end of the scene, at most
   100 of them. Inputs: modes at rest of the scene. Outputs: factors on what moves, up >= 1 >= down. Error: small
   motions, as modes are; a mode's shape stays. Cost: modes, and 24 steps a period for each frequency.
   Test: test_effects.py Resonance */

static bool to_and_fro(const fw_quantity_law *law, double end_s) {
    const double swings = 6; /* three times there and back */
    const fw_quantity_law_size size = fw_quantity_law_measure(law, end_s);
    return !(size.variation <= swings * size.most);
}

typedef struct shaken_by {
    const fw_quantity_law *law;
    enum {
        BY_BODY,
        BY_MASS,
        BY_ANY
    } how; /* on one body; on all by their mass; not looked up, every mode alike */
    int body;
    double x_m, y_m, fx, fy, torque;
} shaken_by;

/* what it does to a mode at rest, for a shape whose largest entry is 1 */
static double does_to(const fw_mechanism *m, const fw_statics_mode *mode, const shaken_by *by) {
    double work = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *u = mode->shape + 3 * b;
        if (by->how == BY_MASS)
            work += m->body[b].mass_kg * (by->fx * u[0] + by->fy * u[1]);
        else if (by->how == BY_BODY && by->body == b)
            work += by->fx * (u[0] - by->y_m * u[2]) + by->fy * (u[1] + by->x_m * u[2]) +
                    by->torque * u[2];
    }
    if (by->how == BY_ANY) work = 1;
    return fabs(work) / (mode->modal_mass_kg_m2 * mode->stiffness_per_s2);
}

/* largest and least answer of a mode within its error; of one that takes too long, as if it were known */
static void answers_of(const fw_statics_mode *mode, const fw_quantity_law *law, double end_s,
                       double bodies, double to[3]) {
    enum { MOST = 100 };
    const double w = mode->omega_rad_per_s, z = fmin(fmax(mode->damping_ratio, 0), 0.99);
    const double off = fmin(fw_statics_mode_error(mode), 0.5), low = w * (1 - off - 0.5 * bodies),
                 high = w * (1 + off);
    const double n = fmin(1 + ceil((high - low) * end_s / 0.5), MOST);
    to[0] = to[1] = to[2] = fw_quantity_law_swing(law, end_s, w, z);
    for (double k = 0; k < n && to[0] >= 0; k++) {
        const double at = n > 1 ? low + (high - low) * k / (n - 1) : w;
        const double now = fw_quantity_law_swing(law, end_s, at, z);
        if (!(now >= 0)) continue;
        to[1] = fmax(to[1], now), to[2] = fmin(to[2], now);
    }
    if (to[0] < 0) to[0] = to[1] = to[2] = 1;
}

static void take_shaken(const fw_mechanism *m, const fw_statics_modes *modes, double end_s,
                        double bodies, const shaken_by *by, double factor[2]) {
    enum { FEW = 6 };
    double sum[3] = {0};
    for (int k = 0; k < modes->count && k < FEW; k++) {
        const fw_statics_mode *mode = &modes->mode[k];
        double is[3];
        if (!(mode->stiffness_per_s2 > 0) || !mode->shape) continue;
        const double weight = does_to(m, mode, by);
        answers_of(mode, by->law, end_s, bodies, is);
        for (int i = 0; i < 3; i++)
            sum[i] += weight * is[i];
    }
    if (!(sum[0] > 0)) return;
    factor[0] = fmax(factor[0], sum[1] / sum[0]), factor[1] = fmin(factor[1], sum[2] / sum[0]);
}

/* load i of a scene, or false: there are no more */
static bool load_of(const fw_device_scene *s, int i, shaken_by *by) {
    *by = (shaken_by){0};
    if (i < s->nforce) {
        const fw_device_force *f = &s->force[i];
        *by = (shaken_by){f->law, BY_BODY, f->body, f->x_m, f->y_m, f->fx_N, f->fy_N, 0};
    } else if ((i -= s->nforce) < s->ntorque)
        *by = (shaken_by){.law = s->torque[i].law, .body = s->torque[i].body, .torque = 1};
    else if ((i -= s->ntorque) < s->ntendon)
        *by = (shaken_by){.law = s->tendon[i].law, .how = BY_ANY};
    else if ((i -= s->ntendon) < s->nbase)
        *by = (shaken_by){.law = s->base[i].law,
                          .how = BY_MASS,
                          .fx = s->base[i].ax_m_per_s2,
                          .fy = s->base[i].ay_m_per_s2};
    else
        return false;
    return true;
}

/* NULL: there are none */
static fw_status modes_at_rest(fw_arena *arena, const fw_mechanism *m,
                               const fw_statics_modes **modes) {
    const fw_statics_mode_options o = {.accuracy = 0.03};
    const fw_device_scene still = {.name = "(none)", .duration_s = 1};
    fw_diags own = fw_diags_new(arena);
    fw_status status = fw_statics_small_motions(arena, m, &still, &o, &own, modes);
    if (status == FW_CANCELLED) return status;
    return status == FW_NOMEM || own.failed ? FW_NOMEM : FW_OK;
}

static fw_status detuned(fw_arena *arena, const fw_mechanism *m, int scene, double bodies,
                         double factor[2]) {
    const fw_device_scene *s = &m->device->scene[scene];
    const fw_statics_modes *modes = NULL;
    shaken_by by;
    for (int i = 0; load_of(s, i, &by); i++) {
        const bool still = by.how == BY_MASS && by.fx == 0 && by.fy == 0; /* across the plane */
        if (still || !to_and_fro(by.law, s->duration_s)) continue;
        if (!modes) FW_TRY(modes_at_rest(arena, m, &modes));
        if (!modes) return FW_OK;
        take_shaken(m, modes, s->duration_s, bodies, &by, factor);
    }
    return FW_OK;
}

/* what meets may not, where a mode that lies elsewhere moves less */
static void may_not_meet(fw_verdict_variant_verdict *v, int scene, double less) {
    const char *name = v->mechanism->device->scene[scene].name;
    for (int k = 0; k < v->nreason; k++) {
        fw_verdict_reason *r = &v->reason[k];
        if (r->number == 294 && r->decision == FW_REJECT && r->scene && r->keep > less &&
            strcmp(r->scene, name) == 0)
            r->decision = FW_INCONCLUSIVE;
    }
    for (int k = 0; k < v->nclearance; k++) {
        fw_verdict_clearance *c = &v->clearance[k];
        if (c->scene_index == scene && c->decision == FW_REJECT && c->keep > less)
            c->decision = FW_INCONCLUSIVE;
    }
}

/* v->detuned; a warning, and a reason where what does not meet may then meet */
fw_status fw_verdict_detune(fw_arena *arena, const fw_mechanism *m, const double *bodies,
                            bool brief, fw_diags *diags, fw_verdict_variant_verdict *v) {
    const double told = 1.1;
    const fw_device *d = m->device;
    FW_NEED(v->detuned = fw_arena_array(arena, double, 2 * (size_t)d->nscene));
    for (int i = 0; i < d->nscene; i++) {
        double *f = v->detuned + 2 * i;
        char up[32], down[32];
        f[0] = f[1] = 1;
        if (v->motion[i]) FW_TRY(detuned(arena, m, i, bodies[i], f));
        if (f[1] < 1) may_not_meet(v, i, f[1]);
        if (!(f[0] > told)) continue;
        fw_number_text(up, sizeof up, f[0], 2), fw_number_text(down, sizeof down, f[1], 2);
        if (!brief)
            fw_diag_warning(diags, 642, d->scene[i].place,
                            "%s%s shakes near a mode whose frequency is known to some per cent: "
                            "within them it moves %s to %s times as far, which the bands hold; "
                            "keep the frequencies apart, or say by <material-damping> what damps",
                            FW_NAMED("scene", d->scene[i].name), down, up);
        for (int k = 0; k < v->nclearance; k++) {
            const fw_verdict_clearance *c = &v->clearance[k];
            if (c->scene_index != i || c->decision != FW_ACCEPT || !(c->way.share * f[0] > 1))
                continue;
            const char *text = fw_arena_printf(
                arena,
                "%s and %s may meet in %s%s: they come %s of the way as computed, and a mode that "
                "lies within its error may move %s times as far",
                c->way.a ? c->way.a : "parts", c->way.b ? c->way.b : "others",
                FW_NAMED("scene", d->scene[i].name),
                fw_number_text(down, sizeof down, c->way.share, 2), up);
            FW_TRY(fw_verdict_scene_reason(v, &d->scene[i], 642, FW_INCONCLUSIVE,
                                           0.95 / (c->way.share * f[0]), text));
            break;
        }
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}
