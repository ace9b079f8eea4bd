/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where bodies stand, after a description was read: joints that rounding left open are closed, and frames move over
   their bodies. */
#include "device/device.h"
#include "device/device_reader.h"
#include <math.h>
#include <string.h>

/* ---- joints that are open by rounding ----
   Positions that were typed with few digits: joints that are open by no more than rounding leaves
   are closed here, once, so that drawing, motion, masks and recipes all have the same poses.

   A joint in the plane hangs on four numbers along each axis (two bodies, two local points).
   Rounded to a tenth of a micrometre each is off by 0.05 um at most, so that its two places are 0.2
   um apart along an axis and 0.283 um in all. Larger gaps are no rounding and stay as they are:
   `check` refuses them (FW-D206). Gaps up to 10 nm, which it accepts, stay too, with every bit. */

static const double CLOSED_M = 10e-9, ROUNDED_M = 0.3e-6;
static const double CLOSED_RAD = 1e-5, ROUNDED_RAD = 3e-4; /* the same over 1 mm */
static const double SMALL = 1e-3;      /* a gap is small beside the mechanism, too */
static const double FARTHEST_M = 1e-6; /* a correction beyond is no rounding: nearly dead centres */
enum { ROUNDS = 8, MOST_STEPS = 4000 };

typedef struct row { /* one condition: its value, and how that changes with the poses of two bodies
                      */
    double value;
    int body[2];     /* FW_GROUND: it does not move */
    double slope[6]; /* by x, y, phi of either */
    bool angle;      /* the value is rad, else m */
    const char *id;  /* of the joint */
    fw_place place;
} row;

typedef struct closing {
    const fw_device *device;
    row *row; /* (nrow) */
    int nrow;
    double *pose;  /* (3 nbody) m, m, rad */
    double *lever; /* (nbody) m: mean distance of a body's joints from its centre of mass */
} closing;

static bool placed(const fw_device *d, int body) {
    return body < 0 || isfinite(d->body[body].x_m + d->body[body].y_m + d->body[body].phi_rad);
}

/* a local point in the world, and its way when the body turns */
static fw_geometry_vec2 place_at(const closing *c, int body, double x, double y,
                                 fw_geometry_vec2 *turning) {
    *turning = (fw_geometry_vec2){0, 0};
    if (body < 0) return (fw_geometry_vec2){x, y};
    const double *q = c->pose + 3 * body;
    fw_geometry_vec2 arm = {cos(q[2]) * x - sin(q[2]) * y, sin(q[2]) * x + cos(q[2]) * y};
    *turning = (fw_geometry_vec2){-arm.y, arm.x};
    return (fw_geometry_vec2){q[0] + arm.x, q[1] + arm.y};
}

/* the span from a to b along u; `more`: what it changes by when body a turns, besides its point */
static void add_length(closing *c, const row *head, fw_geometry_vec2 u, fw_geometry_vec2 turn_a,
                       fw_geometry_vec2 turn_b, double more, double value) {
    row *r = &c->row[c->nrow++];
    *r = *head;
    r->value = value;
    const double slope[6] = {-u.x, -u.y, more - u.x * turn_a.x - u.y * turn_a.y,
                             u.x,  u.y,  u.x * turn_b.x + u.y * turn_b.y};
    memcpy(r->slope, slope, sizeof slope);
}

static void add_angle(closing *c, const row *head, double value) {
    row *r = &c->row[c->nrow++];
    *r = *head;
    r->value = value;
    r->angle = true;
    r->slope[2] = -1;
    r->slope[5] = 1;
}

static double turn_of(const closing *c, int body) {
    return body < 0 ? 0 : c->pose[3 * body + 2];
}

static bool driven(const fw_device *d, int joint) {
    for (int i = 0; i < d->ndriver; i++)
        if (d->driver[i].joint == joint) return true;
    return false;
}

static void add_joint(closing *c, int i) {
    const fw_device_joint *t = &c->device->joint[i];
    row head = {.body = {t->body_a, t->body_b}, .id = t->id, .place = t->place};
    fw_geometry_vec2 turn_a, turn_b;
    fw_geometry_vec2 a = place_at(c, t->body_a, t->ax_m, t->ay_m, &turn_a);
    fw_geometry_vec2 b = place_at(c, t->body_b, t->bx_m, t->by_m, &turn_b);
    double dx = b.x - a.x, dy = b.y - a.y, far = hypot(dx, dy);
    if (t->kind == FW_JOINT_DISTANCE) {
        if (isnan(t->length_m) || driven(c->device, i) || !(far > 0)) return;
        add_length(c, &head, (fw_geometry_vec2){dx / far, dy / far}, turn_a, turn_b, 0,
                   far - t->length_m);
        return;
    }
    if (!isnan(t->angle_rad))
        add_angle(c, &head, turn_of(c, t->body_b) - turn_of(c, t->body_a) - t->angle_rad);
    if (t->kind == FW_JOINT_WELD) {
        add_length(c, &head, (fw_geometry_vec2){1, 0}, turn_a, turn_b, 0, dx);
        add_length(c, &head, (fw_geometry_vec2){0, 1}, turn_a, turn_b, 0, dy);
        return;
    }
    double axis = turn_of(c, t->body_a) + t->axis_rad, x = cos(axis), y = sin(axis);
    if (isnan(axis)) return;
    double along = t->body_a < 0 ? 0 : x * dx + y * dy; /* the normal turns with body a */
    add_length(c, &head, (fw_geometry_vec2){-y, x}, turn_a, turn_b, -along, -y * dx + x * dy);
}

/* all conditions at the present poses; the largest gap of either kind */
static void list_rows(closing *c, double *gap_m, double *gap_rad, const row **worst) {
    const fw_device *d = c->device;
    c->nrow = 0;
    for (int j = 0; j < d->nrevolute; j++) {
        const fw_device_revolute *t = &d->revolute[j];
        if (isnan(t->ax_m + t->ay_m + t->bx_m + t->by_m) || !placed(d, t->body_a) ||
            !placed(d, t->body_b))
            continue;
        row head = {.body = {t->body_a, t->body_b}, .id = t->id, .place = t->place};
        fw_geometry_vec2 turn_a, turn_b;
        fw_geometry_vec2 a = place_at(c, t->body_a, t->ax_m, t->ay_m, &turn_a);
        fw_geometry_vec2 b = place_at(c, t->body_b, t->bx_m, t->by_m, &turn_b);
        add_length(c, &head, (fw_geometry_vec2){1, 0}, turn_a, turn_b, 0, b.x - a.x);
        add_length(c, &head, (fw_geometry_vec2){0, 1}, turn_a, turn_b, 0, b.y - a.y);
    }
    for (int i = 0; i < d->njoint; i++)
        if (placed(d, d->joint[i].body_a) && placed(d, d->joint[i].body_b)) add_joint(c, i);
    *gap_m = *gap_rad = 0;
    *worst = NULL;
    for (int i = 0; i < c->nrow; i++) {
        const row *r = &c->row[i];
        /* both rows of a pin, as one distance */
        bool pair = !r->angle && i + 1 < c->nrow && c->row[i + 1].id == r->id && !r[1].angle;
        double size = pair ? hypot(r->value, r[1].value) : fabs(r->value);
        double *most = r->angle ? gap_rad : gap_m;
        if (!isfinite(size)) *most = HUGE_VAL;
        if (!(size > *most)) continue;
        *most = size;
        if (!r->angle || !*worst) *worst = r;
    }
}

/* G y and G^T w in lengths: y holds displacements, turns times their body's lever */
static void apply(const closing *c, const double *y, double *w) {
    for (int i = 0; i < c->nrow; i++) {
        const row *r = &c->row[i];
        w[i] = 0;
        for (int k = 0; k < 6; k++) {
            int body = r->body[k / 3];
            if (body < 0) continue;
            w[i] += r->slope[k] * y[3 * body + k % 3] / (k % 3 == 2 ? c->lever[body] : 1);
        }
    }
}

static void apply_back(const closing *c, const double *w, double *y) {
    memset(y, 0, 3 * (size_t)c->device->nbody * sizeof *y);
    for (int i = 0; i < c->nrow; i++) {
        const row *r = &c->row[i];
        for (int k = 0; k < 6; k++) {
            int body = r->body[k / 3];
            if (body < 0) continue;
            y[3 * body + k % 3] += r->slope[k] * w[i] / (k % 3 == 2 ? c->lever[body] : 1);
        }
    }
}

static double square(const double *v, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += v[i] * v[i];
    return sum;
}

/* The shortest y with G y = -value, least squares where the rows contradict each other: conjugate
   gradients on the normal equations, which from y = 0 stay in the range of G^T. Redundant rows are
   no trouble. In: rows at the present poses. Out: y (3 nbody), m. Error: 1e-12 of the gaps, or
   what MOST_STEPS leave; what comes of it is looked at afterwards. Cost O(rows) a step, in exact
   arithmetic at most as many steps as rows. Source: Hestenes and Stiefel, J. Res. NBS 49 (1952) 409
   (CGLS). Test: test_close.c. */
static fw_status shortest(fw_arena *arena, const closing *c, double *y) {
    int n = 3 * c->device->nbody, m = c->nrow;
    double *left = fw_arena_array(arena, double, (size_t)m),
           *w = fw_arena_array(arena, double, (size_t)m);
    double *s = fw_arena_array(arena, double, (size_t)n),
           *p = fw_arena_array(arena, double, (size_t)n);
    if (!left || !w || !s || !p) return FW_NOMEM;
    memset(y, 0, (size_t)n * sizeof *y);
    for (int i = 0; i < m; i++)
        left[i] = -c->row[i].value;
    apply_back(c, left, s);
    memcpy(p, s, (size_t)n * sizeof *p);
    double gamma = square(s, n), first = gamma;
    for (int step = 0; step < MOST_STEPS && gamma > 1e-28 * first; step++) {
        apply(c, p, w);
        double along = square(w, m);
        if (!(along > 0)) break;
        double far = gamma / along, before = gamma;
        for (int i = 0; i < n; i++)
            y[i] += far * p[i];
        for (int i = 0; i < m; i++)
            left[i] -= far * w[i];
        apply_back(c, left, s);
        gamma = square(s, n);
        for (int i = 0; i < n; i++)
            p[i] = s[i] + gamma / before * p[i];
    }
    return FW_OK;
}

/* lengths by which turns are weighed, and the size of it all: the box of all joints and centres */
typedef struct sizes {
    double *lever;
    int *count;
    double x0, y0, x1, y1;
} sizes;

static void add_point(const closing *c, sizes *s, int body, double x, double y) {
    fw_geometry_vec2 turning;
    if (isnan(x + y) || !placed(c->device, body)) return;
    fw_geometry_vec2 at = place_at(c, body, x, y, &turning);
    fw_geometry_vec2 centre =
        body < 0 ? at : (fw_geometry_vec2){c->pose[3 * body], c->pose[3 * body + 1]};
    s->x0 = fmin(s->x0, fmin(at.x, centre.x)), s->x1 = fmax(s->x1, fmax(at.x, centre.x));
    s->y0 = fmin(s->y0, fmin(at.y, centre.y)), s->y1 = fmax(s->y1, fmax(at.y, centre.y));
    if (body < 0) return;
    s->lever[body] += x * x + y * y;
    s->count[body]++;
}

static fw_status set_levers(fw_arena *arena, closing *c, double *size_m) {
    const fw_device *d = c->device;
    sizes s = {c->lever,  fw_arena_array(arena, int, (size_t)d->nbody),
               HUGE_VAL,  HUGE_VAL,
               -HUGE_VAL, -HUGE_VAL};
    FW_NEED(s.count);
    for (int j = 0; j < d->nrevolute; j++) {
        add_point(c, &s, d->revolute[j].body_a, d->revolute[j].ax_m, d->revolute[j].ay_m);
        add_point(c, &s, d->revolute[j].body_b, d->revolute[j].bx_m, d->revolute[j].by_m);
    }
    for (int i = 0; i < d->njoint; i++) {
        add_point(c, &s, d->joint[i].body_a, d->joint[i].ax_m, d->joint[i].ay_m);
        add_point(c, &s, d->joint[i].body_b, d->joint[i].bx_m, d->joint[i].by_m);
    }
    *size_m = hypot(s.x1 - s.x0, s.y1 - s.y0);
    for (int b = 0; b < d->nbody; b++) {
        double lever = s.count[b] ? sqrt(c->lever[b] / s.count[b]) : 0;
        c->lever[b] = lever > SMALL * *size_m ? lever : *size_m;
    }
    return FW_OK;
}

/* Newton steps, each the shortest; *closed: they lead to poses that close */
static fw_status close_all(fw_arena *arena, closing *c, bool *closed) {
    double gap_m = 0, gap_rad = 0, size_m, *y;
    const row *worst;
    size_t n = 3 * (size_t)c->device->nbody;
    *closed = false;
    FW_TRY(set_levers(arena, c, &size_m));
    FW_NEED(y = fw_arena_array(arena, double, n));
    for (int round = 0; round < ROUNDS; round++) {
        list_rows(c, &gap_m, &gap_rad, &worst);
        if (round == 0 && gap_m > SMALL * size_m) return FW_OK;
        *closed = gap_m <= 1e-15 + 1e-13 * size_m && gap_rad <= 1e-13;
        if (*closed) break;
        FW_TRY(shortest(arena, c, y));
        for (size_t i = 0; i < n; i++)
            c->pose[i] += i % 3 == 2 ? y[i] / c->lever[i / 3] : y[i];
    }
    *closed = gap_m <= 1e-12 + 1e-12 * size_m && gap_rad <= 1e-11;
    return FW_OK;
}

static void tell(fw_device_reader *r, const row *worst, double gap_m, double gap_rad,
                 double moved_m, double turned_rad) {
    char gap[FW_LABEL], tilt[FW_LABEL], moved[FW_LABEL], turned[FW_LABEL];
    fw_diag_note(r->diags, 132, worst->place,
                 "the stated positions leave joints open by up to %s (%s) and %s, as rounded "
                 "numbers do; for drawing and motion alike, bodies are moved by up to %s and "
                 "turned by up to %s, the smallest change that closes all joints; write more "
                 "digits to avoid it",
                 fw_xml_in_unit(gap, gap_m, "nm"), worst->id ? worst->id : "",
                 fw_xml_in_unit(tilt, gap_rad, "deg"), fw_xml_in_unit(moved, moved_m, "nm"),
                 fw_xml_in_unit(turned, turned_rad, "deg"));
}

/* plates and what else is drawn in the world stays where it is written */
static void accept(fw_device_reader *r, const closing *c) {
    fw_device *d = r->device;
    fw_geometry_vec2 turning;
    d->rounded = true;
    for (int b = 0; b < d->nbody; b++) {
        if (!placed(d, b)) continue;
        d->body[b].x_m = c->pose[3 * b];
        d->body[b].y_m = c->pose[3 * b + 1];
        d->body[b].phi_rad = c->pose[3 * b + 2];
    }
    for (int j = 0; j < d->nrevolute; j++) {
        fw_device_revolute *t = &d->revolute[j];
        if (isnan(t->ax_m + t->ay_m) || !placed(d, t->body_a)) continue;
        fw_geometry_vec2 at = place_at(c, t->body_a, t->ax_m, t->ay_m, &turning);
        t->x_m = at.x;
        t->y_m = at.y;
    }
}

fw_status fw_device_close_rounded(fw_device_reader *r) {
    const fw_device *d = r->device;
    fw_mark mark = fw_arena_mark(r->arena);
    size_t n = 3 * (size_t)d->nbody, rows = 2 * (size_t)d->nrevolute + 3 * (size_t)d->njoint;
    closing c = {.device = d,
                 .row = fw_arena_array(r->arena, row, rows),
                 .pose = fw_arena_array(r->arena, double, n),
                 .lever = fw_arena_array(r->arena, double, (size_t)d->nbody)};
    if (!c.row || !c.pose || !c.lever) return FW_NOMEM;
    for (int b = 0; b < d->nbody; b++) {
        c.pose[3 * b] = d->body[b].x_m;
        c.pose[3 * b + 1] = d->body[b].y_m;
        c.pose[3 * b + 2] = d->body[b].phi_rad;
    }
    double gap_m, gap_rad, moved_m = 0, turned_rad = 0;
    const row *worst;
    row said = {0};
    bool closed = false;
    list_rows(&c, &gap_m, &gap_rad, &worst);
    bool open = gap_m > CLOSED_M || gap_rad > CLOSED_RAD;
    if (open && gap_m <= ROUNDED_M && gap_rad <= ROUNDED_RAD) {
        said = *worst;
        FW_TRY(close_all(r->arena, &c, &closed));
        for (int b = 0; closed && b < d->nbody; b++) {
            if (!placed(d, b)) continue;
            double turned = fabs(c.pose[3 * b + 2] - d->body[b].phi_rad);
            double moved =
                hypot(c.pose[3 * b] - d->body[b].x_m, c.pose[3 * b + 1] - d->body[b].y_m);
            turned_rad = fmax(turned_rad, turned);
            moved_m = fmax(moved_m, moved);
            closed = fmax(moved, turned * c.lever[b]) <= FARTHEST_M;
        }
        if (closed) accept(r, &c);
    }
    fw_arena_rewind(r->arena, mark); /* the message stays */
    if (closed) tell(r, &said, gap_m, gap_rad, moved_m, turned_rad);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- reference frames that move over their bodies ----
   p' = p - by for every point p of a body that the description states in its frame. A new element with a
   point on a body has its line here. */

typedef const fw_device_frame_move *moves;

/* a point of a body; the ground's are of the world */
static void restate(moves move, int body, double *x_m, double *y_m) {
    if (body == FW_GROUND) return;
    *x_m -= move[body].by.x;
    *y_m -= move[body].by.y;
}

static fw_status restate_shapes(fw_arena *arena, fw_device_body *body, fw_geometry_vec2 by) {
    fw_device_shape *shape;
    size_t n = (size_t)body->nshape;
    FW_NEED(shape = fw_arena_grow(arena, body->shape, n, n, sizeof *shape));
    for (int i = 0; i < body->nshape; i++) {
        const fw_geometry_pose back = {-by.x, -by.y, 0};
        shape[i].pose.x_m -= by.x;
        shape[i].pose.y_m -= by.y;
        FW_TRY(fw_geometry_contour_transform(arena, &body->shape[i].contour, back, false,
                                             &shape[i].contour));
    }
    body->shape = shape;
    return FW_OK;
}

static fw_status restate_bodies(fw_arena *arena, fw_device *d, moves move) {
    for (int b = 0; b < d->nbody; b++) {
        fw_device_body *body = &d->body[b];
        if (move[b].by.x == 0 && move[b].by.y == 0) continue;
        body->x_m = move[b].to.x, body->y_m = move[b].to.y;
        restate(move, b, &body->com_x_m, &body->com_y_m);
        if (body->nshape > 0) FW_TRY(restate_shapes(arena, body, move[b].by));
    }
    return FW_OK;
}

static void restate_joints(fw_device *d, moves move) {
    for (int i = 0; i < d->nrevolute; i++) {
        fw_device_revolute *j = &d->revolute[i];
        restate(move, j->body_a, &j->ax_m, &j->ay_m);
        restate(move, j->body_b, &j->bx_m, &j->by_m);
    }
    for (int i = 0; i < d->njoint; i++) {
        fw_device_joint *j = &d->joint[i];
        restate(move, j->body_a, &j->ax_m, &j->ay_m);
        restate(move, j->body_b, &j->bx_m, &j->by_m);
    }
    for (int i = 0; i < d->nspring; i++) {
        fw_device_spring *s = &d->spring[i];
        restate(move, s->body_a, &s->ax_m, &s->ay_m);
        restate(move, s->body_b, &s->bx_m, &s->by_m);
    }
}

static void restate_probes(fw_device *d, moves move) {
    for (int i = 0; i < d->nprobe; i++) {
        fw_device_probe *p = &d->probe[i];
        restate(move, p->body, &p->x_m, &p->y_m);
        restate(move, p->body_b, &p->bx_m, &p->by_m);
    }
}

/* forces, eyelets, electrodes, contacts of points and squeezed walls are at points of bodies;
   initial velocities are of centres of mass; friction and contacts of hinges are at joints; torques,
   base motion, gravity, temperature, stress and damping have no point; of parts without a struct x
   and y are one of the body they are on */
static void restate_scene(fw_device_scene *s, moves move) {
    for (int i = 0; i < s->nforce; i++)
        restate(move, s->force[i].body, &s->force[i].x_m, &s->force[i].y_m);
    for (int i = 0; i < s->ntendon; i++)
        for (int k = 0; k < s->tendon[i].neyelet; k++) {
            fw_device_eyelet *e = &s->tendon[i].eyelet[k];
            restate(move, e->body, &e->x_m, &e->y_m);
        }
    for (int i = 0; i < s->ncomb; i++)
        restate(move, s->comb[i].body_b, &s->comb[i].bx_m, &s->comb[i].by_m);
    for (int i = 0; i < s->ncontact; i++) {
        fw_device_contact_use *c = &s->contact[i];
        if (c->joint != FW_NONE) continue;
        restate(move, c->body_a, &c->ax_m, &c->ay_m);
        restate(move, c->body_b, &c->bx_m, &c->by_m);
    }
    for (int i = 0; i < s->nair; i++) {
        fw_device_air *a = &s->air[i];
        if (a->kind == FW_AIR_SQUEEZE) restate(move, a->body, &a->x_m, &a->y_m);
    }
    for (int i = 0; i < s->npart; i++) {
        const fw_device_scene_part *p = &s->part[i];
        for (int k = 0; k < p->count && p->body != FW_GROUND; k++) {
            if (strcmp(p->name[k], "x") == 0) p->number[k] -= move[p->body].by.x;
            if (strcmp(p->name[k], "y") == 0) p->number[k] -= move[p->body].by.y;
        }
    }
}

fw_status fw_device_move_frames(fw_arena *arena, const fw_device *device,
                                const fw_device_frame_move *move, const fw_device **moved) {
    size_t b = (size_t)device->nbody, r = (size_t)device->nrevolute, j = (size_t)device->njoint,
           p = (size_t)device->nspring, s = (size_t)device->nscene, q = (size_t)device->nprobe;
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    *d = *device;
    FW_NEED(d->body = fw_arena_grow(arena, d->body, b, b, sizeof *d->body));
    FW_NEED(d->revolute = fw_arena_grow(arena, d->revolute, r, r, sizeof *d->revolute));
    FW_NEED(d->joint = fw_arena_grow(arena, d->joint, j, j, sizeof *d->joint));
    FW_NEED(d->spring = fw_arena_grow(arena, d->spring, p, p, sizeof *d->spring));
    FW_NEED(d->scene = fw_arena_grow(arena, d->scene, s, s, sizeof *d->scene));
    FW_NEED(d->probe = fw_arena_grow(arena, d->probe, q, q, sizeof *d->probe));
    FW_TRY(restate_bodies(arena, d, move));
    restate_joints(d, move);
    restate_probes(d, move);
    for (int i = 0; i < d->nscene; i++) {
        FW_TRY(fw_device_own_scene(arena, &d->scene[i]));
        restate_scene(&d->scene[i], move);
    }
    *moved = d;
    return FW_OK;
}
