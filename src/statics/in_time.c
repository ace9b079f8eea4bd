/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria at a time of the scene: loads and drivers at the value of their laws, and their rates
   in the place of the derivatives by the load factor. */
#include "multibody/system.h"
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

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
    FW_TRY(fw_statics_equilibrium_build(w, &loads));
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
