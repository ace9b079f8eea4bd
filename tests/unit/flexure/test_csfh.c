/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed form of arcs against its formulas written down plainly in long double and by the
   library's functions. */
#include "flexure/flexure.h"
#include "flexure/section.h"
#include "test.h"
#include <stdlib.h>
#include <string.h>

static uint64_t seed = 88172645463325252u;

static double uniform(double low, double high) { /* xorshift */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

static double spread(double low, double high) {
    return low * pow(high / low, uniform(0, 1));
}

/* |a - b| below `part` of b, or below `least` */
static void compare(const char *what, double is, long double plain, double part,
                    long double least) {
    long double off = fabsl((long double)is - plain);
    if (off <= (long double)part * fabsl(plain) || off <= least) return;
    fail_msg("%s = %.17g, plainly %.17Lg, off by %.2Lg of it", what, is, plain, off / fabsl(plain));
}
#define agrees(is, plain, part, least) compare(#is, is, plain, part, least)

typedef struct plain {
    long double K, thin, D, Kt, strain, fit, limit, W, dL;
    long double C[3], terms[3]; /* of the sums: the absolute values of what is added */
    long double error[4], centre_error;
    long double beyond; /* of the error of the strain, beside what doubles */
    long double less;   /* of its lower end, of deep and of short strips, and of thick arcs */
    long double taken;  /* of its upper end, of thick arcs with wide fillets */
} plain;

typedef struct plain_depth {
    long double D, inner, outer, f;
} plain_depth;

/* theory, eq. 8 to 10, with the hyperbolic functions */
static plain_depth depth_of(long double deep, long double nu) {
    long double root = sqrtl(3 * (1 - nu * nu)), x = deep * sqrtl(root), X = x / 2;
    long double s = sinl(X), c = cosl(X), sh = sinhl(X), ch = coshl(X), N = s * c + sh * ch;
    long double f = 2 / x * (coshl(x) - cosl(x)) / (sinhl(x) + sinl(x));
    long double C1 = nu / root * (sh * c - ch * s) / N, C2 = nu / root * (ch * s + sh * c) / N;
    return (plain_depth){(1 - nu * nu * f) / (1 - nu * nu), 1 - C1, 1 + C1 * ch * c + C2 * sh * s,
                         f};
}

static long double larger(long double a, long double b) {
    return a > b ? a : b;
}

/* 1 - u/atanh u, whose difference would cancel even here */
static long double off_neutral(long double u) {
    long double sum = 0;
    for (int n = 40; n > 0; n--)
        sum += powl(u, 2 * n) / (2 * n + 1);
    return sum * u / atanhl(u);
}

/* theory, eq. 1 to 7 */
static plain form_of(const fw_flexure_input *in) {
    long double r = (long double)in->radius_m, a = (long double)in->angle_rad / 2;
    long double t = (long double)in->width_m;
    long double h = (long double)in->depth_m, E = (long double)in->youngs_Pa;
    long double nu = (long double)in->poisson, L = 2 * a * r, u = t / 2 / r;
    long double s = sinl(a), c = cosl(a), e = r * off_neutral(u), rn = r - e, A = h * t;
    long double q = larger(0.05L, (long double)in->fillet_m / t);
    if (q > 2) q = 2;
    bool ideal = in->fillet_m < 0;
    plain p = {.dL = ideal ? 0 : t * (0.4192L - 0.5972L * q - 0.1167L * q * q)};
    long double whole = L + 2 * p.dL, I = h * t * t * t / 12;
    plain_depth d = depth_of(h / sqrtl(r * t), nu);
    long double kt = ideal ? 1 : 0.944L + 0.2113L * powl(q, -2 / 3.0L);
    long double peak = larger((1 + t / 3 / r) * d.inner, (1 - t / 3 / r) * d.outer);
    p.D = d.D, p.thin = E * I / L;
    p.K = E * I * d.D * (1 - 2 * u * u / 15 - u * u * u * u / 21) / whole;
    p.W = (L * rn * s / a + 2 * p.dL * r * c) / whole;
    p.fit = t / 2 / whole * kt * peak;
    /* the sums of G are held to solids in test_root_strain.c */
    const fw_flexure_root_case root = {.width_m = in->width_m,
                                       .fillet_m = in->fillet_m,
                                       .depth_m = in->depth_m,
                                       .curved = in->width_m / (3 * in->radius_m),
                                       .poisson = in->poisson,
                                       .bow = (double)d.f,
                                       .end = 1};
    long double at_root = (long double)fw_flexure_root_peak(&root, NULL);
    p.Kt = ideal ? peak : larger(peak, at_root);
    long double l = h * d.f * sqrtl(1 / (6 * (1 + nu))), block = ideal ? 0 : 0.4192L * t;
    if (l > L / 3) l = L / 3;
    p.strain = t / 2 / (whole - 2 * nu * nu * d.f * l * l / (l + block)) * p.Kt;
    p.limit = (long double)in->strength_Pa / (long double)in->safety_factor / (E * p.strain);
    long double bend = 1 / (E * A * e * d.D), shear = 2.4L * (1 + nu) * r / (E * A);
    long double end = 2 * p.dL / (E * I * d.D), x = r * c - p.W, y = r * s;
    p.C[0] = 1 / p.K;
    p.C[1] = bend * r * rn * (a - s * c) + end * y * y + shear * (a + s * c);
    p.terms[1] = bend * r * rn * (a + fabsl(s * c)) + fabsl(end) * y * y + shear * 2 * a;
    p.C[2] = bend * rn * (r * (a + s * c) - 4 * p.W * s + 2 * a * p.W * p.W / rn) + end * x * x +
             shear * (a - s * c);
    p.terms[2] = bend * rn * (r * 2 * a + 4 * fabsl(p.W * s) + 2 * a * p.W * p.W / rn) +
                 fabsl(end) * (r * r + p.W * p.W) + shear * 2 * a;

    /* flexure.c */
    long double rho = larger(0, (long double)fmin(in->fillet_m, in->width_m));
    long double thick = larger(0, (long double)fmin(in->fillet_m, 1.25 * in->width_m));
    long double taken = larger(0, thick * thick / (r * r) - 0.0225L);
    long double lost = 0.35L * h * larger(0, 1 - (1 - nu * nu) * d.D) + 0.006L * t +
                       2.3L * (t / r) * (t / r) * thick * thick / t + 80 * taken * taken * t;
    p.taken = t > 0.15L * r ? larger(0, thick * thick / (r * r) - 0.03L) : 0;
    long double off = 2 * lost / L, place = 0.6L * rho * rho, EI = E * I * d.D;
    long double give = ideal ? 0 : 3.2L * t * t * t / 12, X = fabsl(x), Y = fabsl(y);
    p.error[0] = 0.001L + off;
    p.error[1] = 0.002L + (off * L * Y * Y + place * Y * fabsl(c) + give * s * s) / (EI * p.C[1]);
    p.error[2] = 0.002L + (off * L * X * X + place * X * fabsl(s) + give * c * c) / (EI * p.C[2]);
    p.error[3] = 0.011L;
    p.beyond =
        !ideal && ((long double)in->fillet_m < 0.05L * t || in->fillet_m > 1.25 * in->width_m)
            ? 0.10L
        : !ideal && (long double)in->fillet_m < 0.1L * t ? 0.04L
                                                         : 0;
    const long double deep = larger(0, (long double)in->depth_m / t - 10);
    const long double missing = larger(0, 16 - (long double)in->length_m / t);
    p.less = fminl(0.004L * deep, 0.04L) + fminl(missing, 1) * 0.004L +
             fminl(larger(deep, missing) / 2, 1) * 0.05L *
                 larger(0, (long double)in->depth_m / (long double)in->length_m - 0.4L) +
             0.15L * larger(0, t / r - 0.15L);
    p.centre_error = off * X + place / L + 2e-4L * r;
    return p;
}

static fw_flexure_input any(int i) {
    double angle = uniform(0.35, 2 * M_PI), t = spread(1e-6, 30e-6), r = t / uniform(0.01, 0.29);
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = r * angle,
                              .angle_rad = angle,
                              .radius_m = r,
                              .width_m = t,
                              .fillet_m =
                                  i % 7 == 0 ? -1 : t * uniform(0.02, r * angle > 30 * t ? 2 : 1),
                              .depth_m = t * spread(0.01, 40),
                              .youngs_Pa = spread(1e9, 5e11),
                              .poisson = uniform(0, 0.45),
                              .strength_Pa = spread(1e7, 1e10),
                              .safety_factor = uniform(1, 4)};
}

/* 1e-14 of each figure; where a sum cancels (short arcs, W of a full turn) of what it adds; of the
   errors, which hold small differences of D, x and 1, 1e-12 */
static void random_hinges(void **state) {
    (void)state;
    for (int i = 0; i < 40000; i++) {
        const fw_flexure_input in = any(i);
        const plain p = form_of(&in);
        fw_flexure_result out;
        fw_flexure_closed_form(&in, &out);
        agrees(out.stiffness_Nm_per_rad, p.K, 1e-14, 0);
        agrees(out.stiffness_thin, p.thin, 1e-14, 0);
        agrees(out.depth_factor, p.D, 1e-14, 0);
        agrees(out.concentration, p.Kt, 1e-14, 0);
        agrees(out.strain_per_rad, p.strain, 1e-14, 0);
        agrees(out.strain_fit_per_rad, p.fit, 1e-14, 0);
        agrees(out.limit_angle_rad, p.limit, 1e-14, 0);
        agrees(out.root_length_m, p.dL, 1e-14, 1e-15L * (long double)in.width_m);
        agrees(out.centre_m, p.W, 1e-14, 2e-15L * (long double)in.radius_m);
        agrees(out.compliance[0][0], p.C[0], 1e-14, 0);
        for (int k = 1; k < 3; k++)
            agrees(out.compliance[k][k], p.C[k], 1e-14, 4e-15L * p.terms[k]);
        agrees(out.kx_N_per_m * out.compliance[1][1], 1, 1e-15, 0);
        agrees(out.ky_N_per_m * out.compliance[2][2], 1, 1e-15, 0);
        double x = in.fillet_m / in.width_m, wide = in.length_m < 8 * in.width_m ? 2 : 1;
        wide *= (x >= 0 && x < 0.05) || x > 1.25 ? 2 : 1;
        wide *= (in.depth_m > 20 * in.width_m ? 2 : 1) * (in.depth_m > in.length_m ? 4 : 1);
        const bool thick = in.width_m > 0.15 * in.radius_m; /* only what forces do is a guess */
        const fw_flexure_error *e = &out.error;
        const long double doubled = (long double)wide, forces = (thick ? 2 : 1) * doubled;
        agrees(e->stiffness, doubled * p.error[0], 1e-12, 0);
        agrees(e->kx, forces * p.error[1], 1e-12, 1e-14L * p.terms[1] / p.C[1]);
        agrees(e->ky, forces * p.error[2], 1e-12, 1e-14L * p.terms[2] / p.C[2]);
        agrees(e->strain, doubled * (wide > 1 ? 0.025L : p.error[3]) + p.beyond + p.less, 1e-14, 0);
        agrees(e->above, doubled * 0.008L + p.beyond + p.taken, 1e-14, 1e-15L);
        agrees(e->centre_m, forces * p.centre_error, 1e-12, 0);
        assert_int_equal(e->outside, wide > 1 || thick);
    }
}

/* (13a): an end is as if there were less strip by d, at l from it; sums with that against those of the
   printed formula, whose ends lose nothing */
static void ends_beside_plain_sums(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        fw_flexure_input in = any(i);
        fw_flexure_result best, was;
        fw_flexure_closed_form(&in, &was);
        in.ends = true;
        fw_flexure_closed_form(&in, &best);
        const long double r = (long double)in.radius_m, a = (long double)in.angle_rad / 2,
                          t = (long double)in.width_m, h = (long double)in.depth_m,
                          nu = (long double)in.poisson, L = 2 * a * r;
        const plain_depth depth = depth_of(h / sqrtl(r * t), nu);
        long double l = h * depth.f * sqrtl(1 / (6 * (1 + nu)));
        if (l > L / 3) l = L / 3;
        long double block = in.fillet_m < 0 ? 0 : 0.4192L * t;
        long double d = nu * nu * depth.f * l * l / (l + block);
        long double was_whole = L + 2 * (long double)was.root_length_m, whole = was_whole - 2 * d;
        agrees(best.stiffness_Nm_per_rad, (long double)was.stiffness_Nm_per_rad * was_whole / whole,
               2e-14, 0);
        agrees(best.strain_per_rad, (long double)was.strain_per_rad, 2e-14, 0);
        agrees(best.root_length_m, (long double)was.root_length_m - d, 1e-13, 1e-15L * t);
        /* mean of (cos b, sin b) over exp(-s/l) from the end inwards */
        long double q = l / r, in_x = r / (1 + q * q) * (cosl(a) + q * sinl(a));
        long double W = (was_whole * (long double)was.centre_m - 2 * d * in_x) / whole;
        agrees(best.centre_m + best.offset_m[0], W, 1e-13, 1e-14L * r);
        assert_near(best.centre_m, was.centre_m, 0); /* where it is drawn */
        assert_near(best.offset_m[1], 0, 1e-13 * in.radius_m);
    }
}

/* the depth factors from the thinnest strip to plane strain, over both seams of their formulas */
static void depth_factors(void **state) {
    (void)state;
    for (int i = 0; i < 40000; i++) {
        double nu = uniform(0, 0.49), deep = i % 3 ? spread(1e-4, 90) : spread(5.8, 7.5);
        const fw_flexure_depth d = fw_flexure_depth_at(deep, nu);
        if (deep < 1e-2) { /* here even long double cancels: plane stress */
            assert_near(d.stiffness, 1, 1e-9);
            continue;
        }
        const plain_depth p = depth_of((long double)deep, (long double)nu);
        agrees(d.stiffness, p.D, 3e-15, 0);
        agrees(d.softness, 1 / p.D, 3e-15, 0);
        agrees(d.inner, p.inner, 3e-15, 0);
        agrees(d.outer, p.outer, 3e-15, 0);
    }
    for (double nu = 0; nu < 0.5; nu += 0.1) { /* and beyond: what is left is 2/x */
        const fw_flexure_depth d = fw_flexure_depth_at(1e4, nu);
        double x = 1e4 * sqrt(sqrt(3 * (1 - nu * nu)));
        assert_relative(d.stiffness, (1 - nu * nu * 2 / x) / (1 - nu * nu), 1e-15);
        assert_near(d.inner, 1, 1e-15);
    }
}

/* a crystal that has no direction */
static void crystal_without_direction(void **state) {
    (void)state;
    for (int i = 0; i < 5000; i++) {
        fw_flexure_input in = any(i);
        fw_flexure_result b, c;
        double nu = in.poisson, E = in.youngs_Pa, lame = E * nu / (1 + nu) / (1 - 2 * nu);
        double G = E / 2 / (1 + nu);
        /* so shallow that the ends of a crystal lose nothing */
        in.depth_m = 1e-18;
        fw_flexure_closed_form(&in, &b);
        in.crystal = fw_flexure_crystal_cubic(lame + 2 * G, lame, G, 0.3);
        fw_flexure_closed_form(&in, &c);
        assert_relative(c.stiffness_Nm_per_rad, b.stiffness_Nm_per_rad, 1e-12);
        assert_relative(c.kx_N_per_m, b.kx_N_per_m, 1e-9);
        assert_relative(c.ky_N_per_m, b.ky_N_per_m, 1e-7);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_beside_plain_sums),
        cmocka_unit_test(depth_factors),
        cmocka_unit_test(random_hinges),
        cmocka_unit_test(crystal_without_direction),
    };
    return cmocka_run_group_tests_name("csfh", tests, NULL, NULL);
}
