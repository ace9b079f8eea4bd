/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Levels of a spread and yield by place against closed forms and quadrature. */
#include "chance/joint.h"
#include "maths/functions.h"
#include "chance_test.h"

/* places of equal areas from the centre outwards, on a spiral, on a wafer of radius 1 m */
enum { PLACES = 60, UNITS = 1000, SEEDS = 150 };
enum { MEMBERS = FW_CHANCE_UNIT_MOST, DIES = UNITS * MEMBERS };
enum { LOT, WAFER, DIE, HINGE, VARIABLES };
static const double sd[VARIABLES] = {0.6, 0.5, 0.4, 0.8};
static const double radial = 1.5,
                    along = -0.7; /* of WAFER: trends are of an input, not of a level */

static void spread_out(fw_chance_place place[PLACES]) {
    for (int i = 0; i < PLACES; i++) {
        double r = sqrt((i + 0.5) / PLACES), phi = 2.399963 * i; /* the golden angle */
        place[i] = (fw_chance_place){.x_m = r * cos(phi), .y_m = r * sin(phi)};
    }
}

static double trend(const fw_chance_place *p) {
    return radial * (p->x_m * p->x_m + p->y_m * p->y_m - 0.5) + along * p->x_m;
}

static double variance_of_places(void) {
    fw_chance_place place[PLACES];
    double sum = 0, square = 0;
    spread_out(place);
    for (int i = 0; i < PLACES; i++)
        sum += trend(&place[i]) / PLACES, square += trend(&place[i]) * trend(&place[i]) / PLACES;
    return square - sum * sum;
}

static void make_joint(fw_chance_joint *joint) {
    static fw_chance_variable v[VARIABLES];
    fw_chance_fault fault;
    for (int k = 0; k < VARIABLES; k++)
        v[k] = (fw_chance_variable){.name = "x",
                                    .level = (fw_chance_level)k,
                                    .distribution = {.kind = FW_CHANCE_NORMAL, .sd = sd[k]}};
    v[WAFER].trend = (fw_chance_trend){.radius_m = 1, .radial = radial, .along_x = along};
    assert_int_equal(fw_chance_joint_new(arena, 2, VARIABLES, v, 0, NULL, joint, &fault), FW_OK);
}

typedef struct dies { /* g: the sum of all, of two hinges the mean */
    double g[DIES], away[DIES];
    size_t place[DIES], unit[DIES];
    fw_chance_place at[PLACES];
} dies;

static void draw(const fw_chance_joint *joint, uint64_t seed, dies *d) {
    fw_chance_nested_order order;
    double u[VARIABLES + 1], x[VARIABLES + 1];
    assert_int_equal(fw_chance_nested_order_new(arena, seed, PLACES, &order), FW_OK);
    spread_out(d->at);
    for (size_t i = 0; i < DIES; i++) {
        fw_chance_place who = {0};
        d->unit[i] = i / MEMBERS;
        fw_chance_nested_member(&order, i / MEMBERS, (int)(i % MEMBERS), &who, &d->place[i]);
        who.x_m = d->at[d->place[i]].x_m, who.y_m = d->at[d->place[i]].y_m;
        fw_chance_nested_draw(joint, seed, &who, (int)(i % MEMBERS), u);
        fw_chance_joint_map(joint, u, NULL, &who, x);
        d->g[i] = x[LOT] + x[WAFER] + x[DIE] + 0.5 * (x[HINGE] + x[HINGE + 1]);
        d->away[i] = sd[LOT] * u[LOT];
    }
}

typedef struct met { /* over all seeds */
    double sum, square;
    int held;
} met;

static void meet(met *m, const fw_chance_share *s, double truth) {
    m->sum += s->value, m->square += s->value * s->value;
    m->held += s->low <= truth && truth <= s->high;
}

/* unbiased within four standard errors, and the interval holds at its level, three deviations of a count below */
static void check(const char *what, const met *m, double truth) {
    double mean = m->sum / SEEDS, error = sqrt(fmax(m->square / SEEDS - mean * mean, 0) / SEEDS);
    if (!(fabs(mean - truth) <= 4 * error + 0.004))
        fail_msg("%s: %g, not %g +- %g", what, mean, truth, error);
    if (m->held < 0.95 * SEEDS - 3 * sqrt(0.95 * 0.05 * SEEDS))
        fail_msg("%s: %d of %d intervals hold %g", what, m->held, SEEDS, truth);
}

static void shares_are_those_of_the_levels(void **state) {
    (void)state;
    fw_chance_joint joint;
    met lot = {0}, wafer = {0}, place = {0}, die = {0}, hinge = {0}, pair = {0};
    met of_lots = {0}, of_wafers = {0};
    double of[VARIABLES], by_place = variance_of_places(), all = by_place;
    for (int k = 0; k < VARIABLES; k++)
        all += of[k] = sd[k] * sd[k] * (k == HINGE ? 0.5 : 1);
    make_joint(&joint);
    dies *d = fw_arena_one(arena, dies);
    assert_non_null(d);
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        fw_chance_nested n;
        draw(&joint, seed, d);
        assert_int_equal(fw_chance_nested_of(UNITS, MEMBERS, d->g, 0.95, &n), FW_OK);
        assert_int_equal(n.units, UNITS);
        meet(&lot, &n.lot, of[LOT] / all), meet(&wafer, &n.wafer, of[WAFER] / all);
        meet(&place, &n.place, by_place / all), meet(&die, &n.die, of[DIE] / all);
        meet(&hinge, &n.hinge, of[HINGE] / all);
        meet(&pair, &n.of_one_wafer, (of[LOT] + of[WAFER]) / all);
        meet(&of_lots, &n.lot_sd, sqrt(of[LOT]));
        meet(&of_wafers, &n.wafer_sd, sqrt(of[LOT] + of[WAFER]));
        assert_near(n.variance, all, 0.5 * all);
        if (n.lot.value > 0 && n.wafer.value > 0 && n.place.value > 0 && n.die.value > 0)
            assert_near(n.lot.value + n.wafer.value + n.place.value + n.die.value + n.hinge.value,
                        1, 1e-12);
    }
    check("lot", &lot, of[LOT] / all), check("wafer", &wafer, of[WAFER] / all);
    /* deviations have intervals that hold as often; a root is less than what it is of, on the mean */
    const double least = 0.95 * SEEDS - 3 * sqrt(0.95 * 0.05 * SEEDS);
    assert_true(of_lots.held >= least && of_wafers.held >= least);
    check("place", &place, by_place / all), check("die", &die, of[DIE] / all);
    check("hinge", &hinge, of[HINGE] / all);
    check("two dies of a wafer", &pair, (of[LOT] + of[WAFER]) / all);
}

/* The share of dies with g < 1: at a place Phi((1 - trend)/sd of all); of a radial trend over the whole wafer the integral
   of that over r^2, by the midpoint rule, which the places of equal area are themselves. */
static void yield_by_place_is_that_of_the_integral(void **state) {
    (void)state;
    fw_chance_joint joint;
    double total = 0;
    for (int k = 0; k < VARIABLES; k++)
        total += sd[k] * sd[k] * (k == HINGE ? 0.5 : 1);
    total = sqrt(total);
    make_joint(&joint);
    dies *d = fw_arena_one(arena, dies);
    double *failed = fw_arena_array(arena, double, DIES), tau[PLACES];
    fw_chance_share yield[PLACES];
    assert_non_null(d);
    int held = 0, counted = 0;
    double off = 0, width = 0, least = 1, most = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        draw(&joint, seed, d);
        double truth = 0, found = 0;
        for (int i = 0; i < DIES; i++)
            failed[i] = d->g[i] >= 1;
        for (int q = 0; q < PLACES; q++)
            tau[q] = trend(&d->at[q]);
        const fw_chance_map map = {.n = DIES,
                                   .places = PLACES,
                                   .trends = 1,
                                   .place = d->place,
                                   .unit = d->unit,
                                   .failed = failed,
                                   .away = d->away,
                                   .sd = &sd[LOT],
                                   .trend = tau};
        assert_int_equal(fw_chance_map_of(arena, &map, 0.95, yield), FW_OK);
        for (int q = 0; q < PLACES; q++) {
            double here = fw_maths_normal_cdf((1 - tau[q]) / total);
            held += yield[q].low <= here && here <= yield[q].high, counted++;
            truth += here / PLACES, found += yield[q].value / PLACES;
            width += yield[q].high - yield[q].low;
            least = fmin(least, here), most = fmax(most, here);
        }
        off += (found - truth) / 20;
    }
    assert_true(least < 0.6 && most > 0.93); /* there is something to be seen on the wafer */
    assert_true(held > 0.9 * counted);
    assert_near(off, 0, 0.008);
    /* a place of its own has 83 dies of 5000, whose interval would be some 0.19 wide */
    assert_true(width / counted < 0.06);
}

/* without a normal part a die tells of its own place alone: what is found there is what was counted */
static void without_a_normal_part_places_are_counted(void **state) {
    (void)state;
    enum { N = 60 };
    double failed[N], away[N] = {0}, none = 0, tau[3] = {0, 1, 2};
    size_t place[N], unit[N], count[3] = {0};
    fw_chance_share yield[3];
    for (size_t i = 0; i < N; i++) {
        place[i] = i % 3, unit[i] = i;
        failed[i] = i % 3 == 0 ? 0 : i % 3 == 1 ? i % 2 == 0 : 1;
        count[place[i]] += failed[i] > 0;
    }
    failed[3] = (double)NAN;
    const fw_chance_map map = {.n = N,
                               .places = 3,
                               .trends = 1,
                               .place = place,
                               .unit = unit,
                               .failed = failed,
                               .away = away,
                               .sd = &none,
                               .trend = tau};
    assert_int_equal(fw_chance_map_of(arena, &map, 0.95, yield), FW_OK);
    for (int q = 0; q < 3; q++)
        assert_near(yield[q].value, 1 - (double)count[q] / 20, 1e-12);
    assert_true(yield[0].low > 0.8 && yield[0].high == 1);
    assert_true(yield[2].high < 0.2 && yield[2].low == 0);
}

static void what_is_not_known_is_left_out(void **state) {
    (void)state;
    double g[12] = {1, 2, 3, 4, 2, (double)NAN, 1, 1, 3, 1, 2, 2};
    fw_chance_nested n;
    assert_int_equal(fw_chance_nested_of(3, 4, g, 0.95, &n), FW_OK);
    assert_int_equal(n.units, 2);
    assert_int_equal(n.left_out, 1);
    assert_near(n.mean, 18.0 / 8, 1e-12);
    assert_int_equal(fw_chance_nested_of(2, 4, g, 0.95, &n), FW_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_those_of_the_levels),
        cmocka_unit_test(yield_by_place_is_that_of_the_integral),
        cmocka_unit_test(without_a_normal_part_places_are_counted),
        cmocka_unit_test(what_is_not_known_is_left_out),
    };
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
