/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What drift and give of all hinges add to the proved strain or take away. Corners and worst poses are
   solved with hinges that give: the platform stands still, the four links have three unknowns each,
   three actuators have their sizes, P is what is given (springs, weight, contacts),

     sum of the hinges' forces on body k + sum s_j G_j(k) + P(k) = 0,   k = 1..5

   by Newton's method from the pose with pins, else along the way to it from the drawn one. Hinges
   have the law of finite_force.c, its own frame half turned, strains are those of strip_strain.c.
   in: m, rad, N; out: relative. Error: law 1 % of the strain, poses that were not looked at by what
   the proved bound with pins has over those that were. Cost 40 us a pose and grip. Source:
   docs/theory/workspace.md. Test: test_pose_strain.c. */
#include "effects/effects.h"
#include "maths/matrix.h"
#include "workspace/pose_load.h"
#include "workspace/workspace.h"
#include <math.h>
#include <string.h>

enum {
    LINKS = 5,
    PLATFORM = 2,
    UNKNOWN = 15,
    CORNERS = 8,
    ROUNDS = 30,
    STEPS = 8,
    MOST_GRIPS = 64,
    STANCES = 128
};

/* relative: of the strain by the hinges' law */
static const double law_error = 0.01;

/* ---- hinges that give ---- */

typedef struct limber {
    const fw_workspace_hold *hold;
    const fw_mechanism *m;
    const fw_mechanism_hinge *hinge[FW_SIX]; /* NULL: an ideal pin */
    fw_flexure_hinge_rest rest[FW_SIX];
    fw_geometry_vec2 pin[FW_SIX]; /* as drawn, world */
    double moment_Nm, force_N;    /* units of rows and sizes */
    double stiff_N_per_m;         /* of a pin */
} limber;

typedef struct standing {
    double body[LINKS][3]; /* displacement of hold->at (m) and rotation (rad), from the drawing */
    double size[3];        /* of the actuators, in their units times force_N */
    int sign[FW_SIX];      /* with which hinges rub */
} standing;

typedef struct loads {
    double on[LINKS][3]; /* N, N, N m about the body's displaced point */
} loads;

static fw_geometry_vec2 place(const limber *l, const standing *s, int body, fw_geometry_vec2 p) {
    if (body < 0 || body >= LINKS) return fw_workspace_on_ground(l->hold, p.x, p.y);
    const double *q = s->body[body], c = cos(q[2]), n = sin(q[2]);
    fw_geometry_vec2 at = l->hold->at[body];
    double x = p.x - at.x, y = p.y - at.y;
    return (fw_geometry_vec2){at.x + q[0] + c * x - n * y, at.y + q[1] + n * x + c * y};
}

static double turn(const standing *s, int body) {
    return body < 0 || body >= LINKS ? 0.0 : s->body[body][2];
}

static void add(const limber *l, const standing *s, int body, fw_geometry_vec2 at, double fx,
                double fy, double couple, loads *to) {
    if (body < 0 || body >= LINKS) return;
    const double *q = s->body[body];
    double x = at.x - l->hold->at[body].x - q[0], y = at.y - l->hold->at[body].y - q[1];
    to->on[body][0] += fx, to->on[body][1] += fy, to->on[body][2] += couple + x * fy - y * fx;
}

typedef struct opened { /* a hinge between its bodies: rotation, e.D and n.D, frame half turned */
    double o, th, w, v, c, n;
    fw_geometry_vec2 from, to;
} opened;

static opened open_of(const limber *l, const standing *s, int i) {
    const fw_mechanism_hinge *h = l->hinge[i];
    double lower = turn(s, i - 1), upper = turn(s, i);
    opened b = {.o = !h || h->first_is_a ? 1.0 : -1.0,
                .th = upper - lower + l->hold->loop->start_rad[i],
                .from = place(l, s, i - 1, l->pin[i]),
                .to = place(l, s, i, l->pin[i])};
    double psi = (h ? h->axis_rad : 0.0) + 0.5 * (lower + upper);
    double dx = b.to.x - b.from.x, dy = b.to.y - b.from.y;
    b.c = cos(psi), b.n = sin(psi);
    b.w = b.c * dx + b.n * dy, b.v = b.c * dy - b.n * dx;
    return b;
}

/* of an ideal pin: its spring, and a far stiffer one against displacements */
static void law_of(const limber *l, int i, const opened *b, bool hessian,
                   fw_flexure_hinge_bent *law) {
    const double at[3] = {b->o * b->th, b->o * b->w, b->o * b->v};
    if (l->hinge[i]) {
        fw_flexure_hinge_law_bend(&l->hinge[i]->law, &l->rest[i], at, hessian, law);
        return;
    }
    *law = (fw_flexure_hinge_bent){.holds = true};
    for (int k = 0; k < 3; k++) {
        double stiff = k ? l->stiff_N_per_m : l->hold->section[i].spring_Nm_per_rad;
        law->hessian[k][k] = stiff, law->gradient[k] = stiff * at[k];
    }
}

/* first unknown of a body; the platform and the ground have none */
static int first_of(int body) {
    return body < 0 || body >= LINKS || body == PLATFORM ? FW_NONE
                                                         : 3 * (body < PLATFORM ? body : body - 1);
}

/* adds d load/d unknown, row of a body's component, column of another's, to a (UNKNOWN x UNKNOWN) in SI */
static void put(double *a, int body, int row, int column_of, int column, double value) {
    int first = first_of(column_of);
    if (first != FW_NONE && body >= 0 && body < LINKS)
        a[UNKNOWN * (3 * body + row) + first + column] += value;
}

/* What a hinge does to its bodies (hinge_element.c), and how that goes with their places. With w = e.D, v = n.D
   and p the places and turns of both pins, load = -G, G = J' (M, X, Y), dG/dp = J' H J + X d2w + Y d2v. */
static void of_hinge(const limber *l, const standing *s, int i, loads *to, double *a) {
    const opened b = open_of(l, s, i);
    fw_flexure_hinge_bent law;
    law_of(l, i, &b, a != NULL, &law);
    double M = b.o * law.gradient[0], X = b.o * law.gradient[1], Y = b.o * law.gradient[2];
    double fx = X * b.c - Y * b.n, fy = X * b.n + Y * b.c, both = 0.5 * (Y * b.w - X * b.v);
    /* friction presses on both bodies alike, as the joint's force tells; its slope by that is left out */
    const double rub = s->sign[i] * l->hold->rub_arm_m[i] *
                       (l->hold->rub_preload_N[i] + (s->sign[i] ? hypot(X, Y) : 0));
    add(l, s, i - 1, b.from, fx, fy, both + M + rub, to);
    add(l, s, i, b.to, -fx, -fy, both - M - rub, to);
    if (!a) return;
    const double J[3][6] = {{0, 0, -1, 0, 0, 1},
                            {-b.c, -b.n, 0.5 * b.v, b.c, b.n, 0.5 * b.v},
                            {b.n, -b.c, -0.5 * b.w, -b.n, b.c, -0.5 * b.w}};
    const double *H = &law.hessian[0][0];
    double K[6][6] = {{0}}, arm[2][2] = {{0}};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (int p = 0; p < 6; p++)
                for (int q = 0; q < 6 && J[r][p] != 0; q++)
                    K[p][q] += J[r][p] * H[3 * r + c] * J[c][q];
    /* along e and n the force (fx, fy) stays while they turn: by half of either body's turn */
    const double turned[4] = {0.5 * fy, -0.5 * fx, -0.5 * fy, 0.5 * fx}; /* d G/d turn of places */
    static const int place_row[4] = {0, 1, 3, 4}, turn_row[2] = {2, 5};
    for (int t = 0; t < 2; t++) {
        for (int p = 0; p < 4; p++)
            K[place_row[p]][turn_row[t]] += turned[p], K[turn_row[t]][place_row[p]] += turned[p];
        for (int u = 0; u < 2; u++)
            K[turn_row[t]][turn_row[u]] -= 0.25 * (X * b.w + Y * b.v);
    }
    const int body[2] = {i - 1, i};
    const fw_geometry_vec2 at[2] = {b.from, b.to};
    for (int side = 0; side < 2; side++)
        if (body[side] >= 0 && body[side] < LINKS) {
            arm[side][0] = at[side].x - l->hold->at[body[side]].x - s->body[body[side]][0];
            arm[side][1] = at[side].y - l->hold->at[body[side]].y - s->body[body[side]][1];
        }
    for (int p = 0; p < 6; p++) /* columns, then rows: from pins to bodies */
        for (int q = 0; q < 2; q++)
            K[p][3 * q + 2] += arm[q][0] * K[p][3 * q + 1] - arm[q][1] * K[p][3 * q];
    for (int p = 0; p < 6; p++)
        for (int q = 0; q < 2; q++)
            K[3 * q + 2][p] += arm[q][0] * K[3 * q + 1][p] - arm[q][1] * K[3 * q][p];
    for (int q = 0; q < 2; q++) /* the arms turn, too; G is minus the force on either pin */
        K[3 * q + 2][3 * q + 2] += (q ? -1 : 1) * (arm[q][0] * fx + arm[q][1] * fy);
    for (int p = 0; p < 6; p++)
        for (int q = 0; q < 6; q++)
            put(a, body[p / 3], p % 3, body[q / 3], q % 3, -K[p][q]);
}

static fw_geometry_vec2 point(const limber *l, const standing *s,
                              const fw_workspace_body_point *p) {
    return place(l, s, p->body, (fw_geometry_vec2){p->x_m, p->y_m});
}

/* an actuator of size 1, times `by` */
static void of_actuator(const limber *l, const standing *s, const fw_workspace_actuator *a,
                        double by, loads *to) {
    double c = a->kind == FW_ACTUATOR_ELECTRODES ? cos(turn(s, a->against)) : 1.0;
    double n = a->kind == FW_ACTUATOR_ELECTRODES ? sin(turn(s, a->against)) : 0.0;
    double fx = by * (c * a->direction[0] - n * a->direction[1]);
    double fy = by * (n * a->direction[0] + c * a->direction[1]);
    switch (a->kind) {
    case FW_ACTUATOR_TORQUE:
        to->on[a->body][2] += by * l->hold->length_m;
        break;
    case FW_ACTUATOR_FORCE:
    case FW_ACTUATOR_ELECTRODES:
        add(l, s, a->body, point(l, s, a->point), fx, fy, 0.0, to);
        add(l, s, a->against, point(l, s, a->point), -fx, -fy, 0.0, to);
        break;
    case FW_ACTUATOR_TENDON:
        for (int i = 0; i + 1 < a->npoint; i++) {
            const fw_workspace_body_point *p = &a->point[i], *q = p + 1;
            fw_geometry_vec2 from = point(l, s, p), on = point(l, s, q);
            double x = on.x - from.x, y = on.y - from.y, way = hypot(x, y);
            if (p->body == q->body || !(way > 0.0)) continue;
            add(l, s, p->body, from, by * x / way, by * y / way, 0.0, to);
            add(l, s, q->body, on, -by * x / way, -by * y / way, 0.0, to);
        }
        break;
    }
}

/* unknown k: of which body; the platform has none */
static int body_of(int k) {
    return k / 3 < PLATFORM ? k / 3 : k / 3 + 1;
}

static double row_unit(const limber *l, int row) {
    return row % 3 == 2 ? l->moment_Nm : l->force_N;
}

/* how an actuator's load goes with the places of the links: a force's arm turns, of others by differences */
static void actuator_slopes(const limber *l, const standing *s, const fw_workspace_actuator *act,
                            double size, double *a) {
    const double step = 1e-7;
    bool many = act->kind == FW_ACTUATOR_TENDON || act->kind == FW_ACTUATOR_ELECTRODES;
    if (act->kind == FW_ACTUATOR_FORCE && act->body != PLATFORM) {
        fw_geometry_vec2 at = point(l, s, act->point), from = l->hold->at[act->body];
        const double *q = s->body[act->body];
        double x = at.x - from.x - q[0], y = at.y - from.y - q[1];
        put(a, act->body, 2, act->body, 2, -size * (y * act->direction[1] + x * act->direction[0]));
    }
    loads near = {0};
    if (many) of_actuator(l, s, act, size, &near);
    for (int k = 0; many && k < 12; k++) {
        standing moved = *s;
        loads far = {0};
        double by = step * (k % 3 == 2 ? 1.0 : l->hold->length_m);
        moved.body[body_of(k)][k % 3] += by;
        of_actuator(l, &moved, act, size, &far);
        for (int i = 0; i < UNKNOWN; i++)
            a[UNKNOWN * i + k] += (far.on[i / 3][i % 3] - near.on[i / 3][i % 3]) / by;
    }
}

static void of_given(const limber *l, const standing *s, loads *to) {
    for (int k = 0; k < l->hold->ngiven; k++) {
        const fw_workspace_given *g = &l->hold->given[k];
        const fw_workspace_actuator *by = &g->by;
        double way = 0;
        if (by->kind == FW_ACTUATOR_TENDON) {
            fw_geometry_vec2 p = point(l, s, &by->point[0]), q = point(l, s, &by->point[1]);
            way = hypot(q.x - p.x, q.y - p.y);
        } else if (by->kind == FW_ACTUATOR_ELECTRODES) {
            fw_geometry_vec2 p = point(l, s, &g->from), q = point(l, s, by->point);
            double c = cos(turn(s, by->against)), n = sin(turn(s, by->against));
            way = (c * by->direction[0] - n * by->direction[1]) * (q.x - p.x) +
                  (n * by->direction[0] + c * by->direction[1]) * (q.y - p.y);
        }
        of_actuator(l, s, by, fw_workspace_given_size(g, way), to);
    }
}

/* and how it goes with the places of the links, by differences */
static void given_slopes(const limber *l, const standing *s, const loads *near, double *a) {
    const double step = 1e-7;
    for (int k = 0; k < 12; k++) {
        standing moved = *s;
        loads far = {0};
        double by = step * (k % 3 == 2 ? 1.0 : l->hold->length_m);
        moved.body[body_of(k)][k % 3] += by;
        of_given(l, &moved, &far);
        for (int i = 0; i < UNKNOWN; i++)
            a[UNKNOWN * i + k] += (far.on[i / 3][i % 3] - near->on[i / 3][i % 3]) / by;
    }
}

/* loads on the bodies and their slopes by the unknowns, in units of rows and columns */
static void all(const limber *l, const standing *s, const fw_workspace_grip *grip, double *r,
                double *a) {
    loads sum = {0};
    memset(a, 0, UNKNOWN * UNKNOWN * sizeof *a);
    if (l->hold->ngiven > 0) {
        of_given(l, s, &sum);
        given_slopes(l, s, &sum, a);
    }
    for (int i = 0; i < FW_SIX; i++)
        of_hinge(l, s, i, &sum, a);
    for (int j = 0; j < 3; j++) {
        const fw_workspace_actuator *act = &l->hold->actuator[grip->actuator[j]];
        double size = s->size[j] * l->force_N;
        loads one = {0};
        of_actuator(l, s, act, l->force_N, &one);
        actuator_slopes(l, s, act, size, a);
        for (int i = 0; i < UNKNOWN; i++) {
            sum.on[i / 3][i % 3] += s->size[j] * one.on[i / 3][i % 3];
            a[UNKNOWN * i + 12 + j] = one.on[i / 3][i % 3] / row_unit(l, i);
        }
    }
    for (int i = 0; i < UNKNOWN; i++) {
        r[i] = sum.on[i / 3][i % 3] / row_unit(l, i);
        for (int k = 0; k < 12; k++)
            a[UNKNOWN * i + k] *= (k % 3 == 2 ? 1.0 : l->hold->length_m) / row_unit(l, i);
    }
}

/* Newton's method on links and sizes, the platform as it stands in s; false: it leads nowhere */
static bool settle(const limber *l, const fw_workspace_grip *grip, standing *s) {
    double a[UNKNOWN * UNKNOWN], x[UNKNOWN];
    int pivot[UNKNOWN];
    for (int round = 0; round < ROUNDS; round++) {
        all(l, s, grip, x, a);
        if (!fw_maths_lu_factor(UNKNOWN, a, pivot)) return false;
        fw_maths_lu_solve(UNKNOWN, a, pivot, NULL, x);
        double most = 0.0;
        for (int k = 0; k < 12; k++)
            most = fmax(most, fabs(x[k]));
        if (!isfinite(most)) return false;
        double by = fmin(1.0, 0.1 / most);
        for (int k = 0; k < UNKNOWN; k++)
            *(k < 12 ? &s->body[body_of(k)][k % 3] : &s->size[k - 12]) -=
                by * x[k] * (k < 12 && k % 3 != 2 ? l->hold->length_m : 1.0);
        if (most < 1e-6) return true; /* the next change is its square */
    }
    return false;
}

/* as it stands with pins, of which the load at that pose tells */
static void stiff(const limber *l, const double pose[3], const fw_workspace_pose_load *o,
                  standing *s) {
    const fw_workspace_hold *h = l->hold;
    for (int k = 0; k < LINKS; k++) {
        int side = k > PLATFORM;
        fw_geometry_vec2 base = h->loop->leg[side].base;
        s->body[k][0] = k == PLATFORM ? pose[0] : base.x + o->a[side].x.v.m - h->at[k].x;
        s->body[k][1] = k == PLATFORM ? pose[1] : base.y + o->a[side].y.v.m - h->at[k].y;
        s->body[k][2] = k == PLATFORM ? pose[2] : atan2(o->turn[k].y.v.m, o->turn[k].x.v.m);
    }
}

/* from where it stands with pins, or along the way from the drawn pose, each step with what pins do
   in it */
static bool stand(const limber *l, const fw_workspace_grip *grip, const double pose[3],
                  const fw_workspace_pose_load *load, const int sign[FW_SIX], standing *s) {
    *s = (standing){0};
    memcpy(s->sign, sign, sizeof s->sign);
    stiff(l, pose, load, s);
    if (settle(l, grip, s)) return true;
    standing before = {0}, now;
    *s = (standing){0};
    memcpy(s->sign, sign, sizeof s->sign);
    for (int i = 0; i <= STEPS; i++) {
        const double part = (double)i / STEPS;
        const double way[3] = {part * pose[0], part * pose[1], part * pose[2]};
        const fw_workspace_box3 at = {{way[0], way[1], way[2]}, {way[0], way[1], way[2]}};
        fw_workspace_pose_load o;
        if (!fw_workspace_poses_find(l->hold, &at, &o)) return false;
        stiff(l, way, &o, &now);
        for (int k = 0; k < LINKS; k++)
            for (int j = 0; j < 3; j++)
                s->body[k][j] += now.body[k][j] - before.body[k][j];
        before = now;
        if (!settle(l, grip, s)) return false;
    }
    return true;
}

static bool holds(const limber *l, const fw_workspace_grip *grip, const standing *s) {
    for (int j = 0; j < 3; j++)
        if (l->hold->actuator[grip->actuator[j]].pulls && s->size[j] < 0.0) return false;
    return true;
}

static double strain_of(const limber *l, const standing *s, int i) {
    const fw_mechanism_hinge *h = l->hinge[i];
    if (!h || l->hold->section[i].n == 0) return 0.0;
    const opened b = open_of(l, s, i);
    fw_flexure_hinge_bent law;
    fw_flexure_strip_load load;
    fw_flexure_strip_strains out;
    law_of(l, i, &b, false, &law);
    const double force[2] = {law.gradient[1], law.gradient[2]}, along = b.o * b.w;
    if (!law.holds || !fw_flexure_hinge_law_holds(&h->law, b.o * b.th)) return HUGE_VAL;
    fw_flexure_strip_load_of(&h->section, &h->law, &l->rest[i], b.o * b.th, force, &along, &load);
    if (!load.held) return HUGE_VAL;
    fw_flexure_strip_strain(&h->section, &load, &out);
    return out.peak;
}

static bool limber_of(const fw_workspace_hold *hold, const fw_mechanism *m, limber *l) {
    *l = (limber){.hold = hold, .m = m};
    for (int i = 0; i < FW_SIX; i++) {
        int k = m->pin[i].hinge;
        double spring = hold->section[i].spring_Nm_per_rad;
        l->pin[i] = fw_mechanism_pin_place(m, &m->pin[i], 0);
        l->moment_Nm = fmax(l->moment_Nm, spring);
        if (k == FW_NONE) continue;
        l->hinge[i] = &m->hinge[k];
        if (!isfinite(m->hinge[k].axis_rad) || !(spring > 0.0)) return false;
        l->rest[i] = fw_flexure_hinge_rest_of(&m->hinge[k].law);
    }
    l->force_N = l->moment_Nm / hold->length_m;
    l->stiff_N_per_m = 1e6 * l->force_N / hold->length_m;
    return l->moment_Nm > 0.0;
}

/* ---- over the poses that are looked at ---- */

typedef struct stance { /* at a pose by a grip */
    double pose[3];
    int grip;
    bool stands;
    standing at;
} stance;

typedef struct looked {
    fw_workspace_view *view;
    double pins[FW_SIX], gives[FW_SIX]; /* largest strains */
    double apart;                       /* largest |gives/pins - 1| of large strains at one pose */
    fw_workspace_strain_extreme done[FW_SIX]; /* poses and grips that were looked at first */
    int ndone;
    stance *stance; /* (STANCES) those that were found, the first ones */
    int nstance;
} looked;

/* where it stands at a pose by a grip: most extremes lie in corners, which are then looked at, too */
static bool stood(const limber *l, int g, const double pose[3], const fw_workspace_pose_load *load,
                  const int sign[FW_SIX], looked *to, standing *s) {
    for (int k = 0; k < to->nstance; k++) {
        const stance *was = &to->stance[k];
        if (was->grip != g || memcmp(was->pose, pose, sizeof was->pose) ||
            memcmp(was->at.sign, sign, sizeof was->at.sign))
            continue;
        *s = was->at;
        return was->stands;
    }
    bool stands = stand(l, &l->hold->grip[g], pose, load, sign, s);
    if (to->nstance < STANCES)
        to->stance[to->nstance++] =
            (stance){.pose = {pose[0], pose[1], pose[2]}, .grip = g, .stands = stands, .at = *s};
    return stands;
}

/* A pose by one grip, unless its strains with pins are far below the largest. `always`: of the first ones,
   which say how far strains with hinges that give may be from those with pins. */
static void look(const limber *l, const double pose[3], int g, bool always, looked *to) {
    const fw_workspace_grip *grip = &l->hold->grip[g];
    fw_workspace_gripped *by = fw_workspace_view_grip(to->view, g);
    bool any = always, matters[FW_SIX], stands = false;
    double pins[FW_SIX];
    int sign[FW_SIX] = {0};
    standing s;
    if (!by->holds) return;
    for (int i = 0; i < FW_SIX; i++) {
        pins[i] = fw_workspace_view_strain(to->view, by, i, NULL).lo;
        to->pins[i] = fmax(to->pins[i], pins[i]);
        matters[i] = pins[i] * (1.05 + 2.0 * to->apart) > to->gives[i];
        any = any || matters[i];
    }
    if (!any) return;
    if (!l->hold->rubs) {
        stands = stood(l, g, pose, &to->view->load, sign, to, &s);
        if (stands && !holds(l, grip, &s)) return;
    }
    for (int i = 0; i < FW_SIX; i++) {
        if (!matters[i]) continue;
        if (l->hold->rubs) { /* with the signs that strain this hinge most */
            fw_workspace_rub_signs(l->hold, &to->view->load, i, &by->force[i], &to->view->rub,
                                   sign);
            stands = stood(l, g, pose, &to->view->load, sign, to, &s);
            if (stands && !holds(l, grip, &s)) continue;
        }
        double strain = stands ? strain_of(l, &s, i) : HUGE_VAL;
        to->gives[i] = fmax(to->gives[i], strain);
        to->apart = fmax(to->apart, fabs(strain / pins[i] - 1.0));
    }
}

/* by all grips, or by one */
static void look_at(const limber *l, const double pose[3], int only, looked *to) {
    const fw_workspace_box3 at = {{pose[0], pose[1], pose[2]}, {pose[0], pose[1], pose[2]}};
    const fw_workspace_hold *h = l->hold;
    if (!fw_workspace_view_at(to->view, &at)) return;
    for (int g = 0; g < h->ngrip && g < MOST_GRIPS; g++) {
        bool done = only != FW_NONE && only != g;
        for (int k = 0; k < to->ndone && !done; k++)
            done = to->done[k].grip == g && !memcmp(to->done[k].pose, pose, 3 * sizeof *pose);
        if (!done) look(l, pose, g, only == g, to);
    }
}

fw_status fw_workspace_gives(fw_arena *arena, const fw_workspace_hold *hold, const fw_mechanism *m,
                             const fw_workspace_box3 *box, const fw_workspace_strain_proof *proof,
                             fw_workspace_give give[FW_SIX]) {
    limber l;
    looked to = {0};
    for (int i = 0; i < FW_SIX; i++)
        give[i] = (fw_workspace_give){.first_order = true};
    if (!limber_of(hold, m, &l)) return FW_OK;
    FW_NEED(to.view = fw_arena_one(arena, fw_workspace_view));
    FW_TRY(fw_workspace_view_new(arena, hold, to.view));
    FW_NEED(to.stance = fw_arena_array(arena, stance, STANCES));
    for (int i = 0; i < FW_SIX; i++) {
        const fw_workspace_strain_extreme *most = &proof->most[i];
        if (hold->section[i].n == 0) continue;
        look_at(&l, most->pose, most->grip, &to);
        to.done[to.ndone++] = *most;
    }
    for (int i = 0; i < FW_SIX; i++)
        if (hold->section[i].n > 0) look_at(&l, proof->most[i].pose, FW_NONE, &to);
    for (int i = 0; i < CORNERS; i++) {
        const double pose[3] = {i & 1 ? box->hi[0] : box->lo[0], i & 2 ? box->hi[1] : box->lo[1],
                                i & 4 ? box->hi[2] : box->lo[2]};
        look_at(&l, pose, FW_NONE, &to);
    }
    for (int i = 0; i < FW_SIX; i++) {
        if (!(to.pins[i] > 0.0) || !(to.gives[i] > 0.0)) continue;
        give[i] = fw_workspace_nothing_known;
        if (!isfinite(to.gives[i])) continue;
        double is = to.gives[i] / proof->strain[i];
        double most = is * fmax(proof->strain[i] / to.pins[i], 1.0); /* elsewhere, too */
        give[i].added = most - 1.0;
        give[i].give = law_error;
        give[i].relief = 1.0 - is * (1.0 - law_error) / most;
    }
    return FW_OK;
}

/* ---- what scenes state and required poses do not count ---- */

static fw_status leave_out(fw_arena *arena, const char *what, const char *id, const char *scene,
                           fw_workspace_result *result) {
    FW_NEED(result->left_out = fw_arena_printf(
                arena, "%s%s%s%s%s of scene %s", result->left_out ? result->left_out : "",
                result->left_out ? ", " : "", what, id ? " " : "", id ? id : "", scene));
    return FW_OK;
}

static bool bends(const fw_device_tendon *t) {
    return t->neyelet > 2;
}

/* The list of docs/theory/workspace.md, from the other side: what is neither counted nor without force in a pose */
fw_status fw_workspace_left_out(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                                fw_workspace_result *result) {
    bool shaken = false, bent = false;
    for (int i = 0; i < s->nbase; i++)
        shaken = shaken || s->base[i].ax_m_per_s2 != 0 || s->base[i].ay_m_per_s2 != 0;
    if (shaken) FW_TRY(leave_out(arena, "base-motion", NULL, s->name, result));
    for (int i = 0; i < s->ncontact; i++) {
        const fw_device_contact_use *c = &s->contact[i];
        const bool on_hinge = c->joint >= 0 && c->joint < FW_SIX && c->joint < m->npin;
        const bool rides = c->joint == FW_NONE && (c->body_a >= 5 || c->body_b >= 5);
        if (on_hinge)
            FW_TRY(leave_out(arena, "contact of hinge", m->pin[c->joint].id, s->name, result));
        if (rides) FW_TRY(leave_out(arena, "contact", c->id, s->name, result));
    }
    for (int i = 0; i < s->ntendon; i++)
        bent = bent || bends(&s->tendon[i]);
    for (int i = 0; i < s->npart; i++) {
        const fw_device_scene_part *p = &s->part[i];
        const bool eyelets = strcmp(p->element, "eyelet-friction") == 0;
        if (!eyelets || (bent && fw_device_scene_part_number(p, "coefficient") > 0))
            FW_TRY(leave_out(arena, p->element, NULL, s->name, result));
    }
    if (fw_effects_softened(m, s) != 0 && (m->nspring > 0 || fw_workspace_scene_gives(m, s)))
        FW_TRY(leave_out(arena, "what temperature does to the modulus", NULL, s->name, result));
    return FW_OK;
}
