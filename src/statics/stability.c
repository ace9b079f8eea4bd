/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is what a motion rests on stable? At 2 to 12 instants, the ends and the insides of the smooth
   pieces of all laws, the lowest eigenvalue mu of the reduced stiffness at the position of the
   motion, its rapid modes at rest, under the loads of that time (forces, drivers, elements;
   friction left out, as in statics). A disturbance grows by e^G, G = integral of sqrt(max(0, -mu)) dt, by the trapezoidal
   rule: without damping, which would only slow it. Where one look has less than half the stiffness of another, eight times as many
   follow. It is reported where G is at least 2 and the
   motion has moved along the unstable mode phi by less than a tenth of the way to the stable
   equilibrium u_s that descent reaches from there: max_t |phi^T M (u(t) - u)| < 0.1 |u_s - u|_M, t
   from the last look before the first unstable one on, so that a motion that falls, or swings
   through, is not, and one that came to rest before it became unstable is. mu is linear in the loads along a straight
   path of equilibria: with mu_0 of the same mode without them the share that it would bear is
   mu_0/(mu_0 - mu). What is left of the stiffness, 1 where loads take nothing, is the least mu over that of the device at rest,
   drawn and without loads: it goes to 0 at a fold. Units: scaled. Valid where statics is; a motion between instants is taken as
   straight and moved onto the joints. Cost: 30 n^3 per instant, n = 3 nbody, and 10 to 30 of them
   where something is found. Source: Lagrange and Dirichlet's theorem; Thompson and Hunt, A General
   Theory of Elastic Stability 1973. Test: test_stability.c. */
#include "statics/statics.h"
#include "base/sort.h"
#include "base/constants.h"
#include "quantity/law_kind.h"
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* what grows less has not left a thousandth of its way when the scene ends */
static const double fw_least_growth = 2;
static const double fw_left = 0.1;      /* of the way: it has left */
static const double fw_rapid = 25;      /* of the square of the rate at which a disturbance grows */
static const double fw_most_work = 2e8; /* floating-point operations of all looks */
enum {
    FW_LEAST_LOOKS = 2,
    FW_STEADY_LOOKS = 4,
    FW_MOST_LOOKS = 12,
    FW_MOST_BREAKS = 4096,
    FW_SETTLE_TRIES = 8,
    FW_FINER = 8
};
static const double fw_softly = 0.5; /* of the stiffness */

typedef struct looker {
    fw_statics_equilibrium w;
    const fw_dynamics_motion *motion;
    double *at; /* (pieces + 1) ends of the smooth pieces, s */
    int pieces;
    bool vary; /* some law does within a piece */
    double lowest, growth;
    double least, most; /* of all looks, unstable ones too */
    double
        pushed; /* how far the equilibrium lies beside the first place that is unstable, along its mode */
    double since_s; /* the last look before the first that is unstable, or the start */
    double t_s, piece_s, *where, *shape; /* of the lowest: u and its mode (n) */
    double to; /* along that: the farthest that the motion goes from where it was stable */
    fw_statics_stability *out;
} looker;

/* ---- when ---- */

/* of timed loads, drivers, the ground's stretch, elements: a piece of time that one of them left out would go across a break
   of it, and the values of its law there are those of another piece */
static const fw_quantity_law *law_at(const fw_effects_loads *t, const fw_mechanism *m, int i) {
    if (i < t->ntimed) return t->timed[i].law;
    i -= t->ntimed;
    if (i < m->ndriver) return &m->driver[i].law;
    i -= m->ndriver;
    if (t->stretch.law && i-- == 0) return t->stretch.law;
    for (int k = 0; k < t->nelement; k++) {
        if (i < t->element[k].laws) return t->element[k].law[i];
        i -= t->element[k].laws;
    }
    return NULL;
}

static int law_count(const fw_effects_loads *t, const fw_mechanism *m) {
    int count = t->ntimed + m->ndriver + (t->stretch.law != NULL);
    for (int k = 0; k < t->nelement; k++)
        count += t->element[k].laws;
    return count;
}

static fw_status find_pieces(looker *k, const fw_effects_loads *loads) {
    double end = k->w.scene->duration_s;
    int laws = law_count(loads, k->w.mechanism), have = 0;
    for (int i = 0; i < laws; i++) {
        const fw_quantity_law *law = law_at(loads, k->w.mechanism, i);
        have += fw_quantity_law_breaks_of(law, end, NULL, 0);
        k->vary = k->vary || !(fw_quantity_law_is_constant(law) || law->kind->stepwise);
    }
    if (have > FW_MOST_BREAKS) have = FW_MOST_BREAKS;
    FW_NEED(k->at = fw_arena_array(k->w.arena, double, (size_t)have + 2));
    int count = 1; /* at[0] = 0 */
    for (int i = 0; i < laws; i++) {
        int found = fw_quantity_law_breaks_of(law_at(loads, k->w.mechanism, i), end, k->at + count,
                                              have + 1 - count);
        count += found < have + 1 - count ? found : have + 1 - count;
    }
    fw_sort_doubles(k->at, (size_t)count);
    int kept = 1;
    for (int i = 1; i < count; i++)
        if (k->at[i] > k->at[kept - 1] && k->at[i] < end) k->at[kept++] = k->at[i];
    k->at[kept] = end;
    k->pieces = kept;
    return FW_OK;
}

/* ---- one look ---- */

/* u of the motion at a time, straight between its rows */
static void place(const looker *k, double t_s, double *u) {
    const fw_dynamics_motion *x = k->motion;
    size_t n = (size_t)k->w.model->nq;
    double last = x->t_s[x->nsample - 1], part = 0;
    int row = 0;
    if (x->nsample > 1 && last > 0) {
        double at = fmin(fmax(t_s / last, 0), 1) * (x->nsample - 1);
        row = (int)fmin(floor(at), x->nsample - 2);
        part = at - row;
    }
    fw_dynamics_motion_rows(x, row, 2);
    const double *a = x->q + (size_t)row * n, *b = x->nsample > 1 ? a + n : a;
    for (size_t i = 0; i < n; i++) {
        double unit = i % 3 == 2 ? 1 : k->w.model->scale.length_m;
        u[i] = (a[i] + part * (b[i] - a[i]) - k->w.q0[i]) / unit;
    }
}

static void loads_of(looker *k, double t_s, double piece_s) {
    fw_statics_equilibrium_at(&k->w, t_s, piece_s);
    k->w.system->loading.hold = (fw_multibody_hold){.on = true, .t_s = t_s};
}

/* Modes that swing several times while a disturbance grows e-fold act by their mean: a flexure that
   rings along itself is pressed twice as hard at an instant. They are taken at rest: u += sum F_k/mu_k
   phi_k over the modes with mu_k > 25 |mu|, until nothing changes. */
static fw_status let_settle(looker *k) {
    fw_statics_equilibrium *w = &k->w;
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    for (int i = 0; i < FW_SETTLE_TRIES; i++) {
        double most = 0, least = fw_rapid * fabs(r->value[0]);
        memset(w->step, 0, n * sizeof *w->step);
        for (int j = 1; j < r->dof; j++) {
            double by = r->value[j] > least ? w->gradient[j] / r->value[j] : 0;
            for (size_t c = 0; c < n; c++)
                w->step[c] += by * r->shape[(size_t)j * n + c];
        }
        for (size_t c = 0; c < n; c++) {
            w->y[c] += w->step[c];
            most = fmax(most, fabs(w->step[c]));
        }
        if (most == 0) return FW_OK;
        FW_TRY(fw_statics_equilibrium_evaluate(w));
        if (most < 1e-9 || r->value[0] >= -r->zero[0]) return FW_OK;
    }
    return FW_OK;
}

/* stable, or above 0 within round-off */
static bool stands(looker *k, double t_s) {
    const fw_statics_reduced *r = &k->w.reduced;
    if (r->dof > 0 && r->value[0] < -r->zero[0]) return false;
    if (k->growth == 0) k->since_s = t_s;
    return true;
}

/* stands for weight_s of the scene */
static fw_status look(looker *k, double t_s, double piece_s, double weight_s) {
    fw_statics_equilibrium *w = &k->w;
    size_t n = (size_t)w->model->nq;
    loads_of(k, t_s, piece_s);
    memset(w->y, 0, (size_t)w->model->ny * sizeof *w->y);
    place(k, t_s, w->y);
    fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status == FW_SOLVER) return FW_OK; /* nothing is known there */
    FW_TRY(status);
    if (w->reduced.dof > 0) {
        k->least = fmin(k->least, w->reduced.value[0]);
        k->most = fmax(k->most, w->reduced.value[0]);
    }
    if (stands(k, t_s)) return FW_OK;
    status = let_settle(k);
    if (status == FW_SOLVER) return FW_OK;
    FW_TRY(status);
    if (stands(k, t_s)) return FW_OK;
    double lowest = w->reduced.value[0];
    if (k->growth == 0) k->pushed = fabs(w->gradient[0] / lowest);
    k->growth += sqrt(-lowest) * weight_s / w->model->scale.time_s;
    if (lowest >= k->lowest) return FW_OK;
    k->lowest = lowest;
    k->t_s = t_s;
    k->piece_s = piece_s;
    memcpy(k->where, w->y, n * sizeof *k->where);
    memcpy(k->shape, w->reduced.shape, n * sizeof *k->shape);
    return FW_OK;
}

/* pieces that are many share the looks: then one in the middle of every so many */
static fw_status look_along(looker *k, int finer) {
    double n = k->w.model->nq, most = fw_most_work / (30 * n * n * n);
    int usual = finer * (k->pieces > 1 || k->vary ? FW_MOST_LOOKS : FW_STEADY_LOOKS);
    k->growth = k->since_s = 0;
    int looks = (int)fmin(fmax(most, FW_LEAST_LOOKS), usual), each = looks / k->pieces;
    double end = k->at[k->pieces];
    if (each < 2) {
        for (int i = 0; i < looks; i++) {
            double t = (i + 0.5) * end / looks;
            FW_TRY(look(k, t, t, end / looks));
        }
        return FW_OK;
    }
    for (int p = 0; p < k->pieces; p++) {
        double from = k->at[p], h = (k->at[p + 1] - from) / (each - 1);
        for (int i = 0; i < each; i++) {
            if (fw_arena_cancelled(k->w.arena)) return FW_CANCELLED;
            FW_TRY(look(k, from + i * h, 0.5 * (from + k->at[p + 1]),
                        i == 0 || i == each - 1 ? 0.5 * h : h));
        }
    }
    return FW_OK;
}

/* the lowest eigenvalue at rest, drawn and without loads; NaN: none is known. Loads are then what they were: those without a
   law are set once */
static fw_status at_rest(looker *k, double *lowest) {
    fw_statics_equilibrium *w = &k->w;
    fw_multibody_loading *l = &w->system->loading;
    const size_t n = (size_t)w->model->nq * sizeof *l->constant,
                 f = 2 * (size_t)w->model->nload * sizeof *l->force;
    loads_of(k, 0, 0);
    const double actuation = l->actuation, drive = l->drive;
    double *constant, *force;
    *lowest = (double)NAN;
    FW_NEED(constant = fw_arena_alloc(w->arena, 1, n));
    FW_NEED(force = fw_arena_alloc(w->arena, 1, f));
    memcpy(constant, l->constant, n), memcpy(force, l->force, f);
    memset(l->constant, 0, n), memset(l->force, 0, f);
    l->actuation = l->drive = 0;
    memset(w->y, 0, (size_t)w->model->ny * sizeof *w->y);
    const fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status == FW_OK && w->reduced.dof > 0) *lowest = w->reduced.value[0];
    memcpy(l->constant, constant, n), memcpy(l->force, force, f);
    l->actuation = actuation, l->drive = drive;
    return status == FW_SOLVER ? FW_OK : status;
}

/* ---- has it left? ---- */

static double product(const fw_multibody_model *m, const double *x, const double *y) {
    double sum = 0;
    for (int i = 0; i < m->nq; i++)
        sum += (i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) * x[i] * y[i];
    return sum;
}

/* how far the motion goes along the mode, from where it is most unstable; what it did before it became unstable at all
   is over, and what it does from there on says to which side it goes */
static double travelled(looker *k) {
    const fw_multibody_model *m = k->w.model;
    double *u = k->w.step, most = 0;
    place(k, k->since_s, u);
    const double on = product(m, k->shape, k->where) - product(m, k->shape, u);
    k->to = 0;
    for (int row = 0; row < k->motion->nsample; row++) {
        if (k->motion->t_s[row] < k->since_s) continue;
        place(k, k->motion->t_s[row], u);
        for (int i = 0; i < m->nq; i++)
            u[i] -= k->where[i];
        const double along = product(m, k->shape, u);
        most = fmax(most, fabs(along));
        if (fabs(along + on) > fabs(k->to)) k->to = along + on;
    }
    return most;
}

/* It has left to one of two sides. Where hardly anything pushed it to one when it became unstable, the side was decided by
   round-off, and is by whatever deviates in what is made. */
static bool is_chance(const looker *k, double way) {
    const double hardly = 1e-5;
    return k->pushed < hardly * way;
}

/* what goes furthest on the way in w->step: a body's centre, or, in scaled lengths, what turns */
static void name_mover(looker *k) {
    const fw_multibody_model *m = k->w.model;
    double most = 0, turns = 0;
    int mover = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *u = k->w.step + 3 * b;
        const double way = hypot(u[0], u[1]);
        if (way > most) most = way, mover = b;
        turns = fmax(turns, fabs(u[2]));
    }
    k->out->way_m = most * m->scale.length_m;
    if (most > turns) k->out->goes = fw_text_name(k->w.mechanism->body[mover].id);
}

/* The way to the stable equilibrium; without one, that of a tenth of a radian or length. Descent that rests where it began,
   or at any other place that is unstable, found none. */
static fw_status fall(looker *k, double *way) {
    fw_statics_equilibrium *w = &k->w;
    const fw_multibody_model *m = w->model;
    size_t n = (size_t)m->nq, pins = (size_t)w->mechanism->npin;
    bool left = false;
    *way = 0.1 / fw_statics_equilibrium_part(k->shape, fw_statics_equilibrium_mover(w, k->shape));
    loads_of(k, k->t_s, k->piece_s);
    memset(w->y, 0, (size_t)m->ny * sizeof *w->y);
    memcpy(w->y, k->where, n * sizeof *w->y);
    fw_status status = fw_statics_equilibrium_descend(w, &left);
    if (status == FW_SOLVER) return FW_OK;
    FW_TRY(status);
    if (w->reduced.value[0] < -w->reduced.zero[0]) return FW_OK;
    double *angle, *q;
    FW_NEED(q = fw_arena_array(w->arena, double, n));
    FW_NEED(k->out->angle_rad = angle = fw_arena_array(w->arena, double, pins));
    fw_statics_equilibrium_pose(w, w->y, q, angle);
    for (size_t i = 0; i < pins; i++)
        if (k->out->pin == FW_NONE || fabs(angle[i]) > fabs(angle[k->out->pin]))
            k->out->pin = (int)i;
    for (size_t i = 0; i < n; i++)
        w->step[i] = w->y[i] - k->where[i];
    *way = sqrt(product(m, w->step, w->step));
    name_mover(k);
    return FW_OK;
}

/* of the loads, by the stiffness of the same mode without them */
static fw_status share(looker *k) {
    fw_statics_equilibrium *w = &k->w;
    const fw_multibody_model *m = w->model;
    fw_multibody_loading *l = &w->system->loading;
    size_t n = (size_t)m->nq;
    memset(l->constant, 0, n * sizeof *l->constant);
    memset(l->force, 0, 2 * (size_t)m->nload * sizeof *l->force);
    l->actuation = l->drive = 0;
    memset(w->y, 0, (size_t)m->ny * sizeof *w->y);
    memcpy(w->y, k->where, n * sizeof *w->y);
    fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status != FW_OK) return status == FW_SOLVER ? FW_OK : status;
    double without = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            without += k->shape[i] * w->stiffness[i * n + j] * k->shape[j];
    if (without > 0) k->out->share = without / (without - k->lowest);
    return FW_OK;
}

/* ---- words ---- */

static fw_status say(looker *k, fw_diags *diags) {
    fw_statics_stability *out = k->out;
    const fw_statics_equilibrium *w = &k->w;
    const double degree = FW_DEG_PER_RAD;
    char at[32], fold[32], turned[32];
    fw_text text = fw_text_new(w->arena);
    fw_text_printf(&text,
                   "%s%s stays on an unstable equilibrium (at %s ms): %s%s leaves it at the "
                   "smallest disturbance, which grows e-fold every %s ms",
                   FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)),
                   fw_number_text(at, sizeof at, 1e3 * out->t_s, 4), FW_NAMED("body", out->body),
                   fw_number_text(fold, sizeof fold, 1e3 / out->rate_per_s, 3));
    if (out->goes)
        fw_text_printf(&text, ", and moves to an equilibrium with %s%s displaced by %s um",
                       FW_NAMED("body", out->goes),
                       fw_number_text(turned, sizeof turned, 1e6 * out->way_m, 4));
    else if (out->pin != FW_NONE)
        fw_text_printf(
            &text, ", and moves to an equilibrium with %s%s turned by %s deg",
            FW_NAMED("joint", w->mechanism->pin[out->pin].id),
            fw_number_text(turned, sizeof turned, degree * fabs(out->angle_rad[out->pin]), 4));
    else if (!out->angle_rad)
        fw_text_add(&text, ", and no stable equilibrium was found that it would move to");
    /* where it would go to either side alike, what keeps it is that nothing decides the side */
    fw_text_add(&text, out->goes || out->pin != FW_NONE
                           ? "; only the exact symmetry of the description keeps it there. Lower "
                             "the load, stiffen the joints, or apply the load with a small "
                             "eccentricity to compute that motion"
                           : "; a symmetry of the description keeps it there, or it has "
                             "not had the time to leave. Lower the load, stiffen the "
                             "joints, or apply the load with a small eccentricity to "
                             "compute that motion");
    FW_TRY(fw_text_end(&text));
    out->text = text.data;
    fw_diag_warning(diags, 259, w->scene->place, "%s", out->text);
    return diags->failed ? FW_NOMEM : FW_OK;
}

static fw_status say_chance(looker *k, fw_diags *diags) {
    fw_statics_stability *out = k->out;
    const fw_statics_equilibrium *w = &k->w;
    char at[32];
    out->chance = true;
    FW_NEED(out->text = fw_arena_printf(
                w->arena,
                "%s%s leaves an unstable equilibrium (at %s ms) to a side that nothing in the "
                "description decides: %s%s may go to the other side as well. Lower the load, "
                "stiffen the joints, or decide the side by a small eccentricity or angle",
                FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)),
                fw_number_text(at, sizeof at, 1e3 * out->t_s, 4), FW_NAMED("body", out->body)));
    fw_diag_warning(diags, 259, w->scene->place, "%s", out->text);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- what would take it to the other side ---- */

static void deformation(const fw_mechanism *m, const fw_mechanism_hinge *h, const double *q,
                        const double *shape, double out[3], double *axis);

static double length_of(const fw_mechanism_hinge *h) {
    const double L = h->input.length_m, least_m = 1e-4;
    return L > 0 ? L : fmax(h->input.radius_m * h->input.angle_rad, least_m);
}

/* what holds flexures bent in a share of the mode's shape, by turn and across; no shape that is made stretches a strip */
static fw_status passed_by(looker *k, fw_statics_passed *out) {
    const fw_mechanism *m = k->w.mechanism;
    double *q, d[3], axis, most = 0, aside_m = 1e-6, side = k->to < 0 ? -1 : 1;
    FW_NEED(out->way = fw_arena_array(k->w.arena, double, 6 * (size_t)m->nbody));
    FW_NEED(out->wrench = fw_arena_array(k->w.arena, double, 3 * (size_t)m->nhinge + 1));
    q = out->way + 3 * m->nbody;
    for (int i = 0; i < 3 * m->nbody; i++) {
        const double unit = i % 3 == 2 ? 1 : k->w.model->scale.length_m;
        out->way[i] = side * unit * k->shape[i], q[i] = k->w.q0[i] + unit * k->where[i];
        most = i % 3 == 2 ? most : fmax(most, fabs(out->way[i])); /* no joint lies farther off */
    }
    for (int i = 0; i < m->nhinge; i++) {
        deformation(m, &m->hinge[i], q, out->way, d, &axis);
        most = fmax(most, fmax(fabs(d[0]) * length_of(&m->hinge[i]) / 8, hypot(d[1], d[2])));
    }
    for (int i = 0; i < m->nhinge && most > 0; i++) {
        const fw_mechanism_hinge *h = &m->hinge[i];
        double *f = out->wrench + 3 * i;
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&h->law, 0, &at);
        deformation(m, h, q, out->way, d, &axis);
        const double kx = at.kx_N_per_m.value, ky = at.ky_N_per_m.value, by = -aside_m / most;
        const double x = kx <= ky ? kx * d[1] : 0, y = ky <= kx ? ky * d[2] : 0;
        f[0] = by * m->pin[h->pin].stiffness_Nm_per_rad * d[0];
        f[1] = by * (cos(axis) * x - sin(axis) * y), f[2] = by * (sin(axis) * x + cos(axis) * y);
    }
    out->any = most > 0, out->t_s = k->t_s;
    out->body = fw_text_name(m->body[fw_statics_equilibrium_mover(&k->w, k->shape)].id);
    return FW_OK;
}

static fw_status conclude(looker *k, fw_diags *diags, const fw_statics_stability **stability,
                          fw_statics_passed *passed) {
    double way;
    FW_NEED(k->out = fw_arena_one(k->w.arena, fw_statics_stability));
    k->out->pin = FW_NONE;
    k->out->t_s = k->t_s;
    k->out->rate_per_s = sqrt(-k->lowest) / k->w.model->scale.time_s;
    k->out->growth = k->growth;
    const char *id = k->w.mechanism->body[fw_statics_equilibrium_mover(&k->w, k->shape)].id;
    k->out->body = fw_text_name(id);
    FW_TRY(fall(k, &way));
    const bool left = travelled(k) >= fw_left * way;
    if (left && !is_chance(k, way)) return passed ? passed_by(k, passed) : FW_OK;
    FW_TRY(share(k));
    FW_TRY(left ? say_chance(k, diags) : say(k, diags));
    *stability = k->out;
    return FW_OK;
}

fw_status fw_statics_stability_find(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                    fw_diags *diags, const fw_statics_stability **stability,
                                    double *left, fw_statics_passed *passed) {
    double rest = (double)NAN;
    *stability = NULL;
    if (left) *left = rest;
    if (passed) passed->any = false;
    if (!motion->loads || motion->ended || motion->nsample < 1 || mechanism->nbody == 0)
        return FW_OK;
    if (3 * mechanism->nbody > FW_STABILITY_MOST) {
        fw_diag_note(diags, 259, scene->place,
                     "the stability of %s%s was not examined: the mechanism has more than "
                     "%d bodies",
                     FW_NAMED("scene", fw_text_name(scene->name)), FW_STABILITY_MOST / 3);
        return diags->failed ? FW_NOMEM : FW_OK;
    }
    double *steady = fw_dynamics_motion_steady(motion);
    if (steady && *steady > 0) {
        if (left) *left = *steady;
        return FW_OK;
    }
    fw_diags silent = fw_diags_new(arena);
    looker k = {.w = {.arena = arena, .mechanism = mechanism, .scene = scene, .diags = &silent},
                .motion = motion,
                .least = HUGE_VAL};
    fw_effects_loads loads = *motion->loads;
    loads.nfriction = 0;
    fw_status status = fw_statics_equilibrium_in_time(&k.w, &loads);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    if (status != FW_OK) return FW_OK; /* no model at rest: the motion itself says why */
    size_t n = (size_t)k.w.model->nq;
    FW_NEED(k.where = fw_arena_array(arena, double, n));
    FW_NEED(k.shape = fw_arena_array(arena, double, n));
    FW_TRY(find_pieces(&k, &loads));
    if (left) FW_TRY(at_rest(&k, &rest));
    FW_TRY(look_along(&k, 1));
    /* what passed through an unstable equilibrium did so between two looks, and was soft at one */
    if (k.growth < fw_least_growth && k.least < fw_softly * k.most)
        FW_TRY(look_along(&k, FW_FINER));
    if (left && rest > 0 && isfinite(k.least)) *left = fmax(k.least / rest, 0);
    if (steady && k.growth == 0 && left && *left > 0)
        *steady = *left; /* who does not ask leaves it open */
    if (k.growth >= fw_least_growth) return conclude(&k, diags, stability, passed);
    if (!(k.growth > 0) || !passed) return FW_OK;
    travelled(&k); /* so far; what it does behind the scene's end may be more */
    return passed_by(&k, passed);
}

/* ---- what flexures' errors take of a stiffness ---- */

/* of rotation, along and across the axis: stated stiffnesses are what they are, what the strip gives
   besides is the closed form's */
static void errors_of(const fw_mechanism_hinge *h, bool pins, double e[3]) {
    const fw_flexure_error *own = &h->closed_form.error;
    e[0] = h->stated ? 0 : own->stiffness;
    e[1] = pins ? 0 : own->kx, e[2] = pins ? 0 : own->ky;
}

/* turn and displacement of a hinge in a mode, along and across its axis */
static void deformation(const fw_mechanism *m, const fw_mechanism_hinge *h, const double *q,
                        const double *shape, double out[3], double *at_rad) {
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    double ux = 0, uy = 0, axis = h->axis_rad;
    out[0] = 0;
    for (int side = 0; side < 2; side++) {
        const int b = side ? pin->body_b : pin->body_a;
        const double x = side ? pin->bx_m : pin->ax_m, y = side ? pin->by_m : pin->ay_m;
        const double sign = side ? 1 : -1;
        if (b == FW_GROUND) continue;
        const double c = cos(q[3 * b + 2]), s = sin(q[3 * b + 2]), *u = shape + 3 * b;
        ux += sign * (u[0] - u[2] * (s * x + c * y)), uy += sign * (u[1] + u[2] * (c * x - s * y));
        out[0] += sign * u[2];
        axis += 0.5 * (q[3 * b + 2] - m->body[b].phi_rad);
    }
    if (at_rad) *at_rad = axis;
    out[1] = cos(axis) * ux + sin(axis) * uy, out[2] = cos(axis) * uy - sin(axis) * ux;
}

/* what each flexure that gives has of a mode's stiffness, by the tangent of its element at the pose, J per unit^2; NaN: none */
fw_status fw_statics_hinge_energies(const fw_statics_equilibrium *w, const double *q,
                                    const double *shape, double **energy) {
    FW_NEED(*energy = fw_arena_array(w->arena, double, (size_t)w->mechanism->nhinge + 1));
    for (int i = 0; i < w->mechanism->nhinge; i++)
        (*energy)[i] = (double)NAN;
    for (int j = 0; j < w->model->nelement; j++) {
        const fw_effects_force_element *e = w->model->element[j].own;
        double p[6], d[6], stiff[36], damp[36], sum = 0;
        if (!(e->class_->closed_form || e->class_->beam) || e->ports != 2 || e->pin == FW_NONE)
            continue; /* what acts on slender arms yields, and is no flexure */
        fw_effects_element_place_ports(e, q, shape, p, d);
        const fw_effects_port_state seen = {.load = 1, .p = p, .w = d, .still = true};
        e->class_->tangent(e, &seen, stiff, damp);
        for (int n = 0; n < 36; n++)
            sum += d[n / 6] * stiff[n] * d[n % 6];
        (*energy)[w->mechanism->pin[e->pin].hinge] = sum;
    }
    return FW_OK;
}

/* Of a mode's stiffness, by the energy that each flexure has of it: e = sum k d^2 e_k/whole, with k and e_k of rotation, along
   and across, d as deformed, whole = omega^2 M, M the modal mass: what loads leave of it bears all that is off of what they
   take from; of an unstable one ten times its share. A strip that is displaced far across itself becomes shorter along itself
   by far more than it is stretched: of its stiffest direction counts what its tangent has beyond the other two.
   Source: Rayleigh. Test: test_rest.py, test_near_pull_in.py, test_modes.c errors_go_with_energy */
double fw_statics_shape_error(const fw_mechanism *m, const double *q, const double *shape,
                              bool pins, double whole, const double *energy) {
    double all = 0, off = 0;
    for (int i = 0; i < m->nhinge; i++) {
        const fw_mechanism_hinge *h = &m->hinge[i];
        double d[3], e[3];
        fw_flexure_hinge_at at;
        deformation(m, h, q, shape, d, NULL);
        errors_of(h, pins || !isfinite(h->axis_rad), e);
        fw_flexure_hinge_law_at(&h->law, 0, &at);
        const double k[3] = {m->pin[h->pin].stiffness_Nm_per_rad, at.kx_N_per_m.value,
                             at.ky_N_per_m.value};
        const int stiff = k[1] > k[2] ? 1 : 2;
        double part[3];
        for (int n = 0; n < 3; n++)
            part[n] = k[n] * d[n] * d[n];
        if (energy && !isnan(energy[i]))
            part[stiff] = fmin(part[stiff], fmax(0, energy[i] - part[0] - part[3 - stiff]));
        for (int n = 0; n < 3; n++) {
            if (n > 0 && !(e[n] > 0)) continue;
            all += part[n], off += part[n] * e[n];
        }
    }
    return off > 0 ? off / (isnan(whole) ? all : whole > 0 ? whole : 0.1 * all) : 0;
}
