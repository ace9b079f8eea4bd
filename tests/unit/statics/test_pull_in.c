/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pull-in voltages against closed forms and scalar equations that are solved here. */
#include "quantity/law_kind.h"
#include "rest_rigs.h"
#include "effects/effects.h"
#include "maths/matrix.h"
#include "statics/statics.h"

static const double eps0 = 8.8541878128e-12;
static const fw_effect_choice all = {.mode = FW_EFFECTS_ALL},
                              faces = {.mode = FW_EFFECTS_NONE}; /* what is kept: no fringe */

static const fw_device_comb plate_drive = {.id = "plate",
                                           .kind = FW_ELECTRODES_PLATE,
                                           .body_a = FW_GROUND,
                                           .body_b = 0,
                                           .gap_m = 3e-6,
                                           .length_m = 250e-6,
                                           .depth_m = 20e-6,
                                           .voltage_V = 5};

static const fw_device_comb comb_drive = {.id = "comb",
                                          .kind = FW_ELECTRODES_COMB,
                                          .body_a = FW_GROUND,
                                          .body_b = 1,
                                          .fingers = 40,
                                          .gap_m = 4e-6,
                                          .overlap_m = 50e-6,
                                          .length_m = 200e-6,
                                          .depth_m = 50e-6,
                                          .voltage_V = 10};

/* by which ends of the fingers are as if the overlap were longer against what draws aside, far from a root: 2 b g */
static double ends_m(void) {
    const fw_effects_comb_tips tip = fw_effects_comb_tips_of(4e-6, 8e-6, 40);
    double by[2];
    return 2 * 4e-6 * fw_effects_comb_tip_aside(&tip, 150e-6, by);
}

static void add_drive(fixture *f, rig *r, const fw_device_comb *c) {
    if (!r->scene.comb) r->scene.comb = fw_arena_array(f->arena, fw_device_comb, 4);
    r->scene.comb[r->scene.ncomb++] = *c;
    r->scene.duration_s = 1e-3;
}

/* a plate on a guide along x with the spring k */
static rig plate_on_spring(fixture *f, double k) {
    rig r = rig_new(f->arena, 1, 0, 0);
    rig_body(&r, "rotor", 2e-9, 1e-17, 1e-3, -2e-3, 0);
    rig_guide(f, &r, 0, 1e-3, -2e-3, 0)->stiffness_N_per_m = k;
    return r;
}

/* a shuttle along x on kx, on it the rotor along y on ky */
static rig comb_on_stage(fixture *f, double kx, double ky) {
    rig r = rig_new(f->arena, 2, 0, 0);
    rig_body(&r, "shuttle", 3e-9, 1e-17, 0.4e-3, 0, 0);
    rig_body(&r, "rotor", 2e-9, 1e-17, 0.4e-3, 0, 0);
    rig_guide(f, &r, 0, 0.4e-3, 0, 0)->stiffness_N_per_m = kx;
    fw_device_joint *across = rig_guide(f, &r, 1, 0, 0, acos(0.0));
    across->id = "across";
    across->body_a = 0;
    across->stiffness_N_per_m = ky;
    return r;
}

static const fw_statics_pull_in *find_with(fixture *f, const rig *r, const fw_effect_choice *effects) {
    const fw_statics_pull_in *found;
    assert_int_equal(fw_statics_pull_in_find(f->arena, &r->m, &r->scene, effects, &f->diags, &found),
                     FW_OK);
    return found;
}
static const fw_statics_pull_in *find(fixture *f, const rig *r) {
    return find_with(f, r, &faces);
}

/* V^2 = 8 k g^3/(27 eps0 A) at a third of the gap, whatever the scene's own voltage is */
static void test_plate(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++) {
        fixture f = begin();
        double k = 0.3 * pow(7, i), g = 3e-6, area = 250e-6 * 20e-6;
        double volt = sqrt(8 * k * g * g * g / (27 * eps0 * area));
        rig r = plate_on_spring(&f, k);
        fw_device_comb c = plate_drive;
        c.voltage_V = volt * pow(10, 2 - i);
        add_drive(&f, &r, &c);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_FOLD);
        assert_false(p->bifurcation);
        assert_string_equal(p->comb, "plate");
        assert_string_equal(p->body, "rotor");
        assert_relative(p->voltage_V, volt, 1e-10);
        assert_relative(p->margin, pow(10, i - 2), 1e-10);
        assert_near(p->where[0], g / 3, 1e-6 * g);
        assert_near(fabs(p->shape[0]) / hypot(p->shape[0], p->shape[1]), 1, 1e-9);
        assert_int_equal(said(&f, 248), p->margin < 1);
        fw_arena_free(f.arena);
    }
}

/* a constant force F along: V^2 = 2 (k x - F)(g - x)^2/(eps0 A) has its largest value at
   x = (g + 2 F/k)/3; the force acts in full although only voltages grow */
static void test_plate_with_load(void **state) {
    (void)state;
    for (int i = -2; i <= 2; i++) {
        fixture f = begin();
        double k = 2, g = 3e-6, area = 250e-6 * 20e-6, force = 0.15 * i * k * g;
        double x = (g + 2 * force / k) / 3;
        double volt = sqrt(2 * (k * x - force) * (g - x) * (g - x) / (eps0 * area));
        rig r = plate_on_spring(&f, k);
        add_drive(&f, &r, &plate_drive);
        rig_force(&r, 0, force, 0);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_FOLD);
        assert_relative(p->voltage_V, volt, 1e-10);
        assert_near(p->where[0], x, 1e-6 * g);
        fw_arena_free(f.arena);
    }
}

/* one plate on either side: the middle stays an equilibrium and loses its stiffness at
   k = 2 eps0 A V^2/g^3; the drives of two voltages named by what they take */
static void test_two_plates(void **state) {
    (void)state;
    fixture f = begin();
    double k = 2, g = 3e-6, area = 250e-6 * 20e-6;
    rig r = plate_on_spring(&f, k);
    fw_device_comb other = plate_drive;
    other.id = "other";
    other.direction_rad = acos(-1.0);
    add_drive(&f, &r, &plate_drive);
    add_drive(&f, &r, &other);
    const fw_statics_pull_in *p = find(&f, &r);
    assert_non_null(p);
    assert_int_equal(p->kind, FW_PULL_IN_FOLD);
    assert_true(p->bifurcation);
    assert_relative(p->voltage_V, sqrt(k * g * g * g / (2 * eps0 * area)), 1e-10);
    fw_arena_free(f.arena);
}

/* With the fringe the pull along has h/g + F(g) in place of h/g, and what draws aside 2 h/g^3 + F''(g) */
static void test_side_with_fringe(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        fixture f = begin();
        double kx = pow(5, i), ky = 40 * kx, g = 4e-6, o = 50e-6, h = 50e-6, per = eps0 * 40, by[2];
        double along = per * (h / g + fw_effects_comb_edge(g, 8e-6, by));
        double aside = per * (2 * h / (g * g * g) + by[1]);
        double ends = per * (h + 0.3 * g * fw_effects_comb_edge(g, 8e-6, NULL)) * 2 * ends_m() / (g * g * g);
        double a = aside * along / kx, b = aside * o + ends, square = 2 * ky / (b + sqrt(b * b + 4 * a * ky));
        rig r = comb_on_stage(&f, kx, ky);
        add_drive(&f, &r, &comb_drive);
        const fw_statics_pull_in *p = find_with(&f, &r, &all), *without = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_SIDE);
        assert_relative(p->voltage_V, sqrt(square), 1e-9);
        assert_true(p->voltage_V < 0.99 * without->voltage_V && p->fringe < 0.5 * without->fringe);
        fw_arena_free(f.arena);
    }
}

/* side instability: (2 face/g^3) (overlap + ends + face V^2/(g kx)) V^2 = ky, a quadratic in V^2 */
static void test_side(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        fixture f = begin();
        double kx = pow(5, i), ky = 40 * kx, g = 4e-6, o = 50e-6, face = eps0 * 50e-6 * 40;
        double a = 2 * face * face / (g * g * g * g * kx), b = 2 * face * (o + ends_m()) / (g * g * g);
        double square = 2 * ky / (b + sqrt(b * b + 4 * a * ky)), x = face * square / (g * kx);
        rig r = comb_on_stage(&f, kx, ky);
        add_drive(&f, &r, &comb_drive);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_SIDE);
        assert_true(p->bifurcation);
        assert_relative(p->voltage_V, sqrt(square), 1e-10);
        assert_near(p->where[0], x, 1e-9 * o);
        assert_near(p->where[1], 0, 1e-6 * g);
        assert_string_equal(p->body, "rotor");
        fw_arena_free(f.arena);
    }
}

/* a comb that a side force holds out of the middle: no bifurcation but a limit point. With y given,
   V^2 solves ky y - F = V^2/2 face D (o + V^2 face S/(2 kx)), S and D = 1/(g - y) +- 1/(g + y), D
   of squares; the largest V^2(y) is searched here */
typedef struct offset {
    double kx, ky, force, face, gap, overlap;
} offset;

static double square_at(const offset *c, double y) {
    double low = 1 / (c->gap - y), high = 1 / (c->gap + y);
    double s = low + high, d = low * low - high * high;
    double a = 0.25 * c->face * c->face * s * d / c->kx, b = 0.5 * c->face * d * (c->overlap + ends_m());
    double rest = c->ky * y - c->force;
    return rest > 0 ? 2 * rest / (b + sqrt(b * b + 4 * a * rest)) : 0;
}

static void test_side_with_offset(void **state) {
    (void)state;
    for (int i = 1; i < 5; i++) {
        fixture f = begin();
        offset c = {.kx = 2, .ky = 80, .face = eps0 * 50e-6 * 40, .gap = 4e-6, .overlap = 50e-6};
        c.force = pow(10, -i) * 0.5 * c.ky * c.gap;
        double low = c.force / c.ky, high = 0.95 * c.gap;
        const double golden = 0.5 * (sqrt(5.0) - 1);
        for (int k = 0; k < 80; k++) {
            double a = high - golden * (high - low), b = low + golden * (high - low);
            if (square_at(&c, a) > square_at(&c, b))
                high = b;
            else
                low = a;
        }
        rig r = comb_on_stage(&f, c.kx, c.ky);
        add_drive(&f, &r, &comb_drive);
        rig_force(&r, 1, 0, c.force);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_SIDE);
        assert_false(p->bifurcation);
        assert_relative(p->voltage_V, sqrt(square_at(&c, low)), 1e-10);
        assert_near(p->where[1], low, 1e-5 * c.gap);
        fw_arena_free(f.arena);
    }
}

/* forces across from a hundredth of the gap down to 1e-12 of it: limit points that become sharper
   and sharper, of the same closed form; paths of long steps pass over them onto the branch that the
   comb in the middle has */
static void test_side_almost_in_the_middle(void **state) {
    (void)state;
    for (int i = 0; i < 24; i++) {
        fixture f = begin();
        offset c = {.kx = i % 2 ? 2 : 20,
                    .ky = 80,
                    .face = eps0 * 50e-6 * 40,
                    .gap = 4e-6,
                    .overlap = 50e-6};
        c.force = pow(10, -1 - 0.5 * i) * c.ky * c.gap;
        double low = c.force / c.ky * (1 + 1e-9), high = 0.9 * c.gap;
        const double golden = 0.5 * (sqrt(5.0) - 1);
        for (int k = 0; k < 100; k++) {
            double a = high - golden * (high - low), b = low + golden * (high - low);
            if (square_at(&c, a) > square_at(&c, b))
                high = b;
            else
                low = a;
        }
        rig r = comb_on_stage(&f, c.kx, c.ky);
        add_drive(&f, &r, &comb_drive);
        rig_force(&r, 1, 0, c.force);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_SIDE);
        assert_relative(p->voltage_V, sqrt(square_at(&c, low)), 1e-9);
        fw_arena_free(f.arena);
    }
}

/* along on a spring so soft that its mode is the lowest until just before the comb moves aside */
static void test_side_of_a_soft_stage(void **state) {
    (void)state;
    for (int i = 0; i < 12; i++) {
        fixture f = begin();
        double kx = 0.02 * pow(2, i), ky = 150, g = 4e-6, o = 50e-6, face = eps0 * 50e-6 * 40;
        double a = 2 * face * face / (g * g * g * g * kx), b = 2 * face * (o + ends_m()) / (g * g * g);
        double square = 2 * ky / (b + sqrt(b * b + 4 * a * ky));
        rig r = comb_on_stage(&f, kx, ky);
        fw_device_comb long_fingers = comb_drive;
        long_fingers.length_m = 5e-3;
        add_drive(&f, &r, &long_fingers);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_SIDE);
        assert_relative(p->voltage_V, sqrt(square), 1e-9);
        fw_arena_free(f.arena);
    }
}

/* a rotor that can only turn about the middle of its overlap: V^2 = k/(face (o^3/(6 g^3) + b o^2/g^2)), 2 b g of ends */
static void test_tilt(void **state) {
    (void)state;
    fixture f = begin();
    double k = 2e-8, g = 4e-6, o = 50e-6, face = eps0 * 50e-6 * 40;
    rig r = rig_new(f.arena, 1, 1, 0);
    rig_body(&r, "rotor", 2e-9, 1e-17, 0.4e-3, 0.1e-3, 0.3);
    rig_pin(&r, "hinge", FW_GROUND, 0, 0.4e-3, 0.1e-3, k, 0)->free_angle_rad = 0.3;
    fw_device_comb c = comb_drive;
    c.body_b = 0;
    c.direction_rad = 1.1;
    add_drive(&f, &r, &c);
    const fw_statics_pull_in *p = find(&f, &r);
    assert_non_null(p);
    assert_int_equal(p->kind, FW_PULL_IN_TILT);
    assert_true(p->bifurcation);
    assert_relative(p->voltage_V, sqrt(k / (face * (o + 3 * ends_m()) * o * o / (6 * g * g * g))), 1e-10);
    fw_arena_free(f.arena);
}

/* Guided along the drive a comb pulls until its tips are near the root, which pulls the more: V^2 = k x/(face (1/g - 2 G')) is largest
   there. Against boundary elements: test_fringe.c */
static void test_onto_the_root(void **state) {
    (void)state;
    double kx = 1, g = 4e-6, face = eps0 * 50e-6 * 40, root = 0, at = 0, by[2];
    const fw_effects_comb_tips tip = fw_effects_comb_tips_of(g, 8e-6, 40);
    for (int i = 0; i < 100000; i++) {
        const double x = 149e-6 * i / 1e5;
        fw_effects_comb_tip(&tip, 150e-6 - x, by);
        const double volt = sqrt(kx * x / (face * (1 / g - 2 * by[0])));
        if (volt > root) root = volt, at = x;
    }
    assert_true(at > 120e-6 && at < 147e-6);
    for (int i = 0; i < 2; i++) {
        fixture f = begin();
        rig r = plate_on_spring(&f, kx);
        fw_device_comb c = comb_drive;
        c.body_b = 0;
        c.voltage_V = i ? 1.3 * root : 0.7 * root;
        add_drive(&f, &r, &c);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_int_equal(p->kind, FW_PULL_IN_FOLD);
        assert_relative(p->voltage_V, root, 1e-7);
        assert_near(p->where[0], at, 0.01e-6);
        assert_null(p->beyond);
        assert_int_equal(said(&f, 248), i);
        fw_arena_free(f.arena);
    }
}

/* the voltage of a law counts at its largest; without drives there is nothing to find; without
   anything that holds the rotor it is lost from the start */
static void test_around_it(void **state) {
    (void)state;
    static const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 1e4};
    double k = 2, g = 3e-6, area = 250e-6 * 20e-6;
    double volt = sqrt(8 * k * g * g * g / (27 * eps0 * area));
    fixture f = begin();
    rig r = plate_on_spring(&f, k);
    fw_device_comb c = plate_drive;
    assert_null(find(&f, &r));
    c.law = &sine;
    c.voltage_V = -1.25 * volt;
    add_drive(&f, &r, &c);
    const fw_statics_pull_in *p = find(&f, &r);
    assert_relative(p->voltage_V, volt, 1e-10);
    assert_relative(p->margin, 0.8, 1e-10);
    assert_true(said(&f, 248));
    r.m.joint[0].stiffness_N_per_m = 0;
    p = find(&f, &r);
    assert_int_equal(p->kind, FW_PULL_IN_NONE);
    assert_true(p->voltage_V == 0);
    assert_true(said(&f, 249));
    r.scene.comb[0].voltage_V = 0;
    assert_null(find(&f, &r));
    fw_arena_free(f.arena);
}

/* statics finds the stable equilibrium below pull-in, with the negative stiffness in its tangent,
   and refuses above */
static void test_statics(void **state) {
    (void)state;
    double k = 2, g = 3e-6, area = 250e-6 * 20e-6;
    double volt = sqrt(8 * k * g * g * g / (27 * eps0 * area));
    for (int i = 0; i < 3; i++) {
        static const double share[] = {0.5, 0.99, 1.02};
        fixture f = begin();
        rig r = plate_on_spring(&f, k);
        fw_device_comb c = plate_drive;
        c.voltage_V = share[i] * volt;
        add_drive(&f, &r, &c);
        const fw_statics_static_options o = {.effects = faces, .path = i == 1};
        const fw_statics *s;
        fw_status status = fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &s);
        if (i == 2) {
            assert_int_equal(status, FW_SOLVER);
            assert_true(said(&f, 248));
            fw_arena_free(f.arena);
            continue;
        }
        assert_int_equal(status, FW_OK);
        double x = s->q[0] - s->rest_q[0], left = g - x, v2 = c.voltage_V * c.voltage_V;
        assert_near(k * x, eps0 * area * v2 / (2 * left * left), 1e-9 * k * g);
        assert_true(x < g / 3);
        double stiffness = k - eps0 * area * v2 / (left * left * left);
        assert_relative(s->eigenvalue_per_s2[0], stiffness / 2e-9, 1e-8);
        assert_non_null(s->pull_in);
        assert_relative(s->pull_in->margin, 1 / share[i], 1e-10);
        fw_arena_free(f.arena);
    }
}

/* ---- fingers that bend ---- */

/* cubic shapes of a beam element of length 1 at x, of deflection, and of curvature */
static void shapes(double x, double length, double n[4], double k[4]) {
    n[0] = 1 - 3 * x * x + 2 * x * x * x, n[1] = length * (x - 2 * x * x + x * x * x);
    n[2] = 3 * x * x - 2 * x * x * x, n[3] = length * (x * x * x - x * x);
    const double per = 1 / (length * length);
    k[0] = (12 * x - 6) * per, k[1] = length * (6 * x - 4) * per;
    k[2] = (6 - 12 * x) * per, k[3] = length * (6 * x - 2) * per;
}

/* kappa V^2 at which a finger of the rotor and one of the stator, L long and engaged by o, bend against each other, with
   two gaps between them: beam elements, and power iteration on K^-1 G. EI = 1 */
static double two_fingers(double L, double o) {
    enum { PIECES = 16, N = 2 * PIECES, ALL = 2 * N };
    static double stiff[ALL * ALL], field[ALL * ALL], x[ALL], y[ALL];
    static int pivot[ALL];
    const double part = L / PIECES, at[3] = {0.5 - sqrt(0.15), 0.5, 0.5 + sqrt(0.15)}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
    double n[4], k[4], most = 0;
    memset(stiff, 0, sizeof stiff), memset(field, 0, sizeof field);
    for (int finger = 0; finger < 2; finger++)
        for (int i = 0; i < PIECES; i++)
            for (int g = 0; g < 3; g++) {
                shapes(at[g], part, n, k);
                for (int a = 0; a < 16; a++) {
                    int r = 2 * (i - 1) + a / 4, c = 2 * (i - 1) + a % 4; /* the root does not move */
                    if (r >= 0 && c >= 0) stiff[(finger * N + r) * ALL + finger * N + c] += weight[g] * part * k[a / 4] * k[a % 4];
                }
            }
    for (int i = 0; i < 40 * PIECES; i++) { /* midpoints of the overlap */
        double row[ALL] = {0}, s[2] = {L - o + o * (i + 0.5) / (40 * PIECES), 0};
        s[1] = 2 * L - o - s[0];
        for (int finger = 0; finger < 2; finger++) {
            int piece = (int)fmin(PIECES - 1, s[finger] / part);
            shapes(s[finger] / part - piece, part, n, k);
            for (int a = 0; a < 4; a++)
                if (2 * (piece - 1) + a >= 0) row[finger * N + 2 * (piece - 1) + a] += n[a];
        }
        for (int a = 0; a < ALL; a++)
            for (int b = 0; b < ALL; b++)
                field[a * ALL + b] += 2 * o / (40 * PIECES) * row[a] * row[b]; /* two gaps to a finger */
    }
    assert_true(fw_maths_lu_factor(ALL, stiff, pivot));
    for (int i = 0; i < ALL; i++)
        x[i] = 1 + i % 3;
    for (int turn = 0; turn < 200; turn++) {
        most = 0;
        for (int a = 0; a < ALL; a++) {
            y[a] = 0;
            for (int b = 0; b < ALL; b++)
                y[a] += field[a * ALL + b] * x[b];
        }
        fw_maths_lu_solve(ALL, stiff, pivot, NULL, y);
        for (int a = 0; a < ALL; a++)
            most = fmax(most, fabs(y[a]));
        for (int a = 0; a < ALL; a++)
            x[a] = y[a] / most;
    }
    return 1 / most;
}

/* what is said to hold does, for every overlap, and where fingers are engaged all along it is not far from the truth */
static void test_fingers(void **state) {
    (void)state;
    fixture f = begin();
    rig r = comb_on_stage(&f, 5, 200);
    static fw_mechanism_variant made;
    made = (fw_mechanism_variant){.thickness_m = 50e-6, .material = {.youngs = {.value = 160e9}}};
    made.material.c11.unknown = made.material.c12.unknown = made.material.c44.unknown = true;
    r.m.variant = &made;
    double least = 1;
    for (int i = 1; i <= 8; i++) {
        const double w = 3e-6, g = 4e-6, h = 50e-6, L = 200e-6, o = L * i / 8;
        const double truth = sqrt(two_fingers(1, o / L) * 160e9 * h * w * w * w / 12 / (L * L * L * L) / (eps0 * h / (g * g * g)));
        fw_device_comb c = comb_drive;
        c.width_m = w, c.gap_m = g, c.overlap_m = o * 0.9999, c.length_m = L;
        r.scene.ncomb = 0;
        add_drive(&f, &r, &c);
        const fw_statics_pull_in *p = find(&f, &r);
        assert_non_null(p);
        assert_true(p->fingers_V < truth);
        least = fmin(least, p->fingers_V / truth);
        if (i == 8) assert_true(p->fingers_V > 0.75 * truth);
        assert_relative(p->fingers, pow(10 / p->fingers_V, 2), 1e-9);
        /* what it needs, with a rotor that gives: 1/V^2 of both */
        assert_relative(fw_statics_pull_in_margin(p), sqrt((1 + p->fringe) / (1 - (1 + p->fringe) * p->fingers)), 1e-12);
        assert_false(fw_statics_pull_in_fingers_snap(p));
        r.scene.comb[0].voltage_V = 1.01 * p->fingers_V;
        assert_true(fw_statics_pull_in_fingers_snap(find(&f, &r)));
        assert_true(said(&f, 595));
    }
    assert_true(least > 0.6);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plate),
        cmocka_unit_test(test_plate_with_load),
        cmocka_unit_test(test_two_plates),
        cmocka_unit_test(test_side),
        cmocka_unit_test(test_side_with_fringe),
        cmocka_unit_test(test_side_with_offset),
        cmocka_unit_test(test_side_almost_in_the_middle),
        cmocka_unit_test(test_side_of_a_soft_stage),
        cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_onto_the_root),
        cmocka_unit_test(test_around_it),
        cmocka_unit_test(test_statics),
        cmocka_unit_test(test_fingers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
