/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How near things come, what is asked of the device and what its probes saw, as arrays: a row each. */
#include "plan/arrays.h"
#include <math.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

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

#define WORD(member, name, about)                                                                  \
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, requirement_row, member, name, "", about)
#define VALUE(member, name, about)                                                                 \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, requirement_row, member, name, "*", about)
#define SHARE(member, name, about)                                                                 \
    FW_PLAN_COLUMN(FW_ARRAY_REAL, requirement_row, member, name, "1", about)

static const fw_plan_column requirement_columns[] = {
    WORD(drawn.probe, "probe", "its id"),
    WORD(drawn.kind, "kind", "of the probe"),
    WORD(drawn.measure, "measure", "what of its course; none: of an equilibrium"),
    WORD(drawn.unit, "unit", "SI unit of the row"),
    WORD(drawn.scene, "scene", "none: at rest, without loads"),
    WORD(drawn.flow, "flow", "in which it is judged"),
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
    WORD(decision, "verdict", "as drawn: accept, inconclusive, reject"),
    WORD(drawn.why, "why", "it has no value"),
    VALUE(made, "made_value", "of the worst device that the flow may make; NaN: none was judged"),
    VALUE(made_low, "made_low", "its band over all corners: at least"),
    VALUE(made_high, "made_high", "its band over all corners: at most"),
    SHARE(made_used, "made_utilisation", "of that device"),
    WORD(made_decision, "made_verdict", "of that device"),
    WORD(made_corner, "made_corner", "what the flow makes there"),
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
