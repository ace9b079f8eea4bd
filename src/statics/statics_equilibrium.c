/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics_equilibrium.h"
#include "assembly/assembly.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *fw_statics_equilibrium_scene_name(const fw_statics_equilibrium *w) {
    return fw_text_name(w->scene->name);
}

double fw_statics_equilibrium_per_s2(const fw_statics_equilibrium *w) {
    return 1 / (w->model->scale.time_s * w->model->scale.time_s);
}

/* ---- the scene without time ---- */

/* a law at the scene's end, or at its start, as the limit from inside */
static fw_status law_at(fw_arena *arena, const fw_quantity_law *law, double duration, bool end,
                        double *value) {
    double all[3], *at, edge = end ? 0 : duration;
    int count = fw_quantity_law_breaks_of(law, duration, NULL, 0);
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(at = fw_arena_array(arena, double, (size_t)count));
    count = fw_quantity_law_breaks_of(law, duration, at, count);
    for (int i = 0; i < count; i++)
        edge = end ? fmax(edge, at[i]) : fmin(edge, at[i]);
    fw_arena_rewind(arena, mark);
    double t = end ? duration : 0;
    fw_quantity_law_value(law, t, 0.5 * (t + edge), all);
    *value = all[0];
    return FW_OK;
}

/* loads with a law become constant ones of their value at the end; strains are those of these loads alone */
static fw_status freeze(fw_statics_equilibrium *w, fw_effects_loads *loads) {
    fw_effects_point_load *load;
    double *constant, *strain;
    size_t n = 3 * (size_t)loads->nbody, have = (size_t)loads->nload;
    FW_NEED(load = fw_arena_array(w->arena, fw_effects_point_load, have + (size_t)loads->ntimed));
    FW_NEED(constant = fw_arena_array(w->arena, double, n));
    if (have) memcpy(load, loads->load, have * sizeof *load);
    memcpy(constant, loads->constant, n * sizeof *constant);
    for (int i = 0; i < loads->ntimed; i++) {
        const fw_effects_timed_load *l = &loads->timed[i];
        double factor;
        if (l->body == FW_GROUND) continue;
        FW_TRY(law_at(w->arena, l->law, w->scene->duration_s, true, &factor));
        load[have++] =
            (fw_effects_point_load){l->body, l->x_m, l->y_m, factor * l->fx_N, factor * l->fy_N};
        constant[3 * l->body + 2] += factor * l->torque_Nm;
    }
    loads->load = load;
    loads->nload = (int)have;
    loads->constant = constant;
    loads->ntimed = 0;
    FW_NEED(strain = fw_arena_array(w->arena, double, (size_t)loads->nbody + 1));
    memcpy(strain, loads->strain, ((size_t)loads->nbody + 1) * sizeof *strain);
    loads->strain = strain;
    if (!loads->stretch.law) return FW_OK;
    double last; /* the ground stays as it is at the end */
    FW_TRY(law_at(w->arena, loads->stretch.law, w->scene->duration_s, true, &last));
    loads->strain[loads->nbody] += loads->stretch.strain * last;
    loads->strained = true;
    loads->stretch.law = NULL;
    return FW_OK;
}

/* laws of elements stand still at the end, all seen from inside their last pieces */
static fw_status freeze_elements(fw_statics_equilibrium *w) {
    const fw_multibody_model *m = w->model;
    double end = w->scene->duration_s, edge = 0;
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->laws; k++) {
            const fw_quantity_law *law = m->element[i].own->law[k];
            double *at;
            int count = fw_quantity_law_breaks_of(law, end, NULL, 0);
            fw_mark mark = fw_arena_mark(w->arena);
            FW_NEED(at = fw_arena_array(w->arena, double, (size_t)count));
            fw_quantity_law_breaks_of(law, end, at, count);
            for (int j = 0; j < count; j++)
                edge = fmax(edge, at[j]);
            fw_arena_rewind(w->arena, mark);
        }
    w->system->loading.hold = (fw_multibody_hold){.on = true, .t_s = end};
    w->system->piece_s = 0.5 * (edge + end);
    return FW_OK;
}

static bool gravity_acts(const fw_statics_equilibrium *w) {
    for (int i = 0; i < w->ledger.count; i++)
        if (strcmp(w->ledger.item[i].id, "gravity") == 0)
            return w->ledger.item[i].active && w->scene->gravity;
    return false;
}

/* what acts always, and what goes with s */
static void split_loads(fw_statics_equilibrium *w) {
    const fw_multibody_model *m = w->model;
    double unit = m->scale.time_s * m->scale.time_s / m->scale.length_m;
    if (gravity_acts(w))
        for (int b = 0; b < m->nbody; b++) {
            w->gravity[3 * b] = unit * w->scene->gx_m_per_s2;
            w->gravity[3 * b + 1] = unit * w->scene->gy_m_per_s2;
        }
    for (int i = 0; i < m->nq; i++) {
        double rest = m->constant[i] - w->gravity[i];
        /* where only weight acts the difference is round-off */
        w->load_acceleration[i] = fabs(rest) > 4 * DBL_EPSILON * fabs(m->constant[i]) ? rest : 0;
    }
    for (int i = 0; i < m->nload; i++)
        w->load[i] = m->load[i];
}

/* drivers leave their laws: the blocks keep values that fw_statics_equilibrium_factor sets */
static fw_status split_drivers(fw_statics_equilibrium *w) {
    const fw_multibody_model *m = w->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        w->start[i] = b->value;
        if (!b->law) continue;
        double first, last;
        FW_TRY(law_at(w->arena, b->law, w->scene->duration_s, false, &first));
        FW_TRY(law_at(w->arena, b->law, w->scene->duration_s, true, &last));
        w->start[i] += first / b->unit;
        w->way[i] = (last - first) / b->unit;
        w->moving = w->moving || w->way[i] != 0;
    }
    w->system->loading.driven = false;
    return FW_OK;
}

static fw_status arrays(fw_statics_equilibrium *w) {
    const fw_multibody_model *m = w->model;
    size_t n = (size_t)m->nq, blocks = (size_t)m->nblock;
    double **vector[] = {&w->force,    &w->slope, &w->follow,  &w->push,
                         &w->gradient, &w->noise, &w->gravity, &w->load_acceleration,
                         &w->step};
    for (size_t i = 0; i < sizeof vector / sizeof vector[0]; i++)
        FW_NEED(*vector[i] = fw_arena_array(w->arena, double, n + 3));
    FW_NEED(w->y = fw_arena_array(w->arena, double, (size_t)m->ny));
    FW_NEED(w->trial = fw_arena_array(w->arena, double, (size_t)m->ny));
    if (!w->sparse) FW_NEED(w->stiffness = fw_arena_array(w->arena, double, n *n));
    FW_NEED(w->lambda = fw_arena_array(w->arena, double, 2 * blocks));
    FW_NEED(w->psi = fw_arena_array(w->arena, double, 2 * blocks));
    FW_NEED(w->start = fw_arena_array(w->arena, double, blocks));
    FW_NEED(w->way = fw_arena_array(w->arena, double, blocks));
    FW_NEED(w->away = fw_arena_array(w->arena, double, (size_t)m->ny));
    FW_NEED(w->pull = fw_arena_array(w->arena, double, n));
    FW_NEED(w->load = fw_arena_array(w->arena, fw_multibody_load, (size_t)m->nload));
    return FW_OK;
}

static fw_status too_large(const fw_statics_equilibrium *w) {
    fw_status status = fw_diag_error(
        w->diags, 112, w->scene->place,
        "%d bodies are more than the %d that equilibria and modes are computed for (dense "
        "matrices); simulate has no such limit",
        w->mechanism->nbody, FW_STATICS_DENSE / 3);
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

/* dry friction holds a mechanism in a whole range of positions: the one reported is the one that it
   would rest in without */
static void leave_out_friction(fw_statics_equilibrium *w, fw_effects_loads *loads) {
    loads->nfriction = 0;
    for (int i = 0; i < w->ledger.count; i++) {
        fw_effect_entry *e = &w->ledger.item[i];
        if (strcmp(e->id, "friction") != 0 || !e->called_for) continue;
        e->active = false;
        e->reason = "left out at rest: friction can hold in a range of positions around the "
                    "equilibrium without it, which is the one reported, with that range";
    }
}

/* the assembled pose, its model and memory */
static fw_status build(fw_statics_equilibrium *w, const fw_effects_loads *loads) {
    const fw_mechanism *mechanism = w->mechanism;
    size_t n = 3 * (size_t)mechanism->nbody;
    double moved;
    if (n > FW_STATICS_DENSE && !w->sparse) return too_large(w);
    FW_NEED(w->q0 = fw_arena_array(w->arena, double, n));
    for (int b = 0; b < mechanism->nbody; b++) {
        w->q0[3 * b] = mechanism->body[b].x_m;
        w->q0[3 * b + 1] = mechanism->body[b].y_m;
        w->q0[3 * b + 2] = mechanism->body[b].phi_rad;
    }
    FW_TRY(
        fw_assembly_assemble_giving(w->arena, mechanism, loads->released, w->q0, &moved, w->diags));
    FW_TRY(fw_multibody_model_new(w->arena, mechanism, loads, w->q0, w->scene->duration_s, NULL,
                                  &w->model));
    FW_TRY(fw_multibody_system_new(w->arena, w->model, mechanism, w->diags, &w->system));
    w->drive_unit = w->reach = 1;
    FW_TRY(arrays(w));
    return fw_statics_reduced_new(w->arena, w->model, w->sparse, &w->reduced);
}

/* the model of frozen loads, with their strains, at s */
static fw_status model_of(fw_statics_equilibrium *w, fw_effects_loads *loads, double s) {
    FW_TRY(fw_effects_strain(w->arena, w->mechanism, loads, &w->mechanism));
    FW_TRY(build(w, loads));
    FW_TRY(freeze_elements(w));
    split_loads(w);
    FW_TRY(split_drivers(w));
    fw_statics_equilibrium_factor(w, s);
    return FW_OK;
}

static fw_status assemble(fw_statics_equilibrium *w, fw_effects_loads *loads) {
    leave_out_friction(w, loads);
    FW_TRY(freeze(w, loads));
    w->drawn = w->mechanism;
    FW_NEED(w->frozen = fw_effects_loads_keep(w->arena, loads));
    return model_of(w, loads, 0);
}

fw_status fw_statics_equilibrium_strained(const fw_statics_equilibrium *w, double share,
                                          fw_diags *silent, fw_statics_equilibrium *other) {
    fw_effects_loads own = *w->frozen;
    size_t n = (size_t)own.nbody + 1;
    *other = *w;
    other->mechanism = w->drawn, other->diags = silent;
    other->reduced = (fw_statics_reduced){0};
    other->invalid = NULL, other->moving = false;
    FW_NEED(own.strain = fw_arena_array(w->arena, double, n));
    for (size_t i = 0; i < n; i++)
        own.strain[i] = share * w->frozen->strain[i];
    const double drive_unit = w->drive_unit, reach = w->reach;
    FW_TRY(model_of(other, &own, w->factor));
    other->drive_unit = drive_unit, other->reach = reach;
    fw_statics_equilibrium_factor(other, w->factor);
    return FW_OK;
}

static fw_status check(const fw_statics_equilibrium *w) {
    FW_TRY(fw_multibody_check_motion(w->mechanism, w->scene, w->diags));
    return 3 * w->mechanism->nbody > FW_STATICS_DENSE && !w->sparse ? too_large(w) : FW_OK;
}

fw_status fw_statics_equilibrium_new_loads(fw_arena *arena, const fw_mechanism *mechanism,
                                           const fw_device_scene *scene,
                                           const fw_effects_loads *loads, fw_diags *diags,
                                           fw_statics_equilibrium *w) {
    fw_effects_loads own = *loads;
    *w = (fw_statics_equilibrium){
        .arena = arena, .mechanism = mechanism, .scene = scene, .diags = diags};
    FW_TRY(check(w));
    return assemble(w, &own);
}

fw_status fw_statics_equilibrium_again(const fw_statics_equilibrium *w,
                                       const fw_effects_loads *loads,
                                       fw_statics_equilibrium *other) {
    fw_effects_loads own = *loads;
    *other = (fw_statics_equilibrium){
        .arena = w->arena, .mechanism = w->plain, .scene = w->scene, .diags = w->diags};
    other->ledger = w->ledger;
    FW_TRY(assemble(other, &own));
    other->lead = w->lead;
    other->drive_unit = w->drive_unit;
    fw_statics_equilibrium_factor(other, w->factor);
    return FW_OK;
}

fw_status fw_statics_equilibrium_new(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_device_scene *scene, const fw_effect_choice *effects,
                                     int most_dense, fw_diags *diags, fw_statics_equilibrium *w) {
    fw_effects_loads loads;
    *w = (fw_statics_equilibrium){
        .arena = arena, .mechanism = mechanism, .scene = scene, .diags = diags};
    w->sparse = 3 * mechanism->nbody > most_dense;
    FW_TRY(check(w));
    fw_effect_choice choice = *effects;
    if (choice.mode == FW_EFFECTS_AUTO) choice.mode = FW_EFFECTS_WHOLE;
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &choice, 1e-3, diags, &w->ledger, &loads));
    FW_NEED(w->loads = fw_effects_loads_keep(arena, &loads));
    w->plain = mechanism;
    return assemble(w, &loads);
}

void fw_statics_equilibrium_factor(fw_statics_equilibrium *w, double s) {
    const fw_multibody_model *m = w->model;
    fw_multibody_loading *l = &w->system->loading;
    w->factor = s;
    l->drive_rate = w->lead == FW_LEAD_LOADS ? 0 : w->drive_unit;
    l->actuation_rate = w->lead == FW_LEAD_DRIVES ? 0 : 1;
    l->drive = s * l->drive_rate;
    if (w->lead == FW_LEAD_DRIVES) s = 1; /* all the rest acts in full */
    l->actuation = s;
    for (int i = 0; i < m->nq; i++)
        l->constant[i] = w->gravity[i] + s * w->load_acceleration[i];
    for (int i = 0; i < m->nload; i++)
        l->force[2 * i] = s * w->load[i].fx, l->force[2 * i + 1] = s * w->load[i].fy;
    for (int i = 0; i < m->nblock; i++)
        l->value[i] = w->start[i] + s * w->way[i];
}

/* ---- one state ---- */

const fw_multibody_pose *fw_statics_equilibrium_close(fw_statics_equilibrium *w, double *u) {
    const fw_multibody_model *m = w->model;
    for (int i = 0; i < m->nq; i++)
        if (!isfinite(u[i])) return NULL;
    if (m->nblock > 0 && w->sparse && !fw_statics_sparse_close(w, u)) return NULL;
    if (m->nblock > 0 && !w->sparse && !fw_multibody_close_position(w->system, w->t, u))
        return NULL;
    memcpy(w->trial, u, (size_t)m->nq * sizeof *u); /* at rest: its velocities are 0 */
    const fw_multibody_pose *pose = fw_multibody_set_switches(w->system, w->t, w->trial);
    w->invalid = fw_multibody_element_invalid(w->system, pose, w->trial + m->nq, &w->why);
    return w->invalid ? NULL : pose;
}

double fw_statics_equilibrium_energy(fw_statics_equilibrium *w, const double *u, double *size) {
    const fw_multibody_model *m = w->model;
    double driven = 0, more = 0;
    memcpy(w->trial, u, (size_t)m->nq * sizeof *u);
    if (m->nelement > 0) driven = fw_statics_equilibrium_driven(w, u, &more);
    fw_multibody_energy e = fw_multibody_energy_at(w->system, w->t, w->trial);
    *size = fabs(e.elastic) + fabs(e.work) + more;
    return e.elastic - e.work + driven;
}

static double inertia_of(const fw_multibody_model *m, int i) {
    return i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3];
}

/* dQ/ds: the loads in full; du/ds of least mass norm with G du/ds = -dPsi/ds */
static void derivative_by_factor(fw_statics_equilibrium *w, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = w->model;
    bool load_acceleration = w->lead != FW_LEAD_DRIVES;
    for (int i = 0; i < m->nq; i++)
        w->slope[i] = load_acceleration ? inertia_of(m, i) * w->load_acceleration[i] : 0;
    for (int i = 0; load_acceleration && i < m->nload; i++) {
        const fw_multibody_load *l = &w->load[i];
        double c = pose->cosine[l->body], s = pose->sine[l->body], *to = w->slope + 3 * l->body;
        to[0] += l->fx;
        to[1] += l->fy;
        to[2] += (c * l->x - s * l->y) * l->fy - (s * l->x + c * l->y) * l->fx;
    }
    if (m->nelement > 0) fw_multibody_element_slope(w->system, pose, w->y + m->nq, w->slope);
    memset(w->follow, 0, (size_t)m->nq * sizeof(double));
    if (!w->moving || !load_acceleration) return;
    for (int i = 0; i < m->nblock; i++)
        w->psi[2 * i] = -w->way[i], w->psi[2 * i + 1] = 0;
    fw_statics_reduced_correct(m, &w->reduced, w->psi, w->follow);
}

/* forces along the modes, their derivative by s, and the round-off that they carry */
static void project_on_modes(fw_statics_equilibrium *w) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    double *bent = w->step; /* dQ/ds - K du/ds */
    for (size_t i = 0; i < n; i++) {
        bent[i] = w->slope[i];
        for (size_t j = 0; w->moving && !w->sparse && j < n; j++)
            bent[i] -= w->stiffness[i * n + j] * w->follow[j];
    }
    for (size_t k = 0; k < (size_t)r->modes; k++) {
        const double *shape = r->shape + k * n;
        w->gradient[k] = w->push[k] = w->noise[k] = 0;
        for (size_t i = 0; i < n; i++) {
            w->gradient[k] += shape[i] * w->force[i];
            w->push[k] += shape[i] * bent[i];
            w->noise[k] += 64 * DBL_EPSILON * fabs(shape[i]) *
                           (fabs(w->force[i]) + fabs(w->slope[i]) +
                            (w->sparse ? 0 : fabs(w->stiffness[i * n + i])));
        }
    }
}

/* K by its entries, and what is not balanced; the modes are asked for where they are wanted */
static fw_status evaluate_sparse(fw_statics_equilibrium *w, const fw_multibody_pose *pose) {
    fw_statics_entries *k = &w->reduced.sparse->stiffness;
    const fw_effects_matrix to = {.add = fw_statics_entries_add, .to = k};
    fw_statics_entries_clear(k);
    fw_statics_tangent_to(w->system, pose, w->y + w->model->nq, w->lambda, &to, NULL);
    if (k->failed) return FW_NOMEM;
    fw_statics_sparse_balance(&w->reduced, w->force);
    derivative_by_factor(w, pose);
    return FW_OK;
}

/* the lowest modes of an evaluated state, and the forces along them; nothing to do where all are known */
fw_status fw_statics_equilibrium_lowest(fw_statics_equilibrium *w, int count) {
    if (!w->sparse) return FW_OK;
    FW_TRY(fw_statics_sparse_lowest(w->arena, &w->reduced, count));
    project_on_modes(w);
    return FW_OK;
}

/* Q, lambda, K = d(G^T lambda)/du - dQ/du, modes of K on the motions that G allows, and along each
   mode the force. State w->y is moved onto the constraints first. Error: round-off. Cost about
   30 n^3. Test: test_statics.c. */
fw_status fw_statics_equilibrium_evaluate(fw_statics_equilibrium *w) {
    const fw_multibody_model *m = w->model;
    const fw_multibody_pose *pose = fw_statics_equilibrium_close(w, w->y);
    const double *v = w->y + m->nq;
    if (!pose) return FW_SOLVER;
    FW_TRY(fw_statics_reduced_null(m, pose, &w->reduced));
    const double *accel = fw_multibody_forces(w->system, pose, v)->accel;
    for (int i = 0; i < m->nq; i++) {
        w->force[i] = inertia_of(m, i) * accel[i];
        if (!isfinite(w->force[i])) return FW_SOLVER;
    }
    fw_statics_reduced_multipliers(m, &w->reduced, w->force, w->lambda);
    if (w->sparse) return evaluate_sparse(w, pose);
    fw_statics_tangent(w->system, pose, v, w->lambda, w->stiffness, NULL);
    FW_TRY(fw_statics_reduced_spectrum(&w->reduced, w->stiffness));
    derivative_by_factor(w, pose);
    project_on_modes(w);
    return FW_OK;
}

/* ---- to SI, and words ---- */

void fw_statics_equilibrium_pose(const fw_statics_equilibrium *w, const double *u, double *q,
                                 double *angle) {
    for (int i = 0; i < w->model->nq; i++)
        q[i] = w->q0[i] + (i % 3 == 2 ? 1 : w->model->scale.length_m) * u[i];
    for (int i = 0; angle && i < w->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &w->mechanism->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

void fw_statics_equilibrium_reactions(const fw_statics_equilibrium *w, double *reaction,
                                      double *joint, double *driver) {
    const fw_multibody_model *m = w->model;
    const fw_multibody_pose *pose = m->nelement > 0
                                        ? fw_multibody_set_switches(w->system, w->t, w->y)
                                        : fw_multibody_pose_at(w->system, w->t, w->y);
    fw_multibody_solution found = {.pose = pose, .lambda = w->lambda};
    if (m->nelement > 0) /* their forces on released pins */
        found.element = fw_multibody_forces(w->system, pose, w->y + m->nq)->element;
    fw_multibody_pin_forces(m, &found, reaction);
    fw_multibody_joint_forces(m, &found, w->mechanism, joint, driver);
}

double fw_statics_equilibrium_part(const double *shape, int body) {
    return fmax(fabs(shape[3 * body + 2]), hypot(shape[3 * body], shape[3 * body + 1]));
}

int fw_statics_equilibrium_mover(const fw_statics_equilibrium *w, const double *shape) {
    int best = 0;
    for (int b = 1; b < w->model->nbody; b++)
        if (fw_statics_equilibrium_part(shape, b) > fw_statics_equilibrium_part(shape, best))
            best = b;
    return best;
}

fw_status fw_statics_equilibrium_bodies(const fw_statics_equilibrium *w, const double *shape,
                                        const char **names) {
    enum { FEW = 6 };
    int first = fw_statics_equilibrium_mover(w, shape), named = 1, count = 1;
    fw_text text = fw_text_new(w->arena);
    const char *id = w->mechanism->body[first].id;
    fw_text_add(&text, fw_text_name(id));
    for (int b = 0; b < w->model->nbody; b++) {
        if (b == first ||
            fw_statics_equilibrium_part(shape, b) < 0.1 * fw_statics_equilibrium_part(shape, first))
            continue;
        id = w->mechanism->body[b].id;
        if (++count <= FEW && ++named) fw_text_printf(&text, ", %s", fw_text_name(id));
    }
    if (count > named) fw_text_printf(&text, " and %d more", count - named);
    FW_TRY(fw_text_end(&text));
    *names = text.data;
    return FW_OK;
}

/* ---- in time ---- */

/* Equilibria at a time of the scene: loads and drivers at the value of their laws, and their rates
   in the place of the derivatives by the load factor. */

/* loads with a law get a place among the constant ones; their torques are set with the constants */
static fw_status hold_loads(fw_statics_equilibrium *w, fw_effects_loads *loads) {
    fw_effects_point_load *load;
    size_t have = (size_t)loads->nload;
    FW_NEED(load = fw_arena_array(w->arena, fw_effects_point_load, have + (size_t)loads->ntimed));
    if (have) memcpy(load, loads->load, have * sizeof *load);
    w->first_timed = loads->nload;
    w->timed = loads->timed;
    w->ntimed = 0;
    fw_effects_timed_load *timed;
    FW_NEED(timed = fw_arena_array(w->arena, fw_effects_timed_load, (size_t)loads->ntimed));
    for (int i = 0; i < loads->ntimed; i++) {
        const fw_effects_timed_load *l = &loads->timed[i];
        if (l->body == FW_GROUND) continue;
        timed[w->ntimed++] = *l;
        load[have++] = (fw_effects_point_load){l->body, l->x_m, l->y_m, l->fx_N, l->fy_N};
    }
    w->timed = timed;
    loads->load = load;
    loads->nload = (int)have;
    loads->ntimed = 0;
    return FW_OK;
}

fw_status fw_statics_equilibrium_in_time(fw_statics_equilibrium *w, const fw_effects_loads *from) {
    fw_effects_loads loads = *from;
    FW_TRY(fw_effects_strain(w->arena, w->mechanism, &loads, &w->mechanism));
    FW_TRY(hold_loads(w, &loads));
    FW_TRY(build(w, &loads));
    const fw_multibody_model *m = w->model;
    memcpy(w->gravity, m->constant, (size_t)m->nq * sizeof(double)); /* all that is constant */
    FW_NEED(w->law = fw_arena_array(w->arena, const fw_quantity_law *, (size_t)m->nblock));
    for (int i = 0; i < m->nblock; i++) {
        w->law[i] = m->block[i].law;
        w->start[i] = m->block[i].value;
    }
    w->system->loading.driven = false; /* fw_statics_equilibrium_at sets the values */
    return FW_OK;
}

void fw_statics_equilibrium_at(fw_statics_equilibrium *w, double t_s, double piece_s) {
    const fw_multibody_model *m = w->model;
    fw_multibody_loading *now = &w->system->loading;
    double second = m->scale.time_s, newton = fw_multibody_newton(m), value[3];
    w->t = t_s / second;
    w->system->piece_s = piece_s;
    memcpy(now->constant, w->gravity, (size_t)m->nq * sizeof(double));
    memset(w->load_acceleration, 0, (size_t)m->nq * sizeof(double));
    for (int i = 0; i < w->ntimed; i++) {
        const fw_effects_timed_load *l = &w->timed[i];
        fw_multibody_load *rate = &w->load[w->first_timed + i];
        double *force = now->force + 2 * (w->first_timed + i);
        double turn = l->torque_Nm / (newton * m->scale.length_m) * m->jinv[l->body];
        fw_quantity_law_value(l->law, t_s, piece_s, value);
        *rate = m->load[w->first_timed + i];
        force[0] = value[0] * l->fx_N / newton, force[1] = value[0] * l->fy_N / newton;
        rate->fx = second * value[1] * l->fx_N / newton;
        rate->fy = second * value[1] * l->fy_N / newton;
        now->constant[3 * l->body + 2] += value[0] * turn;
        w->load_acceleration[3 * l->body + 2] += second * value[1] * turn;
    }
    w->moving = false;
    for (int i = 0; i < m->nblock; i++) {
        w->way[i] = 0;
        if (!w->law[i]) continue;
        fw_quantity_law_value(w->law[i], t_s, piece_s, value);
        now->value[i] = w->start[i] + value[0] / m->block[i].unit;
        w->way[i] = second * value[1] / m->block[i].unit;
        w->moving = w->moving || w->way[i] != 0;
    }
}

/* du/dt = what the drivers force, and K_r^-1 (dQ/dt - K du/dt) along the modes. Error: round-off
   over the least stiffness. Source: implicit function theorem on the equilibrium. Test:
   test_quasi.c. */
void fw_statics_equilibrium_rate(const fw_statics_equilibrium *w, double *rate) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    memcpy(rate, w->follow, n * sizeof *rate);
    for (size_t k = 0; k < (size_t)r->dof; k++)
        for (size_t i = 0; i < n; i++)
            rate[i] += r->shape[k * n + i] * (w->push[k] / r->value[k]);
}

/* ---- what frequencies are off by ---- */

/* Of a frequency, by the error e of its stiffness: half of it, and above a tenth 1 - sqrt(1 - e), which is the larger of
   both sides (5 % of half of it more there), and all of it from e = 1 on: nothing may be left. */
double fw_statics_root_error(double error) {
    return error > 0.1 ? 1 - sqrt(1 - fmin(error, 1)) : 0.5 * error;
}

double fw_statics_mode_error(const fw_statics_mode *mode) {
    return mode->model_error + fw_statics_root_error(mode->stiffness_error);
}
