/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flexure of a hinge and its two roots: circular arcs, straight leaves, and any path or varying
   width; the strip between the two cuts. docs/theory/layout.md, section 2. */
#include "flexure/path.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>
#include <string.h>

/* elastic centre from O, by the same function as the mechanics use */
static double hinge_centre(const fw_device_flexure *flexure, double fillet_m) {
    /* of a uniform modulus: one drawing serves every flow; what a crystal moves is the mechanism's
       business (fw_flexure_result.offset_m) */
    const fw_flexure_input in = fw_flexure_input_of(flexure, fillet_m);
    fw_flexure_shape shape;
    fw_flexure_shape_of(&in, &shape);
    return shape.centre_m;
}

/* circular arc, half-angle a, centre-line radius r, width t, from O; W at (centre_m, 0):
     outer fillet centre at r + t/2 + rho, offset asin(rho/(r + t/2 + rho)) from the root face,
     inner one at r - t/2 - rho, offset g = asin(rho/(r - t/2 - rho)), the larger:
       the cut is at a - g
     inner corner of the root block: 40 um or 4 t inside the centre line, at most r/2, but the two
       blocks keep the least space, and the face keeps 1 um flat:
       rho <= (ri^2 - (corner + 1 um)^2)/(2 ri)
   in: flexure (m, rad), shape->fillet_m wanted; out: shape in the hinge frame; false: no room
   docs/theory/layout.md, section 2; test_layout.c hinge_is_exact */
bool fw_layout_hinge_shape_csfh(const fw_device_flexure *flexure, fw_layout_hinge_shape *shape) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double flat = rule->root_flat_m;
    double r = flexure->radius_m, t = flexure->width_m, a = 0.5 * flexure->angle_rad;
    double ri = r - 0.5 * t, ro = r + 0.5 * t, sa = sin(a), ca = cos(a);
    if (!(ri > 0.0 && sa > 0.0)) return false;

    double least = (rule->half_space_share * rule->least_space_m + flat * fmax(0.0, -ca)) / sa;
    double depth = fmax(rule->block_depth_m, rule->block_depth_widths * t);
    double corner = fmax(fmax(r - depth, rule->block_depth_radii * r), least);
    double room = ri * ri - (least + flat) * (least + flat);
    if (!(room > 0.0)) return false;
    double rho = fmin(shape->fillet_m, fmin(room / (2.0 * ri), rule->fillet_radii * ri));
    if (!(rho > rule->fillet_least_widths * t)) return false;
    double face_end = sqrt(ri * ri - 2.0 * ri * rho);
    if (corner > face_end - flat) corner = face_end - flat;

    double inner = asin(rho / (ri - rho)), outer = asin(rho / (ro + rho)), cut = a - inner;
    if (!(cut > rule->cut_least_rad)) return false;
    double far_end = sqrt((ro + rho) * (ro + rho) - rho * rho);
    fw_geometry_vec2 o = fw_v(-hinge_centre(flexure, rho), 0.0), e = fw_v(ca, sa);

    shape->arc_centre = o;
    shape->strip_sweep_rad = 2.0 * cut;
    shape->fillet_m = rho;
    shape->cut_flags = FW_SEGMENT_JOINT;
    shape->width_m = t;
    shape->size_m = r;
    shape->joint_in = fw_add(o, ri, fw_polar(cut));
    shape->joint_out = fw_add(o, ro, fw_polar(cut));
    shape->edge_centre = o;
    shape->edge_sweep_rad = inner - outer;
    shape->inner_end = shape->joint_in;
    shape->outer_start = fw_add(o, ro, fw_polar(a - outer));
    shape->outer_centre = fw_add(o, ro + rho, fw_polar(a - outer));
    shape->outer_end = fw_add(o, far_end, e);
    shape->outer_sweep_rad = -(0.5 * FW_PI - outer);
    shape->inner_start = fw_add(o, face_end, e);
    shape->inner_centre = fw_add(o, ri - rho, fw_polar(cut));
    shape->inner_sweep_rad = -(0.5 * FW_PI + inner);
    shape->root = fw_add(o, r, e);
    shape->face = e;
    shape->into = fw_left(e);
    shape->inner_corner = fw_add(o, corner, e);
    shape->reach_m = fmax(fw_norm(shape->outer_end), fabs(o.x + ro));
    return true;
}

/* straight leaf along y of the hinge frame, W in its middle: root faces at y = +-L/2, fillets of
   radius rho tangent to both, cut at L/2 - rho
   in: flexure (m), shape->fillet_m wanted; out: shape in the hinge frame; false: no room
   docs/theory/layout.md, section 2; test_layout.c leaf_is_exact */
bool fw_layout_hinge_shape_leaf(const fw_device_flexure *flexure, fw_layout_hinge_shape *shape) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double L = flexure->length_m, t = flexure->width_m, y = 0.5 * L, x = 0.5 * t;
    double rho = fmin(shape->fillet_m, rule->fillet_lengths * L), cut = y - rho;
    if (!(L > rule->leaf_spaces * rule->least_space_m && t > 0.0)) return false;
    if (!(rho > rule->fillet_least_widths * t)) return false;

    shape->arc_centre = fw_v(0.0, 0.0);
    shape->strip_sweep_rad = 0.0;
    shape->fillet_m = rho;
    shape->cut_flags = FW_SEGMENT_JOINT;
    shape->width_m = t;
    shape->size_m = y;
    shape->joint_in = fw_v(-x, cut);
    shape->joint_out = fw_v(x, cut);
    shape->edge_sweep_rad = 0.0;
    shape->inner_end = shape->joint_in;
    shape->outer_start = shape->joint_out;
    shape->outer_centre = fw_v(x + rho, cut);
    shape->outer_end = fw_v(x + rho, y);
    shape->outer_sweep_rad = -0.5 * FW_PI;
    shape->inner_start = fw_v(-x - rho, y);
    shape->inner_centre = fw_v(-x - rho, cut);
    shape->inner_sweep_rad = -0.5 * FW_PI;
    shape->root = fw_v(0.0, y);
    shape->face = fw_v(1.0, 0.0);
    shape->into = fw_v(0.0, 1.0);
    shape->inner_corner =
        fw_v(-fmax(rule->block_depth_m, x + rho + rule->block_depth_widths * t), y);
    shape->reach_m = fw_norm(shape->outer_end);
    return true;
}

/* ---- any path ---- */

enum { PLACES = 48 };

/* the strip in the hinge frame, W at the origin */
static void lay(const fw_device_flexure *f, double fillet_m, fw_flexure_course *p) {
    const fw_flexure_input in = fw_flexure_input_of(f, fillet_m);
    double centre = hinge_centre(f, fillet_m);
    fw_flexure_path_of(&in, p);
    for (int i = 0; i <= p->n; i++)
        p->start[i].x_m -= centre;
}

/* the same as the lower body sees it: mirrored about x, so walked from the other end */
static void turned(const fw_flexure_course *p, fw_flexure_course *out) {
    fw_geometry_strip_piece piece[FW_STRIP_MOST], back[FW_STRIP_MOST];
    for (int i = 0; i < p->n; i++)
        piece[i] = p->shape[i].piece;
    fw_geometry_strip_turned(piece, p->n, back);
    fw_geometry_pose start = p->start[p->n], at = {start.x_m, -start.y_m, FW_PI - start.angle_rad};
    at.angle_rad = fw_geometry_angle_near(-start.angle_rad + FW_PI, 0.5 * FW_PI);
    out->n = p->n;
    for (int i = 0; i < p->n; i++) {
        fw_geometry_strip_shape_of(&back[i], &out->shape[i]);
        out->start[i] = at;
        at = fw_geometry_strip_along(at, back[i].curvature_per_m, back[i].length_m);
    }
    out->start[p->n] = at;
}

/* ---- one fillet ---- */

typedef struct corner { /* root: middle, into the block, to the side of the fillet */
    fw_geometry_vec2 root, into, side;
    double half_m;
} corner;

typedef struct fillet {
    fw_geometry_vec2 centre, on_edge, on_face;
    double face_m; /* on_face from the middle of the root */
    double back_m; /* on_edge from the root, along the centre line */
} fillet;

/* In the corner's coordinates, x into the block and y to its side, the edge passes (0, t/2):
     line of slope m:   yc = t/2 - m rho + rho sqrt(1 + m^2)
     circle (X, Y), R:  (X + rho)^2 + (yc - Y)^2 = (R -+ rho)^2, - where its centre lies outside of
                        the strip
   The fillet's centre is at (-rho, yc), its end on the face at (0, yc). In, out: m. Exact.
   false: no such circle. Test: test_layout_path.c */
static bool fit(const corner *c, const fw_geometry_segment *e, double rho, fillet *out) {
    double yc, t = c->half_m;
    fw_geometry_vec2 at;
    if (e->kind == FW_LINE) {
        fw_geometry_vec2 d = vec_sub(e->b, e->a);
        double m = vec_dot(d, c->side) / vec_dot(d, c->into), root = sqrt(1 + m * m);
        yc = t - m * rho + rho * root;
        at = (fw_geometry_vec2){-rho + rho * m / root, yc - rho / root};
    } else {
        fw_geometry_vec2 to = vec_sub(e->centre, c->root);
        double X = vec_dot(to, c->into), Y = vec_dot(to, c->side), R = e->radius;
        bool hollow = Y > t;
        double far = hollow ? R - rho : R + rho, in = far * far - (X + rho) * (X + rho);
        if (!(far > 0 && in >= 0)) return false;
        yc = hollow ? Y - sqrt(in) : Y + sqrt(in);
        fw_geometry_vec2 ray = {-rho - X, yc - Y};
        at = vec_along((fw_geometry_vec2){X, Y}, R / vec_length(ray), ray);
    }
    out->face_m = yc;
    out->centre = vec_along(vec_along(c->root, -rho, c->into), yc, c->side);
    out->on_face = vec_along(c->root, yc, c->side);
    out->on_edge = vec_along(vec_along(c->root, at.x, c->into), at.y, c->side);
    return yc > t;
}

/* how far behind the root, along the last piece's centre line, a point is across from */
static double back_of(const fw_flexure_course *p, fw_geometry_vec2 at) {
    const fw_geometry_strip_piece *q = &p->shape[p->n - 1].piece;
    fw_geometry_pose end = p->start[p->n];
    fw_geometry_vec2 into = {cos(end.angle_rad), sin(end.angle_rad)}, left = vec_left(into);
    fw_geometry_vec2 from = vec_sub(at, (fw_geometry_vec2){end.x_m, end.y_m});
    double k = q->curvature_per_m, x = vec_dot(from, into), y = vec_dot(from, left);
    return k == 0 ? -x : atan2(-x * k, 1 - y * k) / k;
}

/* ---- one root ---- */

static double sweep_between(fw_geometry_vec2 centre, fw_geometry_vec2 from, fw_geometry_vec2 to) {
    return fw_geometry_vec_angle(vec_sub(from, centre), vec_sub(to, centre));
}

/* where the cut, square to the centre line, meets an edge */
static fw_geometry_vec2 across(const fw_flexure_course *p, double back_m, double sign) {
    const fw_geometry_strip_shape *f = &p->shape[p->n - 1];
    double s = f->piece.length_m - back_m;
    fw_geometry_pose at = fw_geometry_strip_along(p->start[p->n - 1], f->piece.curvature_per_m, s);
    double off = fw_geometry_strip_aside(f, s) + 0.5 * sign * fw_geometry_strip_width(f, s);
    return (fw_geometry_vec2){at.x_m - off * sin(at.angle_rad), at.y_m + off * cos(at.angle_rad)};
}

/* an edge between the cut and a fillet's end: about the edge's own centre, or straight */
static void edge_part(const fw_geometry_segment *edge, fw_geometry_vec2 from, fw_geometry_vec2 to,
                      fw_geometry_vec2 *centre, double *sweep) {
    *centre = edge->centre;
    *sweep = edge->kind == FW_LINE || vec_same(from, to) ? 0 : sweep_between(*centre, from, to);
}

/* how far the block may reach inside the centre line: 40 um or 4 t, half the radius, and no nearer
   to the other block than half the least space from the axis */
static double block_depth(const fw_geometry_strip_piece *last, fw_geometry_vec2 root,
                          fw_geometry_vec2 left, double rho) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double t = last->width_m[2], wide = rule->block_depth_widths * t;
    double half_space = rule->half_space_share * rule->least_space_m;
    double depth = fmax(rule->block_depth_m, wide);
    if (last->curvature_per_m == 0) depth = fmax(rule->block_depth_m, 0.5 * t + rho + wide);
    if (last->curvature_per_m > 0)
        depth = fmin(depth, rule->block_depth_radii / last->curvature_per_m);
    if (left.y < 0) depth = fmin(depth, (root.y - half_space) / -left.y);
    return depth;
}

static bool root_shape(const fw_flexure_course *p, double rho, fw_layout_hinge_shape *s) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_geometry_strip_shape *last = &p->shape[p->n - 1];
    fw_geometry_pose end = p->start[p->n];
    fw_geometry_vec2 into = {cos(end.angle_rad), sin(end.angle_rad)}, left = vec_left(into);
    fw_geometry_vec2 root = {end.x_m, end.y_m}, right = vec_scale(-1, left);
    double t = last->piece.width_m[2];
    fillet in, out;
    const fw_geometry_segment edge[2] = {fw_geometry_strip_edge(last, p->start[p->n - 1], 0),
                                         fw_geometry_strip_edge(last, p->start[p->n - 1], 1)};
    if (!fit(&(corner){root, into, left, 0.5 * t}, &edge[0], rho, &in)) return false;
    if (!fit(&(corner){root, into, right, 0.5 * t}, &edge[1], rho, &out)) return false;
    in.back_m = back_of(p, in.on_edge), out.back_m = back_of(p, out.on_edge);
    double depth = block_depth(&last->piece, root, left, rho);
    /* on the edges themselves, which run through it: the bias then moves both pieces alike */
    double cut = fmax(in.back_m, out.back_m) + rule->beyond_fillet_m;
    if (!(in.face_m < depth - rule->root_flat_m && in.back_m > 0 && out.back_m > 0)) return false;
    double share = p->n == 1 ? rule->cut_share_only : rule->cut_share_last;
    if (!(cut < share * last->piece.length_m)) return false;

    *s = (fw_layout_hinge_shape){.fillet_m = rho, .width_m = t, .strip_sweep_rad = 0};
    s->cut_flags = FW_SEGMENT_JOINT | FW_SEGMENT_THROUGH;
    s->joint_in = across(p, cut, 1), s->joint_out = across(p, cut, -1);
    s->outer_start = out.on_edge, s->outer_centre = out.centre, s->outer_end = out.on_face;
    s->inner_start = in.on_face, s->inner_centre = in.centre, s->inner_end = in.on_edge;
    edge_part(&edge[1], s->joint_out, s->outer_start, &s->edge_centre, &s->edge_sweep_rad);
    edge_part(&edge[0], s->inner_end, s->joint_in, &s->inner_edge_centre, &s->inner_edge_sweep_rad);
    s->outer_sweep_rad = sweep_between(out.centre, out.on_edge, out.on_face);
    s->inner_sweep_rad = sweep_between(in.centre, in.on_face, in.on_edge);
    s->root = root, s->face = right, s->into = into;
    s->inner_corner = vec_along(root, depth, left);
    s->cut_m = cut;
    return s->outer_sweep_rad < 0 && s->inner_sweep_rad < 0;
}

/* farthest of both edges from W at the origin, exact */
static double farthest(const fw_flexure_course *p) {
    double far = 0, t;
    for (int i = 0; i < p->n; i++)
        for (int side = 0; side < 2; side++) {
            const fw_geometry_segment e = fw_geometry_strip_edge(&p->shape[i], p->start[i], side);
            far = fmax(far, fmax(vec_length(e.a), vec_length(e.b)));
            if (e.kind == FW_ARC && fw_geometry_segment_faces(&e, e.centre, &t))
                far = fmax(far, vec_length(e.centre) + e.radius);
        }
    return far;
}

/* what rings are proportioned by: radius of an arc, half of a line; of a path that of the arc as
   long that turns as much */
static double size_of(const fw_device_flexure *f, const fw_flexure_course *p, double reach) {
    double turn = fabs(p->start[p->n].angle_rad - p->start[0].angle_rad);
    if (f->kind == FW_FLEXURE_CSFH) return f->radius_m;
    if (f->kind == FW_FLEXURE_LEAF) return 0.5 * f->length_m;
    return fmin(reach, turn > 1 ? f->length_m / turn : 0.5 * f->length_m);
}

bool fw_layout_hinge_shape_path(const fw_device_flexure *f, double fillet_m,
                                fw_layout_hinge_shape shape[2]) {
    fw_flexure_course up, low;
    const fw_layout_rules *rule = &fw_layout_rule;
    double rho = fillet_m, least = rule->fillet_least_widths * fw_device_flexure_narrowest_m(f);
    for (; rho > least; rho *= rule->fillet_step) { /* both roots alike; W moves with the fillet */
        lay(f, rho, &up);
        turned(&up, &low);
        double nearest = fmin(up.start[up.n].y_m, low.start[low.n].y_m);
        if (nearest < rule->least_space_m) return false;
        if (root_shape(&up, rho, &shape[1]) && root_shape(&low, rho, &shape[0])) break;
    }
    if (!(rho > least)) return false;
    double reach =
        fmax(farthest(&up), fmax(vec_length(shape[0].outer_end), vec_length(shape[1].outer_end)));
    double size = size_of(f, &up, reach);
    for (int i = 0; i < 2; i++) {
        shape[i].reach_m = reach;
        shape[i].size_m = size;
        shape[i].arc_centre = fw_v(-hinge_centre(f, rho), 0);
    }
    return true;
}

/* ---- the strip ---- */

static void add_edge(fw_layout_sketch *k, const fw_geometry_segment *e, bool forward,
                     fw_geometry_vec2 from, fw_geometry_vec2 to) {
    if (e->kind == FW_LINE) {
        fw_layout_sketch_line(k, to, 0);
        return;
    }
    double way = forward ? e->sweep_rad : -e->sweep_rad;
    double sweep = sweep_between(e->centre, from, to);
    if (sweep * way < 0) sweep += copysign(2 * FW_PI, way);
    fw_layout_sketch_arc(k, e->centre, sweep, to);
}

static fw_geometry_vec2 mirrored(fw_geometry_vec2 p) {
    return fw_v(p.x, -p.y);
}

static fw_status draw_path(fw_arena *arena, const fw_device_flexure *f,
                           fw_layout_hinge_plan *plan) {
    const fw_layout_hinge_shape *low = &plan->shape[0], *up = &plan->shape[1];
    fw_flexure_course p;
    lay(f, up->fillet_m, &p);
    fw_geometry_vec2 at = mirrored(low->joint_out);
    fw_layout_sketch k = fw_layout_sketch_start(arena, &plan->side[1].local, at);
    for (int i = 0; i < p.n; i++) {
        const fw_geometry_segment e = fw_geometry_strip_edge(&p.shape[i], p.start[i], 1);
        fw_geometry_vec2 to = i == p.n - 1 ? up->joint_out : e.b;
        add_edge(&k, &e, true, at, to);
        at = to;
    }
    fw_layout_sketch_line(&k, up->joint_in, up->cut_flags);
    at = up->joint_in;
    for (int i = p.n - 1; i >= 0; i--) {
        const fw_geometry_segment e = fw_geometry_strip_edge(&p.shape[i], p.start[i], 0);
        fw_geometry_vec2 to = i == 0 ? mirrored(low->joint_in) : e.a;
        add_edge(&k, &e, false, at, to);
        at = to;
    }
    fw_layout_sketch_line(&k, mirrored(low->joint_out), low->cut_flags);
    return fw_layout_sketch_close(&k, &plan->flexure);
}

/* one arc or line between the two cuts */
fw_status fw_layout_flexure_draw(fw_arena *arena, const fw_device_flexure *f,
                                 fw_layout_hinge_plan *plan) {
    if (fw_device_flexure_varies(f)) return draw_path(arena, f, plan);
    const fw_layout_hinge_shape *s = &plan->shape[1];
    fw_geometry_vec2 low_in = mirrored(s->joint_in), low_out = mirrored(s->joint_out);
    fw_layout_local frame = plan->side[1].local;
    if (frame.mirror) /* its head is drawn from the other side of a leaf: the strip is not */
        frame = (fw_layout_local){frame.origin, -frame.c, -frame.s, false};
    fw_layout_sketch k = fw_layout_sketch_start(arena, &frame, low_out);
    if (s->strip_sweep_rad > 0.0)
        fw_layout_sketch_arc(&k, s->arc_centre, s->strip_sweep_rad, s->joint_out);
    else
        fw_layout_sketch_line(&k, s->joint_out, 0);
    fw_layout_sketch_line(&k, s->joint_in, FW_SEGMENT_JOINT);
    if (s->strip_sweep_rad > 0.0)
        fw_layout_sketch_arc(&k, s->arc_centre, -s->strip_sweep_rad, low_in);
    else
        fw_layout_sketch_line(&k, low_in, 0);
    fw_layout_sketch_line(&k, low_out, FW_SEGMENT_JOINT);
    return fw_layout_sketch_close(&k, &plan->flexure);
}

/* ---- what a path may run into ---- */

static bool crosses_itself(const fw_geometry_contour *c) {
    fw_geometry_hit hit[FW_MOST_HITS];
    for (int i = 0; i < c->count; i++)
        for (int j = i + 2; j < c->count; j++)
            if (!(i == 0 && j == c->count - 1) &&
                fw_geometry_segment_intersect(&c->segment[i], &c->segment[j], hit) > 0)
                return true;
    return false;
}

static double distance_to(const fw_geometry_contour *c, fw_geometry_vec2 from) {
    double least = HUGE_VAL, t;
    fw_geometry_vec2 at;
    for (int i = 0; i < c->count; i++)
        least = fmin(least, fw_geometry_segment_nearest(&c->segment[i], from, &t, &at));
    return least;
}

/* the strip beyond `clear` behind the root of `upper`: nearer than the least space of one outline
   to that body? on 49 places of each edge and piece */
static bool near_head(const fw_flexure_course *p, const fw_layout_hinge_plan *plan, int upper) {
    const fw_layout_side *side = &plan->side[upper];
    const fw_layout_rules *rule = &fw_layout_rule;
    double whole = 0, before = 0;
    double clear = plan->shape[upper].cut_m + rule->path_clear_spaces * rule->least_space_m;
    for (int i = 0; i < p->n; i++)
        whole += p->shape[i].piece.length_m;
    for (int i = 0; i < p->n; before += p->shape[i++].piece.length_m)
        for (int k = 0; k <= PLACES; k++) {
            double s = p->shape[i].piece.length_m * k / PLACES;
            if ((upper ? whole - before - s : before + s) < clear) continue;
            for (int sign = -1; sign <= 1; sign += 2) {
                fw_geometry_vec2 q = fw_flexure_path_edge(p, i, (double)k / PLACES, sign);
                q = fw_layout_local_point(&plan->side[1].local, q);
                if (distance_to(&side->head, q) < rule->own_space_m ||
                    fw_geometry_contour_contains(&side->head, q))
                    return true;
            }
        }
    return false;
}

bool fw_layout_path_in_the_way(const fw_device_flexure *f, const fw_layout_hinge_plan *plan) {
    fw_flexure_course p;
    lay(f, plan->shape[1].fillet_m, &p);
    for (int i = 0; i < 2; i++)
        if (near_head(&p, plan, i) ||
            (f->kind == FW_FLEXURE_PATH && crosses_itself(&plan->side[i].head)))
            return true;
    return false;
}

/* the fillets of a flexure, which the file states of it: once, at whatever bodies and hinges it ends */
fw_status fw_layout_say_fillet(fw_layout_drawing *d, int joint, const char *label,
                               fw_geometry_vec2 at, double least_m) {
    const fw_layout_hinge_layout *h = &d->layout->hinge[joint];
    char x[32], y[32], value[32], limit[32];
    const char *id = d->device->flexure[d->device->revolute[joint].flexure].id;
    const char *what =
        fw_arena_printf(d->arena, "the fillets at the ends of %s%s have", FW_NAMED("flexure", id));
    FW_NEED(what);
    for (size_t i = 0; i < d->diags->count; i++)
        if (strncmp(d->diags->item[i].message, what, strlen(what)) == 0) return FW_OK;
    fw_diag_warning(d->diags, 138, h->place,
                    "%s a radius of only %s um, as at %s by %s%s, at (%s, %s) um; the layout's own "
                    "rule is %s um, so that every mask "
                    "shows it: state a fillet of %s um or more, or see whether the rules of the "
                    "mask accept it",
                    what, fw_layout_um(value, h->fillet_m), label,
                    FW_NAMED("hinge", d->device->revolute[joint].id), fw_layout_um(x, at.x),
                    fw_layout_um(y, at.y), fw_layout_um(limit, least_m), limit);
    return FW_OK;
}
