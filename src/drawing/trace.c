/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From points and sweeps to an outline that is closed, simple and counter-clockwise. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>

/* neighbours that join smoothly touch up to sqrt(2 R tolerance) from their common point: 140 nm for
   R = 10 mm */
static const double CORNER_M = 200e-9;

static fw_status flawed(fw_drawing_flaw *flaw, fw_drawing_fault fault, int piece, int other,
                        fw_geometry_vec2 at) {
    *flaw = (fw_drawing_flaw){fault, piece, other, at};
    return FW_GEOMETRY;
}

static void add_piece(fw_geometry_outline *o, fw_geometry_vec2 to, double sweep_rad) {
    fw_geometry_vec2 chord = vec_sub(to, o->at);
    double half = 0.5 * vec_length(chord), turn = 0.5 * fabs(sweep_rad);
    double sagitta = half * tan(0.5 * turn);
    if (sagitta < FW_COINCIDENT_M) { /* no arc can be told from its chord */
        fw_geometry_outline_line(o, to, 0);
        return;
    }
    fw_geometry_vec2 middle = vec_along(o->at, 0.5, chord), left = vec_left(vec_unit(chord));
    double beside = copysign(half / tan(turn), sweep_rad);
    if (turn > 0.5 * FW_PI) beside = -copysign(half / tan(FW_PI - turn), sweep_rad);
    fw_geometry_outline_arc_to(o, vec_along(middle, beside, left), sweep_rad, to, 0);
}

/* is a common point of pieces i < j of n the corner that they share? */
static bool is_corner(const fw_geometry_contour *c, int i, int j, fw_geometry_vec2 at) {
    const fw_geometry_segment *p = &c->segment[i], *q = &c->segment[j];
    bool after = j == i + 1 && vec_distance(at, p->b) <= CORNER_M;
    bool before = i == 0 && j == c->count - 1 && vec_distance(at, q->b) <= CORNER_M;
    return after || before;
}

static bool crosses(const fw_geometry_contour *c, const fw_geometry_box *box, int *first,
                    int *second, fw_geometry_vec2 *at) {
    for (int j = 1; j < c->count; j++)
        for (int i = 0; i < j; i++) {
            if (fw_box_apart(&box[i], &box[j], 2 * FW_COINCIDENT_M)) continue;
            fw_geometry_hit hit[FW_MOST_HITS];
            int hits = fw_geometry_segment_intersect(&c->segment[i], &c->segment[j], hit);
            for (int k = 0; k < hits; k++) {
                if (is_corner(c, i, j, hit[k].at)) continue;
                *first = i, *second = j, *at = hit[k].at;
                return true;
            }
        }
    return false;
}

/* begins at its least corner, from the left and then from below: what is drawn is the same wherever
   the pen was put down */
static void begin_at_least(fw_geometry_contour *c, fw_geometry_segment *spare) {
    int least = 0, n = c->count;
    for (int i = 1; i < n; i++)
        if (vec_before(c->segment[i].a, c->segment[least].a)) least = i;
    for (int i = 0; i < n; i++)
        spare[i] = c->segment[(least + i) % n];
    c->segment = spare;
}

fw_status fw_drawing_trace(fw_arena *arena, fw_geometry_vec2 start, const fw_drawing_piece *piece,
                           int n, fw_geometry_contour *out, fw_drawing_flaw *flaw) {
    *out = (fw_geometry_contour){0};
    *flaw = (fw_drawing_flaw){FW_DRAWING_SOUND, 0, 0, start};
    if (n < 1 || vec_distance(piece[n - 1].to, start) > FW_DRAWING_SAME_M)
        return flawed(flaw, FW_DRAWING_OPEN, n - 1, 0, n < 1 ? start : piece[n - 1].to);
    fw_geometry_outline o = fw_geometry_outline_start(arena, start);
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 to = i == n - 1 ? start : piece[i].to;
        if (vec_distance(to, o.at) <= FW_DRAWING_SAME_M)
            return flawed(flaw, FW_DRAWING_POINT, i, 0, to);
        add_piece(&o, to, piece[i].sweep_rad);
    }
    if (o.failed) return FW_NOMEM;
    fw_geometry_contour made;
    if (o.invalid || fw_geometry_outline_close(&o, &made) != FW_OK || made.count != n)
        return o.failed ? FW_NOMEM : flawed(flaw, FW_DRAWING_FLAT, 0, 0, start);
    fw_geometry_box *box = fw_arena_array(arena, fw_geometry_box, (size_t)n);
    FW_NEED(box);
    for (int i = 0; i < n; i++)
        box[i] = fw_segment_box(&made.segment[i]);
    int first, second;
    fw_geometry_vec2 at;
    if (crosses(&made, box, &first, &second, &at))
        return flawed(flaw, FW_DRAWING_CROSSES, second, first, at);
    double area = fw_geometry_contour_area(&made);
    if (fabs(area) <= FW_DRAWING_SAME_M * fw_geometry_contour_perimeter(&made))
        return flawed(flaw, FW_DRAWING_FLAT, 0, 0, start);
    fw_geometry_segment *spare = fw_arena_array(arena, fw_geometry_segment, (size_t)n);
    FW_NEED(spare);
    *out = made;
    if (area < 0) FW_TRY(fw_geometry_contour_reverse(arena, &made, out));
    begin_at_least(out, spare);
    return FW_OK;
}

const char *fw_drawing_flaw_text(fw_arena *arena, const fw_drawing_flaw *flaw) {
    static const char *const what[] = {
        [FW_DRAWING_SOUND] = "is sound",
        [FW_DRAWING_OPEN] = "does not end where it begins; it ends",
        [FW_DRAWING_POINT] = "has a piece without length",
        [FW_DRAWING_CROSSES] = "crosses or touches itself",
        [FW_DRAWING_FLAT] = "encloses no area",
    };
    char x[32], y[32];
    return fw_arena_printf(arena, "%s at (%s, %s) um", what[flaw->fault],
                           fw_number_text(x, sizeof x, flaw->at.x * 1e6, 7),
                           fw_number_text(y, sizeof y, flaw->at.y * 1e6, 7));
}

/* ---- strokes of paths ---- */

typedef fw_drawing_stroke stroke;

static fw_geometry_vec2 along(const stroke *s, int i) {
    return vec_unit(vec_sub(s->p[i + 1], s->p[i]));
}

/* tangent of half the turn at corner i, 0 < i < n - 1 */
static double half_turn(const stroke *s, int i) {
    fw_geometry_vec2 u = along(s, i - 1), v = along(s, i);
    return fabs(tan(0.5 * atan2(vec_cross(u, v), vec_dot(u, v))));
}

/* a mitre of at most a right angle; its tangent is 1 but for rounding */
static bool is_mitred(const stroke *s, int i) {
    return half_turn(s, i) <= 1 + 1e-4;
}

static bool has_room(const stroke *s) {
    for (int i = 0; i + 1 < s->n; i++) {
        double before = i > 0 ? half_turn(s, i) : 0;
        double after = i + 2 < s->n ? half_turn(s, i + 1) : 0;
        double length = vec_distance(s->p[i], s->p[i + 1]);
        if (i > 0 && !is_mitred(s, i)) return false;
        if (!((before + after) * s->half <= length)) return false;
    }
    return true;
}

static fw_geometry_vec2 beside(fw_geometry_vec2 p, fw_geometry_vec2 u, double forth, double left) {
    return (fw_geometry_vec2){p.x + forth * u.x - left * u.y, p.y + forth * u.y + left * u.x};
}

/* where the two sides meet at corner i, on the left for half > 0 */
static fw_geometry_vec2 mitre(const stroke *s, int i, double half) {
    fw_geometry_vec2 u = along(s, i - 1), v = along(s, i);
    return beside(s->p[i], u, -half * vec_cross(u, v) / (1 + vec_dot(u, v)), half);
}

/* Points of an end, from the left side of the direction u that points out of it to the right: two, or an
   arc. How many; out NULL: only that. */
static int end_points(const stroke *s, fw_geometry_vec2 p, fw_geometry_vec2 u, double extend,
                      fw_geometry_vec2 *out) {
    int chords = 1;
    if (s->round) {
        double inside = fmin(1, s->chord / s->half);
        chords = (int)fmin(720, fmax(4, ceil(FW_PI / (2 * acos(1 - inside)))));
    }
    for (int k = 0; k <= chords && out; k++) {
        double angle = FW_PI * (0.5 - (double)k / chords), beyond = s->round ? cos(angle) : 0;
        double left = k == 0 ? 1 : k == chords ? -1 : sin(angle);
        out[k] = beside(p, u, extend + s->half * beyond, s->half * left);
    }
    return chords + 1;
}

static fw_geometry_vec2 *new_part(fw_arena *arena, fw_drawing_points *part, int n) {
    *part = (fw_drawing_points){fw_arena_array(arena, fw_geometry_vec2, (size_t)n), n};
    return part->p;
}

static fw_status whole_stroke(fw_arena *arena, const stroke *s, fw_drawing_points *part) {
    fw_geometry_vec2 back = vec_scale(-1, along(s, 0)), forth = along(s, s->n - 2), *q;
    int n = end_points(s, s->p[0], back, 0, NULL);
    FW_NEED(q = new_part(arena, part, 2 * (n + s->n - 2)));
    end_points(s, s->p[0], back, s->begin, q);
    for (int i = 1; i + 1 < s->n; i++)
        q[n++] = mitre(s, i, s->half);
    n += end_points(s, s->p[s->n - 1], forth, s->end, q + n);
    for (int i = s->n - 2; i > 0; i--)
        q[n++] = mitre(s, i, -s->half);
    return FW_OK;
}

/* the wedge outside of corner i */
static fw_status corner_part(fw_arena *arena, const stroke *s, int i, fw_drawing_points *part) {
    fw_geometry_vec2 u = along(s, i - 1), v = along(s, i), *q;
    double side = vec_cross(u, v) > 0 ? -s->half : s->half;
    bool mitred = is_mitred(s, i);
    FW_NEED(q = new_part(arena, part, mitred ? 4 : 5));
    q[0] = s->p[i];
    q[1] = beside(s->p[i], u, 0, side);
    q[2] = mitred ? mitre(s, i, side) : beside(s->p[i], u, s->half, side);
    if (!mitred) q[3] = beside(s->p[i], v, -s->half, side);
    q[mitred ? 3 : 4] = beside(s->p[i], v, 0, side);
    return FW_OK;
}

fw_status fw_drawing_stroke_parts(fw_arena *arena, const fw_drawing_stroke *s,
                                  fw_drawing_points **part, int *n) {
    *n = 0;
    FW_NEED(*part = fw_arena_array(arena, fw_drawing_points, 2 * (size_t)s->n + 2));
    if (has_room(s)) return whole_stroke(arena, s, &(*part)[(*n)++]);
    for (int i = 0; i + 1 < s->n; i++) {
        stroke one = *s;
        one.p = s->p + i;
        one.n = 2;
        one.begin = i == 0 ? s->begin : 0;
        one.end = i + 2 == s->n ? s->end : 0;
        one.round = false;
        FW_TRY(whole_stroke(arena, &one, &(*part)[(*n)++]));
        if (i > 0) FW_TRY(corner_part(arena, s, i, &(*part)[(*n)++]));
    }
    for (int k = 0; k < 2 && s->round; k++) {
        fw_geometry_vec2 u = along(s, k ? s->n - 2 : 0), at = s->p[k ? s->n - 1 : 0], *q;
        if (!k) u = vec_scale(-1, u);
        FW_NEED(q = new_part(arena, &(*part)[*n], end_points(s, at, u, 0, NULL)));
        end_points(s, at, u, 0, q);
        ++*n;
    }
    return FW_OK;
}

/* ---- polygons of a cell ---- */

static const double FARTHEST_NM = 268e6; /* what fw_geometry_merge takes */

fw_status fw_drawing_flat_add(fw_drawing_flat *flat, int map, const fw_geometry_vec2 *at, int n,
                              bool hole) {
    flat->points += (size_t)n;
    if (flat->n == FW_DRAWING_SHAPES_MOST || flat->points > FW_DRAWING_POINTS_MOST) return FW_LIMIT;
    if (flat->n == flat->room) {
        int more = flat->room ? 2 * flat->room : 256;
        FW_NEED(flat->shape = fw_arena_grow(flat->arena, flat->shape, (size_t)flat->n, (size_t)more,
                                            sizeof *flat->shape));
        flat->room = more;
    }
    fw_geometry_point *p = fw_arena_array(flat->arena, fw_geometry_point, (size_t)n);
    FW_NEED(p);
    for (int i = 0; i < n; i++) {
        if (!(fabs(at[i].x) < FARTHEST_NM && fabs(at[i].y) < FARTHEST_NM)) return FW_GEOMETRY;
        double x = floor(at[i].x + 0.5), y = floor(at[i].y + 0.5);
        flat->rounded += fabs(at[i].x - x) > 1e-3 || fabs(at[i].y - y) > 1e-3;
        p[i] = (fw_geometry_point){(int32_t)x, (int32_t)y};
    }
    flat->shape[flat->n++] = (fw_drawing_shape){map, {p, n}, hole};
    return FW_OK;
}
