/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large the largest hinge deflection of a scene is at least: the linear motion, damped mode by
   mode, at some hundred instants. The value at any instant is a lower bound of the maximum; what
   the linear motion may be wrong by there is taken off. */
#include "effects/modal.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { EARLY = 256, LATE = 256, PER_PIECE = 4, PIECES_MOST = 400 };

typedef struct swing {      /* a mode on its way */
    double q, v, off, size; /* off: what it may be wrong by; size: its largest |q| so far */
    double c, s;            /* decay over a cell of the present length */
    double nonlinearity_of; /* what it may be wrong by with the error of its frequency */
} swing;

typedef struct walk {
    const fw_effects_modal *o;
    const fw_effects_modal_loads *modal_loads;
    swing *mode;                   /* (modes) */
    double *left, *middle, *right; /* (modes) forces in a cell */
    double *free_rad;              /* (npin) deflection as drawn */
    double nonlinearity, best, second;
    bool constant; /* no modal load has a law: left, middle and right are all the same */
} walk;

/* e^(-g t) cosh or cos of w t, and sinh or sin over w; w^2 = g^2 - omega^2 */
static void decay(double omega, double g, double t, double *c, double *s) {
    double square = (g - omega) * (g + omega), w = sqrt(fabs(square));
    if (w * t < 1e-4) {
        *c = exp(-g * t), *s = t * *c;
    } else if (square < 0) {
        *c = exp(-g * t) * cos(w * t), *s = exp(-g * t) * sin(w * t) / w;
    } else { /* g - w without cancellation: omega^2 / (g + w) */
        double slow = exp(-omega * omega / (g + w) * t), fast = exp(-(g + w) * t);
        *c = 0.5 * (slow + fast), *s = 0.5 * (slow - fast) / w;
    }
}

/* q'' + 2 g q' + omega^2 q = a + b t, exact over a cell */
static void swing_on(swing *x, double omega, double g, double a, double b, double h) {
    double k = omega * omega, p = a / k - 2 * g * b / (k * k), c = x->c, s = x->s;
    double q = x->q - p, v = x->v - b / k;
    x->q = (c + g * s) * q + s * v + p + b / k * h;
    x->v = -k * s * q + (c - g * s) * v + b / k;
}

static void forces(walk *w, double t_s, double piece_s, double *out) {
    memset(out, 0, (size_t)w->o->modes * sizeof *out);
    for (int i = 0; i < w->modal_loads->count; i++)
        fw_effects_modal_load_at(w->o, w->modal_loads, &w->modal_loads->item[i], t_s, piece_s, out);
}

static void cell(walk *w, double t, double h, double piece) {
    const fw_effects_modal *o = w->o;
    size_t m = (size_t)o->modes;
    if (!w->constant) {
        forces(w, t, piece, w->left);
        forces(w, t + 0.5 * h, piece, w->middle);
        forces(w, t + h, piece, w->right);
    }
    for (size_t j = 0; j < m; j++) {
        swing *x = &w->mode[j];
        double omega = o->omega[j], a = w->left[j], b = (w->right[j] - a) / h, others = 0;
        /* not straight in the cell; and dampers that joint modes together */
        double bent = fabs(w->middle[j] - 0.5 * (a + w->right[j]));
        for (size_t l = 0; l < m; l++)
            if (l != j) others += fabs(o->damping[j * m + l]) * fabs(w->mode[l].v);
        x->off += h * (bent + others) / omega;
        swing_on(x, omega, 0.5 * o->damping[j * m + j], a, b, h);
        x->size = fmax(x->size, fabs(x->q));
    }
}

/* what every hinge is deflected by for sure */
static void see(walk *w, double t, double piece) {
    const fw_effects_modal *o = w->o;
    size_t pins = (size_t)o->mechanism->npin;
    for (size_t j = 0; j < (size_t)o->modes; j++) {
        swing *x = &w->mode[j];
        x->nonlinearity_of =
            x->off + x->size * fmin(2, w->nonlinearity * (1 + 0.5 * o->omega[j] * t));
    }
    for (size_t i = 0; i < pins; i++) {
        double angle = w->free_rad[i] + fw_effects_modal_shifted(o, (int)i, t, piece),
               off = w->second;
        for (size_t j = 0; j < (size_t)o->modes; j++) {
            const swing *x = &w->mode[j];
            double turn = o->turn[j * pins + i];
            angle += turn * x->q;
            off += fabs(turn) * x->nonlinearity_of;
        }
        double sure = fabs(angle) - off;
        if (isfinite(off) && sure > w->best) w->best = sure;
    }
}

static void walk_piece(walk *w, double from, double to, double early) {
    double end = w->o->scene->duration_s, middle = 0.5 * (from + to);
    for (int half = 0; half < 2; half++) { /* the first swings finer than the rest */
        double a = half ? fmax(from, early) : from, b = half ? to : fmin(to, early);
        if (!(b > a)) continue;
        double share = half ? (b - a) / (end - early) * LATE : (b - a) / early * EARLY;
        int cells = PER_PIECE + (int)share;
        double h = (b - a) / cells;
        for (size_t j = 0; j < (size_t)w->o->modes; j++) {
            swing *x = &w->mode[j];
            decay(w->o->omega[j], 0.5 * w->o->damping[j * (size_t)w->o->modes + j], h, &x->c,
                  &x->s);
        }
        for (int k = 0; k < cells; k++) {
            double t = a + (b - a) * k / cells;
            cell(w, t, h, middle);
            see(w, t + h, middle);
        }
    }
}

/* Modal equations q'' + c_jj q' + omega^2 q = f(t), f a straight line in every cell (exact for
   steps, ramps and tables); taken off are: the bend of f in the cells, the damping between modes,
   both as impulses, and an error of the frequencies and the geometry of `nonlinearity`. Output
   rad, 0
   where nothing is sure. Cost some 600 cells times modes (pins + modal loads). Source: Duhamel's
   integral; Clough and Penzien, Dynamics of Structures, ch. 6. Test: test_envelope.c. */
fw_status fw_effects_modal_floor(fw_arena *arena, const fw_effects_modal *o,
                                 const fw_effects_modal_loads *modal_loads, double nonlinearity,
                                 double *floor_rad) {
    size_t m = (size_t)o->modes;
    walk w = {.o = o,
              .modal_loads = modal_loads,
              .nonlinearity = nonlinearity,
              .second = fw_effects_modal_second(o)};
    double *t_s, from = 0, end = o->scene->duration_s, early = fmin(end, 14 / o->omega[0]);
    int count;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(w.mode = fw_arena_array(arena, swing, m));
    FW_NEED(w.left = fw_arena_array(arena, double, m));
    FW_NEED(w.middle = fw_arena_array(arena, double, m));
    FW_NEED(w.right = fw_arena_array(arena, double, m));
    FW_NEED(w.free_rad = fw_arena_array(arena, double, (size_t)o->mechanism->npin));
    for (int i = 0; i < o->mechanism->npin; i++)
        w.free_rad[i] = fw_effects_pin_deflection(o->mechanism, i);
    for (size_t j = 0; j < m; j++)
        w.mode[j].v = o->velocity[j];
    FW_TRY(fw_effects_modal_loads_breaks(arena, o, modal_loads, &t_s, &count));
    w.constant = true;
    for (int i = 0; i < modal_loads->count; i++)
        w.constant = w.constant && !modal_loads->item[i].law && !modal_loads->item[i].element;
    if (w.constant) {
        forces(&w, 0, 0, w.left);
        forces(&w, 0, 0, w.middle);
        forces(&w, 0, 0, w.right);
    }
    see(&w, 0, DBL_MIN);
    for (int i = 0; i < count && count <= PIECES_MOST; i++) {
        walk_piece(&w, from, t_s[i], early);
        from = t_s[i];
    }
    *floor_rad = w.best;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
