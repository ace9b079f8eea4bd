/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem of a device, and what follows from given rates. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static void guess_of(const fw_mechanism *m, double *q) {
    for (int b = 0; b < m->nbody; b++) {
        q[3 * b] = m->body[b].x_m;
        q[3 * b + 1] = m->body[b].y_m;
        q[3 * b + 2] = m->body[b].phi_rad;
    }
}

static fw_status usage(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* "10 rad/s, 0.2 mm/s": values with units, one per independent coordinate; power 1: rates, 2:
   accelerations */
static fw_status read_values(fw_plan *plan, const char *list, const char *option,
                             const fw_assembly_coordinate_choice *choice, int power,
                             double *value) {
    int count = 0;
    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        count++;
    if (count != choice->count)
        return usage(fw_diag_error(&plan->diags, 119, (fw_place){0},
                                   "--%s has %d value%s, and there %s %d independent coordinate%s "
                                   "(%s)",
                                   option, count, count == 1 ? "" : "s",
                                   choice->count == 1 ? "is" : "are", choice->count,
                                   choice->count == 1 ? "" : "s", choice->text));
    const fw_quantity_names none = {NULL, 0};
    for (int i = 0; i < count; i++) {
        size_t n = strcspn(list, ",");
        const fw_quantity_dimension wanted = {
            .m = choice->item[i].axis < 2, .rad = choice->item[i].axis == 2, .s = (int8_t)-power};
        fw_quantity_expression_error error;
        fw_status status =
            fw_quantity_expression_evaluate(plan->arena, list, n, &none, wanted, &value[i], &error);
        if (status == FW_INPUT)
            return usage(fw_diag_error(&plan->diags, 119, (fw_place){0}, "--%s, value %d: %s",
                                       option, i + 1, error.message));
        FW_TRY(status);
        list += n + (list[n] == ',');
    }
    return FW_OK;
}

static fw_status kinematics(fw_plan *plan, fw_plan_assembly *out) {
    const fw_plan_options *o = &plan->options;
    fw_assembly_kinematics_options options = {.independent = o->independent,
                                              .accuracy = o->verdict.motion.accuracy,
                                              .effects = o->verdict.motion.effects};
    const fw_mechanism *m = out->mechanism;
    const double *q = out->assembly->after;
    bool asked = o->independent || o->rates || o->accelerations;
    if (!asked && (m->nbody > FW_KINEMATICS_MOST / 3 || !out->assembly->rank.clear)) return FW_OK;
    FW_TRY(fw_assembly_kinematics_solve(plan->arena, m, out->scene, q, &options, &plan->diags,
                                        &out->kinematics));
    out->motion = m->ndriver > 0 || o->rates || o->accelerations;
    if (!o->rates && !o->accelerations) return FW_OK;
    const fw_assembly_coordinate_choice *choice = &out->kinematics->independent;
    double *rate, *accel;
    FW_NEED(rate = fw_arena_array(plan->arena, double, (size_t)choice->count));
    FW_NEED(accel = fw_arena_array(plan->arena, double, (size_t)choice->count));
    if (o->rates) FW_TRY(read_values(plan, o->rates, "rates", choice, 1, rate));
    if (o->accelerations)
        FW_TRY(read_values(plan, o->accelerations, "accelerations", choice, 2, accel));
    options.independent = choice->text;
    options.rate = rate, options.accel = accel;
    options.nrate = options.naccel = choice->count;
    bool automatic = choice->automatic;
    fw_assembly_kinematics *with;
    FW_TRY(fw_assembly_kinematics_solve(plan->arena, m, out->scene, q, &options, &plan->diags,
                                        &out->kinematics));
    FW_NEED(with = fw_arena_one(plan->arena, fw_assembly_kinematics));
    *with = *out->kinematics;
    with->independent.automatic = automatic;
    out->kinematics = with;
    return FW_OK;
}

fw_status fw_plan_assemble(fw_plan *plan, fw_plan_assembly *out) {
    double *q;
    *out = (fw_plan_assembly){0};
    if (plan->device->nscene > 0 || plan->options.scene) {
        out->scene = fw_plan_scene(plan);
        if (!out->scene) return FW_INPUT; /* said there */
    }
    FW_TRY(fw_plan_mechanism(plan, out->scene, &out->mechanism));
    FW_NEED(q = fw_arena_array(plan->arena, double, 3 * (size_t)out->mechanism->nbody));
    guess_of(out->mechanism, q);
    fw_assembly *assembly = NULL;
    fw_status status = fw_assembly_solve(plan->arena, out->mechanism, q, &plan->diags, &assembly);
    out->assembly = assembly;
    FW_TRY(status);
    out->closed = true;
    return kinematics(plan, out);
}
