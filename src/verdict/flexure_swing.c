/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What flexures weigh. Motions have all mass in bodies, and flexures between these as springs. Here modes of a device at rest are
   found with it and without: places u of all masses by loads f are u = C f, and with L L^T the compliance of the bodies as
   flexures hold them, N how the parts of a flexure go with its ends, and psi, lambda = 1/omega^2 how they swing between
   ends that are held (fw_flexure_own_of)

     C = B B^T + rest,   B = (N L, psi lambda^1/2),   G = B^T M B

   eigenvalues of G are the 1/omega^2 of the modes, of shapes B y/mu^1/2, and rest, what psi leaves out, adds its largest to each at
   most (Weyl). A body whose mass is that of its drawing has the nearer halves of its flexures in it; they are taken out of it first.

   What an acceleration a f(t) of the carrier does is the sum over modes of a Gamma/omega^2 A(omega) times what a mode strains or
   moves, A the largest answer of an oscillator (fw_quantity_law_swing). With flexures' mass less without it, both added
   without signs, is what the motion lacks. omega lies where it is found, as far as flexures' stiffness may be off where a mode
   is one of flexures alone, and up to where the motion has that mode: of most A counts, and of least A what the motion has too much.
   In: mechanism as drawn. Out: strains, m. Range: flexures with an axis, small motions, nothing else that holds bodies.
   Error: 12 % of what flexures bear by themselves is added for modes that are left out. Cost: 0.2 ms a flexure of its own kind; of laws
   24 steps a period of each mode. Source: R. Craig, M. Bampton, AIAA J. 6 (1968) 1313; H. Weyl, Math. Ann. 71 (1912) 441.
   Theory: docs/theory/verdict.md, 5h. Test: test_out_of_plane.py FlexuresWeigh */
#include "base/constants.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

enum { WAYS = 2 };

typedef struct weighed { /* a device in the plane, or across it */
    const fw_mechanism *m;
    const fw_mechanism_plates *p;
    bool across;
    const fw_flexure_own **own; /* (nhinge); NULL: flexures weigh nothing */
    double *l;                  /* (n x n) row i: of coordinate i, L */
    int n, rows;
    double *s2, *y; /* (rows) 1/omega^2, the largest first; its y in row k */
    double *place;  /* (rows x n) of mode k */
    double *swing;  /* (rows x OWN nhinge) of it, in the flexures' own modes */
    double *push;   /* (rows x WAYS) Gamma: by an acceleration along x and y, or z */
    double rest_s2;
} weighed;

/* ---- places of a flexure's parts ---- */

typedef struct part_row { /* one coordinate of a part by those of two bodies */
    int body[2];          /* first, second */
    double by[2][3], rigid[2][3], mass, way[WAYS];
} part_row;

/* a displacement of a body at a place, in a flexure's frame: (turn, x, y), or (z, turns about x, y), by its coordinates */
static void at_place(const weighed *d, int body, fw_geometry_vec2 at, double axis_rad,
                     double to[3][3]) {
    const double c = cos(axis_rad), s = sin(axis_rad);
    memset(to, 0, 9 * sizeof(double));
    if (body == FW_GROUND) return;
    const double x = at.x - d->m->drawn[body].x_m, y = at.y - d->m->drawn[body].y_m;
    if (d->across) {
        const double rows[3][3] = {{1, y, -x}, {0, c, s}, {0, -s, c}};
        memcpy(to, rows, sizeof rows);
    } else {
        const double rows[3][3] = {{0, 0, 1}, {c, s, s * x - c * y}, {-s, c, c * x + s * y}};
        memcpy(to, rows, sizeof rows);
    }
}

/* coordinate d of a part by a displacement of that place */
static void of_place(const weighed *d, const fw_flexure_own *own, int part, int which,
                     const double at[3][3], double to[3]) {
    const double *way = own->way[part];
    for (int k = 0; k < 3; k++)
        to[k] = !d->across   ? at[1 + which][k]
                : which == 0 ? at[0][k]
                             : way[0] * at[1][k] + way[1] * at[2][k];
}

/* its bodies, that at the strip's first end first: where it is not drawn, by where they lie */
static void ends_of(const fw_mechanism *m, int k, int body[2]) {
    const fw_mechanism_hinge *h = &m->hinge[k];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    const int is[2] = {pin->body_a, pin->body_b};
    double far[2] = {0};
    bool first = h->first_is_a;
    for (int i = 0; i < 2; i++)
        if (is[i] != FW_GROUND) {
            const fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, i);
            far[i] = (m->drawn[is[i]].y_m - at.y) * cos(h->axis_rad) -
                     (m->drawn[is[i]].x_m - at.x) * sin(h->axis_rad);
        }
    if (!m->layout || !m->layout->drawn || !m->layout->hinge[h->pin].drawn)
        first = far[1] >= far[0];
    body[0] = is[!first], body[1] = is[first];
}

static void row_of(const weighed *d, int k, int part, int which, part_row *to) {
    const fw_mechanism *m = d->m;
    const fw_mechanism_hinge *h = &m->hinge[k];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    const fw_flexure_own *own = d->own[k];
    const fw_geometry_vec2 at_pin = fw_mechanism_pin_place(m, pin, 0),
                           off = {own->at_m[part][0] - h->closed_form.centre_m -
                                      h->closed_form.offset_m[0],
                                  own->at_m[part][1] - h->closed_form.offset_m[1]},
                           at = vec_add(at_pin, fw_geometry_vec_rotate(off, h->axis_rad));
    double place[3][3], ends[2][3][3];
    ends_of(m, k, to->body);
    to->mass = own->mass[part][which];
    to->way[0] = !d->across ? (which ? -sin(h->axis_rad) : cos(h->axis_rad)) : which == 0;
    to->way[1] = d->across ? 0 : which ? cos(h->axis_rad) : sin(h->axis_rad);
    for (int side = 0; side < 2; side++) {
        at_place(d, to->body[side], at, h->axis_rad, place);
        of_place(d, own, part, which, (const double(*)[3])place, to->rigid[side]);
        at_place(d, to->body[side], at_pin, h->axis_rad, ends[side]);
    }
    for (int i = 0; i < 3; i++) {
        to->by[0][i] = to->rigid[0][i], to->by[1][i] = 0;
        for (int j = 0; j < 3; j++) {
            to->by[0][i] -= own->goes[part][which][j] * ends[0][j][i];
            to->by[1][i] += own->goes[part][which][j] * ends[1][j][i];
        }
    }
}

/* the mass of a body is that of its drawing, halves of flexures and all */
static bool has_halves(const fw_mechanism *m, int body) {
    const double same = 1e-6, drawn = m->variant->material.density.value * m->variant->thickness_m *
                                      m->shape[body].area_m2;
    return fabs(m->body[body].mass_kg - drawn) < same * drawn;
}

/* ---- modes ---- */

static void add_form(double by, const double *v, const double *w, int count, double *g) {
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            g[i * count + j] += 0.5 * by * (v[i] * w[j] + w[i] * v[j]);
}

/* L^T of a row that stands at two bodies' coordinates */
static void by_root(const weighed *d, const int body[2], const double by[2][3], double *v) {
    memset(v, 0, (size_t)d->rows * sizeof *v);
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 3 && body[side] != FW_GROUND; i++) {
            const int at = 3 * body[side] + i;
            for (int j = 0; j <= at; j++)
                v[j] += by[side][i] * d->l[at * d->n + j];
        }
}

static void add_bodies(const weighed *d, double *v, double *g, double *push) {
    const fw_mechanism *m = d->m;
    double *w = v + d->rows;
    for (int b = 0; b < m->nbody; b++) {
        const double kg = m->body[b].mass_kg,
                     flat[9] = {kg, 0, 0, 0, kg, 0, 0, 0, m->body[b].inertia_kg_m2},
                     *mass = d->across ? d->p->mass + 9 * b : flat;
        const int body[2] = {b, FW_GROUND};
        for (int i = 0; i < 9; i++) {
            const double row[2][3] = {{i / 3 == 0, i / 3 == 1, i / 3 == 2}},
                         column[2][3] = {{i % 3 == 0, i % 3 == 1, i % 3 == 2}};
            if (mass[i] == 0) continue;
            by_root(d, body, row, v), by_root(d, body, column, w);
            add_form(mass[i], v, w, d->rows, g);
            if (i == 0 || (i == 4 && !d->across))
                for (int k = 0; k < d->rows; k++)
                    push[k * WAYS + i / 4] += mass[i] * v[k];
        }
    }
}

static void add_strip(const weighed *d, int k, double *v, double *g, double *push) {
    const fw_flexure_own *own = d->own[k];
    const double scale = d->m->hinge[k].scale;
    for (int i = 0; i < 2 * FW_OWN_PARTS; i++) {
        part_row row;
        row_of(d, k, i / 2, i % 2, &row);
        by_root(d, row.body, (const double(*)[3])row.by, v);
        for (int j = 0; j < FW_OWN_MODES; j++)
            v[d->n + FW_OWN_MODES * k + j] = own->mode[j][i / 2][i % 2] * sqrt(own->s2[j] / scale);
        add_form(row.mass, v, v, d->rows, g);
        for (int q = 0; q < d->rows; q++)
            for (int way = 0; way < WAYS; way++)
                push[q * WAYS + way] += row.mass * row.way[way] * v[q];
        const int side = i / 2 >= FW_OWN_PARTS / 2, near = row.body[side];
        if (near == FW_GROUND || !has_halves(d->m, near)) continue;
        memset(row.rigid[!side], 0, sizeof row.rigid[0]);
        by_root(d, row.body, (const double(*)[3])row.rigid, v);
        add_form(-row.mass, v, v, d->rows, g);
        for (int q = 0; q < d->rows; q++)
            for (int way = 0; way < WAYS; way++)
                push[q * WAYS + way] -= row.mass * row.way[way] * v[q];
    }
}

/* compliance (n x n) of the bodies; *known: false, it is none */
static fw_status weigh(fw_arena *arena, const fw_mechanism_plates *p, const double *compliance,
                       bool across, const fw_flexure_own **own, weighed *d, bool *known) {
    const fw_mechanism *m = p->mechanism;
    const int n = p->n, rows = n + (own ? FW_OWN_MODES * m->nhinge : 0);
    const size_t wide = (size_t)rows;
    double *g, *value, *v, *push;
    fw_maths_lapack_space space;
    *d = (weighed){.m = m, .p = p, .across = across, .own = own, .n = n, .rows = rows};
    FW_NEED(d->l = fw_arena_array(arena, double, (size_t)n *(size_t)n));
    FW_NEED(g = fw_arena_array(arena, double, wide *wide));
    FW_NEED(v = fw_arena_array(arena, double, 3 * wide));
    FW_NEED(push = fw_arena_array(arena, double, WAYS *wide));
    value = v + 2 * wide;
    for (int i = 0; i < n * n; i++) /* symmetric: rows are columns */
        d->l[i] = 0.5 * (compliance[i] + compliance[i % n * n + i / n]);
    *known = fw_maths_cholesky(n, d->l);
    if (!*known) return FW_OK;
    for (int i = 0; i < n; i++) /* columns below the diagonal, to rows */
        for (int j = 0; j <= i; j++) {
            const double is = d->l[j * n + i];
            if (i != j) d->l[j * n + i] = 0;
            d->l[i * n + j] = is;
        }
    add_bodies(d, v, g, push);
    for (int k = 0; own && k < m->nhinge; k++) {
        add_strip(d, k, v, g, push);
        d->rest_s2 = fmax(d->rest_s2, own[k]->rest_s2 / m->hinge[k].scale);
    }
    FW_TRY(fw_maths_eigen_space(arena, rows, &space));
    *known = fw_maths_eigen(rows, g, value, &space);
    FW_NEED(d->s2 = fw_arena_array(arena, double, wide));
    FW_NEED(d->y = fw_arena_array(arena, double, wide *wide));
    FW_NEED(d->place = fw_arena_array(arena, double, wide *(size_t)n));
    FW_NEED(d->swing = fw_arena_array(arena, double, wide *(wide - (size_t)n) + 1));
    FW_NEED(d->push = fw_arena_array(arena, double, WAYS *wide));
    for (int k = 0; k < rows && *known; k++) {
        const double *y = g + (rows - 1 - k) * rows, s2 = fmax(value[rows - 1 - k], 1e-30);
        const int more = rows - n;
        d->s2[k] = s2;
        memcpy(d->y + k * rows, y, wide * sizeof *y);
        for (int i = 0; i < n; i++)
            for (int j = 0; j <= i; j++)
                d->place[k * n + i] += d->l[i * n + j] * y[j] / sqrt(s2);
        for (int i = 0; i < more; i++) {
            const int h = i / FW_OWN_MODES;
            d->swing[k * more + i] =
                y[n + i] * sqrt(own[h]->s2[i % FW_OWN_MODES] / m->hinge[h].scale / s2);
        }
        for (int i = 0; i < rows; i++)
            for (int way = 0; way < WAYS; way++)
                d->push[k * WAYS + way] += y[i] * push[i * WAYS + way] / sqrt(s2);
    }
    return FW_OK;
}

/* is it the same strip, of the same material the same way? */
static bool is_alike(const fw_mechanism_hinge *a, const fw_mechanism_hinge *b) {
    const fw_flexure_input *x = &a->input, *y = &b->input;
    return a->flexure == b->flexure && x->width_m == y->width_m && x->length_m == y->length_m &&
           x->fillet_m == y->fillet_m && x->depth_m == y->depth_m && a->scale == b->scale &&
           fabs(x->crystal.cos4 - y->crystal.cos4) + fabs(x->crystal.sin4 - y->crystal.sin4) < 1e-9;
}

/* *own NULL: what they weigh is not known */
static fw_status find_own(fw_arena *arena, const fw_mechanism *m, bool across,
                          const fw_flexure_own ***own) {
    const fw_quantity *density = &m->variant->material.density;
    const double kg_per_m2 = density->unknown ? 0 : density->value * m->variant->thickness_m;
    const fw_flexure_own **to;
    fw_flexure_own *one;
    *own = NULL;
    if (!(kg_per_m2 > 0)) return FW_OK;
    FW_NEED(to = fw_arena_array(arena, const fw_flexure_own *, (size_t)m->nhinge + 1));
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        for (int i = 0; i < k && !to[k]; i++)
            if (is_alike(h, &m->hinge[i])) to[k] = to[i];
        if (to[k]) continue;
        FW_NEED(one = fw_arena_one(arena, fw_flexure_own));
        const fw_status status = fw_flexure_own_of(arena, &h->input, &h->closed_form, &h->section,
                                                   across, kg_per_m2, one);
        if (status == FW_SOLVER) return FW_OK;
        FW_TRY(status);
        to[k] = one;
    }
    *own = to;
    return FW_OK;
}

fw_status fw_verdict_heavy(fw_arena *arena, const fw_mechanism_plates *p, bool across, int count,
                           double *s2) {
    const fw_flexure_own **own;
    weighed d;
    bool known = true;
    double *c;
    for (int k = 0; k < count; k++)
        s2[k] = 0;
    FW_TRY(find_own(arena, p->mechanism, across, &own));
    if (!own || p->n == 0) return FW_OK;
    if (across) FW_TRY(fw_mechanism_plates_across(arena, p, &c));
    if (!across) FW_TRY(fw_mechanism_plates_beside(arena, p, NULL, &c, &known));
    if (known) FW_TRY(weigh(arena, p, c, across, own, &d, &known));
    for (int k = 0; k < count && known && k < d.rows; k++)
        s2[k] = d.s2[k] + d.rest_s2;
    return FW_OK;
}

/* ---- what laws do to it ---- */

typedef struct
    swung { /* modes in one scene: how far each goes at most, and at least where the motion has it, kg^1/2 m */
    double *most, *least;
} swung;

static double pushed_by(const weighed *d, const fw_device_base_motion *b, int k) {
    const double *push = d->push + k * WAYS, along = d->across ? b->az_m_per_s2 : b->ax_m_per_s2,
                 up = d->across ? 0 : b->ay_m_per_s2;
    return fabs(along * push[0] + up * push[1]) * d->s2[k];
}

/* share of a mode that flexures have between their ends */
static double own_share(const weighed *d, int k) {
    double sum = 0;
    for (int i = d->n; i < d->rows; i++)
        sum += pow(d->y[k * d->rows + i], 2);
    return fmin(sum, 1);
}

static double product_of(const weighed *d, const double *u, const double *w) {
    double sum = 0;
    for (int b = 0; b < d->m->nbody; b++) {
        const fw_mechanism_mass *is = &d->m->body[b];
        const double flat[9] = {is->mass_kg, 0, 0, 0, is->mass_kg, 0, 0, 0, is->inertia_kg_m2},
                     *mass = d->across ? d->p->mass + 9 * b : flat;
        for (int i = 0; i < 9; i++)
            sum += mass[i] * u[3 * b + i / 3] * w[3 * b + i % 3];
    }
    return sum;
}

/* that of the device without flexures' mass that moves like it; FW_NONE: none does */
static int alike_mode(const weighed *light, const weighed *heavy, int k) {
    int best = FW_NONE;
    const double *u = heavy->place + k * heavy->n, scale = product_of(light, u, u);
    double most = 0.25;
    for (int j = 0; j < light->rows && scale > 0; j++) {
        const double by = product_of(light, u, light->place + j * light->n),
                     share = by * by / scale;
        if (share > most) most = share, best = j;
    }
    return own_share(heavy, k) < 0.5 ? best : FW_NONE;
}

/* that of the motion whose frequency lies nearest; NULL: none was looked for */
static const fw_verdict_shaken_mode *nearest_mode(const fw_verdict_variant_verdict *v, int scene,
                                                  double omega) {
    const fw_verdict_shaken *is = v->shaken ? &v->shaken[scene] : NULL;
    const fw_verdict_shaken_mode *best = NULL;
    for (int k = 0; is && k < is->n; k++)
        if (!best || fabs(log(is->mode[k].omega / omega)) < fabs(log(best->omega / omega)))
            best = &is->mode[k];
    return best;
}

/* Critical share of damping: of that mode; of flexures alone, and of one that moved away from there, of the material, since a
   damper for it that is right for the lowest mode grows with the frequency, and the material's loss hardly does */
static double damping_of_mode(const fw_verdict_variant_verdict *v, const fw_device_scene *s,
                              const fw_verdict_shaken_mode *near, bool flexures, bool away) {
    const fw_quantity *loss = &v->mechanism->variant->material.loss;
    double ends[2];
    const double of_it = fw_verdict_loss_ends(v->mechanism, s, ends) ? ends[0]
                         : loss->unknown                             ? 0
                                                                     : loss->value,
                 says = s->ndamping > 0 ? s->damping[s->ndamping - 1].loss_factor : 0,
                 own = fmax(0.5 * (isnan(says) ? of_it : says), 0);
    if (!near || flexures) return own;
    const double has = near->damping[FW_VERDICT_LEAST_DAMPED];
    return away && s->ndamping > 0 && s->nair == 0 ? fmin(has, own) : has;
}

/* in: (rows) what each mode is of account; what hardly is has one answer for all */
static fw_status swing_modes(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                             const weighed *d, const weighed *light, const double *counts,
                             swung *to) {
    const double hardly = 1e-5;
    const fw_device_scene *s = &v->mechanism->device->scene[scene];
    double all = 0, off = 0.01;
    FW_NEED(to->most = fw_arena_array(arena, double, 2 * (size_t)d->rows));
    to->least = to->most + d->rows;
    for (int k = 0; k < d->m->nhinge; k++)
        off = fmax(off, 0.5 * d->m->hinge[k].closed_form.error.stiffness + 0.01);
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < d->rows; k++)
            for (int i = 0; i < s->nbase; i++) {
                const fw_device_base_motion *b = &s->base[i];
                const double far = pushed_by(d, b, k), omega = 1 / sqrt(d->s2[k]);
                double swings[2] = {2, 2};
                if (!pass) all += far * counts[k];
                if (!pass || !(far > 0)) continue;
                if (far * counts[k] > hardly * all) {
                    const bool flexures = own_share(d, k) > 0.5;
                    const int alike = light ? alike_mode(light, d, k) : FW_NONE;
                    const fw_verdict_shaken_mode *near =
                        d->across ? NULL : nearest_mode(v, scene, omega);
                    const double was = alike == FW_NONE ? 0 : 1 / sqrt(light->s2[alike]);
                    /* no farther off than bands have it (resonance.c) */
                    const bool has = near && was > near->low && fmin(omega, was) > near->low &&
                                     fmax(omega, was) < near->high;
                    const double at = has ? was : omega,
                                 about = !light ? 0 : fmin(off * omega, fabs(at - was));
                    fw_quantity_law_swings_within(
                        b->law, s->duration_s, at - about, fmax(at + about, was),
                        d->across ? 0 : damping_of_mode(v, s, near, flexures, light && !has),
                        swings);
                }
                to->most[k] += far * swings[0], to->least[k] += far * swings[1];
            }
    return FW_OK;
}

/* strain (nhinge x FW_OWN_LOOKS) of mode k, of mass 1 */
static void mode_strains(const weighed *d, const fw_flexure_own *const *own, int k, double *to) {
    enum { BODY = 2 * FW_OWN_PARTS };
    const double others = 1.12;
    for (int h = 0; h < d->m->nhinge; h++) {
        const fw_mechanism_hinge *hinge = &d->m->hinge[h];
        const fw_mechanism_pin *pin = &d->m->pin[hinge->pin];
        const fw_flexure_own *o = own[h];
        const fw_geometry_vec2 at = fw_mechanism_pin_place(d->m, pin, 0);
        double apart[3] = {0}, f[FW_OWN_LOADS] = {0}, end[3][3];
        int body[2];
        ends_of(d->m, h, body);
        for (int side = 0; side < 2; side++) {
            at_place(d, body[side], at, hinge->axis_rad, end);
            for (int i = 0; i < 9 && body[side] != FW_GROUND; i++)
                apart[i / 3] += (side ? 1 : -1) * end[i / 3][i % 3] *
                                d->place[k * d->n + 3 * body[side] + i % 3];
        }
        for (int i = 0; i < 9; i++)
            f[BODY + i / 3] += hinge->scale * o->back[i / 3][i % 3] * apart[i % 3];
        for (int j = 0; d->own && j < FW_OWN_MODES; j++) {
            const double far = others * d->swing[k * (d->rows - d->n) + FW_OWN_MODES * h + j] *
                               hinge->scale / o->s2[j];
            for (int i = 0; i < BODY; i++) {
                const double by = far * o->mass[i / 2][i % 2] * o->mode[j][i / 2][i % 2];
                f[i] += by;
                for (int e = 0; e < 3; e++)
                    f[BODY + e] -= by * o->goes[i / 2][i % 2][e];
            }
        }
        for (int l = 0; l < FW_OWN_LOOKS; l++) {
            double moment = 0, other = 0;
            for (int i = 0; i < FW_OWN_LOADS; i++)
                moment += f[i] * o->moment[l][i], other += f[i] * o->other[l][i];
            to[h * FW_OWN_LOOKS + l] =
                fabs(moment) * o->by_moment[l] + fabs(other) * o->by_other[l];
        }
    }
}

typedef struct flexed { /* by all modes of one scene, at most and at least */
    const weighed *d;
    swung by;
    double *strain; /* (rows x nhinge x looks) of each mode */
} flexed;

struct fw_verdict_flexed { /* without flexures' mass, and with it */
    const fw_flexure_own **own;
    fw_mechanism_plates p;
    weighed d[2];
    flexed is[2];
};

static fw_status flex(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                      const weighed *d, const weighed *light, const fw_flexure_own *const *own,
                      flexed *to) {
    const int each = d->m->nhinge * FW_OWN_LOOKS;
    double *counts;
    to->d = d;
    FW_NEED(to->strain = fw_arena_array(arena, double, (size_t)(d->rows * each)));
    FW_NEED(counts = fw_arena_array(arena, double, (size_t)d->rows));
    for (int k = 0; k < d->rows; k++) {
        mode_strains(d, own, k, to->strain + k * each);
        for (int i = 0; i < each; i++)
            counts[k] = fmax(counts[k], to->strain[k * each + i]);
    }
    return swing_modes(arena, v, scene, d, light, counts, &to->by);
}

static double strain_of(const flexed *f, int hinge, const double *far) {
    const int each = f->d->m->nhinge * FW_OWN_LOOKS;
    double most = 0;
    for (int l = 0; l < FW_OWN_LOOKS; l++) {
        double sum = 0;
        for (int k = 0; k < f->d->rows; k++)
            sum += far[k] * f->strain[k * each + hinge * FW_OWN_LOOKS + l];
        most = fmax(most, sum);
    }
    return most;
}

/* how far a place of a body goes along a direction */
static double way_of(const flexed *f, int body, fw_geometry_vec2 at, double direction_rad,
                     const double *far) {
    const fw_mechanism *m = f->d->m;
    const double c = cos(direction_rad), s = sin(direction_rad), x = at.x - m->drawn[body].x_m,
                 y = at.y - m->drawn[body].y_m;
    double sum = 0;
    for (int k = 0; k < f->d->rows; k++) {
        const double *u = f->d->place + k * f->d->n + 3 * body;
        sum += far[k] * fabs(c * (u[0] - u[2] * y) + s * (u[1] + u[2] * x));
    }
    return sum;
}

void fw_verdict_flexed_way(const fw_verdict_flexed *both, int body, fw_geometry_vec2 at,
                           double direction_rad, double to[2]) {
    const flexed *is = both->is;
    const double was = way_of(&is[0], body, at, direction_rad, is[0].by.most);
    to[0] = fmax(way_of(&is[1], body, at, direction_rad, is[1].by.most) - was, 0);
    to[1] = fmax(was - way_of(&is[1], body, at, direction_rad, is[1].by.least), 0);
}

fw_status fw_verdict_flexed_new(fw_arena *arena, const fw_mechanism *m, fw_verdict_flexed **both) {
    fw_verdict_flexed *to;
    bool known = false;
    double *c;
    *both = NULL;
    FW_NEED(to = fw_arena_one(arena, fw_verdict_flexed));
    FW_TRY(fw_mechanism_plates_new(arena, m, NULL, &to->p));
    if (to->p.n > 0) FW_TRY(find_own(arena, m, false, &to->own));
    if (!to->own) return FW_OK;
    FW_TRY(fw_mechanism_plates_beside(arena, &to->p, NULL, &c, &known));
    for (int k = 0; k < 2 && known; k++)
        FW_TRY(weigh(arena, &to->p, c, false, k ? to->own : NULL, &to->d[k], &known));
    if (known) *both = to;
    return FW_OK;
}

fw_status fw_verdict_flexed_by(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                               fw_verdict_flexed *both) {
    for (int k = 0; k < 2; k++)
        FW_TRY(flex(arena, v, scene, &both->d[k], k ? &both->d[0] : NULL, both->own, &both->is[k]));
    return FW_OK;
}

void fw_verdict_flexed_strain(const fw_verdict_flexed *both, int hinge, double to[2]) {
    const flexed *is = both->is;
    const double was = strain_of(&is[0], hinge, is[0].by.most);
    to[0] = fmax(strain_of(&is[1], hinge, is[1].by.most) - was, 0);
    to[1] = fmax(was - strain_of(&is[1], hinge, is[1].by.least), 0);
}

/* ---- across the plane ---- */

/* how far the corners of a body go up or down */
static double up_of(const flexed *f, int body, const double *far) {
    const fw_mechanism_shape *shape = &f->d->m->shape[body];
    const double reach = sqrt(3 * shape->polar_m4 / shape->area_m2);
    double sum = 0;
    for (int k = 0; k < f->d->rows; k++) {
        const double *u = f->d->place + k * f->d->n + 3 * body;
        sum += far[k] * (fabs(u[0]) + reach * hypot(u[1], u[2]));
    }
    return sum;
}

fw_status fw_verdict_flexures_across(fw_arena *arena, const fw_verdict_variant_verdict *v,
                                     const fw_mechanism_plates *p, int scene, double *strain,
                                     double *far_m) {
    const fw_mechanism *m = v->mechanism;
    const fw_flexure_own **own;
    weighed d[2];
    flexed is[2];
    bool known = true;
    double *c;
    *far_m = 0;
    for (int h = 0; h < m->nhinge; h++)
        strain[h] = 0;
    if (!fw_mechanism_plates_shaken(&m->device->scene[scene])) return FW_OK;
    FW_TRY(find_own(arena, m, true, &own));
    if (!own) return FW_OK;
    FW_TRY(fw_mechanism_plates_across(arena, p, &c));
    for (int k = 0; k < 2 && known; k++) {
        FW_TRY(weigh(arena, p, c, true, k ? own : NULL, &d[k], &known));
        if (known) FW_TRY(flex(arena, v, scene, &d[k], k ? &d[0] : NULL, own, &is[k]));
    }
    for (int h = 0; h < m->nhinge && known; h++)
        strain[h] =
            fmax(strain_of(&is[1], h, is[1].by.most) - strain_of(&is[0], h, is[0].by.most), 0);
    for (int b = 0; b < m->nbody && known; b++)
        *far_m = fmax(*far_m, up_of(&is[1], b, is[1].by.most) - up_of(&is[0], b, is[0].by.most));
    return FW_OK;
}
