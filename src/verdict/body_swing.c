/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How slow the modes in the plane may be at most, of bodies that bend themselves, with their masses where they are. Every body is a
   tree of beams from its middle on (body_tree.c), with W what flexures put on it and what closes its rings, which are cut:

     F W + D W + D_f f + G q = 0,    R f + G^T W = 0                                                     (5e)

   F what a flexure, or the piece that closes a ring, gives by itself; D, D_f how far places at its ends go from each other as
   beams bend by W and by the forces f of all masses, middles held; G q by the motions of the middles; R f the resultants of bodies.
   A tree is what a body is less what has been taken away, which makes nothing stiffer, and W the least that such a device stores:
   so C of u = C f is at least that of the device, and eigenvalues of M^1/2 C M^1/2 are at least 1/omega^2, each in its order: of legs
   that swing between their hinges, of rings whose sides move apart, and of what a body does by itself. Springs, stops and pins
   without a flexure hold nothing here, and a pin that is driven does not turn. Flexures' own mass goes with their ends.

   In: outlines as drawn, SI. Range: flexures with an axis. Error: a bound as far as parts are beams. Modes of 24
   bodies of bars at random are 8 % below to 4 % above those of plane solids: callers add 15 % to what bodies add
   (fw_verdict_soft_swings). Cost: of a body what body_hung.c takes, and 3 (hinges + rings) answers of its beams. Source: S. Timoshenko, J. Goodier, Theory of Elasticity, 3rd ed., art. 86 (least
   complementary energy); H. Weyl, Math. Ann. 71 (1912) 441. Theory: docs/theory/verdict.md, 5e. Test: test_effects.py
   BodiesThatSwing */
#include "base/constants.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/law_kind.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct end { /* of a link: the beam, its body, and the place */
    int beam, body;
    fw_geometry_vec2 at;
} end;

typedef struct swings {
    fw_arena *arena;
    const fw_mechanism *m;
    const fw_verdict_arm *arm;
    fw_verdict_beams b;
    int nlink;      /* flexures, then loops */
    end (*link)[2]; /* a and b; beam FW_NONE: ground */
    double *a;      /* (3 nlink)^2 F + D, factored */
    double *ag;     /* (3 nbody x 3 nlink) its inverse on the columns of G */
    double *s;      /* (3 nbody)^2 G^T of that, factored */
    double *gap, *q;
} swings;

/* ---- bodies as beams ---- */

/* u of the beams from..to by f, which is then what they bear */
static void beams_give(fw_verdict_beams *b, int from, int to) {
    for (int i = to - 1; i >= from; i--) {
        const int on = b->at[i].before;
        if (on == FW_NONE) continue;
        const fw_geometry_vec2 r = vec_sub(b->at[i].at, b->at[on].at);
        const double *f = b->f[i];
        b->f[on][0] += f[0], b->f[on][1] += f[1], b->f[on][2] += f[2] + r.x * f[1] - r.y * f[0];
    }
    for (int i = from; i < to; i++) {
        const fw_verdict_beam *p = &b->at[i];
        double *u = b->u[i];
        u[0] = u[1] = u[2] = 0;
        if (p->before == FW_NONE) continue;
        const double *was = b->u[p->before], *f = b->f[i],
                     less = (p->goes - p->pulls) * (f[0] * p->along.x + f[1] * p->along.y);
        const fw_geometry_vec2 r = vec_sub(p->at, b->at[p->before].at);
        u[0] = was[0] - was[2] * r.y + p->goes * f[0] - less * p->along.x;
        u[1] = was[1] + was[2] * r.x + p->goes * f[1] - less * p->along.y;
        u[2] = was[2] + p->turns * f[2];
    }
}

static fw_geometry_vec2 middle_of(const fw_mechanism *m, int body) {
    return (fw_geometry_vec2){m->drawn[body].x_m, m->drawn[body].y_m};
}

static void add_masses(const fw_verdict_tree *t, double kg_per_m2, fw_verdict_beam *to) {
    for (int i = 0; i < t->nlist; i++) {
        const int at = t->list[i], part = t->part[at];
        const fw_geometry_vec2 here = {t->box.x0 + (at % t->nx + 0.5) * t->cell,
                                       t->box.y0 + (at / t->nx + 0.5) * t->cell},
                               off = vec_sub(here, to[part].at);
        const double kg = kg_per_m2 * t->cell * t->cell * (double)t->full[at] * t->at[part].keeps;
        to[part].mass_kg += kg;
        to[part].inertia_kg_m2 += kg * (vec_dot(off, off) + t->cell * t->cell / 6);
    }
}

/* a body that is not drawn */
static fw_status add_point(const fw_mechanism *m, fw_arena *arena, int body, fw_verdict_beams *to) {
    const size_t n = (size_t)to->n;
    fw_geometry_vec2 pin, root;
    FW_NEED(to->at = fw_arena_grow(arena, to->at, n, n + 1, sizeof *to->at));
    to->at[n] = (fw_verdict_beam){.body = body,
                                  .before = FW_NONE,
                                  .at = middle_of(m, body),
                                  .mass_kg = m->body[body].mass_kg};
    for (int k = 0; k < 2 * m->nhinge; k++)
        if (fw_mechanism_hinge_end(m, body, k, &pin, &root)) to->on[k] = to->n;
    to->n++;
    return FW_OK;
}

/* as it is drawn */
static double flexure_kg(const fw_mechanism *m, int hinge) {
    double m2 = 0;
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->layout->piece[i].role == FW_ROLE_FLEXURE &&
            m->layout->piece[i].joint == m->hinge[hinge].pin)
            m2 += fabs(fw_geometry_contour_area(&m->layout->piece[i].contour));
    return m->variant->material.density.value * m->variant->thickness_m * m2;
}

/* of the flexures that hang on a body their nearer halves, which its mass has in it (layout/draw.c) */
static double halves_kg(const fw_mechanism *m, int body) {
    double kg = 0;
    for (int k = 0; k < m->nhinge && m->layout; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        kg += 0.5 * flexure_kg(m, k) * ((pin->body_a == body) + (pin->body_b == body));
    }
    return kg;
}

/* A flexure's own mass goes with its ends: half of it with either, and as much inertia as the cubic of a bar has. */
static void add_flexures(const fw_mechanism *m, fw_verdict_beams *b) {
    for (int k = 0; k < m->nhinge && m->layout; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        fw_geometry_vec2 at[2] = {fw_mechanism_pin_place(m, pin, 0),
                                  fw_mechanism_pin_place(m, pin, 1)},
                         on;
        for (int side = 0; side < 2; side++) {
            const int body = side ? pin->body_b : pin->body_a;
            if (body != FW_GROUND)
                (void)fw_mechanism_hinge_end(m, body, 2 * k + side, &on, &at[side]);
        }
        const double long_m = m->hinge[k].input.length_m, kg = flexure_kg(m, k);
        for (int side = 0; side < 2; side++) {
            if (b->on[2 * k + side] == FW_NONE || !(kg > 0)) continue;
            fw_verdict_beam *to = &b->at[b->on[2 * k + side]];
            const fw_geometry_vec2 r = vec_sub(at[side], to->at);
            to->mass_kg += 0.5 * kg;
            to->inertia_kg_m2 += kg * (0.5 * vec_dot(r, r) + long_m * long_m / 32);
        }
    }
}

/* What a description says of inertia beyond that of the drawing, in which halves of flexures are, turns with the middle. */
static void add_stated(const fw_mechanism *m, int body, fw_verdict_beam *middle) {
    const fw_mechanism_shape *s = &m->shape[body];
    const double kg = m->body[body].mass_kg,
                 drawn = s->area_m2 > 0
                             ? kg * (s->polar_m4 / s->area_m2 + vec_dot(s->centroid, s->centroid))
                             : 0;
    middle->inertia_kg_m2 += fmax(0, m->body[body].inertia_kg_m2 - drawn);
}

/* what bears nothing but its own inertia turns as a whole */
static fw_status stiffen_ends(fw_arena *arena, const fw_mechanism *m, fw_verdict_beams *b) {
    bool *bears = fw_arena_array(arena, bool, (size_t)b->n + 1);
    FW_NEED(bears);
    for (int i = 0; i < b->n; i++)
        if (b->at[i].before != FW_NONE) bears[b->at[i].before] = true;
    for (int k = 0; k < 2 * m->nhinge; k++)
        if (b->on[k] != FW_NONE) bears[b->on[k]] = true;
    for (int k = 0; k < b->nloop; k++)
        bears[b->loop[k].beam[0]] = bears[b->loop[k].beam[1]] = true;
    for (int i = 0; i < b->n; i++)
        if (!bears[i]) b->at[i].turns = 0;
    return FW_OK;
}

static fw_status beams_of(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                          fw_verdict_beams *to) {
    fw_status status = FW_OK;
    *to = (fw_verdict_beams){.lost = FW_NONE};
    FW_NEED(to->on = fw_arena_array(arena, int, 2 * (size_t)m->nhinge + 1));
    FW_NEED(to->first = fw_arena_array(arena, int, (size_t)m->nbody + 1));
    for (int k = 0; k < 2 * m->nhinge; k++)
        to->on[k] = FW_NONE;
    for (int b = 0; b < m->nbody && status == FW_OK; b++) {
        fw_arena *scratch = fw_arena_part(arena, 0);
        FW_NEED(scratch);
        fw_verdict_tree t = {.depth_m = m->variant->thickness_m,
                             .youngs_Pa = m->variant->material.youngs.value};
        bool holds = true;
        if (m->shape[b].area_m2 > 0)
            status = fw_verdict_tree_new(scratch, m, m->layout, b, NULL, &t);
        if (status == FW_OK && t.nline > 0)
            status = fw_verdict_tree_beams(arena, m, arm, &t, b, to, &holds);
        if (status == FW_OK && to->n > to->first[b]) {
            const double kg = m->body[b].mass_kg, halves = halves_kg(m, b);
            add_masses(&t, (kg - (kg > halves ? halves : 0)) / t.made_m2, to->at + to->first[b]);
        }
        fw_arena_free(scratch);
        if (status == FW_OK && to->n == to->first[b]) status = add_point(m, arena, b, to);
        FW_TRY(status);
        if (!holds) to->lost = b;
        to->first[b + 1] = to->n;
    }
    add_flexures(m, to);
    for (int b = 0; b < m->nbody; b++)
        add_stated(m, b, to->at + to->first[b]);
    FW_TRY(stiffen_ends(arena, m, to));
    FW_NEED(to->f = fw_arena_alloc(arena, (size_t)to->n, sizeof *to->f));
    FW_NEED(to->u = fw_arena_alloc(arena, (size_t)to->n, sizeof *to->u));
    return FW_OK;
}

/* ---- what links them ---- */

/* d += sign times how a place goes that moves with `from`, displaced by u */
static void goes_with(fw_geometry_vec2 from, const double *u, fw_geometry_vec2 place, double sign,
                      double *d) {
    const fw_geometry_vec2 r = vec_sub(place, from);
    d[0] += sign * (u[0] - u[2] * r.y), d[1] += sign * (u[1] + u[2] * r.x), d[2] += sign * u[2];
}

/* f += sign times a wrench at a place, about `from` */
static void puts_on(fw_geometry_vec2 from, const double *wrench, fw_geometry_vec2 place,
                    double sign, double *f) {
    const fw_geometry_vec2 r = vec_sub(place, from);
    f[0] += sign * wrench[0], f[1] += sign * wrench[1];
    f[2] += sign * (wrench[2] + r.x * wrench[1] - r.y * wrench[0]);
}

/* of a link over its beams alone, b against a */
static void opens(const swings *x, int link, double d[3]) {
    d[0] = d[1] = d[2] = 0;
    for (int side = 0; side < 2; side++) {
        const end *e = &x->link[link][side];
        if (e->beam != FW_NONE)
            goes_with(x->b.at[e->beam].at, x->b.u[e->beam], e->at, side ? 1 : -1, d);
    }
}

static void put_on_beams(swings *x, int link, const double *wrench) {
    for (int side = 0; side < 2; side++) {
        const end *e = &x->link[link][side];
        if (e->beam != FW_NONE)
            puts_on(x->b.at[e->beam].at, wrench, e->at, side ? 1 : -1, x->b.f[e->beam]);
    }
}

static bool is_driven(const fw_mechanism *m, int pin) {
    for (int i = 0; i < m->ndriver; i++)
        if (m->driver[i].revolute == pin) return true;
    return false;
}

/* (3 x 3) what a flexure gives by itself: world axes at its pin, m, m, rad */
static void flexure_gives(const fw_mechanism *m, int hinge, double to[9]) {
    const double hardly = 1e-6;
    const fw_mechanism_hinge *h = &m->hinge[hinge];
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&h->law, 0, &at);
    const double c = cos(h->axis_rad), s = sin(h->axis_rad), along = 1 / at.kx_N_per_m.value,
                 across = 1 / at.ky_N_per_m.value;
    memset(to, 0, 9 * sizeof *to);
    to[0] = along * c * c + across * s * s, to[4] = along * s * s + across * c * c;
    to[1] = to[3] = (along - across) * c * s;
    to[8] = (is_driven(m, h->pin) ? hardly : 1) / m->pin[h->pin].stiffness_Nm_per_rad;
}

/* what a link gives by itself, to (3 x 3) at its place in F + D */
static void add_own(swings *x, int link) {
    const int rows = 3 * x->nlink;
    double own[9] = {0}, *to = x->a + 3 * link * rows + 3 * link;
    if (link < x->m->nhinge) {
        flexure_gives(x->m, link, own);
        fw_verdict_bases_add(x->m, x->arm, link, own);
    } else {
        const fw_verdict_loop *l = &x->b.loop[link - x->m->nhinge];
        own[0] = own[4] = l->goes, own[8] = l->turns;
    }
    for (int i = 0; i < 9; i++)
        to[i / 3 * rows + i % 3] += own[i];
}

static fw_status link_all(swings *x) {
    const fw_mechanism *m = x->m;
    FW_NEED(x->link = fw_arena_alloc(x->arena, (size_t)x->nlink + 1, sizeof *x->link));
    for (int k = 0; k < x->nlink; k++)
        for (int side = 0; side < 2; side++) {
            end *e = &x->link[k][side];
            if (k < m->nhinge) {
                const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
                *e = (end){x->b.on[2 * k + side], side ? pin->body_b : pin->body_a,
                           fw_mechanism_pin_place(m, pin, side)};
            } else {
                const fw_verdict_loop *l = &x->b.loop[k - m->nhinge];
                *e = (end){l->beam[side], x->b.at[l->beam[side]].body, l->at};
            }
        }
    return FW_OK;
}

/* column of G: how links open by a unit motion of a body */
static void open_by_body(const swings *x, int body, int way, double *gap) {
    const double u[3] = {way == 0, way == 1, way == 2};
    memset(gap, 0, 3 * (size_t)x->nlink * sizeof *gap);
    for (int k = 0; k < x->nlink; k++)
        for (int side = 0; side < 2; side++)
            if (x->link[k][side].body == body)
                goes_with(middle_of(x->m, body), u, x->link[k][side].at, side ? 1 : -1,
                          gap + 3 * k);
}

/* D of one link: its unit wrenches open all links of its two bodies */
static void open_by_link(swings *x, int link) {
    const size_t rows = 3 * (size_t)x->nlink;
    for (int way = 0; way < 3; way++) {
        const double unit[3] = {way == 0, way == 1, way == 2};
        const int own[2] = {x->link[link][0].body, x->link[link][1].body};
        for (int side = 0; side < 2; side++)
            if (own[side] != FW_GROUND)
                memset(x->b.f[x->b.first[own[side]]], 0,
                       (size_t)(x->b.first[own[side] + 1] - x->b.first[own[side]]) *
                           sizeof *x->b.f);
        put_on_beams(x, link, unit);
        for (int side = 0; side < 2; side++)
            if (own[side] != FW_GROUND && (side == 0 || own[1] != own[0]))
                beams_give(&x->b, x->b.first[own[side]], x->b.first[own[side] + 1]);
        for (int k = 0; k < x->nlink; k++) {
            double *d = x->a + (3 * (size_t)link + (size_t)way) * rows + 3 * (size_t)k;
            for (int side = 0; side < 2; side++) {
                const end *e = &x->link[k][side];
                if (e->body != FW_GROUND && (e->body == own[0] || e->body == own[1]))
                    goes_with(x->b.at[e->beam].at, x->b.u[e->beam], e->at, side ? 1 : -1, d);
            }
        }
    }
    add_own(x, link);
}

/* *holds: flexures alone hold the device */
static fw_status prepare(swings *x, bool *holds) {
    const int n = 3 * x->m->nbody, rows = 3 * x->nlink;
    const size_t wide = (size_t)rows, high = (size_t)n;
    FW_NEED(x->a = fw_arena_array(x->arena, double, wide *wide + 1));
    FW_NEED(x->ag = fw_arena_array(x->arena, double, high *wide + 1));
    FW_NEED(x->s = fw_arena_array(x->arena, double, high *high + 1));
    FW_NEED(x->gap = fw_arena_array(x->arena, double, wide + high + 1));
    x->q = x->gap + wide;
    for (int k = 0; k < x->nlink; k++)
        open_by_link(x, k);
    *holds = fw_maths_cholesky(rows, x->a);
    for (int j = 0; j < n && *holds; j++) {
        double *column = x->ag + (size_t)j * wide;
        open_by_body(x, j / 3, j % 3, column);
        *holds = fw_maths_cholesky_solve(rows, x->a, column);
    }
    for (int i = 0; i < n && *holds; i++) {
        open_by_body(x, i / 3, i % 3, x->gap);
        for (int j = 0; j < n; j++)
            for (size_t k = 0; k < wide; k++)
                x->s[(size_t)i * high + (size_t)j] += x->gap[k] * x->ag[(size_t)j * wide + k];
    }
    *holds = *holds && fw_maths_cholesky(n, x->s);
    return FW_OK;
}

/* ---- modes ---- */

/* out = M^1/2 C M^1/2 in, (3 n) */
static void swing(swings *x, const double *in, double *out) {
    fw_verdict_beams *b = &x->b;
    const int n = 3 * x->m->nbody, rows = 3 * x->nlink;
    double(*f)[3] = b->f;
    memset(x->q, 0, (size_t)n * sizeof *x->q);
    for (int i = 0; i < b->n; i++) {
        const fw_verdict_beam *p = &b->at[i];
        const double root = sqrt(p->mass_kg);
        f[i][0] = root * in[3 * i], f[i][1] = root * in[3 * i + 1];
        f[i][2] = sqrt(p->inertia_kg_m2) * in[3 * i + 2];
        puts_on(middle_of(x->m, p->body), f[i], p->at, 1, x->q + 3 * p->body);
    }
    beams_give(b, 0, b->n);
    for (int k = 0; k < x->nlink; k++)
        opens(x, k, x->gap + 3 * k);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < rows; k++)
            x->q[j] -= x->ag[j * rows + k] * x->gap[k];
    (void)fw_maths_cholesky_solve(n, x->s, x->q);
    (void)fw_maths_cholesky_solve(rows, x->a, x->gap);
    for (int k = 0; k < rows; k++) { /* W */
        x->gap[k] = -x->gap[k];
        for (int j = 0; j < n; j++)
            x->gap[k] -= x->ag[j * rows + k] * x->q[j];
    }
    for (int i = 0; i < b->n; i++) {
        const double root = sqrt(b->at[i].mass_kg);
        f[i][0] = root * in[3 * i], f[i][1] = root * in[3 * i + 1];
        f[i][2] = sqrt(b->at[i].inertia_kg_m2) * in[3 * i + 2];
    }
    for (int k = 0; k < x->nlink; k++)
        put_on_beams(x, k, x->gap + 3 * k);
    beams_give(b, 0, b->n);
    for (int i = 0; i < b->n; i++) {
        const fw_verdict_beam *p = &b->at[i];
        double *u = b->u[i];
        goes_with(middle_of(x->m, p->body), x->q + 3 * p->body, p->at, 1, u);
        out[3 * i] = sqrt(p->mass_kg) * u[0], out[3 * i + 1] = sqrt(p->mass_kg) * u[1];
        out[3 * i + 2] = sqrt(p->inertia_kg_m2) * u[2];
    }
}

/* rows (p x n) square to each other and of length 1 */
static void make_square(double *row, size_t p, size_t n) {
    for (size_t i = 0; i < p; i++) {
        double *a = row + i * n, size = 0;
        for (size_t again = 0; again < 2 * i; again++) {
            const double *other = row + again % i * n;
            double by = 0;
            for (size_t k = 0; k < n; k++)
                by += a[k] * other[k];
            for (size_t k = 0; k < n; k++)
                a[k] -= by * other[k];
        }
        for (size_t k = 0; k < n; k++)
            size += a[k] * a[k];
        for (size_t k = 0; k < n; k++)
            a[k] *= size > 0 ? 1 / sqrt(size) : 0;
    }
}

/* A few more rows than are asked for (Rayleigh and Ritz) */
typedef struct ritz {
    double *row, *next, *form,
        *value; /* (p x n), (p x n), (p x p) then vectors in rows, (p) ascending */
    size_t p, n;
    fw_maths_lapack_space space;
} ritz;

static fw_status ritz_new(swings *x, int count, ritz *r) {
    enum { MORE = 4 };
    const size_t n = 3 * (size_t)x->b.n, want = (size_t)count + MORE, p = n < want ? n : want;
    *r = (ritz){.p = p, .n = n};
    FW_NEED(r->row = fw_arena_array(x->arena, double, 2 * p * n + p * p + p));
    r->next = r->row + p * n, r->form = r->next + p * n, r->value = r->form + p * p;
    for (size_t i = 0; i < p * n; i++) /* no mode is square to any numbers, of either sign */
        r->row[i] = ((unsigned)i * 2654435761U >> 16 & 255) / 256.0 - 0.5;
    return fw_maths_eigen_space(x->arena, (int)p, &r->space);
}

static bool ritz_step(swings *x, ritz *r) {
    const size_t p = r->p, n = r->n;
    make_square(r->row, p, n);
    for (size_t i = 0; i < p; i++)
        swing(x, r->row + i * n, r->next + i * n);
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = 0;
            for (size_t k = 0; k < n; k++)
                sum += r->row[i * n + k] * r->next[j * n + k];
            r->form[i * p + j] = r->form[j * p + i] = sum;
        }
    return fw_maths_eigen((int)p, r->form, r->value, &r->space);
}

static fw_status iterate(swings *x, int count, ritz *r, double *s2) {
    enum { TIMES = 100 };
    const double settled = 1e-5, lacks = 1e-3;
    const size_t p = r->p;
    for (int turn = 0, still = 0; turn < TIMES && still < 2; turn++) {
        if (fw_arena_cancelled(x->arena)) return FW_CANCELLED;
        double off = 0;
        if (!ritz_step(x, r)) return FW_SOLVER;
        for (int k = 0; k < count; k++) {
            const double now = (size_t)k < p ? r->value[p - 1 - (size_t)k] : 0;
            off = fmax(off, fabs(now - s2[k]) / fmax(now, DBL_MIN)), s2[k] = now;
        }
        still = off < settled ? still + 1 : 0;
        memcpy(r->row, r->next, p * r->n * sizeof *r->row);
    }
    for (int k = 0; k < count; k++)
        s2[k] *= 1 + lacks;
    return FW_OK;
}

/* s2 (count), and the device as it was made ready; *why NULL, or why that is not known */
static fw_status slowest(fw_arena *arena, swings *x, const fw_verdict_arm *arm, int count,
                         double *s2, ritz *r, const char **why) {
    const fw_mechanism *m = x->m;
    bool holds = false;
    *why = NULL;
    for (int k = 0; k < count; k++)
        s2[k] = 0;
    fw_status status = beams_of(x->arena, m, arm, &x->b);
    x->nlink = m->nhinge + x->b.nloop;
    if (status == FW_OK && x->b.lost == FW_NONE) status = link_all(x);
    if (status == FW_OK && x->b.lost == FW_NONE) status = prepare(x, &holds);
    if (status == FW_OK && holds) status = ritz_new(x, count, r);
    if (status == FW_OK && holds) status = iterate(x, count, r, s2);
    if (status == FW_OK && x->b.lost != FW_NONE)
        FW_NEED(*why = fw_arena_printf(
                    arena,
                    "no grid resolves %s%s, so that what it does by its own mass is not known",
                    FW_NAMED("body", fw_text_name(m->body[x->b.lost].id))));
    else if (!holds)
        *why = "flexures alone do not hold its bodies, so that what these do by their own mass is "
               "not known";
    return status == FW_SOLVER ? FW_OK : status;
}

fw_status fw_verdict_slowest_swings(fw_arena *arena, const fw_mechanism *m,
                                    const fw_verdict_arm *arm, int count, double *s2,
                                    const char **why) {
    fw_arena *own = fw_arena_part(arena, 0);
    FW_NEED(own);
    swings x = {.arena = own, .m = m, .arm = arm};
    ritz r;
    const fw_status status = slowest(arena, &x, arm, count, s2, &r, why);
    fw_arena_free(own);
    return status;
}

/* mode k of its rows, of mass 1 */
static void keep_mode(swings *x, const ritz *r, int k, fw_verdict_swung *to) {
    const size_t at = r->p - 1 - (size_t)k, nh = (size_t)x->m->nhinge, beams = (size_t)x->b.n;
    const double s2 = r->value[at];
    double *sum = r->next, *out = r->next + r->n;
    memset(sum, 0, r->n * sizeof *sum);
    for (size_t i = 0; i < r->p; i++)
        for (size_t j = 0; j < r->n; j++)
            sum[j] += r->form[at * r->p + i] * r->row[i * r->n + j];
    swing(x, sum, out);
    for (size_t i = 0; i < 3 * beams; i++)
        to->goes[(size_t)k * beams + i / 3][i % 3] = x->b.u[i / 3][i % 3] / s2;
    for (size_t h = 0; h < nh; h++) {
        double own[9], *opens = to->opens[(size_t)k * nh + h];
        const double *w = x->gap + 3 * h;
        flexure_gives(x->m, (int)h, own);
        for (int i = 0; i < 3; i++) {
            opens[i] = (own[3 * i] * w[0] + own[3 * i + 1] * w[1] + own[3 * i + 2] * w[2]) / s2;
            to->flexures[k] += opens[i] * w[i];
        }
    }
    to->s2[k] = s2;
}

fw_status fw_verdict_swung_modes(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                                 int count, fw_verdict_swung *to, const char **why) {
    const size_t modes = (size_t)count, nh = (size_t)m->nhinge;
    swings x = {.arena = arena, .m = m, .arm = arm};
    ritz r = {0};
    *to = (fw_verdict_swung){0};
    FW_NEED(to->s2 = fw_arena_array(arena, double, 2 * modes));
    to->flexures = to->s2 + modes;
    FW_TRY(slowest(arena, &x, arm, count, to->s2, &r, why));
    to->beams = x.b;
    if (*why || r.p == 0 || !ritz_step(&x, &r)) return FW_OK;
    FW_NEED(to->goes = fw_arena_alloc(arena, modes * (size_t)x.b.n, sizeof *to->goes));
    FW_NEED(to->opens = fw_arena_alloc(arena, modes * nh + 1, sizeof *to->opens));
    while (to->n < count && (size_t)to->n < r.p && r.value[r.p - 1 - (size_t)to->n] > 0)
        keep_mode(&x, &r, to->n, to), to->n++;
    return FW_OK;
}

/* ---- how far a shock that is over throws the device across the plane ----
   Of a linear device that an acceleration a of what carries it shakes, the energy about that grows by dE/dt = -a 1.M u', at most
   |a| (m 2E)^(1/2), m all that moves: so (2E)^(1/2) <= m^(1/2) integral of |a|, whatever its modes are, and a place that gives c
   goes (2E c)^(1/2) at most. c adds up of the bodies as plates and of what hangs over them. In: plates, SI. Out: m; infinite:
   the shock does not come to its end. Error: an upper bound; twice the slow answer and more where a shock is no shorter than
   a period. Source: Cauchy and Schwarz. Test: test_out_of_plane.py, test_a_short_shock_throws_by_its_impulse */
fw_status fw_verdict_thrown_across(fw_arena *arena, const fw_mechanism_plates *p,
                                   const fw_verdict_hung *hung, const fw_device_scene *s,
                                   double *far_m) {
    const fw_mechanism *m = p->mechanism;
    const size_t n = (size_t)p->n;
    double speed = 0, mass_kg = 0, most = 0, *c;
    for (int i = 0; i < s->nbase; i++)
        if (s->base[i].az_m_per_s2 != 0)
            speed += fabs(s->base[i].az_m_per_s2) *
                     fw_quantity_law_impulse_s(s->base[i].law, s->duration_s);
    *far_m = hung || !(speed > 0) ? speed : (double)INFINITY;
    if (!(*far_m > 0) || !isfinite(*far_m)) return FW_OK;
    FW_TRY(fw_mechanism_plates_across(arena, p, &c));
    for (int b = 0; b < m->nbody; b++) {
        fw_mechanism_line *line;
        int nline;
        mass_kg += p->mass[9 * b];
        FW_TRY(fw_mechanism_body_lines(arena, m->layout, b, &line, &nline));
        for (int i = 0; i < nline; i++) { /* what gives most is a corner: c is convex */
            const double by[3] = {1, line[i].a.y - m->drawn[b].y_m, m->drawn[b].x_m - line[i].a.x};
            double gives = hung[b].corner_m_per_N;
            for (size_t k = 0; k < 9; k++)
                gives +=
                    by[k / 3] * c[(3 * (size_t)b + k / 3) * n + 3 * (size_t)b + k % 3] * by[k % 3];
            most = fmax(most, gives);
        }
    }
    *far_m = speed * sqrt(mass_kg * most);
    return FW_OK;
}
