/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing over continuous dimensions: no isolated values at which parts nearly coincide. */
#include "layout/draw.h"
#include "fixture.h"
#include "test.h"
#include <stdint.h>

static double uniform(uint64_t *state, double low, double high) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

static void set_links(fixture *f, double width_m) {
    for (int i = 0; i < f->device.nbody; i++)
        if (!isnan(f->body[i].width_m)) f->body[i].width_m = width_m;
}

static void mirror(fixture *f) {
    for (int i = 0; i < f->device.nrevolute; i++)
        f->revolute[i].x_m = -f->revolute[i].x_m;
    for (int i = 0; i < f->device.nbody; i++)
        f->body[i].plate_x_m = -f->body[i].plate_x_m;
}

/* least width, space and hollow radius that a mask rule of 4 um and a bias of 1.1 um leave */
static const char *unsound(const fw_geometry_contour *c) {
    if (fw_geometry_contour_clearance(c, true, NULL, NULL) < 4.1e-6) return "width";
    if (fw_geometry_contour_clearance(c, false, NULL, NULL) < 6.3e-6) return "space";
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].kind == FW_ARC && c->segment[i].sweep_rad < 0.0 &&
            c->segment[i].radius < 1.5e-6)
            return "hollow radius";
    return NULL;
}

typedef struct tally {
    int drawn, refused;
} tally;

/* the draw succeeds with every clearance, or one of the listed conflicts is named */
static void draw_one(const fixture *f, bool must, const char *what, double value, tally *t) {
    fw_arena *arena = fw_arena_new(0);
    assert_non_null(arena);
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *l;
    fw_status status = fw_layout_build(arena, &f->device, &diags, &l);
    if (status != FW_OK) {
        assert_int_equal(status, FW_GEOMETRY);
        assert_true(diags.errors > 0);
        int number = diags.item[0].number;
        bool conflict = number >= 120 && number <= 125;
        if (must || !conflict) fail_msg("%s %.6g: %s", what, value, diags.item[0].message);
        t->refused++;
    } else {
        assert_true(l->narrowest_gap_m > 7e-6 * (1.0 - 1e-9));
        for (int i = 0; i < l->npiece && must; i++) {
            if (l->piece[i].role != FW_ROLE_STRUCTURE) continue;
            const char *why = unsound(&l->piece[i].contour);
            if (why) fail_msg("%s %.6g: %s of %s", what, value, why, l->piece[i].label);
        }
        t->drawn++;
    }
    fw_arena_free(arena);
}

/* the ranges that the gallery's device declares, the values that once failed among them */
static void the_declared_ranges_draw_without_exception(void **state) {
    (void)state;
    static const double known[][2] = {
        {254.0, 120e-6}, {253.907, 125.592e-6}, {253.841, 141.713e-6}, {259.333, 111.576e-6}};
    uint64_t random = 7;
    tally t = {0, 0};
    for (int i = 0; i < 48; i++) {
        fixture f;
        fixture_six_bar(&f);
        bool old = i < 4;
        double arc = old      ? known[i][0]
                     : i < 35 ? 140.0 + 4.0 * (i - 4)
                              : uniform(&random, 140, 260);
        fixture_flexures(&f, 1.0, arc);
        set_links(&f, old ? known[i][1] : uniform(&random, 110e-6, 200e-6));
        if (i % 3 == 2) mirror(&f);
        draw_one(&f, true, "arc", arc, &t);
    }
    assert_int_equal(t.drawn, 48);
}

/* lengths, gaps and hinge points beyond any declaration: drawn, or a conflict is named */
static void anything_else_draws_or_names_its_conflict(void **state) {
    (void)state;
    uint64_t random = 11;
    tally t = {0, 0};
    for (int i = 0; i < 30; i++) {
        fixture f;
        fixture_six_bar(&f);
        double factor = uniform(&random, 0.3, 1.5), gap = uniform(&random, 7e-6, 10e-6);
        fixture_flexures(&f, factor, uniform(&random, 140, 260));
        set_links(&f, uniform(&random, 110e-6, 200e-6));
        for (int j = 0; j < f.device.nrevolute; j++) {
            f.flexure[j].gap_m = gap;
            f.revolute[j].x_m += uniform(&random, -100e-6, 100e-6);
            f.revolute[j].y_m += uniform(&random, -100e-6, 100e-6);
        }
        if (i % 2) mirror(&f);
        draw_one(&f, false, "draw", i, &t);
    }
    assert_true(t.drawn >= 24);
}

/* about 0.7 of the lengths the pedestal's edge passes the point where the base's bar is full */
static void lengths_draw_in_fine_steps(void **state) {
    (void)state;
    tally t = {0, 0};
    for (int i = 0; i <= 14; i++) {
        fixture f;
        fixture_six_bar(&f);
        double factor = 0.68 + 0.003 * i;
        fixture_flexures(&f, factor, 240.0);
        draw_one(&f, true, "length factor", factor, &t);
    }
    assert_int_equal(t.drawn, 15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_declared_ranges_draw_without_exception),
        cmocka_unit_test(anything_else_draws_or_names_its_conflict),
        cmocka_unit_test(lengths_draw_in_fine_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
