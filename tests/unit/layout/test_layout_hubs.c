/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was refused for want of another way to draw it: three hinges in line on one bar, hinges that are not as
   wide everywhere where their bodies leave at an angle, the bases of long rows, and those of leaves that run to the frame. */
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

/* ---- rows: each base leaves its hinge towards the frame beside it, not along the row ---- */

enum { CELLS_MOST = 40, HINGES_MOST = 4 * CELLS_MOST, BODIES_MOST = 3 * CELLS_MOST };

typedef struct row {
    fw_device device;
    fw_device_body body[BODIES_MOST];
    fw_device_revolute revolute[HINGES_MOST];
    fw_device_flexure leaf;
} row;

static void add_hinge(row *r, int a, int b, double x_m, double y_m, double axis_rad) {
    const int i = r->device.nrevolute++;
    fixture scratch = {0};
    fixture_hinge(&scratch, 0, "j", a, b, x_m, y_m, 200e-6, 8e-6, 3.56);
    r->revolute[i] = scratch.revolute[0];
    r->revolute[i].axis_rad = axis_rad;
}

static row *new_row(fw_arena *arena, double length_m, double gap_m) {
    row *r = fw_arena_one(arena, row);
    fixture scratch = {0};
    assert_non_null(r);
    fixture_finish(&scratch, "row", 0, 0);
    r->device = scratch.device;
    r->device.body = r->body;
    r->device.revolute = r->revolute;
    r->device.flexure = &r->leaf;
    r->leaf = (fw_device_flexure){.id = "f",
                                  .kind = FW_FLEXURE_LEAF,
                                  .length_m = length_m,
                                  .width_m = 8e-6,
                                  .gap_m = gap_m,
                                  .angle_rad = NONE,
                                  .radius_m = NONE,
                                  .fillet_m = NONE};
    r->device.nflexure = 1;
    return r;
}

/* n plates, each on a leaf, the row turned by so many quarters */
static row *columns(fw_arena *arena, int n, double pitch_m, int quarters) {
    static const double c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
    row *r = new_row(arena, 150e-6, 0);
    for (int i = 0; i < n; i++) {
        const double x = i * pitch_m, y = 0.6e-3;
        const double wide = quarters % 2 ? 900e-6 : 120e-6, high = quarters % 2 ? 120e-6 : 900e-6;
        fw_device_body *b = &r->body[r->device.nbody++];
        *b = fixture_body("b", 120e-6);
        b->plate_width_m = wide;
        b->plate_height_m = high;
        b->x_m = b->plate_x_m = x * c[quarters] - y * s[quarters];
        b->y_m = b->plate_y_m = x * s[quarters] + y * c[quarters];
        add_hinge(r, FW_GROUND, i, x * c[quarters], x * s[quarters], 0.5 * M_PI * quarters);
    }
    return r;
}

/* n four-bars side by side, whose axes the layout chooses */
static row *four_bars(fw_arena *arena, int n, double pitch_m) {
    row *r = new_row(arena, 200e-6, 10e-6);
    for (int i = 0; i < n; i++) {
        const double x = i * pitch_m, at[3] = {0, 0.9e-3, 1.8e-3};
        const int b = r->device.nbody;
        for (int k = 0; k < 3; k++) {
            r->body[b + k] = fixture_body("b", k == 1 ? NONE : 100e-6);
            r->body[b + k].x_m = x + at[k];
            r->body[b + k].y_m = k == 1 ? 1.5e-3 : 0.75e-3;
        }
        r->body[b + 1].plate_width_m = 0.7e-3;
        r->body[b + 1].plate_height_m = 0.5e-3;
        r->body[b + 1].plate_x_m = x + at[1];
        r->body[b + 1].plate_y_m = 1.5e-3;
        r->device.nbody += 3;
        add_hinge(r, FW_GROUND, b, x, 0, NONE);
        add_hinge(r, b, b + 1, x, 1.5e-3, NONE);
        add_hinge(r, b + 1, b + 2, x + at[2], 1.5e-3, NONE);
        add_hinge(r, b + 2, FW_GROUND, x + at[2], 0, NONE);
    }
    return r;
}

/* the device is drawn, and no base is farther from its hinge than `reach_m` */
static void bases_are_near(fw_arena *arena, const row *r, double reach_m) {
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *l;
    int bases = 0;
    fw_status status = fw_layout_build(arena, &r->device, &diags, &l);
    for (size_t k = 0; k < diags.count; k++)
        print_message("%s\n", diags.item[k].message);
    assert_int_equal(status, FW_OK);
    assert_int_equal(diags.errors, 0);
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body != FW_GROUND) continue;
        const fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        bases++;
        assert_true(fmax(b.x1 - b.x0, b.y1 - b.y0) < reach_m);
    }
    int held = 0;
    for (int j = 0; j < r->device.nrevolute; j++)
        held += r->revolute[j].body_a == FW_GROUND || r->revolute[j].body_b == FW_GROUND;
    assert_int_equal(bases, held);
}

static void bases_of_rows(void **state) {
    (void)state;
    static const int n[] = {6, 12, CELLS_MOST};
    for (size_t i = 0; i < sizeof n / sizeof n[0]; i++)
        for (int quarters = 0; quarters < (n[i] == CELLS_MOST ? 1 : 4); quarters++) {
            fw_arena *arena = fw_arena_new(0);
            bases_are_near(arena, columns(arena, n[i], 2e-3, quarters), 0.6e-3);
            fw_arena_free(arena);
        }
    for (size_t i = 0; i < sizeof n / sizeof n[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        bases_are_near(arena, four_bars(arena, n[i], i % 2 ? 3e-3 : 5e-3), 0.8e-3);
        fw_arena_free(arena);
    }
}

/* ---- leaves that run straight to a side of the frame ---- */

/* a plate on n leaves to its left and right, turned by so many quarters */
static row *clamped(fw_arena *arena, int n, int quarters) {
    static const double c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
    row *r = new_row(arena, 500e-6, 0);
    r->leaf.width_m = 5e-6;
    r->body[0] = fixture_body("plate", 120e-6);
    r->body[0].plate_width_m = quarters % 2 ? 2.4e-3 : 0.6e-3;
    r->body[0].plate_height_m = quarters % 2 ? 0.6e-3 : 2.4e-3;
    r->body[0].x_m = r->body[0].y_m = r->body[0].plate_x_m = r->body[0].plate_y_m = 0;
    r->device.nbody = 1;
    for (int i = 0; i < n; i++) {
        const double x = i % 2 ? 1e-3 : -1e-3, y = n < 4 ? 0 : i < 2 ? 1e-3 : -1e-3;
        add_hinge(r, i % 2 ? 0 : FW_GROUND, i % 2 ? FW_GROUND : 0,
                  x * c[quarters] - y * s[quarters], x * s[quarters] + y * c[quarters],
                  0.5 * M_PI * (quarters - 1));
    }
    return r;
}

/* how far the farthest base reaches across the leaves */
static double widest_base(fw_arena *arena, const row *r, int n, int quarters) {
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *l;
    double wide = 0;
    int bases = 0;
    assert_int_equal(fw_layout_build(arena, &r->device, &diags, &l), FW_OK);
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body != FW_GROUND) continue;
        const fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        wide = fmax(wide, quarters % 2 ? b.x1 - b.x0 : b.y1 - b.y0);
        bases++;
    }
    assert_int_equal(bases, n);
    return wide;
}

static void bases_in_line(void **state) {
    (void)state;
    for (int n = 1; n <= 4; n *= 2)
        for (int quarters = 0; quarters < 4; quarters++) {
            fw_arena *arena = fw_arena_new(0);
            assert_true(widest_base(arena, clamped(arena, n, quarters), n, quarters) < 320e-6);
            fw_arena_free(arena);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(three_hinges_in_line),
                                       cmocka_unit_test(bases_of_rows),
                                       cmocka_unit_test(bases_in_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
