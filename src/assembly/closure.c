/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closing a mechanism: descent on |Psi|^2 from its guess, and other starts where that does not close it. */
#include "assembly/closure.h"
#include "base/constants.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- descent onto Psi(q) = 0, and along it to the pose nearest to the guess ---- */

/* what every block keeps (its law included), from Psi at the guess */
static void find_kept(fw_assembly_closure *c, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = c->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        double d[2], e[2], n[2];
        fw_multibody_frame(m, pose, i, d, e, n);
        double now = b->rows == FW_ROWS_ROD      ? hypot(d[0], d[1])
                     : b->rows == FW_ROWS_TRAVEL ? e[0] * d[0] + e[1] * d[1]
                                                 : 0; /* TURN, SLIDE: angles since the guess */
        c->kept[i] = b->rows == FW_ROWS_PIN ? 0 : now - c->psi[2 * i];
    }
}

fw_status fw_assembly_closure_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                  fw_diags *diags, fw_assembly_closure *c) {
    const fw_multibody_model *m;
    FW_TRY(fw_multibody_model_new(arena, mechanism, NULL, q, 1, NULL, &m));
    size_t n = (size_t)m->nq, k = (size_t)m->nblock;
    *c = (fw_assembly_closure){
        .arena = arena, .model = m, .goal = 4 * DBL_EPSILON * m->size, .left = 2000};
    FW_TRY(fw_multibody_system_new(arena, m, mechanism, diags, &c->system));
    FW_TRY(fw_multibody_chain_numbers_new(arena, m, &c->chain));
    FW_NEED(c->held = fw_arena_array(arena, double, n));
    FW_NEED(c->wanted = fw_arena_array(arena, double, n));
    FW_NEED(c->u = fw_arena_array(arena, double, n));
    FW_NEED(c->trial = fw_arena_array(arena, double, n));
    FW_NEED(c->step = fw_arena_array(arena, double, n));
    FW_NEED(c->psi = fw_arena_array(arena, double, 2 * k));
    FW_NEED(c->lambda = fw_arena_array(arena, double, 2 * k));
    FW_NEED(c->kept = fw_arena_array(arena, double, k));
    FW_NEED(c->active = fw_arena_array(arena, bool, k));
    FW_NEED(c->soft = fw_arena_array(arena, double, 2 * k));
    for (size_t i = 0; i < k; i++)
        c->active[i] = true, c->soft[2 * i] = c->soft[2 * i + 1] = 1;
    c->system->piece_s = DBL_MIN; /* the piece of the laws that begins at 0 */
    const fw_multibody_pose *pose = fw_multibody_pose_at(c->system, 0, c->u);
    fw_multibody_residual(c->system, pose, c->psi);
    find_kept(c, pose);
    return FW_OK;
}

static double worst_gap(const fw_assembly_closure *c) {
    double worst = 0;
    for (int i = 0; i < c->model->nblock; i++) {
        double gap = hypot(c->psi[2 * i], c->psi[2 * i + 1]);
        if (c->active[i] && !(gap <= worst)) worst = gap; /* NaN too */
    }
    return worst;
}

double fw_assembly_closure_mismatch(fw_assembly_closure *c, const double *u,
                                    const fw_multibody_pose **pose) {
    const fw_multibody_pose *at = fw_multibody_pose_at(c->system, 0, u);
    double sum = 0;
    fw_multibody_residual(c->system, at, c->psi);
    if (pose) *pose = at;
    for (int i = 0; i < c->model->nblock; i++) {
        if (!c->active[i]) c->psi[2 * i] = c->psi[2 * i + 1] = 0;
        double x = c->psi[2 * i] / c->soft[2 * i], y = c->psi[2 * i + 1] / c->soft[2 * i + 1];
        sum += x * x + y * y;
    }
    return sum;
}

/* rows and columns of blocks that do not count become those of the unit matrix */
static void leave_out(const fw_assembly_closure *c) {
    const fw_multibody_chain *chain = &c->model->chain;
    for (int k = 0; k < chain->pins; k++) {
        double *d = c->chain.diagonal + 3 * k;
        if (!c->active[k]) d[0] = d[2] = 1, d[1] = 0;
        for (int e = chain->column[k]; e < chain->column[k + 1]; e++)
            if (!c->active[k] || !c->active[chain->row[e]])
                memset(c->chain.block + 4 * e, 0, 4 * sizeof *c->chain.block);
    }
}

/* step = -M^-1 G^T (S + mu s W)^-1 Psi, s the largest diagonal entry of S and W = soft^2: for every
   mu > 0 a descent direction of Psi^T W^-1 Psi, since with T = W^-1/2 S W^-1/2 its slope is -2 p^T
   T (T + mu s)^-1 p for p = W^-1/2 Psi. mu = 0: a proximal shift that goes down with Psi, because
   where a loop closes only just, S goes like Psi and a fixed shift would stop the descent. No body
   turns by more than half a radian or goes farther than the scene's length. */
static bool newton_step(fw_assembly_closure *c, double mu) {
    const fw_multibody_model *m = c->model;
    const fw_multibody_pose *pose;
    double *d = c->chain.diagonal, largest = 0;
    fw_assembly_closure_mismatch(c, c->u, &pose);
    double shift = fmax(1e-14, fmin(fw_epsilon, 1e-2 * worst_gap(c)));
    fw_multibody_chain_assemble(m, pose, &c->chain);
    leave_out(c);
    for (int i = 0; i < m->nblock; i++)
        if (c->active[i]) largest = fmax(largest, fmax(d[3 * i], d[3 * i + 2]));
    for (int i = 0; i < m->nblock && mu > 0; i++) {
        d[3 * i] += mu * largest * c->soft[2 * i] * c->soft[2 * i];
        d[3 * i + 2] += mu * largest * c->soft[2 * i + 1] * c->soft[2 * i + 1];
    }
    if (!fw_multibody_chain_factor(&m->chain, &c->chain, mu > 0 ? 0 : shift)) return false;
    memcpy(c->lambda, c->psi, 2 * (size_t)m->nblock * sizeof(double));
    fw_multibody_chain_solve(&m->chain, &c->chain, c->lambda);
    memset(c->step, 0, (size_t)m->nq * sizeof(double));
    fw_multibody_apply(m, pose, c->lambda, c->step);
    double most = 0;
    for (int i = 0; i < m->nq; i++) {
        double size = fabs(c->step[i]) / (i % 3 == 2 ? 0.5 : 1);
        if (!(size <= most)) most = size;
    }
    if (!(most < (double)INFINITY)) return false;
    for (int i = 0; i < m->nq && most > 1; i++)
        c->step[i] /= most;
    fw_multibody_jacobian(m, pose, c->step, c->lambda);
    c->promise = 0;
    for (int i = 0; i < 2 * m->nblock; i++)
        c->promise -= 2 * c->psi[i] * c->lambda[i] / (c->soft[i] * c->soft[i]);
    return c->promise > 0;
}

/* halves the step until the mismatch falls by a share of what its slope promises (Armijo); the
   share of the step that was taken, 0 when none descends */
static double line_search(fw_assembly_closure *c, double *value) {
    int n = c->model->nq;
    double fraction = 1;
    for (int halving = 0; halving < 12; halving++, fraction /= 2) {
        for (int i = 0; i < n; i++)
            c->trial[i] = c->u[i] + fraction * c->step[i];
        double next = fw_assembly_closure_mismatch(c, c->trial, NULL);
        if (next <= *value - 1e-4 * fraction * c->promise) {
            memcpy(c->u, c->trial, (size_t)n * sizeof(double));
            *value = next;
            return fraction;
        }
    }
    return 0;
}

/* damped Newton in the mass metric with a proximal term that grows where the plain step does not
   descend (near positions that cannot be assembled). Ends below 4 eps of the size, or when no step
   descends. Source: Levenberg 1944, Marquardt 1963; the mass metric as in multibody projection.
   Test: test_assemble.c. */
bool fw_assembly_closure_descend(fw_assembly_closure *c, int most) {
    static const double mu[] = {0, 1e-5, 1e-3, 1e-2, 1e-1, 1, 10, 100};
    const int levels = sizeof mu / sizeof mu[0];
    double value = fw_assembly_closure_mismatch(c, c->u, NULL);
    int level = 0, idle = 0;
    for (int i = 0; i < most && idle < 20 && c->left > 0; i++) {
        fw_assembly_closure_mismatch(c, c->u, NULL);
        if (worst_gap(c) <= c->goal) return true;
        double before = value;
        double taken = newton_step(c, mu[level]) ? line_search(c, &value) : 0;
        c->iterations++, c->left--;
        if (fw_arena_cancelled(c->arena)) c->left = 0;
        if (taken == 0 && level + 1 == levels) break;
        if (taken < 0.25 && level + 1 < levels)
            level++; /* short steps zigzag across a valley: damp */
        else if (taken == 1 && level > 0 && value < before - 0.5 * c->promise)
            level--;
        /* no progress: round-off, or the closest that an impossible mechanism comes */
        idle = value < (1 - 1e-7) * before ? 0 : idle + 1;
    }
    fw_assembly_closure_mismatch(c, c->u, NULL);
    return worst_gap(c) <= 1e-13 * c->model->size;
}

double fw_assembly_closure_distance(const fw_assembly_closure *c, const double *u) {
    const fw_multibody_model *m = c->model;
    double sum = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *v = u + 3 * b;
        sum += m->mass[b] * (v[0] * v[0] + v[1] * v[1]) + m->inertia[b] * v[2] * v[2];
    }
    return sum;
}

/* c->step = towards the point nearest to 0 on the tangent plane at the closed c->u */
static bool tangent_step(fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    const fw_multibody_pose *pose;
    fw_assembly_closure_mismatch(c, c->u, &pose);
    fw_multibody_jacobian(m, pose, c->u, c->lambda);
    for (int i = 0; i < 2 * m->nblock; i++)
        c->psi[i] -= c->lambda[i];
    fw_multibody_chain_assemble(m, pose, &c->chain);
    if (!fw_multibody_chain_factor(&m->chain, &c->chain, fw_epsilon)) return false;
    fw_multibody_chain_proximal(m, pose, &c->chain, c->psi, c->lambda);
    memset(c->step, 0, (size_t)m->nq * sizeof(double));
    fw_multibody_apply(m, pose, c->lambda, c->step);
    for (int i = 0; i < m->nq; i++)
        c->step[i] -= c->u[i];
    return true;
}

/* min u^T M u over Psi(u) = 0 from a closed u: steps to the nearest point of the tangent plane,
   each closed again by Newton, shortened until the distance falls. Every iterate is closed, so any
   of them is a valid answer. Converges linearly, fast where the guess is near. Source: Gauss-Newton
   with retraction; Absil, Mahony and Sepulchre 2008, ch. 4. Test: test_assemble.c (nearest). */
void fw_assembly_closure_nearest(fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    size_t bytes = (size_t)m->nq * sizeof(double);
    double distance = fw_assembly_closure_distance(c, c->u), *held = c->held;
    for (int i = 0; i < 100 && distance > 0; i++) {
        memcpy(held, c->u, bytes);
        if (!tangent_step(c)) return;
        double turned = 0, before = distance, fraction = 1;
        for (int k = 0; k < m->nq; k++)
            turned = fmax(turned, fabs(c->step[k]));
        if (!(turned > 1e-9)) return;
        memcpy(c->wanted, c->step, bytes); /* descending needs c->step */
        for (int halving = 0; halving < 8; halving++, fraction /= 2) {
            for (int k = 0; k < m->nq; k++)
                c->u[k] = held[k] + fraction * c->wanted[k];
            bool closed = fw_assembly_closure_descend(c, 12);
            double now = fw_assembly_closure_distance(c, c->u);
            if (closed && now < distance) {
                distance = now;
                break;
            }
            memcpy(c->u, held, bytes);
        }
        if (!(distance < before)) return; /* as near as the arithmetic can tell */
    }
}

/* bodies whose angles are held against each other turn together; group (nbody + 1) is work */
void fw_assembly_closure_unwind(const fw_assembly_closure *c, int *group) {
    const fw_multibody_model *m = c->model;
    const size_t n = (size_t)m->nbody;
    double *sum = c->held, *count = c->wanted; /* by group, whose number is one of its bodies */
    if (n == 0) return;
    for (int b = 0; b <= m->nbody; b++)
        group[b] = b;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *k = &m->block[i];
        if (k->rows != FW_ROWS_TURN && k->rows != FW_ROWS_SLIDE) continue;
        int from = group[k->a], to = group[k->b];
        for (int b = 0; b <= m->nbody; b++)
            if (group[b] == from) group[b] = to;
    }
    memset(sum, 0, (n + 1) * sizeof *sum);
    memset(count, 0, (n + 1) * sizeof *count);
    for (size_t b = 0; b < n; b++)
        sum[group[b]] += c->u[3 * b + 2], count[group[b]]++;
    for (size_t b = 0; b < n; b++) {
        if (group[b] == group[n]) continue; /* held by the ground */
        double turns = round(sum[group[b]] / count[group[b]] / (2 * FW_PI));
        if (turns != 0) c->u[3 * b + 2] -= turns * 2 * FW_PI;
    }
}

/* ---- other starts: the tree ---- */

/* A spanning tree of bodies from the ground, and placing a body where the joints to its parent
   close. */

static fw_status index_blocks(fw_arena *arena, const fw_multibody_model *m, fw_assembly_tree *t) {
    FW_NEED(t->first = fw_arena_array(arena, int, (size_t)m->nbody + 2));
    FW_NEED(t->item = fw_arena_array(arena, int, 2 * (size_t)m->nblock));
    for (int i = 0; i < 2 * m->nblock; i++)
        t->first[m->body[i] + 1]++;
    for (int b = 0; b <= m->nbody; b++)
        t->first[b + 1] += t->first[b];
    int *next;
    FW_NEED(next = fw_arena_array(arena, int, (size_t)m->nbody + 1));
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        t->item[t->first[b] + next[b]++] = i / 2;
    }
    return FW_OK;
}

/* joints from body b to bodies that stand, and the latest of those */
static int joints_to_placed(const fw_assembly_tree *t, const fw_multibody_model *m,
                            const int *place, int b, int *latest) {
    int count = 0;
    *latest = -1;
    for (int e = t->first[b]; e < t->first[b + 1]; e++) {
        const fw_multibody_block *k = &m->block[t->item[e]];
        int other = k->a == b ? k->b : k->a;
        if (other < m->nbody && place[other] < 0) continue;
        count++;
        if (place[other] > *latest) *latest = place[other];
    }
    return count;
}

/* what closes a loop comes first, then what hangs on the body placed last, then the heaviest: loops
   close one by one, each with few new bodies */
static int next_body(const fw_assembly_tree *t, const fw_multibody_model *m, const int *place) {
    int best = -1, best_joints = 0, best_latest = -1;
    for (int b = 0; b < m->nbody; b++) {
        int latest, joints;
        if (place[b] >= 0) continue;
        joints = joints_to_placed(t, m, place, b, &latest);
        joints = joints > 2 ? 2 : joints;
        bool better = best < 0                ? true
                      : joints != best_joints ? joints > best_joints
                      : latest != best_latest ? latest > best_latest
                                              : joints == 0 && m->mass[b] > m->mass[best];
        if (better) best = b, best_joints = joints, best_latest = latest;
    }
    return best;
}

/* rows of all blocks between two bodies: how much of a pose they settle */
static int rows_between(const fw_assembly_tree *t, const fw_multibody_model *m, int b, int other) {
    int rows = 0;
    for (int e = t->first[b]; e < t->first[b + 1]; e++) {
        const fw_multibody_block *k = &m->block[t->item[e]];
        if ((k->a == b ? k->b : k->a) != other) continue;
        rows += k->rows == FW_ROWS_PIN || k->rows == FW_ROWS_SLIDE ? 2 : 1;
    }
    return rows;
}

/* of the bodies that stand and are joined to b the one that settles most of its pose, among equals
   that of least depth; -1: none */
static int choose_parent(const fw_assembly_tree *t, const fw_multibody_model *m, const int *place,
                         const int *depth, int b) {
    int parent = -1, most = 0;
    for (int e = t->first[b]; e < t->first[b + 1]; e++) {
        const fw_multibody_block *k = &m->block[t->item[e]];
        int other = k->a == b ? k->b : k->a;
        if (other < m->nbody && place[other] < 0) continue;
        int rows = rows_between(t, m, b, other);
        if (rows > most || (rows == most && depth[other] < depth[parent]))
            parent = other, most = rows;
    }
    return parent;
}

/* inputs the blocks; outputs as in closure.h. Pieces that nothing holds start at their heaviest
   body. Cost O(bodies (bodies + blocks)). Test: test_assemble.c (hard guesses). */
static fw_status tree_new(fw_arena *arena, const fw_multibody_model *m, fw_assembly_tree *t) {
    size_t n = (size_t)m->nbody;
    int *place, *depth; /* in `order`; -1: not placed; the ground stands before all */
    FW_NEED(t->order = fw_arena_array(arena, int, n));
    FW_NEED(t->parent = fw_arena_array(arena, int, n + 1));
    FW_NEED(t->stage = fw_arena_array(arena, int, (size_t)m->nblock));
    FW_NEED(t->link = fw_arena_array(arena, bool, (size_t)m->nblock));
    FW_NEED(place = fw_arena_array(arena, int, n + 1));
    FW_NEED(depth = fw_arena_array(arena, int, n + 1));
    FW_TRY(index_blocks(arena, m, t));
    for (int b = 0; b <= m->nbody; b++)
        place[b] = -1, t->parent[b] = -1;
    for (int count = 0; count < m->nbody; count++) {
        int b = next_body(t, m, place);
        t->parent[b] = choose_parent(t, m, place, depth, b);
        depth[b] = t->parent[b] < 0 ? 0 : depth[t->parent[b]] + 1;
        place[b] = count;
        t->order[count] = b;
    }
    for (int i = 0; i < m->nblock; i++) {
        int a = m->body[2 * i], b = m->body[2 * i + 1];
        t->stage[i] = place[a] > place[b] ? place[a] : place[b];
        t->link[i] = t->parent[a] == b || t->parent[b] == a;
    }
    return FW_OK;
}

/* ---- other starts: placing ---- */

static double angle_of(const fw_multibody_model *m, const double *u, int body) {
    return body < m->nbody ? m->origin[3 * body + 2] + u[3 * body + 2] : 0;
}

static void point_of(const fw_multibody_model *m, const double *u, int body, const double *local,
                     double p[2]) {
    double angle = angle_of(m, u, body), c = cos(angle), s = sin(angle);
    p[0] = m->origin[3 * body] + c * local[0] - s * local[1];
    p[1] = m->origin[3 * body + 1] + s * local[0] + c * local[1];
    if (body < m->nbody) p[0] += u[3 * body], p[1] += u[3 * body + 1];
}

static void shift(fw_assembly_closure *c, int body, double x, double y) {
    c->u[3 * body] += x;
    c->u[3 * body + 1] += y;
}

/* angle, by the first block that keeps one */
static void turn_body(const fw_assembly_tree *t, fw_assembly_closure *c, int body, int parent) {
    const fw_multibody_model *m = c->model;
    for (int e = t->first[body]; e < t->first[body + 1]; e++) {
        int i = t->item[e];
        const fw_multibody_block *k = &m->block[i];
        if ((k->a != parent && k->b != parent) ||
            (k->rows != FW_ROWS_TURN && k->rows != FW_ROWS_SLIDE))
            continue;
        double other = parent < m->nbody ? c->u[3 * parent + 2] : 0;
        c->u[3 * body + 2] = other + (k->b == body ? c->kept[i] : -c->kept[i]);
        return;
    }
}

/* moves the body so that block i closes; rods keep their direction */
static void shift_body(fw_assembly_closure *c, int i, int body) {
    const fw_multibody_model *m = c->model;
    const fw_multibody_block *k = &m->block[i];
    double a[2], b[2], sign = k->b == body ? 1 : -1;
    point_of(m, c->u, k->a, m->local + 4 * i, a);
    point_of(m, c->u, k->b, m->local + 4 * i + 2, b);
    double dx = b[0] - a[0], dy = b[1] - a[1], turn = angle_of(m, c->u, k->a);
    double ex = cos(turn) * k->cos_axis - sin(turn) * k->sin_axis;
    double ey = sin(turn) * k->cos_axis + cos(turn) * k->sin_axis;
    if (k->rows == FW_ROWS_PIN) {
        shift(c, body, -sign * dx, -sign * dy);
    } else if (k->rows == FW_ROWS_SLIDE) {
        double off = ex * dy - ey * dx;
        shift(c, body, sign * off * ey, -sign * off * ex);
    } else if (k->rows == FW_ROWS_TRAVEL) {
        double more = c->kept[i] - (ex * dx + ey * dy);
        shift(c, body, sign * more * ex, sign * more * ey);
    } else if (k->rows == FW_ROWS_ROD) {
        double length = hypot(dx, dy);
        if (!(length > 1e-9 * m->size)) { /* any direction, so that G is defined */
            shift(c, body, sign * c->kept[i], 0);
            return;
        }
        double more = sign * (c->kept[i] / length - 1);
        shift(c, body, more * dx, more * dy);
    }
}

static void place(const fw_assembly_tree *t, fw_assembly_closure *c, int body) {
    const fw_multibody_model *m = c->model;
    int parent = t->parent[body];
    if (parent < 0) return;
    turn_body(t, c, body, parent);
    /* a pin says all about the position, a slide leaves the travel, a rod the direction */
    static const fw_multibody_rows order[] = {FW_ROWS_ROD, FW_ROWS_SLIDE, FW_ROWS_TRAVEL,
                                              FW_ROWS_PIN};
    for (size_t r = 0; r < sizeof order / sizeof order[0]; r++)
        for (int e = t->first[body]; e < t->first[body + 1]; e++) {
            const fw_multibody_block *k = &m->block[t->item[e]];
            if (k->rows == order[r] && (k->a == parent || k->b == parent))
                shift_body(c, t->item[e], body);
        }
}

/* ---- other starts: one after the other ---- */

enum { LOOP_TRIES = 40, WHOLE_TRIES = 6, LOOP_STEPS = 80, WHOLE_STEPS = 200 };

/* splitmix64 of both arguments (Steele, Lea and Flood 2014): no state, so a start does not depend
   on which others were tried */
double fw_assembly_spread(unsigned stream, unsigned index) {
    uint64_t z = ((uint64_t)stream << 32 | index) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

fw_status fw_assembly_restart_new(fw_arena *arena, const fw_multibody_model *m,
                                  fw_assembly_restart *r) {
    *r = (fw_assembly_restart){.value = (double)INFINITY};
    FW_TRY(tree_new(arena, m, &r->tree));
    FW_NEED(r->best = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(r->saved = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(r->wanted = fw_arena_array(arena, bool, (size_t)m->nblock));
    FW_NEED(r->loop = fw_arena_array(arena, bool, (size_t)m->nbody + 1));
    return FW_OK;
}

/* bodies from both ends of a block down to the root: the loop that it closes, and what leads to
   it */
static void mark_loop(fw_assembly_restart *r, const fw_multibody_model *m, int block) {
    for (int side = 0; side < 2; side++)
        for (int b = m->body[2 * block + side]; b >= 0 && b < m->nbody; b = r->tree.parent[b])
            r->loop[b] = true;
}

static void place_all(fw_assembly_restart *r, fw_assembly_closure *c, int count) {
    for (int i = 0; i < count; i++)
        place(&r->tree, c, r->tree.order[i]);
}

/* blocks between the first `count` bodies */
static void activate(fw_assembly_restart *r, fw_assembly_closure *c, int count) {
    for (int i = 0; i < c->model->nblock; i++)
        c->active[i] = r->wanted[i] && r->tree.stage[i] < count;
}

static bool closed(fw_assembly_closure *c) {
    fw_assembly_closure_mismatch(c, c->u, NULL);
    for (int i = 0; i < c->model->nblock; i++)
        if (!(hypot(c->psi[2 * i], c->psi[2 * i + 1]) <= c->goal)) return false;
    return true;
}

/* another pose of a body: turned by up to `radius`, and shifted by as many lengths of the scene,
   which counts where its joints leave a travel or a direction open */
static void disturb(fw_assembly_closure *c, int body, double radius, unsigned stream) {
    for (unsigned k = 0; k < 3; k++)
        c->u[3 * body + (int)k] +=
            radius * (2 * fw_assembly_spread(stream, 3 * (unsigned)body + k) - 1);
}

/* disturbs the bodies of the loop at hand, more with every try, and closes what is placed so far */
static bool close_loop(fw_assembly_restart *r, fw_assembly_closure *c, int count, unsigned stream) {
    const fw_multibody_model *m = c->model;
    memcpy(r->saved, c->u, (size_t)m->nq * sizeof(double));
    for (int i = 0; i < LOOP_TRIES && c->left > 0; i++) {
        if (i > 0) {
            bool all = i % 3 == 0; /* else only the bodies placed last */
            double radius = fmin(FW_PI, 0.4 * (1 + i / 4));
            memcpy(c->u, r->saved, (size_t)m->nq * sizeof(double));
            for (int k = all || count < 2 ? 0 : count - 2; k < count; k++)
                if (r->loop[r->tree.order[k]])
                    disturb(c, r->tree.order[k], radius, stream + (unsigned)i);
            place_all(r, c, count);
            r->restarts++;
        }
        if (fw_assembly_closure_descend(c, LOOP_STEPS)) return true;
    }
    return false;
}

/* one assembly from the poses in c->u: false leaves c->u where it came to */
static bool build_up(fw_assembly_restart *r, fw_assembly_closure *c, unsigned stream) {
    const fw_multibody_model *m = c->model;
    for (int count = 1; count <= m->nbody; count++) {
        place(&r->tree, c, r->tree.order[count - 1]);
        memset(r->loop, 0, (size_t)m->nbody + 1);
        for (int i = 0; i < m->nblock; i++)
            if (r->wanted[i] && r->tree.stage[i] == count - 1) mark_loop(r, m, i);
        activate(r, c, count);
        if (closed(c)) continue;
        if (!close_loop(r, c, count, stream + 64 * (unsigned)count)) {
            place_all(r, c, m->nbody);
            return false;
        }
    }
    return true;
}

static void keep_best(fw_assembly_restart *r, fw_assembly_closure *c) {
    double value = fw_assembly_closure_mismatch(c, c->u, NULL);
    if (!(value < r->value)) return;
    r->value = value;
    memcpy(r->best, c->u, (size_t)c->model->nq * sizeof(double));
}

/* the guess's orientations first, then orientations farther and farther from them; whatever does
   not close counts with its least mismatch */
bool fw_assembly_restart_close(fw_assembly_restart *r, fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    memcpy(r->wanted, c->active, (size_t)m->nblock * sizeof(bool));
    for (int i = 0; i < WHOLE_TRIES && c->left > 0; i++) {
        memset(c->u, 0, (size_t)m->nq * sizeof(double));
        unsigned stream = 100000u * (unsigned)i;
        for (int b = 0; b < m->nbody && i > 0; b++)
            disturb(c, b, FW_PI * i / (WHOLE_TRIES - 1), stream);
        r->restarts++;
        bool good = build_up(r, c, stream + 1);
        memcpy(c->active, r->wanted, (size_t)m->nblock * sizeof(bool));
        good = fw_assembly_closure_descend(c, WHOLE_STEPS);
        keep_best(r, c);
        if (good) return true;
    }
    r->cut = c->left <= 0;
    memcpy(c->u, r->best, (size_t)m->nq * sizeof(double));
    return false;
}
