/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges: where the bulge points, the two rings about W, root blocks. docs/theory/layout.md, 2-3.
 */
#include "layout/draw.h"
#include "base/constants.h"
#include <math.h>

static const fw_hinge_drawer drawers[] = {
    {FW_FLEXURE_CSFH, fw_hinge_shape_csfh},
    {FW_FLEXURE_LEAF, fw_hinge_shape_leaf},
};

/* tried in this order where an outline comes out with a step, a tooth or a slit too small to make
 */
static const fw_head_choice choices[] = {
    {1.0, 4.5, 0.0, 0.0, false},     {0.93, 4.5, 8e-6, 4e-6, false},
    {1.0, 4.5, 20e-6, 10e-6, false}, {0.86, 3.2, 14e-6, 16e-6, true},
    {0.97, 6.0, 30e-6, 7e-6, true},  {0.8, 3.2, 5e-6, 13e-6, false},
    {0.72, 2.5, 24e-6, 20e-6, true}, {0.62, 2.0, 12e-6, 24e-6, true},
    {0.9, 7.5, 40e-6, 2e-6, false},  {0.5, 1.6, 36e-6, 17e-6, true},
};

bool fw_head_exists(int choice) {
    return choice >= 0 && (size_t)choice < sizeof choices / sizeof choices[0];
}

double fw_head_wider(const fw_side *side) {
    return choices[side->choice].wider_m;
}

static double cross(fw_vec2 p, fw_vec2 q) {
    return p.x * q.y - p.y * q.x;
}
static double angle_of(fw_vec2 p) {
    return atan2(p.y, p.x);
}

/* where the ray from p along the unit vector d leaves the circle of radius q about W */
static fw_vec2 on_circle(fw_vec2 p, fw_vec2 d, double q) {
    double b = fw_dot(p, d);
    return fw_add(p, -b + sqrt(fmax(0.0, b * b - fw_dot(p, p) + q * q)), d);
}

static fw_vec2 near_point(const fw_hinge_shape *s, double q) {
    return on_circle(s->outer_end, s->face, q);
}

/* the far side of a root block (away from the bulge): from the inner corner along `into`, then, if
   it turns, from `turn` along `out` */
typedef struct far_side {
    bool turns;
    fw_vec2 turn, out;
} far_side;

/* The two blocks turn towards each other about W, so the far side follows a ray from W at half the
   free rotation from the symmetry axis. It yields where the block behind the root would become
   thinner than 1.5 t, and stops at half the least space from the axis. */
static far_side choose_far_side(const fw_hinge_shape *s, double ring_in) {
    far_side far = {false, s->inner_corner, s->into};
    fw_vec2 i = s->inner_corner, u = fw_v(-cos(0.5 * FW_FREE_RAD), sin(0.5 * FW_FREE_RAD));
    if (cross(s->into, u) > -1e-9) return far; /* leaves the ray behind */
    double ray = cross(i, u) / -cross(s->into, u), gap = ray;
    if (s->into.y < -1e-9) gap = (i.y - 0.525 * FW_LEAST_SPACE_M) / -s->into.y;
    double along = fmax(fmin(ray, gap), 1e-6);
    fw_vec2 x = fw_add(i, along, s->into), deep = fw_add(s->root, 1.5 * s->width_m, s->into);
    if (fw_norm(x) > ring_in - 15e-6) return far;
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
    fw_vec2 leave, arrive;
    bool arc, turns;
} far_path;

/* The neck's edge runs on into the block, usually 4.5 t behind the root; where it would come too
   near to the other block it gives way to the block's far side. A block that stands out beside the
   neck keeps its fin; where the neck lies beyond the block the ring runs on to carry it. */
static far_path choose_far_path(const fw_hinge_shape *s, fw_side *side) {
    far_side far = choose_far_side(s, side->ring_in_m);
    double q0 = side->ring_in_m, q1 = side->ring_out_m;
    fw_vec2 u = fw_polar(side->own_rad), v = fw_left(u), w = fw_v(0.0, 0.0), i = s->inner_corner;
    double behind =
        fmax(side->far_m, fw_dot(s->root, v) + choices[side->choice].behind * s->width_m);
    fw_vec2 end = fw_add(fw_add(w, side->neck_end_m, u), side->far_m, v);
    fw_vec2 from = fw_add(fw_add(w, fmin(fw_dot(s->root, u), q0), u), behind, v);
    fw_vec2 along = fw_towards(from, end), out = fw_left(along);
    double t = fw_dot(fw_sub(from, far.turn), out) / fw_dot(far.out, out);
    double t2 = fw_dot(fw_sub(from, i), out) / fw_dot(s->into, out);
    fw_vec2 meet = fw_add(far.turn, t, far.out), fin = on_circle(far.turn, far.out, q1);
    bool ahead = fw_dot(far.out, out) > 0.0 && t > 5e-6;
    if (ahead && fw_dot(meet, u) < side->neck_end_m + 40e-6) {
        side->neck_end_m = fmax(side->neck_end_m, fw_dot(meet, u) + 40e-6);
        return (far_path){meet, meet, false, far.turns};
    }
    if (!ahead && far.turns && fw_dot(s->into, out) > 0.0 && t2 > 5e-6) {
        fw_vec2 at = fw_add(i, t2, s->into);
        return (far_path){at, at, false, false};
    }
    double q = fw_dot(fw_sub(fin, from), out) > 0.0 ? q1 : q0;
    if (fabs(cross(from, along)) > 0.9 * q) { /* too wide to end on the ring */
        from = fw_add(w, 0.9 * side->neck_m, v);
        along = u;
    }
    return (far_path){on_circle(from, along, q), on_circle(far.turn, far.out, q), true, far.turns};
}

/* how deep inside a plate; negative outside */
static double plate_depth(const fw_body *b, fw_vec2 p) {
    double c = cos(b->plate_angle_rad), s = sin(b->plate_angle_rad);
    double x = p.x - b->plate_x_m, y = p.y - b->plate_y_m;
    return fmin(0.5 * b->plate_width_m - fabs(c * x + s * y),
                0.5 * b->plate_height_m - fabs(c * y - s * x));
}

/* no corner of the neck's end within 12 um of the plate's edge: that would leave a tiny step */
static void end_clear_of_edge(fw_side *side) {
    fw_vec2 u = side->direction, v = fw_left(u), w = side->local.origin;
    double sign = side->local.mirror ? -1.0 : 1.0;
    for (int i = 0; i < 20; i++, side->neck_end_m += 6e-6) {
        fw_vec2 end = fw_add(w, side->neck_end_m, u);
        if (fabs(plate_depth(side->plate, fw_add(end, sign * side->far_m, v))) > 12e-6 &&
            fabs(plate_depth(side->plate, fw_add(end, -sign * side->neck_m, v))) > 12e-6)
            return;
    }
}

/* kept sharp in the first pass of rounding; in both passes */
enum { NOSE = FW_SEGMENT_JOINT | 4, NECK_END = FW_SEGMENT_JOINT | 8 };

static fw_status round_smaller(fw_arena *arena, unsigned release, fw_contour *contour) {
    fw_contour round = *contour;
    fw_vec2 where;
    fw_status status = FW_GEOMETRY;
    for (double radius = FW_CORNER_M; radius > 0.5e-6 && status == FW_GEOMETRY; radius *= 0.5)
        status = fw_contour_round(arena, contour, radius, radius, &round, &where);
    if (status != FW_OK && status != FW_GEOMETRY) return status;
    if (status == FW_OK) *contour = round; /* else the body's rounding will name the corner */
    for (int i = 0; i < contour->count; i++)
        if (contour->segment[i].flags == release) contour->segment[i].flags = 0;
    return FW_OK;
}

/* Rounded here already, and the block's nose apart, so that a small hinge does not make all corners
   small. The end of the neck disappears in a bar or plate and stays sharp until then. */
static fw_status round_head(fw_arena *arena, fw_side *side) {
    FW_TRY(round_smaller(arena, NOSE, &side->head));
    return round_smaller(arena, NECK_END, &side->head);
}

/* of the flexure between its cut and a fillet */
static void edge(fw_sketch *k, fw_vec2 centre, double sweep_rad, fw_vec2 from, fw_vec2 to) {
    if (sweep_rad != 0.0)
        fw_sketch_arc(k, centre, sweep_rad, to);
    else if (from.x != to.x || from.y != to.y)
        fw_sketch_line(k, to, 0);
}

/* root block, ring and neck of one body, in its own frame (block at positive y) */
static fw_status draw_head(fw_arena *arena, const fw_hinge_shape *s, fw_side *side) {
    double q0 = side->ring_in_m, q1 = side->ring_out_m, end = side->ring_end_rad;
    fw_vec2 w = fw_v(0.0, 0.0), q = near_point(s, q0), cap = fw_polar(end);
    fw_vec2 u = fw_polar(side->own_rad), v = fw_left(u);
    fw_vec2 near_edge = fw_add(w, -side->neck_m, v), foot = on_circle(near_edge, u, q1);
    double turn = side->own_rad - asin(side->neck_m / q1) - end;
    double end_m = side->neck_end_m;
    far_path far = choose_far_path(s, side);
    if (side->far_m > side->neck_m && fw_dot(far.leave, u) > side->corner_m - 25e-6) {
        side->far_m = side->neck_m; /* the block ends too near to the plate's corner */
        side->neck_end_m = end_m;
        far = choose_far_path(s, side);
    }
    if (side->plate) end_clear_of_edge(side);
    side->solid_m = fmax(q0 + 0.4 * (q1 - q0), fw_dot(far.leave, u) + 6e-6);

    fw_sketch k = fw_sketch_start(arena, &side->local, s->joint_in);
    fw_sketch_line(&k, s->joint_out, s->cut_flags);
    edge(&k, s->edge_centre, s->edge_sweep_rad, s->joint_out, s->outer_start);
    fw_sketch_arc(&k, s->outer_centre, s->outer_sweep_rad, s->outer_end);
    fw_sketch_line(&k, q, 0);
    fw_sketch_arc(&k, w, end - angle_of(q), fw_add(w, q0, cap));
    fw_sketch_line(&k, fw_add(w, q1, cap), 0);
    fw_sketch_arc(&k, w, turn, foot);
    fw_sketch_line(&k, fw_add(near_edge, side->neck_end_m, u), 0);
    fw_sketch_line(&k, fw_add(fw_add(w, side->far_m, v), side->neck_end_m, u), NECK_END);
    fw_sketch_line(&k, far.leave, 0);
    if (far.arc)
        fw_sketch_arc(&k, w, remainder(angle_of(far.arrive) - angle_of(far.leave), 2.0 * FW_PI),
                      far.arrive);
    if (far.turns) fw_sketch_line(&k, choose_far_side(s, q0).turn, 0);
    fw_sketch_line(&k, s->inner_corner, far.turns ? NOSE : 0);
    fw_sketch_line(&k, s->inner_start, NOSE);
    fw_sketch_arc(&k, s->inner_centre, s->inner_sweep_rad, s->inner_end);
    edge(&k, s->inner_edge_centre, s->inner_edge_sweep_rad, s->inner_end, s->joint_in);
    FW_TRY(fw_sketch_close(&k, &side->head));
    return round_head(arena, side);
}

/* ---- which way ---- */

/* where a body's material lies, seen from one of its hinges */
static fw_vec2 body_target(const fw_drawing *d, int body, int joint) {
    const fw_device *device = d->device;
    fw_vec2 here = fw_joint_point(device, joint), other = here;
    int n = 0;
    for (int j = 0; j < device->njoint; j++) {
        if (device->joint[j].body_a != body && device->joint[j].body_b != body) continue;
        fw_vec2 p = fw_joint_point(device, j);
        n++;
        if (j != joint) other = p;
    }
    if (body >= 0 && !isnan(device->body[body].plate_width_m))
        return fw_v(device->body[body].plate_x_m, device->body[body].plate_y_m);
    if (n == 2) return other;
    if (n > 2 && body >= 0) return fw_body_hub(d, body);
    if (body >= 0) return fw_v(device->body[body].x_m, device->body[body].y_m);
    fw_vec2 out = fw_sub(here, d->centre); /* own base: straight to the frame */
    if (fabs(out.x) > fabs(out.y)) return fw_add(here, out.x > 0.0 ? 1.0 : -1.0, fw_v(1.0, 0.0));
    return fw_add(here, out.y > 0.0 ? 1.0 : -1.0, fw_v(0.0, 1.0));
}

/* from W along its direction until a body's plate begins; 0: inside, or no plate */
static double plate_begins(const fw_body *b, fw_vec2 w, fw_vec2 direction) {
    double c = cos(b->plate_angle_rad), s = sin(b->plate_angle_rad), begin = 0.0;
    fw_vec2 to = fw_sub(w, fw_v(b->plate_x_m, b->plate_y_m));
    double x = fabs(c * to.x + s * to.y) - 0.5 * b->plate_width_m;
    double y = fabs(c * to.y - s * to.x) - 0.5 * b->plate_height_m;
    if (x > 0.0) begin = fmax(begin, x / fabs(c * direction.x + s * direction.y));
    if (y > 0.0) begin = fmax(begin, y / fabs(c * direction.y - s * direction.x));
    return begin;
}

static double half_width(const fw_drawing *d, int body) {
    const fw_device *device = d->device;
    if (body >= 0) {
        const fw_body *b = &device->body[body];
        double plate = 0.2 * fmin(b->plate_width_m, b->plate_height_m), wide = 0.5 * b->width_m;
        if (isnan(plate)) return wide;
        return fmin(isnan(wide) ? 0.5 * FW_NECK_WIDTH_M : wide, plate);
    }
    double widest = 0.0;
    for (int i = 0; i < device->nbody; i++)
        if (device->body[i].width_m > widest) widest = device->body[i].width_m;
    return 0.5 * (widest > 0.0 ? fmin(FW_BASE_WIDTH_M, 2.0 * widest) : FW_BASE_WIDTH_M);
}

/* joints between a body and the ground, so that mirrored hinges get mirrored rings */
int fw_steps_to_ground(const fw_device *device, int body) {
    enum { MOST = 64 };
    unsigned char level[MOST + 1] = {0}; /* 1 + steps; 0: not reached */
    if (device->nbody > MOST) return body;
    level[device->nbody] = 1;
    for (int round = 0; round < device->nbody; round++)
        for (int j = 0; j < device->njoint; j++) {
            int a = device->joint[j].body_a, b = device->joint[j].body_b;
            a = a < 0 ? device->nbody : a;
            b = b < 0 ? device->nbody : b;
            if (level[a] == round + 1 && !level[b]) level[b] = (unsigned char)(round + 2);
            if (level[b] == round + 1 && !level[a]) level[a] = (unsigned char)(round + 2);
        }
    return level[body < 0 ? device->nbody : body];
}

static double choose_axis(const fw_drawing *d, int joint, fw_vec2 da, fw_vec2 db) {
    const fw_joint *j = &d->device->joint[joint];
    if (!isnan(j->axis_rad)) return j->axis_rad;
    fw_vec2 between = fw_add(da, 1.0, db);
    if (fw_norm(between) > 0.2) return angle_of(fw_v(-between.x, -between.y));
    fw_vec2 side = fw_left(da), away = fw_sub(fw_joint_point(d->device, joint), d->centre);
    if (fw_dot(side, away) < 0.0) side = fw_v(-side.x, -side.y);
    return angle_of(side);
}

static void choose_sides(fw_drawing *d, int joint, fw_hinge_plan *plan, double *axis) {
    const fw_joint *j = &d->device->joint[joint];
    fw_vec2 w = fw_joint_point(d->device, joint);
    fw_vec2 da = fw_towards(w, body_target(d, j->body_a, joint));
    fw_vec2 db = fw_towards(w, body_target(d, j->body_b, joint));
    *axis = choose_axis(d, joint, da, db);
    fw_vec2 n = fw_polar(*axis);
    bool a_up = cross(n, da) >= cross(n, db);
    for (int i = 0; i < 2; i++) {
        fw_side *side = &plan->side[i];
        bool is_a = (i == 1) == a_up;
        side->body = is_a ? j->body_a : j->body_b;
        side->direction = is_a ? da : db;
        side->half_width_m = half_width(d, side->body);
        if (side->body >= 0 && !isnan(d->device->body[side->body].plate_width_m))
            side->plate = &d->device->body[side->body];
        if (side->plate) side->plate_at_m = plate_begins(side->plate, w, side->direction);
        side->local = (fw_local){w, n.x, n.y, i == 0};
        double up = cross(n, side->direction), along = fw_dot(n, side->direction);
        side->own_rad = atan2(i == 0 ? -up : up, along);
        if (side->own_rad < -0.5 * FW_PI) side->own_rad += 2.0 * FW_PI;
    }
    int low = fw_steps_to_ground(d->device, plan->side[0].body);
    int high = fw_steps_to_ground(d->device, plan->side[1].body);
    plan->convex = low == high ? plan->side[1].body > plan->side[0].body : high > low;
}

/* ---- the rings ---- */

/* A plate's rim around the hinge ends at a corner on the far side of the neck. When that leaves
   only a narrow tooth beside the neck, the neck widens over it. */
static void widen_to_corner(fw_side *side, double disc) {
    double start = asin(side->neck_m / disc), sign = side->local.mirror ? -1.0 : 1.0;
    for (double turn = start; turn < start + 120e-6 / disc; turn += 1e-6 / disc) {
        if (side->own_rad + turn > FW_PI - 0.5 * FW_FREE_RAD || turn > 1.2) return;
        fw_vec2 e = fw_v(cos(turn) * side->direction.x - sign * sin(turn) * side->direction.y,
                         cos(turn) * side->direction.y + sign * sin(turn) * side->direction.x);
        if (plate_depth(side->plate, fw_add(side->local.origin, disc, e)) > 0.0) continue;
        side->far_m = fmax(side->neck_m, disc * sin(turn) + 3e-6);
        side->corner_m = disc * cos(turn);
        side->neck_end_m += 60e-6;
        return;
    }
}

static void choose_neck(fw_side *side, double keep_out_m) {
    const fw_head_choice *c = &choices[side->choice];
    side->neck_m = c->neck * fmin(side->half_width_m - 3e-6, 0.45 * side->ring_out_m);
    side->far_m = side->neck_m;
    side->neck_end_m = keep_out_m + 12e-6 + c->longer_m;
    if (!side->plate) return;
    double disc = keep_out_m + c->wider_m;
    side->neck_end_m = fmax(disc, side->plate_at_m + side->neck_m) + 30e-6 + c->longer_m;
    if (!c->plain) widen_to_corner(side, disc);
}

/* radii about W, from inside: flexure, free width, convex ring, gap, concave ring */
static void choose_rings(fw_hinge_plan *plan, double gap) {
    const fw_hinge_shape *s = &plan->shape[0], *t = &plan->shape[1];
    double free_width = fmin(fmax(0.3 * s->size_m, 12e-6), 20e-6);
    double thick =
        fmax(3.0 * fmax(s->width_m, t->width_m), fmin(fmax(0.5 * s->size_m, 24e-6), FW_RING_M));
    fw_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    double reach = fmax(fmax(s->reach_m, fw_norm(s->inner_corner)),
                        fmax(t->reach_m, fw_norm(t->inner_corner)));
    in->ring_in_m = reach + free_width;
    in->ring_out_m = in->ring_in_m + thick;
    out->ring_in_m = in->ring_out_m + (gap > 0.0 ? gap : FW_CORNER_M);
    out->ring_out_m = out->ring_in_m + thick;
    for (int i = 0; i < 2; i++)
        choose_neck(&plan->side[i], out->ring_out_m + FW_BESIDE_RING_M);
}

/* A ring runs on past the bulge until the other body's stem (inside) or bar (outside) is the free
   rotation away. Returns the sector in which the two surfaces face each other. */
static double choose_ring_ends(fw_hinge_plan *plan, double gap) {
    const fw_hinge_shape *s = &plan->shape[plan->convex];
    fw_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    double stem =
        fmin(angle_of(near_point(s, in->ring_in_m)), angle_of(near_point(s, in->ring_out_m)));
    double bar = in->own_rad - asin(in->neck_m / out->ring_in_m);
    in->ring_end_rad = fmax(FW_FREE_RAD - stem, -1.75);
    out->ring_end_rad = fmax(FW_FREE_RAD - bar, -1.75);
    for (int i = 0; i < 2; i++) {
        fw_side *side = &plan->side[i];
        double q0 = side->ring_in_m, q1 = side->ring_out_m;
        double most = fmin(angle_of(near_point(&plan->shape[i], q0)) - 20e-6 / q0,
                           side->own_rad - asin(side->neck_m / q1) - 15e-6 / q1);
        if (!(gap > 0.0) || side->ring_end_rad > most) side->ring_end_rad = most;
    }
    return -in->ring_end_rad - out->ring_end_rad;
}

static fw_status refuse(fw_drawing *d, int joint, int number, const char *what) {
    const fw_joint *j = &d->device->joint[joint];
    const fw_flexure *f = &d->device->flexure[j->flexure];
    char length[32], width[32], angle[32];
    bool turns = isfinite(f->angle_rad); /* not a leaf */
    fw_diag_error(d->diags, number, f->place, "hinge %s (length %s um, width %s um%s%s%s): %s",
                  j->id, fw_layout_um(length, f->length_m), fw_layout_um(width, f->width_m),
                  turns ? ", angle " : "",
                  turns ? fw_number_text(angle, sizeof angle, f->angle_rad * 180.0 / FW_PI, 5) : "",
                  turns ? " deg" : "", what);
    return FW_GEOMETRY;
}

/* a fillet of the file that does not fit is drawn as large as it fits; once per flexure */
static void say_smaller_fillet(fw_drawing *d, int joint, double drawn_m) {
    const fw_joint *j = &d->device->joint[joint];
    const fw_flexure *f = &d->device->flexure[j->flexure];
    char wanted[32], used[32];
    if (isnan(f->fillet_m) || !(drawn_m < 0.99 * f->fillet_m)) return;
    for (int i = 0; i < joint; i++)
        if (d->device->joint[i].flexure == j->flexure) return;
    fw_diag_warning(
        d->diags, 129, f->place,
        "flexure %s: fillet is %s um in the file, but the root has room for %s um only, "
        "which is drawn and used for stiffness and strain; write %s um or less, or make "
        "the flexure longer",
        f->id ? f->id : "", fw_layout_um(wanted, f->fillet_m), fw_layout_um(used, drawn_m), used);
}

static fw_status plan_hinge(fw_drawing *d, int joint) {
    const fw_joint *j = &d->device->joint[joint];
    const fw_flexure *f = &d->device->flexure[j->flexure];
    fw_hinge_plan *plan = &d->hinge[joint];
    fw_hinge_layout *layout = &d->layout->hinge[joint];
    double axis = 0.0;
    bool drawn = false;
    double fillet = isnan(f->fillet_m) ? fw_flexure_default_fillet(f) : f->fillet_m;
    plan->shape[0].fillet_m = fillet;
    if (fw_flexure_varies(f))
        drawn = fw_hinge_shape_path(f, fillet, plan->shape);
    else {
        for (size_t i = 0; i < sizeof drawers / sizeof drawers[0]; i++)
            if (drawers[i].kind == f->kind) drawn = drawers[i].shape(f, &plan->shape[0]);
        plan->shape[1] = plan->shape[0];
    }
    if (!drawn)
        return refuse(d, joint, 121,
                      "no room for two root blocks 8 um apart and their fillets; lengthen the "
                      "flexure, or make it thinner or its angle smaller");
    say_smaller_fillet(d, joint, plan->shape[0].fillet_m);
    choose_sides(d, joint, plan, &axis);
    choose_rings(plan, f->gap_m);
    double facing = choose_ring_ends(plan, f->gap_m);
    if (f->gap_m > 0.0 && facing < 0.35)
        return refuse(
            d, joint, 122,
            "the conjugate surfaces would face each other over less than 20 degrees; turn "
            "the bulge away from the links, or set gap=\"0 um\" to leave them out");
    for (int i = 0; i < 2; i++) {
        fw_status status = draw_head(d->arena, &plan->shape[i], &plan->side[i]);
        if (status == FW_GEOMETRY)
            return refuse(d, joint, 122,
                          "the root block, the ring and the neck of one body do not join to one "
                          "outline; lengthen the flexure, or make it or the link thinner");
        FW_TRY(status);
    }
    FW_TRY(fw_flexure_draw(d->arena, f, plan));
    if (fw_flexure_varies(f) && fw_path_in_the_way(f, plan))
        return refuse(d, joint, 264,
                      "the root blocks and rings that belong to its two ends would cross, or come "
                      "within 7 um of the strip; let the ends point away from the bulge, or open "
                      "the path");

    const fw_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    layout->drawn = true;
    layout->centre = fw_joint_point(d->device, joint);
    layout->arc_centre = fw_local_point(&plan->side[1].local, plan->shape[1].arc_centre);
    layout->axis_rad = axis;
    layout->lower = plan->side[0].body;
    layout->upper = plan->side[1].body;
    layout->convex = in->body;
    layout->fillet_m = plan->shape[0].fillet_m;
    layout->surface_radius_m = f->gap_m > 0.0 ? in->ring_out_m : 0.0;
    layout->gap_m = f->gap_m;
    layout->facing_rad = f->gap_m > 0.0 ? facing : 0.0;
    layout->facing_from_rad = plan->side[1].ring_end_rad;
    layout->keep_out_m = out->ring_out_m + FW_BESIDE_RING_M;
    return FW_OK;
}

/* the rings and where they end stay: only neck and block differ */
fw_status fw_head_draw(fw_drawing *d, int joint, int body, int choice) {
    fw_hinge_plan *plan = &d->hinge[joint];
    fw_side *side = &plan->side[plan->side[1].body == body];
    side->choice = choice;
    choose_neck(side, d->layout->hinge[joint].keep_out_m);
    return draw_head(d->arena, &plan->shape[side == &plan->side[1]], side);
}

fw_status fw_hinges_plan(fw_drawing *d) {
    const fw_device *device = d->device;
    bool bad = false;
    FW_NEED(d->hinge = fw_arena_array(d->arena, fw_hinge_plan, (size_t)device->njoint));
    for (int i = 0; i < device->njoint; i++) { /* all refusals in one run */
        fw_status status = plan_hinge(d, i);
        if (status == FW_GEOMETRY)
            bad = true;
        else if (status != FW_OK)
            return status;
    }
    if (bad) return FW_GEOMETRY;
    for (int i = 0; i < device->njoint; i++)
        for (int k = i + 1; k < device->njoint; k++) {
            const fw_hinge_layout *p = &d->layout->hinge[i], *q = &d->layout->hinge[k];
            double apart = fw_norm(fw_sub(p->centre, q->centre)),
                   least = p->keep_out_m + q->keep_out_m;
            char a[32], b[32];
            if (apart >= least) continue;
            fw_diag_error(d->diags, 125, device->joint[k].place,
                          "hinges %s and %s are %s um apart, but their surfaces and clearance need "
                          "%s um; move them apart, or make the flexures shorter",
                          device->joint[i].id, device->joint[k].id, fw_layout_um(a, apart),
                          fw_layout_um(b, least));
            bad = true;
        }
    return bad ? FW_GEOMETRY : FW_OK;
}
