/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright hinge`: every flexure on the ladder of models, and what its axis does as it turns. */
#include "base/output.h"
#include "cli/hinge_ladder.h"
#include "cli/session.h"
#include "plan/design.h"
#include "report/report.h"
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LEVELS = 8 };

typedef struct ladder {
    const char *flow;
    fw_ladder_case of;
    const fw_ladder_level *level[MOST_LEVELS];
    fw_ladder_row row[MOST_LEVELS];
    int rows;
    fw_ladder_drift drift;
} ladder;

typedef struct ladders {
    ladder *item;
    int count;
} ladders;

static const double degrees = 180 / M_PI;

static const char *id_of(const ladder *l) {
    return l->of.mechanism->pin[l->of.hinge->pin].id;
}

/* ---- JSON ---- */

/* JSON has no numbers that are not finite */
static json_t *real(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *errors_json(const fw_flexure_error *e) {
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:b}", "stiffness", e->stiffness, "kx", e->kx, "ky",
                     e->ky, "strain", e->strain, "centre_m", e->centre_m, "outside", e->outside);
}

static json_t *level_json(const ladder *l, int i) {
    const fw_ladder_row *r = &l->row[i];
    return json_pack("{s:s, s:f, s:[f,f], s:f, s:f, s:f, s:o, s:o, s:o}", "level",
                     l->level[i]->name, "stiffness_Nm_per_rad", r->stiffness_Nm_per_rad, "centre_m",
                     r->centre_m[0], r->centre_m[1], "strain_per_rad", r->strain_per_rad,
                     "limit_angle_rad", r->limit_angle_rad, "cpu_s", r->cpu_s, "kx_N_per_m",
                     real(r->kx_N_per_m), "ky_N_per_m", real(r->ky_N_per_m), "error",
                     errors_json(&r->error));
}

static json_t *drift_json(const ladder *l) {
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

static json_t *hinge_json(const ladder *l) {
    const fw_hinge *h = l->of.hinge;
    const fw_flexure_result *c = &h->closed_form;
    json_t *levels = json_array();
    for (int i = 0; i < l->rows; i++)
        json_array_append_new(levels, level_json(l, i));
    json_t *whole = json_pack(
        "{s:s, s:s?, s:o, s:o, s:[f,f], s:f, s:f, s:f, s:f, s:o}", "id", id_of(l), "flow", l->flow,
        "levels", levels, "axis_rad", real(h->axis_rad), "axis_offset_m", c->offset_m[0],
        c->offset_m[1], "youngs_Pa", c->youngs_Pa, "stress_per_rad_Pa", c->stress_per_rad_Pa,
        "strain_bound_per_rad", c->strain_bound_per_rad, "used_stiffness_Nm_per_rad",
        l->of.mechanism->pin[h->pin].stiffness_Nm_per_rad, "compliance", compliance_json(c));
    if (whole) json_object_set_new(whole, "drift", drift_json(l));
    return whole;
}

static char *as_json(const ladders *all) {
    json_t *list = json_array();
    for (int i = 0; i < all->count; i++)
        json_array_append_new(list, hinge_json(&all->item[i]));
    json_t *whole = json_pack("{s:s, s:o}", "schema", "flexwright.hinge/1", "hinges", list);
    char *text = whole ? json_dumps(whole, JSON_REAL_PRECISION(17) | JSON_INDENT(1)) : NULL;
    json_decref(whole);
    return text;
}

/* ---- text ---- */

static void column(fw_text *out, const char *conversion, double value, double scale) {
    if (isfinite(value))
        fw_text_real(out, conversion, value * scale);
    else
        fw_text_printf(out, "%*s", atoi(conversion + 1), "-");
}

static void level_text(fw_text *out, const ladder *l, int i) {
    const fw_ladder_row *r = &l->row[i];
    fw_text_printf(out, "    %-12s", l->level[i]->name);
    column(out, "%12.5e", r->stiffness_Nm_per_rad, 1);
    column(out, "%11.3f", r->kx_N_per_m, 1);
    column(out, "%12.3f", r->ky_N_per_m, 1);
    column(out, "%12.3f", r->centre_m[0], 1e6);
    column(out, "%11.3f", r->centre_m[1], 1e6);
    column(out, "%10.5f", r->strain_per_rad, 1);
    column(out, "%8.3f", r->limit_angle_rad, degrees);
    column(out, "%7.1f", r->error.stiffness, 100);
    column(out, "%6.1f", r->error.kx, 100);
    column(out, "%6.1f", r->error.ky, 100);
    column(out, "%7.2f", r->error.centre_m, 1e6);
    column(out, "%7.1f", r->error.strain, 100);
    column(out, "%10.2e", r->cpu_s, 1);
    fw_text_add(out, "\n");
}

static void drift_text(fw_text *out, const ladder *l) {
    const fw_ladder_drift *d = &l->drift;
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

static void hinge_text(fw_text *out, const ladder *l) {
    const fw_hinge *h = l->of.hinge;
    const fw_flexure_result *c = &h->closed_form;
    fw_text_printf(out, "  hinge %s%s%s: E ", id_of(l), l->flow ? ", flow " : "",
                   l->flow ? l->flow : "");
    fw_text_real(out, "%.2f", c->youngs_Pa * 1e-9);
    fw_text_add(out, " GPa, peak stress ");
    fw_text_real(out, "%.4g", c->stress_per_rad_Pa * 1e-6);
    fw_text_add(out, " MPa/rad, stiffness used ");
    fw_text_real(out, "%.5e", l->of.mechanism->pin[h->pin].stiffness_Nm_per_rad);
    fw_text_add(out, " N m/rad");
    if (hypot(c->offset_m[0], c->offset_m[1]) > 5e-10) {
        fw_text_add(out, ",\n    crystal moves the elastic centre by ");
        fw_text_real(out, "%.3f", c->offset_m[0] * 1e6);
        fw_text_add(out, " um along and ");
        fw_text_real(out, "%.3f", c->offset_m[1] * 1e6);
        fw_text_add(out, " um across from where it is drawn");
    }
    fw_text_add(out, c->error.outside
                         ? "\n    outside of the shapes that were compared with finite "
                           "elements: errors are guesses\n"
                         : "\n");
    for (int i = 0; i < l->rows; i++)
        level_text(out, l, i);
    drift_text(out, l);
}

static fw_status print(fw_arena *arena, const ladders *all) {
    fw_text out = fw_text_new(arena);
    fw_text_add(
        &out,
        "    level         stiffness         kx          ky    centre x   centre y   peak     limit"
        "  +-stiff   +-kx  +-ky +-centre +-peak     cost\n"
        "                    N m/rad        N/m         N/m          um         um  1/rad       deg"
        "        %      %     %      um      %        s\n");
    for (int i = 0; i < all->count; i++)
        hinge_text(&out, &all->item[i]);
    FW_TRY(fw_text_end(&out));
    fputs(out.data, stdout);
    return FW_OK;
}

/* ---- what is shown ---- */

static fw_status climb(ladder *l) {
    size_t count;
    const fw_ladder_level *level = fw_ladder_levels(&count);
    for (size_t i = 0; i < count && l->rows < MOST_LEVELS; i++) {
        bool exists = false;
        FW_TRY(fw_ladder_climb(&l->of, &level[i], &l->row[l->rows], &exists));
        if (exists) l->level[l->rows++] = &level[i];
    }
    fw_ladder_drift_of(&l->of, &l->drift);
    return FW_OK;
}

static fw_status climb_all(fw_plan *plan, ladders *all) {
    const fw_layout *layout = NULL;
    fw_diags drawing = fw_diags_new(plan->arena);
    if (fw_layout_build(plan->arena, plan->device, &drawing, &layout) != FW_OK) layout = NULL;
    size_t most = (size_t)plan->nflow * (size_t)plan->device->njoint;
    FW_NEED(all->item = fw_arena_array(plan->arena, ladder, most));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_mechanism *m;
        const fw_variant *v = &plan->flow[i].variant;
        FW_TRY(fw_mechanism_build(plan->arena, plan->device, layout, v, &plan->diags, &m));
        for (int k = 0; k < m->nhinge; k++) {
            ladder *l = &all->item[all->count++];
            *l = (ladder){.flow = v->flow, .of = {plan->arena, m, &m->hinge[k]}};
            FW_TRY(climb(l));
        }
    }
    return FW_OK;
}

static fw_status picture(fw_plan *plan, const ladders *all, fw_text *out) {
    fw_report_hinge *shown = fw_arena_array(plan->arena, fw_report_hinge, (size_t)all->count);
    FW_NEED(shown);
    for (int i = 0; i < all->count; i++) {
        const ladder *l = &all->item[i];
        const fw_hinge *h = l->of.hinge;
        int body = l->of.mechanism->pin[h->pin].body_a;
        double phi = body == FW_GROUND ? 0 : l->of.mechanism->body[body].phi_rad;
        shown[i] =
            (fw_report_hinge){.id = id_of(l),
                              .flow = l->flow,
                              .hinge = h,
                              .cover_rad = {h->cover_from_rad + phi, h->cover_to_rad + phi},
                              .point = l->drift.point,
                              .npoint = FW_DRIFT_POINTS,
                              .gap_m = l->drift.surfaces.gap_m,
                              .contact_rad = {l->drift.contact_rad[0], l->drift.contact_rad[1]}};
    }
    *out = fw_text_new(plan->arena);
    return fw_report_hinges_svg(plan->device, shown, all->count, out);
}

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

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    ladders all = {0};
    fw_text svg = {0};
    FW_TRY(climb_all(plan, &all));
    if (options->svg || options->output) FW_TRY(picture(plan, &all, &svg));
    char *json = options->json || options->output ? as_json(&all) : NULL;
    if (!json && (options->json || options->output)) return FW_NOMEM;
    fw_status status = save(plan, options, json, &svg);
    if (status == FW_OK && options->json)
        puts(json);
    else if (status == FW_OK && !options->quiet && !fw_session_file_on_stdout(options))
        status = print(plan->arena, &all);
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
