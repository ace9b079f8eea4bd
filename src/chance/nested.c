/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/joint.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <math.h>

/* ---- which dies are looked at ---- */

static fw_status shuffled(fw_arena *arena, uint64_t seed, size_t n, const uint32_t **out) {
    uint32_t *turn = fw_arena_array(arena, uint32_t, n);
    FW_NEED(*out = turn);
    for (size_t i = 0; i < n; i++)
        turn[i] = (uint32_t)i;
    for (size_t i = n; i > 1; i--) {
        const uint32_t counter[4] = {(uint32_t)i, 0, 0, 0};
        size_t k = (size_t)(fw_chance_uniform_at(seed, counter) * (double)i);
        uint32_t last = turn[i - 1];
        k = k < i ? k : i - 1;
        turn[i - 1] = turn[k], turn[k] = last;
    }
    return FW_OK;
}

fw_status fw_chance_nested_order_new(fw_arena *arena, uint64_t seed, size_t places,
                                     fw_chance_nested_order *out) {
    out->places = places;
    for (uint64_t k = 0; k < 3; k++)
        FW_TRY(shuffled(arena, fw_chance_seed(seed, 0x706c61636573u + k), places, &out->turn[k]));
    return FW_OK;
}

void fw_chance_nested_member(const fw_chance_nested_order *order, size_t unit, int member,
                             fw_chance_place *who, size_t *place) {
    static const uint32_t lot[] = {0, 0, 0, 1, 0}, wafer[] = {0, 0, 1, 0, 0},
                          die[] = {0, 1, 0, 0, 0};
    static const int turn[] = {0, 1, 2, 0, 0};
    who->lot = (uint32_t)(2 * unit) + lot[member];
    who->wafer = wafer[member];
    who->die = die[member];
    /* each time round the three orders are shifted against each other, so that no two places always go together */
    size_t round = order->places ? unit / order->places : 0, t = (size_t)turn[member];
    *place = order->places ? order->turn[t][(unit + t * round) % order->places] : 0;
}

void fw_chance_nested_draw(const fw_chance_joint *joint, uint64_t seed, const fw_chance_place *who,
                           int member, double *u) {
    fw_chance_joint_draw(joint, seed, who, u);
    if (member != FW_CHANCE_UNIT_PLAIN) return;
    for (size_t d = 0; d < joint->dimensions; d++) {
        size_t v = joint->u_variable[d];
        const uint32_t counter[4] = {who->lot, who->wafer, who->die + 0x80000000u,
                                     (uint32_t)joint->u_hinge[d]};
        if (joint->variable[v].level == FW_CHANCE_HINGE)
            u[d] = fw_maths_normal_quantile(fw_chance_uniform_at(fw_chance_seed(seed, v), counter));
    }
}

/* ---- shares of the variance ---- */

enum {
    SINGLE,
    SQUARE,
    WAFER,
    LOT,
    PLACE,
    TWIN,
    SUMS
}; /* sums of numbers and of products of pairs */
enum {
    OF_LOT,
    OF_WAFER,
    OF_PLACE,
    OF_DIE,
    OF_HINGE,
    ONE_WAFER,
    SHARES,
    WAFER_PART = SHARES, /* variances themselves: of wafers of all lots, and of lots */
    LOT_PART,
    ANSWERS
};

/* what a unit adds, of numbers less `centre`, which keeps digits */
static void sums_of(const double *g, int members, double centre, double s[SUMS]) {
    double x[FW_CHANCE_UNIT_MOST] = {0};
    for (int k = 0; k < members; k++)
        x[k] = g[k] - centre;
    s[SINGLE] = x[0] + x[1] + x[2] + x[3];
    s[SQUARE] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    s[WAFER] = x[0] * x[1];
    s[LOT] = 0.5 * (x[0] + x[1]) * x[2];
    s[PLACE] = x[0] * x[3];
    s[TWIN] = members > FW_CHANCE_UNIT_PLAIN ? x[0] * x[4] : x[0] * x[0];
}

/* E[x y] of a pair less the square of the mean is a covariance; the mean's own error is taken out to first order, by the
   variance of a mean of n units */
static double answers_of(const double s[SUMS], double n, bool hinges, double answer[ANSWERS]) {
    double mean = s[SINGLE] / (4 * n), square = mean * mean;
    double v = s[SQUARE] / (4 * n) - square;
    double lot = s[LOT] / n - square, wafer = s[WAFER] / n - square, place = s[PLACE] / n - square;
    double part = v > 0 ? 1 / v : 0;
    answer[OF_LOT] = lot * part;
    answer[ONE_WAFER] = wafer * part;
    answer[WAFER_PART] = wafer, answer[LOT_PART] = lot;
    answer[OF_WAFER] = (wafer - lot) * part;
    answer[OF_PLACE] = place * part;
    answer[OF_HINGE] = hinges ? 1 - (s[TWIN] / n - square) * part : 0;
    answer[OF_DIE] = 1 - answer[ONE_WAFER] - answer[OF_PLACE] - answer[OF_HINGE];
    return v;
}

static bool whole(const double *g, int members) {
    for (int k = 0; k < members; k++)
        if (!isfinite(g[k])) return false;
    return true;
}

/* the root of a variance and of the ends of its interval; what is below 0 by chance is 0 */
static fw_chance_share deviation(double variance, double half) {
    return (fw_chance_share){sqrt(fmax(0, variance)), sqrt(fmax(0, variance - half)),
                             sqrt(fmax(0, variance + half))};
}

/* Nested analysis of variance by pairs: Var(E[g | lot]) is the covariance of two dies that share the lot and nothing else,
   Var(E[g | lot, wafer]) that of two dies of one wafer, Var(E[g | place]) that of two dies at one place in two lots, and what
   is not between hinges that of a die and its twin with other hinges. Interval: jackknife over units, normal, within 0 and 1
   (a correlation: -1 and 1). Error of a share: some 1/sqrt(units). Cost: linear. Source: S. Searle, G. Casella, C. McCulloch,
   Variance Components (1992), ch. 3; B. Efron, C. Stein, Ann. Statist. 9 (1981) 586 (jackknife). Test: test_nested.c */
fw_status fw_chance_nested_of(size_t units, int members, const double *g, double level,
                              fw_chance_nested *out) {
    double all[SUMS] = {0}, one[SUMS], rest[SUMS], answer[ANSWERS], without[ANSWERS];
    double sum[ANSWERS] = {0}, square[ANSWERS] = {0}, centre = 0;
    bool hinges = members > FW_CHANCE_UNIT_PLAIN;
    *out = (fw_chance_nested){.units = 0};
    for (size_t i = 0; i < units; i++)
        if (whole(g + i * (size_t)members, members))
            centre += (g[i * (size_t)members] - centre) / (double)++out->units;
    out->left_out = units - out->units;
    if (out->units < 2) return FW_INPUT;
    double n = (double)out->units;
    for (size_t i = 0; i < units; i++) {
        if (!whole(g + i * (size_t)members, members)) continue;
        sums_of(g + i * (size_t)members, members, centre, one);
        for (int k = 0; k < SUMS; k++)
            all[k] += one[k];
    }
    double v = answers_of(all, n, hinges, answer);
    for (size_t i = 0; i < units; i++) {
        if (!whole(g + i * (size_t)members, members)) continue;
        sums_of(g + i * (size_t)members, members, centre, one);
        for (int k = 0; k < SUMS; k++)
            rest[k] = all[k] - one[k];
        answers_of(rest, n - 1, hinges, without);
        for (int k = 0; k < ANSWERS; k++) {
            double d = without[k] - answer[k];
            sum[k] += d, square[k] += d * d;
        }
    }
    double z = fw_maths_normal_quantile(0.5 + 0.5 * level);
    fw_chance_share *to[SHARES] = {
        [OF_LOT] = &out->lot, [OF_WAFER] = &out->wafer, [OF_PLACE] = &out->place,
        [OF_DIE] = &out->die, [OF_HINGE] = &out->hinge, [ONE_WAFER] = &out->of_one_wafer};
    double half[ANSWERS];
    for (int k = 0; k < ANSWERS; k++)
        half[k] = z * sqrt(fmax(0, (n - 1) / n * (square[k] - sum[k] * sum[k] / n)));
    for (int k = 0; k < SHARES; k++) {
        double least = k == ONE_WAFER ? -1 : 0;
        *to[k] = (fw_chance_share){fmin(fmax(answer[k], least), 1),
                                   fmin(fmax(answer[k] - half[k], least), 1),
                                   fmin(fmax(answer[k] + half[k], least), 1)};
    }
    out->of_one_lot = out->lot;
    /* what is taken to be 0, being less by chance, the others do not have */
    double parts =
        out->lot.value + out->wafer.value + out->place.value + out->die.value + out->hinge.value;
    for (int k = 0; k < ONE_WAFER && parts > 1; k++)
        to[k]->value /= parts;
    out->mean = centre + all[SINGLE] / (4 * n);
    out->variance = v;
    out->wafer_sd = deviation(answer[WAFER_PART], half[WAFER_PART]);
    out->lot_sd = deviation(answer[LOT_PART], half[LOT_PART]);
    return FW_OK;
}

/* ---- the map ---- */

/* density at place q over that at its own, of the die i with the inputs that it had */
static double ratio(const fw_chance_map *m, size_t i, size_t q) {
    double sum = 0;
    for (size_t t = 0; t < m->trends; t++) {
        double own = m->trend[m->place[i] * m->trends + t], there = m->trend[q * m->trends + t];
        double away = m->away[i * m->trends + t], sd = m->sd[t], d = away + own - there;
        if (own == there) continue;
        if (!(sd > 0)) return 0;
        sum -= 0.5 * (d - away) * (d + away) / (sd * sd);
    }
    return exp(sum);
}

/* interval of a share that was seen in so many independent trials (Wilson's) */
static fw_chance_share interval(double failed, double trials, double z) {
    double a = z * z / trials, middle = (failed + 0.5 * a) / (1 + a);
    double half = z / (1 + a) * sqrt(failed * (1 - failed) / trials + 0.25 * a / trials);
    return (fw_chance_share){1 - failed, fmax(1 - middle - half, 0), fmin(1 - middle + half, 1)};
}

/* sums over the dies of one unit, into those of all */
typedef struct tally {
    double weight, failed; /* all */
    double w, f;           /* this unit */
    double ww, ff, wf;     /* sums of squares and products over units */
    double square;         /* of single weights */
} tally;

static void close_unit(tally *t) {
    t->ww += t->w * t->w, t->ff += t->f * t->f, t->wf += t->w * t->f;
    t->w = t->f = 0;
}

static fw_chance_share share_at(const fw_chance_map *m, const double *mixture, size_t q, double z) {
    tally t = {0};
    for (size_t i = 0; i < m->n; i++) {
        if (i > 0 && m->unit[i] != m->unit[i - 1]) close_unit(&t);
        if (isnan(m->failed[i])) continue;
        double w = ratio(m, i, q) / mixture[i];
        t.weight += w, t.failed += w * m->failed[i], t.square += w * w;
        t.w += w, t.f += w * m->failed[i];
    }
    close_unit(&t);
    if (!(t.weight > 0)) return (fw_chance_share){(double)NAN, 0, 1};
    double p = t.failed / t.weight;
    double variance = (t.ff - 2 * p * t.wf + p * p * t.ww) / (t.weight * t.weight);
    double trials = p > 0 && p < 1 && variance > 0
                        ? fmin(p * (1 - p) / variance, t.weight * t.weight / t.square)
                        : t.weight * t.weight / t.ww;
    return interval(p, trials, z);
}

/* Every die tells of every place: its inputs would be as likely there as the ratio of the two densities says, and the
   weight of a die for place q is its density at q over that of all places mixed as they were visited (balance heuristic).
   yield(q) = sum w held / sum w. Inputs: `away` normal and independent with sd, of one input each; an input with a trend
   and without a normal part tells only of places with the same trend. Error: the interval is that of as many trials as the
   spread between units says, at most as many as the weights are worth. Cost: n x places exponentials, twice. Source: E. Veach,
   L. Guibas, SIGGRAPH 1995 (mixtures); A. Kong, Tech. Rep. 348, Chicago 1992 (worth of weights); E. Wilson, J. Am. Stat. Assoc.
   22 (1927) 209 (interval). Test: test_nested.c (against quadrature) */
fw_status fw_chance_map_of(fw_arena *arena, const fw_chance_map *map, double level,
                           fw_chance_share *yield) {
    double *visited = fw_arena_array(arena, double, map->places),
           *mixture = fw_arena_array(arena, double, map->n + 1);
    FW_NEED(visited && mixture ? visited : NULL);
    double known = 0, z = fw_maths_normal_quantile(0.5 + 0.5 * level);
    for (size_t i = 0; i < map->n; i++)
        if (!isnan(map->failed[i])) visited[map->place[i]] += 1, known += 1;
    for (size_t i = 0; i < map->n; i++) {
        if (isnan(map->failed[i])) continue;
        for (size_t q = 0; q < map->places; q++)
            if (visited[q] > 0) mixture[i] += visited[q] / known * ratio(map, i, q);
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    }
    for (size_t q = 0; q < map->places; q++)
        yield[q] = share_at(map, mixture, q, z);
    return FW_OK;
}
