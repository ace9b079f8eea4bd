/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright hinge`: every flexure on the ladder of models, and what its axis does as it turns. */
#include "base/output.h"
#include "cli/deck.h"
#include "cli/hinge_text.h"
#include "cli/session.h"
#include "plan/design.h"
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- JSON ---- */

/* JSON has no numbers that are not finite */
static json_t *real(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *errors_json(const fw_flexure_error *e) {
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:b}", "stiffness", e->stiffness, "kx", e->kx, "ky",
                     e->ky, "strain", e->strain, "centre_m", e->centre_m, "outside", e->outside);
}

static json_t *level_json(const fw_report_level *r) {
    if (r->state != FW_LEVEL_SOLVED)
        return json_pack("{s:s, s:b, s:s}", "level", r->name, "solved", 0, "why", r->why);
    return json_pack("{s:s, s:b, s:f, s:[f,f], s:f, s:f, s:f, s:o, s:o, s:f, s:o, s:o}", "level",
                     r->name, "solved", 1, "stiffness_Nm_per_rad", r->stiffness_Nm_per_rad,
                     "centre_m", r->centre_m[0], r->centre_m[1], "strain_per_rad",
                     r->strain_per_rad, "limit_angle_rad", r->limit_angle_rad, "cpu_s", r->cpu_s,
                     "kx_N_per_m", real(r->kx_N_per_m), "ky_N_per_m", real(r->ky_N_per_m),
                     "limit_moment_Nm", r->moment_Nm, "limit_drift_m", real(r->drift_m), "error",
                     errors_json(&r->error));
}

static json_t *picked_json(const fw_ladder *l, double accuracy) {
    char why[200];
    if (l->picked < 0) return json_null();
    fw_ladder_why(l, accuracy, why, sizeof why);
    return json_pack("{s:s, s:b, s:s}", "level", l->row[l->picked].name, "reached", l->reached,
                     "why", why);
}

static json_t *drift_json(const fw_ladder *l) {
    const fw_ladder_drift *d = &l->drift;
    json_t *curve = json_array();
    for (int i = 0; i < FW_DRIFT_POINTS; i++) {
        const fw_drift_point *p = &d->point[i];
        json_array_append_new(curve,
                              json_pack("[f,f,f,o]", p->rotation_rad, p->drift_m, p->pole_m,
                                        d->surfaces.gap_m > 0 ? real(p->left_m) : json_null()));
    }
    return json_pack("{s:f, s:f, s:[o,o], s:[o,o], s:{s:f, s:f, s:f}, s:[s,s,s,s], s:o}", "gap_m",
                     d->surfaces.gap_m, "aside_rad", d->surfaces.aside_rad, "contact_rad",
                     real(d->contact_rad[0]), real(d->contact_rad[1]), "closing_N",
                     real(d->closing_N[0]), real(d->closing_N[1]), "advice", "offset_m",
                     d->advice.offset_m, "gap_m", d->advice.gap_m, "centred_gap_m",
                     d->advice.centred_m, "columns", "rotation_rad", "drift_m", "pole_m",
                     "gap_left_m", "curve", curve);
}

static json_t *compliance_json(const fw_flexure_result *r) {
    json_t *rows = json_array();
    for (int i = 0; i < 3; i++)
        json_array_append_new(rows, json_pack("[f,f,f]", r->compliance[i][0], r->compliance[i][1],
                                              r->compliance[i][2]));
    return rows;
}

static json_t *hinge_json(const fw_ladders *all, const fw_ladder *l) {
    const fw_hinge *h = l->hinge;
    const fw_flexure_result *c = &h->closed_form;
    json_t *levels = json_array();
    for (int i = 0; i < l->rows; i++)
        json_array_append_new(levels, level_json(&l->row[i]));
    json_t *whole = json_pack(
        "{s:s, s:s?, s:o, s:o, s:[f,f], s:f, s:f, s:f, s:f, s:f, s:o}", "id", fw_ladder_id(l),
        "flow", l->flow, "levels", levels, "axis_rad", real(h->axis_rad), "axis_offset_m",
        c->offset_m[0], c->offset_m[1], "youngs_Pa", c->youngs_Pa, "stress_per_rad_Pa",
        c->stress_per_rad_Pa, "strain_bound_per_rad", c->strain_per_rad, "strain_fit_per_rad",
        c->strain_fit_per_rad, "used_stiffness_Nm_per_rad",
        l->mechanism->pin[h->pin].stiffness_Nm_per_rad, "compliance", compliance_json(c));
    if (!whole) return NULL;
    json_object_set_new(whole, "picked", picked_json(l, all->accuracy));
    json_object_set_new(whole, "same_as",
                        l->shared < 0
                            ? json_null()
                            : json_pack("{s:s, s:s?}", "id", fw_ladder_id(&all->item[l->shared]),
                                        "flow", all->item[l->shared].flow));
    json_object_set_new(whole, "drift", drift_json(l));
    return whole;
}

static char *as_json(const fw_ladders *all) {
    json_t *list = json_array();
    for (int i = 0; i < all->count; i++)
        json_array_append_new(list, hinge_json(all, &all->item[i]));
    json_t *whole = json_pack("{s:s, s:f, s:o}", "schema", "flexwright.hinge/1", "accuracy_wanted",
                              all->accuracy, "hinges", list);
    char *text = whole ? json_dumps(whole, JSON_REAL_PRECISION(17) | JSON_INDENT(1)) : NULL;
    json_decref(whole);
    return text;
}

/* ---- the command ---- */

static fw_status save(fw_plan *plan, const fw_cli_options *options, const char *json,
                      const fw_text *svg) {
    if (options->svg)
        FW_TRY(fw_output_single(plan->arena, options->svg, svg->data, svg->length, &plan->diags));
    if (!options->output) return FW_OK;
    fw_output *output;
    FW_TRY(fw_output_open(plan->arena, options->output, &plan->diags, &output));
    fw_status status = fw_output_write(output, "hinge.json", json, strlen(json));
    if (status == FW_OK) status = fw_output_write(output, "hinge.svg", svg->data, svg->length);
    if (status == FW_OK) status = fw_output_commit(output);
    fw_output_abort(output);
    return status;
}

static fw_status picture(fw_plan *plan, const fw_ladders *all, fw_text *out) {
    fw_report_hinge *shown;
    FW_TRY(fw_plan_report_hinges(plan, all, &shown));
    *out = fw_text_new(plan->arena);
    return fw_report_hinges_svg(plan->device, shown, all->count, out);
}

/* what the ladder could not give, for people: the JSON has it at the hinge */
static void say(fw_plan *plan, const fw_ladders *all) {
    for (int i = 0; i < all->count; i++) {
        const fw_ladder *l = &all->item[i];
        fw_place place = plan->device->flexure[l->hinge->flexure].place;
        for (int k = 0; k < l->rows; k++)
            if (l->row[k].state != FW_LEVEL_SOLVED)
                fw_diag_note(&plan->diags, 267, place, "hinge %s: no level %s: %s", fw_ladder_id(l),
                             l->row[k].name, l->row[k].why);
    }
}

static fw_status decks(fw_plan *plan, const fw_cli_options *options) {
    int files;
    if (!options->deck) return FW_OK;
    FW_TRY(fw_cli_decks(plan, options->deck, 0, &files));
    if (!options->quiet) fprintf(stderr, "flexwright: %d decks in %s\n", files, options->deck);
    return FW_OK;
}

/* an accuracy that is asked for may cost what it costs; the default one does not start programs */
static int wanted(const fw_cli_options *options) {
    if (!options->level) return options->design.accuracy > 0 ? FW_LADDER_AUTO : FW_LADDER_CHEAP;
    if (strcmp(options->level, "all") == 0) return FW_LADDER_ALL;
    size_t count;
    const fw_ladder_level *level = fw_ladder_levels(&count);
    for (int i = 0; i < (int)count; i++)
        if (strcmp(options->level, level[i].name) == 0) return i;
    return FW_LADDER_AUTO;
}

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    fw_ladders all;
    fw_text svg = {0};
    FW_TRY(fw_plan_ladders(plan, wanted(options), &all));
    say(plan, &all);
    if (options->svg || options->output) FW_TRY(picture(plan, &all, &svg));
    char *json = options->json || options->output ? as_json(&all) : NULL;
    if (!json && (options->json || options->output)) return FW_NOMEM;
    fw_status status = save(plan, options, json, &svg);
    if (status == FW_OK) status = decks(plan, options);
    if (status == FW_OK && options->json)
        puts(json);
    else if (status == FW_OK && !options->quiet && !fw_session_file_on_stdout(options))
        status = fw_hinge_print(plan->arena, &all, wanted(options) == FW_LADDER_CHEAP);
    free(json);
    return status;
}

int fw_command_hinge(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_session_open(options, &exit_status);
    if (!design) return exit_status;
    /* the ladder is not in the library: straight to the rooms */
    fw_status status = run(fw_design_plan(design), options);
    return fw_session_close(design, options, (int)status, 0);
}
