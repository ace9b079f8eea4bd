/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

enum { MOST_CROSSINGS = 64, MOST_REACHES = 256, RADII = 400 };

static int add_angle(double *angle, int n, fw_vec2 p) {
    if (n < MOST_CROSSINGS) angle[n++] = atan2(p.y, p.x);
    return n;
}

static bool on_arc(const fw_segment *s, fw_vec2 p) {
    fw_vec2 a = fw_sub(s->a, s->centre), b = fw_sub(p, s->centre);
    double turn = atan2(a.x * b.y - a.y * b.x, fw_dot(a, b));
    if (s->sweep_rad > 0.0 && turn < 0.0) turn += 2.0 * M_PI;
    if (s->sweep_rad < 0.0 && turn > 0.0) turn -= 2.0 * M_PI;
    return fabs(turn) <= fabs(s->sweep_rad);
}

typedef struct reach { /* distances from a centre between which a segment lies */
    double least, most;
} reach;

static void reaches(const fw_contour *c, fw_vec2 w, reach *out) {
    for (int i = 0; i < c->count && i < MOST_REACHES; i++) {
        const fw_segment *s = &c->segment[i];
        double a = fw_norm(fw_sub(s->a, w)), b = fw_norm(fw_sub(s->b, w)), far = fmax(a, b);
        if (s->kind == FW_ARC) far = fw_norm(fw_sub(s->centre, w)) + s->radius;
        out[i] = (reach){fw_segment_nearest(s, w, NULL, NULL) - 1e-9, far + 1e-9};
    }
}

/* angles about w at which an outline crosses the circle of radius q */
static int crossings(const fw_contour *c, const reach *within, fw_vec2 w, double q, double *angle) {
    int n = 0;
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        if (i < MOST_REACHES && (q < within[i].least || q > within[i].most)) continue;
        if (s->kind == FW_LINE) {
            fw_vec2 a = fw_sub(s->a, w), d = fw_sub(s->b, s->a);
            double dd = fw_dot(d, d), b = fw_dot(a, d), in = b * b - dd * (fw_dot(a, a) - q * q);
            if (in < 0.0 || dd <= 0.0) continue;
            for (int sign = -1; sign <= 1; sign += 2) {
                double t = (-b + sign * sqrt(in)) / dd;
                if (t >= 0.0 && t <= 1.0) n = add_angle(angle, n, fw_add(a, t, d));
            }
        } else {
            fw_vec2 to = fw_sub(s->centre, w);
            double far = fw_norm(to);
            if (far < 1e-12) continue; /* concentric: never crosses */
            double x = (far * far + q * q - s->radius * s->radius) / (2.0 * far),
                   y2 = q * q - x * x;
            if (y2 < 0.0) continue;
            fw_vec2 e = fw_v(to.x / far, to.y / far), f = fw_left(e);
            for (int sign = -1; sign <= 1; sign += 2) {
                fw_vec2 p = fw_add(fw_v(x * e.x, x * e.y), sign * sqrt(y2), f);
                if (on_arc(s, fw_add(w, 1.0, p))) n = add_angle(angle, n, p);
            }
        }
    }
    return n;
}

/* least angle about w between an edge of p and an edge of q, over 400 circles up to radius_m: one
   of the two bodies can turn by it before the outlines touch error: what lies between two circles
   (0.25 % of radius_m); cost 400 * (edges of p and q) docs/theory/layout.md, section 3;
   test_layout.c free_rotation_of_two_sectors */
double fw_layout_free_rotation(fw_vec2 w, const fw_contour *p, const fw_contour *q,
                               double radius_m) {
    double a[MOST_CROSSINGS], b[MOST_CROSSINGS], least = M_PI;
    reach of_p[MOST_REACHES], of_q[MOST_REACHES];
    reaches(p, w, of_p);
    reaches(q, w, of_q);
    for (int k = 1; k <= RADII; k++) {
        int na = crossings(p, of_p, w, radius_m * k / RADII, a);
        int nb = crossings(q, of_q, w, radius_m * k / RADII, b);
        for (int i = 0; i < na; i++)
            for (int j = 0; j < nb; j++)
                least = fmin(least, fabs(remainder(a[i] - b[j], 2.0 * M_PI)));
    }
    return least;
}

/* smallest gap that was asked for between two bodies; else the least space */
static double allowed(const fw_drawing *d, int a, int b) {
    double limit = FW_LEAST_SPACE_M;
    for (int j = 0; j < d->device->njoint; j++) {
        const fw_joint *t = &d->device->joint[j];
        double gap = d->device->flexure[t->flexure].gap_m;
        bool these = (t->body_a == a && t->body_b == b) || (t->body_a == b && t->body_b == a);
        if (these && gap > 0.0) limit = fmin(limit, gap);
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_comb *c = d->comb[i].comb;
        bool these = (a == FW_ISLAND && c->body_b == b) || (b == FW_ISLAND && c->body_b == a);
        if (these && !d->comb[i].off) limit = fmin(limit, c->gap_m * (1.0 - 1e-6));
    }
    return limit;
}

typedef struct part {
    int body;
    const char *label;
    const fw_contour *contour;
} part;

static fw_status check_pair(fw_drawing *d, const part *p, const part *q, bool *bad) {
    fw_vec2 at_p = fw_v(0.0, 0.0), at_q = at_p;
    double far = fw_contour_distance(p->contour, q->contour, &at_p, &at_q);
    if (far > 0.0 && (fw_contour_contains(p->contour, q->contour->segment[0].a) ||
                      fw_contour_contains(q->contour, p->contour->segment[0].a)))
        far = 0.0; /* one inside the other */
    d->layout->narrowest_gap_m = fmin(d->layout->narrowest_gap_m, far);
    double limit = allowed(d, p->body, q->body);
    if (far >= limit * (1.0 - 1e-9)) return FW_OK;
    char a[32], b[32], x[32], y[32];
    *bad = true;
    FW_NEED(p->label);
    FW_NEED(q->label);
    fw_diag_error(d->diags, 120, fw_body_place(d, p->body >= 0 ? p->body : q->body),
                  far > 0.0
                      ? "%s and %s are only %s um apart at (%s, %s) um; parts that move keep "
                        "%s um (layout rule): move the hinges or make bars narrower"
                      : "%s and %s overlap (%s um apart) at (%s, %s) um; parts that move keep "
                        "%s um (layout rule): move the hinges or make bars narrower",
                  p->label, q->label, fw_layout_um(a, far), fw_layout_um(x, at_p.x),
                  fw_layout_um(y, at_p.y), fw_layout_um(b, limit));
    return FW_OK;
}

/* every pair of parts that move apart, tethers not counted: they are broken first */
fw_status fw_clearance_check(fw_drawing *d) {
    const fw_device *device = d->device;
    int n = 0, most = d->nslot + device->njoint + d->layout->npiece + d->ncomb;
    part *all;
    bool bad = false;
    FW_NEED(all = fw_arena_array(d->arena, part, (size_t)most));
    d->layout->narrowest_gap_m = HUGE_VAL;
    for (int s = 0; s < d->nslot; s++) {
        int body = s < device->nbody ? s : FW_GROUND;
        if (d->plain[s].count == 0) continue;
        FW_NEED((all[n].label = fw_body_label(d, body)));
        all[n].body = body;
        all[n++].contour = fw_drawing_outline(d, s);
    }
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off)
            all[n++] = (part){FW_ISLAND, "the stator of a comb drive", &d->comb[i].stator};
    for (int i = 0; i < d->layout->npiece; i++) {
        const fw_piece *piece = &d->layout->piece[i];
        if (piece->role == FW_ROLE_FRAME)
            all[n++] = (part){FW_GROUND, piece->label, &piece->contour};
    }
    for (int i = 0; i < n; i++)
        for (int k = i + 1; k < n; k++)
            if (all[i].body != all[k].body) FW_TRY(check_pair(d, &all[i], &all[k], &bad));
    for (int j = 0; j < device->njoint; j++) /* flexures and third bodies */
        for (int i = 0; i < n; i++) {
            const fw_joint *t = &device->joint[j];
            if (all[i].body == t->body_a || all[i].body == t->body_b) continue;
            part flexure = {t->body_a, NULL, &d->hinge[j].flexure};
            FW_NEED((flexure.label = fw_arena_printf(d->arena, "flexure of hinge %s", t->id)));
            FW_TRY(check_pair(d, &flexure, &all[i], &bad));
        }
    return bad ? FW_GEOMETRY : FW_OK;
}
