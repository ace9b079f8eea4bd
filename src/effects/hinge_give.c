/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far ideal pins are from hinges that give, in linear theory about the drawn pose. Pinned, the
   pins carry forces l0(t), |l0_i| <= envelope->force[i]. With pins that give and drift, what is
   added to the motion, e, obeys exactly

     M e'' + Kc e = G^T s,   s_i = l0_i + k_i drift_i

   with Kc the stiffness of all elements and G^T s_i the force s_i on body b and its opposite on
   body a at pin i. With A = Kc^-1: slowly          e = A G^T s: turned_j <= sum_i |t_j A G_i^T|
   s_i, t_j: rotation of pin j at once         twice that, over 1 - r for the frequencies of the
   pinned motion, r = (largest pinned frequency / least one at which the pins vibrate)^2; only where
   r < 1/4 softening       the pinned flexibility is F0 = Q W^-2 Q^T in modes Q (W: omega); A - F0
   >= 0 is what the pins add, in the modes |W Q^T M A M Q W - 1| (Frobenius) second order    forces
   through the drift soften the rotation by l drift''/k; the place of W gives them an arm, couples
   s_i give_i Inputs SI from the envelope; outputs rad, m, relative. Not valid for loads that go
   with time (they may meet the pins' own vibrations), other joints, springs. Cost: (3 nbody)^3 and
   an eigenvalue problem. Source: docs/theory/effects/nonlinear-hinge.md. Test: test_hinge_give.c
   (motions of a lever and a six-bar with and without). */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "maths/lapack.h"
#include <math.h>
#include <string.h>

typedef struct work {
    const fw_effect_case *c;
    int n;
    double *stiffness; /* (n x n) then its Cholesky factor */
    double *answer;    /* (2 npin x n) A G_i^T for forces along x and y at every pin */
    double *couple;    /* (n) work */
    double *push;      /* (npin) s_i */
} work;

/* what in the scene the theory above has no place for */
static const char *outside(const fw_effect_case *c) {
    const fw_mechanism *m = c->mechanism;
    const fw_scene *s = c->scene;
    if (!c->envelope->valid) return "how large the motion becomes is not known: kept";
    if (m->ntie > 0 || m->nspring > 0 || m->nhinge != m->npin)
        return "other joints or springs besides the flexures: kept";
    for (int i = 0; i < m->nhinge; i++)
        if (!fw_hinge_is_known(&m->hinge[i])) return "a flexure is not drawn: kept";
    if (fw_effect_not_proportional(c) || s->nbase + s->ncomb + s->ntendon + s->ntemperature > 0)
        return "loads that change with time may meet the frequencies at which the hinges give: "
               "kept";
    return NULL;
}

/* Kc at the drawn pose */
static fw_status assemble(work *w) {
    const fw_effect_case *c = w->c;
    const fw_mechanism *m = c->mechanism;
    fw_terms terms;
    double *q, *force, p[6], v[6], f[6], k[36], d[36];
    FW_NEED(q = fw_arena_array(c->arena, double, (size_t)w->n));
    FW_NEED(force = fw_arena_array(c->arena, double, (size_t)w->n));
    FW_TRY(fw_terms_new(c->arena, m, c->scene, &terms));
    for (int i = 0; i < m->nhinge; i++)
        FW_TRY(fw_hinge_release(c, &terms, i));
    for (int b = 0; b < m->nbody; b++)
        q[3 * b] = m->body[b].x_m, q[3 * b + 1] = m->body[b].y_m, q[3 * b + 2] = m->body[b].phi_rad;
    for (int i = 0; i < terms.nelement; i++) {
        const fw_force_element *e = &terms.element[i];
        const fw_seen s = {.load = 1, .p = p, .w = v};
        fw_element_look(e, q, NULL, p, v);
        e->class_->force(e, &s, f);
        e->class_->tangent(e, &s, k, d);
        fw_element_spread(e, m->nbody, q, NULL, f, k, d, w->stiffness, NULL);
    }
    return FW_OK;
}

/* generalised force of (fx, fy) on body b and the opposite on body a at a pin */
static void pull_pin(const fw_mechanism *m, int pin, double fx, double fy, double *force) {
    const fw_pin *p = &m->pin[pin];
    for (int side = 0; side < 2; side++) {
        int b = side ? p->body_b : p->body_a;
        double o = side ? 1 : -1;
        if (b == FW_GROUND) continue;
        fw_vec2 at = fw_pin_place(m, p, side);
        double rx = at.x - m->body[b].x_m, ry = at.y - m->body[b].y_m;
        force[3 * b] += o * fx, force[3 * b + 1] += o * fy;
        force[3 * b + 2] += o * (rx * fy - ry * fx);
    }
}

static double turn_of(const fw_mechanism *m, int pin, const double *q) {
    int a = m->pin[pin].body_a, b = m->pin[pin].body_b;
    return (b == FW_GROUND ? 0 : q[3 * b + 2]) - (a == FW_GROUND ? 0 : q[3 * a + 2]);
}

/* displacement q opens a pin by this along (fx, fy): G q */
static double opening(const work *w, int pin, int along, const double *q) {
    double sum = 0;
    memset(w->couple, 0, (size_t)w->n * sizeof(double));
    pull_pin(w->c->mechanism, pin, along == 0, along == 1, w->couple);
    for (int i = 0; i < w->n; i++)
        sum += w->couple[i] * q[i];
    return sum;
}

/* largest of drift, its second derivative and |k'/k| within the angles that the envelope allows */
typedef struct worst {
    double drift_m, curve_m, stiffness_N_per_m, change_per_rad;
} worst;

static worst worst_of(const fw_hinge_law *law, double angle_rad) {
    enum { STEPS = 16 };
    worst w = {0, 0, 0, 0};
    for (int i = -STEPS; i <= STEPS; i++) {
        fw_hinge_at at;
        fw_hinge_law_at(law, angle_rad * i / STEPS, &at);
        w.drift_m = fmax(w.drift_m, fabs(at.drift_m.value));
        w.curve_m = fmax(w.curve_m, fabs(at.drift_m.curve));
        w.stiffness_N_per_m =
            fmax(w.stiffness_N_per_m, fmax(at.kx_N_per_m.value, at.ky_N_per_m.value));
        w.change_per_rad =
            fmax(w.change_per_rad, fmax(fabs(at.kx_N_per_m.slope) / at.kx_N_per_m.value,
                                        fabs(at.ky_N_per_m.slope) / at.ky_N_per_m.value));
    }
    return w;
}

/* |W Q^T M A M Q W - 1| */
static fw_status soften(const work *w, double *softening) {
    const fw_effect_case *c = w->c;
    const fw_envelope *v = c->envelope;
    double sum = 0, *x;
    FW_NEED(x = fw_arena_array(c->arena, double, (size_t)w->n));
    for (int j = 0; j < v->modes; j++) {
        for (int i = 0; i < w->n; i++) {
            const fw_mass *b = &c->mechanism->body[i / 3];
            x[i] = (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * v->shape[j * w->n + i];
        }
        if (!fw_cholesky_solve(w->n, w->stiffness, x)) return FW_SOLVER;
        for (int k = 0; k < v->modes; k++) {
            double dot = 0;
            for (int i = 0; i < w->n; i++) {
                const fw_mass *b = &c->mechanism->body[i / 3];
                dot += (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * v->shape[k * w->n + i] * x[i];
            }
            double off = v->omega[j] * v->omega[k] * dot - (j == k);
            sum += off * off;
        }
    }
    *softening = sqrt(sum);
    return FW_OK;
}

/* (largest pinned frequency / least one of the pins' own vibrations)^2; infinite where unknown */
static fw_status closeness(const work *w, double *ratio) {
    const fw_effect_case *c = w->c;
    const fw_envelope *v = c->envelope;
    fw_lapack_space space;
    double *a, *value;
    *ratio = (double)INFINITY;
    if (v->modes >= w->n || v->modes < 1) return FW_OK;
    FW_NEED(a = fw_arena_array(c->arena, double, (size_t)w->n *(size_t)w->n));
    FW_NEED(value = fw_arena_array(c->arena, double, (size_t)w->n));
    FW_TRY(fw_eigen_space(c->arena, w->n, &space));
    for (int i = 0; i < w->n; i++)
        for (int j = 0; j < w->n; j++) {
            const fw_mass *p = &c->mechanism->body[i / 3], *q = &c->mechanism->body[j / 3];
            double mi = i % 3 == 2 ? p->inertia_kg_m2 : p->mass_kg;
            double mj = j % 3 == 2 ? q->inertia_kg_m2 : q->mass_kg;
            a[i * w->n + j] = w->stiffness[i * w->n + j] / sqrt(mi * mj);
        }
    if (!fw_eigen(w->n, a, value, &space) || !(value[v->modes] > 0)) return FW_OK;
    *ratio = v->omega[v->modes - 1] * v->omega[v->modes - 1] / value[v->modes];
    return FW_OK;
}

/* rotation of pin j and opening of pin j by unit forces at pin i, for the worst direction */
static double turned_by(const work *w, int j, int i) {
    const double *x = w->answer + (size_t)(2 * i) * (size_t)w->n;
    return hypot(turn_of(w->c->mechanism, j, x), turn_of(w->c->mechanism, j, x + w->n));
}

static double opened_by(const work *w, int j, int i) {
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double *x = w->answer + (size_t)(2 * i + k % 2) * (size_t)w->n;
        double o = opening(w, j, k / 2, x);
        sum += o * o;
    }
    return sqrt(sum);
}

/* what the arm of the forces at the displaced W turns: a couple on both bodies of pin i, and one
   between them where the stiffness depends on the angle */
static fw_status add_couples(work *w, int i, double couple, double between, double *turned) {
    const fw_mechanism *m = w->c->mechanism;
    int body[2] = {m->pin[i].body_a, m->pin[i].body_b};
    for (int side = 0; side < 2; side++) {
        if (body[side] == FW_GROUND) continue;
        memset(w->couple, 0, (size_t)w->n * sizeof(double));
        w->couple[3 * body[side] + 2] = 1;
        if (!fw_cholesky_solve(w->n, w->stiffness, w->couple)) return FW_SOLVER;
        for (int j = 0; j < m->npin; j++)
            turned[j] += (0.5 * couple + between) * fabs(turn_of(m, j, w->couple));
    }
    return FW_OK;
}

static fw_status find(work *w, fw_hinge_give *give) {
    const fw_effect_case *c = w->c;
    const fw_mechanism *m = c->mechanism;
    double ratio, *turned;
    FW_NEED(turned = fw_arena_array(c->arena, double, (size_t)m->npin));
    FW_TRY(closeness(w, &ratio));
    if (!(ratio < 0.25)) {
        give->why_not = "the hinges give at frequencies near those of the motion: kept";
        return FW_OK;
    }
    if (!fw_cholesky(w->n, w->stiffness)) {
        give->why_not = "the mechanism has no stiffness: kept";
        return FW_OK;
    }
    for (int i = 0; i < 2 * m->npin; i++) {
        double *x = w->answer + (size_t)i * (size_t)w->n;
        pull_pin(m, i / 2, i % 2 == 0, i % 2 == 1, x);
        if (!fw_cholesky_solve(w->n, w->stiffness, x)) return FW_SOLVER;
    }
    FW_TRY(soften(w, &give->softening));
    double at_once = 2 / (1 - ratio) * (1 + give->softening), most = 0;
    for (int h = 0; h < m->nhinge; h++) {
        int i = m->hinge[h].pin;
        worst x = worst_of(&m->hinge[h].law, c->envelope->angle[i]);
        w->push[i] = c->envelope->force[i] + x.stiffness_N_per_m * x.drift_m;
        most = fmax(most, c->envelope->force[i] * x.curve_m / m->pin[i].stiffness_Nm_per_rad);
    }
    give->softening += most;
    for (int i = 0; i < m->npin; i++)
        for (int j = 0; j < m->npin; j++) {
            give->give_m[j] += at_once * opened_by(w, j, i) * w->push[i];
            turned[j] += turned_by(w, j, i) * w->push[i];
        }
    for (int h = 0; h < m->nhinge; h++) {
        int i = m->hinge[h].pin;
        double work_J = w->push[i] * give->give_m[i];
        worst x = worst_of(&m->hinge[h].law, c->envelope->angle[i]);
        FW_TRY(add_couples(w, i, work_J, 0.5 * x.change_per_rad * work_J, turned));
    }
    for (int j = 0; j < m->npin; j++)
        give->turned_rad = fmax(give->turned_rad, at_once * turned[j]);
    return FW_OK;
}

fw_status fw_hinge_give_find(const fw_effect_case *c, fw_hinge_give *give) {
    const fw_mechanism *m = c->mechanism;
    work w = {.c = c, .n = 3 * m->nbody};
    *give = (fw_hinge_give){.why_not = outside(c)};
    FW_NEED(give->give_m = fw_arena_array(c->arena, double, (size_t)m->npin));
    if (!give->why_not && w.n > FW_RESPONSE_MOST) give->why_not = "too many bodies: kept";
    if (give->why_not) return FW_OK;
    size_t n = (size_t)w.n;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(w.stiffness = fw_arena_array(c->arena, double, n *n));
    FW_NEED(w.answer = fw_arena_array(c->arena, double, 2 * (size_t)m->npin * n));
    FW_NEED(w.couple = fw_arena_array(c->arena, double, n));
    FW_NEED(w.push = fw_arena_array(c->arena, double, (size_t)m->npin));
    FW_TRY(assemble(&w));
    FW_TRY(find(&w, give));
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}
