/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "report/fixture.h"
#include "report/report.h"
#include <jansson.h>

static json_t *verdict_json(fw_arena *arena, const fw_report_input *input) {
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_report_verdict_json(input, &out), FW_OK);
    json_error_t error;
    json_t *root = json_loadb(out.data, out.length, JSON_REJECT_DUPLICATES, &error);
    if (!root) fail_msg("line %d: %s", error.line, error.text);
    return root;
}

static void keys_in_order(const json_t *object, const char *const *want, size_t n) {
    size_t i = 0;
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, key, value) {
        if (i < n) assert_string_equal(key, want[i]);
        i++;
    }
    assert_true(i >= n);
}

static void verdict_has_the_keys_of_the_contract(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    json_t *root = verdict_json(arena, &f->input);
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "flexwright.verdict/1");
    assert_string_equal(json_string_value(json_object_get(root, "verdict")), "inconclusive");
    assert_true(json_is_object(json_object_get(root, "governing")));
    json_t *hinges = json_object_get(root, "hinges");
    assert_int_equal(json_array_size(hinges), SIX);
    static const char *const keys[] = {
        "id",           "peak_angle_rad", "angle_error_rad", "limit_angle_rad", "peak_strain",
        "strain_limit", "utilisation",    "force_share",     "scene",           "t_s"};
    keys_in_order(json_array_get(hinges, 0), keys, sizeof keys / sizeof keys[0]);
    for (int j = 0; j < SIX; j++) {
        const json_t *h = json_array_get(hinges, (size_t)j);
        assert_string_equal(json_string_value(json_object_get(h, "id")), fixture_name[j]);
        /* 17 digits: the same bits come back */
        assert_true(json_real_value(json_object_get(h, "peak_angle_rad")) ==
                    f->verdict.hinge[j].peak_angle_rad);
        assert_true(json_real_value(json_object_get(h, "utilisation")) ==
                    f->verdict.hinge[j].utilisation);
    }
    json_t *workspace = json_object_get(root, "workspace");
    assert_int_equal(json_array_size(json_object_get(workspace, "required")), 1);
    assert_true(json_is_true(json_object_get(workspace, "certified")));
    assert_true(json_real_value(json_object_get(workspace, "volume")) == 2.5e-9);
    json_t *effects = json_object_get(root, "effects");
    assert_int_equal(json_array_size(effects), 8);
    assert_true(json_is_true(json_object_get(json_array_get(effects, 0), "active")));
    assert_true(json_is_null(json_object_get(json_array_get(effects, 0), "bound"))); /* infinite */
    assert_true(json_is_real(json_object_get(json_array_get(effects, 1), "bound")));
    json_t *accuracy = json_object_get(root, "accuracy");
    assert_true(json_real_value(json_object_get(accuracy, "wanted")) == 1e-3);
    assert_true(json_real_value(json_object_get(accuracy, "estimated")) == 2.1e-4);
    json_t *advice = json_object_get(root, "advice");
    json_t *set = json_array_get(json_object_get(json_array_get(advice, 0), "set"), 0);
    assert_string_equal(json_string_value(json_object_get(set, "path")), "flexure[A]/@length");
    assert_string_equal(json_string_value(json_object_get(set, "value")), "312 um");
    json_decref(root);
    fw_arena_free(arena);
}

static void flow_that_is_not_guaranteed_is_null(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.3);
    f->process[1].manufacturable = 0;
    json_t *root = verdict_json(arena, &f->input);
    assert_string_equal(json_string_value(json_object_get(root, "verdict")), "accept");
    json_t *flows = json_object_get(root, "flows");
    const json_t *first = json_array_get(flows, 0), *second = json_array_get(flows, 1);
    assert_string_equal(json_string_value(json_object_get(first, "id")), "al-masked-rie");
    assert_true(json_is_null(json_object_get(first, "manufacturable")));
    assert_int_equal(json_array_size(json_object_get(first, "reasons")), 2);
    assert_true(json_is_false(json_object_get(second, "manufacturable")));
    assert_int_equal(json_array_size(json_object_get(second, "hinges")), SIX);
    json_decref(root);
    fw_arena_free(arena);
}

static void number_that_is_not_finite_is_null(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.3);
    f->verdict.hinge[2].t_s = (double)NAN; /* from the workspace */
    f->verdict.hinge[2].utilisation = HUGE_VAL;
    for (int i = 0; i < VARIANTS; i++)
        f->variant_verdict[i].nhinge = 0;
    json_t *root = verdict_json(arena, &f->input);
    const json_t *h = json_array_get(json_object_get(root, "hinges"), 2);
    assert_true(json_is_null(json_object_get(h, "t_s")));
    assert_true(json_is_null(json_object_get(h, "utilisation")));
    assert_true(json_is_null(json_object_get(root, "governing")));
    json_decref(root);
    fw_arena_free(arena);
}

static void workspace_not_asked_for(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.3);
    f->variant_verdict[0].workspace.required = false;
    json_t *root = verdict_json(arena, &f->input);
    json_t *workspace = json_object_get(root, "workspace");
    assert_int_equal(json_array_size(json_object_get(workspace, "required")), 0);
    assert_true(json_is_false(json_object_get(workspace, "certified")));
    assert_true(json_is_null(json_object_get(workspace, "volume")));
    json_decref(root);
    /* what is required is of another flow's device: no box is told of this one */
    static const bool no[1] = {false};
    f->variant_verdict[0].workspace.required = true;
    for (int k = 0; k < 2; k++) {
        f->variant_verdict[0].workspace.asked = k ? no : NULL;
        root = verdict_json(arena, &f->input);
        assert_int_equal(json_array_size(json_object_get(json_object_get(root, "workspace"), "required")), 0);
        json_decref(root);
    }
    fw_arena_free(arena);
}

static void simulate_has_the_keys_of_the_contract(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    const fw_dynamics_motion *m = f->variant_verdict[0].motion[0];
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_report_simulate_json(&f->mechanism[0], m, &out), FW_OK);
    json_t *root = json_loadb(out.data, out.length, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    assert_string_equal(json_string_value(json_object_get(root, "schema")),
                        "flexwright.simulate/1");
    static const char *const stats[] = {"steps",       "rejected", "rhs",
                                        "projections", "cpu_s",    "max_constraint_norm"};
    keys_in_order(json_object_get(root, "stats"), stats, sizeof stats / sizeof stats[0]);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(root, "stats"), "rhs")),
                     5148);
    const json_t *peak = json_array_get(json_object_get(root, "peaks"), 2);
    static const char *const peak_keys[] = {"hinge", "angle_rad", "t_s"};
    keys_in_order(peak, peak_keys, 3);
    assert_true(json_real_value(json_object_get(peak, "angle_rad")) == m->peak[2].angle_rad);
    json_t *final = json_object_get(root, "final");
    assert_true(json_real_value(json_object_get(final, "t_s")) == m->t_s[SAMPLES - 1]);
    const json_t *q = json_object_get(json_object_get(final, "q"), "CD");
    const json_t *v = json_object_get(json_object_get(final, "v"), "CD");
    assert_int_equal(json_array_size(q), 3);
    for (size_t k = 0; k < 3; k++) {
        size_t at = (SAMPLES - 1) * 3 * FIVE + 6 + k;
        assert_true(json_real_value(json_array_get(q, k)) == m->q[at]);
        assert_true(json_real_value(json_array_get(v, k)) == m->v[at]);
    }
    json_decref(root);
    fw_arena_free(arena);
}

static void same_input_same_bytes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12), *g = fixture_new(arena, 0.12);
    fw_text a = fw_text_new(arena), b = fw_text_new(arena);
    assert_int_equal(fw_report_verdict_json(&f->input, &a), FW_OK);
    assert_int_equal(fw_report_verdict_json(&g->input, &b), FW_OK);
    assert_string_equal(a.data, b.data);
    fw_arena_free(arena);
}

static void out_of_memory_is_said(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    int failures = 0;
    for (long n = 1; n < 1000; n++) {
        fw_text out = fw_text_new(arena);
        fw_arena_fail_at(n, 0);
        fw_status status = fw_report_verdict_json(&f->input, &out);
        fw_arena_fail_at(0, 0);
        if (status == FW_OK) break;
        assert_int_equal(status, FW_NOMEM);
        failures++;
    }
    assert_true(failures > 3 && failures < 999);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdict_has_the_keys_of_the_contract),
        cmocka_unit_test(flow_that_is_not_guaranteed_is_null),
        cmocka_unit_test(number_that_is_not_finite_is_null),
        cmocka_unit_test(workspace_not_asked_for),
        cmocka_unit_test(simulate_has_the_keys_of_the_contract),
        cmocka_unit_test(same_input_same_bytes),
        cmocka_unit_test(out_of_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
