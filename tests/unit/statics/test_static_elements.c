/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements at rest: the tangent against differences, equilibria and load paths against closed
   forms, modes of a bar on a released pin. */
#include "quantity/law_kind.h"
#include "rest_rigs.h"
#include "dynamics/element_rigs.h"
#include "multibody/systems.h"
#include "statics/statics_equilibrium.h"

static const fw_statics *solve(fixture *f, const rig *r, const fw_effects_loads *t, bool path) {
    fw_statics_equilibrium *w = fw_arena_one(f->arena, fw_statics_equilibrium);
    const fw_statics *out = NULL;
    const fw_statics_static_options o = {.path = path};
    assert_int_equal(fw_statics_equilibrium_new_loads(f->arena, &r->m, &r->scene, t, &f->diags, w),
                     FW_OK);
    fw_status status = fw_statics_equilibrium_statics(w, &o, &out);
    if (status != FW_OK)
        fail_msg("%s", f->diags.count ? f->diags.item[f->diags.count - 1].message : "no message");
    return out;
}

/* ---- tangent ---- */

/* G^T lambda - Q at y, flags as they are */
static void balance(fw_multibody_system *sys, const double *y, const double *lambda, double *f) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y);
    const double *accel = fw_multibody_forces(sys, pose, y + m->nq)->accel;
    for (int i = 0; i < m->nq; i++)
        f[i] = -(i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) * accel[i];
    rig_transpose(m, pose, lambda, f);
}

static void tangent_is_the_derivative(void **state) {
    (void)state;
    static const double weight[7] = {-1, 9, -45, 0, 45, -9, 1};
    int on = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        fixture f = begin();
        uint64_t pick = 71 * seed;
        rig r = rig_any(f.arena, seed);
        fw_effects_loads t = rig_terms(f.arena, &r);
        line d[3];
        const bush b = {30, 1e-6, 2e-11};
        for (int i = 0; i < 3; i++) {
            int a = i - 1, to = i ? (i + r.m.nbody - 1) % r.m.nbody : 0;
            d[i] = (line){rig_random(&pick), 1e-6 * rig_random(&pick), 4e-3 * rig_random(&pick),
                          1e-4, 1e-4};
            double x = 2e-3 * rig_random(&pick), y = 2e-3 + 1e-3 * rig_random(&pick);
            line_add(f.arena, &t, &d[i], a, x, y, to, 2e-4, -1e-4)->switches = i == 1;
        }
        if (seed % 2) bush_release(f.arena, &r.m, &t, 1, &b);
        double y[128] = {0}, z[128], lambda[64] = {0}, value[7][64], sum;
        fw_multibody_system *sys = rig_system_with(f.arena, &r.m, &t, 1, NULL);
        const fw_multibody_model *m = sys->model;
        int n = m->nq;
        double *k = fw_arena_array(f.arena, double, (size_t)(n * n)), worst = 0, most = 0;
        double *c = fw_arena_array(f.arena, double, (size_t)(n * n));
        for (int i = 0; i < 2 * n; i++)
            y[i] = 0.3 * (rig_random(&pick) - 0.5);
        for (int i = 0; i < 2 * m->nblock; i++)
            lambda[i] = rig_random(&pick) - 0.5;
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, 0, y);
        on += fw_multibody_switch_on(sys, 0);
        fw_statics_tangent(sys, pose, y + n, lambda, k, c);
        for (int j = 0; j < 2 * n; j++) {
            const double *matrix = j < n ? k + j : c + j - n, h = 1e-3;
            for (int s = 0; s < 7; s++) {
                memcpy(z, y, sizeof z);
                z[j] += (s - 3) * h;
                balance(sys, z, lambda, value[s]);
            }
            for (int i = 0; i < n; i++) {
                sum = 0;
                for (int s = 0; s < 7; s++)
                    sum += weight[s] * value[s][i] / (60 * h);
                most = fmax(most, fabs(matrix[i * n]));
                worst = fmax(worst, fabs(sum - matrix[i * n]));
            }
        }
        if (!(worst < 1e-9 * most)) fail_msg("seed %d: off by %g of %g", (int)seed, worst, most);
        fw_arena_free(f.arena);
    }
    assert_true(on > 5 && on < 30);
}

/* ---- equilibria ---- */

/* kr phi = T x (arm of the line to the bar's end) */
static double bar_moment(double phi, double kr, const line *d, double law) {
    double ex = cos(phi), ey = sin(phi), dx = ex - 0.4, dy = ey - 1.3, l = hypot(dx, dy);
    double tension = law * d->pull + d->k * (l + law * d->draw - d->length);
    return kr * phi + tension * (ex * dy - ey * dx) / l;
}

/* a bar on a torsion spring, pulled and drawn by lines whose law ends at 0.6 */
static void pulled_bar(void **state) {
    (void)state;
    static const double time[3] = {0, 1, 2}, factor[3] = {0, 5, 0.6};
    const fw_quantity_law law = {
        .kind = &fw_quantity_law_table, .table_t_s = time, .table_value = factor, .ntable = 3};
    const line cases[] = {{.pull = 3},
                          {.k = 5, .draw = 0.5, .length = hypot(0.6, 1.3)},
                          {.k = 2, .draw = 0.3, .pull = 2, .length = 1}};
    for (int i = 0; i < 3; i++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        rig_body(&r, "bar", 1, 0.1, 0.5, 0, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 2, 0);
        r.scene.duration_s = 2;
        fw_effects_loads t = rig_terms(f.arena, &r);
        fw_effects_force_element *e =
            line_add(f.arena, &t, &cases[i], FW_GROUND, 0.4, 1.3, 0, 0.5, 0);
        e->law[e->laws++] = &law;
        double low = -1, high = 1.4;
        for (int k = 0; k < 60; k++) {
            double middle = 0.5 * (low + high);
            *(bar_moment(middle, 2, &cases[i], 0.6) < 0 ? &low : &high) = middle;
        }
        for (int path = 0; path < 2; path++) {
            const fw_statics *s = solve(&f, &r, &t, path);
            assert_near(s->angle_rad[0], low, 1e-12);
            assert_int_equal(s->negative, 0);
            for (int k = 0; path && k < s->path->count;
                 k++) /* the load factor is in the law's place */
                assert_near(
                    bar_moment(s->path->angle_rad[k], 2, &cases[i], 0.6 * s->path->factor[k]), 0,
                    1e-11);
        }
        fw_arena_free(f.arena);
    }
}

/* a slide on a spring K, drawn by a line k that is slack by 0.2 at first: x = k (s d - 0.2)/(k +
   K), nothing before; the path bends where it becomes taut, and the line is named */
static void slack_line(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 0, 0);
    rig_body(&r, "cart", 1, 1, 0, 0, 0);
    rig_guide(&f, &r, 0, 0, 0, 0)->stiffness_N_per_m = 3;
    r.scene.duration_s = 1;
    fw_effects_loads t = rig_terms(f.arena, &r);
    const line d = {.k = 5, .draw = 0.5, .length = 1.2};
    fw_effects_force_element *e = line_add(f.arena, &t, &d, FW_GROUND, 1, 0, 0, 0, 0);
    e->switches = 1, e->id = "rope";
    const fw_statics *s = solve(&f, &r, &t, true);
    assert_near(s->q[0], 5 * 0.3 / 8, 1e-13);
    assert_int_equal(s->nactive, 1);
    assert_string_equal(s->active[0].id, "rope");
    assert_true(s->active[0].on);
    int taut = -1;
    for (int i = 0; i < s->path->count; i++) {
        double x = fmax(0, 5 * (0.5 * s->path->factor[i] - 0.2) / 8);
        assert_near(s->path->q[3 * i], x, 1e-12);
        if (s->path->mark[i] == FW_PATH_SWITCH) taut = i;
    }
    assert_true(taut > 0);
    assert_near(s->path->factor[taut], 0.4, 1e-12);
    assert_int_equal(s->path->which[taut], 0);
    fw_arena_free(f.arena);
}

/* ---- plates: C (load / gap)^2 between ports along x; they touch at a tenth of a unit ---- */

static double gap_of(const fw_effects_port_state *s) {
    return s->p[0] - s->p[3];
}

static void plate_push(double force, double *f) {
    memset(f, 0, 6 * sizeof *f);
    f[3] = force, f[0] = -force;
}

static void plate_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double *f) {
    double g = gap_of(s), c = *(const double *)e->data;
    plate_push(c * s->load * s->load / (g * g), f);
}

static void plate_slope(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double *f) {
    double g = gap_of(s), c = *(const double *)e->data;
    plate_push(2 * c * s->load / (g * g), f);
}

static void plate_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double *stiffness, double *damping) {
    double g = gap_of(s), c = *(const double *)e->data, k = 2 * c * s->load * s->load / (g * g * g);
    memset(stiffness, 0, 36 * sizeof *stiffness);
    memset(damping, 0, 36 * sizeof *damping);
    stiffness[0] = stiffness[3 * 6 + 3] = -k;
    stiffness[3] = stiffness[3 * 6] = k;
}

static bool plate_valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        const char **why) {
    (void)e;
    *why = "the plates touch: lower the voltage";
    return gap_of(s) > 0.1;
}

static const fw_effects_element_class plate_class = {.effect = "plate",
                                                     .force = plate_force,
                                                     .tangent = plate_tangent,
                                                     .slope = plate_slope,
                                                     .valid = plate_valid};

/* pull-in at a third of the gap, where s^2 C = 4 K g^3 / 27: a fold of the path; above it there is
   no equilibrium, and the plates say why */
static void pull_in(void **state) {
    (void)state;
    for (int over = 0; over < 2; over++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 0, 0);
        rig_body(&r, "rotor", 1, 1, 0, 0, 0);
        rig_guide(&f, &r, 0, 0, 0, 0)->stiffness_N_per_m = 3;
        r.scene.duration_s = 1;
        fw_effects_loads t = rig_terms(f.arena, &r);
        double top = 4 * 3 * 8.0 / 27, c = (over ? 1.3 : 0.8) * top;
        fw_effects_force_element *e = fw_effects_loads_add_element(f.arena, &t, &plate_class, 2);
        e->port[0] = (fw_effects_port){FW_GROUND, 2, 0}, e->port[1] = (fw_effects_port){0, 0, 0};
        e->works = true, e->force_N = c / 4, e->data = &c, e->id = "drive";
        if (!over) {
            const fw_statics *s = solve(&f, &r, &t, false);
            double x = s->q[0];
            assert_near(3 * x * (2 - x) * (2 - x), c, 1e-12);
            assert_true(x < 2.0 / 3);
            fw_arena_free(f.arena);
            continue;
        }
        fw_statics_equilibrium w;
        const fw_statics *none;
        fw_statics_path *path;
        bool unstable = false;
        assert_int_equal(
            fw_statics_equilibrium_new_loads(f.arena, &r.m, &r.scene, &t, &f.diags, &w), FW_OK);
        assert_int_equal(fw_statics_equilibrium_descend(&w, &unstable), FW_OK);
        assert_int_equal(fw_statics_equilibrium_follow(&w, 0, &path), FW_OK);
        int fold = -1;
        for (int i = 0; i < path->count; i++)
            if (path->mark[i] == FW_PATH_FOLD) fold = i;
        assert_true(fold > 0);
        assert_near(path->q[3 * fold], 2.0 / 3, 1e-7);
        assert_near(path->factor[fold], sqrt(top / c), 1e-12);
        assert_false(path->complete);
        assert_int_equal(
            fw_statics_equilibrium_new_loads(f.arena, &r.m, &r.scene, &t, &f.diags, &w), FW_OK);
        const fw_statics_static_options o = {0};
        assert_int_equal(fw_statics_equilibrium_statics(&w, &o, &none), FW_SOLVER);
        assert_true(said(&f, 242));
        assert_non_null(strstr(f.diags.item[f.diags.count - 1].message, "lower the voltage"));
        fw_arena_free(f.arena);
    }
}

/* ---- modes ---- */

/* a bar whose end (-l, 0) sits on a bush: along x sqrt(k/m); across, M = diag(m, J) and
   K = [k, -k l; -k l, k l^2 + kr] */
static void bar_on_a_released_pin(void **state) {
    (void)state;
    const double mass = 2, inertia = 0.3, l = 0.5;
    const bush d = {900, 40, 0.5};
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 1, 0);
    rig_body(&r, "bar", mass, inertia, l, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 3, 0);
    r.scene.duration_s = 1;
    fw_effects_loads t = rig_terms(f.arena, &r);
    bush_release(f.arena, &r.m, &t, 0, &d);
    fw_statics_equilibrium w;
    const fw_statics_modes *m;
    const fw_statics_mode_options o = {0};
    assert_int_equal(fw_statics_equilibrium_new_loads(f.arena, &r.m, &r.scene, &t, &f.diags, &w),
                     FW_OK);
    assert_int_equal(fw_statics_equilibrium_modes(&w, &o, &m), FW_OK);
    assert_int_equal(m->count, 3);
    assert_int_equal(m->rank.rows, 0);
    double a = d.k / mass, b = (d.k * l * l + d.kr) / inertia;
    double mean = 0.5 * (a + b), det = d.k * d.kr / (mass * inertia);
    double root = sqrt(mean * mean - det), want[3] = {det / (mean + root), a, mean + root};
    double decay = 0;
    for (int i = 0; i < 3; i++) {
        assert_relative(m->mode[i].stiffness_per_s2, want[i], 1e-12);
        decay += m->mode[i].eigenvalue_per_s[0][0] + m->mode[i].eigenvalue_per_s[1][0];
    }
    assert_relative(decay, -d.cr / inertia, 1e-12);
    fw_arena_free(f.arena);
}

/* at rest under its weight: the bush is pressed by m g, and that is the reaction */
static void reaction_of_a_released_pin(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 1, 0);
    rig_body(&r, "bar", 2, 0.3, 0.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 1;
    const bush d = {900, 40, 0};
    fw_effects_loads t = rig_terms(f.arena, &r);
    bush_release(f.arena, &r.m, &t, 0, &d);
    const fw_statics *s = solve(&f, &r, &t, false);
    double phi = s->angle_rad[0];
    assert_near(s->reaction_N[0], 0, 1e-10);
    assert_relative(s->reaction_N[1], 2 * 9.81, 1e-12);
    assert_relative(d.kr * phi, -2 * 9.81 * 0.5 * cos(phi), 1e-12);
    assert_relative(s->q[1] - 0.5 * sin(phi), -2 * 9.81 / 900, 1e-12);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangent_is_the_derivative),
        cmocka_unit_test(pulled_bar),
        cmocka_unit_test(slack_line),
        cmocka_unit_test(pull_in),
        cmocka_unit_test(bar_on_a_released_pin),
        cmocka_unit_test(reaction_of_a_released_pin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
