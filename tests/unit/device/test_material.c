/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files.h"

#define PACK(body) "<process><source id='s'>src</source>" body "</process>"

static void the_pack_is_sound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    size_t n;
    char *xml = load(arena, "processes/base.xml", &n);
    fw_materials m;
    fw_status s = fw_materials_read(arena, "base.xml", xml, n, &diags, &m);
    if (s != FW_OK) fail_msg("%d: %s", diags.item[0].place.line, diags.item[0].message);
    const fw_material *si = fw_material_find(&m, "silicon-100");
    const fw_material *cu = fw_material_find(&m, "copper-plated");
    assert_non_null(si);
    assert_non_null(cu);
    assert_in_range((long)(si->youngs.value / 1e9), 130, 169);
    assert_in_range((long)cu->density.value, 8000, 9000);
    assert_string_equal(si->criterion, "fracture");
    assert_true(si->youngs.uncertainty > 0 && si->youngs.source[0]);
    assert_null(fw_material_find(&m, "unobtainium"));
    assert_null(fw_material_find(&m, NULL));
    fw_arena_free(arena);
}

static void what_is_absent_is_unknown(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *xml = PACK("<material id='w' name='wax'/>");
    fw_materials m;
    assert_int_equal(fw_materials_read(arena, "t", xml, strlen(xml), &diags, &m), FW_OK);
    const fw_material *w = fw_material_find(&m, "w");
    assert_true(w->youngs.unknown && w->poisson.unknown && w->density.unknown &&
                w->strength.unknown && w->loss.unknown);
    assert_string_equal(w->strength.id, "strength");
    fw_arena_free(arena);
}

static void overrides_replace(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *xml = PACK("<material id='w'><q id='youngs' value='100' u='5' unit='GPa' "
                           "status='typical' src='s'/></material>");
    fw_materials m;
    assert_int_equal(fw_materials_read(arena, "t", xml, strlen(xml), &diags, &m), FW_OK);
    const char *device = DEVICE("<material ref=\"w\" youngs-modulus=\"160 GPa\"/>" ARM);
    const fw_device *d = sound(arena, device, NULL, 0);
    fw_material with = fw_material_with(&m.item[0], &d->material);
    assert_relative(with.youngs.value, 160e9, 1e-15);
    assert_string_equal(with.youngs.source, "device file");
    assert_string_equal(with.youngs.unit, "GPa");
    assert_true(with.density.unknown);
    fw_material_override none = {0}; /* never filled: changes nothing */
    assert_relative(fw_material_with(&m.item[0], &none).youngs.value, 100e9, 1e-15);
    fw_arena_free(arena);
}

static void memory_runs_out(void **state) {
    (void)state;
    const char *xml = PACK("<material id='w'><q id='youngs' value='100' u='5' unit='GPa' "
                           "status='typical' src='s'/></material><material/>");
    for (long n = 1;; n++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_materials m;
        fw_arena_fail_at(n, 1);
        fw_status s = fw_materials_read(arena, "t", xml, strlen(xml), &diags, &m);
        long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        assert_int_equal(s, used >= n ? FW_NOMEM : FW_INPUT);
        fw_arena_free(arena);
        if (used < n) break;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_pack_is_sound),
        cmocka_unit_test(what_is_absent_is_unknown),
        cmocka_unit_test(overrides_replace),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
