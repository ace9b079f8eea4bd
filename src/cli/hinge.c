/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include "plan/design.h"
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct row {
    const fw_plan_flow *flow;
    const fw_mechanism *mechanism;
    const fw_hinge *hinge;
    double cpu_s;
} row;

/* the closed form a thousand times, since once is shorter than the clock's tick */
static double measured_s(const fw_mechanism *m, const fw_hinge *h) {
    const fw_flexure *f = &m->device->flexure[h->flexure];
    const fw_material *material = &m->variant->material;
    fw_flexure_input in = {.kind = f->kind,
                           .length_m = f->length_m,
                           .angle_rad = f->angle_rad,
                           .radius_m = f->radius_m,
                           .width_m = f->width_m,
                           .fillet_m = fw_flexure_default_fillet(f),
                           .depth_m = m->variant->thickness_m,
                           .youngs_Pa = material->youngs.value,
                           .poisson = material->poisson.value,
                           .strength_Pa = material->strength.value,
                           .safety_factor = m->device->safety_factor};
    struct timespec before, after;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    for (int i = 0; i < 1000; i++) {
        fw_flexure_result out;
        fw_flexure_closed_form(&in, &out);
    }
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    return ((double)(after.tv_sec - before.tv_sec) +
            1e-9 * (double)(after.tv_nsec - before.tv_nsec)) /
           1000.0;
}

static json_t *as_json(const row *r) {
    const fw_flexure_result *c = &r->hinge->closed_form;
    const fw_joint *joint = &r->mechanism->device->joint[r->hinge->pin];
    json_t *level = json_pack("{s:s, s:f, s:[f,f], s:f, s:f, s:f}", "level", "closed-form",
                              "stiffness_Nm_per_rad", c->stiffness_Nm_per_rad, "centre_m",
                              joint->x_m, joint->y_m, "strain_per_rad", c->strain_per_rad,
                              "limit_angle_rad", c->limit_angle_rad, "cpu_s", r->cpu_s);
    return json_pack("{s:s, s:s?, s:[o]}", "id", joint->id, "flow", r->flow->variant.flow, "levels",
                     level);
}

static void print(const row *r) {
    const fw_flexure_result *c = &r->hinge->closed_form;
    printf("  %-6s %12.5e %12.5e %9.3f um %9.5f %8.3f deg   %s\n",
           r->mechanism->pin[r->hinge->pin].id, c->stiffness_Nm_per_rad,
           r->mechanism->pin[r->hinge->pin].stiffness_Nm_per_rad, c->centre_m * 1e6,
           c->strain_per_rad, c->limit_angle_rad * 180 / acos(-1.0),
           r->flow->variant.flow ? r->flow->variant.flow : r->flow->variant.material.id);
}

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    json_t *list = options->json ? json_array() : NULL;
    const fw_layout *layout = NULL;
    fw_diags drawing = fw_diags_new(plan->arena);
    if (fw_layout_build(plan->arena, plan->device, &drawing, &layout) != FW_OK) layout = NULL;
    if (!options->json)
        printf("  hinge   closed form        used    W from O   strain/rad   limit\n"
               "            N m/rad       N m/rad\n");
    fw_status status = FW_OK;
    for (int i = 0; i < plan->nflow && status == FW_OK; i++) {
        const fw_mechanism *m;
        status = fw_mechanism_build(plan->arena, plan->device, layout, &plan->flow[i].variant,
                                    &plan->diags, &m);
        for (int k = 0; status == FW_OK && k < m->nhinge; k++) {
            row r = {&plan->flow[i], m, &m->hinge[k], measured_s(m, &m->hinge[k])};
            if (list)
                json_array_append_new(list, as_json(&r));
            else
                print(&r);
        }
    }
    if (list && status == FW_OK) {
        json_t *whole = json_pack("{s:s, s:O}", "schema", "flexwright.hinge/1", "hinges", list);
        char *text = whole ? json_dumps(whole, JSON_REAL_PRECISION(17) | JSON_INDENT(1)) : NULL;
        if (text)
            puts(text);
        else
            status = FW_NOMEM;
        free(text);
        json_decref(whole);
    }
    json_decref(list);
    return status;
}

int fw_command_hinge(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_session_open(options, &exit_status);
    if (!design) return exit_status;
    /* the ladder is not in the library yet: straight to the rooms */
    fw_status status = run(fw_design_plan(design), options);
    return fw_session_close(design, options, (int)status, 0);
}
