/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long steps may be so that nothing in a law falls between them.

   The law is looked at once per cell, LOOKS cells over the scene, with value, slope and bend. Cells
   are paired into blocks of 2, 4, 8, ...; a block of length h is quiet when the cubic through value
   and slope at its ends stays within value_tolerance of the law's size of those of its halves, and
   so on down to the cells. Its miss e, in units of that, grows with h^4, so the stride that the
   block bears is h e^(-1/4). Where the two ends of one cell contradict each other (their f''
   against that of the cubic, h^2/64 times the sum of both), the cell is halved until they agree: so
   a pulse whose flanks, however faint, reach two looks is found and followed up to its top.

   For coordinates of drivers the second derivative is what moves masses: the bend of the cubic must
   meet the true one to a share of its largest value; this miss grows with h^2.

   Sines and cosines get 2.1 rad of their phase, half sines too, random ones of their fastest line,
   a bell exp(-(t/w)^2) about 1.1 w. Cost LOOKS evaluations and at most as many again where halving
   is needed. Source: error of cubic Hermite interpolation h^4 f''''/384, for instance Stoer and
   Bulirsch, 2.1. Test: test_stride.c */
#include "quantity/law_kind.h"
#include "base/constants.h"
#include "base/sort.h"
#include <math.h>
#include <string.h>

enum {
    LOOKS = 2048,       /* cells over the scene */
    FEWEST = 4,         /* cells of a smooth piece */
    FOLLOWED = 512,     /* looks for halving, in each of two passes */
    HALVINGS = 12,      /* of one cell */
    STRIDES_MOST = 1024 /* rows of the answer */
};
static const double value_tolerance = 0.05, bend_tolerance = 0.3, phase_rad = 2.1;

typedef struct sample {
    double t_s, value[3];
} sample;

typedef struct scan {
    const fw_quantity_law *law;
    bool coordinate;
    double piece_s;          /* a time in the piece at hand */
    double first, deviation; /* value at 0, largest distance from it */
    double size, least;      /* of what counts: deviation, or second derivative; its floor */
    int left;                /* samples */
    sample *found;           /* (FOLLOWED) those of the first pass, by time */
    int nfound;
    fw_quantity_law_strides *out;
} scan;

/* ---- what was seen ---- */

static bool is_known(const sample *l) {
    return isfinite(l->value[0]) && isfinite(l->value[1]) && isfinite(l->value[2]);
}

static void sample_at(scan *s, double t_s, sample *l) {
    l->t_s = t_s;
    fw_quantity_law_value(s->law, t_s, s->piece_s, l->value);
    if (!is_known(l)) return;
    s->deviation = fmax(s->deviation, fabs(l->value[0] - s->first));
    s->size = fmax(s->size, s->coordinate ? fabs(l->value[2]) : fabs(l->value[0] - s->first));
}

/* miss in units of what is allowed; changes that are all round-off do not count */
static double share(const scan *s, double miss) {
    double whole = (s->coordinate ? bend_tolerance : value_tolerance) * fmax(s->size, s->least);
    if (!isfinite(miss) || miss == 0) return 0;
    return whole > 0 ? miss / whole : 2;
}

/* what the bend of the cubic through a and b misses at look l */
static double bend_miss(const sample *a, const sample *b, const sample *l) {
    double h = b->t_s - a->t_s, x = (l->t_s - a->t_s) / h, rise = b->value[0] - a->value[0];
    double d0 = h * a->value[1] - rise, d1 = rise - h * b->value[1];
    return fabs(((6 * x - 4) * d0 + (2 - 6 * x) * d1) / (h * h) - l->value[2]);
}

/* what the two ends of a cell know of its inside. Coordinates are held to their values as well: a
   wave seen at its nodes shows no bend */
static double cell_miss(const scan *s, const sample *a, const sample *b) {
    double h = b->t_s - a->t_s;
    if (!is_known(a) || !is_known(b)) return 0;
    double left = bend_miss(a, b, a), right = bend_miss(a, b, b),
           value = h * h / 64 * (left + right);
    if (!s->coordinate) return share(s, value);
    double whole = value_tolerance * fmax(s->deviation, 1e-12 * fabs(s->first));
    return fmax(share(s, fmax(left, right)), whole > 0 && isfinite(value) ? value / whole : 0);
}

/* How far the cubic of a block a, b strays from those of its halves a, m and m, b: on each half of
   length H the difference is a cubic that is flat at the outer end and has value dv, slope ds at m.
   Its size is at most |dv| + 4/27 H |ds|, its bend 6 |dv|/H^2 + 4 |ds|/H. */
static double joint_miss(const scan *s, const sample *a, const sample *m, const sample *b) {
    if (!is_known(a) || !is_known(m) || !is_known(b)) return 2;
    double h = b->t_s - a->t_s, rise = b->value[0] - a->value[0], half = h / 2;
    double value = a->value[0] + rise / 2 + h / 8 * (a->value[1] - b->value[1]);
    double slope = 1.5 * rise / h - (a->value[1] + b->value[1]) / 4;
    double dv = fabs(value - m->value[0]), ds = fabs(slope - m->value[1]);
    return share(s, s->coordinate ? 6 * dv / (half * half) + 4 * ds / half
                                  : dv + 4.0 / 27 * half * ds);
}

/* ---- strides ---- */

/* from t_s on; rows of about the same stride become one */
static void emit(scan *s, double t_s, double most_s) {
    fw_quantity_law_strides *out = s->out;
    double *last = out->n ? &out->most_s[out->n - 1] : NULL;
    bool same = last && (*last == most_s || (most_s > 0.7 * *last && most_s < 1.5 * *last));
    if (same || out->n == STRIDES_MOST) {
        *last = fmin(*last, most_s);
        return;
    }
    out->t_s[out->n] = t_s;
    out->most_s[out->n++] = most_s;
}

static double stride(const scan *s, double h, double miss) {
    return h / fmax(s->coordinate ? sqrt(miss) : sqrt(sqrt(miss)), 1e-30);
}

/* no looks left: as if the law went on like sin here */
static double local_stride(const scan *s, const sample *a, const sample *b) {
    double rate = 0, h = b->t_s - a->t_s, size = s->coordinate ? s->deviation : s->size;
    const sample *end[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        const double *v = end[i]->value;
        rate = fmax(rate, fmax(sqrt(fabs(v[2]) / size), fabs(v[1]) / size));
    }
    return fmax(h / 4096, fmin(h, phase_rad / rate));
}

/* Two passes: how large the law becomes is known only after it has been followed everywhere; what
   seems quiet beside a pulse may hold its flank. */

/* first pass: halves a cell until its ends agree and keeps the looks that takes */
static void follow(scan *s, const sample *a, const sample *b, int halvings) {
    if (halvings == 0 || s->left == 0 || cell_miss(s, a, b) <= 1) return;
    sample middle;
    s->left--;
    sample_at(s, a->t_s + (b->t_s - a->t_s) / 2, &middle);
    follow(s, a, &middle, halvings - 1);
    s->found[s->nfound++] = middle;
    follow(s, &middle, b, halvings - 1);
}

/* second pass: strides of the parts of a cell that agree in themselves */
static void write_part(scan *s, const sample *a, const sample *b, int halvings) {
    double miss = cell_miss(s, a, b), h = b->t_s - a->t_s;
    if (miss <= 1 || halvings == 0 || s->left == 0) {
        double most = miss <= 1 ? stride(s, h, miss) : halvings > 0 ? local_stride(s, a, b) : h;
        emit(s, a->t_s, most);
        return;
    }
    sample middle;
    s->left--;
    sample_at(s, a->t_s + h / 2, &middle);
    write_part(s, a, &middle, halvings - 1);
    write_part(s, &middle, b, halvings - 1);
}

static int halvings_left(const sample *cell, double h) {
    return HALVINGS - (int)lround(log2((cell[1].t_s - cell[0].t_s) / h));
}

/* ---- a smooth piece ---- */

typedef struct piece {
    double start_s, end_s;
    int cells;       /* a power of two */
    sample *sampled; /* (cells + 1) */
    int *found;      /* (cells + 1) first look inside each cell, in scan.found */
    /* (2 cells) of blocks, in heap order: 1, its halves 2 and 3, theirs 4 to 7, ... */
    double *miss;
} piece;

static fw_status look_over(fw_arena *arena, scan *s, piece *p, double wanted) {
    p->cells = FEWEST;
    while (2 * p->cells <= wanted)
        p->cells *= 2;
    size_t cells = (size_t)p->cells;
    FW_NEED(p->sampled = fw_arena_array(arena, sample, cells + 1));
    FW_NEED(p->found = fw_arena_array(arena, int, cells + 1));
    FW_NEED(p->miss = fw_arena_array(arena, double, 2 * cells));
    s->piece_s = p->start_s + (p->end_s - p->start_s) / 2;
    for (int i = 0; i <= p->cells; i++)
        sample_at(s, i == p->cells ? p->end_s : p->start_s + (p->end_s - p->start_s) * i / p->cells,
                  &p->sampled[i]);
    return FW_OK;
}

static void follow_all(scan *s, const piece *p) {
    s->piece_s = p->start_s + (p->end_s - p->start_s) / 2;
    for (int i = 0; i < p->cells; i++) {
        p->found[i] = s->nfound;
        follow(s, &p->sampled[i], &p->sampled[i + 1], HALVINGS);
    }
    p->found[p->cells] = s->nfound;
}

/* the misses of every block: what its worse half misses and what joining them adds; a block with a
   part that is not quiet is not quiet either */
static void judge(const scan *s, const piece *p) {
    for (int i = 0; i < p->cells; i++) {
        bool agrees = p->found[i] == p->found[i + 1];
        p->miss[p->cells + i] = agrees ? cell_miss(s, &p->sampled[i], &p->sampled[i + 1]) : 2;
    }
    for (int size = 2, first = p->cells / 2; first >= 1; size *= 2, first /= 2)
        for (int i = 0; i < first; i++) {
            const sample *a = &p->sampled[i * size];
            int here = first + i;
            double worse = fmax(p->miss[2 * here], p->miss[2 * here + 1]);
            p->miss[here] = worse <= 1 ? worse + joint_miss(s, a, a + size / 2, a + size) : 2;
        }
}

static void write_cell(scan *s, const piece *p, int i) {
    const sample *a = &p->sampled[i], *end = &p->sampled[i + 1];
    for (int k = p->found[i]; k <= p->found[i + 1]; k++) {
        const sample *b = k < p->found[i + 1] ? &s->found[k] : end;
        write_part(s, a, b, halvings_left(&p->sampled[i], b->t_s - a->t_s));
        a = b;
    }
}

static void write_block(scan *s, const piece *p, int here, int from, int size) {
    const sample *a = p->sampled + from;
    if (p->miss[here] <= 1) {
        /* a whole piece that is quiet needs no limit: steps end where it ends */
        double most = stride(s, a[size].t_s - a->t_s, p->miss[here]);
        emit(s, a->t_s, here == 1 ? (double)INFINITY : most);
    } else if (size == 1) {
        write_cell(s, p, from);
    } else {
        write_block(s, p, 2 * here, from, size / 2);
        write_block(s, p, 2 * here + 1, from + size / 2, size / 2);
    }
}

/* ---- the law ---- */

static fw_status scan_pieces(fw_arena *arena, scan *s, piece *list, int count) {
    double value[3], end_s = list[count - 1].end_s;
    fw_quantity_law_value(s->law, 0, list[0].end_s / 2, value);
    s->first = isfinite(value[0]) ? value[0] : 0;
    FW_NEED(s->found = fw_arena_array(arena, sample, FOLLOWED));
    for (int i = 0; i < count; i++)
        FW_TRY(look_over(arena, s, &list[i], LOOKS * (list[i].end_s - list[i].start_s) / end_s));
    /* floors: round-off at first; then a thousandth of the law's size, because smaller changes
       matter as little as the accuracy wanted. Accelerations too slow to move anything never count
     */
    double slow = (1e-3 * s->deviation + 1e-6 * fabs(s->first)) / (end_s * end_s);
    s->least = s->coordinate ? slow : 1e-12 * fabs(s->first);
    s->left = FOLLOWED;
    for (int i = 0; i < count; i++)
        follow_all(s, &list[i]);
    s->least = s->coordinate ? slow : 1e-3 * fabs(s->first);
    s->left = FOLLOWED;
    for (int i = 0; i < count; i++) {
        s->piece_s = list[i].start_s + (list[i].end_s - list[i].start_s) / 2;
        judge(s, &list[i]);
        write_block(s, &list[i], 1, 0, list[i].cells);
    }
    return FW_OK;
}

static fw_status scan_any(fw_arena *arena, scan *s, double end_s, const double *break_s,
                          int breaks) {
    fw_mark mark = fw_arena_mark(arena);
    piece *list;
    int count = 0;
    double from = 0;
    FW_NEED(list = fw_arena_array(arena, piece, (size_t)breaks + 1));
    for (int i = 0; i <= breaks; i++) {
        double to = i < breaks ? break_s[i] : end_s;
        if (!(to > from)) continue;
        list[count++] = (piece){.start_s = from, .end_s = to};
        from = to;
    }
    fw_status status = count > 0 ? scan_pieces(arena, s, list, count) : FW_OK;
    fw_arena_rewind(arena, mark);
    return status;
}

fw_status fw_quantity_law_look(fw_arena *arena, const fw_quantity_law *law, bool coordinate,
                               double end_s, const double *break_s, int breaks,
                               fw_quantity_law_strides *out) {
    *out = (fw_quantity_law_strides){0};
    if (!(end_s > 0) || !isfinite(end_s) || fw_quantity_law_is_straight(law)) return FW_OK;
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    const bool waves = wave.fastest_Hz > 0;
    size_t rows = waves ? 2 : STRIDES_MOST;
    FW_NEED(out->t_s = fw_arena_array(arena, double, rows));
    FW_NEED(out->most_s = fw_arena_array(arena, double, rows));
    scan s = {.law = law, .coordinate = coordinate, .out = out};
    if (!waves) return scan_any(arena, &s, end_s, break_s, breaks);
    emit(&s, wave.from_s, phase_rad / (2 * FW_PI * wave.fastest_Hz));
    if (wave.to_s < end_s) emit(&s, wave.to_s, (double)INFINITY);
    return FW_OK;
}

double fw_quantity_law_stride(const fw_quantity_law_strides *strides, double factor, double t_s,
                              int *row) {
    double most = (double)INFINITY;
    int i = *row < strides->n ? *row : 0;
    if (i > 0 && strides->t_s[i] > t_s) i = 0;
    while (i + 1 < strides->n && strides->t_s[i + 1] <= t_s)
        i++;
    *row = i;
    for (; i < strides->n && strides->t_s[i] - t_s < most; i++)
        most = fmin(most, fmax(0, strides->t_s[i] - t_s) + factor * strides->most_s[i]);
    return most;
}

/* ---- pieces of several laws, and what sees them ---- */

/* longest step that sees a law from `from` to `to`, which no break lies between; fast: all of its strides */
static double step_for(const fw_quantity_law_load *load, const fw_quantity_law_strides *fast,
                       double from, double to) {
    const double per_period = 24,
                 share = 0.125; /* a stride is 2.1 rad of what the law is made of */
    const double own_Hz = fw_quantity_law_wave_of(load->law).fastest_Hz;
    double least = own_Hz > 0 ? 1 / (per_period * own_Hz) : (double)INFINITY;
    if (fw_quantity_law_is_straight(load->law)) return (double)INFINITY;
    for (int i = 0; i < fast->n; i++)
        if (fast->t_s[i] < to && (i + 1 == fast->n || fast->t_s[i + 1] > from))
            least = fmin(least, share * fast->most_s[i]);
    return fmin(load->squared ? 0.5 * least : least, to - from);
}

static int compact(double *at, int n) {
    int kept = 0;
    for (int i = 0; i < n; i++)
        if (kept == 0 || at[i] > at[kept - 1]) at[kept++] = at[i];
    return kept;
}

fw_status fw_quantity_law_pieces_of(fw_arena *arena, const fw_quantity_law_load *load, int n,
                                    double end_s, fw_quantity_law_pieces *to) {
    size_t all = 1;
    int count = 0;
    for (int i = 0; i < n; i++)
        all += (size_t)fw_quantity_law_breaks_of(load[i].law, end_s, NULL, 0);
    FW_NEED(to->end_s = fw_arena_array(arena, double, all));
    FW_NEED(to->step_s = fw_arena_array(arena, double, all));
    for (int i = 0; i < n; i++)
        count +=
            fw_quantity_law_breaks_of(load[i].law, end_s, to->end_s + count, (int)all - 1 - count);
    to->end_s[count++] = end_s;
    fw_sort_doubles(to->end_s, (size_t)count);
    to->n = compact(to->end_s, count);
    for (int k = 0; k < to->n; k++)
        to->step_s[k] = (double)INFINITY;
    for (int i = 0; i < n; i++) {
        fw_quantity_law_strides fast = {0};
        if (load[i].law && !(fw_quantity_law_wave_of(load[i].law).fastest_Hz > 0) &&
            !fw_quantity_law_is_straight(load[i].law))
            FW_TRY(fw_quantity_law_look(arena, load[i].law, load[i].coordinate, end_s, to->end_s,
                                        to->n - 1, &fast));
        for (int k = 0; k < to->n; k++)
            to->step_s[k] = fmin(to->step_s[k],
                                 step_for(&load[i], &fast, k ? to->end_s[k - 1] : 0, to->end_s[k]));
    }
    return FW_OK;
}

/* ---- oscillators under several loads ---- */

enum { STEPS_A_PERIOD = 24, LANES = FW_QUANTITY_LANES };
#define EACH_LANE for (int l = 0; l < LANES; l++)
#define WIDE      static inline __attribute__((always_inline))

typedef struct swinging { /* of one oscillator at every frequency; at the step's begin and end */
    double omega[LANES], damped[LANES], turn[LANES], c[LANES], s[LANES], late[LANES];
    double q[2][LANES], v[2][LANES], f[2][LANES];
} swinging;

/* what each oscillator stands under, and what each row has less, at a time of the piece about piece_s */
static void loads_at(const fw_quantity_law_loads *on, double t_s, double piece_s,
                     const fw_quantity_law_oscillator *from, int count, swinging *o, int end,
                     const fw_quantity_law_seen *seen, fw_quantity_law_row *row) {
    double value[3] = {1, 0, 0}, by_scale[FW_QUANTITY_OSCILLATORS] = {0},
           as_is[FW_QUANTITY_OSCILLATORS] = {0};
    for (int i = 0; i < seen->n; i++)
        memset(row[i].less[end], 0, sizeof row[i].less[end]);
    for (int j = 0; j < on->n; j++) {
        const fw_quantity_law_load *load = &on->load[j];
        if (load->law) fw_quantity_law_value(load->law, t_s, piece_s, value);
        const double now = load->law ? value[0] : 1,
                     acts = load->squared ? now * now : now - load->from;
        double *to = j < on->n - on->held ? by_scale : as_is;
        for (int k = 0; k < count; k++)
            to[k] += from[k].size[j] * acts;
        for (int i = 0; seen->less && acts != 0 && i < seen->n; i++)
            EACH_LANE row[i].less[end][l] += seen->less[i * on->n + j] * acts;
    }
    for (int k = 0; k < count; k++)
        EACH_LANE o[k].f[end][l] = from[k].scale[l] * by_scale[k] + as_is[k];
    for (int i = 0; seen->behind && i < seen->n; i++)
        for (int k = 0; k < count; k++)
            EACH_LANE row[i].less[end][l] += seen->by[i * count + k] * o[k].f[end][l];
}

WIDE void rows_at(const swinging *o, int count, int end, const fw_quantity_law_seen *seen,
                  fw_quantity_law_row *row) {
    typedef double four __attribute__((vector_size(32)));
    for (int i = 0; i < seen->n; i++)
        for (int l = 0; l < LANES; l += 4) {
            four q = {0}, v = {0}, its;
            for (int k = 0; k < count; k++) {
                const double by = seen->by[i * count + k];
                memcpy(&its, o[k].q[end] + l, sizeof its), q += by * its;
                memcpy(&its, o[k].v[end] + l, sizeof its), v += by * its;
            }
            memcpy(row[i].q[end] + l, &q, sizeof q), memcpy(row[i].v[end] + l, &v, sizeof v);
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

WIDE void step_on(swinging *o, double h) {
    const double per_h = 1 / h;
    EACH_LANE {
        const double w = o->omega[l], slope = (o->f[1][l] - o->f[0][l]) * per_h,
                     late = o->late[l] * slope, x = o->q[0][l] - o->f[0][l] + late,
                     y = o->v[0][l] - slope, d = o->damped[l];
        o->q[1][l] = o->f[1][l] - late + x * o->c[l] + (y + d * x) * o->s[l];
        o->v[1][l] = slope + y * o->c[l] - (w * w * x + d * y) * o->s[l];
    }
}

WIDE double larger_of(double a, double b) { /* neither is NaN */
    return a > b ? a : b;
}

/* a cubic is above its ends by 4/27 of its rates at most; ends: those of the step alone count */
WIDE void look_at(const fw_quantity_law_row *row, double h, bool ends, double *most) {
    const double per_h = 1 / h, over = 4 / 27.0 * h;
    double a[LANES], b[LANES], rate_a[LANES], rate_b[LANES], high[LANES], may[LANES], was[LANES];
    bool turns = false;
    memcpy(was, most, sizeof was);
    EACH_LANE {
        const double slope = (row->less[1][l] - row->less[0][l]) * per_h;
        a[l] = row->q[0][l] - row->less[0][l], b[l] = row->q[1][l] - row->less[1][l];
        rate_a[l] = row->v[0][l] - slope, rate_b[l] = row->v[1][l] - slope;
        high[l] = larger_of(fabs(a[l]), fabs(b[l]));
        may[l] = high[l] + over * (fabs(rate_a[l]) + fabs(rate_b[l]));
        was[l] = larger_of(was[l], high[l]);
    }
    EACH_LANE turns |= may[l] > was[l];
    for (int l = 0; turns && !ends && l < LANES; l++)
        if (may[l] > was[l])
            was[l] = larger_of(was[l], farthest(a[l], rate_a[l], b[l], rate_b[l], h));
    memcpy(most, was, sizeof was);
}

typedef struct swinging_piece { /* even steps; ends: what lies between is not looked at */
    const fw_quantity_law_loads *on;
    const fw_quantity_law_oscillator *from;
    int count;
    double begin_s, end_s, steps, middle_s;
    bool ends;
} swinging_piece;

WIDE void swing_through(const swinging_piece *p, swinging *o, fw_quantity_law_seen *seen) {
    const double h = (p->end_s - p->begin_s) / p->steps;
    fw_quantity_law_row *row = seen->row;
    for (double at = 1; at <= p->steps; at++) {
        const double t = at == p->steps ? p->end_s : p->begin_s + at * h;
        loads_at(p->on, t, p->middle_s, p->from, p->count, o, 1, seen, row);
        for (int k = 0; k < p->count; k++)
            step_on(&o[k], h);
        rows_at(o, p->count, 1, seen, row);
        for (int i = 0; i < seen->n; i++) {
            look_at(&row[i], h, p->ends, seen->most + (size_t)i * LANES);
            memcpy(row[i].q[0], row[i].q[1], sizeof row[i].q[0]);
            memcpy(row[i].v[0], row[i].v[1], sizeof row[i].v[0]);
            memcpy(row[i].less[0], row[i].less[1], sizeof row[i].less[0]);
        }
        for (int k = 0; k < p->count; k++) {
            memcpy(o[k].q[0], o[k].q[1], sizeof o[k].q[0]);
            memcpy(o[k].v[0], o[k].v[1], sizeof o[k].v[0]);
            memcpy(o[k].f[0], o[k].f[1], sizeof o[k].f[0]);
        }
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void swing_through_avx2(const swinging_piece *p, swinging *o,
                                                               fw_quantity_law_seen *seen) {
    swing_through(p, o, seen);
}
#endif

/* the same numbers whatever the processor has: every lane has the same operations */
static void swing_on(const swinging_piece *p, swinging *o, fw_quantity_law_seen *seen) {
    const double h = (p->end_s - p->begin_s) / p->steps;
    for (int k = 0; k < p->count; k++)
        EACH_LANE {
            const double decay = exp(-o[k].damped[l] * h);
            o[k].c[l] = decay * cos(o[k].turn[l] * h);
            o[k].s[l] = decay * sin(o[k].turn[l] * h) / o[k].turn[l];
        }
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        swing_through_avx2(p, o, seen);
    else
#endif
        swing_through(p, o, seen);
}

/* from[k] at its frequencies; false: one does not swing. per_s: the slowest and the fastest */
static bool begin_swinging(const fw_quantity_law_oscillator *from, int count, swinging *o,
                           double per_s[2]) {
    per_s[0] = (double)INFINITY, per_s[1] = 0;
    for (int k = 0; k < count; k++) {
        const double d = from[k].damping;
        memset(&o[k], 0, sizeof o[k]);
        EACH_LANE {
            const double w = from[k].omega_per_s[l];
            if (!(d < 1) || !(w > 0)) return false;
            o[k].omega[l] = w, o[k].damped[l] = d * w, o[k].late[l] = 2 * d / w;
            o[k].turn[l] = w * sqrt(1 - d * d), o[k].v[0][l] = from[k].start_per_s;
            per_s[0] = fmin(per_s[0], w), per_s[1] = fmax(per_s[1], w);
        }
    }
    return true;
}

/* Steps in piece p, and of the fine ones at either end of it where all between is one step (0: they are all alike) */
static double steps_of_piece(const fw_quantity_law_pieces *pieces, int p, int count,
                             const double per_s[2], double *fine) {
    const double took = pieces->end_s[p] - (p ? pieces->end_s[p - 1] : 0),
                 period = 2 * FW_PI / per_s[1], longest = 2 * FW_PI / per_s[0];
    const bool straight = isinf(pieces->step_s[p]);
    const double few = straight ? 0.5 * STEPS_A_PERIOD : STEPS_A_PERIOD;
    *fine = straight && count == 1 && took > 3 * longest ? ceil(few * longest / period) : 0;
    return *fine > 0 ? 2 * *fine + 1 : ceil(took / fmin(period / few, pieces->step_s[p]));
}

/* of one oscillator alone all rows go as it does */
static double swings_of_one(const fw_quantity_law_loads *on, const fw_quantity_law_oscillator *from,
                            fw_quantity_law_seen *seen) {
    const double one = 1;
    double most[LANES];
    fw_quantity_law_seen its = {
        .by = &one, .most = most, .row = seen->row, .n = 1, .behind = seen->behind};
    const double steps = fw_quantity_law_swings_of(on, from, 1, &its);
    for (int i = 0; steps >= 0 && i < seen->n; i++)
        EACH_LANE seen->most[i * LANES + l] = fabs(seen->by[i]) * most[l];
    return steps;
}

double fw_quantity_law_swings_of(const fw_quantity_law_loads *on,
                                 const fw_quantity_law_oscillator *from, int count,
                                 fw_quantity_law_seen *seen) {
    const double most_steps = 4e6;
    const fw_quantity_law_pieces *pieces = on->pieces;
    swinging o[FW_QUANTITY_OSCILLATORS];
    double steps = 0, at = 0, per_s[2], fine;
    if (count == 1 && seen->n > 1 && !seen->less) return swings_of_one(on, from, seen);
    if (!begin_swinging(from, count, o, per_s)) return -1;
    for (int p = 0; p < pieces->n; p++)
        steps += steps_of_piece(pieces, p, count, per_s, &fine);
    if (!(steps < most_steps)) return -1;
    memset(seen->most, 0, (size_t)seen->n * LANES * sizeof *seen->most);
    rows_at(o, count, 0, seen, seen->row);
    for (int p = 0; p < pieces->n; at = pieces->end_s[p++]) {
        const double to = pieces->end_s[p], middle = 0.5 * (at + to), whole = 2 * FW_PI / per_s[0],
                     needs = steps_of_piece(pieces, p, count, per_s, &fine);
        loads_at(on, at, middle, from, count, o, 0, seen, seen->row);
        const swinging_piece part[3] = {{on, from, count, at, fine > 0 ? at + whole : to,
                                         fine > 0 ? fine : needs, middle, false},
                                        {on, from, count, at + whole, to - whole, 1, middle, true},
                                        {on, from, count, to - whole, to, fine, middle, false}};
        for (int i = 0; i < (fine > 0 ? 3 : 1); i++)
            swing_on(&part[i], o, seen);
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
