/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "cli/session.h"
#include "report/json.h"
#include <math.h>
#include <stdio.h>

static void print_motion(const fw_scene *scene, const fw_mechanism *m, const fw_motion *motion) {
    const fw_motion_stats *s = &motion->stats;
    char rtol[32], norm[32], energy[32];
    printf("scene %s over %g ms, method %s, integrator %s (%s)\n", scene->name,
           scene->duration_s * 1e3, motion->method, motion->integrator, motion->reason);
    printf("%ld steps, %ld rejected, %ld right-hand sides, %ld projections, %.2f ms of CPU\n",
           s->steps, s->rejected, s->rhs, s->projections, s->cpu_s * 1e3);
    printf("relative tolerance %s, largest constraint norm %s, energy balance %s\n\n",
           fw_number_text(rtol, sizeof rtol, s->rtol, 3),
           fw_number_text(norm, sizeof norm, s->max_constraint_norm, 2),
           fw_number_text(energy, sizeof energy, s->energy_error, 2));
    printf("  joint    peak angle          at        +-\n");
    for (int i = 0; i < motion->npin; i++)
        printf("  %-6s %9.4f deg  %9.5f ms  %.1e deg\n", m->pin[i].id,
               motion->peak[i].angle_rad * 180 / acos(-1.0), motion->peak[i].t_s * 1e3,
               motion->peak[i].error_rad * 180 / acos(-1.0));
    printf("\n  effect             active  why\n");
    for (int i = 0; i < motion->ledger.count; i++) {
        const fw_effect_entry *e = &motion->ledger.item[i];
        printf("  %-18s %-6s  %s\n", e->id, e->active ? "yes" : "no", e->reason);
    }
}

static fw_status write_file(fw_plan *plan, const char *path, const fw_text *text) {
    FW_TRY(fw_text_end(text));
    return fw_output_single(plan->arena, path, text->data, text->length, &plan->diags);
}

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    const fw_motion *motion;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    FW_TRY(fw_plan_simulate(plan, &motion, &mechanism, &scene));
    if (options->csv) {
        fw_text csv = fw_text_new(plan->arena);
        FW_TRY(fw_report_motion_csv(mechanism, motion, &csv));
        FW_TRY(write_file(plan, options->csv, &csv));
    }
    if (options->animate) {
        fw_text svg = fw_text_new(plan->arena);
        FW_TRY(fw_report_animation_svg(plan->arena, plan->device, plan->layout, mechanism, motion,
                                       scene, &svg));
        FW_TRY(write_file(plan, options->animate, &svg));
    }
    bool csv_on_stdout = options->csv && options->csv[0] == '-' && !options->csv[1];
    if (options->json) {
        fw_text json = fw_text_new(plan->arena);
        FW_TRY(fw_report_simulate_json(mechanism, motion, &json));
        fw_session_print(&json);
    } else if (!options->quiet && !csv_on_stdout)
        print_motion(scene, mechanism, motion);
    return FW_OK;
}

int fw_command_simulate(fw_cli_options *options) {
    int exit_status;
    fw_plan *plan = fw_session_open(options, &exit_status);
    if (!plan) return exit_status;
    return fw_session_close(plan, options, run(plan, options), 0);
}
