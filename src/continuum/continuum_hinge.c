/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/continuum.h"
#include "base/constants.h"
#include "continuum/mesh.h"
#include "continuum/solver.h"
#include <math.h>

/* blocks as in the finite elements that the closed form's root law was fitted to */
static void block_of(fw_continuum_shape *shape, double curvature) {
    double least = fmax(4.0 * shape->width_m, 2.5 * (0.5 * shape->width_m + shape->fillet_m));
    shape->root = FW_ROOT_BLOCK;
    shape->block_half_m = fmax(40e-6, least);
    if (curvature > 0.0) shape->block_half_m = fmin(shape->block_half_m, 0.7 / curvature);
    shape->block_length_m =
        fmax(curvature > 0.0 ? 0.52359877559829887 / curvature : 52.4e-6, 5.0 * shape->width_m);
}

void fw_continuum_shape_of(const fw_flexure_input *in, fw_continuum_shape *shape) {
    fw_flexure_result closed;
    fw_flexure_closed_form(in, &closed);
    *shape = (fw_continuum_shape){.npiece = 1,
                                  .width_m = in->width_m,
                                  .fillet_m = in->fillet_m,
                                  .depth_m = in->depth_m,
                                  .centre_x_m = closed.centre_m};
    if (in->kind == FW_FLEXURE_LEAF) {
        /* along y, as in flexure.h */
        shape->piece[0] = (fw_continuum_piece){in->length_m, 0.0};
        shape->y_m = -0.5 * in->length_m;
        shape->direction_rad = 0.5 * FW_PI;
        block_of(shape, 0.0);
        return;
    }
    double r = in->radius_m, a = 0.5 * in->angle_rad;
    shape->piece[0] = (fw_continuum_piece){2.0 * a * r, 1.0 / r};
    shape->x_m = r * cos(a), shape->y_m = -r * sin(a);
    shape->direction_rad = 0.5 * FW_PI - a;
    block_of(shape, 1.0 / r);
}

typedef struct job { /* of one mesh */
    fw_arena *arena; /* scratch, given back at the end */
    const fw_continuum_shape *shape;
    const fw_continuum_material *material;
    const fw_continuum_options *options;
    fw_place place;
    fw_diags *diags;
    const char *program;
    fw_continuum_mesh mesh;
} job;

static fw_status usable(const fw_continuum_material *material, const fw_continuum_options *o,
                        fw_place place, fw_diags *diags) {
    FW_TRY(fw_continuum_usable(material, o->refinement, place, diags));
    if (o->nangle >= 0 && o->nangle <= FW_CONTINUUM_ANGLES) return FW_OK;
    fw_diag_error(diags, 213, place, "%d angles are more than the %d of one run; ask for fewer",
                  o->nangle, FW_CONTINUUM_ANGLES);
    return FW_USAGE;
}

fw_status fw_continuum_hinge_deck(fw_arena *arena, const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options, fw_place place,
                                  fw_diags *diags, fw_text *deck) {
    fw_continuum_mesh mesh;
    FW_TRY(usable(material, options, place, diags));
    FW_TRY(fw_continuum_good_mesh(arena, shape,
                                  options->refinement > 0.0 ? options->refinement : 1.0,
                                  options->plane_stress, place, diags, &mesh));
    return fw_continuum_deck_hinge(shape, material, options, &mesh,
                                   options->large ? FW_DECK_LARGE : FW_DECK_LINEAR, deck);
}

static fw_status solve(const job *j, fw_continuum_deck_steps steps,
                       fw_continuum_solver_result *out) {
    fw_text deck = fw_text_new(j->arena);
    const int node[2] = {j->mesh.nnode + 1, j->mesh.nnode + 2};
    FW_TRY(fw_continuum_deck_hinge(j->shape, j->material, j->options, &j->mesh, steps, &deck));
    const fw_continuum_solver_call call = {.program = j->program,
                                           .deck = &deck,
                                           .node = node,
                                           .nnode = 2,
                                           .nstep = steps == FW_DECK_LARGE ? j->options->nangle : 3,
                                           .timeout_s = j->options->timeout_s,
                                           .place = j->place};
    return fw_continuum_solver_run(j->arena, &call, j->diags, out);
}

/* ---- what follows from the numbers ---- */

/* Compliance C at the shape's centre P from three load cases, made symmetric. Under a moment alone
   the pole, where nothing moves, is P + (-Cy,th, Cx,th)/Cth,th: the centre of compliance; there
   the translations decouple, C' = C_uu - C_u,th C_th,u/Cth,th.
   in: um, uN, uN um; out: m, N, N m. test_continuum.c: tables of finite elements made elsewhere */
static void linear_results(const job *j, const fw_continuum_solver_result *out,
                           fw_continuum_result *r) {
    const double length = 1e-6, force = 1e-6, moment = 1e-12;
    double c[3][3];
    for (int n = 0; n < 3; n++) {
        const fw_continuum_result_step *s = &out->step[n];
        double per = 1.0 / (n == 2 ? moment : force);
        int column = n == 2 ? 0 : n + 1; /* steps Fx, Fy, M -> columns M, Fx, Fy */
        c[0][column] = s->move[1][2] * per;
        c[1][column] = s->move[0][0] * length * per;
        c[2][column] = s->move[0][1] * length * per;
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            r->compliance[a][b] = 0.5 * (c[a][b] + c[b][a]);
    double turn = r->compliance[0][0], x = r->compliance[1][0], y = r->compliance[2][0];
    r->stiffness_Nm_per_rad = 1.0 / turn;
    r->centre_x_m = j->shape->centre_x_m - y / turn;
    r->centre_y_m = j->shape->centre_y_m + x / turn;
    r->kx_N_per_m = 1.0 / (r->compliance[1][1] - x * x / turn);
    r->ky_N_per_m = 1.0 / (r->compliance[2][2] - y * y / turn);
    double angle = turn * moment; /* of the unit moment's step, whose fields these are */
    r->strain_per_rad = out->strain[2].principal / angle;
    r->stress_per_rad_Pa = 1e6 * out->stress[2].principal / angle;
    r->mises_per_rad_Pa = 1e6 * out->stress[2].mises / angle;
    const fw_continuum_mesh *m = &j->mesh;
    for (int i = 0; i <= 2 * m->ni; i++)
        for (int k = 0; k < (2 * m->nj + 1) * (2 * m->nk + 1); k++) {
            int across = k / (2 * m->nk + 1), up = k % (2 * m->nk + 1);
            if (m->number[fw_continuum_lattice(m, i, across, up)] != out->strain[2].node) continue;
            size_t flat = (size_t)i * (size_t)(2 * m->nj + 1) + (size_t)across;
            r->peak_x_m = m->x[flat], r->peak_y_m = m->y[flat], r->peak_z_m = m->z[up];
        }
    r->mesh = (fw_continuum_mesh_size){m->nelement, m->nnode};
}

static void large_results(const job *j, const fw_continuum_solver_result *out,
                          fw_continuum_result *r) {
    double share = j->shape->depth_m / j->mesh.depth_m;
    r->nlarge = j->options->nangle;
    for (int i = 0; i < r->nlarge; i++) {
        const fw_continuum_result_step *s = &out->step[i];
        r->large[i] = (fw_continuum_large){.angle_rad = s->move[1][2],
                                           .moment_Nm = 2e-12 * share * s->force[1][2],
                                           .shift_x_m = 1e-6 * s->move[0][0],
                                           .shift_y_m = 1e-6 * s->move[0][1],
                                           .strain = out->strain[i].principal};
    }
}

static fw_status one_mesh(job *j, double refinement, bool large, fw_continuum_result *r) {
    fw_continuum_solver_result *out;
    FW_NEED(out = fw_arena_one(j->arena, fw_continuum_solver_result));
    FW_TRY(fw_continuum_good_mesh(j->arena, j->shape, refinement, j->options->plane_stress,
                                  j->place, j->diags, &j->mesh));
    FW_TRY(solve(j, FW_DECK_LINEAR, out));
    r->cpu_s += out->cpu_s;
    linear_results(j, out, r);
    if (!large || j->options->nangle == 0) return FW_OK;
    FW_TRY(solve(j, FW_DECK_LARGE, out));
    r->cpu_s += out->cpu_s;
    large_results(j, out, r);
    return FW_OK;
}

/* one run with memory of its own: results of a fine mesh are far larger than what is kept */
static fw_status with_scratch(const fw_arena *whole, job *j, double refinement, bool large,
                              fw_continuum_result *r) {
    FW_NEED(j->arena = fw_arena_part(whole, (size_t)2 << 30));
    fw_status status = one_mesh(j, refinement, large, r);
    fw_arena_free(j->arena);
    return status;
}

/* Richardson: with an error a h^p and meshes h, h q (q > 1) the finer one is off by
   |f(h q) - f(h)|/(q^p - 1). p = 2 for all: what the singular corners of a rigid face allow; away
   from them quadratic bricks do better and the estimate is on the safe side. */
static void estimate(const fw_continuum_result *coarse, double q, fw_continuum_result *fine) {
    double part = 1.0 / (q * q - 1.0);
    fine->stiffness_error =
        part * fabs(coarse->stiffness_Nm_per_rad / fine->stiffness_Nm_per_rad - 1.0);
    fine->strain_error = part * fabs(coarse->strain_per_rad / fine->strain_per_rad - 1.0);
    fine->centre_error_m =
        part * hypot(coarse->centre_x_m - fine->centre_x_m, coarse->centre_y_m - fine->centre_y_m);
}

fw_status fw_continuum_hinge(fw_arena *arena, const fw_continuum_shape *shape,
                             const fw_continuum_material *material,
                             const fw_continuum_options *options, fw_place place, fw_diags *diags,
                             fw_continuum_result *result) {
    const double coarser = 1.5;
    *result = (fw_continuum_result){
        .stiffness_error = (double)NAN, .strain_error = (double)NAN, .centre_error_m = (double)NAN};
    FW_TRY(usable(material, options, place, diags));
    job j = {
        .shape = shape, .material = material, .options = options, .place = place, .diags = diags};
    FW_TRY(fw_continuum_program(arena, "ccx", &j.program));
    if (!j.program) {
        result->missing = fw_continuum_install;
        fw_diag_note(diags, 214, place, "%s", fw_continuum_install);
        return FW_OK;
    }
    result->installed = true;
    double refinement = options->refinement > 0.0 ? options->refinement : 1.0;
    FW_TRY(with_scratch(arena, &j, refinement, options->large, result));
    if (options->one_mesh) return FW_OK;
    fw_continuum_result coarse = {0};
    FW_TRY(with_scratch(arena, &j, refinement / coarser, false, &coarse));
    estimate(&coarse, coarser, result);
    result->cpu_s += coarse.cpu_s;
    return FW_OK;
}
