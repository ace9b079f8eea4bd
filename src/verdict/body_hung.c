/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a body hangs over (body_tree.c), and what it does: it bends by its own weight and as it is shaken, swings slower,
   and is pulled down as it dries. A part of length l and width w, of a layer h thick, bears what hangs on it, where it is. It

     turns in the plane by 12 M l/(E h w^3), and goes by N l/(E h w) and 3.2 V l/(E h w)
     turns across it by 12 M l/(E w h^3) and T l 3/0.84 (1/(w h^3) + 1/(h w^3))/G, and goes by 1.2 V l/(G h w)

   3/0.84 being the most of all rectangles. One that is less than half as wide as the part before it is longer by what roots
   give: w/2 in the plane, w (1.07 + 0.215 ln(h/w)) across. Forces are summed up the tree, and places go as they are moved
   down it, which is exact for beams:

     how far a place goes at most by an acceleration, across the plane and by one of any direction in it;
     1/omega^2 of the slowest mode (iteration of powers), which adds at most as much to that of every mode of the bodies as
     rigid ones (Weyl), of modes across the plane and in it;
     the stress in the plane, as of a bar without corners;
     s = 2 gamma cos(theta) that pulls it down over a gap g: the largest with a stable solution of
     u = C (A s (1 + m)/(g - u)), m = max(g, h)/w (docs/theory/stiction.md, 1). At least g^2/(4 D), D of an even pressure.

   In: outlines of the layout, SI. Range: what is thin against what hangs on it. Error: against plane solids and solids of
   serpentines, folds and hooks 1/omega^2 is 2 to 5 % above in the plane and 10 to 20 % across. Cost: 5e4 to 1e6 cells.
   Source: a beam's; H. Weyl, Math. Ann. 71 (1912) 441. Theory: docs/theory/effects/out-of-plane.md (4a). Test:
   test_body_arms.c what_hangs_over_bends, folded_bars; test_out_of_plane.py */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

enum { TREE_CELLS = 50000, TREE_MOST = 1500000 };
/* what holds a body is placed to a cell of its ways, a hundredth of it: the fourth power of that */
static const double placed = 1.04;

/* ---- the tree of beams: f, forces at parts, to u, how far they go; f is then what parts bear ----
   In the plane (x, y, moment) and (x, y, turn); across (force, moments as of a lever along x and y) and (z, slopes). */

static void in_the_tree(fw_verdict_tree *t) {
    for (int i = t->n - 1; i >= 0; i--) {
        const int on = t->at[i].before;
        if (on == FW_NONE) continue;
        const fw_geometry_vec2 r = vec_sub(t->at[i].at, t->at[on].at);
        t->f[on][0] += t->f[i][0], t->f[on][1] += t->f[i][1];
        t->f[on][2] += t->f[i][2] + r.x * t->f[i][1] - r.y * t->f[i][0];
    }
    for (int i = 0; i < t->n; i++) {
        const fw_verdict_tree_part *p = &t->at[i];
        double *u = t->u[i];
        u[0] = u[1] = u[2] = 0;
        if (p->before == FW_NONE) continue;
        const double *from = t->u[p->before], w = p->wide_m, stiff = t->youngs_Pa * t->depth_m * w,
                     less = vec_length(p->along) > 0 ? 3.2 - 1 : 0;
        const fw_geometry_vec2 r = vec_sub(p->at, t->at[p->before].at),
                               by = {t->f[i][0], t->f[i][1]};
        const double pulls = less * vec_dot(by, p->along);
        u[0] = from[0] - from[2] * r.y + p->long_m * (3.2 * by.x - pulls * p->along.x) / stiff;
        u[1] = from[1] + from[2] * r.x + p->long_m * (3.2 * by.y - pulls * p->along.y) / stiff;
        u[2] = from[2] + 12 * (p->long_m + p->root_m[1]) * t->f[i][2] / (stiff * w * w);
    }
}

static void across_gives(const fw_verdict_tree *t, const fw_verdict_tree_part *p, double *bends,
                         double *twists) {
    const double h = t->depth_m, w = p->wide_m, cube = w * h * h * h;
    *bends = 12 * (p->long_m + p->root_m[0]) / (t->youngs_Pa * cube);
    *twists =
        3 / 0.84 * (p->long_m + p->root_m[0]) / t->shear_Pa * (1 / cube + 1 / (h * w * w * w));
}

static void across_the_tree(fw_verdict_tree *t) {
    const double h = t->depth_m;
    for (int i = t->n - 1; i >= 0; i--) {
        const int on = t->at[i].before;
        if (on == FW_NONE) continue;
        const fw_geometry_vec2 r = vec_sub(t->at[i].at, t->at[on].at);
        t->f[on][0] += t->f[i][0];
        t->f[on][1] += t->f[i][1] + r.x * t->f[i][0];
        t->f[on][2] += t->f[i][2] + r.y * t->f[i][0];
    }
    for (int i = 0; i < t->n; i++) {
        const fw_verdict_tree_part *p = &t->at[i];
        double *u = t->u[i];
        u[0] = u[1] = u[2] = 0;
        if (p->before == FW_NONE) continue;
        const double *from = t->u[p->before], w = p->wide_m;
        double bends, twists;
        across_gives(t, p, &bends, &twists);
        const bool runs = vec_length(p->along) > 0;
        const fw_geometry_vec2 r = vec_sub(p->at, t->at[p->before].at), n = vec_left(p->along),
                               m = {t->f[i][1], t->f[i][2]};
        const double most = fmax(bends, twists), along = bends * vec_dot(m, p->along),
                     beside_it = twists * vec_dot(m, n);
        u[0] = from[0] + from[1] * r.x + from[2] * r.y +
               1.2 * p->long_m * t->f[i][0] / (t->shear_Pa * h * w);
        u[1] = from[1] + (runs ? along * p->along.x + beside_it * n.x : most * m.x);
        u[2] = from[2] + (runs ? along * p->along.y + beside_it * n.y : most * m.y);
    }
}

/* forces (k of them) of an acceleration of 1, each place's own in v, or of all alike along one */
static void accelerate(fw_verdict_tree *t, bool across, int alike, double kg_per_m2) {
    for (int i = 0; i < t->n; i++) {
        t->f[i][0] = t->f[i][1] = t->f[i][2] = 0;
        for (int k = 0; k < (across ? 1 : 2); k++)
            t->f[i][k] =
                kg_per_m2 * t->at[i].mass_m2 * (alike == FW_NONE ? t->v[i][k] : k == alike);
    }
    if (across)
        across_the_tree(t);
    else
        in_the_tree(t);
}

/* 1/omega^2 of the slowest mode, with 2 % for what an iteration may lack */
static double slowest(fw_verdict_tree *t, bool across, double kg_per_m2) {
    enum { TIMES = 30 };
    const int n = across ? 1 : 2;
    double was = 1, now = 0;
    for (int i = 0; i < t->n; i++) /* no mode is square to it: any numbers, of either sign */
        for (int k = 0; k < n; k++)
            t->v[i][k] = (((unsigned)i * 2654435761U + (unsigned)k * 40503U) >> 16 & 255) / 256.0 -
                         (k > 0 && i % 3 > 0 ? 0.75 : 0.25);
    for (int turn = 0; turn <= TIMES; turn++) {
        if (turn > 0) accelerate(t, across, FW_NONE, kg_per_m2);
        now = 0;
        for (int i = 0; i < t->n; i++)
            for (int k = 0; k < n; k++) {
                if (turn > 0) t->v[i][k] = t->u[i][k];
                now += t->at[i].mass_m2 * t->v[i][k] * t->v[i][k];
            }
        if (!(now > 0)) return 0;
        was = sqrt(now);
        for (int i = 0; i < t->n; i++)
            for (int k = 0; k < n; k++)
                t->v[i][k] /= was;
    }
    return 1.02 * placed * was;
}

static double farthest_across(const fw_verdict_tree *t) {
    double most = 0;
    for (int i = 0; i < t->n; i++)
        most = fmax(most, fabs(t->u[i][0]) + t->at[i].far_m * hypot(t->u[i][1], t->u[i][2]));
    return most;
}

/* m/N of the softest end across the plane; corners: of the softest place of any part, by as much as it reaches beyond its
   middle and with what shear gives */
static double softest_tip(fw_verdict_tree *t, bool corners) {
    double most = 0;
    for (int k = 0; k < t->n; k++) {
        double sum = 0;
        if (t->at[k].bears > 0 && !corners) continue; /* it is no end */
        const double far = corners ? t->at[k].far_m : 0;
        for (int i = k; t->at[i].before != FW_NONE; i = t->at[i].before) {
            const fw_verdict_tree_part *p = &t->at[i];
            const fw_geometry_vec2 r = vec_sub(t->at[k].at, p->at), n = vec_left(p->along);
            const double along = fabs(vec_dot(r, p->along)) + far,
                         aside = fabs(vec_dot(r, n)) + far;
            double bends, twists;
            across_gives(t, p, &bends, &twists);
            const bool runs = vec_length(p->along) > 0;
            sum += runs ? bends * along * along + twists * aside * aside
                        : fmax(bends, twists) * pow(vec_length(r) + far, 2);
            if (corners) sum += 1.2 * p->long_m / (t->shear_Pa * t->depth_m * p->wide_m);
        }
        most = fmax(most, sum);
    }
    return most;
}

/* what a part bears by an acceleration, times the thickness */
static double stressed(const fw_verdict_tree *t, int i) {
    const double w = t->at[i].wide_m, *f = t->f[i];
    return t->at[i].before == FW_NONE ? 0 : (6 * fabs(f[2]) / w + hypot(f[0], f[1])) / w;
}

/* by an acceleration in any direction of the plane: from those by one along x and along y */
static fw_status put_in_plane(fw_verdict_tree *t, double kg_per_m2, fw_verdict_hung *hung) {
    double far = 0, stress = 0, *by_x = fw_arena_array(t->arena, double, (size_t)t->n);
    FW_NEED(by_x);
    t->farthest = FW_NONE;
    accelerate(t, false, 0, kg_per_m2);
    for (int i = 0; i < t->n; i++) {
        by_x[i] = stressed(t, i);
        for (int k = 0; k < 3; k++)
            t->v[i][k] = t->u[i][k];
    }
    accelerate(t, false, 1, kg_per_m2);
    for (int i = 0; i < t->n; i++) {
        const double *x = t->v[i], *y = t->u[i], det = x[0] * y[1] - x[1] * y[0],
                     sum = x[0] * x[0] + x[1] * x[1] + y[0] * y[0] + y[1] * y[1],
                     most = 0.5 * (sum + sqrt(fmax(sum * sum - 4 * det * det, 0)));
        const double goes = sqrt(most) + t->at[i].far_m * hypot(x[2], y[2]);
        if (goes > far) far = goes, t->farthest = i;
        stress = fmax(stress, hypot(by_x[i], stressed(t, i)));
    }
    hung->in_plane_s2 = placed * far;
    hung->Pa_per_m_s2 = stress / t->depth_m;
    hung->in_plane_mode_s2 = slowest(t, false, kg_per_m2);
    return FW_OK;
}

/* ---- what a liquid below pulls ---- */

/* s as a share of what an even pressure, which closes `even` of the gap by s = 1, may be at least: does it stay open? */
static bool stays_open(fw_verdict_tree *t, double s, double gap_m) {
    enum { TIMES = 200 };
    const double settled = 1e-3;
    double most = 0;
    for (int i = 0; i < t->n; i++)
        t->v[i][0] = t->v[i][1]; /* of the gap; from where a lesser one left it */
    for (int turn = 0; turn < TIMES; turn++) {
        double moved = 0;
        for (int i = 0; i < t->n; i++) {
            const fw_verdict_tree_part *p = &t->at[i];
            const double edges = fmax(gap_m, t->depth_m) / p->wide_m;
            t->f[i][0] = p->before == FW_NONE
                             ? 0
                             : s * p->mass_m2 * (1 + edges) / (gap_m * (1 - t->v[i][0]));
            t->f[i][1] = t->f[i][2] = 0;
        }
        across_the_tree(t);
        most = farthest_across(t) / gap_m;
        if (!(most < 1)) return false;
        for (int i = 0; i < t->n; i++) {
            const double now = fabs(t->u[i][0]) / gap_m;
            moved = fmax(moved, fabs(now - t->v[i][0]));
            t->v[i][0] = now;
        }
        if (!(moved < settled * most)) continue;
        for (int i = 0; i < t->n; i++)
            t->v[i][1] = t->v[i][0];
        return true;
    }
    return false;
}

/* s = 2 gamma cos(theta) that it bears over a gap, N/m: between a quarter, which it surely does, and all of what closes the
   gap as an even pressure, to 2 % */
static double bears(fw_verdict_tree *t, double gap_m) {
    double low = 1, high = 1;
    for (int i = 0; i < t->n; i++) {
        const fw_verdict_tree_part *p = &t->at[i];
        t->f[i][0] = p->before == FW_NONE
                         ? 0
                         : p->mass_m2 * (1 + fmax(gap_m, t->depth_m) / p->wide_m) / gap_m;
        t->f[i][1] = t->f[i][2] = t->v[i][1] = 0;
    }
    across_the_tree(t);
    const double even = farthest_across(t) / gap_m, enough_N_per_m = 10;
    if (!(even > 0)) return HUGE_VAL;
    low = 0.25 / even, high = 1 / even;
    if (low > enough_N_per_m) return low;
    while (high > 1.02 * low) {
        const double s = sqrt(low * high);
        if (stays_open(t, s, gap_m))
            low = s;
        else
            high = s;
    }
    return low;
}

/* ---- bodies ---- */

/* what goes farthest is three cells wide all the way to what holds it, but for a tenth of that, and all hangs together */
static bool is_fine(const fw_verdict_tree *t, const fw_verdict_hung *hung) {
    const double across = 3, little = 1e-3, stiff_s2 = 2e-13; /* 360 kHz */
    int narrow = 0, all = 0;
    if (t->reached_m2 < (1 - little) * t->whole_m2) return false;
    if (hung->in_plane_s2 < stiff_s2 && hung->across_s2 < stiff_s2) return true;
    for (int i = t->farthest; i != FW_NONE; i = t->at[i].before, all++)
        narrow += t->at[i].before != FW_NONE && t->at[i].wide_m < across * t->cell;
    return narrow <= 1 + all / 10;
}

/* kg/m2 of what parts have of the body, as made */
static double weighs(const fw_verdict_tree *t, double mass_kg) {
    const double less = t->made_m2 > 0 ? t->reached_m2 / t->made_m2 : 1;
    return mass_kg / t->whole_m2 * less;
}

/* across: what it does across the plane, too */
static fw_status bend_tree(fw_verdict_tree *t, double mass_kg, double gap_m, bool across,
                           fw_verdict_hung *hung) {
    FW_TRY(fw_verdict_tree_grow(t, !across && t->nhinge == 1));
    if (!across) return put_in_plane(t, weighs(t, mass_kg), hung);
    const double kg_per_m2 = weighs(t, mass_kg);
    accelerate(t, true, 0, kg_per_m2);
    hung->across_s2 = placed * farthest_across(t);
    hung->tip_m_per_N = softest_tip(t, false);
    hung->corner_m_per_N = t->thrown ? placed * softest_tip(t, true) : 0;
    hung->across_mode_s2 = slowest(t, true, kg_per_m2);
    hung->bears_N_per_m = gap_m > 0 ? bears(t, gap_m) : HUGE_VAL;
    /* in the plane one hinge's arm has all of the body that is between */
    if (t->nhinge == 1) FW_TRY(fw_verdict_tree_grow(t, true));
    return put_in_plane(t, weighs(t, mass_kg), hung);
}

static fw_status hang(fw_verdict_tree *t, const fw_mechanism *m, double mass_kg, bool across,
                      fw_verdict_hung *hung) {
    const fw_mechanism_below *below = &m->variant->below;
    const bool pulled = m->variant->drying.how != FW_DRIED_UNKNOWN && below->known && !below->open;
    const fw_geometry_box box = t->box;
    const double x = box.x1 - box.x0, y = box.y1 - box.y0, least_m = 1e-6;
    double cell = fmax(fmax(sqrt(x * y / TREE_CELLS), fmax(x, y) / 1000), least_m);
    const fw_mark mark = fw_arena_mark(t->arena);
    for (;; cell /= 2) {
        fw_arena_rewind(t->arena, mark);
        FW_TRY(fw_verdict_tree_lay(t, box, cell));
        FW_TRY(bend_tree(t, mass_kg, pulled ? fmax(below->low_m, 1e-9) : 0, across, hung));
        if (is_fine(t, hung) || cell < 2 * least_m || 4 * x * y / (cell * cell) > TREE_MOST) break;
    }
    return FW_OK;
}

static fw_status overhang(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout, int body,
                          const fw_verdict_arm *arm, bool across, fw_verdict_hung *hung) {
    const fw_device_material *of = &m->variant->material;
    const double nu = of->poisson.unknown ? 0.3 : of->poisson.value,
                 crystal = 1.6; /* of silicon's shear moduli, along and across its axes */
    *hung = (fw_verdict_hung){.bears_N_per_m = HUGE_VAL};
    fw_verdict_tree t = {.depth_m = m->variant->thickness_m,
                         .youngs_Pa = of->youngs.value,
                         .shear_Pa = of->youngs.value / (2 * (1 + nu)) /
                                     (fw_device_material_is_crystal(of) ? crystal : 1)};
    if (!(m->shape[body].area_m2 > 0) || !(t.youngs_Pa > 0) || !(t.depth_m > 0)) return FW_OK;
    for (int i = 0; m->device && i < m->device->nscene; i++)
        t.thrown = t.thrown || fw_mechanism_plates_shaken(&m->device->scene[i]);
    FW_TRY(fw_verdict_tree_new(arena, m, layout, body, arm, &t));
    return t.nline > 0 ? hang(&t, m, m->body[body].mass_kg, across, hung) : FW_OK;
}

fw_status fw_verdict_overhang(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                              int body, const fw_verdict_arm *arm, fw_verdict_hung *hung) {
    return overhang(arena, m, layout, body, arm, true, hung);
}

fw_status fw_verdict_overhangs(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                               bool across, fw_verdict_hung **hung) {
    fw_status status = FW_OK;
    FW_NEED(*hung = fw_arena_array(arena, fw_verdict_hung, (size_t)m->nbody));
    fw_arena *own = fw_arena_part(arena, 0);
    FW_NEED(own);
    const fw_mark mark = fw_arena_mark(own);
    fw_arena_keep(own); /* one body takes the pages of the one before it */
    for (int b = 0; b < m->nbody && status == FW_OK; b++) {
        fw_arena_rewind(own, mark);
        status = overhang(own, m, m->layout, b, arm, across, &(*hung)[b]);
    }
    fw_arena_free(own);
    return status;
}

fw_status fw_verdict_hung_of(fw_arena *arena, const fw_verdict_variant_verdict *v,
                             const fw_verdict_hung **hung) {
    fw_verdict_hung *own = NULL;
    *hung = v->out_of_plane ? v->out_of_plane->hung : NULL;
    if (!*hung) FW_TRY(fw_verdict_overhangs(arena, v->mechanism, v->arm, true, &own));
    if (own) *hung = own;
    return FW_OK;
}

/* ---- what hangs over bends in the plane, judged: what may meet then, goes farther or swings slower ---- */

/* what loads and shaking bend by `by` counts twice what they do at rest, for what comes at once; own modes say that themselves */
static double beside_own(const fw_verdict_variant_verdict *v, int scene, double by, double own) {
    const fw_device_scene *s = &v->mechanism->device->scene[scene];
    const bool weighs = s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0; /* which counts once */
    return fmax(by, (weighs ? by : 0.5 * by) + own);
}

/* Of a displacement along a direction, with its sign, only what its own body does counts; and of any what hinges and loads do
   together, beside what the band has of hinges alone; own: what its modes do besides */
static fw_status asked_of(fw_arena *arena, const fw_verdict_variant_verdict *v,
                          const fw_verdict_requirement *r, const fw_verdict_hung *hung,
                          fw_verdict_soft *soft, double by, double own, double *down, double *up) {
    const fw_device *d = v->mechanism->device;
    const fw_device_probe *p = &d->probe[d->requirement[r->asked].probe];
    const fw_dynamics_motion *x = v->motion[r->scene_index];
    const fw_verdict_strain_monitor *saw = x ? x->observed : NULL;
    const double has =
        fw_verdict_bending_share(x) * fabs(isnan(r->origin) ? r->value : r->value - r->origin);
    double *to, apart, less, more, rings = 0;
    *down = *up = beside_own(v, r->scene_index, by, own);
    if (!saw || !saw->bending.rest_N || p->row != FW_PROBE_IS_displacement ||
        p->body == FW_GROUND || !r->measure || strcmp(r->measure, "settling-time") == 0)
        return FW_OK;
    bool known,
        across = strcmp(r->measure, "parasitic") == 0,
        way = !isnan(p->direction_rad) && fw_words_hold("final maximum minimum", " ", r->measure);
    const double times = strcmp(r->measure, "peak-to-peak") == 0 ? 2 : 1, /* at either end */
        along = p->direction_rad + (across ? 0.5 * FW_PI : 0);
    FW_TRY(fw_verdict_goes_farther(arena, v, r->scene_index, p, along, soft, &less, &more, &known));
    if (!way) { /* whichever way it is farthest */
        *down = *up = fmax(*up, times * fmax(less, more) - has + own);
        return FW_OK;
    }
    FW_NEED(to = fw_arena_array(arena, double, (size_t)v->mechanism->nbody));
    FW_TRY(fw_verdict_bends_in_plane(arena, v, r->scene_index, hung, p, to, &apart));
    FW_TRY(fw_verdict_bends_asked(arena, v, r->scene_index, hung, p, down, up, &rings));
    if (known) *down = *up = 0; /* what it gives by itself is in the whole */
    rings = fmax(rings, own);
    *down = fmax(*down, less - has) + rings, *up = fmax(*up, more - has) + rings;
    apart = beside_own(v, r->scene_index, apart, own);
    *down = fmax(*down + to[p->body], apart), *up = fmax(*up + to[p->body], apart);
    return FW_OK;
}

/* where it was undecided already, its reason says the band that it has now */
static fw_status widen(fw_arena *arena, double down, double up, fw_verdict_requirement *r,
                       fw_verdict_variant_verdict *v) {
    const char *then = fw_verdict_requirement_text(arena, r), *now;
    fw_verdict_requirement_widen(down, up, r);
    FW_NEED(then && (now = fw_verdict_requirement_text(arena, r)));
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].number == 330 && fw_text_same(v->reason[i].text, then))
            v->reason[i].text = now;
    return FW_OK;
}

static fw_status opens(fw_arena *arena, int scene, double by, int body, const fw_verdict_hung *hung,
                       fw_verdict_variant_verdict *v) {
    const char *name = v->mechanism->device->scene[scene].name;
    const double hardly = 1e-4; /* of a value: its band is as it was */
    const fw_verdict_swinging *own = v->shaken ? v->shaken[scene].own : NULL;
    fw_verdict_soft soft = {.looked = false};
    int farthest;
    const double swings =
        own ? fw_verdict_two_farthest(own->way_m, v->mechanism->nbody, &farthest) : 0;
    FW_TRY(fw_verdict_distances_open(arena, v, scene, beside_own(v, scene, by, swings), body));
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        const fw_verdict_decision was = r->decision;
        if (r->scene_index != scene || !fw_verdict_moves(r) || was == FW_REJECT) continue;
        double down, up;
        FW_TRY(asked_of(arena, v, r, hung, &soft, by, fw_verdict_swings_once(v, r), &down, &up));
        if (!(fmax(down, up) > hardly * fabs(r->value))) continue;
        FW_TRY(widen(arena, down, up, r, v));
        if (was != FW_ACCEPT || r->decision == FW_ACCEPT) continue;
        FW_TRY(fw_verdict_say_bent(arena, v, name, 639, fw_verdict_requirement_text(arena, r), body,
                                   fmax(down, up)));
    }
    return FW_OK;
}

/* A corner looks for distances no further than counts: by what is asked, and twice what bends as drawn (v->bends_m) */
fw_status fw_verdict_hangs_in_plane(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_hung *hung = v->out_of_plane ? v->out_of_plane->hung : NULL;
    const double hardly_m = 1e-8;
    fw_verdict_hung *own = NULL;
    double *to = fw_arena_array(arena, double, (size_t)m->nbody), apart, most = 0;
    FW_NEED(to);
    if (v->corner ? !v->arm : !v->out_of_plane) return FW_OK;
    if (!hung && v->corner && fw_verdict_asks_hung(v)) {
        FW_TRY(fw_verdict_overhangs(arena, m, v->arm, false, &own));
        hung = own;
    }
    for (int i = 0; i < m->device->nscene; i++) {
        if (!v->corner) FW_TRY(fw_verdict_shaken_bears(arena, v, hung, i));
        FW_TRY(fw_verdict_bends_in_plane(arena, v, i, hung, NULL, to, &apart));
        int body;
        const double by = fw_verdict_two_farthest(to, m->nbody, &body);
        most = fmax(most, by);
        FW_TRY(opens(arena, i, by, body, hung, v));
    }
    if (!v->corner) v->bends_m = 2 * most + hardly_m;
    return FW_OK;
}

/* ---- what flexures weigh (flexure_swing.c), judged: what is required to move, and what may meet ---- */

static fw_status flexures_open(fw_arena *arena, const char *scene, const char *what, double by_m,
                               fw_verdict_variant_verdict *v) {
    char text[32];
    FW_NEED(what);
    FW_NEED(what = fw_arena_printf(
                arena,
                "%s, and with what flexures weigh themselves, which is in no motion, it may be up "
                "to %s um otherwise: state masses of bodies with the halves of their flexures, and "
                "keep the frequencies of loads from those of the device and of its flexures",
                what, fw_number_text(text, sizeof text, 1e6 * by_m, 3)));
    return fw_verdict_hangs_open(v, scene, 725, what);
}

/* how much farther the corners of two bodies go together at most */
static double corners_more(const fw_mechanism *m, const fw_verdict_flexed *both) {
    double first = 0, second = 0;
    for (int b = 0; b < m->nbody; b++) {
        const fw_mechanism_shape *shape = m->shape ? &m->shape[b] : NULL;
        const double reach =
            shape && shape->area_m2 > 0 ? sqrt(3 * shape->polar_m4 / shape->area_m2) : 0;
        double far = 0, x[2], y[2];
        for (int i = 0; i < 8; i++) {
            const fw_geometry_vec2 at = {m->drawn[b].x_m + reach * cos(FW_PI * i / 4),
                                         m->drawn[b].y_m + reach * sin(FW_PI * i / 4)};
            fw_verdict_flexed_way(both, b, at, 0, x);
            fw_verdict_flexed_way(both, b, at, 0.5 * FW_PI, y);
            far = fmax(far, hypot(x[0], y[0]));
        }
        second = fmax(second, fmin(far, first)), first = fmax(first, far);
    }
    return first + second;
}

/* by[0]: farther, by[1]: less far; of a gap both bodies */
static void asked_more(const fw_mechanism *m, const fw_verdict_requirement *r,
                       const fw_verdict_flexed *both, double by[2]) {
    const fw_device_probe *p = &m->device->probe[m->device->requirement[r->asked].probe];
    const bool any = isnan(p->direction_rad) || strcmp(r->measure, "parasitic") == 0;
    double other[2];
    if (p->row != FW_PROBE_IS_displacement || p->body == FW_GROUND) return;
    const fw_geometry_vec2 at = fw_mechanism_local_place(m, p->body, p->x_m, p->y_m);
    fw_verdict_flexed_way(both, p->body, at, any ? 0 : p->direction_rad, by);
    if (any) {
        fw_verdict_flexed_way(both, p->body, at, 0.5 * FW_PI, other);
        by[0] = hypot(by[0], other[0]), by[1] = hypot(by[1], other[1]);
    }
    if (strcmp(r->measure, "peak-to-peak") == 0) by[0] *= 2, by[1] *= 2;
    if (!isnan(r->origin)) by[0] = by[1] = fmax(by[0], by[1]); /* either way */
}

static fw_status flexed_open(fw_arena *arena, int scene, const fw_verdict_flexed *both,
                             fw_verdict_variant_verdict *v) {
    const char *name = v->mechanism->device->scene[scene].name;
    const double hardly = 1e-4, /* of a value: its band is as it was */
        near = corners_more(v->mechanism, both);
    for (int k = 0; near > 0 && k < v->nclearance; k++) {
        fw_verdict_clearance *c = &v->clearance[k];
        if (c->scene_index != scene || c->decision != FW_ACCEPT) continue;
        if (c->low_m - near > c->required_m) continue;
        c->decision = FW_INCONCLUSIVE;
        FW_TRY(flexures_open(
            arena, name, "a distance between parts is kept as computed, and only just", near, v));
        break;
    }
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        const fw_verdict_decision was = r->decision;
        double by[2] = {near, near};
        if (r->scene_index != scene || r->why || !r->measure ||
            strcmp(r->measure, "settling-time") == 0 ||
            !fw_words_hold("displacement gap distance opening", " ", r->kind))
            continue;
        asked_more(v->mechanism, r, both, by);
        if (!(fmax(by[0], by[1]) > hardly * fabs(r->value))) continue;
        fw_verdict_requirement_widen(by[1], by[0], r);
        if (was != FW_INCONCLUSIVE && r->decision == FW_INCONCLUSIVE)
            FW_TRY(flexures_open(arena, name, fw_verdict_requirement_text(arena, r),
                                 fmax(by[0], by[1]), v));
    }
    return FW_OK;
}

static bool shakes_in_plane(const fw_device_scene *s) {
    for (int i = 0; i < s->nbase; i++)
        if (s->base[i].ax_m_per_s2 != 0 || s->base[i].ay_m_per_s2 != 0) return true;
    return false;
}

static fw_status tell_flexed(const fw_mechanism *m, int scene, double by, const char *hinge,
                             fw_diags *diags) {
    const double told = 1.05;
    char text[32];
    if (!(by > told)) return FW_OK;
    fw_diag_warning(diags, 726, m->device->scene[scene].place,
                    "%s%s shakes flexures by their own mass, which is in no motion: %s%s may be "
                    "strained up to %s times as much, which its band holds",
                    FW_NAMED("scene", m->device->scene[scene].name), FW_NAMED("hinge", hinge),
                    fw_number_text(text, sizeof text, by, 3));
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_verdict_flexures_shaken(fw_arena *arena, bool brief, fw_diags *diags,
                                     fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    fw_verdict_flexed *both = NULL;
    for (int i = 0; i < m->device->nscene; i++) {
        if (!v->motion[i] || !v->shaken || !shakes_in_plane(&m->device->scene[i])) continue;
        if (!both) FW_TRY(fw_verdict_flexed_new(arena, m, &both));
        if (!both) return FW_OK;
        const fw_verdict_strain_monitor *saw = v->motion[i]->observed;
        double *to, most = 1;
        const char *worst = NULL;
        FW_NEED(to = v->shaken[i].flexed = fw_arena_array(arena, double, 2 * (size_t)m->nhinge));
        FW_TRY(fw_verdict_flexed_by(arena, v, i, both));
        for (int h = 0; h < m->nhinge; h++) {
            fw_verdict_flexed_strain(both, h, to + 2 * h);
            const double had = saw ? saw->hinge[h].strain.value : 0, by = 1 + to[2 * h] / had;
            if (had > 0 && by > most) most = by, worst = m->pin[m->hinge[h].pin].id;
        }
        FW_TRY(flexed_open(arena, i, both, v));
        if (!brief && worst) FW_TRY(tell_flexed(m, i, most, worst, diags));
    }
    return FW_OK;
}
