/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What loads the modes over a scene, and how much of it there is. */
#include "base/sort.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BREAKS_MOST = 1024, CELLS = 2048 };

static void to_modes(const fw_effects_modal *o, const double *force, double *mode) {
    for (int j = 0; j < o->modes; j++)
        for (int i = 0; i < o->n; i++)
            mode[j] += o->shape[(size_t)j * (size_t)o->n + (size_t)i] * force[i];
}

/* Where the bodies are drawn the force of an element depends on time by its laws alone: as long as these have the values
   that they had, so has it. It takes most of the time of what follows a motion in modes. */
static void of_element(const fw_effects_modal *o, const fw_effects_modal_loads *p,
                       const fw_effects_modal_load *l, double t_s, double piece_s) {
    const fw_effects_force_element *e = l->element;
    double value[3 * FW_ELEMENT_LAWS] = {0};
    const size_t size = 3 * (size_t)e->laws * sizeof *value;
    for (int i = 0; i < e->laws; i++)
        fw_quantity_law_value(e->law[i], t_s, piece_s, value + 3 * i);
    if (memcmp(value, l->seen, size) == 0) return;
    memcpy(l->seen, value, size);
    memset(p->work, 0, (size_t)o->n * sizeof *p->work);
    fw_effects_loads_element_force(o->mechanism, e, t_s, piece_s, p->work);
    memset(l->seen_mode, 0, (size_t)o->modes * sizeof *l->seen_mode);
    to_modes(o, p->work, l->seen_mode);
}

void fw_effects_modal_load_at(const fw_effects_modal *o, const fw_effects_modal_loads *p,
                              const fw_effects_modal_load *modal_load, double t_s, double piece_s,
                              double *force) {
    double value[3] = {1, 0, 0};
    if (modal_load->element) {
        of_element(o, p, modal_load, t_s, piece_s);
        for (int j = 0; j < o->modes; j++)
            force[j] += modal_load->seen_mode[j];
        return;
    }
    if (modal_load->law) fw_quantity_law_value(modal_load->law, t_s, piece_s, value);
    for (int j = 0; j < o->modes; j++)
        force[j] += value[0] * modal_load->mode[j];
}

static bool gather(const fw_quantity_law *law, double end_s, double *t_s, int *have) {
    int more = fw_quantity_law_breaks_of(law, end_s, t_s + *have, BREAKS_MOST - *have);
    if (more > BREAKS_MOST - *have) return false;
    *have += more;
    return true;
}

static bool breaks_of(const fw_effects_modal_load *modal_load, double end_s, double *t_s,
                      int *have) {
    if (modal_load->law && !gather(modal_load->law, end_s, t_s, have)) return false;
    for (int i = 0; modal_load->element && i < modal_load->element->laws; i++)
        if (!gather(modal_load->element->law[i], end_s, t_s, have)) return false;
    return true;
}

/* sorted, each once, the end behind them; -1: too many */
static int pieces(const fw_effects_modal_load *modal_load, int count, double end_s, double *t_s) {
    int have = 0, kept = 0;
    for (int i = 0; i < count; i++)
        if (!breaks_of(&modal_load[i], end_s, t_s, &have)) return -1;
    fw_sort_doubles(t_s, (size_t)have);
    for (int i = 0; i < have; i++)
        if (t_s[i] > 0 && t_s[i] < end_s && (kept == 0 || t_s[i] > t_s[kept - 1]))
            t_s[kept++] = t_s[i];
    t_s[kept++] = end_s;
    return kept;
}

fw_status fw_effects_modal_loads_breaks(fw_arena *arena, const fw_effects_modal *o,
                                        const fw_effects_modal_loads *p, double **t_s, int *count) {
    FW_NEED(*t_s = fw_arena_array(arena, double, BREAKS_MOST + 1));
    *count = pieces(p->item, p->count, o->scene->duration_s, *t_s);
    return FW_OK;
}

/* ---- how much ---- */

typedef struct tally { /* of one modal force, as samples come in */
    double last, second_last, fine, coarse, full, sup, first;
    int samples;
} tally;

static void count_sample(tally *t, double value, double h, bool new_piece) {
    if (t->samples == 0) {
        *t = (tally){.last = value, .second_last = value, .sup = fabs(value), .first = fabs(value)};
        t->samples = 1;
        return;
    }
    t->fine += fabs(value - t->last);
    t->full += 0.5 * h * (fabs(value) + fabs(t->last));
    t->sup = fmax(t->sup, fabs(value));
    t->last = value;
    t->samples = new_piece ? 1 : t->samples + 1;
    if (new_piece || t->samples % 2 == 1) {
        t->coarse += fabs(value - t->second_last);
        t->second_last = value;
    }
}

/* Total variation by samples is too small by what lies between them; where half as many samples say
   nearly the same the difference is added, and where they do not the variation is not known. The
   integral of the size is off by at most variation times the cell. */
static void conclude(const fw_effects_modal *o, const fw_effects_modal_load *modal_load,
                     const tally *t, int j) {
    double end = o->scene->duration_s, gap = t->fine - t->coarse;
    modal_load->sup[j] = t->sup + gap;
    modal_load->first[j] = t->first;
    modal_load->sway[j] = t->fine + gap;
    if (gap > 0.05 * t->fine) modal_load->sway[j] = (double)INFINITY;
    if (modal_load->law) {
        double size = fabs(modal_load->mode[j]);
        modal_load->sup[j] = fmax(t->sup, size * fw_quantity_law_largest(modal_load->law, end));
        if (modal_load->law->kind->variation)
            modal_load->sway[j] = size * modal_load->law->kind->variation(modal_load->law, end);
        if (!isfinite(modal_load->sway[j])) modal_load->sup[j] *= 1.1;
    }
    modal_load->full[j] =
        fmin(modal_load->sup[j] * end, t->full + modal_load->sway[j] * end / CELLS * 2);
}

static fw_status measure(fw_arena *arena, const fw_effects_modal *o, fw_effects_modal_loads *p,
                         const fw_effects_modal_load *modal_load) {
    size_t m = (size_t)o->modes;
    double *value, *t_s, from = 0, end = o->scene->duration_s;
    tally *t;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(value = fw_arena_array(arena, double, m));
    FW_NEED(t = fw_arena_array(arena, tally, m));
    FW_NEED(t_s = fw_arena_array(arena, double, BREAKS_MOST + 1));
    int count = pieces(modal_load, 1, end, t_s);
    if (count < 0) p->why_not = "a law breaks too often";
    for (int i = 0; i < count; i++) {
        double middle = 0.5 * (from + t_s[i]), span = t_s[i] - from;
        int cells =
            modal_load->law || modal_load->element ? 4 + 2 * (int)(0.5 * CELLS * span / end) : 2;
        for (int k = 0; k <= cells; k++) {
            double at = k == cells ? t_s[i] : from + span * k / cells;
            memset(value, 0, m * sizeof *value);
            fw_effects_modal_load_at(o, p, modal_load, at, middle, value);
            for (size_t j = 0; j < m; j++) {
                if (!isfinite(value[j])) p->why_not = "a load is not finite";
                count_sample(&t[j], value[j], k ? span / cells : 0, k == 0);
            }
        }
        from = t_s[i];
    }
    for (int j = 0; j < o->modes; j++)
        conclude(o, modal_load, &t[j], j);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- the list ---- */

static fw_status add(fw_arena *arena, const fw_effects_modal *o, fw_effects_modal_loads *p,
                     const fw_quantity_law *law, const fw_effects_force_element *element) {
    size_t m = (size_t)o->modes;
    fw_effects_modal_load *modal_load = &p->item[p->count++];
    *modal_load = (fw_effects_modal_load){.law = law, .element = element};
    FW_NEED(modal_load->force = fw_arena_array(arena, double, (size_t)o->n));
    FW_NEED(modal_load->mode = fw_arena_array(arena, double, m));
    double **of[4] = {&modal_load->sup, &modal_load->first, &modal_load->sway, &modal_load->full};
    for (int i = 0; i < 4; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, m));
    if (!element) return FW_OK;
    FW_NEED(modal_load->seen_mode = fw_arena_array(arena, double, m));
    FW_NEED(modal_load->seen = fw_arena_array(arena, double, 3 * FW_ELEMENT_LAWS));
    for (int i = 0; i < 3 * FW_ELEMENT_LAWS; i++)
        modal_load->seen[i] = (double)NAN;
    return FW_OK;
}

/* one timed load with the factor 1 */
static void of_load(const fw_effects_modal *o, const fw_effects_timed_load *l, double *force) {
    const fw_mechanism_mass *b = &o->mechanism->body[l->body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    double x = c * l->x_m - s * l->y_m, y = s * l->x_m + c * l->y_m;
    force[3 * l->body] += l->fx_N;
    force[3 * l->body + 1] += l->fy_N;
    force[3 * l->body + 2] += x * l->fy_N - y * l->fx_N + l->torque_Nm;
}

fw_status fw_effects_modal_loads_find(fw_arena *arena, const fw_effects_modal *o,
                                      fw_effects_modal_loads *p) {
    const fw_effects_loads *loads = o->loads;
    *p = (fw_effects_modal_loads){0};
    size_t most = 3 + (size_t)loads->ntimed + (size_t)loads->nelement;
    FW_NEED(p->item = fw_arena_array(arena, fw_effects_modal_load, most));
    FW_NEED(p->work = fw_arena_array(arena, double, (size_t)o->n));
    fw_effects_loads still = *loads;
    still.ntimed = still.nelement = 0;
    FW_TRY(add(arena, o, p, NULL, NULL));
    fw_effects_loads_initial_force(o->mechanism, &still, p->item[0].force);
    for (int i = 0; i < loads->ntimed; i++) {
        FW_TRY(add(arena, o, p, loads->timed[i].law, NULL));
        of_load(o, &loads->timed[i], p->item[p->count - 1].force);
    }
    for (int i = 0; i < loads->nelement; i++) {
        const fw_effects_force_element *e = &loads->element[i];
        if (e->laws > 0)
            FW_TRY(add(arena, o, p, NULL, e));
        else
            fw_effects_loads_element_force(o->mechanism, e, 0, DBL_MIN, p->item[0].force);
    }
    for (int i = 0; i < 2; i++)
        if (o->shift[i]) {
            FW_TRY(add(arena, o, p, i ? loads->stretch.law : NULL, NULL));
            p->item[p->count - 1].shift = true;
            memcpy(p->item[p->count - 1].force, o->shift_force[i], (size_t)o->n * sizeof(double));
        }
    for (int i = 0; i < p->count; i++) {
        to_modes(o, p->item[i].force, p->item[i].mode);
        FW_TRY(measure(arena, o, p, &p->item[i]));
    }
    return FW_OK;
}

/* How large the largest hinge deflection of a scene is at least: the linear motion, damped mode by
   mode, at some hundred instants. The value at any instant is a lower bound of the maximum; what
   the linear motion may be wrong by there is taken off. */

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
    double *travel;                /* (modes) largest translation of a body per length of the
                                      mechanism: what turns a billion times less is rounding */
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
    double rounding = 0;
    for (size_t j = 0; j < (size_t)o->modes; j++) {
        swing *x = &w->mode[j];
        x->nonlinearity_of =
            x->off + x->size * fmin(2, w->nonlinearity * (1 + 0.5 * o->omega[j] * t));
        rounding += 1e-9 * w->travel[j] * x->size;
    }
    for (size_t i = 0; i < pins; i++) {
        double angle = w->free_rad[i] + fw_effects_modal_shifted(o, (int)i, t, piece),
               off = w->second + rounding;
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
   both as impulses, and an error of the frequencies and the geometry of `nonlinearity`. Output rad,
   0 where nothing is sure. Cost some 600 cells times modes (pins + modal loads). Source: Duhamel's
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
    FW_NEED(w.travel = fw_arena_array(arena, double, m));
    for (size_t j = 0; j < m; j++) {
        w.mode[j].v = o->velocity[j];
        for (int k = 0; k < o->n; k++)
            if (k % 3 != 2)
                w.travel[j] = fmax(w.travel[j], fabs(o->shape[j * (size_t)o->n + (size_t)k]));
        w.travel[j] /= o->linear.length_m;
    }
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

/* What dampers do to the modes: |C q'| with C between the modes and the envelope's modal speed of
   each; a share u of the fastest rate on every torsion, u the nonlinearity estimate of the
   envelope, because motions that are not linear turn what linear theory leaves at rest. Hinges that
   give dissipate in all directions: their elements are part of `loads`. Inputs and outputs SI.
   Test: test_bounds.c, test_hinge_bounds.c. */

fw_status fw_effects_envelope_dampers(const fw_effect_case *c, const fw_effects_loads *loads,
                                      double *mode) {
    const fw_effects_envelope *e = c->envelope;
    size_t m = (size_t)e->modes, pins = (size_t)e->npin;
    double *damping, fastest = 0, nonlinearity = 0.25 * (e->margin - 1);
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(damping = fw_arena_array(c->arena, double, m *m));
    FW_TRY(fw_effects_modal_damping(c->arena, e->modal, loads, damping));
    for (size_t i = 0; i < pins; i++)
        fastest = fmax(fastest, e->rate[i]);
    for (size_t j = 0; j < m; j++) {
        for (size_t l = 0; l < m; l++)
            mode[j] += fabs(damping[j * m + l]) * e->modal_speed[l] * e->margin;
        for (int i = 0; i < loads->ntorsion; i++)
            mode[j] += fabs(e->turn[j * pins + (size_t)loads->torsion[i].pin]) *
                       loads->torsion[i].damping_Nms_per_rad * fastest * nonlinearity;
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}
