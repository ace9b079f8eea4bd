/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load paths: the curve of equilibria (u, s) from s = 0, followed by arc length so that it may turn
   back. The multipliers are functions of (u, s) and stay eliminated. With the modes Phi of the
   tangent stiffness at the present state (Phi^T K Phi = diag(mu)), forces g = Phi^T Q and
   p = Phi^T (dQ/ds - K du/ds), one Newton step of the corrector is

       diag(mu) z - p ds = g,     a z + b ds = rho,      u += Phi z + ds du/ds,

   the second row asking for the length along the tangent. It is solved by elimination around the
   mode of least |mu|, so that a single mu through zero, as at a fold, does no harm. */
#include "statics/statics_equilibrium.h"
#include "maths/functions.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { FW_POINTS = 2000, FW_CORRECTIONS = 14 };
static const double fw_first_length = 0.02, fw_longest = 0.05, fw_shortest = 1e-10;
static const double fw_beside = 1e-6;   /* step onto a point where stability may be lost */
static const double fw_turn = 0.995;    /* cosine between two tangents, at least */
static const double fw_own_turn = 0.95; /* with displacements in units of what the load moves */
static const double fw_most_move = 0.1; /* of any coordinate in one step, scaled */
static const double fw_far_away = 32;   /* |u| or |s| */

typedef struct state { /* on the path, scaled, with the unit tangent and what events look at */
    double *u, *tangent, s, rate; /* rate = ds along the tangent */
    double *value;                /* (dof) mu */
    double *hold;                 /* (switches) > 0: acts */
    int negative, dof;
} state;

typedef struct follower {
    fw_statics_equilibrium *w;
    fw_statics_path *path;
    state at, next, probe;
    int most, switches, capacity;
    fw_status status; /* of a failed probe inside a root search */
} follower;

/* ---- one bordered solve ---- */

static double weight(const fw_multibody_model *m, int i) {
    return (i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) / m->nbody;
}

/* of displacements in units of w->reach */
static double product(const fw_statics_equilibrium *w, const double *x, const double *y) {
    double sum = 0;
    for (int i = 0; i < w->model->nq; i++)
        sum += weight(w->model, i) * x[i] * y[i];
    return sum / (w->reach * w->reach);
}

/* A soft mode in equilibrium that the load hardly pushes takes no part: round-off, and
   imperfections of 1e-8 of the load, over a stiffness near zero would throw the state off the
   branch just where another one crosses it. Once its force is above round-off it takes part. Near zero is a thousandth of
   the softest where the path begins: of a device whose softest motion has a millionth of its stiffest, a thousandth of that
   one is no zero, and leaving it out broke a smooth path where its force passed 1e-8 of all. */
static bool hardly_pushed(const fw_statics_equilibrium *w, int k) {
    const double small = 1e-8 / (64 * DBL_EPSILON); /* in units of the noise */
    return fabs(w->push[k]) <= small * w->noise[k];
}

static bool hardly_stiff(const fw_statics_equilibrium *w, int k) {
    return fabs(w->reduced.value[k]) <= fmax(w->reduced.zero[k], w->hardly_stiff);
}

static bool idle(const fw_statics_equilibrium *w, int k) {
    return hardly_stiff(w, k) && hardly_pushed(w, k) && fabs(w->gradient[k]) <= w->noise[k];
}

/* step (n) and *ds with the arc-length row (tangent, rate): product(tangent, step) + rate ds = rho.
   `forced`: with the forces g, else for the tangent (g = 0). false: singular, as where branches
   meet at this very point */
static bool bordered(const fw_statics_equilibrium *w, const state *along, double rho, bool forced,
                     double *step, double *ds) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    int pivot = -1;
    for (int k = 0; k < r->dof; k++)
        if (!idle(w, k) && (pivot < 0 || fabs(r->value[k]) < fabs(r->value[pivot]))) pivot = k;
    double b = along->rate + product(w, along->tangent, w->follow), zp = 0, ap = 0;
    for (int k = 0; k < r->dof; k++) {
        if (k == pivot || idle(w, k)) continue;
        double a = product(w, along->tangent, r->shape + (size_t)k * n);
        b += a * w->push[k] / r->value[k];
        if (forced) rho -= a * w->gradient[k] / r->value[k];
    }
    if (pivot >= 0) {
        double mu = r->value[pivot], p = w->push[pivot], g = forced ? w->gradient[pivot] : 0;
        ap = product(w, along->tangent, r->shape + (size_t)pivot * n);
        double det = mu * b + ap * p;
        if (!(fabs(det) > 1e-14 * (fabs(mu * b) + fabs(ap * p)))) return false;
        zp = (b * g + p * rho) / det;
        *ds = (mu * rho - ap * g) / det;
    } else if (b != 0)
        *ds = rho / b;
    else
        return false;
    for (size_t i = 0; i < n; i++)
        step[i] = *ds * w->follow[i];
    for (int k = 0; k < r->dof; k++) {
        if (idle(w, k)) continue;
        double z =
            k == pivot ? zp : ((forced ? w->gradient[k] : 0) + w->push[k] * *ds) / r->value[k];
        for (size_t i = 0; i < n; i++)
            step[i] += z * r->shape[(size_t)k * n + i];
    }
    return isfinite(*ds);
}

/* ---- states ---- */

static fw_status state_new(fw_arena *arena, const fw_multibody_model *m, int switches, state *p) {
    FW_NEED(p->u = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(p->tangent = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(p->value = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(p->hold = fw_arena_array(arena, double, (size_t)switches));
    return FW_OK;
}

static void copy_state(const follower *f, const state *from, state *to) {
    size_t n = (size_t)f->w->model->nq;
    memcpy(to->u, from->u, n * sizeof(double));
    memcpy(to->tangent, from->tangent, n * sizeof(double));
    memcpy(to->value, from->value, n * sizeof(double));
    if (f->switches) memcpy(to->hold, from->hold, (size_t)f->switches * sizeof(double));
    to->s = from->s, to->rate = from->rate, to->negative = from->negative, to->dof = from->dof;
}

static void find_hardly_stiff(fw_statics_equilibrium *w) {
    const double part = 1e-3;
    w->hardly_stiff = part;
    for (int k = w->reduced.dof; k-- > 0;)
        if (w->reduced.value[k] > w->reduced.zero[k])
            w->hardly_stiff = fmin(w->hardly_stiff, part * w->reduced.value[k]);
}

/* fills `to` from the evaluated state; its tangent continues that of `along`. false: no tangent */
static bool take_state(follower *f, const state *along, state *to) {
    fw_statics_equilibrium *w = f->w;
    const fw_multibody_model *m = w->model;
    to->s = w->factor;
    to->negative = 0;
    to->dof = w->reduced.dof;
    for (int k = 0; k < to->dof; k++) {
        to->value[k] = w->reduced.value[k];
        to->negative += to->value[k] < -w->reduced.zero[k];
    }
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    fw_multibody_switch_values(w->system, pose, w->y + m->nq, to->hold);
    memcpy(to->u, w->y, (size_t)m->nq * sizeof(double));
    double ds;
    if (!bordered(w, along, 1, false, w->step, &ds)) return false;
    double length = sqrt(product(w, w->step, w->step) + ds * ds);
    for (int i = 0; i < m->nq; i++)
        to->tangent[i] = w->step[i] / length;
    to->rate = ds / length;
    return isfinite(length);
}

/* Newton onto the equilibrium at `length` along the tangent of `from`; quadratic, ended where steps
   no longer halve. FW_SOLVER: it does not converge. */
static fw_status correct(follower *f, const state *from, double length, state *to) {
    fw_statics_equilibrium *w = f->w;
    const fw_multibody_model *m = w->model;
    double before = (double)INFINITY, *gap = to->tangent;
    for (int i = 0; i < m->nq; i++)
        w->y[i] = from->u[i] + length * from->tangent[i];
    fw_statics_equilibrium_factor(w, from->s + length * from->rate);
    for (int i = 0; i < FW_CORRECTIONS; i++, w->iterations++) {
        FW_TRY(fw_statics_equilibrium_evaluate(w));
        for (int k = 0; k < m->nq; k++)
            gap[k] = w->y[k] - from->u[k];
        double rho = length - product(w, from->tangent, gap) - from->rate * (w->factor - from->s);
        double ds, most = 0;
        if (!bordered(w, from, rho, true, w->step, &ds)) return FW_SOLVER;
        for (int k = 0; k < m->nq; k++)
            most = fmax(most, fabs(w->step[k]));
        most = fmax(most, fabs(ds));
        if (most <= 1e-15 ||
            (most > 0.5 * before && (most < 1e-9 || fw_statics_equilibrium_quiet(w))))
            return take_state(f, from, to) ? FW_OK : FW_SOLVER;
        if (!(most < 4 * before) || most > 1) return FW_SOLVER;
        before = most;
        for (int k = 0; k < m->nq; k++)
            w->y[k] += w->step[k];
        fw_statics_equilibrium_factor(w, w->factor + ds);
    }
    return FW_SOLVER;
}

/* ---- what is kept ---- */

static fw_status grow(follower *f) {
    fw_statics_path *p = f->path;
    fw_arena *arena = f->w->arena;
    size_t old = (size_t)f->capacity, new = old ? 2 * old : 128;
    size_t n = 3 * (size_t)p->nbody, pins = (size_t)p->npin;
    size_t joints = (size_t)p->njoint, drivers = (size_t)p->ndriver;
    FW_NEED(p->factor = fw_arena_grow(arena, p->factor, old, new, sizeof(double)));
    FW_NEED(p->q = fw_arena_grow(arena, p->q, old * n, new *n, sizeof(double)));
    FW_NEED(p->angle_rad =
                fw_arena_grow(arena, p->angle_rad, old * pins, new *pins, sizeof(double)));
    FW_NEED(p->reaction_N = fw_arena_grow(arena, p->reaction_N, old * 2 * pins, new * 2 * pins,
                                          sizeof(double)));
    FW_NEED(p->joint_N = fw_arena_grow(arena, p->joint_N, old * 3 * joints, new * 3 * joints,
                                       sizeof(double)));
    FW_NEED(p->driver_N =
                fw_arena_grow(arena, p->driver_N, old * drivers, new *drivers, sizeof(double)));
    FW_NEED(p->lowest_per_s2 = fw_arena_grow(arena, p->lowest_per_s2, old, new, sizeof(double)));
    FW_NEED(p->negative = fw_arena_grow(arena, p->negative, old, new, sizeof(int)));
    FW_NEED(p->mark = fw_arena_grow(arena, p->mark, old, new, sizeof(fw_statics_path_mark)));
    FW_NEED(p->which = fw_arena_grow(arena, p->which, old, new, sizeof(int)));
    FW_NEED(p->snap_m = fw_arena_grow(arena, p->snap_m, old, new, sizeof(double)));
    FW_NEED(p->snap_rad = fw_arena_grow(arena, p->snap_rad, old, new, sizeof(double)));
    f->capacity = (int)new;
    return FW_OK;
}

/* the evaluated state as a point of the path */
static fw_status record(follower *f, const state *p, fw_statics_path_mark mark, int which) {
    fw_statics_path *path = f->path;
    if (path->count == f->capacity) FW_TRY(grow(f));
    size_t i = (size_t)path->count++, n = 3 * (size_t)path->nbody, pins = (size_t)path->npin;
    path->factor[i] = mark == FW_PATH_END ? 1 : p->s;
    fw_statics_equilibrium_pose(f->w, p->u, path->q + i * n, path->angle_rad + i * pins);
    fw_statics_equilibrium_reactions(f->w, path->reaction_N + i * 2 * pins,
                                     path->joint_N + i * 3 * (size_t)path->njoint,
                                     path->driver_N + i * (size_t)path->ndriver);
    path->lowest_per_s2[i] =
        p->dof ? p->value[0] * fw_statics_equilibrium_per_s2(f->w) : (double)NAN;
    path->negative[i] = p->negative;
    path->mark[i] = mark;
    path->which[i] = which;
    path->snap_m[i] = path->snap_rad[i] = (double)NAN;
    return FW_OK;
}

/* ---- events inside a step ---- */

typedef struct event {
    fw_statics_path_mark mark;
    int which; /* a switch, or the eigenvalue that passes zero */
    double length;
} event;

typedef struct search {
    follower *f;
    const event *event;
} search;

static double event_value(const event *e, const state *p) {
    switch (e->mark) {
    case FW_PATH_FOLD:
        return p->rate;
    case FW_PATH_BIFURCATION:
        return p->value[e->which];
    case FW_PATH_SWITCH:
        return p->hold[e->which];
    case FW_PATH_POINT:
    case FW_PATH_END:
        break;
    }
    return p->s - 1;
}

static double probe(const void *context, double length) {
    const search *in = context;
    follower *f = in->f;
    if (length == 0) return event_value(in->event, &f->at);
    fw_status status = correct(f, &f->at, length, &f->probe);
    if (status != FW_OK) {
        if (status != FW_SOLVER) f->status = status;
        return (double)NAN;
    }
    return event_value(in->event, &f->probe);
}

static bool sign_changes(double a, double b) {
    return (a < 0) != (b < 0);
}

/* what happens between f->at and f->next, `length` apart, in order; at most `most` */
static int find_events(follower *f, double length, event *found, int most) {
    const state *a = &f->at, *b = &f->next;
    int count = 0;
    bool fold = sign_changes(a->rate, b->rate);
    if (fold) found[count++] = (event){FW_PATH_FOLD, FW_NONE, length};
    if (a->dof == b->dof && a->negative != b->negative) {
        int change =
            a->negative > b->negative ? a->negative - b->negative : b->negative - a->negative;
        int lowest = a->negative < b->negative ? a->negative : b->negative;
        if (!fold || change > 1) found[count++] = (event){FW_PATH_BIFURCATION, lowest, length};
    }
    for (int i = 0; i < f->switches && count + 1 < most; i++)
        if ((a->hold[i] > 0) != (b->hold[i] > 0))
            found[count++] = (event){FW_PATH_SWITCH, i, length};
    if (a->s < 1 && b->s >= 1) found[count++] = (event){FW_PATH_END, FW_NONE, length};
    for (int i = 0; i < count; i++) {
        const search in = {f, &found[i]};
        double where = fw_maths_brent_root(probe, &in, 0, length, 1e-16);
        if (isfinite(where)) found[i].length = where;
    }
    for (int i = 1; i < count; i++) /* few: by insertion */
        for (int k = i; k > 0 && found[k].length < found[k - 1].length; k--) {
            event keep = found[k];
            found[k] = found[k - 1];
            found[k - 1] = keep;
        }
    return count;
}

/* the state at an event; where branches meet the last one before it that converges */
static fw_status state_at(follower *f, double length, double step) {
    fw_status status = correct(f, &f->at, length, &f->probe);
    for (double back = 1e-9 * step; status == FW_SOLVER && back < 0.2 * step; back *= 8)
        status = correct(f, &f->at, fmax(length - back, 0), &f->probe);
    return status;
}

/* At an evaluated state where the mode has no stiffness: another branch crosses there only where the load does not push along
   it. Else that is a limit point, or the step went from one branch to another that no equilibrium joins. Paths that end
   where they become unstable come as near as they go. Source: Seydel 1994, ch. 2. */
static bool meets_another(const follower *f, int mode) {
    return f->w->until_unstable || (hardly_stiff(f->w, mode) && hardly_pushed(f->w, mode));
}

/* records the events of the step; *ended when one of them is s = 1; *searched: the model is
   elsewhere now */
static fw_status record_events(follower *f, double length, bool *ended, bool *searched) {
    enum { MOST = 16 };
    event found[MOST];
    int count = find_events(f, length, found, MOST);
    *searched = count > 0;
    FW_TRY(f->status);
    for (int i = 0; i < count; i++) {
        fw_status status = state_at(f, found[i].length, length);
        if (status == FW_SOLVER) continue;
        FW_TRY(status);
        if (found[i].mark == FW_PATH_BIFURCATION && !meets_another(f, found[i].which)) continue;
        *ended = found[i].mark == FW_PATH_END;
        int which = found[i].mark == FW_PATH_SWITCH ? found[i].which : FW_NONE;
        FW_TRY(record(f, &f->probe, found[i].mark, which));
        if (*ended) break;
    }
    return FW_OK;
}

/* ---- the walk ---- */

/* the mode's stiffness passes zero within the step at a point that meets another branch; the model is there then */
static bool crosses_another(follower *f, int mode, double length) {
    const event passes = {FW_PATH_BIFURCATION, mode, length};
    const search in = {f, &passes};
    const double where = fw_maths_brent_root(probe, &in, 0, length, 1e-16);
    return isfinite(where) && state_at(f, where, length) == FW_OK && meets_another(f, mode);
}

static double largest_move(const follower *f) {
    double most = 0;
    for (int i = 0; i < f->w->model->nq; i++)
        most = fmax(most, fabs(f->next.u[i] - f->at.u[i]));
    return most;
}

/* a stop, a cable or a contact takes hold or lets go in the step */
static bool switches_between(const follower *f) {
    for (int i = 0; i < f->switches; i++)
        if ((f->at.hold[i] > 0) != (f->next.hold[i] > 0)) return true;
    return false;
}

/* Between the tangents, displacements in units of what the load moves at the first of them, so that it counts like the load
   there: of what moves by micrometres in a device of millimetres nothing is seen in units of its size. */
static double own_cosine(const follower *f) {
    const double most = 1e6; /* displacements below a millionth of the unit are none */
    const state *a = &f->at, *b = &f->next;
    const double aa = product(f->w, a->tangent, a->tangent),
                 bb = product(f->w, b->tangent, b->tangent),
                 ab = product(f->w, a->tangent, b->tangent);
    const double times = fmin(fmax(1, fabs(a->rate) / sqrt(fmax(aa, DBL_MIN))), most);
    const double scale = times * times;
    return (scale * ab + a->rate * b->rate) /
           sqrt((scale * aa + a->rate * a->rate) * (scale * bb + b->rate * b->rate));
}

/* small enough that the tangent turns little and nothing jumps; a switch may bend the path. Paths that end where they become
   unstable have a unit of their own, a gap */
static bool acceptable(const follower *f, double length) {
    if (length < 1e-3 && switches_between(f)) return true;
    double cosine = product(f->w, f->at.tangent, f->next.tangent) + f->at.rate * f->next.rate;
    return cosine >= fw_turn && (f->w->until_unstable || own_cosine(f) >= fw_own_turn) &&
           largest_move(f) <= fw_most_move * f->w->reach;
}

/* An eigenvalue passes zero without a limit point: a bifurcation, or the step went across from a
   branch that turns back, or away, onto another one. Imperfections d (of the load) make the first the second,
   with a turn of radius d^(1/3) that long steps pass over; the loss of stability would be found at
   a place that is off by up to d^(2/3). Where the load does not push along that mode it is the first. */
static bool may_have_crossed(follower *f, double length) {
    const state *a = &f->at, *b = &f->next;
    if (a->dof != b->dof || a->negative == b->negative || sign_changes(a->rate, b->rate))
        return false;
    if (f->w->until_unstable) return b->negative > a->negative && length > fw_beside;
    if (length < 1e-3 && switches_between(f)) return false;
    const int mode = a->negative < b->negative ? a->negative : b->negative;
    return length > fw_beside ? !hardly_pushed(f->w, mode) : !crosses_another(f, mode, length);
}

static bool out_of_reach(const follower *f) {
    for (int i = 0; i < f->w->model->nq; i++)
        if (!(fabs(f->at.u[i]) < fw_far_away)) return true;
    return !(fabs(f->at.s) < fw_far_away);
}

static fw_status walk(follower *f) {
    double length = fw_first_length;
    bool ended = false;
    while (!ended && f->path->count < f->most && !out_of_reach(f)) {
        if (fw_arena_cancelled(f->w->arena)) return FW_CANCELLED;
        fw_status status = correct(f, &f->at, length, &f->next);
        if (status != FW_OK && status != FW_SOLVER) return status;
        if (status != FW_OK || !acceptable(f, length) || may_have_crossed(f, length)) {
            length /= 2;
            if (length < fw_shortest) return FW_OK;
            continue;
        }
        bool searched;
        FW_TRY(record_events(f, length, &ended, &searched));
        if (ended) break;
        if (f->w->until_unstable && f->next.negative > f->at.negative) return FW_OK;
        if (searched) FW_TRY(correct(f, &f->at, length, &f->next));
        FW_TRY(record(f, &f->next, FW_PATH_POINT, FW_NONE));
        fw_arena_tell(f->w->arena, "following the load path", f->path->count, -f->most,
                      "equilibria");
        copy_state(f, &f->next, &f->at);
        length = fmin(fw_longest, 1.5 * length);
    }
    f->path->complete = ended;
    return FW_OK;
}

/* ---- snapping ---- */

/* from each fold at which the load was growing: the equilibrium that descent finds just above it */
static fw_status snaps(follower *f) {
    fw_statics_path *p = f->path;
    fw_statics_equilibrium *w = f->w;
    size_t n = (size_t)w->model->nq, bytes = n * sizeof(double);
    double *keep, *q, s = w->factor;
    FW_NEED(keep = fw_arena_array(w->arena, double, n));
    FW_NEED(q = fw_arena_array(w->arena, double, n));
    memcpy(keep, w->y, bytes);
    for (int i = 1; i + 1 < p->count; i++) {
        if (p->mark[i] != FW_PATH_FOLD || p->factor[i - 1] > p->factor[i]) continue;
        const double *fold = p->q + (size_t)i * n, *after = fold + n;
        for (size_t k = 0; k < n; k++) { /* a little past the fold, where the path goes on */
            double unit = k % 3 == 2 ? 1 : w->model->scale.length_m;
            w->y[k] = (fold[k] + 1e-2 * (after[k] - fold[k]) - w->q0[k]) / unit;
        }
        fw_statics_equilibrium_factor(w, p->factor[i] + 1e-6 * fmax(1, fabs(p->factor[i])));
        bool unstable = false;
        fw_status status = fw_statics_equilibrium_descend(w, &unstable);
        if (status == FW_SOLVER) continue;
        FW_TRY(status);
        fw_statics_equilibrium_pose(w, w->y, q, NULL);
        p->snap_m[i] = p->snap_rad[i] = 0;
        for (size_t k = 0; k < n; k += 3) {
            double way = hypot(q[k] - fold[k], q[k + 1] - fold[k + 1]);
            p->snap_m[i] = fmax(p->snap_m[i], way);
            p->snap_rad[i] = fmax(p->snap_rad[i], fabs(q[k + 2] - fold[k + 2]));
        }
    }
    memcpy(w->y, keep, bytes);
    fw_statics_equilibrium_factor(w, s);
    return fw_statics_equilibrium_evaluate(w);
}

/* Follows the equilibria from w->y, which is one at s = 0, to s = 1 or to where they end. Steps
   adapt to the turning of the tangent; limit points, bifurcations, switches and s = 1 are located
   as roots along the arc to round-off (Brent). A limit point is where ds along the tangent changes
   sign; a sign change of an eigenvalue of the reduced stiffness without one is a bifurcation. Cost:
   about 4 evaluations (30 n^3) per point. Source: Keller 1977; Allgower and Georg, Numerical
   Continuation Methods 1990, ch. 6; block elimination of the bordered system, Chan 1984. Test:
   test_statics.c (von Mises truss, buckling columns). */
fw_status fw_statics_equilibrium_follow(fw_statics_equilibrium *w, int most_points,
                                        fw_statics_path **out) {
    follower f = {.w = w, .most = most_points > 0 ? most_points : FW_POINTS};
    fw_statics_path *path;
    f.switches = fw_multibody_switch_count(w->model);
    FW_NEED(path = f.path = fw_arena_one(w->arena, fw_statics_path));
    path->nbody = w->mechanism->nbody;
    path->npin = w->mechanism->npin;
    path->njoint = w->mechanism->njoint;
    path->ndriver = w->mechanism->ndriver;
    FW_TRY(state_new(w->arena, w->model, f.switches, &f.at));
    FW_TRY(state_new(w->arena, w->model, f.switches, &f.next));
    FW_TRY(state_new(w->arena, w->model, f.switches, &f.probe));
    find_hardly_stiff(w);
    f.probe.rate = 1;                                /* the first tangent: more load */
    bool leads_on = take_state(&f, &f.probe, &f.at); /* not where nothing holds against the load */
    FW_TRY(record(&f, &f.at, FW_PATH_POINT, FW_NONE));
    fw_status status = leads_on ? walk(&f) : FW_OK;
    if (status == FW_SOLVER) status = FW_OK; /* what was found stands; complete says no */
    FW_TRY(status);
    if (path->complete) FW_TRY(snaps(&f));
    *out = path;
    return FW_OK;
}
