/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is below a device that is free: a hollow, the layer that the release takes away, or nothing. */
#include "pack_fixture.h"
#include "process/films.h"

static void assert_same_word(const char *of, const char *is, const char *wanted) {
    if ((is == NULL) != (wanted == NULL) || (is && strcmp(is, wanted) != 0))
        fail_msg("%s: %s, not %s", of, is ? is : "nothing", wanted ? wanted : "nothing");
}

static void of_every_pack(void **state) {
    (void)state;
    static const struct {
        const char *pack, *q, *material;
        bool open, hollow;
        const char *carries, *faces;
    } row[] = {
        {"soi-deep-rie", "box.d", "buried-oxide", false, false, "silicon-substrate", "silicon-substrate"},
        {"soi-double-sided", NULL, NULL, true, false, "silicon-substrate", NULL},
        {"silicon-on-glass", "cavity.d", NULL, false, true, "glass-carrier", "glass-carrier"},
        {COPPER, "ps.d", "porous-silicon", false, false, "silicon-substrate", "silicon-substrate"},
        {SILICON, NULL, NULL, true, false, NULL, NULL}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, row[i].pack, NULL, NULL, &diags);
        assert_non_null(f);
        bool open, hollow;
        const char *material;
        const fw_quantity *gap = fw_process_flow_gap(f, &open, &hollow, &material);
        assert_ptr_equal(gap, row[i].q ? fw_process_flow_quantity(f, row[i].q) : NULL);
        assert_int_equal(open, row[i].open);
        assert_int_equal(hollow, row[i].hollow);
        if (row[i].material) assert_string_equal(material, row[i].material);
        const fw_process_material *carries, *faces;
        assert_int_equal(fw_process_flow_ground(arena, f, &carries, &faces), FW_OK);
        assert_same_word(row[i].pack, carries ? carries->id : NULL, row[i].carries);
        assert_same_word(row[i].pack, faces ? faces->id : NULL, row[i].faces);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(of_every_pack, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
