/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces across a gap: undersides over a carrier, walls of bodies beside each other, and how far faces reach across the plane. Theory: docs/theory/stiction.md, docs/theory/effects/out-of-plane.md. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include <string.h>

/* ---- undersides ---- */

enum { CELLS = 8 }; /* along the longer side of a piece */

static fw_status put_below(fw_mechanism_faces *to, const fw_mechanism *m, int body, int piece,
                           double gap_m, double more, fw_geometry_vec2 at, double area_m2) {
    double dx = at.x - m->drawn[body].x_m, dy = at.y - m->drawn[body].y_m;
    const fw_mechanism_face face = {.body = {body, FW_GROUND},
                                    .by = {{-1, -dy, dx}},
                                    .area_m2 = area_m2,
                                    .gap_m = gap_m,
                                    .more = more,
                                    .at = at,
                                    .piece = {piece, FW_NONE}};
    return area_m2 > 0 ? fw_mechanism_faces_add(to, &face) : FW_OK;
}

/* lines of the liquid along edges: of a plate gamma P, of a strip twice its length, beside 2 gamma cos A/g; and no less
   than the wetted sides that Mastrangelo and Hsu count, h P/(2 A) */
static double lines_of(double perimeter_m, double area_m2, double gap_m, double depth_m) {
    return 0.5 * fmax(gap_m, depth_m) * perimeter_m / area_m2;
}

/* x where the outline crosses the height y, sorted: at most `most` of them */
static int crossings(const fw_geometry_contour *c, double y, double *x, int most) {
    int n = 0;
    for (int i = 0; i < c->count; i++) {
        int parts = fw_geometry_segment_parts(&c->segment[i]);
        for (int k = 0; k < parts && n < most; k++) {
            fw_geometry_vec2 a = fw_geometry_segment_point(&c->segment[i], (double)k / parts),
                             b = fw_geometry_segment_point(&c->segment[i], (k + 1.0) / parts);
            if ((a.y <= y) == (b.y <= y)) continue;
            double at = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
            int j = n++;
            for (; j > 0 && x[j - 1] > at; j--)
                x[j] = x[j - 1];
            x[j] = at;
        }
    }
    return n;
}

/* what of a piece lies in the columns of a row of cells, of one line of it: area and its moments */
static void add_line(const double *x, int n, double x0, double cell, double y, int columns,
                     double (*in)[3]) {
    for (int k = 0; k + 1 < n; k += 2)
        for (int i = 0; i < columns; i++) {
            const double from = fmax(x[k], x0 + i * cell), to = fmin(x[k + 1], x0 + (i + 1) * cell);
            if (!(to > from)) continue;
            in[i][0] += to - from;
            in[i][1] += 0.5 * (to - from) * (to + from);
            in[i][2] += (to - from) * y;
        }
}

/* The piece in cells, each by its area and middle, from lines that are near enough to find slender bars; areas add up to the
   piece's own */
static fw_status put_piece(fw_mechanism_faces *to, const fw_mechanism *m, int piece, double gap_m,
                           double more) {
    enum { MOST = 256, LINES = 128 };
    const fw_layout_piece *p = &m->layout->piece[piece];
    const fw_geometry_box box = fw_geometry_contour_box(&p->contour);
    double wide = box.x1 - box.x0, high = box.y1 - box.y0, cell = fmax(wide, high) / CELLS, x[MOST];
    int rows = (int)ceil(high / cell - 1e-9), columns = (int)ceil(wide / cell - 1e-9);
    size_t first = to->count;
    double sum = 0, exact = fw_geometry_contour_area(&p->contour);
    if (!(exact > 0)) return FW_OK;
    const int lines = LINES / rows;
    for (int j = 0; j < rows; j++) {
        double in[CELLS + 1][3] = {{0}};
        for (int l = 0; l < lines; l++) {
            const double y = box.y0 + (j + (l + 0.5) / lines) * high / rows;
            add_line(x, crossings(&p->contour, y, x, MOST), box.x0, wide / columns, y, columns, in);
        }
        for (int i = 0; i < columns; i++) {
            const double area = in[i][0] * high / (rows * lines);
            sum += area;
            FW_TRY(put_below(to, m, p->body, piece, gap_m, more,
                             (fw_geometry_vec2){in[i][1] / in[i][0], in[i][2] / in[i][0]}, area));
        }
    }
    for (size_t i = first; i < to->count && sum > 0; i++)
        to->face[i].area_m2 *= exact / sum;
    return FW_OK;
}

/* Half of a strip's pull goes to either body, a third of the way from its root to the pin: forces and moments of a strip
   clamped at both ends under an even load */
static fw_status put_strips(fw_mechanism_faces *to, const fw_mechanism_plates *p, double gap_m,
                            double depth_m) {
    const fw_mechanism *m = p->mechanism;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        double w = m->hinge[k].input.width_m, length = p->hinge[k].length_m;
        double more = lines_of(2 * length, w * length, gap_m, depth_m);
        for (int side = 0; side < 2; side++) {
            int body = side ? pin->body_b : pin->body_a;
            fw_geometry_vec2 root = side ? pin->root_b_m : pin->root_a_m;
            if (body == FW_GROUND) continue;
            root = fw_geometry_vec_rotate(root, m->drawn[body].phi_rad);
            size_t before = to->count;
            FW_TRY(put_below(to, m, body, FW_NONE, gap_m, more,
                             vec_along(p->hinge[k].pin, 2.0 / 3, root), 0.5 * w * length));
            if (to->count > before) to->face[before].strip = true;
        }
    }
    return FW_OK;
}

fw_status fw_mechanism_faces_below(fw_arena *arena, const fw_mechanism_plates *p, double gap_m,
                                   fw_mechanism_face **face, int *nface) {
    const fw_mechanism *m = p->mechanism;
    const double depth = m->variant->thickness_m;
    fw_mechanism_faces to = {.arena = arena};
    for (int i = 0; m->layout && i < m->layout->npiece; i++) {
        const fw_layout_piece *piece = &m->layout->piece[i];
        if (piece->body < 0 || piece->body >= m->nbody || !fw_layout_is_wall(piece)) continue;
        const fw_mechanism_shape *s = &m->shape[piece->body];
        double round = isfinite(s->perimeter_m) ? s->perimeter_m : 0;
        FW_TRY(put_piece(&to, m, i, gap_m, lines_of(round, s->area_m2, gap_m, depth)));
    }
    for (int b = 0; !m->layout && b < m->nbody; b++) /* as one row of cells along x */
        for (int i = 0; i < CELLS; i++) {
            const fw_mechanism_shape *s = &m->shape[b];
            double side = sqrt(6 * (s->polar_m4 + s->spread_m4.x) / s->area_m2);
            fw_geometry_vec2 at = {m->drawn[b].x_m + side * ((i + 0.5) / CELLS - 0.5),
                                   m->drawn[b].y_m};
            FW_TRY(put_below(&to, m, b, FW_NONE, gap_m, 0, at, s->area_m2 / CELLS));
        }
    FW_TRY(put_strips(&to, p, gap_m, depth));
    *face = to.face, *nface = (int)to.count;
    return FW_OK;
}

/* z of the plates and of the sphere that they curl to. Test: test_mechanism_pull.c */
fw_status fw_mechanism_faces_rest(fw_arena *arena, const fw_mechanism_plates *p,
                                  double curvature_per_m, double gap_m, double more,
                                  fw_mechanism_face *face, int n, double *down, double *up) {
    const size_t size = (size_t)p->n;
    fw_geometry_vec2 middle = {0, 0};
    double *f, *x, *bow;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(f = fw_arena_array(arena, double, 3 * size));
    x = f + size, bow = x + size;
    fw_mechanism_plates_weight(p, -FW_STANDARD_GRAVITY_m_per_s2, f);
    fw_mechanism_plates_answer(p, f, x);
    if (curvature_per_m != 0) {
        fw_mechanism_plates_curl(p, curvature_per_m, &middle, f);
        fw_mechanism_plates_answer(p, f, bow);
        for (size_t i = 0; i < size; i++)
            x[i] += bow[i];
    }
    *down = *up = 0;
    for (int i = 0; i < n; i++) {
        const fw_geometry_vec2 c = vec_sub(face[i].at, middle);
        const double z = more * (fw_mechanism_plates_z(p, x, face[i].body[0], face[i].at) +
                                 0.5 * curvature_per_m * vec_dot(c, c));
        face[i].gap_m = fmax(gap_m + z, 1e-9);
        *down = fmax(*down, -z), *up = fmax(*up, z);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- walls opposite each other ---- */

/* x, y and turn of a body move its point p along n by this */
static void put_side(const fw_mechanism *m, int body, fw_geometry_vec2 p, fw_geometry_vec2 n,
                     double sign, double *by) {
    if (body == FW_GROUND) return;
    double rx = p.x - m->drawn[body].x_m, ry = p.y - m->drawn[body].y_m;
    by[0] = sign * n.x, by[1] = sign * n.y, by[2] = sign * (rx * n.y - ry * n.x);
}

typedef struct seen {
    int own, other;
    fw_geometry_vec2 at, normal;
    double length_m, gap_m;
} seen;

static fw_status put_beside(fw_mechanism_faces *to, const fw_mechanism *m,
                            const fw_mechanism_walls *w, const seen *s) {
    const fw_mechanism_wall *a = &w->wall[s->own], *b = &w->wall[s->other];
    const double depth = m->variant->thickness_m;
    fw_mechanism_face face = {.body = {a->solid, b->solid},
                              .area_m2 = s->length_m * depth,
                              .gap_m = s->gap_m,
                              .more =
                                  s->gap_m / depth, /* lines of liquid at both faces of the layer */
                              .at = s->at,
                              .normal = s->normal,
                              .piece = {a->piece, b->piece}};
    put_side(m, a->solid, s->at, s->normal, 1, face.by[0]);
    put_side(m, b->solid, vec_along(s->at, s->gap_m, s->normal), s->normal, -1, face.by[1]);
    return fw_mechanism_faces_add(to, &face);
}

static void put_strip(const fw_mechanism *m, const fw_mechanism_walls *w, const seen *s,
                      fw_mechanism_strip_beside *strip) {
    int joint = FW_MECHANISM_FLEXED - w->wall[s->own].solid, k = m->pin[joint].hinge;
    if (k == FW_NONE) return;
    const fw_mechanism_pin *pin = &m->pin[joint];
    fw_geometry_vec2 pin_at = fw_mechanism_pin_place(m, pin, 0);
    double far = fmax(vec_length(pin->root_a_m), vec_length(pin->root_b_m));
    bool middle = vec_distance(s->at, pin_at) <= 0.5 * far || far == 0;
    if (!middle || !(s->gap_m < strip[k].gap_m)) return;
    strip[k] = (fw_mechanism_strip_beside){s->gap_m, s->at, w->wall[s->other].piece};
}

/* A pair of bodies is seen from both of them, with half of the area each: from the outer one of two arcs there is more of it,
   and which body is described first decides nothing. The ground looks at none. */
static fw_status look_from(const fw_mechanism *m, const fw_mechanism_walls *w, int own,
                           double come_m, fw_mechanism_faces *to,
                           fw_mechanism_strip_beside *strip) {
    const fw_mechanism_wall *a = &w->wall[own];
    double length = vec_distance(a->a, a->b);
    int rays = 1 + (int)(length / FW_MECHANISM_RAYS_m);
    if (a->solid == FW_GROUND || !(length > 0)) return FW_OK;
    fw_geometry_vec2 along = vec_sub(a->b, a->a), n = {along.y / length, -along.x / length};
    for (int k = 0; k < rays; k++) {
        seen s = {.own = own,
                  .at = vec_along(a->a, (k + 0.5) / rays, along),
                  .normal = n,
                  .length_m = length / rays};
        s.other = fw_mechanism_walls_look(w, own, s.at, n, &s.gap_m);
        if (s.other < 0) continue;
        const fw_mechanism_wall *b = &w->wall[s.other];
        fw_geometry_vec2 back = vec_unit(vec_sub(b->b, b->a)), out = {back.y, -back.x};
        s.gap_m = fmax(s.gap_m - come_m, 1e-9); /* closed walls are another matter (FW-D238) */
        if (b->solid == a->solid || vec_dot(out, n) > -FW_MECHANISM_FACING) continue;
        if (a->solid <= FW_MECHANISM_FLEXED)
            put_strip(m, w, &s, strip);
        else if (b->solid == FW_GROUND)
            FW_TRY(put_beside(to, m, w, &s));
        else if (b->solid >= 0) {
            s.length_m *= 0.5;
            FW_TRY(put_beside(to, m, w, &s));
        }
    }
    return FW_OK;
}

/* In: the layout in the drawn pose; walls come nearer by what the flow makes of them (fw_layout_walls_m). Walls within
   200 um whose normals are within 45 degrees of each other; liquid over 15 um of an edge at once. Cost: rays times the
   walls of a few bins. Test: test_mechanism_pull.c */
fw_status fw_mechanism_faces_beside(fw_arena *arena, const fw_mechanism *m,
                                    const fw_mechanism_walls *w, fw_mechanism_face **face,
                                    int *nface, fw_mechanism_strip_beside *strip) {
    fw_mechanism_faces to = {.arena = arena};
    *face = NULL, *nface = 0;
    for (int k = 0; k < m->nhinge; k++)
        strip[k] = (fw_mechanism_strip_beside){.gap_m = HUGE_VAL, .piece = FW_NONE};
    for (int i = 0; i < w->nwall; i++)
        FW_TRY(look_from(m, w, i, fw_layout_walls_m(m->layout), &to, strip));
    *face = to.face, *nface = (int)to.count;
    return FW_OK;
}

/* ---- how far all that is drawn reaches across the plane ---- */

/* sum over the modes of what each does at a point at most */
static double ringing(const fw_mechanism_plates *p, const double *ring, int body, double dx,
                      double dy) {
    double sum = 0;
    for (int k = 0; ring && k < p->n; k++) {
        const double *u = p->shape + (size_t)k * (size_t)p->n + 3 * body;
        sum += fabs(ring[k] * (u[0] + u[1] * dy - u[2] * dx));
    }
    return sum;
}

/* A plate is where its tangent plane at its centre of mass c is, and bowed up from it:
   z = at_m + slope.(r - c) + kappa |r - c|^2/2 */
typedef struct bowed {
    fw_geometry_vec2 centre, slope;
    double at_m, per_m;
    double low_m, high_m; /* of what was looked at */
} bowed;

static void look_at(bowed *of, fw_geometry_vec2 at) {
    const fw_geometry_vec2 d = vec_sub(at, of->centre);
    const double z = of->at_m + vec_dot(of->slope, d) + 0.5 * of->per_m * vec_dot(d, d);
    of->low_m = fmin(of->low_m, z), of->high_m = fmax(of->high_m, z);
}

/* the end of an edge, and where z is stationary along it: on a line that is one point, and on a circle, where z is a
   cosine of the angle, one with and one against the plate's slope at the circle's centre */
static void look_along(bowed *of, const fw_geometry_segment *s) {
    look_at(of, s->a);
    if (s->kind == FW_LINE) {
        const fw_geometry_vec2 along = vec_sub(s->b, s->a), d = vec_sub(s->a, of->centre);
        const double bends = of->per_m * vec_dot(along, along);
        const double t = -(vec_dot(of->slope, along) + of->per_m * vec_dot(d, along)) / bends;
        if (t > 0 && t < 1) look_at(of, vec_along(s->a, t, along));
        return;
    }
    const fw_geometry_vec2 slope = vec_along(of->slope, of->per_m, vec_sub(s->centre, of->centre));
    const fw_geometry_vec2 from = vec_sub(s->a, s->centre);
    const double half = 0.5 * s->sweep_rad, middle = atan2(from.y, from.x) + half;
    for (int way = -1; way <= 1; way += 2) {
        const fw_geometry_vec2 out = vec_scale(way, vec_unit(slope));
        const double angle = fw_geometry_angle_near(atan2(out.y, out.x), middle);
        if (fabs(angle - middle) < fabs(half)) look_at(of, vec_along(s->centre, s->radius, out));
    }
}

/* exact over all that an outline bounds: on its edges, and where the plate is level inside it */
static void look_over(bowed *of, const fw_geometry_contour *outline) {
    for (int i = 0; i < outline->count; i++)
        look_along(of, &outline->segment[i]);
    if (of->per_m == 0) return;
    const fw_geometry_vec2 level = vec_along(of->centre, -1 / of->per_m, of->slope);
    if (vec_finite(level) && fw_geometry_contour_contains(outline, level)) look_at(of, level);
}

/* What rings is convex across a plate, so that it is at most what it is at the corners of the box; what the tangent
   plane and it do together is bounded by the corners as well, and the nearer of both bounds counts. */
static void swing_by(const fw_mechanism_plates *p, const double *ring, int body,
                     fw_geometry_box box, bowed *of) {
    double most = 0, low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        const fw_geometry_vec2 d = vec_sub(
            (fw_geometry_vec2){k % 2 ? box.x1 : box.x0, k / 2 ? box.y1 : box.y0}, of->centre);
        const double swing = ringing(p, ring, body, d.x, d.y), z = of->at_m + vec_dot(of->slope, d),
                     bow = 0.5 * of->per_m * vec_dot(d, d);
        most = fmax(most, swing);
        low = fmin(low, z + fmin(bow, 0) - swing), high = fmax(high, z + fmax(bow, 0) + swing);
    }
    of->low_m = fmax(of->low_m - most, low), of->high_m = fmin(of->high_m + most, high);
}

/* z of what is drawn of each body at rest, exact: the sphere, what the plate is turned and moved from it, and where on
   it the body is. Test: test_mechanism_plates.c */
fw_mechanism_plates_reach fw_mechanism_plates_reached(const fw_mechanism_plates *p, const double *x,
                                                      const double *ring, double curvature_per_m,
                                                      fw_geometry_vec2 middle) {
    fw_mechanism_plates_reach r = {0, 0, 0, FW_NONE, FW_NONE, FW_NONE};
    const fw_layout *layout = p->mechanism->layout;
    for (int i = 0; layout && i < layout->npiece; i++) {
        const fw_layout_piece *piece = &layout->piece[i];
        if (piece->body < 0 || piece->body >= p->n / 3 || !fw_layout_is_wall(piece)) continue;
        const double *u = x + 3 * piece->body;
        const fw_mechanism_mass *b = &p->mechanism->drawn[piece->body];
        const fw_geometry_vec2 c = vec_sub((fw_geometry_vec2){b->x_m, b->y_m}, middle);
        bowed of = {.centre = {b->x_m, b->y_m},
                    .slope = {curvature_per_m * c.x - u[2], curvature_per_m * c.y + u[1]},
                    .at_m = u[0] + 0.5 * curvature_per_m * vec_dot(c, c),
                    .per_m = curvature_per_m,
                    .low_m = HUGE_VAL,
                    .high_m = -HUGE_VAL};
        double tilt = vec_length(of.slope);
        look_over(&of, &piece->contour);
        if (ring) swing_by(p, ring, piece->body, fw_geometry_contour_box(&piece->contour), &of);
        if (of.low_m < r.lowest_m) r.lowest_m = of.low_m, r.low = piece->body;
        if (of.high_m > r.highest_m) r.highest_m = of.high_m, r.high = piece->body;
        for (int k = 0; ring && k < p->n; k++) {
            const double *v = p->shape + (size_t)k * (size_t)p->n + 3 * piece->body;
            tilt += fabs(ring[k]) * hypot(v[1], v[2]);
        }
        if (tilt > r.tilt_rad) r.tilt_rad = tilt, r.tilted = piece->body;
    }
    return r;
}
