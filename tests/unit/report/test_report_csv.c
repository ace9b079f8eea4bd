/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "report/fixture.h"

static void header_and_every_bit(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    const fw_dynamics_motion *m = f->variant_verdict[0].motion[0];
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_report_motion_csv(&f->mechanism[0], m, &f->device.scene[0], &out), FW_OK);
    const char *line = out.data;
    static const char first[] =
        "t_s,AB.x_m,AB.y_m,AB.phi_rad,AB.vx_m_per_s,AB.vy_m_per_s,AB.omega_rad_per_s,"
        "BC.x_m,BC.y_m,BC.phi_rad,BC.vx_m_per_s,BC.vy_m_per_s,BC.omega_rad_per_s,"
        "CD.x_m,CD.y_m,CD.phi_rad,CD.vx_m_per_s,CD.vy_m_per_s,CD.omega_rad_per_s,"
        "DE.x_m,DE.y_m,DE.phi_rad,DE.vx_m_per_s,DE.vy_m_per_s,DE.omega_rad_per_s,"
        "EF.x_m,EF.y_m,EF.phi_rad,EF.vx_m_per_s,EF.vy_m_per_s,EF.omega_rad_per_s\n";
    assert_int_equal(strncmp(line, first, sizeof first - 1), 0);
    line += sizeof first - 1;
    for (int i = 0; i < SAMPLES; i++) {
        for (int c = 0; c < 1 + 6 * FIVE; c++) {
            size_t n = strcspn(line, ",\n");
            double value;
            assert_true(fw_number_parse(line, n, &value));
            int b = (c - 1) / 6, k = (c - 1) % 6;
            double want = c == 0  ? m->t_s[i]
                          : k < 3 ? m->q[(i * FIVE + b) * 3 + k]
                                  : m->v[(i * FIVE + b) * 3 + k - 3];
            if (value != want) /* bit for bit */
                fail_msg("row %d column %d: %.17g, expected %.17g", i, c, value, want);
            assert_int_equal(line[n], c == 6 * FIVE ? '\n' : ',');
            line += n + 1;
        }
    }
    assert_int_equal(*line, '\0');
    fw_arena_free(arena);
}

static void hostile_name_stays_in_its_cell(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    f->mechanism[0].body[0].id = "a\",b";
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_report_motion_csv(&f->mechanism[0], f->variant_verdict[0].motion[0],
                                          &f->device.scene[0], &out),
                     FW_OK);
    static const char want[] = "t_s,\"a\"\",b.x_m\",\"a\"\",b.y_m\",";
    assert_int_equal(strncmp(out.data, want, sizeof want - 1), 0);
    fw_arena_free(arena);
}

static void out_of_memory_is_said(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_text out = fw_text_new(arena);
    fw_arena_fail_at(3, 1);
    fw_status status = fw_report_motion_csv(&f->mechanism[0], f->variant_verdict[0].motion[0],
                                            &f->device.scene[0], &out);
    fw_arena_fail_at(0, 0);
    assert_int_equal(status, FW_NOMEM);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header_and_every_bit),
        cmocka_unit_test(hostile_name_stays_in_its_cell),
        cmocka_unit_test(out_of_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
