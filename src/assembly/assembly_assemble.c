/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem from any guess: descent, restarts, the pose nearest to the guess, a polish
   to round-off. */
#include "base/constants.h"
#include "assembly/closure.h"
#include "assembly/solved.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* a body that weighs as much as every other and has its arm as radius of gyration: what restarts
   move with, so that mass ratios do not steer the search */
static fw_status even_masses(fw_arena *arena, const fw_mechanism *from, double length_m,
                             fw_mechanism *to) {
    *to = *from;
    FW_NEED(to->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)from->nbody));
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

/* the largest |Psi| of a joint */
static double residual(fw_assembly_closure *c) {
    return fw_multibody_residual(c->system, fw_multibody_pose_at(c->system, 0, c->u), c->psi);
}

/* points that a rod joins must not coincide, or it has no direction to start with */
static void part_rods(fw_assembly_closure *c, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = c->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        double d[2], e[2], n[2];
        if (b->rows != FW_ROWS_ROD) continue;
        fw_multibody_frame(m, pose, i, d, e, n);
        if (hypot(d[0], d[1]) > 1e-9) continue;
        int body = b->b < m->nbody ? b->b : b->a;
        double angle = 2 * FW_PI * fw_assembly_spread(7, (unsigned)i);
        c->u[3 * body] += 1e-4 * cos(angle);
        c->u[3 * body + 1] += 1e-4 * sin(angle);
    }
}

/* from other starts; on success c->u is closed. `search` stays for the explanation of a failure:
   its least mismatch is in r->best. Lengths of both models differ by a factor only. */
static fw_status try_restarts(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                              fw_diags *diags, fw_assembly_closure *c, fw_assembly_closure *search,
                              fw_assembly_restart *r, bool *good) {
    fw_mechanism even;
    double length = c->model->scale.length_m;
    FW_TRY(even_masses(arena, mechanism, length, &even));
    FW_TRY(fw_assembly_closure_new(arena, &even, q, diags, search));
    const fw_multibody_model *model = search->model;
    FW_TRY(fw_assembly_restart_new(arena, model, r));
    search->left = 1000 + (long)(2e8 / model->nblock);
    *good = fw_assembly_restart_close(r, search);
    c->iterations += search->iterations;
    for (int i = 0; i < model->nq; i++)
        c->u[i] = search->u[i] * (i % 3 == 2 ? 1 : model->scale.length_m / length);
    return FW_OK;
}

static const double usable = 1e-9; /* scaled gap: coordinates with fewer digits are of no use */

/* a body a million sizes away, or turned ten thousand times, has no digits left for its joints */
static fw_status too_far(const fw_mechanism *mechanism, const double *guess, fw_diags *diags) {
    int far = 0;
    double most = -1;
    char x[32], y[32], phi[32];
    for (int b = 0; b < mechanism->nbody; b++) {
        const double *q = guess + 3 * b;
        double size = fmax(hypot(q[0], q[1]), fabs(q[2]));
        if (size > most) most = size, far = b;
    }
    const char *id = mechanism->body[far].id;
    return fw_diag_error(diags, 105, (fw_place){0},
                         "the poses to assemble are too far away for double precision: body %s "
                         "stands at x = %s m, y = %s m, phi = %s rad; check units",
                         id ? id : "(unnamed)", fw_number_text(x, sizeof x, guess[3 * far], 4),
                         fw_number_text(y, sizeof y, guess[3 * far + 1], 4),
                         fw_number_text(phi, sizeof phi, guess[3 * far + 2], 4));
}

/* the result in SI, polished by a model that stands there: its round-off is that of the mechanism,
   not of a guess far away */
static fw_status polish(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                        fw_diags *diags, const fw_assembly_closure *from, double *q) {
    fw_assembly_closure c;
    double length = from->model->scale.length_m;
    for (int i = 0; i < from->model->nq; i++)
        q[i] = guess[i] + (i % 3 == 2 ? 1 : length) * from->u[i];
    FW_TRY(fw_assembly_closure_new(arena, mechanism, q, diags, &c));
    fw_assembly_closure_descend(&c, 30); /* it was closed: what is left is round-off */
    if (!(residual(&c) <= usable)) return too_far(mechanism, guess, diags);
    for (int i = 0; i < c.model->nq; i++)
        q[i] += (i % 3 == 2 ? 1 : length) * c.u[i];
    return FW_OK;
}

/* why not, and the least mismatch in SI */
static fw_status give_up(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                         fw_diags *diags, fw_assembly_closure *search, fw_assembly_restart *r,
                         fw_assembly_solved *out) {
    fw_status status = fw_assembly_closure_explain(arena, mechanism, search, r, diags);
    double length = search->model->scale.length_m;
    for (int i = 0; i < search->model->nq; i++)
        out->q[i] = guess[i] + (i % 3 == 2 ? 1 : length) * search->u[i];
    return status;
}

static fw_status close_up(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                          fw_diags *diags, fw_assembly_solved *out) {
    fw_assembly_closure c, search;
    fw_assembly_restart r = {.restarts = 0};
    int *group;
    bool good = true;
    FW_TRY(fw_assembly_closure_new(arena, mechanism, guess, diags, &c));
    if (!(residual(&c) < 1e150)) /* its square must be a number */
        return too_far(mechanism, guess, diags);
    if (fw_assembly_closure_descend(&c, 0)) /* the guess is closed: nothing moves */
        return residual(&c) <= usable ? FW_OK : too_far(mechanism, guess, diags);
    part_rods(&c, fw_multibody_pose_at(c.system, 0, c.u));
    if (!fw_assembly_closure_descend(&c, 500)) {
        FW_TRY(try_restarts(arena, mechanism, guess, diags, &c, &search, &r, &good));
        out->restarts = r.restarts;
        out->iterations = (int)c.iterations;
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
        c.left = 1000;
        if (!good || !fw_assembly_closure_descend(&c, 100))
            return give_up(arena, mechanism, guess, diags, &search, &r, out);
    }
    FW_NEED(group = fw_arena_array(arena, int, (size_t)c.model->nbody + 1));
    c.left = 5000;
    fw_assembly_closure_unwind(&c, group);
    fw_assembly_closure_nearest(&c);
    out->iterations = (int)c.iterations;
    return polish(arena, mechanism, guess, diags, &c, out->q);
}

fw_status fw_assembly_close(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, fw_assembly_solved *out) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *out = (fw_assembly_solved){0};
    for (size_t i = 0; i < n; i++)
        if (!isfinite(guess[i]))
            return fw_diag_error(diags, 105, (fw_place){0},
                                 "the position to assemble is not finite");
    FW_NEED(out->q = fw_arena_array(arena, double, n));
    memcpy(out->q, guess, n * sizeof(double));
    if (mechanism->nbody == 0 || mechanism->npin + mechanism->njoint == 0) return FW_OK;
    return close_up(arena, mechanism, guess, diags, out);
}

fw_status fw_assembly_assemble(fw_arena *arena, const fw_mechanism *mechanism, double *q,
                               double *moved_m, fw_diags *diags) {
    fw_assembly_solved solved;
    *moved_m = 0;
    FW_TRY(fw_assembly_close(arena, mechanism, q, diags, &solved));
    for (int b = 0; b < mechanism->nbody; b++)
        *moved_m =
            fmax(*moved_m, hypot(solved.q[3 * b] - q[3 * b], solved.q[3 * b + 1] - q[3 * b + 1]));
    memcpy(q, solved.q, 3 * (size_t)mechanism->nbody * sizeof(double));
    return FW_OK;
}
