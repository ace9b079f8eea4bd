/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The device out of the plane that it moves in: does it come down on its carrier, at which frequencies does it swing
   across the plane, do the forces in the plane tip it out of it? Bodies are plates that are rigid; with what they may
   give at most (body_arms.c) frequencies have their lower end and sags their upper one.
   Theory: docs/theory/effects/out-of-plane.md. Test: test_out_of_plane.py */
#include "base/constants.h"
#include "effects/effects.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/quantity_law.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <string.h>

/* of the layer: electrodes that are lifted so far pull less by about as much */
static const double fw_much = 0.01;
static const fw_geometry_vec2 flat_middle = {0, 0};

typedef struct fw_verdict_plates { /* rigid bodies; bodies that give as much as they may */
    /* tips: by forces. soft: by weight and in modes, where all of a body on one hinge is in what hangs over */
    fw_mechanism_plates rigid, soft, tips;
    double *x, *f, *ring;
    double
        hangs, /* what bodies hang over and bend by their own weight, the most of any, m per m/s2 */
        hangs_mode;        /* and 1/omega^2 of the slowest mode of that */
    fw_verdict_hung *hung; /* (nbody); NULL: nobody asks for it */
} both;

/* ---- who asks ---- */

bool fw_verdict_out_of_plane_asked(const fw_mechanism *m) {
    const fw_device *d = m->device;
    for (int i = 0; i < d->nscene; i++)
        if (fw_device_in_flow(d->scene[i].flow, m->variant->flow) &&
            fw_mechanism_plates_asked(&d->scene[i]))
            return true;
    for (int i = 0; i < d->nrequirement; i++) {
        const fw_device_probe *p = &d->probe[d->requirement[i].probe];
        if (p->row == FW_PROBE_IS_frequency) return true; /* in the plane by what hangs over */
    }
    return false;
}

static fw_status put_modes(fw_arena *arena, const both *is, fw_verdict_out_of_plane *out) {
    const fw_mechanism_plates *p = &is->rigid;
    double *heavy;
    out->nmode = p->n;
    FW_NEED(heavy = fw_arena_array(arena, double, (size_t)p->n));
    FW_TRY(fw_verdict_heavy(arena, is->soft.why ? p : &is->soft, true, p->n, heavy));
    FW_NEED(out->mode = fw_arena_array(arena, fw_verdict_plate_mode, (size_t)p->n));
    for (int k = 0; k < p->n; k++) {
        fw_verdict_plate_mode *mode = &out->mode[k];
        double f = p->f_Hz[k], soft = is->soft.why ? f : is->soft.f_Hz[k], error = 0.5 * p->error;
        mode->f_Hz = f;
        /* 1/omega^2 of both add up at most (Weyl) */
        const double s2 = fmax(pow(FW_TURN * fmin(f, soft), -2), heavy[k]) + is->hangs_mode;
        soft = 1 / (FW_TURN * sqrt(s2));
        mode->low_Hz = soft * (1 - error), mode->high_Hz = f * (1 + error);
        int b = fw_mechanism_plates_mover(p, k, &mode->tilts);
        mode->body = fw_text_name(p->mechanism->body[b].id);
    }
    return FW_OK;
}

/* ---- one scene ---- */

/* What a scene does at rest to x, and what its shocks set swinging either way to `ring`, where forces in the plane leave
   the share `left` of stiffnesses: how far modes go, or, of forces, what bears them over what does at rest; and to
   ring + n their accelerations over the squares of the plates' frequencies. *dynamic: by how much more than at rest */
static void load_scene(const both *is, const fw_mechanism_plates *p, const fw_device_scene *s,
                       double left, double curvature_per_m, bool forces, fw_geometry_vec2 *middle,
                       double *dynamic) {
    size_t n = (size_t)p->n;
    *middle = (fw_geometry_vec2){0, 0};
    *dynamic = 1;
    memset(is->x, 0, n * sizeof(double));
    memset(is->ring, 0, 2 * n * sizeof(double));
    fw_mechanism_plates_weight(p, s->gz_m_per_s2, is->f);
    fw_mechanism_plates_answer(p, is->f, is->x);
    if (curvature_per_m != 0) {
        double *bow = is->ring; /* for a while */
        fw_mechanism_plates_curl(p, curvature_per_m, middle, is->f);
        fw_mechanism_plates_answer(p, is->f, bow);
        for (size_t i = 0; i < n; i++)
            is->x[i] += bow[i], bow[i] = 0;
    }
    for (int i = 0; i < s->nbase; i++) {
        const fw_device_base_motion *b = &s->base[i];
        if (b->az_m_per_s2 == 0) continue;
        fw_mechanism_plates_weight(p, b->az_m_per_s2, is->f);
        double *amplitude = is->f + n;
        fw_mechanism_plates_modal(p, is->f, amplitude);
        for (size_t k = 0; k < n; k++) {
            const double high = sqrt(is->rigid.per_s2[k]), off = 0.5 * is->rigid.error;
            const double low = is->soft.why ? high : fmin(high, sqrt(is->soft.per_s2[k]));
            const fw_quantity_law_response r = fw_quantity_law_responds(
                b->law, s->duration_s, low * (1 - off) * sqrt(left), high * (1 + off));
            const double by = forces ? r.most : r.far;
            is->ring[k] += by * fabs(amplitude[k]),
                is->ring[n + k] += r.behind * fabs(amplitude[k]);
            if (k > 0) continue;
            const double end = fw_quantity_law_done_s(b->law, s->duration_s),
                         most = fw_quantity_law_measure(b->law, end).most;
            if (most > 0) *dynamic = fmax(*dynamic, by / most);
        }
    }
}

/* What hangs over bends by shocks as an oscillator of its own and on the modes of the plates, each of which shakes it by its
   acceleration, w^2 (f - q): at most four times as far as slowly, where it is as slow itself. *rings: m */
static fw_status hang_over(fw_arena *arena, const both *is, const fw_mechanism_plates *p,
                           const fw_device_scene *s, double left, double *rings) {
    const double omega = 1 / sqrt(fmax(is->hangs, is->hangs_mode)), at_most = 0.75,
                 fastest = fmax(1.3 / sqrt(is->hangs), 1 / sqrt(is->hangs_mode));
    double *one;
    *rings = 0;
    if (!(is->hangs > 0) || !fw_mechanism_plates_shaken(s)) return FW_OK;
    FW_NEED(one = fw_arena_array(arena, double, 2 * (size_t)p->n));
    for (int i = 0; i < s->nbase; i++) /* a cantilever of even width has 1.24 omega */
        *rings += fabs(s->base[i].az_m_per_s2) * is->hangs *
                  fw_quantity_law_answer(s->base[i].law, s->duration_s, omega, fastest);
    for (int k = 0; k < p->n; k++) {
        one[k] = is->ring[p->n + k];
        if (!(one[k] > 0)) continue;
        const double z = fw_mechanism_plates_reached(p, one + p->n, one, 0, flat_middle).highest_m;
        one[k] = 0;
        *rings +=
            z * p->per_s2[k] * is->hangs / (left * (1 - fmin(at_most, p->per_s2[k] * is->hangs)));
    }
    return FW_OK;
}

/* "20 um (a hollow of 20 um in its carrier), 18.2 um of which are sure": what counts of a depth that has a band */
static const char *what_is_below(fw_arena *arena, const fw_mechanism_below *below, bool at_most) {
    char has[32], end[32];
    const double counts = at_most ? below->high_m : below->low_m;
    fw_number_text(has, sizeof has, 1e6 * below->m, 3);
    fw_number_text(end, sizeof end, 1e6 * counts, 3);
    const char *text =
        strcmp(has, end) == 0 ? fw_arena_printf(arena, "%s um (%s)", has, below->words)
        : at_most
            ? fw_arena_printf(arena, "%s um (%s), %s um at most", has, below->words, end)
            : fw_arena_printf(arena, "%s um (%s), of which %s um are sure", has, below->words, end);
    return text ? text : "";
}

/* Sure is what is there at rest, less what flexures may be stiffer than computed; what a shock sets ringing may be
   less than its bound */
static fw_status judge_touch(fw_arena *arena, const both *is, const fw_device_scene *s,
                             fw_verdict_variant_verdict *v, fw_verdict_across *to) {
    const fw_mechanism_below *below = &v->mechanism->variant->below;
    char down[32];
    if (!below->known || below->open || !(-to->lowest_m > below->low_m)) return FW_OK;
    bool sure = -to->sure_m / (1 + is->rigid.error) > below->high_m;
    to->decision = sure ? FW_REJECT : FW_INCONCLUSIVE;
    if (!sure && !isfinite(to->lowest_m))
        return fw_verdict_scene_reason(
            v, s, 580, to->decision, FW_VERDICT_KEEP_HALF,
            fw_arena_printf(arena,
                            "how far the device comes down in %s%s is not known, and below "
                            "it are %s: nothing bounds the law of its shock; state "
                            "it as a table, or by a law that has a largest value",
                            FW_NAMED("scene", s->name), what_is_below(arena, below, false)));
    return fw_verdict_scene_reason(
        v, s, 580, to->decision, 0.95 * below->low_m / -to->lowest_m,
        fw_arena_printf(
            arena,
            "%s%s comes down by %s%s um in %s%s, and below it are %s: it %s its "
            "carrier; a thicker layer, shorter or wider flexures, or less weight hold it up",
            FW_NAMED("body", to->body ? to->body : "(none)"), sure ? "" : "up to ",
            fw_number_text(down, sizeof down, -1e6 * (sure ? to->sure_m : to->lowest_m), 3),
            FW_NAMED("scene", s->name), what_is_below(arena, below, sure),
            sure ? "touches" : "may touch"));
}

static fw_status judge_sag(fw_arena *arena, const both *is, const fw_device_scene *s,
                           fw_verdict_variant_verdict *v, fw_verdict_across *to) {
    const fw_mechanism *m = v->mechanism;
    double curvature = fw_mechanism_plates_curvature(m, s);
    fw_geometry_vec2 middle;
    const double left = fmax(1 - fw_verdict_across_softened(to), 1e-9);
    const fw_mechanism_plates *p = is->soft.why ? &is->rigid : &is->soft;
    fw_mechanism_plates_reach r, still;
    double rings, thrown, weighed, *strain;
    to->asked = true;
    FW_NEED(strain = fw_arena_array(arena, double, (size_t)m->nhinge));
    load_scene(is, &is->rigid, s, 1, curvature, false, &middle, &to->dynamic);
    r = fw_mechanism_plates_reached(&is->rigid, is->x, NULL, curvature, middle);
    to->sure_m = r.lowest_m, to->highest_m = r.highest_m; /* of rigid bodies */
    load_scene(is, p, s, left, curvature, false, &middle, &to->dynamic);
    r = fw_mechanism_plates_reached(p, is->x, is->ring, curvature, middle);
    still = fw_mechanism_plates_reached(p, is->x, NULL, curvature, middle);
    FW_TRY(hang_over(arena, is, p, s, left, &rings));
    FW_TRY(fw_verdict_thrown_across(arena, p, is->hung, s, &thrown));
    FW_TRY(fw_verdict_flexures_across(arena, v, p, to->scene_index, strain, &weighed));
    rings += weighed;
    const double more = (1 + is->rigid.error) / left, weighs = is->hangs * s->gz_m_per_s2,
                 far = thrown / sqrt(more); /* it goes by the root of what gives */
    const double low = fmin(to->sure_m, fmax(r.lowest_m - rings, still.lowest_m - far)),
                 high = fmax(to->highest_m, fmin(r.highest_m + rings, still.highest_m + far));
    to->lowest_m = (low + fmin(0, weighs)) * more;
    to->highest_m = (high + fmax(0, weighs)) * more;
    to->tilt_rad = r.tilt_rad * more;
    if (r.low != FW_NONE) to->body = fw_text_name(m->body[r.low].id);
    return judge_touch(arena, is, s, v, to);
}

/* ---- electrodes that lift it ---- */

static fw_status warn_of_lift(const both *is, const fw_device_scene *s, fw_diags *diags,
                              fw_verdict_variant_verdict *v, fw_verdict_across *to) {
    const fw_mechanism *m = v->mechanism;
    const fw_mechanism_plates *p = is->tips.why ? &is->rigid : &is->tips;
    memset(is->f, 0, (size_t)p->n * sizeof *is->f);
    const fw_device_comb *first = fw_effects_levitation_lift(m, s, is->f);
    if (!first) return FW_OK;
    fw_mechanism_plates_answer(p, is->f, is->x);
    const fw_mechanism_plates_reach r = fw_mechanism_plates_reached(p, is->x, NULL, 0, flat_middle);
    to->lift_m = r.highest_m * (1 + is->rigid.error);
    if (!(to->lift_m > fw_much * m->variant->thickness_m) || r.high == FW_NONE) return FW_OK;
    char up[32], share[32];
    fw_diag_warning(
        diags, 596, first->place,
        "%s%s: over a carrier of their own potential the electrodes may lift %s%s "
        "by up to %s um, %s %% of the layer (levitation), which the motion leaves out: they "
        "then pull less",
        FW_NAMED("scene", fw_text_name(s->name)),
        FW_NAMED("body", fw_text_name(m->body[r.high].id)),
        fw_number_text(up, sizeof up, 1e6 * to->lift_m, 3),
        fw_number_text(share, sizeof share, 100 * to->lift_m / m->variant->thickness_m, 2));
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- all of it ---- */

static fw_status prepare(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                         bool lean, both *to) {
    fw_verdict_arm *shared;
    bool asked = !lean || fw_verdict_out_of_plane_asked(m);
    if (!asked) FW_TRY(fw_verdict_hung_says(arena, m, &asked));
    if (asked) FW_TRY(fw_verdict_overhangs(arena, m, arm, true, &to->hung));
    for (int b = 0; asked && b < m->nbody; b++) {
        to->hangs = fmax(to->hangs, to->hung[b].across_s2);
        to->hangs_mode = fmax(to->hangs_mode, to->hung[b].across_mode_s2);
    }
    FW_TRY(fw_mechanism_plates_new(arena, m, NULL, &to->rigid));
    to->soft.why = to->tips.why = to->rigid.why;
    if (to->rigid.why) return FW_OK;
    size_t n = (size_t)to->rigid.n;
    FW_TRY(fw_verdict_shared_arms(arena, m, arm, &shared));
    FW_TRY(fw_verdict_soft_plates(arena, m, shared, &to->soft));
    FW_TRY(fw_verdict_soft_plates(arena, m, arm, &to->tips));
    FW_NEED(to->x = fw_arena_array(arena, double, n));
    FW_NEED(to->f = fw_arena_array(arena, double, 2 * n));
    FW_NEED(to->ring = fw_arena_array(arena, double, 2 * n));
    return FW_OK;
}

/* ---- what hinges bear across the plane ---- */

/* Every mode rings either way on top of what weight does at rest: (1 + n) wrenches of a hinge. A shock that grows so
   slowly that nothing rings is in the amplitudes, too, which are at least those at rest. */
static void put_wrenches(const both *is, int hinge, double curvature_per_m, double (*wrench)[3]) {
    const fw_mechanism_plates *p = &is->rigid;
    fw_mechanism_plates_wrench(p, hinge, is->x, curvature_per_m, wrench[0]);
    for (int k = 0; k < p->n; k++) {
        double *w = wrench[1 + k];
        fw_mechanism_plates_wrench(p, hinge, p->shape + (size_t)k * (size_t)p->n, 0, w);
        for (int i = 0; i < 3; i++)
            w[i] *= is->ring[k];
    }
}

/* what hinge k uses in scene i in the plane, at most: by the band of what governs it. A scene without a motion: by all
   that it ever uses */
static double in_the_plane(const fw_verdict_variant_verdict *v, int k, int i) {
    const fw_verdict_hinge_verdict *h = &v->hinge[k];
    const int nscene = v->mechanism->device->nscene;
    const double used = v->used[(size_t)k * ((size_t)nscene + 1) + (size_t)i];
    if (!h->scene) return 0;
    if (!isfinite(used)) return h->utilisation_high;
    return h->utilisation > 0 ? used * h->utilisation_high / h->utilisation : used;
}

/* ---- what hinges last across the plane ---- */

/* cycles of a hinge in one repetition of the scene: of the fastest mode that makes a hundredth of what rings, from the
   scene's start to its end, with those counted in the plane */
static double cycles_of(const both *is, const double (*wrench)[3], double end_s, double in_plane) {
    const double little = 0.01;
    const fw_mechanism_plates *p = &is->rigid;
    double all = 0, fastest = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < p->n; k++) {
            const double *w = wrench[1 + k],
                         size = hypot(w[0], hypot(w[1], w[2]) / p->hinge[0].length_m);
            if (!pass) all += size;
            if (pass && size > little * all) fastest = fmax(fastest, p->f_Hz[k]);
        }
    return 1 + ceil(fastest * end_s) + (in_plane > 0 ? in_plane : 0);
}

/* Share of what it lasts, at most: all that rings and all of the plane is an amplitude, fully reversed about what there is
   at rest, in every cycle of the scene, and behind it falls by what the material's loss factor takes, pi times that a swing;
   0: nothing is repeated, or no life is known */
static fw_status lasted(fw_arena *arena, const both *is, const fw_verdict_variant_verdict *v, int k,
                        const fw_device_scene *s, const double (*wrench)[3], double in,
                        double across, double *share) {
    const fw_mechanism *m = v->mechanism;
    const fw_mechanism_hinge *h = &m->hinge[k];
    const fw_device *d = m->device;
    const double E = m->variant->material.youngs.value, more = 1 + is->rigid.error;
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&h->limits);
    double rest[2];
    *share = 0;
    if (!(d->limits.cycles > 0) || !h->limits.life.known) return FW_OK;
    FW_TRY(fw_flexure_across_strain(arena, &h->input, &h->closed_form, wrench, 1, rest));
    const double allowed = limit ? limit->allowable_Pa : m->variant->material.strength.value;
    const double amplitude_Pa = in * allowed / d->safety_factor + (across - rest[1]) * more * E;
    const fw_quantity *loss = &m->variant->material.loss;
    const double mean_Pa = rest[1] * more * E, eta = loss->unknown ? 0 : loss->value;
    const fw_verdict_after after = {.rest = amplitude_Pa > 0 ? mean_Pa / amplitude_Pa : 0,
                                    .ring = {{1, FW_PI * fmax(eta, 0), 1}},
                                    .n = 1};
    fw_maths_cycle *all = fw_arena_array(arena, fw_maths_cycle, 1 + FW_RING_BLOCKS);
    FW_NEED(all);
    all[0] = (fw_maths_cycle){2 * amplitude_Pa, mean_Pa,
                              cycles_of(is, wrench, s->duration_s, v->hinge[k].cycles)};
    const size_t n = 1 + fw_verdict_rung_out(&after, 0, amplitude_Pa, all + 1);
    *share = d->safety_factor *
             fw_verdict_fatigue_utilisation(&h->limits.life, all, n, d->limits.cycles);
    return FW_OK;
}

static fw_status tell_lasted(fw_arena *arena, const fw_device_scene *s, double share,
                             const char *hinge, fw_verdict_variant_verdict *v,
                             fw_verdict_across *to) {
    char used[32], times[32];
    if (!(share > 1) || to->strained > 1) return FW_OK;
    to->decision = fw_verdict_worse(to->decision, FW_INCONCLUSIVE);
    return fw_verdict_scene_reason(
        v, s, 637, FW_INCONCLUSIVE, 0.95 / share,
        fw_arena_printf(arena,
                        "%s%s is not known to last %s repetitions of %s%s, which bends it across "
                        "the plane, too: it uses up to %s %% of its fatigue limit there, with what "
                        "rings on where the scene ends; a thicker layer, shorter or wider "
                        "flexures, or a weaker shock relieve it",
                        FW_NAMED("hinge", hinge),
                        fw_number_text(times, sizeof times, v->mechanism->device->limits.cycles, 3),
                        FW_NAMED("scene", s->name),
                        (fw_percent_text(used, sizeof used, share), used)));
}

/* strain that is borne once, not the one that the cycles of a scene leave */
static double once_limit(const fw_mechanism *m, const fw_mechanism_hinge *h) {
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&h->limits);
    const fw_device_material *of = &m->variant->material;
    return (limit ? limit->allowable_Pa : of->strength.value) / m->device->safety_factor /
           of->youngs.value;
}

static fw_status judge_strain(fw_arena *arena, const both *is, fw_verdict_variant_verdict *v,
                              fw_verdict_across *to) {
    const fw_mechanism *m = v->mechanism;
    const fw_device_scene *s = &m->device->scene[to->scene_index];
    const int n = 1 + is->rigid.n;
    fw_geometry_vec2 middle;
    double(*wrench)[3] = fw_arena_alloc(arena, (size_t)n, sizeof *wrench), worst_in = 0, dynamic,
    *weighed, far_m;
    const double curvature = fw_mechanism_plates_curvature(m, s),
                 left = fmax(1 - fw_verdict_across_softened(to), 1e-9);
    double lasts = 0;
    const char *fatigued = NULL;
    FW_NEED(wrench);
    FW_NEED(weighed = fw_arena_array(arena, double, (size_t)m->nhinge));
    FW_TRY(fw_verdict_flexures_across(arena, v, &is->rigid, to->scene_index, weighed, &far_m));
    load_scene(is, &is->rigid, s, left, curvature, true, &middle, &dynamic);
    to->strained = to->strained_sure = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        const double limit = once_limit(m, h), in = in_the_plane(v, k, to->scene_index);
        double strain[2], share;
        put_wrenches(is, k, curvature, wrench);
        FW_TRY(fw_flexure_across_strain(arena, &h->input, &h->closed_form,
                                        (const double(*)[3])wrench, n, strain));
        strain[1] += weighed[k];
        if (!(limit > 0)) continue;
        FW_TRY(
            lasted(arena, is, v, k, s, (const double(*)[3])wrench, in, strain[1] / left, &share));
        if (share > lasts || isnan(share))
            lasts = isnan(share) ? (double)INFINITY : share, fatigued = m->pin[h->pin].id;
        const double most = in + strain[1] * (1 + is->rigid.error) / (left * limit);
        const double sure = strain[0] / (1 + is->rigid.error) / limit;
        to->strained_sure = fmax(to->strained_sure, sure);
        if (most <= to->strained) continue;
        /* a law that nothing bounds: inf, or inf times what does not move */
        to->strained = isnan(most) ? (double)INFINITY : most, worst_in = in;
        to->strained_hinge = m->pin[h->pin].id;
    }
    FW_TRY(fw_verdict_across_strained(arena, s, worst_in, v, to));
    return tell_lasted(arena, s, lasts, fatigued, v, to);
}

/* ---- required poses ---- */

/* The least factor over the corners of the required boxes by every grip and over the worst poses. Between them forces go
   nearly in proportion to the pose, and what tips is convex in them; a tenth is left for what does not. */
static fw_status required_factor(fw_arena *arena, const both *is,
                                 const fw_verdict_variant_verdict *v, double *factor) {
    const fw_mechanism *m = v->mechanism;
    const size_t n = (size_t)m->nhinge, bodies = (size_t)m->nbody;
    double tips, *far, *forces, *force_N;
    int hinge, count;
    FW_NEED(forces = fw_arena_array(arena, double, 5 * n));
    FW_NEED(far = fw_arena_array(arena, double, 2 * bodies));
    /* what acts beside the mass centre may act anywhere */
    for (int i = 0; i < m->device->nscene; i++) {
        fw_verdict_across_acting(m, &m->device->scene[i], far + bodies);
        for (size_t b = 0; b < bodies; b++)
            if (far[bodies + b] != 0) far[b] = (double)NAN;
    }
    for (int k = 0; k < m->nhinge; k++) {
        const int j = m->hinge[k].pin;
        if (j >= FW_SIX) continue;
        double *most = forces + 2 * n + 3 * (size_t)k; /* whichever way it acts */
        most[0] = most[2] = pow(v->workspace.load[j].most_N, 2);
        most[1] = m->pin[j].stiffness_Nm_per_rad * fabs(v->workspace.peak[j].angle_rad) +
                  v->workspace.load[j].rub_Nm;
    }
    fw_mechanism_plates_pressed pressed = {forces, forces + 2 * n, far, 1 / (1 - is->rigid.error)};
    *factor = HUGE_VAL;
    for (int i = 0; i < m->device->nworkspace; i++) {
        const fw_device_workspace_box *box = &m->device->workspace[i];
        const double low[3] = {box->x_min_m, box->y_min_m, box->phi_min_rad},
                     high[3] = {box->x_max_m, box->y_max_m, box->phi_max_rad};
        if (!v->workspace.asked[i] || !v->workspace.strain[i].hold) continue;
        FW_TRY(fw_workspace_forces(arena, &v->workspace.strain[i], low, high, &force_N, &count));
        for (int c = 0; c < count; c++) {
            for (int k = 0; k < 2 * m->nhinge; k++)
                forces[k] = m->hinge[k / 2].pin < FW_SIX
                                ? 1.1 * force_N[12 * c + 2 * m->hinge[k / 2].pin + k % 2]
                                : 0;
            FW_TRY(fw_mechanism_plates_buckling(arena, is->tips.why ? &is->rigid : &is->tips,
                                                &pressed, &tips, &hinge));
            *factor = fmin(*factor, tips);
            pressed.enough = fmin(pressed.enough, *factor); /* of the others: do they tip before? */
        }
    }
    *factor *= 1 - is->rigid.error;
    return FW_OK;
}

static fw_status judge_required(fw_arena *arena, const both *is, fw_verdict_variant_verdict *v) {
    double sure;
    char by[32];
    if (!v->workspace.required || !v->workspace.reachable || v->corner) return FW_OK;
    FW_TRY(required_factor(arena, is, v, &sure));
    if (!(sure < 1)) return FW_OK;
    FW_TRY(fw_verdict_workspace_reason(
        v, 647, FW_INCONCLUSIVE,
        fw_arena_printf(
            arena,
            "what holds the required poses may tip the device out of its plane: %s%s%s; a thicker "
            "layer or a smaller box keep it flat",
            sure > 0 ? "it is sure to stay flat up to " : "how far it stays flat is not known",
            sure > 0 ? fw_number_text(by, sizeof by, sure, 2) : "",
            sure > 0 ? " times that" : "")));
    v->reason[v->nreason - 1].keep = fmin(fmax(sure, 1e-3), 0.99);
    v->reason[v->nreason - 1].either_way = true;
    return FW_OK;
}

fw_status fw_verdict_out_of_plane_strain(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    for (int i = 0; o && !o->why && i < o->nscene; i++) {
        const fw_device_scene *s = &v->mechanism->device->scene[o->scene[i].scene_index];
        if (!fw_mechanism_plates_asked(s)) continue;
        FW_TRY(judge_strain(arena, o->plates, v, &o->scene[i]));
    }
    if (o && o->plates->rigid.n > 0) return judge_required(arena, o->plates, v);
    return FW_OK;
}

static fw_status put_stiffness(fw_arena *arena, const both *is, fw_verdict_out_of_plane *out) {
    fw_mechanism_plates_stiff stiff;
    FW_TRY(fw_mechanism_plates_stiffness(arena, &is->rigid, &stiff));
    out->body = fw_text_name(is->rigid.mechanism->body[stiff.body].id);
    out->across_N_per_m = stiff.across_N_per_m;
    out->ratio = stiff.across_N_per_m / stiff.in_N_per_m;
    return FW_OK;
}

/* how far it comes down where it lies flat on a table */
static double by_weight(const both *is, const fw_mechanism_plates *p) {
    fw_mechanism_plates_weight(p, -FW_STANDARD_GRAVITY_m_per_s2, is->f);
    fw_mechanism_plates_answer(p, is->f, is->x);
    return is->hangs * FW_STANDARD_GRAVITY_m_per_s2 -
           fw_mechanism_plates_reached(p, is->x, NULL, 0, flat_middle).lowest_m;
}

static void put_weight(const both *is, fw_verdict_out_of_plane *out) {
    out->weight_m = by_weight(is, &is->rigid);
    out->weight_most_m =
        (is->soft.why ? out->weight_m : fmax(out->weight_m, by_weight(is, &is->soft))) *
        (1 + out->error);
}

/* A scene that says nothing of weight leaves open which way is down. Where the device would lie on its carrier by its weight
   alone, or by that on top of what the scene does, it is no answer that nobody asked: undecided until it is said. */
static fw_status judge_unsaid(fw_arena *arena, const fw_device_scene *s,
                              const fw_verdict_out_of_plane *out, fw_verdict_variant_verdict *v,
                              fw_verdict_across *to) {
    const fw_mechanism_below *below = &v->mechanism->variant->below;
    const double scene_m = fmax(0, -to->lowest_m), down_m = out->weight_most_m + scene_m;
    char down[32], own[32];
    const char *rest = "by its weight";
    if (s->gravity || !below->known || below->open || !(down_m > below->low_m)) return FW_OK;
    if (to->decision == FW_REJECT || (to->asked && !isfinite(down_m))) return FW_OK;
    /* it has been said of the scene alone */
    if (scene_m > below->low_m && !(out->weight_most_m > below->low_m)) return FW_OK;
    to->decision = FW_INCONCLUSIVE;
    if (scene_m > 0)
        FW_NEED(rest = fw_arena_printf(
                    arena, "by what shakes it there and its weight, %s um by that alone",
                    fw_number_text(own, sizeof own, 1e6 * out->weight_most_m, 3)));
    return fw_verdict_scene_reason(
        v, s, 673, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
        fw_arena_printf(
            arena,
            "where it lies flat the device comes down by up to %s um %s, and below it are %s: it "
            "may lie on its carrier in %s%s, which does not say how it is held; state <gravity "
            "gz=\"-9.81 m/s^2\"/> there, or gy where it stands on edge",
            fw_number_text(down, sizeof down, 1e6 * down_m, 3), rest,
            what_is_below(arena, below, false), FW_NAMED("scene", s->name)));
}

fw_status fw_verdict_out_of_plane_judge(fw_arena *arena, const fw_mechanism *m, bool brief,
                                        bool lean, fw_diags *diags, fw_verdict_variant_verdict *v) {
    const fw_device *d = m->device;
    both *is;
    fw_verdict_out_of_plane *out;
    const bool tips = !brief || v->tipping || fw_verdict_out_of_plane_asked(m);
    v->out_of_plane = NULL;
    if (!d || !m->layout) return FW_OK;
    if (!tips && !fw_verdict_out_of_plane_asked(m)) return FW_OK;
    FW_NEED(v->out_of_plane = out = fw_arena_one(arena, fw_verdict_out_of_plane));
    FW_NEED(out->plates = is = fw_arena_one(arena, both));
    FW_TRY(prepare(arena, m, v->arm, brief || lean, is));
    out->why = is->rigid.why;
    out->hung = is->hung;
    FW_NEED(out->scene = fw_arena_array(arena, fw_verdict_across, (size_t)d->nscene));
    if (!out->why) {
        out->error = is->rigid.error;
        FW_TRY(put_modes(arena, is, out));
        put_weight(is, out);
        if (!brief) FW_TRY(put_stiffness(arena, is, out));
    }
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *s = &d->scene[i];
        if (!fw_device_in_flow(s->flow, m->variant->flow)) continue;
        fw_verdict_across *to = &out->scene[out->nscene++];
        *to = (fw_verdict_across){.scene = s->name,
                                  .scene_index = i,
                                  .tips = (double)NAN,
                                  .strained = (double)NAN,
                                  .strained_sure = (double)NAN};
        if (out->why && (s->gz_m_per_s2 != 0 || fw_mechanism_plates_shaken(s)))
            FW_TRY(fw_verdict_scene_reason(
                v, s, 581, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
                fw_arena_printf(arena,
                                "%s%s acts across the plane, and what the device does out of "
                                "its plane is not known: %s",
                                FW_NAMED("scene", s->name), out->why)));
        if (tips && is->rigid.n > 0 && fw_verdict_stands_still(v, i))
            to->tips = HUGE_VAL; /* what forces are left are round-off */
        else if (tips && is->rigid.n > 0)
            FW_TRY(fw_verdict_across_tipping(arena, is->tips.why ? &is->rigid : &is->tips, s,
                                             is->rigid.error, v, to));
        if (out->why) continue;
        if (fw_mechanism_plates_asked(s)) FW_TRY(judge_sag(arena, is, s, v, to));
        FW_TRY(judge_unsaid(arena, s, out, v, to));
        if (!brief && s->ncomb > 0 && fw_effects_levitation_may_be(m))
            FW_TRY(warn_of_lift(is, s, diags, v, to));
    }
    return FW_OK;
}

/* It is most of what a verdict costs out of the plane. Where nobody reads it, it still has a say by weight over a carrier, and where
   scenes are shaken or weigh in the plane. */
fw_status fw_verdict_hung_says(fw_arena *arena, const fw_mechanism *m, bool *says) {
    const fw_device *d = m->device;
    *says = m->variant->below.known && !m->variant->below.open;
    for (int i = 0; i < d->nscene && !*says; i++) {
        const fw_device_scene *s = &d->scene[i];
        if (!fw_device_in_flow(s->flow, m->variant->flow)) continue;
        *says = s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0 || s->nbase > 0;
        if (!*says) FW_TRY(fw_verdict_is_shaken(arena, m, i, says));
    }
    return FW_OK;
}
