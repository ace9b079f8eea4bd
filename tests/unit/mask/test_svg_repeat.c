/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include "mask/mask_parts.h"
#include "scene.h"
#include <stdlib.h>

/* an L with a round end: five lines and an arc */
static fw_geometry_contour hook(fw_arena *arena, double x, double y, double tall) {
    fw_geometry_outline o = fw_geometry_outline_start(arena, (fw_geometry_vec2){x, y});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x + 40 * UM, y}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x + 40 * UM, y + 12 * UM}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x + 12 * UM, y + 12 * UM}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x + 12 * UM, y + tall}, 0);
    fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){x + 6 * UM, y + tall}, FW_PI,
                               (fw_geometry_vec2){x, y + tall}, 0);
    fw_geometry_contour c = {0};
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static int count(const char *text, const char *word) {
    int n = 0;
    for (const char *s = strstr(text, word); s; s = strstr(s + 1, word))
        n++;
    return n;
}

/* every moved copy is a reference whose offset is where the copy stands; what differs by more than
   the last decimal is written out */
static void moved_copies_are_referred_to(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    uint64_t seed = 7;
    double x[12], y[12];
    for (int i = 0; i < 12; i++) {
        x[i] = 1e-12 * (double)(int64_t)(1e8 * (i % 4) + 1e7 * random01(&seed));
        y[i] = 1e-12 * (double)(int64_t)(2e8 * (i / 4) + 1e7 * random01(&seed));
        scene_add(s, FW_ROLE_STRUCTURE, "hook",
                  hook(s->arena, x[i], y[i], (i == 5 ? 30.001 : 30) * UM));
    }
    scene_add(s, FW_ROLE_TEXT, "other layer", hook(s->arena, -1e-3, 0, 30 * UM));
    scene_box(s, "box", 1000, 0, 1020, 20);
    scene_box(s, "box", 1100, 0, 1120, 20); /* too short to be worth it */
    const fw_mask *mask = built(s);
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_svg(mask, &out), FW_OK);
    assert_int_equal(count(out.data, "<use "), 10);
    assert_int_equal(count(out.data, "<path "), 5);
    assert_int_equal(count(out.data, "id=\"s."), 1);
    const char *at = out.data;
    for (int i = 1; i < 12; i++) {
        if (i == 5) continue;
        at = strstr(at, "<use xlink:href=\"#s.test_device.0\" x=\"");
        assert_non_null(at);
        at = strstr(at, " x=\"") + 4;
        assert_near(strtod(at, NULL), 1e6 * (x[i] - x[0]), 1.5e-6);
        at = strstr(at, " y=\"") + 4;
        assert_near(strtod(at, NULL), -1e6 * (y[i] - y[0]), 1.5e-6);
    }
    scene_free(s);
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    for (int i = 0; i < 3; i++)
        scene_add(s, FW_ROLE_STRUCTURE, "hook", hook(s->arena, 1e-4 * i, 0, 30 * UM));
    const fw_mask *mask = built(s);
    for (long n = 1; n < 40; n++) {
        fw_text out = fw_text_new(s->arena);
        fw_arena_fail_at(n, 1);
        fw_status status = fw_mask_write_svg(mask, &out);
        bool reached = fw_arena_count() >= n;
        fw_arena_fail_at(0, 0);
        assert_int_equal(status, reached ? FW_NOMEM : FW_OK);
        if (!reached) break;
    }
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moved_copies_are_referred_to),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
