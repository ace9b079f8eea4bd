/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion, an equilibrium with its load path, and modes as JSON. */
#include "report/report.h"
#include "report/json_parts.h"
#include <math.h>

/* ---- parts ---- */

static void effects(fw_json *json, const fw_effect_ledger *ledger) {
    fw_json_list(json, "effects");
    fw_report_json_effects(json, ledger, NULL, NULL);
    fw_json_end(json);
}

static void rank(fw_json *json, const fw_statics_row_rank *r) {
    fw_json_object(json, "constraints");
    fw_json_whole(json, "rows", r->rows);
    fw_json_whole(json, "rank", r->rank);
    fw_json_real(json, "smallest_kept", r->kept);
    fw_json_real(json, "largest_dropped", r->dropped);
    fw_json_text(json, "redundant", r->joints);
    fw_json_end(json);
}

/* null: no hinge has a model */
static void hinge_model(fw_json *json, const fw_mechanism *m, const fw_effects_hinge_use *use,
                        const fw_statics_level_step *level) {
    if (!use->why) {
        fw_json_null(json, "hinge_model");
        return;
    }
    fw_json_object(json, "hinge_model");
    fw_report_json_hinge_model(json, m, use, level);
    fw_json_end(json);
}

/* ---- a motion ---- */

static void stats(fw_json *json, const fw_dynamics_motion *m) {
    const fw_dynamics_motion_stats *s = &m->stats;
    fw_json_object(json, "stats");
    fw_json_whole(json, "steps", s->steps);
    fw_json_whole(json, "rejected", s->rejected);
    fw_json_whole(json, "rhs", s->rhs);
    fw_json_whole(json, "projections", s->projections);
    fw_json_real(json, "cpu_s", s->cpu_s);
    fw_json_real(json, "max_constraint_norm", s->max_constraint_norm);
    fw_json_real(json, "max_velocity_norm", s->max_velocity_norm);
    fw_json_real(json, "energy_error", s->energy_error);
    fw_json_real(json, "largest_energy_J", s->largest_energy_J);
    fw_json_whole(json, "events", s->events);
    fw_json_whole(json, "jacobians", s->jacobians);
    fw_json_whole(json, "factorisations", s->factorisations);
    fw_json_real(json, "rtol", s->rtol);
    fw_json_real(json, "assembly_moved_m", s->assembly_moved_m);
    fw_json_real(json, "velocity_moved", s->velocity_moved);
    fw_json_end(json);
}

/* what was wanted of it, what it is taken to be, and what that took, all runs counted */
static void accuracy(fw_json *json, const fw_dynamics_motion *m) {
    const fw_dynamics_motion_stats *s = &m->stats;
    double estimated = fw_dynamics_motion_estimated(m);
    fw_json_object(json, "accuracy");
    fw_json_real(json, "wanted", m->accuracy);
    fw_json_real(json, "estimated", estimated);
    fw_json_truth(json, "reached", estimated <= m->accuracy);
    fw_json_text(json, "reason", m->tolerance);
    fw_json_real(json, "rtol", s->rtol);
    fw_json_real(json, "looser_rtol", s->looser_rtol);
    fw_json_whole(json, "runs", s->runs);
    fw_json_whole(json, "steps", s->all_steps);
    fw_json_whole(json, "rhs", s->all_rhs);
    fw_json_real(json, "cpu_s", s->cpu_s + s->estimate_cpu_s);
    fw_json_end(json);
}

static void peaks(fw_json *json, const fw_mechanism *mechanism, const fw_dynamics_motion *m) {
    fw_json_list(json, "peaks");
    for (int k = 0; k < m->npin; k++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "hinge", mechanism->pin[k].id);
        fw_json_real(json, "angle_rad", m->peak[k].angle_rad);
        fw_json_real(json, "t_s", m->peak[k].t_s);
        fw_json_real(json, "error_rad", m->peak[k].error_rad);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static const char *const joint_kind[] = {
    [FW_JOINT_PRISMATIC] = "prismatic", [FW_JOINT_DISTANCE] = "distance", [FW_JOINT_WELD] = "weld"};

/* the torque of what has one; where there is no force (a driver that turns) the time is its own */
static void reaction(fw_json *json, const char *id, const char *kind,
                     const fw_dynamics_force_peak *p, bool turns, bool is_force) {
    fw_json_object(json, NULL);
    fw_json_text(json, "joint", id);
    fw_json_real(json, "force_N", p->force_N);
    fw_json_real(json, "t_s", is_force ? p->t_s : p->torque_t_s);
    fw_json_real(json, "error_N", p->error_N);
    fw_json_text(json, "kind", kind);
    if (turns) {
        fw_json_real(json, "torque_Nm", p->torque_Nm);
        fw_json_real(json, "torque_t_s", p->torque_t_s);
        fw_json_real(json, "torque_error_Nm", p->torque_error_Nm);
    }
    fw_json_end(json);
}

/* largest forces of revolute joints, of the others, of drivers */
static void reactions(fw_json *json, const fw_mechanism *mechanism, const fw_dynamics_motion *m) {
    fw_json_list(json, "reactions");
    for (int k = 0; m->force_peak && k < m->npin; k++)
        reaction(json, mechanism->pin[k].id, "revolute", &m->force_peak[k], false, true);
    for (int k = 0; m->joint_peak && k < m->njoint; k++) {
        const fw_device_joint *t = &mechanism->joint[k];
        reaction(json, t->id, joint_kind[t->kind], &m->joint_peak[k], t->kind != FW_JOINT_DISTANCE,
                 true);
    }
    for (int k = 0; m->driver_peak && k < m->ndriver; k++) {
        bool turns = mechanism->driver[k].revolute != FW_NONE;
        reaction(json, mechanism->driver[k].id, "driver", &m->driver_peak[k], turns, !turns);
    }
    fw_json_end(json);
}

/* extremes of prismatic joints */
static void travels(fw_json *json, const fw_mechanism *mechanism, const fw_dynamics_motion *m) {
    fw_json_list(json, "travels");
    for (int k = 0; m->travel_peak && k < m->njoint; k++) {
        if (mechanism->joint[k].kind != FW_JOINT_PRISMATIC) continue;
        fw_json_object(json, NULL);
        fw_json_text(json, "joint", mechanism->joint[k].id);
        fw_json_real(json, "travel_m", m->travel_peak[k].travel_m);
        fw_json_real(json, "t_s", m->travel_peak[k].t_s);
        fw_json_real(json, "error_m", m->travel_peak[k].error_m);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void final_state(fw_json *json, const fw_mechanism *mechanism, const fw_dynamics_motion *m) {
    if (m->nsample < 1) {
        fw_json_null(json, "final");
        return;
    }
    size_t last = 3 * (size_t)m->nbody * (size_t)(m->nsample - 1);
    fw_json_object(json, "final");
    fw_json_real(json, "t_s", m->t_s[m->nsample - 1]);
    const double *q = m->q + last, *v = m->v + last;
    fw_report_json_poses(json, "q", mechanism, q);
    fw_report_json_velocities(json, "v", mechanism, q, v);
    fw_report_json_accelerations(json, "a", mechanism, q, v, m->accel + last);
    fw_report_json_centres(json, mechanism, q);
    fw_json_end(json);
}

/* ---- probes ---- */

static void probe_head(fw_json *json, const fw_device_probe *p) {
    const fw_device_probe_kind *kind = &fw_device_probe_kinds[p->row];
    fw_json_object(json, NULL);
    fw_json_text(json, "id", p->id);
    fw_json_text(json, "kind", kind->name);
    fw_json_text(json, "unit", kind->unit);
}

void fw_report_json_probe(fw_json *json, const fw_device_probe *p, const char *scene,
                          const char *flow, const fw_probe_result *r) {
    probe_head(json, p);
    if (scene) {
        fw_json_text(json, "scene", scene);
        fw_json_text(json, "flow", flow);
    }
    fw_json_real(json, "peak", r->peak);
    fw_json_real(json, "t_s", r->peak_t_s);
    fw_json_real(json, "error", r->numeric);
    fw_json_real(json, "maximum", r->maximum);
    fw_json_real(json, "maximum_t_s", r->maximum_t_s);
    fw_json_real(json, "minimum", r->minimum);
    fw_json_real(json, "minimum_t_s", r->minimum_t_s);
    fw_json_real(json, "final", r->final);
    fw_json_real(json, "final_error", r->final_numeric);
    fw_json_real(json, "across", r->across);
    fw_json_real(json, "level_error", r->level);
    fw_json_end(json);
}

static void probes_of_motion(fw_json *json, const fw_mechanism *mechanism,
                             const fw_dynamics_motion *m) {
    const fw_probe_monitor *saw = fw_probe_count(mechanism) > 0 ? m->observed : NULL;
    fw_json_list(json, "probes");
    for (int i = 0; saw && i < fw_probe_count(mechanism); i++) {
        fw_probe_result r;
        fw_probe_result_of(saw, m->compared, m, i, &r);
        if (r.known) fw_report_json_probe(json, &mechanism->device->probe[i], NULL, NULL, &r);
    }
    fw_json_end(json);
}

/* values at the equilibrium; those of small motions are in modes and verdicts */
static fw_status probes_of_statics(fw_json *json, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene, const fw_statics *s,
                                   fw_arena *arena) {
    fw_probe *probe;
    fw_json_list(json, "probes");
    FW_TRY(fw_probe_bind(arena, mechanism, scene, s->loads, &probe));
    for (int i = 0; i < fw_probe_count(mechanism); i++) {
        if (!fw_report_probe_moves(&probe[i])) continue;
        probe_head(json, probe[i].asked);
        fw_json_real(json, "value", fw_probe_at_equilibrium(&probe[i], scene, s));
        fw_json_end(json);
    }
    fw_json_end(json);
    return FW_OK;
}

void fw_report_probe_small(const fw_probe *probe, const fw_statics_modes *modes,
                           const fw_mechanism_plates *plates, double *value, double *error) {
    const fw_mechanism_frequencies in = {modes->count > 0 ? &modes->mode[0].f_Hz : NULL,
                                         modes->count, sizeof *modes->mode},
                                   out = {plates->f_Hz, plates->n, sizeof *plates->f_Hz};
    bool across = false;
    *value = fw_probe_small(probe, modes), *error = fw_probe_small_error(probe, modes);
    if (probe->asked->row == FW_PROBE_IS_frequency) {
        int at = fw_mechanism_plates_nth(probe->asked->mode, probe->asked->plane, in, out, &across);
        *value = at < 0 ? (double)NAN : across ? plates->f_Hz[at] : modes->mode[at].f_Hz;
        if (across) *error = 0.5 * plates->error;
    }
    *error *= fabs(*value);
}

static void probes_of_modes(fw_json *json, fw_probe *probe, int n, const fw_statics_modes *modes,
                            const fw_mechanism_plates *plates) {
    fw_json_list(json, "probes");
    for (int i = 0; i < n; i++) {
        double value, error;
        if (!probe[i].row->small) continue;
        fw_report_probe_small(&probe[i], modes, plates, &value, &error);
        probe_head(json, probe[i].asked);
        fw_json_real(json, "value", value);
        fw_json_real(json, "error", error);
        fw_json_end(json);
    }
    fw_json_end(json);
}

fw_status fw_report_simulate_json(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                  fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.simulate/1");
    fw_json_text(&json, "method", motion->method);
    fw_json_text(&json, "integrator", motion->integrator);
    fw_json_text(&json, "reason", motion->reason);
    fw_json_text(&json, "stabilise", motion->stabilise);
    if (motion->method_report) fw_json_text(&json, "method_report", motion->method_report);
    accuracy(&json, motion);
    stats(&json, motion);
    hinge_model(&json, mechanism, &motion->ledger.hinge, motion->level);
    effects(&json, &motion->ledger);
    fw_json_real(&json, "left_out", motion->ledger.left_out);
    peaks(&json, mechanism, motion);
    travels(&json, mechanism, motion);
    reactions(&json, mechanism, motion);
    probes_of_motion(&json, mechanism, motion);
    final_state(&json, mechanism, motion);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- modes ---- */

/* {"BODY": [[re, im], [re, im], [re, im]]} */
static void complex_shape(fw_json *json, const fw_mechanism *m, const double *q,
                          const double *shape) {
    if (!shape) {
        fw_json_null(json, "damped_shape");
        return;
    }
    fw_json_object(json, "damped_shape");
    for (int b = 0; b < m->nbody; b++) {
        double part[2][3];
        for (int i = 0; i < 2; i++)
            fw_mechanism_frame_velocity(&m->body[b], q[3 * b + 2], shape + 3 * (i * m->nbody + b),
                                        part[i]);
        fw_json_list(json, m->body[b].id);
        for (int k = 0; k < 3; k++)
            fw_report_json_pair(json, NULL, part[0][k], part[1][k]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void one_mode(fw_json *json, const fw_mechanism *mechanism, const fw_statics_modes *modes,
                     const fw_statics_mode *m) {
    const double(*e)[2] = m->eigenvalue_per_s;
    fw_json_object(json, NULL);
    fw_json_real(json, "f_Hz", m->f_Hz);
    if (isnan(m->stuck_Hz))
        fw_json_null(json, "between_Hz");
    else
        fw_report_json_pair(json, "between_Hz", m->slid_Hz, m->stuck_Hz);
    fw_json_real(json, "omega_rad_per_s", m->omega_rad_per_s);
    fw_report_json_pair(json, "eigenvalue_per_s", e[0][0], e[0][1]);
    fw_report_json_pair(json, "second_eigenvalue_per_s", e[1][0], e[1][1]);
    fw_json_text(json, "kind", fw_statics_mode_kind_text(m->kind));
    fw_json_real(json, "damping_ratio", m->damping_ratio);
    fw_json_real(json, "stiffness_per_s2", m->stiffness_per_s2);
    fw_json_real(json, "modal_mass_kg_m2", m->modal_mass_kg_m2);
    fw_json_real(json, "frequency_error", fw_statics_mode_error(m));
    fw_json_text(json, "bodies", m->bodies);
    fw_report_json_velocities(json, "shape", mechanism, modes->q, m->shape);
    complex_shape(json, mechanism, modes->q, m->damped);
    fw_json_end(json);
}

/* of rigid plates about the drawn pose */
static void modes_across(fw_json *json, const fw_mechanism_plates *p) {
    fw_json_object(json, "out_of_plane");
    fw_json_truth(json, "known", !p->why);
    fw_json_text(json, "why", p->why);
    fw_json_real(json, "frequency_error", p->why ? (double)NAN : 0.5 * p->error);
    fw_json_truth(json, "with_loads", false);
    fw_json_list(json, "modes");
    for (int k = 0; k < p->n; k++) {
        bool tilts = false;
        int body = fw_mechanism_plates_mover(p, k, &tilts);
        fw_json_object(json, NULL);
        fw_json_real(json, "f_Hz", p->f_Hz[k]);
        fw_json_real(json, "omega_rad_per_s", sqrt(p->per_s2[k]));
        fw_json_text(json, "body", p->mechanism->body[body].id);
        fw_json_text(json, "kind", tilts ? "tilt" : "up and down");
        fw_json_object(json, "shape");
        for (int b = 0; b < p->n / 3; b++)
            fw_report_json_reals(json, p->mechanism->body[b].id,
                                 p->shape + (size_t)k * (size_t)p->n + 3 * b, 3);
        fw_json_end(json);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

fw_status fw_report_modes_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                               const fw_statics_modes *modes, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.modes/1");
    fw_json_text(&json, "scene", scene->name);
    fw_json_text(&json, "at", modes->at_equilibrium ? "equilibrium" : "rest");
    fw_json_real(&json, "out_of_rest", modes->out_of_rest);
    fw_json_real(&json, "unit_length_m", modes->unit_length_m);
    fw_json_real(&json, "frequency_error", modes->frequency_error);
    fw_json_real(&json, "stiffness_error", modes->stiffness_error);
    rank(&json, &modes->rank);
    fw_report_json_poses(&json, "q", mechanism, modes->q);
    fw_report_json_centres(&json, mechanism, modes->q);
    fw_json_list(&json, "modes");
    for (int i = 0; i < modes->count; i++)
        one_mode(&json, mechanism, modes, &modes->mode[i]);
    fw_json_end(&json);
    fw_probe *probe;
    fw_mechanism_plates plates;
    FW_TRY(fw_probe_bind(out->arena, mechanism, scene, NULL, &probe));
    FW_TRY(fw_mechanism_plates_new(out->arena, mechanism, NULL, &plates));
    modes_across(&json, &plates);
    probes_of_modes(&json, probe, fw_probe_count(mechanism), modes, &plates);
    hinge_model(&json, mechanism, &modes->ledger.hinge, NULL);
    effects(&json, &modes->ledger);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- an equilibrium and its load path ---- */

static void rest_hinges(fw_json *json, const fw_mechanism *m, const fw_statics *s) {
    fw_json_list(json, "hinges");
    for (int k = 0; k < m->npin; k++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "hinge", m->pin[k].id);
        fw_json_real(json, "angle_rad", s->angle_rad[k]);
        fw_report_json_pair(json, "force_N", s->reaction_N[2 * k], s->reaction_N[2 * k + 1]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void rest_joints(fw_json *json, const fw_mechanism *m, const double *force) {
    fw_json_list(json, "ties");
    for (int k = 0; k < m->njoint; k++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "joint", m->joint[k].id);
        fw_json_text(json, "kind", joint_kind[m->joint[k].kind]);
        fw_report_json_pair(json, "force_N", force[3 * k], force[3 * k + 1]);
        fw_json_real(json, "torque_Nm", force[3 * k + 2]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void rest_drivers(fw_json *json, const fw_mechanism *m, const double *force) {
    fw_json_list(json, "drivers");
    for (int k = 0; k < m->ndriver; k++) {
        bool turns = m->driver[k].revolute != FW_NONE;
        fw_json_object(json, NULL);
        fw_json_text(json, "driver", m->driver[k].id);
        fw_json_real(json, turns ? "torque_Nm" : "force_N", force[k]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void actives(fw_json *json, const fw_statics *s) {
    fw_json_list(json, "active");
    for (int i = 0; i < s->nactive; i++) {
        const fw_statics_active *a = &s->active[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "id", a->id);
        fw_json_text(json, "kind", a->effect ? a->effect : a->side == 0 ? "cable" : "stop");
        fw_json_real(json, "side", a->side);
        fw_json_truth(json, "on", a->on);
        fw_json_end(json);
    }
    fw_json_end(json);
}

/* limit points, bifurcations, switches and the end, with their poses */
static void path_events(fw_json *json, const fw_mechanism *m, const fw_statics *s) {
    const fw_statics_path *p = s->path;
    fw_json_list(json, "events");
    for (int i = 0; i < p->count; i++) {
        if (p->mark[i] == FW_PATH_POINT) continue;
        fw_json_object(json, NULL);
        fw_json_text(json, "kind", fw_report_path_mark(p->mark[i]));
        fw_json_whole(json, "point", i);
        fw_json_real(json, "load_factor", p->factor[i]);
        fw_json_text(json, "element", p->which[i] == FW_NONE ? NULL : s->active[p->which[i]].id);
        fw_json_real(json, "snaps_by_m", p->snap_m[i]);
        fw_json_real(json, "snaps_by_rad", p->snap_rad[i]);
        fw_report_json_poses(json, "q", m, p->q + (size_t)i * 3 * (size_t)p->nbody);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void load_path(fw_json *json, const fw_mechanism *m, const fw_statics *s) {
    const fw_statics_path *p = s->path;
    if (!p) {
        fw_json_null(json, "path");
        return;
    }
    fw_json_object(json, "path");
    fw_json_truth(json, "complete", p->complete);
    path_events(json, m, s);
    fw_report_json_reals(json, "load_factor", p->factor, p->count);
    fw_report_json_reals(json, "lowest_per_s2", p->lowest_per_s2, p->count);
    fw_json_list(json, "negative");
    for (int i = 0; i < p->count; i++)
        fw_json_whole(json, NULL, p->negative[i]);
    fw_json_end(json);
    fw_json_end(json);
}

/* null where nothing rubs; within: of centres of mass, [m, m, rad] */
static void friction_range(fw_json *json, const fw_mechanism *m,
                           const fw_statics_friction_range *f) {
    if (!f) {
        fw_json_null(json, "friction_range");
        return;
    }
    fw_json_object(json, "friction_range");
    fw_json_truth(json, "known", !f->why);
    fw_json_text(json, "why", f->why);
    fw_json_truth(json, "first_order", f->first_order);
    const struct {
        const char *poses, *angles;
        const double *q, *angle_rad;
    } row[] = {{"within", "angle_rad", f->q, f->angle_rad},
               {"from", "angle_from_rad", f->from_q, f->from_angle_rad},
               {"to", "angle_to_rad", f->to_q, f->to_angle_rad}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_json_object(json, row[i].poses);
        for (int b = 0; !f->why && b < m->nbody; b++)
            fw_report_json_reals(json, m->body[b].id, row[i].q + 3 * (size_t)b, 3);
        fw_json_end(json);
        fw_json_object(json, row[i].angles);
        for (int k = 0; !f->why && k < m->npin; k++)
            fw_json_real(json, m->pin[k].id, row[i].angle_rad[k]);
        fw_json_end(json);
    }
    fw_json_list(json, "limits");
    for (int i = 0; !f->why && i < f->count; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "joint", f->joint[i]);
        fw_json_real(json, f->slides[i] ? "force_N" : "torque_Nm", f->limit[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

/* none without comb drives, else the one that loses the equilibrium first */
static void pull_ins(fw_json *json, const fw_statics_pull_in *p) {
    fw_json_list(json, "pull_in");
    if (p) {
        fw_json_object(json, NULL);
        fw_report_json_pull_in(json, p);
        fw_json_end(json);
    }
    fw_json_end(json);
}

fw_status fw_report_statics_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                 const fw_statics *s, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.statics/1");
    fw_json_text(&json, "scene", scene->name);
    fw_json_truth(&json, "stable", s->negative == 0 && s->neutral == 0);
    fw_json_whole(&json, "negative", s->negative);
    fw_json_whole(&json, "neutral", s->neutral);
    fw_json_text(&json, "loose", s->loose);
    fw_json_whole(&json, "degrees_of_freedom", s->dof);
    fw_json_real(&json, "residual", s->residual);
    fw_json_whole(&json, "iterations", s->iterations);
    rank(&json, &s->rank);
    fw_report_json_poses(&json, "q", mechanism, s->q);
    fw_report_json_centres(&json, mechanism, s->q);
    rest_hinges(&json, mechanism, s);
    rest_joints(&json, mechanism, s->joint_N);
    rest_drivers(&json, mechanism, s->driver_N);
    actives(&json, s);
    FW_TRY(probes_of_statics(&json, mechanism, scene, s, out->arena));
    fw_report_json_reals(&json, "eigenvalues_per_s2", s->eigenvalue_per_s2, s->eigenvalues);
    friction_range(&json, mechanism, s->friction);
    pull_ins(&json, s->pull_in);
    load_path(&json, mechanism, s);
    hinge_model(&json, mechanism, &s->ledger.hinge, s->level);
    effects(&json, &s->ledger);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}
