/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright hinge`: every flexure on the ladder of models, and what its axis does as it turns. */
#include "base/json.h"
#include "base/output.h"
#include "cli/cli_deck.h"
#include "cli/hinge_text.h"
#include "cli/session.h"
#include "plan/design.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- JSON ---- */

/* as fw_json_real, but a zero keeps its sign, as it always did in this document */
static void real(fw_json *json, const char *key, double value) {
    if (value == 0.0 && signbit(value))
        fw_text_add(fw_json_value(json, key), "-0.0");
    else
        fw_json_real(json, key, value);
}

static void pair(fw_json *json, const char *key, double a, double b) {
    fw_json_list(json, key);
    real(json, NULL, a);
    real(json, NULL, b);
    fw_json_end(json);
}

static void errors_json(fw_json *json, const fw_flexure_error *e) {
    fw_json_object(json, "error");
    real(json, "stiffness", e->stiffness);
    real(json, "kx", e->kx);
    real(json, "ky", e->ky);
    real(json, "strain", e->strain);
    real(json, "centre_m", e->centre_m);
    fw_json_truth(json, "outside", e->outside);
    fw_json_end(json);
}

static void level_json(fw_json *json, const fw_report_level *r) {
    fw_json_object(json, NULL);
    fw_json_text(json, "level", r->name);
    fw_json_truth(json, "solved", r->state == FW_LEVEL_SOLVED);
    if (r->state == FW_LEVEL_SOLVED) {
        real(json, "stiffness_Nm_per_rad", r->stiffness_Nm_per_rad);
        pair(json, "centre_m", r->centre_m[0], r->centre_m[1]);
        real(json, "strain_per_rad", r->strain_per_rad);
        real(json, "limit_angle_rad", r->limit_angle_rad);
        real(json, "cpu_s", r->cpu_s);
        real(json, "kx_N_per_m", r->kx_N_per_m);
        real(json, "ky_N_per_m", r->ky_N_per_m);
        real(json, "limit_moment_Nm", r->moment_Nm);
        real(json, "limit_drift_m", r->drift_m);
        errors_json(json, &r->error);
    } else
        fw_json_text(json, "why", r->why);
    fw_json_end(json);
}

static void picked_json(fw_json *json, const fw_plan_ladder *l, double accuracy) {
    char why[200];
    if (l->picked < 0) {
        fw_json_null(json, "picked");
        return;
    }
    fw_cli_ladder_why(l, accuracy, why, sizeof why);
    fw_json_object(json, "picked");
    fw_json_text(json, "level", l->row[l->picked].name);
    fw_json_truth(json, "reached", l->reached);
    fw_json_text(json, "why", why);
    fw_json_end(json);
}

static void drift_curve(fw_json *json, const fw_plan_ladder_drift *d) {
    static const char *const column[] = {"rotation_rad", "drift_m", "pole_m", "gap_left_m"};
    fw_json_list(json, "columns");
    for (int k = 0; k < 4; k++)
        fw_json_text(json, NULL, column[k]);
    fw_json_end(json);
    fw_json_list(json, "curve");
    for (int i = 0; i < FW_DRIFT_POINTS; i++) {
        const fw_flexure_drift_point *p = &d->point[i];
        fw_json_list(json, NULL);
        real(json, NULL, p->rotation_rad);
        real(json, NULL, p->drift_m);
        real(json, NULL, p->pole_m);
        real(json, NULL, d->surfaces.gap_m > 0 ? p->left_m : (double)NAN);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void drift_json(fw_json *json, const fw_plan_ladder_drift *d) {
    fw_json_object(json, "drift");
    real(json, "gap_m", d->surfaces.gap_m);
    real(json, "aside_rad", d->surfaces.aside_rad);
    pair(json, "contact_rad", d->contact_rad[0], d->contact_rad[1]);
    pair(json, "closing_N", d->closing_N[0], d->closing_N[1]);
    fw_json_object(json, "advice");
    real(json, "offset_m", d->advice.offset_m);
    real(json, "gap_m", d->advice.gap_m);
    real(json, "centred_gap_m", d->advice.centred_m);
    fw_json_end(json);
    drift_curve(json, d);
    fw_json_end(json);
}

static void compliance_json(fw_json *json, const fw_flexure_result *r) {
    fw_json_list(json, "compliance");
    for (int i = 0; i < 3; i++) {
        fw_json_list(json, NULL);
        for (int k = 0; k < 3; k++)
            real(json, NULL, r->compliance[i][k]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void same_as_json(fw_json *json, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    if (l->shared < 0) {
        fw_json_null(json, "same_as");
        return;
    }
    fw_json_object(json, "same_as");
    fw_json_text(json, "id", fw_plan_ladder_id(&all->item[l->shared]));
    fw_json_text(json, "flow", all->item[l->shared].flow);
    fw_json_end(json);
}

static void hinge_json(fw_json *json, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    const fw_mechanism_hinge *h = l->hinge;
    const fw_flexure_result *c = &h->closed_form;
    fw_json_object(json, NULL);
    fw_json_text(json, "id", fw_plan_ladder_id(l));
    fw_json_text(json, "flow", l->flow);
    fw_json_list(json, "levels");
    for (int i = 0; i < l->rows; i++)
        level_json(json, &l->row[i]);
    fw_json_end(json);
    real(json, "axis_rad", h->axis_rad);
    pair(json, "axis_offset_m", c->offset_m[0], c->offset_m[1]);
    real(json, "youngs_Pa", c->youngs_Pa);
    real(json, "stress_per_rad_Pa", c->stress_per_rad_Pa);
    real(json, "strain_bound_per_rad", c->strain_per_rad);
    real(json, "strain_fit_per_rad", c->strain_fit_per_rad);
    real(json, "used_stiffness_Nm_per_rad", l->mechanism->pin[h->pin].stiffness_Nm_per_rad);
    compliance_json(json, c);
    picked_json(json, l, all->accuracy);
    same_as_json(json, all, l);
    drift_json(json, &l->drift);
    fw_json_end(json);
}

static fw_status document(const fw_plan_ladders *all, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.hinge/1");
    real(&json, "accuracy_wanted", all->accuracy);
    fw_json_list(&json, "hinges");
    for (int i = 0; i < all->count; i++)
        hinge_json(&json, all, &all->item[i]);
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "");
}

/* ---- the command ---- */

static fw_status save(fw_plan *plan, const fw_cli_options *options, const fw_text *json,
                      const fw_text *svg) {
    if (options->svg)
        FW_TRY(fw_output_single(plan->arena, options->svg, svg->data, svg->length, &plan->diags));
    if (!options->output) return FW_OK;
    fw_output *output;
    FW_TRY(fw_output_open(plan->arena, options->output, &plan->diags, &output));
    fw_status status = fw_output_write(output, "hinge.json", json->data, json->length);
    if (status == FW_OK) status = fw_output_write(output, "hinge.svg", svg->data, svg->length);
    if (status == FW_OK) status = fw_output_commit(output);
    fw_output_abort(output);
    return status;
}

static fw_status picture(fw_plan *plan, const fw_plan_ladders *all, fw_text *out) {
    fw_report_hinge *shown;
    FW_TRY(fw_plan_report_hinges(plan, all, &shown));
    *out = fw_text_new(plan->arena);
    return fw_report_hinges_svg(plan->device, shown, all->count, out);
}

/* what the ladder could not give, for people: the JSON has it at the hinge */
static void say(fw_plan *plan, const fw_plan_ladders *all) {
    for (int i = 0; i < all->count; i++) {
        const fw_plan_ladder *l = &all->item[i];
        fw_place place = plan->device->flexure[l->hinge->flexure].place;
        for (int k = 0; k < l->rows; k++)
            if (l->row[k].state != FW_LEVEL_SOLVED)
                fw_diag_note(&plan->diags, 267, place, "hinge %s: no level %s: %s",
                             fw_plan_ladder_id(l), l->row[k].name, l->row[k].why);
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
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    for (int i = 0; i < (int)count; i++)
        if (strcmp(options->level, level[i].name) == 0) return i;
    return FW_LADDER_AUTO;
}

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    fw_plan_ladders all;
    fw_text svg = {0};
    FW_TRY(fw_plan_ladders_run(plan, wanted(options), &all));
    say(plan, &all);
    if (options->svg || options->output) FW_TRY(picture(plan, &all, &svg));
    fw_text json = fw_text_new(plan->arena);
    if (options->json || options->output) FW_TRY(document(&all, &json));
    fw_status status = save(plan, options, &json, &svg);
    if (status == FW_OK) status = decks(plan, options);
    if (status == FW_OK && options->json)
        puts(json.data);
    else if (status == FW_OK && !options->quiet && !fw_cli_session_file_on_stdout(options))
        status = fw_cli_hinge_print(plan->arena, &all, wanted(options) == FW_LADDER_CHEAP);
    return status;
}

int fw_cli_command_hinge(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    /* the ladder is not in the library: straight to the rooms */
    fw_status status = run(fw_plan_design_plan(design), options);
    return fw_cli_session_close(design, options, (int)status, 0);
}
