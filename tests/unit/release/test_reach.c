/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worst point of a part, and what is left of a bond, against closed forms. */
#include "fixture.h"

static uint64_t seed = 7;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* found at a point that has the distance, proved to the stated error, and right */
static void assert_reach(const fw_release_part *p, double want_um) {
    double want = want_um * UM, error = fmax(1e-8, 5e-4 * want);
    assert_near(p->reach_m, want, error);
    assert_true(p->reach_m <= want + 1e-12);
    assert_true(p->most_m >= want - 1e-12);
    assert_true(p->most_m <= p->reach_m + 1.001 * error);
}

static const fw_release_part *alone(plate *p, fw_geometry_contour c) {
    plate_add(p, FW_ROLE_STRUCTURE, 0, "body", c);
    return &solve(p, 0.0)->part[0];
}

static void strips_and_discs(void **state) {
    (void)state;
    static const double width[] = {0.5, 6, 82, 700};
    for (int i = 0; i < 4; i++) {
        plate *p = plate_new(3000);
        assert_reach(alone(p, rectangle(p, -2000, 3, 2000, 3 + width[i])), 0.5 * width[i]);
        fw_arena_free(p->arena);
        p = plate_new(3000);
        assert_reach(alone(p, disc(p, 12, 7, width[i])), width[i]);
        fw_arena_free(p->arena);
    }
}

/* a strip that lies at an angle, thin beside its length */
static void strips_at_an_angle(void **state) {
    (void)state;
    for (int k = 1; k < 8; k++) {
        plate *p = plate_new(3000);
        double a = 0.37 * k, w = 60;
        fw_geometry_contour c;
        fw_geometry_vec2 from = {0, 0}, to = {2.5e-3 * cos(a), 2.5e-3 * sin(a)};
        assert_int_equal(fw_geometry_contour_bar(p->arena, from, to, w * UM, &c), FW_OK);
        plate_add(p, FW_ROLE_STRUCTURE, 0, "bar", c);
        const fw_release *r = solve(p, 0.0);
        assert_reach(&r->part[0], 0.5 * w);
        assert_true(r->boxes < 4000); /* not as many as its length has widths of the error */
        fw_arena_free(p->arena);
    }
}

static void rings_and_triangles(void **state) {
    (void)state;
    static const double triangle[3][2] = {{0, 0}, {400, 0}, {0, 300}}; /* inscribed: 100 */
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "ring", disc(p, 0, 0, 200));
    plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "hole", disc(p, 0, 0, 120));
    assert_reach(&solve(p, 0.0)->part[0], 40);
    fw_arena_free(p->arena);
    p = plate_new(1000); /* not about the same centre: (R + e - r) / 2 */
    plate_add(p, FW_ROLE_STRUCTURE, 0, "ring", disc(p, 0, 0, 200));
    plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "hole", disc(p, 30, 40, 120));
    assert_reach(&solve(p, 0.0)->part[0], 65);
    fw_arena_free(p->arena);
    p = plate_new(1000);
    assert_reach(alone(p, polygon(p, triangle, 3)), 100);
    fw_arena_free(p->arena);
}

/* round holes in a square grid, right up to the edge: pitch/sqrt 2 less their radius */
static void plates_with_holes(void **state) {
    (void)state;
    double pitch = 40, radius = 6;
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "plate", rectangle(p, -400, -300, 400, 300));
    for (int i = -10; i < 10; i++)
        for (int j = -7; j <= 7; j++)
            plate_add(p, FW_ROLE_MARK, FW_NONE - 1, "hole",
                      disc(p, (i + 0.5) * pitch, j * pitch, radius));
    const fw_release *r = solve(p, 0.0);
    assert_reach(&r->part[0], pitch * sqrt(0.5) - radius);
    assert_true(r->boxes < 40000);
    fw_arena_free(p->arena);
}

/* square holes: the middle between four corners */
static void plates_with_square_holes(void **state) {
    (void)state;
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "plate", rectangle(p, -200, -200, 200, 200));
    for (int i = -4; i <= 4; i++)
        for (int j = -4; j <= 4; j++)
            plate_add(p, FW_ROLE_MARK, FW_NONE - 1, "hole",
                      rectangle(p, 40 * i - 5, 40 * j - 5, 40 * i + 5, 40 * j + 5));
    assert_reach(&solve(p, 0.0)->part[0], 15 * sqrt(2));
    fw_arena_free(p->arena);
}

/* a wedge with one worst point, beside a slot: a box in the middle of the slot says nothing of what lies beyond
   its edges */
static void wedges_beside_slots(void **state) {
    (void)state;
    for (int n = test_cases(2000, 300); n > 0; n--) {
        plate *p = plate_new(800);
        double x = 300 * (uniform() - 0.5), y = 300 * (uniform() - 0.5),
               half = 150 + 200 * uniform();
        double high = 60 + 60 * uniform(), slot = 1 + 30 * uniform();
        double wedge[3][2] = {{x - half, y}, {x + half, y}, {x, y + high}};
        plate_add(p, FW_ROLE_STRUCTURE, 0, "body", polygon(p, wedge, 3));
        plate_add(p, FW_ROLE_STRUCTURE, 0, "body",
                  rectangle(p, x - half, y - slot - 30, x + half, y - slot));
        double inscribed = half * high / (half + hypot(half, high));
        assert_reach(&solve(p, 0.0)->part[0], fmax(inscribed, 15));
        fw_arena_free(p->arena);
    }
}

/* two halves of a bar, joined by a seam: no opening there; and a part behind it is as far from one */
static void seams_are_no_openings(void **state) {
    (void)state;
    plate *p = plate_new(1000);
    fw_geometry_contour left = rectangle(p, -500, -50, 0, 50), right = rectangle(p, 0, -50, 30, 50);
    left.segment[1].flags = right.segment[3].flags = FW_SEGMENT_JOINT;
    plate_add(p, FW_ROLE_STRUCTURE, 0, "long", left);
    plate_add(p, FW_ROLE_FRAME, FW_GROUND, "end", right);
    const fw_release *r = solve(p, 0.0);
    assert_int_equal(r->npart, 2);
    assert_reach(&r->part[0], 50); /* 50 from the end of the other one: still the strip's half */
    assert_reach(&r->part[1], 30); /* its own end is nearer than the sides */
    assert_int_equal(r->slowest, 0);
    assert_int_equal(r->weakest, 1);
    fw_arena_free(p->arena);
}

/* of a bond: strip 1 - 2r/w, disc (1 - r/R)^2, square (1 - 2r/a)^2 */
static void bonds_shrink_as_in_closed_form(void **state) {
    (void)state;
    plate *p = plate_new(3000);
    plate_add(p, FW_ROLE_FRAME, FW_GROUND, "frame", rectangle(p, -2900, 0, 2900, 150));
    plate_add(p, FW_ROLE_STRUCTURE, FW_GROUND, "base", disc(p, 0, 500, 90));
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "pad", rectangle(p, 0, -400, 164, -236));
    const fw_release *r = solve(p, 0.25);
    assert_int_equal(r->npart, 3);
    for (double part = 0.05; part < 1.0; part += 0.05) {
        const fw_release_part *strip = &r->part[0], *round = &r->part[1], *pad = &r->part[2];
        double length = 5800 - 150 * part, width = 150 * (1 - part), area = 5800.0 * 150;
        assert_near(fw_release_bonded(strip, part * strip->reach_m) / strip->area_m2,
                    length * width / area, 0.003);
        assert_near(fw_release_bonded(round, part * round->reach_m) / round->area_m2,
                    (1 - part) * (1 - part), 0.003);
        assert_near(fw_release_bonded(pad, part * pad->reach_m) / pad->area_m2,
                    (1 - part) * (1 - part), 0.003);
    }
    assert_near(r->part[1].kept_m, 45 * UM, 0.3 * UM);
    assert_near(r->part[2].kept_m, 41 * UM, 0.3 * UM);
    assert_int_equal(r->weakest, 2);
    assert_near(r->lost_m, r->part[2].kept_m, 0);
    fw_arena_free(p->arena);
}

/* A base on a wide frame, with narrow arms: its own greatest distance is many times what anything needs, and a long
   seam lies anywhere between the rows of a raster. Of 2400 x 300 um a reach r leaves (2400 - 2 r)(300 - r), of an
   arm nothing from half its width on. */
static void bonds_beside_seams(void **state) {
    (void)state;
    for (int n = 0; n < 12; n++) {
        plate *p = plate_new(2000);
        double low = 37.0 * n / 12, xy[60][2] = {{-1200, low}, {1200, low}, {1200, 300 + low}};
        int corners = 3;
        for (int k = 13; k >= 0; k--) { /* arms, 40 um wide, from the right */
            const double x = -1130 + 170 * k, y = 300 + low;
            const double arm[4][2] = {{x + 40, y}, {x + 40, y + 400}, {x, y + 400}, {x, y}};
            memcpy(xy[corners], arm, sizeof arm);
            corners += 4;
        }
        xy[corners][0] = -1200, xy[corners++][1] = 300 + low;
        fw_geometry_contour frame = rectangle(p, -1200, -900 + low, 1200, low),
                            base = polygon(p, xy, corners);
        frame.segment[2].flags = base.segment[0].flags = FW_SEGMENT_JOINT;
        plate_add(p, FW_ROLE_FRAME, FW_GROUND, "frame", frame);
        plate_add(p, FW_ROLE_STRUCTURE, FW_GROUND, "base", base);
        plate_add(p, FW_ROLE_STRUCTURE, 0, "link", rectangle(p, -100, 1200, 100, 1260));
        const fw_release *r = solve(p, 0.1);
        assert_int_equal(r->npart, 3);
        assert_near(r->needed_m, 30 * UM, 0.1 * UM);
        const fw_release_part *part = &r->part[1];
        assert_near(part->area_m2, (2400.0 * 300 + 14 * 40.0 * 400) * UM * UM, 1e-16);
        for (double reach = 32; reach < 140; reach += 9)
            assert_near(fw_release_bonded(part, reach * UM) / part->area_m2,
                        (2400 - 2 * reach) * (300 - reach) * UM * UM / part->area_m2, 0.004);
        fw_arena_free(p->arena);
    }
}

/* The same of a base whose seam with the frame is aslant, and with edges in any direction, so that both run through cells at any
   height: at a reach r the square that both make, of side 600 um, has (600 - 2 r)^2 left, cut by the seam through its middle in two
   halves that are alike. */
static void bonds_beside_a_seam_aslant(void **state) {
    (void)state;
    static const double row[][2] = {{40, 0}, {110, 0}, {-170, 0}, {260, 0}, {30, 0.25 * M_PI}, {-120, 0.25 * M_PI}, {80, 0.4}, {0, 1.1}};
    for (size_t n = 0; n < sizeof row / sizeof *row; n++) {
        plate *p = plate_new(1000);
        const double rise = row[n][0], c = cos(row[n][1]), s = sin(row[n][1]);
        const double at[2][4][2] = {{{-300, -300}, {300, -300}, {300, rise}, {-300, -rise}}, {{-300, -rise}, {300, rise}, {300, 300}, {-300, 300}}};
        double xy[2][4][2];
        for (int i = 0; i < 8; i++) {
            const double *from = at[i / 4][i % 4];
            xy[i / 4][i % 4][0] = c * from[0] - s * from[1], xy[i / 4][i % 4][1] = s * from[0] + c * from[1];
        }
        fw_geometry_contour frame = polygon(p, (const double(*)[2])xy[0], 4), base = polygon(p, (const double(*)[2])xy[1], 4);
        frame.segment[2].flags = base.segment[0].flags = FW_SEGMENT_JOINT;
        plate_add(p, FW_ROLE_FRAME, FW_GROUND, "frame", frame);
        plate_add(p, FW_ROLE_STRUCTURE, FW_GROUND, "base", base);
        plate_add(p, FW_ROLE_STRUCTURE, 0, "link", rectangle(p, -100, 500, 100, 560));
        const fw_release *r = solve(p, 0.1);
        for (double reach = 20; reach < 280; reach += 3)
            for (int k = 0; k < 2; k++)
                assert_near(fw_release_bonded(&r->part[k], reach * UM) / r->part[k].area_m2,
                            (300 - reach) * (300 - reach) / 300.0 / 300.0, 0.0015);
        fw_arena_free(p->arena);
    }
}

/* any plate with any holes: no random point is farther than the bound, and the worst one found is as far
   as it says, both by the distances of geometry/ */
static void bounds_hold(void **state) {
    (void)state;
    for (int n = test_cases(200, 30); n > 0; n--) {
        plate *p = plate_new(400);
        plate_add(p, FW_ROLE_STRUCTURE, 0, "plate",
                  rectangle(p, -300 * uniform() - 20, -300 * uniform() - 20, 300 * uniform() + 20,
                            300 * uniform() + 20));
        for (int k = (int)(12 * uniform()); k > 0; k--) {
            double x = 600 * (uniform() - 0.5), y = 600 * (uniform() - 0.5), s = 40 * uniform();
            plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "hole",
                      k % 2 ? disc(p, x, y, s + 1) : rectangle(p, x, y, x + s + 1, y + 20));
        }
        const fw_release *r = solve(p, 0.0);
        const fw_layout *l = &p->layout;
        for (int k = -1; k < 2000; k++) {
            fw_geometry_vec2 at = {700e-6 * (uniform() - 0.5), 700e-6 * (uniform() - 0.5)};
            double near = HUGE_VAL;
            bool in = true;
            if (k < 0) at = r->part[0].at;
            for (int i = 0; i < l->npiece; i++) {
                const fw_geometry_contour *c = &l->piece[i].contour;
                in = in && fw_geometry_contour_contains(c, at) == (i == 0);
                for (int s = 0; s < c->count; s++)
                    near = fmin(near, fw_geometry_segment_nearest(&c->segment[s], at, NULL, NULL));
            }
            if (k < 0) assert_true(in);
            if (k < 0) assert_near(near, r->part[0].reach_m, 1e-12);
            if (in) assert_true(near <= r->part[0].most_m);
        }
        fw_arena_free(p->arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strips_and_discs),
        cmocka_unit_test(strips_at_an_angle),
        cmocka_unit_test(rings_and_triangles),
        cmocka_unit_test(plates_with_holes),
        cmocka_unit_test(plates_with_square_holes),
        cmocka_unit_test(wedges_beside_slots),
        cmocka_unit_test(seams_are_no_openings),
        cmocka_unit_test(bonds_shrink_as_in_closed_form),
        cmocka_unit_test(bonds_beside_seams),
        cmocka_unit_test(bonds_beside_a_seam_aslant),
        cmocka_unit_test(bounds_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
