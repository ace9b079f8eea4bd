/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of the linear motion. In every cell of a grid the loads are a straight line in time, a + b
   t, which the mechanism follows by

     p(t) = W^-2 (a + b t) - W^-2 C W^-2 b      (W: frequencies, C: all modal damping)

   and about which it rings freely: z = (W r, r'), z' = [0 W; -W -C] z, exact by the exponential of
   that matrix, dampers between modes included. A cell begins with what the jump of p and p' to it
   gives to the ring. Between instants the modes of the grid are Hermite's cubic, off by
   (w h)^4/384 of their ring (w h <= 1/2: 1.6e-4); faster ones count with the size of their ring.
   Forces that depend on the motion (`source`) join the loads, at the end of a cell as they are
   after a step with those at its start: error of second order in the cell. Loads that bend by more
   than a hundredth in a cell are refused: what remains is a hundredth of their share of the motion,
   the same for every mechanism. Inputs SI; outputs rad. Cost cells times (2 modes)^2, up to 16384
   cells. Source: Duhamel's integral, Clough and Penzien, Dynamics of Structures, ch. 6; exponential
   by scaling and squaring, Moler and Van Loan, SIAM Review 45 (2003). Test: test_peaks.c. */
#include "effects/modal.h"
#include <math.h>
#include <string.h>

enum { CELLS_LEAST = 256, CELLS_MOST = 16384, PIECES_MOST = 64, MODES_MOST = 120 };
static const double step_rad = 0.25, followed_rad = 0.5, bend_most = 0.01;

typedef double pair __attribute__((vector_size(16), aligned(8)));

typedef struct walk {
    const fw_effects_modal *o;
    struct view *part; /* (modes) of what pins are deflected by */
    const fw_effects_modal_loads *modal_loads;
    fw_effects_peaks *out;
    size_t m, pins;
    double *left, *middle, *right, *sup; /* (modes) forces */
    double *z;                           /* (2 modes) */
    double *p, *slope;                   /* (modes) equilibrium that is followed, and its rate */
    double *leap, *power, *square;       /* (2 modes)^2 */
    pair *column, *rung;                 /* leap by columns, two rows at a time; leap z */
    double *rapid;              /* (modes) amplitude of a mode that is not followed, or 0 */
    double *start, *start_rate; /* (npin) followed part at the left of the cell */
    const fw_effects_peaks_source *source;
    double *load, *q, *kept; /* (modes), (modes), (4 modes): for the source */
    double h;                /* of leap */
    double bend;
    bool begun;
} walk;

static void multiply(size_t n, const double *a, const double *b, double *out) {
    for (size_t i = 0; i < n; i++) {
        double *row = out + i * n;
        memset(row, 0, n * sizeof *row);
        for (size_t k = 0; k < n; k++) {
            double f = a[i * n + k];
            if (f == 0) continue;
            for (size_t j = 0; j < n; j++)
                row[j] += f * b[k * n + j];
        }
    }
}

/* leap = exp([0 W; -W -C] h): Taylor to 14 of the 2^-s part, norm below 1/4, squared s times */
static void leap_of(walk *w, double h) {
    const fw_effects_modal *o = w->o;
    size_t m = w->m, n = 2 * m;
    double norm = 0;
    for (size_t i = 0; i < m; i++) {
        double row = o->omega[i];
        for (size_t j = 0; j < m; j++)
            row += fabs(o->damping[i * m + j]);
        norm = fmax(norm, row * h);
    }
    int squares = norm > 0.25 ? (int)ceil(log2(4 * norm)) : 0;
    double part = ldexp(h, -squares);
    memset(w->leap, 0, n * n * sizeof *w->leap);
    memset(w->power, 0, n * n * sizeof *w->power);
    for (size_t i = 0; i < n; i++)
        w->leap[i * n + i] = w->power[i * n + i] = 1;
    for (int k = 1; k <= 14; k++) { /* power = power A part / k */
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < m; j++) {
                const double *row = w->power + i * n;
                double q = -o->omega[j] * row[m + j], v = o->omega[j] * row[j];
                for (size_t l = 0; l < m; l++)
                    v -= row[m + l] * o->damping[l * m + j];
                w->square[i * n + j] = q * part / k;
                w->square[i * n + m + j] = v * part / k;
            }
        memcpy(w->power, w->square, n * n * sizeof *w->power);
        for (size_t i = 0; i < n * n; i++)
            w->leap[i] += w->power[i];
    }
    for (int s = 0; s < squares; s++) {
        multiply(n, w->leap, w->leap, w->square);
        memcpy(w->leap, w->square, n * n * sizeof *w->leap);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            w->column[(j * n + i) / 2][i % 2] = w->leap[i * n + j];
    w->h = h;
}

static void forces(walk *w, double t_s, double piece_s, double *out) {
    memset(out, 0, w->m * sizeof *out);
    for (int i = 0; i < w->modal_loads->count; i++)
        fw_effects_modal_load_at(w->o, w->modal_loads, &w->modal_loads->item[i], t_s, piece_s, out);
}

/* the ring as the cell begins: z less what the equilibrium has leapt by */
static void enter(walk *w, double h) {
    const fw_effects_modal *o = w->o;
    for (size_t j = 0; j < w->m; j++) {
        double k = o->omega[j] * o->omega[j], lag = 0, slope = (w->right[j] - w->left[j]) / h / k;
        for (size_t l = 0; l < w->m; l++)
            lag += o->damping[j * w->m + l] * (w->right[l] - w->left[l]) / h /
                   (o->omega[l] * o->omega[l]);
        double p = (w->left[j] - lag) / k, jump = o->omega[j] * (w->p[j] - p);
        double kick = w->slope[j] - slope;
        if (w->begun && !w->source) w->out->late[j] += hypot(jump, kick) / o->omega[j];
        w->z[j] += jump, w->z[w->m + j] += kick;
        w->p[j] = p, w->slope[j] = slope;
    }
    w->begun = true;
}

/* leap z, each row summed in the order of its columns; eight rows at a time stay in registers */
static void leave(walk *w, double h) {
    const size_t n = 2 * w->m;
    size_t i = 0; /* in pairs */
    for (; i + 4 <= w->m; i += 4) {
        pair a = {0}, b = {0}, c = {0}, d = {0};
        const pair *row = w->column + i;
        for (size_t j = 0; j < n; j++, row += w->m) {
            const double z = w->z[j];
            a += row[0] * z, b += row[1] * z, c += row[2] * z, d += row[3] * z;
        }
        w->rung[i] = a, w->rung[i + 1] = b, w->rung[i + 2] = c, w->rung[i + 3] = d;
    }
    for (; i < w->m; i++) {
        pair a = {0};
        for (size_t j = 0; j < n; j++)
            a += w->column[j * w->m + i] * w->z[j];
        w->rung[i] = a;
    }
    memcpy(w->z, w->rung, n * sizeof *w->z);
    for (size_t j = 0; j < w->m; j++)
        w->p[j] += h * w->slope[j];
}

static void note_rings(walk *w) {
    for (size_t j = 0; j < w->m; j++)
        w->out->ring[j] = fmax(w->out->ring[j], hypot(w->z[j], w->z[w->m + j]) / w->o->omega[j]);
}

static void source_at(walk *w, bool there, double *force) {
    for (size_t j = 0; j < w->m; j++)
        w->q[j] = w->p[j] + w->z[j] / w->o->omega[j];
    w->source->at(w->source->data, w->q, force, there, w->load);
    for (size_t j = 0; j < w->m; j++)
        force[j] += w->load[j];
}

/* what depends on the motion joins the loads: at the left as it is there, at the right as it is
   after a step in which it stays the same */
static void add_source(walk *w, double h) {
    size_t size = w->m * sizeof *w->z;
    double *z = w->kept, *p = z + 2 * w->m, *slope = p + w->m, *right = slope + w->m;
    bool begun = w->begun;
    memcpy(right, w->right, size);
    source_at(w, true, w->left);
    for (size_t j = 0; j < w->m; j++)
        w->right[j] += w->load[j];
    memcpy(z, w->z, 2 * size);
    memcpy(p, w->p, size);
    memcpy(slope, w->slope, size);
    enter(w, h);
    leave(w, h);
    memcpy(w->right, right, size);
    source_at(w, false, w->right);
    memcpy(w->z, z, 2 * size);
    memcpy(w->p, p, size);
    memcpy(w->slope, slope, size);
    w->begun = begun;
}

/* deflection of a pin: of the equilibrium, of all, and of what is followed with its rate */
typedef struct view {
    double still, all, followed, rate;
} view;

/* what modes have of each of these, the same for all pins */
static void share_out(walk *w) {
    const fw_effects_modal *o = w->o;
    for (size_t j = 0; j < w->m; j++) {
        double r = w->z[j] / o->omega[j];
        bool followed = !(w->rapid[j] > 0);
        w->part[j] = (view){w->p[j], w->p[j] + r, w->p[j] + (followed ? r : 0),
                            w->slope[j] + (followed ? w->z[w->m + j] : 0)};
    }
}

static view deflection_of(const walk *w, size_t pin) {
    const fw_effects_modal *o = w->o;
    double drawn = fw_effects_pin_deflection(o->mechanism, (int)pin);
    view v = {drawn, drawn, drawn, 0};
    for (size_t j = 0; j < w->m; j++) {
        double turn = o->turn[j * w->pins + pin];
        const view *part = &w->part[j];
        v.still += turn * part->still, v.all += turn * part->all;
        v.followed += turn * part->followed, v.rate += turn * part->rate;
    }
    return v;
}

/* largest |value| of the cubic from a to b with the slopes s and t over a cell of 1 */
static double cubic_most(double a, double b, double s, double t) {
    double c3 = 2 * (a - b) + s + t, c2 = 3 * (b - a) - 2 * s - t;
    double most = fmax(fabs(a), fabs(b)), root = c2 * c2 - 3 * c3 * s;
    if (!(root > 0)) return most;
    double q = -(c2 + copysign(sqrt(root), c2));
    const double at[2] = {c3 != 0 ? q / (3 * c3) : -1, q != 0 ? s / q : -1};
    for (int i = 0; i < 2; i++)
        if (at[i] > 0 && at[i] < 1)
            most = fmax(most, fabs(a + at[i] * (s + at[i] * (c2 + at[i] * c3))));
    return most;
}

/* the next cell begins at the same instant, where a load that was looked at last need not be looked at again */
static void cell(walk *w, double t, double end, double h, double piece) {
    forces(w, t, piece, w->left);
    forces(w, t + 0.5 * h, piece, w->middle);
    forces(w, end, piece, w->right);
    for (size_t j = 0; j < w->m; j++) {
        w->sup[j] = fmax(w->sup[j], fmax(fabs(w->left[j]), fabs(w->right[j])));
        double bend = fabs(w->middle[j] - 0.5 * (w->left[j] + w->right[j]));
        if (bend > bend_most * w->sup[j]) w->bend = fmax(w->bend, bend);
    }
    if (w->source) add_source(w, h);
    enter(w, h);
    note_rings(w);
    share_out(w);
    for (size_t i = 0; i < w->pins; i++) {
        view v = deflection_of(w, i);
        w->start[i] = v.followed, w->start_rate[i] = v.rate;
        w->out->still[i] = fmax(w->out->still[i], fabs(v.still));
        w->out->low[i] = fmax(w->out->low[i], fabs(v.all));
    }
    leave(w, h);
    note_rings(w);
    share_out(w);
    for (size_t i = 0; i < w->pins; i++) {
        view v = deflection_of(w, i);
        double most = cubic_most(w->start[i], v.followed, h * w->start_rate[i], h * v.rate);
        w->out->still[i] = fmax(w->out->still[i], fabs(v.still));
        w->out->low[i] = fmax(w->out->low[i], fabs(v.all));
        w->out->high[i] = fmax(w->out->high[i], most);
    }
}

static void walk_on(walk *w, const double *t_s, int count, double longest) {
    double from = 0;
    double *zero[] = {w->p, w->slope, w->z, w->sup, w->out->ring, w->out->late, w->rapid};
    for (size_t i = 0; i < sizeof zero / sizeof zero[0]; i++)
        memset(zero[i], 0, w->m * sizeof *w->z);
    double *none[] = {w->out->low, w->out->high, w->out->still, w->out->rapid_rad};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        memset(none[i], 0, w->pins * sizeof *w->z);
    for (size_t j = 0; j < w->m; j++)
        w->rapid[j] = w->o->omega[j] * longest > followed_rad;
    if (w->source) memcpy(w->out->late, w->source->late, w->m * sizeof *w->z);
    w->bend = 0;
    memcpy(w->z + w->m, w->o->velocity, w->m * sizeof *w->z);
    w->begun = false;
    for (int i = 0; i < count; i++) {
        int cells = 1 + (int)((t_s[i] - from) / longest);
        double h = (t_s[i] - from) / cells;
        if (!(fabs(h - w->h) <= 1e-9 * h)) leap_of(w, h);
        for (int k = 0; k < cells; k++)
            cell(w, from + h * k, from + h * (k + 1), h, 0.5 * (from + t_s[i]));
        from = t_s[i];
    }
}

static fw_status room(fw_arena *arena, walk *w) {
    size_t m = w->m, n = 2 * m;
    double **of[] = {&w->left, &w->middle, &w->right,  &w->sup,   &w->p,    &w->slope, &w->z,
                     &w->leap, &w->power,  &w->square, &w->rapid, &w->load, &w->q,     &w->kept};
    const size_t size[] = {m, m, m, m, m, m, n, n * n, n * n, n * n, m, m, m, n + 3 * m};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, size[i]));
    FW_NEED(w->column = fw_arena_array(arena, pair, n * m));
    FW_NEED(w->rung = fw_arena_array(arena, pair, m));
    FW_NEED(w->part = fw_arena_array(arena, view, m));
    FW_NEED(w->start = fw_arena_array(arena, double, w->pins));
    FW_NEED(w->start_rate = fw_arena_array(arena, double, w->pins));
    return FW_OK;
}

static void add_rapid(walk *w, const double *amplitude) {
    for (size_t j = 0; j < w->m; j++) {
        if (!(w->rapid[j] > 0)) continue;
        /* whatever the phases of its kicks */
        double ring = w->out->ring[j] + w->out->late[j];
        if (amplitude) ring = fmin(ring, amplitude[j]);
        for (size_t i = 0; i < w->pins; i++)
            w->out->rapid_rad[i] += fabs(w->o->turn[j * w->pins + i]) * ring;
    }
}

static fw_status new_peaks(fw_arena *arena, size_t modes, size_t pins, fw_effects_peaks *peaks) {
    *peaks = (fw_effects_peaks){0};
    FW_NEED(peaks->low = fw_arena_array(arena, double, pins));
    FW_NEED(peaks->high = fw_arena_array(arena, double, pins));
    FW_NEED(peaks->still = fw_arena_array(arena, double, pins));
    FW_NEED(peaks->rapid_rad = fw_arena_array(arena, double, pins));
    FW_NEED(peaks->ring = fw_arena_array(arena, double, modes));
    FW_NEED(peaks->late = fw_arena_array(arena, double, modes));
    return FW_OK;
}

fw_status fw_effects_peaks_find(fw_arena *arena, const fw_effects_modal *o,
                                const fw_effects_modal_loads *modal_loads, double fastest,
                                const double *amplitude, const fw_effects_peaks_source *source,
                                fw_effects_peaks *peaks) {
    walk w = {.o = o,
              .modal_loads = modal_loads,
              .out = peaks,
              .source = source,
              .m = (size_t)o->modes,
              .pins = (size_t)o->mechanism->npin};
    double *t_s, end = o->scene->duration_s;
    double longest = fmax(fmin(end / CELLS_LEAST, step_rad / fastest), end / CELLS_MOST);
    int count;
    FW_TRY(new_peaks(arena, w.m, w.pins, peaks));
    if (o->modes > MODES_MOST) peaks->why_not = "it has too many modes";
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(fw_effects_modal_loads_breaks(arena, o, modal_loads, &t_s, &count));
    if (count < 0 || count > PIECES_MOST) peaks->why_not = "its loads break too often";
    if (peaks->why_not) return FW_OK;
    FW_TRY(room(arena, &w));
    walk_on(&w, t_s, count, longest);
    for (; w.bend > 0 && longest > end / CELLS_MOST; walk_on(&w, t_s, count, longest))
        longest = fmax(0.25 * longest, end / CELLS_MOST);
    add_rapid(&w, amplitude);
    for (size_t i = 0; i < w.pins; i++) {
        peaks->low[i] = fmax(peaks->low[i], peaks->high[i] - peaks->rapid_rad[i]);
        peaks->high[i] += peaks->rapid_rad[i];
        for (size_t j = 0; j < w.m; j++)
            if (!(w.rapid[j] > 0))
                peaks->high[i] += fabs(o->turn[j * w.pins + i]) * peaks->ring[j] *
                                  pow(o->omega[j] * longest, 4) / 384;
        if (!isfinite(peaks->high[i])) peaks->why_not = "its motion is not finite";
    }
    if (w.bend > 0) peaks->why_not = "its loads change too fast to be followed";
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
