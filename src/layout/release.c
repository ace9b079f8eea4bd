/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release holes: what is dissolved below a body has to be reached from an opening. Round holes of
   diameter D in a square grid of pitch p leave no point between four of them farther than p/sqrt 2
   - D/2 from one (fw_layout_holes_reach_m); a body nowhere farther than that from its own edge gets
   none.

   The grid lies along the body: on its plate, else on the line between its first two hinges. A hole
   keeps (p - D)/2 and at least 10 um from edges; those of the grid also keep away from what belongs to
   hinges. An outline
   has no holes, so each column of holes is opened by one cut, D/2 wide, from a straight edge
   through all of them, and pieces of their own close the cut again between edge and first hole and
   from hole to hole: as at eyelets, the body stays one outline, and the union of outline and caps
   is the body with its holes. Both sides of a cap are JOINT and THROUGH segments, so that a bias
   moves edges and holes alike. What the grid leaves too far from an opening, release_rest.c fills.

   Area, centroid and polar moment follow in closed form: less pi D^2/4 at each middle, with
   pi D^4/32 about its own. Tests: test_release.c. */
#include "geometry/segment.h"
#include "base/constants.h"
#include "layout/draw.h"
#include "layout/pattern.h"
#include <math.h>

typedef fw_layout_release_grid grid;

static const double LEAST_RIM_M = 10e-6, LEAST_HOLE_M = 8e-6;
static const double SAME_M = 1e-9;
static const double BESIDE_M = 12e-6; /* straight edge that is left beside a cut */
enum { ACROSS = 60, ALONG = 200 };    /* most holes from the middle of the grid */

static fw_geometry_vec2 at(const grid *g, double x, double y) {
    return fw_add(fw_add(g->origin, x, g->x), y, g->y);
}

static double distance_to(const fw_geometry_contour *c, fw_geometry_vec2 p) {
    double least = HUGE_VAL, t;
    fw_geometry_vec2 where;
    for (int i = 0; i < c->count; i++)
        least = fmin(least, fw_geometry_segment_nearest(&c->segment[i], p, &t, &where));
    return least;
}

static bool in_box(const grid *g, fw_geometry_vec2 p) {
    return p.x > g->box.x0 && p.x < g->box.x1 && p.y > g->box.y0 && p.y < g->box.y1;
}

static bool in_hinge(const grid *g, fw_geometry_vec2 p, double reach) {
    for (int j = 0; j < g->d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &g->d->layout->hinge[j];
        if (fw_norm(fw_sub(p, h->centre)) < h->keep_out_m + reach) return true;
    }
    return false;
}

static bool may_have_hole(const grid *g, fw_geometry_vec2 p) {
    double need = 0.5 * g->hole_m + g->rim_m;
    return in_box(g, p) && !in_hinge(g, p, need) && fw_geometry_contour_contains(&g->before, p) &&
           distance_to(&g->before, p) >= need - SAME_M;
}

static fw_geometry_segment line(fw_geometry_vec2 a, fw_geometry_vec2 b, bool cut) {
    unsigned flags = cut ? FW_SEGMENT_JOINT | FW_SEGMENT_THROUGH : 0;
    return (fw_geometry_segment){.kind = FW_LINE, .flags = flags, .a = a, .b = b};
}

/* ---- a column ---- */

typedef struct column {
    int n;                  /* holes, from the one at the edge inwards */
    fw_geometry_vec2 first; /* middle of that one */
    fw_geometry_vec2 out, left;
    /* where the cut leaves through the edge, right and left of it seen outwards */
    fw_geometry_vec2 p[2];
    int edge; /* segment of the outline */
} column;

/* a point of hole k: from its middle `up` towards the edge and `across` to the left */
static fw_geometry_vec2 of_hole(const grid *g, const column *c, int k, double up, double across) {
    double inward = -k * g->pitch_m;
    return fw_add(fw_add(c->first, inward + up, c->out), across, c->left);
}

/* half the width of a cut, and how far above a hole's middle it meets the hole */
static double half_cut(const grid *g) {
    return 0.25 * g->hole_m;
}
static double deep(const grid *g) {
    return 0.25 * sqrt(3.0) * g->hole_m;
}

/* both sides of the cut and what must be straight beside them leave through one straight edge */
static bool leaves(const grid *g, column *c) {
    double half = half_cut(g);
    const double across[] = {-half, half, -half - BESIDE_M, half + BESIDE_M};
    for (int i = 0; i < 4; i++) {
        fw_geometry_vec2 from = of_hole(g, c, 0, i < 2 ? deep(g) : 0.0, across[i]);
        fw_layout_ray_hit hit = fw_layout_first_hit(&g->outline, from, c->out);
        if (hit.segment < 0 || hit.far_m > 2.0 * g->pitch_m) return false;
        if (i == 0) c->edge = hit.segment;
        if (hit.segment != c->edge) return false;
        if (i < 2) c->p[i] = hit.at;
    }
    const fw_geometry_segment *s = &g->outline.segment[c->edge];
    if (s->kind != FW_LINE || s->flags & FW_SEGMENT_JOINT) return false;
    return fw_dot(fw_geometry_segment_tangent(s, 0.5), c->left) > 0.97;
}

/* part of the edge of hole k, clockwise */
static fw_geometry_segment around(const grid *g, const column *c, int k, fw_geometry_vec2 a,
                                  fw_geometry_vec2 b, double sweep_rad) {
    return (fw_geometry_segment){.kind = FW_ARC,
                                 .a = a,
                                 .b = b,
                                 .centre = of_hole(g, c, k, 0.0, 0.0),
                                 .radius = 0.5 * g->hole_m,
                                 .sweep_rad = -sweep_rad};
}

/* down the right side of the cut, around the holes, and back up the left side */
static int trace(const grid *g, const column *c, fw_geometry_segment *out) {
    const double third =
        FW_PI / 3.0; /* a cut takes a third of half a turn out of the hole's edge */
    double w = half_cut(g), h = deep(g);
    int n = 0;
    fw_geometry_vec2 from = c->p[0];
    for (int k = 0; k < c->n; k++) {
        fw_geometry_vec2 high = of_hole(g, c, k, h, -w), low = of_hole(g, c, k, -h, -w);
        out[n++] = line(from, high, true);
        from = high;
        if (k == c->n - 1) break;
        out[n++] = around(g, c, k, high, low, 2.0 * third);
        from = low;
    }
    for (int k = c->n - 1; k >= 0; k--) {
        fw_geometry_vec2 high = of_hole(g, c, k, h, w), low = of_hole(g, c, k, -h, w);
        bool last = k == c->n - 1;
        if (!last) out[n++] = line(from, low, true);
        out[n++] = around(g, c, k, last ? from : low, high, (last ? 5.0 : 2.0) * third);
        from = high;
    }
    out[n++] = line(from, c->p[1], true);
    return n;
}

/* closes the cut above hole k */
static fw_status add_cap(grid *g, const column *c, int k) {
    const double third = FW_PI / 3.0;
    double w = half_cut(g), h = deep(g);
    fw_geometry_vec2 a = k ? of_hole(g, c, k - 1, -h, -w) : c->p[0];
    fw_geometry_vec2 b = k ? of_hole(g, c, k - 1, -h, w) : c->p[1];
    fw_geometry_vec2 e = of_hole(g, c, k, h, w), f = of_hole(g, c, k, h, -w);
    fw_geometry_contour cap = {.count = 4};
    FW_NEED(cap.segment = fw_arena_array(g->d->arena, fw_geometry_segment, 4));
    cap.segment[0] = k ? around(g, c, k - 1, a, b, third) : line(a, b, false);
    cap.segment[1] = line(b, e, true);
    cap.segment[2] = around(g, c, k, e, f, third);
    cap.segment[3] = line(f, a, true);
    return fw_layout_drawing_add(g->d, FW_ROLE_STRUCTURE, g->body, FW_NONE, g->label, &cap);
}

static fw_status cut_column(grid *g, const column *c) {
    const fw_geometry_segment edge = g->outline.segment[c->edge];
    FW_TRY(fw_layout_release_open(g, c->edge, 4 * c->n));
    fw_geometry_segment *to = g->outline.segment + c->edge;
    to[0] = line(edge.a, c->p[0], false);
    to[0].flags = edge.flags;
    int n = 1 + trace(g, c, to + 1);
    to[n] = line(c->p[1], edge.b, false);
    to[n].flags = edge.flags;
    for (int k = 0; k < c->n; k++) {
        FW_TRY(add_cap(g, c, k));
        FW_TRY(fw_layout_note_hole(g, of_hole(g, c, k, 0.0, 0.0)));
    }
    return FW_OK;
}

/* the run of `n` holes that begins `low` rows from the axis: opened below, else above */
static fw_status open_run(grid *g, int i, int low, int n) {
    for (int way = 0; way < 2; way++) {
        double first = (way ? low + n - 1 : low) * g->pitch_m;
        column c = {.n = n, .first = at(g, i * g->pitch_m, first)};
        c.out = way ? g->y : fw_v(-g->y.x, -g->y.y);
        c.left = fw_left(c.out);
        if (leaves(g, &c)) return cut_column(g, &c);
    }
    return FW_OK; /* no straight edge: the rest finds other ways */
}

static fw_status do_column(grid *g, int i) {
    int low = 0, n = 0;
    for (int j = -ACROSS; j <= ACROSS + 1; j++) {
        bool good = j <= ACROSS && may_have_hole(g, at(g, i * g->pitch_m, j * g->pitch_m));
        if (good && n++ == 0) low = j;
        if (good || n == 0) continue;
        FW_TRY(open_run(g, i, low, n));
        n = 0;
    }
    return FW_OK;
}

/* ---- a body ---- */

static void along_body(grid *g) {
    const fw_device *device = g->d->device;
    const fw_device_body *b = &device->body[g->body];
    int joint[2] = {0, 0}, n = fw_layout_body_joints(device, g->body, joint, 2);
    if (b->plate_width_m > 0.0) {
        g->origin = fw_v(b->plate_x_m, b->plate_y_m);
        g->x = fw_polar(b->plate_angle_rad);
    } else if (fw_layout_only_shapes(device, g->body)) {
        g->origin = fw_v(b->x_m, b->y_m);
        g->x = fw_polar(b->phi_rad);
    } else {
        fw_geometry_vec2 p = g->d->layout->hinge[joint[0]].centre;
        fw_geometry_vec2 q = n > 1 ? g->d->layout->hinge[joint[1]].centre : g->before.segment[0].a;
        g->origin = fw_add(p, 0.5, fw_sub(q, p));
        g->x = fw_towards(p, q);
    }
    g->y = fw_left(g->x);
}

/* is any point on the grid farther from the edge than the holes will leave one? */
static bool is_wide(const grid *g, double reach) {
    for (int i = -ALONG; i <= ALONG; i++)
        for (int j = -ACROSS; j <= ACROSS; j++) {
            fw_geometry_vec2 p = at(g, i * g->pitch_m, j * g->pitch_m);
            if (in_box(g, p) && fw_geometry_contour_contains(&g->before, p) &&
                distance_to(&g->before, p) > reach)
                return true;
        }
    return false;
}

/* (x^2 - y^2, 2 x y) */
static fw_geometry_vec2 squared(fw_geometry_vec2 p) {
    return fw_v(p.x * p.x - p.y * p.y, 2 * p.x * p.y);
}

static void take_out(grid *g) {
    fw_layout_body_layout *b = &g->d->layout->body[g->body];
    double r = 0.5 * g->hole_m, each = FW_PI * r * r, area = b->area_m2 - g->nhole * each;
    fw_geometry_vec2 sum = fw_v(b->area_m2 * b->centroid.x, b->area_m2 * b->centroid.y);
    for (int i = 0; i < g->nhole; i++)
        sum = fw_add(sum, -each, g->hole[i]);
    fw_geometry_vec2 centre = fw_v(sum.x / area, sum.y / area), shift = fw_sub(b->centroid, centre);
    double polar = b->polar_m4 + b->area_m2 * fw_dot(shift, shift);
    fw_geometry_vec2 spread = fw_add(b->spread_m4, b->area_m2, squared(shift));
    for (int i = 0; i < g->nhole; i++) {
        fw_geometry_vec2 to = fw_sub(g->hole[i], centre);
        polar -= each * (0.5 * r * r + fw_dot(to, to));
        spread = fw_add(spread, -each, squared(to));
    }
    fw_geometry_vec2 edge = fw_add(b->edge_m2, b->perimeter_m, shift);
    double square =
        b->edge_m3 + 2 * fw_dot(b->edge_m2, shift) + b->perimeter_m * fw_dot(shift, shift);
    for (int i = 0; i < g->nhole; i++) {
        fw_geometry_vec2 to = fw_sub(g->hole[i], centre);
        edge = fw_add(edge, 2 * FW_PI * r, to);
        square += 2 * FW_PI * r * (fw_dot(to, to) + r * r);
    }
    *b = (fw_layout_body_layout){.area_m2 = area,
                                 .perimeter_m = b->perimeter_m + 2.0 * FW_PI * r * g->nhole,
                                 .centroid = centre,
                                 .polar_m4 = polar,
                                 .spread_m4 = spread,
                                 .edge_m2 = edge,
                                 .edge_m3 = square};
}

static bool points_from_centre(const fw_layout_drawing *d, int body) {
    const fw_device_body *b = &d->device->body[body];
    if (!isnan(b->x_m) && !isnan(b->y_m)) return false;
    for (int i = 0; i < d->ncomb; i++)
        if (d->comb[i].comb->body_b == body || d->comb[i].comb->body_a == body) return true;
    return fw_layout_eyelets_on(d, body);
}

static fw_status do_body(fw_layout_drawing *d, int body, double pitch, double hole) {
    grid g = {.d = d, .body = body, .pitch_m = pitch, .hole_m = hole};
    g.rim_m = fmax(0.5 * (pitch - hole), LEAST_RIM_M);
    g.before = g.outline = *fw_layout_drawing_outline(d, body);
    if (g.before.count == 0) return FW_OK;
    g.box = fw_geometry_contour_box(&g.before);
    along_body(&g);
    if (!is_wide(&g, fw_layout_holes_reach_m(pitch, hole, true))) return FW_OK;
    FW_NEED(g.label = fw_layout_body_label(d, body));
    if (points_from_centre(d, body)) {
        if (!d->said)
            fw_diag_warning(d->diags, 189, fw_layout_body_place(d, body),
                            "%s gets no release holes: points of tendons or drives are given from "
                            "its centre of mass, which the holes would move; state x and y of the "
                            "body",
                            g.label);
        return FW_OK;
    }
    for (int i = -ALONG; i <= ALONG; i++)
        FW_TRY(do_column(&g, i));
    FW_TRY(fw_layout_release_rest(&g));
    if (g.far_m > fw_layout_holes_reach_m(pitch, hole, true) && !d->said) {
        char far[32], x[32], y[32];
        fw_diag_warning(d->diags, 189, fw_layout_body_place(d, body),
                        "%s: no hole can be opened near (%s, %s) um, which stays %s um from the "
                        "nearest opening; it comes free later there: move its edges or holes, or "
                        "make the body narrower",
                        g.label, fw_layout_um(x, g.far.x), fw_layout_um(y, g.far.y),
                        fw_layout_um(far, g.far_m));
    }
    if (g.nhole == 0) return FW_OK;
    take_out(&g);
    d->held[body] = g.outline;
    return FW_OK;
}

fw_status fw_layout_release_holes(fw_layout_drawing *d) {
    double pitch = d->device->release_pitch_m, hole = d->device->release_hole_m;
    if (!(pitch > 0.0)) return FW_OK;
    if (!(hole > 0.0)) hole = 0.3 * pitch;
    if (!(hole >= LEAST_HOLE_M && hole <= 0.5 * pitch)) {
        char p[32], s[32];
        fw_diag_error(
            d->diags, 189, (fw_place){d->device->file, 0, 0},
            "release holes of %s um at a pitch of %s um: the diameter must be at least 8 um "
            "and at most half the pitch",
            fw_layout_um(s, hole), fw_layout_um(p, pitch));
        return FW_GEOMETRY;
    }
    for (int b = 0; b < d->device->nbody; b++)
        FW_TRY(do_body(d, b, pitch, hole));
    return FW_OK;
}
