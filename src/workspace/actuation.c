/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a required pose asks of the six-bar: what holds it, and what acts besides. */
#include "workspace/pose_load.h"
#include <math.h>
#include <string.h>

/* ---- what holds a pose ---- */

/* What holds a required pose: the actuators of the flow's scenes, each with the size that the pose
   asks for; where they are fewer than three that are independent, the wrench on the platform
   supplies the rest. Three of them determine the joint forces; strain is convex in these, so that
   actuators that share the work strain no hinge more than the worst three alone. */

enum { GRID = 3 };
static const double dependent = 1e-6; /* three whose volume is nowhere more hold nothing */

typedef struct gathering {
    fw_arena *arena;
    const fw_mechanism *m;
    fw_workspace_actuator *to;
    int n, most;
} gathering;

static bool of_the_loop(int body) {
    return body == FW_GROUND || (body >= 0 && body < 5);
}

static const char *body_name(const gathering *g, int body) {
    return body == FW_GROUND ? "the ground" : g->m->body[body].id ? g->m->body[body].id : "?";
}

static bool same_points(const fw_workspace_actuator *a, const fw_workspace_actuator *b) {
    if (a->npoint != b->npoint) return false;
    for (int i = 0; i < a->npoint; i++)
        if (a->point[i].body != b->point[i].body || a->point[i].x_m != b->point[i].x_m ||
            a->point[i].y_m != b->point[i].y_m)
            return false;
    return true;
}

static bool parallel(const double p[2], const double q[2]) {
    return fabs(p[0] * q[1] - p[1] * q[0]) < 1e-12;
}

/* what acts alike is one actuator, whatever scenes name it: which */
static int keep(gathering *g, fw_workspace_actuator a) {
    for (int i = 0; i < g->n; i++) {
        fw_workspace_actuator *b = &g->to[i];
        if (a.kind != b->kind || a.body != b->body || a.against != b->against ||
            !parallel(a.direction, b->direction) || !same_points(&a, b))
            continue;
        double along = a.direction[0] * b->direction[0] + a.direction[1] * b->direction[1];
        b->pulls = b->pulls && a.pulls && (a.kind == FW_ACTUATOR_TENDON || along > 0.0);
        b->platform = b->platform || a.platform;
        return i;
    }
    g->to[g->n] = a; /* most_of leaves room */
    return g->n++;
}

static fw_workspace_body_point point_of(const gathering *g, int body, double x, double y) {
    fw_geometry_vec2 p = fw_mechanism_local_place(g->m, body, x, y);
    return (fw_workspace_body_point){body, p.x, p.y};
}

static fw_status one_force(gathering *g, const fw_device_force *f) {
    double size = hypot(f->fx_N, f->fy_N);
    if (!(size > 0.0) || f->body == FW_GROUND || !of_the_loop(f->body)) return FW_OK;
    fw_workspace_body_point *p;
    FW_NEED(p = fw_arena_one(g->arena, fw_workspace_body_point));
    *p = point_of(g, f->body, f->x_m, f->y_m);
    fw_workspace_actuator a = {.kind = FW_ACTUATOR_FORCE,
                               .body = f->body,
                               .against = FW_GROUND,
                               .direction = {f->fx_N / size, f->fy_N / size},
                               .point = p,
                               .npoint = 1};
    a.platform = f->body == 2 && f->x_m == 0.0 && f->y_m == 0.0;
    FW_NEED(a.id = fw_arena_printf(g->arena, "force on %s", body_name(g, f->body)));
    keep(g, a);
    return FW_OK;
}

static fw_status one_torque(gathering *g, int body) {
    if (body == FW_GROUND || !of_the_loop(body)) return FW_OK;
    fw_workspace_actuator a = {
        .kind = FW_ACTUATOR_TORQUE, .body = body, .against = FW_GROUND, .platform = body == 2};
    FW_NEED(a.id = fw_arena_printf(g->arena, "torque on %s", body_name(g, body)));
    keep(g, a);
    return FW_OK;
}

static fw_status one_tendon(gathering *g, const fw_device_tendon *t) {
    fw_workspace_body_point *p;
    bool any = false;
    FW_NEED(p = fw_arena_array(g->arena, fw_workspace_body_point, (size_t)t->neyelet));
    for (int i = 0; i < t->neyelet; i++) {
        const fw_device_eyelet *e = &t->eyelet[i];
        if (!of_the_loop(e->body)) return FW_OK; /* pulls what the loop carries, too */
        any = any || e->body != FW_GROUND;
        p[i] = point_of(g, e->body, e->x_m, e->y_m);
    }
    if (!any) return FW_OK;
    fw_workspace_actuator a = {.kind = FW_ACTUATOR_TENDON,
                               .body = FW_GROUND,
                               .against = FW_GROUND,
                               .point = p,
                               .npoint = t->neyelet,
                               .pulls = true};
    FW_NEED(a.id = fw_arena_printf(g->arena, "%s%s", FW_NAMED("tendon", t->id ? t->id : "?")));
    keep(g, a);
    return FW_OK;
}

static fw_status one_comb(gathering *g, const fw_device_comb *c) {
    if (!of_the_loop(c->body_a) || !of_the_loop(c->body_b) || c->body_b == FW_GROUND) return FW_OK;
    fw_workspace_body_point *p;
    FW_NEED(p = fw_arena_one(g->arena, fw_workspace_body_point));
    *p = point_of(g, c->body_b, c->bx_m, c->by_m);
    double turned = c->body_a == FW_GROUND ? 0.0 : g->m->body[c->body_a].phi_rad;
    double angle = c->direction_rad + turned; /* of a plate: from rotor to stator */
    fw_workspace_actuator a = {.kind = FW_ACTUATOR_ELECTRODES,
                               .body = c->body_b,
                               .against = c->body_a,
                               .direction = {cos(angle), sin(angle)},
                               .point = p,
                               .npoint = 1,
                               .pulls = true};
    FW_NEED(a.id = fw_arena_printf(g->arena, "electrodes %s", c->id ? c->id : "?"));
    keep(g, a);
    return FW_OK;
}

static fw_status of_scene(gathering *g, const fw_device_scene *s) {
    for (int i = 0; i < s->nforce; i++)
        FW_TRY(one_force(g, &s->force[i]));
    for (int i = 0; i < s->ntorque; i++)
        if (s->torque[i].value_Nm != 0.0) FW_TRY(one_torque(g, s->torque[i].body));
    for (int i = 0; i < s->ntendon; i++)
        FW_TRY(one_tendon(g, &s->tendon[i]));
    for (int i = 0; i < s->ncomb; i++)
        FW_TRY(one_comb(g, &s->comb[i]));
    return FW_OK;
}

/* ---- what is given ---- */

/* bodies of the loop and what rides on them: of which body of the loop; FW_NONE: on none */
static fw_status carriers(fw_arena *arena, const fw_mechanism *m, int **on) {
    FW_NEED(*on = fw_arena_array(arena, int, (size_t)m->nbody));
    for (int i = 0; i < m->nbody; i++)
        (*on)[i] = i < 5 ? i : FW_NONE;
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < m->npin + m->njoint; i++) {
            bool pin = i < m->npin;
            int a = pin ? m->pin[i].body_a : m->joint[i - m->npin].body_a;
            int b = pin ? m->pin[i].body_b : m->joint[i - m->npin].body_b;
            if (a == FW_GROUND || b == FW_GROUND || ((*on)[a] == FW_NONE) == ((*on)[b] == FW_NONE))
                continue;
            more = true;
            (*on)[(*on)[a] == FW_NONE ? a : b] = (*on)[(*on)[a] == FW_NONE ? b : a];
        }
    }
    return FW_OK;
}

typedef struct giving {
    gathering in;
    const int *on; /* (nbody) carriers */
    fw_workspace_given *to;
    int n;
    const char *by, *unknown;
} giving;

/* between a point of each body; `face`: along that normal of body a, from its point to the other's */
static fw_status between(giving *g, const fw_workspace_body_point ends[2], const double *face,
                         fw_workspace_given as) {
    fw_workspace_body_point *p;
    FW_NEED(p = fw_arena_array(g->in.arena, fw_workspace_body_point, 2));
    memcpy(p, ends, 2 * sizeof *p);
    as.by.kind = face ? FW_ACTUATOR_ELECTRODES : FW_ACTUATOR_TENDON;
    as.by.point = face ? p + 1 : p, as.by.npoint = face ? 1 : 2;
    as.by.body = face ? p[1].body : FW_GROUND, as.by.against = face ? p[0].body : FW_GROUND;
    if (face) {
        /* pushes along the normal by what the way along it is too short */
        as.from = p[0];
        as.by.direction[0] = face[0], as.by.direction[1] = face[1];
        as.stiffness_N_per_m = -as.stiffness_N_per_m, as.sense = FW_WHERE_LONGER;
    }
    g->to[g->n++] = as;
    return FW_OK;
}

static fw_status named(giving *g, const char *what) {
    FW_NEED(what);
    if (!g->by)
        g->by = what;
    else
        FW_NEED(g->by = fw_arena_printf(g->in.arena, "%s, %s", g->by, what));
    return FW_OK;
}

static fw_status one_spring(giving *g, const fw_device_spring *s) {
    const int a = s->body_a, b = s->body_b;
    const int on_a = a == FW_GROUND ? FW_NONE : g->on[a],
              on_b = b == FW_GROUND ? FW_NONE : g->on[b];
    if (!(s->stiffness_N_per_m > 0) || (on_a == FW_NONE && on_b == FW_NONE)) return FW_OK;
    const char *what =
        fw_arena_printf(g->in.arena, "%s%s", FW_NAMED("spring", s->id ? s->id : "?"));
    FW_NEED(what);
    if (!of_the_loop(a) || !of_the_loop(b)) {
        g->unknown = what;
        return FW_OK;
    }
    FW_TRY(named(g, what));
    const fw_workspace_body_point ends[2] = {point_of(&g->in, a, s->ax_m, s->ay_m),
                                             point_of(&g->in, b, s->bx_m, s->by_m)};
    return between(g, ends, NULL,
                   (fw_workspace_given){.stiffness_N_per_m = s->stiffness_N_per_m,
                                        .length_m = s->length_m,
                                        .sense = s->cable ? FW_WHERE_LONGER : FW_BOTH_WAYS});
}

static bool touches_loop(const fw_device_contact_use *c) {
    return c->joint == FW_NONE && of_the_loop(c->body_a) && of_the_loop(c->body_b) &&
           c->body_a != c->body_b;
}

static fw_status one_contact(giving *g, const fw_device_contact_use *c) {
    if (!touches_loop(c)) return FW_OK;
    FW_TRY(
        named(g, fw_arena_printf(g->in.arena, "%s%s", FW_NAMED("contact", c->id ? c->id : "?"))));
    const double turned = c->body_a == FW_GROUND ? 0 : g->in.m->body[c->body_a].phi_rad;
    const double face[2] = {cos(c->face_rad + turned), sin(c->face_rad + turned)};
    const fw_workspace_body_point ends[2] = {point_of(&g->in, c->body_a, c->ax_m, c->ay_m),
                                             point_of(&g->in, c->body_b, c->bx_m, c->by_m)};
    return between(g, ends, c->face ? face : NULL,
                   (fw_workspace_given){.stiffness_N_per_m = c->stiffness_N_per_m,
                                        .length_m = c->distance_m,
                                        .sense = c->side == FW_CONTACT_INSIDE ? FW_WHERE_LONGER
                                                                              : FW_WHERE_SHORTER});
}

/* What rides on a body is in equilibrium there, so that its weight acts on that body at its own place, as drawn. */
static fw_status weights(giving *g, const fw_device_scene *s) {
    const fw_mechanism *m = g->in.m;
    const double field = hypot(s->gx_m_per_s2, s->gy_m_per_s2);
    FW_TRY(named(g, fw_arena_printf(g->in.arena, "the weight in scene %s", s->name)));
    for (int i = 0; i < m->nbody; i++) {
        fw_workspace_body_point *p;
        if (g->on[i] == FW_NONE) continue;
        FW_NEED(p = fw_arena_one(g->in.arena, fw_workspace_body_point));
        *p = point_of(&g->in, i, 0, 0), p->body = g->on[i];
        g->to[g->n++] = (fw_workspace_given){
            .by = {.kind = FW_ACTUATOR_FORCE,
                   .body = p->body,
                   .against = FW_GROUND,
                   .direction = {s->gx_m_per_s2 / field, s->gy_m_per_s2 / field},
                   .point = p,
                   .npoint = 1},
            .size_N = m->body[i].mass_kg * field};
    }
    return FW_OK;
}

/* ---- friction ---- */

/* of the hinge's convex conjugate surface; NaN: there is none */
static double surface_of(const fw_mechanism *m, int pin) {
    for (int i = 0; i < m->nhinge; i++)
        if (m->hinge[i].pin == pin && m->hinge[i].surface_radius_m > 0)
            return m->hinge[i].surface_radius_m;
    return (double)NAN;
}

/* largest coefficient times radius, of a hinge of the six-bar; 0: it does not rub. Where that is not known the scene
   itself is refused (FW-D245). */
static double arm_of_friction(const fw_mechanism *m, const fw_device_friction_use *u) {
    if (u->revolute < 0 || u->revolute >= FW_SIX || u->revolute >= m->npin) return 0;
    const double mu = fmax(u->coefficient, u->static_coefficient); /* passes by NaN */
    const double radius = isnan(u->radius_m) ? surface_of(m, u->revolute) : u->radius_m;
    return mu > 0 && radius > 0 ? mu * radius : 0;
}

static fw_status frictions(giving *g, const fw_device_scene *s, fw_workspace_hold *hold) {
    const char *who = NULL;
    int n = 0;
    for (int i = 0; i < s->nfriction; i++) {
        const fw_device_friction_use *u = &s->friction[i];
        const double arm = arm_of_friction(g->in.m, u);
        const char *id = arm > 0 ? g->in.m->pin[u->revolute].id : NULL;
        if (!(arm > 0)) continue;
        hold->rubs = true;
        hold->rub_arm_m[u->revolute] = arm, hold->rub_preload_N[u->revolute] = u->preload_N;
        FW_NEED(who = fw_arena_printf(g->in.arena, "%s%s%s", who ? who : "", who ? ", " : "",
                                      id ? id : "?"));
        n++;
    }
    return n > 0 ? named(g, fw_arena_printf(g->in.arena, "friction of hinge%s %s in scene %s",
                                            n > 1 ? "s" : "", who, s->name))
                 : FW_OK;
}

static bool heavy(const fw_device_scene *s) {
    return s->gravity && (s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0);
}

bool fw_workspace_scene_gives(const fw_mechanism *m, const fw_device_scene *s) {
    bool any = heavy(s);
    for (int i = 0; i < s->ncontact && !any; i++)
        any = touches_loop(&s->contact[i]);
    for (int i = 0; i < s->nfriction && !any; i++)
        any = arm_of_friction(m, &s->friction[i]) > 0;
    return any;
}

fw_status fw_workspace_hold_given(fw_arena *arena, const fw_mechanism *m,
                                  const fw_device_scene *scene, fw_workspace_hold *hold) {
    if (m->nspring == 0 && !scene) return FW_OK;
    giving g = {.in = {.arena = arena, .m = m}};
    int *on;
    size_t most = (size_t)m->nspring + (size_t)m->nbody + (size_t)(scene ? scene->ncontact : 0);
    FW_NEED(g.to = fw_arena_array(arena, fw_workspace_given, most));
    FW_TRY(carriers(arena, m, &on));
    g.on = on;
    for (int i = 0; i < m->nspring; i++)
        FW_TRY(one_spring(&g, &m->spring[i]));
    if (scene && heavy(scene)) FW_TRY(weights(&g, scene));
    for (int i = 0; scene && i < scene->ncontact; i++)
        FW_TRY(one_contact(&g, &scene->contact[i]));
    if (scene) FW_TRY(frictions(&g, scene, hold));
    hold->given = g.to, hold->ngiven = g.n, hold->given_by = g.by, hold->unknown = g.unknown;
    return FW_OK;
}

/* ---- three of them ---- */

typedef struct choosing {
    fw_workspace_hold *hold;
    fw_workspace_response *response; /* (poses x nactuator) */
    int poses;
    fw_workspace_grip *grip;
    int ngrip, most;
} choosing;

static void wrench_of(const fw_workspace_response *r, double w[3]) {
    double n = 0.0;
    for (int i = 0; i < 3; i++)
        w[i] = r->wrench[i].v.m, n += w[i] * w[i];
    for (int i = 0; i < 3; i++)
        w[i] /= n > 0.0 ? sqrt(n) : 1.0;
}

static double volume(const choosing *c, int pose, const int which[3]) {
    double w[3][3];
    for (int j = 0; j < 3; j++)
        wrench_of(&c->response[pose * c->hold->nactuator + which[j]], w[j]);
    return w[0][0] * (w[1][1] * w[2][2] - w[1][2] * w[2][1]) +
           w[0][1] * (w[1][2] * w[2][0] - w[1][0] * w[2][2]) +
           w[0][2] * (w[1][0] * w[2][1] - w[1][1] * w[2][0]);
}

/* how well three hold the box: the least volume of their wrenches at the poses that were looked at, 0 where its sign
   changes; NaN: not known. *most: the largest */
static double hold_of(const choosing *c, const int which[3], double *most) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int p = 0; p < c->poses; p++) {
        double v = volume(c, p, which);
        if (isnan(v)) return *most = v;
        low = fmin(low, v), high = fmax(high, v);
    }
    *most = fmax(fabs(low), fabs(high));
    return fmax(fmax(low, -high), 0);
}

static bool holds(const choosing *c, const int which[3]) {
    double most;
    return hold_of(c, which, &most) > FW_WORKSPACE_HOLDS_WELL;
}

static bool on_platform(const choosing *c, int i) {
    return c->hold->actuator[i].platform;
}

/* components of the platform's wrench that span the same are the same: a key of their span */
static void span_of(const choosing *c, const int which[3], long *others, double key[3]) {
    double w[3][3];
    int n = 0;
    *others = 0;
    key[0] = key[1] = key[2] = 0.0;
    for (int j = 0; j < 3; j++)
        if (on_platform(c, which[j]))
            wrench_of(&c->response[which[j]], w[n++]);
        else
            *others = *others * 4096 + which[j] + 1;
    if (n == 1) memcpy(key, w[0], sizeof w[0]);
    for (int i = 0; i < 3 && n == 2; i++)
        key[i] = w[0][(i + 1) % 3] * w[1][(i + 2) % 3] - w[0][(i + 2) % 3] * w[1][(i + 1) % 3];
    double size = sqrt(key[0] * key[0] + key[1] * key[1] + key[2] * key[2]);
    for (int i = 0; i < 3 && size > 0.0; i++)
        key[i] /= size;
}

static bool same_grip(const choosing *c, const int p[3], const int q[3]) {
    long of_p, of_q;
    double k[3], l[3], dot = 0.0;
    span_of(c, p, &of_p, k), span_of(c, q, &of_q, l);
    for (int i = 0; i < 3; i++)
        dot += k[i] * l[i];
    bool all_platform = of_p == 0 && of_q == 0;
    return of_p == of_q &&
           (all_platform || fabs(dot) > 1.0 - 1e-12 || (k[0] == 0.0 && k[1] == 0.0 && k[2] == 0.0));
}

static fw_status add_grip(fw_arena *arena, choosing *c, const int which[3]) {
    const fw_workspace_actuator *a = c->hold->actuator;
    for (int i = 0; i < c->ngrip; i++)
        if (same_grip(c, c->grip[i].actuator, which)) return FW_OK;
    if (c->ngrip == c->most) return FW_OK;
    fw_workspace_grip *to = &c->grip[c->ngrip++];
    memcpy(to->actuator, which, sizeof to->actuator);
    to->wrench = on_platform(c, which[0]) && on_platform(c, which[1]) && on_platform(c, which[2]);
    FW_NEED(to->name = to->wrench ? "wrench on the platform"
                                  : fw_arena_printf(arena, "%s, %s, %s", a[which[0]].id,
                                                    a[which[1]].id, a[which[2]].id));
    return FW_OK;
}

static fw_status respond_on_grid(fw_arena *arena, choosing *c, const fw_workspace_box3 *box) {
    int n = c->hold->nactuator;
    FW_NEED(c->response = fw_arena_array(arena, fw_workspace_response, (size_t)(27 * n)));
    c->poses = 0;
    for (int i = 0; i < 27; i++) {
        const int step[3] = {i == 0 ? 1 : i % 3, i == 0 ? 1 : i / 3 % 3, i == 0 ? 1 : i / 9};
        fw_workspace_box3 at;
        fw_workspace_pose_load load;
        for (int k = 0; k < 3; k++)
            at.lo[k] = at.hi[k] =
                step[k] == 2 ? box->hi[k] : box->lo[k] + 0.5 * step[k] * (box->hi[k] - box->lo[k]);
        if (!fw_workspace_poses_find(c->hold, &at, &load)) continue;
        for (int k = 0; k < n; k++)
            fw_workspace_pose_response(c->hold, &load, &c->hold->actuator[k],
                                       &c->response[c->poses * n + k]);
        c->poses++;
    }
    return FW_OK;
}

/* The grips among n actuators. Where none of those that are independent holds all of the box, *best of them, by[3], holds
   it least badly; below 0: none is independent. */
static fw_status every_three(fw_arena *arena, choosing *c, int n, double *best, int by[3]) {
    double most;
    *best = -1;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++) {
                const int which[3] = {i, j, k};
                double now = hold_of(c, which, &most);
                if (now > FW_WORKSPACE_HOLDS_WELL) FW_TRY(add_grip(arena, c, which));
                if (most > dependent && now > *best) *best = now, memcpy(by, which, sizeof which);
            }
    return FW_OK;
}

/* The scenes' own actuators. What holds the box badly may be what moves the device there, and what it must give then has
   no bound. */
static fw_status own_grips(fw_arena *arena, choosing *c, int n) {
    fw_workspace_hold *hold = c->hold;
    const fw_workspace_actuator *a = hold->actuator;
    double best;
    int by[3];
    FW_TRY(every_three(arena, c, n, &best, by));
    if (c->ngrip > 0 || best < 0) return FW_OK;
    hold->badly = best;
    FW_NEED(hold->badly_by =
                fw_arena_printf(arena, "%s, %s, %s", a[by[0]].id, a[by[1]].id, a[by[2]].id));
    return FW_OK;
}

static const int usual[3][3] = {{0, 4, 2}, {0, 4, 1}, {0, 4, 3}}; /* bodies that torques act on */

/* actuators of the scenes; where no scene has any, torques on the links */
static fw_status gather(gathering *g) {
    const fw_mechanism *m = g->m;
    for (int i = 0; i < m->device->nscene; i++)
        if (fw_device_in_flow(m->device->scene[i].flow, m->variant->flow))
            FW_TRY(of_scene(g, &m->device->scene[i]));
    return FW_OK;
}

/* which: its forces along x and y. A scene may have one of them that is not so to the last digit */
static fw_status platform_wrench(gathering *g, const fw_geometry_vec2 *centre, int which[2]) {
    fw_workspace_body_point *p;
    FW_NEED(p = fw_arena_one(g->arena, fw_workspace_body_point));
    *p = (fw_workspace_body_point){2, centre->x, centre->y};
    for (int i = 0; i < 2; i++)
        which[i] = keep(g, (fw_workspace_actuator){.kind = FW_ACTUATOR_FORCE,
                                                   .body = 2,
                                                   .against = FW_GROUND,
                                                   .direction = {i == 0, i == 1},
                                                   .point = p,
                                                   .npoint = 1,
                                                   .platform = true,
                                                   .id = i ? "force on the platform along y"
                                                           : "force on the platform along x"});
    return one_torque(g, 2);
}

static int of_body(const fw_workspace_hold *hold, int body) {
    for (int i = 0; i < hold->nactuator; i++)
        if (hold->actuator[i].kind == FW_ACTUATOR_TORQUE && hold->actuator[i].body == body)
            return i;
    return FW_NONE;
}

static int most_of(const fw_device *d) {
    int n = 8;
    for (int i = 0; i < d->nscene; i++)
        n += d->scene[i].nforce + d->scene[i].ntorque + d->scene[i].ntendon + d->scene[i].ncomb;
    return n;
}

/* those that hold the box among the scenes' own; else with what the platform supplies */
static fw_status choose(fw_arena *arena, gathering *g, choosing *c, const fw_workspace_box3 *box) {
    fw_workspace_hold *hold = c->hold;
    bool none = g->n == 0, one_way = false;
    hold->nactuator = g->n;
    for (int i = 0; i < g->n; i++)
        one_way = one_way || g->to[i].pulls;
    if (g->n >= 3) {
        FW_TRY(respond_on_grid(arena, c, box));
        FW_TRY(own_grips(arena, c, g->n));
        if (c->ngrip > 0 && !one_way) return FW_OK;
    }
    int wrench[3];
    FW_TRY(platform_wrench(g, &hold->loop->centre, wrench));
    for (int k = 0; k < 3 && none; k++)
        for (int j = 0; j < 3; j++)
            FW_TRY(one_torque(g, usual[k][j]));
    hold->nactuator = g->n;
    FW_TRY(respond_on_grid(arena, c, box));
    bool own = c->ngrip > 0;
    wrench[2] = of_body(hold, 2);
    FW_TRY(add_grip(arena, c, wrench)); /* the first one: of equals it is named */
    double best;
    int by[3];
    if (!none) return own ? FW_OK : every_three(arena, c, g->n, &best, by);
    for (int k = 0; k < 3; k++) {
        const int which[3] = {of_body(hold, usual[k][0]), of_body(hold, usual[k][1]),
                              of_body(hold, usual[k][2])};
        if (holds(c, which)) FW_TRY(add_grip(arena, c, which));
    }
    return FW_OK;
}

fw_status fw_workspace_hold_of(fw_arena *arena, const fw_mechanism *m,
                               const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                               fw_workspace_poses *poses, fw_workspace_hold *hold) {
    *hold = (fw_workspace_hold){.loop = loop, .poses = poses};
    FW_TRY(fw_workspace_sections(arena, m, hold->section));
    if (poses) fw_workspace_poses_are_of(poses, hold, false);
    fw_geometry_vec2 p[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        p[i] = fw_mechanism_pin_place(m, &m->pin[i], 0);
    hold->at[0] = hold->at[1] = p[1], hold->at[3] = hold->at[4] = p[4];
    hold->at[2] = loop->centre;
    hold->length_m = hypot(p[3].x - p[2].x, p[3].y - p[2].y);
    gathering g = {.arena = arena, .m = m, .most = most_of(m->device)};
    FW_NEED(g.to = fw_arena_array(arena, fw_workspace_actuator, (size_t)g.most));
    FW_TRY(gather(&g));
    hold->actuator = g.to;
    choosing c = {.hold = hold};
    c.most = (g.most + 3) * (g.most + 2) * (g.most + 1) / 6 + 8;
    FW_NEED(c.grip = fw_arena_array(arena, fw_workspace_grip, (size_t)c.most));
    FW_TRY(choose(arena, &g, &c, box));
    hold->nactuator = g.n;
    hold->grip = c.grip, hold->ngrip = c.ngrip;
    if (poses) fw_workspace_poses_are_of(poses, hold, true);
    return FW_OK;
}
