/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json.h"
#include "report/hinge_model.h"
#include "report/json_effects.h"

static json_t *stats(const fw_motion *m, bool *failed) {
    const fw_motion_stats *s = &m->stats;
    json_t *o = json_object();
    fw_json_put(o, "steps", json_integer(s->steps), failed);
    fw_json_put(o, "rejected", json_integer(s->rejected), failed);
    fw_json_put(o, "rhs", json_integer(s->rhs), failed);
    fw_json_put(o, "projections", json_integer(s->projections), failed);
    fw_json_put(o, "cpu_s", fw_json_real(s->cpu_s), failed);
    fw_json_put(o, "max_constraint_norm", fw_json_real(s->max_constraint_norm), failed);
    fw_json_put(o, "max_velocity_norm", fw_json_real(s->max_velocity_norm), failed);
    fw_json_put(o, "energy_error", fw_json_real(s->energy_error), failed);
    fw_json_put(o, "largest_energy_J", fw_json_real(s->largest_energy_J), failed);
    fw_json_put(o, "events", json_integer(s->events), failed);
    fw_json_put(o, "jacobians", json_integer(s->jacobians), failed);
    fw_json_put(o, "factorisations", json_integer(s->factorisations), failed);
    fw_json_put(o, "rtol", fw_json_real(s->rtol), failed);
    fw_json_put(o, "assembly_moved_m", fw_json_real(s->assembly_moved_m), failed);
    fw_json_put(o, "velocity_moved", fw_json_real(s->velocity_moved), failed);
    return o;
}

/* what was wanted of it, what it is taken to be, and what that took, all runs counted */
static json_t *accuracy(const fw_motion *m, bool *failed) {
    const fw_motion_stats *s = &m->stats;
    double estimated = fw_motion_estimated(m);
    json_t *o = json_object();
    fw_json_put(o, "wanted", fw_json_real(m->accuracy), failed);
    fw_json_put(o, "estimated", fw_json_real(estimated), failed);
    fw_json_put(o, "reached", json_boolean(estimated <= m->accuracy), failed);
    fw_json_put(o, "reason", fw_json_text(m->tolerance), failed);
    fw_json_put(o, "rtol", fw_json_real(s->rtol), failed);
    fw_json_put(o, "looser_rtol", fw_json_real(s->looser_rtol), failed);
    fw_json_put(o, "runs", json_integer(s->runs), failed);
    fw_json_put(o, "steps", json_integer(s->all_steps), failed);
    fw_json_put(o, "rhs", json_integer(s->all_rhs), failed);
    fw_json_put(o, "cpu_s", fw_json_real(s->cpu_s + s->estimate_cpu_s), failed);
    return o;
}

static json_t *peaks(const fw_mechanism *mechanism, const fw_motion *m, bool *failed) {
    json_t *list = json_array();
    for (int k = 0; k < m->npin; k++) {
        json_t *o = json_object();
        fw_json_put(o, "hinge", fw_json_text(mechanism->pin[k].id), failed);
        fw_json_put(o, "angle_rad", fw_json_real(m->peak[k].angle_rad), failed);
        fw_json_put(o, "t_s", fw_json_real(m->peak[k].t_s), failed);
        fw_json_put(o, "error_rad", fw_json_real(m->peak[k].error_rad), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static const char *const tie_kind[] = {
    [FW_TIE_PRISMATIC] = "prismatic", [FW_TIE_DISTANCE] = "distance", [FW_TIE_WELD] = "weld"};

/* the torque of what has one; where there is no force (a driver that turns) the time is its own */
static void reaction(json_t *list, const char *id, const char *kind, const fw_force_peak *p,
                     bool turns, bool pushes, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "joint", fw_json_text(id), failed);
    fw_json_put(o, "force_N", fw_json_real(p->force_N), failed);
    fw_json_put(o, "t_s", fw_json_real(pushes ? p->t_s : p->torque_t_s), failed);
    fw_json_put(o, "error_N", fw_json_real(p->error_N), failed);
    fw_json_put(o, "kind", fw_json_text(kind), failed);
    if (turns) {
        fw_json_put(o, "torque_Nm", fw_json_real(p->torque_Nm), failed);
        fw_json_put(o, "torque_t_s", fw_json_real(p->torque_t_s), failed);
        fw_json_put(o, "torque_error_Nm", fw_json_real(p->torque_error_Nm), failed);
    }
    fw_json_push(list, o, failed);
}

/* largest forces of revolute joints, of the others, of drivers */
static json_t *reactions(const fw_mechanism *mechanism, const fw_motion *m, bool *failed) {
    json_t *list = json_array();
    for (int k = 0; m->force_peak && k < m->npin; k++)
        reaction(list, mechanism->pin[k].id, "revolute", &m->force_peak[k], false, true, failed);
    for (int k = 0; m->tie_peak && k < m->ntie; k++) {
        const fw_tie *t = &mechanism->tie[k];
        reaction(list, t->id, tie_kind[t->kind], &m->tie_peak[k], t->kind != FW_TIE_DISTANCE, true,
                 failed);
    }
    for (int k = 0; m->driver_peak && k < m->ndriver; k++) {
        bool turns = mechanism->driver[k].joint != FW_NONE;
        reaction(list, mechanism->driver[k].id, "driver", &m->driver_peak[k], turns, !turns,
                 failed);
    }
    return list;
}

/* extremes of prismatic joints */
static json_t *travels(const fw_mechanism *mechanism, const fw_motion *m, bool *failed) {
    json_t *list = json_array();
    for (int k = 0; m->travel_peak && k < m->ntie; k++) {
        if (mechanism->tie[k].kind != FW_TIE_PRISMATIC) continue;
        json_t *o = json_object();
        fw_json_put(o, "joint", fw_json_text(mechanism->tie[k].id), failed);
        fw_json_put(o, "travel_m", fw_json_real(m->travel_peak[k].travel_m), failed);
        fw_json_put(o, "t_s", fw_json_real(m->travel_peak[k].t_s), failed);
        fw_json_put(o, "error_m", fw_json_real(m->travel_peak[k].error_m), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *by_body(const fw_mechanism *mechanism, const fw_motion *m, const double *table,
                       bool *failed) {
    json_t *o = json_object();
    const double *last = table + 3 * (size_t)m->nbody * (size_t)(m->nsample - 1);
    for (int b = 0; b < m->nbody; b++) {
        json_t *triple = json_array();
        for (int k = 0; k < 3; k++)
            fw_json_push(triple, fw_json_real(last[3 * b + k]), failed);
        fw_json_put(o, mechanism->body[b].id, triple, failed);
    }
    return o;
}

fw_status fw_report_simulate_json(const fw_mechanism *mechanism, const fw_motion *motion,
                                  fw_text *out) {
    bool failed = false;
    json_t *root = json_object();
    fw_json_put(root, "schema", fw_json_text("flexwright.simulate/1"), &failed);
    fw_json_put(root, "method", fw_json_text(motion->method), &failed);
    fw_json_put(root, "integrator", fw_json_text(motion->integrator), &failed);
    fw_json_put(root, "reason", fw_json_text(motion->reason), &failed);
    fw_json_put(root, "stabilise", fw_json_text(motion->stabilise), &failed);
    if (motion->method_report)
        fw_json_put(root, "method_report", fw_json_text(motion->method_report), &failed);
    fw_json_put(root, "accuracy", accuracy(motion, &failed), &failed);
    fw_json_put(root, "stats", stats(motion, &failed), &failed);
    fw_json_put(root, "hinge_model",
                fw_json_hinge_model(mechanism, &motion->ledger.hinge, motion->level, &failed),
                &failed);
    json_t *effects = json_array();
    fw_json_effects(effects, &motion->ledger, NULL, NULL, &failed);
    fw_json_put(root, "effects", effects, &failed);
    fw_json_put(root, "left_out", fw_json_real(motion->ledger.left_out), &failed);
    fw_json_put(root, "peaks", peaks(mechanism, motion, &failed), &failed);
    fw_json_put(root, "travels", travels(mechanism, motion, &failed), &failed);
    fw_json_put(root, "reactions", reactions(mechanism, motion, &failed), &failed);
    if (motion->nsample > 0) {
        json_t *final = json_object();
        fw_json_put(final, "t_s", fw_json_real(motion->t_s[motion->nsample - 1]), &failed);
        fw_json_put(final, "q", by_body(mechanism, motion, motion->q, &failed), &failed);
        fw_json_put(final, "v", by_body(mechanism, motion, motion->v, &failed), &failed);
        fw_json_put(final, "a", by_body(mechanism, motion, motion->accel, &failed), &failed);
        fw_json_put(root, "final", final, &failed);
    } else
        fw_json_put(root, "final", json_null(), &failed);
    return fw_json_write(root, failed, out);
}
