/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One flexure by CalculiX: what decks are made of (device_deck.c uses it, too), its deck, and what comes of it. */
#include "base/constants.h"
#include "continuum/continuum.h"
#include "continuum/solver.h"
#include <math.h>

/* ---- what decks are made of ---- */

void fw_continuum_deck_number(fw_text *deck, double value) {
    fw_text_number(deck, value, 12);
}

void fw_continuum_deck_head(fw_text *deck, const char *what) {
    fw_text_printf(deck,
                   "** SPDX-License-Identifier: GPL-3.0-or-later\n"
                   "** flexwright %s: %s\n"
                   "** input deck of CalculiX: um, uN, MPa (uN/um2), rad, uN um\n",
                   FW_VERSION, what);
}

void fw_continuum_deck_nodes(fw_text *deck, const fw_continuum_mesh *mesh, fw_geometry_pose pose,
                             int first) {
    double c = cos(pose.angle_rad), s = sin(pose.angle_rad);
    for (int i = 0; i <= 2 * mesh->ni; i++)
        for (int j = 0; j <= 2 * mesh->nj; j++)
            for (int k = 0; k <= 2 * mesh->nk; k++) {
                int number = mesh->number[fw_continuum_lattice(mesh, i, j, k)];
                if (!number) continue;
                size_t flat = (size_t)i * (size_t)(2 * mesh->nj + 1) + (size_t)j;
                double x = mesh->x[flat], y = mesh->y[flat];
                fw_text_printf(deck, "%d, ", first + number - 1);
                fw_continuum_deck_number(deck, 1e6 * (pose.x_m + c * x - s * y));
                fw_text_add(deck, ", ");
                fw_continuum_deck_number(deck, 1e6 * (pose.y_m + s * x + c * y));
                fw_text_add(deck, ", ");
                fw_continuum_deck_number(deck, 1e6 * mesh->z[k]);
                fw_text_add(deck, "\n");
            }
}

void fw_continuum_deck_bricks(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                              int first_element) {
    int element = first_element;
    for (int i = 0; i < mesh->ni; i++)
        for (int j = 0; j < mesh->nj; j++)
            for (int k = 0; k < mesh->nk; k++) {
                fw_text_printf(deck, "%d", element++);
                for (int a = 0; a < 20; a++) {
                    const signed char *o = fw_continuum_brick[a];
                    size_t at =
                        fw_continuum_lattice(mesh, 2 * i + o[0], 2 * j + o[1], 2 * k + o[2]);
                    /* a data line holds 16 entries at most */
                    fw_text_printf(deck, a == 10 ? ",\n%d" : ", %d",
                                   first_node + mesh->number[at] - 1);
                }
                fw_text_add(deck, "\n");
            }
}

static void numbers(fw_text *deck, const double *value, int n) {
    for (int i = 0; i < n; i++) {
        if (i > 0) fw_text_add(deck, i == 8 ? ",\n" : ", ");
        fw_continuum_deck_number(deck, value[i]);
    }
    fw_text_add(deck, "\n");
}

void fw_continuum_deck_material(fw_text *deck, const fw_continuum_material *m, const char *name,
                                const char *elset, double turn_rad) {
    if (m->cubic) {
        double at = m->crystal_rad + turn_rad, c = cos(at), s = sin(at);
        fw_text_printf(deck, "*ORIENTATION, NAME=O%s, SYSTEM=RECTANGULAR\n", name);
        numbers(deck, (double[]){c, s, 0.0, -s, c, 0.0}, 6);
    }
    fw_text_printf(deck, "*MATERIAL, NAME=%s\n", name);
    if (m->cubic) {
        double a = 1e-6 * m->c11_Pa, b = 1e-6 * m->c12_Pa, g = 1e-6 * m->c44_Pa;
        fw_text_add(deck, "*ELASTIC, TYPE=ORTHO\n");
        numbers(deck, (double[]){a, b, a, b, b, a, g, g, g}, 9);
    } else {
        fw_text_add(deck, "*ELASTIC\n");
        numbers(deck, (double[]){1e-6 * m->youngs_Pa, m->poisson}, 2);
    }
    fw_text_printf(deck, "*SOLID SECTION, ELSET=%s, MATERIAL=%s", elset, name);
    if (m->cubic) fw_text_printf(deck, ", ORIENTATION=O%s", name);
    fw_text_add(deck, "\n");
}

void fw_continuum_deck_set(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                           fw_continuum_deck_take take) {
    int n = 0;
    for (int i = 0; i <= 2 * mesh->ni; i++)
        for (int j = 0; j <= 2 * mesh->nj; j++)
            for (int k = 0; k <= 2 * mesh->nk; k++) {
                int number = mesh->number[fw_continuum_lattice(mesh, i, j, k)];
                if (!number || !take(mesh, i, j, k)) continue;
                fw_text_printf(deck, "%s%d",
                               n == 0   ? ""
                               : n % 12 ? ", "
                                        : ",\n",
                               first_node + number - 1);
                n++;
            }
    fw_text_add(deck, "\n");
}

bool fw_continuum_deck_root_first(const fw_continuum_mesh *mesh, int i, int j, int k) {
    (void)k;
    return fw_continuum_rigid(mesh, 0, i, j);
}

bool fw_continuum_deck_root_second(const fw_continuum_mesh *mesh, int i, int j, int k) {
    (void)k;
    return fw_continuum_rigid(mesh, 1, i, j);
}

bool fw_continuum_deck_middle(const fw_continuum_mesh *mesh, int i, int j, int k) {
    return k == 0 && !fw_continuum_rigid(mesh, 0, i, j) && !fw_continuum_rigid(mesh, 1, i, j);
}

bool fw_continuum_deck_field(const fw_continuum_mesh *mesh, int i, int j, int k) {
    (void)j, (void)k;
    return i >= 2 * mesh->quiet && i <= 2 * (mesh->ni - mesh->quiet);
}

/* ---- the deck of one flexure ---- */

typedef enum deck_steps { FW_DECK_LINEAR, FW_DECK_LARGE } deck_steps;

static void model(const fw_continuum_shape *shape, const fw_continuum_material *material,
                  const fw_continuum_mesh *mesh, fw_text *deck) {
    const int reference = mesh->nnode + 1, rotation = mesh->nnode + 2;
    fw_text_add(deck, "*NODE, NSET=NALL\n");
    fw_continuum_deck_nodes(deck, mesh, (fw_geometry_pose){0.0, 0.0, 0.0}, 1);
    fw_text_add(deck, "** the point that twist and wrench refer to: translation, rotation\n"
                      "*NODE, NSET=NREF\n");
    for (int n = reference; n <= rotation; n++) {
        fw_text_printf(deck, "%d, ", n);
        numbers(deck, (double[]){1e6 * shape->centre_x_m, 1e6 * shape->centre_y_m, 0.0}, 3);
    }
    fw_text_add(deck, "*ELEMENT, TYPE=C3D20R, ELSET=EALL\n");
    fw_continuum_deck_bricks(deck, mesh, 1, 1);
    fw_text_add(deck, "*NSET, NSET=ROOT1\n");
    fw_continuum_deck_set(deck, mesh, 1, fw_continuum_deck_root_first);
    fw_text_add(deck, "*NSET, NSET=ROOT2\n");
    fw_continuum_deck_set(deck, mesh, 1, fw_continuum_deck_root_second);
    fw_text_add(deck, "*NSET, NSET=MIDDLE\n");
    fw_continuum_deck_set(deck, mesh, 1, fw_continuum_deck_middle);
    fw_text_add(deck, "** flexure and fillets: where strain is looked for\n*NSET, NSET=FIELD\n");
    fw_continuum_deck_set(deck, mesh, 1, fw_continuum_deck_field);
    fw_continuum_deck_material(deck, material, "M", "EALL", 0.0);
    fw_text_printf(deck,
                   "*RIGID BODY, NSET=ROOT2, REF NODE=%d, ROT NODE=%d\n"
                   "** the upper half of the depth is meshed; its middle plane stays plane\n"
                   "*BOUNDARY\nROOT1, 1, 3\nMIDDLE, 3, 3\n%d, 3, 3\n%d, 1, 2\n",
                   reference, rotation, reference, rotation);
}

static void linear_steps(const fw_continuum_mesh *mesh, double depth_share, fw_text *deck) {
    const int reference = mesh->nnode + 1, rotation = mesh->nnode + 2;
    static const char *const name[3] = {"1 uN along x", "1 uN along y", "1 uN um about z"};
    for (int n = 0; n < 3; n++) {
        fw_text_printf(deck, "** %s, half of it on the half of the depth\n", name[n]);
        fw_text_add(deck, "*STEP\n*STATIC, SOLVER=SPOOLES\n*CLOAD, OP=NEW\n");
        fw_text_printf(deck, "%d, %d, ", n < 2 ? reference : rotation, n < 2 ? n + 1 : 3);
        fw_continuum_deck_number(deck, 0.5 * depth_share);
        fw_text_add(deck, "\n*NODE PRINT, NSET=NREF\nU\n");
        if (n == 2) fw_text_add(deck, "*EL FILE, NSET=FIELD\nS, E\n");
        fw_text_add(deck, "*END STEP\n");
    }
}

static void large_steps(const fw_continuum_mesh *mesh, const fw_continuum_options *options,
                        fw_text *deck) {
    fw_text_add(deck, "** the default residual of 0.5 % shows in the shift of the centre\n");
    for (int n = 0; n < options->nangle; n++) {
        fw_text_add(deck, "*STEP, NLGEOM, INC=200\n*STATIC, SOLVER=SPOOLES\n1., 1., 1e-4, 1.\n");
        fw_text_add(deck, "*CONTROLS, PARAMETERS=FIELD\n1e-6, 1e-6, , , 1e-6\n");
        fw_text_printf(deck, "*BOUNDARY\n%d, 3, 3, ", mesh->nnode + 2);
        fw_continuum_deck_number(deck, options->angle_rad[n]);
        fw_text_add(deck, "\n*NODE PRINT, NSET=NREF\nU, RF\n*EL FILE, NSET=FIELD\nS, E\n"
                          "*END STEP\n");
    }
}

static fw_status hinge_deck(const fw_continuum_shape *shape, const fw_continuum_material *material,
                            const fw_continuum_options *options, const fw_continuum_mesh *mesh,
                            deck_steps steps, fw_text *deck) {
    fw_continuum_deck_head(deck, steps == FW_DECK_LARGE ? "one flexure at finite rotations"
                                                        : "one flexure, unit loads");
    model(shape, material, mesh, deck);
    if (steps == FW_DECK_LARGE)
        large_steps(mesh, options, deck);
    else
        linear_steps(mesh, mesh->depth_m / shape->depth_m, deck);
    return fw_text_end(deck);
}

/* ---- the shape of a flexure ---- */

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

/* ---- runs ---- */

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
    return hinge_deck(shape, material, options, &mesh,
                      options->large ? FW_DECK_LARGE : FW_DECK_LINEAR, deck);
}

static fw_status solve(const job *j, deck_steps steps, fw_continuum_solver_result *out) {
    fw_text deck = fw_text_new(j->arena);
    const int node[2] = {j->mesh.nnode + 1, j->mesh.nnode + 2};
    FW_TRY(hinge_deck(j->shape, j->material, j->options, &j->mesh, steps, &deck));
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
