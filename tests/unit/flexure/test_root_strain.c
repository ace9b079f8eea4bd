/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain per radian beside solids: tests/data/hinge/root_strain.csv, made by tools/solids.
   Mesh of src/continuum with 12 elements along a fillet, one more across half the width and in
   depth (16, two and two more where a coarser mesh is named beside it; deeper than 10 t two or
   three more in depth), 20-node bricks solved by CalculiX, half of the strip, its middle section
   held plane and turned; strains not those CalculiX extrapolates to nodes, which scatter by 1 to 2
   %, but by the surface's own displacements at the points where their derivatives converge fastest,
   a cubic through six of them along the fillet. Two meshes differ by 0.12 % (rms), at most 0.43 %.
   E 150 GPa or silicon (165.7, 63.9, 79.6 GPa), of silicon the peak stress over 150 GPa; of an arc
   of silicon that is not its own mirror image either half.
 */
#include "solid_input.h"
#include "test.h"
#include <stdlib.h>

typedef struct row {
    bool silicon;
    solid_shape shape;
    double axis, strain; /* deg, 1/rad */
    double coarser;      /* 0: one mesh only */
    double stiffness;    /* N m/rad; 0: not in the table */
} row;

enum { MOST = 1300 };

static int rows_in(const char *path, row *rows) {
    char line[256], kind[16], material[16];
    int n = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (row *r = rows; n < MOST && fgets(line, sizeof line, file); r++, n++) {
        int read = 0;
        r->coarser = r->stiffness = 0;
        assert_int_equal(sscanf(line, "%15[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%*d,%n",
                                kind, material, &r->shape.size, &r->shape.width, &r->shape.angle,
                                &r->shape.fillet, &r->shape.depth, &r->shape.poisson, &r->axis,
                                &r->strain, &read),
                         10);
        char *next = line + read;
        if (*next != ',') r->coarser = strtod(next, &next);
        if (*next == ',') r->stiffness = strtod(next + 1, NULL);
        r->silicon = strcmp(material, "silicon") == 0;
        assert_true((strcmp(kind, "leaf") == 0) == (r->shape.angle == 0));
    }
    fclose(file);
    return n;
}

static int rows_of(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain.csv", rows);
}

/* random shapes within the range of the narrow band, with their stiffness */
static int held_out(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_held_out.csv", rows);
}

/* others; fitted since */
static int unseen(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_unseen.csv", rows);
}

/* drawn and solved when all fits were made */
static int after(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_after.csv", rows);
}

static fw_flexure_input input_of(const row *r) {
    fw_flexure_input in = solid_input(&r->shape);
    if (r->silicon)
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, r->axis * FW_PI / 180);
    return in;
}

/* of the narrow band: fillets from t/10 (silicon 0.15 t) to 1.25 t, no deeper than 10 t */
static bool inside(const row *r) {
    double x = r->shape.fillet / r->shape.width;
    return x > (r->silicon ? 0.1499 : 0.0999) && x < 1.2501 &&
           r->shape.depth < 10.001 * r->shape.width;
}

static double above(const row *r, const fw_flexure_result *o) {
    return o->strain_per_rad / r->strain - 1;
}

/* of a crystal both ends reach each other, and it is strained less */
static bool short_strip(const row *r) {
    double length = r->shape.size * (r->shape.angle == 0 ? 1 : r->shape.angle * FW_PI / 180);
    return r->silicon && length < 2.45 * r->shape.depth;
}

/* at most this far above a solid: isotropic, leaves and arcs of silicon, within the range of the narrow
   band and beyond it */
static double most_above(const row *r) {
    if (!r->silicon) return inside(r) ? 0.0068 : 0.05;
    if (r->shape.angle == 0) return inside(r) ? (short_strip(r) ? 0.02 : 0.0083) : 0.06;
    return inside(r) ? 0.0098 : 0.052;
}

/* never below a solid, and not far above; the own estimate holds all of it. One figure in ten thousand
   is what the table is rounded to */
static void never_below_a_solid(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_more.csv", rows);
    assert_true(n > 480);
    n += rows_of(rows + n);
    assert_true(n < MOST);
    int counted[2] = {0}, outside = 0;
    double most[2] = {0};
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        const fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        double over = above(r, &o);
        double top = most_above(r);
        if (!(over >= -1e-4 && over <= top))
            fail_msg("row %d: %.4f above the solid, allowed 0 to %.4f", i + 2, over, top);
        assert_true(fabs(1 / (1 + over) - 1) < o.error.strain);
        outside += !inside(r);
        if (inside(r)) most[r->silicon] = fmax(most[r->silicon], over), counted[r->silicon]++;
    }
    assert_true(counted[0] > 500 && counted[1] > 480 && outside > 100);
    assert_true(most[0] > 0.006 && most[1] > 0.009); /* the bounds above say something */
}

/* the same of others, and the stiffness with what the ends lose (13a): of a crystal what is off by is stated as it is
   more and as it is less */
static void stiffness_of_solids(void **state) {
    (void)state;
    static row rows[MOST];
    int n = held_out(rows);
    n += rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_more.csv", rows + n);
    const int fitted = n;
    n += after(rows + n);
    double square = 0;
    int counted = 0;
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        in.ends = true;
        fw_flexure_closed_form(&in, &o);
        double over = above(r, &o), off = o.stiffness_Nm_per_rad / r->stiffness - 1;
        double top = most_above(r);
        if (i < fitted && !(over >= (inside(r) ? -2e-4 : -o.error.above) && over <= top))
            fail_msg("row %d: %.4f above the solid", i + 2, over);
        if (!(r->stiffness > 0)) continue;
        double stated = off > 0 ? o.error.softer : o.error.stiffness;
        in.ends = false; /* and as it is printed */
        fw_flexure_result p;
        fw_flexure_closed_form(&in, &p);
        double printed = r->stiffness / p.stiffness_Nm_per_rad - 1;
        if (!(printed > -p.error.softer && printed < p.error.stiffness))
            fail_msg("row %d: stiffness %.4f, stated %.4f less and %.4f more", i + 2, printed,
                     p.error.softer, p.error.stiffness);
        if (!(fabs(off) < stated))
            fail_msg("row %d: stiffness off by %.4f, stated %.4f", i + 2, off, stated);
        assert_true(o.error.stiffness < (o.error.outside ? 0.08 : 0.04));
        square += off * off, counted++;
    }
    assert_true(counted > 600 && sqrt(square / counted) < 0.002);
}

/* none is above the bound, and none further below it than stated */
static void beside_the_bound(const row *rows, int n) {
    int rounded = 0;
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        const fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        assert_true(inside(r));
        fw_flexure_closed_form(&in, &o);
        double sharpest = (r->silicon ? 0.15 : 0.1) * in.width_m;
        if (o.error.outside || in.depth_m > 10 * in.width_m || in.length_m < 16 * in.width_m ||
            in.fillet_m < sharpest) { /* the range's end, rounded */
            rounded++;
            continue;
        }
        double solid = r->strain / o.strain_per_rad - 1;
        if (!(solid < 0 && solid > -o.error.strain))
            fail_msg("row %d: %.4f beside the bound, stated %.4f", i + 2, solid, o.error.strain);
        bool arc = r->silicon && r->shape.angle > 0;
        assert_true(o.error.strain < (arc ? 0.0146 : 0.0111) + (short_strip(r) ? 0.012 : 0));
    }
    assert_true(10 * rounded < n);
}

/* solids of all kinds that were drawn and solved when the fits were made, and those that were unseen of a former one */
static void solids_that_no_fit_has_seen(void **state) {
    (void)state;
    static row rows[MOST];
    int n = unseen(rows);
    beside_the_bound(rows, n);
    assert_true(n > 50);
    n = after(rows);
    beside_the_bound(rows, n);
    assert_true(n > 150);
}

/* Deeper than 10 widths, to 20, or shorter than 16, to 8 (of the second file: drawn when the law was chosen): none is above the bound, and how far below is stated as it grows with
   either; the stiffness is off by what is stated without a doubling */
static void deep_and_short(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_beyond.csv", rows);
    n += rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_beyond_after.csv", rows + n);
    double stated = 0;
    int within = 0;
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        fw_flexure_input in = input_of(r);
        fw_flexure_result o, with;
        fw_flexure_closed_form(&in, &o);
        in.ends = true;
        fw_flexure_closed_form(&in, &with);
        const double solid = r->strain / o.strain_per_rad - 1;
        if (!(solid < 0 && solid > -o.error.strain))
            fail_msg("row %d: %.4f beside the bound, stated %.4f", i + 2, solid, o.error.strain);
        const double printed = r->stiffness / o.stiffness_Nm_per_rad - 1,
                     off = r->stiffness / with.stiffness_Nm_per_rad - 1;
        if (!(printed > -o.error.softer && printed < o.error.stiffness &&
              off > -with.error.softer && off < with.error.stiffness))
            fail_msg(
                "row %d: stiffness %.4f and, with ends, %.4f beside it, stated -%.4f to %.4f and "
                "-%.4f to %.4f",
                i + 2, printed, off, o.error.softer, o.error.stiffness, with.error.softer,
                with.error.stiffness);
        assert_int_equal(o.error.outside, in.depth_m > in.length_m);
        if (!o.error.outside) stated += o.error.strain, within++;
    }
    assert_true(n > 80 &&
                stated / n <
                    0.035); /* twice 2.5 % before, of arcs of silicon less than they have */
}

/* Isotropic arcs from t/r = 0.15 to 0.3 (of the second file: drawn when their figures were chosen): strain, stiffness and
   strain per moment, as printed and with the ends */
static void thick_arcs(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_thick.csv", rows);
    const int first = n;
    n += rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_thick_after.csv", rows + n);
    double down = 0, up = 0, narrow = 0;
    int wide = 0;
    for (int i = 0; i < 2 * n; i++) {
        const row *r = &rows[i % n];
        fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        in.ends = i >= n;
        fw_flexure_closed_form(&in, &o);
        const fw_flexure_error *e = &o.error;
        const double strain = r->strain / o.strain_per_rad - 1,
                     stiffness = r->stiffness / o.stiffness_Nm_per_rad - 1,
                     per_Nm = (1 + strain) / (1 + stiffness) - 1;
        assert_true(in.width_m > 0.1499 * in.radius_m && in.width_m <= 0.3 * in.radius_m);
        if (!(strain > -e->strain && strain < e->above))
            fail_msg("row %d: strain %.4f, stated -%.4f to %.4f", i % n + 2, strain, e->strain,
                     e->above);
        if (!(stiffness > -e->softer && stiffness < e->stiffness))
            fail_msg("row %d: stiffness %.4f, stated -%.4f to %.4f", i % n + 2, stiffness,
                     e->softer, e->stiffness);
        if (!(per_Nm > -e->strain - e->load_less && per_Nm < e->above + e->load_more))
            fail_msg("row %d: %.4f per moment", i % n + 2, per_Nm);
        down = fmin(down, strain), up = fmax(up, strain);
        if (e->above > 0.01)
            wide++;
        else
            narrow += e->strain + e->above;
    }
    assert_true(first > 80 && n - first > 40 && down < -0.02 && up > 0.03);
    assert_true(wide < n && narrow / (2 * n - wide) < 0.04); /* it was 6.6 % */
}

/* Strain per moment is off by less than strain per radian and stiffness together, since both are of one solid: none is
   above the bound, and the band of a verdict, which has it, holds those that no fit has seen, too */
static void strain_per_moment_of(bool ends) {
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_more.csv", rows), counted = 0;
    n += held_out(rows + n);
    n += after(rows + n);
    double narrower = 0, least = 1, most = -1;
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        fw_flexure_input in = input_of(r);
        fw_flexure_result o;
        in.ends = ends;
        fw_flexure_closed_form(&in, &o);
        const fw_flexure_error *e = &o.error;
        if (!(r->stiffness > 0) || !inside(r) || e->outside) continue;
        double off = r->strain / o.strain_per_rad / (r->stiffness / o.stiffness_Nm_per_rad) - 1;
        least = fmin(least, off + e->strain + e->load_less), most = fmax(most, off - e->load_more);
        narrower += e->root_less - e->load_less + e->root_more - e->load_more, counted++;
    }
    assert_true(counted > 600);
    /* arcs that are counted with their ends are up to 0.09 % below it */
    if (!(least > 0.001 && most < (ends ? -0.0008 : -0.001)))
        fail_msg("%.4f below, %.4f above", least, most);
    assert_true(narrower / counted > (ends ? 0.005 : 0.007));
}

static void strain_per_moment(void **state) {
    (void)state;
    strain_per_moment_of(false);
    strain_per_moment_of(true);
}

/* A leaf that is guided and moved by a given way: its stiffness across is as much more than the closed form's as that
   of a turn, two and a half times, and so the moment is more at the same strain per radian */
static void held_in_place_of(bool ends) {
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/root_strain_more.csv", rows), counted = 0;
    n += held_out(rows + n);
    n += after(rows + n);
    double worst = -1;
    for (int i = 0; i < n; i++) {
        const row *r = &rows[i];
        fw_flexure_input in = input_of(r);
        fw_flexure_result o, printed;
        fw_flexure_closed_form(&in, &printed);
        in.ends = ends;
        fw_flexure_closed_form(&in, &o);
        if (!(r->stiffness > 0) || !inside(r) || r->shape.angle > 0 || o.error.outside) continue;
        /* two and a half times is of leaves up to a quarter as deep as long (table of docs/theory/flexure-errors.md) */
        if (ends && in.depth_m > 0.25 * in.length_m) continue;
        double stiffer = r->stiffness / printed.stiffness_Nm_per_rad;
        double across = pow(stiffer, 2.5) * printed.kx_N_per_m / o.kx_N_per_m;
        double most = r->strain / o.strain_per_rad * across * o.stiffness_Nm_per_rad / r->stiffness;
        worst = fmax(worst, most - 1 - o.error.above - o.error.root_more), counted++;
    }
    assert_true(counted > (ends ? 300 : 450));
    if (!(worst < 0)) fail_msg("%.4f above", worst);
}

static void held_in_place(void **state) {
    (void)state;
    held_in_place_of(false);
    held_in_place_of(true);
}

/* what a solid's own mesh is off by: two of them */
static void solids_agree_with_themselves(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows), twice = 0;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        if (!(rows[i].coarser > 0)) continue;
        double off = rows[i].coarser / rows[i].strain - 1;
        assert_true(fabs(off) < 0.0045);
        sum += off * off, twice++;
    }
    assert_true(twice > 80 && sqrt(sum / twice) < 0.0015);
}

/* An independent program's meshes (free quadrilaterals swept to 20-node bricks, CalculiX, strains
   as CalculiX has them at its nodes): H1, H2, H3 of docs/theory, uN um. Of H1 of silicon by
   direction: test_crystal.c */
static void never_below_the_reference(void **state) {
    (void)state;
    const row fe[] = {{.shape = {100, 8, 270, 4, 50, 0.22}, .strain = 0.01162555},
                      {.shape = {100, 10, 180, 4, 50, 0.22}, .strain = 0.0225749},
                      {.shape = {100, 10, 270, 4, 9, 0.34}, .strain = 0.01443857}};
    for (int i = 0; i < 3; i++) {
        const fw_flexure_input in = input_of(&fe[i]);
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        assert_true(o.strain_per_rad >= fe[i].strain && o.strain_per_rad <= 1.04 * fe[i].strain);
    }
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
        if (rows[i].silicon || rows[i].shape.depth > 10.001 * rows[i].shape.width) continue;
        double t = in.width_m, ended = o.ends_stiffer / (in.length_m + 2 * o.root_length_m);
        double beam = 0.5 * t * ended;
        assert_relative(o.strain_per_rad, beam * o.concentration, 1e-13);
        low = fmin(low, o.strain_per_rad / o.strain_fit_per_rad);
        high = fmax(high, o.strain_per_rad / o.strain_fit_per_rad);
    }
    if (!(low > 0.9 && low < 1 && high > 1.1 && high < 1.15)) fail_msg("%.4f to %.4f", low, high);
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
        other.crystal =
            fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, -rows[i].axis * FW_PI / 180);
        fw_flexure_closed_form(&in, &a);
        fw_flexure_closed_form(&other, &b);
        assert_relative(a.strain_per_rad, b.strain_per_rad, 1e-12);
        other.crystal =
            fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, (double)NAN); /* the worst */
        fw_flexure_closed_form(&other, &b);
        /* per moment; nu of the mean modulus instead of its own */
        assert_true(b.strain_per_rad / b.stiffness_Nm_per_rad >
                    0.97 * a.strain_per_rad / a.stiffness_Nm_per_rad);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(never_below_a_solid),
                                       cmocka_unit_test(stiffness_of_solids),
                                       cmocka_unit_test(solids_that_no_fit_has_seen),
                                       cmocka_unit_test(deep_and_short),
                                       cmocka_unit_test(thick_arcs),
                                       cmocka_unit_test(strain_per_moment),
                                       cmocka_unit_test(held_in_place),
                                       cmocka_unit_test(solids_agree_with_themselves),
                                       cmocka_unit_test(never_below_the_reference),
                                       cmocka_unit_test(fit_is_beside),
                                       cmocka_unit_test(mirrored)};
    return cmocka_run_group_tests_name("root_strain", tests, NULL, NULL);
}
