/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "assembly/assembly.h"
#include "dynamics/models.h"

static const fw_assembly_kinematics_options everything = {.effects = {.mode = FW_EFFECTS_ALL}};

static void pose(const rig *r, double *q) {
    for (int b = 0; b < r->m.nbody; b++) {
        q[3 * b] = r->m.body[b].x_m;
        q[3 * b + 1] = r->m.body[b].y_m;
        q[3 * b + 2] = r->m.body[b].phi_rad;
    }
}

static void fail_with(const fw_diags *d) {
    fail_msg("%s", d->count ? d->item[d->count - 1].message : "no diagnostic");
}

/* ---- slider-crank: crank r about the origin, rod l, piston on the line y = e ---- */

typedef struct engine {
    double r, l, e, crank_mass, rod_mass, piston_mass, gas;
} engine;

static rig rig_engine(fw_arena *arena, const engine *p, double phi) {
    rig r = rig_new(arena, 3, 3, 0);
    double bx = p->r * cos(phi), by = p->r * sin(phi);
    double rod = asin((p->e - by) / p->l), cx = bx + p->l * cos(rod);
    rig_body(&r, "crank", p->crank_mass, 1e-4, bx / 2, by / 2, phi);
    rig_body(&r, "rod", p->rod_mass, 1e-4, (bx + cx) / 2, (by + p->e) / 2, rod);
    rig_body(&r, "piston", p->piston_mass, 1e-4, cx, p->e, 0);
    rig_pin_local(&r, "A", FW_GROUND, 0, 0, 0, -p->r / 2, 0);
    rig_pin_local(&r, "B", 0, p->r / 2, 0, 1, -p->l / 2, 0);
    rig_pin_local(&r, "C", 1, p->l / 2, 0, 2, 0, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
    r.m.joint[r.m.njoint++] = (fw_device_joint){
        .id = "S", .kind = FW_JOINT_PRISMATIC, .body_a = FW_GROUND, .body_b = 2, .ay_m = p->e};
    r.scene.duration_s = 1;
    return r;
}

/* position, velocity, acceleration of the piston and the angle of the rod by differentiation of
   x = r cos(phi) + sqrt(l^2 - (e - r sin(phi))^2) */
static void engine_exact(const engine *p, double phi, double w, double dw, double x[3],
                         double rod[3]) {
    double s = sin(phi), c = cos(phi), h = p->e - p->r * s, h1 = -p->r * c * w;
    double h2 = p->r * s * w * w - p->r * c * dw, root = sqrt(p->l * p->l - h * h);
    double root1 = -h * h1 / root, root2 = -(h1 * h1 + h * h2 + root1 * root1) / root;
    x[0] = p->r * c + root;
    x[1] = -p->r * s * w + root1;
    x[2] = -p->r * c * w * w - p->r * s * dw + root2;
    double k = h / p->l, k1 = h1 / p->l, k2 = h2 / p->l, co = sqrt(1 - k * k);
    rod[0] = asin(k);
    rod[1] = k1 / co;
    rod[2] = k2 / co + k * k1 * k1 / (co * co * co);
}

static void test_slider_crank(void **state) {
    (void)state;
    /* light rod: the piston's equation then gives its wall force and the crank's torque in closed
       form */
    const engine p = {0.05, 0.16, 0.012, 1.0, 1e-9, 0.7, -35};
    for (int i = 0; i < 24; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        double phi = 0.13 + i * 0.26, w = 31, dw = -240, q[9], x[3], rod[3];
        rig r = rig_engine(arena, &p, phi);
        r.m.body[1].inertia_kg_m2 = 1e-15;
        rig_force(&r, 2, p.gas, 0);
        pose(&r, q);
        fw_assembly_kinematics_options o = everything;
        o.independent = "crank.phi", o.rate = &w, o.accel = &dw, o.nrate = o.naccel = 1;
        const fw_assembly_kinematics *k;
        if (fw_assembly_kinematics_solve(arena, &r.m, &r.scene, q, &o, &diags, &k) != FW_OK)
            fail_with(&diags);
        engine_exact(&p, phi, w, dw, x, rod);
        assert_near(q[6], x[0], 1e-15);
        assert_near(k->v[6], x[1], 1e-12 * w);
        assert_near(k->a[6], x[2], 1e-11 * w * w);
        assert_near(k->v[5], rod[1], 1e-12 * w);
        assert_near(k->a[5], rod[2], 1e-11 * w * w);
        assert_near(k->v[2], w, 1e-13 * w);
        /* piston: m x'' = gas + rod_x, rod force along the rod, wall force = -rod_y */
        double along = (p.piston_mass * x[2] - p.gas), wall = -along * tan(rod[0]);
        assert_near(k->reaction_N[4], along, 1e-6 * fabs(along)); /* 1e-9 kg of rod remain */
        assert_near(k->joint_N[1], wall, 1e-6 * fabs(along));
        assert_near(k->joint_N[0], 0, 1e-9 * fabs(along));
        /* power: torque w = d/dt kinetic energy - gas x' */
        double crank = 1e-4 + p.crank_mass * p.r * p.r / 4;
        double torque = (crank * dw * w + (p.piston_mass * x[2] - p.gas) * x[1]) / w;
        assert_near(k->drive[0], torque, 1e-6 * (fabs(torque) + 1));
        assert_true(k->unique);
        fw_arena_free(arena);
    }
}

/* ---- four-bar: Freudenstein's equation ---- */

/* cos(psi) K2 - cos(phi) K1 + K3 = cos(phi - psi) with K1 = g/b, K2 = g/a, K3 = (a^2 + b^2 + g^2 -
   c^2)/(2 a b) for crank a at angle phi, rocker b at psi, coupler c, ground g; psi' and psi'' by
   its derivatives */
static void freudenstein(double a, double b, double c, double g, double phi, double w, double dw,
                         double psi[3]) {
    double k1 = g / a, k2 = g / b, k3 = (a * a + b * b + g * g - c * c) / (2 * a * b);
    for (int i = 0; i < 60; i++) { /* Newton from the given branch */
        double f = k1 * cos(psi[0]) - k2 * cos(phi) + k3 - cos(phi - psi[0]);
        double d = -k1 * sin(psi[0]) - sin(phi - psi[0]);
        psi[0] -= f / d;
    }
    double fp = -k1 * sin(psi[0]) - sin(phi - psi[0]), ff = k2 * sin(phi) + sin(phi - psi[0]);
    psi[1] = -ff * w / fp;
    double fpp = -k1 * cos(psi[0]) + cos(phi - psi[0]), fff = k2 * cos(phi) + cos(phi - psi[0]);
    double ffp = -cos(phi - psi[0]);
    psi[2] = -(ff * dw + fff * w * w + 2 * ffp * w * psi[1] + fpp * psi[1] * psi[1]) / fp;
}

static rig rig_four_bar(fw_arena *arena, double phi) {
    const double a = 1, c = 3, b = 2.5, g = 3.2;
    rig r = rig_new(arena, 3, 4, 0);
    double px = a * cos(phi), py = a * sin(phi), dx = g - px, dy = -py, d = hypot(dx, dy);
    double turn = acos((c * c + d * d - b * b) / (2 * c * d)), line = atan2(dy, dx) + turn;
    double qx = px + c * cos(line), qy = py + c * sin(line);
    rig_body(&r, "crank", 1, 0.1, px / 2, py / 2, phi);
    rig_body(&r, "coupler", 2, 1.5, (px + qx) / 2, (py + qy) / 2, line);
    rig_body(&r, "rocker", 1.5, 0.8, (g + qx) / 2, qy / 2, atan2(qy, qx - g));
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, px, py, 0, 0);
    rig_pin(&r, "C", 1, 2, qx, qy, 0, 0);
    rig_pin(&r, "D", 2, FW_GROUND, g, 0, 0, 0);
    r.scene.duration_s = 1;
    return r;
}

static void test_four_bar(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        double phi = 0.2 + 0.31 * i, w = 2.7, dw = -1.9, q[9];
        rig r = rig_four_bar(arena, phi);
        pose(&r, q);
        fw_assembly_kinematics_options o = everything;
        o.independent = "crank.phi", o.rate = &w, o.accel = &dw, o.nrate = o.naccel = 1;
        const fw_assembly_kinematics *k;
        if (fw_assembly_kinematics_solve(arena, &r.m, &r.scene, q, &o, &diags, &k) != FW_OK)
            fail_with(&diags);
        double psi[3] = {q[8], 0, 0};
        freudenstein(1, 2.5, 3, 3.2, phi, w, dw, psi);
        assert_near(q[8], psi[0], 1e-13);
        assert_near(k->v[8], psi[1], 1e-12);
        assert_near(k->a[8], psi[2], 1e-11);
        /* the torque's power is the change of the kinetic energy */
        double power = 0;
        for (int c = 0; c < 9; c++) {
            const fw_mechanism_mass *m = &r.m.body[c / 3];
            power += (c % 3 == 2 ? m->inertia_kg_m2 : m->mass_kg) * k->v[c] * k->a[c];
        }
        assert_near(k->drive[0] * w, power, 1e-10 * fabs(power) + 1e-10);
        fw_arena_free(arena);
    }
}

/* ---- the reference six-bar: velocities, accelerations, reactions of a run in quad precision ----
 */

static void test_six_bar(void **state) {
    (void)state;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/sixbar_ref_full.txt", "r");
    assert_non_null(file);
    char line[4096];
    int rows = 0;
    double worst_v = 0, worst_a = 0, worst_f = 0, worst_drive = 0;
    while (fgets(line, sizeof line, file)) {
        double value[58];
        int used = 0, n = 0, step;
        if (line[0] == '#') continue;
        for (; n < 58 && sscanf(line + used, "%lf%n", &value[n], &step) == 1; n++)
            used += step;
        assert_int_equal(n, 58);
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_six_bar(arena, false);
        double q[15], rate[3], accel[3];
        for (int i = 0; i < 15; i++)
            q[i] = value[1 + i] * (i % 3 == 2 ? 1 : 1e-3);
        for (int i = 0; i < 3; i++) {
            rate[i] = value[16 + 3 * i + 2] * 1e3;
            accel[i] = value[31 + 3 * i + 2] * 1e6;
        }
        fw_assembly_kinematics_options o = everything;
        o.independent = "AB.phi, BC.phi,CD.phi";
        o.rate = rate, o.accel = accel, o.nrate = o.naccel = 3;
        const fw_assembly_kinematics *k;
        if (fw_assembly_kinematics_solve(arena, &r.m, &r.scene, q, &o, &diags, &k) != FW_OK)
            fail_with(&diags);
        for (int i = 0; i < 15; i++) {
            double unit = i % 3 == 2 ? 1 : 1e-3;
            worst_v = fmax(worst_v, fabs(k->v[i] / unit / 1e3 - value[16 + i]));
            worst_a = fmax(worst_a, fabs(k->a[i] / unit / 1e6 - value[31 + i]));
        }
        for (int i = 0; i < 12; i++)
            /* the reference states the force on body a */
            worst_f = fmax(worst_f, fabs(k->reaction_N[i] * 1e3 + value[46 + i]));
        for (int i = 0; i < 3; i++) /* a free motion needs no drive; 1e-6 N m is the scale */
            worst_drive = fmax(worst_drive, fabs(k->drive[i]) / 1e-6);
        rows++;
        fw_arena_free(arena);
    }
    fclose(file);
    print_message("%d instants: velocities within %.1e, accelerations %.1e, forces %.1e mN, drive "
                  "%.1e\n",
                  rows, worst_v, worst_a, worst_f, worst_drive);
    assert_int_equal(rows, 8);
    assert_true(worst_v < 1e-13);
    assert_true(worst_a < 1e-12);
    assert_true(worst_f < 1e-13);
    assert_true(worst_drive < 1e-13);
}

/* ---- choice of the independent coordinates ---- */

/* of coordinates that are as good, but for rounding, the first is taken: both cranks of a parallelogram turn alike, at any angle */
static void test_choice_of_equals(void **state) {
    (void)state;
    for (int n = 0; n < 6; n++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_new(arena, 3, 4, 0);
        const double x = cos(0.3 + 0.4 * n), y = sin(0.3 + 0.4 * n);
        rig_body(&r, "one", 1, 0.1, 0.5 * x, 0.5 * y, 0);
        rig_body(&r, "coupler", 1, 0.1, x + 1, y, 0);
        rig_body(&r, "two", 1, 0.1, 2 + 0.5 * x, 0.5 * y, 0);
        rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
        rig_pin(&r, "B", 0, 1, x, y, 0, 0);
        rig_pin(&r, "C", 1, 2, 2 + x, y, 0, 0);
        rig_pin(&r, "D", 2, FW_GROUND, 2, 0, 0, 0);
        double q[9];
        pose(&r, q);
        fw_assembly_kinematics_options o = everything;
        const fw_assembly_kinematics *k;
        assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k), FW_OK);
        assert_int_equal(k->independent.count, 1);
        assert_int_equal(k->independent.item[0].body, 0);
        assert_int_equal(k->independent.item[0].axis, 2);
        fw_arena_free(arena);
    }
}

static void test_choice(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, true); /* a hinge written twice changes nothing */
    double q[15];
    pose(&r, q);
    fw_assembly_kinematics_options o = everything;
    const fw_assembly_kinematics *k;
    assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k), FW_OK);
    assert_int_equal(k->independent.count, 3);
    assert_true(k->independent.automatic);
    assert_true(k->independent.condition < 10);
    assert_false(k->unique);
    for (int i = 0; i < 15; i++)
        assert_near(k->v[i], 0, 1e-15);
    static const struct {
        const char *list, *word;
    } wrong[] = {{"AB.phi", "3 degrees of freedom"},
                 {"AB.phi,BC.phi,CD.phi,DE.phi", "3 degrees of freedom"},
                 {"AB.phi,AB.phi,CD.phi", "twice"},
                 {"AB.phi,BC.phi,CE.phi", "did you mean"},
                 {"AB.phi,BC.phi,CD.z", "there is no coordinate"},
                 {"AB.phi,BC.phi,,CD.phi", "there is no coordinate"},
                 {"AB.phi,AB.x,CD.phi", "cannot be independent"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        o.independent = wrong[i].list;
        size_t before = diags.count;
        assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k),
                         FW_USAGE);
        assert_int_equal(diags.count, before + 1);
        assert_int_equal(diags.item[before].number, 117);
        if (!strstr(diags.item[before].message, wrong[i].word))
            fail_msg("%s: %s", wrong[i].list, diags.item[before].message);
    }
    print_message("%s\n", diags.item[diags.count - 1].message);
    double rate[2] = {1, 2};
    o.independent = "AB.phi,BC.phi,CD.phi", o.rate = rate, o.nrate = 2;
    assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k), FW_USAGE);
    rate[0] = (double)NAN, o.nrate = 1;
    assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k), FW_USAGE);
    fw_arena_free(arena);
}

/* near the dead centre the piston is a poor coordinate and the crank a good one; at it, impossible
 */
static void test_dead_centre(void **state) {
    (void)state;
    const engine p = {0.05, 0.16, 0, 1, 0.3, 0.7, 0};
    for (int i = 0; i < 2; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_engine(arena, &p, i ? 0 : 1e-5);
        double q[9];
        pose(&r, q);
        fw_assembly_kinematics_options o = everything;
        const fw_assembly_kinematics *k;
        o.independent = "piston.x";
        fw_status status = fw_assembly_kinematics_solve(arena, &r.m, NULL, q, &o, &diags, &k);
        if (i == 0) {
            assert_int_equal(status, FW_OK);
            assert_true(k->independent.condition > 1e4);
            assert_non_null(k->independent.better);
            assert_true(k->independent.better_condition < 10);
        } else {
            assert_int_equal(status, FW_USAGE);
            assert_non_null(strstr(diags.item[0].message, "phi can (condition"));
        }
        fw_arena_free(arena);
    }
}

/* ---- drivers ---- */

static fw_device_driver sine(const char *id, int pin, double frequency, double phase) {
    return (fw_device_driver){.id = id,
                              .revolute = pin,
                              .joint = FW_NONE,
                              .law = {.kind = &fw_quantity_law_sine,
                                      .end_s = (double)INFINITY,
                                      .frequency_Hz = frequency,
                                      .phase_rad = phase}};
}

/* the piston that a driven crank moves against the closed form, and its reactions against the same
   motion with the crank as independent coordinate */
static void test_driven_crank(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const engine p = {0.05, 0.16, 0.012, 1.0, 0.3, 0.7, -35};
    const double turn = 2 * acos(-1.0), f = 1.3, phase = 0.4;
    rig r = rig_engine(arena, &p, sin(phase));
    rig_force(&r, 2, p.gas, 0);
    fw_device_driver driver = sine("motor", 0, f, phase);
    r.m.driver = &driver, r.m.ndriver = 1;
    double q[9];
    pose(&r, q);
    const fw_assembly_kinematics *k;
    enum { N = 41 };
    if (fw_assembly_kinematics_follow(arena, &r.m, &r.scene, q, N, &everything, &diags, &k) !=
        FW_OK)
        fail_with(&diags);
    for (int i = 0; i < N; i++) {
        double t = (double)i / (N - 1), phi = sin(turn * f * t + phase), x[3], rod[3];
        double w = turn * f * cos(turn * f * t + phase), dw = -turn * f * turn * f * phi;
        engine_exact(&p, phi, w, dw, x, rod);
        assert_near(k[i].t_s, t, 1e-15);
        assert_near(k[i].q[2], phi, 1e-13);
        assert_near(k[i].q[6], x[0], 1e-14);
        assert_near(k[i].v[6], x[1], 1e-12);
        assert_near(k[i].a[6], x[2], 1e-11);
        assert_near(k[i].a[5], rod[2], 1e-10);
        rig free = r;
        free.m.ndriver = 0;
        fw_assembly_kinematics_options o = everything;
        o.independent = "crank.phi", o.rate = &w, o.accel = &dw, o.nrate = o.naccel = 1;
        const fw_assembly_kinematics *other;
        assert_int_equal(
            fw_assembly_kinematics_solve(arena, &free.m, &r.scene, k[i].q, &o, &diags, &other),
            FW_OK);
        assert_near(k[i].driver_N[0], other->drive[0], 1e-10);
        for (int c = 0; c < 6; c++)
            assert_near(k[i].reaction_N[c], other->reaction_N[c], 1e-9);
        assert_near(k[i].joint_N[1], other->joint_N[1], 1e-9);
    }
    fw_arena_free(arena);
}

/* six-bar with three driven hinges: velocities and accelerations are the derivatives of the
   positions, by central differences of order 6 */
static void test_driven_six_bar(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    const double half = acos(-1.0); /* B and F turn the other way */
    fw_device_driver driver[3] = {sine("a", 0, 40, 0), sine("b", 1, 55, half),
                                  sine("f", 5, 35, half)};
    r.m.driver = driver, r.m.ndriver = 3;
    r.scene.duration_s = 1e-3;
    double q[15];
    pose(&r, q);
    const fw_assembly_kinematics *k;
    enum { N = 401 };
    if (fw_assembly_kinematics_follow(arena, &r.m, &r.scene, q, N, &everything, &diags, &k) !=
        FW_OK)
        fail_with(&diags);
    double h = r.scene.duration_s / (N - 1), worst_v = 0, worst_a = 0, most_v = 0, most_a = 0;
    for (int i = 3; i < N - 3; i++)
        for (int c = 0; c < 15; c++) {
            double d1 = (k[i + 1].q[c] - k[i - 1].q[c]) * 45 - (k[i + 2].q[c] - k[i - 2].q[c]) * 9 +
                        (k[i + 3].q[c] - k[i - 3].q[c]);
            double d2 = (k[i + 1].v[c] - k[i - 1].v[c]) * 45 - (k[i + 2].v[c] - k[i - 2].v[c]) * 9 +
                        (k[i + 3].v[c] - k[i - 3].v[c]);
            double unit = c % 3 == 2 ? 1 : 1e-3;
            worst_v = fmax(worst_v, fabs(d1 / (60 * h) - k[i].v[c]) / unit);
            worst_a = fmax(worst_a, fabs(d2 / (60 * h) - k[i].a[c]) / unit);
            most_v = fmax(most_v, fabs(k[i].v[c]) / unit);
            most_a = fmax(most_a, fabs(k[i].a[c]) / unit);
        }
    print_message("velocities within %.1e of %.1e, accelerations %.1e of %.1e\n", worst_v, most_v,
                  worst_a, most_a);
    assert_true(worst_v < 1e-9 * most_v);
    assert_true(worst_a < 1e-9 * most_a);
    fw_arena_free(arena);
}

/* a ramp and a rest: the velocity jumps where the law bends, the position does not */
static void test_ramp(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_four_bar(arena, 0.0);
    fw_device_driver driver = {
        .id = "motor",
        .revolute = 0,
        .joint = FW_NONE,
        .law = {.kind = &fw_quantity_law_ramp, .start_s = 0.25, .rise_s = 0.5}};
    r.m.driver = &driver, r.m.ndriver = 1;
    double q[9];
    pose(&r, q);
    const fw_assembly_kinematics *k;
    if (fw_assembly_kinematics_follow(arena, &r.m, &r.scene, q, 9, &everything, &diags, &k) !=
        FW_OK)
        fail_with(&diags);
    for (int i = 0; i < 9; i++) {
        double t = i / 8.0, phi = fmin(1, fmax(0, (t - 0.25) / 0.5));
        assert_near(k[i].q[2], phi, 1e-14);
        assert_near(k[i].v[2], t >= 0.25 && t < 0.75 ? 2 : 0, 1e-12);
    }
    fw_arena_free(arena);
}

/* a rocker cannot be turned round: said with the time; one driver too few: refused */
static void test_lost(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_four_bar(arena, 2.0);
    fw_device_driver driver = sine("rocker", 3, 1, 0);
    r.m.driver = &driver, r.m.ndriver = 1;
    double q[9];
    pose(&r, q);
    r.m.pin[3].free_angle_rad = -q[8]; /* the law starts where the rocker is */
    driver.law.phase_rad = 0;
    const fw_assembly_kinematics *k;
    assert_int_equal(
        fw_assembly_kinematics_follow(arena, &r.m, &r.scene, q, 50, &everything, &diags, &k),
        FW_SOLVER);
    assert_int_equal(diags.item[0].number, 118);
    print_message("%s\n", diags.item[0].message);
    r.m.ndriver = 0;
    assert_int_equal(
        fw_assembly_kinematics_follow(arena, &r.m, &r.scene, q, 50, &everything, &diags, &k),
        FW_USAGE);
    fw_arena_free(arena);
}

static void test_out_of_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    double q[15], rate[3] = {1, 2, 3};
    pose(&r, q);
    fw_assembly_kinematics_options o = everything;
    o.independent = "AB.phi,BC.phi,CD.phi", o.rate = rate, o.nrate = 3;
    const fw_assembly_kinematics *k;
    fw_arena_fail_at(0, 0);
    assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, &r.scene, q, &o, &diags, &k), FW_OK);
    long count = fw_arena_count();
    for (long n = 1; n <= count; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_assembly_kinematics_solve(arena, &r.m, &r.scene, q, &o, &diags, &k),
                         FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slider_crank),   cmocka_unit_test(test_four_bar),
        cmocka_unit_test(test_six_bar),        cmocka_unit_test(test_choice),
        cmocka_unit_test(test_choice_of_equals),
        cmocka_unit_test(test_dead_centre),    cmocka_unit_test(test_driven_crank),
        cmocka_unit_test(test_driven_six_bar), cmocka_unit_test(test_ramp),
        cmocka_unit_test(test_lost),           cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
