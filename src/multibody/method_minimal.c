/* SPDX-License-Identifier: GPL-3.0-or-later */
/* minimal: the angles of the bodies that turn freely (multibody/multibody_scratch.h) are the coordinates; all
   other bodies follow one after another. With P the velocity that a pin's point has from the placed
   body, e the vector from there to the other pin of a body and J e = (-e_y, e_x),

   one body   v = P - w J s,           w independent or given by a turn
   loose      v and w independent: a body that only released pins hold
   dyad       w_1 J e_1 - w_2 J e_2 = h = P_2 - P_1:   w_1 = (h.e_2)/D, w_2 = (h.e_1)/D,
              D = e_1 x e_2

   which solves G v = r for any r, in O(bodies). So the columns of N (G N = 0, one per independent
   angle) and the part c with G c = -gamma come from the same sweep, and

       (N^T M N) z'' = N^T M (a0 - c),   a = c + N z'',   M = diag,

   lambda by the sweep backwards, from M (a0 - a) = G^T lambda. Positions: a dyad is where two
   circles meet, on the side where the guess lies; two Newton steps at most take the round-off of
   the square root away. Only the independent coordinates are integrated: the right-hand side is
   evaluated at closed states. Valid while no dyad is flat: |D| > 1e-9 |e_1| |e_2|, otherwise the
   step is refused. A mechanism that passes flat (a singular position) can be stepped over, not
   stopped at. Error: round-off times 1/sin of the angle between e_1 and e_2. Cost O(rates bodies +
   rates^3). Source: Kecskemethy, Krupp and Hiller 1997 (kinematic transformers); Garcia de
   Jalon and Bayo 1994, ch. 5 (velocity transformations). Test: test_minimal.c. */
#include "multibody/multibody_scratch.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double flat = 1e-9;

typedef struct minimal {
    fw_multibody_placing_plan plan;
    double *mass;        /* (nq) */
    double *n;           /* (nq x rates) N */
    double *reduced;     /* (rates x rates) Cholesky factor of N^T M N */
    double *rates;       /* (rates) */
    double *part;        /* (nq + 3) c, or a column of N; 0 for the ground */
    double *force;       /* (nq + 3) */
    double *right;       /* (2 nblock) */
    double *turn;        /* (steps) value of a turn */
    double *determinant; /* (steps) D of a dyad */
} minimal;

static fw_status prepare(fw_arena *arena, fw_multibody_system *sys, const fw_mechanism *mechanism,
                         fw_diags *diags) {
    minimal *p;
    FW_NEED(p = fw_arena_one(arena, minimal));
    const fw_multibody_model *m = sys->model;
    FW_TRY(fw_multibody_placing_find(arena, m, mechanism, diags, &p->plan));
    size_t nq = (size_t)m->nq, rates = (size_t)p->plan.rates;
    FW_NEED(p->mass = fw_arena_array(arena, double, nq));
    FW_NEED(p->n = fw_arena_array(arena, double, nq *rates));
    FW_NEED(p->reduced = fw_arena_array(arena, double, rates *rates));
    FW_NEED(p->rates = fw_arena_array(arena, double, rates));
    FW_NEED(p->part = fw_arena_array(arena, double, nq + 3));
    FW_NEED(p->force = fw_arena_array(arena, double, nq + 3));
    FW_NEED(p->right = fw_arena_array(arena, double, 2 * (size_t)m->nblock));
    FW_NEED(p->turn = fw_arena_array(arena, double, (size_t)p->plan.count));
    FW_NEED(p->determinant = fw_arena_array(arena, double, (size_t)p->plan.count));
    for (int b = 0; b < m->nbody; b++) {
        p->mass[3 * b] = p->mass[3 * b + 1] = 1 / m->minv[b];
        p->mass[3 * b + 2] = 1 / m->jinv[b];
    }
    FW_TRY(fw_maths_lapack_ready());
    sys->work->method = p;
    return FW_OK;
}

static const double *arm_of(const fw_multibody_model *m, const fw_multibody_pose *pose, int block,
                            int body) {
    return pose->arm + 4 * block + 2 * fw_multibody_side(m, block, body);
}

static double sign_of(const fw_multibody_model *m, int block, int body) { /* rows are a - b */
    return fw_multibody_side(m, block, body) == 0 ? 1 : -1;
}

static double cross(const double a[2], const double b[2]) {
    return a[0] * b[1] - a[1] * b[0];
}

/* from the pin that holds body i of a dyad to the pin between the two */
static void dyad_vector(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        const fw_multibody_placing *s, int i, double e[2]) {
    const double *from = arm_of(m, pose, s->block[2 * i], s->body[i]);
    const double *to = arm_of(m, pose, s->block[1], s->body[i]);
    e[0] = to[0] - from[0], e[1] = to[1] - from[1];
}

/* ---- G d = right ---- */

/* velocity that a body must have at a pin to a placed one */
static void point_rate(const fw_multibody_model *m, const fw_multibody_pose *pose, const double *d,
                       const double *right, int block, int body, double rate[2]) {
    int other = fw_multibody_across(m, block, body);
    const double *v = d + 3 * other, *s = arm_of(m, pose, block, other);
    double sign = sign_of(m, block, body);
    rate[0] = v[0] - v[2] * s[1] + sign * right[2 * block];
    rate[1] = v[1] + v[2] * s[0] + sign * right[2 * block + 1];
}

static void set_rate(const fw_multibody_model *m, const fw_multibody_pose *pose, double *d,
                     int block, int body, const double point[2], double turn) {
    const double *s = arm_of(m, pose, block, body);
    d[3 * body] = point[0] + turn * s[1];
    d[3 * body + 1] = point[1] - turn * s[0];
    d[3 * body + 2] = turn;
}

static void sweep_dyad(const fw_multibody_model *m, const fw_multibody_pose *pose,
                       const fw_multibody_placing *s, double determinant, const double *right,
                       double *d) {
    double p[2][2], e[2][2];
    for (int i = 0; i < 2; i++) {
        point_rate(m, pose, d, right, s->block[2 * i], s->body[i], p[i]);
        dyad_vector(m, pose, s, i, e[i]);
    }
    double sign = sign_of(m, s->block[1], s->body[0]);
    const double h[2] = {p[1][0] - p[0][0] + sign * right[2 * s->block[1]],
                         p[1][1] - p[0][1] + sign * right[2 * s->block[1] + 1]};
    double w[2] = {(h[0] * e[1][0] + h[1] * e[1][1]) / determinant,
                   (h[0] * e[0][0] + h[1] * e[0][1]) / determinant};
    for (int i = 0; i < 2; i++)
        set_rate(m, pose, d, s->block[2 * i], s->body[i], p[i], w[i]);
}

/* d (nq + 3) with G d = right, the independent angles at `rates` */
static void sweep(const fw_multibody_model *m, const fw_multibody_pose *pose, const minimal *p,
                  const double *right, const double *rates, double *d) {
    for (int i = 0; i < p->plan.count; i++) {
        const fw_multibody_placing *s = &p->plan.step[i];
        if (s->dyad) {
            sweep_dyad(m, pose, s, p->determinant[i], right, d);
            continue;
        }
        int body = s->body[0];
        double point[2], turn = 0;
        if (s->loose) {
            for (int k = 0; k < 3; k++)
                d[3 * body + k] = rates ? rates[s->rate + k] : 0;
            continue;
        }
        if (s->rate != FW_NONE) turn = rates ? rates[s->rate] : 0;
        if (s->turn != FW_NONE) /* row: w_b - w_a */
            turn = d[3 * fw_multibody_across(m, s->turn, body) + 2] -
                   sign_of(m, s->turn, body) * right[2 * s->turn];
        point_rate(m, pose, d, right, s->block[0], body, point);
        set_rate(m, pose, d, s->block[0], body, point, turn);
    }
}

/* ---- factor: N and N^T M N at the pose ---- */

static bool determinants(const fw_multibody_model *m, const fw_multibody_pose *pose, minimal *p) {
    for (int i = 0; i < p->plan.count; i++) {
        const fw_multibody_placing *s = &p->plan.step[i];
        double e[2][2];
        if (!s->dyad) continue;
        for (int k = 0; k < 2; k++)
            dyad_vector(m, pose, s, k, e[k]);
        p->determinant[i] = cross(e[0], e[1]);
        double size = hypot(e[0][0], e[0][1]) * hypot(e[1][0], e[1][1]);
        if (!(fabs(p->determinant[i]) > flat * size)) return false;
    }
    return true;
}

static bool factor(fw_multibody_system *sys, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = sys->model;
    minimal *p = sys->work->method;
    size_t nq = (size_t)m->nq;
    int rates = p->plan.rates;
    if (!determinants(m, pose, p)) return false;
    memset(p->right, 0, 2 * (size_t)m->nblock * sizeof *p->right);
    memset(p->rates, 0, (size_t)rates * sizeof *p->rates);
    for (int k = 0; k < rates; k++) {
        p->rates[k] = 1;
        sweep(m, pose, p, p->right, p->rates, p->part);
        p->rates[k] = 0;
        memcpy(p->n + (size_t)k * nq, p->part, nq * sizeof *p->part);
    }
    for (int k = 0; k < rates; k++)
        for (int l = k; l < rates; l++) {
            const double *a = p->n + (size_t)k * nq, *b = p->n + (size_t)l * nq;
            double sum = 0;
            for (size_t j = 0; j < nq; j++)
                sum += p->mass[j] * a[j] * b[j];
            p->reduced[l + k * rates] = sum;
        }
    return rates == 0 || (isfinite(p->reduced[0]) && fw_maths_cholesky(rates, p->reduced));
}

/* ---- multipliers ---- */

/* takes the force of a pin on `body` off the body across */
static void pass_on(const fw_multibody_model *m, const fw_multibody_pose *pose, int block, int body,
                    const double pull[2], double *force) {
    int other = fw_multibody_across(m, block, body);
    const double *s = arm_of(m, pose, block, other);
    force[3 * other] += pull[0];
    force[3 * other + 1] += pull[1];
    force[3 * other + 2] += cross(s, pull);
}

static void set_lambda(const fw_multibody_model *m, int block, int body, const double pull[2],
                       double *lambda) {
    double sign = sign_of(m, block, body);
    lambda[2 * block] = sign * pull[0];
    lambda[2 * block + 1] = sign * pull[1];
}

static void dyad_lambda(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        const fw_multibody_placing *s, double determinant, double *force,
                        double *lambda) {
    double e[2][2], moment[2];
    for (int i = 0; i < 2; i++) { /* about the pin that holds it */
        const double *f = force + 3 * s->body[i];
        dyad_vector(m, pose, s, i, e[i]);
        moment[i] = f[2] - cross(arm_of(m, pose, s->block[2 * i], s->body[i]), f);
    }
    /* middle: on body[0]; e_1 x middle = moment_1, -e_2 x middle = moment_2 */
    const double middle[2] = {(moment[0] * e[1][0] + moment[1] * e[0][0]) / determinant,
                              (moment[0] * e[1][1] + moment[1] * e[0][1]) / determinant};
    set_lambda(m, s->block[1], s->body[0], middle, lambda);
    for (int i = 0; i < 2; i++) {
        const double *f = force + 3 * s->body[i], to = i == 0 ? -1 : 1;
        const double pull[2] = {f[0] + to * middle[0], f[1] + to * middle[1]};
        set_lambda(m, s->block[2 * i], s->body[i], pull, lambda);
        pass_on(m, pose, s->block[2 * i], s->body[i], pull, force);
    }
}

/* G^T lambda = force (nq + 3, used up), last placed first */
static void multipliers(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        const minimal *p, double *force, double *lambda) {
    for (int i = p->plan.count - 1; i >= 0; i--) {
        const fw_multibody_placing *s = &p->plan.step[i];
        if (s->dyad) {
            dyad_lambda(m, pose, s, p->determinant[i], force, lambda);
            continue;
        }
        if (s->loose) continue; /* nothing pulls at it */
        const double *f = force + 3 * s->body[0];
        double left = f[2] - cross(arm_of(m, pose, s->block[0], s->body[0]), f);
        if (s->turn != FW_NONE) { /* row: on b +lambda, on a -lambda */
            lambda[2 * s->turn] = -sign_of(m, s->turn, s->body[0]) * left;
            lambda[2 * s->turn + 1] = 0;
            force[3 * fw_multibody_across(m, s->turn, s->body[0]) + 2] += left;
        }
        set_lambda(m, s->block[0], s->body[0], f, lambda);
        pass_on(m, pose, s->block[0], s->body[0], f, force);
    }
}

static void accelerate(fw_multibody_system *sys, const fw_multibody_factor *at, const double *gamma,
                       double *a, double *lambda) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = at->pose;
    minimal *p = sys->work->method;
    size_t nq = (size_t)m->nq;
    int rates = p->plan.rates;
    for (int i = 0; i < 2 * m->nblock; i++)
        p->right[i] = -gamma[i];
    sweep(m, pose, p, p->right, NULL, p->part);
    for (int k = 0; k < rates; k++) {
        const double *n = p->n + (size_t)k * nq;
        p->rates[k] = 0;
        for (size_t j = 0; j < nq; j++)
            p->rates[k] += n[j] * p->mass[j] * (a[j] - p->part[j]);
    }
    if (rates > 0 && !fw_maths_cholesky_solve(rates, p->reduced, p->rates))
        p->rates[0] = (double)NAN;
    sweep(m, pose, p, p->right, p->rates, p->part);
    memset(p->force, 0, (nq + 3) * sizeof *p->force);
    for (size_t j = 0; j < nq; j++) {
        p->force[j] = p->mass[j] * (a[j] - p->part[j]);
        a[j] = p->part[j];
    }
    multipliers(m, pose, p, p->force, lambda);
}

/* the independent angles stay */
static void correct(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *r,
                    double *d) {
    const fw_multibody_model *m = sys->model;
    minimal *p = sys->work->method;
    for (int i = 0; i < 2 * m->nblock; i++)
        p->right[i] = -r[i];
    sweep(m, pose, p, p->right, NULL, p->part);
    memcpy(d, p->part, (size_t)m->nq * sizeof *d);
}

/* ---- positions: bodies are placed one after the other, their sines with them ---- */

static void turn_arms(const fw_multibody_system *sys, const fw_multibody_placing *s, int i,
                      const double *u) {
    int body = s->body[i];
    sincos(sys->model->origin[3 * body + 2] + u[3 * body + 2], &sys->work->sine[body],
           &sys->work->cosine[body]);
}

static void arm_at(const fw_multibody_system *sys, int block, int body, double arm[2]) {
    const fw_multibody_model *m = sys->model;
    const double *local = m->local + 4 * block + 2 * fw_multibody_side(m, block, body);
    double c = sys->work->cosine[body], s = sys->work->sine[body];
    arm[0] = c * local[0] - s * local[1];
    arm[1] = s * local[0] + c * local[1];
}

/* displacement of a body plus its arm at a pin, from the placed body across */
static void point_at(const fw_multibody_system *sys, const double *u, int block, int body,
                     double point[2]) {
    const fw_multibody_model *m = sys->model;
    const double *offset = sys->work->pose.offset + 2 * block;
    int other = fw_multibody_across(m, block, body);
    double arm[2], sign = sign_of(m, block, body);
    arm_at(sys, block, other, arm);
    for (int k = 0; k < 2; k++)
        point[k] = arm[k] - sign * offset[k] + (other < m->nbody ? u[3 * other + k] : 0);
}

static void put(const fw_multibody_system *sys, const fw_multibody_placing *s, int i,
                const double point[2], double *u) {
    double arm[2];
    int body = s->body[i];
    turn_arms(sys, s, i, u);
    arm_at(sys, s->block[2 * i], body, arm);
    u[3 * body] = point[0] - arm[0];
    u[3 * body + 1] = point[1] - arm[1];
}

/* e_1 - e_2 = h with the lengths of the e: two circles, the side of the guess. The bodies turn by
   the angles between the guessed and the found vectors. false: out of reach, or flat. */
static bool close_dyad(const fw_multibody_system *sys, const fw_multibody_placing *s, double *u) {
    const fw_multibody_model *m = sys->model;
    double point[2][2], guess[2][2], e[2][2];
    for (int i = 0; i < 2; i++) {
        double from[2], to[2];
        point_at(sys, u, s->block[2 * i], s->body[i], point[i]);
        arm_at(sys, s->block[2 * i], s->body[i], from);
        arm_at(sys, s->block[1], s->body[i], to);
        guess[i][0] = to[0] - from[0], guess[i][1] = to[1] - from[1];
    }
    double sign = sign_of(m, s->block[1], s->body[0]), h[2];
    for (int k = 0; k < 2; k++)
        h[k] = point[1][k] - point[0][k] - sign * sys->work->pose.offset[2 * s->block[1] + k];
    double far = hypot(h[0], h[1]);
    double l1 = guess[0][0] * guess[0][0] + guess[0][1] * guess[0][1];
    double l2 = guess[1][0] * guess[1][0] + guess[1][1] * guess[1][1];
    double x = (l1 - l2 + far * far) / (2 * far), y2 = l1 - x * x;
    if (!(far > 0) || !(y2 > 0)) return false;
    double side = cross(h, guess[0]) + cross(h, guess[1]);
    double y = side < 0 ? -sqrt(y2) : sqrt(y2);
    const double along[2] = {h[0] / far, h[1] / far};
    e[0][0] = x * along[0] - y * along[1];
    e[0][1] = x * along[1] + y * along[0];
    for (int k = 0; k < 2; k++)
        e[1][k] = e[0][k] - h[k];
    for (int i = 0; i < 2; i++) {
        u[3 * s->body[i] + 2] +=
            atan2(cross(guess[i], e[i]), guess[i][0] * e[i][0] + guess[i][1] * e[i][1]);
        put(sys, s, i, point[i], u);
    }
    return true;
}

static double rotation(const fw_multibody_model *m, const double *u, int body) {
    return body < m->nbody ? u[3 * body + 2] : 0;
}

/* what the turns keep now: angle of b less that of a, counted from the origin */
static void turn_values(const fw_multibody_model *m, minimal *p, const double *u,
                        const double *psi) {
    for (int i = 0; i < p->plan.count; i++) {
        int turn = p->plan.step[i].turn;
        if (turn == FW_NONE) continue;
        p->turn[i] = rotation(m, u, m->body[2 * turn + 1]) - rotation(m, u, m->body[2 * turn]) -
                     psi[2 * turn];
    }
}

static bool place_all(const fw_multibody_system *sys, const minimal *p, double *u) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < p->plan.count; i++) {
        const fw_multibody_placing *s = &p->plan.step[i];
        if (s->dyad) {
            if (!close_dyad(sys, s, u)) return false;
            continue;
        }
        int body = s->body[0];
        double point[2];
        if (s->loose) continue; /* stays, and is posed */
        if (s->turn != FW_NONE)
            u[3 * body + 2] = rotation(m, u, fw_multibody_across(m, s->turn, body)) -
                              sign_of(m, s->turn, body) * p->turn[i];
        point_at(sys, u, s->block[0], body, point);
        put(sys, s, 0, point, u);
    }
    return true;
}

static const fw_multibody_pose *close(fw_multibody_system *sys, double t, double *u) {
    const fw_multibody_model *m = sys->model;
    minimal *p = sys->work->method;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, u);
    double norm = fw_multibody_residual(sys, pose, p->right);
    if (!(norm < (double)INFINITY)) return NULL;
    turn_values(m, p, u, p->right);
    if (!place_all(sys, p, u)) return NULL;
    for (int i = 0;; i++) {
        pose = fw_multibody_pose_at(sys, t, u);
        norm = fw_multibody_residual(sys, pose, p->right);
        if (!(norm < (double)INFINITY)) return NULL;
        if (norm <= 2 * DBL_EPSILON * m->size || i == 2) break;
        if (!determinants(m, pose, p)) return NULL;
        for (int k = 0; k < 2 * m->nblock; k++)
            p->right[k] = -p->right[k];
        sweep(m, pose, p, p->right, NULL, p->part);
        for (int j = 0; j < m->nq; j++)
            u[j] += p->part[j];
    }
    return norm <= 1e-12 ? pose : NULL;
}

static fw_status report(const fw_multibody_system *sys, const fw_mechanism *mechanism,
                        fw_text *out) {
    static const char *const axis[] = {"x", "y", "phi"};
    const minimal *p = sys->work->method;
    int dyads = 0;
    for (int i = 0; i < p->plan.count; i++)
        dyads += p->plan.step[i].dyad;
    fw_text_add(out, p->plan.rates > 0 ? "independent coordinates: " : "no independent coordinate");
    for (int k = 0; k < p->plan.rates; k++)
        fw_text_printf(out, "%s%s.%s", k > 0 ? ", " : "", mechanism->body[p->plan.rate_body[k]].id,
                       axis[p->plan.rate_axis[k]]);
    fw_text_printf(out, "; %d dyad%s closed", dyads, dyads == 1 ? "" : "s");
    return fw_text_end(out);
}

const fw_multibody_method fw_multibody_method_minimal = {
    .name = "minimal",
    .independent = true,
    .summary =
        "independent angles, loops closed dyad by dyad; only for pins, and not at flat dyads",
    .source = "Kecskemethy, Krupp and Hiller 1997; Garcia de Jalon and Bayo 1994",
    .cost = {27000, 1},
    .prepare = prepare,
    .factor = factor,
    .accelerate = accelerate,
    .correct = correct,
    .close = close,
    .closes_stages = true,
    .report = report,
};
