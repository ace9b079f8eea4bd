/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What free strains change in the motion: they displace it, and the displaced mechanism answers the
   loads otherwise. Test: test_bounds.c, test_envelope.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* Without the change dK(t), |s_j^T dK s_k| <= part w_j w_k, the motion differs by d with
   d'' + w^2 d = dK q, q the motion that the envelope bounds: a force of known size and any course
   on every mode. Input and output dimensionless. */
double fw_effects_envelope_varying(const fw_effect_case *c, double part) {
    const fw_effects_envelope *e = c->envelope;
    if (part == 0) return 0;
    if (!e->valid || !(part < 0.5)) return (double)INFINITY;
    double most = 0, pushed = 0;
    for (int j = 0; j < e->modes; j++)
        pushed += pow(e->omega[j] * e->amplitude[j], 2);
    pushed = part / (1 - part) * sqrt(pushed); /* Cauchy over the modes, as the norm is Frobenius */
    for (int i = 0; i < e->npin; i++) {
        double sum = 0;
        for (int j = 0; j < e->modes; j++)
            sum += fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]) * e->omega[j] * pushed *
                   e->response_bound[j];
        most = fmax(most, sum);
    }
    return most / e->floor * e->margin;
}

typedef struct work {
    const fw_effect_case *c;
    const fw_effects_modal *o;
    const fw_quantity_law *law;
    fw_quantity_law_size size;
    double *shift, *shift_turn, *force, *modal_load; /* (n) (npin) (n) (modes) */
    fw_mechanism *moved;
    fw_effects_loads loads;
    fw_effects_modal there;        /* modes where the strains have displaced it to */
    double *align;                 /* (modes x modes) [l, j]: shape_l there, M, shape_j here */
    double *extra, *rest, *change; /* (npin) rad; (modes) */
} work;

/* rad of pin i: |turn| of every mode times its size */
static void add_modes(work *w, const double *size) {
    const fw_effects_envelope *e = w->c->envelope;
    for (int j = 0; j < e->modes; j++)
        for (int i = 0; i < e->npin; i++)
            w->extra[i] += fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]) * size[j];
}

/* ---- the displacement ---- */

static fw_status displace(work *w, const double *strain) {
    const fw_effects_envelope *e = w->c->envelope;
    size_t n = (size_t)e->n;
    FW_TRY(fw_effects_modal_shift(w->c->arena, w->o, strain, w->shift, w->shift_turn, w->force));
    for (int i = 0; i < e->npin; i++)
        w->extra[i] = fabs(w->shift_turn[i]) * w->size.most;
    for (int j = 0; j < e->modes; j++) {
        double square = e->omega[j] * e->omega[j], f = 0;
        for (size_t k = 0; k < n; k++)
            f += e->shape[(size_t)j * n + k] * w->force[k];
        w->modal_load[j] = f / square; /* static */
        w->rest[j] = fabs(f) * fmin((w->size.most + w->size.variation) / square,
                                    w->size.most * e->response_bound[j]);
        const double *drag = w->o->shift_drag[1];
        if (!fw_quantity_law_is_constant(w->law) && drag && drag[j] != 0)
            w->rest[j] += fabs(drag[j]) * w->size.variation / e->omega[j];
    }
    add_modes(w, w->rest);
    return FW_OK;
}

/* ---- the mechanism there ---- */

/* strained, and moved to the equilibrium of its springs */
static fw_status go_there(work *w, const double *strain) {
    const fw_effects_envelope *e = w->c->envelope;
    fw_arena *arena = w->c->arena;
    const fw_mechanism *strained;
    size_t bodies = (size_t)w->o->mechanism->nbody;
    double most = w->size.most;
    w->loads = *w->o->loads;
    w->loads.strained = true;
    w->loads.stretch.law = NULL;
    FW_NEED(w->loads.strain = fw_arena_array(arena, double, bodies + 1));
    for (size_t b = 0; b <= bodies; b++)
        w->loads.strain[b] = most * strain[b];
    FW_TRY(fw_effects_strain(arena, w->o->mechanism, &w->loads, &strained));
    w->loads.strained = false;
    FW_NEED(w->moved = fw_arena_one(arena, fw_mechanism));
    *w->moved = *strained;
    FW_NEED(w->moved->body = fw_arena_array(arena, fw_mechanism_mass, bodies));
    for (size_t b = 0; b < bodies; b++) {
        double way[3];
        for (size_t k = 0; k < 3; k++) {
            way[k] = w->shift[3 * b + k];
            for (int j = 0; j < e->modes; j++)
                way[k] += w->modal_load[j] * e->shape[(size_t)j * (size_t)e->n + 3 * b + k];
        }
        w->moved->body[b] = strained->body[b];
        w->moved->body[b].x_m += most * way[0];
        w->moved->body[b].y_m += most * way[1];
        w->moved->body[b].phi_rad += most * way[2];
    }
    return fw_effects_modal_find(arena, w->moved, w->c->scene, &w->loads, &w->there);
}

static double mass_of(const fw_mechanism *m, int i) {
    return i % 3 == 2 ? m->body[i / 3].inertia_kg_m2 : m->body[i / 3].mass_kg;
}

/* With q there = T q here (T = align) the equation there reads T^T T q'' + T^T W^2 T q = T^T f:
   what it has besides 1, w^2 and f is the change, in the norm of fw_effects_envelope_stiffness. */
static fw_status compare_stiffness(work *w, double *part) {
    const fw_effects_envelope *e = w->c->envelope;
    size_t m = (size_t)e->modes, n = (size_t)e->n;
    double sum = 0;
    FW_NEED(w->align = fw_arena_array(w->c->arena, double, m *m));
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j < m; j++)
            for (size_t i = 0; i < n; i++)
                w->align[l * m + j] += w->there.shape[l * n + i] * e->shape[j * n + i] *
                                       mass_of(w->o->mechanism, (int)i);
    for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < m; k++) {
            double stiffness = 0, mass = 0;
            for (size_t l = 0; l < m; l++) {
                double both = w->align[l * m + j] * w->align[l * m + k];
                mass += both;
                stiffness += both * w->there.omega[l] * w->there.omega[l];
            }
            stiffness = stiffness / (e->omega[j] * e->omega[k]) - (j == k);
            mass -= j == k;
            sum += pow(fabs(stiffness) + fabs(mass), 2);
        }
    *part = sqrt(sum);
    return FW_OK;
}

/* T^T D' T less D of the dampers, at the largest speeds: a modal load with any history */
static void compare_damping(work *w) {
    const fw_effects_envelope *e = w->c->envelope;
    size_t m = (size_t)e->modes;
    for (size_t j = 0; j < m; j++) {
        w->rest[j] = 0;
        for (size_t k = 0; k < m; k++) {
            double change = -w->o->damping[j * m + k];
            for (size_t a = 0; a < m; a++)
                for (size_t b = 0; b < m; b++)
                    change +=
                        w->align[a * m + j] * w->there.damping[a * m + b] * w->align[b * m + k];
            w->rest[j] += 2 * fabs(change) * e->modal_speed[k] * e->response_bound[j];
        }
    }
    add_modes(w, w->rest);
}

/* modal forces there, as seen here, less those here; a modal load with its law or at its busiest */
static void compare_modal_load(work *w, const fw_effects_modal_loads *here,
                               const fw_effects_modal_loads *there, int i) {
    const fw_effects_envelope *e = w->c->envelope;
    const fw_effects_modal_load *a = &here->item[i], *b = &there->item[i];
    size_t m = (size_t)e->modes;
    double *one = w->rest, *two = w->modal_load;
    double sup = 1, first = 1, sway = 0, largest = 0;
    double with = fw_quantity_law_is_constant(w->law) ? 0 : w->size.variation / w->size.most;
    memcpy(one, a->mode, m * sizeof *one);
    memcpy(two, b->mode, m * sizeof *two);
    if (a->element) {
        double t = fw_effects_loads_element_busiest(w->o->mechanism, a->element, e->duration_s);
        memset(one, 0, m * sizeof *one);
        memset(two, 0, m * sizeof *two);
        fw_effects_modal_load_at(w->o, here, a, t, fmax(t, DBL_MIN), one);
        fw_effects_modal_load_at(&w->there, there, b, t, fmax(t, DBL_MIN), two);
        sway = (double)INFINITY;
    } else if (a->law)
        for (size_t j = 0; j < m; j++)
            if (fabs(a->mode[j]) > largest) {
                largest = fabs(a->mode[j]);
                sup = a->sup[j] / largest, first = a->first[j] / largest;
                sway = a->sway[j] / largest;
            }
    for (size_t j = 0; j < m; j++) {
        double f = -one[j], square = e->omega[j] * e->omega[j];
        for (size_t l = 0; l < m; l++)
            f += w->align[l * m + j] * two[l];
        w->change[j] =
            fabs(f) * fmin((sup + first + sway + sup * with) / square, sup * e->response_bound[j]);
    }
    add_modes(w, w->change);
}

/* twice: the strained mechanism swings about its new place */
static fw_status compare(work *w, double *part) {
    const fw_effects_envelope *e = w->c->envelope;
    size_t m = (size_t)e->modes, pins = (size_t)e->npin;
    fw_effects_modal_loads here, there;
    FW_TRY(compare_stiffness(w, part));
    *part *= 2;
    for (size_t j = 0; j < m; j++) {
        double v = -w->o->velocity[j];
        for (size_t l = 0; l < m; l++)
            v += w->align[l * m + j] * w->there.velocity[l];
        for (size_t i = 0; i < pins; i++) {
            double turn = -e->turn[j * pins + i];
            for (size_t l = 0; l < m; l++)
                turn += w->align[l * m + j] * w->there.turn[l * pins + i];
            w->extra[i] += 2 * fabs(turn) * e->amplitude[j] +
                           2 * fabs(e->turn[j * pins + i] * v) / e->omega[j];
        }
    }
    compare_damping(w);
    FW_TRY(fw_effects_modal_loads_find(w->c->arena, w->o, &here));
    FW_TRY(fw_effects_modal_loads_find(w->c->arena, &w->there, &there));
    if (here.why_not || there.why_not) *part = (double)INFINITY;
    for (int i = 0, k = 0; i < here.count && k < there.count; i++)
        if (!here.item[i].shift) {
            FW_NEED(k == i ? w : NULL); /* shifts come last */
            compare_modal_load(w, &here, &there, k++);
        }
    return FW_OK;
}

/* Leaving the strains out changes the turn of a pin by
     |turn of x0| + sum |turn_j| |s_j^T K x0| (sup + var)/w^2       x0: modal_stiffness.c
     + what the loads do otherwise where the strains put the mechanism: other stiffness and masses,
       other modal forces and damping, other turns of the same modes (modes found again there).
   Inputs: strains, dimensionless; output dimensionless, against the floor, with the margin of the
   envelope and that of the turns which the strains make. Infinite where the envelope is not valid
   or the displaced mechanism has no modes. Cost that of one more envelope. */
fw_status fw_effects_envelope_strain(const fw_effect_case *c, const double *strain,
                                     const fw_quantity_law *law, double *bound) {
    const fw_effects_envelope *e = c->envelope;
    double part, most = 0;
    *bound = (double)INFINITY;
    if (!e->valid) return FW_OK;
    work w = {.c = c, .o = e->modal, .law = law};
    w.size = fw_quantity_law_measure(law, e->duration_s);
    if (!isfinite(w.size.most)) return FW_OK;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(w.shift = fw_arena_array(c->arena, double, (size_t)e->n));
    FW_NEED(w.force = fw_arena_array(c->arena, double, (size_t)e->n));
    FW_NEED(w.shift_turn = fw_arena_array(c->arena, double, (size_t)e->npin));
    FW_NEED(w.extra = fw_arena_array(c->arena, double, (size_t)e->npin));
    FW_NEED(w.modal_load = fw_arena_array(c->arena, double, (size_t)e->modes));
    FW_NEED(w.change = fw_arena_array(c->arena, double, (size_t)e->modes));
    FW_NEED(w.rest = fw_arena_array(c->arena, double, (size_t)e->modes));
    FW_TRY(displace(&w, strain));
    FW_TRY(go_there(&w, strain));
    if (!w.there.why_not && w.there.modes == e->modes) {
        FW_TRY(compare(&w, &part));
        for (int i = 0; i < e->npin; i++)
            most = fmax(most, w.extra[i]);
        *bound = (most * e->margin + fw_effects_modal_second(w.o)) / e->floor;
        *bound += fw_quantity_law_is_constant(law) ? fw_effects_envelope_stiffness(c, part)
                                                   : fw_effects_envelope_varying(c, part);
        if (isnan(*bound)) *bound = (double)INFINITY;
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}
