/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From points and sweeps to an outline that is closed, simple and counter-clockwise. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"

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
