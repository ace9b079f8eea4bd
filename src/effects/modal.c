/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/modal.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* SI mass over its scaled one */
static double mass_of(const fw_mechanism *m, int i) {
    return i % 3 == 2 ? m->body[i / 3].inertia_kg_m2 : m->body[i / 3].mass_kg;
}

double fw_effects_pin_deflection(const fw_mechanism *m, int i) {
    const fw_mechanism_pin *p = &m->pin[i];
    double a = p->body_a == FW_GROUND ? 0 : m->body[p->body_a].phi_rad;
    double b = p->body_b == FW_GROUND ? 0 : m->body[p->body_b].phi_rad;
    return b - a - p->free_angle_rad;
}

static double energy_unit(const fw_effects_linear *s) {
    return s->stiffness_N_per_m * s->length_m * s->length_m;
}

/* sqrt of the scaled masses; false where one is not positive */
static bool masses(const fw_mechanism *m, const fw_effects_linear *s, double *inertia) {
    for (int i = 0; i < s->n; i++) {
        double u = fw_effects_linear_unit(s, i);
        inertia[i] = mass_of(m, i) * u * u / energy_unit(s);
        if (!(inertia[i] > 0) || !isfinite(inertia[i])) return false;
    }
    return true;
}

/* ---- the room to move ---- */

static const char *const repeated =
    "joints repeat each other, or the drawn position is a singular one";

/* rows of G M^-1/2, each of length 1, and their singular values */
static fw_status hold(fw_arena *arena, fw_effects_modal *o) {
    const fw_effects_linear *s = &o->linear;
    size_t n = (size_t)s->n, rows = (size_t)s->rows, total = (size_t)s->total;
    double *g;
    FW_NEED(g = fw_arena_array(arena, double, n *rows));
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < n; j++)
            g[i * n + j] = s->a[(n + i) * total + j] / sqrt(o->inertia[j]);
    fw_status status = fw_maths_singular_new(arena, s->rows, s->n, g, &o->holding);
    if (status == FW_SOLVER) o->why_not = "the joints cannot be resolved";
    if (status != FW_OK) return status == FW_SOLVER ? FW_OK : status;
    const double *sigma = o->holding.sigma;
    if (s->rows > s->n || (s->rows > 0 && !(sigma[s->rows - 1] > 1e-7 * sigma[0])))
        o->why_not = repeated;
    return FW_OK;
}

/* z^T K z over the null space z of G M^-1/2, then its modes */
static fw_status solve(fw_arena *arena, fw_effects_modal *o) {
    const fw_effects_linear *s = &o->linear;
    int n = s->n, m = n - s->rows;
    size_t size = (size_t)n, total = (size_t)s->total;
    double *reduced, *value, *product, *mix;
    FW_NEED(reduced = fw_arena_array(arena, double, (size_t)m *(size_t)m));
    FW_NEED(value = fw_arena_array(arena, double, (size_t)m));
    FW_NEED(product = fw_arena_array(arena, double, size));
    const double *z = o->holding.v + (size_t)s->rows * size;
    for (int j = 0; j < m; j++) {
        for (size_t i = 0; i < size; i++) {
            product[i] = 0;
            for (size_t k = 0; k < size; k++) /* symmetric part */
                product[i] += 0.5 * (s->a[i * total + k] + s->a[k * total + i]) *
                              z[(size_t)j * size + k] / sqrt(o->inertia[k] * o->inertia[i]);
        }
        for (int l = 0; l < m; l++) {
            double sum = 0;
            for (size_t i = 0; i < size; i++)
                sum += z[(size_t)l * size + i] * product[i];
            if (!isfinite(sum)) {
                o->why_not = "stiffness or masses are not finite";
                return FW_OK;
            }
            reduced[(size_t)j * (size_t)m + (size_t)l] = sum;
        }
    }
    FW_NEED(mix = fw_arena_array(arena, double, (size_t)m *(size_t)m));
    if (!fw_maths_jacobi(m, reduced, value, mix) || !(value[0] > 1e-12 * value[m - 1])) {
        o->why_not = "the mechanism can move freely, or is not stable where it is drawn";
        return FW_OK;
    }
    o->modes = m;
    FW_NEED(o->omega = fw_arena_array(arena, double, (size_t)m));
    FW_NEED(o->shape = fw_arena_array(arena, double, (size_t)m *size));
    for (int j = 0; j < m; j++) {
        double *to = o->shape + (size_t)j * size;
        o->omega[j] = sqrt(value[j]);
        for (int l = 0; l < m; l++)
            for (size_t i = 0; i < size; i++)
                to[i] += mix[(size_t)j * (size_t)m + (size_t)l] * z[(size_t)l * size + i];
        for (int i = 0; i < n; i++)
            to[i] *= fw_effects_linear_unit(s, i) / sqrt(o->inertia[i] * energy_unit(s));
    }
    return FW_OK;
}

static fw_status turns(fw_arena *arena, fw_effects_modal *o) {
    const fw_mechanism *m = o->mechanism;
    FW_NEED(o->turn = fw_arena_array(arena, double, (size_t)o->modes *(size_t)m->npin));
    for (int j = 0; j < o->modes; j++)
        for (int i = 0; i < m->npin; i++) {
            const double *s = o->shape + (size_t)j * (size_t)o->n;
            int a = m->pin[i].body_a, b = m->pin[i].body_b;
            o->turn[(size_t)j * (size_t)m->npin + (size_t)i] =
                (b == FW_GROUND ? 0 : s[3 * b + 2]) - (a == FW_GROUND ? 0 : s[3 * a + 2]);
        }
    return FW_OK;
}

/* ---- damping ---- */

/* C (n x n, SI): the same shapes of matrix as stiffness has, with dampers in its place */
static fw_status dampers(fw_arena *arena, const fw_effects_modal *o, const fw_effects_loads *loads,
                         double *c) {
    fw_effects_loads t = *loads;
    fw_effects_linear s;
    bool any;
    t.nelement = 0;
    FW_NEED(t.torsion = fw_arena_array(arena, fw_effects_torsion, (size_t)t.ntorsion));
    FW_NEED(t.slide = fw_arena_array(arena, fw_effects_slide, (size_t)t.nslide));
    FW_NEED(t.spring = fw_arena_array(arena, fw_device_spring, (size_t)t.nspring));
    for (int i = 0; i < t.ntorsion; i++) {
        t.torsion[i] = loads->torsion[i];
        t.torsion[i].stiffness_Nm_per_rad = t.torsion[i].damping_Nms_per_rad;
    }
    for (int i = 0; i < t.nslide; i++) {
        t.slide[i] = loads->slide[i];
        t.slide[i].stiffness_N_per_m = t.slide[i].damping_Ns_per_m;
    }
    for (int i = 0; i < t.nspring; i++) {
        t.spring[i] = loads->spring[i];
        t.spring[i].stiffness_N_per_m = t.spring[i].damping_Ns_per_m;
    }
    FW_TRY(fw_effects_linear_new(arena, o->mechanism, &t, &s, &any));
    for (int i = 0; any && i < s.n; i++)
        for (int j = 0; j < s.n; j++)
            c[(size_t)i * (size_t)s.n + (size_t)j] += s.a[(size_t)i * (size_t)s.total + (size_t)j] *
                                                      fw_effects_linear_force_unit(&s, i) /
                                                      fw_effects_linear_unit(&s, j);
    return FW_OK;
}

fw_status fw_effects_modal_damping(fw_arena *arena, const fw_effects_modal *o,
                                   const fw_effects_loads *loads, double *out) {
    size_t n = (size_t)o->n, m = (size_t)o->modes;
    double *c, *k, *product;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(c = fw_arena_array(arena, double, n *n));
    FW_NEED(k = fw_arena_array(arena, double, n *n));
    FW_NEED(product = fw_arena_array(arena, double, n));
    FW_TRY(dampers(arena, o, loads, c));
    if (loads->nelement > 0)
        FW_TRY(fw_effects_loads_element_tangent(arena, o->mechanism, loads, k, c));
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < n; i++) {
            product[i] = 0;
            for (size_t l = 0; l < n; l++)
                product[i] += c[i * n + l] * o->shape[j * n + l];
        }
        for (size_t l = 0; l < m; l++)
            for (size_t i = 0; i < n; i++)
                out[l * m + j] += o->shape[l * n + i] * product[i];
    }
    bool own = loads == o->loads; /* what free strains are damped by belongs to these */
    if (own && o->shift[1]) FW_TRY(fw_effects_modal_drag(arena, o, o->shift_drag[1]));
    for (int which = 0; which < 2 && own; which++)
        for (size_t j = 0; j < m && o->shift[which]; j++)
            for (size_t i = 0; i < n * n; i++)
                o->shift_drag[which][j] -= o->shape[j * n + i / n] * c[i] * o->shift[which][i % n];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- the start ---- */

static bool stated(const fw_device_scene *scene, int i) {
    for (int k = 0; k < scene->ninitial; k++)
        if (scene->initial[k].body == i / 3)
            return !(i % 3 < 2 ? scene->initial[k].moves_free : scene->initial[k].turns_free);
    return false;
}

/* modal velocities v of least sum W (shape v - given)^2: W the masses, a billion times smaller
   where the scene states nothing, as start.c of dynamics/ has it */
static fw_status start(fw_arena *arena, fw_effects_modal *o) {
    size_t n = (size_t)o->n, m = (size_t)o->modes;
    const double *given = o->loads->velocity;
    FW_NEED(o->velocity = fw_arena_array(arena, double, m));
    double *a, *weight, moves = 0;
    int count = 0;
    for (size_t i = 0; i < n; i++) {
        moves = fmax(moves, fabs(given[i]));
        count += stated(o->scene, (int)i);
    }
    if (moves == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(a = fw_arena_array(arena, double, m *m));
    FW_NEED(weight = fw_arena_array(arena, double, n));
    for (size_t i = 0; i < n; i++)
        weight[i] =
            mass_of(o->mechanism, (int)i) * (count == 0 || stated(o->scene, (int)i) ? 1 : 1e-9);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < n; i++) {
            double w = weight[i] * o->shape[j * n + i];
            o->velocity[j] += w * given[i];
            for (size_t l = 0; l < m; l++)
                a[j * m + l] += w * o->shape[l * n + i];
        }
    FW_TRY(fw_maths_lapack_ready());
    if (!fw_maths_cholesky((int)m, a) || !fw_maths_cholesky_solve((int)m, a, o->velocity))
        o->why_not = "its velocities at the start cannot be resolved";
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- all of it ---- */

static const char *beyond(const fw_mechanism *m, const fw_effects_loads *t) {
    if (m->ndriver > 0) return "drivers move the mechanism";
    for (int i = 0; i < t->nspring; i++)
        if (t->spring[i].cable) return "cables pull on one side only";
    for (int i = 0; i < t->nelement; i++) {
        const fw_effects_force_element *e = &t->element[i];
        if (!fw_effects_loads_element_fits(e)) return "an element acts at too many points";
        if (e->switches == 0) continue;
        return strcmp(e->class_->effect, "tendon") == 0
                   ? "a tendon that may go slack pulls on one side only"
                   : "surfaces that touch push on one side only";
    }
    if (t->nstop > 0) return "stops act on one side only";
    if (t->nfriction > 0) return "friction sticks and slides";
    if (t->quasi_static) return "inertia is left out";
    if (fw_effects_linear_size(m, t) > FW_RESPONSE_MOST)
        return "the mechanism has too many bodies for modes";
    return m->nbody == 0 ? "the mechanism has no bodies" : NULL;
}

/* omega^2 M s = K s within G s = 0: with G M^-1/2 = U S V^T the last columns z of V span what can
   move, and z^T M^-1/2 K M^-1/2 z is an ordinary symmetric problem. Inputs SI, outputs as in the
   header. Error: round-off times the largest omega^2. Valid for small motions about a regular
   position. Cost some 10 (3 nbody)^3. Source: null space method, for instance Garcia de Jalon and
   Bayo, ch. 5; modes: Meirovitch, Fundamentals of Vibrations, ch. 7. Test: test_envelope.c. */
fw_status fw_effects_modal_find(fw_arena *arena, const fw_mechanism *m,
                                const fw_device_scene *scene, const fw_effects_loads *loads,
                                fw_effects_modal *o) {
    bool elastic;
    *o = (fw_effects_modal){.mechanism = m, .scene = scene, .loads = loads, .n = 3 * m->nbody};
    if ((o->why_not = beyond(m, loads))) return FW_OK;
    FW_TRY(fw_effects_linear_new(arena, m, loads, &o->linear, &elastic));
    FW_NEED(o->inertia = fw_arena_array(arena, double, (size_t)o->n));
    if (!elastic)
        o->why_not = "nothing in the mechanism is elastic";
    else if (!masses(m, &o->linear, o->inertia))
        o->why_not = "a body has no mass";
    else if (o->linear.rows >= o->n)
        o->why_not = "nothing can move";
    if (o->why_not) return FW_OK;
    for (size_t i = 0; i < (size_t)o->linear.total * (size_t)o->linear.total; i++)
        if (!isfinite(o->linear.a[i])) o->why_not = "stiffness or masses are not finite";
    if (!o->why_not) FW_TRY(hold(arena, o));
    if (!o->why_not) FW_TRY(solve(arena, o));
    if (!o->why_not) FW_TRY(turns(arena, o));
    if (!o->why_not) FW_TRY(fw_effects_modal_find_shifts(arena, o));
    if (o->why_not) return FW_OK;
    FW_NEED(o->damping = fw_arena_array(arena, double, (size_t)o->modes *(size_t)o->modes));
    FW_TRY(fw_effects_modal_damping(arena, o, loads, o->damping));
    FW_TRY(fw_effects_modal_open(arena, o));
    return start(arena, o);
}

/* G^T lambda = F - K x with the static displacement x; lambda = U S^-1 V^T M^-1/2 (F - K x) */
void fw_effects_modal_multipliers(const fw_effects_modal *o, const double *force, double *work,
                                  double *lambda) {
    const fw_effects_linear *s = &o->linear;
    size_t n = (size_t)o->n, rows = (size_t)s->rows, total = (size_t)s->total;
    double *x = work, *r = work + n;
    memset(x, 0, n * sizeof *x);
    memset(lambda, 0, rows * sizeof *lambda);
    for (size_t j = 0; j < (size_t)o->modes; j++) {
        double f = 0;
        for (size_t i = 0; i < n; i++)
            f += o->shape[j * n + i] * force[i];
        for (size_t i = 0; i < n; i++)
            x[i] += o->shape[j * n + i] * f / (o->omega[j] * o->omega[j]) /
                    fw_effects_linear_unit(s, (int)i);
    }
    for (size_t i = 0; i < n; i++) {
        r[i] = force[i] / fw_effects_linear_force_unit(s, (int)i);
        for (size_t k = 0; k < n; k++)
            r[i] -= s->a[i * total + k] * x[k];
        r[i] /= sqrt(o->inertia[i]);
    }
    for (size_t k = 0; k < rows; k++) {
        double part = 0;
        for (size_t i = 0; i < n; i++)
            part += o->holding.v[k * n + i] * r[i];
        for (size_t i = 0; i < rows; i++)
            lambda[i] += o->holding.u[k * rows + i] * part / o->holding.sigma[k];
    }
}

/* ---- what forces do to the stiffness ---- */

/* loads at their largest; elements as they are at the start, which is how they are in omega: what
   their laws change is in fw_effects_modal_bend */
static void largest_loads(const fw_effects_modal *o, const fw_mechanism *moved, double *force) {
    fw_effects_loads loads = *o->loads;
    loads.nelement = 0;
    fw_effects_loads_largest_force(moved, &loads, o->scene->duration_s, force);
    for (int i = 0; i < o->loads->nelement; i++)
        fw_effects_loads_element_force(moved, &o->loads->element[i], 0, DBL_MIN, force);
}

/* residual (n, SI) at q0 + h shape: forces less G^T lambda */
static void residual(const fw_effects_modal *o, fw_mechanism *moved, const double *shape, double h,
                     const double *lambda, bool dead, double *work, double *out) {
    const fw_effects_linear *s = &o->linear;
    for (int b = 0; b < moved->nbody; b++) {
        moved->body[b] = o->mechanism->body[b];
        moved->body[b].x_m += h * shape[3 * b];
        moved->body[b].y_m += h * shape[3 * b + 1];
        moved->body[b].phi_rad += h * shape[3 * b + 2];
    }
    memset(out, 0, (size_t)o->n * sizeof *out);
    if (!dead) largest_loads(o, moved, out);
    memset(work, 0, (size_t)o->n * sizeof *work);
    fw_effects_linear_hold(s, moved, lambda, work);
    for (int i = 0; i < o->n; i++)
        out[i] -= work[i] * fw_effects_linear_force_unit(s, i);
}

/* -d(F - G^T lambda)/dq along every mode by central differences of 1e-4 rad (or of the length of
   the scene) against omega^2; lambda held. Dimensionless; error some 1e-8; cost modes times the
   forces. Source: second variation of the constrained potential. Test: test_envelope.c. */
fw_status fw_effects_modal_softening(fw_arena *arena, const fw_effects_modal *o,
                                     const double *force, bool dead, double *part) {
    size_t n = (size_t)o->n, m = (size_t)o->modes;
    double *lambda, *work, *one, *two, *pull, sum = 0;
    fw_mechanism moved = *o->mechanism;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(moved.body = fw_arena_array(arena, fw_mechanism_mass, (size_t)moved.nbody));
    FW_NEED(lambda = fw_arena_array(arena, double, (size_t)o->linear.rows));
    FW_NEED(work = fw_arena_array(arena, double, 2 * n));
    FW_NEED(one = fw_arena_array(arena, double, n));
    FW_NEED(two = fw_arena_array(arena, double, n));
    FW_NEED(pull = fw_arena_array(arena, double, 2 * (size_t)moved.npin));
    fw_effects_modal_multipliers(o, force, work, lambda);
    fw_effects_modal_pulls(o, force, pull);
    for (size_t j = 0; j < m; j++) {
        const double *shape = o->shape + j * n;
        double size = 0;
        for (size_t i = 0; i < n; i++)
            size = fmax(size, fabs(shape[i]) / fw_effects_linear_unit(&o->linear, (int)i));
        double h = 1e-4 / size;
        if (fw_arena_cancelled(arena)) return FW_CANCELLED; /* a shaking of many lines takes long */
        residual(o, &moved, shape, h, lambda, dead, work, one);
        residual(o, &moved, shape, -h, lambda, dead, work, two);
        for (size_t l = 0; l < m; l++) {
            double k = l == j && !dead ? -o->omega[j] * o->omega[j] : 0;
            for (size_t i = 0; i < n; i++)
                k -= o->shape[l * n + i] * (one[i] - two[i]) / (2 * h);
            k += fw_effects_modal_turning(o, pull, (int)l, (int)j);
            k /= o->omega[j] * o->omega[l];
            sum += k * k;
        }
    }
    fw_arena_rewind(arena, mark);
    *part = sqrt(sum);
    return FW_OK;
}
