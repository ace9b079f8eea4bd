/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure.h"
#include "base/sort.h"
#include "geometry/contour.h"
#include "report/report_page.h"
#include <math.h>
#include <stdlib.h>

enum { POSES = 2000, PAD = 34, FLOOR = 16 }; /* FLOOR: more room below, for the scale bar */

fw_geometry_vec2 fw_report_figure_place(const double *q, fw_report_figure_point p) {
    if (p.body == FW_GROUND) return (fw_geometry_vec2){p.x_m, p.y_m};
    const double *b = q + 3 * p.body;
    double c = cos(b[2]), s = sin(b[2]);
    return (fw_geometry_vec2){b[0] + c * p.x_m - s * p.y_m, b[1] + s * p.x_m + c * p.y_m};
}

/* many poses: some of them are enough for an extent, the last one belongs to them */
static int stride(int count) {
    return 1 + (count - 1) / POSES;
}

static void reach_point(fw_geometry_box *box, fw_report_figure_point p, const double *q, int count,
                        int nbody) {
    int step = p.body == FW_GROUND ? count : stride(count);
    for (int k = count - 1; k >= 0; k -= step) {
        fw_geometry_vec2 w = fw_report_figure_place(q + 3 * (size_t)nbody * (size_t)k, p);
        fw_report_box_add(box, w.x, w.y);
    }
}

bool fw_report_figure_is_line(const fw_report_figure_part *part) {
    switch (part->role) {
    case FW_FIGURE_RAIL:
    case FW_FIGURE_BODY:
    case FW_FIGURE_ROD:
    case FW_FIGURE_DRIVEN_ROD:
    case FW_FIGURE_SPRING:
    case FW_FIGURE_CABLE:
        return true;
    case FW_FIGURE_PLATE:
    case FW_FIGURE_BLOCK:
    case FW_FIGURE_FOOT:
    case FW_FIGURE_WELD:
    case FW_FIGURE_STOP:
    case FW_FIGURE_TURN:
    case FW_FIGURE_PUSH:
    case FW_FIGURE_END:
    case FW_FIGURE_PIN:
        break;
    }
    return false;
}

void fw_report_figure_reach(fw_geometry_box *box, const fw_report_figure_part *part,
                            const double *q, int count, int nbody) {
    for (int i = 0; i < part->noutline; i++)
        reach_point(
            box,
            (fw_report_figure_point){part->end[0].body, part->outline[i].x, part->outline[i].y}, q,
            count, nbody);
    if (part->noutline) return;
    reach_point(box, part->end[0], q, count, nbody);
    if (fw_report_figure_is_line(part) || part->role == FW_FIGURE_PLATE)
        reach_point(box, part->end[1], q, count, nbody);
}

fw_report_view fw_report_figure_view(const fw_geometry_box *box, double width) {
    fw_geometry_box b = *box;
    if (!(b.x1 >= b.x0) || !(b.y1 >= b.y0)) b = (fw_geometry_box){0, 0, 0, 0};
    double wide = b.x1 - b.x0, high = b.y1 - b.y0, size = fmax(wide, high);
    if (!(size > 0.0) || !isfinite(size)) size = 1e-3;
    double pad = fmin(PAD, 0.08 * width), inner = width - 2 * pad;
    wide = fmax(wide, 0.25 * size), high = fmax(high, 0.2 * size);
    fw_report_view view = {.width = width, .scale = fmin(inner / wide, 0.85 * inner / high)};
    view.height = fw_report_whole_pixels(high * view.scale) + 2 * pad + FLOOR;
    view.x0_m = 0.5 * (b.x0 + b.x1) - 0.5 * width / view.scale;
    view.y1_m = 0.5 * (b.y0 + b.y1) + 0.5 * (view.height - FLOOR) / view.scale;
    return view;
}

/* ---- making: parts ---- */

typedef struct maker {
    fw_arena *arena;
    fw_report_drawing_figure *figure;
    const fw_mechanism *m;
    const double *q; /* (count x 3 nbody) */
    int count;
    fw_geometry_vec2 *point, *hull; /* (most) of one body at a time */
    double (*rail_m)[2];            /* (njoint) from and to along the axis; equal: no rail */
    double *spring_m; /* (njoint) where the spring of a slider is held; NaN: it has none */
} maker;

static fw_report_figure_part *add(maker *k, fw_report_figure_role role, fw_report_figure_point a,
                                  fw_report_figure_point b) {
    fw_report_figure_part *p = &k->figure->part[k->figure->count++];
    *p = (fw_report_figure_part){
        .role = role, .of = FW_NONE, .pin = FW_NONE, .end = {a, b}, .turns_with = FW_GROUND};
    return p;
}

static fw_report_figure_part *mark(maker *k, fw_report_figure_role role,
                                   fw_report_figure_point at) {
    return add(k, role, at, at);
}

static fw_report_figure_point joint_a(const fw_device_joint *t) {
    return (fw_report_figure_point){t->body_a, t->ax_m, t->ay_m};
}

static fw_report_figure_point joint_b(const fw_device_joint *t) {
    return (fw_report_figure_point){t->body_b, t->bx_m, t->by_m};
}

/* point of the guide at `along` */
static fw_report_figure_point on_rail(const fw_device_joint *t, double along) {
    return (fw_report_figure_point){t->body_a, t->ax_m + along * cos(t->axis_rad),
                                    t->ay_m + along * sin(t->axis_rad)};
}

/* distance of the slider from point a along the axis */
static double travelled(const fw_device_joint *t, const double *q) {
    fw_geometry_vec2 a = fw_report_figure_place(q, joint_a(t)),
                     b = fw_report_figure_place(q, joint_b(t));
    double axis = t->axis_rad + (t->body_a == FW_GROUND ? 0.0 : q[3 * t->body_a + 2]);
    return cos(axis) * (b.x - a.x) + sin(axis) * (b.y - a.y);
}

static int driver_of(const fw_mechanism *m, int pin, int joint) {
    for (int i = 0; i < m->ndriver; i++)
        if ((pin != FW_NONE && m->driver[i].revolute == pin) ||
            (joint != FW_NONE && m->driver[i].joint == joint))
            return i;
    return FW_NONE;
}

/* a guide reaches a little beyond its slider; on a body that moves it starts at point a, where it
   is fixed; the spring of a slider pushes against the ground or body a, where point a leaves no
   room for it: against the guide's lower end */
static void rails(maker *k) {
    const fw_mechanism *m = k->m;
    double more = (k->count > 1 ? 0.07 : 0.12) * k->figure->size_m;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        k->spring_m[i] = (double)NAN;
        k->rail_m[i][0] = k->rail_m[i][1] = 0.0;
        if (t->kind != FW_JOINT_PRISMATIC) continue;
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int p = k->count - 1; p >= 0; p -= stride(k->count)) {
            double s = travelled(t, k->q + 3 * (size_t)m->nbody * (size_t)p);
            low = fmin(low, s), high = fmax(high, s);
        }
        if (!isfinite(low) || !isfinite(high)) low = high = 0.0;
        if (t->stiffness_N_per_m > 0.0)
            k->spring_m[i] = low > 2 * more || high < -2 * more ? 0.0 : low - 3 * more;
        low -= more, high += more;
        if (t->body_a != FW_GROUND) low = fmin(low, 0.0), high = fmax(high, 0.0);
        if (!isnan(k->spring_m[i]))
            low = fmin(low, k->spring_m[i]), high = fmax(high, k->spring_m[i]);
        k->rail_m[i][0] = low, k->rail_m[i][1] = high;
        fw_report_figure_part *part = add(k, FW_FIGURE_RAIL, on_rail(t, low), on_rail(t, high));
        part->of = t->body_a;
    }
}

/* ---- bodies ---- */

static int by_place(const void *a, const void *b) {
    const fw_geometry_vec2 *p = a, *q = b;
    int order = fw_order_doubles(p->x, q->x);
    return order ? order : fw_order_doubles(p->y, q->y);
}

static double cross(fw_geometry_vec2 a, fw_geometry_vec2 b, fw_geometry_vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Convex hull, counter-clockwise: lower, then upper chain of the points in order of x (Andrew,
   Information Processing Letters 9, 1979). Points within 1e-4 of their extent of a line, or of a
   point: its two ends, or one. O(n log n). `point` is sorted, `hull` holds n + 1. Tested through
   test_report_figure. */
static int convex_hull(fw_geometry_vec2 *point, int n, fw_geometry_vec2 *hull, double size) {
    qsort(point, (size_t)n, sizeof *point, by_place);
    double wide = 0.0;
    for (int i = 1; i < n; i++)
        wide = fmax(wide, hypot(point[i].x - point[0].x, point[i].y - point[0].y));
    hull[0] = point[0];
    if (!(wide > 1e-6 * size)) return 1;
    int h = 0;
    for (int i = 0; i < n; i++) {
        while (h >= 2 && cross(hull[h - 2], hull[h - 1], point[i]) <= 0.0)
            h--;
        hull[h++] = point[i];
    }
    for (int i = n - 2, low = h + 1; i >= 0; i--) {
        while (h >= low && cross(hull[h - 2], hull[h - 1], point[i]) <= 0.0)
            h--;
        hull[h++] = point[i];
    }
    h--; /* the first point again */
    double area = 0.0;
    for (int i = 2; i < h; i++)
        area += 0.5 * cross(hull[0], hull[i - 1], hull[i]);
    if (area > 1e-4 * wide * wide) return h;
    hull[0] = point[0], hull[1] = point[n - 1];
    return 2;
}

static void own(maker *k, int *n, int body, fw_report_figure_point p) {
    if (p.body == body && isfinite(p.x_m) && isfinite(p.y_m))
        k->point[(*n)++] = (fw_geometry_vec2){p.x_m, p.y_m};
}

/* what a body holds together: its centre of mass, its joints, springs and guides */
static int points_of(maker *k, int body) {
    const fw_mechanism *m = k->m;
    int n = 0;
    own(k, &n, body, (fw_report_figure_point){body, 0.0, 0.0});
    for (int i = 0; i < m->npin; i++) {
        own(k, &n, body,
            (fw_report_figure_point){m->pin[i].body_a, m->pin[i].ax_m, m->pin[i].ay_m});
        own(k, &n, body,
            (fw_report_figure_point){m->pin[i].body_b, m->pin[i].bx_m, m->pin[i].by_m});
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        bool guide = t->kind == FW_JOINT_PRISMATIC;
        own(k, &n, body, guide ? on_rail(t, k->rail_m[i][0]) : joint_a(t));
        if (guide) own(k, &n, body, on_rail(t, k->rail_m[i][1]));
        own(k, &n, body, joint_b(t));
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        own(k, &n, body, (fw_report_figure_point){s->body_a, s->ax_m, s->ay_m});
        own(k, &n, body, (fw_report_figure_point){s->body_b, s->bx_m, s->by_m});
    }
    return n;
}

static bool is_slider(const fw_mechanism *m, int body) {
    for (int i = 0; i < m->njoint; i++)
        if (m->joint[i].kind == FW_JOINT_PRISMATIC && m->joint[i].body_b == body) return true;
    return false;
}

static fw_status bodies(maker *k) {
    for (int b = 0; b < k->m->nbody; b++) {
        int n = convex_hull(k->point, points_of(k, b), k->hull, k->figure->size_m);
        fw_report_figure_point at = {b, k->hull[0].x, k->hull[0].y};
        if (n == 1 && is_slider(k->m, b)) continue; /* its block is enough */
        fw_report_figure_part *p = mark(k, n == 1 ? FW_FIGURE_PLATE : FW_FIGURE_BODY, at);
        p->of = p->turns_with = b;
        if (n == 1) continue;
        p->noutline = n;
        FW_NEED(p->outline = fw_arena_array(k->arena, fw_geometry_vec2, (size_t)n));
        for (int i = 0; i < n; i++)
            p->outline[i] = k->hull[i];
    }
    return FW_OK;
}

/* ---- joints ---- */

static void held(maker *k, fw_report_figure_point p, int pin) {
    if (p.body == FW_GROUND) mark(k, FW_FIGURE_FOOT, p)->pin = pin;
}

static void lines(maker *k) {
    const fw_mechanism *m = k->m;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        if (t->kind == FW_JOINT_DISTANCE)
            add(k, driver_of(m, FW_NONE, i) == FW_NONE ? FW_FIGURE_ROD : FW_FIGURE_DRIVEN_ROD,
                joint_a(t), joint_b(t));
        if (!isnan(k->spring_m[i]))
            add(k, FW_FIGURE_SPRING, on_rail(t, k->spring_m[i]), joint_b(t));
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        add(k, s->cable ? FW_FIGURE_CABLE : FW_FIGURE_SPRING,
            (fw_report_figure_point){s->body_a, s->ax_m, s->ay_m},
            (fw_report_figure_point){s->body_b, s->bx_m, s->by_m});
    }
}

static void joint_marks(maker *k) {
    const fw_mechanism *m = k->m;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        if (t->kind == FW_JOINT_DISTANCE) continue;
        if (t->kind == FW_JOINT_WELD) {
            held(k, joint_a(t), FW_NONE), held(k, joint_b(t), FW_NONE);
            mark(k, FW_FIGURE_WELD, joint_b(t))->turns_with = t->body_b;
            continue;
        }
        fw_report_figure_part *p = mark(k, FW_FIGURE_BLOCK, joint_b(t));
        p->of = t->body_b;
        p->turns_with = t->body_a;
        p->angle_rad = t->axis_rad;
        if (!isnan(k->spring_m[i])) held(k, on_rail(t, k->spring_m[i]), FW_NONE);
    }
}

static void ends(maker *k) {
    const fw_mechanism *m = k->m;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        if (t->kind != FW_JOINT_DISTANCE) continue;
        held(k, joint_a(t), FW_NONE), held(k, joint_b(t), FW_NONE);
        mark(k, FW_FIGURE_END, joint_a(t)), mark(k, FW_FIGURE_END, joint_b(t));
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        fw_report_figure_point a = {s->body_a, s->ax_m, s->ay_m}, b = {s->body_b, s->bx_m, s->by_m};
        held(k, a, FW_NONE), held(k, b, FW_NONE);
        mark(k, FW_FIGURE_END, a), mark(k, FW_FIGURE_END, b);
    }
}

/* direction in which a body is seen from its local point: to the farthest of its points */
static double direction(maker *k, fw_report_figure_point from) {
    double far = 0.0, angle = 0.0;
    int n = points_of(k, from.body);
    for (int i = 0; i < n; i++) {
        double dx = k->point[i].x - from.x_m, dy = k->point[i].y - from.y_m;
        if (hypot(dx, dy) > far) far = hypot(dx, dy), angle = atan2(dy, dx);
    }
    return angle;
}

/* the free angles of the body that moves, in the frame of the other one: phi_b = phi_a + free angle
   + joint angle */
static void stop(maker *k, const fw_mechanism_pin *pin, fw_report_figure_point a,
                 fw_report_figure_point b) {
    if (!(pin->stop_stiffness_Nm_per_rad > 0.0)) return;
    double low = pin->stop_min_rad, high = pin->stop_max_rad;
    if (isnan(low) && isnan(high)) return;
    bool other = b.body == FW_GROUND; /* then body a moves, the other way round */
    fw_report_figure_part *p = mark(k, FW_FIGURE_STOP, other ? b : a);
    double zero = pin->free_angle_rad + (other ? -direction(k, a) : direction(k, b));
    p->turns_with = p->end[0].body;
    p->from_rad = other ? -(zero + high) : zero + low;
    p->to_rad = other ? -(zero + low) : zero + high;
}

static void pins(maker *k) {
    const fw_mechanism *m = k->m;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *pin = &m->pin[i];
        fw_report_figure_point a = {pin->body_a, pin->ax_m, pin->ay_m};
        fw_report_figure_point b = {pin->body_b, pin->bx_m, pin->by_m};
        held(k, a, i), held(k, b, i);
        stop(k, pin, a, b);
        if (driver_of(m, i, FW_NONE) != FW_NONE) mark(k, FW_FIGURE_TURN, a);
        mark(k, FW_FIGURE_PIN, a)->pin = i;
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        if (t->kind != FW_JOINT_PRISMATIC || driver_of(m, FW_NONE, i) == FW_NONE) continue;
        fw_report_figure_part *p = mark(k, FW_FIGURE_PUSH, joint_b(t));
        p->turns_with = t->body_a;
        p->angle_rad = t->axis_rad;
    }
}

static double extent(maker *k) {
    const fw_mechanism *m = k->m;
    fw_geometry_box box = fw_report_box_empty();
    for (int b = 0; b < m->nbody; b++) {
        int n = points_of(k, b); /* guides have no length yet: their points a */
        for (int i = 0; i < n; i++)
            reach_point(&box, (fw_report_figure_point){b, k->point[i].x, k->point[i].y}, k->q,
                        k->count, m->nbody);
    }
    int n = points_of(k, FW_GROUND);
    for (int i = 1; i < n; i++) /* not the origin */
        fw_report_box_add(&box, k->point[i].x, k->point[i].y);
    double size = fmax(box.x1 - box.x0, box.y1 - box.y0);
    return size > 0.0 && isfinite(size) ? size : 1e-3;
}

fw_status fw_report_figure_make(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                int count, fw_report_drawing_figure *figure) {
    const fw_mechanism *m = mechanism;
    *figure = (fw_report_drawing_figure){.mechanism = m};
    size_t joint = (size_t)m->njoint, pin = (size_t)m->npin, spring = (size_t)m->nspring;
    size_t most = (size_t)m->nbody + 7 * joint + 6 * pin + 5 * spring + 1;
    size_t points = 2 * pin + 3 * joint + 2 * spring + 2;
    maker k = {.arena = arena, .figure = figure, .m = m, .q = q, .count = count};
    FW_NEED(figure->part = fw_arena_array(arena, fw_report_figure_part, most));
    FW_NEED(k.point = fw_arena_array(arena, fw_geometry_vec2, points));
    FW_NEED(k.hull = fw_arena_array(arena, fw_geometry_vec2, points + 1));
    FW_NEED(k.rail_m = fw_arena_alloc(arena, joint + 1, sizeof *k.rail_m));
    FW_NEED(k.spring_m = fw_arena_array(arena, double, joint + 1));
    figure->size_m = extent(&k);
    rails(&k);
    FW_TRY(bodies(&k));
    lines(&k);
    joint_marks(&k);
    ends(&k);
    pins(&k);
    return FW_OK;
}

fw_status fw_report_figure_of_verdict(fw_arena *arena, const fw_verdict *verdict,
                                      fw_report_drawing_figure *figure, double **q) {
    const fw_mechanism *m = verdict && verdict->nvariant > 0 ? verdict->variant[0].mechanism : NULL;
    *q = NULL;
    if (!m) return FW_OK;
    double *pose = fw_arena_array(arena, double, 3 * (size_t)m->nbody + 1);
    FW_NEED(pose);
    for (int b = 0; b < m->nbody; b++) {
        pose[3 * b] = m->body[b].x_m;
        pose[3 * b + 1] = m->body[b].y_m;
        pose[3 * b + 2] = m->body[b].phi_rad;
    }
    *q = pose;
    return fw_report_figure_make(arena, m, pose, 1, figure);
}

fw_status fw_report_figure_rest_reach(fw_arena *arena, const fw_verdict *verdict,
                                      fw_geometry_box *box) {
    fw_report_drawing_figure figure;
    double *q;
    FW_TRY(fw_report_figure_of_verdict(arena, verdict, &figure, &q));
    for (int i = 0; q && i < figure.count; i++)
        fw_report_figure_reach(box, &figure.part[i], q, 1, figure.mechanism->nbody);
    return FW_OK;
}

/* ---- the view of a device: from metres to the coordinates of a picture ---- */

bool fw_report_drawn(const fw_layout *layout) {
    return layout && (layout->drawn || layout->nfault > 0) && layout->npiece;
}

bool fw_report_outlined(const fw_layout *layout, int body) {
    if (body < 0 || !fw_report_drawn(layout) || !layout->body) return false;
    bool pieces = false; /* of what cannot be made nothing may be measured */
    for (int i = 0; layout->nfault > 0 && i < layout->npiece; i++)
        pieces =
            pieces || (layout->piece[i].body == body && layout->piece[i].role == FW_ROLE_STRUCTURE);
    return pieces || layout->body[body].area_m2 > 0.0;
}

fw_geometry_box fw_report_box_empty(void) {
    return (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
}

void fw_report_box_add(fw_geometry_box *box, double x_m, double y_m) {
    if (!isfinite(x_m) || !isfinite(y_m)) return;
    box->x0 = fmin(box->x0, x_m);
    box->x1 = fmax(box->x1, x_m);
    box->y0 = fmin(box->y0, y_m);
    box->y1 = fmax(box->y1, y_m);
}

double fw_report_whole_pixels(double height) {
    return ceil(height - 1e-6);
}

fw_report_view fw_report_view_fit(fw_geometry_box box, double width, double pad_m) {
    if (!(box.x1 >= box.x0) || !(box.y1 >= box.y0)) box = (fw_geometry_box){0.0, 0.0, 1e-3, 1e-3};
    double wide = box.x1 - box.x0 + 2.0 * pad_m, high = box.y1 - box.y0 + 2.0 * pad_m;
    double size = fmax(wide, high);
    if (!(size > 0.0)) size = 1e-3;
    wide = fmax(wide, 0.25 * size);
    high = fmax(high, 0.25 * size);
    fw_report_view view = {.width = width};
    view.scale = fmin(width / wide, 1.25 * width / high); /* never taller than 5:4 */
    view.height = fw_report_whole_pixels(high * view.scale);
    view.x0_m = 0.5 * (box.x0 + box.x1) - 0.5 * width / view.scale;
    view.y1_m = 0.5 * (box.y0 + box.y1) + 0.5 * view.height / view.scale;
    return view;
}

double fw_report_x(const fw_report_view *view, double x_m) {
    return (x_m - view->x0_m) * view->scale;
}

double fw_report_y(const fw_report_view *view, double y_m) {
    return (view->y1_m - y_m) * view->scale;
}

void fw_report_path(fw_text *out, const fw_report_view *view, const fw_geometry_contour *contour) {
    const fw_geometry_sheet sheet = {view->x0_m, view->y1_m, view->scale, 2,
                                     FW_GEOMETRY_ARC_PICTURE};
    fw_geometry_svg_contour(out, &sheet, contour);
}

void fw_report_body_path(const fw_layout *layout, int body, const fw_report_view *view,
                         fw_text *out) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->body == body && p->role == FW_ROLE_STRUCTURE) fw_report_path(out, view, &p->contour);
    }
}

fw_geometry_vec2 fw_report_hinge_point(const fw_device *device, const fw_layout *layout,
                                       int joint) {
    if (fw_report_drawn(layout) && layout->hinge && layout->hinge[joint].drawn)
        return layout->hinge[joint].centre;
    return (fw_geometry_vec2){device->revolute[joint].x_m, device->revolute[joint].y_m};
}
