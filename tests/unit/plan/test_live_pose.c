/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses for dragging: against forward kinematics and closed joints, against each other (closed form
   and closing), against the circle of a crank, and where they end. */
#include "live_case.h"
#include "plan/design.h"
#include "plan/live.h"
#include "plan/stages.h"

static uint64_t seed = 88172645463325252ULL;

static double random_in(double low, double high) { /* xorshift64 (Marsaglia 2003) */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

static fw_design *design_of(const char *file, const fw_mechanism **m) {
    char path[512];
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    fw_design *design = fw_design_new(&o);
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, file);
    assert_int_equal(fw_design_read(design, path), FW_STATUS_OK);
    assert_int_equal(fw_plan_mechanism(fw_plan_design_plan(design), NULL, m), FW_OK);
    return design;
}

static void point(const double *q, int body, double x, double y, double to[2]) {
    double c = body == FW_GROUND ? 1.0 : cos(q[3 * body + 2]);
    double s = body == FW_GROUND ? 0.0 : sin(q[3 * body + 2]);
    to[0] = (body == FW_GROUND ? 0.0 : q[3 * body]) + c * x - s * y;
    to[1] = (body == FW_GROUND ? 0.0 : q[3 * body + 1]) + s * x + c * y;
}

/* largest distance between the two points of any pin */
static double open_by(const fw_mechanism *m, const double *q) {
    double worst = 0.0;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        double a[2], b[2];
        point(q, p->body_a, p->ax_m, p->ay_m, a);
        point(q, p->body_b, p->bx_m, p->by_m, b);
        worst = fmax(worst, hypot(a[0] - b[0], a[1] - b[1]));
    }
    return worst;
}

static void angles_fit(const fw_mechanism *m, const fw_plan_posed *p) {
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *pin = &m->pin[i];
        double a = pin->body_a == FW_GROUND ? 0.0 : p->q[3 * pin->body_a + 2];
        double b = pin->body_b == FW_GROUND ? 0.0 : p->q[3 * pin->body_b + 2];
        assert_near(remainder(b - a - pin->free_angle_rad - p->angle_rad[i], 2 * M_PI), 0, 1e-12);
    }
}

static void six_bar_closes_in_every_pose(void **state) {
    (void)state;
    const fw_mechanism *m;
    fw_design *design = design_of(SIX_BAR, &m);
    fw_arena *arena = fw_arena_new(0);
    int reached = 0;
    assert_int_equal(fw_plan_pose_body(m), 2);
    for (int i = 0; i < 2000; i++) {
        fw_mark mark = fw_arena_mark(arena);
        const double asked[3] = {random_in(-1.5e-3, 1.5e-3), random_in(-1.5e-3, 1.5e-3),
                                 random_in(-1.2, 1.2)};
        fw_plan_posed p;
        assert_int_equal(fw_plan_pose_solve(arena, m, 2, asked, NULL, &p), FW_OK);
        assert_true(p.closed_form);
        assert_true(open_by(m, p.q) < 1e-15);
        angles_fit(m, &p);
        for (int k = 0; k < 3; k++)
            assert_near(p.at[k], p.share * asked[k], 1e-15);
        assert_near(p.q[6], m->body[2].x_m + p.at[0], 2e-15);
        assert_near(p.q[7], m->body[2].y_m + p.at[1], 2e-15);
        assert_near(remainder(p.q[8] - m->body[2].phi_rad - p.at[2], 2 * M_PI), 0, 2e-15);
        reached += p.reachable;
        assert_true(p.reachable == (p.share == 1.0) && p.reachable == !p.reason);
        if (!p.reachable) { /* a little farther there is nothing: it is the end of the way */
            const double beyond[3] = {(p.share + 1e-9) * asked[0], (p.share + 1e-9) * asked[1],
                                      (p.share + 1e-9) * asked[2]};
            fw_plan_posed q;
            assert_int_equal(fw_plan_pose_solve(arena, m, 2, beyond, NULL, &q), FW_OK);
            assert_false(q.reachable);
        }
        fw_arena_rewind(arena, mark);
    }
    assert_true(reached > 200 && reached < 1900);
    fw_arena_free(arena);
    fw_design_free(design);
}

static fw_mechanism not_known_as_six_bar(const fw_mechanism *m, fw_device *device) {
    fw_mechanism other = *m;
    *device = *m->device;
    device->six_bar = false;
    other.device = device;
    return other;
}

/* of bodies and pins as drawn, the larger way */
static double extent_of(const fw_mechanism *m) {
    fw_geometry_vec2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
    for (int i = -m->nbody; i < m->npin; i++) {
        fw_geometry_vec2 p =
            i < 0 ? (fw_geometry_vec2){m->body[i + m->nbody].x_m, m->body[i + m->nbody].y_m}
                  : fw_mechanism_pin_place(m, &m->pin[i], 0);
        low = (fw_geometry_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (fw_geometry_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return fmax(high.x - low.x, high.y - low.y);
}

/* the same mechanism, not known to be a six-bar: two ways to one answer */
static void closing_agrees_with_the_closed_form(void **state) {
    (void)state;
    const fw_mechanism *m;
    fw_design *design = design_of(SIX_BAR, &m);
    fw_arena *arena = fw_arena_new(0);
    fw_device device;
    const fw_mechanism other = not_known_as_six_bar(m, &device);
    for (int i = 0; i < 200; i++) {
        fw_mark mark = fw_arena_mark(arena);
        const double asked[3] = {random_in(-3e-4, 3e-4), random_in(-2e-4, 2e-4),
                                 random_in(-0.2, 0.2)};
        fw_plan_posed a, b;
        assert_int_equal(fw_plan_pose_solve(arena, m, 2, asked, NULL, &a), FW_OK);
        assert_int_equal(fw_plan_pose_solve(arena, &other, 2, asked, NULL, &b), FW_OK);
        if (a.reachable) {
            assert_true(b.reachable && !b.closed_form);
            double size = extent_of(m);
            for (int k = 0; k < 15; k++)
                assert_near(a.q[k], b.q[k], 3e-7 * (k % 3 == 2 ? 1 : size));
        }
        assert_true(open_by(m, b.q) < 1e-14);
        angles_fit(m, &b);
        fw_arena_rewind(arena, mark);
    }
    fw_arena_free(arena);
    fw_design_free(design);
}

/* far away in one go, and back from there */
static void closing_keeps_its_branch(void **state) {
    (void)state;
    const fw_mechanism *m;
    fw_design *design = design_of(SIX_BAR, &m);
    fw_arena *arena = fw_arena_new(0);
    fw_device device;
    const fw_mechanism other = not_known_as_six_bar(m, &device);
    const double far[3] = {0, 5e-3, 0}, home[3] = {0, 0, 0};
    fw_plan_posed a, b;
    assert_int_equal(fw_plan_pose_solve(arena, &other, 2, far, NULL, &a), FW_OK);
    assert_true(!a.reachable && a.reason && open_by(m, a.q) < 1e-13);
    assert_true(a.at[1] > 0 && a.at[1] < 5e-3);
    assert_int_equal(fw_plan_pose_solve(arena, &other, 2, home, a.q, &b), FW_OK);
    assert_true(b.reachable);
    for (int k = 0; k < m->nbody; k++) {
        assert_near(b.q[3 * k], m->body[k].x_m, 1e-10);
        assert_near(b.q[3 * k + 1], m->body[k].y_m, 1e-10);
        assert_near(b.q[3 * k + 2], m->body[k].phi_rad, 1e-7);
    }
    const double absurd[3] = {1e5, -1e5, 1e5};
    assert_int_equal(fw_plan_pose_solve(arena, &other, 2, absurd, NULL, &a), FW_OK);
    assert_true(!a.reachable && open_by(m, a.q) < 1e-12);
    fw_arena_free(arena);
    fw_design_free(design);
}

/* a crank about its pin: the nearest point of the circle is the one in the direction asked; every
   other body goes along */
static void one_freedom_stays_on_its_curve(void **state) {
    (void)state;
    const fw_mechanism *m;
    fw_design *design = design_of("docs/mechanisms/slider-crank.xml", &m);
    fw_arena *arena = fw_arena_new(0);
    double size = extent_of(m);
    for (int i = 0; i < 50; i++) {
        fw_mark mark = fw_arena_mark(arena);
        const double asked[3] = {random_in(-size, size), random_in(-size, size), (double)NAN};
        fw_plan_posed p;
        for (int b = 0; b < m->nbody; b++) {
            assert_int_equal(fw_plan_pose_solve(arena, m, b, asked, NULL, &p), FW_OK);
            assert_true(open_by(m, p.q) < 1e-12 * size);
            angles_fit(m, &p);
        }
        /* small pulls, where the nearest point is near: x - o is parallel to wanted - o */
        const fw_mechanism_pin *pin = &m->pin[0];
        assert_int_equal(pin->body_a, FW_GROUND);
        int crank = pin->body_b;
        double r = hypot(pin->bx_m, pin->by_m);
        if (r > 1e-9) {
            const double pull[3] = {random_in(-0.1, 0.1) * r, random_in(-0.1, 0.1) * r,
                                    (double)NAN};
            assert_int_equal(fw_plan_pose_solve(arena, m, crank, pull, NULL, &p), FW_OK);
            double wx = m->body[crank].x_m + pull[0] - pin->ax_m;
            double wy = m->body[crank].y_m + pull[1] - pin->ay_m, w = hypot(wx, wy);
            assert_near(p.q[3 * crank], pin->ax_m + r * wx / w, 1e-4 * r);
            assert_near(p.q[3 * crank + 1], pin->ay_m + r * wy / w, 1e-4 * r);
        }
        fw_arena_rewind(arena, mark);
    }
    fw_arena_free(arena);
    fw_design_free(design);
}

/* ---- the request ---- */

static void the_answer_names_hinges_limits_and_flows(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a = ask_file(live, fw_plan_live_pose, SIX_BAR,
                         "\"platform\":{\"x_m\":1e-4,\"y_m\":5e-5,\"phi_rad\":0.02}");
    assert_string_equal(text_at(a, "schema"), "flexwright.pose/1");
    assert_string_equal(text_at(a, "status"), "ok");
    assert_string_equal(text_at(a, "body"), "CD");
    assert_true(json_is_true(json_object_get(a, "reachable")));
    const json_t *flows = json_object_get(a, "flows");
    assert_int_equal(json_array_size(flows), 2);
    for (size_t f = 0; f < 2; f++) {
        const json_t *flow = json_array_get(flows, f), *hinges = json_object_get(flow, "hinges");
        double most = 0;
        assert_int_equal(json_array_size(hinges), 6);
        for (size_t i = 0; i < 6; i++) {
            const json_t *h = json_array_get(hinges, i);
            double used = fabs(real_at(h, "angle_rad")) / real_at(h, "limit_rad");
            assert_relative(real_at(h, "utilisation"), used, 1e-6);
            assert_relative(real_at(h, "angle_rad"), item(json_object_get(a, "angle_rad"), (int)i),
                            1e-10);
            if (used > most && strcmp(text_at(h, "id"), text_at(flow, "governing")) == 0)
                most = used;
            else
                assert_true(used <= real_at(flow, "utilisation") * (1 + 1e-6));
        }
        assert_relative(most, real_at(flow, "utilisation"), 1e-6);
        assert_true(json_is_true(json_object_get(flow, "within_limits")) == (most <= 1));
    }
    json_decref(a);
    fw_plan_live_free(live);
}

/* sets and texts are looked at anew, whatever was posed before; an answer does not depend on those
   before it */
static void nothing_is_remembered_wrongly(void **state) {
    (void)state;
    fw_plan_live *live = live_new(), *other = live_new();
    static const char *const more[] = {
        "\"platform\":{\"x_m\":1e-4}", "\"platform\":{\"x_m\":1e-4},\"set\":{\"arc\":\"200 deg\"}",
        "\"platform\":{\"x_m\":1e-4},\"flow\":\"copper-on-porous-silicon\"",
        "\"platform\":{\"x_m\":1e-4},\"set\":{\"arc\":\"2 deg\"}"};
    for (int round = 0; round < 2; round++)
        for (size_t i = 0; i < 4; i++) {
            char *request = request_of(SIX_BAR, more[i]);
            fw_plan_live *fresh = live_new();
            json_t *a = ask(live, fw_plan_live_pose, request, FW_OK);
            json_t *b = ask(fresh, fw_plan_live_pose, request, FW_OK);
            assert_true(json_equal(a, b));
            assert_string_equal(text_at(a, "status"), i == 3 ? "invalid" : "ok");
            if (i == 3) assert_true(json_array_size(json_object_get(a, "diagnostics")) > 0);
            json_decref(a), json_decref(b);
            fw_plan_live_free(fresh);
            free(request);
        }
    fw_plan_live_free(live);
    fw_plan_live_free(other);
}

static void a_drag_goes_on_from_the_last_answer(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    static const char comb[] = "docs/gallery/comb-stage/device.xml";
    json_t *a = ask_file(live, fw_plan_live_pose, comb, "\"platform\":{\"x_m\":1e-6}");
    assert_string_equal(text_at(a, "how"), "assembly");
    char *q = json_dumps(json_object_get(a, "q"), 0), more[1024];
    snprintf(more, sizeof more, "\"platform\":{\"x_m\":1.1e-6},\"q\":%s", q);
    json_t *b = ask_file(live, fw_plan_live_pose, comb, more);
    assert_string_equal(text_at(b, "status"), "ok");
    assert_int_equal(json_array_size(json_object_get(b, "q")),
                     json_array_size(json_object_get(a, "q")));
    free(q);
    json_decref(a), json_decref(b);
    fw_plan_live_free(live);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(six_bar_closes_in_every_pose),
        cmocka_unit_test(closing_agrees_with_the_closed_form),
        cmocka_unit_test(closing_keeps_its_branch),
        cmocka_unit_test(one_freedom_stays_on_its_curve),
        cmocka_unit_test(the_answer_names_hinges_limits_and_flows),
        cmocka_unit_test(nothing_is_remembered_wrongly),
        cmocka_unit_test(a_drag_goes_on_from_the_last_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
