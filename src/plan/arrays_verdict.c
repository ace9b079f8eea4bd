/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is stated and what was judged, as arrays, a row each: parameters, scenes, hinges and flows; how near
   things come, what is asked of the device and what its probes saw. */
#include "plan/design.h"
#include "report/report.h"
#include <math.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* ---- the description ---- */

typedef struct parameter_row {
    const char *id, *unit, *written_unit, *doc;
    double value, min, max;
    int overridden;
} parameter_row;

static const fw_plan_column parameter_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, parameter_row, id, "name", "", "what fw_design_set takes"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, parameter_row, value, "value", "*", "as read or set, SI"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, parameter_row, min, "min", "*", "least allowed; -inf: none"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, parameter_row, max, "max", "*", "most allowed; inf: none"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, parameter_row, unit, "unit", "", "SI unit of the row"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, parameter_row, written_unit, "written_unit", "",
                   "unit that the file or the setting writes"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, parameter_row, doc, "doc", "", "what the file says of it"),
    FW_PLAN_COLUMN(FW_ARRAY_TRUTH, parameter_row, overridden, "overridden", "1",
                   "1: by fw_design_set"),
};

fw_status fw_plan_numbers_parameters(fw_design *d, fw_plan_arrays *to) {
    const fw_device *device = d->plan->device;
    const size_t n = (size_t)device->nparameter;
    parameter_row *row = fw_arena_array(to->arena, parameter_row, n);
    const char **label = fw_plan_labels(to, n);
    if (!row || !label) return FW_NOMEM;
    for (size_t i = 0; i < n; i++) {
        const fw_device_parameter *p = &device->parameter[i];
        label[i] = p->name;
        row[i] = (parameter_row){p->name,  fw_quantity_dimension_si(to->arena, p->dimension),
                                 p->unit,  p->doc,
                                 p->value, p->min,
                                 p->max,   p->overridden};
        FW_NEED(row[i].unit);
        if (!row[i].unit[0]) row[i].unit = "1";
    }
    fw_plan_array_columns(to, parameter_columns, COUNT(parameter_columns), row, n, sizeof *row,
                          label);
    return FW_OK;
}

static const fw_plan_column scene_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, fw_device_scene, name, "name", "", "of the scene"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, fw_device_scene, flow, "flow", "",
                   "the only flow that it holds in; none: all"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_device_scene, duration_s, "duration", "s", "of the scene"),
};

fw_status fw_plan_numbers_scenes(fw_design *d, fw_plan_arrays *to) {
    const fw_device *device = d->plan->device;
    const size_t n = (size_t)device->nscene;
    const char **label = fw_plan_labels(to, n);
    FW_NEED(label);
    for (size_t i = 0; i < n; i++)
        label[i] = device->scene[i].name;
    fw_plan_array_columns(to, scene_columns, COUNT(scene_columns), device->scene, n,
                          sizeof *device->scene, label);
    return FW_OK;
}

/* ---- hinges: as drawn, and the tightest of what a flow makes ---- */

typedef struct hinge_row {
    const char *id, *flow, *scene, *decision, *criterion;
    fw_verdict_hinge_verdict drawn;
    const char *made_flow, *made_scene, *made_decision, *made_corner;
    double made, made_low, made_high, made_angle, made_limit, made_most, made_nominal, made_sigma;
} hinge_row;

#define DRAWN(member, name, unit, about)                                                           \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, hinge_row, drawn.member, name, unit, about)
#define MADE(member, name, unit, about)                                                            \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, hinge_row, member, name, unit, about)
#define WORD(member, name, about) FW_PLAN_COLUMN(FW_ARRAY_TEXT, hinge_row, member, name, "", about)

static const fw_plan_column hinge_columns[] = {
    WORD(id, "id", "the joint"),
    WORD(flow, "flow", "in which it is judged; none: the device's own material"),
    WORD(scene, "scene", "that governs, or \"workspace\""),
    WORD(decision, "verdict", "as drawn: accept, inconclusive, reject"),
    DRAWN(utilisation, "utilisation", "1", "share of the elastic limit, as drawn; above 1 rejects"),
    DRAWN(utilisation_low, "utilisation_low", "1", "its band: at least"),
    DRAWN(utilisation_high, "utilisation_high", "1", "its band: at most"),
    DRAWN(peak_angle_rad, "peak_angle", "rad", "largest rotation, with its sign"),
    DRAWN(angle_error_rad, "angle_error", "rad", "estimated error of it"),
    DRAWN(limit_angle_rad, "limit_angle", "rad", "rotation at the elastic limit, safety included"),
    DRAWN(peak_strain, "peak_strain", "1", "largest strain"),
    DRAWN(strain_limit, "strain_limit", "1", "strain allowed, safety included"),
    DRAWN(limit_Pa, "limit_stress", "Pa", "peak stress that the criterion allows, before safety"),
    DRAWN(force_share, "force_share", "1", "part of the peak strain that the joint force adds"),
    DRAWN(t_s, "t", "s", "when; NaN: a pose of the workspace"),
    DRAWN(failure_probability, "failure_probability", "1", "at the peak, without safety factor"),
    DRAWN(fatigue_utilisation, "fatigue_utilisation", "1", "NaN: no cycles are asked for"),
    DRAWN(damage, "damage", "1", "Miner's sum; NaN: no cycles are asked for"),
    WORD(criterion, "criterion", "what limits it"),
    MADE(made, "made_utilisation", "1",
         "the tightest device that a flow may make; NaN: none was judged"),
    MADE(made_low, "made_utilisation_low", "1", "its band: at least"),
    MADE(made_high, "made_utilisation_high", "1", "its band: at most"),
    MADE(made_angle, "made_peak_angle", "rad", "largest rotation of that device"),
    MADE(made_limit, "made_limit_angle", "rad", "rotation at its limit"),
    MADE(made_most, "made_most", "1", "bound on all devices of the flow, run or not"),
    MADE(made_nominal, "made_nominal", "1", "utilisation of the nominal device of the flow"),
    MADE(made_sigma, "made_sigma", "1", "standard uncertainty about it, first order"),
    WORD(made_flow, "made_flow", "the flow of the tightest device"),
    WORD(made_scene, "made_scene", "that governs there"),
    WORD(made_decision, "made_verdict", "accept, inconclusive, reject"),
    WORD(made_corner, "made_corner", "what the flow makes there"),
};

static hinge_row row_of(const fw_verdict_hinge_verdict *h) {
    const double none = (double)NAN;
    return (hinge_row){.id = h->id,
                       .flow = h->flow,
                       .scene = h->scene,
                       .decision = fw_verdict_decision_text(h->decision),
                       .criterion = h->limit ? h->limit->criterion : NULL,
                       .drawn = *h,
                       .made = none,
                       .made_low = none,
                       .made_high = none,
                       .made_angle = none,
                       .made_limit = none,
                       .made_most = none,
                       .made_nominal = none,
                       .made_sigma = none};
}

/* of a flow, if it strains the hinge of this joint more than what is there */
static void take_made(hinge_row *row, const fw_verdict_variant_verdict *v, int joint) {
    const fw_verdict_fabricated_verdict *m = v->fabricated;
    for (int k = 0; m && k < v->nhinge; k++) {
        if (v->hinge[k].joint != joint) continue;
        const fw_verdict_fabricated_corner *at = &m->corner[m->hinge[k].corner];
        const fw_verdict_hinge_verdict *h = &at->hinge[k];
        if (!h->scene || !(isnan(row->made) || h->utilisation > row->made)) return;
        row->made = h->utilisation;
        row->made_low = h->utilisation_low, row->made_high = h->utilisation_high;
        row->made_angle = h->peak_angle_rad, row->made_limit = h->limit_angle_rad;
        row->made_most = m->hinge[k].most, row->made_sigma = m->hinge[k].sigma;
        row->made_nominal = m->corner[0].hinge[k].utilisation;
        row->made_flow = h->flow, row->made_scene = h->scene;
        row->made_decision = fw_verdict_decision_text(h->decision);
        row->made_corner = at->what;
        return;
    }
}

static fw_status hinges(fw_plan_arrays *to, const hinge_row *row, size_t n) {
    const char **label = fw_plan_labels(to, n);
    FW_NEED(label);
    for (size_t i = 0; i < n; i++)
        label[i] = row[i].id;
    fw_plan_array_columns(to, hinge_columns, COUNT(hinge_columns), row, n, sizeof *row, label);
    return FW_OK;
}

fw_status fw_plan_numbers_hinges(fw_design *d, fw_plan_arrays *to) {
    const fw_verdict *v = &d->plan->verdict;
    hinge_row *row = fw_arena_array(to->arena, hinge_row, (size_t)v->nhinge);
    FW_NEED(row);
    for (int i = 0; i < v->nhinge; i++) {
        row[i] = row_of(&v->hinge[i]);
        for (int k = 0; k < v->nvariant; k++)
            take_made(&row[i], &v->variant[k], v->hinge[i].joint);
    }
    return hinges(to, row, (size_t)v->nhinge);
}

fw_status fw_plan_numbers_flow_hinges(fw_design *d, fw_plan_arrays *to) {
    const fw_verdict *v = &d->plan->verdict;
    size_t n = 0, most = 0;
    for (int i = 0; i < v->nvariant; i++)
        most += (size_t)v->variant[i].nhinge;
    hinge_row *row = fw_arena_array(to->arena, hinge_row, most);
    FW_NEED(row);
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_variant_verdict *of = &v->variant[i];
        for (int k = 0; k < of->nhinge; k++) {
            if (!of->hinge[k].scene) continue;
            row[n] = row_of(&of->hinge[k]);
            row[n].flow = of->variant->flow;
            take_made(&row[n++], of, of->hinge[k].joint);
        }
    }
    return hinges(to, row, n);
}

/* ---- flows, and what governs ---- */

typedef struct flow_row {
    const char *id, *material, *decision, *drawn, *made;
    double thickness_m, total_s, bias_m, failure_probability;
    int manufacturable, reasons;
} flow_row;

static const fw_plan_column flow_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, flow_row, id, "id", "", "of the flow; none: no flow is named"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, flow_row, material, "material", "", "of the device layer"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, flow_row, thickness_m, "thickness", "m", "of the device layer"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, flow_row, decision, "verdict", "", "as drawn and as made"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, flow_row, drawn, "drawn", "", "as drawn alone"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, flow_row, made, "made", "", "as made; none: was not judged"),
    FW_PLAN_COLUMN(FW_ARRAY_TRUTH, flow_row, manufacturable, "manufacturable", "1",
                   "1 yes, 0 no, -1 not guaranteed"),
    FW_PLAN_COLUMN(FW_ARRAY_WHOLE, flow_row, reasons, "reasons", "1", "how many are given for it"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, flow_row, total_s, "total_time", "s",
                   "of all steps whose time can be computed"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, flow_row, bias_m, "bias", "m",
                   "what the mask adds to every edge"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, flow_row, failure_probability, "failure_probability", "1",
                   "of all hinges in series; NaN: not known"),
};

fw_status fw_plan_numbers_flows(fw_design *d, fw_plan_arrays *to) {
    const fw_plan *plan = d->plan;
    const size_t n = (size_t)plan->nflow;
    flow_row *row = fw_arena_array(to->arena, flow_row, n);
    const char **label = fw_plan_labels(to, n);
    if (!row || !label) return FW_NOMEM;
    for (size_t i = 0; i < n; i++) {
        const fw_plan_flow *f = &plan->flow[i];
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        label[i] = f->variant.flow ? f->variant.flow : "";
        row[i] = (flow_row){
            .id = f->variant.flow,
            .material = f->variant.material.name,
            .thickness_m = f->variant.thickness_m,
            .decision = fw_verdict_decision_text(v->decision),
            .drawn = fw_verdict_decision_text(v->drawn),
            .made = v->fabricated ? fw_verdict_decision_text(v->fabricated->decision) : NULL,
            .manufacturable = f->flow ? f->flow->manufacturable : -1,
            .reasons = f->flow ? f->flow->nreason : 0,
            .total_s = f->flow ? f->flow->total_s : (double)NAN,
            .bias_m = f->flow ? f->flow->bias_m : (double)NAN,
            .failure_probability = v->failure_probability};
    }
    fw_plan_array_columns(to, flow_columns, COUNT(flow_columns), row, n, sizeof *row, label);
    return FW_OK;
}

typedef struct governing_row {
    fw_verdict_check check;
    const char *decision;
} governing_row;

static const fw_plan_column governing_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, governing_row, check.what, "what", "",
                   "\"hinge C\"; none: nothing was judged so"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, governing_row, check.used, "used", "1",
                   "share of what is allowed"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, governing_row, check.low, "used_low", "1", "its band: at least"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, governing_row, check.high, "used_high", "1", "its band: at most"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, governing_row, check.flow, "flow", "", "in which it is so"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, governing_row, check.scene, "scene", "", "that governs"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, governing_row, check.corner, "corner", "",
                   "what the flow makes; none: as drawn"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, governing_row, check.t_s, "t", "s", "when; NaN: no one time"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, governing_row, decision, "verdict", "",
                   "accept, inconclusive, reject"),
};

fw_status fw_plan_numbers_governing(fw_design *d, fw_plan_arrays *to) {
    static const char *const label[2] = {"made", "drawn"};
    const double none = (double)NAN;
    governing_row row[2];
    for (int i = 0; i < 2; i++) {
        bool found;
        row[i] = (governing_row){.check = {.used = none, .low = none, .high = none, .t_s = none}};
        fw_verdict_check check;
        FW_TRY(fw_verdict_governing(to->arena, &d->plan->verdict,
                                    FW_CHECK_HINGES | FW_CHECK_REQUIREMENTS, i == 0, &check,
                                    &found));
        if (found) row[i] = (governing_row){check, fw_verdict_decision_text(check.decision)};
    }
    fw_plan_array_columns(to, governing_columns, COUNT(governing_columns), row, 2, sizeof *row,
                          label);
    return FW_OK;
}

/* ---- clearances ---- */

typedef struct clearance_row {
    const char *scene, *flow, *a, *b, *decision;
    double m, low_m, high_m, required_m, drawn_m, proved_m, start_m, t_s;
    double ax_m, ay_m, bx_m, by_m;
} clearance_row;

#define LENGTH(member, name, about)                                                                \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, clearance_row, member, name, "m", about)

static const fw_plan_column clearance_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, clearance_row, scene, "scene", "", "or \"workspace\""),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, clearance_row, flow, "flow", "", "that makes the walls"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, clearance_row, a, "a", "", "the nearest pair: one"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, clearance_row, b, "b", "", "the nearest pair: the other"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, clearance_row, decision, "verdict", "",
                   "accept, inconclusive, reject"),
    LENGTH(m, "clearance", "as made"),
    LENGTH(low_m, "clearance_low", "its band: at least"),
    LENGTH(high_m, "clearance_high", "its band: at most"),
    LENGTH(required_m, "required", "what is asked; 0: that they do not meet"),
    LENGTH(drawn_m, "drawn", "of the outlines as drawn"),
    LENGTH(proved_m, "proved", "no pair is nearer, as drawn; NaN: nothing is proved"),
    LENGTH(start_m, "start", "of the pair where the motion begins"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, clearance_row, t_s, "t", "s", "when; NaN: a pose of a box"),
    LENGTH(ax_m, "a_x", "nearest place of a"),
    LENGTH(ay_m, "a_y", "nearest place of a"),
    LENGTH(bx_m, "b_x", "nearest place of b"),
    LENGTH(by_m, "b_y", "nearest place of b"),
};

static clearance_row row_of_clearance(const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    return (clearance_row){.scene = c->scene,
                           .flow = c->flow,
                           .a = l->at.a,
                           .b = l->at.b,
                           .decision = fw_verdict_decision_text(c->decision),
                           .m = c->m,
                           .low_m = c->low_m,
                           .high_m = c->high_m,
                           .required_m = c->required_m,
                           .drawn_m = l->m,
                           .proved_m = isfinite(l->low_m) ? l->low_m : (double)NAN,
                           .start_m = l->start_m,
                           .t_s = c->box == FW_NONE ? l->t_s : (double)NAN,
                           .ax_m = l->at.at_a.x,
                           .ay_m = l->at.at_a.y,
                           .bx_m = l->at.at_b.x,
                           .by_m = l->at.at_b.y};
}

fw_status fw_plan_numbers_clearances(fw_design *d, fw_plan_arrays *to) {
    const fw_verdict *v = &d->plan->verdict;
    size_t n = 0;
    for (int i = 0; i < v->nvariant; i++)
        n += (size_t)v->variant[i].nclearance;
    clearance_row *row = fw_arena_array(to->arena, clearance_row, n);
    const char **label = fw_plan_labels(to, n);
    if (!row || !label) return FW_NOMEM;
    n = 0;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++, n++) {
            row[n] = row_of_clearance(&v->variant[i].clearance[k]);
            label[n] = row[n].scene ? row[n].scene : "";
        }
    fw_plan_array_columns(to, clearance_columns, COUNT(clearance_columns), row, n, sizeof *row,
                          label);
    return FW_OK;
}

/* ---- requirements ---- */

typedef struct requirement_row {
    fw_verdict_requirement drawn;
    const char *decision;
    double made, made_low, made_high, made_used;
    const char *made_decision, *made_corner;
} requirement_row;

#define ASKED(member, name, about)                                                                 \
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, requirement_row, member, name, "", about)
#define VALUE(member, name, about)                                                                 \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, requirement_row, member, name, "*", about)
#define SHARE(member, name, about)                                                                 \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, requirement_row, member, name, "1", about)

static const fw_plan_column requirement_columns[] = {
    ASKED(drawn.probe, "probe", "its id"),
    ASKED(drawn.kind, "kind", "of the probe"),
    ASKED(drawn.measure, "measure", "what of its course; none: of an equilibrium"),
    ASKED(drawn.unit, "unit", "SI unit of the row"),
    ASKED(drawn.scene, "scene", "none: at rest, without loads"),
    ASKED(drawn.flow, "flow", "in which it is judged"),
    VALUE(drawn.min, "min", "least allowed; NaN: none"),
    VALUE(drawn.max, "max", "most allowed; NaN: none"),
    VALUE(drawn.value, "value", "as drawn; NaN: it has none"),
    VALUE(drawn.low, "low", "its band: at least"),
    VALUE(drawn.high, "high", "its band: at most"),
    VALUE(drawn.margin, "margin", "to the nearer bound, below 0 beyond it"),
    SHARE(drawn.utilisation, "utilisation", "1 at the bound, above it not met"),
    SHARE(drawn.utilisation_low, "utilisation_low", "its band: at least"),
    SHARE(drawn.utilisation_high, "utilisation_high", "its band: at most"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, requirement_row, drawn.t_s, "t", "s", "when; NaN: no one time"),
    ASKED(decision, "verdict", "as drawn: accept, inconclusive, reject"),
    ASKED(drawn.why, "why", "it has no value"),
    VALUE(made, "made_value", "of the worst device that the flow may make; NaN: none was judged"),
    VALUE(made_low, "made_low", "its band over all corners: at least"),
    VALUE(made_high, "made_high", "its band over all corners: at most"),
    SHARE(made_used, "made_utilisation", "of that device"),
    ASKED(made_decision, "made_verdict", "of that device"),
    ASKED(made_corner, "made_corner", "what the flow makes there"),
};

static requirement_row row_of_requirement(const fw_verdict_variant_verdict *v, int k) {
    const double none = (double)NAN;
    int corner = 0;
    const fw_verdict_requirement *r = &v->requirement[k];
    const fw_verdict_requirement *made = fw_verdict_requirement_made(v, k, &corner);
    requirement_row row = {*r,  fw_verdict_decision_text(r->decision), none, none, none, none, NULL,
                           NULL};
    if (!made) return row;
    row.made = made->value;
    double band[2];
    fw_verdict_requirement_band(made, band);
    row.made_low = band[0], row.made_high = band[1];
    row.made_used = made->utilisation;
    row.made_decision = fw_verdict_decision_text(made->decision);
    row.made_corner = v->fabricated->corner[corner].what;
    return row;
}

fw_status fw_plan_numbers_requirements(fw_design *d, fw_plan_arrays *to) {
    const fw_verdict *v = &d->plan->verdict;
    size_t n = 0;
    for (int i = 0; i < v->nvariant; i++)
        n += (size_t)v->variant[i].nrequirement;
    requirement_row *row = fw_arena_array(to->arena, requirement_row, n);
    const char **label = fw_plan_labels(to, n);
    if (!row || !label) return FW_NOMEM;
    n = 0;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nrequirement; k++, n++) {
            row[n] = row_of_requirement(&v->variant[i], k);
            label[n] = row[n].drawn.probe;
        }
    fw_plan_array_columns(to, requirement_columns, COUNT(requirement_columns), row, n, sizeof *row,
                          label);
    return FW_OK;
}

/* ---- probes ---- */

typedef struct probe_row {
    const char *id, *kind, *unit, *scene, *flow;
    fw_probe_result r;
} probe_row;

#define NAMED(member, name, about) FW_PLAN_COLUMN(FW_ARRAY_TEXT, probe_row, member, name, "", about)
#define SEEN(member, name, about)                                                                  \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, probe_row, r.member, name, "*", about)
#define WHEN(member, name, about)                                                                  \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, probe_row, r.member, name, "s", about)

static const fw_plan_column probe_columns[] = {
    NAMED(id, "id", "of the probe"),
    NAMED(kind, "kind", "displacement, gap, force, ..."),
    NAMED(unit, "unit", "SI unit of the row"),
    NAMED(scene, "scene", "that it was seen in"),
    NAMED(flow, "flow", "that the device is of"),
    SEEN(peak, "peak", "the larger size of both extremes, with its sign"),
    WHEN(peak_t_s, "peak_t", "when"),
    SEEN(maximum, "maximum", "over the motion"),
    WHEN(maximum_t_s, "maximum_t", "when"),
    SEEN(minimum, "minimum", "over the motion"),
    WHEN(minimum_t_s, "minimum_t", "when"),
    SEEN(final, "final", "at the end of the scene"),
    SEEN(across, "across", "largest size across its direction"),
    SEEN(numeric, "error", "numerical, of the extremes"),
    SEEN(final_numeric, "final_error", "numerical, of the final value"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, probe_row, r.level, "level_error", "1",
                   "relative, of the model of the hinges; NaN: not known"),
};

static fw_status probes(fw_plan_arrays *to, const probe_row *row, size_t n) {
    const char **label = fw_plan_labels(to, n);
    FW_NEED(label);
    for (size_t i = 0; i < n; i++)
        label[i] = row[i].id;
    fw_plan_array_columns(to, probe_columns, COUNT(probe_columns), row, n, sizeof *row, label);
    return FW_OK;
}

static probe_row row_of_probe(const fw_device_probe *p, const char *scene, const char *flow,
                              const fw_probe_result *r) {
    const fw_device_probe_kind *kind = &fw_device_probe_kinds[p->row];
    return (probe_row){p->id, kind->name, kind->unit, scene, flow, *r};
}

fw_status fw_plan_numbers_probes(fw_design *d, fw_plan_arrays *to) {
    const fw_verdict *v = &d->plan->verdict;
    const fw_device *device = d->plan->device;
    const size_t each = (size_t)device->nscene * (size_t)device->nprobe;
    probe_row *row = fw_arena_array(to->arena, probe_row, (size_t)v->nvariant * each);
    FW_NEED(row);
    size_t n = 0;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_variant_verdict *of = &v->variant[i];
        for (size_t k = 0; of->probed && of->motion && k < each; k++)
            if (of->probed[k].known)
                row[n++] = row_of_probe(&device->probe[k % (size_t)device->nprobe],
                                        device->scene[k / (size_t)device->nprobe].name,
                                        of->variant->flow, &of->probed[k]);
    }
    return probes(to, row, n);
}

fw_status fw_plan_numbers_motion_probes(fw_design *d, fw_plan_arrays *to) {
    const int most = fw_probe_count(d->mechanism);
    const fw_probe_monitor *saw = most > 0 ? d->motion->observed : NULL;
    probe_row *row = fw_arena_array(to->arena, probe_row, (size_t)most);
    FW_NEED(row);
    size_t n = 0;
    for (int i = 0; saw && i < most; i++) {
        fw_probe_result r;
        fw_probe_result_of(saw, d->motion->compared, d->motion, i, &r);
        if (r.known)
            row[n++] = row_of_probe(&d->mechanism->device->probe[i], d->scene->name,
                                    d->mechanism->variant->flow, &r);
    }
    return probes(to, row, n);
}
