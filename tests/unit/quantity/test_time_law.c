/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws: values on both sides of every break, the breaks themselves, the largest value. */
#include "quantity/law_kind.h"
#include "quantity/quantity_law.h"
#include "test.h"

static const double pi = 3.14159265358979323846;
static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_quantity_law expression(const char *text) {
    fw_quantity_expression_error error;
    fw_quantity_program *p;
    if (fw_quantity_program_compile(arena, text, strlen(text), NULL, (fw_quantity_dimension){0}, &p,
                                    &error) != FW_OK)
        fail_msg("%s: %s", text, error.message);
    return (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = p};
}

static void expect(const fw_quantity_law *law, double t, double piece, double f, double d,
                   double dd) {
    double v[3];
    fw_quantity_law_value(law, t, piece, v);
    assert_near(v[0], f, 1e-12 * (1 + fabs(f)));
    assert_near(v[1], d, 1e-12 * (1 + fabs(d)));
    assert_near(v[2], dd, 1e-12 * (1 + fabs(dd)));
}

static void expect_breaks(const fw_quantity_law *law, double end, int n, const double *want,
                          double tol) {
    double t[16];
    assert_int_equal(fw_quantity_law_breaks_of(law, end, t, 16), n);
    for (int i = 0; i < n; i++)
        assert_near(t[i], want[i], tol);
}

static void step(void **state) {
    (void)state;
    const fw_quantity_law law = {.kind = &fw_quantity_law_step, .start_s = 1, .end_s = 3};
    const fw_quantity_law always = {.kind = &fw_quantity_law_step, .end_s = (double)INFINITY};
    expect(&law, 1, 0.5, 0, 0, 0);
    expect(&law, 1, 1, 1, 0, 0);
    expect(&law, 1, 1.5, 1, 0, 0);
    expect(&law, 3, 2.5, 1, 0, 0);
    expect(&law, 3, 3, 0, 0, 0);
    expect_breaks(&law, 10, 2, (const double[]){1, 3}, 0);
    expect_breaks(&law, 3, 1, (const double[]){1}, 0); /* the end itself is none */
    expect_breaks(&always, 10, 0, NULL, 0);
    assert_true(fw_quantity_law_is_constant(&always) && fw_quantity_law_is_constant(NULL));
    assert_false(fw_quantity_law_is_constant(&law));
    assert_true(fw_quantity_law_largest(&law, 0.5) == 0 && fw_quantity_law_largest(&law, 2) == 1);
    assert_true(fw_quantity_law_largest(NULL, 2) == 1);
}

/* held from an instant on it stays what it was, with a break there and none behind */
static void held(void **state) {
    (void)state;
    const fw_quantity_law law = {.kind = &fw_quantity_law_ramp, .start_s = 1, .rise_s = 4};
    const fw_quantity_law *now = fw_quantity_law_hold(arena, &law, 3);
    assert_non_null(now);
    expect(now, 3, 2.9, 0.5, 0.25, 0);
    expect(now, 3, 3.1, 0.5, 0, 0);
    expect(now, 9, 9, 0.5, 0, 0);
    expect_breaks(now, 10, 2, (const double[]){1, 3}, 0);
    expect_breaks(now, 2, 1, (const double[]){1}, 0);
    assert_true(fw_quantity_law_rests(now, 3));
    assert_false(fw_quantity_law_rests(&law, 3));
    assert_true(fw_quantity_law_rests(&law, 5));
    assert_true(fw_quantity_law_rests(NULL, 5));
    assert_null(fw_quantity_law_hold(arena, NULL, 3));
}

static void ramp(void **state) {
    (void)state;
    const fw_quantity_law law = {.kind = &fw_quantity_law_ramp, .start_s = 1, .rise_s = 4};
    expect(&law, 1, 0.5, 0, 0, 0);
    expect(&law, 1, 1.5, 0, 0.25, 0);
    expect(&law, 2, 2, 0.25, 0.25, 0);
    expect(&law, 5, 4, 1, 0.25, 0);
    expect(&law, 5, 6, 1, 0, 0);
    expect_breaks(&law, 10, 2, (const double[]){1, 5}, 0);
    assert_near(fw_quantity_law_largest(&law, 3), 0.5, 1e-15);
    assert_near(fw_quantity_law_largest(&law, 30), 1, 0);
}

static void sine(void **state) {
    (void)state;
    const fw_quantity_law law = {.kind = &fw_quantity_law_sine,
                                 .start_s = 1,
                                 .end_s = 2,
                                 .frequency_Hz = 3,
                                 .phase_rad = 0.5};
    double w = 6 * pi;
    expect(&law, 1, 0.9, 0, 0, 0);
    expect(&law, 1, 1.1, sin(0.5), w * cos(0.5), -w * w * sin(0.5));
    expect(&law, 1.2, 1.2, sin(0.5 + 0.2 * w), w * cos(0.5 + 0.2 * w), -w * w * sin(0.5 + 0.2 * w));
    expect(&law, 2, 1.9, sin(0.5 + w), w * cos(0.5 + w), -w * w * sin(0.5 + w));
    expect(&law, 2, 2, 0, 0, 0);
    expect_breaks(&law, 10, 2, (const double[]){1, 2}, 0);
    assert_near(fw_quantity_law_largest(&law, 10), 1, 0);
    assert_near(fw_quantity_law_largest(&law, 1 + 0.1 / w), sin(0.6),
                1e-12); /* no crest reached yet */
    const fw_quantity_law early = {
        .kind = &fw_quantity_law_sine, .start_s = -1, .end_s = 9, .frequency_Hz = 0.125};
    assert_near(fw_quantity_law_largest(&early, 0.5), sin(2 * pi * 0.125 * 1.5), 1e-12);
}

static void half_sine(void **state) {
    (void)state;
    const fw_quantity_law law = {.kind = &fw_quantity_law_half_sine, .start_s = 1, .rise_s = 0.5};
    double w = pi / 0.5;
    assert_string_equal(fw_quantity_law_name(&law), "half-sine");
    expect(&law, 0.5, 0.5, 0, 0, 0);
    expect(&law, 1, 0.9, 0, 0, 0);
    expect(&law, 1, 1.1, 0, w, 0);
    expect(&law, 1.1, 1.1, sin(0.1 * w), w * cos(0.1 * w), -w * w * sin(0.1 * w));
    expect(&law, 1.4, 1.4, sin(0.4 * w), w * cos(0.4 * w), -w * w * sin(0.4 * w));
    expect(&law, 1.5, 1.4, 0, -w, 0);
    expect(&law, 1.5, 1.5, 0, 0, 0);
    expect_breaks(&law, 10, 2, (const double[]){1, 1.5}, 0);
    expect_breaks(&law, 1.2, 1, (const double[]){1}, 0);
    assert_false(fw_quantity_law_is_constant(&law));
    assert_near(fw_quantity_law_largest(&law, 10), 1, 0);
    assert_near(fw_quantity_law_largest(&law, 1.25), 1, 0);
    assert_near(fw_quantity_law_largest(&law, 1.2), sin(0.2 * w), 1e-15);
    assert_near(fw_quantity_law_largest(&law, 1), 0, 0);
    /* a pulse carries the momentum 2/pi of its peak times its length */
    double sum = 0, v[3];
    for (int i = 0; i < 1000; i++) {
        double t = 1 + 0.5 * (i + 0.5) / 1000;
        fw_quantity_law_value(&law, t, t, v);
        sum += v[0] * 0.5 / 1000;
    }
    assert_near(sum, 2 / pi * 0.5, 1e-6);
}

static void table(void **state) {
    (void)state;
    static const double t[] = {0, 1, 2, 4}, v[] = {0, 0.5, -2, -2};
    const fw_quantity_law law = {
        .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = v, .ntable = 4};
    expect(&law, -1, -1, 0, 0, 0);
    expect(&law, 0, -1, 0, 0, 0);
    expect(&law, 0, 0.5, 0, 0.5, 0);
    expect(&law, 1, 0.5, 0.5, 0.5, 0);
    expect(&law, 1, 1.5, 0.5, -2.5, 0);
    expect(&law, 1.5, 1.5, -0.75, -2.5, 0);
    expect(&law, 4, 5, -2, 0, 0);
    expect_breaks(&law, 10, 3, (const double[]){1, 2, 4}, 0);
    double stored[1];
    assert_int_equal(fw_quantity_law_breaks_of(&law, 10, stored, 1),
                     3); /* told, though not stored */
    assert_near(stored[0], 1, 0);
    assert_near(fw_quantity_law_largest(&law, 1), 0.5, 0);
    assert_near(fw_quantity_law_largest(&law, 1.5), 0.75, 1e-15);
    assert_near(fw_quantity_law_largest(&law, 10), 2, 0);
}

/* switches of abs, min, max are found to round-off, and each side keeps its own branch there */
static void expressions(void **state) {
    (void)state;
    const fw_quantity_law smooth = expression("sin(2*pi*t/(10 ms))");
    expect_breaks(&smooth, 1, 0, NULL, 0);
    assert_near(fw_quantity_law_largest(&smooth, 10e-3), 1, 1e-5);
    const fw_quantity_law bend = expression("abs(t - 0.3 s)/(1 s)");
    expect_breaks(&bend, 1, 1, (const double[]){0.3}, 1e-15);
    expect(&bend, 0.3, 0.2, 0, -1, 0);
    expect(&bend, 0.3, 0.4, 0, 1, 0);
    const fw_quantity_law cut = expression("max(0, min(1, 4*t/(1 s) - 1))");
    expect_breaks(&cut, 1, 2, (const double[]){0.25, 0.5}, 1e-15);
    expect(&cut, 0.25, 0.1, 0, 0, 0);
    expect(&cut, 0.25, 0.3, 0, 4, 0);
    expect(&cut, 0.5, 0.4, 1, 4, 0);
    expect(&cut, 0.5, 0.6, 1, 0, 0);
    /* both bends of a rectified sine per period */
    const fw_quantity_law rectified = expression("abs(sin(2*pi*t/(1 s)))");
    expect_breaks(&rectified, 1.9, 3, (const double[]){0.5, 1, 1.5}, 1e-15);
    double w = 2 * pi;
    expect(&rectified, 0.5, 0.4, 0, -w, 0);
    expect(&rectified, 0.5, 0.6, 0, w, 0);
    /* a thousand of them, no more, however many there are */
    const fw_quantity_law fast = expression("abs(sin(2e6*t/(1 s)))");
    assert_true(fw_quantity_law_breaks_of(&fast, 1, NULL, 0) <= 1000);
    const fw_quantity_law wild = expression("1 s/(t - 0.5 s)");
    assert_true(isinf(fw_quantity_law_largest(&wild, 1)));
    /* bounds from above, a few hundredths wide; of what has a pole there are none */
    const fw_quantity_law slow = expression("(1 - cos(pi*t/(20 ms)))/2");
    const fw_quantity_law_size size = fw_quantity_law_measure(&slow, 20e-3);
    assert_true(size.most >= 1 && size.most < 1.001);
    assert_true(size.slope >= 25 * pi && size.slope < 25.1 * pi);
    assert_true(size.variation >= 1 && size.variation < 1.03);
    const fw_quantity_law_size none = fw_quantity_law_measure(&wild, 1);
    assert_true(isinf(none.most) && isinf(none.slope) && isinf(none.variation));
    const fw_quantity_law_size pulse = fw_quantity_law_measure(&cut, 1);
    assert_true(pulse.most >= 1 && pulse.most < 1.001 && pulse.variation < 1.1);
}

/* What a law does to an oscillator: a step 2; a half sine at rise/period = 0.8101 the top of its shock spectrum, 1.7684
   (closed form: cos at the turning point, sin(2 pi n/(2r + 1)) 2r/(2r - 1)); a sine at resonance N periods long pi N;
   far from it (1 + r)/|1 - r^2| at most, which a long scene comes near; a slow ramp hardly more than itself */
/* closed forms at resonance: of a coordinate q = -(sin wt + wt cos wt)/2, of a square (1 - cos wt)/2 - wt sin wt/4; and what
   is no shake: pulses, ramps, steps, once to and fro */
static void swings(void **state) {
    (void)state;
    const double w = 2 * pi * 1000, period = 1e-3, ever = (double)INFINITY;
    const fw_quantity_law_kind *sine = fw_quantity_law_find("sine"),
                               *ramp = fw_quantity_law_find("ramp"),
                               *half = fw_quantity_law_find("half-sine");
    const fw_quantity_law same = {.kind = sine, .frequency_Hz = 1000, .end_s = ever},
                          slow = {.kind = ramp, .rise_s = 0.1},
                          pulse = {.kind = half, .rise_s = 2e-3},
                          below = {.kind = sine, .frequency_Hz = 500, .end_s = ever};
    for (int n = 4; n <= 64; n *= 4) {
        const double end = n * period;
        assert_near(fw_quantity_law_swing(&same, FW_LAW_OF_COORDINATE, end, w, 0) / (pi * n), 1,
                    0.02);
        assert_near(fw_quantity_law_swing(&below, FW_LAW_SQUARED, end, w, 0) / (0.5 * pi * n), 1,
                    0.12);
        assert_near(fw_quantity_law_swing(&same, FW_LAW_OF_LOAD, end, w, 0) / (pi * n), 1, 0.02);
    }
    assert_true(fw_quantity_law_swing(&slow, FW_LAW_OF_COORDINATE, 0.09, w, 0) <
                1.02 / (0.1 * w) * 2);
    assert_true(fw_quantity_law_goes_to_and_fro(&same, 3 * period));
    assert_true(fw_quantity_law_goes_to_and_fro(&same, 1.5 * period));
    assert_false(fw_quantity_law_goes_to_and_fro(&same, period));
    assert_false(fw_quantity_law_goes_to_and_fro(&slow, 0.2));
    assert_false(fw_quantity_law_goes_to_and_fro(&pulse, 0.2));
    assert_false(fw_quantity_law_goes_to_and_fro(NULL, 0.2));
}

/* the largest of one undamped oscillator from rest, less a share of the first load */
static double swing_of(const fw_quantity_law_load *load, int n, double end_s, double w,
                       double start_per_s, double less) {
    fw_quantity_law_pieces pieces;
    double size[4], by = 1, shares[4] = {less}, most[FW_QUANTITY_LANES];
    fw_quantity_law_row row;
    assert_int_equal(fw_quantity_law_pieces_of(arena, load, n, end_s, &pieces), FW_OK);
    for (int i = 0; i < n; i++)
        size[i] = load[i].size;
    const fw_quantity_law_loads on = {load, n, 0, &pieces};
    fw_quantity_law_oscillator o = {0, start_per_s, size, {0}, {0}};
    for (int l = 0; l < FW_QUANTITY_LANES; l++)
        o.omega_per_s[l] = w, o.scale[l] = 1;
    fw_quantity_law_seen seen = {&by, shares, most, &row, 1, false};
    assert_true(fw_quantity_law_swings_of(&on, &o, 1, &seen) > 0);
    for (int l = 1; l < FW_QUANTITY_LANES; l++)
        assert_true(most[l] == most[0]);
    return most[0];
}

/* the largest of two oscillators, each at w times `own`, by steps of a thousandth of the shorter period (Runge and Kutta), of
   which a row sees q_0 + 2 q_1, less 0.5 f of the last load; behind: how far each is from where it is held */
static double swung_by_steps(const fw_quantity_law *law, double end_s, const double w[2],
                             double damping, const double size[2][2], double scale, bool behind) {
    const double h = 2 * pi / fmax(w[0], w[1]) / 1000;
    double y[4] = {0}, most = 0;
    for (double t = 0; t < end_s; t += h) {
        double k[4][4], value[3], f[2];
        for (int i = 0; i < 4; i++) {
            const double part = i == 0 ? 0 : i == 3 ? 1 : 0.5;
            fw_quantity_law_value(law, t + part * h, t + 0.5 * h, value);
            for (int o = 0; o < 2; o++) {
                const double q = y[2 * o] + part * h * (i ? k[i - 1][2 * o] : 0),
                             v = y[2 * o + 1] + part * h * (i ? k[i - 1][2 * o + 1] : 0);
                f[o] = (scale * size[o][0] + size[o][1]) * value[0];
                k[i][2 * o] = v;
                k[i][2 * o + 1] = w[o] * w[o] * (f[o] - q) - 2 * damping * w[o] * v;
            }
        }
        for (int i = 0; i < 4; i++)
            y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
        const double row = y[0] + 2 * y[2];
        most = fmax(most, fabs(behind ? row - f[0] - 2 * f[1] : row - 0.5 * value[0]));
    }
    return most;
}

/* eight frequencies at a time, two oscillators, sizes that go with the frequency and sizes that do not */
static void swings_side_by_side(void **state) {
    (void)state;
    const fw_quantity_law law = {
        .kind = fw_quantity_law_find("sine"), .frequency_Hz = 300, .start_s = 1e-3, .end_s = 9e-3};
    const fw_quantity_law_load load[2] = {{.law = &law, .size = 1}, {.law = &law, .size = 1}};
    const double size[2][2] = {{1, 0.3}, {-0.4, 0.2}}, by[2] = {1, 2}, less[2] = {0, 0.5},
                 w = 2 * pi * 900, end = 12e-3;
    fw_quantity_law_pieces pieces;
    assert_int_equal(fw_quantity_law_pieces_of(arena, load, 2, end, &pieces), FW_OK);
    for (int d = 0; d < 4; d++) {
        const fw_quantity_law_loads on = {load, 2, 1, &pieces};
        fw_quantity_law_oscillator o[2] = {{0.02 * d, 0, size[0], {0}, {0}},
                                           {0.02 * d, 0, size[1], {0}, {0}}};
        double most[FW_QUANTITY_LANES];
        fw_quantity_law_row row;
        for (int l = 0; l < FW_QUANTITY_LANES; l++)
            for (int k = 0; k < 2; k++)
                o[k].omega_per_s[l] = (k ? 2.7 : 1) * w * (1 + 0.1 * l),
                o[k].scale[l] = 1 / (1 + 0.2 * l);
        fw_quantity_law_seen seen = {by, d % 2 ? NULL : less, most, &row, 1, d % 2 == 1};
        assert_true(fw_quantity_law_swings_of(&on, o, 2, &seen) > 0);
        for (int l = 0; l < FW_QUANTITY_LANES; l++) {
            const double at[2] = {w * (1 + 0.1 * l), 2.7 * w * (1 + 0.1 * l)};
            assert_near(most[l] / swung_by_steps(&law, end, at, 0.02 * d, size, 1 / (1 + 0.2 * l),
                                                 d % 2 == 1),
                        1, 2e-3);
        }
    }
}

/* two pulses of half a period each, n periods apart from start to start: the first leaves pi/2 of what it does at rest, and
   together they leave 2 |cos(pi n)| times that. Steps one after the other ring by 2 |cos(pi n)| about 2 */
static void swings_of_several(void **state) {
    (void)state;
    const double w = 2 * pi * 1000, period = 1e-3;
    for (int i = 0; i < 9; i++) {
        const double n = 20 + i / 8.0, end = 30 * period;
        const fw_quantity_law one = {.kind = fw_quantity_law_find("half-sine"),
                                     .rise_s = 0.5 * period},
                              other = {.kind = one.kind,
                                       .rise_s = 0.5 * period,
                                       .start_s = n * period},
                              late = {.kind = fw_quantity_law_find("step"),
                                      .start_s = n * period,
                                      .end_s = (double)INFINITY},
                              other_way = {.kind = late.kind, .start_s = 0, .end_s = n * period};
        const fw_quantity_law_load pulses[] = {{.law = &one, .size = 3},
                                               {.law = &other, .size = 3}},
                                   steps[] = {{.size = 1}, {.law = &late, .size = 1}};
        const double alone = pi / 2, both = 2 * fabs(cos(pi * n)) * alone;
        const double far = swing_of(pulses, 2, end, w, 0, 0) / 3;
        if (i % 4 == 0) assert_near(far, fmax(alone, both), 0.05);
        assert_true(far > fmax(alone, both) - 0.05 && far < 1.2 * fmax(alone, both) + 0.05);
        assert_near(swing_of(steps, 2, end, w, 0, 0), 2 + 2 * fabs(cos(pi * n)), 1e-3);
        /* what hangs on a table is left behind by a step of 1 as far, and by 2 |sin(pi n)| once that has gone back; where it swings by 1
           from the start on, by what both leave together */
        const fw_quantity_law_load on[] = {{.law = &late, .size = 1, .coordinate = true}},
                                   there[] = {{.law = &other_way, .size = 1, .coordinate = true}};
        assert_true(fw_quantity_law_come_again(
            (fw_quantity_law_load[]){{.law = &one, .size = 1, .coordinate = true}}, 1, end));
        assert_near(swing_of(there, 1, end, w, 0, 1), fmax(1, 2 * fabs(sin(pi * n))), 1e-3);
        assert_near(swing_of(on, 1, end, w, w, 1),
                    fmax(1, hypot(1 - sin(2 * pi * n), cos(2 * pi * n))), 1e-3);
        assert_true(fw_quantity_law_come_again(pulses, 2, end) &&
                    fw_quantity_law_come_again(steps, 2, end));
        assert_false(fw_quantity_law_come_again(pulses, 1, end) ||
                     fw_quantity_law_come_again(steps, 1, end));
        /* loads of one course are one; a voltage acts by its square; a coordinate by how far it goes from its start */
        const fw_quantity_law copy = late;
        const fw_quantity_law_load alike[] = {{.law = &late, .size = 1}, {.law = &copy, .size = 2}},
                                   twice = {.law = &late, .size = 4, .from = 0.5},
                                   half = {.size = 0.5, .squared = true};
        assert_false(fw_quantity_law_come_again(alike, 2, end));
        assert_near(swing_of(&half, 1, end, w, 0, 0), 1, 1e-3);
        assert_near(swing_of(&twice, 1, 10 * period, w, 0, 0), 4, 1e-3); /* -2 at once */
    }
}

static void answers(void **state) {
    (void)state;
    const double w = 2 * pi * 1000, period = 1e-3;
    const fw_quantity_law_kind *half = fw_quantity_law_find("half-sine"),
                               *sine = fw_quantity_law_find("sine"),
                               *ramp = fw_quantity_law_find("ramp");
    assert_near(fw_quantity_law_answer(NULL, 1, w, w), 2, 0);
    double top = 0;
    for (double r = 0.6; r < 1.1; r += 0.05) { /* rise/period: first turn inside the pulse */
        const double x = 2 * r, closed = x / (x - 1) * sin(2 * pi / (x + 1));
        const fw_quantity_law pulse = {.kind = half, .rise_s = r * period};
        const double is = fw_quantity_law_answer(&pulse, 5 * period, w, w);
        assert_in_range((long)(1e4 * is / closed), 9990, 10310);
        top = fmax(top, is);
    }
    assert_in_range((long)(1e3 * top), 1760, 1830);
    for (int n = 4; n <= 64; n *= 4) {
        const fw_quantity_law same = {
            .kind = sine, .frequency_Hz = 1000, .end_s = (double)INFINITY};
        const double is = fw_quantity_law_answer(&same, n * period, w, w);
        assert_in_range((long)(1e4 * is / (pi * n)), 9900, 10310);
        /* a frequency that is known to 4 % has resonance within it */
        assert_true(fw_quantity_law_answer(&same, n * period, 0.98 * w, 1.02 * w) > 0.99 * is);
    }
    /* frequencies so far apart that to try them all would take too long: the bound by jolts, not what a try gives */
    const fw_quantity_law long_one = {
        .kind = sine, .frequency_Hz = 1000, .end_s = (double)INFINITY};
    const double near = fw_quantity_law_answer(&long_one, 128 * period, 0.98 * w, 1.02 * w);
    assert_true(fw_quantity_law_answer(&long_one, 128 * period, 0.5 * w, 1.5 * w) > 1.1 * near);
    for (double r = 0.3; r < 3; r *= 1.7) {
        const fw_quantity_law other = {
            .kind = sine, .frequency_Hz = 1000 * r, .end_s = (double)INFINITY};
        const double bound = (1 + r) / fabs(1 - r * r);
        const double is = fw_quantity_law_answer(&other, 200 * period, w, w);
        assert_true(is <= 1.031 * bound);
        assert_true(is >= 0.9 * bound);
    }
    const fw_quantity_law slow = {.kind = ramp, .rise_s = 1};
    assert_in_range((long)(1e4 * fw_quantity_law_answer(&slow, 2, w, w)), 10000, 10010);
}

static void impulses(void **state) {
    (void)state;
    const fw_quantity_law half = {.kind = fw_quantity_law_find("half-sine"), .rise_s = 2e-5},
                          stays = {.kind = fw_quantity_law_find("ramp"), .rise_s = 1},
                          goes = {.kind = fw_quantity_law_find("sine"),
                                  .frequency_Hz = 1,
                                  .end_s = (double)INFINITY},
                          pulse = {
                              .kind = fw_quantity_law_find("step"), .start_s = 0.25, .end_s = 1};
    const double is = fw_quantity_law_impulse_s(&half, 1e-5); /* behind the scene's end, too */
    assert_true(is >= 4e-5 / pi && is < 1.001 * 4e-5 / pi);
    assert_near(fw_quantity_law_impulse_s(&pulse, 2), 0.75, 1e-12);
    assert_true(isinf(fw_quantity_law_impulse_s(&stays, 2)));
    assert_true(isinf(fw_quantity_law_impulse_s(&goes, 2)));
    assert_true(isinf(fw_quantity_law_impulse_s(NULL, 2)));
}

/* by small steps of what is straight between them, at w, well behind the law's end */
static double followed(const fw_quantity_law *law, double end_s, double w, double low, double *far,
                       double *behind) {
    const int steps = 40000;
    const double h = end_s / steps, c = cos(w * h), s = sin(w * h);
    double q = 0, v = 0, f = 0, most = 0, value[3];
    fw_quantity_law_value(law, 0, 0.5 * h, value);
    f = value[0];
    for (int i = 1; i <= steps; i++) {
        fw_quantity_law_value(law, i * h, (i - 0.5) * h, value);
        const double slope = (value[0] - f) / h, x = q - f, y = (v - slope) / w;
        q = value[0] + x * c + y * s, v = slope + w * (y * c - x * s), f = value[0];
        most = fmax(most, fabs(q)), *behind = fmax(*behind, fabs(q - f));
    }
    *far = fmax(*far, most * low * low / (w * w));
    return most;
}

/* A scene ends with its pulse, or within it: the device rings on as where the scene lasts. Never less than what is there at any
   frequency of the band, and no more than 4 % above the most of it; of a short half sine 2 w rise/pi (1 - (w rise/pi)^2/2), at
   the top of the band, though it goes farthest at the bottom */
static void answers_behind_the_end(void **state) {
    (void)state;
    static const double t_s[] = {0, 0.3e-3, 0.5e-3, 0.8e-3, 1e-3},
                        height[] = {0, 0.7, -0.4, 1, 0.2};
    for (double times = 0.01; times < 40; times *= 2.3) { /* how long, in periods of 1 ms */
        double later[5];
        for (int i = 0; i < 5; i++)
            later[i] = times * t_s[i];
        const double lasts = times * 1e-3;
        const fw_quantity_law laws[] = {
            {.kind = fw_quantity_law_find("half-sine"), .rise_s = lasts},
            {.kind = fw_quantity_law_find("half-sine"),
             .rise_s = 0.7 * lasts,
             .start_s = 0.3 * lasts},
            {.kind = fw_quantity_law_find("ramp"), .rise_s = lasts},
            {.kind = fw_quantity_law_find("step"), .start_s = 0.2 * lasts, .end_s = lasts},
            {.kind = fw_quantity_law_find("table"),
             .table_t_s = later,
             .table_value = height,
             .ntable = 5}};
        for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
            const double low = 2 * pi * 900, high = 2 * pi * 1100;
            double most = 0, far = 0, behind = 0;
            for (int k = 0; k <= 40; k++)
                most = fmax(most, followed(&laws[i], lasts + 1.5e-3, low + (high - low) * k / 40,
                                           low, &far, &behind));
            const fw_quantity_law_response long_one = fw_quantity_law_responds(
                                               &laws[i], lasts + 5e-3, low, high),
                                           ends =
                                               fw_quantity_law_responds(&laws[i], lasts, low, high),
                                           cut = fw_quantity_law_responds(&laws[i], 0.6 * lasts,
                                                                          low, high);
            /* jumps are met there within a step, by 4e-4 of the shortest */
            assert_true(ends.most > 0.999 * most && ends.far > 0.999 * far &&
                        ends.behind > 0.999 * behind);
            assert_true(ends.most < 1.04 * most && ends.far < 1.05 * far &&
                        ends.behind < behind + 0.1 * most);
            assert_near(long_one.most, ends.most, 0.02 * ends.most);
            assert_near(cut.most, ends.most, 1e-9);
            assert_near(fw_quantity_law_answer(&laws[i], lasts, low, high), ends.most, 0);
        }
        const double x = 2 * lasts * 1100; /* w rise/pi */
        if (x < 0.3) {
            const fw_quantity_law_response r =
                fw_quantity_law_responds(&laws[0], lasts, 2 * pi * 900, 2 * pi * 1100);
            assert_near(r.most / (2 * x / (1 - x * x) * cos(0.5 * pi * x)), 1, 0.03);
            assert_true(r.far < 0.85 * r.most);
        }
    }
    /* what begins behind the scene does nothing in it; what repeats stops where the scene ends, and rings on */
    const fw_quantity_law late = {.kind = fw_quantity_law_find("half-sine"),
                                  .rise_s = 1e-3,
                                  .start_s = 2e-3},
                          wave = {.kind = fw_quantity_law_find("sine"),
                                  .frequency_Hz = 100,
                                  .end_s = (double)INFINITY};
    assert_near(fw_quantity_law_answer(&late, 1e-3, 6000, 7000), 0, 0);
    assert_near(fw_quantity_law_done_s(&late, 1e-3), 1e-3, 0);
    assert_near(fw_quantity_law_done_s(&late, 2.1e-3), 3e-3, 1e-15);
    assert_near(fw_quantity_law_done_s(&wave, 1e-3), 1e-3, 0);
    assert_true(fw_quantity_law_answer(&wave, 0.2e-3, 2 * pi * 900, 2 * pi * 1000) > 0.07);
}

/* at rate w: all of a step, 2/(w rise) of a ramp, of a half sine pi/(w rise) (2 + 2) in sum, and of (1 - cos)/2
   by samples what its second derivative adds up to, pi/(w T); a coordinate begins where it is */
static void jolts(void **state) {
    (void)state;
    const double w = 1e4, end = 1;
    const fw_quantity_law step = {.kind = &fw_quantity_law_step, .end_s = (double)INFINITY};
    const fw_quantity_law late = {
        .kind = &fw_quantity_law_step, .start_s = 0.3, .end_s = (double)INFINITY};
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 0.5};
    const fw_quantity_law pulse = {.kind = &fw_quantity_law_half_sine, .rise_s = 0.25};
    assert_near(fw_quantity_law_jolt(NULL, false, end, w), 1, 0);
    assert_near(fw_quantity_law_jolt(&step, false, end, w), 1, 0);
    assert_near(fw_quantity_law_jolt(&late, false, end, w), 1, 0);
    assert_near(fw_quantity_law_jolt(&ramp, false, end, w), 2 * 2 / w, 1e-12);
    assert_near(fw_quantity_law_jolt(&pulse, false, end, w), 4 * pi / 0.25 / w, 1e-9);
    static const double t_s[] = {0, 0.5, 1}, value[] = {2, 2, 3};
    const fw_quantity_law table = {
        .kind = &fw_quantity_law_table, .table_t_s = t_s, .table_value = value, .ntable = 3};
    assert_near(fw_quantity_law_jolt(&table, false, end, w), 2.0 / 3 + 2 / w / 3, 1e-12);
    assert_near(fw_quantity_law_jolt(&table, true, end, w), 2 / w, 1e-12);
}

/* what rings at rate w behind a law that does not jump, against exact steps: never more than is said, and not far below it */
static void rings(void **state) {
    (void)state;
    const double w = 100, end = 1, T = 2 * pi / w;
    const double length[] = {0.1 * T, 0.5 * T, 0.7 * T, T, 3 * T, 10.3 * T};
    double at, largest = 0;
    for (int i = 0; i < 6; i++) {
        const fw_quantity_law pulse = {.kind = &fw_quantity_law_half_sine, .rise_s = length[i]};
        const double said = fw_quantity_law_rings(&pulse, end, w, &at);
        assert_near(at, 0.5 * length[i], 0.02 * length[i]);
        const int steps = 200000;
        double q = 0, v = 0, value[3], most = 0;
        for (int k = 0; k < steps; k++) { /* f of the step's middle, exact for that */
            const double h = end / steps, t_s = (k + 0.5) * h;
            fw_quantity_law_value(&pulse, t_s, t_s, value);
            const double x = q - value[0], y = v / w;
            q = value[0] + x * cos(w * h) + y * sin(w * h);
            v = w * (y * cos(w * h) - x * sin(w * h));
            fw_quantity_law_value(&pulse, (k + 1) * h, t_s, value);
            most = fmax(most, fabs(q - value[0]));
        }
        assert_true(most <= said);
        largest = fmax(largest, most / said);
    }
    assert_true(largest > 0.5);
    const fw_quantity_law late = {
        .kind = &fw_quantity_law_step, .start_s = 0.3, .end_s = (double)INFINITY};
    assert_near(fw_quantity_law_rings(&late, end, w, &at), 0, 0);
    assert_near(fw_quantity_law_rings(NULL, end, w, &at), 0, 0);
}

/* what hangs on a coordinate at rate w, against exact steps: w^2 times how far it is behind is never more than its acceleration and what that is
   said to set ringing; a speed that it begins with is a blow of its own */
static void shakes(void **state) {
    (void)state;
    const double w = 300, end = 1;
    const fw_quantity_law law[] = {
        {.kind = &fw_quantity_law_half_sine, .start_s = 0.1, .rise_s = 0.2},
        {.kind = &fw_quantity_law_sine, .frequency_Hz = 3, .phase_rad = pi / 2, .end_s = 9},
        {.kind = &fw_quantity_law_sine, .frequency_Hz = 20, .phase_rad = pi / 2, .end_s = 9},
    };
    for (int i = 0; i < 3; i++) {
        const fw_quantity_law_shaking s = fw_quantity_law_shakes(&law[i], end, w);
        const double behind = fw_quantity_law_swing(&law[i], FW_LAW_OF_COORDINATE, end, w, 0);
        assert_true(w * w * behind <= s.most * (1 + s.rings) + w * s.blows);
        assert_true(w * w * behind > 0.2 * (s.most + w * s.blows));
        assert_near(s.blows, i == 0 ? 2 * pi / 0.2 : 0, 1e-9 * pi / 0.2);
    }
    const double omega =
        6 *
        pi; /* its acceleration begins at once: a jump of 1, and 4 w T/(2 pi) of its slope, over the rate */
    const fw_quantity_law_shaking s = fw_quantity_law_shakes(&law[1], end, w);
    assert_near(s.most, omega * omega, 1e-6 * omega * omega);
    assert_near(s.rings, 1 + 4 * 3 * omega / w, 0.02);
    assert_near(fw_quantity_law_shakes(&law[1], end, 1e9).rings, 1, 1e-3);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 0.25};
    const fw_quantity_law_shaking straight = fw_quantity_law_shakes(&ramp, end, w);
    assert_near(straight.blows, 8, 1e-12);
    assert_near(straight.most, 0, 0);
}

/* what is said of a law as a whole, before 40001 samples of it: slopes and how they vary, over pieces without a break */
static void sizes_before_samples(void **state) {
    (void)state;
    static const double t_s[] = {-1, 0.5, 0.75, 2, 3}, value[] = {1, 1, 3, -2, 0};
    const fw_quantity_law law[] = {
        {.kind = &fw_quantity_law_table, .table_t_s = t_s, .table_value = value, .ntable = 5},
        {.kind = &fw_quantity_law_ramp, .start_s = 1, .rise_s = 0.25},
        {.kind = &fw_quantity_law_sine, .frequency_Hz = 0.3, .phase_rad = 2.5, .end_s = 9},
        {.kind = &fw_quantity_law_sine,
         .frequency_Hz = 2.1,
         .phase_rad = -7,
         .start_s = 1,
         .end_s = 3.3},
        {.kind = &fw_quantity_law_half_sine, .start_s = 0.5, .rise_s = 2},
    };
    static const double slope[] = {8, 4, 0.6 * pi, 4.2 * pi, 0.5 * pi};
    enum { N = 40001 };
    const double end_s = 4;
    for (size_t l = 0; l < sizeof law / sizeof law[0]; l++) {
        const fw_quantity_law_size size = fw_quantity_law_measure(&law[l], end_s);
        double most = 0, steepest = 0, edge[16] = {0};
        int breaks = fw_quantity_law_breaks_of(&law[l], end_s, edge + 1, 14);
        edge[breaks + 1] = end_s;
        for (int piece = 0; piece <= breaks; piece++) {
            double a_s = edge[piece], h = (edge[piece + 1] - a_s) / (N - 1), bent = 0;
            for (int i = 0; i < N; i++) {
                double v[3];
                fw_quantity_law_value(&law[l], a_s + h * i, a_s + h * (N - 1) / 2, v);
                most = fmax(most, fabs(v[0])), steepest = fmax(steepest, fabs(v[1]));
                bent += h * fabs(v[2]) * (i == 0 || i == N - 1 ? 0.5 : 1);
            }
            if (law[l].kind->slope_variation)
                assert_near(law[l].kind->slope_variation(&law[l], a_s, edge[piece + 1]), bent,
                            1e-6 * (1 + bent));
        }
        assert_true(size.most >= most - 1e-12 && size.slope >= steepest - 1e-12);
        assert_near(size.slope, slope[l], 1e-12);
    }
    /* over any part of a sine, in whatever half of a period it begins and ends */
    for (int i = 0; i < 60; i++) {
        const fw_quantity_law s = {.kind = &fw_quantity_law_sine,
                                   .frequency_Hz = 1,
                                   .phase_rad = 0.37 * i - 11,
                                   .end_s = 9};
        double a_s = 0.013 * i, b_s = a_s + 0.031 * (i + 1), bent = 0, h = (b_s - a_s) / (N - 1);
        for (int k = 0; k < N; k++) {
            double v[3];
            fw_quantity_law_value(&s, a_s + h * k, a_s, v);
            bent += h * fabs(v[2]) * (k == 0 || k == N - 1 ? 0.5 : 1);
        }
        assert_near(s.kind->slope_variation(&s, a_s, b_s), bent, 1e-6 * (1 + bent));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_before_samples),
        cmocka_unit_test(step),
        cmocka_unit_test(held),
        cmocka_unit_test(ramp),
        cmocka_unit_test(sine),
        cmocka_unit_test(half_sine),
        cmocka_unit_test(table),
        cmocka_unit_test(expressions),
        cmocka_unit_test(jolts),
        cmocka_unit_test(rings),
        cmocka_unit_test(shakes),
        cmocka_unit_test(answers),
        cmocka_unit_test(impulses),
        cmocka_unit_test(answers_behind_the_end),
        cmocka_unit_test(swings),
        cmocka_unit_test(swings_of_several),
        cmocka_unit_test(swings_side_by_side),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
