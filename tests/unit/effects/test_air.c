/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Air: properties against published numbers, films against independent solutions, and what every
   element class must satisfy. */
#include "effects/effect.h"
#include "element_check.h"
#include <complex.h>

static const double pi = 3.14159265358979323846;

static double number(uint64_t *seed) { /* in [-1, 1) */
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return 2 * ((double)(*seed >> 11) * 0x1p-53) - 1;
}

static fw_device_air any_air(fw_device_air_kind kind) {
    const double open = (double)NAN;
    return (fw_device_air){.kind = kind,
                           .body = FW_NONE,
                           .against = FW_GROUND,
                           .gap_m = 2e-6,
                           .area_m2 = open,
                           .length_m = 200e-6,
                           .depth_m = 20e-6,
                           .pressure_Pa = open,
                           .temperature_K = open,
                           .viscosity_Pas = open};
}

static fw_effects_gas gas_at(double pressure_Pa) {
    fw_device_air a = any_air(FW_AIR_SLIDE);
    a.pressure_Pa = pressure_Pa;
    return fw_effects_gas_of(&a);
}

/* ---- properties ---- */

static void published_air(void **state) {
    (void)state;
    assert_relative(fw_effects_air_viscosity(293.15), 18.2e-6, 5e-3); /* CRC Handbook */
    assert_relative(fw_effects_air_viscosity(300), 18.5e-6, 5e-3);
    assert_relative(fw_effects_air_viscosity(400), 23.0e-6, 1e-2);
    assert_relative(fw_effects_air_viscosity(200), 13.3e-6, 1e-2);
    fw_effects_gas g = gas_at((double)NAN);
    assert_relative(g.density_kg_per_m3, 1.204, 1e-3);
    assert_relative(g.path_m, 65.43e-9, 1e-2); /* Jennings 1988 */
    assert_relative(g.path_m, 68e-9, 5e-2);    /* as often quoted */
    assert_relative(gas_at(100).path_m, g.path_m * 1013.25, 1e-14);
    fw_device_air stated = any_air(FW_AIR_DRAG);
    stated.viscosity_Pas = 9e-6, stated.temperature_K = 400;
    g = fw_effects_gas_of(&stated);
    assert_true(g.viscosity_Pas == 9e-6 && g.temperature_K == 400);
}

/* ---- squeeze film ---- */

/* integral of u, -laplace u = 1 on n x m cells of width h, u = 0 around; successive over-relaxation
   to round-off */
static double by_differences(int n, int m, double h) {
    static double u[257 * 65];
    memset(u, 0, sizeof u);
    const int w = m + 1;
    double relax = 2 / (1 + sin(pi / m)), sum = 0;
    for (int sweep = 0; sweep < 10 * n; sweep++)
        for (int i = 1; i < n; i++)
            for (int j = 1; j < m; j++) {
                double *at = &u[i * w + j];
                double next = (at[-1] + at[1] + at[-w] + at[w] + h * h) / 4;
                *at += relax * (next - *at);
            }
    for (int i = 1; i < n; i++)
        for (int j = 1; j < m; j++)
            sum += u[i * w + j];
    return sum * h * h;
}

/* the error of the differences goes with h^2, then h^4 (but for the corners): extrapolated twice */
static void rectangle_integral(void **state) {
    (void)state;
    static const int ratio[3] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        double value[3];
        int m = 16;
        for (int k = 0; k < 3; k++, m *= 2)
            value[k] = by_differences(ratio[i] * m, m, 1.0 / (ratio[i] * m));
        double once = (4 * value[1] - value[0]) / 3, again = (4 * value[2] - value[1]) / 3;
        double want = again + (again - once) / 15;
        assert_relative(fw_effects_rectangle_integral(1, 1.0 / ratio[i]), want, 2e-6);
        assert_relative(fw_effects_rectangle_integral(1.0 / ratio[i], 1), want, 2e-6);
    }
    assert_near(12 * fw_effects_rectangle_integral(1, 1), 0.4217,
                5e-5); /* published for the square */
    assert_relative(fw_effects_rectangle_integral(1e4, 1), 1e4 / 12, 1e-4); /* a long strip */
}

static void squeeze_coefficient(void **state) {
    (void)state;
    fw_effects_gas g = gas_at((double)NAN);
    g.path_m = 0;
    fw_effects_squeeze film = fw_effects_air_squeeze(&g, 1e-4, 1e-4, 2e-6);
    assert_relative(fw_effects_squeeze_at(&film, 2e-6, NULL),
                    0.4217 * g.viscosity_Pas * 1e-16 / 8e-18, 2e-4);
    g = gas_at(3e3); /* Kn near 1 */
    film = fw_effects_air_squeeze(&g, 3e-4, 2e-5, 2e-6);
    for (int i = 0; i < 6; i++) {
        double gap = 1e-6 * (0.7 + i), h = 1e-3 * gap, slope, kn = g.path_m / gap;
        double c = fw_effects_squeeze_at(&film, gap, &slope);
        double dense =
            12 * g.viscosity_Pas * fw_effects_rectangle_integral(3e-4, 2e-5) / pow(gap, 3);
        assert_relative(c, dense / (1 + 9.638 * pow(kn, 1.159)), 1e-12);
        double rate = (8 * (fw_effects_squeeze_at(&film, gap + h, NULL) -
                            fw_effects_squeeze_at(&film, gap - h, NULL)) -
                       fw_effects_squeeze_at(&film, gap + 2 * h, NULL) +
                       fw_effects_squeeze_at(&film, gap - 2 * h, NULL)) /
                      (12 * h);
        assert_relative(slope, rate, 1e-9);
    }
}

/* ---- slide and drag: limits ---- */

static void limits_of_dampers(void **state) {
    (void)state;
    const double r = 100e-6;
    const fw_effects_face disc = {pi * r * r, pi * r * r * r * r / 2, 2 * pi * r};
    fw_effects_gas dense = gas_at(1e9), thin = gas_at(1e-3);
    double mu = dense.viscosity_Pas;
    fw_effects_damper d = fw_effects_air_drag(&dense, &disc);
    assert_relative(d.force_Ns_per_m, 32.0 / 3 * mu * r, 1e-5);
    assert_relative(d.couple_Nms, 32.0 / 3 * mu * r * r * r, 1e-5);
    /* free molecules: each face loses p/sqrt(2 pi R T) v per area */
    double beat = thin.pressure_Pa / sqrt(2 * pi * 287.05 * thin.temperature_K);
    d = fw_effects_air_drag(&thin, &disc);
    assert_relative(d.force_Ns_per_m, 2 * beat * disc.area_m2, 1e-5);
    assert_relative(d.couple_Nms, 2 * beat * disc.polar_m4, 1e-5);
    /* a film: dense Couette flow; free molecules between two walls, one face */
    d = fw_effects_air_slide(&dense, &disc, 2e-6);
    assert_relative(d.force_Ns_per_m, mu * disc.area_m2 / 2e-6, 1e-4);
    assert_relative(d.couple_Nms, mu * disc.polar_m4 / 2e-6, 1e-4);
    d = fw_effects_air_slide(&thin, &disc, 2e-6);
    assert_relative(d.force_Ns_per_m, beat * disc.area_m2, 1e-4);
    /* at room pressure Kn = 0.0325 takes 6 % */
    fw_effects_gas room = gas_at((double)NAN);
    d = fw_effects_air_slide(&room, &disc, 2e-6);
    assert_relative(d.force_Ns_per_m, mu * disc.area_m2 / 2e-6 / 1.065, 1e-3);
}

/* ---- the effect on a mechanism ---- */

typedef struct stand {
    fw_arena *arena;
    fw_diags diags;
    fw_mechanism_mass body[2];
    fw_mechanism_shape shape[2];
    fw_mechanism m;
    fw_mechanism_variant variant;
    fw_device_air air[3];
    fw_device_scene scene;
    fw_effect_ledger ledger;
    fw_effects_loads loads;
} stand;

static void stand_new(stand *s) {
    memset(s, 0, sizeof *s);
    s->arena = fw_arena_new(0);
    s->diags = fw_diags_new(s->arena);
    s->body[0] = (fw_mechanism_mass){"a", 1e-8, 1e-16, 1e-4, 2e-4, 0.4, {0, 0}};
    s->body[1] = (fw_mechanism_mass){"b", 1e-8, 1e-16, -3e-4, 5e-5, -1.1, {0, 0}};
    s->shape[0] = (fw_mechanism_shape){1e-8, 4e-17, 5e-4, {0, 0}, {0, 0}};
    s->shape[1] = (fw_mechanism_shape){3e-8, 2e-16, 9e-4, {0, 0}, {0, 0}};
    s->m = (fw_mechanism){.body = s->body, .shape = s->shape, .nbody = 2, .variant = &s->variant};
    s->variant.thickness_m = 15e-6;
    s->scene = (fw_device_scene){.name = "s", .duration_s = 1e-3, .air = s->air};
}

static fw_status compile(stand *s) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    return fw_effects_compile(s->arena, &s->m, &s->scene, &choice, 1e-3, &s->diags, &s->ledger,
                              &s->loads);
}

/* film between body a and body b, as drawn at the gap */
static void squeeze_of(stand *s, int against) {
    s->air[0] = any_air(FW_AIR_SQUEEZE);
    s->air[0].body = 0, s->air[0].against = against;
    s->air[0].x_m = 4e-5, s->air[0].y_m = -2e-5, s->air[0].direction_rad = 0.8;
    s->scene.nair = 1;
    assert_int_equal(compile(s), FW_OK);
    assert_int_equal(s->loads.nelement, 1);
}

static void every_class(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        stand s;
        stand_new(&s);
        uint64_t seed = 77u + (unsigned)kind;
        s.air[0] = any_air((fw_device_air_kind)kind);
        s.scene.nair = 1;
        if (kind == FW_AIR_SQUEEZE)
            squeeze_of(&s, 1);
        else
            assert_int_equal(compile(&s), FW_OK);
        for (int round = 0; round < 50; round++) {
            double q[6], v[6], p[6], w[6];
            const fw_effects_force_element *e = &s.loads.element[0];
            for (int i = 0; i < 6; i++)
                v[i] = number(&seed) * (i % 3 == 2 ? 300 : 1e-2);
            for (int b = 0; b < 2; b++) {
                q[3 * b] = s.body[b].x_m + 2e-7 * number(&seed);
                q[3 * b + 1] = s.body[b].y_m + 2e-7 * number(&seed);
                q[3 * b + 2] = s.body[b].phi_rad + 1e-3 * number(&seed);
            }
            fw_effects_element_place_ports(e, q, v, p, w);
            for (int i = 0; i < 3 && e->ports == 2; i++) /* the plane may move too */
                if (e->port[1].body == FW_GROUND) w[3 + i] = v[i] * number(&seed);
            const fw_effects_port_state seen = {.load = 1, .p = p, .w = w};
            fw_check_tangent(e, &seen, 5e-9, 1e-4, 1e-7);
            fw_check_power(e, &seen, 1e-7, 1e-9);
            if (kind != FW_AIR_DRAG) fw_check_balance(e, &seen, 1e-9);
        }
        fw_arena_free(s.arena);
    }
}

/* the film knows its gap: as drawn, moved along the normal, and turned */
static double complex
imaginary(double y) { /* I is a float of some compilers, and others have no CMPLX */
    double complex z = 0;
    ((double *)&z)[1] = y;
    return z;
}

/* K/(p a b/g) of lap u = i s (u + 1), u = 0 around, on n x m cells of width h: -(mean of u); successive over-relaxation */
static double complex compressed_by_differences(int n, int m, double h, double s) {
    static double complex u[141 * 41];
    memset(u, 0, sizeof u);
    const int w = m + 1;
    double complex sum = 0;
    for (int sweep = 0; sweep < 4000; sweep++)
        for (int i = 1; i < n; i++)
            for (int j = 1; j < m; j++) {
                const double complex around =
                    u[(i - 1) * w + j] + u[(i + 1) * w + j] + u[i * w + j - 1] + u[i * w + j + 1];
                u[i * w + j] +=
                    1.6 *
                    ((around - imaginary(s * h * h)) / (4 + imaginary(s * h * h)) - u[i * w + j]);
            }
    for (int i = 1; i < n; i++)
        for (int j = 1; j < m; j++)
            sum += u[i * w + j];
    return -sum / ((double)n * m);
}

/* spring and loss of a film 0.7 x 0.2 mm of 1 um against differences, at squeeze numbers 0.1 to 50 of its shorter side; the
   damper alone is the low end, and the trapped gas the high one */
static void compressed_film(void **state) {
    (void)state;
    const double number[] = {0.1, 1, 10, 50}, a = 0.7e-3, b = 0.2e-3, g = 1e-6;
    const fw_effects_gas gas = gas_at((double)NAN);
    const fw_effects_squeeze film = fw_effects_air_squeeze(&gas, a, b, g);
    const double c = fw_effects_squeeze_at(&film, g, NULL), whole = gas.pressure_Pa * a * b / g,
                 mu = gas.viscosity_Pas / (1 + 9.638 * pow(gas.path_m / g, 1.159));
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        const double s = number[i] / (b * b), w = s * gas.pressure_Pa * g * g / (12 * mu);
        double k[2];
        const double lacks = fw_effects_squeeze_lacks_N_per_m(&gas, a, b, g, w, k);
        const double complex want = whole * compressed_by_differences(140, 40, b / 40, s);
        assert_relative(k[0], creal(want), 0.03);
        assert_relative(k[1], cimag(want), 0.04);
        assert_relative(lacks, cabs(want - imaginary(w * c)), number[i] < 1 ? 0.1 : 0.03);
    }
    double k[2];
    fw_effects_squeeze_lacks_N_per_m(&gas, a, b, g, 1, k);
    assert_relative(k[1], c, 0.02);
    fw_effects_squeeze_lacks_N_per_m(&gas, a, b, g, 1e12, k);
    assert_relative(k[0], whole, 0.04);
}

static void squeeze_gap(void **state) {
    (void)state;
    for (int against = -1; against < 2; against += 2) {
        stand s;
        stand_new(&s);
        squeeze_of(&s, against);
        const fw_effects_force_element *e = &s.loads.element[0];
        const fw_device_air *a = &s.air[0];
        const double out = a->direction_rad + s.body[0].phi_rad;
        const fw_effects_gas gas = fw_effects_gas_of(a);
        const fw_effects_squeeze film =
            fw_effects_air_squeeze(&gas, a->length_m, a->depth_m, a->gap_m);
        for (int i = 0; i < 3; i++) {
            double by = 0.5e-6 * i, p[6], w[6], f[6], q[6], v[6] = {0};
            for (int b = 0; b < 2; b++)
                q[3 * b] = s.body[b].x_m, q[3 * b + 1] = s.body[b].y_m,
                      q[3 * b + 2] = s.body[b].phi_rad;
            q[0] += by * cos(out) - 3e-6 * sin(out), q[1] += by * sin(out) + 3e-6 * cos(out);
            v[0] = 0.01 * cos(out) - 0.3 * sin(out), v[1] = 0.01 * sin(out) + 0.3 * cos(out);
            fw_effects_element_place_ports(e, q, v, p, w);
            const fw_effects_port_state seen = {.load = 1, .p = p, .w = w};
            const char *why = NULL;
            e->class_->force(e, &seen, f);
            double want = fw_effects_squeeze_at(&film, a->gap_m - by, NULL) * 0.01;
            assert_relative(f[0], -want * cos(out), 1e-9);
            assert_relative(f[1], -want * sin(out), 1e-9);
            assert_true(e->class_->valid(e, &seen, &why));
            q[0] += 2e-6 * cos(out), q[1] += 2e-6 * sin(out); /* through the wall */
            fw_effects_element_place_ports(e, q, v, p, w);
            if (i > 0) assert_false(e->class_->valid(e, &seen, &why));
            if (i > 0) assert_non_null(strstr(why, "touch"));
        }
        fw_arena_free(s.arena);
    }
}

/* a free wall that is thrown at another one stops where m v0 = (C/2) (1/g^2 - 1/g0^2), C = c g^3,
   without rarefaction: the motion of m g'' = -c(g) g' by Runge and Kutta */
static void film_stops_a_wall(void **state) {
    (void)state;
    stand s;
    stand_new(&s);
    squeeze_of(&s, FW_GROUND);
    fw_effects_squeeze *film = (fw_effects_squeeze *)(uintptr_t)s.loads.element[0].data;
    film->path_m = 0;
    const double out = s.air[0].direction_rad + s.body[0].phi_rad, m = 1e-8, g0 = 2e-6;
    double x = 0, c = film->c0_Nsm2, v0 = c / (2 * m) * (1 / (1e-6 * 1e-6) - 1 / (g0 * g0)), u = v0;
    const double dt = 2e-3 * g0 / v0;
    for (int step = 0; step < 20000; step++) {
        double k[4][2] = {{0}}, part[4] = {0, 0.5, 0.5, 1};
        for (int i = 0; i < 4; i++) {
            double at = x + (i ? part[i] * dt * k[i - 1][0] : 0);
            double speed = u + (i ? part[i] * dt * k[i - 1][1] : 0), p[6], w[6], f[6];
            double q[6] = {s.body[0].x_m + at * cos(out), s.body[0].y_m + at * sin(out),
                           s.body[0].phi_rad};
            const double v[6] = {speed * cos(out), speed * sin(out), 0};
            fw_effects_element_place_ports(&s.loads.element[0], q, v, p, w);
            const fw_effects_port_state seen = {.load = 1, .p = p, .w = w};
            s.loads.element[0].class_->force(&s.loads.element[0], &seen, f);
            k[i][0] = speed, k[i][1] = (f[0] * cos(out) + f[1] * sin(out)) / m;
        }
        x += dt / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
        u += dt / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
    }
    assert_near(g0 - x, 1e-6, 1e-13);
    assert_near(u, 0, 1e-9 * v0);
    fw_arena_free(s.arena);
}

static void bodies_and_areas(void **state) {
    (void)state;
    stand s;
    stand_new(&s);
    s.air[0] = any_air(FW_AIR_SLIDE); /* all bodies */
    s.air[1] = any_air(FW_AIR_DRAG);
    s.air[1].body = 1;
    s.air[1].area_m2 = 12e-8; /* twice the size of what is drawn */
    s.scene.nair = 2;
    assert_int_equal(compile(&s), FW_OK);
    assert_int_equal(s.loads.nelement, 3);
    assert_true(s.loads.element[0].port[0].body == 0 && s.loads.element[1].port[0].body == 1);
    assert_true(s.loads.element[1].port[1].body == FW_GROUND && s.loads.element[2].ports == 1);
    for (int i = 0; i < 3; i++)
        assert_true(s.loads.element[i].dissipates && !s.loads.element[i].works);
    fw_effects_face f = fw_effects_air_face(&s.m, &s.air[1], 1);
    assert_relative(f.perimeter_m, 18e-4, 1e-14);
    assert_relative(f.polar_m4, 16 * 2e-16, 1e-14);
    s.m.shape = NULL; /* nothing is drawn: the film over all bodies has no area */
    assert_int_equal(compile(&s), FW_INPUT);
    assert_int_equal(s.diags.item[0].number, 253);
    s.air[0] = any_air(FW_AIR_SLIDE);
    s.air[0].area_m2 = 1e-8;
    assert_int_equal(compile(&s), FW_OK);
    f = fw_effects_air_face(&s.m, &s.air[0], 0);
    assert_relative(f.polar_m4, 1e-16 / (2 * pi), 1e-14); /* the disc of this area */
    s.air[0] = any_air(FW_AIR_SQUEEZE);
    s.air[0].body = 0, s.air[0].depth_m = (double)NAN;
    assert_relative(fw_effects_air_depth(&s.m, &s.air[0]), 15e-6, 1e-15);
    s.m.variant = NULL;
    assert_int_equal(compile(&s), FW_INPUT);
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_air),       cmocka_unit_test(rectangle_integral),
        cmocka_unit_test(squeeze_coefficient), cmocka_unit_test(limits_of_dampers),
        cmocka_unit_test(every_class),         cmocka_unit_test(squeeze_gap),
        cmocka_unit_test(film_stops_a_wall),   cmocka_unit_test(bodies_and_areas),
        cmocka_unit_test(compressed_film),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
