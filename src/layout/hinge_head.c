/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The head of a body at a hinge: root block, ring and neck as one outline, and which of its
   dimensions are free. docs/theory/layout.md, sections 3 and 4. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

/* The free dimensions of a head. Attempt 0 is what is wanted. Where an edge of it nearly coincides
   with another edge of the body, the united outline has a step, a tooth or a slit that no mask can
   show. At which dimensions that happens is known only afterwards, and they are isolated: there is
   no largest size that fits to bisect for, but almost any other place in the ranges of
   layout_rules.h is good. Further attempts are therefore the points of a Kronecker sequence, x_i =
   frac(k alpha_i) with alpha_i = g^-i and g^5 = g + 1: in all four dimensions, and in each alone,
   every point is far from all before it. Whoever tries counts; what is still wrong at the end is
   said (FW-D138). */
fw_layout_head_shape fw_layout_head_form(int attempt) {
    static const double alpha[4] = {0.85667488385450291, 0.73389185662709607, 0.62870672103780872,
                                    0.53859725722361010};
    const fw_layout_rules *rule = &fw_layout_rule;
    double x[4];
    if (attempt == 0)
        return (fw_layout_head_shape){1.0, rule->block_behind_widths, 0.0, 0.0, false};
    for (int i = 0; i < 4; i++)
        x[i] = fmod(attempt * alpha[i], 1.0);
    return (fw_layout_head_shape){
        .neck = 1.0 - x[0] * (1.0 - rule->form_neck_least),
        .behind =
            rule->form_behind_least + x[1] * (rule->form_behind_most - rule->form_behind_least),
        .longer_m = x[2] * rule->form_longer_m,
        .wider_m = x[3] * rule->form_wider_m,
        .plain = attempt % 2 == 0,
    };
}
static double cross(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x * q.y - p.y * q.x;
}
static double angle_of(fw_geometry_vec2 p) {
    return atan2(p.y, p.x);
}

/* where the ray from p along the unit vector d leaves the circle of radius q about W */
static fw_geometry_vec2 on_circle(fw_geometry_vec2 p, fw_geometry_vec2 d, double q) {
    double b = fw_dot(p, d);
    return fw_add(p, -b + sqrt(fmax(0.0, b * b - fw_dot(p, p) + q * q)), d);
}

fw_geometry_vec2 fw_layout_ring_foot(const fw_layout_hinge_shape *s, double q) {
    return on_circle(s->outer_end, s->face, q);
}

/* the far side of a root block (away from the bulge): from the inner corner along `into`, then, if
   it turns, from `turn` along `out` */
typedef struct far_side {
    bool turns;
    fw_geometry_vec2 turn, out;
} far_side;

/* The two blocks turn towards each other about W, so the far side follows a ray from W at half the
   free rotation from the symmetry axis. It yields where the block behind the root would become
   thinner than 1.5 t, and stops at half the least space from the axis. */
static far_side choose_far_side(const fw_layout_hinge_shape *s, double ring_in) {
    far_side far = {false, s->inner_corner, s->into};
    const fw_layout_rules *rule = &fw_layout_rule;
    double half = 0.5 * rule->free_rad;
    fw_geometry_vec2 i = s->inner_corner, u = fw_v(-cos(half), sin(half));
    if (cross(s->into, u) > -1e-9) return far; /* leaves the ray behind */
    double ray = cross(i, u) / -cross(s->into, u), gap = ray;
    if (s->into.y < -1e-9) gap = (i.y - rule->half_space_share * rule->least_space_m) / -s->into.y;
    double along = fmax(fmin(ray, gap), rule->far_side_least_m);
    fw_geometry_vec2 x = fw_add(i, along, s->into);
    fw_geometry_vec2 deep = fw_add(s->root, rule->block_least_widths * s->width_m, s->into);
    if (fw_norm(x) > ring_in - rule->block_ring_clear_m) return far;
    double slope = x.x < 0.0 ? x.y / -x.x : 0.0;
    if (deep.x < x.x) slope = fmin(slope, (deep.y - x.y) / (x.x - deep.x));
    if (s->face.x < 0.0) slope = fmin(slope, s->face.y / -s->face.x); /* no acute corner */
    slope = fmax(0.0, slope);
    far.turns = true;
    far.turn = x;
    far.out = fw_towards(fw_v(0.0, 0.0), fw_v(-1.0, slope));
    return far;
}

/* the far side from the neck's outer end inwards: a straight edge to `leave`, then an arc about W
   to `arrive` (or none), then the block's own far side */
typedef struct far_path {
    fw_geometry_vec2 leave, arrive;
    bool arc, turns;
} far_path;

/* Does the straight edge from `from` along `along` leave too little beside the corner where the ring begins at
   the root's face, or cut it off? The whole block hangs on what is between the two. */
static bool thins_ring(const fw_layout_hinge_shape *s, const fw_layout_side *side,
                       fw_geometry_vec2 from, fw_geometry_vec2 along, double long_m) {
    const double least = fw_layout_rule.solid_ring_share * (side->ring_out_m - side->ring_in_m);
    const fw_geometry_vec2 foot = fw_layout_ring_foot(s, side->ring_in_m);
    const double past = fw_dot(fw_sub(foot, from), along);
    return past > 0.0 && past < long_m && fw_dot(fw_sub(from, foot), fw_left(along)) < least;
}

/* The neck's edge runs on into the block, usually 4.5 t behind the root; where it would come too
   near to the other block it gives way to the block's far side. A block that stands out beside the
   neck keeps its fin; where the neck lies beyond the block, or its edge would leave of the ring a
   strip that hardly carries the block, the ring runs on to carry it. */
static far_path choose_far_path(const fw_layout_hinge_shape *s, fw_layout_side *side) {
    const fw_layout_rules *rule = &fw_layout_rule;
    far_side far = choose_far_side(s, side->ring_in_m);
    double q0 = side->ring_in_m, q1 = side->ring_out_m;
    fw_geometry_vec2 u = fw_polar(side->own_rad), v = fw_left(u), w = fw_v(0.0, 0.0),
                     i = s->inner_corner;
    double deep = side->form.behind * s->width_m;
    if (side->root_m >
        0.0) /* nothing turns towards a free leaf's block: as deep as half the neck */
        deep = fmax(deep, side->form.behind / rule->block_behind_widths * side->neck_m);
    double behind = fmax(side->far_m, fw_dot(s->root, v) + deep);
    fw_geometry_vec2 end = fw_add(fw_add(w, side->neck_end_m, u), side->far_m, v);
    fw_geometry_vec2 from = fw_add(fw_add(w, fmin(fw_dot(s->root, u), q0), u), behind, v);
    fw_geometry_vec2 along = fw_towards(from, end), out = fw_left(along);
    double t = fw_dot(fw_sub(from, far.turn), out) / fw_dot(far.out, out);
    double t2 = fw_dot(fw_sub(from, i), out) / fw_dot(s->into, out);
    fw_geometry_vec2 meet = fw_add(far.turn, t, far.out), fin = on_circle(far.turn, far.out, q1);
    bool ahead = fw_dot(far.out, out) > 0.0 && t > rule->far_side_ahead_m;
    bool thin = ahead && thins_ring(s, side, from, along, fw_norm(fw_sub(end, from)));
    double beside = rule->neck_beside_block_m;
    if (ahead && !thin && fw_dot(meet, u) < side->neck_end_m + beside) {
        side->neck_end_m = fmax(side->neck_end_m, fw_dot(meet, u) + beside);
        return (far_path){meet, meet, false, far.turns};
    }
    if (!ahead && far.turns && fw_dot(s->into, out) > 0.0 && t2 > rule->far_side_ahead_m) {
        fw_geometry_vec2 at = fw_add(i, t2, s->into);
        return (far_path){at, at, false, false};
    }
    double q = thin || fw_dot(fw_sub(fin, from), out) > 0.0 ? q1 : q0;
    if (fabs(cross(from, along)) > rule->neck_ring_share * q) { /* too wide to end on the ring */
        from = fw_add(w, rule->neck_ring_share * side->neck_m, v);
        along = u;
    }
    return (far_path){on_circle(from, along, q), on_circle(far.turn, far.out, q), true, far.turns};
}

/* how deep inside a plate; negative outside */
static double plate_depth(const fw_device_body *b, fw_geometry_vec2 p) {
    double c = cos(b->plate_angle_rad), s = sin(b->plate_angle_rad);
    double x = p.x - b->plate_x_m, y = p.y - b->plate_y_m;
    return fmin(0.5 * b->plate_width_m - fabs(c * x + s * y),
                0.5 * b->plate_height_m - fabs(c * y - s * x));
}

/* no corner of the neck's end near the plate's edge: that would leave a tiny step */
static void end_clear_of_edge(fw_layout_side *side) {
    const fw_layout_rules *rule = &fw_layout_rule;
    fw_geometry_vec2 u = side->direction, v = fw_left(u), w = side->local.origin;
    double sign = side->local.mirror ? -1.0 : 1.0, clear = rule->neck_corner_clear_m;
    for (int i = 0; i < rule->neck_corner_steps;
         i++, side->neck_end_m += rule->neck_corner_step_m) {
        fw_geometry_vec2 end = fw_add(w, side->neck_end_m, u);
        if (fabs(plate_depth(side->plate, fw_add(end, sign * side->far_m, v))) > clear &&
            fabs(plate_depth(side->plate, fw_add(end, -sign * side->neck_m, v))) > clear)
            return;
    }
}

/* kept sharp in the first pass of rounding; in both passes */
enum { NOSE = FW_SEGMENT_JOINT | 4, NECK_END = FW_SEGMENT_JOINT | 8 };

static fw_status round_smaller(fw_arena *arena, unsigned release, fw_geometry_contour *contour) {
    fw_geometry_contour round = *contour;
    fw_geometry_vec2 where;
    fw_status status = FW_GEOMETRY;
    for (double radius = fw_layout_rule.corner_m;
         radius > fw_layout_rule.least_head_corner_m && status == FW_GEOMETRY; radius *= 0.5)
        status = fw_geometry_contour_round(arena, contour, radius, radius, &round, &where);
    if (status != FW_OK && status != FW_GEOMETRY) return status;
    if (status == FW_OK) *contour = round; /* else the body's rounding will name the corner */
    for (int i = 0; i < contour->count; i++)
        if (contour->segment[i].flags == release) contour->segment[i].flags = 0;
    return FW_OK;
}

/* Rounded here already, and the block's nose apart, so that a small hinge does not make all corners
   small. The end of the neck disappears in a bar or plate and stays sharp until then. */
static fw_status round_head(fw_arena *arena, fw_layout_side *side) {
    FW_TRY(round_smaller(arena, NOSE, &side->head));
    return round_smaller(arena, NECK_END, &side->head);
}

/* of the flexure between its cut and a fillet */
static void edge(fw_layout_sketch *k, fw_geometry_vec2 centre, double sweep_rad,
                 fw_geometry_vec2 from, fw_geometry_vec2 to) {
    if (sweep_rad != 0.0)
        fw_layout_sketch_arc(k, centre, sweep_rad, to);
    else if (from.x != to.x || from.y != to.y)
        fw_layout_sketch_line(k, to, 0);
}

/* ---- heads of straight leaves ----
   A uniform leaf without conjugate surfaces is alike on both sides of its line, and nothing asks for a ring on one of
   them: its head is a block across the line with a neck in its middle, alike on both sides, too. A head that hangs on one
   side of its root is a hook, which bends far more than it looks. Section 3; decision 238 */

bool fw_layout_leaf_is_free(const fw_device_flexure *f) {
    return f->kind == FW_FLEXURE_LEAF && !(f->gap_m > 0.0) && !fw_device_flexure_varies(f);
}

/* A bar or plate beside the block and about as wide as it would leave a step that cannot be rounded as the rules want: the
   block, and the neck with it, is narrower then by as much as that takes. */
static double half_of_block(const fw_layout_hinge_shape *s, const fw_layout_side *side) {
    const double half = fmax(-s->inner_corner.x, side->neck_m), bar = side->drawn_half_m;
    const double step = bar - half, least = fw_layout_rule.block_step_m;
    return bar > 2.0 * least && fabs(step) < least ? bar - least : half;
}

/* how deep the block is, and how far its shoulders lead towards the neck at 45 degrees: both leave room before the edge of
   what is beside the neck, or the block runs into that */
static double block_depth(const fw_layout_side *side, double half, double *shoulder_m) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const double off = fabs(cos(side->own_rad)) * (side->neck_m + rule->neck_corner_clear_m),
                 plate = side->foot_m > 0.0 ? side->plate_at_m * sin(side->own_rad) - off : 0.0,
                 to_edge = fmax(plate, side->clear_m - side->root_m),
                 room = to_edge - rule->block_depth_m - rule->straight_clear_m;
    *shoulder_m = half - side->neck_m;
    if (to_edge <= rule->block_depth_m) return rule->block_depth_m;
    if (room < 0.0) return to_edge + rule->neck_corner_clear_m;
    *shoulder_m = fmin(*shoulder_m, room);
    return rule->block_depth_m;
}

/* block and neck: the block as deep as a ring is thick, the neck's middle from foot_m on the leaf's line */
static fw_status draw_straight(fw_arena *arena, const fw_layout_hinge_shape *s,
                               fw_layout_side *side) {
    const double half = half_of_block(s, side);
    side->neck_m = fmin(side->neck_m, half);
    double shoulder;
    const double at = s->root.y, neck = side->neck_m, lean = cos(side->own_rad);
    const double deep = block_depth(side, half, &shoulder);
    const bool upright = fabs(lean) < 1e-9;
    const fw_geometry_vec2 u = upright ? fw_v(0.0, 1.0) : fw_polar(side->own_rad), v = fw_left(u),
                           foot = fw_v(0.0, side->foot_m);
    const double begin = (at - foot.y + deep + shoulder + neck * fabs(lean)) / u.y;
    side->solid_m = begin;
    side->neck_end_m =
        fmax(side->neck_end_m, begin + (side->foot_m > 0.0 ? fw_layout_rule.neck_corner_clear_m
                                                           : fw_layout_rule.bar_overlap_m));
    const fw_geometry_vec2 from = fw_add(foot, begin, u), end = fw_add(foot, side->neck_end_m, u),
                           brow = fw_v(half - shoulder, at + deep + shoulder);

    fw_layout_sketch k = fw_layout_sketch_start(arena, &side->local, s->joint_in);
    fw_layout_sketch_line(&k, s->joint_out, s->cut_flags);
    fw_layout_sketch_arc(&k, s->outer_centre, s->outer_sweep_rad, s->outer_end);
    fw_layout_sketch_line(&k, fw_v(half, at), 0);
    if (half > neck) fw_layout_sketch_line(&k, fw_v(half, at + deep), 0);
    if (brow.x > neck) fw_layout_sketch_line(&k, brow, 0);
    if (half > neck || !upright) fw_layout_sketch_line(&k, fw_add(from, -neck, v), 0);
    fw_layout_sketch_line(&k, fw_add(end, -neck, v), 0);
    fw_layout_sketch_line(&k, fw_add(end, neck, v), NECK_END);
    if (half > neck || !upright) fw_layout_sketch_line(&k, fw_add(from, neck, v), 0);
    if (brow.x > neck) fw_layout_sketch_line(&k, fw_v(-brow.x, brow.y), 0);
    if (half > neck) fw_layout_sketch_line(&k, fw_v(-half, at + deep), 0);
    fw_layout_sketch_line(&k, fw_v(-half, at), 0);
    fw_layout_sketch_line(&k, s->inner_start, 0);
    fw_layout_sketch_arc(&k, s->inner_centre, s->inner_sweep_rad, s->inner_end);
    FW_TRY(fw_layout_sketch_close(&k, &side->head));
    return round_head(arena, side);
}

/* What a hinge keeps free of a body: the round place. Of the body that a straight head belongs to only what is before its
   root: what stands beside the head moves with it. */
fw_status fw_layout_hinge_place(fw_arena *arena, const fw_layout_side *own, fw_geometry_vec2 centre,
                                double radius_m, fw_geometry_contour *place) {
    if (!own || !own->straight || own->clear_m >= radius_m)
        return fw_geometry_contour_disc(arena, centre, radius_m, place);
    const double y = own->clear_m, x = sqrt(radius_m * radius_m - y * y), a = atan2(y, x);
    fw_layout_sketch k = fw_layout_sketch_start(arena, &own->local, fw_v(-x, y));
    fw_layout_sketch_arc(&k, fw_v(0.0, 0.0), FW_PI + 2.0 * a, fw_v(x, y));
    fw_layout_sketch_line(&k, fw_v(-x, y), 0);
    return fw_layout_sketch_close(&k, place);
}

/* root block, ring and neck of one body, in its own frame (block at positive y) */
fw_status fw_layout_head_draw_shape(fw_arena *arena, const fw_layout_hinge_shape *s,
                                    fw_layout_side *side) {
    if (side->straight) return draw_straight(arena, s, side);
    const fw_layout_rules *rule = &fw_layout_rule;
    double q0 = side->ring_in_m, q1 = side->ring_out_m, end = side->ring_end_rad;
    fw_geometry_vec2 w = fw_v(0.0, 0.0), q = fw_layout_ring_foot(s, q0), cap = fw_polar(end);
    fw_geometry_vec2 u = fw_polar(side->own_rad), v = fw_left(u);
    fw_geometry_vec2 near_edge = fw_add(w, -side->neck_m, v), foot = on_circle(near_edge, u, q1);
    double turn = side->own_rad - asin(side->neck_m / q1) - end;
    double end_m = side->neck_end_m;
    far_path far = choose_far_path(s, side);
    if (side->far_m > side->neck_m && fw_dot(far.leave, u) > side->corner_m - rule->tooth_room_m) {
        side->far_m = side->neck_m; /* the block ends too near to the plate's corner */
        side->neck_end_m = end_m;
        far = choose_far_path(s, side);
    }
    if (side->plate) end_clear_of_edge(side);
    side->solid_m =
        fmax(q0 + rule->solid_ring_share * (q1 - q0), fw_dot(far.leave, u) + rule->solid_past_m);

    fw_layout_sketch k = fw_layout_sketch_start(arena, &side->local, s->joint_in);
    fw_layout_sketch_line(&k, s->joint_out, s->cut_flags);
    edge(&k, s->edge_centre, s->edge_sweep_rad, s->joint_out, s->outer_start);
    fw_layout_sketch_arc(&k, s->outer_centre, s->outer_sweep_rad, s->outer_end);
    fw_layout_sketch_line(&k, q, 0);
    fw_layout_sketch_arc(&k, w, end - angle_of(q), fw_add(w, q0, cap));
    fw_layout_sketch_line(&k, fw_add(w, q1, cap), 0);
    fw_layout_sketch_arc(&k, w, turn, foot);
    fw_layout_sketch_line(&k, fw_add(near_edge, side->neck_end_m, u), 0);
    fw_layout_sketch_line(&k, fw_add(fw_add(w, side->far_m, v), side->neck_end_m, u), NECK_END);
    fw_layout_sketch_line(&k, far.leave, 0);
    if (far.arc)
        fw_layout_sketch_arc(
            &k, w, remainder(angle_of(far.arrive) - angle_of(far.leave), 2.0 * FW_PI), far.arrive);
    if (far.turns) fw_layout_sketch_line(&k, choose_far_side(s, q0).turn, 0);
    fw_layout_sketch_line(&k, s->inner_corner, far.turns ? NOSE : 0);
    fw_layout_sketch_line(&k, s->inner_start, NOSE);
    fw_layout_sketch_arc(&k, s->inner_centre, s->inner_sweep_rad, s->inner_end);
    edge(&k, s->inner_edge_centre, s->inner_edge_sweep_rad, s->inner_end, s->joint_in);
    FW_TRY(fw_layout_sketch_close(&k, &side->head));
    return round_head(arena, side);
}

/* ---- the neck ---- */

/* A plate's rim around the hinge ends at a corner on the far side of the neck. When that leaves
   only a narrow tooth beside the neck, the neck widens over it. */
static void widen_to_corner(fw_layout_side *side, double disc) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double start = asin(side->neck_m / disc), sign = side->local.mirror ? -1.0 : 1.0;
    double end = start + rule->tooth_search_m / disc, step = rule->tooth_step_m / disc;
    for (double turn = start; turn < end; turn += step) {
        if (side->own_rad + turn > FW_PI - 0.5 * rule->free_rad || turn > rule->tooth_turn_rad)
            return;
        fw_geometry_vec2 e =
            fw_v(cos(turn) * side->direction.x - sign * sin(turn) * side->direction.y,
                 cos(turn) * side->direction.y + sign * sin(turn) * side->direction.x);
        if (plate_depth(side->plate, fw_add(side->local.origin, disc, e)) > 0.0) continue;
        side->far_m = fmax(side->neck_m, disc * sin(turn) + rule->tooth_past_m);
        side->corner_m = disc * cos(turn);
        side->neck_end_m += rule->tooth_longer_m;
        return;
    }
}

static double half_of_neck(const fw_layout_side *side, double half_width_m) {
    const fw_layout_rules *rule = &fw_layout_rule;
    return side->form.neck *
           fmin(half_width_m - rule->neck_inset_m, rule->neck_rings * side->ring_out_m);
}

/* ---- on the line of a leaf ---- */

typedef struct entry {
    double begins_m; /* from the root along the neck */
    double square_m; /* the same; 0: that edge of the plate is not square to the neck */
} entry;

/* turns a direction of the body into the plate's own */
static fw_layout_local plate_frame(const fw_device_body *b) {
    return (fw_layout_local){{0.0, 0.0}, cos(b->plate_angle_rad), -sin(b->plate_angle_rad), false};
}

/* the lesser half of the plate beside a leaf's line through p; 0: its sides are not along that */
static double half_beside(const fw_device_body *b, fw_geometry_vec2 p, fw_geometry_vec2 line) {
    const fw_layout_local plate = plate_frame(b);
    const fw_geometry_vec2 along = fw_layout_local_point(&plate, line),
                           at = fw_layout_local_point(&plate,
                                                      fw_sub(p, fw_v(b->plate_x_m, b->plate_y_m)));
    if (fabs(along.y) > 1.0 - 1e-9) return fmax(0.0, 0.5 * b->plate_width_m - fabs(at.x));
    if (fabs(along.x) > 1.0 - 1e-9) return fmax(0.0, 0.5 * b->plate_height_m - fabs(at.y));
    return 0.0;
}

/* Where the neck from p along u enters the plate, with the clearance of corners on either side and through one of its
   edges, nearly enough across that, if it does and has room to end inside */
static bool enters_plate(const fw_device_body *b, fw_geometry_vec2 p, fw_geometry_vec2 u,
                         double half, entry *to) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_layout_local plate = plate_frame(b);
    const double size[2] = {0.5 * b->plate_width_m, 0.5 * b->plate_height_m};
    const double least = rule->block_depth_m + rule->straight_clear_m;
    const fw_geometry_vec2 way = fw_layout_local_point(&plate, u), across = fw_left(u);
    const double d[2] = {way.x, way.y};
    int through[2] = {0, 0};
    double out = HUGE_VAL;
    *to = (entry){0};
    for (int i = 0; i < 2; i++) {
        const double off = (i ? 1.0 : -1.0) * (half + rule->neck_corner_clear_m);
        const fw_geometry_vec2 q = fw_layout_local_point(
            &plate, fw_sub(fw_add(p, off, across), fw_v(b->plate_x_m, b->plate_y_m)));
        const double from[2] = {q.x, q.y};
        double in = 0.0;
        for (int k = 0; k < 2; k++) {
            if (fabs(d[k]) < 1e-12 && fabs(from[k]) >= size[k]) return false;
            if (fabs(d[k]) < 1e-12) continue;
            const double edge = copysign(size[k], d[k]), at = (-edge - from[k]) / d[k];
            out = fmin(out, (edge - from[k]) / d[k]);
            if (at > in) in = at, through[i] = k + 1;
        }
        to->begins_m = fmax(to->begins_m, in);
    }
    if (through[0] != through[1]) return false;
    const double slope = through[0] ? fabs(d[through[0] - 1]) : 1.0;
    to->square_m = through[0] && slope > 1.0 - 1e-9 ? to->begins_m : 0.0;
    return slope > cos(rule->oblique_side_rad) &&
           out > fmax(to->begins_m, least) + rule->neck_into_plate_m + rule->form_longer_m +
                     rule->neck_corner_clear_m;
}

/* from the root along the leaf's line, or as little off it towards the plate's middle as leads into the plate */
static bool lead_into_plate(fw_layout_side *side) {
    static const double narrower[] = {1.0, 0.7, 0.5};
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_device_body *b = side->plate;
    const fw_geometry_vec2 w = side->local.origin,
                           root = fw_layout_local_point(&side->local, fw_v(0.0, side->root_m)),
                           line = fw_towards(w, root),
                           to = fw_sub(fw_v(b->plate_x_m, b->plate_y_m), root);
    const double sign = cross(line, to) < 0.0 ? -1.0 : 1.0, hand = side->local.mirror ? -1.0 : 1.0;
    for (size_t i = 0; i < sizeof narrower / sizeof narrower[0]; i++)
        for (double turn = 0.0; turn < rule->oblique_rad; turn += rule->oblique_step_rad) {
            const double half_width = narrower[i] * side->half_width_m;
            const fw_geometry_vec2 u =
                turn > 0.0 ? fw_geometry_vec_rotate(line, sign * turn) : line;
            entry to_plate;
            if (!enters_plate(b, root, u, half_of_neck(side, half_width), &to_plate)) continue;
            side->half_width_m = half_width;
            side->direction = u;
            side->own_rad = 0.5 * FW_PI + hand * sign * turn;
            side->plate_at_m = to_plate.begins_m;
            side->drawn_half_m = half_beside(b, root, line);
            side->square_at_m = to_plate.square_m > 0.0 ? to_plate.square_m + side->root_m : 0.0;
            side->foot_m = side->root_m;
            return true;
        }
    return false;
}

/* `axis` tells on which side of a free leaf rings would bulge, and there are none: a head has its neck where its body is,
   so that hinges that mirror each other are drawn as mirror images however their axes are written. */
void fw_layout_side_straighten(fw_layout_side *side, const fw_layout_hinge_shape *s) {
    side->root_m = s->root.y;
    if (sin(side->own_rad) < -1e-9) return; /* beyond its own root: as it always was */
    side->straight = side->plate && lead_into_plate(side);
    side->straight =
        side->straight || fabs(side->own_rad - 0.5 * FW_PI) < fw_layout_rule.straight_rad;
    if (cos(side->own_rad) > -1e-9) return;
    side->local =
        (fw_layout_local){side->local.origin, -side->local.c, -side->local.s, !side->local.mirror};
    side->own_rad = FW_PI - side->own_rad;
}

void fw_layout_neck_choose(fw_layout_side *side, double keep_out_m) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_layout_head_shape *c = &side->form;
    side->neck_m = half_of_neck(side, side->half_width_m);
    side->far_m = side->neck_m;
    side->neck_end_m = keep_out_m + rule->neck_beyond_m + c->longer_m;
    side->clear_m = side->root_m + rule->straight_clear_m + c->wider_m;
    if (side->drawn_at_m > 0.0)
        side->neck_end_m =
            fmax(side->drawn_at_m, keep_out_m + c->wider_m) + rule->neck_into_plate_m + c->longer_m;
    if (!side->plate) return;
    if (side->straight && side->foot_m > 0.0) {
        /* an edge of the plate that ends beside the root would leave a step: all of it stands back */
        if (side->square_at_m > side->root_m &&
            side->square_at_m < side->clear_m + rule->own_hollow_m)
            side->clear_m = side->square_at_m + rule->straight_clear_m;
        side->neck_end_m = fmax(side->plate_at_m, side->clear_m - side->root_m) +
                           rule->neck_into_plate_m + c->longer_m;
        return;
    }
    double disc = keep_out_m + c->wider_m;
    side->neck_end_m =
        fmax(disc, side->plate_at_m + side->neck_m) + rule->neck_into_plate_m + c->longer_m;
    if (!c->plain && !side->straight) widen_to_corner(side, disc);
}
