/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strain of a hinge under its rotation and the force it carries: by the closed form, by an exact
   beam, and on two neighbouring levels of hinges. */
#include "effects/effects.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include "verdict/verdict.h"
#include <math.h>
#include <string.h>

/* ---- a way through a body, as a beam (body_arms.c) ---- */

void fw_verdict_arm_add(fw_verdict_arm *arm, fw_geometry_vec2 pin, fw_geometry_vec2 at,
                        fw_geometry_vec2 from, fw_geometry_vec2 until, double w) {
    double length = vec_distance(from, until);
    if (!(length > 0)) return;
    fw_geometry_vec2 along = vec_unit(vec_sub(until, from));
    fw_geometry_vec2 r = vec_sub(at, pin), side = vec_left(along);
    /* moment, axial and shear force of M, Fx, Fy there */
    const double m[3] = {1, r.y, -r.x}, a[3] = {0, along.x, along.y}, s[3] = {0, side.x, side.y};
    const int row_of[6] = {0, 0, 0, 1, 1, 2}, column_of[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; k++) {
        int i = row_of[k], j = column_of[k];
        arm->give[k] +=
            length * (12 * m[i] * m[j] / (w * w * w) + (a[i] * a[j] + 3.2 * s[i] * s[j]) / w);
    }
    const double n[3] = {-(along.y * -r.y - along.x * r.x), -along.y, along.x},
                 t[3] = {along.x * -r.y + along.y * r.x, along.x, along.y};
    for (int k = 0; k < 6; k++) {
        int i = row_of[k], j = column_of[k];
        arm->bend[k] += length * n[i] * n[j] / w;
        arm->twist[k] += length * t[i] * t[j] / w;
        arm->twist3[k] += length * t[i] * t[j] / (w * w * w);
    }
    arm->slide += length / w;
    arm->length_m += length;
    if (w < arm->narrow_m) arm->narrow_m = w, arm->narrow = at;
    double edge = 6 * vec_length(r) / (w * w) + 1 / w;
    if (edge > arm->edge_m)
        arm->edge_m = edge, arm->edge_wide_m = w, arm->edge = at, arm->along = along;
    arm->edge_m2 = fmax(arm->edge_m2, 6 / (w * w));
    arm->edge_x_m = fmax(arm->edge_x_m, 6 * fabs(r.y) / (w * w) + 1 / w);
    arm->edge_y_m = fmax(arm->edge_y_m, 6 * fabs(r.x) / (w * w) + 1 / w);
}

double fw_verdict_arm_allowed_N_per_m(const fw_mechanism *m, int hinge, const fw_verdict_arm *arm) {
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&m->hinge[hinge].limits);
    if (!arm->known || !limit) return HUGE_VAL;
    const double walls = m->layout ? 2 * m->layout->edge_m : 0;
    const double made = fmin(fmax(arm->narrow_m + walls, 1e-3 * arm->narrow_m) / arm->narrow_m, 1);
    return limit->allowable_Pa / m->device->safety_factor * m->variant->thickness_m * made * made;
}

double fw_verdict_arm_bears(const fw_mechanism *m, int hinge, const fw_verdict_arm *arm,
                            double moment_Nm, double force_N, const double *along_N) {
    const double corner = 3;
    double by_force = force_N * arm->edge_m;
    if (along_N) by_force = fmin(by_force, along_N[0] * arm->edge_x_m + along_N[1] * arm->edge_y_m);
    return corner * (moment_Nm * arm->edge_m2 + by_force) /
           fw_verdict_arm_allowed_N_per_m(m, hinge, arm);
}

/* ---- and what such a way gives ---- */

void fw_verdict_arm_out_of_plane(const fw_verdict_arm *arm, double youngs_Pa, double poisson,
                                 double thickness_m, double *c) {
    static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const double h = thickness_m, h3 = h * h * h, G = youngs_Pa / (2 * (1 + poisson));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = at[i][j];
            c[3 * i + j] += 12 * arm->bend[k] / (youngs_Pa * h3) +
                            3 / 0.42 * (arm->twist[k] / h3 + arm->twist3[k] / h) / G;
        }
    c[0] += 1.2 * arm->slide / (G * h);
}

double fw_verdict_arm_energy_J(const fw_verdict_arm *arm, double stiff_N, double moment_Nm,
                               double fx_N, double fy_N, const fw_verdict_turn *turn) {
    double c = turn->cosine, s = turn->sine;
    double x = c * fx_N + s * fy_N, y = c * fy_N - s * fx_N, m = moment_Nm;
    const double *g = arm->give;
    /* moment and force as if both bent it one way: what a body gives aside of the loads, as a turn that nothing drives, is not
       bounded by the energy alone, and links bent as an S would leave little (decision 169) */
    return (g[0] * m * m + 2 * fabs(m * (g[1] * x + g[2] * y)) + g[3] * x * x + 2 * g[4] * x * y +
            g[5] * y * y) /
           (2 * stiff_N);
}

double fw_verdict_arm_gone(const fw_verdict_bending *b, const fw_mechanism_hinge *h,
                           const fw_verdict_arm *arm, double moment_Nm, const double force[2],
                           const fw_verdict_turn *turn) {
    const double *g = arm->give, c = turn->cosine, s = turn->sine, m = moment_Nm;
    const double x = c * force[0] + s * force[1], y = c * force[1] - s * force[0];
    const double far = hypot(fabs(g[1] * m) + fabs(g[3] * x + g[4] * y),
                             fabs(g[2] * m) + fabs(g[4] * x + g[5] * y));
    return fmax(far / h->input.width_m,
                (fabs(g[0] * m) + fabs(g[1] * x + g[2] * y)) / h->closed_form.limit_angle_rad) /
           b->stiff_N;
}

/* The closed forms are taken where they are off by less than this (variant.c), and a clearance of a
   motion in parts where it is off by twice that. */
const double fw_verdict_bending_told = 0.05;
/* ---- a largest value ---- */

static void keep(fw_verdict_largest *p, double t_s, double value, double between) {
    if (value <= p->value) return;
    p->value = value;
    p->t_s = t_s;
    p->between = between;
}

/* peak of the parabola through three instants, spacings a and b about the middle one:
     slope = ((s1-s0) b/a + (s2-s1) a/b)/(a+b), bend = 2 ((s2-s1)/b - (s1-s0)/a)/(a+b)
     at t1 - slope/bend, s1 - slope^2/(2 bend)
   in: times s, values; error O(spacing^3) of the peak's height, and `between` bounds it; cost none
   source: Newton's divided differences; test_watch.c finds_the_peak_between_instants */
void fw_verdict_largest_add(fw_verdict_largest *p, double t_s, double value) {
    if (p->samples >= 2) {
        double a = p->t[1] - p->t[0], b = t_s - p->t[1];
        double up = p->last[1] - p->last[0], down = value - p->last[1];
        if (a > 0.0 && b > 0.0 && up >= 0.0 && down <= 0.0 && up - down > 0.0) {
            double slope = (up * b / a + down * a / b) / (a + b);
            double bend = 2.0 * (down / b - up / a) / (a + b);
            double add = -slope * slope / (2.0 * bend);
            keep(p, p->t[1] - slope / bend, p->last[1] + add, add);
        }
    }
    keep(p, t_s, value, 0.0); /* the first and the last instant have no neighbours */
    p->t[0] = p->t[1];
    p->last[0] = p->last[1];
    p->t[1] = t_s;
    p->last[1] = value;
    p->samples++;
}

/* ---- strain ---- */

static const double tolerance = 1e-8;
/* along a motion, from one solution to the next: what is left is some 1e-6 */
static const double followed = 1e-5;
/* directions that are looked at where the axis is not known; between two of them no part of the
   force is more than 1/cos(pi/DIRECTIONS) of what it is along the nearer one */
enum { DIRECTIONS = 24 };
static const double between_directions = 1.0087;
/* of y = F L^2/EI along a strip: from here on the force alone hardly says how far it is bent (at
   -pi^2, with ends that do not turn, not at all), and the place of its ends is taken instead */
static const double pressed = -6;

fw_status fw_verdict_hinge_beam(fw_arena *arena, const fw_mechanism_hinge *h,
                                fw_flexure_elastica **out) {
    const fw_flexure_result *c = &h->closed_form;
    fw_flexure_beam *beam;
    *out = NULL;
    if (!(h->input.length_m > 0) || !isfinite(h->axis_rad)) return FW_OK;
    FW_NEED(beam = fw_arena_one(arena, fw_flexure_beam));
    FW_TRY(fw_flexure_beam_of_input(arena, &h->input, c, beam));
    fw_flexure_beam_scale(beam, h->scale);
    const double pin[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    return fw_flexure_elastica_new(arena, beam, pin, false, out);
}

static bool is_solved(const fw_flexure_elastica_result *r) {
    return r->code == FW_ELASTICA_OK || r->code == FW_ELASTICA_ROUGH;
}

/* Of the equilibria that have one force, that of the place: what its place along the axis is off by
   changes no root's moment by more than this share of the larger one. */
static const double same_moment = 0.01;
/* of the length: what strains nothing, and what a solution that followed another is off by in a strip that is
   pulled hard and hardly bent, where moments say nothing */
static const double rounding_m = 1e-9, followed_m = 1e-3;

static bool is_there(const fw_flexure_elastica_result *r, double c, double s, double apart_m,
                     double near_m) {
    double off = fabs(c * r->twist[1] + s * r->twist[2] - apart_m);
    if (off <= near_m) return true;
    return hypot(r->wrench[1], r->wrench[2]) * off <=
           same_moment * fmax(fabs(r->wrench[0]), fabs(r->start_Nm));
}

/* Has the beam that was found the force that acts? Along a strip that is stiff a place is known to rounding of
   1e-16 alone. */
static const double same_force = 1e-3;

static bool bears(const fw_flexure_elastica_result *r, const double force_N[2], double length_m) {
    double off = hypot(r->wrench[1] - force_N[0], r->wrench[2] - force_N[1]);
    return off <= same_force * hypot(force_N[0], force_N[1]) ||
           off * length_m <= same_moment * fmax(fabs(r->wrench[0]), fabs(r->start_Nm));
}

/* as a motion with exact beams solves it (hinge_element.c): all of the place is given */
static bool in_place(const fw_mechanism_hinge *h, const fw_flexure_hinge_rest *rest,
                     fw_flexure_elastica *beam, const double twist[3], const double force_N[2]) {
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                           {twist[0], twist[1], twist[2]}};
    fw_flexure_elastica_result r;
    double near[3];
    fw_flexure_hinge_law_wrench(&h->law, rest, twist, near, NULL);
    fw_flexure_elastica_near(beam, &task, twist, near, tolerance, &r);
    return is_solved(&r) && bears(&r, force_N, fw_flexure_elastica_linear(beam)->length_m);
}

/* under the force that acts, beginning from the closed form */
static bool under_force(const fw_mechanism_hinge *h, const fw_flexure_hinge_rest *rest,
                        fw_flexure_elastica *beam, const fw_flexure_elastica_task *task,
                        const double along[2], double apart_m) {
    const double th = task->value[0], c = cos(0.5 * th), s = sin(0.5 * th);
    fw_flexure_elastica_result r = {.code = FW_ELASTICA_FAILED};
    double u[2] = {0, 0}, moment = 0, pull = 0;
    const bool placed = isfinite(apart_m);
    const double length_m = fw_flexure_elastica_linear(beam)->length_m;
    bool under = fw_flexure_hinge_law_under(&h->law, rest, th, along, u, &moment, &pull);
    if (under && pull >= pressed && fw_flexure_elastica_again(beam, task, followed, &r) &&
        (!placed || is_there(&r, c, s, apart_m, followed_m * length_m)))
        return true;
    r.code = FW_ELASTICA_FAILED;
    bool held = (!under || pull < pressed) && placed &&
                fw_flexure_hinge_law_held(&h->law, rest, th, along[1], apart_m, u, &moment, &pull);
    const double twist[3] = {th, c * u[0] - s * u[1], s * u[0] + c * u[1]};
    const double wrench[3] = {moment - 0.5 * (u[0] * along[1] - u[1] * along[0]), task->value[1],
                              task->value[2]};
    if (held) fw_flexure_elastica_held(beam, twist, wrench, (const double[2]){c, s}, tolerance, &r);
    if (is_solved(&r) && bears(&r, task->value + 1, length_m)) return true;
    if (under)
        fw_flexure_elastica_near(beam, task, twist, wrench, tolerance, &r);
    else
        fw_flexure_elastica_solve(beam, task, tolerance, false, &r);
    const bool one = under && pull >= pressed; /* equilibrium with this force */
    const double near_m = (one ? followed_m : rounding_m) * length_m;
    return is_solved(&r) && (!placed || is_there(&r, c, s, apart_m, near_m));
}

/* The beam turned by theta under a dead force at W on its second body, in the first one's frame; apart_m:
   where W is on that body, along and across the axis half turned (NaN: not known).
   Where the strip is pressed, more than one equilibrium has this force: it is that near the closed
   form's. A path that turns far, and a strip that is pressed until it bows, leave the closed form, and are
   not found from there: then the beam is sought by its force, and has to be at that place, or by its
   place, and has to bear that force. Error 1e-8, and 1e-5 where one solution
   follows another. Cost 6 us (2 us then), and 0.1 us a section. Source: Reissner, ZAMP 23 (1972);
   docs/theory/hinge-models.md. Test: test_strain_exact.c. */
static bool by_beam(const fw_mechanism_hinge *h, const fw_flexure_hinge_rest *rest,
                    fw_flexure_elastica *beam, double th, const double along[2],
                    const double apart_m[2], fw_flexure_strip_strains *out) {
    const double c = cos(0.5 * th), s = sin(0.5 * th), w = apart_m[0], v = apart_m[1];
    const fw_flexure_elastica_task task = {
        {FW_END_THETA, FW_END_FX, FW_END_FY},
        {th, c * along[0] - s * along[1], s * along[0] + c * along[1]}};
    const double twist[3] = {th, c * w - s * v, s * w + c * v};
    if (!under_force(h, rest, beam, &task, along, w) &&
        !(isfinite(w) && isfinite(v) && in_place(h, rest, beam, twist, task.value + 1)))
        return false;
    fw_flexure_strip_strain_exact(&h->section, beam, out);
    return true;
}

/* with the axis, half turned, in direction axis_rad of the world */
static bool strains_along(const fw_mechanism_hinge *h, fw_flexure_elastica *beam,
                          const fw_verdict_hinge_load *load, double axis_rad,
                          fw_flexure_strip_strains *out) {
    /* the second body is b where body a has the root at polar angle -a; the strip does on it what
       the pin does, so that the force that bends the strip is the other way round */
    double sense = h->first_is_a ? 1 : -1, th = sense * load->angle_rad;
    double c = cos(axis_rad), s = sin(axis_rad), by = -sense;
    const double along[2] = {by * (c * load->fx_N + s * load->fy_N),
                             by * (c * load->fy_N - s * load->fx_N)};
    const double apart[2] = {sense * (c * load->apart_m[0] + s * load->apart_m[1]),
                             sense * (c * load->apart_m[1] - s * load->apart_m[0])};
    fw_flexure_hinge_rest rest; /* a pin's place does not move */
    if (beam || !load->pinned)
        rest = beam ? fw_flexure_hinge_rest_of(&h->law) : fw_flexure_hinge_rest_bare(&h->law);
    if (beam && by_beam(h, &rest, beam, th, along, apart, out)) return true;
    fw_flexure_strip_load strip;
    fw_flexure_strip_load_of(&h->section, &h->law, load->pinned ? NULL : &rest, th, along,
                             isfinite(apart[0]) ? apart : NULL, &strip);
    strip.least_known = load->least_known;
    fw_flexure_strip_strain(&h->section, &strip, out);
    return strip.held && !beam;
}

void fw_verdict_hinge_strain(const fw_mechanism_hinge *h, fw_flexure_elastica *beam,
                             const fw_verdict_hinge_load *load, fw_verdict_hinge_strains *out) {
    fw_flexure_strip_strains now;
    if (isfinite(h->axis_rad)) {
        out->known = strains_along(h, beam, load, h->axis_rad + load->frame_rad, &now);
        out->peak = now.peak, out->least = now.least, out->most = now.most;
        memcpy(out->root, now.root, sizeof now.root);
        return;
    }
    fw_verdict_hinge_load all = *load;
    all.least_known = 0; /* of every direction */
    *out = (fw_verdict_hinge_strains){.least = (double)INFINITY, .known = true};
    for (int i = 0; i < DIRECTIONS; i++) {
        if (!strains_along(h, NULL, &all, i * FW_TURN / DIRECTIONS, &now)) out->known = false;
        out->least = fmin(out->least, now.least), out->most = fmax(out->most, now.most);
        if (!(now.peak > out->peak)) continue;
        out->peak = now.peak;
        memcpy(out->root, now.root, sizeof now.root);
    }
    if (load->fx_N == 0 && load->fy_N == 0) return;
    out->peak *= between_directions, out->least /= between_directions;
    out->most *= between_directions;
    for (int i = 0; i < FW_FACES; i++)
        out->root[i / 2][i % 2] *= between_directions;
}

/* ---- strains on two neighbouring levels of hinges, and what of it is in the band ---- */

/* where a pin is now: bodies and ground that have become longer carry it along (fw_mechanism_strained,
   fw_effects_stretch) */
static fw_geometry_vec2 pin_on(const fw_mechanism *m, const fw_dynamics_instant *now, int body,
                               fw_geometry_vec2 at, fw_geometry_vec2 root) {
    const fw_effects_loads *loads = now->loads;
    const double none[3] = {0}, *p = body == FW_GROUND ? none : now->q + 3 * body;
    if (loads && loads->strained)
        fw_mechanism_strain_pin(loads->strain, m->nbody, fw_mechanism_ground_centre(m), body, root,
                                &at.x, &at.y);
    if (loads && loads->stretch.law && body == FW_GROUND) {
        double law[3] = {(double)NAN};
        if (!isnan(now->t_s))
            fw_quantity_law_value(loads->stretch.law, now->t_s, now->piece_s, law);
        const fw_geometry_vec2 from = vec_sub(vec_add(at, root), loads->stretch.centre_m);
        at = vec_add(at, vec_scale(loads->stretch.strain * law[0], from));
    }
    double c = cos(p[2]), s = sin(p[2]);
    return (fw_geometry_vec2){p[0] + c * at.x - s * at.y, p[1] + s * at.x + c * at.y};
}

fw_verdict_hinge_load fw_verdict_hinge_load_at(const fw_mechanism *m, int k,
                                               const fw_dynamics_instant *now) {
    const int n = m->hinge[k].pin;
    const fw_mechanism_pin *pin = &m->pin[n];
    fw_verdict_hinge_load load = {.angle_rad = now->angle_rad[n],
                                  .fx_N = now->reaction_N[2 * n],
                                  .fy_N = now->reaction_N[2 * n + 1],
                                  .frame_rad = fw_mechanism_pin_half_turned(m, pin, now->q),
                                  .pinned = now->hinge == FW_HINGE_REVOLUTE,
                                  .apart_m = {(double)NAN, (double)NAN}};
    if (load.pinned) return load; /* a pin holds both at one place */
    const fw_geometry_vec2 a = pin_on(m, now, pin->body_a, (fw_geometry_vec2){pin->ax_m, pin->ay_m},
                                      pin->root_a_m),
                           b = pin_on(m, now, pin->body_b, (fw_geometry_vec2){pin->bx_m, pin->by_m},
                                      pin->root_b_m);
    load.apart_m[0] = b.x - a.x, load.apart_m[1] = b.y - a.y;
    return load;
}

static void strains(const fw_mechanism *m, const fw_effects_loads *loads, double t_s,
                    fw_effects_hinge_model level, fw_flexure_elastica *const *beam,
                    const fw_statics_level_state *at) {
    const fw_dynamics_instant then = {.t_s = t_s,
                                      .piece_s = t_s,
                                      .q = at->q,
                                      .angle_rad = at->angle_rad,
                                      .reaction_N = at->reaction_N,
                                      .hinge = level,
                                      .loads = loads};
    for (int k = 0; k < m->nhinge; k++) {
        const fw_verdict_hinge_load load = fw_verdict_hinge_load_at(m, k, &then);
        fw_verdict_hinge_strains s;
        fw_verdict_hinge_strain(&m->hinge[k], level == FW_HINGE_ELASTICA ? beam[k] : NULL, &load,
                                &s);
        at->strain[k] = s.known ? s.peak : (double)INFINITY;
    }
}

fw_status fw_verdict_level_strains(fw_arena *arena, const fw_mechanism *m,
                                   const fw_effects_loads *loads, const fw_statics_level_step *step,
                                   double *share) {
    double largest;
    if (share) *share = 0;
    if (!step || step->why_not || !m->device || m->device->nflexure == 0) return FW_OK;
    if (!share && m->nhinge > 0 && !isnan(step->up.strain[m->nhinge - 1])) return FW_OK; /* there */
    const bool exact = step->used == FW_HINGE_ELASTICA || step->next == FW_HINGE_ELASTICA;
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_elastica **beam = fw_arena_alloc(arena, (size_t)m->nhinge, sizeof *beam);
    FW_NEED(beam);
    for (int k = 0; exact && k < m->nhinge; k++)
        FW_TRY(fw_verdict_hinge_beam(arena, &m->hinge[k], &beam[k]));
    strains(m, loads, step->t_s, step->used, beam, &step->at);
    strains(m, loads, step->t_s, step->next, beam, &step->up);
    fw_arena_rewind(arena, mark);
    if (share) *share = fw_statics_level_strains(step, m->nhinge, &largest);
    if (share && !isfinite(*share)) *share = 0;
    return FW_OK;
}

/* stiffness of the closed form against 3-D finite elements: both levels have it, so that the step
   does not see it, and the angles under given loads follow it */
double fw_verdict_motion_lasting_error(const fw_mechanism *m) {
    double most = 0;
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].stated) most = fmax(most, m->hinge[k].closed_form.error.root_less);
    return most;
}

/* alike: the law of the stiffness is off by as much for either, of the same material */
static bool alike(const fw_mechanism_hinge *a, const fw_mechanism_hinge *b) {
    const double part = 1e-9;
    const fw_flexure_result *p = &a->closed_form, *q = &b->closed_form;
    double K = p->stiffness_Nm_per_rad, k = q->stiffness_Nm_per_rad;
    return a->stated == b->stated && fabs(K - k) <= part * K &&
           fabs(p->strain_per_rad - q->strain_per_rad) <= part * p->strain_per_rad &&
           fabs(p->kx_N_per_m - q->kx_N_per_m) <= part * p->kx_N_per_m;
}

static bool all_alike(const fw_mechanism *m) {
    for (int k = 1; k < m->nhinge; k++)
        if (!alike(&m->hinge[0], &m->hinge[k])) return false;
    return m->nhinge > 0;
}

/* One hinge and nothing else that holds its second body, but for what turns the hinge: the strip is turned, or bears what acts, whatever it
   gives aside. What holds its end in place feels the ends of the strip more than a rotation does, and what a comb
   pulls goes with more than the first power of the stiffness. */
static bool holds_alone(const fw_mechanism *m) {
    const fw_device *d = m->device;
    if (m->nhinge != 1 || m->npin != 1 || m->njoint > 0 || m->nspring > 0 || !d) return false;
    for (int i = 0; i < d->nscene; i++)
        if (d->scene[i].ntendon > 0 || d->scene[i].ncontact > 0 || d->scene[i].ncomb > 0)
            return false;
    return true;
}

/* What the stiffness may add to a strain. The strain per radian is held to solids; what a moment
   strains is that over the stiffness, and less where solids are stiffer than the closed form. Hinges
   that are alike share out loads as before, whatever their one law is off by: then a strain is more
   only by what solids may be softer, and of a single hinge by what their strain per moment may be more. Of
   hinges that are not alike one may get what the other bears less: up to the whole error. */
double fw_verdict_motion_lasting_above(const fw_mechanism *m) {
    if (!all_alike(m)) return fw_verdict_motion_lasting_error(m);
    const fw_flexure_error *e = &m->hinge[0].closed_form.error;
    if (m->hinge[0].stated) return 0;
    return holds_alone(m) ? e->load_more : e->root_more;
}

/* and what it may take away: where all are alike, what strain per moment may be less by than strain per radian */
double fw_verdict_motion_lasting_below(const fw_mechanism *m) {
    if (!all_alike(m)) return fw_verdict_motion_lasting_error(m);
    return m->hinge[0].stated ? 0 : m->hinge[0].closed_form.error.load_less;
}

/* Largest difference of strain and of angle between the level used and the next at the motion's
   peak, over the largest of either, and what both have in common. In a motion with inertia pins
   are judged by the reference cases where these are worse: frequencies that shift are not in the
   step. Exact beams have no next level: what is left is what they have in common with solids, and what contacts leave ringing
   along them, whose phases a percent of stiffness changes (quasi_static.c). Where the
   step is not known and nothing else bounds it, as beside buckling and pull-in, where the next level may have no
   equilibrium, the utilisation may be off by half: a verdict is then neither. Where exact beams are so far from it
   that they may move otherwise, it may be off by all. Where the peak of what heat or stress of the layer presses is several
   times what was compared, as where it jumps at first and rests for most of the scene, nothing was compared of it, and it
   may be off by all, too. (What merely swings is as it is at another instant, but for its size.) */
const double fw_verdict_model_not_known = 0.5;
static const double fw_compared_at_least = 1.0 / 3; /* of the peak strain */

static double peak_strain(const fw_mechanism *m, const fw_dynamics_motion *x) {
    const fw_verdict_strain_monitor *saw = x->observed;
    double most = 0;
    for (int k = 0; saw && k < m->nhinge; k++)
        most = fmax(most, saw->hinge[k].strain.value);
    return most;
}

static double level_error(const fw_mechanism *m, const fw_dynamics_motion *x) {
    const fw_statics_level_step *s = x->level;
    double usual = fw_verdict_model_error.motion, common = fw_verdict_motion_lasting_error(m),
           largest;
    if (x->ledger.hinge.used == FW_HINGE_ELASTICA) return fmin(usual, common) + (s ? s->blows : 0);
    if (s && s->unknown) return fw_verdict_model_not_known;
    if (fw_statics_level_far_apart(s)) return 1; /* of another motion nothing is known */
    if (!s || s->why_not || m->nhinge == 0) return usual;
    const double apart = fw_statics_level_strains(s, m->nhinge, &largest);
    if (isinf(apart)) return fw_verdict_model_not_known;
    if (isnan(apart)) return usual;
    if (fw_effects_has_growth(x->loads) && largest < fw_compared_at_least * peak_strain(m, x))
        return 1;
    double computed = fmax(apart, s->relative) + common;
    bool swings = x->loads && !x->loads->quasi_static;
    return s->used == FW_HINGE_REVOLUTE && swings ? fmax(usual, computed) : computed;
}

/* What no motion has and nothing bounds adds twice the share of the forces, as it does where it is small enough to count
   for nothing else (set_aside in effects/table.c): one volt more makes no band jump. */
double fw_verdict_motion_model_error(const fw_mechanism *m, const fw_dynamics_motion *x) {
    const double level = level_error(m, x);
    return x->ledger.undecided ? fmin(1, level + 2 * x->ledger.undecided_share) : level;
}

/* What effects that no motion has may change of a strain, over what is seen, of which it is at most 1/(1 - that). Errors of
   peak angles and of probes have it; a strip that is pulled or bent aside may not turn at all. A hundredfold is as
   unknown as more. */
double fw_verdict_motion_beside(const fw_dynamics_motion *x) {
    const double most = 100, share = x->ledger.beside;
    double largest = 0;
    for (int i = 0; i < x->npin; i++)
        largest = fmax(largest, fabs(x->peak[i].angle_rad));
    const double more = x->ledger.beside_rad > 0 ? x->ledger.beside_rad / largest : 0;
    return share < 1 ? fmin(share / (1 - share) + more, most) : most;
}

/* rad: the part of it in every peak's error_rad */
double fw_verdict_motion_beside_rad(const fw_dynamics_motion *x) {
    const double out = x->ledger.left_out + x->ledger.beside,
                 all = out > 0 ? fw_dynamics_motion_left_out(x) : 0;
    if (!isfinite(all)) return 0;
    return x->ledger.beside_rad +
           (out > 0 ? (all - x->ledger.beside_rad) * x->ledger.beside / out : 0);
}

/* ---- how near the two of a contact come in a motion (verdict_stiction.c judges it) ---- */

fw_status fw_verdict_touch_watch(fw_arena *arena, const fw_device_scene *scene,
                                 fw_verdict_strain_monitor *monitor) {
    monitor->ntouch = scene->ncontact;
    FW_NEED(monitor->touch = fw_arena_array(arena, fw_verdict_touch, (size_t)scene->ncontact));
    for (int k = 0; k < scene->ncontact; k++)
        monitor->touch[k] = (fw_verdict_touch){HUGE_VAL, HUGE_VAL, &scene->contact[k]};
    return FW_OK;
}

void fw_verdict_touch_record(fw_verdict_strain_monitor *monitor, const fw_dynamics_instant *now) {
    for (int k = 0; k < monitor->ntouch; k++) {
        fw_verdict_touch *t = &monitor->touch[k];
        if (t->use->joint != FW_NONE) continue;
        t->last_m = now ? fw_effects_contact_open(monitor->mechanism, t->use, now->q, NULL)
                        : (double)INFINITY;
        t->least_m = now ? fmin(t->least_m, t->last_m) : (double)INFINITY;
    }
}

/* ---- what flexures are off by in bending and along themselves, each by itself (moved_again.c) ---- */

bool fw_verdict_grows(const fw_verdict_variant_verdict *v, int scene) {
    return v->motion && scene != FW_NONE && v->motion[scene] &&
           fw_effects_has_growth(v->motion[scene]->loads);
}

/* a leaf bends as it turns and as its ends go across it, and its stiffness along is its own; of others all is bending */
void fw_verdict_off_by_itself(const fw_mechanism *m, double *bending, double *along) {
    *bending = *along = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        const fw_flexure_error *e = &h->closed_form.error;
        const bool leaf = fw_flexure_hinge_law_straight(&h->law);
        *bending = fmax(*bending, fmax(h->stated ? 0 : e->stiffness, leaf ? e->kx : 0));
        *along = fmax(*along, leaf ? e->ky : fmax(e->kx, e->ky));
    }
}

fw_verdict_way fw_verdict_way_of(int k, double bending, double along, double gives) {
    const bool bends = k == 0 || k == 2, gave = k == 1 || k == 2;
    const double bent = bends ? 1 / (1 + bending) : 1 + bending, left = 1 / (1 + gives),
                 strip = gave ? left / (1 + along) : 1 + along, all = k == 2 ? left * bent : bent;
    return (fw_verdict_way){.stiffer = all - 1, .along = strip / all - 1, .gives = gave};
}

/* ---- fatigue: cycles that are counted (strain_monitor.c) ---- */

/* D = times sum n_i/N(factor sigma_ar,i),  sigma_ar = sqrt((sigma_a + |sigma_m|) sigma_a)
   in: cycles of stress, Pa; out: 1, and it fails at 1 by the data; linear, without order of loads:
   sums from 0.3 to 3 at failure are usual. Cost: two pow a cycle
   source: M. A. Miner, J. Appl. Mech. 12 (1945) A159; test_fatigue.c miner_of_one_amplitude */
double fw_verdict_miner(const fw_flexure_strain_life *law, const fw_maths_cycle *cycle, size_t n,
                        double times, double factor) {
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double a = fw_flexure_equivalent_amplitude_Pa(0.5 * cycle[i].range, cycle[i].mean);
        sum += cycle[i].count / fw_flexure_strain_life_cycles(law, factor * a);
    }
    return times * sum;
}

/* D rises with the factor, on logarithms nearly as a line: secant, kept inside its bracket. One
   step where the law is Basquin's alone. Test: test_fatigue.c
   utilisation_is_amplitude_over_allowable */
double fw_verdict_fatigue_utilisation(const fw_flexure_strain_life *law,
                                      const fw_maths_cycle *cycle, size_t n, double times) {
    double x = 0, y = log(fw_verdict_miner(law, cycle, n, times, 1)), slope = -1 / law->exponent;
    double low = -(double)INFINITY, high = (double)INFINITY; /* of ln factor */
    if (!isfinite(y)) return y > 0 ? y : 0;
    for (int i = 0; i < 100 && fabs(y) > 1e-12; i++) {
        if (y < 0)
            low = x;
        else
            high = x;
        double next = x - y / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (!isfinite(next) || next == x) break;
        double there = log(fw_verdict_miner(law, cycle, n, times, exp(next)));
        if (!isfinite(there)) break;
        double secant = (there - y) / (next - x);
        if (secant > 0) slope = secant;
        x = next;
        y = there;
    }
    return exp(-x);
}
