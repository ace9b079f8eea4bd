/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that were refused for want of another way to draw them: three hinges in line on one bar,
   and hinges that are not as wide everywhere where their bodies leave at an angle. */
#include "fixture.h"
#include "layout/layout.h"
#include "test.h"

/* a coupler on three legs; `bent_m`: how far the middle one stands out of the line */
static void three_legs(fixture *f, double bent_m) {
    *f = (fixture){0};
    f->body[0] = fixture_body("coupler", 160e-6);
    for (int i = 0; i < 3; i++) {
        static const char *const leg[] = {"leg0", "leg1", "leg2"};
        static const char *const low[] = {"A0", "A1", "A2"}, *const up[] = {"B0", "B1", "B2"};
        double x = 1.2e-3 * i, y = 2e-3 + (i == 1 ? bent_m : 0);
        f->body[1 + i] = fixture_body(leg[i], 120e-6);
        f->body[1 + i].x_m = x;
        f->body[1 + i].y_m = 0.5 * y;
        fixture_hinge(f, 2 * i, low[i], FW_GROUND, 1 + i, x, 0, 280e-6, 8e-6, 3.56);
        fixture_hinge(f, 2 * i + 1, up[i], 1 + i, 0, x, y, 280e-6, 8e-6, 3.56);
    }
    f->body[0].x_m = 1.2e-3;
    f->body[0].y_m = 2e-3;
    fixture_finish(f, "three-legs", 4, 6);
}

static double coupler_area(const fw_layout *l) {
    double area = 0;
    int outlines = 0;
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_STRUCTURE && l->piece[i].body == 0) {
            outlines++;
            area = fw_geometry_contour_area(&l->piece[i].contour);
        }
    assert_int_equal(outlines, 1);
    return area;
}

/* in line the hub stands beside the hinges; where the middle one is out of the way, between them */
static void three_hinges_in_line(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double area[2];
    for (int i = 0; i < 2; i++) {
        fixture f;
        fw_diags diags = fw_diags_new(arena);
        const fw_layout *l;
        three_legs(&f, i == 0 ? 0 : -0.9e-3);
        fw_status status = fw_layout_build(arena, &f.device, &diags, &l);
        for (size_t k = 0; k < diags.count; k++)
            print_message("%s\n", diags.item[k].message);
        assert_int_equal(status, FW_OK);
        assert_int_equal(diags.errors, 0);
        assert_true(l->narrowest_gap_m >= 8e-6 * (1 - 1e-9));
        area[i] = coupler_area(l);
    }
    /* two spokes of 1.2 mm and one of 0.4 mm, 160 um wide, less what the hinges take */
    assert_true(area[0] > 0.25e-6 && area[0] < 0.6e-6);
    assert_true(area[1] > 0.2e-6 && area[1] < 0.6e-6);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(three_hinges_in_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
