/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/mesh.h"
#include <math.h>

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

/* ---- one hinge ---- */

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

fw_status fw_continuum_deck_hinge(const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options,
                                  const fw_continuum_mesh *mesh, fw_continuum_deck_steps steps,
                                  fw_text *deck) {
    fw_continuum_deck_head(deck, steps == FW_DECK_LARGE ? "one flexure at finite rotations"
                                                        : "one flexure, unit loads");
    model(shape, material, mesh, deck);
    if (steps == FW_DECK_LARGE)
        large_steps(mesh, options, deck);
    else
        linear_steps(mesh, mesh->depth_m / shape->depth_m, deck);
    return fw_text_end(deck);
}
