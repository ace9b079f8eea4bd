/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright hinge`: every flexure on the ladder of models, and what its axis does as it turns. */
#include "base/constants.h"
#include "base/json.h"
#include "base/output.h"
#include "cli/cli.h"
#include "continuum/continuum.h"
#include "plan/design.h"
#include "plan/plan.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double degrees = 180 / FW_PI;

static void column(fw_text *out, const char *conversion, double value, double scale) {
    if (isfinite(value))
        fw_text_real(out, conversion, value * scale);
    else
        fw_text_printf(out, "%*s", atoi(conversion + 1), "-");
}

static void level_text(fw_text *out, const fw_plan_ladder *l, int i) {
    const fw_report_level *r = &l->row[i];
    fw_text_printf(out, "  %c %-12s", i == l->picked ? '*' : ' ', r->name);
    if (r->state != FW_LEVEL_SOLVED) {
        fw_text_printf(out, "  not here: %s\n", r->why);
        return;
    }
    column(out, "%12.5e", r->stiffness_Nm_per_rad, 1);
    column(out, "%11.3f", r->kx_N_per_m, 1);
    column(out, "%12.3f", r->ky_N_per_m, 1);
    column(out, "%12.3f", r->centre_m[0], 1e6);
    column(out, "%11.3f", r->centre_m[1], 1e6);
    column(out, "%10.5f", r->strain_per_rad, 1);
    column(out, "%8.3f", r->limit_angle_rad, degrees);
    column(out, "%8.3f", r->drift_m, 1e6);
    column(out, "%7.1f", r->error.stiffness, 100);
    column(out, "%6.1f", r->error.kx, 100);
    column(out, "%6.1f", r->error.ky, 100);
    column(out, "%7.2f", r->error.centre_m, 1e6);
    column(out, "%7.1f", r->error.strain, 100);
    column(out, "%10.2e", r->cpu_s, 1);
    fw_text_add(out, "\n");
}

static void drift_text(fw_text *out, const fw_plan_ladder *l) {
    const fw_plan_ladder_drift *d = &l->drift;
    fw_text_add(out, "    axis drifts by ");
    fw_text_real(out, "%.3f", fabs(d->point[0].drift_m) * 1e6);
    fw_text_add(out, " and ");
    fw_text_real(out, "%.3f", fabs(d->point[FW_DRIFT_POINTS - 1].drift_m) * 1e6);
    fw_text_add(out, " um at -+");
    fw_text_real(out, "%.2f", d->limit_rad * degrees);
    fw_text_add(out, " deg");
    if (d->surfaces.gap_m > 0) {
        fw_text_add(out, "; gap ");
        fw_text_real(out, "%.3g", d->surfaces.gap_m * 1e6);
        fw_text_add(out, " um closes by a moment at ");
        for (int side = 0; side < 2; side++) {
            double at = d->contact_rad[side] * degrees;
            if (isfinite(at))
                fw_text_real(out, "%+.1f", at);
            else
                fw_text_add(out, "none");
            fw_text_add(out, side ? " deg" : " / ");
        }
        fw_text_add(out, ", by ");
        fw_text_real(out, "%.4g", d->closing_N[0] * 1e6);
        fw_text_add(out, " uN along or ");
        fw_text_real(out, "%.4g", d->closing_N[1] * 1e6);
        fw_text_add(out, " uN across; a gap of ");
        fw_text_real(out, "%.3f", d->advice.gap_m * 1e6);
        fw_text_add(out, " um would do with the first surface ");
        fw_text_real(out, "%.3f", d->advice.offset_m * 1e6);
        fw_text_add(out, " um off W");
    }
    fw_text_add(out, "\n");
}

static void why_picked(const fw_plan_ladder *l, double accuracy, char *text, size_t n) {
    if (l->reached)
        snprintf(text, n,
                 "the cheapest whose own estimate, %.2g %% of the stiffness, is within the "
                 "accuracy wanted, %.2g %%",
                 l->reaches * 100, accuracy * 100);
    else
        snprintf(text, n,
                 "none reaches the accuracy wanted, %.2g %% of the stiffness; this one, within "
                 "%.2g %%, comes closest",
                 accuracy * 100, l->reaches * 100);
}

static void picked_text(fw_text *out, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    char why[200];
    if (l->picked < 0) return;
    why_picked(l, all->accuracy, why, sizeof why);
    fw_text_printf(out, "  * %s\n", why);
    if (l->shared < 0) return;
    const fw_plan_ladder *from = &all->item[l->shared];
    fw_text_printf(out, "    solved once with %s%s%s%s, which is alike\n",
                   FW_NAMED("hinge", fw_plan_ladder_id(from)), from->flow ? ", flow " : "",
                   from->flow ? from->flow : "");
}

static void hinge_text(fw_text *out, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    const fw_mechanism_hinge *h = l->hinge;
    const fw_flexure_result *c = &h->closed_form;
    fw_text_printf(out, "  %s%s%s%s: E ", FW_NAMED("hinge", fw_plan_ladder_id(l)),
                   l->flow ? ", flow " : "", l->flow ? l->flow : "");
    fw_text_real(out, "%.2f", c->youngs_Pa * 1e-9);
    fw_text_add(out, " GPa, peak stress ");
    fw_text_real(out, "%.4g", c->stress_per_rad_Pa * 1e-6);
    fw_text_add(out, " MPa/rad, stiffness used ");
    fw_text_real(out, "%.5e", l->mechanism->pin[h->pin].stiffness_Nm_per_rad);
    fw_text_add(out, " N m/rad");
    if (hypot(c->offset_m[0], c->offset_m[1]) > 5e-10) {
        fw_text_add(
            out, h->input.crystal.known
                     ? ",\n    crystal moves the elastic centre by "
                     : ",\n    bends of different radius, which the layer's depth stiffens unlike, "
                       "move the elastic centre by ");
        fw_text_real(out, "%.3f", c->offset_m[0] * 1e6);
        fw_text_add(out, " um along and ");
        fw_text_real(out, "%.3f", c->offset_m[1] * 1e6);
        fw_text_add(out, " um across from where it is drawn");
    }
    if (h->input.fillet_m >= 0) {
        fw_text_add(out, "\n    strain and limit rest on fillets of ");
        fw_text_real(out, "%.3f", h->input.fillet_m * 1e6);
        fw_text_add(out, isnan(l->mechanism->device->flexure[h->flexure].fillet_m)
                             ? " um at its roots, chosen: none is stated"
                             : " um at its roots, as stated");
    }
    fw_text_add(out, c->error.outside
                         ? "\n    outside of the shapes that were compared with finite "
                           "elements: errors are guesses\n"
                         : "\n");
    for (int i = 0; i < l->rows; i++)
        level_text(out, l, i);
    picked_text(out, all, l);
    drift_text(out, l);
}

static fw_status print_ladders(fw_arena *arena, const fw_plan_ladders *all, bool hint) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "    level         stiffness         kx          ky    centre x   centre y   "
                      "peak     limit   drift"
                      "  +-stiff   +-kx  +-ky +-centre +-peak     cost\n"
                      "                    N m/rad        N/m         N/m          um         um  "
                      "1/rad       deg      um"
                      "        %      %     %      um      %        s\n");
    for (int i = 0; i < all->count; i++)
        hinge_text(&out, all, &all->item[i]);
    if (hint)
        fw_text_add(&out, "  continuum: not asked for, takes seconds for each hinge; --level all "
                          "or --level continuum, or an --accuracy that needs it\n");
    FW_TRY(fw_text_end(&out));
    fputs(out.data, stdout);
    return FW_OK;
}

/* ---- the document ---- */

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
    why_picked(l, accuracy, why, sizeof why);
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
    real(json, "fillet_m", h->input.fillet_m >= 0 ? h->input.fillet_m : (double)NAN);
    fw_json_truth(json, "fillet_stated",
                  !isnan(l->mechanism->device->flexure[h->flexure].fillet_m));
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
    const fw_output_member file[] = {{"hinge.json", json->data, json->length},
                                     {"hinge.svg", svg->data, svg->length}};
    return (fw_status)fw_cli_session_put(plan, options->output, file, 2);
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
                fw_diag_note(&plan->diags, 267, place, "%s%s: no level %s: %s",
                             FW_NAMED("hinge", fw_plan_ladder_id(l)), l->row[k].name,
                             l->row[k].why);
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
        status = print_ladders(plan->arena, &all, wanted(options) == FW_LADDER_CHEAP);
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

/* ---- input decks of its continuum level, for a person's own solver ---- */

typedef struct writer {
    fw_plan *plan;
    const char *directory;
    double refinement;
    const fw_layout *layout;
    const fw_mechanism *mechanism;
    const char *flow; /* NULL: the device's own material */
    int *files;
} writer;

/* ids are the user's: a file name keeps letters, digits, '-' and '_' of them */
static const char *plain(fw_arena *arena, const char *id) {
    char *name = fw_arena_strdup(arena, id ? id : "unnamed");
    for (char *c = name; c && *c; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '-' || *c == '_'))
            *c = '_';
    return name;
}

static fw_status save_deck(const writer *w, const char *kind, const char *id, const char *end,
                           const fw_text *deck) {
    fw_arena *arena = w->plan->arena;
    const char *name = plain(arena, id), *flow = w->flow ? plain(arena, w->flow) : "";
    FW_TRY(fw_text_end(deck));
    FW_NEED(name);
    FW_NEED(flow);
    const char *path = fw_arena_printf(arena, "%s/%s-%s%s%s%s.inp", w->directory, kind, name,
                                       w->flow ? "-" : "", flow, end);
    FW_NEED(path);
    FW_TRY(fw_output_single(arena, path, deck->data, deck->length, &w->plan->diags));
    ++*w->files;
    return FW_OK;
}

static fw_status one_hinge(const writer *w, int h) {
    fw_plan *plan = w->plan;
    const fw_mechanism_hinge *hinge = &w->mechanism->hinge[h];
    const fw_continuum_material material = fw_continuum_material_of(w->mechanism, hinge);
    fw_continuum_options options = {.refinement = w->refinement, .nangle = 4};
    fw_place place = plan->device->flexure[hinge->flexure].place;
    fw_continuum_shape shape;
    if (fw_flexure_input_varies(&hinge->input)) {
        fw_diag_warning(&plan->diags, 213, place,
                        "no deck of %s%s: solids are made of one arc or line of one width",
                        FW_NAMED("hinge", w->mechanism->pin[hinge->pin].id));
        return FW_OK;
    }
    fw_continuum_shape_of(&hinge->input, &shape);
    for (int i = 0; i < options.nangle; i++)
        options.angle_rad[i] = 0.25 * (i + 1) * hinge->closed_form.limit_angle_rad;
    for (int large = 0; large < 2; large++) {
        fw_text deck = fw_text_new(plan->arena);
        options.large = large;
        FW_TRY(fw_continuum_hinge_deck(plan->arena, &shape, &material, &options, place,
                                       &plan->diags, &deck));
        FW_TRY(
            save_deck(w, "hinge", w->mechanism->pin[hinge->pin].id, large ? "-large" : "", &deck));
    }
    return FW_OK;
}

/* what cannot be written is a warning and no failure: the hinges are there */
static fw_status whole_mechanism(const writer *w, const fw_device_scene *scene) {
    fw_plan *plan = w->plan;
    fw_diags own = fw_diags_new(plan->arena);
    fw_continuum_solid_device device;
    fw_text deck = fw_text_new(plan->arena);
    fw_status status =
        fw_continuum_solid_device_of(plan->arena, w->mechanism, scene, &own, &device);
    if (status == FW_OK)
        status = fw_continuum_solid_deck(plan->arena, &device,
                                         &(fw_continuum_solid_options){.refinement = w->refinement},
                                         &own, &deck);
    if (status == FW_GEOMETRY && own.count > 0) {
        fw_diag_warning(&plan->diags, 213, own.item[0].place, "%s%s: %s",
                        FW_NAMED("scene", scene->name), own.item[0].message);
        return FW_OK;
    }
    FW_TRY(status);
    return save_deck(w, "mechanism", scene->name, "", &deck);
}

fw_status fw_cli_decks(fw_plan *plan, const char *directory, double refinement, int *files) {
    const fw_device *device = plan->device;
    writer w = {.plan = plan, .directory = directory, .refinement = refinement, .files = files};
    bool made;
    *files = 0;
    FW_TRY(fw_plan_hinges_layout(plan, &w.layout));
    FW_TRY(fw_output_directory(plan->arena, directory, &made));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_mechanism_variant *variant = &plan->flow[i].variant;
        w.flow = variant->flow;
        FW_TRY(fw_plan_hinges_mechanism(plan, w.layout, variant, &w.mechanism));
        for (int h = 0; h < w.mechanism->nhinge; h++)
            FW_TRY(one_hinge(&w, h));
        bool whole = !w.layout || w.layout->nfault == 0 || !fw_device_needs_shapes(device);
        for (int s = 0; whole && s < device->nscene; s++) /* masses that nothing states are not */
            if (fw_device_in_flow(device->scene[s].flow, variant->flow))
                FW_TRY(whole_mechanism(&w, &w.mechanism->device->scene[s]));
    }
    return FW_OK;
}
