/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain of a hinge under its rotation and the joint force: by the closed form, by an exact
   beam, and on two neighbouring levels of hinges. */
#include "verdict/strain.h"
#include "base/constants.h"
#include "verdict/verdict.h"
#include <math.h>

/* Wrench on the upper body at W, in the flexure's half-rotated frame:
     M = K theta, F;  section moment M(b) = M + xW Fy + r (Fx sin b - Fy cos b), |b| <= a
     extremum at b* = atan2(Fx, -Fy) or b* + pi where inside, else at an end
   strain = (eps/rad / K) |M(b)| at the roots, without the fillet's concentration inside the arc
   in: radius m, half angle rad, centre m, moment N m, force N; out: largest |M| at the roots and
   inside, N m
   source: docs/theory/verdict.md eq. 2; test_strain.c section_moments_of_a_whole_six_bar */
void fw_verdict_arc_moments(const fw_device_flexure *f, double centre_m, double M, double Fx,
                            double Fy, double *root_Nm, double *inside_Nm) {
    double r = f->radius_m, a = 0.5 * f->angle_rad, pi = FW_PI;
    *root_Nm = *inside_Nm = 0.0;
    for (int side = -1; side <= 1; side += 2) {
        double b = side * a;
        *root_Nm = fmax(*root_Nm, fabs(M + centre_m * Fy + r * (Fx * sin(b) - Fy * cos(b))));
    }
    double b0 = atan2(Fx, -Fy);
    for (int k = -2; k <= 2; k++) {
        double b = b0 + k * pi;
        if (fabs(b) <= a)
            *inside_Nm =
                fmax(*inside_Nm, fabs(M + centre_m * Fy + r * (Fx * sin(b) - Fy * cos(b))));
    }
}

static double largest_lever(const fw_device_flexure *f, double centre_m) {
    double a = 0.5 * f->angle_rad;
    return f->kind == FW_FLEXURE_CSFH ? hypot(f->radius_m * cos(a) - centre_m, f->radius_m * sin(a))
                                      : 0.5 * f->length_m;
}

/* no drawn axis, or a leaf: the force acts on its largest lever wherever it points */
static double bounded_moment(const fw_device_flexure *f, double centre_m, double M,
                             double force_N) {
    return fabs(M) + largest_lever(f, centre_m) * force_N;
}

/* likewise of any centre line: no section is farther from the pin than this */
static double farthest_m(const fw_flexure_path_strain *s, double x, double y) {
    double far = 0;
    for (int i = 0; i < s->n; i++)
        far = fmax(far, hypot(s->point[i].x_m - x, s->point[i].y_m - y));
    return far;
}

/* a flexure that varies: moment and section modulus place by place (flexure/path.h) */
static double varying_strain(const fw_mechanism_hinge *hinge, const fw_layout_hinge_layout *drawn,
                             const fw_verdict_hinge_load *load, double sign) {
    const fw_flexure_result *c = &hinge->closed_form;
    const double W[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    double moment = c->stiffness_Nm_per_rad * load->angle_rad;
    if (!drawn || !drawn->drawn) {
        double most =
            fabs(moment) + farthest_m(&hinge->section, W[0], W[1]) * hypot(load->fx_N, load->fy_N);
        return c->strain_per_rad / c->stiffness_Nm_per_rad * most;
    }
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * load->fx_N, fy = -sign * load->fy_N;
    return fw_flexure_path_strain_at(
        &hinge->section, W,
        (const double[3]){sign * moment, cs * fx + sn * fy, -sn * fx + cs * fy});
}

/* largest |strain|, fillets included */
static double closed_form_strain(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                                 const fw_layout_hinge_layout *drawn,
                                 const fw_verdict_hinge_load *load) {
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    const fw_device_flexure *f = &m->device->flexure[hinge->flexure];
    const fw_flexure_result *c = &hinge->closed_form;
    double per_moment = c->strain_per_rad / c->stiffness_Nm_per_rad;
    double area = fw_device_flexure_narrowest_m(f) * m->variant->thickness_m;
    double force = hypot(load->fx_N, load->fy_N);
    double axial = force / (m->variant->material.youngs.value * area);
    double moment = c->stiffness_Nm_per_rad * load->angle_rad;
    if (hinge->section.n > 0)
        return varying_strain(hinge, drawn, load,
                              drawn && drawn->upper != pin->body_b ? -1.0 : 1.0) +
               axial;
    if (!drawn || !drawn->drawn || f->kind != FW_FLEXURE_CSFH)
        return per_moment * (bounded_moment(f, c->centre_m, moment, force) +
                             hypot(c->offset_m[0], c->offset_m[1]) * force) +
               axial;

    /* what the flexure carries on the upper body is minus what the pin does to it */
    double sign = drawn->upper == pin->body_b ? 1.0 : -1.0;
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * load->fx_N, fy = -sign * load->fy_N, root, inside;
    /* the pin is at the true centre; of a crystal it is off the axis: M - yW Fx */
    double along = cs * fx + sn * fy, centre = c->centre_m + c->offset_m[0];
    fw_verdict_arc_moments(f, centre, sign * moment - c->offset_m[1] * along, along,
                           -sn * fx + cs * fy, &root, &inside);
    return per_moment * fmax(root, inside / c->concentration) + axial;
}

/* M(-a), M(+a) of eq. 2 times eps/(theta K); of a leaf M -+ Fx L/2, x across it. Where the axis is
   not drawn, with the sign of the rotation what both add at most. Test: test_strain.c
   root_strains_have_signs, root_strains_of_a_leaf */
void fw_verdict_hinge_root_strains(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                                   const fw_layout_hinge_layout *drawn,
                                   const fw_verdict_hinge_load *load, double strain[2]) {
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    const fw_device_flexure *f = &m->device->flexure[hinge->flexure];
    const fw_flexure_result *c = &hinge->closed_form;
    double per_moment = c->strain_per_rad / c->stiffness_Nm_per_rad;
    double moment = c->stiffness_Nm_per_rad * load->angle_rad, r = f->radius_m;
    if (hinge->section.n > 0) { /* of the worst section, with the sign of the rotation */
        double worst =
            varying_strain(hinge, drawn, load, drawn && drawn->upper == pin->body_b ? 1.0 : -1.0);
        strain[0] = strain[1] = copysign(worst, load->angle_rad);
        return;
    }
    if (!drawn || !drawn->drawn) {
        double force = hypot(load->fx_N, load->fy_N);
        strain[0] = strain[1] =
            per_moment * copysign(bounded_moment(f, c->centre_m, moment, force) +
                                      hypot(c->offset_m[0], c->offset_m[1]) * force,
                                  load->angle_rad);
        return;
    }
    double sign = drawn->upper == pin->body_b ? 1.0 : -1.0;
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * (cs * load->fx_N + sn * load->fy_N);
    double fy = -sign * (-sn * load->fx_N + cs * load->fy_N);
    for (int side = -1; side <= 1; side += 2) {
        double b = side * 0.5 * f->angle_rad, force = side * 0.5 * f->length_m * fx;
        if (f->kind == FW_FLEXURE_CSFH)
            force = (c->centre_m + c->offset_m[0]) * fy - c->offset_m[1] * fx +
                    r * (fx * sin(b) - fy * cos(b));
        strain[side > 0] = per_moment * (sign * moment + force);
    }
}

/* ---- the same by an exact beam ---- */

static const double tolerance = 1e-8;

fw_status fw_verdict_hinge_beam(fw_arena *arena, const fw_mechanism_hinge *h,
                                fw_flexure_elastica **out) {
    const fw_flexure_result *c = &h->closed_form;
    fw_flexure_beam *beam;
    *out = NULL;
    if (h->stated || !(h->input.length_m > 0) || !isfinite(h->axis_rad)) return FW_OK;
    if (fw_flexure_input_varies(&h->input)) return FW_OK; /* looked at section by section */
    FW_NEED(beam = fw_arena_one(arena, fw_flexure_beam));
    FW_TRY(fw_flexure_beam_of_input(arena, &h->input, c, beam));
    const double pin[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    return fw_flexure_elastica_new(arena, beam, pin, false, out);
}

/* M' = -V (1 + what strains add): |M| is largest where V passes zero, found between two samples by
   the Illinois rule; M is flat there */
static double extreme_between(fw_flexure_elastica *beam, fw_flexure_elastica_state a,
                              fw_flexure_elastica_state b) {
    double va = a.shear_N, vb = b.shear_N, most = fmax(fabs(a.moment_Nm), fabs(b.moment_Nm));
    for (int i = 0; i < 6 && va * vb < 0; i++) {
        fw_flexure_elastica_state m;
        fw_flexure_elastica_at(beam, a.s_m + (b.s_m - a.s_m) * va / (va - vb), &m);
        double v = m.shear_N;
        most = fmax(most, fabs(m.moment_Nm));
        if (v * va > 0) {
            if (v * v < va * va) vb *= 0.5;
            a = m, va = v;
        } else {
            if (v * v < vb * vb) va *= 0.5;
            b = m, vb = v;
        }
    }
    return most;
}

static double largest_inside(fw_flexure_elastica *beam, double length_m) {
    enum { SAMPLES = 9 };
    fw_flexure_elastica_state before, now;
    fw_flexure_elastica_at(beam, 0, &before);
    double most = fabs(before.moment_Nm);
    for (int i = 1; i < SAMPLES; i++, before = now) {
        fw_flexure_elastica_at(beam, length_m * i / (SAMPLES - 1), &now);
        most = fmax(most, fabs(now.moment_Nm));
        if (before.shear_N * now.shear_N < 0) most = fmax(most, extreme_between(beam, before, now));
    }
    return most;
}

/* Section moments of the exact beam that is turned by theta under a dead force at W: those at the
   roots from the solution; inside where the shear force vanishes, looked for only where it could
   count: |M| inside is at most that at a root and force times the way from there.
   in: rad, N, in the first body's frame; out: N m. Error 1e-8. Cost 6 us, with the
   inside 40 us. Source: Reissner, ZAMP 23 (1972); docs/theory/hinge-models.md. Test:
   test_strain_exact.c moments_of_the_six_bar */
bool fw_verdict_exact_moments(fw_flexure_elastica *beam, double theta_rad, const double force_N[2],
                              double kt, double *root_Nm, double *inside_Nm) {
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                           {theta_rad, force_N[0], force_N[1]}};
    const fw_flexure_beam_linear *l = fw_flexure_elastica_linear(beam);
    fw_flexure_elastica_result r;
    fw_flexure_elastica_state end;
    fw_flexure_elastica_solve(beam, &task, tolerance, false, &r);
    if (r.code != FW_ELASTICA_OK && r.code != FW_ELASTICA_ROUGH) return false;
    fw_flexure_elastica_at(beam, l->length_m, &end);
    *root_Nm = fmax(fabs(r.start_Nm), fabs(end.moment_Nm));
    double reach = 0.5 * l->length_m; /* from the nearer root */
    bool counts = *root_Nm + hypot(force_N[0], force_N[1]) * reach > kt * *root_Nm;
    *inside_Nm = counts ? largest_inside(beam, l->length_m) : *root_Nm;
    return true;
}

double fw_verdict_hinge_strain_exact(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                                     const fw_layout_hinge_layout *drawn, fw_flexure_elastica *beam,
                                     const fw_verdict_hinge_load *load) {
    const fw_flexure_result *c = &hinge->closed_form;
    const fw_device_flexure *f = &m->device->flexure[hinge->flexure];
    double root, inside, force = hypot(load->fx_N, load->fy_N);
    /* the second body is b where body a has the root at polar angle -a; the beam does on it what
       the pin does, so that the force that bends the beam is the other way round */
    double sense = hinge->first_is_a ? 1 : -1, theta = sense * load->angle_rad;
    double axis = hinge->axis_rad + load->frame_rad - 0.5 * theta, cs = cos(axis), sn = sin(axis);
    double fx = -sense * load->fx_N, fy = -sense * load->fy_N;
    const double along[2] = {cs * fx + sn * fy, cs * fy - sn * fx};
    double kt = fmax(1, c->concentration);
    if (!beam || !fw_verdict_exact_moments(beam, theta, along, kt, &root, &inside))
        return closed_form_strain(m, hinge, drawn, load);
    return c->strain_per_rad / c->stiffness_Nm_per_rad * fmax(root, inside / kt) +
           force / (m->variant->material.youngs.value * f->width_m * m->variant->thickness_m);
}

/* ---- strains on two neighbouring levels of hinges, and what of it is in the band ---- */

static double turned(const fw_mechanism *m, const double *q, int body) {
    return body == FW_GROUND ? 0 : q[3 * body + 2] - m->body[body].phi_rad;
}

/* by the level's own section moments: of the arc as drawn, or of the exact beam. Leaves have only
   bounds as drawn, which would hide the step: theirs are those of the beam on both levels */
static double strain_of(const fw_mechanism *m, const fw_mechanism_hinge *h,
                        fw_effects_hinge_model level, fw_flexure_elastica *beam,
                        const fw_verdict_hinge_load *load) {
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    const fw_layout_hinge_layout drawn = {.drawn = isfinite(h->axis_rad),
                                          .upper = h->first_is_a ? pin->body_b : pin->body_a,
                                          .axis_rad = h->axis_rad};
    bool arc = m->device->flexure[h->flexure].kind == FW_FLEXURE_CSFH;
    return fw_verdict_hinge_strain_exact(m, h, &drawn,
                                         level == FW_HINGE_ELASTICA || !arc ? beam : NULL, load);
}

static void strains(const fw_mechanism *m, fw_effects_hinge_model level,
                    fw_flexure_elastica *const *beam, const fw_statics_level_state *at) {
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        const double *force = at->reaction_N + 2 * m->hinge[k].pin;
        const fw_verdict_hinge_load load = {
            at->angle_rad[m->hinge[k].pin], force[0], force[1],
            0.5 * (turned(m, at->q, pin->body_a) + turned(m, at->q, pin->body_b))};
        at->strain[k] = strain_of(m, &m->hinge[k], level, beam[k], &load);
    }
}

fw_status fw_verdict_level_strains(fw_arena *arena, const fw_mechanism *m,
                                   const fw_statics_level_step *step) {
    if (!step || step->why_not || !m->device || m->device->nflexure == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_elastica **beam = fw_arena_alloc(arena, (size_t)m->nhinge, sizeof *beam);
    FW_NEED(beam);
    for (int k = 0; k < m->nhinge; k++)
        FW_TRY(fw_verdict_hinge_beam(arena, &m->hinge[k], &beam[k]));
    strains(m, step->used, beam, &step->at);
    strains(m, step->next, beam, &step->up);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* stiffness of the closed form against 3-D finite elements: both levels have it, so that the step
   does not see it, and the angles under given loads follow it */
double fw_verdict_motion_lasting_error(const fw_mechanism *m) {
    double most = 0;
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].stated) most = fmax(most, m->hinge[k].closed_form.error.stiffness);
    return most;
}

/* Largest difference of strain and of angle between the level used and the next at the motion's
   peak, over the largest of either, and what both have in common. In a motion with inertia pins
   are judged by the reference cases where these are worse: frequencies that shift are not in the
   step. Exact beams have no next level: what is left is what they have in common with solids. */
double fw_verdict_motion_model_error(const fw_mechanism *m, const fw_dynamics_motion *x) {
    const fw_statics_level_step *s = x->level;
    double usual = fw_verdict_model_error.motion, common = fw_verdict_motion_lasting_error(m),
           off = 0, largest = 0;
    if (x->ledger.hinge.used == FW_HINGE_ELASTICA) return fmin(usual, common);
    if (!s || s->why_not || m->nhinge == 0) return usual;
    for (int k = 0; k < m->nhinge; k++) {
        if (!isfinite(s->at.strain[k]) || !isfinite(s->up.strain[k])) return usual;
        off = fmax(off, fabs(s->up.strain[k] - s->at.strain[k]));
        largest = fmax(largest, s->at.strain[k]);
    }
    double computed = fmax(largest > 0 ? off / largest : 0, s->relative) + common;
    bool swings = x->loads && !x->loads->quasi_static;
    return s->used == FW_HINGE_REVOLUTE && swings ? fmax(usual, computed) : computed;
}
