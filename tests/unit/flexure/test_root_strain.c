/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain per radian beside solids: tests/data/hinge/root_strain.csv, 20-node bricks (CalculiX,
   src/continuum with 12 elements along a fillet, one more layer across and in depth), E 150 GPa or
   silicon (165.7, 63.9, 79.6 GPa), of silicon the peak stress over 150 GPa. */
#include "flexure/flexure.h"
#include "test.h"

typedef struct row {
    bool leaf, silicon;
    double size, width, angle, fillet, depth, poisson, axis, strain; /* um, deg, 1/rad */
} row;

enum { MOST = 400 };

static int rows_of(row *rows) {
    char line[256], kind[16], material[16];
    int n = 0;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (row *r = rows; n < MOST && fgets(line, sizeof line, file); r++, n++) {
        assert_int_equal(sscanf(line, "%15[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", kind,
                                material, &r->size, &r->width, &r->angle, &r->fillet, &r->depth,
                                &r->poisson, &r->axis, &r->strain),
                         10);
        r->leaf = strcmp(kind, "leaf") == 0, r->silicon = strcmp(material, "silicon") == 0;
    }
    fclose(file);
    return n;
}

static fw_flexure_input input_of(const row *r) {
    double angle = r->angle * M_PI / 180, size = r->size * 1e-6;
    fw_flexure_input in = {.kind = r->leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                           .length_m = r->leaf ? size : size * angle,
                           .angle_rad = angle,
                           .radius_m = r->leaf ? 0 : size,
                           .width_m = r->width * 1e-6,
                           .fillet_m = r->fillet * 1e-6,
                           .depth_m = r->depth * 1e-6,
                           .youngs_Pa = 150e9,
                           .poisson = r->poisson,
                           .strength_Pa = 500e6,
                           .safety_factor = 1};
    if (r->silicon) in.crystal = fw_crystal_cubic(165.7e9, 63.9e9, 79.6e9, r->axis * M_PI / 180);
    return in;
}

/* never below a solid, and not far above; with the fillets that were compared the own estimate
   holds all of it. One figure in ten thousand is what the table is rounded to */
static void never_below_a_solid(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows), counted[2] = {0};
    double most[2] = {0};
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        const fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        double over = o.strain_per_rad / r->strain - 1;
        bool wide = r->fillet > 1.2501 * r->width;
        double top = r->silicon ? 0.0431 : wide ? 0.05 : 0.032;
        if (!(over >= -1e-4 && over <= top))
            fail_msg("row %d: %.4f above the solid, allowed 0 to %.4f", i + 2, over, top);
        if (wide) continue;
        assert_true(fabs(1 / (1 + over) - 1) < o.error.strain);
        most[r->silicon] = fmax(most[r->silicon], over), counted[r->silicon]++;
    }
    assert_true(counted[0] > 150 && counted[1] > 100);
    assert_true(most[0] > 0.02 && most[1] > 0.03); /* the bounds above say something */
}

/* (5), what plane-stress solids gave, is beside it and differs by what the depth does at the root
 */
static void fit_is_beside(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows);
    double low = 2, high = 0;
    for (int i = 0; i < n; i++) {
        const fw_flexure_input in = input_of(&rows[i]);
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        if (rows[i].silicon) continue;
        double t = in.width_m, beam = 0.5 * t / (in.length_m + 2 * o.root_length_m);
        assert_relative(o.strain_per_rad, beam * o.concentration, 1e-13);
        low = fmin(low, o.strain_per_rad / o.strain_fit_per_rad);
        high = fmax(high, o.strain_per_rad / o.strain_fit_per_rad);
    }
    assert_true(low > 0.9 && low < 1 && high > 1.1 && high < 1.15);
}

/* the two fillets of a leaf and the two roots of an arc: mirrored, and from the other end, the same
 */
static void mirrored(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows);
    for (int i = 0; i < n; i++) {
        fw_flexure_input in = input_of(&rows[i]), other = in;
        if (!rows[i].silicon) continue;
        fw_flexure_result a, b;
        other.crystal = fw_crystal_cubic(165.7e9, 63.9e9, 79.6e9, -rows[i].axis * M_PI / 180);
        fw_flexure_closed_form(&in, &a);
        fw_flexure_closed_form(&other, &b);
        assert_relative(a.strain_per_rad, b.strain_per_rad, 1e-12);
        other.crystal = fw_crystal_cubic(165.7e9, 63.9e9, 79.6e9, (double)NAN); /* the worst */
        fw_flexure_closed_form(&other, &b);
        /* per moment; nu of the mean modulus instead of its own */
        assert_true(b.strain_per_rad / b.stiffness_Nm_per_rad >
                    0.97 * a.strain_per_rad / a.stiffness_Nm_per_rad);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(never_below_a_solid),
                                       cmocka_unit_test(fit_is_beside), cmocka_unit_test(mirrored)};
    return cmocka_run_group_tests_name("root_strain", tests, NULL, NULL);
}
