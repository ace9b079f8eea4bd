/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions, their order, the errors of the model that they allow for, and what a refined computation may decide. */
#include "verdict/verdict_parts.h"
#include <math.h>

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
    return fw_above_rounding(h->utilisation, other->utilisation);
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

fw_status fw_verdict_workspace_reason(fw_verdict_variant_verdict *v, int number,
                                      fw_verdict_decision decision, const char *text) {
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = "workspace",
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = number,
                                                  .decision = decision,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .text = text};
    return FW_OK;
}

/* ---- what a flow makes ---- */

/* the worst of everything that was run, and the hinge that makes it so */
void fw_verdict_search_govern(fw_verdict_search *s) {
    fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    double most = -1.0;
    fabricated->governing = FW_NONE;
    fabricated->at = 0;
    fw_verdict_decision worst = FW_ACCEPT;
    for (int c = 0; c < fabricated->ncorner; c++) {
        const fw_verdict_fabricated_corner *corner = &fabricated->corner[c];
        if (fw_verdict_is_worse(worst, corner->decision)) continue;
        if (corner->decision != worst) most = -1.0, worst = corner->decision;
        if (corner->why && most < 0.0)
            fabricated->at = c, fabricated->governing = FW_NONE, most = 0.0;
        for (int k = 0; k < s->v->nhinge; k++)
            if (corner->hinge[k].scene && !fw_verdict_is_worse(worst, corner->hinge[k].decision) &&
                fw_above_rounding(corner->hinge[k].utilisation, most)) {
                most = corner->hinge[k].utilisation;
                fabricated->at = c, fabricated->governing = k;
            }
    }
    fabricated->decision = worst == FW_ACCEPT                            ? FW_ACCEPT
                           : fabricated->corner[0].decision == FW_REJECT ? FW_REJECT
                                                                         : FW_INCONCLUSIVE;
}

/* ---- across the plane, as what a flow makes has it ---- */

/* What a device tips at goes with the third power of its thickness and with Young's modulus; edges change what bends across
   the plane, and the forces of what is moved by a given way, by less than this factor together */
static const double edges_at_most = 2;
static const double strained_most =
    10; /* a hinge without a bound across the plane counts as this */

static double surely_flat(const fw_verdict_across *a) {
    return a->tips / (1 + a->tips_error);
}

/* the least that a flow makes of h^3 E, over the drawn one */
static double weakest(const fw_verdict_variant_verdict *v) {
    double thickness = 1, youngs = 1;
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        const double low = in->low - in->drawn, high = in->high - in->drawn;
        thickness += in->thickness_at + fmin(in->thickness * low, in->thickness * high);
        youngs += in->youngs_at + fmin(in->youngs * low, in->youngs * high);
    }
    return pow(fmax(thickness, 0), 3) * fmax(youngs, 0);
}

/* Forces a million times below what tips are what is left of a zero: a factor on them, and what it is off by, say nothing */
bool fw_verdict_across_tips(const fw_verdict_across *a) {
    const double nothing = 1e6;
    return isfinite(a->tips) && surely_flat(a) < nothing;
}

bool fw_verdict_across_counts(const fw_verdict_variant_verdict *v) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    const double near = edges_at_most / weakest(v);
    for (int i = 0; o && i < o->nscene; i++)
        if (surely_flat(&o->scene[i]) < near) return true; /* NaN: no */
    return false;
}

bool fw_verdict_across_open(const fw_verdict_variant_verdict *v) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    for (int i = 0; o && i < o->nscene; i++)
        if (o->scene[i].tips > 1 && !(surely_flat(&o->scene[i]) >= 1)) return true;
    return false;
}

static double check_of(double used) {
    return used > 1e-9 ? log(fmin(used, strained_most)) : (double)NAN;
}

void fw_verdict_across_checks(const fw_verdict_variant_verdict *v, int nscene, double *ln) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    for (int i = 0; i < 2 * nscene; i++)
        ln[i] = (double)NAN;
    for (int i = 0; o && i < o->nscene; i++) {
        const fw_verdict_across *a = &o->scene[i];
        ln[a->scene_index] = check_of(1 / a->tips);
        ln[nscene + a->scene_index] = check_of(a->strained);
    }
}
