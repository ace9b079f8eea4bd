/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eyelets of tendons: a closed ring that is part of its body, and how its hole is opened without
   an outline that has a hole. */
#include "geometry/segment.h"
#include "base/constants.h"
#include "layout/draw.h"
#include <math.h>

static const double FARTHEST_M = 400e-6; /* stem from a ring to what carries it */
static const double HALF_CUT_M = 6e-6;   /* of the piece that closes the ring */
static const double BESIDE_M = 16e-6;    /* straight edge that is left beside it, for rounding */
static const double LONGEST_M = 600e-6;  /* of that piece */
enum { DIRECTIONS = 48 };

static double outer_of(const fw_layout_eyelet_plan *e) {
    return 0.5 * e->hole_m + e->ring_m;
}

static fw_status unite(fw_arena *arena, const fw_geometry_contour *p, const fw_geometry_contour *q,
                       fw_geometry_contour *out, bool *one) {
    fw_geometry_region a = {(fw_geometry_contour *)p, 1}, b = {(fw_geometry_contour *)q, 1}, both;
    fw_status status = fw_geometry_region_boolean(arena, &a, &b, FW_UNION, &both);
    *one = status == FW_OK && both.count == 1;
    if (*one) *out = both.contour[0];
    return status == FW_GEOMETRY ? FW_OK : status;
}

static fw_geometry_vec2 nearest(const fw_geometry_contour *c, fw_geometry_vec2 from) {
    double least = HUGE_VAL;
    fw_geometry_vec2 best = from;
    for (int i = 0; i < c->count; i++) {
        double t;
        fw_geometry_vec2 at;
        double far = fw_geometry_segment_nearest(&c->segment[i], from, &t, &at);
        if (far >= least) continue;
        least = far;
        best = at;
    }
    return best;
}

static fw_status in_the_way(fw_layout_drawing *d, const char **why) {
    FW_NEED(*why = fw_arena_printf(d->arena, "its ring would cross or nearly touch %s", *why));
    return FW_OK;
}

/* A disc under the ring and, where that does not touch the outline, a bar as wide as 1.6 radii from
   it to the nearest place of the outline: wide, so that no slit is left between ring and outline.
 */
fw_status fw_layout_eyelet_ring(fw_layout_drawing *d, const fw_layout_eyelet_plan *e, int body,
                                const fw_geometry_contour *raw, fw_geometry_contour *out,
                                const char **why) {
    fw_geometry_contour disc, joined = *raw;
    bool one = true;
    double radius = outer_of(e);
    *why = NULL;
    *out = *raw;
    for (int i = 0; i < d->neyelet && d->eyelet[i].eyelet != e->eyelet; i++) {
        const fw_layout_eyelet_plan *o = &d->eyelet[i];
        if (!o->off && o->eyelet->body == e->eyelet->body &&
            fw_norm(fw_sub(o->at, e->at)) < outer_of(e) + 0.5 * o->hole_m)
            *why = "its ring would reach into another hole";
    }
    if (*why) return FW_OK;
    FW_TRY(fw_geometry_contour_disc(d->arena, e->at, radius, &disc));
    FW_TRY(fw_layout_actuator_crosses(d, &disc, body, fw_layout_rule.least_space_m, d->ncomb, why));
    if (*why) return in_the_way(d, why);
    bool inside = fw_geometry_contour_contains(raw, e->at);
    double far = fw_geometry_contour_distance(&disc, raw, NULL, NULL);
    if (inside && far > 0.0) return FW_OK; /* the whole ring is there already */
    if (!inside && far > FARTHEST_M) {
        char um[32];
        FW_NEED(*why = fw_arena_printf(
                    d->arena, "it lies %s um from the nearest material that could carry it",
                    fw_layout_um(um, far)));
        return FW_OK;
    }
    if (!inside) {
        fw_geometry_contour stem;
        fw_geometry_vec2 to;
        fw_geometry_vec2 u = fw_towards(e->at, to = nearest(raw, e->at));
        FW_TRY(fw_geometry_contour_bar(d->arena, e->at, fw_add(to, 0.5 * radius, u), 1.6 * radius,
                                       &stem));
        FW_TRY(fw_layout_actuator_crosses(d, &stem, body, fw_layout_rule.least_space_m, d->ncomb,
                                          why));
        if (*why) return in_the_way(d, why);
        FW_TRY(unite(d->arena, raw, &stem, &joined, &one));
    }
    if (one) FW_TRY(unite(d->arena, &joined, &disc, out, &one));
    if (!one) *why = "its ring and its body do not make one outline";
    return FW_OK;
}

/* ---- the hole ---- */

typedef fw_layout_ray_hit hit;

static void nearer(hit *h, int i, double t, fw_geometry_vec2 from, fw_geometry_vec2 u) {
    if (t > 0.0 && t < h->far_m) *h = (hit){i, t, fw_add(from, t, u)};
}

hit fw_layout_first_hit(const fw_geometry_contour *c, fw_geometry_vec2 from, fw_geometry_vec2 u) {
    hit h = {-1, HUGE_VAL, {0.0, 0.0}};
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (s->kind == FW_LINE) {
            fw_geometry_vec2 d = fw_sub(s->b, s->a), w = fw_sub(s->a, from);
            double across = vec_cross(u, d), t = vec_cross(w, d) / across,
                   part = vec_cross(w, u) / across;
            if (across != 0.0 && part >= 0.0 && part <= 1.0) nearer(&h, i, t, from, u);
            continue;
        }
        fw_geometry_vec2 w = fw_sub(from, s->centre);
        double half = fw_dot(w, u), in = half * half - fw_dot(w, w) + s->radius * s->radius;
        for (int sign = -1; in >= 0.0 && sign <= 1; sign += 2) {
            double t = -half + sign * sqrt(in), part;
            if (fw_geometry_segment_faces(s, fw_sub(fw_add(from, t, u), s->centre), &part))
                nearer(&h, i, t, from, u);
        }
    }
    return h;
}

/* the cut along u: both its sides, and what must be straight beside them, leave through one edge
   that is no cut itself and stands within 45 degrees of square */
static bool leaves(const fw_geometry_contour *c, fw_geometry_vec2 centre, fw_geometry_vec2 u,
                   hit side[2]) {
    fw_geometry_vec2 n = fw_left(u);
    static const double beside[] = {-1.0, 1.0};
    for (int k = 0; k < 2; k++) {
        side[k] = fw_layout_first_hit(c, fw_add(centre, beside[k] * HALF_CUT_M, n), u);
        hit out = fw_layout_first_hit(c, fw_add(centre, beside[k] * (HALF_CUT_M + BESIDE_M), n), u);
        if (side[k].segment < 0 || out.segment != side[k].segment) return false;
        if (k == 1 && side[0].segment != side[1].segment) return false;
        const fw_geometry_segment *s = &c->segment[side[k].segment];
        double part = fw_geometry_segment_parameter(s, side[k].at);
        if (s->flags & FW_SEGMENT_JOINT || side[k].far_m > LONGEST_M) return false;
        if (fw_dot(fw_geometry_segment_tangent(s, part), n) < 0.7) return false;
    }
    const fw_geometry_segment *s = &c->segment[side[0].segment];
    return fw_geometry_segment_parameter(s, side[0].at) <
           fw_geometry_segment_parameter(s, side[1].at);
}

static fw_geometry_segment cut_line(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_geometry_segment){
        .kind = FW_LINE, .flags = FW_SEGMENT_JOINT | FW_SEGMENT_THROUGH, .a = a, .b = b};
}

/* Outline and cap. Both share the two cuts bit for bit; the edges of either side run on in the
   other (THROUGH), so that a bias moves them alike:

     outline ... edge to P1 | P1 Q1 | hole from Q1 clockwise to Q2 | Q2 P2 | edge from P2 ...
     cap     edge P1 P2 | P2 Q2 | hole Q2 Q1 | Q1 P1

   P on the edge and Q on the hole, 6 um to either side of the ray from the centre. */
static fw_status splice(fw_arena *arena, const fw_geometry_contour *c,
                        const fw_layout_eyelet_plan *e, fw_geometry_vec2 u, const hit side[2],
                        fw_geometry_contour *out, fw_geometry_contour *cap) {
    double r = 0.5 * e->hole_m, deep = sqrt(r * r - HALF_CUT_M * HALF_CUT_M);
    double half = asin(HALF_CUT_M / r);
    fw_geometry_vec2 n = fw_left(u), p1 = side[0].at, p2 = side[1].at;
    fw_geometry_vec2 q1 = fw_add(fw_add(e->at, deep, u), -HALF_CUT_M, n),
                     q2 = fw_add(fw_add(e->at, deep, u), HALF_CUT_M, n);
    int k = side[0].segment, count = 0;
    const fw_geometry_segment *edge = &c->segment[k];
    double t1 = fw_geometry_segment_parameter(edge, p1),
           t2 = fw_geometry_segment_parameter(edge, p2);
    fw_geometry_segment hole = {.kind = FW_ARC, .centre = e->at, .radius = r};
    FW_NEED(out->segment = fw_arena_array(arena, fw_geometry_segment, (size_t)c->count + 4));
    FW_NEED(cap->segment = fw_arena_array(arena, fw_geometry_segment, 4));
    for (int i = 0; i < c->count; i++) {
        if (i != k) {
            out->segment[count++] = c->segment[i];
            continue;
        }
        out->segment[count++] = fw_geometry_segment_cut(edge, 0.0, edge->a, t1, p1);
        out->segment[count++] = cut_line(p1, q1);
        out->segment[count] = hole;
        out->segment[count].a = q1, out->segment[count].b = q2;
        out->segment[count++].sweep_rad = -(2.0 * FW_PI - 2.0 * half);
        out->segment[count++] = cut_line(q2, p2);
        out->segment[count++] = fw_geometry_segment_cut(edge, t2, p2, 1.0, edge->b);
    }
    out->count = count;
    cap->segment[0] = fw_geometry_segment_cut(edge, t1, p1, t2, p2);
    cap->segment[1] = cut_line(p2, q2);
    cap->segment[2] = hole;
    cap->segment[2].a = q2, cap->segment[2].b = q1, cap->segment[2].sweep_rad = -2.0 * half;
    cap->segment[3] = cut_line(q1, p1);
    cap->count = 4;
    return FW_OK;
}

fw_status fw_layout_eyelet_hole(fw_layout_drawing *d, const fw_layout_eyelet_plan *e,
                                const fw_geometry_contour *raw, fw_geometry_contour *out,
                                fw_geometry_contour *cap, const char **why) {
    fw_geometry_contour disc;
    hit best[2] = {{-1, 0.0, {0.0, 0.0}}, {-1, 0.0, {0.0, 0.0}}}, side[2];
    fw_geometry_vec2 way = fw_v(0.0, 0.0);
    double shortest = HUGE_VAL;
    *why = NULL;
    *out = *raw;
    FW_TRY(fw_geometry_contour_disc(d->arena, e->at, 0.999 * outer_of(e), &disc));
    if (!fw_geometry_contour_contains(raw, e->at) ||
        fw_geometry_contour_distance(&disc, raw, NULL, NULL) <= 0.0) {
        *why = "another hole or a cut between two pieces is in its ring";
        return FW_OK;
    }
    for (int k = 0; k < DIRECTIONS; k++) {
        fw_geometry_vec2 u = fw_polar(2.0 * FW_PI * k / DIRECTIONS);
        if (!leaves(raw, e->at, u, side)) continue;
        double length = fmax(side[0].far_m, side[1].far_m);
        if (length >= shortest - 1e-9) continue;
        shortest = length;
        way = u;
        best[0] = side[0], best[1] = side[1];
    }
    if (!isfinite(shortest)) {
        *why = "no straight edge of what carries it is within 0.6 mm";
        return FW_OK;
    }
    return splice(d->arena, raw, e, way, best, out, cap);
}

/* Tendon eyelets: open rings on short stems at the platform's edge. A closed eye would be a hole in
   the outline; the tendon is hooked in through the opening, which faces along the edge, across the
   pull. */
/* local: origin on the edge, +y outwards, the eye opens towards +x */
static fw_status draw_lug(fw_layout_drawing *d, const fw_layout_local *local,
                          fw_geometry_contour *lug) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double eye = rule->eye_m, outer = rule->eye_outer_m, stem = rule->eye_stem_m;
    double height = rule->eye_height_m, in = rule->eye_foot_m, foot = -acos(stem / outer);
    double from = rule->eye_open_from_rad, to = from + rule->eye_open_rad;
    fw_geometry_vec2 c = fw_v(0.0, height);
    fw_geometry_vec2 right = fw_v(stem, height + outer * sin(foot)), left = fw_v(-stem, right.y);
    fw_layout_sketch k = fw_layout_sketch_start(d->arena, local, fw_v(-stem, -in));
    fw_layout_sketch_line(&k, fw_v(stem, -in), 0);
    fw_layout_sketch_line(&k, right, 0);
    fw_layout_sketch_arc(&k, c, from - foot, fw_add(c, outer, fw_polar(from)));
    fw_layout_sketch_line(&k, fw_add(c, eye, fw_polar(from)), 0);
    fw_layout_sketch_arc(&k, c, -(2.0 * FW_PI - (to - from)), fw_add(c, eye, fw_polar(to)));
    fw_layout_sketch_line(&k, fw_add(c, outer, fw_polar(to)), 0);
    fw_layout_sketch_arc(&k, c, FW_PI - foot - to, left);
    return fw_layout_sketch_close(&k, lug);
}

static bool has_room(const fw_layout_drawing *d, fw_geometry_vec2 centre) {
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        double clear = h->keep_out_m + fw_layout_rule.eye_outer_m + fw_layout_rule.eye_clear_m;
        if (fw_norm(fw_sub(centre, h->centre)) < clear) return false;
    }
    return true;
}

/* None where tendons of the file say where the platform's eyelets are (eyelet.c). In pairs, as far
   as there is room beside the hinges, at most four: two on the edge that faces away from the
   mechanism, two on the opposite edge, two on the short edges. Mirrored places, so that two tendons
   of a pair pull evenly. */
fw_status fw_layout_platform_lugs(fw_layout_drawing *d, int body, double shift_m,
                                  fw_geometry_contour *lug, int *nlug) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_device_body *b = &d->device->body[body];
    double stem = rule->eye_stem_m;
    *nlug = 0;
    if (isnan(b->plate_width_m) || fw_layout_eyelets_on(d, body)) return FW_OK;
    double w = 0.5 * b->plate_width_m, h = 0.5 * b->plate_height_m;
    fw_geometry_vec2 middle = fw_v(b->plate_x_m, b->plate_y_m);
    fw_geometry_vec2 x = fw_polar(b->plate_angle_rad), y = fw_left(x);
    if (fw_dot(fw_sub(d->centre, middle), y) > 0.0) { /* y away from the rest */
        x = fw_v(-x.x, -x.y);
        y = fw_v(-y.x, -y.y);
    }
    const struct {
        fw_geometry_vec2 edge, out; /* for the right lug of the pair */
    } place[] = {
        {{rule->eye_far_share * w - shift_m, h}, {0.0, 1.0}},
        {{rule->eye_near_share * w - shift_m, -h}, {0.0, -1.0}},
        {{w, h - stem - rule->eye_from_corner_m - shift_m}, {1.0, 0.0}},
    };
    for (size_t i = 0; i < sizeof place / sizeof place[0] && *nlug < 4; i++) {
        bool upright = place[i].out.x > 0.0;
        double middle_room = rule->eye_near_share * w - shift_m;
        bool fits = upright ? h >= 2.0 * stem
                            : rule->eye_between_share * w >= stem &&
                                  middle_room >= rule->eye_outer_m + rule->eye_pair_m;
        if (!fits) continue;
        fw_layout_local local[2];
        bool room = true;
        for (int k = 0; k < 2; k++) {
            double sign = k == 0 ? -1.0 : 1.0;
            fw_geometry_vec2 at =
                fw_add(fw_add(middle, sign * place[i].edge.x, x), place[i].edge.y, y);
            fw_geometry_vec2 out = fw_add(
                fw_v(sign * place[i].out.x * x.x, sign * place[i].out.x * x.y), place[i].out.y, y);
            /* local y is `out`; local x, to which the eye opens, is towards the pair's middle, on
               the short edges towards -y */
            fw_geometry_vec2 open = upright ? fw_v(-y.x, -y.y) : fw_v(-sign * x.x, -sign * x.y);
            bool mirror = fw_dot(fw_left(open), out) < 0.0;
            local[k] = (fw_layout_local){at, open.x, open.y, mirror};
            room = room && has_room(d, fw_add(at, rule->eye_height_m, out));
        }
        for (int k = 0; k < 2 && room; k++) {
            FW_TRY(draw_lug(d, &local[k], &lug[*nlug]));
            FW_NEED(d->lug = fw_arena_grow(d->arena, d->lug, (size_t)d->nlug, (size_t)d->nlug + 1,
                                           sizeof *d->lug));
            d->lug[d->nlug++] = lug[(*nlug)++];
        }
    }
    return FW_OK;
}
