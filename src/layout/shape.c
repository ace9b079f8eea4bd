/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a description draws of a body (fw_device_shape): its union in the world, what is cut out of
   it, and in which direction the neck of a hinge finds it. docs/theory/layout.md, section 11. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

static const double FARTHEST_M = 600e-6; /* of a neck, from its hinge's free circle */
static const double STEP_M = 10e-6;      /* of the search along it */
static const double SAME_STEP_M = 20e-6; /* necks that differ by less are equally long */
static const double ON_EDGE_M = 1e-9;    /* a hinge that is nearer to it */
static const double BESIDE_M = 2e-6;     /* of the neck's edges that lie inside, too */
enum { DIRECTIONS = 64 };

bool fw_layout_has_shapes(const fw_device *device, int body) {
    return body >= 0 && device->body[body].nshape > 0;
}

/* only shapes: neither bars nor a plate of the body's own */
bool fw_layout_only_shapes(const fw_device *device, int body) {
    return fw_layout_has_shapes(device, body) && isnan(device->body[body].width_m) &&
           isnan(device->body[body].plate_width_m);
}

/* ---- union ---- */

static fw_status to_world(fw_layout_drawing *d, int body, const fw_geometry_contour *own,
                          fw_geometry_contour *out) {
    const fw_device_body *b = &d->device->body[body];
    FW_TRY(fw_geometry_contour_transform(
        d->arena, own, (fw_geometry_pose){b->x_m, b->y_m, b->phi_rad}, false, out));
    for (int i = 0; i < out->count; i++)
        out->segment[i].flags |= FW_SEGMENT_DRAWN;
    return FW_OK;
}

fw_status fw_layout_shape_refuse(fw_layout_drawing *d, int number, fw_place place, int body,
                                 const char *what, fw_geometry_vec2 at) {
    char x[32], y[32];
    const char *label = fw_layout_body_label(d, body);
    FW_NEED(label);
    fw_diag_error(d->diags, number, place, "%s: %s, near (%s, %s) um", label, what,
                  fw_layout_um(x, at.x), fw_layout_um(y, at.y));
    fw_layout_fault fault = fw_layout_fault_at(at);
    fault.body[fault.nbody++] = body;
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

static fw_status unite(fw_layout_drawing *d, int body, const fw_device_shape *shape,
                       const fw_geometry_contour *with, fw_geometry_region *all) {
    fw_geometry_region one = {(fw_geometry_contour *)with, 1}, both;
    if (all->count == 0) {
        FW_NEED(all->contour = fw_arena_array(d->arena, fw_geometry_contour, 1));
        all->contour[all->count++] = *with;
        return FW_OK;
    }
    fw_status status = fw_geometry_region_boolean(d->arena, all, &one, FW_UNION, &both);
    if (status == FW_GEOMETRY)
        return fw_layout_shape_refuse(
            d, 318, shape->place, body,
            "an edge of this shape nearly coincides with one drawn before, so that they cannot be "
            "united; move it by some nanometres",
            with->segment[0].a);
    if (status == FW_OK) *all = both;
    return status;
}

/* the letters as outlines that are cut out */
static fw_status unite_lettering(fw_layout_drawing *d, int body, const fw_device_shape *shape,
                                 fw_geometry_region *holes) {
    fw_layout_piece *piece = NULL;
    int n = 0, capacity = 0;
    const fw_device_body *b = &d->device->body[body];
    const char *lacking = fw_layout_text_lacks(shape->text), *behind = lacking;
    if (lacking) {
        unsigned code = fw_text_character(&behind);
        const char *why = fw_arena_printf(
            d->arena,
            "the lettering holds '%.*s' (U+%04X), which the font does not have; write it "
            "with ASCII, the letters of Latin-1, a Greek mu or Omega",
            (int)(behind - lacking), lacking, code);
        FW_NEED(why);
        return fw_layout_shape_refuse(d, 390, shape->place, body, why, fw_v(b->x_m, b->y_m));
    }
    FW_TRY(fw_layout_text(d->arena, shape->text, (fw_geometry_vec2){0, 0}, shape->height_m,
                          shape->height_m / 9, FW_ROLE_TEXT, "", &piece, &n, &capacity));
    if (n == 0)
        return fw_layout_shape_refuse(d, 316, shape->place, body, "the lettering has no letters",
                                      fw_v(b->x_m, b->y_m));
    for (int i = 0; i < n; i++) {
        fw_geometry_contour placed, world;
        FW_TRY(fw_geometry_contour_transform(d->arena, &piece[i].contour, shape->pose, false,
                                             &placed));
        FW_TRY(to_world(d, body, &placed, &world));
        FW_TRY(unite(d, body, shape, &world, holes));
    }
    return FW_OK;
}

/* the place of the shape whose edge is at a point, for messages about a hole; else of lettering */
static fw_place hole_place(fw_layout_drawing *d, int body, fw_geometry_vec2 at) {
    const fw_device_body *b = &d->device->body[body];
    fw_place place = b->place;
    double least = HUGE_VAL;
    for (int i = 0; i < b->nshape; i++) {
        const fw_device_shape *shape = &b->shape[i];
        fw_geometry_contour world = {0};
        double far = 1e-7, t; /* of letters, whose outlines are made elsewhere */
        fw_geometry_vec2 on;
        if (!shape->hole) continue;
        if (!shape->text && to_world(d, body, &shape->contour, &world) == FW_OK) far = HUGE_VAL;
        for (int k = 0; k < world.count; k++)
            far = fmin(far, fw_geometry_segment_nearest(&world.segment[k], at, &t, &on));
        if (far < least) least = far, place = shape->place;
    }
    return place;
}

/* what rounding makes smaller than stated is refused */
static bool is_round(const fw_geometry_contour *before, const fw_geometry_contour *after,
                     double radius_m, fw_geometry_vec2 *where) {
    for (int i = 0; i < after->count; i++) {
        const fw_geometry_segment *s = &after->segment[i];
        bool there = s->kind != FW_ARC || s->sweep_rad > 0 || s->radius >= radius_m * (1 - 1e-9);
        for (int k = 0; k < before->count && !there; k++)
            there = before->segment[k].kind == FW_ARC &&
                    fw_norm(fw_sub(before->segment[k].centre, s->centre)) < FW_COINCIDENT_M;
        *where = s->a;
        if (!there) return false;
    }
    return true;
}

/* inward corners of the union, by the body's inner-corner */
static fw_status round_inward(fw_layout_drawing *d, int body, fw_geometry_region *all) {
    const fw_device_body *b = &d->device->body[body];
    for (int i = 0; i < all->count && b->inner_corner_m > 0; i++) {
        fw_geometry_contour *c = &all->contour[i], round;
        fw_geometry_vec2 where = c->segment[0].a;
        for (int k = 0; k < c->count; k++)
            c->segment[k].flags &= ~(unsigned)FW_SEGMENT_DRAWN;
        fw_status status =
            fw_geometry_contour_round(d->arena, c, 0.0, b->inner_corner_m, &round, &where);
        if (status == FW_GEOMETRY ||
            (status == FW_OK && !is_round(c, &round, b->inner_corner_m, &where)))
            return fw_layout_shape_refuse(
                d, 308, b->inner_corner_place, body,
                "there is no room for this radius at an inward corner; make it smaller", where);
        FW_TRY(status);
        *c = round;
        for (int k = 0; k < c->count; k++)
            c->segment[k].flags |= FW_SEGMENT_DRAWN;
    }
    return FW_OK;
}

static fw_status gather(fw_layout_drawing *d, int body, fw_layout_shapes *s) {
    const fw_device_body *b = &d->device->body[body];
    for (int i = 0; i < b->nshape; i++) {
        const fw_device_shape *shape = &b->shape[i];
        fw_geometry_contour world;
        if (shape->text) {
            FW_TRY(unite_lettering(d, body, shape, &s->hole));
            continue;
        }
        FW_TRY(to_world(d, body, &shape->contour, &world));
        FW_TRY(unite(d, body, shape, &world, shape->hole ? &s->hole : &s->solid));
    }
    FW_TRY(round_inward(d, body, &s->solid));
    for (int i = 0; i < s->hole.count; i++)
        if (fw_geometry_contour_area(&s->hole.contour[i]) < 0)
            return fw_layout_shape_refuse(
                d, 316, hole_place(d, body, s->hole.contour[i].segment[0].a), body,
                "its holes together surround a part that would fall out",
                s->hole.contour[i].segment[0].a);
    return FW_OK;
}

/* Where edges of plate and shapes nearly coincide the body's own union says so; then necks find the
   shapes alone. */
static fw_status with_plate(fw_layout_drawing *d, int body, fw_layout_shapes *s) {
    fw_geometry_contour plate;
    fw_geometry_region own = {&plate, 1}, both;
    s->all = s->solid;
    if (isnan(d->device->body[body].plate_width_m) || s->solid.count == 0) return FW_OK;
    FW_TRY(fw_layout_plate_outline(d, body, &plate));
    fw_status status = fw_geometry_region_boolean(d->arena, &s->solid, &own, FW_UNION, &both);
    if (status == FW_OK) s->all = both;
    return status == FW_GEOMETRY ? FW_OK : status;
}

fw_status fw_layout_shapes_unite(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    fw_status status = FW_OK;
    bool any = false;
    for (int b = 0; b < device->nbody; b++)
        any = any || fw_layout_has_shapes(device, b);
    if (!any) return FW_OK;
    FW_NEED(d->shapes = fw_arena_array(d->arena, fw_layout_shapes, (size_t)device->nbody));
    for (int b = 0; b < device->nbody; b++) { /* all refusals in one run */
        fw_status one = gather(d, b, &d->shapes[b]);
        if (one == FW_OK) one = with_plate(d, b, &d->shapes[b]);
        if (one != FW_OK && one != FW_GEOMETRY) return one;
        if (one == FW_GEOMETRY) status = one;
    }
    return status;
}

/* ---- what is cut out ---- */

static bool is_clear_of_hinges(const fw_layout_drawing *d, int body, const fw_geometry_contour *c,
                               fw_geometry_vec2 *at) {
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        const fw_layout_hinge_plan *plan = &d->hinge[j];
        for (int i = 0; i < c->count; i++) {
            double t;
            if (fw_geometry_segment_nearest(&c->segment[i], h->centre, &t, at) < h->keep_out_m)
                return false;
        }
        for (int k = 0; k < 2; k++) {
            const fw_geometry_contour *head = &plan->side[k].head;
            if (plan->side[k].body != body) continue;
            if (fw_geometry_contour_distance_below(head, c, 1e-9, NULL, at) < 1e-9 ||
                fw_geometry_contour_contains(head, c->segment[0].a)) {
                *at = c->segment[0].a;
                return false;
            }
        }
    }
    return true;
}

/* a hole inside all that is drawn, clear of its edges; else *at: where not, and *why */
static bool hole_fits(const fw_layout_drawing *d, int body, const fw_geometry_region *all,
                      const fw_geometry_contour *hole, fw_geometry_vec2 *at, const char **why) {
    const double rim = fw_layout_rule.own_width_m - 0.4e-6; /* 4 um, as the rules of every mask */
    int around = 0;
    *at = hole->segment[0].a;
    for (int i = 0; i < all->count; i++) {
        const fw_geometry_contour *c = &all->contour[i];
        fw_geometry_vec2 near;
        bool in = fw_geometry_contour_contains(c, hole->segment[0].a);
        around += in ? (fw_geometry_contour_area(c) > 0 ? 1 : -1) : 0;
        if (fw_geometry_contour_distance_below(c, hole, rim, NULL, &near) >= rim) continue;
        *at = near;
        *why = "a hole meets the edge of what is drawn, or comes nearer to it than 4 um";
        return false;
    }
    *why = "a hole lies outside of what is drawn: move it into the body, or leave hole=\"yes\" out";
    if (around != 1) return false;
    *why = "a hole reaches into what belongs to a hinge";
    return is_clear_of_hinges(d, body, hole, at);
}

static fw_status check_hole(fw_layout_drawing *d, int body, const fw_geometry_region *all,
                            const fw_geometry_contour *hole) {
    fw_geometry_vec2 at;
    const char *why;
    if (hole_fits(d, body, all, hole, &at, &why)) return FW_OK;
    return fw_layout_shape_refuse(d, 316, hole_place(d, body, hole->segment[0].a), body, why, at);
}

fw_status fw_layout_shapes_pierce(fw_layout_drawing *d, int body, fw_geometry_region *all) {
    fw_geometry_region *hole = &d->shapes[body].hole, left;
    for (int i = 0; i < hole->count; i++)
        FW_TRY(check_hole(d, body, all, &hole->contour[i]));
    if (hole->count == 0) return FW_OK;
    FW_TRY(fw_geometry_region_boolean(d->arena, all, hole, FW_DIFFERENCE, &left));
    *all = left;
    return FW_OK;
}

/* ---- the way of a neck ---- */

static bool holds(const fw_geometry_region *r, fw_geometry_vec2 p) {
    int winding = 0;
    for (int i = 0; i < r->count; i++)
        winding += fw_geometry_contour_winding(&r->contour[i], p);
    return winding > 0;
}

static bool is_solid(const fw_layout_shapes *s, fw_geometry_vec2 p) {
    return holds(&s->all, p) && !holds(&s->hole, p);
}

/* the neck across `length` from `from` on lies in what is drawn, with all of its width */
static bool lies_in(const fw_layout_shapes *s, fw_geometry_vec2 w, fw_geometry_vec2 u, double from,
                    double length, double half) {
    fw_geometry_vec2 v = fw_left(u);
    for (double t = from; t <= from + length + 1e-12; t += 0.5 * STEP_M)
        for (int k = -1; k <= 1; k++)
            if (!is_solid(s, fw_add(fw_add(w, t, u), k * half, v))) return false;
    return true;
}

/* how far from W the neck may end in what is drawn; HUGE_VAL: it does not get there */
static double reach_along(const fw_layout_shapes *s, fw_geometry_vec2 w, fw_geometry_vec2 u,
                          double clear, double half, double most) {
    const double deep = fw_layout_rule.neck_into_plate_m;
    for (double t = clear; t < most; t += STEP_M) {
        if (!is_solid(s, fw_add(w, t, u))) continue;
        if (lies_in(s, w, u, t, deep, half + BESIDE_M)) return t;
    }
    return HUGE_VAL;
}

/* the lesser of what is drawn to either side of the neck's line, up to `most` */
static double half_there(const fw_layout_shapes *s, fw_geometry_vec2 at, fw_geometry_vec2 u,
                         double most) {
    const fw_geometry_vec2 v = fw_left(u);
    const double step = 0.05 * STEP_M;
    double half = 0.0;
    while (half < most && is_solid(s, fw_add(at, half + step, v)) &&
           is_solid(s, fw_add(at, -half - step, v)))
        half += step;
    return half;
}

static fw_geometry_vec2 nearest_point(const fw_geometry_region *r, fw_geometry_vec2 w) {
    double least = HUGE_VAL;
    fw_geometry_vec2 best = w;
    for (int i = 0; i < r->count; i++)
        for (int k = 0; k < r->contour[i].count; k++) {
            double t;
            fw_geometry_vec2 at;
            double far = fw_geometry_segment_nearest(&r->contour[i].segment[k], w, &t, &at);
            if (far < least - 1e-12) least = far, best = at;
        }
    return best;
}

/* Gaps of what is drawn that a neck closes beside leading into it, and the place of one of them.
   What a simple outline N has in common with what is drawn, S, tells: of c pieces, which join m
   pieces of S, c - m go round a gap (Mayer and Vietoris: H1(N u S) = H1(S) + ker(H0(N n S) -> H0(N) + H0(S))),
   and a hole in one of them is a gap that N covers. One piece without a hole closes nothing. */
typedef struct closing {
    int gaps;
    fw_geometry_vec2 at;
} closing;

static const double TOLD_GAP_M2 = 1e-12; /* 1 um2: no mask shows less */

static int outer_of(const fw_geometry_region *r) {
    int n = 0;
    for (int i = 0; i < r->count; i++)
        n += fw_geometry_contour_area(&r->contour[i]) > 0;
    return n;
}

static fw_status closes(fw_arena *arena, const fw_geometry_region *drawn,
                        const fw_geometry_contour *neck, fw_geometry_vec2 w, closing *out) {
    fw_geometry_region own = {(fw_geometry_contour *)neck, 1}, common, both;
    double nearest = HUGE_VAL;
    int met = 0, holes = 0;
    *out = (closing){0};
    fw_status status = fw_geometry_region_boolean(arena, drawn, &own, FW_INTERSECTION, &common);
    if (status != FW_OK) return status == FW_GEOMETRY ? FW_OK : status; /* edges nearly coincide */
    for (int i = 0; i < common.count; i++) {
        const double area = fw_geometry_contour_area(&common.contour[i]);
        if (fabs(area) < TOLD_GAP_M2) continue;
        fw_geometry_region piece = {&common.contour[i], 1};
        const fw_geometry_vec2 middle = fw_geometry_region_moments(&piece).centroid;
        const double far = area < 0 ? -1.0 : fw_norm(fw_sub(middle, w));
        if (area > 0) met++;
        if (area < 0) holes++;
        if (far < nearest) nearest = far, out->at = middle;
    }
    if (met + holes < 2) return FW_OK;
    status = fw_geometry_region_boolean(arena, drawn, &own, FW_UNION, &both);
    if (status != FW_OK) return status == FW_GEOMETRY ? FW_OK : status;
    const int joined = outer_of(drawn) - outer_of(&both) + 1;
    out->gaps = holes + (met > joined ? met - joined : 0);
    return FW_OK;
}

/* what a neck along u from the free circle to `end` would close */
static fw_status closes_along(const fw_layout_drawing *d, int body, const fw_layout_neck_way *way,
                              fw_geometry_vec2 u, double end, bool *open) {
    const fw_layout_local local = {way->w, u.x, u.y, false};
    const double half = way->half_m - fw_layout_rule.neck_inset_m;
    const fw_geometry_vec2 corner[4] = {
        {way->clear_m, -half}, {end, -half}, {end, half}, {way->clear_m, half}};
    fw_geometry_contour neck;
    closing gap;
    *open = true;
    if (!(half > 0 && end > way->clear_m)) return FW_OK;
    FW_TRY(fw_layout_polygon(d->arena, &local, corner, 4, -1, &neck));
    FW_TRY(closes(d->arena, &d->shapes[body].all, &neck, way->w, &gap));
    *open = gap.gaps == 0;
    return FW_OK;
}

/* Of 64 directions, from the one straight to the nearest edge (W outside) or to the centroid (W
   inside, or on the edge, of which rounding would say either) on, that of the shortest neck; of
   equally long ones the first, of two as far off as each other the one nearer to the centroid, so
   that mirrored bodies get mirrored necks. Test: test_shapes.py, test_hinges_on_the_edge */
fw_status fw_layout_shape_direction(const fw_layout_drawing *d, int body, fw_layout_neck_way *way,
                                    fw_geometry_vec2 *direction, double *begins_m, bool *found) {
    const fw_layout_shapes *s = &d->shapes[body];
    const fw_geometry_vec2 w = way->w, middle = fw_geometry_region_moments(&s->all).centroid;
    fw_geometry_vec2 near = nearest_point(&s->all, w);
    bool inside = is_solid(s, w) || fw_norm(fw_sub(near, w)) < ON_EDGE_M;
    fw_geometry_vec2 base = fw_towards(w, inside ? middle : near);
    fw_geometry_vec2 to = fw_towards(w, middle);
    double side = vec_cross(base, to) < 0 ? -1.0 : 1.0, best = way->clear_m + FARTHEST_M;
    *found = false;
    for (int k = 0; k < DIRECTIONS; k++) {
        double turn = side * ((k + 1) / 2) * (k % 2 ? 1 : -1) * 2.0 * FW_PI / DIRECTIONS;
        fw_geometry_vec2 u = turn == 0 ? base : fw_geometry_vec_rotate(base, turn);
        double most = *found ? best - SAME_STEP_M : best;
        double far = reach_along(s, w, u, way->clear_m, way->half_m, most);
        bool open = far < most;
        if (open && !way->across)
            FW_TRY(closes_along(d, body, way, u, far + fw_layout_rule.neck_into_plate_m, &open));
        if (!open) continue;
        best = far, *found = true;
        *direction = u;
        *begins_m = far;
    }
    if (*found)
        way->half_there_m = half_there(s, fw_add(w, way->clear_m, *direction), *direction,
                                       way->half_m + 2.0 * fw_layout_rule.block_step_m);
    return FW_OK;
}

static double distance_from(const fw_geometry_region *r, fw_geometry_vec2 w) {
    if (r->count == 0) return HUGE_VAL;
    return holds(r, w) ? 0.0 : fw_norm(fw_sub(nearest_point(r, w), w));
}

fw_status fw_layout_plate_way(const fw_layout_drawing *d, int body, const fw_layout_neck_way *way,
                              fw_geometry_vec2 direction, double begins_m, bool *nearest,
                              bool *open) {
    const fw_layout_shapes *s = &d->shapes[body];
    const fw_geometry_vec2 w = way->w;
    const double deep = fw_layout_rule.neck_into_plate_m;
    const double others = fmax(way->clear_m, distance_from(&s->solid, w));
    double first = way->clear_m; /* of anything that is drawn, along the neck's middle */
    while (first < begins_m && !is_solid(s, fw_add(w, first, direction)))
        first += STEP_M;
    /* of all that is drawn nothing is nearer than the others: then it is the plate */
    *nearest =
        fmax(way->clear_m, distance_from(&s->all, w)) < others || first <= others + SAME_STEP_M;
    return closes_along(d, body, way, direction, fmax(way->clear_m, begins_m + way->half_m) + deep,
                        open);
}

/* ---- what necks close ---- */

fw_status fw_layout_shapes_say_closed(fw_layout_drawing *d, int body) {
    const fw_geometry_region *left = &d->shapes[body].left;
    const char *label = fw_layout_body_label(d, body);
    FW_NEED(label);
    for (int j = 0; j < d->device->nrevolute && !d->said; j++)
        for (int i = 0; i < 2; i++) {
            const fw_layout_side *side = &d->hinge[j].side[i];
            const fw_geometry_vec2 w = side->local.origin;
            char wide[32], far[32], x[32], y[32], most[32];
            closing gap;
            if (side->body != body) continue;
            FW_TRY(closes(d->arena, left, &side->head, w, &gap));
            if (gap.gaps == 0) continue;
            fw_diag_warning(d->diags, 702, d->device->revolute[j].place,
                            "the neck of %s%s, %s um wide and ending %s um from it, leads across "
                            "what is drawn of %s, at (%s, %s) um%s: a gap that the description "
                            "leaves open is closed there, and the body is as stiff as that makes "
                            "it. The layout knows no way past it: draw what the hinge is to hold "
                            "within %s um of it, with nothing in between, or move the hinge",
                            FW_NAMED("hinge", d->device->revolute[j].id),
                            fw_layout_um(wide, 2.0 * side->neck_m),
                            fw_layout_um(far, side->neck_end_m), label, fw_layout_um(x, gap.at.x),
                            fw_layout_um(y, gap.at.y), gap.gaps > 1 ? " and elsewhere" : "",
                            fw_layout_um(most, d->layout->hinge[j].keep_out_m + FARTHEST_M));
        }
    return FW_OK;
}

/* ---- what hinges take of it ---- */

static const double IN_STRIP_M = 0.1e-6; /* what is rounded off */

/* Of a straight strip that ends, across, in the middle of its own hinge at w: is all of this contour within it? The half of
   the hinge's place is then what the hinge needs of a link that is drawn to its centre, as it is to be. Longer than wide:
   what is not is a plate, of which as much of its mass is gone */
static bool in_strip_to(const fw_geometry_contour *strip, fw_geometry_vec2 w,
                        const fw_geometry_contour *lost) {
    for (int k = 0; strip->count == 4 && k < 4; k++) {
        const fw_geometry_vec2 a = strip->segment[k].a, b = strip->segment[k].b,
                               to = strip->segment[(k + 1) % 4].b;
        const double wide = fw_norm(fw_sub(b, a)), length = fw_norm(fw_sub(to, b));
        const fw_geometry_vec2 u = fw_towards(b, to), v = fw_towards(a, b),
                               middle = fw_add(a, 0.5 * wide, v);
        bool within = length > wide && fabs(vec_dot(u, v)) < 1e-6 &&
                      fw_norm(fw_sub(w, middle)) < 10 * IN_STRIP_M;
        for (int i = 0; i < lost->count && within; i++) {
            const fw_geometry_vec2 p = fw_sub(lost->segment[i].a, middle);
            const double along = vec_dot(p, u), across = fabs(vec_dot(p, v));
            within = along > -IN_STRIP_M && along < length + IN_STRIP_M &&
                     across < 0.5 * wide + IN_STRIP_M;
        }
        if (within) return true;
    }
    return false;
}

static bool is_own(const fw_layout_drawing *d, int hinge, int body) {
    return d->hinge[hinge].side[0].body == body || d->hinge[hinge].side[1].body == body;
}

/* what a link loses to the hinge that it ends in is no mistake */
static bool ends_in_hinge(fw_layout_drawing *d, int body, int hinge,
                          const fw_geometry_contour *lost) {
    const fw_device_body *b = &d->device->body[body];
    for (int i = 0; is_own(d, hinge, body) && i < b->nshape; i++) {
        fw_geometry_contour world;
        if (b->shape[i].text || b->shape[i].hole) continue;
        if (to_world(d, body, &b->shape[i].contour, &world) == FW_OK &&
            in_strip_to(&world, d->hinge[hinge].side[0].local.origin, lost))
            return true;
    }
    return false;
}

fw_status fw_layout_shapes_say_cut(fw_layout_drawing *d, int body) {
    const double told_m2 = 25e-12, /* less is no more than a rounded corner */
        weighs = 0.05;             /* of what is drawn: more is felt in every frequency */
    const fw_geometry_region *solid = &d->shapes[body].solid;
    fw_geometry_region drawn = {&d->raw[body], 1};
    const char *label = fw_layout_body_label(d, body);
    double all = 0, most = 0;
    int worst = 0; /* the hinge that takes most of it */
    char part[32];
    FW_NEED(label);
    for (int j = 0; j < d->device->nrevolute && !d->said; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        fw_geometry_contour disc;
        fw_geometry_region round = {&disc, 1}, within, lost;
        double area = 0;
        FW_TRY(fw_geometry_contour_disc(d->arena, h->centre, h->keep_out_m, &disc));
        FW_TRY(fw_geometry_region_boolean(d->arena, solid, &round, FW_INTERSECTION, &within));
        if (within.count == 0) continue;
        FW_TRY(fw_geometry_region_boolean(d->arena, &within, &drawn, FW_DIFFERENCE, &lost));
        for (int i = 0; i < lost.count; i++)
            if (!ends_in_hinge(d, body, j, &lost.contour[i]))
                area += fw_geometry_contour_area(&lost.contour[i]);
        if (area < told_m2) continue;
        all += area;
        if (area > most) most = area, worst = j;
        char r[32], um2[32], x[32], y[32];
        fw_diag_note(d->diags, 537, fw_layout_body_place(d, body),
                     "%s is drawn into the round place of %s%s, %s um about (%s, %s) um, and "
                     "%s um^2 of it are not on the masks; end what is drawn outside of that, or "
                     "move the hinge",
                     label, FW_NAMED("hinge", d->device->revolute[j].id),
                     fw_layout_um(r, h->keep_out_m), fw_layout_um(x, h->centre.x),
                     fw_layout_um(y, h->centre.y), fw_number_text(um2, sizeof um2, 1e12 * area, 3));
    }
    const double share = all / fabs(fw_geometry_region_moments(solid).area_m2);
    if (share > weighs)
        fw_diag_warning(
            d->diags, 537, fw_layout_body_place(d, body),
            "%s is drawn into the round places of its hinges or of others, and %s %% of what is "
            "drawn is neither on the masks nor in its mass: frequencies and weight are those of "
            "what is left. Most of it is at %s%s; end what is drawn outside of them",
            label, fw_number_text(part, sizeof part, 100 * share, 2),
            FW_NAMED("hinge", d->device->revolute[worst].id));
    return FW_OK;
}
