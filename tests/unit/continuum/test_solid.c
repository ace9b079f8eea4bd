/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference six-bar of solid flexures against geometrically exact beams in the loop (hinge
   tables, section 2.5): driven by the beams' rotations of AB, EF and CD it must return the loads
   and the platform's position. Needs CalculiX; skipped without. */
#include "continuum/device_deck.h"
#include "shapes.h"
#include "test.h"

enum { AB, BC, CD, DE, EF, BODIES };

/* hinge axes A, F +y, B +x, E -x, C, D -y; the chains from the base to the platform go from the
   first root to the second */
static fw_solid_device six_bar(fw_arena *arena) {
    static const double x[6] = {-700e-6, -1200e-6, -400e-6, 400e-6, 1200e-6, 700e-6};
    static const double y[6] = {-1000e-6, 0, 700e-6, 700e-6, 0, -1000e-6};
    static const double axis[6] = {M_PI / 2, 0, -M_PI / 2, -M_PI / 2, M_PI, M_PI / 2};
    static const int first[6] = {FW_GROUND, AB, BC, DE, EF, FW_GROUND};
    static const int second[6] = {AB, BC, CD, CD, DE, EF};
    static const char *const id[6] = {"A", "B", "C", "D", "E", "F"};
    static const char *const link[BODIES] = {"AB", "BC", "CD", "DE", "EF"};
    fw_solid_device d = {
        .nhinge = 6, .nbody = BODIES, .material = {.youngs_Pa = 147079.09e6, .poisson = 0.22}};
    d.hinge = fw_arena_array(arena, fw_solid_hinge, 6);
    d.body = fw_arena_array(arena, fw_solid_body, BODIES);
    for (int h = 0; h < 6; h++) {
        fw_continuum_shape shape = shape_of(1, FW_ROOT_RIGID);
        double W = shape.centre_x_m;
        d.hinge[h] = (fw_solid_hinge){id[h],
                                      shape,
                                      {x[h] - W * cos(axis[h]), y[h] - W * sin(axis[h]), axis[h]},
                                      first[h],
                                      second[h]};
    }
    for (int b = 0; b < BODIES; b++)
        d.body[b] = (fw_solid_body){
            .id = link[b], .x_m = (x[b] + x[b + 1]) / 2, .y_m = (y[b] + y[b + 1]) / 2};
    return d;
}

typedef struct row { /* GE link rotations, loads, platform */
    const char *name;
    double AB, EF, CD, M_AB, M_EF, M_CD, x_um, y_um;
} row;

static const row rows[] = {
    {"L1", 0.12691051326159716, 0.10655822584113749, 0.03650960718103183, 150000, 50000, 0,
     -155.04022506993311, -21.8362154572784},
    {"L2", -0.05536391012885042, 0.054139879339439284, -1.2500889802526859e-05, -300000, 300000, 0,
     1.3913825568937488, 81.44031273173971},
    {"L6", 0.05355216524668831, 0.051803128877459914, 0.10959798125006724, 0, 0, 300000,
     -40.30551076969056, -4.828665370104318},
};

static void driven(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    if (!fw_continuum_program(arena, "ccx")) {
        fw_arena_free(arena);
        skip();
    }
    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        fw_solid_device d = six_bar(arena);
        fw_solid_result r;
        const double angle[3] = {rows[n].AB, rows[n].CD, rows[n].EF};
        const double moment[3] = {rows[n].M_AB, rows[n].M_CD, rows[n].M_EF};
        static const int body[3] = {AB, CD, EF};
        for (int k = 0; k < 3; k++) {
            d.body[body[k]].driven = true;
            d.body[body[k]].rotation_rad = angle[k];
        }
        fw_status status =
            fw_solid_solve(arena, &d, &(fw_solid_options){.plane_stress = true}, &diags, &r);
        if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no message");
        print_message("%s: x %.4f y %.4f um, moments %.1f %.1f %.1f, strain %.6f at %s; %d bricks, "
                      "%.1f s\n",
                      rows[n].name, r.body[CD].x_m * 1e6, r.body[CD].y_m * 1e6,
                      r.body[AB].moment_Nm * 1e12, r.body[CD].moment_Nm * 1e12,
                      r.body[EF].moment_Nm * 1e12, r.strain, d.hinge[r.strain_hinge].id,
                      r.mesh.elements, r.cpu_s);
        assert_near(r.body[CD].x_m * 1e6, rows[n].x_um, 0.02);
        assert_near(r.body[CD].y_m * 1e6, rows[n].y_um, 0.02);
        for (int k = 0; k < 3; k++) {
            assert_near(r.body[body[k]].rotation_rad, angle[k], 1e-6 * fabs(angle[k]) + 1e-12);
            assert_near(r.body[body[k]].moment_Nm * 1e12, moment[k], 300);
        }
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(driven)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
