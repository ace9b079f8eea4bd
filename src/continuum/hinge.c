/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/deck.h"
#include "continuum/program.h"
#include "continuum/results.h"
#include "base/cancel.h"
#include "base/output.h"
#include <math.h>
#include <string.h>

const char *const fw_continuum_install =
    "CalculiX is not installed (program ccx): on Debian, apt install calculix-ccx";

enum { MOST_BYTES = 400 << 20 };

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

static fw_status bad_shape(fw_diags *diags, fw_place place, const char *why) {
    fw_diag_error(diags, 213, place, "the flexure cannot be meshed: %s", why);
    return FW_GEOMETRY;
}

static fw_status usable(const fw_continuum_material *m, const fw_continuum_options *o,
                        fw_place place, fw_diags *diags) {
    bool good = m->cubic ? m->c44_Pa > 0.0 && m->c11_Pa > fabs(m->c12_Pa) &&
                               m->c11_Pa + 2.0 * m->c12_Pa > 0.0 && isfinite(m->crystal_rad)
                         : m->youngs_Pa > 0.0 && m->poisson > -1.0 && m->poisson < 0.5;
    if (!good) return bad_shape(diags, place, "the elastic constants are not those of a solid");
    if (!(o->refinement == 0.0 || (o->refinement >= 0.5 && o->refinement <= 4.0)))
        return bad_shape(diags, place, "the refinement is not between 0.5 and 4");
    if (o->nangle < 0 || o->nangle > FW_CONTINUUM_ANGLES)
        return bad_shape(diags, place, "there are more angles than steps");
    return FW_OK;
}

static fw_status make_mesh(fw_arena *arena, const fw_continuum_shape *shape, double refinement,
                           bool plane_stress, fw_place place, fw_diags *diags,
                           fw_continuum_mesh *mesh) {
    const char *why = "";
    fw_status status = fw_continuum_mesh_build(arena, shape, refinement, plane_stress, mesh, &why);
    if (status == FW_GEOMETRY) return bad_shape(diags, place, why);
    FW_TRY(status);
    if (!(fw_continuum_mesh_quality(mesh).least_jacobian > 0.02))
        return bad_shape(diags, place,
                         "bricks would fold over at the root; the fillet is too small or too "
                         "large for the width, or the curve too tight");
    return FW_OK;
}

fw_status fw_continuum_hinge_deck(fw_arena *arena, const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options, fw_place place,
                                  fw_diags *diags, fw_text *deck) {
    fw_continuum_mesh mesh;
    FW_TRY(usable(material, options, place, diags));
    FW_TRY(make_mesh(arena, shape, options->refinement > 0.0 ? options->refinement : 1.0,
                     options->plane_stress, place, diags, &mesh));
    return fw_deck_hinge(shape, material, options, &mesh,
                         options->large ? FW_DECK_LARGE : FW_DECK_LINEAR, deck);
}

/* ---- running ---- */

static fw_status failed(const job *j, const fw_program_run *run) {
    if (run->end == FW_PROGRAM_CANCELLED) return FW_CANCELLED;
    if (run->end == FW_PROGRAM_TIMEOUT) {
        char limit[32];
        fw_diag_error(j->diags, 215, j->place,
                      "CalculiX was ended after %s s; refine less, or allow more time",
                      fw_number_text(limit, sizeof limit,
                                     j->options->timeout_s > 0.0 ? j->options->timeout_s : 600.0,
                                     4));
        return FW_LIMIT;
    }
    fw_diag_error(j->diags, 215, j->place,
                  "CalculiX ended with %s %d; run the written deck by "
                  "hand to see its messages",
                  run->code < 0 ? "signal" : "status", run->code < 0 ? -run->code : run->code);
    return FW_SOLVER;
}

static fw_status read_result(const job *j, const fw_program_room *room, const char *name,
                             char **text) {
    size_t n;
    const char *file = fw_arena_printf(j->arena, "%s/%s", room->path, name);
    FW_NEED(file);
    return fw_input_read(j->arena, file, MOST_BYTES, j->diags, text, &n);
}

typedef struct outcome {
    fw_result_step step[FW_RESULT_STEPS];
    fw_result_peak strain[FW_RESULT_STEPS], stress[FW_RESULT_STEPS];
    int fields;
    double cpu_s;
} outcome;

static fw_status run_in(const job *j, const fw_program_room *room, const fw_text *deck, int nstep,
                        outcome *out) {
    const char *argv[] = {j->program, "job", NULL};
    const int node[2] = {j->mesh.nnode + 1, j->mesh.nnode + 2};
    fw_program_run run;
    char *text;
    FW_TRY(fw_program_write(room, "job.inp", deck->data, deck->length));
    FW_TRY(fw_program_call(room, argv, "log.txt",
                           j->options->timeout_s > 0.0 ? j->options->timeout_s : 600.0, &run));
    out->cpu_s = run.cpu_s;
    if (run.end != FW_PROGRAM_DONE) return failed(j, &run);
    FW_TRY(read_result(j, room, "job.dat", &text));
    fw_status status = fw_results_print(text, node, 2, out->step, nstep);
    if (status == FW_OK) {
        FW_TRY(read_result(j, room, "job.frd", &text));
        status = fw_results_fields(text, out->strain, out->stress, nstep, &out->fields);
    }
    for (int i = 0; i < nstep && status == FW_OK; i++)
        if (!out->step[i].have_move[0] || !out->step[i].have_move[1]) status = FW_SOLVER;
    if (status == FW_OK && out->fields < nstep) status = FW_SOLVER;
    if (status == FW_SOLVER)
        fw_diag_error(j->diags, 216, j->place,
                      "CalculiX ended without an error, but its results are incomplete: it did not "
                      "converge, or it writes another format than versions 2.17 to 2.21");
    return status;
}

static fw_status solve(const job *j, fw_deck_steps steps, outcome *out) {
    fw_program_room room;
    fw_text deck = fw_text_new(j->arena);
    int nstep = steps == FW_DECK_LARGE ? j->options->nangle : 3;
    *out = (outcome){0};
    FW_TRY(fw_deck_hinge(j->shape, j->material, j->options, &j->mesh, steps, &deck));
    if (fw_cancel_requested()) return FW_CANCELLED;
    if (fw_program_room_open(&room) != FW_OK) {
        fw_diag_error(j->diags, 215, j->place, "no private directory could be made below TMPDIR");
        return FW_IO;
    }
    fw_status status = run_in(j, &room, &deck, nstep, out);
    fw_program_room_close(&room);
    if (status == FW_IO)
        fw_diag_error(j->diags, 215, j->place,
                      "CalculiX could not be started, or the disk is full");
    return status;
}

/* ---- what follows from the numbers ---- */

/* Compliance C at the shape's centre P from three load cases, made symmetric. Under a moment alone
   the pole, where nothing moves, is P + (-Cy,th, Cx,th)/Cth,th: the centre of compliance; there
   the translations decouple, C' = C_uu - C_u,th C_th,u/Cth,th.
   in: um, uN, uN um; out: m, N, N m. test_continuum.c: tables of finite elements made elsewhere */
static void linear_results(const job *j, const outcome *out, fw_continuum_result *r) {
    const double length = 1e-6, force = 1e-6, moment = 1e-12;
    double c[3][3];
    for (int n = 0; n < 3; n++) {
        const fw_result_step *s = &out->step[n];
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

static void large_results(const job *j, const outcome *out, fw_continuum_result *r) {
    double share = j->shape->depth_m / j->mesh.depth_m;
    r->nlarge = j->options->nangle;
    for (int i = 0; i < r->nlarge; i++) {
        const fw_result_step *s = &out->step[i];
        r->large[i] = (fw_continuum_large){.angle_rad = s->move[1][2],
                                           .moment_Nm = 2e-12 * share * s->force[1][2],
                                           .shift_x_m = 1e-6 * s->move[0][0],
                                           .shift_y_m = 1e-6 * s->move[0][1],
                                           .strain = out->strain[i].principal};
    }
}

static fw_status one_mesh(job *j, double refinement, bool large, fw_continuum_result *r) {
    outcome *out;
    FW_NEED(out = fw_arena_one(j->arena, outcome));
    FW_TRY(make_mesh(j->arena, j->shape, refinement, j->options->plane_stress, j->place, j->diags,
                     &j->mesh));
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
static fw_status with_scratch(job *j, double refinement, bool large, fw_continuum_result *r) {
    FW_NEED(j->arena = fw_arena_new((size_t)2 << 30));
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
    job j = {.shape = shape,
             .material = material,
             .options = options,
             .place = place,
             .diags = diags,
             .program = fw_continuum_program(arena, "ccx")};
    if (!j.program) {
        result->missing = fw_continuum_install;
        fw_diag_note(diags, 214, place, "%s", fw_continuum_install);
        return FW_OK;
    }
    result->installed = true;
    double refinement = options->refinement > 0.0 ? options->refinement : 1.0;
    FW_TRY(with_scratch(&j, refinement, options->large, result));
    if (options->one_mesh) return FW_OK;
    fw_continuum_result coarse = {0};
    FW_TRY(with_scratch(&j, refinement / coarser, false, &coarse));
    estimate(&coarse, coarser, result);
    result->cpu_s += coarse.cpu_s;
    return FW_OK;
}
