/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way to a solution of the elastica: Newton's method, where it begins, and load steps along the
   primary branch. */
#include "flexure/elastica_core.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

enum { MOST_PASSES = 25 };

static int index_of(const fw_flexure_goal *g, fw_flexure_elastica_end end) {
    for (int i = 0; i < 3; i++)
        if (g->given[i] == end) return i;
    return -1;
}

static void ease(const fw_flexure_goal *g, const fw_flexure_end_state *end, double a[3][3],
                 double x[3][3]) {
    int along = index_of(g, FW_END_UX), across = index_of(g, FW_END_UY);
    double c = g->soft[0], s = g->soft[1];
    x[along][0] = c * x[along][0] + s * x[across][0];
    x[across][0] = 0;
    for (int k = 0; k < 3; k++) {
        a[along][k] = c * end->by[FW_END_UX][k] + s * end->by[FW_END_UY][k];
        a[across][k] = c * end->by[FW_END_FY][k] - s * end->by[FW_END_FX][k];
    }
}

static bool step_of(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                    fw_flexure_newton *n, double *change) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_flexure_mesh_pass(e, level, &n->end);
    for (int i = 0; i < 3; i++) {
        x[i][0] = g->value[i] - n->end.value[g->given[i]];
        for (int k = 0; k < 3; k++)
            a[i][k] = n->end.by[g->given[i]][k];
    }
    if (g->eased) ease(g, &n->end, a, x);
    bool regular = fw_maths_solve3(a, 1, x, &det);
    det *= e->mesh[level].growth; /* by the moment at the start, as of the unloaded beam */
    n->stability = e->unloaded != 0 ? det / e->unloaded : (double)NAN;
    if (!regular || !isfinite(det) || n->stability * n->sign < 0) return false;
    const double dp[3] = {x[0][0], x[1][0], x[2][0]};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            n->end.value[i] += n->end.by[i][k] * dp[k];
    *change = fw_flexure_mesh_update(e, level, dp, &n->span);
    n->span = fmin(n->span, 1);
    return isfinite(*change);
}

/* contraction by the affine covariant test of Deuflhard (Newton Methods for Nonlinear Problems,
   section 2.1): each change a fraction of the one before, and the next one in proportion to the
   square of the last; rounding ends what no longer falls.
   in: a state near the solution. out: the solution, n->change the last change (rad, and of p over
   its size), n->end twist and wrench after it with derivatives before it; false: no contraction,
   another sign of the determinant, or not finite. Cost 2 to 5 passes.
   Test: test_elastica_ways.c warm_is_cold, primary_branch */
bool fw_flexure_newton_run(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                           fw_flexure_newton *n) {
    double before = 0, floor = fmax(1e-11, fmin(e->floor, n->tolerance));
    n->ratio = 0;
    for (int i = 0; i < MOST_PASSES; i++) {
        if (!step_of(e, level, g, n, &n->change)) return false;
        if (n->change < 4e-14) return true;
        if (i > 0) {
            double ratio = n->change / before;
            if (ratio > n->contract && n->change > fmax(n->loose, floor)) return false;
            if (ratio > 0.5 && n->change < floor) return true;
            if (i == 1) n->ratio = ratio;
            n->square = ratio / before;
        }
        double next = 10 * n->change * n->change * n->square;
        if (n->square > 0 && n->change <= n->last && next < n->tolerance * n->span) return true;
        before = n->change;
    }
    return false;
}

/* ---- where to begin ---- */

static bool gives(const fw_flexure_goal *g, fw_flexure_elastica_end end, double *value) {
    int i = index_of(g, end);
    if (i >= 0) *value = g->value[i];
    return i >= 0;
}

static void set_moment(fw_flexure_elastica *e, int level, double moment) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    fw_flexure_mesh_fill(e, level);
    e->p[0] = moment;
    e->p[1] = e->p[2] = 0;
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        el->phi = moment * (el->cumulative + el->turned);
        el->start = moment * el->cumulative;
    }
    mesh->end = mesh->turn = moment;
}

/* A strip that hardly stretches answers the least miss along its chord with a large force, which
   spoils the next passes. So the place is first gone to only along the direction that gives, half
   turned with the second body, and the force across is left as it is. */
static bool ease_in(fw_flexure_elastica *e, int level, const fw_flexure_goal *g, double turn,
                    double loose) {
    double angle = 0.5 * (e->twice_soft_rad + turn);
    if (!e->stiff) return true;
    if (index_of(g, FW_END_UX) < 0 || index_of(g, FW_END_UY) < 0) return true;
    fw_flexure_goal easy = *g;
    easy.eased = true;
    easy.soft[0] = cos(angle), easy.soft[1] = sin(angle);
    fw_flexure_newton n = {.tolerance = 1e-4, .last = 1e-3, .contract = 0.4, .loose = loose};
    return fw_flexure_newton_run(e, level, &easy, &n);
}

/* an exact equilibrium: the beam wound by a moment alone, which has the rotation or the moment that
   is given; the first Newton step from there is the law of finite.h */
static void begin_wound(fw_flexure_elastica *e, int level, const fw_flexure_goal *g) {
    double moment = 0;
    if (!e->hinged && !gives(g, FW_END_THETA, &moment)) gives(g, FW_END_M, &moment);
    set_moment(e, level, moment);
    if (!ease_in(e, level, g, moment, 0)) set_moment(e, level, moment);
}

/* rad: so near to a solution changes may grow for a pass or two before they fall, as force and line
   correct one another */
static const double near = 1e-2;

/* the line that a strip takes between root moments M1 and M2 under a pull y = F l^2/EI along it, as a
   column: M(xi) = (M1 sinh z (1 - xi) + M2 sinh z xi)/sinh z, z = sqrt y; phi its integral over EI */
static void set_pulled(fw_flexure_elastica *e, int level, double first, double last, double pull) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    double z = sqrt(pull), over = 1 / -expm1(-2 * z), s = 0, phi = e->root[0] * first;
    for (int n = 0; n < mesh->count; s += mesh->element[n++].h) {
        fw_flexure_element *el = &mesh->element[n];
        el->start = phi;
        el->phi = (fw_nodes){0} + phi;
        for (int j = 0; j < FW_NODES; j++) {
            double x = s + el->h * e->rule.node[j];
            double from = exp(-z * x) - exp(-z * (2 - x)),
                   to = exp(-z * (1 - x)) - exp(-z * (1 + x));
            double slope = el->bend[j] * over * (first * from + last * to);
            el->phi += el->h * slope * e->rule.column[j];
            phi += el->once_end[j] * slope;
        }
    }
    mesh->end = phi;
    mesh->turn = phi + e->root[1] * last;
}

/* Near the twist and the wrench of another law: the wound line, or that of a column where it is
   pulled, under its force across the direction that gives, with the moment that the first root then
   has, M + (W - start + u) x F, and from there as in ease_in. A leaf that is stretched has so large a
   force that from the wound beam alone Newton's method finds it by load steps only, some 80 passes
   instead of 5. */
static bool begin_near(fw_flexure_elastica *e, int level, const double guess[6]) {
    double theta = guess[FW_END_THETA], ux = guess[FW_END_UX], uy = guess[FW_END_UY], turn = 0;
    double fx = guess[FW_END_FX], fy = guess[FW_END_FY], moment = guess[FW_END_M];
    const fw_flexure_goal place = {.given = {FW_END_THETA, FW_END_UX, FW_END_UY},
                                   .value = {theta, ux, uy}};
    if (e->hinged) return false;
    set_moment(e, level, theta);
    for (int n = 0; n < e->mesh[level].count; n++)
        turn += e->mesh[level].element[n].turn;
    /* from the start to the point that is watched, from the end to it, from the start to the end */
    double wx = (e->linear.end.x_m - e->pose[0].x_m) / e->length_m + e->arm[0] + ux;
    double wy = (e->linear.end.y_m - e->pose[0].y_m) / e->length_m + e->arm[1] + uy;
    double ax = cos(theta) * e->arm[0] - sin(theta) * e->arm[1], cx = wx - ax;
    double ay = sin(theta) * e->arm[0] + cos(theta) * e->arm[1], cy = wy - ay;
    double first = moment + wx * fy - wy * fx, last = moment + ax * fy - ay * fx;
    double pull = turn * (fx * cx + fy * cy) / hypot(cx, cy);
    if (pull > 1 && fabs(e->linear.turn_rad) < 1e-9) set_pulled(e, level, first, last, pull);
    e->p[0] = first, e->p[1] = fx, e->p[2] = fy;
    return ease_in(e, level, &place, theta, near);
}

static void keep(fw_flexure_elastica *e, int level) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    mesh->kept = mesh->turn;
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].kept = mesh->element[n].phi;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->kept[k] = e->p[k];
}

static void restore(fw_flexure_elastica *e, int level) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    mesh->turn = mesh->kept;
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].phi = mesh->element[n].kept;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->p[k] = e->kept[k];
}

static double determinant(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                          double *size) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_flexure_end_state end;
    fw_flexure_mesh_pass(e, level, &end);
    *size = 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            a[i][k] = end.by[g->given[i]][k];
        *size *= hypot(hypot(a[i][0], a[i][1]), a[i][2]);
    }
    fw_maths_solve3(a, 0, x, &det);
    return det;
}

/* for another kind of task than the last: the determinant of the unloaded beam, 0 where nothing
   holds it, and the sign of the present one */
void fw_flexure_elastica_unloaded(fw_flexure_elastica *e, const fw_flexure_goal *g) {
    if (e->kind[0] == g->given[0] && e->kind[1] == g->given[1] && e->kind[2] == g->given[2]) return;
    double size;
    fw_flexure_mesh_fill(e, 0);
    keep(e, 0);
    set_moment(e, 0, 0);
    e->unloaded = determinant(e, 0, g, &size);
    if (!(fabs(e->unloaded) > 1e-11 * size)) e->unloaded = 0;
    restore(e, 0);
    for (int i = 0; i < 3; i++)
        e->kind[i] = g->given[i];
    if (e->solved > 0) e->sign = determinant(e, e->solved - 1, g, &size) * e->unloaded < 0 ? -1 : 1;
}

/* ---- the primary branch ---- */

/* all values change together, from those of the present state; a step is taken when the corrector
   contracts well and the determinant keeps its sign. Answers the part reached, with the state
   there: below 1 where steps of 2^-13 are still refused. Cost: in test_elastica_bench.c up to 80
   passes. Source: Deuflhard, section 5.1. Test: test_elastica_ways.c limits_are_told */
static double load_steps(fw_flexure_elastica *e, int level, const double from[3],
                         const fw_flexure_goal *to, double sign, int *steps) {
    enum { HALVINGS = 13 };
    const double least = ldexp(1, -HALVINGS);
    double at = 0, step = 0.25;
    while (at < 1 && step >= least) {
        double next = fmin(1, at + step);
        fw_flexure_goal part = *to;
        for (int i = 0; i < 3; i++)
            if (next < 1) part.value[i] = from[i] + next * (to->value[i] - from[i]);
        fw_flexure_newton n = {.tolerance = 1e-7, .last = 1e-4, .contract = 0.25, .sign = sign};
        keep(e, level);
        ++*steps;
        if (fw_flexure_newton_run(e, level, &part, &n)) {
            at = next;
            if (n.ratio < 0.08) step *= 2;
        } else {
            restore(e, level);
            step *= 0.5;
        }
    }
    return at;
}

static bool from_last(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                      fw_flexure_way *w, fw_flexure_newton *n) {
    const fw_flexure_newton direct = *n;
    double from[3], turn = e->last[FW_END_THETA];
    for (int i = 0; i < 3; i++)
        from[i] = e->last[g->given[i]];
    keep(e, level);
    gives(g, FW_END_THETA, &turn);
    if (ease_in(e, level, g, turn, 0) && fw_flexure_newton_run(e, level, g, n)) return true;
    restore(e, level);
    *n = direct;
    n->contract = 1;
    return load_steps(e, level, from, g, w->sign, &w->steps) == 1 &&
           fw_flexure_newton_run(e, level, g, n);
}

/* a solution on this mesh: from the last one, near the state guessed, from the wound beam, or along
   the branch; false: none. Where the branch ends before, w->reached is below 1 and g holds that part
   of the values. */
bool fw_flexure_elastica_reach(fw_flexure_elastica *e, int level, fw_flexure_goal *g,
                               fw_flexure_way *w, fw_flexure_newton *n) {
    static const double nothing[3] = {0};
    const fw_flexure_newton direct = {
        .tolerance = 0.1 * w->tolerance, .last = 1e-3, .contract = 0.4, .sign = w->sign};
    *n = direct;
    w->reached = 1;
    if (w->warm && from_last(e, level, g, w, n)) return true;
    if (w->warm && (e->unloaded == 0 || w->sign < 0)) return false; /* no other way to it */
    w->warm = false;
    w->sign = 1;
    /* a force may be given that only the other ends of bodies bear: the guess says which way it is */
    bool placed = index_of(g, FW_END_UX) >= 0 && index_of(g, FW_END_UY) >= 0;
    n->sign = placed && !g->eased, n->loose = near;
    if (w->guess && begin_near(e, level, w->guess) && fw_flexure_newton_run(e, level, g, n)) {
        w->sign = n->sign;
        return true;
    }
    if (g->eased) return false;
    begin_wound(e, level, g);
    *n = direct;
    n->sign = 1;
    if (fw_flexure_newton_run(e, level, g, n)) return true;
    set_moment(e, level, 0);
    w->reached = load_steps(e, level, nothing, g, 1, &w->steps);
    for (int i = 0; i < 3; i++)
        g->value[i] *= w->reached;
    *n = direct;
    n->sign = 1;
    n->contract = 1;
    return fw_flexure_newton_run(e, level, g, n);
}

/* What is inside a solved beam: section forces, strain, energy. */

/* values at the start of element n of the solved mesh; its rotations are those of the solution, the
   passes change none */
static const fw_flexure_element *walk(fw_flexure_elastica *e, int n, fw_flexure_carried *at) {
    const fw_flexure_mesh *mesh = &e->mesh[e->solved];
    fw_flexure_elastica_begin(e, at);
    for (int i = 0; i < n; i++)
        fw_flexure_solved_pass(e, i, at);
    return &mesh->element[n];
}

/* from the start of an element over a part of it, as an element of its own: the unknowns are known,
   the rotations follow in a few passes */
static fw_flexure_carried partly(const fw_flexure_elastica *e, const fw_flexure_element *from,
                                 const fw_flexure_carried *start, double part) {
    fw_flexure_element el = {.piece = from->piece, .from = from->from, .h = part * from->h};
    fw_flexure_carried at = *start;
    fw_flexure_element_fill(e, &el);
    el.phi = start->value[PHI] + start->value[MOMENT] * el.turned;
    for (int i = 0; i < 12; i++) {
        double most = 0;
        at = *start;
        fw_flexure_element_pass(&el, &e->p[1], &at);
        el.phi += el.change[0];
        for (int k = 0; k < FW_NODES; k++)
            most = fmax(most, fabs(el.change[0][k]));
        if (most < 1e-15) break;
    }
    return at;
}

static double before_m(const fw_flexure_elastica *e, int piece) {
    double s = 0;
    for (int i = 0; i < piece; i++)
        s += e->beam->piece[i].length_m;
    return s;
}

static void describe(const fw_flexure_elastica *e, const fw_flexure_element *el, double part,
                     const fw_flexure_carried *at, fw_flexure_elastica_state *out) {
    double l = e->length_m, C = e->soft, s_m = l * (el->from + part * el->h);
    fw_flexure_beam_section made;
    fw_flexure_beam_at(e->beam, el->piece, &e->pose[el->piece], s_m, &made);
    double psi = made.pose.psi_rad + at->value[PHI], fx = e->p[1] / (C * l), fy = e->p[2] / (C * l);
    out->s_m = before_m(e, el->piece) + s_m;
    out->pose = (fw_flexure_beam_pose){made.pose.x_m + l * at->value[X],
                                       made.pose.y_m + l * at->value[Y], psi};
    out->rotation_rad = at->value[PHI];
    out->moment_Nm = at->value[MOMENT] / C;
    out->axial_N = fx * cos(psi) + fy * sin(psi);
    out->shear_N = fy * cos(psi) - fx * sin(psi);
    double stretch = out->axial_N * made.axial_per_N;
    double bend = 0.5 * made.width_m * out->moment_Nm * made.bend_per_Nm2;
    out->strain[0] = stretch - bend;
    out->strain[1] = stretch + bend;
}

static double larger(const fw_flexure_elastica_state *at) {
    return fmax(fabs(at->strain[0]), fabs(at->strain[1]));
}

/* in: s from 0 to the length of the beam (m), after a solution; out: state there, at a kink that
   behind it. Error that of the solution: the element before it is integrated afresh up to s, to
   order 16. Cost about 2 us. Test: test_elastica.c inside_a_wound_arc, energy_and_equilibrium */
void fw_flexure_elastica_at(fw_flexure_elastica *e, double s_m, fw_flexure_elastica_state *out) {
    const fw_flexure_mesh *mesh = e->solved < 0 ? NULL : &e->mesh[e->solved];
    *out = (fw_flexure_elastica_state){0};
    if (!mesh) return;
    int n = 0;
    double s = s_m / e->length_m;
    while (n + 1 < mesh->count && s >= mesh->element[n].h)
        s -= mesh->element[n++].h;
    fw_flexure_carried start, at;
    const fw_flexure_element *el = walk(e, n, &start);
    double part = fmin(fmax(s / el->h, 0), 1);
    at = partly(e, el, &start, part);
    describe(e, el, part, &at, out);
}

/* at the nodes of an element of the solution, by the collocation polynomial; its slope and the axial force
   there */
static void moment_at_nodes(const fw_flexure_elastica *e, const fw_flexure_element *el,
                            double start, fw_nodes *out, double slope[FW_NODES],
                            double axial[FW_NODES]) {
    fw_nodes moment = (fw_nodes){0} + start;
    for (int j = 0; j < FW_NODES; j++) {
        double psi = el->psi[j] + el->phi[j], c = cos(psi), s = sin(psi);
        double N = e->p[1] * c + e->p[2] * s, V = e->p[2] * c - e->p[1] * s;
        slope[j] = -(1 + (el->axial[j] - el->shear[j]) * N) * V;
        axial[j] = N;
        moment += el->h * slope[j] * e->rule.column[j];
    }
    *out = moment;
}

enum { PLACES = FW_PLACES }; /* start, nodes and end of an element */

typedef struct curve { /* moment and axial force over one element */
    double moment[PLACES], axial[PLACES];
} curve;

static double axial_at(const fw_flexure_elastica *e, const fw_flexure_element *el, double z,
                       double phi) {
    double psi = e->pose[el->piece].psi_rad + phi + /* as made: a line or an arc */
                 e->beam->piece[el->piece].curvature_per_m * e->length_m * (el->from + z * el->h);
    return e->p[1] * cos(psi) + e->p[2] * sin(psi);
}

/* *phi and *moment go from the start of the element to its end: the rotations are those of the
   solution, moments follow from them */
static curve curve_of(const fw_flexure_elastica *e, int n, double *phi, double *moment) {
    const fw_flexure_mesh *mesh = &e->mesh[e->solved];
    const fw_flexure_element *el = &mesh->element[n];
    curve c = {.moment = {*moment}, .axial = {axial_at(e, el, 0, *phi)}};
    double slope[FW_NODES];
    fw_nodes at;
    moment_at_nodes(e, el, *moment, &at, slope, c.axial + 1);
    for (int i = 0; i < FW_NODES; i++) {
        c.moment[1 + i] = at[i];
        *moment += el->once_end[i] * slope[i];
    }
    *phi = n + 1 < mesh->count ? el[1].start : mesh->end;
    c.moment[PLACES - 1] = *moment, c.axial[PLACES - 1] = axial_at(e, el, 1, *phi);
    return c;
}

/* what the polynomial through all of them at z = 0..1 has of each, in barycentric form */
static void weigh(const fw_flexure_rule *r, double z, double by[PLACES]) {
    double sum = 0;
    for (int k = 0; k < PLACES; k++) {
        double off = z - r->place[k];
        if (off == 0) {
            memset(by, 0, PLACES * sizeof *by);
            by[k] = 1;
            return;
        }
        sum += by[k] = r->between[k] / off;
    }
    for (int k = 0; k < PLACES; k++)
        by[k] /= sum;
}

static bool is_kept(const fw_flexure_between *b, int level, int n, const double *part) {
    return b->level == level && b->n == n && memcmp(b->part, part, (size_t)n * sizeof *part) == 0;
}

/* in: n places along the centre line of the whole beam, ascending, of its length (0..1), after a
   solution; out: moment (N m) and axial force (N) of the section there, at a kink behind it.
   Error: polynomials of order 10 over an element, 1e-7 of the largest moment where the solution has
   1e-9, and 3e-6 of the force over three quarters of a turn. Cost 0.1 us a place and a pass over the mesh;
   a fifth at the same places again. Source: Berrut and Trefethen, SIAM Review 46
   (2004) 501. Test: test_elastica_ways.c forces_along_are_those_at */
void fw_flexure_elastica_along(fw_flexure_elastica *e, int n, const double *part, double *moment_Nm,
                               double *axial_N) {
    const fw_flexure_mesh *mesh = e->solved < 0 ? NULL : &e->mesh[e->solved];
    fw_flexure_between *kept = &e->between;
    double before = 0, by_place[PLACES];
    double turned = e->hinged ? e->p[0] : e->root[0] * e->p[0], bent = e->hinged ? 0 : e->p[0];
    const bool again = is_kept(kept, e->solved, n, part), keep = !again && n <= FW_KEPT_PLACES;
    for (int i = 0, k = 0; mesh && k < mesh->count; before += mesh->element[k++].h) {
        const fw_flexure_element *el = &mesh->element[k];
        bool last = k == mesh->count - 1;
        const curve c = curve_of(e, k, &turned, &bent);
        for (; i < n && (last || part[i] < before + el->h); i++) {
            double moment = 0, axial = 0, *by = again || keep ? kept->by[i] : by_place;
            if (!again) weigh(&e->rule, fmin(fmax((part[i] - before) / el->h, 0), 1), by);
            for (int j = 0; j < PLACES; j++)
                moment += by[j] * c.moment[j], axial += by[j] * c.axial[j];
            moment_Nm[i] = moment / e->soft;
            axial_N[i] = axial / (e->soft * e->length_m);
        }
    }
    if (!mesh || !keep) return;
    kept->level = e->solved, kept->n = n;
    memcpy(kept->part, part, (size_t)n * sizeof *part);
}

/* strain at the nodes of an element and at its ends, by the collocation polynomial */
static void at_places(const fw_flexure_elastica *e, const fw_flexure_element *el,
                      const fw_flexure_carried *start, fw_flexure_elastica_state *out) {
    enum { LAST = FW_NODES + 1 };
    double slope[FW_NODES], axial[FW_NODES];
    fw_nodes moment;
    moment_at_nodes(e, el, start->value[MOMENT], &moment, slope, axial);
    for (int i = 0; i < FW_NODES; i++) {
        const fw_flexure_carried at = {.value = {el->phi[i], moment[i], 0, 0}};
        describe(e, el, e->rule.node[i], &at, &out[1 + i]);
    }
    describe(e, el, 0, start, &out[0]);
    fw_flexure_carried end = *start;
    fw_flexure_element copy = *el;
    fw_flexure_element_pass(&copy, &e->p[1], &end);
    describe(e, el, 1, &end, &out[LAST]);
}

/* golden section between two parts of an element; the largest |strain| there */
static void climb(const fw_flexure_elastica *e, const fw_flexure_element *el,
                  const fw_flexure_carried *start, double low, double high,
                  fw_flexure_elastica_state *best) {
    const double golden = 0.5 * (sqrt(5) - 1);
    fw_flexure_elastica_state at[2];
    double x[2] = {high - golden * (high - low), low + golden * (high - low)};
    for (int k = 0; k < 2; k++) {
        const fw_flexure_carried there = partly(e, el, start, x[k]);
        describe(e, el, x[k], &there, &at[k]);
    }
    for (int i = 0; i < 32; i++) {
        int new = larger(&at[0]) > larger(&at[1]) ? 0 : 1;
        if (larger(&at[new]) > larger(best)) *best = at[new];
        *(new ? &low : &high) = x[!new];
        at[!new] = at[new], x[!new] = x[new];
        x[new] = new ? low + golden *(high - low) : high - golden *(high - low);
        const fw_flexure_carried there = partly(e, el, start, x[new]);
        describe(e, el, x[new], &there, &at[new]);
    }
}

/* the largest |strain| of either fibre: first over all nodes and ends of elements, then by golden
   section beside the largest. Position to 1e-6 of an element, value to its square and the error of
   the solution. Cost about 100 us. Test: test_elastica.c peak_strain */
void fw_flexure_elastica_peak_strain(fw_flexure_elastica *e, fw_flexure_elastica_state *out) {
    fw_flexure_elastica_state at[PLACES];
    int element = -1, place = 0;
    *out = (fw_flexure_elastica_state){0};
    if (e->solved < 0) return;
    fw_flexure_carried start, kept = {0};
    fw_flexure_elastica_begin(e, &start);
    for (int n = 0; n < e->mesh[e->solved].count; n++) {
        fw_flexure_element *el = &e->mesh[e->solved].element[n];
        at_places(e, el, &start, at);
        for (int i = 0; i < PLACES; i++)
            if (element < 0 || larger(&at[i]) > larger(out)) {
                *out = at[i];
                element = n, place = i, kept = start;
            }
        fw_flexure_solved_pass(e, n, &start);
    }
    const fw_flexure_element *el = &e->mesh[e->solved].element[element];
    double z[PLACES] = {0};
    memcpy(z + 1, &e->rule.node, sizeof e->rule.node);
    z[PLACES - 1] = 1;
    climb(e, el, &kept, z[place > 0 ? place - 1 : 0], z[place + 1 < PLACES ? place + 1 : place],
          out);
}

/* U = 1/2 int (M^2/EI + N^2/EA + V^2/(kGA)) ds + 1/2 sum over the roots of dL/EI M^2, by the nodes
   of the solved mesh. Test: test_elastica.c energy_is_work */
double fw_flexure_elastica_energy_J(fw_flexure_elastica *e) {
    if (e->solved < 0) return (double)NAN;
    const fw_flexure_mesh *mesh = &e->mesh[e->solved];
    fw_flexure_carried at;
    fw_flexure_elastica_begin(e, &at);
    double sum = e->hinged ? 0 : e->root[0] * at.value[MOMENT] * at.value[MOMENT];
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        double slope[FW_NODES], axial[FW_NODES];
        fw_nodes moment, stretch;
        moment_at_nodes(e, el, at.value[MOMENT], &moment, slope, axial);
        for (int j = 0; j < FW_NODES; j++) {
            double psi = el->psi[j] + el->phi[j], c = cos(psi), s = sin(psi);
            double N = e->p[1] * c + e->p[2] * s, V = e->p[2] * c - e->p[1] * s;
            stretch[j] = N * N * el->axial[j] + V * V * el->shear[j];
        }
        fw_nodes density = el->once_end * (moment * moment * el->bend + stretch);
        for (int j = 0; j < FW_NODES; j++)
            sum += density[j];
        fw_flexure_solved_pass(e, n, &at);
    }
    sum += e->root[1] * at.value[MOMENT] * at.value[MOMENT];
    return 0.5 * sum / e->soft;
}
