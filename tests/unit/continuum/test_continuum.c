/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solver on our meshes against finite elements made with another mesher (gmsh, wedges, two to
   four times as many bricks), the closed form and beam theory. Needs CalculiX; skipped without. */
#include "base/arena.h"
#include "shapes.h"
#include "test.h"
#include <stdlib.h>

typedef struct rig {
    fw_arena *arena;
    fw_diags diags;
} rig;

static int open_rig(void **state) {
    static rig r;
    r.arena = fw_arena_new(0);
    r.diags = fw_diags_new(r.arena);
    *state = &r;
    return r.arena ? 0 : -1;
}

static int close_rig(void **state) {
    fw_arena_free(((rig *)*state)->arena);
    return 0;
}

static fw_continuum_result solved(rig *r, const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options) {
    fw_continuum_result result;
    const char *ccx;
    assert_int_equal(fw_continuum_program(r->arena, "ccx", &ccx), FW_OK);
    if (!ccx) skip();
    fw_status status =
        fw_continuum_hinge(r->arena, shape, material, options, (fw_place){0}, &r->diags, &result);
    if (status != FW_OK && r->diags.count > 0) fail_msg("%s", r->diags.item[0].message);
    assert_int_equal(status, FW_OK);
    assert_true(result.installed);
    return result;
}

/* K, W, Kx, Ky, peak strain of fe_realroot_3d.csv, finest rows; our own mesh is off by what it says
   of itself at most, and it says little */
static void real_roots(void **state) {
    static const struct {
        double K, W, Kx, Ky, strain, stress;
    } want[4] = {{0},
                 {769198.6, 29.8787, 127.020, 251.951, 0.0116256, 2059.5},
                 {2235484.8, 63.1165, 443.768, 2269.21, 0.0225749, 3993.2},
                 {181755.1, 29.3113, 30.0111, 58.6924, 0.0143936, 1720.2}};
    for (int which = 1; which <= 3; which++) {
        fw_continuum_shape shape = shape_of(which, FW_ROOT_BLOCK);
        fw_continuum_material material = material_of(which);
        fw_continuum_result r =
            solved(*state, &shape, &material, &(fw_continuum_options){.refinement = 1});
        print_message("H%d: K %.1f W %.4f Kx %.4f Ky %.4f strain %.6f stress %.1f mises %.1f at "
                      "(%.2f %.2f %.2f); errors %.1e %.1e um %.1e; %d bricks, %.2f s\n",
                      which, r.stiffness_Nm_per_rad * 1e12, r.centre_x_m * 1e6, r.kx_N_per_m,
                      r.ky_N_per_m, r.strain_per_rad, r.stress_per_rad_Pa * 1e-6,
                      r.mises_per_rad_Pa * 1e-6, r.peak_x_m * 1e6, r.peak_y_m * 1e6,
                      r.peak_z_m * 1e6, r.stiffness_error, r.centre_error_m * 1e6, r.strain_error,
                      r.mesh.elements, r.cpu_s);
        assert_relative(r.stiffness_Nm_per_rad * 1e12, want[which].K, 0.001);
        assert_near(r.centre_x_m * 1e6, want[which].W, 0.05);
        assert_near(r.centre_y_m * 1e6, 0.0, 1e-4);
        assert_relative(r.kx_N_per_m, want[which].Kx, 0.002);
        assert_relative(r.ky_N_per_m, want[which].Ky, 0.002);
        assert_relative(r.strain_per_rad, want[which].strain, 0.02);
        /* ours is off by some 1 %, the table by 1 to 2 % */
        assert_relative(r.stress_per_rad_Pa * 1e-6, want[which].stress, 0.03);
        assert_true(r.stiffness_error < 0.001 && r.centre_error_m < 0.05e-6);
        assert_true(r.strain_error < 0.05);
        assert_true(fabs(r.strain_per_rad / want[which].strain - 1) < r.strain_error + 0.01);
        assert_relative(r.compliance[1][2], r.compliance[2][1], 1e-12);
    }
}

/* rigid ends: 3-D rows of the table; the leaf beside the closed form too */
static void rigid_ends(void **state) {
    static const double K[5] = {0, 771901.9, 2259968.6, 183223.3, 767802.8};
    static const double W[5] = {0, 30.2353, 63.8061, 30.1160, 0};
    static const double Kx[5] = {0, 127.396, 453.573, 30.19, 41.717};
    for (int which = 1; which <= 4; which += 3) {
        fw_continuum_shape shape = shape_of(which, FW_ROOT_RIGID);
        fw_continuum_material material = material_of(which);
        fw_continuum_result r = solved(*state, &shape, &material,
                                       &(fw_continuum_options){.refinement = 1, .one_mesh = true});
        assert_relative(r.stiffness_Nm_per_rad * 1e12, K[which], 0.002);
        assert_near(r.centre_x_m * 1e6, W[which], 0.05);
        assert_relative(r.kx_N_per_m, Kx[which], 0.003);
        assert_true(isnan(r.stiffness_error));
    }
}

/* a leaf with real roots has no table: the closed form, within its own stated error */
static void leaf_with_roots(void **state) {
    fw_flexure_input in = flexure_of(4);
    fw_flexure_result closed;
    fw_continuum_shape shape;
    fw_flexure_closed_form(&in, &closed);
    fw_continuum_shape_of(&in, &shape);
    fw_continuum_material material = material_of(4);
    fw_continuum_result r = solved(*state, &shape, &material,
                                   &(fw_continuum_options){.refinement = 1, .one_mesh = true});
    assert_relative(r.stiffness_Nm_per_rad, closed.stiffness_Nm_per_rad, 0.005);
    assert_near(r.centre_x_m, 0, 1e-9);
    assert_near(r.centre_y_m, 0, 1e-9);
    assert_relative(r.strain_per_rad, closed.strain_per_rad, 0.03);
}

/* one thin layer: plane stress, where Golovin's exact bending of a curved beam holds */
static void plane_stress(void **state) {
    fw_continuum_shape shape = shape_of(1, FW_ROOT_RIGID);
    fw_continuum_material material = material_of(1);
    fw_continuum_options options = {.refinement = 1.5, .plane_stress = true, .one_mesh = true};
    fw_continuum_result r = solved(*state, &shape, &material, &options);
    assert_relative(r.stiffness_Nm_per_rad * 1e12, 765023.6, 0.0005);
    assert_near(r.centre_x_m * 1e6, 30.0053, 0.01);
    assert_relative(r.kx_N_per_m, 126.191, 0.0005);
    assert_relative(r.ky_N_per_m, 251.265, 0.0005);
    shape.root = FW_ROOT_BLOCK;
    r = solved(*state, &shape, &material, &options);
    assert_relative(r.stiffness_Nm_per_rad * 1e12, 762495.5, 0.0005);
    assert_near(r.centre_x_m * 1e6, 29.6734, 0.02);
    assert_relative(r.strain_per_rad, 0.0110738, 0.02);
}

/* silicon (100): the hinge's axis at 0 and 22.5 degrees from <100>; fe_realroot_3d.csv */
static void silicon(void **state) {
    static const double K[2] = {674491.7, 675783.4}, x[2] = {30.1922, 30.1172}, y[2] = {0, -1.0344};
    static const double stress[2] = {2005.8, 2088.8};
    for (int n = 0; n < 2; n++) {
        fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
        fw_continuum_material material = {.cubic = true,
                                          .c11_Pa = 165.7e9,
                                          .c12_Pa = 63.9e9,
                                          .c44_Pa = 79.6e9,
                                          .crystal_rad = -n * M_PI / 8};
        fw_continuum_result r =
            solved(*state, &shape, &material, &(fw_continuum_options){.one_mesh = true});
        assert_relative(r.stiffness_Nm_per_rad * 1e12, K[n], 0.001);
        assert_near(r.centre_x_m * 1e6, x[n], 0.05);
        assert_near(r.centre_y_m * 1e6, y[n], 0.02);
        assert_relative(r.stress_per_rad_Pa * 1e-6, stress[n], 0.03);
    }
}

/* finite rotation in plane stress against the exact shift of the elastica,
   delta = r th (sinc a sinc th/2 - sinc(a + th/2)), and M = K th; winding and unwinding */
static void finite_rotation(void **state) {
    fw_continuum_shape shape = shape_of(1, FW_ROOT_RIGID);
    fw_continuum_material material = material_of(1);
    const double deg = M_PI / 180, a = 135 * deg;
    fw_continuum_options options = {.refinement = 1,
                                    .plane_stress = true,
                                    .one_mesh = true,
                                    .large = true,
                                    .nangle = 3,
                                    .angle_rad = {5 * deg, 10 * deg, -10 * deg}};
    fw_continuum_result r = solved(*state, &shape, &material, &options);
    assert_int_equal(r.nlarge, 3);
    for (int n = 0; n < 3; n++) {
        double th = options.angle_rad[n], e = a + th / 2;
        double delta = 100e-6 * th * (sin(a) / a * sin(th / 2) / (th / 2) - sin(e) / e);
        /* of W as the mesh has it, which the linear run says */
        double off = shape.centre_x_m - r.centre_x_m;
        double x = -delta * sin(th / 2) + off * (cos(th) - 1);
        double y = delta * cos(th / 2) + off * sin(th);
        assert_relative(r.large[n].angle_rad, th, 1e-6);
        assert_near(r.large[n].shift_x_m, x, 0.005e-6);
        assert_near(r.large[n].shift_y_m, y, 0.005e-6);
        assert_relative(r.large[n].moment_Nm, r.stiffness_Nm_per_rad * th, 0.0005);
        assert_relative(r.large[n].strain, fabs(th) * r.strain_per_rad, 0.01);
    }
}

/* real roots and depth at 1 and 10 degrees; fe_realroot_3d_nlgeom.csv, H3 */
static void finite_rotation_of_a_foil(void **state) {
    fw_continuum_shape shape = shape_of(3, FW_ROOT_BLOCK);
    fw_continuum_material material = material_of(3);
    fw_continuum_options options = {.refinement = 1,
                                    .one_mesh = true,
                                    .large = true,
                                    .nangle = 2,
                                    .angle_rad = {M_PI / 36, M_PI / 18}};
    static const double M[2] = {15864.22, 31726.40}, x[2] = {-0.00968, -0.06620},
                        y[2] = {0.22170, 0.75666}, strain[2] = {0.0012570, 0.0025145};
    fw_continuum_result r = solved(*state, &shape, &material, &options);
    for (int n = 0; n < 2; n++) {
        assert_relative(r.large[n].moment_Nm * 1e12, M[n], 0.001);
        assert_near(r.large[n].shift_x_m * 1e6, x[n], 0.005);
        assert_near(r.large[n].shift_y_m * 1e6, y[n], 0.005);
        assert_relative(r.large[n].strain, strain[n], 0.02);
    }
}

static void not_installed(void **state) {
    rig *r = *state;
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_continuum_material material = material_of(1);
    fw_continuum_result result;
    const char *path = getenv("PATH");
    char *kept = fw_arena_strdup(r->arena, path ? path : "");
    setenv("PATH", "/nonexistent", 1);
    fw_status status = fw_continuum_hinge(r->arena, &shape, &material, &(fw_continuum_options){0},
                                          (fw_place){0}, &r->diags, &result);
    setenv("PATH", kept, 1);
    assert_int_equal(status, FW_OK);
    assert_false(result.installed);
    assert_string_equal(result.missing, fw_continuum_install);
    assert_int_equal(r->diags.item[0].number, 214);
}

static void time_and_cancel(void **state) {
    rig *r = *state;
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_continuum_material material = material_of(1);
    fw_continuum_result result;
    fw_continuum_options options = {.refinement = 1, .timeout_s = 1e-3};
    const char *ccx;
    assert_int_equal(fw_continuum_program(r->arena, "ccx", &ccx), FW_OK);
    if (!ccx) skip();
    assert_int_equal(fw_continuum_hinge(r->arena, &shape, &material, &options, (fw_place){0},
                                        &r->diags, &result),
                     FW_LIMIT);
    assert_int_equal(r->diags.item[0].number, 215);
    fw_cancel cancel = {.number = 2};
    fw_arena_stop_with(r->arena, &cancel);
    assert_int_equal(fw_continuum_hinge(r->arena, &shape, &material, &options, (fw_place){0},
                                        &r->diags, &result),
                     FW_CANCELLED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(real_roots, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(rigid_ends, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(leaf_with_roots, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(plane_stress, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(silicon, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(finite_rotation, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(finite_rotation_of_a_foil, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(not_installed, open_rig, close_rig),
        cmocka_unit_test_setup_teardown(time_and_cancel, open_rig, close_rig),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
