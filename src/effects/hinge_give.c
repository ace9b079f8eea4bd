/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far ideal pins are from hinges that give, in linear theory about the drawn pose. Pinned, the
   pins carry forces l0(t), |l0_i| <= envelope->force[i]. With pins that give and drift, what is
   added to the motion, e, obeys exactly

     M e'' + Kc e = G^T s,   s_i = l0_i + k_i drift_i

   with Kc the stiffness of all hinges and G^T s_i the force s_i on body b and its opposite on body
   a at pin i. In the modes f_m of (Kc, M), W_m their frequencies: turned     rotation of pin j: c
   sum_m |turn_j f_m| sum_i |G_i f_m| s_i / W_m^2. A static sum would cancel between modes; a motion
   does not, so sizes are added. c = 2/(1 - r): put on at once, and for the frequencies of the
   pinned motion, r = (largest pinned frequency / least one at which the pins vibrate)^2; only where
   r < 1/4 give       of pin j: the same with |G_j f_m| softening  the pinned flexibility is F0 = Q
   w^-2 Q^T in pinned modes Q; A = Kc^-1, and A - F0 >= 0 is what the pins add: |w Q^T M A M Q w -
   1| in the modes (Frobenius). It holds the slow part of l0 too, which goes with the motion's own
   frequencies second     forces through the drift soften the rotation by l drift''/k; the displaced
   W gives order      them an arm: couples s_i give_i on both bodies Inputs SI from the envelope;
   outputs rad, m, relative. Not valid for loads that go with time (they may meet the pins' own
   vibrations), other joints, springs. Cost: an eigenvalue problem of 3 nbody. Source:
   docs/theory/effects/nonlinear-hinge.md. Test: test_hinge_give.c (motions of a lever and a six-bar
   with and without). */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "maths/lapack.h"
#include <math.h>

typedef struct work {
    const fw_effect_case *c;
    int n;
    double *mass;      /* (n) */
    double *stiffness; /* (n x n) */
    double *mode;      /* (n x n) row m: f_m, f_m^T M f_m = 1 */
    double *square;    /* (n) W_m^2, ascending */
    double *turn;      /* (n x npin) |turn of pin| in mode m */
    double *open;      /* (n x npin) |G_i f_m| */
    double *push;      /* (n) sum over what pushes: |generalised force of mode m|, at most */
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

/* f_m and W_m; how mode m turns and opens the pins. *fine false: no stiffness, or no modes */
static fw_status find_modes(work *w, bool *fine) {
    const fw_mechanism *m = w->c->mechanism;
    int n = w->n;
    fw_lapack_space space;
    FW_TRY(fw_eigen_space(w->c->arena, n, &space));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            w->mode[i * n + j] = w->stiffness[i * n + j] / sqrt(w->mass[i] * w->mass[j]);
    *fine = fw_eigen(n, w->mode, w->square, &space) && w->square[0] > 0;
    for (int k = 0; k < n && *fine; k++) {
        double *f = w->mode + (size_t)k * (size_t)n;
        for (int i = 0; i < n; i++)
            f[i] /= sqrt(w->mass[i]);
        for (int i = 0; i < m->npin; i++) {
            fw_vec2 at[2] = {{0, 0}, {0, 0}};
            double turn[2] = {0, 0};
            for (int side = 0; side < 2; side++) {
                int b = side ? m->pin[i].body_b : m->pin[i].body_a;
                if (b == FW_GROUND) continue;
                fw_vec2 p = fw_pin_place(m, &m->pin[i], side);
                turn[side] = f[3 * b + 2];
                at[side].x = f[3 * b] - turn[side] * (p.y - m->body[b].y_m);
                at[side].y = f[3 * b + 1] + turn[side] * (p.x - m->body[b].x_m);
            }
            w->turn[k * m->npin + i] = fabs(turn[1] - turn[0]);
            w->open[k * m->npin + i] = hypot(at[1].x - at[0].x, at[1].y - at[0].y);
        }
    }
    return FW_OK;
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

/* |w Q^T M A M Q w - 1| */
static fw_status soften(const work *w, double *softening) {
    const fw_envelope *v = w->c->envelope;
    double sum = 0, *part; /* (modes x n) q_j^T M f_m w_j / W_m */
    FW_NEED(part = fw_arena_array(w->c->arena, double, (size_t)v->modes *(size_t)w->n));
    for (int j = 0; j < v->modes; j++)
        for (int k = 0; k < w->n; k++) {
            double dot = 0;
            for (int i = 0; i < w->n; i++)
                dot += v->shape[j * w->n + i] * w->mass[i] * w->mode[k * w->n + i];
            part[j * w->n + k] = dot * v->omega[j] / sqrt(w->square[k]);
        }
    for (int i = 0; i < v->modes; i++)
        for (int j = 0; j < v->modes; j++) {
            double off = i == j ? -1 : 0;
            for (int k = 0; k < w->n; k++)
                off += part[i * w->n + k] * part[j * w->n + k];
            sum += off * off;
        }
    *softening = sqrt(sum);
    return FW_OK;
}

/* sum over the modes of what they show of their pushes */
static double shown(const work *w, const double *what, int pin) {
    double sum = 0;
    for (int k = 0; k < w->n; k++)
        sum += what[k * w->c->mechanism->npin + pin] * w->push[k] / w->square[k];
    return sum;
}

static void add_push(work *w, int hinge, double force_N) {
    int i = w->c->mechanism->hinge[hinge].pin;
    for (int k = 0; k < w->n; k++)
        w->push[k] += w->open[k * w->c->mechanism->npin + i] * force_N;
}

/* the arm of the forces at the displaced W: couples on both bodies, and one between them where the
   stiffness depends on the angle */
static void add_couples(work *w, int hinge, double couple_Nm, double between_Nm) {
    const fw_mechanism *m = w->c->mechanism;
    const fw_pin *p = &m->pin[m->hinge[hinge].pin];
    for (int k = 0; k < w->n; k++)
        for (int side = 0; side < 2; side++) {
            int b = side ? p->body_b : p->body_a;
            if (b == FW_GROUND) continue;
            w->push[k] += (0.5 * couple_Nm + between_Nm) * fabs(w->mode[k * w->n + 3 * b + 2]);
        }
}

static fw_status find(work *w, fw_hinge_give *give) {
    const fw_effect_case *c = w->c;
    const fw_envelope *v = c->envelope;
    const fw_mechanism *m = c->mechanism;
    bool fine;
    FW_TRY(find_modes(w, &fine));
    double ratio = (double)INFINITY, most = 0;
    if (fine && v->modes > 0 && v->modes < w->n)
        ratio = v->omega[v->modes - 1] * v->omega[v->modes - 1] / w->square[v->modes];
    if (!(ratio < 0.25)) {
        give->why_not = "the hinges give at frequencies near those of the motion: kept";
        return FW_OK;
    }
    FW_TRY(soften(w, &give->softening));
    double at_once = 2 / (1 - ratio) * (1 + give->softening);
    for (int h = 0; h < m->nhinge; h++) {
        int i = m->hinge[h].pin;
        worst x = worst_of(&m->hinge[h].law, v->angle[i]);
        add_push(w, h, v->force[i] + x.stiffness_N_per_m * x.drift_m);
        most = fmax(most, v->force[i] * x.curve_m / m->pin[i].stiffness_Nm_per_rad);
    }
    give->softening += most;
    for (int i = 0; i < m->npin; i++)
        give->give_m[i] = at_once * shown(w, w->open, i);
    for (int h = 0; h < m->nhinge; h++) {
        int i = m->hinge[h].pin;
        worst x = worst_of(&m->hinge[h].law, v->angle[i]);
        double work_J = (v->force[i] + x.stiffness_N_per_m * x.drift_m) * give->give_m[i];
        add_couples(w, h, work_J, 0.5 * x.change_per_rad * work_J);
    }
    for (int i = 0; i < m->npin; i++)
        give->turned_rad = fmax(give->turned_rad, at_once * shown(w, w->turn, i));
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
    FW_NEED(w.mass = fw_arena_array(c->arena, double, n));
    FW_NEED(w.stiffness = fw_arena_array(c->arena, double, n *n));
    FW_NEED(w.mode = fw_arena_array(c->arena, double, n *n));
    FW_NEED(w.square = fw_arena_array(c->arena, double, n));
    FW_NEED(w.turn = fw_arena_array(c->arena, double, n *(size_t)m->npin));
    FW_NEED(w.open = fw_arena_array(c->arena, double, n *(size_t)m->npin));
    FW_NEED(w.push = fw_arena_array(c->arena, double, n));
    for (int b = 0; b < m->nbody; b++) {
        w.mass[3 * b] = w.mass[3 * b + 1] = m->body[b].mass_kg;
        w.mass[3 * b + 2] = m->body[b].inertia_kg_m2;
    }
    FW_TRY(assemble(&w));
    FW_TRY(find(&w, give));
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}
