/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bodies do by modes of their own under a scene's laws. Rigid bodies on flexures have three modes a body. Of bodies that
   bend others come between, and the same ones lie lower: (5e) has them with their shapes, of mass 1, phi. A scene's loads F_j
   with laws f_j hold mode k at p_kj = phi.F_j/omega^2, and it goes

     q_k - sum p_kj f_j

   beside that as the law acts: what bodies give at rest is in the bands as it is (5f). Its largest value over frequencies where
   the mode may lie, 1.1 times for what shapes are off by, times what the mode opens flexures and moves bodies by, adds up over
   modes; those whose bodies stay rigid and which lie where rigid bodies have them are left out: the motion has them. Damped is
   what the rigid modes are damped by, times the share that flexures store.

   In: loads of the scene, places as drawn, SI. Range: small motions; modes up to the twelfth; devices that flexures with an axis
   hold, and bodies that a grid resolves: of others nothing is added. Error: an upper bound but for frequencies between those
   looked at (half a radian apart at the end, 12 at least, and the law's own). Cost: the beams of body_swing.c and steps of
   fw_quantity_law_swings_of; none where what bodies give, times what is fast in the laws, is below 1/100.
   Theory: docs/theory/verdict.md, 5g. Test: test_effects.py BodiesThatAreShaken */
#include "base/constants.h"
#include "geometry/segment.h"
#include "quantity/law_kind.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { OWN_MODES = 12 };

typedef struct shaking_own {
    const fw_mechanism *m;
    const fw_device_scene *s;
    const fw_verdict_swung *w;
    const double *q; /* (3 nbody) the start */
    const fw_effects_loads *loads;
    fw_verdict_held_ways held;
    fw_quantity_law_load *load; /* (n) size: of one mode at rest; the last ones are held */
    double *size;
    int n;
    fw_quantity_law_pieces pieces;
} shaking_own;

/* phi . M a of what moves every place of a body alike, or, with rigid (3 nbody), as each body does */
static double masses_by(const shaking_own *x, int k, double ax, double ay, const double *rigid) {
    const fw_verdict_beams *b = &x->w->beams;
    double sum = 0;
    for (int i = 0; i < b->n; i++) {
        const fw_verdict_beam *p = &b->at[i];
        const double *u = x->w->goes[(size_t)k * (size_t)b->n + (size_t)i];
        double a[3] = {ax, ay, 0};
        if (rigid) {
            const double *of = rigid + 3 * p->body;
            const fw_mechanism_mass *middle = &x->m->drawn[p->body];
            a[0] = of[0] - of[2] * (p->at.y - middle->y_m);
            a[1] = of[1] + of[2] * (p->at.x - middle->x_m);
            a[2] = of[2];
        }
        sum += p->mass_kg * (u[0] * a[0] + u[1] * a[1]) + p->inertia_kg_m2 * u[2] * a[2];
    }
    return sum;
}

/* by the forces of an element without its law, each where it acts */
static double element_by(const shaking_own *x, int k, const fw_effects_force_element *e) {
    double p[3 * FW_VERDICT_PORTS], f[3 * FW_VERDICT_PORTS], u[3], sum = 0;
    if (!fw_verdict_element_forces(e, x->q, p, f)) return 0;
    for (int i = 0; i < e->ports; i++) {
        if (e->port[i].body == FW_GROUND) continue;
        fw_verdict_swung_there(x->w, k, e->port[i].body, (fw_geometry_vec2){p[3 * i], p[3 * i + 1]},
                               u);
        sum += f[3 * i] * u[0] + f[3 * i + 1] * u[1] + f[3 * i + 2] * u[2];
    }
    return isfinite(sum) ? sum : 0;
}

static bool is_met(const fw_effects_force_element *e) {
    return e->switches == 1 && e->laws == 0 && e->class_->switch_value;
}

static void add_load(shaking_own *x, const fw_quantity_law *law, double size, bool squared) {
    x->load[x->n++] = (fw_quantity_law_load){.law = law, .size = size, .squared = squared};
}

/* x->load of mode k */
static void put_loads(shaking_own *x, int k) {
    const fw_device_scene *s = x->s;
    const double s2 = x->w->s2[k];
    double u[3];
    x->n = 0;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        if (f->body == FW_GROUND) continue;
        fw_verdict_swung_there(x->w, k, f->body,
                               fw_mechanism_local_place(x->m, f->body, f->x_m, f->y_m), u);
        add_load(x, f->law, s2 * (f->fx_N * u[0] + f->fy_N * u[1]), false);
    }
    for (int i = 0; i < s->ntorque; i++) {
        const fw_device_torque *t = &s->torque[i];
        if (t->body == FW_GROUND) continue;
        const fw_mechanism_mass *middle = &x->m->drawn[t->body];
        fw_verdict_swung_there(x->w, k, t->body, (fw_geometry_vec2){middle->x_m, middle->y_m}, u);
        add_load(x, t->law, s2 * t->value_Nm * u[2], false);
    }
    for (int i = 0; i < s->nbase; i++) {
        const fw_device_base_motion *b = &s->base[i];
        add_load(x, b->law, -s2 * masses_by(x, k, b->ax_m_per_s2, b->ay_m_per_s2, NULL), false);
    }
    add_load(x, NULL, s2 * masses_by(x, k, s->gx_m_per_s2, s->gy_m_per_s2, NULL), false);
    for (int i = 0; x->loads && i < x->loads->nelement; i++) {
        const fw_effects_force_element *e = &x->loads->element[i];
        if (!is_met(e))
            add_load(x, e->laws > 0 ? e->law[0] : NULL, s2 * element_by(x, k, e),
                     e->class_->electrodes);
    }
    for (int i = 0; i < x->held.n; i++) {
        x->load[x->n] = x->held.load[i];
        x->load[x->n++].size =
            masses_by(x, k, 0, 0, x->held.way + (size_t)i * 3 * (size_t)x->m->nbody);
    }
}

/* sizes at rest of a mode that lies at w */
static void sizes_at(const shaking_own *x, double s2, double w) {
    for (int j = 0; j < x->n; j++)
        x->size[j] = x->load[j].size * (j < x->n - x->held.n ? 1 / (s2 * w * w) : 1);
}

/* |q - sum of sizes times laws| at w and above, whatever the laws' course; infinite: nothing bounds one */
static double bound_at(const shaking_own *x, double s2, double w, double start) {
    const double end_s = x->s->duration_s;
    sizes_at(x, s2, w);
    double most = fw_quantity_law_bound_of(x->load, x->size, x->n, end_s) + fabs(start) / w;
    for (int j = 0; j < x->n; j++) {
        const double f = x->load[j].law ? fw_quantity_law_largest(x->load[j].law, end_s) : 1;
        most += fabs(x->size[j]) * (x->load[j].squared ? f * f : f);
    }
    return most;
}

/* the same from low to high by how fast the laws are: what is slow leaves nothing behind */
static double slow_bound(const shaking_own *x, double s2, double low, double high, double start) {
    double most = fabs(start) / low;
    const double any = bound_at(x, s2, low, start); /* leaves the sizes at low */
    for (int j = 0; j < x->n; j++) {
        if (x->load[j].squared) return any;
        if (x->size[j] != 0)
            most += fabs(x->size[j]) *
                    fw_quantity_law_responds(x->load[j].law, x->s->duration_s, low, high).behind;
    }
    return fmin(any, most);
}

/* |q - sum of sizes times laws| at these (lanes), at most; steps: that it took, -1: a bound */
static double departs_at(const shaking_own *x, double s2, const double *w, double damping,
                         double start, double *steps) {
    enum { LANES = FW_QUANTITY_LANES };
    const double one = 1;
    double most[LANES], all = 0;
    fw_quantity_law_row row;
    const fw_quantity_law_loads on = {x->load, x->n, x->held.n, &x->pieces};
    fw_quantity_law_oscillator mode = {damping, start, x->size, {0}, {0}};
    fw_quantity_law_seen seen = {.by = &one, .most = most, .row = &row, .n = 1, .behind = true};
    for (int j = 0; j < x->n; j++)
        x->size[j] = x->load[j].size;
    for (int l = 0; l < LANES; l++)
        mode.omega_per_s[l] = w[l], mode.scale[l] = 1 / (s2 * w[l] * w[l]);
    *steps = fw_quantity_law_swings_of(&on, &mode, 1, &seen);
    for (int l = 0; l < LANES; l++)
        all = fmax(all, *steps >= 0 ? most[l] : bound_at(x, s2, w[l], start));
    return all;
}

/* over [low, high] */
static double departs(const shaking_own *x, double s2, double low, double high, double damping,
                      double start) {
    enum { LANES = FW_QUANTITY_LANES };
    const double budget = 1e6, least = 12;
    double at[LANES], steps, most = 0;
    int own = 0; /* where the laws' own frequencies are, or the lowest */
    for (int l = 0; l < LANES; l++)
        at[l] = low;
    for (int j = 0; j < x->n; j++) {
        const double is =
            fw_quantity_law_wave_of(x->load[j].law).rad_per_s * (x->load[j].squared ? 2 : 1);
        if (!(is > low && is < high)) continue;
        at[own++] = is;
        if (own == LANES) most = fmax(most, departs_at(x, s2, at, damping, start, &steps)), own = 0;
    }
    most = fmax(most, departs_at(x, s2, at, damping, start, &steps));
    const double wanted = 2 + ceil((high - low) * x->s->duration_s / 0.5),
                 n = fmin(wanted, fmax(least, budget / fmax(steps, 1)));
    for (double i = 0; i < (steps < 0 ? 2 : n); i += LANES) {
        for (int l = 0; l < LANES; l++)
            at[l] = low + (high - low) * fmin((i + l) / (n - 1), 1);
        most = fmax(most, departs_at(x, s2, at, damping, start, &steps));
    }
    return most;
}

/* share of its energy that a mode has by bodies that move as rigid ones do */
static double moves_rigid(const fw_verdict_swung *w, int nbody, int k) {
    const fw_verdict_beams *b = &w->beams;
    double sum = 0;
    for (int body = 0; body < nbody; body++) {
        double kg = 0, p[2] = {0}, about = 0, inertia = 0;
        fw_geometry_vec2 at = {0};
        for (int i = b->first[body]; i < b->first[body + 1]; i++) {
            kg += b->at[i].mass_kg;
            at.x += b->at[i].mass_kg * b->at[i].at.x, at.y += b->at[i].mass_kg * b->at[i].at.y;
        }
        at.x /= kg, at.y /= kg;
        for (int i = b->first[body]; i < b->first[body + 1]; i++) {
            const fw_verdict_beam *beam = &b->at[i];
            const double *u = w->goes[(size_t)k * (size_t)b->n + (size_t)i];
            const fw_geometry_vec2 r = vec_sub(beam->at, at);
            p[0] += beam->mass_kg * u[0], p[1] += beam->mass_kg * u[1];
            about += beam->mass_kg * (r.x * u[1] - r.y * u[0]) + beam->inertia_kg_m2 * u[2];
            inertia += beam->mass_kg * vec_dot(r, r) + beam->inertia_kg_m2;
        }
        if (kg > 0) sum += (p[0] * p[0] + p[1] * p[1]) / kg;
        if (inertia > 0) sum += about * about / inertia;
    }
    return sum;
}

/* where mode k may lie; false: rigid bodies have it */
static bool is_own(const fw_verdict_own *own, int nbody, int k, double *low, double *high) {
    const double same = 0.95, rigid = 0.98, softer = 1.15, stiffer = 1.12;
    const fw_statics_modes *modes = own->modes;
    const double w = 1 / sqrt(own->w->s2[k]);
    const double unlike = 0.1, /* of flexures in a mode that rigid bodies do not have */
        flexures = fmin(fmax(own->w->flexures[k], 0), 1),
                 off = flexures * (k < modes->count
                                       ? fmin(fw_statics_mode_error(&modes->mode[k]), unlike)
                                       : unlike);
    double at_rest = 0;
    if (k < modes->count && modes->mode[k].stiffness_per_s2 > 0) {
        at_rest = 1 / modes->mode[k].stiffness_per_s2;
        if (w * sqrt(at_rest) > same && moves_rigid(own->w, nbody, k) > rigid) return false;
    }
    *low = (1 - off) / sqrt(own->w->s2[k] + (softer - 1) * fmax(own->w->s2[k] - at_rest, 0));
    *high = (1 + off) * stiffer * w;
    return true;
}

/* as much as the least damped mode of rigid bodies in the scene is, of what flexures store */
static double damping_of(const fw_verdict_own *own, const fw_verdict_shaken *to, int k) {
    double least = to->n > 0 ? 0.99 : 0;
    for (int i = 0; i < to->n; i++)
        least = fmin(least, to->mode[i].damping[FW_VERDICT_LEAST_DAMPED]);
    return least * fmin(fmax(own->w->flexures[k], 0), 1);
}

/* += far times what mode k does to every hinge, body, and what may be met */
static void add_mode(const shaking_own *x, int k, double far, double unit_m,
                     const fw_verdict_shaken *to, double *more, double *way_m) {
    const fw_mechanism *m = x->m;
    const fw_verdict_beams *b = &x->w->beams;
    for (int h = 0; h < m->nhinge; h++) {
        const double *d = x->w->opens[(size_t)k * (size_t)m->nhinge + (size_t)h];
        more[h] += far * fw_verdict_bends_most(fw_verdict_bend_of(&m->hinge[h], d[2], d[0], d[1]));
    }
    double *way = more + m->nhinge;
    for (int body = 0; body < m->nbody; body++) {
        double most = 0, turns = 0;
        for (int i = b->first[body]; i < b->first[body + 1]; i++) {
            const double *u = x->w->goes[(size_t)k * (size_t)b->n + (size_t)i];
            most = fmax(most, hypot(u[0], u[1])), turns = fmax(turns, fabs(u[2]));
        }
        way[body] += far * (most + unit_m * turns);
        if (way_m) way_m[body] += far * most;
    }
    for (int c = 0; c < to->nreach; c++) { /* by the bodies that meet */
        const fw_verdict_reach *r = &to->reach[c];
        double u = 0;
        for (int body = 0; body < m->nbody; body++) {
            bool meets = r->stop && (r->stop->body_a == body || r->stop->body_b == body);
            for (int i = 0; r->element && i < r->element->ports; i++)
                meets = meets || r->element->port[i].body == body;
            if (!meets) continue;
            double most = 0;
            for (int i = b->first[body]; i < b->first[body + 1]; i++) {
                const double *of = x->w->goes[(size_t)k * (size_t)b->n + (size_t)i];
                most = fmax(most, r->stop ? unit_m * fabs(of[2]) : hypot(of[0], of[1]));
            }
            u += most;
        }
        way[m->nbody + c] += far * u;
    }
}

fw_status fw_verdict_own_modes(fw_arena *arena, const fw_verdict_variant_verdict *v,
                               fw_verdict_own *own) {
    const fw_device_scene still = {.name = "(none)", .duration_s = 1};
    if (own->looked[0]) return FW_OK;
    own->looked[0] = true;
    return fw_verdict_modes_about(arena, v->mechanism, &still, false, 0.03, &own->modes);
}

static fw_status look_at_own(fw_arena *arena, const fw_verdict_variant_verdict *v,
                             fw_verdict_own *own) {
    FW_TRY(fw_verdict_own_modes(arena, v, own));
    if (own->looked[1] || !own->modes) return FW_OK;
    const char *why; /* they are not known, and w has none */
    own->looked[1] = true;
    FW_NEED(own->w = fw_arena_one(arena, fw_verdict_swung));
    return fw_verdict_swung_modes(arena, v->mechanism, v->arm, OWN_MODES, own->w, &why);
}

static fw_status shaking_new(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                             const fw_verdict_own *own, shaking_own *x) {
    const fw_device_scene *s = &v->mechanism->device->scene[scene];
    *x = (shaking_own){.m = v->mechanism,
                       .s = s,
                       .w = own->w,
                       .q = v->motion[scene]->q,
                       .loads = v->motion[scene]->loads};
    if (v->mechanism->ndriver > 0 || s->ntemperature > 0)
        FW_TRY(fw_verdict_ways_held(arena, v->mechanism, s, &x->held));
    const size_t most = (size_t)(s->nforce + s->ntorque + s->nbase + 1 + x->held.n) +
                        (x->loads ? (size_t)x->loads->nelement : 0);
    FW_NEED(x->load = fw_arena_array(arena, fw_quantity_law_load, most));
    FW_NEED(x->size = fw_arena_array(arena, double, most));
    put_loads(x, 0);
    return fw_quantity_law_pieces_of(arena, x->load, x->n, s->duration_s, &x->pieces);
}

/* Bends that hinge k is strained by in the scene as by a rotation, at least: one that is only pulled bends by round-off, of which
   nothing is a share */
static double strained_by(const fw_mechanism *m, const fw_dynamics_motion *motion, int k) {
    const double by_forces = 0.1; /* of which bends are part, too */
    const fw_verdict_strain_monitor *saw = motion->observed;
    const double per_rad = m->hinge[k].closed_form.strain_per_rad;
    return saw && per_rad > 0 ? by_forces * saw->hinge[k].strain.value / per_rad : 0;
}

/* the share by which the largest grows; unit_m: lengths that count */
static double take_more(const fw_mechanism *m, const fw_dynamics_motion *motion, double unit_m,
                        const double *more, fw_verdict_shaken *to) {
    const int nh = m->nhinge, rows = nh + m->nbody + to->nreach;
    const double hardly = 1e-3, nothing = 1e-9;
    double bends = 0, goes = 0, most = 0;
    for (int i = 0; i < nh + m->nbody; i++) {
        double *of = i < nh ? &bends : &goes;
        *of = fmax(*of, to->most[i]);
    }
    for (int i = 0; i < rows; i++) {
        const double least =
                         i < nh ? fmax(hardly * bends, strained_by(m, motion, i)) : hardly * goes,
                     of = fmax(to->most[i], least),
                     by = of > (i < nh ? 0 : nothing * unit_m) ? more[i] / of : 0;
        to->each[i] += by;
        if (i < nh)
            to->factor[2 * i] += by, to->factor[2 * i + 1] = fmax(0, to->factor[2 * i + 1] - by);
        if (i < nh + m->nbody) most = fmax(most, by);
    }
    return most;
}

/* (rows) what mode k would do at the very most, beside what moves most: it hardly counts */
static bool hardly_counts(const fw_mechanism *m, const double *more, const fw_verdict_shaken *to) {
    const double hardly = 1e-3;
    double most[2] = {0}, does[2] = {0};
    for (int i = 0; i < m->nhinge + m->nbody; i++) {
        most[i >= m->nhinge] = fmax(most[i >= m->nhinge], to->most[i]);
        does[i >= m->nhinge] = fmax(does[i >= m->nhinge], more[i]);
    }
    return does[0] <= hardly * most[0] && does[1] <= hardly * most[1];
}

fw_status fw_verdict_bodies_swing(fw_arena *arena, int scene, bool shaken, fw_verdict_own *own,
                                  fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    fw_verdict_shaken *to = &v->shaken[scene];
    const size_t rows = (size_t)m->nhinge + (size_t)m->nbody + (size_t)to->nreach;
    const double shapes = 1.1; /* what they may be off by */
    double low, high;
    FW_TRY(look_at_own(arena, v, own));
    if (!to->most || !own->modes || own->w->n == 0) return FW_OK;
    const size_t modes = (size_t)own->w->n;
    shaking_own x;
    fw_verdict_swinging *s = fw_arena_one(arena, fw_verdict_swinging);
    double *more = fw_arena_array(arena, double, 2 * rows), *would = more + rows;
    FW_NEED(s && more ? s : NULL);
    FW_NEED(s->far = fw_arena_array(arena, double, 2 * modes + (size_t)m->nbody));
    s->shaken = shaken;
    s->w = own->w, s->fast = s->far + modes, s->way_m = s->fast + modes, s->slow_Hz = HUGE_VAL;
    FW_TRY(shaking_new(arena, v, scene, own, &x));
    for (int k = 0; k < own->w->n; k++) {
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
        if (!is_own(own, m->nbody, k, &low, &high)) continue;
        put_loads(&x, k);
        const double start = masses_by(&x, k, 0, 0, v->motion[scene]->v),
                     damping = damping_of(own, to, k), unit_m = own->modes->unit_length_m,
                     bound = slow_bound(&x, own->w->s2[k], low, high, start);
        double *way_m = s->way_m;
        memset(would, 0, rows * sizeof *would);
        s->far[k] = shapes * bound;
        if (isfinite(bound)) add_mode(&x, k, bound, unit_m, to, would, NULL);
        if (!isfinite(bound) || !hardly_counts(m, would, to))
            s->far[k] = shapes * departs(&x, own->w->s2[k], low, high, damping, start);
        add_mode(&x, k, s->far[k], unit_m, to, more, way_m);
        s->fast[k] = high * s->far[k], s->slow_Hz = fmin(s->slow_Hz, low / FW_TURN);
    }
    s->share = take_more(m, v->motion[scene], own->modes->unit_length_m, more, to);
    if (s->share > 0) to->own = s;
    return FW_OK;
}

/* ---- may they? ---- */

/* 1/omega^2 of what a body does by itself, at most, as if all of it hung on the softest of its ways together */
static double slow_alone_s2(const fw_verdict_variant_verdict *v, double *hangs_s2) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_hung *hung = v->out_of_plane ? v->out_of_plane->hung : NULL;
    const double stiff_N = m->variant->material.youngs.value * m->variant->thickness_m;
    double slowest = 0;
    *hangs_s2 = 0;
    for (int b = 0; b < m->nbody; b++) {
        fw_geometry_vec2 pin, root;
        double gives = 0;
        for (int k = 0; k < 2 * m->nhinge; k++)
            if (v->arm[k].known && fw_mechanism_hinge_end(m, b, k, &pin, &root))
                gives += (v->arm[k].give[3] + v->arm[k].give[5]) / stiff_N;
        const double hangs = hung ? hung[b].in_plane_mode_s2 : 0;
        *hangs_s2 = fmax(*hangs_s2, hangs);
        slowest = fmax(slowest, m->body[b].mass_kg * gives + hangs);
    }
    return slowest;
}

/* |q - f| of what a scene's laws do at `low` and above, over what they do at rest, at most */
static double laws_behind(const fw_mechanism *m, const fw_device_scene *s, double low) {
    const double fast = 30, end_s = s->duration_s;
    double behind = 0;
#define LAWS(n, of, at)                                                                            \
    for (int i = 0; i < (n); i++)                                                                  \
        behind = fmax(behind, fw_quantity_law_responds((of), end_s, (at), fast * (at)).behind /    \
                                  fmax((of) ? fw_quantity_law_largest((of), end_s) : 1, DBL_MIN));
    LAWS(s->nforce, s->force[i].law, low)
    LAWS(s->ntorque, s->torque[i].law, low)
    LAWS(s->nbase, s->base[i].law, low)
    LAWS(s->ntendon, s->tendon[i].law, low)
    LAWS(s->ncomb, s->comb[i].law, 0.5 * low) /* by its square */
    LAWS(s->ntemperature, s->temperature[i].law, low)
    LAWS(m->ndriver, &m->driver[i].law, low)
#undef LAWS
    return behind;
}

fw_status fw_verdict_may_swing(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                               bool shaken, double gives, fw_verdict_own *own, bool *may) {
    const fw_mechanism *m = v->mechanism;
    /* of hinges alone, what bodies do counts from where what they give does: plain ways of samples hold up to there */
    const bool alone = !shaken && v->nrequirement == 0 && m->device->scene[scene].nbase == 0;
    const double little = alone ? fw_verdict_straight_share * fw_verdict_bending_told : 0.01;
    const fw_dynamics_motion *motion = v->motion[scene];
    double hangs_s2;
    *may = false;
    if (!v->arm || v->straight || !motion || motion->nsample < 2 || !motion->q) return FW_OK;
    if (motion->loads && motion->loads->quasi_static) return FW_OK; /* equilibria do not swing */
    const double slow_s = sqrt(slow_alone_s2(v, &hangs_s2));
    if (!(slow_s > 0)) return FW_OK;
    const double behind = laws_behind(m, &m->device->scene[scene], 1 / slow_s);
    if (!((gives + (hangs_s2 > 0)) * behind > little)) return FW_OK;
    FW_TRY(fw_verdict_own_modes(arena, v, own));
    if (!own->modes) return FW_OK;
    double first = 0;
    for (int k = own->modes->count - 1; k >= 0; k--)
        if (own->modes->mode[k].stiffness_per_s2 > 0) first = own->modes->mode[k].stiffness_per_s2;
    *may = (gives + hangs_s2 * first) * behind > little;
    return FW_OK;
}

/* ---- what of a device that was made is kept and compared ---- */

fw_status fw_verdict_shaken_keep(fw_arena *arena, const fw_verdict_variant_verdict *v,
                                 const fw_verdict_shaken **kept) {
    const size_t scenes = (size_t)v->mechanism->device->nscene, h = (size_t)v->nhinge + 1,
                 bodies = (size_t)v->nhinge + (size_t)v->mechanism->nbody;
    fw_verdict_shaken *to;
    *kept = NULL;
    if (!v->shaken) return FW_OK;
    FW_NEED(to = fw_arena_grow(arena, v->shaken, scenes, scenes, sizeof *to));
#define KEEP(what, count)                                                                          \
    if (what) FW_NEED(what = fw_arena_grow(arena, what, (count), (count), sizeof *(what)))
    for (size_t i = 0; i < scenes; i++) {
        fw_verdict_shaken *of = &to[i];
        for (int k = 0; k < 4; k++)
            of->other[k].probe = NULL, of->own = NULL;
        const size_t n = (size_t)of->n, loads = (size_t)of->nload, reach = (size_t)of->nreach,
                     rows = bodies + reach;
        KEEP(of->factor, 2 * h);
        KEEP(of->grown, 2 * h);
        KEEP(of->flexed, 2 * h - 2);
        KEEP(of->each, rows);
        KEEP(of->most, rows);
        KEEP(of->reach, reach);
        for (size_t k = 0; k < reach; k++) {
            of->reach[k].element = NULL, of->reach[k].stop = NULL;
            if (of->reach[k].id) FW_NEED(of->reach[k].id = fw_arena_strdup(arena, of->reach[k].id));
        }
        if (n == 0) continue;
        KEEP(of->mode, n);
        KEEP(of->load, loads);
        KEEP(of->way, (size_t)of->ways * rows);
        for (size_t k = 0; k < loads; k++) /* that of a driver stands in the mechanism */
            KEEP(of->load[k].law, 1);
        for (size_t k = 0; k < n; k++) {
            KEEP(of->mode[k].bends, rows);
            KEEP(of->mode[k].size, loads);
        }
    }
#undef KEEP
    *kept = to;
    return FW_OK;
}

/* ---- which of those that were run lead ----
   What rings by the same law at the same frequency goes as far as its loads hold it at rest, c, or at one frequency as it is
   light, c w^2; a hinge is strained likewise. So of each hinge, requirement, body and thing that may be met those two lead of
   which that is most (of a requirement also least) among those that the same contacts hold, and others add nothing. */

bool fw_verdict_held_alike(const fw_verdict_shaken *a, const fw_verdict_shaken *b) {
    if (a->nreach != b->nreach) return false;
    for (int c = 0; c < a->nreach; c++)
        if (a->reach[c].rests != b->reach[c].rests) return false;
    return true;
}

/* by the mode that has most, over how far it goes; 0: not known */
static double held_by(const fw_verdict_search *s, const fw_verdict_shaken *of, bool light) {
    const int first = s->v->nhinge, end = first + s->v->mechanism->nbody;
    double most = 0;
    for (int k = 0; k < of->n; k++) {
        const fw_verdict_shaken_mode *mode = &of->mode[k];
        double share = 0, size = fabs(mode->start) / mode->omega;
        for (int i = first; i < end; i++)
            share = fmax(share, fw_verdict_bends_most(mode->bends[i]));
        for (int j = 0; mode->size && j < of->nload; j++)
            size = fmax(size, fabs(mode->size[j]));
        if (mode->size) most = fmax(most, size * share * (light ? pow(mode->omega, 2) : 1));
    }
    return most;
}

/* of what is asked about (hinges, requirements, ways of bodies, gaps) how much there is of number q */
static double amount_of(const fw_verdict_search *s, int scene, int point, int q) {
    const fw_verdict_fabricated_corner *c = &s->fabricated->corner[point];
    const fw_verdict_shaken *of = &c->shaken[scene];
    const int nh = s->v->nhinge, nr = s->v->nrequirement, nb = s->v->mechanism->nbody;
    if (q < nh)
        return exp(s->ln[(size_t)point * (size_t)s->ncheck +
                         (size_t)q * ((size_t)s->device->nscene + 1) + (size_t)scene]);
    if (q < nh + nr) {
        const fw_verdict_requirement *r = c->requirement ? &c->requirement[q - nh] : NULL;
        return r && !r->why && r->measure && r->scene_index == scene ? fabs(r->swing) : 0;
    }
    if (q < nh + nr + nb) return of->most[q - nr];
    const int reach = q - nh - nr - nb;
    return reach < of->nreach ? of->most[nh + nb + reach] : 0;
}

bool fw_verdict_leads(const fw_verdict_search *s, int scene, int point) {
    const fw_verdict_shaken *own = &s->fabricated->corner[point].shaken[scene];
    const int asked = s->v->nhinge + s->v->nrequirement,
              all = asked + s->v->mechanism->nbody + own->nreach;
    for (int light = 0; light < 2; light++) {
        const double held = held_by(s, own, light);
        if (point == 0 || !(held > 0)) return true;
        for (int q = 0; q < all; q++) {
            const double is = held * amount_of(s, scene, point, q);
            bool most = is > 0, least = most && q >= s->v->nhinge && q < asked;
            for (int p = 0; p < s->fabricated->ncorner && (most || least); p++) {
                const fw_verdict_shaken *there = s->fabricated->corner[p].shaken;
                if (p == point || !there || there[scene].n == 0) continue;
                if (!fw_verdict_held_alike(&there[scene], own)) continue;
                const double other = held_by(s, &there[scene], light) * amount_of(s, scene, p, q);
                most = most && !(other > is || (other == is && p < point));
                least = least && !(other < is || (other == is && p < point));
            }
            if (most || least) return true;
        }
    }
    return false;
}
