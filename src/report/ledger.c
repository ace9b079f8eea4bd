/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How hinges were taken, and the ledger of effects with accuracy and assumptions behind it. */
#include "report/report_page.h"
#include <math.h>
#include <string.h>

static bool stepped(const fw_statics_level_step *s) {
    return s && !s->why_not;
}

/* ---- text ---- */

/* the body that the next level moves most, by the larger of both */
static int most_moved(const fw_mechanism *m, const fw_statics_level_step *s) {
    int best = 0;
    double most = -1;
    for (int b = 0; b < m->nbody; b++) {
        const double *p = s->at.q + 3 * b, *q = s->up.q + 3 * b;
        double way = hypot(q[0] - p[0], q[1] - p[1]);
        if (way > most) most = way, best = b;
    }
    return best;
}

static void pose_line(const fw_mechanism *m, const fw_statics_level_step *s, int b, fw_text *out) {
    const double *p = s->at.q + 3 * b, *q = s->up.q + 3 * b;
    fw_text_printf(out, "    %-8s ", m->body[b].id ? m->body[b].id : "");
    fw_text_real(out, "%+11.5f ", (q[0] - p[0]) * 1e6);
    fw_text_real(out, "%+11.5f ", (q[1] - p[1]) * 1e6);
    fw_text_real(out, "%+11.6f", (q[2] - p[2]) * 1e3);
    fw_text_add(out, "\n");
}

static void strain_line(const fw_mechanism *m, const fw_statics_level_step *s, int k,
                        fw_text *out) {
    int pin = m->hinge[k].pin;
    fw_text_printf(out, "    %-8s ", m->pin[pin].id);
    fw_text_real(out, "%+11.6f ", (s->up.angle_rad[pin] - s->at.angle_rad[pin]) * 1e3);
    if (isfinite(s->at.strain[k]) && isfinite(s->up.strain[k])) {
        fw_text_real(out, "%10.6f %% ", 100 * s->at.strain[k]);
        fw_text_real(out, "%+10.6f %%", 100 * (s->up.strain[k] - s->at.strain[k]));
    }
    fw_text_add(out, "\n");
}

void fw_report_hinge_model(const fw_mechanism *m, const fw_effects_hinge_use *use,
                           const fw_statics_level_step *s, fw_text *out) {
    enum { FEW = 12 };
    if (!use->why) return;
    fw_text_printf(out, "\nhinges as %s: %s\n", fw_effects_hinge_model_text(use->used), use->why);
    if (s && s->why_not) fw_text_printf(out, "  no step to the next level: %s\n", s->why_not);
    if (!stepped(s)) return;
    char by[32];
    fw_percent_text(by, sizeof by, s->relative);
    fw_text_printf(out, "  %s there instead changes hinge angles by up to %s %% of the largest",
                   fw_effects_hinge_model_text(s->next), by);
    if (isfinite(s->t_s)) {
        fw_text_add(out, " (at ");
        fw_text_number(out, s->t_s * 1e3, 4);
        fw_text_add(out, " ms, under the loads and inertia forces of that instant)");
    }
    fw_text_add(out, "\n    body            x um        y um    phi mrad\n");
    if (m->nbody > FEW)
        pose_line(m, s, most_moved(m, s), out);
    else
        for (int b = 0; b < m->nbody; b++)
            pose_line(m, s, b, out);
    fw_text_add(out, "    hinge      angle mrad  peak strain      change\n");
    for (int k = 0; k < m->nhinge && k < FEW; k++)
        strain_line(m, s, k, out);
    if (m->nhinge > FEW) fw_text_printf(out, "    and %d more\n", m->nhinge - FEW);
}

/* ---- the page ---- */

static void row(fw_text *out, const char *scene, const char *flow, const fw_mechanism *m,
                const fw_dynamics_motion *x) {
    const fw_statics_level_step *s = x->level;
    const fw_effects_hinge_use *use = &x->ledger.hinge;
    double strain = 0, largest = 0;
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td>", scene, flow,
              fw_effects_hinge_model_text(use->used));
    if (!stepped(s)) {
        fw_markup(out,
                  "<td>\u2013</td><td class=\"n\">\u2013</td><td class=\"n\">\u2013"
                  "</td><td class=\"n\">\u2013</td><td>{s}{s}{s}</td></tr>\n",
                  use->why, s && s->why_not ? "; " : "", s ? s->why_not : NULL);
        return;
    }
    for (int k = 0; k < m->nhinge; k++) {
        strain = fmax(strain, fabs(s->up.strain[k] - s->at.strain[k]));
        largest = fmax(largest, s->at.strain[k]);
    }
    const double *p = s->at.q + 3 * most_moved(m, s), *q = s->up.q + 3 * most_moved(m, s);
    fw_markup(out,
              "<td>{s}</td><td class=\"n\">{p}</td><td class=\"n\">{u}</td><td "
              "class=\"n\">{p}</td><td>{s}</td></tr>\n",
              fw_effects_hinge_model_text(s->next), s->relative, hypot(q[0] - p[0], q[1] - p[1]),
              "m", largest > 0 ? strain / largest : (double)NAN, use->why);
}

/* table of all scenes and flows; none without hinges */
static void levels_section(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    fw_text *out = page->out;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->motion && k < page->in->device->nscene; k++) {
            if (!v->motion[k] || !v->motion[k]->ledger.hinge.why) continue;
            if (!any)
                fw_text_add(
                    out,
                    "<div class=\"wide\"><table><caption>The model of the hinges in each "
                    "scene, and what the next better one changes at the largest peak, "
                    "under the loads and inertia forces of that instant: hinge angles and "
                    "peak strains relative to the largest, and the displacement of the "
                    "body that moves most."
                    "</caption><thead><tr><th scope=\"col\">Scene</th><th scope=\"col\">"
                    "Flow</th><th scope=\"col\">Hinges</th><th scope=\"col\">Next</th>"
                    "<th scope=\"col\" class=\"n\">Angles</th><th scope=\"col\" "
                    "class=\"n\">Displacement</th><th scope=\"col\" class=\"n\">Strain</th><th "
                    "scope=\"col\">Why</th></tr></thead><tbody>\n");
            any = true;
            row(out, page->in->device->scene[k].name,
                v->variant && v->variant->flow ? v->variant->flow : "\u2013", v->mechanism,
                v->motion[k]);
        }
    }
    if (any) fw_text_add(out, "</tbody></table></div>\n");
}

/* ---- effects and what stands behind them: the ledger, accuracy, assumptions ---- */

/* What was simulated and what was left out, and how well. Measured run time is not printed: the
   same input gives the same bytes. */

static void effect_row(fw_text *out, const fw_effect_entry *e) {
    char bound[32]; /* with the digits of the reason */
    fw_markup(out, "<tr><th scope=\"row\" class=\"id\">{s}</th><td>{r}</td><td class=\"n\">", e->id,
              e->active ? "<strong>active</strong>" : "left out");
    if (isinf(e->bound))
        fw_text_add(out, "\u221e");
    else
        fw_markup(out, "{s}\u00a0%", fw_percent_text(bound, sizeof bound, e->bound));
    fw_text_add(out, "</td><td class=\"n\">");
    if (e->cost > 0)
        fw_markup(out, "{n}", e->cost);
    else
        fw_text_add(out, "\u2013");
    fw_markup(out, "</td><td>{s}</td></tr>\n", e->reason);
}

static void not_called_for(fw_text *out, const fw_effect_ledger *ledger) {
    bool any = false;
    for (int i = 0; i < ledger->count; i++) {
        if (ledger->item[i].called_for) continue;
        fw_markup(out, any ? ", {s}" : "<tr><td class=\"soft\" colspan=\"5\">Not called for: {s}",
                  ledger->item[i].id);
        any = true;
    }
    if (any) fw_text_add(out, "</td></tr>\n");
}

typedef void (*motion_rows)(fw_text *out, const char *flow, const char *scene, double wanted,
                            const fw_dynamics_motion *motion);

static void each_motion(fw_report_page *page, motion_rows rows) {
    const fw_verdict *verdict = page->in->verdict;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        const char *flow = v->variant && v->variant->flow ? v->variant->flow : "\u2013";
        for (int k = 0; v->motion && k < page->in->device->nscene; k++)
            if (v->motion[k])
                rows(page->out, flow, page->in->device->scene[k].name, verdict->accuracy_wanted,
                     v->motion[k]);
    }
}

/* of one scene in one flow: what it calls for, then in one line what it does not */
static void effects_of(fw_text *out, const char *flow, const char *scene, double wanted,
                       const fw_dynamics_motion *motion) {
    const fw_effect_ledger *ledger = &motion->ledger;
    fw_markup(out,
              "<tbody><tr><th scope=\"rowgroup\" colspan=\"5\">{s} <span class=\"soft\">"
              "({s})</span></th></tr>\n",
              scene, flow);
    for (int i = 0; i < ledger->count; i++)
        if (ledger->item[i].called_for) effect_row(out, &ledger->item[i]);
    not_called_for(out, ledger);
    fw_markup(out,
              "<tr><td class=\"soft\" colspan=\"5\">Sum of the bounds of what is left out: "
              "{p}, accuracy wanted: {p}</td></tr></tbody>\n",
              ledger->left_out, wanted);
}

/* ---- pull-in ---- */

static void pull_in_row(fw_text *out, const char *flow, const char *scene,
                        const fw_statics_pull_in *p) {
    static const char *const what[] = {[FW_PULL_IN_NONE] = "none found",
                                       [FW_PULL_IN_FOLD] = "fold: snaps along the drive",
                                       [FW_PULL_IN_SIDE] = "side: moves aside between the fingers",
                                       [FW_PULL_IN_TILT] = "tilt: turns between the fingers"};
    bool none = p->kind == FW_PULL_IN_NONE;
    fw_markup(out, "<tr{r}><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td><td class=\"n\">",
              !none && p->margin < 1 ? " class=\"bad\"" : "", scene, flow, p->comb);
    if (none && isinf(p->voltage_V))
        fw_text_add(out, "none");
    else
        fw_markup(out, "{r}{u}", none ? "above " : "", p->voltage_V, "V");
    fw_markup(out, "</td><td>{r}", what[p->kind]);
    if (none && p->why) fw_markup(out, " ({s})", p->why);
    if (!isnan(p->at_s)) fw_markup(out, ", {s}", p->together);
    fw_markup(out, "</td><td class=\"n\">{u}</td><td class=\"n\">", p->largest_V, "V");
    if (isfinite(p->margin))
        fw_markup(out, "{n}", p->margin);
    else
        fw_text_add(out, "\u2013");
    fw_markup(out, "</td><td class=\"n\">{p}</td></tr>\n", p->fringe);
}

static void pull_ins(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    fw_text *out = page->out;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        const char *flow = v->variant && v->variant->flow ? v->variant->flow : "\u2013";
        for (int k = 0; v->pull_in && k < page->in->device->nscene; k++) {
            if (!v->pull_in[k]) continue;
            if (!any)
                fw_text_add(
                    out,
                    "<div class=\"wide\"><table><caption>Pull-in: the voltage at which a comb "
                    "drive loses its equilibrium when all drives of the scene grow together, "
                    "slowly; a voltage that is switched on suddenly does so earlier. Margin: "
                    "the pull-in voltage over the largest voltage of the scene. Fringe: "
                    "what fringe fields may add to the pull that are not in it, all of them "
                    "where they are left out, else what surfaces near or below change of them; "
                    "it lowers the voltage by about half of that.</caption><thead><tr><th "
                    "scope=\"col\">Scene</th><th scope=\"col\">Flow</th><th scope=\"col\">"
                    "Comb</th><th scope=\"col\" class=\"n\">Pull-in</th><th scope=\"col\">"
                    "Kind</th><th scope=\"col\" class=\"n\">Scene asks for</th><th "
                    "scope=\"col\" class=\"n\">Margin</th><th scope=\"col\" class=\"n\">"
                    "Fringe</th></tr></thead><tbody>\n");
            any = true;
            pull_in_row(out, flow, page->in->device->scene[k].name, v->pull_in[k]);
        }
    }
    if (any) fw_text_add(out, "</tbody></table></div>\n");
}

fw_status fw_report_section_effects(fw_report_page *page) {
    fw_text_add(
        page->out,
        "<p>An effect is simulated when the scene calls for it; those with the smallest bounds are "
        "left out as long as the sum of their bounds stays below the accuracy wanted. That sum is "
        "part of the angles' errors.</p>\n<div class=\"wide\"><table><caption>Ledger of effects. "
        "Bound: the most that leaving it out changes the angle of any hinge at its peak, relative "
        "to "
        "the largest one; \u221e: it is the motion itself, or nothing bounds it. Cost: "
        "instructions "
        "that it adds to each evaluation of the forces, which takes some 1300 per body besides; "
        "\u2013: none."
        "</caption><thead><tr><th scope=\"col\">Effect</th><th scope=\"col\">State</th><th "
        "scope=\"col\" class=\"n\">Bound</th><th scope=\"col\" class=\"n\">Cost</th><th "
        "scope=\"col\">Reason</th></tr></thead>\n");
    each_motion(page, effects_of);
    fw_text_add(page->out, "</table></div>\n");
    levels_section(page);
    pull_ins(page);
    return fw_text_end(page->out);
}

static void stats_of(fw_text *out, const char *flow, const char *scene, double wanted,
                     const fw_dynamics_motion *motion) {
    (void)wanted;
    const fw_dynamics_motion_stats *s = &motion->stats;
    fw_markup(out,
              "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td><td>{s}</td><td "
              "class=\"n\">{e}</td><td class=\"n\">{l} ({l})</td><td class=\"n\">{l}</td><td "
              "class=\"n\">{l}</td><td class=\"n\">{e}</td><td class=\"n\">{e}</td><td "
              "class=\"n\">{e}</td></tr>\n",
              scene, flow, motion->method, motion->integrator, s->rtol, s->steps, s->rejected,
              s->rhs, s->projections, s->max_constraint_norm, s->max_velocity_norm,
              s->energy_error);
}

static void reason_of(fw_text *out, const char *flow, const char *scene, double wanted,
                      const fw_dynamics_motion *motion) {
    (void)wanted;
    if (motion->reason && motion->reason[0])
        fw_markup(out, "<li>{s}, {s}: {s}; {s}</li>\n", scene, flow, motion->reason,
                  motion->tolerance);
}

fw_status fw_report_section_accuracy(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    fw_markup(
        out,
        "<p>Relative error wanted on the peak hinge deflection: <strong>{p}</strong>; "
        "estimated: <strong>{p}</strong>. This is the error of the computation and the sum of the "
        "bounds of effects that were left out; what the "
        "model itself leaves open is in the error bands and under <a "
        "href=\"#assumptions\">assumptions</a>.</p>\n",
        v->accuracy_wanted, v->accuracy_estimated);
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>What it took. Constraint norms are relative "
                "to the size of the scene, the largest over all steps.</caption><thead><tr><th "
                "scope=\"col\">Scene</th><th scope=\"col\">Flow</th><th scope=\"col\">Method</th>"
                "<th scope=\"col\">Integrator</th><th scope=\"col\" class=\"n\">Tolerance</th><th "
                "scope=\"col\" class=\"n\">Steps (rejected)</th><th scope=\"col\" class=\"n\">"
                "Evaluations</th><th scope=\"col\" class=\"n\">Projections</th><th scope=\"col\" "
                "class=\"n\">Constraints</th><th scope=\"col\" class=\"n\">Their rates</th><th "
                "scope=\"col\" class=\"n\">Energy error</th></tr></thead><tbody>\n");
    each_motion(page, stats_of);
    fw_text_add(out, "</tbody></table></div>\n<ul class=\"plain\">\n");
    each_motion(page, reason_of);
    fw_text_add(out, "<li class=\"soft\">The pictures show decimated curves; the verdict does not "
                     "depend on them.</li>\n</ul>\n");
    return fw_text_end(out);
}

enum { MOST = 200 };

typedef struct used {
    const fw_quantity *q;
    const char *where, *name;
} used;

typedef struct used_list {
    used item[MOST];
    int count, dropped;
} used_list;

static void place_cell(fw_text *out, const fw_quantity *q) {
    fw_markup(out, "<td>{s}{r}{s}", q->source, q->source && q->note ? "; " : "", q->note);
    if (q->place.file && q->place.line > 0)
        fw_markup(out, " <span class=\"soft\">{s}:{i}</span>", fw_place_file(q->place),
                  q->place.line);
    fw_text_add(out, "</td>");
}

static void quantity_row(fw_text *out, const used *u) {
    const fw_quantity *q = u->q;
    fw_quantity_unit unit = {1.0, 0.0, {0, 0, 0, 0, 0, 0, 0, 0}};
    bool known = q->unit && q->unit[0] &&
                 fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL);
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td class=\"n\">", u->name, u->where);
    if (q->unknown)
        fw_text_add(out, "<strong class=\"no\">unknown</strong>");
    else {
        fw_markup(out, "{n}", (q->value - unit.offset) / unit.factor);
        if (q->uncertainty > 0.0) fw_markup(out, " \u00b1 {e}", q->uncertainty / unit.factor);
        fw_markup(out, " {s}", known && strcmp(q->unit, "1") != 0 ? q->unit : "");
    }
    fw_markup(out, "</td><td>{s}</td>",
              q->unknown ? "unknown" : fw_quantity_value_status_text(q->status));
    place_cell(out, q);
    fw_text_add(out, "</tr>\n");
}

static void quantity_head(fw_text *out, const char *caption) {
    fw_markup(out,
              "<div class=\"wide\"><table><caption>{s}</caption><thead><tr><th scope=\"col\">"
              "Quantity</th><th scope=\"col\">Used in</th><th scope=\"col\" class=\"n\">Value"
              "</th><th scope=\"col\">Status</th><th scope=\"col\">Source</th></tr></thead>"
              "<tbody>\n",
              caption);
}

static void materials(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    quantity_head(out, "Materials as used, with the device file's own values where it gives them");
    for (int i = 0; i < v->nvariant; i++) {
        const fw_device_material *m = &v->variant[i].variant->material;
        const char *where = m->name ? m->name : m->id;
        const used row[] = {{&m->youngs, where, "Young's modulus"},
                            {&m->poisson, where, "Poisson's ratio"},
                            {&m->density, where, "density"},
                            {&m->strength, where, m->criterion ? m->criterion : "strength"},
                            {&m->loss, where, "loss factor"}};
        for (size_t k = 0; k < sizeof row / sizeof row[0]; k++)
            if (row[k].q->unit || row[k].q->source || row[k].q->unknown) quantity_row(out, &row[k]);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

static void consider(used_list *list, const fw_quantity *q, const char *name, const char *where) {
    if (!q || q->unknown || (q->status != FW_TYPICAL && q->status != FW_ASSUMED)) return;
    for (int i = 0; i < list->count; i++)
        if (list->item[i].q == q) return;
    if (list->count == MOST) {
        list->dropped++;
        return;
    }
    list->item[list->count++] = (used){q, where, q->id ? q->id : name};
}

static void collect(used_list *list, const fw_process_flow *flow) {
    consider(list, flow->thickness, "device layer thickness", flow->id);
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        const char *where = s->title ? s->title : s->id;
        for (int k = 0; k < s->nargument; k++)
            consider(list, s->argument[k].q, s->argument[k].name, where);
        for (int k = 0; k < s->nsetting; k++)
            consider(list, s->setting[k].q, s->setting[k].name, where);
    }
}

static fw_status process_quantities(fw_report_page *page) {
    used_list *list;
    FW_NEED(list = fw_arena_one(page->arena, used_list));
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].flow) collect(list, page->in->flow[i].flow);
    if (list->count == 0) return FW_OK;
    fw_text *out = page->out;
    quantity_head(out,
                  "Process numbers that nobody measured or stated for this device: replace them "
                  "with your own");
    for (int i = 0; i < list->count; i++)
        quantity_row(out, &list->item[i]);
    fw_text_add(out, "</tbody></table></div>\n");
    if (list->dropped) fw_markup(out, "<p>{i} more are not shown.</p>\n", list->dropped);
    return fw_text_end(out);
}

static void scaling(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_mechanism_variant *a = v->variant[i].variant;
        if (a->explicit_mass_scale == 1.0 && a->explicit_stiffness_scale == 1.0 &&
            a->explicit_damping_scale == 1.0)
            continue;
        fw_markup(out,
                  "<li>{s}: masses, stiffnesses and dampings that the file states hold for the "
                  "device's own material and thickness; here they are multiplied by {n}, {n} "
                  "and {n} (density \u00d7 thickness, modulus \u00d7 thickness, and the root of "
                  "their product: the same modal damping).</li>\n",
                  a->flow ? a->flow : "this variant", a->explicit_mass_scale,
                  a->explicit_stiffness_scale, a->explicit_damping_scale);
    }
}

static void models(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    double most = 0.0;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; v->variant[i].mechanism && k < v->variant[i].mechanism->nhinge; k++)
            most = fmax(most, v->variant[i].mechanism->hinge[k].closed_form.limit_uncertainty);
    fw_markup(out,
              "<li>Hinges: pseudo-rigid bodies, revolute joints at the elastic centres; "
              "closed-form curved-beam theory with depth and root corrections and the "
              "concentration at the fillet. Standard uncertainty of the limit angle from the "
              "model: up to {p}.</li>\n<li>Safety factor {n}, applied to the material's "
              "limit.</li>\n<li>Bodies between the hinges are rigid; the motion stays in the "
              "plane of the wafer.</li>\n",
              most, page->in->device->safety_factor);
}

fw_status fw_report_section_assumptions(fw_report_page *page) {
    fw_text *out = page->out;
    fw_text_add(out, "<ul class=\"plain\">\n");
    if (page->in->nassumption == 0) { /* the caller's own list says it in more detail */
        models(page);
        scaling(page);
    }
    for (int i = 0; i < page->in->nassumption; i++)
        fw_markup(out, "<li>{s}</li>\n", page->in->assumption[i]);
    fw_text_add(out, "</ul>\n");
    if (page->in->verdict->nvariant) materials(page);
    fw_report_mechanics(page);
    return process_quantities(page);
}
