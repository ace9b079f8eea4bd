/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows for sharp corners in masks/FLOW.xml: every one that is seeded is found, with its angle,
   and right angles in any direction are not. */
#include "base/output.h"
#include "mask/rule.h"
#include "scene.h"

static void use_table(scene *s, const char *flow) {
    char path[512], *xml;
    size_t n;
    snprintf(path, sizeof path, "%s/masks/%s.xml", FW_TEST_SOURCE_DIR, flow);
    assert_int_equal(fw_input_read(s->arena, path, 1 << 20, &s->diags, &xml, &n), FW_OK);
    assert_int_equal(fw_mask_table_read(s->arena, path, xml, n, &s->diags, &s->table), FW_OK);
}

/* with corners of `sharp` and pi - sharp, sides of 40 um, about a place */
static fw_geometry_contour rhombus(scene *s, fw_geometry_vec2 at, double sharp, double turn) {
    const double side = 40e-6;
    fw_geometry_vec2 u = {side * cos(turn), side * sin(turn)};
    fw_geometry_vec2 v = {side * cos(turn + sharp), side * sin(turn + sharp)};
    fw_geometry_outline o = fw_geometry_outline_start(s->arena, at);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){at.x + u.x, at.y + u.y}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){at.x + u.x + v.x, at.y + u.y + v.y}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){at.x + v.x, at.y + v.y}, 0);
    fw_geometry_contour c = {0};
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static int sharp_corners(const fw_mask *mask, double sharp) {
    int n = 0;
    for (int i = 0; i < mask->nfinding; i++) {
        const fw_mask_finding *f = &mask->finding[i];
        if (f->rule->kind != &fw_mask_kind_angle) continue;
        assert_int_equal(f->rule->severity, FW_WARNING);
        assert_near(f->rule->least, PI / 2, 1e-15);
        assert_near(f->value, sharp, 1e-9);
        n++;
    }
    return n;
}

static void sharp_corners_of_either_flow(void **state) {
    (void)state;
    static const char *const flow[2] = {"al-masked-rie", "copper-on-porous-silicon"};
    static const fw_layout_role role[3] = {FW_ROLE_STRUCTURE, FW_ROLE_TEXT, FW_ROLE_MARK};
    uint64_t seed = 17;
    for (int run = 0; run < 60; run++) {
        bool right = run % 5 == 0; /* nothing is wrong with those */
        double sharp = right ? PI / 2 : (30 + 59.99 * random01(&seed)) * PI / 180;
        double turn = 2 * PI * random01(&seed);
        scene *s = scene_new(0, 0);
        use_table(s, flow[run % 2]);
        fw_layout_role in = role[run / 2 % 3];
        if (in != FW_ROLE_STRUCTURE) scene_box(s, "field", -200, -200, 200, 200);
        double shift = 1e-9 * round(4e4 * random01(&seed));
        scene_add(s, in, "rhombus", rhombus(s, (fw_geometry_vec2){shift, -shift}, sharp, turn));
        const fw_mask *mask = NULL;
        fw_status status = fw_mask_examine(s->arena, &s->layout, &s->table, "test device",
                                           &s->options, &s->diags, &mask);
        assert_int_equal(status, right ? FW_OK : FW_INPUT); /* it is a width of nothing, too */
        assert_non_null(mask);
        int found = sharp_corners(mask, sharp);
        if (found != (right ? 0 : 2))
            fail_msg("run %d: %d sharp corners, angle %.6f deg", run, found, sharp * 180 / PI);
        if (right) assert_int_equal(mask->nfinding, 0);
        scene_free(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sharp_corners_of_either_flow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
