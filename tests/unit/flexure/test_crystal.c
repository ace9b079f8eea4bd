/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Silicon (100) by direction: moduli, sums and elastic centre against integrals, tables of finite
   elements (CalculiX, anisotropic; um, N/m, uN um/rad) and symmetry. */
#include "flexure/finite.h"
#include "flexure/section.h"
#include "test.h"

static const double degree = M_PI / 180, c11 = 165.7e9, c12 = 63.9e9, c44 = 79.6e9;

static fw_flexure_crystal silicon(double axis_deg) {
    return fw_flexure_crystal_cubic(c11, c12, c44, axis_deg * degree);
}

/* of r = 100 um; depth 1 nm: plane stress; no roots */
static fw_flexure_input arc(double angle_deg, double t_um, double axis_deg) {
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = 100e-6 * angle_deg * degree,
                              .angle_rad = angle_deg * degree,
                              .radius_m = 100e-6,
                              .width_m = t_um * 1e-6,
                              .fillet_m = -1,
                              .depth_m = 1e-9,
                              .youngs_Pa = 147.08e9,
                              .poisson = 0.3,
                              .strength_Pa = 1e9,
                              .safety_factor = 1,
                              .crystal = silicon(axis_deg)};
}

static double youngs_Pa(const fw_flexure_crystal *c, double from_100_rad) {
    return 1 / (c->a0_per_Pa + c->a1_per_Pa * cos(4 * from_100_rad));
}

static void moduli_by_direction(void **state) {
    (void)state;
    const fw_flexure_crystal k = silicon(0);
    assert_near(k.a0_per_Pa * 1e12, 6.7991, 5e-5);
    assert_near(k.a1_per_Pa * 1e12, 0.88544, 5e-6);
    assert_near(k.s12_per_Pa * 1e12, -2.1387, 5e-5);
    assert_near(youngs_Pa(&k, 0) * 1e-9, 130.13, 5e-3);
    assert_near(youngs_Pa(&k, 45 * degree) * 1e-9, 169.10, 5e-3);
    assert_near(1e-9 / k.a0_per_Pa, 147.08, 5e-3);
    assert_near(-k.s12_per_Pa * youngs_Pa(&k, 0), 0.278, 5e-4);
    assert_near(-k.s12_per_Pa * youngs_Pa(&k, 45 * degree), 0.362, 5e-4);
    assert_near(-k.s12_per_Pa / k.a0_per_Pa, 0.3146, 5e-5);
    /* the tensor turned by hand: 1/E = S1111 of the turned compliance, 1/G = 4 S1212 */
    double d = (c11 - c12) * (c11 + 2 * c12), s11 = (c11 + c12) / d, s12 = -c12 / d, s44 = 1 / c44;
    for (int i = 0; i < 30; i++) {
        double psi = 0.1 * i, c = cos(psi), s = sin(psi), p = c * c, q = s * s;
        double E = s11 * (p * p + q * q) + (2 * s12 + s44) * p * q;
        double G = 4 * (2 * s11 - 2 * s12) * p * q + s44 * (p - q) * (p - q);
        assert_relative(youngs_Pa(&k, psi), 1 / E, 1e-14);
        assert_relative(k.g0_per_Pa + k.g1_per_Pa * cos(4 * psi), G, 1e-13);
    }
    /* an isotropic body has no direction */
    const fw_flexure_crystal even = fw_flexure_crystal_cubic(3, 1, 1, 0.3);
    assert_near(even.a1_per_Pa, 0, 1e-16);
    assert_relative(1 / even.a0_per_Pa, 2.5, 1e-15); /* E = G (3 lambda + 2 G)/(lambda + G) */
}

/* thin closed form and plane-stress finite elements (t = 8 and 10 um) of ../reference fe_aniso */
static void arcs_match_finite_elements(void **state) {
    (void)state;
    const struct {
        double angle, t, axis, K, wx, wy;      /* thin, closed */
        double fe_K, fe_x, fe_y, fe_kx, fe_ky; /* plane stress; 50 um deep */
    } row[] = {
        {270, 8, 0, 665837.93, 30.271096, 0, 665771.17, 30.25588, 0, 108.99214, 223.156},
        {270, 8, 45, 665837.93, 29.749992, 0, 665980.93, 29.76948, 0, 110.6901, 214.5232},
        {270, 8, 22.5, 665837.93, 30.010544, -1.0422085, 665951.30, 30.02370, -1.0426658, 109.86553,
         218.82677},
        {180, 10, 0, 1950697.05, 63.109263, 0, 1951457.17, 63.09043, 0, 390.089, 1897.4506},
        {180, 10, 45, 1950697.05, 64.214692, 0, 1950396.47, 64.15123, 0, 389.6698, 2189.652},
        {180, 10, 22.5, 1950697.05, 63.661977, 2.2108580, 1951316.97, 63.63233, 2.2124453,
         390.41673, 2033.8594},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_flexure_result o;
        fw_flexure_input in = arc(row[i].angle, row[i].t, row[i].axis);
        fw_flexure_closed_form(&in, &o);
        const double up = 50e-6 / 1e-9, centre = (o.centre_m + o.offset_m[0]) * 1e6;
        assert_relative(o.stiffness_Nm_per_rad * 1e12 * up, row[i].fe_K, 1.2e-3);
        /* the axes turn over the width too, which no beam knows: some (t/r)(a1/a0) t/2 */
        assert_near(centre, row[i].fe_x, 0.005 * row[i].t);
        assert_near(o.offset_m[1] * 1e6, row[i].fe_y, 0.004);
        assert_relative(o.kx_N_per_m * up, row[i].fe_kx, 2.5e-3);
        assert_relative(o.ky_N_per_m * up, row[i].fe_ky, 8e-3);
        assert_relative(o.youngs_Pa, 147.08e9, 1e-4); /* sin 4a = 0: the harmonic mean */

        in = arc(row[i].angle, 1e-4, row[i].axis); /* so thin that nothing else is left */
        in.depth_m = 1e-13;
        fw_flexure_closed_form(&in, &o);
        double thin = pow(row[i].t / 1e-4, 3) * 50e-6 / 1e-13;
        assert_relative(o.stiffness_Nm_per_rad * 1e12 * thin, row[i].K, 2e-8);
        assert_near((o.centre_m + o.offset_m[0]) * 1e6, row[i].wx, 2e-6);
        assert_near(o.offset_m[1] * 1e6, row[i].wy, 2e-6);
    }
}

/* 3-D finite elements with real roots, rho = 4 um, t = 8 um, 50 um: K, centre, kx, ky, peak stress
   (MPa/rad, one mesh each) */
static fw_flexure_input real_root(double axis_deg) {
    fw_flexure_input in = arc(270, 8, axis_deg);
    in.fillet_m = 4e-6, in.depth_m = 50e-6;
    return in;
}

/* by how much W moves when ends that are ideal become blocks with fillets, um */
static void roots_of_silicon(void **state) {
    (void)state;
    const double row[][3] = {
        {0, 30.70372, 30.19221}, {22.5, 30.49768, 30.1172}, {45, 30.26870, 30.02402}};
    for (int i = 0; i < 3; i++) {
        fw_flexure_result real, ideal;
        fw_flexure_input in = real_root(row[i][0]);
        fw_flexure_closed_form(&in, &real);
        in.fillet_m = -1;
        fw_flexure_closed_form(&in, &ideal);
        double moved = real.centre_m + real.offset_m[0] - ideal.centre_m - ideal.offset_m[0];
        assert_near(moved * 1e6, row[i][2] - row[i][1], 0.04);
    }
}

/* W (um) and K (uN um/rad) of solids whose ends keep the section straight: three with roots and six
   with rigid ends by an independent program's meshes, and own ones (half of the arc, quadratic
   bricks; the first is the reference's arc: 0.003 um, 0.01 %). Without what the ends take away W is
   0.2 to 0.8 um and K 0.2 to 1.1 % off; the law knows neither of these W */
static void ends_of_silicon(void **state) {
    (void)state;
    const struct {
        double r, t, angle, rho, h, axis, W, K, off_W, off_K;
    } row[] = {
        {100, 8, 270, 4, 50, 0, 30.1922, 674491.7, 0.07, 1e-3},
        {100, 8, 270, 4, 50, 22.5, 30.1172, 675783.4, 0.07, 1e-3},
        {100, 8, 270, 4, 50, 45, 30.0240, 676954.0, 0.07, 1e-3},
        {100, 8, 270, -1, 50, 0, 30.7037, 677903.1, 0.11, 2e-3},
        {100, 8, 270, -1, 50, 22.5, 30.4977, 678310.4, 0.11, 2e-3},
        {100, 8, 270, -1, 50, 45, 30.2687, 678560.5, 0.11, 2e-3},
        {100, 10, 180, -1, 50, 0, 63.4924, 1986226.7, 0.11, 3e-3},
        {100, 10, 180, -1, 50, 22.5, 64.0199, 1985191.5, 0.11, 3e-3},
        {100, 10, 180, -1, 50, 45, 64.5243, 1983379.9, 0.11, 3e-3},
        {100, 8, 270, 4, 50, 0, 30.1895, 674435.0, 0.07, 1e-3},
        {100, 8, 270, 4, 50, 45, 30.0239, 676914.6, 0.07, 1e-3},
        {100, 10, 180, 5, 50, 45, 63.9325, 1964818.7, 0.07, 2e-3},
        {100, 5, 140, 0.5, 30, 0, 77.4726, 192705.8, 0.07, 1e-3},
        {120, 6, 300, 3, 60, 45, 21.6121, 257067.3, 0.07, 1e-3},
        /* a wide fillet in a thick arc: the root's law too, as for isotropic ones */
        {80, 10, 220, 10, 60, 0, 39.7175, 2481227.0, 0.12, 4e-3},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_flexure_input in = arc(row[i].angle, row[i].t, row[i].axis);
        in.radius_m = row[i].r * 1e-6, in.length_m = in.radius_m * in.angle_rad;
        in.fillet_m = row[i].rho * 1e-6, in.depth_m = row[i].h * 1e-6;
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        assert_near((o.centre_m + o.offset_m[0]) * 1e6, row[i].W, row[i].off_W);
        assert_relative(o.stiffness_Nm_per_rad * 1e12, row[i].K, row[i].off_K);
    }
    /* the moduli behind it, from the stiffnesses: what a strip along [100] loses of 1/E where it is
       held from straining across, and G/E' */
    const fw_flexure_crystal k = silicon(0);
    double held = 1 / (c11 - c12 * c12 / c11); /* e_z = 0, s_y = 0 */
    assert_relative(k.bow_per_Pa, k.a0_per_Pa + k.a1_per_Pa - held, 1e-12);
    double d = (c11 - c12) * (c11 + 2 * c12);
    assert_relative(k.reach, sqrt(c44 / (3 * d / (c11 + c12))), 1e-14);
}

/* the bow that the law's length comes from, by differences: energy (b^2/l^2 + b'^2) over a half
   line, held by a spring of block at the end, is least for what is written there */
static void end_loss_is_the_least_energy(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        double h = 1 + i, reach = 0.3 + 0.05 * i, f = 1 - 0.1 * i, block = i ? 0.3 * i : 0;
        const fw_flexure_crystal k = {.known = true, .reach = reach};
        const fw_flexure_end_loss o = fw_flexure_end_loss_of(&k, h, f, 1e3, block);
        double l = h * reach * f;
        enum { N = 20000 };
        double step = 30 * l / N, b[N + 1], sub[N + 1], sum = 0;
        /* -b'' + b/l^2 = 0, block b'(0) = b(0) - 1, b(far) = 0: Thomas */
        sub[0] = block / (block + step), b[0] = step / (block + step);
        for (int j = 1; j < N; j++) {
            double mid = 2 + step * step / (l * l) - sub[j - 1];
            sub[j] = 1 / mid, b[j] = b[j - 1] / mid;
        }
        b[N] = 0;
        double first = 0;
        for (int j = N - 1; j >= 0; j--) {
            b[j] += sub[j] * b[j + 1];
            sum += (j ? 1 : 0.5) * b[j] * step, first += b[j] * j * step * step;
        }
        assert_relative(o.length_m, f * sum, 3e-3);
        assert_relative(o.reach_m, first / sum, 3e-3);
    }
    /* short strips: no more than a third of them at either end */
    const fw_flexure_crystal k = {.known = true, .reach = 0.4};
    const fw_flexure_end_loss o = fw_flexure_end_loss_of(&k, 100, 1, 30, 0);
    assert_relative(o.length_m, 10, 1e-14);
}

static void peak_stress_of_silicon(void **state) {
    (void)state;
    const struct {
        double axis, K, wx, kx, ky, stress;
    } row[] = {{0, 674491.7, 30.19221, 110.65774, 225.9734, 2023},
               {45, 676953.96, 30.02402, 112.7408, 219.3572, 1737},
               {22.5, 675783.4, 30.1172, 111.71887, 222.67825, 2085}};
    for (size_t i = 0; i < 3; i++) {
        fw_flexure_result o;
        fw_flexure_input in = real_root(row[i].axis);
        fw_flexure_closed_form(&in, &o);
        assert_relative(o.stiffness_Nm_per_rad * 1e12, row[i].K, o.error.stiffness);
        assert_relative(o.stiffness_Nm_per_rad * 1e12, row[i].K, 0.001);
        assert_near((o.centre_m + o.offset_m[0]) * 1e6, row[i].wx, o.error.centre_m * 1e6);
        assert_near(o.offset_m[1] * 1e6, i == 2 ? -1.0344 : 0, 0.015);
        assert_relative(o.kx_N_per_m, row[i].kx, 0.002);
        assert_relative(o.ky_N_per_m, row[i].ky, 0.004);
        /* on the safe side of the finer of two meshes (the coarser one had 2006, 1747, 2089) */
        assert_true(o.stress_per_rad_Pa * 1e-6 > row[i].stress);
        assert_true(o.stress_per_rad_Pa * 1e-6 < 1.024 * row[i].stress);
        assert_relative(o.stress_per_rad_Pa, in.youngs_Pa * o.strain_per_rad, 1e-14);
        assert_relative(o.limit_angle_rad, 1e9 / o.stress_per_rad_Pa, 1e-14);
    }
}

/* mirrored crystal: same numbers, the shift across changes its sign; a quarter turn: no change */
static void symmetries(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        double axis = 4.7 * i;
        fw_flexure_result o, p, q;
        fw_flexure_input in = real_root(axis);
        fw_flexure_closed_form(&in, &o);
        in = real_root(-axis);
        fw_flexure_closed_form(&in, &p);
        in = real_root(axis + 90);
        fw_flexure_closed_form(&in, &q);
        assert_near(p.offset_m[0], o.offset_m[0], 1e-18);
        assert_near(p.offset_m[1], -o.offset_m[1], 1e-18);
        assert_near(p.compliance[1][2], -o.compliance[1][2], 1e-12 * o.compliance[1][1]);
        assert_relative(p.stiffness_Nm_per_rad, o.stiffness_Nm_per_rad, 1e-13);
        assert_relative(p.stress_per_rad_Pa, o.stress_per_rad_Pa, 1e-12);
        assert_relative(q.stress_per_rad_Pa, o.stress_per_rad_Pa, 1e-12);
        assert_relative(q.ky_N_per_m, o.ky_N_per_m, 1e-12);
        /* the worst over all directions holds for each of them */
        in = real_root((double)NAN);
        fw_flexure_closed_form(&in, &p);
        assert_true(p.stress_per_rad_Pa > o.stress_per_rad_Pa * 0.999);
        assert_true(fabs(p.ky_N_per_m / o.ky_N_per_m - 1) < p.error.ky);
        assert_true(hypot(o.offset_m[0], o.offset_m[1]) < p.error.centre_m);
    }
}

/* a crystal that is isotropic is the isotropic closed form, as long as it is so shallow that its
   ends lose nothing: the isotropic one leaves that in its error; a leaf has the modulus of its
   direction */
static void agrees_with_the_isotropic_form(void **state) {
    (void)state;
    fw_flexure_input in = real_root(17);
    in.depth_m = 1e-18;
    fw_flexure_input same = in;
    double E = 150e9, nu = 0.25, d = E / ((1 + nu) * (1 - 2 * nu));
    in.crystal = fw_flexure_crystal_cubic(d * (1 - nu), d * nu, 0.5 * E / (1 + nu), 0.7);
    same.crystal.known = false;
    same.youngs_Pa = in.youngs_Pa = E, same.poisson = nu;
    fw_flexure_result o, p;
    fw_flexure_closed_form(&in, &o);
    fw_flexure_closed_form(&same, &p);
    assert_relative(o.stiffness_Nm_per_rad, p.stiffness_Nm_per_rad, 1e-12);
    assert_relative(o.kx_N_per_m, p.kx_N_per_m, 1e-12);
    assert_relative(o.ky_N_per_m, p.ky_N_per_m, 1e-12);
    assert_relative(o.strain_fit_per_rad, p.strain_fit_per_rad, 1e-12);
    /* stress of a crystal, strain of what is isotropic: apart by plane strain in the middle */
    assert_true(o.strain_per_rad > p.strain_per_rad);
    assert_true(o.strain_per_rad < 1.08 / (1 - nu * nu) * p.strain_per_rad);
    assert_near(o.offset_m[0], 0, 1e-18);
    in.depth_m = same.depth_m = 50e-6; /* by sums about the middle of each loss */
    fw_flexure_closed_form(&in, &o);
    fw_flexure_closed_form(&same, &p);
    const fw_flexure_depth deep = fw_flexure_depth_factors(in.radius_m, in.width_m, in.depth_m, nu);
    double l = in.depth_m * deep.bow / sqrt(6 * (1 + nu)), q = l / in.radius_m, a = 0.75 * M_PI;
    double loss = nu * nu * deep.bow * l * l / (l + 0.4192 * in.width_m);
    double whole = in.length_m + 2 * p.root_length_m, place = (cos(a) + q * sin(a)) / (1 + q * q);
    assert_relative(o.stiffness_Nm_per_rad / p.stiffness_Nm_per_rad, whole / (whole - 2 * loss),
                    1e-12);
    assert_near(o.offset_m[0], (p.centre_m - in.radius_m * place) * 2 * loss / (whole - 2 * loss),
                1e-17);
    assert_near(o.offset_m[1], 0, 1e-18);
    for (int i = 0; i < 5; i++) {
        double axis = 11.0 * i;
        in = real_root(axis), in.depth_m = 1e-18, same = in;
        in.kind = same.kind = FW_FLEXURE_LEAF;
        in.fillet_m = same.fillet_m = -1;
        same.crystal.known = false;
        same.youngs_Pa = youngs_Pa(&in.crystal, (axis + 90) * degree);
        fw_flexure_closed_form(&in, &o);
        fw_flexure_closed_form(&same, &p);
        assert_relative(o.stiffness_Nm_per_rad, p.stiffness_Nm_per_rad, 1e-13);
        assert_relative(o.ky_N_per_m, p.ky_N_per_m, 1e-13);
        assert_true(o.stress_per_rad_Pa > 0.9 * p.stress_per_rad_Pa);
        assert_true(o.stress_per_rad_Pa < 1.25 * p.stress_per_rad_Pa);
    }
}

static void at_rest(const fw_flexure_input *in, fw_flexure_result *o, double ratio[2]) {
    fw_flexure_hinge_law law;
    fw_flexure_hinge_at at;
    fw_flexure_closed_form(in, o);
    fw_flexure_hinge_law_of(in, o, &law);
    fw_flexure_hinge_law_at(&law, 0, &at);
    ratio[0] = at.kx_N_per_m.value / o->kx_N_per_m;
    ratio[1] = at.ky_N_per_m.value / o->ky_N_per_m;
}

/* at rest the law at finite rotation has the closed form's kx and ky, as near as it has them of an
   isotropic arc (Winkler's thick arc apart, 0.2 %) */
static void law_knows_the_directions(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        fw_flexure_input in = arc(i < 4 ? 180 : 270, 8, 15.0 * (i % 4));
        in.depth_m = 50e-6, in.fillet_m = 5e-6;
        fw_flexure_result o;
        double is[2], of[2];
        at_rest(&in, &o, is);
        in.crystal.known = false;
        at_rest(&in, &o, of);
        for (int k = 0; k < 2; k++) {
            assert_near(is[k], of[k], 2e-4);
            assert_near(is[k], 1, 3e-3);
        }
        /* its shear modulus is not that of 1/a0 and nu; so shallow that its ends lose nothing,
           which lies inside of them, while the law has it at them */
        in.crystal = silicon((double)NAN), in.depth_m = 1e-12;
        fw_flexure_closed_form(&in, &o);
        assert_near(o.uneven_x, 0, 2e-3);
        assert_near(o.uneven_y, 0, 4e-3);
    }
}

/* ---- the same sums written down plainly, in long double and by the library's sines ---- */

static uint64_t seed = 88172645463325252u;

static double uniform(double low, double high) { /* xorshift */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

typedef long double real;
typedef struct sums {
    real w, x, y, xx, xy, yy;
} sums;

/* int (even + odd cos 4(al0 + b)) {1, cos, sin, cos^2, sin cos, sin^2} db, odd cos 4al0, sin 4al0
 */
static sums sums_of(real a, real even, real c, real s) {
    real J[7] = {2 * a};
    for (int n = 1; n < 7; n++)
        J[n] = 2 * sinl(n * a) / n;
    return (sums){.w = even * J[0] + c * J[4],
                  .x = even * J[1] + c * (J[3] + J[5]) / 2,
                  .y = -s * (J[3] - J[5]) / 2,
                  .xx = even * (J[0] + J[2]) / 2 + c * (J[4] / 2 + (J[6] + J[2]) / 4),
                  .xy = -s * (J[2] - J[6]) / 4,
                  .yy = even * (J[0] - J[2]) / 2 + c * (J[4] / 2 - (J[6] + J[2]) / 4)};
}

typedef struct plain_arc {
    real W[2], weight, C[3]; /* centre; r int 1/E + roots; C_xx, C_yy, C_xy times h t */
} plain_arc;

/* theory, eq. 1, 3, 4 with weights that vary, and lost (1/Pa m) at `at`; per_D: 1/D */
static plain_arc plain_of(const fw_flexure_shape *f, const sums *S, const sums *G,
                          const real root[2], real lost, const real at[2], real per_D) {
    real r = (real)f->radius_m, rn = (real)f->neutral_m, e = (real)f->eccentric_m;
    real a = (real)f->half_angle_rad, t = (real)f->width_m, both = root[0] + root[1];
    real x = r * cosl(a), y = r * sinl(a);
    plain_arc p = {.weight = r * S->w + both - 2 * lost};
    p.W[0] = (r * rn * S->x + x * both - 2 * lost * at[0]) / p.weight;
    p.W[1] = (r * rn * S->y + y * (root[1] - root[0])) / p.weight;
    real X = p.W[0], Y = p.W[1], bend = per_D / e, end = 12 / (t * t) * per_D, k = 1.2L * r;
    real low = -y - Y, high = y - Y, ends = root[0] * low + root[1] * high;
    real u = at[0] - X, v = at[1] - Y, w = -at[1] - Y;
    p.C[0] = bend * (r * rn * S->yy - 2 * Y * rn * S->y + Y * Y * S->w) +
             end * (root[0] * low * low + root[1] * high * high - lost * (v * v + w * w)) +
             k * G->xx;
    p.C[1] = bend * (r * rn * S->xx - 2 * X * rn * S->x + X * X * S->w) +
             end * (both * (x - X) * (x - X) - 2 * lost * u * u) + k * G->yy;
    p.C[2] = -bend * (r * rn * S->xy - rn * (X * S->y + Y * S->x) + X * Y * S->w) -
             end * ((x - X) * ends - lost * u * (v + w)) + k * G->xy;
    return p;
}

static void crystals_beside_plain_sums(void **state) {
    (void)state;
    for (int i = 0; i < 4000; i++) {
        double angle = uniform(90, 360), t = uniform(2, 12), axis = uniform(-180, 180);
        fw_flexure_input in = arc(angle, t, axis);
        in.fillet_m = i % 7 ? t * 1e-6 * uniform(0.05, 1) : -1, in.depth_m = uniform(1e-6, 80e-6);
        fw_flexure_result o;
        fw_flexure_shape f;
        fw_flexure_closed_form(&in, &o);
        fw_flexure_shape_of(&in, &f);
        const fw_flexure_crystal *k = &in.crystal;
        real a = (real)angle * (real)degree / 2, four = 4 * (real)axis * (real)degree;
        real c4 = cosl(four), s4 = sinl(four), a0 = (real)k->a0_per_Pa, a1 = (real)k->a1_per_Pa;
        real g1 = (real)k->g1_per_Pa, dL = (real)f.root_length_m, root[2];
        real spare = dL - (real)f.root_block_m, D = (real)o.depth_factor;
        for (int end = 0; end < 2; end++)
            root[end] = dL * a0 + spare * a1 * cosl(four + (end ? 4 : -4) * a);
        const sums S = sums_of(a, a0, a1 * c4, a1 * s4);
        const sums G = sums_of(a, (real)k->g0_per_Pa, g1 * c4, g1 * s4);
        fw_flexure_depth depth = fw_flexure_depth_crystal(
            in.depth_m / sqrt(in.radius_m * in.width_m), k, (double)(2 * a / S.w));
        real r = (real)in.radius_m, s11 = a0 + (real)k->a1_per_Pa, bow = (real)depth.bow;
        real l = (real)in.depth_m * bow * sqrtl(s11 / 3 * (real)c44), q = l / r;
        real s12 = (real)k->s12_per_Pa, one = r / (1 + q * q);
        if (l > 2 * r * a / 3) l = 2 * r * a / 3, q = l / r, one = r / (1 + q * q);
        real lost = s12 * s12 / s11 * bow * l * l / (l + (real)f.root_block_m);
        const real at[2] = {one * (cosl(a) + q * sinl(a)), one * (sinl(a) - q * cosl(a))};
        const real ends[2] = {r * cosl(a), r * sinl(a)};
        assert_relative(o.depth_factor, depth.stiffness, 1e-12);
        real E = 2 * a / S.w, nu = -(real)k->s12_per_Pa * E, mean = (root[0] + root[1]) / 2;
        const sums mS = sums_of(a, 1 / E, 0, 0), mG = sums_of(a, 2 * (1 + nu) / E, 0, 0);
        const plain_arc p = plain_of(&f, &S, &G, root, lost, at, 1 / D);
        const plain_arc m = plain_of(&f, &mS, &mG, (const real[2]){mean, mean}, lost, ends, 1 / D);
        real per = 1 / ((real)in.depth_m * (real)in.width_m);
        assert_relative(o.youngs_Pa, (double)E, 1e-14);
        assert_relative(o.poisson, (double)nu, 1e-14);
        assert_relative(
            o.compliance[0][0],
            (double)(p.weight * 12 * per / (real)(in.width_m * in.width_m) / D / (real)f.golovin),
            1e-13);
        assert_relative(o.kx_N_per_m, (double)(1 / (p.C[0] * per)), 1e-12);
        assert_relative(o.ky_N_per_m, (double)(1 / (p.C[1] * per)), 1e-12);
        assert_near(o.compliance[1][2], (double)(p.C[2] * per), 1e-12 * o.compliance[1][1]);
        assert_near(o.centre_m + o.offset_m[0], (double)p.W[0], (double)(1e-14L * r));
        assert_near(o.offset_m[1], (double)p.W[1], (double)(1e-14L * r));
        assert_near(o.uneven_x, (double)(p.C[0] / m.C[0] - 1), 1e-12);
        assert_near(o.uneven_y, (double)(p.C[1] / m.C[1] - 1), 1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moduli_by_direction),
        cmocka_unit_test(arcs_match_finite_elements),
        cmocka_unit_test(roots_of_silicon),
        cmocka_unit_test(ends_of_silicon),
        cmocka_unit_test(end_loss_is_the_least_energy),
        cmocka_unit_test(peak_stress_of_silicon),
        cmocka_unit_test(symmetries),
        cmocka_unit_test(agrees_with_the_isotropic_form),
        cmocka_unit_test(crystals_beside_plain_sums),
        cmocka_unit_test(law_knows_the_directions),
    };
    return cmocka_run_group_tests_name("crystal", tests, NULL, NULL);
}
