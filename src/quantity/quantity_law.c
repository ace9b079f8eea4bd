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

void fw_quantity_law_value(const fw_quantity_law *law, double t_s, double piece_s,
                           double value[3]) {
    const bool held = law->held_s > 0 && piece_s > law->held_s;
    const double before = 1 - 1e-12; /* of what jumps there, as it was */
    if (held) t_s = law->held_s, piece_s = before * t_s;
    law->kind->value(law, t_s, piece_s, value);
    if (held) value[1] = value[2] = 0;
}

int fw_quantity_law_breaks_of(const fw_quantity_law *law, double end_s, double *t_s, int most) {
    const bool held = law && law->held_s > 0;
    fw_quantity_law_breaks b = {held ? fmin(end_s, law->held_s) : end_s, t_s, most, 0};
    if (law && law->kind->breaks) law->kind->breaks(law, &b);
    b.end_s = end_s;
    if (held) fw_quantity_law_break(&b, law->held_s);
    return b.count;
}

bool fw_quantity_law_rests(const fw_quantity_law *law, double from_s) {
    static const double behind[] = {1e-6, 1e-3, 0.013, 0.1, 0.37, 1};
    const double hardly = 1e-6, at_s = from_s * (1 + behind[0]);
    double first[3], now[3];
    if (fw_quantity_law_is_constant(law)) return true;
    fw_quantity_law_value(law, at_s, at_s, first);
    for (int i = 0; i < (int)(sizeof behind / sizeof *behind); i++) {
        const double t_s = from_s * (1 + behind[i]);
        fw_quantity_law_value(law, t_s, t_s, now);
        const double most = hardly * fmax(fabs(first[0]), hardly);
        if (!(fabs(now[1]) * from_s <= most && fabs(now[0] - first[0]) <= most)) return false;
    }
    return true;
}

const fw_quantity_law *fw_quantity_law_hold(fw_arena *arena, const fw_quantity_law *law,
                                            double held_s) {
    fw_quantity_law *own = law ? fw_arena_one(arena, fw_quantity_law) : NULL;
    if (own) *own = *law, own->held_s = held_s;
    return own;
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

typedef struct swung {
    double most, last[3]; /* q, its rate over omega, and the law at the end */
    double behind;        /* |q - f| at most */
} swung;

static bool swing_to(const fw_quantity_law *law, fw_quantity_law_acts as, double end_s,
                     double omega_per_s, double damping, swung *to) {
    const bool squared = as == FW_LAW_SQUARED, behind = as == FW_LAW_OF_COORDINATE;
    const double most_steps = 4e6,
                 fastest = (squared ? 2 : 1) * fw_quantity_law_wave_of(law).fastest_Hz;
    const double n = ceil(PER_PERIOD * end_s * fmax(omega_per_s / (2 * FW_PI), fastest));
    *to = (swung){0};
    if (!(n < most_steps) || !(damping < 1)) return false;
    const double h = end_s / n, w = omega_per_s, turn = w * sqrt(1 - damping * damping);
    const double decay = exp(-damping * w * h), c = decay * cos(turn * h),
                 s = decay * sin(turn * h) / turn;
    double q = 0, v = 0, value[3];
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
        to->most = fmax(to->most, fabs(q)), to->behind = fmax(to->behind, fabs(q - f));
    }
    to->last[0] = q, to->last[1] = v / w, to->last[2] = f;
    return true;
}

double fw_quantity_law_swing(const fw_quantity_law *law, fw_quantity_law_acts as, double end_s,
                             double omega_per_s, double damping) {
    swung to;
    if (!swing_to(law, as, end_s, omega_per_s, damping, &to)) return -1;
    return as == FW_LAW_OF_COORDINATE ? to.behind : to.most;
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

/* ---- what it does to an oscillator, whenever that is ---- */

double fw_quantity_law_done_s(const fw_quantity_law *law, double end_s) {
    const double done = law && law->kind->done ? law->kind->done(law) : end_s;
    return done > end_s && isfinite(done) && fw_quantity_law_largest(law, end_s) > 0 ? done : end_s;
}

enum { COURSE = 512, HALF_WAVE = 128 }; /* pieces; cells of a half wave */

typedef struct course { /* of a law that rests when all of it has come: straight cells */
    const fw_quantity_law *law;
    double at[COURSE + 1]; /* (n) where pieces end; the law stays what it is behind the last */
    int n;
    double cells;             /* of all pieces */
    double slow_s;            /* integral of (last - t) |df|: |d most/d omega| at most */
    double off, area, varies; /* from the law: at most; its integral; its variation */
    double impulse_s;         /* integral of |f| over the cells, at most */
} course;

static double cells_of(const fw_quantity_law *law, double from, double to) {
    return fmax(1, ceil(2 * HALF_WAVE * fw_quantity_law_wave_of(law).fastest_Hz * (to - from) *
                        (1 - 1e-9)));
}

/* false: samples could miss something of it, or it never rests, or there are too many pieces */
static bool course_of(const fw_quantity_law *law, double done_s, course *c) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    double value[3], before = 0, from = 0;
    *c = (course){.law = law};
    if (!law->kind->done || !(wave.rad_per_s > 0 || fw_quantity_law_is_straight(law))) return false;
    const double all = done_s * (1 + 1e-9);
    c->n = fw_quantity_law_breaks_of(law, all, c->at, COURSE);
    if (c->n > COURSE) return false;
    fw_sort_doubles(c->at, (size_t)c->n);
    if (c->n == 0) c->at[c->n++] = 0; /* there from the start on */
    for (int i = 0; i < c->n; from = c->at[i++]) {
        const double to = c->at[i], n = cells_of(law, from, to), h = (to - from) / n,
                     bow = pow(wave.rad_per_s * h, 2) / 8;
        if (!(h > 0)) continue;
        fw_quantity_law_value(law, from, 0.5 * (from + to), value);
        c->slow_s += fabs(value[0] - before) * (c->at[c->n - 1] - from);
        for (double k = 1; k <= n; k++) {
            before = value[0];
            fw_quantity_law_value(law, k < n ? from + k * h : to, 0.5 * (from + to), value);
            c->impulse_s += 0.5 * h * (fabs(before) + fabs(value[0]));
            c->slow_s += fabs(value[0] - before) * (c->at[c->n - 1] - (from + (k - 0.5) * h));
        }
        before = value[0];
        c->cells += n;
        c->off = fmax(c->off, bow), c->area += n * h * bow, c->varies += 2 * n * bow;
    }
    return true;
}

/* the most of |f + slope t + x cos wt + y sin wt| within h: at its ends, or at the first or last of its turns either way */
static double cell_most(double f, double slope, double h, double w, double x, double y) {
    const double size = hypot(x, y), sine = slope / (size * w), end = f + slope * h;
    double most = fmax(fabs(f + x), fabs(end + x * cos(w * h) + y * sin(w * h)));
    if (!(size > 0) || !(fabs(sine) < 1)) return most;
    const double phase = atan2(y, x), turn = asin(sine), top = size * sqrt(1 - sine * sine);
    for (int way = 0; way < 2; way++) {
        const double at = phase + (way ? FW_PI - turn : turn),
                     first = at - 2 * FW_PI * floor(at / (2 * FW_PI)),
                     last = first + 2 * FW_PI * floor((w * h - first) / (2 * FW_PI));
        if (first > w * h) continue;
        most = fmax(most, fabs(f + slope * first / w + (way ? -top : top)));
        most = fmax(most, fabs(f + slope * last / w + (way ? -top : top)));
    }
    return most;
}

/* at one frequency, of the law, whatever its cells are off by */
static fw_quantity_law_response answer_at(const course *c, double w) {
    const double little = 0.4; /* rad: within it a chord is off by (w h)^2/8 of what rings */
    double q = 0, v = 0, f = 0, from = 0, value[3];
    fw_quantity_law_response r = {0};
    for (int i = 0; i < c->n; from = c->at[i++]) {
        const double to = c->at[i], piece = 0.5 * (from + to), n = cells_of(c->law, from, to),
                     h = (to - from) / n, cosine = cos(w * h), sine = sin(w * h);
        if (!(h > 0)) continue;
        fw_quantity_law_value(c->law, from, piece, value);
        f = value[0];
        for (double k = 1; k <= n; k++) {
            fw_quantity_law_value(c->law, k < n ? from + k * h : to, piece, value);
            const double slope = (value[0] - f) / h, x = q - f, y = (v - slope) / w;
            const double next = value[0] + x * cosine + y * sine;
            if (n > 1 && w * h < little) {
                const double bow = hypot(x, y) * w * w * h * h / 8;
                r.most = fmax(r.most, fmax(fabs(q), fabs(next)) + bow);
                r.behind = fmax(r.behind, fmax(fabs(x), fabs(next - value[0])) + bow);
            } else {
                r.most = fmax(r.most, cell_most(f, slope, h, w, x, y));
                r.behind = fmax(r.behind, cell_most(0, 0, h, w, x, y));
            }
            v = slope + w * (y * cosine - x * sine), q = next, f = value[0];
        }
    }
    /* what it stays at: a step jumps there */
    fw_quantity_law_value(c->law, from, from * (1 + 1e-9), value);
    const double rings = hypot(q - value[0], v / w),
                 off = c->off + fmin(w * c->area, c->off + c->varies);
    r.most = fmax(r.most, fabs(value[0]) + rings) + off;
    r.behind = fmax(r.behind, rings) + off;
    return r;
}

typedef struct by_parts { /* what is sure of any frequency */
    double most, varies, jumps, slope;
} by_parts;

static fw_quantity_law_response parts_at(const by_parts *p, double w) {
    const double rings = p->jumps + p->slope / w, all = rings < p->varies ? rings : p->varies;
    return (fw_quantity_law_response){p->most + all, p->most + all, all};
}

static void widen(fw_quantity_law_response *to, fw_quantity_law_response by, double lower) {
    to->most = fmax(to->most, by.most), to->behind = fmax(to->behind, by.behind);
    to->far = fmax(to->far, by.most * lower * lower);
}

/* between two frequencies half a cell of them away what rings is off by slow_s times that */
static fw_quantity_law_response over_band(const course *c, const by_parts *p, double low,
                                          double high) {
    const double within = 0.02, most_cells = 1e5;
    const fw_quantity_law_response middle = answer_at(c, 0.5 * (low + high));
    const double size = fmin(middle.most, fmax(middle.behind, 0.1 * middle.most)),
                 wanted =
                     ceil((high - low) * c->slow_s / (2 * within * fmax(size, 1e-6 * p->most))),
                 n = fmax(1, fmin(wanted, floor(most_cells / c->cells))),
                 half = 0.5 * (high - low) / n;
    fw_quantity_law_response r = {0};
    for (double k = 0; k < n; k++) {
        const double from = low + 2 * half * k;
        fw_quantity_law_response is = answer_at(c, from + half);
        const fw_quantity_law_response sure = parts_at(p, from);
        is.most = fmin(is.most + c->slow_s * half, sure.most);
        is.behind = fmin(is.behind + c->slow_s * half, sure.behind);
        widen(&r, is, low / from);
    }
    return r;
}

/* samples of all frequencies of [low, high]; false: it would take too long, or they could miss something of the law */
static bool sampled_band(const fw_quantity_law *law, double end_s, double low, double high,
                         fw_quantity_law_response *r) {
    const double apart = 0.5, most_steps = 4e6, margin = 1.03;
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    if (!(wave.fastest_Hz > 0) && !fw_quantity_law_is_straight(law)) return false;
    const double n = 1 + ceil((high - low) * end_s / apart);
    if (!(n * PER_PERIOD * end_s * fmax(high / (2 * FW_PI), wave.fastest_Hz) < most_steps))
        return false;
    for (double k = 0; k < n; k++) {
        const double w = n > 1 ? low + (high - low) * k / (n - 1) : high;
        swung to;
        swing_to(law, FW_LAW_OF_LOAD, end_s, w, 0, &to);
        const double stays = wave.repeats ? 0 : to.last[2],
                     rings = hypot(to.last[0] - stays, to.last[1]);
        to.most = margin * fmax(to.most, fabs(stays) + rings);
        to.behind = margin * fmax(to.behind, rings);
        widen(r, (fw_quantity_law_response){to.most, 0, to.behind}, low / w);
    }
    return true;
}

fw_quantity_law_response fw_quantity_law_responds(const fw_quantity_law *law, double end_s,
                                                  double low_per_s, double high_per_s) {
    const double unbounded = (double)INFINITY;
    const double done = fw_quantity_law_done_s(law, end_s), end = done * (1 + 1e-9);
    const fw_quantity_law_size size = fw_quantity_law_measure(law, end);
    const bool stops = law && fw_quantity_law_wave_of(law).repeats;
    by_parts p = {.most = size.most, .varies = size.variation};
    fw_quantity_law_response r = {0};
    double met, value[3];
    course c;
    if (fw_quantity_law_is_constant(law)) return (fw_quantity_law_response){2, 2, 1};
    if (!isfinite(size.most)) return (fw_quantity_law_response){unbounded, unbounded, unbounded};
    if (!(fw_quantity_law_largest(law, end_s) > 0)) return r; /* it begins behind the scene */
    p.jumps = jolts(law, false, end, unbounded, &met);
    fw_quantity_law_value(law, end, end, value); /* where it stays, or stops */
    p.slope = jolts(law, false, end, 1, &met) - p.jumps + fabs(value[1]);
    if (isnan(p.slope)) p.slope = unbounded;
    if (course_of(law, done, &c)) return over_band(&c, &p, low_per_s, high_per_s);
    const fw_quantity_law_response parts = parts_at(&p, low_per_s);
    if (parts.most > 2 * size.most && sampled_band(law, done, low_per_s, high_per_s, &r)) {
        r.most = fmin(r.most, parts.most), r.far = fmin(r.far, parts.most);
        return r;
    }
    r = parts;
    if (stops) r.behind = r.most;
    return r;
}

double fw_quantity_law_impulse_s(const fw_quantity_law *law, double end_s) {
    const double done = fw_quantity_law_done_s(law, end_s);
    double value[3];
    course c;
    if (!law || !course_of(law, done, &c)) return (double)INFINITY;
    fw_quantity_law_value(law, done, done * (1 + 1e-9), value);
    return value[0] == 0 ? c.impulse_s + c.area : (double)INFINITY;
}

double fw_quantity_law_answer(const fw_quantity_law *law, double end_s, double low_per_s,
                              double high_per_s) {
    return fw_quantity_law_responds(law, end_s, low_per_s, high_per_s).most;
}
