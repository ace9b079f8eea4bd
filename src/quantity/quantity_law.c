/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions about a law, put to its row, and what holds where the row does not say. */
#include "quantity/law_kind.h"
#include "base/constants.h"
#include "base/sort.h"
#include <math.h>
#include <string.h>

#define FW_LAW(name) &fw_quantity_law_##name,
const fw_quantity_law_kind *const fw_quantity_law_kinds[] = {
#include "quantity/laws.def"
    NULL};
#undef FW_LAW

const fw_quantity_law_kind *fw_quantity_law_find(const char *name) {
    const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds;
    while (*kind && strcmp((*kind)->name, name) != 0)
        kind++;
    return *kind;
}

double fw_quantity_law_number(const fw_quantity_law *law,
                              const fw_quantity_law_attribute *attribute) {
    double value;
    memcpy(&value, (const char *)law + attribute->offset, sizeof value);
    return value;
}

const char *fw_quantity_law_name(const fw_quantity_law *law) {
    return law->kind->name;
}

void fw_quantity_law_value(const fw_quantity_law *law, double t_s, double piece_s,
                           double value[3]) {
    law->kind->value(law, t_s, piece_s, value);
}

int fw_quantity_law_breaks_of(const fw_quantity_law *law, double end_s, double *t_s, int most) {
    fw_quantity_law_breaks b = {end_s, t_s, most, 0};
    if (law && law->kind->breaks) law->kind->breaks(law, &b);
    return b.count;
}

/* ---- size ---- */

enum { SAMPLES = 2000 };

static double largest_sampled(const fw_quantity_law *law, double end_s) {
    double most = 0, value[3];
    for (int i = 0; i <= SAMPLES; i++) {
        double t_s = end_s * i / SAMPLES;
        fw_quantity_law_value(law, t_s, t_s, value);
        if (!isfinite(value[0])) return (double)INFINITY;
        most = fmax(most, fabs(value[0]));
    }
    return most;
}

double fw_quantity_law_largest(const fw_quantity_law *law, double end_s) {
    if (!law) return 1;
    return law->kind->largest ? law->kind->largest(law, end_s) : largest_sampled(law, end_s);
}

/* without a row's own bounds: none, since samples would have to stand for a proof */
fw_quantity_law_size fw_quantity_law_measure(const fw_quantity_law *law, double end_s) {
    fw_quantity_law_size size = {.most = 1, .variation = 1};
    if (fw_quantity_law_is_constant(law)) return size;
    size.most = size.slope = size.variation = (double)INFINITY;
    if (!law->kind->size) return size;
    size = (fw_quantity_law_size){.most = fw_quantity_law_largest(law, end_s)};
    law->kind->size(law, end_s, &size);
    return size;
}

/* total variation of the slope between two breaks */
static double slope_varies(const fw_quantity_law *law, double a, double b, double end_s) {
    double sum = 0, value[3], count = fmax(8, ceil(256 * (b - a) / end_s));
    if (law->kind->slope_variation) return law->kind->slope_variation(law, a, b);
    if (fw_quantity_law_is_straight(law)) return 0;
    for (double i = 0; i < count; i++) {
        fw_quantity_law_value(law, a + (b - a) * (i + 0.5) / count, 0.5 * (a + b), value);
        sum += fabs(value[2]);
    }
    return sum * (b - a) / count;
}

enum { JOLTS = 64 }; /* breaks of a law that is looked at piece by piece */

/* Jumps, and over omega those of the slope and its variation between them; *most: the largest value met, from `start`.
   Infinite: more than JOLTS breaks */
static double jolts(const fw_quantity_law *law, bool coordinate, double end_s, double omega_per_s,
                    double *most) {
    double at[JOLTS + 1], now[3], before[3] = {0}, from = 0, jolt = 0;
    int count = fw_quantity_law_breaks_of(law, end_s, at, JOLTS);
    *most = 0;
    if (count > JOLTS) return (double)INFINITY; /* so many corners: nothing slow */
    fw_sort_doubles(at, (size_t)count);
    at[count] = end_s;
    fw_quantity_law_value(law, 0, 0.5 * at[0], now);
    const double start = coordinate ? now[0] : 0;
    before[0] = start;
    for (int i = 0; i <= count; i++) {
        double piece = 0.5 * (from + at[i]);
        if (!(at[i] > from)) continue;
        fw_quantity_law_value(law, from, piece, now);
        jolt += fabs(now[0] - before[0]) + fabs(now[1] - before[1]) / omega_per_s;
        jolt += slope_varies(law, from, at[i], end_s) / omega_per_s;
        fw_quantity_law_value(law, piece, piece, before);
        *most = fmax(*most, fmax(fabs(now[0] - start), fabs(before[0] - start)));
        fw_quantity_law_value(law, at[i], piece, before);
        *most = fmax(*most, fabs(before[0] - start));
        from = at[i];
    }
    return jolt;
}

double fw_quantity_law_jolt(const fw_quantity_law *law, bool coordinate, double end_s,
                            double omega_per_s) {
    double most;
    if (fw_quantity_law_is_constant(law)) return 1;
    const double jolt = jolts(law, coordinate, end_s, omega_per_s, &most);
    return isfinite(jolt) && jolt < most ? jolt / most : jolt > 0 ? 1 : 0;
}

enum { PER_PIECE = 64 }; /* places of a piece that are looked at */

/* how far the law goes from its first value at most, and when */
static double furthest(const fw_quantity_law *law, double end_s, double *at_s) {
    double at[JOLTS + 1], value[3], most = 0, from = 0;
    int count = fw_quantity_law_breaks_of(law, end_s, at, JOLTS);
    count = count < JOLTS ? count : JOLTS;
    fw_sort_doubles(at, (size_t)count);
    at[count] = end_s;
    fw_quantity_law_value(law, 0, 0.5 * at[0], value);
    const double start = value[0];
    *at_s = 0;
    for (int i = 0; i <= count; from = at[i++])
        for (int k = 0; k <= PER_PIECE; k++) {
            const double t_s = from + (at[i] - from) * k / PER_PIECE;
            fw_quantity_law_value(law, t_s, 0.5 * (from + at[i]), value);
            if (fabs(value[0] - start) > most) most = fabs(value[0] - start), *at_s = t_s;
        }
    return most;
}

double fw_quantity_law_rings(const fw_quantity_law *law, double end_s, double omega_per_s,
                             double *at_s) {
    double most;
    *at_s = 0;
    if (fw_quantity_law_is_constant(law)) return 0;
    const double variation = fw_quantity_law_measure(law, end_s).variation;
    const double all = jolts(law, false, end_s, omega_per_s, &most),
                 jumps = jolts(law, false, end_s, (double)INFINITY, &most);
    const double rings = isfinite(all) ? fmin(all - jumps, variation) : variation;
    const double far = furthest(law, end_s, at_s);
    return rings > 0 ? rings / far : 0;
}

typedef struct varied { /* of an acceleration so far: between breaks, at them, and of its slope */
    double between, jumps, slope;
    double last[3], last_slope;
} varied;

/* one piece without a break */
static void shake_piece(const fw_quantity_law *law, double from, double to, double end_s, varied *v,
                        fw_quantity_law_shaking *s) {
    const double most_cells = 1 << 16, a_scene = 1024, least = 32;
    const double fastest = fw_quantity_law_wave_of(law).fastest_Hz,
                 wanted = fmax(a_scene * (to - from) / end_s, 24 * fastest * (to - from)),
                 n = fmin(ceil(fmax(least, wanted)), most_cells), h = (to - from) / n;
    for (double k = 0; k <= n; k++) {
        const double t_s = k < n ? from + h * k : to;
        double now[3];
        fw_quantity_law_value(law, t_s, 0.5 * (from + to), now);
        const double by = now[2] - v->last[2];
        if (k == 0) {
            s->blows += fabs(now[1] - v->last[1]);
            v->jumps += fabs(by);
        } else {
            v->between += fabs(by);
            v->slope += fabs(by / h - v->last_slope);
            v->last_slope = by / h;
        }
        if (fabs(now[2]) > s->most) s->most = fabs(now[2]), s->at_s = t_s;
        memcpy(v->last, now, sizeof now);
    }
}

fw_quantity_law_shaking fw_quantity_law_shakes(const fw_quantity_law *law, double end_s,
                                               double omega_per_s) {
    double at[JOLTS + 1], from = 0;
    fw_quantity_law_shaking s = {0};
    varied v = {0};
    const int count = fw_quantity_law_breaks_of(law, end_s, at, JOLTS);
    if (fw_quantity_law_is_constant(law)) return s;
    if (count > JOLTS) {
        s.most = s.rings = s.blows = (double)INFINITY;
        return s;
    }
    fw_sort_doubles(at, (size_t)count);
    at[count] = end_s;
    for (int i = 0; i <= count; i++) {
        if (!(at[i] > from)) continue;
        shake_piece(law, from, at[i], end_s, &v, &s);
        from = at[i];
    }
    if (s.most > 0) s.rings = (v.jumps + fmin(v.between, v.slope / omega_per_s)) / s.most;
    return s;
}

/* ---- what it does to an oscillator ---- */

enum { PER_PERIOD = 24 };

double fw_quantity_law_swing(const fw_quantity_law *law, fw_quantity_law_acts as, double end_s,
                             double omega_per_s, double damping) {
    const bool squared = as == FW_LAW_SQUARED, behind = as == FW_LAW_OF_COORDINATE;
    const double most_steps = 4e6,
                 fastest = (squared ? 2 : 1) * fw_quantity_law_wave_of(law).fastest_Hz;
    const double n = ceil(PER_PERIOD * end_s * fmax(omega_per_s / (2 * FW_PI), fastest));
    if (!(n < most_steps) || !(damping < 1)) return -1;
    const double h = end_s / n, w = omega_per_s, turn = w * sqrt(1 - damping * damping);
    const double decay = exp(-damping * w * h), c = decay * cos(turn * h),
                 s = decay * sin(turn * h) / turn;
    double q = 0, v = 0, most = 0, value[3];
    fw_quantity_law_value(law, 0, 0.5 * h, value);
    const double start = behind ? value[0] : 0;
    double f = squared ? value[0] * value[0] : value[0] - start;
    for (double k = 1; k <= n; k++) {
        fw_quantity_law_value(law, k * h, (k - 0.5) * h, value);
        const double next = squared ? value[0] * value[0] : value[0] - start,
                     slope = (next - f) / h;
        const double late = behind ? 0 : 2 * damping * slope / w;
        const double x = q - f + late, y = v - slope; /* from what follows f, 2 zeta/w behind */
        q = next - late + x * c + (y + damping * w * x) * s;
        v = slope + y * c - (w * w * x + damping * w * y) * s;
        f = next;
        most = fmax(most, fabs(behind ? q - f : q));
    }
    return most;
}

double fw_quantity_law_pumps(const fw_quantity_law *law, bool squared, double end_s, double most,
                             double omega, double damping, double share) {
    const double fastest = fw_quantity_law_wave_of(law).fastest_Hz,
                 a_second = 24 * fmax(omega / (2 * FW_PI), fastest), steps = ceil(a_second * end_s),
                 h = end_s / steps;
    double grown = 0;
    for (int start = 0; start < 2; start++) {
        double x = 1 - start, v = start ? omega : 0, value[3];
        for (double i = 0; i < steps; i++) {
            const double t = (i + 0.5) * h;
            fw_quantity_law_value(law, t, t, value);
            const double f = squared ? 2 * pow(value[0] / most, 2) - 1 : value[0] / most;
            const double middle = x + 0.5 * h * v;
            v = (v * (1 - damping * omega * h) - h * omega * omega * (1 + share * f) * middle) /
                (1 + damping * omega * h);
            x = middle + 0.5 * h * v;
            grown = fmax(grown, hypot(x, v / omega));
        }
    }
    return grown;
}

double fw_quantity_law_root_mean_square(const fw_quantity_law *law, double end_s) {
    enum { CELLS = 2048 };
    double sum = 0, value[3];
    for (int i = 0; i < CELLS; i++) {
        const double t = end_s * (i + 0.5) / CELLS;
        fw_quantity_law_value(law, t, t, value);
        sum += value[0] * value[0] / CELLS;
    }
    return sqrt(sum);
}

/* ---- several loads together ---- */

typedef struct swinging { /* of one oscillator; at the step's begin and end */
    double omega, damping, turn, decay, c, s, q[2], v[2], f[2];
} swinging;

/* what each oscillator stands under, and what each row has less, at a time of the piece about piece_s */
static void loads_at(const fw_quantity_law_load *load, int n, double t_s, double piece_s,
                     const fw_quantity_law_oscillator *from, int count, swinging *o, int end,
                     const fw_quantity_law_seen *seen, double *rest) {
    double value[3] = {1, 0, 0};
    for (int i = 0; i < seen->n; i++)
        rest[i] = 0;
    for (int k = 0; k < count; k++)
        o[k].f[end] = 0;
    for (int j = 0; j < n; j++) {
        if (load[j].law) fw_quantity_law_value(load[j].law, t_s, piece_s, value);
        const double now = load[j].law ? value[0] : 1,
                     acts = load[j].squared ? now * now : now - load[j].from;
        for (int k = 0; k < count; k++)
            o[k].f[end] += from[k].size[j] * acts;
        for (int i = 0; acts != 0 && i < seen->n; i++)
            rest[i] += seen->less[i * n + j] * acts;
    }
}

/* the farthest of the cubic through two values and rates, h apart */
static double farthest(double a, double rate_a, double b, double rate_b, double h) {
    const double most = fmax(fabs(a), fabs(b));
    if (!(rate_a * rate_b < 0)) return most;
    const double x = rate_a / (rate_a - rate_b), y = 1 - x;
    return fmax(most, fabs(y * y * (1 + 2 * x) * a + x * x * (1 + 2 * y) * b +
                           h * x * y * (y * rate_a - x * rate_b)));
}

static void step_on(swinging *o, double h) {
    const double w = o->omega, d = o->damping * w, slope = (o->f[1] - o->f[0]) / h;
    const double late = 2 * o->damping * slope / w, x = o->q[0] - o->f[0] + late,
                 y = o->v[0] - slope;
    o->q[1] = o->f[1] - late + x * o->c + (y + d * x) * o->s;
    o->v[1] = slope + y * o->c - (w * w * x + d * y) * o->s;
}

/* ends: those of the step alone count */
static void look_at(const swinging *o, int count, double h, bool ends, const double *before,
                    const double *now, fw_quantity_law_seen *seen) {
    for (int i = 0; i < seen->n; i++) {
        const double rate = (now[i] - before[i]) / h;
        double a = -before[i], b = -now[i], rate_a = -rate, rate_b = -rate;
        for (int k = 0; k < count; k++) {
            const double by = seen->by[i * count + k];
            a += by * o[k].q[0], b += by * o[k].q[1];
            rate_a += by * o[k].v[0], rate_b += by * o[k].v[1];
        }
        seen->most[i] =
            fmax(seen->most[i], ends ? fmax(fabs(a), fabs(b)) : farthest(a, rate_a, b, rate_b, h));
    }
}

/* `steps` even ones within a piece; what acts at their begin is known */
static void swing_on(const fw_quantity_law_load *load, int n, double from_s, double to_s,
                     double steps, double piece_s, bool ends,
                     const fw_quantity_law_oscillator *from, int count, swinging *o,
                     fw_quantity_law_seen *seen) {
    const double h = (to_s - from_s) / steps;
    double *before = seen->rest, *now = seen->rest + seen->n;
    for (int k = 0; k < count; k++) {
        o[k].decay = exp(-o[k].damping * o[k].omega * h);
        o[k].c = o[k].decay * cos(o[k].turn * h);
        o[k].s = o[k].decay * sin(o[k].turn * h) / o[k].turn;
    }
    for (double at = 1; at <= steps; at++) {
        const double t = at == steps ? to_s : from_s + at * h;
        loads_at(load, n, t, piece_s, from, count, o, 1, seen, now);
        for (int k = 0; k < count; k++)
            step_on(&o[k], h);
        look_at(o, count, h, ends, before, now, seen);
        for (int k = 0; k < count; k++)
            o[k].q[0] = o[k].q[1], o[k].v[0] = o[k].v[1], o[k].f[0] = o[k].f[1];
        for (int i = 0; i < seen->n; i++)
            before[i] = now[i];
    }
}

double fw_quantity_law_swings_of(const fw_quantity_law_load *load, int n,
                                 const fw_quantity_law_pieces *pieces,
                                 const fw_quantity_law_oscillator *from, int count,
                                 fw_quantity_law_seen *seen) {
    const double most_steps = 4e6;
    swinging o[FW_QUANTITY_OSCILLATORS];
    double steps = 0, at = 0, fastest = 0;
    for (int k = 0; k < count; k++) {
        const double w = from[k].omega_per_s, d = from[k].damping;
        if (!(d < 1) || !(w > 0)) return -1;
        o[k] = (swinging){.omega = w, .damping = d, .turn = w * sqrt(1 - d * d)};
        o[k].v[0] = from[k].start_per_s;
        fastest = fmax(fastest, w);
    }
    for (int i = 0; i < seen->n; i++)
        seen->most[i] = 0;
    const double period = 2 * FW_PI / fastest;
    for (int p = 0; p < pieces->n; at = pieces->end_s[p++]) {
        const double to = pieces->end_s[p], middle = 0.5 * (at + to);
        const bool straight = isinf(pieces->step_s[p]),
                   jumps = straight && count == 1 && to - at > 3 * period;
        const double few = straight ? 0.5 * PER_PERIOD : PER_PERIOD,
                     needs = ceil((to - at) / fmin(period / few, pieces->step_s[p]));
        steps += jumps ? 2 * few + 1 : needs;
        if (!(steps < most_steps)) return -1;
        loads_at(load, n, at, middle, from, count, o, 0, seen, seen->rest);
        if (!jumps) {
            swing_on(load, n, at, to, needs, middle, false, from, count, o, seen);
            continue;
        }
        swing_on(load, n, at, at + period, few, middle, false, from, count, o, seen);
        swing_on(load, n, at + period, to - period, 1, middle, true, from, count, o, seen);
        swing_on(load, n, to - period, to, few, middle, false, from, count, o, seen);
    }
    return steps;
}

/* by parts once: what a law varies by sets ringing at most */
double fw_quantity_law_bound_of(const fw_quantity_law_load *load, const double *by, int n,
                                double end_s) {
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const fw_quantity_law_size size = fw_quantity_law_measure(load[i].law, end_s);
        const double acts = load[i].squared ? size.most * (size.most + 2 * size.variation)
                                            : size.most + fabs(load[i].from) + size.variation;
        if (by[i] != 0) sum += fabs(by[i]) * acts;
    }
    return sum;
}

/* does a law change in several places, between which it rests? */
static bool rests_between(const fw_quantity_law *law, double end_s) {
    const double hardly = 0.02;
    double value[3], before, step[SAMPLES], most = 0;
    int runs = 0, last = -SAMPLES, length = 0;
    fw_quantity_law_value(law, 0, 0, value);
    for (int i = 0; i < SAMPLES; i++) {
        const double t = end_s * (i + 1) / SAMPLES;
        before = value[0];
        fw_quantity_law_value(law, t, t, value);
        step[i] = fabs(value[0] - before);
        most = fmax(most, step[i]);
    }
    for (int i = 0; i < SAMPLES; i++) {
        if (!(step[i] > hardly * most)) continue;
        if (i - last > 1 + length) runs++, length = 0;
        length += i - last < SAMPLES ? i - last : 1;
        last = i;
    }
    return runs > 1;
}

/* the same at all times; of what is not a table by its numbers */
static bool one_course(const fw_quantity_law *a, const fw_quantity_law *b, double end_s) {
    const bool still = fw_quantity_law_is_constant(a);
    if (a == b || still || fw_quantity_law_is_constant(b))
        return a == b || (still && fw_quantity_law_is_constant(b));
    if (a->kind != b->kind || a->program != b->program || a->ntable != b->ntable) return false;
    for (int i = 0; i < a->ntable; i++)
        if (a->table_t_s[i] != b->table_t_s[i] || a->table_value[i] != b->table_value[i])
            return false;
    for (int i = 0; i < FW_QUANTITY_LAW_OWN; i++)
        if (a->own[i] != b->own[i]) return false;
    return a->start_s == b->start_s && fmin(a->end_s, end_s) == fmin(b->end_s, end_s) &&
           a->rise_s == b->rise_s && a->frequency_Hz == b->frequency_Hz &&
           a->phase_rad == b->phase_rad && a->frequency_most_Hz == b->frequency_most_Hz &&
           a->lines == b->lines && a->seed == b->seed;
}

bool fw_quantity_law_come_again(const fw_quantity_law_load *load, int n, double end_s) {
    bool apart = false;
    double at[JOLTS], value[3];
    for (int i = 0; i < n; i++) {
        apart = apart || !one_course(load[0].law, load[i].law, end_s);
        if (fw_quantity_law_is_constant(load[i].law)) continue;
        const int breaks = fw_quantity_law_breaks_of(load[i].law, end_s, at, JOLTS);
        if (breaks > 2 || rests_between(load[i].law, end_s)) return true;
        if (!load[i].coordinate) continue;
        fw_quantity_law_value(load[i].law, 0, 0.25 * (breaks > 0 ? at[0] : end_s), value);
        if (breaks + (value[1] != 0) > 1) return true;
    }
    return apart;
}

bool fw_quantity_law_goes(const fw_quantity_law *law, double end_s, double *from, double *to) {
    double value[3], at[JOLTS];
    const int breaks = fw_quantity_law_breaks_of(law, end_s, at, JOLTS),
              seen = breaks < JOLTS ? breaks : JOLTS;
    fw_quantity_law_value(law, 0, 0.5 * end_s / SAMPLES, value);
    *from = *to = value[0];
    for (int i = 1; i <= SAMPLES + seen; i++) {
        const double t = i > SAMPLES ? at[i - SAMPLES - 1] : end_s * i / SAMPLES;
        fw_quantity_law_value(law, t, t, value);
        if (fabs(value[0] - *from) > fabs(*to - *from)) *to = value[0];
    }
    return *to != *from;
}

bool fw_quantity_law_goes_to_and_fro(const fw_quantity_law *law, double end_s) {
    enum { LOOKS = 2000 };
    const double once = 0.25; /* of the range: no more than that beyond one way there and back */
    if (fw_quantity_law_is_constant(law)) return false;
    double variation = fw_quantity_law_measure(law, end_s).variation, value[3];
    fw_quantity_law_value(law, 0, 0.5 * end_s / LOOKS, value);
    if (law->kind->variation) variation = fmin(variation, law->kind->variation(law, end_s));
    const double first = value[0];
    double least = first, most = first;
    for (int i = 1; i <= LOOKS; i++) {
        const double t = end_s * i / LOOKS;
        fw_quantity_law_value(law, t, t - 0.5 * end_s / LOOKS, value);
        least = fmin(least, value[0]), most = fmax(most, value[0]);
    }
    variation -= fabs(first); /* what it jumps by at the start */
    return !(variation - 2 * (most - least) + fabs(value[0] - first) <= once * (most - least));
}

/* of all frequencies of [low, high]; -1: it would take too long, or samples could miss something of the law */
static double swings(const fw_quantity_law *law, double end_s, double low, double high) {
    const double apart = 0.5, most_steps = 4e6;
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    if (!(wave.fastest_Hz > 0) && !fw_quantity_law_is_straight(law)) return -1;
    const double n = 1 + ceil((high - low) * end_s / apart);
    if (!(n * PER_PERIOD * end_s * fmax(high / (2 * FW_PI), wave.fastest_Hz) < most_steps))
        return -1;
    double most = 0;
    for (double k = 0; k < n; k++)
        most =
            fmax(most, fw_quantity_law_swing(law, FW_LAW_OF_LOAD, end_s,
                                             n > 1 ? low + (high - low) * k / (n - 1) : high, 0));
    return most;
}

double fw_quantity_law_answer(const fw_quantity_law *law, double end_s, double low_per_s,
                              double high_per_s) {
    const double margin = 1.03;
    const fw_quantity_law_size size = fw_quantity_law_measure(law, end_s);
    double most;
    if (fw_quantity_law_is_constant(law)) return 2;
    if (!isfinite(size.most)) return (double)INFINITY;
    const double rings = jolts(law, false, end_s, low_per_s, &most);
    const double parts = size.most + (rings < size.variation ? rings : size.variation);
    if (parts <= 2 * size.most) return parts;
    const double sampled = swings(law, end_s, low_per_s, high_per_s);
    return sampled < 0 ? parts : fmin(parts, margin * sampled);
}

/* ---- what it is like ---- */

bool fw_quantity_law_is_constant(const fw_quantity_law *law) {
    return !law || (law->kind->is_constant && law->kind->is_constant(law));
}

bool fw_quantity_law_is_straight(const fw_quantity_law *law) {
    return !law || (law->kind->straight && law->kind->straight(law));
}

bool fw_quantity_law_never_negative(const fw_quantity_law *law) {
    return !law || (law->kind->never_negative && law->kind->never_negative(law));
}

bool fw_quantity_law_is_ready(const fw_quantity_law *law) {
    return !law->kind->is_ready || law->kind->is_ready(law);
}

fw_quantity_law_wave fw_quantity_law_wave_of(const fw_quantity_law *law) {
    return law && law->kind->wave ? law->kind->wave(law) : (fw_quantity_law_wave){0};
}
