/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem from any guess: descent, restarts, the pose nearest to the guess, a polish
   to round-off. */
#include "dynamics/closure.h"
#include "dynamics/solved.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* a body that weighs as much as every other and has its arm as radius of gyration: what restarts
   move with, so that mass ratios do not steer the search */
static fw_status even_masses(fw_arena *arena, const fw_mechanism *from, double length_m,
                             fw_mechanism *to) {
    *to = *from;
    FW_NEED(to->body = fw_arena_array(arena, fw_mass, (size_t)from->nbody));
    double mass = 0;
    for (int b = 0; b < from->nbody; b++)
        mass += from->body[b].mass_kg / from->nbody;
    for (int b = 0; b < from->nbody; b++) {
        to->body[b] = from->body[b];
        to->body[b].mass_kg = mass;
        to->body[b].inertia_kg_m2 = mass * length_m * length_m / 12;
    }
    return FW_OK;
}

/* points that a rod joins must not coincide, or it has no direction to start with */
static void part_rods(fw_closure *c) {
    const fw_model *m = c->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_block *b = &m->block[i];
        const double *r = m->arm + 4 * i, *offset = m->offset + 2 * i;
        if (b->rows != FW_ROWS_ROD ||
            hypot(r[2] - r[0] - offset[0], r[3] - r[1] - offset[1]) > 1e-9)
            continue;
        int body = b->b < m->nbody ? b->b : b->a;
        double angle = 2 * acos(-1.0) * fw_spread(7, (unsigned)i);
        c->u[3 * body] += 1e-4 * cos(angle);
        c->u[3 * body + 1] += 1e-4 * sin(angle);
    }
}

/* from other starts; on success c->u is closed, otherwise r->best has the least mismatch. Lengths
   of both models differ by a factor only. */
static fw_status try_restarts(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                              fw_diags *diags, fw_closure *c, fw_restart *r, bool *good) {
    fw_mechanism even;
    fw_model *model;
    fw_closure search;
    double length = c->model->scale.length_m;
    FW_TRY(even_masses(arena, mechanism, length, &even));
    FW_TRY(fw_model_new(arena, &even, NULL, q, 1, NULL, diags, &model));
    FW_TRY(fw_closure_new(arena, model, &search));
    search.left = 1000 + (long)(3e7 / model->nblock);
    *good = fw_restart_close(r, &search);
    c->iterations += search.iterations;
    for (int i = 0; i < model->nq; i++) {
        double factor = i % 3 == 2 ? 1 : model->scale.length_m / length;
        c->u[i] = search.u[i] * factor;
        r->best[i] *= factor;
    }
    return FW_OK;
}

/* the result in SI, polished by a model that stands there: its round-off is that of the mechanism,
   not of a guess far away */
static fw_status polish(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                        fw_diags *diags, const fw_closure *from, double *q, bool *good) {
    fw_model *model;
    fw_closure c;
    double length = from->model->scale.length_m;
    for (int i = 0; i < from->model->nq; i++)
        q[i] = guess[i] + (i % 3 == 2 ? 1 : length) * from->u[i];
    FW_TRY(fw_model_new(arena, mechanism, NULL, q, 1, NULL, diags, &model));
    FW_TRY(fw_closure_new(arena, model, &c));
    *good = fw_closure_descend(&c, 30);
    for (int i = 0; i < model->nq; i++)
        q[i] += (i % 3 == 2 ? 1 : length) * c.u[i];
    return FW_OK;
}

static fw_status close_up(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                          fw_diags *diags, fw_solved *out) {
    fw_model *model;
    fw_closure c;
    fw_restart r;
    bool good = true;
    FW_TRY(fw_model_new(arena, mechanism, NULL, guess, 1, NULL, diags, &model));
    FW_TRY(fw_closure_new(arena, model, &c));
    if (fw_closure_descend(&c, 0)) return FW_OK; /* the guess is closed: nothing moves */
    part_rods(&c);
    FW_TRY(fw_restart_new(arena, model, &r));
    if (!fw_closure_descend(&c, 500)) {
        r.value = fw_closure_mismatch(&c, c.u);
        memcpy(r.best, c.u, (size_t)model->nq * sizeof(double));
        FW_TRY(try_restarts(arena, mechanism, guess, diags, &c, &r, &good));
    }
    out->restarts = r.restarts;
    if (good) {
        int *group;
        FW_NEED(group = fw_arena_array(arena, int, (size_t)model->nbody + 1));
        c.left = 5000;
        good = r.restarts == 0 || fw_closure_descend(&c, 50);
        fw_closure_unwind(&c, group);
        fw_closure_nearest(&c);
        out->iterations = (int)c.iterations;
        bool polished;
        FW_TRY(polish(arena, mechanism, guess, diags, &c, out->q, &polished));
        if (good && polished) return FW_OK;
    }
    out->iterations = (int)c.iterations;
    fw_status status = fw_closure_explain(arena, mechanism, &c, &r, diags);
    for (int i = 0; i < model->nq; i++)
        out->q[i] = guess[i] + (i % 3 == 2 ? 1 : model->scale.length_m) * c.u[i];
    return status;
}

fw_status fw_assembly_close(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, fw_solved *out) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *out = (fw_solved){0};
    for (size_t i = 0; i < n; i++)
        if (!isfinite(guess[i]))
            return fw_diag_error(diags, 105, (fw_place){0},
                                 "the position to assemble is not finite");
    FW_NEED(out->q = fw_arena_array(arena, double, n));
    memcpy(out->q, guess, n * sizeof(double));
    if (mechanism->nbody == 0 || mechanism->npin + mechanism->ntie == 0) return FW_OK;
    return close_up(arena, mechanism, guess, diags, out);
}

fw_status fw_assemble(fw_arena *arena, const fw_mechanism *mechanism, double *q, double *moved_m,
                      fw_diags *diags) {
    fw_solved solved;
    *moved_m = 0;
    FW_TRY(fw_assembly_close(arena, mechanism, q, diags, &solved));
    for (int b = 0; b < mechanism->nbody; b++)
        *moved_m =
            fmax(*moved_m, hypot(solved.q[3 * b] - q[3 * b], solved.q[3 * b + 1] - q[3 * b + 1]));
    memcpy(q, solved.q, 3 * (size_t)mechanism->nbody * sizeof(double));
    return FW_OK;
}
