/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "base/arena.h"
#include "rest_rigs.h"

static fw_status solve(fixture *f, const rig *r, bool path, const fw_statics **out) {
    const fw_statics_static_options o = {.path = path};
    return fw_statics_solve(f->arena, &r->m, &r->scene, &o, &f->diags, out);
}

static const fw_statics *equilibrium(fixture *f, const rig *r, bool path) {
    const fw_statics *out = NULL;
    fw_status status = solve(f, r, path, &out);
    if (status != FW_OK)
        fail_msg("%s: %s", fw_status_text(status),
                 f->diags.count ? f->diags.item[f->diags.count - 1].message : "");
    assert_int_equal(f->diags.errors, 0);
    assert_true(out->residual < 1e-13);
    return out;
}

/* index of the n-th point with this mark, or -1 */
static int marked(const fw_statics_path *p, fw_statics_path_mark mark, int n) {
    for (int i = 0; i < p->count; i++)
        if (p->mark[i] == mark && n-- == 0) return i;
    return -1;
}

static int count_marks(const fw_statics_path *p, fw_statics_path_mark mark) {
    int count = 0;
    for (int i = 0; i < p->count; i++)
        count += p->mark[i] == mark;
    return count;
}

/* independent reference, 34 digits: poses in mm, forces in mN; with and without a redundant hinge,
   straight and along the load path */
static void six_bar_reference(void **state) {
    (void)state;
    static const double pose[15] = {
        0.580982890219696333,   0.812540510142242657,  -0.20276460090056886, 0.851082277851917696,
        2.07598729537354477,    -0.142242773260803712, 1.94574108604816751,  2.82800626911484163,
        -0.0339868842821703535, 2.87672363392112797,   1.99183206720253852,  -0.133436532625450505,
        2.70617898674088477,    0.727185958535157151,  -0.212979542122404647};
    static const double force[2][2] = {{0.194549318244111132, 0.184172615702201609},
                                       {-0.155450681755888868, 0.384172615702201609}};
    for (int kind = 0; kind < 4; kind++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, kind & 1);
        const fw_statics *s = equilibrium(&f, &r, kind & 2);
        for (int i = 0; i < 15; i++)
            assert_near(s->q[i] / (i % 3 == 2 ? 1 : 1e-3), pose[i], 2e-13);
        for (int i = 0; i < 6; i++)
            for (int c = 0; c < 2; c++) {
                double got = s->reaction_N[2 * i + c];
                if (i == 3 && (kind & 1)) got += s->reaction_N[12 + c]; /* D shares with D2 */
                assert_near(-got / 1e-3, force[i / 3][c], 1e-13);       /* theirs: on body a */
            }
        assert_int_equal(s->dof, 3);
        assert_int_equal(s->negative + s->neutral, 0);
        assert_int_equal(s->rank.rank, 12);
        assert_int_equal(s->rank.rows, kind & 1 ? 14 : 12);
        assert_true(s->rank.kept > 0.01);
        if (kind & 1) {
            assert_string_equal(s->rank.joints, "D, D2");
            assert_true(s->rank.dropped < 1e-14);
        } else
            assert_null(s->rank.joints);
        if (kind & 2) {
            const fw_statics_path *p = s->path;
            assert_true(p->complete);
            assert_int_equal(p->mark[p->count - 1], FW_PATH_END);
            assert_int_equal(count_marks(p, FW_PATH_POINT), p->count - 1);
            assert_near(p->factor[p->count - 1], 1, 0);
            assert_memory_equal(p->q + 15 * (p->count - 1), s->q, 15 * sizeof(double));
            for (int i = 1; i < p->count; i++)
                assert_true(p->factor[i] > p->factor[i - 1] && p->negative[i] == 0);
        }
        fw_arena_free(f.arena);
    }
}

/* tan theta = F / (m g), in any units */
static void pendulum_in_the_wind(void **state) {
    (void)state;
    for (int unit = -9; unit <= 6; unit += 3) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        double l = pow(10, unit), m = pow(10, 2 * unit), wind = 0.7;
        rig_body(&r, "bob", m, 0.01 * m * l * l, 0, -l, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
        rig_force(&r, 0, wind * m * 9.81, 0);
        r.scene.gravity = true;
        r.scene.gy_m_per_s2 = -9.81;
        r.scene.duration_s = 1;
        const fw_statics *s = equilibrium(&f, &r, unit == 0);
        assert_near(s->angle_rad[0], atan(wind), 1e-14);
        assert_near(s->q[0] / l, sin(atan(wind)), 1e-14);
        double weight = m * 9.81;
        assert_near(s->reaction_N[0] / weight, -wind, 1e-14); /* holds against wind and weight */
        assert_near(s->reaction_N[1] / weight, 1, 1e-14);
        double stiff = weight * sqrt(1 + wind * wind) * l / (m * l * l * 1.01);
        assert_relative(s->eigenvalue_per_s2[0], stiff, 1e-13);
        fw_arena_free(f.arena);
    }
}

/* both limit points, stability between them, and the far end, all in closed form */
static void von_mises_truss(void **state) {
    (void)state;
    for (int k = 0; k < 6; k++) {
        fixture f = begin();
        double b = 1, h = 0.15 + 0.25 * k, stiff = 300, fold = truss_fold(b, h);
        double limit = truss_load(b, h, stiff, fold), load = (1.2 + 0.3 * k) * limit;
        rig r = rig_truss(&f, b, h, stiff, load);
        const fw_statics *s = equilibrium(&f, &r, true);
        const fw_statics_path *p = s->path;
        assert_true(p->complete);
        assert_int_equal(count_marks(p, FW_PATH_FOLD), 2);
        int up = marked(p, FW_PATH_FOLD, 0), down = marked(p, FW_PATH_FOLD, 1);
        assert_relative(p->factor[up], limit / load, 1e-13);
        assert_relative(p->factor[down], -limit / load, 1e-13);
        assert_near(p->q[3 * up + 1], fold, 1e-11);
        assert_near(p->q[3 * down + 1], -fold, 1e-11);
        for (int i = 0; i < p->count; i++) {
            double y = p->q[3 * i + 1];
            assert_near(p->factor[i] * load, truss_load(b, h, stiff, y), 1e-12 * load);
            if (i != up && i != down) assert_int_equal(p->negative[i], fabs(y) < fold);
        }
        /* where it snaps to under the upper limit load */
        double low = h, high = 20 * h;
        for (int i = 0; i < 200; i++) {
            double middle = 0.5 * (low + high);
            *(truss_load(b, h, stiff, -middle) < limit ? &low : &high) = middle;
        }
        assert_near(p->snap_m[up], fold + low, 1e-4 * (fold + low));
        assert_true(isnan(p->snap_m[down]));
        /* the end: below the supports, stretched */
        assert_near(truss_load(b, h, stiff, s->q[1]), load, 1e-12 * load);
        assert_true(s->q[1] < -h);
        assert_int_equal(s->negative, 0);
        const fw_statics *direct = equilibrium(&f, &r, false);
        assert_near(direct->q[1], s->q[1], 1e-13);
        fw_arena_free(f.arena);
    }
}

/* kP: the load of the trivial branch at which it loses its stability, and where descent goes */
static void buckling(void **state) {
    (void)state;
    fixture f = begin();
    double l = 0.7, k = 3.1;
    rig mast = rig_mast(&f, l, k, 2 * k / l);
    const fw_statics *s = equilibrium(&f, &mast, true);
    assert_int_equal(count_marks(s->path, FW_PATH_BIFURCATION), 1);
    assert_int_equal(count_marks(s->path, FW_PATH_FOLD), 0);
    int at = marked(s->path, FW_PATH_BIFURCATION, 0);
    assert_relative(s->path->factor[at], 0.5, 1e-13);
    assert_near(s->angle_rad[0], 0, 1e-14);
    assert_int_equal(s->negative, 1);
    const fw_statics *bent = equilibrium(&f, &mast, false);
    assert_true(bent->left_unstable);
    assert_int_equal(bent->negative, 0);
    double theta = 1.8;
    for (int i = 0; i < 50; i++)
        theta -= (theta - 2 * sin(theta)) / (1 - 2 * cos(theta));
    assert_near(fabs(bent->angle_rad[0]), theta, 1e-13);

    rig column = rig_column(&f, l, k, 1.25 * 2 * k / l);
    s = equilibrium(&f, &column, true);
    at = marked(s->path, FW_PATH_BIFURCATION, 0);
    assert_relative(s->path->factor[at], 0.8, 1e-13);
    assert_int_equal(s->dof, 1);
    bent = equilibrium(&f, &column, false);
    theta = 1; /* 2 k theta = P l sin theta */
    for (int i = 0; i < 50; i++)
        theta -= (theta - 1.25 * sin(theta)) / (1 - 1.25 * cos(theta));
    assert_near(fabs(bent->angle_rad[0]), theta, 1e-13);
    assert_near(fabs(bent->angle_rad[1]), 2 * theta, 1e-13);
    fw_arena_free(f.arena);
}

/* an imperfect mast bends from the start: no bifurcation, and a fold where it is pushed back */
static void imperfection_rounds_the_corner(void **state) {
    (void)state;
    fixture f = begin();
    double l = 0.7, k = 3.1;
    rig r = rig_mast(&f, l, k, 2 * k / l);
    r.m.pin[0].free_angle_rad = 0.01;
    const fw_statics *s = equilibrium(&f, &r, true);
    assert_int_equal(count_marks(s->path, FW_PATH_POINT), s->path->count - 1);
    double theta = 1.8; /* k (theta - 0.01) = P l sin theta */
    for (int i = 0; i < 50; i++)
        theta -= (theta - 0.01 - 2 * sin(theta)) / (1 - 2 * cos(theta));
    assert_near(s->q[2], theta, 1e-13);
    assert_int_equal(s->negative, 0);
    fw_arena_free(f.arena);
}

/* whatever its size, an imperfection bends the path to its side, and no branch crosses it: the bend is so sharp that a long
   step goes across it, to the branch of the straight mast, which is unstable */
static void slight_imperfections_bend(void **state) {
    (void)state;
    for (int tenths = 2; tenths <= 7; tenths++)
        for (int side = -1; side <= 1; side += 2) {
            fixture f = begin();
            double l = 0.7, k = 3.1, off = side * pow(10, -tenths);
            rig r = rig_mast(&f, l, k, 1.05 * k / l);
            r.m.pin[0].free_angle_rad = off;
            const fw_statics *s = equilibrium(&f, &r, true);
            assert_int_equal(count_marks(s->path, FW_PATH_BIFURCATION), 0);
            assert_int_equal(count_marks(s->path, FW_PATH_FOLD), 0);
            assert_int_equal(s->negative, 0);
            double theta = side * 0.6; /* k (theta - off) = P l sin theta */
            for (int i = 0; i < 50; i++)
                theta -= (theta - off - 1.05 * sin(theta)) / (1 - 1.05 * cos(theta));
            assert_near(s->q[2], theta, 1e-12);
            fw_arena_free(f.arena);
        }
}

/* a spring k and from x = gap on a cable k2: x = (F + k2 gap) / (k + k2), the switch at k gap / F
 */
static void cable_takes_hold(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 0, 2);
    rig_body(&r, "car", 1, 1, 0, 0, 0);
    rig_guide(&f, &r, 0, 0, 0, 0);
    rig_spring(&r, "spring", FW_GROUND, -5, 0, 0, 0, 0, 10, 5);
    rig_spring(&r, "spring", FW_GROUND, -4, 0, 0, 0, 0, 30, 4.2)->cable = true;
    r.m.spring[1].id = "rope";
    rig_force(&r, 0, 8, 0);
    r.scene.duration_s = 1;
    for (int path = 0; path < 2; path++) {
        const fw_statics *s = equilibrium(&f, &r, path);
        assert_near(s->q[0], (8 + 30 * 0.2) / 40, 1e-14);
        assert_int_equal(s->nactive, 1);
        assert_string_equal(s->active[0].id, "rope");
        assert_true(s->active[0].on);
        if (!path) continue;
        int at = marked(s->path, FW_PATH_SWITCH, 0);
        assert_relative(s->path->factor[at], 10 * 0.2 / 8, 1e-13);
        assert_int_equal(s->path->which[at], 0);
        assert_int_equal(count_marks(s->path, FW_PATH_SWITCH), 1);
    }
    r.scene.force[0].fx_N = -8; /* the other way: slack */
    const fw_statics *s = equilibrium(&f, &r, true);
    assert_near(s->q[0], -0.8, 1e-14);
    assert_false(s->active[0].on);
    fw_arena_free(f.arena);
}

static void stop_takes_over(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 1, 0);
    rig_body(&r, "arm", 1, 1, 1, 0, 0);
    fw_mechanism_pin *p = rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 2, 0);
    p->stop_min_rad = (double)NAN, p->stop_max_rad = 0.4, p->stop_stiffness_Nm_per_rad = 50;
    rig_torque(&r, 0, 3);
    r.scene.duration_s = 1;
    const fw_statics *s = equilibrium(&f, &r, true);
    assert_near(s->angle_rad[0], (3 + 50 * 0.4) / 52, 1e-14);
    assert_int_equal(s->nactive, 1);
    assert_true(s->active[0].on && s->active[0].side > 0);
    int at = marked(s->path, FW_PATH_SWITCH, 0);
    assert_relative(s->path->factor[at], 2 * 0.4 / 3, 1e-13);
    assert_near(s->path->angle_rad[at], 0.4, 1e-13);
    fw_arena_free(f.arena);
}

/* what nothing holds against its load has no equilibrium, and the message names it */
static void runaway_is_an_error(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 2, 2, 0);
    rig_body(&r, "held", 1, 1, 1, 0, 0);
    rig_body(&r, "loose", 1, 1, 3, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 5, 0);
    rig_pin(&r, "P", 0, 1, 2, 0, 0, 0);
    rig_torque(&r, 1, 0.1);
    r.scene.duration_s = 1;
    const fw_statics *s = (const fw_statics *)&r;
    for (int path = 0; path < 2; path++) {
        assert_int_equal(solve(&f, &r, path, &s), FW_SOLVER);
        assert_null(s);
        assert_true(said(&f, 111));
        assert_non_null(strstr(f.diags.item[f.diags.count - 1].message, "loose"));
    }
    r.scene.ntorque = 0; /* without a load it rests anywhere */
    fixture g = begin();
    assert_int_equal(solve(&g, &r, false, &s), FW_OK);
    assert_int_equal(s->neutral, 1);
    assert_string_equal(s->loose, "loose");
    assert_true(said(&g, 113));
    fw_arena_free(f.arena);
    fw_arena_free(g.arena);
}

/* drivers go their way with the load factor, loads end where their laws do */
static void laws_at_the_end_of_the_scene(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 2, 2, 0);
    rig_body(&r, "crank", 1, 0.1, 0.5, 0, 0);
    rig_body(&r, "rod", 1, 0.1, 1.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "P", 0, 1, 1, 0, 4, 0);
    r.m.driver = fw_arena_array(f.arena, fw_device_driver, 1);
    r.m.ndriver = 1;
    r.m.driver[0] = (fw_device_driver){.id = "turn",
                                       .revolute = 0,
                                       .joint = FW_NONE,
                                       .law = {.kind = &fw_quantity_law_table, .ntable = 2}};
    const double t[2] = {0, 2}, angle[2] = {0, 7};
    r.m.driver[0].law.table_t_s = t;
    r.m.driver[0].law.table_value = angle;
    const fw_quantity_law ramp = {
        .kind = &fw_quantity_law_ramp, .rise_s = 4, .end_s = (double)INFINITY};
    rig_torque(&r, 1, 2);
    r.scene.torque[0].law = &ramp;
    r.scene.duration_s = 1;
    for (int path = 0; path < 2; path++) {
        const fw_statics *s = equilibrium(&f, &r, path); /* driver 3.5 rad, torque 0.5 N m */
        assert_near(s->angle_rad[0], 3.5, 1e-14);
        assert_near(s->angle_rad[1], 0.5 / 4, 1e-14);
        assert_near(s->q[3], cos(3.5) + 0.5 * cos(3.5 + 0.125), 1e-14);
        if (path)
            for (int i = 0; i < s->path->count; i++)
                assert_near(s->path->angle_rad[2 * i], 3.5 * s->path->factor[i], 1e-13);
    }
    fw_arena_free(f.arena);
}

static fw_device_driver *rig_drive(fixture *f, rig *r, const char *id, int joint, double way) {
    if (!r->m.driver) r->m.driver = fw_arena_array(f->arena, fw_device_driver, 4);
    double *table = fw_arena_array(f->arena, double, 4);
    table[1] = r->scene.duration_s, table[3] = way;
    fw_device_driver *d = &r->m.driver[r->m.ndriver++];
    *d = (fw_device_driver){
        .id = id, .revolute = joint, .joint = FW_NONE, .law = {.kind = &fw_quantity_law_table}};
    d->law.ntable = 2, d->law.table_t_s = table, d->law.table_value = table + 2;
    return d;
}

/* a crank that goes round several times: x = r cos a + sqrt(l^2 - r^2 sin^2 a) on every way there
 */
static void driven_slider_crank(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 3, 3, 0);
    rig_body(&r, "crank", 5, 0.2, 0.5, 0, 0);
    rig_body(&r, "rod", 8, 6, 2.5, 0, 0);
    rig_body(&r, "piston", 20, 3, 4, 0, 0);
    rig_pin(&r, "main", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "pin", 0, 1, 1, 0, 0, 0);
    rig_pin(&r, "wrist", 1, 2, 4, 0, 0, 0);
    rig_guide(&f, &r, 2, 0, 0, 0);
    r.scene.duration_s = 1;
    rig_force(&r, 2, -7, -2);
    const double way = 20;
    rig_drive(&f, &r, "motor", 0, way);
    for (int path = 0; path < 2; path++) {
        const fw_statics *s = equilibrium(&f, &r, path);
        assert_int_equal(s->dof, 0);
        double tilt = asin(sin(way) / 3), slope = -sin(way) - cos(way) * tan(tilt);
        assert_near(s->q[2], way, 1e-13);
        assert_near(s->q[6], cos(way) + 3 * cos(tilt), 1e-12);
        /* the motor holds against the piston, the guide carries what the rod pushes across */
        assert_near(s->driver_N[0], 7 * slope, 1e-11);
        assert_near(s->joint_N[0], 0, 1e-12);
        assert_near(s->joint_N[1], 2 + 7 * tan(tilt), 1e-11);
        assert_near(s->joint_N[2], 0, 1e-11);
    }
    fw_arena_free(f.arena);
}

/* a parallelogram that goes through flat positions stays one: its coupler does not turn */
static void driven_parallelogram(void **state) {
    (void)state;
    for (int i = 0; i < 12; i++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 3, 4, 0);
        rig_body(&r, "a", 1, 0.1, 0, 0.5, 0);
        rig_body(&r, "b", 1, 0.1, 1, 1, 0);
        rig_body(&r, "c", 1, 0.1, 2, 0.5, 0);
        rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
        rig_pin(&r, "B", 0, 1, 0, 1, 0, 0);
        rig_pin(&r, "C", 1, 2, 2, 1, 0, 0);
        rig_pin(&r, "D", FW_GROUND, 2, 2, 0, 0, 0);
        r.scene.duration_s = 1;
        double way = (i % 2 ? -1 : 1) * (2.1 + 0.7 * i);
        if (i == 3) way = 8 * acos(0.0); /* steps of equal size end exactly in flat positions */
        rig_drive(&f, &r, "motor", 0, way);
        const fw_statics *s = equilibrium(&f, &r, false);
        assert_near(s->q[2], way, 1e-12);
        assert_near(s->q[5], 0, 1e-10);
        assert_near(s->q[8], way, 1e-10);
        fw_arena_free(f.arena);
    }
}

/* drivers that contradict each other are named; one that goes too far has its joint named */
static void impossible_drivers(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 2, 3, 0);
    rig_body(&r, "p", 1, 1, 1, 0, 0);
    rig_body(&r, "q", 1, 1, 3, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "A2", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, 2, 0, 0, 0);
    r.scene.duration_s = 3;
    rig_drive(&f, &r, "first", 0, 3);
    rig_drive(&f, &r, "second", 1, 3.003);
    rig_drive(&f, &r, "innocent", 2, 1);
    const fw_statics *s = (const fw_statics *)&r;
    assert_int_equal(solve(&f, &r, false, &s), FW_SOLVER);
    const char *text = f.diags.item[f.diags.count - 1].message;
    assert_true(said(&f, 118));
    assert_non_null(strstr(text, "contradict each other"));
    assert_non_null(strstr(text, "first, second"));
    assert_null(strstr(text, "innocent"));
    fixture g = begin();
    r = rig_new(g.arena, 3, 4, 0); /* ground 2, crank 1, coupler and rocker 0.9: 0.8 missing */
    rig_body(&r, "crank", 1, 0.1, 0.5, 0, 0);
    rig_body(&r, "coupler", 1, 0.1, 1.25, 0.4, 0);
    rig_body(&r, "rocker", 1, 0.1, 1.75, 0.4, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, 1, 0, 0, 0);
    rig_pin(&r, "C", 1, 2, 1.5, 0.75, 0, 0);
    rig_pin(&r, "D", FW_GROUND, 2, 2, 0, 0, 0);
    r.scene.duration_s = 1;
    rig_drive(&g, &r, "motor", 0, 3);
    assert_int_equal(solve(&g, &r, false, &s), FW_SOLVER);
    assert_true(said(&g, 118));
    text = g.diags.item[g.diags.count - 1].message;
    /* the crank's end is 1.803 = 2 hypot(0.5, 0.75) away from D at the most */
    double most = acos((5 - 4 * (0.25 + 0.5625)) / 4), said_at = 0;
    const char *at = strstr(text, "beyond load factor ");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "beyond load factor %lf", &said_at), 1);
    assert_near(said_at, most / 3, 1e-4);
    fw_arena_free(f.arena);
    fw_arena_free(g.arena);
}

/* stable paths end where descent ends, on random chains and loops */
static void paths_and_descent_agree(void **state) {
    (void)state;
    int compared = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        fixture f = begin();
        rig r = rig_any(f.arena, seed);
        const fw_statics *a = equilibrium(&f, &r, true), *b = equilibrium(&f, &r, false);
        bool plain = a->path->complete;
        for (int i = 0; i < a->path->count; i++)
            plain = plain && a->path->mark[i] != FW_PATH_FOLD && a->path->negative[i] == 0;
        assert_int_equal(b->negative, 0);
        for (int i = 0; plain && i < 3 * r.m.nbody; i++)
            plain = plain && fabs(a->q[i] - b->q[i]) < (i % 3 == 2 ? 1 : 1e-3);
        for (int i = 0; plain && i < 3 * r.m.nbody; i++)
            assert_near(a->q[i], b->q[i], i % 3 == 2 ? 1e-12 : 1e-15);
        compared += plain;
        fw_arena_free(f.arena);
    }
    assert_true(compared >= 50);
}

static void nothing_to_move(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 2, 0);
    rig_body(&r, "block", 1, 1, 0.5, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", FW_GROUND, 0, 1, 0, 0, 0);
    rig_force(&r, 0, 0, -4);
    r.scene.duration_s = 1;
    const fw_statics *s = equilibrium(&f, &r, true);
    assert_int_equal(s->dof, 0);
    assert_near(s->reaction_N[1], 2, 1e-14);
    assert_near(s->reaction_N[3], 2, 1e-14);
    assert_true(s->path->complete);
    fw_arena_free(f.arena);
}

static void bad_numbers_and_short_memory(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    r.scene.force[0].fx_N = (double)NAN;
    const fw_statics *s;
    assert_int_equal(solve(&f, &r, false, &s), FW_INPUT);
    fw_arena_free(f.arena);
    int failures = 0;
    for (long n = 1;; n += 7) {
        fixture g = begin();
        rig six = rig_six_bar(g.arena, false);
        fw_arena_fail_at(n, 1);
        fw_status status = solve(&g, &six, true, &s);
        fw_arena_fail_at(0, 0);
        fw_arena_free(g.arena);
        if (status == FW_OK) break;
        assert_int_equal(status, FW_NOMEM);
        failures++;
    }
    assert_true(failures > 10);
}

static void stops_when_asked(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_statics *s;
    fw_cancel cancel = {0};
    fw_arena_stop_with(f.arena, &cancel);
    fw_cancel_request(&cancel, 2);
    fw_status status = solve(&f, &r, true, &s);
    fw_cancel_clear(&cancel);
    assert_int_equal(status, FW_CANCELLED);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(six_bar_reference),
        cmocka_unit_test(pendulum_in_the_wind),
        cmocka_unit_test(von_mises_truss),
        cmocka_unit_test(buckling),
        cmocka_unit_test(imperfection_rounds_the_corner),
        cmocka_unit_test(slight_imperfections_bend),
        cmocka_unit_test(cable_takes_hold),
        cmocka_unit_test(stop_takes_over),
        cmocka_unit_test(runaway_is_an_error),
        cmocka_unit_test(laws_at_the_end_of_the_scene),
        cmocka_unit_test(driven_slider_crank),
        cmocka_unit_test(driven_parallelogram),
        cmocka_unit_test(impossible_drivers),
        cmocka_unit_test(paths_and_descent_agree),
        cmocka_unit_test(nothing_to_move),
        cmocka_unit_test(bad_numbers_and_short_memory),
        cmocka_unit_test(stops_when_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
