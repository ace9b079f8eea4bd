/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "drive_rig.h"
#include "effects/effects.h"

static const double eps0 = 8.8541878128e-12;

static const fw_device_comb comb = {.id = "comb",
                                    .kind = FW_ELECTRODES_COMB,
                                    .body_a = FW_GROUND,
                                    .body_b = 0,
                                    .bx_m = 0.1e-3,
                                    .by_m = -0.05e-3,
                                    .direction_rad = 0.7,
                                    .fingers = 20,
                                    .gap_m = 4e-6,
                                    .overlap_m = 60e-6,
                                    .length_m = 140e-6,
                                    .depth_m = (double)NAN,
                                    .voltage_V = 30};

static fw_device_comb plate_of(void) {
    fw_device_comb c = comb;
    c.kind = FW_ELECTRODES_PLATE;
    c.length_m = 200e-6;
    c.gap_m = 5e-6;
    return c;
}

static void with_comb(rig *r, const fw_device_comb *c) {
    rig_new(r, 7);
    r->scene.comb = fw_arena_one(r->arena, fw_device_comb);
    r->scene.comb[0] = *c;
    r->scene.ncomb = 1;
    rig_compile(r);
}

/* the same between parallel faces alone */
static void without_fringe(rig *r, const fw_device_comb *c) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_NONE};
    with_comb(r, c);
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &choice, 1e-3, &r->diags, &r->ledger, &r->loads), FW_OK);
    r->e = &r->loads.element[0];
}

static fw_effects_port_state seen(const double *p, const double *w, double t, double load) {
    return (fw_effects_port_state){.t_s = t, .piece_s = t, .load = load, .p = p, .w = w};
}

/* ports of the rig with the rotor at x, y, tilt against the stator */
static void place_rotor(const rig *r, double x, double y, double tilt, double *p) {
    double q[3 * RIG_BODIES], w[6];
    const fw_device_comb *c = &r->scene.comb[0];
    rig_pose(r, q);
    fw_effects_element_place_ports(r->e, q, NULL, p, w);
    double u = cos(c->direction_rad + p[2]), v = sin(c->direction_rad + p[2]);
    p[3] += u * x - v * y;
    p[4] += v * x + u * y;
    p[5] += tilt;
}

/* composite Gauss-Legendre of order 6 on 2000 pieces: an independent way to the capacitance */
static double integral(double a, double b, double gap, double tilt) {
    const double at = sqrt(0.6);
    double total = 0, h = (b - a) / 2000;
    for (int i = 0; i < 2000; i++) {
        double m = a + (i + 0.5) * h;
        total += h / 18 *
                 (5 / (gap + tilt * (m - at * h / 2)) + 8 / (gap + tilt * m) +
                  5 / (gap + tilt * (m + at * h / 2)));
    }
    return total;
}

/* what ends of fingers add, of the laws that test_fringe.c has against boundary elements: fingers of a tilted comb at two places */
static double of_ends(const fw_effects_comb_element *c, double x, double y, double tilt) {
    const double g = 4e-6, away = 140e-6 - 60e-6 - x, turned = 24e-6 * sqrt(399.0 / 12) * tilt, at[2] = {30e-6, -30e-6 - x};
    double by[2], all = 4 * c->tip.ends + 2 * fw_effects_comb_tip(&c->tip, away + turned, by) +
                        2 * fw_effects_comb_tip(&c->tip, away - turned, by);
    for (int k = 0; k < 2; k++) {
        const double off = y + tilt * at[k];
        all += fw_effects_comb_tip_aside(&c->tip, away, by) * (g / (g - off) + g / (g + off) - 2);
    }
    return eps0 * 50e-6 * 20 * all;
}

/* the closed form against quadrature, from no tilt to nearly touching, through both branches of
   the series */
static void test_capacitance(void **state) {
    (void)state;
    rig r;
    without_fringe(&r, &comb);
    const fw_effects_comb_element *c = fw_effects_comb_of(r.e);
    for (int i = 0; i < 300; i++) {
        double scale = pow(10, -6 * fabs(rig_random(&r)));
        double x = 50e-6 * rig_random(&r), y = 2e-6 * rig_random(&r);
        double tilt = scale * 3e-2 * rig_random(&r);
        double a = -30e-6 - x, b = 30e-6, g = 4e-6;
        const double place[3] = {x, y, tilt};
        if (fmax(fabs(y + tilt * a), fabs(y + tilt * b)) > 0.98 * g) continue;
        double want =
            eps0 * 50e-6 * 20 * (integral(a, b, g - y, -tilt) + integral(a, b, g + y, tilt)) + of_ends(c, x, y, tilt);
        assert_relative(fw_effects_comb_capacitance(c, place, NULL, NULL), want, 1e-9);
    }
    fw_arena_free(r.arena);
    fw_device_comb flat = plate_of();
    without_fringe(&r, &flat);
    c = fw_effects_comb_of(r.e);
    for (int i = 0; i < 300; i++) {
        double x = 2.5e-6 * rig_random(&r), tilt = 2.4e-2 * rig_random(&r);
        const double place[3] = {x, 1e-6 * rig_random(&r), tilt};
        double want = eps0 * 50e-6 * integral(-100e-6, 100e-6, 5e-6 - x, tilt);
        assert_relative(fw_effects_comb_capacitance(c, place, NULL, NULL), want, 1e-9);
    }
    fw_arena_free(r.arena);
}

/* derivatives of the capacitance by differences, also across q = 0.2 where series and closed form
   meet, and at no tilt at all */
static void test_derivatives(void **state) {
    (void)state;
    rig r;
    with_comb(&r, &comb);
    const fw_effects_comb_element *c = fw_effects_comb_of(r.e);
    static const double tilts[] = {0, 1e-9, 1e-3, 0.0297, 0.03, -0.0463, 0.05};
    const double h[3] = {2e-8, 2e-8, 2e-5}, unit[3] = {1e-6, 1e-6, 1e-3};
    for (int i = 0; i < 7; i++) {
        const double at[3] = {3e-6, 0.3e-6, tilts[i]};
        double slope[3], bend[9], size = 0;
        double value = fw_effects_comb_capacitance(c, at, slope, bend);
        for (int k = 0; k < 9; k++)
            size = fmax(size, fabs(bend[k] * unit[k / 3] * unit[k % 3]));
        for (int k = 0; k < 3; k++) {
            double v[7], s[3][7], sl[3];
            for (int j = -3; j <= 3; j++) {
                double moved[3] = {at[0], at[1], at[2]};
                moved[k] += j * h[k];
                v[j + 3] = fw_effects_comb_capacitance(c, moved, sl, NULL);
                for (int l = 0; l < 3; l++)
                    s[l][j + 3] = sl[l];
            }
            assert_near(fw_check_slope(v, h[k]) * unit[k], slope[k] * unit[k], 1e-9 * value);
            for (int l = 0; l < 3; l++)
                assert_near(fw_check_slope(s[l], h[k]) * unit[k] * unit[l],
                            bend[3 * l + k] * unit[k] * unit[l], 1e-8 * size);
        }
    }
    fw_arena_free(r.arena);
}

/* N eps0 h V^2/g along the comb, -2 N eps0 h L V^2/g^3 as stiffness across, tilt about the middle
   -N eps0 h L^3 V^2/(6 g^3); of the plate eps0 A V^2/(2 g^2), -eps0 A V^2/g^3 */
static void test_closed_forms(void **state) {
    (void)state;
    rig r;
    double p[6], f[6], stiffness[36], damping[36];
    const double w[6] = {0};
    without_fringe(&r, &comb);
    place_rotor(&r, 0, 0, 0, p);
    fw_effects_port_state s = seen(p, w, 0, 1);
    r.e->class_->force(r.e, &s, f);
    r.e->class_->tangent(r.e, &s, stiffness, damping);
    double face = 20 * eps0 * 50e-6 * 900, u = cos(0.7), v = sin(0.7), g = 4e-6, l = 60e-6;
    /* the root is 80 um away, 20 gaps: what it adds to the pull is below round-off; ends add to what is aside */
    double by[2], b = fw_effects_comb_tip_aside(&fw_effects_comb_of(r.e)->tip, 80e-6, by);
    assert_relative(u * f[3] + v * f[4], face / g, 1e-12);
    assert_near(-v * f[3] + u * f[4], 0, 1e-11 * face / g);
    assert_near(f[5], 0, 1e-11 * l * face / g);
    double side = 0, along = 0;
    const double n[2] = {-v, u}, e[2] = {u, v};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            side += n[i] * stiffness[6 * (3 + i) + 3 + k] * n[k];
            along += e[i] * stiffness[6 * (3 + i) + 3 + k] * e[k];
        }
    assert_true(b > 0.2 && b < 0.32);
    assert_relative(side, -2 * face * (l + 2 * b * g) / (g * g * g), 1e-12);
    assert_near(along, 0, 1e-10 * fabs(side));
    assert_relative(stiffness[35], -face * (l * l * l / (6 * g * g * g) + b * l * l / (g * g)), 1e-10);
    /* half way into the gap: 1/(g - y)^2 - 1/(g + y)^2 */
    place_rotor(&r, 0, 2e-6, 0, p);
    r.e->class_->force(r.e, &s, f);
    assert_relative(-v * f[3] + u * f[4], 0.5 * face * (l + 2 * b * g) * (1 / 4e-12 - 1 / 36e-12), 1e-12);
    fw_arena_free(r.arena);

    fw_device_comb flat = plate_of();
    without_fringe(&r, &flat);
    place_rotor(&r, 1e-6, 3e-6, 0, p);
    s = seen(p, w, 0, 0.25); /* half the voltage */
    r.e->class_->force(r.e, &s, f);
    r.e->class_->tangent(r.e, &s, stiffness, damping);
    double area = 50e-6 * 200e-6, left = 4e-6;
    assert_relative(u * f[3] + v * f[4], eps0 * area * 225 / (2 * left * left), 1e-12);
    along =
        u * (stiffness[21] * u + stiffness[22] * v) + v * (stiffness[27] * u + stiffness[28] * v);
    assert_relative(along, -eps0 * area * 225 / (left * left * left), 1e-12);
    r.e->class_->slope(r.e, &s, damping);
    for (int i = 0; i < 6; i++)
        assert_near(damping[i] * 0.25, f[i], 1e-15 * fabs(f[i]));
    fw_arena_free(r.arena);
}

/* walls that lean: of plates that stand parallel eps0 h L atanh(l/m)/l, and with the means of 1/gap^2 and 2/gap^3; fingers pull
   along with the mean of 1/gap of either side. They touch where the narrowest face does */
static void test_leaning_walls(void **state) {
    (void)state;
    rig r;
    const char *why = NULL;
    const double w[6] = {0}, lean[] = {0.2e-6, 1.5e-6};
    double p[6], slope[3], bend[9];
    for (int i = 0; i < 2; i++) {
        const double l = lean[i];
        fw_device_comb flat = plate_of();
        flat.lean_m = l;
        without_fringe(&r, &flat);
        const fw_effects_comb_element *c = fw_effects_comb_of(r.e);
        for (double x = -1e-6; x < 5e-6 - 2 * l && x < 3e-6; x += 0.5e-6) {
            const double m = 5e-6 - x, area = eps0 * 50e-6 * 200e-6, parts = m * m - l * l, at[3] = {x, 0, 0};
            assert_relative(fw_effects_comb_capacitance(c, at, slope, bend), area * atanh(l / m) / l, 1e-6);
            assert_relative(slope[0], area / parts, 1e-4);
            assert_relative(bend[0], 2 * area * m / (parts * parts), 1e-3);
            assert_relative(fw_effects_comb_capacitance(c, at, NULL, NULL), fw_effects_comb_capacitance(c, at, slope, NULL), 1e-15);
        }
        fw_effects_port_state s = seen(p, w, 0, 1);
        place_rotor(&r, 4.7e-6 - l, 0, 0, p);
        assert_true(r.e->class_->valid(r.e, &s, &why));
        place_rotor(&r, 4.8e-6 - l, 0, 0, p);
        assert_false(r.e->class_->valid(r.e, &s, &why));
        fw_arena_free(r.arena);
        fw_device_comb fingers = comb;
        fingers.lean_m = l;
        without_fringe(&r, &fingers);
        const double at[3] = {0, 0.5e-6, 0}, f = 20 * eps0 * 50e-6, near = 3.5e-6, far = 4.5e-6;
        fw_effects_comb_capacitance(fw_effects_comb_of(r.e), at, slope, NULL);
        assert_relative(slope[0], f * (atanh(l / near) + atanh(l / far)) / l, 1e-4);
        fw_arena_free(r.arena);
    }
}

/* power, tangent and balance on random states; stator on the ground or a body that turns, voltage
   constant or a sine in time */
static void test_laws(void **state) {
    (void)state;
    static const fw_quantity_law sine = {.kind = &fw_quantity_law_sine,
                                         .end_s = (double)INFINITY,
                                         .frequency_Hz = 700,
                                         .phase_rad = 0.9};
    for (int kind = 0; kind < 8; kind++) {
        fw_device_comb c = kind & 1 ? plate_of() : comb;
        if (kind & 2) c.body_a = 1;
        if (kind & 4) c.law = &sine;
        rig r;
        with_comb(&r, &c);
        assert_int_equal(r.e->laws, kind & 4 ? 1 : 0);
        assert_true(r.e->works == (r.e->laws > 0));
        const char *why;
        int checked = 0;
        for (int i = 0; i < 60; i++) {
            double p[6], w[6];
            place_rotor(&r, 2e-6 * rig_random(&r), 2e-6 * rig_random(&r), 0.02 * rig_random(&r), p);
            for (int k = 0; k < 6; k++)
                w[k] = (k % 3 == 2 ? 8 : 1.5e-3) * rig_random(&r);
            if (kind & 2) { /* any turn of the whole */
                double turn = 3 * rig_random(&r), x = p[0], y = p[1], x1 = p[3], y1 = p[4];
                p[0] = cos(turn) * x - sin(turn) * y, p[1] = sin(turn) * x + cos(turn) * y;
                p[3] = cos(turn) * x1 - sin(turn) * y1, p[4] = sin(turn) * x1 + cos(turn) * y1;
                p[2] += turn, p[5] += turn;
            }
            fw_effects_port_state s = seen(p, w, 1e-4 * i, 1 + 0.5 * rig_random(&r));
            if (!r.e->class_->valid(r.e, &s, &why)) continue;
            checked++;
            fw_check_tangent(r.e, &s, 1e-8, 1e-5, 1e-6);
            fw_check_power(r.e, &s, 1e-7, 1e-6);
            fw_check_balance(r.e, &s, 1e-11);
        }
        assert_true(checked > 20);
        fw_arena_free(r.arena);
    }
}

static void test_valid(void **state) {
    (void)state;
    rig r;
    double p[6];
    const double w[6] = {0};
    const char *why = NULL;
    with_comb(&r, &comb);
    fw_effects_port_state s = seen(p, w, 0, 1);
    static const struct {
        double x, y, tilt;
        bool fine;
        const char *says;
    } at[] = {{0, 0, 0, true, ""},
              {0, 3.79e-6, 0, true, ""},
              {0, 3.81e-6, 0, false, "pull-in"},
              {0, -3.81e-6, 0, false, "pull-in"},
              {0, 0, 0.1266, true, ""}, /* 30 um arm: 3.798 um */
              {0, 0, 0.1268, false, "pull-in"},
              {20e-6, 0, -0.0768, false, "pull-in"}, /* 50 um arm to the stator's tip */
              {-59e-6, 0, 0, true, ""},
              {-60.1e-6, 0, 0, false, "left each other"},
              {79e-6, 0, 0, true, ""},
              {80.1e-6, 0, 0, false, "root"}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        place_rotor(&r, at[i].x, at[i].y, at[i].tilt, p);
        assert_int_equal(r.e->class_->valid(r.e, &s, &why), at[i].fine);
        if (!at[i].fine) assert_non_null(strstr(why, at[i].says));
    }
    /* beyond touch nothing finite pretends to be a force */
    double f[6];
    place_rotor(&r, 0, 4.5e-6, 0, p);
    r.e->class_->force(r.e, &s, f);
    assert_true(isnan(f[3]));
    fw_arena_free(r.arena);
    fw_device_comb flat = plate_of();
    with_comb(&r, &flat);
    place_rotor(&r, 4.7e-6, 0, 0, p);
    assert_true(r.e->class_->valid(r.e, &s, &why));
    place_rotor(&r, 4.8e-6, 0, 0, p);
    assert_false(r.e->class_->valid(r.e, &s, &why));
    place_rotor(&r, 0, 0, 0.0476, p); /* 100 um arm: 4.76 um */
    assert_false(r.e->class_->valid(r.e, &s, &why));
    fw_arena_free(r.arena);
}

/* thickness of the flow where no depth is given; fingers twice the overlap; no voltage, no element;
   of its fringe all and half of it may be missing */
static void test_compiled(void **state) {
    (void)state;
    rig r;
    fw_device_comb c = comb;
    c.length_m = (double)NAN;
    without_fringe(&r, &c);
    const fw_effects_comb_element *d = fw_effects_comb_of(r.e);
    assert_near(d->depth_m, 50e-6, 0);
    assert_near(d->length_m, 120e-6, 1e-20);
    /* and of what tips pull a twentieth, a quarter of the way to the root left; half of the edges' share stays as it counts */
    const double tips = fw_effects_comb_tip_share(d, 15e-6), edges = fw_effects_comb_edge(4e-6, 8e-6, NULL) * 4e-6 / 50e-6;
    const double near[3] = {58e-6, 0, 0}, far[3] = {0, 0, 0};
    assert_relative(fw_effects_comb_fringe(d, NULL), 1.5 * edges + 0.05 * tips / (1 + tips), 1e-13);
    assert_true(fw_effects_comb_fringe(d, near) > 1.5 * edges + 0.04);
    assert_relative(fw_effects_comb_fringe(d, far), 1.5 * edges, 1e-9);
    assert_true(fw_effects_comb_capacitance_off(d, far) > 1.5 * edges && fw_effects_comb_capacitance_off(d, far) < 1.6 * edges + 0.05);
    assert_null(fw_effects_comb_out_of_range(d));
    fw_effects_comb_element odd = *d;
    odd.overlap_m = 1e-6;
    assert_non_null(fw_effects_comb_out_of_range(&odd));
    odd = *d, odd.width_m = 0.15e-6;
    assert_non_null(fw_effects_comb_out_of_range(&odd));
    odd = *d, odd.depth_m = 1.5e-6;
    assert_non_null(fw_effects_comb_out_of_range(&odd));
    assert_true(r.e->size_N_per_m > 0 && r.e->force_N > 0 && !r.e->works && !r.e->dissipates);
    const fw_effect_entry *entry = NULL;
    for (int i = 0; i < r.ledger.count; i++)
        if (strcmp(r.ledger.item[i].id, "comb-drive") == 0) entry = &r.ledger.item[i];
    assert_true(entry && entry->active && isinf(entry->bound));
    r.scene.comb[0].voltage_V = 0;
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    assert_int_equal(
        fw_effects_compile(r.arena, &r.m, &r.scene, &all, 1e-3, &r.diags, &r.ledger, &r.loads),
        FW_OK);
    assert_int_equal(r.loads.nelement, 0);
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_capacitance),  cmocka_unit_test(test_derivatives),
        cmocka_unit_test(test_closed_forms), cmocka_unit_test(test_laws),
        cmocka_unit_test(test_valid),        cmocka_unit_test(test_compiled),
        cmocka_unit_test(test_leaning_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
