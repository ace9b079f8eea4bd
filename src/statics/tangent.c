/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the forces at a pose derive from, where elements are driven, and their exact derivatives; what pins hold, by the
   rows of their constraint Jacobian, and what they take along. */
#include "quantity/law_kind.h"
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

/* ---- the potential of driven elements ---- */

/* The potential of force elements that are driven from outside (pulls, voltages): what they state
   as stored is not what their force derives from. At rest and at a given load factor it derives
   from a potential all the same,

       V(u) = - int_0^1 Q(w + x (u - w)) . (u - w) dx       with w where a descent stands,

   by Gauss's formula of 8 points; Q is a function of the pose alone, so the way there does not
   matter. Inputs: poses, scaled. Valid while the formulas hold on the way. Error: round-off where Q
   is smooth, some per cent of what a switch on the way changes where it is not; the line search
   that asks accepts by a ten-thousandth of what the forces promise. Cost: 8 evaluations of those
   elements. Source: Gauss-Legendre nodes and weights, Abramowitz and Stegun, table 25.4. Test:
   test_static_elements.c. */

enum { POINTS = 4 }; /* on either side of the middle */
static const double node[POINTS] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                    0.9602898564975363};
static const double weight[POINTS] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                      0.1012285362903763};

static bool none_is_driven(const fw_multibody_model *m) {
    for (int i = 0; i < m->nelement; i++)
        if (m->element[i].own->works) return false;
    return true;
}

/* what elements store too, but fw_multibody_energy_at counts that: it is taken off */
double fw_statics_equilibrium_driven(fw_statics_equilibrium *w, const double *u, double *size) {
    const fw_multibody_model *m = w->model;
    fw_multibody_system *sys = w->system;
    const double *v = w->away + m->nq;
    double sum = 0;
    *size = 0;
    if (none_is_driven(m)) return 0;
    for (int k = 0; k < 2 * POINTS; k++) {
        double x = 0.5 + (k % 2 ? 0.5 : -0.5) * node[k / 2], along = 0;
        for (int i = 0; i < m->nq; i++)
            w->away[i] = w->y[i] + x * (u[i] - w->y[i]);
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, w->t, w->away);
        memset(w->pull, 0, (size_t)m->nq * sizeof *w->pull);
        fw_multibody_element_driven(sys, pose, v, false, w->pull);
        for (int i = 0; i < m->nq; i++)
            along += w->pull[i] * (u[i] - w->y[i]);
        sum -= 0.5 * weight[k / 2] * along;
        *size += 0.5 * weight[k / 2] * fabs(along);
    }
    memcpy(w->away, u, (size_t)m->nq * sizeof *u);
    const fw_multibody_pose *pose = fw_multibody_set_switches(sys, w->t, w->away);
    return sum - (fw_multibody_element_energy(sys, pose, v, true) -
                  fw_multibody_element_energy(sys, pose, v, false));
}

/* ---- exact derivatives ---- */

/* Every force and every curved constraint of the model is a function of one or two scalars g(u):
   the distance of two points, or a distance along a direction that turns with the first body.

     spring on g, force -(k (g - g0) + c g') grad g:
       K = k grad g grad g^T + (k (g - g0) + c g') hess g + c grad g (hess g v)^T,
       C = c grad g grad g^T
     a spring without length between points that coincide, force -(k d + c d') on point b, which is
     what the line above tends to along every motion through that place (D = dd/du):
       K = k D^T D,   C = c D^T D
     constraint g = value with multiplier lambda:  K = lambda hess g
     force elements: what their classes say, spread as effects/element.c explains

   Coordinates of a pair of bodies: x_a, y_a, phi_a, x_b, y_b, phi_b. With arms r, p(r) = (-r_y,
   r_x) and dp/dphi = -r. Error: round-off. Cost: a constant per element, and nq^2 zeros. Source:
   direct differentiation; geometric stiffness as in Geradin and Cardona 2001, ch. 9. Test:
   test_tangent.c. */

typedef struct target { /* where a pair's 6 x 6 goes */
    int nbody;
    const fw_effects_matrix *matrix; /* NULL: nowhere */
} target;

typedef struct gauge {
    double value, grad[6], hess[6][6];
} gauge;

typedef struct pair { /* two points: arms and d = from a's to b's, world axes */
    double ra[2], rb[2], d[2];
} pair;

static void add_entry(const target *to, int row_body, int row, int column_body, int column,
                      double value) {
    if (row_body >= to->nbody || column_body >= to->nbody) return; /* the ground does not move */
    fw_effects_matrix_add(to->matrix, 3 * row_body + row, 3 * column_body + column, value);
}

static void add_pair(const target *to, int a, int b, double matrix[6][6]) {
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            add_entry(to, i < 3 ? a : b, i % 3, j < 3 ? a : b, j % 3, matrix[i][j]);
}

static void turn(const fw_multibody_pose *pose, int body, double x, double y, double out[2]) {
    out[0] = pose->cosine[body] * x - pose->sine[body] * y;
    out[1] = pose->sine[body] * x + pose->cosine[body] * y;
}

static pair pair_of(const fw_multibody_model *m, const fw_multibody_pose *pose, int a, int b,
                    const double local[4], const double offset[2]) {
    const double *u = pose->u;
    pair p;
    turn(pose, a, local[0], local[1], p.ra);
    turn(pose, b, local[2], local[3], p.rb);
    for (int k = 0; k < 2; k++) {
        double ua = a < m->nbody ? u[3 * a + k] : 0, ub = b < m->nbody ? u[3 * b + k] : 0;
        p.d[k] = ub - ua - offset[k] + p.rb[k] - p.ra[k];
    }
    return p;
}

/* component k of d */
static gauge component(const pair *p, int k) {
    gauge g = {.value = p->d[k]};
    g.grad[k] = -1, g.grad[3 + k] = 1;
    g.grad[2] = k ? -p->ra[0] : p->ra[1];
    g.grad[5] = k ? p->rb[0] : -p->rb[1];
    g.hess[2][2] = p->ra[k], g.hess[5][5] = -p->rb[k];
    return g;
}

/* g = |d|; grad = D^T e, hess = D^T w w^T D / |d| + the arms' own curvature, D = dd/du, e = d/|d|,
   w across. Points that coincide have no direction: all zero then. The potential of a spring with a
   length has a tip there, and no tangent. */
static gauge distance_of(const pair *p) {
    gauge g = {0};
    g.value = hypot(p->d[0], p->d[1]);
    if (!(g.value > 0)) return g;
    double e[2] = {p->d[0] / g.value, p->d[1] / g.value}, w[2] = {-e[1], e[0]}, across[6];
    for (int k = 0; k < 2; k++) {
        g.grad[k] = -e[k], g.grad[3 + k] = e[k];
        across[k] = -w[k], across[3 + k] = w[k];
    }
    g.grad[2] = e[0] * p->ra[1] - e[1] * p->ra[0];
    g.grad[5] = e[1] * p->rb[0] - e[0] * p->rb[1];
    across[2] = w[0] * p->ra[1] - w[1] * p->ra[0];
    across[5] = w[1] * p->rb[0] - w[0] * p->rb[1];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            g.hess[i][j] = across[i] * across[j] / g.value;
    g.hess[2][2] += e[0] * p->ra[0] + e[1] * p->ra[1];
    g.hess[5][5] -= e[0] * p->rb[0] + e[1] * p->rb[1];
    return g;
}

/* g = w . d with the direction w fixed in a; since w . r_a is constant, only d + r_a counts */
static gauge along(const pair *p, const double w[2]) {
    gauge g = {.value = w[0] * p->d[0] + w[1] * p->d[1]};
    double pw[2] = {-w[1], w[0]}, far[2] = {p->d[0] + p->ra[0], p->d[1] + p->ra[1]};
    for (int k = 0; k < 2; k++) {
        g.grad[k] = -w[k], g.grad[3 + k] = w[k];
        g.hess[k][2] = g.hess[2][k] = -pw[k];
        g.hess[3 + k][2] = g.hess[2][3 + k] = pw[k];
    }
    g.grad[2] = pw[0] * far[0] + pw[1] * far[1];
    g.grad[5] = w[1] * p->rb[0] - w[0] * p->rb[1];
    g.hess[2][2] = -(w[0] * far[0] + w[1] * far[1]);
    g.hess[2][5] = g.hess[5][2] = w[0] * p->rb[0] + w[1] * p->rb[1];
    g.hess[5][5] = -(w[0] * p->rb[0] + w[1] * p->rb[1]);
    return g;
}

/* ---- constraints ---- */

static void constraint(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                       const double *lambda, const target *to) {
    const fw_multibody_block *c = &m->block[i];
    if (c->rows == FW_ROWS_TURN) return; /* linear */
    pair p = pair_of(m, pose, c->a, c->b, m->local + 4 * i, pose->offset + 2 * i);
    if (c->rows == FW_ROWS_PIN) { /* -d: the arms turn */
        add_entry(to, c->a, 2, c->a, 2, -(lambda[0] * p.ra[0] + lambda[1] * p.ra[1]));
        add_entry(to, c->b, 2, c->b, 2, lambda[0] * p.rb[0] + lambda[1] * p.rb[1]);
        return;
    }
    double e[2];
    turn(pose, c->a, c->cos_axis, c->sin_axis, e);
    const double n[2] = {-e[1], e[0]};
    gauge g = c->rows == FW_ROWS_ROD     ? distance_of(&p)
              : c->rows == FW_ROWS_SLIDE ? along(&p, n)
                                         : along(&p, e);
    double force = c->rows == FW_ROWS_SLIDE ? lambda[1] : lambda[0];
    for (int k = 0; k < 36; k++)
        g.hess[k / 6][k % 6] *= force;
    add_pair(to, c->a, c->b, g.hess);
}

/* ---- forces ---- */

static void spring_on(const fw_multibody_model *m, const gauge *g, int a, int b, const double *v,
                      double k, double c, double free, const target *stiffness,
                      const target *damping) {
    double speed[6] = {0}, bend[6] = {0}, rate = 0, matrix[6][6];
    for (int i = 0; i < 6; i++) {
        int body = i < 3 ? a : b;
        if (body < m->nbody) speed[i] = v[3 * body + i % 3];
        rate += g->grad[i] * speed[i];
    }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            bend[i] += g->hess[i][j] * speed[j];
    double force = k * (g->value - free) + c * rate;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            matrix[i][j] = g->grad[i] * (k * g->grad[j] + c * bend[j]) + force * g->hess[i][j];
    add_pair(stiffness, a, b, matrix);
    if (!damping->matrix || c == 0) return;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            matrix[i][j] = c * g->grad[i] * g->grad[j];
    add_pair(damping, a, b, matrix);
}

/* a point spring; where its points lie apart by no more than round-off, a direction means
   nothing */
static void point_spring(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                         const double *v, const target *stiffness, const target *damping) {
    const fw_multibody_spring *s = &m->spring[i];
    const double offset[2] = {m->origin[3 * s->a] - m->origin[3 * s->b],
                              m->origin[3 * s->a + 1] - m->origin[3 * s->b + 1]};
    pair p = pair_of(m, pose, s->a, s->b, pose->spring_end + 4 * i, offset);
    bool together =
        s->length == 0 && hypot(p.d[0], p.d[1]) <= fw_multibody_spring_round_off(m, pose, i);
    for (int k = 0; together && k < 2; k++) {
        gauge g = component(&p, k);
        spring_on(m, &g, s->a, s->b, v, s->k, s->c, 0, stiffness, damping);
    }
    if (together) return;
    gauge g = distance_of(&p);
    spring_on(m, &g, s->a, s->b, v, s->k, s->c, s->length, stiffness, damping);
}

static void between_angles(const target *to, int a, int b, double value) {
    add_entry(to, a, 2, a, 2, value);
    add_entry(to, b, 2, b, 2, value);
    add_entry(to, a, 2, b, 2, -value);
    add_entry(to, b, 2, a, 2, -value);
}

/* a force of fixed direction turns with its arm only: torque r x f, d/dphi = -r . f */
static void dead_load(const fw_multibody_pose *pose, int body, double x, double y, double fx,
                      double fy, const target *to) {
    double r[2];
    turn(pose, body, x, y, r);
    add_entry(to, body, 2, body, 2, r[0] * fx + r[1] * fy);
}

static void forces(const fw_multibody_system *sys, const fw_multibody_pose *pose, const double *v,
                   const target *stiffness, const target *damping) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        between_angles(stiffness, s->a, s->b, s->k);
        if (damping->matrix) between_angles(damping, s->a, s->b, s->c);
    }
    for (int i = 0; i < m->nstop; i++) {
        const fw_multibody_stop *s = &m->stop[i];
        if (!sys->on.stop[i]) continue;
        between_angles(stiffness, s->a, s->b, s->k);
        if (damping->matrix) between_angles(damping, s->a, s->b, s->c);
    }
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_load *l = &m->load[i];
        const double *f = sys->loading.force + 2 * i;
        dead_load(pose, l->body, l->x, l->y, f[0], f[1], stiffness);
    }
    for (int i = 0; i < m->ntimed; i++) {
        const fw_multibody_timed_load *l = &m->timed[i];
        double factor[3];
        fw_quantity_law_value(l->law, pose->t * m->scale.time_s, sys->piece_s, factor);
        dead_load(pose, l->body, l->x, l->y, factor[0] * l->fx, factor[0] * l->fy, stiffness);
    }
    for (int i = 0; i < m->nspring; i++)
        if (sys->on.spring[i]) point_spring(m, pose, i, v, stiffness, damping);
    for (int i = 0; i < m->nslide; i++) {
        const fw_multibody_slide *s = &m->slide[i];
        const fw_multibody_block *c = &m->block[s->block];
        double e[2];
        turn(pose, s->a, c->cos_axis, c->sin_axis, e);
        pair p = pair_of(m, pose, s->a, s->b, m->local + 4 * s->block, pose->offset + 2 * s->block);
        gauge g = along(&p, e);
        spring_on(m, &g, s->a, s->b, v, s->k, s->c, s->free, stiffness, damping);
    }
    if (m->nelement > 0)
        fw_multibody_element_tangent(sys, pose, v, stiffness->matrix, damping->matrix);
}

void fw_statics_tangent_to(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                           const double *v, const double *lambda,
                           const fw_effects_matrix *stiffness, const fw_effects_matrix *damping) {
    const fw_multibody_model *m = sys->model;
    const target k = {m->nbody, stiffness}, c = {m->nbody, damping};
    forces(sys, pose, v, &k, &c);
    for (int i = 0; i < m->nblock; i++)
        constraint(m, pose, i, lambda + 2 * i, &k);
}

void fw_statics_tangent(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, const double *lambda, double *stiffness, double *damping) {
    const int n = sys->model->nq;
    const size_t size = (size_t)n * (size_t)n * sizeof(double);
    const fw_effects_matrix k = {.n = n, .dense = stiffness}, c = {.n = n, .dense = damping};
    memset(stiffness, 0, size);
    if (damping) memset(damping, 0, size);
    fw_statics_tangent_to(sys, pose, v, lambda, &k, damping ? &c : NULL);
}

/* ---- entries one by one ---- */

void fw_statics_entries_clear(fw_statics_entries *e) {
    e->count = 0;
}

void fw_statics_entries_add(void *entries, int row, int column, double value) {
    fw_statics_entries *e = entries;
    if (e->failed) return;
    if (e->count == e->room) {
        const size_t have = (size_t)e->count, room = 2 * have + 1024;
        int *r = fw_arena_grow(e->arena, e->row, have, room, sizeof *r);
        int *c = r ? fw_arena_grow(e->arena, e->column, have, room, sizeof *c) : NULL;
        double *v = c ? fw_arena_grow(e->arena, e->value, have, room, sizeof *v) : NULL;
        if (!v) {
            e->failed = true;
            return;
        }
        e->row = r, e->column = c, e->value = v, e->room = (int)room;
    }
    e->row[e->count] = row, e->column[e->count] = column, e->value[e->count++] = value;
}

static void add_two(const fw_multibody_model *m, int a, int b, int *bodies, int *count) {
    if (a >= m->nbody || b >= m->nbody) return; /* the ground has no unknowns */
    if (bodies) bodies[2 * *count] = a, bodies[2 * *count + 1] = b;
    (*count)++;
}

/* pairs of bodies that something acts between: (2 count), or their number alone */
int fw_statics_tangent_pairs(const fw_multibody_model *m, int *bodies) {
    int count = 0;
    for (int i = 0; i < m->nblock; i++)
        add_two(m, m->block[i].a, m->block[i].b, bodies, &count);
    for (int i = 0; i < m->ntorsion; i++)
        add_two(m, m->torsion[i].a, m->torsion[i].b, bodies, &count);
    for (int i = 0; i < m->nstop; i++)
        add_two(m, m->stop[i].a, m->stop[i].b, bodies, &count);
    for (int i = 0; i < m->nspring; i++)
        add_two(m, m->spring[i].a, m->spring[i].b, bodies, &count);
    for (int i = 0; i < m->nelement; i++)
        for (int a = 0; a < m->element[i].own->ports; a++)
            for (int b = 0; b < a; b++)
                add_two(m, m->element[i].body[a], m->element[i].body[b], bodies, &count);
    return count;
}

/* ---- pins first: what they hold ---- */

/* row of a pin's point on a body: coordinate `axis` of it by the body's place and turn, sign +-1 */
static void put_row(const fw_mechanism *m, const fw_mechanism_pin *pin, int side, int axis,
                    double length_m, double *row) {
    int body = side ? pin->body_b : pin->body_a;
    if (body == FW_GROUND) return;
    fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, side);
    double x = (at.x - m->body[body].x_m) / length_m, y = (at.y - m->body[body].y_m) / length_m;
    double sign = side ? 1 : -1;
    row[3 * body + axis] += sign;
    row[3 * body + 2] += sign * (axis ? x : -y);
}

/* rows of all pins, reduced: each has one leading 1 that no other row has. Returns their number */
static int reduce(int rows, int n, double *a) {
    static const double new_row = 1e-9;
    int rank = 0;
    for (int c = 0; c < n && rank < rows; c++) {
        int best = rank;
        for (int r = rank + 1; r < rows; r++)
            if (fabs(a[r * n + c]) > fabs(a[best * n + c])) best = r;
        if (!(fabs(a[best * n + c]) > new_row)) continue;
        double by = a[best * n + c];
        for (int k = 0; k < n; k++) {
            double t = a[best * n + k];
            a[best * n + k] = a[rank * n + k], a[rank * n + k] = t / by;
        }
        for (int r = 0; r < rows; r++) {
            double share = r == rank ? 0 : a[r * n + c];
            for (int k = c; k < n && share != 0; k++)
                a[r * n + k] -= share * a[rank * n + k];
        }
        rank++;
    }
    return rank;
}

/* Does some body that hangs on flexures stand still where these are pins? What it does then is what
   they give, of which pins know nothing: not its motion, not even that there is one. */
static fw_status pins_hold(fw_arena *arena, const fw_mechanism *m, bool *hold) {
    int n = 3 * m->nbody, rows = 2 * m->npin;
    double length = 0, *a;
    *hold = false;
    if (n > FW_LEVEL_MOST) return FW_OK; /* no step to hinges that give will be known */
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(a = fw_arena_array(arena, double, (size_t)(rows * n)));
    memset(a, 0, (size_t)(rows * n) * sizeof *a);
    for (int i = 0; i < m->npin; i++)
        for (int side = 0; side < 2; side++) {
            int body = side ? m->pin[i].body_b : m->pin[i].body_a;
            fw_geometry_vec2 at = fw_mechanism_pin_place(m, &m->pin[i], side);
            if (body != FW_GROUND)
                length = fmax(length, hypot(at.x - m->body[body].x_m, at.y - m->body[body].y_m));
        }
    for (int i = 0; i < rows; i++)
        for (int side = 0; side < 2; side++)
            put_row(m, &m->pin[i / 2], side, i % 2, length > 0 ? length : 1, a + i * n);
    int rank = reduce(rows, n, a);
    for (int k = 0; k < m->nhinge && !*hold; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        for (int side = 0; side < 2; side++) {
            int body = side ? pin->body_b : pin->body_a, still = 0;
            for (int r = 0; r < rank && body != FW_GROUND; r++) {
                int first = 0, others = 0;
                while (fabs(a[r * n + first]) < 0.5)
                    first++;
                for (int c = first + 1; c < n; c++)
                    others += fabs(a[r * n + c]) > 1e-9;
                still += others == 0 && first / 3 == body;
            }
            *hold = *hold || still == 3;
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

double fw_statics_slowest_along(const fw_mechanism *m) {
    double k = (double)INFINITY, mass = 0;
    for (int i = 0; i < m->nhinge; i++) {
        const fw_flexure_result *r = &m->hinge[i].closed_form;
        const double stated =
            m->pin[m->hinge[i].pin].stiffness_Nm_per_rad / r->stiffness_Nm_per_rad;
        k = fmin(k, stated * fmin(r->kx_N_per_m, r->ky_N_per_m));
    }
    for (int i = 0; i < m->nbody; i++)
        mass += m->body[i].mass_kg;
    return sqrt(k / (m->nbody * mass));
}

/* ---- two tangents at one pose ---- */

/* K' of the next level in the modes u_i of this one, over their own stiffnesses: S_ij = u_i K' u_j / sqrt(u_i K u_i u_j K u_j).
   false: a mode has no stiffness, or less than none */
static bool in_modes_of(const fw_statics_equilibrium *low, const fw_statics_equilibrium *high,
                        double *u, double *force, double *s) {
    const fw_statics_reduced *r = &low->reduced;
    const fw_multibody_scale *a = &low->model->scale, *b = &high->model->scale;
    const size_t n = (size_t)r->n, dof = (size_t)r->dof;
    const double energy =
        b->mass_kg / a->mass_kg * pow(b->length_m / b->time_s, 2) / pow(a->length_m / a->time_s, 2);
    for (size_t k = 0; k < dof; k++) {
        if (!(r->value[k] > r->zero[k])) return false;
        for (size_t i = 0; i < n; i++)
            u[k * n + i] = r->shape[k * n + i] * (i % 3 == 2 ? 1 : a->length_m / b->length_m);
    }
    for (size_t k = 0; k < dof; k++) {
        for (size_t i = 0; i < n; i++) {
            force[i] = 0;
            for (size_t j = 0; j < n; j++)
                force[i] +=
                    0.5 * (high->stiffness[i * n + j] + high->stiffness[j * n + i]) * u[k * n + j];
        }
        for (size_t l = 0; l <= k; l++) {
            double sum = 0;
            for (size_t i = 0; i < n; i++)
                sum += u[l * n + i] * force[i];
            s[k * dof + l] = s[l * dof + k] = sum * energy / sqrt(r->value[k]) / sqrt(r->value[l]);
        }
    }
    return true;
}

/* By what two levels differ at most in what a tangent says. With mu_l the eigenvalues of S above, in [a, b], any squared
   frequency and any stiffness 1/(d K^-1 d) is from a to b times what it was: at most max(b, 1/a) - 1 apart, either over
   the other. softer = S^-1. In: scaled, both evaluated; out: relative. Exact but for round-off where joints stand alike;
   where settling has moved them, to first order of the way. Cost n^2 dof + 10 dof^3. Source: Courant, Fischer (R. Horn,
   C. Johnson, Matrix Analysis, 4.2 and 7.7). Test: tests/cli/test_unsymmetric.py */
fw_status fw_statics_tangents_apart(const fw_statics_equilibrium *low,
                                    const fw_statics_equilibrium *high,
                                    fw_statics_level_small *out) {
    const fw_statics_reduced *r = &low->reduced;
    const size_t n = (size_t)r->n, dof = (size_t)r->dof;
    double *s, *u, *value, *softer;
    fw_maths_lapack_space space;
    if (low->sparse || high->sparse || r->dof < 1) return FW_OK;
    FW_NEED(s = fw_arena_array(low->arena, double, dof *dof));
    FW_NEED(u = fw_arena_array(low->arena, double, (dof + 1) * n));
    FW_NEED(value = fw_arena_array(low->arena, double, dof));
    FW_NEED(softer = fw_arena_array(low->arena, double, dof *dof));
    if (!in_modes_of(low, high, u, u + dof * n, s)) return FW_OK;
    FW_TRY(fw_maths_eigen_space(low->arena, r->dof, &space));
    if (!fw_maths_eigen(r->dof, s, value, &space)) return FW_OK;
    out->apart = value[0] > 0 ? fmax(value[dof - 1], 1 / value[0]) - 1 : (double)INFINITY;
    if (!(value[0] > 0)) return FW_OK;
    for (size_t i = 0; i < dof; i++) /* row l of s is the vector of value l */
        for (size_t j = 0; j < dof; j++)
            for (size_t l = 0; l < dof; l++)
                softer[i * dof + j] += s[l * dof + i] * s[l * dof + j] / value[l];
    out->softer = softer;
    return FW_OK;
}

void fw_statics_push(const fw_statics_equilibrium *w, double a, const double *field,
                     double *gravity) {
    const double time = w->model->scale.time_s, length = w->model->scale.length_m;
    for (int i = 0; i < w->model->nq; i++)
        gravity[i] -= a * field[i] * time * time / (i % 3 == 2 ? 1 : length);
}

double fw_statics_mass_of(const fw_mechanism *m, int coordinate) {
    const fw_mechanism_mass *b = &m->body[coordinate / 3];
    return coordinate % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg;
}

fw_status fw_statics_taken_along(fw_statics_equilibrium *w, int driver, double *v, bool *found) {
    fw_multibody_system *sys = w->system;
    const fw_multibody_model *all = sys->model;
    const fw_quantity_law unit = {.kind = &fw_quantity_law_ramp, .start_s = -0.5, .rise_s = 1};
    fw_multibody_model alone = *all;
    fw_multibody_block *block = fw_arena_array(w->arena, fw_multibody_block, (size_t)all->nblock);
    FW_NEED(block);
    for (int i = 0; i < all->nblock; i++) {
        block[i] = all->block[i];
        block[i].law = block[i].driver == driver ? &unit : NULL;
    }
    memset(v, 0, (size_t)all->nq * sizeof *v);
    alone.block = block, alone.stretch.law = NULL;
    const double piece_s = sys->piece_s;
    sys->model = &alone, sys->loading.driven = true, sys->piece_s = 0;
    const fw_multibody_factor *factor =
        fw_multibody_factorise(sys, fw_multibody_pose_at(sys, 0, w->y));
    *found = factor && fw_multibody_impact(sys, factor, v);
    sys->model = all, sys->loading.driven = false, sys->piece_s = piece_s;
    for (int i = 0; i < all->nq; i++)
        v[i] *= (i % 3 == 2 ? 1 : all->scale.length_m) / all->scale.time_s;
    return FW_OK;
}

fw_status fw_statics_level_pins_first(fw_arena *arena, const fw_mechanism *m,
                                      const fw_device_scene *scene, const fw_effect_choice *asked,
                                      bool *first) {
    bool alone = asked->mode == FW_EFFECTS_AUTO || asked->mode == FW_EFFECTS_WHOLE, hold;
    *first = false;
    if (asked->hinge != FW_HINGE_AUTO || !alone || m->nhinge == 0) return FW_OK;
    if (scene &&
        (scene->ncontact > 0 || scene->ntemperature > 0 || scene->nstress > 0 || scene->ncomb > 0))
        return FW_OK;
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].stated || !isfinite(m->hinge[k].axis_rad) ||
            m->hinge[k].coupling > fw_statics_coupled)
            return FW_OK;
    FW_TRY(pins_hold(arena, m, &hold));
    *first = !hold;
    return FW_OK;
}
