/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene.h"

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static void refused(scene *s, int number) {
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    scene_first(s, number);
    assert_null(mask);
}

static void narrow_bar(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "thin bar", 0, 0, 100, 3.999);
    refused(s, 144);
    const char *m = scene_first(s, 144);
    assert_says(m, "thin bar (edge 0)");
    assert_says(m, "thin bar (edge 2)");
    assert_says(m, "3.999 um");
    assert_says(m, "needs 4 um");
    assert_says(m, "test rule");
    scene_free(s);
}

static void exactly_the_rule_on_the_grid_passes(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "left", 0, 0, 4, 100);
    scene_box(s, "right", 8, 0, 12, 100);
    const fw_mask *mask = built(s);
    assert_near(mask->measure[0].width_m, 4 * UM, 1e-20);
    assert_near(mask->measure[0].space_m, 4 * UM, 1e-20);
    assert_near(mask->measure[0].perimeter_m, 4 * 104 * UM, 1e-15);
    scene_free(s);
}

/* Off the grid rounding makes a bar of exactly the rule wider or narrower, and it is judged as it is
   written: by the distance of its corners from the two long edges, in whole numbers. */
static void exactly_the_rule_turned_as_it_is_written(void **state) {
    (void)state;
    int narrow = 0;
    for (int i = 0; i < 60; i++) {
        scene *s = scene_new(4 * UM, 0);
        fw_geometry_contour c;
        fw_geometry_polygon p;
        double angle = 0.05 + 0.1 * i;
        assert_int_equal(
            fw_geometry_contour_bar(s->arena, (fw_geometry_vec2){0, 0},
                                    (fw_geometry_vec2){90 * UM * cos(angle), 90 * UM * sin(angle)},
                                    4 * UM, &c),
            FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "turned bar", c);
        assert_int_equal(fw_geometry_flatten(s->arena, &c, 5e-9, FW_FLATTEN_INSIDE, &p, NULL),
                         FW_OK);
        assert_int_equal(p.count, 4);
        double least = HUGE_VAL;
        for (int k = 0; k < 4; k++) { /* edge k, and the two corners beyond it */
            int64_t dx = p.vertex[(k + 1) % 4].x_dbu - p.vertex[k].x_dbu;
            int64_t dy = p.vertex[(k + 1) % 4].y_dbu - p.vertex[k].y_dbu;
            double length = sqrt((double)(dx * dx + dy * dy));
            for (int m = 2; m < 4 && length > 50000; m++) {
                fw_geometry_point q = p.vertex[(k + m) % 4];
                int64_t x = q.x_dbu - p.vertex[k].x_dbu, y = q.y_dbu - p.vertex[k].y_dbu;
                double along = (double)(x * dx + y * dy) / length;
                if (along >= 0 && along <= length)
                    least = fmin(least, (double)(dx * y - dy * x) / length);
            }
        }
        const fw_mask *mask = NULL;
        assert_int_equal(scene_build(s, &mask), least < 4000 ? FW_INPUT : FW_OK);
        if (least < 4000) assert_says(scene_first(s, 144), "needs 4 um (rule 4 um");
        narrow += least < 4000;
        scene_free(s);
    }
    assert_true(narrow > 30 && narrow < 60); /* of four distances the least */
}

static void close_bars_are_named(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "link AB", 0, 0, 50, 10);
    scene_box(s, "link EF", 0, 13.5, 50, 25);
    scene_box(s, "far away", 0, 200, 50, 220);
    refused(s, 145);
    const char *m = scene_first(s, 145);
    assert_int_equal(s->diags.count, 1);
    assert_says(m, "link AB");
    assert_says(m, "link EF");
    assert_says(m, "space of 3.5 um");
    assert_says(m, "11.75) um");
    scene_free(s);
}

static void corner_to_corner(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "one", 0, 0, 10, 10);
    scene_box(s, "two", 13, 14, 30, 30); /* 3 and 4 apart: 5 */
    assert_near(built(s)->measure[0].space_m, 5 * UM, 1e-18);
    scene_free(s);
    s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "one", 0, 0, 10, 10);
    scene_box(s, "two", 12, 13, 30, 30);
    refused(s, 145);
    assert_says(scene_first(s, 145), "3.60555 um");
    scene_free(s);
}

static void notch(void **state) {
    (void)state;
    static const double p[8][2] = {{0, 0},  {20, 0}, {20, 20}, {12, 20},
                                   {12, 5}, {9, 5},  {9, 20},  {0, 20}};
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_add(s, FW_ROLE_STRUCTURE, "fork", polygon(s->arena, p, 8));
    refused(s, 145);
    assert_says(scene_first(s, 145), "fork (edge 3) and fork (edge 5): space of 3 um");
    scene_free(s);
}

static void acute_corners(void **state) {
    (void)state;
    static const double wedge[3][2] = {{0, 0}, {100, 0}, {100, 60}};
    static const double dent[5][2] = {{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}};
    scene *s = scene_new(4 * UM, 0);
    scene_add(s, FW_ROLE_STRUCTURE, "wedge", polygon(s->arena, wedge, 3));
    refused(s, 144);
    scene_free(s);
    s = scene_new(0, 4 * UM);
    scene_add(s, FW_ROLE_STRUCTURE, "dent", polygon(s->arena, dent, 5));
    refused(s, 145);
    scene_free(s);
    s = scene_new(0, 0); /* no rule, no complaint */
    scene_add(s, FW_ROLE_STRUCTURE, "dent", polygon(s->arena, dent, 5));
    built(s);
    scene_free(s);
}

/* the gap between two concentric arcs is the difference of the radii, to round-off */
static void conjugate_gap(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    fw_geometry_vec2 o = {123.4 * UM, -77.7 * UM};
    fw_geometry_contour disc, shell;
    assert_int_equal(fw_geometry_contour_disc(s->arena, o, 40 * UM, &disc), FW_OK);
    assert_int_equal(
        fw_geometry_contour_ring_sector(s->arena, o, 46.5 * UM, 70 * UM, 0.3, 2.0, &shell), FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "cam", disc);
    scene_add(s, FW_ROLE_STRUCTURE, "shell", shell);
    const fw_mask *mask = built(s);
    assert_near(mask->measure[0].space_m, 6.5 * UM, 1e-16);
    assert_near(mask->measure[0].width_m, 23.5 * UM, 1e-16);
    scene_free(s);
}

/* the chords of a hollow arc stand up to 5 nm in the gap: 4 um of arcs are too little, as written */
static void arcs_are_judged_by_their_chords(void **state) {
    (void)state;
    for (int more = 0; more < 2; more++) {
        scene *s = scene_new(0, 4 * UM);
        fw_geometry_contour disc, shell;
        double gap = 4 * UM + (more ? 11.5e-9 : 2e-9); /* 2 (5 nm + 0.7071 nm) = 11.414 nm */
        assert_int_equal(
            fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){0, 0}, 40 * UM, &disc), FW_OK);
        assert_int_equal(fw_geometry_contour_ring_sector(s->arena, (fw_geometry_vec2){0, 0},
                                                         40 * UM + gap, 70 * UM, 0.3, 2.0, &shell),
                         FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "cam", disc);
        scene_add(s, FW_ROLE_STRUCTURE, "shell", shell);
        if (more)
            built(s);
        else
            refused(s, 145);
        scene_free(s);
    }
}

/* A tip of R = 2.84 um keeps a rule of 4 um as an arc, over R sqrt 2 = 4.016 um. Its chords do not:
   two that enclose more than 90 degrees are nearer by the turn of one chord. */
static void a_small_tip_is_judged_by_its_chords(void **state) {
    (void)state;
    const struct {
        double tolerance_nm, radius;
        bool refused;
    } tip[] = {{5, 2.84, true}, {50, 2.84, true}, {0.7, 2.84, true}, {0.5, 2.95, false},
               {5, 3.1, false}, {5, 3.0, false},  {50, 3.1, true},   {50, 3.6, false}};
    for (size_t i = 0; i < sizeof tip / sizeof tip[0]; i++) {
        scene *s = scene_new(4 * UM, 0);
        fw_geometry_contour bar;
        double r = tip[i].radius * UM;
        fw_geometry_outline o = fw_geometry_outline_start(s->arena, (fw_geometry_vec2){0, -r});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){40 * UM, -r}, 0);
        fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){40 * UM, 0}, PI,
                                   (fw_geometry_vec2){40 * UM, r}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){0, r}, 0);
        assert_int_equal(fw_geometry_outline_close(&o, &bar), FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "tip", bar);
        s->options.tolerance_m = tip[i].tolerance_nm * 1e-9;
        const fw_mask *mask = NULL;
        fw_status status = scene_build(s, &mask);
        if (status != (tip[i].refused ? FW_INPUT : FW_OK))
            fail_msg("tip %d: %s", (int)i, s->diags.count ? s->diags.item[0].message : "passed");
        scene_free(s);
    }
}

/* a disc faces itself over chords that turn by more than 90 deg: r sqrt2 and up, less a chord */
static void small_disc(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 0);
    fw_geometry_contour disc;
    assert_int_equal(fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){0, 0}, 2.5 * UM, &disc),
                     FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "disc", disc);
    refused(s, 144);
    scene_free(s);
    s = scene_new(4 * UM, 0);
    assert_int_equal(fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){0, 0}, 3.1 * UM, &disc),
                     FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "disc", disc);
    built(s);
    scene_free(s);
}

static void overlaps(void **state) {
    (void)state;
    static const double box[][4] = {
        {50, 5, 120, 20},  /* crosses */
        {10, 2, 20, 8},    /* inside */
        {100, 0, 150, 10}, /* shares an edge without a joint */
        {100, 10, 150, 20} /* touches at a corner */
    };
    for (int i = 0; i < 4; i++) {
        scene *s = scene_new(0, 0);
        scene_box(s, "first", 0, 0, 100, 10);
        scene_box(s, "second", box[i][0], box[i][1], box[i][2], box[i][3]);
        refused(s, 152);
        assert_says(scene_first(s, 152), "first");
        assert_says(scene_first(s, 152), "second");
        scene_free(s);
    }
}

static void layers_do_not_mix(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    static const double p[4][2] = {{2, 2}, {8, 2}, {8, 8}, {2, 8}};
    scene_box(s, "frame", 0, 0, 100, 10);
    scene_add(s, FW_ROLE_TEXT, "letter", polygon(s->arena, p, 4));
    const fw_mask *mask = built(s);
    assert_int_equal(mask->nshape, 2);
    assert_near(mask->measure[1].width_m, 6 * UM, 1e-18);
    assert_true(isinf(mask->measure[1].space_m));
    scene_free(s);
}

/* pieces joined to one body: the joint is no edge, so neither width nor space is measured there */
static void joined_pieces_are_one(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8,
               4.5); /* legs of 4.5 um: narrower than all else, but they go on in the arch */
    const fw_mask *mask = built(s);
    assert_near(mask->measure[0].width_m, 8 * UM, 1e-16);
    assert_near(mask->measure[0].space_m, 92 * UM, 1e-16);
    double rim = PI * (54 + 46) * UM + 2 * (8 + 2 * 4.5) * UM;
    assert_relative(mask->measure[0].perimeter_m, rim, 1e-12);
    scene_free(s);
}

static void joint_without_partner(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    s->layout.npiece = 2; /* the left leg is missing */
    refused(s, 146);
    assert_says(scene_first(s, 146), "arch");
    scene_free(s);
}

/* measured values do not depend on where and how the device lies */
static void motion_changes_nothing(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int turn = 0; turn < 20; turn++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_arch(s, 50, 8, 20);
        scene_box(s, "block", -20, -20, 20, 30);
        fw_geometry_pose pose = {random01(&seed) * 1e-3, random01(&seed) * 1e-3,
                                 6.3 * random01(&seed)};
        fw_geometry_contour moved;
        assert_int_equal(
            fw_geometry_contour_transform(s->arena, &s->piece[3].contour, pose, false, &moved),
            FW_OK);
        s->piece[3].contour = moved;
        /* the arch alone in its place, the block moved with an inverse check on the corner */
        double gap = HUGE_VAL;
        for (int i = 0; i < 3; i++) {
            fw_geometry_vec2 p, q;
            gap = fmin(gap, fw_geometry_contour_distance(&s->piece[i].contour, &moved, &p, &q));
        }
        const fw_mask *mask = NULL;
        fw_status status = scene_build(s, &mask);
        if (gap > 4.1 * UM) {
            assert_int_equal(status, FW_OK);
            assert_near(mask->measure[0].width_m, 8 * UM, 1e-15);
            /* facing edges only: never below the plain distance */
            assert_true(mask->measure[0].space_m >= fmin(gap, 92 * UM) - 1e-15);
        } else if (gap == 0) {
            assert_int_equal(status, FW_INPUT);
        }
        scene_free(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(narrow_bar),
        cmocka_unit_test(exactly_the_rule_on_the_grid_passes),
        cmocka_unit_test(exactly_the_rule_turned_as_it_is_written),
        cmocka_unit_test(close_bars_are_named),
        cmocka_unit_test(corner_to_corner),
        cmocka_unit_test(notch),
        cmocka_unit_test(acute_corners),
        cmocka_unit_test(conjugate_gap),
        cmocka_unit_test(arcs_are_judged_by_their_chords),
        cmocka_unit_test(a_small_tip_is_judged_by_its_chords),
        cmocka_unit_test(small_disc),
        cmocka_unit_test(overlaps),
        cmocka_unit_test(layers_do_not_mix),
        cmocka_unit_test(joined_pieces_are_one),
        cmocka_unit_test(joint_without_partner),
        cmocka_unit_test(motion_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
