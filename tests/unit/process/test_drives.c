/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comb drives in flows: insulation and gaps, with the numbers of the packs. */
#include "pack_fixture.h"
#include <math.h>

static fw_process_flow *judged(const char *name, const char *from, const char *to, bool carrier,
                               const fw_process_drive_facts *drive, int n) {
    fw_process_flow *f = read_pack(arena, name, from, to, &diags);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_int_equal(fw_process_flow_judge_drives(arena, f, carrier, drive, n, &diags), FW_OK);
    return f;
}

static int reasons(const fw_process_flow *f, const char *text) {
    int count = 0;
    for (int i = 0; i < f->nreason; i++)
        count += strstr(f->reason[i], text) != NULL;
    return count;
}

static int warned(int code) {
    int count = 0;
    for (size_t i = 0; i < diags.count; i++)
        count += diags.item[i].number == code;
    return count;
}

static void no_drive_changes_nothing(void **state) {
    (void)state;
    fw_process_flow *f = judged(SILICON, NULL, NULL, false, NULL, 0);
    int before = f->nreason;
    assert_int_equal(f->manufacturable, -1);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_int_equal(f->nreason, before);
}

/* both flows of the paper: one conducting layer */
static void not_insulated(void **state) {
    (void)state;
    static const fw_process_drive_facts two[] = {{.id = "left", .gap_m = 10e-6},
                                                 {.id = "right", .gap_m = 10e-6}};
    static const char *const packs[] = {SILICON, COPPER};
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = judged(packs[i], NULL, NULL, false, two, 2);
        assert_int_equal(f->manufacturable, 0);
        assert_int_equal(reasons(f, "comb drive left, right: nothing insulates"), 1);
        assert_int_equal(reasons(f, "carrier=\"insulating\""), 1);
        assert_int_equal(warned(207), i + 1);
        /* again, as after a change of the device: the same */
        int before = f->nreason;
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        assert_int_equal(f->manufacturable, -1);
        assert_int_equal(fw_process_flow_judge_drives(arena, f, true, two, 2, &diags), FW_OK);
        assert_int_equal(f->manufacturable, -1);
        assert_true(f->nreason < before);
    }
    /* a drive without any drawn mask is refused as well */
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, f, NULL, &diags), FW_OK);
    assert_int_equal(fw_process_flow_judge_drives(arena, f, false, two, 1, &diags), FW_OK);
    assert_int_equal(f->manufacturable, 0);
}

/* the pack itself may say that its carrier insulates; other words are mistakes */
static void pack_with_carrier(void **state) {
    (void)state;
    static const fw_process_drive_facts one = {.id = "c", .gap_m = 10e-6};
    fw_process_flow *f =
        judged(SILICON, "<process ", "<process carrier=\"insulating\" ", false, &one, 1);
    assert_int_equal(f->manufacturable, -1);
    assert_int_equal(warned(207), 0);
    f = judged(SILICON, "<process ", "<process carrier=\"none\" ", false, &one, 1);
    assert_int_equal(f->manufacturable, 0);
    assert_null(read_pack(arena, SILICON, "<process ", "<process carrier=\"glass\" ", &diags));
}

/* copper: no bias; 16 um of resist print 1.5 sqrt(405 nm 8 um) = 2.70 um in contact and 4.05 um at
   10 um of gap */
static void copper_gaps(void **state) {
    (void)state;
    const struct {
        double gap_m;
        int manufacturable, warns;
        const char *says;
    } at[] = {{2.6e-6, 0, 1, "below what 16 um of resist can print in contact"},
              {3.9e-6, -1, 0, "only in perfect contact"},
              {4.1e-6, -1, 0, NULL}};
    for (int i = 0; i < 3; i++) {
        const fw_process_drive_facts one = {.id = "c", .gap_m = at[i].gap_m};
        diags = fw_diags_new(arena);
        fw_process_flow *f = judged(COPPER, NULL, NULL, true, &one, 1);
        assert_int_equal(f->manufacturable, at[i].manufacturable);
        assert_int_equal(warned(208), at[i].warns);
        assert_int_equal(reasons(f, "gap of comb drive c"), at[i].says ? 1 : 0);
        if (at[i].says) assert_true(reasons(f, at[i].says) > 0);
    }
}

/* silicon: the aluminium's 1.1 um per edge is known and compensated, so that 2.1 um close and 3 um
   leave 0.8 um, below 1.5 sqrt(405 nm 1 um) = 0.955 um; the undercut is not known: 10 um are 11 and
   15 um at A = 0.99 and 0.95 through 50 um */
static void silicon_gaps(void **state) {
    (void)state;
    const fw_process_drive_facts closed = {.id = "c", .gap_m = 2.1e-6},
                                 narrow = {.id = "c", .gap_m = 3e-6},
                                 wide = {.id = "c", .gap_m = 10e-6};
    fw_process_flow *f = judged(SILICON, NULL, NULL, true, &closed, 1);
    assert_int_equal(f->manufacturable, 0);
    assert_int_equal(reasons(f, "closes the gap of comb drive c, 2.1 um drawn"), 1);
    f = judged(SILICON, NULL, NULL, true, &narrow, 1);
    assert_int_equal(f->manufacturable, 0);
    assert_int_equal(reasons(f, "gap of comb drive c is 0.8 um on the mask (3 um drawn)"), 1);
    assert_int_equal(warned(208), 2);
    f = judged(SILICON, NULL, NULL, true, &wide, 1);
    assert_int_equal(f->manufacturable, -1);
    assert_int_equal(reasons(f, "11 um at A = 0.99 and 15 um at A = 0.95"), 1);
    assert_int_equal(reasons(f, "0.909 and 0.667"), 1);
    /* told once per gap, and for each of another */
    const fw_process_drive_facts three[] = {wide, wide, {.id = "d", .gap_m = 12e-6}};
    f = judged(SILICON, NULL, NULL, true, three, 3);
    assert_int_equal(reasons(f, "is not known until the anisotropy A of step S18"), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(no_drive_changes_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(not_insulated, setup, teardown),
        cmocka_unit_test_setup_teardown(pack_with_carrier, setup, teardown),
        cmocka_unit_test_setup_teardown(copper_gaps, setup, teardown),
        cmocka_unit_test_setup_teardown(silicon_gaps, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
