/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "element_check.h"
#include "hinge_rigs.h"
#include "quantity/law_kind.h"

static const double nan_ = (double)NAN;

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

/* one body on a hinge to the ground, its centre of mass in W; surfaces that face each other where
   (from, to) in the world; NaN: everywhere */
static void rig_lever(rig *r, double axis, bool first_is_a, bool convex_is_a, double from,
                      double to) {
    rig_new(r, 1, 1);
    r->body[0] = (fw_mechanism_mass){"lever", 1e-8, 1e-15, 1e-4, 2e-4, 0.3, {0, 0}};
    rig_hinge(r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){1e-4, 2e-4}, axis, first_is_a);
    r->pin[0].free_angle_rad = 0.3; /* drawn as it is free */
    r->hinge[0].convex_is_a = convex_is_a;
    r->hinge[0].cover_from_rad = from, r->hinge[0].cover_to_rad = to;
}

static const fw_effects_force_element *touching(rig *r, fw_device_contact_use *use) {
    r->scene.contact = use, r->scene.ncontact = 1;
    rig_compile(r);
    assert_int_equal(fw_effect_contact.add(&r->c, &r->loads), FW_OK);
    const fw_effects_force_element *e = &r->loads.element[r->loads.nelement - 1];
    assert_string_equal(e->class_->effect, "contact");
    assert_int_equal(e->switches, 1);
    assert_int_equal(e->pin, FW_NONE);
    return e;
}

static double switched(const fw_effects_force_element *e, const double *p, const double *w) {
    const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
    return e->class_->switch_value(e, &s, 0);
}

/* A bead that is placed between surfaces of a layer that warms up by a law, and one that is etched of it: the distance in
   lengths of the layer is l (1 + 5e-3 law)/(1 + 2e-2 law), and l. What the change of it feeds in is in the balance of power */
static void placed_in_heat(void **state) {
    (void)state;
    unsigned seed = 11;
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 2e-3};
    for (int i = 0; i < 60; i++) {
        rig r;
        fw_device_temperature t = {.change_K = 100,
                                   .expansion_per_K = 2e-4,
                                   .substrate_expansion_per_K = 1e-4,
                                   .modulus_change_per_K = 0,
                                   .law = i % 2 ? &ramp : NULL};
        fw_device_contact_use use = {.id = "bead",
                                     .joint = FW_NONE,
                                     .side = FW_CONTACT_OUTSIDE,
                                     .face = i / 2 % 2,
                                     .body_a = FW_GROUND,
                                     .body_b = 0,
                                     .distance_m = 2e-6,
                                     .stiffness_N_per_m = 1e4,
                                     .damping_Ns_per_m = 0.02,
                                     .expansion_per_K = 5e-5,
                                     .undrawn = i / 4 % 2 ? FW_UNDRAWN_PLACED : FW_UNDRAWN_ETCHED};
        rig_lever(&r, 1, true, true, nan_, nan_);
        r.scene.duration_s = 4e-3;
        r.scene.temperature = &t, r.scene.ntemperature = 1;
        const fw_effects_force_element *e = touching(&r, &use);
        double p[6], w[6];
        for (int k = 0; k < 6; k++) {
            p[k] = (k % 3 == 2 ? 0.3 : 1e-6) * random_(&seed);
            w[k] = (k % 3 == 2 ? 300 : 4e-3) * random_(&seed);
        }
        const bool on = true;
        const double at = 3e-4 * (1 + i % 3), law = i % 2 ? at / 2e-3 : 1;
        fw_effects_port_state s = {.t_s = at, .piece_s = at, .load = 1, .p = p, .w = w, .on = &on};
        fw_check_tangent(e, &s, 2e-10, 1e-5, 2e-6);
        fw_check_power(e, &s, 1e-9, 1e-6);
        fw_check_balance(e, &s, 1e-11);
        const double x = p[3] - p[0], y = p[4] - p[1],
                     own = i / 4 % 2 ? 2e-6 * (1 + 5e-3 * law) / (1 + 2e-2 * law) : 2e-6,
                     over = own - (use.face ? cos(p[2]) * x + sin(p[2]) * y : hypot(x, y));
        assert_near(e->class_->energy(e, &s), 0.5e4 * over * over, 1e-9 * 0.5e4 * 4e-12);
        fw_arena_free(r.arena);
    }
}

/* random states on both sides of the switch, both flags, conjugate surfaces of all senses and round
   things; no force, energy and power while it is off */
static void element_laws(void **state) {
    (void)state;
    unsigned seed = 5;
    int closed = 0;
    for (int i = 0; i < 200; i++) {
        rig r;
        bool round = i % 5 == 0;
        double from = i % 3 == 0 ? nan_ : 3 * random_(&seed);
        fw_device_contact_use use = {.id = "touch",
                                     .joint = round ? FW_NONE : 0,
                                     .side = i % 2 ? FW_CONTACT_INSIDE : FW_CONTACT_OUTSIDE,
                                     .face = i % 10 == 0,
                                     .face_rad = 0.1 * i,
                                     .body_a = FW_GROUND,
                                     .body_b = 0,
                                     .distance_m = 2e-6,
                                     .stiffness_N_per_m = 1e4,
                                     .damping_Ns_per_m = i % 4 ? 0.02 : nan_};
        rig_lever(&r, 3 * random_(&seed), i % 2, i / 2 % 2, from, from + 1 + random_(&seed));
        const fw_effects_force_element *e = touching(&r, &use);
        double p[6], w[6], f[6], power[2];
        for (int k = 0; k < 6; k++) {
            p[k] = (k % 3 == 2 ? 0.3 : 2e-6) * random_(&seed);
            w[k] = (k % 3 == 2 ? 300 : 4e-2) * random_(&seed);
        }
        double value = switched(e, p, w);
        closed += value > 0;
        for (int flag = 0; flag < 2; flag++) {
            bool on = flag;
            fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
            fw_check_tangent(e, &s, 2e-10, 1e-5, 2e-6);
            fw_check_power(e, &s, 1e-9, 1e-6);
            fw_check_balance(e, &s, 1e-11);
            e->class_->force(e, &s, f);
            e->class_->power(e, &s, power);
            double press = e->class_->pressing(e, &s);
            if (on && value > 0) {
                assert_relative(hypot(f[0], f[1]), press, 1e-9);
                continue;
            }
            if (on) continue;
            for (int k = 0; k < 6; k++)
                assert_near(f[k], 0, 0);
            assert_near(press + e->class_->energy(e, &s) + power[0], 0, 0);
        }
        fw_arena_free(r.arena);
    }
    assert_true(closed > 30 && closed < 170);
}

/* directions in which surfaces that face each other from 10 to 80 degrees stop W: inside |u| = gap,
   beside it n.u = gap of the nearer end, behind nothing; the end turns with its body */
static void covered_directions(void **state) {
    (void)state;
    const double degree = M_PI / 180, gap = 2e-6;
    for (int convex_is_a = 0; convex_is_a < 2; convex_is_a++)
        for (int first_is_a = 0; first_is_a < 2; first_is_a++)
            for (int turned = 0; turned < 2; turned++)
                for (int to = 0; to < 360; to += 15) {
                    rig r;
                    fw_device_contact_use use = {.joint = 0,
                                                 .distance_m = nan_,
                                                 .stiffness_N_per_m = 1e4,
                                                 .damping_Ns_per_m = nan_};
                    fw_device_flexure flexure = {.gap_m = gap};
                    const fw_device device = {.flexure = &flexure, .nflexure = 1};
                    rig_lever(&r, 0.7, first_is_a, convex_is_a, 10 * degree, 80 * degree);
                    r.m.device = &device;
                    r.hinge[0].surface_radius_m = 150e-6;
                    const fw_effects_force_element *e = touching(&r, &use);
                    /* body b is at +a where body a is at -a: then the sector begins with b */
                    double turn = turned ? 20 * degree : 0;
                    double from = (10 + (first_is_a ? turn / degree : 0)) * degree;
                    double end = (80 + (first_is_a ? 0 : turn / degree)) * degree;
                    double u = to * degree, stop;
                    if (u >= from && u <= end)
                        stop = gap;
                    else {
                        double c = fmax(cos(u - from), cos(u - end));
                        stop = c > 1e-9 ? gap / c : (double)INFINITY;
                    }
                    for (int beyond = 0; beyond < 2; beyond++) {
                        double o = convex_is_a ? -1 : 1;
                        double l = isinf(stop) ? 1 : stop * (beyond ? 1 + 1e-6 : 1 - 1e-6);
                        const double w[6] = {0};
                        double p[6] = {
                            1e-4,      1e-4, 0, 1e-4 + o * l * cos(u), 1e-4 + o * l * sin(u),
                            0.3 + turn};
                        if ((switched(e, p, w) > 0) != (beyond && isfinite(stop)))
                            fail_msg("towards %d degrees, stop %g m", to, stop);
                    }
                    fw_arena_free(r.arena);
                }
}

/* silicon, 2 um: 220 uN along the arc's axis, 438 uN across it close the gap (thin theory; with
   axial and shear compliance a little less), and behind that the surfaces carry the rest */
static void forces_close_the_gap(void **state) {
    (void)state;
    const double closes[2] = {219.7e-6, 437.3e-6};
    for (int across = 0; across < 2; across++) {
        rig r;
        fw_device_contact_use use = {
            .joint = 0, .distance_m = 2e-6, .stiffness_N_per_m = 1e6, .damping_Ns_per_m = nan_};
        rig_lever(&r, 0.4, true, false, nan_, nan_);
        const fw_effects_force_element *e = touching(&r, &use);
        for (int i = 0; i < 3; i++) {
            const double share[3] = {0.995, 1.005, 3};
            double F = share[i] * closes[across], to = 0.4 + across * M_PI / 2;
            double q[3], p[6], w[6], f[6], load[3] = {F * cos(to), F * sin(to), 0};
            rig_drawn(&r, q);
            rig_equilibrium(&r, load, 20, q);
            fw_effects_element_place_ports(e, q, NULL, p, w);
            assert_int_equal(switched(e, p, w) > 0, i > 0);
            bool on = true;
            const fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
            e->class_->force(e, &s, f);
            if (i == 2) {
                assert_relative(hypot(p[3] - p[0], p[4] - p[1]), 2e-6, 1e-3);
                assert_relative(e->class_->pressing(e, &s), F - closes[across], 0.01);
            }
        }
        fw_arena_free(r.arena);
    }
}

/* a moment alone closes 1 um at 12.53 degrees when it winds the arc, at 12.27 when it unwinds it */
static void moments_close_the_gap(void **state) {
    (void)state;
    for (int sense = -1; sense <= 1; sense += 2)
        for (int beyond = 0; beyond < 2; beyond++) {
            rig r;
            fw_device_contact_use use = {
                .joint = 0, .distance_m = 1e-6, .stiffness_N_per_m = 1e4, .damping_Ns_per_m = nan_};
            rig_lever(&r, 0.4, true, false, nan_, nan_);
            const fw_effects_force_element *e = touching(&r, &use);
            r.loads.nelement = 1; /* the hinge alone moves it */
            double angle = (sense > 0 ? 12.53 : 12.27) + (beyond ? 0.02 : -0.02);
            double q[3], p[6], w[6];
            double load[3] = {0, 0,
                              sense * angle * M_PI / 180 * r.hinge[0].law.stiffness_Nm_per_rad};
            rig_drawn(&r, q);
            rig_equilibrium(&r, load, 10, q);
            fw_effects_element_place_ports(e, q, NULL, p, w);
            assert_int_equal(switched(e, p, w) > 0, beyond);
            fw_arena_free(r.arena);
        }
}

/* A flat face is the limit of a round tooth of radius R whose centre lies R behind the face: the force differs by the sagitta
   of the place that touches, k y^2/2R. It goes along the face's normal, through the bead's centre, wherever on the face that
   is. */
static void a_face_is_a_large_tooth(void **state) {
    (void)state;
    unsigned seed = 11;
    const double R = 1, k = 2000, distance = 15e-6;
    for (int i = 0; i < 50; i++) {
        rig r[2];
        double f[2][6], normal = 3 * random_(&seed), turn = 0.3 * random_(&seed);
        const double along = 200e-6 * random_(&seed), past = 3e-6 * (random_(&seed) + 1.1);
        for (int tooth = 0; tooth < 2; tooth++) {
            fw_device_contact_use use = {.joint = FW_NONE,
                                         .side = FW_CONTACT_OUTSIDE,
                                         .face = !tooth,
                                         .face_rad = normal,
                                         .body_a = 0,
                                         .body_b = FW_GROUND,
                                         .ax_m = tooth ? -R * cos(normal) : 0,
                                         .ay_m = tooth ? -R * sin(normal) : 0,
                                         .distance_m = distance + (tooth ? R : 0),
                                         .stiffness_N_per_m = k,
                                         .damping_Ns_per_m = nan_};
            rig_lever(&r[tooth], 0.4, true, false, nan_, nan_);
            const fw_effects_force_element *e = touching(&r[tooth], &use);
            const double n = normal + turn, back = tooth ? -R : 0, d = distance - past;
            const double p[6] = {back * cos(n),
                                 back * sin(n),
                                 turn,
                                 d * cos(n) - along * sin(n),
                                 d * sin(n) + along * cos(n),
                                 0};
            const double w[6] = {0};
            const bool on = true;
            const fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
            e->class_->force(e, &s, f[tooth]);
            fw_arena_free(r[tooth].arena);
        }
        assert_relative(hypot(f[0][3], f[0][4]), k * past, 1e-9);
        assert_near(f[0][3] * sin(normal + turn) - f[0][4] * cos(normal + turn), 0, 1e-12);
        assert_true(f[0][3] * cos(normal + turn) + f[0][4] * sin(normal + turn) > 0);
        assert_near(f[0][2], k * past * along,
                    1e-12 * k * 1e-3); /* the couple on the body of the face */
        for (int c = 3; c < 5; c++)
            assert_near(f[0][c], f[1][c], 2 * k * along * along / (2 * R) + 1e-3 * k * past);
    }
}

/* a body that falls on a round thing with speed v: it leaves it where k g + c g' = 0 with
     tan(w t) = -2 a w/(w0^2 - 2 a^2),  e = -exp(-a t) (cos(w t) - a/w sin(w t)),  a = c/2m */
static void bouncing(void **state) {
    (void)state;
    const double m = 1e-8, k = 40, v = 0.02, distance = 30e-6;
    for (double zeta = 0; zeta < 0.8; zeta += 0.15) {
        double w0 = sqrt(k / m), a = zeta * w0, c = 2 * m * a, w = sqrt(w0 * w0 - a * a);
        rig r;
        fw_device_contact_use use = {.joint = FW_NONE,
                                     .side = FW_CONTACT_OUTSIDE,
                                     .body_a = FW_GROUND,
                                     .body_b = 0,
                                     .distance_m = distance,
                                     .stiffness_N_per_m = k,
                                     .damping_Ns_per_m = c};
        rig_lever(&r, 0.4, true, false, nan_, nan_);
        const fw_effects_force_element *e = touching(&r, &use);
        double y = distance, speed = -v, t = 0, before = 0, h = 1e-3 / w0, f[6];
        bool on = true;
        for (int step = 0; step < 20000; step++) { /* RK4 until it lets go */
            double ky[4], kv[4];
            for (int i = 0; i < 4; i++) {
                double part = i == 0 ? 0 : i == 3 ? h : 0.5 * h;
                double yi = y + (i ? part * ky[i - 1] : 0), vi = speed + (i ? part * kv[i - 1] : 0);
                const double p[6] = {0, 0, 0, 0, yi, 0}, rate[6] = {0, 0, 0, 0, vi, 0};
                const fw_effects_port_state s = {.load = 1, .p = p, .w = rate, .on = &on};
                e->class_->force(e, &s, f);
                ky[i] = vi, kv[i] = f[4] / m;
                if (i > 0 || step == 0) continue;
                double value = switched(e, p, rate);
                if (value <= 0 && step > 10) { /* linear between the last two */
                    double back = before > 0 ? value / (before - value) : 0;
                    t += back * h, speed += back * h * kv[0], step = 30000;
                }
                before = value;
            }
            if (step >= 30000) break;
            y += h / 6 * (ky[0] + 2 * ky[1] + 2 * ky[2] + ky[3]);
            speed += h / 6 * (kv[0] + 2 * kv[1] + 2 * kv[2] + kv[3]);
            t += h;
        }
        double leaves = atan2(2 * a * w, -(w0 * w0 - 2 * a * a)) / w;
        double exact = -exp(-a * leaves) * (cos(w * leaves) - a / w * sin(w * leaves));
        assert_relative(t, leaves, 1e-5);
        assert_relative(speed / v, exact, 1e-5);
        fw_arena_free(r.arena);
    }
}

/* Johnson's approach of the two bodies with their own modulus, the force put in and got back */
static void line_contact(void **state) {
    (void)state;
    double E = 160e9, nu = 0.25, h = 50e-6, R = 180e-6, gap = 3e-6, F = 3e-4;
    double one = (1 - nu * nu) / (M_PI * E), relative = 1 / (1 / R - 1 / (R + gap));
    double b = sqrt(8 * F / h * relative * one);
    double approach = 2 * F / h * one * (2 * log(4 * R / b) - 1);
    double k = fw_effects_line_contact(E, nu, h, R, gap, F);
    assert_relative(k, F / approach, 1e-12);
    assert_true(b < 0.05 * R);
    double more = fw_effects_line_contact(E, nu, h, R, gap, 10 * F) / k;
    assert_true(more > 1 && more < 1.35);
}

static void expect_refusal(rig *r, fw_device_contact_use *use) {
    size_t before = r->diags.errors;
    r->scene.contact = use, r->scene.ncontact = 1;
    assert_int_equal(fw_effects_loads_new(r->arena, &r->m, &r->scene, &r->loads), FW_OK);
    assert_int_equal(fw_effect_contact.add(&r->c, &r->loads), FW_INPUT);
    assert_int_equal(r->diags.errors, before + 1);
    assert_int_equal(r->diags.item[r->diags.count - 1].number, 246);
    assert_int_equal(r->diags.item[r->diags.count - 1].place.line, 9);
}

static void what_is_not_known(void **state) {
    (void)state;
    rig r;
    fw_device_contact_use use = {.joint = 0,
                                 .distance_m = nan_,
                                 .stiffness_N_per_m = nan_,
                                 .damping_Ns_per_m = nan_,
                                 .place = {"d.xml", 9, 2}};
    rig_lever(&r, 0.4, true, false, nan_, nan_);
    expect_refusal(&r, &use); /* no gap */
    use.distance_m = 2e-6;
    expect_refusal(&r, &use); /* no stiffness */
    use.stiffness_N_per_m = 1e5;
    r.hinge[0].axis_rad = nan_;
    expect_refusal(&r, &use); /* not drawn */
    r.pin[0].hinge = FW_NONE;
    expect_refusal(&r, &use);
    fw_arena_free(r.arena);

    /* a contact calls in a hinge that nobody else asked for, of a stated stiffness too */
    rig_lever(&r, 0.4, true, false, nan_, nan_);
    r.hinge[0].stated = true;
    r.scene.contact = &use, r.scene.ncontact = 1;
    assert_int_equal(fw_effects_loads_new(r.arena, &r.m, &r.scene, &r.loads), FW_OK);
    assert_int_equal(fw_effect_contact.add(&r.c, &r.loads), FW_OK);
    assert_int_equal(fw_effect_nonlinear_hinge.add(&r.c, &r.loads), FW_OK);
    assert_int_equal(r.loads.nelement, 2);
    assert_int_equal(r.loads.nreleased, 1);
    /* and its default stiffness comes from the drawn radius */
    fw_arena_free(r.arena);
    rig_lever(&r, 0.4, true, false, 0, 1);
    use.stiffness_N_per_m = nan_;
    r.hinge[0].surface_radius_m = 150e-6;
    r.variant.material.youngs.value = 147e9, r.variant.material.poisson.value = 0.22;
    const fw_effects_force_element *e = touching(&r, &use);
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&r.hinge[0].law, 0, &at);
    assert_relative(e->size_N_per_m,
                    fw_effects_line_contact(147e9, 0.22, 50e-6, 150e-6, 2e-6,
                                            2e-6 * fmin(at.kx_N_per_m.value, at.ky_N_per_m.value)),
                    1e-12);
    fw_arena_free(r.arena);
}

/* round things that overlap as drawn: said once, with the depth, from a micrometre on */
static void pressed_as_drawn(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        rig r;
        rig_lever(&r, 0.4, true, false, nan_, nan_);
        const bool inside = i % 2;
        const double past = (const double[]){-1e-6, 0.9e-6, 20e-6}[i / 2];
        fw_device_contact_use use = {.joint = FW_NONE,
                                     .id = "c",
                                     .side = inside ? FW_CONTACT_INSIDE : FW_CONTACT_OUTSIDE,
                                     .body_a = FW_GROUND,
                                     .body_b = 0,
                                     .ax_m = r.body[0].x_m,
                                     .ay_m = r.body[0].y_m + 300e-6,
                                     .distance_m = 300e-6 + (inside ? -past : past),
                                     .stiffness_N_per_m = 1e4,
                                     .damping_Ns_per_m = nan_,
                                     .place = {"d.xml", 4, 7}};
        r.scene.contact = &use, r.scene.ncontact = 1;
        for (int twice = 0; twice < 2; twice++)
            assert_int_equal(fw_effect_contact.check(&r.c, &r.diags), FW_OK);
        assert_int_equal(r.diags.count, i / 2 == 2);
        if (i / 2 == 2) {
            assert_int_equal(r.diags.item[0].number, 134);
            assert_non_null(strstr(r.diags.item[0].message, "overlaps by 20 um"));
        }
        fw_arena_free(r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(placed_in_heat),
        cmocka_unit_test(element_laws),
        cmocka_unit_test(covered_directions),
        cmocka_unit_test(forces_close_the_gap),
        cmocka_unit_test(moments_close_the_gap),
        cmocka_unit_test(a_face_is_a_large_tooth),
        cmocka_unit_test(bouncing),
        cmocka_unit_test(line_contact),
        cmocka_unit_test(what_is_not_known),
        cmocka_unit_test(pressed_as_drawn),
    };
    return cmocka_run_group_tests_name("contact", tests, NULL, NULL);
}
