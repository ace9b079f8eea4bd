/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Does the liquid that a device is dried from pull it down to its carrier, or one wall to another, and does it come free
   again? Bodies are plates that are rigid; with what they may give at most (body_arms.c) the lower ends of the numbers
   hold. Theory: docs/theory/stiction.md. Test: test_stiction.py */
#include "base/constants.h"
#include "effects/effects.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <string.h>

typedef struct device {
    fw_arena *arena;
    const fw_mechanism *m;
    const fw_mechanism_drying *drying;
    fw_mechanism_plates rigid, soft;
    double *across[2], *beside, *firm; /* compliances: rigid, soft; in the plane, soft, rigid */
    bool held;                         /* in the plane */
    double down_m, up_m; /* what weight and stress do at rest across the plane, at most */
    double *alone_N_per_m, plates_N_per_m; /* (nbody) in the plane, each rigid; across it, all */
    const fw_verdict_hung *hung;           /* (nbody) */
    fw_mechanism_walls walls;
} device;

static const double wall_enough_N_per_m = 3; /* 20 times that of water: not known any closer */
/* a crystal along other directions than the closed form's, shear: a strip beside a wall is known to */
static const double strip_error = 0.2;
static const double touch_share = 0.02; /* of a gap: nearer is a touch; less of it is not told */

static const char *body_name(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? "what stands" : fw_text_name(m->body[body].id);
}

static fw_mechanism_plates *soft_of(device *d) {
    return d->soft.why ? &d->rigid : &d->soft;
}

/* ---- to the carrier ---- */

static void keep_lower(fw_verdict_pull *to, double tension, const char *a, const char *b) {
    if (tension >= to->tension_N_per_m[0]) return;
    to->tension_N_per_m[0] = tension;
    to->a = a, to->b = b;
}

static void strips_below(const device *d, double gap_m, fw_verdict_pull *to) {
    const fw_mechanism *m = d->m;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_plate_hinge *h = &d->rigid.hinge[k];
        double w = m->hinge[k].input.width_m, more = fmax(gap_m, m->variant->thickness_m) / w;
        double s =
            fw_mechanism_strip_pull_in(h->bend_Nm2, h->length_m, w, gap_m, more) / (1 + h->error);
        keep_lower(to, 0.5 * s, m->pin[m->hinge[k].pin].id, NULL);
    }
}

static fw_status hung_below(const device *d, double low_m, fw_verdict_pull *to) {
    for (int b = 0; b < d->m->nbody; b++) {
        const char *part = body_name(d->m, b);
        const double both = fw_verdict_hung_pulled(&d->hung[b], low_m, d->down_m, d->rigid.error,
                                                   d->plates_N_per_m);
        if (both < 0.5 * d->plates_N_per_m)
            FW_NEED(part = fw_arena_printf(d->arena, "what hangs over of %s", part));
        keep_lower(to, both, part, NULL);
    }
    return FW_OK;
}

/* one state of rest: low gaps with what bodies give at most, high ones with rigid ones */
static fw_status pull_at_rest(device *d, double curvature_per_m, fw_mechanism_face *face, int n,
                              fw_verdict_pull *to, int *body) {
    const fw_mechanism_below *below = &d->m->variant->below;
    const double more = 1 + d->rigid.error, low = fmax(below->low_m, 1e-9);
    double s, down, up;
    int first;
    FW_TRY(fw_mechanism_faces_rest(d->arena, soft_of(d), curvature_per_m, low, more, face, n, &down,
                                   &up));
    FW_TRY(fw_mechanism_pull_in(d->arena, d->across[1], d->rigid.n, face, n, FW_PULL_EACH, HUGE_VAL,
                                &s, &first));
    const int lost = first == FW_NONE ? FW_GROUND : face[first].body[0];
    if (0.5 * s / more < to->tension_N_per_m[0]) *body = lost;
    d->plates_N_per_m = fmin(d->plates_N_per_m, 0.5 * s / more);
    keep_lower(to, 0.5 * s / more, body_name(d->m, lost), NULL);
    strips_below(d, fmax(low - down, 1e-9), to);
    d->down_m = fmax(d->down_m, down);
    FW_TRY(fw_mechanism_faces_rest(d->arena, &d->rigid, curvature_per_m, below->high_m, more, face,
                                   n, &down, &up));
    d->up_m = fmax(d->up_m, up);
    FW_TRY(fw_mechanism_pull_in(d->arena, d->across[0], d->rigid.n, face, n, FW_PULL_WIDEST,
                                HUGE_VAL, &s, &first));
    to->tension_N_per_m[1] = fmax(to->tension_N_per_m[1], 0.5 * s * more);
    return FW_OK;
}

/* by its weight alone, and with each gradient of stress that a scene has */
static fw_status pull_below(device *d, fw_verdict_pull *to) {
    const fw_mechanism *m = d->m;
    const fw_mechanism_below *below = &m->variant->below;
    fw_mechanism_face *face;
    int n, body = FW_GROUND;
    double last = 0;
    if (!below->known || below->open) return FW_OK;
    to->known = true;
    to->gap_m = below->m;
    to->tension_N_per_m[1] = 0;
    d->plates_N_per_m = HUGE_VAL;
    FW_TRY(fw_mechanism_faces_below(d->arena, soft_of(d), fmax(below->low_m, 1e-9), &face, &n));
    FW_TRY(pull_at_rest(d, 0, face, n, to, &body));
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_device_scene *s = &m->device->scene[i];
        const double curvature = fw_mechanism_plates_curvature(m, s);
        if (curvature == last || !fw_device_in_flow(s->flow, m->variant->flow)) continue;
        FW_TRY(pull_at_rest(d, curvature, face, n, to, &body));
        last = curvature;
    }
    FW_TRY(hung_below(d, fmax(below->low_m, 1e-9), to));
    to->tension_N_per_m[1] = fmax(to->tension_N_per_m[1], to->tension_N_per_m[0]);
    to->lowered_m = d->down_m;
    if (body != FW_GROUND)
        to->stiffness_N_per_m =
            1 / d->across[0][(size_t)(3 * body) * (size_t)d->rigid.n + (size_t)(3 * body)];
    return FW_OK;
}

/* ---- wall to wall ---- */

enum { WAYS = 8 };

/* what is wet on one side of a body alone pulls it there: all that it faces in one half of all directions */
static int on_one_side(const fw_mechanism_face *face, int n, int body, int way,
                       fw_mechanism_face *out) {
    double angle = way * FW_TURN / WAYS, c = cos(angle), s = sin(angle);
    int found = 0;
    for (int i = 0; i < n; i++) {
        int side = face[i].body[0] == body ? 0 : face[i].body[1] == body ? 1 : FW_NONE;
        double towards = c * face[i].normal.x + s * face[i].normal.y;
        if (side == FW_NONE || !((side ? -towards : towards) > 1e-9)) continue;
        out[found++] = face[i];
    }
    return found;
}

static fw_status pull_body(device *d, const fw_mechanism_face *face, int n, int body,
                           fw_mechanism_face *room, fw_verdict_pull *to) {
    for (int way = 0; way < WAYS; way++) {
        double s;
        int first, found = on_one_side(face, n, body, way, room);
        if (found == 0) continue;
        double enough = fmin(2 * wall_enough_N_per_m, 2 * to->tension_N_per_m[0]);
        FW_TRY(fw_mechanism_pull_in(d->arena, d->beside, d->rigid.n, room, found, FW_PULL_EACH,
                                    enough, &s, &first));
        const fw_mechanism_face *at = first == FW_NONE ? NULL : &room[first];
        if (!(0.5 * s < to->tension_N_per_m[0]) || !at) continue;
        keep_lower(to, 0.5 * s, body_name(d->m, at->body[0]), body_name(d->m, at->body[1]));
        to->gap_m = at->gap_m;
    }
    return FW_OK;
}

static void strips_beside(const device *d, const fw_mechanism_strip_beside *strip,
                          fw_verdict_pull *to) {
    const fw_mechanism *m = d->m;
    const double depth = m->variant->thickness_m, E = m->variant->material.youngs.value;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_strip_beside *s = &strip[k];
        double w = m->hinge[k].input.width_m, bend = E * depth * w * w * w / 12;
        if (!isfinite(s->gap_m) || !(w > 0)) continue;
        double tension = 0.5 *
                         fw_mechanism_strip_pull_in(bend, d->rigid.hinge[k].length_m, depth,
                                                    s->gap_m, s->gap_m / depth) /
                         (1 + strip_error);
        if (tension < to->tension_N_per_m[0]) to->gap_m = s->gap_m;
        keep_lower(to, tension, m->pin[m->hinge[k].pin].id,
                   s->piece == FW_NONE ? "a wall" : m->layout->piece[s->piece].label);
    }
}

/* what a body bears as a rigid one, up to `enough` */
static fw_status bears_alone(device *d, const fw_mechanism_face *face, int n, int body,
                             fw_mechanism_face *room, double enough_N_per_m) {
    double *to = &d->alone_N_per_m[body];
    if (*to > 0) return FW_OK; /* it is known */
    *to = enough_N_per_m;
    for (int way = 0; way < WAYS; way++) {
        double s;
        int first, found = on_one_side(face, n, body, way, room);
        if (found == 0) continue;
        FW_TRY(fw_mechanism_pull_in(d->arena, d->beside, d->rigid.n, room, found, FW_PULL_EACH,
                                    2 * *to, &s, &first));
        *to = fmin(*to, 0.5 * s);
    }
    return FW_OK;
}

/* What is bent goes with what turns its bodies: shares of the tension add up at most (Dunkerley). What bears more than ten
   times as much as what gives way first is left out; bodies bear at least what is known before. */
static fw_status limbs_beside(device *d, const fw_mechanism_face *face, int n,
                              fw_mechanism_face *room, fw_verdict_pull *to) {
    const fw_mechanism *m = d->m;
    const double more = 1 + strip_error, times = 10, least = to->tension_N_per_m[0],
                 enough = times * fmin(wall_enough_N_per_m, least);
    fw_mechanism_limb *limb;
    int nlimb; /* the least first */
    FW_TRY(fw_mechanism_limbs_beside(m, &d->walls, 2 * more * enough, &limb, &nlimb));
    for (int i = 0; i < nlimb; i++) {
        double share = 2 * more / limb[i].tension_N_per_m, alone = 0;
        if (!(1 / (share + 1 / least) < to->tension_N_per_m[0])) break;
        for (int k = 0; k < 2; k++) {
            const int body = limb[i].body[k];
            if (body == FW_GROUND || limb[i].body[0] == limb[i].body[1]) continue;
            FW_TRY(bears_alone(d, face, n, body, room, enough));
            alone = fmax(alone, 1 / d->alone_N_per_m[body]);
        }
        if (!(1 / (share + alone) < to->tension_N_per_m[0])) continue;
        const char *own = m->layout->piece[limb[i].piece[0]].label,
                   *other = m->layout->piece[limb[i].piece[1]].label,
                   *part = fw_verdict_limb_text(d->arena, m->layout, &limb[i]);
        keep_lower(to, 1 / (share + alone), part,
                   strcmp(own, other) ? other : "another part of it");
        FW_NEED(part);
        to->gap_m = limb[i].gap_m;
    }
    return FW_OK;
}

static fw_status pull_beside(device *d, fw_verdict_pull *to) {
    const fw_mechanism *m = d->m;
    fw_mechanism_face *face, *room;
    fw_mechanism_strip_beside *strip;
    int n;
    if (!d->held || !m->layout || !m->layout->drawn) return FW_OK;
    FW_NEED(d->alone_N_per_m = fw_arena_array(d->arena, double, (size_t)m->nbody));
    FW_NEED(strip = fw_arena_array(d->arena, fw_mechanism_strip_beside, (size_t)m->nhinge));
    FW_TRY(fw_mechanism_walls_take(d->arena, m, &d->walls));
    FW_TRY(fw_mechanism_faces_beside(d->arena, m, &d->walls, &face, &n, strip));
    FW_NEED(room = fw_arena_array(d->arena, fw_mechanism_face, (size_t)n));
    to->known = true;
    strips_beside(d, strip, to);
    for (int b = 0; b < m->nbody; b++)
        FW_TRY(pull_body(d, face, n, b, room, to));
    return limbs_beside(d, face, n, room, to);
}

/* ---- does it come free? ---- */

static bool invert3(const double *c, int n, int body, double k[3][3]) {
    double a[3][3], det;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a[i][j] = c[(size_t)(3 * body + i) * (size_t)n + (size_t)(3 * body + j)];
            k[i][j] = i == j;
        }
    return fw_maths_solve3((const double(*)[3])a, 3, k, &det);
}

/* J: the least that is stored where any corner of the boxes of a body touches */
static double corner_energy(const device *d, const double *c, int body, double gap_m) {
    const fw_mechanism *m = d->m;
    const size_t n = (size_t)d->rigid.n, at = 3 * (size_t)body;
    double most = c[at * n + at];
    for (int i = 0; m->layout && i < m->layout->npiece; i++) {
        const fw_layout_piece *p = &m->layout->piece[i];
        if (p->body != body || !fw_layout_is_wall(p)) continue;
        fw_geometry_box box = fw_geometry_contour_box(&p->contour);
        for (int q = 0; q < 4; q++) {
            const double b[3] = {1, (q / 2 ? box.y1 : box.y0) - m->drawn[body].y_m,
                                 m->drawn[body].x_m - (q % 2 ? box.x1 : box.x0)};
            double give = 0;
            for (size_t k = 0; k < 9; k++)
                give += b[k / 3] * c[(at + k / 3) * n + at + k % 3] * b[k % 3];
            most = fmax(most, give);
        }
    }
    return 0.5 * gap_m * gap_m / (most + d->hung[body].tip_m_per_N);
}

/* Peel numbers: the least of all bodies. Low: what the softest corner stores where it alone touches, over the largest
   adhesion of all that moves; high: what the stiffest plates store where one lies flat, over the least adhesion of
   it. Strips clamped at both ends have 307.2 EI g^2/(w W L^4), after Mastrangelo and Hsu. */
static void peel(const device *d, fw_verdict_stiction *to) {
    const fw_mechanism *m = d->m;
    const fw_mechanism_below *below = &m->variant->below;
    const double low = fmax(below->low_m - d->down_m, 0), high = below->high_m + d->up_m;
    double all = 0, more = 1 + d->rigid.error;
    to->peel[0] = to->peel[1] = HUGE_VAL;
    for (int b = 0; b < m->nbody; b++)
        all += m->shape[b].area_m2;
    for (int b = 0; b < m->nbody; b++) {
        double k[3][3], area = m->shape[b].area_m2;
        if (!invert3(d->across[0], d->rigid.n, b, k)) continue;
        double flat = 0.5 * k[0][0] * below->m * below->m / area;
        double most = flat * more * high * high / (below->m * below->m);
        double least = corner_energy(d, d->across[1], b, low) / (more * all);
        if (!(flat >= to->adhesion_J_per_m2))
            to->adhesion_J_per_m2 = flat, to->peeled = body_name(m, b);
        to->peel[0] = fmin(to->peel[0], least / d->drying->adhesion_high);
        to->peel[1] = fmin(to->peel[1], most / d->drying->adhesion_low);
    }
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_plate_hinge *h = &d->rigid.hinge[k];
        double w = m->hinge[k].input.width_m, l2 = h->length_m * h->length_m;
        double strip = 307.2 * h->bend_Nm2 * low * low / (w * l2 * l2);
        to->peel[0] = fmin(to->peel[0], strip / (1 + h->error) / d->drying->adhesion_high);
    }
}

static fw_status prepare(device *d, const fw_verdict_arm *arm) {
    const fw_mechanism *m = d->m;
    const double stiff = m->variant->material.youngs.value * m->variant->thickness_m;
    double *give;
    fw_verdict_arm *shared;
    FW_TRY(fw_mechanism_plates_new(d->arena, m, NULL, &d->rigid));
    if (d->rigid.why) return FW_OK;
    FW_TRY(fw_verdict_shared_arms(d->arena, m, arm, &shared));
    FW_TRY(fw_verdict_soft_plates(d->arena, m, shared, &d->soft));
    FW_TRY(fw_mechanism_plates_across(d->arena, &d->rigid, &d->across[0]));
    FW_TRY(fw_mechanism_plates_across(d->arena, soft_of(d), &d->across[1]));
    FW_NEED(give = fw_arena_array(d->arena, double, 9 * (size_t)m->nhinge));
    for (int k = 0; k < 2 * m->nhinge; k++) {
        static const int at[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
        for (int i = 0; arm && arm[k].known && i < 9; i++)
            give[9 * (k / 2) + i] += arm[k].give[at[i]] / stiff;
    }
    return fw_mechanism_plates_beside(d->arena, &d->rigid, give, &d->beside, &d->held);
}

/* ---- surfaces that a scene closes ---- */

static bool closes(const fw_dynamics_motion *motion) {
    for (int i = 0; motion && i < motion->ledger.count; i++)
        if (strcmp(motion->ledger.item[i].id, "contact") == 0) return motion->ledger.item[i].active;
    return false;
}

static fw_status say(const fw_mechanism *m, const char *scene, int number,
                     fw_verdict_decision decision, const char *text,
                     fw_verdict_variant_verdict *v) {
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = scene,
                                                  .flow = m->variant->flow,
                                                  .number = number,
                                                  .decision = decision,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .not_by_loads = true,
                                                  .text = text};
    return FW_OK;
}

/* ---- contacts between two bodies ---- */

static double form(const double *c, int n, const double *b) {
    double sum = 0;
    for (int k = 0; k < n * n; k++)
        sum += b[k / n] * c[k] * b[k % n];
    return sum;
}

/* What flexures give back where the two just touch: the gap over the compliance b' C b along its slope b in all
   coordinates in the plane, with what bodies may give at most and with rigid ones, times what the flexures' stiffness may be off by */
static fw_status give_back(device *d, const fw_device_contact_use *use, const fw_verdict_arm *arm,
                           fw_verdict_stuck *one) {
    double *slope;
    bool held;
    if (!d->beside && !d->rigid.why) FW_TRY(prepare(d, arm));
    one->why = d->rigid.why             ? d->rigid.why
               : !d->held || !d->beside ? "flexures alone do not hold the device in the plane"
                                        : NULL;
    if (one->why) return FW_OK;
    FW_NEED(slope = fw_arena_array(d->arena, double, (size_t)d->rigid.n));
    if (!d->firm) FW_TRY(fw_mechanism_plates_beside(d->arena, &d->rigid, NULL, &d->firm, &held));
    const double gap = fw_effects_contact_open(d->m, use, NULL, slope), more = 1 + d->rigid.error;
    one->opens_N[0] = gap / (form(d->beside, d->rigid.n, slope) * more);
    one->opens_N[1] = gap / form(d->firm, d->rigid.n, slope) * more;
    return FW_OK;
}

/* rejected only where the scene ends pressed and the least adhesion holds more than the most that opens it */
static fw_status judge_touch(device *d, const fw_device_scene *s, const fw_verdict_touch *t,
                             const fw_verdict_arm *arm, fw_verdict_stuck *one) {
    const fw_mechanism *m = d->m;
    const fw_device_contact_use *use = t->use;
    const fw_effect_case of = {.arena = d->arena, .mechanism = m, .scene = s};
    const bool drawn = fw_verdict_contact_drawn(m->device, m->layout, use);
    *one = (fw_verdict_stuck){.scene = s->name,
                              .contact = fw_text_name(use->id),
                              .holds_N = {(double)NAN, (double)NAN},
                              .opens_N = {(double)NAN, (double)NAN},
                              .radius_m = fw_effects_contact_radius(use),
                              .decision = FW_INCONCLUSIVE};
    FW_TRY(give_back(d, use, arm, one));
    if (!drawn && use->undrawn == FW_UNDRAWN_PLACED) {
        one->why = "what is put there has surfaces that the flow knows nothing of";
        one->decision = FW_ACCEPT;
        return FW_OK;
    }
    const fw_effects_adhered low = fw_effects_adhesion_of(&of, use, d->drying->adhesion_low),
                             high = fw_effects_adhesion_of(&of, use, d->drying->adhesion_high);
    if (high.known) one->holds_N[0] = low.holds_N, one->holds_N[1] = high.holds_N;
    if (!high.known) one->why = "no radius is known where it touches, flat on flat or at a corner";
    if (one->why) return FW_OK;
    const bool sure = t->last_m <= 0 && use->face && (drawn || use->undrawn == FW_UNDRAWN_ETCHED);
    one->decision = one->holds_N[1] <= one->opens_N[0]          ? FW_ACCEPT
                    : sure && one->holds_N[0] > one->opens_N[1] ? FW_REJECT
                                                                : FW_INCONCLUSIVE;
    return FW_OK;
}

static fw_status say_stuck(device *d, const fw_verdict_stuck *s, fw_verdict_variant_verdict *v) {
    if (s->decision == FW_ACCEPT) return FW_OK;
    return say(d->m, s->scene,
               s->hinge ? 586
               : s->why ? 671
                        : 670,
               s->decision, fw_verdict_stuck_text(d->arena, s, d->drying->adhesion_high), v);
}

static fw_status stuck(device *d, fw_verdict_stiction *to, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = d->m;
    size_t n = 0;
    const bool known = d->drying->adhesion_words && !m->variant->material.youngs.unknown;
    for (int i = 0; i < m->device->nscene; i++)
        n += (size_t)m->device->scene[i].ncontact;
    FW_NEED(to->stuck = fw_arena_array(d->arena, fw_verdict_stuck, n));
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_device_scene *s = &m->device->scene[i];
        const fw_effect_case of = {.arena = d->arena, .mechanism = m, .scene = s};
        for (int k = 0; v->motion && closes(v->motion[i]) && k < s->ncontact; k++) {
            const fw_verdict_strain_monitor *saw = v->motion[i]->observed;
            const fw_verdict_touch *t = saw && saw->touch ? &saw->touch[k] : NULL;
            const fw_device_contact_use *use = &s->contact[k];
            fw_verdict_stuck *one = &to->stuck[to->nstuck];
            if (use->joint == FW_NONE) {
                const double gap = fw_effects_contact_open(m, use, NULL, NULL);
                if (!known || !t || !(gap > 0) || t->least_m > touch_share * gap) continue;
                FW_TRY(judge_touch(d, s, t, v->arm, one));
                to->nstuck++;
                FW_TRY(say_stuck(d, one, v));
                continue;
            }
            const fw_effects_adhered a = fw_effects_adhesion_of(&of, use, d->drying->adhesion_high),
                                     b = fw_effects_adhesion_of(&of, use, d->drying->adhesion_low);
            if (!a.known) continue;
            *one =
                (fw_verdict_stuck){.scene = s->name,
                                   .hinge = m->pin[use->joint].id,
                                   .holds_N = {b.holds_N, a.holds_N},
                                   .opens_N = {a.opens_N, a.opens_N},
                                   .decision = a.holds_N > a.opens_N ? FW_INCONCLUSIVE : FW_ACCEPT};
            to->nstuck++;
            FW_TRY(say_stuck(d, one, v));
        }
    }
    return FW_OK;
}

static const char *remedy(fw_arena *arena, const fw_verdict_pull *p) {
    char most[32], by[32];
    return fw_arena_printf(
        arena,
        "dry it at the critical point, by sublimation or from a liquid of at most %s mN/m, or make "
        "what holds it shorter than %s of its length or thicker",
        fw_number_text(most, sizeof most, 1e3 * p->tension_N_per_m[0], 3),
        fw_number_text(by, sizeof by, pow(fmin(p->number[0], 1), 0.25), 2));
}

/* with the elastocapillary number of a way of drying: does what comes down stay there? */
static fw_verdict_decision pulled_down(const fw_verdict_stiction *to, const double number[2],
                                       const fw_mechanism_drying *drying) {
    const bool unknown = !drying->adhesion_words;
    if (!(number[0] < 1) || (!unknown && to->peel[0] > 1)) return FW_ACCEPT;
    return number[1] < 1 && !unknown && to->peel[1] < 1 && !to->tethered ? FW_REJECT
                                                                         : FW_INCONCLUSIVE;
}

static fw_status judge_below(fw_arena *arena, const fw_mechanism *m, fw_verdict_stiction *to,
                             fw_verdict_variant_verdict *v) {
    const fw_verdict_pull *p = &to->below;
    const bool unknown = !m->variant->drying.adhesion_words;
    const fw_verdict_decision found = pulled_down(to, p->number, &m->variant->drying);
    if (found == FW_ACCEPT) return FW_OK;
    const bool sure = found == FW_REJECT;
    const char *number = fw_verdict_range_words(arena, p->number),
               *peeled = fw_verdict_range_words(arena, to->peel), *help = remedy(arena, p);
    char gap[32], down[32];
    const char *lowered = "";
    if (p->lowered_m > touch_share * p->gap_m)
        FW_NEED(lowered =
                    fw_arena_printf(arena, " (at rest it is lowered into them by up to %s um)",
                                    fw_number_text(down, sizeof down, 1e6 * p->lowered_m, 3)));
    FW_NEED(number && peeled && help ? number : NULL);
    to->decision = found;
    return say(m, "as it dries", 583, to->decision,
               fw_arena_printf(arena,
                               "the liquid of %s pulls %s down to the carrier across %s um%s "
                               "(elastocapillary number %s, at least 1 "
                               "is wanted), where it %s (peel number %s); %s",
                               m->variant->drying.words, p->a ? p->a : "it",
                               fw_number_text(gap, sizeof gap, 1e6 * p->gap_m, 3), lowered, number,
                               sure ? "stays" : "may stay", unknown ? "not known" : peeled, help),
               v);
}

/* which walls are wet on one side alone is chance: a row that dries evenly may stand */
static fw_status judge_beside(fw_arena *arena, const fw_mechanism *m, fw_verdict_stiction *to,
                              fw_verdict_variant_verdict *v) {
    const fw_verdict_pull *p = &to->beside;
    if (!(p->number[0] < 1)) return FW_OK;
    const char *help = remedy(arena, p);
    char low[32], gap[32];
    FW_NEED(help);
    to->decision = fw_verdict_worse(to->decision, FW_INCONCLUSIVE);
    return say(m, "as it dries", 584, FW_INCONCLUSIVE,
               fw_arena_printf(
                   arena,
                   "the liquid of %s may pull %s and %s together across the gap of %s um between "
                   "them, where one side of it stays wet longer (elastocapillary number %s at "
                   "least, 1 is wanted); %s",
                   m->variant->drying.words, p->a, p->b,
                   fw_number_text(gap, sizeof gap, 1e6 * p->gap_m, 3),
                   fw_number_text(low, sizeof low, p->number[0], 3), help),
               v);
}

static fw_status judge_unknown(fw_arena *arena, const fw_mechanism *m, fw_verdict_stiction *to,
                               fw_verdict_variant_verdict *v) {
    const char *missing = to->why;
    if (!missing && !m->variant->below.known) missing = "no flow says how far its carrier is away";
    if (!missing || m->variant->drying.how != FW_DRIED_PULLED) return FW_OK;
    to->decision = FW_INCONCLUSIVE;
    return say(m, "as it dries", 585, FW_INCONCLUSIVE,
               fw_arena_printf(arena,
                               "%s: a meniscus passes over the device, and what that does to it is "
                               "not known: %s; dry it without one",
                               m->variant->drying.words, missing),
               v);
}

static fw_status judge_pulls(device *d, fw_verdict_stiction *to, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = d->m;
    to->tethered = m->layout && m->layout->ntether > 0;
    FW_TRY(prepare(d, v->arm));
    FW_TRY(fw_verdict_hung_of(d->arena, v, &d->hung));
    to->why = d->rigid.why;
    FW_TRY(judge_unknown(d->arena, m, to, v));
    if (to->why) return FW_OK;
    FW_TRY(pull_below(d, &to->below));
    FW_TRY(pull_beside(d, &to->beside));
    if (to->below.known && d->drying->adhesion_words) peel(d, to);
    /* what stress presses is softer across the plane, and is pulled and held more easily by as much */
    const double left = 1 - fw_verdict_across_stressed(v);
    to->below.tension_N_per_m[0] *= left, to->peel[0] *= left;
    fw_verdict_pull_number(d->drying, &to->below);
    fw_verdict_pull_number(d->drying, &to->beside);
    FW_TRY(judge_below(d->arena, m, to, v));
    return judge_beside(d->arena, m, to, v);
}

fw_status fw_verdict_stiction_judge(fw_arena *arena, const fw_mechanism *m, bool brief,
                                    fw_verdict_variant_verdict *v) {
    const fw_mechanism_drying *drying = &m->variant->drying;
    fw_verdict_stiction *to;
    v->stiction = NULL;
    bool dried = drying->how == FW_DRIED_PULLED || (drying->how == FW_DRIED_CALM && !brief);
    if (!m->device || drying->how == FW_DRIED_UNKNOWN) return FW_OK;
    FW_NEED(to = fw_arena_one(arena, fw_verdict_stiction));
    v->stiction = to;
    const fw_verdict_pull nothing = {.tension_N_per_m = {HUGE_VAL, HUGE_VAL},
                                     .number = {HUGE_VAL, HUGE_VAL},
                                     .stiffness_N_per_m = (double)NAN};
    *to = (fw_verdict_stiction){.below = nothing,
                                .beside = nothing,
                                .peel = {(double)NAN, (double)NAN},
                                .adhesion_J_per_m2 = (double)NAN,
                                .decision = FW_ACCEPT};
    device d = {.arena = arena, .m = m, .drying = drying};
    if (dried && m->layout) FW_TRY(judge_pulls(&d, to, v));
    FW_TRY(stuck(&d, to, v));
    for (int i = 0; i < to->nstuck; i++)
        to->decision = fw_verdict_worse(to->decision, to->stuck[i].decision);
    return FW_OK;
}

fw_verdict_decision fw_verdict_drying_bears(const fw_verdict_variant_verdict *v,
                                            const fw_mechanism_drying *drying, int *number) {
    const fw_verdict_stiction *s = v->stiction;
    *number = 0;
    if (!s || drying->how != FW_DRIED_PULLED) return FW_ACCEPT;
    *number = 585;
    if (s->why || !v->variant->below.known) return FW_INCONCLUSIVE;
    fw_verdict_pull below = s->below, beside = s->beside;
    fw_verdict_pull_number(drying, &below);
    fw_verdict_pull_number(drying, &beside);
    *number = 583;
    const fw_verdict_decision down = pulled_down(s, below.number, drying);
    if (down != FW_ACCEPT || !(beside.number[0] < 1)) return down;
    *number = 584;
    return FW_INCONCLUSIVE;
}
