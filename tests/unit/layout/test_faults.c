/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layouts that cannot be made: what is shown of them, and the places of their faults, on devices
   whose hinges and plates are moved by random amounts. */
#include "fixture.h"
#include "layout/layout.h"
#include "test.h"
#include <math.h>
#include <string.h>

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
    fw_status status;
} drawn;

static drawn draw(const fixture *f) {
    drawn d = {.arena = fw_arena_new(0)};
    d.diags = fw_diags_new(d.arena);
    d.status = fw_layout_build(d.arena, &f->device, &d.diags, &d.layout);
    return d;
}

static double uniform(uint64_t *state, double from, double to) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*state >> 11) / 9007199254740992.0;
}

/* a device is either drawn without a fault, or shown with every error as a fault */
static void every_error_is_a_fault(const drawn *d, const fw_device *device) {
    size_t errors = 0;
    assert_true(d->status == FW_OK || d->status == FW_GEOMETRY);
    assert_non_null(d->layout);
    assert_int_equal(d->layout->drawn, d->status == FW_OK);
    for (size_t i = 0; i < d->diags.count; i++) {
        const fw_diag *said = &d->diags.item[i];
        bool found = false;
        if (said->severity != FW_ERROR) continue;
        errors++;
        for (int k = 0; k < d->layout->nfault; k++)
            found = found || (d->layout->fault[k].number == said->number &&
                              strcmp(d->layout->fault[k].message, said->message) == 0);
        if (!found) fail_msg("no fault for: %s", said->message);
    }
    assert_int_equal(d->status == FW_OK, errors == 0);
    assert_int_equal(d->layout->nfault > 0, errors > 0);
    if (errors == 0) return;
    assert_non_null(d->layout->why_not);
    for (int b = 0; b < device->nbody; b++) { /* every body is shown */
        bool shown = false;
        for (int i = 0; i < d->layout->npiece; i++)
            shown = shown || (d->layout->piece[i].body == b &&
                              d->layout->piece[i].role == FW_ROLE_STRUCTURE);
        if (!shown) fail_msg("body %s is not shown", device->body[b].id);
    }
}

static bool inside(const fw_layout *l, int body, fw_geometry_vec2 p) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].body == body && l->piece[i].role == FW_ROLE_STRUCTURE &&
            fw_geometry_contour_contains(&l->piece[i].contour, p))
            return true;
    return false;
}

static bool within(const fw_geometry_region *r, fw_geometry_vec2 p) {
    int depth = 0;
    for (int i = 0; i < r->count; i++)
        if (fw_geometry_contour_contains(&r->contour[i], p))
            depth += fw_geometry_contour_area(&r->contour[i]) > 0 ? 1 : -1;
    return depth > 0;
}

/* the outlines are those that were compared, so that points tell the overlap; on its edge either
   answer holds */
static void overlap_is_of_both(const fw_layout *l, const fw_layout_fault *f, uint64_t *state) {
    enum { POINTS = 400 };
    fw_geometry_box box = fw_geometry_contour_box(&f->overlap.contour[0]);
    int wrong = 0, in = 0;
    for (int i = 0; i < POINTS; i++) {
        fw_geometry_vec2 p = {uniform(state, box.x0 - 20e-6, box.x1 + 20e-6),
                              uniform(state, box.y0 - 20e-6, box.y1 + 20e-6)};
        bool both = inside(l, f->body[0], p) && inside(l, f->body[1], p);
        in += both;
        wrong += both != within(&f->overlap, p);
    }
    assert_int_equal(wrong, 0);
    assert_true(in > 0);
}

static void plates_that_grow(void **state) {
    (void)state;
    int overlaps = 0, bad = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = seed;
        fixture f;
        fixture_six_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        f.body[2].plate_width_m = uniform(&r, 1.0e-3, 3.2e-3);
        f.body[2].plate_height_m = uniform(&r, 0.3e-3, 1.8e-3);
        f.body[2].plate_y_m = uniform(&r, 2.0e-3, 2.9e-3);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        bad += d.status != FW_OK;
        for (int i = 0; i < d.layout->nfault; i++) {
            const fw_layout_fault *fault = &d.layout->fault[i];
            if (fault->number != 120 || fault->overlap.count == 0 || fault->njoint > 0) continue;
            if (fault->body[0] < 0 || fault->body[1] < 0) continue;
            overlap_is_of_both(d.layout, fault, &r);
            overlaps++;
        }
        fw_arena_free(d.arena);
    }
    assert_true(bad > 8);
    assert_true(overlaps > 8);
}

static void hinges_that_meet(void **state) {
    (void)state;
    int close = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = 77 * seed;
        fixture f;
        seed % 3 == 0   ? fixture_stage(&f)
        : seed % 3 == 1 ? fixture_six_bar(&f)
                        : fixture_four_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        int n = f.device.nrevolute, i = (int)uniform(&r, 0, n), k = (i + 1) % n;
        double share = uniform(&r, 0.5, 0.98); /* of the way to its neighbour */
        f.revolute[i].x_m += share * (f.revolute[k].x_m - f.revolute[i].x_m);
        f.revolute[i].y_m += share * (f.revolute[k].y_m - f.revolute[i].y_m);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        for (int q = 0; q < d.layout->nfault; q++)
            if (d.layout->fault[q].number == 125) {
                const fw_layout_fault *fault = &d.layout->fault[q];
                assert_int_equal(fault->njoint, 2);
                double x0 = f.revolute[fault->joint[0]].x_m, x1 = f.revolute[fault->joint[1]].x_m;
                assert_true(fabs(fault->at.x - 0.5 * (x0 + x1)) < 1e-12);
                close++;
            }
        fw_arena_free(d.arena);
    }
    assert_true(close > 5);
}

/* bars too wide, flexures without room, fillets that do not fit */
static void sizes_that_do_not_fit(void **state) {
    (void)state;
    int bad = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = 1000 + seed;
        fixture f;
        seed % 2 ? fixture_six_bar(&f) : fixture_four_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        int b = seed % 2 ? 3 : 1, j = (int)uniform(&r, 0, f.device.nrevolute);
        if (seed % 5 < 2) f.body[b].width_m = uniform(&r, 0.3e-3, 1.4e-3);
        if (seed % 5 == 2) f.flexure[j].fillet_m = uniform(&r, 5e-6, 90e-6);
        if (seed % 5 == 3) f.flexure[j].angle_rad = uniform(&r, 5.0, 6.2);
        if (seed % 5 == 4) f.flexure[j].width_m = uniform(&r, 8e-6, 60e-6);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        bad += d.status != FW_OK;
        fw_arena_free(d.arena);
    }
    assert_true(bad > 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(plates_that_grow),
                                       cmocka_unit_test(hinges_that_meet),
                                       cmocka_unit_test(sizes_that_do_not_fit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
