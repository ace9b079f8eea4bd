/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions, their order, the errors of the model that they allow for, and what a refined computation may decide. */
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/quantity_law.h"
#include "statics/statics.h"
#include "verdict/strain.h"
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

static const double fw_known = 1e-5; /* numbers that are known better decide nothing */
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
    tight.motion.beams_anyway = refinement != FW_REFINE_NUMBERS;
    if (tight.motion.beams_anyway) tight.motion.hinge_accuracy = asked;
    if (refinement == FW_REFINE_BEAMS) return tight;
    tight.motion.accuracy = fmin(asked, fw_verdict_tightest), tight.motion.rtol = 0.0;
    return tight;
}

/* ---- what speaks against a scene ---- */

/* reasons of one flow for what is not in the masks (verdict_scene.c) */
static int missing_most(const fw_device *device) {
    int n = device->nbody + device->njoint + device->nspring + device->nrevolute;
    for (int i = 0; i < device->nscene; i++) {
        n += device->scene[i].ncomb;
        for (int t = 0; t < device->scene[i].ntendon; t++)
            n += device->scene[i].tendon[t].neyelet;
    }
    return n;
}

size_t fw_verdict_reasons_most(const fw_device *d, int nrequirement) {
    size_t most =
        (FW_REASONS + 1) * (size_t)d->nscene + (size_t)d->nworkspace + (size_t)nrequirement +
        (size_t)d->nrequirement + /* those that nothing answers */
        (size_t)d->nrevolute + (size_t)missing_most(d) +
        17; /* what no mask draws; rings on, scenes together; strips; out of reach or badly held, held against what is unknown, tipping, what hinges give, as made, what nobody knows of it, between corners, riders, rims; stiction; drawn bent */
    for (int i = 0; i < d->nscene; i++)
        most += (size_t)d->scene[i].ncontact;
    return most;
}

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

/* the worst of everything that was run, and the hinge that makes it so; where something is not known, and nothing is
   assumed of it, that is not all that may be made, and the nominal device is not the one that is */
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
    const bool open = fw_verdict_fabrication_open(s->v->input, s->v->ninput);
    fabricated->decision = open                                          ? FW_INCONCLUSIVE
                           : worst == FW_ACCEPT                          ? FW_ACCEPT
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

/* Forces a million times below what tips are what is left of a zero: a factor on them, and what it is off by, say nothing,
   but where they are off by so much that it may tip all the same */
bool fw_verdict_across_tips(const fw_verdict_across *a) {
    const double nothing = 1e6, matters = 1e3;
    return isfinite(a->tips) && surely_flat(a) < (a->tips < nothing ? nothing : matters);
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

/* ---- loads in the plane that tip it, and soften it before they do ---- */

/* Where what tips the device is sure to be `factor` times its forces, their second-order work is at most K/factor, so that
   what is left is at least K (1 - 1/factor): by as much it sags more, and f^2 of every mode is lower. Proved of a mode, and
   of the work of what loads it; of one point an estimate, exact where one mode has all of it */
double fw_verdict_across_softened(const fw_verdict_across *a) {
    const double sure = surely_flat(a);
    return sure > 1 ? 1 / sure : sure >= 0 ? 1 : 0;
}

void fw_verdict_across_under_loads(const fw_verdict_variant_verdict *v, int scene,
                                   const fw_verdict_plate_mode *of, double *low_Hz,
                                   double *high_Hz) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    *low_Hz = of->low_Hz, *high_Hz = of->high_Hz;
    for (int i = 0; o && scene != FW_NONE && i < o->nscene; i++) {
        if (o->scene[i].scene_index != scene) continue;
        *low_Hz *= sqrt(1 - fw_verdict_across_softened(&o->scene[i]));
        *high_Hz *= sqrt(1 + o->scene[i].stiffened);
    }
}

double fw_verdict_across_stressed(const fw_verdict_variant_verdict *v) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    double most = 0;
    for (int i = 0; o && i < o->nscene; i++)
        if (v->mechanism->device->scene[o->scene[i].scene_index].nstress > 0)
            most = fmax(most, fw_verdict_across_softened(&o->scene[i]));
    return most;
}

/* forces of the scene at their points, with their laws' largest values; of anything else that may act on a body, and
   of a law without a proved largest value, its force is not looked up */
void fw_verdict_across_acting(const fw_mechanism *m, const fw_device_scene *s, double *else_Nm) {
    const bool more = s->ntendon || s->ncomb || s->ncontact || s->npart || m->nspring || m->ndriver;
    for (int b = 0; b < m->nbody; b++)
        else_Nm[b] = more ? (double)NAN : 0;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        if (f->body == FW_GROUND) continue;
        double arm = hypot(f->x_m, f->y_m);
        if (!(arm > 0)) continue;
        double most = fw_quantity_law_measure(f->law, s->duration_s).most;
        else_Nm[f->body] += isfinite(most) ? most * hypot(f->fx_N, f->fy_N) * arm : (double)NAN;
    }
}

/* Joints that only stiff axes hold ring in a motion by forces that its accuracy, which is one of angles, says nothing of */
static double forces_off(const fw_dynamics_motion *motion) {
    const fw_verdict_strain_monitor *saw = motion->observed, *other = motion->compared;
    if (!other || !other->bending.hardest_N || !(other->bending.hardest_N2 > 0)) return 0;
    const double loose = other->bending.peak->value, tight = saw->bending.peak->value;
    return motion->stats.estimate_margin * fabs(sqrt(loose / tight) - 1);
}

/* forces that are a share of those that were looked at, the same ones at all hinges, tip no earlier */
static bool a_share_of(int n, const double *f, const double *of) {
    double product = 0, size = 0;
    for (int i = 0; i < n; i++)
        product += f[i] * of[i], size += of[i] * of[i];
    const double share = size > 0 ? product / size : 0;
    if (!(share >= 0) || share > 1) return false;
    double off = 0;
    for (int i = 0; i < n; i++)
        off += (f[i] - share * of[i]) * (f[i] - share * of[i]);
    return off <= 1e-12 * size;
}

/* By how much forces that pull may make it stiffer: what the same ones tip it by the other way round, with all of a
   flexure's force along it */
static fw_status stiffened_by(fw_arena *arena, const fw_mechanism_plates *p, const double *forces,
                              const double *other, const double *most, int n, double *stiffened) {
    double *back = fw_arena_array(arena, double, 5 * (size_t)n / 2), factor;
    int weak;
    FW_NEED(back);
    for (int i = 0; i < n; i++)
        back[i] = -forces[i];
    for (int k = 0; k < n / 2; k++) {
        double *of = back + n + 3 * k;
        of[0] = forces[2 * k] * forces[2 * k] + forces[2 * k + 1] * forces[2 * k + 1];
        of[1] = most[3 * k + 1], of[2] = most[3 * k + 2];
    }
    const fw_mechanism_plates_pressed by = {back, back + n, other, 0};
    FW_TRY(fw_mechanism_plates_buckling(arena, p, &by, &factor, &weak));
    *stiffened = fmax(*stiffened, 1 / factor);
    return FW_OK;
}

/* The least factor at the instant of the largest forces, and at those where a component of a hinge's force is largest one
   way or the other. looked: ((1 + 2 n) x n); stiffened NULL: nobody asks */
static fw_status least_factor(fw_arena *arena, const fw_mechanism_plates *p,
                              const fw_verdict_bending *saw, const double *other, int n,
                              double *looked, double *factor, int *hinge, double *stiffened) {
    int count = 0;
    *factor = HUGE_VAL, *hinge = FW_NONE;
    for (int k = -1; k < (saw->extreme ? 2 * n : 0); k++) {
        const double *at = k < 0 ? saw->hardest_N : saw->extreme_N + (size_t)k * (size_t)n;
        const double beside = k < 0 ? saw->beside : saw->extreme[k].beside;
        double *forces = looked + (size_t)count * (size_t)n;
        if (k >= 0 && !(saw->extreme[k].value_N > 0)) continue;
        for (int i = 0; i < n; i++)
            forces[i] = beside * at[i];
        bool known = false;
        for (int j = 0; j < count && !known; j++)
            known = a_share_of(n, forces, looked + (size_t)j * (size_t)n);
        if (known) continue;
        const fw_mechanism_plates_pressed pressed = {forces, saw->hardest_N + 2 * n, other,
                                                     isfinite(*factor) ? *factor : 0};
        double now;
        int weak;
        FW_TRY(fw_mechanism_plates_buckling(arena, p, &pressed, &now, &weak));
        if (now < *factor) *factor = now, *hinge = weak;
        if (stiffened) FW_TRY(stiffened_by(arena, p, forces, other, pressed.most, n, stiffened));
        count++;
    }
    return FW_OK;
}

/* a frequency across the plane is asked for under this scene's loads */
static bool frequency_asked(const fw_device *d, int scene) {
    for (int i = 0; i < d->nrequirement; i++) {
        const fw_device_probe *p = &d->probe[d->requirement[i].probe];
        if (d->requirement[i].scene == scene && p->row == FW_PROBE_IS_frequency &&
            p->plane != FW_PLANE_IN)
            return true;
    }
    return false;
}

/* What two runs differ by in what their forces tip, times the margin of estimates, and at most what the forces differ by */
static fw_status tipping_off(fw_arena *arena, const fw_mechanism_plates *p,
                             const fw_dynamics_motion *motion, const double *acting, int n,
                             double *looked, double tips, double *off) {
    const fw_verdict_strain_monitor *other = motion->compared;
    double loose;
    int hinge;
    FW_TRY(least_factor(arena, p, &other->bending, acting, n, looked, &loose, &hinge, NULL));
    if (loose > 0)
        *off =
            fmin(*off, isinf(loose) ? 0 : motion->stats.estimate_margin * fabs(tips / loose - 1));
    return FW_OK;
}

static fw_status tips_by(fw_arena *arena, const fw_mechanism_plates *p,
                         const fw_verdict_strain_monitor *saw, const double *acting,
                         const double *forces, double *factor) {
    const double *most = saw->bending.hardest_N + 4 * p->mechanism->nhinge;
    const fw_mechanism_plates_pressed by = {forces, most, acting, 0};
    int weak;
    return fw_mechanism_plates_buckling(arena, p, &by, factor, &weak);
}

/* What the next level of hinges changes, and what comes at once and rings on flexures: reciprocal factors add up at most */
static fw_status model_off(fw_arena *arena, const fw_mechanism_plates *p,
                           const fw_dynamics_motion *motion, const double *acting, double *forces,
                           fw_verdict_across *to) {
    const fw_statics_level_step *step = motion->level;
    const fw_mechanism *m = p->mechanism;
    const fw_verdict_strain_monitor *saw = motion->observed;
    const bool pins = motion->ledger.hinge.used == FW_HINGE_REVOLUTE && motion->loads;
    double factor[2] = {HUGE_VAL, HUGE_VAL};
    if (!(to->tips > 0) || isinf(to->tips)) return FW_OK;
    if (pins && !motion->loads->quasi_static && saw->bending.jumped_N[0] > 0)
        FW_TRY(tips_by(arena, p, saw, acting, saw->bending.jumped_N + 1, &factor[0]));
    to->tips_error += to->tips / factor[0];
    if (!step || step->why_not || step->used == step->next) return FW_OK;
    for (int up = 0; up < 2; up++) {
        for (int i = 0; i < 2 * m->nhinge; i++)
            forces[i] = (up ? &step->up : &step->at)->reaction_N[2 * m->hinge[i / 2].pin + i % 2];
        FW_TRY(tips_by(arena, p, saw, acting, forces, &factor[up]));
    }
    if (factor[1] < factor[0]) to->tips_error += to->tips / factor[1] - to->tips / factor[0];
    return FW_OK;
}

fw_status fw_verdict_across_tipping(fw_arena *arena, const fw_mechanism_plates *p,
                                    const fw_device_scene *s, double error,
                                    fw_verdict_variant_verdict *v, fw_verdict_across *to) {
    const fw_dynamics_motion *motion = v->motion[to->scene_index];
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    const fw_mechanism *m = v->mechanism;
    const int n = m->nhinge;
    if (!saw || !saw->bending.hardest_N || !(saw->bending.hardest_N2 > 0)) return FW_OK;
    int hinge;
    const size_t parts = 2 * (size_t)n, most = saw->bending.extreme ? 1 + 2 * parts : 1;
    double *other, *looked = fw_arena_array(arena, double, most *parts);
    FW_NEED(looked);
    FW_NEED(other = fw_arena_array(arena, double, (size_t)m->nbody));
    fw_verdict_across_acting(m, s, other);
    FW_TRY(least_factor(arena, p, &saw->bending, other, 2 * n, looked, &to->tips, &hinge,
                        frequency_asked(m->device, to->scene_index) ? &to->stiffened : NULL));
    to->tips_error = forces_off(motion);
    if (to->tips_error > 1) /* what little there is differs */
        FW_TRY(tipping_off(arena, p, motion, other, 2 * n, looked, to->tips, &to->tips_error));
    FW_TRY(model_off(arena, p, motion, other, looked, to));
    to->stiffened *= 1 + error;
    to->tips = fmax(to->tips * (1 - error), 0); /* 0: nothing is sure */
    if (hinge != FW_NONE) to->hinge = m->pin[m->hinge[hinge].pin].id;
    const double sure = to->tips / (1 + to->tips_error);
    if (!(sure < 1)) return FW_OK;
    char by[32];
    to->decision = FW_INCONCLUSIVE;
    return fw_verdict_scene_reason(
        v, s, 582, FW_INCONCLUSIVE, fmax(0.95 * sure, 1e-3),
        fw_arena_printf(
            arena,
            "the forces of %s%s may tip the device out of its plane: %s%s%s%s%s%s; a thicker "
            "layer, wider or shorter flexures, or less load keep it flat",
            FW_NAMED("scene", s->name),
            sure > 0 ? "that they do not is sure up to "
                     : "up to what multiple of them it stays flat is not known",
            sure > 0 ? fw_number_text(by, sizeof by, sure, 2) : "", sure > 0 ? " times them" : "",
            to->hinge ? ", and the least sure by itself is " : "",
            to->hinge ? fw_text_kind("hinge ", to->hinge) : "", to->hinge ? to->hinge : ""));
}

/* Of what is near nothing goes farther than the pair that goes farthest; of what is farther off the share of its way that was
   found counts, or what was asked about where none is above that */
bool fw_verdict_may_come(const fw_verdict_clearance *c, double by) {
    const double left = c->low_m - c->required_m;
    return c->way.share * by > 1 && !(left > (by - 1) * c->least.farthest_m);
}

/* the most of what anything moves or bends by: what a probe goes with is not looked up */
void fw_verdict_requirement_factor(const double *factor, int nhinge, double most[2]) {
    most[0] = most[1] = 1;
    for (int h = 0; h <= nhinge; h++) {
        most[0] = fmax(most[0], factor[2 * h]);
        most[1] = fmin(most[1], factor[2 * h + 1]);
    }
}

/* ---- what may still decide what is required ---- */

const char fw_verdict_at_rest[] = "at rest";

static fw_verdict_hinge_verdict as_hinge(const fw_verdict_requirement *r) {
    double relative = r->value != 0 ? r->numeric / fabs(r->value) : 0;
    return (fw_verdict_hinge_verdict){.scene = r->scene ? r->scene : fw_verdict_at_rest,
                                      .utilisation = r->utilisation,
                                      .utilisation_low = r->utilisation_low,
                                      .utilisation_high = r->utilisation_high,
                                      .numeric = r->utilisation * relative,
                                      .lasting = r->lasting,
                                      .decision = r->decision};
}

/* what is open of a motion is so at any accuracy: it ends too early, or another device has none */
static bool may_be_decided(const fw_verdict_requirement *r) {
    return r->utilisation > 0 && !r->why && !(r->open && r->measure);
}

fw_verdict_refinement fw_verdict_requirements_refinement(const fw_verdict_requirement *requirement,
                                                         int count) {
    fw_verdict_refinement most = FW_REFINE_NOTHING;
    for (int k = 0; k < count; k++) {
        if (!may_be_decided(&requirement[k])) continue;
        const fw_verdict_hinge_verdict h = as_hinge(&requirement[k]);
        const fw_verdict_refinement now = fw_verdict_refinement_of(&h, 1);
        if (now == FW_REFINE_HINGES || most == FW_REFINE_NOTHING) most = now;
    }
    return most;
}

double fw_verdict_requirements_enough(const fw_verdict_requirement *requirement, int count,
                                      double accuracy) {
    double enough = accuracy;
    for (int k = 0; k < count; k++) {
        if (!may_be_decided(&requirement[k])) continue;
        const fw_verdict_hinge_verdict h = as_hinge(&requirement[k]);
        enough = fmin(enough, fw_verdict_enough(&h, 1, accuracy));
    }
    return enough;
}

/* ---- what a requirement lacks, in words ---- */

/* Of two bounds the one that it may be beyond, else the one of which more is used */
bool fw_verdict_requirement_below(const fw_verdict_requirement *r) {
    bool under = fmin(r->low, r->all_low)<r->min, over = fmax(r->high, r->all_high)> r->max;
    if (isnan(r->min) || isnan(r->max)) return isnan(r->max);
    return under != over ? under : !r->by_max;
}

const char *fw_verdict_requirement_text(fw_arena *arena, const fw_verdict_requirement *r) {
    char value[FW_PROBE_TEXT], low[FW_PROBE_TEXT], high[FW_PROBE_TEXT], bound[FW_PROBE_TEXT];
    bool below = fw_verdict_requirement_below(r);
    const char *of = r->measure ? r->measure : r->kind;
    fw_probe_text(bound, below ? r->min : r->max, r->unit);
    if (r->why)
        return fw_arena_printf(arena, "what is required of %s (%s, at %s %s) is not known: %s",
                               r->probe, of, below ? "least" : "most", bound, r->why);
    if (r->open && r->decision != FW_REJECT)
        return fw_arena_printf(arena,
                               "%s (%s) is %s, and at %s %s is required, but what that may be off "
                               "by is not known: %s",
                               r->probe, of, fw_probe_text(value, r->value, r->unit),
                               below ? "least" : "most", bound, r->open);
    fw_probe_text(low, r->low, r->unit), fw_probe_text(high, r->high, r->unit);
    const char *all = "";
    if (below ? isinf(r->all_low) : isinf(r->all_high)) {
        all = "; of what the flow makes between its corners that is not known";
    } else if (below ? r->all_low < r->low : r->all_high > r->high) { /* of what is asked for */
        char end[FW_PROBE_TEXT];
        fw_probe_text(end, below ? r->all_low : r->all_high, r->unit);
        if (!fw_text_same(end, below ? low : high))
            all = fw_arena_printf(arena, "; no corner of the flow is %s %s",
                                  below ? "below" : "above", end);
        if (!all) return NULL;
    }
    char rings[FW_PROBE_TEXT], when[FW_PROBE_TEXT];
    const char *still = "",
               *rubs = r->rubs ? ", from all that rubs sliding to all of it stuck" : "";
    if (r->untouched) rubs = ", since it may not touch at all";
    if (r->rings > 0)
        still = fw_arena_printf(arena,
                                " of a motion that has not come to rest (where it ends it still "
                                "goes to and fro by %s to either side: a longer scene or damping, "
                                "<air> or <material-damping>, lets it settle)",
                                fw_probe_text(rings, r->rings, r->unit));
    if (!still) return NULL;
    return fw_arena_printf(arena, "%s (%s) is %s%s (%s to %s%s%s), and at %s %s is required%s",
                           r->probe, of, fw_probe_text(value, r->value, r->unit),
                           fw_probe_when(when, r->measure ? (double)NAN : r->t_s), low, high, rubs,
                           all, below ? "least" : "most", bound, still);
}
